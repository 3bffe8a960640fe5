//! Targets: every photo is a task of the worker pool; what is found is in the document at once.

use std::cell::Cell;
use std::rc::Rc;

use leptos::prelude::*;
use sightline::detection::{Channel, Detection};
use sightline::ring_code::Family;
use sightline_protocol::Detect;

use super::document::{Change, Document};
use super::pool::{Failure, Outcome};
use super::{Desk, JobKind, PhotoFile, Until};
use crate::edit::{attaching, cameras, targets};
use crate::i18n::{errors, text};

impl Desk {
    /// Finds the targets of every photo whose file is here.
    pub fn detect_targets(self) {
        let options = self.detect_options.get_untracked();
        let photos = self.document.with_untracked(|d| {
            let here = |id: &String| self.files.with_untracked(|files| files.get(id).map(|f| f.content.clone()));
            d.project.photos.iter().filter_map(|p| here(&p.id).map(|file| (p.id.clone(), file))).collect::<Vec<_>>()
        });
        if photos.is_empty() {
            self.warn(|| text::no_photo_files().to_owned());
            return;
        }
        let largest = self.files.with_untracked(|files| files.values().map(PhotoFile::pixels).fold(0.0, f64::max));
        self.pool.with_value(|pool| pool.expect_pixels(largest));
        // One change for all photos; each photo's targets join it as they come.
        let Some(asked) = self.start_change(Change::TargetsDetected, |_| {}) else { return };
        let asked = Rc::new(Cell::new(asked));
        let channel = options.channel;
        let batch = self.start_job(JobKind::Detecting, photos.len(), || {});
        for (id, file) in photos {
            let asked = asked.clone();
            let on_outcome = move |outcome: Outcome<Detect>| {
                match outcome {
                    Outcome::Done(detection, _) => self.add_detection(&asked, &id, detection, channel),
                    Outcome::Failed(Failure::Refused(error)) => {
                        let photo = id.clone();
                        self.say(true, Until::NextWork, move || text::photo_failed(&photo, errors::sentence(&error)));
                    }
                    Outcome::Failed(Failure::Unreadable(detail) | Failure::Lost(detail)) => {
                        let photo = id.clone();
                        self.say(true, Until::NextWork, move || text::photo_failed(&photo, text::worker_lost(&detail)));
                    }
                    Outcome::Progress(nothing) => match nothing {},
                }
                if self.step_job(batch) {
                    self.end_job();
                    // Names have come from codes: bars that are kept give their distances by themselves.
                    self.take_bars();
                }
            };
            let task = Detect { options: options.clone() };
            self.pool.with_value(|pool| pool.submit(batch, task, vec![file], on_outcome));
        }
    }

    /// `asked` is the change that the detection belongs to.
    fn add_detection(self, asked: &Cell<u64>, photo: &str, detection: Detection, channel: Channel) {
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
        let sha256 =
            self.files.with_untracked(|files| files.get(photo).map(|file| file.sha256.clone())).unwrap_or_default();
        let family = match self.detect_options.with_untracked(|o| o.codes.families()) {
            [family] => Some(*family),
            _ => None,
        };
        let take = |document: &mut Document| {
            // Taken out meanwhile.
            if document.project.photos.iter().all(|other| other.id != photo) {
                return;
            }
            if !cameras::is_measured_in(&document.project, photo, channel, &detection) {
                cameras::measured_in(document.project_mut(), photo, channel, &detection);
            }
            if attaching::is_unrecorded(&document.project, photo) {
                attaching::record(document.project_mut(), photo, &sha256);
            }
            targets::take_detection(document, photo, detection.clone(), family);
        };
        // Undone, and something else done in its place: what still comes is a change of its own.
        if !self.arrive(asked.get(), take)
            && let Some(own) = self.start_change(Change::TargetsDetected, take)
        {
            asked.set(own);
        }
    }

    /// Reads the rings as codes of this family, now and in photos to come.
    pub fn choose_family(self, family: Family) {
        self.detect_options.update(|o| o.codes = family.into());
        self.change(Change::TargetsDetected, |document| targets::take_family(document, family));
    }
}
