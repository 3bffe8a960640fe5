//! What lets the page work without a network: the service worker with the digests of every file of the build, and icons as pixels for
//! systems that do not draw SVG.

use std::collections::BTreeMap;
use std::fs;
use std::io::BufWriter;
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::Outcome;
use crate::build::write;
use crate::page;

/// Name of the service worker in dist/.
const SERVICE: &str = "service.js";

/// Files that few need: kept when they have been asked for once.
const LATER: &str = page::CODECS;

/// Puts the lists of files before the service worker. To be called when everything else lies in `dist`.
pub fn seal(dist: &Path) -> Outcome {
    let mut files = BTreeMap::new();
    list(dist, "", &mut files)?;
    let script = files.remove(SERVICE).ok_or("dist holds no service worker")?;
    let script = String::from_utf8(script).map_err(|_| "the service worker is not UTF-8")?;
    let digests: BTreeMap<_, _> = files.iter().map(|(name, bytes)| (name, hex(bytes))).collect();
    let build = hex(serde_json::to_string(&digests).map_err(|error| error.to_string())?.as_bytes());
    let (later, files): (BTreeMap<_, _>, BTreeMap<_, _>) =
        digests.into_iter().partition(|(name, _)| name.rsplit('/').next().unwrap_or_default().starts_with(LATER));
    let text = |digests| serde_json::to_string_pretty(&digests).map_err(|error| error.to_string());
    let lists =
        format!("const FILES = {};\nconst LATER = {};\nconst DIGEST = '{build}';\n", text(files)?, text(later)?);
    write(&dist.join(SERVICE), format!("{lists}{script}").as_bytes())
}

pub fn list(folder: &Path, prefix: &str, into: &mut BTreeMap<String, Vec<u8>>) -> Outcome {
    for entry in fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))? {
        let path = entry.map_err(|error| format!("{}: {error}", folder.display()))?.path();
        let name = format!("{prefix}{}", path.file_name().unwrap_or_default().to_string_lossy());
        if path.is_dir() {
            list(&path, &format!("{name}/"), into)?;
        } else {
            into.insert(name, fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?);
        }
    }
    Ok(())
}

pub fn hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Draws `web/icon.svg` as pixels: the same target on a full ground, which systems round as they like.
pub fn icons(dist: &Path) -> Outcome {
    for side in [180, 192, 512] {
        let path = dist.join(format!("icon-{side}.png"));
        let fault = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let file = fs::File::create(&path).map_err(|error| fault(&error))?;
        let mut encoder = png::Encoder::new(BufWriter::new(file), side, side);
        encoder.set_color(png::ColorType::Rgb);
        let pixels: Vec<u8> = (0..side * side).flat_map(|i| pixel(i % side, i / side, side)).collect();
        encoder
            .write_header()
            .and_then(|mut writer| writer.write_image_data(&pixels))
            .map_err(|error| fault(&error))?;
    }
    Ok(())
}

/// A pixel of the icon, from 16 places in it.
fn pixel(x: u32, y: u32, side: u32) -> [u8; 3] {
    const GROUND: [f64; 3] = [0.0, 104.0, 116.0];
    let at = |pixel: u32, part: u32| (f64::from(pixel) + (f64::from(part) + 0.5) / 4.0) / f64::from(side) * 22.0 - 11.0;
    let inside = (0..16).filter(|i| white(at(x, i % 4), at(y, i / 4))).count();
    GROUND.map(|ground| (ground + (255.0 - ground) * inside as f64 / 16.0).round() as u8)
}

/// The figure in the drawing's own units, from its middle.
fn white(x: f64, y: f64) -> bool {
    let stroke = |along: f64, across: f64| (4.0..=9.0).contains(&along.abs()) && across.abs() <= 0.75;
    x.hypot(y) <= 2.0 || stroke(x, y) || stroke(y, x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_service_worker_knows_every_file_by_its_digest() {
        let folder = std::env::temp_dir().join(format!("sightline-seal-{}", std::process::id()));
        fs::create_dir_all(folder.join("deep")).expect("a folder");
        for (name, content) in
            [("index.html", "<p>"), ("deep/a.js", "1"), ("deep/sightline-codecs.js", "2"), (SERVICE, "work();")]
        {
            write(&folder.join(name), content.as_bytes()).expect("a file");
        }
        seal(&folder).expect("sealed");
        let text = fs::read_to_string(folder.join(SERVICE)).expect("a script");
        fs::remove_dir_all(&folder).expect("removed");
        let digest = "6b86b273ff34fce19d6b804eff5a3f5747ada4eaa22f1d49c01e52ddb7875b4b";
        assert!(text.contains(&format!("\"deep/a.js\": \"{digest}\"")) && text.ends_with("work();"), "{text}");
        let (files, later) = text.split_once("const LATER").expect("two lists");
        assert!(files.contains("index.html") && !text.contains(SERVICE));
        assert!(later.contains("sightline-codecs.js") && !files.contains("codecs"));
    }

    #[test]
    fn the_icon_has_its_target_in_the_middle() {
        assert_eq!(pixel(96, 96, 192), [255; 3]);
        assert_eq!(pixel(2, 2, 192), [0, 104, 116]);
    }
}
