//! Plates: readings transformed to the fiducial marks, from files or measured in scanned photos.

use std::sync::Arc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::Error;
use sightline::film::comparator::Upwards;
use sightline_exchange::Files;
use sightline_exchange::comparator::{self, Reduced};
use sightline_lab::experiments;

use super::{Desk, Step};
use crate::browser::file::NamedFile;
use crate::i18n::experiments as words;

/// Plates of one's own.
#[derive(Clone, Copy, Default)]
pub struct Plates {
    /// The description as typed; none: that of the film experiment.
    pub description: RwSignal<Option<String>>,
    /// Result.
    pub outcome: RwSignal<Option<Result<Arc<Reduced>, Error>>>,
}

impl Desk {
    /// Texts that describe fiducial marks: plates.
    pub(super) fn take_plates(self, files: &Files) {
        match comparator::import(files) {
            Ok(reduced) => {
                self.experiments.plates.outcome.set(Some(Ok(Arc::new(reduced))));
                self.open_plates();
            }
            Err(error) => self.warn_error(error),
        }
    }

    /// Reads files of readings, and whatever description comes with them, and transforms them to the fiducial marks.
    pub fn reduce_plates(self, files: Vec<NamedFile>) {
        let description = self.plates_description();
        spawn_local(async move {
            let Some(mut all) = self.contents(files).await else { return };
            all.insert("0 description".to_owned(), description.into_bytes());
            self.experiments.plates.outcome.set(Some(comparator::import(&all).map(Arc::new)));
        });
    }

    /// The same with what was measured in the photos of the open project: pixels of scans.
    pub fn reduce_scans(self) {
        let parsed = comparator::parse(&self.plates_description());
        let reduced = parsed.and_then(|(mut description, _)| {
            description.setup.upwards = Upwards::No;
            let readings = self.document.with_untracked(|d| comparator::readings_of(&d.project));
            comparator::reduce(&description, &readings)
        });
        self.experiments.plates.outcome.set(Some(reduced.map(Arc::new)));
    }

    fn plates_description(self) -> String {
        self.experiments.plates.description.get_untracked().unwrap_or_else(experiments::film_description)
    }

    /// Puts the reduced plates on the desk as a project.
    pub fn open_plates(self) {
        if let Some(Ok(reduced)) = self.experiments.plates.outcome.get_untracked() {
            self.over_unsaved(move || {
                let mut project = reduced.project.clone();
                project.name = words::plates().to_owned();
                self.put_project(project);
                self.go(Step::Adjust);
            });
        }
    }
}
