//! Predicted position of the selected point: requested from the workers whenever point, photo or orientation change. The photos stand where
//! the last adjustment has them; while photos are still without one, where their measurements so far put them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use leptos::prelude::*;
use sightline::matching::{PhotoPrediction, PredictOptions, Prediction};
use sightline::project::{Point, Project};
use sightline_protocol::{Predict, Situate, Situated};

use super::background::Stop;
use super::pool::TaskOutcome;
use super::{Desk, Step};
use crate::browser::page;
use crate::document::AdjustmentResult;
use crate::i18n::background as words;

/// Measurements of a photo below which it is not looked whether it can be oriented.
const ENOUGH: usize = 5;
/// Observations beyond which photos are oriented by the adjustment alone: it would take too long beside other work.
const MOST: usize = 20_000;
/// Time, in milliseconds, after a change before photos are oriented: several marks in a row are one change.
const PAUSE: i32 = 300;

/// Source of the photos' positions.
#[derive(Clone, Debug)]
enum Source {
    Adjusted(Arc<AdjustmentResult>),
    Measured(Arc<Project>),
}

/// Where photos stand, and from what.
#[derive(Clone, Debug)]
struct Situation {
    source: Source,
    /// `None` if nothing can be oriented.
    situated: Option<Arc<Situated>>,
}

/// Oriented photos, the point with its observations, and the photo that is shown.
type PredictionInput = (Arc<Situated>, Project, Option<String>);

/// State of the prediction of the selected point and of the questions about it.
#[derive(Clone, Copy, Default)]
pub struct Predicting {
    situation: RwSignal<Option<Situation>>,
    situating: RwSignal<bool>,
    prediction: RwSignal<Option<Arc<Prediction>>>,
    /// The question under way.
    asking: RwSignal<bool>,
    asked: StoredValue<Option<PredictionInput>>,
}

/// Whether a result has all photos that could be oriented.
fn covers(result: &AdjustmentResult, project: &Project) -> bool {
    let adjusted = result.adjustment.photos.iter().map(|p| p.id.as_str()).collect::<BTreeSet<_>>();
    let mut counts = BTreeMap::<&str, usize>::new();
    for o in project.observations.iter().filter(|o| o.enabled && !adjusted.contains(o.photo.as_str())) {
        *counts.entry(&o.photo).or_default() += 1;
    }
    counts.values().all(|n| *n < ENOUGH)
}

/// Whether two photos at least have enough points in common with others.
fn may_be_oriented(project: &Project) -> bool {
    if project.observations.len() > MOST {
        return false;
    }
    let mut rays = BTreeMap::<&str, usize>::new();
    for o in project.observations.iter().filter(|o| o.enabled) {
        *rays.entry(&o.point).or_default() += 1;
    }
    let mut shared = BTreeMap::<&str, usize>::new();
    for o in project.observations.iter().filter(|o| o.enabled && rays[o.point.as_str()] > 1) {
        *shared.entry(&o.photo).or_default() += 1;
    }
    shared.values().filter(|n| **n >= ENOUGH).count() > 1
}

impl Desk {
    /// Begins to follow what is chosen.
    pub fn start_predicting(self) {
        Effect::new(move |_| self.follow_orientation());
        Effect::new(move |_| self.follow_point());
    }

    fn follow_orientation(self) {
        let here = matches!(self.step.get(), Step::Targets | Step::Identities | Step::Tables);
        if !here || self.predicting.situating.get() {
            return;
        }
        let (project, result) = self.document.with(|d| (d.project.clone(), d.result.clone()));
        let known = self.predicting.situation.get();
        if let Some(result) = result.filter(|result| covers(result, &project)) {
            if matches!(known, Some(Situation { source: Source::Adjusted(of), .. }) if Arc::ptr_eq(&of, &result)) {
                return;
            }
            let applied = sightline::adjust::apply(&result.oriented, &result.adjustment);
            let situated = Some(Arc::new(Situated::of(applied, Some(&result.adjustment))));
            self.predicting.situation.set(Some(Situation { source: Source::Adjusted(result), situated }));
            return;
        }
        let same = |of: &Arc<Project>| Arc::ptr_eq(of, &project) || **of == *project;
        if matches!(&known, Some(Situation { source: Source::Measured(of), .. }) if same(of)) {
            return;
        }
        if !may_be_oriented(&project) {
            if known.is_some() {
                self.predicting.situation.set(None);
            }
            return;
        }
        if self.tasks.job.with(Option::is_some) {
            return;
        }
        self.predicting.situating.set(true);
        page::after(PAUSE, move || self.situate());
    }

    fn situate(self) {
        let (project, options) = self.document.with_untracked(|d| (d.project.clone(), d.options.clone()));
        let of = project.clone();
        let task = Situate { project: (*project).clone(), options };
        let on_outcome = move |outcome: TaskOutcome<Situate>| {
            let situated = match outcome {
                TaskOutcome::Progress(nothing) => match nothing {},
                TaskOutcome::Done(situated, _) => Some(Arc::new(situated)),
                // Too little is measured yet, or contradictory: the adjustment will report it.
                TaskOutcome::Failed(_) => None,
            };
            let source = Source::Measured(project.clone());
            self.predicting.situation.set(Some(Situation { source, situated }));
            self.predicting.situating.set(false);
        };
        // Not asked for again until something else is measured.
        let stopped = move || {
            self.predicting.situation.set(Some(Situation { source: Source::Measured(of.clone()), situated: None }));
            self.predicting.situating.set(false);
        };
        self.ask_in_turn(Stop(words::situation, stopped), task, Vec::new(), on_outcome);
    }

    fn follow_point(self) {
        if self.predicting.asking.get() {
            return;
        }
        let (point, photo) = self.selection.with(|s| (s.point.clone(), s.photo.clone()));
        let situated = self.predicting.situation.with(|s| s.as_ref().and_then(|s| s.situated.clone()));
        let (Some(point), Some(situated)) = (point, situated) else {
            self.predicting.asked.set_value(None);
            if self.predicting.prediction.with_untracked(Option::is_some) {
                self.predicting.prediction.set(None);
            }
            return;
        };
        let oriented = situated.project.photos.iter().map(|p| p.id.as_str()).collect::<BTreeSet<_>>();
        let observations = self.document.with(|d| {
            let of_point = d.project.observations.iter().filter(|o| o.point == point);
            of_point.filter(|o| oriented.contains(o.photo.as_str())).cloned().collect::<Vec<_>>()
        });
        let question = Project {
            points: vec![Point { id: point.clone(), ..Point::default() }].into(),
            observations: observations.into(),
            ..Project::default()
        };
        let same = self.predicting.asked.with_value(|asked| {
            let same = |(of, q, p): &PredictionInput| Arc::ptr_eq(of, &situated) && *q == question && *p == photo;
            asked.as_ref().is_some_and(same)
        });
        if same {
            return;
        }
        let project = Project {
            cameras: situated.project.cameras.clone(),
            photos: situated.project.photos.clone(),
            ..question.clone()
        };
        let options = PredictOptions { lines_in: Some(photo.clone().into_iter().collect()) };
        let task = Predict { project, adjustment: situated.adjustment.clone(), point, options };
        self.predicting.asked.set_value(Some((situated, question, photo)));
        self.predicting.asking.set(true);
        let on_outcome = move |outcome: TaskOutcome<Predict>| {
            let prediction = match outcome {
                TaskOutcome::Progress(nothing) => match nothing {},
                TaskOutcome::Done(prediction, _) => Some(Arc::new(prediction)),
                TaskOutcome::Failed(_) => None,
            };
            self.predicting.prediction.set(prediction);
            self.predicting.asking.set(false);
        };
        // Nor is it asked for the photo that was chosen meanwhile: it is the point that was given up.
        let stopped = move || {
            let photo = self.selection.with_untracked(|s| s.photo.clone());
            self.predicting.asked.update_value(|asked| {
                if let Some((.., of)) = asked {
                    *of = photo;
                }
            });
            self.predicting.prediction.set(None);
            self.predicting.asking.set(false);
        };
        self.ask(Stop(words::situation, stopped), task, Vec::new(), on_outcome);
    }

    /// Where the chosen point should be.
    pub fn prediction(self) -> Option<Arc<Prediction>> {
        let point = self.selection.with(|s| s.point.clone())?;
        self.predicting.prediction.get().filter(|p| p.point == point)
    }

    /// Where the chosen point should be in the photo that is shown.
    pub fn prediction_here(self) -> Option<PhotoPrediction> {
        let photo = self.selection.with(|s| s.photo.clone())?;
        self.prediction()?.photos.iter().find(|p| p.photo == photo).cloned()
    }
}

#[cfg(test)]
mod tests {
    use sightline::project::{Observation, Sigma};

    use super::*;

    fn project(rays: &[(&str, usize)]) -> Project {
        let of = |(photo, n): &(&str, usize)| {
            let photo = (*photo).to_owned();
            (0..*n).map(move |k| Observation {
                photo: photo.clone(),
                point: k.to_string(),
                u: 1.0,
                v: 1.0,
                sigma: Sigma::One(0.1),
                enabled: true,
                target: None,
            })
        };
        Project { observations: rays.iter().flat_map(of).collect(), ..Project::default() }
    }

    #[test]
    fn two_photos_with_points_in_common_may_be_oriented() {
        assert!(may_be_oriented(&project(&[("1", 6), ("2", 5)])));
        assert!(!may_be_oriented(&project(&[("1", 9), ("2", 4)])));
        assert!(!may_be_oriented(&project(&[("1", 9)])));
    }

    #[test]
    fn a_result_serves_until_a_photo_without_one_could_be_oriented() {
        let oriented = Arc::new(Project::default());
        let photos = vec![sightline::adjustment::AdjustedPhoto { id: "1".into(), ..Default::default() }];
        let adjustment = sightline::adjustment::Adjustment { photos, ..Default::default() };
        let result = AdjustmentResult { input: oriented.clone(), oriented, adjustment };
        assert!(covers(&result, &project(&[("1", 9), ("2", 4)])));
        assert!(!covers(&result, &project(&[("1", 9), ("2", 5)])));
    }
}
