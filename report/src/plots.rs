//! Plots as SVG, each with its title and a sentence that explains it: in the report, on the desk and as files.
//!
//! They have no style of their own: classes get their colours from `plots.css`, whose variables are the desk's themes or the report's
//! print colours.

mod chart;
mod comparison;
mod convergence;
mod deviations;
pub(super) mod displacements;
mod distortion;
mod histogram;
pub(super) mod network;
mod radius;
mod rays;
mod redundancy;
mod residuals;
mod sigmas;
mod significance;
mod svg;

use serde::{Deserialize, Serialize};

use super::context::Context;
use super::html::escaped;
use sightline::adjustment::Adjustment;
use sightline::comparison::Comparison;
use sightline::error::Result;
use sightline::project::Project;

/// Position of a plot in the report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Group {
    /// The lens.
    Cameras,
    /// Stations, rays and precision.
    Network,
    /// The points' precision.
    Points,
    /// Tests of the observations.
    Statistics,
    /// Residuals.
    Residuals,
    /// Forms measured on the object.
    Features,
}

/// A plot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// Name for files, the same in every language.
    pub name: String,
    /// Where it belongs.
    pub group: Group,
    /// Of one photo among many: shown small.
    pub small: bool,
    /// Its title.
    pub title: String,
    /// What it shows.
    pub sentence: String,
    /// The drawing.
    pub svg: String,
}

/// Style of plots wherever they stand.
pub const STYLE: &str = include_str!("plots.css");

impl Plot {
    /// A file of its own, with its style.
    pub fn file(&self) -> String {
        let style = format!("<style>{}</style>", escaped(STYLE));
        self.svg.replacen("><title>", &format!(" xmlns=\"http://www.w3.org/2000/svg\">{style}<title>"), 1)
    }
}

/// Every plot of a result.
pub(super) fn all(context: &Context) -> Vec<Plot> {
    let mut all = Vec::new();
    all.extend(distortion::plots(context));
    all.extend(significance::plots(context));
    all.extend(network::picture(context));
    all.extend(network::plots(context));
    all.extend(rays::plots(context));
    all.extend(sigmas::plots(context));
    all.extend(histogram::plots(context));
    all.extend(convergence::plots(context));
    all.extend(residuals::all_in_one(context));
    all.extend(radius::plots(context));
    all.extend(redundancy::plots(context));
    all.extend(deviations::plots(context));
    all.extend(residuals::plots(context));
    all
}

/// The plots of an adjusted project, in the language of its report.
///
/// # Errors
/// As [`super::report`].
pub fn plots(project: &Project, adjustment: Option<&Adjustment>) -> Result<Vec<Plot>> {
    Ok(all(&super::context(project, adjustment)?))
}

/// Differences between an adjustment and an earlier one; `None` if fewer than two points can be compared.
///
/// # Errors
/// As [`super::report`].
pub fn comparison(project: &Project, adjustment: Option<&Adjustment>, found: &Comparison) -> Result<Option<Plot>> {
    Ok(comparison::plot(&super::context(project, adjustment)?, found))
}

/// Standard error of the radial distortion of a brown camera at an image radius, in photo units; `None` without statistics.
pub fn radial_sigma(camera: &sightline::adjustment::AdjustedCamera, radius: f64) -> Option<f64> {
    distortion::radial_sigma(camera, radius)
}

/// Name of the plot of a feature's deviations.
pub fn deviations_name(feature: &str) -> String {
    format!("deviations-{}", file_name(feature))
}

/// Maximum number of points or vectors in a drawing: more merge into one dark area and take megabytes in the file.
const MARKS: usize = 3000;
/// The same for the small drawings, one per photo.
const SMALL_MARKS: usize = 500;

/// The n of "every n-th is drawn", so that of `count` marks at most `at_most` are.
fn every_nth(count: usize, at_most: usize) -> usize {
    count.div_ceil(at_most).max(1)
}

/// The sentence of a plot; if not all marks are drawn, it states which share is.
fn drawn_sentence(sentence: String, every: usize, context: &Context) -> String {
    if every == 1 { sentence } else { format!("{sentence} {}", context.words.plot_one_in(&every)) }
}

/// A name as a file has it.
fn file_name(text: &str) -> String {
    text.chars().map(|c| if c.is_alphanumeric() || matches!(c, '-' | '_' | '.') { c } else { '-' }).take(60).collect()
}
