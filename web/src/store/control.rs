//! Control points, scale and datum: what ties the object to the world.

use leptos::prelude::*;
use sightline::Error;
use sightline::error::Lack;
use sightline::exchange::control_csv::{self, ControlTable};
use sightline::project::{DatumKind, Distance, Role};

use super::Desk;
use super::document::{Change, Document};
use crate::edit::control::{self, DistanceFault};
use crate::format;
use crate::i18n::text;

/// Control points that were pasted or opened, waiting to be taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Pasted {
    pub source: String,
    pub table: ControlTable,
    /// The unit of its coordinates; none: it has to be asked for.
    pub unit: Option<String>,
}

impl Desk {
    /// Reads control points, to be looked at before they are taken; whether there are any.
    pub fn read_control(self, source: String, content: &str) -> bool {
        let table = control_csv::parse(content);
        if table.rows.is_empty() {
            self.warn_error(Error::Empty { what: Lack::Points });
            return false;
        }
        // Coordinates beside others are in their unit unless someone says otherwise; the first ones could be in any.
        let known = self.document.with_untracked(|d| control::has_lengths(&d.project).then(|| d.project.unit.clone()));
        let chosen = self.pasted.with_untracked(|p| p.as_ref().and_then(|p| p.unit.clone()));
        self.pasted.set(Some(Pasted { source, table, unit: known.or(chosen) }));
        true
    }

    /// Says in which unit the coordinates waiting to be taken are.
    pub fn set_pasted_unit(self, unit: &str) {
        let unit = Some(unit.trim().to_owned()).filter(|unit| !unit.is_empty());
        self.pasted.update(|pasted| {
            if let Some(pasted) = pasted {
                pasted.unit = unit;
            }
        });
    }

    /// Takes the rows that were understood.
    pub fn take_control(self) {
        let Some(pasted) = self.pasted.get_untracked() else { return };
        let Some(unit) = pasted.unit.clone() else {
            return self.warn_here(|| text::which_unit().to_owned());
        };
        let (points, _) = pasted.table.split();
        if points.is_empty() {
            return;
        }
        self.change(Change::ControlTaken(points.len()), |document| {
            control::take_points(document.project_mut(), points, &unit);
        });
        self.pasted.set(None);
    }

    pub fn set_role(self, id: &str, role: Role) {
        self.change(Change::RoleSet(id.to_owned()), |document| control::set_role(document.project_mut(), id, role));
    }

    /// Takes one of a point's coordinates as typed.
    pub fn set_coordinate(self, id: &str, axis: usize, typed: &str) {
        let Some(value) = format::parse(typed) else { return self.refuse(typed, text::not_a_number) };
        self.change(Change::ControlEdited(id.to_owned()), |document| {
            control::set_coordinate(document.project_mut(), id, axis, value);
        });
    }

    /// Takes the standard error of one of a point's coordinates as typed; nothing or 0 fixes it.
    pub fn set_control_sigma(self, id: &str, axis: usize, typed: &str) {
        let sigma = format::parse(typed).filter(|sigma| *sigma >= 0.0);
        if sigma.is_none() && !typed.trim().is_empty() {
            return self.refuse(typed, text::no_sigma);
        }
        self.change(Change::ControlEdited(id.to_owned()), |document| {
            control::set_sigma(document.project_mut(), id, axis, sigma.filter(|sigma| *sigma > 0.0));
        });
    }

    /// Adds a measured distance, or says what it lacks.
    pub fn add_distance(self, from: &str, to: &str, length: &str, sigma: &str) -> Result<(), DistanceFault> {
        let number = |typed: &str| format::parse(typed).unwrap_or(f64::NAN);
        let (from, to) = (from.trim().to_owned(), to.trim().to_owned());
        let distance =
            Distance { from: from.clone(), to: to.clone(), length: number(length), sigma: number(sigma), check: false };
        let mut project = self.document.with_untracked(|d| (*d.project).clone());
        control::add_distance(&mut project, distance)?;
        self.change(Change::DistanceAdded { from, to }, |document| *document.project_mut() = project);
        Ok(())
    }

    /// Changes a distance in one of its numbers, as typed.
    pub fn edit_distance(self, place: usize, typed: &str, set: fn(&mut Distance, f64)) {
        let value = format::parse(typed).unwrap_or(f64::NAN);
        let mut after = self.document.get_untracked();
        match control::edit_distance(after.project_mut(), place, |distance| set(distance, value)) {
            Err(fault) => self.warn_here(move || distance_fault(fault).to_owned()),
            Ok(ends) => self.take_distance(ends, |from, to| Change::DistanceEdited { from, to }, after),
        }
    }

    /// Has a distance compared only, or take part.
    pub fn set_distance_check(self, place: usize, check: bool) {
        let mut after = self.document.get_untracked();
        let ends = control::set_check(after.project_mut(), place, check);
        self.take_distance(ends, |from, to| Change::DistanceEdited { from, to }, after);
    }

    pub fn remove_distance(self, place: usize) {
        let mut after = self.document.get_untracked();
        let ends = control::remove_distance(after.project_mut(), place);
        self.take_distance(ends, |from, to| Change::DistanceRemoved { from, to }, after);
    }

    /// Takes what was done with the distance between two points, where there was one.
    fn take_distance(self, ends: Option<(String, String)>, change: fn(String, String) -> Change, after: Document) {
        if let Some((from, to)) = ends {
            self.change(change(from, to), |document| *document = after);
        }
    }

    pub fn set_datum(self, kind: DatumKind) {
        self.change(Change::DatumChosen, |document| control::set_datum(document.project_mut(), kind));
    }

    pub fn set_unit(self, unit: &str) {
        let mut after = self.document.get_untracked();
        if control::set_unit(after.project_mut(), unit) {
            self.change(Change::UnitSet, |document| *document = after);
        }
    }
}

/// The sentence for a distance that cannot be taken.
pub fn distance_fault(fault: DistanceFault) -> &'static str {
    match fault {
        DistanceFault::SamePoint => text::distance_same_point(),
        DistanceFault::NoSuchPoint => text::distance_no_point(),
        DistanceFault::Length => text::distance_length(),
        DistanceFault::Sigma => text::distance_sigma(),
    }
}
