//! A photo's exterior orientation as a matrix and a centre, and its least-squares refinement.

use nalgebra::{Matrix2x3, Matrix6, SMatrix, Vector2, Vector3, Vector6};

use crate::project::Photo;
use crate::rotation;

/// Exterior orientation: p = M·(X - XL) takes object points into the camera frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// M, object to camera.
    pub object_to_camera: nalgebra::Matrix3<f64>,
    /// XL, the projection centre in the object system.
    pub centre: Vector3<f64>,
}

/// Points nearer to the plane of the projection centre than this share of their distance are not in front.
const GRAZING: f64 = 1e-6;

impl Pose {
    /// Camera frame and object frame agree.
    pub fn identity() -> Self {
        Self { object_to_camera: nalgebra::Matrix3::identity(), centre: Vector3::zeros() }
    }

    /// The exterior orientation a photo of the document holds, if it has both parts and they are finite.
    pub fn of_photo(photo: &Photo) -> Option<Self> {
        let (position, angles) = (photo.position?, photo.rotation?);
        let finite = position.iter().chain(&angles).all(|value| value.is_finite());
        finite.then(|| Self { object_to_camera: rotation::object_to_camera(angles), centre: position.into() })
    }

    /// Object point to camera frame.
    pub fn to_camera(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.object_to_camera * (point - self.centre)
    }

    /// Ideal coordinates of an object point; `None` if it is not in front of the camera.
    pub fn image(&self, point: &Vector3<f64>) -> Option<[f64; 2]> {
        let p = self.to_camera(point);
        (-p.z > GRAZING * p.norm()).then(|| [-p.x / p.z, -p.y / p.z])
    }

    /// Unit direction, in the object system, of the ray of ideal coordinates.
    pub fn ray(&self, [x, y]: [f64; 2]) -> Vector3<f64> {
        self.object_to_camera.tr_mul(&Vector3::new(x, y, -1.0)).normalize()
    }

    /// Residual projection minus measurement in ideal coordinates; `None` if the point is not in front.
    pub fn residual(&self, point: &Vector3<f64>, measured: [f64; 2]) -> Option<Vector2<f64>> {
        self.image(point).map(|[x, y]| Vector2::new(x - measured[0], y - measured[1]))
    }

    /// Length of the residual; infinite when the point is not in front.
    pub fn misfit(&self, point: &Vector3<f64>, measured: [f64; 2]) -> f64 {
        self.residual(point, measured).map_or(f64::INFINITY, |r| r.norm())
    }

    /// Sum of squared residuals; infinite when a point is not in front.
    pub fn cost(&self, object: &[Vector3<f64>], image: &[[f64; 2]]) -> f64 {
        object.iter().zip(image).map(|(p, &m)| self.misfit(p, m).powi(2)).sum()
    }

    /// The pose moved by a turn about the camera's axes and a shift along them, in that order of the six numbers.
    pub(crate) fn moved(&self, step: &Vector6<f64>) -> Self {
        let turn = Vector3::new(step[0], step[1], step[2]);
        let shift = Vector3::new(step[3], step[4], step[5]);
        Self {
            object_to_camera: rotation::turned(&self.object_to_camera, turn),
            centre: self.centre + self.object_to_camera.tr_mul(&shift),
        }
    }

    /// The pose of least squared residuals in ideal coordinates nearest to this one (Levenberg-Marquardt).
    ///
    /// `object` and `image` pair up. Points that are not in front at the start make the start unusable: none.
    pub fn refined(&self, object: &[Vector3<f64>], image: &[[f64; 2]]) -> Option<Self> {
        let mut pose = *self;
        let mut cost = pose.cost(object, image);
        if !cost.is_finite() {
            return None;
        }
        let mut damping = 1e-6;
        for _ in 0..30 {
            let (normal, gradient) = pose.normal_equations(object, image);
            let mut gained = false;
            while damping < 1e8 {
                let mut damped = normal;
                for k in 0..6 {
                    damped[(k, k)] += damping * normal[(k, k)].max(f64::MIN_POSITIVE);
                }
                let Some(step) = damped.cholesky().map(|factor| factor.solve(&-gradient)) else {
                    damping = (damping * 10.0).max(1e-12);
                    continue;
                };
                let trial = pose.moved(&step);
                let trial_cost = trial.cost(object, image);
                if trial_cost < cost {
                    gained = cost - trial_cost > 1e-14 * cost;
                    (pose, cost) = (trial, trial_cost);
                    damping *= 0.1;
                    break;
                }
                damping = (damping * 10.0).max(1e-12);
            }
            if !gained {
                break;
            }
        }
        Some(Self { object_to_camera: rotation::nearest(&pose.object_to_camera), centre: pose.centre })
    }

    /// JᵀJ and Jᵀr over turn (radians) and shift (object units, camera axes).
    ///
    /// With p the point in the camera frame, dp = turn × p - shift, and x = -p₁/p₃, y = -p₂/p₃.
    fn normal_equations(&self, object: &[Vector3<f64>], image: &[[f64; 2]]) -> (Matrix6<f64>, Vector6<f64>) {
        let mut normal = Matrix6::zeros();
        let mut gradient = Vector6::zeros();
        for (point, &measured) in object.iter().zip(image) {
            let Some(residual) = self.residual(point, measured) else { continue };
            let jacobian = pose_jacobian(&self.to_camera(point));
            normal += jacobian.tr_mul(&jacobian);
            gradient += jacobian.tr_mul(&residual);
        }
        (normal, gradient)
    }
}

/// Derivative of ideal coordinates with respect to the point in the camera frame.
pub(crate) fn image_jacobian(p: &Vector3<f64>) -> Matrix2x3<f64> {
    let w = -1.0 / p.z;
    Matrix2x3::new(w, 0.0, p.x * w * w, 0.0, w, p.y * w * w)
}

/// Derivative of ideal coordinates of a point in the camera frame with respect to turn and shift of the pose ([`Pose::moved`]).
pub(crate) fn pose_jacobian(p: &Vector3<f64>) -> SMatrix<f64, 2, 6> {
    let by_point = image_jacobian(p);
    let mut jacobian = SMatrix::<f64, 2, 6>::zeros();
    jacobian.fixed_columns_mut::<3>(0).copy_from(&(-by_point * p.cross_matrix()));
    jacobian.fixed_columns_mut::<3>(3).copy_from(&-by_point);
    jacobian
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn pose() -> Pose {
        Pose { object_to_camera: rotation::object_to_camera([0.3, -0.2, 1.1]), centre: Vector3::new(4.0, 3.0, 9.0) }
    }

    #[test]
    fn analytic_derivatives_are_the_numerical_ones() {
        let point = Vector3::new(0.4, -0.7, 0.2);
        let analytic = pose_jacobian(&pose().to_camera(&point));
        for k in 0..6 {
            let mut step = Vector6::zeros();
            step[k] = 1e-6;
            let (Some([x1, y1]), Some([x0, y0])) =
                (pose().moved(&step).image(&point), pose().moved(&-step).image(&point))
            else {
                panic!("the point is in front");
            };
            assert!(((x1 - x0) / 2e-6 - analytic[(0, k)]).abs() < 1e-8, "x by {k}");
            assert!(((y1 - y0) / 2e-6 - analytic[(1, k)]).abs() < 1e-8, "y by {k}");
        }
    }

    #[test]
    fn a_disturbed_pose_comes_back() {
        let object: Vec<Vector3<f64>> =
            (0..9).map(|k| Vector3::new(f64::from(k % 3), f64::from(k / 3), f64::from(k * k % 5) * 0.3)).collect();
        let image: Vec<[f64; 2]> = object.iter().filter_map(|p| pose().image(p)).collect();
        assert_eq!(image.len(), object.len());
        let start = pose().moved(&Vector6::new(0.1, -0.08, 0.2, 0.5, -0.4, 0.9));
        let refined = start.refined(&object, &image).expect("all points are in front");
        assert!((refined.centre - pose().centre).norm() < 1e-9);
        assert!((refined.object_to_camera - pose().object_to_camera).norm() < 1e-9);
    }
}
