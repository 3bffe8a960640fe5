//! The experiments: selection, inputs, results, and opening as a project.

use std::collections::BTreeMap;
use std::sync::Arc;

use leptos::prelude::*;
use sightline::project::Project;
use sightline_lab::experiments::{Experiment, ExperimentOptions, NAMES};
use sightline_protocol::{ExportExperiment, RunExperiment};

use super::background::Stop;
use super::plates::Plates;
use super::pool::{Batch, TaskOutcome};
use super::{Desk, JobKind, Selection, Step};
use crate::browser::page;
use crate::document::Document;
use crate::i18n::background;

/// Result of an experiment, with its options.
#[derive(Clone, Debug)]
pub struct ExperimentRun {
    pub options: ExperimentOptions,
    pub experiment: Experiment,
    /// How long it took, seconds.
    pub seconds: f64,
}

/// The state of all experiments.
#[derive(Clone, Copy)]
pub struct Experiments {
    /// Name of the one that is shown.
    pub shown: RwSignal<&'static str>,
    options: RwSignal<BTreeMap<&'static str, ExperimentOptions>>,
    ran: RwSignal<BTreeMap<&'static str, Arc<ExperimentRun>>>,
    /// The last automatic run.
    by_itself: StoredValue<Option<Batch>>,
    pub plates: Plates,
}

impl Default for Experiments {
    fn default() -> Self {
        Self {
            shown: RwSignal::new(NAMES[0]),
            options: RwSignal::default(),
            ran: RwSignal::default(),
            by_itself: StoredValue::new(None),
            plates: Plates::default(),
        }
    }
}

impl Experiments {
    /// Varied inputs of an experiment.
    pub fn options(self, name: &str) -> ExperimentOptions {
        self.options.with(|all| all.get(name).cloned().unwrap_or_default())
    }

    /// Varies something; what came out before is out of date then.
    pub fn vary(self, name: &'static str, edit: impl FnOnce(&mut ExperimentOptions)) {
        self.options.update(|all| edit(all.entry(name).or_default()));
    }

    /// Result of the last run, even if inputs have changed since.
    pub fn ran(self, name: &str) -> Option<Arc<ExperimentRun>> {
        self.ran.with(|all| all.get(name).cloned())
    }

    /// Whether it has not run yet and nothing was varied.
    fn is_untouched(self, name: &str) -> bool {
        self.ran(name).is_none() && self.options(name) == ExperimentOptions::default()
    }

    /// Result of the last run, if its inputs are the present ones.
    pub fn current(self, name: &str) -> Option<Arc<ExperimentRun>> {
        self.ran(name).filter(|ran| ran.options == self.options(name))
    }
}

/// The name in the address after '#', where there is one.
pub fn from_hash(hash: &str) -> Option<&'static str> {
    let rest = hash.strip_prefix(Step::Experiments.name())?;
    let name = rest.trim_start_matches('/');
    NAMES.into_iter().find(|known| *known == name).or(name.is_empty().then_some(NAMES[0]))
}

impl Desk {
    /// Shows an experiment with its figures: what has never run is run as the paper has it, in place of another that is still running.
    pub fn show_experiment(self, name: &'static str) {
        let is_running =
            || self.tasks.job.with_untracked(|job| job.as_ref().is_some_and(|job| job.kind == JobKind::Experiment));
        if is_running() && self.experiments.shown.get_untracked() != name {
            self.cancel();
        }
        self.experiments.shown.set(name);
        self.step.set(Step::Experiments);
        page::set_hash(&format!("{}/{name}", Step::Experiments.name()));
        if self.tasks.job.with_untracked(Option::is_none) && untrack(|| self.experiments.is_untouched(name)) {
            let batch = self.start_experiment();
            self.experiments.by_itself.set_value(Some(batch));
        }
    }

    /// Stops an experiment that runs by itself: it must not keep a person's own work waiting. It runs again when its page is shown again.
    pub(super) fn stop_what_runs_by_itself(self) {
        let running = self.tasks.job.with_untracked(|job| job.as_ref().map(|job| job.batch));
        if running.is_some() && running == self.experiments.by_itself.get_value() {
            self.cancel();
        }
    }

    /// Runs the experiment that is shown, in a worker.
    pub fn run_experiment(self) {
        self.start_experiment();
    }

    fn start_experiment(self) -> Batch {
        let name = self.experiments.shown.get_untracked();
        let options = untrack(|| self.experiments.options(name));
        let began = page::now();
        let batch = self.start_job(JobKind::Experiment, 1, || {});
        let task = RunExperiment { name: name.to_owned(), options: options.clone() };
        let on_outcome = move |outcome: TaskOutcome<RunExperiment>| match outcome {
            TaskOutcome::Progress((done, of)) => self.count_job(batch, done, of),
            TaskOutcome::Done(experiment, _) => {
                self.end_job();
                let seconds = (page::now() - began) / 1000.0;
                let ran = ExperimentRun { options: options.clone(), experiment, seconds };
                self.experiments.ran.update(|all| {
                    all.insert(name, Arc::new(ran));
                });
            }
            TaskOutcome::Failed(failure) => {
                self.end_job();
                self.tell_failure(failure);
            }
        };
        self.tasks.pool.with_value(|pool| pool.submit(batch, task, Vec::new(), on_outcome));
        batch
    }

    /// Puts the experiment's project on the desk.
    pub fn open_experiment(self) {
        let name = self.experiments.shown.get_untracked();
        let Some(ran) = untrack(|| self.experiments.current(name)) else { return };
        self.over_unsaved(move || {
            self.put_project(ran.experiment.project.clone());
            self.go(Step::Adjust);
        });
    }

    /// Opens a project of the engine's making.
    pub(super) fn put_project(self, project: Project) {
        let first = project.photos.first().map(|photo| photo.id.clone());
        self.begin(Document { project: project.into(), ..Document::default() });
        self.is_pristine();
        self.processing.iterations.set(Vec::new());
        self.forget_waiting();
        // Reduced plates lie on a grid of their own, not on the pixels of a scan.
        self.photos.files.set(BTreeMap::new());
        self.selection.set(Selection { photo: first, ..Selection::default() });
    }

    /// Hands over the CSV files of the experiment: the one of a table, or all in an archive, since browsers hand over
    /// ten files at once and no more.
    pub fn export_experiment(self, only: Option<&str>) {
        let name = self.experiments.shown.get_untracked();
        let Some(ran) = untrack(|| self.experiments.current(name)) else { return };
        let only = only.map(|id| format!("{name}-{}.csv", id.replace('/', "-")));
        let (file, kind) = match &only {
            Some(wanted) => (wanted.clone(), "text/csv"),
            None => (format!("{name}.zip"), "application/zip"),
        };
        let task = ExportExperiment { experiment: ran.experiment.clone(), only };
        let on_outcome = move |outcome: TaskOutcome<ExportExperiment>| match outcome {
            TaskOutcome::Done((), bytes) => bytes.iter().for_each(|bytes| self.hand_over(&file, kind, bytes)),
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        self.ask(Stop(background::file, || ()), task, Vec::new(), on_outcome);
    }
}
