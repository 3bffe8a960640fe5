//! Where a project or a calibration comes from, if another program's files were read: what the reader assumed, left out and converted.

use serde::{Deserialize, Serialize};

/// Something of a file that has no place in the document, or of the document that has none in the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ignored {
    /// Its name there.
    pub name: String,
    /// How many of it.
    pub count: usize,
}

/// What a reader took for granted, since the format leaves it open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Assumed {
    /// Standard errors of image measurements are not in the file: 1 px.
    SigmaOnePixel,
    /// The size of the picture is not in the file: it is twice the principal point.
    ImageSizeFromPrincipalPoint,
    /// The size of the picture is not in the file: it holds all measurements, and its centre is their origin.
    ImageSizeFromMeasurements,
    /// Four coefficients are k1, k2, p1, p2, not those of a fisheye lens.
    FourCoefficientsRadialTangential,
    /// The unit of length is not in the file: the document's is a name without meaning.
    UnitUnknown,
    /// The file does not say where in the upper left pixel the origin lies: in the corner of the picture.
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

/// Files of another program that were read. It is no input of the adjustment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// Format, by its name in the interface.
    pub format: String,
    /// Names of the files.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<String>,
    /// What was assumed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<Assumed>,
    /// What of the files was not kept, with counts.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ignored: Vec<Ignored>,
    /// Cameras whose model was converted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub conversions: Vec<Conversion>,
}
