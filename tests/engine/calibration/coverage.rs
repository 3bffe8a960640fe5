//! What the photos of a camera cover, and what they lack for its calibration.

use sightline::calibration::{CoverageLack, coverage};
use sightline::project::{Camera, Interior, Project};
use sightline_plan::network::{Network, NetworkPoint, Station, simulate};

/// A flat board of 30 points of `half` a width, seen from stations at a tilt and a roll in degrees.
fn board(half: f64, stations: &[(f64, f64)]) -> Project {
    let point = |k: u32| NetworkPoint {
        id: k.to_string(),
        xyz: [half * (f64::from(k % 6) / 2.5 - 1.0), half * 0.7 * (f64::from(k / 6) / 2.0 - 1.0), 0.0],
        ..NetworkPoint::default()
    };
    let station = |(k, (tilt, roll)): (usize, &(f64, f64))| {
        let tilt = tilt.to_radians();
        let position = [600.0 * tilt.sin(), 0.0, 600.0 * tilt.cos()];
        Station::aimed(format!("s{k}"), "c", position, [0.0; 3], roll.to_radians())
    };
    simulate(&Network {
        cameras: vec![Camera::new("c", 1600, 1200, Interior::brown(1500.0))],
        stations: stations.iter().enumerate().map(station).collect(),
        points: (0..30).map(point).collect(),
        ..Network::default()
    })
    .expect("a network")
}

#[test]
fn good_coverage_lacks_nothing_and_each_lack_is_told() {
    let turns = [0.0, 90.0, 180.0, 270.0];
    let good: Vec<(f64, f64)> = turns.iter().flat_map(|roll| [(2.0, *roll), (35.0, *roll)]).collect();
    let found = coverage(&board(300.0, &good), None).expect("one camera");
    assert_eq!((found.photos, found.oriented, found.rolls, found.tilts), (8, 8, [2; 4], [4, 0, 4, 0]));
    assert_eq!(found.lacks, [], "{found:?}");
    assert_eq!(found.rings.iter().sum::<usize>(), found.measurements);
    assert_eq!(found.cells.iter().flatten().sum::<usize>(), found.measurements);
    let [near, far] = found.distances.expect("oriented");
    assert!((near - 600.0).abs() < 1.0 && (far - 600.0).abs() < 1.0);
    let lacks = |stations: &[(f64, f64)]| coverage(&board(300.0, stations), None).expect("one camera").lacks;
    let has = |all: &[CoverageLack], roll, tilt| {
        (all.contains(&CoverageLack::Roll), all.contains(&CoverageLack::Tilt)) == (roll, tilt)
    };
    let upright: Vec<(f64, f64)> = good.iter().map(|(tilt, _)| (*tilt, 90.0)).collect();
    assert!(has(&lacks(&upright), true, false), "{:?}", lacks(&upright));
    let frontal: Vec<(f64, f64)> = good.iter().map(|(_, roll)| (3.0, *roll)).collect();
    assert!(has(&lacks(&frontal), false, true), "{:?}", lacks(&frontal));
    let few = coverage(&board(60.0, &good[..3]), None).expect("one").lacks;
    assert_eq!(few, [CoverageLack::Photos, CoverageLack::Radius, CoverageLack::Cells]);
}

#[test]
fn nothing_measured_lacks_photos() {
    let mut bare = board(300.0, &[(0.0, 0.0)]);
    bare.observations = Default::default();
    let found = coverage(&bare, Some("c")).expect("one");
    assert_eq!((found.photos, found.reach, found.lacks), (0, 0.0, vec![CoverageLack::Photos]));
    assert!(coverage(&bare, Some("x")).is_err());
}
