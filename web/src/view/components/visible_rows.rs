//! Long tables draw only the rows in sight: which rows these are, and scrolling to a row.

use leptos::html::Div;
use leptos::prelude::*;

use crate::browser::page;

/// Rows drawn beyond those in sight, so that scrolling shows no gaps.
const MARGIN: usize = 12;

/// The scrolled box of a table whose rows have the class `data` and equal heights.
#[derive(Clone, Copy)]
pub struct VisibleRows {
    /// The box.
    pub frame: NodeRef<Div>,
    top: RwSignal<f64>,
    height: RwSignal<f64>,
    row_height: RwSignal<f64>,
}

impl VisibleRows {
    pub fn new() -> Self {
        Self {
            frame: NodeRef::new(),
            top: RwSignal::new(0.0),
            height: RwSignal::new(600.0),
            row_height: RwSignal::new(24.0),
        }
    }

    /// Reads heights and scroll position from the page.
    pub fn measure(self) {
        if let Some(element) = self.frame.get_untracked() {
            let (scroll, visible, row) = page::scroll_state(&element, "tbody tr.data");
            self.top.set(scroll);
            self.height.set(visible);
            if let Some(row) = row {
                self.row_height.set(row);
            }
        }
    }

    /// The first of the rows to draw and the one after the last, of so many.
    pub fn range(self, total: usize) -> (usize, usize) {
        let row = self.row_height.get();
        let first = ((self.top.get() / row) as usize).saturating_sub(MARGIN).min(total);
        let last = (first + (self.height.get() / row) as usize + 2 * MARGIN + 2).min(total);
        (first, last)
    }

    /// Height of so many rows that are not drawn, as a style sheet has it.
    pub fn gap(self, rows: usize) -> String {
        format!("{}px", rows as f64 * self.row_height.get())
    }

    /// Number of rows that the keys for a page go up or down.
    pub fn page(self) -> usize {
        let rows = (self.height.get_untracked() / self.row_height.get_untracked()) as usize;
        rows.saturating_sub(2).max(1)
    }

    /// Scrolls until a row is in sight. The head of the table covers the height of one row.
    pub fn reveal(self, place: usize) {
        self.measure();
        let Some(element) = self.frame.get_untracked() else { return };
        let (row, scroll, visible) =
            (self.row_height.get_untracked(), self.top.get_untracked(), self.height.get_untracked());
        let (from, to) = (place as f64 * row, (place + 2) as f64 * row);
        if from < scroll {
            element.set_scroll_top(from as i32);
        } else if to > scroll + visible {
            element.set_scroll_top((to - visible).ceil() as i32);
        }
    }

    pub fn scroll_to_top(self) {
        if let Some(element) = self.frame.get_untracked() {
            element.set_scroll_top(0);
            self.top.set(0.0);
        }
    }
}
