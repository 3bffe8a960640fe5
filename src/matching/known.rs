//! Points with given coordinates that no photo names yet: dots of a calibration sheet whose control file is in the project.
//!
//! They are looked for where the photos should show them, so that their targets do not become new points beside them. That needs photos
//! that are in the system of the given coordinates: named given points at their predicted positions show this.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::free::{FreeTargets, similar};
use crate::project::{Point, Project, Role};

/// Given points that have to be seen in their places: three fix a system.
const WITNESSES: usize = 3;
/// Standard errors of the given coordinates within which a target is looked for.
const SIGMAS: f64 = 3.0;

/// Image measurements of points, by point: photo and pixel.
pub(super) type MeasuredPixels<'a> = BTreeMap<&'a str, Vec<(&'a str, [f64; 2])>>;

/// Whether the photos are in the system of the given coordinates: three named control points at least, and most of those that there are, are
/// seen where these put them.
pub(super) fn is_their_system(
    project: &Project,
    views: &[FreeTargets],
    seen: &MeasuredPixels,
    tolerance_px: f64,
) -> bool {
    let by_id: BTreeMap<&str, &FreeTargets> = views.iter().map(|view| (view.photo.id.as_str(), view)).collect();
    let (mut agree, mut all) = (0, 0);
    for point in project.points.iter().filter(|p| p.role == Role::Control) {
        let (Some(xyz), Some(rays)) = (point.xyz.map(Vector3::from), seen.get(point.id.as_str())) else { continue };
        let off = |(photo, pixel): &(&str, [f64; 2])| {
            let view = by_id.get(photo)?;
            let misfit = view.photo.pose.misfit(&xyz, view.photo.ray(*pixel)?) * view.photo.principal_distance_px;
            Some(misfit <= radius_px(view, point, &xyz, tolerance_px))
        };
        let found: Vec<bool> = rays.iter().filter_map(off).collect();
        if !found.is_empty() {
            all += 1;
            agree += usize::from(found.iter().all(|fits| *fits));
        }
    }
    agree >= WITNESSES && 2 * agree > all
}

/// How far from its place a given point may be seen: what the photos leave open and what its own standard errors do.
pub(super) fn radius_px(view: &FreeTargets, point: &Point, xyz: &Vector3<f64>, tolerance_px: f64) -> f64 {
    let sigma = point.sigma.iter().flatten().flatten().copied().fold(0.0, f64::max);
    let depth = -view.photo.pose.to_camera(xyz).z;
    if !(depth > 0.0) {
        return tolerance_px;
    }
    tolerance_px.hypot(SIGMAS * sigma * view.photo.principal_distance_px / depth)
}

/// The free target of a photo that is a given point, and whether it is the only one; none nearer than half its own size to another's place.
pub(super) fn target(view: &FreeTargets, point: &Point, tolerance_px: f64) -> Option<(usize, bool)> {
    let xyz = Vector3::from(point.xyz?);
    let image = view.photo.pose.image(&xyz)?;
    let fits = |size: f64| point.diameter.is_none_or(|diameter| similar(size, diameter));
    let radius = radius_px(view, point, &xyz, tolerance_px);
    let (free, more) = view.nearest(image, radius, |f| fits(view.size(f.diameter_px, &xyz)))?;
    // Beyond half a target's size the neighbour could be meant.
    let ray = view.free[free].ray;
    let off = (ray[0] - image[0]).hypot(ray[1] - image[1]) * view.photo.principal_distance_px;
    (off <= tolerance_px.max(0.5 * view.free[free].diameter_px)).then_some((free, !more))
}
