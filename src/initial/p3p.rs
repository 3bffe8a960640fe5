//! Space resection from three points: every solution.
//!
//! Grunert's equations as reviewed by Haralick, Lee, Ottenberg and Nölle (1994), International Journal of Computer
//! Vision 13, 331-356: the distances s₁, s₂, s₃ from the projection centre to the points follow from the three cosine
//! laws; with u = s₂/s₁ and v = s₃/s₁ they leave a quartic in v.

use nalgebra::{Matrix3, Vector3};

use super::Pose;
use super::polynomial::real_roots;
use crate::rotation;

/// The poses, up to four, from which three object points are seen along three rays given in ideal coordinates.
///
/// None for three points on a line. Each solution has all points in front and reproduces the rays to rounding.
pub fn p3p(object: &[Vector3<f64>; 3], image: &[[f64; 2]; 3]) -> Vec<Pose> {
    let rays = image.map(|[x, y]| Vector3::new(x, y, -1.0).normalize());
    let side = |i: usize, j: usize| (object[i] - object[j]).norm_squared();
    let (a2, b2, c2) = (side(1, 2), side(0, 2), side(0, 1));
    let area = (object[1] - object[0]).cross(&(object[2] - object[0])).norm();
    if !(area > 1e-9 * a2.max(b2).max(c2)) {
        return Vec::new();
    }
    let (cos_a, cos_b, cos_c) = (rays[1].dot(&rays[2]), rays[0].dot(&rays[2]), rays[0].dot(&rays[1]));
    let mut poses: Vec<Pose> = Vec::new();
    for v in real_roots(&quartic([a2, b2, c2], [cos_a, cos_b, cos_c])) {
        if v <= 0.0 {
            continue;
        }
        for u in ratios([a2, b2, c2], [cos_a, cos_b, cos_c], v) {
            let s1 = (b2 / (1.0 + v * v - 2.0 * v * cos_b)).sqrt();
            if !(u > 0.0 && s1.is_finite()) {
                continue;
            }
            let distances = polished(Vector3::new(s1, u * s1, v * s1), [a2, b2, c2], [cos_a, cos_b, cos_c]);
            if distances.min() <= 0.0 {
                continue;
            }
            let camera = [0, 1, 2].map(|k| rays[k] * distances[k]);
            let pose = pose_of_triangle(object, &camera);
            let fits = pose.cost(object, image) < 1e-12;
            let seen = poses.iter().any(|p| (p.centre - pose.centre).norm() < 1e-7 * distances.max());
            if fits && !seen {
                poses.push(pose);
            }
        }
    }
    poses
}

/// Coefficients of the quartic in v = s₃/s₁, constant first.
fn quartic([a2, b2, c2]: [f64; 3], [cos_a, cos_b, cos_c]: [f64; 3]) -> [f64; 5] {
    let difference = (a2 - c2) / b2;
    let sum = (a2 + c2) / b2;
    [
        (1.0 + difference).powi(2) - 4.0 * a2 / b2 * cos_c * cos_c,
        4.0 * (-difference * (1.0 + difference) * cos_b + 2.0 * a2 / b2 * cos_c * cos_c * cos_b
            - (1.0 - sum) * cos_a * cos_c),
        2.0 * (difference * difference - 1.0
            + 2.0 * difference * difference * cos_b * cos_b
            + 2.0 * (b2 - c2) / b2 * cos_a * cos_a
            - 4.0 * sum * cos_a * cos_b * cos_c
            + 2.0 * (b2 - a2) / b2 * cos_c * cos_c),
        4.0 * (difference * (1.0 - difference) * cos_b - (1.0 - sum) * cos_a * cos_c
            + 2.0 * c2 / b2 * cos_a * cos_a * cos_b),
        (difference - 1.0).powi(2) - 4.0 * c2 / b2 * cos_a * cos_a,
    ]
}

/// The ratios u = s₂/s₁ that go with v. The linear equation for u vanishes on symmetric figures, so the two roots of
/// the first cosine law are both tried; the reprojection decides.
fn ratios([_, b2, c2]: [f64; 3], [_, cos_b, cos_c]: [f64; 3], v: f64) -> [f64; 2] {
    let s1_squared_inverse = (1.0 + v * v - 2.0 * v * cos_b) / b2;
    // 1 + u² - 2u·cosγ = c²/s₁²
    let root = (cos_c * cos_c - 1.0 + c2 * s1_squared_inverse).max(0.0).sqrt();
    [cos_c + root, cos_c - root]
}

/// Newton's method on the three cosine laws, which repairs what the quartic lost by cancellation.
fn polished(mut s: Vector3<f64>, [a2, b2, c2]: [f64; 3], [cos_a, cos_b, cos_c]: [f64; 3]) -> Vector3<f64> {
    let laws = |s: &Vector3<f64>| {
        Vector3::new(
            s[1] * s[1] + s[2] * s[2] - 2.0 * s[1] * s[2] * cos_a - a2,
            s[0] * s[0] + s[2] * s[2] - 2.0 * s[0] * s[2] * cos_b - b2,
            s[0] * s[0] + s[1] * s[1] - 2.0 * s[0] * s[1] * cos_c - c2,
        )
    };
    let mut misclosure = laws(&s);
    for _ in 0..20 {
        let half = Matrix3::new(
            0.0,
            s[1] - s[2] * cos_a,
            s[2] - s[1] * cos_a,
            s[0] - s[2] * cos_b,
            0.0,
            s[2] - s[0] * cos_b,
            s[0] - s[1] * cos_c,
            s[1] - s[0] * cos_c,
            0.0,
        );
        let Some(step) = half.lu().solve(&(misclosure * 0.5)) else { break };
        let next = s - step;
        let next_misclosure = laws(&next);
        if !(next_misclosure.norm() < misclosure.norm()) {
            break;
        }
        (s, misclosure) = (next, next_misclosure);
    }
    s
}

/// The pose that transforms a triangle of the object to the same triangle in the camera frame.
fn pose_of_triangle(object: &[Vector3<f64>; 3], camera: &[Vector3<f64>; 3]) -> Pose {
    let frame = |t: &[Vector3<f64>; 3]| {
        let first = (t[1] - t[0]).normalize();
        let normal = first.cross(&(t[2] - t[0])).normalize();
        Matrix3::from_columns(&[first, normal.cross(&first), normal])
    };
    let m = rotation::nearest(&(frame(camera) * frame(object).transpose()));
    let mean = |t: &[Vector3<f64>; 3]| (t[0] + t[1] + t[2]) / 3.0;
    Pose { object_to_camera: m, centre: mean(object) - m.tr_mul(&mean(camera)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn the_true_pose_is_always_among_the_solutions() {
        let mut missed = 0;
        let mut generator = super::super::robust::generator(5);
        let mut next = || super::super::robust::uniform(&mut generator) * 2.0 - 1.0;
        for _ in 0..2000 {
            let object = [0; 3].map(|_| Vector3::new(next(), next(), next()));
            let rotation = rotation::object_to_camera([next() * 3.1, next() * 1.5, next() * 3.1]);
            let depth = Vector3::new(0.3 * next(), 0.3 * next(), -4.0 + next());
            let truth = Pose { object_to_camera: rotation, centre: -rotation.tr_mul(&depth) };
            let image = object.map(|p| truth.image(&p).expect("in front"));
            let solutions = p3p(&object, &image);
            assert!(solutions.len() <= 4);
            if !solutions.iter().any(|p| (p.centre - truth.centre).norm() < 1e-5) {
                missed += 1;
            }
        }
        assert!(missed <= 2, "{missed} of 2000 missed");
    }

    #[test]
    fn symmetric_figures_and_lines_do_no_harm() {
        let object = [
            Vector3::new(1.0, 0.0, 0.0),
            Vector3::new(-0.5, 0.75f64.sqrt(), 0.0),
            Vector3::new(-0.5, -(0.75f64.sqrt()), 0.0),
        ];
        let truth = Pose { object_to_camera: Matrix3::identity(), centre: Vector3::new(0.0, 0.0, 5.0) };
        let image = object.map(|p| truth.image(&p).expect("in front"));
        assert!(p3p(&object, &image).iter().any(|p| (p.centre - truth.centre).norm() < 1e-6));
        let line = [Vector3::zeros(), Vector3::x(), Vector3::x() * 2.0];
        assert!(p3p(&line, &image).is_empty());
    }
}
