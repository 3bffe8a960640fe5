//! Where a project or a calibration comes from, if files of another program or of an earlier version were read: what the reader assumed, left
//! out and converted.

use serde::{Deserialize, Serialize};

use super::local_system::LocalSystem;

/// Something of a file that has no place in the document, or of the document that has none in the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ignored {
    /// Its name there.
    pub name: String,
    /// How many of it.
    pub count: usize,
}

/// An assumption of a reader about something that the format does not specify.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Assumed {
    /// Standard errors of image measurements are not in the file: 1 px.
    SigmaOnePixel,
    /// The size of the picture is not in the file: it is twice the principal point.
    ImageSizeFromPrincipalPoint,
    /// Neither the size of the picture nor the principal point is in the file, and its measurements count from the corner of the picture: the
    /// principal point is their median difference from the images of their points, and the size is twice that.
    MeasurementsFromCorner,
    /// The size of the picture is not in the file: it holds all measurements, and its centre is their origin.
    ImageSizeFromMeasurements,
    /// Four coefficients are k1, k2, p1, p2, not those of a fisheye lens.
    FourCoefficientsRadialTangential,
    /// The unit of length is not in the file: the document's is a name without meaning.
    UnitUnknown,
    /// The file does not define the position of the origin in the upper left pixel: in the corner of the picture.
    PixelOriginCorner,
    /// Coordinates of the camera are those of the chunk's own system: the reference system is geographic or a map projection.
    SystemOfChunk,
}

/// A conversion between camera models.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Conversion {
    /// Identifier of the camera.
    pub camera: String,
    /// Model that was given.
    pub from: String,
    /// Model that was fitted.
    pub to: String,
    /// Largest difference in the region, pixels.
    pub max_px: f64,
    /// Root mean square difference, pixels.
    pub rms_px: f64,
    /// The region, a polygon of pixels.
    pub region: Vec<[f64; 2]>,
    /// Whether the difference is larger than 0.05 px.
    pub warning: bool,
}

/// Files of another program, or of an earlier version, that were read. It is not an input of the adjustment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// Format, by its name in the interface.
    pub format: String,
    /// Names of the files.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<String>,
    /// Assumptions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<Assumed>,
    /// Contents of the files that were not imported, with counts.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ignored: Vec<Ignored>,
    /// Cameras whose model was converted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub conversions: Vec<Conversion>,
    /// The system that latitudes and longitudes of a list were converted into: later lists of the project are converted into the same one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub local_system: Option<LocalSystem>,
}

impl Origin {
    /// The format of documents that an earlier version wrote.
    pub const EARLIER: &str = "sightline";
    /// The format of a project made here that took a list of latitudes and longitudes.
    pub const LIST: &str = "control-csv";

    /// Whether the files are those of another program.
    pub fn is_foreign(&self) -> bool {
        ![Self::EARLIER, Self::LIST].contains(&self.format.as_str())
    }
}
