//! Quantiles of the test distributions.

use std::sync::LazyLock;

use statrs::distribution::{ContinuousCDF, Normal, StudentsT};
use statrs::function::gamma::gamma_lr;

/// Two-sided error probability of the tests on single observations.
pub const ALPHA: f64 = 0.001;
/// Power with which a minimal detectable bias is found.
pub const POWER: f64 = 0.8;
/// Two-sided error probability of the global test.
pub const GLOBAL_ALPHA: f64 = 0.05;

/// Quantile of the standard normal distribution.
pub fn normal_quantile(p: f64) -> f64 {
    Normal::standard().inverse_cdf(p)
}

/// Critical value of Baarda's w at [`ALPHA`], two-sided: 3.29.
pub fn critical_w() -> f64 {
    normal_quantile(1.0 - ALPHA / 2.0)
}

/// Critical value that the largest |w| of `count` tests exceeds with the probability `alpha` without gross errors (Z. Šidák 1967).
pub fn critical_among(count: usize, alpha: f64) -> f64 {
    let one = -((-alpha).ln_1p() / count.max(1) as f64).exp_m1();
    -normal_quantile(one / 2.0)
}

/// Non-centrality δ0 at [`ALPHA`] and [`POWER`]: 4.13.
pub fn noncentrality() -> f64 {
    static ONCE: LazyLock<f64> = LazyLock::new(|| critical_w() + normal_quantile(POWER));
    *ONCE
}

/// Quantile of χ² with r degrees of freedom: the cube of E. B. Wilson and M. M. Hilferty (1931), refined by Newton's
/// iteration on the incomplete gamma function. 0 without degrees of freedom.
pub fn chi_squared_quantile(p: f64, r: usize) -> f64 {
    if r == 0 {
        return 0.0;
    }
    let r = r as f64;
    let spread = 2.0 / (9.0 * r);
    let cube = 1.0 - spread + normal_quantile(p) * spread.sqrt();
    let start = r * cube.max(0.05).powi(3);
    let half = r / 2.0;
    let mut x = start;
    for _ in 0..50 {
        let log_density = (half - 1.0) * x.ln() - x / 2.0 - half * 2f64.ln() - statrs::function::gamma::ln_gamma(half);
        let next = x - (gamma_lr(half, x / 2.0) - p) / log_density.exp();
        // Newton may leave the domain where the density is steep.
        let next = if next.is_finite() { next.clamp(x / 4.0, x * 4.0) } else { return start };
        if (next - x).abs() <= 1e-12 * x {
            return next;
        }
        x = next;
    }
    x
}

/// Critical value of Student's t with r degrees of freedom at [`ALPHA`], two-sided: of an error that has no part in the
/// sigma0 it is compared with. `None` without degrees of freedom.
pub fn critical_t(r: usize) -> Option<f64> {
    match r {
        0 => None,
        // Normal to five digits beyond.
        10_000.. => Some(critical_w()),
        _ => Some(StudentsT::new(0.0, 1.0, r as f64).ok()?.inverse_cdf(1.0 - ALPHA / 2.0)),
    }
}

/// Critical value of Pope's τ with r degrees of freedom at [`ALPHA`], two-sided: from Student's t with r - 1. None with
/// fewer than two degrees of freedom, where τ is always 1.
pub fn critical_tau(r: usize) -> Option<f64> {
    let degrees = r.checked_sub(1)?;
    let t = critical_t(degrees)?;
    Some((r as f64).sqrt() * t / (degrees as f64 + t * t).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn quantiles_agree_with_tables() {
        assert!((critical_w() - 3.290_526_7).abs() < 1e-6);
        assert!((noncentrality() - 4.132_147_965).abs() < 1e-6, "{}", noncentrality());
        // Abramowitz and Stegun, table 26.8, and R's qchisq for large r.
        for (p, r, expected) in [
            (0.025, 1, 0.000_982_069),
            (0.975, 1, 5.023_886),
            (0.025, 10, 3.246_973),
            (0.975, 10, 20.483_177),
            (0.975, 100, 129.561_197),
            (0.025, 100, 74.221_927),
            (0.975, 3725, 3896.057),
        ] {
            let got = chi_squared_quantile(p, r);
            assert!((got - expected).abs() < 1e-4 * expected.max(0.01), "{p} {r}: {got}");
        }
        for r in [100_000, 10_000_000] {
            let (low, high) = (chi_squared_quantile(0.025, r), chi_squared_quantile(0.975, r));
            let z = 1.959_963_985 * (2.0 * r as f64).sqrt();
            let centre = r as f64 + 2.0 / 3.0 * (1.959_963_985_f64.powi(2) - 1.0);
            assert!(
                (low - (centre - z)).abs() < 1e-2 * z && (high - (centre + z)).abs() < 1e-2 * z,
                "{r}: {low} {high}"
            );
        }
    }

    #[test]
    fn the_largest_of_many_may_be_larger() {
        assert!((critical_among(1, ALPHA) - critical_w()).abs() < 1e-9);
        // (1 - p)^1000 = 0.95 with p = 5.1292e-5, and 4.0497 is the normal quantile of 1 - p/2.
        let limit = critical_among(1000, 0.05);
        let p = 2.0 * Normal::standard().cdf(-limit);
        assert!(((1.0 - p).powi(1000) - 0.95).abs() < 1e-9, "{limit}");
        assert!((limit - 4.0497).abs() < 1e-4, "{limit}");
    }

    #[test]
    fn tau_lies_below_w_and_approaches_it() {
        assert_eq!(critical_tau(1), None);
        // Pope 1976, two-sided 0.1 %: t(0.9995, 9) = 4.781, τ(10) = √10·4.781/√(9 + 22.858).
        assert!((critical_tau(10).expect("enough") - 2.678_6).abs() < 1e-3, "{:?}", critical_tau(10));
        assert!((critical_tau(100_000).expect("enough") - critical_w()).abs() < 1e-3);
    }
}
