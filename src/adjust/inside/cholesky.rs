//! The Cholesky factor of the normal matrix, P N Pᵀ = L Lᵀ, in a chosen order P of elimination: what the order does to fill-in.
//!
//! With the points first the last rows and columns of L are the factor of the reduced normal matrix S:
//!
//! ```text
//! | N_pp N_pr |   | L_pp  0   | | L_ppᵀ L_rpᵀ |
//! | N_rp N_rr | = | L_rp  L_S | | 0     L_Sᵀ  |        L_S L_Sᵀ = S
//! ```
//!
//! Without control N is singular by its datum defect. As in the iteration, that many photo unknowns are then held: their rows and
//! columns are left out but for a diagonal entry.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::normal_equations::{BlockKind, Motion, NormalEquations};
use super::sparse::SparseMatrix;

/// Order of elimination.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Elimination {
    /// Points first, then photos and interior orientations, as in [`NormalEquations::elimination_order`].
    #[default]
    PointsFirst,
    /// Photos, interior orientations, then points: the order of the unknowns.
    PhotosFirst,
}

/// A Cholesky factor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Factor {
    /// The unknown of every row and column of L, by its place among all.
    pub order: Vec<usize>,
    /// L, lower triangular.
    #[serde(rename = "L")]
    pub l: SparseMatrix,
    /// Unknowns that are held while N is factored, ascending: as many as the datum defect.
    pub held: Vec<usize>,
    /// Entries of L where N has none, in the order of the entries of L.
    pub filled: Vec<bool>,
}

impl NormalEquations {
    /// The Cholesky factor of N; row by row (up-looking: T. A. Davis 2006, Direct Methods for Sparse Linear Systems, 4.7).
    ///
    /// `None` when N is singular beyond its datum defect.
    pub fn cholesky_factor(&self, elimination: Elimination) -> Option<Factor> {
        let blocks: Vec<usize> = match elimination {
            Elimination::PointsFirst => self.elimination_order.clone(),
            Elimination::PhotosFirst => (0..self.blocks.len()).collect(),
        };
        let unknowns = |k: usize| self.blocks[k].first..self.blocks[k].first + self.blocks[k].size;
        let order: Vec<usize> = blocks.into_iter().flat_map(unknowns).collect();
        let held = self.held();
        let count = order.len();
        let mut place = vec![0; count];
        order.iter().enumerate().for_each(|(k, unknown)| place[*unknown] = k);
        // Below the diagonal of L, by columns: row and value, ascending; rows of L; the diagonal.
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); count];
        let mut diagonal = Vec::with_capacity(count);
        let (mut rows, mut filled) = (Vec::with_capacity(count), Vec::new());
        let (mut x, mut is_in_n) = (vec![0.0; count], vec![false; count]);
        for (i, &unknown) in order.iter().enumerate() {
            if held.binary_search(&unknown).is_ok() {
                diagonal.push(1.0);
                rows.push(vec![(i, 1.0)]);
                filled.push(false);
                continue;
            }
            let mut pivot = 0.0;
            // Columns of this row that are still to be eliminated.
            let mut left = BTreeSet::new();
            for (column, value) in self.n.row(unknown) {
                let j = place[column];
                if j < i && held.binary_search(&column).is_err() {
                    (x[j], is_in_n[j]) = (value, true);
                    left.insert(j);
                } else if j == i {
                    pivot = value;
                }
            }
            let own = pivot;
            let mut row = Vec::with_capacity(left.len() + 1);
            while let Some(j) = left.pop_first() {
                let value = x[j] / diagonal[j];
                x[j] = 0.0;
                let is_filled = !std::mem::take(&mut is_in_n[j]);
                if value == 0.0 {
                    continue;
                }
                filled.push(is_filled);
                pivot -= value * value;
                for &(k, below) in &columns[j] {
                    if x[k] == 0.0 && !is_in_n[k] {
                        left.insert(k);
                    }
                    x[k] -= below * value;
                }
                columns[j].push((i, value));
                row.push((j, value));
            }
            if pivot <= own * SINGULAR || !pivot.is_finite() {
                return None;
            }
            diagonal.push(pivot.sqrt());
            row.push((i, pivot.sqrt()));
            filled.push(false);
            rows.push(row);
        }
        Some(Factor { order, l: SparseMatrix::from_rows(count, rows), held, filled })
    }

    /// Photo unknowns whose holding takes up the datum defect: the largest entries of the motions, scaled to the diagonal of N, one
    /// after the other, each after what the motions of those before leave of it.
    fn held(&self) -> Vec<usize> {
        let mut motions: Vec<Vec<f64>> = self.null_space.iter().map(|motion: &Motion| motion.vector.clone()).collect();
        let size = |k: usize| self.n.row(k).find(|entry| entry.0 == k).map_or(0.0, |entry| entry.1.max(0.0).sqrt());
        let photos = self.blocks.iter().filter(|block| block.kind == BlockKind::Photo);
        let candidates: Vec<(usize, f64)> =
            photos.flat_map(|block| (block.first..block.first + block.size).map(|k| (k, size(k)))).collect();
        let mut held = Vec::with_capacity(motions.len());
        while !motions.is_empty() {
            // A motion as a whole has no size of its own: of each the largest entry is one.
            for motion in &mut motions {
                let most =
                    candidates.iter().map(|(k, size)| (motion[*k] * size).abs()).fold(f64::MIN_POSITIVE, f64::max);
                motion.iter_mut().for_each(|g| *g /= most);
            }
            let longest = |k: usize, size: f64| motions.iter().map(|g| (g[k] * size).powi(2)).sum::<f64>();
            let best = candidates.iter().copied().max_by(|a, b| longest(a.0, a.1).total_cmp(&longest(b.0, b.1)));
            let Some((k, _)) = best else { break };
            let largest = (0..motions.len()).max_by(|a, b| motions[*a][k].abs().total_cmp(&motions[*b][k].abs()));
            let taken = motions.swap_remove(largest.unwrap_or_default());
            for motion in &mut motions {
                let share = motion[k] / taken[k];
                motion.iter_mut().zip(&taken).for_each(|(g, other)| *g -= share * other);
            }
            held.push(k);
        }
        held.sort_unstable();
        held
    }
}

/// A pivot that keeps less than this of its diagonal entry is rounding.
const SINGULAR: f64 = 1e-13;
