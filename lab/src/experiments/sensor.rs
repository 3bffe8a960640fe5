//! Loss of accuracy between the sensor and its JPEG: the same exposures, measured on the sensor's green pixels and after every processing
//! step of a camera, adjusted to coordinates each time.
//!
//! No paper's experiment: six convergent photos of a field of targets in relief, self-calibrated in a free network that is laid on
//! the true coordinates, so that centres and coordinates have errors, not only standard errors.

mod camera;

use super::outcome::{Assumption, Cell, Chart, Drawing, Experiment, Figure, Series, Table};
use super::{ExperimentOptions, Progress, step};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment};
use sightline::decode::{self, DecodedPhoto};
use sightline::detect::{detect_photo, detect_shot};
use sightline::detection::{Channel, DetectOptions, Detection};
use sightline::eccentricity::{self, TargetCircle};
use sightline::error::Result;
use sightline::project::{Camera, Datum, DatumKind, Interior, Parameter, Project, Role, Sigma};
use sightline::sensor::Shot;
use sightline_plan::network::{Network, NetworkPoint, Source, Station, photo, simulate};
use sightline_plan::render::Exposure;
use sightline_plan::scene::Face;

use camera::{Developed, SHARPENED, exposed};

/// Steps from the sensor to the file.
const STEPS: [&str; 6] = ["sites", "demosaiced", "sharpened", "toned", "jpeg-92", "jpeg-75"];
const QUALITIES: [u8; 2] = [92, 75];
const SIZE: [u32; 2] = [1200, 900];
const PITCH_MM: f64 = 0.008;
const PRINCIPAL_DISTANCE_MM: f64 = 12.0;
const DIAMETER_MM: f64 = 14.0;
const PSF_PX: f64 = 0.8;
/// Standard deviation of full scale by its photons: 10,000 electrons.
const PIXEL_NOISE: f64 = 0.01;
/// Columns and rows of targets, and their distance.
const FIELD: [usize; 2] = [8, 6];
const SPACING_MM: f64 = 110.0;
const RELIEF_MM: f64 = 90.0;
/// A target is the one that lies where it was projected to, pixels.
const NEAR_PX: f64 = 1.5;
const FREE: [Parameter; 5] = [Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1, Parameter::K2];

/// Result of a step of the comparison.
#[derive(Default)]
struct StepResult {
    project: Project,
    found: usize,
    /// Squares of errors of the centres, pixels, and of errors over their standard errors.
    squares: f64,
    normalised: f64,
    coordinates: usize,
}

pub fn run(options: &ExperimentOptions, progress: Progress) -> Result<Experiment> {
    let network = network(options);
    let noise = options.pixel_noise.unwrap_or(PIXEL_NOISE);
    let exact = simulate(&Network { observations: Source::Exact, ..network.clone() })?;
    let mut measured: Vec<StepResult> =
        STEPS.iter().map(|_| StepResult { project: bare(&exact, &network), ..StepResult::default() }).collect();
    let visible = exact.observations.len();
    let work = network.stations.len() * STEPS.len() + 1;
    let detect = DetectOptions::default();
    for (index, station) in network.stations.iter().enumerate() {
        let mut done = index * STEPS.len();
        let mut take = |k: usize, found: Detection| -> Result<()> {
            take(&mut measured[k], &exact, &network, station, &found)?;
            done += 1;
            step(progress, done, work)
        };
        // Light without noise: that of the photons comes with the filters.
        let light = photo(&network, &station.id)?;
        let sensor = exposed(&light, noise, options.seed, index as u64)?;
        take(0, detect_shot(&Shot::Sensor(sensor.clone()), &detect)?)?;
        let of = |grey| detect_photo(&DecodedPhoto { grey, damaged_rows: Vec::new(), page: None }, &detect);
        let developed = Developed::of(&sensor);
        take(1, of(developed.luma())?)?;
        let sharpened = developed.sharpened();
        take(2, of(sharpened.luma())?)?;
        let toned = sharpened.toned();
        take(3, of(toned.luma())?)?;
        for (k, quality) in QUALITIES.into_iter().enumerate() {
            take(4 + k, detect_photo(&decode::photo(&toned.jpeg(quality)?, Channel::Grey)?, &detect)?)?;
        }
    }
    let adjusted: Vec<Adjustment> =
        measured.iter().map(|m| adjust(&m.project, &AdjustOptions::default(), &mut |_| true)).collect::<Result<_>>()?;
    let errors: Vec<[f64; 2]> = adjusted.iter().map(|a| object_errors(&exact, a)).collect();
    let centre = |m: &StepResult| (m.squares / m.coordinates.max(1) as f64).sqrt();
    let mut table = Table::new(
        "sensor_steps",
        &[
            "step",
            "found",
            "centre_rms|px|4",
            "error_over_sigma||2",
            "sigma0||2",
            "object_rms|mm|4",
            "object_sigma|mm|4",
            "over_sites||2",
        ],
    );
    for (k, (m, a)) in measured.iter().zip(&adjusted).enumerate() {
        table.rows.push(vec![
            Cell::from(STEPS[k]),
            Cell::from(m.found),
            Cell::from(centre(m)),
            Cell::from((m.normalised / m.coordinates.max(1) as f64).sqrt()),
            Cell::from(a.sigma0),
            Cell::from(errors[k][0]),
            Cell::from(errors[k][1]),
            Cell::from(errors[k][0] / errors[0][0]),
        ]);
    }
    let line = |value: &dyn Fn(usize) -> f64| (0..STEPS.len()).map(|k| [k as f64, value(k)]).collect::<Vec<_>>();
    let charts = vec![
        Chart::new(
            "sensor_centres",
            "step",
            "centre_rms|px",
            vec![Series::new("centre_rms", line(&|k| centre(&measured[k])))],
        )
        .named(STEPS),
        Chart::new(
            "sensor_objects",
            "step",
            "object_rms|mm",
            vec![
                Series::new("object_rms", line(&|k| errors[k][0])),
                Series::new("object_sigma", line(&|k| errors[k][1])),
            ],
        )
        .named(STEPS),
    ];
    let mut figures = vec![Figure::new("visible", "", visible as f64, None)];
    for k in [0, 4, 5] {
        figures.push(Figure::new(format!("centre_rms/{}", STEPS[k]), "px", centre(&measured[k]), None));
    }
    for k in [0, 4, 5] {
        figures.push(Figure::new(format!("object_rms/{}", STEPS[k]), "mm", errors[k][0], None));
    }
    Ok(Experiment {
        name: "sensor".into(),
        drawings: drawings(options),
        figures,
        tables: vec![table],
        charts,
        assumptions: vec![
            Assumption::new("sharpening", "%", 100.0 * SHARPENED, None),
            Assumption::new("target_diameter", "mm", DIAMETER_MM, None),
            Assumption::new("psf", "px", PSF_PX, None),
            Assumption::new("pixel_noise", "%", 100.0 * noise, None),
        ],
        project: measured.swap_remove(0).project,
    })
}

/// The network for drawing.
pub fn drawings(options: &ExperimentOptions) -> Vec<Drawing> {
    vec![Drawing::of("field", &network(options))]
}

/// The true project without observations, its camera to be calibrated.
fn bare(exact: &Project, network: &Network) -> Project {
    let mut project = Project { observations: Default::default(), ..exact.clone() };
    for (point, of) in project.points.iter_mut().zip(&network.points) {
        point.diameter = of.diameter;
    }
    project
}

/// Takes what was found in a photo into a step's project, and its errors into the sums. The truth is the centre of the circle's image.
fn take(
    measured: &mut StepResult,
    exact: &Project,
    network: &Network,
    station: &Station,
    found: &Detection,
) -> Result<()> {
    let camera = &network.cameras[0];
    let pose = station.pose()?;
    for truth in exact.observations.iter().filter(|o| o.photo == station.id) {
        let Some(point) = network.points.iter().find(|p| p.id == truth.point) else { continue };
        let (Some(normal), Some(diameter)) = (point.normal, point.diameter) else { continue };
        let circle = TargetCircle {
            centre: pose.to_camera(&point.xyz.into()),
            normal: pose.object_to_camera * nalgebra::Vector3::from(normal),
            diameter,
        };
        let [eu, ev] = eccentricity::pixels(camera, &circle).unwrap_or_default();
        let at = [truth.u + eu, truth.v + ev];
        let far = |t: &sightline::detection::Target| (t.u - at[0]).hypot(t.v - at[1]);
        let Some(target) = found.targets.iter().min_by(|a, b| far(a).total_cmp(&far(b))) else { continue };
        if far(target) > NEAR_PX {
            continue;
        }
        measured.found += 1;
        for (error, sigma) in [(target.u - at[0], target.sigma_u), (target.v - at[1], target.sigma_v)] {
            measured.squares += error * error;
            measured.normalised += (error / sigma).powi(2);
            measured.coordinates += 1;
        }
        let mut observation = truth.clone();
        (observation.u, observation.v) = (target.u, target.v);
        observation.sigma = Sigma::Two([target.sigma_u, target.sigma_v]);
        measured.project.observations.push(observation);
    }
    Ok(())
}

/// Rms of errors and of standard errors of the coordinates.
fn object_errors(exact: &Project, adjustment: &Adjustment) -> [f64; 2] {
    let (mut squares, mut variances, mut count) = (0.0, 0.0, 0.0);
    for point in &adjustment.points {
        let truth = exact.points.iter().find(|p| p.id == point.id).and_then(|p| p.xyz);
        let (Some(truth), Some(sigma)) = (truth, point.sigma) else { continue };
        for k in 0..3 {
            squares += (point.xyz[k] - truth[k]).powi(2);
            variances += sigma[k] * sigma[k];
            count += 1.0;
        }
    }
    [squares, variances].map(|sum: f64| (sum / f64::max(count, 1.0)).sqrt())
}

/// The network with its true values.
pub fn network(options: &ExperimentOptions) -> Network {
    let mut interior = Interior::brown(PRINCIPAL_DISTANCE_MM);
    for (parameter, value) in
        [(Parameter::X0, 0.03), (Parameter::Y0, -0.02), (Parameter::K1, -4e-4), (Parameter::K2, 2e-6)]
    {
        interior.set(parameter, value);
    }
    let camera = Camera {
        pixel_pitch: Some([PITCH_MM; 2]),
        free: FREE.to_vec(),
        ..Camera::new("1", SIZE[0], SIZE[1], interior)
    };
    let stations = (0..6).map(|k| Station {
        id: (k + 1).to_string(),
        camera: "1".into(),
        position: [[-650.0, 0.0, 650.0][k % 3], [-380.0, 380.0][k / 3], 1150.0],
        look_at: Some([0.0, 0.0, RELIEF_MM / 2.0]),
        roll: std::f64::consts::FRAC_PI_2 * (k % 4) as f64,
        ..Station::default()
    });
    let points = (0..FIELD[0] * FIELD[1]).map(|k| {
        let (column, row) = (k % FIELD[0], k / FIELD[0]);
        let along = |i: usize, n: usize| SPACING_MM * (i as f64 - (n - 1) as f64 / 2.0);
        NetworkPoint {
            id: (k + 1).to_string(),
            role: Role::Tie,
            xyz: [along(column, FIELD[0]), along(row, FIELD[1]), RELIEF_MM * ((2 * column + row) % 3) as f64 / 2.0],
            normal: Some([0.0, 0.0, 1.0]),
            diameter: Some(DIAMETER_MM),
            grey: Some(0.06),
            ..NetworkPoint::default()
        }
    });
    Network {
        name: "Sensor".into(),
        unit: "mm".into(),
        cameras: vec![camera],
        stations: stations.collect(),
        points: points.collect(),
        faces: vec![Face {
            corner: [-700.0, -600.0, -1.0],
            along: [1400.0, 0.0, 0.0],
            across: [0.0, 1200.0, 0.0],
            grey: 0.6,
            texture: 0.0,
            grain: 1.0,
        }],
        background: 0.3,
        datum: Datum { kind: DatumKind::Free, points: None },
        margin: 16.0,
        sigma: Sigma::One(0.05),
        observations: Source::Rendered,
        seed: options.seed,
        exposure: Exposure { psf: PSF_PX, read_noise: 0.0, shot_noise: 0.0, bits: 16, ..Exposure::default() },
        ..Network::default()
    }
}
