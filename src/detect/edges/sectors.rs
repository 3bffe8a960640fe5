//! Finds the occluded sector of an outline: the one without which an ellipse fits its edges best.
//!
//! Near the start the distances d of the edges are linear in the corrections x of (u, v, p, q, r): d = J x + e. For every sector
//! the normal equations are those of all edges minus those of the sector, N x = r, and e'e = d'd - r'x measures how well the others
//! agree. That takes one factorisation of a 5 x 5 matrix per sector; only the best few get a robust fit. A sector is skipped if too many
//! rays outside of it have no edge.

use super::edge::Edges;
use crate::detect::acceptance::{occlusion::EVEN, outline::SMALL_GAP};
use crate::detect::ellipse::outline::Outline;
use crate::detect::median;

/// Number of positions of a sector around the outline.
const PLACES: usize = 16;

/// Unknowns, and the entries of the lower triangle of their normal matrix with the right-hand side and the sum of squares below.
const UNKNOWNS: usize = 5;
const ENTRIES: usize = (UNKNOWNS + 1) * (UNKNOWNS + 2) / 2;

/// Normal equations, bordered by their right-hand side and the sum of squares: sums of products of (J, d), row by row.
#[derive(Clone, Copy)]
struct BorderedNormalEquations {
    sums: [f64; ENTRIES],
    /// Number of edges in the sums.
    count: usize,
}

impl BorderedNormalEquations {
    fn none() -> Self {
        Self { sums: [0.0; ENTRIES], count: 0 }
    }

    fn add(&mut self, [m0, m1, m2, m3, m4]: [f64; UNKNOWNS], distance: f64) {
        let terms = [m0, m1, m2, m3, m4, distance];
        let mut sums = self.sums.iter_mut();
        for i in 0..=UNKNOWNS {
            for (sum, term) in sums.by_ref().take(i + 1).zip(terms) {
                *sum += terms[i] * term;
            }
        }
        self.count += 1;
    }

    fn without(&self, other: &Self) -> Self {
        Self { sums: std::array::from_fn(|i| self.sums[i] - other.sums[i]), count: self.count - other.count }
    }

    /// Root mean square of the residuals: the last pivot of the bordered matrix is e'e.
    fn rms(&self) -> Option<f64> {
        let row = |i: usize| i * (i + 1) / 2;
        let mut factor = self.sums;
        for i in 0..=UNKNOWNS {
            for j in 0..i {
                let known: f64 = (0..j).map(|k| factor[row(i) + k] * factor[row(j) + k]).sum();
                factor[row(i) + j] = (factor[row(i) + j] - known) * factor[row(j) + j];
            }
            let known: f64 = (0..i).map(|k| factor[row(i) + k].powi(2)).sum();
            let pivot = factor[row(i) + i] - known;
            if i == UNKNOWNS {
                return Some((pivot.max(0.0) / (self.count - UNKNOWNS) as f64).sqrt());
            }
            if !(pivot > 0.0) {
                return None;
            }
            factor[row(i) + i] = 1.0 / pivot.sqrt();
        }
        None
    }
}

/// For each share of the outline the sector, as its share and its start, without which the edges scatter least.
pub(crate) fn promising(edges: &Edges, outline: &Outline, shares: &[f64]) -> Vec<(f64, f64)> {
    let count = edges.len();
    let rays: Vec<Option<([f64; 5], f64)>> = (0..count)
        .map(|k| {
            (edges.strength[k] > 0.0).then(|| {
                let [x, y] = edges.place(k);
                let (rim, distance) = outline.nearest(x, y);
                (rim.moves, distance)
            })
        })
        .collect();
    // distant edges belong to another object
    let mut sizes = Vec::new();
    let typical = median::of_sizes(rays.iter().flatten().map(|(_, distance)| distance.abs() as f32), &mut sizes);
    let limit = (3.0 * 1.4826 * typical).max(1.0 + 0.05 * outline.semi_axes().1);
    let near = |ray: &Option<([f64; UNKNOWNS], f64)>| ray.filter(|(_, distance)| distance.abs() <= limit);
    // twice around: number of edges up to each ray, by which most sectors are rejected without sums
    let mut taken = Vec::with_capacity(2 * count + 1);
    taken.push(0);
    for ray in rays.iter().chain(&rays) {
        taken.push(taken[taken.len() - 1] + usize::from(near(ray).is_some()));
    }
    let ray = |turn: f64| (turn * count as f64).ceil() as usize;
    let place = |place: usize| place as f64 / PLACES as f64;
    let enough = |share: f64, from: f64| {
        let sector = ray(from)..ray(from + share);
        let inside = taken[sector.end] - taken[sector.start];
        let left = taken[count] - inside;
        let missing = (count - taken[count]) - (sector.len() - inside);
        left >= 8.max(count / 3) && missing as f64 <= SMALL_GAP * count as f64
    };
    if !shares.iter().any(|share| (0..PLACES).any(|k| enough(*share, place(k)))) {
        return Vec::new();
    }
    // running sums over the same rays
    let mut running = Vec::with_capacity(2 * count + 1);
    let mut sums = BorderedNormalEquations::none();
    running.push(sums);
    for ray in rays.iter().chain(&rays) {
        if let Some((moves, distance)) = near(ray) {
            sums.add(moves, distance);
        }
        running.push(sums);
    }
    let all = running[count];
    let best_of = |share: &f64| {
        let scatter = |from: f64| {
            let rest = || all.without(&running[ray(from + share)].without(&running[ray(from)]));
            enough(*share, from).then(|| rest().rms()).flatten().map(|rms| (rms.hypot(EVEN), from))
        };
        let best = (0..PLACES).filter_map(|k| scatter(place(k))).min_by(|a, b| a.0.total_cmp(&b.0));
        best.map(|(_, from)| (*share, from))
    };
    shares.iter().filter_map(best_of).collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn distant_edges_are_not_counted() {
        // the edge of an occluder a few pixels inside, on 9 of 32 rays; half of the others have no scatter
        let outline = Outline::from_axes(100.3, 80.2, 20.0, 16.0, 0.4);
        let mut edges = Edges::default();
        edges.begin(&outline, 32);
        for (k, rim) in crate::detect::ellipse::rays::rim_points(&outline, 32).enumerate() {
            let off = match k {
                2..11 => -4.4,
                11..19 => 0.5 * (3.7 * k as f64).sin(),
                _ => 0.02 * (5.1 * k as f64).sin(),
            };
            edges.set(k, [rim.x + off * rim.normal[0], rim.y + off * rim.normal[1]], 50.0, true);
        }
        let found = promising(&edges, &outline, &[0.15, 0.25, 0.35]);
        assert!(!found.is_empty());
        for (share, from) in found {
            let rays = (32.0 * from).ceil() as usize..(32.0 * (from + share)).ceil() as usize;
            let left = (2..11).filter(|k| !rays.contains(k) && !rays.contains(&(k + 32))).count();
            assert!(left <= 3, "{share} from {from} leaves {left}");
        }
    }

    #[test]
    fn the_residuals_agree_with_an_adjustment_without_the_sector() {
        let wave = |k: usize| (1.7 * k as f64 + 0.3 * (k * k) as f64).sin();
        let row = |k: usize| (std::array::from_fn(|i| wave(6 * k + i)), 0.3 * wave(6 * k + 5));
        let rows: Vec<([f64; UNKNOWNS], f64)> = (0..40).map(row).collect();
        let sums = |rows: &[([f64; UNKNOWNS], f64)]| {
            let mut sums = BorderedNormalEquations::none();
            rows.iter().for_each(|(moves, distance)| sums.add(*moves, *distance));
            sums
        };
        let found = sums(&rows).without(&sums(&rows[5..17])).rms().expect("a solution");
        let rest: Vec<_> = rows[..5].iter().chain(&rows[17..]).collect();
        let moves = DMatrix::from_fn(rest.len(), UNKNOWNS, |i, j| rest[i].0[j]);
        let distances = DVector::from_fn(rest.len(), |i, _| rest[i].1);
        let solved = moves.clone().svd(true, true).solve(&distances, 1e-12).expect("a solution");
        let left = (moves * solved - distances).norm() / ((rest.len() - UNKNOWNS) as f64).sqrt();
        assert!((found - left).abs() < 1e-9, "{found} {left}");
    }
}
