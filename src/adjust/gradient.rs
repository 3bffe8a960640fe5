//! The weighted squares of a state and their gradient, without the normal matrix.

use crate::camera::Model;

use super::layout::Layout;
use super::network::Network;
use super::normal::{Normal, bar_row};
use super::parameters::State;
use super::rows::{Row, Weighting, linearise, models, point_equations};
use super::triple::forward3;

/// vᵀPv of a state without its normal equations, and the number of rays behind their camera; none where a projection
/// does not exist.
pub fn cost(network: &Network, state: &State, weighting: Weighting<'_>) -> Option<(f64, usize)> {
    let models = models(state)?;
    let (mut sum, mut behind) = (0.0, 0);
    let mut rows: Vec<Row<0>> = Vec::new();
    for point in 0..network.points.len() {
        if !linearise(network, state, &models, weighting, point, &mut rows, &mut behind) {
            return None;
        }
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
    sum += network.bars.iter().map(|bar| bar_row(network, state, bar).0.powi(2)).sum::<f64>();
    sum.is_finite().then_some((sum, behind))
}

/// Residuals of all rays over their a priori standard errors, whatever their robust weights.
pub fn weighted_residuals(network: &Network, state: &State, weighting: Weighting<'_>) -> Option<Vec<[f64; 2]>> {
    let models = models(state)?;
    let weighting = Weighting { robust: &[], ..weighting };
    let mut rows: Vec<Row<0>> = Vec::new();
    let mut behind = 0;
    let mut residuals = Vec::with_capacity(network.rays.len());
    for point in 0..network.points.len() {
        if !linearise(network, state, &models, weighting, point, &mut rows, &mut behind) {
            return None;
        }
        residuals.extend(rows.iter().map(|row| row.e));
    }
    Some(residuals)
}

/// All points' contributions to the right-hand side, their elimination being the one at hand. Returns false where a
/// projection does not exist.
pub fn gradient<const N: usize>(
    normal: &mut Normal,
    network: &Network,
    layout: &Layout,
    state: &State,
    models: &[Model],
    weighting: Weighting<'_>,
) -> bool {
    let mut rows: Vec<Row<N>> = Vec::new();
    let mut behind = 0;
    for (point, block) in network.points.iter().enumerate() {
        if !linearise(network, state, models, weighting, point, &mut rows, &mut behind) {
            return false;
        }
        let (_, g, cost) = point_equations(block, &state.points[point], &rows);
        normal.cost += cost;
        for row in &rows {
            let [ex, ey] = row.e;
            let [a, b] = &row.pose;
            let place = layout.photo[row.photo];
            for (k, rhs) in normal.rhs[place..place + 6].iter_mut().enumerate() {
                *rhs -= a[k] * ex + b[k] * ey;
            }
            let place = layout.interior[row.interior];
            let length = network.interiors[row.interior].estimated.len();
            let [a, b] = &row.interior_rows;
            for (rhs, (a, b)) in normal.rhs[place..place + length].iter_mut().zip(a.iter().zip(b)) {
                *rhs -= a * ex + b * ey;
            }
        }
        if block.kept {
            (0..3).for_each(|k| normal.rhs[layout.point[point] + k] -= g[k]);
        } else {
            let factor = &mut normal.eliminated.factors[point];
            factor.h = forward3(&factor.l, g);
            let h = factor.h.map(|h| -h);
            normal.eliminated.subtract(network, layout, point, &h, &mut normal.rhs);
        }
    }
    normal.behind = behind;
    true
}
