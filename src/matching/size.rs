//! Diameters of new points, from their images.
//!
//! The longer axis of a disc's image is its diameter as seen from the projection centre, whatever its tilt: with the angle α between the rays
//! of the axis' ends and the distance r of the disc, d = 2 r tan(α / 2). The diameter is the median over the photos. The eccentricity of the
//! centre needs it (1 % of it is 2 % of a correction of hundredths of a pixel).

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::photo::OrientedPhoto;
use super::{Matching, PhotoTargets};
use crate::detection::Target;
use crate::initial::robust::quantile;
use crate::project::{DatumKind, Project, Role};

/// Gives the new points of a matching their diameters, where the project fixes the scale: in a model of any scale a diameter would be wrong as
/// soon as the model gets another one.
pub(super) fn measure(project: &Project, targets: &[PhotoTargets], matching: &mut Matching) {
    if !has_scale(project) {
        return;
    }
    let photos: BTreeMap<String, OrientedPhoto> =
        OrientedPhoto::all(project).into_iter().map(|photo| (photo.id.clone(), photo)).collect();
    let by_photo: BTreeMap<&str, &PhotoTargets> = targets.iter().map(|t| (t.photo.as_str(), t)).collect();
    let mut sizes: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    let places: BTreeMap<&str, Vector3<f64>> =
        matching.points.iter().filter_map(|p| Some((p.id.as_str(), Vector3::from(p.xyz?)))).collect();
    for o in &matching.observations {
        let size = || {
            let (xyz, photo) = (places.get(o.point.as_str())?, photos.get(&o.photo)?);
            let target = by_photo.get(o.photo.as_str())?.targets.iter().find(|t| t.u == o.u && t.v == o.v)?;
            seen(photo, target, xyz)
        };
        if let Some(size) = size() {
            sizes.entry(&o.point).or_default().push(size);
        }
    }
    let found: BTreeMap<String, f64> =
        sizes.into_iter().map(|(id, sizes)| (id.to_owned(), quantile(&sizes, 0.5))).collect();
    for point in &mut matching.points {
        point.diameter = found.get(&point.id).copied().filter(|d| d.is_finite() && *d > 0.0).or(point.diameter);
    }
}

fn seen(photo: &OrientedPhoto, target: &Target, xyz: &Vector3<f64>) -> Option<f64> {
    let (sin, cos) = target.angle.sin_cos();
    let half = 0.5 * target.major;
    let end = |side: f64| {
        let [x, y] = photo.ray([target.u + side * half * cos, target.v + side * half * sin])?;
        Some(Vector3::new(x, y, -1.0))
    };
    let angle = end(1.0)?.angle(&end(-1.0)?);
    Some(2.0 * (xyz - photo.pose.centre).norm() * (0.5 * angle).tan())
}

/// Whether lengths of the project are lengths of the object: by distances, control points or given projection centres.
fn has_scale(project: &Project) -> bool {
    let observed: std::collections::BTreeSet<&str> =
        project.observations.iter().filter(|o| o.enabled).map(|o| o.point.as_str()).collect();
    let is_control = project.datum.kind == DatumKind::Control;
    let control = project.points.iter().filter(|p| p.role == Role::Control && observed.contains(p.id.as_str()));
    let centres = project.photos.iter().filter(|p| p.sigma_position.is_some());
    project.distances.iter().any(|d| !d.check) || is_control && (control.count() > 1 || centres.count() > 1)
}
