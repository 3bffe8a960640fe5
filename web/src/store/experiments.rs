//! The experiments: selection, inputs, results, and opening as a project.

use std::collections::BTreeMap;
use std::sync::Arc;

use leptos::prelude::*;
use sightline::experiments::{Experiment, ExperimentOptions, NAMES};
use sightline::project::Project;
use sightline_protocol::{ExportExperiment, RunExperiment};

use super::document::Document;
use super::lasting::Stop;
use super::plates::Plates;
use super::pool::Outcome;
use super::{Desk, JobKind, Selection, Step};
use crate::browser::page;
use crate::i18n::lasting;

/// What an experiment gave, with what it was run on.
#[derive(Clone, Debug)]
pub struct Ran {
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
    ran: RwSignal<BTreeMap<&'static str, Arc<Ran>>>,
    pub plates: Plates,
}

impl Default for Experiments {
    fn default() -> Self {
        Self {
            shown: RwSignal::new(NAMES[0]),
            options: RwSignal::default(),
            ran: RwSignal::default(),
            plates: Plates::default(),
        }
    }
}

impl Experiments {
    /// What is varied of an experiment.
    pub fn options(self, name: &str) -> ExperimentOptions {
        self.options.with(|all| all.get(name).cloned().unwrap_or_default())
    }

    /// Varies something; what came out before is out of date then.
    pub fn vary(self, name: &'static str, edit: impl FnOnce(&mut ExperimentOptions)) {
        self.options.update(|all| edit(all.entry(name).or_default()));
    }

    /// What the last run gave, whether or not something was varied since.
    pub fn ran(self, name: &str) -> Option<Arc<Ran>> {
        self.ran.with(|all| all.get(name).cloned())
    }

    /// Whether it has not run yet and nothing was varied.
    fn is_untouched(self, name: &str) -> bool {
        self.ran(name).is_none() && self.options(name) == ExperimentOptions::default()
    }

    /// What the last run gave, where it was run on what is chosen now.
    pub fn current(self, name: &str) -> Option<Arc<Ran>> {
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
            || self.job.with_untracked(|job| job.as_ref().is_some_and(|job| job.kind == JobKind::Experiment));
        if is_running() && self.experiments.shown.get_untracked() != name {
            self.cancel();
        }
        self.experiments.shown.set(name);
        self.step.set(Step::Experiments);
        page::set_hash(&format!("{}/{name}", Step::Experiments.name()));
        if self.job.with_untracked(Option::is_none) && untrack(|| self.experiments.is_untouched(name)) {
            self.run_experiment();
        }
    }

    /// Runs the experiment that is shown, in a worker.
    pub fn run_experiment(self) {
        let name = self.experiments.shown.get_untracked();
        let options = untrack(|| self.experiments.options(name));
        let began = page::now();
        let batch = self.start_job(JobKind::Experiment, 1, || {});
        let task = RunExperiment { name: name.to_owned(), options: options.clone() };
        let on_outcome = move |outcome: Outcome<RunExperiment>| match outcome {
            Outcome::Progress((done, of)) => self.count_job(batch, done, of),
            Outcome::Done(experiment, _) => {
                self.end_job();
                let seconds = (page::now() - began) / 1000.0;
                let ran = Ran { options: options.clone(), experiment, seconds };
                self.experiments.ran.update(|all| {
                    all.insert(name, Arc::new(ran));
                });
            }
            Outcome::Failed(failure) => {
                self.end_job();
                self.tell_failure(failure);
            }
        };
        self.pool.with_value(|pool| pool.submit(batch, task, Vec::new(), on_outcome));
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
        self.iterations.set(Vec::new());
        self.forget_waiting();
        // Reduced plates lie on a grid of their own, not on the pixels of a scan.
        self.files.set(BTreeMap::new());
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
        let on_outcome = move |outcome: Outcome<ExportExperiment>| match outcome {
            Outcome::Done((), bytes) => bytes.iter().for_each(|bytes| self.hand_over(&file, kind, bytes)),
            Outcome::Failed(failure) => self.tell_failure(failure),
            Outcome::Progress(nothing) => match nothing {},
        };
        self.ask(Stop(lasting::file, || ()), task, Vec::new(), on_outcome);
    }
}
