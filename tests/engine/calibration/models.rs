//! Camera models compared on simulated networks: the model that made the photos, or one that is as good with fewer parameters, is the best.

use sightline::adjustment::AdjustOptions;
use sightline::calibration::{ComparedModel, ModelVerdict, ModelsOptions, compare_models, convert_camera};
use sightline::project::{CameraModel, Interior, Parameter, Project};

use crate::adjust::models::project;
use crate::support::extent;

fn row<'a>(rows: &'a [ComparedModel], model: &str) -> &'a ComparedModel {
    rows.iter().find(|row| row.model == model).expect("every model has a row")
}

fn told(rows: &[ComparedModel]) -> String {
    let one = |row: &ComparedModel| {
        format!(
            "{} {:?} sigma0 {:.3?} k {} insignificant {:?} held out {:.4?} bic {:.1?} {}",
            row.model,
            row.verdict,
            row.sigma0,
            row.parameters.len(),
            row.insignificant,
            row.held_out_rms,
            row.bic,
            row.failure.as_ref().map(ToString::to_string).unwrap_or_default()
        )
    };
    rows.iter().map(one).collect::<Vec<_>>().join("\n    ")
}

/// The network of a model, to be calibrated with another one.
fn given_as(model: &CameraModel, other: &CameraModel, seed: u64) -> Project {
    let project = project(model, seed);
    convert_camera(&project, "c", other.name).map(|(project, _)| project).expect("converted")
}

#[test]
fn the_model_that_made_the_photos_is_the_best() {
    let seeds = extent::cases(6, 60) as u64;
    let mut wrong = Vec::new();
    let mut tried = 0;
    for model in &CameraModel::ALL {
        for seed in 0..seeds {
            let project = project(model, 500 + seed);
            let rows = compare_models(&project, &ModelsOptions::default()).expect("compared");
            tried += 1;
            if seed == 0 {
                println!("{}:\n    {}", model.name, told(&rows));
            }
            let best = rows.iter().find(|row| row.verdict == ModelVerdict::Best).expect("one is the best");
            let right = row(&rows, model.name);
            let equivalent = best.parameters.len() < right.parameters.len()
                && matches!(right.verdict, ModelVerdict::Overfits)
                && best.sigma0.is_some_and(|s| s < 1.1);
            if best.model != model.name && !equivalent {
                wrong.push((model.name, seed, told(&rows)));
            }
            let sigma0 = right.sigma0.expect("the right model fits");
            assert!((0.9..1.1).contains(&sigma0), "{}: {}", model.name, told(&rows));
            // noise of 0.1 px, over √r for what the prediction itself is uncertain by: with 80 % of the observations r is 0.4
            let rms = right.held_out_rms.expect("enough points");
            assert!((0.1..0.18).contains(&rms), "{}: {}", model.name, told(&rows));
        }
    }
    println!("{} of {tried} wrong", wrong.len());
    for (model, seed, rows) in &wrong {
        println!("{model} {seed}:\n    {rows}");
    }
    // the difference of two BICs is a random number: of a hundred one may be beyond the odds of 150 to 1
    assert!(wrong.len() * 50 <= tried, "{}", wrong.len());
}

#[test]
fn the_model_that_is_given_does_not_decide() {
    for (model, other) in [
        (&CameraModel::OPENCV_RATIONAL, &CameraModel::BROWN),
        (&CameraModel::OPENCV_RATIONAL, &CameraModel::OPENCV_FISHEYE),
        (&CameraModel::BROWN, &CameraModel::OPENCV_RATIONAL),
        (&CameraModel::OPENCV, &CameraModel::BROWN),
    ] {
        for seed in 0..extent::cases(2, 20) as u64 {
            let rows =
                compare_models(&given_as(model, other, 900 + seed), &ModelsOptions::default()).expect("compared");
            let best = rows.iter().find(|row| row.verdict == ModelVerdict::Best).expect("one is the best");
            assert!((0.9..1.1).contains(&best.sigma0.unwrap()), "{} as {}: {}", model.name, other.name, told(&rows));
            let given = row(&rows, other.name);
            assert_ne!(given.verdict, ModelVerdict::Best, "{} as {}: {}", model.name, other.name, told(&rows));
        }
    }
}

#[test]
fn a_wide_lens_is_too_much_for_brown_and_a_fisheye_for_all_others() {
    let rows = compare_models(&project(&CameraModel::OPENCV_FISHEYE, 1), &ModelsOptions::default()).expect("compared");
    println!("{}", told(&rows));
    assert_eq!(row(&rows, "opencv_fisheye").verdict, ModelVerdict::Best);
    for other in ["brown", "opencv", "opencv_rational"] {
        let row = row(&rows, other);
        // points beside and behind the camera have no image
        assert!(matches!(row.verdict, ModelVerdict::Failed | ModelVerdict::TooStiff), "{}", told(&rows));
        assert_eq!(row.verdict == ModelVerdict::Failed, row.failure.is_some() && row.camera.is_none());
    }
    let wide = project(&CameraModel::OPENCV_RATIONAL, 2);
    let rows = compare_models(&wide, &ModelsOptions::default()).expect("compared");
    assert_eq!(row(&rows, "brown").verdict, ModelVerdict::TooStiff, "{}", told(&rows));
}

#[test]
fn a_lens_without_distortion_needs_none_of_it() {
    let mut truth = project(&CameraModel::OPENCV, 3);
    let (fx, fy) = (Some(640.0), Some(640.0));
    // simulated anew with a straight lens
    let straight = Interior::Opencv { fx, fy, cx: 640.0, cy: 360.0, k1: 0.0, k2: 0.0, p1: 0.0, p2: 0.0, k3: 0.0 };
    let camera = truth.cameras[0].clone();
    for o in &mut truth.observations {
        let ray = sightline::camera::ray_from_pixel(&camera, [o.u, o.v]).expect("a ray");
        let moved = sightline::project::Camera { interior: straight, ..camera.clone() };
        let pixel = sightline::camera::pixel_from_camera_point(&moved, ray.into()).expect("in front");
        (o.u, o.v) = (pixel[0], pixel[1]);
    }
    truth.cameras[0].interior = straight;
    truth.cameras[0].free =
        vec![Parameter::F, Parameter::Cx, Parameter::Cy, Parameter::K1, Parameter::P1, Parameter::P2];
    let rows = compare_models(&truth, &ModelsOptions::default()).expect("compared");
    println!("{}", told(&rows));
    let opencv = row(&rows, "opencv");
    assert!(opencv.insignificant.len() >= 3, "{}", told(&rows));
    // numerator and denominator of the rational model cancel: nothing determines either
    let rational = row(&rows, "opencv_rational").verdict;
    assert!(matches!(rational, ModelVerdict::Overfits | ModelVerdict::Failed), "{}", told(&rows));
    assert!(rows.iter().all(|row| row.verdict != ModelVerdict::TooStiff), "{}", told(&rows));
}

#[test]
fn what_is_no_question_is_refused_and_answers_repeat() {
    let project = project(&CameraModel::OPENCV, 4);
    let refused = |options: ModelsOptions| format!("{:?}", compare_models(&project, &options).unwrap_err());
    let snooping = AdjustOptions { snooping: true, ..AdjustOptions::default() };
    assert!(refused(ModelsOptions { adjust: snooping, ..ModelsOptions::default() }).contains("ModelsJudgedPlainly"));
    assert!(refused(ModelsOptions { camera: Some("x".into()), ..ModelsOptions::default() }).contains("Unknown"));
    let [a, b] = [(); 2].map(|()| compare_models(&project, &ModelsOptions::default()).unwrap());
    assert_eq!(a, b);
    let other = compare_models(&project, &ModelsOptions { seed: 2, ..ModelsOptions::default() }).unwrap();
    assert_ne!(a[1].held_out_rms, other[1].held_out_rms);
    assert_eq!(a[1].bic, other[1].bic);
}
