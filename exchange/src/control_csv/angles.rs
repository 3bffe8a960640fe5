//! Latitudes and longitudes as lists write them: decimal degrees, degrees and minutes, degrees, minutes and seconds, with a sign or a letter.
//!
//! 37.503472, 37.503472N, 37°30'12.5", 37 30 12.5, 37-30-12.5N, 37:30:12.5, 37d30m12.5s, N 37°30.2083', 북위 37도 30분 12.5초. Minutes and
//! seconds are below 60, and only the last number has decimals, with a point or a comma. The letter "O" is refused: it is east in German and
//! west in French.

use serde::{Deserialize, Serialize};

use super::decimals::is_numeric;

/// How the angles of a list are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AngleForm {
    /// Decimal degrees.
    #[default]
    Degrees,
    /// Degrees and minutes, or degrees, minutes and seconds.
    Sexagesimal,
}

/// An angle that was read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Angle {
    /// Degrees, to the north and the east positive.
    pub degrees: f64,
    pub form: AngleForm,
    /// The axis of its letter: 0 for east and west, 1 for north and south.
    pub axis: Option<usize>,
    /// Whether something but digits, a sign and a decimal mark says that it is an angle.
    pub marked: bool,
}

/// Letters and words for the directions: axis (0 longitude, 1 latitude), sign, spellings.
const DIRECTIONS: [(usize, f64, &[&str]); 4] = [
    (1, 1.0, &["N", "북위", "北緯", "北纬"]),
    (1, -1.0, &["S", "남위", "南緯", "南纬"]),
    (0, 1.0, &["E", "동경", "東経", "东经"]),
    (0, -1.0, &["W", "서경", "西経", "西经"]),
];

/// Marks behind degrees, minutes and seconds.
const MARKS: [&[&str]; 3] = [
    &["°", "˚", "º", "d", "도", "度"],
    &["'", "′", "’", "m", "분", "分"],
    &["\"", "″", "”", "''", "′′", "’’", "s", "초", "秒"],
];

/// The direction at the beginning or the end of a word, and the rest of it.
fn direction(word: &str) -> (Option<(usize, f64)>, &str) {
    for (axis, sign, names) in DIRECTIONS {
        for name in names {
            if let Some(rest) = word.strip_prefix(name).or(word.strip_suffix(name)) {
                return (Some((axis, sign)), rest.trim());
            }
            // Small letters too: 37.5n. Behind degrees and minutes with marks an s is the mark of seconds: 37d30m12.5s.
            let small = name.to_ascii_lowercase();
            let begun = word.strip_prefix(&small);
            let ended = word.strip_suffix(&small).filter(|rest| !(small == "s" && seconds_end(rest)));
            if let Some(rest) = begun.or(ended).filter(|_| name.is_ascii()) {
                return (Some((axis, sign)), rest.trim());
            }
        }
    }
    (None, word)
}

fn seconds_end(rest: &str) -> bool {
    let marks = MARKS[0].iter().chain(MARKS[1]);
    rest.ends_with(|c: char| c.is_ascii_digit()) && marks.into_iter().any(|mark| rest.contains(mark))
}

/// Reads an angle; `None` for anything else.
pub(super) fn angle(word: &str) -> Option<Angle> {
    let (towards, rest) = direction(word.trim());
    let (minus, rest) = match rest.strip_prefix(['-', '\u{2212}']) {
        Some(rest) => (true, rest),
        None => (false, rest.strip_prefix('+').unwrap_or(rest)),
    };
    // "-37 S" is either.
    if minus && towards.is_some() {
        return None;
    }
    let mut parts: Vec<f64> = Vec::new();
    let (mut marked, mut rest) = (towards.is_some(), rest.trim_start());
    while !rest.is_empty() {
        let k = parts.len();
        let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.' && c != ',').unwrap_or(rest.len());
        let (digits, behind) = rest.split_at(end);
        if k == 3 || !digits.starts_with(|c: char| c.is_ascii_digit()) {
            return None;
        }
        let value: f64 = digits.replacen(',', ".", 1).parse().ok()?;
        if k > 0 && value >= 60.0 {
            return None;
        }
        let behind = behind.trim_start();
        // Two marks of minutes are one of seconds: the longest one counts.
        let mark = MARKS[k].iter().filter(|mark| behind.starts_with(**mark)).max_by_key(|mark| mark.len());
        let after = match mark {
            Some(mark) => behind[mark.len()..].trim_start(),
            None => behind.strip_prefix(['-', ':']).unwrap_or(behind),
        };
        let separated = mark.is_some() || after.len() < behind.len() || behind.len() < rest.len() - end;
        // Only the last number has decimals, and nothing but a mark stands behind it.
        let last = after.is_empty();
        if !last && (digits.contains(['.', ',']) || !separated) || last && mark.is_none() && !behind.is_empty() {
            return None;
        }
        marked |= mark.is_some();
        parts.push(value);
        rest = after;
    }
    if parts.is_empty() {
        return None;
    }
    let size = parts.iter().rev().fold(0.0, |below, part| part + below / 60.0);
    let sign = match towards {
        Some((_, sign)) => sign,
        None if minus => -1.0,
        None => 1.0,
    };
    let form = if parts.len() > 1 { AngleForm::Sexagesimal } else { AngleForm::Degrees };
    Some(Angle {
        degrees: sign * size + 0.0,
        form,
        axis: towards.map(|(axis, _)| axis),
        marked: marked || parts.len() > 1,
    })
}

/// The angle of a word that is not a number.
pub(super) fn marked(word: &str) -> Option<Angle> {
    angle(word).filter(|_| is_angle(word))
}

/// Whether it is an angle and not a number: marks or a letter say so, or it has degrees, minutes and seconds. Two numbers may be anything.
pub(super) fn is_angle(word: &str) -> bool {
    if is_numeric(word) {
        return false;
    }
    let sexagesimal = |word: &str| word.split(['-', ':', ' ']).filter(|part| !part.is_empty()).count() > 2;
    let marks = |word: &str| word.contains(|c: char| !c.is_ascii_digit() && !" -+.,:\u{2212}".contains(c));
    angle(word).is_some_and(|angle| angle.marked && (marks(word) || sexagesimal(word) && angle.degrees.abs() < 361.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn one_angle_in_every_form() {
        let wanted = 37.0 + 30.0 / 60.0 + 12.5 / 3600.0;
        for word in [
            "37°30'12.5\"",
            "37 30 12.5",
            "37d30m12.5s",
            "37-30-12.5",
            "37:30:12,5",
            "+37° 30′ 12.5″",
            "37°30'12.5''N",
            "N 37°30'12.5\"",
            "37d30m12.5sN",
            "37 30 12.5 n",
            "북위 37도 30분 12.5초",
            "北緯37度30分12.5秒",
            "37 30.2083333333",
            "37°30.2083333333'",
        ] {
            let found = angle(word).unwrap_or_else(|| panic!("{word}"));
            assert!((found.degrees - wanted).abs() < 1e-11, "{word}: {found:?}");
            assert_eq!(found.form, AngleForm::Sexagesimal, "{word}");
            assert!(found.axis.is_none_or(|axis| axis == 1), "{word}");
        }
        for (word, degrees, axis) in [
            ("37.5", 37.5, None),
            ("-0.25°", -0.25, None),
            ("127,5E", 127.5, Some(0)),
            ("W 0.5", -0.5, Some(0)),
            ("33.9s", -33.9, Some(1)),
            ("-0°30'", -0.5, None),
            ("33-30-00S", -33.5, Some(1)),
            ("서경 3도", -3.0, Some(0)),
        ] {
            let found = angle(word).unwrap_or_else(|| panic!("{word}"));
            assert_eq!((found.degrees, found.axis), (degrees, axis), "{word}");
        }
        for other in [
            "",
            "N",
            "-37.5S",
            "37 60 1",
            "37 30 60",
            "37.5 30 1",
            "37 30 12 1",
            "1e3",
            "12x",
            "37--30",
            "37 30 12.5 O",
            "1.2.3",
            "°",
            "37 30 12.5-",
        ] {
            assert!(angle(other).is_none(), "{other}: {:?}", angle(other));
        }
    }
}
