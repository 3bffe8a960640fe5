//! What a picture of a network is made of: the places of cameras and their photos, error ellipsoids, measured forms, a size to draw them at.

mod forms;

pub use forms::{Drawn, drawn};

use nalgebra::{Matrix3, Vector3};

use crate::project::{Camera, Parameter};
use crate::rotation::object_to_camera;

/// Projection centre, then the corners of the photo (top left, top right, bottom right, bottom left of the stored grid) at `depth` in
/// front of it, the object's unit; `None` without a principal distance.
pub fn frustum(camera: &Camera, position: [f64; 3], rotation: [f64; 3], depth: f64) -> Option<[[f64; 3]; 5]> {
    let get = |p: Parameter| camera.interior.get(p);
    let object_from_camera = object_to_camera(rotation).transpose();
    let centre = Vector3::from(position);
    // Directions in the camera frame: x right, y up, the object at negative z.
    let direction = |u: f64, v: f64| {
        if let Some(c) = get(Parameter::C) {
            let [x, y] = camera.photo_from_pixel([u, v]);
            return Some([(x - get(Parameter::X0)?) / c, (y - get(Parameter::Y0)?) / c]);
        }
        let (fx, fy) = (get(Parameter::Fx)?, get(Parameter::Fy)?);
        Some([(u - get(Parameter::Cx)?) / fx, (get(Parameter::Cy)? - v) / fy])
    };
    let corner = |u: f64, v: f64| {
        let [x, y] = direction(u, v)?;
        Some((centre + depth * (object_from_camera * Vector3::new(x, y, -1.0))).into())
    };
    let (w, h) = (f64::from(camera.width), f64::from(camera.height));
    Some([position, corner(0.0, 0.0)?, corner(w, 0.0)?, corner(w, h)?, corner(0.0, h)?])
}

/// Projection centre and corners of a photo of which only the viewing direction is known: upright, one third wider than high, at a field
/// of view of about 50 degrees. `None` where the direction has no length.
pub fn frustum_along(position: [f64; 3], direction: [f64; 3], depth: f64) -> Option<[[f64; 3]; 5]> {
    let ahead = Vector3::from(direction).try_normalize(1e-12)?;
    // Upright, but for photos that look along the vertical.
    let vertical = if ahead.z.abs() < 0.99 { Vector3::z() } else { Vector3::y() };
    let right = ahead.cross(&vertical).normalize();
    let up = right.cross(&ahead);
    let centre = Vector3::from(position);
    let corner = |x: f64, y: f64| (centre + depth * (ahead + 0.4 * x * right + 0.3 * y * up)).into();
    Some([position, corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)])
}

/// Columns L with LLᵀ = Σ: they transform the unit sphere to the error ellipsoid xᵀΣ⁻¹x = 1. Covariance as xx, xy, xz, yy, yz, zz;
/// what has no extent along an axis is flat there.
pub fn ellipsoid([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Matrix3<f64> {
    let root = |v: f64| v.max(0.0).sqrt();
    let over = |v: f64, by: f64| if by > 0.0 { v / by } else { 0.0 };
    let a = root(xx);
    let (b, c) = (over(xy, a), over(xz, a));
    let d = root(yy - b * b);
    let e = over(yz - b * c, d);
    let f = root(zz - c * c - e * e);
    Matrix3::new(a, 0.0, 0.0, b, d, 0.0, c, e, f)
}

/// Middle and diagonal of the box around some places; a diagonal of 0 is 1, so that it divides.
pub fn extent(places: impl Iterator<Item = [f64; 3]>) -> ([f64; 3], f64) {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for place in places {
        for k in 0..3 {
            low[k] = low[k].min(place[k]);
            high[k] = high[k].max(place[k]);
        }
    }
    if low[0] > high[0] {
        return ([0.0; 3], 1.0);
    }
    let diagonal = (0..3).map(|k| (high[k] - low[k]).powi(2)).sum::<f64>().sqrt();
    (std::array::from_fn(|k| (low[k] + high[k]) / 2.0), if diagonal > 0.0 { diagonal } else { 1.0 })
}

/// The exaggeration 1, 2 or 5 times a power of ten at which standard errors of this median are about a hundredth of the object.
pub fn exaggeration(sigmas: impl Iterator<Item = f64>, size: f64) -> f64 {
    let mut all: Vec<f64> = sigmas.filter(|s| *s > 0.0 && s.is_finite()).collect();
    if all.is_empty() {
        return 1.0;
    }
    all.sort_by(f64::total_cmp);
    round(0.01 * size / all[all.len() / 2])
}

/// The nearest 1, 2 or 5 times a power of ten below.
pub fn round(value: f64) -> f64 {
    if !(value > 0.0 && value.is_finite()) {
        return 1.0;
    }
    let power = 10.0_f64.powf(value.log10().floor());
    let digit = value / power;
    power
        * if digit >= 5.0 {
            5.0
        } else if digit >= 2.0 {
            2.0
        } else {
            1.0
        }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::pixel_from_camera_point;
    use crate::project::Interior;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn a_photo_stands_across_its_viewing_direction() {
        for direction in [[1.0, 2.0, -0.5], [0.0, 0.0, -3.0]] {
            let [centre, corners @ ..] = frustum_along([1.0, 2.0, 3.0], direction, 5.0).expect("a direction");
            let middle = corners.map(Vector3::from).iter().sum::<Vector3<f64>>() / 4.0 - Vector3::from(centre);
            let ahead = Vector3::from(direction).normalize();
            assert!((middle - 5.0 * ahead).norm() < 1e-12);
            let [top, side] = [1, 3].map(|k| Vector3::from(corners[k]) - Vector3::from(corners[0]));
            assert!(top.dot(&ahead).abs() < 1e-12 && side.dot(&ahead).abs() < 1e-12 && top.dot(&side).abs() < 1e-12);
        }
        assert_eq!(frustum_along([0.0; 3], [0.0; 3], 1.0), None);
    }

    #[test]
    fn corners_of_a_photo_are_seen_in_its_corners() {
        let mut brown = Camera::new("a", 400, 300, Interior::brown(12.0));
        brown.pixel_pitch = Some([0.02, 0.02]);
        brown.interior.set(Parameter::X0, 0.3);
        let opencv = Interior::Opencv {
            fx: Some(410.0),
            fy: Some(400.0),
            cx: 190.0,
            cy: 160.0,
            k1: 0.0,
            k2: 0.0,
            p1: 0.0,
            p2: 0.0,
            k3: 0.0,
        };
        for camera in [brown, Camera::new("b", 400, 300, opencv)] {
            let (position, rotation) = ([5.0, -3.0, 20.0], [0.3, -0.2, 1.0]);
            let [_, corners @ ..] = frustum(&camera, position, rotation, 2.5).expect("a principal distance");
            for (corner, [u, v]) in corners.iter().zip([[0.0, 0.0], [400.0, 0.0], [400.0, 300.0], [0.0, 300.0]]) {
                let x = object_to_camera(rotation) * (Vector3::from(*corner) - Vector3::from(position));
                let [a, b] = pixel_from_camera_point(&camera, x).expect("in front");
                assert!((a - u).abs() < 1e-9 && (b - v).abs() < 1e-9, "{a} {b} {u} {v}");
            }
        }
        assert!(frustum(&Camera::new("c", 4, 3, Interior::brown(1.0)), [0.0; 3], [0.0; 3], 1.0).is_some());
    }

    #[test]
    fn the_sphere_is_carried_onto_the_ellipsoid() {
        let m = Matrix3::new(4.0, 1.0, -0.5, 1.0, 3.0, 0.2, -0.5, 0.2, 0.7);
        let l = ellipsoid([4.0, 1.0, -0.5, 3.0, 0.2, 0.7]);
        assert!((l * l.transpose() - m).norm() < 1e-12);
        assert_eq!(ellipsoid([0.0; 6]), Matrix3::zeros());
        let flat = ellipsoid([0.0, 0.0, 0.0, 9.0, 0.0, 4.0]);
        assert_eq!((flat[(1, 1)], flat[(2, 2)], flat[(0, 0)]), (3.0, 2.0, 0.0));
    }

    #[test]
    fn exaggerations_are_round() {
        assert_eq!(exaggeration([0.01, 0.02, 0.03].into_iter(), 1000.0), 500.0);
        assert_eq!((round(0.3), round(7.0), round(f64::NAN)), (0.2, 5.0, 1.0));
        assert_eq!(extent([[0.0; 3], [2.0, 0.0, 0.0]].into_iter()), ([1.0, 0.0, 0.0], 2.0));
        assert_eq!(extent(std::iter::empty()), ([0.0; 3], 1.0));
    }
}
