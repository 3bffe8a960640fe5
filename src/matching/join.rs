//! Merges new points with known ones: no photo shows both, and their rays intersect as well together as separately, or one lies
//! within the other's disc, where no second target fits.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::PhotoTargets;
use super::free::{MatchOptions, Matching, tolerance_px, views};
use super::photo::OrientedPhoto;
use crate::initial::intersection::{Ray, intersect};
use crate::initial::robust::quantile;
use crate::project::{Project, Role};

/// Tolerances, as distances at the object, within which two points are compared ray by ray.
const NEAR: f64 = 10.0;

/// A ray to a point with the width of its target in the photo, in pixels.
#[derive(Clone, Copy)]
struct SizedRay {
    ray: Ray,
    width: Option<f64>,
}

/// Rays of a point, by photo.
type PointRays = BTreeMap<usize, SizedRay>;

/// Joins new points to what there was before, and to each other.
pub(super) fn join(project: &mut Project, matching: &mut Matching, targets: &[PhotoTargets], options: &MatchOptions) {
    let tolerance = options.tolerance_px.unwrap_or_else(|| tolerance_px(project, &views(project, targets)));
    let photos = OrientedPhoto::all(project);
    let by_id: BTreeMap<&str, usize> = photos.iter().enumerate().map(|(k, photo)| (photo.id.as_str(), k)).collect();
    let widths: BTreeMap<(&str, [u64; 2]), f64> = targets
        .iter()
        .flat_map(|found| found.targets.iter().map(|t| ((found.photo.as_str(), place(t.u, t.v)), t.major)))
        .collect();
    let mut rays: BTreeMap<String, PointRays> = BTreeMap::new();
    for o in project.observations.iter().filter(|o| o.enabled) {
        let Some(&k) = by_id.get(o.photo.as_str()) else { continue };
        let Some(image) = photos[k].ray([o.u, o.v]) else { continue };
        let weight = photos[k].principal_distance_px.powi(2);
        let width = widths.get(&(o.photo.as_str(), place(o.u, o.v))).copied();
        let seen = SizedRay { ray: Ray { pose: photos[k].pose, image, weight }, width };
        rays.entry(o.point.clone()).or_default().insert(k, seen);
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
        let pixel = own.values().map(|seen| pixel_at(&seen.ray, &at)).fold(f64::INFINITY, f64::min);
        let mut same = places.iter().filter(|(other, _)| *other != id).filter(|(other, there)| {
            let Some(theirs) = rays.get(other) else { return false };
            let distance = (there - at).norm();
            let within = || [own, theirs].iter().all(|rays| radius(rays, &at).is_some_and(|r| distance < r));
            !own.keys().any(|photo| theirs.contains_key(photo))
                && (within() || distance <= NEAR * tolerance * pixel && are_one(own, theirs, tolerance))
        });
        // With two candidates the right one is unknown.
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

/// A place in a photo, as it was measured.
fn place(u: f64, v: f64) -> [u64; 2] {
    [u.to_bits(), v.to_bits()]
}

/// Size at the object of a pixel.
fn pixel_at(ray: &Ray, point: &Vector3<f64>) -> f64 {
    (point - ray.pose.centre).norm() / ray.weight.sqrt()
}

/// Radius at the object of the target that these rays point to; of a slanted disc the longer axis keeps its length.
fn radius(rays: &PointRays, point: &Vector3<f64>) -> Option<f64> {
    let radii: Vec<f64> =
        rays.values().filter_map(|seen| Some(seen.width? / 2.0 * pixel_at(&seen.ray, point))).collect();
    (!radii.is_empty()).then(|| quantile(&radii, 0.5))
}

/// Whether the rays of two points meet in one point as well as those of each by itself: a ray that misses its own point by more than
/// the tolerance says nothing about the other one.
fn are_one(own: &PointRays, theirs: &PointRays, tolerance: f64) -> bool {
    let missing = |rays: Vec<Ray>| missing(&rays, tolerance);
    let [own, theirs] = [own, theirs].map(|rays| rays.values().map(|seen| seen.ray).collect::<Vec<_>>());
    let together = own.iter().chain(&theirs).copied().collect();
    // A single ray meets anything.
    let alone = |rays: Vec<Ray>| if rays.len() < 2 { Some(0) } else { missing(rays) };
    missing(together).zip(alone(own).zip(alone(theirs))).is_some_and(|(together, (a, b))| together <= a + b)
}

/// How many rays miss the point where all meet by more than the tolerance.
fn missing(rays: &[Ray], tolerance: f64) -> Option<usize> {
    let found = intersect(rays).ok()?;
    let misses = |ray: &&Ray| ray.pose.misfit(&found.point, ray.image) * ray.weight.sqrt() > tolerance;
    Some(rays.iter().filter(misses).count())
}
