//! Monitoring: epochs, options and result. Epochs come from projects kept in this browser, project files and lists of points; the
//! comparison runs in a worker.

mod coming;
mod in_photos;
mod remembered;

use std::sync::Arc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use serde::Serialize;
use sightline::depiction::{extent, round};
use sightline::error::Error;
use sightline::monitoring::{Epoch, Limits, Monitoring, Options, Pair, Thresholds};
use sightline::project::ReportSettings;
use sightline_protocol::{CompareEpochs, ExportMonitoring, ReportEpochs, ReportMade, SampleEpochs};

use super::background::Stop;
use super::pool::{Failure, TaskOutcome};
use super::saving::file_stem;
use super::{Desk, JobKind, Problem, Selection, Step, Until};
use crate::browser::page;
use crate::edit::epoch;
use crate::i18n::{background, monitoring as words, speech};

/// Source of the epochs of the sample, shown in the language of the page.
pub const SAMPLE: &str = "sample";

/// An epoch in the list, and where it comes from.
#[derive(Clone)]
pub struct EpochEntry {
    /// Tells it from all others.
    pub id: u64,
    pub epoch: Arc<Epoch>,
    /// The project in this browser that it is.
    pub key: Option<String>,
    /// Where it comes from, for people: a file, or nothing of a project of this browser.
    pub source: String,
    /// The file of its covariance matrix.
    pub matrix: Option<String>,
}

impl EpochEntry {
    /// Number of its points.
    pub fn points(&self) -> usize {
        let of_project = || self.epoch.project.as_ref().map(|p| p.points.len());
        self.epoch.points.as_ref().map(Vec::len).or_else(of_project).unwrap_or(0)
    }

    /// Names of its points.
    fn names(&self) -> Vec<String> {
        match (&self.epoch.points, &self.epoch.adjustment, &self.epoch.project) {
            (Some(points), ..) => points.iter().map(|p| p.id.clone()).collect(),
            (None, Some(adjustment), _) => adjustment.points.iter().map(|p| p.id.clone()).collect(),
            (None, None, project) => project.iter().flat_map(|p| &p.points).map(|p| p.id.clone()).collect(),
        }
    }

    pub fn is_list(&self) -> bool {
        self.epoch.points.is_some()
    }
}

/// Result of a comparison, with its input.
pub struct ComparisonRun {
    epochs: Vec<EpochEntry>,
    options: Options,
    pub found: Monitoring,
}

/// Pages of the comparison of epochs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MonitoringPage {
    /// Epochs and options.
    #[default]
    Setup,
    /// Movements between two epochs.
    Displacements,
    /// One point through all epochs.
    Time,
    /// Pages to print.
    Report,
}

/// From where the picture is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Seen {
    /// From the front, the left and above: all axes are seen.
    #[default]
    Oblique,
    Top,
    Front,
    Side,
}

impl Seen {
    /// Right and upward directions: orthogonal unit vectors.
    pub fn axes(self) -> [[f64; 3]; 2] {
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        match self {
            Self::Oblique => {
                let ((sin, cos), (low, high)) = (35f64.to_radians().sin_cos(), 25f64.to_radians().sin_cos());
                [[cos, sin, 0.0], [-sin * low, cos * low, high]]
            }
            Self::Top => [x, y],
            Self::Front => [x, z],
            Self::Side => [y, z],
        }
    }
}

/// The state of monitoring.
#[derive(Clone, Copy, Default)]
pub struct Monitored {
    pub epochs: RwSignal<Vec<EpochEntry>>,
    pub options: RwSignal<Options>,
    pub view: RwSignal<MonitoringPage>,
    /// Files and projects that cannot be an epoch, and why.
    pub problems: RwSignal<Vec<Problem>>,
    pub ran: RwSignal<Option<Arc<ComparisonRun>>>,
    /// Why the last comparison gave nothing.
    pub failure: RwSignal<Option<Error>>,
    /// The epoch that is shown, by its place in the list: its pair is the one with the first.
    pub later: RwSignal<usize>,
    /// The point that is chosen.
    pub point: RwSignal<Option<String>>,
    pub seen: RwSignal<Seen>,
    /// Times the length of displacements in the picture; none: by itself.
    pub factor: RwSignal<Option<f64>>,
    /// The report of what was found.
    pub report: RwSignal<Option<ReportMade>>,
    /// Displacements in photos.
    pub in_photos: RwSignal<Option<in_photos::InPhotos>>,
    given: StoredValue<u64>,
}

/// Share of the extent that the largest displacement, or where it is larger the median ellipse, takes by itself.
const SHARE: f64 = 0.14;

/// The factor at which displacements are well seen.
fn exaggeration(pair: &Pair) -> f64 {
    let (_, size) = extent(pair.points.iter().map(|p| p.xyz));
    let largest = pair.points.iter().map(|p| p.length).fold(0.0, f64::max);
    let mut axes: Vec<f64> = pair.points.iter().filter_map(|p| Some(p.ellipsoid.as_ref()?.semi_axes[0])).collect();
    axes.sort_by(f64::total_cmp);
    let seen = largest.max(axes.get(axes.len() / 2).copied().unwrap_or(0.0));
    if seen > 0.0 && size > 0.0 { round(SHARE * size / seen).max(1.0) } else { 1.0 }
}

impl Monitored {
    /// The result, if it is of the present epochs and options.
    pub fn current(self) -> Option<Arc<ComparisonRun>> {
        let same = |ran: &Arc<ComparisonRun>| {
            let same = |(a, b): (&EpochEntry, &EpochEntry)| a.id == b.id && Arc::ptr_eq(&a.epoch, &b.epoch);
            self.epochs.with(|epochs| ran.epochs.len() == epochs.len() && ran.epochs.iter().zip(epochs).all(same))
                && self.options.with(|options| *options == ran.options)
        };
        self.ran.get().filter(same)
    }

    /// The pair that is shown, and its number.
    pub fn pair(self) -> Option<(usize, Pair)> {
        let ran = self.current()?;
        let number = self.later.get().clamp(1, ran.found.epochs.len() - 1) - 1;
        Some((number, ran.found.pairs.get(number)?.clone()))
    }

    /// Times the length of displacements in pictures.
    pub fn shown_factor(self) -> f64 {
        let own = || self.pair().map_or(1.0, |(_, pair)| exaggeration(&pair));
        self.factor.get().unwrap_or_else(own)
    }

    /// Names of points that every epoch has, in the order of the first.
    pub fn common(self) -> Vec<String> {
        self.epochs.with(|all| {
            let mut all = all.iter().map(EpochEntry::names);
            let Some(first) = all.next() else { return Vec::new() };
            let rest = all.map(|names| names.into_iter().collect::<std::collections::HashSet<_>>()).collect::<Vec<_>>();
            first.into_iter().filter(|name| rest.iter().all(|names| names.contains(name))).collect()
        })
    }

    /// Names of cameras that every epoch has, in the order of the first; none where an epoch is a list.
    pub fn common_cameras(self) -> Vec<String> {
        let of = |entry: &EpochEntry, name: &str| {
            entry.epoch.project.as_ref().is_some_and(|p| p.cameras.iter().any(|camera| camera.id == name))
        };
        self.epochs.with(|all| {
            let first = all.first().and_then(|entry| entry.epoch.project.as_ref());
            let names = first.into_iter().flat_map(|p| p.cameras.iter().map(|camera| camera.id.clone()));
            names.filter(|name| all.iter().all(|entry| of(entry, name))).collect()
        })
    }

    /// The unit of the epochs, if one of them has it.
    pub fn unit(self) -> String {
        let of = |entry: &EpochEntry| {
            entry.epoch.unit.clone().or_else(|| entry.epoch.project.as_ref().map(|p| p.unit.clone()))
        };
        self.epochs.with(|all| all.iter().find_map(of).unwrap_or_default())
    }
}

#[derive(Serialize)]
struct Looking<'a> {
    id: &'a str,
    wanted: &'a [u64],
}

impl Desk {
    /// Shows monitoring; the project on the desk is the first epoch where there is none yet.
    pub fn show_monitoring(self) {
        self.read_shelf();
        let none = self.monitoring.epochs.with_untracked(Vec::is_empty);
        if none && !self.recall_epochs() && self.document.with_untracked(|d| d.current().is_some()) {
            self.add_open_epoch();
        }
        self.go(Step::Monitoring);
    }

    /// Changes the entries of an epoch.
    pub fn edit_epoch(self, id: u64, edit: impl FnOnce(&mut Epoch)) {
        self.monitoring.failure.set(None);
        self.monitoring.epochs.update(|all| {
            if let Some(entry) = all.iter_mut().find(|entry| entry.id == id) {
                let mut epoch = (*entry.epoch).clone();
                edit(&mut epoch);
                if epoch != *entry.epoch {
                    entry.epoch = Arc::new(epoch);
                }
            }
        });
    }

    pub fn remove_epoch(self, id: u64) {
        self.monitoring.failure.set(None);
        self.monitoring.epochs.update(|all| all.retain(|entry| entry.id != id));
    }

    /// Puts an epoch before the one above it.
    pub fn raise_epoch(self, id: u64) {
        self.monitoring.epochs.update(|all| {
            if let Some(place) = all.iter().position(|entry| entry.id == id).filter(|place| *place > 0) {
                all.swap(place, place - 1);
            }
        });
    }

    pub fn choose_comparison(self, choose: impl FnOnce(&mut Options)) {
        self.monitoring.failure.set(None);
        self.monitoring.options.update(choose);
    }

    /// Takes thresholds as typed; both empty: none.
    pub fn set_thresholds(self, warning: &str, alarm: &str) {
        if warning.trim().is_empty() && alarm.trim().is_empty() {
            return self.choose_comparison(|options| options.thresholds = None);
        }
        let number = |typed: &str| crate::format::parse(typed).filter(|x| *x > 0.0);
        let typed = match (warning.trim().is_empty(), alarm.trim().is_empty()) {
            (true, false) => number(alarm).map(|a| (a, a)),
            (false, true) => number(warning).map(|w| (w, w)),
            _ => number(warning).zip(number(alarm)),
        };
        match typed {
            Some((warning, alarm)) if warning <= alarm => self.choose_comparison(|options| {
                let (points, groups) = options.thresholds.take().map(|t| (t.points, t.groups)).unwrap_or_default();
                options.thresholds = Some(Thresholds { all: Limits { warning, alarm }, points, groups });
            }),
            _ => self.warn_here(|| words::thresholds_refused().to_owned()),
        }
    }

    /// Compares the epochs, in a worker.
    pub fn compare_epochs(self) {
        let monitored = self.monitoring;
        let (epochs, options) = (monitored.epochs.get_untracked(), monitored.options.get_untracked());
        monitored.failure.set(None);
        let total = (3 * epochs.len()).saturating_sub(2).max(1);
        let batch = self.start_job(JobKind::Comparing, total, || {});
        let task = CompareEpochs {
            epochs: epochs.iter().map(|entry| (*entry.epoch).clone()).collect(),
            options: options.clone(),
        };
        let on_outcome = move |outcome: TaskOutcome<CompareEpochs>| match outcome {
            TaskOutcome::Progress((done, of)) => self.count_job(batch, done, of),
            TaskOutcome::Done(found, _) => {
                self.end_job();
                let known = |id: &String| found.pairs.iter().any(|pair| pair.points.iter().any(|p| p.id == *id));
                if !monitored.point.with_untracked(|p| p.as_ref().is_some_and(known)) {
                    monitored.point.set(most_moved(&found));
                }
                monitored.later.set(found.epochs.len() - 1);
                monitored.factor.set(None);
                monitored.ran.set(Some(Arc::new(ComparisonRun {
                    epochs: epochs.clone(),
                    options: options.clone(),
                    found,
                })));
                monitored.view.set(MonitoringPage::Displacements);
            }
            TaskOutcome::Failed(Failure::Refused(error)) => {
                self.end_job();
                monitored.failure.set(Some(error));
                // The reason stands above what may be scrolled to.
                page::after(0, || page::focus_first("[data-found=failure]"));
                monitored.view.set(MonitoringPage::Setup);
            }
            TaskOutcome::Failed(failure) => {
                self.end_job();
                self.tell_failure(failure);
            }
        };
        self.tasks.pool.with_value(|pool| pool.submit(batch, task, Vec::new(), on_outcome));
    }

    /// Begins the next epoch of the project on the desk.
    pub fn begin_next_epoch(self) {
        let next = self.document.with_untracked(|d| epoch::next(d, self.open_id()));
        self.over_unsaved(move || {
            self.begin(next.clone());
            self.forget_waiting();
            self.processing.iterations.set(Vec::new());
            self.photos.files.set(std::collections::BTreeMap::new());
            self.photos.others.set_value(Vec::new());
            self.selection.set(Selection::default());
            self.go(Step::Photos);
        });
    }

    /// Compares the project on the desk with the first epoch of its series, and those between them that this browser keeps.
    pub fn compare_with_first(self) {
        let Some(of) = self.document.with_untracked(|d| d.project.epoch.clone()) else { return };
        let monitored = self.monitoring;
        let own = self.open_id();
        monitored.problems.set(Vec::new());
        self.go(Step::Monitoring);
        spawn_local(async move {
            // Of the series that is shown already, everything that was chosen stays.
            let known =
                monitored.epochs.with_untracked(|all| all.first().is_some_and(|e| e.key.as_ref() == Some(&of.key)));
            if !known {
                monitored.epochs.set(Vec::new());
                monitored.options.set(Options::default());
                if of.key.is_empty() || !self.take_kept(of.key.clone(), of.name.clone()).await {
                    monitored.view.set(MonitoringPage::Setup);
                    self.add_open_epoch();
                    return self.say(true, Until::Sight, move || words::first_is_gone(&of.name));
                }
            }
            // What has been adjusted anew is taken anew.
            monitored.epochs.update(|all| all.retain(|e| e.key != own || e.key.is_none()));
            for (key, name) in self.between(&of, own.as_ref()).await {
                self.take_kept(key, name).await;
            }
            self.add_open_epoch();
            self.compare_epochs();
        });
    }

    /// Kept epochs of a series after the first and before the one on the desk, in their order, that are not in the list yet.
    async fn between(self, of: &sightline::project::EpochOf, own: Option<&String>) -> Vec<(String, String)> {
        if of.number < 2 {
            return Vec::new();
        }
        let mut found = Vec::new();
        for one in self.shelf.projects.get_untracked().unwrap_or_default() {
            let listed =
                self.monitoring.epochs.with_untracked(|all| all.iter().any(|e| e.key.as_ref() == Some(&one.id)));
            if listed || one.unreadable || Some(&one.id) == own || one.id == of.key {
                continue;
            }
            let Ok(document) = self.look_into_kept(&one.id).await else { continue };
            if let Some(epoch) = document.project.epoch.as_ref().filter(|e| e.key == of.key && e.number < of.number) {
                found.push((epoch.number, (one.id.clone(), document.project.name.clone())));
            }
        }
        found.sort();
        found.into_iter().map(|(_, one)| one).collect()
    }

    /// Opens the sample of three epochs and compares them.
    pub fn open_sample_epochs(self) {
        let monitored = self.monitoring;
        let batch = self.start_job(JobKind::Comparing, 3, || {});
        let on_outcome = move |outcome: TaskOutcome<SampleEpochs>| match outcome {
            TaskOutcome::Progress((done, of)) => self.count_job(batch, done, of),
            TaskOutcome::Done(epochs, _) => {
                self.end_job();
                monitored.problems.set(Vec::new());
                monitored.epochs.set(Vec::new());
                let thresholds = Some(Thresholds {
                    all: Limits { warning: 2.0, alarm: 4.0 },
                    points: Default::default(),
                    groups: Default::default(),
                });
                for epoch in epochs {
                    self.put_epoch(epoch, None, SAMPLE.to_owned(), None);
                }
                monitored.options.set(Options { thresholds, ..Options::default() });
                self.go(Step::Monitoring);
                self.compare_epochs();
            }
            TaskOutcome::Failed(failure) => {
                self.end_job();
                self.tell_failure(failure);
            }
        };
        self.tasks.pool.with_value(|pool| pool.submit(batch, SampleEpochs {}, Vec::new(), on_outcome));
    }

    /// Has the report of what was found made, in the language of the desk.
    pub fn report_epochs(self) {
        let monitored = self.monitoring;
        let own = self.document.with_untracked(|d| d.project.report.clone());
        let settings = ReportSettings {
            language: Some(speech().pages()),
            date: page::today(),
            operator: own.operator,
            paper: own.paper,
            ..ReportSettings::default()
        };
        let Some(ran) = monitored.current() else { return monitored.report.set(None) };
        let task = ReportEpochs { found: ran.found.clone(), options: ran.options.clone(), settings };
        let on_outcome = move |outcome: TaskOutcome<ReportEpochs>| match outcome {
            TaskOutcome::Done(made, _) => monitored.report.set(Some(made)),
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        self.ask(Stop(background::report, || ()), task, Vec::new(), on_outcome);
    }

    /// Hands over what was found: `csv`, `json`, or `dxf` and `gltf` of the pair that is shown.
    pub fn export_monitoring(self, format: &'static str, factor: f64) {
        let Some((ran, pair)) = untrack(|| self.monitoring.current().zip(self.monitoring.pair())) else { return };
        let (number, pair) = pair;
        let stem = match format {
            "dxf" | "gltf" => file_stem(&format!("{} {}", pair.from, pair.to)),
            _ => "displacements".to_owned(),
        };
        // glTF in its binary form, one file.
        let ending = if format == "gltf" { "glb" } else { format };
        let task = ExportMonitoring { found: ran.found.clone(), format: format.to_owned(), pair: number, factor };
        let on_outcome = move |outcome: TaskOutcome<ExportMonitoring>| match outcome {
            TaskOutcome::Done((), bytes) => {
                let kind = if format == "csv" { "text/csv" } else { "application/octet-stream" };
                bytes.iter().for_each(|bytes| self.hand_over(&format!("{stem}.{ending}"), kind, bytes));
            }
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        self.ask(Stop(background::file, || ()), task, Vec::new(), on_outcome);
    }
}

/// The point of the last epoch that moved most, of those that moved.
fn most_moved(found: &Monitoring) -> Option<String> {
    let pair = found.pairs.get(found.epochs.len() - 2)?;
    let by_test = |p: &&sightline::monitoring::Displacement| p.test.as_ref().map_or(0.0, |t| t.statistic);
    let of = |moved: bool| pair.points.iter().filter(move |p| p.moved == moved);
    let largest = |a: &&sightline::monitoring::Displacement, b: &&sightline::monitoring::Displacement| {
        by_test(a).total_cmp(&by_test(b))
    };
    of(true).max_by(largest).or_else(|| of(false).max_by(largest)).map(|p| p.id.clone())
}
