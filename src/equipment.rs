//! Equipment for several projects: cameras with their calibrations, scale bars with their certificates.
//!
//! It is one JSON document, `"format": "sightline-equipment"`, version 1. A camera is recognised by the metadata of photos
//! ([`KnownCamera::took`]); a calibration enters a project held, observed with its standard errors, or only as initial values
//! ([`Calibration::apply`]). A scale bar whose two ends are measured gives its distance ([`bars_in`]).

mod bars;
mod cameras;
#[cfg(test)]
mod tests;

use std::collections::HashSet;

use serde::{Deserialize, Serialize};

pub use bars::{ScaleBar, bars_in, has_lengths};
pub use cameras::{Calibration, KnownCamera, Use};

use crate::error::{Error, Place, Reason, Result, Thing, shortened};
use crate::limits;
use crate::project::{RemovedFields, count_entries, note_removed};

/// Name of the format.
pub const FORMAT: &str = "sightline-equipment";
/// Version that is written, and the newest that is read.
pub const VERSION: u32 = 1;

/// Bytes from the beginning of a file in which its format is looked for.
pub const HEAD: usize = 4096;

/// Factor from one unit of length to another; `None` if one of them is not known and they differ.
pub fn unit_factor(from: &str, to: &str) -> Option<f64> {
    crate::units::factor(from, to).ok()
}

/// Cameras and scale bars.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Equipment {
    /// "sightline-equipment".
    pub format: String,
    /// 1.
    pub version: u32,
    /// Cameras.
    #[serde(default)]
    pub cameras: Vec<KnownCamera>,
    /// Scale bars.
    #[serde(default)]
    pub bars: Vec<ScaleBar>,
}

impl Default for Equipment {
    fn default() -> Self {
        Self { format: FORMAT.into(), version: VERSION, cameras: Vec::new(), bars: Vec::new() }
    }
}

/// Changes made by merging two lists of equipment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Joined {
    /// Cameras that were not there.
    pub cameras: usize,
    /// Calibrations that were not there.
    pub calibrations: usize,
    /// Scale bars that were not there, or were otherwise.
    pub bars: usize,
}

impl Equipment {
    /// Whether the beginning of a file claims to be equipment, whole or damaged: its format stands there, where it is written.
    pub fn is_claimed_by(beginning: &[u8]) -> bool {
        let wanted = format!("\"{FORMAT}\"");
        // Without its zeros the beginning of a JSON in UTF-16 reads as it does in UTF-8, and may be cut anywhere.
        let beginning: Vec<u8> = beginning.iter().copied().take(HEAD).filter(|byte| *byte != 0).collect();
        beginning.windows(wanted.len()).any(|bytes| bytes == wanted.as_bytes())
    }

    /// From its JSON.
    ///
    /// # Errors
    /// [`Error::Invalid`] if it is not equipment, of a newer version, too long, or holds what [`validate`](Self::validate) refuses.
    pub fn read(text: &str) -> Result<Self> {
        #[derive(Deserialize)]
        struct Head {
            #[serde(default)]
            format: String,
            #[serde(default)]
            version: u32,
        }
        let invalid = |reason| Error::Invalid { reason, at: Place::default() };
        if text.len() > limits::EQUIPMENT_BYTES {
            return Err(invalid(Reason::EquipmentTooLong { megabytes: limits::EQUIPMENT_BYTES >> 20 }));
        }
        let head: Head =
            serde_json::from_str(text).map_err(|error| invalid(Reason::NoEquipment { message: error.to_string() }))?;
        if head.format != FORMAT {
            return Err(invalid(Reason::NoEquipment { message: format!("\"format\": \"{FORMAT}\"") }));
        }
        if head.version != VERSION {
            return Err(invalid(Reason::EquipmentVersion { version: head.version }));
        }
        let mut read: Self = serde_json::from_str(text)
            .map_err(|error| invalid(Reason::DamagedDocument { message: shortened(&error.to_string()) }))?;
        read.note_removed_fields(text);
        read.validate()?;
        Ok(read)
    }

    /// Names the fields of calibrations that the format no longer has in their origin.
    fn note_removed_fields(&mut self, json: &str) {
        #[derive(Default, Deserialize)]
        #[serde(default)]
        struct Fields {
            cameras: Vec<Fields>,
            calibrations: Vec<Fields>,
            colours: serde_json::Value,
        }
        if !json.contains("\"colours\"") {
            return;
        }
        let fields: Fields = serde_json::from_str(json).unwrap_or_default();
        for (camera, of_camera) in self.cameras.iter_mut().zip(fields.cameras) {
            for (calibration, removed) in camera.calibrations.iter_mut().zip(of_camera.calibrations) {
                let any = usize::from(count_entries(&removed.colours) > 0);
                note_removed(&mut calibration.origin, RemovedFields::OF_CAMERAS, any);
            }
        }
    }

    /// Its JSON, indented for people.
    ///
    /// # Errors
    /// As [`validate`](Self::validate).
    pub fn write(&self) -> Result<String> {
        self.validate()?;
        let written = serde_json::to_string_pretty(self);
        written.map_err(|error| Error::Invalid {
            reason: Reason::CannotWriteJson { message: error.to_string() },
            at: Place::default(),
        })
    }

    /// Checks that names are single and every value is one that a project takes.
    ///
    /// # Errors
    /// [`Error::Invalid`] or [`Error::Duplicate`] with the first fault found.
    pub fn validate(&self) -> Result<()> {
        let mut names = HashSet::new();
        for camera in &self.cameras {
            if !names.insert(&camera.id) {
                let at = Place::camera(&camera.id);
                return Err(Error::Duplicate { kind: Thing::Camera, name: camera.id.clone(), at });
            }
            camera.validate()?;
        }
        let mut names = HashSet::new();
        for bar in &self.bars {
            bar.validate()?;
            if !names.insert(&bar.id) {
                let at = Place::field("bars");
                return Err(Error::Duplicate { kind: Thing::ScaleBar, name: bar.id.clone(), at });
            }
        }
        Ok(())
    }

    /// Takes in what another list has: calibrations of a camera that is known join its own, a scale bar of the same name is
    /// replaced, and nothing is taken away.
    pub fn join(&mut self, other: Self) -> Joined {
        let mut joined = Joined::default();
        for camera in other.cameras {
            joined.calibrations += camera.calibrations.len();
            match self.cameras.iter_mut().find(|known| known.is_same(&camera)) {
                Some(known) => {
                    let before = known.calibrations.len();
                    let added = camera.calibrations.len();
                    camera.calibrations.into_iter().for_each(|calibration| known.keep(calibration));
                    joined.calibrations -= before + added - known.calibrations.len();
                }
                None => {
                    joined.cameras += 1;
                    let id = self.free_name(&camera.id);
                    self.cameras.push(KnownCamera { id, ..camera });
                }
            }
        }
        for bar in other.bars {
            match self.bars.iter_mut().find(|known| known.id == bar.id) {
                Some(known) if *known == bar => {}
                Some(known) => {
                    *known = bar;
                    joined.bars += 1;
                }
                None => {
                    self.bars.push(bar);
                    joined.bars += 1;
                }
            }
        }
        joined
    }

    /// Keeps a calibration: with the camera that is known, or with a new one.
    pub fn keep(&mut self, camera: KnownCamera) {
        self.join(Self { cameras: vec![camera], ..Self::default() });
    }

    /// A camera's name that is not in use, from the one wanted.
    fn free_name(&self, wanted: &str) -> String {
        let free = |name: &String| self.cameras.iter().all(|camera| camera.id != *name);
        let numbered = (2..).map(|n| format!("{wanted} {n}"));
        std::iter::once(wanted.to_owned()).chain(numbered).find(free).unwrap_or_default()
    }
}
