//! The datum: the datum defect of a network without control, and the constraints that remove it.
//!
//! A similarity of the object (shift, rotation, and scale where no distance fixes it) changes no image coordinate. Its
//! seven (six) directions G span the null space of the normal equations:
//!
//! | | shift | rotation ω | scale |
//! | --- | --- | --- | --- |
//! | point X | I | ω × X | X |
//! | projection centre XL | I | ω × XL | XL |
//! | turn of the photo (camera axes) | 0 | -M ω | 0 |
//!
//! Inside, the iteration holds seven photo unknowns ("pins"), which keeps points free for elimination. Every datum of
//! the result, inner constraints as well as minimal ones on points, follows by the S-transformation (W. Baarda 1973)
//! Q' = S Q Sᵀ, S = I - G(DᵀG)⁻¹Dᵀ, with D = G on the datum points, or the seven held coordinates.

use nalgebra::{DMatrix, Matrix3, Rotation3, SVector, Vector3};

use crate::adjust::equations::ordering::Layout;
use crate::adjust::problem::network::Network;
use crate::adjust::problem::state::{State, rows};
use crate::error::{Error, Place, Reason, Result};
use crate::project::DatumKind;

/// Number of directions of a similarity.
pub const SIMILARITY: usize = 7;

/// Lengths and coordinates inside the frame that differ by less are the same: a sum over the points in another order is off by
/// rounding, 1e-14, and would choose another datum.
const ALIKE: f64 = 1e-9;

/// Directions of a similarity at one scalar unknown.
pub type Direction = [f64; SIMILARITY];

/// The datum of a network without control.
#[derive(Clone, Debug)]
pub struct FreeDatum {
    /// 7, or 6 where distances fix the scale.
    pub defect: usize,
    /// Coordinates (point, axis) that define the datum, ascending: those of a point are looked for by bisection, and the order in
    /// which the document names its datum points has no meaning.
    pub carriers: Vec<(usize, usize)>,
    /// Whether the carriers are held (minimal) rather than constrained on the whole (inner constraints).
    pub minimal: bool,
}

fn cross_rows(x: &[f64; 3]) -> [[f64; 3]; 3] {
    // Row a holds d(ω × X)_a / dω.
    [[0.0, x[2], -x[1]], [-x[2], 0.0, x[0]], [x[1], -x[0], 0.0]]
}

/// Directions at a point's, or projection centre's, coordinates.
pub fn at_point(x: &[f64; 3]) -> [Direction; 3] {
    let cross = cross_rows(x);
    std::array::from_fn(|a| {
        let mut row = [0.0; SIMILARITY];
        row[a] = 1.0;
        row[3..6].copy_from_slice(&cross[a]);
        row[6] = x[a];
        row
    })
}

/// Directions at a photo's unknowns: turn, then centre.
pub fn at_photo(m: &[[f64; 3]; 3], centre: &[f64; 3]) -> [Direction; 6] {
    let centre = at_point(centre);
    std::array::from_fn(|k| {
        if k >= 3 {
            return centre[k - 3];
        }
        let mut row = [0.0; SIMILARITY];
        (0..3).for_each(|j| row[3 + j] = -m[k][j]);
        row
    })
}

/// Chooses the datum's carriers; none under the control datum.
///
/// # Errors
/// [`Error::Invalid`] if the points named for the datum cannot define it.
pub fn free_datum(network: &Network, state: &State) -> Result<Option<FreeDatum>> {
    let defect = if network.bars.is_empty() { SIMILARITY } else { SIMILARITY - 1 };
    let all: Vec<usize> = (0..network.points.len()).collect();
    let points = network.datum_points.as_ref().unwrap_or(&all);
    let minimal = match network.datum {
        DatumKind::Control => return Ok(None),
        DatumKind::Minimal => true,
        DatumKind::Free => false,
    };
    let mut carriers = if minimal {
        minimal_carriers(network, state, points, defect)
    } else {
        points.iter().flat_map(|p| (0..3).map(move |a| (*p, a))).collect()
    };
    carriers.sort_unstable();
    carriers.dedup();
    let datum = FreeDatum { defect, carriers, minimal };
    if datum.is_regular(state) {
        return Ok(Some(datum));
    }
    Err(Error::Invalid { reason: Reason::DatumPoints, at: Place::field("datum.points") })
}

/// All coordinates of the two most distant points, and one of the point farthest from their line; with a known scale the
/// second point stays free along the line. Of points as far within rounding, as on a grid, that with the least coordinates: which
/// stands first in the document decides nothing.
fn minimal_carriers(network: &Network, state: &State, points: &[usize], defect: usize) -> Vec<(usize, usize)> {
    // Points with many rays first, since what is held should be well determined.
    let strong: Vec<usize> = points.iter().copied().filter(|p| network.points[*p].rays.len() >= 3).collect();
    let points = if strong.len() >= 3 { &strong } else { points };
    let at = |p: usize| Vector3::from(state.points[p]);
    let farthest = |measure: &dyn Fn(usize) -> f64| {
        let most = points.iter().map(|p| measure(*p)).fold(0.0, f64::max);
        let alike = points.iter().copied().filter(|p| measure(*p) >= most * (1.0 - ALIKE));
        alike.min_by(|a, b| {
            let apart = (0..3).find(|k| (at(*a)[*k] - at(*b)[*k]).abs() > ALIKE);
            apart.map_or(std::cmp::Ordering::Equal, |k| at(*a)[k].total_cmp(&at(*b)[k]))
        })
    };
    let centre = points.iter().map(|p| at(*p)).sum::<Vector3<f64>>() / points.len().max(1) as f64;
    let Some(first) = farthest(&|p| (at(p) - centre).norm()) else { return Vec::new() };
    let Some(second) = farthest(&|p| (at(p) - at(first)).norm()) else { return Vec::new() };
    let line = at(second) - at(first);
    let Some(third) = farthest(&|p| line.cross(&(at(p) - at(first))).norm()) else { return Vec::new() };
    let mut carriers: Vec<(usize, usize)> = (0..3).map(|a| (first, a)).collect();
    let along = largest(&line);
    carriers.extend((0..3).filter(|a| defect == SIMILARITY || *a != along).map(|a| (second, a)));
    carriers.push((third, largest(&line.cross(&(at(third) - at(first))))));
    carriers
}

/// The axis of the largest component; of those alike within rounding the first.
fn largest(v: &Vector3<f64>) -> usize {
    (0..3).find(|a| v[*a].abs() >= v.amax() * (1.0 - ALIKE)).unwrap_or(0)
}

impl FreeDatum {
    /// Directions at the carriers, one row each.
    fn matrix(&self, state: &State) -> DMatrix<f64> {
        DMatrix::from_fn(self.carriers.len(), self.defect, |k, j| {
            let (point, axis) = self.carriers[k];
            at_point(&state.points[point])[axis][j]
        })
    }

    fn is_regular(&self, state: &State) -> bool {
        if self.carriers.len() < self.defect {
            return false;
        }
        let g = self.matrix(state);
        let values = g.singular_values();
        values.min() > 1e-7 * values.max()
    }

    /// D: the directions on the carriers (inner constraints), or the held coordinates themselves; one row a carrier.
    pub fn constraint_rows(&self, state: &State) -> DMatrix<f64> {
        if self.minimal { DMatrix::identity(self.carriers.len(), self.carriers.len()) } else { self.matrix(state) }
    }

    /// (DᵀG)⁻¹; `None` if rounding leaves it singular.
    pub fn inverse_of_constrained(&self, state: &State) -> Option<DMatrix<f64>> {
        (self.constraint_rows(state).transpose() * self.matrix(state)).try_inverse()
    }

    /// Transforms the state by a similarity to the carriers' initial coordinates: exactly for held coordinates, in the
    /// sense of least squares for inner constraints.
    pub fn align(&self, state: &mut State, initial: &State) {
        for _ in 0..50 {
            let g = self.matrix(state);
            let difference = nalgebra::DVector::from_fn(self.carriers.len(), |k, _| {
                let (point, axis) = self.carriers[k];
                initial.points[point][axis] - state.points[point][axis]
            });
            let Some(found) = (g.transpose() * &g).cholesky().map(|c| c.solve(&(g.transpose() * difference))) else {
                return;
            };
            let mut parameters = SVector::<f64, SIMILARITY>::zeros();
            parameters.rows_mut(0, self.defect).copy_from(&found);
            transform(state, &parameters);
            if parameters.norm() < 1e-15 {
                return;
            }
        }
    }
}

/// Applies a similarity: shift, rotation vector, logarithm of the scale.
fn transform(state: &mut State, parameters: &SVector<f64, SIMILARITY>) {
    let shift = Vector3::new(parameters[0], parameters[1], parameters[2]);
    let rotation: Matrix3<f64> = Rotation3::new(Vector3::new(parameters[3], parameters[4], parameters[5])).into_inner();
    let scale = parameters[6].exp();
    let moved = |x: &[f64; 3]| -> [f64; 3] { (scale * (rotation * Vector3::from(*x)) + shift).into() };
    state.points.iter_mut().for_each(|x| *x = moved(x));
    for pose in &mut state.poses {
        pose.centre = moved(&pose.centre);
        pose.m = rows(&(pose.matrix() * rotation.transpose()));
    }
}

/// Photo unknowns whose holding takes up the datum: rows of G chosen one after the other, each the longest after what the
/// chosen ones span is taken away.
pub fn pins(layout: &Layout, state: &State, defect: usize) -> Vec<usize> {
    let mut left: Vec<(usize, Direction)> = state
        .poses
        .iter()
        .zip(&layout.photo)
        .flat_map(|(pose, &place)| {
            let rows = at_photo(&pose.m, &pose.centre);
            (0..6).map(move |k| (place + k, rows[k]))
        })
        .collect();
    left.iter_mut().for_each(|(_, row)| row[defect..].fill(0.0));
    let squared = |row: &Direction| row.iter().map(|x| x * x).sum::<f64>();
    let mut chosen = Vec::with_capacity(defect);
    for _ in 0..defect {
        let Some((place, row)) = left.iter().copied().max_by(|(_, a), (_, b)| squared(a).total_cmp(&squared(b))) else {
            break;
        };
        let length = squared(&row);
        chosen.push(place);
        for (_, other) in &mut left {
            let product: f64 = other.iter().zip(&row).map(|(a, b)| a * b).sum::<f64>() / length;
            other.iter_mut().zip(&row).for_each(|(a, b)| *a -= product * b);
        }
    }
    chosen
}

/// How many of the seven directions nothing given fixes, under the control datum.
pub fn missing_control(network: &Network, state: &State) -> usize {
    let mut given: Vec<Direction> = Vec::new();
    for (block, x) in network.points.iter().zip(&state.points) {
        let rows = at_point(x);
        given.extend((0..3).filter(|a| block.fixed[*a] || block.prior[*a].1 > 0.0).map(|a| rows[a]));
    }
    for (block, pose) in network.photos.iter().zip(&state.poses) {
        let rows = at_point(&pose.centre);
        given.extend((0..3).filter(|a| block.prior[*a].1 > 0.0).map(|a| rows[a]));
    }
    if !network.bars.is_empty() {
        given.push([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    }
    if given.is_empty() {
        return SIMILARITY;
    }
    let g = DMatrix::from_fn(given.len(), SIMILARITY, |i, j| given[i][j]);
    let values = (g.transpose() * g).symmetric_eigenvalues();
    let most = values.max();
    SIMILARITY - values.iter().filter(|v| **v > 1e-14 * most).count()
}
