//! The decimal sign of a table's numbers, or that it is undecided.
//!
//! One comma with exactly three digits behind it and one to three digits before it that do not begin with 0 is a decimal comma in
//! German and a thousands separator in English and Korean. Any other comma decides for the whole table, since one text has one
//! decimal sign.

use super::angles;
use super::conventions::{Basis, Decimal};

/// What a number's commas and points show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// No comma and no point, or no number.
    None,
    /// A decimal point.
    Point,
    /// A decimal comma.
    Comma,
    /// Thousands or thousandths.
    Either,
}

/// Meaning of one number.
pub fn sign_of(word: &str) -> Sign {
    let digits = word.trim_start_matches(['-', '+', '\u{2212}']);
    if !digits.bytes().all(|byte| byte.is_ascii_digit() || b"+-.,eE".contains(&byte)) {
        return Sign::None;
    }
    let mut commas = digits.match_indices(',');
    match (digits.contains('.'), commas.next(), commas.next()) {
        (true, None, _) => Sign::Point,
        (false, Some((at, _)), None) => {
            let (whole, rest) = (&digits[..at], &digits[at + 1..]);
            let all = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
            let thousands = (1..=3).contains(&whole.len()) && !whole.starts_with('0') && all(whole) && all(rest);
            if rest.len() == 3 && thousands { Sign::Either } else { Sign::Comma }
        }
        // Several commas, or both signs, are no sign by themselves: the number is refused in either case.
        _ => Sign::None,
    }
}

/// Whether it is a number of either decimal sign.
pub fn is_numeric(word: &str) -> bool {
    word.replacen(',', ".", 1).parse::<f64>().is_ok()
}

/// Whether it is a number of either decimal sign or an angle.
pub(super) fn is_value(word: &str) -> bool {
    is_numeric(word) || angles::is_angle(word)
}

/// The decimal sign of all numbers, what it rests on, and a number that stays undecided.
pub fn decide<'a>(numbers: impl Iterator<Item = &'a str>, given: Option<Decimal>) -> (Decimal, Basis, Option<String>) {
    let mut either = None;
    let mut first = None;
    for word in numbers {
        match sign_of(word) {
            Sign::Point => _ = first.get_or_insert(Decimal::Point),
            Sign::Comma => _ = first.get_or_insert(Decimal::Comma),
            Sign::Either => _ = either.get_or_insert_with(|| word.to_owned()),
            Sign::None => {}
        }
    }
    match (given, first, either) {
        (Some(sign), _, example) => (sign, Basis::Given, example),
        (None, Some(sign), _) => (sign, Basis::Content, None),
        (None, None, Some(example)) => (Decimal::Comma, Basis::Undecided, Some(example)),
        (None, None, None) => (Decimal::Point, Basis::Convention, None),
    }
}

/// The two readings of an ambiguous number, decimal comma first.
pub fn readings(word: &str) -> [String; 2] {
    [word.replacen(',', ".", 1), word.replacen(',', "", 1)]
}

/// A number without its thousands separators; none where they do not stand before groups of three digits.
pub fn without_thousands(word: &str) -> Option<String> {
    let (whole, rest) = word.split_once('.').map_or((word, None), |(whole, rest)| (whole, Some(rest)));
    let mut groups = whole.trim_start_matches(['-', '+']).split(',');
    let first = groups.next()?;
    let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let good = (1..=3).contains(&first.len())
        && digits(first)
        && groups.all(|group| group.len() == 3 && digits(group))
        && rest.is_none_or(digits);
    let plain = whole.replace(',', "");
    good.then(|| rest.map_or(plain.clone(), |rest| format!("{plain}.{rest}")))
}
