//! Code shared by the text formats: rows of fields, errors that name the field.
//!
//! Tabs, commas and semicolons make a table that the csv crate reads as a whole, so that a quoted field may hold a separator or the
//! end of a line; fields separated by blanks are words.

use crate::reason::ExchangeReason;
use std::borrow::Cow;

use sightline::error::{Error, Place, Reason, Result, shortened};

/// Rows of the beginning that decide how the fields of a text are separated.
const SAMPLE: usize = 20;

/// A line split into fields.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Line, counted from 1.
    pub line: usize,
    /// Fields without the blanks around them.
    pub fields: Vec<String>,
}

/// The lines that decide how a text is to be read, without quoted parts: separators in quotes do not count.
pub fn sample(text: &str) -> Vec<String> {
    let bare = unquoted(text);
    let lines = bare.as_deref().unwrap_or(text).lines().map(str::trim);
    lines.filter(|line| !comment(line)).take(SAMPLE).map(str::to_owned).collect()
}

/// The text with its quoted fields empty; `None` if a quote has no end, which then is a mark of inches or a slip.
fn unquoted(text: &str) -> Option<String> {
    let (mut quoted, mut start, mut head, mut remark) = (false, true, true, false);
    let mut kept = String::with_capacity(text.len());
    for letter in text.chars() {
        remark = !quoted && letter != '\n' && (remark || head && matches!(letter, '#' | '%'));
        head = !quoted && (letter == '\n' || head && letter.is_whitespace());
        match letter {
            // doubled ones inside end the field and begin it again
            '"' if !remark && (quoted || start) => {
                quoted = !quoted;
                kept.push('"');
            }
            _ if quoted => continue,
            _ => {
                start = matches!(letter, ',' | ';' | '\t' | '\n' | '\r');
                kept.push(letter);
            }
        }
    }
    (!quoted).then_some(kept)
}

fn comment(line: &str) -> bool {
    line.is_empty() || line.starts_with(['#', '%'])
}

/// Whether most lines have a mark.
pub fn most(lines: &[String], mark: char) -> bool {
    2 * lines.iter().filter(|line| line.contains(mark)).count() > lines.len()
}

/// Rows of a text whose fields are separated by tabs, commas, semicolons or blanks; blank lines, comments (#, %) and empty fields at
/// the end of a line are left out. A line without the mark of the others is split by the one it has.
pub fn rows(text: &str) -> Vec<Row> {
    let lines = sample(text);
    let count = |mark| lines.iter().filter(|line| line.contains(mark)).count();
    let (commas, semicolons) = (count(','), count(';'));
    let separator = match () {
        () if most(&lines, '\t') => b'\t',
        () if commas + semicolons == 0 => return words(text),
        // With both in every line the commas are decimal ones.
        () if semicolons >= commas => b';',
        () => b',',
    };
    let lines: Vec<&str> = text.lines().collect();
    let mut rows = table(text, separator);
    for row in &mut rows {
        if row.fields.len() == 1 {
            let line = lines.get(row.line - 1).copied().unwrap_or_default();
            let split = |mark| table(line, mark).pop().filter(|other| other.fields.len() > 1);
            let quoted = line.trim_start().starts_with('"');
            let blanks = || (!quoted).then(|| Row::words(row.line, line));
            if let Some(other) = [b';', b',', b'\t'].into_iter().find_map(split).or_else(blanks) {
                row.fields = other.fields;
            }
        }
        let held = row.fields.iter().rposition(|field| !field.is_empty()).map_or(0, |last| last + 1);
        row.fields.truncate(held);
    }
    rows
}

/// Rows of words.
pub fn words(text: &str) -> Vec<Row> {
    let lines = text.lines().enumerate().filter(|(_, line)| !comment(line.trim()));
    lines.map(|(index, line)| Row::words(index + 1, line)).collect()
}

/// Rows of a table with this separator; a quoted field may hold separators, quotes and ends of lines.
pub fn table(text: &str, separator: u8) -> Vec<Row> {
    records(&without_comments(text, separator), separator)
}

/// Rows of cells as spreadsheets copy them, separated by tabs; they have no comments, "#1" is a name there.
pub fn pasted(text: &str) -> Vec<Row> {
    records(text, b'\t')
}

fn records(text: &str, separator: u8) -> Vec<Row> {
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let mut rows = Vec::new();
    // A text in memory is always read, whatever is in it.
    for record in reader.records().flatten() {
        if record.iter().all(str::is_empty) {
            continue;
        }
        // The reader's position lies before the blank lines that it passes over.
        let (byte, line) = record.position().map_or((0, 1), |at| (at.byte() as usize, at.line() as usize));
        let blank = text.get(byte..).unwrap_or_default().lines().take_while(|line| line.is_empty()).count();
        rows.push(Row { line: line + blank, fields: record.iter().map(str::to_owned).collect() });
    }
    rows
}

/// The text with its comments as blank lines. Inside of quotes there are none.
fn without_comments(text: &str, separator: u8) -> String {
    let mut quoted = false;
    let mut kept = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        if !quoted && comment(line.trim()) {
            kept.push('\n');
            continue;
        }
        kept.push_str(line);
        // Quotes count at the beginning of a field, and doubled ones inside not at all: both leave the parity as it is.
        let mut start = true;
        for byte in line.bytes() {
            match byte {
                b'"' if quoted || start => quoted = !quoted,
                _ if quoted => {}
                _ => start = byte == separator,
            }
        }
    }
    kept
}

impl Row {
    /// The words of a line.
    pub fn words(line: usize, text: &str) -> Self {
        Self { line, fields: text.split_whitespace().map(str::to_owned).collect() }
    }

    /// Text of a field.
    pub fn text(&self, index: usize, name: &str) -> Result<&str> {
        let field = self.fields.get(index).map(String::as_str).filter(|field| !field.is_empty());
        let missing = || ExchangeReason::MissingField { name: name.into(), fields: self.fields.len() }.into();
        field.ok_or_else(|| self.invalid(name, missing()))
    }

    /// Number in a field.
    pub fn number(&self, index: usize, name: &str) -> Result<f64> {
        let field = self.text(index, name)?;
        let wrong = || Reason::NotANumber { name: name.into(), text: shortened(field) };
        number(field).ok_or_else(|| self.invalid(name, wrong()))
    }

    /// Whole number in a field.
    pub fn whole(&self, index: usize, name: &str) -> Result<u32> {
        let field = self.text(index, name)?;
        let wrong = || ExchangeReason::NotWhole { name: name.into(), text: shortened(field) }.into();
        field.parse().map_err(|_| self.invalid(name, wrong()))
    }

    /// An error in a field of this line.
    pub fn invalid(&self, name: &str, reason: Reason) -> Error {
        Error::Invalid { reason, at: Place::line(self.line).with_field(name) }
    }

    /// A number that must be above 0.
    pub fn positive(&self, index: usize, name: &str) -> Result<f64> {
        let value = self.number(index, name)?;
        let wrong = || Reason::NotPositive { name: name.into(), value: value.into() };
        if value > 0.0 { Ok(value) } else { Err(self.invalid(name, wrong())) }
    }
}

/// What a spreadsheet would run as a formula, with an apostrophe before it, which spreadsheets take for "this is text".
///
/// Cells that begin with = + - @ tab or return are meant, numbers excepted; those that begin with apostrophes and such a mark get one
/// more, so that [`armed`] gives every field back.
pub fn disarmed(field: &str) -> Cow<'_, str> {
    let behind = field.trim_start_matches('\'');
    if behind.starts_with(FORMULA) && (behind.len() < field.len() || number(field).is_none()) {
        format!("'{field}").into()
    } else {
        field.into()
    }
}

/// A field without the apostrophe that [`disarmed`] set before it.
pub fn armed(field: &str) -> &str {
    match field.strip_prefix('\'') {
        Some(rest) if rest.trim_start_matches('\'').starts_with(FORMULA) => rest,
        _ => field,
    }
}

/// Characters with which formulas begin; spreadsheets in East Asian settings take the full-width forms, too.
const FORMULA: [char; 10] = ['=', '+', '-', '@', '\t', '\r', '＝', '＋', '－', '＠'];

/// A finite number with a decimal point.
pub fn number(text: &str) -> Option<f64> {
    // `parse` also takes "inf" and "nan", which no measurement is.
    text.parse().ok().filter(|value: &f64| value.is_finite())
}

/// A field in quotes where it needs them to be read back: separators, quotes, ends of lines, a first mark of comments.
pub fn quoted(field: &str, separator: char) -> Cow<'_, str> {
    if field.contains([separator, ';', '"', '\n', '\r']) || field.starts_with(['#', '%']) {
        Cow::from(format!("\"{}\"", field.replace('"', "\"\"")))
    } else {
        Cow::from(field)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn a_wrong_field_is_named() {
        let rows = rows("# c\n\n 1, x , 2");
        let row = &rows[0];
        assert_eq!((row.line, row.fields.len()), (3, 3));
        let error = row.number(1, "u").unwrap_err();
        assert_eq!(error.place(), Place::line(3).with_field("u"));
        assert!(row.number(5, "sigma").is_err());
        assert_eq!(number("inf"), None);
    }

    fn fields(text: &str) -> Vec<(usize, Vec<String>)> {
        rows(text).into_iter().map(|row| (row.line, row.fields)).collect()
    }

    #[test]
    fn lines_of_several_hands_are_split_by_what_they_have() {
        let of = |line: usize, fields: &[&str]| (line, fields.iter().map(|f| (*f).to_owned()).collect::<Vec<_>>());
        assert_eq!(fields("1 2;3"), [of(1, &["1 2", "3"])]);
        assert_eq!(fields("a\tb  c\n\n# d\ne f"), [of(1, &["a", "b", "c"]), of(4, &["e", "f"])]);
        assert_eq!(fields("1, 2\n3;4\n5 6\n"), [of(1, &["1", "2"]), of(2, &["3", "4"]), of(3, &["5", "6"])]);
        assert_eq!(fields("1,2\n\"a;b\";3\n5\t6"), [of(1, &["1", "2"]), of(2, &["a;b", "3"]), of(3, &["5", "6"])]);
        assert_eq!(fields("a;b\nc;d\n1,2"), [of(1, &["a", "b"]), of(2, &["c", "d"]), of(3, &["1", "2"])]);
    }

    #[test]
    fn a_quoted_field_holds_anything() {
        let text = "% a \"comment\n\"5,6\",1\n\n  # another, one\n\"two\nlines\n# no comment\",\"say \"\"a\"\"\"\n5\" pipe,2\n# end\n\"a b\"\n";
        let rows = fields(text);
        let lines: Vec<usize> = rows.iter().map(|row| row.0).collect();
        assert_eq!(lines, [2, 5, 8, 10], "{rows:?}");
        assert_eq!(rows[0].1, ["5,6", "1"]);
        assert_eq!(rows[1].1, ["two\nlines\n# no comment", "say \"a\""]);
        assert_eq!(rows[2].1, ["5\" pipe", "2"]);
        assert_eq!(rows[3].1, ["a b"]);
    }

    #[test]
    fn a_mark_in_quotes_separates_nothing() {
        let rows = fields("# it's \"a\tb\n\"1\t2\",\"a;b\rc\",3\n\"a\t;\"\"\",#\t,4\n");
        assert_eq!(rows.iter().map(|row| row.1.len()).collect::<Vec<_>>(), [3, 3], "{rows:?}");
        assert_eq!((rows[0].1[1].as_str(), rows[1].1[0].as_str()), ("a;b\rc", "a\t;\""));
        // a quote without an end is a slip
        assert_eq!(fields("\"1;2;3\n4;5;6\n").len(), 1);
        assert_eq!(fields("5\" pipe;2;3\n4\";5;6\n")[1].1, ["4\"", "5", "6"]);
    }

    #[test]
    fn tables_with_tabs_keep_blanks_and_empty_fields() {
        let text = "photo\tpoint\tu\r\n# a note\r\nP 1\t\t5,6\t\t\r\n\"a\tb\"\t\"say \"\"c\"\"\"\t7\r\n1 2 3\r\n";
        let rows = fields(text);
        assert_eq!(rows.iter().map(|row| row.0).collect::<Vec<_>>(), [1, 3, 4, 5], "{rows:?}");
        assert_eq!(rows[1].1, ["P 1", "", "5,6"]);
        assert_eq!(rows[2].1, ["a\tb", "say \"c\"", "7"]);
        assert_eq!(rows[3].1, ["1", "2", "3"]);
    }

    #[test]
    fn pasted_cells_are_no_comments() {
        let rows = pasted("#1\ttwo words\t\n\n\"two\nlines\"\t%\n");
        let cells: Vec<&[String]> = rows.iter().map(|row| row.fields.as_slice()).collect();
        assert_eq!(cells, [["#1", "two words", ""].as_slice(), &["two\nlines", "%"]]);
    }

    #[test]
    fn formulas_are_disarmed_and_come_back() {
        for (field, written) in [
            ("=1+1", "'=1+1"),
            ("+x", "'+x"),
            ("-A1", "'-A1"),
            ("@SUM(A1)", "'@SUM(A1)"),
            ("＝1+1", "'＝1+1"),
            ("＋x", "'＋x"),
            ("－x", "'－x"),
            ("＠x", "'＠x"),
            ("\tx", "'\tx"),
            ("'=1", "''=1"),
            ("-5", "-5"),
            ("+0.5e-3", "+0.5e-3"),
            ("it's", "it's"),
            ("'", "'"),
            ("", ""),
        ] {
            assert_eq!(disarmed(field), written);
            assert_eq!(armed(written), field);
        }
    }

    #[test]
    fn quoted_fields_are_read_back() {
        for id in ["plain", "5,6", "a;b", "say \"a\"", "two\nlines", "#1", "%", "a b"] {
            let line = format!("{},1\n{},2\n", quoted(id, ','), quoted(id, ','));
            assert_eq!(fields(&line).iter().map(|row| row.1[0].as_str()).collect::<Vec<_>>(), [id, id], "{line}");
        }
    }
}
