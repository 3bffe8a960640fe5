//! The document: photos, measurements and given values. Format "sightline", version 1.
//!
//! Every view, file and test reads this one document. Fields may be added, never renamed or given another meaning.

mod epoch;
mod features;
mod identifier;
mod local_system;
mod origin;
mod parameter;
mod plan;
mod removed;
mod report;
mod rig;
mod rows;
mod scaling;
mod validation;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::axes::{ShownAxes, UserAxes};

pub use epoch::EpochOf;
pub use features::{CoordinateSystem, DrawnLine, End, Feature, FeatureKind, GivenPoint, Layer, SystemKind};
pub(crate) use identifier::{identifier, identifier_option_list, identifiers};
pub use local_system::{Geographic, LocalSystem, ReferenceEllipsoid};
pub use origin::{Assumed, Conversion, Ignored, Origin};
pub use parameter::{CameraModel, Interior, Parameter};
pub use plan::{Form, Lens, Plan, PlanDistance, PlanFace, PlanStation, Region, Variant, Wanted};
pub use removed::RemovedFields;
pub(crate) use removed::{count_entries, note_removed};
pub use report::{LengthLimit, Paper, ReportLanguage, ReportSettings, Section};
pub use rig::Rig;
pub use rows::Rows;
pub use scaling::scaled;
pub use validation::LARGEST;

/// The document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Project {
    /// Always "sightline".
    pub format: String,
    /// Version of the format, 1.
    pub version: u32,
    /// Name for people.
    #[serde(default)]
    pub name: String,
    /// Length unit of object coordinates, for people.
    #[serde(default = "default_unit")]
    pub unit: String,
    /// Letters and order in which coordinates are shown and written for people; null: X, Y, Z. Coordinates of the document stay X (east), Y
    /// (north), Z in any case.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axes: Option<UserAxes>,
    /// Cameras.
    #[serde(default)]
    pub cameras: Vec<Camera>,
    /// Photos.
    #[serde(default)]
    pub photos: Rows<Photo>,
    /// Object points.
    #[serde(default)]
    pub points: Rows<Point>,
    /// Image observations.
    #[serde(default)]
    pub observations: Rows<Observation>,
    /// Measured distances.
    #[serde(default)]
    pub distances: Vec<Distance>,
    /// Datum.
    #[serde(default)]
    pub datum: Datum,
    /// Cameras fixed to each other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rig: Option<Box<Rig>>,
    /// Observations that the last orientation (or matching) disabled, with the reason; the next orientation looks at them anew, and an
    /// adjustment takes back what fits.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub set_aside: Vec<SetAside>,
    /// Measurements on the result.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub features: Vec<Feature>,
    /// Coordinate systems of the object's own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub systems: Vec<CoordinateSystem>,
    /// Lines between points, for drawings.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lines: Vec<DrawnLine>,
    /// Layers of the lines.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub layers: Vec<Layer>,
    /// Settings of the report, which are not inputs of the adjustment.
    #[serde(default, skip_serializing_if = "ReportSettings::is_default")]
    pub report: ReportSettings,
    /// The plan of the photos.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plan: Option<Box<Plan>>,
    /// The project whose later epoch this is: no input of the adjustment.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub epoch: Option<EpochOf>,
    /// Files of another program, or of an earlier version, that the project was read from: what was assumed, left out and converted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub origin: Option<Box<Origin>>,
}

fn default_unit() -> String {
    "mm".into()
}

impl Project {
    /// Letters and order in which its coordinates are shown and written.
    pub fn shown_axes(&self) -> ShownAxes {
        ShownAxes::of(self.axes)
    }
}

impl Default for Project {
    fn default() -> Self {
        Self {
            format: "sightline".into(),
            version: 1,
            name: String::new(),
            unit: default_unit(),
            axes: None,
            cameras: Vec::new(),
            photos: Rows::new(),
            points: Rows::new(),
            observations: Rows::new(),
            distances: Vec::new(),
            datum: Datum::default(),
            rig: None,
            set_aside: Vec::new(),
            features: Vec::new(),
            systems: Vec::new(),
            lines: Vec::new(),
            layers: Vec::new(),
            report: ReportSettings::default(),
            plan: None,
            epoch: None,
            origin: None,
        }
    }
}

/// A camera: sensor grid and interior orientation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// Identifier.
    #[serde(deserialize_with = "identifier")]
    pub id: String,
    /// Width of the sensor grid in pixels.
    pub width: u32,
    /// Height of the sensor grid in pixels.
    pub height: u32,
    /// Size of a pixel in millimetres; null: photo coordinates are in pixels.
    #[serde(default)]
    pub pixel_pitch: Option<[f64; 2]>,
    /// Model and its parameters.
    #[serde(flatten)]
    pub interior: Interior,
    /// Parameters to be estimated.
    #[serde(default)]
    pub free: Vec<Parameter>,
    /// Parameters observed with an a priori sigma; these are estimated too.
    #[serde(default)]
    pub sigma: BTreeMap<Parameter, f64>,
    /// Whether every photo has an interior orientation of its own, starting from this one.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub per_photo: bool,
}

/// A photo and its exterior orientation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Photo {
    /// Identifier.
    #[serde(deserialize_with = "identifier")]
    pub id: String,
    /// Identifier of its camera.
    #[serde(deserialize_with = "identifier")]
    pub camera: String,
    /// File name.
    #[serde(default)]
    pub file: String,
    /// Projection centre in the object system.
    #[serde(default)]
    pub position: Option<[f64; 3]>,
    /// Omega, phi, kappa in radians.
    #[serde(default)]
    pub rotation: Option<[f64; 3]>,
    /// Standard errors of the given projection centre, per axis; null: not observed. Used under the control datum.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sigma_position: Option<[Option<f64>; 3]>,
    /// The photo's own interior orientation, for a camera whose photos have one each.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interior: Option<Interior>,
    /// Whether it takes part.
    #[serde(default = "yes")]
    pub enabled: bool,
    /// SHA-256 of the file in hexadecimal digits, where it was looked into.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub sha256: String,
}

/// Role of a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Determined by the adjustment.
    #[default]
    Tie,
    /// Known: fixed or weighted.
    Control,
    /// Known, but compared only.
    Check,
}

/// An object point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Identifier.
    #[serde(deserialize_with = "identifier")]
    pub id: String,
    /// Role: tie, control or check point.
    #[serde(default)]
    pub role: Role,
    /// Coordinates: given (control, check) or initial (tie).
    #[serde(default)]
    pub xyz: Option<[f64; 3]>,
    /// Standard errors of given coordinates; null or 0 on an axis fixes that axis of a control point.
    #[serde(default)]
    pub sigma: Option<[Option<f64>; 3]>,
    /// Diameter of the circular target in the object's unit.
    #[serde(default)]
    pub diameter: Option<f64>,
    /// Normal of the circular target's plane in the object system, of any length and either sign; null: that of the surface
    /// which its neighbours show. Used where there is a diameter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 3]>,
}

/// A priori standard error of an image observation in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Sigma {
    /// The same for u and v.
    One(f64),
    /// For u and for v.
    Two([f64; 2]),
}

impl Sigma {
    /// For u and for v.
    pub fn both(self) -> [f64; 2] {
        match self {
            Self::One(s) => [s, s],
            Self::Two(s) => s,
        }
    }
}

/// An image observation: a point measured in a photo, in pixels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Observation {
    /// Identifier of the photo.
    #[serde(deserialize_with = "identifier")]
    pub photo: String,
    /// Identifier of the point.
    #[serde(deserialize_with = "identifier")]
    pub point: String,
    /// To the right.
    pub u: f64,
    /// Downwards.
    pub v: f64,
    /// A priori standard error.
    pub sigma: Sigma,
    /// Whether it takes part.
    #[serde(default = "yes")]
    pub enabled: bool,
    /// Number of the photo's target whose centre it is, where it is a target's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target: Option<u32>,
}

/// An image observation that orientation, or the search for wrong names after matching, disabled.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SetAside {
    /// Identifier of the photo.
    #[serde(deserialize_with = "identifier")]
    pub photo: String,
    /// Identifier of the point.
    #[serde(deserialize_with = "identifier")]
    pub point: String,
    /// Why.
    pub reason: SetAsideReason,
    /// Its distance from where its point should have been, pixels; null if no place was known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distance_px: Option<f64>,
    /// The step that set it aside.
    #[serde(default, skip_serializing_if = "SetAsideBy::is_orientation")]
    pub by: SetAsideBy,
}

/// The step that set an observation aside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SetAsideBy {
    /// Orientation.
    #[default]
    Orientation,
    /// The search for wrong names after matching.
    Matching,
}

impl SetAsideBy {
    fn is_orientation(&self) -> bool {
        *self == Self::Orientation
    }
}

/// Why an observation was set aside.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SetAsideReason {
    /// It disagrees with the other measurements: a wrong identity, most often.
    Disagrees,
    /// Its photo could not be oriented.
    PhotoNotOriented,
    /// Its point could not be determined.
    PointNotDetermined,
    /// Equally many observations support two positions of its point, so the correct ones cannot be identified.
    Undecided,
}

/// A measured distance between two points (scale bar).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Distance {
    /// Identifier of one end.
    #[serde(deserialize_with = "identifier")]
    pub from: String,
    /// Identifier of the other end.
    #[serde(deserialize_with = "identifier")]
    pub to: String,
    /// Length in the project's unit.
    pub length: f64,
    /// Standard error of the length.
    pub sigma: f64,
    /// Whether it is compared only, and is not used.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub check: bool,
}

/// Kind of datum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DatumKind {
    /// Control points.
    Control,
    /// As many constraints as the datum defect.
    Minimal,
    /// Inner constraints.
    #[default]
    Free,
}

/// Datum.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Datum {
    /// Kind.
    pub kind: DatumKind,
    /// Points of the inner constraints, or those that carry the minimal ones; null: all, or chosen automatically.
    #[serde(default, deserialize_with = "identifier_option_list")]
    pub points: Option<Vec<String>>,
}

fn yes() -> bool {
    true
}

impl Camera {
    /// A camera with nothing to be estimated; photo coordinates in pixels.
    pub fn new(id: impl Into<String>, width: u32, height: u32, interior: Interior) -> Self {
        Self {
            id: id.into(),
            width,
            height,
            pixel_pitch: None,
            interior,
            free: Vec::new(),
            sigma: BTreeMap::new(),
            per_photo: false,
        }
    }

    /// The camera as it took a photo: with the photo's own interior orientation, where its photos have one each.
    pub fn of_photo(&self, photo: &Photo) -> Self {
        let interior = photo.interior.filter(|_| self.per_photo).unwrap_or(self.interior);
        Self { interior, ..self.clone() }
    }

    /// Width and height of a pixel in photo units (1 without a pitch).
    pub fn pitch(&self) -> [f64; 2] {
        self.pixel_pitch.unwrap_or([1.0, 1.0])
    }

    /// Photo coordinates (x right, y up, origin at the image centre) of a pixel position.
    pub fn photo_from_pixel(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let [px, py] = self.pitch();
        [(u - f64::from(self.width) / 2.0) * px, (f64::from(self.height) / 2.0 - v) * py]
    }

    /// Pixel position of photo coordinates.
    pub fn pixel_from_photo(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [px, py] = self.pitch();
        [x / px + f64::from(self.width) / 2.0, f64::from(self.height) / 2.0 - y / py]
    }

    /// Width and height of a pixel in the unit of the measurements and residuals: photo units (brown) or pixels.
    pub fn residual_pitch(&self) -> [f64; 2] {
        if self.interior.model().in_photo_units { self.pitch() } else { [1.0, 1.0] }
    }

    /// Principal distance in pixels along u, as it stands; none while it is unknown.
    pub fn principal_distance_px(&self) -> Option<f64> {
        let model = self.interior.model();
        let distance = self.interior.get(model.distance)?;
        Some(if model.in_photo_units { distance / self.pitch()[0] } else { distance })
    }

    /// Sets the principal distance in pixels along u; the ratio of two focal lengths stays.
    pub fn set_principal_distance_px(&mut self, px: f64) {
        let model = self.interior.model();
        let value = if model.in_photo_units { px * self.pitch()[0] } else { px };
        self.interior.set(model.distance, value);
    }

    /// Parameters that the adjustment estimates: the free and the observed ones, in the model's order, each once.
    pub fn estimated(&self) -> Vec<Parameter> {
        let wanted = |p: &Parameter| self.free.contains(p) || self.sigma.contains_key(p);
        self.interior.parameters().iter().copied().filter(wanted).collect()
    }
}
