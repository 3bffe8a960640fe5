//! Cameras with implausible data.

use super::framing::Framing;
use super::seen::{DISTANCES, distance_px, longer_side};
use crate::adjustment::{CameraDoubt, ImplausibleCamera};
use crate::project::{Camera, Project};

impl ImplausibleCamera {
    /// The same for a photo whose framing differs.
    pub fn of_framing(camera: &Camera, photo: &str, framing: Framing) -> Self {
        let photo = photo.to_owned();
        let doubt = match framing {
            Framing::Resized { factor } => CameraDoubt::Resized { photo, factor },
            Framing::Cropped { offset } => CameraDoubt::Cropped { photo, offset },
            Framing::OtherDistance { px } => CameraDoubt::OtherDistance { photo, value: px * units(camera) },
        };
        Self { camera: camera.id.clone(), doubt }
    }
}

/// Fields of view along the longer side, radians. Beyond, a lens draws no straight lines straight, and the models here mean nothing; below
/// are telescopes, and slips of the unit.
const WIDEST: f64 = 150.0 * std::f64::consts::PI / 180.0;
/// Of a fisheye without distortion; the picture may be wider than what the lens images.
const WIDEST_FISHEYE: f64 = std::f64::consts::TAU;
const NARROWEST: f64 = std::f64::consts::PI / 180.0;
/// Distance from the border of the picture that a measured centre may have outwards, as a share of the longer side: targets are cut by it.
const OUTSIDE: f64 = 0.01;

/// Unit of a camera's principal distance, pixels.
fn units(camera: &Camera) -> f64 {
    camera.residual_pitch()[0]
}

/// Implausible values of the cameras, from the cameras alone and from the measurements in their photos.
pub fn implausible(project: &Project) -> Vec<ImplausibleCamera> {
    let mut found = Vec::new();
    for camera in &project.cameras {
        let id = || camera.id.clone();
        if let Some(px) = distance_px(camera) {
            let is_wide = camera.interior.model().is_wide;
            let half = 0.5 * longer_side(camera) / px;
            let angle = 2.0 * if is_wide { half } else { half.atan() };
            let widest = if is_wide { WIDEST_FISHEYE } else { WIDEST };
            if !(NARROWEST..=widest).contains(&angle) {
                let pixels = units(camera) == 1.0 && camera.pixel_pitch.is_none();
                let doubt = CameraDoubt::FieldOfView { angle, value: px * units(camera), pixels };
                found.push(ImplausibleCamera { camera: id(), doubt });
            }
        }
        let margin = OUTSIDE * longer_side(camera);
        let limits = [camera.width, camera.height].map(|side| f64::from(side) + margin);
        let own: std::collections::HashSet<&str> =
            project.photos.iter().filter(|p| p.enabled && p.camera == camera.id).map(|p| p.id.as_str()).collect();
        let measured = project.observations.iter().filter(|o| o.enabled && own.contains(o.photo.as_str()));
        let (mut photos, mut largest): (Vec<String>, [f64; 2]) = (Vec::new(), [0.0; 2]);
        for o in measured {
            largest = [largest[0].max(o.u), largest[1].max(o.v)];
            let outside = o.u > limits[0] || o.v > limits[1];
            if outside && !photos.contains(&o.photo) {
                photos.push(o.photo.clone());
            }
        }
        if !photos.is_empty() {
            let doubt = CameraDoubt::ImageSize { photos, size: [camera.width, camera.height], measured: largest };
            found.push(ImplausibleCamera { camera: id(), doubt });
        }
    }
    found
}

/// The project without implausible principal distances: they are missing, and free if they were observed.
pub fn without(project: &Project, doubts: &[ImplausibleCamera]) -> Option<Project> {
    let is_doubted = |camera: &Camera| {
        doubts.iter().any(|d| d.camera == camera.id && matches!(d.doubt, CameraDoubt::FieldOfView { .. }))
    };
    if !project.cameras.iter().any(is_doubted) {
        return None;
    }
    let mut project = project.clone();
    for camera in project.cameras.iter_mut().filter(|camera| is_doubted(camera)) {
        camera.interior.forget_principal_distance();
        for distance in DISTANCES {
            if camera.sigma.remove(&distance).is_some() && !camera.free.contains(&distance) {
                camera.free.push(distance);
            }
        }
    }
    Some(project)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::Interior;
    use crate::project::{Observation, Parameter, Photo, Sigma};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn project(camera: Camera) -> Project {
        let photo = Photo { id: "p".into(), camera: camera.id.clone(), enabled: true, ..Photo::default() };
        Project { cameras: vec![camera], photos: vec![photo].into(), ..Project::default() }
    }

    #[test]
    fn fields_of_view_from_one_to_a_hundred_and_fifty_degrees_are_taken() {
        for degrees in [0.2, 0.9, 1.1, 5.0, 40.0, 120.0, 149.0, 151.0, 179.0_f64] {
            let px = 2000.0 / (0.5 * degrees.to_radians()).tan();
            let brown = Camera::new("k", 4000, 3000, Interior::brown(px));
            let pitch = Some([0.004, 0.004]);
            let metric = Camera { pixel_pitch: pitch, interior: Interior::brown(0.004 * px), ..brown.clone() };
            let (fx, fy, cx, cy) = (Some(px), Some(px), 2000.0, 1500.0);
            let interior = Interior::Opencv { fx, fy, cx, cy, k1: 0.0, k2: 0.0, p1: 0.0, p2: 0.0, k3: 0.0 };
            let opencv = Camera { interior, ..brown.clone() };
            for (camera, in_pixels) in [(brown, true), (metric, false), (opencv, true)] {
                let found = implausible(&project(camera.clone()));
                assert_eq!(found.len(), usize::from(!(1.0..=150.0).contains(&degrees)), "{degrees}");
                for one in &found {
                    let CameraDoubt::FieldOfView { angle, pixels, .. } = one.doubt else { panic!("{one:?}") };
                    assert!((angle.to_degrees() - degrees).abs() < 1e-9 && pixels == in_pixels);
                }
            }
        }
    }

    #[test]
    fn what_is_not_believed_is_missing_and_the_rest_stays() {
        let mut camera = Camera::new("k", 4000, 3000, Interior::brown(36.0));
        camera.sigma.insert(Parameter::C, 0.1);
        let given = project(camera);
        let doubts = implausible(&given);
        let without = without(&given, &doubts).expect("a doubt");
        assert_eq!(without.cameras[0].interior.get(Parameter::C), None);
        assert!(without.cameras[0].sigma.is_empty() && without.cameras[0].free == [Parameter::C]);
        assert_eq!(super::without(&given, &[]), None);
    }

    #[test]
    fn measurements_beyond_the_picture_are_of_another_size() {
        let mut project = project(Camera::new("k", 4000, 3000, Interior::brown(4000.0)));
        let at = |u, v| Observation {
            photo: "p".into(),
            point: "1".into(),
            u,
            v,
            sigma: Sigma::One(0.1),
            enabled: true,
            target: None,
        };
        project.observations = vec![at(3990.0, 2990.0), at(4003.0, 5.0)].into();
        assert_eq!(implausible(&project), []);
        project.observations.push(at(5800.0, 100.0));
        let doubt = CameraDoubt::ImageSize { photos: vec!["p".into()], size: [4000, 3000], measured: [5800.0, 2990.0] };
        assert_eq!(implausible(&project), [ImplausibleCamera { camera: "k".into(), doubt }]);
    }
}
