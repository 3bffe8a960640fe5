//! Sparse matrices by rows, as numerical libraries read them (compressed sparse rows).

use std::fmt::Write as _;

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

/// A sparse matrix: row i has the entries `row_starts[i]..row_starts[i + 1]` of `column_indices` and `values`, ascending by column.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SparseMatrix {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// First entry of every row, and the number of entries at the end.
    pub row_starts: Vec<usize>,
    /// Column of every entry, counted from 0.
    pub column_indices: Vec<usize>,
    /// The entries.
    pub values: Vec<f64>,
}

impl SparseMatrix {
    /// From entries row by row; entries of one row and column are added, zeros are dropped.
    pub fn from_rows(columns: usize, rows: impl IntoIterator<Item = Vec<(usize, f64)>>) -> Self {
        let mut matrix = Self { columns, row_starts: vec![0], ..Self::default() };
        for mut row in rows {
            row.sort_by_key(|entry| entry.0);
            let mut at = 0;
            while at < row.len() {
                let column = row[at].0;
                let same = row[at..].iter().take_while(|entry| entry.0 == column);
                let (count, sum) = same.fold((0, 0.0), |(count, sum), entry| (count + 1, sum + entry.1));
                if sum != 0.0 {
                    matrix.column_indices.push(column);
                    matrix.values.push(sum);
                }
                at += count;
            }
            matrix.rows += 1;
            matrix.row_starts.push(matrix.values.len());
        }
        matrix
    }

    /// Entries of a row: column and value.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.row_starts[row]..self.row_starts[row + 1];
        self.column_indices[range.clone()].iter().copied().zip(self.values[range].iter().copied())
    }

    /// AᵀPA with the weights of the rows; symmetric, both triangles.
    pub fn normal(&self, weights: &[f64]) -> Self {
        // By columns: row and entry.
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); self.columns];
        for row in 0..self.rows.min(weights.len()) {
            self.row(row).for_each(|(column, a)| columns[column].push((row, a)));
        }
        // Sums of the present row of the product, and which of them it has.
        let (mut sums, mut has) = (vec![0.0; self.columns], vec![false; self.columns]);
        let mut there = Vec::new();
        let mut product = Self { columns: self.columns, row_starts: vec![0], ..Self::default() };
        for column in &columns {
            for &(row, a) in column {
                let weighted = weights[row] * a;
                for (j, b) in self.row(row) {
                    if !std::mem::replace(&mut has[j], true) {
                        there.push(j);
                    }
                    sums[j] += weighted * b;
                }
            }
            there.sort_unstable();
            for j in there.drain(..) {
                has[j] = false;
                let sum = std::mem::take(&mut sums[j]);
                if sum != 0.0 {
                    product.column_indices.push(j);
                    product.values.push(sum);
                }
            }
            product.rows += 1;
            product.row_starts.push(product.values.len());
        }
        product
    }

    /// AᵀPl.
    pub fn transposed_times(&self, weights: &[f64], l: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.columns];
        for row in 0..self.rows {
            for (column, a) in self.row(row) {
                product[column] += a * weights[row] * l[row];
            }
        }
        product
    }

    /// All entries.
    pub fn dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.rows, self.columns);
        for row in 0..self.rows {
            self.row(row).for_each(|(column, value)| dense[(row, column)] = value);
        }
        dense
    }

    /// In the Matrix Market coordinate format, which counts from 1.
    pub fn matrix_market(&self) -> String {
        let mut text = format!(
            "%%MatrixMarket matrix coordinate real general\n{} {} {}\n",
            self.rows,
            self.columns,
            self.values.len()
        );
        for row in 0..self.rows {
            for (column, value) in self.row(row) {
                let _ = writeln!(text, "{} {} {value:e}", row + 1, column + 1);
            }
        }
        text
    }
}

/// A dense matrix or vector in NumPy's format (.npy, version 1.0), row by row.
pub fn npy(rows: usize, columns: Option<usize>, values: impl Iterator<Item = f64>) -> Vec<u8> {
    let shape = columns.map_or_else(|| format!("({rows},)"), |columns| format!("({rows}, {columns})"));
    let mut head = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
    // Magic, version and length take 10 bytes; the data begins at a multiple of 64.
    let padding = (64 - (10 + head.len() + 1) % 64) % 64;
    head.extend(std::iter::repeat_n(' ', padding));
    head.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((head.len() as u16).to_le_bytes());
    bytes.extend(head.as_bytes());
    values.for_each(|value| bytes.extend(value.to_le_bytes()));
    bytes
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    fn matrix() -> SparseMatrix {
        SparseMatrix::from_rows(3, [vec![(2, 5.0), (0, 1.0), (2, -2.0)], vec![], vec![(1, 4.0), (0, 0.0)]])
    }

    #[test]
    fn entries_are_sorted_added_and_zeros_dropped() {
        let matrix = matrix();
        assert_eq!(matrix.row_starts, [0, 2, 2, 3]);
        assert_eq!(matrix.row(0).collect::<Vec<_>>(), [(0, 1.0), (2, 3.0)]);
        assert_eq!(matrix.dense(), DMatrix::from_row_slice(3, 3, &[1.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 4.0, 0.0]));
    }

    #[test]
    fn products_are_those_of_the_dense_matrix() {
        let (matrix, weights, l) = (matrix(), [2.0, 1.0, 0.5], [1.0, 7.0, -3.0]);
        let (a, p) = (matrix.dense(), DMatrix::from_diagonal(&nalgebra::DVector::from_row_slice(&weights)));
        assert_eq!(matrix.normal(&weights).dense(), a.transpose() * &p * &a);
        let product = a.transpose() * p * nalgebra::DVector::from_row_slice(&l);
        assert_eq!(matrix.transposed_times(&weights, &l), product.as_slice());
    }

    #[test]
    fn files_say_their_shape() {
        assert!(matrix().matrix_market().contains("\n3 3 3\n1 1 1e0\n1 3 3e0\n3 2 4e0\n"));
        let bytes = npy(2, Some(1), [1.5, -2.0].into_iter());
        assert_eq!(bytes.len() % 64, 16);
        assert_eq!(&bytes[bytes.len() - 16..], [1.5f64.to_le_bytes(), (-2.0f64).to_le_bytes()].concat());
    }
}
