//! Numbers as people read and type them. How they are shown is the engine's, the same as in the report.

use sightline::project::LARGEST;
use sightline_exchange::control_csv::{Sign, decimal_readings, sign_of, without_thousands};
use sightline_report::number::{GROUP, MINUS};
pub use sightline_report::number::{
    compact, count, decimals_for, decimals_of, factor, fixed, maybe, power, round, round_below, three_digits,
    with_sigma,
};

/// A length as a reviewer types it back: enough digits, no grouping.
pub fn editable(value: f64) -> String {
    let text = format!("{value}");
    if text.len() <= 12 {
        return text;
    }
    let short = format!("{value:.8e}").parse::<f64>().map_or(text, |v| format!("{v}"));
    if short.len() > 14 { format!("{value:.6e}") } else { short }
}

/// The typed text with an ordinary minus and without blanks, and whether blanks separated thousands.
fn bare(text: &str) -> (String, bool) {
    let text = text.trim().replace(MINUS, "-");
    let plain = text.replace([GROUP, ' ', '\u{a0}', '\u{202f}'], "");
    let grouped = plain.len() < text.len();
    (plain, grouped)
}

/// A typed number, with either decimal sign and either minus. One that can be read in two ways ("1,234") is none: see
/// [`ambiguous`]. Thousands separators are taken where they leave one reading ("1,234.5", "1.234,5", "1,234,567").
pub fn parse(text: &str) -> Option<f64> {
    if ambiguous(text).is_some() {
        return None;
    }
    let (plain, _) = bare(text);
    let swapped = || {
        plain
            .chars()
            .map(|c| {
                if c == ',' {
                    '.'
                } else if c == '.' {
                    ','
                } else {
                    c
                }
            })
            .collect::<String>()
    };
    let written = match (plain.matches(',').count(), plain.matches('.').count()) {
        (0, 0 | 1) => plain,
        (1, 0) => plain.replace(',', "."),
        (commas, points) => {
            let last_comma = plain.rfind(',') > plain.rfind('.');
            let english = points <= 1 && !(last_comma && points == 1);
            match english {
                true => without_thousands(&plain)?,
                false if commas <= 1 => without_thousands(&swapped())?,
                false => return None,
            }
        }
    };
    written.parse::<f64>().ok().filter(|v| v.abs() < LARGEST)
}

/// The two readings of a number with one comma before exactly three digits, that of a decimal comma first; `None` if only one
/// is possible.
pub fn ambiguous(text: &str) -> Option<[String; 2]> {
    let (plain, grouped) = bare(text);
    (!grouped && sign_of(&plain) == Sign::Either).then(|| decimal_readings(&plain))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn typed_numbers_are_read_back() {
        assert_eq!(parse(" \u{2212}1,5 "), Some(-1.5));
        assert_eq!(parse(&editable(0.003191)), Some(0.003191));
        assert_eq!(parse("x"), None);
        assert_eq!(parse("inf"), None);
        assert_eq!((parse("1e99"), parse("1e100")), (Some(1e99), None));
    }

    #[test]
    fn a_comma_before_three_digits_is_no_guess() {
        for typed in ["1,234", "-12,345", "\u{2212}123,456", " 1,000 "] {
            assert_eq!(parse(typed), None, "{typed}");
            let [decimal, thousands] = ambiguous(typed).expect("two readings");
            assert_eq!(parse(&decimal).map(|v| v * 1000.0), parse(&thousands), "{typed}");
        }
        for (typed, value) in [
            ("0,123", 0.123),
            ("1234,567", 1234.567),
            ("1 234,567", 1234.567),
            ("1,5", 1.5),
            ("1,2345", 1.2345),
            ("1.234", 1.234),
            ("1,234.5", 1234.5),
            ("1.234,5", 1234.5),
            ("1,234,567", 1_234_567.0),
            ("-1.234.567", -1_234_567.0),
            ("1 234 567.5", 1_234_567.5),
            ("1e3", 1000.0),
        ] {
            assert_eq!((parse(typed), ambiguous(typed)), (Some(value), None), "{typed}");
        }
        for typed in ["1,23,456", "1.2,3.4", "12,34,5", "1,2.3,4", ",", "1..2", "1,,2", "1.234,567.8"] {
            assert_eq!(parse(typed), None, "{typed}");
        }
    }
}
