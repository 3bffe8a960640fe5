use super::*;
use crate::adjustment::Correlation;
use crate::initial::Pose;
use crate::initial::robust::{generator, uniform};
use crate::project::{Camera, Interior, Parameter, Photo, Point, Sigma};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

const POINT: [f64; 3] = [0.2, -0.1, 0.05];

/// Five photos around the point, seen by a lens with barrel distortion.
fn project() -> Project {
    let mut camera = Camera::new("k", 3000, 2000, Interior::brown(2500.0));
    camera.interior.set(Parameter::K1, 2e-8);
    let photos = (0..5).map(|k| {
        let t = f64::from(k) - 2.0;
        Photo {
            id: k.to_string(),
            camera: "k".into(),
            position: Some([0.8 * t, 0.3 * t * t - 0.5, 4.0]),
            rotation: Some([0.05 * t, 0.19 * t, 0.4 * t]),
            enabled: true,
            ..Photo::default()
        }
    });
    let mut project = Project { cameras: vec![camera], photos: photos.collect(), ..Project::default() };
    project.points.push(Point { id: "p".into(), ..Point::default() });
    project
}

fn image(project: &Project, photo: usize, at: [f64; 3]) -> [f64; 2] {
    let pose = Pose::of_photo(&project.photos[photo]).expect("a pose");
    pixel_from_camera_point(&project.cameras[0], pose.to_camera(&at.into())).expect("in front")
}

fn see(project: &mut Project, photo: usize, [u, v]: [f64; 2]) {
    let (photo, point) = (photo.to_string(), "p".to_owned());
    project.observations.push(Observation { photo, point, u, v, sigma: Sigma::One(0.5), enabled: true, target: None });
}

/// With exact rays lines and places go through the truth, from one ray on and from two on.
#[test]
fn lines_and_places_meet_the_truth() {
    let mut p = project();
    for rays in 1..4 {
        let at = image(&p, rays - 1, POINT);
        see(&mut p, rays - 1, at);
        let found = predict(&p, None, "p", &PredictOptions::default()).expect("a prediction");
        assert_eq!((found.rays, found.xyz.is_some()), (rays, rays > 1));
        for (k, photo) in found.photos.iter().enumerate() {
            let [u, v] = image(&p, k, POINT);
            let (others, own) = if k < rays { (rays - 1, true) } else { (rays, false) };
            assert_eq!((photo.lines.len(), photo.measured.is_some()), (others, own), "{rays} {k}");
            for line in &photo.lines {
                let near = line.course.windows(2).map(|s| beside([u, v], s[0], s[1])).fold(f64::INFINITY, f64::min);
                assert!(near < 0.15, "{rays} {k}: {near}");
            }
            assert_eq!(photo.place.is_some(), others > 1);
            if let Some([pu, pv]) = photo.place {
                assert!((pu - u).hypot(pv - v) < 1e-6 && photo.inside);
                assert_eq!(photo.off_px.is_some(), own);
            }
        }
    }
}

/// Distance of a place from a piece of a course.
fn beside([u, v]: [f64; 2], p: [f64; 2], q: [f64; 2]) -> f64 {
    let (d, length) = ([q[0] - p[0], q[1] - p[1]], (q[0] - p[0]).hypot(q[1] - p[1]));
    let along = (((u - p[0]) * d[0] + (v - p[1]) * d[1]) / (length * length)).clamp(0.0, 1.0);
    (u - p[0] - along * d[0]).hypot(v - p[1] - along * d[1])
}

/// The covariance is that of a simulation in which measurements and orientations scatter.
#[test]
fn standard_errors_are_those_of_a_simulation() {
    let truth = project();
    let photo = AdjustedPhoto {
        sigma_position: Some([0.0006, 0.0004, 0.0008]),
        sigma_rotation: Some([0.0002, 0.0003, 0.0002]),
        correlation: Some(Correlation {
            names: Vec::new(),
            matrix: (0..6).map(|i| (0..6).map(|j| if i == j { 1.0 } else { 0.2 }).collect()).collect(),
        }),
        ..AdjustedPhoto::default()
    };
    let photos = (0..5).map(|k| AdjustedPhoto { id: k.to_string(), ..photo.clone() }).collect();
    let adjustment = Adjustment { sigma0: Some(1.0), photos, ..Adjustment::default() };
    let factor = covariance(&photo).expect("standard errors").cholesky().expect("positive").l();
    let mut g = generator(7);
    let mut normal = || (0..12).map(|_| uniform(&mut g)).sum::<f64>() - 6.0;
    let (mut sum, mut expected) = ([0.0; 3], [0.0; 3]);
    const DRAWS: usize = 1500;
    for _ in 0..DRAWS {
        let mut drawn = truth.clone();
        for k in 0..3 {
            let [u, v] = image(&truth, k, POINT);
            see(&mut drawn, k, [u + 0.5 * normal(), v + 0.5 * normal()]);
        }
        for photo in &mut drawn.photos {
            let e = factor * nalgebra::Vector6::from_fn(|_, _| normal());
            let (position, rotation) = (photo.position.as_mut().unwrap(), photo.rotation.as_mut().unwrap());
            for k in 0..3 {
                position[k] += e[k];
                rotation[k] += e[k + 3];
            }
        }
        let found = predict(&drawn, Some(&adjustment), "p", &PredictOptions::default()).expect("a prediction");
        let photo = &found.photos[4];
        let (place, covariance) = (photo.place.expect("a place"), photo.covariance.expect("standard errors"));
        let [u, v] = image(&truth, 4, POINT);
        let d = [place[0] - u, place[1] - v];
        for (k, square) in [d[0] * d[0], d[0] * d[1], d[1] * d[1]].into_iter().enumerate() {
            sum[k] += square / DRAWS as f64;
            expected[k] += covariance[k] / DRAWS as f64;
        }
    }
    for k in [0, 2] {
        let ratio = sum[k] / expected[k];
        assert!((0.85..1.15).contains(&ratio), "{ratio} of {expected:?}");
    }
    assert!((sum[1] - expected[1]).abs() < 0.15 * (expected[0] * expected[2]).sqrt());
}

/// Whichever photos lack the standard errors of their orientation: no covariance, ellipse or distance in standard errors is told where
/// one of them takes part, and all of it where none does.
#[test]
fn without_standard_errors_of_an_orientation_no_ellipse_is_told() {
    let mut p = project();
    for k in 0..3 {
        let at = image(&p, k, POINT);
        see(&mut p, k, at);
    }
    let unit = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
    let matrix: Vec<Vec<f64>> = (0..6).map(|i| (0..6).map(|j| unit(i, j)).collect()).collect();
    let whole = AdjustedPhoto {
        sigma_position: Some([0.001; 3]),
        sigma_rotation: Some([0.001; 3]),
        correlation: Some(Correlation { names: Vec::new(), matrix }),
        ..AdjustedPhoto::default()
    };
    let mut g = generator(11);
    for draw in 0..40 {
        let lacking: Vec<bool> = (0..5).map(|_| draw > 0 && uniform(&mut g) < 0.4).collect();
        let photos = (0..5).filter_map(|k| {
            let bare = AdjustedPhoto { id: k.to_string(), ..whole.clone() };
            Some(match (lacking[k], (uniform(&mut g) * 4.0) as usize) {
                (false, _) => bare,
                (true, 0) => return None,
                (true, 1) => AdjustedPhoto { sigma_position: None, ..bare },
                (true, 2) => AdjustedPhoto { sigma_rotation: None, ..bare },
                _ => AdjustedPhoto { correlation: None, ..bare },
            })
        });
        let adjustment = Adjustment { sigma0: Some(1.0), photos: photos.collect(), ..Adjustment::default() };
        let found = predict(&p, Some(&adjustment), "p", &PredictOptions::default()).expect("a prediction");
        let named: Vec<usize> = found.without_errors.iter().map(|id| id.parse().expect("a number")).collect();
        assert_eq!(named, (0..5).filter(|k| lacking[*k]).collect::<Vec<_>>());
        assert_eq!(found.sigma.is_none(), lacking[..3].contains(&true));
        for (k, photo) in found.photos.iter().enumerate() {
            let taking_part = (0..3).filter(|other| *other != k).any(|other| lacking[other]) || lacking[k];
            assert!(photo.place.is_some() && photo.least_covariance.is_some());
            assert_eq!((photo.covariance.is_none(), photo.ellipse(3.0).is_none()), (taking_part, taking_part));
            assert_eq!(photo.off_sigmas.is_none(), taking_part || k > 2);
        }
    }
    let found = predict(&p, None, "p", &PredictOptions::default()).expect("a prediction");
    assert!(found.without_errors.len() == 5 && found.sigma.is_none());
    assert!(found.photos.iter().all(|photo| photo.place.is_some() && photo.covariance.is_none()));
}

/// A measurement that is off is told by how far, by the rays of the others alone; a target that lies there is offered.
#[test]
fn what_is_off_is_told_and_what_fits_is_offered() {
    let mut p = project();
    for k in 0..4 {
        let [u, v] = image(&p, k, POINT);
        see(&mut p, k, [u, v + if k == 3 { 30.0 } else { 0.0 }]);
    }
    p.observations[3].enabled = false;
    let unit = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
    let matrix: Vec<Vec<f64>> = (0..6).map(|i| (0..6).map(|j| unit(i, j)).collect()).collect();
    let adjusted = |k: usize| AdjustedPhoto {
        id: k.to_string(),
        sigma_position: Some([1e-9; 3]),
        sigma_rotation: Some([1e-9; 3]),
        correlation: Some(Correlation { names: Vec::new(), matrix: matrix.clone() }),
        ..AdjustedPhoto::default()
    };
    let adjustment = Adjustment { photos: (0..5).map(adjusted).collect(), ..Adjustment::default() };
    let none = PredictOptions { lines_in: Some(Vec::new()) };
    let bare = predict(&p, None, "p", &none).expect("a prediction");
    let found = predict(&p, Some(&adjustment), "p", &none).expect("a prediction");
    assert!(found.photos.iter().all(|photo| photo.lines.is_empty()));
    let off = &found.photos[3];
    assert!((off.off_px.expect("a distance") - 30.0).abs() < 1e-3 && off.off_sigmas.is_none());
    let [u, v] = image(&p, 3, POINT);
    let targets = [(u + 200.0, v), (u + 0.4, v), (u, v)].map(|(u, v)| super::super::target(u, v, None));
    let order = off.candidates(&targets).into_iter().map(|(k, _)| k).collect::<Vec<_>>();
    assert_eq!(order, [2, 1]);
    // Offered too where the orientation has no standard errors, with no ellipse.
    let offered = bare.photos[3].candidates(&targets).into_iter().map(|(k, _)| k).collect::<Vec<_>>();
    assert_eq!((offered, bare.photos[3].ellipse(1.0)), (vec![2, 1], None));
    let [major, minor, _] = off.ellipse(1.0).expect("an ellipse");
    assert!(major >= minor && minor > 0.0);
    assert!(matches!(predict(&p, None, "q", &PredictOptions::default()), Err(Error::Unknown { .. })));
}

/// Photos from one place, and a point behind a camera, give only finite numbers.
#[test]
fn what_cannot_be_predicted_is_left_out() {
    let mut p = project();
    p.photos[1].position = p.photos[0].position;
    p.photos[4].rotation = Some([0.0, std::f64::consts::PI, 0.0]);
    for k in 0..2 {
        let at = image(&p, k, POINT);
        see(&mut p, k, at);
    }
    let found = predict(&p, None, "p", &PredictOptions::default()).expect("a prediction");
    assert!(found.xyz.is_none() && found.photos.iter().all(|photo| photo.place.is_none()));
    let at = image(&p, 2, POINT);
    see(&mut p, 2, at);
    let found = predict(&p, None, "p", &PredictOptions::default()).expect("a prediction");
    assert!(found.xyz.is_some() && found.photos[4].place.is_none() && !found.photos[4].inside);
}
