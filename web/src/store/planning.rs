//! The plan: actions, and predictions by workers.

use std::sync::Arc;

use leptos::prelude::*;
use sightline::Error;
use sightline::project::{Plan, PlanStation, Project};
use sightline::units;
use sightline_exchange::control_csv::{self, ControlTable, TableChoices};
use sightline_plan::{Criterion, Ended, MakeOptions, Prediction, Suggested};
use sightline_protocol::{BeginPlan, MakePlan, Open, PlanOf, PredictPlan, SuggestPhoto};

use super::background::Stop;
use super::intake::SMALL_SIDE;
use super::pool::{Failure, TaskOutcome};
use super::{Desk, JobKind};
use crate::browser::file::NamedFile;
use crate::document::Change;
use crate::edit::cameras::{self, Signature};
use crate::edit::control::has_lengths;
use crate::edit::plan;
use crate::i18n::planning as words;
use crate::i18n::{background, text};

/// State of the plan.
#[derive(Clone, Copy)]
pub struct Planning {
    /// The plan as it is while a station is dragged.
    pub live: RwSignal<Option<Arc<Plan>>>,
    /// Of the plan, and of the others beside it.
    pub predicted: RwSignal<Option<Result<Vec<Arc<Prediction>>, Error>>>,
    /// The station that is chosen.
    pub chosen: RwSignal<Option<String>>,
    pub criterion: RwSignal<Criterion>,
    /// The unit that a plan begins with where nothing has lengths yet.
    pub unit: RwSignal<String>,
    /// Places for the next photo, of the plan as it is.
    pub suggested: RwSignal<Vec<Suggested>>,
    /// Whether dragging in a view draws a region without access.
    pub fencing: RwSignal<bool>,
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
            unit: RwSignal::new("mm".to_owned()),
            suggested: RwSignal::new(Vec::new()),
            fencing: RwSignal::new(false),
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

    /// Reads the plan as it is shown: with the station that is being dragged.
    pub fn with_plan<T>(self, read: impl FnOnce(&Plan) -> T) -> Option<T> {
        match self.planning.live.get() {
            Some(live) => Some(read(&live)),
            None => self.document.with(|d| d.project.plan.as_deref().map(read)),
        }
    }

    /// The plan as it is shown.
    pub fn shown_plan(self) -> Option<Plan> {
        self.with_plan(Plan::clone)
    }

    /// The unit of a plan that is begun: a plan with lengths keeps its unit. `None`, with a message, for an unknown unit.
    fn unit_to_begin(self) -> Option<(String, f64)> {
        let own = self
            .document
            .with_untracked(|d| (has_lengths(&d.project) || d.project.plan.is_some()).then(|| d.project.unit.clone()));
        let unit = own.unwrap_or_else(|| self.planning.unit.get_untracked());
        let Some(mm) = plan::millimetres(&unit) else {
            self.warn_here(move || text::unit_unknown(&unit));
            return None;
        };
        Some((unit, mm))
    }

    /// Begins a plan of a form.
    pub fn begin_plan(self, kind: &str) {
        let Some((unit, mm)) = self.unit_to_begin() else { return };
        let form = plan::first_form(kind, mm);
        self.change(Change::PlanEdited, |document| {
            let project = document.project_mut();
            project.unit = unit;
            plan::begin(project, form, mm);
        });
    }

    /// Takes a list of points into the plan, or begins one of them. If a row is invalid, it is reported and nothing is imported.
    pub fn take_plan_points(self, content: &str) {
        let Some((unit, mm)) = self.unit_to_begin() else { return };
        let project_axes = self.document.with_untracked(|d| d.project.axes);
        let table = control_csv::parse_with(content, TableChoices { project_axes, ..TableChoices::default() });
        // A heading's unit is converted to the plan's; without one the coordinates are in the plan's.
        let factor = table.unit.map_or(Ok(1.0), |own| units::factor(own.symbol(), &unit));
        let read = table.in_given_system().and_then(ControlTable::into_points).and_then(|points| {
            Project { points: points.into(), ..Project::default() }.scaled(factor?).map(|project| project.points)
        });
        let points = match read {
            Ok(points) => points,
            Err(error) => return self.warn_error(error),
        };
        self.planning.live.set(None);
        self.planning.suggested.set(Vec::new());
        self.change(Change::PlanEdited, |document| {
            let project = document.project_mut();
            project.unit = unit;
            plan::take_points(project, points.into(), mm);
        });
    }

    /// Plans with a camera of the project.
    pub fn plan_with_camera(self, id: &str) {
        let found = self.document.with_untracked(|d| d.project.cameras.iter().find(|c| c.id == id).cloned());
        if let Some(camera) = found {
            self.edit_plan(Change::PlanEdited, |plan| plan::set_camera(plan, camera));
        }
    }

    /// Plans with the camera that a photo was taken with, if its file contains the data.
    pub fn plan_with_photo(self, photo: NamedFile) {
        let NamedFile { name, content } = photo;
        let on_outcome = move |outcome: TaskOutcome<Open>| match outcome {
            TaskOutcome::Done(opened, _) => {
                let signature = Signature::of(&name, &opened.info, opened.size);
                let camera = cameras::camera(&signature, &opened.info, &Project::default());
                if plan::is_known(&camera) {
                    self.edit_plan(Change::PlanEdited, |plan| plan::set_camera(plan, camera));
                } else {
                    let name = name.clone();
                    self.warn_here(move || words::no_focal_length(&name));
                }
            }
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        let stop = Stop(background::photo, || ());
        self.ask(stop, Open { max_side: SMALL_SIDE }, vec![content], on_outcome);
    }

    /// Begins a plan from one of the papers' networks, or from the project as it was measured.
    pub fn begin_plan_from(self, of: PlanOf) {
        // A paper's network brings its own unit; one that has lengths already keeps its own.
        let unit = match of {
            PlanOf::Example(ref name) => Some(if name == "kim" { "m" } else { "mm" }),
            PlanOf::Project(_) => None,
        };
        let on_outcome = move |outcome: TaskOutcome<BeginPlan>| match outcome {
            TaskOutcome::Done(made, _) => self.change(Change::PlanEdited, |document| plan::put(document, made, unit)),
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        self.ask(Stop(background::plan, || ()), BeginPlan { of }, Vec::new(), on_outcome);
    }

    /// Changes the plan so that it can be undone.
    pub fn edit_plan(self, change: Change, edit: impl FnOnce(&mut Plan)) {
        let mut after = self.document.get_untracked();
        if plan::change(after.project_mut(), edit) {
            self.planning.live.set(None);
            self.planning.suggested.set(Vec::new());
            self.change(change, |document| *document = after);
        }
    }

    /// Takes the plan away; it can be got back.
    pub fn remove_plan(self) {
        let mut after = self.document.get_untracked();
        if plan::remove(after.project_mut()) {
            self.planning.live.set(None);
            self.change(Change::PlanEdited, |document| *document = after);
        }
    }

    /// Has a plan predicted; while one is under way the last that was asked for waits.
    pub fn predict_plan(self, plan: Plan) {
        if self.planning.busy.get_value() {
            return self.planning.next.set_value(Some(plan));
        }
        self.planning.busy.set_value(true);
        let on_outcome = move |outcome: TaskOutcome<PredictPlan>| {
            match outcome {
                TaskOutcome::Done(predictions, _) => {
                    self.planning.predicted.set(Some(Ok(predictions.into_iter().map(Arc::new).collect())))
                }
                TaskOutcome::Failed(Failure::Refused(error)) => self.planning.predicted.set(Some(Err(error))),
                TaskOutcome::Failed(failure) => self.tell_failure(failure),
                TaskOutcome::Progress(nothing) => match nothing {},
            }
            self.planning.busy.set_value(false);
            if let Some(plan) = self.planning.next.try_update_value(Option::take).flatten() {
                self.predict_plan(plan);
            }
        };
        let stopped = move || {
            self.planning.next.set_value(None);
            self.planning.busy.set_value(false);
        };
        self.ask(Stop(background::plan, stopped), PredictPlan { plan }, Vec::new(), on_outcome);
    }

    /// Looks for the next photo.
    pub fn suggest_photo(self) {
        let Some(plan) = untrack(|| self.plan()) else { return };
        let criterion = self.planning.criterion.get_untracked();
        let batch = self.start_job(JobKind::Planning, 1, || {});
        let asked = plan.clone();
        let on_outcome = move |outcome: TaskOutcome<SuggestPhoto>| match outcome {
            TaskOutcome::Progress((done, of)) => self.count_job(batch, done, of),
            TaskOutcome::Done(found, _) => {
                self.end_job();
                // Of another plan they would mean nothing.
                if untrack(|| self.plan()).as_ref() == Some(&asked) {
                    self.planning.suggested.set(found);
                }
            }
            TaskOutcome::Failed(failure) => {
                self.end_job();
                self.tell_failure(failure);
            }
        };
        self.tasks.pool.with_value(|pool| pool.submit(batch, SuggestPhoto { plan, criterion }, Vec::new(), on_outcome));
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
        let on_outcome = move |outcome: TaskOutcome<MakePlan>| match outcome {
            TaskOutcome::Progress((done, of)) => self.count_job(batch, done, of),
            TaskOutcome::Done(made, _) => {
                self.end_job();
                self.planning.chosen.set(None);
                let (count, ended) = (made.stations.len(), made.ended);
                self.edit_plan(Change::PlanMade(count), |plan| plan.stations = made.stations);
                if ended != Ended::Reached {
                    self.warn(move || match ended {
                        Ended::Reached => String::new(),
                        Ended::MostPhotos { most } => words::ended_most(most),
                        Ended::NoGain { tried } => words::ended_no_gain(tried),
                        Ended::NoPlace => words::ended_no_place().to_owned(),
                        Ended::Time => words::ended_time().to_owned(),
                    });
                }
            }
            TaskOutcome::Failed(failure) => {
                self.end_job();
                self.tell_failure(failure);
            }
        };
        let task = MakePlan { plan, options: MakeOptions::default() };
        self.tasks.pool.with_value(|pool| pool.submit(batch, task, Vec::new(), on_outcome));
    }
}
