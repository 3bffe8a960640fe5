//! Plausibility questions about the input, as data, in the notes of an orientation and the advice of an adjustment.

use serde::{Deserialize, Serialize};

/// Two axes exchanged, or one with the other sign: the odd permutations that one slip makes. The other odd ones of the 48 signed
/// permutations are these followed by a rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Exchange {
    /// X and Y exchanged: north and east in the other order.
    Xy,
    /// X and Z exchanged.
    Xz,
    /// Y and Z exchanged.
    Yz,
    /// X with the other sign.
    X,
    /// Y with the other sign.
    Y,
    /// Z with the other sign: depths in place of heights.
    Z,
}

/// Given coordinates are a mirror image of what the photos show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MirroredControl {
    /// The exchange that corrects it.
    pub exchange: Exchange,
    /// What undoes it as well: the photos and the size of the coordinates cannot distinguish these. Each gives the same form and the same
    /// residuals.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub alternatives: Vec<Exchange>,
    /// Standard deviation of a coordinate in the similarity of the photos' network to the points as given, √(Σv²/(3n - 7)), project unit.
    pub rms_given: f64,
    /// The same after the exchange.
    pub rms_exchanged: f64,
    /// Points compared.
    pub points: usize,
}

/// Given points lie in a plane, within their standard errors, and nothing else shows whether their axes are mirrored: both cases have the
/// same residuals, with the cameras on one side of the plane or on the other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UndecidedAxes {
    /// Points compared.
    pub points: usize,
    /// Normal of their plane in the given system, towards the side on which the cameras stand if the axes are as given.
    pub normal: [f64; 3],
}

/// Values that seem to be in another unit than the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum UnitOf {
    /// Coordinates of control points.
    Control,
    /// Distances.
    Distance,
    /// The principal distance of a camera.
    Camera,
}

/// Something is longer or shorter than the rest implies, by about the ratio of two units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnitRatio {
    /// What.
    pub of: UnitOf,
    /// Its length as given over the length that the rest implies.
    pub ratio: f64,
    /// The ratio of two units that is nearest.
    pub nearest: f64,
    /// The distances compared.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub distances: Vec<(String, String)>,
    /// The camera whose principal distance it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<String>,
}

/// Photos taken from one place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OneStation {
    /// Which.
    pub photos: Vec<String>,
    /// Whether these are all photos: then there is no depth and no principal distance.
    #[serde(default)]
    pub all: bool,
}

/// Why a camera is implausible.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "reason", rename_all = "snake_case")]
pub enum CameraDoubt {
    /// Its principal distance implies a field of view that no photo taken for measuring has.
    FieldOfView {
        /// Along the longer side, radians.
        angle: f64,
        /// The principal distance as given, in the camera's units.
        value: f64,
        /// Whether photo coordinates are in pixels, since no pixel pitch is given: then the value may be meant in millimetres.
        pixels: bool,
    },
    /// Measurements lie outside of its pictures: it was calibrated at another size, or the photos are another camera's.
    ImageSize {
        /// Photos with such measurements.
        photos: Vec<String>,
        /// Width and height of the camera's pictures, pixels.
        size: [u32; 2],
        /// Largest u and v measured.
        measured: [f64; 2],
    },
    /// A photo was resized after it was taken: its measurements fit the others when they are divided by the factor.
    Resized {
        /// The photo.
        photo: String,
        /// Its size over the camera's.
        factor: f64,
    },
    /// A photo is a part of a picture: its measurements fit the others when the offset is added.
    Cropped {
        /// The photo.
        photo: String,
        /// Place of the part in the picture, pixels.
        offset: [f64; 2],
    },
    /// A photo was taken at another principal distance: with another zoom, or another camera.
    OtherDistance {
        /// The photo.
        photo: String,
        /// The principal distance with which its measurements fit the others, in the camera's units.
        value: f64,
    },
}

/// A camera that is not used as given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImplausibleCamera {
    /// Camera identifier.
    pub camera: String,
    /// The doubt.
    #[serde(flatten)]
    pub doubt: CameraDoubt,
}
