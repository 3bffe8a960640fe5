//! Options of a comparison of epochs.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::adjustment::Adjustment;
use crate::project::{Project, identifier, identifier_option_list, identifiers};

/// One epoch: a project, or a list of points from another program.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Epoch {
    /// Name, unique among the epochs.
    pub name: String,
    /// ISO 8601 date, or date and time: `2026-03-14`, `2026-03-14T09:30`, `2026-03-14T09:30:00+09:00`. Without an offset: UTC.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub date: Option<String>,
    /// Temperature of the object, °C: reported, not used.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub temperature: Option<f64>,
    /// The project.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub project: Option<Project>,
    /// Its adjustment; `None`: the project is adjusted with the default options.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub adjustment: Option<Adjustment>,
    /// Use of the control points of the project.
    pub control: ControlUse,
    /// The list.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points: Option<Vec<ListedPoint>>,
    /// Covariance matrix of the list, squared unit, including σ0².
    #[serde(skip_serializing_if = "Option::is_none")]
    pub covariance: Option<ListedCovariance>,
    /// Standard deviation of unit weight of the adjustment behind the list: sigmas and covariances include it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sigma0: Option<f64>,
    /// Redundancy of that adjustment.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub redundancy: Option<f64>,
    /// Unit of the list; `None`: that of the other epochs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// Whether the list has a scale of its own; `None`: it has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale: Option<bool>,
}

/// Use of the control points of a project.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ControlUse {
    /// The epoch is adjusted as a free network: given coordinates are the same observations in every epoch and cannot show that
    /// a control point has moved. Scale bars stay.
    #[default]
    Released,
    /// The given coordinates were measured anew for this epoch and stay observations.
    Kept,
}

/// A point of a list.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ListedPoint {
    /// Identifier.
    #[serde(deserialize_with = "identifier")]
    pub id: String,
    /// Coordinates.
    pub xyz: [f64; 3],
    /// Standard errors; 0 on an axis: held there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sigma: Option<[f64; 3]>,
}

/// Covariance matrix of listed points.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ListedCovariance {
    /// Points, three rows each.
    #[serde(deserialize_with = "identifiers")]
    pub points: Vec<String>,
    /// All rows in full, or the lower triangle with the diagonal.
    pub matrix: Vec<Vec<f64>>,
}

/// How epochs are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ComparisonMethod {
    /// Epochs are adjusted separately and their coordinates compared.
    #[default]
    Coordinates,
    /// The stable reference points have one set of coordinates. Two epochs that share no camera: under the condition that these points
    /// have not moved. More than two projects, or shared cameras: one bundle adjustment of all epochs.
    Joint,
}

/// Correction of the significance for the number of points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Correction {
    /// S. Holm 1979.
    #[default]
    Holm,
    /// α over the number of points.
    Bonferroni,
    /// Each point by itself.
    None,
}

/// Which variance factor the tests use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VarianceChoice {
    /// The pooled one of both epochs where their equality is accepted; else each epoch has its own.
    #[default]
    Estimated,
    /// Each epoch has its own.
    Separate,
    /// The a priori standard errors are trusted: σ0 = 1 with infinitely many degrees of freedom.
    Given,
}

/// In which system coordinates are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DatumChoice {
    /// Both epochs are transformed to the datum of the stable reference points.
    #[default]
    Reference,
    /// The epochs are in one system already, and nothing is transformed.
    Given,
}

/// A group of points that is thought to move as one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Group {
    /// Name.
    pub name: String,
    /// Its points.
    #[serde(deserialize_with = "identifiers")]
    pub points: Vec<String>,
    /// How it moves.
    #[serde(default)]
    pub model: GroupModel,
}

/// How a group moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GroupModel {
    /// Translation and rotation.
    #[default]
    Rigid,
    /// Scale too.
    Similarity,
    /// Homogeneous strain too.
    Affine,
}

/// Lengths of displacement that are reported.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// From here on: warning.
    pub warning: f64,
    /// From here on: alarm.
    pub alarm: f64,
}

/// Thresholds of the series.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Thresholds {
    /// For every point and group without its own.
    #[serde(flatten)]
    pub all: Limits,
    /// For single points.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub points: BTreeMap<String, Limits>,
    /// For groups, by the translation of their centroid.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub groups: BTreeMap<String, Limits>,
}

/// Options of a comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// Reference points; `None`: the control points, else the datum points of the projects, else all common points with names of
    /// their own.
    #[serde(deserialize_with = "identifier_option_list")]
    pub reference: Option<Vec<String>>,
    /// Points that are not used.
    #[serde(deserialize_with = "identifiers")]
    pub ignored: Vec<String>,
    /// Method.
    pub method: ComparisonMethod,
    /// Cameras with one interior orientation in all epochs, by their identifiers; needs the method `joint`. None by default: each epoch
    /// has cameras of its own.
    #[serde(deserialize_with = "identifiers")]
    pub shared_cameras: Vec<String>,
    /// Error probability of every test, 0 to 0.5.
    pub significance: f64,
    /// Correction for the number of object points.
    pub correction: Correction,
    /// Probability with which a detectable displacement is found.
    pub power: f64,
    /// Variance factor.
    pub variance: VarianceChoice,
    /// System.
    pub datum: DatumChoice,
    /// Groups.
    pub groups: Vec<Group>,
    /// Thresholds.
    pub thresholds: Option<Thresholds>,
    /// Points whose name is one of these followed by digits alone were numbered by a program: the number does not identify a point, and such
    /// points are matched by their position.
    pub automatic: Vec<String>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            reference: None,
            ignored: Vec::new(),
            method: ComparisonMethod::default(),
            shared_cameras: Vec::new(),
            significance: 0.05,
            correction: Correction::default(),
            power: 0.80,
            variance: VarianceChoice::default(),
            datum: DatumChoice::default(),
            groups: Vec::new(),
            thresholds: None,
            // Those of our own matching, and of V-STARS.
            automatic: vec!["u".into(), "TARGET".into()],
        }
    }
}
