//! Bare dots in oriented photos, and what matching makes of them.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Instant;

use nalgebra::{Matrix3, Vector3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use sightline::camera::pixel_from_camera_point;
use sightline::detection::{Polarity, Quality, Target};
use sightline::initial::Pose;
use sightline::matching::{MatchOptions, PhotoTargets, match_uncoded};
use sightline::project::{Camera, Interior, Observation, Photo, Point, Project, Sigma};
use sightline::rotation;

use super::network::{both, gauss, unit};

const SIZE: [u32; 2] = [6000, 4000];
const NOISE_PX: f64 = 0.05;

/// Result of matching in a scene.
#[derive(Debug)]
pub struct Matched {
    pub seconds: f64,
    /// Points that three photos or more show, and those of them that got a name.
    pub wanted: usize,
    pub found: usize,
    /// Names that mix points.
    pub wrong: usize,
}

/// A bare target at a place.
pub fn target(u: f64, v: f64) -> Target {
    Target {
        id: 0,
        u,
        v,
        sigma_u: NOISE_PX,
        sigma_v: NOISE_PX,
        covariance_uv: 0.0,
        major: 14.0,
        minor: 11.0,
        angle: 0.3,
        contrast: 90.0,
        polarity: Polarity::Bright,
        code: None,
        code_family: None,
        code_candidates: Vec::new(),
        inner: None,
        occluded: false,
        quality: Quality::default(),
    }
}

/// `dots` on a wavy surface in `photos` photos on a ring above it; one in twenty is not seen. 40 points are named.
pub fn matched(seed: u64, photos: usize, dots: usize, tolerance_px: Option<f64>) -> Matched {
    let mut g = ChaCha8Rng::seed_from_u64(seed);
    let camera = Camera::new("k", SIZE[0], SIZE[1], Interior::brown(1.1 * f64::from(SIZE[0])));
    let mut project = Project { cameras: vec![camera.clone()], ..Project::default() };
    let mut targets = Vec::new();
    let mut truth: BTreeMap<(usize, u64), usize> = BTreeMap::new();
    let places: Vec<Vector3<f64>> = (0..dots + 40)
        .map(|_| {
            let (x, y) = (both(&mut g), 0.7 * both(&mut g));
            Vector3::new(x, y, 0.15 * (3.0 * x).sin() * (4.0 * y).cos())
        })
        .collect();
    for (n, xyz) in places.iter().enumerate().take(40) {
        project.points.push(Point { id: format!("n{n}"), xyz: Some((*xyz).into()), ..Point::default() });
    }
    let mut rays = vec![0; places.len()];
    for k in 0..photos {
        let turn = std::f64::consts::TAU * (k as f64 + 0.3 * both(&mut g)) / photos as f64;
        let zenith = 0.3 + 0.35 * unit(&mut g);
        let z = Vector3::new(zenith.sin() * turn.cos(), zenith.sin() * turn.sin(), zenith.cos());
        let x = Vector3::z().cross(&z).normalize();
        let level = Matrix3::from_rows(&[x.transpose(), z.cross(&x).transpose(), z.transpose()]);
        let m = rotation::object_to_camera([0.0, 0.0, 1.57 * (k % 4) as f64]) * level;
        let pose = Pose { object_to_camera: m, centre: z * (3.4 + 0.3 * unit(&mut g)) };
        let id = format!("f{k}");
        let mut seen = Vec::new();
        for (n, xyz) in places.iter().enumerate() {
            let Some([u, v]) = pixel_from_camera_point(&camera, pose.to_camera(xyz)) else { continue };
            let (u, v) = (u + NOISE_PX * gauss(&mut g), v + NOISE_PX * gauss(&mut g));
            let inside = u > 0.0 && v > 0.0 && u < f64::from(SIZE[0]) && v < f64::from(SIZE[1]);
            if !inside || unit(&mut g) < 0.05 {
                continue;
            }
            seen.push(target(u, v));
            if n < 40 {
                let (photo, point, sigma) = (id.clone(), format!("n{n}"), Sigma::One(NOISE_PX));
                project.observations.push(Observation { photo, point, u, v, sigma, enabled: true, target: None });
            } else {
                rays[n] += 1;
                truth.insert((k, u.to_bits()), n);
            }
        }
        targets.push(PhotoTargets { photo: id.clone(), targets: seen });
        let (position, rotation) = (Some(pose.centre.into()), Some(rotation::angles(&m)));
        project.photos.push(Photo { id, camera: "k".into(), position, rotation, enabled: true, ..Photo::default() });
    }
    let began = Instant::now();
    let options = MatchOptions { tolerance_px, ..MatchOptions::default() };
    let matching = match_uncoded(&project, &targets, &options).expect("a valid project");
    let seconds = began.elapsed().as_secs_f64();
    let mut of_point: BTreeMap<&str, BTreeSet<Option<&usize>>> = BTreeMap::new();
    for o in &matching.observations {
        let photo: usize = o.photo[1..].parse().expect("a number");
        of_point.entry(&o.point).or_default().insert(truth.get(&(photo, o.u.to_bits())));
    }
    let new: Vec<_> = matching.points.iter().map(|p| &of_point[p.id.as_str()]).collect();
    let pure: BTreeSet<usize> =
        new.iter().filter(|o| o.len() == 1).filter_map(|o| o.first().copied().flatten().copied()).collect();
    let wrong = new.iter().filter(|o| o.len() != 1 || o.contains(&None)).count();
    let wanted: BTreeSet<usize> = (40..places.len()).filter(|&n| rays[n] >= 3).collect();
    Matched { seconds, wanted: wanted.len(), found: wanted.intersection(&pure).count(), wrong }
}
