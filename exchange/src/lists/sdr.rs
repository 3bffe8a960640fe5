//! Sokkia SDR 2x and SDR33: a record a line, of fields by their places.
//!
//! Records 08 (coordinates) and 02 (station): type and derivation of two letters each, then point, north, east, height of 16 places each in
//! SDR33 (point 4 and numbers 10 in SDR 2x); the description follows, in record 02 behind the height of the instrument. The header 00NM has
//! the version at place 5, the unit of distances at 42 (1 m, 2 feet, which it does not say) and the order of coordinates at 45 (1 north first, 2 east
//! first). Programs differ in whether that order is of the records too: with 2 it is asked.
//!
//! Source: Nikon N/K series and Spectra Precision Focus manuals, "SDR2x and SDR33 record formats".

use super::{Beside, Listed, point};
use sightline::units::Unit;

/// Whether it begins with a header.
pub(super) fn recognises(text: &str) -> bool {
    text.lines().map(str::trim_start).find(|line| !line.is_empty()).is_some_and(|line| line.starts_with("00NMSDR"))
}

/// Reads the points; east before north.
pub(super) fn read(text: &str) -> Listed {
    let mut listed = Listed::default();
    let (mut measurements, mut short) = (0, false);
    for (k, line) in text.lines().enumerate() {
        let letters: Vec<char> = line.trim_end().chars().collect();
        let field = |from: usize, count: usize| -> String {
            letters.iter().skip(from).take(count).collect::<String>().trim().to_owned()
        };
        match field(0, 2).as_str() {
            "00" => {
                // A file of several jobs has a header each.
                short = field(4, 5).starts_with("SDR2");
                let unit = (field(41, 1) == "1").then_some(Unit::Metre);
                listed.unit =
                    if k == 0 || listed.rows.is_empty() { unit } else { listed.unit.filter(|_| unit.is_some()) };
                listed.order_open |= field(44, 1) == "2";
            }
            kind @ ("08" | "02") => {
                let (name, number) = if short { (4, 10) } else { (16, 16) };
                let at = |n: usize| 4 + name + n * number;
                let [north, east, height] = std::array::from_fn(|n| field(at(n), number));
                let label = field(if kind == "08" { at(3) } else { at(4) }, 16);
                let id = field(4, name);
                // Names of digits are filled with zeros.
                let digits = !id.is_empty() && id.bytes().all(|byte| byte.is_ascii_digit());
                let bare = if digits { id.trim_start_matches('0') } else { &id };
                let id = if digits && bare.is_empty() { "0" } else { bare };
                listed.rows.push(point(k + 1, id, &label, [&east, &north, &height], 1.0));
            }
            "03" | "07" | "09" | "11" => measurements += 1,
            _ => {}
        }
    }
    listed.beside.push((Beside::Measurements, measurements));
    listed
}
