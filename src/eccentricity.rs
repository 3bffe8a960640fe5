//! Eccentricity: the centre of a circle's image is not the image of the circle's centre.
//!
//! A circle of centre P, normal n and radius r, seen from the projection centre, is met by the ray d where
//! |h d - (n·d) P|² = r² (n·d)², h = n·P. That is the cone d' Q d = 0 with
//!
//! Q = h² I - h (n P' + P n') + (|P|² - r²) n n',
//!
//! whose section with the image plane is the ellipse; its centre follows from the gradient, the image of P directly. The
//! difference of the two is the eccentricity: it grows with the square of the diameter and with the tilt.
//! The other way, an ellipse with the principal distance known leaves two circles of a given diameter: their normals lie in
//! the plane of the cone's longest and shortest axes (eigenvectors of Q), and the network, or a second photo, decides.

use nalgebra::{Matrix2, Matrix3, SymmetricEigen, Vector2, Vector3};

use crate::camera::{ideal_from_pixel, pixel_from_camera_point};
use crate::detect::conic;
use crate::detect::outline::Outline;
use crate::detection::Target;
use crate::project::Camera;

/// A circle in the camera frame, object units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TargetCircle {
    /// Centre; z < 0 lies in front of the camera.
    pub centre: Vector3<f64>,
    /// Unit normal; its sign does not matter.
    pub normal: Vector3<f64>,
    /// Diameter.
    pub diameter: f64,
}

/// Centre of the image ellipse minus image of the centre, in distortion-free coordinates divided by the principal distance
/// (x right, y up). `None` if the circle is not wholly in front of the camera or is seen edge-on.
pub fn ideal(circle: &TargetCircle) -> Option<[f64; 2]> {
    let centre = image_centre(circle)?;
    let p = circle.centre;
    let eccentricity = [centre[0] + p.x / p.z, centre[1] + p.y / p.z];
    eccentricity.iter().all(|e| e.is_finite()).then_some(eccentricity)
}

/// The same in pixels (u right, v down), with the camera's distortion: subtract it from a measured ellipse centre.
pub fn pixels(camera: &Camera, circle: &TargetCircle) -> Option<[f64; 2]> {
    if camera.interior.model().is_wide {
        return of_rim(camera, circle);
    }
    let centre = image_centre(circle)?;
    let [u, v] = pixel_from_camera_point(camera, Vector3::new(centre[0], centre[1], -1.0))?;
    let [u0, v0] = pixel_from_camera_point(camera, circle.centre)?;
    Some([u - u0, v - v0])
}

/// The same from the ellipse through the image of the rim: a wide camera has no image plane that all rays meet.
fn of_rim(camera: &Camera, circle: &TargetCircle) -> Option<[f64; 2]> {
    let n = circle.normal.try_normalize(0.0)?;
    let [u0, v0] = pixel_from_camera_point(camera, circle.centre)?;
    // Seen edge-on there is no ellipse.
    if !(n.dot(&circle.centre).abs() > 1e-3 * circle.centre.norm() && circle.diameter >= 0.0) {
        return None;
    }
    let across = if n.x.abs() < 0.8 { Vector3::x() } else { Vector3::y() };
    let e1 = n.cross(&across).normalize();
    let e2 = n.cross(&e1);
    let mut rim = Vec::with_capacity(24);
    for k in 0..24 {
        let (s, c) = (f64::from(k) * std::f64::consts::TAU / 24.0).sin_cos();
        let [u, v] = pixel_from_camera_point(camera, circle.centre + (e1 * c + e2 * s) * (circle.diameter / 2.0))?;
        rim.push([u - u0, v - v0, 1.0]);
    }
    let ellipse = conic::fit(&rim)?;
    let eccentricity = [ellipse.u, ellipse.v];
    eccentricity.iter().all(|e| e.is_finite()).then_some(eccentricity)
}

/// Centre of the image ellipse as the ray (x, y, -1).
fn image_centre(circle: &TargetCircle) -> Option<[f64; 2]> {
    let (p, n) = (circle.centre, circle.normal.try_normalize(0.0)?);
    let r = circle.diameter / 2.0;
    // the nearest and farthest point of the rim in depth
    let depth = r * (1.0 - n.z * n.z).max(0.0).sqrt();
    if !(p.z + depth < 0.0 && r >= 0.0) {
        return None;
    }
    let h = n.dot(&p);
    let q = Matrix3::identity() * (h * h) - (n * p.transpose() + p * n.transpose()) * h
        + n * n.transpose() * (p.norm_squared() - r * r);
    let det = q[(0, 0)] * q[(1, 1)] - q[(0, 1)] * q[(0, 1)];
    // seen edge-on there is no ellipse; Q is of the square of a length
    if det <= 1e-14 * p.norm_squared().powi(2) {
        return None;
    }
    Some([(q[(1, 1)] * q[(0, 2)] - q[(0, 1)] * q[(1, 2)]) / det, (q[(0, 0)] * q[(1, 2)] - q[(0, 1)] * q[(0, 2)]) / det])
}

/// The two circles of a diameter that a measured ellipse can be the image of, in the camera frame; for an upright view
/// they are one. `None` if the camera has no principal distance or the target is no ellipse.
pub fn circles(camera: &Camera, target: &Target, diameter: f64) -> Option<[TargetCircle; 2]> {
    if !(diameter > 0.0 && diameter.is_finite()) {
        return None;
    }
    let q = cone(camera, target)?;
    let eigen = SymmetricEigen::try_new(q, 1e-15, 200)?;
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
    let [l1, l2, l3] = order.map(|i| eigen.eigenvalues[i]);
    let [e1, e3]: [Vector3<f64>; 2] = [order[0], order[2]].map(|i| eigen.eigenvectors.column(i).into());
    if !(l2 > 0.0 && l3 < 0.0) {
        return None;
    }
    let (along, across) = (((l1 - l2) / (l1 - l3)).max(0.0).sqrt(), ((l2 - l3) / (l1 - l3)).max(0.0).sqrt());
    let circle = |sign: f64| {
        let normal = e1 * (sign * along) + e3 * across;
        // the ray of the centre is the pole of the plane's vanishing line
        let ray = q.try_inverse()? * normal;
        let ray = ray / -ray.z;
        // with the true scale the ray's form is -(r n·ray)², and that of the middle axis (distance n·ray)² = l2
        let squared = -ray.dot(&(q * ray)) / l2;
        let distance = diameter / 2.0 / squared.sqrt();
        let found = TargetCircle { centre: ray * distance, normal, diameter };
        (squared > 0.0 && distance.is_finite()).then_some(found)
    };
    Some([circle(1.0)?, circle(-1.0)?])
}

/// The cone of rays (x, y, -1) through the rim of a measured ellipse, freed of distortion.
fn cone(camera: &Camera, target: &Target) -> Option<Matrix3<f64>> {
    let outline = Outline::from_axes(target.u, target.v, target.major / 2.0, target.minor / 2.0, target.angle);
    let mut points = Vec::with_capacity(24);
    for k in 0..24 {
        let (s, c) = (f64::from(k) * std::f64::consts::TAU / 24.0).sin_cos();
        let rim = outline.rim(c, s);
        let [x, y] = ideal_from_pixel(camera, [rim.x, rim.y])?;
        points.push([x, y, 1.0]);
    }
    let ellipse = conic::fit(&points)?;
    let axes = Matrix2::new(ellipse.p, ellipse.r, ellipse.r, ellipse.q).try_inverse()?;
    let (form, centre) = (axes * axes, Vector2::new(ellipse.u, ellipse.v));
    let linear = form * centre;
    let constant = centre.dot(&linear) - 1.0;
    Some(Matrix3::new(
        form[(0, 0)],
        form[(0, 1)],
        linear.x,
        form[(0, 1)],
        form[(1, 1)],
        linear.y,
        linear.x,
        linear.y,
        constant,
    ))
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::project::Interior;

    fn tilted() -> TargetCircle {
        TargetCircle {
            centre: Vector3::new(120.0, -80.0, -900.0),
            normal: Vector3::new(0.5, 0.3, 0.8).normalize(),
            diameter: 60.0,
        }
    }

    /// Rim points of the circle as rays (x, y, -1).
    fn image(circle: &TargetCircle) -> Vec<[f64; 3]> {
        let e1 = circle.normal.cross(&Vector3::x()).normalize();
        let e2 = circle.normal.cross(&e1);
        (0..36)
            .map(|k| {
                let (s, c) = (f64::from(k) * 0.1745).sin_cos();
                let p = circle.centre + (e1 * c + e2 * s) * (circle.diameter / 2.0);
                [-p.x / p.z, -p.y / p.z, 1.0]
            })
            .collect()
    }

    fn camera() -> Camera {
        let (x0, y0, k1, k2, k3, p1, p2, b1, b2) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        Camera::new("c", 4000, 3000, Interior::Brown { c: Some(3000.0), x0, y0, k1, k2, k3, p1, p2, b1, b2 })
    }

    #[test]
    fn the_unit_of_length_does_not_matter() {
        let circle =
            TargetCircle { centre: Vector3::new(0.3, -0.2, -1.5), normal: Vector3::new(0.7, 0.1, 0.6), diameter: 0.02 };
        let expected = ideal(&circle).expect("seen");
        for unit in [1e-3, 1e3, 1e6] {
            let scaled = TargetCircle { centre: circle.centre * unit, diameter: circle.diameter * unit, ..circle };
            let got = ideal(&scaled).expect("seen");
            assert!((0..2).all(|k| (got[k] - expected[k]).abs() < 1e-12), "{unit}: {got:?} {expected:?}");
        }
    }

    #[test]
    fn the_centre_is_that_of_the_projected_rim() {
        let circle = tilted();
        let ellipse = conic::fit(&image(&circle)).unwrap();
        let [ex, ey] = ideal(&circle).unwrap();
        assert!((ellipse.u + circle.centre.x / circle.centre.z - ex).abs() < 1e-9);
        assert!((ellipse.v + circle.centre.y / circle.centre.z - ey).abs() < 1e-9);
        assert!(ex.hypot(ey) > 1e-5);
    }

    #[test]
    fn it_vanishes_in_the_upright_view_and_grows_with_the_square_of_the_diameter() {
        let upright = TargetCircle { normal: Vector3::z(), ..tilted() };
        assert!(ideal(&upright).unwrap().iter().all(|e| e.abs() < 1e-12));
        let [small, large] = [10.0, 20.0].map(|diameter| ideal(&TargetCircle { diameter, ..tilted() }).unwrap()[0]);
        assert!((large / small - 4.0).abs() < 1e-2);
    }

    #[test]
    fn a_circle_comes_back_from_its_ellipse() {
        let (circle, camera) = (tilted(), camera());
        let pixels: Vec<[f64; 3]> = image(&circle)
            .iter()
            .map(|ray| {
                let [u, v] = pixel_from_camera_point(&camera, Vector3::new(ray[0], ray[1], -1.0)).unwrap();
                [u, v, 1.0]
            })
            .collect();
        let ellipse = conic::fit(&pixels).unwrap();
        let (a, b, angle) = ellipse.axes();
        let target = Target {
            u: ellipse.u,
            v: ellipse.v,
            major: 2.0 * a,
            minor: 2.0 * b,
            angle,
            ..crate::matching::target(0.0, 0.0, None)
        };
        let found = circles(&camera, &target, 60.0).unwrap();
        let near = found.iter().map(|c| (c.centre - circle.centre).norm()).fold(f64::INFINITY, f64::min);
        assert!(near < 0.01, "{found:?}");
        let aligned = found.iter().map(|c| c.normal.dot(&circle.normal).abs()).fold(0.0, f64::max);
        assert!(aligned > 1.0 - 1e-6, "{found:?}");
        let [eu, ev] = super::pixels(&camera, &circle).unwrap();
        let [x, y] = ideal(&circle).unwrap();
        assert!((eu - 3000.0 * x).abs() < 1e-6 && (ev + 3000.0 * y).abs() < 1e-6);
    }

    #[test]
    fn a_circle_behind_the_camera_or_edge_on_has_none() {
        let behind = TargetCircle { centre: Vector3::new(0.0, 0.0, 10.0), ..tilted() };
        assert_eq!(ideal(&behind), None);
        let edge_on = TargetCircle { centre: Vector3::new(0.0, 0.0, -900.0), normal: Vector3::x(), diameter: 10.0 };
        assert_eq!(ideal(&edge_on), None);
    }
}
