//! Cameras fixed to each other: photos taken together share the relative pose of their cameras.

use std::collections::HashMap;

use serde::{Deserialize, Serialize};

use super::Project;
use super::validation::{LARGEST, known};
use crate::error::{Error, Place, Reason, Result, Thing};

/// Smallest standard error of a relative rotation, radians: no mount holds better, and far stiffer equations lose their digits.
const LEAST_ROTATION: f64 = 1e-8;

/// Cameras on one mount, which release together.
///
/// The pose of every camera relative to the first one is unknown, and the same at every exposure up to the standard errors given here.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rig {
    /// A row an exposure, a column a camera of the rig: the photos taken together; null if a camera took none. Relative poses are
    /// counted from the first column's camera.
    pub exposures: Vec<Vec<Option<String>>>,
    /// How well the mount keeps the position of a camera relative to the first one, per axis: standard error in the project's unit.
    pub sigma_position: f64,
    /// How well it keeps the rotation, per axis: standard error in radians.
    pub sigma_rotation: f64,
}

impl Rig {
    /// Number of cameras.
    pub fn cameras(&self) -> usize {
        self.exposures.first().map_or(0, Vec::len)
    }

    /// Takes photos out; exposures that no two photos are left of go, and so does a rig without exposures.
    #[must_use]
    pub fn without(mut self, gone: impl Fn(&str) -> bool) -> Option<Self> {
        for exposure in &mut self.exposures {
            for photo in exposure.iter_mut().filter(|photo| photo.as_deref().is_some_and(&gone)) {
                *photo = None;
            }
        }
        self.exposures.retain(|exposure| exposure.iter().flatten().count() > 1);
        (!self.exposures.is_empty()).then_some(self)
    }
}

impl Project {
    pub(super) fn validate_rig(&self, photos: &HashMap<&str, usize>) -> Result<()> {
        let Some(rig) = &self.rig else { return Ok(()) };
        let fault = |reason, field: String| Err(Error::Invalid { reason, at: Place::field(field) });
        if !(rig.sigma_position > 0.0 && rig.sigma_position < LARGEST) {
            return fault(Reason::RigPosition, "rig.sigma_position".into());
        }
        if !(rig.sigma_rotation >= LEAST_ROTATION && rig.sigma_rotation < LARGEST) {
            return fault(Reason::RigRotation, "rig.sigma_rotation".into());
        }
        let mut camera_of_column: Vec<Option<&str>> = vec![None; rig.cameras()];
        let mut seen = HashMap::new();
        for (row, exposure) in rig.exposures.iter().enumerate() {
            let field = format!("rig.exposures[{row}]");
            if exposure.len() != rig.cameras() || exposure.len() < 2 {
                return fault(Reason::RigColumns, field);
            }
            for (camera, id) in camera_of_column.iter_mut().zip(exposure).filter_map(|(c, id)| Some((c, id.as_ref()?)))
            {
                let at = || Place::photo(id).with_field(&field);
                let photo = known(Thing::Photo, id, photos, at)?;
                if seen.insert(photo, row).is_some() {
                    return Err(Error::Duplicate { kind: Thing::Photo, name: id.clone(), at: at() });
                }
                let own = self.photos[photo].camera.as_str();
                if camera.replace(own).is_some_and(|other| other != own) {
                    return Err(Error::Invalid { reason: Reason::RigCamera, at: at() });
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::{Camera, Interior, Photo};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn project() -> Project {
        let photo = |id: &str, camera: &str| Photo { id: id.into(), camera: camera.into(), ..Photo::default() };
        let some = |id: &str| Some(id.to_owned());
        Project {
            cameras: ["left", "right"].map(|id| Camera::new(id, 100, 80, Interior::brown(90.0))).into(),
            photos: vec![photo("l1", "left"), photo("r1", "right"), photo("l2", "left"), photo("r2", "right")].into(),
            rig: Some(Box::new(Rig {
                exposures: vec![vec![some("l1"), some("r1")], vec![some("l2"), None]],
                sigma_position: 0.1,
                sigma_rotation: 1e-4,
            })),
            ..Project::default()
        }
    }

    #[test]
    fn a_sound_rig_passes_and_every_fault_is_placed() {
        project().validate().expect("sound");
        type Fault = fn(&mut Rig);
        let faults: [(Fault, &str, &str); 8] = [
            (|r| r.sigma_position = 0.0, "invalid", "rig.sigma_position"),
            (|r| r.sigma_rotation = f64::NAN, "invalid", "rig.sigma_rotation"),
            (|r| r.sigma_rotation = 1e-12, "invalid", "rig.sigma_rotation"),
            (|r| r.exposures[1] = vec![None], "invalid", "rig.exposures[1]"),
            (|r| r.exposures[0].truncate(1), "invalid", "rig.exposures[0]"),
            (|r| r.exposures[0][1] = Some("x".into()), "unknown", "rig.exposures[0]"),
            (|r| r.exposures[1][1] = Some("r1".into()), "duplicate", "rig.exposures[1]"),
            (|r| r.exposures[1] = vec![Some("r2".into()), Some("l2".into())], "invalid", "r2"),
        ];
        for (k, (fault, code, place)) in faults.into_iter().enumerate() {
            let mut project = project();
            fault(project.rig.as_mut().expect("a rig"));
            let error = project.validate().expect_err("a fault");
            assert_eq!(error.code(), code, "fault {k}: {error}");
            assert!(error.to_string().contains(place), "fault {k}: {error}");
        }
    }

    #[test]
    fn photos_that_go_leave_the_rig() {
        let rig = *project().rig.expect("a rig");
        assert_eq!(rig.clone().without(|id| id == "l2").map(|rig| rig.exposures.len()), Some(1));
        assert_eq!(rig.without(|id| id == "r1"), None);
    }

    #[test]
    fn a_rig_is_written_and_read() {
        let project = project();
        let text = serde_json::to_string(&project).expect("written");
        assert!(text.contains(r#""rig":{"exposures":[["l1","r1"],["l2",null]]"#), "{text}");
        assert_eq!(serde_json::from_str::<Project>(&text).expect("read"), project);
    }
}
