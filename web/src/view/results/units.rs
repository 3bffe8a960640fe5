//! In which unit residuals are shown.

use std::collections::HashMap;

use sightline::adjustment::{Adjustment, PhotoUnit};
use sightline::project::Camera;

/// Width and height of a pixel in the unit of the camera's residuals.
pub(super) fn pixel_of(camera: &Camera) -> [f64; 2] {
    PhotoUnit::of(camera).1
}

/// How residuals of a unit are shown: micrometres where they are millimetres.
fn shown(unit: PhotoUnit) -> (f64, &'static str) {
    match unit {
        PhotoUnit::Millimetre => (1000.0, "µm"),
        PhotoUnit::Pixel => (1.0, "px"),
    }
}

/// How residuals of a camera are shown.
pub(super) fn shown_as(camera: Option<&Camera>) -> (f64, &'static str) {
    shown(camera.map(|camera| PhotoUnit::of(camera).0).unwrap_or_default())
}

/// One unit for a whole table: micrometres only when every photo has them.
pub(super) fn common_unit(adjustment: &Adjustment) -> (f64, &'static str) {
    let millimetres = adjustment.photos.iter().all(|photo| photo.unit == PhotoUnit::Millimetre);
    shown(if millimetres { PhotoUnit::Millimetre } else { PhotoUnit::Pixel })
}

/// Factor from a photo's residuals to the table's unit.
pub(super) fn factors(adjustment: &Adjustment) -> HashMap<String, [f64; 2]> {
    let (factor, unit) = common_unit(adjustment);
    let of = |pixel: [f64; 2]| if unit == "px" { pixel.map(|size| 1.0 / size) } else { [factor; 2] };
    adjustment.photos.iter().map(|photo| (photo.id.clone(), of(photo.pixel))).collect()
}
