//! Products of square tiles, the inner loop of factorisation and inversion.
//!
//! A tile is [`TILE`] × [`TILE`] numbers, column after column. The loops run over fixed-size arrays so that the
//! compiler turns them into two-lane SIMD (wasm simd128, SSE2) without unsafe code; [`plain`] holds the same operations
//! as textbook loops, against which the tests compare them.

/// Rows and columns of a tile: eight photos of six parameters.
pub const TILE: usize = 48;
/// Numbers in a tile.
pub const AREA: usize = TILE * TILE;

/// Tile data.
pub type Tile = [f64; AREA];

/// Register block: four rows by four columns.
const R: usize = 4;
// Else the last block of a column would have rows of none.
const _: () = assert!(TILE.is_multiple_of(R));

/// The columns of a tile, or of its first part.
#[inline(always)]
fn columns(part: &[f64]) -> &[[f64; TILE]] {
    part.as_chunks::<TILE>().0
}

/// sum += a·bᵀ of one register block. By places: where a crate is compiled in several units that are not optimised across each other, as
/// in cargo's dev profile, the pairs of an iterator would be made by calls.
#[inline(always)]
fn multiply(sum: &mut [[f64; R]; R], a: &[f64; R], b: &[f64; R]) {
    for k in 0..R {
        for row in 0..R {
            sum[k][row] += a[row] * b[k];
        }
    }
}

/// The four numbers of a column from a multiple of four on.
#[inline(always)]
fn four(column: &[f64], from: usize) -> &[f64; R] {
    &column.as_chunks::<R>().0[from / R]
}

/// c[0..4 rows from i, 4 columns from j] ± = a[rows i..] · b[rows j..]ᵀ over the columns from `first` on, minus if `SUBTRACT`.
#[inline(always)]
fn block<const SUBTRACT: bool>(c: &mut Tile, a: &Tile, b: &Tile, i: usize, j: usize, first: usize) {
    let mut sum = [[0.0; R]; R];
    let (a, b) = (columns(a), columns(b));
    for column in first..TILE {
        multiply(&mut sum, four(&a[column], i), four(&b[column], j));
    }
    for (k, sum) in sum.iter().enumerate() {
        let start = (j + k) * TILE + i;
        for row in 0..R {
            if SUBTRACT {
                c[start + row] -= sum[row];
            } else {
                c[start + row] += sum[row];
            }
        }
    }
}

/// C -= A·Bᵀ.
pub fn subtract_product(c: &mut Tile, a: &Tile, b: &Tile) {
    for j in (0..TILE).step_by(R) {
        for i in (0..TILE).step_by(R) {
            block::<true>(c, a, b, i, j, 0);
        }
    }
}

/// C += A·Bᵀ.
pub fn add_product(c: &mut Tile, a: &Tile, b: &Tile) {
    for j in (0..TILE).step_by(R) {
        for i in (0..TILE).step_by(R) {
            block::<false>(c, a, b, i, j, 0);
        }
    }
}

/// C -= U·Bᵀ with the upper triangle U, zeros below.
pub fn subtract_upper_product(c: &mut Tile, u: &Tile, b: &Tile) {
    for j in (0..TILE).step_by(R) {
        for i in (0..TILE).step_by(R) {
            block::<true>(c, u, b, i, j, i);
        }
    }
}

/// The lower triangle of C += U·Uᵀ with the upper triangle U, zeros below (and of the register blocks above the diagonal).
pub fn add_upper_square(c: &mut Tile, u: &Tile) {
    for j in (0..TILE).step_by(R) {
        for i in (j..TILE).step_by(R) {
            block::<false>(c, u, u, i, j, i);
        }
    }
}

/// The lower triangle of C += A·Bᵀ, a product that is symmetric (and of the register blocks above the diagonal).
pub fn add_symmetric_product(c: &mut Tile, a: &Tile, b: &Tile) {
    for j in (0..TILE).step_by(R) {
        for i in (j..TILE).step_by(R) {
            block::<false>(c, a, b, i, j, 0);
        }
    }
}

/// Repeats the lower triangle above the diagonal.
pub fn mirror(c: &mut Tile) {
    for j in 1..TILE {
        for i in 0..j {
            c[j * TILE + i] = c[i * TILE + j];
        }
    }
}

/// The lower triangle of C -= A·Aᵀ (the strip above the diagonal within a register block is changed too).
pub fn subtract_square(c: &mut Tile, a: &Tile) {
    for j in (0..TILE).step_by(R) {
        for i in (j..TILE).step_by(R) {
            block::<true>(c, a, a, i, j, 0);
        }
    }
}

/// A := A·L⁻ᵀ with the lower triangle L.
pub fn solve_right(a: &mut Tile, l: &Tile) {
    for j in (0..TILE).step_by(R) {
        // Columns j.. less what the finished columns contribute, then the small triangle.
        let (done, rest) = a.split_at_mut(j * TILE);
        for i in (0..TILE).step_by(R) {
            let mut sum = [[0.0; R]; R];
            let (finished, triangle) = (columns(done), columns(l));
            for k in 0..j {
                multiply(&mut sum, four(&finished[k], i), four(&triangle[k], j));
            }
            for column in 0..R {
                let inverse = 1.0 / l[(j + column) * TILE + j + column];
                for row in 0..R {
                    let mut value = rest[column * TILE + i + row] - sum[column][row];
                    for k in 0..column {
                        value -= rest[k * TILE + i + row] * l[(j + k) * TILE + j + column];
                    }
                    rest[column * TILE + i + row] = value * inverse;
                }
            }
        }
    }
}

/// Cholesky factor of a tile in its lower triangle; `pivot` sees index and value of every pivot and returns the one used.
pub fn factor(a: &mut Tile, mut pivot: impl FnMut(usize, f64) -> f64) {
    for j in (0..TILE).step_by(R) {
        let (done, rest) = a.split_at_mut(j * TILE);
        for i in (j..TILE).step_by(R) {
            let mut sum = [[0.0; R]; R];
            for column in columns(done) {
                multiply(&mut sum, four(column, i), four(column, j));
            }
            for (k, sum) in sum.iter().enumerate() {
                for (row, sum) in sum.iter().enumerate() {
                    rest[k * TILE + i + row] -= sum;
                }
            }
        }
        for column in 0..R {
            let at = j + column;
            for k in 0..column {
                let (left, right) = rest.split_at_mut(column * TILE);
                let factor = left[k * TILE + at];
                for (value, left) in right[at..TILE].iter_mut().zip(&left[k * TILE + at..(k + 1) * TILE]) {
                    *value -= factor * left;
                }
            }
            let diagonal = pivot(at, rest[column * TILE + at]).sqrt();
            rest[column * TILE + at] = diagonal;
            let inverse = 1.0 / diagonal;
            for value in &mut rest[column * TILE + at + 1..(column + 1) * TILE] {
                *value *= inverse;
            }
        }
    }
}

/// Σ a·b in sums side by side: one alone would wait for every addition.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    let mut sums = [0.0; 8];
    for (a, b) in a.iter().zip(b) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    let [a, b, c, d, e, f, g, h] = sums;
    ((a + b) + (c + d)) + ((e + f) + (g + h)) + rest
}

/// Transposed copy.
pub fn transpose(from: &Tile, to: &mut Tile) {
    for (j, column) in from.chunks_exact(TILE).enumerate() {
        for (i, value) in column.iter().enumerate() {
            to[i * TILE + j] = *value;
        }
    }
}

/// L⁻ᵀ of the lower triangle L, full tile with zeros below the diagonal.
pub fn inverse_transposed(l: &Tile) -> Box<Tile> {
    // I·L⁻ᵀ.
    let mut upper = identity();
    solve_right(&mut upper, l);
    upper
}

/// The unit tile.
pub fn identity() -> Box<Tile> {
    let mut tile = Box::new([0.0; AREA]);
    for k in 0..TILE {
        tile[k * TILE + k] = 1.0;
    }
    tile
}

/// The same operations as plain loops, the oracle of the tests.
#[cfg(test)]
mod plain {
    use super::{TILE, Tile};

    pub fn subtract_product(c: &mut Tile, a: &Tile, b: &Tile) {
        for j in 0..TILE {
            for i in 0..TILE {
                for k in 0..TILE {
                    c[j * TILE + i] -= a[k * TILE + i] * b[k * TILE + j];
                }
            }
        }
    }

    pub fn factor(a: &mut Tile) {
        for j in 0..TILE {
            for i in j..TILE {
                let mut value = a[j * TILE + i];
                for k in 0..j {
                    value -= a[k * TILE + i] * a[k * TILE + j];
                }
                a[j * TILE + i] = if i == j { value.sqrt() } else { value / a[j * TILE + j] };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn tile(seed: u64) -> Box<Tile> {
        let mut state = seed;
        let mut tile = Box::new([0.0; AREA]);
        for value in tile.iter_mut() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            *value = (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5;
        }
        tile
    }

    fn positive() -> Box<Tile> {
        let a = tile(5);
        let mut c = identity();
        c.iter_mut().for_each(|x| *x *= -3.0);
        plain::subtract_product(&mut c, &a, &a);
        c.iter_mut().for_each(|x| *x = -*x);
        c
    }

    #[test]
    fn sums_side_by_side_agree_with_one() {
        let (a, b) = (tile(1), tile(2));
        for length in [0, 1, 7, 8, 13, TILE] {
            let plain: f64 = (0..length).map(|k| a[k] * b[k]).sum();
            assert!((dot(&a[..length], &b[..length]) - plain).abs() < 1e-14, "{length}");
        }
    }

    fn negative(a: &Tile) -> Box<Tile> {
        Box::new(a.map(|x| -x))
    }

    #[test]
    fn products_agree_with_the_plain_loops() {
        let (a, b, c) = (tile(1), tile(2), tile(3));
        let (mut fast, mut slow) = (c.clone(), c.clone());
        subtract_product(&mut fast, &a, &b);
        plain::subtract_product(&mut slow, &a, &b);
        assert!(fast.iter().zip(slow.iter()).all(|(x, y)| (x - y).abs() < 1e-13));
        let (mut fast, mut slow) = (c.clone(), c.clone());
        add_product(&mut fast, &a, &b);
        plain::subtract_product(&mut slow, &negative(&a), &b);
        assert!(fast.iter().zip(slow.iter()).all(|(x, y)| (x - y).abs() < 1e-13));
        let (mut fast, mut slow) = (c.clone(), c);
        subtract_square(&mut fast, &a);
        plain::subtract_product(&mut slow, &a, &a);
        for j in 0..TILE {
            assert!((j..TILE).all(|i| (fast[j * TILE + i] - slow[j * TILE + i]).abs() < 1e-13));
        }
    }

    #[test]
    fn products_of_triangles_and_symmetric_ones_agree_with_the_plain_loops() {
        let (mut u, b, c) = (tile(1), tile(2), tile(3));
        for j in 0..TILE {
            u[j * TILE + j + 1..(j + 1) * TILE].fill(0.0);
        }
        let (mut fast, mut slow) = (c.clone(), c);
        subtract_upper_product(&mut fast, &u, &b);
        plain::subtract_product(&mut slow, &u, &b);
        assert!(fast.iter().zip(slow.iter()).all(|(x, y)| (x - y).abs() < 1e-13));
        let (mut fast, mut slow) = (identity(), identity());
        add_upper_square(&mut fast, &u);
        mirror(&mut fast);
        plain::subtract_product(&mut slow, &negative(&u), &u);
        assert!(fast.iter().zip(slow.iter()).all(|(x, y)| (x - y).abs() < 1e-13));
        let (mut fast, mut slow) = (identity(), identity());
        add_symmetric_product(&mut fast, &b, &b);
        mirror(&mut fast);
        plain::subtract_product(&mut slow, &negative(&b), &b);
        assert!(fast.iter().zip(slow.iter()).all(|(x, y)| (x - y).abs() < 1e-13));
    }

    #[test]
    fn factor_and_triangular_solutions_agree_with_the_plain_loops() {
        let (mut fast, mut slow) = (positive(), positive());
        factor(&mut fast, |_, pivot| pivot);
        plain::factor(&mut slow);
        for j in 0..TILE {
            assert!((j..TILE).all(|i| (fast[j * TILE + i] - slow[j * TILE + i]).abs() < 1e-12));
        }
        // (A L⁻ᵀ) Lᵀ = A, with the upper part of L's tile out of the way.
        let mut lower = slow.clone();
        for j in 0..TILE {
            lower[j * TILE..j * TILE + j].fill(0.0);
        }
        let a = tile(9);
        let mut x = a.clone();
        solve_right(&mut x, &fast);
        let mut rest = a;
        subtract_product(&mut rest, &x, &lower);
        assert!(rest.iter().all(|x| x.abs() < 1e-12));
    }
}
