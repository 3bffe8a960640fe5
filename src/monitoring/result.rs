//! Result of a comparison of epochs. Lengths are in the unit of the epochs, angles in radians; no number is NaN or infinite.

use serde::{Deserialize, Serialize};

use super::request::{ComparisonMethod, GroupModel};
use crate::axes::UserAxes;

/// A test: passed where the statistic does not exceed the limit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Test {
    /// F distributed where nothing has changed.
    pub statistic: f64,
    /// Degrees of freedom of the numerator.
    pub f1: f64,
    /// Of the denominator; null: infinitely many.
    pub f2: Option<f64>,
    /// Limit of the statistic, corrected for the number of tests where they are corrected.
    pub limit: f64,
    /// Probability of a statistic as large by chance, not corrected.
    pub p: f64,
    /// Whether the statistic is within the limit.
    pub passed: bool,
}

/// An epoch as it was used.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct UsedEpoch {
    /// Name.
    pub name: String,
    /// As given.
    pub date: Option<String>,
    /// As given.
    pub temperature: Option<f64>,
    /// Standard deviation of unit weight; null if it is not known.
    pub sigma0: Option<f64>,
    /// Redundancy; null: not known, the standard errors count as certain.
    pub redundancy: Option<f64>,
    /// Number of points.
    pub points: usize,
    /// Whether it has a scale of its own.
    pub scaled: bool,
    /// Assumptions.
    pub notes: Vec<EpochNote>,
}

/// Assumptions about an epoch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum EpochNote {
    /// A list without a covariance matrix: correlations between coordinates count as 0. The datum of the list is in its standard
    /// errors, and the tests hold approximately.
    NoCovariance,
    /// The accuracy of the standard errors is unknown: they count as exact.
    NoRedundancy,
    /// The project was adjusted anew as a free network, its control points as unknown points.
    ControlReleased {
        /// Those points.
        points: Vec<String>,
    },
}

/// Ratio of lengths of two epochs that both have a scale.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScaleDifference {
    /// Lengths of the later epoch over those of the earlier one, from the stable reference points.
    pub value: f64,
    /// Its standard error.
    pub sigma: f64,
    /// Test against 1.
    pub test: Test,
}

/// One step of the backward elimination.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EliminationStep {
    /// Point that became an object point.
    pub removed: String,
    /// Its share of Ω after decorrelation, χ² with three degrees of freedom where it has not moved.
    pub contribution: f64,
    /// Global test of the remaining points.
    pub test: Test,
}

/// Second opinion on the reference points: the datum of the smallest sum of displacements.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RobustDatum {
    /// Points that pass their test in it.
    pub stable: Vec<String>,
    /// Points that do not.
    pub unstable: Vec<String>,
}

/// Role of a point in a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PointRole {
    /// A stable reference point: it defines the datum.
    Reference,
    /// Any other.
    Object,
}

/// Confidence ellipsoid of a displacement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ellipsoid {
    /// Semi-axes, descending.
    pub semi_axes: [f64; 3],
    /// Their unit directions, one row each.
    pub directions: [[f64; 3]; 3],
}

impl Ellipsoid {
    /// Its outline seen along right x up, both unit vectors: the two semi-axes, descending, and the angle of the longer one from `right`
    /// towards `up`, radians. With the semi-axes s_k along u_k it is the ellipse of Σ s_k² p_k p_kᵀ, p_k = (u_k·right, u_k·up).
    pub fn outline(&self, right: [f64; 3], up: [f64; 3]) -> ([f64; 2], f64) {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for (s, u) in self.semi_axes.iter().zip(self.directions) {
            let (x, y) = (s * dot(u, right), s * dot(u, up));
            (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
        }
        let (mean, half) = (0.5 * (xx + yy), 0.5 * (xx - yy));
        let radius = half.hypot(xy);
        let axes = [(mean + radius).max(0.0).sqrt(), (mean - radius).max(0.0).sqrt()];
        (axes, 0.5 * xy.atan2(half))
    }
}

/// The smallest displacement that is found with the wanted power.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Detectable {
    /// Along X, Y, Z; null along an axis on which the point is held.
    pub axes: [Option<f64>; 3],
    /// Along the least favourable direction.
    pub worst: f64,
}

/// Displacement of a point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Displacement {
    /// Identifier, as in the first epoch.
    pub id: String,
    /// Name in the later epoch, where it was matched by position under another one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub later_id: Option<String>,
    /// Role after the elimination.
    pub role: PointRole,
    /// Coordinates in the earlier epoch, in the system of the first.
    #[serde(default)]
    pub xyz: [f64; 3],
    /// Later minus earlier.
    pub difference: [f64; 3],
    /// Standard errors.
    pub sigma: [f64; 3],
    /// xx, xy, xz, yy, yz, zz.
    pub covariance: [f64; 6],
    /// Length of the displacement.
    pub length: f64,
    /// Standard error along the displacement; null if it is 0.
    pub length_sigma: Option<f64>,
    /// Test against no displacement; null of a point held in both epochs.
    pub test: Option<Test>,
    /// Whether an object point has moved. Stable reference points are judged by the global test.
    pub moved: bool,
    /// Confidence ellipsoid at 1 - significance.
    pub ellipsoid: Option<Ellipsoid>,
    /// Smallest detectable displacement.
    pub detectable: Option<Detectable>,
}

/// Residual displacement of a point after the movement of its group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GroupResidual {
    /// Identifier.
    pub id: String,
    /// Displacement minus that of the group.
    pub difference: [f64; 3],
    /// Its standard errors.
    pub sigma: [f64; 3],
}

/// A parameter vector with its standard errors and its test against 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tested {
    /// Values.
    pub value: Vec<f64>,
    /// Standard errors.
    pub sigma: Vec<f64>,
    /// Test of all of them.
    pub test: Test,
}

/// Movement of a group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GroupMovement {
    /// Name.
    pub name: String,
    /// Model.
    pub model: GroupModel,
    /// Points that took part.
    pub points: Vec<String>,
    /// Named points that did not.
    pub missing: Vec<String>,
    /// Centroid in the earlier epoch: rotation, scale and strain are about it.
    pub centre: Option<[f64; 3]>,
    /// Translation of the centroid.
    pub translation: Option<Tested>,
    /// Rotation vector, radians.
    pub rotation: Option<Tested>,
    /// Change of scale, 0: none.
    pub scale: Option<Tested>,
    /// Strain xx, xy, xz, yy, yz, zz.
    pub strain: Option<Tested>,
    /// Test of all parameters: whether the group moved.
    pub test: Option<Test>,
    /// Test of the residuals: whether the movement of the group fits its model; null without redundancy.
    pub fit: Option<Test>,
    /// Residual displacements.
    pub residuals: Vec<GroupResidual>,
    /// State by the thresholds of the length of the translation; null without thresholds.
    pub state: Option<ThresholdState>,
    /// Why there is no movement.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<GroupError>,
}

/// Why the movement of a group is not determined.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum GroupError {
    /// Too few of its points are in both epochs.
    TooFewPoints {
        /// Points that the model needs.
        needed: usize,
        /// Points in both epochs.
        given: usize,
    },
    /// Its points lie on a line (in a plane, for the affine model), or define the datum themselves.
    Undetermined,
    /// No reference points are stable.
    NoStableGroup,
}

/// Why a point was not used.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum LeftOutPointReason {
    /// It is in one epoch alone.
    OnlyIn {
        /// That epoch.
        epoch: String,
    },
    /// It is named as ignored.
    Ignored,
    /// It has no standard errors.
    NoSigma {
        /// In this epoch.
        epoch: String,
    },
    /// Numbered by a program, and no point of the other epoch lies where it is.
    NoCounterpart {
        /// In this epoch.
        epoch: String,
    },
    /// Numbered by a program, and several points of the other epoch may be it.
    Ambiguous {
        /// In this epoch.
        epoch: String,
        /// Points of the other epoch.
        candidates: Vec<String>,
    },
    /// Numbered by a program, and too few other points are common to bring the epochs into one system.
    NoIdentity {
        /// In this epoch.
        epoch: String,
    },
    /// Held in both epochs: no movement can be tested.
    Held,
}

/// A point that was not used.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeftOutPoint {
    /// Identifier.
    pub id: String,
    /// Why.
    pub reason: LeftOutPointReason,
}

/// Where the reference points come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ReferenceFrom {
    /// They were named.
    Named,
    /// Control points.
    Control,
    /// Datum points.
    Datum,
    /// All common points that are not numbered by a program.
    Common,
}

/// Results of the global test and of the elimination.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// No reference point has moved.
    Congruent,
    /// Some have moved, and the others are congruent.
    StableGroup,
    /// No four reference points are congruent: displacements are in the datum of all of them and no statement on single points.
    NoStableGroup,
}

/// Variance factor that was used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VarianceUsed {
    /// One for both epochs.
    Pooled,
    /// One each; the degrees of freedom are those of F. E. Satterthwaite (1946) where the factors differ.
    Separate,
    /// 1.
    Given,
}

/// Notes on the result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum PairNote {
    /// The variance factors differ: the standard errors of at least one epoch are wrong.
    VariancesDiffer,
    /// The scale of the epochs differs.
    ScaleDiffers,
    /// The stable points are not a majority of the reference points: the others could equally be the stable ones.
    NoMajority {
        /// Stable points.
        stable: usize,
        /// Reference points.
        reference: usize,
    },
    /// Another group of reference points is congruent too, and cannot be distinguished from the one reported as stable.
    AnotherGroup {
        /// Its points.
        points: Vec<String>,
    },
    /// Stable points that the other stable points hardly control: in the least favourable direction a displacement of more than ten of
    /// their standard errors would not have been found.
    WeaklyControlled {
        /// The points.
        points: Vec<String>,
    },
    /// The interior orientation of a shared camera differs between the epochs.
    CameraDiffers {
        /// Camera.
        camera: String,
    },
    /// Fewer than four reference points are stable in all epochs: there is no adjustment of all epochs, no camera is shared.
    NotJoint,
    /// All epochs together have too many points for one adjustment: they were compared in pairs.
    TooManyTogether {
        /// Points of all epochs, the common ones counted once.
        points: usize,
        /// At most so many.
        limit: usize,
    },
    /// The robust datum finds other points unstable.
    SecondOpinionDiffers {
        /// Points that are judged differently.
        points: Vec<String>,
    },
    /// The displacements of the reference points, the moved ones apart, are larger than their standard errors.
    SigmasTooSmall {
        /// By about this factor: root of the median of their tests over the expected median.
        factor: f64,
    },
    /// No stable group was found.
    NoStableGroup,
}

/// Comparison of two epochs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pair {
    /// Earlier epoch.
    pub from: String,
    /// Later epoch.
    pub to: String,
    /// Equality of the variance factors, later over earlier, two-sided: the limit is that on the side of the statistic. Null where
    /// one is not estimated.
    pub variance_test: Option<Test>,
    /// Variance factor of the tests.
    pub variance: VarianceUsed,
    /// Standard deviation of unit weight of the tests; null if each epoch has its own.
    pub sigma0: Option<f64>,
    /// Degrees of freedom of the variance factor; null: infinitely many.
    pub redundancy: Option<f64>,
    /// Where the reference points come from.
    pub reference_from: ReferenceFrom,
    /// Difference of scale; null if one epoch has none or nothing was transformed.
    pub scale: Option<ScaleDifference>,
    /// Global congruence test of all reference points; null if all are held.
    pub global_test: Option<Test>,
    /// Elimination.
    pub steps: Vec<EliminationStep>,
    /// Result.
    pub outcome: Outcome,
    /// Stable reference points.
    pub stable: Vec<String>,
    /// Unstable ones.
    pub unstable: Vec<String>,
    /// Second opinion.
    pub robust_datum: RobustDatum,
    /// Points of both epochs.
    pub points: Vec<Displacement>,
    /// Groups.
    pub groups: Vec<GroupMovement>,
    /// Points that were not used.
    pub left_out: Vec<LeftOutPoint>,
    /// Note.
    pub notes: Vec<PairNote>,
}

/// State of a point by the thresholds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ThresholdState {
    /// Below both.
    Quiet,
    /// From the first on.
    Warning,
    /// From the second on.
    Alarm,
}

/// A value of a series.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeriesValue {
    /// Epoch.
    pub epoch: String,
    /// Displacement against the first epoch.
    pub difference: [f64; 3],
    /// Its standard errors.
    pub sigma: [f64; 3],
}

/// A point through the epochs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Identifier.
    pub id: String,
    /// Values.
    pub values: Vec<SeriesValue>,
    /// Linear velocity, unit per day; null below three dated epochs, and without a common datum of all.
    pub velocity: Option<[f64; 3]>,
    /// Its standard errors.
    pub velocity_sigma: Option<[f64; 3]>,
    /// Displacement of the straight line at the earliest date; null without a velocity.
    #[serde(default)]
    pub line_start: Option<[f64; 3]>,
    /// Test against 0.
    pub velocity_test: Option<Test>,
    /// By the length of the last displacement; null without thresholds.
    pub state: Option<ThresholdState>,
}

/// A camera with one interior orientation in all epochs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SharedCamera {
    /// Identifier.
    pub id: String,
    /// Test of one interior orientation against one an epoch; null if no parameter of it is estimated.
    pub test: Option<Test>,
}

/// One bundle adjustment of all epochs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointAdjustment {
    /// Points with one set of coordinates: stable in every pair with the first epoch.
    pub points: Vec<String>,
    /// Shared cameras; all others have an interior orientation an epoch.
    pub cameras: Vec<SharedCamera>,
    /// Standard deviation of unit weight.
    pub sigma0: Option<f64>,
    /// Redundancy.
    pub redundancy: usize,
}

impl JointAdjustment {
    /// Identifiers of the shared cameras.
    pub fn shared(&self) -> Vec<String> {
        self.cameras.iter().map(|camera| camera.id.clone()).collect()
    }
}

/// Comparison of epochs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Monitoring {
    /// Method.
    pub method: ComparisonMethod,
    /// The adjustment of all epochs together; null if epochs were compared in pairs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<JointAdjustment>,
    /// Unit; null if no epoch has one.
    pub unit: Option<String>,
    /// Letters and order of coordinates of the first project that has them; null: X, Y, Z. Triples here stay X, Y, Z.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axes: Option<UserAxes>,
    /// Epochs.
    pub epochs: Vec<UsedEpoch>,
    /// Every epoch with the first, then every one with its predecessor.
    pub pairs: Vec<Pair>,
    /// Points through the epochs.
    pub series: Vec<Series>,
    /// Datum of the series: reference points stable in all pairs with the first epoch; empty if fewer than four are, and values
    /// are in the datum of their pair.
    pub series_datum: Vec<String>,
}
