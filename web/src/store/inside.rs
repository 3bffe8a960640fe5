//! State of the page "Inside the adjustment": network, step, and requested computations.

use std::collections::{HashMap, VecDeque};
use std::mem::{Discriminant, discriminant};
use std::ops::Deref;
use std::sync::Arc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::adjust::{Block, Elimination, Equation, Factor, Unknown};
use sightline::adjustment::AdjustOptions;
use sightline::project::Project;
use sightline_lab::teaching::{Bias, Datums, Explained, Planted, Show, Transformed, Weighted};
use sightline_protocol::{
    ExportInside, Found, Inquire, Inquiry, InsideOf, LookInside, Looked, factor_from, matrices_from,
};

use super::background::Stop;
use super::experiments::ExperimentRun;
use super::pool::TaskOutcome;
use super::{Desk, Step};
use crate::browser::page;
use crate::browser::worker::Bytes;
use crate::document::Document;
use crate::i18n::inside as words;

/// The matrices and steps shown.
#[derive(Clone, Debug, Default)]
pub enum Network {
    /// That of the lessons.
    #[default]
    Lab,
    /// The open project.
    Document,
    /// Result of an experiment.
    Experiment(Arc<ExperimentRun>),
    /// That of a lesson's file.
    Lesson(Arc<Project>),
}

/// Its visible parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tab {
    #[default]
    Matrices,
    Datum,
    Errors,
    Weights,
}

/// A step, and the standard errors of the unknowns after it; none: there are too many unknowns.
type SigmasOfStep = (usize, Option<Arc<Vec<f64>>>);
/// A step, the order of elimination, and the Cholesky factor of N after it; none: N is singular beyond its datum defect.
type FactorOfStep = (usize, Elimination, Option<Arc<Factor>>);

/// The state of the view.
#[derive(Clone, Copy)]
pub struct Inside {
    pub network: RwSignal<Network>,
    /// The open project as it was when it was laid open, where it was.
    taken: RwSignal<Option<(Arc<Project>, AdjustOptions)>>,
    pub tab: RwSignal<Tab>,
    /// Share of the object's size by which start values are moved.
    pub moved: RwSignal<f64>,
    /// Result of each step, from the start values on.
    pub steps: RwSignal<Vec<Arc<Looked>>>,
    /// The step that is shown.
    pub step: RwSignal<usize>,
    /// Chosen row and column of A.
    pub row: RwSignal<Option<usize>>,
    pub column: RwSignal<Option<usize>>,
    pub explained: RwSignal<Option<(usize, Explained)>>,
    /// Standard errors of the unknowns.
    pub sigmas: RwSignal<Option<SigmasOfStep>>,
    /// The Cholesky factor of N.
    pub factor: RwSignal<Option<FactorOfStep>>,
    pub elimination: RwSignal<Elimination>,
    pub datums: RwSignal<Option<Datums>>,
    /// The S-transformation; `None` in it: there is none between these datums.
    pub transformed: RwSignal<Option<Option<Transformed>>>,
    pub planted: RwSignal<Option<Planted>>,
    pub weighted: RwSignal<Option<Weighted>>,
    pub biases: RwSignal<Vec<Bias>>,
    /// Steps are taken up to this one.
    until: RwSignal<usize>,
    /// The view that the step of a lesson requests; the parts of the page follow it when it changes.
    pub wanted: RwSignal<Show>,
    pub waiting: RwSignal<bool>,
    /// Counts networks: an answer of an earlier one is not taken.
    serial: RwSignal<usize>,
    /// Questions of a step that wait for each other; `None` while none is asked. The worker that has the steps answers them: two at once
    /// would have another one started, which takes all steps anew, and of two workers the one without steps would stay.
    turns: StoredValue<Option<VecDeque<Turn>>, LocalStorage>,
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
            sigmas: RwSignal::default(),
            factor: RwSignal::default(),
            elimination: RwSignal::default(),
            datums: RwSignal::default(),
            transformed: RwSignal::default(),
            planted: RwSignal::default(),
            weighted: RwSignal::default(),
            biases: RwSignal::default(),
            until: RwSignal::default(),
            wanted: RwSignal::default(),
            waiting: RwSignal::default(),
            serial: RwSignal::default(),
            turns: StoredValue::new_local(None),
            asked: RwSignal::default(),
        }
    }
}

/// Milliseconds in which a step is drawn.
const AFTER_THE_FRAME: i32 = 30;

/// Asks a question when it is its turn.
type Turn = Box<dyn FnOnce()>;

/// One percent: the iteration needs a few steps and still converges.
const LAB_MOVED: f64 = 0.01;

/// Result of a step and that of the initial values, which has the names of rows, columns and blocks for all steps.
#[derive(Clone)]
pub struct StepShown {
    first: Arc<Looked>,
    now: Arc<Looked>,
}

impl Deref for StepShown {
    type Target = Looked;

    fn deref(&self) -> &Looked {
        &self.now
    }
}

impl StepShown {
    /// The start itself.
    pub fn start(first: Arc<Looked>) -> Self {
        Self { now: first.clone(), first }
    }

    /// The columns; their values are those at the start.
    pub fn unknowns(&self) -> &[Unknown] {
        &self.first.system.unknowns
    }

    /// The rows; their values are those at the start.
    pub fn observations(&self) -> &[Equation] {
        &self.first.system.observations
    }

    pub fn blocks(&self) -> &[Block] {
        &self.first.normal.blocks
    }

    /// The unknowns of the reduced equations.
    pub fn kept(&self) -> &[usize] {
        &self.first.normal.reduced.unknowns
    }
}

impl Inside {
    /// Result of the shown step.
    pub fn looked(self) -> Option<StepShown> {
        let step = self.step.get();
        let found =
            |steps: &Vec<Arc<Looked>>| Some(StepShown { first: steps.first()?.clone(), now: steps.get(step)?.clone() });
        self.steps.with(found)
    }

    /// The unit of coordinates.
    pub fn unit(self) -> String {
        let of_points = |looked: &Arc<Looked>| {
            looked.system.unknowns.iter().find(|unknown| unknown.point.is_some()).map(|unknown| unknown.unit.clone())
        };
        self.steps.with(|steps| steps.first().and_then(of_points)).unwrap_or_default()
    }

    /// Result of the initial values, with the names of rows and columns. Changes with the network alone.
    pub fn first(self) -> Memo<Option<Arc<Looked>>> {
        let first = move |_: Option<&Option<Arc<Looked>>>| self.steps.with(|steps| steps.first().cloned());
        Memo::new_with_compare(first, |before, now| match (before, now) {
            (Some(Some(before)), Some(Some(now))) => !Arc::ptr_eq(before, now),
            (Some(None), Some(None)) => false,
            _ => true,
        })
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
        inside.sigmas.set(None);
        inside.factor.set(None);
        inside.datums.set(None);
        inside.transformed.set(None);
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
        let serial = self.inside.serial.get_untracked();
        InsideOf { serial, project, options, moved: self.inside.moved.get_untracked() }
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
        let first = inside.steps.with_untracked(|steps| steps.first().cloned());
        let names = first.is_none();
        let on_outcome = move |outcome: TaskOutcome<LookInside>| match outcome {
            TaskOutcome::Done(mut looked, bytes) => {
                self.next_turn();
                if serial != inside.serial.get_untracked() {
                    return;
                }
                inside.waiting.set(false);
                let bytes: Vec<Vec<u8>> = bytes.iter().map(Bytes::to_vec).collect();
                if !matrices_from(&mut looked, &bytes, first.as_deref()) {
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
            TaskOutcome::Failed(failure) => {
                self.next_turn();
                inside.waiting.set(false);
                inside.until.set(0);
                self.tell_failure(failure);
            }
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        let stopped = move || {
            self.next_turn();
            inside.waiting.set(false);
            inside.until.set(0);
        };
        let task = LookInside { of: self.of_inside(), step, names };
        // What is shown of the step before may wait.
        let ask = move || self.ask(Stop(words::computing, stopped), task, Vec::new(), on_outcome);
        self.in_turn(true, Box::new(ask));
    }

    /// Asks when nothing else of a step is asked; before all that waits, where it is urgent.
    fn in_turn(self, urgent: bool, ask: Turn) {
        let now = self.inside.turns.try_update_value(|turns| match turns {
            Some(waiting) => {
                if urgent {
                    waiting.push_front(ask);
                } else {
                    waiting.push_back(ask);
                }
                None
            }
            None => {
                *turns = Some(VecDeque::new());
                Some(ask)
            }
        });
        if let Some(ask) = now.flatten() {
            ask();
        }
    }

    /// The question that was asked has ended.
    fn next_turn(self) {
        let next = self.inside.turns.try_update_value(|turns| {
            let next = turns.as_mut().and_then(VecDeque::pop_front);
            if next.is_none() {
                *turns = None;
            }
            next
        });
        if let Some(ask) = next.flatten() {
            ask();
        }
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
        let factored =
            if let Inquiry::Factor { step, elimination } = &inquiry { Some((*step, *elimination)) } else { None };
        let of_step = if let Inquiry::Sigmas(step) = inquiry { step } else { step };
        let of_steps = matches!(inquiry, Inquiry::Row { .. } | Inquiry::Sigmas(_) | Inquiry::Factor { .. });
        let over = move || {
            if of_steps {
                self.next_turn();
            }
        };
        let texts = if let Inquiry::Evaluate(texts) = &inquiry { texts.clone() } else { Vec::new() };
        let answered = move |outcome: TaskOutcome<Inquire>| match outcome {
            // Of no network.
            TaskOutcome::Done(Found::Lessons(all), _) => self.lessons_came(all),
            TaskOutcome::Done(Found::ReadLesson(read), _) => self.lesson_read(*read),
            TaskOutcome::Done(found, bytes) if serial == inside.serial.get_untracked() && latest() => match found {
                // Another may have been chosen meanwhile.
                Found::Row(explained) if inside.row.get_untracked() == Some(explained.row) => {
                    inside.explained.set(Some((step, explained)));
                }
                Found::Row(_) => {}
                Found::Sigmas(found) => inside.sigmas.set(Some((of_step, found.map(Arc::new)))),
                Found::Factor(factor) => {
                    let bytes: Vec<Vec<u8>> = bytes.iter().map(Bytes::to_vec).collect();
                    let factor =
                        factor.and_then(|mut factor| factor_from(&mut factor, &bytes).then(|| Arc::new(factor)));
                    inside.factor.set(factored.map(|(step, elimination)| (step, elimination, factor)));
                }
                Found::Datums(found) => inside.datums.set(Some(found)),
                Found::Transform(found) => inside.transformed.set(Some(found)),
                Found::Plant(found) => inside.planted.set(Some(found)),
                Found::Weigh(found) => inside.weighted.set(Some(found)),
                Found::Biases(found) => inside.biases.set(found),
                Found::Evaluate(found) => self.lesson_valued(texts.clone(), found),
                Found::Lessons(_) | Found::ReadLesson(_) => {}
            },
            TaskOutcome::Done(..) => {}
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        let on_outcome = move |outcome: TaskOutcome<Inquire>| {
            over();
            answered(outcome);
        };
        let ask = move || {
            let task = Inquire { of: self.of_inside(), inquiry };
            self.ask(Stop(words::computing, over), task, Vec::new(), on_outcome);
        };
        if !of_steps {
            return ask();
        }
        // The step itself is drawn before what follows from it is asked for; of steps that follow each other fast, only the last.
        spawn_local(async move {
            page::pause(AFTER_THE_FRAME).await;
            if serial == inside.serial.get_untracked() && latest() {
                self.in_turn(false, Box::new(ask));
            }
        });
    }

    /// Hands over the matrices at the start values.
    pub fn export_inside(self) {
        let on_outcome = move |outcome: TaskOutcome<ExportInside>| match outcome {
            TaskOutcome::Done((), bytes) => {
                bytes.iter().for_each(|bytes| self.hand_over("equations.zip", "application/zip", bytes));
            }
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        let task = ExportInside { of: self.of_inside() };
        self.ask(Stop(words::computing, || ()), task, Vec::new(), on_outcome);
    }
}
