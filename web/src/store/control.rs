//! Control points, scale and datum: what ties the object to the world.

use std::rc::Rc;

use leptos::prelude::*;
use sightline::Error;
use sightline::error::{Lack, Place};
use sightline::exchange::control_csv::{self, Choices, ControlTable};
use sightline::project::{DatumKind, Distance, Point, Project, Role};
use sightline::units::{self, Unit};

use super::document::{Change, Document};
use super::{Asking, Desk};
use crate::edit::control::{self, DistanceFault};
use crate::edit::unit;
use crate::format;
use crate::i18n::{Text, text};

/// Control points that were pasted or opened, waiting to be taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Pasted {
    pub source: String,
    /// The text, to be read anew with other choices.
    pub content: String,
    pub choices: Choices,
    pub table: ControlTable,
    /// The unit of its coordinates; none: it has to be asked for.
    pub unit: Option<String>,
}

impl Pasted {
    /// Its good points in another unit.
    ///
    /// # Errors
    /// For units that cannot be converted.
    pub fn points_in(&self, unit: &str) -> Result<Vec<Point>, Error> {
        let points = self.table.clone().split().0;
        let factor = self.unit.as_deref().map_or(Ok(1.0), |own| units::factor(own, unit))?;
        Project { points, ..Project::default() }.scaled(factor).map(|project| project.points)
    }

    /// Whether something has to be answered before its points are taken.
    pub fn is_asked(&self) -> bool {
        self.unit.is_none() || self.table.undecided().next().is_some()
    }
}

impl Desk {
    /// Reads control points, to be looked at before they are taken; whether there are any.
    pub fn read_control(self, source: String, content: &str) -> bool {
        let table = control_csv::parse(content);
        if table.rows.is_empty() {
            self.warn_error(Error::Empty { what: Lack::Points });
            return false;
        }
        self.show_control(source, content.to_owned(), Choices::default(), table);
        true
    }

    /// Reads the control points that wait anew, with an answer to what their text leaves open.
    pub fn choose_reading(self, choose: impl FnOnce(&mut Choices)) {
        let Some(Pasted { source, content, mut choices, .. }) = self.pasted.get_untracked() else { return };
        choose(&mut choices);
        let table = control_csv::parse_with(&content, choices);
        self.show_control(source, content, choices, table);
    }

    fn show_control(self, source: String, content: String, choices: Choices, table: ControlTable) {
        // Coordinates beside others are in their unit unless someone says otherwise; the first ones could be in any.
        let known = self.document.with_untracked(|d| control::has_lengths(&d.project).then(|| d.project.unit.clone()));
        let chosen = self.pasted.with_untracked(|p| p.as_ref().and_then(|p| p.unit.clone()));
        // What the heading says is no question.
        let unit = table.unit.map(|unit| unit.symbol().to_owned()).or(chosen).or(known);
        self.pasted.set(Some(Pasted { source, content, choices, table, unit }));
    }

    /// Says in which unit the coordinates waiting to be taken are.
    pub fn set_pasted_unit(self, unit: &str) {
        let chosen = Some(unit.trim().to_owned()).filter(|unit| !unit.is_empty());
        let known = chosen.as_deref().and_then(Unit::named);
        self.pasted.update(|pasted| {
            if let Some(pasted) = pasted {
                pasted.unit = chosen;
            }
        });
        self.choose_reading(|choices| choices.unit = known);
    }

    /// Takes the rows that were understood.
    pub fn take_control(self) {
        let Some(pasted) = self.pasted.get_untracked() else { return };
        let Some(unit) = pasted.unit.clone() else {
            return self.warn_here(|| text::which_unit().to_owned());
        };
        if pasted.is_asked() {
            return;
        }
        let (points, _) = pasted.table.split();
        if points.is_empty() {
            return;
        }
        let count = points.len();
        let mut after = self.document.get_untracked();
        // The first given lengths bring their unit; what else has lengths goes with it.
        let first = !control::has_lengths(&after.project) && unit::holds_lengths(&after);
        let converted = match Unit::named(&unit).filter(|_| first) {
            Some(unit) => unit::convert(&mut after, unit),
            None => Ok(()),
        };
        let taken = converted.and_then(|()| control::take_points(after.project_mut(), points, &unit));
        if let Err(error) = taken {
            return self.warn_error(error);
        }
        self.change(Change::ControlTaken(count), |document| *document = after);
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
        if [length, sigma].into_iter().any(|typed| format::ambiguous(typed).is_some()) {
            return Err(DistanceFault::Ambiguous);
        }
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
        if format::ambiguous(typed).is_some() {
            return self.refuse(typed, text::not_a_number);
        }
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

    /// Takes a unit as typed. Where the document has lengths it is asked whether they are converted or were in it all along.
    pub fn set_unit(self, typed: &str) {
        let unit = match Unit::known(typed, Place::field("unit")) {
            Ok(unit) => unit,
            Err(error) => return self.warn_error(error),
        };
        let before = self.document.with_untracked(|d| d.project.unit.clone());
        if before == unit.symbol() {
            return;
        }
        let known = Unit::named(&before);
        let relabel = move || self.change(Change::UnitSet, |document| unit::relabel(document, unit));
        if known == Some(unit) || !self.document.with_untracked(unit::holds_lengths) {
            return relabel();
        }
        let relabel: Rc<dyn Fn()> = Rc::new(relabel);
        let Some(known) = known else {
            let text = Rc::new(move || text::unit_unknown_question(&before, unit.symbol()));
            self.asking.set(Some(Asking { text, choices: vec![(text::unit_is_right as Text, relabel)] }));
            return;
        };
        let convert: Rc<dyn Fn()> = Rc::new(move || {
            let mut after = self.document.get_untracked();
            match unit::convert(&mut after, unit) {
                Ok(()) => self.change(Change::UnitConverted, |document| *document = after),
                Err(error) => self.warn_error(error),
            }
        });
        let after = format::editable(1000.0 * known.factor(unit));
        let text = Rc::new(move || text::unit_question(known.symbol(), unit.symbol(), after.clone()));
        let choices = vec![(text::unit_convert as Text, convert), (text::unit_relabel as Text, relabel)];
        self.asking.set(Some(Asking { text, choices }));
    }
}

/// The sentence for a distance that cannot be taken.
pub fn distance_fault(fault: DistanceFault) -> &'static str {
    match fault {
        DistanceFault::SamePoint => text::distance_same_point(),
        DistanceFault::NoSuchPoint => text::distance_no_point(),
        DistanceFault::Length => text::distance_length(),
        DistanceFault::Sigma => text::distance_sigma(),
        DistanceFault::Ambiguous => text::ambiguous_short(),
    }
}
