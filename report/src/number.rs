//! Formatting of numbers, the same in the report and on the desk: as many digits as two digits of the standard error. Exports
//! of data do not pass through here.

/// Thin space between groups of three digits.
pub const GROUP: char = '\u{2009}';
/// The typographic minus, as wide as a digit.
pub const MINUS: char = '\u{2212}';

/// A count, grouped in threes: 3 677.
pub fn count(n: usize) -> String {
    grouped(&n.to_string())
}

fn grouped(digits: &str) -> String {
    if digits.len() < 4 {
        return digits.to_owned();
    }
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(GROUP);
        }
        text.push(digit);
    }
    text
}

/// A number with fixed decimals; its integer part grouped, its minus typographic, and no minus before zeros.
pub fn fixed(value: f64, decimals: usize) -> String {
    let plain = format!("{:.decimals$}", value.abs());
    let negative = value < 0.0 && plain.chars().any(|c| c.is_ascii_digit() && c != '0');
    let (whole, rest) = plain.split_once('.').map_or((plain.as_str(), None), |(w, r)| (w, Some(r)));
    let mut text = String::new();
    if negative {
        text.push(MINUS);
    }
    text.push_str(&grouped(whole));
    if let Some(rest) = rest {
        text.push('.');
        text.push_str(rest);
    }
    text
}

/// As `fixed`, and a dash where there is no number.
pub fn maybe(value: Option<f64>, decimals: usize) -> String {
    value.map_or_else(|| "–".to_owned(), |value| fixed(value, decimals))
}

/// Decimals that show two digits of a standard error.
pub fn decimals_for(sigma: f64) -> usize {
    if sigma > 0.0 && sigma.is_finite() { (1.0 - sigma.log10().floor()).clamp(0.0, 12.0) as usize } else { 3 }
}

/// Decimals that show two digits of a value that may be much smaller than what its column is rounded to: at least `least` of
/// them, and at most four more.
pub fn decimals_of(value: f64, least: usize) -> usize {
    let small = value != 0.0 && value.is_finite();
    if small { decimals_for(value.abs()).clamp(least, least + 4) } else { least }
}

/// A number as mantissa and power of ten where it is very large or very small.
pub fn scientific(value: f64) -> (String, Option<i32>) {
    let size = value.abs();
    if size == 0.0 || !size.is_finite() {
        return (fixed(value, 0), None);
    }
    let exponent = size.log10().floor() as i32;
    if (-3..5).contains(&exponent) {
        let decimals = (4 - exponent).clamp(0, 6) as usize;
        (fixed(value, decimals), None)
    } else {
        (fixed(value / 10f64.powi(exponent), 2), Some(exponent))
    }
}

/// A power of ten in superscript digits.
pub fn power(exponent: i32) -> String {
    let digit = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        c => char::from_u32('⁰' as u32 + c as u32 - '0' as u32).unwrap_or(c),
    };
    format!("10{}", exponent.to_string().chars().map(digit).collect::<String>())
}

/// The number in one piece: 3.5 × 10⁻⁵.
pub fn compact(value: f64) -> String {
    match scientific(value) {
        (text, None) => text,
        (text, Some(exponent)) => format!("{text} × {}", power(exponent)),
    }
}

/// A positive factor to five digits: 25.4, or 1/25.4 below one.
pub fn factor(value: f64) -> String {
    if value > 0.0 && value < 1.0 { format!("1/{}", round_to_five(1.0 / value)) } else { round_to_five(value) }
}

/// Five digits without idle zeros.
fn round_to_five(value: f64) -> String {
    let digits = 4 - value.abs().max(1e-300).log10().floor() as i32;
    let unit = 10f64.powi(digits);
    format!("{}", (value * unit).round() / unit)
}

/// A round number without idle zeros: 200, 0.1, 5 × 10⁻⁶.
pub fn round(value: f64) -> String {
    match scientific(value) {
        (text, None) if text.contains('.') => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        (text, None) => text,
        (text, Some(exponent)) => {
            let text = text.trim_end_matches('0').trim_end_matches('.').to_owned();
            format!("{text} × {}", power(exponent))
        }
    }
}

/// A value with its standard error, in powers of ten where both are small: value, standard error and the power.
pub fn with_sigma(value: f64, sigma: Option<f64>) -> (String, String, i32) {
    let size = value.abs().max(sigma.unwrap_or(0.0));
    let exponent = if size > 0.0 && size < 0.01 { size.log10().floor() as i32 } else { 0 };
    let power = 10f64.powi(exponent);
    let decimals = sigma.map_or(6, |s| decimals_for(s / power));
    (fixed(value / power, decimals), sigma.map_or("–".into(), |s| fixed(s / power, decimals)), exponent)
}

/// Three significant digits of a large number: more would pretend.
pub fn three_digits(n: f64) -> usize {
    let power = 10f64.powf((n.max(1.0).log10().floor() - 2.0).max(0.0));
    ((n / power).round() * power) as usize
}

/// The largest of 1, 2, 5 times a power of ten that is not above a number.
pub fn round_below(x: f64) -> f64 {
    let power = 10f64.powf(x.log10().floor());
    let step = x / power;
    let first = if step >= 5.0 {
        5.0
    } else if step >= 2.0 {
        2.0
    } else {
        1.0
    };
    first * power
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn a_value_far_below_its_column_keeps_two_digits() {
        let shown = |value: f64, least: usize| fixed(value, decimals_of(value, least));
        // The redundancy number and the residual of a distance that is much better than the photos.
        assert_eq!(shown(0.000_43, 2), "0.00043");
        assert_eq!(shown(-0.000_012, 3), "\u{2212}0.000012");
        assert_eq!(shown(0.43, 2), "0.43");
        assert_eq!(shown(1.0, 2), "1.00");
        assert_eq!(shown(0.0, 2), "0.00");
        assert_eq!(shown(1e-12, 2), "0.000000");
    }

    #[test]
    fn numbers_are_grouped_and_never_minus_zero() {
        assert_eq!(count(3677), "3\u{2009}677");
        assert_eq!(count(239), "239");
        assert_eq!(fixed(-1234567.891, 2), "\u{2212}1\u{2009}234\u{2009}567.89");
        assert_eq!(fixed(-0.0004, 3), "0.000");
    }

    #[test]
    fn sigmas_show_two_digits() {
        assert_eq!(decimals_for(0.0193), 3);
        assert_eq!(decimals_for(1.93), 1);
        assert_eq!(decimals_for(19.3), 0);
        assert_eq!(decimals_for(0.0), 3);
    }

    #[test]
    fn small_numbers_have_powers_of_ten() {
        assert_eq!(compact(3.5e-5), "3.50 × 10⁻⁵");
        assert_eq!(compact(58.84), "58.840");
        assert_eq!(compact(0.0), "0");
        assert_eq!((round(200.0), round(0.1), round(5e-6)), ("200".into(), "0.1".into(), "5 × 10⁻⁶".into()));
    }

    #[test]
    fn exaggerations_are_round() {
        for (x, round) in [(7.3, 5.0), (1234.0, 1000.0), (0.027, 0.02), (1.0, 1.0)] {
            assert!((round_below(x) / round - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_value_has_the_digits_of_its_standard_error() {
        assert_eq!(with_sigma(28.311_84, Some(0.0016)), ("28.3118".into(), "0.0016".into(), 0));
        assert_eq!(with_sigma(-4.5e-5, Some(2.7e-6)), ("\u{2212}4.50".into(), "0.27".into(), -5));
        assert_eq!(three_digits(161_234.0), 161_000);
    }
}
