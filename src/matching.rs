//! Identification of targets across photos: by code, by geometry, or by an earlier measurement.

mod cluster;
mod coded;
mod displaced;
mod epipolar;
mod epipolar_line;
mod free;
mod grid;
mod gross;
mod join;
mod known;
mod photo;
mod poses;
mod predict;
mod rounds;
mod size;
mod snap;
mod uncoded;

use serde::{Deserialize, Serialize};

pub use coded::{Coded, name_coded};
pub use displaced::{PhotoVector, PhotoVectors, displaced};
pub use free::{MatchOptions, Matching};
pub use grid::{
    Board, BoardKind, GridNaming, GridOptions, GridOrientation, NamedGrid, Unnamed, UnnamedReason, name_grid,
};
pub use gross::{Cleaned, disagreeing, without_gross_errors};
pub use predict::{EpipolarLine, PhotoPrediction, PredictOptions, Prediction, predict};
pub use rounds::match_uncoded;
pub use snap::{Mark, Snapped, Unsnapped, UnsnappedReason, snap};

use crate::detection::Target;
use crate::project::{Observation, Sigma};

/// The targets detected in one photo.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PhotoTargets {
    /// Identifier of the photo.
    pub photo: String,
    /// Its targets.
    pub targets: Vec<Target>,
}

/// A target whose identity is in doubt: shown to the user, not used.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Doubtful {
    /// Identifier of the photo.
    pub photo: String,
    /// Place in pixels.
    pub u: f64,
    /// Place in pixels.
    pub v: f64,
    /// Number of the target in its photo, where it has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target: Option<u32>,
    /// Points it could be, where there are names for them.
    pub points: Vec<String>,
    /// Why it is in doubt.
    pub reason: Doubt,
}

/// Why a target's identity is in doubt.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Doubt {
    /// The same code was read more than once in the photo.
    DuplicateCode,
    /// The rings are codes of several families, or of different ones.
    CodeFamily,
    /// Its ring is not safely one code.
    CodeUnclear,
    /// Something hides a part of its rim, so that its centre is rough.
    Occluded,
    /// Rays of other photos fit it in more than one way.
    Ambiguous,
    /// It disagrees with the other rays of its point.
    Disagrees,
}

/// A priori standard error of an image measurement without its own, in pixels.
const DEFAULT_SIGMA_PX: f64 = 0.1;

/// The target's own standard errors as the observation's a priori ones.
fn sigma_of(target: &Target) -> Sigma {
    let usable = |s: f64| if s.is_finite() && s > 0.0 { s } else { DEFAULT_SIGMA_PX };
    Sigma::Two([usable(target.sigma_u), usable(target.sigma_v)])
}

/// An observation of a target.
fn observed(photo: &str, point: &str, target: &Target) -> Observation {
    Observation {
        photo: photo.to_owned(),
        point: point.to_owned(),
        u: target.u,
        v: target.v,
        sigma: sigma_of(target),
        enabled: true,
        target: target.number(),
    }
}

#[cfg(test)]
pub(crate) fn target(u: f64, v: f64, code: Option<u32>) -> Target {
    Target {
        id: 0,
        u,
        v,
        sigma_u: 0.02,
        sigma_v: 0.03,
        covariance_uv: 0.0,
        major: 12.0,
        minor: 10.0,
        angle: 0.0,
        contrast: 100.0,
        polarity: crate::detection::Polarity::Bright,
        code,
        code_family: None,
        code_candidates: Vec::new(),
        inner: None,
        occluded: false,
        quality: crate::detection::Quality::default(),
    }
}
