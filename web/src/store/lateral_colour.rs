//! Lateral colour of a photo, measured on request; the last results are kept.

use std::sync::Arc;

use leptos::prelude::*;
use sightline::detection::{ColoursApart, DetectOptions};
use sightline_protocol::MeasureColours;

use super::background::Stop;
use super::pool::{Failure, TaskOutcome};
use super::{Desk, Until};
use crate::i18n::background as words;
use crate::i18n::{errors, text};

/// Maximum number of photos whose measurements are kept.
const KEPT: usize = 32;

/// Lateral colour of a photo: requested, or measured.
#[derive(Clone)]
pub struct ColourMeasurement {
    digest: u64,
    options: DetectOptions,
    /// `None` while the measurement is running.
    pub found: Option<Arc<ColoursApart>>,
}

impl Desk {
    /// The measurement of a photo with the present options, if it was requested.
    pub fn colours_of(self, photo: &str) -> Option<ColourMeasurement> {
        let digest = self.photos.files.with(|files| files.get(photo).map(|file| file.digest))?;
        let options = self.processing.detect_options.get();
        self.photos.colours.with(|all| all.iter().find(|a| a.digest == digest && a.options == options).cloned())
    }

    /// Measures the targets of a photo separately in each colour channel, in a worker.
    pub fn measure_colours(self, photo: &str) {
        let Some((digest, file)) =
            self.photos.files.with_untracked(|files| files.get(photo).map(|file| (file.digest, file.content.clone())))
        else {
            return self.warn(|| text::no_photo_files().to_owned());
        };
        let options = self.processing.detect_options.get_untracked();
        self.photos.colours.update(|all| {
            all.retain(|one| one.digest != digest);
            if all.len() >= KEPT {
                all.remove(0);
            }
            all.push(ColourMeasurement { digest, options: options.clone(), found: None });
        });
        let photo = photo.to_owned();
        let task = MeasureColours { options: options.clone() };
        let on_outcome = move |outcome: TaskOutcome<MeasureColours>| {
            let failed = |words: Box<dyn Fn() -> String + Send + Sync>| {
                self.photos.colours.update(|all| all.retain(|one| one.digest != digest));
                let photo = photo.clone();
                self.say(true, Until::NextWork, move || text::photo_failed(&photo, words()));
            };
            match outcome {
                TaskOutcome::Progress(nothing) => match nothing {},
                TaskOutcome::Done(found, _) => {
                    self.photos.colours.update(|all| {
                        if let Some(one) = all.iter_mut().find(|a| a.digest == digest && a.options == options) {
                            one.found = Some(Arc::new(found));
                        }
                    });
                }
                TaskOutcome::Failed(Failure::Refused(error)) => failed(Box::new(move || errors::sentence(&error))),
                TaskOutcome::Failed(Failure::Unreadable(detail) | Failure::Lost(detail)) => {
                    failed(Box::new(move || text::worker_lost(&detail)));
                }
            }
        };
        let stopped =
            move || self.photos.colours.update(|all| all.retain(|one| one.digest != digest || one.found.is_some()));
        self.ask_in_turn(Stop(words::colours, stopped), task, vec![file], on_outcome);
    }
}
