//! The relative poses of cameras that are fixed to each other.

use serde::{Deserialize, Serialize};

/// A camera of the rig, relative to the first one.
///
/// With attitudes M (object to camera) and projection centres X, its rotation is M_own M_firstᵀ and its position M_first (X_own - X_first),
/// the means over the exposures that both took part in.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct RelativePose {
    /// Its column in the rig's exposures.
    pub column: usize,
    /// Its camera.
    pub camera: String,
    /// The first column's camera.
    pub relative_to: String,
    /// Projection centre in the axes of the first camera (x right, y up, z back), in the project's unit.
    pub position: [f64; 3],
    /// Standard errors of these; null without statistics.
    pub sigma_position: Option<[f64; 3]>,
    /// Omega, phi, kappa from the first camera's axes to its own, radians.
    pub rotation: [f64; 3],
    /// Standard errors of small turns about its own camera axes x, y, z, radians; null without statistics.
    pub sigma_rotation: Option<[f64; 3]>,
    /// Distance of the two projection centres.
    pub base: f64,
    /// Its standard error; null without statistics.
    pub sigma_base: Option<f64>,
    /// Deviation of each exposure.
    pub exposures: Vec<RelativeDeviation>,
    /// Root mean square of the positions' deviations, per axis with n - 1 exposures; null with one exposure.
    pub scatter_position: Option<f64>,
    /// That of the rotations, radians.
    pub scatter_rotation: Option<f64>,
}

/// Relative pose of one exposure minus that of all.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct RelativeDeviation {
    /// Row in the rig's exposures.
    pub exposure: usize,
    /// Photo of the first camera and of this one.
    pub photos: [String; 2],
    /// Of the position, in the first camera's axes.
    pub position: [f64; 3],
    /// Turn about the own camera's axes, radians.
    pub rotation: [f64; 3],
    /// Sum of the redundancy numbers of its six observations; null without statistics, with one exposure, and under robust weights.
    #[serde(default)]
    pub redundancy: Option<f64>,
    /// Degrees of freedom of the numerator of the statistic: 6, or fewer where a part of it is not checked.
    #[serde(default)]
    pub degrees: Option<usize>,
    /// F statistic: what a relative pose of its own would take from vᵀPv, over the variance factor of all other observations.
    #[serde(default)]
    pub statistic: Option<f64>,
    /// How often chance makes it as large.
    #[serde(default)]
    pub p_value: Option<f64>,
    /// Whether it is the most significant one of the rig, beyond α = 0.001: the mount gave, or the photos were not taken together.
    #[serde(default)]
    pub outlier: bool,
}
