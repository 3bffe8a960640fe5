//! Targets and their names: what a new detection, a matching or marks of an earlier measurement do to the document.

use crate::document::rings::Rings;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use sightline::detection::{Codes, Detection, Target};
use sightline::matching::{Doubt, Mark, Matching, PhotoTargets, Snapped, name_coded, snap};
use sightline::project::{Observation, Point, Project};
use sightline::ring_code::Family;

use super::points::{target_of, tidy};
use crate::document::Document;

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

/// Reading of a single ring: it may be a code of several families, so under "auto" it is one of the family that the photos show,
/// and none while that is open.
pub fn codes_of_one(asked: Codes, rings: &Rings) -> Codes {
    match (asked, rings) {
        (Codes::Auto, Rings::Of(Some(family))) => (*family).into(),
        (Codes::Auto, _) => Codes::None,
        (asked, _) => asked,
    }
}

/// Candidate codes of a target whose code was not read: numbers by family, of the photos' own family alone where that is known.
pub fn candidates(target: &Target, rings: &Rings) -> BTreeMap<Family, Vec<u32>> {
    let mut candidates = BTreeMap::<Family, Vec<u32>>::new();
    let counts = |family: Family| !matches!(rings, Rings::Of(Some(own)) if *own != family);
    for c in target.code_candidates.iter().filter(|c| target.code.is_none() && counts(c.family)) {
        candidates.entry(c.family).or_default().push(c.number);
    }
    candidates
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

/// The targets of a photo that may be named by their codes: others give no information on the family or names, and to go through all targets of
/// all photos with each photo that is done would make detection grow with the square of their number.
fn with_rings(photo: &str, targets: &[Target]) -> PhotoTargets {
    let may = |t: &&Target| t.code.is_some() || t.code_family.is_some() || !t.code_candidates.is_empty();
    PhotoTargets { photo: photo.to_owned(), targets: targets.iter().filter(may).cloned().collect() }
}

/// Code family of these detections.
pub fn rings(detections: &BTreeMap<String, Arc<Detection>>) -> Rings {
    let all = detections.iter().map(|(id, d)| with_rings(id, &d.targets)).collect::<Vec<_>>();
    let coded = name_coded(&all, None);
    rings_of(&all, coded.family, coded.families)
}

fn rings_of(all: &[PhotoTargets], family: Option<Family>, families: Vec<Family>) -> Rings {
    let ring = |t: &Target| t.code_family.is_some() || t.code_candidates.iter().any(|c| c.margin > 0.0);
    match family {
        None if families.len() > 1 => Rings::OfSeveral(families),
        None if families.is_empty() && all.iter().flat_map(|p| &p.targets).any(ring) => Rings::Different,
        family => Rings::Of(family),
    }
}

/// Takes one detection; the family that is known then.
fn take_one(document: &mut Document, photo: &str, mut detection: Detection, family: Option<Family>) -> Option<Family> {
    let others = document.detections.iter().filter(|(id, _)| *id != photo);
    let mut all = others.map(|(id, d)| with_rings(id, &d.targets)).collect::<Vec<_>>();
    all.retain(|photo| !photo.targets.is_empty());
    all.push(with_rings(photo, &detection.targets));
    let new = [PhotoTargets { photo: photo.to_owned(), targets: detection.targets.clone() }];
    let coded = name_coded(&all, family);
    if let Some(family) = coded.family {
        detection.targets.iter_mut().for_each(|target| target.settle_code(family));
    }
    let old = document.detections.get(photo).cloned();
    let (mut before, others): (Vec<_>, Vec<_>) =
        document.project.observations.iter().cloned().partition(|o: &Observation| o.photo == photo);
    // a code of a family that it is not of names a target no longer
    if let Some(family) = coded.family {
        let of_other = |t: &Target| t.code_family.is_some_and(|own| own != family);
        let misnamed =
            |o: &Observation, t: &Target| of_other(t) && t.code.is_some_and(|code| o.point == code.to_string());
        let target = |o: &Observation| old.as_ref()?.target(o.target?);
        before.retain(|o| !target(o).is_some_and(|t| misnamed(o, t)));
    }
    let mut doubtful = (*document.doubtful).clone();
    doubtful.retain(|d| d.photo != photo && d.reason != Doubt::CodeFamily);
    doubtful.extend(coded.doubtful.into_iter().filter(|d| d.photo == photo || d.reason == Doubt::CodeFamily));
    document.doubtful = Arc::new(doubtful);
    document.rings = rings_of(&all, coded.family, coded.families);
    let marks = before.iter().map(|o| Mark {
        photo: photo.to_owned(),
        point: o.point.clone(),
        u: o.u,
        v: o.v,
        sigma: o.sigma.both()[0],
    });
    let snapped = snap(&marks.collect::<Vec<_>>(), &new, FOLLOW);
    let mut now = coded.observations.into_iter().filter(|o| o.photo == photo).collect::<Vec<_>>();
    // In a later epoch a point has the name that it was given in the first.
    if let Some(epoch) = &document.project.epoch {
        for observation in &mut now {
            if let Some(name) = epoch.names.get(&observation.point) {
                observation.point.clone_from(name);
            }
        }
    }
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
    // Where no name comes or goes the project stays what it is, and is not stored again.
    if !now.is_empty() || others.len() != document.project.observations.len() {
        let project = document.project_mut();
        project.observations = others.into();
        project.observations.append(&mut now);
        tidy(project);
    }
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

#[cfg(test)]
mod tests {
    use Family::{Ring12, Ring14, Ring20};
    use sightline::detection::{CodeCandidate, CodeNote};

    use super::*;

    /// Readings of a ring: family, number, margin.
    type Ring = &'static [(Family, u32, f64)];

    /// A photo as it is detected by itself: rings that are codes of one family alone have their number.
    fn found(rings: &[Ring]) -> Detection {
        let target = |(k, ring): (usize, &Ring)| {
            let safe = ring.iter().filter(|(_, _, margin)| *margin > 0.0).collect::<Vec<_>>();
            let own = if let [own] = safe[..] { Some(*own) } else { None };
            let candidate = |&(family, number, margin): &(Family, u32, f64)| CodeCandidate { family, number, margin };
            let others = ring.iter().filter(|reading| Some(**reading) != own).map(candidate);
            let mut target = crate::edit::undoing::target(k as u32 + 1, 20.0 * k as f64, 5.0);
            (target.code, target.code_family) = (own.map(|(_, code, _)| code), own.map(|(family, _, _)| family));
            (target.code_candidates, target.quality.code_margin) = (others.collect(), own.map(|(_, _, margin)| margin));
            target
        };
        Detection { targets: rings.iter().enumerate().map(target).collect(), ..Detection::default() }
    }

    fn document(photos: &[&[Ring]]) -> Document {
        let mut document = Document::default();
        for (k, rings) in photos.iter().enumerate() {
            take_detection(&mut document, &k.to_string(), found(rings), None);
        }
        document
    }

    /// Names by photo, in the order of the targets.
    fn names(document: &Document) -> Vec<String> {
        let mut seen = document.project.observations.iter().collect::<Vec<_>>();
        seen.sort_by_key(|o| (o.photo.clone(), o.target));
        seen.into_iter().map(|o| format!("{}:{}", o.photo, o.point)).collect()
    }

    /// Of 12 or of 20 bits, of 12 alone, of 14 alone; of 12, and of 20 in doubt; of 20 alone.
    const EITHER: Ring = &[(Ring12, 5, 0.9), (Ring20, 77, 0.8)];
    const TWELVE: Ring = &[(Ring12, 9, 0.9)];
    const FOURTEEN: Ring = &[(Ring14, 3, 0.9)];
    const DOUBTED: Ring = &[(Ring12, 6, 0.7), (Ring20, 70, 0.0), (Ring20, 71, 0.0)];
    const TWENTY: Ring = &[(Ring20, 8, 0.9)];

    #[test]
    fn the_family_is_that_of_all_photos_together() {
        let none = document(&[&[&[]]]);
        assert_eq!((none.rings.clone(), names(&none).len()), (Rings::Of(None), 0));
        let several = document(&[&[EITHER], &[EITHER]]);
        assert_eq!((several.rings.clone(), names(&several).len()), (Rings::OfSeveral(vec![Ring12, Ring20]), 0));
        // the last photo answers for those before it
        let answered = document(&[&[EITHER], &[TWELVE]]);
        assert_eq!(
            (answered.rings.clone(), names(&answered)),
            (Rings::Of(Some(Ring12)), vec!["0:5".into(), "1:9".into()])
        );
        for document in [&none, &several, &answered] {
            assert_eq!(rings(&document.detections), document.rings, "as when the project is opened again");
        }
        // whichever of two families comes first
        assert_eq!(document(&[&[TWELVE], &[FOURTEEN]]).rings, Rings::Different);
        assert_eq!(document(&[&[FOURTEEN], &[TWELVE, EITHER]]).rings, Rings::Different);
    }

    #[test]
    fn the_family_that_is_chosen_names_the_rings_of_all_photos() {
        let mut document = document(&[&[EITHER], &[EITHER, &[]]]);
        take_family(&mut document, Ring20);
        assert_eq!(
            (document.rings.clone(), names(&document)),
            (Rings::Of(Some(Ring20)), vec!["0:77".into(), "1:77".into()])
        );
        // another choice: nothing keeps the name that it had as a code of the first one
        take_family(&mut document, Ring14);
        assert!(names(&document).is_empty(), "{:?}", names(&document));
        take_family(&mut document, Ring12);
        assert_eq!(names(&document), ["0:5", "1:5"]);
    }

    #[test]
    fn names_go_when_another_family_explains_all_photos() {
        let mut document = document(&[&[DOUBTED]]);
        assert_eq!((document.rings.clone(), names(&document)), (Rings::Of(Some(Ring12)), vec!["0:6".into()]));
        // a name that was given by hand stays
        let mut by_hand = document.clone();
        by_hand.project_mut().observations[0].point = "corner".into();
        for (document, kept) in [(&mut document, None), (&mut by_hand, Some("0:corner"))] {
            take_detection(document, "1", found(&[TWENTY]), None);
            assert_eq!(document.rings, Rings::Of(Some(Ring20)));
            assert_eq!(names(document), kept.into_iter().chain(["1:8"]).collect::<Vec<_>>());
            let target = &document.detections["0"].targets[0];
            assert_eq!((target.code, target.quality.code_note), (None, Some(CodeNote::OtherFamily)));
            assert_eq!(candidates(target, &document.rings), [(Ring20, vec![70, 71])].into());
        }
        let asked = document.doubtful.iter().map(|d| (d.photo.as_str(), d.points.join(" "), d.reason));
        assert_eq!(asked.collect::<Vec<_>>(), [("0", "70 71".to_owned(), Doubt::CodeUnclear)]);
    }

    #[test]
    fn a_ring_alone_is_read_as_one_of_the_family_that_is_known() {
        let known = Rings::Of(Some(Ring14));
        assert_eq!(codes_of_one(Codes::Auto, &known), Codes::Ring14);
        for open in [Rings::Of(None), Rings::OfSeveral(vec![Ring12, Ring20]), Rings::Different] {
            assert_eq!(codes_of_one(Codes::Auto, &open), Codes::None);
            assert_eq!(codes_of_one(Codes::Metashape12, &open), Codes::Metashape12);
        }
        assert_eq!(codes_of_one(Codes::None, &known), Codes::None);
    }

    #[test]
    fn candidates_are_told_by_family_while_that_is_open() {
        let detection = found(&[EITHER, TWELVE, &[(Ring12, 3, 0.0), (Ring12, 4, 0.0), (Ring20, 9, 0.0)]]);
        let [either, read, doubtful] = &detection.targets[..] else { panic!("three targets") };
        assert_eq!(candidates(either, &Rings::Different), [(Ring12, vec![5]), (Ring20, vec![77])].into());
        assert!(candidates(read, &Rings::Different).is_empty());
        assert_eq!(candidates(doubtful, &Rings::Of(Some(Ring12))), [(Ring12, vec![3, 4])].into());
        assert!(candidates(doubtful, &Rings::Of(Some(Ring14))).is_empty());
    }
}
