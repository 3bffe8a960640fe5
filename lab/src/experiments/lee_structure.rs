//! Lee (1996), chapter 5: a wall in convergent and normal photos, with control and as a free network.
//!
//! Thirty-eight targets on a wall of 6.32 x 3.45 m, a DCS420, 3 µm in the image, four control points of 0.01 mm. Network I
//! has six convergent photos from three stations (roll 0° and 90°), II five normal ones along the base and two
//! convergent ones at its ends, III all thirteen. At the 5.5 m that the paper names, this camera sees 3.7 x 2.5 m of the
//! wall; here the base line is 8.5 m away, so that the upright ones hold the whole wall and the rolled ones most of it.
//! Network I has 181 rays, the paper's 374 equations, at 7.4 m; from there the normal photos of II would not see the
//! upper and lower rows. The outer stations of I are assumed; from 5 to 7.5 m the order III, I, II in depth is the same.
//!
//! The additional parameters are observed with the standard errors of the first experiment's calibration, and once more
//! free, as in the paper. A wall hardly determines a camera: where nothing but the normal photos of II does, four control
//! points add to the calibration what the free datum does without, and its gain in X and Z turns into a loss.
//!
//! The standard errors are √q, those of S0 = 1, over the targets that are not control, the same in both datums.

use std::f64::consts::FRAC_PI_2;

use super::outcome::{Assumption, Cell, Chart, Drawing, Experiment, Figure, Series, Table};
use super::{ExperimentOptions, Progress, lee_calibration, step};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, ResidualPlace, StatisticsChoice};
use sightline::error::{Error, Place, Result, Thing};
use sightline::project::{Datum, DatumKind, Parameter, Project, Role, Sigma};
use sightline_plan::network::{Network, NetworkPoint, Station, simulate};

const NETWORKS: [&str; 3] = ["I", "II", "III"];
/// Standard errors X, Y, Z in mm that the paper gives, with control and free.
const PAPER: [[[f64; 3]; 2]; 3] = [
    [[0.388, 0.534, 0.308], [0.273, 0.367, 0.225]],
    [[0.422, 1.519, 0.386], [0.274, 0.956, 0.253]],
    [[0.259, 0.489, 0.234], [0.206, 0.374, 0.184]],
];
/// The gain in Z of network I as the paper's table 5 prints it, in percent: its tables 3 and 4 give 26.9.
const MISPRINT: f64 = 17.2;
/// N of 1 : N, with control and free.
const PAPER_RELATIVE: [[f64; 2]; 3] = [[13_000.0, 18_700.0], [7_000.0, 11_100.0], [16_500.0, 21_100.0]];
/// Width and height of the wall, mm.
const WALL: [f64; 2] = [6320.0, 3450.0];
/// Distance of the base line from the wall, mm.
const DISTANCE: f64 = 8500.0;
/// How far the outer stations of network I lie from its middle along the base line, mm; assumed.
const OUTER: f64 = 7500.0;
/// Height of the pillars on the wall, mm; assumed.
const RELIEF: f64 = 60.0;
/// Standard errors of the additional parameters as the second run of the first experiment leaves them.
const CALIBRATED: [(Parameter, f64); 8] = [
    (Parameter::C, 0.0012),
    (Parameter::X0, 0.0016),
    (Parameter::Y0, 0.0014),
    (Parameter::K1, 4.3e-6),
    (Parameter::K2, 1.5e-7),
    (Parameter::K3, 1.8e-9),
    (Parameter::P1, 1.1e-6),
    (Parameter::P2, 1.0e-6),
];
const DATUMS: [(&str, DatumKind); 2] = [("control", DatumKind::Control), ("free", DatumKind::Free)];

/// Result of one adjustment.
struct StructureResult {
    errors: [f64; 3],
    equations: usize,
    unknowns: usize,
    sigma0: f64,
    relative: f64,
}

pub fn run(options: &ExperimentOptions, progress: Progress) -> Result<Experiment> {
    let mut outcomes = Vec::new();
    let mut released = Vec::new();
    let mut opened = None;
    let wanted = options.network.as_deref().unwrap_or("I-free");
    for name in NETWORKS {
        let network = network(name, options);
        let project = simulate(&network)?;
        for (label, kind) in DATUMS {
            step(progress, outcomes.len(), 2 * NETWORKS.len())?;
            let project = with_datum(&project, kind);
            outcomes.push(solve(&project)?);
            // A network that does not determine the camera is a row without figures.
            released.push(solve(&with_free_parameters(&project)).ok());
            if wanted == format!("{name}-{label}") {
                opened = Some(project);
            }
        }
    }
    let unknown = || Error::Unknown { kind: Thing::Network, name: wanted.into(), at: Place::field("network") };
    let (errors, gains) = tables(&outcomes, &released);
    Ok(Experiment {
        name: "lee-structure".into(),
        drawings: drawings(options)?,
        figures: figures(&outcomes),
        tables: vec![errors, gains],
        charts: charts(&outcomes),
        assumptions: vec![
            Assumption::new("base_distance", "mm", DISTANCE, 5500.0),
            Assumption::new("ray_on_wall", "mm", ray_on_wall(options), None),
            Assumption::new("outer_stations", "mm", OUTER, None),
            Assumption::new("relief", "mm", RELIEF, None),
            Assumption::of_kind("parameters_observed"),
            Assumption::new("gain_misprint", "%", paper_gain(0)[2], MISPRINT),
        ],
        project: opened.ok_or_else(unknown)?,
    })
}

/// The network of the project, and the others.
pub fn drawings(options: &ExperimentOptions) -> Result<Vec<Drawing>> {
    let wanted = options.network.as_deref().unwrap_or("I-free");
    let first = wanted.split('-').next().unwrap_or_default();
    if !NETWORKS.contains(&first) {
        return Err(Error::Unknown { kind: Thing::Network, name: wanted.into(), at: Place::field("network") });
    }
    let others = NETWORKS.into_iter().filter(|name| *name != first);
    Ok(std::iter::once(first).chain(others).map(|name| Drawing::of(name, &network(name, options))).collect())
}

/// Standard error of one ray across its direction on the wall, mm, two digits: why the paper's figures cannot be had from here.
fn ray_on_wall(options: &ExperimentOptions) -> f64 {
    let c = lee_calibration::dcs420().interior.get(Parameter::C).unwrap_or(f64::NAN);
    let ray = options.image_sigma_um.unwrap_or(3.0) / 1000.0 * DISTANCE / c;
    (ray * 100.0).round() / 100.0
}

/// A network of the wall.
pub fn network(name: &str, options: &ExperimentOptions) -> Network {
    let mut camera = lee_calibration::dcs420();
    camera.sigma = CALIBRATED.into_iter().collect();
    let sigma_mm = options.image_sigma_um.unwrap_or(3.0) / 1000.0;
    let sigma = Sigma::One(sigma_mm / camera.pitch()[0]);
    let mut stations = Vec::new();
    if name != "II" {
        for (k, x) in [-OUTER, 0.0, OUTER].into_iter().enumerate() {
            let position = [x, -DISTANCE, if k == 1 { 900.0 } else { 0.0 }];
            for (turn, roll) in [("a", 0.0), ("b", FRAC_PI_2)] {
                stations.push(Station::aimed(format!("{}{turn}", k + 1), &camera.id, position, [0.0; 3], roll));
            }
        }
    }
    if name != "I" {
        for k in 0..5 {
            let x = f64::from(k - 2) * 800.0;
            let aim = [x, 0.0, 0.0];
            stations.push(Station::aimed(format!("n{}", k + 1), &camera.id, [x, -DISTANCE, 0.0], aim, 0.0));
        }
        for (k, x) in [-3600.0, 3600.0].into_iter().enumerate() {
            stations.push(Station::aimed(format!("c{}", k + 1), &camera.id, [x, -DISTANCE, 0.0], [0.0; 3], 0.0));
        }
    }
    Network {
        name: format!("Lee 1996, {name}"),
        cameras: vec![camera],
        stations,
        points: points(options),
        datum: Datum { kind: DatumKind::Control, points: None },
        sigma,
        seed: options.seed,
        ..Network::default()
    }
}

/// Rows of 8, 7, 8, 7, 8 targets; four of the outer ones are control.
fn points(options: &ExperimentOptions) -> Vec<NetworkPoint> {
    let sigma = options.control_sigma_mm.unwrap_or(0.01);
    let mut points = Vec::new();
    for row in 0..5 {
        let count = if row % 2 == 0 { 8 } else { 7 };
        for column in 0..count {
            let x = (f64::from(column) - f64::from(count - 1) / 2.0) * WALL[0] / 7.0;
            let z = (f64::from(row) / 4.0 - 0.5) * WALL[1];
            // A structure is not a plane: pillars and recesses of some centimetres.
            let y = if (column + row) % 3 == 0 { -RELIEF } else { 0.0 };
            let control = (row == 0 || row == 4) && (column == 1 || column == 6);
            points.push(NetworkPoint {
                id: (points.len() + 1).to_string(),
                role: if control { Role::Control } else { Role::Tie },
                xyz: [x, y, z],
                sigma: control.then_some([Some(sigma); 3]),
                ..NetworkPoint::default()
            });
        }
    }
    points
}

fn with_datum(project: &Project, kind: DatumKind) -> Project {
    let mut project = project.clone();
    project.datum.kind = kind;
    project.name.push_str(if kind == DatumKind::Free { ", free" } else { ", control" });
    project
}

/// The same with all additional parameters unknown.
fn with_free_parameters(project: &Project) -> Project {
    let mut project = project.clone();
    for camera in &mut project.cameras {
        camera.sigma.clear();
        camera.free = CALIBRATED.map(|(parameter, _)| parameter).to_vec();
    }
    project
}

fn solve(project: &Project) -> Result<StructureResult> {
    let choice = AdjustOptions {
        statistics: StatisticsChoice::Precision,
        residuals: ResidualPlace::Corrected,
        ..AdjustOptions::default()
    };
    let adjustment = adjust(project, &choice, &mut |_| true)?;
    let sigma0 = adjustment.sigma0.unwrap_or(f64::NAN);
    let ties: Vec<_> = project.points.iter().filter(|p| p.role == Role::Tie).map(|p| &p.id).collect();
    let sigmas: Vec<_> = adjustment.points.iter().filter(|p| ties.contains(&&p.id)).filter_map(|p| p.sigma).collect();
    let mean = |k: usize| sigmas.iter().map(|s| s[k] / sigma0).sum::<f64>() / sigmas.len().max(1) as f64;
    let errors = [0, 1, 2].map(mean);
    let size = adjustment.precision.as_ref().map_or(f64::NAN, |p| p.largest_dimension);
    Ok(StructureResult {
        errors,
        equations: adjustment.observations_count,
        unknowns: adjustment.unknowns,
        sigma0,
        relative: size / (errors.iter().sum::<f64>() / 3.0),
    })
}

/// How many percent the free network is better than control, per axis.
fn gain(outcomes: &[StructureResult], network: usize) -> [f64; 3] {
    let [control, free] = [&outcomes[2 * network].errors, &outcomes[2 * network + 1].errors];
    [0, 1, 2].map(|k| 100.0 * (1.0 - free[k] / control[k]))
}

/// The same of the paper's standard errors. Its table 5 prints these, but for [`MISPRINT`].
fn paper_gain(network: usize) -> [f64; 3] {
    let [control, free] = PAPER[network];
    [0, 1, 2].map(|k| 100.0 * (1.0 - free[k] / control[k]))
}

fn tables(outcomes: &[StructureResult], released: &[Option<StructureResult>]) -> (Table, Table) {
    let mut errors = Table::new(
        "standard_errors",
        &[
            "network",
            "datum",
            "parameters",
            "equations",
            "unknowns",
            "sx|mm|3",
            "*sx|mm|3",
            "sy|mm|3",
            "*sy|mm|3",
            "sz|mm|3",
            "*sz|mm|3",
            "relative|1 : N",
            "*relative|1 : N",
            "sigma0||2",
        ],
    );
    let mut gains = Table::new("free_gain", &["network", "x|%|1", "*x|%|1", "y|%|1", "*y|%|1", "z|%|1", "*z|%|1"]);
    let mut line = |i: usize, d: usize, parameters: &str, o: Option<&StructureResult>| {
        let mut row: Vec<Cell> = vec![NETWORKS[i].into(), DATUMS[d].0.into(), parameters.into()];
        row.extend([o.map(|o| o.equations as f64), o.map(|o| o.unknowns as f64)].map(Cell::from));
        (0..3).for_each(|k| row.extend([Cell::from(o.map(|o| o.errors[k])), PAPER[i][d][k].into()]));
        row.extend([o.map(|o| o.relative).into(), PAPER_RELATIVE[i][d].into(), o.map(|o| o.sigma0).into()]);
        errors.rows.push(row);
    };
    for (parameters, list) in [
        ("observed", outcomes.iter().map(Some).collect::<Vec<_>>()),
        ("unknown", released.iter().map(Option::as_ref).collect()),
    ] {
        (0..2 * NETWORKS.len()).for_each(|k| line(k / 2, k % 2, parameters, list[k]));
    }
    for (i, name) in NETWORKS.into_iter().enumerate() {
        let mut row: Vec<Cell> = vec![name.into()];
        (0..3).for_each(|k| row.extend([Cell::from(gain(outcomes, i)[k]), paper_gain(i)[k].into()]));
        gains.rows.push(row);
    }
    (errors, gains)
}

fn figures(outcomes: &[StructureResult]) -> Vec<Figure> {
    let axes = ["x", "y", "z"];
    let mut list = Vec::new();
    for (i, name) in NETWORKS.into_iter().enumerate() {
        for (d, (label, _)) in DATUMS.into_iter().enumerate() {
            for k in 0..3 {
                let ours = outcomes[2 * i + d].errors[k];
                list.push(Figure::new(format!("s{}/{name}-{label}", axes[k]), "mm", ours, PAPER[i][d][k]));
            }
            let relative = outcomes[2 * i + d].relative;
            list.push(Figure::new(format!("relative/{name}-{label}"), "1 : N", relative, PAPER_RELATIVE[i][d]));
        }
        for k in 0..3 {
            list.push(Figure::new(format!("gain_{}/{name}", axes[k]), "%", gain(outcomes, i)[k], paper_gain(i)[k]));
        }
    }
    list.push(Figure::new("equations/I", "", outcomes[0].equations as f64, 374.0));
    list.push(Figure::new("unknowns/I", "", outcomes[0].unknowns as f64, 165.0));
    list
}

/// The paper's figure 8, a chart for each axis.
fn charts(outcomes: &[StructureResult]) -> Vec<Chart> {
    let of_axis = |(k, axis): (usize, &str)| {
        let mut series = Vec::new();
        for (d, (label, _)) in DATUMS.into_iter().enumerate() {
            let ours = (0..3).map(|i| [i as f64, outcomes[2 * i + d].errors[k]]).collect();
            let paper = (0..3).map(|i| [i as f64, PAPER[i][d][k]]).collect();
            series.push(Series::new(format!("s{axis}/{label}"), ours));
            series.push(Series { paper: true, ..Series::new(format!("s{axis}/{label}"), paper) });
        }
        Chart::new(format!("standard_errors/{axis}"), "network", "standard_error|mm", series).named(NETWORKS)
    };
    ["x", "y", "z"].into_iter().enumerate().map(of_axis).collect()
}
