//! The projects on this computer: listed, opened, renamed, copied, handed over, deleted with the way back.

use std::rc::Rc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use serde::de::{DeserializeOwned, IgnoredAny};
use serde::{Deserialize, Serialize};

use super::keeping::{Card, Of, Plain};
use super::{Desk, Until};
use crate::browser::page;
use crate::browser::picture::Picture;
use crate::browser::storage::Extra;
use crate::i18n::text;

/// How long a deleted project can be got back.
const REGRET_MS: i32 = 30_000;

/// A project in the list.
#[derive(Clone)]
pub struct Shelved {
    pub id: String,
    pub bytes: f64,
    pub card: Card,
    pub small: Option<Picture>,
}

#[derive(Deserialize)]
struct Listed {
    id: String,
    bytes: f64,
    #[serde(flatten)]
    card: Card,
}

#[derive(Serialize)]
struct Renaming<'a> {
    id: &'a str,
    name: &'a str,
}

#[derive(Serialize)]
struct Copying<'a> {
    id: &'a str,
    copy: String,
    name: String,
    changed: f64,
}

#[derive(Serialize)]
struct Deleting<'a> {
    id: &'a str,
    deleted: Option<f64>,
}

impl Desk {
    /// Reads the list of projects.
    pub fn read_shelf(self) {
        let Some(storage) = self.storage() else { return };
        self.measure_space();
        spawn_local(async move {
            let Ok((listed, smalls)) = storage.call::<Vec<Listed>>("list", &Plain {}, Vec::new()).await else { return };
            let mut all = Vec::new();
            for (Listed { id, bytes, card }, small) in listed.into_iter().zip(smalls) {
                let small = match small.blob() {
                    Some(blob) => Picture::from_blob(&blob).await.ok(),
                    None => None,
                };
                all.push(Shelved { id, bytes, card, small });
            }
            let known = page::preference("projects").and_then(|n| n.parse::<usize>().ok()).unwrap_or(0);
            if all.is_empty() && known > 0 {
                self.say(true, Until::NextWork, move || text::storage_cleared(known));
            }
            page::set_preference("projects", &all.len().to_string());
            self.shelf.set(Some(all));
        });
    }

    pub fn rename_kept(self, id: &str, name: &str) {
        let name = name.trim();
        if name.is_empty() {
            return self.read_shelf();
        }
        if self.open_id().as_deref() == Some(id) {
            self.rename_project(name);
            return page::after(300, move || self.read_shelf());
        }
        let (id, name) = (id.to_owned(), name.to_owned());
        let Some(storage) = self.storage() else { return };
        spawn_local(async move {
            if call::<IgnoredAny>(&storage, "rename", &Renaming { id: &id, name: &name }).await.is_err() {
                self.say(true, Until::NextWork, || text::held_elsewhere().to_owned());
            }
            self.read_shelf();
        });
    }

    pub fn duplicate_kept(self, id: &str, name: &str) {
        let (id, name) = (id.to_owned(), text::copy_of(name));
        let Some(storage) = self.storage() else { return };
        spawn_local(async move {
            let copying = Copying { id: &id, copy: page::unique_name(), name, changed: page::now() };
            if let Err(detail) = call::<IgnoredAny>(&storage, "duplicate", &copying).await {
                self.say(true, Until::NextWork, move || text::kept_unreadable(&detail));
            }
            self.read_shelf();
        });
    }

    /// Opens a project and hands its file over, photos and all.
    pub fn download_kept(self, id: &str, step: &str) {
        if self.open_id().as_deref() == Some(id) {
            return self.save(true);
        }
        self.open_kept_then(id.to_owned(), step.to_owned(), |desk| desk.save(true));
    }

    /// Takes a project out of the list; for a while it can be got back.
    pub fn delete_kept(self, id: &str, name: &str) {
        if self.open_id().as_deref() == Some(id) {
            self.put_away();
        }
        let (id, name) = (Rc::<str>::from(id), name.to_owned());
        let Some(storage) = self.storage() else { return };
        spawn_local(async move {
            let deleting = Deleting { id: &id, deleted: Some(page::now()) };
            if let Err(detail) = call::<IgnoredAny>(&storage, "remove", &deleting).await {
                self.say(true, Until::NextWork, move || text::kept_unreadable(&detail));
            } else {
                self.deleted.set(Some((id.to_string(), name)));
                page::after(REGRET_MS, move || self.purge(id));
            }
            self.read_shelf();
        });
    }

    /// Nobody has got it back meanwhile: its room is free again.
    fn purge(self, id: Rc<str>) {
        if self.deleted.with_untracked(|d| d.as_ref().is_some_and(|(deleted, _)| **deleted == *id)) {
            self.deleted.set(None);
        }
        let Some(storage) = self.storage() else { return };
        spawn_local(async move {
            let _ = call::<IgnoredAny>(&storage, "purge", &Of { id: &id }).await;
            self.measure_space();
            self.copy_again();
        });
    }

    /// Puts the project that was deleted last back into the list.
    pub fn restore_deleted(self) {
        let Some((id, _)) = self.deleted.get_untracked() else { return };
        self.deleted.set(None);
        let Some(storage) = self.storage() else { return };
        spawn_local(async move {
            let _ = call::<IgnoredAny>(&storage, "remove", &Deleting { id: &id, deleted: None }).await;
            self.read_shelf();
        });
    }
}

async fn call<A: DeserializeOwned>(
    storage: &crate::browser::storage::Storage,
    name: &str,
    arguments: &impl Serialize,
) -> Result<A, String> {
    match storage.call::<A>(name, arguments, Vec::<Extra>::new()).await {
        Ok((answer, _)) => Ok(answer),
        Err(fault) => Err(format!("{}: {}", fault.name, fault.detail)),
    }
}
