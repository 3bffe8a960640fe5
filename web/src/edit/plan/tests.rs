//! Tests of plans as they are edited.

use super::*;

fn planned() -> Plan {
    let mut project = Project::default();
    begin(&mut project, first_form("plane", 1.0), 1.0);
    *project.plan.expect("a plan")
}

#[test]
fn a_plan_begins_with_targets_and_a_camera() {
    let plan = planned();
    assert_eq!((plan.points.len(), plan.cameras.len()), (30, 1));
    for kind in ["plane", "box", "cylinder"] {
        assert!(is_form(&first_form(kind, 1000.0)));
    }
    assert!(!is_form(&Form::Box { size: [1.0; 3], columns: 100, rows: 0, diameter: 1.0 }));
    assert_eq!([2.0, 2.5, -1.0, f64::MAX].map(counted), [2, 0, 0, u32::MAX]);
}

#[test]
fn a_plan_is_put_changed_and_removed() {
    let mut fresh = Document::default();
    put(&mut fresh, planned(), Some("m"));
    let unit_mm = |d: &Document| (d.project.unit.clone(), d.project.plan.as_ref().map(|plan| plan.lens.unit_mm));
    assert_eq!(unit_mm(&fresh), ("m".into(), Some(1000.0)));
    // one with something in it keeps its unit
    put(&mut fresh, planned(), Some("mm"));
    assert_eq!(unit_mm(&fresh), ("m".into(), Some(1000.0)));
    let mut measured = Document::default();
    (measured.project_mut().unit, measured.project_mut().name) = ("cm".into(), "p".into());
    put(&mut measured, planned(), None);
    assert_eq!(unit_mm(&measured), ("cm".into(), Some(10.0)));
    let project = measured.project_mut();
    assert!(change(project, |plan| plan.margin = 7.0));
    assert_eq!(project.plan.as_ref().map(|plan| plan.margin), Some(7.0));
    assert!(remove(project) && project.plan.is_none() && !remove(project));
    assert!(!change(project, |_| unreachable!("there is no plan")) && project.plan.is_none());
    assert_eq!((project.unit.as_str(), project.name.as_str()), ("cm", "p"));
}

#[test]
fn targets_to_begin_with_can_be_measured_by_the_camera() {
    for (kind, least, most) in [("plane", 12.0, 12.0), ("box", 10.0, 10.0), ("cylinder", 12.0, 15.0)] {
        let diameter =
            |project: &Project| project.plan.as_ref().expect("a plan").points[0].diameter.expect("a diameter");
        let mut project = Project::default();
        begin(&mut project, first_form(kind, 1.0), 1.0);
        assert!((least..=most).contains(&diameter(&project)), "{kind} {}", diameter(&project));
        // A small camera of two megapixels.
        let camera = Camera { pixel_pitch: Some([0.0045; 2]), ..Camera::new("s", 1632, 1224, Interior::brown(8.0)) };
        let mut project = Project { cameras: vec![camera], ..Project::default() };
        begin(&mut project, first_form(kind, 1000.0), 1000.0);
        assert!(diameter(&project) >= 0.0149 && diameter(&project) < 0.05, "{kind} {}", diameter(&project));
    }
    assert_eq!([0.9, 1.0, 11.0, 18.3, 250.0].map(round_up), [1.0, 1.0, 12.0, 20.0, 250.0]);
}

#[test]
fn stations_get_names_of_their_own_and_keep_their_aim() {
    let mut plan = planned();
    let names: Vec<_> = (0..3).filter_map(|_| add_station(&mut plan)).collect();
    assert_eq!(names, ["1", "2", "3"]);
    let aim = plan.stations[1].look_at;
    move_station(&mut plan, "2", 0, 5.0);
    move_station(&mut plan, "2", 1, 7.0);
    assert_eq!((plan.stations[1].position[..2].to_vec(), plan.stations[1].look_at), (vec![5.0, 7.0], aim));
    aim_station(&mut plan, "2", 2, 9.0);
    assert_eq!(plan.stations[1].look_at.map(|aim| aim[2]), Some(9.0));
    plan.stations.remove(0);
    assert_eq!(add_station(&mut plan).as_deref(), Some("4"));
}

#[test]
fn variants_change_places() {
    let mut plan = planned();
    add_station(&mut plan);
    assert_eq!(keep_variant(&mut plan), "B");
    add_station(&mut plan);
    assert_eq!(keep_variant(&mut plan), "C");
    switch_variant(&mut plan, 0);
    assert_eq!((plan.stations.len(), plan.variants[0].stations.len()), (1, 2));
}

#[test]
fn another_form_takes_what_names_its_points_along() {
    let mut plan = planned();
    set_bar(&mut plan, Some(0.02));
    assert_eq!(plan.distances.len(), 1);
    set_form(&mut plan, Form::Plane { width: 1.0, height: 1.0, columns: 2, rows: 2, upright: true, diameter: 0.1 });
    assert!(plan.distances.is_empty());
    set_bar(&mut plan, None);
    assert!(plan.distances.is_empty());
}

#[test]
fn given_points_keep_what_is_known_of_them() {
    let mut project = Project::default();
    let point = |id: &str, x: f64| Point { id: id.into(), xyz: Some([x, 1.0, 2.0]), ..Point::default() };
    take_points(&mut project, vec![point("a", 0.0), point("b", 1.0), point("c", 3.0)], 1000.0);
    let plan = project.plan.as_mut().expect("a plan");
    assert_eq!((facing(plan), plan.wanted.precision), (Some(Facing::Every), 0.0001));
    set_diameter(plan, Some(0.01));
    set_facing(plan, Facing::Up);
    set_control(plan, &["b".into()]).expect("known points");
    set_control_sigma(plan, Some(0.001));
    assert!(set_control(plan, &["x".into()]).is_err());
    set_bar(plan, Some(0.02));
    take_points(&mut project, vec![point("b", 5.0), point("d", 6.0)], 1000.0);
    let plan = project.plan.as_mut().expect("a plan");
    assert_eq!(plan.points[0].xyz, Some([5.0, 1.0, 2.0]));
    assert_eq!((control(plan), control_sigma(plan)), (vec!["b"], Some(0.001)));
    assert_eq!((plan.points[1].diameter, plan.points[1].normal), (Some(0.01), Some([0.0, 0.0, 1.0])));
    assert!(plan.distances.is_empty());
    for way in [Facing::Every, Facing::Front, Facing::Outward] {
        set_facing(plan, way);
        assert_eq!(facing(plan), Some(way));
    }
    plan.datum.kind = DatumKind::Control;
    set_control(plan, &[]).expect("none");
    assert_eq!(plan.datum.kind, DatumKind::Free);
    assert_eq!(points_text(plan, ShownAxes::XYZ), "b, 5, 1, 2\nd, 6, 1, 2\n");
}

#[test]
fn own_faces_stay_when_the_form_changes() {
    let mut plan = planned();
    assert_eq!((faces_of_form(&plan), plan.faces.len()), (1, 1));
    plan.faces.push(face(&[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0]).expect("a face"));
    set_form(&mut plan, first_form("cylinder", 1.0));
    assert_eq!(plan.faces.len(), faces_of_form(&plan) + 1);
    assert_eq!(plan.faces.last().map(|f| (f.along, f.across)), Some(([1.0, 0.0, 0.0], [0.0, 2.0, 0.0])));
    assert!(face(&[1.0; 9]).is_none() && face(&[1.0; 6]).is_none());
}

#[test]
fn another_camera_stays_calibrated() {
    let mut plan = planned();
    add_station(&mut plan);
    plan.stations[0].camera = "1".into();
    set_calibrates(&mut plan, true);
    set_camera(&mut plan, Camera::new("other", 4000, 3000, Interior::brown(20.0)));
    assert!(calibrates(&plan) && plan.stations[0].camera.is_empty() && is_known(&plan.cameras[0]));
}

#[test]
fn features_are_judged_by_the_points_that_are_planned() {
    let plan = planned();
    let kind = FeatureKind::Plane { points: vec!["1".into(), "2".into(), "gone".into()] };
    let project = Project { features: vec![Feature { id: "wall".into(), kind }], ..Project::default() };
    assert_eq!(features(&project, &plan), [("wall".to_owned(), vec!["1".to_owned(), "2".to_owned()])]);
}

#[test]
fn calibration_frees_each_parameter_once() {
    let mut plan = planned();
    set_calibrates(&mut plan, true);
    assert_eq!(plan.cameras[0].free, CALIBRATED);
    assert!(calibrates(&plan));
    set_calibrates(&mut plan, false);
    assert!(!calibrates(&plan));
}

#[test]
fn boxes_take_their_corners_in_any_order() {
    let made = region(&[1.0, 5.0, 0.0, -1.0, 2.0, 3.0]).expect("a box");
    assert_eq!((made.low, made.high), ([-1.0, 2.0, 0.0], [1.0, 5.0, 3.0]));
    assert!(region(&[1.0]).is_none());
}
