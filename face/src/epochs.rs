//! What a comparison of epochs found, as files and as a report.

use serde::{Deserialize, Serialize};
use wasm_bindgen::prelude::*;

use super::fault::thrown;
use super::{Thrown, value};
use js_sys::Uint8Array;
use sightline::Error;
use sightline::adjustment::Adjustment;
use sightline::matching::displaced;
use sightline::monitoring::{Monitoring, Options, Pair};
use sightline::project::ReportSettings;
use sightline_exchange::displacements;
use sightline_report::epochs::report;

/// Written file and options.
#[derive(Serialize, Deserialize)]
#[serde(default)]
struct Wanted {
    /// The pair of drawings, by its number.
    pair: usize,
    /// Times the length of displacements in drawings.
    factor: f64,
    /// The options of the comparison, for the report.
    options: Options,
    /// Language and paper of the report.
    settings: ReportSettings,
}

impl Default for Wanted {
    fn default() -> Self {
        Self { pair: 0, factor: 1.0, options: Options::default(), settings: ReportSettings::default() }
    }
}

/// Writes what a comparison of epochs found: `csv`, `json`, `dxf` and `gltf` of one pair, or the `report` as a page.
#[wasm_bindgen(js_name = exportEpochs)]
pub fn export_epochs(
    #[wasm_bindgen(unchecked_param_type = "Monitoring")] found: JsValue,
    #[wasm_bindgen(unchecked_param_type = "EpochsFormat")] format: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "EpochsExport")] wanted: JsValue,
) -> Thrown<Uint8Array> {
    let written = || {
        let found: Monitoring = value::read(&found, "found")?;
        let format = value::text(&format, "format")?;
        let wanted: Wanted = value::options(&wanted, &[])?;
        match format.as_str() {
            "report" => Ok(report(&found, &wanted.options, &wanted.settings).html().into_bytes()),
            _ => displacements::write(&found, &format, wanted.pair, wanted.factor),
        }
    };
    written().map(|bytes| Uint8Array::from(&bytes[..])).map_err(|error: Error| thrown(&error))
}

/// Displacements of a pair of epochs, `factor` times as long, in the photos of an adjusted project of the object.
#[wasm_bindgen(js_name = displacementsInPhotos, unchecked_return_type = "PhotoDisplacements[]")]
pub fn displacements_in_photos(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Adjustment")] adjustment: JsValue,
    #[wasm_bindgen(unchecked_param_type = "EpochPair")] pair: JsValue,
    #[wasm_bindgen(unchecked_param_type = "number")] factor: JsValue,
) -> Thrown {
    let found = || {
        let adjustment: Adjustment = value::read(&adjustment, "adjustment")?;
        let pair: Pair = value::read(&pair, "pair")?;
        displaced(&value::project(&project)?, &adjustment, &pair, value::read(&factor, "factor")?)
    };
    found().map(|found| value::write(&found)).map_err(|error: Error| thrown(&error))
}
