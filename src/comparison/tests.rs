//! Tests of the comparison on simulated results.

use nalgebra::Vector3;

use super::*;
use crate::adjustment::{AdjustedPhoto, AdjustedPoint};
use crate::initial::robust::{generator, uniform};
use crate::project::{Camera, Datum, Distance, Interior, Observation, Photo, Point, Sigma};
use crate::rotation::object_to_camera;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

const SIGMA: f64 = 0.02;

/// Points of one cloud with standard errors, a photo, a camera.
fn network(kind: DatumKind, seed: u64) -> (Project, Adjustment) {
    let mut random = generator(seed);
    let points: Vec<_> = (0..30)
        .map(|k| AdjustedPoint {
            id: format!("{k}"),
            xyz: std::array::from_fn(|axis| (uniform(&mut random) - 0.5) * [800.0, 600.0, 200.0][axis]),
            sigma: Some([SIGMA, SIGMA, 2.0 * SIGMA]),
            ..AdjustedPoint::default()
        })
        .collect();
    let given = points.iter().take(4).map(|p| Point {
        id: p.id.clone(),
        role: if kind == DatumKind::Control { Role::Control } else { Role::Tie },
        xyz: Some(p.xyz),
        ..Point::default()
    });
    let project = Project {
        unit: "mm".into(),
        points: given.collect(),
        datum: Datum { kind, points: None },
        ..Project::default()
    };
    let camera =
        Camera { free: vec![Parameter::C, Parameter::K1], ..Camera::new("k", 4000, 3000, Interior::brown(20.0)) };
    let adjusted = AdjustedCamera {
        camera,
        photo: None,
        sigma: [(Parameter::C, 0.01), (Parameter::K1, 1e-5)].into(),
        significance: BTreeMap::new(),
        correlation: Default::default(),
    };
    let photo = AdjustedPhoto {
        id: "a".into(),
        position: [0.0, 0.0, 1500.0],
        sigma_position: Some([0.1; 3]),
        ..AdjustedPhoto::default()
    };
    let adjustment =
        Adjustment { points, photos: vec![photo], cameras: vec![adjusted], sigma0: Some(1.0), ..Adjustment::default() };
    (project, adjustment)
}

/// The same network in another system.
fn turned(adjustment: &Adjustment, scale: f64) -> Adjustment {
    let system = Similarity {
        scale,
        rotation: object_to_camera([0.3, -0.4, 1.9]),
        source_centroid: Vector3::zeros(),
        target_centroid: Vector3::new(1e4, -2e3, 50.0),
    };
    let mut other = adjustment.clone();
    for point in &mut other.points {
        point.xyz = system.point(&Vector3::from(point.xyz)).into();
        point.sigma = point.sigma.map(|s| s.map(|s| s * scale));
    }
    for photo in &mut other.photos {
        photo.position = system.point(&Vector3::from(photo.position)).into();
        photo.sigma_position = photo.sigma_position.map(|s| s.map(|s| s * scale));
    }
    other
}

#[test]
fn a_result_beside_itself_has_not_moved() {
    for kind in [DatumKind::Control, DatumKind::Free, DatumKind::Minimal] {
        let (project, adjustment) = network(kind, 1);
        let same = compare((&project, &adjustment), (&project, &adjustment));
        assert_eq!(same.alignment == Alignment::Same, kind == DatumKind::Control);
        assert!(same.points.iter().chain(&same.photos).all(|m| m.length() < 1e-9));
        assert_eq!((same.points.len(), same.photos.len(), same.beyond), (30, 1, 0));
        assert!(same.gone.is_empty() && same.new.is_empty() && same.rms.unwrap() < 1e-9);
        assert!(same.parameters.iter().all(|p| p.ratio == Some(0.0)) && same.parameters.len() == 2);
    }
}

#[test]
fn a_point_that_moved_is_told_whatever_the_systems_are() {
    let (project, adjustment) = network(DatumKind::Free, 2);
    let mut after = turned(&adjustment, 2.5);
    let step = Vector3::new(0.0, 0.0, 20.0 * SIGMA * 2.5);
    after.points[7].xyz = (Vector3::from(after.points[7].xyz) + step).into();
    let found = compare((&project, &adjustment), (&project, &after));
    let Alignment::Fitted { points, scale: Some(scale) } = found.alignment else { panic!("{:?}", found.alignment) };
    assert!((scale - 2.5).abs() < 1e-9 && points == 29);
    let moved: Vec<_> = found.points.iter().filter(|m| m.length() > 1e-6).collect();
    assert_eq!(moved.iter().map(|m| m.id.as_str()).collect::<Vec<_>>(), ["7"]);
    assert!((Vector3::from(moved[0].difference) - step).norm() < 1e-7);
    // The larger of both standard errors, the earlier ones in the later system: between 1 and 2 of the plain ones.
    let ratio = moved[0].ratio.unwrap();
    assert!((20.0 / 2.0 - 1e-6..=20.0 + 1e-6).contains(&ratio), "{ratio}");
    assert_eq!(found.beyond, 1);
    assert!(found.photos[0].length() < 1e-7);
}

#[test]
fn a_scale_of_its_own_is_compared_and_not_fitted_away() {
    let (mut project, adjustment) = network(DatumKind::Free, 3);
    project.distances.push(Distance { from: "0".into(), to: "1".into(), length: 1.0, sigma: 0.1, check: false });
    let after = turned(&adjustment, 1.01);
    let found = compare((&project, &adjustment), (&project, &after));
    // Another length of the same bar: all points differ, by the ratio of the scales.
    let Alignment::Unlike { common: 30, agreeing, scale: Some(scale), mirrored: false, .. } = found.alignment else {
        panic!("{:?}", found.alignment)
    };
    assert!(agreeing < 15 && (scale - 1.01).abs() < 1e-9 && found.points.is_empty() && found.rms.is_none());
    // Within the standard errors of most it is a difference like others.
    let found = compare((&project, &adjustment), (&project, &turned(&adjustment, 1.0001)));
    assert!(matches!(found.alignment, Alignment::Fitted { scale: None, .. }), "{:?}", found.alignment);
    assert!(found.rms.unwrap() > 0.01);
    // A distance that is compared only, or whose ends are not in the network, gives none.
    project.distances[0].check = true;
    assert!(compare((&project, &adjustment), (&project, &after)).rms.unwrap() < 1e-7);
    project.distances[0] = Distance { check: false, to: "nowhere".into(), ..project.distances[0].clone() };
    assert!(compare((&project, &adjustment), (&project, &after)).rms.unwrap() < 1e-7);
}

/// Networks with noise: of the same object in another system they are compared, whatever part of up to three tenths moved; renumbered,
/// mirrored or of another object they are not.
#[test]
fn what_has_no_part_that_stayed_is_not_laid_upon_the_other() {
    let mut random = generator(71);
    let mut noise = crate::noise::Noise::new(71, 0);
    for seed in 0..120 {
        let (mut project, mut before) = network(DatumKind::Free, 100 + seed);
        let flat = [1.0, 0.1, 0.01][(uniform(&mut random) * 3.0) as usize];
        before.points.iter_mut().for_each(|p| p.xyz[2] *= flat);
        before.points.truncate(8 + (uniform(&mut random) * 22.0) as usize);
        let n = before.points.len();
        let scaled = uniform(&mut random) < 0.5;
        if scaled {
            project.distances.push(Distance {
                from: "0".into(),
                to: "1".into(),
                length: 1.0,
                sigma: 0.1,
                check: false,
            });
        }
        let mut again = before.clone();
        for p in &mut again.points {
            (0..3).for_each(|axis| p.xyz[axis] += SIGMA * noise.normal());
        }
        let scale = if scaled { 1.0 } else { 0.2 + 4.0 * uniform(&mut random) };
        let system = |a: &Adjustment| {
            let mut other = turned(a, scale);
            other.points.iter_mut().for_each(|p| p.sigma = p.sigma.map(|s| s.map(|s| s * scale)));
            other
        };
        let same = compare((&project, &before), (&project, &system(&again)));
        assert!(matches!(same.alignment, Alignment::Fitted { .. }), "{seed}: {:?}", same.alignment);
        let mut moving = again.clone();
        let some = (uniform(&mut random) * 0.3 * n as f64) as usize;
        moving.points[..some].iter_mut().for_each(|p| p.xyz[0] += 50.0);
        let found = compare((&project, &before), (&project, &system(&moving)));
        assert!(matches!(found.alignment, Alignment::Fitted { .. }), "{seed}, {some} of {n}: {:?}", found.alignment);
        assert!(found.beyond >= some);

        let unlike = |other: &Adjustment| {
            let found = compare((&project, &before), (&project, &system(other)));
            let Alignment::Unlike { common, agreeing, ratio, mirrored, .. } = found.alignment else {
                panic!("{seed}, {n}: {:?}", found.alignment)
            };
            assert!(common == n && agreeing < n && ratio.is_some_and(|ratio| ratio > 4.0));
            assert!(found.points.is_empty() && found.photos.is_empty() && found.rms.is_none() && found.beyond == 0);
            mirrored
        };
        let mut renumbered = again.clone();
        let shift = 1 + (uniform(&mut random) * (n - 1) as f64) as usize;
        (0..n).for_each(|k| renumbered.points[k].xyz = again.points[(k + shift) % n].xyz);
        assert!(!unlike(&renumbered));
        // An object that is flat within its standard errors equals its mirror image.
        if flat > 0.05 {
            let mut mirrored = again.clone();
            let axis = (uniform(&mut random) * 3.0) as usize;
            mirrored.points.iter_mut().for_each(|p| p.xyz[axis] = -p.xyz[axis]);
            assert!(unlike(&mirrored), "{seed}");
        }
        let mut other = network(DatumKind::Free, 5000 + seed).1;
        other.points.truncate(n);
        assert!(!unlike(&other));
        // Without standard errors the extent decides.
        let mut bare = [before.clone(), renumbered, again];
        bare.iter_mut().flat_map(|a| &mut a.points).for_each(|p| p.sigma = None);
        let of = |later: &Adjustment| compare((&project, &bare[0]), (&project, later)).alignment;
        assert!(matches!(of(&bare[1]), Alignment::Unlike { ratio: None, .. }));
        assert!(matches!(of(&bare[2]), Alignment::Fitted { .. }));
    }
}

#[test]
fn under_control_the_system_is_that_of_points_that_kept_their_coordinates() {
    let (project, adjustment) = network(DatumKind::Control, 4);
    let mut after = adjustment.clone();
    after.points.iter_mut().for_each(|p| p.xyz[0] += 5.0 * SIGMA);
    let mut others = project.clone();
    others.points[0].xyz = Some([1.0, 2.0, 3.0]);
    let found = compare((&project, &adjustment), (&others, &after));
    assert_eq!((found.alignment, found.beyond), (Alignment::Same, 30));
    assert!(found.points.iter().all(|m| (m.ratio.unwrap() - 5.0).abs() < 1e-6));
    others.points[1].xyz = Some([9.0, 2.0, 3.0]);
    let found = compare((&project, &adjustment), (&others, &after));
    assert!(matches!(found.alignment, Alignment::Fitted { points: 30, scale: None }));
    assert_eq!(found.beyond, 0);
}

#[test]
fn what_cannot_be_compared_is_left_out_and_said() {
    let (project, adjustment) = network(DatumKind::Free, 5);
    let mut few = adjustment.clone();
    few.points.truncate(2);
    let found = compare((&project, &adjustment), (&project, &few));
    assert_eq!((&found.alignment, found.rms, found.gone.len()), (&Alignment::Apart { common: 2 }, None, 28));
    let mut line = adjustment.clone();
    line.points.iter_mut().enumerate().for_each(|(k, p)| p.xyz = [k as f64, 2.0 * k as f64, 0.0]);
    let found = compare((&project, &line), (&project, &line));
    assert_eq!(found.alignment, Alignment::Apart { common: 30 });
    let metres = Project { unit: "m".into(), ..project.clone() };
    let found = compare((&project, &adjustment), (&metres, &adjustment));
    assert_eq!(found.alignment, Alignment::Units { before: "mm".into(), after: "m".into() });
    assert!(found.points.is_empty() && found.photos.is_empty() && found.parameters.len() == 2);

    let mut other = adjustment.clone();
    other.cameras[0].camera.pixel_pitch = Some([0.005; 2]);
    other.points[0].id = "new".into();
    other.points[1].sigma = None;
    other.points[2].sigma = Some([0.0; 3]);
    let mut plain = adjustment.clone();
    plain.points[1].sigma = None;
    plain.points[2].sigma = Some([0.0; 3]);
    let found = compare((&project, &plain), (&project, &other));
    assert_eq!((found.unlike_cameras, found.parameters.len()), (vec!["k".to_owned()], 0));
    assert_eq!((found.gone, found.new), (vec!["0".to_owned()], vec!["new".to_owned()]));
    assert_eq!([0, 1].map(|k| found.points[k].ratio), [None, None]);
}

#[test]
fn parameters_are_compared_by_the_larger_standard_error() {
    let (project, before) = network(DatumKind::Free, 6);
    let mut after = before.clone();
    let camera = &mut after.cameras[0];
    camera.camera.interior.set(Parameter::C, 20.05);
    camera.sigma.insert(Parameter::C, 0.005);
    camera.camera.interior.set(Parameter::X0, 0.3);
    let found = compare((&project, &before), (&project, &after)).parameters;
    let of = |p| found.iter().find(|c| c.parameter == p).unwrap();
    assert!((of(Parameter::C).ratio.unwrap() - 5.0).abs() < 1e-9);
    // It was held both times, at two values.
    assert_eq!((of(Parameter::X0).sigma, of(Parameter::X0).ratio, found.len()), (None, None, 3));
}

/// A project with an observation in one photo of this file.
fn photographed(project: &Project, sha256: &str) -> Project {
    let photo =
        Photo { id: "a".into(), file: "a.jpg".into(), sha256: sha256.into(), enabled: true, ..Photo::default() };
    let observation = Observation {
        photo: "a".into(),
        point: "0".into(),
        u: 1.0,
        v: 1.0,
        sigma: Sigma::One(0.1),
        enabled: true,
        target: None,
    };
    Project { photos: vec![photo].into(), observations: vec![observation].into(), ..project.clone() }
}

#[test]
fn unmoved_points_of_independent_results_exceed_the_limit_at_its_own_rate() {
    let (project, adjustment) = network(DatumKind::Control, 5);
    let (before, after) = (photographed(&project, "aa"), photographed(&project, "bb"));
    let limit = adjustment.criteria.w;
    let alpha = Fisher::new(1, None).tails(limit * limit)[1];
    let mut random = generator(8);
    let mut normal = move || {
        let (u, v) = (uniform(&mut random), uniform(&mut random));
        (-2.0 * (1.0 - u).ln()).sqrt() * (std::f64::consts::TAU * v).cos()
    };
    let (mut beyond, mut by_axis, mut count) = (0, 0, 0);
    for _ in 0..1000 {
        let mut both = [adjustment.clone(), adjustment.clone()];
        for found in &mut both {
            for point in &mut found.points {
                let a = Matrix3::from_fn(|i, j| if i >= j { SIGMA * (0.3 + normal().abs()) } else { 0.0 });
                let c = a * a.transpose();
                let e = a * Vector3::from_fn(|_, _| normal());
                point.xyz = std::array::from_fn(|k| point.xyz[k] + e[k]);
                point.sigma = Some(std::array::from_fn(|k| c[(k, k)].sqrt()));
                point.covariance = Some([c[(0, 0)], c[(0, 1)], c[(0, 2)], c[(1, 1)], c[(1, 2)], c[(2, 2)]]);
            }
        }
        let found = compare((&before, &both[0]), (&after, &both[1]));
        assert!(found.independent && found.alignment == Alignment::Same);
        beyond += found.beyond;
        count += found.points.len();
        let shared = compare((&before, &both[0]), (&before, &both[1]));
        assert!(!shared.independent && shared.points.iter().all(|m| m.statistic.is_none()));
        by_axis += shared.beyond;
    }
    // Four standard deviations of the binomial distribution.
    let (expected, spread) = (alpha * count as f64, (alpha * count as f64).sqrt());
    assert!((beyond as f64 - expected).abs() < 4.0 * spread, "{beyond} of {count}, expected {expected}");
    // The result for such points with the larger standard error of each axis.
    assert!(by_axis as f64 > 5.0 * expected, "{by_axis}");
}

#[test]
fn what_is_shared_is_no_independent_result() {
    let (project, adjustment) = network(DatumKind::Free, 5);
    let independent = |a: &Project, b: &Project| compare((a, &adjustment), (b, &adjustment)).independent;
    let (one, other) = (photographed(&project, "aa"), photographed(&project, "bb"));
    assert!(independent(&one, &other) && !independent(&one, &one));
    // Without a digest the name decides; without observations nothing is known.
    assert!(!independent(&photographed(&project, ""), &other) && !independent(&project, &other));
    let bar = Distance { from: "0".into(), to: "1".into(), length: 1.0, sigma: 0.1, check: false };
    let with = |p: &Project, length: f64| Project { distances: vec![Distance { length, ..bar.clone() }], ..p.clone() };
    assert!(!independent(&with(&one, 1.0), &with(&other, 1.0)) && independent(&with(&one, 1.0), &with(&other, 1.1)));
    let weighted = |p: &Project| {
        let mut p = p.clone();
        p.datum.kind = DatumKind::Control;
        p.points[0] = Point { role: Role::Control, sigma: Some([Some(0.1); 3]), ..p.points[0].clone() };
        p
    };
    assert!(!independent(&weighted(&one), &weighted(&other)));
}
