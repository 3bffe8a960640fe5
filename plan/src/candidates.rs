//! Where photos could be taken: directions around the object, distances at which all or parts of it fill the picture, what is aimed at.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Matrix3, Vector3};

use sightline::project::{PlanStation, Point};

use super::parts::parts;
use super::setup::{Setup, Shot, fill_distance, principal_distance_px};

/// Mean of the normals' directions above which an object is seen from one side.
const ONE_SIDED: f64 = 0.35;
/// Angles to the side that the object faces, degrees, with so many directions around each.
const FANS: [(f64, usize); 4] = [(0.0, 1), (22.0, 6), (42.0, 8), (58.0, 8)];
/// Elevations, degrees, with so many directions around each, of an object that is seen from all sides.
const LEVELS: [(f64, usize); 4] = [(2.0, 12), (28.0, 12), (55.0, 8), (88.0, 1)];
/// Distances as shares of that at which the object fills the picture.
const SHARES: [f64; 4] = [1.0, 0.72, 0.52, 1.4];
/// How far behind the middle photos stand that look at the opposite wall, as shares of the object's radius.
const INSIDE: [f64; 4] = [0.0, 0.25, 0.5, 0.7];
/// Points that a photo of a plan from nothing has to see; four known ones orient a photo more.
pub const LEAST_SEEN: usize = 6;
pub const LEAST_KNOWN: usize = 4;
/// How far they spread across the direction in which they spread most, as a share of the picture's smaller half: a row of points does
/// not orient a photo.
const LEAST_SPREAD: f64 = 0.05;

/// The object as photos are planned around it.
pub struct Frame {
    pub centre: Vector3<f64>,
    pub radius: f64,
    /// The side it faces; none: all sides.
    pub faces: Option<Vector3<f64>>,
    /// Whether its targets face its middle, as in a room or a tank.
    pub inward: bool,
}

impl Frame {
    pub fn of(setup: &Setup<'_>) -> Self {
        let places = &setup.places;
        let centre = places.iter().sum::<Vector3<f64>>() / places.len().max(1) as f64;
        let radius = places.iter().map(|p| (p - centre).norm()).fold(1e-9, f64::max);
        let normals: Vec<Vector3<f64>> =
            setup.plan.points.iter().filter_map(|p| p.normal.map(|n| Vector3::from(n).normalize())).collect();
        let mean = normals.iter().sum::<Vector3<f64>>() / normals.len().max(1) as f64;
        let faces = if normals.is_empty() {
            Self::flat_side(setup, centre)
        } else {
            (mean.norm() > ONE_SIDED).then(|| mean.normalize())
        };
        let towards = |p: &Point| {
            let from = centre - Vector3::from(p.xyz?);
            Some(Vector3::from(p.normal?).normalize().dot(&from) / from.norm().max(1e-12))
        };
        let inwards: Vec<f64> = setup.plan.points.iter().filter_map(towards).collect();
        let inward = faces.is_none() && inwards.iter().sum::<f64>() > 0.5 * inwards.len().max(1) as f64;
        Self { centre, radius, faces, inward }
    }

    /// Without normals: the side of the present photos, else that of the plane a flat object lies in, up or towards -Y.
    fn flat_side(setup: &Setup<'_>, centre: Vector3<f64>) -> Option<Vector3<f64>> {
        let stations = &setup.plan.stations;
        let towards = stations.iter().map(|s| (Vector3::from(s.position) - centre).normalize());
        let mean = towards.sum::<Vector3<f64>>() / stations.len().max(1) as f64;
        if mean.norm() > ONE_SIDED {
            return Some(mean.normalize());
        }
        let scatter: Matrix3<f64> = setup.places.iter().map(|p| (p - centre) * (p - centre).transpose()).sum();
        let own = scatter.symmetric_eigen();
        let least = own.eigenvalues.imin();
        if own.eigenvalues[least] > 0.05 * own.eigenvalues.max() {
            return None;
        }
        let normal: Vector3<f64> = own.eigenvectors.column(least).into();
        Some(if normal.z - normal.y < 0.0 { -normal } else { normal })
    }

    /// Directions from the object to the camera.
    fn directions(&self) -> Vec<Vector3<f64>> {
        let Some(main) = self.faces else {
            // Every second level is turned by half a step: a box needs photos of its edges, which tie its faces together.
            let level = |(at, (elevation, count)): (usize, (f64, usize))| {
                let (s, c) = f64::to_radians(elevation).sin_cos();
                (0..count).map(move |k| {
                    let (sa, ca) = (TAU * (k as f64 + 0.5 * (at % 2) as f64) / count as f64).sin_cos();
                    Vector3::new(c * ca, c * sa, s)
                })
            };
            return LEVELS.into_iter().enumerate().flat_map(level).collect();
        };
        let up = if main.z.abs() < 0.9 { Vector3::z() } else { Vector3::y() };
        let across = up.cross(&main).normalize();
        let above = main.cross(&across);
        let fan = |(angle, count): (f64, usize)| {
            let (s, c) = f64::to_radians(angle).sin_cos();
            (0..count).map(move |k| {
                let (sa, ca) = (TAU * k as f64 / count as f64).sin_cos();
                c * main + s * (ca * across + sa * above)
            })
        };
        FANS.into_iter().flat_map(fan).collect()
    }
}

/// Normals within this angle, radians, are those of one face.
const ONE_FACE: f64 = 0.4;
/// Faces up to which their edges are examined one by one; an object of more is round.
const MOST_FACES: usize = 12;
/// How much less than the largest incidence the middle of a photo has, radians: targets beside the middle are seen at more.
const BESIDE: f64 = 0.08;

/// Directions from which two or three faces are seen at once, equally steep: their photos tie those of the faces together.
fn edges(setup: &Setup<'_>) -> Vec<Vector3<f64>> {
    let mut faces: Vec<Vector3<f64>> = Vec::new();
    for normal in setup.plan.points.iter().filter_map(|p| p.normal.map(|n| Vector3::from(n).normalize())) {
        if !faces.iter().any(|face| face.dot(&normal) > ONE_FACE.cos()) {
            faces.push(normal);
        }
        if faces.len() > MOST_FACES {
            return Vec::new();
        }
    }
    let least = (setup.plan.max_incidence - BESIDE).cos();
    let mut found = Vec::new();
    let mut look = |some: &[Vector3<f64>]| {
        let sum: Vector3<f64> = some.iter().sum();
        if sum.norm() > 1e-6 && some.iter().all(|face| face.dot(&sum) > least * sum.norm()) {
            found.push(sum.normalize());
        }
    };
    for (c, third) in faces.iter().enumerate() {
        for (b, second) in faces[..c].iter().enumerate() {
            look(&[*second, *third]);
            faces[..b].iter().for_each(|first| look(&[*first, *second, *third]));
        }
    }
    found
}

/// The distance from which the object fills the picture, and that from which the smallest target is just large enough.
fn limits(setup: &Setup<'_>, frame: &Frame) -> (f64, f64) {
    let camera = &setup.plan.cameras[0];
    let c = principal_distance_px(camera).unwrap_or(1.0);
    let smallest = setup.plan.points.iter().filter_map(|p| p.diameter).fold(f64::INFINITY, f64::min);
    let far = if setup.plan.least_px > 0.0 { smallest * c / setup.plan.least_px } else { f64::INFINITY };
    (fill_distance(camera, setup.plan.margin, frame.radius), far)
}

/// Distances that are tried: at which the object fills the picture, nearer for parts of it, farther; as far as targets are large enough.
fn distances(setup: &Setup<'_>, frame: &Frame) -> Vec<f64> {
    let (fill, far) = limits(setup, frame);
    let mut all: Vec<f64> = SHARES.iter().map(|share| share * fill).filter(|d| *d < far).collect();
    if far < fill {
        // Seen at a slant, targets are smaller.
        all.extend([0.95 * far, 0.75 * far, 0.55 * far]);
    }
    all.extend(setup.plan.lens.focus.filter(|_| setup.plan.lens.f_number.is_some()));
    all.sort_by(|a, b| b.total_cmp(a));
    all.dedup_by(|a, b| (*a - *b).abs() < 0.05 * *b);
    all
}

/// Aim points: the middle, and where the object is too large for one picture, parts that are far from each other.
fn aims(setup: &Setup<'_>, frame: &Frame, distance: f64, fill: f64) -> Vec<Vector3<f64>> {
    let mut aims = vec![frame.centre];
    if distance < 0.9 * fill {
        for _ in 0..4 {
            let away = |p: &Vector3<f64>| aims.iter().map(|a| (a - p).norm()).fold(f64::INFINITY, f64::min);
            let farthest = setup.places.iter().max_by(|a, b| away(a).total_cmp(&away(b)));
            let Some(place) = farthest else { break };
            // Half-way out, so that the picture is filled.
            aims.push(frame.centre + 0.6 * (place - frame.centre));
        }
    }
    aims
}

/// Whether cameras are calibrated with the photos: then rolled ones are worth trying.
pub fn rolls(setup: &Setup<'_>) -> &'static [f64] {
    let calibrates = setup.plan.cameras.iter().any(|c| !c.free.is_empty() || !c.sigma.is_empty());
    if calibrates { &[0.0, FRAC_PI_2] } else { &[0.0] }
}

/// Photos that could be taken and see so many points, at most so many, spread over all that there are.
pub fn candidates(setup: &Setup<'_>, most: usize, sees: usize) -> Vec<Shot> {
    let frame = Frame::of(setup);
    let distances = distances(setup, &frame);
    let fill = distances.iter().copied().fold(0.0, f64::max) / SHARES[3].max(1.0);
    // What ties faces together is never left out.
    let mut tying = Vec::new();
    for direction in if frame.inward { Vec::new() } else { edges(setup) } {
        for &distance in &distances {
            for &roll in rolls(setup) {
                tying.extend(allowed(setup, frame.centre + distance * direction, frame.centre, roll, sees));
            }
        }
    }
    let mut tying = spread(tying, most / 2);
    let mut shots = Vec::new();
    if frame.inward {
        shots.extend(inside(setup, &frame, sees));
    }
    for direction in frame.directions() {
        for &distance in &distances {
            for aim in aims(setup, &frame, distance, fill) {
                for &roll in rolls(setup) {
                    let position = aim + distance * direction;
                    shots.extend(allowed(setup, position, aim, roll, sees));
                }
            }
        }
    }
    // Where targets are too small for a picture of the whole, photos of its parts are most of them.
    if !frame.inward && limited(setup, &frame) {
        let left = most - tying.len();
        tying.extend(parts(setup, left * 2 / 3, sees));
    }
    let left = most - tying.len();
    tying.extend(spread(shots, left));
    tying
}

/// Whether targets are too small from where the object fills the picture.
fn limited(setup: &Setup<'_>, frame: &Frame) -> bool {
    let (fill, far) = limits(setup, frame);
    far < fill
}

/// Photos of one place of the object from all sides, with it in the middle of the picture or between there and the border.
pub fn about(setup: &Setup<'_>, place: Vector3<f64>, sees: usize) -> Vec<Shot> {
    let frame = Frame::of(setup);
    let distances = distances(setup, &frame);
    let mut shots = Vec::new();
    for direction in frame.directions() {
        for &distance in &distances {
            for aim in [place, 0.5 * (place + frame.centre)] {
                for &roll in rolls(setup) {
                    shots.extend(allowed(setup, aim + distance * direction, aim, roll, sees));
                }
            }
        }
    }
    shots
}

/// At most so many of them, evenly taken.
fn spread(shots: Vec<Shot>, most: usize) -> Vec<Shot> {
    if shots.len() <= most {
        return shots;
    }
    let step = shots.len() as f64 / most as f64;
    (0..most).map(|k| shots[(k as f64 * step) as usize].clone()).collect()
}

/// Candidate stations inside an object that is photographed from within, such as a room: each aims at a wall, from the centre, from farther
/// back and from either side.
fn inside(setup: &Setup<'_>, frame: &Frame, sees: usize) -> Vec<Shot> {
    let mut shots = Vec::new();
    for direction in frame.directions() {
        let side = direction.cross(&Vector3::z());
        for back in INSIDE {
            for aside in [0.0, -0.35, 0.35] {
                let position = frame.centre + frame.radius * (aside * side - back * direction);
                for &roll in rolls(setup) {
                    shots.extend(allowed(setup, position, frame.centre + frame.radius * direction, roll, sees));
                }
            }
        }
    }
    shots
}

/// The photo from a place where one can stand and which sees enough.
pub fn allowed(setup: &Setup<'_>, position: Vector3<f64>, aim: Vector3<f64>, roll: f64, sees: usize) -> Option<Shot> {
    let station = PlanStation { position: position.into(), look_at: Some(aim.into()), roll, ..PlanStation::default() };
    let shot = setup.shot(&station).ok()?;
    (!shot.forbidden && shot.seen.len() >= sees.min(setup.places.len()) && spreads(setup, &shot)).then_some(shot)
}

/// Whether what a photo sees is more than a row of points.
fn spreads(setup: &Setup<'_>, shot: &Shot) -> bool {
    let n = shot.seen.len() as f64;
    let middle = [0, 1].map(|a| shot.seen.iter().map(|(_, pixel)| pixel[a]).sum::<f64>() / n);
    let scatter = |a: usize, b: usize| {
        shot.seen.iter().map(|(_, pixel)| (pixel[a] - middle[a]) * (pixel[b] - middle[b])).sum::<f64>() / n
    };
    let (xx, xy, yy) = (scatter(0, 0), scatter(0, 1), scatter(1, 1));
    let least = (xx + yy) / 2.0 - ((xx - yy) / 2.0).hypot(xy);
    let camera = &setup.plan.cameras[shot.camera];
    least.max(0.0).sqrt() >= LEAST_SPREAD * f64::from(camera.width.min(camera.height)) / 2.0
}

/// Half axes with the photos' exterior orientations held: each ray gives its point what it gives across its direction, (I - rrᵀ)·(c/(D·σ))².
/// The largest, or 10⁶ times the object where a point is not determined, summed; cheap, and of the same order of photos.
pub struct Held {
    sums: Vec<Matrix3<f64>>,
    loose: f64,
}

impl Held {
    pub fn new(setup: &Setup<'_>, shots: &[&Shot]) -> Self {
        let size = Frame::of(setup).radius;
        let mut held =
            Self { sums: vec![Matrix3::identity() * (1e-6 / size).powi(2); setup.places.len()], loose: size };
        shots.iter().for_each(|shot| held.add(setup, shot, 1.0));
        held
    }

    /// Adds a photo, or takes it away.
    pub fn add(&mut self, setup: &Setup<'_>, shot: &Shot, sign: f64) {
        let c = principal_distance_px(&setup.plan.cameras[shot.camera]).unwrap_or(1.0);
        for (k, _) in &shot.seen {
            let ray = setup.places[*k] - shot.pose.centre;
            let distance = ray.norm();
            let ray = ray / distance;
            let weight = (c / (distance * setup.plan.sigma)).powi(2);
            self.sums[*k] += (Matrix3::identity() - ray * ray.transpose()) * (sign * weight);
        }
    }

    /// Sum of squared half axes with a photo more, without the points that are `given` or not asked for: for the order in which
    /// photos are tried.
    pub fn with(&self, setup: &Setup<'_>, shot: &Shot, given: &[bool]) -> f64 {
        let mut more = Self { sums: self.sums.clone(), loose: self.loose };
        more.add(setup, shot, 1.0);
        more.value(given)
    }

    pub fn value(&self, given: &[bool]) -> f64 {
        let most = (10.0 * self.loose).powi(2);
        let axis = |sum: &Matrix3<f64>| {
            // A point that no photo sees is worse than one that a single one sees.
            if sum.trace() < 1.0 / most {
                return 4.0 * most;
            }
            let trace = sum.try_inverse().map_or(f64::INFINITY, |q| q.trace());
            // What is hardly determined counts by how much, not beyond all measure.
            trace.clamp(0.0, most)
        };
        self.sums.iter().zip(given).filter(|(_, given)| !**given).map(|(sum, _)| axis(sum)).sum()
    }
}
