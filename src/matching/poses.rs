//! The pose of a photo with few names, from the targets of known points.
//!
//! Three or four named points, or points of one plane, have more than one resection that fits alike, and one that is right is
//! not accurate far from them. The photo shows the other points, too: every resection of the named points is refined by the targets that
//! lie where it sees points ("nearest neighbour, resect, repeat", as in iterative closest points), and the pose that explains most
//! of them is taken.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::PhotoTargets;
use super::free::{FreeTargets, MatchOptions, tolerance_px, views};
use crate::initial::Pose;
use crate::initial::resection::space_resection;
use crate::project::{Project, Role};
use crate::rotation;

/// A photo of so many named points has the pose that these give it.
const MANY: usize = 12;
/// Radii of the search, in tolerances, one resection each.
const RADII: [f64; 5] = [4.0, 3.0, 2.0, 1.0, 1.0];
/// Minimum number of targets that agree with a pose, minimum share of the visible points, and minimum excess over the present pose.
const FEWEST: usize = 6;
const SHARE: f64 = 0.5;
const BETTER: usize = 3;

/// Points of a photo with their ideal coordinates.
type PointPairs = (Vec<Vector3<f64>>, Vec<[f64; 2]>);

/// Gives photos of few named points the pose with which most targets agree.
pub(super) fn from_targets(project: &mut Project, targets: &[PhotoTargets], options: &MatchOptions) {
    let views = views(project, targets);
    let tolerance = options.tolerance_px.unwrap_or_else(|| tolerance_px(project, &views));
    let mut rays: BTreeMap<&str, usize> = BTreeMap::new();
    let oriented: std::collections::BTreeSet<&str> = views.iter().map(|v| v.photo.id.as_str()).collect();
    let enabled = project.observations.iter().filter(|o| o.enabled);
    for o in enabled.clone().filter(|o| oriented.contains(o.photo.as_str())) {
        *rays.entry(&o.point).or_default() += 1;
    }
    let mut known: BTreeMap<&str, Vector3<f64>> = BTreeMap::new();
    for point in project.points.iter().filter(|p| p.role != Role::Check) {
        let held = point.role == Role::Control || rays.get(point.id.as_str()).is_some_and(|n| *n >= 2);
        if let Some(xyz) = point.xyz.filter(|_| held) {
            known.insert(&point.id, xyz.into());
        }
    }
    let mut found = Vec::new();
    for view in &views {
        let own = enabled.clone().filter(|o| o.photo == view.photo.id);
        let own: Vec<(&str, [f64; 2])> =
            own.filter_map(|o| Some((o.point.as_str(), view.photo.ray([o.u, o.v])?))).collect();
        let named = own.iter().filter_map(|(id, image)| Some((*known.get(id)?, *image)));
        let named: PointPairs = named.unzip();
        if !(3..MANY).contains(&named.0.len()) {
            continue;
        }
        let others: Vec<Vector3<f64>> =
            known.iter().filter(|(id, _)| !own.iter().any(|o| o.0 == **id)).map(|(_, xyz)| *xyz).collect();
        if let Some(pose) = best(view, &named, &others, tolerance) {
            found.push((view.photo.id.clone(), pose));
        }
    }
    for (id, pose) in found {
        for photo in project.photos.iter_mut().filter(|photo| photo.id == id) {
            photo.position = Some(pose.centre.into());
            photo.rotation = Some(rotation::angles(&pose.object_to_camera));
        }
    }
}

/// The pose that explains most targets, where it explains more than the present one.
fn best(view: &FreeTargets, named: &PointPairs, others: &[Vector3<f64>], tolerance: f64) -> Option<Pose> {
    let present = explained(view, &view.photo.pose, others, tolerance).object.len();
    let resections = space_resection(&named.0, &named.1).unwrap_or_default().into_iter().map(|found| found.pose);
    let mut best: Option<(usize, Pose)> = None;
    for start in std::iter::once(view.photo.pose).chain(resections) {
        let Some((count, seen, pose)) = refined(view, start, named, others, tolerance) else { continue };
        let enough = count >= FEWEST && count as f64 >= SHARE * seen as f64 && count >= present + BETTER;
        if enough && best.as_ref().is_none_or(|(most, _)| count > *most) {
            best = Some((count, pose));
        }
    }
    best.map(|(_, pose)| pose)
}

/// A pose refined by the targets it explains, their number, and that of the points it sees.
fn refined(
    view: &FreeTargets,
    start: Pose,
    named: &PointPairs,
    others: &[Vector3<f64>],
    tolerance: f64,
) -> Option<(usize, usize, Pose)> {
    let mut pose = start;
    for radius in RADII {
        let Explained { mut object, mut image, .. } = explained(view, &pose, others, radius * tolerance);
        object.extend(&named.0);
        image.extend(&named.1);
        pose = pose.refined(&object, &image)?;
    }
    // Names are not given up for targets.
    let own = named
        .0
        .iter()
        .zip(&named.1)
        .filter(|(x, image)| pose.misfit(x, **image) * view.photo.principal_distance_px <= RADII[0] * tolerance);
    if own.count() < named.0.len() {
        return None;
    }
    let found = explained(view, &pose, others, tolerance);
    Some((found.object.len(), found.seen, pose))
}

/// Points of which one target alone lies where a pose sees them.
struct Explained {
    object: Vec<Vector3<f64>>,
    /// Their targets as rays.
    image: Vec<[f64; 2]>,
    /// How many points the pose sees, with a target or without.
    seen: usize,
}

fn explained(view: &FreeTargets, pose: &Pose, points: &[Vector3<f64>], radius_px: f64) -> Explained {
    let (mut object, mut image) = (Vec::new(), Vec::new());
    let mut seen = 0;
    for x in points {
        let Some(place) = pose.image(x).filter(|place| view.photo.images(*place)) else { continue };
        seen += 1;
        if let Some((free, false)) = view.nearest(place, radius_px, |f| !f.coded) {
            object.push(*x);
            image.push(view.free[free].ray);
        }
    }
    Explained { object, image, seen }
}
