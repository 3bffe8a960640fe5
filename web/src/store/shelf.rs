//! The projects on this computer: list, open, rename, copy, download, delete with undo.

use std::rc::Rc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use sightline::project::Project;
use sightline_protocol::from_text;

use super::calls::{Card, CardOutcome, Plain, ProjectId};
use super::journal::{Head, OF_PROJECTS};
use super::{Asking, Desk, Step, Until};
use crate::browser::file::download_kept_file;
use crate::browser::page;
use crate::browser::picture::Picture;
use crate::browser::storage::{Extra, Fault, LOST, Storage};
use crate::i18n::{Text, text};

/// How long a deleted project can be got back where it was deleted; after that it goes.
const REGRET_MS: i32 = 30_000;

/// A project in the list.
#[derive(Clone)]
pub struct Shelved {
    pub id: String,
    pub bytes: f64,
    pub card: Card,
    pub small: Option<Picture>,
    /// Whether nothing of its journal can be read.
    pub unreadable: bool,
    /// Whether a damaged journal of it can be downloaded.
    pub damaged: bool,
}

/// Signals of the list of projects.
#[derive(Clone, Copy, Default)]
pub struct Shelf {
    /// Projects in this browser's storage; `None` until they are read.
    pub projects: RwSignal<Option<Vec<Shelved>>, LocalStorage>,
    /// Deleted projects that can be restored.
    pub bin: RwSignal<Vec<Shelved>, LocalStorage>,
    /// Key and name of the project that was deleted last, while it can be restored where it was deleted.
    pub deleted: RwSignal<Option<(String, String)>>,
}

#[derive(Deserialize)]
pub(super) struct Listed {
    pub(super) id: String,
    bytes: f64,
    /// A text: one that cannot be read hides no other.
    card: Option<String>,
    pub(super) deleted: bool,
    aside: usize,
}

#[derive(Serialize)]
struct Peeking<'a> {
    id: &'a str,
    kind: &'a str,
}

#[derive(Deserialize)]
struct Peeked {
    /// A name that was given since from outside.
    name: Option<String>,
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
            let (listed, smalls) = match storage.call::<Vec<Listed>>("list", &Plain {}, Vec::new()).await {
                Ok(all) => all,
                // It is read again by the worker that takes this one's place.
                Err(Fault { name, .. }) if name == LOST => return,
                Err(Fault { name, detail }) => {
                    let detail = format!("{name}: {detail}");
                    return self.say(true, Until::NextWork, move || text::list_unreadable(&detail));
                }
            };
            let (mut all, mut deleted) = (Vec::new(), Vec::new());
            for (one, small) in listed.into_iter().zip(smalls) {
                let small = match small.blob() {
                    Some(blob) => Picture::from_blob(&blob).await.ok(),
                    None => None,
                };
                let read = one.card.as_deref().and_then(|card| from_text::<Card>(card).ok());
                let (card, unreadable) = match read {
                    Some(card) => (card, false),
                    None => match card_of_journal(&storage, &one.id).await {
                        Ok(card) => (card, false),
                        // Another window has let go of it since the list was made.
                        Err(name) if name == "NotFoundError" && one.card.is_none() => continue,
                        Err(_) => (no_card(), true),
                    },
                };
                let Listed { id, bytes, aside, .. } = one;
                let damaged = unreadable || aside > 0;
                let list = if one.deleted { &mut deleted } else { &mut all };
                list.push(Shelved { id, bytes, card, small, unreadable, damaged });
            }
            let known = page::preference("projects").and_then(|n| n.parse::<usize>().ok()).unwrap_or(0);
            // Not an empty list, which deleting leaves too: a storage in which not even the last visit has left anything.
            if self.persistence.keeper.try_update_value(|keeper| std::mem::take(&mut keeper.fresh)) == Some(true)
                && known > 0
            {
                self.say(true, Until::NextWork, move || text::storage_cleared(known));
            }
            page::set_preference("projects", &all.len().to_string());
            self.shelf.bin.set(deleted);
            self.shelf.projects.set(Some(all));
        });
    }

    /// Says why something could not be done with a project of the list.
    fn say_refused(self, fault: Fault) {
        self.say(true, Until::NextWork, move || match fault.name.as_str() {
            "OpenElsewhereError" => text::held_elsewhere().to_owned(),
            "DamagedError" => text::journal_to_be_opened().to_owned(),
            "NotFoundError" => text::gone_for_good().to_owned(),
            "QuotaExceededError" => text::storage_full().to_owned(),
            _ => text::kept_unreadable(format!("{}: {}", fault.name, fault.detail)),
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
            if let Err(fault) = call(&storage, "rename", &Renaming { id: &id, name: &name }).await {
                self.say_refused(fault);
            }
            self.read_shelf();
        });
    }

    pub fn duplicate_kept(self, id: &str, name: &str) {
        let (id, name) = (id.to_owned(), text::copy_of(name));
        let Some(storage) = self.storage() else { return };
        spawn_local(async move {
            let copying = Copying { id: &id, copy: page::unique_name(), name, changed: page::now() };
            if let Err(fault) = call(&storage, "duplicate", &copying).await {
                self.say_refused(fault);
            }
            self.read_shelf();
        });
    }

    /// Opens a project and hands its file over, photos and all.
    pub fn download_kept(self, id: &str, step: Step) {
        if self.open_id().as_deref() == Some(id) {
            return self.save(true);
        }
        self.open_kept_then(id.to_owned(), step, |desk| desk.save(true));
    }

    /// Takes a project out of the list; for a while it can be got back. What is open in another window stays.
    pub fn delete_kept(self, id: &str, name: &str) {
        let (id, name) = (Rc::<str>::from(id), name.to_owned());
        let Some(storage) = self.storage() else { return };
        spawn_local(async move {
            let open = self.open_id().as_deref() == Some(&*id);
            if open {
                // What was done last belongs to it, should it be got back.
                self.flushed().await;
            }
            match call(&storage, "remove", &Deleting { id: &id, deleted: Some(page::now()) }).await {
                Ok(()) => {
                    if open && self.open_id().as_deref() == Some(&*id) {
                        self.put_away();
                        let _ = call(&storage, "close", &Plain {}).await;
                    }
                    self.shelf.deleted.set(Some((id.to_string(), name)));
                    page::after(REGRET_MS, move || self.purge(id));
                }
                Err(fault) => self.say_refused(fault),
            }
            self.read_shelf();
        });
    }

    /// It was not restored meanwhile: its storage is released.
    fn purge(self, id: Rc<str>) {
        if self.shelf.deleted.with_untracked(|d| d.as_ref().is_some_and(|(deleted, _)| **deleted == *id)) {
            self.shelf.deleted.set(None);
        }
        let Some(storage) = self.storage() else { return };
        spawn_local(async move {
            let _ = call(&storage, "purge", &ProjectId { id: &id }).await;
            self.read_shelf();
            self.copy_again();
        });
    }

    /// Puts the project that was deleted last back into the list.
    pub fn restore_deleted(self) {
        let Some((id, _)) = self.shelf.deleted.get_untracked() else { return };
        self.restore_kept(&id);
    }

    /// Puts a deleted project back into the list.
    pub fn restore_kept(self, id: &str) {
        let id = id.to_owned();
        self.shelf.deleted.update(|deleted| {
            deleted.take_if(|(deleted, _)| *deleted == id);
        });
        let Some(storage) = self.storage() else { return };
        spawn_local(async move {
            if let Err(fault) = call(&storage, "remove", &Deleting { id: &id, deleted: None }).await {
                self.say_refused(fault);
            }
            self.read_shelf();
        });
    }

    /// Asks, and then deletes everything that this page keeps in the browser: projects, equipment, preferences, and itself.
    pub fn wipe(self) {
        let wipe = move || {
            spawn_local(async move {
                if let Some(storage) = self.storage() {
                    self.flushed().await;
                    if let Err(fault) = call(&storage, "wipe", &Plain {}).await {
                        return self.say_refused(fault);
                    }
                    self.persistence.keeper.update_value(|keeper| keeper.storage = None);
                    storage.end();
                }
                page::forget_everything().await;
                // Nothing is left that could be lost by leaving.
                self.put_away();
                page::reload();
            });
        };
        let choices = vec![(text::wipe_now as Text, Rc::new(wipe) as Rc<dyn Fn()>)];
        self.messages.asking.set(Some(Asking { text: Rc::new(|| text::wipe_question().to_owned()), choices }));
    }

    /// Hands over the damaged journals of a project, as they were.
    pub fn download_damaged(self, id: &str, name: &str) {
        let (id, name) = (id.to_owned(), name.to_owned());
        let Some(storage) = self.storage() else { return };
        spawn_local(async move {
            match storage.call::<IgnoredAny>("aside", &ProjectId { id: &id }, Vec::new()).await {
                Ok((_, journals)) => {
                    for (i, journal) in journals.into_iter().filter_map(Extra::blob).enumerate() {
                        let name = if name.is_empty() { "sightline" } else { &name };
                        let name = format!("{name} {}.journal", i + 1);
                        if let Err(detail) = download_kept_file(&name, &journal) {
                            self.say(true, Until::NextWork, move || text::kept_unreadable(&detail));
                        }
                    }
                }
                Err(fault) => self.say_refused(fault),
            }
        });
    }
}

/// Entry in the list for a project without a readable card: from its journal, or the error of the journal.
async fn card_of_journal(storage: &Storage, id: &str) -> Result<Card, String> {
    let peek = async |kind: &str| storage.call::<Peeked>("peek", &Peeking { id, kind }, Vec::new()).await;
    let peeked = match peek(OF_PROJECTS).await {
        // A journal of before tables were parts of their own.
        Err(fault) if fault.name == "DamagedError" => peek("project").await,
        peeked => peeked,
    };
    let (peeked, texts) = peeked.map_err(|fault| fault.name)?;
    let words = texts.into_iter().next().and_then(|extra| extra.text()).ok_or("DataError")?;
    let (project, [photos, points, _]) = match Head::read(&words) {
        Some(head) => head.map(|head| (head.project, head.rows)),
        None => from_text::<Project>(&words).map(|project| {
            let rows = [project.photos.len(), project.points.len(), project.observations.len()];
            (project, rows)
        }),
    }
    .map_err(|_| "DataError")?;
    Ok(Card { name: peeked.name.unwrap_or(project.name), photos, points, ..no_card() })
}

fn no_card() -> Card {
    Card {
        name: String::new(),
        changed: 0.0,
        photos: 0,
        points: 0,
        outcome: CardOutcome::None,
        sigma0: None,
        estimated: None,
        step: Step::Photos.name().to_owned(),
    }
}

async fn call(storage: &Storage, name: &str, arguments: &impl Serialize) -> Result<(), Fault> {
    storage.call::<IgnoredAny>(name, arguments, Vec::<Extra>::new()).await.map(|_| ())
}
