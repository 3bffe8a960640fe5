use super::*;
use crate::foreign::{CameraOptions, outgoing};
use crate::lens::term::*;
use crate::opencv::MODELS;
use crate::reason::ExchangeReason;
use sightline::project::Interior;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

fn brown() -> Camera {
    let interior = Interior::Brown {
        c: Some(24.3),
        x0: 0.11,
        y0: -0.07,
        k1: 1.4e-4,
        k2: -2.1e-7,
        k3: 1e-10,
        p1: 1.1e-5,
        p2: -2.3e-5,
        b1: 0.0,
        b2: 0.0,
    };
    Camera { pixel_pitch: Some([0.0078, 0.0078]), ..Camera::new("a", 3000, 2000, interior) }
}

#[test]
fn a_lens_is_fitted_to_a_correction_and_back() {
    let camera = brown();
    let out = outgoing(&camera, &MODELS, &Lens::default(), &CameraOptions::default()).unwrap();
    let conversion = out.conversion.unwrap();
    assert!(conversion.max_px < WARNING_PX && conversion.rms_px <= conversion.max_px, "{conversion:?}");
    // The stated difference is the one of independent points.
    for pixel in [[0.0, 0.0], [2999.0, 3.0], [1500.5, 1000.0], [400.0, 1900.0]] {
        let [a, b] = direction_of(&camera, pixel).unwrap();
        let [u, v] = out.lens.project([a, b]).unwrap();
        assert!((u - pixel[0]).hypot(v - pixel[1]) <= conversion.max_px * 1.001, "{pixel:?}: {u} {v}");
    }
}

/// The covariance of the fitted parameters gives images the variances that fits to moved cameras give them.
#[test]
fn the_covariance_is_that_of_fits_to_moved_cameras() {
    let camera = brown();
    let names = ["c", "x0", "k1", "p1"];
    let sigma = [0.002, 0.003, 2e-7, 3e-7];
    let matrix: Vec<Vec<f64>> =
        (0..4).map(|i| (0..4).map(|k| sigma[i] * sigma[k] * if i == k { 1.0 } else { 0.3 }).collect()).collect();
    let covariance = Covariance { parameters: names.map(str::to_owned).to_vec(), matrix };
    let options = CameraOptions { covariance: Some(covariance), ..CameraOptions::default() };
    let shapes = [MODELS[1]];
    let out = outgoing(&camera, &shapes, &Lens::default(), &options).unwrap();
    let carried = out.covariance.unwrap();
    assert_eq!(carried.parameters, ["fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"]);
    // Derivatives by fits: one parameter moved by a tenth of its sigma at a time.
    let moved = |k: usize, sign: f64| {
        let mut camera = camera.clone();
        let parameter: Parameter = names[k].parse().unwrap();
        let value = camera.interior.get(parameter).unwrap();
        camera.interior.set(parameter, value + sign * 0.1 * sigma[k]);
        outgoing(&camera, &shapes, &Lens::default(), &CameraOptions::default()).unwrap().values
    };
    let g: Vec<Vec<f64>> = (0..4)
        .map(|k| moved(k, 1.0).iter().zip(moved(k, -1.0)).map(|(a, b)| (a - b) / (0.2 * sigma[k])).collect())
        .collect();
    // k1, k2 and k3 are strongly correlated, which magnifies what the first order leaves out; images of points do not.
    let project = |values: &[f64], direction| shapes[0].lens(&Lens::default(), values).project(direction).unwrap();
    for direction in [[0.3, -0.2], [-0.45, 0.3], [0.1, 0.31], [0.02, -0.05]] {
        let by = |i: usize| {
            let step = 1e-6 * out.values[i].abs().max(1e-2);
            let moved = |sign: f64| {
                let mut values = out.values.clone();
                values[i] += sign * step;
                project(&values, direction)
            };
            let (more, less) = (moved(1.0), moved(-1.0));
            [0, 1].map(|axis| (more[axis] - less[axis]) / (2.0 * step))
        };
        let by: Vec<[f64; 2]> = (0..9).map(by).collect();
        for axis in [0, 1] {
            let (mut ours, mut expected) = (0.0, 0.0);
            for i in 0..9 {
                for k in 0..9 {
                    ours += by[i][axis] * by[k][axis] * carried.matrix[i][k];
                }
            }
            for j in 0..4 {
                for k in 0..4 {
                    let along = |k: usize| (0..9).map(|i| by[i][axis] * g[k][i]).sum::<f64>();
                    expected += along(j) * along(k) * sigma[j] * sigma[k] * if j == k { 1.0 } else { 0.3 };
                }
            }
            assert!((ours / expected - 1.0).abs() < 0.01, "{direction:?}: {ours} {expected} px²");
        }
    }
}

#[test]
fn an_exact_conversion_keeps_the_covariance() {
    let interior = Interior::Opencv {
        fx: Some(900.0),
        fy: Some(905.0),
        cx: 645.0,
        cy: 352.0,
        k1: -0.25,
        k2: 0.08,
        p1: 1e-3,
        p2: -5e-4,
        k3: 0.0,
    };
    let camera = Camera::new("a", 1280, 720, interior);
    let matrix = vec![vec![4.0, 0.5, 0.0], vec![0.5, 1.0, 1e-4], vec![0.0, 1e-4, 1e-6]];
    let covariance = Covariance { parameters: vec!["f".into(), "cx".into(), "k1".into()], matrix };
    let options = CameraOptions { covariance: Some(covariance), ..CameraOptions::default() };
    let out = outgoing(&camera, &[MODELS[0]], &Lens::default(), &options).unwrap();
    assert_eq!(out.conversion, None);
    let carried = out.covariance.unwrap();
    let ratio = 905.0 / 900.0;
    for (i, k, expected) in [
        (0, 0, 4.0),
        (1, 1, 4.0 * ratio * ratio),
        (0, 1, 4.0 * ratio),
        (2, 2, 1.0),
        (0, 2, 0.5),
        (4, 4, 1e-6),
        (2, 4, 1e-4),
    ] {
        assert!((carried.matrix[i][k] - expected).abs() < 1e-6 * expected, "{i} {k}: {}", carried.matrix[i][k]);
    }
}

#[test]
fn what_cannot_be_met_is_refused_and_regions_are_checked() {
    // A tilted sensor with a strong prism term: no model of the engine has it.
    let mut lens = Lens::default();
    for (k, value) in [(FX, 900.0), (FY, 905.0), (CX, 645.0), (CY, 352.0), (TX, 0.02), (TY, -0.025), (S1, 0.02)] {
        lens.terms[k] = value;
    }
    let foreign = crate::foreign::ForeignCamera::new("a", [1280, 720], MODELS[4], lens);
    let error = crate::foreign::settled(&foreign, None, false).unwrap_err();
    assert!(matches!(ExchangeReason::of_error(&error), Some(ExchangeReason::ConversionTooLarge { .. })), "{error}");
    let settled = crate::foreign::settled(&foreign, None, true).unwrap();
    assert!(settled.conversion.unwrap().max_px > LARGEST_PX);
    // Around the principal point the terms that are missing are below 0.04 px (r² s1 fx, the turn τx τy / 2 of the picture).
    let part = [[620.0, 340.0], [670.0, 340.0], [670.0, 365.0], [620.0, 365.0]];
    let settled = crate::foreign::settled(&foreign, Some(&part), false).unwrap();
    assert!(settled.conversion.unwrap().max_px < WARNING_PX);
    for region in [
        vec![],
        vec![[0.0, 0.0]; 4],
        vec![[0.0, 0.0], [1.0, 1.0], [f64::NAN, 0.0]],
        vec![[0.0, 0.0], [5.0, 0.0], [9.0, 0.0]],
    ] {
        assert!(check_region(&region).is_err(), "{region:?}");
    }
}
