#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use crate::scene::{Face, Patch};
use sightline::detection::Channel;
use sightline::project::{Interior, Parameter};
use sightline::ring_code::Design;

fn camera() -> Camera {
    let mut interior = Interior::brown(4.0);
    let distortion = [
        (Parameter::X0, 0.02),
        (Parameter::Y0, -0.01),
        (Parameter::K1, 2e-3),
        (Parameter::P1, 1e-4),
        (Parameter::P2, -1e-4),
    ];
    distortion.into_iter().for_each(|(parameter, value)| interior.set(parameter, value));
    Camera { pixel_pitch: Some([0.01, 0.01]), ..Camera::new("1", 240, 160, interior) }
}

/// A camera 1000 units above the origin looking down.
fn pose() -> Pose {
    Pose { centre: Vector3::new(0.0, 0.0, 1000.0), ..Pose::identity() }
}

fn disc(centre: [f64; 3]) -> Disc {
    Disc {
        id: "1".into(),
        centre,
        normal: [0.3, -0.1, 1.0],
        diameter: 40.0,
        ring: None,
        grey: 0.9,
        patch: Some(Patch { ratio: 3.0, grey: 0.2 }),
    }
}

fn clean() -> Exposure {
    Exposure { vignetting: 0.0, read_noise: 0.0, shot_noise: 0.0, bits: 16, ..Exposure::default() }
}

fn samples(picture: Grey) -> Vec<f64> {
    match picture.samples {
        Samples::U8(s) => s.into_iter().map(f64::from).collect(),
        Samples::U16(s) => s.into_iter().map(f64::from).collect(),
    }
}

#[test]
fn a_target_lies_where_its_circle_projects() {
    let scene = Scene { discs: vec![disc([120.0, 80.0, 30.0])], background: 0.2, ..Scene::default() };
    let image = samples(render(&camera(), &pose(), &scene, &clean(), 0).unwrap());
    // Grey-weighted centroid against the centroid of a dense filling of the circle in object space.
    let mut sums = [0.0; 3];
    for (i, grey) in image.iter().enumerate() {
        // 0.2 is a whole level, so that rounding adds nothing to the ground.
        let weight = grey - 0.2 * 65535.0;
        sums[0] += weight;
        sums[1] += weight * ((i % 240) as f64 + 0.5);
        sums[2] += weight * ((i / 240) as f64 + 0.5);
    }
    let camera = camera();
    let pose = pose();
    let plane = Plane::new(&camera, &pose, &scene.discs[0]);
    let mut expected = [0.0; 3];
    for i in 0..400 * 400 {
        let (x, y) = ((i % 400) as f64 / 10.0 - 19.95, (i / 400) as f64 / 10.0 - 19.95);
        if x * x + y * y > 400.0 {
            continue;
        }
        let [u, v] = plane.image([x, y]).unwrap();
        // Area of the cell in the picture.
        let ([u1, v1], [u2, v2]) = (plane.image([x + 0.1, y]).unwrap(), plane.image([x, y + 0.1]).unwrap());
        let area = ((u1 - u) * (v2 - v) - (u2 - u) * (v1 - v)).abs();
        expected[0] += area;
        expected[1] += area * u;
        expected[2] += area * v;
    }
    let [area, u, v] = [sums[0] / (0.7 * 65535.0), sums[1] / sums[0], sums[2] / sums[0]];
    let [area_0, u_0, v_0] = [expected[0], expected[1] / expected[0], expected[2] / expected[0]];
    assert!((area / area_0 - 1.0).abs() < 2e-3, "{area} {area_0}");
    assert!((u - u_0).abs() < 2e-3 && (v - v_0).abs() < 2e-3, "{u} {v}, {u_0} {v_0}");
}

#[test]
fn what_is_turned_away_or_hidden_is_not_drawn() {
    let background = |scene: &Scene| samples(render(&camera(), &pose(), scene, &clean(), 0).unwrap());
    let mut away = disc([0.0; 3]);
    away.normal = [0.0, 0.0, -1.0];
    assert!(
        background(&Scene { discs: vec![away], background: 0.2, ..Scene::default() }).iter().all(|g| *g == 13107.0)
    );
    let wall = Face {
        corner: [-500.0, -500.0, 100.0],
        along: [1000.0, 0.0, 0.0],
        across: [0.0, 1000.0, 0.0],
        grey: 0.2,
        texture: 0.0,
        grain: 1.0,
    };
    let hidden = Scene { discs: vec![disc([0.0; 3])], faces: vec![wall], background: 0.2 };
    assert!(background(&hidden).iter().all(|g| (*g - 13107.0).abs() <= 1.0));
}

#[test]
fn ring_sectors_have_the_area_and_the_place_of_their_bits() {
    let mut coded = disc([0.0; 3]);
    coded.normal = [0.0, 0.0, 1.0];
    coded.patch = Some(Patch { ratio: 4.0, grey: 0.1 });
    coded.ring = Some(Ring { sectors: 4, code: 0b1000, design: Design::Schneider });
    let mut camera = camera();
    camera.interior = Interior::brown(4.0);
    let scene = |discs| Scene { discs, background: 0.1, ..Scene::default() };
    let with = samples(render(&camera, &pose(), &scene(vec![coded.clone()]), &clean(), 0).unwrap());
    coded.ring = None;
    let without = samples(render(&camera, &pose(), &scene(vec![coded]), &clean(), 0).unwrap());
    let difference: Vec<_> = with.iter().zip(&without).map(|(a, b)| (a - b) / (0.8 * 65535.0)).collect();
    // 0.4 pixels a unit: quarter of a ring from radius 16 to 24.
    let area: f64 = difference.iter().sum();
    assert!((area - TAU / 8.0 * (24.0f64.powi(2) - 16.0f64.powi(2))).abs() < 0.05, "{area}");
    // All of it in one quarter of the picture around the centre.
    let mut quarters = [0.0; 4];
    for (i, d) in difference.iter().enumerate() {
        quarters[usize::from(i % 240 >= 120) + 2 * usize::from(i / 240 >= 80)] += d;
    }
    assert!(quarters.iter().filter(|q| **q > 0.4 * area).count() <= 2);
    assert!((quarters.iter().sum::<f64>() - area).abs() < 1e-9);
}

#[test]
fn bits_run_clockwise_as_seen() {
    let count = |code: u32| sectors(Ring { sectors: 8, code, design: Design::Schneider }).collect::<Vec<_>>();
    assert_eq!(count(0b1000_0001), [[0.0, 0.125], [0.875, 1.0]]);
    // In the picture a growing turn goes from right to down when a1 points right.
    let (camera, pose, disc) = (camera(), pose(), Disc { normal: [0.0, 0.0, 1.0], ..disc([0.0; 3]) });
    let plane = Plane::new(&camera, &pose, &disc);
    let at = |turn: f64| plane.image([15.0 * (TAU * turn).cos(), -15.0 * (TAU * turn).sin()]).unwrap();
    let centre = plane.image([0.0, 0.0]).unwrap();
    let (p, q) = (at(0.1), at(0.2));
    let turned = (p[0] - centre[0]) * (q[1] - centre[1]) - (p[1] - centre[1]) * (q[0] - centre[0]);
    assert!(turned > 0.0, "clockwise where v points down");
}

#[test]
fn noise_has_its_size_and_its_seed() {
    let scene = Scene { background: 0.5, ..Scene::default() };
    let exposure = Exposure { vignetting: 0.0, read_noise: 0.01, shot_noise: 0.02, ..Exposure::default() };
    let draw = |stream| samples(render(&camera(), &pose(), &scene, &exposure, stream).unwrap());
    let a = draw(0);
    let mean = a.iter().sum::<f64>() / a.len() as f64;
    let variance = a.iter().map(|g| (g - mean).powi(2)).sum::<f64>() / a.len() as f64;
    let expected = 255.0f64.powi(2) * (1e-4 + 4e-4 * 0.5) + 1.0 / 12.0;
    assert!((mean - 127.5).abs() < 0.1 && (variance / expected - 1.0).abs() < 0.03, "{mean} {variance} {expected}");
    assert_eq!(a, draw(0));
    assert_ne!(a, draw(1));
}

#[test]
fn files_hold_what_was_rendered() {
    let scene = Scene { discs: vec![disc([0.0; 3])], background: 0.1, ..Scene::default() };
    for bits in [8, 16] {
        let picture = render(&camera(), &pose(), &scene, &Exposure { bits, ..Exposure::default() }, 0).unwrap();
        assert_eq!(sightline::decode::grey(&png(&picture, None).unwrap(), Channel::Grey).unwrap(), picture);
    }
}

#[test]
fn impossible_exposures_and_cameras_are_refused() {
    let scene = Scene::default();
    let bad = |exposure| render(&camera(), &pose(), &scene, &exposure, 0).expect_err("refused").code();
    assert_eq!(bad(Exposure { psf: 0.0, ..Exposure::default() }), "invalid");
    assert_eq!(bad(Exposure { bits: 12, ..Exposure::default() }), "invalid");
    let interior: Interior = serde_json::from_str(r#"{ "model": "brown", "c": null }"#).unwrap();
    let blind = Camera { interior, ..camera() };
    assert_eq!(render(&blind, &pose(), &scene, &clean(), 0).expect_err("no c").code(), "missing_initial_values");
}
