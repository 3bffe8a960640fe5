//! Tests with photos of another size, cropped photos, and photos of another lens.

use super::*;
use crate::camera::pixel_from_camera_point;
use crate::noise::Noise;
use crate::project::Interior;
use crate::rotation::object_to_camera;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

/// Points before a camera, and where its picture has them.
fn shot(seed: u64, count: usize, c: f64) -> (Vec<Vector3<f64>>, Vec<[f64; 2]>) {
    let mut noise = Noise::new(seed, 3);
    let camera = Camera::new("k", 4000, 3000, Interior::brown(c));
    let angles = [0.3, 0.3, 1.5].map(|size| size * noise.normal());
    let m = object_to_camera(angles);
    let pose = Pose { object_to_camera: m, centre: m.tr_mul(&Vector3::z()) * 12.0 };
    let (mut object, mut pixels) = (Vec::new(), Vec::new());
    while object.len() < count {
        let xyz = Vector3::new(2.2 * noise.normal(), 2.2 * noise.normal(), 1.5 * noise.normal());
        let Some([u, v]) = pixel_from_camera_point(&camera, pose.to_camera(&xyz)) else { continue };
        if (0.0..4000.0).contains(&u) && (0.0..3000.0).contains(&v) {
            object.push(xyz);
            pixels.push([u + 0.1 * noise.normal(), v + 0.1 * noise.normal()]);
        }
    }
    (object, pixels)
}

#[test]
fn what_was_done_to_a_photo_is_found_and_nothing_is_found_in_others() {
    let camera = Camera::new("k", 4000, 3000, Interior::brown(4000.0));
    let judged = |object: Vec<Vector3<f64>>, pixels: Vec<[f64; 2]>| {
        misframed(&PhotoPoints { object, pixels, camera: &camera, limit_px: 1.5 })
    };
    for seed in 0..4 {
        let count = 12 + (seed % 2) as usize * 6;
        let (object, pixels) = shot(seed, count, 4000.0);
        assert_eq!(judged(object.clone(), pixels.clone()), None, "seed {seed}");
        // Names at random.
        let turned: Vec<[f64; 2]> = (0..count).map(|k| pixels[(k * 5 + 3) % count]).collect();
        assert_eq!(judged(object.clone(), turned), None, "seed {seed}");
        let factor = [0.5, 0.25, 0.75, 1.5][(seed % 4) as usize];
        match judged(object.clone(), pixels.iter().map(|p| p.map(|x| x * factor)).collect()) {
            Some(Framing::Resized { factor: found }) => {
                assert!((found / factor - 1.0).abs() < 0.01, "seed {seed}: {found}")
            }
            other => panic!("seed {seed}, resized {factor}: {other:?}"),
        }
        let by = [700.0, [300.0, -400.0][(seed % 2) as usize]];
        match judged(object.clone(), pixels.iter().map(|p| [p[0] - by[0], p[1] - by[1]]).collect()) {
            Some(Framing::Cropped { offset }) => {
                assert!((offset[0] - by[0]).hypot(offset[1] - by[1]) < 40.0, "seed {seed}: {offset:?}");
            }
            other => panic!("seed {seed}, cropped: {other:?}"),
        }
        let c = [2400.0, 6000.0, 3200.0][(seed % 3) as usize];
        let (object, pixels) = shot(seed + 100, count, c);
        match judged(object, pixels) {
            Some(Framing::OtherDistance { px }) => assert!((px / c - 1.0).abs() < 0.02, "seed {seed}: {px}"),
            other => panic!("seed {seed}, at {c}: {other:?}"),
        }
    }
}
