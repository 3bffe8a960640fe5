//! Saves the open project: each change is written to the browser's storage at once, photos afterwards.

mod state;

use std::collections::{BTreeMap, HashSet};
use std::rc::Rc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use serde::de::IgnoredAny;
use sightline_protocol::to_text;

use super::calls::{Append, Appended, Damage, KeptCard, Opened, ProjectId, Started, Starting, card};
use super::journal::{JournalPart, KeptFile};
use super::reading::{ReadProject, read_document, rescued};
use super::{Desk, PhotoFile, Selection, Step, Until};
use crate::browser::file::NamedFile;
use crate::browser::page;
use crate::browser::storage::{Extra, Fault, LOST, Storage};
use crate::document::Document;
use crate::document::history::{History, HistoryEntry};
use crate::i18n::text;
pub use state::{Kept, Persistence};

/// Undoable states that are read ahead of being asked for.
const AHEAD: usize = 20;

impl PhotoFile {
    pub(super) fn pixels(&self) -> f64 {
        f64::from(self.size[0]) * f64::from(self.size[1])
    }

    /// Names it in the storage, by what is in it.
    pub(super) fn key(&self) -> String {
        format!("{:016x}-{}", self.digest, self.content.size())
    }

    fn kept(&self) -> KeptFile {
        let Self { name, size, info, digest, .. } = self;
        KeptFile { key: self.key(), name: name.clone(), size: *size, info: info.clone(), digest: *digest }
    }
}

impl Desk {
    /// Starts the storage, and keeps whatever changes from now on.
    pub fn start_keeping(self) {
        match self.storage_worker() {
            Ok(storage) => spawn_local(async move {
                match storage.call::<Started>("start", &Starting { after: None }, Vec::new()).await {
                    Ok((Started { kind, fresh }, _)) if kind != "none" => {
                        self.persistence.keeper.update_value(|keeper| {
                            keeper.storage = Some(storage);
                            keeper.fresh = fresh;
                        });
                        self.persistence.kept.set(Kept::At(String::new()));
                        self.keep_now();
                        self.read_shelf();
                        self.read_equipment();
                        self.return_to_open();
                    }
                    _ => self.keep_nowhere(),
                }
            }),
            Err(_) => self.keep_nowhere(),
        }
        self.start_remembering();
        Effect::new(move || {
            self.document.track();
            self.history.track();
            self.photos.files.track();
            untrack(|| self.keep_now());
        });
    }

    fn keep_nowhere(self) {
        self.persistence.kept.set(Kept::Nowhere);
        self.return_nowhere();
    }

    pub(super) fn storage_worker(self) -> Result<Storage, String> {
        Storage::start(move |told| self.hear_from_storage(told))
    }

    fn hear_from_storage(self, told: &str) {
        match told {
            "equipment" => return self.read_equipment(),
            "cleared" => return spawn_local(self.keep_anew("told")),
            LOST => return spawn_local(self.replace_storage()),
            _ => {}
        }
        let Some(id) = self.open_id() else { return };
        match told {
            "yielded" => self.yielded(),
            "wanted" => spawn_local(self.let_go(id)),
            // What is not written is not replaced by what another window wrote: its answer comes first.
            "changed" if self.follows() && !self.unwritten() => spawn_local(async move {
                self.read_again(&id).await;
            }),
            _ => {}
        }
    }

    /// Lets another window go on with the project, when all that was done here is written.
    async fn let_go(self, id: String) {
        let Some(storage) = self.storage() else { return };
        self.flushed().await;
        if self.open_id().as_ref() != Some(&id) || self.follows() {
            return;
        }
        self.persistence.kept.set(Kept::Following);
        // A worker that ends meanwhile lets go, too.
        let _ = storage.call::<IgnoredAny>("yield", &ProjectId { id: &id }, Vec::new()).await;
    }

    /// Another window has the project now. What could not be written before that is kept as a project of its own.
    pub(super) fn yielded(self) {
        self.persistence.kept.set(Kept::Following);
        if self.persistence.keeper.with_value(|keeper| keeper.sending || keeper.backlog.is_empty()) {
            return;
        }
        let name = self.document.with_untracked(|d| d.project.name.clone());
        let copy = text::copy_of(&name);
        self.persistence.keeper.update_value(|keeper| {
            keeper.id = None;
            keeper.book = Rc::default();
            keeper.backlog.clear();
            keeper.stored.clear();
        });
        self.persistence.kept.set(Kept::Writing);
        self.document.update(|document| super::saving::rename(document, copy.clone()));
        self.say(true, Until::NextWork, move || text::kept_as_copy(&name, &copy));
        self.keep_now();
    }

    /// The project that is open, where the storage has it.
    pub fn open_id(self) -> Option<String> {
        self.persistence.keeper.with_value(|keeper| keeper.id.clone())
    }

    /// Whether another window has the project, and this one only reads along.
    pub fn follows(self) -> bool {
        self.persistence.kept.with_untracked(|kept| *kept == Kept::Following)
    }

    /// Whether everything that was done is in the storage or on its way there.
    pub(super) fn keeps(self) -> bool {
        self.persistence.kept.with_untracked(|kept| matches!(kept, Kept::At(_) | Kept::Writing | Kept::Following))
    }

    /// Refuses a change where another window has the project.
    pub(super) fn may_change(self) -> bool {
        if self.follows() {
            self.say(true, Until::Sight, || text::reads_along().to_owned());
            return false;
        }
        true
    }

    pub(super) fn storage(self) -> Option<Storage> {
        self.persistence.keeper.with_value(|keeper| keeper.storage.clone())
    }

    /// Writes what has changed since the last time.
    pub(super) fn keep_now(self) {
        if self.storage().is_none() || self.follows() {
            return;
        }
        let document = self.document.get_untracked();
        if document.is_empty() {
            return;
        }
        let files = self.photos.files.with_untracked(|files| {
            let photos = document.project.photos.iter().map(|photo| photo.id.as_str()).collect::<HashSet<_>>();
            files
                .iter()
                .filter(|(id, _)| photos.contains(id.as_str()))
                .map(|(id, file)| (id.clone(), file.kept()))
                .collect::<BTreeMap<_, _>>()
        });
        let step = self.step.get_untracked();
        self.persistence.keeper.update_value(|keeper| {
            let added = {
                let mut book = keeper.book.borrow_mut();
                let snapshot = book.is_new();
                self.history.with_untracked(|h| book.note(&document, h, &files)).map(|added| (snapshot, added))
            };
            let Some((snapshot, (note, parts))) = added else { return };
            if keeper.id.is_none() {
                keeper.id = Some(page::unique_name());
                spawn_local(async move {
                    let persistent = page::ask_to_persist().await;
                    self.persistence.persistent.set(persistent);
                });
            }
            let id = keeper.id.clone().unwrap_or_default();
            let (numbers, texts) =
                parts.into_iter().map(|JournalPart { number, kind, text }| ((number, kind), text)).unzip();
            let order = document.project.photos.iter();
            let keys = order.filter_map(|photo| files.get(&photo.id)).map(|file| file.key.clone()).collect();
            let card = KeptCard { card: card(&document, step), keys };
            keeper.condensed = if snapshot { 0.0 } else { keeper.condensed };
            keeper.backlog.push_back(Append { id, snapshot, note: to_text(&note), parts: numbers, card, texts });
        });
        self.send_backlog();
        self.copy_photos();
        self.read_history();
    }

    fn send_backlog(self) {
        let Some(storage) = self.storage() else { return };
        if self.persistence.keeper.with_value(|keeper| keeper.sending || keeper.backlog.is_empty()) {
            return;
        }
        self.persistence.keeper.update_value(|keeper| keeper.sending = true);
        let room_came = self.persistence.kept.with_untracked(|kept| matches!(kept, Kept::Failed(..)));
        self.persistence.kept.set(Kept::Writing);
        spawn_local(async move {
            let mut outcome = Ok(());
            while let Some(next) =
                self.persistence.keeper.try_update_value(|keeper| keeper.backlog.pop_front()).flatten()
            {
                let extras = next.texts.iter().cloned().map(Extra::Pieces).collect();
                match storage.call::<Appended>("append", &next, extras).await {
                    Ok((Appended { size }, _)) => {
                        self.persistence.keeper.update_value(|keeper| keeper.written += 1);
                        self.watch_size(size);
                    }
                    Err(fault) => {
                        self.persistence.keeper.update_value(|keeper| keeper.backlog.push_front(next));
                        outcome = Err(fault);
                        break;
                    }
                }
            }
            self.persistence.keeper.update_value(|keeper| keeper.sending = false);
            match outcome {
                Ok(()) if self.follows() => {
                    if let Some(id) = self.open_id() {
                        self.read_again(&id).await;
                    }
                }
                // Another window took the project over while this was on its way.
                Err(Fault { name, .. }) if name == "TakenError" || self.follows() => self.yielded(),
                Ok(()) => {
                    self.persistence.kept.set(Kept::At(page::clock()));
                    self.measure_space();
                    self.copy_after_writing(room_came);
                }
                Err(Fault { name, .. }) if name == "GoneError" => self.keep_anew("noticed").await,
                // Another worker takes this one's place, and everything is written again.
                Err(Fault { name, .. }) if name == LOST => self.replace_storage().await,
                Err(Fault { name, detail }) => self.tell_unkept(name, detail),
            }
        });
    }

    /// Entries that could not be written stay here, are tried again, and the user is told how to save the project.
    pub(super) fn tell_unkept(self, name: String, detail: String) {
        let told = self.persistence.kept.with_untracked(|kept| matches!(kept, Kept::Failed(..)));
        self.persistence.kept.set(Kept::Failed(name.clone(), detail.clone()));
        if !told {
            self.say(true, Until::NextWork, move || unkept_words(&name, &detail));
        }
        page::after(5000, move || self.send_backlog());
    }

    /// Waits until everything is written; false if something could not be.
    pub(super) async fn flushed(self) -> bool {
        while self.persistence.keeper.with_value(|keeper| keeper.sending) {
            page::pause(20).await;
        }
        self.persistence.keeper.with_value(|keeper| keeper.backlog.is_empty())
    }

    /// Whether something that was done is in this page alone.
    pub(super) fn unwritten(self) -> bool {
        self.persistence.keeper.with_value(|keeper| keeper.sending || !keeper.backlog.is_empty())
    }

    /// Puts another project in the place of this one, with a history of its own. Where nothing is kept the one before can be
    /// got back by undoing.
    pub(super) fn begin(self, document: Document) {
        if !self.keeps() {
            return self.change(crate::document::Change::Opened, |d| *d = document);
        }
        self.keep_now();
        let left = self.document.with_untracked(|d| (!d.is_empty()).then(|| d.project.name.clone()));
        self.persistence.keeper.update_value(|keeper| {
            keeper.id = None;
            keeper.book = Rc::default();
            keeper.stored.clear();
        });
        if self.follows() {
            self.persistence.kept.set(Kept::At(page::clock()));
        }
        self.photos.files.set(BTreeMap::new());
        self.photos.others.set_value(Vec::new());
        self.history.set(History::default());
        self.document.set(document);
        if let Some(name) = left.filter(|name| !name.is_empty()) {
            self.say(false, Until::NextWork, move || text::other_is_kept(&name));
        }
    }

    /// Opens a project of the list, as it was left.
    pub fn open_kept(self, id: String, step: Step) {
        self.open_kept_then(id, step, |_| ());
    }

    pub(super) fn open_kept_then(self, id: String, step: Step, then: fn(Self)) {
        self.over_unsaved(move || {
            self.keep_now();
            let id = id.clone();
            spawn_local(async move {
                if self.flushed().await && self.open_call("open", &id).await {
                    self.go(step);
                    then(self);
                }
            });
        });
    }

    /// Goes on in this window with what another one has.
    pub fn take_over(self) {
        let Some(id) = self.open_id() else { return };
        spawn_local(async move {
            self.open_call("take", &id).await;
        });
    }

    pub(super) async fn read_again(self, id: &str) {
        self.open_call("open", id).await;
    }

    pub(super) async fn open_call(self, call: &str, id: &str) -> bool {
        let Some(storage) = self.storage() else { return false };
        let restored = match storage.call::<Opened>(call, &ProjectId { id }, Vec::new()).await {
            Ok((opened, _)) => self.restore(&storage, id, opened).await,
            Err(fault) => Err(fault),
        };
        match restored {
            Ok(()) => true,
            Err(fault) => {
                // A damaged journal was put aside: the list offers it.
                self.read_shelf();
                self.say(true, Until::NextWork, move || match fault.name.as_str() {
                    "VersionError" => text::kept_by_newer(&fault.detail),
                    _ => text::kept_unreadable(format!("{}: {}", fault.name, fault.detail)),
                });
                false
            }
        }
    }

    async fn restore(self, storage: &Storage, id: &str, opened: Opened) -> Result<(), Fault> {
        let ReadProject { document, history, book, stored, files, lost } = if opened.has_gap() {
            rescued(storage, &opened).await?
        } else {
            ReadProject::whole(storage, &opened).await?
        };
        let (mut here, mut without_picture) = (BTreeMap::new(), Vec::new());
        for (photo, file) in files {
            match file {
                (file, Some(content), Some(small)) => {
                    let KeptFile { name, size, info, digest, .. } = file;
                    here.insert(
                        photo,
                        PhotoFile { name, content, original: None, size, info, small, digest, sha256: String::new() },
                    );
                }
                (file, Some(content), None) => without_picture.push(NamedFile { name: file.name, content }),
                (_, None, _) => {}
            }
        }
        let same = self.open_id().as_deref() == Some(id);
        let first = document.project.photos.first().map(|photo| photo.id.clone());
        self.persistence.keeper.update_value(|keeper| {
            keeper.id = Some(id.to_owned());
            keeper.condensed = 0.0;
            keeper.book = book;
            keeper.stored = stored;
            keeper.backlog.clear();
            keeper.photos.extend(here.values().map(PhotoFile::key));
        });
        self.persistence.kept.set(if opened.following { Kept::Following } else { Kept::At(page::clock()) });
        self.history.set(history);
        self.photos.files.set(here);
        self.photos.others.set_value(Vec::new());
        self.processing
            .iterations
            .set(document.result.as_ref().map(|r| r.adjustment.iterations.clone()).unwrap_or_default());
        if !same {
            self.forget_waiting();
            self.selection.set(Selection { photo: first, ..Selection::default() });
        }
        self.document.set(document);
        self.read_history();
        if let Some(damage) = opened.damage {
            self.say(true, Until::NextWork, move || match damage {
                Damage { mended: true, .. } => text::journal_mended().to_owned(),
                Damage { gap: true, .. } => text::journal_damaged(lost),
                _ => text::journal_end_damaged().to_owned(),
            });
        }
        if !without_picture.is_empty() {
            self.take(without_picture);
        }
        Ok(())
    }

    /// Reads the states that may be undone or done again next.
    fn read_history(self) {
        let Some(storage) = self.storage() else { return };
        let Some(serial) = self.next_to_read() else { return };
        let begun = self.persistence.keeper.try_update_value(|keeper| {
            if keeper.reading {
                return None;
            }
            let state = keeper.stored.get(&serial).cloned()?;
            keeper.reading = true;
            Some((state, keeper.book.clone(), keeper.id.clone()))
        });
        let Some((state, book, id)) = begun.flatten() else { return };
        spawn_local(async move {
            let read = read_document(&storage, &book, &state).await;
            self.persistence.keeper.update_value(|keeper| {
                keeper.reading = false;
                if keeper.id == id {
                    keeper.stored.remove(&serial);
                }
            });
            if let (true, Ok(document)) = (self.open_id() == id, read) {
                self.history.update(|history| history.fill(serial, document));
            }
            self.read_history();
        });
    }

    fn next_to_read(self) -> Option<u64> {
        self.persistence.keeper.with_value(|keeper| {
            if keeper.stored.is_empty() {
                return None;
            }
            let next = |entries: &[HistoryEntry]| {
                let ahead = entries.iter().rev().take(AHEAD);
                ahead.filter(|e| e.state.is_none()).map(|e| e.serial).find(|serial| keeper.stored.contains_key(serial))
            };
            self.history.with_untracked(|history| next(&history.past).or_else(|| next(&history.future)))
        })
    }

    /// Leaves no project open.
    pub(super) fn put_away(self) {
        self.persistence.keeper.update_value(|keeper| {
            keeper.id = None;
            keeper.book = Rc::default();
            keeper.backlog.clear();
            keeper.stored.clear();
        });
        self.forget_open();
        self.forget_waiting();
        self.photos.files.set(BTreeMap::new());
        self.photos.others.set_value(Vec::new());
        self.history.set(History::default());
        self.document.set(Document::default());
        self.selection.set(Selection::default());
    }

    /// Asks the browser how much room there is.
    pub(super) fn measure_space(self) {
        spawn_local(async move { self.persistence.space.set(page::space().await) });
    }
}

/// The sentence for what could not be written.
pub fn unkept_words(name: &str, detail: &str) -> String {
    match name {
        "QuotaExceededError" => text::storage_full().to_owned(),
        "HeldError" => text::held_by_windows().to_owned(),
        _ => text::not_kept(detail),
    }
}

/// The sentence for photos that are in this page alone, out of the browser's words for why.
pub fn uncopied_words(photos: usize, Fault { name, detail }: &Fault) -> String {
    match name.as_str() {
        // Messages of browsers about a full disk are in English and for programmers.
        "QuotaExceededError" => text::photos_not_copied(photos, text::no_room()),
        _ => text::photos_not_copied(photos, format!("{name}: {detail}")),
    }
}
