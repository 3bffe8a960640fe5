//! Lists of distances: read, shown with the questions about them, and imported.

use leptos::prelude::*;
use sightline::Error;
use sightline::error::Reason;
use sightline::project::Distance;
use sightline::units::Unit;
use sightline_exchange::control_csv::{Assumption, Basis, SigmaRule, TableChoices};
use sightline_exchange::lists::distances::{self, DistanceList};

use super::{Desk, Step, Until};
use crate::document::Change;
use crate::edit::control::has_lengths;
use crate::edit::scale_bars::{self, ImportedDistances};
use crate::format;
use crate::i18n::{lists as words, text};

/// A list of distances, to be confirmed by the user.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceFile {
    pub source: String,
    content: String,
    /// The step that it came to, where it is answered; elsewhere it waits.
    pub at: Step,
    pub choices: TableChoices,
    pub list: DistanceList,
    /// Unit of its lengths; none: it has to be asked for.
    pub unit: Option<Unit>,
    /// Whether the unit is that of the project, which the user has not confirmed.
    pub unit_assumed: bool,
    /// The standard error of all as typed, and why it is not taken.
    pub typed_sigma: (String, Option<Error>),
}

impl DistanceFile {
    /// Whether the heading has the unit.
    pub fn says_unit(&self) -> bool {
        let says = |a: &Assumption| matches!(a, Assumption::Unit { unit: Some(_), by: Basis::Heading });
        self.list.assumptions.iter().any(says)
    }

    /// Rows that were understood.
    pub fn good(&self) -> Vec<Distance> {
        self.list.rows.iter().flatten().cloned().collect()
    }

    /// Rows that were not.
    pub fn rejected(&self) -> Vec<Error> {
        self.list.rows.iter().filter_map(|row| row.as_ref().err().cloned()).collect()
    }

    /// Whether something has to be answered before it is imported.
    pub fn is_asked(&self) -> bool {
        self.unit.is_none()
            || self.typed_sigma.1.is_some()
            || self.list.assumptions.iter().any(|assumption| assumption.by() == Basis::Undecided)
    }

    /// How many lengths are rejected because they have no standard error.
    pub fn without_sigma(&self) -> usize {
        let lacks = |error: &Error| matches!(error, Error::Invalid { reason: Reason::Missing { name }, .. } if name == distances::SIGMA);
        self.list.rows.iter().filter(|row| row.as_ref().is_err_and(lacks)).count()
    }

    /// Reads it by its choices and the unit.
    fn read(&mut self) {
        let choices = TableChoices { unit: self.unit, ..self.choices.clone() };
        self.list = distances::read(&self.content, &choices);
        if self.says_unit() {
            (self.unit, self.unit_assumed) = (self.list.unit, false);
        }
    }
}

/// A distance that gave way and the one in its place: "A – B 1.000 → 1.002 m".
fn replacement(was: &Distance, is: &Distance, unit: &str) -> String {
    let decimals = format::decimals_for(was.sigma.min(is.sigma));
    let [before, after] = [was, is].map(|distance| format::fixed(distance.length, decimals));
    let check = if is.check { format!(" ({})", text::check_only()) } else { String::new() };
    format!("{} – {} {before} → {after} {unit}{check}", is.from, is.to)
}

impl Desk {
    /// Reads a list of distances, to be examined before it is imported; whether there are any.
    pub fn read_distances(self, source: String, content: String) -> bool {
        let known = self.document.with_untracked(|d| has_lengths(&d.project).then(|| d.project.unit.clone()));
        let mut file = DistanceFile {
            source,
            content,
            at: self.step.get_untracked(),
            choices: TableChoices::default(),
            list: DistanceList::default(),
            unit: known.as_deref().and_then(Unit::named),
            unit_assumed: known.is_some(),
            typed_sigma: (String::new(), None),
        };
        file.read();
        let any = !file.list.rows.is_empty();
        if any {
            self.intake.distances.set(Some(file));
        }
        any
    }

    /// Reads the list of distances that waits anew, with other choices.
    pub fn choose_distances(self, choose: impl FnOnce(&mut DistanceFile)) {
        self.intake.distances.update(|file| {
            if let Some(file) = file {
                choose(file);
                file.read();
            }
        });
    }

    /// Takes one standard error for all lengths without one of their own, as typed; nothing takes it away.
    pub fn set_distances_sigma(self, typed: &str) {
        let rule = Some(typed.trim()).filter(|typed| !typed.is_empty()).map(SigmaRule::read).transpose();
        self.choose_distances(|file| {
            let (rule, fault) = match rule {
                Ok(rule) => (rule, None),
                Err(error) => (None, Some(error)),
            };
            file.choices.sigma = rule;
            file.typed_sigma = (typed.to_owned(), fault);
        });
    }

    /// Effect of importing the list.
    pub fn distances_planned(self, file: &DistanceFile) -> Result<ImportedDistances, Error> {
        let mut project = self.document.with(|d| (*d.project).clone());
        scale_bars::take(&mut project, file.good(), file.unit)
    }

    /// Imports the rows that were understood, and reports what happened to the others.
    pub fn take_distances(self) {
        let Some(file) = self.intake.distances.get_untracked().filter(|file| !file.is_asked()) else { return };
        let mut after = self.document.get_untracked();
        let taken = match scale_bars::take(after.project_mut(), file.good(), file.unit) {
            Ok(taken) => taken,
            Err(error) => return self.warn_error(error.in_file(&file.source)),
        };
        self.intake.distances.set(None);
        if taken.taken > 0 {
            self.change(Change::DistancesTaken(taken.taken), |document| *document = after);
            self.go(Step::Control);
        }
        let (name, rejected) = (file.source.clone(), file.rejected().len());
        let strangers = taken.strangers.join(", ");
        let unit = self.document.with_untracked(|d| d.project.unit.clone());
        let replaced: Vec<String> = taken.replaced.iter().map(|(was, is)| replacement(was, is, &unit)).collect();
        self.say(rejected > 0 || !strangers.is_empty() || !replaced.is_empty(), Until::NextWork, move || {
            let mut told = vec![words::distances_taken(&name, taken.taken)];
            if !replaced.is_empty() {
                told.push(words::distances_replaced(replaced.len(), replaced.join("; ")));
            }
            if !strangers.is_empty() {
                told.push(words::distances_strangers(&strangers));
            }
            if rejected > 0 {
                told.push(words::distances_rejected(rejected));
            }
            told.join(" ")
        });
    }
}
