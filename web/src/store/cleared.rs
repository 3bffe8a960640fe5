//! Another worker in the place of the one that kept the project: where the browser cleared its storage under the open page, for the worker
//! has files of it open, and everything is written again; and where the worker has ended by itself, then what it had not written is.

use std::rc::Rc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use serde::de::IgnoredAny;

use super::calls::{Opened, ProjectId, Started, Starting};
use super::persistence::Kept;
use super::{Desk, Until};
use crate::browser::page;
use crate::browser::storage::{Fault, LOST, Storage};
use crate::i18n::text;

/// When it is looked whether what was stored again is there still, in milliseconds one after the other.
const LOOKS_MS: [i32; 3] = [500, 3000, 10_000];
/// Until it is tried again where another window holds on to files of the cleared storage.
const AGAIN_MS: i32 = 5000;

impl Desk {
    /// Writes everything again, photos from where they came. `after` as in [`Starting`].
    pub(super) async fn keep_anew(self, after: &'static str) {
        let follows = self.follows();
        if !self.end_storage().await {
            return;
        }
        let storage = loop {
            match self.started_anew(Some(after)).await {
                Ok(Some(storage)) => break storage,
                Ok(None) => {
                    self.persistence.keeper.update_value(|keeper| keeper.anew = false);
                    return self.persistence.kept.set(Kept::Nowhere);
                }
                Err(Fault { name, detail }) => self.tell_unkept(name, detail),
            }
            page::pause(AGAIN_MS).await;
        };
        let lost = self.forget_copies().await;
        self.persistence.keeper.update_value(|keeper| {
            keeper.storage = Some(storage);
            keeper.anew = false;
            keeper.book = Rc::default();
            keeper.backlog.clear();
            keeper.stored.clear();
            keeper.photos.clear();
        });
        let Some(id) = self.open_id() else { return };
        if follows {
            // The window that has the project stores it again, too.
            page::pause(LOOKS_MS[1]).await;
            return self.read_again(&id).await;
        }
        self.say(true, Until::NextWork, move || match lost {
            0 => text::cleared_under_page().to_owned(),
            _ => text::cleared_with_photos(lost),
        });
        self.persistence.kept.set(Kept::Writing);
        self.keep_now();
        for wait in LOOKS_MS {
            page::after(wait, move || spawn_local(self.look_again()));
        }
    }

    /// Ends the worker, and what was under way with it; false if that is being done already.
    async fn end_storage(self) -> bool {
        let begun = self.persistence.keeper.try_update_value(|keeper| !std::mem::replace(&mut keeper.anew, true));
        if begun != Some(true) {
            return false;
        }
        if let Some(storage) = self.persistence.keeper.try_update_value(|keeper| keeper.storage.take()).flatten() {
            storage.end();
        }
        if !self.follows() {
            self.persistence.kept.set(Kept::Writing);
        }
        while self.persistence.keeper.with_value(|keeper| keeper.copying || keeper.sending) {
            page::pause(20).await;
        }
        true
    }

    /// The worker has ended by itself (out of memory, for instance): another goes on where it stopped.
    pub(super) async fn replace_storage(self) {
        if !self.end_storage().await {
            return;
        }
        let storage = loop {
            let fault = match self.started_anew(None).await {
                Ok(Some(storage)) => match self.adopted(&storage).await {
                    Ok(()) => break storage,
                    Err(fault) => {
                        storage.end();
                        fault
                    }
                },
                Ok(None) => Fault { name: LOST.into(), detail: text::storage_ended().into() },
                Err(fault) => fault,
            };
            self.tell_unkept(fault.name, fault.detail);
            page::pause(AGAIN_MS).await;
        };
        self.persistence.keeper.update_value(|keeper| {
            keeper.storage = Some(storage);
            keeper.anew = false;
        });
        self.read_shelf();
        if self.follows() {
            return self.yielded();
        }
        self.persistence.kept.set(Kept::At(page::clock()));
        self.keep_now();
    }

    /// Lets another worker open the open project. Data that the previous worker wrote without confirmation are not written again.
    async fn adopted(self, storage: &Storage) -> Result<(), Fault> {
        let Some(id) = self.open_id() else { return Ok(()) };
        let opened = match storage.call::<Opened>("open", &ProjectId { id: &id }, Vec::new()).await {
            Ok((opened, _)) => Some(opened),
            // Nothing of it was written yet.
            Err(Fault { name, .. }) if name == "NotFoundError" => None,
            Err(fault) => return Err(fault),
        };
        if opened.as_ref().is_some_and(|opened| opened.following) {
            self.persistence.kept.set(Kept::Following);
        }
        self.persistence.keeper.update_value(|keeper| {
            let whole = opened.filter(|opened| !opened.has_gap());
            match (&whole, keeper.backlog.front()) {
                (Some(opened), Some(first)) if first.is_last_of(opened) => {
                    keeper.backlog.pop_front();
                }
                (None, Some(first)) if first.snapshot => {}
                (None, _) => {
                    keeper.book = Rc::default();
                    keeper.backlog.clear();
                    keeper.stored.clear();
                }
                _ => {}
            }
        });
        Ok(())
    }

    /// A worker in the place of the one that was ended; nothing where it can keep nothing.
    async fn started_anew(self, after: Option<&'static str>) -> Result<Option<Storage>, Fault> {
        let Ok(storage) = self.storage_worker() else { return Ok(None) };
        match storage.call::<Started>("start", &Starting { after }, Vec::new()).await {
            Ok((Started { kind, .. }, _)) => Ok((kind != "none").then_some(storage)),
            Err(fault) => {
                storage.end();
                Err(fault)
            }
        }
    }

    /// Photos are taken from where they came; those that were only in the storage are gone. Gives their number.
    async fn forget_copies(self) -> usize {
        let mut files = self.photos.files.get_untracked();
        let mut lost = Vec::new();
        for (id, file) in &mut files {
            if let Some(original) = file.original.take() {
                file.content = original;
            }
            let readable = match file.content.part(0.0, 1.0) {
                Ok(start) => start.read().await.is_ok(),
                Err(_) => false,
            };
            if !readable {
                lost.push(id.clone());
            }
        }
        files.retain(|id, _| !lost.contains(id));
        self.photos.files.set(files);
        lost.len()
    }

    /// Whether what was stored again is there still: an unreachable window may have removed it.
    async fn look_again(self) {
        let Some((storage, id)) = self.storage().zip(self.open_id()) else { return };
        let checked = storage.call::<IgnoredAny>("check", &ProjectId { id: &id }, Vec::new()).await;
        if checked.is_err_and(|fault| fault.name == "GoneError") {
            self.keep_anew("noticed").await;
        }
    }
}
