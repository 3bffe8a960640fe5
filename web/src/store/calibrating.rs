//! Calibrating a camera: a project for it, what its photos cover, parts of the photos against each other.

use std::sync::Arc;

use leptos::prelude::*;
use sightline::adjust::apply;
use sightline::adjustment::{AdjustOptions, AdjustedCamera};
use sightline::calibration::{Coverage, CrossOptions, CrossValidation};
use sightline::project::Project;
use sightline_protocol::{CameraJudged, CoverPhotos, CrossValidate, JudgeCamera};

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

    /// Whether the present adjustment has standard errors of a camera's common interior orientation.
    pub fn is_calibrated(self, camera: &str) -> bool {
        let has = |found: &AdjustedCamera| {
            found.camera.id == camera && found.photo.is_none() && !found.correlation.names.is_empty()
        };
        self.document.with(|d| d.current().is_some_and(|result| result.adjustment.cameras.iter().any(has)))
    }

    /// How well a camera predicts pixels, for the present adjustment.
    pub fn judged_camera(self, camera: &str) -> Option<Arc<CameraJudged>> {
        let judged = self.models.judged.get().filter(|judged| judged.camera == camera)?;
        let is_present = |d: &Document| d.current().is_some_and(|result| Arc::ptr_eq(&result.input, &judged.project));
        self.document.with(is_present).then_some(judged.found)
    }

    /// Computes how well a camera predicts pixels.
    pub fn judge_camera(self, camera: &str) {
        let Some((of, task)) = self.document.with_untracked(|d| {
            let result = d.current()?;
            let (project, adjustment) = ((*result.oriented).clone(), result.adjustment.clone());
            Some((result.input.clone(), JudgeCamera { project, adjustment, camera: camera.to_owned() }))
        }) else {
            return;
        };
        let camera = camera.to_owned();
        let on_outcome = move |outcome: TaskOutcome<JudgeCamera>| match outcome {
            TaskOutcome::Progress(nothing) => match nothing {},
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Done(found, _) => {
                let judged = CameraResult { camera: camera.clone(), project: of.clone(), found: Arc::new(found) };
                self.models.judged.set(Some(judged));
            }
        };
        self.ask(Stop(words::judging, || ()), task, Vec::new(), on_outcome);
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
