//! The targets of a photo, natively: `cargo run --release --example targets -- PHOTO ['{"codes": "ring-14"}']` prints the
//! detection as JSON. The options are those of the JavaScript face.

use std::error::Error;

use sightline::detection::DetectOptions;
use sightline::{decode, detect};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (photo, options) = match &arguments[..] {
        [photo] => (photo, DetectOptions::default()),
        [photo, options] => (photo, serde_json::from_str(options)?),
        _ => return Err("usage: targets PHOTO [OPTIONS as JSON]".into()),
    };
    let photo = decode::photo(&std::fs::read(photo)?, options.channel)?;
    println!("{}", serde_json::to_string(&detect::detect_photo(&photo, &options)?)?);
    Ok(())
}
