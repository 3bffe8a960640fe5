//! Cameras and photos: which photos share a camera, what is known of it before any adjustment, what is estimated of it.

use std::collections::BTreeSet;
use std::sync::Arc;

use sightline::adjustment::AdjustedCamera;
use sightline::exif::{Aberration, LensCorrection, PhotoInfo, Setting};
use sightline::project::{Camera, Interior, Parameter, Photo, Project};

use super::pairs;
use crate::document::Document;

/// Photos with the same signature are taken to share one camera and focus.
#[derive(Clone, Debug, PartialEq)]
pub struct Signature {
    make: Option<String>,
    model: Option<String>,
    focal_length_mm: Option<f64>,
    size: [u32; 2],
    /// Without a focal length the beginning of the file name identifies the camera, as in 043_0005 and 671_0021.
    prefix: Option<String>,
    /// Whether the camera corrected their distortion according to its note: corrected and uncorrected photos are of different cameras.
    straightened: bool,
}

impl Signature {
    pub fn of(file: &str, info: &PhotoInfo, size: [u32; 2]) -> Self {
        let prefix = match info.focal_length_mm {
            Some(_) => None,
            None => file.split_once(['_', '-']).map(|(prefix, _)| prefix.to_owned()),
        };
        let bent = |correction: &LensCorrection| {
            correction.aberration == Aberration::Distortion && correction.setting != Setting::Off
        };
        let straightened = !pairs::is_raw(file) && info.corrections.iter().any(bent);
        let (make, model) = (info.make.clone(), info.model.clone());
        Self { make, model, focal_length_mm: info.focal_length_mm, size, prefix, straightened }
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

/// A new camera for photos of this signature, its principal distance from EXIF if that contains one.
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

/// Adds a photo: with the camera of a photo that `shares` its signature, or one of its own. Its identifier.
pub fn add_photo(
    project: &mut Project,
    file: &str,
    info: &PhotoInfo,
    size: [u32; 2],
    shares: Option<&str>,
    taken: &dyn Fn(&str) -> bool,
) -> String {
    let known = || kept_from_first_epoch(project, &Signature::of(file, info, size));
    let sharing = project.photos.iter().find(|p| Some(p.id.as_str()) == shares).map(|p| p.camera.clone());
    let camera = match sharing.or_else(known) {
        Some(camera) => camera,
        None => {
            let camera = camera(&Signature::of(file, info, size), info, project);
            let id = camera.id.clone();
            project.cameras.push(camera);
            id
        }
    };
    let largest = project.photos.iter().filter_map(|p| p.id.parse::<u32>().ok()).max().unwrap_or(0);
    // Undo may bring back a photo whose file is kept under its identifier: that one is not given away.
    let free = (1..).map(|k| largest.saturating_add(k).to_string()).find(|id| !taken(id) || largest == u32::MAX);
    let id = free.unwrap_or_default();
    project.photos.push(Photo { id: id.clone(), camera, file: file.to_owned(), enabled: true, ..Photo::default() });
    id
}

/// In a later epoch, the camera of the first that takes such photos: of those that no photo has yet, the one of this name, or the only
/// one of this size.
fn kept_from_first_epoch(project: &Project, signature: &Signature) -> Option<String> {
    project.epoch.as_ref()?;
    let [width, height] = signature.size;
    let waits =
        |c: &&Camera| [c.width, c.height] == [width, height] && !project.photos.iter().any(|p| p.camera == c.id);
    let waiting = project.cameras.iter().filter(waits).collect::<Vec<_>>();
    let base = signature.prefix.as_ref().or(signature.model.as_ref()).map(|name| name.trim());
    let named = waiting.iter().find(|c| base.is_some_and(|base| c.id == base));
    let only = || (waiting.len() == 1).then(|| &waiting[0]);
    named.or_else(only).map(|camera| camera.id.clone())
}

/// The principal distance to start from, in the camera's photo unit: the focal length where the pitch is known.
fn initial_c(info: &PhotoInfo, camera: &Camera) -> Option<f64> {
    let from_exif = || info.principal_distance_px(camera.width, camera.height).map(|c| c * camera.pitch()[0]);
    info.focal_length_mm.filter(|_| camera.pixel_pitch.is_some()).or_else(from_exif)
}

/// The parameter that is the principal distance.
pub fn distance_parameter(camera: &Camera) -> Parameter {
    camera.interior.model().distance
}

/// Powers of the photo unit that a parameter has: a change of the unit by `s` changes it by `s` to this power.
fn power(parameter: Parameter) -> i32 {
    match parameter {
        Parameter::C | Parameter::X0 | Parameter::Y0 => 1,
        Parameter::K1 => -2,
        Parameter::K2 => -4,
        Parameter::K3 => -6,
        Parameter::P1 | Parameter::P2 => -1,
        _ => 0,
    }
}

/// The same camera with its photo coordinates in another unit: another pixel pitch, or none (pixels).
pub fn with_pitch(camera: &Camera, pitch: Option<[f64; 2]>) -> Camera {
    let mut changed = Camera { pixel_pitch: pitch, ..camera.clone() };
    if !camera.interior.model().in_photo_units {
        return changed;
    }
    let (old, new) = (camera.pitch(), changed.pitch());
    for parameter in Parameter::BROWN {
        let axis = usize::from(parameter == Parameter::Y0);
        let factor = (new[axis] / old[axis]).powi(power(parameter));
        if let Some(value) = camera.interior.get(parameter) {
            changed.interior.set(parameter, value * factor);
        }
        if let Some(sigma) = changed.sigma.get_mut(&parameter) {
            *sigma *= factor;
        }
    }
    changed
}

fn camera_mut<'a>(project: &'a mut Project, id: &str) -> Option<&'a mut Camera> {
    project.cameras.iter_mut().find(|c| c.id == id)
}

/// Gives a camera another pixel pitch; a principal distance that is still the one of EXIF is converted with it.
pub fn set_pitch(project: &mut Project, id: &str, pitch: Option<[f64; 2]>, info: &PhotoInfo) {
    let Some(camera) = camera_mut(project, id) else { return };
    let untouched = initial_c(info, camera) == camera.interior.get(distance_parameter(camera));
    *camera = with_pitch(camera, pitch);
    if let Some(c) = initial_c(info, camera).filter(|_| untouched) {
        camera.interior.set(distance_parameter(camera), c);
    }
}

/// Gives a camera a principal distance to start from; none: orientation finds one.
pub fn set_principal_distance(project: &mut Project, id: &str, value: Option<f64>) {
    let Some(camera) = camera_mut(project, id) else { return };
    match value {
        Some(value) => camera.interior.set(distance_parameter(camera), value),
        None => camera.interior.forget_principal_distance(),
    }
}

/// Gives a parameter the value it starts from.
pub fn set_initial(project: &mut Project, id: &str, parameter: Parameter, value: f64) {
    if let Some(camera) = camera_mut(project, id) {
        camera.interior.set(parameter, value);
    }
}

/// A camera of the project with the best that is known of it: its values in the present result, where there is one.
pub fn as_known(document: &Document, camera: &Camera) -> Camera {
    let of_all = |adjusted: &&AdjustedCamera| adjusted.camera.id == camera.id && adjusted.photo.is_none();
    let found = document.current().and_then(|result| result.adjustment.cameras.iter().find(of_all));
    Camera { interior: found.map_or(camera.interior, |adjusted| adjusted.camera.interior), ..camera.clone() }
}

/// Gives a camera another name.
pub fn rename(project: &mut Project, from: &str, to: &str) {
    for camera in project.cameras.iter_mut().filter(|c| c.id == from) {
        camera.id = to.to_owned();
    }
    for photo in project.photos.iter_mut().filter(|p| p.camera == from) {
        photo.camera = to.to_owned();
    }
}

/// Gives photos to a camera that is there; a camera without photos goes.
pub fn assign(project: &mut Project, photos: &BTreeSet<String>, camera: &str) {
    for photo in project.photos.iter_mut().filter(|p| photos.contains(&p.id)) {
        photo.camera = camera.to_owned();
    }
    drop_unused(project);
}

/// Gives photos a camera of their own, with the values of the one they had; its name.
pub fn assign_own(project: &mut Project, photos: &BTreeSet<String>) -> Option<String> {
    let photo = project.photos.iter().find(|p| photos.contains(&p.id))?;
    let copy = project.cameras.iter().find(|c| c.id == photo.camera).cloned()?;
    let taken = |id: &String| project.cameras.iter().any(|c| c.id == *id);
    let name = (2..).map(|n| format!("{} {n}", copy.id)).find(|name| !taken(name))?;
    project.cameras.push(Camera { id: name.clone(), ..copy });
    assign(project, photos, &name);
    Some(name)
}

fn drop_unused(project: &mut Project) {
    let photos = &project.photos;
    project.cameras.retain(|c| photos.iter().any(|p| p.camera == c.id));
}

/// Lets photos take part or not.
pub fn switch_photos(project: &mut Project, photos: &BTreeSet<String>, enabled: bool) {
    for photo in project.photos.iter_mut().filter(|p| photos.contains(&p.id)) {
        photo.enabled = enabled;
    }
}

/// Takes photos out of the project with all that was measured in them.
pub fn remove_photos(document: &mut Document, photos: &BTreeSet<String>) {
    let project = document.project_mut();
    project.photos.retain(|p| !photos.contains(&p.id));
    project.observations.retain(|o| !photos.contains(&o.photo));
    let rig = project.rig.take();
    project.rig = rig.and_then(|rig| rig.without(|id| photos.contains(id))).map(Box::new);
    drop_unused(project);
    super::points::tidy(project);
    document.detections_mut().retain(|photo, _| !photos.contains(photo));
    // what is asked about a photo goes with it
    Arc::make_mut(&mut document.doubtful).retain(|doubtful| !photos.contains(&doubtful.photo));
}

/// Lets a parameter be estimated or held. What it was observed with is kept, and is back when it is estimated again.
pub fn set_free(document: &mut Document, id: &str, parameter: Parameter, free: bool) {
    let key = (id.to_owned(), parameter);
    let kept = document.sigmas_of_held.get(&key).copied();
    let Some(camera) = camera_mut(document.project_mut(), id).filter(|c| has(c, parameter)) else { return };
    camera.free.retain(|p| *p != parameter);
    let observed = camera.sigma.remove(&parameter);
    if free {
        camera.free.push(parameter);
        sort_free(camera);
        if let Some(sigma) = observed.or(kept) {
            camera.sigma.insert(parameter, sigma);
        }
        document.sigmas_of_held.remove(&key);
    } else if let Some(sigma) = observed {
        document.sigmas_of_held.insert(key, sigma);
    }
}

/// Observes a parameter with a standard error, which estimates it, or estimates it without.
pub fn observe_parameter(document: &mut Document, id: &str, parameter: Parameter, sigma: Option<f64>) {
    document.sigmas_of_held.remove(&(id.to_owned(), parameter));
    let Some(camera) = camera_mut(document.project_mut(), id).filter(|c| has(c, parameter)) else { return };
    match sigma {
        Some(sigma) => {
            camera.sigma.insert(parameter, sigma);
        }
        None => {
            camera.sigma.remove(&parameter);
        }
    }
    if sigma.is_some() && !camera.free.contains(&parameter) {
        camera.free.push(parameter);
        sort_free(camera);
    }
}

/// Whether the camera's model has a parameter: a model that was chosen meanwhile may have others.
fn has(camera: &Camera, parameter: Parameter) -> bool {
    camera.interior.parameters().contains(&parameter)
}

fn sort_free(camera: &mut Camera) {
    let order = camera.interior.parameters().to_vec();
    camera.free.sort_by_key(|p| order.iter().position(|o| o == p));
}

/// Observes a photo's projection centre, in the object system; none on an axis: not observed there.
pub fn observe_position(project: &mut Project, photo: &str, position: [f64; 3], sigma: [Option<f64>; 3]) {
    if let Some(photo) = project.photos.iter_mut().find(|p| p.id == photo) {
        photo.position = Some(position);
        photo.sigma_position = Some(sigma);
    }
}

/// Observes a photo's projection centre no more; the value stays as the one to start from.
pub fn forget_position(project: &mut Project, photo: &str) {
    if let Some(photo) = project.photos.iter_mut().find(|p| p.id == photo) {
        photo.sigma_position = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [2000, 1333];

    fn info() -> PhotoInfo {
        PhotoInfo {
            model: Some("X".into()),
            focal_length_mm: Some(24.0),
            pixel_pitch: Some([0.01, 0.01]),
            ..PhotoInfo::default()
        }
    }

    fn project() -> Project {
        let mut project = Project::default();
        add_photo(&mut project, "a.jpg", &info(), SIZE, None, &|_| false);
        add_photo(&mut project, "b.jpg", &info(), SIZE, Some("1"), &|_| false);
        project
    }

    fn set(ids: &[&str]) -> BTreeSet<String> {
        ids.iter().map(|id| (*id).to_owned()).collect()
    }

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
    fn what_the_camera_straightened_is_another_camera_s() {
        let with = |aberration, setting| PhotoInfo {
            corrections: vec![LensCorrection { aberration, setting, tag: "Sony 0x2013".into() }],
            ..info()
        };
        let of = |file: &str, info: &PhotoInfo| Signature::of(file, info, SIZE);
        let straight = with(Aberration::Distortion, Setting::Auto);
        assert_ne!(of("a.jpg", &info()), of("b.jpg", &straight));
        // what is measured on the sensor's own samples is not straightened
        assert_eq!(of("a.arw", &info()), of("b.arw", &straight));
        assert_eq!(of("a.jpg", &info()), of("b.jpg", &with(Aberration::Distortion, Setting::Off)));
        assert_eq!(of("a.jpg", &info()), of("b.jpg", &with(Aberration::Vignetting, Setting::On)));
    }

    #[test]
    fn names_are_free_and_principal_distances_in_the_photo_unit() {
        let mut project = project();
        assert_eq!((project.cameras.len(), project.photos[1].camera.as_str()), (1, "X"));
        let first = project.cameras[0].clone();
        assert!(matches!(first.interior, Interior::Brown { c: Some(c), .. } if (c - 24.0).abs() < 1e-12));
        add_photo(&mut project, "c.jpg", &info(), SIZE, None, &|_| false);
        assert_eq!(project.cameras[1].id, "X 2");
        // Undo may bring 4 and 5 back, whose files are kept.
        assert_eq!(add_photo(&mut project, "d.jpg", &info(), SIZE, Some("1"), &|id| ["4", "5"].contains(&id)), "6");
        let pixels = with_pitch(&first, None);
        assert!(matches!(pixels.interior, Interior::Brown { c: Some(c), .. } if (c - 2400.0).abs() < 1e-9));
    }

    #[test]
    fn a_change_of_unit_comes_back() {
        let mut camera = project().cameras[0].clone();
        for (i, parameter) in Parameter::BROWN.into_iter().enumerate() {
            camera.interior.set(parameter, 0.1 * (i + 1) as f64);
            camera.sigma.insert(parameter, 0.01);
        }
        let back = with_pitch(&with_pitch(&camera, None), camera.pixel_pitch);
        for parameter in Parameter::BROWN {
            let (a, b) = (camera.interior.get(parameter).unwrap(), back.interior.get(parameter).unwrap());
            assert!((a - b).abs() < 1e-12 && (back.sigma[&parameter] - 0.01).abs() < 1e-12, "{parameter:?}");
        }
    }

    #[test]
    fn an_exif_distance_follows_the_pitch_and_a_typed_one_stays_the_same_length() {
        let mut p = project();
        set_pitch(&mut p, "X", Some([0.02, 0.02]), &info());
        assert_eq!(p.cameras[0].interior.get(Parameter::C), Some(24.0));
        set_principal_distance(&mut p, "X", Some(30.0));
        set_pitch(&mut p, "X", Some([0.01, 0.01]), &info());
        assert_eq!(p.cameras[0].interior.get(Parameter::C), Some(15.0));
        set_principal_distance(&mut p, "X", None);
        assert_eq!(p.cameras[0].interior.get(Parameter::C), None);
        set_initial(&mut p, "X", Parameter::K1, 0.5);
        assert_eq!(p.cameras[0].interior.get(Parameter::K1), Some(0.5));
    }

    #[test]
    fn photos_change_their_camera_and_unused_cameras_go() {
        let mut p = project();
        assert_eq!(assign_own(&mut p, &set(&["2"])).as_deref(), Some("X 2"));
        assert_eq!((p.cameras.len(), p.photos[1].camera.as_str()), (2, "X 2"));
        rename(&mut p, "X 2", "wide");
        assign(&mut p, &set(&["1"]), "wide");
        assert_eq!(p.cameras.iter().map(|c| c.id.as_str()).collect::<Vec<_>>(), ["wide"]);
        switch_photos(&mut p, &set(&["1"]), false);
        assert!(!p.photos[0].enabled && p.photos[1].enabled);
        let mut document = Document { project: p.into(), ..Document::default() };
        remove_photos(&mut document, &set(&["1", "2"]));
        assert!(document.project.cameras.is_empty() && document.project.photos.is_empty());
    }

    #[test]
    fn holding_a_parameter_keeps_what_it_was_observed_with() {
        let mut document = Document { project: project().into(), ..Document::default() };
        let camera = |d: &Document| d.project.cameras[0].clone();
        observe_parameter(&mut document, "X", Parameter::B1, Some(0.002));
        assert!(camera(&document).free.contains(&Parameter::B1));
        set_free(&mut document, "X", Parameter::B1, false);
        assert!(!camera(&document).estimated().contains(&Parameter::B1));
        set_free(&mut document, "X", Parameter::B1, true);
        assert_eq!(camera(&document).sigma.get(&Parameter::B1), Some(&0.002));
        observe_parameter(&mut document, "X", Parameter::B1, None);
        assert!(camera(&document).sigma.is_empty() && camera(&document).estimated().contains(&Parameter::B1));
        assert_eq!(camera(&document).free, Parameter::BROWN[..9].to_vec());
    }

    #[test]
    fn projection_centres_are_observed_and_not() {
        let mut p = project();
        observe_position(&mut p, "1", [1.0, 2.0, 3.0], [Some(0.1), None, Some(0.2)]);
        assert_eq!(p.photos[0].sigma_position, Some([Some(0.1), None, Some(0.2)]));
        forget_position(&mut p, "1");
        assert_eq!((p.photos[0].position, p.photos[0].sigma_position), (Some([1.0, 2.0, 3.0]), None));
    }
}
