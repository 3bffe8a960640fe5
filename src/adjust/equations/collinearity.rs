//! Linearised, weighted observation equations of one point: the rows of the design matrix, two per ray, that exist only
//! while the point is worked on.
//!
//! With p = M(X - XL) and the model's derivative J = ∂e/∂p, the turn t of the photo (M' = exp([t]×)M) and the shift of its
//! centre: ∂e/∂X = J·M, ∂e/∂XL = -J·M, ∂e/∂t = p × Jᵀ (per row).

use crate::adjust::problem::network::{ImageObservation, Network, PointBlock};
use crate::adjust::problem::state::{ExteriorOrientation, State};
use crate::adjustment::ResidualPlace;
use crate::camera::{Brown, Linearised, Model, PARAMETERS};

use super::context::{Context, Weighting};

/// Weighted rows of one ray. `N` is the number of interior unknowns, padded with zeros.
#[derive(Clone, Copy, Debug)]
pub struct CollinearityRows<const N: usize> {
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

impl<const N: usize> CollinearityRows<N> {
    /// Nothing.
    pub const ZERO: Self = Self {
        photo: 0,
        interior: 0,
        e: [0.0; 2],
        point: [[0.0; 3]; 2],
        pose: [[0.0; 6]; 2],
        interior_rows: [[0.0; N]; 2],
    };
}

/// The linearisation of all rays at a state.
pub struct Linearisation<'a, const N: usize> {
    network: &'a Network,
    state: &'a State,
    weighting: Weighting<'a>,
    /// Of the interior orientations.
    models: Vec<Model>,
    /// Per interior orientation the column of every unknown among the model's derivatives, and its scale, 0 for none.
    columns: Vec<[(usize, f64); N]>,
    /// Whether all unknowns are in the order of the model's first columns.
    ordered: bool,
}

impl<'a, const N: usize> Linearisation<'a, N> {
    /// `None` if a principal distance is missing.
    pub fn new(context: Context<'a>) -> Option<Self> {
        let Context { network, state, weighting, .. } = context;
        let models = state.interiors.iter().map(Model::new).collect::<Option<_>>()?;
        let columns = network.interiors.iter().map(|interior| {
            let of = |k: usize| interior.estimated.get(k).map_or((k, 0.0), |e| (e.column, e.scale));
            std::array::from_fn(of)
        });
        let columns: Vec<[(usize, f64); N]> = columns.collect();
        let ordered = columns.iter().all(|columns| columns.iter().enumerate().all(|(k, (column, _))| k == *column));
        Some(Self { network, state, weighting, models, columns, ordered })
    }

    /// Rows of the point's rays, in `room`; `None` if a projection does not exist. Counts rays behind their camera.
    pub fn point<'r>(
        &self,
        point: usize,
        room: &'r mut Vec<CollinearityRows<N>>,
        behind: &mut usize,
    ) -> Option<&'r [CollinearityRows<N>]> {
        let block = &self.network.points[point];
        let x = &self.state.points[point];
        let count = block.rays.len();
        if room.len() < count {
            room.resize(count, CollinearityRows::ZERO);
        }
        let rows = &mut room[..count];
        for (k, row) in block.rays.clone().zip(&mut *rows) {
            let ray = &self.network.rays[k];
            row.photo = ray.photo;
            let photo = &self.network.photos[ray.photo];
            row.interior = photo.interior;
            let seen = RayContext {
                pose: &self.state.poses[ray.photo],
                ray,
                shift: self.weighting.shift.get(k).unwrap_or(&[0.0; 2]),
                factor: self.weighting.robust.get(k).unwrap_or(&[1.0; 2]),
                columns: &self.columns[row.interior],
            };
            *behind += match (&self.models[photo.interior], self.weighting.place) {
                (Model::Brown(brown), ResidualPlace::Corrected) if self.ordered => brown_row(brown, &seen, x, row)?,
                (model, place) => model_row(model, place, &seen, x, row)?,
            };
            for a in (0..3).filter(|a| block.fixed[*a]) {
                (row.point[0][a], row.point[1][a]) = (0.0, 0.0);
            }
        }
        Some(rows)
    }
}

/// Input of a ray's rows besides the point and the camera model.
struct RayContext<'a, const N: usize> {
    pose: &'a ExteriorOrientation,
    ray: &'a ImageObservation,
    shift: &'a [f64; 2],
    factor: &'a [f64; 2],
    columns: &'a [(usize, f64); N],
}

impl<const N: usize> RayContext<'_, N> {
    #[inline(always)]
    fn measured(&self) -> [f64; 2] {
        std::array::from_fn(|s| self.ray.measured[s] - self.shift[s])
    }

    /// Fills the rows in; `by_unknown` gives the derivatives of a side. Returns 1 for a depth that is not in front, else 0.
    #[inline(always)]
    fn fill(
        &self,
        p: [f64; 3],
        linear: &Linearised,
        row: &mut CollinearityRows<N>,
        by_unknown: impl Fn(&[f64; PARAMETERS], &mut [f64; N]),
    ) -> usize {
        for side in 0..2 {
            let w = self.ray.sqrt_weight[side] * self.factor[side];
            let [a, b, c] = linear.by_point[side].map(|d| d * w);
            row.e[side] = linear.residual[side] * w;
            let m = &self.pose.m;
            let by_point: [f64; 3] = std::array::from_fn(|k| a * m[0][k] + b * m[1][k] + c * m[2][k]);
            row.pose[side] = [
                p[1] * c - p[2] * b,
                p[2] * a - p[0] * c,
                p[0] * b - p[1] * a,
                -by_point[0],
                -by_point[1],
                -by_point[2],
            ];
            row.point[side] = by_point;
            by_unknown(&linear.by_parameter[side], &mut row.interior_rows[side]);
            row.interior_rows[side].iter_mut().for_each(|d| *d *= w);
        }
        usize::from(p[2] >= 0.0)
    }
}

/// The most frequent case, whose derivatives stay in registers: not inlined, or they would not.
#[inline(never)]
fn brown_row<const N: usize>(
    brown: &Brown,
    seen: &RayContext<'_, N>,
    x: &[f64; 3],
    row: &mut CollinearityRows<N>,
) -> Option<usize> {
    let p = seen.pose.camera_point(x);
    let linear = brown.linearise(seen.measured(), p)?;
    Some(seen.fill(p, &linear, row, |by_parameter, to| {
        for k in 0..N {
            to[k] = by_parameter[k] * seen.columns[k].1;
        }
    }))
}

#[inline(never)]
fn model_row<const N: usize>(
    model: &Model,
    place: ResidualPlace,
    seen: &RayContext<'_, N>,
    x: &[f64; 3],
    row: &mut CollinearityRows<N>,
) -> Option<usize> {
    let p = seen.pose.camera_point(x);
    let linear = model.linearise(seen.measured(), p, place)?;
    let behind = seen.fill(p, &linear, row, |by_parameter, to| {
        for (to, (column, scale)) in to.iter_mut().zip(seen.columns) {
            *to = by_parameter[*column] * scale;
        }
    });
    Some(if model.is_wide() { 0 } else { behind })
}

/// Equations of the point alone, given coordinates included: normal matrix (xx, xy, xz, yy, yz, zz), Aᵀe, squares.
#[inline(never)]
pub fn point_equations<const N: usize>(
    block: &PointBlock,
    x: &[f64; 3],
    rows: &[CollinearityRows<N>],
) -> ([f64; 6], [f64; 3], f64) {
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
