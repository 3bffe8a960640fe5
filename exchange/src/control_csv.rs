//! Control points as spreadsheets and surveyors write them: id, X, Y, Z and, where known, a sigma for each axis.
//!
//! Fields are separated by tabs, semicolons, commas or blanks; a heading (also in the comment before the first row), a label or description,
//! comments (#, %) and quoted fields are recognised. Rows are independent: valid ones are kept and each invalid one has its error
//! in which field of which line.
//!
//! What a text leaves open is never decided in silence. One text has one decimal sign: "1.234" beside "0,5" would be a guess
//! between thousands and thousandths, and "1,234" alone is refused until the caller chooses. Headings decide the axes (X and Y, N and E,
//! Northing and Easting, 종 and 횡) and the units ("X [m]"). All assumptions are in [`ControlTable::assumptions`], and what has to be
//! asked is marked [`Basis::Undecided`] there; [`TableChoices`] hold the answers.
//!
//! Latitude, longitude and ellipsoidal height become east, north and up in a local system ([`sightline::project::LocalSystem`]).

mod angles;
mod assumptions;
mod columns;
mod conventions;
mod decimals;
mod geographic;
mod given;
mod heading;
mod reader;
mod separators;
mod sigma;

use crate::reason::ExchangeReason;
use std::collections::HashMap;
use std::fmt::Write;

pub use angles::AngleForm;
pub use assumptions::{Assumption, Beside, ListFormat, TableChoices};
pub use columns::Field;
use columns::{Columns, Fault};
pub use conventions::{Axes, Basis, Decimal, Separator};
pub(super) use decimals::decide as decide_decimals;
pub use decimals::{Sign, readings as decimal_readings, sign_of, without_thousands};
pub(super) use geographic::into_local_system;
use reader::ControlRowReader;
use separators::{separates_both_ways, separator_of, table};
pub use sigma::SigmaRule;

use super::text::{self, Row};
use sightline::axes::{ShownAxes, UserAxes};
use sightline::error::{Error, Lack, Place, Reason, Result, Thing};
use sightline::project::{LocalSystem, Point, Role};
use sightline::units::Unit;

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
    /// Words of the heading, column by column; empty without one.
    pub heading: Vec<String>,
    /// Fields of the first rows as the text has them.
    pub sample: Vec<Vec<String>>,
}

/// Rows in [`ControlTable::sample`].
const SAMPLE: usize = 5;

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

    /// Gives one standard error to the points that have none of their own.
    pub(super) fn give_sigma(&mut self, rule: Option<SigmaRule>) {
        let Some(rule) = rule else { return };
        let mut points: Vec<Point> = self.rows.iter().flatten().map(|row| row.point.clone()).collect();
        let without = points.iter().filter(|point| point.sigma.is_none()).count();
        let by = if rule.apply(&mut points, self.unit).is_ok() { Basis::Given } else { Basis::Undecided };
        self.rows.iter_mut().flatten().zip(points).for_each(|(row, point)| row.point = point);
        self.assumptions.push(Assumption::CommonSigma { rule, points: without, by });
    }

    /// The local system that latitudes and longitudes were converted into.
    pub fn local_system(&self) -> Option<LocalSystem> {
        self.assumptions.iter().find_map(|assumption| match assumption {
            Assumption::LocalSystem { system, .. } => Some(*system),
            _ => None,
        })
    }

    /// Refuses latitudes and longitudes whose local system is that of this list alone, where coordinates of several lists belong together.
    ///
    /// # Errors
    /// [`ExchangeReason::GeographicOrigin`].
    pub fn in_given_system(self) -> Result<Self> {
        let own = |a: &Assumption| matches!(a, Assumption::LocalSystem { by: Basis::Convention, .. });
        if self.assumptions.iter().any(own) {
            return Err(Error::Invalid { reason: ExchangeReason::GeographicOrigin.into(), at: Place::default() });
        }
        Ok(self)
    }

    /// Content of each column, if the table could be read.
    pub fn columns(&self) -> Option<&[Option<Field>]> {
        self.assumptions.iter().find_map(|assumption| match assumption {
            Assumption::Columns { columns, .. } => Some(columns.as_slice()),
            _ => None,
        })
    }

    /// The axes of whoever wrote the list, where it says them: north first by its heading or a choice, or east and north by their letters.
    pub fn user_axes(&self) -> Option<UserAxes> {
        let [named, by_themselves] = heading::directions(&self.heading);
        self.assumptions.iter().find_map(|assumption| match assumption {
            Assumption::AxisOrder { by: Basis::Undecided, .. } => None,
            Assumption::AxisOrder { order: Axes::Yx, by: Basis::Heading } => named.then_some(UserAxes::Neh),
            Assumption::AxisOrder { order: Axes::Yx, .. } => Some(UserAxes::Neh),
            Assumption::AxisOrder { .. } => by_themselves.then_some(UserAxes::Enh),
            _ => None,
        })
    }

    /// Questions to answer before the points are used.
    pub fn undecided(&self) -> impl Iterator<Item = &Assumption> {
        self.assumptions.iter().filter(|assumption| assumption.by() == Basis::Undecided)
    }

    /// Whether it is a table of coordinates that is refused only for what it leaves open, not for what is in it.
    pub fn is_open(&self) -> bool {
        let open = |row: &Result<ControlRow>| {
            let Err(error) = row else { return false };
            let Some(reason) = ExchangeReason::of_error(error) else {
                return matches!(error, Error::Invalid { reason: Reason::NoneOf { .. }, .. });
            };
            matches!(
                reason,
                ExchangeReason::AmbiguousNumber { .. }
                    | ExchangeReason::SeparatorBothWays
                    | ExchangeReason::MoreFields { .. }
                    | ExchangeReason::HeadingTwice { .. }
                    | ExchangeReason::HeadingIncomplete { .. }
                    | ExchangeReason::UnitOfCoordinates
                    | ExchangeReason::GeographicIncomplete { .. }
                    | ExchangeReason::PlaneAndGeographic { .. }
                    | ExchangeReason::AngleUnexpected { .. }
                    | ExchangeReason::NotAnAngle { .. }
                    | ExchangeReason::AngleForm { .. }
                    | ExchangeReason::AngleDirection { .. }
                    | ExchangeReason::AngleOutside { .. }
            )
        };
        2 * self.rows.iter().filter(|row| open(row)).count() > self.rows.len()
    }
}

/// Reads a table; never fails as a whole.
pub fn parse(text: &str) -> ControlTable {
    parse_with(text, TableChoices::default())
}

/// The same with what the caller knows and the table does not say.
pub fn parse_with(text: &str, choices: TableChoices) -> ControlTable {
    let separator = choices.separator.unwrap_or_else(|| separator_of(text));
    let lines = table(text, separator);
    let Some(Begun { heading, words, rows, first_row, before }) = begun(text, separator, &lines, &choices) else {
        return ControlTable::default();
    };
    let has_heading = words.is_some();
    let chosen = choices.columns.as_deref();
    let fields: Vec<&[String]> = rows.iter().map(|row| row.fields.as_slice()).collect();
    let widest = fields.iter().map(|row| row.len()).max().unwrap_or(0);
    let sample = fields.iter().take(SAMPLE).map(|row| row.to_vec()).collect();
    let named = heading.is_some();
    let columns = match chosen {
        Some(chosen) => given::given(chosen, words.as_deref(), widest),
        None => heading.unwrap_or_else(|| columns::guessed(&fields, choices.axes, choices.project_axes)),
    };
    let heading = words.unwrap_or_default();
    let by = if choices.separator.is_some() { Basis::Given } else { Basis::Content };
    let mut assumptions = vec![Assumption::Separator { separator, by }];
    let mut columns = match columns {
        Ok(columns) => columns,
        Err(fault) => {
            let line = |row: &Row| Err(placed(row.line, fault.clone()));
            let rows = rows.iter().map(line).collect();
            return ControlTable { rows, assumptions, heading, sample, ..ControlTable::default() };
        }
    };
    let said = chosen.is_some() || choices.axes.is_some() || heading::directions(&heading)[0];
    columns.take_angles(&fields, said);
    let geographic = columns.is_geographic();
    if !geographic
        && chosen.is_none()
        && !named
        && choices.axes.is_none()
        && (has_heading || has_strange_heading(&fields, &columns))
    {
        columns.order.1 = Basis::Undecided;
    }
    let numbers = || {
        let number = |k: &usize| columns.fields.get(*k).copied().flatten().is_some_and(Field::is_number);
        fields.iter().flat_map(move |row| (0..row.len()).filter(number).map(|k| row[k].as_str()))
    };
    let (decimal, by, example) = decimals::decide(numbers(), choices.decimal);
    let height_unit = unit_of(&columns).or(choices.unit).unwrap_or(Unit::Metre);
    let scales = match geographic {
        true => metres(&columns, height_unit, choices.sigma_unit),
        false => scales(&columns, choices.unit, choices.sigma_unit),
    };
    // Someone who names separator and columns has said what separates.
    let told = choices.separator.is_some() && chosen.is_some();
    let both_ways = !told && separates_both_ways(separator, &fields, has_heading, &columns);
    let north_first = columns.order.0 == Axes::Yx && columns.order.1 != Basis::Undecided;
    let axes = ShownAxes::of(choices.project_axes.or(north_first.then_some(UserAxes::Neh)));
    let form = geographic.then(|| geographic::form(&fields, &columns));
    let reader =
        ControlRowReader { columns: &columns, decimal, decimal_by: by, scales: &scales, heading: &heading, axes, form };
    let mut seen = HashMap::new();
    let read = |line: &Row| {
        let filled = line.fields.iter().rposition(|field| !field.is_empty()).map_or(0, |last| last + 1);
        if both_ways {
            return Err(placed(line.line, reader.fault(Field::X, ExchangeReason::SeparatorBothWays.into())));
        }
        if has_heading && filled > columns.fields.len() {
            let reason = ExchangeReason::MoreFields { fields: filled, columns: columns.fields.len() }.into();
            return Err(placed(line.line, Fault { field: "columns".to_owned(), reason }));
        }
        let row = reader.row(line).map_err(|fault| placed(line.line, fault))?;
        match seen.insert(row.point.id.clone(), line.line) {
            None => Ok(row),
            Some(_) => Err(Error::Duplicate { kind: Thing::Point, name: row.point.id, at: Place::line(line.line) }),
        }
    };
    let mut rows: Vec<Result<ControlRow>> = rows.iter().map(read).collect();
    assumptions.extend([
        Assumption::DecimalSign { sign: decimal, by, example },
        Assumption::Columns { columns: columns.fields.clone(), by: columns.by },
    ]);
    match form {
        // Which of the two comes first says nothing of the axes in which the project is shown.
        Some(form) => assumptions.extend(geographic::convert(&mut rows, form, height_unit, &choices)),
        None => assumptions.push(Assumption::AxisOrder { order: columns.order.0, by: columns.order.1 }),
    }
    let sigmas = columns.sigmas();
    if !sigmas.is_empty() {
        assumptions.push(Assumption::SigmaColumns { columns: sigmas, by: columns.by });
    }
    let (unit, by) = match (unit_of(&columns), choices.unit) {
        _ if geographic => (Some(Unit::Metre), Basis::Content),
        (Some(unit), _) => (Some(unit), Basis::Heading),
        (None, Some(unit)) => (Some(unit), Basis::Given),
        (None, None) => (None, Basis::Convention),
    };
    assumptions.push(Assumption::Unit { unit, by });
    assumptions.extend(first_row);
    if before > 0 {
        assumptions.push(Assumption::Beside { what: Beside::LinesBefore, count: before });
    }
    if !columns.ignored.is_empty() {
        assumptions.push(Assumption::Ignored { columns: columns.ignored.clone() });
    }
    if !columns.remarks.is_empty() {
        assumptions.push(Assumption::Remarks { headings: columns.remarks.clone() });
    }
    let mut table = ControlTable { rows, unit, assumptions, heading, sample };
    table.give_sigma(choices.sigma);
    table
}

/// Where the rows of points begin, and what names their columns.
struct Begun<'a> {
    heading: Option<std::result::Result<Columns, Fault>>,
    /// The fields of the heading, also of one whose words are not known.
    words: Option<Vec<String>>,
    rows: &'a [Row],
    first_row: Option<Assumption>,
    /// Rows before the heading.
    before: usize,
}

/// Rows before a heading that are looked through: titles of surveyors' lists are a few lines.
const TITLES: usize = 10;

fn begun<'a>(text: &str, separator: Separator, lines: &'a [Row], choices: &TableChoices) -> Option<Begun<'a>> {
    let first = lines.first()?;
    let none = Begun { heading: None, words: None, rows: lines, first_row: None, before: 0 };
    if let Some(line) = choices.first_line {
        let start = lines.iter().position(|row| row.line >= line).unwrap_or(lines.len());
        let heading = start.checked_sub(1).map(|k| &lines[k]);
        let named = heading.and_then(|row| heading::heading(&row.fields));
        let words = heading.map(|row| row.fields.clone());
        let begun = Begun {
            rows: &lines[start..],
            before: start.saturating_sub(1),
            first_row: Some(Assumption::FirstRow { line, by: Basis::Given }),
            ..none
        };
        return Some(match named {
            Some(named) => Begun { heading: Some(named), words, ..begun },
            None => {
                let (named, commented) = commented_heading(text, separator, begun.rows).unzip();
                Begun { heading: named, words: commented.or(words), ..begun }
            }
        });
    }
    let all: Vec<&[String]> = lines.iter().map(|row| row.fields.as_slice()).collect();
    let strange = choices.columns.as_deref().is_some_and(|chosen| given::begins_with_words(&all, chosen));
    if let Some(named) = heading::heading(&first.fields) {
        return Some(Begun { heading: Some(named), words: Some(first.fields.clone()), rows: &lines[1..], ..none });
    }
    if let Some((named, words)) = commented_heading(text, separator, lines) {
        return Some(Begun { heading: Some(named), words: Some(words), ..none });
    }
    // A heading under a title: nothing before it could be a point.
    let title = |row: &Row| row.fields.iter().filter(|field| decimals::is_numeric(field)).count() < 3;
    for (k, row) in lines.iter().enumerate().take(TITLES).skip(1) {
        if !title(&lines[k - 1]) {
            break;
        }
        if let (Some(Ok(named)), Some(next)) = (heading::heading(&row.fields), lines.get(k + 1)) {
            let first_row = Some(Assumption::FirstRow { line: next.line, by: Basis::Heading });
            let (heading, words) = (Some(Ok(named)), Some(row.fields.clone()));
            return Some(Begun { heading, words, rows: &lines[k + 1..], first_row, before: k });
        }
    }
    if strange {
        return Some(Begun { words: Some(first.fields.clone()), rows: &lines[1..], ..none });
    }
    Some(none)
}

fn placed(line: usize, fault: Fault) -> Error {
    Error::Invalid { reason: fault.reason, at: Place::line(line).with_field(fault.field) }
}

/// A heading that is written as the comment before the first row.
fn commented_heading(
    text: &str,
    separator: Separator,
    rows: &[Row],
) -> Option<(std::result::Result<Columns, Fault>, Vec<String>)> {
    let first = rows.first()?.line;
    let comments = text.lines().take(first - 1).map(str::trim).filter(|line| line.starts_with(['#', '%']));
    let widest = rows.iter().map(|row| row.fields.len()).max().unwrap_or(0);
    let read = |line: &str| {
        let bare = line.trim_start_matches(['#', '%', ' ', '\t']);
        let fields = table(bare, separator).pop()?.fields;
        // A sentence about the points is no heading of them, nor is a list of fewer columns than there are.
        // One of latitude and longitude says that no number below it is a coordinate of a plane.
        let names = |found: &std::result::Result<Columns, Fault>| match found {
            Ok(_) => true,
            Err(fault) => {
                let reason = ExchangeReason::of(&fault.reason);
                matches!(reason, Some(ExchangeReason::GeographicIncomplete { .. }))
            }
        };
        let found = heading::heading(&fields).filter(|found| names(found) && fields.len() >= widest)?;
        Some((found, fields))
    };
    comments.filter_map(read).last()
}

/// Whether the first of the rows is a heading whose words are not known: where the coordinates would be it has words, the others numbers.
fn has_strange_heading(rows: &[&[String]], columns: &Columns) -> bool {
    let numeric = |row: &[String]| {
        let number = |field| {
            let word = columns.place(field).and_then(|k| row.get(k));
            word.is_some_and(|word| decimals::is_value(word))
        };
        columns.coordinates().map(number)
    };
    let Some((first, others)) = rows.split_first() else { return false };
    !numeric(first).contains(&true) && others.iter().any(|row| numeric(row) == [true; 3])
}

/// Unit of the coordinates by their headings: that of the first one that has one.
fn unit_of(columns: &Columns) -> Option<Unit> {
    let coordinates = columns.coordinates().into_iter().filter_map(|field| columns.place(field));
    coordinates.filter_map(|k| columns.units.get(k).copied().flatten()).next()
}

/// Factors that bring each column to the unit of the coordinates; none where a standard error's unit cannot be brought to it.
fn scales(columns: &Columns, given: Option<Unit>, of_sigmas: Option<Unit>) -> Vec<Option<f64>> {
    let unit = unit_of(columns).or(given);
    let scale = |(k, own): (usize, &Option<Unit>)| {
        let sigma = columns.fields.get(k).copied().flatten().is_some_and(Field::is_sigma);
        match (own.or(of_sigmas.filter(|_| sigma)), unit) {
            (Some(own), Some(unit)) => Some(own.factor(unit)),
            (Some(_), None) => None,
            (None, _) => Some(1.0),
        }
    };
    columns.units.iter().enumerate().map(scale).collect()
}

/// Factors that bring heights, standard errors and diameters of a list of latitudes and longitudes to metres.
fn metres(columns: &Columns, height: Unit, of_sigmas: Option<Unit>) -> Vec<Option<f64>> {
    let scale = |(field, own): (&Option<Field>, &Option<Unit>)| {
        if field.is_some_and(Field::is_angle) {
            return Some(1.0);
        }
        let sigma = field.is_some_and(Field::is_sigma);
        Some(own.or(of_sigmas.filter(|_| sigma)).unwrap_or(height).factor(Unit::Metre))
    };
    columns.fields.iter().zip(&columns.units).map(scale).collect()
}

/// Writes the points that have coordinates, control points' sigmas with them, in the order of the user's axes.
pub fn write(points: &[Point], axes: ShownAxes) -> String {
    let with_diameters = points.iter().any(|point| point.xyz.is_some() && point.diameter.is_some());
    let ([a, b, c], diameter) = (axes.names(), if with_diameters { ",diameter" } else { "" });
    let mut text = format!("id,{a},{b},{c},s{a},s{b},s{c},role{diameter}\n");
    for point in points {
        let Some(xyz) = point.xyz else { continue };
        let [x, y, z] = axes.shown(xyz);
        let [sx, sy, sz] = axes
            .shown(point.sigma.unwrap_or_default())
            .map(|sigma| sigma.map(|sigma| sigma.to_string()).unwrap_or_default());
        let role = match point.role {
            Role::Tie => "tie",
            Role::Control => "control",
            Role::Check => "check",
        };
        // Writing to a string does not fail.
        let _ = write!(text, "{},{x},{y},{z},{sx},{sy},{sz},{role}", text::quoted(&text::disarmed(&point.id), ','));
        if with_diameters {
            let _ = write!(text, ",{}", point.diameter.map(|diameter| diameter.to_string()).unwrap_or_default());
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests;
