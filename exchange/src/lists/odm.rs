//! Ground control points of ODM (`gcp_list.txt`): the first line is the projection, every other one an image measurement.
//!
//! A row is easting, northing, height, column, row, picture, and perhaps a name. Here the points are read, each once; image measurements are counted.
//! Rows without a name are of one point where their coordinates are the same, and the names that are made up for these are told.
//! With a projection in degrees the first two are longitude and latitude, which become east and north in a local system; UTM is in metres, and of a code that is not UTM the unit is asked.
//!
//! Source: OpenDroneMap documentation, "Ground control points", GCP file format.

use crate::reason::ExchangeReason;
use std::collections::HashMap;

use super::{Beside, Listed, point};
use sightline::error::{Error, Place};
use sightline::units::Unit;

fn rows(text: &str) -> impl Iterator<Item = (usize, Vec<&str>)> {
    let lines = text.lines().enumerate().map(|(k, line)| (k + 1, line.trim()));
    let kept = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    kept.map(|(k, line)| (k, line.split_whitespace().collect()))
}

fn projection(first: &[&str]) -> bool {
    let word = first.first().copied().unwrap_or_default().to_ascii_uppercase();
    word.starts_with("EPSG:") || word.starts_with("+PROJ") || word == "WGS84" && first.len() > 1
}

/// Whether the first line is a projection and the next a measurement.
pub(super) fn recognises(text: &str) -> bool {
    let mut rows = rows(text);
    let first = rows.next().is_some_and(|(_, words)| projection(&words));
    let measured = |words: &[&str]| words.len() >= 6 && words[..5].iter().all(|word| word.parse::<f64>().is_ok());
    first && rows.next().is_none_or(|(_, words)| measured(&words))
}

/// Reads the points; east before north.
pub(super) fn read(text: &str) -> Listed {
    let mut listed = Listed { repeats: true, ..Listed::default() };
    let mut rows = rows(text);
    let head = rows.next().map(|(_, words)| words.join(" ").to_ascii_lowercase()).unwrap_or_default();
    let degrees = head.contains("longlat") || head.contains("latlong") || head == "epsg:4326";
    let code = head.strip_prefix("epsg:").and_then(|code| code.trim().parse::<u32>().ok()).unwrap_or_default();
    let utm = head.contains("utm") || (32_601..=32_660).contains(&code) || (32_701..=32_760).contains(&code);
    listed.unit = match () {
        () if degrees => Some(Unit::Metre),
        () if head.contains("+units=us-ft") => Some(Unit::SurveyFoot),
        () if head.contains("+units=ft") => Some(Unit::Foot),
        () if utm || head.contains("+units=m") => Some(Unit::Metre),
        () => None,
    };
    let mut made: HashMap<[&str; 3], usize> = HashMap::new();
    let mut measurements = 0;
    for (line, words) in rows {
        let fault = |reason| Err(Error::Invalid { reason, at: Place::line(line) });
        if words.len() < 6 {
            listed.rows.push(fault(ExchangeReason::ListColumns { needed: 6, columns: words.len() }.into()));
            continue;
        }
        let place = [words[0], words[1], words[2]];
        let name = words.get(6).map(|name| (*name).to_owned()).unwrap_or_else(|| {
            let count = made.len() + 1;
            format!("GCP {}", made.entry(place).or_insert(count))
        });
        measurements += 1;
        listed.rows.push(point(line, &name, "", place, 1.0));
    }
    listed.geographic = degrees;
    listed.names_made = made.len();
    listed.beside.push((Beside::ImageMeasurements, measurements));
    listed
}
