//! Names of parameters and units, the same in the report and on the desk.

use std::collections::HashMap;

use sightline::adjustment::{Adjustment, PhotoUnit};
use sightline::project::{Camera, Parameter};

/// A parameter as people write it.
pub fn parameter_name(parameter: Parameter) -> &'static str {
    match parameter {
        Parameter::C => "c",
        Parameter::F => "f",
        Parameter::Fx => "fx",
        Parameter::Fy => "fy",
        Parameter::X0 => "x₀",
        Parameter::Y0 => "y₀",
        Parameter::Cx => "cx",
        Parameter::Cy => "cy",
        Parameter::K1 => "K₁",
        Parameter::K2 => "K₂",
        Parameter::K3 => "K₃",
        Parameter::P1 => "P₁",
        Parameter::P2 => "P₂",
        Parameter::B1 => "B₁",
        Parameter::B2 => "B₂",
        Parameter::K4 => "K₄",
        Parameter::K5 => "K₅",
        Parameter::K6 => "K₆",
    }
}

/// The unit of a parameter, from the camera's photo unit.
pub fn parameter_unit(camera: &Camera, parameter: Parameter) -> String {
    let unit = if camera.pixel_pitch.is_some() { "mm" } else { "px" };
    if !camera.interior.model().in_photo_units {
        let in_pixels =
            matches!(parameter, Parameter::F | Parameter::Fx | Parameter::Fy | Parameter::Cx | Parameter::Cy);
        return if in_pixels { "px".to_owned() } else { String::new() };
    }
    match parameter {
        Parameter::K1 => format!("{unit}⁻²"),
        Parameter::K2 => format!("{unit}⁻⁴"),
        Parameter::K3 => format!("{unit}⁻⁶"),
        Parameter::P1 | Parameter::P2 => format!("{unit}⁻¹"),
        Parameter::B1 | Parameter::B2 => String::new(),
        _ => unit.to_owned(),
    }
}

/// How residuals of a unit are shown: factor and unit, micrometres where they are millimetres.
pub fn shown(unit: PhotoUnit) -> (f64, &'static str) {
    match unit {
        PhotoUnit::Millimetre => (1000.0, "µm"),
        PhotoUnit::Pixel => (1.0, "px"),
    }
}

/// One unit for a whole table: micrometres only when every photo has them.
pub fn common_unit(adjustment: &Adjustment) -> (f64, &'static str) {
    let millimetres = adjustment.photos.iter().all(|photo| photo.unit == PhotoUnit::Millimetre);
    shown(if millimetres { PhotoUnit::Millimetre } else { PhotoUnit::Pixel })
}

/// Factor from a photo's residuals to the table's unit.
pub fn factors(adjustment: &Adjustment) -> HashMap<String, [f64; 2]> {
    let (factor, unit) = common_unit(adjustment);
    let of = |pixel: [f64; 2]| if unit == "px" { pixel.map(|size| 1.0 / size) } else { [factor; 2] };
    adjustment.photos.iter().map(|photo| (photo.id.clone(), of(photo.pixel))).collect()
}
