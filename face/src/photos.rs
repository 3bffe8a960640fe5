//! Photos: their targets, one by one or all, their lateral colour, and the metadata of their files.

use js_sys::{Uint8Array, Uint16Array};
use serde::Serialize;
use sightline::detection::{Channel, DetectOptions};
use sightline::image::{Grey, Samples};
use sightline::sensor::{self, Shot};
use sightline::{Error, decode, detect, exif};
use wasm_bindgen::prelude::*;

use super::fault::thrown;
use super::{Thrown, codecs, plain, value};

/// Finds and measures the targets of a photo, from the bytes of its file (PNG, JPEG, TIFF, BMP, HEIC).
#[wasm_bindgen(js_name = detect, unchecked_return_type = "Detection")]
pub fn detect_file(
    #[wasm_bindgen(unchecked_param_type = "Uint8Array | ArrayBuffer")] bytes: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "DetectOptions")] options: JsValue,
) -> Thrown {
    let found = || {
        let options: DetectOptions = value::options(&options, &[])?;
        detect::detect_shot(&codecs::shot(&plain::bytes(&bytes, "bytes")?, options.channel)?, &options)
    };
    found().map(value::detection_object).map_err(|error| thrown(&error))
}

/// Finds and measures the targets of a grey picture, given row by row from the top left.
#[wasm_bindgen(js_name = detectGray, unchecked_return_type = "Detection")]
pub fn detect_grey(
    #[wasm_bindgen(unchecked_param_type = "number")] width: JsValue,
    #[wasm_bindgen(unchecked_param_type = "number")] height: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Uint8Array | Uint8ClampedArray | Uint16Array")] samples: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "DetectOptions")] options: JsValue,
) -> Thrown {
    let found = || {
        let options: DetectOptions = value::options(&options, &[])?;
        detect::detect(&grey_of(&width, &height, &samples)?.view()?, &options)
    };
    found().map(value::detection_object).map_err(|error| thrown(&error))
}

fn grey_of(width: &JsValue, height: &JsValue, samples: &JsValue) -> sightline::Result<Grey> {
    let (width, height) = (value::whole(width, "width")?, value::whole(height, "height")?);
    Ok(Grey { width, height, samples: samples_of(samples)? })
}

fn samples_of(samples: &JsValue) -> sightline::Result<Samples> {
    let samples = plain::samples(samples, "samples")?;
    Ok(match samples.dyn_into::<Uint16Array>() {
        Ok(words) => Samples::U16(words.to_vec()),
        // Clamped bytes are bytes here.
        Err(bytes) => Samples::U8(bytes.unchecked_into::<Uint8Array>().to_vec()),
    })
}

/// Measures the one target at a place of a photo, in a window around it; null if there is none.
#[wasm_bindgen(js_name = measureAt, unchecked_return_type = "Target | null")]
pub fn measure_at(
    #[wasm_bindgen(unchecked_param_type = "Uint8Array | ArrayBuffer")] bytes: JsValue,
    #[wasm_bindgen(unchecked_param_type = "number")] u: JsValue,
    #[wasm_bindgen(unchecked_param_type = "number")] v: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "DetectOptions")] options: JsValue,
) -> Thrown {
    measured_at(&u, &v, &options, |options| codecs::shot(&plain::bytes(&bytes, "bytes")?, options.channel))
}

/// The same in a picture that is decoded already.
#[wasm_bindgen(js_name = measureAtGray, unchecked_return_type = "Target | null")]
pub fn measure_at_gray(
    #[wasm_bindgen(unchecked_param_type = "number")] width: JsValue,
    #[wasm_bindgen(unchecked_param_type = "number")] height: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Uint8Array | Uint8ClampedArray | Uint16Array")] samples: JsValue,
    #[wasm_bindgen(unchecked_param_type = "number")] u: JsValue,
    #[wasm_bindgen(unchecked_param_type = "number")] v: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "DetectOptions")] options: JsValue,
) -> Thrown {
    measured_at(&u, &v, &options, |_| {
        Ok(Shot::Photo(decode::DecodedPhoto {
            grey: grey_of(&width, &height, &samples)?,
            damaged_rows: Vec::new(),
            page: None,
        }))
    })
}

fn measured_at(
    u: &JsValue,
    v: &JsValue,
    options: &JsValue,
    photo: impl FnOnce(&DetectOptions) -> sightline::Result<Shot>,
) -> Thrown {
    let found = || {
        let options: DetectOptions = value::options(options, &[])?;
        let (u, v) = (value::number(u, "u")?, value::number(v, "v")?);
        detect::measure_in_shot(&photo(&options)?, u, v, &options)
    };
    found().map(|target| value::write(&target)).map_err(|error| thrown(&error))
}

/// Measures the targets of a photo in green, red and blue: the lateral chromatic aberration of its lens.
#[wasm_bindgen(js_name = coloursApart, unchecked_return_type = "ColoursApart")]
pub fn colours_apart(
    #[wasm_bindgen(unchecked_param_type = "Uint8Array | ArrayBuffer")] bytes: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "DetectOptions")] options: JsValue,
) -> Thrown {
    let found = || {
        let options: DetectOptions = value::options(&options, &[])?;
        let bytes = plain::bytes(&bytes, "bytes")?;
        detect::colours_apart(|channel| codecs::shot(&bytes, channel), &options)
    };
    found().map(|apart| value::write(&apart)).map_err(|error| thrown(&error))
}

/// Metadata of a photo and its camera: the size of the stored grid, and EXIF. Hints for initial values.
#[wasm_bindgen(js_name = photoInfo, unchecked_return_type = "PhotoInfo")]
pub fn photo_info(#[wasm_bindgen(unchecked_param_type = "Uint8Array | ArrayBuffer")] bytes: JsValue) -> Thrown {
    #[derive(Serialize)]
    struct Description {
        width: u32,
        height: u32,
        bits: u32,
        #[serde(flatten)]
        info: exif::PhotoInfo,
    }
    let found = || {
        let bytes = plain::bytes(&bytes, "bytes")?;
        if let Some(format) = decode::packed(&bytes) {
            let header = codecs::unpack(&bytes, format, Channel::default(), false)?.header;
            let sensor::Header { width, height, bits, info, .. } = header;
            return Ok(Description { width, height, bits, info });
        }
        let decode::Size { width, height, bits } = decode::size(&bytes)?;
        Ok(Description { width, height, bits, info: exif::read(&bytes) })
    };
    found().map(|description| value::write(&description)).map_err(|error: Error| thrown(&error))
}
