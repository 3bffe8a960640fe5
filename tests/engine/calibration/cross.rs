//! Cross-validation: parts of the photos agree when the model is right, and do not when it is wrong, whatever sigma0 that ends at.

use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Robust};
use sightline::calibration::{CrossOptions, CrossVerdict, MotionReference, cross_validate};
use sightline::project::{CameraModel, DatumKind, Interior, Parameter, Project, Sigma};

use crate::adjust::models::{interior, network, project};
use crate::support::extent;
use crate::support::lenses::{Fault, scene};

const GRID: [usize; 2] = [15, 11];

fn options() -> CrossOptions {
    CrossOptions { grid: GRID, ..CrossOptions::default() }
}

/// A network that half of its photos calibrate.
fn large(model: &CameraModel, seed: u64) -> Project {
    network(interior(model.name), 24, seed)
}

/// A wide barrel lens, to be calibrated as Brown with two radial coefficients: an equidistant one of this focal length in pixels, whose picture
/// is 1280 pixels wide. (With the third Brown follows such lenses to less than the noise.)
fn as_brown(f: f64, seed: u64) -> Project {
    let (fx, fy) = (Some(f), Some(f));
    let lens = Interior::OpencvFisheye { fx, fy, cx: 645.0, cy: 352.0, k1: -0.01, k2: 0.0, k3: 0.0, k4: 0.0 };
    let mut project = network(lens, 24, seed);
    project.cameras[0].interior = Interior::brown(f);
    project.cameras[0].free = Parameter::BROWN.into_iter().filter(|p| *p != Parameter::K3).collect();
    project
}

#[test]
fn parts_of_a_right_calibration_agree() {
    let seeds = extent::cases(20, 100) as u64;
    let (mut wrong, mut tried, mut above_two) = (Vec::new(), 0, 0);
    for model in &CameraModel::ALL {
        for seed in 0..seeds {
            let found = cross_validate(&large(model, 3000 + seed), &options()).expect("two calibrations");
            tried += 1;
            above_two += usize::from(found.ratio.unwrap() > 2.0);
            if found.verdict != CrossVerdict::Agrees {
                wrong.push((model.name, seed, found.ratio, found.limit));
            }
            assert!(found.covered.iter().flatten().filter(|c| **c).count() > GRID[0] * GRID[1] / 2);
        }
    }
    println!("{} of {tried} accused: {wrong:?}; {above_two} exceed twice the prediction somewhere", wrong.len());
    // one in a thousand is accused: two of eighty have a probability of 0.003
    assert!(wrong.len() <= 1 + tried / 500, "{wrong:?}");
}

/// Over right calibrations the ratio is what it says: in the mean, the square of the difference is the trace of its covariance.
#[test]
fn ratios_of_a_right_model_are_those_of_chance() {
    let seeds = extent::cases(20, 200) as u64;
    let (mut exceeded, mut nodes) = (0_usize, 0_usize);
    for seed in 0..seeds {
        let found = cross_validate(&large(&CameraModel::OPENCV, 7000 + seed), &options()).expect("two calibrations");
        for (ratio, covered) in found.ratio_map.iter().flatten().zip(found.covered.iter().flatten()) {
            if let (Some(ratio), true) = (ratio, covered) {
                nodes += 1;
                exceeded += usize::from(*ratio > 1.96);
            }
        }
    }
    let share = exceeded as f64 / nodes as f64;
    println!("{share:.4} of {nodes} places beyond 1.96");
    // 5 % where the error is along one direction, e^(-1.96²/2) = 14.6 % where it is along all alike
    assert!((0.03..0.18).contains(&share), "{share}");
}

#[test]
fn brown_on_a_wide_lens_is_seen_whatever_sigma0_it_ends_at() {
    let seeds = extent::cases(12, 100) as u64;
    let (mut missed, mut tried) = (Vec::new(), 0);
    for seed in 0..seeds {
        // 89, 98 and 105 degrees along the width
        let f = [820.0, 750.0, 700.0][seed as usize % 3];
        let found = cross_validate(&as_brown(f, 100 + seed), &options()).expect("two calibrations");
        tried += 1;
        println!(
            "{seed}: f {f} ratio {:?} limit {:.2} with sigma0 {:?}, sigma0 {:?}",
            found.ratio,
            found.limit,
            found.ratio_with_sigma0,
            found.parts.iter().map(|p| p.sigma0).collect::<Vec<_>>()
        );
        if found.verdict != CrossVerdict::WrongModel {
            missed.push((seed, f, found.verdict, found.ratio, found.limit));
        }
    }
    assert!(missed.is_empty(), "{} of {tried} missed: {missed:?}", missed.len());
}

/// Lenses drawn at random (equidistant, stereographic, rational) that Brown or opencv cannot follow: 77 to 100 degrees along the diagonal.
#[test]
fn lenses_unlike_the_model_are_seen() {
    let wanted = extent::cases(16, 150);
    let (mut missed, mut tried, mut seed) = (Vec::new(), 0, 0);
    while tried < wanted && seed < 20 * wanted as u64 {
        seed += 1;
        let scene = scene(Fault::Lens, 40_000 + seed, 0.1);
        let plain = AdjustOptions::default();
        let Some(sigma0) = adjust(&scene.project, &plain, &mut |_| true).ok().and_then(|found| found.sigma0) else {
            continue;
        };
        // half as much again as the noise: below, the lens is close to what the model can follow
        if sigma0 < 1.5 {
            continue;
        }
        let found = cross_validate(&scene.project, &options());
        let Ok(found) = found else {
            println!("{seed}: {found:?}");
            continue;
        };
        tried += 1;
        if found.verdict != CrossVerdict::WrongModel {
            missed.push((seed, sigma0, found.verdict, found.ratio, found.limit));
        }
    }
    println!("{} of {tried} missed in {seed} scenes: {missed:?}", missed.len());
    assert_eq!(tried, wanted);
    assert!(missed.is_empty(), "{missed:?}");
}

#[test]
fn standard_errors_that_are_too_small_are_not_taken_for_a_wrong_model() {
    let seeds = extent::cases(8, 60) as u64;
    let (mut verdicts, mut wrong) = (Vec::new(), 0);
    for seed in 0..seeds {
        let mut project = large(&CameraModel::OPENCV, 11_000 + seed);
        // what was measured to 0.1 px is said to be measured to 0.02
        project.observations.iter_mut().for_each(|o| o.sigma = Sigma::One(0.02));
        let found = cross_validate(&project, &options()).expect("two calibrations");
        wrong += usize::from(found.verdict == CrossVerdict::WrongModel);
        verdicts.push(found.verdict);
    }
    println!("{verdicts:?}");
    assert!(verdicts.contains(&CrossVerdict::LargerNoise));
    // a clean part has a pattern by chance in one of seventy calibrations
    assert!(wrong * 20 <= verdicts.len(), "{verdicts:?}");
}

#[test]
fn more_parts_agree_as_well() {
    let mut options = options();
    options.parts = 3;
    options.reference = MotionReference::RotationTranslation;
    options.distance = Some(500.0);
    let found = cross_validate(&large(&CameraModel::OPENCV, 5), &options).expect("three calibrations");
    let mut photos: Vec<String> = found.parts.iter().flat_map(|part| part.photos.clone()).collect();
    photos.sort();
    photos.dedup();
    assert_eq!((found.parts.len(), photos.len()), (3, 24));
    assert_eq!(found.verdict, CrossVerdict::Agrees, "{:?} {}", found.ratio, found.limit);
}

#[test]
fn what_cannot_be_split_or_calibrated_is_refused_with_the_reason() {
    let whole = project(&CameraModel::OPENCV, 1);
    let refused = |project: &Project, options: CrossOptions, reason: &str| {
        let error = cross_validate(project, &options).expect_err(reason);
        assert!(format!("{error:?}").contains(reason), "{error:?}");
        println!("{error}");
    };
    refused(&whole, CrossOptions { parts: 1, ..options() }, "CrossParts");
    refused(&whole, CrossOptions { parts: 6, ..options() }, "CrossPhotos");
    refused(&whole, CrossOptions { camera: Some("other".into()), ..options() }, "Unknown");
    for adjust in [
        AdjustOptions { snooping: true, ..AdjustOptions::default() },
        AdjustOptions { robust: Some(Robust::Huber), ..AdjustOptions::default() },
    ] {
        refused(&whole, CrossOptions { adjust, ..options() }, "ModelsJudgedPlainly");
    }
    let mut few = whole.clone();
    few.photos.iter_mut().skip(3).for_each(|photo| photo.enabled = false);
    refused(&few, options(), "CrossPhotos");
    let mut loose = whole.clone();
    loose.datum.kind = DatumKind::Control;
    refused(&loose, options(), "PartFails");
    let mut own = whole.clone();
    own.cameras[0].per_photo = true;
    refused(&own, options(), "CrossPerPhoto");
    let mut held = whole.clone();
    held.cameras[0].free.clear();
    refused(&held, options(), "NoCameraCovariance");
    let hurried = AdjustOptions { max_iterations: 1, ..AdjustOptions::default() };
    refused(&as_brown(750.0, 1), CrossOptions { adjust: hurried, ..options() }, "NotConverged");
}
