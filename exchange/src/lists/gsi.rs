//! Leica GSI-8 and GSI-16: blocks of words of 15 or 23 places, a block a line.
//!
//! A word is a word index of two digits, four places of information, a sign, and 8 or 16 digits or letters; in GSI-16 a line begins with `*`.
//! Index 11 is the point, 81, 82, 83 its east, north, height, 84, 85, 86 those of the station, 41 a code, 71 to 79 remarks. The last place of the
//! information is the unit of a number: 0 mm and 1 thousandths of feet as whole numbers, 6 and 7 ten-thousandths of m and feet, 8 hundredths
//! of mm. Leading zeros fill names and numbers. The file does not say which foot it means.
//!
//! Source: Leica Geosystems, "GSI ONLINE for Leica TPS and DNA", structure of words and table of word indices.

use super::{Beside, Listed, point};
use sightline::error::{Error, Place, Reason, shortened};
use sightline::units::Unit;

/// A word: its index, the place of the unit, its sign, its data.
fn word(text: &str) -> Option<(&str, char, bool, &str)> {
    let bytes = text.as_bytes();
    let head = bytes.len() >= 8
        && text.is_ascii()
        && bytes[..2].iter().all(u8::is_ascii_digit)
        && bytes[2..6].iter().all(|byte| byte.is_ascii_digit() || *byte == b'.')
        && matches!(bytes[6], b'+' | b'-');
    head.then(|| (&text[..2], char::from(bytes[5]), bytes[6] == b'-', &text[7..]))
}

fn words(line: &str) -> impl Iterator<Item = &str> {
    line.trim().trim_start_matches('*').split_whitespace()
}

/// Whether most lines are blocks.
pub(super) fn recognises(text: &str) -> bool {
    let lines = || text.lines().map(str::trim).filter(|line| !line.is_empty()).take(20);
    let block = |line: &&str| words(line).next().is_some_and(|first| word(first).is_some());
    let blocks = lines().filter(block).count();
    blocks > 0 && 2 * blocks > lines().count()
}

/// Reads the points; east before north.
pub(super) fn read(text: &str) -> Listed {
    let mut listed = Listed::default();
    let mut measurements = 0;
    let (mut metres, mut feet) = (false, false);
    for (k, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let at = k + 1;
        let (mut id, mut label) = (String::new(), String::new());
        let mut places: [Option<String>; 6] = Default::default();
        let mut broken = None;
        for text in words(line) {
            let Some((index, unit, minus, data)) = word(text) else {
                broken.get_or_insert_with(|| shortened(text));
                continue;
            };
            let bare = data.trim_start_matches('0');
            match index {
                "11" => id = if bare.is_empty() { "0".into() } else { bare.into() },
                "41" | "71" | "72" if label.is_empty() => label = bare.to_owned(),
                "81" | "82" | "83" | "84" | "85" | "86" => {
                    let place = usize::from(index.as_bytes()[1] - b'1');
                    let digits = if bare.is_empty() { "0" } else { bare };
                    let decimals = match unit {
                        '0' | '1' => 3,
                        '6' | '7' => 4,
                        '8' => 5,
                        _ => {
                            broken.get_or_insert_with(|| shortened(text));
                            continue;
                        }
                    };
                    *if matches!(unit, '1' | '7') { &mut feet } else { &mut metres } = true;
                    places[place] = Some(format!("{}{digits}e-{decimals}", if minus { "-" } else { "" }));
                }
                _ => {}
            }
        }
        let own = if places[..3].iter().any(Option::is_some) { &places[..3] } else { &places[3..] };
        match broken {
            Some(text) => {
                let reason = Reason::NotANumber { name: "GSI".into(), text };
                listed.rows.push(Err(Error::Invalid { reason, at: Place::line(at) }));
            }
            // Directions and distances, codes, remarks.
            None if own.iter().all(Option::is_none) => measurements += 1,
            None => {
                let own: [&str; 3] = std::array::from_fn(|k| own[k].as_deref().unwrap_or_default());
                listed.rows.push(point(at, &id, &label, own, 1.0));
            }
        }
    }
    // Of feet it is not said which; of both units in one file nothing is.
    listed.unit = (metres && !feet).then_some(Unit::Metre);
    listed.beside.push((Beside::Measurements, measurements));
    listed
}
