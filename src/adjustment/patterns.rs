//! Systematic patterns of the image residuals: their tests, their causes and the remedies.

use serde::{Deserialize, Serialize};

use crate::project::Parameter;

/// Variable on which the residuals of a camera depend.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PatternKind {
    /// Radial residuals that depend on the distance from the principal point: radial distortion that is not modelled.
    Radius,
    /// Tangential residuals, decentring and a shifted principal point.
    Tangential,
    /// Different scales along rows and columns, and shear.
    Affine,
    /// Residuals of each photo that grow with the row: the camera or the object moved during the read-out (rolling shutter).
    Row,
    /// The same with the column: a sensor that is read out along its columns.
    Column,
    /// A smooth pattern over the image that is the same in all photos.
    Position,
    /// Single photos with an interior orientation of their own: zoomed, refocused, cropped or of another size.
    Photo,
}

/// Test of the image residuals of a camera for a pattern.
///
/// The pattern is a set of k displacement fields Z over the image. With the residuals e of the adjustment and the redundancy matrix
/// R = I - AN⁻¹AᵀP, which takes out of Z what the estimated unknowns can take over,
///
/// ```text
/// χ² = bᵀG⁻¹b,   b = ZᵀPe,   G = ZᵀPRZ,   F = (χ² / k) / ((eᵀPe - χ²) / (r - k))
/// ```
///
/// Without such a pattern F has Fisher's distribution with k and r - k degrees of freedom; it does not depend on the variance factor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ResidualPattern {
    /// Camera identifier.
    pub camera: String,
    /// Alternative against which the residuals were tested.
    pub kind: PatternKind,
    /// Kind `photo`: the photos with an interior orientation of their own; empty: all of them. Other kinds: empty. Where all photos were
    /// tested together, the test is theirs, and these are the ones that differ far more than the others.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub photos: Vec<String>,
    /// Number of photos that were tested one by one: kinds `row`, `column` and `photo`. Of very large networks it is a part of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub photos_tested: Option<usize>,
    /// k, the number of displacement fields that the unknowns leave independent.
    pub degrees: usize,
    /// F.
    pub statistic: f64,
    /// Probability of a larger F without the pattern, times the number of tests that were made of this kind.
    pub p_value: f64,
    /// Root mean square length of the pattern in the residuals of the camera's image points, pixels.
    pub rms_px: f64,
    /// Largest length.
    pub max_px: f64,
    /// Standard deviation of unit weight without the pattern.
    pub sigma0: f64,
    /// Whether it is named as the cause: [`Advice::ResidualPattern`](super::Advice::ResidualPattern) has the remedy.
    pub named: bool,
}

/// Remedy for a pattern.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Remedy {
    /// Estimate parameters of the present model that are held.
    Estimate {
        /// These.
        parameters: Vec<Parameter>,
    },
    /// Take another camera model.
    Model {
        /// Names of the models, the first choice first.
        models: Vec<String>,
    },
    /// Hold camera and object still, or take a camera with a global shutter.
    HoldStill,
    /// Give these photos a camera of their own.
    OwnCamera {
        /// Photo identifiers.
        photos: Vec<String>,
    },
    /// Give every photo an interior orientation of its own, or fix the focus.
    PerPhoto,
    /// No parameter of a camera model describes it: flatness of the sensor or film, a window in front of the lens, the targets.
    Inspect,
}
