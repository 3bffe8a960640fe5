//! Products of small blocks, added to their place within a tile: the inner loops of the accumulation.
//!
//! Two numbers at a time, the lanes of wasm simd128 and SSE2; `plain` in the tests is their oracle.

use wide::f64x2;

use super::kernel::TILE;

/// Two numbers from `k` on.
#[inline(always)]
fn pair(from: &[f64], k: usize) -> f64x2 {
    f64x2::new([from[k], from[k + 1]])
}

/// to[k], to[k + 1] ± = sum, minus if `SUBTRACT`.
#[inline(always)]
fn add_pair<const SUBTRACT: bool>(to: &mut [f64], k: usize, sum: f64x2) {
    let before = pair(to, k);
    let after = if SUBTRACT { before - sum } else { before + sum };
    to[k..k + 2].copy_from_slice(&after.to_array());
}

/// data[column·TILE + row] ± = Σ_m a[m][row]·b[m][column], from the block's first number on; minus if `SUBTRACT`. The
/// number of rows is even.
#[inline(always)]
pub fn add_product<const SUBTRACT: bool, const M: usize, const R: usize, const C: usize>(
    data: &mut [f64],
    a: &[[f64; R]; M],
    b: &[[f64; C]; M],
) {
    if R == 0 || C == 0 {
        return;
    }
    let data = &mut data[..(C - 1) * TILE + R];
    for column in 0..C {
        let to = &mut data[column * TILE..column * TILE + R];
        let factor: [f64x2; M] = std::array::from_fn(|m| f64x2::splat(b[m][column]));
        for row in (0..R).step_by(2) {
            let mut sum = pair(&a[0], row) * factor[0];
            for m in 1..M {
                sum += pair(&a[m], row) * factor[m];
            }
            add_pair::<SUBTRACT>(to, row, sum);
        }
    }
}

/// The lower triangle of data[column·TILE + row] += Σ_m a[m][row]·b[m][column], a sum that is symmetric: the number above an
/// even one of the diagonal is changed too.
#[inline(always)]
pub fn add_lower<const M: usize, const C: usize>(data: &mut [f64], a: &[[f64; C]; M], b: &[[f64; C]; M]) {
    if C == 0 {
        return;
    }
    let data = &mut data[..(C - 1) * TILE + C];
    for column in 0..C {
        let to = &mut data[column * TILE..column * TILE + C];
        let factor: [f64x2; M] = std::array::from_fn(|m| f64x2::splat(b[m][column]));
        for row in (column / 2 * 2..C).step_by(2) {
            let mut sum = pair(&a[0], row) * factor[0];
            for m in 1..M {
                sum += pair(&a[m], row) * factor[m];
            }
            add_pair::<false>(to, row, sum);
        }
    }
}

/// The first C numbers of to ± = Σ_m factor[m]·a[m], minus if `SUBTRACT`.
#[inline(always)]
pub fn add_rows<const SUBTRACT: bool, const M: usize, const C: usize>(
    to: &mut [f64],
    factor: &[f64; M],
    a: &[[f64; C]; M],
) {
    let to = &mut to[..C];
    for k in (0..C).step_by(2) {
        let mut sum = pair(&a[0], k) * f64x2::splat(factor[0]);
        for m in 1..M {
            sum += pair(&a[m], k) * f64x2::splat(factor[m]);
        }
        add_pair::<SUBTRACT>(to, k, sum);
    }
}

/// The first C numbers of to += Σ_m a[m]².
#[inline(always)]
pub fn add_squares<const M: usize, const C: usize>(to: &mut [f64], a: &[[f64; C]; M]) {
    let to = &mut to[..C];
    for k in (0..C).step_by(2) {
        let mut sum = pair(&a[0], k) * pair(&a[0], k);
        for m in 1..M {
            sum += pair(&a[m], k) * pair(&a[m], k);
        }
        add_pair::<false>(to, k, sum);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn numbers<const M: usize, const C: usize>(seed: f64) -> [[f64; C]; M] {
        std::array::from_fn(|m| std::array::from_fn(|k| (seed + 1.7 * m as f64 + 0.9 * k as f64).sin()))
    }

    fn plain<const M: usize, const R: usize, const C: usize>(
        data: &mut [f64],
        sign: f64,
        a: &[[f64; R]; M],
        b: &[[f64; C]; M],
    ) {
        for column in 0..C {
            for row in 0..R {
                data[column * TILE + row] += sign * (0..M).map(|m| a[m][row] * b[m][column]).sum::<f64>();
            }
        }
    }

    #[test]
    fn block_products_agree_with_the_plain_loops() {
        let (a, b) = (numbers::<3, 6>(0.3), numbers::<3, 8>(1.1));
        let start: Vec<f64> = (0..8 * TILE).map(|k| (0.1 * k as f64).cos()).collect();
        let (mut fast, mut slow) = (start.clone(), start.clone());
        add_product::<true, 3, 6, 8>(&mut fast, &a, &b);
        plain(&mut slow, -1.0, &a, &b);
        assert!(fast.iter().zip(&slow).all(|(x, y)| (x - y).abs() < 1e-14));
        let (mut fast, mut slow) = (start.clone(), start);
        add_lower::<3, 8>(&mut fast, &b, &b);
        plain(&mut slow, 1.0, &b, &b);
        for column in 0..8 {
            assert!((column..8).all(|row| (fast[column * TILE + row] - slow[column * TILE + row]).abs() < 1e-14));
        }
        let (mut fast, mut slow) = (b[0], b[0]);
        add_squares::<3, 8>(&mut fast, &b);
        for k in 0..8 {
            slow[k] += b[0][k] * b[0][k] + b[1][k] * b[1][k] + b[2][k] * b[2][k];
        }
        assert!(fast.iter().zip(&slow).all(|(x, y)| (x - y).abs() < 1e-15));
        let (mut fast, mut slow) = (a[0], a[0]);
        add_rows::<true, 3, 6>(&mut fast, &[0.2, -0.4, 0.7], &a);
        for k in 0..6 {
            slow[k] -= 0.2 * a[0][k] - 0.4 * a[1][k] + 0.7 * a[2][k];
        }
        assert!(fast.iter().zip(&slow).all(|(x, y)| (x - y).abs() < 1e-15));
    }
}
