//! Control points as spreadsheets and surveyors write them: id, X, Y, Z and, where known, a sigma for each axis.
//!
//! Fields are separated by tabs, semicolons, commas or blanks; a heading, a label after the id, comments (#, %) and quoted
//! fields are recognised. Numbers may have a decimal comma where commas do not separate fields, but one text has one
//! decimal mark: "1.234" beside "0,5" would be a guess between thousands and thousandths. Every row stands for itself: the good ones
//! are kept and each bad one says what is wrong in which field of which line.

mod columns;

use std::collections::HashMap;
use std::fmt::Write;

use columns::{Columns, Field};

use super::text::{self, Row};
use crate::error::{Error, Lack, Place, Reason, Result, Thing, shortened};
use crate::project::{Point, Role};

/// A row of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlRow {
    /// Line, counted from 1.
    pub line: usize,
    /// Second name, as surveyors give one.
    pub label: Option<String>,
    /// The point.
    pub point: Point,
}

/// A table of control points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ControlTable {
    /// Its rows; a bad one is an error with line and field.
    pub rows: Vec<Result<ControlRow>>,
}

impl ControlTable {
    /// The good points, and what is wrong with the others.
    pub fn split(self) -> (Vec<Point>, Vec<Error>) {
        let (mut points, mut errors) = (Vec::new(), Vec::new());
        for row in self.rows {
            match row {
                Ok(row) => points.push(row.point),
                Err(error) => errors.push(error),
            }
        }
        (points, errors)
    }

    /// All points.
    ///
    /// # Errors
    /// The first bad row's error; [`Error::Empty`] without rows.
    pub fn into_points(self) -> Result<Vec<Point>> {
        if self.rows.is_empty() {
            return Err(Error::Empty { what: Lack::Points });
        }
        self.rows.into_iter().map(|row| row.map(|row| row.point)).collect()
    }
}

/// How the numbers of a text mark their decimals.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Decimal {
    Point,
    Comma,
}

/// Reads a table; never fails as a whole.
pub fn parse(text: &str) -> ControlTable {
    let separator = Separator::of(text);
    let lines = match separator {
        Separator::Blanks => text::words(text),
        Separator::Byte(byte) => text::table(text, byte),
    };
    let Some(first) = lines.first() else { return ControlTable::default() };
    let heading = columns::heading(&first.fields);
    let rows = if heading.is_some() { &lines[1..] } else { &lines[..] };
    let columns = heading.map_or_else(|| columns::guessed(rows.iter().map(|line| line.fields.as_slice())), Ok);
    let decimal = decimal_mark(rows, separator);
    let mut seen = HashMap::new();
    let rows = rows.iter().map(|line| {
        let at = |error: columns::Fault| Error::Invalid {
            reason: error.reason,
            at: Place::line(line.line).with_field(error.field),
        };
        let columns = columns.as_ref().map_err(|fault| at(fault.clone()))?;
        let row = row(line, columns, decimal).map_err(at)?;
        match seen.insert(row.point.id.clone(), line.line) {
            None => Ok(row),
            Some(_) => Err(Error::Duplicate { kind: Thing::Point, name: row.point.id, at: Place::line(line.line) }),
        }
    });
    ControlTable { rows: rows.collect() }
}

/// What separates the fields of a text.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Separator {
    Byte(u8),
    Blanks,
}

impl Separator {
    /// A tab or semicolon anywhere in the first rows decides; commas separate unless splitting at blanks leaves each as
    /// a decimal comma inside a number ("7 0,5 1,25 3").
    fn of(text: &str) -> Self {
        let rows = text::sample(text);
        if text::most(&rows, '\t') {
            return Self::Byte(b'\t');
        }
        if text::most(&rows, ';') {
            return Self::Byte(b';');
        }
        let decimal = |word: &str| match word.split_once(',') {
            None => true,
            Some((whole, rest)) => {
                let digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
                digits(whole.trim_start_matches(['-', '+'])) && digits(rest)
            }
        };
        let spaced = |row: &String| row.split_whitespace().count() >= 4 && row.split_whitespace().skip(1).all(decimal);
        if text::most(&rows, ',') && !rows.iter().all(spaced) { Self::Byte(b',') } else { Self::Blanks }
    }
}

/// The decimal mark of the first number that has one.
fn decimal_mark(lines: &[Row], separator: Separator) -> Decimal {
    if separator == Separator::Byte(b',') {
        return Decimal::Point;
    }
    let words = lines.iter().flat_map(|line| line.fields.iter().skip(1));
    let mut marks = words.filter(|word| word.bytes().all(|byte| byte.is_ascii_digit() || b"+-.,eE".contains(&byte)));
    match marks.find_map(|word| word.find([',', '.']).map(|at| word.as_bytes()[at])) {
        Some(b',') => Decimal::Comma,
        _ => Decimal::Point,
    }
}

fn row(line: &Row, columns: &Columns, decimal: Decimal) -> std::result::Result<ControlRow, columns::Fault> {
    let text = |field: Field| {
        columns.place(field).and_then(|place| line.fields.get(place)).map(String::as_str).unwrap_or_default()
    };
    let required = |field: Field| match text(field) {
        "" => Err(field.fault(Reason::Missing { name: field.name().into() })),
        found => Ok(found),
    };
    let coordinate = |field: Field| number(field, required(field)?, decimal);
    // Measured to a millimetre or held: a blank, a dash or "fix" is an axis without sigma.
    let sigma = |field: Field| match text(field) {
        "" | "-" => Ok(None),
        word if word.eq_ignore_ascii_case("fix") || word.eq_ignore_ascii_case("fixed") => Ok(None),
        word => match number(field, word, decimal)? {
            sigma if sigma >= 0.0 => Ok(Some(sigma)),
            sigma => Err(field.fault(Reason::Negative { name: field.name().into(), value: sigma.into() })),
        },
    };
    let id = text::armed(required(Field::Id)?).to_owned();
    let xyz = [coordinate(Field::X)?, coordinate(Field::Y)?, coordinate(Field::Z)?];
    let sigma = if columns.place(Field::Sigma).is_some() {
        [sigma(Field::Sigma)?; 3]
    } else {
        [sigma(Field::Sx)?, sigma(Field::Sy)?, sigma(Field::Sz)?]
    };
    let role = match text(Field::Role).to_ascii_lowercase().as_str() {
        "" | "control" => Role::Control,
        "check" => Role::Check,
        "tie" => Role::Tie,
        other => {
            let (name, choices) = (Field::Role.name().into(), "control, check, tie".into());
            return Err(Field::Role.fault(Reason::NoneOf { name, choices, text: shortened(other) }));
        }
    };
    let label = Some(text(Field::Label)).filter(|label| !label.is_empty()).map(str::to_owned);
    let sigma = sigma.iter().any(Option::is_some).then_some(sigma);
    Ok(ControlRow {
        line: line.line,
        label,
        point: Point { id, role, xyz: Some(xyz), sigma, diameter: None, normal: None },
    })
}

fn number(field: Field, word: &str, decimal: Decimal) -> std::result::Result<f64, columns::Fault> {
    let (name, text) = (|| field.name().to_owned(), || shortened(word));
    let plain = match decimal {
        Decimal::Point if word.contains(',') => {
            return Err(field.fault(Reason::CommaAmongPoints { name: name(), text: text() }));
        }
        Decimal::Comma if word.contains('.') => {
            return Err(field.fault(Reason::PointAmongCommas { name: name(), text: text() }));
        }
        Decimal::Point => word.to_owned(),
        Decimal::Comma => word.replacen(',', ".", 1),
    };
    text::number(&plain).ok_or_else(|| field.fault(Reason::NotANumber { name: name(), text: text() }))
}

/// Writes the points that have coordinates, control points' sigmas with them.
pub fn write(points: &[Point]) -> String {
    let mut text = String::from("id,X,Y,Z,sX,sY,sZ,role\n");
    for point in points {
        let Some([x, y, z]) = point.xyz else { continue };
        let [sx, sy, sz] =
            point.sigma.unwrap_or_default().map(|sigma| sigma.map(|sigma| sigma.to_string()).unwrap_or_default());
        let role = match point.role {
            Role::Tie => "tie",
            Role::Control => "control",
            Role::Check => "check",
        };
        // Writing to a string does not fail.
        let _ = writeln!(text, "{},{x},{y},{z},{sx},{sy},{sz},{role}", text::quoted(&text::disarmed(&point.id), ','));
    }
    text
}

#[cfg(test)]
mod tests;
