//! The influence of every observation on adjusted quantities.
//!
//! The estimate is x = x₀ + S Q AᵀP l, with Q a generalised inverse of the normal equations and S the S-transformation of the datum. A
//! quantity eᵀx therefore depends on the observations by fᵀ = eᵀ S Q AᵀP. Along the directions G that the datum leaves open A G = 0, so
//! that A S = A and fᵀ = (Q Sᵀe)ᵀ AᵀP: one solution of the factored equations for every quantity serves all observations.

use std::collections::HashMap;

use crate::adjust::datum::free::at_point;
use crate::adjust::equations::back_substitution::Full;
use crate::adjust::problem::eccentric;
use crate::adjust::solve::session::Session;
use crate::adjust::{SAME_FACTOR, apply};
use crate::adjustment::{AdjustOptions, Adjustment, StatisticsChoice};
use crate::error::{Error, Place, Reason, Result};
use crate::project::{Parameter, Project};

use super::linear_system::{Columns, Equation, RowNames, of_session};
use super::sparse::SparseMatrix;
use super::stepping::with_session;

/// Cofactors of coordinates below this part of the largest are those of coordinates that a minimal datum holds, but for rounding: without
/// the limit their ratio to the stated variances, rounding over rounding, would refuse every adjustment with a minimal datum.
const HELD: f64 = 1e-9;

/// An adjusted quantity.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum AdjustedQuantity {
    /// Coordinate of an object point.
    Point(String, usize),
    /// Coordinate of a projection centre.
    Centre(String, usize),
    /// Parameter of an interior orientation: camera, photo where it belongs to one photo, parameter.
    Parameter(String, Option<String>, Parameter),
}

/// Influences of the observations of an adjustment on quantities.
#[derive(Debug)]
pub(crate) struct Influences {
    /// The observations.
    pub observations: Vec<Equation>,
    /// Variance factor of the adjustment's covariances.
    pub variance_factor: f64,
    a: SparseMatrix,
    sqrt_p: Vec<f64>,
    /// Q Sᵀe of all quantities side by side, a row an unknown.
    solved: Vec<f64>,
    quantities: usize,
}

impl Influences {
    /// Adds `factor` times what one a priori standard error of an observation changes in every quantity.
    pub fn add(&self, row: usize, factor: f64, sums: &mut [f64]) {
        for (column, a) in self.a.row(row) {
            let by = factor * a * self.sqrt_p[row];
            let solved = &self.solved[column * self.quantities..(column + 1) * self.quantities];
            sums.iter_mut().zip(solved).for_each(|(sum, x)| *sum += by * x);
        }
    }
}

/// Indices of a quantity in the network.
#[derive(Clone, Copy)]
enum QuantityPlace {
    Point(usize, usize),
    Centre(usize, usize),
    Parameter(usize, usize),
}

fn found(session: &Session<'_>, quantities: &[AdjustedQuantity]) -> Vec<Option<QuantityPlace>> {
    let (project, network) = (session.project, &session.network);
    let named = |index: usize| project.photos[index].id.as_str();
    let points: HashMap<&str, usize> =
        network.points.iter().enumerate().map(|(k, p)| (project.points[p.index].id.as_str(), k)).collect();
    let photos: HashMap<&str, usize> = network.photos.iter().enumerate().map(|(k, p)| (named(p.index), k)).collect();
    let one = |quantity: &AdjustedQuantity| match quantity {
        AdjustedQuantity::Point(id, axis) => {
            let point = *points.get(id.as_str())?;
            (!network.points[point].fixed[*axis]).then_some(QuantityPlace::Point(point, *axis))
        }
        AdjustedQuantity::Centre(id, axis) => Some(QuantityPlace::Centre(*photos.get(id.as_str())?, *axis)),
        AdjustedQuantity::Parameter(camera, photo, parameter) => {
            network.interiors.iter().enumerate().find_map(|(k, block)| {
                let own = block.photo.map(|p| named(network.photos[p].index));
                let same = project.cameras[block.camera].id == *camera && own == photo.as_deref();
                let at = block.estimated.iter().position(|e| same && e.parameter == *parameter)?;
                Some(QuantityPlace::Parameter(k, at))
            })
        }
    };
    quantities.iter().map(one).collect()
}

/// Influences of the observations that took part in an adjustment on quantities, in the project's units.
///
/// # Errors
/// [`Reason::EquationsOfAnother`] if the equations of the document do not repeat the adjustment's covariances: after robust estimation,
/// with variance components, for an adjustment of another document, without standard errors. As [`crate::adjust::adjust`].
pub(crate) fn influences(
    project: &Project,
    adjustment: &Adjustment,
    quantities: &[AdjustedQuantity],
) -> Result<Influences> {
    let another = || Error::Invalid { reason: Reason::EquationsOfAnother, at: Place::default() };
    let mut applied = apply(project, adjustment);
    if applied.observations.len() != adjustment.observations.len() || adjustment.options.robust.is_some() {
        return Err(another());
    }
    for (observation, row) in applied.observations.iter_mut().zip(&adjustment.observations) {
        observation.enabled = row.enabled;
    }
    applied.set_aside.clear();
    let statistics = StatisticsChoice::Precision;
    let options = AdjustOptions { statistics, covariance_of: Vec::new(), ..adjustment.options.clone() };
    with_session(&applied, &options, |mut session| {
        session.adopt(adjustment);
        session.shift = eccentric::shifts(session.project, &session.network, &session.state);
        session.finish(&options, false)?;
        let system = of_session(&session, &options, RowNames::Given)?;
        let (solved, cofactors) = solved(&session, quantities, system.unknowns.len())?;
        let stated: HashMap<&str, [f64; 6]> =
            adjustment.points.iter().filter_map(|p| Some((p.id.as_str(), p.covariance?))).collect();
        let points = || quantities.iter().zip(&cofactors).filter(|(q, _)| matches!(q, AdjustedQuantity::Point(..)));
        let least = HELD * points().map(|(_, cofactor)| *cofactor).fold(0.0, f64::max);
        let factors = points().filter_map(|(quantity, cofactor)| {
            let AdjustedQuantity::Point(id, axis) = quantity else { return None };
            let variance = stated.get(id.as_str())?[[0, 3, 5][*axis]];
            (*cofactor > least).then(|| variance / cofactor)
        });
        let factors: Vec<f64> = factors.collect();
        let variance_factor = *factors.first().ok_or_else(another)?;
        if !factors.iter().all(|f| *f > 0.0 && (f / variance_factor - 1.0).abs() < SAME_FACTOR) {
            return Err(another());
        }
        let scales = system.unknowns.iter().map(|unknown| unknown.scale);
        let quantities = quantities.len();
        let mut scaled = solved;
        scaled.chunks_mut(quantities.max(1)).zip(scales).for_each(|(row, scale)| {
            row.iter_mut().for_each(|x| *x *= scale);
        });
        Ok(Influences {
            observations: system.observations,
            variance_factor,
            a: system.a,
            sqrt_p: system.p.iter().map(|p| p.sqrt()).collect(),
            solved: scaled,
            quantities,
        })
    })
}

/// Q Sᵀe in the scaled unknowns for quantities in their own units, a row an unknown, and the cofactors of the quantities.
fn solved(session: &Session<'_>, quantities: &[AdjustedQuantity], unknowns: usize) -> Result<(Vec<f64>, Vec<f64>)> {
    let (network, state) = (&session.network, &session.state);
    let (normal, layout) = session.factored();
    let constraint = session.constraint()?;
    let columns = Columns::new(network);
    let count = quantities.len();
    let mut solved = vec![0.0; unknowns * count];
    let mut cofactors = vec![0.0; count];
    for (at, place) in found(session, quantities).into_iter().enumerate() {
        let Some(place) = place else { continue };
        let mut e = Full::zeros(network, layout);
        let scale = match place {
            QuantityPlace::Point(point, axis) => {
                e.add_at_point(layout, point, axis, 1.0);
                session.subtract_datum(&mut e, constraint.as_ref(), &at_point(&state.points[point])[axis], 1.0);
                network.frame.scale
            }
            QuantityPlace::Centre(photo, axis) => {
                e.reduced[layout.photo[photo] + 3 + axis] += 1.0;
                let direction = at_point(&state.poses[photo].centre)[axis];
                session.subtract_datum(&mut e, constraint.as_ref(), &direction, 1.0);
                network.frame.scale
            }
            QuantityPlace::Parameter(interior, k) => {
                e.reduced[layout.interior[interior] + k] += 1.0;
                network.interiors[interior].estimated[k].scale
            }
        };
        let mut x = [e.clone()];
        normal.solve_all(network, layout, &mut x);
        let [x] = x;
        let reduced: f64 = e.reduced.iter().zip(&x.reduced).map(|(a, b)| a * b).sum();
        let points = e.points.iter().flatten().zip(x.points.iter().flatten());
        cofactors[at] = scale * scale * (reduced + points.map(|(a, b)| a * b).sum::<f64>());
        let mut put = |column: usize, value: f64| solved[column * count + at] = scale * value;
        for photo in 0..network.photos.len() {
            for (k, column) in columns.photo(photo).enumerate() {
                put(column, x.reduced[layout.photo[photo] + k]);
            }
        }
        for interior in 0..network.interiors.len() {
            for (k, column) in columns.interior(network, interior).enumerate() {
                put(column, x.reduced[layout.interior[interior] + k]);
            }
        }
        for (point, block) in network.points.iter().enumerate() {
            let free = (0..3).filter(|axis| !block.fixed[*axis]);
            for (axis, column) in free.zip(columns.point(point)) {
                put(column, x.at_point(layout, point, axis));
            }
        }
    }
    Ok((solved, cofactors))
}
