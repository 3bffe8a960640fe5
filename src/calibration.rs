//! Is a calibration good? How well a camera predicts where a point appears, how far two calibrations differ in that, whether parts of the
//! photos say the same, and which camera model they support.
//!
//! A calibration with a shifted principal point and a rotation that makes up for it predicts the same directions. What a motion of the
//! camera can take over is therefore taken out first, of an uncertainty as of a difference; [`MotionReference`] defines how.
//!
//! Source: D. Kogan, mrcal, "Projection uncertainty" and "Differencing", <https://mrcal.secretsauce.net>.

mod bands;
mod conversion;
mod coverage;
mod difference;
mod distance;
mod models;
mod motion;
mod places;
mod proposal;
mod split;
mod uncertainty;
mod validation;

use serde::{Deserialize, Serialize};

pub use bands::{BandOptions, ResidualBand, ResidualBands, residual_bands};
pub use conversion::{ModelConversion, convert_camera};
pub use coverage::{Coverage, CoverageLack, coverage};
pub use difference::{CameraDifference, DifferenceOptions, compare_cameras};
pub use distance::{DistanceOptions, DistanceUncertainty, PlaceOverDistance, uncertainty_over_distance};
pub use models::{ComparedModel, ModelVerdict, ModelsOptions, compare_models};
pub use proposal::{diagonal_field, proposed_models};
pub use uncertainty::{ProjectionUncertainty, UncertaintyOptions, WorstPlace, projection_uncertainty};
pub use validation::{CrossOptions, CrossPart, CrossValidation, CrossVerdict, cross_validate};

use crate::adjustment::AdjustOptions;
use crate::error::{Error, Place, Reason, Result, Thing};
use crate::project::{Camera, Project};

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

/// The camera that is meant.
///
/// # Errors
/// [`Error::Unknown`] for one that is not there; [`Error::Invalid`] where several are and none is named.
fn camera_of<'a>(project: &'a Project, id: Option<&str>) -> Result<&'a Camera> {
    match (id, project.cameras.as_slice()) {
        (None, [only]) => Ok(only),
        (None, [_, ..]) => Err(Error::Invalid { reason: Reason::CameraOfSeveral, at: Place::field("camera") }),
        _ => project.cameras.iter().find(|c| Some(c.id.as_str()) == id).ok_or_else(|| Error::Unknown {
            kind: Thing::Camera,
            name: id.unwrap_or_default().to_owned(),
            at: Place::field("camera"),
        }),
    }
}

/// # Errors
/// [`Error::Invalid`] for options by which a wrong model rejects or weakens the observations that contradict it.
fn plain_options(options: &AdjustOptions) -> Result<()> {
    if options.snooping || options.robust.is_some() || options.variance_components.is_some() {
        return Err(Error::Invalid { reason: Reason::ModelsJudgedPlainly, at: Place::field("adjust") });
    }
    Ok(())
}
