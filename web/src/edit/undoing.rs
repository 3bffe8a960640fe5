//! Tests that undo restores the document byte for byte after every kind of action.

use std::collections::BTreeMap;
use std::sync::Arc;

use sightline::calibration::convert_camera;
use sightline::detection::{Detection, Polarity, Target};
use sightline::equipment::{Calibration, ScaleBar, Use};
use sightline::exif::PhotoInfo;
use sightline::matching::{Doubt, Doubtful, Mark, Matching, snap};
use sightline::project::{
    Camera, DatumKind, Distance, Interior, Observation, Parameter, Photo, Point, Project, Role, Sigma,
};
use sightline_protocol::to_text;

use super::cells::{CellEdit, Editor};
use super::sheet::Col;
use super::{cameras, control, equipment, many, models, points, questions, targets};
use crate::document::Table;
use crate::document::history::History;
use crate::document::keys::observation_key;
use crate::document::{Change, Document};

pub type Action = fn(&mut Document);

pub fn target(id: u32, u: f64, v: f64) -> Target {
    Target {
        id,
        u,
        v,
        sigma_u: 0.02,
        sigma_v: 0.03,
        covariance_uv: 0.0,
        major: 12.0,
        minor: 10.0,
        angle: 0.1,
        contrast: 90.0,
        polarity: Polarity::Bright,
        code: None,
        code_family: None,
        code_candidates: Vec::new(),
        inner: None,
        occluded: false,
        quality: Default::default(),
    }
}

fn seen(photo: &str, point: &str, number: u32) -> Observation {
    Observation {
        photo: photo.into(),
        point: point.into(),
        u: f64::from(number) * 10.0,
        v: 5.0,
        sigma: Sigma::Two([0.02, 0.03]),
        enabled: number != 3,
        target: Some(number),
    }
}

/// Three cameras, four photos, points a to e, a distance, control, targets and doubts.
pub fn document() -> Document {
    let mut project = Project {
        name: "p".into(),
        cameras: ["k", "l", "m"].map(|id| Camera::new(id, 100, 80, Interior::brown(50.0))).into(),
        photos: ["1", "2", "3", "4"]
            .map(|id| Photo { id: id.into(), camera: "k".into(), enabled: id != "4", ..Photo::default() })
            .into(),
        points: vec![Point { id: "c".into(), role: Role::Control, xyz: Some([1.0, 2.0, 3.0]), ..Point::default() }]
            .into(),
        observations: vec![
            seen("1", "a", 1),
            seen("1", "b", 2),
            seen("2", "a", 1),
            seen("2", "b", 3),
            seen("3", "d", 1),
            seen("3", "c", 2),
        ]
        .into(),
        distances: vec![Distance { from: "a".into(), to: "b".into(), length: 5.0, sigma: 0.1, check: false }],
        ..Project::default()
    };
    project.photos[0].position = Some([1.0; 3]);
    project.photos[0].sigma_position = Some([Some(0.1); 3]);
    points::tidy(&mut project);
    let found = |n: u32| Detection {
        targets: (1..=n).map(|k| target(k, f64::from(k) * 10.0, 5.0)).collect(),
        ..Detection::default()
    };
    let detections = [("1", 4), ("2", 4), ("3", 3)].map(|(photo, n)| (photo.to_owned(), Arc::new(found(n))));
    let doubtful = |photo: &str, number: u32, point: &str| Doubtful {
        photo: photo.into(),
        u: f64::from(number) * 10.0,
        v: 5.0,
        target: Some(number),
        points: vec![point.into()],
        reason: Doubt::Ambiguous,
    };
    Document {
        project: Arc::new(project),
        detections: Arc::new(detections.into_iter().collect()),
        doubtful: Arc::new(vec![doubtful("1", 4, "d"), doubtful("2", 4, "d")]),
        ..Document::default()
    }
}

pub fn bytes(d: &Document) -> [String; 5] {
    [
        to_text(&*d.project),
        to_text(&*d.detections),
        to_text(&*d.doubtful),
        to_text(&d.sigmas_of_held.iter().collect::<Vec<_>>()),
        to_text(&d.options),
    ]
}

fn keys(all: &[&str]) -> many::RowKeys {
    all.iter().map(|key| (*key).to_owned()).collect()
}

fn set(d: &mut Document, table: Table, cells: &[(&str, Col, &str)]) {
    let mut editor = Editor::new(d, table);
    for (key, col, typed) in cells {
        // Where an action before it has taken the row away, it is refused.
        let _ = editor.set(&CellEdit { key: (*key).to_owned(), col: *col, typed: (*typed).to_owned() });
    }
}

fn rename(d: &mut Document, names: BTreeMap<String, String>) {
    let _ = many::rename_all(d.project_mut(), &names);
}

/// The kinds of action.
pub const ACTIONS: [(&str, Action); 53] = [
    ("photos added", |d| {
        cameras::add_photo(d.project_mut(), "new.jpg", &PhotoInfo::default(), [100, 80], None, &|_| false);
    }),
    ("photo removed", |d| cameras::remove_photos(d, &keys(&["2"]))),
    ("photo switched", |d| cameras::switch_photos(d.project_mut(), &keys(&["1"]), false)),
    ("camera renamed", |d| cameras::rename(d.project_mut(), "k", "z")),
    ("pitch", |d| cameras::set_pitch(d.project_mut(), "l", Some([0.005, 0.005]), &PhotoInfo::default())),
    ("principal distance", |d| cameras::set_principal_distance(d.project_mut(), "l", Some(51.0))),
    ("initial value", |d| cameras::set_initial(d.project_mut(), "l", Parameter::K1, 1e-5)),
    ("photos assigned", |d| {
        // Cameras that are offered are there: one goes with its last photo.
        if d.project.cameras.iter().any(|c| c.id == "l") {
            cameras::assign(d.project_mut(), &keys(&["1", "2"]), "l");
        }
    }),
    ("photos with a camera of their own", |d| {
        cameras::assign_own(d.project_mut(), &keys(&["3"]));
    }),
    ("parameter free", |d| cameras::set_free(d, "l", Parameter::K1, true)),
    ("parameter held again", |d| {
        cameras::observe_parameter(d, "l", Parameter::C, Some(0.3));
        cameras::set_free(d, "l", Parameter::C, false);
    }),
    ("parameter observed", |d| cameras::observe_parameter(d, "l", Parameter::X0, Some(0.1))),
    ("centre observed", |d| cameras::observe_position(d.project_mut(), "2", [1.0; 3], [Some(0.5); 3])),
    ("centre forgotten", |d| cameras::forget_position(d.project_mut(), "1")),
    ("targets detected", |d| {
        targets::take_detection(d, "4", Detection { targets: vec![target(1, 3.0, 3.0)], ..Detection::default() }, None);
    }),
    ("targets detected again", |d| {
        targets::take_detection(
            d,
            "1",
            Detection { targets: vec![target(1, 10.1, 5.0)], ..Detection::default() },
            None,
        );
    }),
    ("target measured", |d| {
        targets::add(d, "2", target(0, 77.0, 44.0));
    }),
    ("named", |d| {
        points::observe(d.project_mut(), seen("3", "e", 3));
    }),
    ("point renamed", |d| {
        let _ = points::rename(d.project_mut(), "a", "x");
    }),
    ("point renamed in a photo", |d| {
        points::rename_here(d.project_mut(), "1", "a", "y");
    }),
    ("moved", |d| {
        points::nudge(d.project_mut(), "1", "b", [0.5, 0.0]);
    }),
    ("observation removed", |d| points::remove_observation(d.project_mut(), "3", "d")),
    ("observation switched", |d| points::switch_observation(d.project_mut(), "1", "b", false)),
    ("point removed", |d| points::remove(d.project_mut(), "b")),
    ("marks taken", |d| {
        let mark = Mark { photo: "3".into(), point: "q".into(), u: 30.5, v: 5.0, sigma: 0.1 };
        let snapped = snap(&[mark], &targets::by_photo(d), 5.0);
        targets::take_marks(d.project_mut(), &snapped);
    }),
    ("matched", |d| {
        let matching = Matching { observations: vec![seen("3", "a", 3)], ..Matching::default() };
        targets::take_matching(d, matching);
    }),
    ("control taken", |d| {
        let point = Point { id: "a".into(), xyz: Some([4.0; 3]), ..Point::default() };
        control::take_points(d.project_mut(), vec![point], "mm").expect("known units");
    }),
    ("role", |d| control::set_role(d.project_mut(), "a", Role::Check)),
    ("coordinate", |d| control::set_coordinate(d.project_mut(), "c", 1, 9.0)),
    ("sigma of a coordinate", |d| control::set_sigma(d.project_mut(), "c", 1, Some(0.01))),
    ("distance added", |d| {
        let distance = Distance { from: "a".into(), to: "d".into(), length: 3.0, sigma: 0.1, check: false };
        let _ = control::add_distance(d.project_mut(), distance);
    }),
    ("distance edited", |d| set(d, Table::Distances, &[("0", Col::Length, "5.5")])),
    ("distance removed", |d| {
        many::delete(d, Table::Distances, &keys(&["0"]));
    }),
    ("datum", |d| d.project_mut().datum.kind = DatumKind::Minimal),
    ("unit", |d| d.project_mut().unit = "m".into()),
    ("options", |d| d.options.snooping = true),
    ("cell of an observation", |d| set(d, Table::Observations, &[("1\u{1f}a", Col::U, "12.5")])),
    ("cell of a photo", |d| set(d, Table::Photos, &[("2", Col::Camera, "m")])),
    ("cells pasted", |d| set(d, Table::Points, &[("a", Col::Role, "check"), ("b", Col::Diameter, "8")])),
    ("name of a target", |d| set(d, Table::Identities, &[("2\u{1f}4", Col::Point, "w")])),
    ("rows excluded", |d| {
        many::switch(d.project_mut(), Table::Points, &keys(&["a"]), false);
    }),
    ("rows restored", |d| {
        many::switch(d.project_mut(), Table::Observations, &[observation_key("2", "b")].into(), true);
    }),
    ("rows deleted", |d| {
        many::delete(d, Table::Observations, &[observation_key("1", "a")].into());
    }),
    ("roles", |d| {
        many::set_roles(d.project_mut(), &keys(&["a", "b"]), Role::Check);
    }),
    ("points merged", |d| {
        let _ = many::merge(d.project_mut(), &keys(&["a", "d"]));
    }),
    ("point split", |d| {
        many::split(d.project_mut(), "a", &keys(&["2"]));
    }),
    ("points renamed by a pattern", |d| {
        let ids = ["a", "b"].map(str::to_owned);
        rename(d, many::by_pattern(&ids, "P##", 1));
    }),
    ("cameras joined", |d| {
        many::join_cameras(d.project_mut(), &keys(&["l", "m"]));
    }),
    ("calibration taken", |d| {
        let calibration = Calibration {
            date: "2026-05-01".into(),
            pixel_pitch: Some([0.004; 2]),
            interior: Interior::brown(35.0),
            sigma: [(Parameter::C, 0.01), (Parameter::K1, 1e-6)].into(),
            remark: String::new(),
            origin: None,
        };
        equipment::use_calibration(d, "l", &calibration, Use::Observed);
    }),
    ("camera model", |d| {
        let camera = d.project.cameras.iter().find(|c| c.id == "l").cloned();
        let alone = camera.map(|camera| models::alone(&d.project, camera));
        if let Some((converted, _)) = alone.and_then(|p| convert_camera(&p, "l", "opencv_rational").ok()) {
            models::take(d, &converted, None);
        }
    }),
    ("scale bars taken", |d| {
        let bar = |from: &str, to: &str| ScaleBar {
            id: format!("{from}-{to}"),
            from: from.into(),
            to: to.into(),
            length: 1.0,
            sigma: 1e-5,
            unit: "m".into(),
            certificate: String::new(),
            date: String::new(),
        };
        if d.project.photos.iter().any(|photo| photo.id == "2") {
            points::observe(d.project_mut(), seen("2", "d", 2));
        }
        equipment::take_bars(d, &[bar("a", "d")]);
    }),
    ("question answered yes", |d| {
        if let Some(question) = questions::open(d).first().cloned() {
            questions::yes(d, &question, "d");
        }
    }),
    ("question answered no", |d| {
        if let Some(question) = questions::open(d).first().cloned() {
            questions::no(d, &question);
        }
    }),
];

#[test]
fn every_kind_of_action_changes_the_document_and_undoing_it_restores_it() {
    for (name, action) in ACTIONS {
        let mut history = History::default();
        let (start, before) = (document(), bytes(&document()));
        let mut after = start.clone();
        history.push(Change::Opened, start);
        action(&mut after);
        let done = bytes(&after);
        assert_ne!(done, before, "{name} changes nothing");
        let back = history.undo(after).expect("a state");
        assert_eq!(bytes(&back), before, "{name}");
        assert_eq!(bytes(&history.redo(back).expect("a state")), done, "{name}");
    }
}

#[test]
fn any_row_of_actions_is_undone_step_by_step() {
    let mut seed = 7_u64;
    let mut next = move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize
    };
    for _ in 0..40 {
        let (mut history, mut present) = (History::default(), document());
        let mut states = vec![bytes(&present)];
        for _ in 0..30 {
            let (_, action) = ACTIONS[next() % ACTIONS.len()];
            history.push(Change::Opened, present.clone());
            action(&mut present);
            states.push(bytes(&present));
            assert_eq!(present.project.validate(), Ok(()));
        }
        for state in states.iter().rev().skip(1) {
            present = history.undo(present).expect("a state");
            assert_eq!(bytes(&present), *state);
        }
        for state in &states[1..] {
            present = history.redo(present).expect("a state");
            assert_eq!(bytes(&present), *state);
        }
    }
}
