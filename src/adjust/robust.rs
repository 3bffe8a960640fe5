//! Robust weights: iterated least squares in which large residuals weigh less.
//!
//! With t = e/s, s the scale of the weighted residuals e (1.4826 times the median of |e|), the factors on the weights are
//!
//! ```text
//! Huber:  min(1, 1.345/|t|),   Tukey:  (1 - (t/4.685)²)² within |t| < 4.685, else 0
//! ```
//!
//! (P. J. Huber 1964; A. E. Beaton, J. W. Tukey 1974; the constants give 95 % efficiency on normal errors). Tukey's
//! weights start from Huber's solution, since alone they have many.

use crate::adjustment::Robust;

const HUBER: f64 = 1.345;
const TUKEY: f64 = 4.685;

/// Factor on the weight of an observation with standardised residual t.
pub fn factor(kind: Robust, t: f64) -> f64 {
    match kind {
        Robust::Huber => (HUBER / t.abs()).min(1.0),
        Robust::Tukey => (1.0 - (t / TUKEY).powi(2)).max(0.0).powi(2),
    }
}

/// Scale of weighted residuals, robust against less than half of them being wrong.
pub fn scale(residuals: &[[f64; 2]]) -> f64 {
    let mut sizes: Vec<f64> = residuals.iter().flatten().map(|e| e.abs()).collect();
    if sizes.is_empty() {
        return 1.0;
    }
    let middle = sizes.len() / 2;
    let (_, median, _) = sizes.select_nth_unstable_by(middle, f64::total_cmp);
    (1.4826 * *median).max(f64::MIN_POSITIVE)
}

/// Square roots of the factors for all residuals, and their largest change.
pub fn reweight(kind: Robust, residuals: &[[f64; 2]], weights: &mut [[f64; 2]]) -> f64 {
    let s = scale(residuals);
    let mut change = 0.0_f64;
    for (weight, e) in weights.iter_mut().zip(residuals) {
        for side in 0..2 {
            let new = factor(kind, e[side] / s).sqrt();
            change = change.max((new - weight[side]).abs());
            weight[side] = new;
        }
    }
    change
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn small_residuals_keep_their_weight_and_large_ones_lose_it() {
        assert_eq!(factor(Robust::Huber, 0.0), 1.0);
        assert_eq!(factor(Robust::Huber, 1.0), 1.0);
        assert!((factor(Robust::Huber, -13.45) - 0.1).abs() < 1e-12);
        assert_eq!(factor(Robust::Tukey, 5.0), 0.0);
        assert!(factor(Robust::Tukey, 0.5) > 0.97);
        let mut residuals = vec![[1.0, -1.0]; 50];
        residuals.extend([[1e6, 1e6]; 20]);
        assert!((scale(&residuals) - 1.4826).abs() < 1e-12, "a third of gross errors leaves the scale");
    }
}
