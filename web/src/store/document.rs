//! The document of the desk, what has been done to it, and undoing that.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use sightline::adjustment::{AdjustOptions, Adjustment};
use sightline::detection::Detection;
use sightline::matching::Doubtful;
use sightline::project::{Parameter, Project, Role};

use crate::edit::sheet::Table;

use crate::edit::targets::Rings;

/// Everything that is undone and saved together. Parts are shared between states, so that a state is cheap to keep.
#[derive(Clone, Debug, Default)]
pub struct Document {
    pub project: Arc<Project>,
    /// Targets by photo.
    pub detections: Arc<BTreeMap<String, Arc<Detection>>>,
    /// Targets whose name is in doubt, from the last matching.
    pub doubtful: Arc<Vec<Doubtful>>,
    /// What the rings of all photos are codes of, from the last detection.
    pub rings: Rings,
    /// What parameters that are held now were observed with, by camera: it is back when they are estimated again.
    pub sigmas_of_held: BTreeMap<(String, Parameter), f64>,
    /// How the next adjustment is made.
    pub options: AdjustOptions,
    /// The last adjustment, whether or not the project has changed since.
    pub result: Option<Arc<Outcome>>,
}

/// An adjustment with what it was made from.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The project it was made from.
    pub input: Arc<Project>,
    /// The same with the initial values that orientation found.
    pub oriented: Arc<Project>,
    pub adjustment: Adjustment,
}

impl Document {
    /// Whether the result belongs to an earlier state of the project, or to other options.
    pub fn out_of_date(&self) -> bool {
        let same = |result: &Arc<Outcome>| {
            result.adjustment.options == self.options
                && (Arc::ptr_eq(&result.input, &self.project) || result.input.same_but_features(&self.project))
        };
        self.result.as_ref().is_some_and(|result| !same(result))
    }

    /// The result, where it belongs to the project as it is.
    pub fn current(&self) -> Option<&Arc<Outcome>> {
        self.result.as_ref().filter(|_| !self.out_of_date())
    }

    /// Whether no project is open: an opened one has a name at least.
    pub fn is_empty(&self) -> bool {
        let project = &self.project;
        let nothing = project.photos.is_empty() && project.points.is_empty() && project.name.is_empty();
        nothing && project.plan.is_none()
    }

    /// Whether nothing has changed between two states.
    pub fn same(&self, other: &Self) -> bool {
        let results = match (&self.result, &other.result) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (None, None) => true,
            _ => false,
        };
        results
            && self.options == other.options
            && Arc::ptr_eq(&self.project, &other.project)
            && Arc::ptr_eq(&self.detections, &other.detections)
            && Arc::ptr_eq(&self.doubtful, &other.doubtful)
    }

    pub fn project_mut(&mut self) -> &mut Project {
        Arc::make_mut(&mut self.project)
    }

    pub fn detections_mut(&mut self) -> &mut BTreeMap<String, Arc<Detection>> {
        Arc::make_mut(&mut self.detections)
    }
}

/// What a change did, for saying so; kept with the project, so its names stay.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Change {
    PhotosAdded(usize),
    PhotoRemoved(String),
    ShotsSwapped(usize),
    PhotoSwitched(String),
    CameraEdited(String),
    CameraAssigned { photos: usize, camera: String },
    TargetsDetected,
    TargetMeasured(String),
    Named(String),
    Renamed { from: String, to: String },
    Moved { point: String, photo: String },
    ObservationRemoved { point: String, photo: String },
    ObservationSwitched { point: String, photo: String },
    PointRemoved(String),
    MarksTaken(usize),
    Matched(usize),
    ControlTaken(usize),
    RoleSet(String),
    ControlEdited(String),
    CentreObserved(String),
    CentreForgotten(String),
    DistanceEdited { from: String, to: String },
    DistanceAdded { from: String, to: String },
    DistanceRemoved { from: String, to: String },
    DatumChosen,
    ParametersChosen(String),
    AxesExchanged,
    OptionsChosen,
    Adjusted,
    UnitSet,
    UnitConverted,
    PhotosAttached(usize),
    PhotosReplaced(usize),
    FeatureMade(String),
    FeatureRemoved(String),
    FeatureRenamed { from: String, to: String },
    SystemScaled(String),
    LinesDrawn,
    LayerColoured(String),
    ReportEdited,
    PlanEdited,
    StationMoved(String),
    StationAdded(String),
    StationRemoved(String),
    PlanMade(usize),
    Opened,
    CellsEdited { table: Table, cells: usize },
    RowsSwitched { table: Table, rows: usize, enabled: bool },
    RowsDeleted { table: Table, rows: usize },
    RolesSet { points: usize, role: Role },
    PointsMerged { points: usize, into: String },
    PointSplit { point: String, new: String },
    PointsRenamed(usize),
    CamerasJoined { cameras: usize, into: String },
    QuestionAnswered { photo: String },
    CalibrationTaken { camera: String },
    BarsTaken(usize),
    ColoursTaken { camera: String },
    ColoursForgotten { camera: String },
    ModelChosen { camera: String, model: String },
}

/// A change and the state on its other side.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Tells states apart: another one when its state changes or it goes to the other side.
    pub serial: u64,
    /// The change's own number, which it keeps when it is undone and done again.
    pub origin: u64,
    pub change: Change,
    /// None while it is still in the browser's storage.
    pub state: Option<Document>,
}

/// States before and after the present one.
#[derive(Clone, Debug, Default)]
pub struct History {
    pub past: Vec<Entry>,
    pub future: Vec<Entry>,
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

    fn entry(&mut self, change: Change, origin: Option<u64>, state: Option<Document>) -> Entry {
        self.serials += 1;
        Entry { serial: self.serials, origin: origin.unwrap_or(self.serials), change, state }
    }

    /// Puts a state in its place that has come from the browser's storage.
    pub fn fill(&mut self, serial: u64, state: Document) {
        if let Some(entry) = self.past.iter_mut().chain(&mut self.future).find(|entry| entry.serial == serial) {
            entry.state = Some(state);
        }
    }

    /// Remembers the state before a change; the change's number.
    pub fn push(&mut self, change: Change, before: Document) -> u64 {
        let entry = self.entry(change, None, Some(before));
        let origin = entry.origin;
        self.past.push(entry);
        self.future.clear();
        origin
    }

    /// What a change brings after it was made, perhaps with others behind it: every state that comes after that change has it from then on, so
    /// that undoing another change does not take it away, and undoing that change does. Says whether the present state is one of these;
    /// none where the change is gone, undone and replaced by another.
    pub fn arrive(&mut self, origin: u64, edit: impl Fn(&mut Document)) -> Option<bool> {
        let behind = |entries: &[Entry]| entries.iter().position(|entry| entry.origin == origin);
        // An entry of the past has the state before its change, one of the future that after it; the future's last is done again first.
        let (past, future, present) = match (behind(&self.past), behind(&self.future)) {
            (Some(k), _) => (k + 1..self.past.len(), 0..self.future.len(), true),
            (None, Some(k)) => (0..0, 0..k + 1, false),
            (None, None) => return None,
        };
        let serials = &mut self.serials;
        for entry in self.past[past].iter_mut().chain(&mut self.future[future]) {
            let Some(state) = &mut entry.state else { continue };
            edit(state);
            *serials += 1;
            entry.serial = *serials;
        }
        Some(present)
    }

    /// The state before the last change; `present` can be got back.
    pub fn undo(&mut self, present: Document) -> Option<Document> {
        let entry = self.past.pop_if(|entry| entry.state.is_some())?;
        let back = self.entry(entry.change, Some(entry.origin), Some(present));
        self.future.push(back);
        entry.state
    }

    pub fn redo(&mut self, present: Document) -> Option<Document> {
        let entry = self.future.pop_if(|entry| entry.state.is_some())?;
        let back = self.entry(entry.change, Some(entry.origin), Some(present));
        self.past.push(back);
        entry.state
    }

    /// What would be undone.
    pub fn last(&self) -> Option<&Change> {
        self.past.last().filter(|entry| entry.state.is_some()).map(|entry| &entry.change)
    }

    /// What would be done again.
    pub fn next(&self) -> Option<&Change> {
        self.future.last().filter(|entry| entry.state.is_some()).map(|entry| &entry.change)
    }

    /// The result that was there before another, where the two are of different adjustments.
    pub fn result_before(&self, result: &Arc<Outcome>) -> Option<&Arc<Outcome>> {
        // Most states share their result with the next one: each is looked at once.
        let mut last = result;
        let results = self.past.iter().rev().filter_map(|entry| entry.state.as_ref()?.result.as_ref());
        let mut others = results.filter(|other| !Arc::ptr_eq(std::mem::replace(&mut last, other), other));
        // Numbers in another unit are no earlier state of these.
        others.find(|other| other.adjustment != result.adjustment && other.input.unit == result.input.unit)
    }

    /// What has changed since the present result was found, latest last.
    pub fn since(&self, present: &Document) -> Vec<Change> {
        let same = |a: &Option<Arc<Outcome>>, b: &Option<Arc<Outcome>>| match (a, b) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            _ => false,
        };
        let mut changes: Vec<_> = self
            .past
            .iter()
            .rev()
            .take_while(|entry| entry.state.as_ref().is_some_and(|state| same(&state.result, &present.result)))
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
        document.result = Some(Arc::new(Outcome { oriented: input.clone(), input, adjustment }));
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

    /// Names of points stand for edits, "found" for what a detection brings.
    fn names(document: &Document) -> Vec<&str> {
        document.project.points.iter().map(|p| p.id.as_str()).collect()
    }

    fn add(document: &mut Document, id: &str) {
        let point = sightline::project::Point { id: id.into(), ..Default::default() };
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
