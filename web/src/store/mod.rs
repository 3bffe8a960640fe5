//! State and actions of the desk, independent of its views. Components read its signals and call its actions.

pub mod adjusting;
mod apart;
mod axes;
mod calibrating;
pub mod calls;
pub mod cameras;
mod cleared;
pub mod condensing;
pub mod control;
mod copying;
pub mod detection;
pub mod document;
pub mod equipment;
pub mod experiments;
pub mod features;
pub mod foreign;
pub mod grids;
pub mod history;
pub mod identity;
pub mod inside;
pub mod intake;
mod jobs;
pub mod keeping;
pub mod kept;
mod lasting;
pub mod lesson;
pub mod marking;
pub mod models;
pub mod monitoring;
mod notices;
pub mod parts;
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
mod splices;
mod steps;
pub mod tables;
pub mod texts;
pub mod values;

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use leptos::prelude::*;
use sightline::Error;
use sightline::adjustment::Iteration;
use sightline::detection::{Codes, DetectOptions};
use sightline::exif::PhotoInfo;
use sightline::orient::Note;

use crate::browser::file::{Blob, NamedFile};
use crate::browser::page;
use crate::browser::picture::Picture;
use crate::browser::storage::Fault;
use crate::edit::questions::Question;
use crate::i18n::text;
pub use axes::axes_here;
use control::Pasted;
use document::{Change, Document};
use equipment::Equipped;
use experiments::Experiments;
use history::History;
use identity::Marks;
use inside::Inside;
pub use jobs::{Job, JobKind};
use keeping::{Keeper, Kept};
use lesson::Lessons;
use marking::Series;
use monitoring::Monitored;
pub use notices::{Asking, Notice, Until};
use planning::Planning;
use pool::Pool;
use predicting::Predicting;
use printing::Printing;
pub use selection::{Kind, Marking, Selection};
use shelf::Shelved;
pub use steps::Step;
use tables::Tables;

/// A menu of the head.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Menu {
    /// What is done with a project, and what lies beside the path.
    File,
    /// On a phone: everything that is not needed all the time.
    More,
}

/// Colours of the page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    #[default]
    Light,
    Dark,
    /// For reading in sunlight: the strongest contrast.
    Sun,
}

impl Theme {
    pub fn name(self) -> &'static str {
        match self {
            Self::Light => "light",
            Self::Dark => "dark",
            Self::Sun => "sun",
        }
    }

    pub fn next(self) -> Self {
        match self {
            Self::Light => Self::Dark,
            Self::Dark => Self::Sun,
            Self::Sun => Self::Light,
        }
    }
}

/// A photo's file as it was dropped.
#[derive(Clone)]
pub struct PhotoFile {
    pub name: String,
    pub content: Blob,
    /// The person's own file, where `content` is the copy that the browser keeps.
    pub original: Option<Blob>,
    /// Width and height in pixels.
    pub size: [u32; 2],
    pub info: PhotoInfo,
    pub small: Picture,
    pub digest: u64,
    /// SHA-256, where the file was looked into since it came.
    pub sha256: String,
}

/// A file that was not taken, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    pub file: String,
    pub reason: Reason,
}

/// Why a file was not taken.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// The engine refused it.
    Engine(Error),
    /// The same content as another photo.
    Duplicate { of: String },
    /// The name of a photo of the project, and other contents or none that are recorded: it is asked.
    SameName { of: String },
    /// A developed photo whose RAW is taken.
    Developed { of: String },
    /// A RAW whose developed photo is here already.
    RawOf { of: String },
    /// The browser could not read it, or its worker was lost.
    Unreadable(String),
    /// There is nothing in it.
    Empty,
    /// Another project was opened from the same drop.
    AnotherProject,
    /// It is a text, but no list of anything that is read here.
    NoList,
    /// A project that was not adjusted cannot be an epoch.
    EpochNotAdjusted,
    /// Neither can one that has changed since.
    EpochOutOfDate,
}

/// What keys ask of the photo view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViewVerb {
    Fit,
    OneToOne,
    Nearer,
    Farther,
}

/// What is drawn over photos, each to be switched off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layers {
    pub ellipses: bool,
    pub names: bool,
    pub predicted: bool,
    pub epipolar: bool,
    pub residuals: bool,
    /// Displacements between epochs.
    pub displacements: bool,
    /// The grid of the pixels and their values, where a photo is magnified enough for them.
    pub pixels: bool,
    /// How many times their length residuals are drawn.
    pub residual_factor: f64,
    /// How bright and how rich in contrast photos are shown; 1 is as they are.
    pub brightness: f64,
    pub contrast: f64,
}

impl Default for Layers {
    fn default() -> Self {
        Self {
            ellipses: true,
            names: true,
            predicted: true,
            epipolar: true,
            residuals: false,
            displacements: true,
            pixels: true,
            residual_factor: 100.0,
            brightness: 1.0,
            contrast: 1.0,
        }
    }
}

/// The desk: signals of everything it knows. Copy it wherever it is needed.
#[derive(Clone, Copy)]
pub struct Desk {
    pub document: RwSignal<Document>,
    history: RwSignal<History>,
    pub step: RwSignal<Step>,
    pub theme: RwSignal<Theme>,
    pub selection: RwSignal<Selection>,
    /// Where the pointer is in the photo, in pixels.
    pub cursor: RwSignal<Option<[f64; 2]>>,
    /// A place in the photo that the photo view should show.
    pub centre_on: RwSignal<Option<[f64; 2]>>,
    /// A place that the photo view should show closely, and how many pixels around it.
    pub show_place: RwSignal<Option<([f64; 2], f64)>>,
    /// Whether points are measured one after the other through the photos.
    pub series: RwSignal<Option<Series>>,
    pub predicting: Predicting,
    /// The question that is asked.
    pub question: RwSignal<Option<Question>>,
    pub tables: Tables,
    /// Whether the list of keys is open.
    pub help: RwSignal<bool>,
    /// Whether keys of a single letter act.
    pub single_keys: RwSignal<bool>,
    /// What the photo view is asked to do.
    pub view_verb: RwSignal<Option<ViewVerb>>,
    /// What is drawn over photos.
    pub layers: RwSignal<Layers>,
    /// Whether clicks in a photo place points freely, as with Alt.
    pub placing: RwSignal<bool>,
    /// The step of the path, or the start page, that was shown before what lies beside it.
    pub came_from: RwSignal<Step>,
    /// The menu that is open.
    pub menu: RwSignal<Option<Menu>>,
    /// The step to return to, while the project that was open before the page was loaded again comes back.
    pub returning: RwSignal<Option<Step>>,
    pub detect_options: RwSignal<DetectOptions>,
    /// Iterations of the adjustment under way or done last.
    pub iterations: RwSignal<Vec<Iteration>>,
    /// What the last orientation had to say.
    pub notes: RwSignal<Vec<Note>>,
    /// Why the last adjustment gave no result.
    pub adjust_failure: RwSignal<Option<Error>>,
    /// Marks of an earlier measurement, waiting to be taken.
    pub marks: RwSignal<Option<Marks>>,
    /// Control points, waiting to be taken.
    pub pasted: RwSignal<Option<Pasted>>,
    pub files: RwSignal<BTreeMap<String, PhotoFile>, LocalStorage>,
    pictures: RwSignal<Vec<pictures::Shown>, LocalStorage>,
    /// How many views show photos.
    showing: StoredValue<usize>,
    parts: RwSignal<Vec<parts::Part>, LocalStorage>,
    apart: RwSignal<Vec<apart::Apart>>,
    values: RwSignal<values::Asked>,
    pub problems: RwSignal<Vec<Problem>>,
    /// Photos that are being read.
    pub coming: RwSignal<Vec<intake::Coming>, LocalStorage>,
    /// Pictures and lists that came with a network which is about to open.
    following: StoredValue<(Vec<NamedFile>, Vec<NamedFile>), LocalStorage>,
    /// Files for other programs.
    pub prepared: RwSignal<foreign::PreparedFiles, LocalStorage>,
    /// Files of shots whose other file is measured: RAW beside what was developed from it.
    pub others: StoredValue<Vec<PhotoFile>>,
    pub notice: RwSignal<Option<Notice>>,
    pub asking: RwSignal<Option<Asking>, LocalStorage>,
    /// The document as it came, where nobody has worked on it: a sample, an experiment.
    pristine: RwSignal<Option<Document>>,
    /// When the document was saved last, and as what.
    pub saved: RwSignal<Option<(String, Document)>>,
    /// How it stands with the document in the browser's storage.
    pub kept: RwSignal<Kept>,
    keeper: StoredValue<Keeper, LocalStorage>,
    /// Photos whose copy is still to be made.
    pub to_copy: RwSignal<usize>,
    /// Photos that found no room in the browser's storage, by their keys, and why.
    uncopied: RwSignal<HashMap<String, Fault>>,
    /// Bytes used and in all, where the browser says so.
    pub space: RwSignal<Option<(f64, f64)>>,
    /// Whether the browser keeps what is stored when space runs short.
    pub persistent: RwSignal<bool>,
    /// The projects on this computer, once they are read.
    pub shelf: RwSignal<Option<Vec<Shelved>>, LocalStorage>,
    /// Those that were deleted and can be got back.
    pub bin: RwSignal<Vec<Shelved>, LocalStorage>,
    /// Whether a new build of the page waits to be agreed to.
    pub update: RwSignal<bool>,
    pub offline: RwSignal<bool>,
    /// Whether the page is not kept for times without a network.
    pub needs_network: RwSignal<bool>,
    /// Whether the host has another build by now, so that the rest of this one does not come.
    pub outdated: RwSignal<bool>,
    /// The project that was deleted last, while it can be got back: its key and its name.
    pub deleted: RwSignal<Option<(String, String)>>,
    pub job: RwSignal<Option<Job>, LocalStorage>,
    pub lasting: RwSignal<Vec<lasting::Lasting>, LocalStorage>,
    pub pool: StoredValue<Pool, LocalStorage>,
    pub experiments: Experiments,
    pub inside: Inside,
    pub lessons: Lessons,
    pub reports: report::Reports,
    pub printing: Printing,
    pub equipment: Equipped,
    pub planning: Planning,
    pub monitoring: Monitored,
    pub models: models::Models,
}

impl Desk {
    pub fn new() -> Self {
        let theme = match page::preference("theme").as_deref() {
            Some("dark") => Theme::Dark,
            Some("sun") => Theme::Sun,
            Some(_) => Theme::Light,
            None if page::prefers_dark() => Theme::Dark,
            None => Theme::Light,
        };
        Self {
            document: RwSignal::default(),
            history: RwSignal::default(),
            step: RwSignal::default(),
            theme: RwSignal::new(theme),
            selection: RwSignal::default(),
            cursor: RwSignal::default(),
            centre_on: RwSignal::default(),
            show_place: RwSignal::default(),
            series: RwSignal::default(),
            predicting: Predicting::default(),
            question: RwSignal::default(),
            tables: Tables::default(),
            help: RwSignal::default(),
            single_keys: RwSignal::new(page::preference("single-keys").as_deref() != Some("off")),
            view_verb: RwSignal::default(),
            layers: RwSignal::default(),
            placing: RwSignal::default(),
            came_from: RwSignal::default(),
            menu: RwSignal::default(),
            returning: RwSignal::default(),
            // Whoever has coded targets expects them to be read; photos without rings are the same either way.
            detect_options: RwSignal::new(DetectOptions { codes: Codes::Auto, ..DetectOptions::default() }),
            iterations: RwSignal::default(),
            notes: RwSignal::default(),
            adjust_failure: RwSignal::default(),
            marks: RwSignal::default(),
            pasted: RwSignal::default(),
            files: RwSignal::new_local(BTreeMap::new()),
            pictures: RwSignal::new_local(Vec::new()),
            showing: StoredValue::new(0),
            parts: RwSignal::new_local(Vec::new()),
            apart: RwSignal::default(),
            values: RwSignal::default(),
            problems: RwSignal::default(),
            coming: RwSignal::new_local(Vec::new()),
            following: StoredValue::new_local(Default::default()),
            prepared: RwSignal::new_local(BTreeMap::new()),
            others: StoredValue::default(),
            notice: RwSignal::default(),
            asking: RwSignal::new_local(None),
            pristine: RwSignal::default(),
            saved: RwSignal::default(),
            kept: RwSignal::default(),
            keeper: StoredValue::new_local(Keeper::default()),
            to_copy: RwSignal::default(),
            uncopied: RwSignal::default(),
            space: RwSignal::default(),
            persistent: RwSignal::default(),
            shelf: RwSignal::new_local(None),
            bin: RwSignal::new_local(Vec::new()),
            update: RwSignal::default(),
            offline: RwSignal::new(page::is_offline()),
            needs_network: RwSignal::default(),
            outdated: RwSignal::default(),
            deleted: RwSignal::default(),
            job: RwSignal::new_local(None),
            lasting: RwSignal::new_local(Vec::new()),
            pool: StoredValue::new_local(Pool::default()),
            experiments: Experiments::default(),
            inside: Inside::default(),
            lessons: Lessons::default(),
            reports: report::Reports::default(),
            printing: Printing::default(),
            equipment: Equipped::default(),
            planning: Planning::default(),
            monitoring: Monitored::default(),
            models: models::Models::new(),
        }
    }

    /// Changes the document so that it can be undone.
    pub fn change(self, change: Change, edit: impl FnOnce(&mut Document)) {
        self.start_change(change, edit);
    }

    /// The same of a change that brings more later ([`arrive`](Self::arrive)): its number, none where nothing may be changed.
    pub fn start_change(self, change: Change, edit: impl FnOnce(&mut Document)) -> Option<u64> {
        if !self.may_change() {
            return None;
        }
        let before = self.document.get_untracked();
        let origin = self.history.try_update(|history| history.push(change, before));
        self.document.update(edit);
        origin
    }

    /// Takes what a change brings after it was made: undoing what was done meanwhile does not take it away. Says whether that change is still
    /// there, done or undone.
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

    /// Goes on with the change before: the two are undone together.
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

    /// What has changed since the result was found.
    pub fn changes_since_result(self) -> Vec<Change> {
        self.document.with(|d| self.history.with(|h| h.since(d)))
    }

    /// The result before the present one, where there is one.
    pub fn result_before(self) -> Option<Arc<document::Outcome>> {
        self.document.with(|d| self.history.with(|h| h.result_before(d.current()?).cloned()))
    }

    /// What undoing would take back.
    pub fn undoable(self) -> Option<Change> {
        self.history.with(|h| h.last().cloned())
    }

    /// What would be done again.
    pub fn redoable(self) -> Option<Change> {
        self.history.with(|h| h.next().cloned())
    }

    pub fn set_theme(self, theme: Theme) {
        page::set_preference("theme", theme.name());
        self.theme.set(theme);
    }

    /// Lets keys of a single letter act or not.
    pub fn set_single_keys(self, on: bool) {
        page::set_preference("single-keys", if on { "on" } else { "off" });
        self.single_keys.set(on);
    }

    /// Puts text on the clipboard.
    pub fn copy_text(self, text: String) {
        page::copy(text, move || self.warn_here(|| text::not_on_clipboard().to_owned()));
    }
}
