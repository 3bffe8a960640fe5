//! Copies of the photos in the browser's storage: photos that did not fit are reported as long as that is so.

use std::collections::HashMap;

use leptos::prelude::*;
use leptos::task::spawn_local;
use serde::de::IgnoredAny;

use super::calls::{Copied, PhotoKeys};
use super::persistence::uncopied_words;
use super::{Desk, PhotoFile, Until};
use crate::browser::file::Blob;
use crate::browser::page;
use crate::browser::storage::{Extra, Fault, LOST};

/// Time, in milliseconds, after which photos that found no room are tried again.
const AGAIN_MS: f64 = 60_000.0;

impl Desk {
    /// Copies photos that are not kept yet, one after the other; then works on the copies, which cannot be unplugged like a card. What was
    /// done comes first: a photo must not take the room that it needs.
    pub(super) fn copy_photos(self) {
        let Some(storage) = self.storage() else { return };
        if self.unwritten()
            || self.persistence.keeper.with_value(|keeper| keeper.copying)
            || self.next_to_copy().is_none()
        {
            return;
        }
        self.persistence.keeper.update_value(|keeper| keeper.copying = true);
        spawn_local(async move {
            let (mut kept, mut missed) = (Vec::new(), Vec::new());
            while self.flushed().await {
                let Some((key, file)) = self.next_to_copy() else { break };
                self.persistence.to_copy.set(self.left_to_copy());
                let extras = vec![Extra::Blob(file.content.clone()), Extra::Picture(file.small.clone())];
                let asked = PhotoKeys { keys: std::slice::from_ref(&key) };
                let failure = match storage.call::<Copied>("keep", &asked, extras).await {
                    Ok((Copied { missed, failure }, _)) => (!missed.is_empty()).then(|| failure.unwrap_or_default()),
                    // Its place is taken by another worker, which copies all of them.
                    Err(fault) if fault.name == LOST => break,
                    Err(fault) => Some(fault),
                };
                self.persistence.keeper.update_value(|keeper| {
                    keeper.photos.insert(key.clone());
                });
                match failure {
                    Some(why) => missed.push((key, why)),
                    None => kept.push(key),
                }
            }
            self.persistence.to_copy.set(0);
            self.persistence.keeper.update_value(|keeper| keeper.copying = false);
            if let Ok((_, copies)) = storage.call::<IgnoredAny>("photos", &PhotoKeys { keys: &kept }, Vec::new()).await
            {
                let copies = copies.into_iter().step_by(2).map(Extra::blob);
                let copies = kept.iter().cloned().zip(copies).filter_map(|(key, blob)| Some((key, blob?)));
                let copies = copies.collect::<HashMap<String, Blob>>();
                self.photos.files.update(|files| {
                    for file in files.values_mut() {
                        if let Some(copy) = copies.get(&file.key()) {
                            let before = std::mem::replace(&mut file.content, copy.clone());
                            file.original = Some(before).filter(Blob::is_own_file).or(file.original.take());
                        }
                    }
                });
            }
            let told = missed
                .iter()
                .all(|(key, _)| self.persistence.uncopied.with_untracked(|uncopied| uncopied.contains_key(key)));
            self.persistence.keeper.update_value(|keeper| keeper.missed_at = page::now());
            self.persistence.uncopied.update(|uncopied| {
                uncopied.retain(|key, _| !kept.contains(key));
                uncopied.extend(missed.iter().cloned());
            });
            if let Some((_, why)) = missed.first().cloned().filter(|_| !told) {
                self.say(true, Until::NextWork, move || uncopied_words(missed.len(), &why));
            }
            self.measure_space();
        });
    }

    /// Tries again with photos that found no room: the free space that browsers report is not reliable.
    pub(super) fn copy_again(self) {
        self.forget_missed();
        self.copy_photos();
    }

    fn forget_missed(self) {
        self.persistence.uncopied.with_untracked(|missed| {
            self.persistence.keeper.update_value(|keeper| keeper.photos.retain(|key| !missed.contains_key(key)));
        });
    }

    /// Something was written: after a while, or where it could not be before, there may be room for photos.
    pub(super) fn copy_after_writing(self, room_came: bool) {
        let waited = self.persistence.keeper.with_value(|keeper| page::now() - keeper.missed_at > AGAIN_MS);
        if room_came || waited {
            self.forget_missed();
        }
        self.copy_photos();
    }

    /// How many photos of the project are in this page alone, and why.
    pub fn not_copied(self) -> Option<(usize, Fault)> {
        let uncopied = self.persistence.uncopied.get();
        let missed = self
            .photos
            .files
            .with(|files| files.values().filter_map(|file| uncopied.get(&file.key()).cloned()).collect::<Vec<_>>());
        Some((missed.len(), missed.first()?.clone()))
    }

    fn next_to_copy(self) -> Option<(String, PhotoFile)> {
        self.photos.files.with_untracked(|files| {
            self.persistence.keeper.with_value(|keeper| {
                let keyed = files.values().map(|file| (file.key(), file));
                keyed.into_iter().find(|(key, _)| !keeper.photos.contains(key)).map(|(key, file)| (key, file.clone()))
            })
        })
    }

    fn left_to_copy(self) -> usize {
        self.photos.files.with_untracked(|files| {
            self.persistence
                .keeper
                .with_value(|keeper| files.values().filter(|file| !keeper.photos.contains(&file.key())).count())
        })
    }
}
