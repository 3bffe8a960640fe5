//! A journal that has grown is written anew with what is still needed: the present state, and of the history what has room. A long
//! session does not fill the disk, and what one can undo is forgotten from the oldest on, only in the storage.

use std::collections::{HashMap, HashSet};

use leptos::prelude::*;
use leptos::task::spawn_local;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use sightline_protocol::to_text;

use super::Desk;
use super::calls::{Ids, ProjectId};
use super::journal::{JournalState, Note, Replayed, StackChange, named_in, names_others, replay};
use crate::browser::page;
use crate::browser::storage::{Fault, Storage};

/// A journal of so many bytes is worth being condensed, and then one that is so many times as large as after the last time.
const LEAST: f64 = 8e6;
const GROWTH: f64 = 3.0;
/// Characters of the history's parts that are kept beside those of the present state.
const HISTORY: u64 = 64 << 20;
/// The page is left alone for so long before its journal is condensed.
const CALM_MS: i32 = 2000;

/// A part as the journal has it: its number, its kind, and how many characters it takes there.
pub type Written = (u64, String, u64);

/// Contents of a condensed journal.
#[derive(Debug)]
pub struct Condensed {
    pub note: Note,
    pub ids: HashSet<u64>,
}

#[derive(Deserialize)]
struct Surveyed {
    notes: Vec<String>,
    parts: Vec<Written>,
}

#[derive(Serialize)]
struct Condensing<'a> {
    id: &'a str,
    note: String,
    ids: Vec<u64>,
}

#[derive(Deserialize)]
struct Size {
    size: f64,
}

/// The parts whose texts refer to other parts.
fn naming(parts: &[Written]) -> Vec<u64> {
    parts.iter().filter(|(_, kind, _)| names_others(kind)).map(|(number, ..)| *number).collect()
}

/// Contents kept of a journal: `texts` are those of the parts that name others, `room` is for the history.
///
/// # Errors
/// A part that cannot be read.
pub fn condensed(
    all: Replayed,
    parts: &[Written],
    texts: &HashMap<u64, String>,
    room: u64,
) -> Result<Condensed, String> {
    let written = parts.iter().map(|(number, kind, size)| (*number, (kind.as_str(), *size))).collect::<HashMap<_, _>>();
    let mut ids = HashSet::new();
    // The parts of a state that are not among these, with all that they name.
    let of = |state: &JournalState, ids: &HashSet<u64>| -> Result<HashSet<u64>, String> {
        let mut new = HashSet::new();
        let mut open = vec![state.project, state.detections, state.doubtful];
        open.extend(state.result);
        while let Some(number) = open.pop() {
            // What is kept has all that it names with it.
            if ids.contains(&number) || !new.insert(number) {
                continue;
            }
            let missing = || format!("part {number} is missing");
            let (kind, _) = written.get(&number).ok_or_else(missing)?;
            if names_others(kind) {
                open.extend(named_in(kind, texts.get(&number).ok_or_else(missing)?)?);
            }
        }
        Ok(new)
    };
    let present = all.present.ok_or("no state")?;
    ids.extend(of(&present, &ids)?);
    ids.extend(all.files);
    // From what is undone or done again next to what is farthest.
    let mut kept = [0, 0];
    let mut spent = 0;
    let (mut past, mut future) = (all.past.iter().rev(), all.future.iter().rev());
    'room: loop {
        let next = [past.next(), future.next()];
        if next == [None, None] {
            break;
        }
        for (side, entry) in next.into_iter().enumerate() {
            let Some((_, state)) = entry else { continue };
            let new = of(state, &ids)?;
            spent += new.iter().filter_map(|number| written.get(number)).map(|(_, size)| size).sum::<u64>();
            if spent > room {
                break 'room;
            }
            ids.extend(new);
            kept[side] += 1;
        }
    }
    let stack = |entries: Vec<_>, below: usize, kept: usize| {
        let dropped = entries.len() - kept;
        StackChange { keep: 0, forgotten: below + dropped, add: entries.into_iter().skip(dropped).collect() }
    };
    let [below_past, below_future] = all.forgotten;
    let note = Note {
        name: all.name,
        past: Some(stack(all.past, below_past, kept[0])),
        future: Some(stack(all.future, below_future, kept[1])),
        present: Some(present),
        files: all.files,
    };
    Ok(Condensed { note, ids })
}

impl Desk {
    /// Condenses the journal when it has grown enough, as soon as no task is running.
    pub(super) fn watch_size(self, size: f64) {
        let due = self.persistence.keeper.try_update_value(|keeper| {
            let due = !keeper.condensing && size > LEAST.max(GROWTH * keeper.condensed);
            keeper.condensing |= due;
            due
        });
        if due == Some(true) {
            self.condense_when_calm();
        }
    }

    fn condense_when_calm(self) {
        let written = self.persistence.keeper.with_value(|keeper| keeper.written);
        page::after(CALM_MS, move || {
            if self.persistence.keeper.with_value(|keeper| keeper.written) != written || self.unwritten() {
                return self.condense_when_calm();
            }
            spawn_local(async move {
                let size = self.condense().await;
                self.persistence.keeper.update_value(|keeper| {
                    keeper.condensing = false;
                    // What could not be condensed is not tried at every edit.
                    keeper.condensed = size.unwrap_or(2.0 * keeper.condensed.max(LEAST));
                });
                self.measure_space();
            });
        });
    }

    /// Condenses the journal of the project that is open; its size.
    async fn condense(self) -> Result<f64, Fault> {
        let unfit = |detail: String| Fault { name: "DataError".into(), detail };
        let (storage, id) = self.storage().zip(self.open_id()).ok_or_else(|| unfit("nothing is open".into()))?;
        let written = self.persistence.keeper.with_value(|keeper| keeper.written);
        let surveyed = survey(&storage, &id).await;
        let condensing = surveyed.and_then(|(Surveyed { notes, parts }, texts)| {
            let same = self
                .persistence
                .keeper
                .with_value(|keeper| keeper.written == written && keeper.id.as_deref() == Some(&id));
            if !same || self.unwritten() || self.follows() {
                return Err(unfit("it has changed meanwhile".into()));
            }
            let Condensed { note, ids } =
                replay(&notes).and_then(|all| condensed(all, &parts, &texts, HISTORY)).map_err(unfit)?;
            // Before anything else is written: what the journal will lack is written again when it is needed.
            let condensing = Condensing { id: &id, note: to_text(&note), ids: ids.iter().copied().collect() };
            self.persistence.keeper.with_value(|keeper| keeper.book.borrow_mut().condensed(ids));
            Ok(condensing)
        });
        match condensing {
            Ok(condensing) => Ok(storage.call::<Size>("condense", &condensing, Vec::new()).await?.0.size),
            Err(fault) => {
                let _ = storage.call::<IgnoredAny>("leave", &ProjectId { id: &id }, Vec::new()).await;
                Err(fault)
            }
        }
    }
}

/// What a journal has, with the texts of those parts that name others.
async fn survey(storage: &Storage, id: &str) -> Result<(Surveyed, HashMap<u64, String>), Fault> {
    let (surveyed, _) = storage.call::<Surveyed>("survey", &ProjectId { id }, Vec::new()).await?;
    let ids = naming(&surveyed.parts);
    let (_, texts) = storage.call::<IgnoredAny>("surveyed", &Ids { ids: &ids }, Vec::new()).await?;
    let texts = ids.into_iter().zip(texts).filter_map(|(number, text)| Some((number, text.text()?))).collect();
    Ok((surveyed, texts))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::super::journal::Book;
    use super::super::journal::tests::{Journal, renamed};
    use super::*;
    use crate::document::history::{History, HistoryEntry, documents};
    use crate::document::{Change, Document};

    /// Condenses a journal as the storage does.
    fn condense(journal: &mut Journal, book: &mut Book, room: u64) {
        let size = |number: &u64| journal.texts[number].len() as u64;
        let parts = journal.kinds.iter().map(|(number, kind)| (*number, kind.clone(), size(number)));
        let parts = parts.collect::<Vec<_>>();
        let replayed = replay(&journal.notes).unwrap();
        let Condensed { note, ids } = condensed(replayed, &parts, &journal.texts, room).unwrap();
        journal.notes = vec![to_text(&note)];
        journal.texts.retain(|number, _| ids.contains(number));
        journal.kinds.retain(|number, _| ids.contains(number));
        book.condensed(ids);
    }

    fn names(entries: &[HistoryEntry]) -> Vec<String> {
        documents(entries, 0).into_iter().flatten().map(|document| document.project.name.clone()).collect()
    }

    #[test]
    fn a_condensed_journal_has_the_present_and_the_end_of_the_history_whatever_follows() {
        for seed in 1_u64..40 {
            let mut state = seed;
            let mut random = |n: u64| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (state >> 33) % n
            };
            let (mut book, mut journal, mut history) = (Book::default(), Journal::default(), History::default());
            let files = BTreeMap::new();
            let mut document = renamed(&Document::default(), "0");
            journal.add(book.note(&document, &history, &files));
            for step in 1..200 {
                match random(10) {
                    0..2 => document = history.undo(document.clone()).unwrap_or(document),
                    2 => document = history.redo(document.clone()).unwrap_or(document),
                    3 => document = renamed(&document, &format!("{step} outside the history")),
                    4 => {
                        let room = random(4) * 2000;
                        condense(&mut journal, &mut book, room);
                    }
                    5 => {
                        // The page is opened again.
                        let (read, past, new) = journal.read();
                        (document, history, book) = (read, past, new);
                        book.files(u64::MAX, "{}").unwrap();
                    }
                    _ => {
                        history.push(Change::UnitSet, document.clone());
                        document = renamed(&document, &step.to_string());
                    }
                }
                journal.add(book.note(&document, &history, &files));
                let (read, stored, _) = journal.read();
                assert_eq!(read.project.name, document.project.name, "seed {seed}, step {step}");
                let [past, future] = [names(&stored.past), names(&stored.future)];
                assert!(names(&history.past).ends_with(&past), "seed {seed}, step {step}: {past:?}");
                assert!(names(&history.future).ends_with(&future), "seed {seed}, step {step}: {future:?}");
            }
        }
    }

    #[test]
    fn with_room_for_all_nothing_is_forgotten_and_what_nobody_needs_goes() {
        let (mut book, mut journal, mut history) = (Book::default(), Journal::default(), History::default());
        let files = BTreeMap::new();
        let mut document = renamed(&Document::default(), "0");
        for step in 1..20 {
            history.push(Change::UnitSet, document.clone());
            document = renamed(&document, &step.to_string());
            journal.add(book.note(&document, &history, &files));
            // A name outside the history: the state before it is not needed.
            document = renamed(&document, &format!("{step} renamed"));
            journal.add(book.note(&document, &history, &files));
        }
        let before = journal.texts.len();
        condense(&mut journal, &mut book, u64::MAX);
        let (read, stored, _) = journal.read();
        assert_eq!(read.project.name, document.project.name);
        assert_eq!(names(&stored.past), names(&history.past));
        assert_eq!(before - journal.texts.len(), 19);
        condense(&mut journal, &mut book, 0);
        assert_eq!(journal.read().1.past.len(), 0);
        // A state is a project, its three tables, two of targets, and the files.
        assert!(journal.texts.len() <= 7);
    }
}
