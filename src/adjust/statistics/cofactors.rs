//! Cofactors of all unknowns and of all adjusted observations, without the full inverse.
//!
//! With Z = GᵀB per point (see [`crate::adjust::equations::normal`]), Q = S⁻¹ and K of [`super::ray_cofactors`]:
//!
//! ```text
//! Q_pp = L⁻ᵀ(I + ZᵀQZ)L⁻¹ = L⁻ᵀKL⁻¹,   Q_cp = -QZ·L⁻¹
//! ```
//!
//! so that only the blocks of Q between photos that share a point are needed. The cofactor of an adjusted observation is
//! its row times these; the datum of the unknowns is set by the S-transformation of [`crate::adjust::datum::free`].

use nalgebra::{DMatrix, Matrix3, Matrix6, SMatrix};

use crate::adjust::datum::free::{self, FreeDatum, SIMILARITY, at_point};
use crate::adjust::datum::s_transformation::{carried, transformation, transformed};
use crate::adjust::equations::collinearity::{CollinearityRows, Linearisation};
use crate::adjust::equations::context::Context;
use crate::adjust::equations::normal::{ReducedNormalEquations, with_interior_size};
use crate::adjust::linear::cholesky3::{backward3, forward3};
use crate::adjust::linear::kernel::TILE;
use crate::adjust::linear::tiles::TileMatrix;
use crate::adjust::problem::additional::distance_row;

use super::external_reliability::{
    Blocks, DatumCofactors, DatumCorrections, ExternalEffects, ShiftTransformation, length,
};
use super::ray_cofactors::{RayCofactors, at_photo};

/// Cofactors in the scaled unknowns of the frame of the adjustment.
#[derive(Clone, Debug, Default)]
pub struct Cofactors {
    /// Per photo: turn, centre.
    pub photos: Vec<Matrix6<f64>>,
    /// Per photo: its six unknowns by those of its interior orientation.
    pub photo_interior: Vec<DMatrix<f64>>,
    /// Per interior orientation.
    pub interiors: Vec<DMatrix<f64>>,
    /// Per point.
    pub points: Vec<Matrix3<f64>>,
    /// Per ray and side: cofactor of the weighted adjusted observation, 1 - r. Empty unless wanted.
    pub rays: Vec<[f64; 2]>,
    /// Per ray and side: shift of its own point, in the datum, by a unit of weighted observation error. Empty unless wanted.
    pub influence: Vec<[f64; 2]>,
    /// Shifts by given observations. Empty unless wanted.
    pub additional_influence: ExternalEffects,
    /// Per distance: cofactor of the weighted adjusted distance.
    pub bars: Vec<f64>,
    /// Per point and axis before the S-transformation, for given coordinates.
    pub additional_points: Vec<[f64; 3]>,
}

/// Beyond this a cofactor's products with scales and variances overflow.
const LARGEST: f64 = 1e150;

impl Cofactors {
    /// Whether all are numbers that can be reckoned with: equations whose pivots pass for sound may leave others, at values far
    /// beyond anything measured.
    pub fn are_sound(&self) -> bool {
        let matrices = self.photo_interior.iter().chain(&self.interiors).flat_map(|q| q.iter());
        let own = self.photos.iter().flat_map(|q| q.iter()).chain(self.points.iter().flat_map(|q| q.iter()));
        let rays = self.rays.iter().chain(&self.influence).flatten();
        let given = self.additional_points.iter().flatten().chain(&self.bars);
        let sound = |x: &f64| x.abs() < LARGEST;
        matrices.chain(own).chain(rays).chain(given).all(sound) && self.additional_influence.shifts().all(|x| sound(&x))
    }
}

/// Computes cofactors from undamped, factored equations at `state`; `None` if a projection does not exist.
pub fn cofactors(
    normal: &ReducedNormalEquations,
    context: Context<'_>,
    datum: Option<&FreeDatum>,
    full: bool,
) -> Option<Cofactors> {
    with_interior_size!(context.network, compute(normal, context, datum, full))
}

/// A block of the inverse, stored by columns, or by rows if `turned`.
pub struct CofactorBlock<'a> {
    data: &'a [f64],
    turned: bool,
}

impl CofactorBlock<'_> {
    #[inline(always)]
    pub fn get(&self, i: usize, j: usize) -> f64 {
        if self.turned { self.data[i * TILE + j] } else { self.data[j * TILE + i] }
    }

    /// Column `j` from its first number on, where its numbers stand side by side.
    pub fn column(&self, j: usize) -> Option<&[f64]> {
        (!self.turned).then(|| &self.data[j * TILE..])
    }
}

pub fn block(q: &TileMatrix, row: usize, column: usize) -> CofactorBlock<'_> {
    let turned = row < column;
    let at = if turned { q.place(column, row) } else { q.place(row, column) };
    CofactorBlock { data: &q.data()[at..], turned }
}

fn compute<const N: usize>(
    normal: &ReducedNormalEquations,
    context: Context<'_>,
    datum: Option<&FreeDatum>,
    full: bool,
) -> Option<Cofactors> {
    let Context { network, layout, state, .. } = context;
    let linearisation = Linearisation::<N>::new(context)?;
    let inverse = normal.matrix.inverse();
    let transformation = match datum {
        Some(datum) => Some(transformation(normal, context, datum)?),
        None => None,
    };
    let mut result = Cofactors {
        rays: if full { vec![[0.0; 2]; network.rays.len()] } else { Vec::new() },
        influence: if full { vec![[0.0; 2]; network.rays.len()] } else { Vec::new() },
        additional_influence: if full { ExternalEffects::new(network) } else { ExternalEffects::default() },
        ..Cofactors::default()
    };
    let blocks = Blocks { context, transformation: transformation.as_ref() };
    reduced_blocks(&mut result, &blocks, &inverse);

    let alignment = transformation.as_ref().map(|t| ShiftTransformation::<N>::new(t, context));
    let mut room = Vec::new();
    let mut rays = RayCofactors::<N>::default();
    let mut taken: Vec<DatumCorrections> = Vec::new();
    let mut behind = 0;
    for (point, network_point) in network.points.iter().enumerate() {
        let rows = linearisation.point(point, &mut room, &mut behind)?;
        if network_point.kept {
            let q = kept_point(&mut result, &blocks, &inverse, alignment.as_ref(), point, rows, full);
            push_point(&mut result, &blocks, point, q, |at, v| v[at]);
            continue;
        }
        let l = normal.eliminated.factors[point].l;
        rays.compute(&inverse, layout, &normal.eliminated, point, rows);
        taken.clear();
        taken.extend(alignment.iter().flat_map(|alignment| rows.iter().map(|row| alignment.reduced(row))));
        let at_this_point = transformation.as_ref().map(|t| {
            let own = carried(t, datum, point);
            let from_reduced = rays.carried(&taken);
            let mut v: DatumCofactors = [[0.0; 3]; SIMILARITY];
            for (j, (v, own)) in v.iter_mut().zip(own).enumerate() {
                let direct = forward3(&l, own);
                *v = backward3(&l, std::array::from_fn(|m| direct[m] - from_reduced[m][j]));
            }
            v
        });
        if full {
            let at_photo = |photo| at_photo::<N>(&inverse, network, layout, &normal.eliminated, point, photo);
            let at_interiors = (normal.eliminated.own(point), &rays.interiors[..]);
            result.additional_influence.eliminated(&blocks, point, &l, at_photo, at_interiors);
            for (n, row) in rows.iter().enumerate() {
                let ray = network_point.rays.start + n;
                let (cofactors, mut shifts) = rays.ray(n, &l);
                if let (Some(alignment), Some(v)) = (&alignment, &at_this_point) {
                    alignment.align((point, v), (row, &taken[n]), &mut shifts);
                }
                result.rays[ray] = cofactors;
                result.influence[ray] = shifts.map(|shift| length(&shift, &network_point.fixed));
            }
        }
        // Columns of L⁻ᵀ.
        let columns: [[f64; 3]; 3] = std::array::from_fn(|m| {
            let mut unit = [0.0; 3];
            unit[m] = 1.0;
            backward3(&l, unit)
        });
        let lower = Matrix3::from_fn(|i, j| columns[j][i]);
        let k = Matrix3::from_fn(|i, j| rays.k[i][j]);
        let mut q = lower * k * lower.transpose();
        for a in (0..3).filter(|a| network_point.fixed[*a]) {
            q.row_mut(a).fill(0.0);
            q.column_mut(a).fill(0.0);
        }
        if full {
            result.additional_influence.own(network, point, |a| q.column(a).into());
        }
        push_point(&mut result, &blocks, point, q, |_, _| 0.0);
        if let (Some(t), Some(v)) = (&transformation, at_this_point) {
            let rows = at_point(&state.points[point]);
            let v = SMatrix::<f64, SIMILARITY, 3>::from_fn(|j, a| v[j][a]);
            if let Some(last) = result.points.last_mut() {
                *last = transformed(&q, &SMatrix::<f64, 3, SIMILARITY>::from_fn(|a, j| rows[a][j]), &v, t);
            }
        }
    }
    for &(point, axis) in datum.iter().filter(|d| d.minimal).flat_map(|d| &d.carriers) {
        // What is held has no error, not even that of rounding.
        result.points[point].row_mut(axis).fill(0.0);
        result.points[point].column_mut(axis).fill(0.0);
    }
    for bar in &network.bars {
        let (_, rows) = distance_row(network, state, bar);
        let places = [layout.point[bar.from], layout.point[bar.to]];
        let at = |k: usize| places[k / 3] + k % 3;
        let sum = (0..36).map(|n| rows[n / 6] * rows[n % 6] * block(&inverse, at(n / 6), at(n % 6)).data[0]);
        result.bars.push(sum.sum());
    }
    if full {
        result.additional_influence.distances(&blocks, &inverse);
    }
    Some(result)
}

fn push_point(
    result: &mut Cofactors,
    &Blocks { context: Context { network, layout, state, .. }, transformation }: &Blocks<'_>,
    point: usize,
    q: Matrix3<f64>,
    reduced: impl Fn(usize, &[f64]) -> f64,
) {
    result.additional_points.push([q[(0, 0)], q[(1, 1)], q[(2, 2)]]);
    let q = match transformation {
        Some(t) if network.points[point].kept => {
            let rows = at_point(&state.points[point]);
            let at = layout.point[point];
            let v = SMatrix::<f64, SIMILARITY, 3>::from_fn(|j, a| t.v.get(j).map_or(0.0, |v| reduced(at + a, v)));
            transformed(&q, &SMatrix::<f64, 3, SIMILARITY>::from_fn(|a, j| rows[a][j]), &v, t)
        }
        _ => q,
    };
    result.points.push(q);
}

/// Cofactor of the photo and interior part of a row.
fn reduced_square<const N: usize>(
    Context { network, layout, .. }: Context<'_>,
    inverse: &TileMatrix,
    row: &CollinearityRows<N>,
    side: usize,
) -> f64 {
    let (photo, interior) = (layout.photo[row.photo], layout.interior[row.interior]);
    let (g, c) = (&row.pose[side], &row.interior_rows[side]);
    let length = network.interiors[row.interior].estimated.len();
    let mut sum = 0.0;
    let own = block(inverse, photo, photo);
    for j in 0..6 {
        sum += g[j] * (0..6).map(|i| own.get(i, j) * g[i]).sum::<f64>();
    }
    if length > 0 {
        let own = block(inverse, interior, interior);
        let cross = block(inverse, interior, photo);
        for j in 0..length {
            sum += c[j] * (0..length).map(|i| own.get(i, j) * c[i]).sum::<f64>();
            sum += 2.0 * c[j] * (0..6).map(|i| cross.get(j, i) * g[i]).sum::<f64>();
        }
    }
    sum
}

/// Cofactor of a kept point, and of its rays.
fn kept_point<const N: usize>(
    result: &mut Cofactors,
    blocks: &Blocks<'_>,
    inverse: &TileMatrix,
    alignment: Option<&ShiftTransformation<'_, N>>,
    point: usize,
    rows: &[CollinearityRows<N>],
    full: bool,
) -> Matrix3<f64> {
    let &Blocks { context, transformation } = blocks;
    let Context { network, layout, .. } = context;
    let place = layout.point[point];
    let own = block(inverse, place, place);
    let mut q = Matrix3::from_fn(|i, j| own.get(i, j));
    let fixed = &network.points[point].fixed;
    for a in (0..3).filter(|a| fixed[*a]) {
        q.row_mut(a).fill(0.0);
        q.column_mut(a).fill(0.0);
    }
    if full {
        result.additional_influence.kept(blocks, inverse, point);
        result.additional_influence.own(network, point, |a| q.column(a).into());
        let mut v: DatumCofactors = [[0.0; 3]; SIMILARITY];
        for (v, reduced) in v.iter_mut().zip(transformation.iter().flat_map(|t| &t.v)) {
            v.copy_from_slice(&reduced[place..place + 3]);
        }
        for (n, row) in rows.iter().enumerate() {
            let ray = network.points[point].rays.start + n;
            let photo = block(inverse, place, layout.photo[row.photo]);
            let length = network.interiors[row.interior].estimated.len();
            let mut shifts = [[0.0; 3]; 2];
            for side in 0..2 {
                let a = nalgebra::Vector3::from(row.point[side]);
                let mut shift = q * a;
                for k in (0..3).filter(|k| !fixed[*k]) {
                    shift[k] += (0..6).map(|j| photo.get(k, j) * row.pose[side][j]).sum::<f64>();
                    if length > 0 {
                        let interior = block(inverse, place, layout.interior[row.interior]);
                        shift[k] += (0..length).map(|j| interior.get(k, j) * row.interior_rows[side][j]).sum::<f64>();
                    }
                }
                let own = reduced_square(context, inverse, row, side);
                result.rays[ray][side] = own + 2.0 * a.dot(&shift) - a.dot(&(q * a));
                shifts[side] = shift.into();
            }
            if let Some(alignment) = alignment {
                alignment.align((point, &v), (row, &alignment.reduced(row)), &mut shifts);
            }
            result.influence[ray] = shifts.map(|shift| nalgebra::Vector3::from(shift).norm());
        }
    }
    q
}

/// Blocks of photos and interior orientations, in the datum.
fn reduced_blocks(
    result: &mut Cofactors,
    &Blocks { context: Context { network, layout, state, .. }, transformation }: &Blocks<'_>,
    inverse: &TileMatrix,
) {
    for (k, block_of_photo) in network.photos.iter().enumerate() {
        let place = layout.photo[k];
        let own = block(inverse, place, place);
        let mut q = Matrix6::from_fn(|i, j| own.get(i, j));
        let at = layout.interior[block_of_photo.interior];
        let length = network.interiors[block_of_photo.interior].estimated.len();
        let mut cross = DMatrix::zeros(6, length);
        if length > 0 {
            let with_interior = block(inverse, place, at);
            cross = DMatrix::from_fn(6, length, |i, j| with_interior.get(i, j));
        }
        if let Some(t) = transformation {
            let rows = free::at_photo(&state.poses[k].m, &state.poses[k].centre);
            let g = SMatrix::<f64, 6, SIMILARITY>::from_fn(|i, j| rows[i][j]);
            let v = |at: usize, j: usize| t.v.get(j).map_or(0.0, |v| v[at]);
            q = transformed(&q, &g, &SMatrix::<f64, SIMILARITY, 6>::from_fn(|j, i| v(place + i, j)), t);
            for i in 0..6 {
                for n in 0..length {
                    cross[(i, n)] -= (0..t.defect).map(|j| g[(i, j)] * v(at + n, j)).sum::<f64>();
                }
            }
        }
        result.photos.push(q);
        result.photo_interior.push(cross);
    }
    for (interior, &at) in network.interiors.iter().zip(&layout.interior) {
        let length = interior.estimated.len();
        result.interiors.push(if length == 0 {
            DMatrix::zeros(0, 0)
        } else {
            let own = block(inverse, at, at);
            DMatrix::from_fn(length, length, |i, j| own.get(i, j))
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn one_number_beyond_reckoning_makes_all_unsound() {
        let sound = Cofactors {
            rays: vec![[0.5; 2]],
            points: vec![Matrix3::identity()],
            bars: vec![0.2],
            ..Cofactors::default()
        };
        assert!(sound.are_sound());
        for bad in [f64::NAN, f64::INFINITY, -1e200] {
            let mut point = sound.clone();
            point.points[0][(1, 2)] = bad;
            let mut ray = sound.clone();
            ray.rays[0][1] = bad;
            let mut given = sound.clone();
            given.additional_influence.bars.push((bad, 0));
            let photo = Cofactors { photos: vec![Matrix6::from_element(bad)], ..sound.clone() };
            assert!([point, ray, given, photo].iter().all(|c| !c.are_sound()), "{bad}");
        }
    }
}
