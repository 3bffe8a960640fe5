//! Columns of a table as chosen by the user, in place of heading and content.

use super::columns::{Columns, Fault, Field};
use super::conventions::{Axes, Basis};
use super::{decimals, heading};
use crate::reason::ExchangeReason;
use sightline::error::shortened;

/// The columns of a table by choice; units stay those of its heading.
///
/// # Errors
/// [`Fault`] if a name or a coordinate is missing or there twice.
pub(super) fn given(chosen: &[Option<Field>], heading: Option<&[String]>, widest: usize) -> Result<Columns, Fault> {
    let mut fields = chosen.to_vec();
    // What is chosen for no column is left alone.
    fields.resize(widest.max(heading.map_or(0, <[String]>::len)), None);
    for (k, field) in fields.iter().enumerate() {
        let Some(field) = field else { continue };
        if fields[..k].contains(&Some(*field)) {
            return Err(field.fault(ExchangeReason::HeadingTwice { name: field.name().into() }.into()));
        }
    }
    let geographic = fields.iter().flatten().any(|field| field.is_angle());
    let [east, north] = if geographic { [Field::Longitude, Field::Latitude] } else { [Field::X, Field::Y] };
    // Latitude and longitude are in place of X and Y, not beside them.
    if geographic && let Some(field) = [Field::X, Field::Y].into_iter().find(|field| fields.contains(&Some(*field))) {
        return Err(field.fault(ExchangeReason::PlaneAndGeographic { name: field.name().into() }.into()));
    }
    for field in [Field::Id, east, north, Field::Z] {
        if !fields.contains(&Some(field)) {
            return Err(field.fault(ExchangeReason::HeadingIncomplete { name: field.name().into() }.into()));
        }
    }
    let mut units = heading.map(heading::units).unwrap_or_default();
    units.resize(fields.len(), None);
    let words = heading.unwrap_or_default();
    let ignored = words.iter().zip(&fields).filter(|(word, field)| field.is_none() && !word.is_empty());
    let ignored = ignored.map(|(word, _)| shortened(word)).collect();
    let place = |field: Field| fields.iter().position(|column| *column == Some(field));
    let order = if place(east) < place(north) { Axes::Xy } else { Axes::Yx };
    Ok(Columns { units, by: Basis::Given, order: (order, Basis::Given), ignored, remarks: Vec::new(), fields })
}

/// Whether the first row is a heading whose words are not known: its columns of numbers contain none, while other rows have some.
pub(super) fn begins_with_words(rows: &[&[String]], chosen: &[Option<Field>]) -> bool {
    let places = || (0..chosen.len()).filter(|k| chosen[*k].is_some_and(Field::is_coordinate));
    let number = |row: &[String], k: usize| row.get(k).is_some_and(|word| decimals::is_value(word));
    let Some((first, others)) = rows.split_first() else { return false };
    places().all(|k| !number(first, k)) && others.iter().any(|row| places().all(|k| number(row, k)))
}
