//! Reduced normal equations, accumulated point by point; the design matrix is never formed.
//!
//! For one point with weighted rows A (derivatives by the point), G (by photos and interior orientations) and residuals e, the
//! normal matrix of the point is N = AᵀA = L·Lᵀ. With B = A·L⁻ᵀ and h = Bᵀe the point's elimination leaves
//!
//! ```text
//! S += GᵀG - (GᵀB)(GᵀB)ᵀ,   right-hand side -= Gᵀe - (GᵀB)h,   δX = -L⁻ᵀ(h + BᵀGδ)
//! ```
//!
//! Distances, given values and the relative poses of a rig are added to S. The end points of distances are not eliminated. Damping
//! (Levenberg-Marquardt) multiplies the diagonals of the normal equations by 1 + λ. `pins`, weights on seven photo unknowns, remove the
//! datum defect of a free network; see [`crate::adjust::datum::free`].

use std::collections::BTreeMap;

use crate::adjust::linear::tiles::TileMatrix;
use crate::adjust::problem::additional::distance_row;
use crate::adjust::problem::network::Network;
use crate::adjust::problem::rig::Deviation;
use crate::adjust::problem::step::Step;

use super::back_substitution::{EliminatedPoints, Full};
use super::context::Context;
use super::ordering::Layout;
use super::right_hand_side::gradient;
use super::schur::accumulate;

/// Reduced normal equations at a state.
#[derive(Clone, Debug)]
pub struct ReducedNormalEquations {
    /// S; after [`Self::factor`] its Cholesky factor.
    pub matrix: TileMatrix,
    /// Right-hand side.
    pub rhs: Vec<f64>,
    /// Diagonal of the normal equations before elimination.
    pub reference: Vec<f64>,
    /// Eliminated points.
    pub eliminated: EliminatedPoints,
    /// vᵀPv at the state.
    pub cost: f64,
    /// Number of rays whose point lies behind the camera.
    pub behind: usize,
    /// Damping of the equations.
    pub lambda: f64,
}

/// A solution of the normal equations.
#[derive(Clone, Debug, Default)]
pub struct NormalSolution {
    /// The step.
    pub step: Step,
    /// Squared length of the step in standard errors, δᵀ(N + λD)δ.
    pub decrement: f64,
    /// Decrease of vᵀPv predicted by the linear model.
    pub predicted: f64,
}

/// Calls a function that is generic over the number of columns reserved for an interior orientation, [`Network::interior_size`].
macro_rules! with_interior_size {
    ($network:expr, $call:ident ( $($argument:expr),* )) => {
        match $network.interior_size() {
            0 => $call::<0>($($argument),*),
            2 => $call::<2>($($argument),*),
            4 => $call::<4>($($argument),*),
            6 => $call::<6>($($argument),*),
            8 => $call::<8>($($argument),*),
            10 => $call::<10>($($argument),*),
            _ => $call::<12>($($argument),*),
        }
    };
}
pub(in crate::adjust) use with_interior_size;

impl ReducedNormalEquations {
    /// Empty equations of a layout.
    pub fn new(network: &Network, layout: &Layout) -> Self {
        Self {
            matrix: TileMatrix::new(layout.pattern.clone()),
            rhs: vec![0.0; layout.size],
            reference: vec![0.0; layout.size],
            eliminated: EliminatedPoints::new(network),
            cost: 0.0,
            behind: 0,
            lambda: 0.0,
        }
    }

    /// Accumulates the equations at a state. Returns false if a point cannot be projected.
    pub fn build(&mut self, context: Context<'_>, lambda: f64, pins: &[usize]) -> bool {
        self.matrix.clear();
        self.rhs.fill(0.0);
        self.reference.fill(0.0);
        self.eliminated.start(context.state);
        self.cost = 0.0;
        self.behind = 0;
        self.lambda = lambda;
        let normal = &mut *self;
        let sound = with_interior_size!(context.network, accumulate(normal, context));
        if sound.is_none() || !self.cost.is_finite() {
            return false;
        }
        self.add_given(context, true);
        self.finish_diagonal(context, pins);
        true
    }

    /// Computes only the right-hand side, at another state, and keeps the factored matrix: one step of the simplified Newton iteration,
    /// much cheaper than new equations. Returns false if a point cannot be projected.
    pub fn renew(&mut self, context: Context<'_>) -> bool {
        self.rhs.fill(0.0);
        self.cost = 0.0;
        self.behind = 0;
        let normal = &mut *self;
        let sound = with_interior_size!(context.network, gradient(normal, context));
        self.add_given(context, false);
        sound.is_some() && self.cost.is_finite()
    }

    /// Adds a value to the lower triangle, and to `reference` if it is on the diagonal.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let at = self.matrix.place(row.max(column), row.min(column));
        self.matrix.data_mut()[at] += value;
        if row == column {
            self.reference[row] += value;
        }
    }

    /// Adds distances and observed values of photos and interior orientations to the right-hand side, and to the matrix if `whole`.
    fn add_given(&mut self, Context { network, layout, state, weighting }: Context<'_>, whole: bool) {
        for bar in &network.bars {
            let (e, rows) = distance_row(network, state, bar);
            self.cost += e * e;
            let places = [layout.point[bar.from], layout.point[bar.to]];
            let at = |k: usize| places[k / 3] + k % 3;
            for i in 0..6 {
                self.rhs[at(i)] -= rows[i] * e;
                for j in (0..=i).filter(|_| whole) {
                    self.add(at(i), at(j), rows[i] * rows[j]);
                }
            }
        }
        self.add_rig(Context { network, layout, state, weighting }, whole);
        let add = |normal: &mut Self, at: usize, scale: f64, (given, weight): (f64, f64), value: f64| {
            if weight > 0.0 {
                let e = (value - given) * weight;
                normal.cost += e * e;
                normal.rhs[at] -= e * weight * scale;
                if whole {
                    normal.add(at, at, (weight * scale).powi(2));
                }
            }
        };
        for (k, photo) in network.photos.iter().enumerate() {
            for a in 0..3 {
                add(self, layout.photo[k] + 3 + a, 1.0, photo.prior[a], state.poses[k].centre[a]);
            }
        }
        for (k, interior) in network.interiors.iter().enumerate() {
            for (n, estimated) in interior.estimated.iter().enumerate() {
                let value = state.interiors[k].get(estimated.parameter).unwrap_or_default();
                add(self, layout.interior[k] + n, estimated.scale, estimated.prior, value);
            }
        }
    }

    /// Relative poses of the cameras of a rig: Σ JᵀJ - (ΣJ)ᵀ(ΣJ)/n, and the right-hand side -Σ Jᵀd.
    fn add_rig(&mut self, Context { network, layout, state, .. }: Context<'_>, whole: bool) {
        for member in &network.rig {
            let equations = member.equations(state);
            let mut sums: BTreeMap<usize, Deviation> = BTreeMap::new();
            for (exposure, (d, j)) in equations.iter().enumerate() {
                let at = |column: usize| member.place(&layout.photo, exposure, column);
                self.cost += d.norm_squared();
                for a in 0..12 {
                    self.rhs[at(a)] -= j.column(a).dot(d);
                    *sums.entry(at(a)).or_default() += j.column(a);
                    for b in (0..=a).filter(|_| whole) {
                        self.add(at(a), at(b), j.column(a).dot(&j.column(b)));
                    }
                }
            }
            let share = 1.0 / equations.len() as f64;
            for (a, of_a) in sums.iter().filter(|_| whole) {
                for (b, of_b) in sums.range(..=a) {
                    self.add(*a, *b, -share * of_a.dot(of_b));
                }
            }
        }
    }

    /// Adds damping and pins to the diagonal; sets it to 1 for held axes of points and for unused places between blocks.
    fn finish_diagonal(&mut self, Context { network, layout, .. }: Context<'_>, pins: &[usize]) {
        let mut used = vec![false; layout.size];
        for start in &layout.photo {
            used[*start..start + 6].fill(true);
        }
        for (start, block) in layout.interior.iter().zip(&network.interiors) {
            used[*start..start + block.estimated.len()].fill(true);
        }
        for (start, block) in layout.point.iter().zip(&network.points).filter(|(_, block)| block.kept) {
            (0..3).for_each(|a| used[start + a] = !block.fixed[a]);
        }
        for (k, used) in used.into_iter().enumerate() {
            let at = self.matrix.place(k, k);
            let diagonal = &mut self.matrix.data_mut()[at];
            if used {
                *diagonal += self.lambda * self.reference[k];
            } else {
                (*diagonal, self.reference[k]) = (1.0, 1.0);
            }
        }
        for &pin in pins {
            let at = self.matrix.place(pin, pin);
            self.matrix.data_mut()[at] += self.reference[pin];
        }
    }

    /// Factors the matrix. Returns the indices of numerically zero pivots; those of eliminated points follow after the size of S.
    pub fn factor(&mut self) -> Vec<usize> {
        let mut lost = self.matrix.factor(&self.reference, 1e-12);
        lost.extend(self.eliminated.lost.iter().map(|point| self.rhs.len() + point));
        lost
    }

    /// Solves the factored equations for the step.
    pub fn solve(&self, network: &Network, layout: &Layout) -> NormalSolution {
        let mut x = self.rhs.clone();
        self.matrix.solve(&mut x);
        let mut decrement: f64 = x.iter().zip(&self.rhs).map(|(x, b)| x * b).sum();
        let mut damped: f64 = x.iter().zip(&self.reference).map(|(x, d)| self.lambda * d * x * x).sum();
        let points = self.eliminated.back_substitute(network, layout, &x);
        for (factor, step) in self.eliminated.factors.iter().zip(&points) {
            decrement += factor.h.iter().map(|h| h * h).sum::<f64>();
            damped += factor.damping.iter().zip(step).map(|(d, x)| d * x * x).sum::<f64>();
        }
        let step = Step {
            photos: layout.photo.iter().map(|&at| std::array::from_fn(|k| x[at + k])).collect(),
            interiors: layout
                .interior
                .iter()
                .zip(&network.interiors)
                .map(|(&at, block)| x[at..at + block.estimated.len()].to_vec())
                .collect(),
            points,
        };
        NormalSolution { step, decrement, predicted: decrement + damped }
    }

    /// Solves the factored equations for several right-hand sides over all unknowns, in place.
    pub fn solve_all(&self, network: &Network, layout: &Layout, vectors: &mut [Full]) {
        for vector in vectors {
            vector.forward(network, layout, &self.eliminated);
            self.matrix.solve(&mut vector.reduced);
            vector.backward(network, layout, &self.eliminated);
        }
    }
}
