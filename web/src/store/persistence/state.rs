//! State of saving the open project to the browser's storage.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet, VecDeque};
use std::rc::Rc;

use leptos::prelude::*;

use super::super::Step;
use super::super::calls::Append;
use super::super::journal::{Book, JournalState};
use crate::browser::storage::{Fault, Storage};
use crate::document::Document;

/// State of the open project in the browser's storage.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Kept {
    /// The storage has not answered yet.
    #[default]
    Starting,
    /// This browser has no storage.
    Nowhere,
    /// Everything is written, the last of it at this time.
    At(String),
    /// Something is being written.
    Writing,
    /// Writing failed: the browser's name of the error, and its message.
    Failed(String, String),
    /// Another window has the project open; this one shows it and cannot change it.
    Following,
}

/// The open project's journal and the queue of what is to be written to it.
#[derive(Default)]
pub struct Keeper {
    pub(in crate::store) storage: Option<Storage>,
    /// Key of the open project.
    pub(in crate::store) id: Option<String>,
    pub(in crate::store) book: Rc<RefCell<Book>>,
    /// Entries that are not written yet, in order.
    pub(in crate::store) backlog: VecDeque<Append>,
    pub(in crate::store) sending: bool,
    /// Keys of photos that are stored, or could not be (`Persistence::uncopied`).
    pub(in crate::store) photos: HashSet<String>,
    pub(in crate::store) copying: bool,
    /// When a photo did not fit into the storage, in milliseconds.
    pub(in crate::store) missed_at: f64,
    /// Whether a worker is being started to replace one whose storage was cleared.
    pub(in crate::store) anew: bool,
    /// Number of notes written by this page.
    pub(in crate::store) written: usize,
    /// Whether the storage was empty when the page was loaded, until the user has been informed.
    pub(in crate::store) fresh: bool,
    /// Whether the journal is to be condensed soon; its size after the last time.
    pub(in crate::store) condensing: bool,
    pub(in crate::store) condensed: f64,
    /// States of the history that are still in the storage, by their serials.
    pub(in crate::store) stored: HashMap<u64, JournalState>,
    pub(super) reading: bool,
}

/// Signals of saving the open project.
#[derive(Clone, Copy, Default)]
pub struct Persistence {
    /// State of the open project in the browser's storage.
    pub kept: RwSignal<Kept>,
    pub(in crate::store) keeper: StoredValue<Keeper, LocalStorage>,
    /// Number of photos whose copy has not been made yet.
    pub to_copy: RwSignal<usize>,
    /// Photos that could not be copied to the storage, by their keys, and why.
    pub(in crate::store) uncopied: RwSignal<HashMap<String, Fault>>,
    /// Bytes used and available, if the browser tells them.
    pub space: RwSignal<Option<(f64, f64)>>,
    /// Whether the browser promises not to clear the storage when space runs short.
    pub persistent: RwSignal<bool>,
    /// The step to return to, while the project that was open before a reload is being read.
    pub returning: RwSignal<Option<Step>>,
    /// Name and document of the project file that was written last.
    pub saved: RwSignal<Option<(String, Document)>>,
    /// The document as it was opened, if it is a sample or an experiment that the user has not changed.
    pub(in crate::store) pristine: RwSignal<Option<Document>>,
}
