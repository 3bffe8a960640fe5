//! Real roots of a polynomial.

/// All real roots of Σ coefficients\[k\]·xᵏ, ascending, by isolation between the roots of the derivative.
///
/// Between two neighbouring critical points a polynomial is monotone: it has one root there where the signs differ,
/// found by bisection with Newton steps. Roots beyond ±1 are the reciprocals of those of the reversed polynomial, so
/// that no power overflows. A double root that rounding lifted off the axis is still reported, once. A polynomial that
/// is zero everywhere, or has coefficients that are not finite, has no roots to report.
pub fn real_roots(coefficients: &[f64]) -> Vec<f64> {
    let size = coefficients.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    if size == 0.0 || coefficients.iter().any(|c| !c.is_finite()) {
        return Vec::new();
    }
    let scaled: Vec<f64> = coefficients.iter().map(|c| c / size).collect();
    let reversed: Vec<f64> = scaled.iter().rev().copied().collect();
    let mut roots = roots_in_unit_interval(&scaled);
    let outside = roots_in_unit_interval(&reversed).into_iter().filter(|r| r.abs() < 1.0 && r.abs() > 1e-12);
    roots.extend(outside.map(|r| 1.0 / r));
    roots.sort_by(f64::total_cmp);
    roots
}

fn value(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Roots in [-1, 1].
fn roots_in_unit_interval(coefficients: &[f64]) -> Vec<f64> {
    let degree = coefficients.len().saturating_sub(1);
    if degree == 0 {
        return Vec::new();
    }
    let derivative: Vec<f64> = (1..=degree).map(|k| k as f64 * coefficients[k]).collect();
    let mut stops = vec![-1.0];
    stops.extend(roots_in_unit_interval(&derivative));
    stops.push(1.0);
    let rounding = 1e-13 * coefficients.iter().map(|c| c.abs()).sum::<f64>();
    let mut roots: Vec<f64> = Vec::new();
    let mut add = |x: f64| {
        if roots.last().is_none_or(|last| x - last > 1e-12) {
            roots.push(x);
        }
    };
    for pair in stops.windows(2) {
        let (low, high) = (pair[0], pair[1]);
        let (at_low, at_high) = (value(coefficients, low), value(coefficients, high));
        if at_low.abs() <= rounding {
            add(low);
        } else if at_high.abs() > rounding && at_low.signum() != at_high.signum() {
            add(monotone_root(coefficients, &derivative, low, high));
        }
    }
    if value(coefficients, 1.0).abs() <= rounding {
        add(1.0);
    }
    roots
}

/// The root between `low` and `high`, where the values differ in sign: Newton, kept inside by bisection.
fn monotone_root(coefficients: &[f64], derivative: &[f64], mut low: f64, mut high: f64) -> f64 {
    let rising = value(coefficients, high) > 0.0;
    let mut x = 0.5 * (low + high);
    for _ in 0..80 {
        let at_x = value(coefficients, x);
        if (at_x > 0.0) == rising {
            high = x;
        } else {
            low = x;
        }
        let newton = x - at_x / value(derivative, x);
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= f64::EPSILON * x.abs().max(1e-3) {
            return next;
        }
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn from_roots(roots: &[f64]) -> Vec<f64> {
        roots.iter().fold(vec![1.0], |p, r| {
            let mut next = vec![0.0; p.len() + 1];
            for (k, c) in p.iter().enumerate() {
                next[k + 1] += c;
                next[k] -= r * c;
            }
            next
        })
    }

    #[test]
    fn roots_inside_and_outside_the_unit_interval_are_found() {
        let wanted = [-250.0, -3.0, -1.0, -0.4, 0.0, 0.3, 0.9, 1.0, 2.5, 17.0];
        let found = real_roots(&from_roots(&wanted));
        assert_eq!(found.len(), wanted.len(), "{found:?}");
        for (f, w) in found.iter().zip(wanted) {
            assert!((f - w).abs() < 1e-7 * w.abs().max(1.0), "{f} for {w}");
        }
    }

    #[test]
    fn double_roots_are_reported_once_and_complex_ones_not() {
        let found = real_roots(&from_roots(&[0.5, 0.5, -2.0]));
        assert_eq!(found.len(), 2, "{found:?}");
        assert!((found[0] + 2.0).abs() < 1e-9 && (found[1] - 0.5).abs() < 1e-6);
        assert!(real_roots(&[1.0, 0.0, 1.0]).is_empty());
        assert!(
            real_roots(&[0.0, 0.0]).is_empty() && real_roots(&[]).is_empty() && real_roots(&[f64::NAN, 1.0]).is_empty()
        );
    }
}
