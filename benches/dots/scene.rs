//! Bare dots in oriented photos, and what matching makes of them.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use sightline::camera::pixel_from_camera_point;
use sightline::detection::{Polarity, Quality, Target};
use sightline::initial::Pose;
use sightline::matching::{MatchOptions, PhotoTargets, match_uncoded};
use sightline::project::{Camera, Interior, Observation, Photo, Point, Project, Sigma};
use sightline::rotation;

const SIZE: [u32; 2] = [6000, 4000];
const NOISE_PX: f64 = 0.05;
/// Points that have their names already.
const NAMED: usize = 40;

/// Oriented photos of dots, and which dot each target is.
pub struct Scene {
    project: Project,
    targets: Vec<PhotoTargets>,
    truth: BTreeMap<(usize, u64), usize>,
    /// How many photos show each dot; none where it has its name.
    rays: Vec<usize>,
}

/// What matching made of a scene.
#[derive(Debug)]
pub struct Matched {
    /// Points that three photos or more show, and those of them that got a name.
    pub wanted: usize,
    pub found: usize,
    /// Names that mix points.
    pub wrong: usize,
}

fn unit(g: &mut ChaCha8Rng) -> f64 {
    (g.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

fn both(g: &mut ChaCha8Rng) -> f64 {
    2.0 * unit(g) - 1.0
}

fn gauss(g: &mut ChaCha8Rng) -> f64 {
    (-2.0 * (1.0 - unit(g)).ln()).sqrt() * (TAU * unit(g)).cos()
}

fn target(u: f64, v: f64) -> Target {
    Target {
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
        quality: Quality::default(),
    }
}

/// `dots` on a wavy surface in `photos` photos on a ring above it; one in twenty is not seen. The first [`NAMED`] are named.
pub fn scene(seed: u64, photos: usize, dots: usize) -> Scene {
    let mut g = ChaCha8Rng::seed_from_u64(seed);
    let camera = Camera::new("k", SIZE[0], SIZE[1], Interior::brown(1.1 * f64::from(SIZE[0])));
    let mut project = Project { cameras: vec![camera.clone()], ..Project::default() };
    let mut targets = Vec::new();
    let mut truth: BTreeMap<(usize, u64), usize> = BTreeMap::new();
    let places: Vec<Vector3<f64>> = (0..dots + NAMED)
        .map(|_| {
            let (x, y) = (both(&mut g), 0.7 * both(&mut g));
            Vector3::new(x, y, 0.15 * (3.0 * x).sin() * (4.0 * y).cos())
        })
        .collect();
    for (n, xyz) in places.iter().enumerate().take(NAMED) {
        project.points.push(Point { id: format!("n{n}"), xyz: Some((*xyz).into()), ..Point::default() });
    }
    let mut rays = vec![0; places.len()];
    for k in 0..photos {
        let turn = TAU * (k as f64 + 0.3 * both(&mut g)) / photos as f64;
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
            if n < NAMED {
                let (photo, point, sigma) = (id.clone(), format!("n{n}"), Sigma::One(NOISE_PX));
                project.observations.push(Observation { photo, point, u, v, sigma, enabled: true });
            } else {
                rays[n] += 1;
                truth.insert((k, u.to_bits()), n);
            }
        }
        targets.push(PhotoTargets { photo: id.clone(), targets: seen });
        let (position, rotation) = (Some(pose.centre.into()), Some(rotation::angles(&m)));
        project.photos.push(Photo { id, camera: "k".into(), position, rotation, enabled: true, ..Photo::default() });
    }
    Scene { project, targets, truth, rays }
}

/// Matches a scene and compares with the truth.
pub fn matched(scene: &Scene, tolerance_px: Option<f64>) -> Matched {
    let Scene { project, targets, truth, rays } = scene;
    let options = MatchOptions { tolerance_px, ..MatchOptions::default() };
    let matching = match_uncoded(project, targets, &options).expect("a valid project");
    let mut of_point: BTreeMap<&str, BTreeSet<Option<&usize>>> = BTreeMap::new();
    for o in &matching.observations {
        let photo: usize = o.photo[1..].parse().expect("a number");
        of_point.entry(&o.point).or_default().insert(truth.get(&(photo, o.u.to_bits())));
    }
    let new: Vec<_> = matching.points.iter().map(|p| &of_point[p.id.as_str()]).collect();
    let pure: BTreeSet<usize> =
        new.iter().filter(|o| o.len() == 1).filter_map(|o| o.first().copied().flatten().copied()).collect();
    let wrong = new.iter().filter(|o| o.len() != 1 || o.contains(&None)).count();
    let wanted: BTreeSet<usize> = (NAMED..rays.len()).filter(|&n| rays[n] >= 3).collect();
    Matched { wanted: wanted.len(), found: wanted.intersection(&pure).count(), wrong }
}
