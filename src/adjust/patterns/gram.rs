//! The part of displacement fields that the unknowns do not absorb: G = ZᵀPRZ and b = ZᵀP(e + Aδ), with R = I - AN⁻¹AᵀP, and fields
//! removed one after the other.
//!
//! δ is the step that the converged equations still ask for, some 1e-8 standard errors: of a field of which the unknowns leave a thousandth
//! it would change b by a thousand times that.
//!
//! Sweeping a field j takes its part out of all others: G_ik -= G_ij G_jk / G_jj, b_i -= G_ij b_j / G_jj, and lowers eᵀPe by b_j² / G_jj. A
//! group of fields lowers it by the sum over its sweeps, χ² = bᵀG⁻¹b.

use nalgebra::{DMatrix, DVector};

use crate::adjust::equations::back_substitution::Full;
use crate::adjust::equations::collinearity::Linearisation;
use crate::adjust::equations::normal::with_interior_size;
use crate::adjust::problem::network::Network;
use crate::adjust::problem::step::Step;
use crate::adjust::solve::session::Session;
use crate::adjustment::ResidualPlace;

use super::basis::{Basis, BasisEntry};

/// A field of which the unknowns leave less than this part of its squares is taken over by them: G is the difference of numbers that are
/// good to some 1e-10 of ZᵀPZ, and keeps five digits above it. A three hundredth of its size.
const ABSORBED: f64 = 1e-5;

/// Fields with what the unknowns and the fields swept so far leave of them.
#[derive(Clone)]
pub struct Gram {
    g: DMatrix<f64>,
    b: DVector<f64>,
    /// ZᵀPZ, its diagonal.
    raw: Vec<f64>,
}

/// N⁻¹AᵀPZ: what the unknowns do about the fields.
pub struct Response {
    solved: Vec<Full>,
}

/// Sums over the rays: AᵀPZ, ZᵀPZ, ZᵀPe.
struct GramMatrices {
    by_unknown: Vec<Full>,
    squares: DMatrix<f64>,
    b: DVector<f64>,
}

fn sums<const N: usize>(
    session: &Session<'_>,
    place: ResidualPlace,
    basis: &Basis,
    step: &Step,
) -> Option<GramMatrices> {
    let (_, layout) = session.factored();
    let network = &session.network;
    let count = basis.len();
    let mut sums = GramMatrices {
        by_unknown: vec![Full::zeros(network, layout); count],
        squares: DMatrix::zeros(count, count),
        b: DVector::zeros(count),
    };
    let linearisation = Linearisation::<N>::new(session.context(place))?;
    let (mut behind, mut room, mut entries) = (0, Vec::new(), Vec::<BasisEntry>::new());
    for (point, block) in network.points.iter().enumerate() {
        let rows = linearisation.point(point, &mut room, &mut behind)?;
        for (ray, row) in block.rays.clone().zip(rows) {
            basis.at(ray, row, &mut entries);
            let (photo, interior) = (layout.photo[row.photo], layout.interior[row.interior]);
            let unknowns = network.interiors[row.interior].estimated.len();
            let e: [f64; 2] = std::array::from_fn(|s| {
                let pose: f64 = row.pose[s].iter().zip(&step.photos[row.photo]).map(|(a, d)| a * d).sum();
                let own: f64 = row.interior_rows[s].iter().zip(&step.interiors[row.interior]).map(|(a, d)| a * d).sum();
                let of_point: f64 = row.point[s].iter().zip(&step.points[point]).map(|(a, d)| a * d).sum();
                row.e[s] + pose + own + of_point
            });
            for (n, &(k, z)) in entries.iter().enumerate() {
                let sum = &mut sums.by_unknown[k];
                let add = |to: &mut f64, a: [f64; 2]| *to += a[0] * z[0] + a[1] * z[1];
                for m in 0..6 {
                    add(&mut sum.reduced[photo + m], [row.pose[0][m], row.pose[1][m]]);
                }
                for m in 0..unknowns {
                    add(&mut sum.reduced[interior + m], [row.interior_rows[0][m], row.interior_rows[1][m]]);
                }
                for axis in 0..3 {
                    let by = row.point[0][axis] * z[0] + row.point[1][axis] * z[1];
                    sum.add_at_point(layout, point, axis, by);
                }
                sums.b[k] += z[0] * e[0] + z[1] * e[1];
                for &(other, w) in &entries[..=n] {
                    sums.squares[(k.max(other), k.min(other))] += z[0] * w[0] + z[1] * w[1];
                }
            }
        }
    }
    Some(sums)
}

/// All numbers of a vector over the unknowns.
fn numbers(full: &Full) -> impl Iterator<Item = f64> {
    full.reduced.iter().copied().chain(full.points.iter().flatten().copied())
}

impl Gram {
    /// From the equations that [`Session::finish`] has factored and the step that they still ask for. `None` if a point cannot be projected into its photo.
    pub fn new(session: &Session<'_>, place: ResidualPlace, basis: &Basis, step: &Step) -> Option<(Self, Response)> {
        let network = &session.network;
        let GramMatrices { by_unknown, squares, b } = with_interior_size!(network, sums(session, place, basis, step))?;
        let (normal, layout) = session.factored();
        let mut solved = by_unknown.clone();
        normal.solve_all(network, layout, &mut solved);
        let count = basis.len();
        let size = by_unknown.first().map_or(0, |full| numbers(full).count());
        let matrix = |all: &[Full]| DMatrix::from_iterator(size, count, all.iter().flat_map(numbers));
        let taken = matrix(&by_unknown).transpose() * matrix(&solved);
        let raw: Vec<f64> = squares.diagonal().iter().copied().collect();
        let g = DMatrix::from_fn(count, count, |i, j| {
            squares[(i.max(j), i.min(j))] - 0.5 * (taken[(i, j)] + taken[(j, i)])
        });
        Some((Self { g, b, raw }, Response { solved }))
    }

    /// The part of it that some fields are.
    pub fn part(&self, fields: &[usize]) -> Self {
        Self {
            g: DMatrix::from_fn(fields.len(), fields.len(), |i, j| self.g[(fields[i], fields[j])]),
            b: DVector::from_fn(fields.len(), |i, _| self.b[fields[i]]),
            raw: fields.iter().map(|k| self.raw[*k]).collect(),
        }
    }

    fn sweep_one(&mut self, j: usize) -> f64 {
        let column = self.g.column(j).clone_owned();
        let (pivot, b) = (column[j], self.b[j]);
        self.b.axpy(-b / pivot, &column, 1.0);
        self.g.ger(-1.0 / pivot, &column, &column, 1.0);
        b * b / pivot
    }

    /// Sweeps fields, the one first of which most is left, as long as the unknowns and the others leave anything. Returns by how much
    /// eᵀPe is lowered and the number of fields swept.
    pub fn sweep(&mut self, fields: &[usize]) -> (f64, usize) {
        let (mut lowered, mut swept) = (0.0, 0);
        let mut open = fields.to_vec();
        while !open.is_empty() {
            let left = |k: usize| if self.raw[k] > 0.0 { self.g[(k, k)] / self.raw[k] } else { 0.0 };
            let best = (0..open.len()).max_by(|a, b| left(open[*a]).total_cmp(&left(open[*b]))).unwrap_or_default();
            if left(open[best]) < ABSORBED {
                break;
            }
            lowered += self.sweep_one(open.swap_remove(best));
            swept += 1;
        }
        (lowered, swept)
    }

    /// By how much a group of fields lowers eᵀPe, and the number of its independent fields.
    pub fn explained(&self, fields: &[usize]) -> (f64, usize) {
        let all: Vec<usize> = (0..fields.len()).collect();
        self.part(fields).sweep(&all)
    }

    /// How large a group's fields are at an amount of 1, before anything takes them over: the roots of ZᵀPZ's diagonal.
    pub fn scales(&self, fields: &[usize]) -> Vec<f64> {
        fields.iter().map(|k| self.raw[*k].max(0.0).sqrt()).collect()
    }

    /// The amounts of a group's fields that lower eᵀPe most; 0 for fields that are linear combinations of others.
    pub fn amounts(&self, fields: &[usize]) -> Vec<f64> {
        let part = self.part(fields);
        let n = fields.len();
        let mut swept = part.clone();
        let (mut open, mut used): (Vec<usize>, Vec<usize>) = ((0..n).collect(), Vec::new());
        while !open.is_empty() {
            let left = |k: usize| if part.raw[k] > 0.0 { swept.g[(k, k)] / part.raw[k] } else { 0.0 };
            let best = (0..open.len()).max_by(|a, b| left(open[*a]).total_cmp(&left(open[*b]))).unwrap_or_default();
            if left(open[best]) < ABSORBED {
                break;
            }
            let field = open.swap_remove(best);
            swept.sweep_one(field);
            used.push(field);
        }
        let system = part.part(&used);
        let mut amounts = vec![0.0; n];
        if let Some(solved) = system.g.cholesky().map(|factor| factor.solve(&system.b)) {
            used.iter().zip(solved.iter()).for_each(|(k, x)| amounts[*k] = *x);
        }
        amounts
    }
}

impl Response {
    /// Lengths in pixels, over the rays of a camera, of what given amounts of fields leave in the residuals: root mean square and maximum.
    pub fn lengths(
        &self,
        session: &Session<'_>,
        place: ResidualPlace,
        basis: &Basis,
        camera: usize,
        amounts: &[(usize, f64)],
    ) -> Option<[f64; 2]> {
        let network = &session.network;
        with_interior_size!(network, lengths(self, session, place, basis, camera, amounts))
    }
}

fn lengths<const N: usize>(
    response: &Response,
    session: &Session<'_>,
    place: ResidualPlace,
    basis: &Basis,
    camera: usize,
    amounts: &[(usize, f64)],
) -> Option<[f64; 2]> {
    let (_, layout) = session.factored();
    let network: &Network = &session.network;
    let mut x = Full::zeros(network, layout);
    let mut amount = vec![0.0; basis.len()];
    for &(field, by) in amounts {
        amount[field] = by;
        let solved = &response.solved[field];
        x.reduced.iter_mut().zip(&solved.reduced).for_each(|(x, s)| *x += by * s);
        for (x, s) in x.points.iter_mut().zip(&solved.points) {
            x.iter_mut().zip(s).for_each(|(x, s)| *x += by * s);
        }
    }
    let linearisation = Linearisation::<N>::new(session.context(place))?;
    let (mut behind, mut room, mut entries) = (0, Vec::new(), Vec::<BasisEntry>::new());
    let (mut sum, mut largest, mut count) = (0.0, 0.0_f64, 0.0);
    for (point, block) in network.points.iter().enumerate() {
        let rows = linearisation.point(point, &mut room, &mut behind)?;
        for (ray, row) in block.rays.clone().zip(rows) {
            let Some(pixels) = basis.pixels(ray, camera) else { continue };
            basis.at(ray, row, &mut entries);
            let (photo, interior) = (layout.photo[row.photo], layout.interior[row.interior]);
            let unknowns = network.interiors[row.interior].estimated.len();
            let length: f64 = (0..2)
                .map(|s| {
                    let field: f64 = entries.iter().map(|(k, z)| amount[*k] * z[s]).sum();
                    let pose: f64 = (0..6).map(|m| row.pose[s][m] * x.reduced[photo + m]).sum();
                    let own: f64 = (0..unknowns).map(|m| row.interior_rows[s][m] * x.reduced[interior + m]).sum();
                    let of_point: f64 = (0..3).map(|a| row.point[s][a] * x.at_point(layout, point, a)).sum();
                    ((field - pose - own - of_point) * pixels[s]).powi(2)
                })
                .sum();
            sum += length;
            largest = largest.max(length);
            count += 1.0;
        }
    }
    Some([(sum / f64::max(count, 1.0)).sqrt(), largest.sqrt()])
}
