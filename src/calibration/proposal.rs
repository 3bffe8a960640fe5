//! Camera models suitable for a field of view, before anything was measured.
//!
//! The polynomial of Brown's model runs away at the edge of wide lenses: with barrel distortion residuals are beyond the noise from some 70
//! degrees across the diagonal. Lenses whose focal length would give more than 105 degrees through a straight projection are fisheyes
//! more often than not. It is a proposal: photos decide, see [`super::compare_models`].

use crate::project::{Camera, CameraModel};

/// Field across the diagonal, degrees, from which on Brown's model is not enough, and from which on most lenses are fisheyes.
const WIDE: f64 = 70.0;
const FISHEYE: f64 = 105.0;

/// Field of view across the picture's diagonal in degrees that a principal distance in pixels gives through a straight projection.
pub fn diagonal_field(camera: &Camera, principal_distance_px: f64) -> Option<f64> {
    let half = f64::from(camera.width).hypot(f64::from(camera.height)) / 2.0;
    let is_sound = principal_distance_px > 0.0 && principal_distance_px.is_finite();
    is_sound.then(|| 2.0 * half.atan2(principal_distance_px).to_degrees())
}

/// Names of the models that such a lens is likely to need, the likeliest first; empty if the camera's own model serves, or is one of them.
pub fn proposed_models(camera: &Camera, principal_distance_px: f64) -> Vec<&'static str> {
    let Some(field) = diagonal_field(camera, principal_distance_px) else { return Vec::new() };
    let all = match field {
        field if field >= FISHEYE => vec![CameraModel::OPENCV_FISHEYE.name, CameraModel::OPENCV_RATIONAL.name],
        field if field >= WIDE => vec![CameraModel::OPENCV_RATIONAL.name, CameraModel::OPENCV_FISHEYE.name],
        _ => Vec::new(),
    };
    let own = camera.interior.model().name;
    if all.contains(&own) { Vec::new() } else { all }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::Interior;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn wide_lenses_are_proposed_their_models_and_others_none() {
        let camera = Camera::new("c", 3600, 2400, Interior::brown(1.0));
        // 36 mm are 3600 pixels: a hundred pixels a millimetre of focal length
        for (focal, first) in
            [(85.0, None), (35.0, None), (26.0, Some("opencv_rational")), (12.0, Some("opencv_fisheye"))]
        {
            assert_eq!(proposed_models(&camera, 100.0 * focal).first().copied(), first, "{focal} mm");
        }
        assert!(proposed_models(&camera, f64::NAN).is_empty() && proposed_models(&camera, 0.0).is_empty());
        let focal = Some(1200.0);
        let (fx, fy, cx, cy) = (focal, focal, 1800.0, 1200.0);
        let interior = Interior::OpencvFisheye { fx, fy, cx, cy, k1: 0.0, k2: 0.0, k3: 0.0, k4: 0.0 };
        assert!(proposed_models(&Camera { interior, ..camera }, 1200.0).is_empty());
    }
}
