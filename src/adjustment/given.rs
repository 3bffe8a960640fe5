//! Observations of other kinds than image coordinates in the result, and the record of the search for gross errors.

use serde::{Deserialize, Serialize};

use crate::project::Parameter;
use crate::statistics::reliability::Reliability;

/// An observation of another kind than image coordinates, after the adjustment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GivenObservation {
    /// The observation.
    #[serde(flatten)]
    pub what: Given,
    /// Residual, adjusted minus given, in the observation's own unit; null if what was observed is not adjusted.
    pub residual: Option<f64>,
    /// A priori standard error.
    pub sigma: f64,
    /// Redundancy number, w and minimal detectable bias; null without full statistics.
    #[serde(default)]
    pub reliability: Option<Reliability>,
    /// External reliability: how far the detectable bias, undetected, moves the point that it moves most, in the project's
    /// unit; null if the redundancy number is 0 and without full statistics.
    #[serde(default)]
    pub effect: Option<f64>,
    /// That point: the control point itself, an end of the distance, a point of the photo, a point the camera sees.
    #[serde(default)]
    pub effect_point: Option<String>,
    /// Factor on the weight from robust weighting; null if it is 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
    /// Whether it took part; false if data snooping took it out.
    #[serde(default = "yes")]
    pub enabled: bool,
}

fn yes() -> bool {
    true
}

/// Kinds of observations besides image coordinates.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Given {
    /// A control coordinate.
    Control {
        /// Point identifier.
        point: String,
        /// 0, 1, 2 for X, Y, Z.
        axis: usize,
    },
    /// A projection centre's coordinate.
    Position {
        /// Photo identifier.
        photo: String,
        /// 0, 1, 2 for X, Y, Z.
        axis: usize,
    },
    /// A distance.
    Distance {
        /// One end.
        from: String,
        /// Other end.
        to: String,
    },
    /// A parameter of an interior orientation.
    Parameter {
        /// Camera identifier.
        camera: String,
        /// Photo identifier, for cameras with an interior orientation per photo.
        photo: Option<String>,
        /// Which parameter.
        parameter: Parameter,
    },
}

/// Action of the gross error search on an observation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GrossErrorAction {
    /// Taken out by data snooping.
    Removed,
    /// Taken back by data snooping; in round 0 what orientation had set aside and fits, tested with its full covariance.
    Restored,
    /// Weighted down by less than half.
    Downweighted,
    /// Found, and kept, since the network is not determined without it.
    Kept,
}

/// One entry of the record that the search for gross errors leaves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GrossError {
    /// Photo identifier; empty for observations without one.
    pub photo: String,
    /// Point identifier; empty for observations without one.
    pub point: String,
    /// The observation, if it is not an image observation.
    #[serde(default)]
    pub given: Option<Given>,
    /// Action.
    pub action: GrossErrorAction,
    /// Test statistic that led to it (Pope's τ, as normalised residual over sigma0), or the robust weight.
    pub statistic: f64,
    /// Limit it was compared with.
    pub limit: f64,
    /// Round of the search, from 1.
    pub round: usize,
    /// Whether it went only because another did: its point was left with this one ray. `statistic` is the other's.
    #[serde(default)]
    pub consequence: bool,
}
