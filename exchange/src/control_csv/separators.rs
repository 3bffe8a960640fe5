//! The field separator of a table, and whether it may separate decimals or thousands too.

use super::super::text::{self, Row};
use super::columns::{Columns, Field};
use super::conventions::Separator;

/// Separator of the fields of a text.
///
/// A tab or semicolon anywhere in the first rows decides; commas separate unless splitting at blanks leaves each as
/// a decimal comma inside a number ("7 0,5 1,25 3").
pub(super) fn separator_of(text: &str) -> Separator {
    let rows = text::sample(text);
    if text::most(&rows, '\t') {
        return Separator::Tab;
    }
    if text::most(&rows, ';') {
        return Separator::Semicolon;
    }
    let decimal = |word: &str| match word.split_once(',') {
        None => true,
        Some((whole, rest)) => {
            let digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
            digits(whole.trim_start_matches(['-', '+'])) && digits(rest)
        }
    };
    // A first word with a comma is an id and the beginning of a coordinate: "P1,-4 457,6 348" has blanks between thousands.
    let spaced = |row: &String| {
        let mut words = row.split_whitespace();
        words.clone().count() >= 4 && words.next().is_some_and(|id| !id.contains(',')) && words.all(decimal)
    };
    if text::most(&rows, ',') && !rows.iter().all(spaced) { Separator::Comma } else { Separator::Blanks }
}

/// Whether what separates the fields may be a decimal or thousands separator too.
///
/// Two neighbouring fields can be one number where the first is a whole number and the second only digits: without any decimal point
/// in the table a comma may be a decimal comma; a comma or a blank before exactly three digits may separate thousands. That matters where
/// such a reading would leave fewer columns: a row has more fields than the heading names, or there is no heading and a row has more
/// fields than id, label and three coordinates.
pub(super) fn separates_both_ways(
    separator: Separator,
    rows: &[&[String]],
    has_heading: bool,
    columns: &Columns,
) -> bool {
    let commas = match separator {
        Separator::Comma => true,
        Separator::Blanks => false,
        Separator::Semicolon | Separator::Tab => return false,
    };
    let first = [Field::X, Field::Y, Field::Z].into_iter().filter_map(|field| columns.place(field)).min().unwrap_or(1);
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    // Blanks may separate thousands in a field of their own: "6 013".
    let unsigned =
        |text: &str| text.trim_start_matches(['-', '+']).replace([' ', '\u{a0}', '\u{2009}', '\u{202f}'], "");
    let fields = rows.iter().flat_map(|row| row.iter().skip(first));
    let pointed = || fields.clone().filter(|word| word.contains('.') && word.parse::<f64>().is_ok());
    // "2.195": a thousands point as well as a decimal one.
    let grouped = |text: &str| {
        text.split_once('.').is_some_and(|(whole, group)| {
            (1..=3).contains(&whole.len())
                && !whole.starts_with('0')
                && digits(whole)
                && group.len() == 3
                && digits(group)
        })
    };
    // Whether some point is a decimal point for certain.
    let points = pointed().any(|word| !grouped(&unsigned(word)));
    let joins = |pair: &[String]| {
        let [a, b] = pair else { return false };
        let (a, b) = (unsigned(a), b.as_str());
        if commas && !points && (digits(&a) || grouped(&a)) && digits(b) {
            return true;
        }
        let group = b.split(['.', ',']).next().unwrap_or_default();
        let rest = b[group.len()..].trim_start_matches(['.', ',']);
        let short = a.len() <= 3 && !a.starts_with('0');
        digits(&a) && short && group.len() == 3 && digits(group) && (rest.is_empty() || digits(rest))
    };
    let joinable = |row: &&[String]| row.get(first..).is_some_and(|fields| fields.windows(2).any(joins));
    let described = columns.fields.iter().filter(|field| **field == Some(Field::Label)).count();
    let plain = if has_heading { columns.fields.len() } else { 4 + described };
    let wide = |row: &&&[String]| {
        // Without points the fields at the end may be empty standard errors that were pushed out.
        let held = row.iter().rposition(|field| !field.is_empty()).map_or(0, |last| last + 1);
        (if points { held } else { row.len() }) > plain
    };
    let wide: Vec<&&[String]> = rows.iter().filter(wide).collect();
    if has_heading {
        return wide.into_iter().any(joinable);
    }
    // Columns of their own are in every row; what is joined in some rows only leaves rows of other lengths.
    let ragged = rows.iter().any(|row| row.len() != rows[0].len());
    wide.iter().any(|row| joinable(row)) && (ragged || wide.iter().all(|row| joinable(row)))
}

/// The rows of a text.
pub(super) fn table(text: &str, separator: Separator) -> Vec<Row> {
    match separator.byte() {
        Some(byte) => text::table(text, byte),
        None => {
            let mut rows = text::words(text);
            // "X [m] Y [m]": a unit belongs to the word before it.
            for row in &mut rows {
                let mut joined: Vec<String> = Vec::new();
                for word in std::mem::take(&mut row.fields) {
                    match joined.last_mut() {
                        Some(last) if word.starts_with(['[', '(']) => *last += &word,
                        _ => joined.push(word),
                    }
                }
                row.fields = joined;
            }
            rows
        }
    }
}
