//! A kept project as it is read from the storage: from a whole journal, or what can be rescued of a damaged one.

use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

use serde::de::IgnoredAny;
use sightline_protocol::from_text;

use super::calls::{Ids, Opened, PhotoKeys};
use super::journal::{Book, JournalState, KeptFile, Note, replay};
use crate::browser::file::Blob;
use crate::browser::picture::Picture;
use crate::browser::storage::{Extra, Fault, Storage};
use crate::document::Document;
use crate::document::history::History;

pub(super) fn data_fault(detail: String) -> Fault {
    Fault { name: "DataError".into(), detail }
}

pub(super) type Texts = HashMap<u64, String>;

pub(super) async fn read_parts(storage: &Storage, numbers: Vec<u64>, into: &mut Texts) -> Result<(), Fault> {
    let (_, texts) = storage.call::<IgnoredAny>("parts", &Ids { ids: &numbers }, Vec::new()).await?;
    into.extend(numbers.into_iter().zip(texts).filter_map(|(number, text)| Some((number, text.text()?))));
    Ok(())
}

pub(super) async fn read_document(
    storage: &Storage,
    book: &RefCell<Book>,
    state: &JournalState,
) -> Result<Document, Fault> {
    let mut texts = Texts::new();
    loop {
        let wanted = book.borrow().wanted(state, &texts).map_err(data_fault)?;
        if wanted.is_empty() {
            return book.borrow_mut().document(state, &texts).map_err(data_fault);
        }
        read_parts(storage, wanted, &mut texts).await?;
    }
}

pub(super) type ReadFile = (KeptFile, Option<Blob>, Option<Picture>);

/// A project read from its journal.
pub(super) struct ReadProject {
    pub(super) document: Document,
    pub(super) history: History,
    pub(super) book: Rc<RefCell<Book>>,
    /// States of the history that are still in the storage, by their serials.
    pub(super) stored: HashMap<u64, JournalState>,
    pub(super) files: BTreeMap<String, ReadFile>,
    /// Newer states that could not be read.
    pub(super) lost: usize,
}

impl ReadProject {
    /// Out of a whole journal.
    pub(super) async fn whole(storage: &Storage, opened: &Opened) -> Result<Self, Fault> {
        let mut replayed = replay(&opened.notes).map_err(data_fault)?;
        let state = replayed.present.clone().ok_or_else(|| data_fault("no state".into()))?;
        let changes =
            |stack: &[(crate::document::Change, JournalState)]| stack.iter().map(|(c, _)| c.clone()).collect();
        let history = History::stored(changes(&replayed.past), changes(&replayed.future));
        let book = Rc::new(RefCell::new(Book::of(&replayed, &history, opened.next_part)));
        let mut document = read_document(storage, &book, &state).await?;
        book.borrow_mut().go_on_from(&document);
        let files = read_files(storage, &book, replayed.files).await?;
        if let Some(name) = replayed.name.take() {
            super::saving::rename(&mut document, name);
        }
        let entries = history.past.iter().chain(&history.future).map(|entry| entry.serial);
        let states = replayed.past.into_iter().chain(replayed.future).map(|(_, state)| state);
        let stored = entries.zip(states).collect();
        Ok(Self { document, history, book, stored, files, lost: 0 })
    }
}

/// Out of a journal in which something is lost: the newest state of which every part can be read, in a book that has nothing written yet. What
/// could be undone was counted from what is lost, and is not taken.
pub(super) async fn rescued(storage: &Storage, opened: &Opened) -> Result<ReadProject, Fault> {
    let notes = opened.notes.iter().map(|note| from_text::<Note>(note)).collect::<Result<Vec<_>, _>>();
    let notes = notes.map_err(data_fault)?;
    let numbers = notes.iter().rev().filter_map(|note| note.files);
    let mut files = BTreeMap::new();
    for number in numbers {
        if let Ok(read) = read_files(storage, &RefCell::default(), Some(number)).await {
            files = read;
            break;
        }
    }
    for (lost, state) in notes.iter().rev().filter_map(|note| note.present.as_ref()).enumerate() {
        if let Ok(document) = read_document(storage, &RefCell::default(), state).await {
            return Ok(ReadProject {
                document,
                history: History::default(),
                book: Rc::default(),
                stored: HashMap::new(),
                files,
                lost,
            });
        }
    }
    Err(data_fault("no state can be read".into()))
}

pub(super) async fn read_files(
    storage: &Storage,
    book: &RefCell<Book>,
    number: Option<u64>,
) -> Result<BTreeMap<String, ReadFile>, Fault> {
    let Some(number) = number else { return Ok(BTreeMap::new()) };
    let mut texts = Texts::new();
    read_parts(storage, vec![number], &mut texts).await?;
    let text = texts.remove(&number).unwrap_or_default();
    let files = book.borrow_mut().files(number, &text).map_err(data_fault)?;
    let keys = files.values().map(|file| file.key.clone()).collect::<Vec<_>>();
    let (_, blobs) = storage.call::<IgnoredAny>("photos", &PhotoKeys { keys: &keys }, Vec::new()).await?;
    let mut blobs = blobs.into_iter();
    let mut all = BTreeMap::new();
    for (photo, file) in files {
        let (content, small) = (blobs.next().and_then(Extra::blob), blobs.next().and_then(Extra::blob));
        let small = match small {
            Some(small) => Picture::from_blob(&small).await.ok(),
            None => None,
        };
        all.insert(photo, (file, content, small));
    }
    Ok(all)
}
