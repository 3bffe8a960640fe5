//! Reduced normal equations, accumulated point by point; the design matrix is never formed.
//!
//! For one point with weighted rows A (by the point), G (by photos and interior orientations) and residuals e, the
//! normal matrix of the point is N = AᵀA = L·Lᵀ. With B = A·L⁻ᵀ and h = Bᵀe the point's elimination leaves
//!
//! ```text
//! S += GᵀG - (GᵀB)(GᵀB)ᵀ,   right-hand side -= Gᵀe - (GᵀB)h,   δX = -L⁻ᵀ(h + BᵀGδ)
//! ```
//!
//! Points that a distance ties to another stay in S. Damping (Levenberg-Marquardt) multiplies the diagonals of the
//! normal equations by 1 + λ. Pins, a weight on seven photo unknowns, take up a free datum; see [`super::datum`].

use crate::camera::Model;

use super::kernel::TILE;
use super::layout::Layout;
use super::network::Network;
use super::parameters::{State, Step};
use super::rows::{Row, Weighting, linearise, models};
use super::tiles::TileMatrix;

/// What back-substitution needs of an eliminated point.
#[derive(Clone, Copy, Debug, Default)]
pub struct PointFactor {
    /// l11, l21, l31, l22, l32, l33 with reciprocal diagonal.
    pub l: [f64; 6],
    /// L⁻¹Aᵀe.
    pub h: [f64; 3],
    /// λ times the undamped diagonal of N.
    damping: [f64; 3],
}

impl PointFactor {
    /// λ times the undamped diagonal of N.
    pub fn damping(&self) -> [f64; 3] {
        self.damping
    }
}

/// Reduced normal equations at a state.
#[derive(Clone, Debug)]
pub struct Normal {
    /// S; after [`Self::factor`] its Cholesky factor.
    pub matrix: TileMatrix,
    /// Right-hand side.
    pub rhs: Vec<f64>,
    /// Diagonal of the normal equations before elimination.
    pub reference: Vec<f64>,
    /// Eliminated points; unused for kept ones.
    pub points: Vec<PointFactor>,
    /// vᵀPv at the state.
    pub cost: f64,
    /// Rays whose point lies behind their camera.
    pub behind: usize,
    lambda: f64,
}

/// A solution of the normal equations.
#[derive(Clone, Debug, Default)]
pub struct Solution {
    /// The step.
    pub step: Step,
    /// Squared length of the step in standard errors, δᵀ(N + λD)δ.
    pub decrement: f64,
    /// Lowering of vᵀPv that the linear model predicts.
    pub predicted: f64,
}

/// Cholesky factor of a symmetric 3 × 3 matrix (xx, xy, xz, yy, yz, zz), reciprocal diagonal; a pivot lost to rounding is
/// replaced by its diagonal.
fn factor3(n: [f64; 6]) -> [f64; 6] {
    let pivot = |value: f64, diagonal: f64| if value > 1e-14 * diagonal { value } else { diagonal.max(1e-300) };
    let d1 = 1.0 / pivot(n[0], n[0]).sqrt();
    let (l21, l31) = (n[1] * d1, n[2] * d1);
    let d2 = 1.0 / pivot(n[3] - l21 * l21, n[3]).sqrt();
    let l32 = (n[4] - l31 * l21) * d2;
    let d3 = 1.0 / pivot(n[5] - l31 * l31 - l32 * l32, n[5]).sqrt();
    [d1, l21, l31, d2, l32, d3]
}

/// L⁻¹x.
#[inline(always)]
pub fn forward3(l: &[f64; 6], x: [f64; 3]) -> [f64; 3] {
    let a = x[0] * l[0];
    let b = (x[1] - l[1] * a) * l[3];
    [a, b, (x[2] - l[2] * a - l[4] * b) * l[5]]
}

/// L⁻ᵀx.
#[inline(always)]
pub fn backward3(l: &[f64; 6], x: [f64; 3]) -> [f64; 3] {
    let c = x[2] * l[5];
    let b = (x[1] - l[4] * c) * l[3];
    [(x[0] - l[1] * b - l[2] * c) * l[0], b, c]
}

/// Dispatches on the largest number of interior unknowns, rounded up to an even number.
macro_rules! with_interior_size {
    ($network:expr, $call:ident ( $($argument:expr),* )) => {{
        let most = $network.interiors.iter().map(|i| i.estimated.len()).max().unwrap_or(0);
        match most {
            0 => $call::<0>($($argument),*),
            1..=2 => $call::<2>($($argument),*),
            3..=4 => $call::<4>($($argument),*),
            5..=6 => $call::<6>($($argument),*),
            7..=8 => $call::<8>($($argument),*),
            _ => $call::<10>($($argument),*),
        }
    }};
}
pub(super) use with_interior_size;

impl Normal {
    /// Empty equations of a layout.
    pub fn new(network: &Network, layout: &Layout) -> Self {
        Self {
            matrix: TileMatrix::new(layout.pattern.clone()),
            rhs: vec![0.0; layout.size],
            reference: vec![0.0; layout.size],
            points: vec![PointFactor::default(); network.points.len()],
            cost: 0.0,
            behind: 0,
            lambda: 0.0,
        }
    }

    /// Accumulates the equations at a state. Returns false where a projection does not exist.
    pub fn build(
        &mut self,
        network: &Network,
        layout: &Layout,
        state: &State,
        weighting: Weighting<'_>,
        lambda: f64,
        pins: &[usize],
    ) -> bool {
        let Some(models) = models(state) else { return false };
        self.matrix.clear();
        self.rhs.fill(0.0);
        self.reference.fill(0.0);
        self.cost = 0.0;
        self.behind = 0;
        self.lambda = lambda;
        let normal = &mut *self;
        let sound = with_interior_size!(network, accumulate(normal, network, layout, state, &models, weighting));
        if !sound || !self.cost.is_finite() {
            return false;
        }
        self.add_bars(network, layout, state);
        self.add_priors(network, layout, state);
        self.finish_diagonal(network, layout, pins);
        true
    }

    fn add(&mut self, row: usize, column: usize, value: f64) {
        let at = self.matrix.place(row.max(column), row.min(column));
        self.matrix.data_mut()[at] += value;
        if row == column {
            self.reference[row] += value;
        }
    }

    fn add_bars(&mut self, network: &Network, layout: &Layout, state: &State) {
        for bar in &network.bars {
            let (e, rows) = bar_row(network, state, bar);
            self.cost += e * e;
            let places = [layout.point[bar.from], layout.point[bar.to]];
            let at = |k: usize| places[k / 3] + k % 3;
            for i in 0..6 {
                self.rhs[at(i)] -= rows[i] * e;
                for j in 0..=i {
                    self.add(at(i), at(j), rows[i] * rows[j]);
                }
            }
        }
    }

    fn add_priors(&mut self, network: &Network, layout: &Layout, state: &State) {
        let add = |normal: &mut Self, at: usize, scale: f64, (given, weight): (f64, f64), value: f64| {
            if weight > 0.0 {
                let e = (value - given) * weight;
                normal.cost += e * e;
                normal.rhs[at] -= e * weight * scale;
                normal.add(at, at, (weight * scale).powi(2));
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

    /// Damping, pins, fixed axes of kept points and the gaps between blocks.
    fn finish_diagonal(&mut self, network: &Network, layout: &Layout, pins: &[usize]) {
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

    /// Factors the matrix; returns the indices of pivots lost to rounding.
    pub fn factor(&mut self) -> Vec<usize> {
        self.matrix.factor(&self.reference, 1e-12)
    }

    /// The step of factored equations.
    pub fn solve(&self, network: &Network, layout: &Layout, state: &State, weighting: Weighting<'_>) -> Solution {
        let mut x = self.rhs.clone();
        self.matrix.solve(&mut x);
        let mut decrement: f64 = x.iter().zip(&self.rhs).map(|(x, b)| x * b).sum();
        let mut damped: f64 = x.iter().zip(&self.reference).map(|(x, d)| self.lambda * d * x * x).sum();
        let Some(models) = models(state) else { return Solution::default() };
        let points =
            with_interior_size!(network, back_substitute(self, network, layout, state, &models, weighting, &x));
        for (factor, step) in self.points.iter().zip(&points) {
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
        Solution { step, decrement, predicted: decrement + damped }
    }
}

/// Weighted residual of a distance and its derivatives by both ends.
pub fn bar_row(network: &Network, state: &State, bar: &super::network::Bar) -> (f64, [f64; 6]) {
    let (a, b) = (&state.points[bar.from], &state.points[bar.to]);
    let d: [f64; 3] = std::array::from_fn(|k| b[k] - a[k]);
    let length = d[0].hypot(d[1]).hypot(d[2]);
    let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
    let mut rows = [0.0; 6];
    for k in 0..3 {
        let slope = d[k] * inverse * bar.weight;
        rows[k] = if network.points[bar.from].fixed[k] { 0.0 } else { -slope };
        rows[3 + k] = if network.points[bar.to].fixed[k] { 0.0 } else { slope };
    }
    ((length - bar.length) * bar.weight, rows)
}

/// vᵀPv of a state without its normal equations, and the number of rays behind their camera; none where a projection
/// does not exist.
pub fn cost(network: &Network, state: &State, weighting: Weighting<'_>) -> Option<(f64, usize)> {
    let models = models(state)?;
    let (mut sum, mut behind) = (0.0, 0);
    let mut rows: Vec<Row<0>> = Vec::new();
    for point in 0..network.points.len() {
        if !linearise(network, state, &models, weighting, point, &mut rows, &mut behind) {
            return None;
        }
        sum += rows.iter().map(|r| r.e[0] * r.e[0] + r.e[1] * r.e[1]).sum::<f64>();
    }
    let prior = |(given, weight): (f64, f64), value: f64| ((value - given) * weight).powi(2);
    for (block, x) in network.points.iter().zip(&state.points) {
        sum += (0..3).map(|a| prior(block.prior[a], x[a])).sum::<f64>();
    }
    for (block, pose) in network.photos.iter().zip(&state.poses) {
        sum += (0..3).map(|a| prior(block.prior[a], pose.centre[a])).sum::<f64>();
    }
    for (block, interior) in network.interiors.iter().zip(&state.interiors) {
        for estimated in &block.estimated {
            sum += prior(estimated.prior, interior.get(estimated.parameter).unwrap_or_default());
        }
    }
    sum += network.bars.iter().map(|bar| bar_row(network, state, bar).0.powi(2)).sum::<f64>();
    sum.is_finite().then_some((sum, behind))
}

/// Residuals of all rays over their a priori standard errors, whatever their robust weights.
pub fn weighted_residuals(network: &Network, state: &State, weighting: Weighting<'_>) -> Option<Vec<[f64; 2]>> {
    let models = models(state)?;
    let weighting = Weighting { robust: &[], ..weighting };
    let mut rows: Vec<Row<0>> = Vec::new();
    let mut behind = 0;
    let mut residuals = Vec::with_capacity(network.rays.len());
    for point in 0..network.points.len() {
        if !linearise(network, state, &models, weighting, point, &mut rows, &mut behind) {
            return None;
        }
        residuals.extend(rows.iter().map(|row| row.e));
    }
    Some(residuals)
}

/// data[column·TILE + row] += factor · Σ_m a[m][row]·b[m][column], rows and columns of one block within a tile.
#[inline(always)]
fn add_outer<const M: usize, const R: usize, const C: usize>(
    data: &mut [f64],
    factor: f64,
    a: &[[f64; R]; M],
    b: &[[f64; C]; M],
) {
    for (column, to) in data.chunks_mut(TILE).take(C).enumerate() {
        let to = &mut to[..R];
        let mut sum = [0.0; R];
        for m in 0..M {
            let b = factor * b[m][column];
            for (sum, a) in sum.iter_mut().zip(&a[m]) {
                *sum += a * b;
            }
        }
        for (to, sum) in to.iter_mut().zip(&sum) {
            *to += sum;
        }
    }
}

/// The same for a block that may have fewer rows and columns than the arrays, and may belong above the diagonal.
fn add_outer_part<const M: usize, const R: usize, const C: usize>(
    normal: &mut Normal,
    factor: f64,
    (row, rows): (usize, usize),
    (column, columns): (usize, usize),
    a: &[[f64; R]; M],
    b: &[[f64; C]; M],
) {
    let above = row < column;
    let first = if above { normal.matrix.place(column, row) } else { normal.matrix.place(row, column) };
    let (row_stride, column_stride) = if above { (TILE, 1) } else { (1, TILE) };
    let data = &mut normal.matrix.data_mut()[first..];
    for j in 0..columns {
        for i in 0..rows {
            let sum: f64 = (0..M).map(|m| a[m][i] * b[m][j]).sum();
            data[j * column_stride + i * row_stride] += factor * sum;
        }
    }
}

/// All points' contributions. Returns false where a projection does not exist.
fn accumulate<const N: usize>(
    normal: &mut Normal,
    network: &Network,
    layout: &Layout,
    state: &State,
    models: &[Model],
    weighting: Weighting<'_>,
) -> bool {
    let mut rows: Vec<Row<N>> = Vec::new();
    let mut scratch = Scratch::default();
    let mut behind = 0;
    for point in 0..network.points.len() {
        if !linearise(network, state, models, weighting, point, &mut rows, &mut behind) {
            return false;
        }
        normal.cost += rows.iter().map(|r| r.e[0] * r.e[0] + r.e[1] * r.e[1]).sum::<f64>();
        let (block, x) = (&network.points[point], &state.points[point]);
        let mut n = [0.0; 6];
        let mut g = [0.0; 3];
        for row in &rows {
            for (a, e) in row.point.iter().zip(row.e) {
                n[0] += a[0] * a[0];
                n[1] += a[0] * a[1];
                n[2] += a[0] * a[2];
                n[3] += a[1] * a[1];
                n[4] += a[1] * a[2];
                n[5] += a[2] * a[2];
                (0..3).for_each(|k| g[k] += a[k] * e);
            }
        }
        for a in 0..3 {
            let (given, weight) = block.prior[a];
            let e = (x[a] - given) * weight;
            normal.cost += e * e;
            g[a] += e * weight;
            n[[0, 3, 5][a]] += weight * weight;
        }
        if block.kept {
            keep(normal, network, layout, layout.point[point], n, g, &rows);
        } else {
            eliminate(normal, network, layout, point, n, g, &rows, &mut scratch);
        }
    }
    normal.behind = behind;
    true
}

/// Blocks of a point that stays in the reduced equations.
fn keep<const N: usize>(
    normal: &mut Normal,
    network: &Network,
    layout: &Layout,
    place: usize,
    n: [f64; 6],
    g: [f64; 3],
    rows: &[Row<N>],
) {
    for (k, (i, j)) in [(0, 0), (1, 0), (2, 0), (1, 1), (2, 1), (2, 2)].into_iter().enumerate() {
        normal.add(place + i, place + j, n[k]);
    }
    (0..3).for_each(|k| normal.rhs[place + k] -= g[k]);
    for row in rows {
        let photo = (layout.photo[row.photo], 6);
        let interior = (layout.interior[row.interior], network.interiors[row.interior].estimated.len());
        add_outer_part(normal, 1.0, (place, 3), photo, &row.point, &row.pose);
        add_outer_part(normal, 1.0, (place, 3), interior, &row.point, &row.interior_rows);
        add_outer_part(normal, 1.0, interior, photo, &row.interior_rows, &row.pose);
        for (side, e) in row.e.into_iter().enumerate() {
            (0..6).for_each(|k| normal.rhs[photo.0 + k] -= row.pose[side][k] * e);
            (0..interior.1).for_each(|k| normal.rhs[interior.0 + k] -= row.interior_rows[side][k] * e);
        }
        add_square(normal, photo.0, 6, &row.pose);
        add_square(normal, interior.0, interior.1, &row.interior_rows);
    }
}

/// Lower triangle of rowsᵀ·rows, counted in the reference diagonal too.
fn add_square<const C: usize>(normal: &mut Normal, place: usize, length: usize, rows: &[[f64; C]; 2]) {
    for i in 0..length {
        for j in 0..=i {
            normal.add(place + i, place + j, rows[0][i] * rows[0][j] + rows[1][i] * rows[1][j]);
        }
    }
}

/// Working space of the elimination.
#[derive(Default)]
struct Scratch {
    /// Per ray GᵀB of its photo, one line per column of B.
    z: Vec<[[f64; 6]; 3]>,
    /// Per ray B.
    b: Vec<[[f64; 3]; 2]>,
    /// Interior orientations among the rays.
    interiors: Vec<usize>,
}

#[allow(clippy::too_many_arguments)] // the state of one elimination; a struct would only rename it
fn eliminate<const N: usize>(
    normal: &mut Normal,
    network: &Network,
    layout: &Layout,
    point: usize,
    mut n: [f64; 6],
    g: [f64; 3],
    rows: &[Row<N>],
    scratch: &mut Scratch,
) {
    let block = &network.points[point];
    let mut damping = [0.0; 3];
    for a in 0..3 {
        let diagonal = [0, 3, 5][a];
        if block.fixed[a] {
            n[diagonal] = 1.0;
        } else {
            damping[a] = normal.lambda * n[diagonal];
            n[diagonal] += damping[a];
        }
    }
    let l = factor3(n);
    let h = forward3(&l, g);
    normal.points[point] = PointFactor { l, h, damping };

    let Scratch { z, b, interiors } = scratch;
    z.clear();
    b.clear();
    interiors.clear();
    // One column of U = Bᵀ·(interior rows) per interior orientation; nearly always there is one.
    let mut u: [[f64; N]; 3] = [[0.0; N]; 3];
    let single = rows.windows(2).all(|pair| pair[0].interior == pair[1].interior);
    for row in rows {
        let b_row = row.point.map(|a| forward3(&l, a));
        let mut z_row = [[0.0; 6]; 3];
        for m in 0..3 {
            for k in 0..6 {
                z_row[m][k] = row.pose[0][k] * b_row[0][m] + row.pose[1][k] * b_row[1][m];
            }
            for k in 0..N {
                u[m][k] += row.interior_rows[0][k] * b_row[0][m] + row.interior_rows[1][k] * b_row[1][m];
            }
        }
        b.push(b_row);
        z.push(z_row);
    }
    for (i, row) in rows.iter().enumerate() {
        let place = layout.photo[row.photo];
        let e: [f64; 2] =
            std::array::from_fn(|s| row.e[s] - (b[i][s][0] * h[0] + b[i][s][1] * h[1] + b[i][s][2] * h[2]));
        for k in 0..6 {
            normal.rhs[place + k] -= row.pose[0][k] * e[0] + row.pose[1][k] * e[1];
            normal.reference[place + k] += row.pose[0][k] * row.pose[0][k] + row.pose[1][k] * row.pose[1][k];
        }
        let interior = layout.interior[row.interior];
        let length = network.interiors[row.interior].estimated.len();
        for k in 0..length {
            normal.rhs[interior + k] -= row.interior_rows[0][k] * e[0] + row.interior_rows[1][k] * e[1];
        }
        let at = normal.matrix.place(place, place);
        let data = normal.matrix.data_mut();
        add_outer(&mut data[at..], 1.0, &row.pose, &row.pose);
        // Rays are sorted by place, so that the later one of a pair is the row.
        for k in 0..=i {
            let at = normal.matrix.place(place, layout.photo[rows[k].photo]);
            add_outer(&mut normal.matrix.data_mut()[at..], -1.0, &z[i], &z[k]);
        }
        add_interior(normal, (interior, length), row);
        if single {
            // G of the photo times (interior rows - B·U).
            let mut rest = row.interior_rows;
            for (rest, b) in rest.iter_mut().zip(&b[i]) {
                for k in 0..N {
                    rest[k] -= b[0] * u[0][k] + b[1] * u[1][k] + b[2] * u[2][k];
                }
            }
            if interior > place {
                if length == N {
                    let at = normal.matrix.place(interior, place);
                    add_outer(&mut normal.matrix.data_mut()[at..], 1.0, &rest, &row.pose);
                } else if length > 0 {
                    add_outer_part(normal, 1.0, (interior, length), (place, 6), &rest, &row.pose);
                }
            }
        } else if length > 0 {
            add_outer_part(normal, 1.0, (interior, length), (place, 6), &row.interior_rows, &row.pose);
        }
    }
    if single {
        if let Some(row) = rows.first() {
            let place = layout.interior[row.interior];
            let length = network.interiors[row.interior].estimated.len();
            subtract_own(normal, place, length, &u);
        }
    } else {
        mixed_interiors(normal, network, layout, rows, b, z, interiors);
    }
}

/// Interior rows squared.
#[inline(always)]
fn add_interior<const N: usize>(normal: &mut Normal, (place, length): (usize, usize), row: &Row<N>) {
    if length == 0 {
        return;
    }
    for k in 0..length {
        normal.reference[place + k] +=
            row.interior_rows[0][k] * row.interior_rows[0][k] + row.interior_rows[1][k] * row.interior_rows[1][k];
    }
    if length == N {
        let at = normal.matrix.place(place, place);
        add_outer(&mut normal.matrix.data_mut()[at..], 1.0, &row.interior_rows, &row.interior_rows);
    } else {
        add_outer_part(normal, 1.0, (place, length), (place, length), &row.interior_rows, &row.interior_rows);
    }
}

fn subtract_own<const N: usize>(normal: &mut Normal, place: usize, length: usize, u: &[[f64; N]; 3]) {
    if length == N && length > 0 {
        let at = normal.matrix.place(place, place);
        add_outer(&mut normal.matrix.data_mut()[at..], -1.0, u, u);
    } else if length > 0 {
        add_outer_part(normal, -1.0, (place, length), (place, length), u, u);
    }
}

/// A point seen through several interior orientations: -U_qᵀU_q' among them, -U_qᵀZ_i with the photos.
fn mixed_interiors<const N: usize>(
    normal: &mut Normal,
    network: &Network,
    layout: &Layout,
    rows: &[Row<N>],
    b: &[[[f64; 3]; 2]],
    z: &[[[f64; 6]; 3]],
    interiors: &mut Vec<usize>,
) {
    interiors.extend(rows.iter().map(|row| row.interior));
    interiors.sort_unstable();
    interiors.dedup();
    let sums: Vec<[[f64; N]; 3]> = interiors
        .iter()
        .map(|interior| {
            let mut u = [[0.0; N]; 3];
            for (row, b) in rows.iter().zip(b).filter(|(row, _)| row.interior == *interior) {
                for m in 0..3 {
                    for k in 0..N {
                        u[m][k] += row.interior_rows[0][k] * b[0][m] + row.interior_rows[1][k] * b[1][m];
                    }
                }
            }
            u
        })
        .collect();
    let block = |q: usize| (layout.interior[interiors[q]], network.interiors[interiors[q]].estimated.len());
    for (q, u) in sums.iter().enumerate().filter(|(q, _)| block(*q).1 > 0) {
        for (other, v) in sums.iter().enumerate().take(q + 1).filter(|(q, _)| block(*q).1 > 0) {
            add_outer_part(normal, -1.0, block(q), block(other), u, v);
        }
        for (row, z) in rows.iter().zip(z) {
            add_outer_part(normal, -1.0, block(q), (layout.photo[row.photo], 6), u, z);
        }
    }
}

/// Steps of the points from the solution of the reduced equations.
fn back_substitute<const N: usize>(
    normal: &Normal,
    network: &Network,
    layout: &Layout,
    state: &State,
    models: &[Model],
    weighting: Weighting<'_>,
    x: &[f64],
) -> Vec<[f64; 3]> {
    let mut rows: Vec<Row<N>> = Vec::new();
    let mut behind = 0;
    (0..network.points.len())
        .map(|point| {
            if network.points[point].kept {
                let at = layout.point[point];
                return std::array::from_fn(|a| x[at + a]);
            }
            linearise(network, state, models, weighting, point, &mut rows, &mut behind);
            let PointFactor { l, h, .. } = &normal.points[point];
            let mut g = [0.0; 3];
            for row in &rows {
                let photo = &x[layout.photo[row.photo]..];
                let at = layout.interior[row.interior];
                let interior = &x[at..at + network.interiors[row.interior].estimated.len()];
                for side in 0..2 {
                    let mut y: f64 = row.pose[side].iter().zip(photo).map(|(a, x)| a * x).sum();
                    y += row.interior_rows[side].iter().zip(interior).map(|(a, x)| a * x).sum::<f64>();
                    (0..3).for_each(|k| g[k] += row.point[side][k] * y);
                }
            }
            let t = forward3(l, g);
            backward3(l, [-h[0] - t[0], -h[1] - t[1], -h[2] - t[2]])
        })
        .collect()
}
