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
//!
//! Observations of other kinds than image coordinates are often checked by little: a gross error hides in a small residual. Their
//! t is the error with which all others predict them (see [`prediction`]), which their own weight does not change.

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

/// Standardised error with which all other observations predict one: from its weighted residual e = v/σ under the factor p
/// on its weight and the prediction's cofactor q in units of σ², the error is e(1 + pq), of variance 1 + q. None where the
/// redundancy number 1/(1 + q) is below `testable`.
pub fn prediction(e: f64, p: f64, q: f64, testable: f64) -> Option<f64> {
    (1.0 / (1.0 + q) > testable).then(|| e * (1.0 + p * q) / (1.0 + q).sqrt())
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
    fn a_prediction_does_not_depend_on_the_own_weight() {
        // One unknown, predicted by the others with cofactor q and off by d: e = d/(1 + pq).
        let (d, q) = (12.0, 8.0);
        for p in [1.0, 0.3, 1e-6] {
            let t = prediction(d / (1.0 + p * q), p, q, 1e-3).expect("determined");
            assert!((t - d / 3.0).abs() < 1e-9, "{p}: {t}");
        }
        assert_eq!(prediction(0.0, 1.0, f64::INFINITY, 1e-3), None);
    }

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
