//! Solution of the factored normal equations for any right-hand side, points included: for chosen covariances and for
//! null vectors. Z is as in [`super::cofactor`].

use super::layout::Layout;
use super::network::Network;
use super::normal::{Normal, backward3, forward3, with_interior_size};
use super::parameters::State;
use super::rows::{Row, Weighting, linearise, models};

/// Z of one point: per ray of its photo, per interior orientation of the point, and their places.
pub struct Elimination<const N: usize> {
    /// Per ray, for its photo.
    pub photos: Vec<[[f64; 6]; 3]>,
    /// Per ray, place of its photo.
    pub places: Vec<usize>,
    /// Interior orientation, its place, its Z.
    pub interiors: Vec<(usize, usize, [[f64; N]; 3])>,
}

impl<const N: usize> Elimination<N> {
    /// Empty working space.
    pub fn new() -> Self {
        Self { photos: Vec::new(), places: Vec::new(), interiors: Vec::new() }
    }

    /// From the rows of a point and the factor of its normal matrix.
    pub fn fill(&mut self, network: &Network, layout: &Layout, l: &[f64; 6], rows: &[Row<N>]) {
        self.photos.clear();
        self.places.clear();
        self.interiors.clear();
        for row in rows {
            let b = row.point.map(|a| forward3(l, a));
            let mut z = [[0.0; 6]; 3];
            for m in 0..3 {
                for k in 0..6 {
                    z[m][k] = row.pose[0][k] * b[0][m] + row.pose[1][k] * b[1][m];
                }
            }
            self.photos.push(z);
            self.places.push(layout.photo[row.photo]);
            let at = self.interiors.iter().position(|(q, ..)| *q == row.interior).unwrap_or_else(|| {
                self.interiors.push((row.interior, layout.interior[row.interior], [[0.0; N]; 3]));
                self.interiors.len() - 1
            });
            let u = &mut self.interiors[at].2;
            for m in 0..3 {
                for k in 0..N {
                    u[m][k] += row.interior_rows[0][k] * b[0][m] + row.interior_rows[1][k] * b[1][m];
                }
            }
        }
        self.interiors.retain(|(q, ..)| !network.interiors[*q].estimated.is_empty());
    }
}

/// A vector over all unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct Full {
    /// Over the reduced equations, kept points included.
    pub reduced: Vec<f64>,
    /// Over the points; 0 for kept ones.
    pub points: Vec<[f64; 3]>,
}

impl Full {
    /// Zero.
    pub fn zeros(network: &Network, layout: &Layout) -> Self {
        Self { reduced: vec![0.0; layout.size], points: vec![[0.0; 3]; network.points.len()] }
    }

    /// Adds to the number at a point's axis.
    pub fn add_at_point(&mut self, layout: &Layout, point: usize, axis: usize, value: f64) {
        match layout.point[point] {
            usize::MAX => self.points[point][axis] += value,
            place => self.reduced[place + axis] += value,
        }
    }

    /// Number at a point's axis.
    pub fn at_point(&self, layout: &Layout, point: usize, axis: usize) -> f64 {
        if layout.point[point] == usize::MAX {
            self.points[point][axis]
        } else {
            self.reduced[layout.point[point] + axis]
        }
    }
}

/// Solves the factored equations for several right-hand sides in place. Returns false where a projection does not exist.
pub fn solve_all(
    normal: &Normal,
    network: &Network,
    layout: &Layout,
    state: &State,
    weighting: Weighting<'_>,
    vectors: &mut [Full],
) -> bool {
    with_interior_size!(network, solve(normal, network, layout, state, weighting, vectors))
}

fn solve<const N: usize>(
    normal: &Normal,
    network: &Network,
    layout: &Layout,
    state: &State,
    weighting: Weighting<'_>,
    vectors: &mut [Full],
) -> bool {
    let Some(models) = models(state) else { return false };
    let mut rows: Vec<Row<N>> = Vec::new();
    let mut elimination = Elimination::<N>::new();
    let mut behind = 0;
    for backwards in [false, true] {
        for (point, block) in network.points.iter().enumerate().filter(|(_, block)| !block.kept) {
            if !linearise(network, state, &models, weighting, point, &mut rows, &mut behind) {
                return false;
            }
            let l = &normal.points[point].l;
            elimination.fill(network, layout, l, &rows);
            for vector in &mut *vectors {
                let Full { reduced, points } = vector;
                if !backwards {
                    points[point] = forward3(l, points[point]);
                }
                let d = points[point];
                let mut sum = [0.0; 3];
                for (z, &at) in elimination.photos.iter().zip(&elimination.places) {
                    exchange(&mut reduced[at..at + 6], z, &d, &mut sum, backwards);
                }
                for (q, at, u) in &elimination.interiors {
                    let length = network.interiors[*q].estimated.len();
                    exchange(&mut reduced[*at..at + length], u, &d, &mut sum, backwards);
                }
                if backwards {
                    points[point] = backward3(l, std::array::from_fn(|m| d[m] - sum[m]));
                    (0..3).filter(|a| block.fixed[*a]).for_each(|a| points[point][a] = 0.0);
                }
            }
        }
        if !backwards {
            vectors.iter_mut().for_each(|vector| normal.matrix.solve(&mut vector.reduced));
        }
    }
    true
}

/// Forwards x -= Z d, backwards sum += Zᵀx.
fn exchange<const C: usize>(x: &mut [f64], z: &[[f64; C]; 3], d: &[f64; 3], sum: &mut [f64; 3], backwards: bool) {
    for (k, x) in x.iter_mut().enumerate() {
        for m in 0..3 {
            if backwards {
                sum[m] += z[m][k] * *x;
            } else {
                *x -= z[m][k] * d[m];
            }
        }
    }
}
