//! Displacements in the photos of the project on the desk, where it is an epoch of the comparison that is shown.

use std::sync::Arc;

use leptos::prelude::*;
use sightline::matching::{PhotoVector, PhotoVectors};
use sightline_protocol::DisplacePhotos;

use crate::i18n::lasting;
use crate::store::lasting::Stop;
use crate::store::pool::Outcome;
use crate::store::{Desk, Step};

/// Displacements in photos with what they were asked for.
#[derive(Clone)]
pub struct InPhotos {
    /// Which result and comparison, by where they are, which pair, and the multiple.
    of: (usize, usize, usize, f64),
    vectors: Arc<Vec<PhotoVectors>>,
}

impl Desk {
    /// What displacements in photos hang on; none where the project on the desk is no epoch of what is shown.
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
        let Some(of) = self.displaced_of() else { return Vec::new() };
        let found = self.monitoring.in_photos.with(|known| {
            let known = known.as_ref().filter(|known| known.of == of)?;
            Some(known.vectors.iter().find(|v| v.photo == photo).map(|v| v.vectors.clone()).unwrap_or_default())
        });
        found.unwrap_or_default()
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
        let on_outcome = move |outcome: Outcome<DisplacePhotos>| match outcome {
            Outcome::Done(vectors, _) => {
                self.monitoring.in_photos.set(Some(InPhotos { of, vectors: Arc::new(vectors) }));
            }
            Outcome::Failed(failure) => self.tell_failure(failure),
            Outcome::Progress(nothing) => match nothing {},
        };
        self.ask(Stop(lasting::displaced, || ()), task, Vec::new(), on_outcome);
    }

    /// Shows the chosen point with its displacement in a photo of the project on the desk.
    pub fn show_in_photo(self) {
        self.layers.update(|layers| layers.displacements = true);
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
