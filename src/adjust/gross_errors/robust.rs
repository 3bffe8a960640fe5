//! Robust weights: iterated least squares in which large residuals get less weight.
//!
//! With the standardised residual t = v/(σ s √r), r the redundancy number and s the scale, the factors on the weights are
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
//!
//! The covariance of the estimate is s² E[ψ²]/E[ψ']² (AᵀA)⁻¹ (P. J. Huber, Robust Statistics, 1981, 7.6), ψ(t) = t·factor(t). The
//! present equations are those with weights, E[factor] times as large as AᵀA where nothing is wrong.

use crate::adjustment::Robust;

const HUBER: f64 = 1.345;
const TUKEY: f64 = 4.685;
/// Median of |t| of the standard normal distribution, inverted.
const FROM_MEDIAN: f64 = 1.482_602_218_505_602;

/// Factor on the weight of an observation with standardised residual t.
pub fn factor(kind: Robust, t: f64) -> f64 {
    match kind {
        Robust::Huber => (HUBER / t.abs()).min(1.0),
        Robust::Tukey => (1.0 - (t / TUKEY).powi(2)).max(0.0).powi(2),
    }
}

/// ψ'(t), ψ(t) = t·factor(t).
fn slope(kind: Robust, t: f64) -> f64 {
    match kind {
        Robust::Huber => f64::from(t.abs() <= HUBER),
        Robust::Tukey => {
            let u = (t / TUKEY).powi(2);
            if u < 1.0 { (1.0 - u) * (1.0 - 5.0 * u) } else { 0.0 }
        }
    }
}

/// Expectations over t = `spread`·z, z standard normal: ψ², ψ' and the factor. That of ψ' is E[z ψ]/`spread` = E[z² factor] (C. Stein
/// 1981), which has no steps to integrate over.
fn moments(kind: Robust, spread: f64) -> [f64; 3] {
    const HALF: usize = 2000;
    let step = 9.0 / HALF as f64;
    let mut sums = [0.0; 3];
    for k in 0..=HALF {
        let z = k as f64 * step;
        let t = spread * z;
        let share = if k == 0 || k == HALF { 0.5 } else { 1.0 };
        let density = 2.0 * share * step * (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
        let p = factor(kind, t);
        sums[0] += density * (t * p).powi(2);
        sums[1] += density * z * z * p;
        sums[2] += density * p;
    }
    sums
}

/// Variance of unit weight for the cofactors of equations with weights: s² E[ψ²] E[factor]/E[ψ']², where the errors are `sigma0`
/// and the scale of the weights is s. Where errors are so far beyond that scale that hardly one keeps a weight the expectations are
/// nothing over nothing, and σ0² itself stands for it.
pub fn variance(kind: Robust, sigma0: f64, s: f64) -> f64 {
    let [squared, slope, weight] = moments(kind, sigma0 / s);
    let variance = s * s * squared * weight / (slope * slope);
    if variance.is_finite() { variance } else { sigma0 * sigma0 }
}

/// Scale by the median of |t|: of errors by half of which nothing is known but that they are not smaller.
pub fn median_scale(mut sizes: Vec<f64>) -> f64 {
    sizes.iter_mut().for_each(|t| *t = t.abs());
    if sizes.is_empty() {
        return 1.0;
    }
    let middle = sizes.len() / 2;
    let (_, median, _) = sizes.select_nth_unstable_by(middle, f64::total_cmp);
    (FROM_MEDIAN * *median).max(f64::MIN_POSITIVE)
}

/// Scale of standardised residuals that large ones do not change and that is consistent for normal errors: from the median
/// by steps of s² ← s² (Σψ²/Σψ')·(E[ψ']/E[ψ²]) with Tukey's ψ, which uses nearly all that the residuals tell.
pub fn scale(standardised: &[f64]) -> f64 {
    let [squared, normal_slope, _] = moments(Robust::Tukey, 1.0);
    let mut s = median_scale(standardised.to_vec());
    for _ in 0..20 {
        let (mut squares, mut slopes) = (0.0, 0.0);
        for t in standardised.iter().map(|e| e / s) {
            squares += (t * factor(Robust::Tukey, t)).powi(2);
            slopes += slope(Robust::Tukey, t);
        }
        let ratio = squares / slopes * normal_slope / squared;
        if !(0.25..=4.0).contains(&ratio) {
            break;
        }
        s *= ratio.sqrt();
        if (ratio - 1.0).abs() < 1e-9 {
            break;
        }
    }
    s
}

/// Standardised error with which all other observations predict one: from its weighted residual e = v/σ under the factor p
/// on its weight and the prediction's cofactor q in units of σ², the error is e(1 + pq), of variance 1 + q. `None` if the
/// redundancy number 1/(1 + q) is below `testable`.
pub fn prediction(e: f64, p: f64, q: f64, testable: f64) -> Option<f64> {
    (1.0 / (1.0 + q) > testable).then(|| e * (1.0 + p * q) / (1.0 + q).sqrt())
}

/// Cofactor q of [`prediction`] from that of the weighted adjusted observation, c = p·q/(1 + p·q).
pub fn predicting(c: f64, p: f64) -> f64 {
    if c < 1.0 { c.max(0.0) / (p * (1.0 - c)) } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn a_variance_is_a_number_however_far_beyond_the_scale_the_errors_are() {
        for kind in [Robust::Huber, Robust::Tukey] {
            for sigma0 in [1.0, 30.0, 1e3, 3e4, 1e6, 1e12] {
                let found = variance(kind, sigma0, 1.0);
                assert!(found.is_finite() && found > 0.0, "{kind:?} {sigma0}: {found}");
            }
        }
    }

    #[test]
    fn a_prediction_does_not_depend_on_the_own_weight() {
        // One unknown, predicted by the others with cofactor q and off by d: e = d/(1 + pq).
        let (d, q) = (12.0, 8.0);
        for p in [1.0, 0.3, 1e-6] {
            let t = prediction(d / (1.0 + p * q), p, q, 1e-3).expect("determined");
            assert!((t - d / 3.0).abs() < 1e-9, "{p}: {t}");
            assert!((predicting(p * q / (1.0 + p * q), p) - q).abs() < 1e-6 * q, "{p}");
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
    }

    #[test]
    fn the_scale_is_that_of_normal_errors_and_a_tenth_of_gross_ones_leaves_it() {
        let mut noise = Noise::new(5, 0);
        let mut sample: Vec<f64> = (0..20_000).map(|_| 0.7 * noise.normal()).collect();
        assert!((scale(&sample) / 0.7 - 1.0).abs() < 0.02, "{}", scale(&sample));
        sample.iter_mut().step_by(10).for_each(|e| *e += 300.0);
        assert!((scale(&sample) / 0.7 - 1.0).abs() < 0.02, "{}", scale(&sample));
    }

    #[test]
    fn the_constants_lose_a_twentieth_of_the_efficiency() {
        for kind in [Robust::Huber, Robust::Tukey] {
            let [squared, slope, _] = moments(kind, 1.0);
            assert!((squared / (slope * slope) - 1.0 / 0.95).abs() < 1e-3, "{kind:?}: {squared} {slope}");
            // Slopes are those of ψ.
            let psi = |t: f64| t * factor(kind, t);
            for t in [0.2, 1.1, 2.0, 4.0, 6.0] {
                let numeric = (psi(t + 1e-6) - psi(t - 1e-6)) / 2e-6;
                assert!((super::slope(kind, t) - numeric).abs() < 1e-6, "{kind:?} {t}");
            }
            // Far above the errors the estimate is that of least squares.
            assert!((variance(kind, 1.0, 100.0) - 1.0).abs() < 1e-2);
        }
    }
}
