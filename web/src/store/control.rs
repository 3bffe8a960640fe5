//! Control points, scale and datum.

use std::rc::Rc;
use std::sync::Arc;

use leptos::prelude::*;
use sightline::Error;
use sightline::axes::{ShownAxes, UserAxes};
use sightline::error::{Lack, Place};
use sightline::project::{DatumKind, Distance, LocalSystem, Point, Project, Role};
use sightline::units::{self, Unit};
use sightline_exchange::control_csv::{Assumption, Basis, ControlTable, Field, SigmaRule, TableChoices};
use sightline_exchange::encoding::Encoding;
use sightline_exchange::lists;

use super::{Asking, Desk, Step};
use crate::browser::page;
use crate::document::{Change, Document};
use crate::edit::control::{self, DistanceFault};
use crate::edit::unit;
use crate::format;
use crate::i18n::{Text, text};

/// Control points that were pasted or opened, waiting to be taken.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pasted {
    pub source: String,
    /// The list as it came, to be read anew with other choices.
    pub bytes: Arc<Vec<u8>>,
    /// Whether it is a file, whose encoding can be chosen.
    pub from_file: bool,
    /// The step that it came to, where it is answered; elsewhere it waits.
    pub at: Step,
    /// Its text.
    pub content: String,
    pub choices: TableChoices,
    pub table: ControlTable,
    /// The unit of its coordinates; none: it has to be asked for.
    pub unit: Option<String>,
    /// The standard error of all points as typed, and why it is not taken.
    pub typed_sigma: (String, Option<Error>),
    /// Role of its points if no column gives it; tie: their coordinates are approximate.
    pub role: Role,
    /// Whether it is read by the choices of an earlier list with this heading.
    pub remembered: bool,
    /// Axes of the project that it is for, as it was when the list came; none: it has none of its own.
    pub project_axes: Option<UserAxes>,
    /// The local system of earlier lists of the project.
    pub local_system: Option<LocalSystem>,
    /// Whether the project had given coordinates when the list came.
    pub beside_others: bool,
    /// Axes in which the project is shown with these points, where someone has chosen them.
    pub chosen_axes: Option<Option<UserAxes>>,
}

impl Pasted {
    /// Axes in which the project is shown once the list is taken: those chosen, its own, or those of the list.
    pub fn shown(&self) -> Option<UserAxes> {
        self.chosen_axes.unwrap_or(self.project_axes.or(self.table.user_axes()))
    }

    /// The same as letters and order.
    pub fn shown_axes(&self) -> ShownAxes {
        ShownAxes::of(self.shown())
    }

    /// Content of each column of the text.
    pub fn columns(&self) -> Vec<Option<Field>> {
        let count = self.table.sample.iter().map(Vec::len).max().unwrap_or(0).max(self.table.heading.len());
        let known = self.table.columns().or(self.choices.columns.as_deref()).unwrap_or_default();
        let mut columns = known.to_vec();
        columns.resize(count, None);
        columns
    }

    /// Whether the list itself has its unit.
    pub fn unit_of_the_list(&self) -> bool {
        let says =
            |a: &Assumption| matches!(a, Assumption::Unit { unit: Some(_), by: Basis::Heading | Basis::Content });
        self.table.assumptions.iter().any(says)
    }

    /// Whether a column gives the role of each point.
    pub fn has_roles(&self) -> bool {
        self.table.columns().is_some_and(|columns| columns.contains(&Some(Field::Role)))
    }

    /// Whether its coordinates are approximate ones of tie points.
    fn is_approximate(&self) -> bool {
        self.role == Role::Tie && !self.has_roles()
    }

    /// Its good points with the roles that they are taken as.
    pub fn taken(&self) -> Vec<Point> {
        let mut points = self.table.clone().split().0;
        if !self.has_roles() {
            points.iter_mut().for_each(|point| point.role = self.role);
        }
        points
    }

    /// Reads it anew by its choices.
    fn read(&mut self) -> Result<(), Error> {
        let mut choices = self.choices.clone();
        choices.project_axes = self.project_axes;
        choices.local_system = self.local_system;
        if !self.from_file {
            choices.encoding = Some(Encoding::Utf8);
        }
        (self.content, self.table) = lists::table(&self.bytes, &choices)?;
        Ok(())
    }

    /// Its good points in another unit.
    ///
    /// # Errors
    /// For units that cannot be converted.
    pub fn points_in(&self, unit: &str) -> Result<Vec<Point>, Error> {
        let points = self.taken();
        let factor = self.unit.as_deref().map_or(Ok(1.0), |own| units::factor(own, unit))?;
        Project { points: points.into(), ..Project::default() }.scaled(factor).map(|project| project.points.into())
    }

    /// Whether it is converted into a local system while given coordinates of the project are in another one, or may be.
    pub fn brings_another_system(&self) -> bool {
        self.beside_others && self.table.local_system().is_some_and(|system| self.local_system != Some(system))
    }

    /// Whether something has to be answered before its points are taken.
    pub fn is_asked(&self) -> bool {
        self.unit.is_none() || self.table.undecided().next().is_some()
    }
}

/// By which the choices for lists with a heading are found again; `None` without one.
fn reading_key(heading: &[String]) -> Option<String> {
    (!heading.is_empty()).then(|| format!("list {}", heading.join("\t")))
}

/// The choices that were made for an earlier list with this heading.
fn remembered(heading: &[String]) -> Option<TableChoices> {
    let kept = page::preference(&reading_key(heading)?)?;
    sightline_protocol::from_text(&kept).ok()
}

/// Remembers how columns, decimal sign and axes of a heading were read, if anything was chosen. Unit and standard error are of one list.
fn remember(pasted: &Pasted) {
    let TableChoices { decimal, axes, columns, .. } = pasted.choices.clone();
    if let Some(key) = reading_key(&pasted.table.heading)
        && (decimal.is_some() || axes.is_some() || columns.is_some())
    {
        let kept = TableChoices { decimal, axes, columns, ..TableChoices::default() };
        page::set_preference(&key, &sightline_protocol::to_text(&kept));
    }
}

impl Desk {
    /// Reads a list of points that was typed or pasted, to be examined before it is taken; whether there are any.
    pub fn read_control(self, source: String, content: &str) -> bool {
        self.read_list(Pasted { source, bytes: Arc::new(content.as_bytes().to_vec()), ..Pasted::default() })
    }

    /// The same of a file.
    pub fn read_control_file(self, source: String, bytes: Vec<u8>) -> bool {
        self.read_list(Pasted { source, bytes: Arc::new(bytes), from_file: true, ..Pasted::default() })
    }

    fn read_list(self, mut fresh: Pasted) -> bool {
        fresh.role = Role::Control;
        self.document.with_untracked(|d| {
            fresh.project_axes = d.project.axes;
            fresh.local_system = d.project.origin.as_ref().and_then(|origin| origin.local_system);
            fresh.beside_others = d.project.points.iter().any(|p| p.xyz.is_some() && p.role != Role::Tie);
        });
        fresh.at = self.step.get_untracked();
        if let Err(error) = fresh.read() {
            self.warn_error(error.in_file(&fresh.source));
            return false;
        }
        if fresh.table.rows.is_empty() {
            self.warn_error(Error::Empty { what: Lack::Points });
            return false;
        }
        if let Some(choices) = remembered(&fresh.table.heading) {
            let alone = fresh.clone();
            fresh.choices = choices;
            fresh.remembered = true;
            // What was chosen for another list may leave nothing of this one.
            if fresh.read().is_err() || fresh.table.rows.iter().all(Result::is_err) {
                fresh = alone;
            }
        }
        // What was chosen for the list before is not of this one.
        self.intake.pasted.set(None);
        self.show_control(fresh);
        true
    }

    /// Reads the list that waits by itself, without the choices of an earlier one.
    pub fn forget_reading(self) {
        let Some(mut pasted) = self.intake.pasted.get_untracked() else { return };
        if let Some(key) = reading_key(&pasted.table.heading) {
            page::set_preference(&key, "");
        }
        pasted.choices = TableChoices::default();
        pasted.remembered = false;
        match pasted.read() {
            Ok(()) => self.show_control(pasted),
            Err(error) => self.warn_error(error),
        }
    }

    /// Says what a column of the list holds; no other column holds the same.
    pub fn set_column(self, place: usize, field: Option<Field>) {
        self.choose_reading(|choices, columns| {
            let mut columns = columns.to_vec();
            match field {
                Some(field) => control::hold(&mut columns, place, field),
                None => columns.iter_mut().skip(place).take(1).for_each(|column| *column = None),
            }
            choices.columns = Some(columns);
        });
    }

    /// Takes one standard error for all points, as typed; nothing takes it away.
    pub fn set_list_sigma(self, typed: &str) {
        let rule = Some(typed.trim()).filter(|typed| !typed.is_empty()).map(SigmaRule::read).transpose();
        let (rule, fault) = match rule {
            Ok(rule) => (rule, None),
            Err(error) => (None, Some(error)),
        };
        let typed = typed.to_owned();
        self.intake.pasted.update(|pasted| {
            if let Some(pasted) = pasted {
                pasted.typed_sigma = (typed, fault);
            }
        });
        self.choose_reading(|choices, _| choices.sigma = rule);
    }

    /// Reads the list that waits anew, with an answer to what it leaves open or another choice than what was recognised.
    pub fn choose_reading(self, choose: impl FnOnce(&mut TableChoices, &[Option<Field>])) {
        let Some(mut pasted) = self.intake.pasted.get_untracked() else { return };
        let columns = pasted.columns();
        choose(&mut pasted.choices, &columns);
        match pasted.read() {
            Ok(()) => self.show_control(pasted),
            // The list stays as it was read before.
            Err(error) => {
                self.warn_error(error);
                self.intake.pasted.update(|_| ());
            }
        }
    }

    fn show_control(self, mut pasted: Pasted) {
        // Coordinates beside others are in their unit unless someone says otherwise; the first ones could be in any.
        let known = self.document.with_untracked(|d| control::has_lengths(&d.project).then(|| d.project.unit.clone()));
        let chosen = self.intake.pasted.with_untracked(|p| p.as_ref().and_then(|p| p.unit.clone()));
        // Values given by the list need no question.
        let own = pasted.table.unit.filter(|_| pasted.unit_of_the_list()).map(|unit| unit.symbol().to_owned());
        pasted.unit = own.or(chosen).or(known);
        // Standard errors in a unit of their own need that of the coordinates.
        let TableChoices { sigma, sigma_unit, unit, .. } = &pasted.choices;
        if (sigma.is_some() || sigma_unit.is_some())
            && unit.is_none()
            && pasted.table.unit.is_none()
            && pasted.unit.is_some()
        {
            pasted.choices.unit = pasted.unit.as_deref().and_then(Unit::named);
            if let Err(error) = pasted.read() {
                return self.warn_error(error);
            }
        }
        self.intake.pasted.set(Some(pasted));
    }

    /// Says in which unit the coordinates waiting to be taken are.
    pub fn set_pasted_unit(self, unit: &str) {
        let chosen = Some(unit.trim().to_owned()).filter(|unit| !unit.is_empty());
        let known = chosen.as_deref().and_then(Unit::named);
        self.intake.pasted.update(|pasted| {
            if let Some(pasted) = pasted {
                pasted.unit = chosen;
            }
        });
        self.choose_reading(|choices, _| choices.unit = known);
    }

    /// Takes the rows that were understood.
    pub fn take_control(self) {
        let Some(pasted) = self.intake.pasted.get_untracked() else { return };
        let Some(unit) = pasted.unit.clone() else {
            return self.warn_here(|| text::which_unit().to_owned());
        };
        if pasted.is_asked() || pasted.typed_sigma.1.is_some() {
            return;
        }
        remember(&pasted);
        let points = pasted.taken();
        if points.is_empty() {
            return;
        }
        let mut after = self.document.get_untracked();
        // The first given lengths bring their unit; what else has lengths goes with it.
        let first = !control::has_lengths(&after.project) && unit::holds_lengths(&after);
        let converted = match Unit::named(&unit).filter(|_| first) {
            Some(unit) => unit::convert(&mut after, unit),
            None => Ok(()),
        };
        let take = if pasted.is_approximate() { control::take_approximate } else { control::take_points };
        let count = match converted.and_then(|()| take(after.project_mut(), points, &unit)) {
            Ok(count) => count,
            Err(error) => return self.warn_error(error),
        };
        after.project_mut().axes = pasted.shown();
        if let Some(system) = pasted.table.local_system() {
            control::set_local_system(after.project_mut(), system, &pasted.source);
        }
        self.change(Change::ControlTaken(count), |document| *document = after);
        self.intake.pasted.set(None);
        self.go(Step::Control);
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

    /// Adds a measured distance, or reports the missing input.
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
            self.messages.asking.set(Some(Asking { text, choices: vec![(text::unit_is_right as Text, relabel)] }));
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
        self.messages.asking.set(Some(Asking { text, choices }));
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
