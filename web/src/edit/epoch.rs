//! The next epoch of a project: the data it keeps from the current one.

use std::collections::BTreeMap;

use sightline::adjust::apply;
use sightline::project::{EpochOf, Project, Role};

use crate::document::Document;

/// A project for the next epoch: names, control, scale bars, roles, cameras with the calibration that was found, how it is adjusted and reported;
/// no photos, and nothing that was measured in them. `key` is that of the project as it is kept.
pub fn next(document: &Document, key: Option<String>) -> Document {
    let of = &document.project;
    let calibrated = document.current().map(|r| apply(&r.oriented, &r.adjustment));
    let mut project = Project {
        cameras: calibrated.map_or_else(|| of.cameras.clone(), |p| p.cameras),
        photos: Default::default(),
        observations: Default::default(),
        set_aside: Vec::new(),
        rig: None,
        ..(**of).clone()
    };
    project.report.date.clear();
    let stays = |id: &str| {
        let named = project.datum.points.iter().flatten().any(|name| name == id);
        named || project.distances.iter().any(|d| d.from == id || d.to == id)
    };
    let mut points = project.points.clone();
    points.retain(|point| point.role != Role::Tie || stays(&point.id));
    for point in points.iter_mut().filter(|point| point.role == Role::Tie) {
        // Where they are is what is measured anew.
        point.xyz = None;
    }
    project.points = points;
    let first = of.epoch.clone().unwrap_or_else(|| EpochOf {
        name: of.name.clone(),
        key: key.unwrap_or_default(),
        ..EpochOf::default()
    });
    let number = of.epoch.as_ref().map_or(0, |epoch| epoch.number) + 1;
    project.name = format!("{} · {number}", first.name);
    let mut names = first.names.clone();
    names.extend(given_names(document));
    project.epoch = Some(EpochOf { number, names, ..first });
    Document { project: project.into(), options: document.options.clone(), ..Document::default() }
}

/// Names of coded points that differ from their codes, by the code.
fn given_names(document: &Document) -> BTreeMap<String, String> {
    let mut names = BTreeMap::new();
    for observation in &document.project.observations {
        let target = || document.detections.get(&observation.photo)?.target(observation.target?);
        if let Some(code) = target().and_then(|target| target.code) {
            let code = code.to_string();
            if code != observation.point {
                names.insert(code, observation.point.clone());
            }
        }
    }
    names
}

/// The date in a text: the first `2026-03-14`, with `-`, `_` or `.` between its numbers, as ISO 8601 has it.
pub fn date_in(text: &str) -> Option<String> {
    let bytes = text.as_bytes();
    let digits = |range: std::ops::Range<usize>| bytes.get(range).is_some_and(|b| b.iter().all(u8::is_ascii_digit));
    let mark = |k: usize| bytes.get(k).is_some_and(|b| b"-_.".contains(b));
    (0..bytes.len()).find_map(|k| {
        let begins = k == 0 || !bytes[k - 1].is_ascii_digit();
        let ends = !bytes.get(k + 10).is_some_and(u8::is_ascii_digit);
        let whole = digits(k..k + 4) && mark(k + 4) && digits(k + 5..k + 7) && mark(k + 7) && digits(k + 8..k + 10);
        let date = (begins && ends && whole)
            .then(|| format!("{}-{}-{}", &text[k..k + 4], &text[k + 5..k + 7], &text[k + 8..k + 10]));
        date.filter(|date| sightline::monitoring::days(date).is_some())
    })
}

/// Names in a typed list: separated by commas, semicolons or ends of lines, each once.
pub fn names_in(typed: &str) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for name in typed.split([',', ';', '\n', '\t']).map(str::trim).filter(|name| !name.is_empty()) {
        if !names.iter().any(|known| known == name) {
            names.push(name.to_owned());
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use sightline::detection::{Detection, Target};
    use sightline::project::{Camera, Distance, Interior, Observation, Photo, Point, Sigma};

    use super::super::undoing::target;
    use super::*;

    #[test]
    fn the_next_epoch_has_names_roles_and_scale_and_nothing_measured() {
        let point = |id: &str, role| Point { id: id.into(), role, xyz: Some([1.0; 3]), ..Point::default() };
        let seen = |point: &str, target| Observation {
            photo: "1".into(),
            point: point.into(),
            u: 1.0,
            v: 2.0,
            sigma: Sigma::One(0.1),
            enabled: true,
            target: Some(target),
        };
        let project = Project {
            name: "Wall".into(),
            cameras: vec![Camera::new("c", 100, 100, Interior::brown(10.0))],
            photos: vec![Photo { id: "1".into(), camera: "c".into(), enabled: true, ..Photo::default() }].into(),
            points: vec![
                point("R1", Role::Control),
                point("5", Role::Tie),
                point("6", Role::Tie),
                point("7", Role::Check),
            ]
            .into(),
            observations: vec![seen("R1", 11), seen("5", 5)].into(),
            distances: vec![Distance { from: "5".into(), to: "R1".into(), length: 3.0, sigma: 0.1, check: false }],
            ..Project::default()
        };
        let coded = |code| Target { code: Some(code), ..target(code, 10.0, 5.0) };
        let detection = Detection { targets: vec![coded(5), coded(11)], ..Detection::default() };
        let mut document = Document { project: project.into(), ..Document::default() };
        document.detections_mut().insert("1".into(), Arc::new(detection));
        let next = next(&document, Some("key".into()));
        let p = &next.project;
        assert!(
            p.photos.is_empty() && p.observations.is_empty() && next.detections.is_empty() && next.result.is_none()
        );
        let kept: Vec<_> = p.points.iter().map(|p| (p.id.as_str(), p.role, p.xyz.is_some())).collect();
        assert_eq!(kept, [("R1", Role::Control, true), ("5", Role::Tie, false), ("7", Role::Check, true)]);
        assert_eq!((p.cameras.len(), p.distances.len(), p.name.as_str()), (1, 1, "Wall · 1"));
        let epoch = p.epoch.as_ref().expect("an epoch");
        assert_eq!((epoch.name.as_str(), epoch.key.as_str(), epoch.number), ("Wall", "key", 1));
        assert_eq!(epoch.names.iter().collect::<Vec<_>>(), [(&"11".to_owned(), &"R1".to_owned())]);
        let third = super::next(&next, Some("other".into()));
        let epoch = third.project.epoch.as_ref().expect("an epoch");
        assert_eq!((epoch.key.as_str(), epoch.number, epoch.names.len()), ("key", 2, 1));
        assert_eq!(third.project.name, "Wall · 2");
    }

    #[test]
    fn dates_are_found_in_names() {
        assert_eq!(date_in("wall_2026-03-14.csv").as_deref(), Some("2026-03-14"));
        assert_eq!(date_in("2026_09_02 north").as_deref(), Some("2026-09-02"));
        for none in ["wall", "2026-13-40", "12026-03-145", "20260314", "벽 1-2-3"] {
            assert_eq!(date_in(none), None, "{none}");
        }
        assert_eq!(names_in(" R1, R2;R3\nR1 ,, a b"), ["R1", "R2", "R3", "a b"]);
    }
}
