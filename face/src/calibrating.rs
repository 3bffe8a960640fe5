//! Calibrations: what the photos cover, which models a field of view asks for, uncertainty by distance, residuals by column and row.

use wasm_bindgen::prelude::*;

use super::fault::thrown;
use super::{Thrown, value};
use sightline::calibration::{self, BandOptions, DistanceOptions};
use sightline::error::Error;
use sightline::project::Camera;

/// Coverage by the photos of a camera: radius, parts of the image, roll, tilt.
#[wasm_bindgen(js_name = calibrationCoverage, unchecked_return_type = "Coverage")]
pub fn calibration_coverage(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "string")] camera: JsValue,
) -> Thrown {
    let found = || {
        let id = if camera.is_undefined() || camera.is_null() { None } else { Some(value::text(&camera, "camera")?) };
        calibration::coverage(&value::project(&project)?, id.as_deref())
    };
    found().map(|found| value::write(&found)).map_err(|error: Error| thrown(&error))
}

/// Standard errors of the pixels at which a calibrated camera sees points, by their distance.
#[wasm_bindgen(js_name = uncertaintyOverDistance, unchecked_return_type = "DistanceUncertainty")]
pub fn uncertainty_over_distance(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Adjustment")] adjustment: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "DistanceOptions")] options: JsValue,
) -> Thrown {
    let found = || {
        let asked: DistanceOptions = value::options(&options, &[])?;
        let (project, adjustment) = (value::project(&project)?, value::read(&adjustment, "adjustment")?);
        calibration::uncertainty_over_distance(&project, &adjustment, &asked)
    };
    found().map(|found| value::write(&found)).map_err(|error: Error| thrown(&error))
}

/// Root mean square of a camera's residuals by column and by row, beside what the standard errors let expect.
#[wasm_bindgen(js_name = residualBands, unchecked_return_type = "ResidualBands")]
pub fn residual_bands(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Adjustment")] adjustment: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "BandOptions")] options: JsValue,
) -> Thrown {
    let found = || {
        let asked: BandOptions = value::options(&options, &[])?;
        let (project, adjustment) = (value::project(&project)?, value::read(&adjustment, "adjustment")?);
        calibration::residual_bands(&project, &adjustment, &asked)
    };
    found().map(|found| value::write(&found)).map_err(|error: Error| thrown(&error))
}

/// Names of the camera models that a lens of this principal distance is likely to need, the likeliest first.
#[wasm_bindgen(js_name = proposedModels, unchecked_return_type = "CameraModelName[]")]
pub fn proposed_models(
    #[wasm_bindgen(unchecked_param_type = "Camera")] camera: JsValue,
    #[wasm_bindgen(unchecked_param_type = "number")] principal_distance_px: JsValue,
) -> Thrown {
    let found = || {
        let camera = value::read::<Camera>(&camera, "camera")?;
        Ok(calibration::proposed_models(&camera, value::number(&principal_distance_px, "principal_distance_px")?))
    };
    found().map(|found| value::write(&found)).map_err(|error: Error| thrown(&error))
}
