//! Targets and their names: what a new detection, a matching or marks of an earlier measurement do to the document.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use sightline::detection::{Detection, Target};
use sightline::matching::{Mark, Matching, PhotoTargets, Snapped, name_coded, snap};
use sightline::project::{Observation, Point, Project};

use super::points::{target_of, tidy};
use crate::store::document::Document;

/// How far a name follows its target when the photo is measured again, in pixels.
const FOLLOW: f64 = 2.0;
/// Two measurements of one target lie nearer to each other than this, in pixels.
const SAME: f64 = 0.5;

/// Targets of all photos, as matching takes them.
pub fn by_photo(document: &Document) -> Vec<PhotoTargets> {
    let of = |(photo, detection): (&String, &Arc<Detection>)| PhotoTargets {
        photo: photo.clone(),
        targets: detection.targets.clone(),
    };
    document.detections.iter().map(of).collect()
}

/// Takes a new detection of a photo: names follow their targets, codes name the rest.
pub fn take_detection(document: &mut Document, photo: &str, detection: Detection) {
    let new = [PhotoTargets { photo: photo.to_owned(), targets: detection.targets.clone() }];
    let old = document.detections.get(photo).cloned();
    let (before, others): (Vec<_>, Vec<_>) =
        document.project.observations.iter().cloned().partition(|o: &Observation| o.photo == photo);
    let coded = name_coded(&new);
    let mut doubtful = (*document.doubtful).clone();
    doubtful.retain(|d| d.photo != photo);
    doubtful.extend(coded.doubtful);
    document.doubtful = Arc::new(doubtful);
    let project = document.project_mut();
    let marks = before.iter().map(|o| Mark {
        photo: photo.to_owned(),
        point: o.point.clone(),
        u: o.u,
        v: o.v,
        sigma: o.sigma.both()[0],
    });
    let snapped = snap(&marks.collect::<Vec<_>>(), &new, FOLLOW);
    let mut now = coded.observations;
    let named = now.iter().map(|o| (o.point.clone(), o.target)).collect::<Vec<_>>();
    let free = |o: &Observation| !named.iter().any(|(point, target)| *point == o.point || *target == o.target);
    now.extend(snapped.observations.into_iter().filter(free));
    let was_target = |o: &Observation| o.target.is_some_and(|id| old.as_ref().is_some_and(|d| d.target(id).is_some()));
    let still_here = now.iter().map(|o| o.point.clone()).collect::<BTreeSet<_>>();
    now.extend(before.iter().filter(|o| !still_here.contains(&o.point) && !was_target(o)).cloned());
    for observation in &mut now {
        if let Some(earlier) = before.iter().find(|o| o.point == observation.point) {
            observation.enabled = earlier.enabled;
        }
    }
    project.observations = others;
    project.observations.append(&mut now);
    tidy(project);
    document.detections_mut().insert(photo.to_owned(), Arc::new(detection));
}

/// Adds a target measured on request to the photo's list, or finds it there; its place in the list.
pub fn add(document: &mut Document, photo: &str, target: Target) -> usize {
    let detections = document.detections_mut();
    let mut detection = detections.get(photo).map(|d| (**d).clone()).unwrap_or_default();
    let same = |t: &Target| (t.u - target.u).hypot(t.v - target.v) < SAME;
    let at = detection.targets.iter().position(same).unwrap_or(detection.targets.len());
    if at == detection.targets.len() {
        detection.targets.push(Target { id: 0, ..target });
        detection.number_targets();
        detections.insert(photo.to_owned(), Arc::new(detection));
    }
    at
}

/// Takes what matching found, where neither the point nor the place has an observation; what is doubtful is listed.
pub fn take_matching(document: &mut Document, matching: Matching) {
    document.doubtful = Arc::new(matching.doubtful);
    let project = document.project_mut();
    let taken = project.observations.iter().map(|o| (o.photo.clone(), o.point.clone())).collect::<BTreeSet<_>>();
    let centres = project.observations.iter().filter_map(target_of).collect::<BTreeSet<_>>();
    let new = |o: &Observation| {
        !taken.contains(&(o.photo.clone(), o.point.clone())) && target_of(o).is_none_or(|at| !centres.contains(&at))
    };
    project.observations.extend(matching.observations.into_iter().filter(new));
    for point in matching.points {
        if !project.points.iter().any(|p| p.id == point.id) {
            project.points.push(Point { xyz: None, ..point });
        }
    }
    tidy(project);
}

/// Takes marks that snapped as observations of the measured centres, in place of what was there; how many.
pub fn take_marks(project: &mut Project, snapped: &Snapped) -> usize {
    let mut taken = BTreeMap::<(String, String), Observation>::new();
    for o in &snapped.observations {
        taken.insert((o.photo.clone(), o.point.clone()), o.clone());
    }
    let centres = taken.values().filter_map(target_of).collect::<BTreeSet<_>>();
    let replaced = |o: &Observation| {
        taken.contains_key(&(o.photo.clone(), o.point.clone())) || target_of(o).is_some_and(|at| centres.contains(&at))
    };
    project.observations.retain(|o| !replaced(o));
    let count = taken.len();
    project.observations.extend(taken.into_values());
    tidy(project);
    count
}
