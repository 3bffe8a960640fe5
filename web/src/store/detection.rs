//! Targets: each photo is a task of the worker pool; its targets are added to the document as soon as they arrive.

use std::cell::Cell;
use std::rc::Rc;

use leptos::prelude::*;
use sightline::detection::Detection;
use sightline::ring_code::Family;
use sightline_protocol::Detect;

use super::pool::{Failure, TaskOutcome};
use super::{Desk, JobKind, PhotoFile, Until};
use crate::document::{Change, Document};
use crate::edit::{attaching, targets};
use crate::i18n::{errors, text};

impl Desk {
    /// Detects the targets of every photo whose file is available.
    pub fn detect_targets(self) {
        let options = self.processing.detect_options.get_untracked();
        let photos = self.document.with_untracked(|d| {
            let here = |id: &String| self.photos.files.with_untracked(|files| files.get(id).map(|f| f.content.clone()));
            d.project.photos.iter().filter_map(|p| here(&p.id).map(|file| (p.id.clone(), file))).collect::<Vec<_>>()
        });
        if photos.is_empty() {
            self.warn(|| text::no_photo_files().to_owned());
            return;
        }
        let largest =
            self.photos.files.with_untracked(|files| files.values().map(PhotoFile::pixels).fold(0.0, f64::max));
        self.tasks.pool.with_value(|pool| pool.expect_pixels(largest));
        // One undo step for all photos; the targets of each photo are added to it when they arrive.
        let Some(asked) = self.start_change(Change::TargetsDetected, |_| {}) else { return };
        let asked = Rc::new(Cell::new(asked));
        let batch = self.start_job(JobKind::Detecting, photos.len(), || {});
        for (id, file) in photos {
            let asked = asked.clone();
            let on_outcome = move |outcome: TaskOutcome<Detect>| {
                match outcome {
                    TaskOutcome::Done(detection, _) => self.add_detection(&asked, &id, detection),
                    TaskOutcome::Failed(Failure::Refused(error)) => {
                        let photo = id.clone();
                        self.say(true, Until::NextWork, move || text::photo_failed(&photo, errors::sentence(&error)));
                    }
                    TaskOutcome::Failed(Failure::Unreadable(detail) | Failure::Lost(detail)) => {
                        let photo = id.clone();
                        self.say(true, Until::NextWork, move || text::photo_failed(&photo, text::worker_lost(&detail)));
                    }
                    TaskOutcome::Progress(nothing) => match nothing {},
                }
                if self.step_job(batch) {
                    self.end_job();
                    // Codes have named points, so distances of stored scale bars can be added.
                    self.take_bars();
                }
            };
            let task = Detect { options: options.clone() };
            self.tasks.pool.with_value(|pool| pool.submit(batch, task, vec![file], on_outcome));
        }
    }

    /// `asked` is the change that the detection belongs to.
    fn add_detection(self, asked: &Cell<u64>, photo: &str, detection: Detection) {
        if !detection.damaged_rows.is_empty() {
            let rows = detection.damaged_rows.iter().map(|[first, last]| format!("{}–{last}", first + 1));
            let (photo, rows) = (photo.to_owned(), rows.collect::<Vec<_>>().join(", "));
            self.warn(move || text::rows_damaged(&photo, &rows));
        }
        if let Some(page) = detection.page {
            let photo = photo.to_owned();
            if page.skipped > 0 {
                self.warn(move || text::page_measured(&photo, page.number, page.of));
            } else {
                self.warn(move || text::first_page_measured(&photo, page.of));
            }
        }
        let sha256 = self
            .photos
            .files
            .with_untracked(|files| files.get(photo).map(|file| file.sha256.clone()))
            .unwrap_or_default();
        let family = match self.processing.detect_options.with_untracked(|o| o.codes.families()) {
            [family] => Some(*family),
            _ => None,
        };
        let take = |document: &mut Document| {
            // The photo was removed meanwhile.
            if document.project.photos.iter().all(|other| other.id != photo) {
                return;
            }
            if attaching::is_unrecorded(&document.project, photo) {
                attaching::record(document.project_mut(), photo, &sha256);
            }
            targets::take_detection(document, photo, detection.clone(), family);
        };
        // The detection was undone and followed by another change: later results are a separate undo step.
        if !self.arrive(asked.get(), take)
            && let Some(own) = self.start_change(Change::TargetsDetected, take)
        {
            asked.set(own);
        }
    }

    /// Reads the rings as codes of this family, now and in photos to come.
    pub fn choose_family(self, family: Family) {
        self.processing.detect_options.update(|o| o.codes = family.into());
        self.change(Change::TargetsDetected, |document| targets::take_family(document, family));
    }
}
