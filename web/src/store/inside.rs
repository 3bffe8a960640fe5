//! State of the page "Inside the adjustment": network, step, and requested computations.

use std::collections::HashMap;
use std::mem::{Discriminant, discriminant};
use std::sync::Arc;

use leptos::prelude::*;
use sightline::adjustment::AdjustOptions;
use sightline::project::Project;
use sightline::teaching::{Bias, Datums, Explained, Planted, Show, Weighted};
use sightline_protocol::{ExportInside, Found, Inquire, Inquiry, InsideOf, LookInside, Looked, matrices_from};

use super::document::Document;
use super::experiments::Ran;
use super::lasting::Stop;
use super::pool::Outcome;
use super::{Desk, Step};
use crate::browser::worker::Bytes;
use crate::i18n::inside as words;

/// What is laid open.
#[derive(Clone, Debug, Default)]
pub enum Network {
    /// That of the lessons.
    #[default]
    Lab,
    /// The open project.
    Document,
    /// What an experiment gave.
    Experiment(Arc<Ran>),
    /// That of a lesson's file.
    Lesson(Arc<Project>),
}

/// What of it is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tab {
    #[default]
    Matrices,
    Datum,
    Errors,
    Weights,
}

/// The state of the view.
#[derive(Clone, Copy)]
pub struct Inside {
    pub network: RwSignal<Network>,
    /// The open project as it was when it was laid open, where it was.
    taken: RwSignal<Option<(Arc<Project>, AdjustOptions)>>,
    pub tab: RwSignal<Tab>,
    /// Share of the object's size by which start values are moved.
    pub moved: RwSignal<f64>,
    /// What each step gave, from the start values on.
    pub steps: RwSignal<Vec<Arc<Looked>>>,
    /// The step that is shown.
    pub step: RwSignal<usize>,
    /// Chosen row and column of A.
    pub row: RwSignal<Option<usize>>,
    pub column: RwSignal<Option<usize>>,
    pub explained: RwSignal<Option<(usize, Explained)>>,
    pub datums: RwSignal<Option<Datums>>,
    pub planted: RwSignal<Option<Planted>>,
    pub weighted: RwSignal<Option<Weighted>>,
    pub biases: RwSignal<Vec<Bias>>,
    /// Steps are taken up to this one.
    until: RwSignal<usize>,
    /// What the step of a lesson wants shown; the parts of the view follow it when it changes.
    pub wanted: RwSignal<Show>,
    pub waiting: RwSignal<bool>,
    /// Counts networks: an answer of an earlier one is not taken.
    serial: RwSignal<usize>,
    /// Counts questions by kind: workers may answer an earlier one later.
    asked: RwSignal<HashMap<Discriminant<Inquiry>, usize>>,
}

impl Default for Inside {
    fn default() -> Self {
        Self {
            network: RwSignal::default(),
            taken: RwSignal::default(),
            tab: RwSignal::default(),
            moved: RwSignal::new(LAB_MOVED),
            steps: RwSignal::default(),
            step: RwSignal::default(),
            row: RwSignal::default(),
            column: RwSignal::default(),
            explained: RwSignal::default(),
            datums: RwSignal::default(),
            planted: RwSignal::default(),
            weighted: RwSignal::default(),
            biases: RwSignal::default(),
            until: RwSignal::default(),
            wanted: RwSignal::default(),
            waiting: RwSignal::default(),
            serial: RwSignal::default(),
            asked: RwSignal::default(),
        }
    }
}

/// One percent: the iteration needs a few steps and still converges.
const LAB_MOVED: f64 = 0.01;

impl Inside {
    /// What the step that is shown gave.
    pub fn looked(self) -> Option<Arc<Looked>> {
        let step = self.step.get();
        self.steps.with(|steps| steps.get(step).cloned())
    }
}

impl Desk {
    /// Lays a network open and shows it.
    pub fn open_inside(self, network: Network) {
        let inside = self.inside;
        inside.moved.set(if matches!(network, Network::Lab) { LAB_MOVED } else { 0.0 });
        inside.network.set(network);
        self.go(Step::Inside);
        self.begin_inside();
    }

    /// Lays the open project open where there is one, else the network of the lessons; what is laid open already stays.
    pub fn ready_inside(self) {
        let empty = self.document.with_untracked(Document::is_empty);
        let inside = self.inside;
        let of_document = inside.network.with_untracked(|network| matches!(network, Network::Document));
        let none = inside.steps.with_untracked(Vec::is_empty);
        if empty && of_document {
            self.open_inside(Network::Lab);
        } else if none && !empty && inside.network.with_untracked(|network| matches!(network, Network::Lab)) {
            self.open_inside(Network::Document);
        } else {
            // What was edited since is laid open anew.
            let same = inside.taken.with_untracked(|taken| {
                taken.as_ref().is_some_and(|(project, options)| {
                    self.document.with_untracked(|d| Arc::ptr_eq(project, &d.project) && *options == d.options)
                })
            });
            if none || of_document && !same {
                self.begin_inside();
            }
        }
    }

    /// Begins again at the start values.
    pub fn begin_inside(self) {
        let inside = self.inside;
        inside.serial.update(|serial| *serial += 1);
        inside.taken.set(Some(self.document.with_untracked(|d| (d.project.clone(), d.options.clone()))));
        inside.until.set(0);
        inside.steps.set(Vec::new());
        inside.step.set(0);
        inside.row.set(None);
        inside.column.set(None);
        inside.explained.set(None);
        inside.datums.set(None);
        inside.planted.set(None);
        inside.weighted.set(None);
        inside.biases.set(Vec::new());
        self.look_inside(0);
        self.value_lesson();
    }

    fn of_inside(self) -> InsideOf {
        let (project, options) = self.inside.network.with_untracked(|network| match network {
            Network::Lab => (None, AdjustOptions::default()),
            Network::Document => self.inside.taken.with_untracked(|taken| match taken {
                Some((project, options)) => (Some((**project).clone()), options.clone()),
                None => (None, AdjustOptions::default()),
            }),
            Network::Experiment(ran) => (Some(ran.experiment.project.clone()), AdjustOptions::default()),
            Network::Lesson(project) => (Some((**project).clone()), AdjustOptions::default()),
        });
        // These follow after the iteration and are no part of it; the laboratory of errors has them side by side.
        let options = AdjustOptions { robust: None, snooping: false, variance_components: None, ..options };
        InsideOf { project, options, moved: self.inside.moved.get_untracked() }
    }

    /// Shows a step, which is taken where it was not yet.
    pub fn look_inside(self, step: usize) {
        let inside = self.inside;
        let serial = inside.serial.get_untracked();
        if step < inside.steps.with_untracked(Vec::len) {
            inside.step.set(step);
            return self.explain_row();
        }
        inside.waiting.set(true);
        let on_outcome = move |outcome: Outcome<LookInside>| match outcome {
            Outcome::Done(mut looked, bytes) => {
                if serial != inside.serial.get_untracked() {
                    return;
                }
                inside.waiting.set(false);
                let bytes: Vec<Vec<u8>> = bytes.iter().map(Bytes::to_vec).collect();
                if !matrices_from(&mut looked, &bytes) {
                    return;
                }
                let ended = looked.state.termination.is_some();
                let at = inside.steps.try_update(|steps| {
                    // Nothing changes after the last step.
                    if steps.last().is_none_or(|last| last.state.step < looked.state.step) {
                        steps.push(Arc::new(looked));
                    }
                    steps.len() - 1
                });
                inside.step.set(at.unwrap_or_default());
                self.explain_row();
                if step < inside.until.get_untracked() && !ended {
                    self.look_inside(step + 1);
                }
            }
            Outcome::Failed(failure) => {
                inside.waiting.set(false);
                inside.until.set(0);
                self.tell_failure(failure);
            }
            Outcome::Progress(nothing) => match nothing {},
        };
        let stopped = move || {
            inside.waiting.set(false);
            inside.until.set(0);
        };
        let task = LookInside { of: self.of_inside(), step };
        self.ask(Stop(words::computing, stopped), task, Vec::new(), on_outcome);
    }

    /// Takes steps up to this one, or until the end.
    pub fn run_inside_to(self, step: usize) {
        self.inside.until.set(step);
        let known = self.inside.steps.with_untracked(Vec::len);
        // The start values are on their way where nothing is known yet.
        if known > 0 {
            self.look_inside(step.min(known));
        }
    }

    /// Chooses an observation.
    pub fn choose_equation(self, row: Option<usize>) {
        self.inside.row.set(row);
        self.explain_row();
    }

    fn explain_row(self) {
        let inside = self.inside;
        if let Some(row) = inside.row.get_untracked() {
            self.inquire(Inquiry::Row { step: inside.step.get_untracked(), row });
        }
    }

    /// Asks something of the network.
    pub fn inquire(self, inquiry: Inquiry) {
        let inside = self.inside;
        let serial = inside.serial.get_untracked();
        let step = inside.step.get_untracked();
        let kind = discriminant(&inquiry);
        let number = inside.asked.try_update(|asked| {
            let number = asked.entry(kind).or_default();
            *number += 1;
            *number
        });
        let latest = move || inside.asked.with_untracked(|asked| asked.get(&kind).copied()) == number;
        let texts = if let Inquiry::Evaluate(texts) = &inquiry { texts.clone() } else { Vec::new() };
        let on_outcome = move |outcome: Outcome<Inquire>| match outcome {
            // Of no network.
            Outcome::Done(Found::Lessons(all), _) => self.lessons_came(all),
            Outcome::Done(Found::ReadLesson(read), _) => self.lesson_read(*read),
            Outcome::Done(found, _) if serial == inside.serial.get_untracked() && latest() => match found {
                // Another may have been chosen meanwhile.
                Found::Row(explained) if inside.row.get_untracked() == Some(explained.row) => {
                    inside.explained.set(Some((step, explained)));
                }
                Found::Row(_) => {}
                Found::Datums(found) => inside.datums.set(Some(found)),
                Found::Plant(found) => inside.planted.set(Some(found)),
                Found::Weigh(found) => inside.weighted.set(Some(found)),
                Found::Biases(found) => inside.biases.set(found),
                Found::Evaluate(found) => self.lesson_valued(texts.clone(), found),
                Found::Lessons(_) | Found::ReadLesson(_) => {}
            },
            Outcome::Done(..) => {}
            Outcome::Failed(failure) => self.tell_failure(failure),
            Outcome::Progress(nothing) => match nothing {},
        };
        let task = Inquire { of: self.of_inside(), inquiry };
        self.ask(Stop(words::computing, || ()), task, Vec::new(), on_outcome);
    }

    /// Hands over the matrices at the start values.
    pub fn export_inside(self) {
        let on_outcome = move |outcome: Outcome<ExportInside>| match outcome {
            Outcome::Done((), bytes) => {
                bytes.iter().for_each(|bytes| self.hand_over("equations.zip", "application/zip", bytes));
            }
            Outcome::Failed(failure) => self.tell_failure(failure),
            Outcome::Progress(nothing) => match nothing {},
        };
        let task = ExportInside { of: self.of_inside() };
        self.ask(Stop(words::computing, || ()), task, Vec::new(), on_outcome);
    }
}
