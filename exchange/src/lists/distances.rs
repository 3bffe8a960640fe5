//! Lists of distances, as scale bars come with: from, to, length, perhaps a standard error of its own, in rows of any separator.
//!
//! A heading names the columns and their units ("Length [mm]"). Without one a text is such a list where its first two columns name points that
//! are known. One text has one decimal sign; a number that can be read in two ways is refused until it is chosen, and a length without a standard
//! error until a rule gives one.

use crate::reason::ExchangeReason;
use std::collections::{BTreeSet, HashSet};

use serde::Serialize;

use super::super::control_csv::{
    Assumption, Basis, Decimal, Sign, TableChoices, decide_decimals, decimal_readings, sign_of, without_thousands,
};
use super::super::text::{self, Row};
use super::super::{FileAssumptions, Files, Imported, encoding};
use sightline::error::{Error, Lack, Place, Reason, Result, shortened};
use sightline::project::{Distance, Point};
use sightline::units::Unit;

/// Name of the column of standard errors, in the errors of rows.
pub const SIGMA: &str = "sigma";

/// A column.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Column {
    From,
    To,
    Length,
    Sigma,
}

impl Column {
    fn name(self) -> &'static str {
        match self {
            Self::From => "from",
            Self::To => "to",
            Self::Length => "length",
            Self::Sigma => SIGMA,
        }
    }
}

/// A list of distances.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct DistanceList {
    /// Rows that were understood, and what is wrong with the others.
    #[serde(skip)]
    pub rows: Vec<Result<Distance>>,
    /// Unit of lengths and standard errors, where the heading or the caller names one; null: it has to be asked.
    pub unit: Option<Unit>,
    /// Whether a heading names the columns; without one they are from, to, length, standard error.
    pub has_heading: bool,
    /// How it was read.
    pub assumptions: Vec<Assumption>,
}

fn said(word: &str) -> Option<Column> {
    let bare = word.split(['[', '(']).next().unwrap_or_default();
    let plain: String = bare.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect();
    Some(match plain.as_str() {
        "from" | "frompoint" | "point1" | "p1" | "pointa" | "start" | "von" | "punkt1" | "de" | "시점" | "점1"
        | "시작점" | "始点" => Column::From,
        "to" | "topoint" | "point2" | "p2" | "pointb" | "end" | "nach" | "bis" | "punkt2" | "à" | "종점" | "점2"
        | "끝점" | "終点" => Column::To,
        "length" | "distance" | "dist" | "länge" | "laenge" | "strecke" | "distanz" | "longueur" | "거리" | "길이"
        | "距離" => Column::Length,
        "sigma" | "s" | "σ" | "std" | "sd" | "slength" | "accuracy" | "정확도" | "표준오차" | "genauigkeit" => {
            Column::Sigma
        }
        _ => return None,
    })
}

/// A unit in brackets.
fn unit_in(word: &str) -> Result<Option<Unit>> {
    let Some((_, inner)) = word.split_once(['[', '(']) else { return Ok(None) };
    let inner = inner.trim_end_matches([']', ')']).trim();
    let reason = || Reason::NoneOf { name: "unit".into(), choices: Unit::list(), text: shortened(inner) };
    Unit::named(inner).map(Some).ok_or_else(|| Error::Invalid { reason: reason(), at: Place::field("unit") })
}

/// The columns of a heading; none where the row is no heading of distances.
fn heading(row: &Row) -> Option<Vec<Option<Column>>> {
    let columns: Vec<Option<Column>> = row.fields.iter().map(|field| said(field)).collect();
    let named = |column| columns.iter().filter(|held| **held == Some(column)).count() == 1;
    (named(Column::From) && named(Column::To) && named(Column::Length)).then_some(columns)
}

/// Whether a text is such a list: by its heading, or because the first two columns name points that are known.
pub fn recognises(text: &str, known: &HashSet<&str>) -> bool {
    let rows = text::rows(text);
    let Some(first) = rows.first() else { return false };
    let ends =
        |row: &&Row| (3..=4).contains(&row.fields.len()) && row.fields[..2].iter().all(|f| known.contains(f.as_str()));
    heading(first).is_some() || 2 * rows.iter().filter(ends).count() > rows.len()
}

/// Reads a list; never fails as a whole.
pub fn read(text: &str, choices: &TableChoices) -> DistanceList {
    let rows = text::rows(text);
    let Some(first) = rows.first() else { return DistanceList::default() };
    let named = heading(first);
    let columns = named.clone().unwrap_or_else(|| {
        let mut columns = vec![Some(Column::From), Some(Column::To), Some(Column::Length)];
        columns.resize(rows.iter().map(|row| row.fields.len()).max().unwrap_or(3).max(3), None);
        if columns.len() > 3 {
            columns[3] = Some(Column::Sigma);
        }
        columns
    });
    let body = if named.is_some() { &rows[1..] } else { &rows[..] };
    let place = |column| columns.iter().position(|held| *held == Some(column));
    let unit_of = |column| match (named.is_some(), place(column)) {
        (true, Some(k)) => unit_in(&first.fields[k]).map_err(|error| at_line(error, first.line)),
        _ => Ok(None),
    };
    let (unit, sigma_unit) = match (unit_of(Column::Length), unit_of(Column::Sigma)) {
        (Ok(unit), Ok(sigma)) => (unit, sigma),
        (Err(error), _) | (_, Err(error)) => return DistanceList { rows: vec![Err(error)], ..DistanceList::default() },
    };
    let by = if unit.is_some() {
        Basis::Heading
    } else if choices.unit.is_some() {
        Basis::Given
    } else {
        Basis::Convention
    };
    let unit = unit.or(choices.unit);
    let numbers = || {
        let of = [Column::Length, Column::Sigma].map(place);
        body.iter().flat_map(move |row| of.into_iter().flatten().filter_map(|k| row.fields.get(k)).map(String::as_str))
    };
    let (decimal, decimal_by, example) = decide_decimals(numbers(), choices.decimal);
    let reader = DistanceRowReader { place: &place, unit, sigma_unit, decimal, decimal_by, choices };
    let rows = body.iter().map(|row| reader.row(row)).collect();
    let assumptions =
        vec![Assumption::DecimalSign { sign: decimal, by: decimal_by, example }, Assumption::Unit { unit, by }];
    DistanceList { rows, unit, has_heading: named.is_some(), assumptions }
}

/// Distances with their points, in the unit of the first list that names one.
///
/// # Errors
/// The first row that is not understood, [`Error::Empty`] for a list without rows.
pub(crate) fn import(files: &Files, choices: &TableChoices) -> Result<Imported> {
    let mut imported = Imported::default();
    let mut unit = None;
    let mut names = BTreeSet::new();
    for (name, bytes) in files {
        let (text, ..) = encoding::list(bytes, choices.encoding).map_err(|error| error.in_file(name))?;
        let list = read(&text, choices);
        if list.rows.is_empty() {
            return Err(Error::Empty { what: Lack::Points }.in_file(name));
        }
        imported.assumptions.push(FileAssumptions { file: name.clone(), assumptions: list.assumptions });
        unit = unit.or(list.unit);
        let factor = list.unit.zip(unit).map_or(1.0, |(own, unit)| own.factor(unit));
        for row in list.rows {
            let mut distance = row.map_err(|error| error.in_file(name))?;
            (distance.length, distance.sigma) = (distance.length * factor, distance.sigma * factor);
            names.extend([distance.from.clone(), distance.to.clone()]);
            imported.project.distances.push(distance);
        }
    }
    imported.project.points.extend(names.into_iter().map(|id| Point { id, ..Point::default() }));
    if let Some(unit) = unit {
        imported.project.unit = unit.symbol().to_owned();
    }
    imported.project.validate()?;
    Ok(imported)
}

fn at_line(error: Error, line: usize) -> Error {
    match error {
        Error::Invalid { reason, at } => Error::Invalid { reason, at: Place { line: Some(line), ..at } },
        other => other,
    }
}

struct DistanceRowReader<'a> {
    place: &'a dyn Fn(Column) -> Option<usize>,
    unit: Option<Unit>,
    sigma_unit: Option<Unit>,
    decimal: Decimal,
    decimal_by: Basis,
    choices: &'a TableChoices,
}

impl DistanceRowReader<'_> {
    fn row(&self, row: &Row) -> Result<Distance> {
        let word = |column: Column| (self.place)(column).and_then(|k| row.fields.get(k)).map_or("", String::as_str);
        let fault = |column: Column, reason| row.invalid(column.name(), reason);
        let end = |column: Column| match text::armed(word(column)) {
            "" => Err(fault(column, Reason::Missing { name: column.name().into() })),
            name => Ok(name.to_owned()),
        };
        let positive = |column: Column| -> Result<f64> {
            let value = self.number(row, column, word(column))?;
            let reason = || Reason::NotPositive { name: column.name().into(), value: value.into() };
            if value > 0.0 { Ok(value) } else { Err(fault(column, reason())) }
        };
        let (from, to, length) = (end(Column::From)?, end(Column::To)?, positive(Column::Length)?);
        let needs_unit = || fault(Column::Sigma, ExchangeReason::UnitOfCoordinates.into());
        let factor = |own: Option<Unit>| match (own, self.unit) {
            (Some(own), Some(unit)) => Ok(own.factor(unit)),
            (Some(_), None) => Err(needs_unit()),
            (None, _) => Ok(1.0),
        };
        let sigma = match (word(Column::Sigma), &self.choices.sigma) {
            ("" | "-", Some(rule)) => rule.constant * factor(rule.unit)? + 1e-6 * rule.ppm * length,
            ("" | "-", None) => {
                return Err(fault(Column::Sigma, Reason::Missing { name: Column::Sigma.name().into() }));
            }
            _ => positive(Column::Sigma)? * factor(self.sigma_unit.or(self.choices.sigma_unit))?,
        };
        Ok(Distance { from, to, length, sigma, check: false })
    }

    fn number(&self, row: &Row, column: Column, word: &str) -> Result<f64> {
        let (name, text) = (column.name().to_owned(), shortened(word));
        if word.is_empty() {
            return Err(row.invalid(column.name(), Reason::Missing { name }));
        }
        if self.decimal_by == Basis::Undecided && sign_of(word) == Sign::Either {
            let [decimal, thousands] = decimal_readings(word);
            return Err(
                row.invalid(column.name(), ExchangeReason::AmbiguousNumber { name, text, decimal, thousands }.into())
            );
        }
        let plain = match self.decimal {
            Decimal::Point => {
                without_thousands(word).filter(|_| self.decimal_by == Basis::Given).unwrap_or_else(|| word.to_owned())
            }
            Decimal::Comma => word.replacen(',', ".", 1),
        };
        let number = text::number(&plain);
        number.ok_or_else(|| row.invalid(column.name(), Reason::NotANumber { name, text }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control_csv::SigmaRule;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn told(list: &DistanceList) -> Vec<(String, String, f64, f64)> {
        let row = |d: &Distance| (d.from.clone(), d.to.clone(), d.length, (d.sigma * 1e9).round() / 1e9);
        list.rows.iter().flatten().map(row).collect()
    }

    #[test]
    fn semicolons_separate_where_every_line_has_a_decimal_comma() {
        let text = "A;B;1,5;0,001\nB;C;2,25;0,001\n";
        assert!(recognises(text, &HashSet::from(["A", "B", "C"])));
        let list = read(text, &TableChoices::default());
        assert_eq!(told(&list), [("A".into(), "B".into(), 1.5, 1e-3), ("B".into(), "C".into(), 2.25, 1e-3)]);
        assert!(!list.has_heading);
    }

    #[test]
    fn headings_of_several_languages_have_columns_and_units() {
        let wanted =
            vec![("A".to_owned(), "B".to_owned(), 500.25, 0.02), ("B".to_owned(), "C".to_owned(), 250.5, 0.01)];
        for text in [
            "from,to,length [mm],sigma [µm]\nA,B,500.25,20\nB,C,250.5,10\n",
            "Bar\tPunkt 1\tPunkt 2\tLänge (mm)\tGenauigkeit\n1\tA\tB\t500,25\t0,02\n2\tB\tC\t250,5\t0,01\n",
            "시점;종점;거리[mm];표준오차\nA;B;500.25;0.02\nB;C;250.5;0.01\n",
        ] {
            let list = read(text, &TableChoices::default());
            assert_eq!((told(&list), list.unit), (wanted.clone(), Some(Unit::Millimetre)), "{text}");
            assert!(recognises(text, &HashSet::new()));
        }
    }

    #[test]
    fn what_is_open_is_refused_until_it_is_chosen() {
        let text = "A\tB\t1,234\nB\tC\t2,345\n";
        let known = HashSet::from(["A", "B", "C"]);
        assert!(recognises(text, &known) && !recognises(text, &HashSet::from(["A"])));
        let first = |choices: &TableChoices| read(text, choices).rows[0].clone();
        let open = first(&TableChoices::default()).unwrap_err();
        assert!(matches!(ExchangeReason::of_error(&open), Some(ExchangeReason::AmbiguousNumber { .. })), "{open}");
        let comma = TableChoices { decimal: Some(Decimal::Comma), ..TableChoices::default() };
        let missing = first(&comma).unwrap_err();
        assert_eq!(missing.place().field.as_deref(), Some("sigma"));
        let rule = SigmaRule::read("0.1 mm + 10 ppm").unwrap();
        let choices = TableChoices { sigma: Some(rule), unit: Some(Unit::Metre), ..comma };
        let distance = first(&choices).unwrap();
        assert!((distance.sigma - (1e-4 + 1.234e-5)).abs() < 1e-15 && distance.length == 1.234);
        // Control points are no distances.
        assert!(!recognises("id,X,Y,Z\nA,1,2,3\n", &known) && !recognises("A 1.5 2.5 3.5\n", &known));
        for (row, field) in [("A,B,-1,1", "length"), ("A,,1,1", "to"), ("A,B,x,1", "length"), ("A,B,1,0", "sigma")] {
            let list = read(&format!("from,to,length,sigma\n{row}\n"), &TableChoices::default());
            let place = list.rows[0].as_ref().unwrap_err().place();
            assert_eq!((place.line, place.field.as_deref()), (Some(2), Some(field)), "{row}");
        }
    }
}
