//! Points that may be one: closer than their standard errors can separate, and in no photo together.

use nalgebra::{Matrix3, Vector3};

/// Difference of two places, in standard errors of both, below which they are not distinguished: 99.9 % of a point's own repetitions are
/// nearer (χ² of three degrees of freedom).
const APART: f64 = 4.03;
/// Standard errors of a measurement, and pixels in any case, from which on two measurements of one photo are two targets.
const APART_PX: f64 = 1.0;

/// A point that may have been measured under two names.
#[derive(Clone, Debug)]
pub struct DoublePointCandidate {
    /// Coordinates.
    pub xyz: Vector3<f64>,
    /// Their covariance.
    pub covariance: Matrix3<f64>,
    /// Photo and pixel of its measurements, ascending by photo.
    pub places: Vec<(usize, [f64; 2])>,
}

/// Pairs of candidates that may be one point, each with its smaller place first.
pub fn pairs(candidates: &[DoublePointCandidate]) -> Vec<[usize; 2]> {
    let reach =
        |c: &DoublePointCandidate| APART * (0..3).map(|a| c.covariance[(a, a)]).fold(0.0, f64::max).max(0.0).sqrt();
    let mut order: Vec<usize> = (0..candidates.len()).filter(|&k| reach(&candidates[k]).is_finite()).collect();
    order.sort_by(|&a, &b| candidates[a].xyz.x.total_cmp(&candidates[b].xyz.x));
    let widest = order.iter().map(|&k| reach(&candidates[k])).fold(0.0, f64::max);
    let mut found = Vec::new();
    for (n, &a) in order.iter().enumerate() {
        let (one, own) = (&candidates[a], reach(&candidates[a]));
        for &b in &order[n + 1..] {
            let other = &candidates[b];
            if other.xyz.x - one.xyz.x > own + widest {
                break;
            }
            if not_apart(one, other) && !told_apart(one, other) {
                found.push([a.min(b), a.max(b)]);
            }
        }
    }
    found.sort_unstable();
    found
}

fn not_apart(a: &DoublePointCandidate, b: &DoublePointCandidate) -> bool {
    let d = a.xyz - b.xyz;
    let both = (a.covariance + b.covariance).cholesky();
    both.is_some_and(|c| d.dot(&c.solve(&d)) <= APART * APART)
}

/// Whether a photo shows both, in different places.
fn told_apart(a: &DoublePointCandidate, b: &DoublePointCandidate) -> bool {
    let beside = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]) > APART_PX;
    a.places.iter().any(|(photo, p)| {
        let same = b.places.binary_search_by_key(photo, |place| place.0);
        same.is_ok_and(|k| beside(*p, b.places[k].1))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::robust::{generator, uniform};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn repeated_points_are_paired_and_neighbours_are_not() {
        let mut g = generator(5);
        let mut normal = || (0..12).map(|_| uniform(&mut g)).sum::<f64>() - 6.0;
        for round in 0..20 {
            let sigma = Vector3::new(0.1, 0.2, 0.5);
            let covariance = Matrix3::from_diagonal(&sigma.component_mul(&sigma));
            let mut candidates = Vec::new();
            for k in 0..40 {
                // Twelve standard errors of both from each other in the weakest direction, so that none of 700 pairs is near by chance;
                // the second ten are measured beside each other.
                let place = Vector3::new(3.0 * f64::from(k % 7), 0.0, 8.5 * f64::from(k / 7));
                let noise = Vector3::from_fn(|a, _| sigma[a] * normal());
                let places = vec![(2 * k as usize, [100.0, 100.0])];
                candidates.push(DoublePointCandidate { xyz: place + noise, covariance, places });
            }
            for k in 0..20 {
                let again = candidates[k].clone();
                let noise = Vector3::from_fn(|a, _| sigma[a] * normal());
                let beside = if k < 10 { (2 * k + 1, [100.0, 100.0]) } else { (2 * k, [104.0, 100.0]) };
                let mut places = vec![beside];
                places.sort_unstable_by_key(|p: &(usize, [f64; 2])| p.0);
                candidates.push(DoublePointCandidate { xyz: again.xyz + noise, places, ..again });
            }
            let found = pairs(&candidates);
            let doubles = (0..10).filter(|k| found.contains(&[*k, 40 + k])).count();
            assert!(doubles >= 9, "round {round}: {found:?}");
            assert!(found.iter().all(|[a, b]| *b == a + 40 && *a < 10), "round {round}: {found:?}");
        }
    }
}
