//! The photos of a document with their measurements.

use std::collections::{HashMap, HashSet};

use crate::project::{Camera, Parameter, Project};

/// An image measurement of a point.
#[derive(Clone, Copy, Debug)]
pub struct PixelMeasurement {
    /// Point, as its place in the document.
    pub point: usize,
    /// Where it was measured, pixels.
    pub pixel: [f64; 2],
    /// A priori standard error, pixels.
    pub sigma_px: f64,
}

/// A photo that takes part, with its measurements.
#[derive(Clone, Debug)]
pub struct PhotoMeasurements {
    /// Place in the document.
    pub photo: usize,
    /// Place of its camera in the document.
    pub camera: usize,
    /// The camera, with the photo's own interior orientation.
    pub lens: Camera,
    /// Its measurements, ordered by point.
    pub measurements: Vec<PixelMeasurement>,
}

/// The enabled photos with their measurements: the enabled ones, and those that an orientation has set aside.
pub fn measured_photos(project: &Project) -> Vec<PhotoMeasurements> {
    let cameras: HashMap<&str, usize> = project.cameras.iter().enumerate().map(|(k, c)| (c.id.as_str(), k)).collect();
    let points: HashMap<&str, usize> = project.points.iter().enumerate().map(|(k, p)| (p.id.as_str(), k)).collect();
    let aside: HashSet<(&str, &str)> = project.set_aside.iter().map(|s| (s.photo.as_str(), s.point.as_str())).collect();
    let mut photos: Vec<PhotoMeasurements> = Vec::new();
    let mut at: HashMap<&str, usize> = HashMap::new();
    for (k, photo) in project.photos.iter().enumerate().filter(|(_, photo)| photo.enabled) {
        let Some(&camera) = cameras.get(photo.camera.as_str()) else { continue };
        at.insert(&photo.id, photos.len());
        photos.push(PhotoMeasurements {
            photo: k,
            camera,
            lens: project.cameras[camera].of_photo(photo),
            measurements: Vec::new(),
        });
    }
    for o in &project.observations {
        let offered = o.enabled || aside.contains(&(o.photo.as_str(), o.point.as_str()));
        let (Some(&photo), Some(&point)) = (at.get(o.photo.as_str()), points.get(o.point.as_str())) else { continue };
        if offered {
            let [su, sv] = o.sigma.both();
            let sigma_px = (0.5 * (su * su + sv * sv)).sqrt();
            photos[photo].measurements.push(PixelMeasurement { point, pixel: [o.u, o.v], sigma_px });
        }
    }
    photos.iter_mut().for_each(|photo| photo.measurements.sort_by_key(|measurement| measurement.point));
    photos
}

/// Measurements of the points that two photos show.
pub fn common(a: &PhotoMeasurements, b: &PhotoMeasurements) -> Vec<(PixelMeasurement, PixelMeasurement)> {
    let (mut i, mut j) = (0, 0);
    let mut pairs = Vec::new();
    while let (Some(m), Some(n)) = (a.measurements.get(i), b.measurements.get(j)) {
        match m.point.cmp(&n.point) {
            std::cmp::Ordering::Less => i += 1,
            std::cmp::Ordering::Greater => j += 1,
            std::cmp::Ordering::Equal => {
                pairs.push((*m, *n));
                (i, j) = (i + 1, j + 1);
            }
        }
    }
    pairs
}

/// Principal distance in pixels; `None` if it is missing or no length.
pub fn distance_px(camera: &Camera) -> Option<f64> {
    let px = camera.principal_distance_px()?;
    (px.is_finite() && px > 0.0).then_some(px)
}

/// Gives a camera a principal distance in pixels.
pub fn set_distance_px(camera: &mut Camera, px: f64) {
    camera.set_principal_distance_px(px);
}

/// The longer side of the sensor grid, pixels.
pub fn longer_side(camera: &Camera) -> f64 {
    f64::from(camera.width.max(camera.height))
}

/// Whether a parameter of a camera is estimated without having been observed.
pub fn is_free(camera: &Camera, parameter: Parameter) -> bool {
    camera.free.contains(&parameter) && !camera.sigma.contains_key(&parameter)
}

/// Names of the principal distance.
pub const DISTANCES: [Parameter; 4] = [Parameter::C, Parameter::F, Parameter::Fx, Parameter::Fy];
