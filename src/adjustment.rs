//! The result of a bundle adjustment with its statistics.
//!
//! Sigmas and covariances include σ0²; lengths are in the project's unit, angles in radians, residuals in photo units
//! (brown model) or pixels (opencv model). No number is NaN or infinite.

mod advice;
mod camera;
mod correlations;
pub(crate) mod criteria;
mod features;
mod given;
mod left_out;
mod patterns;
mod questions;
mod rig;

use serde::{Deserialize, Serialize};

use crate::project::Camera;

pub use advice::Advice;
pub use camera::AdjustedCamera;
pub use correlations::{CorrelatedPair, CorrelationGroup, correlation_groups};
pub use criteria::Criteria;
pub(crate) use criteria::is_distortion;
pub use features::{FeatureResidual, Measured, MeasuredFeature, MeasuredSystem, Quantity, SystemPoint};
pub use given::{Given, GivenObservation, GrossError, GrossErrorAction};
pub use left_out::{LeftOutBy, LeftOutItem, LeftOutKind, LeftOutReason};
pub use patterns::{PatternKind, Remedy, ResidualPattern};
pub use questions::{
    CameraDoubt, Exchange, ImplausibleCamera, MirroredControl, OneStation, UndecidedAxes, UnitOf, UnitRatio,
};
pub use rig::{RelativeDeviation, RelativePose};

/// How the iteration ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Termination {
    /// The step fell below its limit.
    #[default]
    Converged,
    /// The largest number of iterations was reached.
    IterationLimit,
    /// No step lowered the weighted squares, or a hundred of them hardly did, and the gradient is not zero.
    Diverged,
    /// The caller stopped it.
    Stopped,
}

/// Which statistics are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StatisticsChoice {
    /// Coordinates and sigma0 only.
    None,
    /// Sigmas and covariances too.
    Precision,
    /// Redundancy numbers, tests, detectable biases too.
    #[default]
    Full,
}

/// Robust weights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Robust {
    /// Huber's weights.
    Huber,
    /// Tukey's biweight.
    Tukey,
}

/// Where the brown model's residuals are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ResidualPlace {
    /// At the corrected place, weighted with the measurement's own sigma, as if the correction stretched nothing: the form of
    /// other programs, to compare with them. With strong distortion sigma0 is off by as much as the correction stretches.
    Corrected,
    /// In the measurement, where the weights belong, through the correction and its derivative.
    #[default]
    Measured,
}

/// Scale of the robust weights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RobustScale {
    /// Estimated from the standardised residuals, and never below the a priori standard errors.
    #[default]
    AtLeastPrior,
    /// Estimated, wherever it falls.
    Estimated,
}

/// How variance components are estimated.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct VarianceComponents {
    /// Image coordinates camera by camera rather than all together.
    pub per_camera: bool,
    /// Whether image coordinates have a part that is not modelled, of one size for all of a group.
    pub unmodelled: bool,
}

/// Observations whose variances have one factor.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum ObservationGroup {
    /// Image coordinates.
    Image {
        /// Camera identifier; null for those of all cameras.
        camera: Option<String>,
    },
    /// Control coordinates.
    Control,
    /// Observed projection centres.
    Position,
    /// Distances.
    Distance,
    /// Observed camera parameters.
    Parameter,
}

/// An estimated variance component.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VarianceComponent {
    /// Whose.
    pub group: ObservationGroup,
    /// Scalar observations in the group.
    pub observations: usize,
    /// Sum of their redundancy numbers.
    pub redundancy: f64,
    /// Factor on the group's a priori standard errors.
    pub factor: f64,
    /// Standard error of the factor; null if it was not estimated, and is 1.
    pub factor_sigma: Option<f64>,
    /// Standard deviation of what is not modelled, pixels; null if it was not asked for.
    pub unmodelled: Option<f64>,
    /// Its standard error.
    pub unmodelled_sigma: Option<f64>,
    /// Of image coordinates: root mean square of the a priori standard errors that the factor belongs to, pixels.
    #[serde(default)]
    pub a_priori_px: Option<f64>,
    /// Why nothing was estimated of the group, whose a priori standard errors stay as they are; null if it was.
    #[serde(default)]
    pub not_estimated: Option<NotEstimated>,
}

/// Why a variance component was not estimated.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum NotEstimated {
    /// The redundancy numbers of the group sum up to less: a variance from so few residuals would enter as exact and is not.
    LittleRedundancy {
        /// Redundancy that is needed.
        needed: f64,
    },
    /// All its residuals are 0: they do not determine a variance.
    NoResiduals,
}

/// Options of the adjustment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct AdjustOptions {
    /// Largest number of iterations.
    pub max_iterations: usize,
    /// Which statistics are computed.
    pub statistics: StatisticsChoice,
    /// Robust weights, if any.
    pub robust: Option<Robust>,
    /// Their scale.
    pub robust_scale: RobustScale,
    /// Whether gross errors are searched by data snooping.
    pub snooping: bool,
    /// Where residuals are taken.
    pub residuals: ResidualPlace,
    /// Variance components to estimate, until sigma0 is 1; none: the standard errors are taken as they are. Not with robust
    /// weights, which take the scale from the residuals themselves.
    pub variance_components: Option<VarianceComponents>,
    /// Standard deviation of what is not modelled, added in quadrature to that of every image coordinate, pixels.
    pub unmodelled: f64,
    /// Diameter of the circular targets that state none of their own, in the project's unit, to free their images of the
    /// eccentricity.
    pub target_diameter: Option<f64>,
    /// Points whose full covariance matrix is wanted.
    pub covariance_of: Vec<String>,
}

impl Default for AdjustOptions {
    fn default() -> Self {
        Self {
            max_iterations: 50,
            statistics: StatisticsChoice::Full,
            robust: None,
            robust_scale: RobustScale::AtLeastPrior,
            snooping: false,
            residuals: ResidualPlace::Measured,
            variance_components: None,
            unmodelled: 0.0,
            target_diameter: None,
            covariance_of: Vec::new(),
        }
    }
}

/// One iteration.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Iteration {
    /// Square root of weighted squares over redundancy before the step.
    pub sigma0: f64,
    /// Largest change of an object or projection-centre coordinate, in the project's unit.
    pub step: f64,
    /// Damping of the step (Levenberg-Marquardt), 0 for a full Gauss-Newton step.
    pub damping: f64,
}

/// χ² test of sigma0 against its a priori value of 1, two-sided at 5 %.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GlobalTest {
    /// vᵀPv.
    pub statistic: f64,
    /// Lower limit.
    pub lower: f64,
    /// Upper limit.
    pub upper: f64,
    /// Whether the statistic lies between.
    pub passed: bool,
}

/// Correlations between named parameters.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Correlation {
    /// Names in the order of the matrix.
    pub names: Vec<String>,
    /// Symmetric, ones on the diagonal.
    pub matrix: Vec<Vec<f64>>,
}

/// Unit of residuals and camera parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum PhotoUnit {
    /// Millimetres: the brown model with a pixel pitch.
    #[serde(rename = "mm")]
    Millimetre,
    /// Pixels.
    #[default]
    #[serde(rename = "px")]
    Pixel,
}

impl PhotoUnit {
    /// Unit of a camera's residuals, and width and height of a pixel in it.
    pub fn of(camera: &Camera) -> (Self, [f64; 2]) {
        match camera.pixel_pitch.filter(|_| camera.interior.model().in_photo_units) {
            Some(pitch) => (Self::Millimetre, pitch),
            None => (Self::Pixel, [1.0; 2]),
        }
    }
}

/// An adjusted photo.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AdjustedPhoto {
    /// Photo identifier.
    pub id: String,
    /// Projection centre.
    pub position: [f64; 3],
    /// Omega, phi, kappa in radians.
    pub rotation: [f64; 3],
    /// Standard errors of the projection centre.
    pub sigma_position: Option<[f64; 3]>,
    /// Standard errors of the angles; null if the attitude leaves them undefined (phi of ±90°).
    pub sigma_rotation: Option<[f64; 3]>,
    /// Rms of the residuals in x, photo units.
    pub rms_x: f64,
    /// Rms of the residuals in y, photo units.
    pub rms_y: f64,
    /// Unit of its residuals.
    #[serde(default)]
    pub unit: PhotoUnit,
    /// Width and height of a pixel in that unit; residuals divided by them are pixels.
    #[serde(default = "one_by_one")]
    pub pixel: [f64; 2],
    /// Number of points measured in it that took part.
    pub points: usize,
    /// Correlations of X, Y, Z, omega, phi, kappa and the camera's estimated parameters; null without statistics or where
    /// the angles are undefined.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub correlation: Option<Correlation>,
}

fn one_by_one() -> [f64; 2] {
    [1.0; 2]
}

/// An adjusted point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AdjustedPoint {
    /// Point identifier.
    pub id: String,
    /// Coordinates.
    pub xyz: [f64; 3],
    /// Standard errors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sigma: Option<[f64; 3]>,
    /// xx, xy, xz, yy, yz, zz.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub covariance: Option<[f64; 6]>,
    /// Number of photos it was measured in.
    pub rays: usize,
}

/// An image observation after the adjustment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AdjustedObservation {
    /// Photo identifier.
    pub photo: String,
    /// Point identifier.
    pub point: String,
    /// Residual in x. Of an observation that was not used: its residual from the adjusted values; null if photo or point are
    /// not adjusted, or the point has no image there.
    pub vx: Option<f64>,
    /// Residual in y.
    pub vy: Option<f64>,
    /// Redundancy number of x.
    pub rx: Option<f64>,
    /// Redundancy number of y.
    pub ry: Option<f64>,
    /// Baarda's w in x; null if the redundancy number is 0.
    pub wx: Option<f64>,
    /// Baarda's w in y.
    pub wy: Option<f64>,
    /// Minimal detectable bias in x; null if the redundancy number is 0.
    pub mdb_x: Option<f64>,
    /// Minimal detectable bias in y.
    pub mdb_y: Option<f64>,
    /// External reliability: how far the detectable bias in x, undetected, moves the point, in the project's unit.
    #[serde(default)]
    pub effect_x: Option<f64>,
    /// External reliability of y.
    #[serde(default)]
    pub effect_y: Option<f64>,
    /// Factor on the weight from robust weighting, the smaller of x and y; null if it is 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
    /// Whether it took part.
    pub enabled: bool,
}

/// Difference at a check point, adjusted minus given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CheckPoint {
    /// Point identifier.
    pub id: String,
    /// Differences per axis; null if the point could not be determined.
    pub difference: Option<[f64; 3]>,
}

/// Difference at a distance that is compared only, adjusted minus given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CheckDistance {
    /// One end.
    pub from: String,
    /// Other end.
    pub to: String,
    /// Given length.
    pub length: f64,
    /// Adjusted minus given; null if an end could not be determined.
    pub difference: Option<f64>,
    /// Standard error of the adjusted length, from the full covariance of its ends; null without statistics.
    pub sigma: Option<f64>,
}

/// Differences of all check points per axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CheckStatistics {
    /// Number of compared points.
    pub count: usize,
    /// Smallest difference.
    pub min: [f64; 3],
    /// Largest difference.
    pub max: [f64; 3],
    /// Mean.
    pub mean: [f64; 3],
    /// Standard deviation about the mean; null with fewer than two points.
    pub standard_deviation: Option<[f64; 3]>,
    /// Root mean square.
    pub rms: [f64; 3],
    /// Root mean square of the differences on all axes together.
    #[serde(default)]
    pub rms_all: f64,
}

impl Adjustment {
    /// Whether standard errors were estimated from the residuals, so that sigma0 and the global test do not assess the fit.
    pub fn standard_errors_estimated(&self) -> bool {
        self.variance_components.iter().any(|component| component.not_estimated.is_none())
    }
}

/// Precision of the whole object.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Precision {
    /// Rms of the tie points' standard errors per axis.
    pub rms_sigma: [f64; 3],
    /// Mean of the tie points' geometric standard errors √q per axis.
    pub mean_q: [f64; 3],
    /// Largest distance between two points.
    pub largest_dimension: f64,
    /// Largest dimension over mean sigma, the N of 1 : N; null if sigma is 0.
    pub relative: Option<f64>,
}

/// Result of a bundle adjustment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Adjustment {
    /// The request.
    #[serde(default)]
    pub options: AdjustOptions,
    /// How the iteration ended.
    pub termination: Termination,
    /// The iterations.
    pub iterations: Vec<Iteration>,
    /// Scalar observations of every kind.
    pub observations_count: usize,
    /// Estimated parameters.
    pub unknowns: usize,
    /// Datum constraints.
    pub constraints: usize,
    /// observations_count - unknowns + constraints.
    pub redundancy: usize,
    /// Standard deviation of unit weight; null if the redundancy is 0.
    pub sigma0: Option<f64>,
    /// χ² test of sigma0; null if the redundancy is 0, and where variance components were estimated: they make the statistic the
    /// redundancy, whatever the residuals are.
    pub global_test: Option<GlobalTest>,
    /// Rms of the residuals of all image coordinates that took part, pixels; null if there are none.
    #[serde(default)]
    pub rms_px: Option<f64>,
    /// By what observations, parameters and the network are judged.
    #[serde(default)]
    pub criteria: Criteria,
    /// Cameras.
    pub cameras: Vec<AdjustedCamera>,
    /// Enabled photos.
    pub photos: Vec<AdjustedPhoto>,
    /// Relative poses of cameras that are fixed to each other; empty without a rig.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rig: Vec<RelativePose>,
    /// Points that took part.
    pub points: Vec<AdjustedPoint>,
    /// Image observations in the project's order.
    pub observations: Vec<AdjustedObservation>,
    /// Check points.
    pub check_points: Vec<CheckPoint>,
    /// Distances that are compared only.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub check_distances: Vec<CheckDistance>,
    /// Precision of the object; null without statistics.
    pub precision: Option<Precision>,
    /// Check points together; null without any.
    #[serde(default)]
    pub check_statistics: Option<CheckStatistics>,
    /// Observations of other kinds: control, projection centres, distances, parameters.
    #[serde(default)]
    pub given: Vec<GivenObservation>,
    /// Record of the search for gross errors.
    #[serde(default)]
    pub gross_errors: Vec<GrossError>,
    /// Eccentricity of every target with a diameter; empty without any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub eccentricity: Vec<PointEccentricity>,
    /// Variance components; empty unless asked for.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub variance_components: Vec<VarianceComponent>,
    /// Tests of the image residuals for patterns, a row a camera and kind; empty without full statistics, and where the iteration did
    /// not converge.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub patterns: Vec<ResidualPattern>,
    /// Weaknesses of the network.
    #[serde(default)]
    pub advice: Vec<Advice>,
    /// The correlations of the advice in groups, one a camera or photo; empty without any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub correlation_groups: Vec<CorrelationGroup>,
    /// Every item of the input that was not used; empty when all took part.
    #[serde(default)]
    pub left_out: Vec<LeftOutItem>,
    /// Covariance matrix of the points asked for, three rows each in their order; null when none were.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub covariance: Option<Covariance>,
    /// The document's features, measured on this result.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub features: Vec<MeasuredFeature>,
    /// The document's coordinate systems, laid through this result.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub systems: Vec<MeasuredSystem>,
}

/// Correction of the eccentricity of a circular target.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PointEccentricity {
    /// Point identifier.
    pub point: String,
    /// Largest correction of its measurements, pixels; null if nothing was corrected, since neither the document nor the
    /// surface around it tells how it is turned, or not for its neighbours.
    pub correction_px: Option<f64>,
}

/// Covariance matrix of chosen points.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Covariance {
    /// Points, three rows and columns each.
    pub points: Vec<String>,
    /// Symmetric, squared unit of the project.
    pub matrix: Vec<Vec<f64>>,
}
