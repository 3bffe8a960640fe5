//! The measurements of Kang and Yeu (1985): plates on a comparator, from fiducial marks to coordinates.
//!
//! The five photos of one of the paper's networks are put on film that shrank differently along and across, seen through
//! a lens with radial distortion, and read on a machine with an origin and turn of its own. The readings go back
//! through the three plane transformations, with and without the distortion table; each time the same bundle follows.
//! The paper prints neither its readings nor the table: both are made up here, of the usual size. Figures of a reduction are root mean squares
//! over several draws of the readings: with one draw, chance decides whether the affine transformation looks worse than the similarity.

use std::fmt::Write;

use super::kang;
use super::outcome::{Assumption, Cell, Chart, Drawing, Experiment, Figure, Series, Table};
use super::{ExperimentOptions, Progress, step};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, ResidualPlace, StatisticsChoice};
use sightline::error::Result;
use sightline::film::comparator::{Observed, Reading, Setup, Upwards, observations};
use sightline::film::distortion::{self, OddPolynomial};
use sightline::film::transformation::Kind;
use sightline::noise::Noise;
use sightline::project::{Parameter, Project, Role};
use sightline_plan::network::{Network, Source, simulate};

/// Calibrated places of eight fiducial marks, mm.
const FIDUCIALS: [(&str, [f64; 2]); 8] = [
    ("F1", [-58.012, 45.987]),
    ("F2", [0.004, 46.021]),
    ("F3", [58.008, 46.013]),
    ("F4", [58.021, -0.006]),
    ("F5", [57.994, -45.992]),
    ("F6", [-0.011, -46.004]),
    ("F7", [-58.003, -46.018]),
    ("F8", [-57.989, 0.009]),
];
/// Calibrated distortion: radius in mm and outward displacement in µm.
const DISTORTION: [[f64; 2]; 12] = [
    [5.0, 0.1],
    [10.0, 0.6],
    [15.0, 1.9],
    [20.0, 4.1],
    [25.0, 7.1],
    [30.0, 10.6],
    [35.0, 14.0],
    [40.0, 16.4],
    [45.0, 17.1],
    [50.0, 15.1],
    [55.0, 9.4],
    [60.0, -1.2],
];
const KINDS: [(Kind, &str); 3] =
    [(Kind::Similarity, "similarity"), (Kind::Affine, "affine"), (Kind::Projective, "projective")];
/// Film: scale along and across, shear, turn and origin of the machine.
const SHRINKAGE: [f64; 3] = [0.99962, 0.99987, 1.1e-4];
const TURN: f64 = 0.021;
const ORIGIN: [f64; 2] = [163.42, 118.75];

/// Draws of the readings that the figures are root mean squares of. Fewer leave the order of the reductions to chance.
const DRAWS: u64 = 10;

/// One way of reduction and what the bundle made of it: mean squares, of which the draws are added one by one.
struct Reduction {
    kind: &'static str,
    corrected: bool,
    marks_sigma0: f64,
    sigma0: f64,
    rms: [f64; 3],
    /// Of all draws together.
    redundancy: usize,
}

pub fn run(options: &ExperimentOptions, progress: Progress) -> Result<Experiment> {
    let network = kang::default_network(options);
    let exact = simulate(&Network { observations: Source::Exact, ..network.clone() })?;
    let radii = DISTORTION.map(|row| row[0]);
    let displacements = DISTORTION.map(|row| row[1] / 1000.0);
    let table = distortion::fit(&radii, &displacements, 3, false)?;
    let mut reductions: Vec<_> =
        KINDS.iter().flat_map(|(_, name)| [false, true].map(|corrected| Reduction::new(name, corrected))).collect();
    let steps = reductions.len() * DRAWS as usize;
    let (mut first, mut fits, mut opened, mut done) = (Vec::new(), Vec::new(), None, 0);
    for draw in 0..DRAWS {
        let drawn = readings(&exact, &table, options, draw);
        for ((kind, name), both) in KINDS.into_iter().zip(reductions.chunks_mut(2)) {
            let observed = observations(&exact.cameras[0], &setup(kind, options), &drawn)?;
            for reduction in both {
                step(progress, done, steps)?;
                done += 1;
                let project = reduced(&network, &observed, reduction.corrected.then_some(&table))?;
                reduction.add(&network, &project, &observed)?;
                if draw == 0 && kind == Kind::Affine && reduction.corrected {
                    opened = Some(project);
                }
            }
            if draw == 0 {
                fits.push((name, observed));
            }
        }
        if draw == 0 {
            first = drawn;
        }
    }
    Ok(Experiment {
        name: "film".into(),
        drawings: drawings(options),
        figures: figures(&reductions, &table),
        tables: vec![
            reduction_table(&reductions),
            residual_table(&fits),
            parameter_table(&fits),
            distortion_table(&table),
            readings_table(&first),
        ],
        charts: vec![chart(&table)],
        assumptions: vec![
            Assumption::of_kind("readings_made_up"),
            Assumption::new("film_draws", "", DRAWS as f64, None),
            Assumption::of_kind("distortion_made_up"),
            Assumption::new("film_scale_along", "", SHRINKAGE[0], None),
            Assumption::new("film_scale_across", "", SHRINKAGE[1], None),
        ],
        project: opened.unwrap_or(exact),
    })
}

/// The network of the five plates.
pub fn drawings(options: &ExperimentOptions) -> Vec<Drawing> {
    let network = kang::default_network(options);
    vec![Drawing::of("1.4-5A", &network)]
}

/// Camera, fiducial marks, distortion table and control of the experiment as a file of the format `comparator`; with
/// the readings it makes the experiment's project.
pub fn description() -> String {
    let network = kang::default_network(&ExperimentOptions::default());
    let mut text =
        String::from("# Plates of the film experiment: camera, fiducial marks (mm), distortion (mm, µm), control\n");
    let camera = &network.cameras[0];
    let c = camera.interior.get(Parameter::C).unwrap_or_default();
    let [width, height] = [camera.width, camera.height].map(|n| f64::from(n) * kang::PITCH_MM);
    let _ = writeln!(
        text,
        "camera, {}\nc, {c}\nplate, {width}, {height}\nsigma, 0.003\ntransformation, affine\ny, up",
        camera.id
    );
    for (mark, [x, y]) in FIDUCIALS {
        let _ = writeln!(text, "fiducial, {mark}, {x}, {y}");
    }
    for [radius, displacement] in DISTORTION {
        let _ = writeln!(text, "distortion, {radius}, {displacement}");
    }
    for point in network.points.iter().filter(|p| p.role == Role::Control) {
        let [x, y, z] = point.xyz;
        let _ = writeln!(text, "control, {}, {x}, {y}, {z}, 0.001", point.id);
    }
    text
}

fn setup(kind: Kind, options: &ExperimentOptions) -> Setup {
    Setup {
        fiducials: FIDUCIALS.iter().map(|(id, place)| ((*id).to_owned(), *place)).collect(),
        kind,
        upwards: Upwards::Yes,
        sigma: options.image_sigma_um.unwrap_or(3.0) / 1000.0,
    }
}

/// What the machine reads of the exact photo coordinates, with errors of a draw of their own.
fn readings(exact: &Project, table: &OddPolynomial, options: &ExperimentOptions, draw: u64) -> Vec<Reading> {
    let sigma = options.image_sigma_um.unwrap_or(3.0) / 1000.0;
    let (s, c) = TURN.sin_cos();
    let mut readings = Vec::new();
    for (index, photo) in exact.photos.iter().enumerate() {
        let mut noise = Noise::new(options.seed.wrapping_add(draw), index as u64);
        let mut read = |mark: &str, [x, y]: [f64; 2], sigma: f64| {
            // Every plate lies a little differently, and shrank by the same.
            let turn = f64::from(index as u32) * 0.003;
            let (x, y) = (SHRINKAGE[0] * x + SHRINKAGE[2] * y, SHRINKAGE[1] * y);
            let (x, y) = (x - turn * y, y + turn * x);
            readings.push(Reading {
                photo: photo.id.clone(),
                mark: mark.to_owned(),
                x: ORIGIN[0] + c * x - s * y + sigma * noise.normal(),
                y: ORIGIN[1] + s * x + c * y + sigma * noise.normal(),
            });
        };
        for (id, place) in FIDUCIALS {
            // Marks are sharp and read several times.
            read(id, place, sigma / 2.0);
        }
        let Some(camera) = exact.cameras.iter().find(|camera| camera.id == photo.camera) else { continue };
        for o in exact.observations.iter().filter(|o| o.photo == photo.id) {
            let [x, y] = camera.photo_from_pixel([o.u, o.v]);
            let r = x.hypot(y);
            let stretch = 1.0 + if r > 0.0 { table.at(r) / r } else { 0.0 };
            read(&o.point, [x * stretch, y * stretch], sigma);
        }
    }
    readings
}

/// The project with the reduced observations, its camera corrected by the table's polynomial or not.
fn reduced(network: &Network, observed: &Observed, table: Option<&OddPolynomial>) -> Result<Project> {
    let mut project = simulate(network)?;
    project.observations = observed.observations.clone().into();
    let coefficients = table.map_or([0.0; 3], OddPolynomial::brown);
    for camera in &mut project.cameras {
        for (parameter, value) in [Parameter::K1, Parameter::K2, Parameter::K3].into_iter().zip(coefficients) {
            camera.interior.set(parameter, value);
        }
    }
    Ok(project)
}

impl Reduction {
    fn new(kind: &'static str, corrected: bool) -> Self {
        Self { kind, corrected, marks_sigma0: 0.0, sigma0: 0.0, rms: [0.0; 3], redundancy: 0 }
    }

    /// Adjusts a draw and adds its squares to the means.
    fn add(&mut self, network: &Network, project: &Project, observed: &Observed) -> Result<()> {
        let options = AdjustOptions {
            residuals: ResidualPlace::Corrected,
            statistics: StatisticsChoice::None,
            ..AdjustOptions::default()
        };
        let adjustment = adjust(project, &options, &mut |_| true)?;
        let ties = network.points.iter().filter(|p| p.role == Role::Tie);
        let off = ties.filter_map(|p| {
            let found = adjustment.points.iter().find(|q| q.id == p.id)?;
            Some([0, 1, 2].map(|k| found.xyz[k] - p.xyz[k]))
        });
        let off: Vec<_> = off.collect();
        let fits: Vec<f64> =
            observed.inner_orientations.iter().filter_map(|i| i.transformation.sigma0).map(|s| 1000.0 * s).collect();
        self.marks_sigma0 += mean_square(&fits) / DRAWS as f64;
        self.sigma0 += adjustment.sigma0.map_or(f64::NAN, |sigma0| sigma0 * sigma0) / DRAWS as f64;
        self.redundancy += adjustment.redundancy;
        for (k, square) in self.rms.iter_mut().enumerate() {
            *square += mean_square(&off.iter().map(|d| d[k]).collect::<Vec<_>>()) / DRAWS as f64;
        }
        Ok(())
    }

    /// S0 with its standard error, S0 / √(2 r) of the redundancy r of all draws.
    fn s0(&self) -> [f64; 2] {
        let sigma0 = self.sigma0.sqrt();
        [sigma0, sigma0 / (2.0 * self.redundancy as f64).sqrt()]
    }
}

fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>() / values.len().max(1) as f64
}

/// Residuals at the marks of the first photo, kind by kind.
fn residual_table(fits: &[(&str, Observed)]) -> Table {
    let mut table = Table::new("fiducials", &["photo", "mark", "kind", "vx|µm|1", "vy|µm|1", "sigma0|µm|1"]);
    for (name, observed) in fits {
        for inner in &observed.inner_orientations {
            for (mark, v) in inner.marks.iter().zip(&inner.transformation.residuals) {
                table.rows.push(vec![
                    inner.photo.as_str().into(),
                    mark.as_str().into(),
                    (*name).into(),
                    (v[0] * 1000.0).into(),
                    (v[1] * 1000.0).into(),
                    inner.transformation.sigma0.map(|s| s * 1000.0).into(),
                ]);
            }
        }
    }
    table
}

fn readings_table(readings: &[Reading]) -> Table {
    let mut table = Table::new("readings", &["photo", "mark", "x|mm|4", "y|mm|4"]);
    let row = |r: &Reading| vec![r.photo.as_str().into(), r.mark.as_str().into(), r.x.into(), r.y.into()];
    table.rows = readings.iter().map(row).collect();
    table
}

fn parameter_table(fits: &[(&str, Observed)]) -> Table {
    let mut table = Table::new("transformations", &["photo", "kind", "parameter", "value||7", "sigma||7"]);
    for (name, observed) in fits {
        for inner in &observed.inner_orientations {
            for p in &inner.transformation.parameters {
                let (photo, parameter) = (inner.photo.as_str(), p.name.as_str());
                table.rows.push(vec![photo.into(), (*name).into(), parameter.into(), p.value.into(), p.sigma.into()]);
            }
        }
    }
    table
}

fn distortion_table(polynomial: &OddPolynomial) -> Table {
    let mut table = Table::new("distortion", &["radius|mm", "table|µm|1", "polynomial|µm|2", "residual|µm|2"]);
    for (row, residual) in DISTORTION.iter().zip(&polynomial.residuals) {
        let fitted = polynomial.at(row[0]) * 1000.0;
        table.rows.push(vec![row[0].into(), row[1].into(), fitted.into(), (residual * 1000.0).into()]);
    }
    table
}

fn reduction_table(reductions: &[Reduction]) -> Table {
    let mut table = Table::new(
        "reductions",
        &[
            "kind",
            "distortion_corrected",
            "marks_sigma0|µm|2",
            "s0||3",
            "s0_sigma||3",
            "rms_x|mm|4",
            "rms_y|mm|4",
            "rms_z|mm|4",
        ],
    );
    for r in reductions {
        let mut row: Vec<Cell> = vec![r.kind.into(), if r.corrected { "yes" } else { "no" }.into()];
        row.push(r.marks_sigma0.sqrt().into());
        row.extend(r.s0().map(Cell::from));
        row.extend(r.rms.map(|square| Cell::from(square.sqrt())));
        table.rows.push(row);
    }
    table
}

fn figures(reductions: &[Reduction], table: &OddPolynomial) -> Vec<Figure> {
    let label = |r: &Reduction| format!("{}{}", r.kind, if r.corrected { "-corrected" } else { "" });
    let mut list: Vec<_> = reductions
        .iter()
        .flat_map(|r| {
            [
                // The paper's adjustment assumes 1.
                Figure::new(format!("sigma0/{}", label(r)), "", r.s0()[0], r.corrected.then_some(1.0)),
                Figure::new(format!("marks_sigma0/{}", label(r)), "µm", r.marks_sigma0.sqrt(), None),
            ]
        })
        .collect();
    list.push(Figure::new("distortion_sigma0", "µm", table.sigma0.unwrap_or(f64::NAN) * 1000.0, None));
    list
}

fn chart(table: &OddPolynomial) -> Chart {
    let fitted = (0..=60).map(|k| [f64::from(k), table.at(f64::from(k)) * 1000.0]).collect();
    let given = Series::new("table", DISTORTION.to_vec());
    Chart::new("distortion", "radius|mm", "distortion|µm", vec![Series::new("polynomial", fitted), given])
}
