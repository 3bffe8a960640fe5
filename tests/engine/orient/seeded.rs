//! Orientation over seeded networks and single photos with a truth: the short form of `cargo xtask bench orient`.

#[path = "../../../benches/orient/dots.rs"]
pub mod dots;
#[path = "../../../benches/orient/network.rs"]
mod network;

use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use sightline::camera::{ideal_from_pixel, pixel_from_camera_point};
use sightline::initial::Pose;
use sightline::orient::{Note, orient};
use sightline::project::{Camera, DatumKind, Interior, Observation, Photo, Point, Project, Role, Sigma};
use sightline::rotation;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use crate::support::extent;
use network::{Case, both, gauss, judged, unit};

/// One photo of `count` control points, in space or in a plane; its truth.
fn single(seed: u64, count: usize, plane: bool, noise_px: f64) -> (Project, Pose) {
    let mut g = ChaCha8Rng::seed_from_u64(seed);
    let camera = Camera::new("k", 3000, 2000, Interior::brown(3000.0));
    let mut project = Project { cameras: vec![camera.clone()], ..Project::default() };
    let direction = Vector3::new(0.7 * both(&mut g), 0.7 * both(&mut g), 1.0).normalize();
    let x = Vector3::y().cross(&direction).normalize();
    let level = nalgebra::Matrix3::from_rows(&[x.transpose(), direction.cross(&x).transpose(), direction.transpose()]);
    let m = rotation::object_to_camera([0.0, 0.0, 3.1 * both(&mut g)]) * level;
    let pose = Pose { object_to_camera: m, centre: direction * (4.5 + unit(&mut g)) };
    for k in 0..count {
        let (point, depth) = (format!("p{k}"), if plane { 0.0 } else { 0.7 * both(&mut g) });
        let xyz = Vector3::new(both(&mut g), 0.8 * both(&mut g), depth);
        let [u, v] = pixel_from_camera_point(&camera, pose.to_camera(&xyz)).expect("in front");
        let (u, v) = (u + noise_px * gauss(&mut g), v + noise_px * gauss(&mut g));
        let sigma = Sigma::One(noise_px);
        project.observations.push(Observation {
            photo: "f".into(),
            point: point.clone(),
            u,
            v,
            sigma,
            enabled: true,
            target: None,
        });
        let role = Role::Control;
        project.points.push(Point { id: point, role, xyz: Some(xyz.into()), ..Point::default() });
    }
    project.photos.push(Photo { id: "f".into(), camera: "k".into(), enabled: true, ..Photo::default() });
    project.datum.kind = DatumKind::Control;
    (project, pose)
}

/// A single photo ends in the best minimum, or both are named. The comparison is the minimum next to the truth, which the
/// resection does not know.
#[test]
fn few_control_points_give_the_best_pose_or_both() {
    let (mut right, mut ambiguous, mut runs) = (0, 0, 0);
    let mut failed = Vec::new();
    for seed in 0..extent::cases(150, 600) as u64 {
        let (count, plane, noise) = (4 + seed as usize % 3, seed / 3 % 2 == 1, [0.1, 0.3, 0.5][seed as usize / 6 % 3]);
        let (project, truth) = single(seed, count, plane, noise);
        let oriented = orient(&project).expect("a valid project");
        runs += 1;
        let Some(found) = Pose::of_photo(&oriented.project.photos[0]) else {
            failed.push((seed, count, plane, "not oriented"));
            continue;
        };
        let object: Vec<Vector3<f64>> = project.points.iter().filter_map(|p| p.xyz.map(Into::into)).collect();
        let rays = project.observations.iter().map(|o| ideal_from_pixel(&project.cameras[0], [o.u, o.v]));
        let image: Vec<[f64; 2]> = rays.map(|ray| ray.expect("a ray")).collect();
        let best = truth.refined(&object, &image).expect("in front").cost(&object, &image);
        let said = oriented.notes.iter().any(|n| matches!(n, Note::PhotoAmbiguous { .. }));
        ambiguous += usize::from(said);
        if found.cost(&object, &image) <= best * 1.001 {
            right += 1;
        } else if !said {
            failed.push((seed, count, plane, "a worse minimum"));
        }
    }
    println!("single photos: {right} of {runs} in the best minimum, {ambiguous} said to be ambiguous");
    assert!(failed.len() * 200 <= runs, "{failed:?}");
}

/// Seeds 0 to 41 up to 10 photos: every kind, every knowledge of c, clean and with 2 % of wrong names.
#[test]
fn seeded_networks_are_oriented_and_none_is_wrong_in_silence() {
    let (mut solvable, mut right) = (0, 0);
    let mut lost = Vec::new();
    for seed in 0..extent::cases(14, 42) as u64 {
        let case = Case::of(seed, 10);
        let network = network::network(&case);
        let verdict = judged(&network, &orient(&network.given).expect("a valid project"));
        assert!(verdict.wrong.is_empty(), "seed {seed}: {verdict:?}");
        assert!(!verdict.silent_c, "seed {seed}: {verdict:?}");
        assert!(!verdict.solvable || case.wrong > 0.0 || verdict.falsely_wrong == 0, "seed {seed}: {verdict:?}");
        solvable += usize::from(verdict.solvable);
        if verdict.solvable && verdict.right {
            right += 1;
        } else if verdict.solvable {
            lost.push((seed, case, verdict));
        }
    }
    println!("seeded networks: {right} right of {solvable} that can be solved");
    assert!(100 * right >= 97 * solvable, "{lost:?}");
}

/// Photos with few measurements, which a rough model refuses, and the networks beyond them are oriented once everything else stands.
#[test]
fn photos_left_over_are_oriented_in_the_end() {
    for &seed in extent::of(&[206, 240, 247, 265, 300], 1) {
        let network = network::network(&Case::of(seed, 60));
        let verdict = judged(&network, &orient(&network.given).expect("a valid project"));
        assert!(verdict.right && verdict.wrong.is_empty(), "seed {seed}: {verdict:?}");
    }
}

/// Two photos between 30 and 5 others of a strip are withdrawn. The five, which nothing ties to the thirty any more, do not keep poses
/// in a system of their own, and all seven are oriented relative to the other photos.
#[test]
fn photos_that_nothing_ties_to_the_others_keep_no_pose() {
    let network = network::network(&Case::of(194, 60));
    let oriented = orient(&network.given).expect("a valid project");
    let verdict = judged(&network, &oriented);
    assert!(verdict.right && verdict.falsely_wrong == 0, "{verdict:?}");
    assert!(!oriented.notes.iter().any(|note| matches!(note, Note::Groups { .. })), "{:?}", oriented.notes);
}

/// A corridor's points are known badly along its axis while the model is rough: what near photos measure of them is not wrong. A dome
/// with every tenth name wrong had a photo 2° off that six of its nine measurements agreed with; all nine are right.
#[test]
fn measurements_that_a_rough_model_left_out_come_back() {
    for &seed in extent::of(&[258, 342, 594, 769], 1) {
        let network = network::network(&Case::of(seed, 60));
        let verdict = judged(&network, &orient(&network.given).expect("a valid project"));
        assert!(verdict.falsely_wrong == 0 && verdict.wrong.is_empty(), "seed {seed}: {verdict:?}");
    }
    let network = network::network(&Case::of(501, 60));
    let verdict = judged(&network, &orient(&network.given).expect("a valid project"));
    assert!(verdict.right && verdict.falsely_wrong == 0, "seed 501: {verdict:?}");
}

/// Plates and reliefs of which no two photos share nine points, once with every tenth name wrong and c unknown: nothing was oriented.
#[test]
fn nearly_flat_objects_need_no_pair_of_photos_with_many_points() {
    for &seed in extent::of(&[29, 112, 218, 232], 1) {
        let network = network::network(&Case::of(seed, 60));
        let verdict = judged(&network, &orient(&network.given).expect("a valid project"));
        assert!(verdict.right && verdict.wrong.is_empty(), "seed {seed}: {verdict:?}");
    }
}

/// A corridor in six photos, nothing wrong and c unknown: from principal distances too far apart it ended at one and a half times c, with five right
/// measurements called wrong.
#[test]
fn a_weak_network_is_started_near_its_principal_distance() {
    let network = network::network(&Case::of(1098, 60));
    let verdict = judged(&network, &orient(&network.given).expect("a valid project"));
    assert!(verdict.right && verdict.falsely_wrong == 0, "{verdict:?}");
}

/// Ten points of a wall that two photos show have two relative orientations. These networks had photos in the other one, up to 74° and
/// their whole distance off, with right measurements called wrong for it and a sigma0 of 1; the third had no end.
#[test]
fn the_second_pose_of_a_wall_is_left_for_the_first() {
    for &seed in extent::of(&[832, 1367, 1406], 1) {
        let network = network::network(&Case::of(seed, 60));
        let verdict = judged(&network, &orient(&network.given).expect("a valid project"));
        assert!(verdict.right && verdict.falsely_wrong == 0, "seed {seed}: {verdict:?}");
    }
}

/// Rough models of few photos changed the given principal distance of these networks wrongly, and no adjustment came to an end.
#[test]
fn a_given_distance_is_held_where_the_network_fails_otherwise() {
    for &seed in extent::of(&[244, 356], 1) {
        let network = network::network(&Case::of(seed, 60));
        let verdict = judged(&network, &orient(&network.given).expect("a valid project"));
        assert!(verdict.right && !verdict.silent_c, "seed {seed}: {verdict:?}");
    }
}

/// What was found wrong one after the other left photos of these networks with a pose and next to no measurement, wrong and unsaid.
#[test]
fn a_pose_that_nothing_bears_out_is_withdrawn_and_said_to_be() {
    for seed in [160, 195, 250] {
        let network = network::network(&Case::of(seed, 60));
        let oriented = orient(&network.given).expect("a valid project");
        let verdict = judged(&network, &oriented);
        assert!(verdict.wrong.is_empty(), "seed {seed}: {verdict:?}");
        let without: Vec<&Photo> = oriented.project.photos.iter().filter(|p| p.position.is_none()).collect();
        assert!(!without.is_empty() && 2 * without.len() < network.given.photos.len(), "seed {seed}");
        for photo in without {
            let named = |n: &Note| matches!(n, Note::PhotoNotOriented { photo: named, .. } if *named == photo.id);
            assert!(oriented.notes.iter().any(named), "seed {seed}: {}", photo.id);
        }
    }
}

/// Five control points in four photos, one with wrong coordinates: four agree in each photo, and that is enough.
#[test]
fn a_wrong_control_point_takes_no_photo_along() {
    for seed in 0..6 {
        let (mut project, _) = single(seed, 5, false, 0.1);
        for other in 1..4 {
            let (next, pose) = single(100 * seed + other, 5, false, 0.1);
            let photo = format!("g{other}");
            project.photos.push(Photo { id: photo.clone(), ..next.photos[0].clone() });
            for (point, seen) in project.points.iter().zip(next.observations) {
                let xyz = Vector3::from(point.xyz.expect("control"));
                let Some([u, v]) = pixel_from_camera_point(&project.cameras[0], pose.to_camera(&xyz)) else { continue };
                project.observations.push(Observation { photo: photo.clone(), u, v, ..seen });
            }
        }
        project.points[0].xyz = project.points[0].xyz.map(|[x, y, z]| [x + 0.4, y, z - 0.3]);
        let oriented = orient(&project).expect("a valid project");
        assert!(oriented.project.photos.iter().all(|p| p.position.is_some()), "seed {seed}: {:?}", oriented.notes);
    }
}

/// 60 photos with 300 points, seen in six photos or in fifteen: whole and right.
#[test]
fn large_networks_are_oriented_whole() {
    for &seed in extent::of(&[1, 3, 8, 9], 1) {
        let network = network::network(&Case::large(seed));
        let verdict = judged(&network, &orient(&network.given).expect("a valid project"));
        assert!(verdict.right && verdict.wrong.is_empty() && !verdict.silent_c, "seed {seed}: {verdict:?}");
    }
}

/// 600 bare dots in three to twelve photos: at least 98 % are found, none wrong, at the noise's own tolerance and at a wide one.
#[test]
fn bare_dots_get_their_own_names_or_none() {
    for &(seed, photos, tolerance) in extent::of(&[(1, 3, None), (4, 12, Some(10.0)), (2, 5, None), (3, 12, None)], 2) {
        let matched = dots::matched(seed, photos, 600, tolerance);
        println!("{photos} photos in {:.1} s: {matched:?}", matched.seconds);
        assert_eq!(matched.wrong, 0, "{photos} photos: {matched:?}");
        assert!(100 * matched.found >= 98 * matched.wanted, "{photos} photos: {matched:?}");
    }
}
