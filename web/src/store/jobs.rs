//! Long work, one at a time, with its progress.

use std::rc::Rc;

use leptos::prelude::*;

use super::Desk;
use super::pool::{Batch, Pool};

/// Work under way, in the one action slot.
#[derive(Clone)]
pub struct Job {
    pub kind: JobKind,
    pub done: usize,
    pub total: usize,
    pub(super) batch: Batch,
    /// Keeps what is done when the rest is cancelled.
    keep: Rc<dyn Fn()>,
}

/// Kinds of long work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JobKind {
    Opening,
    Detecting,
    Adjusting,
    Matching,
    Saving,
    OpeningProject,
    /// Of files that may be another program's.
    Reading,
    Sample,
    Experiment,
    Reporting,
    Planning,
    Comparing,
}

impl Desk {
    /// Takes the action slot for long work.
    pub(super) fn start_job(self, kind: JobKind, total: usize, keep: impl Fn() + 'static) -> Batch {
        let batch = self.pool.with_value(Pool::batch);
        self.notice.set(None);
        self.job.set(Some(Job { kind, done: 0, total, batch, keep: Rc::new(keep) }));
        batch
    }

    /// Counts one more piece of long work as done; true when it was the last.
    pub(super) fn step_job(self, batch: Batch) -> bool {
        let mut last = false;
        self.job.update(|job| {
            if let Some(job) = job.as_mut().filter(|job| job.batch == batch) {
                job.done += 1;
                last = job.done == job.total;
            }
        });
        last
    }

    /// Says how far long work is that counts by itself.
    pub(super) fn count_job(self, batch: Batch, done: usize, total: usize) {
        self.job.update(|job| {
            if let Some(job) = job.as_mut().filter(|job| job.batch == batch) {
                (job.done, job.total) = (done, total);
            }
        });
    }

    pub(super) fn end_job(self) {
        self.job.set(None);
    }

    /// Stops long work at once and keeps what is done.
    pub fn cancel(self) {
        if let Some(job) = self.job.get_untracked() {
            self.pool.with_value(|pool| pool.cancel(job.batch));
            self.job.set(None);
            (job.keep)();
        }
    }
}
