//! Parameters of cameras in words and cells.

use sightline::project::{Camera, CameraModel, Parameter};
pub use sightline_report::names::{parameter_name, parameter_unit};

use crate::format;
use crate::i18n::text;

/// Value, sigma and unit of a parameter, with a power of ten where the value is small.
pub fn parameter_cells(
    camera: &Camera,
    parameter: Parameter,
    value: f64,
    sigma: Option<f64>,
) -> (String, String, String) {
    let (value, sigma, exponent) = format::with_sigma(value, sigma);
    let unit = parameter_unit(camera, parameter);
    let unit = if exponent == 0 { unit } else { format!("{} {unit}", format::power(exponent)) };
    (value, sigma, unit)
}

/// A model's name as people read it, by its name in the document.
pub fn model_name(model: &str) -> &'static str {
    match model {
        m if m == CameraModel::BROWN.name => text::model_brown(),
        m if m == CameraModel::OPENCV.name => text::model_opencv(),
        m if m == CameraModel::OPENCV_RATIONAL.name => text::model_opencv_rational(),
        _ => text::model_opencv_fisheye(),
    }
}
