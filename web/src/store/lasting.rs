//! Secondary work (a photo to display, plots, a comparison, sheets): it goes first in the queue, and if it takes long, its name is
//! shown below the head with a button to cancel it.

use std::cell::Cell;
use std::rc::Rc;

use leptos::prelude::*;
use sightline_protocol::{Request, Task};

use super::Desk;
use super::pool::{Batch, Outcome, Pool};
use crate::browser::file::Blob;
use crate::browser::page;
use crate::i18n::Text;

/// From here on it is told, in milliseconds.
const LASTS: i32 = 1500;

/// Work that is under way.
#[derive(Clone)]
pub struct Lasting {
    words: Text,
    batch: Batch,
    /// Whether it lasts: it is told of.
    told: bool,
    ended: Rc<Cell<bool>>,
    /// Has what waits for it wait no more.
    stopped: Rc<dyn Fn()>,
}

/// What to do when it is stopped: `words` say what it is, `stopped` has whatever waits for it wait no more.
pub(super) struct Stop<F>(pub Text, pub F);

impl Desk {
    /// Has a task done before all others.
    pub(super) fn ask<T: Task + Into<Request>>(
        self,
        stop: Stop<impl Fn() + 'static>,
        task: T,
        files: Vec<Blob>,
        on_outcome: impl FnMut(Outcome<T>) + 'static,
    ) {
        self.watched(stop, on_outcome, |pool, on_outcome| pool.submit_first(task, files, on_outcome));
    }

    /// Has a task done in its turn.
    pub(super) fn ask_in_turn<T: Task + Into<Request>>(
        self,
        stop: Stop<impl Fn() + 'static>,
        task: T,
        files: Vec<Blob>,
        on_outcome: impl FnMut(Outcome<T>) + 'static,
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
        mut on_outcome: impl FnMut(Outcome<T>) + 'static,
        submit: impl FnOnce(&Pool, Box<dyn FnMut(Outcome<T>)>) -> Batch,
    ) {
        let ended = Rc::new(Cell::new(false));
        let here = ended.clone();
        let heard = Box::new(move |outcome: Outcome<T>| {
            if !matches!(outcome, Outcome::Progress(_)) && !here.replace(true) {
                self.lasting.update(|all| all.retain(|lasting| !Rc::ptr_eq(&lasting.ended, &here)));
            }
            on_outcome(outcome);
        });
        let batch = self.pool.with_value(|pool| submit(pool, heard));
        // No worker could be started.
        if ended.get() {
            return;
        }
        let lasting = Lasting { words, batch, told: false, ended: ended.clone(), stopped: Rc::new(stopped) };
        self.lasting.update(|all| all.push(lasting));
        page::after(LASTS, move || {
            if !ended.get() {
                let this = |lasting: &&mut Lasting| Rc::ptr_eq(&lasting.ended, &ended);
                self.lasting.update(|all| all.iter_mut().filter(this).for_each(|lasting| lasting.told = true));
            }
        });
    }

    /// What lasts and was asked last: it is what somebody waits for.
    pub fn lasts(self) -> Option<&'static str> {
        self.lasting.with(|all| all.iter().rfind(|lasting| lasting.told).map(|lasting| (lasting.words)()))
    }

    /// Stops what is told of and all that is of its kind: nobody wants to stop a strip of photos one by one.
    pub fn stop_lasting(self) {
        let Some(words) = untrack(|| self.lasts()) else { return };
        let stopped = self.lasting.try_update(|all| {
            let (stopped, left) = std::mem::take(all).into_iter().partition(|lasting| (lasting.words)() == words);
            *all = left;
            stopped
        });
        for lasting in stopped.into_iter().flat_map(|all: Vec<_>| all) {
            lasting.ended.set(true);
            self.pool.with_value(|pool| pool.cancel(lasting.batch));
            (lasting.stopped)();
        }
    }
}
