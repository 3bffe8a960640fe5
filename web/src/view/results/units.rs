//! In which unit residuals are shown.

use sightline::adjustment::PhotoUnit;
use sightline::project::Camera;
pub(super) use sightline::report::names::{common_unit, factors};

/// Width and height of a pixel in the unit of the camera's residuals.
pub(super) fn pixel_of(camera: &Camera) -> [f64; 2] {
    PhotoUnit::of(camera).1
}

/// How residuals of a camera are shown.
pub(super) fn shown_as(camera: Option<&Camera>) -> (f64, &'static str) {
    sightline::report::names::shown(camera.map(|camera| PhotoUnit::of(camera).0).unwrap_or_default())
}
