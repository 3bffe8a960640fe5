//! Detection in a photo, independent of its decoder.

use super::{detect_photo, measure_in_photo, sites};
use crate::detection::{DetectOptions, Detection, Target};
use crate::error::Result;
use crate::sensor::Shot;

/// Finds and measures the targets of a photo.
///
/// # Errors
/// As for [`detect`](super::detect).
pub fn detect_shot(shot: &Shot, options: &DetectOptions) -> Result<Detection> {
    match shot {
        Shot::Photo(photo) => detect_photo(photo, options),
        Shot::Sensor(sensor) => sites::detect_sensor(sensor, options),
    }
}

/// Measures the one target at a click; `None` if there is no target.
///
/// # Errors
/// As for [`measure_at`](super::measure_at).
pub fn measure_in_shot(shot: &Shot, u: f64, v: f64, options: &DetectOptions) -> Result<Option<Target>> {
    match shot {
        Shot::Photo(photo) => measure_in_photo(photo, u, v, options),
        Shot::Sensor(sensor) => sites::measure_in_sensor(sensor, u, v, options),
    }
}
