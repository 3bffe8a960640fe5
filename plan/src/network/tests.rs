#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use sightline::camera::pixel_from_camera_point;
use sightline::project::Interior;

/// A grid of points on a wall, three stations in front of it.
fn network() -> Network {
    let camera = Camera { pixel_pitch: Some([0.005; 2]), ..Camera::new("c", 1000, 800, Interior::brown(6.0)) };
    let point = |k: u32| NetworkPoint {
        id: k.to_string(),
        xyz: [f64::from(k % 8) * 100.0, 0.0, f64::from(k / 8) * 100.0],
        normal: Some([0.0, -1.0, 0.0]),
        diameter: Some(15.0),
        ..NetworkPoint::default()
    };
    let station = |k: u32| {
        let position = [f64::from(k) * 500.0 - 150.0, -1400.0, 350.0];
        Station::aimed(format!("s{k}"), "c", position, [350.0, 0.0, 350.0], 0.0)
    };
    Network {
        cameras: vec![camera],
        stations: (0..3).map(station).collect(),
        points: (0..64).map(point).collect(),
        ..Network::default()
    }
}

#[test]
fn exact_observations_are_the_projections() {
    let network = Network { observations: Source::Exact, ..network() };
    let project = simulate(&network).unwrap();
    assert_eq!(project.photos.len(), 3);
    assert!(project.observations.len() > 150, "{}", project.observations.len());
    for o in &project.observations {
        let station = network.stations.iter().find(|s| s.id == o.photo).unwrap();
        let point = network.points.iter().find(|p| p.id == o.point).unwrap();
        let p = station.pose().unwrap().to_camera(&point.xyz.into());
        assert_eq!(pixel_from_camera_point(&network.cameras[0], p), Some([o.u, o.v]));
    }
}

#[test]
fn noise_has_its_size_and_stays_when_a_photo_is_added() {
    let exact = simulate(&Network { observations: Source::Exact, ..network() }).unwrap();
    let noisy = simulate(&Network { sigma: Sigma::Two([0.2, 0.1]), ..network() }).unwrap();
    let n = exact.observations.len() as f64;
    let pairs = || exact.observations.iter().zip(&noisy.observations);
    let rms_u = (pairs().map(|(e, o)| (e.u - o.u).powi(2)).sum::<f64>() / n).sqrt();
    let rms_v = (pairs().map(|(e, o)| (e.v - o.v).powi(2)).sum::<f64>() / n).sqrt();
    assert!((rms_u / 0.2 - 1.0).abs() < 0.15 && (rms_v / 0.1 - 1.0).abs() < 0.15, "{rms_u} {rms_v}");
    let mut fewer = Network { sigma: Sigma::Two([0.2, 0.1]), ..network() };
    fewer.stations.pop();
    let project = simulate(&fewer).unwrap();
    assert_eq!(project.observations[..], noisy.observations[..project.observations.len()]);
}

#[test]
fn field_of_view_incidence_and_faces_hide_points() {
    let all = simulate(&network()).unwrap().observations.len();
    let narrow = simulate(&Network { margin: 150.0, ..network() }).unwrap().observations.len();
    let straight = simulate(&Network { max_incidence: 0.3, ..network() }).unwrap().observations.len();
    // A board in front of the lower half of the wall.
    let board = Face {
        corner: [-1000.0, -100.0, -1000.0],
        along: [3000.0, 0.0, 0.0],
        across: [0.0, 0.0, 1345.0],
        grey: 0.3,
        texture: 0.0,
        grain: 1.0,
    };
    let hidden = simulate(&Network { faces: vec![board], ..network() }).unwrap();
    assert!(narrow < all && straight < all);
    assert!(hidden.observations.len() < all);
    let lowest = hidden.observations.iter().map(|o| o.point.parse::<u32>().unwrap() / 8).min();
    assert_eq!(lowest, Some(4), "rows from 400 mm up are above the board");
}

#[test]
fn given_coordinates_are_off_by_their_standard_errors() {
    let mut network = network();
    for point in &mut network.points {
        point.role = Role::Control;
        point.sigma = Some([Some(0.5), None, Some(0.5)]);
    }
    let project = simulate(&network).unwrap();
    let off = |k: usize| {
        let squares = project.points.iter().zip(&network.points).map(|(p, t)| (p.xyz.unwrap()[k] - t.xyz[k]).powi(2));
        (squares.sum::<f64>() / 64.0).sqrt()
    };
    assert!((off(0) / 0.5 - 1.0).abs() < 0.3 && off(1) == 0.0);
    network.observations = Source::Exact;
    assert_eq!(simulate(&network).unwrap().points[5].xyz, Some(network.points[5].xyz));
}

#[test]
fn faults_name_their_place() {
    let mut unknown = network();
    unknown.stations[1].camera = "none".into();
    assert_eq!(simulate(&unknown).expect_err("no such camera").place().photo.as_deref(), Some("s1"));
    let mut twice = network();
    twice.points[1].id = "0".into();
    assert_eq!(simulate(&twice).expect_err("twice").code(), "duplicate");
    assert_eq!(simulate(&Network { margin: f64::NAN, ..network() }).expect_err("margin").code(), "invalid");
    let bar = Bar { from: "0".into(), to: "nowhere".into(), sigma: 0.1 };
    assert_eq!(simulate(&Network { distances: vec![bar], ..network() }).expect_err("bar").code(), "unknown");
    assert_eq!(photo(&network(), "s9").expect_err("station").code(), "unknown");
}
