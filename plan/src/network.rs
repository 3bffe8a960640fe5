//! Networks on paper: from a camera, stations and points to the observations they would give.
//!
//! Planning, teaching and testing all start here. A simulated project holds the true values as initial values, so that
//! what it lacks is precision and not orientation.

mod simulate;
mod station;

use serde::{Deserialize, Serialize};

use crate::render::Exposure;
use crate::scene::{Face, Patch, Ring};
use sightline::detection::DetectOptions;
use sightline::project::{Camera, Datum, Role, Sigma};

pub use simulate::{photo, scene, simulate};
pub use station::Station;

/// How the observations of a simulated project come about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Source {
    /// Projected without error.
    Exact,
    /// Projected, with normal noise from the seed.
    #[default]
    Noisy,
    /// Measured by the detector in rendered photos.
    Rendered,
}

/// A point of a network.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct NetworkPoint {
    /// Identifier.
    pub id: String,
    /// Role: tie, control or check point.
    pub role: Role,
    /// True coordinates.
    pub xyz: [f64; 3],
    /// Standard errors of given coordinates; noisy and rendered projects get coordinates that are off by as much.
    pub sigma: Option<[Option<f64>; 3]>,
    /// Direction the target faces; none: it is seen from everywhere, and not rendered.
    pub normal: Option<[f64; 3]>,
    /// Diameter of the target; rendered targets need one.
    pub diameter: Option<f64>,
    /// Code ring.
    pub ring: Option<Ring>,
    /// Grey of the target, a share of full scale.
    pub grey: Option<f64>,
    /// Round ground of the target.
    pub patch: Option<Patch>,
}

/// A scale bar of a network: its true length is that between its ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bar {
    /// Identifier of one end.
    pub from: String,
    /// Identifier of the other end.
    pub to: String,
    /// Standard error of the length.
    pub sigma: f64,
}

/// A network on paper.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Network {
    /// Name for people.
    pub name: String,
    /// Length unit, for people.
    pub unit: String,
    /// Cameras with their true parameters.
    pub cameras: Vec<Camera>,
    /// Stations, one a photo.
    pub stations: Vec<Station>,
    /// Points.
    pub points: Vec<NetworkPoint>,
    /// Faces that hide what lies behind them, and are the ground of rendered photos.
    pub faces: Vec<Face>,
    /// Grey of rendered photos where no face is.
    pub background: f64,
    /// Scale bars.
    pub distances: Vec<Bar>,
    /// Datum of the project.
    pub datum: Datum,
    /// Largest angle between the ray and the direction a target faces, radians.
    pub max_incidence: f64,
    /// Points nearer than this to the border of the picture are not measured, pixels.
    pub margin: f64,
    /// A priori standard error of the image observations, pixels. Detected centres bring their own.
    pub sigma: Sigma,
    /// Standard deviation of the simulated noise, pixels; none: that of `sigma`.
    pub noise: Option<Sigma>,
    /// Where the observations come from.
    pub observations: Source,
    /// Seed of the noise.
    pub seed: u64,
    /// Exposure of rendered photos.
    pub exposure: Exposure,
    /// Detection in rendered photos.
    pub detect: DetectOptions,
}

impl Default for Network {
    fn default() -> Self {
        Self {
            name: String::new(),
            unit: "mm".into(),
            cameras: Vec::new(),
            stations: Vec::new(),
            points: Vec::new(),
            faces: Vec::new(),
            background: 0.0,
            distances: Vec::new(),
            datum: Datum::default(),
            max_incidence: 70f64.to_radians(),
            margin: 0.0,
            sigma: Sigma::One(0.1),
            noise: None,
            observations: Source::default(),
            seed: 1,
            exposure: Exposure::default(),
            detect: DetectOptions::default(),
        }
    }
}

#[cfg(test)]
mod tests;
