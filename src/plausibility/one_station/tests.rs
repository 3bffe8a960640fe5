//! Random cameras that turn, and cameras that move.

use super::*;
use crate::camera::pixel_from_camera_point;
use crate::noise::Noise;
use crate::project::Interior;
use crate::project::{Observation, Photo, Point, Sigma};
use crate::rotation::object_to_camera;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

const SIGMA: f64 = 0.05;

/// A room of points about the origin seen by photos from near the origin of a frame 10 away, each moved by its `base`; the lens bends, and the
/// document knows of it what `free` says: nothing, a principal distance a tenth off, all of it.
fn scene(seed: u64, bases: &[f64], flat: bool, known: usize, wrong: usize) -> Project {
    let mut noise = Noise::new(seed, 2);
    let c = 3000.0 * (1.0 + 0.15 * noise.normal().clamp(-2.0, 2.0));
    let mut camera = Camera::new("k", 4000, 3000, Interior::brown(c));
    camera.interior.set(Parameter::K1, 3e-9 * noise.normal().clamp(-2.0, 2.0));
    camera.interior.set(Parameter::X0, 8.0 * noise.normal());
    let mut project = Project { cameras: vec![camera.clone()], ..Project::default() };
    let points: Vec<Vector3<f64>> = (0..40)
        .map(|_| {
            Vector3::new(2.5 * noise.normal(), 2.0 * noise.normal(), if flat { 0.0 } else { 1.5 * noise.normal() })
        })
        .collect();
    project.points = (0..points.len()).map(|k| Point { id: k.to_string(), ..Point::default() }).collect();
    for (k, base) in bases.iter().enumerate() {
        let id = format!("f{k}");
        let angles = [0.12, 0.12, 0.8].map(|size| size * noise.normal());
        let aside = Vector3::new(noise.normal(), noise.normal(), 0.3 * noise.normal()).normalize();
        let pose = Pose { object_to_camera: object_to_camera(angles), centre: Vector3::z() * 10.0 + aside * *base };
        for (point, xyz) in points.iter().enumerate() {
            let Some([u, v]) = pixel_from_camera_point(&camera, pose.to_camera(xyz)) else { continue };
            if (0.0..4000.0).contains(&u) && (0.0..3000.0).contains(&v) {
                let mut off = || SIGMA * noise.normal();
                let (u, v) = (u + off(), v + off());
                let far = if point < wrong && k == 1 { 300.0 } else { 0.0 };
                let (photo, point, sigma) = (id.clone(), point.to_string(), Sigma::One(SIGMA));
                project.observations.push(Observation {
                    photo,
                    point,
                    u: u + far,
                    v,
                    sigma,
                    enabled: true,
                    target: None,
                });
            }
        }
        project.photos.push(Photo { id, camera: "k".into(), enabled: true, ..Photo::default() });
    }
    let camera = &mut project.cameras[0];
    if known < 2 {
        // What is held at 0 is not 0.
        camera.free = vec![Parameter::C];
        camera.interior.set(Parameter::K1, 0.0);
        camera.interior.set(Parameter::X0, 0.0);
        camera.interior.set(Parameter::C, 1.1 * c);
    }
    if let (0, Interior::Brown { c, .. }) = (known, &mut camera.interior) {
        *c = None;
    }
    project
}

#[test]
fn cameras_that_only_turn_are_found_whatever_is_known_of_their_lens() {
    for seed in 0..60 {
        let photos = 2 + (seed % 3) as usize;
        let project = scene(seed, &vec![0.0; photos], seed % 4 == 0, (seed % 3) as usize, (seed % 2) as usize);
        let found = is_all(&project).unwrap_or_else(|| panic!("seed {seed}"));
        assert_eq!((found.photos.len(), found.all), (photos, true));
    }
}

#[test]
fn a_base_is_seen_also_before_a_plane() {
    for seed in 0..120 {
        let base = [0.1, 0.3, 1.0, 3.0][(seed % 4) as usize];
        let project = scene(seed, &[0.0, base, 2.0 * base], seed % 2 == 0, (seed % 3) as usize, (seed % 2) as usize);
        assert_eq!(is_all(&project), None, "seed {seed}, base {base}");
    }
}

#[test]
fn two_of_four_photos_are_told_once() {
    for seed in 0..30 {
        let mut project = scene(seed, &[1.0, 0.0, 0.0, 2.0], false, 2, 0);
        assert_eq!((is_all(&project), groups(&project)), (None, Vec::new()), "nothing is oriented");
        for (k, photo) in project.photos.iter_mut().enumerate() {
            (photo.position, photo.rotation) = (Some([[1.0, 0.0, 0.01, 2.0][k], 0.0, 10.0]), Some([0.0; 3]));
        }
        project.points.iter_mut().for_each(|p| p.xyz = Some([0.0; 3]));
        let photos = vec!["f1".to_owned(), "f2".to_owned()];
        assert_eq!(groups(&project), [OneStation { photos, all: false }], "seed {seed}");
    }
}
