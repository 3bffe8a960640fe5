//! Which sector of an outline is covered: the one without which an ellipse fits its edges best.
//!
//! Near the start the distances d of the edges are linear in the corrections x of (u, v, p, q, r): d = J x + e. For every sector
//! the normal equations are those of all edges less its own, N x = r, and e'e = d'd - r'x tells how well the others agree. That
//! takes one factorisation of a 5 x 5 matrix a sector; only the best few are worth a robust fit.

use nalgebra::{SMatrix, SVector};

use super::edge::Edges;
use crate::detect::acceptance::covered::EVEN;
use crate::detect::ellipse::outline::Outline;
use crate::detect::median;

/// Places of each size of a sector, around the outline.
const PLACES: usize = 16;

/// Normal equations: matrix, right-hand side, sum of squares, number.
#[derive(Clone, Copy)]
struct Normal {
    matrix: SMatrix<f64, 5, 5>,
    right: SVector<f64, 5>,
    squares: f64,
    count: usize,
}

impl Normal {
    fn none() -> Self {
        Self { matrix: SMatrix::zeros(), right: SVector::zeros(), squares: 0.0, count: 0 }
    }

    fn add(&mut self, moves: &[f64; 5], distance: f64) {
        for i in 0..5 {
            for j in 0..=i {
                self.matrix[(i, j)] += moves[i] * moves[j];
            }
            self.right[i] += moves[i] * distance;
        }
        self.squares += distance * distance;
        self.count += 1;
    }

    fn without(&self, other: &Self) -> Self {
        Self {
            matrix: self.matrix - other.matrix,
            right: self.right - other.right,
            squares: self.squares - other.squares,
            count: self.count - other.count,
        }
    }

    /// Root mean square of what is left after the adjustment.
    fn rms(&self) -> Option<f64> {
        let solved = self.matrix.cholesky()?.solve(&self.right);
        Some(((self.squares - self.right.dot(&solved)).max(0.0) / (self.count - 5) as f64).sqrt())
    }
}

/// For each share of the outline the sector, as its share and its start, without which the edges scatter least.
pub(crate) fn promising(edges: &Edges, outline: &Outline, shares: &[f64]) -> Vec<(f64, f64)> {
    let count = edges.len();
    let rays: Vec<Option<([f64; 5], f64)>> = (0..count)
        .map(|k| {
            let [x, y] = edges.place(k);
            let (rim, distance) = outline.nearest(x, y);
            (edges.strength[k] > 0.0).then_some((rim.moves, distance))
        })
        .collect();
    // what lies far off belongs to something else
    let mut sizes = Vec::new();
    let typical = median::of_sizes(rays.iter().flatten().map(|(_, distance)| distance.abs() as f32), &mut sizes);
    let limit = (3.0 * 1.4826 * typical).max(1.0 + 0.05 * outline.semi_axes().1);
    // running sums over the rays, twice around
    let mut running = vec![Normal::none()];
    for ray in rays.iter().chain(&rays) {
        let mut next = running[running.len() - 1];
        if let Some((moves, distance)) = ray
            && distance.abs() <= limit
        {
            next.add(moves, *distance);
        }
        running.push(next);
    }
    let all = running[count];
    let ray = |turn: f64| (turn * count as f64).ceil() as usize;
    let best_of = |share: &f64| {
        let scatter = |place: usize| {
            let from = place as f64 / PLACES as f64;
            let rest = all.without(&running[ray(from + share)].without(&running[ray(from)]));
            (rest.count >= 8.max(count / 3)).then(|| rest.rms()).flatten().map(|rms| (rms.hypot(EVEN), from))
        };
        let best = (0..PLACES).filter_map(scatter).min_by(|a, b| a.0.total_cmp(&b.0));
        best.map(|(_, from)| (*share, from))
    };
    shares.iter().filter_map(best_of).collect()
}
