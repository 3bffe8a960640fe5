//! Writes a photo of the sample project in the formats of this module: `written FOLDER` leaves `photo.heic` and `photo.dng` there.

#[path = "../tests/support/dng.rs"]
mod dng;

use sightline::decode;
use sightline::detection::Channel;
use sightline::image::Samples;
use sightline::noise::Noise;
use sightline_lab::sample;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("written FOLDER")?;
    let name = sample::files().into_iter().next().ok_or("no photo")?;
    let grey = decode::grey(&sample::file(&name)?, Channel::Grey)?;
    let Samples::U8(samples) = &grey.samples else { return Err("not of 8 bits".into()) };
    let rgb: Vec<u8> = samples.iter().flat_map(|level| [*level; 3]).collect();
    let options = heifer::EncodeOptions { quality: 90, ..heifer::EncodeOptions::default() };
    let heic = heifer::encode_rgb8(grey.width as u32, grey.height as u32, &rgb, &options)?;
    std::fs::write(format!("{folder}/photo.heic"), heic)?;
    let mut noise = Noise::new(1, 0);
    let mut light = |level: &u8| (512.0 + 50.0 * f64::from(*level) + 4.0 * noise.normal()).round() as u16;
    let dng = dng::Dng {
        width: grey.width,
        height: grey.height,
        bits: 14,
        pattern: "RGGB",
        black: 512,
        white: 16383,
        active_area: [0, 0, grey.height as u32, grey.width as u32],
        samples: samples.iter().map(&mut light).collect(),
        lossless_jpeg: true,
        opcodes: Vec::new(),
        orientation: 1,
        preview: Vec::new(),
    };
    std::fs::write(format!("{folder}/photo.dng"), dng.file())?;
    Ok(())
}
