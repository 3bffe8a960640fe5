//! Displacements between epochs in the photos of an epoch: where a target is, and where it would be displaced by a multiple.
//!
//! Displacements are in the system of the first epoch, photos in that of their own project. The similarity of the points that both have
//! brings one into the other, from those that agree with each other: points that moved do not turn it.

use std::collections::{HashMap, HashSet};

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::photo::OrientedPhoto;
use crate::adjust::apply;
use crate::adjustment::Adjustment;
use crate::camera::pixel_from_camera_point;
use crate::error::{Error, Place, Reason, Result};
use crate::initial::similarity::fit_robust;
use crate::monitoring::{Displacement, Pair};
use crate::project::Project;

/// The displacement of a point in a photo, pixels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhotoVector {
    /// Identifier in the project of the photo.
    pub point: String,
    /// Where the point is.
    pub from: [f64; 2],
    /// Where it would be, displaced by the multiple.
    pub to: [f64; 2],
    /// Length of the displacement, in the unit of the epochs.
    pub length: f64,
    /// Whether it moved: an object point with a significant displacement, or a reference point that is not stable.
    pub moved: bool,
}

/// The displacements that a photo shows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhotoVectors {
    /// Identifier of the photo.
    pub photo: String,
    /// Of the points that are measured in it.
    pub vectors: Vec<PhotoVector>,
    /// Points that are measured in it, whose displacement ends where the camera has no image of it at this factor: behind it, or far beside.
    pub not_drawn: Vec<String>,
}

/// Displacements of a pair of epochs, `factor` times as long, in the photos of an adjusted project of the same object.
///
/// # Errors
/// [`Error::Invalid`] for a factor that is not positive, and for a project that shares fewer than three points with the pair, or all on a line;
/// those of [`Project::validate`].
pub fn displaced(project: &Project, adjustment: &Adjustment, pair: &Pair, factor: f64) -> Result<Vec<PhotoVectors>> {
    project.validate()?;
    if !(factor > 0.0 && factor < 1e12) {
        let reason = Reason::NotPositive { name: "factor".into(), value: factor.into() };
        return Err(Error::Invalid { reason, at: Place::field("factor") });
    }
    let adjusted: HashMap<&str, Vector3<f64>> =
        adjustment.points.iter().map(|p| (p.id.as_str(), Vector3::from(p.xyz))).collect();
    let here = |p: &Displacement| -> Option<(String, Vector3<f64>)> {
        // The name of the later epoch goes first: in the earlier one it is no other point's.
        let names = [p.later_id.as_deref(), Some(p.id.as_str())];
        let name = names.into_iter().flatten().find(|name| adjusted.contains_key(name))?;
        Some((name.to_owned(), adjusted[name]))
    };
    let found: Vec<(&Displacement, String, Vector3<f64>)> =
        pair.points.iter().filter_map(|p| here(p).map(|(name, place)| (p, name, place))).collect();
    let source: Vec<Vector3<f64>> = found.iter().map(|(p, ..)| Vector3::from(p.xyz)).collect();
    let target: Vec<Vector3<f64>> = found.iter().map(|(.., place)| *place).collect();
    let (fit, _) = fit_robust(&source, &target, 0).map_err(|_| Error::Invalid {
        reason: Reason::DisplacedApart { given: source.len() },
        at: Place::field("project"),
    })?;
    let turned = fit.transform.rotation * fit.transform.scale;
    let measured: HashSet<(&str, &str)> =
        project.observations.iter().filter(|o| o.enabled).map(|o| (o.photo.as_str(), o.point.as_str())).collect();
    let oriented = apply(project, adjustment);
    let of_photo = |photo: &OrientedPhoto| {
        let pixel = |place: Vector3<f64>| pixel_from_camera_point(&photo.camera, photo.pose.to_camera(&place));
        let own = found.iter().filter(|(_, name, _)| measured.contains(&(photo.id.as_str(), name.as_str())));
        let (mut vectors, mut not_drawn) = (Vec::new(), Vec::new());
        for (p, name, place) in own {
            let by = turned * Vector3::from(p.difference) * factor;
            let Some((from, to)) = pixel(*place).zip(pixel(place + by)) else {
                not_drawn.push(name.clone());
                continue;
            };
            let moved = p.moved || pair.unstable.contains(&p.id);
            vectors.push(PhotoVector { point: name.clone(), from, to, length: p.length, moved });
        }
        PhotoVectors { photo: photo.id.clone(), vectors, not_drawn }
    };
    Ok(OrientedPhoto::all(&oriented).iter().map(of_photo).collect())
}
