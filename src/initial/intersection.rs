//! Forward intersection of any number of rays.
//!
//! Linear start after Kim, Hwang and Yun (2015), equations 11-17: every ray gives two equations,
//! (m₁ + x·m₃)·(X - XL) = 0 and (m₂ + y·m₃)·(X - XL) = 0 with mᵢ the rows of M, solved by least squares; then the
//! squared residuals in ideal coordinates are minimised.

use nalgebra::{Matrix3, Vector3};

use super::pose::image_jacobian;
use super::{Degeneracy, Pose};

/// One ray: the photo's exterior orientation, the ideal coordinates in it, and the ray's weight in the refinement.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Exterior orientation of the photo.
    pub pose: Pose,
    /// Ideal coordinates.
    pub image: [f64; 2],
    /// Weight of the residuals in ideal coordinates: (c / sigma)², or 1 for equal weights.
    pub weight: f64,
}

/// An intersected point.
#[derive(Clone, Debug, PartialEq)]
pub struct Intersection {
    /// Object coordinates.
    pub point: Vector3<f64>,
    /// Largest angle between two of the rays, in radians.
    pub angle: f64,
    /// Projection minus measurement in ideal coordinates, ray by ray.
    pub residuals: Vec<[f64; 2]>,
    /// Cofactor matrix of the point for the given weights; its covariance matrix if these are (c / sigma)².
    pub cofactors: Matrix3<f64>,
}

/// Minimum intersection angle (0.3°): with a smaller one the distance is undetermined.
pub const SMALLEST_ANGLE: f64 = 0.005;

/// The object point with the smallest squared residuals of all rays.
///
/// # Errors
/// [`Degeneracy::TooFew`] below two rays; [`Degeneracy::NearParallel`] if no two rays meet at [`SMALLEST_ANGLE`] or
/// more; [`Degeneracy::BehindCamera`] names the first ray that points away from the point.
pub fn intersect(rays: &[Ray]) -> Result<Intersection, Degeneracy> {
    if rays.len() < 2 {
        return Err(Degeneracy::TooFew { needed: 2, given: rays.len() });
    }
    let angle = largest_angle(rays);
    if !(angle >= SMALLEST_ANGLE) {
        return Err(Degeneracy::NearParallel { angle });
    }
    let start = linear(rays).ok_or(Degeneracy::NearParallel { angle })?;
    if let Some(ray) = behind(rays, &start) {
        return Err(Degeneracy::BehindCamera { ray });
    }
    let (point, normal) = refined(rays, start);
    if let Some(ray) = behind(rays, &point) {
        return Err(Degeneracy::BehindCamera { ray });
    }
    let cofactors = normal.try_inverse().ok_or(Degeneracy::NearParallel { angle })?;
    let residuals =
        rays.iter().map(|ray| ray.pose.residual(&point, ray.image).map_or([0.0; 2], |r| [r.x, r.y])).collect();
    Ok(Intersection { point, angle, residuals, cofactors })
}

/// Largest angle between two rays, over all pairs: a point has at most as many rays as there are photos.
fn largest_angle(rays: &[Ray]) -> f64 {
    let directions: Vec<Vector3<f64>> = rays.iter().map(|ray| ray.pose.ray(ray.image)).collect();
    let mut largest: f64 = 0.0;
    for (k, a) in directions.iter().enumerate() {
        for b in &directions[k + 1..] {
            largest = largest.max(a.cross(b).norm().atan2(a.dot(b)));
        }
    }
    largest
}

/// Least-squares solution of the linear equations, each normalised so that points far from the image centre have the same weight.
/// Coordinates are reduced to the first projection centre. `None` if the equations are singular.
fn linear(rays: &[Ray]) -> Option<Vector3<f64>> {
    let origin = rays[0].pose.centre;
    let mut normal = Matrix3::zeros();
    let mut right = Vector3::zeros();
    for ray in rays {
        let m = &ray.pose.object_to_camera;
        for (k, coordinate) in ray.image.iter().enumerate() {
            let row = (m.row(k) + m.row(2) * *coordinate).transpose();
            let row = row / row.norm();
            normal += row * row.transpose();
            right += row * row.dot(&(ray.pose.centre - origin));
        }
    }
    normal.cholesky().map(|factor| origin + factor.solve(&right)).filter(|p| p.iter().all(|c| c.is_finite()))
}

fn behind(rays: &[Ray], point: &Vector3<f64>) -> Option<usize> {
    rays.iter().position(|ray| ray.pose.image(point).is_none())
}

/// Gauss-Newton iteration with step halving; returns the point and its normal matrix.
fn refined(rays: &[Ray], mut point: Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let cost =
        |p: &Vector3<f64>| -> f64 { rays.iter().map(|ray| ray.weight * ray.pose.misfit(p, ray.image).powi(2)).sum() };
    let mut current = cost(&point);
    let mut normal = Matrix3::zeros();
    for _ in 0..20 {
        let mut gradient = Vector3::zeros();
        normal = Matrix3::zeros();
        for ray in rays {
            let Some(residual) = ray.pose.residual(&point, ray.image) else { continue };
            let jacobian = image_jacobian(&ray.pose.to_camera(&point)) * ray.pose.object_to_camera;
            normal += jacobian.tr_mul(&jacobian) * ray.weight;
            gradient += jacobian.tr_mul(&residual) * ray.weight;
        }
        let Some(step) = normal.cholesky().map(|factor| factor.solve(&gradient)) else { break };
        let mut share = 1.0;
        let mut gained = false;
        while share > 1e-3 {
            let trial = point - step * share;
            let trial_cost = cost(&trial);
            if trial_cost < current {
                gained = current - trial_cost > 1e-14 * current;
                (point, current) = (trial, trial_cost);
                break;
            }
            share *= 0.5;
        }
        if !gained {
            break;
        }
    }
    (point, normal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotation::object_to_camera;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn ray(angles: [f64; 3], centre: [f64; 3], point: Vector3<f64>) -> Ray {
        let pose = Pose { object_to_camera: object_to_camera(angles), centre: centre.into() };
        Ray { pose, image: pose.image(&point).expect("in front"), weight: 1.0 }
    }

    #[test]
    fn exact_rays_meet_in_large_coordinates() {
        let point = Vector3::new(1e6 + 1.0, -2e6, 12.0);
        let rays: Vec<Ray> = [-400.0, 0.0, 350.0, 500.0]
            .map(|d| ray([0.01, d * -4e-4, 0.3], [1e6 + d, -2e6 + d * 0.2, 900.0], point))
            .to_vec();
        let found = intersect(&rays).expect("four good rays");
        assert!((found.point - point).norm() < 1e-6);
        assert!(found.angle > 0.5 && found.residuals.iter().flatten().all(|r| r.abs() < 1e-12));
    }

    #[test]
    fn degenerate_rays_are_reported() {
        let point = Vector3::new(0.0, 0.0, -1000.0);
        let one = ray([0.0; 3], [0.0; 3], point);
        assert_eq!(intersect(&[one]).unwrap_err(), Degeneracy::TooFew { needed: 2, given: 1 });
        let near = ray([0.0; 3], [1.0, 0.0, 0.0], point);
        assert!(matches!(intersect(&[one, near]).unwrap_err(), Degeneracy::NearParallel { angle } if angle < 0.002));
        let mut apart = ray([0.0; 3], [100.0, 0.0, 0.0], point);
        apart.image = [0.3, 0.0];
        assert_eq!(intersect(&[one, apart]).unwrap_err(), Degeneracy::BehindCamera { ray: 0 });
    }

    #[test]
    fn the_refined_point_is_the_minimum_and_its_cofactors_are_its_curvature() {
        let point = Vector3::new(0.3, -0.2, 0.1);
        let mut rays: Vec<Ray> =
            [-3.0, 1.0, 2.5].map(|d: f64| ray([0.0, (d / 6.0).atan(), 0.2], [d, 0.4 * d, 6.0], point)).to_vec();
        for (k, r) in rays.iter_mut().enumerate() {
            r.image[1] += 1e-3 * (k as f64 - 1.0);
            r.weight = 1.0 + k as f64;
        }
        let found = intersect(&rays).expect("three good rays");
        let cost =
            |p: Vector3<f64>| -> f64 { rays.iter().map(|r| r.weight * r.pose.misfit(&p, r.image).powi(2)).sum() };
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            for sign in [-1e-5, 1e-5] {
                let rise = cost(found.point + axis * sign) - cost(found.point);
                let expected = (axis.dot(&(found.cofactors.try_inverse().expect("regular") * axis))) * 1e-10;
                assert!(rise > 0.0 && (rise / expected - 1.0).abs() < 1e-2, "{rise} {expected}");
            }
        }
    }
}
