//! Pictures of targets whose truth is known, painted by the tests' independent renderer for `benches/detect.mjs`: 8-bit
//! samples as NAME.raw, and index.json with sizes, true spots and Cramér-Rao bounds, in the folder that is named.

use std::error::Error;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};
use sightline::image::Samples;

#[path = "../../tests/engine/support/painter.rs"]
mod painter;

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../../tests/engine/support/light.rs"]
mod light;

mod clutter;

use light::{Light, tone};
use painter::{Canvas, Spot, Uniform, bound};

const NOISE: f64 = 2.0;
const BLUR: f64 = 0.7;

/// Rows and columns of the grids of isolated spots of one kind: chance moves the rms of their errors by 1 %.
const GRID: usize = 50;
/// Circles of contrast 200, and ellipses (major axis, axis ratio) of contrast 60.
const CIRCLES: [f64; 4] = [5.0, 10.0, 20.0, 40.0];
const ELLIPSES: [(f64, f64); 4] = [(12.5, 0.4), (24.0, 0.4), (24.0, 0.7), (50.0, 0.4)];
/// Maximum change of the light of lamps from pixel to pixel: a tenth across a target of 30 px.
const STEEPEST: f64 = 0.1 / 30.0;
/// Seeds of the cluttered pictures.
const SEEDS: [u64; 4] = [11, 12, 13, 14];

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo adds --bench.
    let folder = std::env::args().skip(1).find(|argument| !argument.starts_with("--"));
    let folder = folder.ok_or("usage: cargo bench --package sightline --bench detect -- FOLDER")?;
    let folder = Path::new(&folder);
    fs::create_dir_all(folder)?;
    let mut index = Vec::new();
    let mut keep = |part: &str, name: String, (canvas, spots): (Canvas, Vec<Spot>), seed, bounds: Vec<f64>| {
        let picture = canvas.expose(NOISE, seed);
        let Samples::U8(samples) = &picture.samples else { return Err("8 bits are painted".into()) };
        fs::write(folder.join(format!("{name}.raw")), samples)?;
        let spots: Vec<Value> = spots.iter().map(|s| json!([s.u, s.v, s.a, s.b, s.angle, s.contrast])).collect();
        let (width, height) = (picture.width, picture.height);
        index.push(
            json!({"part": part, "name": name, "width": width, "height": height, "spots": spots, "bounds": bounds}),
        );
        Ok::<(), Box<dyn Error>>(())
    };
    for diameter in CIRCLES {
        let kind = |_: &mut Uniform| (diameter / 2.0, diameter / 2.0, 200.0);
        let scene = grid([GRID, GRID], diameter + 32.0, 30.0, BLUR, diameter as u64, kind);
        let bounds = bounds(&scene.1[..16]);
        keep("isolated", format!("circle {diameter}"), scene, 1, bounds)?;
    }
    for (major, ratio) in ELLIPSES {
        let kind = |_: &mut Uniform| (major / 2.0, ratio * major / 2.0, 60.0);
        let scene = grid([GRID, GRID], major + 32.0, 90.0, BLUR, major as u64, kind);
        let bounds = bounds(&scene.1[..64]);
        keep("isolated", format!("ellipse {major} x {:.1}", ratio * major), scene, 2, bounds)?;
    }
    // Targets of every size, tilt, contrast and polarity: a dark picture and a softer bright one, in light of lenses and lamps.
    for (name, level, sign, blur) in [("bright", 30.0, 1.0, BLUR), ("dark", 200.0, -1.0, 1.0)] {
        let kind = |random: &mut Uniform| {
            let a = 3.0 * 10f64.powf(random.next());
            (a, (a * random.within(0.4, 1.0)).max(3.0), sign * random.within(60.0, 190.0))
        };
        let mut scene = grid([40, 25], 100.0, level, blur, 7, kind);
        let mut random = Uniform(level as u64);
        Light::drawn(&mut random, 0.6, STEEPEST).fall(&mut scene.0);
        tone(&mut scene.0, random.within(1.0, 2.4));
        keep("random", name.into(), scene, 3, Vec::new())?;
    }
    for seed in SEEDS {
        let scene = clutter::picture(6000, 4000, 200, BLUR, seed);
        let bounds = bounds(&scene.1);
        keep("cluttered", format!("seed {seed}"), scene, seed, bounds)?;
    }
    fs::write(folder.join("index.json"), serde_json::to_vec(&index)?)?;
    Ok(())
}

/// Spots alone on a level ground, at random places within their pixels; `kind` gives semi-axes and contrast.
fn grid(
    [columns, rows]: [usize; 2],
    pitch: f64,
    level: f64,
    blur: f64,
    seed: u64,
    kind: impl Fn(&mut Uniform) -> (f64, f64, f64),
) -> (Canvas, Vec<Spot>) {
    let mut canvas = Canvas::new((columns as f64 * pitch) as usize, (rows as f64 * pitch) as usize, level);
    let mut random = Uniform(seed);
    let mut spots = Vec::new();
    for k in 0..columns * rows {
        let place = |i: usize, random: &mut Uniform| (i as f64 + 0.5) * pitch + random.within(-0.5, 0.5);
        let (u, v) = (place(k % columns, &mut random), place(k / columns, &mut random));
        let angle = random.within(0.0, std::f64::consts::PI);
        let (a, b, contrast) = kind(&mut random);
        spots.push(Spot { u, v, a, b, angle, contrast });
    }
    spots.iter().for_each(|spot| canvas.add(spot, blur));
    (canvas, spots)
}

/// Bounds of centres on a level ground.
fn bounds(spots: &[Spot]) -> Vec<f64> {
    spots.iter().map(|spot| bound(spot, BLUR, NOISE, 1)).collect()
}
