//! Calibrating a camera: a project for it, what its photos cover, parts of the photos against each other.

use std::sync::Arc;

use leptos::prelude::*;
use sightline::adjust::apply;
use sightline::adjustment::AdjustOptions;
use sightline::calibration::{Coverage, CrossOptions, CrossValidation};
use sightline::project::Project;
use sightline_protocol::{CoverPhotos, CrossValidate};

use super::background::Stop;
use super::models::CameraResult;
use super::pool::TaskOutcome;
use super::{Desk, Step};
use crate::browser::page;
use crate::document::Document;
use crate::i18n::calibrating as words;

/// The document with what its last adjustment found, where that belongs to it.
fn with_result(document: &Document) -> Project {
    let result = document.current();
    result.map_or_else(|| (*document.project).clone(), |result| apply(&result.oriented, &result.adjustment))
}

impl Desk {
    /// Begins a project for the calibration of a camera.
    pub fn calibrate_anew(self) {
        self.over_unsaved(move || {
            let mut document = Document::default();
            document.project_mut().name = self.name_apart(format!("{} {}", words::calibration(), page::today()));
            self.begin_with(document);
            self.go(Step::Calibrate);
        });
    }

    /// Coverage of the image by the targets of a camera's photos, for the present document.
    pub fn coverage_of(self, camera: &str) -> Option<Arc<Coverage>> {
        let covered = self.models.covered.with(|all| all.iter().find(|covered| covered.camera == camera).cloned())?;
        self.document.with(|d| Arc::ptr_eq(&d.project, &covered.project)).then_some(covered.found)
    }

    /// Looks what the photos of a camera cover.
    pub fn look_at_coverage(self, camera: &str) {
        let (of, project) = self.document.with_untracked(|d| (d.project.clone(), with_result(d)));
        let task = CoverPhotos { project, camera: camera.to_owned() };
        let camera = camera.to_owned();
        let on_outcome = move |outcome: TaskOutcome<CoverPhotos>| match outcome {
            TaskOutcome::Progress(nothing) => match nothing {},
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Done(found, _) => {
                let covered = CameraResult { camera: camera.clone(), project: of.clone(), found: Arc::new(found) };
                self.models.covered.update(|all| {
                    all.retain(|other| other.camera != covered.camera);
                    all.push(covered);
                });
            }
        };
        self.ask(Stop(words::covering, || ()), task, Vec::new(), on_outcome);
    }

    /// The parts of a camera's photos against each other, of the document as it stands.
    pub fn cross_validation_of(self, camera: &str) -> Option<Arc<CrossValidation>> {
        let crossed = self.models.crossed.get().filter(|crossed| crossed.camera == camera)?;
        self.document.with(|d| Arc::ptr_eq(&d.project, &crossed.project)).then_some(crossed.found)
    }

    /// Calibrates a camera from each half of its photos.
    pub fn cross_validate(self, camera: &str) {
        if !self.may_change() {
            return;
        }
        let (of, project, own) =
            self.document.with_untracked(|d| (d.project.clone(), with_result(d), d.options.clone()));
        // What rejects or weakens observations by their residuals would take a wrong model for noise.
        let adjust = AdjustOptions { snooping: false, robust: None, variance_components: None, ..own };
        let options = CrossOptions { camera: Some(camera.to_owned()), adjust, ..CrossOptions::default() };
        let camera = camera.to_owned();
        let on_outcome = move |outcome: TaskOutcome<CrossValidate>| match outcome {
            TaskOutcome::Progress(nothing) => match nothing {},
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Done(found, _) => {
                let crossed = CameraResult { camera: camera.clone(), project: of.clone(), found: Arc::new(found) };
                self.models.crossed.set(Some(crossed));
            }
        };
        self.ask_in_turn(Stop(words::crossing, || ()), CrossValidate { project, options }, Vec::new(), on_outcome);
    }
}
