//! What of a comparison lasts when the page is loaded again: the options of a series of epochs, by its first epoch, and which projects of
//! this browser were compared. Lists of points are files and have to be dropped again.

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::monitoring::Options;
use sightline_protocol::{from_text, to_text};

use super::EpochEntry;
use crate::browser::page;
use crate::store::Desk;

/// Of this window: the projects that are compared.
const EPOCHS: &str = "epochs";

/// The preference with the options of a series: by the project of its first epoch, or the file.
fn name_of(first: &EpochEntry) -> String {
    let of = first.key.as_deref().unwrap_or(&first.source);
    format!("epochs.{of}")
}

impl Desk {
    /// Remembers options and epochs as they change.
    pub(in crate::store) fn remember_monitoring(self) {
        let monitored = self.monitoring;
        Effect::new(move || {
            let options = monitored.options.get();
            let Some(name) = monitored.epochs.with(|all| all.first().map(name_of)) else { return };
            if page::preference(&name).is_none() && options == Options::default() {
                return;
            }
            page::set_preference(&name, &to_text(&options));
        });
        Effect::new(move |before: Option<()>| {
            let kept = monitored.epochs.with(|all| {
                let kept = all.iter().filter_map(|e| Some((e.key.clone()?, e.epoch.name.clone())));
                kept.collect::<Vec<(String, String)>>()
            });
            // The first time there is nothing yet, and what was remembered is still wanted.
            if before.is_some() {
                page::set_visit(EPOCHS, &to_text(&kept));
            }
        });
    }

    /// The options that were chosen for the series that this epoch begins.
    pub(super) fn recall_options(self, first: &EpochEntry) {
        let remembered = page::preference(&name_of(first));
        if let Some(options) = remembered.and_then(|text| from_text::<Options>(&text).ok()) {
            self.monitoring.options.set(options);
        }
    }

    /// Takes the projects again that were compared before the page was loaded again; whether there are any.
    pub(in crate::store) fn recall_epochs(self) -> bool {
        let kept = page::visit(EPOCHS).and_then(|text| from_text::<Vec<(String, String)>>(&text).ok());
        let kept = kept.unwrap_or_default();
        if kept.is_empty() || self.storage().is_none() || !self.monitoring.epochs.with_untracked(Vec::is_empty) {
            return false;
        }
        spawn_local(async move {
            for (key, name) in kept {
                if self.open_id().as_ref() == Some(&key) {
                    self.add_open_epoch();
                } else {
                    self.take_kept(key, name).await;
                }
            }
        });
        true
    }
}
