//! Exterior orientation from object points and from rays of other photos together, robustly and from rough starts.
//!
//! A measured object point gives two equations of the pose, the projection minus the measurement; a point that one other
//! oriented photo shows gives one, the distance of the measurement from the epipolar line. Minimised is the bounded loss of Geman and
//! McClure, Σ s²d²/(s² + d²), with a width s that narrows step by step (graduated non-convexity, Blake and Zisserman
//! 1987), so that a start may be off and wrong names lose their weight.

use nalgebra::{Matrix6, SVector, Vector3, Vector6};

use super::Pose;
use super::intersection::Ray;
use super::pose::pose_jacobian;

/// Object of a measurement in the photo to be oriented.
#[derive(Clone, Copy, Debug)]
pub enum ResectionTarget {
    /// A point with these coordinates.
    Point(Vector3<f64>),
    /// A point somewhere on this ray of another photo.
    Ray(Ray),
}

/// A measurement in the photo to be oriented, in ideal coordinates.
#[derive(Clone, Copy, Debug)]
pub struct ResectionObservation {
    /// The measured quantity.
    pub target: ResectionTarget,
    /// Where.
    pub image: [f64; 2],
}

/// Iterations at each width.
const ITERATIONS: usize = 8;

impl ResectionObservation {
    /// Equations of a pose that it gives.
    pub fn equations(&self) -> usize {
        match self.target {
            ResectionTarget::Point(_) => 2,
            ResectionTarget::Ray(_) => 1,
        }
    }

    /// Distance of the measurement from where the pose has the point or its epipolar line; infinite where the point is not in
    /// front of the cameras.
    pub fn misfit(&self, pose: &Pose) -> f64 {
        match self.target {
            ResectionTarget::Point(point) => pose.misfit(&point, self.image),
            ResectionTarget::Ray(ray) => {
                let own = pose.ray(self.image);
                let other = ray.pose.ray(ray.image);
                let base = pose.centre - ray.pose.centre;
                // with base + t·own = s·other: both lengths, least squares, share the sign of these
                let cosine = own.dot(&other);
                let (b, a) = (base.dot(&own), base.dot(&other));
                let ahead = cosine * a - b > 0.0 && a - cosine * b > 0.0;
                if ahead { self.rows(pose).first().map_or(f64::INFINITY, |(d, _)| d.abs()) } else { f64::INFINITY }
            }
        }
    }

    /// Residuals with their derivatives by turn and shift along the camera's axes; none behind the camera.
    fn rows(&self, pose: &Pose) -> Vec<(f64, Vector6<f64>)> {
        let [x, y] = self.image;
        match self.target {
            ResectionTarget::Point(point) => {
                let Some(residual) = pose.residual(&point, self.image) else { return Vec::new() };
                let jacobian = pose_jacobian(&pose.to_camera(&point));
                (0..2).map(|k| (residual[k], jacobian.row(k).transpose())).collect()
            }
            ResectionTarget::Ray(ray) => {
                // r·n = 0 with n the normal of the epipolar plane in the camera frame
                let other = pose.object_to_camera * ray.pose.ray(ray.image);
                let n = (pose.object_to_camera * (pose.centre - ray.pose.centre)).cross(&other);
                let r = Vector3::new(x, y, -1.0);
                let slope = n.x.hypot(n.y);
                if !(slope > 0.0) {
                    return Vec::new();
                }
                let (turn, shift) = (n.cross(&r) / slope, other.cross(&r) / slope);
                let row = SVector::from([turn.x, turn.y, turn.z, shift.x, shift.y, shift.z]);
                vec![(r.dot(&n) / slope, row)]
            }
        }
    }

    /// Square of the residual; none behind the camera.
    fn square(&self, pose: &Pose) -> Option<f64> {
        let rows = self.rows(pose);
        (!rows.is_empty()).then(|| rows.iter().map(|(d, _)| d * d).sum())
    }
}

/// The pose that a start leads to while the width of the loss (ideal coordinates) narrows over `widths`.
pub fn settled(start: Pose, seen: &[ResectionObservation], widths: &[f64]) -> Pose {
    let mut pose = start;
    for &width in widths {
        let room = width * width;
        // what is behind the camera costs as much as what is infinitely far off
        let cost = |pose: &Pose| -> f64 {
            seen.iter().map(|s| s.square(pose).map_or(room, |square| room * square / (room + square))).sum()
        };
        let mut current = cost(&pose);
        let mut damping = 1e-4;
        for _ in 0..ITERATIONS {
            let (mut normal, mut gradient) = (Matrix6::zeros(), Vector6::zeros());
            for s in seen {
                let rows = s.rows(&pose);
                let square: f64 = rows.iter().map(|(d, _)| d * d).sum();
                let weight = (room / (room + square)).powi(2);
                for (d, row) in rows {
                    normal += row * row.transpose() * weight;
                    gradient += row * (d * weight);
                }
            }
            let mut gained = false;
            while damping < 1e6 {
                let mut damped = normal;
                for k in 0..6 {
                    damped[(k, k)] += damping * normal[(k, k)].max(f64::MIN_POSITIVE);
                }
                let trial = damped.cholesky().map(|factor| pose.moved(&factor.solve(&-gradient)));
                if let Some(trial) = trial {
                    let next = cost(&trial);
                    if next < current {
                        gained = current - next > 1e-6 * current;
                        (pose, current) = (trial, next);
                        damping = (damping * 0.1).max(1e-12);
                        break;
                    }
                }
                damping *= 10.0;
            }
            if !gained {
                break;
            }
        }
    }
    Pose { object_to_camera: crate::rotation::nearest(&pose.object_to_camera), centre: pose.centre }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::robust::{generator, uniform};
    use crate::rotation;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn pose(angles: [f64; 3], centre: [f64; 3]) -> Pose {
        Pose { object_to_camera: rotation::object_to_camera(angles), centre: centre.into() }
    }

    /// Three points and eight rays of two other photos, as `own` sees them.
    fn scene(own: &Pose) -> Vec<ResectionObservation> {
        let others = [pose([0.1, 0.3, 0.2], [2.0, -0.5, 6.0]), pose([-0.2, -0.25, 1.5], [-1.5, 1.0, 5.5])];
        let mut random = generator(7);
        let mut all = Vec::new();
        for k in 0..11 {
            let point = Vector3::from_fn(|_, _| 2.0 * uniform(&mut random) - 1.0);
            let other = others[k % 2];
            let (Some(image), Some(there)) = (own.image(&point), other.image(&point)) else { panic!("in front") };
            let ray = Ray { pose: other, image: there, weight: 1.0 };
            all.push(ResectionObservation {
                target: if k < 3 { ResectionTarget::Point(point) } else { ResectionTarget::Ray(ray) },
                image,
            });
        }
        all
    }

    #[test]
    fn analytic_derivatives_are_the_numerical_ones() {
        let own = pose([0.3, -0.2, 1.1], [1.0, 1.5, 6.0]);
        for seen in scene(&pose([0.31, -0.21, 1.12], [1.02, 1.48, 6.05])) {
            // The slope of an epipolar line is held, as in every step: near the solution it does not matter.
            let scale = |pose: &Pose| match seen.target {
                ResectionTarget::Point(_) => 1.0,
                ResectionTarget::Ray(ray) => {
                    let other = pose.object_to_camera * ray.pose.ray(ray.image);
                    let n = (pose.object_to_camera * (pose.centre - ray.pose.centre)).cross(&other);
                    n.x.hypot(n.y)
                }
            };
            for (row, (_, analytic)) in seen.rows(&own).into_iter().enumerate() {
                for k in 0..6 {
                    let mut step = Vector6::zeros();
                    step[k] = 1e-6;
                    let at = |pose: Pose| seen.rows(&pose)[row].0 * scale(&pose) / scale(&own);
                    let numerical = (at(own.moved(&step)) - at(own.moved(&-step))) / 2e-6;
                    assert!((numerical - analytic[k]).abs() < 1e-7, "{numerical} for {} by {k}", analytic[k]);
                }
            }
        }
    }

    #[test]
    fn a_pose_is_found_among_wrong_names() {
        let own = pose([0.3, -0.2, 1.1], [1.0, 1.5, 6.0]);
        let mut seen = scene(&own);
        seen[1].image[0] += 0.15;
        seen[5].image[1] -= 0.2;
        // Wider steps from here may end in the very place of another photo, whose own rays agree there.
        let start = pose([0.32, -0.22, 1.07], [1.1, 1.4, 5.9]);
        let found = settled(start, &seen, &[0.03, 0.01, 0.003, 0.001]);
        let agreeing = |pose: &Pose| seen.iter().filter(|s| s.misfit(pose) < 1e-3).count();
        assert_ne!(agreeing(&start), 9);
        assert!((found.centre - own.centre).norm() < 1e-3, "{}", found.centre);
        assert!((found.object_to_camera - own.object_to_camera).norm() < 1e-3);
        assert_eq!(agreeing(&found), 9);
        let equations: usize = seen.iter().map(ResectionObservation::equations).sum();
        assert_eq!(equations, 14);
    }
}
