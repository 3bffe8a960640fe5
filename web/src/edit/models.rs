//! Conversion of a camera to another model: its inputs, and applying its result.

use sightline::project::{Camera, Project};

use crate::document::Document;

/// A camera with the interior orientations of its photos, and nothing else of the document.
pub fn alone(project: &Project, camera: Camera) -> Project {
    let photos = project.photos.iter().filter(|p| p.camera == camera.id && p.interior.is_some()).cloned().collect();
    Project { cameras: vec![camera], photos, ..Project::default() }
}

/// Takes a converted camera with its photos; with the values and the choice of parameters of an adjusted one, where there is one.
pub fn take(document: &mut Document, converted: &Project, adjusted: Option<&Camera>) {
    for camera in &converted.cameras {
        // What its parameters were observed with before belongs to another model: K1 is another quantity there.
        document.sigmas_of_held.retain(|(of, _), _| *of != camera.id);
    }
    let project = document.project_mut();
    for camera in &converted.cameras {
        let Some(own) = project.cameras.iter_mut().find(|c| c.id == camera.id) else { continue };
        *own = camera.clone();
        if let Some(adjusted) = adjusted.filter(|a| a.interior.model() == camera.interior.model()) {
            own.interior = adjusted.interior;
            own.free.clone_from(&adjusted.free);
        }
    }
    for photo in &converted.photos {
        if let Some(own) = project.photos.iter_mut().find(|p| p.id == photo.id) {
            own.interior = photo.interior;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sightline::calibration::convert_camera;
    use sightline::project::{CameraModel, Interior, Parameter, Photo};

    #[test]
    fn a_converted_camera_takes_its_place_and_leaves_all_else() {
        let camera = |id: &str| Camera { per_photo: true, ..Camera::new(id, 1000, 800, Interior::brown(900.0)) };
        let photo = |id: &str, of: &str, own: Option<f64>| Photo {
            id: id.into(),
            camera: of.into(),
            file: format!("{id}.jpg"),
            interior: own.map(Interior::brown),
            ..Photo::default()
        };
        let project = Project {
            cameras: vec![camera("a"), camera("b")],
            photos: vec![photo("1", "a", Some(910.0)), photo("2", "b", Some(905.0)), photo("3", "a", None)].into(),
            ..Project::default()
        };
        let before = project.clone();
        let (converted, left) = convert_camera(&alone(&project, camera("a")), "a", "opencv").expect("converted");
        assert!(left.max_px.expect("stated") < 1e-6);
        let held = |id: &str| ((id.to_owned(), Parameter::K1), 1e-6);
        let mut document =
            Document { project: project.into(), sigmas_of_held: [held("a"), held("b")].into(), ..Document::default() };
        take(&mut document, &converted, None);
        assert_eq!(document.sigmas_of_held, [held("b")].into());
        let project = document.project.clone();
        assert_eq!(project.cameras[0].interior.model(), &CameraModel::OPENCV);
        assert_eq!(project.photos[0].interior.expect("its own").model(), &CameraModel::OPENCV);
        assert_eq!((&project.cameras[1], &project.photos[1..]), (&before.cameras[1], &before.photos[1..]));
        let mut adjusted = project.cameras[0].clone();
        adjusted.interior.set(Parameter::K1, 0.5);
        adjusted.free = vec![Parameter::F, Parameter::K1];
        take(&mut document, &converted, Some(&adjusted));
        assert_eq!(document.project.cameras[0], adjusted);
    }
}
