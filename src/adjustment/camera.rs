//! An adjusted camera. In JSON it is the camera with its adjusted parameters and their standard errors under `sigma`, where a
//! camera of the document has the a priori ones: those are `sigma_a_priori` here.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::Correlation;
use crate::project::{Camera, Interior, Parameter};

/// An adjusted camera.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "Written", into = "Written")]
pub struct AdjustedCamera {
    /// The camera with its adjusted parameters; its standard errors are the a priori ones.
    pub camera: Camera,
    /// The photo whose own interior orientation this is, for cameras with one per photo.
    pub photo: Option<String>,
    /// Standard errors of the estimated parameters.
    pub sigma: BTreeMap<Parameter, f64>,
    /// Size of each estimated parameter of distortion in standard errors, whose neutral value is 0.
    pub significance: BTreeMap<Parameter, f64>,
    /// Correlations of the estimated parameters.
    pub correlation: Correlation,
}

/// As it is written: every key once.
#[derive(Serialize, Deserialize)]
struct Written {
    id: String,
    width: u32,
    height: u32,
    #[serde(default)]
    pixel_pitch: Option<[f64; 2]>,
    #[serde(flatten)]
    interior: Interior,
    #[serde(default)]
    free: Vec<Parameter>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    sigma_a_priori: BTreeMap<Parameter, f64>,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    per_photo: bool,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    photo: Option<String>,
    sigma: BTreeMap<Parameter, f64>,
    #[serde(default)]
    significance: BTreeMap<Parameter, f64>,
    correlation: Correlation,
}

impl From<AdjustedCamera> for Written {
    fn from(adjusted: AdjustedCamera) -> Self {
        let AdjustedCamera { camera, photo, sigma, significance, correlation } = adjusted;
        let Camera { id, width, height, pixel_pitch, interior, free, sigma: sigma_a_priori, per_photo } = camera;
        Self {
            id,
            width,
            height,
            pixel_pitch,
            interior,
            free,
            sigma_a_priori,
            per_photo,
            photo,
            sigma,
            significance,
            correlation,
        }
    }
}

impl From<Written> for AdjustedCamera {
    fn from(written: Written) -> Self {
        let Written { id, width, height, pixel_pitch, interior, free, per_photo, .. } = written;
        let camera =
            Camera { id, width, height, pixel_pitch, interior, free, sigma: written.sigma_a_priori, per_photo };
        Self {
            camera,
            photo: written.photo,
            sigma: written.sigma,
            significance: written.significance,
            correlation: written.correlation,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn every_key_is_written_once_and_nothing_is_lost() {
        let adjusted = AdjustedCamera {
            camera: Camera {
                free: vec![Parameter::C],
                sigma: [(Parameter::X0, 0.5)].into(),
                per_photo: true,
                ..Camera::new("k", 10, 20, Interior::brown(1.5))
            },
            photo: Some("1".into()),
            sigma: [(Parameter::C, 0.25), (Parameter::X0, 0.125)].into(),
            significance: BTreeMap::new(),
            correlation: Correlation::default(),
        };
        let text = serde_json::to_string(&adjusted).unwrap();
        for key in ["\"id\":", "\"sigma\":", "\"model\":", "\"photo\":", "\"sigma_a_priori\":"] {
            assert_eq!(text.matches(key).count(), 1, "{key} {text}");
        }
        assert_eq!(serde_json::from_str::<AdjustedCamera>(&text).unwrap(), adjusted);
        assert_eq!(serde_json::to_value(&adjusted).unwrap()["sigma"]["c"], 0.25);
    }
}
