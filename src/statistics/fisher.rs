//! Fisher's F distribution, central and non-central, with finite or infinite degrees of freedom of the denominator.
//!
//! With f₂ → ∞ the variable f₁·F is χ² with f₁ degrees of freedom. Central tails are the regularised incomplete beta function
//! (continued fraction, modified Lentz: W. H. Press and others, Numerical Recipes, 6.4) or the incomplete gamma function; both tails are
//! computed directly, so that small p-values keep their digits. The non-central distribution is the Poisson mixture
//! P(F' > x) = Σ_j e^{-λ/2} (λ/2)^j / j! · P(Beta(f₁/2 + j, f₂/2) > z), z = f₁x / (f₁x + f₂) (N. L. Johnson and S. Kotz,
//! Continuous Univariate Distributions 2, 1970, chapter 30).

use statrs::function::gamma::{gamma_lr, gamma_ur, ln_gamma};

/// The F distribution with f₁ and f₂ degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fisher {
    f1: f64,
    f2: Option<f64>,
}

/// Maximum number of terms of the continued fraction. It converges after about √max(a, b) terms, so this is enough for 10⁸ degrees of
/// freedom.
const TERMS: usize = 20_000;

impl Fisher {
    /// The distribution of a numerator with `f1` degrees of freedom (at least 1) over a denominator with `f2`; `None`: infinitely many.
    pub fn new(f1: usize, f2: Option<f64>) -> Self {
        // Beyond 10⁸ the two differ by less than rounding.
        Self { f1: f1.max(1) as f64, f2: f2.filter(|f2| *f2 < 1e8).map(|f2| f2.max(1e-3)) }
    }

    /// P(F ≤ x) and P(F > x).
    pub fn tails(&self, x: f64) -> [f64; 2] {
        self.shifted_tails(x, 0.0)
    }

    /// Tails of the distribution whose numerator has 2 · `shift` additional degrees of freedom, at the same ratio of the sums of squares.
    fn shifted_tails(&self, x: f64, shift: f64) -> [f64; 2] {
        if !(x > 0.0) {
            return [0.0, 1.0];
        }
        let a = self.f1 / 2.0 + shift;
        match self.f2 {
            None => {
                let half = (self.f1 * x / 2.0).min(1e12);
                [gamma_lr(a, half), gamma_ur(a, half)]
            }
            Some(f2) => {
                let sum = self.f1 * x + f2;
                if !sum.is_finite() {
                    return [1.0, 0.0];
                }
                beta_tails(a, f2 / 2.0, [self.f1 * x / sum, f2 / sum])
            }
        }
    }

    /// The value that F exceeds with the probability `upper` (0 to 1, exclusive).
    pub fn limit(&self, upper: f64) -> f64 {
        let upper = upper.clamp(1e-300, 1.0 - 1e-12);
        let difference = |log: f64| self.tails(log.exp())[1].max(1e-320).ln() - upper.ln();
        let (mut low, mut high) = (0.0_f64, 0.0_f64);
        while difference(high) > 0.0 && high < 700.0 {
            low = high;
            high += 1.0;
        }
        while difference(low) < 0.0 && low > -700.0 {
            high = low;
            low -= 1.0;
        }
        root(difference, low, high).exp()
    }

    /// P(F' > limit) with the non-centrality λ.
    pub fn power(&self, limit: f64, noncentrality: f64) -> f64 {
        let mean = noncentrality.max(0.0) / 2.0;
        if mean == 0.0 {
            return self.tails(limit)[1];
        }
        let reach = 12.0 * mean.sqrt() + 40.0;
        let (first, last) = ((mean - reach).max(0.0).floor() as usize, (mean + reach).ceil() as usize);
        let term = |j: usize| {
            let j = j as f64;
            let weight = (j * mean.ln() - mean - ln_gamma(j + 1.0)).exp();
            weight * self.shifted_tails(limit, j)[1]
        };
        (first..=last).map(term).sum::<f64>().clamp(0.0, 1.0)
    }

    /// The non-centrality λ for which F' exceeds `limit` with the probability `power`; 0 if the central F exceeds it with that probability.
    pub fn noncentrality(&self, limit: f64, power: f64) -> f64 {
        let power = power.clamp(0.0, 1.0 - 1e-9);
        let difference = |lambda: f64| power - self.power(limit, lambda);
        if difference(0.0) <= 0.0 {
            return 0.0;
        }
        let (mut low, mut high) = (0.0, 8.0);
        while difference(high) > 0.0 && high < 1e7 {
            low = high;
            high *= 2.0;
        }
        root(difference, low, high)
    }
}

/// The zero of a decreasing function between `low` and `high`: regula falsi with the Illinois modification, and bisection in every fifth
/// round.
fn root(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut at_low, mut at_high) = (function(low), function(high));
    for round in 0..200 {
        if (high - low).abs() <= 1e-13 * (1.0 + low.abs().max(high.abs())) {
            break;
        }
        let straight = high - at_high * (high - low) / (at_high - at_low);
        let inside = straight > low.min(high) && straight < low.max(high);
        let next = if inside && round % 5 != 4 { straight } else { 0.5 * (low + high) };
        let value = function(next);
        if value == 0.0 {
            return next;
        }
        if value > 0.0 {
            (low, at_low) = (next, value);
            at_high *= 0.5;
        } else {
            (high, at_high) = (next, value);
            at_low *= 0.5;
        }
    }
    0.5 * (low + high)
}

/// I_x(a, b) and 1 - I_x(a, b), with 1 - x given beside x.
fn beta_tails(a: f64, b: f64, [x, y]: [f64; 2]) -> [f64; 2] {
    if x <= 0.0 {
        return [0.0, 1.0];
    }
    if y <= 0.0 {
        return [1.0, 0.0];
    }
    let front = (ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b) + a * x.ln() + b * y.ln()).exp();
    if x < (a + 1.0) / (a + b + 2.0) {
        let lower = (front * fraction(a, b, x) / a).clamp(0.0, 1.0);
        [lower, 1.0 - lower]
    } else {
        let upper = (front * fraction(b, a, y) / b).clamp(0.0, 1.0);
        [1.0 - upper, upper]
    }
}

/// The continued fraction of the incomplete beta function.
fn fraction(a: f64, b: f64, x: f64) -> f64 {
    const TINY: f64 = 1e-300;
    let nonzero = |value: f64| if value.abs() < TINY { TINY } else { value };
    let mut c = 1.0;
    let mut d = 1.0 / nonzero(1.0 - (a + b) * x / (a + 1.0));
    let mut h = d;
    for m in 1..TERMS {
        let m = m as f64;
        let even = m * (b - m) * x / ((a - 1.0 + 2.0 * m) * (a + 2.0 * m));
        d = 1.0 / nonzero(1.0 + even * d);
        c = nonzero(1.0 + even / c);
        h *= d * c;
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 1.0 + 2.0 * m));
        d = 1.0 / nonzero(1.0 + odd * d);
        c = nonzero(1.0 + odd / c);
        let change = d * c;
        h *= change;
        if (change - 1.0).abs() < 1e-15 {
            break;
        }
    }
    h
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    /// Published tables of F, and one value by Simpson's rule on the density; for infinitely many degrees of freedom χ²/f₁.
    #[test]
    fn limits_agree_with_tables() {
        for (upper, f1, f2, expected) in [
            (0.05, 1, Some(10.0), 4.964_602_7),
            (0.05, 2, Some(292.0), 3.026_7),
            (0.05, 3, Some(20.0), 3.098_391_2),
            (0.01, 5, Some(7.0), 7.460_435_5),
            (0.025, 146, Some(146.0), 1.384_980),
            (0.05, 3, None, 7.814_727_9 / 3.0),
            (0.05, 18, None, 28.869_299_4 / 18.0),
            (0.001, 1, None, 10.827_566_2),
        ] {
            let found = Fisher::new(f1, f2).limit(upper);
            assert!((found - expected).abs() < 1e-4 * expected, "{upper} {f1} {f2:?}: {found}");
            let again = Fisher::new(f1, f2).tails(found);
            assert!((again[1] - upper).abs() < 1e-10 && (again[0] + again[1] - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn tails_agree_with_statrs_and_converge_to_the_infinite_case() {
        use statrs::distribution::{ContinuousCDF, FisherSnedecor};
        for (f1, f2) in [(1, 3.0), (3, 12.0), (6, 40.0), (30, 500.0), (200, 77.0)] {
            let theirs = FisherSnedecor::new(f1 as f64, f2).unwrap();
            for x in [0.01, 0.3, 0.9, 1.0, 1.4, 3.0, 20.0] {
                let [lower, upper] = Fisher::new(f1, Some(f2)).tails(x);
                assert!((lower - theirs.cdf(x)).abs() < 1e-10, "{f1} {f2} {x}");
                assert!((upper - theirs.sf(x)).abs() < 1e-10, "{f1} {f2} {x}");
            }
        }
        for x in [0.2, 1.0, 2.6, 9.0] {
            let (finite, infinite) = (Fisher::new(3, Some(9e7)).tails(x)[1], Fisher::new(3, None).tails(x)[1]);
            assert!((finite - infinite).abs() < 1e-6, "{x}: {finite} {infinite}");
        }
        // Far out the upper tail keeps its digits: χ² with two degrees of freedom is exponential.
        let upper = Fisher::new(2, None).tails(100.0)[1];
        assert!((upper / (-100f64).exp() - 1.0).abs() < 1e-9, "{upper}");
    }

    /// Tables of the non-centrality at α and a power of 0.80: J. Cohen 1988; 17.075 is Baarda's 4.132².
    #[test]
    fn noncentralities_agree_with_tables() {
        for (alpha, f1, expected) in [(0.05, 1, 7.849), (0.05, 3, 10.903), (0.05, 6, 13.624), (0.001, 1, 17.075)] {
            let one = Fisher::new(f1, None);
            let found = one.noncentrality(one.limit(alpha), 0.8);
            assert!((found - expected).abs() < 2e-3, "{alpha} {f1}: {found}");
        }
        let one = Fisher::new(3, Some(20.0));
        assert_eq!(one.noncentrality(one.limit(0.9), 0.8), 0.0);
    }

    #[test]
    fn the_noncentral_distribution_agrees_with_simulation() {
        let mut noise = Noise::new(5, 0);
        for (f1, f2, lambda) in [(3, 12, 9.0), (6, 30, 4.0), (1, 5, 16.0)] {
            let law = Fisher::new(f1, Some(f64::from(f2)));
            let limit = law.limit(0.05);
            let runs = 20_000;
            let mut beyond = 0;
            for _ in 0..runs {
                let mut numerator = (noise.normal() + f64::sqrt(lambda)).powi(2);
                numerator += (1..f1).map(|_| noise.normal().powi(2)).sum::<f64>();
                let denominator: f64 = (0..f2).map(|_| noise.normal().powi(2)).sum();
                beyond += usize::from(numerator / f1 as f64 > limit * denominator / f64::from(f2));
            }
            let (share, expected) = (f64::from(beyond as u32) / f64::from(runs), law.power(limit, lambda));
            let sigma = (expected * (1.0 - expected) / f64::from(runs)).sqrt();
            assert!((share - expected).abs() < 4.0 * sigma, "{f1} {f2}: {share} {expected}");
        }
    }
}
