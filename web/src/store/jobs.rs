//! Long tasks, one at a time, with their progress.

use std::rc::Rc;

use leptos::prelude::*;

use super::Desk;
use super::background::BackgroundTask;
use super::pool::{Batch, Pool};

/// The long task in the action slot.
#[derive(Clone)]
pub struct Job {
    pub kind: JobKind,
    pub done: usize,
    pub total: usize,
    pub(super) batch: Batch,
    /// Stores what is done if the rest is cancelled.
    keep: Rc<dyn Fn()>,
}

/// Kinds of long tasks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JobKind {
    Opening,
    Detecting,
    Adjusting,
    Matching,
    Saving,
    OpeningProject,
    /// Reading files that may be another program's.
    Reading,
    Sample,
    Experiment,
    Reporting,
    Planning,
    Comparing,
}

/// The workers, and what they are doing.
#[derive(Clone, Copy, Default)]
pub struct Tasks {
    pub pool: StoredValue<Pool, LocalStorage>,
    /// The long task in the action slot.
    pub job: RwSignal<Option<Job>, LocalStorage>,
    pub(super) background: RwSignal<Vec<BackgroundTask>, LocalStorage>,
}

impl Desk {
    /// Starts a long task in the action slot. `keep` stores what is done if the rest is cancelled.
    pub(super) fn start_job(self, kind: JobKind, total: usize, keep: impl Fn() + 'static) -> Batch {
        let batch = self.tasks.pool.with_value(Pool::batch);
        self.messages.notice.set(None);
        self.tasks.job.set(Some(Job { kind, done: 0, total, batch, keep: Rc::new(keep) }));
        batch
    }

    /// Counts one more piece of the long task as done; true if it was the last.
    pub(super) fn step_job(self, batch: Batch) -> bool {
        let mut last = false;
        self.tasks.job.update(|job| {
            if let Some(job) = job.as_mut().filter(|job| job.batch == batch) {
                job.done += 1;
                last = job.done == job.total;
            }
        });
        last
    }

    /// Sets the progress of a long task that counts by itself.
    pub(super) fn count_job(self, batch: Batch, done: usize, total: usize) {
        self.tasks.job.update(|job| {
            if let Some(job) = job.as_mut().filter(|job| job.batch == batch) {
                (job.done, job.total) = (done, total);
            }
        });
    }

    pub(super) fn end_job(self) {
        self.tasks.job.set(None);
    }

    /// Cancels the long task and keeps what is done.
    pub fn cancel(self) {
        if let Some(job) = self.tasks.job.get_untracked() {
            self.tasks.pool.with_value(|pool| pool.cancel(job.batch));
            self.tasks.job.set(None);
            (job.keep)();
        }
    }
}
