//! The history of the document, with undo. The states before and after the present one are kept as what differs from the next one towards
//! it, so that an edit takes the room of what it changes.

use std::sync::Arc;

use sightline::project::{Observation, Photo, Point, Rows};

use super::splices::{self, Splice};
use super::{AdjustmentResult, Change, Document};

/// A table of such a state: whole, or as its differences from the table of the state above it on the stack.
#[derive(Clone, Debug)]
enum TableState<T> {
    Whole(Rows<T>),
    FromAbove(Vec<Splice<T>>),
}

impl<T: Clone + PartialEq> TableState<T> {
    fn new(rows: &Rows<T>, above: &Rows<T>) -> Self {
        if rows.shares(above) {
            return Self::FromAbove(Vec::new());
        }
        let splices = splices::between(above, rows);
        // A table that is changed all over is kept once, not twice.
        let smaller = splices::rows_in(&splices) < rows.len();
        if smaller && splices::fit(above, &splices) { Self::FromAbove(splices) } else { Self::Whole(rows.clone()) }
    }

    fn rows(self, above: &Rows<T>) -> Rows<T> {
        match self {
            Self::Whole(rows) => rows,
            Self::FromAbove(splices) if splices.is_empty() => above.clone(),
            Self::FromAbove(splices) => splices::forward(above, &splices)
                .expect("splices that fitted the table above when they were made")
                .into(),
        }
    }
}

/// An earlier or later state of the document.
#[derive(Clone, Debug)]
pub enum HistoryState {
    Whole(Document),
    /// As what leads to it from the state above it on the stack. That one never changes while this one lies on it.
    FromAbove(Box<Difference>),
}

/// Differences from the next state.
#[derive(Clone, Debug)]
pub struct Difference {
    /// The document with a project that has no tables.
    rest: Document,
    photos: TableState<Photo>,
    points: TableState<Point>,
    observations: TableState<Observation>,
}

impl HistoryState {
    /// Parts of a state other than the tables of its project.
    fn rest(&self) -> &Document {
        match self {
            Self::Whole(document) => document,
            Self::FromAbove(difference) => &difference.rest,
        }
    }

    /// The document, where that of the state above is this.
    pub fn document(self, above: &Document) -> Document {
        match self {
            Self::Whole(document) => document,
            Self::FromAbove(difference) => {
                let Difference { mut rest, photos, points, observations } = *difference;
                let tables = &above.project;
                let project = rest.project_mut();
                project.photos = photos.rows(&tables.photos);
                project.points = points.rows(&tables.points);
                project.observations = observations.rows(&tables.observations);
                // Tables of the result that it came with are the same again, and are compared no more.
                if let Some(result) = &rest.result {
                    Arc::make_mut(&mut rest.project).share_tables(&result.input);
                }
                rest
            }
        }
    }

    fn told_from(document: Document, above: &Document) -> Self {
        let (own, others) = (&document.project, &above.project);
        let photos = TableState::new(&own.photos, &others.photos);
        let points = TableState::new(&own.points, &others.points);
        let observations = TableState::new(&own.observations, &others.observations);
        let rest = Document { project: Arc::new(document.project.without_tables()), ..document };
        Self::FromAbove(Box::new(Difference { rest, photos, points, observations }))
    }
}

/// An entry of the history: a change, and the state before it (to undo) or after it (to redo).
#[derive(Clone, Debug)]
pub struct HistoryEntry {
    /// Tells states apart: another one when its state changes or it goes to the other side.
    pub serial: u64,
    /// The change's own number, which it keeps when it is undone and done again.
    pub origin: u64,
    pub change: Change,
    /// None while it is still in the browser's storage; the last of a stack, which is undone or done again next, is whole.
    pub state: Option<HistoryState>,
}

/// Entries of the history; the one next to the present is last.
type HistoryStack = Vec<HistoryEntry>;

/// Puts an entry on a stack; the one below is stored as a difference from it from now on.
fn put(stack: &mut HistoryStack, entry: HistoryEntry) {
    stack.push(entry);
    let below = stack.len().saturating_sub(2);
    fold(stack, below);
}

/// Takes the last entry off a stack, where its state is here; the one below is whole from now on.
fn take(stack: &mut HistoryStack) -> Option<(HistoryEntry, Document)> {
    let below = stack.len().saturating_sub(2);
    unfold(stack, below);
    match stack.pop_if(|entry| entry.state.is_some()) {
        Some(mut entry) => match entry.state.take() {
            Some(HistoryState::Whole(document)) => Some((entry, document)),
            _ => unreachable!("the last state of a stack is whole"),
        },
        None => None,
    }
}

/// Makes the states of a stack whole, from a place on.
fn unfold(stack: &mut [HistoryEntry], from: usize) {
    for k in (from..stack.len().saturating_sub(1)).rev() {
        let (lower, upper) = stack.split_at_mut(k + 1);
        let Some(HistoryState::Whole(above)) = &upper[0].state else { continue };
        let state = &mut lower[k].state;
        *state = state.take().map(|state| HistoryState::Whole(state.document(above)));
    }
}

/// Tells the states of a stack, from a place on, each from the one above; the last stays whole.
fn fold(stack: &mut [HistoryEntry], from: usize) {
    for k in from..stack.len().saturating_sub(1) {
        let (lower, upper) = stack.split_at_mut(k + 1);
        let Some(HistoryState::Whole(above)) = &upper[0].state else { continue };
        let state = &mut lower[k].state;
        *state = state.take().map(|state| match state {
            HistoryState::Whole(document) => HistoryState::told_from(document, above),
            told => told,
        });
    }
}

/// The documents of the entries of a stack from a place on, where they are here, as [`HistoryEntry`] has them.
pub fn documents(stack: &[HistoryEntry], from: usize) -> Vec<Option<Document>> {
    let mut above: Option<Document> = None;
    let mut all = Vec::new();
    for entry in stack[from..].iter().rev() {
        let document = entry.state.clone().and_then(|state| match (state, &above) {
            (HistoryState::Whole(document), _) => Some(document),
            (told, Some(above)) => Some(told.document(above)),
            (HistoryState::FromAbove(_), None) => None,
        });
        above.clone_from(&document);
        all.push(document);
    }
    all.reverse();
    all
}

/// States before and after the present one.
#[derive(Clone, Debug, Default)]
pub struct History {
    pub past: HistoryStack,
    pub future: HistoryStack,
    serials: u64,
}

impl History {
    /// Changes whose states are still in the browser's storage.
    pub fn stored(past: Vec<Change>, future: Vec<Change>) -> Self {
        let mut history = Self::default();
        history.past = past.into_iter().map(|change| history.entry(change, None, None)).collect();
        history.future = future.into_iter().map(|change| history.entry(change, None, None)).collect();
        history
    }

    fn entry(&mut self, change: Change, origin: Option<u64>, state: Option<Document>) -> HistoryEntry {
        self.serials += 1;
        let state = state.map(HistoryState::Whole);
        HistoryEntry { serial: self.serials, origin: origin.unwrap_or(self.serials), change, state }
    }

    /// Puts a state in its place that has come from the browser's storage.
    pub fn fill(&mut self, serial: u64, state: Document) {
        if let Some(entry) = self.past.iter_mut().chain(&mut self.future).find(|entry| entry.serial == serial) {
            entry.state = Some(HistoryState::Whole(state));
        }
    }

    /// Remembers the state before a change; the change's number.
    pub fn push(&mut self, change: Change, before: Document) -> u64 {
        let entry = self.entry(change, None, Some(before));
        let origin = entry.origin;
        put(&mut self.past, entry);
        self.future.clear();
        origin
    }

    /// Results of a change that arrive later, perhaps after other changes: every state that comes after that change has it from then on, so
    /// that undoing another change does not take it away, and undoing that change does. Says whether the present state is one of these;
    /// none where the change is gone, undone and replaced by another.
    pub fn arrive(&mut self, origin: u64, edit: impl Fn(&mut Document)) -> Option<bool> {
        let behind = |entries: &[HistoryEntry]| entries.iter().position(|entry| entry.origin == origin);
        // An entry of the past has the state before its change, one of the future that after it; the future's last is done again first.
        let (past, future, present) = match (behind(&self.past), behind(&self.future)) {
            (Some(k), _) => (k + 1..self.past.len(), 0..self.future.len(), true),
            (None, Some(k)) => (0..0, 0..k + 1, false),
            (None, None) => return None,
        };
        let serials = &mut self.serials;
        for (stack, range) in [(&mut self.past, past), (&mut self.future, future)] {
            if range.is_empty() {
                continue;
            }
            // The state below is stored as a difference from one that changes.
            let from = range.start.saturating_sub(1);
            unfold(stack, from);
            for entry in &mut stack[range] {
                let Some(HistoryState::Whole(state)) = &mut entry.state else { continue };
                edit(state);
                *serials += 1;
                entry.serial = *serials;
            }
            fold(stack, from);
        }
        Some(present)
    }

    /// The state before the last change; `present` can be got back.
    pub fn undo(&mut self, present: Document) -> Option<Document> {
        let (entry, state) = take(&mut self.past)?;
        let back = self.entry(entry.change, Some(entry.origin), Some(present));
        put(&mut self.future, back);
        Some(state)
    }

    pub fn redo(&mut self, present: Document) -> Option<Document> {
        let (entry, state) = take(&mut self.future)?;
        let back = self.entry(entry.change, Some(entry.origin), Some(present));
        put(&mut self.past, back);
        Some(state)
    }

    /// The change that would be undone.
    pub fn last(&self) -> Option<&Change> {
        self.past.last().filter(|entry| entry.state.is_some()).map(|entry| &entry.change)
    }

    /// The change that would be redone.
    pub fn next(&self) -> Option<&Change> {
        self.future.last().filter(|entry| entry.state.is_some()).map(|entry| &entry.change)
    }

    /// The result that was there before another, where the two are of different adjustments.
    pub fn result_before(&self, result: &Arc<AdjustmentResult>) -> Option<&Arc<AdjustmentResult>> {
        // Most states share their result with the next one: each is examined once.
        let mut last = result;
        let results = self.past.iter().rev().filter_map(|entry| entry.state.as_ref()?.rest().result.as_ref());
        let mut others = results.filter(|other| !Arc::ptr_eq(std::mem::replace(&mut last, other), other));
        // Numbers in another unit are no earlier state of these.
        others.find(|other| other.adjustment != result.adjustment && other.input.unit == result.input.unit)
    }

    /// Changes since the present result was computed, the latest last.
    pub fn since(&self, present: &Document) -> Vec<Change> {
        let same = |a: &Option<Arc<AdjustmentResult>>, b: &Option<Arc<AdjustmentResult>>| match (a, b) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            _ => false,
        };
        let mut changes: Vec<_> = self
            .past
            .iter()
            .rev()
            .take_while(|entry| entry.state.as_ref().is_some_and(|state| same(&state.rest().result, &present.result)))
            .map(|entry| entry.change.clone())
            .collect();
        changes.reverse();
        changes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_after_the_adjustment_makes_it_out_of_date_and_undoing_it_does_not() {
        let mut document = Document::default();
        let mut history = History::default();
        let adjustment = serde_json::from_str(
            r#"{"termination":"converged","iterations":[],"observations_count":0,"unknowns":0,"constraints":0,
                "redundancy":0,"sigma0":null,"global_test":null,"cameras":[],"photos":[],"points":[],"observations":[],
                "check_points":[],"precision":null}"#,
        )
        .unwrap();
        let input = document.project.clone();
        document.result = Some(Arc::new(AdjustmentResult { oriented: input.clone(), input, adjustment }));
        assert!(!document.out_of_date());
        history.push(Change::UnitSet, document.clone());
        document.project_mut().unit = "m".into();
        assert!(document.out_of_date() && document.current().is_none());
        assert_eq!(history.since(&document), [Change::UnitSet]);
        let document = history.undo(document).unwrap();
        assert!(!document.out_of_date());
        let document = history.redo(document).unwrap();
        assert_eq!(document.project.unit, "m");
    }

    /// Names of points represent edits, "found" represents results of a detection.
    fn names(document: &Document) -> Vec<&str> {
        document.project.points.iter().map(|p| p.id.as_str()).collect()
    }

    fn add(document: &mut Document, id: &str) {
        let point = Point { id: id.into(), ..Default::default() };
        document.project_mut().points.push(point);
    }

    #[test]
    fn what_arrives_belongs_to_the_change_that_asked_for_it() {
        let mut document = Document::default();
        let mut history = History::default();
        let origin = history.push(Change::TargetsDetected, document.clone());
        history.push(Change::UnitSet, document.clone());
        add(&mut document, "edited");
        assert_eq!(history.arrive(origin, |d| add(d, "found")), Some(true));
        add(&mut document, "found");
        // Undoing the edit leaves what was found; undoing the detection takes it away.
        document = history.undo(document).unwrap();
        assert_eq!(names(&document), ["found"]);
        document = history.undo(document).unwrap();
        assert!(names(&document).is_empty());
        // What arrives now is there when the detection is done again.
        assert_eq!(history.arrive(origin, |d| add(d, "late")), Some(false));
        assert!(names(&document).is_empty());
        document = history.redo(document).unwrap();
        assert_eq!(names(&document), ["found", "late"]);
        document = history.redo(document).unwrap();
        assert_eq!(names(&document), ["edited", "found", "late"]);
        document = history.undo(document).unwrap();
        document = history.undo(document).unwrap();
        history.push(Change::UnitSet, document);
        assert_eq!(history.arrive(origin, |d| add(d, "never")), None);
    }
}
