//! Cameras and scale bars for several projects: kept in the browser's storage and in a file, offered where they fit.

use leptos::prelude::*;
use leptos::task::spawn_local;
use serde::Serialize;
use serde::de::IgnoredAny;
use sightline::adjustment::AdjustedCamera;
use sightline::equipment::{Calibration, Equipment, HEAD, KnownCamera, ScaleBar, Use, bars_in};
use sightline::exif::PhotoInfo;
use sightline::project::Origin;
use sightline_exchange::encoding;

use super::calls::Plain;
use super::{Desk, Step, Until};
use crate::browser::file::{self, NamedFile};
use crate::browser::page;
use crate::document::Change;
use crate::edit;
use crate::format;
use crate::i18n::{equipment as words, text};

/// State of the equipment.
#[derive(Clone, Copy, Default)]
pub struct Equipped {
    pub all: RwSignal<Equipment>,
    /// As it was before something was taken away last.
    pub before: RwSignal<Option<Equipment>>,
}

/// A scale bar as it is typed.
#[derive(Clone, Debug, Default)]
pub struct TypedBar {
    pub id: String,
    pub from: String,
    pub to: String,
    pub length: String,
    pub sigma: String,
    pub unit: String,
    pub certificate: String,
    pub date: String,
}

#[derive(Serialize)]
struct EquipmentText<'a> {
    words: &'a str,
}

impl Desk {
    /// Reads what is kept on this computer.
    pub(super) fn read_equipment(self) {
        let Some(storage) = self.storage() else { return };
        spawn_local(async move {
            let Ok((Some(kept), _)) = storage.call::<Option<String>>("equipment", &Plain {}, Vec::new()).await else {
                return;
            };
            match Equipment::read(&kept) {
                Ok(read) => self.equipment.all.set(read),
                Err(error) => self.warn_error(error),
            }
        });
    }

    /// Changes what is kept, here and in the storage; where it cannot be written, the page says so.
    pub(super) fn change_equipment(self, change: impl FnOnce(&mut Equipment)) {
        self.equipment.all.update(change);
        let written = self.equipment.all.with_untracked(Equipment::write);
        let text = match written {
            Ok(text) => text,
            Err(error) => return self.warn_error(error),
        };
        let Some(storage) = self.storage() else {
            return self.say(true, Until::NextWork, || words::not_kept().to_owned());
        };
        spawn_local(async move {
            if storage.call::<IgnoredAny>("setEquipment", &EquipmentText { words: &text }, Vec::new()).await.is_err() {
                self.say(true, Until::NextWork, || words::not_kept().to_owned());
            }
        });
    }

    fn take_away(self, change: impl FnOnce(&mut Equipment)) {
        self.equipment.before.set(Some(self.equipment.all.get_untracked()));
        self.change_equipment(change);
    }

    pub fn remove_known_camera(self, id: &str) {
        self.take_away(|all| all.cameras.retain(|camera| camera.id != id));
    }

    pub fn remove_calibration(self, id: &str, place: usize) {
        self.take_away(|all| {
            for camera in all.cameras.iter_mut().filter(|camera| camera.id == id) {
                if place < camera.calibrations.len() {
                    camera.calibrations.remove(place);
                }
            }
        });
    }

    pub fn remove_bar(self, id: &str) {
        self.take_away(|all| all.bars.retain(|bar| bar.id != id));
    }

    /// Has back what was taken away last.
    pub fn put_equipment_back(self) {
        if let Some(before) = self.equipment.before.get_untracked() {
            self.equipment.before.set(None);
            self.change_equipment(|all| {
                all.join(before);
            });
        }
    }

    /// Keeps a scale bar as typed, in place of one of the same name. Returns false, with a message, if it is invalid.
    pub fn keep_bar(self, typed: &TypedBar) -> bool {
        let number = |text: &str| {
            let number = format::parse(text);
            if number.is_none() {
                self.refuse(text, text::not_a_number);
            }
            number
        };
        let Some((length, sigma)) = number(&typed.length).and_then(|length| Some((length, number(&typed.sigma)?)))
        else {
            return false;
        };
        let plain = |text: &str| text.trim().to_owned();
        let bar = ScaleBar {
            id: plain(&typed.id),
            from: plain(&typed.from),
            to: plain(&typed.to),
            length,
            sigma,
            unit: plain(&typed.unit),
            certificate: plain(&typed.certificate),
            date: plain(&typed.date),
        };
        if let Err(error) = bar.validate() {
            self.warn_error(error);
            return false;
        }
        self.change_equipment(|all| {
            all.join(Equipment { bars: vec![bar], ..Equipment::default() });
        });
        true
    }

    /// Metadata of the photos of a camera, and their size.
    fn photos_say(self, camera: &str) -> PhotoInfo {
        let photos = self.document.with(|d| {
            let of = d.project.photos.iter().filter(|p| p.camera == camera);
            of.map(|p| p.id.clone()).collect::<Vec<_>>()
        });
        self.photos
            .files
            .with(|files| photos.iter().find_map(|id| files.get(id)).map(|f| f.info.clone()).unwrap_or_default())
    }

    /// The cameras of the present result that could be kept: those with one interior orientation for all photos.
    pub fn adjusted_cameras(self) -> Vec<AdjustedCamera> {
        self.document.with(|d| {
            let all = d.current().map(|r| r.adjustment.cameras.clone()).unwrap_or_default();
            all.into_iter().filter(|camera| camera.photo.is_none() && !camera.sigma.is_empty()).collect()
        })
    }

    /// Stores the calibration of a camera from the present result.
    pub fn keep_calibration(self, id: &str) {
        let adjusted = untrack(|| self.adjusted_cameras()).into_iter().find(|adjusted| adjusted.camera.id == id);
        let Some(adjusted) = adjusted else { return };
        let known = KnownCamera::adjusted(&adjusted, &untrack(|| self.photos_say(id)), &page::today());
        if let Err(error) = known.validate() {
            return self.warn_error(error);
        }
        self.change_equipment(|all| all.keep(known));
        let id = id.to_owned();
        self.tell_here(move || words::calibration_kept(&id));
    }

    /// Calibrations that are kept of a camera of the project, known again by its photos, the latest first.
    pub fn calibrations_of(self, camera: &str) -> Vec<(String, Calibration)> {
        let size = self.document.with(|d| {
            let found = d.project.cameras.iter().find(|c| c.id == camera);
            found.map(|c| [c.width, c.height]).unwrap_or_default()
        });
        let info = self.photos_say(camera);
        self.equipment.all.with(|all| {
            let of = |known: &KnownCamera| {
                let (id, took) = (known.id.clone(), known.took(&info, size));
                // Files of other programs name no camera: theirs are offered by size alone.
                let fits = known.model.is_none() && [known.width, known.height] == size;
                let offered = known
                    .calibrations
                    .iter()
                    .rev()
                    .filter(|c| took || fits && c.origin.as_deref().is_some_and(Origin::is_foreign));
                offered.map(|c| (id.clone(), c.clone())).collect::<Vec<_>>()
            };
            all.cameras.iter().flat_map(of).collect()
        })
    }

    /// Gives a camera of the project the values of a calibration.
    pub fn use_calibration(self, camera: &str, calibration: &Calibration, how: Use) {
        self.change(Change::CalibrationTaken { camera: camera.to_owned() }, |document| {
            edit::equipment::use_calibration(document, camera, calibration, how);
        });
    }

    /// Scale bars whose ends are measured here and whose distance the project lacks.
    pub fn offered_bars(self) -> Vec<ScaleBar> {
        self.equipment.all.with(|all| {
            self.document.with(|d| bars_in(&all.bars, &d.project).into_iter().map(|(bar, _)| bar.clone()).collect())
        })
    }

    /// Takes the distances of the scale bars that are seen.
    pub fn take_bars(self) {
        let offered = untrack(|| self.offered_bars());
        if offered.is_empty() || !self.may_change() {
            return;
        }
        self.change(Change::BarsTaken(offered.len()), |document| {
            edit::equipment::take_bars(document, &offered);
        });
        let names = offered.iter().map(|bar| format!("{} ({} – {})", bar.id, bar.from, bar.to));
        let names = names.collect::<Vec<_>>().join(", ");
        self.say(false, Until::Document, move || words::bars_taken(&names));
    }

    /// Hands over everything that is kept as one file.
    pub fn export_equipment(self) {
        let written = self.equipment.all.with_untracked(Equipment::write);
        match written {
            Ok(text) => {
                if let Err(detail) = file::download("equipment.json", "application/json", text.as_bytes()) {
                    self.say(true, Until::NextWork, move || text::cannot_save(&detail));
                }
            }
            Err(error) => self.warn_error(error),
        }
    }

    /// Takes in a file of equipment, beside what is kept.
    pub fn import_equipment(self, file: NamedFile) {
        spawn_local(async move {
            let name = file.name.clone();
            let bytes = match file.content.read().await {
                Ok(bytes) => bytes,
                Err(detail) => return self.say(true, Until::NextWork, move || text::unreadable(&detail)),
            };
            match encoding::text(&bytes).and_then(|text| Equipment::read(&text)) {
                Ok(read) => {
                    let mut joined = Default::default();
                    self.change_equipment(|all| joined = all.join(read));
                    self.go(Step::Equipment);
                    let said = move || words::imported(&name, joined.cameras, joined.calibrations, joined.bars);
                    self.say(false, Until::NextWork, said);
                }
                Err(error) => self.warn_error(error.in_file(&name)),
            }
        });
    }

    /// Opens a project file, or takes in equipment: both can be JSON, and the beginning tells.
    pub(super) fn open_project_or_equipment(self, file: NamedFile) {
        if !file.name.to_ascii_lowercase().ends_with(".json") {
            return self.open_project(file);
        }
        spawn_local(async move {
            let head = file.content.head(HEAD).await.unwrap_or_default();
            if Equipment::is_claimed_by(&head) { self.import_equipment(file) } else { self.open_project(file) }
        });
    }
}
