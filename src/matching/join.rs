//! New points that are points there are: their rays meet those of the other, and no photo shows both.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::PhotoTargets;
use super::photo::OrientedPhoto;
use super::uncoded::{MatchOptions, Matching, tolerance_px, views};
use crate::initial::intersection::{Ray, intersect};
use crate::project::{Project, Role};

/// Tolerances, as distances at the object, within which two points are compared ray by ray.
const NEAR: f64 = 10.0;

/// Joins new points to what there was before, and to each other.
pub(super) fn join(project: &mut Project, matching: &mut Matching, targets: &[PhotoTargets], options: &MatchOptions) {
    let tolerance = options.tolerance_px.unwrap_or_else(|| tolerance_px(project, &views(project, targets)));
    let photos = OrientedPhoto::all(project);
    let by_id: BTreeMap<&str, usize> = photos.iter().enumerate().map(|(k, photo)| (photo.id.as_str(), k)).collect();
    // Rays of every point, by photo.
    let mut rays: BTreeMap<String, BTreeMap<usize, Ray>> = BTreeMap::new();
    for o in project.observations.iter().filter(|o| o.enabled) {
        let Some(&k) = by_id.get(o.photo.as_str()) else { continue };
        let Some(image) = photos[k].ray([o.u, o.v]) else { continue };
        let weight = photos[k].principal_distance_px.powi(2);
        rays.entry(o.point.clone()).or_default().insert(k, Ray { pose: photos[k].pose, image, weight });
    }
    let mut places: Vec<(String, Vector3<f64>)> = project
        .points
        .iter()
        .filter(|p| p.role != Role::Check)
        .filter_map(|p| Some((p.id.clone(), Vector3::from(p.xyz?))))
        .collect();
    let new: Vec<String> = matching.points.iter().map(|point| point.id.clone()).rev().collect();
    for id in new {
        let Some(own) = rays.get(&id).filter(|own| !own.is_empty()) else { continue };
        let Some(at) = places.iter().find(|(other, _)| *other == id).map(|(_, at)| *at) else { continue };
        let depth =
            own.values().map(|ray| (at - ray.pose.centre).norm() / ray.weight.sqrt()).fold(f64::INFINITY, f64::min);
        let near = |other: &&(String, Vector3<f64>)| other.0 != id && (other.1 - at).norm() <= NEAR * tolerance * depth;
        let mut same = places.iter().filter(near).filter(|(other, _)| {
            let Some(theirs) = rays.get(other) else { return false };
            !own.keys().any(|photo| theirs.contains_key(photo)) && meet(own.values().chain(theirs.values()), tolerance)
        });
        // Of two that it could be nobody knows which.
        let (Some((other, _)), None) = (same.next().cloned(), same.next()) else { continue };
        let moved = rays.remove(&id).unwrap_or_default();
        rays.entry(other.clone()).or_default().extend(moved);
        places.retain(|(name, _)| *name != id);
        let observations = project.observations.iter_mut().chain(&mut matching.observations);
        observations.filter(|o| o.point == id).for_each(|o| o.point.clone_from(&other));
        project.points.retain(|point| point.id != id);
        matching.points.retain(|point| point.id != id);
    }
}

/// Whether all rays meet in one point.
fn meet<'a>(rays: impl Iterator<Item = &'a Ray>, tolerance: f64) -> bool {
    let rays: Vec<Ray> = rays.copied().collect();
    let Ok(found) = intersect(&rays) else { return false };
    rays.iter().all(|ray| ray.pose.misfit(&found.point, ray.image) * ray.weight.sqrt() <= tolerance)
}
