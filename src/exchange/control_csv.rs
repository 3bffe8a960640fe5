//! Control points as spreadsheets and surveyors write them: id, X, Y, Z and, where known, a sigma for each axis.
//!
//! Fields are separated by tabs, semicolons, commas or blanks; a heading (also in the comment before the first row), a label or description,
//! comments (#, %) and quoted fields are recognised. Every row stands for itself: the good ones are kept and each bad one says what is wrong
//! in which field of which line.
//!
//! What a text leaves open is never decided in silence. One text has one decimal sign: "1.234" beside "0,5" would be a guess
//! between thousands and thousandths, and "1,234" alone is refused until the caller chooses. Headings decide the axes (X and Y, N and E,
//! Northing and Easting, 종 and 횡) and the units ("X [m]"). All that was taken for granted is in [`ControlTable::assumptions`], and what has to be
//! asked is marked [`Basis::Undecided`] there; [`Choices`] hold the answers.

mod assumptions;
mod columns;
mod decimals;
mod heading;
mod separators;

use std::collections::HashMap;
use std::fmt::Write;

pub use assumptions::{Assumption, Axes, Basis, Choices, Decimal, Separator};
pub use columns::Field;
use columns::{Columns, Fault};
pub use decimals::{Sign, readings as decimal_readings, sign_of, without_thousands};
use separators::{separates_both_ways, separator_of, table};

use super::text::{self, Row};
use crate::error::{Error, Lack, Place, Reason, Result, Thing, shortened};
use crate::project::{LARGEST, Point, Role};
use crate::units::Unit;

/// A row of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlRow {
    /// Line, counted from 1.
    pub line: usize,
    /// Second name or description, as surveyors give one.
    pub label: Option<String>,
    /// The point.
    pub point: Point,
}

/// A table of control points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ControlTable {
    /// Its rows; a bad one is an error with line and field.
    pub rows: Vec<Result<ControlRow>>,
    /// Unit of the coordinates and standard errors in the rows, where the heading or the caller names one.
    pub unit: Option<Unit>,
    /// How the table was read.
    pub assumptions: Vec<Assumption>,
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

    /// Whether a heading names the columns.
    pub fn has_heading(&self) -> bool {
        self.assumptions.iter().any(|a| matches!(a, Assumption::Columns { by: Basis::Heading, .. }))
    }

    /// What has to be asked before the points are used.
    pub fn undecided(&self) -> impl Iterator<Item = &Assumption> {
        self.assumptions.iter().filter(|assumption| assumption.by() == Basis::Undecided)
    }

    /// Whether it is a table of coordinates that is refused only for what it leaves open, not for what is in it.
    pub fn is_open(&self) -> bool {
        let open = |row: &Result<ControlRow>| {
            let Err(Error::Invalid { reason, .. }) = row else { return false };
            matches!(
                reason,
                Reason::AmbiguousNumber { .. }
                    | Reason::SeparatorBothWays
                    | Reason::MoreFields { .. }
                    | Reason::HeadingTwice { .. }
                    | Reason::HeadingIncomplete { .. }
                    | Reason::UnitOfCoordinates
                    | Reason::NoneOf { .. }
            )
        };
        2 * self.rows.iter().filter(|row| open(row)).count() > self.rows.len()
    }
}

/// Reads a table; never fails as a whole.
pub fn parse(text: &str) -> ControlTable {
    parse_with(text, Choices::default())
}

/// The same with what the caller knows and the table does not say.
pub fn parse_with(text: &str, choices: Choices) -> ControlTable {
    let separator = separator_of(text);
    let lines = table(text, separator);
    let Some(first) = lines.first() else { return ControlTable::default() };
    let named = heading::heading(&first.fields);
    let (heading, rows) = match &named {
        Some(_) => (named, &lines[1..]),
        None => (commented_heading(text, separator, &lines), &lines[..]),
    };
    let has_heading = heading.is_some();
    let fields: Vec<&[String]> = rows.iter().map(|row| row.fields.as_slice()).collect();
    let mut columns = match heading.unwrap_or_else(|| columns::guessed(&fields, choices.axes)) {
        Ok(columns) => columns,
        Err(fault) => {
            let line = |row: &Row| Err(placed(row.line, fault.clone()));
            return ControlTable { rows: rows.iter().map(line).collect(), ..ControlTable::default() };
        }
    };
    if !has_heading && choices.axes.is_none() && has_strange_heading(&fields, &columns) {
        columns.order.1 = Basis::Undecided;
    }
    let numbers = || {
        let number = |k: &usize| columns.fields.get(*k).copied().flatten().is_some_and(Field::is_number);
        fields.iter().flat_map(move |row| (0..row.len()).filter(number).map(|k| row[k].as_str()))
    };
    let (decimal, by, example) = decimals::decide(numbers(), choices.decimal);
    let scales = scales(&columns, choices.unit);
    let both_ways = separates_both_ways(separator, &fields, has_heading, &columns);
    let reader = Reader { columns: &columns, decimal, decimal_by: by, scales: &scales };
    let mut seen = HashMap::new();
    let read = |line: &Row| {
        let filled = line.fields.iter().rposition(|field| !field.is_empty()).map_or(0, |last| last + 1);
        if both_ways {
            return Err(placed(line.line, Field::X.fault(Reason::SeparatorBothWays)));
        }
        if has_heading && filled > columns.fields.len() {
            let reason = Reason::MoreFields { fields: filled, columns: columns.fields.len() };
            return Err(placed(line.line, Fault { field: "columns", reason }));
        }
        let row = reader.row(line).map_err(|fault| placed(line.line, fault))?;
        match seen.insert(row.point.id.clone(), line.line) {
            None => Ok(row),
            Some(_) => Err(Error::Duplicate { kind: Thing::Point, name: row.point.id, at: Place::line(line.line) }),
        }
    };
    let rows = rows.iter().map(read).collect();
    let unit = unit_of(&columns);
    let mut assumptions = vec![
        Assumption::Separator { separator, by: Basis::Content },
        Assumption::DecimalSign { sign: decimal, by, example },
        Assumption::Columns { columns: columns.fields.clone(), by: columns.by },
        Assumption::AxisOrder { order: columns.order.0, by: columns.order.1 },
    ];
    let sigmas = columns.sigmas();
    if !sigmas.is_empty() {
        assumptions.push(Assumption::SigmaColumns { columns: sigmas, by: columns.by });
    }
    let (unit, by) = match (unit, choices.unit) {
        (Some(unit), _) => (Some(unit), Basis::Heading),
        (None, Some(unit)) => (Some(unit), Basis::Given),
        (None, None) => (None, Basis::Convention),
    };
    assumptions.push(Assumption::Unit { unit, by });
    if !columns.ignored.is_empty() {
        assumptions.push(Assumption::Ignored { columns: columns.ignored.clone() });
    }
    if !columns.remarks.is_empty() {
        assumptions.push(Assumption::Remarks { headings: columns.remarks.clone() });
    }
    ControlTable { rows, unit, assumptions }
}

fn placed(line: usize, fault: Fault) -> Error {
    Error::Invalid { reason: fault.reason, at: Place::line(line).with_field(fault.field) }
}

/// A heading that is written as the comment before the first row.
fn commented_heading(text: &str, separator: Separator, rows: &[Row]) -> Option<std::result::Result<Columns, Fault>> {
    let first = rows.first()?.line;
    let comments = text.lines().take(first - 1).map(str::trim).filter(|line| line.starts_with(['#', '%']));
    let widest = rows.iter().map(|row| row.fields.len()).max().unwrap_or(0);
    let read = |line: &str| {
        let bare = line.trim_start_matches(['#', '%', ' ', '\t']);
        let fields = table(bare, separator).pop()?.fields;
        // A sentence about the points is no heading of them, nor is a list of fewer columns than there are.
        heading::heading(&fields).filter(|found| found.is_ok() && fields.len() >= widest)
    };
    comments.filter_map(read).last()
}

/// Whether the first of the rows is a heading whose words are not known: where the coordinates would be it has words, the others numbers.
fn has_strange_heading(rows: &[&[String]], columns: &Columns) -> bool {
    let numeric = |row: &[String]| {
        let number = |field| {
            let word = columns.place(field).and_then(|k| row.get(k));
            word.is_some_and(|word| word.replacen(',', ".", 1).parse::<f64>().is_ok())
        };
        [Field::X, Field::Y, Field::Z].map(number)
    };
    let Some((first, others)) = rows.split_first() else { return false };
    !numeric(first).contains(&true) && others.iter().any(|row| numeric(row) == [true; 3])
}

/// Unit of the coordinates by their headings: that of the first one that has one.
fn unit_of(columns: &Columns) -> Option<Unit> {
    let coordinates = [Field::X, Field::Y, Field::Z].into_iter().filter_map(|field| columns.place(field));
    coordinates.filter_map(|k| columns.units.get(k).copied().flatten()).next()
}

/// Factors that bring each column to the unit of the coordinates; none where a standard error's unit cannot be brought to it.
fn scales(columns: &Columns, given: Option<Unit>) -> Vec<Option<f64>> {
    let unit = unit_of(columns).or(given);
    let scale = |own: &Option<Unit>| match (own, unit) {
        (Some(own), Some(unit)) => Some(own.factor(unit)),
        (Some(_), None) => None,
        (None, _) => Some(1.0),
    };
    columns.units.iter().map(scale).collect()
}

/// How rows are read.
struct Reader<'a> {
    columns: &'a Columns,
    decimal: Decimal,
    decimal_by: Basis,
    scales: &'a [Option<f64>],
}

impl Reader<'_> {
    fn row(&self, line: &Row) -> std::result::Result<ControlRow, Fault> {
        let text = |field: Field| {
            self.columns.place(field).and_then(|place| line.fields.get(place)).map(String::as_str).unwrap_or_default()
        };
        let required = |field: Field| match text(field) {
            "" => Err(field.fault(Reason::Missing { name: field.name().into() })),
            found => Ok(found),
        };
        let coordinate = |field: Field| self.number(field, required(field)?);
        // Measured to a millimetre or held: a blank, a dash or "fix" is an axis without sigma.
        let sigma = |field: Field| match text(field) {
            "" | "-" => Ok(None),
            word if word.eq_ignore_ascii_case("fix") || word.eq_ignore_ascii_case("fixed") => Ok(None),
            word => match self.number(field, word)? {
                sigma if sigma >= 0.0 => Ok(Some(sigma)),
                sigma => Err(field.fault(Reason::Negative { name: field.name().into(), value: sigma.into() })),
            },
        };
        let id = text::armed(required(Field::Id)?).to_owned();
        let xyz = [coordinate(Field::X)?, coordinate(Field::Y)?, coordinate(Field::Z)?];
        let sigma = if self.columns.place(Field::Sigma).is_some() {
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

    fn number(&self, field: Field, word: &str) -> std::result::Result<f64, Fault> {
        let (name, text) = (|| field.name().to_owned(), || shortened(word));
        if self.decimal_by == Basis::Undecided && sign_of(word) == Sign::Either {
            let [decimal, thousands] = decimal_readings(word);
            return Err(field.fault(Reason::AmbiguousNumber { name: name(), text: text(), decimal, thousands }));
        }
        let plain = match self.decimal {
            Decimal::Point if word.contains(',') => {
                match without_thousands(word).filter(|_| self.decimal_by == Basis::Given) {
                    Some(plain) => plain,
                    None => return Err(field.fault(Reason::CommaAmongPoints { name: name(), text: text() })),
                }
            }
            Decimal::Comma if word.contains('.') => {
                return Err(field.fault(Reason::PointAmongCommas { name: name(), text: text() }));
            }
            Decimal::Point => word.to_owned(),
            Decimal::Comma => word.replacen(',', ".", 1),
        };
        let plain = plain.replace('\u{2212}', "-");
        let value =
            text::number(&plain).ok_or_else(|| field.fault(Reason::NotANumber { name: name(), text: text() }))?;
        let scale = self.columns.place(field).and_then(|k| self.scales.get(k).copied()).unwrap_or(Some(1.0));
        let Some(scale) = scale else { return Err(field.fault(Reason::UnitOfCoordinates)) };
        let value = value * scale;
        if value.abs() < LARGEST {
            Ok(value)
        } else {
            Err(field.fault(Reason::TooLarge { name: name(), text: text() }))
        }
    }
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
