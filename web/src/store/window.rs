//! State of the window around the steps: colours, menus, keys.

use leptos::prelude::*;

use super::{Desk, Step};
use crate::browser::page;

/// A menu in the head of the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Menu {
    /// Actions on the project, and the pages beside the path.
    File,
    /// On a phone: everything else that the head of a wide window shows.
    More,
}

/// Colour scheme of the page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    #[default]
    Light,
    Dark,
    /// For reading in sunlight: the strongest contrast.
    Sun,
}

impl Theme {
    pub fn name(self) -> &'static str {
        match self {
            Self::Light => "light",
            Self::Dark => "dark",
            Self::Sun => "sun",
        }
    }

    pub fn next(self) -> Self {
        match self {
            Self::Light => Self::Dark,
            Self::Dark => Self::Sun,
            Self::Sun => Self::Light,
        }
    }
}

/// Signals of the window.
#[derive(Clone, Copy)]
pub struct Window {
    pub theme: RwSignal<Theme>,
    /// The menu that is open.
    pub menu: RwSignal<Option<Menu>>,
    /// Whether the list of keys is open.
    pub help: RwSignal<bool>,
    /// Whether keys of a single letter act.
    pub single_keys: RwSignal<bool>,
    /// The step of the path, or the start page, that was shown before the present page beside the path.
    pub came_from: RwSignal<Step>,
}

impl Window {
    /// With the preferences that the browser has stored.
    pub(super) fn restored() -> Self {
        let theme = match page::preference("theme").as_deref() {
            Some("dark") => Theme::Dark,
            Some("sun") => Theme::Sun,
            Some(_) => Theme::Light,
            None if page::prefers_dark() => Theme::Dark,
            None => Theme::Light,
        };
        Self {
            theme: RwSignal::new(theme),
            menu: RwSignal::default(),
            help: RwSignal::default(),
            single_keys: RwSignal::new(page::preference("single-keys").as_deref() != Some("off")),
            came_from: RwSignal::default(),
        }
    }
}

impl Desk {
    pub fn set_theme(self, theme: Theme) {
        page::set_preference("theme", theme.name());
        self.window.theme.set(theme);
    }

    /// Switches keys of a single letter on or off.
    pub fn set_single_keys(self, on: bool) {
        page::set_preference("single-keys", if on { "on" } else { "off" });
        self.window.single_keys.set(on);
    }
}
