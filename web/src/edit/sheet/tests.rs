//! Tests of sheets of targets as they are edited.

use sightline::project::{Observation, Point, Project, Sigma};

use super::*;

fn document() -> Document {
    let seen = |photo: &str, point: &str, u: f64, enabled: bool| Observation {
        photo: photo.into(),
        point: point.into(),
        u,
        v: 1.0,
        sigma: Sigma::One(0.1),
        enabled,
        target: None,
    };
    let point = |id: &str, role: Role| Point { id: id.into(), role, xyz: Some([1.0; 3]), ..Point::default() };
    let project = Project {
        points: vec![point("10", Role::Tie), point("9", Role::Control)].into(),
        observations: vec![seen("1", "10", 5.0, true), seen("1", "9", 7.0, false), seen("2", "10", 6.0, true)].into(),
        ..Project::default()
    };
    Document { project: std::sync::Arc::new(project), ..Document::default() }
}

#[test]
fn what_a_result_left_out_is_known_by_the_rows_of_its_table() {
    use sightline::adjustment::{LeftOutBy, LeftOutReason};
    use sightline::project::Distance;
    let item = |kind, photo: Option<&str>, point: Option<&str>, given| LeftOutItem {
        kind,
        photo: photo.map(str::to_owned),
        point: point.map(str::to_owned),
        given,
        by: LeftOutBy::Orientation,
        reason: LeftOutReason::Disagrees,
        size_px: None,
        size: None,
        size_sigma: None,
    };
    let mut d = document();
    let distance = |from: &str, to: &str| Distance { from: from.into(), to: to.into(), ..Distance::default() };
    d.project_mut().distances = vec![distance("10", "9"), distance("9", "10")];
    let given = Given::Distance { from: "9".into(), to: "10".into() };
    let x = Given::Control { point: "9".into(), axis: 0 };
    let all = [
        item(LeftOutKind::Observation, Some("2"), Some("10"), None),
        item(LeftOutKind::Photo, Some("2"), None, None),
        item(LeftOutKind::Control, None, Some("9"), None),
        item(LeftOutKind::Control, None, Some("10"), Some(x)),
        item(LeftOutKind::Distance, None, None, Some(given)),
    ];
    let of = |table| not_used(table, &d.project, &all).into_iter().collect::<Vec<_>>();
    assert_eq!(of(Table::Observations), [observation_key("2", "10")]);
    assert_eq!((of(Table::Photos), of(Table::Control)), (vec!["2".to_owned()], vec!["9".to_owned()]));
    assert_eq!((of(Table::Distances), of(Table::Points).len()), (vec!["1".to_owned()], 0));
    let mut sheet = Sheet::new(Table::Observations, &d);
    sheet.not_used = not_used(Table::Observations, &d.project, &all);
    assert_eq!(sheet.value(2, Col::TakesPart), Value::NotUsed);
    assert_eq!((sheet.value(0, Col::TakesPart), sheet.takes_part(2)), (Value::Flag(true), false));
}

#[test]
fn columns_of_words_are_known_and_searched_whatever_the_case() {
    use sightline::project::{Camera, Distance, Interior, Photo};
    let mut d = document();
    let project = std::sync::Arc::make_mut(&mut d.project);
    project.cameras = vec![Camera::new("A", 10, 10, Interior::brown(5.0))];
    project.photos = vec![Photo { id: "P1".into(), file: "Größe.JPG".into(), ..Photo::default() }].into();
    project.distances = vec![Distance { from: "10".into(), to: "9".into(), ..Distance::default() }];
    let all = [Table::Photos, Table::Cameras, Table::Points, Table::Control, Table::Observations, Table::Distances];
    for table in all {
        let sheet = Sheet::new(table, &d);
        for (row, col) in (0..sheet.len()).flat_map(|row| table.columns().iter().map(move |col| (row, *col))) {
            let is_word = matches!(sheet.value(row, col), Value::Words(_));
            assert!(is_word == col.has_words(), "{table:?} {col:?}");
        }
    }
    let photos = Sheet::new(Table::Photos, &d);
    let found = |text: &str| !photos.filtered(text, |_| true).is_empty();
    assert!(found("jpg") && found("GRÖ") && found("p1") && !found("jpeg") && !found("größer datei"));
}

#[test]
fn tables_show_sort_and_filter_their_rows() {
    let d = document();
    let sheet = Sheet::new(Table::Observations, &d);
    let mut rows = sheet.filtered("", |_| true);
    sheet.sort(&mut rows, Col::Point, false);
    assert_eq!(rows, [1, 0, 2]);
    sheet.sort(&mut rows, Col::U, true);
    assert_eq!(rows, [1, 2, 0]);
    sheet.sort(&mut rows, Col::W, true);
    assert_eq!(rows, [1, 2, 0]);
    assert_eq!(sheet.filtered("10", |row| sheet.takes_part(row)), [0, 2]);
    assert_eq!(sheet.filtered(" 10 ", |_| true), [0, 2]);
    assert_eq!(sheet.value(2, Col::U), Value::Number(6.0, 3));
    assert_eq!((sheet.key(2), sheet.value(1, Col::TakesPart).plain()), (observation_key("2", "10"), "0".into()));
}

#[test]
fn points_know_their_rays_and_control_is_a_part_of_them() {
    let d = document();
    let points = Sheet::new(Table::Points, &d);
    assert_eq!((points.len(), points.rays(0), points.takes_part(1)), (2, 2, false));
    let control = Sheet::new(Table::Control, &d);
    assert_eq!((control.len(), control.key(0)), (1, "9".into()));
    assert_eq!(control.value(0, Col::Role).plain(), "control");
}

#[test]
fn every_column_that_names_rows_or_can_be_changed_is_in_its_table() {
    for table in Table::ALL {
        assert!(table.names().iter().all(|col| table.columns().contains(col)));
        assert!(table.columns().iter().any(|col| table.editable(*col)));
    }
}
