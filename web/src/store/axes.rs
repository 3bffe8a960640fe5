//! The letters and the order of coordinates as the project has them.

use leptos::prelude::*;
use sightline::axes::{ShownAxes, UserAxes};

use super::Desk;
use crate::document::Change;

impl Desk {
    /// Letters and order of the open project's coordinates.
    pub fn axes(self) -> ShownAxes {
        self.document.with(|document| document.project.shown_axes())
    }

    /// Shows and writes coordinates by other letters and in another order; none: X, Y, Z. No coordinate changes.
    pub fn set_axes(self, axes: Option<UserAxes>) {
        if self.document.with_untracked(|document| document.project.axes) != axes {
            self.change(Change::AxesSet, |document| document.project_mut().axes = axes);
        }
    }
}

/// Those of the project that is on the page; X, Y, Z where there is no page, as in tests of sentences.
pub fn axes_here() -> ShownAxes {
    use_context::<Desk>().map(Desk::axes).unwrap_or_default()
}
