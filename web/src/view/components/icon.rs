//! The few icons of the desk, drawn as strokes on a grid of 16.

use leptos::prelude::*;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    Undo,
    Redo,
    Warning,
    Clock,
    Check,
    Cross,
    Fit,
    Arrow,
    Copy,
    Save,
    More,
}

impl Icon {
    fn path(self) -> &'static str {
        match self {
            Self::Undo => "M6 3.5 2.5 7 6 10.5M2.5 7h7a3.75 3.75 0 0 1 0 7.5H7",
            Self::Redo => "M10 3.5 13.5 7 10 10.5M13.5 7h-7a3.75 3.75 0 0 0 0 7.5H9",
            Self::Warning => "M8 2.25 14.75 13.75H1.25ZM8 6.25v3.5M8 11.5v.5",
            Self::Clock => "M8 1.75a6.25 6.25 0 1 1 0 12.5a6.25 6.25 0 0 1 0-12.5ZM8 4.5V8l2.5 1.5",
            Self::Check => "M2.5 8.5 6.25 12.25 13.5 4.5",
            Self::Cross => "M3.5 3.5l9 9M12.5 3.5l-9 9",
            Self::Fit => "M2.5 6V2.5H6M10 2.5h3.5V6M13.5 10v3.5H10M6 13.5H2.5V10",
            Self::Arrow => "M2.5 8h11M9.25 3.75 13.5 8l-4.25 4.25",
            Self::Copy => "M5.5 5.5h8v8h-8ZM10.5 5.5v-3h-8v8h3",
            Self::More => "M3 8h.01M8 8h.01M13 8h.01",
            Self::Save => "M8 2v8M4.75 7 8 10.25 11.25 7M2.5 10.5v3h11v-3",
        }
    }
}

/// An icon; a text beside it or the label of its button explains it.
#[component]
pub fn Glyph(icon: Icon, #[prop(default = 16)] size: u32) -> impl IntoView {
    view! {
        <svg class="glyph" width=size height=size viewBox="0 0 16 16" aria-hidden="true">
            <path d=icon.path()></path>
        </svg>
    }
}
