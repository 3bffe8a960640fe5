//! Background tasks (a photo to display, plots, a comparison, sheets). They go first in the queue; one that takes long is shown by
//! name below the head, with a button to cancel it.

use std::cell::Cell;
use std::rc::Rc;

use leptos::prelude::*;
use sightline_protocol::{Request, Task};

use super::Desk;
use super::pool::{Batch, Pool, TaskOutcome};
use crate::browser::file::Blob;
use crate::browser::page;
use crate::i18n::Text;

/// A task is shown after this time, in milliseconds.
const SHOWN_AFTER: i32 = 1500;

/// A background task that is running.
#[derive(Clone)]
pub struct BackgroundTask {
    words: Text,
    batch: Batch,
    /// Whether it is shown to the user because it takes long.
    shown: bool,
    ended: Rc<Cell<bool>>,
    /// Called when the task is cancelled; releases whatever waits for it.
    stopped: Rc<dyn Fn()>,
}

/// How a task is shown and cancelled: its name, and the callback that releases whatever waits for it.
pub(super) struct Stop<F>(pub Text, pub F);

impl Desk {
    /// Runs a task before all others in the queue.
    pub(super) fn ask<T: Task + Into<Request>>(
        self,
        stop: Stop<impl Fn() + 'static>,
        task: T,
        files: Vec<Blob>,
        on_outcome: impl FnMut(TaskOutcome<T>) + 'static,
    ) {
        self.watched(stop, on_outcome, |pool, on_outcome| pool.submit_first(task, files, on_outcome));
    }

    /// Runs a task in the order of the queue.
    pub(super) fn ask_in_turn<T: Task + Into<Request>>(
        self,
        stop: Stop<impl Fn() + 'static>,
        task: T,
        files: Vec<Blob>,
        on_outcome: impl FnMut(TaskOutcome<T>) + 'static,
    ) {
        self.watched(stop, on_outcome, |pool, on_outcome| {
            let batch = pool.batch();
            pool.submit(batch, task, files, on_outcome);
            batch
        });
    }

    fn watched<T: Task>(
        self,
        Stop(words, stopped): Stop<impl Fn() + 'static>,
        mut on_outcome: impl FnMut(TaskOutcome<T>) + 'static,
        submit: impl FnOnce(&Pool, Box<dyn FnMut(TaskOutcome<T>)>) -> Batch,
    ) {
        let ended = Rc::new(Cell::new(false));
        let here = ended.clone();
        let heard = Box::new(move |outcome: TaskOutcome<T>| {
            if !matches!(outcome, TaskOutcome::Progress(_)) && !here.replace(true) {
                self.tasks.background.update(|all| all.retain(|task| !Rc::ptr_eq(&task.ended, &here)));
            }
            on_outcome(outcome);
        });
        let batch = self.tasks.pool.with_value(|pool| submit(pool, heard));
        // No worker could be started.
        if ended.get() {
            return;
        }
        let task = BackgroundTask { words, batch, shown: false, ended: ended.clone(), stopped: Rc::new(stopped) };
        self.tasks.background.update(|all| all.push(task));
        page::after(SHOWN_AFTER, move || {
            if !ended.get() {
                let this = |task: &&mut BackgroundTask| Rc::ptr_eq(&task.ended, &ended);
                self.tasks.background.update(|all| all.iter_mut().filter(this).for_each(|task| task.shown = true));
            }
        });
    }

    /// Name of the slow task that was started last, which the user is waiting for.
    pub fn slow_task(self) -> Option<&'static str> {
        self.tasks.background.with(|all| all.iter().rfind(|task| task.shown).map(|task| (task.words)()))
    }

    /// Cancels the slow task that is shown and all others of the same name, such as the photos of a strip.
    pub fn cancel_slow_tasks(self) {
        let Some(words) = untrack(|| self.slow_task()) else { return };
        let stopped = self.tasks.background.try_update(|all| {
            let (stopped, left) = std::mem::take(all).into_iter().partition(|task| (task.words)() == words);
            *all = left;
            stopped
        });
        for task in stopped.into_iter().flat_map(|all: Vec<_>| all) {
            task.ended.set(true);
            self.tasks.pool.with_value(|pool| pool.cancel(task.batch));
            (task.stopped)();
        }
    }
}
