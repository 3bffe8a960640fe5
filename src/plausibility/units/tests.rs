//! Random networks with lengths in two units.

use super::*;
use crate::noise::Noise;
use crate::project::Interior;
use crate::project::{Camera, DatumKind, Distance, Observation, Photo, Point, Sigma};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

/// An oriented network in millimetres with control points and `bars` distances that fit to two thousandths.
fn network(seed: u64, control: usize, bars: usize) -> Project {
    let mut noise = Noise::new(seed, 1);
    let size = 500.0 * (1.0 + 5.0 * noise.normal().abs());
    let camera = Camera { pixel_pitch: Some([0.005; 2]), ..Camera::new("k", 6000, 4000, Interior::brown(28.0)) };
    let mut project = Project { cameras: vec![camera], ..Project::default() };
    for k in 0..20 {
        let xyz = [0, 1, 2].map(|_| size * noise.normal());
        let role = if k < control { Role::Control } else { Role::Tie };
        project.points.push(Point { id: k.to_string(), role, xyz: Some(xyz), ..Point::default() });
    }
    for k in 0..3 {
        let id = format!("f{k}");
        let position = Some([size * f64::from(k), 0.0, 4.0 * size]);
        project.photos.push(Photo {
            id: id.clone(),
            camera: "k".into(),
            position,
            rotation: Some([0.0; 3]),
            enabled: true,
            ..Photo::default()
        });
        for point in &project.points {
            let (photo, point, sigma) = (id.clone(), point.id.clone(), Sigma::One(0.1));
            project.observations.push(Observation { photo, point, u: 1.0, v: 1.0, sigma, enabled: true, target: None });
        }
    }
    for k in 0..bars {
        let [from, to] = [19 - 2 * k, 18 - 2 * k];
        let [a, b] = [from, to].map(|k| Vector3::from(project.points[k].xyz.expect("a place")));
        let length = (a - b).norm() * (1.0 + 0.002 * noise.normal());
        project.distances.push(Distance {
            from: from.to_string(),
            to: to.to_string(),
            length,
            sigma: 0.1,
            check: false,
        });
    }
    if control > 0 {
        project.datum.kind = DatumKind::Control;
    }
    project
}

#[test]
fn lengths_of_one_unit_are_never_asked_about() {
    for seed in 0..200 {
        let mut project = network(seed, if seed % 2 == 0 { 5 } else { 0 }, 1 + (seed % 5) as usize);
        if seed % 3 == 0 {
            project.points.iter_mut().for_each(|p| p.diameter = Some(20.0));
        }
        assert_eq!(of_lengths(&project), [], "seed {seed}");
        // A misspelt unit is not accepted.
        project.distances[0].length *= [1.5, 2.0, 7.0, 0.6][(seed % 4) as usize];
        assert!(of_lengths(&project).is_empty() || project.distances.len() == 1, "seed {seed}");
    }
}

#[test]
fn a_distance_in_another_unit_is_named() {
    let ratios = [1000.0, 0.001, 25.4, 1.0 / 25.4, 304.8, 10.0, 12.0, 1.0 / 12.0, 100.0, 0.01, 0.1];
    for seed in 0..200 {
        let (control, bars) = (if seed % 2 == 0 { 5 } else { 0 }, 3 + (seed % 4) as usize);
        let mut project = network(seed, control, bars);
        let ratio: f64 = ratios[(seed % 11) as usize];
        project.distances[1].length *= ratio;
        let ends = (project.distances[1].from.clone(), project.distances[1].to.clone());
        let [found] = &of_lengths(&project)[..] else { panic!("seed {seed}: {:?}", of_lengths(&project)) };
        assert_eq!((found.of, &found.distances), (UnitOf::Distance, &vec![ends]), "seed {seed}");
        assert!((found.nearest / ratio - 1.0).abs() < 1e-9 && (found.ratio / ratio - 1.0).abs() < 0.03, "{found:?}");
    }
}

#[test]
fn control_in_metres_against_distances_in_millimetres_is_the_control() {
    for seed in 0..100 {
        let mut project = network(seed, 5, 2);
        // The orientation is in the system of the control points.
        let metres = |xyz: [f64; 3]| xyz.map(|x| 0.001 * x);
        project.points.iter_mut().for_each(|p| p.xyz = p.xyz.map(metres));
        project.photos.iter_mut().for_each(|p| p.position = p.position.map(metres));
        let [found] = &of_lengths(&project)[..] else { panic!("seed {seed}") };
        assert_eq!((found.of, found.nearest), (UnitOf::Control, 0.001), "seed {seed}: {found:?}");
        // Without distances, the diameters of the targets decide.
        project.distances.clear();
        assert_eq!(of_lengths(&project), []);
        project.points.iter_mut().for_each(|p| p.diameter = Some(15.0));
        let [found] = &of_lengths(&project)[..] else { panic!("seed {seed}") };
        assert_eq!((found.of, found.nearest), (UnitOf::Control, 0.001), "seed {seed}: {found:?}");
    }
}

#[test]
fn ratios_of_units_are_distinguished_from_others() {
    for (ratio, wanted) in [(1010.0, Some(1000.0)), (25.0, Some(25.4)), (1.0, None), (2.0, None), (12.1, Some(12.0))] {
        let found = nearest(ratio, MEASURED);
        assert_eq!(found.is_some(), wanted.is_some(), "{ratio}");
        assert!(found.zip(wanted).is_none_or(|(a, b): (f64, f64)| (a / b - 1.0).abs() < 1e-9), "{ratio} {found:?}");
    }
    assert!(of_camera("k", 24.0, 26.0).is_none());
    assert_eq!(of_camera("k", 0.024, 24.3).expect("metres").nearest, 0.001);
}
