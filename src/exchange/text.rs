//! What the text formats share: decoding, rows of numbers, fields that are named when they are wrong.

use crate::error::{Error, Place, Reason, Result, shortened};

/// Text of a file: UTF-8 with or without a mark, UTF-16 with one (spreadsheets write it).
pub fn decode(bytes: &[u8]) -> Result<String> {
    let utf16 = |pairs: &[u8], unit: fn([u8; 2]) -> u16| {
        let units = pairs.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
        char::decode_utf16(units).collect::<std::result::Result<String, _>>().map_err(|_| not_text())
    };
    match bytes {
        [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes),
        [0xef, 0xbb, 0xbf, rest @ ..] => String::from_utf8(rest.to_vec()).map_err(|_| not_text()),
        _ if bytes.contains(&0) => Err(not_text()),
        _ => String::from_utf8(bytes.to_vec()).map_err(|_| not_text()),
    }
}

fn not_text() -> Error {
    Error::Invalid { reason: Reason::NotText, at: Place::default() }
}

/// A line split into fields.
#[derive(Clone, Debug, PartialEq)]
pub struct Row<'a> {
    /// Line, counted from 1.
    pub line: usize,
    /// Fields without the blanks around them.
    pub fields: Vec<&'a str>,
}

/// Rows of a text whose fields are separated by commas, semicolons or blanks, any mixture; blank lines and comments
/// (#, %) are left out.
pub fn rows(text: &str) -> impl Iterator<Item = Row<'_>> {
    text.lines().enumerate().filter_map(|(number, line)| {
        let line = line.trim();
        if line.is_empty() || line.starts_with(['#', '%']) {
            return None;
        }
        let fields = if line.contains([',', ';']) {
            line.split([',', ';']).map(str::trim).collect()
        } else {
            line.split_whitespace().collect()
        };
        Some(Row { line: number + 1, fields })
    })
}

impl Row<'_> {
    /// Text of a field.
    pub fn text(&self, index: usize, name: &str) -> Result<&str> {
        let field = self.fields.get(index).copied().filter(|field| !field.is_empty());
        let missing = || Reason::MissingField { name: name.into(), fields: self.fields.len() };
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
        let wrong = || Reason::NotWhole { name: name.into(), text: shortened(field) };
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

/// A finite number with a decimal point.
pub fn number(text: &str) -> Option<f64> {
    // `parse` also takes "inf" and "nan", which no measurement is.
    text.parse().ok().filter(|value: &f64| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn encodings_of_spreadsheets_are_read() {
        assert_eq!(decode("\u{feff}ä,1".as_bytes()).unwrap(), "ä,1");
        let little: Vec<u8> =
            [0xff, 0xfe].into_iter().chain("ä\t1".encode_utf16().flat_map(u16::to_le_bytes)).collect();
        assert_eq!(decode(&little).unwrap(), "ä\t1");
        assert!(decode(&[0x89, b'P', 0, 1]).is_err());
        assert!(decode(&[0xe4, b'a']).is_err());
    }

    #[test]
    fn a_wrong_field_is_named() {
        let row = rows("# c\n\n 1, x , 2").next().unwrap();
        assert_eq!((row.line, row.fields.len()), (3, 3));
        let error = row.number(1, "u").unwrap_err();
        assert_eq!(error.place(), Place::line(3).with_field("u"));
        assert!(row.number(5, "sigma").is_err());
        assert_eq!(number("inf"), None);
        assert_eq!(rows("1 2;3").next().unwrap().fields, ["1 2", "3"]);
    }
}
