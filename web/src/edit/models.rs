//! Another model for a camera: what its conversion needs of the document, and taking what it gives.

use sightline::project::{Camera, Project};

/// A camera with the interior orientations of its photos, and nothing else of the document.
pub fn alone(project: &Project, camera: Camera) -> Project {
    let photos = project.photos.iter().filter(|p| p.camera == camera.id && p.interior.is_some()).cloned().collect();
    Project { cameras: vec![camera], photos, ..Project::default() }
}

/// Takes a converted camera with its photos; with the values and the choice of parameters of an adjusted one, where there is one.
pub fn take(project: &mut Project, converted: &Project, adjusted: Option<&Camera>) {
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
        let mut project = Project {
            cameras: vec![camera("a"), camera("b")],
            photos: vec![photo("1", "a", Some(910.0)), photo("2", "b", Some(905.0)), photo("3", "a", None)],
            ..Project::default()
        };
        let before = project.clone();
        let (converted, left) = convert_camera(&alone(&project, camera("a")), "a", "opencv").expect("converted");
        assert!(left.max_px.expect("stated") < 1e-6);
        take(&mut project, &converted, None);
        assert_eq!(project.cameras[0].interior.model(), &CameraModel::OPENCV);
        assert_eq!(project.photos[0].interior.expect("its own").model(), &CameraModel::OPENCV);
        assert_eq!((&project.cameras[1], &project.photos[1..]), (&before.cameras[1], &before.photos[1..]));
        let mut adjusted = project.cameras[0].clone();
        adjusted.interior.set(Parameter::K1, 0.5);
        adjusted.free = vec![Parameter::F, Parameter::K1];
        take(&mut project, &converted, Some(&adjusted));
        assert_eq!(project.cameras[0], adjusted);
    }
}
