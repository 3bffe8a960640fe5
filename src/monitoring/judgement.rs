//! Tests, variance factors, and the correction for the number of tests.

use super::epoch::Prepared;
use super::request::{Correction, VarianceChoice};
use super::result::{Test, VarianceUsed};
use crate::statistics::fisher::Fisher;

/// Larger statistics are reported as this value, to keep them finite.
const LARGEST: f64 = 1e300;

/// Tests ω/h, with ω a quadratic form that holds the variance factor, against F(h, f) at the error probability `alpha`.
pub fn judged(omega: f64, h: usize, f: Option<f64>, alpha: f64) -> Test {
    let statistic = (omega / h.max(1) as f64).min(LARGEST);
    let law = Fisher::new(h, f);
    let limit = law.limit(alpha);
    Test { statistic, f1: h as f64, f2: f, limit, p: law.tails(statistic)[1], passed: statistic <= limit }
}

/// Two-sided test of a ratio of variances, later over earlier.
pub fn variance_test(from: &Prepared, to: &Prepared, alpha: f64) -> Option<Test> {
    let (s1, s2) = (from.sigma0?, to.sigma0?);
    let (f1, f2) = (from.redundancy?, to.redundancy?);
    let statistic = (s2 / s1).powi(2).min(LARGEST);
    // Fractional degrees of freedom (of variance components) are rounded.
    let law = Fisher::new(f2.round() as usize, Some(f1));
    let [lower, upper] = law.tails(statistic);
    let (high, low) = (law.limit(alpha / 2.0), 1.0 / Fisher::new(f1.round() as usize, Some(f2)).limit(alpha / 2.0));
    let passed = (low..=high).contains(&statistic);
    let limit = if statistic >= 1.0 { high } else { low };
    Some(Test { statistic, f1: f2, f2: Some(f1), limit, p: (2.0 * lower.min(upper)).min(1.0), passed })
}

/// Variance factors of both epochs, and their degrees of freedom.
#[derive(Clone, Copy, Debug)]
pub struct Factors {
    /// Of the earlier epoch.
    pub from: f64,
    /// Of the later one.
    pub to: f64,
    /// Degrees of freedom.
    pub f: Option<f64>,
    /// Which way.
    pub used: VarianceUsed,
    /// Pooled standard deviation of unit weight.
    pub sigma0: Option<f64>,
}

/// The variance factor of a pair; `traces` are those of both covariances at the reference points.
pub fn factors(
    from: &Prepared,
    to: &Prepared,
    choice: VarianceChoice,
    test: Option<&Test>,
    traces: impl Fn() -> [f64; 2],
) -> Factors {
    let a_priori = |epoch: &Prepared| epoch.sigma0.map_or(1.0, |s| 1.0 / (s * s));
    if choice == VarianceChoice::Given {
        let (from, to) = (a_priori(from), a_priori(to));
        return Factors { from, to, f: None, used: VarianceUsed::Given, sigma0: Some(1.0) };
    }
    if choice == VarianceChoice::Estimated
        && test.is_some_and(|t| t.passed)
        && let (Some(f1), Some(f2)) = (from.redundancy, to.redundancy)
        && let (Some(s1), Some(s2)) = (from.sigma0, to.sigma0)
    {
        let pooled = (f1 * s1 * s1 + f2 * s2 * s2) / (f1 + f2);
        let factors = (pooled / (s1 * s1), pooled / (s2 * s2));
        let sigma0 = Some(pooled.sqrt());
        return Factors { from: factors.0, to: factors.1, f: Some(f1 + f2), used: VarianceUsed::Pooled, sigma0 };
    }
    let f = match (from.redundancy, to.redundancy) {
        (None, None) => None,
        (Some(f1), Some(f2)) if test.is_some_and(|t| t.passed) => Some(f1 + f2),
        (f1, f2) => {
            // F. E. Satterthwaite 1946.
            let [v1, v2] = traces();
            let share = |v: f64, f: Option<f64>| f.map_or(0.0, |f| v * v / f);
            let denominator = share(v1, f1) + share(v2, f2);
            (denominator > 0.0).then(|| (v1 + v2).powi(2) / denominator)
        }
    };
    Factors { from: 1.0, to: 1.0, f, used: VarianceUsed::Separate, sigma0: None }
}

/// The error probability that every test of a family is held against, in the order of the p-values given: with S. Holm (1979) the k-th
/// smallest against α/(m - k), up to the first that passes, which all later ones share.
pub fn levels(p: &[f64], correction: Correction, alpha: f64) -> Vec<f64> {
    let m = p.len().max(1) as f64;
    match correction {
        Correction::None => vec![alpha; p.len()],
        Correction::Bonferroni => vec![alpha / m; p.len()],
        Correction::Holm => {
            let mut order: Vec<usize> = (0..p.len()).collect();
            order.sort_by(|&a, &b| p[a].total_cmp(&p[b]));
            let mut levels = vec![alpha; p.len()];
            let mut stopped = None;
            for (k, &at) in order.iter().enumerate() {
                let level = stopped.unwrap_or(alpha / (m - k as f64));
                levels[at] = level;
                if p[at] > level {
                    stopped = Some(level);
                }
            }
            levels
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn holm_stops_at_the_first_that_passes() {
        let p = [0.04, 0.001, 0.03, 0.013];
        let levels = levels(&p, Correction::Holm, 0.05);
        assert_eq!(levels, [0.05 / 2.0, 0.05 / 4.0, 0.05 / 2.0, 0.05 / 3.0]);
        // 0.03 passes at 0.025, and 0.04 with it though it would not at 0.05.
        let rejected: Vec<bool> = p.iter().zip(&levels).map(|(p, level)| p <= level).collect();
        assert_eq!(rejected, [false, true, false, true]);
    }
}
