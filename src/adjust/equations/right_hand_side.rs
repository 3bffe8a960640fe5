//! The weighted sum of squares of a state and its gradient, without the normal matrix.

use crate::adjust::linear::blocks::add_rows;
use crate::adjust::linear::cholesky3::{backward3, forward3};
use crate::adjust::problem::additional::distance_row;

use super::collinearity::{Linearisation, point_equations};
use super::context::{Context, Weighting};
use super::normal::ReducedNormalEquations;

/// vᵀPv of a state without its normal equations, and the number of rays behind their camera; `None` if a projection
/// does not exist.
pub fn cost(context: Context<'_>) -> Option<(f64, usize)> {
    let Context { network, state, .. } = context;
    let linearisation = Linearisation::<0>::new(context)?;
    let (mut sum, mut behind, mut room) = (0.0, 0, Vec::new());
    for point in 0..network.points.len() {
        let rows = linearisation.point(point, &mut room, &mut behind)?;
        sum += rows.iter().map(|r| r.e[0] * r.e[0] + r.e[1] * r.e[1]).sum::<f64>();
    }
    let prior = |(given, weight): (f64, f64), value: f64| ((value - given) * weight).powi(2);
    for (block, x) in network.points.iter().zip(&state.points) {
        sum += (0..3).map(|a| prior(block.prior[a], x[a])).sum::<f64>();
    }
    for (block, pose) in network.photos.iter().zip(&state.poses) {
        sum += (0..3).map(|a| prior(block.prior[a], pose.centre[a])).sum::<f64>();
    }
    for (block, interior) in network.interiors.iter().zip(&state.interiors) {
        for estimated in &block.estimated {
            sum += prior(estimated.prior, interior.get(estimated.parameter).unwrap_or_default());
        }
    }
    sum += network.bars.iter().map(|bar| distance_row(network, state, bar).0.powi(2)).sum::<f64>();
    sum += network.rig.iter().map(|member| member.cost(state)).sum::<f64>();
    sum.is_finite().then_some((sum, behind))
}

/// Residuals of all rays over their a priori standard errors, whatever their robust weights.
pub fn weighted_residuals(context: Context<'_>) -> Option<Vec<[f64; 2]>> {
    let Context { network, weighting, .. } = context;
    let weighting = Weighting { robust: &[], ..weighting };
    let linearisation = Linearisation::<0>::new(Context { weighting, ..context })?;
    let (mut behind, mut room) = (0, Vec::new());
    let mut residuals = Vec::with_capacity(network.rays.len());
    for point in 0..network.points.len() {
        let rows = linearisation.point(point, &mut room, &mut behind)?;
        residuals.extend(rows.iter().map(|row| row.e));
    }
    Some(residuals)
}

/// All points' contributions to the right-hand side, with the present elimination: with the point's own step
/// t = -L⁻ᵀh every ray is left with e + At, and GᵀB h need not be formed. `None` if a projection does not exist.
pub fn gradient<const N: usize>(normal: &mut ReducedNormalEquations, context: Context<'_>) -> Option<()> {
    let Context { network, layout, state, .. } = context;
    let linearisation = Linearisation::<N>::new(context)?;
    let (mut behind, mut room) = (0, Vec::new());
    for (point, block) in network.points.iter().enumerate() {
        let rows = linearisation.point(point, &mut room, &mut behind)?;
        let (_, g, cost) = point_equations(block, &state.points[point], rows);
        normal.cost += cost;
        let mut t = [0.0; 3];
        if block.kept {
            (0..3).for_each(|k| normal.rhs[layout.point[point] + k] -= g[k]);
        } else {
            let factor = &mut normal.eliminated.factors[point];
            factor.h = forward3(&factor.l, g);
            t = backward3(&factor.l, factor.h);
        }
        for row in rows {
            let left: [f64; 2] = std::array::from_fn(|s| {
                let [a, b, c] = row.point[s];
                a * t[0] + b * t[1] + c * t[2] - row.e[s]
            });
            let rhs = &mut normal.rhs;
            add_rows::<false, 2, 6>(&mut rhs[layout.photo[row.photo]..], &left, &row.pose);
            // The unused numbers of an interior orientation are zeros, and its block has room for them.
            add_rows::<false, 2, N>(&mut rhs[layout.interior[row.interior]..], &left, &row.interior_rows);
        }
    }
    normal.behind = behind;
    Some(())
}
