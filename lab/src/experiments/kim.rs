//! Kim, Hwang and Yun (2015): DLT, then a self-calibrating bundle, then intersection.
//!
//! Two photos of 2592 x 1944 pixels of 2.2 µm, at the places and attitudes the paper found, of 80 circular targets on two
//! planes that meet in an edge; 15 of them at the paper's coordinates are check points, the others control. The paper
//! prints no principal distance: 6 mm here, about 1 : 1100 at the edge, and its distortion coefficients. Given
//! coordinates have the surveyor's errors. Photos are rendered, centres are fitted ellipses.

use nalgebra::Vector3;

use super::outcome::{Assumption, Cell, Chart, Drawing, Experiment, Figure, Series, Table};
use super::{ExperimentOptions, Progress, step};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment, ResidualPlace, StatisticsChoice};
use sightline::camera::ideal_from_pixel;
use sightline::detection::{DetectOptions, Method};
use sightline::error::{Error, Result};
use sightline::initial::Pose;
use sightline::initial::dlt::dlt;
use sightline::initial::intersection::{Ray, intersect};
use sightline::project::{Camera, Datum, DatumKind, Interior, Parameter, Photo, Project, Role, Sigma};
use sightline::rotation;
use sightline_plan::network::{Network, NetworkPoint, Source, Station, simulate};
use sightline_plan::render::Exposure;
use sightline_plan::scene::Face;

/// X, Y, Z in metres as the total station measured them, and photogrammetry minus that in mm.
const CHECK: [([f64; 3], [f64; 3]); 15] = [
    ([0.9614, 5.5500, 2.0772], [-0.494, -4.685, -1.344]),
    ([0.9579, 5.5382, 1.5784], [0.154, 2.797, -0.153]),
    ([0.9571, 5.5414, 1.0768], [0.137, -0.138, -0.352]),
    ([0.9571, 5.5535, 0.5614], [-0.102, 5.460, -0.137]),
    ([0.9544, 5.5501, 0.0551], [0.133, -0.476, 0.160]),
    ([0.4925, 5.6403, 2.5709], [-0.179, -2.834, -0.581]),
    ([0.4930, 5.6298, 2.0637], [0.091, -0.792, -0.432]),
    ([0.4876, 5.6181, 1.5743], [0.777, -0.599, -0.488]),
    ([0.4898, 5.6234, 1.0602], [-0.159, 2.557, -0.144]),
    ([0.4919, 5.6214, 0.5464], [2.408, -9.749, 0.177]),
    ([0.4882, 5.6316, 0.0549], [1.058, 0.408, 0.041]),
    ([0.0709, 5.3788, 2.5783], [0.132, 0.801, 0.678]),
    ([0.0695, 5.3738, 2.0672], [-0.173, -0.080, -0.051]),
    ([0.0704, 5.3739, 1.5686], [0.334, 2.261, 0.091]),
    ([0.0585, 5.3621, 1.0682], [1.499, 5.686, 0.222]),
];
/// Omega, phi, kappa (rad) and XL, YL, ZL (m) of both photos: by DLT and by the bundle.
const PAPER: [[[f64; 6]; 2]; 2] = [
    [[1.5709, -0.1840, -0.0145, -0.9149, -1.1359, 0.6796], [1.5736, -0.1831, -0.0139, -0.9112, -1.1178, 0.6852]],
    [[1.5777, -0.1218, 0.0099, 0.4199, -1.2645, 0.6849], [1.5767, -0.1235, 0.0097, 0.4216, -1.2498, 0.6847]],
];
/// Principal point (pixels) and K1, K2, K3, P1, P2 (per pixel to the power) of both photos.
const INTERIOR: [[f64; 7]; 2] = [
    [-2.2341, 7.2037, 2.8875e-9, -1.7808e-15, 3.7700e-22, 5.1128e-8, -6.0458e-7],
    [0.5037, -1.1615, 3.4363e-9, -2.5436e-15, 5.5782e-22, -9.4114e-8, 1.3499e-7],
];
const PITCH_MM: f64 = 0.0022;
const PRINCIPAL_DISTANCE_MM: f64 = 6.0;
/// Standard error of the surveyed coordinates, assumed: within a room a total station of 2 mm + 2 ppm is better than its
/// specification, and all targets are measured from one set-up.
const SURVEY_ERROR_MM: f64 = 0.3;
/// Assumed: diameter of the targets, blur of the lens in pixels, noise of the sensor as a share of full scale.
const DIAMETER_M: f64 = 0.05;
const PSF_PX: f64 = 0.8;
const PIXEL_NOISE: f64 = 0.01;
const NAMES: [&str; 6] = ["omega", "phi", "kappa", "xl", "yl", "zl"];
const FREE: [Parameter; 8] = [
    Parameter::C,
    Parameter::X0,
    Parameter::Y0,
    Parameter::K1,
    Parameter::K2,
    Parameter::K3,
    Parameter::P1,
    Parameter::P2,
];
/// Iterations that the paper shows.
const ITERATIONS: usize = 10;
/// Iterations after which XL, YL, ZL had settled, photo by photo.
const SETTLED: [[usize; 3]; 2] = [[3, 4, 5], [5, 4, 6]];

pub fn run(options: &ExperimentOptions, progress: Progress) -> Result<Experiment> {
    let network = network(options);
    // Photo by photo, so that the progress shows.
    let mut measured = simulate(&Network { observations: Source::Exact, stations: Vec::new(), ..network.clone() })?;
    for index in 0..2 {
        step(progress, index, 4)?;
        // Noise belongs to the station's place in the list, so both stay and one is emptied of its points.
        let one = Network { stations: vec![network.stations[index].clone()], ..network.clone() };
        let mut exposure = network.exposure.clone();
        exposure.seed = exposure.seed.wrapping_add(index as u64);
        let project = simulate(&Network { exposure, ..one })?;
        measured.observations.extend(project.observations);
        measured.photos.extend(project.photos);
        measured.points = project.points;
    }
    step(progress, 2, 4)?;
    let start = started_by_dlt(&measured)?;
    let (way, adjustment) = iterate(&start)?;
    step(progress, 3, 4)?;
    let differences = check(&start, &adjustment);
    let orientations = [exterior(&start.photos), adjusted_exterior(&adjustment)];
    Ok(Experiment {
        name: "kim".into(),
        drawings: drawings(options),
        figures: figures(&differences, &way),
        tables: vec![
            check_table(&differences),
            statistics_table(&differences),
            orientation_table(&orientations),
            interior_table(&adjustment),
        ],
        charts: charts(&way),
        assumptions: vec![
            Assumption::new("principal_distance", "mm", PRINCIPAL_DISTANCE_MM, None),
            Assumption::new("survey_error", "mm", options.control_sigma_mm.unwrap_or(SURVEY_ERROR_MM), None),
            Assumption::new("target_diameter", "mm", 1000.0 * DIAMETER_M, None),
            Assumption::of_kind("control_places"),
            Assumption::new("psf", "px", PSF_PX, None),
            Assumption::new("pixel_noise", "%", 100.0 * options.pixel_noise.unwrap_or(PIXEL_NOISE), None),
        ],
        project: start,
    })
}

/// The two planes with both stations.
pub fn drawings(options: &ExperimentOptions) -> Vec<Drawing> {
    vec![Drawing::of("planes", &network(options))]
}

/// The paper's interior orientation of both photos in mm, with the principal distance that it does not print.
fn papers_interior() -> [Interior; 2] {
    INTERIOR.map(|[x0, y0, k1, k2, k3, p1, p2]| {
        let mm = PITCH_MM;
        let mut interior = Interior::brown(PRINCIPAL_DISTANCE_MM);
        let values = [x0 * mm, y0 * mm, k1 / mm.powi(2), k2 / mm.powi(4), k3 / mm.powi(6), p1 / mm, p2 / mm];
        FREE[1..].iter().zip(values).for_each(|(parameter, value)| interior.set(*parameter, value));
        interior
    })
}

/// The network with its true values.
pub fn network(options: &ExperimentOptions) -> Network {
    let interiors = papers_interior();
    let camera = |index: usize| Camera {
        pixel_pitch: Some([PITCH_MM; 2]),
        free: FREE.to_vec(),
        ..Camera::new(format!("{}", index + 1), 2592, 1944, interiors[index])
    };
    let station = |index: usize| {
        let [omega, phi, kappa, x, y, z] = PAPER[index][1];
        let id = (index + 1).to_string();
        Station {
            camera: id.clone(),
            id,
            position: [x, y, z],
            rotation: Some([omega, phi, kappa]),
            ..Station::default()
        }
    };
    let noise = options.pixel_noise.unwrap_or(PIXEL_NOISE);
    Network {
        name: "Kim, Hwang & Yun 2015".into(),
        unit: "m".into(),
        cameras: (0..2).map(camera).collect(),
        stations: (0..2).map(station).collect(),
        points: points(options),
        faces: faces(),
        background: 0.3,
        datum: Datum { kind: DatumKind::Control, points: None },
        sigma: Sigma::One(0.05),
        observations: Source::Rendered,
        seed: options.seed,
        exposure: Exposure {
            psf: PSF_PX,
            read_noise: noise,
            shot_noise: noise,
            seed: options.seed,
            ..Exposure::default()
        },
        detect: DetectOptions { method: Method::Ellipse, ..DetectOptions::default() },
        ..Network::default()
    }
}

/// Depth of the two planes at X, metres: they meet at the column of check points 6 to 11.
fn depth(x: f64) -> f64 {
    const EDGE: [f64; 2] = [0.49, 5.63];
    let slope = if x < EDGE[0] { 0.607 } else { -0.178 };
    EDGE[1] + slope * (x - EDGE[0])
}

fn normal(x: f64) -> [f64; 3] {
    if x < 0.49 { [0.607, -1.0, 0.0] } else { [-0.178, -1.0, 0.0] }
}

fn points(options: &ExperimentOptions) -> Vec<NetworkPoint> {
    let sigma = options.control_sigma_mm.unwrap_or(SURVEY_ERROR_MM) / 1000.0;
    let target = |id: String, role: Role, xyz: [f64; 3]| NetworkPoint {
        id,
        role,
        xyz,
        sigma: Some([Some(sigma); 3]),
        normal: Some(normal(xyz[0] + 1e-3)),
        diameter: Some(DIAMETER_M),
        grey: Some(0.08),
        ..NetworkPoint::default()
    };
    let mut points: Vec<_> =
        CHECK.iter().enumerate().map(|(k, (xyz, _))| target((k + 1).to_string(), Role::Check, *xyz)).collect();
    let heights = [0.055, 0.555, 1.065, 1.57, 2.07, 2.575];
    let mut places = vec![[0.065, 0.055], [0.065, 0.555], [0.957, 2.575]];
    for x in [-1.61, -1.19, -0.77, -0.35, 1.4, 1.85, 2.3, 2.75, 3.1] {
        places.extend(heights.map(|z| [x, z]));
    }
    // Eight more near the edge make 80.
    places.extend([0.3, 0.8, 1.3, 1.8, 2.3].map(|z| [0.28, z]));
    places.extend([0.3, 1.3, 2.3].map(|z| [0.73, z]));
    for [x, z] in places {
        points.push(target((101 + points.len() - CHECK.len()).to_string(), Role::Control, [x, depth(x), z]));
    }
    points
}

/// The two walls, a little behind the targets, which are glued on plates.
fn faces() -> Vec<Face> {
    let wall = |from: f64, to: f64| {
        let [a, b] = [from, to].map(|x| [x, depth(x) + 0.05, -1.5]);
        Face {
            corner: a,
            along: [b[0] - a[0], b[1] - a[1], 0.0],
            across: [0.0, 0.0, 6.0],
            grey: 0.55,
            texture: 0.02,
            grain: 0.3,
        }
    };
    vec![wall(-3.5, 0.49), wall(0.49, 5.0)]
}

/// The same project oriented by DLT: interior orientation without distortion, photos at their DLT places.
fn started_by_dlt(measured: &Project) -> Result<Project> {
    let mut project = measured.clone();
    for (photo, camera) in project.photos.iter_mut().zip(&mut project.cameras) {
        let mut pairs = (Vec::new(), Vec::new());
        for o in measured.observations.iter().filter(|o| o.photo == photo.id) {
            let control = measured.points.iter().find(|p| p.id == o.point && p.role == Role::Control);
            let Some(xyz) = control.and_then(|p| p.xyz) else { continue };
            pairs.0.push(Vector3::from(xyz));
            pairs.1.push(camera.photo_from_pixel([o.u, o.v]));
        }
        let solved =
            dlt(&pairs.0, &pairs.1).map_err(|reason| Error::CannotOrient { reason, photos: vec![photo.id.clone()] })?;
        camera.interior = Interior::brown((solved.cx + solved.cy) / 2.0);
        camera.interior.set(Parameter::X0, solved.x0);
        camera.interior.set(Parameter::Y0, solved.y0);
        photo.position = Some(solved.pose.centre.into());
        photo.rotation = Some(rotation::angles(&solved.pose.object_to_camera));
    }
    Ok(project)
}

/// Projection centres after 0, 1, 2 … iterations, photo by photo, and the adjustment.
type Way = [Vec<[f64; 3]>; 2];

/// Runs the adjustment again and again, one iteration longer each time, as far as it takes.
fn iterate(start: &Project) -> Result<(Way, Adjustment)> {
    let mut bundle = start.clone();
    // Check points are intersected afterwards; the bundle does not see them.
    for o in &mut bundle.observations {
        o.enabled = bundle.points.iter().any(|p| p.id == o.point && p.role == Role::Control);
    }
    let choice = |max_iterations| AdjustOptions {
        max_iterations,
        statistics: StatisticsChoice::None,
        residuals: ResidualPlace::Corrected,
        ..AdjustOptions::default()
    };
    let mut way: Way = [0, 1].map(|k| start.photos[k].position.into_iter().collect());
    for iterations in 1..=ITERATIONS {
        let adjustment = adjust(&bundle, &choice(iterations), &mut |_| true)?;
        (0..2).for_each(|k| way[k].push(adjustment.photos[k].position));
    }
    let full = AdjustOptions {
        statistics: StatisticsChoice::Precision,
        residuals: ResidualPlace::Corrected,
        ..AdjustOptions::default()
    };
    Ok((way, adjust(&bundle, &full, &mut |_| true)?))
}

/// Intersected minus given, mm, check point by check point; `None` if a photo does not show the point.
fn check(project: &Project, adjustment: &Adjustment) -> Vec<Option<[f64; 3]>> {
    let ray = |point: &str, index: usize| {
        let photo = adjustment.photos.get(index)?;
        let camera = &adjustment.cameras.get(index)?.camera;
        let o = project.observations.iter().find(|o| o.photo == photo.id && o.point == point)?;
        let pose = Pose { object_to_camera: rotation::object_to_camera(photo.rotation), centre: photo.position.into() };
        Some(Ray { pose, image: ideal_from_pixel(camera, [o.u, o.v])?, weight: 1.0 })
    };
    let difference = |id: String| {
        let given = project.points.iter().find(|p| p.id == id)?.xyz?;
        let found = intersect(&[ray(&id, 0)?, ray(&id, 1)?]).ok()?.point;
        Some([0, 1, 2].map(|k| (found[k] - given[k]) * 1000.0))
    };
    (1..=CHECK.len()).map(|k| difference(k.to_string())).collect()
}

/// Greatest, least, mean, standard deviation and rms per axis.
fn statistics(differences: &[[f64; 3]]) -> [[f64; 3]; 5] {
    let n = differences.len() as f64;
    let axis = |k: usize| differences.iter().map(move |d| d[k]);
    let each = |f: &dyn Fn(usize) -> f64| [0, 1, 2].map(f);
    let mean = each(&|k| axis(k).sum::<f64>() / n);
    [
        each(&|k| axis(k).fold(f64::NEG_INFINITY, f64::max)),
        each(&|k| axis(k).fold(f64::INFINITY, f64::min)),
        mean,
        each(&|k| (axis(k).map(|d| (d - mean[k]).powi(2)).sum::<f64>() / (n - 1.0)).sqrt()),
        each(&|k| (axis(k).map(|d| d * d).sum::<f64>() / n).sqrt()),
    ]
}

fn known(differences: &[Option<[f64; 3]>]) -> Vec<[f64; 3]> {
    differences.iter().flatten().copied().collect()
}

fn papers() -> Vec<[f64; 3]> {
    CHECK.iter().map(|(_, d)| *d).collect()
}

fn check_table(differences: &[Option<[f64; 3]>]) -> Table {
    let mut table =
        Table::new("check_points", &["point", "dx|mm|3", "*dx|mm|3", "dy|mm|3", "*dy|mm|3", "dz|mm|3", "*dz|mm|3"]);
    for (k, (ours, paper)) in differences.iter().zip(papers()).enumerate() {
        let mut row: Vec<Cell> = vec![(k + 1).to_string().as_str().into()];
        (0..3).for_each(|a| row.extend([Cell::from(ours.map(|d| d[a])), paper[a].into()]));
        table.rows.push(row);
    }
    table
}

fn statistics_table(differences: &[Option<[f64; 3]>]) -> Table {
    let mut table =
        Table::new("statistics", &["statistic", "x|mm|3", "*x|mm|3", "y|mm|3", "*y|mm|3", "z|mm|3", "*z|mm|3"]);
    let (ours, paper) = (statistics(&known(differences)), statistics(&papers()));
    for (k, name) in ["greatest", "least", "mean", "standard_deviation", "rms"].into_iter().enumerate() {
        let mut row: Vec<Cell> = vec![name.into()];
        (0..3).for_each(|a| row.extend([Cell::from(ours[k][a]), paper[k][a].into()]));
        table.rows.push(row);
    }
    table
}

fn exterior(photos: &[Photo]) -> Vec<[f64; 6]> {
    let six = |p: &Photo| {
        let (r, x) = (p.rotation.unwrap_or([f64::NAN; 3]), p.position.unwrap_or([f64::NAN; 3]));
        [r[0], r[1], r[2], x[0], x[1], x[2]]
    };
    photos.iter().map(six).collect()
}

fn adjusted_exterior(adjustment: &Adjustment) -> Vec<[f64; 6]> {
    let six = |p: &sightline::adjustment::AdjustedPhoto| {
        [p.rotation[0], p.rotation[1], p.rotation[2], p.position[0], p.position[1], p.position[2]]
    };
    adjustment.photos.iter().map(six).collect()
}

fn orientation_table(orientations: &[Vec<[f64; 6]>; 2]) -> Table {
    let mut table = Table::new("orientation", &["photo", "element", "dlt||4", "*dlt||4", "bundle||4", "*bundle||4"]);
    for photo in 0..2 {
        for (k, name) in NAMES.into_iter().enumerate() {
            table.rows.push(vec![
                (photo + 1).to_string().as_str().into(),
                name.into(),
                orientations[0][photo][k].into(),
                PAPER[photo][0][k].into(),
                orientations[1][photo][k].into(),
                PAPER[photo][1][k].into(),
            ]);
        }
    }
    table
}

/// Found beside the paper's, which prints no principal distance.
fn interior_table(adjustment: &Adjustment) -> Table {
    let mut table = Table::new("interior", &["photo", "parameter", "value||10", "*value||10", "sigma||10"]);
    for (camera, paper) in adjustment.cameras.iter().zip(papers_interior()) {
        for parameter in FREE {
            let printed = (parameter != Parameter::C).then(|| paper.get(parameter)).flatten();
            table.rows.push(vec![
                camera.camera.id.as_str().into(),
                parameter.name().into(),
                camera.camera.interior.get(parameter).into(),
                printed.into(),
                camera.sigma.get(&parameter).copied().into(),
            ]);
        }
    }
    table
}

/// Number of iterations after which nothing moves by more than 0.1 mm any more.
fn settled(way: &Way) -> usize {
    let last = [0, 1].map(|k| way[k][way[k].len() - 1]);
    let off = |i: usize| (0..2).any(|k| (0..3).any(|a| (way[k][i][a] - last[k][a]).abs() > 1e-4));
    (0..way[0].len()).rev().find(|i| off(*i)).map_or(0, |i| i + 1)
}

fn figures(differences: &[Option<[f64; 3]>], way: &Way) -> Vec<Figure> {
    let (ours, paper) = (statistics(&known(differences)), statistics(&papers()));
    let mut list = Vec::new();
    for (a, axis) in ["x", "y", "z"].into_iter().enumerate() {
        for (k, name) in ["greatest", "least", "mean", "standard_deviation", "rms"].into_iter().enumerate() {
            list.push(Figure::new(format!("{name}/{axis}"), "mm", ours[k][a], paper[k][a]));
        }
    }
    list.push(Figure::new("check_points", "", known(differences).len() as f64, 15.0));
    list.push(Figure::new("iterations", "", settled(way) as f64, 6.0));
    list
}

/// The paper's figures 8 and 9: XL, YL, ZL over the iterations.
fn charts(way: &Way) -> Vec<Chart> {
    let mut charts = Vec::new();
    for (photo, places) in way.iter().enumerate() {
        for (k, axis) in ["xl", "yl", "zl"].into_iter().enumerate() {
            let points = places.iter().enumerate().map(|(i, p)| [i as f64, p[k]]).collect();
            // The paper prints start and end, and says after how many iterations the end was reached.
            let [start, end] = [PAPER[photo][0][3 + k], PAPER[photo][1][3 + k]];
            let reached = SETTLED[photo][k] as f64;
            let paper = |points| Series { paper: true, ..Series::new(axis, points) };
            let level = paper(vec![[reached, end], [ITERATIONS as f64, end]]);
            let series = vec![Series::new(axis, points), paper(vec![[0.0, start]]), level];
            charts.push(Chart::new(format!("way_{axis}/{}", photo + 1), "iteration", &format!("{axis}|m"), series));
        }
    }
    charts
}
