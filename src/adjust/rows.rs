//! Linearised, weighted observation equations of one point: the rows of the design matrix, two per ray, that exist only
//! while the point is worked on.
//!
//! With p = M(X - XL) and the model's derivative J = ∂e/∂p, the turn t of the photo (M' = exp([t]×)M) and the shift of its
//! centre: ∂e/∂X = J·M, ∂e/∂XL = -J·M, ∂e/∂t = p × Jᵀ (per row).

use crate::adjustment::ResidualPlace;
use crate::camera::Model;

use super::network::{Network, PointBlock};
use super::parameters::State;

/// Weighted rows of one ray. `N` is the number of interior unknowns, padded with zeros.
#[derive(Clone, Copy, Debug)]
pub struct Row<const N: usize> {
    /// Photo.
    pub photo: usize,
    /// Interior orientation.
    pub interior: usize,
    /// Weighted residual, projection minus measurement.
    pub e: [f64; 2],
    /// By the point.
    pub point: [[f64; 3]; 2],
    /// By turn and centre of the photo.
    pub pose: [[f64; 6]; 2],
    /// By the scaled unknowns of the interior orientation.
    pub interior_rows: [[f64; N]; 2],
}

/// What the linearisation needs besides the state.
#[derive(Clone, Copy, Debug)]
pub struct Weighting<'a> {
    /// Where residuals are taken.
    pub place: ResidualPlace,
    /// Factors on the reciprocal standard errors (robust weighting), per ray; empty for none.
    pub robust: &'a [[f64; 2]],
    /// Shifts of the measurements in the units of the residuals (eccentricity), per ray; empty for none.
    pub shift: &'a [[f64; 2]],
}

/// Models of all interior orientations of a state; none where a principal distance is missing.
pub fn models(state: &State) -> Option<Vec<Model>> {
    state.interiors.iter().map(Model::new).collect()
}

/// Fills `rows` with the point's rays. Returns false where a projection does not exist.
#[inline(always)]
pub fn linearise<const N: usize>(
    network: &Network,
    state: &State,
    models: &[Model],
    weighting: Weighting<'_>,
    point: usize,
    rows: &mut Vec<Row<N>>,
    behind: &mut usize,
) -> bool {
    rows.clear();
    let block = &network.points[point];
    let x = &state.points[point];
    for k in block.rays.clone() {
        let ray = &network.rays[k];
        let interior = network.photos[ray.photo].interior;
        let pose = &state.poses[ray.photo];
        let p = pose.camera_point(x);
        *behind += usize::from(p[2] >= 0.0);
        let measured = match weighting.shift.get(k) {
            Some(shift) => [ray.measured[0] - shift[0], ray.measured[1] - shift[1]],
            None => ray.measured,
        };
        let Some(linear) = models[interior].linearise(measured, p, weighting.place) else { return false };
        let factor = weighting.robust.get(k).copied().unwrap_or([1.0, 1.0]);
        let mut row = Row {
            photo: ray.photo,
            interior,
            e: [0.0; 2],
            point: [[0.0; 3]; 2],
            pose: [[0.0; 6]; 2],
            interior_rows: [[0.0; N]; 2],
        };
        for side in 0..2 {
            let w = ray.weight[side] * factor[side];
            let [a, b, c] = linear.by_point[side].map(|d| d * w);
            row.e[side] = linear.residual[side] * w;
            let m = &pose.m;
            let by_point: [f64; 3] = std::array::from_fn(|k| a * m[0][k] + b * m[1][k] + c * m[2][k]);
            row.pose[side] = [
                p[1] * c - p[2] * b,
                p[2] * a - p[0] * c,
                p[0] * b - p[1] * a,
                -by_point[0],
                -by_point[1],
                -by_point[2],
            ];
            row.point[side] = std::array::from_fn(|k| if block.fixed[k] { 0.0 } else { by_point[k] });
            for (to, estimated) in row.interior_rows[side].iter_mut().zip(&network.interiors[interior].estimated) {
                *to = linear.by_parameter[side][estimated.column] * w * estimated.scale;
            }
        }
        rows.push(row);
    }
    true
}

/// Equations of the point alone, given coordinates included: normal matrix (xx, xy, xz, yy, yz, zz), Aᵀe, squares.
#[inline(always)]
pub fn point_equations<const N: usize>(block: &PointBlock, x: &[f64; 3], rows: &[Row<N>]) -> ([f64; 6], [f64; 3], f64) {
    let (mut n, mut g, mut cost) = ([0.0; 6], [0.0; 3], 0.0);
    for row in rows {
        for (a, e) in row.point.iter().zip(row.e) {
            n[0] += a[0] * a[0];
            n[1] += a[0] * a[1];
            n[2] += a[0] * a[2];
            n[3] += a[1] * a[1];
            n[4] += a[1] * a[2];
            n[5] += a[2] * a[2];
            (0..3).for_each(|k| g[k] += a[k] * e);
            cost += e * e;
        }
    }
    for a in 0..3 {
        let (given, weight) = block.prior[a];
        let e = (x[a] - given) * weight;
        cost += e * e;
        g[a] += e * weight;
        n[[0, 3, 5][a]] += weight * weight;
    }
    (n, g, cost)
}
