//! The plan of the photos: what is done with it, and what workers say of it.

use leptos::prelude::*;
use sightline::Error;
use sightline::plan::{Criterion, MakeOptions, Prediction, Suggested};
use sightline::project::{Plan, PlanStation};
use sightline_protocol::{BeginPlan, MakePlan, PlanOf, PredictPlan, SuggestPhoto};

use super::document::Change;
use super::pool::{Failure, Outcome};
use super::{Desk, JobKind};
use crate::edit::control::UNITS;
use crate::edit::plan;

/// What is known of the plan.
#[derive(Clone, Copy)]
pub struct Planning {
    /// The plan as it is while a station is dragged.
    pub live: RwSignal<Option<Plan>>,
    /// Of the plan, and of the others beside it.
    pub predicted: RwSignal<Option<Result<Vec<Prediction>, Error>>>,
    /// The station that is chosen.
    pub chosen: RwSignal<Option<String>>,
    pub criterion: RwSignal<Criterion>,
    /// Places for the next photo, of the plan as it is.
    pub suggested: RwSignal<Vec<Suggested>>,
    /// A prediction is under way, and what is to be predicted next.
    busy: StoredValue<bool>,
    next: StoredValue<Option<Plan>>,
}

impl Default for Planning {
    fn default() -> Self {
        Self {
            live: RwSignal::new(None),
            predicted: RwSignal::new(None),
            chosen: RwSignal::new(None),
            criterion: RwSignal::new(Criterion::Worst),
            suggested: RwSignal::new(Vec::new()),
            busy: StoredValue::new(false),
            next: StoredValue::new(None),
        }
    }
}

impl Desk {
    /// The document's plan.
    pub fn plan(self) -> Option<Plan> {
        self.document.with(|d| d.project.plan.as_deref().cloned())
    }

    /// The plan as it is shown: with the station that is being dragged.
    pub fn shown_plan(self) -> Option<Plan> {
        self.planning.live.get().or_else(|| self.plan())
    }

    /// Millimetres in the project's unit.
    pub fn unit_mm(self) -> f64 {
        let unit = self.document.with_untracked(|d| d.project.unit.clone());
        UNITS.iter().find(|(name, _)| *name == unit).map_or(1.0, |(_, mm)| *mm)
    }

    /// Begins a plan of a form.
    pub fn begin_plan(self, kind: &str) {
        let mm = self.unit_mm();
        let form = plan::first_form(kind, mm);
        self.change(Change::PlanEdited, |document| plan::begin(document.project_mut(), form, mm));
    }

    /// Begins a plan from one of the papers' networks, or from the project as it was measured.
    pub fn begin_plan_from(self, of: PlanOf) {
        // A paper's network brings its own unit; one that has lengths already keeps its own.
        let unit = match of {
            PlanOf::Example(ref name) => Some(if name == "kim" { "m" } else { "mm" }),
            PlanOf::Project(_) => None,
        };
        let on_outcome = move |outcome: Outcome<BeginPlan>| match outcome {
            Outcome::Done(made, _) => self.change(Change::PlanEdited, |document| {
                let fresh = document.is_empty();
                let project = document.project_mut();
                let mut made = made;
                if let (Some(unit), true) = (unit, fresh) {
                    project.unit = unit.to_owned();
                }
                made.lens.unit_mm = UNITS.iter().find(|(name, _)| *name == project.unit).map_or(1.0, |(_, mm)| *mm);
                project.plan = Some(Box::new(made));
            }),
            Outcome::Failed(failure) => self.tell_failure(failure),
            Outcome::Progress(nothing) => match nothing {},
        };
        self.pool.with_value(|pool| pool.submit_first(BeginPlan { of }, Vec::new(), on_outcome));
    }

    /// Changes the plan so that it can be undone.
    pub fn edit_plan(self, change: Change, edit: impl FnOnce(&mut Plan)) {
        if self.document.with_untracked(|d| d.project.plan.is_none()) {
            return;
        }
        self.planning.live.set(None);
        self.planning.suggested.set(Vec::new());
        self.change(change, |document| {
            if let Some(plan) = document.project_mut().plan.as_mut() {
                edit(plan);
            }
        });
    }

    /// Takes the plan away; it can be got back.
    pub fn remove_plan(self) {
        self.planning.live.set(None);
        self.change(Change::PlanEdited, |document| document.project_mut().plan = None);
    }

    /// Has a plan predicted; while one is under way the last that was asked for waits.
    pub fn predict_plan(self, plan: Plan) {
        if self.planning.busy.get_value() {
            return self.planning.next.set_value(Some(plan));
        }
        self.planning.busy.set_value(true);
        let on_outcome = move |outcome: Outcome<PredictPlan>| {
            match outcome {
                Outcome::Done(predictions, _) => self.planning.predicted.set(Some(Ok(predictions))),
                Outcome::Failed(Failure::Refused(error)) => self.planning.predicted.set(Some(Err(error))),
                Outcome::Failed(failure) => self.tell_failure(failure),
                Outcome::Progress(nothing) => match nothing {},
            }
            self.planning.busy.set_value(false);
            if let Some(plan) = self.planning.next.try_update_value(Option::take).flatten() {
                self.predict_plan(plan);
            }
        };
        self.pool.with_value(|pool| pool.submit_first(PredictPlan { plan }, Vec::new(), on_outcome));
    }

    /// Looks for the next photo.
    pub fn suggest_photo(self) {
        let Some(plan) = untrack(|| self.plan()) else { return };
        let criterion = self.planning.criterion.get_untracked();
        let batch = self.start_job(JobKind::Planning, 1, || {});
        let asked = plan.clone();
        let on_outcome = move |outcome: Outcome<SuggestPhoto>| match outcome {
            Outcome::Progress((done, of)) => self.count_job(batch, done, of),
            Outcome::Done(found, _) => {
                self.end_job();
                // Of another plan they would mean nothing.
                if untrack(|| self.plan()).as_ref() == Some(&asked) {
                    self.planning.suggested.set(found);
                }
            }
            Outcome::Failed(failure) => {
                self.end_job();
                self.tell_failure(failure);
            }
        };
        self.pool.with_value(|pool| pool.submit(batch, SuggestPhoto { plan, criterion }, Vec::new(), on_outcome));
    }

    /// Takes a suggested photo into the plan.
    pub fn take_suggested(self, station: PlanStation) {
        let id = station.id.clone();
        self.edit_plan(Change::StationAdded(id.clone()), |plan| plan.stations.push(station));
        self.planning.chosen.set(Some(id));
    }

    /// Makes a plan that reaches what is wanted; photos that are taken stay.
    pub fn make_plan(self) {
        let Some(plan) = untrack(|| self.plan()) else { return };
        let batch = self.start_job(JobKind::Planning, 1, || {});
        let on_outcome = move |outcome: Outcome<MakePlan>| match outcome {
            Outcome::Progress((done, of)) => self.count_job(batch, done, of),
            Outcome::Done(made, _) => {
                self.end_job();
                self.planning.chosen.set(None);
                let count = made.stations.len();
                self.edit_plan(Change::PlanMade(count), |plan| plan.stations = made.stations);
            }
            Outcome::Failed(failure) => {
                self.end_job();
                self.tell_failure(failure);
            }
        };
        let task = MakePlan { plan, options: MakeOptions::default() };
        self.pool.with_value(|pool| pool.submit(batch, task, Vec::new(), on_outcome));
    }
}
