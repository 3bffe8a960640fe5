//! Reads one row of a table of control points: the point, or the error with the field in which it is.

use super::angles::{self, AngleForm};
use super::columns::{Columns, Fault, Field};
use super::conventions::{Basis, Decimal};
use super::decimals::{Sign, readings, sign_of, without_thousands};
use super::{ControlRow, geographic};
use crate::reason::ExchangeReason;
use crate::text::{self, Row};
use sightline::axes::ShownAxes;
use sightline::error::{Reason, shortened};
use sightline::project::{LARGEST, Point, Role};

/// Reads the rows of a table of control points.
pub(super) struct ControlRowReader<'a> {
    pub columns: &'a Columns,
    pub decimal: Decimal,
    pub decimal_by: Basis,
    pub scales: &'a [Option<f64>],
    /// Words of the heading, column by column; empty without one.
    pub heading: &'a [String],
    /// Axes whose letters name the columns of a list without a heading.
    pub axes: ShownAxes,
    /// How the angles of latitudes and longitudes are written; none in a list of plane coordinates.
    pub form: Option<AngleForm>,
}

impl ControlRowReader<'_> {
    /// A field by the words of the list: its heading, else the letters of the user's axes.
    fn name(&self, field: Field) -> String {
        let heading = self.columns.place(field).and_then(|place| self.heading.get(place)).map(|word| word.trim());
        match (heading.filter(|word| !word.is_empty()), field.axis()) {
            (Some(word), _) => shortened(word),
            (None, Some(axis)) if field.is_coordinate() => self.axes.letter(axis).to_owned(),
            (None, Some(axis)) => format!("s{}", self.axes.letter(axis)),
            (None, None) => field.name().to_owned(),
        }
    }

    pub fn fault(&self, field: Field, reason: Reason) -> Fault {
        Fault { field: self.name(field), reason }
    }

    pub fn row(&self, line: &Row) -> Result<ControlRow, Fault> {
        let text = |field: Field| {
            self.columns.place(field).and_then(|place| line.fields.get(place)).map(String::as_str).unwrap_or_default()
        };
        let required = |field: Field| match text(field) {
            "" => Err(self.fault(field, Reason::Missing { name: self.name(field) })),
            found => Ok(found),
        };
        let coordinate = |field: Field| self.number(field, required(field)?);
        // Measured to a millimetre or held: a blank, a dash or "fix" is an axis without sigma.
        let sigma =
            |field: Field| match text(field) {
                "" | "-" => Ok(None),
                word if word.eq_ignore_ascii_case("fix") || word.eq_ignore_ascii_case("fixed") => Ok(None),
                word => match self.number(field, word)? {
                    sigma if sigma >= 0.0 => Ok(Some(sigma)),
                    sigma => Err(self
                        .fault(field, ExchangeReason::Negative { name: self.name(field), value: sigma.into() }.into())),
                },
            };
        let id = text::armed(required(Field::Id)?).to_owned();
        let xyz = match self.form {
            Some(form) => {
                let [longitude, latitude] = [Field::Longitude, Field::Latitude];
                [
                    self.angle(longitude, required(longitude)?, form)?,
                    self.angle(latitude, required(latitude)?, form)?,
                    coordinate(Field::Z)?,
                ]
            }
            None => [coordinate(Field::X)?, coordinate(Field::Y)?, coordinate(Field::Z)?],
        };
        let sigma = if self.columns.place(Field::Sigma).is_some() {
            [sigma(Field::Sigma)?; 3]
        } else if self.columns.place(Field::Sxy).is_some() {
            let plane = sigma(Field::Sxy)?;
            [plane, plane, sigma(Field::Sz)?]
        } else {
            [sigma(Field::Sx)?, sigma(Field::Sy)?, sigma(Field::Sz)?]
        };
        let role = match text(Field::Role).to_ascii_lowercase().as_str() {
            "" | "control" => Role::Control,
            "check" => Role::Check,
            "tie" => Role::Tie,
            other => {
                let (name, choices) = (self.name(Field::Role), "control, check, tie".into());
                return Err(self.fault(Field::Role, Reason::NoneOf { name, choices, text: shortened(other) }));
            }
        };
        let diameter = match text(Field::Diameter) {
            "" | "-" => None,
            word => match self.number(Field::Diameter, word)? {
                diameter if diameter > 0.0 => Some(diameter),
                diameter => {
                    let (name, value) = (self.name(Field::Diameter), diameter.into());
                    return Err(self.fault(Field::Diameter, Reason::NotPositive { name, value }));
                }
            },
        };
        let label = Some(text(Field::Label)).filter(|label| !label.is_empty()).map(str::to_owned);
        let sigma = sigma.iter().any(Option::is_some).then_some(sigma);
        Ok(ControlRow {
            line: line.line,
            label,
            point: Point { id, role, xyz: Some(xyz), sigma, diameter, normal: None },
        })
    }

    /// A latitude or a longitude in degrees.
    fn angle(&self, field: Field, word: &str, form: AngleForm) -> Result<f64, Fault> {
        let (name, text) = (self.name(field), shortened(word));
        let axis = field.axis().unwrap_or_default();
        let found = match angles::angle(word) {
            // A number by itself has the decimal sign of the list.
            Some(angle) if !angle.marked => angles::Angle { degrees: self.number(field, word)?, ..angle },
            Some(angle) => angle,
            None => return Err(self.fault(field, ExchangeReason::NotAnAngle { name, text }.into())),
        };
        if found.axis.is_some_and(|own| own != axis) {
            return Err(self.fault(field, ExchangeReason::AngleDirection { name, text }.into()));
        }
        if found.form != form && found.degrees.fract() != 0.0 {
            return Err(self.fault(field, ExchangeReason::AngleForm { name, text }.into()));
        }
        let limit = geographic::LIMITS[axis];
        if found.degrees.abs() > limit {
            let limit = limit.into();
            return Err(self.fault(field, ExchangeReason::AngleOutside { name, text, limit }.into()));
        }
        Ok(found.degrees)
    }

    fn number(&self, field: Field, word: &str) -> Result<f64, Fault> {
        let (name, text) = (|| self.name(field), || shortened(word));
        if self.decimal_by == Basis::Undecided && sign_of(word) == Sign::Either {
            let [decimal, thousands] = readings(word);
            return Err(self.fault(
                field,
                ExchangeReason::AmbiguousNumber { name: name(), text: text(), decimal, thousands }.into(),
            ));
        }
        if angles::is_angle(word) {
            return Err(self.fault(field, ExchangeReason::AngleUnexpected { name: name(), text: text() }.into()));
        }
        let plain = match self.decimal {
            Decimal::Point if word.contains(',') => {
                match without_thousands(word).filter(|_| self.decimal_by == Basis::Given) {
                    Some(plain) => plain,
                    None => {
                        return Err(
                            self.fault(field, ExchangeReason::CommaAmongPoints { name: name(), text: text() }.into())
                        );
                    }
                }
            }
            Decimal::Comma if word.contains('.') => {
                return Err(self.fault(field, ExchangeReason::PointAmongCommas { name: name(), text: text() }.into()));
            }
            Decimal::Point => word.to_owned(),
            Decimal::Comma => word.replacen(',', ".", 1),
        };
        let plain = plain.replace('\u{2212}', "-");
        let value =
            text::number(&plain).ok_or_else(|| self.fault(field, Reason::NotANumber { name: name(), text: text() }))?;
        let scale = self.columns.place(field).and_then(|k| self.scales.get(k).copied()).unwrap_or(Some(1.0));
        let Some(scale) = scale else { return Err(self.fault(field, ExchangeReason::UnitOfCoordinates.into())) };
        let value = value * scale;
        if value.abs() < LARGEST {
            Ok(value)
        } else {
            Err(self.fault(field, Reason::TooLarge { name: name(), text: text() }))
        }
    }
}
