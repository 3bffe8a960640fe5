//! Initial coordinates that lie far from everything else, or behind a photo that shows the point: a slip of a digit, or an intersection of
//! parallel rays. They would stretch the frame of the adjustment and pull a free datum after them, and there is no way back through
//! a camera. Where the rays meet elsewhere, and there fit them better by far, the point starts there.

use std::borrow::Cow;
use std::collections::HashMap;

use crate::camera::ideal_from_pixel;
use crate::initial::Pose;
use crate::initial::intersection::{Ray, intersect};
use crate::project::{DatumKind, Observation, Project, Role};

/// Times the median distance from the middle of all points and photos.
const FAR: f64 = 30.0;
/// The rays must fit so many times better at their intersection.
const BETTER: f64 = 10.0;

/// The project with tie points that lie far off or behind a photo where their rays meet.
pub fn brought_back(mut project: Cow<'_, Project>) -> Cow<'_, Project> {
    for (k, xyz) in found(&project, Role::Tie) {
        project.to_mut().points[k].xyz = Some(xyz);
    }
    project
}

/// Places in the document of control points whose given coordinates lie far off or behind a photo, and where their rays meet: what
/// is given stays as given, the iteration starts from there.
pub fn control_starts(project: &Project) -> Vec<(usize, [f64; 3])> {
    if project.datum.kind == DatumKind::Control { found(project, Role::Control) } else { Vec::new() }
}

fn found(project: &Project, role: Role) -> Vec<(usize, [f64; 3])> {
    let mut off = far(project, role);
    off.extend(behind(project, role));
    off.sort_unstable();
    off.dedup();
    if off.is_empty() {
        return Vec::new();
    }
    let mut sights: HashMap<&str, Vec<&Observation>> = off.iter().map(|(id, _)| (*id, Vec::new())).collect();
    for o in project.observations.iter().filter(|o| o.enabled) {
        if let Some(list) = sights.get_mut(o.point.as_str()) {
            list.push(o);
        }
    }
    let place = |(id, k): &(&str, usize)| Some((*k, intersection(project, *k, &sights[id])?));
    off.iter().filter_map(place).collect()
}

/// Identifiers and places of the points of a role far from all others.
fn far(project: &Project, role: Role) -> Vec<(&str, usize)> {
    let places: Vec<[f64; 3]> =
        project.points.iter().filter_map(|p| p.xyz).chain(project.photos.iter().filter_map(|p| p.position)).collect();
    let median = |mut list: Vec<f64>| {
        let middle = list.len() / 2;
        *list.select_nth_unstable_by(middle, f64::total_cmp).1
    };
    if places.len() < 5 {
        return Vec::new();
    }
    let middle: [f64; 3] = std::array::from_fn(|a| median(places.iter().map(|p| p[a]).collect()));
    let from = |p: &[f64; 3]| (0..3).map(|a| (p[a] - middle[a]).powi(2)).sum::<f64>().sqrt();
    let usual = median(places.iter().map(from).collect());
    let ties = project.points.iter().enumerate().filter(|(_, p)| p.role == role);
    let off = ties.filter(|(_, p)| p.xyz.is_some_and(|xyz| from(&xyz) > FAR * usual));
    off.map(|(k, p)| (p.id.as_str(), k)).collect()
}

/// Identifiers and places of the points of a role that lie behind a photo in which they are measured.
fn behind(project: &Project, role: Role) -> Vec<(&str, usize)> {
    let photos = project.photos.iter().filter(|p| p.enabled);
    let poses: HashMap<&str, Pose> = photos.filter_map(|p| Some((p.id.as_str(), Pose::of_photo(p)?))).collect();
    let ties = project.points.iter().enumerate().filter(|(_, p)| p.role == role);
    let ties: HashMap<&str, (usize, [f64; 3])> = ties.filter_map(|(k, p)| Some((p.id.as_str(), (k, p.xyz?)))).collect();
    let measured = project.observations.iter().filter(|o| o.enabled);
    let off = measured.filter_map(|o| {
        let (pose, (k, xyz)) = (poses.get(o.photo.as_str())?, ties.get(o.point.as_str())?);
        (pose.to_camera(&nalgebra::Vector3::from(*xyz)).z >= 0.0).then_some((o.point.as_str(), *k))
    });
    off.collect()
}

/// Where the rays of a point meet, if they fit much better there.
fn intersection(project: &Project, point: usize, sights: &[&Observation]) -> Option<[f64; 3]> {
    let rays: Vec<Ray> = sights
        .iter()
        .filter_map(|o| {
            let photo = project.photos.iter().find(|p| p.id == o.photo && p.enabled)?;
            let camera = project.cameras.iter().find(|c| c.id == photo.camera)?.of_photo(photo);
            Some(Ray { pose: Pose::of_photo(photo)?, image: ideal_from_pixel(&camera, [o.u, o.v])?, weight: 1.0 })
        })
        .collect();
    let found = intersect(&rays).ok()?.point;
    let before = nalgebra::Vector3::from(project.points[point].xyz?);
    // At the projection centre or behind the camera there is no misfit: no fit either.
    let misfit = |at: &nalgebra::Vector3<f64>| rays.iter().map(|ray| ray.pose.misfit(at, ray.image)).sum::<f64>();
    let (was, is) = (misfit(&before), misfit(&found));
    let better = is.is_finite() && (!was.is_finite() || BETTER * is < was);
    (better && found.iter().all(|x| x.is_finite())).then(|| found.into())
}
