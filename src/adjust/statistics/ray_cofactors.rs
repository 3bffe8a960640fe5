//! Cofactors among the rays of one point, from the inverse Q of the reduced equations.
//!
//! With the photo and interior part G of ray i's rows, B = A·L⁻ᵀ and Z = ΣGᵀB (see [`crate::adjust::equations::normal`]):
//!
//! ```text
//! P_ik = G_i Q G_kᵀ,   C_i = Σ_k P_ik B_k = G_i Q Z,   K = I + ZᵀQZ = I + Σ_i B_iᵀ C_i
//! ```
//!
//! and from these follow the cofactors of the point, L⁻ᵀ K L⁻¹, of its adjusted observations, P_ii + B_i K B_iᵀ - B_i C_iᵀ -
//! C_i B_iᵀ, and what an error in one of them does to the point, L⁻ᵀ(K B_iᵀ - C_iᵀ). P_ik is two by two and serves both C_i
//! and C_k, so that Q·Z, three columns for every photo of the point, is never formed. What is not inlined below would leave
//! its registers within a larger function.

use std::hint::black_box;
use wide::f64x2;

use crate::adjust::equations::back_substitution::{EliminatedPoints, Own};
use crate::adjust::equations::collinearity::CollinearityRows;
use crate::adjust::equations::ordering::Layout;
use crate::adjust::linear::blocks::add_rows;
use crate::adjust::linear::cholesky3::{backward3, forward3};
use crate::adjust::linear::kernel::TILE;
use crate::adjust::linear::tiles::{TileMatrix, TileRow};
use crate::adjust::problem::network::Network;

use super::cofactors::block;
use super::external_reliability::DatumCorrections;

/// Two rows over the axes of a point and a zero.
type RayRows = [[f64; 4]; 2];

/// The rays of one point.
#[derive(Default)]
pub struct RayCofactors<const N: usize> {
    b: Vec<RayRows>,
    c: Vec<RayRows>,
    /// Diagonals of P_ii.
    own: Vec<[f64; 2]>,
    /// Per interior orientation of the point, its numbers of QZ.
    pub interiors: Vec<[[f64; N]; 3]>,
    /// K.
    pub k: [[f64; 3]; 3],
    columns: Vec<(u32, u32)>,
    p: Vec<[f64x2; 2]>,
}

impl<const N: usize> RayCofactors<N> {
    /// Computes everything for an eliminated point.
    #[inline(never)]
    pub fn compute(
        &mut self,
        inverse: &TileMatrix,
        layout: &Layout,
        eliminated: &EliminatedPoints,
        point: usize,
        rows: &[CollinearityRows<N>],
    ) {
        let l = &eliminated.factors[point].l;
        self.b.clear();
        self.b.extend(rows.iter().map(|row| {
            row.point.map(|a| {
                let [x, y, z] = forward3(l, a);
                [x, y, z, 0.0]
            })
        }));
        self.c.clear();
        self.c.resize(rows.len(), RayRows::default());
        self.own.clear();
        self.own.resize(rows.len(), [0.0; 2]);
        self.columns.clear();
        self.p.resize(rows.len(), [f64x2::ZERO; 2]);
        for (i, row) in rows.iter().enumerate() {
            let place = layout.photo[row.photo];
            // Rays are sorted by place, so that the later one of a pair is the row.
            self.columns.push(TileMatrix::column(place));
            let sum = among_photos(inverse, inverse.line(place), &self.columns, &rows[..=i], &self.b, &mut self.p);
            let sum = sum.map(f64x2::to_array);
            (0..2).for_each(|s| (0..3).for_each(|m| self.c[i][s][m] = sum[m][s]));
            add_products(&self.p[..i], &self.b[i], &mut self.c[..i]);
            let [x, y] = self.p[i].map(f64x2::to_array);
            self.own[i] = [x[0], y[1]];
        }
        self.with_interiors(inverse, layout, eliminated, point, rows);
        self.k = inner(&self.b, &self.c);
    }

    /// What the point's interior orientations q add, with U_q = ΣCᵀB: G_i Q_iq U_q to every ray, and to those that q sees the
    /// interior part of their rows times what QZ has at q.
    fn with_interiors(
        &mut self,
        inverse: &TileMatrix,
        layout: &Layout,
        eliminated: &EliminatedPoints,
        point: usize,
        rows: &[CollinearityRows<N>],
    ) {
        let place = |q: &Own| (layout.interior[q.interior], q.length);
        self.interiors.clear();
        for q in eliminated.own(point) {
            let u = eliminated.whole_u::<N>(q);
            let own: [[f64; N]; N] = gathered(inverse, place(q), place(q));
            let mut t = [[0.0; N]; 3];
            for other in eliminated.own(point) {
                let block: [[f64; N]; N] = gathered(inverse, place(q), place(other));
                for (t, u) in t.iter_mut().zip(eliminated.whole_u::<N>(other)) {
                    add_rows::<false, N, N>(t, &u, &block);
                }
            }
            for (i, row) in rows.iter().enumerate() {
                let photo = layout.photo[row.photo];
                let own = (row.interior == q.interior).then_some(&own);
                let (of_ray, c) = ((row, &self.b[i]), &mut self.c[i]);
                let [x, y] = if place(q).0 > photo {
                    let cross = &inverse.data()[inverse.place(place(q).0, photo)..];
                    with_interior::<N, TILE>(of_ray, (cross, own), &u, c, &mut t)
                } else {
                    let cross: [[f64; N]; 6] = gathered(inverse, place(q), (photo, 6));
                    with_interior::<N, N>(of_ray, (cross.as_flattened(), own), &u, c, &mut t)
                };
                self.own[i][0] += x;
                self.own[i][1] += y;
            }
            for (row, c) in rows.iter().zip(&mut self.c).filter(|(row, _)| row.interior == q.interior) {
                for (c, interior) in c.iter_mut().zip(&row.interior_rows) {
                    (0..3).for_each(|m| c[m] += dot(interior, &t[m]));
                }
            }
            self.interiors.push(t);
        }
    }

    /// ZᵀVᵀ of the datum's vectors V, from V·rowᵀ of every ray: Σ Bᵀ(V·rowᵀ)ᵀ.
    #[inline(never)]
    pub fn carried(&self, taken: &[DatumCorrections]) -> [[f64; 8]; 3] {
        let mut sum = [[0.0; 8]; 3];
        for (b, taken) in self.b.iter().zip(taken) {
            for (m, sum) in sum.iter_mut().enumerate() {
                add_rows::<false, 2, 8>(sum, &[b[0][m], b[1][m]], taken);
            }
        }
        sum
    }

    /// Per side of ray `i`: cofactor of the weighted adjusted observation, and shift of the point by a unit of its error.
    #[inline(never)]
    pub fn ray(&self, i: usize, l: &[f64; 6]) -> ([f64; 2], [[f64; 3]; 2]) {
        let (b, c) = (&self.b[i], &self.c[i]);
        let (mut cofactor, mut shift) = (self.own[i], [[0.0; 3]; 2]);
        for s in 0..2 {
            let kb = self.k.map(|k| k[0] * b[s][0] + k[1] * b[s][1] + k[2] * b[s][2]);
            cofactor[s] += (0..3).map(|m| b[s][m] * (kb[m] - 2.0 * c[s][m])).sum::<f64>();
            shift[s] = backward3(l, std::array::from_fn(|m| kb[m] - c[s][m]));
        }
        (cofactor, shift)
    }
}

/// QZ of a point at one of its photos, which only given values of the photo ask for.
pub fn at_photo<const N: usize>(
    inverse: &TileMatrix,
    network: &Network,
    layout: &Layout,
    eliminated: &EliminatedPoints,
    point: usize,
    photo: usize,
) -> [[f64; 6]; 3] {
    let mut t = [[0.0; 6]; 3];
    let here = (layout.photo[photo], 6);
    for ray in network.points[point].rays.clone() {
        let z = eliminated.z(network, point, ray);
        let block: [[f64; 6]; 6] = gathered(inverse, here, (layout.photo[network.rays[ray].photo], 6));
        t.iter_mut().zip(&z).for_each(|(t, z)| add_rows::<false, 6, 6>(t, z, &block));
    }
    for q in eliminated.own(point) {
        let block: [[f64; 6]; N] = gathered(inverse, here, (layout.interior[q.interior], q.length));
        let u = eliminated.whole_u::<N>(q);
        t.iter_mut().zip(&u).for_each(|(t, u)| add_rows::<false, N, 6>(t, u, &block));
    }
    t
}

/// Columns of a block of the inverse, zeros beyond its rows and columns.
#[inline(never)]
fn gathered<const R: usize, const C: usize>(
    inverse: &TileMatrix,
    (row, rows): (usize, usize),
    (column, columns): (usize, usize),
) -> [[f64; R]; C] {
    let mut gathered = [[0.0; R]; C];
    let block = block(inverse, row, column);
    for (j, to) in gathered.iter_mut().enumerate().take(columns) {
        match block.column(j) {
            Some(from) => to[..rows].copy_from_slice(&from[..rows]),
            None => (0..rows).for_each(|i| to[i] = block.get(i, j)),
        }
    }
    gathered
}

#[inline(always)]
fn pair(from: &[f64], k: usize) -> f64x2 {
    f64x2::new([from[k], from[k + 1]])
}

#[inline(always)]
fn dot<const C: usize>(a: &[f64; C], b: &[f64; C]) -> f64 {
    let mut sum = f64x2::ZERO;
    for k in (0..C).step_by(2) {
        sum += pair(a, k) * pair(b, k);
    }
    let [x, y] = sum.to_array();
    x + y
}

/// P_ik for the last of the rays, i, and all k up to it: per side of k both sides of i. Returns what these rays add to C_iᵀ.
/// This is where the time goes.
///
/// Q_ik G_kᵀ comes first, whose numbers stand in pairs as those of a column of Q_ik do. The columns of a block are a loop in the
/// machine's code too, which their number, unknown to the compiler, sees to: V8 puts all loads of a stretch without branches
/// before its arithmetic, and unrolled they would overflow the registers.
#[inline(never)]
fn among_photos<const N: usize>(
    inverse: &TileMatrix,
    line: TileRow,
    columns: &[(u32, u32)],
    rows: &[CollinearityRows<N>],
    b: &[RayRows],
    p: &mut [[f64x2; 2]],
) -> [f64x2; 3] {
    let six = black_box(6).min(6);
    let mut sum = [f64x2::ZERO; 3];
    let Some(last) = rows.last() else { return sum };
    let g = &last.pose;
    for (((column, row), b), p) in columns.iter().zip(rows).zip(b).zip(p) {
        let block = &inverse.data()[line.at(inverse, *column)..][..5 * TILE + 6];
        let (mut x, mut y) = ([f64x2::ZERO; 3], [f64x2::ZERO; 3]);
        for ((q, h), k) in block.chunks(TILE).zip(&row.pose[0][..six]).zip(&row.pose[1][..six]) {
            let q = &q[..6];
            let (h, k) = (f64x2::splat(*h), f64x2::splat(*k));
            for r in 0..3 {
                x[r] += pair(q, 2 * r) * h;
                y[r] += pair(q, 2 * r) * k;
            }
        }
        let both = [x, y].map(|product| {
            let [a, b] =
                g.map(|g| (pair(&g, 0) * product[0] + pair(&g, 2) * product[1] + pair(&g, 4) * product[2]).to_array());
            f64x2::new([a[0], b[0]]) + f64x2::new([a[1], b[1]])
        });
        for m in 0..3 {
            sum[m] += both[0] * f64x2::splat(b[0][m]) + both[1] * f64x2::splat(b[1][m]);
        }
        *p = both;
    }
    sum
}

/// C_k += P_ikᵀ B_i for the rays before i.
#[inline(never)]
fn add_products(p: &[[f64x2; 2]], b: &RayRows, c: &mut [RayRows]) {
    let b = b.map(|b| [pair(&b, 0), pair(&b, 2)]);
    for (p, c) in p.iter().zip(c) {
        for (p, c) in p.iter().zip(c) {
            let [x, y] = p.to_array().map(f64x2::splat);
            let sums = [x * b[0][0] + y * b[1][0], x * b[0][1] + y * b[1][1]];
            let [low, high] = [pair(c, 0) + sums[0], pair(c, 2) + sums[1]].map(f64x2::to_array);
            *c = [low[0], low[1], high[0], high[1]];
        }
    }
}

/// K.
#[inline(never)]
fn inner(b: &[RayRows], c: &[RayRows]) -> [[f64; 3]; 3] {
    let mut k = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    for (b, c) in b.iter().zip(c) {
        for (m, k) in k.iter_mut().enumerate() {
            add_rows::<false, 2, 4>(k, &[b[0][m], b[1][m]], c);
        }
    }
    k.map(|[x, y, z, _]| [x, y, z])
}

/// One ray's part of [`RayCofactors::with_interiors`], by the block Q_q,photo, whose columns stand STRIDE apart, and, if q sees
/// the ray, Q_qq; returns what the diagonal of P_ii gains.
#[inline(never)]
fn with_interior<const N: usize, const STRIDE: usize>(
    (row, b): (&CollinearityRows<N>, &RayRows),
    (cross, own): (&[f64], Option<&[[f64; N]; N]>),
    u: &[[f64; N]; 3],
    c: &mut RayRows,
    t: &mut [[f64; N]; 3],
) -> [f64; 2] {
    let cross = &cross[..5 * STRIDE + N];
    let mut y = [[0.0; N]; 2];
    for s in 0..2 {
        for k in (0..N).step_by(2) {
            let mut sum = pair(cross, k) * f64x2::splat(row.pose[s][0]);
            for j in 1..6 {
                sum += pair(cross, j * STRIDE + k) * f64x2::splat(row.pose[s][j]);
            }
            y[s][k..k + 2].copy_from_slice(&sum.to_array());
        }
        (0..3).for_each(|m| c[s][m] += dot(&y[s], &u[m]));
    }
    for m in 0..3 {
        add_rows::<false, 2, N>(&mut t[m], &[b[0][m], b[1][m]], &y);
    }
    let Some(own) = own else { return [0.0; 2] };
    std::array::from_fn(|s| {
        let interior = &row.interior_rows[s];
        let mut sum = y[s].map(|y| 2.0 * y);
        add_rows::<false, N, N>(&mut sum, interior, own);
        dot(&sum, interior)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adjust::linear::tiles::TilePattern;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn products_among_rays_agree_with_the_plain_matrix() {
        // Three photos in two tiles.
        let places = [6, 30, TILE + 12];
        let number = |i: usize, j: usize| ((i.max(j) * 31 + i.min(j) * 7) as f64).sin();
        let mut q = TileMatrix::new(TilePattern::new(2, [(0, 0), (1, 0), (1, 1)].into_iter()));
        for column in 0..2 * TILE {
            for row in (0..2 * TILE).filter(|row| row / TILE >= column / TILE) {
                let at = q.place(row, column);
                q.data_mut()[at] = number(row, column);
            }
        }
        let pose = |k: usize, s: usize, r: usize| (0.4 + k as f64 + 2.1 * s as f64 + 0.7 * r as f64).cos();
        let row = |k: usize| CollinearityRows::<0> {
            pose: [0, 1].map(|s| [0, 1, 2, 3, 4, 5].map(|r| pose(k, s, r))),
            ..CollinearityRows::ZERO
        };
        let rows: Vec<CollinearityRows<0>> = (0..3).map(row).collect();
        let b: Vec<RayRows> = (0..3)
            .map(|k| {
                [0, 1].map(|s| [0, 1, 2, 3].map(|m| if m < 3 { (k * 5 + s * 3 + m) as f64 * 0.3 - 1.0 } else { 0.0 }))
            })
            .collect();
        let columns: Vec<(u32, u32)> = places.iter().map(|place| TileMatrix::column(*place)).collect();
        let (mut c, mut p) = (vec![RayRows::default(); 3], vec![[f64x2::ZERO; 2]; 3]);
        for i in 0..3 {
            let sum = among_photos(&q, q.line(places[i]), &columns[..=i], &rows[..=i], &b, &mut p);
            let sum = sum.map(f64x2::to_array);
            (0..2).for_each(|s| (0..3).for_each(|m| c[i][s][m] = sum[m][s]));
            add_products(&p[..i], &b[i], &mut c[..i]);
        }
        let plain = |i: usize, s: usize, k: usize, t: usize| -> f64 {
            (0..36).map(|n| pose(i, s, n / 6) * number(places[i] + n / 6, places[k] + n % 6) * pose(k, t, n % 6)).sum()
        };
        for (i, s, m) in (0..18).map(|n| (n / 6, n / 3 % 2, n % 3)) {
            let wanted: f64 = (0..6).map(|n| plain(i, s, n / 2, n % 2) * b[n / 2][n % 2][m]).sum();
            assert!((c[i][s][m] - wanted).abs() < 1e-12, "{i} {s} {m}: {} {wanted}", c[i][s][m]);
        }
    }
}
