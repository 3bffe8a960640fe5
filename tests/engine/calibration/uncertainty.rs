//! Projection uncertainty against simulation: the stated standard error of a predicted pixel is the scatter of many calibrations.

use nalgebra::Vector3;
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment, StatisticsChoice};
use sightline::calibration::{
    DifferenceOptions, FitRegion, MotionReference, ProjectionUncertainty, UncertaintyOptions, compare_cameras,
    projection_uncertainty,
};
use sightline::camera::{pixel_from_camera_point, ray_from_pixel};
use sightline::project::{Camera, CameraModel, Interior, Project};
use sightline::rotation::object_to_camera;

use crate::adjust::models::project;
use crate::support::extent;

const GRID: [usize; 2] = [7, 5];

fn calibrated(project: &Project) -> Adjustment {
    let options = AdjustOptions { statistics: StatisticsChoice::Precision, ..AdjustOptions::default() };
    adjust(project, &options, &mut |_| true).expect("solvable")
}

/// Sums of squares of a node's two coordinates over many calibrations, and how many it was seen in.
type Sums = Vec<Vec<([f64; 3], usize)>>;

fn add(sums: &mut Sums, j: usize, i: usize, d: [f64; 2]) {
    let (sum, count) = &mut sums[j][i];
    for (sum, product) in sum.iter_mut().zip([d[0] * d[0], d[0] * d[1], d[1] * d[1]]) {
        *sum += product;
    }
    *count += 1;
}

/// Mean over the photos of the camera-frame point that stays with the object: the first photos are true.
pub fn kept_by_photos(truth: &Project, found: &Adjustment, p: Vector3<f64>) -> Vector3<f64> {
    let photos = truth.photos.iter().zip(&found.photos);
    let moved = photos.map(|(before, after)| {
        assert_eq!(before.id, after.id);
        let (m, after_m) = (object_to_camera(before.rotation.unwrap()), object_to_camera(after.rotation));
        let x = m.transpose() * p + Vector3::from(before.position.unwrap());
        after_m * (x - Vector3::from(after.position))
    });
    moved.sum::<Vector3<f64>>() / truth.photos.len() as f64
}

/// Stated against scattered, node by node: the largest and the mean quotient of standard errors, as √(trace).
fn quotients(stated: &ProjectionUncertainty, sums: &Sums, samples: usize) -> (f64, f64, usize) {
    let (mut farthest, mut sum, mut nodes) = (1.0_f64, 0.0, 0);
    for (j, row) in sums.iter().enumerate() {
        for (i, (squares, count)) in row.iter().enumerate() {
            // at a corner beyond the fold of the true lens or of one of its estimates there is no ray
            let Some([uu, _, vv]) = stated.covariance[j][i].filter(|_| *count == samples) else { continue };
            let quotient = ((squares[0] + squares[2]) / *count as f64 / (uu + vv)).sqrt();
            if (quotient - 1.0).abs() > (farthest - 1.0).abs() {
                farthest = quotient;
            }
            sum += quotient;
            nodes += 1;
        }
    }
    (farthest, sum / nodes as f64, nodes)
}

#[test]
fn stated_uncertainty_is_the_scatter_of_many_calibrations_at_every_place() {
    let samples = extent::cases(120, 2000);
    for model in &CameraModel::ALL {
        let truth = project(model, 1);
        let true_camera = &truth.cameras[0];
        let cases = [
            (MotionReference::Rotation, FitRegion::Centre, None),
            (MotionReference::Rotation, FitRegion::All, None),
            (MotionReference::RotationTranslation, FitRegion::All, Some(500.0)),
            (MotionReference::None, FitRegion::All, None),
            (MotionReference::Photos, FitRegion::All, Some(500.0)),
        ];
        let first = calibrated(&truth);
        let options = |(reference, region, distance): (MotionReference, FitRegion, Option<f64>)| UncertaintyOptions {
            camera: Some("c".into()),
            grid: GRID,
            distance,
            region,
            reference,
            ..UncertaintyOptions::default()
        };
        let stated = cases.map(|case| projection_uncertainty(&truth, &first, &options(case)).expect("stated"));
        // of the truth's own variance factor
        let factor = first.sigma0.unwrap();
        let mut sums: Vec<Sums> = vec![vec![vec![([0.0; 3], 0); GRID[0]]; GRID[1]]; cases.len()];
        for seed in 0..samples {
            let found = calibrated(&project(model, 1000 + seed as u64));
            let camera = &found.cameras[0].camera;
            for (k, &(reference, region, distance)) in cases.iter().enumerate() {
                if reference == MotionReference::Photos {
                    for (j, v) in stated[k].v.iter().enumerate() {
                        for (i, u) in stated[k].u.iter().enumerate() {
                            let Some(ray) = ray_from_pixel(true_camera, [*u, *v]) else { continue };
                            let p = Vector3::from(ray).normalize() * distance.unwrap();
                            let p = kept_by_photos(&truth, &found, p);
                            let Some(q) = pixel_from_camera_point(camera, p) else { continue };
                            add(&mut sums[k], j, i, [q[0] - u, q[1] - v]);
                        }
                    }
                    continue;
                }
                let options = DifferenceOptions { grid: GRID, distance, region, reference };
                let difference = compare_cameras(true_camera, camera, &options).expect("one lens");
                for (j, i) in (0..GRID[1]).flat_map(|j| (0..GRID[0]).map(move |i| (j, i))) {
                    let Some((du, dv)) = difference.du[j][i].zip(difference.dv[j][i]) else { continue };
                    add(&mut sums[k], j, i, [du, dv]);
                }
            }
        }
        for (k, case) in cases.iter().enumerate() {
            let (farthest, mean, nodes) = quotients(&stated[k], &sums[k], samples);
            let (farthest, mean) = (farthest * factor, mean * factor);
            println!(
                "{} {case:?}: scattered over stated {mean:.3} in the mean, {farthest:.3} farthest of {nodes}",
                model.name
            );
            assert!(nodes >= 24, "{} {case:?}: {nodes}", model.name);
            // A standard error from n samples of two coordinates, hardly less than one, has the standard error 1/√2n: four of these.
            let limit = 4.0 / (2.0 * samples as f64).sqrt();
            assert!((farthest - 1.0).abs() < limit && (mean - 1.0).abs() < limit, "{} {case:?}", model.name);
        }
    }
}

#[test]
fn what_is_no_question_is_refused_by_name() {
    let project = project(&CameraModel::OPENCV, 1);
    let adjustment = calibrated(&project);
    let refused = |options: UncertaintyOptions| projection_uncertainty(&project, &adjustment, &options).unwrap_err();
    let plain = UncertaintyOptions::default;
    for (options, field) in [
        (UncertaintyOptions { grid: [1, 5], ..plain() }, "grid"),
        (UncertaintyOptions { grid: [5, 100_000], ..plain() }, "grid"),
        (UncertaintyOptions { distance: Some(-1.0), ..plain() }, "distance"),
        (UncertaintyOptions { distance: Some(f64::NAN), ..plain() }, "distance"),
        (UncertaintyOptions { reference: MotionReference::RotationTranslation, ..plain() }, "distance"),
        (UncertaintyOptions { camera: Some("other".into()), ..plain() }, "camera"),
        (UncertaintyOptions { photo: Some("s0".into()), ..plain() }, "photo"),
    ] {
        let error = refused(options.clone());
        assert!(format!("{error:?}").contains(&format!("\"{field}\"")), "{options:?}: {error:?}");
    }
    // another document's equations
    let mut other = project.clone();
    other.observations.iter_mut().filter(|o| o.u < 640.0).for_each(|o| o.sigma = sightline::project::Sigma::One(3.0));
    let photos = UncertaintyOptions { reference: MotionReference::Photos, ..plain() };
    assert!(projection_uncertainty(&project, &adjustment, &photos).is_ok());
    let error = projection_uncertainty(&other, &adjustment, &photos).unwrap_err();
    assert!(format!("{error:?}").contains("EquationsOfAnother"), "{error:?}");
    let mut held = project.clone();
    held.cameras[0].free.clear();
    let error = projection_uncertainty(&held, &calibrated(&held), &plain()).unwrap_err();
    assert!(format!("{error:?}").contains("NoCameraCovariance"), "{error:?}");
}

#[test]
fn a_principal_point_that_moved_is_mostly_a_rotation() {
    let interior = |cx: f64| Interior::Opencv {
        fx: Some(2000.0),
        fy: Some(2000.0),
        cx,
        cy: 400.0,
        k1: -0.1,
        k2: 0.02,
        p1: 0.0,
        p2: 0.0,
        k3: 0.0,
    };
    let camera = |cx: f64| Camera::new("c", 1200, 800, interior(cx));
    let same = compare_cameras(&camera(600.0), &camera(600.0), &DifferenceOptions::default()).unwrap();
    assert!(same.max_px.unwrap() < 1e-9 && same.rotation.iter().all(|r| r.abs() < 1e-12));
    let moved = compare_cameras(&camera(600.0), &camera(610.0), &DifferenceOptions::default()).unwrap();
    let plain = DifferenceOptions { reference: MotionReference::None, ..DifferenceOptions::default() };
    let untouched = compare_cameras(&camera(600.0), &camera(610.0), &plain).unwrap();
    // the second sees everything 10 px farther right, and is turned to the right by 10 px of 2000
    assert!((untouched.rms_px.unwrap() - 10.0).abs() < 1e-6);
    assert!(moved.rms_px.unwrap() < 0.6, "{:?}", moved.rms_px);
    assert!((moved.rotation[1].abs() - 0.005).abs() < 1e-4, "{:?}", moved.rotation);
    let back = compare_cameras(&camera(610.0), &camera(600.0), &DifferenceOptions::default()).unwrap();
    assert!((moved.rotation[1] + back.rotation[1]).abs() < 1e-6);
    let small = Camera::new("c", 600, 400, interior(300.0));
    assert!(compare_cameras(&camera(600.0), &small, &plain).is_err());
}
