//! An image error beyond the standard errors given, estimated from the residuals.

use sightline::adjust::{adjust, unmodelled as estimate};
use sightline::adjustment::AdjustOptions;
use sightline::error::Place;
use sightline::project::{Camera, DatumKind, Interior, Project, Sigma};
use sightline_plan::network::{Network, NetworkPoint, Station, simulate};

/// Six photos around a block of points; every image coordinate is off by 0.12 px and says 0.02.
fn project() -> Project {
    let camera = Camera { pixel_pitch: Some([0.005; 2]), ..Camera::new("c", 2000, 1600, Interior::brown(12.0)) };
    let point = |k: u32| NetworkPoint {
        id: k.to_string(),
        xyz: [f64::from(k % 6) * 100.0, f64::from(k / 6 % 6) * 100.0, f64::from(k * 7 % 5) * 40.0],
        ..NetworkPoint::default()
    };
    let station = |k: u32| {
        let turn = f64::from(k);
        let position = [250.0 + 900.0 * turn.cos(), 250.0 + 900.0 * turn.sin(), 900.0];
        Station::aimed(format!("s{k}"), "c", position, [250.0, 250.0, 80.0], turn)
    };
    let mut project = simulate(&Network {
        cameras: vec![camera],
        stations: (0..6).map(station).collect(),
        points: (0..36).map(point).collect(),
        sigma: Sigma::One(0.02),
        noise: Some(Sigma::One(0.12)),
        ..Network::default()
    })
    .unwrap();
    project.datum.kind = DatumKind::Free;
    project
}

#[test]
fn what_is_estimated_makes_the_residuals_agree() {
    let project = project();
    let with = |unmodelled| {
        let options = AdjustOptions { unmodelled, ..AdjustOptions::default() };
        adjust(&project, &options, &mut |_| true).unwrap()
    };
    let plain = with(0.0);
    assert!(plain.sigma0.unwrap() > 5.0);
    let found = estimate(&project, &plain).unwrap();
    // 432 coordinates: 0.118 within four of its standard errors.
    assert!((found - (0.12f64.powi(2) - 0.02f64.powi(2)).sqrt()).abs() < 0.02, "{found}");
    let weighted = with(found);
    assert!((weighted.sigma0.unwrap() - 1.0).abs() < 0.01, "{:?}", weighted.sigma0);
    assert!(weighted.global_test.unwrap().passed);
    // One sigma for all coordinates moves no value.
    for (a, b) in plain.points.iter().zip(&weighted.points) {
        assert!(a.xyz.iter().zip(b.xyz).all(|(a, b)| (a - b).abs() < 1e-6), "{a:?} {b:?}");
    }
}

#[test]
fn impossible_numbers_are_refused() {
    let project = project();
    for unmodelled in [-0.1, f64::NAN, f64::INFINITY] {
        let options = AdjustOptions { unmodelled, ..AdjustOptions::default() };
        let error = adjust(&project, &options, &mut |_| true).unwrap_err();
        assert_eq!(error.place(), Place::field("unmodelled"));
    }
}
