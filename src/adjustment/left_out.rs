//! The items of the input that were not used in an adjustment, with the cause.

use serde::{Deserialize, Serialize};

use super::Given;

/// Kind of an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeftOutKind {
    /// An image observation.
    Observation,
    /// A control point (`axis` empty), or one of its coordinates.
    Control,
    /// A distance.
    Distance,
    /// An object point without a used observation.
    Point,
    /// A photo.
    Photo,
    /// An observed coordinate of a projection centre.
    Position,
    /// An observed camera parameter.
    Parameter,
}

/// The step that excluded an item.
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
    /// The document: the user disabled it.
    Document,
    /// The adjustment itself: the item depends on another one that was not used.
    Adjustment,
}

/// Why an item was not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeftOutReason {
    /// It disagrees with the others.
    Disagrees,
    /// Its photo has no exterior orientation.
    PhotoNotOriented,
    /// Its point has no coordinates.
    PointNotDetermined,
    /// Equally many observations support two different positions of its point, so the correct ones cannot be identified.
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
    /// It is not measured in any photo that was used.
    NotMeasured,
}

/// An item of the input that was not used.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeftOutItem {
    /// Kind of the item.
    pub kind: LeftOutKind,
    /// Photo identifier, for items that belong to a photo.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub photo: Option<String>,
    /// Point identifier, for items that belong to a point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<String>,
    /// Full name of an observation other than an image observation: end points of a distance, axis of a coordinate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub given: Option<Given>,
    /// The step that excluded it.
    pub by: LeftOutBy,
    /// Why.
    pub reason: LeftOutReason,
    /// Image observations: distance of the measured image point from the point projected with the adjusted values, pixels; null if that
    /// projection does not exist.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size_px: Option<f64>,
    /// Other items: adjusted minus given, in the unit of the given value; for a control point the distance of its given coordinates from
    /// those intersected from the photos that were used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<f64>,
    /// `size_px` or `size` in standard errors of that difference, from the full covariance matrix; null without statistics.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size_sigma: Option<f64>,
}
