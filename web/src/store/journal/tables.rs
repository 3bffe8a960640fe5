//! How the tables of a project are kept: each a part by itself, whole or as what changed since another one, so that an edit writes what it
//! changes.

use std::collections::HashMap;
use std::sync::Arc;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sightline::project::{Observation, Photo, Point, Project, RemovedFields, Rows};
use sightline_protocol::{from_text, to_text};

use super::{InJournal, JournalPart, Known, Piece};
use crate::document::splices::{self, Splice};

/// A table is written whole after so many parts that contain only changes: reading it stays short, and damage to one of them costs no more.
const CHAIN: usize = 256;

/// A project's part: its tables are parts of their own, and it has none.
#[derive(Deserialize)]
pub struct Head {
    pub tables: [u64; 3],
    /// How many rows they have, for the list of projects.
    pub rows: [usize; 3],
    pub project: Project,
}

/// The same as it is written.
#[derive(Serialize)]
struct HeadOf<'a> {
    tables: [u64; 3],
    rows: [usize; 3],
    project: &'a Project,
}

/// How every part begins that is a [`Head`]; a project that was kept before tables were parts begins otherwise.
const HEAD: &str = r#"{"tables":"#;

/// Text before the project, which comes last.
const PROJECT: &str = r#","project":"#;

impl Head {
    /// Where it is one.
    pub fn read(text: &str) -> Option<Result<Self, String>> {
        text.starts_with(HEAD).then(|| from_text(text))
    }

    /// Fields of its project that the document no longer has.
    fn removed_fields(text: &str) -> RemovedFields {
        let project = text.split_once(PROJECT).and_then(|(_, rest)| rest.strip_suffix('}'));
        project.map(RemovedFields::of).unwrap_or_default()
    }
}

/// A photo of earlier versions: the colour that it was measured in is no longer part of the document.
#[derive(Clone, PartialEq, Serialize, Deserialize)]
struct EarlierPhoto {
    #[serde(default)]
    colour: Option<String>,
}

impl EarlierPhoto {
    /// How many photos of a table have a colour. What cannot be read here is no table, which reading the photos reports.
    fn with_colour(number: u64, texts: &HashMap<u64, String>) -> usize {
        let Some(own) = texts.get(&number) else { return 0 };
        let chain = if own.starts_with('[') { Vec::new() } else { named_in(CHANGED, own).unwrap_or_default() };
        let mut all = std::iter::once(own).chain(chain.iter().filter_map(|link| texts.get(link)));
        if !all.any(|text| text.contains(r#""colour":""#)) {
            return 0;
        }
        let photos = Ledger::<Self>::default().read(number, texts);
        photos.map_or(0, |photos| photos.iter().filter(|photo| photo.colour.is_some()).count())
    }
}

/// A table as what changed since another one.
#[derive(Deserialize)]
struct Changed<T> {
    /// The parts that it is a difference from, the complete one first.
    chain: Vec<u64>,
    splices: Vec<Splice<T>>,
}

/// The same as it is written.
#[derive(Serialize)]
struct ChangedOf<'a, T> {
    chain: &'a [u64],
    splices: &'a [Splice<T>],
}

/// Parts whose texts refer to other parts.
pub fn names_others(kind: &str) -> bool {
    kind.starts_with(CHANGED) || kind.starts_with(PROJECT_HEAD)
}

/// Prefixes of the kinds of heads and of changed tables.
const PROJECT_HEAD: &str = "head";
const CHANGED: &str = "changed ";

/// The kind of the heads of the projects that people work on.
pub const OF_PROJECTS: &str = PROJECT_HEAD;

/// The parts that such a part names.
pub fn named_in(kind: &str, text: &str) -> Result<Vec<u64>, String> {
    #[derive(Deserialize)]
    struct TableNumbers {
        tables: [u64; 3],
    }
    #[derive(Deserialize)]
    struct Chain {
        chain: Vec<u64>,
    }
    if kind.starts_with(CHANGED) {
        return Ok(from_text::<Chain>(text)?.chain);
    }
    Ok(from_text::<TableNumbers>(text)?.tables.to_vec())
}

/// Which project of a document: the one that the user edits, or the one with the initial values of an orientation.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum ProjectRole {
    Work,
    Orientation,
}

/// Parts written so far, and the next number.
pub struct Writing<'a> {
    pub next: &'a mut u64,
    pub journal: &'a InJournal,
    pub new: &'a mut Vec<JournalPart>,
}

/// The tables of one kind that are known.
pub struct Ledger<T> {
    known: Known<Vec<T>>,
    /// What those in memory are stored as differences from in the journal, by their numbers.
    chains: HashMap<u64, Vec<u64>>,
    /// The last ones that were written: the next is stored as a difference from one of them.
    last: [Option<(u64, Rows<T>)>; 2],
    /// Those below this number can be read from the journal; later ones were written since it was opened.
    readable: u64,
}

impl<T> Default for Ledger<T> {
    fn default() -> Self {
        Self { known: Known::default(), chains: HashMap::new(), last: [None, None], readable: u64::MAX }
    }
}

/// A way to a table: the table that it begins at, and what is to be done with it.
struct Way<T> {
    start: Start<T>,
    /// Parts that contain changes, and their direction (forward or back).
    steps: Vec<(u64, bool)>,
}

enum Start<T> {
    Here(Arc<Vec<T>>),
    Whole(u64),
}

impl<T: Clone + PartialEq + Serialize + DeserializeOwned> Ledger<T> {
    fn learn(&mut self, rows: &Rows<T>, number: u64, chain: Vec<u64>) {
        self.known.learn(rows.shared(), number);
        if self.chains.len() > 100 {
            let known = &self.known;
            self.chains.retain(|number, _| known.part(*number).is_some());
        }
        self.chains.insert(number, chain);
    }

    /// The number of a table, which is written where the journal has none like it.
    fn number(&mut self, rows: &Rows<T>, kind: &str, of: ProjectRole, writing: &mut Writing) -> u64 {
        let journal = writing.journal;
        if let Some(number) = self.known.number(rows.shared()).filter(|number| journal.has(*number)) {
            return number;
        }
        let mut nearest: Option<(u64, Vec<Splice<T>>)> = None;
        let others = [of as usize, 1 - of as usize].map(|k| &self.last[k]);
        for (number, base) in others.into_iter().flatten().filter(|(number, _)| journal.has(*number)) {
            let splices = splices::between(base, rows);
            let rows_in = splices::rows_in(&splices);
            if nearest.as_ref().is_none_or(|(_, before)| rows_in < splices::rows_in(before)) {
                nearest = Some((*number, splices));
            }
            // Near enough not to be compared with another one.
            if 8 * rows_in < rows.len() {
                break;
            }
        }
        let chain_of = |number: &u64| self.chains.get(number).cloned();
        let told = nearest.and_then(|(number, splices)| Some((number, chain_of(&number)?, splices)));
        let (number, chain) = match told {
            Some((number, chain, splices)) if splices.is_empty() => (number, chain),
            Some((base, mut chain, splices))
                if splices::rows_in(&splices) < rows.len().div_ceil(2) && chain.len() < CHAIN =>
            {
                chain.push(base);
                let text = to_text(&ChangedOf { chain: &chain, splices: &splices });
                (writing.add(format!("{CHANGED}{kind}"), text), chain)
            }
            _ => (writing.add(kind.to_owned(), to_text(rows)), Vec::new()),
        };
        self.learn(rows, number, chain);
        self.last[of as usize] = Some((number, rows.clone()));
        number
    }

    /// How a table is got from what is here and what the journal has; `None` if its own text is needed first.
    fn way(&self, number: u64, texts: &HashMap<u64, String>) -> Result<Option<Way<T>>, String> {
        if let Some(rows) = self.known.part(number) {
            return Ok(Some(Way { start: Start::Here(rows), steps: Vec::new() }));
        }
        // Back from one that was stored as a difference from it.
        let later = self.chains.iter().filter(|(later, _)| **later < self.readable);
        let back = later.filter_map(|(later, chain)| {
            let place = chain.iter().position(|link| *link == number)?;
            let rows = self.known.part(*later)?;
            Some((chain.len() - place, rows, *later, &chain[place + 1..]))
        });
        let back = back.min_by_key(|(length, _, later, _)| (*length, *later)).map(|(_, rows, later, between)| {
            let steps = std::iter::once(later).chain(between.iter().rev().copied()).map(|link| (link, false)).collect();
            Way { start: Start::Here(rows), steps }
        });
        let Some(text) = texts.get(&number) else { return Ok(back) };
        if text.starts_with('[') {
            return Ok(Some(back.unwrap_or(Way { start: Start::Whole(number), steps: Vec::new() })));
        }
        let mut chain = from_text::<Changed<T>>(text)?.chain;
        chain.push(number);
        let here = chain.iter().enumerate().rev().find_map(|(k, link)| Some((k, self.known.part(*link)?)));
        let (start, from) = match here {
            Some((k, rows)) => (Start::Here(rows), k + 1),
            None => (Start::Whole(chain[0]), 1),
        };
        let steps = chain[from..].iter().map(|link| (*link, true)).collect::<Vec<_>>();
        Ok(Some(back.filter(|back| back.steps.len() < steps.len()).unwrap_or(Way { start, steps })))
    }

    /// The parts that are needed for a table and are neither here nor among the texts.
    fn wanted(&self, number: u64, texts: &HashMap<u64, String>) -> Result<Vec<u64>, String> {
        let Some(Way { start, steps }) = self.way(number, texts)? else { return Ok(vec![number]) };
        let whole = match start {
            Start::Whole(number) => Some(number),
            Start::Here(_) => None,
        };
        let all = whole.into_iter().chain(steps.into_iter().map(|(link, _)| link));
        Ok(all.filter(|link| !texts.contains_key(link)).collect())
    }

    /// A table from the texts, known from now on.
    fn read(&mut self, number: u64, texts: &HashMap<u64, String>) -> Result<Rows<T>, String> {
        let missing = |number: u64| format!("part {number} is missing");
        let text = |number: u64| texts.get(&number).ok_or_else(|| missing(number));
        let Way { start, steps } = self.way(number, texts)?.ok_or_else(|| missing(number))?;
        let mut rows: Rows<T> = match start {
            Start::Here(rows) if steps.is_empty() => return Ok(rows.into()),
            Start::Here(rows) => rows.into(),
            Start::Whole(number) => from_text(text(number)?)?,
        };
        let mut chain = Vec::new();
        for (link, forward) in steps {
            let changed = from_text::<Changed<T>>(text(link)?)?;
            rows = if forward {
                chain = [changed.chain, vec![link]].concat();
                splices::forward(&rows, &changed.splices)?.into()
            } else {
                chain = changed.chain;
                splices::back(&rows, &changed.splices)?.into()
            };
        }
        // The last of the chain is the table itself.
        chain.pop();
        self.learn(&rows, number, chain);
        Ok(rows)
    }

    /// What comes next is stored as a difference from this table, where it is known.
    fn go_on_from(&mut self, rows: &Rows<T>, readable: u64) {
        self.readable = readable;
        self.last[ProjectRole::Work as usize] = self.known.number(rows.shared()).map(|number| (number, rows.clone()));
    }
}

impl Writing<'_> {
    fn add(&mut self, kind: String, text: String) -> u64 {
        let number = *self.next;
        *self.next += 1;
        self.new.push(JournalPart { number, kind, text: vec![Piece::Text(text)] });
        number
    }
}

/// The projects that are known, with their tables.
#[derive(Default)]
pub struct Projects {
    known: Known<Project>,
    /// The text of the last head of each, and its number.
    heads: [Option<(String, u64)>; 2],
    photos: Ledger<Photo>,
    points: Ledger<Point>,
    observations: Ledger<Observation>,
}

impl Projects {
    /// The number of a project, whose parts are written where the journal has none like them.
    pub fn number(&mut self, project: &Arc<Project>, of: ProjectRole, mut writing: Writing) -> u64 {
        if let Some(number) = self.known.number(project).filter(|number| writing.journal.has(*number)) {
            return number;
        }
        let tables = [
            self.photos.number(&project.photos, "photos", of, &mut writing),
            self.points.number(&project.points, "points", of, &mut writing),
            self.observations.number(&project.observations, "observations", of, &mut writing),
        ];
        let rows = [project.photos.len(), project.points.len(), project.observations.len()];
        let bare = project.without_tables();
        let text = to_text(&HeadOf { tables, rows, project: &bare });
        let last = &mut self.heads[of as usize];
        let same = last.as_ref().filter(|(before, number)| *before == text && writing.journal.has(*number));
        let number = match same {
            Some((_, number)) => *number,
            None => {
                let kind =
                    if of == ProjectRole::Work { OF_PROJECTS.to_owned() } else { format!("{PROJECT_HEAD} oriented") };
                writing.add(kind, text.clone())
            }
        };
        *last = Some((text, number));
        self.known.learn(project, number);
        number
    }

    /// The parts that are needed for a project and are neither here nor among the texts.
    pub fn wanted(&self, number: u64, texts: &HashMap<u64, String>) -> Result<Vec<u64>, String> {
        if self.known.part(number).is_some() {
            return Ok(Vec::new());
        }
        let Some(text) = texts.get(&number) else { return Ok(vec![number]) };
        let Some(head) = Head::read(text) else { return Ok(Vec::new()) };
        let [photos, points, observations] = head?.tables;
        let mut wanted = self.photos.wanted(photos, texts)?;
        wanted.extend(self.points.wanted(points, texts)?);
        wanted.extend(self.observations.wanted(observations, texts)?);
        Ok(wanted)
    }

    /// A project from the texts.
    pub fn read(&mut self, number: u64, texts: &HashMap<u64, String>) -> Result<Arc<Project>, String> {
        if let Some(project) = self.known.part(number) {
            return Ok(project);
        }
        let text = texts.get(&number).ok_or_else(|| format!("part {number} is missing"))?;
        let (mut project, removed) = match Head::read(text) {
            None => (from_text(text)?, RemovedFields::of(text)),
            Some(head) => {
                let Head { tables: [photos, points, observations], project, .. } = head?;
                let removed =
                    RemovedFields { photos: EarlierPhoto::with_colour(photos, texts), ..Head::removed_fields(text) };
                let project = Project {
                    photos: self.photos.read(photos, texts)?,
                    points: self.points.read(points, texts)?,
                    observations: self.observations.read(observations, texts)?,
                    ..project
                };
                (project, removed)
            }
        };
        removed.note_in(&mut project);
        let project = Arc::new(project);
        self.known.learn(&project, number);
        Ok(project)
    }

    /// What is written next is stored as a difference from this project; parts from this number on are not read again.
    pub fn go_on_from(&mut self, project: &Project, readable: u64) {
        self.photos.go_on_from(&project.photos, readable);
        self.points.go_on_from(&project.points, readable);
        self.observations.go_on_from(&project.observations, readable);
    }
}
