//! Units of photo coordinates and of camera parameters.

use crate::project::{Camera, Parameter};

/// Unit of a parameter of a camera, as photo coordinates have it.
pub fn parameter_unit(camera: &Camera, parameter: Parameter) -> String {
    use Parameter as P;
    let length = photo_unit(camera);
    let brown = camera.interior.model().in_photo_units;
    match parameter {
        P::C | P::X0 | P::Y0 | P::F | P::Fx | P::Fy | P::Cx | P::Cy => length.into(),
        P::K1 if brown => format!("{length}^-2"),
        P::K2 if brown => format!("{length}^-4"),
        P::K3 if brown => format!("{length}^-6"),
        P::P1 | P::P2 if brown => format!("{length}^-1"),
        _ => String::new(),
    }
}

/// Unit of photo coordinates.
pub fn photo_unit(camera: &Camera) -> &'static str {
    if camera.interior.model().in_photo_units && camera.pixel_pitch.is_some() { "mm" } else { "px" }
}
