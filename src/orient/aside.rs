//! What cannot take part in an adjustment is set aside in the project, with its reason.

use std::collections::{HashMap, HashSet};

use super::block::OrientationBlock;
use super::tied;
use crate::project::{DatumKind, Observation, Project, Role, SetAside, SetAsideBy, SetAsideReason};

/// Measurements a photo needs at least.
const FEWEST: usize = 3;

/// Photo and point of the observations that an earlier orientation set aside.
pub(super) fn of(project: &Project) -> HashSet<(&str, &str)> {
    project.set_aside.iter().map(|s| (s.photo.as_str(), s.point.as_str())).collect()
}

/// Whether an orientation looks at an observation: it is enabled, or an earlier orientation disabled it.
pub(super) fn is_offered(aside: &HashSet<(&str, &str)>, observation: &Observation) -> bool {
    observation.enabled || aside.contains(&(observation.photo.as_str(), observation.point.as_str()))
}

/// Disables the measurements that disagree, those of photos and points without initial values, and those of points and
/// photos that are left with too few of them; what an earlier orientation set aside and this one did not comes back.
pub(super) fn set_aside(project: &mut Project, block: &OrientationBlock) {
    if block.oriented() == 0 {
        return;
    }
    let index =
        |ids: Vec<String>| -> HashMap<String, usize> { ids.into_iter().enumerate().map(|(k, id)| (id, k)).collect() };
    let photo_at = index(project.photos.iter().map(|p| p.id.clone()).collect());
    let point_at = index(project.points.iter().map(|p| p.id.clone()).collect());
    // The block holds the offered observations of enabled photos in the project's order.
    let aside = of(project);
    let rows: Vec<usize> = (0..project.observations.len())
        .filter(|&row| {
            let o = &project.observations[row];
            is_offered(&aside, o) && project.photos[photo_at[&o.photo]].enabled
        })
        .collect();
    let places: Vec<(usize, usize)> = rows
        .iter()
        .map(|&row| (photo_at[&project.observations[row].photo], point_at[&project.observations[row].point]))
        .collect();
    let controlled = project.datum.kind == DatumKind::Control;
    let undecided: HashSet<usize> = (0..project.points.len())
        .filter(|&k| project.points[k].xyz.is_none() && tied::sides(block, k).is_some())
        .collect();
    let mut reasons: Vec<Option<SetAsideReason>> = places
        .iter()
        .enumerate()
        .map(|(observation, &(photo, point))| {
            let posed = project.photos[photo].position.is_some() && project.photos[photo].rotation.is_some();
            if !posed {
                Some(SetAsideReason::PhotoNotOriented)
            } else if undecided.contains(&point) {
                Some(SetAsideReason::Undecided)
            } else if project.points[point].xyz.is_none() {
                Some(SetAsideReason::PointNotDetermined)
            } else {
                block.is_wrong(observation).then_some(SetAsideReason::Disagrees)
            }
        })
        .collect();
    loop {
        let mut of_photo = vec![0; project.photos.len()];
        let mut of_point = vec![0; project.points.len()];
        for (&(photo, point), _) in places.iter().zip(&reasons).filter(|(_, reason)| reason.is_none()) {
            of_photo[photo] += 1;
            of_point[point] += 1;
        }
        let mut changed = false;
        for (&(photo, point), reason) in places.iter().zip(&mut reasons).filter(|(_, reason)| reason.is_none()) {
            let known = controlled && project.points[point].role == Role::Control;
            if of_photo[photo] < FEWEST {
                *reason = Some(SetAsideReason::PhotoNotOriented);
            } else if of_point[point] < 2 && !known {
                *reason = Some(SetAsideReason::PointNotDetermined);
            }
            changed |= reason.is_some();
        }
        if !changed {
            break;
        }
    }
    let mut listed = Vec::new();
    for (k, (row, reason)) in rows.into_iter().zip(reasons).enumerate() {
        let observation = &mut project.observations[row];
        observation.enabled = reason.is_none();
        listed.extend(reason.map(|reason| SetAside {
            photo: observation.photo.clone(),
            point: observation.point.clone(),
            reason,
            distance_px: block.misfit_px(k).filter(|px| px.is_finite()),
            by: SetAsideBy::Orientation,
        }));
    }
    project.set_aside = listed;
}

/// Control points that decide the system of the adjustment, at least.
const DATUM: usize = 3;

/// Sets control aside that did not agree so far that the photos could be oriented by it: they are in a system of their own, in which given
/// coordinates mean nothing.
pub(super) fn set_control_aside(project: &mut Project) {
    let control: HashSet<&str> =
        project.points.iter().filter(|p| p.role == Role::Control && p.xyz.is_some()).map(|p| p.id.as_str()).collect();
    let rows: Vec<usize> = (0..project.observations.len())
        .filter(|&row| project.observations[row].enabled && control.contains(project.observations[row].point.as_str()))
        .collect();
    let measured: HashSet<&str> = rows.iter().map(|&row| project.observations[row].point.as_str()).collect();
    if project.datum.kind != DatumKind::Control || measured.len() < DATUM {
        return;
    }
    for row in rows {
        let observation = &mut project.observations[row];
        observation.enabled = false;
        project.set_aside.push(SetAside {
            photo: observation.photo.clone(),
            point: observation.point.clone(),
            reason: SetAsideReason::Disagrees,
            distance_px: None,
            by: SetAsideBy::Orientation,
        });
    }
}
