//! In which unit residuals are shown.

use std::collections::HashMap;

use sightline::adjustment::Adjustment;
use sightline::project::{Camera, Interior, Project};

/// Rms of all image residuals in pixels: residuals over the pixel size of their camera.
pub(super) fn rms_px(adjustment: &Adjustment, project: &Project) -> Option<f64> {
    let cameras: HashMap<&str, &Camera> = project.cameras.iter().map(|c| (c.id.as_str(), c)).collect();
    let (mut sum, mut count) = (0.0, 0);
    for photo in &adjustment.photos {
        let camera = project.photos.iter().find(|p| p.id == photo.id).and_then(|p| cameras.get(p.camera.as_str()))?;
        let [px, py] = unit_per_pixel(camera);
        sum += photo.points as f64 * ((photo.rms_x / px).powi(2) + (photo.rms_y / py).powi(2));
        count += 2 * photo.points;
    }
    (count > 0).then(|| (sum / count as f64).sqrt())
}

/// Residual units per pixel: millimetres in the brown model with a pitch, pixels elsewhere.
pub(super) fn unit_per_pixel(camera: &Camera) -> [f64; 2] {
    if matches!(camera.interior, Interior::Opencv { .. }) { [1.0, 1.0] } else { camera.pitch() }
}

/// How residuals of a camera are shown: micrometres where millimetres are known, else pixels.
pub(super) fn shown_as(camera: Option<&Camera>) -> (f64, &'static str) {
    match camera {
        Some(c) if c.pixel_pitch.is_some() && matches!(c.interior, Interior::Brown { .. }) => (1000.0, "µm"),
        _ => (1.0, "px"),
    }
}

/// One unit for a whole table: micrometres only when every camera has them.
pub(super) fn common_unit(project: &Project) -> (f64, &'static str) {
    let units = project.cameras.iter().map(|c| shown_as(Some(c))).collect::<Vec<_>>();
    if units.iter().all(|u| u.1 == "µm") { (1000.0, "µm") } else { (1.0, "px") }
}

/// Factor from a photo's residuals to the table's unit.
pub(super) fn factors(project: &Project) -> HashMap<String, [f64; 2]> {
    let (factor, unit) = common_unit(project);
    let of = |photo: &sightline::project::Photo| {
        let camera = project.cameras.iter().find(|c| c.id == photo.camera)?;
        let [px, py] = unit_per_pixel(camera);
        Some((photo.id.clone(), if unit == "px" { [1.0 / px, 1.0 / py] } else { [factor, factor] }))
    };
    project.photos.iter().filter_map(of).collect()
}
