//! Actions on cameras and photos, with undo.

use std::collections::BTreeSet;

use leptos::prelude::*;
use sightline::adjustment::Exchange;
use sightline::exif::PhotoInfo;
use sightline::plausibility;
use sightline::project::{Parameter, Project};

use super::{Desk, Selection};
use crate::document::Change;
use crate::edit::cameras;
use crate::format;
use crate::i18n::{errors, text};

impl Desk {
    fn edit_camera(self, id: &str, edit: impl FnOnce(&mut Project)) {
        self.change(Change::CameraEdited(id.to_owned()), |document| edit(document.project_mut()));
    }

    /// Gives a camera another name; a name in use or none is refused.
    pub fn rename_camera(self, id: &str, name: &str) {
        let name = name.trim().to_owned();
        let taken = self.document.with_untracked(|d| d.project.cameras.iter().any(|c| c.id == name));
        if name == id {
            return;
        }
        if taken || name.is_empty() {
            self.warn_here(move || text::name_taken(&name));
            return;
        }
        self.edit_camera(&name, |project| cameras::rename(project, id, &name));
    }

    /// Takes a pixel pitch in micrometres as typed: one number, two, or nothing for unknown.
    pub fn set_pitch(self, id: &str, typed: &str) {
        let numbers = typed.split(['×', 'x', ';']).map(str::trim).filter(|t| !t.is_empty()).map(format::parse);
        let pitch = match numbers.collect::<Option<Vec<_>>>().as_deref() {
            Some([]) => None,
            Some(&[p]) if p > 0.0 => Some([p / 1000.0, p / 1000.0]),
            Some(&[x, y]) if x > 0.0 && y > 0.0 => Some([x / 1000.0, y / 1000.0]),
            _ => return self.refuse(typed, text::not_a_length),
        };
        let info = self.exif_of_camera(id);
        self.edit_camera(id, |project| cameras::set_pitch(project, id, pitch, &info));
    }

    /// Takes a principal distance as typed, in the camera's photo unit.
    pub fn set_principal_distance(self, id: &str, typed: &str) {
        let value = format::parse(typed).filter(|c| *c > 0.0);
        if value.is_none() && !typed.trim().is_empty() {
            return self.refuse(typed, text::not_a_length);
        }
        self.edit_camera(id, |project| cameras::set_principal_distance(project, id, value));
    }

    /// Says that what was typed cannot be taken.
    pub(super) fn refuse(self, typed: &str, why: fn(String) -> String) {
        let typed = typed.to_owned();
        self.warn_here(move || errors::refusal(&typed, why));
    }

    fn exif_of_camera(self, id: &str) -> PhotoInfo {
        let photo =
            self.document.with_untracked(|d| d.project.photos.iter().find(|p| p.camera == id).map(|p| p.id.clone()));
        let info = photo.and_then(|photo| self.photos.files.with_untracked(|f| f.get(&photo).map(|f| f.info.clone())));
        info.unwrap_or_default()
    }

    /// Gives photos to a camera that is there.
    pub fn assign_camera(self, photos: &BTreeSet<String>, camera: &str) {
        let change = Change::CameraAssigned { photos: photos.len(), camera: camera.to_owned() };
        self.change(change, |document| cameras::assign(document.project_mut(), photos, camera));
    }

    /// Gives photos a camera of their own, with the values of the one they had.
    pub fn assign_own_camera(self, photos: &BTreeSet<String>) {
        let mut project = self.document.with_untracked(|d| (*d.project).clone());
        if let Some(camera) = cameras::assign_own(&mut project, photos) {
            let change = Change::CameraAssigned { photos: photos.len(), camera };
            self.change(change, |document| *document.project_mut() = project);
        }
    }

    /// Lets photos take part or not.
    pub fn switch_photos(self, photos: &BTreeSet<String>, enabled: bool) {
        let Some(first) = photos.first().cloned() else { return };
        self.change(Change::PhotoSwitched(first), |document| {
            cameras::switch_photos(document.project_mut(), photos, enabled);
        });
    }

    /// Takes photos out of the project with all that was measured in them.
    pub fn remove_photos(self, photos: &BTreeSet<String>) {
        let Some(first) = photos.first().cloned() else { return };
        self.change(Change::PhotoRemoved(first), |document| cameras::remove_photos(document, photos));
        if self.selection.with_untracked(|s| s.photo.as_ref().is_some_and(|p| photos.contains(p))) {
            let next = self.document.with_untracked(|d| d.project.photos.first().map(|p| p.id.clone()));
            self.selection.update(|s| *s = Selection { photo: next, ..Selection::default() });
        }
    }

    /// Exchanges axes of everything given, or changes the sign of one: the remedy for a mirrored network. Orientation begins anew.
    pub fn exchange_axes(self, exchange: Exchange) {
        if !self.may_change() {
            return;
        }
        self.change(Change::AxesExchanged, |document| {
            let exchanged = plausibility::exchange_axes(&document.project, exchange);
            *document.project_mut() = exchanged;
        });
        // They refer to the removed orientation.
        self.processing.notes.set(Vec::new());
    }

    /// Lets a camera's parameter be estimated or held.
    pub fn set_free(self, camera: &str, parameter: Parameter, free: bool) {
        self.change(Change::ParametersChosen(camera.to_owned()), |document| {
            cameras::set_free(document, camera, parameter, free);
        });
    }

    /// Takes an initial value of a camera's parameter as typed.
    pub fn set_initial(self, camera: &str, parameter: Parameter, typed: &str) {
        let Some(value) = format::parse(typed) else { return self.refuse(typed, text::not_a_number) };
        self.change(Change::ParametersChosen(camera.to_owned()), |document| {
            cameras::set_initial(document.project_mut(), camera, parameter, value);
        });
    }

    /// Takes the standard error that a camera's parameter is observed with as typed; nothing: it is not observed.
    pub fn observe_parameter(self, camera: &str, parameter: Parameter, typed: &str) {
        let sigma = format::parse(typed).filter(|sigma| *sigma > 0.0);
        if sigma.is_none() && !typed.trim().is_empty() {
            return self.refuse(typed, text::no_sigma);
        }
        self.change(Change::ParametersChosen(camera.to_owned()), |document| {
            cameras::observe_parameter(document, camera, parameter, sigma);
        });
    }

    /// Takes a projection centre with its standard errors as typed. False when it is refused.
    pub fn observe_position(self, photo: &str, position: &[String; 3], sigma: &[String; 3]) -> bool {
        let mut xyz = [0.0; 3];
        for (value, typed) in xyz.iter_mut().zip(position) {
            match format::parse(typed) {
                Some(number) => *value = number,
                None => {
                    self.refuse(typed, text::not_a_number);
                    return false;
                }
            }
        }
        let mut errors = [None; 3];
        for (value, typed) in errors.iter_mut().zip(sigma) {
            *value = format::parse(typed).filter(|sigma| *sigma > 0.0);
            if value.is_none() && !typed.trim().is_empty() {
                self.refuse(typed, text::no_sigma);
                return false;
            }
        }
        if errors == [None; 3] {
            self.warn_here(|| text::centre_without_sigma().to_owned());
            return false;
        }
        self.change(Change::CentreObserved(photo.to_owned()), |document| {
            cameras::observe_position(document.project_mut(), photo, xyz, errors);
        });
        true
    }

    /// Observes a photo's projection centre no more.
    pub fn forget_position(self, photo: &str) {
        self.change(Change::CentreForgotten(photo.to_owned()), |document| {
            cameras::forget_position(document.project_mut(), photo);
        });
    }
}
