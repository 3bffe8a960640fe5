//! An adjustment, natively: `cargo run --release --example adjust -- PROJECT.json ['{"robust": "huber"}']` prints the result as
//! JSON. The options are those of the JavaScript face.

use std::error::Error;

use sightline::adjust::adjust;
use sightline::adjustment::AdjustOptions;
use sightline_exchange as exchange;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (file, options) = match &arguments[..] {
        [file] => (file, AdjustOptions::default()),
        [file, options] => (file, serde_json::from_str(options)?),
        _ => return Err("usage: adjust PROJECT [OPTIONS as JSON]".into()),
    };
    let project = exchange::import("sightline", &[(file.clone(), std::fs::read(file)?)].into())?;
    let adjustment = adjust(&project, &options, &mut |_| true)?;
    println!("{}", serde_json::to_value(&adjustment)?);
    Ok(())
}
