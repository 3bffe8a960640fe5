//! Features and coordinate systems measured on the result, with standard errors from the full covariance of the points.

use serde::{Deserialize, Serialize};

use crate::error::Error;

/// Meaning of the value of a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// A length in the project's unit.
    Distance,
    /// An angle in radians.
    Angle,
    /// A diameter in the project's unit.
    Diameter,
}

/// A measured feature. Lengths are in the project's unit, angles in radians; sigmas include σ0² and are null without statistics.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeasuredFeature {
    /// Identifier of the feature.
    pub id: String,
    /// Its kind, in the document's word.
    pub kind: String,
    /// Points that it was computed from.
    pub points: usize,
    /// What `value` is; null for lines, planes and deviations, which have none.
    #[serde(default)]
    pub quantity: Option<Quantity>,
    /// Distance, angle or diameter.
    #[serde(default)]
    pub value: Option<f64>,
    /// Its standard error; null if it has none (an angle of exactly 0).
    #[serde(default)]
    pub sigma: Option<f64>,
    /// Centre of a circle or sphere; the foot of the points' centroid on lines, planes and axes.
    #[serde(default)]
    pub position: Option<[f64; 3]>,
    /// Its standard errors.
    #[serde(default)]
    pub sigma_position: Option<[f64; 3]>,
    /// Unit direction of a line or an axis, unit normal of a plane or circle.
    #[serde(default)]
    pub direction: Option<[f64; 3]>,
    /// Largest standard error of the direction, radians.
    #[serde(default)]
    pub sigma_direction: Option<f64>,
    /// Root mean square of the points' distances from the fitted form, and of deviations.
    #[serde(default)]
    pub rms: Option<f64>,
    /// Smallest and largest of the residuals.
    #[serde(default)]
    pub range: Option<[f64; 2]>,
    /// Of the points.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub residuals: Vec<FeatureResidual>,
    /// Two ends of what is drawn of a distance, or of a line along its points; empty otherwise.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ends: Vec<[f64; 3]>,
    /// Why it has no standard errors though there are statistics: the points determine the form, or one that it is measured from, so
    /// weakly that they mean nothing. Standard error of the radius over the radius, or of the direction in radians, whichever is
    /// larger; null if standard errors hold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weak: Option<f64>,
    /// Root mean square of the residuals over the largest extent of the points, where it is so large that they hardly form what was
    /// fitted to them; null if they do.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub misfit: Option<f64>,
    /// Points of the feature that this adjustment has not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub missing: Vec<String>,
    /// Why there is no result.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<Box<Error>>,
}

/// A point's distance from a form.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FeatureResidual {
    /// Point identifier.
    pub point: String,
    /// Signed distance where the form has two sides, else the distance.
    pub value: f64,
    /// Standard error of a deviation; null for points that the form was fitted to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sigma: Option<f64>,
    /// Components of a deviation from given coordinates.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub difference: Option<[f64; 3]>,
}

/// A coordinate system laid through the adjusted points: x' = scale · rotation · x + shift.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeasuredSystem {
    /// Identifier of the system.
    pub id: String,
    /// Rows: its axes in the adjustment's system.
    pub rotation: [[f64; 3]; 3],
    /// The adjustment's origin in it.
    pub shift: [f64; 3],
    /// Ratio of its lengths to the adjustment's.
    pub scale: f64,
    /// Of a best fit: number of coordinates less that of parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub redundancy: Option<usize>,
    /// Standard deviation of unit weight of a best fit: of a coordinate where all weigh alike; null without redundancy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sigma0: Option<f64>,
    /// Of a best fit: transformed minus given.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub residuals: Vec<FeatureResidual>,
    /// All adjusted points in it.
    #[serde(default)]
    pub points: Vec<SystemPoint>,
    /// Points of the system that this adjustment has not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub missing: Vec<String>,
    /// Why there is no result.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<Box<Error>>,
}

/// A point in a coordinate system.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SystemPoint {
    /// Point identifier.
    pub id: String,
    /// Coordinates.
    pub xyz: [f64; 3],
    /// Standard errors in this system: what the system is laid through has less of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sigma: Option<[f64; 3]>,
}

/// Everything measured on a result.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// In the document's order.
    pub features: Vec<MeasuredFeature>,
    /// In the document's order.
    pub systems: Vec<MeasuredSystem>,
}
