//! Boards of circles: their dots named in all photos, as one change.

use leptos::prelude::*;
use sightline::matching::{Board, GridNaming, GridOptions};
use sightline_protocol::NameGrid;

use super::pool::TaskOutcome;
use super::{Desk, JobKind};
use crate::document::Change;
use crate::edit::{grids, targets};

impl Desk {
    /// Names the dots of a board in all photos that have targets; `shown` gets what was named and what was not.
    pub fn name_grid(self, board: Board, options: GridOptions, shown: RwSignal<Option<GridNaming>>) {
        if !self.may_change() {
            return;
        }
        let (project, targets) = self.document.with_untracked(|d| ((*d.project).clone(), targets::by_photo(d)));
        let batch = self.start_job(JobKind::Matching, 1, || {});
        let on_outcome = move |outcome: TaskOutcome<NameGrid>| match outcome {
            TaskOutcome::Progress(nothing) => match nothing {},
            TaskOutcome::Done(naming, _) => {
                self.end_job();
                if !naming.observations.is_empty() {
                    let (count, taken) = (naming.observations.len(), naming.clone());
                    self.change(Change::DotsNamed(count), |document| {
                        grids::take(document.project_mut(), taken);
                    });
                }
                shown.try_set(Some(naming));
            }
            TaskOutcome::Failed(failure) => {
                self.end_job();
                self.tell_failure(failure);
            }
        };
        let task = NameGrid { project, targets, board, options };
        self.tasks.pool.with_value(|pool| pool.submit(batch, task, Vec::new(), on_outcome));
    }
}
