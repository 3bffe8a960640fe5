//! Projection uncertainty against distance: the standard error of the pixel at which a point appears, by its distance from the camera.
//!
//! A point at the distance D of the ray r is p = D r. With the derivatives of its pixel by the parameters, J, and by a turn ω and a shift t of
//! the camera, K = (K_ω, K_t / D), K_t that of D = 1, and the covariance Σ of parameters and mean motion of the photos
//! (see [`MotionReference::Photos`])
//!
//! ```text
//! Σ_q(D) = J(D) Σ J(D)ᵀ,   J(D) = (J, K_ω, K_t / D)
//! ```
//!
//! The shift of the camera counts less and less with the distance: far away the directions alone are uncertain, close by their origin too.
//! Between them, where the photos had their targets, both compensate each other. With a motion that is fitted at every distance the curve would
//! not show what a calibration knows nothing of, and with a rotation alone it is level; therefore the reference is the photos.
//!
//! Source: D. Kogan, mrcal, "Projection uncertainty", <https://mrcal.secretsauce.net> (`--vs-distance-at`).

use std::collections::HashMap;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::uncertainty::{ProjectionCovariance, UncertaintyOptions, chosen, worst_direction};
use super::{MotionReference, places};
use crate::adjustment::{AdjustedCamera, Adjustment};
use crate::error::{Error, Place, Reason, Result};
use crate::project::{Parameter, Project};

/// Distances of the curve unless asked otherwise: they follow each other by 15 % over a hundredfold range.
const COUNT: usize = 33;
/// The curve begins at this part of the nearest target's distance, and ends at its inverse times that of the farthest.
const BEYOND: f64 = 0.2;
/// Maximum number of distances, and of places.
const MOST: usize = 1000;
/// Places on the half diagonals in parts of these: in the corner itself a model may have no ray.
const OUTER: f64 = 0.9;

/// The question.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct DistanceOptions {
    /// Camera identifier; may be left out where the adjustment has one camera.
    pub camera: Option<String>,
    /// Photo identifier, for a camera with an interior orientation per photo.
    pub photo: Option<String>,
    /// Distances from the projection centre in the project's unit; null: 33 in equal ratios, from a fifth of the nearest to five times the
    /// farthest distance between a photo and a point measured in it.
    pub distances: Option<Vec<f64>>,
    /// Pixels; null: the image centre, and the four points at nine tenths of the way from it to the corners.
    pub places: Option<Vec<[f64; 2]>>,
}

/// Standard errors at a place of the image by distance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlaceOverDistance {
    /// Column, pixels.
    pub u: f64,
    /// Row, pixels.
    pub v: f64,
    /// Per distance: standard error in the worst direction, pixels; null if the model gives no ray.
    pub sigma: Vec<Option<f64>>,
    /// The same of a direction, at infinity.
    pub infinity: Option<f64>,
}

/// Standard errors of predicted pixels by distance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DistanceUncertainty {
    /// Camera identifier.
    pub camera: String,
    /// Photo whose own interior orientation it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub photo: Option<String>,
    /// Estimated parameters, whose uncertainty it is; what was held counts as known.
    pub parameters: Vec<Parameter>,
    /// Distances in the project's unit.
    pub distances: Vec<f64>,
    /// Smallest and largest distance between a photo of the camera and a point measured in it.
    pub measured: [f64; 2],
    /// The curve of every place.
    pub places: Vec<PlaceOverDistance>,
}

/// Standard errors of the pixels at which a calibrated camera sees points, by their distance; the mean motion of the photos against the
/// object is taken out.
///
/// # Errors
/// As [`super::projection_uncertainty`] with [`MotionReference::Photos`]; [`Error::Invalid`] for distances that are none, for places outside
/// of the image, for none or for more than a thousand of either, and where no photo of the camera has a measurement.
pub fn uncertainty_over_distance(
    project: &Project,
    adjustment: &Adjustment,
    options: &DistanceOptions,
) -> Result<DistanceUncertainty> {
    let adjusted = chosen(adjustment, options.camera.as_deref(), options.photo.as_deref())?;
    let camera = &adjusted.camera;
    let invalid = |reason, field| Error::Invalid { reason, at: Place::field(field) };
    let unmeasured = || Error::Invalid { reason: Reason::CalibrationUnmeasured, at: Place::camera(&camera.id) };
    let measured = measured(project, adjustment, adjusted).ok_or_else(unmeasured)?;
    let distances = match &options.distances {
        Some(given) => {
            if given.is_empty() || given.len() > MOST || !given.iter().all(|d| *d > 0.0 && d.is_finite()) {
                return Err(invalid(Reason::CalibrationDistance, "distances"));
            }
            given.clone()
        }
        None => {
            let (from, to) = ((BEYOND * measured[0]).ln(), (measured[1] / BEYOND).ln());
            (0..COUNT).map(|k| (from + (to - from) * k as f64 / (COUNT - 1) as f64).exp()).collect()
        }
    };
    let (width, height) = (f64::from(camera.width), f64::from(camera.height));
    let pixels = match &options.places {
        Some(given) => {
            let inside = |[u, v]: &[f64; 2]| (0.0..=width).contains(u) && (0.0..=height).contains(v);
            if given.is_empty() || given.len() > MOST || !given.iter().all(inside) {
                return Err(invalid(Reason::CalibrationPlaces, "places"));
            }
            given.clone()
        }
        None => [[0.0, 0.0], [-OUTER, -OUTER], [OUTER, -OUTER], [-OUTER, OUTER], [OUTER, OUTER]]
            .map(|[a, b]| [width / 2.0 * (1.0 + a), height / 2.0 * (1.0 + b)])
            .to_vec(),
    };
    let asked = UncertaintyOptions { reference: MotionReference::Photos, ..UncertaintyOptions::default() };
    let spread = ProjectionCovariance::of(project, adjustment, adjusted, &asked)?;
    let sigma = |pixel: [f64; 2], distance: Option<f64>| {
        let place = places::place(camera, &spread.parameters, pixel, distance)?;
        spread.at(&place).map(|c| worst_direction(&c))
    };
    let curve = |&[u, v]: &[f64; 2]| PlaceOverDistance {
        u,
        v,
        sigma: distances.iter().map(|d| sigma([u, v], Some(*d))).collect(),
        infinity: sigma([u, v], None),
    };
    Ok(DistanceUncertainty {
        camera: camera.id.clone(),
        photo: adjusted.photo.clone(),
        parameters: spread.parameters.clone(),
        places: pixels.iter().map(curve).collect(),
        distances,
        measured,
    })
}

/// Smallest and largest distance between a photo of the camera and a point measured in it; `None` without any.
fn measured(project: &Project, adjustment: &Adjustment, adjusted: &AdjustedCamera) -> Option<[f64; 2]> {
    let is_own = |id: &str| match &adjusted.photo {
        Some(own) => own == id,
        None => project.photos.iter().any(|p| p.id == id && p.camera == adjusted.camera.id),
    };
    let photos: HashMap<&str, Vector3<f64>> = (adjustment.photos.iter())
        .filter(|p| is_own(&p.id))
        .map(|p| (p.id.as_str(), Vector3::from(p.position)))
        .collect();
    let points: HashMap<&str, Vector3<f64>> =
        adjustment.points.iter().map(|p| (p.id.as_str(), Vector3::from(p.xyz))).collect();
    let used = adjustment.observations.iter().filter(|o| o.enabled);
    let distances = used.filter_map(|o| Some((photos.get(o.photo.as_str())? - points.get(o.point.as_str())?).norm()));
    let range = distances.fold([f64::INFINITY, 0.0_f64], |[near, far], d| [near.min(d), far.max(d)]);
    (range[0] > 0.0 && range[1].is_finite() && range[0] <= range[1]).then_some(range)
}
