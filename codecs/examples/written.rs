//! Writes photos of the sample project in the formats of this module: `written FOLDER` leaves `photo.heic` there.

use sightline::detection::Channel;
use sightline::image::Samples;
use sightline::{decode, sample};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("written FOLDER")?;
    let name = sample::files().into_iter().next().ok_or("no photo")?;
    let grey = decode::grey(&sample::file(&name)?, Channel::Grey)?;
    let Samples::U8(samples) = &grey.samples else { return Err("not of 8 bits".into()) };
    let rgb: Vec<u8> = samples.iter().flat_map(|level| [*level; 3]).collect();
    let options = heifer::EncodeOptions { quality: 90, ..heifer::EncodeOptions::default() };
    let heic = heifer::encode_rgb8(grey.width as u32, grey.height as u32, &rgb, &options)?;
    std::fs::write(format!("{folder}/photo.heic"), heic)?;
    Ok(())
}
