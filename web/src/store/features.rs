//! Measuring on the result: each change of the features is measured at once on the result that is there, which stays as it is.

use std::sync::Arc;

use leptos::prelude::*;
use sightline::adjust::apply;
use sightline::adjustment::Measured;
use sightline::project::Project;
use sightline_protocol::MeasureFeatures;

use super::Desk;
use super::background::Stop;
use super::pool::TaskOutcome;
use crate::document::{AdjustmentResult, Change, Document};
use crate::edit::features::{self, Lacks};
use crate::i18n::background;
use crate::i18n::object as words;

impl Document {
    /// Whether features were changed since they were measured.
    pub fn features_out_of_date(&self) -> bool {
        self.current().is_some_and(|result| {
            !Arc::ptr_eq(&result.input, &self.project)
                && (result.input.features != self.project.features || result.input.systems != self.project.systems)
        })
    }
}

impl Desk {
    /// Makes a feature of what is chosen; its name.
    pub fn make_feature(self, kind: &str, points: &[String], picked: &[String]) -> Option<String> {
        match self.document.with_untracked(|d| features::made(kind, &d.project, points, picked)) {
            Ok(kind) => {
                let mut made = String::new();
                let name = self.document.with_untracked(|d| features::free_letter(&d.project));
                self.change_features(Change::FeatureMade(name), |project| made = features::add(project, kind));
                (!made.is_empty()).then_some(made)
            }
            Err(lacks) => {
                self.warn_here(move || lacking(lacks));
                None
            }
        }
    }

    /// Lays a coordinate system through what is chosen.
    pub fn make_system(self, kind: &str, points: &[String], picked: &[String]) {
        match self.document.with_untracked(|d| features::laid(kind, &d.project, points, picked)) {
            Ok(kind) => {
                let name = self.document.with_untracked(|d| features::free_letter(&d.project));
                self.change_features(Change::FeatureMade(name), |project| {
                    features::add_system(project, kind);
                });
            }
            Err(lacks) => self.warn_here(move || lacking(lacks)),
        }
    }

    /// Takes a feature or a system away, with what is built on it.
    pub fn remove_feature(self, id: &str) {
        let mut more = 0;
        self.change_features(Change::FeatureRemoved(id.to_owned()), |project| more = features::remove(project, id));
        if more > 0 {
            self.tell_here(move || words::removed_too(more));
        }
    }

    /// Gives a feature or a system another name; whether it has it.
    pub fn rename_feature(self, from: &str, to: &str) -> bool {
        let (from, to) = (from.to_owned(), to.trim().to_owned());
        if from == to {
            return false;
        }
        let mut renamed = self.document.with_untracked(|d| (*d.project).clone());
        if !features::rename(&mut renamed, &from, &to) {
            self.warn_here(|| words::name_taken().to_owned());
            return false;
        }
        self.change_features(Change::FeatureRenamed { from, to }, |project| *project = renamed);
        true
    }

    /// Fits the scale of a coordinate system too, or keeps lengths.
    pub fn scale_system(self, id: &str, scale: bool) {
        let name = id.to_owned();
        self.change_features(Change::SystemScaled(name), |project| features::scale(project, id, scale));
    }

    /// Joins the chosen points by lines in a layer, or parts them.
    pub fn join_points(self, points: &[String], layer: &str) {
        if points.len() < 2 {
            return self.warn_here(|| lacking(Lacks::Points(2)));
        }
        self.change(Change::LinesDrawn, |document| {
            features::join(document.project_mut(), points, layer);
        });
    }

    /// Takes the lines between the chosen points away.
    pub fn part_points(self, points: &[String]) {
        if self.document.with_untracked(|d| features::part(&mut (*d.project).clone(), points)) > 0 {
            self.change(Change::LinesDrawn, |document| {
                features::part(document.project_mut(), points);
            });
        }
    }

    /// Gives a layer another colour.
    pub fn recolour_layer(self, layer: &str, colour: [u8; 3]) {
        self.change(Change::LayerColoured(layer.to_owned()), |document| {
            features::recolour(document.project_mut(), layer, colour);
        });
    }

    fn change_features(self, change: Change, edit: impl FnOnce(&mut Project)) {
        self.change(change, |document| edit(document.project_mut()));
        self.measure_features();
    }

    /// Measures the features on the result, where there is one that is not out of date.
    pub fn measure_features(self) {
        let Some((project, result)) = self.document.with_untracked(|d| {
            let result = d.current()?;
            d.features_out_of_date().then(|| (d.project.clone(), result.clone()))
        }) else {
            return;
        };
        let task = MeasureFeatures {
            project: apply(&with_features(&result.oriented, &project), &result.adjustment),
            options: result.adjustment.options.clone(),
        };
        let on_outcome = move |outcome: TaskOutcome<MeasureFeatures>| match outcome {
            TaskOutcome::Done(Measured { features, systems }, _) => {
                let there = self.document.with_untracked(|d| {
                    Arc::ptr_eq(&d.project, &project) && d.result.as_ref().is_some_and(|r| Arc::ptr_eq(r, &result))
                });
                // What was changed meanwhile has asked for its own.
                if there {
                    let mut adjustment = result.adjustment.clone();
                    (adjustment.features, adjustment.systems) = (features, systems);
                    let oriented = Arc::new(with_features(&result.oriented, &project));
                    let measured = AdjustmentResult { input: project.clone(), oriented, adjustment };
                    self.change_on(|document| document.result = Some(Arc::new(measured)));
                }
            }
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        self.ask(Stop(background::features, || ()), task, Vec::new(), on_outcome);
    }
}

/// A project with the features of another.
fn with_features(project: &Project, other: &Project) -> Project {
    Project { features: other.features.clone(), systems: other.systems.clone(), ..project.clone() }
}

/// Selection that is missing before it can be created.
fn lacking(lacks: Lacks) -> String {
    match lacks {
        Lacks::Points(n) => words::lacks_points(n),
        Lacks::TwoEnds => words::lacks_ends().to_owned(),
        Lacks::Angle => words::lacks_angle().to_owned(),
        Lacks::OneFeature => words::lacks_feature().to_owned(),
        Lacks::PlaneLinePoint => words::lacks_plane_line_point().to_owned(),
        Lacks::Given => words::lacks_given().to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use sightline::adjustment::Adjustment;
    use sightline::project::{DrawnLine, FeatureKind};

    use super::*;

    #[test]
    fn features_made_since_are_out_of_date_while_the_result_is_not() {
        let mut document = Document::default();
        let input = document.project.clone();
        let adjustment = Adjustment { options: document.options.clone(), ..Adjustment::default() };
        document.result = Some(Arc::new(AdjustmentResult { oriented: input.clone(), input, adjustment }));
        let line = DrawnLine { from: "1".into(), to: "2".into(), layer: String::new() };
        document.project_mut().lines.push(line);
        assert!(document.current().is_some() && !document.features_out_of_date());
        features::add(document.project_mut(), FeatureKind::Plane { points: vec!["1".into()] });
        assert!(document.current().is_some() && document.features_out_of_date());
        document.project_mut().unit = "m".into();
        assert!(document.current().is_none() && !document.features_out_of_date());
    }
}
