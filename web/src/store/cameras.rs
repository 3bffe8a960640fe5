//! Which photos share a camera, and what is known of it before any adjustment.

use std::collections::BTreeSet;

use leptos::prelude::*;
use sightline::exif::PhotoInfo;
use sightline::project::{Camera, Interior, Parameter, Project};

use super::document::Change;
use super::{Desk, Selection};
use crate::format;
use crate::i18n::text;

/// Photos with the same signature are taken to share one camera and focus.
#[derive(Clone, Debug, PartialEq)]
pub struct Signature {
    make: Option<String>,
    model: Option<String>,
    focal_length_mm: Option<f64>,
    size: [u32; 2],
    /// Without a focal length the beginning of the file name stands for the camera, as in 043_0005 and 671_0021.
    prefix: Option<String>,
}

impl Signature {
    pub fn of(file: &str, info: &PhotoInfo, size: [u32; 2]) -> Self {
        let prefix = match info.focal_length_mm {
            Some(_) => None,
            None => file.split_once(['_', '-']).map(|(prefix, _)| prefix.to_owned()),
        };
        Self { make: info.make.clone(), model: info.model.clone(), focal_length_mm: info.focal_length_mm, size, prefix }
    }

    /// A short name for people: the beginning of the file names, the model, or a number.
    fn name(&self, project: &Project) -> String {
        let base = self.prefix.as_ref().or(self.model.as_ref()).map(|name| name.trim()).filter(|name| !name.is_empty());
        let free = |id: &String| !project.cameras.iter().any(|c| c.id == *id);
        let plain = base.map(str::to_owned).into_iter();
        let numbered = (1..).map(|n| base.map_or_else(|| n.to_string(), |base| format!("{base} {}", n + 1)));
        plain.chain(numbered).find(free).unwrap_or_default()
    }
}

/// A new camera for photos of this signature, its principal distance from EXIF where that says something.
pub fn camera(signature: &Signature, info: &PhotoInfo, project: &Project) -> Camera {
    let [width, height] = signature.size;
    let mut camera = Camera::new(
        signature.name(project),
        width,
        height,
        Interior::Brown { c: None, x0: 0.0, y0: 0.0, k1: 0.0, k2: 0.0, k3: 0.0, p1: 0.0, p2: 0.0, b1: 0.0, b2: 0.0 },
    );
    camera.pixel_pitch = info.pixel_pitch;
    camera.free = Parameter::BROWN[..8].to_vec();
    if let Some(c) = initial_c(info, &camera) {
        camera.interior.set(Parameter::C, c);
    }
    camera
}

/// The principal distance to start from, in the camera's photo unit: the focal length where the pitch is known.
fn initial_c(info: &PhotoInfo, camera: &Camera) -> Option<f64> {
    let from_exif = || info.principal_distance_px(camera.width, camera.height).map(|c| c * camera.pitch()[0]);
    info.focal_length_mm.filter(|_| camera.pixel_pitch.is_some()).or_else(from_exif)
}

/// The same camera with its photo coordinates in another unit: another pixel pitch, or none (pixels).
pub fn with_pitch(camera: &Camera, pitch: Option<[f64; 2]>) -> Camera {
    let mut changed = Camera { pixel_pitch: pitch, ..camera.clone() };
    let (old, new) = (camera.pitch(), changed.pitch());
    if let Interior::Brown { c, x0, y0, k1, k2, k3, p1, p2, .. } = &mut changed.interior {
        let scale = new[0] / old[0];
        *c = c.map(|c| c * scale);
        *x0 *= scale;
        *y0 *= new[1] / old[1];
        *k1 /= scale.powi(2);
        *k2 /= scale.powi(4);
        *k3 /= scale.powi(6);
        *p1 /= scale;
        *p2 /= scale;
    }
    changed
}

impl Desk {
    fn edit_camera(self, id: &str, edit: impl FnOnce(&mut Camera)) {
        self.change(Change::CameraEdited(id.to_owned()), |document| {
            if let Some(camera) = document.project_mut().cameras.iter_mut().find(|c| c.id == id) {
                edit(camera);
            }
        });
    }

    /// Gives a camera another name; a name in use or none is refused.
    pub fn rename_camera(self, id: &str, name: &str) {
        let taken = self.document.with_untracked(|d| d.project.cameras.iter().any(|c| c.id == name));
        if name == id {
            return;
        }
        if taken || name.is_empty() {
            let name = name.to_owned();
            self.warn(move || text::name_taken(&name));
            self.document.notify();
            return;
        }
        self.change(Change::CameraEdited(name.to_owned()), |document| {
            let project = document.project_mut();
            for camera in project.cameras.iter_mut().filter(|c| c.id == id) {
                camera.id = name.to_owned();
            }
            for photo in project.photos.iter_mut().filter(|p| p.camera == id) {
                photo.camera = name.to_owned();
            }
        });
    }

    /// Takes a pixel pitch in micrometres as typed: one number, two, or nothing for unknown.
    pub fn set_pitch(self, id: &str, typed: &str) {
        let numbers = typed.split(['×', 'x', ';']).map(str::trim).filter(|t| !t.is_empty()).map(format::parse);
        let pitch = match numbers.collect::<Option<Vec<_>>>().as_deref() {
            Some([]) => None,
            Some(&[p]) if p > 0.0 => Some([p / 1000.0, p / 1000.0]),
            Some(&[x, y]) if x > 0.0 && y > 0.0 => Some([x / 1000.0, y / 1000.0]),
            _ => {
                let typed = typed.to_owned();
                self.warn(move || text::not_a_length(&typed));
                self.document.notify();
                return;
            }
        };
        let info = self.exif_of_camera(id);
        self.edit_camera(id, |camera| {
            let untouched = initial_c(&info, camera) == camera.interior.get(distance_parameter(camera));
            *camera = with_pitch(camera, pitch);
            if let Some(c) = initial_c(&info, camera).filter(|_| untouched) {
                camera.interior.set(distance_parameter(camera), c);
            }
        });
    }

    /// Takes a principal distance as typed, in the camera's photo unit.
    pub fn set_principal_distance(self, id: &str, typed: &str) {
        match format::parse(typed).filter(|c| *c > 0.0) {
            Some(c) => self.edit_camera(id, |camera| camera.interior.set(distance_parameter(camera), c)),
            None if typed.trim().is_empty() => self.edit_camera(id, forget_principal_distance),
            None => {
                let typed = typed.to_owned();
                self.warn(move || text::not_a_length(&typed));
                self.document.notify();
            }
        }
    }

    fn exif_of_camera(self, id: &str) -> PhotoInfo {
        let photo =
            self.document.with_untracked(|d| d.project.photos.iter().find(|p| p.camera == id).map(|p| p.id.clone()));
        let info = photo.and_then(|photo| self.files.with_untracked(|f| f.get(&photo).map(|f| f.info.clone())));
        info.unwrap_or_default()
    }

    /// Gives photos to a camera that is there.
    pub fn assign_camera(self, photos: &BTreeSet<String>, camera: &str) {
        let change = Change::CameraAssigned { photos: photos.len(), camera: camera.to_owned() };
        self.change(change, |document| assign(document.project_mut(), photos, camera));
    }

    /// Gives photos a camera of their own, with the values of the one they had.
    pub fn assign_own_camera(self, photos: &BTreeSet<String>) {
        let Some(copy) = self.document.with_untracked(|d| {
            let photo = d.project.photos.iter().find(|p| photos.contains(&p.id))?;
            d.project.cameras.iter().find(|c| c.id == photo.camera).cloned()
        }) else {
            return;
        };
        let taken = |id: &String| self.document.with_untracked(|d| d.project.cameras.iter().any(|c| c.id == *id));
        let mut names = (2..).map(|n| format!("{} {n}", copy.id));
        let Some(name) = names.find(|name| !taken(name)) else { return };
        let change = Change::CameraAssigned { photos: photos.len(), camera: name.clone() };
        self.change(change, |document| {
            let project = document.project_mut();
            project.cameras.push(Camera { id: name.clone(), ..copy });
            assign(project, photos, &name);
        });
    }

    /// Lets photos take part or not; nothing of them is lost.
    pub fn switch_photos(self, photos: &BTreeSet<String>, enabled: bool) {
        let Some(first) = photos.first().cloned() else { return };
        self.change(Change::PhotoSwitched(first), |document| {
            for photo in document.project_mut().photos.iter_mut().filter(|p| photos.contains(&p.id)) {
                photo.enabled = enabled;
            }
        });
    }

    /// Takes photos out of the project with all that was measured in them.
    pub fn remove_photos(self, photos: &BTreeSet<String>) {
        let Some(first) = photos.first().cloned() else { return };
        self.change(Change::PhotoRemoved(first), |document| {
            let project = document.project_mut();
            project.photos.retain(|p| !photos.contains(&p.id));
            project.observations.retain(|o| !photos.contains(&o.photo));
            drop_unused_cameras(project);
            document.detections_mut().retain(|photo, _| !photos.contains(photo));
        });
        if self.selection.with_untracked(|s| s.photo.as_ref().is_some_and(|p| photos.contains(p))) {
            let next = self.document.with_untracked(|d| d.project.photos.first().map(|p| p.id.clone()));
            self.selection.update(|s| *s = Selection { photo: next, ..Selection::default() });
        }
    }
}

fn assign(project: &mut Project, photos: &BTreeSet<String>, camera: &str) {
    for photo in project.photos.iter_mut().filter(|p| photos.contains(&p.id)) {
        photo.camera = camera.to_owned();
    }
    drop_unused_cameras(project);
}

fn drop_unused_cameras(project: &mut Project) {
    let photos = &project.photos;
    project.cameras.retain(|c| photos.iter().any(|p| p.camera == c.id));
}

/// Orientation then finds one.
fn forget_principal_distance(camera: &mut Camera) {
    match &mut camera.interior {
        Interior::Brown { c, .. } => *c = None,
        Interior::Opencv { fx, fy, .. } => (*fx, *fy) = (None, None),
    }
}

/// The parameter that stands for the principal distance.
pub fn distance_parameter(camera: &Camera) -> Parameter {
    match camera.interior {
        Interior::Brown { .. } => Parameter::C,
        Interior::Opencv { .. } => Parameter::F,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [2000, 1333];

    #[test]
    fn photos_without_focal_length_are_told_apart_by_their_names() {
        let info = PhotoInfo { model: Some("NIKON D5600".into()), ..PhotoInfo::default() };
        let (a, b) = (Signature::of("043_0005.tif", &info, SIZE), Signature::of("671_0021.tif", &info, SIZE));
        assert_eq!(a, Signature::of("043_0013.tif", &info, SIZE));
        assert_ne!(a, b);
        assert_eq!(camera(&a, &info, &Project::default()).id, "043");
        let info = PhotoInfo { focal_length_mm: Some(7.3), ..info };
        assert_eq!(Signature::of("a_1.jpg", &info, SIZE), Signature::of("b_1.jpg", &info, SIZE));
    }

    #[test]
    fn names_are_free_and_principal_distances_in_the_photo_unit() {
        let info = PhotoInfo {
            model: Some("X".into()),
            focal_length_mm: Some(24.0),
            pixel_pitch: Some([0.01, 0.01]),
            ..PhotoInfo::default()
        };
        let signature = Signature::of("a.jpg", &info, SIZE);
        let mut project = Project::default();
        let first = camera(&signature, &info, &project);
        assert!(matches!(first.interior, Interior::Brown { c: Some(c), .. } if (c - 24.0).abs() < 1e-12));
        project.cameras.push(first.clone());
        assert_eq!(camera(&signature, &info, &project).id, "X 2");
        let pixels = with_pitch(&first, None);
        assert!(matches!(pixels.interior, Interior::Brown { c: Some(c), .. } if (c - 2400.0).abs() < 1e-9));
    }
}
