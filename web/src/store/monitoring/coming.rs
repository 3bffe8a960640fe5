//! Epochs that come: from the desk, from projects kept in this browser, from project files, from lists of points and their matrices.

use std::collections::HashMap;
use std::sync::Arc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::adjustment::Termination;
use sightline::error::{Error, Place, Reason as Refusal};
use sightline::monitoring::Epoch;
use sightline::project::Project;
use sightline_exchange::control_csv::TableChoices;
use sightline_exchange::{encoding, epochs as lists, rows};
use sightline_protocol::{Content, Unpack, Unpacked};

use super::{EpochEntry, Looking};
use crate::browser::file::NamedFile;
use crate::browser::storage::Fault;
use crate::document::{AdjustmentResult, Document};
use crate::edit::epoch;
use crate::i18n::{background, text};
use crate::store::background::Stop;
use crate::store::journal::{Book, replay};
use crate::store::pool::{Failure, TaskOutcome};
use crate::store::saving::{is_project, rename};
use crate::store::{Desk, Problem, Reason};

impl Desk {
    /// Adds the project on the desk as an epoch.
    pub fn add_open_epoch(self) {
        let document = self.document.get_untracked();
        let key = self.open_id();
        let date = self.date_of_photos().or_else(|| epoch::date_in(&document.project.name));
        match of_document(&document, date) {
            Ok(epoch) => self.put_epoch(epoch, key, String::new(), None),
            Err(problem) => self.monitoring.problems.update(|all| all.push(problem)),
        }
    }

    /// When the photos of the project on the desk were taken, if their files contain it.
    fn date_of_photos(self) -> Option<String> {
        self.photos.files.with_untracked(|files| {
            let dates = files.values().filter_map(|file| file.info.date.as_deref());
            dates.min().and_then(epoch::date_in)
        })
    }

    /// Adds a project of this browser as an epoch.
    pub fn add_kept_epoch(self, key: String, name: String) {
        if self.open_id().as_ref() == Some(&key) {
            return self.add_open_epoch();
        }
        spawn_local(async move {
            self.take_kept(key, name).await;
        });
    }

    pub(super) async fn take_kept(self, key: String, name: String) -> bool {
        let refused = |reason| self.monitoring.problems.update(|all| all.push(Problem { file: name.clone(), reason }));
        match self.look_into_kept(&key).await {
            Ok(document) => match of_document(&document, epoch::date_in(&document.project.name)) {
                Ok(epoch) => {
                    self.put_epoch(epoch, Some(key), String::new(), None);
                    return true;
                }
                Err(problem) => self.monitoring.problems.update(|all| all.push(problem)),
            },
            Err(fault) => refused(Reason::Unreadable(format!("{}: {}", fault.name, fault.detail))),
        }
        false
    }

    /// Project and result of a project that is kept in this browser, without opening it.
    pub(super) async fn look_into_kept(self, id: &str) -> Result<Document, Fault> {
        let fault = |detail: String| Fault { name: "DataError".to_owned(), detail };
        let storage = self.storage().ok_or_else(|| fault("no storage".to_owned()))?;
        let (notes, _) = storage.call::<Vec<String>>("look", &Looking { id, wanted: &[] }, Vec::new()).await?;
        let replayed = replay(&notes).map_err(fault)?;
        let state = replayed.present.ok_or_else(|| fault("no state".to_owned()))?;
        let mut texts = HashMap::new();
        let book = Book::default();
        loop {
            let wanted = book.wanted_of_result(&state, &texts).map_err(fault)?;
            if wanted.is_empty() {
                break;
            }
            let (_, parts) = storage.call::<Vec<String>>("look", &Looking { id, wanted: &wanted }, Vec::new()).await?;
            texts.extend(wanted.iter().copied().zip(parts.into_iter().map(|part| part.text().unwrap_or_default())));
        }
        let mut document = Book::result_of(&state, &texts).map_err(fault)?;
        if let Some(name) = replayed.name {
            rename(&mut document, name);
        }
        Ok(document)
    }

    /// Puts an epoch behind the others, under a name that none of them has.
    pub(super) fn put_epoch(self, mut epoch: Epoch, key: Option<String>, source: String, matrix: Option<String>) {
        let monitored = self.monitoring;
        let known = |name: &str| monitored.epochs.with_untracked(|all| all.iter().any(|e| e.epoch.name == name));
        if key.is_some() && monitored.epochs.with_untracked(|all| all.iter().any(|e| e.key == key)) {
            return;
        }
        let base = if epoch.name.trim().is_empty() { text::without_name().to_owned() } else { epoch.name.clone() };
        epoch.name = std::iter::once(base.clone())
            .chain((2..).map(|n| format!("{base} {n}")))
            .find(|n| !known(n))
            .unwrap_or(base);
        monitored.given.update_value(|n| *n += 1);
        let entry = EpochEntry { id: monitored.given.get_value(), epoch: Arc::new(epoch), key, source, matrix };
        monitored.failure.set(None);
        if monitored.epochs.with_untracked(Vec::is_empty) {
            self.recall_options(&entry);
        }
        monitored.epochs.update(|all| all.push(entry));
    }

    /// Takes files as epochs: project files, lists of points, matrices that belong to lists.
    pub fn take_epochs(self, files: Vec<NamedFile>) {
        self.monitoring.problems.set(Vec::new());
        let (projects, texts): (Vec<_>, Vec<_>) = files.into_iter().partition(|file| is_project(&file.name));
        for file in projects {
            self.unpack_epoch(file);
        }
        spawn_local(async move {
            let Some(all) = self.contents(texts).await else { return };
            let mut matrices = Vec::new();
            for (name, bytes) in all {
                match encoding::text(&bytes) {
                    Ok(content) if is_matrix(&content) => matrices.push((name, content)),
                    Ok(content) => self.take_list(name, &content),
                    Err(error) => self.refuse_epoch(name, error),
                }
            }
            for (name, content) in matrices {
                self.take_matrix(name, &content);
            }
        });
    }

    fn refuse_epoch(self, file: String, error: Error) {
        self.monitoring.problems.update(|all| all.push(Problem { file, reason: Reason::Engine(error) }));
    }

    fn unpack_epoch(self, file: NamedFile) {
        let name = file.name.clone();
        let on_outcome = move |outcome: TaskOutcome<Unpack>| match outcome {
            TaskOutcome::Done(Unpacked { content: Content { mut project, adjustment, .. }, .. }, _) => {
                let stem = name.rsplit_once('.').map_or(name.as_str(), |(stem, _)| stem);
                if project.name.is_empty() {
                    stem.clone_into(&mut project.name);
                }
                let date = epoch::date_in(&project.name).or_else(|| epoch::date_in(stem));
                let epoch =
                    Epoch { name: project.name.clone(), date, project: Some(project), adjustment, ..Epoch::default() };
                self.put_epoch(epoch, None, name.clone(), None);
            }
            TaskOutcome::Failed(Failure::Refused(error)) => self.refuse_epoch(name.clone(), error),
            TaskOutcome::Failed(Failure::Unreadable(detail) | Failure::Lost(detail)) => {
                let problem = Problem { file: name.clone(), reason: Reason::Unreadable(detail) };
                self.monitoring.problems.update(|all| all.push(problem));
            }
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        self.ask(Stop(background::file, || ()), Unpack {}, vec![file.content], on_outcome);
    }

    fn take_list(self, name: String, content: &str) {
        match lists::points(content, TableChoices::default()) {
            Ok(list) => {
                let stem = name.rsplit_once('.').map_or(name.as_str(), |(stem, _)| stem).to_owned();
                let date = epoch::date_in(&stem);
                let epoch = Epoch { name: stem, date, points: Some(list.points), unit: list.unit, ..Epoch::default() };
                self.put_epoch(epoch, None, name, None);
            }
            Err(error) => self.refuse_epoch(name, error),
        }
    }

    /// Gives a matrix to the list that it belongs to: the one of the same name, else the only one with as many points.
    fn take_matrix(self, name: String, content: &str) {
        let size = rows(content).len();
        let stem = |name: &str| name.split(['.', ' ']).next().unwrap_or_default().to_lowercase();
        let fits = |entry: &EpochEntry| {
            entry.epoch.points.as_ref().is_some_and(|points| [3 * points.len(), 3 * points.len() + 1].contains(&size))
        };
        let place = self.monitoring.epochs.with_untracked(|all| {
            let fitting = (0..all.len()).filter(|&k| fits(&all[k])).collect::<Vec<_>>();
            let own = stem(&name);
            let begins = |k: &&usize| {
                let list = stem(&all[**k].source);
                !list.is_empty() && (own.starts_with(&list) || list.starts_with(&own))
            };
            let named = fitting.iter().find(begins).copied();
            let free = fitting.iter().filter(|&&k| all[k].matrix.is_none()).collect::<Vec<_>>();
            named.or_else(|| (free.len() == 1).then(|| *free[0]))
        });
        let Some(place) = place else {
            let reason = Refusal::EpochMatrix {
                rows: size,
                expected: 3 * self
                    .monitoring
                    .epochs
                    .with_untracked(|all| all.iter().rfind(|e| e.is_list()).map_or(0, EpochEntry::points)),
            };
            return self.refuse_epoch(name, Error::Invalid { reason, at: Place::default() });
        };
        let names = self.monitoring.epochs.with_untracked(|all| all[place].names());
        match lists::covariance(content, &names) {
            Ok(covariance) => self.monitoring.epochs.update(|all| {
                let entry = &mut all[place];
                entry.epoch = Arc::new(Epoch { covariance: Some(covariance), ..(*entry.epoch).clone() });
                entry.matrix = Some(name);
            }),
            Err(error) => self.refuse_epoch(name, error),
        }
    }
}

/// An epoch of a document with a current result; else why it is none.
fn of_document(document: &Document, date: Option<String>) -> Result<Epoch, Problem> {
    let name = document.project.name.clone();
    let refused = |reason| Err(Problem { file: name.clone(), reason });
    let Some(result) = document.current() else {
        let stale = document.result.is_some();
        return refused(if stale { Reason::EpochOutOfDate } else { Reason::EpochNotAdjusted });
    };
    if result.adjustment.termination != Termination::Converged {
        let reason = Refusal::EpochNotConverged { name: name.clone() };
        return refused(Reason::Engine(Error::Invalid { reason, at: Place::default() }));
    }
    let AdjustmentResult { oriented, adjustment, .. } = &**result;
    let project = Project { name: name.clone(), ..(**oriented).clone() };
    let own = Some(document.project.report.date.clone()).filter(|date| sightline::monitoring::days(date).is_some());
    let date = date.or(own);
    Ok(Epoch { name, date, project: Some(project), adjustment: Some(adjustment.clone()), ..Epoch::default() })
}

/// Whether a text is a covariance matrix: as many columns as rows, three for each point, in full and symmetric, or row k with k fields.
fn is_matrix(content: &str) -> bool {
    let number = |field: &String| field.parse::<f64>().ok().filter(|x| x.is_finite());
    let mut all = rows(content);
    if all.first().is_some_and(|row| row.fields.iter().any(|field| number(field).is_none())) {
        all.remove(0);
    }
    let n = all.len();
    if n == 0 || !n.is_multiple_of(3) {
        return false;
    }
    let Some(values) =
        all.iter().map(|row| row.fields.iter().map(number).collect::<Option<Vec<f64>>>()).collect::<Option<Vec<_>>>()
    else {
        return false;
    };
    let triangle = values.iter().enumerate().all(|(k, row)| row.len() == k + 1);
    let full = values.iter().all(|row| row.len() == n);
    let symmetric = || {
        (0..n).all(|i| {
            (0..i).all(|j| {
                (values[i][j] - values[j][i]).abs() <= 1e-3 * (values[i][i] * values[j][j]).abs().sqrt()
                    || values[j][i] == 0.0
            })
        })
    };
    triangle || full && symmetric()
}

#[cfg(test)]
mod tests;
