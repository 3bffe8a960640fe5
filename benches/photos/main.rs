//! Detection in ordinary pictures, natively: OpenCV's webcam pictures of dot grids with their known dots, pictures without
//! targets, and cameras drawn at random. `cargo bench --bench photos -- [PICTURES]` prints both tables, `-- conditions` one
//! condition of a crew's day after the other; the data lie where the tests look for them.

use std::error::Error;

use sightline::detection::{DetectOptions, Detection};
use sightline::image::{Grey, GreyView, Samples, SamplesView};
use sightline::{decode, detect};

#[path = "../../tests/engine/support/camera_model.rs"]
mod camera_model;
#[path = "../../tests/engine/support/conditions.rs"]
mod conditions;
#[path = "../../tests/engine/support/grid_fit.rs"]
mod grid_fit;
#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../../tests/engine/support/painter.rs"]
mod painter;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    if arguments.first().is_some_and(|part| part == "conditions") {
        return conditions();
    }
    let pictures = arguments.first().map_or(Ok(100), |count| count.parse())?;
    let folder = std::env::var("SIGHTLINE_DATA").unwrap_or_else(|_| "../shared/data".into());
    if std::path::Path::new(&folder).exists() {
        grids(&format!("{folder}/photos"))?;
    } else {
        println!("skipped, no data ({folder}/photos)");
    }
    cameras(pictures)
}

fn found(grey: &Grey) -> Result<(Detection, f64), Box<dyn Error>> {
    found_with(grey, &DetectOptions::default())
}

/// One condition of a crew's day after the other, ten pictures each.
fn conditions() -> Result<(), Box<dyn Error>> {
    println!(
        "{:<24} targets  found  false  rms px   chi  of them occluded, chi of these, said to be hidden",
        "condition"
    );
    for condition in conditions::all() {
        let mut all = camera_model::Score::default();
        let (mut occluded, mut of_occluded, mut told) = (0usize, 0.0, 0);
        for seed in 0..10 {
            let (grey, spots) = (condition.picture)(seed);
            let (detection, _) = found_with(&grey, &condition.options)?;
            let score = camera_model::score(&detection, &spots);
            let (count, square) = conditions::occluded(&detection, &spots);
            occluded += count;
            told += conditions::said_to_be_hidden(&detection, &spots);
            of_occluded += square;
            all.targets += score.targets;
            all.hits += score.hits;
            all.others += score.others;
            all.errors += score.errors;
            all.square += score.square;
        }
        let count = 2.0 * all.hits.max(1) as f64;
        println!(
            "{:<24} {:>7} {:>6.3} {:>6} {:>7.4} {:>5.2} {occluded:>5} {:>5.2} {told:>5}",
            condition.name,
            all.targets,
            all.hits as f64 / all.targets as f64,
            all.others,
            (all.errors / count).sqrt(),
            (all.square / count).sqrt(),
            (of_occluded / (2.0 * occluded.max(1) as f64)).sqrt(),
        );
    }
    Ok(())
}

fn found_with(grey: &Grey, options: &DetectOptions) -> Result<(Detection, f64), Box<dyn Error>> {
    let samples = match &grey.samples {
        Samples::U8(samples) => SamplesView::U8(samples),
        Samples::U16(samples) => SamplesView::U16(samples),
    };
    let view = GreyView::new(grey.width, grey.height, samples)?;
    let began = std::time::Instant::now();
    let detection = detect::detect(&view, options)?;
    Ok((detection, 1e3 * began.elapsed().as_secs_f64()))
}

fn grids(folder: &str) -> Result<(), Box<dyn Error>> {
    println!("{:<14} dots found others  rms px  chi      ms", "picture");
    for (name, size, dots) in grid_fit::grids(&std::fs::read_to_string(format!("{folder}/grids.json"))?) {
        let grey = decode::grey(&std::fs::read(format!("{folder}/{name}"))?, DetectOptions::default().channel)?;
        let (detection, ms) = found(&grey)?;
        let score = grid_fit::score(&detection, [grey.width, grey.height], &name, size, &dots);
        let grid_fit::Score { hits, others, rms, chi } = score;
        println!(
            "{name:<14} {:>4} {hits:>5} {others:>6} {rms:>7.4} {chi:>5.2} {ms:>7.1}  {:?}",
            dots.len(),
            detection.rejected
        );
        println!("    {:?}", detection.picture);
    }
    let grey = decode::grey(&std::fs::read(format!("{folder}/circlesgrid.png"))?, DetectOptions::default().channel)?;
    let (detection, ms) = found(&grey)?;
    println!("circlesgrid.png  36 {:>5} {ms:>7.1} {:?}", detection.targets.len(), detection.rejected);
    let mut files: Vec<_> = std::fs::read_dir(format!("{folder}/no-targets"))?.collect::<Result<_, _>>()?;
    files.sort_by_key(|file| file.file_name());
    for file in files {
        let grey = decode::grey(&std::fs::read(file.path())?, DetectOptions::default().channel)?;
        let (detection, ms) = found(&grey)?;
        println!("{:<20} {:>3} false {ms:>7.1} ms", file.file_name().to_string_lossy(), detection.targets.len());
    }
    Ok(())
}

fn cameras(pictures: u64) -> Result<(), Box<dyn Error>> {
    let mut all = camera_model::Tally::default();
    for seed in 0..pictures {
        let taken = camera_model::Camera::drawn(seed);
        let (grey, spots) = taken.picture(seed);
        let (detection, ms) = found(&grey)?;
        let score = camera_model::score(&detection, &spots);
        println!(
            "{seed:>4} {taken} {score} {ms:>7.1} ms {:.2} {:.2} {:.2} {}",
            detection.picture.sharpening,
            detection.picture.sharpening_radius,
            detection.picture.noise_correlation,
            detection.picture.softened
        );
        all.add(&taken, &score);
    }
    println!("{all}");
    Ok(())
}
