//! Oriented photos for matching: pose, camera and targets as rays.

use nalgebra::Vector3;

use crate::camera::{ideal_from_pixel, pixel_from_camera_point};
use crate::initial::Pose;
use crate::project::{Camera, Project};

/// An oriented photo.
pub(super) struct OrientedPhoto {
    /// Identifier.
    pub id: String,
    /// Camera, as it took the photo.
    pub camera: Camera,
    /// Exterior orientation.
    pub pose: Pose,
    /// Principal distance in pixels: turns ideal coordinates into pixels.
    pub principal_distance_px: f64,
}

impl OrientedPhoto {
    /// The enabled photos of the project that have an orientation and a principal distance, in its order.
    pub fn all(project: &Project) -> Vec<Self> {
        let oriented = |photo: &crate::project::Photo| {
            let pose = Pose::of_photo(photo).filter(|_| photo.enabled)?;
            let camera = project.cameras.iter().find(|c| c.id == photo.camera)?.of_photo(photo);
            let principal_distance_px = camera.principal_distance_px()?;
            let usable = principal_distance_px.is_finite() && principal_distance_px > 0.0;
            usable.then(|| Self { id: photo.id.clone(), camera, pose, principal_distance_px })
        };
        project.photos.iter().filter_map(oriented).collect()
    }

    /// Ideal coordinates of a pixel.
    pub fn ray(&self, pixel: [f64; 2]) -> Option<[f64; 2]> {
        ideal_from_pixel(&self.camera, pixel)
    }

    /// Whether an object point falls onto the sensor.
    pub fn shows(&self, point: &Vector3<f64>) -> bool {
        self.on_sensor(self.pose.to_camera(point))
    }

    /// Whether ideal coordinates fall onto the sensor.
    pub fn images(&self, [x, y]: [f64; 2]) -> bool {
        self.on_sensor(Vector3::new(x, y, -1.0))
    }

    fn on_sensor(&self, in_camera: Vector3<f64>) -> bool {
        let (width, height) = (f64::from(self.camera.width), f64::from(self.camera.height));
        pixel_from_camera_point(&self.camera, in_camera)
            .is_some_and(|[u, v]| u > 0.0 && v > 0.0 && u < width && v < height)
    }
}
