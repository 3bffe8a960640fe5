//! Relative orientation of two photos from image points alone.
//!
//! Five-point samples ([`super::essential`]) judged by the median distance from the epipolar lines (first order,
//! Sampson 1982), then least squares of those distances over the five parameters. A plane object can have two
//! orientations that fit alike: both are returned, and a third photo decides.

use nalgebra::{Matrix3, Matrix5, SVector, Vector3, Vector5};

use super::essential::five_points;
use super::intersection::SMALLEST_ANGLE;
use super::robust::{generator, quantile, sample, scale};
use super::{Degeneracy, Pose};
use crate::rotation;

/// A relative orientation.
#[derive(Clone, Debug, PartialEq)]
pub struct Relative {
    /// The second photo in the camera frame of the first; the base has length 1.
    pub pose: Pose,
    /// Robust standard deviation of the distances from the epipolar lines, ideal coordinates.
    pub scale: f64,
    /// Which pairs agree with it.
    pub inliers: Vec<bool>,
    /// Median angle at which the rays of the agreeing pairs meet, radians.
    pub angle: f64,
}

/// Number of five-point samples: enough to have, with 40 % wrong pairs, one clean sample in all but one in 10⁷ cases.
const SAMPLES: usize = 200;
/// Pairs on which samples are judged; more add time and no safety.
const JUDGES: usize = 100;

/// The relative orientations that the pairs of image points (ideal coordinates) agree with, best first.
///
/// A pair takes part when its distance from the epipolar line is within 3.5 robust standard deviations or `tolerance`
/// (ideal coordinates). Same input and seed, same result.
///
/// # Errors
/// [`Degeneracy::TooFew`] below five pairs, [`Degeneracy::NearParallel`] if the photos were taken from one place,
/// [`Degeneracy::NoSolution`] when nothing puts the points in front of both.
pub fn relative_orientation(
    first: &[[f64; 2]],
    second: &[[f64; 2]],
    tolerance: f64,
    seed: u64,
) -> Result<Vec<Relative>, Degeneracy> {
    let n = first.len().min(second.len());
    if n < 5 {
        return Err(Degeneracy::TooFew { needed: 5, given: n });
    }
    let (first, second) = (&first[..n], &second[..n]);
    let mut random = generator(seed);
    let judges: Vec<usize> = (0..n.min(JUDGES)).map(|k| k * n / n.min(JUDGES)).collect();
    let share = if n < 12 { 0.75 } else { 0.6 };
    let mut candidates: Vec<(f64, Matrix3<f64>)> = Vec::new();
    for _ in 0..if n == 5 { 1 } else { SAMPLES } {
        let chosen: [usize; 5] = sample(&mut random, n);
        for e in five_points(&chosen.map(|k| first[k]), &chosen.map(|k| second[k])) {
            let distances: Vec<f64> = judges.iter().map(|&k| sampson(&e, first[k], second[k]).abs()).collect();
            candidates.push((quantile(&distances, share), e));
        }
    }
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut found: Vec<Relative> = Vec::new();
    let mut near_parallel = None;
    for (_, e) in candidates.into_iter().take(40) {
        let Some(relative) = in_front(&e, first, second).and_then(|pose| improved(pose, first, second, tolerance))
        else {
            continue;
        };
        let same = |other: &Relative| {
            (other.pose.object_to_camera - relative.pose.object_to_camera).norm() < 0.02
                && (other.pose.centre - relative.pose.centre).norm() < 0.05
        };
        if relative.angle < SMALLEST_ANGLE {
            near_parallel = Some(relative.angle);
        } else if !found.iter().any(same) {
            found.push(relative);
        }
    }
    found.sort_by(|a, b| a.scale.total_cmp(&b.scale));
    if let Some(best) = found.first().map(|r| r.scale) {
        found.retain(|r| r.scale <= 3.0 * best + tolerance);
    }
    match (found.is_empty(), near_parallel) {
        (false, _) => Ok(found),
        (true, Some(angle)) => Err(Degeneracy::NearParallel { angle }),
        (true, None) => Err(Degeneracy::NoSolution),
    }
}

fn ray([x, y]: [f64; 2]) -> Vector3<f64> {
    Vector3::new(x, y, -1.0)
}

/// First-order distance of a pair from the condition rᵀE l = 0, in ideal coordinates, with sign.
fn sampson(e: &Matrix3<f64>, first: [f64; 2], second: [f64; 2]) -> f64 {
    let (l, r) = (ray(first), ray(second));
    let (line, back) = (e * l, e.tr_mul(&r));
    let slope = (line.x * line.x + line.y * line.y + back.x * back.x + back.y * back.y).sqrt();
    if slope > 0.0 { r.dot(&line) / slope } else { 0.0 }
}

fn essential(pose: &Pose) -> Matrix3<f64> {
    pose.object_to_camera * pose.centre.cross_matrix()
}

/// Distances of the intersected point from both projection centres along the rays, in base lengths.
fn depths(pose: &Pose, first: [f64; 2], second: [f64; 2]) -> Option<[f64; 2]> {
    // s·l - t·r = b, least squares over the two lengths.
    let (l, r) = (ray(first).normalize(), pose.ray(second));
    let cosine = l.dot(&r);
    let determinant = 1.0 - cosine * cosine;
    let (bl, br) = (pose.centre.dot(&l), pose.centre.dot(&r));
    (determinant > 1e-12).then(|| [(bl - cosine * br) / determinant, (cosine * bl - br) / determinant])
}

/// Of the four poses of an essential matrix, the one with most points in front of both photos.
fn in_front(e: &Matrix3<f64>, first: &[[f64; 2]], second: &[[f64; 2]]) -> Option<Pose> {
    let svd = e.svd(true, true);
    let (u, v_t) = (svd.u?, svd.v_t?);
    let base = v_t.row(2).transpose();
    let w = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    let mut best: Option<(usize, Pose)> = None;
    for turn in [w, w.transpose()] {
        let m = u * turn * v_t;
        let m = m * m.determinant().signum();
        for centre in [base, -base] {
            let pose = Pose { object_to_camera: m, centre };
            let ahead = |k: &usize| depths(&pose, first[*k], second[*k]).is_some_and(|[s, t]| s > 0.0 && t > 0.0);
            let count = (0..first.len()).filter(ahead).count();
            if best.is_none_or(|(most, _)| count > most) {
                best = Some((count, pose));
            }
        }
    }
    best.filter(|(count, _)| 2 * count > first.len()).map(|(_, pose)| pose)
}

/// Least squares over the pairs that agree, twice, so that the second choice of pairs is made from a good orientation.
fn improved(mut pose: Pose, first: &[[f64; 2]], second: &[[f64; 2]], tolerance: f64) -> Option<Relative> {
    let mut inliers = Vec::new();
    let mut robust = 0.0;
    for round in 0..3 {
        let e = essential(&pose);
        let lengths: Vec<f64> = first.iter().zip(second).map(|(&l, &r)| sampson(&e, l, r).abs()).collect();
        // One-dimensional distances: the median of |N(0, 1)| is 0.6745, that of a Rayleigh length 1.1774.
        robust = scale(&lengths, 5) * 1.1774 / 0.6745;
        inliers = lengths.iter().map(|length| *length <= (3.5 * robust).max(tolerance)).collect();
        if round < 2 {
            let kept: Vec<usize> = (0..first.len()).filter(|&k| inliers[k]).collect();
            pose = adjusted(pose, &kept, first, second);
        }
    }
    let mut angles = Vec::new();
    let mut ahead = 0;
    for k in (0..first.len()).filter(|&k| inliers[k]) {
        let (l, r) = (ray(first[k]).normalize(), pose.ray(second[k]));
        angles.push(l.cross(&r).norm().atan2(l.dot(&r)));
        ahead += usize::from(depths(&pose, first[k], second[k]).is_some_and(|[s, t]| s > 0.0 && t > 0.0));
    }
    let enough = angles.len() >= 5 && 10 * ahead >= 8 * angles.len();
    enough.then(|| Relative { pose, scale: robust, angle: quantile(&angles, 0.5), inliers })
}

/// Levenberg-Marquardt on the squared distances over three turns of the second photo and two of the base.
///
/// With e = rᵀM(b × l): de/dturn = M(b × l) × r, de/db = l × Mᵀr; the slope in the denominator is held in each step.
fn adjusted(start: Pose, kept: &[usize], first: &[[f64; 2]], second: &[[f64; 2]]) -> Pose {
    let cost = |pose: &Pose| -> f64 {
        let e = essential(pose);
        kept.iter().map(|&k| sampson(&e, first[k], second[k]).powi(2)).sum()
    };
    let (mut pose, mut current) = (start, cost(&start));
    let mut damping = 1e-6;
    for _ in 0..20 {
        let tangents = tangent_basis(&pose.centre);
        let e = essential(&pose);
        let mut normal = Matrix5::zeros();
        let mut gradient = Vector5::zeros();
        for &k in kept {
            let (l, r) = (ray(first[k]), ray(second[k]));
            let (line, back) = (e * l, e.tr_mul(&r));
            let slope = (line.x * line.x + line.y * line.y + back.x * back.x + back.y * back.y).sqrt();
            if !(slope > 0.0) {
                continue;
            }
            let by_turn = line.cross(&r);
            let by_base = l.cross(&pose.object_to_camera.tr_mul(&r));
            let row = SVector::<f64, 5>::from([
                by_turn.x,
                by_turn.y,
                by_turn.z,
                by_base.dot(&tangents[0]),
                by_base.dot(&tangents[1]),
            ]) / slope;
            normal += row * row.transpose();
            gradient += row * (r.dot(&line) / slope);
        }
        let mut gained = false;
        while damping < 1e6 {
            let mut damped = normal;
            for k in 0..5 {
                damped[(k, k)] += damping * normal[(k, k)].max(1e-300);
            }
            if let Some(step) = damped.cholesky().map(|factor| factor.solve(&-gradient)) {
                let trial = Pose {
                    object_to_camera: rotation::turned(&pose.object_to_camera, Vector3::new(step[0], step[1], step[2])),
                    centre: (pose.centre + tangents[0] * step[3] + tangents[1] * step[4]).normalize(),
                };
                let trial_cost = cost(&trial);
                if trial_cost < current {
                    gained = current - trial_cost > 1e-10 * current;
                    (pose, current) = (trial, trial_cost);
                    damping *= 0.1;
                    break;
                }
            }
            damping *= 10.0;
        }
        if !gained {
            break;
        }
    }
    Pose { object_to_camera: rotation::nearest(&pose.object_to_camera), centre: pose.centre }
}

/// Two unit vectors orthogonal to `direction` and to each other.
fn tangent_basis(direction: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let mut axis = Vector3::zeros();
    axis[direction.iamin()] = 1.0;
    let first = direction.cross(&axis).normalize();
    [first, direction.cross(&first).normalize()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::robust::uniform;
    use crate::rotation::object_to_camera;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    struct Pair {
        pose: Pose,
        first: Vec<[f64; 2]>,
        second: Vec<[f64; 2]>,
    }

    fn pair(seed: u64, n: usize, flat: f64, noise: f64) -> Pair {
        let mut g = generator(seed);
        let mut next = || 2.0 * uniform(&mut g) - 1.0;
        let side = 1.5 + next();
        let m = object_to_camera([0.2 * next(), (side / 5.0).atan() + 0.1 * next(), 3.0 * next()]);
        let pose = Pose { object_to_camera: m, centre: Vector3::new(side, 0.5 * next(), 0.5 * next()) };
        let tilt = object_to_camera([0.5 * next(), 0.5 * next(), 0.0]);
        let (mut first, mut second) = (Vec::new(), Vec::new());
        for _ in 0..n {
            let point = tilt * Vector3::new(1.5 * next(), 1.5 * next(), flat * next()) - Vector3::z() * 5.0;
            let mut seen = |p: &Pose| p.image(&point).expect("in front").map(|x| x + noise * next());
            first.push(seen(&Pose::identity()));
            second.push(seen(&pose));
        }
        let pose = Pose { centre: pose.centre.normalize(), ..pose };
        Pair { pose, first, second }
    }

    fn near(found: &[Relative], truth: &Pose, limit: f64) -> bool {
        found.iter().any(|r| {
            (r.pose.centre - truth.centre).norm() < limit
                && (r.pose.object_to_camera - truth.object_to_camera).norm() < limit
        })
    }

    #[test]
    fn exact_pairs_are_oriented_exactly() {
        for seed in 0..20 {
            let p = pair(seed, 20, 1.0, 0.0);
            let found = relative_orientation(&p.first, &p.second, 1e-9, 0).expect("solvable");
            assert!(near(&found[..1], &p.pose, 1e-7), "seed {seed}");
        }
    }

    #[test]
    fn planes_are_oriented_up_to_their_ambiguity() {
        for seed in 0..20 {
            let p = pair(seed, 30, 0.0, 1e-4);
            let found = relative_orientation(&p.first, &p.second, 1e-4, 0).expect("solvable");
            assert!(near(&found, &p.pose, 0.03), "seed {seed}");
            assert!(found.len() <= 4, "seed {seed}: {}", found.len());
        }
    }

    #[test]
    fn wrong_pairs_are_left_out() {
        for seed in 0..10 {
            let mut p = pair(100 + seed, 30, 1.0, 1e-4);
            for k in 0..6 {
                p.second.swap(k, 29 - k);
            }
            let found = relative_orientation(&p.first, &p.second, 3e-4, 0).expect("mostly right");
            assert!(near(&found[..1], &p.pose, 0.02), "seed {seed}");
        }
    }

    #[test]
    fn one_standpoint_and_few_pairs_are_named() {
        let p = pair(1, 20, 1.0, 0.0);
        let turned: Vec<_> = p
            .first
            .iter()
            .map(|&m| {
                let q = object_to_camera([0.1, 0.2, 0.3]) * ray(m);
                [-q.x / q.z, -q.y / q.z]
            })
            .collect();
        let error = relative_orientation(&p.first, &turned, 1e-9, 0).unwrap_err();
        assert!(matches!(error, Degeneracy::NearParallel { .. } | Degeneracy::NoSolution), "{error}");
        let too_few = relative_orientation(&p.first[..4], &p.second[..4], 1e-9, 0).unwrap_err();
        assert_eq!(too_few, Degeneracy::TooFew { needed: 5, given: 4 });
    }
}
