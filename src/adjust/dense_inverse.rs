//! Blocks of a full inverse among photos and between photos and interior orientations, side by side for fast products.
//!
//! T = Q·Z of a point needs every block of Q among its photos. In the tiles of [`super::tiles`] a block above the diagonal is
//! the transpose of one below it, and neither stays in registers. Where the inverse is full and not too large, all blocks
//! of six by six are laid out once, both triangles, and a product of a block by three columns keeps its nine sums in
//! registers. None of them is inlined: within a large function the sums would leave their registers.

use wide::f64x2;

use super::cofactor::block;
use super::layout::Layout;
use super::network::Network;
use super::tiles::TileMatrix;

/// Numbers that the blocks may have in all: 64 MB.
const LARGEST: usize = 8 << 20;

/// The blocks; N numbers of an interior orientation.
pub struct DenseInverse<const N: usize> {
    photos: usize,
    /// Of photos (i, k) at i·photos + k, column by column.
    pairs: Vec<[f64; 36]>,
    /// Of a photo (six rows) and interior orientation q (N columns) at q·photos + photo.
    cross: Vec<[[f64; 6]; N]>,
    /// Of interior orientation q itself.
    own: Vec<[[f64; N]; N]>,
}

impl<const N: usize> DenseInverse<N> {
    /// Lays the blocks out; none where tiles are missing or the blocks would be too many.
    pub fn of(inverse: &TileMatrix, network: &Network, layout: &Layout) -> Option<Self> {
        let photos = network.photos.len();
        if !inverse.is_full() || photos * (36 * photos + 6 * N * network.interiors.len()) > LARGEST {
            return None;
        }
        let mut pairs = Vec::with_capacity(photos * photos);
        for row in &layout.photo {
            pairs.extend(layout.photo.iter().map(|column| {
                let block = block(inverse, *row, *column);
                std::array::from_fn(|n| block.get(n % 6, n / 6))
            }));
        }
        let mut cross = Vec::with_capacity(photos * network.interiors.len());
        for (interior, place) in network.interiors.iter().zip(&layout.interior) {
            cross.extend(layout.photo.iter().map(|photo| {
                let mut columns = [[0.0; 6]; N];
                for (j, column) in columns.iter_mut().enumerate().take(interior.estimated.len()) {
                    let block = block(inverse, *photo, *place);
                    *column = std::array::from_fn(|i| block.get(i, j));
                }
                columns
            }));
        }
        let own = network.interiors.iter().zip(&layout.interior).map(|(interior, place)| {
            let mut columns = [[0.0; N]; N];
            let length = interior.estimated.len();
            for (j, column) in columns.iter_mut().enumerate().take(length) {
                let block = block(inverse, *place, *place);
                (0..length).for_each(|i| column[i] = block.get(i, j));
            }
            columns
        });
        Some(Self { photos, pairs, cross, own: own.collect() })
    }

    /// Rows of T for photo `i`: Σ_k Q_ik·z_k over `photos` with their z.
    #[inline(never)]
    pub fn among_photos(&self, i: usize, photos: &[usize], z: &[[[f64; 6]; 3]]) -> [[f64; 6]; 3] {
        let row = &self.pairs[i * self.photos..(i + 1) * self.photos];
        let mut sums = [[f64x2::ZERO; 3]; 3];
        for (k, z) in photos.iter().zip(z) {
            let block = &row[*k];
            for c in 0..6 {
                let column: [f64x2; 3] =
                    std::array::from_fn(|r| f64x2::new([block[6 * c + 2 * r], block[6 * c + 2 * r + 1]]));
                for m in 0..3 {
                    let factor = f64x2::splat(z[m][c]);
                    for r in 0..3 {
                        sums[m][r] += column[r] * factor;
                    }
                }
            }
        }
        sums.map(|sums| {
            let [[a, b], [c, d], [e, f]] = sums.map(f64x2::to_array);
            [a, b, c, d, e, f]
        })
    }

    /// rowᵀ·Q·row of a row with the parts g of a photo and c of an interior orientation.
    #[inline(never)]
    pub fn square(&self, (photo, interior): (usize, usize), g: &[f64; 6], c: &[f64; N]) -> f64 {
        let block = &self.pairs[photo * self.photos + photo];
        let cross = &self.cross[interior * self.photos + photo];
        // Q·row in the photo's part, with twice the interior's part, which stands on both sides
        let mut photo_part = [0.0; 6];
        for k in 0..6 {
            for r in 0..6 {
                photo_part[r] += block[6 * k + r] * g[k];
            }
        }
        for (column, c) in cross.iter().zip(c) {
            for r in 0..6 {
                photo_part[r] += 2.0 * c * column[r];
            }
        }
        let mut sum: f64 = photo_part.iter().zip(g).map(|(q, g)| q * g).sum();
        for (column, factor) in self.own[interior].iter().zip(c) {
            sum += factor * column.iter().zip(c).map(|(q, c)| q * c).sum::<f64>();
        }
        sum
    }

    /// Adds what an interior orientation and a photo give each other: Q_pq·u to the photo's rows, Q_qp·z to the interior's.
    #[inline(never)]
    pub fn with_interior(
        &self,
        (photo, interior): (usize, usize),
        (z, u): (&[[f64; 6]; 3], &[[f64; N]; 3]),
        t_photo: &mut [[f64; 6]; 3],
        t_interior: &mut [[f64; N]; 3],
    ) {
        for (j, column) in self.cross[interior * self.photos + photo].iter().enumerate() {
            for m in 0..3 {
                let mut sum = 0.0;
                for r in 0..6 {
                    t_photo[m][r] += column[r] * u[m][j];
                    sum += column[r] * z[m][r];
                }
                t_interior[m][j] += sum;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    const PHOTOS: usize = 3;

    /// A symmetric matrix of three photos and one interior orientation of two numbers, laid out.
    fn laid_out() -> (Vec<Vec<f64>>, DenseInverse<2>) {
        let size = 6 * PHOTOS + 2;
        let number = |i: usize, j: usize| ((i.max(j) * 31 + i.min(j) * 7) as f64).sin();
        let matrix: Vec<Vec<f64>> = (0..size).map(|i| (0..size).map(|j| number(i, j)).collect()).collect();
        let at = |i: usize, j: usize| matrix[i][j];
        let pairs = (0..PHOTOS * PHOTOS)
            .map(|n| std::array::from_fn(|k| at(6 * (n / PHOTOS) + k % 6, 6 * (n % PHOTOS) + k / 6)))
            .collect();
        let cross = (0..PHOTOS)
            .map(|photo| std::array::from_fn(|j| std::array::from_fn(|i| at(6 * photo + i, 6 * PHOTOS + j))))
            .collect();
        let own = vec![std::array::from_fn(|j| std::array::from_fn(|i| at(6 * PHOTOS + i, 6 * PHOTOS + j)))];
        (matrix.clone(), DenseInverse { photos: PHOTOS, pairs, cross, own })
    }

    #[test]
    fn products_agree_with_the_plain_matrix() {
        let (matrix, dense) = laid_out();
        let seen = [2, 0];
        let numbers = |seed: f64| -> [[f64; 6]; 3] {
            std::array::from_fn(|m| std::array::from_fn(|k| (seed + m as f64 + 0.7 * k as f64).cos()))
        };
        let z = [numbers(0.1), numbers(2.3)];
        let t = dense.among_photos(2, &seen, &z);
        for m in 0..3 {
            for r in 0..6 {
                let plain: f64 =
                    (0..2).map(|n| (0..6).map(|c| matrix[12 + r][6 * seen[n] + c] * z[n][m][c]).sum::<f64>()).sum();
                assert!((t[m][r] - plain).abs() < 1e-14);
            }
        }
        let (u, mut t_photo, mut t_interior) = ([[0.3, -0.4], [0.5, 0.6], [-0.7, 0.8]], [[0.0; 6]; 3], [[0.0; 2]; 3]);
        dense.with_interior((1, 0), (&z[0], &u), &mut t_photo, &mut t_interior);
        for m in 0..3 {
            for r in 0..6 {
                let plain: f64 = (0..2).map(|j| matrix[6 + r][18 + j] * u[m][j]).sum();
                assert!((t_photo[m][r] - plain).abs() < 1e-14);
            }
            for j in 0..2 {
                let plain: f64 = (0..6).map(|r| matrix[18 + j][6 + r] * z[0][m][r]).sum();
                assert!((t_interior[m][j] - plain).abs() < 1e-14);
            }
        }
        let (g, c) = ([0.1, 0.2, -0.3, 0.4, 0.5, -0.6], [0.9, -1.1]);
        let row: Vec<(usize, f64)> = (0..6).map(|k| (6 + k, g[k])).chain((0..2).map(|j| (18 + j, c[j]))).collect();
        let plain: f64 = row.iter().map(|(i, a)| row.iter().map(|(j, b)| a * b * matrix[*i][*j]).sum::<f64>()).sum();
        assert!((dense.square((1, 0), &g, &c) - plain).abs() < 1e-14);
    }
}
