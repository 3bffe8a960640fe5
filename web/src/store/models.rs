//! Camera models: another one for a camera, its values converted; all of them compared on the network.

use std::sync::Arc;

use leptos::prelude::*;
use sightline::adjust::apply;
use sightline::adjustment::AdjustOptions;
use sightline::calibration::{ComparedModel, Coverage, CrossValidation, ModelConversion, ModelsOptions};
use sightline::project::{Camera, Project};
use sightline_protocol::{CameraJudged, CompareModels, ConvertCamera};

use super::Desk;
use super::background::Stop;
use super::pool::TaskOutcome;
use crate::document::Change;
use crate::edit::{cameras, models};
use crate::i18n::modelling as words;

/// The models of one camera on a network.
#[derive(Clone, Debug)]
pub struct Compared {
    /// Whose.
    pub camera: String,
    /// The document that they were compared on.
    of: Arc<Project>,
    /// A row a model.
    pub rows: Vec<ComparedModel>,
}

/// Result for a camera, with the project that it was computed from.
#[derive(Clone, Debug)]
pub struct CameraResult<T> {
    pub camera: String,
    pub project: Arc<Project>,
    pub found: Arc<T>,
}

/// State of camera models.
#[derive(Clone, Copy, Debug)]
pub struct Models {
    compared: RwSignal<Option<Compared>>,
    pub(super) crossed: RwSignal<Option<CameraResult<CrossValidation>>>,
    pub(super) judged: RwSignal<Option<CameraResult<CameraJudged>>>,
    pub(super) covered: RwSignal<Vec<CameraResult<Coverage>>>,
    /// Remaining differences of conversions, the latest of each camera.
    converted: RwSignal<Vec<ModelConversion>>,
}

impl Models {
    pub fn new() -> Self {
        Self {
            compared: RwSignal::new(None),
            crossed: RwSignal::new(None),
            judged: RwSignal::new(None),
            covered: RwSignal::new(Vec::new()),
            converted: RwSignal::new(Vec::new()),
        }
    }
}

impl Desk {
    /// The comparison of a camera's models on the document as it stands.
    pub fn compared_models(self, camera: &str) -> Option<Compared> {
        let compared = self.models.compared.get().filter(|compared| compared.camera == camera)?;
        self.document.with(|d| Arc::ptr_eq(&d.project, &compared.of)).then_some(compared)
    }

    /// Remaining difference of the conversion to the camera's present model.
    pub fn conversion_of(self, camera: &Camera) -> Option<ModelConversion> {
        let present = camera.interior.model().name;
        let of = |left: &ModelConversion| left.camera == camera.id && left.to == present && left.from != present;
        self.models.converted.with(|all| all.iter().find(|left| of(left)).cloned())
    }

    /// Gives a camera another model, its values as they are known converted.
    pub fn choose_model(self, camera: &str, model: &str) {
        self.convert(camera, model, None);
    }

    /// Gives a camera the model of a row of the comparison, with the values that it was adjusted to.
    pub fn take_model(self, camera: &str, row: &ComparedModel) {
        if let Some(adjusted) = &row.camera {
            self.convert(camera, &row.model, Some(adjusted.clone()));
        }
    }

    fn convert(self, camera: &str, model: &str, adjusted: Option<Camera>) {
        if !self.may_change() {
            return;
        }
        let Some(project) = self.document.with_untracked(|d| {
            let own = d.project.cameras.iter().find(|c| c.id == camera)?;
            Some(models::alone(&d.project, cameras::as_known(d, own)))
        }) else {
            return;
        };
        let task = ConvertCamera { project, camera: camera.to_owned(), model: model.to_owned() };
        let change = Change::ModelChosen { camera: camera.to_owned(), model: model.to_owned() };
        let on_outcome = move |outcome: TaskOutcome<ConvertCamera>| match outcome {
            TaskOutcome::Progress(nothing) => match nothing {},
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Done((converted, left), _) => {
                self.models.converted.update(|all| {
                    all.retain(|other| other.camera != left.camera);
                    all.push(left);
                });
                self.change(change.clone(), |document| {
                    models::take(document, &converted, adjusted.as_ref());
                });
            }
        };
        self.ask(Stop(words::converting, || ()), task, Vec::new(), on_outcome);
    }

    /// Adjusts the network with every model of a camera.
    pub fn compare_models(self, camera: &str) {
        if !self.may_change() {
            return;
        }
        let (of, project, own) = self.document.with_untracked(|d| {
            let oriented =
                d.current().map_or_else(|| (*d.project).clone(), |result| apply(&result.oriented, &result.adjustment));
            (d.project.clone(), oriented, d.options.clone())
        });
        // Each model is judged on all observations: what rejects or weakens some by their residuals is left out.
        let adjust = AdjustOptions { snooping: false, robust: None, variance_components: None, ..own };
        let options = ModelsOptions { camera: Some(camera.to_owned()), adjust, ..ModelsOptions::default() };
        let camera = camera.to_owned();
        let on_outcome = move |outcome: TaskOutcome<CompareModels>| match outcome {
            TaskOutcome::Progress(nothing) => match nothing {},
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Done(rows, _) => {
                self.models.compared.set(Some(Compared { camera: camera.clone(), of: of.clone(), rows }));
            }
        };
        let task = CompareModels { project, options };
        self.ask_in_turn(Stop(words::comparing, || ()), task, Vec::new(), on_outcome);
    }
}
