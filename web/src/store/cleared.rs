//! Storage that the browser cleared under the open page: another worker takes the place of the one that has files of it open, and what
//! is here is written again.

use std::rc::Rc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use serde::de::IgnoredAny;

use super::keeping::{Kept, Of, Started, Starting};
use super::{Desk, Until};
use crate::browser::page;
use crate::browser::storage::{Fault, Storage};
use crate::i18n::text;

/// When it is looked whether what was stored again is there still, in milliseconds one after the other.
const LOOKS_MS: [i32; 3] = [500, 3000, 10_000];
/// Until it is tried again where another window holds on to files of the cleared storage.
const AGAIN_MS: i32 = 5000;

impl Desk {
    /// Writes everything again, photos from where they came. `after` as in [`Starting`].
    pub(super) async fn keep_anew(self, after: &'static str) {
        let begun = self.keeper.try_update_value(|keeper| !std::mem::replace(&mut keeper.anew, true));
        if begun != Some(true) {
            return;
        }
        let follows = self.follows();
        if let Some(storage) = self.keeper.try_update_value(|keeper| keeper.storage.take()).flatten() {
            storage.end();
        }
        if !follows {
            self.kept.set(Kept::Writing);
        }
        // What was under way with the worker that is gone ends first.
        while self.keeper.with_value(|keeper| keeper.copying || keeper.sending) {
            page::pause(20).await;
        }
        let storage = loop {
            match self.started_anew(after).await {
                Ok(Some(storage)) => break storage,
                Ok(None) => {
                    self.keeper.update_value(|keeper| keeper.anew = false);
                    return self.kept.set(Kept::Nowhere);
                }
                Err(Fault { name, detail }) => self.tell_unkept(name, detail),
            }
            page::pause(AGAIN_MS).await;
        };
        let lost = self.forget_copies().await;
        self.keeper.update_value(|keeper| {
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
        self.kept.set(Kept::Writing);
        self.keep_now();
        for wait in LOOKS_MS {
            page::after(wait, move || spawn_local(self.look_again()));
        }
    }

    /// A worker in the place of the one that was ended; nothing where it can keep nothing.
    async fn started_anew(self, after: &'static str) -> Result<Option<Storage>, Fault> {
        let Ok(storage) = self.storage_worker() else { return Ok(None) };
        match storage.call::<Started>("start", &Starting { after: Some(after) }, Vec::new()).await {
            Ok((Started { kind }, _)) => Ok((kind != "none").then_some(storage)),
            Err(fault) => {
                storage.end();
                Err(fault)
            }
        }
    }

    /// Photos are taken from where they came; those that were only in the storage are gone. Gives their number.
    async fn forget_copies(self) -> usize {
        let mut files = self.files.get_untracked();
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
        self.files.set(files);
        lost.len()
    }

    /// Whether what was stored again is there still: a window that nobody could reach may have taken it away.
    async fn look_again(self) {
        let Some((storage, id)) = self.storage().zip(self.open_id()) else { return };
        let checked = storage.call::<IgnoredAny>("check", &Of { id: &id }, Vec::new()).await;
        if checked.is_err_and(|fault| fault.name == "GoneError") {
            self.keep_anew("noticed").await;
        }
    }
}
