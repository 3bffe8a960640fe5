//! Numbers as people read and type them. How they are shown is the engine's, the same as in the report.

use sightline::report::number::{GROUP, MINUS};
pub use sightline::report::number::{
    compact, count, decimals_for, decimals_of, fixed, maybe, power, round, round_below, three_digits, with_sigma,
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

/// A number that somebody typed, with either decimal sign and either minus.
pub fn parse(text: &str) -> Option<f64> {
    let plain = text.trim().replace(MINUS, "-").replace([GROUP, ' '], "").replace(',', ".");
    plain.parse::<f64>().ok().filter(|v| v.is_finite())
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
    }
}
