//! Initial coordinates that lie far from everything else, or behind a photo that shows the point: a slip of a digit, or an intersection of
//! parallel rays. They would stretch the frame of the adjustment and pull a free datum after them, and there is no way back through
//! a camera. Where the rays meet elsewhere, and there fit them better by far, the point starts there.

use std::borrow::Cow;
use std::collections::BTreeMap;

use crate::camera::ideal_from_pixel;
use crate::initial::Pose;
use crate::initial::intersection::{Ray, intersect};
use crate::project::{DatumKind, Project, Role};

use super::numbering::Numbering;

/// Times the median distance from the middle of all points and photos.
const FAR: f64 = 30.0;
/// The rays must fit so many times better at their intersection.
const BETTER: f64 = 10.0;

/// The project with tie points that lie far off or behind a photo where their rays meet.
pub fn brought_back<'a>(mut project: Cow<'a, Project>, numbering: &Numbering) -> Cow<'a, Project> {
    for (k, xyz) in found(&project, numbering, Role::Tie) {
        project.to_mut().points[k].xyz = Some(xyz);
    }
    project
}

/// Places in the document of control points whose given coordinates lie far off or behind a photo, and where their rays meet: what
/// is given stays as given, the iteration starts from there.
pub fn control_starts(project: &Project, numbering: &Numbering) -> Vec<(usize, [f64; 3])> {
    if project.datum.kind == DatumKind::Control { found(project, numbering, Role::Control) } else { Vec::new() }
}

fn found(project: &Project, numbering: &Numbering, role: Role) -> Vec<(usize, [f64; 3])> {
    let off = far(project, role).into_iter().chain(behind(project, numbering, role));
    // Of every such point the rows that measure it.
    let mut rows: BTreeMap<usize, Vec<usize>> = off.map(|point| (point, Vec::new())).collect();
    if rows.is_empty() {
        return Vec::new();
    }
    for (row, (_, point)) in numbering.observations.iter().enumerate() {
        if let Some(list) = rows.get_mut(point).filter(|_| project.observations[row].enabled) {
            list.push(row);
        }
    }
    rows.iter().filter_map(|(k, rows)| Some((*k, intersection(project, numbering, *k, rows)?))).collect()
}

/// Points of a role far from all others.
fn far(project: &Project, role: Role) -> Vec<usize> {
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
    off.map(|(k, _)| k).collect()
}

/// Points of a role that lie behind a photo in which they are measured.
fn behind(project: &Project, numbering: &Numbering, role: Role) -> Vec<usize> {
    let poses: Vec<Option<Pose>> = project.photos.iter().map(|p| Pose::of_photo(p).filter(|_| p.enabled)).collect();
    let measured = numbering.observations.iter().zip(&project.observations).filter(|(_, o)| o.enabled);
    let off = measured.filter_map(|(&(photo, point), _)| {
        let xyz = project.points[point].xyz.filter(|_| project.points[point].role == role)?;
        let is_wide = project.cameras[numbering.cameras[photo]].interior.model().is_wide;
        (poses[photo].as_ref()?.to_camera(&nalgebra::Vector3::from(xyz)).z >= 0.0 && !is_wide).then_some(point)
    });
    off.collect()
}

/// Where the rays of a point meet, if they fit much better there.
fn intersection(project: &Project, numbering: &Numbering, point: usize, rows: &[usize]) -> Option<[f64; 3]> {
    let rays: Vec<Ray> = rows
        .iter()
        .filter_map(|&row| {
            let (o, place) = (&project.observations[row], numbering.observations[row].0);
            let photo = Some(&project.photos[place]).filter(|p| p.enabled)?;
            let camera = project.cameras[numbering.cameras[place]].of_photo(photo);
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
