//! Uncertainty over distance against the map of uncertainty and the scatter of calibrations; residuals in bands against plain sums.

use nalgebra::Vector3;
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment};
use sightline::calibration::{
    BandOptions, DistanceOptions, MotionReference, UncertaintyOptions, projection_uncertainty, residual_bands,
    uncertainty_over_distance,
};
use sightline::camera::{pixel_from_camera_point, ray_from_pixel};
use sightline::project::{CameraModel, Project};

use super::uncertainty::kept_by_photos;
use crate::adjust::models::project;
use crate::support::extent;

fn calibrated(project: &Project) -> Adjustment {
    adjust(project, &AdjustOptions::default(), &mut |_| true).expect("solvable")
}

#[test]
fn the_curve_is_the_map_at_every_distance_and_ends_at_infinity() {
    for model in &CameraModel::ALL {
        let project = project(model, 1);
        let adjustment = calibrated(&project);
        let far = 1e9;
        let distances = vec![100.0, 500.0, 2500.0, far];
        let (width, height) = (f64::from(project.cameras[0].width), f64::from(project.cameras[0].height));
        // the places of a grid of 5 x 3
        let places: Vec<[f64; 2]> =
            (0..15).map(|k| [width * f64::from(k % 5) / 4.0, height * f64::from(k / 5) / 2.0]).collect();
        let asked =
            DistanceOptions { distances: Some(distances.clone()), places: Some(places), ..DistanceOptions::default() };
        let found = uncertainty_over_distance(&project, &adjustment, &asked).expect("a calibration");
        assert_eq!((found.camera.as_str(), found.distances.as_slice()), ("c", distances.as_slice()));
        for (n, distance) in distances.iter().map(|d| Some(*d)).chain([None]).enumerate() {
            let asked = UncertaintyOptions {
                grid: [5, 3],
                distance,
                reference: MotionReference::Photos,
                ..UncertaintyOptions::default()
            };
            let map = projection_uncertainty(&project, &adjustment, &asked).expect("a calibration");
            let of_map = map.sigma.iter().flatten();
            let mut rays = 0;
            for (place, sigma) in found.places.iter().zip(of_map) {
                let here = if distance.is_some() { place.sigma[n] } else { place.infinity };
                assert_eq!(here.is_some(), sigma.is_some(), "{} {distance:?}", model.name);
                let Some((a, b)) = here.zip(*sigma) else { continue };
                assert!((a - b).abs() < 1e-12 * b, "{} {distance:?}: {a} {b}", model.name);
                let (at_far, infinity) = (place.sigma[3].unwrap(), place.infinity.unwrap());
                assert!((at_far - infinity).abs() < 1e-5 * infinity, "{}: {at_far} {infinity}", model.name);
                rays += 1;
            }
            assert!(rays >= 11, "{}: {rays}", model.name);
        }
    }
}

#[test]
fn points_are_predicted_best_about_where_they_were_measured() {
    for model in &CameraModel::ALL {
        let project = project(model, 1);
        let found =
            uncertainty_over_distance(&project, &calibrated(&project), &DistanceOptions::default()).expect("found");
        let [near, far] = found.measured;
        let plain = project.observations.iter().map(|o| {
            let photo = project.photos.iter().find(|p| p.id == o.photo).unwrap().position.unwrap();
            let point = project.points.iter().find(|p| p.id == o.point).unwrap().xyz.unwrap();
            (Vector3::from(photo) - Vector3::from(point)).norm()
        });
        let [least, most] = plain.fold([f64::INFINITY, 0.0_f64], |[a, b], d| [a.min(d), b.max(d)]);
        assert!((near / least - 1.0).abs() < 0.01 && (far / most - 1.0).abs() < 0.01, "{}: {near} {far}", model.name);
        assert_eq!((found.distances.len(), found.places.len()), (33, 5));
        assert!((found.distances[0] / near - 0.2).abs() < 1e-9 && (found.distances[32] / far - 5.0).abs() < 1e-9);
        let centre = &found.places[0];
        let sigma: Vec<f64> = centre.sigma.iter().map(|s| s.unwrap()).collect();
        let best = (0..33).min_by(|a, b| sigma[*a].total_cmp(&sigma[*b])).unwrap();
        assert!((near..far).contains(&found.distances[best]), "{}: {}", model.name, found.distances[best]);
        // close by the place of the camera counts, far away its directions alone
        assert!(sigma[0] > 2.0 * sigma[best] && centre.infinity.unwrap() > sigma[best], "{}: {sigma:?}", model.name);
        for outer in &found.places[1..] {
            let k = found.distances.iter().position(|d| *d > far).unwrap();
            assert!(outer.sigma[k].is_none_or(|s| s > sigma[k]), "{}", model.name);
        }
    }
}

#[test]
fn the_curve_is_the_scatter_of_many_calibrations_at_every_distance() {
    let samples = extent::cases(100, 1000);
    for model in &CameraModel::ALL {
        let truth = project(model, 1);
        let first = calibrated(&truth);
        let asked = DistanceOptions { distances: Some(vec![60.0, 400.0, 3000.0]), ..DistanceOptions::default() };
        let stated = uncertainty_over_distance(&truth, &first, &asked).expect("a calibration");
        // the larger eigenvalue of the scatter's covariance, per place and distance
        let mut sums = vec![[[0.0; 3]; 3]; stated.places.len()];
        for seed in 0..samples {
            let found = calibrated(&project(model, 1000 + seed as u64));
            for (place, sums) in stated.places.iter().zip(&mut sums) {
                let Some(ray) = ray_from_pixel(&truth.cameras[0], [place.u, place.v]) else { continue };
                for (distance, sum) in stated.distances.iter().zip(sums) {
                    let p = kept_by_photos(&truth, &found, Vector3::from(ray).normalize() * *distance);
                    let Some(q) = pixel_from_camera_point(&found.cameras[0].camera, p) else { continue };
                    let d = [q[0] - place.u, q[1] - place.v];
                    sum.iter_mut()
                        .zip([d[0] * d[0], d[0] * d[1], d[1] * d[1]])
                        .for_each(|(s, x)| *s += x / samples as f64);
                }
            }
        }
        let mut checked = 0;
        for (place, sums) in stated.places.iter().zip(&sums) {
            for ((distance, sigma), [uu, uv, vv]) in stated.distances.iter().zip(&place.sigma).zip(sums) {
                let Some(sigma) = sigma else { continue };
                let scattered = ((uu + vv) / 2.0 + ((uu - vv) / 2.0).hypot(*uv)).sqrt() * first.sigma0.unwrap();
                let quotient = scattered / sigma;
                // four standard errors of a standard error from n samples; the larger eigenvalue of a sample is a little too large
                let limit = 4.0 / (2.0 * samples as f64).sqrt();
                println!("{} {:.0} {:.0} at {distance}: {quotient:.3}", model.name, place.u, place.v);
                assert!((quotient - 1.0).abs() < limit, "{} at {distance}: {quotient}", model.name);
                checked += 1;
            }
        }
        assert!(checked >= 9, "{}: {checked}", model.name);
    }
}

#[test]
fn what_is_no_question_about_distance_is_refused_by_name() {
    let project = project(&CameraModel::OPENCV, 1);
    let adjustment = calibrated(&project);
    let plain = DistanceOptions::default;
    for (options, field) in [
        (DistanceOptions { distances: Some(vec![]), ..plain() }, "distances"),
        (DistanceOptions { distances: Some(vec![1.0, 0.0]), ..plain() }, "distances"),
        (DistanceOptions { distances: Some(vec![f64::INFINITY]), ..plain() }, "distances"),
        (DistanceOptions { places: Some(vec![]), ..plain() }, "places"),
        (DistanceOptions { places: Some(vec![[-1.0, 5.0]]), ..plain() }, "places"),
        (DistanceOptions { places: Some(vec![[f64::NAN, 5.0]]), ..plain() }, "places"),
        (DistanceOptions { camera: Some("other".into()), ..plain() }, "camera"),
    ] {
        let error = uncertainty_over_distance(&project, &adjustment, &options).unwrap_err();
        assert!(format!("{error:?}").contains(&format!("\"{field}\"")), "{options:?}: {error:?}");
    }
    for bands in [0, 1, 1001] {
        let error =
            residual_bands(&project, &adjustment, &BandOptions { bands, ..BandOptions::default() }).unwrap_err();
        assert!(format!("{error:?}").contains("\"bands\""), "{error:?}");
    }
    let mut other = project.clone();
    other.observations.pop();
    assert!(residual_bands(&other, &adjustment, &BandOptions::default()).is_err());
}

#[test]
fn residuals_in_bands_are_those_of_the_adjustment() {
    for model in &CameraModel::ALL {
        let mut project = project(model, 1);
        project.observations[7].enabled = false;
        let found = calibrated(&project);
        let bands = residual_bands(&project, &found, &BandOptions::default()).expect("bands");
        assert_eq!((bands.columns.len(), bands.rows.len()), (16, 16));
        assert_eq!((bands.columns[15].to, bands.rows[15].to), (1280.0, 720.0));
        for all in [&bands.columns, &bands.rows] {
            let sum = |of: &dyn Fn(&sightline::calibration::ResidualBand) -> Option<f64>| -> f64 {
                all.iter().filter_map(|b| of(b).map(|x| 2.0 * b.count as f64 * x * x)).sum()
            };
            assert_eq!(all.iter().map(|b| b.count).sum::<usize>(), project.observations.len() - 1);
            // all weights are those of 0.1 px: vᵀPv and the redundancy of the image coordinates, which is that of the network
            let (squares, expected) = (sum(&|b| b.rms) / 0.01, sum(&|b| b.expected) / 0.01);
            let sigma0 = found.sigma0.unwrap();
            assert!((squares / (sigma0 * sigma0 * found.redundancy as f64) - 1.0).abs() < 1e-9, "{}", model.name);
            assert!((expected / found.redundancy as f64 - 1.0).abs() < 1e-6, "{}: {expected}", model.name);
            // by itself every band is within what chance allows it
            for band in all.iter().filter(|b| b.count >= 20) {
                let quotient = band.rms.unwrap() / band.expected.unwrap();
                assert!((quotient - 1.0).abs() < 5.0 / (4.0 * band.count as f64).sqrt(), "{}: {band:?}", model.name);
            }
        }
    }
    // what is wrong at one side is seen there: it alternates with the points, so that nothing takes it over
    let mut bent = project(&CameraModel::OPENCV, 1);
    for (k, o) in bent.observations.iter_mut().enumerate().filter(|(_, o)| o.u < 160.0) {
        o.v += if k % 2 == 0 { 0.6 } else { -0.6 };
    }
    let found = calibrated(&bent);
    let bands = residual_bands(&bent, &found, &BandOptions { bands: 8, ..BandOptions::default() }).expect("bands");
    let quotient = |b: &sightline::calibration::ResidualBand| b.rms.unwrap() / b.expected.unwrap();
    assert!(quotient(&bands.columns[0]) > 2.0, "{bands:?}");
    assert!(
        bands.columns[2..].iter().chain(&bands.rows).all(|b| quotient(b) < quotient(&bands.columns[0]) / 1.5),
        "{bands:?}"
    );
}
