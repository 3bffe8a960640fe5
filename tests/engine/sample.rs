//! The sample project, the whole way from its pixels: what it states must be true of it.

use sightline::adjust::{adjust, apply};
use sightline::adjustment::AdjustOptions;
use sightline::detection::{Codes, DetectOptions};
use sightline::matching::{MatchOptions, PhotoTargets, match_uncoded, name_coded};
use sightline::orient::orient;
use sightline::project::{Parameter, Point, Project};
use sightline::{decode, detect};
use sightline_lab::sample;

fn add(project: &mut Project, points: Vec<Point>) {
    let new = points.into_iter().filter(|p| project.points.iter().all(|known| known.id != p.id));
    let new: Vec<Point> = new.map(|p| Point { xyz: None, ..p }).collect();
    project.points.extend(new);
}

#[test]
fn the_sample_passes_the_global_test() {
    let options = DetectOptions { codes: Codes::Auto, ..DetectOptions::default() };
    let photo = |file: String| {
        let grey = decode::grey(&sample::file(&file).unwrap(), options.channel).unwrap();
        let targets = detect::detect(&grey.view().unwrap(), &options).unwrap().targets;
        PhotoTargets { photo: file.trim_end_matches(".png").into(), targets }
    };
    let photos: Vec<PhotoTargets> = sample::files().into_iter().map(photo).collect();
    let mut project = sample::project().unwrap();
    let coded = name_coded(&photos, None);
    project.observations = coded.observations.into();
    add(&mut project, coded.points);
    let ready = orient(&project).unwrap().project;
    let first = adjust(&ready, &AdjustOptions::default(), &mut |_| true).unwrap();
    let matching = match_uncoded(&apply(&ready, &first), &photos, &MatchOptions::default()).unwrap();
    project.observations.extend(matching.observations);
    add(&mut project, matching.points);
    let ready = orient(&project).unwrap().project;
    let adjustment = adjust(&ready, &AdjustOptions::default(), &mut |_| true).unwrap();
    let test = adjustment.global_test.clone().unwrap();
    println!("sigma0 {:.4}, redundancy {}", adjustment.sigma0.unwrap(), adjustment.redundancy);
    assert!(adjustment.redundancy > 500 && test.passed, "{:?} {test:?}", adjustment.sigma0);
    let camera = &adjustment.cameras[0];
    let c = camera.camera.interior.get(Parameter::C).unwrap();
    assert!((c - sample::network().cameras[0].interior.get(Parameter::C).unwrap()).abs() < 0.001, "{c}");
}
