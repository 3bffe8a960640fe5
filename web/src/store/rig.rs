//! Cameras fixed to each other, as changes of the document.

use leptos::prelude::*;

use super::Desk;
use crate::document::Change;
use crate::edit::rig::{self, Refused};
use crate::format;
use crate::i18n::mounted as words;

impl Desk {
    /// Takes photos for taken together as [`rig::proposed`] pairs them.
    pub fn make_rig(self) {
        let proposed = self.document.with_untracked(|d| rig::proposed(&d.project));
        match proposed {
            Some(proposed) => self.change(Change::RigEdited, |d| d.project_mut().rig = Some(Box::new(proposed))),
            None => self.warn(|| words::two_cameras().to_owned()),
        }
    }

    /// Lets the cameras be independent of each other again.
    pub fn remove_rig(self) {
        self.change(Change::RigEdited, |d| d.project_mut().rig = None);
    }

    /// Puts a photo into an exposure of the rig.
    pub fn put_in_rig(self, row: usize, column: usize, name: &str) {
        let mut project = self.document.with_untracked(|d| (*d.project).clone());
        match rig::put(&mut project, row, column, name) {
            Ok(()) => self.change(Change::RigEdited, |d| d.project_mut().rig = project.rig),
            Err(Refused::NoPhoto(name)) => self.warn(move || words::no_photo(&name)),
            Err(Refused::OtherCamera { photo, camera }) => self.warn(move || words::other_camera(&photo, &camera)),
        }
    }

    /// Sets how well the mount keeps positions (the project's unit) or rotations (milliradians).
    pub fn set_rig_sigma(self, is_position: bool, typed: &str) {
        let Some(value) = format::parse(typed).filter(|value| *value > 0.0) else {
            let typed = typed.to_owned();
            return self.warn(move || words::no_sigma(&typed));
        };
        self.change(Change::RigEdited, |d| {
            if let Some(rig) = &mut d.project_mut().rig {
                if is_position {
                    rig.sigma_position = value;
                } else {
                    rig.sigma_rotation = value / 1000.0;
                }
            }
        });
    }
}
