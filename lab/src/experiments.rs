//! The three papers as runnable experiments, and one of our own: the same networks, simulated and adjusted here, and compared with
//! the papers' figures.
//!
//! | name | paper | question |
//! | --- | --- | --- |
//! | `kang` | Kang and Yeu 1985 | How much do more photos improve coordinates? |
//! | `film` | the same | What do fiducial marks and a distortion table make of comparator readings? |
//! | `lee-calibration` | Lee 1996, chapter 4 | How well does a camera calibrate itself, from the pixels on? |
//! | `lee-structure` | Lee 1996, chapter 5 | What do convergent photos and a free network give? |
//! | `kim` | Kim, Hwang and Yun 2015 | How near does a pair of photos come, from DLT to intersected points? |
//! | `sensor` | none | What do centres and coordinates lose between the sensor's samples and a camera's JPEG? |
//!
//! Results are data: identifiers, numbers and units, no sentences. Callers write them in the user's language.

mod csv;
mod film;
mod kang;
mod kim;
mod lee_calibration;
mod lee_structure;
mod outcome;
mod sensor;

use crate::reason::LabReason;
use serde::{Deserialize, Serialize};

use sightline::detection::Method;
use sightline::error::{Error, Place, Result, Thing};
use sightline::project::Plan;
use sightline_plan::from_network;

pub use csv::csv;
pub use film::description as film_description;
pub use outcome::{Assumption, Axis, Cell, Chart, Column, Drawing, Drawn, Experiment, Figure, Series, Table, Tick};

/// Names of the experiments.
pub const NAMES: [&str; 6] = ["kang", "film", "lee-calibration", "lee-structure", "kim", "sensor"];

/// What may be varied. Whatever is none has the paper's value; what an experiment does not know it ignores.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ExperimentOptions {
    /// Seed of all noise.
    pub seed: u64,
    /// Standard deviation of image coordinates, µm (kang, film, lee-structure).
    pub image_sigma_um: Option<f64>,
    /// Standard deviation of the pixels' noise, share of full scale (lee-calibration, kim, sensor).
    pub pixel_noise: Option<f64>,
    /// Standard error of control coordinates, mm (kang, lee-structure, kim).
    pub control_sigma_mm: Option<f64>,
    /// Rounds of Monte Carlo (kang).
    pub rounds: Option<usize>,
    /// Network of the project to open, as `1.4-5A` (kang), `H` or `H'` (kang, mixed distances), `I-control`, `I-free` …
    /// (lee-structure).
    pub network: Option<String>,
    /// Photos left out of the second run (lee-calibration).
    pub left_out: Option<Vec<String>>,
    /// How centres are measured for the adjustment (lee-calibration).
    pub method: Option<Method>,
}

impl Default for ExperimentOptions {
    fn default() -> Self {
        Self {
            seed: 1,
            image_sigma_um: None,
            pixel_noise: None,
            control_sigma_mm: None,
            rounds: None,
            network: None,
            left_out: None,
            method: None,
        }
    }
}

/// Tells how far an experiment is: steps done and steps in all. Returning false stops it.
pub type Progress<'a> = &'a mut dyn FnMut(usize, usize) -> bool;

/// Runs an experiment.
///
/// # Errors
/// [`Error::Unknown`] for another name, [`Error::Invalid`] for options out of range, [`Error::Cancelled`] when stopped.
pub fn run(name: &str, options: &ExperimentOptions, progress: Progress) -> Result<Experiment> {
    check(options)?;
    match name {
        "kang" => kang::run(options, progress),
        "film" => film::run(options, progress),
        "lee-calibration" => lee_calibration::run(options, progress),
        "lee-structure" => lee_structure::run(options, progress),
        "kim" => kim::run(options, progress),
        "sensor" => sensor::run(options, progress),
        _ => Err(Error::Unknown { kind: Thing::Experiment, name: name.into(), at: Place::default() }),
    }
}

/// The networks of an experiment, for drawing them before it runs.
///
/// # Errors
/// As [`run`].
pub fn drawings(name: &str, options: &ExperimentOptions) -> Result<Vec<Drawing>> {
    check(options)?;
    match name {
        "kang" => kang::drawings(options),
        "film" => Ok(film::drawings(options)),
        "lee-calibration" => Ok(lee_calibration::drawings(options)),
        "lee-structure" => lee_structure::drawings(options),
        "kim" => Ok(kim::drawings(options)),
        "sensor" => Ok(sensor::drawings(options)),
        _ => Err(Error::Unknown { kind: Thing::Experiment, name: name.into(), at: Place::default() }),
    }
}

/// An experiment's network as a plan to begin with; `None` for those that plan no photos.
pub fn plan(name: &str) -> Option<Plan> {
    let options = ExperimentOptions::default();
    let network = match name {
        "kang" => kang::example(&options),
        "lee-calibration" => lee_calibration::network(&options),
        "lee-structure" => lee_structure::network("I", &options),
        "kim" => kim::network(&options),
        _ => return None,
    };
    Some(from_network(&network))
}

/// Maximum number of rounds of Monte Carlo: half an hour in a browser.
const ROUNDS_LIMIT: usize = 100_000;

fn check(options: &ExperimentOptions) -> Result<()> {
    let invalid = |reason, field: &str| Err(Error::Invalid { reason, at: Place::field(field) });
    let outside = |value: Option<f64>, low: f64, high: f64| value.is_some_and(|v| !(low..=high).contains(&v));
    if outside(options.image_sigma_um, 0.01, 1000.0) {
        return invalid(LabReason::ImageNoise.into(), "image_sigma_um");
    }
    if outside(options.pixel_noise, 0.0, 0.2) {
        return invalid(LabReason::PixelNoise.into(), "pixel_noise");
    }
    if outside(options.control_sigma_mm, 1e-6, 1000.0) {
        return invalid(LabReason::ControlSigma.into(), "control_sigma_mm");
    }
    if options.rounds.is_some_and(|n| n > ROUNDS_LIMIT) {
        return invalid(LabReason::Rounds { limit: ROUNDS_LIMIT }.into(), "rounds");
    }
    Ok(())
}

/// Counts a step; an error if the caller cancels.
fn step(progress: &mut dyn FnMut(usize, usize) -> bool, done: usize, of: usize) -> Result<()> {
    if progress(done, of) { Ok(()) } else { Err(Error::Cancelled) }
}
