//! A plan: targets, camera, stations and required accuracy.
//!
//! Data of the document; its prediction is computed in the crate `sightline-plan`.

use serde::{Deserialize, Serialize};

use super::identifier::identifier;
use super::{Camera, Datum, Point};

/// A plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Plan {
    /// Cameras with expected values; their free parameters are self-calibrated with the photos.
    pub cameras: Vec<Camera>,
    /// Depth of field.
    pub lens: Lens,
    /// The form from which `points` and `faces` were generated; `None`: they were given.
    pub form: Option<Form>,
    /// Object points at their expected positions, with the normals and diameters of their targets.
    pub points: Vec<Point>,
    /// Faces that occlude the points behind them.
    pub faces: Vec<PlanFace>,
    /// Scale bars.
    pub distances: Vec<PlanDistance>,
    /// Datum.
    pub datum: Datum,
    /// Photos to take.
    pub stations: Vec<PlanStation>,
    /// Other plans of the same object, to compare.
    pub variants: Vec<Variant>,
    /// Regions without access: no station is placed there.
    pub forbidden: Vec<Region>,
    /// Standard error of an image coordinate, pixels.
    pub sigma: f64,
    /// Maximum angle between the ray and the normal of a target, radians.
    pub max_incidence: f64,
    /// Margin: targets nearer than this to the border of the picture are not used, pixels.
    pub margin: f64,
    /// Minimum axis of a target's image, pixels.
    pub least_px: f64,
    /// Required accuracy of the points.
    pub wanted: Wanted,
}

impl Default for Plan {
    fn default() -> Self {
        Self {
            cameras: Vec::new(),
            lens: Lens::default(),
            form: None,
            points: Vec::new(),
            faces: Vec::new(),
            distances: Vec::new(),
            datum: Datum::default(),
            stations: Vec::new(),
            variants: Vec::new(),
            forbidden: Vec::new(),
            sigma: 0.05,
            max_incidence: 60f64.to_radians(),
            margin: 10.0,
            least_px: 8.0,
            wanted: Wanted::default(),
        }
    }
}

/// Depth of field of the photos. Without f-number, focus or pixel pitch everything is sharp.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Lens {
    /// f-number.
    pub f_number: Option<f64>,
    /// Focused distance, in the project's unit.
    pub focus: Option<f64>,
    /// Maximum circle of confusion, pixels.
    pub circle_px: f64,
    /// Millimetres in the project's unit.
    pub unit_mm: f64,
}

impl Default for Lens {
    fn default() -> Self {
        Self { f_number: None, focus: None, circle_px: 2.0, unit_mm: 1.0 }
    }
}

/// A face, a parallelogram.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlanFace {
    /// One corner.
    pub corner: [f64; 3],
    /// Edge from that corner.
    pub along: [f64; 3],
    /// The other edge from that corner.
    pub across: [f64; 3],
}

/// A scale bar.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanDistance {
    /// Identifier of one end.
    #[serde(deserialize_with = "identifier")]
    pub from: String,
    /// Identifier of the other end.
    #[serde(deserialize_with = "identifier")]
    pub to: String,
    /// Standard error of its length.
    pub sigma: f64,
}

/// A planned photo: its position, and its aim point or its rotation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PlanStation {
    /// Identifier of the photo.
    #[serde(deserialize_with = "identifier")]
    pub id: String,
    /// Identifier of its camera; empty: the plan's first.
    #[serde(deserialize_with = "identifier", skip_serializing_if = "String::is_empty")]
    pub camera: String,
    /// Projection centre.
    pub position: [f64; 3],
    /// Aim point on the camera's axis, if no rotation is given.
    pub look_at: Option<[f64; 3]>,
    /// Omega, phi, kappa in radians.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation: Option<[f64; 3]>,
    /// Roll of an aimed camera about its axis, radians.
    pub roll: f64,
    /// Whether the photo is taken already.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub taken: bool,
}

/// Another plan of the same object.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Variant {
    /// Display name.
    pub name: String,
    /// Its photos.
    pub stations: Vec<PlanStation>,
}

/// A box with edges along the axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Smallest X, Y and Z.
    pub low: [f64; 3],
    /// Largest X, Y and Z.
    pub high: [f64; 3],
}

/// A required accuracy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Wanted {
    /// Maximum semi-axis of a point's error ellipsoid, in the project's unit.
    pub precision: f64,
    /// Probability that the error along the largest axis is smaller, 0.5 to 0.999.
    pub probability: f64,
}

impl Default for Wanted {
    fn default() -> Self {
        Self { precision: 0.05, probability: 0.95 }
    }
}

/// A form with targets on it, around the origin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Form {
    /// A plane: upright it faces -Y and stands on Z = 0, else it lies at Z = 0 and faces up.
    Plane {
        /// Along X.
        width: f64,
        /// Along Z, or along Y where it lies.
        height: f64,
        /// Number of targets per row.
        columns: u32,
        /// Number of rows of targets.
        rows: u32,
        /// Whether the plane is upright.
        upright: bool,
        /// Diameter of the targets.
        diameter: f64,
    },
    /// A box that stands on Z = 0, with targets on its sides and its top.
    Box {
        /// Along X, Y and Z.
        size: [f64; 3],
        /// Number of targets per row on each face.
        columns: u32,
        /// Number of rows of targets on each face.
        rows: u32,
        /// Diameter of the targets.
        diameter: f64,
    },
    /// An upright cylinder on Z = 0, seen from outside, or from inside.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Along Z.
        height: f64,
        /// Angle of the arc that has targets, radians; its middle faces -Y.
        sweep: f64,
        /// Number of targets per row, around the cylinder.
        columns: u32,
        /// Number of rows of targets.
        rows: u32,
        /// Whether the targets are inside.
        inside: bool,
        /// Diameter of the targets.
        diameter: f64,
    },
}
