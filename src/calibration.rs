//! Is a calibration good? How well a camera predicts where a point appears, and how far two calibrations differ in that.
//!
//! A calibration with a shifted principal point and a rotation that makes up for it predicts the same directions. What a motion of the
//! camera can take over is therefore taken out first, of an uncertainty as of a difference; [`MotionReference`] says how.
//!
//! Source: D. Kogan, mrcal, "Projection uncertainty" and "Differencing", <https://mrcal.secretsauce.net>.

mod difference;
mod motion;
mod places;
mod uncertainty;

use serde::{Deserialize, Serialize};

pub use difference::{CameraDifference, DifferenceOptions, compare_cameras};
pub use uncertainty::{ProjectionUncertainty, UncertaintyOptions, WorstPlace, projection_uncertainty};

/// Which motion of the camera is taken out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MotionReference {
    /// The rotation that takes over most, by least squares over a region of the image.
    #[default]
    Rotation,
    /// Rotation and translation, at a finite distance.
    RotationTranslation,
    /// The mean motion of the adjusted photos against the object (mrcal's `mean-pcam`): no fit, and no region.
    Photos,
    /// None: the parameters as they are.
    None,
}

/// Where the motion is fitted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FitRegion {
    /// A disc in the middle of the image whose radius is a sixth of the shorter side, as mrcal's differencing has it.
    #[default]
    Centre,
    /// The whole image.
    All,
}

/// Places of the grid along each side of the image unless asked otherwise: their distance is a few percent of the side.
const GRID: [usize; 2] = [25, 17];
