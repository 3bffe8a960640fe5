//! Lists of latitude, longitude and ellipsoidal height: their angles, and east, north and up in a local system.

use super::angles::{self, AngleForm};
use super::assumptions::Assumption;
use super::columns::{Columns, Field};
use super::conventions::Basis;
use super::{ControlRow, TableChoices};
use crate::reason::ExchangeReason;
use sightline::error::{Error, Place, Result};
use sightline::project::{Geographic, LocalSystem};
use sightline::units::Unit;

/// Largest latitude and longitude, degrees.
pub(super) const LIMITS: [f64; 2] = [180.0, 90.0];

/// The form of most angles of the rows; whole degrees are of either form.
pub(super) fn form(rows: &[&[String]], columns: &Columns) -> AngleForm {
    let places: Vec<usize> =
        [Field::Latitude, Field::Longitude].iter().filter_map(|field| columns.place(*field)).collect();
    let words = rows.iter().flat_map(|row| places.iter().filter_map(|k| row.get(*k)));
    let decided = words.filter_map(|word| angles::angle(word)).filter(|angle| angle.degrees.fract() != 0.0);
    let (mut sexagesimal, mut all) = (0, 0);
    for angle in decided {
        all += 1;
        sexagesimal += usize::from(angle.form == AngleForm::Sexagesimal);
    }
    if 2 * sexagesimal > all { AngleForm::Sexagesimal } else { AngleForm::Degrees }
}

/// Brings rows of longitude and latitude in decimal degrees and height in metres to east, north and up; rows that are outside become errors.
pub(crate) fn into_local_system(rows: &mut [Result<ControlRow>], choices: &TableChoices) -> Option<Assumption> {
    for row in rows.iter_mut() {
        let Ok(ControlRow { line, point, .. }) = row else { continue };
        let outside = |(axis, field): (usize, Field)| {
            let value = point.xyz.map_or(0.0, |xyz| xyz[axis]);
            (value.abs() > LIMITS[axis]).then(|| {
                let (name, text, limit) = (field.name().to_owned(), value.to_string(), LIMITS[axis].into());
                let at = Place::line(*line).with_field(field.name());
                Error::Invalid { reason: ExchangeReason::AngleOutside { name, text, limit }.into(), at }
            })
        };
        let found = [Field::Longitude, Field::Latitude].into_iter().enumerate().find_map(outside);
        if let Some(error) = found {
            *row = Err(error);
        }
    }
    convert(rows, AngleForm::Degrees, Unit::Metre, choices)
}

/// Brings rows of longitude, latitude and height to east, north and up.
pub(super) fn convert(
    rows: &mut [Result<ControlRow>],
    form: AngleForm,
    height_unit: Unit,
    choices: &TableChoices,
) -> Option<Assumption> {
    let place = |xyz: [f64; 3]| Geographic { longitude: xyz[0], latitude: xyz[1], height: xyz[2] };
    let places: Vec<Geographic> = rows.iter().flatten().filter_map(|row| row.point.xyz).map(place).collect();
    let (system, by) = match choices.local_system {
        Some(system) => (system, Basis::Given),
        None => (LocalSystem::at_mean(&places)?, Basis::Convention),
    };
    for xyz in rows.iter_mut().flatten().filter_map(|row| row.point.xyz.as_mut()) {
        *xyz = system.from_geographic(place(*xyz));
    }
    Some(Assumption::LocalSystem { system, form, height_unit, by })
}
