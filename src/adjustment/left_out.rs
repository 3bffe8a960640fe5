//! The items of the input that were not used in an adjustment, with the cause.

use serde::{Deserialize, Serialize};

use super::Given;

/// What an item is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeftOutKind {
    /// An image observation.
    Observation,
    /// A control point (`axis` empty), or one of its coordinates.
    Control,
    /// A distance.
    Distance,
    /// An object point of which no observation took part.
    Point,
    /// A photo.
    Photo,
    /// An observed coordinate of a projection centre.
    Position,
    /// An observed camera parameter.
    Parameter,
}

/// What took an item out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeftOutBy {
    /// Orientation.
    Orientation,
    /// Matching of detected targets.
    Matching,
    /// Data snooping.
    Snooping,
    /// Robust weights.
    Robust,
    /// The document: somebody disabled it.
    Document,
    /// The adjustment itself: what it depends on did not take part.
    Adjustment,
}

/// Why an item took no part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeftOutReason {
    /// It disagrees with the others.
    Disagrees,
    /// Its photo has no exterior orientation.
    PhotoNotOriented,
    /// Its point has no coordinates.
    PointNotDetermined,
    /// As many observations of its point speak for another place as for this one: which are right cannot be decided.
    Undecided,
    /// Its test statistic exceeded the limit of data snooping.
    GrossError,
    /// Its point was left with this one observation.
    Consequence,
    /// Robust weighting left it no weight.
    NoWeight,
    /// It is disabled in the document.
    Disabled,
    /// Its photo is disabled in the document.
    PhotoDisabled,
    /// It is not measured in a photo that took part.
    NotMeasured,
}

/// An item of the input that took no part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeftOutItem {
    /// What it is.
    pub kind: LeftOutKind,
    /// Photo identifier, of what belongs to a photo.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub photo: Option<String>,
    /// Point identifier, of what belongs to a point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<String>,
    /// Observations of other kinds than image coordinates by their full name: ends of a distance, axis of a coordinate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub given: Option<Given>,
    /// What took it out.
    pub by: LeftOutBy,
    /// Why.
    pub reason: LeftOutReason,
    /// Image observations: distance from where the adjusted values place it, pixels; null where they do not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size_px: Option<f64>,
    /// Others: adjusted minus given, in the unit of what was given; of a control point the distance of its given coordinates
    /// from where the photos that took part see it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<f64>,
    /// The same in standard errors of the difference, from the full covariance; null without statistics.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size_sigma: Option<f64>,
}
