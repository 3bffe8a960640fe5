//! Symmetric positive definite matrix in square tiles: only tiles that are not zero in the Cholesky factor exist.
//!
//! A dense matrix has all tiles of the lower triangle; where photos share few points most are absent. Factorisation is
//! L·Lᵀ tile by tile (right-looking); the inverse is computed on the factor's own pattern (K. Takahashi, J. Fagan, M.-S.
//! Chin 1973), which contains every pair of photos that share a point:
//!
//! ```text
//! Z = A⁻¹,  Y_IK = L_IK L_KK⁻¹:   Z_IK = -Σ_J Z_IJ Y_JK (I, J > K),   Z_KK = L_KK⁻ᵀ L_KK⁻¹ - Σ_J Z_JKᵀ Y_JK
//! ```

use super::kernel::{self, AREA, TILE, Tile};

/// Tile is absent.
const ABSENT: u32 = u32::MAX;

/// Which tiles exist, after fill-in.
#[derive(Clone, Debug)]
pub struct TilePattern {
    /// Tiles along one side.
    pub side: usize,
    /// Slot of tile (row, column), row-major, lower triangle; slots run column by column.
    slot: Vec<u32>,
    /// Rows of every column, the diagonal first.
    rows: Vec<Vec<usize>>,
    count: usize,
}

impl TilePattern {
    /// Fill-in of the lower-triangle tiles `present` (row, column).
    pub fn new(side: usize, present: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut filled = vec![false; side * side];
        for (row, column) in present {
            filled[row.max(column) * side + row.min(column)] = true;
        }
        let mut slot = vec![ABSENT; side * side];
        let mut rows = Vec::with_capacity(side);
        let mut count = 0;
        for k in 0..side {
            let mut column = vec![k];
            column.extend((k + 1..side).filter(|i| filled[i * side + k]));
            for (n, &j) in column.iter().enumerate().skip(1) {
                for &i in &column[n..] {
                    filled[i * side + j] = true;
                }
            }
            for &i in &column {
                slot[i * side + k] = count as u32;
                count += 1;
            }
            rows.push(column);
        }
        Self { side, slot, rows, count }
    }

    /// Tile products of a factorisation.
    pub fn cost(&self) -> usize {
        self.rows.iter().map(|column| column.len() * (column.len() + 1) / 2).sum()
    }

    fn slot(&self, row: usize, column: usize) -> usize {
        self.slot[row * self.side + column] as usize
    }
}

/// The matrix, or its factor, or its inverse on the pattern.
#[derive(Clone, Debug)]
pub struct TileMatrix {
    pattern: TilePattern,
    data: Vec<f64>,
}

/// A row of the matrix.
#[derive(Clone, Copy, Debug)]
pub struct TileRow {
    first: usize,
    row: usize,
}

impl TileRow {
    /// As [`TileMatrix::place`] of this row and a column ([`TileMatrix::column`]) not after it.
    #[inline]
    pub fn at(self, matrix: &TileMatrix, (tile, place): (u32, u32)) -> usize {
        matrix.pattern.slot[self.first + tile as usize] as usize * AREA + place as usize + self.row
    }
}

fn tile(data: &[f64], slot: usize) -> &Tile {
    let (tiles, _) = data.as_chunks::<AREA>();
    &tiles[slot]
}

fn tile_mut(data: &mut [f64], slot: usize) -> &mut Tile {
    let (tiles, _) = data.as_chunks_mut::<AREA>();
    &mut tiles[slot]
}

impl TileMatrix {
    /// Zeros on a pattern.
    pub fn new(pattern: TilePattern) -> Self {
        let data = vec![0.0; pattern.count * AREA];
        Self { pattern, data }
    }

    /// Sets everything to zero.
    pub fn clear(&mut self) {
        self.data.fill(0.0);
    }

    /// Index of the number (row, column) of the lower triangle; numbers of one column within a tile follow each other,
    /// the next column is [`TILE`] further. The tile must exist.
    #[inline]
    pub fn place(&self, row: usize, column: usize) -> usize {
        self.pattern.slot(row / TILE, column / TILE) * AREA + column % TILE * TILE + row % TILE
    }

    /// The tile and the place in it of a column, for [`TileRow::at`].
    #[inline]
    pub fn column(column: usize) -> (u32, u32) {
        ((column / TILE) as u32, (column % TILE * TILE) as u32)
    }

    /// A row, for the places of several numbers in it.
    #[inline]
    pub fn line(&self, row: usize) -> TileRow {
        TileRow { first: row / TILE * self.pattern.side, row: row % TILE }
    }

    /// The numbers, for [`Self::place`].
    #[inline]
    pub fn data(&self) -> &[f64] {
        &self.data
    }

    /// The numbers, for [`Self::place`].
    #[inline]
    pub fn data_mut(&mut self) -> &mut [f64] {
        &mut self.data
    }

    /// Cholesky factorisation in place. A pivot that is at most `tolerance` of its `reference` is replaced by the
    /// reference and its index returned: the matrix is singular within the precision of the numbers.
    pub fn factor(&mut self, reference: &[f64], tolerance: f64) -> Vec<usize> {
        let mut singular = Vec::new();
        for k in 0..self.pattern.side {
            let base = k * TILE;
            let rows = &self.pattern.rows[k];
            let first = self.pattern.slot(k, k);
            kernel::factor(tile_mut(&mut self.data, first), |at, pivot| {
                let index = base + at;
                let scale = reference[index];
                if pivot > tolerance * scale && pivot.is_finite() {
                    pivot
                } else {
                    singular.push(index);
                    if scale > 0.0 && scale.is_finite() { scale } else { 1.0 }
                }
            });
            let (diagonal, column) = self.data[first * AREA..].split_at_mut(AREA);
            for n in 0..rows.len() - 1 {
                kernel::solve_right(tile_mut(column, n), tile(diagonal, 0));
            }
            for (n, &j) in rows.iter().enumerate().skip(1) {
                for (m, &i) in rows.iter().enumerate().skip(n) {
                    // Slots of later columns lie behind those of this one.
                    let target = self.pattern.slot(i, j);
                    let (before, after) = self.data.split_at_mut(target * AREA);
                    let (a, b) = (tile(before, first + m), tile(before, first + n));
                    if m == n {
                        kernel::subtract_square(tile_mut(after, 0), a);
                    } else {
                        kernel::subtract_product(tile_mut(after, 0), a, b);
                    }
                }
            }
        }
        singular
    }

    /// x := (L·Lᵀ)⁻¹ x with the factor.
    pub fn solve(&self, x: &mut [f64]) {
        let side = self.pattern.side;
        for k in 0..side {
            let rows = &self.pattern.rows[k];
            let first = self.pattern.slot(k, k);
            let (before, rest) = x.split_at_mut((k + 1) * TILE);
            let x_k = &mut before[k * TILE..];
            let diagonal = tile(&self.data, first);
            for (j, column) in diagonal.chunks_exact(TILE).enumerate() {
                x_k[j] /= column[j];
                let value = x_k[j];
                for (x, l) in x_k[j + 1..].iter_mut().zip(&column[j + 1..]) {
                    *x -= l * value;
                }
            }
            for (n, &i) in rows.iter().enumerate().skip(1) {
                let x_i = &mut rest[(i - k - 1) * TILE..(i - k) * TILE];
                for (column, &value) in tile(&self.data, first + n).chunks_exact(TILE).zip(x_k.iter()) {
                    for (x, l) in x_i.iter_mut().zip(column) {
                        *x -= l * value;
                    }
                }
            }
        }
        for k in (0..side).rev() {
            let rows = &self.pattern.rows[k];
            let first = self.pattern.slot(k, k);
            let (before, rest) = x.split_at_mut((k + 1) * TILE);
            let x_k = &mut before[k * TILE..];
            for (n, &i) in rows.iter().enumerate().skip(1) {
                let x_i = &rest[(i - k - 1) * TILE..(i - k) * TILE];
                for (column, x) in tile(&self.data, first + n).chunks_exact(TILE).zip(x_k.iter_mut()) {
                    *x -= kernel::dot(column, x_i);
                }
            }
            for (j, column) in tile(&self.data, first).chunks_exact(TILE).enumerate().rev() {
                x_k[j] = (x_k[j] - kernel::dot(&column[j + 1..], &x_k[j + 1..])) / column[j];
            }
        }
    }

    /// The inverse on the pattern, from the factor; diagonal tiles are full, others hold the lower triangle's tiles.
    pub fn inverse(&self) -> Self {
        let mut inverse = Self { pattern: self.pattern.clone(), data: vec![0.0; self.data.len()] };
        let mut turned = Box::new([0.0; AREA]);
        for k in (0..self.pattern.side).rev() {
            let rows = &self.pattern.rows[k];
            let first = self.pattern.slot(k, k);
            // L_KK⁻ᵀ, an upper triangle.
            let upper = kernel::inverse_transposed(tile(&self.data, first));
            // -Yᵀ = -(L_IK L_KK⁻¹)ᵀ = -L_KK⁻ᵀ L_IKᵀ of every row of the column.
            let negative: Vec<Box<Tile>> = (1..rows.len())
                .map(|n| {
                    let mut product = Box::new([0.0; AREA]);
                    kernel::subtract_upper_product(&mut product, &upper, tile(&self.data, first + n));
                    product
                })
                .collect();
            let behind = (first + rows.len()) * AREA;
            let (column, later) = inverse.data[first * AREA..].split_at_mut(behind - first * AREA);
            for (n, &i) in rows.iter().enumerate().skip(1) {
                let target = tile_mut(column, n);
                for (m, &j) in rows.iter().enumerate().skip(1) {
                    // target += Z_IJ·(-Y_JK)
                    let (row, at) = (i.max(j), i.min(j));
                    let z = tile(later, self.pattern.slot(row, at) - first - rows.len());
                    if i >= j {
                        kernel::add_product(target, z, &negative[m - 1]);
                    } else {
                        kernel::transpose(z, &mut turned);
                        kernel::add_product(target, &turned, &negative[m - 1]);
                    }
                }
            }
            let (diagonal, below) = column.split_at_mut(AREA);
            let diagonal = tile_mut(diagonal, 0);
            kernel::add_upper_square(diagonal, &upper);
            for (n, negative) in negative.iter().enumerate() {
                kernel::transpose(tile(below, n), &mut turned);
                kernel::add_symmetric_product(diagonal, &turned, negative);
            }
            kernel::mirror(diagonal);
        }
        inverse
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    /// A banded positive definite matrix of five tiles with a full last row, as a network with one camera has it.
    fn matrix() -> DMatrix<f64> {
        let n = 5 * TILE;
        DMatrix::from_fn(n, n, |i, j| {
            let near = i.abs_diff(j) < 60 || i.max(j) >= 4 * TILE;
            let value = ((i * j + i + j) as f64).sin();
            if i == j {
                150.0 + (i as f64).cos()
            } else if near {
                value
            } else {
                0.0
            }
        })
    }

    fn tiled(dense: &DMatrix<f64>) -> TileMatrix {
        let side = dense.nrows() / TILE;
        let present = (0..dense.nrows()).flat_map(|j| (j..dense.nrows()).map(move |i| (i, j)));
        let present = present.filter(|&(i, j)| dense[(i, j)] != 0.0).map(|(i, j)| (i / TILE, j / TILE));
        let mut tiles = TileMatrix::new(TilePattern::new(side, present));
        for j in 0..dense.nrows() {
            for i in j..dense.nrows() {
                if dense[(i, j)] != 0.0 {
                    let at = tiles.place(i, j);
                    tiles.data_mut()[at] = dense[(i, j)];
                }
            }
        }
        tiles
    }

    #[test]
    fn solution_and_inverse_agree_with_dense_algebra() {
        let dense = matrix();
        let mut tiles = tiled(&dense);
        assert!(tiles.pattern.count < 15, "the band leaves tiles out: {}", tiles.pattern.count);
        let reference: Vec<f64> = dense.diagonal().iter().copied().collect();
        assert!(tiles.factor(&reference, 1e-12).is_empty());
        let wanted = DVector::from_fn(dense.nrows(), |i, _| (i as f64).sin());
        let mut x: Vec<f64> = (&dense * &wanted).iter().copied().collect();
        tiles.solve(&mut x);
        assert!(x.iter().zip(wanted.iter()).all(|(x, y)| (x - y).abs() < 1e-12));
        let inverse = tiles.inverse();
        let expected = dense.clone().try_inverse().expect("regular");
        for j in 0..dense.nrows() {
            for i in j..dense.nrows() {
                if dense[(i, j)] != 0.0 {
                    let got = inverse.data()[inverse.place(i, j)];
                    assert!((got - expected[(i, j)]).abs() < 1e-14, "{i} {j}: {got} {}", expected[(i, j)]);
                }
            }
        }
    }

    #[test]
    fn a_singular_matrix_names_its_pivots() {
        let mut dense = matrix();
        // Row 100 becomes a copy of row 99.
        for j in 0..dense.nrows() {
            dense[(100, j)] = dense[(99, j)];
        }
        for i in 0..dense.nrows() {
            dense[(i, 100)] = dense[(i, 99)];
        }
        let reference: Vec<f64> = dense.diagonal().iter().copied().collect();
        assert_eq!(tiled(&dense).factor(&reference, 1e-12), [100]);
    }
}
