//! Orientation and adjustment in a worker, iteration by iteration, and what follows from the result.

use std::sync::Arc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::Error;
use sightline::adjustment::{AdjustOptions, Adjustment, Iteration};
use sightline::detection::{Codes, DetectOptions};
use sightline::orient::Note;
use sightline::project::Project;
use sightline_protocol::{Adjust, Adjusted, Adjusting, Long, Match, Piece, from_bytes, written};

use super::pool::{self, Batch, Failure};
use super::{Desk, JobKind, Step, Until};
use crate::browser::file::Blob;
use crate::browser::worker::Bytes;
use crate::browser::{page, storage};
use crate::document::{self, Change};
use crate::edit::targets;
use crate::format;
use crate::i18n::{comparing, first, text};

/// Rounds of matching and adjusting at most. Each names targets that the one before could not; more than a few hundred points in a
/// network that grows by one photo a round never need as many, and without a limit a network that keeps changing would never end.
const MOST_ROUNDS: usize = 12;

/// How far matching and adjusting in turn has come.
#[derive(Clone, Copy, Default)]
struct Rounds {
    found: usize,
    count: usize,
}

/// Options of detection, and what orientation and adjustment reported last.
#[derive(Clone, Copy)]
pub struct Processing {
    pub detect_options: RwSignal<DetectOptions>,
    /// Notes of the last orientation.
    pub notes: RwSignal<Vec<Note>>,
    /// Iterations of the adjustment that is running or was run last.
    pub iterations: RwSignal<Vec<Iteration>>,
    /// Why the last adjustment has no result.
    pub adjust_failure: RwSignal<Option<Error>>,
}

impl Default for Processing {
    fn default() -> Self {
        Self {
            // Users with coded targets expect them to be read; photos without rings give the same result either way.
            detect_options: RwSignal::new(DetectOptions { codes: Codes::Auto, ..DetectOptions::default() }),
            notes: RwSignal::default(),
            iterations: RwSignal::default(),
            adjust_failure: RwSignal::default(),
        }
    }
}

impl Desk {
    /// Orients what is not oriented and adjusts everything.
    pub fn adjust(self) {
        self.go(Step::Adjust);
        self.adjust_then(|_| {});
    }

    fn adjust_then(self, then: impl Fn(Self) + Clone + 'static) {
        let (input, options) = self.document.with_untracked(|d| (d.project.clone(), d.options.clone()));
        self.processing.iterations.set(Vec::new());
        self.processing.adjust_failure.set(None);
        let most = options.max_iterations;
        let batch = self.start_job(JobKind::Adjusting, most, move || self.keep_last_result());
        let project = input.clone();
        let on_outcome = move |outcome: pool::TaskOutcome<Adjust>| match outcome {
            pool::TaskOutcome::Progress(Adjusting::Oriented(notes)) => {
                // Where a worker was lost, another begins again.
                self.processing.iterations.set(Vec::new());
                self.count_job(batch, 0, most);
                self.processing.notes.set(notes);
            }
            pool::TaskOutcome::Progress(Adjusting::Iteration(iteration)) => {
                self.processing.iterations.update(|all: &mut Vec<Iteration>| all.push(iteration));
                self.step_job(batch);
            }
            pool::TaskOutcome::Done(adjusted, texts) => {
                let (input, then) = (input.clone(), then.clone());
                spawn_local(async move {
                    match self.read_result(batch, input, adjusted, texts).await {
                        Ok(true) => then(self),
                        Ok(false) => {}
                        Err(detail) => self.fail_to_adjust(Failure::Lost(detail)),
                    }
                });
            }
            pool::TaskOutcome::Failed(failure) => self.fail_to_adjust(failure),
        };
        spawn_local(async move {
            match in_files(&*project, || self.is_at_work(batch)).await {
                Ok(Some((project, files))) => {
                    let task = Adjust { project, options };
                    self.tasks.pool.with_value(|pool| pool.submit(batch, task, files, on_outcome));
                }
                Ok(None) => {}
                Err(detail) => self.fail_to_adjust(Failure::Lost(detail)),
            }
        });
    }

    /// Whether these tasks are what the page waits for, and they have not been cancelled.
    fn is_at_work(self, batch: Batch) -> bool {
        self.tasks.job.with_untracked(|job| job.as_ref().is_some_and(|job| job.batch == batch))
    }

    /// Takes a result, whose texts are kept as they came; false if it was cancelled while it was read.
    async fn read_result(
        self,
        batch: Batch,
        input: Arc<Project>,
        adjusted: Adjusted,
        mut texts: Vec<Bytes>,
    ) -> Result<bool, String> {
        let of_adjustment = texts.split_off(adjusted.oriented.len().min(texts.len()));
        let wanted = || self.is_at_work(batch);
        let Some(mut oriented) = read::<Project>(&adjusted.oriented, &texts, wanted).await? else { return Ok(false) };
        let Some(adjustment) = read::<Adjustment>(&adjusted.adjustment, &of_adjustment, wanted).await? else {
            return Ok(false);
        };
        self.end_job();
        // What orientation left as it was is there once.
        oriented.share_tables(&input);
        let outcome = Arc::new(document::AdjustmentResult { input, oriented: Arc::new(oriented), adjustment });
        self.processing.iterations.set(outcome.adjustment.iterations.clone());
        if self.storage().is_some() {
            let pieces =
                adjusted.adjustment.into_iter().zip(of_adjustment.into_iter().map(storage::Piece::Bytes)).collect();
            self.persistence.keeper.with_value(|keeper| keeper.book.borrow_mut().came(&outcome, pieces));
        }
        self.change(Change::Adjusted, |document| document.result = Some(outcome));
        Ok(true)
    }

    fn fail_to_adjust(self, failure: Failure) {
        self.end_job();
        self.show_iterations_of_result();
        if let Failure::Refused(error) = &failure {
            self.processing.adjust_failure.set(Some(error.clone()));
        }
        self.tell_failure(failure);
    }

    /// After a cancelled adjustment the last result stands, with its own iterations, and the page states to which state it belongs.
    fn keep_last_result(self) {
        self.show_iterations_of_result();
        let (any, current) = self.document.with_untracked(|d| (d.result.is_some(), d.current().is_some()));
        self.say(false, Until::Document, move || {
            match (any, current) {
                (true, true) => comparing::cancelled_result_kept(),
                (true, false) => comparing::cancelled_result_old(),
                (false, _) => comparing::cancelled_no_result(),
            }
            .to_owned()
        });
    }

    fn show_iterations_of_result(self) {
        let of_result = self.document.with_untracked(|d| d.result.as_ref().map(|r| r.adjustment.iterations.clone()));
        self.processing.iterations.set(of_result.unwrap_or_default());
    }

    /// Names the targets without a code by where the oriented photos see them.
    /// What is named then orients the photos better, and so more can be named: both are repeated until nothing is added.
    pub fn match_uncoded(self) {
        if self.may_change() {
            self.match_round(Rounds::default());
        }
    }

    fn match_round(self, before: Rounds) {
        self.match_then(move |desk, found, doubtful| {
            let rounds = Rounds { found: before.found + found, count: before.count + usize::from(found > 0) };
            match found {
                0 if rounds.count == 0 => desk.tell(move || first::match_nothing(doubtful)),
                0 => desk.tell(move || first::matched_all(format::count(rounds.found), doubtful, rounds.count)),
                _ => desk.adjust_then(move |desk| match rounds.count < MOST_ROUNDS {
                    true => desk.match_round(rounds),
                    false => desk.warn(move || first::match_stopped(rounds.count)),
                }),
            }
        });
    }

    /// Matches, adjusts and shows the result of a project that the user has not changed.
    pub fn match_then_adjust(self) {
        self.match_then(|desk, _, _| {
            // What each change draws on the step that is open, and the next step, have tasks of the page of their own.
            let go = move |step: Step| {
                spawn_local(async move {
                    page::breathe().await;
                    desk.go(step);
                });
            };
            desk.adjust_then(move |desk| {
                desk.is_pristine();
                go(Step::Results);
            });
            go(Step::Adjust);
        });
    }

    /// Matches once; `then` gets how many observations are new and how many targets are doubtful.
    fn match_then(self, then: impl Fn(Self, usize, usize) + 'static) {
        let (project, targets) = self.document.with_untracked(|d| {
            let oriented = d
                .current()
                .map_or_else(|| (*d.project).clone(), |r| sightline::adjust::apply(&r.oriented, &r.adjustment));
            (oriented, targets::by_photo(d))
        });
        let batch = self.start_job(JobKind::Matching, 1, || {});
        let task = Match { project, targets };
        let on_outcome = move |outcome: pool::TaskOutcome<Match>| match outcome {
            pool::TaskOutcome::Progress(_) => {}
            pool::TaskOutcome::Done(matching, _) => {
                self.end_job();
                let (found, doubtful) = self.take_matching(matching);
                then(self, found, doubtful);
            }
            pool::TaskOutcome::Failed(failure) => {
                self.end_job();
                self.tell_failure(failure);
            }
        };
        self.tasks.pool.with_value(|pool| pool.submit(batch, task, Vec::new(), on_outcome));
    }

    /// Chooses how image coordinates are weighted and what is done about gross errors.
    pub fn set_options(self, choose: impl FnOnce(&mut AdjustOptions)) {
        self.change(Change::OptionsChosen, |document| choose(&mut document.options));
    }

    /// Takes the standard deviation of what is not modelled as typed, in pixels.
    pub fn set_unmodelled(self, typed: &str) {
        match format::parse(typed).filter(|px| *px >= 0.0 && *px < 1000.0) {
            Some(px) => self.set_options(|options| options.unmodelled = px),
            None => self.refuse(typed, text::not_zero_or_more),
        }
    }

    /// Takes the diameter of the targets as typed, in the project's unit; nothing for none.
    pub fn set_target_diameter(self, typed: &str) {
        let diameter = format::parse(typed).filter(|diameter| *diameter > 0.0);
        if diameter.is_some() || typed.trim().is_empty() {
            self.set_options(|options| options.target_diameter = diameter);
        } else {
            self.refuse(typed, text::no_diameter);
        }
    }
}

/// An object in pieces, each written in a task of the page of its own, as files; nothing where they are not wanted any more.
async fn in_files<T: Long>(object: &T, wanted: impl Fn() -> bool) -> Result<Option<(Vec<Piece>, Vec<Blob>)>, String> {
    let (mut pieces, mut files) = (Vec::new(), Vec::new());
    let mut all = written(object);
    loop {
        page::breathe().await;
        if !wanted() {
            return Ok(None);
        }
        let Some((piece, text)) = all.next() else { return Ok(Some((pieces, files))) };
        pieces.push(piece);
        files.push(Blob::of_text(&text)?);
    }
}

/// An object from its text in pieces, each read in a task of the page of its own; nothing where it is not wanted any more.
async fn read<T: Long>(pieces: &[Piece], texts: &[Bytes], wanted: impl Fn() -> bool) -> Result<Option<T>, String> {
    if pieces.len() != texts.len() {
        return Err(format!("{} texts of {} pieces", texts.len(), pieces.len()));
    }
    let all = || pieces.iter().zip(texts);
    let frame = all().filter(|(piece, _)| **piece == Piece::Frame).flat_map(|(_, text)| text.to_vec());
    let mut object = from_bytes::<T>(&frame.collect::<Vec<_>>())?;
    for (piece, text) in all() {
        if let Piece::Rows(name) = piece {
            page::breathe().await;
            if !wanted() {
                return Ok(None);
            }
            object.add(name, &text.to_vec())?;
        }
    }
    // What is made of it takes a task too.
    page::breathe().await;
    Ok(wanted().then_some(object))
}
