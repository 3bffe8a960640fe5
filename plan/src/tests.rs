#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::setup::Setup;
use super::*;
use sightline::project::{Camera, DatumKind, Form, Interior, Lens, Parameter, PlanFace, Region, Wanted};

fn camera() -> Camera {
    Camera { pixel_pitch: Some([0.006; 2]), ..Camera::new("c", 6000, 4000, Interior::brown(28.0)) }
}

fn wall() -> Plan {
    let form = Form::Plane { width: 2000.0, height: 1500.0, columns: 5, rows: 4, upright: true, diameter: 12.0 };
    let (points, faces) = targets_on(&form).expect("targets");
    let at = |id: &str, x: f64, z: f64| PlanStation {
        id: id.into(),
        position: [x, -2500.0, z],
        look_at: Some([0.0, 0.0, 750.0]),
        ..PlanStation::default()
    };
    Plan {
        cameras: vec![camera()],
        form: Some(form),
        points,
        faces,
        stations: vec![at("1", -1200.0, 700.0), at("2", 0.0, 1700.0), at("3", 1200.0, 700.0), at("4", 0.0, 100.0)],
        ..Plan::default()
    }
}

#[test]
fn forms_carry_their_targets() {
    let count = |form: Form| targets_on(&form).expect("targets").0.len();
    assert_eq!(count(Form::Box { size: [1.0; 3], columns: 3, rows: 2, diameter: 0.1 }), 30);
    let cylinder = Form::Cylinder {
        radius: 1000.0,
        height: 2000.0,
        sweep: std::f64::consts::PI,
        columns: 9,
        rows: 5,
        inside: false,
        diameter: 10.0,
    };
    let (points, faces) = targets_on(&cylinder).expect("targets");
    assert_eq!((points.len(), faces.len()), (45, 24));
    let middle = points[4].xyz.expect("a place");
    assert!((middle[1] + 1000.0).abs() < 1e-9 && middle[0].abs() < 1e-9);
    // Seen from the front, targets of the front half are not hidden by their own cylinder.
    let plan = Plan { cameras: vec![camera()], points, faces, max_incidence: 1.5, least_px: 0.0, ..Plan::default() };
    let setup = Setup::new(&plan).expect("a plan");
    let station =
        PlanStation { position: [0.0, -6000.0, 1000.0], look_at: Some([0.0, 0.0, 1000.0]), ..PlanStation::default() };
    let shot = setup.shot(&station).expect("a photo");
    assert_eq!(shot.unseen.hidden, 0);
    assert!(shot.seen.len() >= 35, "{:?}", shot.unseen);
}

#[test]
fn a_box_is_photographed_all_around_by_photos_that_hang_together() {
    let form = Form::Box { size: [1000.0, 800.0, 600.0], columns: 3, rows: 2, diameter: 10.0 };
    let (points, faces) = targets_on(&form).expect("targets");
    let mut plan = Plan { cameras: vec![camera()], form: Some(form), points, faces, ..Plan::default() };
    plan.cameras[0].interior = Interior::brown(28.0);
    let made = make(&plan, &MakeOptions::default(), &mut |_, _| true).expect("a plan");
    assert!(made.prediction.reached, "{} photos: {:?}", made.stations.len(), made.prediction.lacks);
    assert!(made.stations.len() <= 16, "{}", made.stations.len());
}

#[test]
fn a_tank_is_photographed_from_inside() {
    let form = Form::Cylinder {
        radius: 3000.0,
        height: 4000.0,
        sweep: std::f64::consts::TAU,
        columns: 16,
        rows: 4,
        inside: true,
        diameter: 30.0,
    };
    let (points, faces) = targets_on(&form).expect("targets");
    let mut plan = Plan { cameras: vec![camera()], form: Some(form), points, faces, ..Plan::default() };
    plan.cameras[0].interior = Interior::brown(16.0);
    plan.wanted = Wanted { precision: 1.5, probability: 0.95 };
    // A camera beside the tank does not see through its wall.
    let outside = |x: f64| PlanStation {
        id: "1".into(),
        position: [x, -3500.0, 2000.0],
        look_at: Some([0.0, 0.0, 2000.0]),
        ..PlanStation::default()
    };
    plan.stations = vec![outside(0.0)];
    let sight = predict(&plan).expect("a prediction").stations.swap_remove(0);
    assert!(sight.points.is_empty() && sight.unseen.hidden > 10, "{:?}", sight.unseen);
    plan.stations.clear();
    let made = make(&plan, &MakeOptions::default(), &mut |_, _| true).expect("a plan");
    assert!(made.prediction.reached, "{:?}", made.prediction.lacks);
    assert!(made.stations.iter().all(|s| s.position[0].hypot(s.position[1]) < 3000.0));
}

#[test]
fn what_is_not_seen_has_a_reason() {
    let unseen = |edit: &dyn Fn(&mut Plan)| {
        let mut plan = wall();
        plan.stations.truncate(1);
        edit(&mut plan);
        predict(&plan).expect("a prediction").stations[0].unseen
    };
    assert_eq!(unseen(&|_| ()), Unseen::default());
    assert_eq!(unseen(&|p| p.least_px = 200.0).too_small, 20);
    assert!(unseen(&|p| p.stations[0].position = [-6000.0, -800.0, 700.0]).turned_away > 10);
    assert!(unseen(&|p| p.stations[0].look_at = Some([9000.0, 0.0, 750.0])).outside > 10);
    let screen = PlanFace { corner: [-5000.0, -500.0, 0.0], along: [10_000.0, 0.0, 0.0], across: [0.0, 0.0, 700.0] };
    assert!(unseen(&|p| p.faces.push(screen)).hidden > 5);
    let lens = |focus| Lens { f_number: Some(2.0), focus: Some(focus), ..Lens::default() };
    assert_eq!(unseen(&|p| p.lens = lens(2000.0)).blurred, 20);
    // Ten times as far away, what is sharp reaches as much farther.
    assert_eq!(unseen(&|p| p.lens = Lens { unit_mm: 10.0, ..lens(2000.0) }).blurred, 0);
}

#[test]
fn a_plan_says_what_it_lacks() {
    let lacks = |edit: &dyn Fn(&mut Plan)| {
        let mut plan = wall();
        edit(&mut plan);
        let prediction = predict(&plan).expect("a prediction");
        assert_eq!(prediction.reached, prediction.lacks.is_empty());
        prediction.lacks
    };
    assert!(lacks(&|p| p.wanted = Wanted { precision: 1.0, probability: 0.95 }).is_empty());
    let beyond = lacks(&|p| p.wanted.precision = 1e-6);
    assert!(matches!(&beyond[..], [Lacking::Beyond { points }] if points.len() == 20), "{beyond:?}");
    assert_eq!(lacks(&|p| p.stations.clear()), [Lacking::NoPhotos]);
    assert_eq!(lacks(&|p| p.points.clear()), [Lacking::NoPoints]);
    let one = lacks(&|p| p.stations.truncate(1));
    assert!(one.iter().any(|l| matches!(l, Lacking::Undetermined { points } if points.len() == 20)), "{one:?}");
    // Photos from one place give no depth.
    let rolled = lacks(&|p| {
        p.stations.truncate(1);
        p.stations.push(PlanStation { id: "2".into(), roll: 1.57, ..p.stations[0].clone() });
    });
    assert!(rolled.iter().any(|l| matches!(l, Lacking::Undetermined { .. })), "{rolled:?}");
    // A flat object seen straight on from one distance leaves the principal distance open.
    let calibrated = lacks(&|p| {
        p.cameras[0].free = vec![Parameter::C];
        for (k, station) in p.stations.iter_mut().enumerate() {
            let x = 300.0 * k as f64;
            (station.position, station.look_at) = ([x, -3000.0, 750.0], Some([x, 0.0, 750.0]));
        }
    });
    assert!(calibrated.iter().any(|l| matches!(l, Lacking::Defect { .. } | Lacking::Beyond { .. })), "{calibrated:?}");
    let standing = lacks(&|p| {
        p.wanted.precision = 1.0;
        p.forbidden.push(Region { low: [500.0, -3000.0, 0.0], high: [2000.0, -2000.0, 2000.0] });
    });
    assert_eq!(standing, [Lacking::Forbidden { stations: vec!["3".into()] }]);
    let control = lacks(&|p| p.datum.kind = DatumKind::Control);
    assert!(control.iter().any(|l| matches!(l, Lacking::Defect { .. })), "{control:?}");
}

#[test]
fn what_is_no_plan_is_refused() {
    let field = |edit: &dyn Fn(&mut Plan)| {
        let mut plan = wall();
        edit(&mut plan);
        let error = predict(&plan).expect_err("no plan");
        let place = error.place();
        place.field.or(place.photo).or(place.camera).or(place.point).expect("a place")
    };
    assert_eq!(field(&|p| p.cameras.clear()), "cameras");
    assert_eq!(field(&|p| p.sigma = 0.0), "sigma");
    assert_eq!(field(&|p| p.max_incidence = 2.0), "max_incidence");
    assert_eq!(field(&|p| p.wanted.precision = f64::NAN), "wanted");
    assert_eq!(field(&|p| p.lens.f_number = Some(-1.0)), "lens");
    assert_eq!(field(&|p| p.cameras[0].interior = unknown()), "c");
    assert_eq!(field(&|p| p.points[3].xyz = None), "4");
    assert_eq!(field(&|p| p.stations[2].look_at = None), "look_at");
    assert_eq!(field(&|p| p.stations[2].camera = "x".into()), "3");
}

#[test]
fn a_plan_survives_the_document() {
    let mut plan = wall();
    plan.variants.push(sightline::project::Variant { name: "B".into(), stations: plan.stations.clone() });
    plan.stations[0].taken = true;
    let project = sightline::project::Project { plan: Some(Box::new(plan)), ..Default::default() };
    let text = serde_json::to_string(&project).expect("text");
    assert_eq!(serde_json::from_str::<sightline::project::Project>(&text).expect("a document"), project);
    let without = sightline::project::Project::default();
    assert!(!serde_json::to_string(&without).expect("text").contains("plan"));
}

#[test]
fn the_next_photo_lowers_the_criterion() {
    let plan = wall();
    let before = predict(&plan).expect("a prediction").largest.expect("determined");
    let best = suggest(&plan, &Criterion::Worst, &mut |_, _| true).expect("suggestions");
    let first = &best[0];
    assert!(first.value.expect("determined") < before && first.sees >= 4 && first.station.id == "5");
    let mut more = plan.clone();
    more.stations.push(first.station.clone());
    let after = predict(&more).expect("a prediction").largest.expect("determined");
    assert!((after - first.value.expect("determined")).abs() < 1e-9 * after);
    assert!(matches!(suggest(&plan, &Criterion::Worst, &mut |_, _| false), Err(sightline::Error::Cancelled)));
}

#[test]
fn a_made_plan_reaches_what_is_wanted_where_one_can_stand() {
    let mut plan = wall();
    plan.stations.truncate(1);
    plan.stations[0].taken = true;
    plan.wanted = Wanted { precision: 0.05, probability: 0.95 };
    plan.forbidden.push(Region { low: [-9e3, -9e3, -9e3], high: [9e3, 9e3, 0.0] });
    let made = make(&plan, &MakeOptions::default(), &mut |_, _| true).expect("a plan");
    assert!(made.prediction.reached, "{:?}", made.prediction.lacks);
    assert_eq!(made.stations[0], plan.stations[0]);
    assert!(made.stations[1..].iter().all(|s| s.position[2] >= 0.0));
    let mut ids: Vec<&String> = made.stations.iter().map(|s| &s.id).collect();
    ids.sort();
    ids.dedup();
    assert_eq!(ids.len(), made.stations.len());
    // Beyond all reach: the best of so many, and what it lacks.
    plan.wanted.precision = 1e-7;
    let made = make(&plan, &MakeOptions { most: 4 }, &mut |_, _| true).expect("a plan");
    assert!(!made.prediction.reached && made.stations.len() <= 5);
}

/// Photos that all stand upright leave the principal point to the points' places; turned ones tell them apart.
#[test]
fn a_plan_that_calibrates_has_rolled_photos() {
    let mut plan = wall();
    plan.stations.clear();
    plan.wanted = Wanted { precision: 0.1, probability: 0.95 };
    plan.cameras[0].free = vec![Parameter::C, Parameter::X0, Parameter::Y0];
    let made = make(&plan, &MakeOptions::default(), &mut |_, _| true).expect("a plan");
    assert!(made.prediction.reached, "{:?}", made.prediction.lacks);
    let rolled = made.stations.iter().filter(|s| s.roll.abs() > 1.0).count();
    assert!((1..made.stations.len()).contains(&rolled), "{rolled} of {}", made.stations.len());
    plan.cameras[0].free.clear();
    let made = make(&plan, &MakeOptions::default(), &mut |_, _| true).expect("a plan");
    assert!(made.stations.iter().all(|s| s.roll == 0.0));
}

/// Two megapixels behind eight millimetres.
fn small_camera() -> Camera {
    Camera { pixel_pitch: Some([0.0045; 2]), ..Camera::new("s", 1632, 1224, Interior::brown(8.0)) }
}

#[test]
fn targets_of_the_least_diameter_make_a_plan_of_a_small_camera() {
    let form = |diameter| Form::Box { size: [1000.0, 800.0, 600.0], columns: 3, rows: 2, diameter };
    let plan = |diameter| {
        let (points, faces) = targets_on(&form(diameter)).expect("targets");
        let wanted = Wanted { precision: 0.4, probability: 0.95 };
        Plan { cameras: vec![small_camera()], form: Some(form(diameter)), points, faces, wanted, ..Plan::default() }
    };
    let least = least_diameter(&plan(10.0)).expect("a camera and points");
    assert!(least > 15.0 && least < 22.0, "{least}");
    let made = make(&plan(least), &MakeOptions::default(), &mut |_, _| true).expect("a plan");
    assert!(made.prediction.reached, "{:?}", made.prediction.lacks);
    // Targets too small to tie faces together are not made better by forty photos.
    let made = make(&plan(10.0), &MakeOptions::default(), &mut |_, _| true).expect("a plan");
    assert!(!made.prediction.reached && made.stations.len() < 12, "{} photos", made.stations.len());
    assert!(least_diameter(&Plan { cameras: vec![Camera::new("u", 10, 10, unknown())], ..plan(1.0) }).is_none());
}

#[test]
fn where_targets_are_too_small_for_a_picture_of_all_its_parts_are_photographed() {
    let form = Form::Cylinder {
        radius: 1000.0,
        height: 2000.0,
        sweep: std::f64::consts::TAU,
        columns: 16,
        rows: 4,
        inside: false,
        diameter: 12.0,
    };
    let (points, faces) = targets_on(&form).expect("targets");
    let plan = Plan { cameras: vec![small_camera()], form: Some(form), points, faces, ..Plan::default() };
    let setup = Setup::new(&plan).expect("a plan");
    let pool = candidates::candidates(&setup, 240, candidates::LEAST_SEEN);
    assert!(pool.len() <= 240);
    let mut rays = vec![0; plan.points.len()];
    pool.iter().flat_map(|shot| &shot.seen).for_each(|(k, _)| rays[*k] += 1);
    assert!(rays.iter().all(|rays| *rays >= 4), "{rays:?}");
    // They overlap: from any of them one comes to all others by photos that share five points.
    let mut known: Vec<bool> = vec![false; plan.points.len()];
    pool[0].seen.iter().for_each(|(k, _)| known[*k] = true);
    for _ in 0..pool.len() {
        let next = pool.iter().find(|shot| {
            let shared = shot.seen.iter().filter(|(k, _)| known[*k]).count();
            shared >= 5 && shared < shot.seen.len()
        });
        let Some(next) = next else { break };
        next.seen.iter().for_each(|(k, _)| known[*k] = true);
    }
    assert!(known.iter().all(|known| *known), "{known:?}");
}

/// An interior orientation whose principal distance is not known.
fn unknown() -> Interior {
    match Interior::brown(28.0) {
        Interior::Brown { x0, y0, k1, k2, k3, p1, p2, b1, b2, .. } => {
            Interior::Brown { c: None, x0, y0, k1, k2, k3, p1, p2, b1, b2 }
        }
        other => other,
    }
}

/// Two walls far from each other, each with photos of its own, the second with more of them.
fn two_walls() -> Plan {
    let (mut plan, second) = (wall(), wall());
    let away = |xyz: [f64; 3]| [xyz[0] + 50_000.0, xyz[1], xyz[2]];
    plan.points.extend(second.points.into_iter().map(|point| sightline::project::Point {
        id: format!("far {}", point.id),
        xyz: point.xyz.map(away),
        ..point
    }));
    plan.stations.truncate(3);
    plan.stations.extend(second.stations.into_iter().map(|station| PlanStation {
        id: format!("far {}", station.id),
        position: away(station.position),
        look_at: station.look_at.map(away),
        ..station
    }));
    plan
}

#[test]
fn groups_that_are_not_tied_are_told_by_the_stations_names_and_found_without_them() {
    let mut plan = two_walls();
    let lacks = predict(&plan).expect("a prediction").lacks;
    let names = |prefix: &str, count: usize| (1..=count).map(|k| format!("{prefix}{k}")).collect::<Vec<_>>();
    let defect = Defect::NotTied { groups: vec![names("", 3), names("far ", 4)] };
    assert!(lacks.contains(&Lacking::Defect { defect }), "{lacks:?}");
    assert!(lacks.contains(&Lacking::Undetermined { points: names("", 20) }), "{lacks:?}");
    // In a search nothing has a name yet.
    let value = |plan: &Plan| {
        let setup = Setup::new(plan).expect("a plan");
        let shots: Vec<_> = plan.stations.iter().map(|station| setup.shot(station).expect("a photo")).collect();
        judgement::value(&setup, &shots.iter().collect::<Vec<_>>(), &Criterion::Worst)
    };
    let named = value(&plan);
    plan.stations.iter_mut().for_each(|station| station.id.clear());
    assert_eq!(value(&plan), named);
    plan.stations.truncate(3);
    plan.points.truncate(20);
    assert!(judgement::is_determined(value(&plan)) && !judgement::is_determined(named));
}

#[test]
fn a_network_read_by_its_numbering_is_the_one_read_by_names() {
    let mut plan = wall();
    plan.cameras[0].free = vec![Parameter::C];
    plan.distances.push(sightline::project::PlanDistance { from: "2".into(), to: "20".into(), sigma: 0.05 });
    let corners = ["1", "5", "16", "20"];
    let named_datum = |plan: &mut Plan| plan.datum.points = Some(corners.map(String::from).into());
    let control = |plan: &mut Plan| {
        plan.datum.kind = DatumKind::Control;
        for point in plan.points.iter_mut().filter(|p| corners.contains(&p.id.as_str())) {
            (point.role, point.sigma) = (sightline::project::Role::Control, Some([Some(0.1), None, Some(0.2)]));
        }
    };
    for edit in [&named_datum as &dyn Fn(&mut Plan), &control] {
        let mut plan = plan.clone();
        edit(&mut plan);
        let setup = Setup::new(&plan).expect("a plan");
        let shots: Vec<_> = plan.stations.iter().map(|station| setup.shot(station).expect("a photo")).collect();
        // Two points are left out: places in the plan are not those in the document.
        let part: Vec<bool> = plan.points.iter().map(|p| !["3", "7"].contains(&p.id.as_str())).collect();
        let (mut project, numbering) = setup.numbered(&shots.iter().collect::<Vec<_>>(), &part).expect("sound");
        let numbered = sightline::adjust::predict_numbered(&project, &numbering).expect("determined");
        for (o, &(photo, point)) in project.observations.iter_mut().zip(&numbering.observations) {
            (o.photo, o.point) = (project.photos[photo].id.clone(), project.points[point].id.clone());
        }
        let named = sightline::adjust::predict(&project).expect("determined");
        assert_eq!((numbered.points.len(), numbered.redundancy), (18, named.redundancy));
        assert_eq!(
            (&numbered.points, &numbered.cameras, &numbered.photos),
            (&named.points, &named.cameras, &named.photos)
        );
    }
}

#[test]
fn a_plate_calibrates_its_camera_fully() {
    for (width, height, upright) in [(1000.0, 800.0, false), (2000.0, 1500.0, true)] {
        let form = Form::Plane { width, height, columns: 6, rows: 5, upright, diameter: width / 100.0 };
        let (points, faces) = targets_on(&form).expect("targets");
        let mut plan = Plan { cameras: vec![camera()], form: Some(form), points, faces, ..Plan::default() };
        plan.cameras[0].free = Parameter::BROWN.to_vec();
        plan.wanted.precision = 0.05;
        let made = make(&plan, &MakeOptions::default(), &mut |_, _| true).expect("a plan");
        let rolls: Vec<i32> = made.stations.iter().map(|s| s.roll.to_degrees().round() as i32).collect();
        assert!(made.prediction.reached && made.ended == Ended::Reached, "{rolls:?}: {:?}", made.prediction.lacks);
        assert!(rolls.contains(&0) && rolls.contains(&90), "{rolls:?}");
    }
}

#[test]
fn a_search_says_why_it_ended() {
    let mut plan = wall();
    plan.stations.clear();
    plan.wanted.precision = 1e-6;
    let few = make(&plan, &MakeOptions { most: 4 }, &mut |_, _| true).expect("a plan");
    assert_eq!(few.ended, Ended::MostPhotos { most: 4 });
    plan.wanted.precision = 0.1;
    let reached = make(&plan, &MakeOptions::default(), &mut |_, _| true).expect("a plan");
    assert_eq!((reached.ended, reached.prediction.reached), (Ended::Reached, true));
}

/// Control points are the reference of a comparison, and what is given of them is not used; of four it cannot be decided which has moved.
#[test]
fn a_second_campaign_is_compared_in_the_datum_of_the_reference_points() {
    use sightline::monitoring::ReferenceFrom;
    use sightline::project::{Datum, Role};
    let mut plan = wall();
    let chosen = [0, 4, 7, 12, 15, 19];
    let ids: Vec<String> = chosen.iter().map(|k| plan.points[*k].id.clone()).collect();
    plan.datum = Datum { kind: DatumKind::Free, points: Some(ids.clone()) };
    let free = predict(&plan).expect("a prediction");
    let told = free.repeated.clone().expect("comparable");
    assert_eq!((&told.reference, told.reference_from), (&ids, ReferenceFrom::Datum));
    assert_eq!(told.redundancy, 2 * free.redundancy.expect("determined"));
    let worst = free.points.iter().filter_map(|p| p.detectable).map(|d| d.worst).fold(0.0, f64::max);
    assert_eq!(told.largest, Some(worst));
    // λ₀(3, f) at 0.05/14 is above 12, so that a displacement of an object point has to be some five standard errors of the difference
    // long. A reference point that moves leaves the datum, in which its own standard errors are smaller than among the others.
    for point in &free.points {
        let (detectable, axis) = (point.detectable.expect("detectable"), point.axis.expect("determined"));
        let times = detectable.worst / (axis * 2f64.sqrt());
        let most = if ids.contains(&point.id) { f64::INFINITY } else { 9.0 };
        assert!((3.4..most).contains(&times), "{}: {times}", point.id);
        assert!(detectable.axes.iter().flatten().all(|d| *d <= detectable.worst * (1.0 + 1e-9)));
    }
    for k in chosen {
        plan.points[k].role = Role::Control;
        plan.points[k].sigma = Some([Some(0.001); 3]);
    }
    for kind in [DatumKind::Control, DatumKind::Minimal, DatumKind::Free] {
        plan.datum = Datum { kind, points: None };
        let found = predict(&plan).expect("a prediction");
        let told = found.repeated.expect("comparable");
        assert_eq!((&told.reference, told.reference_from), (&ids, ReferenceFrom::Control), "{kind:?}");
        for (a, b) in free.points.iter().zip(&found.points) {
            let [a, b] = [a, b].map(|p| p.detectable.expect("detectable").worst);
            assert!((a / b - 1.0).abs() < 1e-6, "{kind:?}: {a} {b}");
        }
    }
    for (k, point) in plan.points.iter_mut().enumerate() {
        point.role = if [0, 4, 15, 19].contains(&k) { Role::Control } else { Role::Tie };
    }
    let four = predict(&plan).expect("a prediction");
    assert_eq!(four.repeated.expect("comparable").reference.len(), 4);
    assert!((0..20).all(|k| four.points[k].detectable.is_none() == [0, 4, 15, 19].contains(&k)));
}
