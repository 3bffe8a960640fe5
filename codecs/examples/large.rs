//! Writes photos as large as cameras make them, with 200 targets in them, for `benches/codecs.mjs`: `large FOLDER` leaves `large.dng` (24 megapixels of
//! 14 bits, lossless JPEG, with a preview) and `large.heic` (12 megapixels) there.

#[allow(dead_code, reason = "shared with the engine's tests, which use all of it")]
#[path = "../../tests/engine/support/painter.rs"]
mod painter;

#[path = "../tests/support/dng.rs"]
mod dng;

use painter::{Canvas, Spot, Uniform};
use sightline::noise::Noise;

/// 20 x 10 circles of 6 to 60 pixels on uneven ground, as shares of the largest light.
fn scene(width: usize, height: usize) -> Canvas {
    let mut canvas = Canvas::new(width, height, 0.2);
    for y in 0..height {
        for x in 0..width {
            let wave = (x as f64 / 170.0).sin() * (y as f64 / 230.0).cos();
            canvas.levels[y * width + x] += 0.08 * wave;
        }
    }
    let mut random = Uniform(17);
    for k in 0..200 {
        let place = |i: usize, count: usize, side: usize| side as f64 * (i as f64 + 0.5) / count as f64;
        let (u, v) = (place(k % 20, 20, width) + random.next(), place(k / 20, 10, height) + random.next());
        let a = random.within(3.0, 30.0);
        canvas
            .add(&Spot { u, v, a, b: a * random.within(0.6, 1.0), angle: random.within(0.0, 3.1), contrast: 0.5 }, 0.8);
    }
    canvas
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("large FOLDER")?;
    let canvas = scene(6000, 4000);
    let mut noise = Noise::new(1, 0);
    let mut sample = |share: &f64| {
        let light = 15_000.0 * share;
        (512.0 + light + (16.0 + 0.5 * light).sqrt() * noise.normal()).round().clamp(0.0, 16383.0) as u16
    };
    let samples: Vec<u16> = canvas.levels.iter().map(&mut sample).collect();
    let (across, down) = (1500, 1000);
    let shown = |i: usize| (255.0 * canvas.levels[4 * (i / across) * 6000 + 4 * (i % across)].clamp(0.0, 1.0)) as u8;
    let rgb: Vec<u8> = (0..across * down).flat_map(|i| [shown(i); 3]).collect();
    let mut preview = Vec::new();
    let encoder = jpeg_encoder::Encoder::new(&mut preview, 85);
    encoder.encode(&rgb, across as u16, down as u16, jpeg_encoder::ColorType::Rgb)?;
    let dng = dng::Dng {
        width: 6000,
        height: 4000,
        bits: 14,
        pattern: "RGGB",
        black: 512,
        white: 16383,
        active_area: [0, 0, 4000, 6000],
        samples,
        lossless_jpeg: true,
        opcodes: Vec::new(),
        orientation: 1,
        preview,
    };
    std::fs::write(format!("{folder}/large.dng"), dng.file())?;

    let canvas = scene(4032, 3024);
    let mut level = |share: &f64| (255.0 * share + 1.5 * noise.normal()).round().clamp(0.0, 255.0) as u8;
    let rgb: Vec<u8> = canvas.levels.iter().flat_map(|share| [level(share); 3]).collect();
    let options = heifer::EncodeOptions { quality: 90, ..heifer::EncodeOptions::default() };
    std::fs::write(format!("{folder}/large.heic"), heifer::encode_rgb8(4032, 3024, &rgb, &options)?)?;
    Ok(())
}
