//! State and actions of the desk, independent of its views. Components read its signals and call its actions.

pub mod adjusting;
mod axes;
mod background;
mod calibrating;
pub mod calls;
pub mod cameras;
mod cleared;
pub mod condensing;
mod connection;
pub mod control;
mod copying;
pub mod detection;
pub mod distance_list;
pub mod equipment;
pub mod experiments;
pub mod features;
pub mod foreign;
pub mod grids;
pub mod identity;
pub mod inside;
pub mod intake;
mod jobs;
pub mod journal;
mod lateral_colour;
pub mod lesson;
pub mod marking;
pub mod models;
pub mod monitoring;
mod notices;
pub mod parts;
pub mod persistence;
mod photo_view;
mod photos;
pub mod pictures;
pub mod planning;
pub mod plates;
pub mod pool;
pub mod predicting;
pub mod printing;
pub mod questions;
mod reading;
pub mod report;
mod returning;
mod rig;
pub mod sample;
pub mod saving;
pub mod selection;
pub mod shelf;
mod steps;
pub mod tables;
pub mod texts;
pub mod values;
mod window;

use std::sync::Arc;

use leptos::prelude::*;

use crate::browser::page;
use crate::document::history::History;
pub use crate::document::keys::Kind;
use crate::document::{Change, Document};
use crate::i18n::text;
use adjusting::Processing;
pub use axes::axes_here;
use connection::Connection;
use equipment::Equipped;
use experiments::Experiments;
use foreign::OtherPrograms;
use inside::Inside;
use intake::Intake;
pub use intake::{Problem, Reason};
use jobs::Tasks;
pub use jobs::{Job, JobKind};
use lesson::Lessons;
use marking::Measuring;
use models::Models;
use monitoring::Monitored;
use notices::Messages;
pub use notices::{Asking, Until};
use persistence::Persistence;
use photo_view::PhotoViewState;
pub use photo_view::{Layers, ViewCommand};
pub use photos::PhotoFile;
use photos::Photos;
use planning::Planning;
use predicting::Predicting;
use printing::Printing;
use report::Reports;
pub use selection::{Marking, Selection};
use shelf::Shelf;
pub use steps::Step;
use tables::Tables;
use window::Window;
pub use window::{Menu, Theme};

/// State of the desk: signals, grouped by area, each group in the file of its area. Copy it wherever it is needed.
#[derive(Clone, Copy)]
pub struct Desk {
    pub document: RwSignal<Document>,
    history: RwSignal<History>,
    pub step: RwSignal<Step>,
    pub selection: RwSignal<Selection>,
    pub window: Window,
    pub connection: Connection,
    pub messages: Messages,
    pub photos: Photos,
    pub photo_view: PhotoViewState,
    pub intake: Intake,
    pub measuring: Measuring,
    pub predicting: Predicting,
    pub processing: Processing,
    pub tables: Tables,
    pub other_programs: OtherPrograms,
    pub persistence: Persistence,
    pub shelf: Shelf,
    pub tasks: Tasks,
    pub experiments: Experiments,
    pub inside: Inside,
    pub lessons: Lessons,
    pub reports: Reports,
    pub printing: Printing,
    pub equipment: Equipped,
    pub planning: Planning,
    pub monitoring: Monitored,
    pub models: Models,
}

impl Desk {
    pub fn new() -> Self {
        Self {
            document: RwSignal::default(),
            history: RwSignal::default(),
            step: RwSignal::default(),
            selection: RwSignal::default(),
            window: Window::restored(),
            connection: Connection::new(),
            messages: Messages::default(),
            photos: Photos::default(),
            photo_view: PhotoViewState::default(),
            intake: Intake::default(),
            measuring: Measuring::default(),
            predicting: Predicting::default(),
            processing: Processing::default(),
            tables: Tables::default(),
            other_programs: OtherPrograms::default(),
            persistence: Persistence::default(),
            shelf: Shelf::default(),
            tasks: Tasks::default(),
            experiments: Experiments::default(),
            inside: Inside::default(),
            lessons: Lessons::default(),
            reports: Reports::default(),
            printing: Printing::default(),
            equipment: Equipped::default(),
            planning: Planning::default(),
            monitoring: Monitored::default(),
            models: Models::new(),
        }
    }

    /// Changes the document so that it can be undone.
    pub fn change(self, change: Change, edit: impl FnOnce(&mut Document)) {
        self.start_change(change, edit);
    }

    /// As [`change`](Self::change), for a change whose results arrive later ([`arrive`](Self::arrive)). Returns its number, or `None` if the
    /// document cannot be changed now.
    pub fn start_change(self, change: Change, edit: impl FnOnce(&mut Document)) -> Option<u64> {
        if !self.may_change() {
            return None;
        }
        let before = self.document.get_untracked();
        let origin = self.history.try_update(|history| history.push(change, before));
        self.document.update(edit);
        origin
    }

    /// Applies results that arrive after their change was made to all states that have the change, so that undoing later changes keeps
    /// them. Returns whether the history still has the change.
    pub fn arrive(self, origin: u64, edit: impl Fn(&mut Document)) -> bool {
        if !self.may_change() {
            return true;
        }
        let present = self.history.try_update(|history| history.arrive(origin, &edit)).flatten();
        if present == Some(true) {
            self.document.update(edit);
        }
        present.is_some()
    }

    /// Extends the previous change: both are undone together.
    pub fn change_on(self, edit: impl FnOnce(&mut Document)) {
        if self.may_change() {
            self.document.update(edit);
        }
    }

    pub fn undo(self) {
        if !self.may_change() {
            return;
        }
        let present = self.document.get_untracked();
        if let Some(state) = self.history.try_update(|h| h.undo(present)).flatten() {
            self.document.set(state);
        }
    }

    pub fn redo(self) {
        if !self.may_change() {
            return;
        }
        let present = self.document.get_untracked();
        if let Some(state) = self.history.try_update(|h| h.redo(present)).flatten() {
            self.document.set(state);
        }
    }

    /// Changes since the present result was computed.
    pub fn changes_since_result(self) -> Vec<Change> {
        self.document.with(|d| self.history.with(|h| h.since(d)))
    }

    /// The result before the present one.
    pub fn result_before(self) -> Option<Arc<crate::document::AdjustmentResult>> {
        self.document.with(|d| self.history.with(|h| h.result_before(d.current()?).cloned()))
    }

    /// The change that `undo` takes back.
    pub fn undoable(self) -> Option<Change> {
        self.history.with(|h| h.last().cloned())
    }

    /// The change that `redo` makes again.
    pub fn redoable(self) -> Option<Change> {
        self.history.with(|h| h.next().cloned())
    }

    /// Puts text on the clipboard.
    pub fn copy_text(self, text: String) {
        page::copy(text, move || self.warn_here(|| text::not_on_clipboard().to_owned()));
    }
}
