//! Photos of boards of dots as lists of targets, drawn at random: poses, lenses, partial views, occluders, clutter and other boards.

use std::collections::BTreeSet;

use nalgebra::{Matrix3, Rotation3, Vector3};
use sightline::camera::pixel_from_camera_point;
use sightline::detection::{Polarity, Quality, Target};
use sightline::initial::Pose;
use sightline::matching::{Board, BoardKind, PhotoTargets};
use sightline::noise::Noise;
use sightline::project::{Camera, Interior, Photo, Project};

use super::networks::Uniform;

/// Obstacles of a photo.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Trouble {
    /// Share of the board's extent by which the photo may aim beside its centre.
    pub aside: f64,
    /// Largest share of dots that are missing by themselves.
    pub missing: f64,
    /// Something round or straight covers part of the board.
    pub occluder: bool,
    /// Maximum number of false dots.
    pub clutter: f64,
    /// A second board of another kind beside it.
    pub second: bool,
    /// Standard error of centres in pixels.
    pub noise_px: f64,
}

/// A photo with its truth.
pub struct View {
    pub camera: Camera,
    pub pose: Pose,
    pub board: Board,
    pub targets: Vec<Target>,
    /// Row and column of each target; `None` for clutter.
    pub truth: Vec<Option<[u32; 2]>>,
    /// Whether the photo shows all dots but those that are missing by themselves.
    pub whole: bool,
}

/// x of a dot in pitches.
pub fn x_of(board: &Board, [row, column]: [u32; 2]) -> f64 {
    f64::from(if board.kind == BoardKind::Asymmetric { 2 * column + row % 2 } else { column })
}

pub fn place(board: &Board, dot: [u32; 2]) -> Vector3<f64> {
    Vector3::new(x_of(board, dot) * board.pitch, f64::from(dot[0]) * board.pitch, 0.0)
}

pub fn dots(board: &Board) -> impl Iterator<Item = [u32; 2]> + '_ {
    (0..board.rows).flat_map(|row| (0..board.columns).map(move |column| [row, column]))
}

pub fn board(rows: u32, columns: u32, kind: BoardKind) -> Board {
    Board { rows, columns, pitch: 20.0, kind, diameter: None, sigma: Some(0.05), mark: None }
}

/// A board of any size, with a diameter of its dots.
pub fn random_board(random: &mut Uniform) -> (Board, f64) {
    let kind = if random.between(0.0, 1.0) < 0.5 { BoardKind::Symmetric } else { BoardKind::Asymmetric };
    let mut side = |low: f64| random.between(low, 16.0) as u32;
    let (rows, columns) = (side(4.0), side(3.0));
    let columns = if kind == BoardKind::Asymmetric { (columns / 2).max(3) } else { columns };
    let board = board(rows, columns, kind);
    let step = if kind == BoardKind::Asymmetric { std::f64::consts::SQRT_2 } else { 1.0 };
    let diameter = random.between(0.3, 0.68) * step * board.pitch;
    (board, diameter)
}

/// A lens of any of the models with strong distortion where it has some.
pub fn random_camera(random: &mut Uniform) -> Camera {
    let (width, height) = [(1280, 960), (1920, 1080), (3000, 2000)][random.between(0.0, 3.0) as usize];
    let half = f64::from(width) / 2.0;
    let [cx, cy] = [half + random.between(-0.03, 0.03) * half, f64::from(height) / 2.0];
    let f = |angle: f64| Some(half / angle.to_radians().tan());
    let interior = match random.between(0.0, 4.0) as u32 {
        0 => {
            let fx = f(random.between(10.0, 33.0));
            Interior::Opencv {
                fx,
                fy: fx,
                cx,
                cy,
                k1: random.between(-0.3, 0.1),
                k2: 0.05,
                p1: 1e-3,
                p2: -1e-3,
                k3: 0.0,
            }
        }
        1 => {
            let fx = f(random.between(40.0, 50.0));
            Interior::Opencv { fx, fy: fx, cx, cy, k1: -0.22, k2: 0.045, p1: 0.0, p2: 0.0, k3: 0.0 }
        }
        2 => {
            let fx = f(random.between(40.0, 55.0));
            let k = random.between(0.2, 0.5);
            Interior::OpencvRational {
                fx,
                fy: fx,
                cx,
                cy,
                k1: 0.1,
                k2: 0.01,
                p1: 0.0,
                p2: 0.0,
                k3: 0.0,
                k4: 0.1 + k,
                k5: 0.1 * k,
                k6: 0.0,
            }
        }
        _ => {
            let fx = Some(half / random.between(50.0, 85.0).to_radians());
            Interior::OpencvFisheye { fx, fy: fx, cx, cy, k1: random.between(-0.05, 0.05), k2: 0.01, k3: 0.0, k4: 0.0 }
        }
    };
    Camera::new("cam", width, height, interior)
}

/// Pose that looks at a place of the board's plane from a distance: tilt off its normal, direction of the tilt, roll.
pub fn pose(at: Vector3<f64>, distance: f64, tilt: f64, azimuth: f64, roll: f64) -> Pose {
    // the board's y and z run against those of a camera that looks at it straight on
    let frontal = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
    let axis = nalgebra::Unit::new_normalize(Vector3::new(azimuth.cos(), azimuth.sin(), 0.0));
    let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), roll) * Rotation3::from_axis_angle(&axis, tilt);
    let object_to_camera = turned.into_inner() * frontal;
    let centre = at - object_to_camera.transpose() * Vector3::new(0.0, 0.0, -distance);
    Pose { object_to_camera, centre }
}

/// Image of a dot: place and ellipse; `None` outside the photo or cut by its border.
fn image(camera: &Camera, pose: &Pose, centre: Vector3<f64>, diameter: f64) -> Option<Target> {
    let project = |p: Vector3<f64>| pixel_from_camera_point(camera, pose.to_camera(&p));
    let [u, v] = project(centre)?;
    let step = 0.02 * diameter;
    let by = |axis: Vector3<f64>| {
        let (a, b) = (project(centre + axis * step)?, project(centre - axis * step)?);
        Some([(a[0] - b[0]) / (2.0 * step) * diameter, (a[1] - b[1]) / (2.0 * step) * diameter])
    };
    let (x, y) = (by(Vector3::x())?, by(Vector3::y())?);
    // turned over: the board seen from behind, or the lens folds there
    if x[0] * y[1] - x[1] * y[0] <= 0.0 {
        return None;
    }
    let [xx, xy, yy] = [x[0] * x[0] + y[0] * y[0], x[0] * x[1] + y[0] * y[1], x[1] * x[1] + y[1] * y[1]];
    let (mean, difference) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
    let (major, minor) = ((mean + difference).sqrt(), (mean - difference).max(0.0).sqrt());
    let margin = 0.5 * major + 1.0;
    let inside =
        u > margin && v > margin && u < f64::from(camera.width) - margin && v < f64::from(camera.height) - margin;
    inside.then(|| target(u, v, major, minor, 0.5 * xy.atan2(0.5 * (xx - yy))))
}

fn target(u: f64, v: f64, major: f64, minor: f64, angle: f64) -> Target {
    Target {
        id: 0,
        u,
        v,
        sigma_u: 0.03,
        sigma_v: 0.03,
        covariance_uv: 0.0,
        major,
        minor,
        angle,
        contrast: 100.0,
        polarity: Polarity::Dark,
        code: None,
        code_family: None,
        code_candidates: Vec::new(),
        inner: None,
        occluded: false,
        quality: Quality::default(),
    }
}

/// A random photo of a board whose dots are of at least 8 pixels and a tilt of at most 60 degrees.
pub fn view(board: &Board, diameter: f64, camera: Camera, trouble: Trouble, seed: u64) -> View {
    let mut random = Uniform(seed);
    let mut noise = Noise::new(seed, 9);
    loop {
        let last = place(board, [board.rows - 1, board.columns - 1]);
        let aside = |random: &mut Uniform| random.between(-trouble.aside, trouble.aside);
        let at = Vector3::new(last.x * (0.5 + aside(&mut random)), last.y * (0.5 + aside(&mut random)), 0.0);
        let f = camera.principal_distance_px().expect("a principal distance");
        let wanted_px = 8.0 * random.between(1.0, 6.0_f64).powf(random.between(0.3, 1.0));
        let distance = f * diameter / wanted_px;
        let tilt = random.between(0.0, 60.0_f64).to_radians();
        let (azimuth, roll) = (random.between(-3.2, 3.2), random.between(-3.2, 3.2));
        let pose = pose(at, distance, tilt, azimuth, roll);
        let images: Vec<_> = dots(board).map(|dot| (dot, image(&camera, &pose, place(board, dot), diameter))).collect();
        let seen: Vec<_> = images.iter().filter_map(|(dot, t)| Some((*dot, t.clone()?))).collect();
        let smallest = seen.iter().map(|(_, t)| t.major).fold(f64::INFINITY, f64::min);
        let flattest = seen.iter().map(|(_, t)| t.minor / t.major).fold(f64::INFINITY, f64::min);
        if smallest < 8.0 || seen.len() < 12.min(board.rows as usize * board.columns as usize) || flattest < 0.3 {
            continue;
        }
        let mut whole = seen.len() == images.len();
        let mut gone: BTreeSet<[u32; 2]> = BTreeSet::new();
        if trouble.occluder {
            let (_, at) = &seen[random.between(0.0, seen.len() as f64) as usize];
            let (angle, width) = (random.between(-3.2, 3.2), random.between(0.5, 4.0) * wanted_px);
            let round = random.between(0.0, 1.0) < 0.5;
            let hides = |t: &Target| {
                let (x, y) = (t.u - at.u, t.v - at.v);
                if round { x.hypot(y) < 2.0 * width } else { (x * angle.cos() + y * angle.sin()).abs() < width }
            };
            gone.extend(seen.iter().filter(|(_, t)| hides(t)).map(|(dot, _)| *dot));
            whole &= gone.is_empty();
        }
        let share = random.between(0.0, trouble.missing);
        gone.extend(seen.iter().filter(|_| random.between(0.0, 1.0) < share).map(|(dot, _)| *dot));
        let (mut targets, mut truth) = (Vec::new(), Vec::new());
        for (dot, t) in seen.iter().filter(|(dot, _)| !gone.contains(dot)) {
            let mut t = t.clone();
            t.u += trouble.noise_px * noise.normal();
            t.v += trouble.noise_px * noise.normal();
            t.major *= 1.0 + 0.02 * noise.normal();
            t.minor = t.minor.min(t.major) * (1.0 + 0.02 * noise.normal());
            targets.push(t);
            truth.push(Some(*dot));
        }
        if trouble.second {
            second(&camera, &pose, board, &mut random, &mut targets);
        }
        // nothing stands on the board itself
        let clear = |targets: &[Target], u: f64, v: f64| {
            targets.iter().all(|t| (t.u - u).hypot(t.v - v) > 0.8 * (t.major + t.minor))
        };
        for _ in 0..random.between(0.0, trouble.clutter) as usize {
            let (u, v) = (random.between(0.0, f64::from(camera.width)), random.between(0.0, f64::from(camera.height)));
            let major = wanted_px * random.between(0.5, 2.0);
            if clear(&targets, u, v) {
                targets.push(target(u, v, major, major * random.between(0.4, 1.0), random.between(-1.5, 1.5)));
            }
        }
        truth.resize(targets.len(), None);
        // targets come in the order of the rows of the photo
        let mut order: Vec<usize> = (0..targets.len()).collect();
        order.sort_by(|&a, &b| targets[a].v.total_cmp(&targets[b].v));
        let targets = order.iter().map(|k| targets[*k].clone()).collect();
        let truth = order.iter().map(|k| truth[*k]).collect();
        return View { camera, pose, board: board.clone(), targets, truth, whole };
    }
}

/// Dots of another board in the same plane, beside the first one.
fn second(camera: &Camera, pose: &Pose, first: &Board, random: &mut Uniform, targets: &mut Vec<Target>) {
    let (mut other, own) = random_board(random);
    let other_pitch = first.pitch * random.between(0.6, 1.6);
    other.pitch = other_pitch;
    let last = place(first, [first.rows - 1, first.columns - 1]);
    let diameter = own * random.between(0.7, 1.2) * other_pitch / first.pitch;
    let gap = 3.0 * first.pitch + 2.0 * diameter;
    let side = random.between(0.0, 2.0) as u32;
    // nobody could distinguish two boards of one design
    other.rows += u32::from((other.rows, other.columns, other.kind) == (first.rows, first.columns, first.kind));
    let angle = random.between(-0.1, 0.1_f64);
    for dot in dots(&other) {
        let at = place(&other, dot);
        let at = Vector3::new(at.x * angle.cos() - at.y * angle.sin(), at.x * angle.sin() + at.y * angle.cos(), 0.0);
        let offset = if side == 0 {
            Vector3::new(last.x + gap + 30.0, 0.0, 0.0)
        } else {
            Vector3::new(0.0, last.y + gap + 30.0, 0.0)
        };
        if let Some(t) = image(camera, pose, at + offset, diameter) {
            targets.push(t);
        }
    }
}

/// The photo as a project without points, and its targets.
pub fn document(view: &View) -> (Project, Vec<PhotoTargets>) {
    let photo = Photo { id: "a".into(), camera: "cam".into(), enabled: true, ..Photo::default() };
    let project = Project { cameras: vec![view.camera.clone()], photos: vec![photo].into(), ..Project::default() };
    let mut targets = view.targets.clone();
    (1..).zip(&mut targets).for_each(|(id, t): (u32, _)| t.id = id);
    (project, vec![PhotoTargets { photo: "a".into(), targets }])
}
