//! Lists of points of programs and instruments, recognised by content: tables ([`control_csv`]), Leica GSI, Sokkia SDR, Trimble JobXML,
//! LandXML, ground control points of ODM.
//!
//! What was understood, assumed, rejected and left aside is in the result; what nothing decides is marked [`Basis::Undecided`] and asked,
//! never guessed. Every choice can be made by the caller ([`TableChoices`]).

pub mod distances;
mod gsi;
mod job_xml;
mod land_xml;
mod odm;
mod sdr;
#[cfg(test)]
mod tests;

pub(super) use land_xml::write as landxml;

use std::collections::HashMap;

use serde::Serialize;

use super::control_csv::{
    self, Assumption, Axes, Basis, Beside, ControlRow, ControlTable, Field, ListFormat, TableChoices,
};
use super::encoding::{self, Encoding};
use super::text;
use sightline::error::{Error, Place, Reason, Result, Thing, shortened};
use sightline::project::{LARGEST, Point, Role};
use sightline::units::Unit;

/// A line that should be a point but cannot be read as one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rejected {
    /// Line, counted from 1.
    pub line: usize,
    /// The line as the list has it, shortened.
    pub text: String,
    /// Why, as a sentence.
    pub message: String,
    /// Why.
    pub error: Error,
}

/// A point of a list.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ListedRow {
    /// Line, counted from 1.
    pub line: usize,
    /// Second name, code or description.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// The point.
    #[serde(flatten)]
    pub point: Point,
}

/// A list that was read.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PointList {
    /// The points that were understood.
    pub points: Vec<ListedRow>,
    /// Lines that were not.
    pub rejected: Vec<Rejected>,
    /// Unit of coordinates and standard errors, where the list or the caller names one; null: it has to be asked.
    pub unit: Option<Unit>,
    /// How the list was read.
    pub assumptions: Vec<Assumption>,
    /// Those of the assumptions that nothing decides: to be asked before the points are used.
    pub undecided: Vec<Assumption>,
    /// Words of the heading, column by column; empty without one.
    pub heading: Vec<String>,
    /// Fields of the first rows as the text has them.
    pub sample: Vec<Vec<String>>,
}

/// Reads a list with all that is known of how it was read.
///
/// # Errors
/// [`crate::reason::ExchangeReason::NotText`] for bytes that are not text, and errors of an XML file as a whole.
pub fn read(bytes: &[u8], choices: &TableChoices) -> Result<PointList> {
    let (text, table) = table(bytes, choices)?;
    let undecided = table.undecided().cloned().collect();
    let lines: Vec<&str> = text.lines().collect();
    let (mut points, mut rejected) = (Vec::new(), Vec::new());
    for row in table.rows {
        match row {
            Ok(ControlRow { line, label, point }) => points.push(ListedRow { line, label, point }),
            Err(error) => {
                let line = error.place().line.unwrap_or_default();
                let own = line.checked_sub(1).and_then(|k| lines.get(k)).copied().unwrap_or_default();
                rejected.push(Rejected { line, text: shortened(own), message: error.to_string(), error });
            }
        }
    }
    let ControlTable { unit, assumptions, heading, sample, .. } = table;
    Ok(PointList { points, rejected, unit, assumptions, undecided, heading, sample })
}

/// The text of a list, and its rows.
///
/// # Errors
/// As [`read`].
pub fn table(bytes: &[u8], choices: &TableChoices) -> Result<(String, ControlTable)> {
    let (text, encoding, certain) = encoding::list(bytes, choices.encoding)?;
    let mut table = parse(&text, choices)?;
    let by = match choices.encoding {
        Some(_) => Basis::Given,
        None if certain => Basis::Content,
        None => Basis::Convention,
    };
    if encoding != Encoding::Utf8 || by == Basis::Given {
        table.assumptions.insert(0, Assumption::Encoding { encoding, by });
    }
    Ok((text, table))
}

/// The rows of a list.
///
/// # Errors
/// Errors of an XML file as a whole.
pub fn parse(text: &str, choices: &TableChoices) -> Result<ControlTable> {
    let format = recognised(text);
    let mut rows = match format {
        ListFormat::Table => return Ok(control_csv::parse_with(text, choices.clone())),
        ListFormat::LeicaGsi => gsi::read(text),
        ListFormat::SokkiaSdr => sdr::read(text),
        ListFormat::JobXml => job_xml::read(text)?,
        ListFormat::LandXml => land_xml::read(text)?,
        ListFormat::OdmGcp => odm::read(text),
    };
    rows.refuse_repeated();
    Ok(rows.into_table(format, choices))
}

/// Whether bytes are a list in the format of an instrument or another program, not a table.
pub fn is_of_an_instrument(bytes: &[u8]) -> bool {
    encoding::text(bytes).is_ok_and(|text| recognised(&text) != ListFormat::Table)
}

/// Kind of list in a text.
pub fn recognised(text: &str) -> ListFormat {
    match () {
        () if land_xml::recognises(text) => ListFormat::LandXml,
        () if job_xml::recognises(text) => ListFormat::JobXml,
        () if gsi::recognises(text) => ListFormat::LeicaGsi,
        () if sdr::recognises(text) => ListFormat::SokkiaSdr,
        () if odm::recognises(text) => ListFormat::OdmGcp,
        () => ListFormat::Table,
    }
}

/// Points of a format whose columns have their meaning by definition, east before north.
#[derive(Default)]
struct Listed {
    rows: Vec<Result<ControlRow>>,
    /// Unit, where the format or the file has one.
    unit: Option<Unit>,
    /// Whether north may stand where east is expected: the file has an order of its own that readers take differently.
    order_open: bool,
    beside: Vec<(Beside, usize)>,
    names_made: usize,
    /// Whether coordinates are longitude and latitude in decimal degrees, and height in metres.
    geographic: bool,
    /// Rows of one point are repeated with the same coordinates.
    repeats: bool,
}

impl Listed {
    /// Names are unique; where a format repeats points, the same coordinates are the same point.
    fn refuse_repeated(&mut self) {
        let mut seen: HashMap<String, Point> = HashMap::new();
        let repeats = self.repeats;
        let rows = std::mem::take(&mut self.rows).into_iter().filter_map(|row| {
            let Ok(row) = row else { return Some(row) };
            match seen.get(&row.point.id) {
                Some(known) if repeats && known.xyz == row.point.xyz => None,
                Some(_) => {
                    let (kind, at) = (Thing::Point, Place::line(row.line));
                    Some(Err(Error::Duplicate { kind, name: row.point.id, at }))
                }
                None => {
                    seen.insert(row.point.id.clone(), row.point.clone());
                    Some(Ok(row))
                }
            }
        });
        self.rows = rows.collect();
    }

    fn into_table(mut self, format: ListFormat, choices: &TableChoices) -> ControlTable {
        if self.geographic {
            return self.into_local_system(format, choices);
        }
        let (order, by) = match (choices.axes, self.order_open) {
            (Some(axes), _) => (axes, Basis::Given),
            (None, true) => (Axes::Xy, Basis::Undecided),
            (None, false) => (Axes::Xy, Basis::Content),
        };
        if order == Axes::Yx {
            for point in self.rows.iter_mut().flatten().map(|row| &mut row.point) {
                if let Some(xyz) = &mut point.xyz {
                    xyz.swap(0, 1);
                }
            }
        }
        let (unit, by_unit) = match (self.unit, choices.unit) {
            (Some(unit), _) => (Some(unit), Basis::Content),
            (None, Some(unit)) => (Some(unit), Basis::Given),
            (None, None) => (None, Basis::Convention),
        };
        let assumptions = vec![
            Assumption::Format { format, by: Basis::Content },
            Assumption::AxisOrder { order, by },
            Assumption::Unit { unit, by: by_unit },
        ];
        self.with(assumptions, unit, choices)
    }

    /// Longitudes, latitudes and heights as east, north and up.
    fn into_local_system(mut self, format: ListFormat, choices: &TableChoices) -> ControlTable {
        let unit = Some(Unit::Metre);
        let mut assumptions = vec![Assumption::Format { format, by: Basis::Content }];
        assumptions.extend(control_csv::into_local_system(&mut self.rows, choices));
        assumptions.push(Assumption::Unit { unit, by: Basis::Content });
        self.with(assumptions, unit, choices)
    }

    fn with(self, mut assumptions: Vec<Assumption>, unit: Option<Unit>, choices: &TableChoices) -> ControlTable {
        let kept = |(what, count)| (count > 0).then_some(Assumption::Beside { what, count });
        assumptions.extend(self.beside.into_iter().filter_map(kept));
        if self.names_made > 0 {
            assumptions.push(Assumption::NamesMade { count: self.names_made });
        }
        let mut table = ControlTable { rows: self.rows, unit, assumptions, ..ControlTable::default() };
        table.give_sigma(choices.sigma);
        table
    }
}

/// A point from the words of its coordinates, east first, each times `scale`.
fn point(line: usize, id: &str, label: &str, words: [&str; 3], scale: f64) -> Result<ControlRow> {
    let fault = |field: Field, reason| Error::Invalid { reason, at: Place::line(line).with_field(field.name()) };
    if id.is_empty() {
        return Err(fault(Field::Id, Reason::Missing { name: Field::Id.name().into() }));
    }
    let mut xyz = [0.0; 3];
    for (k, field) in [Field::X, Field::Y, Field::Z].into_iter().enumerate() {
        let (name, word) = (field.name().to_owned(), words[k].trim());
        if word.is_empty() {
            return Err(fault(field, Reason::Missing { name }));
        }
        let text = shortened(word);
        let value = text::number(word)
            .ok_or_else(|| fault(field, Reason::NotANumber { name: name.clone(), text: text.clone() }))?;
        if value.abs() * scale >= LARGEST {
            return Err(fault(field, Reason::TooLarge { name, text }));
        }
        // Divided where that is exact: 12345 mm are 12.345 m to the last digit.
        xyz[k] = if scale < 1.0 { value / (1.0 / scale).round() } else { value * scale };
    }
    let label = Some(label.trim()).filter(|label| !label.is_empty()).map(str::to_owned);
    let point = Point { id: id.to_owned(), role: Role::Control, xyz: Some(xyz), ..Point::default() };
    Ok(ControlRow { line, label, point })
}

/// Lines of the start tags of a name, in their order.
fn tag_lines(text: &str, name: &str) -> Vec<usize> {
    let open = format!("<{name}");
    let starts = |line: &str| {
        let behind =
            |at: usize| line[at + open.len()..].starts_with(|c: char| c.is_whitespace() || c == '>' || c == '/');
        let ends = |at: usize| line.len() == at + open.len();
        line.match_indices(&open).filter(|(at, _)| ends(*at) || behind(*at)).count()
    };
    text.lines().enumerate().flat_map(|(k, line)| std::iter::repeat_n(k + 1, starts(line))).collect()
}
