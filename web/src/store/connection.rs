//! Connection to the host of the page: working without a network, new builds.

use leptos::prelude::*;

use crate::browser::page;

/// Signals of the connection to the host.
#[derive(Clone, Copy)]
pub struct Connection {
    pub offline: RwSignal<bool>,
    /// Whether the page could not be stored for use without a network.
    pub needs_network: RwSignal<bool>,
    /// Whether a new build of the page is ready and waits for the user's consent.
    pub update: RwSignal<bool>,
    /// Whether the host has replaced this build, so that parts of the page that are not loaded yet cannot be loaded.
    pub outdated: RwSignal<bool>,
}

impl Connection {
    pub(super) fn new() -> Self {
        Self {
            offline: RwSignal::new(page::is_offline()),
            needs_network: RwSignal::default(),
            update: RwSignal::default(),
            outdated: RwSignal::default(),
        }
    }
}
