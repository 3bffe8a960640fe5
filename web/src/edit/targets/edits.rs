//! What detections, targets measured on request, matchings and marks do to names and measurements.

use sightline::detection::{Polarity, Quality};
use sightline::matching::Doubtful;
use sightline::project::{Role, Sigma};

use super::*;

fn target(id: u32, u: f64) -> Target {
    Target {
        id,
        u,
        v: 50.0,
        sigma_u: 0.01,
        sigma_v: 0.02,
        covariance_uv: 0.0,
        major: 12.0,
        minor: 10.0,
        angle: 0.0,
        contrast: 100.0,
        polarity: Polarity::Bright,
        code: None,
        code_family: None,
        code_candidates: Vec::new(),
        inner: None,
        occluded: false,
        quality: Quality::default(),
    }
}

fn coded(id: u32, u: f64, code: u32) -> Target {
    Target { code: Some(code), code_family: Some(Family::Ring12), ..target(id, u) }
}

fn detection(targets: &[Target]) -> Detection {
    Detection { targets: targets.to_vec(), ..Detection::default() }
}

fn seen(photo: &str, point: &str, u: f64, target: Option<u32>) -> Observation {
    Observation { photo: photo.into(), point: point.into(), u, v: 50.0, sigma: Sigma::One(0.5), enabled: true, target }
}

/// Targets 1 and 2 of photo 1 are points a and b, and a place set by hand is c; photo 2 shows a and b.
fn document() -> Document {
    let mut document = Document::default();
    for photo in ["1", "2"] {
        let targets = [target(1, 100.0), target(2, 200.0)];
        document.detections_mut().insert(photo.into(), Arc::new(detection(&targets)));
        let named = [seen(photo, "a", 100.0, Some(1)), seen(photo, "b", 200.0, Some(2))];
        document.project_mut().observations.extend(named);
    }
    document.project_mut().observations.push(seen("1", "c", 300.0, None));
    tidy(document.project_mut());
    document
}

/// Point, place and target of what a photo shows, by point.
fn shown(project: &Project, photo: &str) -> Vec<(String, f64, Option<u32>)> {
    let here = project.observations.iter().filter(|o| o.photo == photo);
    let mut shown = here.map(|o| (o.point.clone(), o.u, o.target)).collect::<Vec<_>>();
    shown.sort_by(|a, b| a.0.cmp(&b.0));
    shown
}

fn points(project: &Project) -> Vec<&str> {
    project.points.iter().map(|p| p.id.as_str()).collect()
}

#[test]
fn names_follow_their_targets_to_a_new_detection() {
    let mut d = document();
    let before = shown(&d.project, "2");
    d.project_mut().observations[1].enabled = false;
    take_detection(&mut d, "1", detection(&[target(1, 201.0), target(2, 99.5), target(3, 400.0)]), None);
    let [a, b, c] = [("a", 99.5, Some(2)), ("b", 201.0, Some(1)), ("c", 300.0, None)];
    assert_eq!(shown(&d.project, "1"), [a, b, c].map(|(point, u, target)| (point.to_owned(), u, target)));
    let off = |o: &&Observation| !o.enabled;
    let off = d.project.observations.iter().filter(off).map(|o| (o.photo.as_str(), o.point.as_str()));
    assert_eq!(off.collect::<Vec<_>>(), [("1", "b")]);
    assert_eq!((shown(&d.project, "2"), d.detections["1"].targets.len()), (before, 3));
}

#[test]
fn a_target_that_is_gone_loses_its_name_and_a_place_set_by_hand_stays() {
    let mut d = document();
    // The one is beyond what a name follows.
    take_detection(&mut d, "1", detection(&[target(1, 100.0 + 1.01 * FOLLOW)]), None);
    assert_eq!(shown(&d.project, "1"), [("c".to_owned(), 300.0, None)]);
    assert_eq!(points(&d.project), ["a", "b", "c"]);
    take_detection(&mut d, "2", detection(&[]), None);
    assert_eq!(points(&d.project), ["c"]);
}

#[test]
fn a_code_names_its_target_whatever_it_was_called() {
    let mut d = document();
    take_detection(&mut d, "1", detection(&[coded(1, 100.0, 11), target(2, 200.0)]), Some(Family::Ring12));
    let [eleven, b, c] = [("11", 100.0, Some(1)), ("b", 200.0, Some(2)), ("c", 300.0, None)];
    assert_eq!(shown(&d.project, "1"), [eleven, b, c].map(|(point, u, target)| (point.to_owned(), u, target)));
    assert_eq!(points(&d.project), ["a", "b", "c", "11"]);
    // Twice the same code: neither has it, and both are in doubt.
    take_detection(&mut d, "1", detection(&[coded(1, 100.0, 11), coded(2, 200.0, 11)]), Some(Family::Ring12));
    let doubts = d.doubtful.iter().map(|doubt| (doubt.photo.as_str(), doubt.target, doubt.reason));
    assert_eq!(doubts.collect::<Vec<_>>(), [1, 2].map(|id| ("1", Some(id), Doubt::DuplicateCode)));
    // The doubts of a photo go with its next detection.
    take_detection(&mut d, "1", detection(&[coded(1, 100.0, 11)]), Some(Family::Ring12));
    assert!(d.doubtful.is_empty());
}

#[test]
fn a_target_measured_on_request_is_added_once() {
    let mut d = document();
    assert_eq!(add(&mut d, "1", target(0, 200.0 + 0.9 * SAME)), 1);
    assert_eq!(d.detections["1"].targets.len(), 2);
    // What is beyond that is another one, with a number that no target of the photo has.
    assert_eq!(add(&mut d, "1", target(1, 200.0 + 1.1 * SAME)), 2);
    assert_eq!(d.detections["1"].targets.iter().map(|t| t.id).collect::<Vec<_>>(), [1, 2, 3]);
    assert_eq!(add(&mut d, "3", target(0, 10.0)), 0);
    assert_eq!((d.detections["3"].targets[0].id, d.detections["2"].targets.len()), (1, 2));
}

#[test]
fn matching_names_only_what_has_no_name() {
    let mut d = document();
    let new = [
        seen("1", "d", 400.0, Some(3)),
        seen("2", "d", 410.0, Some(4)),
        // A target that is point a, and a point that photo 2 shows elsewhere.
        seen("1", "e", 100.0, Some(1)),
        seen("2", "b", 210.0, Some(5)),
    ];
    let point = Point { id: "d".into(), xyz: Some([1.0, 2.0, 3.0]), ..Point::default() };
    let doubt =
        Doubtful { photo: "2".into(), u: 1.0, v: 2.0, target: None, points: Vec::new(), reason: Doubt::Ambiguous };
    let matching = Matching { points: vec![point], observations: new.to_vec(), doubtful: vec![doubt.clone()] };
    take_matching(&mut d, matching);
    let names = |photo| shown(&d.project, photo).into_iter().map(|(point, u, _)| (point, u)).collect::<Vec<_>>();
    assert_eq!(names("1"), [("a", 100.0), ("b", 200.0), ("c", 300.0), ("d", 400.0)].map(|(p, u)| (p.to_owned(), u)));
    assert_eq!(names("2"), [("a", 100.0), ("b", 200.0), ("d", 410.0)].map(|(p, u)| (p.to_owned(), u)));
    // Where it is comes from the adjustment.
    assert!(points(&d.project) == ["a", "b", "c", "d"] && d.project.points.iter().all(|p| p.xyz.is_none()));
    assert_eq!(*d.doubtful, [doubt]);
}

#[test]
fn marks_replace_what_is_at_their_targets_and_their_points_in_the_photo() {
    let mut d = document();
    d.project_mut().points[2].role = Role::Check;
    let snapped = Snapped {
        observations: vec![
            seen("1", "p", 100.0, Some(1)),
            seen("1", "c", 200.0, Some(2)),
            seen("1", "c", 201.0, Some(3)),
        ],
        unsnapped: Vec::new(),
    };
    // Of two marks of a point in a photo the last one counts.
    assert_eq!(take_marks(d.project_mut(), &snapped), 2);
    let [b, c, p] = [("b", 200.0, Some(2)), ("c", 201.0, Some(3)), ("p", 100.0, Some(1))];
    assert_eq!(shown(&d.project, "1"), [b, c, p].map(|(point, u, target)| (point.to_owned(), u, target)));
    assert_eq!(shown(&d.project, "2").len(), 2);
    assert_eq!(points(&d.project), ["a", "b", "c", "p"]);
    assert_eq!(d.project.points[2].role, Role::Check);
}
