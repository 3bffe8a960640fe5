//! Robust least squares over few parameters, with differences in place of derivatives.
//!
//! Minimises Σ k² x²/(1 + x²), x = length/k (Geman and McClure 1985), by Levenberg-Marquardt on iterated weights; k follows the residuals
//! down. For questions that are asked once a photo, where twenty evaluations a parameter cost nothing.

use nalgebra::{DMatrix, DVector};

use crate::initial::robust::scale;

/// Robust standard deviations at which a residual has half its weight left.
const WIDTH: f64 = 4.0;
const ROUNDS: usize = 30;
/// Length used for a residual that does not exist, behind the camera.
const NOWHERE: f64 = 1e6;

/// Parameters of the minimum near `start`, and the lengths of the residuals there.
///
/// `residuals` gives a pair of residuals over their standard errors per point; `steps` are differences at which a parameter is differentiated.
pub fn robust(
    start: DVector<f64>,
    steps: &[f64],
    residuals: &dyn Fn(&DVector<f64>) -> Vec<[f64; 2]>,
) -> (DVector<f64>, Vec<f64>) {
    let lengths = |all: &[[f64; 2]]| -> Vec<f64> {
        all.iter().map(|[x, y]| x.hypot(*y)).map(|l| if l.is_finite() { l.min(NOWHERE) } else { NOWHERE }).collect()
    };
    let finite = |all: Vec<[f64; 2]>| -> Vec<[f64; 2]> {
        all.into_iter().map(|r| if r[0].hypot(r[1]) < NOWHERE { r } else { [NOWHERE, 0.0] }).collect()
    };
    let count = start.len();
    let mut at = start;
    let mut here = finite(residuals(&at));
    let mut damping = 1e-3;
    for _ in 0..ROUNDS {
        let k = WIDTH * scale(&lengths(&here), count).max(1.0);
        let cost = |all: &[[f64; 2]]| -> f64 {
            lengths(all).iter().map(|l| (l / k).powi(2)).map(|x| k * k * x / (1.0 + x)).sum()
        };
        let before = cost(&here);
        let columns: Vec<Vec<[f64; 2]>> = (0..count)
            .map(|p| {
                let mut moved = at.clone();
                moved[p] += steps[p];
                finite(residuals(&moved))
            })
            .collect();
        let mut normal = DMatrix::<f64>::zeros(count, count);
        let mut gradient = DVector::<f64>::zeros(count);
        for (n, r) in here.iter().enumerate().filter(|(_, r)| r[0] < NOWHERE) {
            let weight = (1.0 + (r[0] * r[0] + r[1] * r[1]) / (k * k)).powi(-2);
            for a in 0..2 {
                let row = |p: usize| (columns[p][n][a] - r[a]) / steps[p];
                for p in 0..count {
                    gradient[p] += weight * row(p) * r[a];
                    for q in 0..=p {
                        normal[(p, q)] += weight * row(p) * row(q);
                    }
                }
            }
        }
        let mut gained = None;
        while gained.is_none() && damping < 1e9 {
            let mut damped = normal.clone();
            for p in 0..count {
                damped[(p, p)] += damping * normal[(p, p)].max(1e-12);
            }
            // The lower triangle is all that a Cholesky factor reads.
            let step = damped.cholesky().map(|factor| factor.solve(&-&gradient));
            let trial = step.map(|step| &at + step).filter(|trial| trial.iter().all(|x| x.is_finite()));
            let found = trial.map(|trial| (finite(residuals(&trial)), trial)).filter(|(there, _)| cost(there) < before);
            match found {
                Some((there, trial)) => {
                    gained = Some(before - cost(&there));
                    (here, at) = (there, trial);
                    damping = (damping * 0.1).max(1e-9);
                }
                None => damping *= 10.0,
            }
        }
        if gained.is_none_or(|gain| gain < 1e-4 * before) {
            break;
        }
    }
    let lengths = lengths(&here);
    (at, lengths)
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn a_line_is_found_among_wrong_points() {
        let measured = |k: usize| if k.is_multiple_of(5) { 70.0 } else { 3.0 - 0.5 * k as f64 };
        let residuals = |p: &DVector<f64>| -> Vec<[f64; 2]> {
            (0..30).map(|k| [p[0] + p[1] * k as f64 - measured(k), 0.0]).collect()
        };
        let (found, lengths) = robust(DVector::from_vec(vec![0.0, 0.0]), &[1e-4, 1e-6], &residuals);
        assert!((found[0] - 3.0).abs() < 0.05 && (found[1] + 0.5).abs() < 0.01, "{found}");
        assert_eq!(lengths.iter().filter(|l| **l > 10.0).count(), 6);
    }
}
