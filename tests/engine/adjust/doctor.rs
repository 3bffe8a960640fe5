//! The doctor: every rank defect is reported with the photos, points or parameters concerned and a remedy, every weakness of a solvable network is
//! named, and a sound network has none.

use crate::support::networks::{Uniform, Wanted, brown, exact, noisy};
use nalgebra::{Matrix3, Vector3};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment, Advice, Given};
use sightline::camera::pixel_from_camera_point;
use sightline::error::{Defect, Error};
use sightline::noise::Noise;
use sightline::project::{DatumKind, Parameter, Photo, Project, Role};
use sightline::rotation;

fn run(project: &Project) -> Adjustment {
    adjust(project, &AdjustOptions::default(), &mut |_| true).expect("solvable")
}

/// The defects, and the sentence that reports them.
fn defects(project: &Project) -> (Vec<Defect>, String) {
    match adjust(project, &AdjustOptions::default(), &mut |_| true) {
        Err(error @ Error::RankDefect { .. }) => {
            let text = error.to_string();
            let Error::RankDefect { defects } = error else { unreachable!() };
            (defects, text)
        }
        other => panic!("{:?}", other.map(|a| a.sigma0)),
    }
}

fn whole() -> Project {
    noisy(&exact(&Wanted::default(), 17), &mut Noise::new(17, 0))
}

/// Observes everything anew and exactly, where the photos and points stand now.
fn observe(project: &mut Project) {
    for o in &mut project.observations {
        let photo = project.photos.iter().find(|p| p.id == o.photo).expect("known");
        let point = project.points.iter().find(|p| p.id == o.point).expect("known");
        let camera = project.cameras.iter().find(|c| c.id == photo.camera).expect("known");
        let d = Vector3::from(point.xyz.expect("known")) - Vector3::from(photo.position.expect("known"));
        let d = rotation::object_to_camera(photo.rotation.expect("known")) * d;
        [o.u, o.v] = pixel_from_camera_point(camera, d).expect("in front");
    }
}

/// A photo at a place, looking at the origin.
fn looking(photo: &Photo, place: Vector3<f64>, roll: f64) -> Photo {
    let z = place.normalize();
    let x = Vector3::new(0.2, 1.0, 0.1).cross(&z).normalize();
    let x = x * roll.cos() + z.cross(&x) * roll.sin();
    let m = Matrix3::from_rows(&[x.transpose(), z.cross(&x).transpose(), z.transpose()]);
    Photo { position: Some(place.into()), rotation: Some(rotation::angles(&m)), ..photo.clone() }
}

#[test]
fn a_missing_datum_is_counted() {
    let mut loose = whole();
    loose.datum.kind = DatumKind::Control;
    let (found, text) = defects(&loose);
    assert_eq!(found, [Defect::NoDatum { missing: 7 }]);
    assert!(text.contains("add control points"), "{text}");
    // Two points leave the rotation about their line; with a distance instead of the second all rotations.
    for k in 0..2 {
        loose.points[k].role = Role::Control;
    }
    assert_eq!(defects(&loose).0, [Defect::NoDatum { missing: 1 }]);
    loose.points[1].role = Role::Tie;
    assert_eq!(defects(&loose).0, [Defect::NoDatum { missing: 4 }]);
}

#[test]
fn points_and_photos_with_too_little_are_named() {
    let mut once = whole();
    once.observations.retain(|o| o.point != "p5" || o.photo == "f1");
    let (found, text) = defects(&once);
    assert_eq!(found, [Defect::TooFewRays { points: vec!["p5".into()] }]);
    assert!(text.contains("p5") && text.contains("measure it in a second photo"), "{text}");
    let mut lost = whole();
    lost.observations.retain(|o| o.photo != "f2" || o.point == "p0" || o.point == "p1");
    let (found, text) = defects(&lost);
    assert_eq!(found, [Defect::PhotoUndetermined { photos: vec!["f2".into()] }]);
    assert!(text.contains("f2") && text.contains("at least three"), "{text}");
}

#[test]
fn rays_in_one_line_determine_no_point() {
    // Both photos that show p7 are on a line with it.
    let mut project = exact(&Wanted { cameras: vec![brown(&[])], ..Wanted::default() }, 17);
    let point = Vector3::from(project.points[7].xyz.expect("known"));
    let first = Vector3::from(project.photos[0].position.expect("known"));
    project.photos[1] = looking(&project.photos[1], point + (first - point) * 1.1, 0.7);
    project.observations.retain(|o| o.point != "p7" || o.photo == "f0" || o.photo == "f1");
    observe(&mut project);
    assert_eq!(defects(&project).0, [Defect::TooFewRays { points: vec!["p7".into()] }]);
}

#[test]
fn points_in_one_line_orient_no_photo() {
    // Photo f3 sees four points, all in one line: it may turn about that line.
    let mut project = exact(&Wanted { cameras: vec![brown(&[])], ..Wanted::default() }, 17);
    for k in 0..4 {
        project.points[k].xyz = Some([-300.0 + 200.0 * k as f64, 100.0 - 70.0 * k as f64, 40.0 * k as f64]);
    }
    project.observations.retain(|o| o.photo != "f3" || ["p0", "p1", "p2", "p3"].contains(&o.point.as_str()));
    observe(&mut project);
    assert_eq!(defects(&project).0, [Defect::PhotoUndetermined { photos: vec!["f3".into()] }]);
}

#[test]
fn groups_that_are_not_tied_are_listed() {
    let half = |id: &str| id[1..].parse::<usize>().expect("a number") % 2;
    let groups = [["f0", "f2", "f4"], ["f1", "f3", "f5"]].map(|group| group.map(String::from).to_vec());
    let mut halves = whole();
    halves.observations.retain(|o| half(&o.photo) == half(&o.point));
    let (found, text) = defects(&halves);
    assert_eq!(found, [Defect::NotTied { groups: groups.to_vec() }]);
    assert!(text.contains("measure common points"), "{text}");
    // Two common points are a hinge.
    let mut hinge = whole();
    hinge.observations.retain(|o| ["p0", "p1"].contains(&o.point.as_str()) || half(&o.photo) == half(&o.point));
    assert_eq!(defects(&hinge).0, [Defect::NotTied { groups: groups.to_vec() }]);
}

#[test]
fn a_hinge_of_three_points_in_line_is_a_combination() {
    let mut project = exact(&Wanted { points: 20, cameras: vec![brown(&[])], ..Wanted::default() }, 17);
    for k in 0..3 {
        project.points[k].xyz = Some([-300.0 + 280.0 * k as f64, 150.0 - 120.0 * k as f64, 50.0 * k as f64]);
    }
    let half = |id: &str| id[1..].parse::<usize>().expect("a number") % 2;
    let common = ["p0", "p1", "p2"];
    project.observations.retain(|o| common.contains(&o.point.as_str()) || half(&o.photo) == half(&o.point));
    observe(&mut project);
    let (found, text) = defects(&project);
    // One of the halves is said to move, not both.
    let [Defect::Combination { points, photos, .. }] = &found[..] else { panic!("{found:?}") };
    let side = half(&photos[0]);
    assert!(photos.len() == 3 && photos.iter().chain(points).all(|id| half(id) == side), "{found:?}");
    assert!(points.len() >= 5 && !points.iter().any(|id| common.contains(&id.as_str())), "{found:?}");
    assert!(text.contains("combination"), "{text}");
}

/// Photos that look straight at a plane.
fn over_a_plane(wanted: &Wanted, free: &[Parameter]) -> Project {
    let mut plane = exact(wanted, 17);
    plane.cameras.iter_mut().for_each(|camera| camera.free = free.to_vec());
    for photo in &mut plane.photos {
        let [x, y, _] = photo.position.expect("known");
        (photo.position, photo.rotation) = (Some([x / 3.0, y / 3.0, 1500.0]), Some([0.0, 0.0, 0.0]));
    }
    for point in &mut plane.points {
        point.xyz = point.xyz.map(|[x, y, _]| [x, y, 0.0]);
    }
    observe(&mut plane);
    plane
}

#[test]
fn parameters_that_the_network_cannot_tell_apart_are_named() {
    // Nothing tells the principal distance from the depth, and the principal point from the place.
    let plane = over_a_plane(&Wanted::default(), &[Parameter::C, Parameter::X0, Parameter::Y0]);
    let (found, text) = defects(&plane);
    let [
        Defect::ParameterUndetermined { camera, parameters: told },
        Defect::Combination { points, photos, parameters },
    ] = &found[..]
    else {
        panic!("{found:?}")
    };
    assert!(camera == "brown" && told.contains(&"c".to_string()), "{found:?}");
    assert!(parameters.contains(&"brown.c".to_string()) && parameters.len() == told.len(), "{found:?}");
    let all: Vec<_> = plane.photos.iter().map(|photo| photo.id.clone()).collect();
    assert!(*photos == all && points.is_empty(), "{found:?}");
    assert!(text.contains("hold it") && text.contains("brown.c"), "{text}");
}

#[test]
fn a_photo_with_an_interior_orientation_of_its_own_is_named_with_it() {
    // One photo looks straight at a plane that the others look at from the sides: its own c and height are one.
    let mut camera = brown(&[Parameter::C]);
    camera.per_photo = true;
    let mut project = exact(&Wanted { cameras: vec![camera], ..Wanted::default() }, 17);
    project.points.iter_mut().for_each(|point| point.xyz = point.xyz.map(|[x, y, _]| [x, y, 0.0]));
    let [x, y, _] = project.photos[2].position.expect("known");
    (project.photos[2].position, project.photos[2].rotation) =
        (Some([x / 3.0, y / 3.0, 1500.0]), Some([0.0, 0.0, 0.4]));
    observe(&mut project);
    let (found, text) = defects(&project);
    let parameter = Defect::ParameterUndetermined { camera: "brown".into(), parameters: vec!["c".into()] };
    let photos = vec!["f2".to_string()];
    let together = Defect::Combination { points: Vec::new(), photos, parameters: vec!["brown.c".into()] };
    assert_eq!(found, [parameter, together]);
    assert!(text.contains("f2") && text.contains("brown.c"), "{text}");
}

/// All correlations beyond 0.95 in the matrices of a result, of the interior orientations and with each photo.
fn high_correlations(adjustment: &Adjustment) -> Vec<(Option<String>, String, String)> {
    let mut list = Vec::new();
    for camera in &adjustment.cameras {
        let (names, matrix) = (&camera.correlation.names, &camera.correlation.matrix);
        let pairs = (0..names.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let high = pairs.filter(|(i, j)| matrix[*i][*j].abs() > 0.95);
        list.extend(high.map(|(i, j)| (camera.photo.clone(), names[j].clone(), names[i].clone())));
    }
    for photo in &adjustment.photos {
        let correlation = photo.correlation.as_ref().expect("full");
        let (names, matrix) = (&correlation.names, &correlation.matrix);
        let pairs = (0..names.len()).flat_map(|i| (0..i.min(6)).map(move |j| (i, j)));
        let high = pairs.filter(|(i, j)| matrix[*i][*j].abs() > 0.95);
        list.extend(high.map(|(i, j)| (Some(photo.id.clone()), names[j].clone(), names[i].clone())));
    }
    list
}

#[test]
fn correlations_beyond_a_limit_are_told_all_and_only_they() {
    let camera = brown(&[Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1, Parameter::K2, Parameter::K3]);
    let project = noisy(&exact(&Wanted { cameras: vec![camera], ..Wanted::default() }, 17), &mut Noise::new(17, 0));
    let adjustment = run(&project);
    let expected = high_correlations(&adjustment);
    assert!(expected.contains(&(None, "k2".into(), "k3".into())), "{expected:?}");
    assert!(expected.iter().any(|(photo, ..)| photo.is_some()), "{expected:?}");
    let told = adjustment.advice.iter().filter_map(|advice| match advice {
        Advice::HighCorrelation { photo, first, second, correlation, camera } => {
            assert!(correlation.abs() > 0.95 && camera == "brown");
            Some((photo.clone(), first.clone(), second.clone()))
        }
        _ => None,
    });
    assert_eq!(told.collect::<Vec<_>>(), expected);
}

#[test]
fn observations_that_little_checks_are_told_all_and_only_they() {
    let wanted = Wanted {
        photos: 4,
        points: 12,
        datum: DatumKind::Control,
        control: (4, 0.05),
        distances: (2, 0.05),
        ..Wanted::default()
    };
    let mut project = noisy(&exact(&wanted, 17), &mut Noise::new(17, 0));
    // A single control coordinate that hardly anything checks, and points with two rays.
    project.points[0].sigma = Some([Some(20.0), Some(0.001), Some(0.05)]);
    project.observations.retain(|o| o.point != "p9" || o.photo == "f0" || o.photo == "f1");
    let adjustment = run(&project);
    let weak = |r: Option<f64>| r.is_some_and(|r| r < 0.1);
    let observations = adjustment.observations.iter().filter(|o| o.enabled && (weak(o.rx) || weak(o.ry)));
    let observations: Vec<_> = observations.map(|o| (o.photo.clone(), o.point.clone())).collect();
    let given = adjustment.given.iter().filter(|g| weak(g.reliability.map(|r| r.redundancy)));
    let given: Vec<_> = given.map(|g| g.what.clone()).collect();
    assert!(!observations.is_empty(), "the network has none");
    assert!(given.contains(&Given::Control { point: "p0".into(), axis: 1 }), "{given:?}");
    assert!(!given.contains(&Given::Control { point: "p0".into(), axis: 0 }), "{given:?}");
    assert!(adjustment.advice.contains(&Advice::LowRedundancy { observations, given }), "{:?}", adjustment.advice);
    // One distance alone only sets the scale.
    let one = noisy(&exact(&Wanted { distances: (1, 0.05), ..Wanted::default() }, 17), &mut Noise::new(17, 0));
    let bar = Given::Distance { from: "p0".into(), to: "p1".into() };
    let told = |a: &Advice| matches!(a, Advice::LowRedundancy { given, .. } if *given == [bar.clone()]);
    assert!(run(&one).advice.iter().any(told));
}

#[test]
fn points_with_two_rays_are_told() {
    let mut weak = whole();
    weak.observations.retain(|o| o.point != "p4" || o.photo == "f0" || o.photo == "f3");
    weak.observations.retain(|o| o.point != "p8" || ["f0", "f1", "f3"].contains(&o.photo.as_str()));
    let advice = run(&weak).advice;
    assert!(advice.contains(&Advice::TwoRays { points: vec!["p4".into()] }), "{advice:?}");
    // Held in all axes it needs no more.
    weak.datum.kind = DatumKind::Control;
    (0..5).for_each(|k| weak.points[k].role = Role::Control);
    let advice = run(&weak).advice;
    assert!(!advice.iter().any(|a| matches!(a, Advice::TwoRays { .. })), "{advice:?}");
}

#[test]
fn rays_that_meet_under_less_than_5_degrees_are_told_from_either_side() {
    let mut random = Uniform(5);
    let mut project = exact(&Wanted { photos: 8, cameras: vec![brown(&[])], ..Wanted::default() }, 17);
    let point = Vector3::from(project.points[4].xyz.expect("known"));
    let towards = Vector3::from(project.photos[0].position.expect("known")) - point;
    let across = towards.cross(&Vector3::new(0.3, -0.2, 1.0)).normalize();
    // f6 and f7 stand 4.9° and 5.1° beside f0 as p4 sees it, then opposite to it.
    for opposite in [1.0, -1.0] {
        for (k, degrees) in [(6, 4.9_f64), (7, 5.1)] {
            let (s, c) = degrees.to_radians().sin_cos();
            let place = point + (towards * c + across * (towards.norm() * s)) * opposite * random.between(0.99, 1.01);
            project.photos[k] = looking(&project.photos[k], place, 0.3 * k as f64);
        }
        let mut both = project.clone();
        observe(&mut both);
        let seen_by = |photos: [&str; 2]| {
            let mut project = both.clone();
            project.observations.retain(|o| o.point != "p4" || photos.contains(&o.photo.as_str()));
            let narrow = run(&project).advice.into_iter().find_map(|advice| match advice {
                Advice::NarrowIntersection { points } => Some(points),
                _ => None,
            });
            narrow.unwrap_or_default()
        };
        let [(id, angle)] = &seen_by(["f0", "f6"])[..] else { panic!("{opposite}") };
        assert!(id == "p4" && (angle.to_degrees() - 4.9).abs() < 1e-6, "{id} {angle}");
        assert_eq!(seen_by(["f0", "f7"]), []);
        assert_eq!(seen_by(["f0", "f2"]), []);
    }
}

#[test]
fn a_sound_network_is_told_nothing() {
    let wanted = Wanted { photos: 10, points: 30, cameras: vec![brown(&[Parameter::C])], ..Wanted::default() };
    let advice = run(&noisy(&exact(&wanted, 17), &mut Noise::new(17, 0))).advice;
    // Only what the choice of axes makes of photos' own elements, and that nothing gives a scale.
    let other = |a: &&Advice| !matches!(a, Advice::HighCorrelation { photo: Some(_), .. } | Advice::NoScale);
    assert_eq!(advice.iter().filter(other).count(), 0, "{advice:?}");
}

#[test]
fn distances_without_their_ends_are_told() {
    let mut project = whole();
    let mut distance = exact(&Wanted { distances: (1, 0.1), ..Wanted::default() }, 17).distances.remove(0);
    project.points.push(sightline::project::Point { id: "far".into(), role: Role::Check, ..Default::default() });
    distance.to = "far".into();
    project.distances.push(distance);
    let unused = Advice::DistanceUnused { distances: vec![("p0".into(), "far".into())] };
    assert!(run(&project).advice.contains(&unused));
}
