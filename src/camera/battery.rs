//! Tests that every camera model must pass: a model is included by its row of [`CameraModel::ALL`] and a lens of [`lenses`].

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use crate::project::{CameraModel, Parameter};

/// A camera of every model, strongly distorted.
pub fn lenses() -> Vec<Camera> {
    let (fx, fy, cx, cy) = (Some(640.0), Some(643.0), 645.0, 352.0);
    let interiors = [
        Interior::Brown {
            c: Some(20.4558),
            x0: 0.1,
            y0: -0.05,
            k1: 2.829e-4,
            k2: -5.133e-7,
            k3: 6.211e-10,
            p1: 1e-5,
            p2: -2e-5,
            b1: 3e-4,
            b2: -1e-4,
        },
        Interior::Opencv { fx, fy, cx, cy, k1: -0.15, k2: 0.03, p1: 1e-3, p2: -5e-4, k3: -0.002 },
        Interior::OpencvRational {
            fx,
            fy,
            cx,
            cy,
            k1: 0.31,
            k2: 0.07,
            p1: 4e-4,
            p2: -3e-4,
            k3: 0.01,
            k4: 0.42,
            k5: 0.08,
            k6: 0.015,
        },
        Interior::OpencvFisheye {
            fx: Some(372.0),
            fy: Some(373.5),
            cx,
            cy,
            k1: -0.012,
            k2: 0.004,
            k3: -0.0011,
            k4: 0.00011,
        },
    ];
    let camera = |interior: Interior| {
        let mut camera = Camera::new(interior.model().name, 1280, 720, interior);
        camera.pixel_pitch = Some([0.009, 0.0091]);
        camera
    };
    interiors.into_iter().map(camera).collect()
}

/// Points in the camera frame that a camera images.
fn points(camera: &Camera) -> Vec<[f64; 3]> {
    let mut points = vec![[0.12, 0.08, -0.37], [-900.0, 500.0, -2800.0], [1e-9, -2e-9, -5.0], [0.0, 0.0, -3.0]];
    if camera.interior.model().is_wide {
        points.extend([[3.0, -1.0, -0.02], [3.0, 1.0, 0.0], [-2.0, 1.5, 0.6]]);
    }
    points
}

#[test]
fn every_model_has_a_lens_here_and_keeps_its_parameters() {
    let lenses = lenses();
    let names: Vec<&str> = lenses.iter().map(|camera| camera.interior.model().name).collect();
    assert_eq!(names, CameraModel::ALL.map(|model| model.name));
    for camera in lenses {
        let model = camera.interior.model();
        assert!(model.parameters.len() <= PARAMETERS && model.parameters.contains(&model.distance));
        let json = serde_json::to_value(camera.interior).unwrap();
        assert_eq!(json["model"], model.name);
        assert_eq!(serde_json::from_value::<Interior>(json.clone()).unwrap(), camera.interior);
        for &parameter in model.parameters {
            assert_eq!(parameter.name().parse::<Parameter>(), Ok(parameter));
            let value = camera.interior.get(parameter).expect("known");
            if parameter != Parameter::F {
                assert_eq!(json[parameter.name()], value, "{} {parameter}", model.name);
            }
            let mut moved = camera.interior;
            moved.set(parameter, value * 1.5);
            assert_eq!(moved.get(parameter), Some(value * 1.5));
            let others =
                model.parameters.iter().filter(|p| **p != parameter && moved.get(**p) != camera.interior.get(**p));
            let focal = matches!(parameter, Parameter::F | Parameter::Fx | Parameter::Fy);
            assert!(focal || others.count() == 0, "{} {parameter}", model.name);
        }
        let mut unknown = camera.clone();
        unknown.interior.forget_principal_distance();
        assert_eq!((unknown.principal_distance_px(), Model::new(&unknown.interior)), (None, None));
        let px = camera.principal_distance_px().unwrap();
        unknown.set_principal_distance_px(2.0 * px);
        assert!((unknown.principal_distance_px().unwrap() - 2.0 * px).abs() < 1e-9);
    }
}

#[test]
fn pixels_and_rays_are_inverses() {
    for camera in lenses() {
        let name = camera.interior.model().name;
        for pixel in [[3.0, 4.0], [700.2, 333.3], [1270.0, 700.0], [645.0, 352.0], [20.0, 700.0]] {
            let ray = ray_from_pixel(&camera, pixel).unwrap_or_else(|| panic!("{name} {pixel:?}"));
            for distance in [0.3, 7.0] {
                let back = pixel_from_camera_point(&camera, Vector3::from(ray) * distance).expect("imaged");
                assert!((back[0] - pixel[0]).hypot(back[1] - pixel[1]) < 1e-9, "{name} {pixel:?} became {back:?}");
            }
        }
        for p in points(&camera) {
            let pixel = pixel_from_camera_point(&camera, p.into()).unwrap_or_else(|| panic!("{name} {p:?}"));
            let ray = Vector3::from(ray_from_pixel(&camera, pixel).expect("a ray")).normalize();
            let angle = ray.cross(&Vector3::from(p).normalize()).norm();
            assert!(angle < 1e-12 && ray.dot(&Vector3::from(p)) > 0.0, "{name} {p:?}: {ray:?}");
            assert_eq!(ideal_from_pixel(&camera, pixel).is_some(), p[2] < -1e-12, "{name} {p:?}");
        }
    }
}

#[test]
fn residuals_are_projections_minus_measurements() {
    for camera in lenses() {
        let model = Model::new(&camera.interior).unwrap();
        for p in points(&camera) {
            let pixel = model.pixel(&camera, p).expect("imaged");
            let measured = measurement_from_pixel(&camera, [pixel[0] + 0.4, pixel[1] - 0.3]);
            let at = model.linearise(measured, p, ResidualPlace::Measured).expect("imaged");
            let [px, py] = camera.residual_pitch();
            let up = if camera.interior.model().in_photo_units { -1.0 } else { 1.0 };
            let found = [at.residual[0] / px, up * at.residual[1] / py];
            assert!((found[0] + 0.4).abs() < 1e-9 && (found[1] - 0.3).abs() < 1e-9, "{}: {found:?}", camera.id);
        }
    }
}

/// Central differences of five points against the analytic derivatives, by point and parameters, in both places of the residual.
#[test]
fn derivatives_agree_with_differences() {
    for camera in lenses() {
        let model = camera.interior.model();
        for place in [ResidualPlace::Measured, ResidualPlace::Corrected] {
            for p in points(&camera) {
                let pixel = pixel_from_camera_point(&camera, p.into()).expect("imaged");
                let measured = measurement_from_pixel(&camera, [pixel[0] + 3.0, pixel[1] - 2.0]);
                let linear = |interior: &Interior, p: [f64; 3]| {
                    Model::new(interior).unwrap().linearise(measured, p, place).expect("imaged")
                };
                let ours = linear(&camera.interior, p);
                let differences = |size: f64, at: &dyn Fn(f64) -> [f64; 2]| {
                    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| at(k * size));
                    [0, 1].map(|s| (a[s] - 8.0 * b[s] + 8.0 * c[s] - d[s]) / (12.0 * size))
                };
                let agree = |ours: [f64; 2], theirs: [f64; 2], what: &str| {
                    let scale = ours[0].hypot(ours[1]).max(theirs[0].hypot(theirs[1]));
                    let off = (ours[0] - theirs[0]).hypot(ours[1] - theirs[1]);
                    assert!(off <= 2e-7 * scale + 1e-9, "{} {place:?} {p:?} {what}: {ours:?} {theirs:?}", model.name);
                };
                let length = Vector3::from(p).norm();
                for axis in 0..3 {
                    let theirs = differences(1e-4 * length, &|step| {
                        let mut moved = p;
                        moved[axis] += step;
                        linear(&camera.interior, moved).residual
                    });
                    // per unit of direction
                    let [a, b] = [ours.by_point[0][axis] * length, ours.by_point[1][axis] * length];
                    agree([a, b], theirs.map(|d| d * length), &format!("point {axis}"));
                }
                for (k, &parameter) in model.parameters.iter().enumerate() {
                    let value = camera.interior.get(parameter).expect("known");
                    let size = 1e-4 * value.abs();
                    let theirs = differences(size, &|step| {
                        let mut moved = camera.interior;
                        moved.set(parameter, value + step);
                        linear(&moved, p).residual
                    });
                    // per change by the whole value
                    let [a, b] = [ours.by_parameter[0][k] * value, ours.by_parameter[1][k] * value];
                    agree([a, b], theirs.map(|d| d * value), parameter.name());
                }
                for k in model.parameters.len()..PARAMETERS {
                    assert_eq!([ours.by_parameter[0][k], ours.by_parameter[1][k]], [0.0; 2]);
                }
            }
        }
    }
}

#[test]
fn a_fisheye_images_what_is_beside_and_behind_it_and_nothing_beyond_its_fold() {
    let plain = |k1: f64| Fisheye { fx: 300.0, fy: 300.0, cx: 640.0, cy: 360.0, k1, ..Fisheye::default() };
    let at = |degrees: f64| [degrees.to_radians().sin(), 0.0, -degrees.to_radians().cos()];
    for degrees in [10.0, 89.9, 90.0, 95.0, 130.0, 179.0_f64] {
        let [u, v] = plain(0.0).project(at(degrees)).expect("imaged");
        assert!((u - 640.0 - 300.0 * degrees.to_radians()).abs() < 1e-9 && v == 360.0);
        let ray = plain(0.0).ray([u, v]).expect("a ray");
        assert!((Vector3::from(ray) - Vector3::from(at(degrees))).norm() < 1e-12);
    }
    assert_eq!(plain(0.0).project([0.0, 0.0, 1.0]), None);
    assert_eq!(plain(0.0).linearise([0.0; 2], [0.0, 0.0, 1.0]), None);
    assert_eq!(plain(0.0).linearise([0.0; 2], [0.0; 3]), None);
    assert_eq!(plain(0.0).ray([640.0 + 300.0 * 3.2, 360.0]), None);
    // θ (1 - 0.2 θ²) is largest, 0.8607, at θ = 1.291, 73.97 degrees
    let folded = plain(-0.2);
    assert!(folded.project(at(73.9)).is_some() && folded.project(at(74.1)).is_none());
    assert!(folded.project(at(150.0)).is_none());
    let [u, v] = folded.project(at(73.9)).unwrap();
    assert!((Vector3::from(folded.ray([u, v]).unwrap()) - Vector3::from(at(73.9))).norm() < 1e-9);
    assert_eq!(folded.ray([640.0 + 300.0 * 0.862, 360.0]), None);
}

#[test]
fn a_pole_of_the_rational_model_has_no_image_beyond_it() {
    let mut lens = Rational { fx: 900.0, fy: 900.0, cx: 640.0, cy: 360.0, k4: -0.5, ..Rational::default() };
    // the pole is at r² = 2
    assert!(lens.project([1.3, 0.0, -1.0]).is_some());
    assert_eq!(lens.project([1.5, 0.0, -1.0]), None);
    // r / (1 + r²) is largest at r = 1
    (lens.k4, lens.k1) = (1.0, 0.0);
    assert!(lens.project([0.99, 0.0, -1.0]).is_some() && lens.project([1.01, 0.0, -1.0]).is_none());
    assert!(lens.ideal([640.0 + 900.0 * 0.499, 360.0]).is_some());
    assert_eq!(lens.ideal([640.0 + 900.0 * 0.501, 360.0]), None);
}
