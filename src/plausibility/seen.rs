//! The photos of a document with their measurements.

use std::collections::{HashMap, HashSet};

use crate::project::{Camera, Parameter, Project};

/// A measurement.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    /// Point, as its place in the document.
    pub point: usize,
    /// Where it was measured, pixels.
    pub pixel: [f64; 2],
    /// A priori standard error, pixels.
    pub sigma_px: f64,
}

/// A photo that takes part.
#[derive(Clone, Debug)]
pub struct Shot {
    /// Place in the document.
    pub photo: usize,
    /// Place of its camera in the document.
    pub camera: usize,
    /// What it was taken with.
    pub lens: Camera,
    /// What was measured in it, by point.
    pub marks: Vec<Mark>,
}

/// The enabled photos with their measurements: the enabled ones, and those that an orientation has set aside.
pub fn shots(project: &Project) -> Vec<Shot> {
    let cameras: HashMap<&str, usize> = project.cameras.iter().enumerate().map(|(k, c)| (c.id.as_str(), k)).collect();
    let points: HashMap<&str, usize> = project.points.iter().enumerate().map(|(k, p)| (p.id.as_str(), k)).collect();
    let aside: HashSet<(&str, &str)> = project.set_aside.iter().map(|s| (s.photo.as_str(), s.point.as_str())).collect();
    let mut shots: Vec<Shot> = Vec::new();
    let mut at: HashMap<&str, usize> = HashMap::new();
    for (k, photo) in project.photos.iter().enumerate().filter(|(_, photo)| photo.enabled) {
        let Some(&camera) = cameras.get(photo.camera.as_str()) else { continue };
        at.insert(&photo.id, shots.len());
        shots.push(Shot { photo: k, camera, lens: project.cameras[camera].of_photo(photo), marks: Vec::new() });
    }
    for o in &project.observations {
        let offered = o.enabled || aside.contains(&(o.photo.as_str(), o.point.as_str()));
        let (Some(&shot), Some(&point)) = (at.get(o.photo.as_str()), points.get(o.point.as_str())) else { continue };
        if offered {
            let [su, sv] = o.sigma.both();
            let sigma_px = (0.5 * (su * su + sv * sv)).sqrt();
            shots[shot].marks.push(Mark { point, pixel: [o.u, o.v], sigma_px });
        }
    }
    shots.iter_mut().for_each(|shot| shot.marks.sort_by_key(|mark| mark.point));
    shots
}

/// Measurements of the points that two photos show.
pub fn common(a: &Shot, b: &Shot) -> Vec<(Mark, Mark)> {
    let (mut i, mut j) = (0, 0);
    let mut pairs = Vec::new();
    while let (Some(m), Some(n)) = (a.marks.get(i), b.marks.get(j)) {
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

/// Principal distance in pixels; none where it is missing or no length.
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
