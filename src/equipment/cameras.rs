//! Known cameras, and the use of their calibrations in a project.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::adjustment::AdjustedCamera;
use crate::error::Result;
use crate::exif::PhotoInfo;
use crate::project::{Camera, Interior, Origin, Parameter, Project};

/// Focal lengths that differ by less, as a share, are one setting of a lens: EXIF rounds them.
const SAME_FOCAL_LENGTH: f64 = 0.005;

/// A camera with one lens at one setting.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KnownCamera {
    /// Its name.
    pub id: String,
    /// Maker, as EXIF has it.
    #[serde(default)]
    pub make: Option<String>,
    /// Model, as EXIF has it.
    #[serde(default)]
    pub model: Option<String>,
    /// Focal length in millimetres, as EXIF has it.
    #[serde(default)]
    pub focal_length_mm: Option<f64>,
    /// Width of the sensor grid in pixels.
    pub width: u32,
    /// Height of the sensor grid in pixels.
    pub height: u32,
    /// Calibrations, the latest last.
    #[serde(default)]
    pub calibrations: Vec<Calibration>,
}

/// Result of a calibration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// When, as `YYYY-MM-DD`.
    pub date: String,
    /// Size of a pixel in millimetres; null: photo coordinates are in pixels.
    #[serde(default)]
    pub pixel_pitch: Option<[f64; 2]>,
    /// Model and its parameters.
    #[serde(flatten)]
    pub interior: Interior,
    /// Standard errors of the parameters that were estimated.
    #[serde(default)]
    pub sigma: BTreeMap<Parameter, f64>,
    /// All notes on it.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub remark: String,
    /// The file of another program, or of an earlier version, that it was read from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub origin: Option<Box<Origin>>,
}

/// How a calibration is used in a project.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Use {
    /// Every parameter is held.
    Held,
    /// Estimated parameters are observed with their standard errors, the others are held.
    Observed,
    /// Estimated parameters start there and are estimated freely, the others are held.
    Free,
}

impl KnownCamera {
    /// A camera as an adjustment left it, with its name in the project. `info` is the metadata of its photos.
    pub fn adjusted(adjusted: &AdjustedCamera, info: &PhotoInfo, date: &str) -> Self {
        let camera = &adjusted.camera;
        let sigma = adjusted.sigma.iter().filter(|(_, sigma)| **sigma > 0.0).map(|(p, sigma)| (*p, *sigma)).collect();
        Self {
            id: camera.id.clone(),
            make: info.make.clone(),
            model: info.model.clone(),
            focal_length_mm: info.focal_length_mm,
            width: camera.width,
            height: camera.height,
            calibrations: vec![Calibration {
                date: date.to_owned(),
                pixel_pitch: camera.pixel_pitch,
                interior: camera.interior,
                sigma,
                remark: String::new(),
                origin: None,
            }],
        }
    }

    /// Whether a photo was taken with it, by its model, its focal length and its grid. A photo without a model name does not decide:
    /// then no camera is known again.
    pub fn took(&self, info: &PhotoInfo, [width, height]: [u32; 2]) -> bool {
        let words = |name: &Option<String>| name.as_ref().map(|name| name.trim().to_lowercase());
        let model = words(&self.model);
        let same_focal_length = match (self.focal_length_mm, info.focal_length_mm) {
            (Some(a), Some(b)) => (a - b).abs() <= SAME_FOCAL_LENGTH * a.abs().max(b.abs()),
            (None, None) => true,
            _ => false,
        };
        model.is_some()
            && model == words(&info.model)
            && words(&self.make) == words(&info.make)
            && same_focal_length
            && (self.width, self.height) == (width, height)
    }

    /// Whether it is the same camera; of those without a model, whether it has the same name and grid.
    pub fn is_same(&self, other: &Self) -> bool {
        let info = PhotoInfo {
            make: other.make.clone(),
            model: other.model.clone(),
            focal_length_mm: other.focal_length_mm,
            ..PhotoInfo::default()
        };
        let grid = [other.width, other.height];
        let nameless = self.model.is_none() && other.model.is_none();
        self.took(&info, grid) || (nameless && self.id == other.id && [self.width, self.height] == grid)
    }

    /// Keeps one more calibration, in the order of their dates; one that is kept already is not kept twice.
    pub fn keep(&mut self, calibration: Calibration) {
        if !self.calibrations.contains(&calibration) {
            let at = self.calibrations.partition_point(|kept| kept.date <= calibration.date);
            self.calibrations.insert(at, calibration);
        }
    }

    /// The latest calibration.
    pub fn latest(&self) -> Option<&Calibration> {
        self.calibrations.last()
    }

    /// Checks that a project would take every calibration of it.
    ///
    /// # Errors
    /// As [`Project::validate`].
    pub fn validate(&self) -> Result<()> {
        let plain = Camera::new(&self.id, self.width, self.height, Interior::brown(1.0));
        let with = |calibration: &Calibration| {
            let mut camera = plain.clone();
            calibration.apply(&mut camera, Use::Observed);
            camera
        };
        let all = self.calibrations.iter().map(with).chain(std::iter::once(plain.clone()));
        all.into_iter().try_for_each(|camera| Project { cameras: vec![camera], ..Project::default() }.validate())
    }
}

impl Calibration {
    /// Gives a camera these values. The camera takes on the calibration's model and unit of photo coordinates.
    pub fn apply(&self, camera: &mut Camera, how: Use) {
        camera.interior = self.interior;
        camera.pixel_pitch = self.pixel_pitch;
        let estimated = self.interior.parameters().iter().copied().filter(|p| self.sigma.contains_key(p));
        camera.free = if how == Use::Held { Vec::new() } else { estimated.collect() };
        camera.sigma = if how == Use::Observed { self.sigma.clone() } else { BTreeMap::new() };
    }
}
