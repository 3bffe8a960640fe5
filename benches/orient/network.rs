//! Seeded networks of seven kinds with a truth, and what is measured of `adjust(orient(p))` on them.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use sightline::adjust::{adjust, apply};
use sightline::adjustment::{AdjustOptions, StatisticsChoice, Termination};
use sightline::camera::pixel_from_camera_point;
use sightline::initial::Pose;
use sightline::initial::similarity::fit;
use sightline::orient::{Note, Oriented};
use sightline::project::{Camera, Interior, Observation, Parameter, Photo, Point, Project, Sigma};
use sightline::rotation;

pub const KINDS: [&str; 7] = ["plate", "relief", "box", "ring", "dome", "strip", "corridor"];
const WIDTH: u32 = 3000;
const HEIGHT: u32 = 2000;
const NOISE_PX: f64 = 0.1;

/// Given information about the principal distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Distance {
    Unknown,
    Within30,
    Within5,
}

/// Parameters of one network.
#[derive(Clone, Debug)]
pub struct Case {
    pub seed: u64,
    pub kind: usize,
    pub photos: usize,
    pub distance: Distance,
    pub wrong: f64,
    /// Points and rays a point, where they are not left to chance.
    pub size: Option<[f64; 2]>,
}

impl Case {
    /// 60 photos with 300 points, seen in 6, 15 or 40 photos: kinds and knowledge of c in turns, every other clean.
    pub fn large(seed: u64) -> Self {
        let k = seed as usize;
        let distance = [Distance::Unknown, Distance::Within30, Distance::Within5][k % 3];
        let size = Some([300.0, [6.0, 15.0, 40.0][k / 7 % 3]]);
        Self { seed, kind: k % 7, photos: 60, distance, wrong: [0.0, 0.02][k % 2], size }
    }

    /// The case of a number: kinds, knowledge of c and shares of wrong identities in turns, sizes at random.
    pub fn of(seed: u64, most_photos: usize) -> Self {
        let mut g = ChaCha8Rng::seed_from_u64(seed ^ 0x5eed);
        let k = seed as usize;
        // Small networks are the difficult ones and the frequent ones.
        let share = unit(&mut g).powi(2);
        let photos = 4 + ((most_photos - 4) as f64 * share).round() as usize;
        let distance = [Distance::Unknown, Distance::Within30, Distance::Within5][k / 7 % 3];
        // All around an object it takes more photos until neighbours overlap.
        let fewest = [4, 4, 8, 12, 8, 4, 5][k % 7];
        let photos = photos.max(fewest);
        Self { seed, kind: k % 7, photos, distance, wrong: [0.0, 0.02, 0.05, 0.1][k / 21 % 4], size: None }
    }
}

/// A network: the truth, what orientation is given of it, and which observations have a wrong name.
pub struct Network {
    pub truth: Project,
    pub given: Project,
    pub wrong: BTreeSet<usize>,
}

pub fn unit(g: &mut ChaCha8Rng) -> f64 {
    (g.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

pub fn both(g: &mut ChaCha8Rng) -> f64 {
    2.0 * unit(g) - 1.0
}

pub fn gauss(g: &mut ChaCha8Rng) -> f64 {
    (-2.0 * (1.0 - unit(g)).ln()).sqrt() * (TAU * unit(g)).cos()
}

/// A surface point with its outward normal; none faces every camera.
type Surface = (Vector3<f64>, Option<Vector3<f64>>);

fn surface(kind: usize, photos: usize, g: &mut ChaCha8Rng) -> Surface {
    let length = photos as f64;
    match KINDS[kind] {
        "plate" => (Vector3::new(both(g), 0.75 * both(g), 0.0), None),
        "relief" => (Vector3::new(both(g), 0.75 * both(g), 0.12 * both(g)), None),
        "box" => {
            let (a, b) = (both(g), both(g));
            match (5.0 * unit(g)) as usize {
                0 => (Vector3::new(a, b, 1.0), Some(Vector3::z())),
                1 => (Vector3::new(1.0, a, b), Some(Vector3::x())),
                2 => (Vector3::new(-1.0, a, b), Some(-Vector3::x())),
                3 => (Vector3::new(a, 1.0, b), Some(Vector3::y())),
                _ => (Vector3::new(a, -1.0, b), Some(-Vector3::y())),
            }
        }
        "ring" => {
            let azimuth = TAU * unit(g);
            let n = Vector3::new(azimuth.cos(), azimuth.sin(), 0.0);
            (n * (1.0 + 0.05 * both(g)) + Vector3::z() * both(g), Some(n))
        }
        "dome" => {
            let (azimuth, height) = (TAU * unit(g), unit(g));
            let flat = (1.0 - height * height).sqrt();
            let n = Vector3::new(flat * azimuth.cos(), flat * azimuth.sin(), height);
            (n, Some(n))
        }
        "strip" => (Vector3::new((unit(g) * (0.45 * length + 1.0)) - 0.5, 0.8 * both(g), 0.15 * both(g)), None),
        // Two walls and a floor.
        _ => {
            let along = 3.0 + unit(g) * (0.5 * length + 2.5);
            match (3.0 * unit(g)) as usize {
                0 => (Vector3::new(along, 1.2, 1.2 * both(g)), None),
                1 => (Vector3::new(along, -1.2, 1.2 * both(g)), None),
                _ => (Vector3::new(along, 1.2 * both(g), -1.2), None),
            }
        }
    }
}

/// Looking from `centre` to `aim`, with a roll.
fn looking(centre: Vector3<f64>, aim: Vector3<f64>, roll: f64) -> Pose {
    let z = (centre - aim).normalize();
    let up = if z.x.hypot(z.y) > 1e-3 { Vector3::z() } else { Vector3::y() };
    let x = up.cross(&z).normalize();
    let upright = Matrix3::from_rows(&[x.transpose(), z.cross(&x).transpose(), z.transpose()]);
    Pose { object_to_camera: rotation::object_to_camera([0.0, 0.0, roll]) * upright, centre }
}

/// Station `k`; `reach` is the distance at which an object of size 1 fills the photo.
fn station(case: &Case, k: usize, reach: f64, g: &mut ChaCha8Rng) -> Pose {
    let turn = TAU * (k as f64 + 0.3 * both(g)) / case.photos as f64;
    let jitter = Vector3::new(0.1 * both(g), 0.1 * both(g), 0.1 * both(g));
    let quarter = TAU / 4.0 * (k % 4) as f64 + 0.1 * both(g);
    match KINDS[case.kind] {
        "plate" | "relief" => {
            let zenith = 0.35 + 0.4 * unit(g);
            let d = Vector3::new(zenith.sin() * turn.cos(), zenith.sin() * turn.sin(), zenith.cos());
            looking(d * reach * (1.15 + 0.2 * unit(g)), jitter, quarter)
        }
        "box" | "dome" => {
            let zenith = 0.3 + 0.85 * unit(g);
            let d = Vector3::new(zenith.sin() * turn.cos(), zenith.sin() * turn.sin(), zenith.cos());
            looking(d * reach * (1.6 + 0.3 * unit(g)), jitter + Vector3::z() * 0.3, quarter)
        }
        "ring" => {
            let d = Vector3::new(turn.cos(), turn.sin(), 0.25 * both(g));
            looking(d * (reach * 1.35 + 0.6), jitter, TAU / 4.0 * (k % 2) as f64 + 0.1 * both(g))
        }
        "strip" => {
            let centre = Vector3::new(0.45 * k as f64, 0.15 * both(g), reach * (0.95 + 0.1 * unit(g)));
            let tilt = Vector3::new(0.25 * both(g), 0.25 * both(g), 0.0);
            looking(centre, Vector3::new(centre.x, 0.0, 0.0) + tilt, TAU / 4.0 * (k % 2) as f64 + 0.1 * both(g))
        }
        _ => {
            let centre = Vector3::new(0.5 * k as f64, 0.5 * both(g), 0.3 * both(g));
            let aim = centre + Vector3::new(3.0, 0.9 * both(g), 0.5 * both(g));
            looking(centre, aim, TAU / 4.0 * (k % 2) as f64 + 0.1 * both(g))
        }
    }
}

/// Builds the network of a case.
pub fn network(case: &Case) -> Network {
    let mut g = ChaCha8Rng::seed_from_u64(case.seed);
    let c = f64::from(WIDTH) * (0.75 + 0.75 * unit(&mut g));
    let free = vec![Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1];
    let mut camera = Camera { free, ..Camera::new("k", WIDTH, HEIGHT, Interior::brown(c)) };
    // Up to 30 px in the corner of the photo.
    if let Interior::Brown { k1, x0, y0, .. } = &mut camera.interior {
        (*k1, *x0, *y0) = (5e-9 * both(&mut g), 15.0 * both(&mut g), 15.0 * both(&mut g));
    }
    let mut truth = Project { cameras: vec![camera.clone()], ..Project::default() };
    let reach = c / (0.5 * f64::from(HEIGHT)) * if KINDS[case.kind] == "strip" { 0.8 } else { 1.0 };
    let stations: Vec<Pose> = (0..case.photos).map(|k| station(case, k, reach, &mut g)).collect();
    // From 2.6 rays a point upwards.
    let rays_wanted = 2.6 + 5.0 * unit(&mut g).powi(2);
    let points = ((14.0 + 25.0 * unit(&mut g)) * case.photos as f64 / rays_wanted.min(6.0)).round() as usize + 12;
    let points = points.min(300.max(case.photos * 8));
    let [points, rays_wanted] = case.size.map_or([points as f64, rays_wanted], |size| size);
    let points = points as usize;
    let noise = |g: &mut ChaCha8Rng| NOISE_PX * gauss(g);
    let mut seen: Vec<(usize, usize, [f64; 2])> = Vec::new();
    for n in 0..points {
        let (xyz, normal) = surface(case.kind, case.photos, &mut g);
        truth.points.push(Point { id: format!("p{n}"), xyz: Some(xyz.into()), ..Point::default() });
        for (k, pose) in stations.iter().enumerate() {
            let towards = (pose.centre - xyz).normalize();
            let far = (pose.centre - xyz).norm() > 9.0 && KINDS[case.kind] == "corridor";
            if far || normal.is_some_and(|n| n.dot(&towards) < 0.35) {
                continue;
            }
            let Some([u, v]) = pixel_from_camera_point(&camera, pose.to_camera(&xyz)) else { continue };
            let (u, v) = (u + noise(&mut g), v + noise(&mut g));
            if u > 0.0 && v > 0.0 && u < f64::from(WIDTH) && v < f64::from(HEIGHT) {
                seen.push((k, n, [u, v]));
            }
        }
    }
    // Thinned to the rays a point that are wanted.
    let keep = rays_wanted * points as f64 / seen.len().max(1) as f64;
    seen.retain(|_| unit(&mut g) < keep);
    seen.sort_by_key(|(k, n, _)| (*k, *n));
    for (k, pose) in stations.iter().enumerate() {
        let (position, rotation) = (Some(pose.centre.into()), Some(rotation::angles(&pose.object_to_camera)));
        let id = format!("f{k}");
        truth.photos.push(Photo { id, camera: "k".into(), position, rotation, enabled: true, ..Photo::default() });
    }
    for (k, n, [u, v]) in &seen {
        let (photo, point, sigma) = (format!("f{k}"), format!("p{n}"), Sigma::One(NOISE_PX));
        truth.observations.push(Observation { photo, point, u: *u, v: *v, sigma, enabled: true, target: None });
    }
    // A point that nobody measured is no part of a network.
    let drop_unmeasured = |truth: &mut Project| {
        let measured: BTreeSet<String> = truth.observations.iter().map(|o| o.point.clone()).collect();
        truth.points.retain(|p| measured.contains(&p.id));
    };
    drop_unmeasured(&mut truth);
    let wrong = misnamed(&mut truth, case.wrong, &mut g);
    drop_unmeasured(&mut truth);
    let given = bare(&truth, case, &mut g);
    Network { truth, given, wrong }
}

/// Gives a share of the observations another name: swaps within a photo and names of points that the photo lacks.
fn misnamed(project: &mut Project, share: f64, g: &mut ChaCha8Rng) -> BTreeSet<usize> {
    let mut wrong = BTreeSet::new();
    let n = project.observations.len();
    let wanted = (share * n as f64).round() as usize;
    for _ in 0..20 * wanted {
        if wrong.len() >= wanted {
            break;
        }
        let a = (unit(g) * n as f64) as usize;
        let b = (unit(g) * n as f64) as usize;
        if wrong.contains(&a) || wrong.contains(&b) || a == b {
            continue;
        }
        let (first, second) = (project.observations[a].clone(), project.observations[b].clone());
        if first.photo == second.photo {
            project.observations[a].point.clone_from(&second.point);
            project.observations[b].point.clone_from(&first.point);
            wrong.extend([a, b]);
        } else if unit(g) < 0.1
            && !project.observations.iter().any(|o| o.photo == first.photo && o.point == second.point)
        {
            project.observations[a].point = second.point;
            wrong.insert(a);
        }
    }
    wrong
}

fn bare(truth: &Project, case: &Case, g: &mut ChaCha8Rng) -> Project {
    let mut project = truth.clone();
    let spread = both(g);
    for camera in &mut project.cameras {
        if let Interior::Brown { c, x0, y0, k1, .. } = &mut camera.interior {
            *c = match case.distance {
                Distance::Unknown => None,
                Distance::Within30 => c.map(|c| c * (1.0 + 0.3 * spread)),
                Distance::Within5 => c.map(|c| c * (1.0 + 0.05 * spread)),
            };
            (*x0, *y0, *k1) = (0.0, 0.0, 0.0);
        }
    }
    project.photos.iter_mut().for_each(|p| (p.position, p.rotation) = (None, None));
    project.points.iter_mut().for_each(|p| p.xyz = None);
    project
}

/// Result for a network.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    /// An adjustment from the truth without the wrong observations solves it.
    pub solvable: bool,
    /// All photos oriented, and right after the adjustment.
    pub right: bool,
    /// Photos without orientation.
    pub missing: usize,
    /// Photos in a wrong pose that no note names, by how many degrees and hundredths of their distance.
    pub wrong: Vec<(String, [f64; 2])>,
    /// c is more than 10 % off, and no note says so.
    pub silent_c: bool,
    /// Right observations called wrong.
    pub falsely_wrong: usize,
    /// Why the adjustment did not come to an end.
    pub failure: Option<String>,
}

fn lean() -> AdjustOptions {
    AdjustOptions { statistics: StatisticsChoice::None, ..AdjustOptions::default() }
}

/// Adjusts; the project with the result where it converged.
fn adjusted(project: &Project) -> Result<Project, String> {
    let adjustment = adjust(project, &lean(), &mut |_| true).map_err(|e| format!("{}: {e}", e.code()))?;
    match adjustment.termination {
        Termination::Converged => Ok(apply(project, &adjustment)),
        other => Err(format!("{other:?}")),
    }
}

/// The truth adjusted without what is wrong and what is seen once, where that comes to an end, and whether it solves the network:
/// all photos have measurements, and it ends near the truth. What a weak network's noise makes of it is no orientation's fault.
fn reference(network: &Network) -> (Option<Project>, bool) {
    let mut project = network.truth.clone();
    for &k in &network.wrong {
        project.observations[k].enabled = false;
    }
    let mut rays: BTreeMap<String, usize> = BTreeMap::new();
    project.observations.iter().filter(|o| o.enabled).for_each(|o| *rays.entry(o.point.clone()).or_default() += 1);
    project.observations.iter_mut().for_each(|o| o.enabled &= rays.get(&o.point).is_some_and(|n| *n > 1));
    let Ok(solved) = adjusted(&project) else { return (None, false) };
    let near = wrong_photos(&solved, &network.truth).is_some_and(|off| off.is_empty());
    let c = |p: &Project| p.cameras[0].interior.get(Parameter::C).unwrap_or(0.0);
    let measured = |photo: &Photo| project.observations.iter().any(|o| o.enabled && o.photo == photo.id);
    let whole = solved.photos.iter().all(measured);
    let solvable = whole && near && (c(&solved) / c(&network.truth) - 1.0).abs() < 0.03;
    (Some(solved), solvable)
}

/// Photos that are turned by more than half a degree or shifted by more than 2 % of their distance, after the best
/// similarity that the photos and points allow: by how many degrees and hundredths.
fn wrong_photos(project: &Project, truth: &Project) -> Option<BTreeMap<String, [f64; 2]>> {
    let points = project.points.iter().zip(&truth.points).filter_map(|(p, t)| p.xyz.zip(t.xyz));
    let photos = project.photos.iter().zip(&truth.photos).filter_map(|(p, t)| p.position.zip(t.position));
    let (source, target): (Vec<Vector3<f64>>, Vec<Vector3<f64>>) =
        points.chain(photos).map(|(a, b)| (Vector3::from(a), Vector3::from(b))).unzip();
    let (found, _) = sightline::initial::similarity::fit_robust(&source, &target, 0)
        .or_else(|_| fit(&source, &target).map(|f| (f, Vec::new())))
        .ok()?;
    let mut wrong = BTreeMap::new();
    for (p, t) in project.photos.iter().zip(&truth.photos) {
        let (Some(own), Some(real)) = (Pose::of_photo(p), Pose::of_photo(t)) else { continue };
        let carried = found.transform.pose(&own);
        let turned = (carried.object_to_camera * real.object_to_camera.transpose()).trace();
        let angle = ((turned - 1.0) / 2.0).clamp(-1.0, 1.0).acos();
        let near: Vec<f64> = truth
            .observations
            .iter()
            .filter(|o| o.photo == t.id)
            .filter_map(|o| truth.points.iter().find(|p| p.id == o.point)?.xyz)
            .map(|xyz| (Vector3::from(xyz) - real.centre).norm())
            .collect();
        let distance = near.iter().sum::<f64>() / near.len().max(1) as f64;
        let shift = (carried.centre - real.centre).norm() / distance;
        if !(angle < 0.5_f64.to_radians() && shift < 0.02) {
            wrong.insert(p.id.clone(), [angle.to_degrees(), 100.0 * shift]);
        }
    }
    Some(wrong)
}

/// Judges an orientation.
pub fn judged(network: &Network, oriented: &Oriented) -> Verdict {
    let mut verdict = Verdict::default();
    let (reference, solvable) = reference(network);
    verdict.solvable = solvable;
    let unoriented = |p: &&Photo| p.position.is_none() || p.rotation.is_none();
    verdict.missing = oriented.project.photos.iter().filter(unoriented).count();
    let result = adjusted(&oriented.project);
    verdict.failure = result.as_ref().err().cloned();
    let solved = result.unwrap_or_else(|_| oriented.project.clone());
    let wrong = wrong_photos(&solved, reference.as_ref().unwrap_or(&network.truth)).unwrap_or_default();
    let named: BTreeSet<&str> = oriented.notes.iter().filter_map(noted_photo).collect();
    // A note about the camera says that every pose depends on it.
    let weak = oriented.notes.iter().any(says_weak);
    verdict.wrong = wrong
        .iter()
        .filter(|(id, _)| !weak && !named.contains(id.as_str()))
        .map(|(id, off)| (id.clone(), *off))
        .collect();
    let c = |p: &Project| p.cameras[0].interior.get(Parameter::C).unwrap_or(0.0);
    verdict.silent_c = verdict.missing < solved.photos.len()
        && (c(&solved) / c(&network.truth) - 1.0).abs() > 0.1
        && !oriented.notes.iter().any(says_c);
    verdict.right = verdict.missing == 0 && wrong.is_empty() && verdict.failure.is_none();
    let called: BTreeSet<(&str, &str)> = oriented.notes.iter().filter_map(called_wrong).collect();
    let good = network.truth.observations.iter().enumerate().filter(|(k, _)| !network.wrong.contains(k));
    verdict.falsely_wrong = good.filter(|(_, o)| called.contains(&(o.photo.as_str(), o.point.as_str()))).count();
    verdict
}

fn noted_photo(note: &Note) -> Option<&str> {
    match note {
        Note::PhotoNotOriented { photo, .. } => Some(photo),
        _ => None,
    }
}

fn says_weak(note: &Note) -> bool {
    matches!(note, Note::PrincipalDistanceWeak { .. })
}

/// An assumed value is always noted; what counts is a note on its reliability.
fn says_c(note: &Note) -> bool {
    matches!(note, Note::PrincipalDistanceWeak { .. } | Note::PrincipalDistanceChanged { .. })
}

fn called_wrong(note: &Note) -> Option<(&str, &str)> {
    match note {
        Note::MeasurementDisagrees { photo, point, .. } => Some((photo, point)),
        _ => None,
    }
}
