//! Displacements in the photos of the project on the desk, where it is an epoch of the comparison that is shown.

use std::sync::Arc;

use leptos::prelude::*;
use sightline::matching::{PhotoVector, PhotoVectors};
use sightline_protocol::DisplacePhotos;

use crate::i18n::background;
use crate::store::background::Stop;
use crate::store::pool::TaskOutcome;
use crate::store::{Desk, Step};

/// Displacements in photos with what they were asked for.
#[derive(Clone)]
pub struct InPhotos {
    /// Which result and comparison, by where they are, which pair, and the multiple.
    of: (usize, usize, usize, f64),
    vectors: Arc<Vec<PhotoVectors>>,
}

impl Desk {
    /// Inputs of displacements in photos; `None` if the open project is not an epoch of the comparison shown.
    fn displaced_of(self) -> Option<(usize, usize, usize, f64)> {
        let ran = self.monitoring.current()?;
        let (number, pair) = self.monitoring.pair()?;
        let own = self.open_id()?;
        let shown = [&pair.from, &pair.to];
        let is_epoch = ran.epochs.iter().any(|e| e.key.as_ref() == Some(&own) && shown.contains(&&e.epoch.name));
        let result = self.document.with(|d| d.current().map(|r| Arc::as_ptr(r) as usize)).filter(|_| is_epoch)?;
        Some((result, Arc::as_ptr(&ran) as usize, number, self.monitoring.shown_factor()))
    }

    /// Whether photos of the project on the desk have displacements to show.
    pub fn shows_displacements(self) -> bool {
        self.displaced_of().is_some()
    }

    /// The displacements that a photo shows.
    pub fn displacements_in(self, photo: &str) -> Vec<PhotoVector> {
        self.displaced_in(photo, |found| found.vectors.clone())
    }

    /// Points of a photo whose displacement is not drawn, since it ends outside the camera's view; none while displacements are not shown.
    pub fn displacements_not_drawn_in(self, photo: &str) -> Vec<String> {
        let shown = self.photo_view.layers.with(|layers| layers.displacements);
        if shown { self.displaced_in(photo, |found| found.not_drawn.clone()) } else { Vec::new() }
    }

    fn displaced_in<T: Default>(self, photo: &str, read: impl FnOnce(&PhotoVectors) -> T) -> T {
        let Some(of) = self.displaced_of() else { return T::default() };
        self.monitoring.in_photos.with(|known| {
            let found = known.as_ref().filter(|known| known.of == of);
            found.and_then(|known| known.vectors.iter().find(|v| v.photo == photo)).map(read).unwrap_or_default()
        })
    }

    /// Asks for the displacements in photos whenever what they hang on changes.
    pub fn follow_displacements(self) {
        Effect::new(move |asked: Option<Option<(usize, usize, usize, f64)>>| {
            let of = self.displaced_of();
            if asked.flatten() != of
                && let Some(of) = of
            {
                untrack(|| self.ask_displacements(of));
            }
            of
        });
    }

    fn ask_displacements(self, of: (usize, usize, usize, f64)) {
        let result = self.document.with_untracked(|d| d.current().cloned());
        let Some((result, (_, pair))) = result.zip(self.monitoring.pair()) else { return };
        let task = DisplacePhotos {
            project: (*result.oriented).clone(),
            adjustment: result.adjustment.clone(),
            pair,
            factor: of.3,
        };
        let on_outcome = move |outcome: TaskOutcome<DisplacePhotos>| match outcome {
            TaskOutcome::Done(vectors, _) => {
                self.monitoring.in_photos.set(Some(InPhotos { of, vectors: Arc::new(vectors) }));
            }
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        self.ask(Stop(background::displaced, || ()), task, Vec::new(), on_outcome);
    }

    /// Shows the chosen point with its displacement in a photo of the project on the desk.
    pub fn show_in_photo(self) {
        self.photo_view.layers.update(|layers| layers.displacements = true);
        if let Some(point) = self.monitoring.point.get_untracked() {
            self.select_point(&point);
            let photo = self.document.with_untracked(|d| {
                d.project.observations.iter().find(|o| o.enabled && o.point == point).map(|o| o.photo.clone())
            });
            if let Some(photo) = photo {
                self.select_photo(&photo);
            }
        }
        self.go(Step::Targets);
    }
}
