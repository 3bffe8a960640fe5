//! Every camera model in simulation, orientation and self-calibration: standard errors that hold what they state.

use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Termination};
use sightline::orient::orient;
use sightline::project::{Camera, CameraModel, DatumKind, Interior, Parameter, Project, Sigma};
use sightline_plan::network::{Network, NetworkPoint, Station, simulate};

pub fn interior(model: &str) -> Interior {
    let (fx, fy, cx, cy) = (Some(640.0), Some(643.0), 645.0, 352.0);
    match model {
        "brown" => Interior::Brown {
            c: Some(640.0),
            x0: 5.0,
            y0: -8.0,
            k1: 1.5e-7,
            k2: -1e-13,
            k3: 0.0,
            p1: 1e-6,
            p2: -2e-6,
            b1: 3e-4,
            b2: -1e-4,
        },
        "opencv" => Interior::Opencv { fx, fy, cx, cy, k1: -0.12, k2: 0.03, p1: 1e-3, p2: -5e-4, k3: -0.002 },
        "opencv_rational" => Interior::OpencvRational {
            fx,
            fy,
            cx,
            cy,
            k1: 0.31,
            k2: 0.07,
            p1: 4e-4,
            p2: -3e-4,
            k3: 0.01,
            k4: 0.42,
            k5: 0.08,
            k6: 0.015,
        },
        "opencv_fisheye" => {
            // 111 degrees off the axis at the left and right edge
            let (fx, fy) = (Some(330.0), Some(331.5));
            Interior::OpencvFisheye { fx, fy, cx, cy, k1: -0.012, k2: 0.004, k3: -0.0011, k4: 0.00011 }
        }
        other => panic!("no lens for {other}"),
    }
}

/// What is estimated: all that stands by itself. The fourth to sixth coefficient of the rational model are nearly equivalent to the first three.
fn estimated(model: &CameraModel) -> Vec<Parameter> {
    let held = [Parameter::F, Parameter::K5, Parameter::K6];
    model.parameters.iter().copied().filter(|p| !held.contains(p)).collect()
}

/// A hall of points seen from a ring inside it: pictures that are filled. That of a wide camera lies in the middle of the hall, with
/// points beside and behind every station.
pub fn project(model: &CameraModel, seed: u64) -> Project {
    network(interior(model.name), 10, seed)
}

/// The same of any lens, seen from so many stations.
pub fn network(interior: Interior, stations: u32, seed: u64) -> Project {
    let model = interior.model();
    let mut camera = Camera::new("c", 1280, 720, interior);
    camera.free = estimated(model);
    let point = |k: u32| {
        let share = |step: f64| (f64::from(k) * step).fract() - 0.5;
        NetworkPoint {
            id: k.to_string(),
            xyz: [900.0 * share(0.618_033_988_7), 900.0 * share(0.754_877_666_2), 500.0 * share(0.569_840_290_9)],
            ..NetworkPoint::default()
        }
    };
    let ring = if camera.principal_distance_px().is_some_and(|f| f < 400.0) { 150.0 } else { 420.0 };
    let station = |k: u32| {
        let turn = f64::from(k) * 0.7;
        let position = [ring * turn.cos(), ring * turn.sin(), 60.0 * (f64::from(k) * 1.3).sin()];
        Station::aimed(format!("s{k}"), "c", position, [0.0, 0.0, 10.0], 1.6 * f64::from(k))
    };
    let mut project = simulate(&Network {
        cameras: vec![camera],
        stations: (0..stations).map(station).collect(),
        points: (0..120).map(point).collect(),
        sigma: Sigma::One(0.1),
        seed,
        ..Network::default()
    })
    .expect("a network");
    project.datum.kind = DatumKind::Free;
    project
}

#[test]
fn every_model_is_calibrated_and_its_intervals_hold() {
    for model in &CameraModel::ALL {
        let truth = interior(model.name);
        let (mut squares, mut inside, mut count, mut sigma0) = (0.0, 0, 0, 0.0);
        const SAMPLES: u64 = 24;
        for seed in 0..SAMPLES {
            let project = project(model, 100 + seed);
            let found = adjust(&project, &AdjustOptions::default(), &mut |_| true).expect("solvable");
            assert_eq!(found.termination, Termination::Converged, "{} {seed}", model.name);
            sigma0 += found.sigma0.expect("redundant") / SAMPLES as f64;
            let camera = &found.cameras[0];
            assert_eq!(camera.sigma.len(), estimated(model).len(), "{}", model.name);
            for (parameter, sigma) in &camera.sigma {
                let off = camera.camera.interior.get(*parameter).unwrap() - truth.get(*parameter).unwrap();
                squares += (off / sigma).powi(2);
                inside += usize::from((off / sigma).abs() < 1.96);
                count += 1;
            }
        }
        let (mean, share) = (squares / f64::from(count), f64::from(inside as u32) / f64::from(count));
        println!("{}: sigma0 {sigma0:.3}, mean square of error over sigma {mean:.3}, inside {share:.3}", model.name);
        // The parameters of one calibration are correlated: the mean over 24 has a standard deviation of about 0.1.
        assert!((0.98..1.02).contains(&sigma0), "{}: {sigma0}", model.name);
        assert!((0.65..1.45).contains(&mean) && share > 0.89, "{}: {mean} {share}", model.name);
    }
}

#[test]
fn photos_of_every_model_are_oriented_from_images_alone() {
    for model in &CameraModel::ALL {
        let mut project = project(model, 7);
        project.cameras[0].free.clear();
        for photo in &mut project.photos {
            (photo.position, photo.rotation) = (None, None);
        }
        for point in &mut project.points {
            point.xyz = None;
        }
        let oriented = orient(&project).expect("oriented").project;
        assert!(oriented.photos.iter().all(|p| p.position.is_some()), "{}", model.name);
        let found = adjust(&oriented, &AdjustOptions::default(), &mut |_| true).expect("solvable");
        let sigma0 = found.sigma0.expect("redundant");
        assert!((0.9..1.1).contains(&sigma0), "{}: {sigma0}", model.name);
        let used = found.observations.iter().filter(|o| o.enabled).count();
        assert!(used * 50 >= project.observations.len() * 49, "{}: {used}", model.name);
    }
}

/// The fisheye network has what it is there for: measurements beyond 90 degrees off the axis, which take part.
#[test]
fn points_beside_and_behind_a_fisheye_take_part() {
    let project = project(&CameraModel::OPENCV_FISHEYE, 3);
    let beyond: Vec<usize> = (0..project.observations.len())
        .filter(|&k| {
            let o = &project.observations[k];
            sightline::camera::ray_from_pixel(&project.cameras[0], [o.u, o.v]).is_some_and(|ray| ray[2] >= 0.0)
        })
        .collect();
    assert!(beyond.len() > 20, "{}", beyond.len());
    let found = adjust(&project, &AdjustOptions::default(), &mut |_| true).expect("solvable");
    assert!(beyond.iter().all(|&k| found.observations[k].enabled && found.observations[k].vx.is_some()));
    let advice = serde_json::to_string(&found.advice).unwrap();
    assert!(!advice.contains("behind_camera"), "{advice}");
}
