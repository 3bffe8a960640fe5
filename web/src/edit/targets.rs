//! Targets and their names: what a new detection, a matching or marks of an earlier measurement do to the document.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use sightline::detection::{Detection, Target};
use sightline::matching::{Doubt, Mark, Matching, PhotoTargets, Snapped, name_coded, snap};
use sightline::project::{Observation, Point, Project};
use sightline::ring_code::Family;

use super::points::{target_of, tidy};
use crate::store::document::Document;

#[cfg(test)]
mod edits;

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

/// What the rings of all photos are codes of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rings {
    /// Of one family, where there are any.
    Of(Option<Family>),
    /// Of any of these.
    OfSeveral(Vec<Family>),
    /// Of different families.
    Different,
}

impl Default for Rings {
    fn default() -> Self {
        Self::Of(None)
    }
}

/// Takes a new detection of a photo: names follow their targets, codes name the rest. They are codes of the family asked for, or
/// of the one that all photos show together: photos whose rings left it open then get theirs too.
pub fn take_detection(document: &mut Document, photo: &str, detection: Detection, family: Option<Family>) {
    if let Some(family) = take_one(document, photo, detection, family) {
        take_family(document, family);
    }
}

/// Names the rings of all photos as codes of a family.
pub fn take_family(document: &mut Document, family: Family) {
    let open = |t: &Target| t.code != t.code_in(family) || t.code.is_some() && t.code_family != Some(family);
    let photos = document.detections.iter().filter(|(_, d)| d.targets.iter().any(open));
    for (id, detection) in photos.map(|(id, d)| (id.clone(), (**d).clone())).collect::<Vec<_>>() {
        take_one(document, &id, detection, Some(family));
    }
}

/// What the rings of these detections are codes of, by themselves.
pub fn rings(detections: &BTreeMap<String, Arc<Detection>>) -> Rings {
    let of = |(id, d): (&String, &Arc<Detection>)| PhotoTargets { photo: id.clone(), targets: d.targets.clone() };
    let all = detections.iter().map(of).collect::<Vec<_>>();
    let coded = name_coded(&all, None);
    rings_of(&all, coded.family, coded.families)
}

fn rings_of(all: &[PhotoTargets], family: Option<Family>, families: Vec<Family>) -> Rings {
    let ring = |t: &Target| t.code_candidates.iter().any(|c| c.margin > 0.0);
    match family {
        None if families.len() > 1 => Rings::OfSeveral(families),
        None if families.is_empty() && all.iter().flat_map(|p| &p.targets).any(ring) => Rings::Different,
        family => Rings::Of(family),
    }
}

/// Takes one detection; the family that is known then.
fn take_one(document: &mut Document, photo: &str, mut detection: Detection, family: Option<Family>) -> Option<Family> {
    let mut all = by_photo(document);
    all.retain(|targets| targets.photo != photo);
    let new = [PhotoTargets { photo: photo.to_owned(), targets: detection.targets.clone() }];
    all.extend_from_slice(&new);
    let coded = name_coded(&all, family);
    if let Some(family) = coded.family {
        detection.targets.iter_mut().for_each(|target| target.settle_code(family));
    }
    let old = document.detections.get(photo).cloned();
    let (before, others): (Vec<_>, Vec<_>) =
        document.project.observations.iter().cloned().partition(|o: &Observation| o.photo == photo);
    let mut doubtful = (*document.doubtful).clone();
    doubtful.retain(|d| d.photo != photo && d.reason != Doubt::CodeFamily);
    doubtful.extend(coded.doubtful.into_iter().filter(|d| d.photo == photo || d.reason == Doubt::CodeFamily));
    document.doubtful = Arc::new(doubtful);
    document.rings = rings_of(&all, coded.family, coded.families);
    let project = document.project_mut();
    let marks = before.iter().map(|o| Mark {
        photo: photo.to_owned(),
        point: o.point.clone(),
        u: o.u,
        v: o.v,
        sigma: o.sigma.both()[0],
    });
    let snapped = snap(&marks.collect::<Vec<_>>(), &new, FOLLOW);
    let mut now = coded.observations.into_iter().filter(|o| o.photo == photo).collect::<Vec<_>>();
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
    coded.family
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
