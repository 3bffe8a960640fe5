//! Journal of a project in the browser's storage: parts (numbered texts, each written once) and notes of what has changed in the
//! history and the present state. Replaying the notes in order restores both.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::{Arc, Weak};

use serde::{Deserialize, Serialize};
use sightline::adjustment::{AdjustOptions, AdjustedObservation, AdjustedPhoto, AdjustedPoint, Adjustment};
use sightline::detection::Detection;
use sightline::exif::PhotoInfo;
use sightline::matching::Doubtful;
use sightline::project::{Parameter, Project, RemovedFields};
use sightline_protocol::{from_text, to_text};

use crate::browser::storage::Piece;
use crate::document::history::{History, HistoryEntry, documents};
use crate::document::{AdjustmentResult, Change, Document};
use crate::edit::targets;

mod tables;

pub use tables::{Head, OF_PROJECTS};
use tables::{ProjectRole, Projects, Writing};

/// A state of the document by the numbers of its parts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JournalState {
    pub project: u64,
    /// Numbers of targets by photo are in this part.
    pub detections: u64,
    pub doubtful: u64,
    pub result: Option<u64>,
    pub options: AdjustOptions,
    pub sigmas_of_held: Vec<(String, Parameter, f64)>,
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// Change of a stack of the history: the number of entries that stay, and the new ones.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StackChange {
    pub keep: usize,
    /// At the bottom, before what is added: they count, and are not stored any more.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub forgotten: usize,
    pub add: Vec<(Change, JournalState)>,
}

/// Changes since the previous note.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Note {
    /// Another name, given from outside.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub past: Option<StackChange>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub future: Option<StackChange>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub present: Option<JournalState>,
    /// The part that has the photos' files.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub files: Option<u64>,
}

/// A photo's file, apart from what is in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KeptFile {
    /// By what is in it: it is kept once.
    pub key: String,
    pub name: String,
    pub size: [u32; 2],
    pub info: PhotoInfo,
    pub digest: u64,
}

/// The part of a result, as [`result_text`] writes it.
#[derive(Deserialize)]
struct KeptResult {
    input: u64,
    oriented: u64,
    adjustment: Adjustment,
    /// Rows of its tables, where the adjustment has none itself.
    #[serde(default)]
    rows: Vec<KeptRows>,
}

/// Some rows of one of the tables.
#[derive(Default, Deserialize)]
#[serde(default)]
struct KeptRows {
    photos: Vec<AdjustedPhoto>,
    points: Vec<AdjustedPoint>,
    observations: Vec<AdjustedObservation>,
}

impl KeptResult {
    fn adjustment(self) -> Adjustment {
        let mut adjustment = self.adjustment;
        for rows in self.rows {
            adjustment.photos.extend(rows.photos);
            adjustment.points.extend(rows.points);
            adjustment.observations.extend(rows.observations);
        }
        adjustment
    }
}

/// Text before the adjustment, which is long and comes last.
const ADJUSTMENT: &str = r#","adjustment":"#;

/// The text of an adjustment in pieces, as it comes from the engine: what is left of it without its tables, and rows of these.
pub type Pieces = Vec<(sightline_protocol::Piece, Piece)>;

/// The part of a result: its adjustment's pieces are not read for that.
fn result_text(input: u64, oriented: u64, adjustment: Pieces) -> Vec<Piece> {
    let mut text = vec![Piece::Text(format!(r#"{{"input":{input},"oriented":{oriented}{ADJUSTMENT}"#))];
    let mut separator = r#","rows":["#;
    for (piece, words) in adjustment {
        match piece {
            sightline_protocol::Piece::Frame => text.push(words),
            sightline_protocol::Piece::Rows(name) => {
                text.push(Piece::Text(format!(r#"{separator}{{"{name}":["#)));
                text.extend([words, Piece::Text("]}".into())]);
                separator = ",";
            }
        }
    }
    let rows = separator == ",";
    text.push(Piece::Text(if rows { "]}" } else { "}" }.into()));
    text
}

/// A text of one piece.
fn whole<T: Serialize>(part: &T) -> Vec<Piece> {
    vec![Piece::Text(to_text(part))]
}

/// The parts that one part names: those of photos in a part of detections, the projects in that of a result, the tables of a project, those that
/// a table is stored as a difference from.
pub fn named_in(kind: &str, text: &str) -> Result<Vec<u64>, String> {
    /// As [`KeptResult`], without reading what is computed.
    #[derive(Deserialize)]
    struct ResultHead {
        input: u64,
        oriented: u64,
    }
    Ok(match kind {
        DETECTIONS => from_text::<BTreeMap<String, u64>>(text)?.into_values().collect(),
        RESULT => {
            let head = text.split_once(ADJUSTMENT).and_then(|(head, _)| from_text(&format!("{head}}}")).ok());
            let ResultHead { input, oriented } = head.map_or_else(|| from_text(text), Ok)?;
            vec![input, oriented]
        }
        _ if tables::names_others(kind) => tables::named_in(kind, text)?,
        _ => Vec::new(),
    })
}

/// Whether parts of this kind name others, and small ones whose texts are read to know which.
pub fn names_others(kind: &str) -> bool {
    [DETECTIONS, RESULT].contains(&kind) || tables::names_others(kind)
}

const DETECTIONS: &str = "detections";
const RESULT: &str = "result";

/// Which of the parts that were written the journal has still.
#[derive(Default)]
pub struct InJournal {
    /// Numbers from here on were given since.
    from: u64,
    /// Of those before.
    kept: HashSet<u64>,
}

impl InJournal {
    fn has(&self, number: u64) -> bool {
        number >= self.from || self.kept.contains(&number)
    }
}

/// A new part of the journal.
pub struct JournalPart {
    pub number: u64,
    /// Parts of a kind are alike, and written as what changed since the last one.
    pub kind: String,
    pub text: Vec<Piece>,
}

/// Parts that are known by their place in memory, which stays theirs while they are watched.
struct Known<T> {
    numbers: HashMap<usize, (Weak<T>, u64)>,
    parts: HashMap<u64, Weak<T>>,
}

impl<T> Default for Known<T> {
    fn default() -> Self {
        Self { numbers: HashMap::new(), parts: HashMap::new() }
    }
}

impl<T> Known<T> {
    fn number(&self, part: &Arc<T>) -> Option<u64> {
        self.numbers.get(&(Arc::as_ptr(part) as usize)).map(|(_, number)| *number)
    }

    fn part(&self, number: u64) -> Option<Arc<T>> {
        self.parts.get(&number)?.upgrade()
    }

    fn learn(&mut self, part: &Arc<T>, number: u64) {
        if self.numbers.len() > 1000 && self.numbers.len().is_multiple_of(1000) {
            self.numbers.retain(|_, (part, _)| part.strong_count() > 0);
            self.parts.retain(|_, part| part.strong_count() > 0);
        }
        self.numbers.insert(Arc::as_ptr(part) as usize, (Arc::downgrade(part), number));
        self.parts.insert(number, Arc::downgrade(part));
    }
}

/// Everything that the journal of a project has, and what has to be added to it.
#[derive(Default)]
pub struct Book {
    next: u64,
    in_journal: InJournal,
    /// Entries at the bottom of both stacks that the journal had forgotten when it was read.
    forgotten: [usize; 2],
    projects: Projects,
    detections: Known<Detection>,
    maps: Known<BTreeMap<String, Arc<Detection>>>,
    doubtful: Known<Vec<Doubtful>>,
    results: Known<AdjustmentResult>,
    /// The pieces that a result's adjustment came in, until it is written.
    came: Option<(Weak<AdjustmentResult>, Pieces)>,
    past: Vec<u64>,
    future: Vec<u64>,
    present: Option<JournalState>,
    files: Option<(BTreeMap<String, KeptFile>, u64)>,
    new: Vec<JournalPart>,
}

fn number<T>(known: &mut Known<T>, next: &mut u64, journal: &InJournal, part: &Arc<T>) -> (u64, bool) {
    if let Some(number) = known.number(part).filter(|number| journal.has(*number)) {
        return (number, false);
    }
    let number = *next;
    *next += 1;
    known.learn(part, number);
    (number, true)
}

impl Book {
    /// Whether nothing has been written of the project yet.
    pub fn is_new(&self) -> bool {
        self.present.is_none()
    }

    fn project(&mut self, project: &Arc<Project>, of: ProjectRole) -> u64 {
        let writing = Writing { next: &mut self.next, journal: &self.in_journal, new: &mut self.new };
        self.projects.number(project, of, writing)
    }

    /// A result's adjustment came in these pieces: the next note has them as they are.
    pub fn came(&mut self, result: &Arc<AdjustmentResult>, pieces: Pieces) {
        self.came = Some((Arc::downgrade(result), pieces));
    }

    fn state(&mut self, document: &Document) -> JournalState {
        let project = self.project(&document.project, ProjectRole::Work);
        let (detections, new) = number(&mut self.maps, &mut self.next, &self.in_journal, &document.detections);
        if new {
            let mut numbers = BTreeMap::new();
            for (photo, found) in &*document.detections {
                let (number, new) = number(&mut self.detections, &mut self.next, &self.in_journal, found);
                if new {
                    let (kind, text) = (format!("targets {photo}"), whole(&**found));
                    self.new.push(JournalPart { number, kind, text });
                }
                numbers.insert(photo, number);
            }
            self.new.push(JournalPart { number: detections, kind: DETECTIONS.into(), text: whole(&numbers) });
        }
        let (doubtful, new) = number(&mut self.doubtful, &mut self.next, &self.in_journal, &document.doubtful);
        if new {
            self.new.push(JournalPart { number: doubtful, kind: "doubtful".into(), text: whole(&*document.doubtful) });
        }
        let result = document.result.as_ref().map(|result| self.result(result));
        let sigmas = document.sigmas_of_held.iter();
        let sigmas_of_held = sigmas.map(|((camera, parameter), sigma)| (camera.clone(), *parameter, *sigma)).collect();
        JournalState { project, detections, doubtful, result, options: document.options.clone(), sigmas_of_held }
    }

    fn result(&mut self, result: &Arc<AdjustmentResult>) -> u64 {
        let (number, new) = number(&mut self.results, &mut self.next, &self.in_journal, result);
        if new {
            let came = self.came.take_if(|(of, _)| std::ptr::eq(of.as_ptr(), Arc::as_ptr(result)));
            let input = self.project(&result.input, ProjectRole::Work);
            let oriented = self.project(&result.oriented, ProjectRole::Orientation);
            let in_one = || vec![(sightline_protocol::Piece::Frame, Piece::Text(to_text(&result.adjustment)))];
            let adjustment = came.map_or_else(in_one, |(_, pieces)| pieces);
            let text = result_text(input, oriented, adjustment);
            self.new.push(JournalPart { number, kind: RESULT.into(), text });
        }
        number
    }

    fn stack(&mut self, past: bool, entries: &[HistoryEntry]) -> Option<StackChange> {
        let before = if past { &self.past } else { &self.future };
        let keep = before.iter().zip(entries).take_while(|(serial, entry)| **serial == entry.serial).count();
        if keep == before.len() && keep == entries.len() {
            return None;
        }
        // What was never read again is at the bottom, and only a journal that begins anew lacks it.
        let unread = entries[keep..].iter().take_while(|entry| entry.state.is_none()).count();
        let documents = documents(entries, keep);
        let add = entries[keep..].iter().zip(&documents).filter_map(|(entry, document)| {
            let state = self.state(document.as_ref()?);
            Some((entry.change.clone(), state))
        });
        let add = add.collect();
        let below = self.forgotten[usize::from(!past)];
        let stack = StackChange { keep: keep + below, forgotten: if keep + below == 0 { unread } else { 0 }, add };
        let serials = entries.iter().map(|entry| entry.serial).collect();
        *(if past { &mut self.past } else { &mut self.future }) = serials;
        Some(stack)
    }

    /// From now on the journal has no parts but these and those that follow.
    pub fn condensed(&mut self, kept: HashSet<u64>) {
        self.in_journal = InJournal { from: self.next, kept };
    }

    /// Entries to add to the journal; none if nothing has changed.
    pub fn note(
        &mut self,
        document: &Document,
        history: &History,
        files: &BTreeMap<String, KeptFile>,
    ) -> Option<(Note, Vec<JournalPart>)> {
        let past = self.stack(true, &history.past);
        let future = self.stack(false, &history.future);
        let state = self.state(document);
        self.came = None;
        let present = (self.present.as_ref() != Some(&state)).then_some(state);
        if present.is_some() {
            self.present.clone_from(&present);
        }
        let mut note = Note { name: None, past, future, present, files: None };
        if self.files.as_ref().is_none_or(|(known, _)| known != files) {
            let number = self.next;
            self.next += 1;
            self.new.push(JournalPart { number, kind: "files".into(), text: whole(files) });
            self.files = Some((files.clone(), number));
            note.files = Some(number);
        }
        let changed = note.past.is_some() || note.future.is_some() || note.present.is_some() || note.files.is_some();
        changed.then(|| (note, std::mem::take(&mut self.new)))
    }
}

/// A project as its notes have it.
#[derive(Debug, Default)]
pub struct Replayed {
    pub past: Vec<(Change, JournalState)>,
    pub future: Vec<(Change, JournalState)>,
    pub present: Option<JournalState>,
    pub files: Option<u64>,
    /// A name that was given from outside since.
    pub name: Option<String>,
    /// Entries at the bottom of past and future that are not stored any more.
    pub forgotten: [usize; 2],
}

/// Reads notes in their order.
pub fn replay(notes: &[String]) -> Result<Replayed, String> {
    let mut all = Replayed::default();
    for note in notes {
        let note = from_text::<Note>(note)?;
        let [past, future] = &mut all.forgotten;
        for (stack, below, change) in [(&mut all.past, past, note.past), (&mut all.future, future, note.future)] {
            if let Some(StackChange { keep, forgotten, add }) = change {
                stack.truncate(keep.saturating_sub(*below));
                *below = keep.min(*below) + forgotten;
                stack.extend(add);
            }
        }
        if let Some(present) = note.present {
            all.present = Some(present);
            all.name = None;
        }
        all.name = note.name.or(all.name);
        all.files = note.files.or(all.files);
    }
    Ok(all)
}

/// Parts that a document is made of, read from their texts.
impl Book {
    /// Of a project that was read: its history by the serials of its entries.
    pub fn of(replayed: &Replayed, history: &History, next: u64) -> Self {
        let serials = |entries: &[HistoryEntry]| entries.iter().map(|entry| entry.serial).collect();
        Self {
            next,
            past: serials(&history.past),
            future: serials(&history.future),
            present: replayed.present.clone(),
            forgotten: replayed.forgotten,
            ..Self::default()
        }
    }

    /// The parts that a state needs and that are neither here nor among the texts: asked again when these have been read, until there is none.
    pub fn wanted(&self, state: &JournalState, texts: &HashMap<u64, String>) -> Result<Vec<u64>, String> {
        let mut wanted = self.wanted_of_result(state, texts)?;
        let map = texts.get(&state.detections);
        match map {
            _ if self.maps.part(state.detections).is_some() => {}
            None => wanted.push(state.detections),
            Some(text) => wanted.extend(
                from_text::<BTreeMap<String, u64>>(text)?
                    .into_values()
                    .filter(|number| self.detections.part(*number).is_none() && !texts.contains_key(number)),
            ),
        }
        if self.doubtful.part(state.doubtful).is_none() && !texts.contains_key(&state.doubtful) {
            wanted.push(state.doubtful);
        }
        wanted.sort_unstable();
        wanted.dedup();
        Ok(wanted)
    }

    /// The same for project and result alone, without targets: what is compared with other epochs.
    pub fn wanted_of_result(&self, state: &JournalState, texts: &HashMap<u64, String>) -> Result<Vec<u64>, String> {
        let mut wanted = self.projects.wanted(state.project, texts)?;
        if let Some(result) = state.result.filter(|result| self.results.part(*result).is_none()) {
            match texts.get(&result) {
                None => wanted.push(result),
                Some(text) => {
                    for project in named_in(RESULT, text)? {
                        wanted.extend(self.projects.wanted(project, texts)?);
                    }
                }
            }
        }
        wanted.sort_unstable();
        wanted.dedup();
        Ok(wanted)
    }

    /// Project and result of a state from their texts, without targets.
    pub fn result_of(state: &JournalState, texts: &HashMap<u64, String>) -> Result<Document, String> {
        let mut book = Self::default();
        let project = book.projects.read(state.project, texts)?;
        let result = state.result.map(|number| book.read_result(number, texts)).transpose()?.flatten();
        Ok(Document { project, options: state.options.clone(), result, ..Document::default() })
    }

    /// `None` if it was computed with lateral colour, which the document no longer has; the origin of the project records that.
    fn read_result(
        &mut self,
        number: u64,
        texts: &HashMap<u64, String>,
    ) -> Result<Option<Arc<AdjustmentResult>>, String> {
        if texts.get(&number).is_some_and(|text| with_lateral_colour(text)) {
            return Ok(None);
        }
        let projects = &mut self.projects;
        let result = read(&mut self.results, number, texts, |text| {
            let kept = from_text::<KeptResult>(text)?;
            let (input, oriented) = (projects.read(kept.input, texts)?, projects.read(kept.oriented, texts)?);
            Ok(AdjustmentResult { input, oriented, adjustment: kept.adjustment() })
        });
        result.map(Some)
    }

    /// What is written next is stored as a difference from this document, which was read; parts from now on are not read again.
    pub fn go_on_from(&mut self, document: &Document) {
        self.projects.go_on_from(&document.project, self.next);
    }

    /// A document from its parts.
    pub fn document(&mut self, state: &JournalState, texts: &HashMap<u64, String>) -> Result<Document, String> {
        let project = self.projects.read(state.project, texts)?;
        let known = &mut self.detections;
        let detections = read(&mut self.maps, state.detections, texts, |text| {
            let numbers = from_text::<BTreeMap<String, u64>>(text)?;
            numbers.into_iter().map(|(photo, number)| Ok((photo, read(known, number, texts, from_text)?))).collect()
        })?;
        let doubtful = read(&mut self.doubtful, state.doubtful, texts, from_text)?;
        let result = state.result.map(|number| self.read_result(number, texts)).transpose()?.flatten();
        Ok(Document {
            project,
            rings: targets::rings(&detections),
            detections,
            doubtful,
            sigmas_of_held: state.sigmas_of_held.iter().map(|(c, p, s)| ((c.clone(), *p), *s)).collect(),
            options: state.options.clone(),
            result,
        })
    }

    /// The photos' files, which are known from now on.
    pub fn files(&mut self, number: u64, text: &str) -> Result<BTreeMap<String, KeptFile>, String> {
        let files = from_text::<BTreeMap<String, KeptFile>>(text)?;
        self.files = Some((files.clone(), number));
        Ok(files)
    }
}

/// Whether a result was computed with lateral colour, by an earlier version.
fn with_lateral_colour(text: &str) -> bool {
    text.split_once(ADJUSTMENT).is_some_and(|(_, adjustment)| RemovedFields::in_adjustment(adjustment))
}

fn read<T>(
    known: &mut Known<T>,
    number: u64,
    texts: &HashMap<u64, String>,
    parse: impl FnOnce(&str) -> Result<T, String>,
) -> Result<Arc<T>, String> {
    if let Some(part) = known.part(number) {
        return Ok(part);
    }
    let text = texts.get(&number).ok_or_else(|| format!("part {number} is missing"))?;
    let part = Arc::new(parse(text)?);
    known.learn(&part, number);
    Ok(part)
}

#[cfg(test)]
pub(super) mod tests;
