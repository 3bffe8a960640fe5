//! Predicts the position of a lattice site in the photo from the dots around it.
//!
//! In a window around the site the image is a polynomial of the second degree in the steps (p, q) from it,
//! x = c0 + c1 p + c2 q + c3 p²/2 + c4 pq + c5 q²/2, fitted by least squares. What the polynomial leaves of perspective and distortion
//! grows with the third power of the distance and is part of each dot's variance; the terms of the second degree are observed as 0 with
//! the curvature that lenses and perspective have. No model of the whole photo is needed, so that the lens may be any.

use std::collections::BTreeMap;

use nalgebra::{SMatrix, SVector};

use super::board::LatticeSite;

/// Steps around a site within which dots are used.
const WINDOW: i32 = 3;
/// Standard error of a dot's place in steps: print, paper and centre; without it a bent board has no neighbours.
const DOT: f64 = 0.02;
/// Remainder of the polynomial at a distance of one step, in steps. Without it a far row pulls the near one off in a wide-angle photo.
const REMAINDER: f64 = 0.004;
/// A priori standard error of the curvature, in steps per square step. Without it three dots determine nothing beyond themselves.
const CURVATURE: f64 = 0.08;

/// A predicted place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Predicted {
    /// Place in pixels.
    pub place: [f64; 2],
    /// Its standard error in pixels, of the prediction and of a dot.
    pub sigma_px: f64,
    /// Image of the steps p and q: columns.
    pub steps: [[f64; 2]; 2],
    /// Length of the shortest step of the lattice in pixels.
    pub shortest_px: f64,
}

/// Predicts where `at`, in steps, appears; the dot at `without` is not used. `None` without three dots that span the plane.
pub(super) fn predict(
    dots: &BTreeMap<LatticeSite, [f64; 2]>,
    at: [f64; 2],
    without: Option<LatticeSite>,
) -> Option<Predicted> {
    let centre = [at[0].round() as i32, at[1].round() as i32];
    let mut normal = SMatrix::<f64, 6, 6>::zeros();
    let mut right = SMatrix::<f64, 6, 2>::zeros();
    let mut count = 0;
    for p in centre[0] - WINDOW..=centre[0] + WINDOW {
        for (site, place) in dots.range([p, centre[1] - WINDOW]..=[p, centre[1] + WINDOW]) {
            if Some(*site) == without {
                continue;
            }
            let (x, y) = (f64::from(site[0]) - at[0], f64::from(site[1]) - at[1]);
            let square = x * x + y * y;
            let weight = 1.0 / (DOT * DOT + REMAINDER * REMAINDER * square * square * square);
            let row = SVector::<f64, 6>::from([1.0, x, y, 0.5 * x * x, x * y, 0.5 * y * y]);
            normal += row * row.transpose() * weight;
            right += row * SMatrix::<f64, 1, 2>::new(place[0], place[1]) * weight;
            count += 1;
        }
    }
    if count < 3 {
        return None;
    }
    for k in 0..6 {
        normal[(k, k)] += if k < 3 { 1e-6 } else { 1.0 / (CURVATURE * CURVATURE) };
    }
    let inverse = normal.cholesky()?.inverse();
    // three dots of one line leave the step across to the weak observation as 0: a million steps
    if inverse[(0, 0)] > 1.0 || inverse[(1, 1)] > 1.0 || inverse[(2, 2)] > 1.0 {
        return None;
    }
    let solution = inverse * right;
    let steps = [[solution[(1, 0)], solution[(1, 1)]], [solution[(2, 0)], solution[(2, 1)]]];
    let area = steps[0][0] * steps[1][1] - steps[0][1] * steps[1][0];
    let length = area.abs().sqrt();
    Some(Predicted {
        place: [solution[(0, 0)], solution[(0, 1)]],
        sigma_px: (inverse[(0, 0)] + DOT * DOT).sqrt() * length,
        steps,
        shortest_px: shortest(steps),
    })
}

/// Length of the shortest vector of the lattice that two steps span (Gauss).
pub(super) fn shortest([mut a, mut b]: [[f64; 2]; 2]) -> f64 {
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    for _ in 0..20 {
        if dot(a, a) > dot(b, b) {
            std::mem::swap(&mut a, &mut b);
        }
        let times = (dot(a, b) / dot(a, a)).round();
        if times == 0.0 || !times.is_finite() {
            break;
        }
        b = [b[0] - times * a[0], b[1] - times * a[1]];
    }
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn a_plane_in_perspective_is_continued_to_a_few_hundredths_of_a_step() {
        let image = |x: f64, y: f64| {
            let w = 1.0 + 0.04 * x - 0.02 * y;
            [300.0 + (40.0 * x + 6.0 * y) / w, 200.0 + (-4.0 * x + 30.0 * y) / w]
        };
        let dots = (0..5).flat_map(|p| (0..5).map(move |q| [p, q]));
        let dots: BTreeMap<LatticeSite, [f64; 2]> =
            dots.map(|s| (s, image(f64::from(s[0]), f64::from(s[1])))).collect();
        let beside = predict(&dots, [5.0, 2.0], None).expect("dots around");
        let truth = image(5.0, 2.0);
        let error = (beside.place[0] - truth[0]).hypot(beside.place[1] - truth[1]);
        assert!(error < 0.06 * beside.shortest_px && error < 3.0 * beside.sigma_px, "{error} {beside:?}");
        // a line of dots gives no information on what is beside it
        let line: BTreeMap<LatticeSite, [f64; 2]> = (0..5).map(|p| ([p, 0], image(f64::from(p), 0.0))).collect();
        assert!(predict(&line, [2.0, 1.0], None).is_none());
    }

    #[test]
    fn the_shortest_vector_is_found_in_any_basis() {
        assert!((shortest([[10.0, 0.0], [31.0, 4.0]]) - 17.0_f64.sqrt()).abs() < 1e-12);
    }
}
