//! Lateral colour of a photo, measured on request; the last results are kept and can be used in a camera.

use std::sync::Arc;

use leptos::prelude::*;
use sightline::detection::{ColoursApart, DetectOptions};
use sightline_protocol::{DifferColours, MeasureColours};

use super::document::Change;
use super::lasting::Stop;
use super::pool::{Failure, Outcome};
use super::{Desk, Until};
use crate::edit::cameras;
use crate::i18n::lasting as words;
use crate::i18n::{errors, text};

/// Photos kept.
const KEPT: usize = 32;

/// The colours of a photo, or the asking for them.
#[derive(Clone)]
pub struct Apart {
    digest: u64,
    options: DetectOptions,
    /// Absent while it lasts.
    pub found: Option<Arc<ColoursApart>>,
}

impl Desk {
    /// What is known of a photo's colours with the options of now.
    pub fn apart_of(self, photo: &str) -> Option<Apart> {
        let digest = self.files.with(|files| files.get(photo).map(|file| file.digest))?;
        let options = self.detect_options.get();
        self.apart.with(|all| all.iter().find(|a| a.digest == digest && a.options == options).cloned())
    }

    /// Measures the targets of a photo in every colour.
    pub fn measure_apart(self, photo: &str) {
        let Some((digest, file)) =
            self.files.with_untracked(|files| files.get(photo).map(|file| (file.digest, file.content.clone())))
        else {
            return self.warn(|| text::no_photo_files().to_owned());
        };
        let options = self.detect_options.get_untracked();
        self.apart.update(|all| {
            all.retain(|apart| apart.digest != digest);
            if all.len() >= KEPT {
                all.remove(0);
            }
            all.push(Apart { digest, options: options.clone(), found: None });
        });
        let photo = photo.to_owned();
        let task = MeasureColours { options: options.clone() };
        let on_outcome = move |outcome: Outcome<MeasureColours>| {
            let failed = |words: Box<dyn Fn() -> String + Send + Sync>| {
                self.apart.update(|all| all.retain(|apart| apart.digest != digest));
                let photo = photo.clone();
                self.say(true, Until::NextWork, move || text::photo_failed(&photo, words()));
            };
            match outcome {
                Outcome::Progress(nothing) => match nothing {},
                Outcome::Done(found, _) => {
                    let colours = found.of_photo(&photo);
                    self.apart.update(|all| {
                        if let Some(apart) = all.iter_mut().find(|a| a.digest == digest && a.options == options) {
                            apart.found = Some(Arc::new(found));
                        }
                    });
                    // The report tells it, whatever is measured next; a photo that was taken out meanwhile has no colours.
                    if self.document.with_untracked(|d| d.project.photos.iter().any(|p| p.id == photo)) {
                        self.edit_report(|settings| settings.take_colours(colours));
                    }
                }
                Outcome::Failed(Failure::Refused(error)) => failed(Box::new(move || errors::sentence(&error))),
                Outcome::Failed(Failure::Unreadable(detail) | Failure::Lost(detail)) => {
                    failed(Box::new(move || text::worker_lost(&detail)));
                }
            }
        };
        let stopped =
            move || self.apart.update(|all| all.retain(|apart| apart.digest != digest || apart.found.is_some()));
        self.ask_in_turn(Stop(words::colours, stopped), task, vec![file], on_outcome);
    }

    /// Lets a camera add, for photos measured in red or blue, what its photos whose colours were measured apart tell.
    pub fn hold_colours(self, camera: &str) {
        let found = self.document.with_untracked(|d| {
            let camera = d.project.cameras.iter().find(|c| c.id == camera)?;
            Some((camera.clone(), cameras::as_known(d, camera), cameras::measured_apart(&d.project, &camera.id)))
        });
        let Some((taken, camera, measured)) = found else { return };
        let id = camera.id.clone();
        let on_outcome = move |outcome: Outcome<DifferColours>| match outcome {
            Outcome::Progress(nothing) => match nothing {},
            Outcome::Done(colours, _) => {
                // They belong to the parameters that they were made for.
                let same = self.document.with_untracked(|d| d.project.cameras.contains(&taken));
                if same {
                    let change = Change::ColoursTaken { camera: id.clone() };
                    self.change(change, |document| cameras::set_colours(document.project_mut(), &id, colours));
                }
            }
            Outcome::Failed(Failure::Refused(error)) => self.warn_error(error),
            Outcome::Failed(Failure::Unreadable(detail) | Failure::Lost(detail)) => {
                self.say(true, Until::NextWork, move || text::worker_lost(&detail));
            }
        };
        self.ask_in_turn(Stop(words::lens_colours, || ()), DifferColours { camera, measured }, Vec::new(), on_outcome);
    }

    /// Has a camera add nothing for other colours any more.
    pub fn forget_colours(self, camera: &str) {
        self.change(Change::ColoursForgotten { camera: camera.to_owned() }, |document| {
            cameras::set_colours(document.project_mut(), camera, Default::default());
        });
    }
}
