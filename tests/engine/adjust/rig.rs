//! Cameras fixed to each other: the relative pose with its standard errors against simulations, its equations against plain ones.

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Vector3};
use sightline::adjust::{adjust, linearise, normal_equations, start_adjustment};
use sightline::adjustment::{AdjustOptions, Adjustment, RelativePose, StatisticsChoice, Termination};
use sightline::camera::pixel_from_camera_point;
use sightline::noise::Noise;
use sightline::project::{Camera, Datum, DatumKind, Interior, Project, Rig, Role, Sigma};
use sightline::rotation;
use sightline_plan::network::{Bar, Network, NetworkPoint, Station, simulate};

/// Pose of the second camera relative to the first one: attitude and place in its axes.
struct Truth {
    rotation: Matrix3<f64>,
    base: Vector3<f64>,
}

/// Two or three cameras on a bar walk round an object of half a metre; the mount gives by the standard errors of the rig.
fn walk(seed: u64, cameras: usize, datum: DatumKind) -> (Project, Vec<Truth>) {
    let mut noise = Noise::new(seed, 9);
    let mut three = |size: f64| Vector3::from_fn(|_, _| noise.normal() * size);
    let (sigma_position, sigma_rotation) = (0.02, 2e-5);
    let truths: Vec<Truth> = (1..cameras)
        .map(|k| Truth {
            rotation: Rotation3::new(Vector3::new(0.0, -0.25 * k as f64, 0.0) + three(0.05)).into_inner(),
            base: Vector3::new(350.0 * k as f64, 0.0, 0.0) + three(20.0),
        })
        .collect();
    let points = (0..8).map(|k| NetworkPoint {
        id: k.to_string(),
        xyz: (three(170.0)).into(),
        role: if datum == DatumKind::Control && k < 5 { Role::Control } else { Role::Tie },
        sigma: (datum == DatumKind::Control && k < 5).then_some([Some(0.05); 3]),
        ..NetworkPoint::default()
    });
    let points: Vec<NetworkPoint> = points.collect();
    let (mut stations, mut exposures) = (Vec::new(), Vec::new());
    for e in 0..7 {
        let turn = f64::from(e) * 0.9;
        let place = [1400.0 * turn.cos(), 1400.0 * turn.sin(), 500.0 + 150.0 * f64::from(e % 3)];
        let first = Station::aimed(format!("c0-{e}"), "c0", place, three(40.0).into(), turn * 2.0);
        let pose = first.pose().expect("an aim");
        let m: Matrix3<f64> = pose.object_to_camera;
        let mut together = vec![Some(first.id.clone())];
        stations.push(first);
        for (k, truth) in truths.iter().enumerate() {
            let off = rotation::turned(&(truth.rotation * m), three(sigma_rotation));
            let id = format!("c{}-{e}", k + 1);
            let position = Vector3::from(place) + m.transpose() * (truth.base + three(sigma_position));
            stations.push(Station {
                id: id.clone(),
                camera: format!("c{}", k + 1),
                position: position.into(),
                rotation: Some(rotation::angles(&off)),
                look_at: None,
                roll: 0.0,
            });
            together.push(Some(id));
        }
        exposures.push(together);
    }
    let distances =
        if datum == DatumKind::Free { vec![Bar { from: "0".into(), to: "1".into(), sigma: 0.02 }] } else { Vec::new() };
    let camera = |k: usize| Camera {
        pixel_pitch: Some([0.005; 2]),
        ..Camera::new(format!("c{k}"), 2400, 1800, Interior::brown(10.0))
    };
    let mut project = simulate(&Network {
        cameras: (0..cameras).map(camera).collect(),
        stations,
        points,
        distances,
        datum: Datum { kind: datum, points: None },
        sigma: Sigma::One(0.15),
        seed,
        ..Network::default()
    })
    .expect("a network");
    project.rig = Some(Box::new(Rig { exposures, sigma_position, sigma_rotation }));
    (project, truths)
}

fn adjusted(project: &Project) -> Adjustment {
    let options = AdjustOptions { statistics: StatisticsChoice::Precision, ..AdjustOptions::default() };
    let result = adjust(project, &options, &mut |_| true).expect("a result");
    assert_eq!(result.termination, Termination::Converged);
    result
}

/// Squared errors of a relative pose over its standard errors: rotation, then position.
fn ratios(found: &RelativePose, truth: &Truth) -> [f64; 6] {
    let turn = rotation::object_to_camera(found.rotation) * truth.rotation.transpose();
    let turn = Rotation3::from_matrix_unchecked(turn).scaled_axis();
    let shift = Vector3::from(found.position) - truth.base;
    let (by_turn, by_shift) = (found.sigma_rotation.expect("stated"), found.sigma_position.expect("stated"));
    std::array::from_fn(|k| match k {
        0..3 => (turn[k] / by_turn[k]).powi(2),
        _ => (shift[k - 3] / by_shift[k - 3]).powi(2),
    })
}

#[test]
fn relative_poses_scatter_as_their_standard_errors_say_and_coordinates_gain() {
    for (datum, cameras) in [(DatumKind::Control, 2), (DatumKind::Free, 3)] {
        let draws = 60;
        let (mut squares, mut count, mut sigma0) = ([0.0; 6], 0.0, 0.0);
        let (mut with, mut without, mut stated, mut scatter) = (0.0, 0.0, 0.0, [0.0; 2]);
        for seed in 0..draws {
            let (project, truths) = walk(seed, cameras, datum);
            let result = adjusted(&project);
            assert_eq!(result.rig.len(), cameras - 1);
            for (found, truth) in result.rig.iter().zip(&truths) {
                squares.iter_mut().zip(ratios(found, truth)).for_each(|(sum, square)| *sum += square);
                count += 1.0;
                assert_eq!((found.exposures.len(), found.relative_to.as_str()), (7, "c0"));
                assert!((found.base - truth.base.norm()).abs() < 5.0 * found.sigma_base.expect("stated"));
            }
            sigma0 += result.sigma0.expect("redundancy") / draws as f64;
            let bare = adjusted(&Project { rig: None, ..project.clone() });
            assert_eq!(result.redundancy, bare.redundancy + 6 * 6 * (cameras - 1));
            // What the same photos say without the rig: relative poses by a mount that gives a lot.
            let mut loose = project.clone();
            let rig = loose.rig.as_mut().expect("a rig");
            (rig.sigma_position, rig.sigma_rotation) = (1e4, 10.0);
            let loose = adjusted(&loose);
            for (sum, rig) in scatter.iter_mut().zip([&loose.rig, &result.rig]) {
                *sum += rig[0].scatter_position.expect("several") / draws as f64;
            }
            let off = |result: &Adjustment| -> f64 {
                let pairs = result.points.iter().zip(&project.points);
                pairs.map(|(a, b)| (Vector3::from(a.xyz) - Vector3::from(b.xyz.expect("true"))).norm_squared()).sum()
            };
            if datum == DatumKind::Free {
                (with, without) = (with + off(&result), without + off(&bare));
            }
            let variance = |result: &Adjustment| -> f64 {
                let sigmas = result.points.iter().filter_map(|p| p.sigma);
                sigmas.flatten().map(|s| s * s).sum()
            };
            stated += (variance(&result) / variance(&bare)).sqrt() / draws as f64;
        }
        let rms = squares.map(|sum| (sum / count).sqrt());
        // The standard error of such a ratio is 0.09 of 60 draws, 0.065 of 120.
        assert!(rms.iter().all(|ratio| (0.7..1.3).contains(ratio)), "{datum:?} {rms:?}");
        assert!((sigma0 - 1.0).abs() < 0.02, "{sigma0}");
        // Standard errors of the coordinates are smaller, and so are their errors.
        assert!(stated < 1.0, "{stated}");
        assert!(datum != DatumKind::Free || with < without, "{with} {without}");
        // Photos alone leave relative poses that scatter by more than the mount gives.
        assert!(scatter[0] > 2.0 * scatter[1], "{scatter:?}");
        println!(
            "{datum:?}: errors over sigmas {rms:?}, sigma0 {sigma0:.3}, coordinates' sigmas {stated:.3} of those without, scatter {scatter:?}"
        );
    }
}

#[test]
fn its_equations_are_those_of_dense_matrices() {
    let options = AdjustOptions { statistics: StatisticsChoice::Precision, ..AdjustOptions::default() };
    for (datum, cameras) in [(DatumKind::Control, 2), (DatumKind::Free, 3), (DatumKind::Minimal, 2)] {
        let (mut project, _) = walk(3, cameras, datum);
        if datum == DatumKind::Minimal {
            project.distances = walk(3, cameras, DatumKind::Free).0.distances;
        }
        let system = linearise(&project, &options).expect("a sound document");
        let normal = normal_equations(&project, &options).expect("a sound document");
        let (a, p) = (system.a.dense(), DMatrix::from_diagonal(&DVector::from_row_slice(&system.p)));
        let n = a.transpose() * &p * &a;
        let b = a.transpose() * &p * DVector::from_row_slice(&system.l);
        let size = DVector::from_fn(n.nrows(), |i, _| n[(i, i)].sqrt());
        let found = normal.n.dense();
        for i in 0..n.nrows() {
            assert!((normal.b[i] - b[i]).abs() <= 1e-9 * size[i] * b.component_div(&size).norm(), "{i}");
            assert!((0..n.ncols()).all(|j| (found[(i, j)] - n[(i, j)]).abs() <= 1e-9 * size[i] * size[j]), "{i}");
        }
        if datum == DatumKind::Control {
            let scaled = DMatrix::from_fn(n.nrows(), n.ncols(), |i, j| n[(i, j)] / size[i] / size[j]);
            let x = scaled.cholesky().expect("regular").solve(&b.component_div(&size)).component_div(&size);
            let mut adjuster = start_adjustment(&project, &options).expect("a sound document");
            let step = DVector::from_vec(adjuster.step().expect("a step").corrections.clone());
            let off = (&step - &x).component_mul(&size).norm() / x.component_mul(&size).norm();
            assert!(off < 1e-6, "{off}");
        }
    }
}

#[test]
fn a_rigid_mount_and_missing_photos_are_no_trouble() {
    let (project, _) = walk(5, 3, DatumKind::Free);
    let mut rigid = project.clone();
    let rig = rigid.rig.as_mut().expect("a rig");
    (rig.sigma_position, rig.sigma_rotation) = (1e-5, 1e-8);
    let result = adjusted(&rigid);
    assert!(result.rig[0].scatter_position.expect("several") < 1e-5, "{:?}", result.rig[0].scatter_position);
    let report = sightline_report::report(&rigid, Some(&result)).expect("a report").html();
    assert!(report.contains("Cameras fixed to each other"));
    // A camera without a photo at an exposure, a photo that is not used, an exposure without the first camera.
    let mut some = project.clone();
    some.photos.iter_mut().filter(|photo| photo.id == "c2-3").for_each(|photo| photo.enabled = false);
    let rig = some.rig.as_mut().expect("a rig");
    rig.exposures[0][1] = None;
    rig.exposures[1][0] = None;
    let result = adjusted(&some);
    assert_eq!(result.rig.iter().map(|pose| pose.exposures.len()).collect::<Vec<_>>(), [5, 5]);
    // One exposure has a relative pose with a standard error, and nothing to compare it with or to test.
    let mut one = project;
    one.rig.as_mut().expect("a rig").exposures.truncate(1);
    let result = adjusted(&one);
    assert!(result.rig[0].sigma_base.is_some() && result.rig[0].scatter_position.is_none());
    assert_eq!((result.rig[0].exposures[0].p_value, result.rig[0].exposures[0].outlier), (None, false));
}

#[test]
fn a_moved_exposure_is_named_and_clean_ones_are_not() {
    let options = AdjustOptions { statistics: StatisticsChoice::Full, ..AdjustOptions::default() };
    let full = |project: &Project| {
        let result = adjust(project, &options, &mut |_| true).expect("a result");
        assert_eq!(result.termination, Termination::Converged);
        result
    };
    for (datum, cameras) in [(DatumKind::Control, 2), (DatumKind::Free, 3)] {
        let draws = 60;
        let (mut sum, mut count, mut below, mut accused) = (0.0, 0.0, 0.0, 0);
        let (mut named, mut elsewhere) = (0, 0);
        for seed in 0..draws {
            let (project, _) = walk(seed, cameras, datum);
            let clean = full(&project);
            for off in clean.rig.iter().flat_map(|pose| &pose.exposures) {
                let (statistic, redundancy) = (off.statistic.expect("tested"), off.redundancy.expect("tested"));
                // A component that the photos hardly check is not tested.
                assert!(matches!(off.degrees, Some(4..=6)) && redundancy > 0.0 && redundancy < 6.0, "{off:?}");
                sum += statistic;
                count += 1.0;
                below += f64::from(off.p_value.expect("tested") < 0.1);
                accused += usize::from(off.outlier);
            }
            // At one exposure the last camera is shifted in its mount by about twenty of its standard errors: the photos check a third of it.
            let moved = seed as usize % 7;
            let id = format!("c{}-{moved}", cameras - 1);
            let result = full(&shifted(&project, &id, [0.8, -0.6, 0.4]));
            for pose in &result.rig {
                for off in pose.exposures.iter().filter(|off| off.outlier) {
                    let right = off.exposure == moved && pose.column == cameras - 1;
                    named += usize::from(right);
                    elsewhere += usize::from(!right);
                }
            }
        }
        let (mean, share) = (sum / count, below / count);
        println!(
            "{datum:?}: F {mean:.3}, {share:.3} below 0.1, {accused} of {count} accused; {named} of {draws} named, {elsewhere} others"
        );
        // Of F with 6 and r - 6 degrees of freedom the mean is 1.03 here; deviations of one mount are correlated.
        assert!((0.9..1.15).contains(&mean), "{mean}");
        assert!((share - 0.1).abs() < 4.0 * f64::sqrt(0.09 / count), "{share}");
        assert!(accused <= 4, "{accused}");
        assert!(named >= draws as usize * 9 / 10 && elsewhere <= 3, "{named} {elsewhere}");
    }
}

/// The network with the photo taken from elsewhere: its measurements are moved by what the shift of its projection centre does.
fn shifted(project: &Project, photo: &str, by: [f64; 3]) -> Project {
    let mut moved = project.clone();
    let pose = project.photos.iter().find(|p| p.id == photo).expect("a photo");
    let camera = project.cameras.iter().find(|c| c.id == pose.camera).expect("a camera");
    let m = rotation::object_to_camera(pose.rotation.expect("oriented"));
    let centre = Vector3::from(pose.position.expect("oriented"));
    for seen in moved.observations.iter_mut().filter(|seen| seen.photo == photo) {
        let xyz = project.points.iter().find(|p| p.id == seen.point).and_then(|p| p.xyz).expect("coordinates");
        let pixel = |from: Vector3<f64>| pixel_from_camera_point(camera, m * (Vector3::from(xyz) - from));
        let (before, after) = (pixel(centre).expect("in front"), pixel(centre + Vector3::from(by)).expect("in front"));
        seen.u += after[0] - before[0];
        seen.v += after[1] - before[1];
    }
    moved
}

#[test]
fn orientation_finds_the_way_with_a_rig_in_the_document() {
    let (mut project, _) = walk(8, 2, DatumKind::Control);
    for photo in project.photos.iter_mut() {
        (photo.position, photo.rotation) = (None, None);
    }
    for point in project.points.iter_mut().filter(|point| point.role == Role::Tie) {
        point.xyz = None;
    }
    let oriented = sightline::orient::orient(&project).expect("oriented").project;
    assert_eq!(oriented.rig, project.rig);
    assert_eq!(adjusted(&oriented).rig[0].exposures.len(), 7);
}
