//! Standard errors of centres in compressed pictures, natively: `cargo bench --bench compression -- [PICTURES]` prints error over
//! sigma of pictures drawn at random, by quality and noise, by size of the targets, tables and ground. `-- FILE` measures files of
//! other encoders: a JSON list of {"file", "class", "spots": [[u, v], ...]} with paths beside it, error over sigma by class.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

use sightline::detection::{Codes, DetectOptions, Detection};
use sightline::image::Grey;
use sightline::{decode, detect};

#[path = "../../tests/engine/support/compression.rs"]
mod compression;
#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../../tests/engine/support/painter.rs"]
mod painter;

use compression::{Shot, Sums};
use painter::Spot;

/// Bounds of the classes of quality, noise, and major axis in pixels.
const QUALITIES: [f64; 5] = [50.0, 65.0, 80.0, 90.0, 99.0];
const NOISES: [f64; 5] = [0.5, 1.0, 1.8, 3.0, 5.0];
const SIZES: [f64; 5] = [6.0, 9.0, 14.0, 24.0, 41.0];

type Table = BTreeMap<String, Sums>;

fn main() -> Result<(), Box<dyn Error>> {
    let argument = std::env::args().skip(1).find(|argument| !argument.starts_with("--"));
    match argument {
        Some(file) if file.ends_with(".json") => files(Path::new(&file)),
        Some(count) => drawn(count.parse()?),
        None => drawn(150),
    }
}

fn found(grey: &Grey) -> Result<Detection, Box<dyn Error>> {
    let options = DetectOptions { codes: Codes::None, ..DetectOptions::default() };
    Ok(detect::detect(&grey.view()?, &options)?)
}

fn drawn(pictures: u64) -> Result<(), Box<dyn Error>> {
    let mut table = Table::new();
    let class = |bounds: &[f64], value: f64| {
        let k = bounds.partition_point(|bound| *bound <= value).clamp(1, bounds.len() - 1);
        format!("{:>4} to {:>4}", bounds[k - 1], bounds[k])
    };
    for seed in 0..pictures {
        let shot = Shot::drawn(seed);
        let (grey, spots) = shot.picture(seed);
        let detection = found(&grey)?;
        let mut own = Sums::default();
        own.add(&detection, &spots);
        println!("{seed:>4} {shot} {}", line(&own));
        let (quality, noise) = (class(&QUALITIES, f64::from(shot.quality)), class(&NOISES, shot.noise));
        let ground = if shot.cluttered { "clutter" } else { "flat ground" };
        for name in [
            "all".into(),
            format!("quality {quality}, noise {noise}"),
            format!("tables {:?}", shot.tables),
            format!("{ground}, quality {quality}"),
        ] {
            table.entry(name).or_default().add(&detection, &spots);
        }
        for spot in &spots {
            let name = format!("major axis {} px", class(&SIZES, 2.0 * spot.a));
            table.entry(name).or_default().add(&detection, std::slice::from_ref(spot));
        }
    }
    table.iter().for_each(|(name, sums)| println!("{name:<44} {}", line(sums)));
    Ok(())
}

fn files(list: &Path) -> Result<(), Box<dyn Error>> {
    let index: serde_json::Value = serde_json::from_slice(&std::fs::read(list)?)?;
    let folder = list.parent().unwrap_or(Path::new("."));
    let mut table = Table::new();
    for entry in index.as_array().ok_or("a list is expected")? {
        let text = |name: &str| entry[name].as_str().ok_or(format!("{name} is missing"));
        let spots: Vec<Vec<f64>> = serde_json::from_value(entry["spots"].clone())?;
        let spots: Vec<Spot> =
            spots.iter().map(|s| Spot { u: s[0], v: s[1], a: 3.0, b: 3.0, angle: 0.0, contrast: 0.0 }).collect();
        let grey = decode::grey(&std::fs::read(folder.join(text("file")?))?, DetectOptions::default().channel)?;
        table.entry(text("class")?.into()).or_default().add(&found(&grey)?, &spots);
    }
    table.iter().for_each(|(name, sums)| println!("{name:<44} {}", line(sums)));
    Ok(())
}

fn line(sums: &Sums) -> String {
    let Sums { targets, hits, others, largest, errors, .. } = sums;
    let rms = (errors / (2 * hits.max(&1)) as f64).sqrt();
    format!(
        "{hits:>5} of {targets:>5} + {others:>2}  rms {rms:.4} px  error/sigma {:.3}, at most {largest:.1}",
        sums.honest()
    )
}
