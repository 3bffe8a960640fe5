//! Planning: predicted accuracy of photos, the best next photo, and plans computed from scratch.
//!
//! A station sees a target that is in its picture, turned towards it, not hidden, large enough and sharp. The rays make the
//! network's normal equations, those of the adjustment ([`sightline::adjust::predict`]); their inverse has the standard errors that
//! the adjustment of such photos will find.

mod candidates;
mod form;
mod judgement;
mod make;
pub mod network;
mod origin;
mod parts;
pub mod reason;
pub mod render;
mod repeated;
pub mod scene;
mod setup;
mod sight;
mod suggest;

use serde::{Deserialize, Serialize};

use sightline::adjustment::{AdjustedCamera, Advice};
use sightline::error::{Defect, Result};
use sightline::monitoring::{Detectable, ReferenceFrom};
use sightline::project::{Parameter, Plan, PlanStation};

pub use form::{check_form, faces_on, least_diameter, targets_on};
pub use make::{Ended, Made, MakeOptions, make};
pub use origin::{from_network, from_project};
pub use suggest::{Suggested, suggest};

use judgement::judged;
use setup::Setup;

/// Tells how far the work is: steps done and steps in all. Returning false stops it.
pub type Progress<'a> = &'a mut dyn FnMut(usize, usize) -> bool;

/// Criteria of a plan.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Criterion {
    /// The largest half axis of all points.
    #[default]
    Worst,
    /// The rms of the largest half axes.
    Mean,
    /// The largest half axis of these points.
    Points {
        /// Their identifiers.
        points: Vec<String>,
    },
    /// The standard error of a parameter of the first camera.
    Parameter {
        /// Which.
        parameter: Parameter,
    },
}

/// Why a station does not see so many points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Unseen {
    /// They are not in its picture.
    pub outside: usize,
    /// They face away.
    pub turned_away: usize,
    /// A face stands before them.
    pub hidden: usize,
    /// Their images are too small.
    pub too_small: usize,
    /// They are out of focus.
    pub blurred: usize,
}

/// Points visible from a station.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StationSight {
    /// Identifier of the photo.
    pub id: String,
    /// Points that it sees.
    pub points: Vec<String>,
    /// How many it does not see, and why.
    pub unseen: Unseen,
    /// Median distance to the points it sees; null if it sees none.
    pub distance: Option<f64>,
    /// Smallest image of a target it sees, pixels across; null without diameters.
    pub smallest_px: Option<f64>,
    /// Unit vector it looks along.
    pub direction: [f64; 3],
    /// Corners of its picture as directions of unit length, clockwise from the top left.
    pub corners: [[f64; 3]; 4],
    /// Whether it is in a region without access.
    pub forbidden: bool,
}

/// Prediction for a point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PredictedPoint {
    /// Identifier.
    pub id: String,
    /// Photos that see it.
    pub rays: usize,
    /// Largest angle between two of its rays, at most 90°, radians.
    pub angle: f64,
    /// Standard errors; null if it is not determined.
    pub sigma: Option<[f64; 3]>,
    /// xx, xy, xz, yy, yz, zz.
    pub covariance: Option<[f64; 6]>,
    /// Largest half axis of its standard ellipsoid.
    pub axis: Option<f64>,
    /// Smallest displacement that a comparison with a second, identical campaign detects; null if undetermined or if [`Prediction::repeated`]
    /// is null.
    #[serde(default)]
    pub detectable: Option<Detectable>,
}

/// Comparison of two campaigns as planned: the tests of [`sightline::monitoring`] with their default options, in the datum of the reference points.
/// Detectable displacements of object points are found with `power`, those of reference points, which the global test must reject first, with at
/// least that power.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Repeated {
    /// Reference points.
    pub reference: Vec<String>,
    /// Where they come from.
    pub reference_from: ReferenceFrom,
    /// Error probability of every family of tests.
    pub significance: f64,
    /// Share of such displacements that are found.
    pub power: f64,
    /// Degrees of freedom of both campaigns' variance factor; with 0 the standard errors count as exact.
    pub redundancy: usize,
    /// Point with the largest of the smallest detectable displacements.
    pub point: Option<String>,
    /// That displacement, along the least favourable direction.
    pub largest: Option<f64>,
}

/// Deficiencies of a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Lacking {
    /// There are no photos.
    NoPhotos,
    /// There are no points.
    NoPoints,
    /// Points without two rays that meet.
    Undetermined {
        /// Which.
        points: Vec<String>,
    },
    /// The network is not determined.
    Defect {
        /// Why.
        defect: Defect,
    },
    /// Points whose precision is not reached.
    Beyond {
        /// Which, the worst first.
        points: Vec<String>,
    },
    /// Photos in regions without access.
    Forbidden {
        /// Which.
        stations: Vec<String>,
    },
}

/// Prediction for a plan. Standard errors are those of the chosen datum, in the project's unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Prediction {
    /// The stations in their order.
    pub stations: Vec<StationSight>,
    /// The points in their order.
    pub points: Vec<PredictedPoint>,
    /// Cameras with what is predicted of their parameters.
    pub cameras: Vec<AdjustedCamera>,
    /// The point with the largest half axis.
    pub worst: Option<String>,
    /// That half axis.
    pub largest: Option<f64>,
    /// Rms of the largest half axes.
    pub rms: Option<f64>,
    /// From standard errors to the wanted probability, along one axis.
    pub factor: f64,
    /// n - u + d; null if the network is not determined.
    pub redundancy: Option<usize>,
    /// Whether every point reaches what is wanted.
    pub reached: bool,
    /// Deficiencies.
    pub lacks: Vec<Lacking>,
    /// Weaknesses of the network.
    pub advice: Vec<Advice>,
    /// How a second campaign like this is compared with the first; null with fewer than four reference points or more than 500, and where
    /// the network is not determined without given coordinates.
    #[serde(default)]
    pub repeated: Option<Repeated>,
}

/// Predicts what the plan's photos give.
///
/// # Errors
/// [`crate::Error::Invalid`], [`crate::Error::Unknown`] and [`crate::Error::Duplicate`] for what cannot be a plan. That a plan does not determine its
/// points is a result.
pub fn predict(plan: &Plan) -> Result<Prediction> {
    let setup = Setup::new(plan)?;
    let shots = plan.stations.iter().map(|station| setup.shot(station)).collect::<Result<Vec<_>>>()?;
    Ok(judged(&setup, &shots))
}

/// Predictions of several sets of stations on the plan's object, to compare.
///
/// # Errors
/// As [`predict`].
pub fn compare(plan: &Plan, sets: &[Vec<PlanStation>]) -> Result<Vec<Prediction>> {
    let setup = Setup::new(plan)?;
    let one = |stations: &Vec<PlanStation>| {
        let shots = stations.iter().map(|station| setup.shot(station)).collect::<Result<Vec<_>>>()?;
        Ok(judged(&setup, &shots))
    };
    sets.iter().map(one).collect()
}

#[cfg(test)]
mod tests;
