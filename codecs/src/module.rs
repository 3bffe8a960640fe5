//! The module's face: one function, called by the glue of pkg/ and of the page's workers.

use js_sys::{Array, Error as JsError, Uint8Array, Uint16Array};
use wasm_bindgen::prelude::*;

use sightline::detection::Channel;
use sightline::error::{Damage, Error, Place};
use sightline::image::Samples;

use crate::Wanted;

/// A bug here throws, where an abort would stop the whole module.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|panic| {
        wasm_bindgen::throw_val(JsError::new(&format!("a bug in a decoder: {panic}")).into());
    }));
}

/// Opens a file: the header as JSON, the samples (Uint8Array or Uint16Array) and the small picture, in a list. What is wrong is thrown as the
/// JSON of an error of the engine.
#[wasm_bindgen]
pub fn unpack(bytes: &[u8], channel: &str, samples: bool, max_side: u32) -> Result<Array, JsValue> {
    let channel: Channel = serde_json::from_value(channel.into()).unwrap_or_default();
    let unpacked = crate::unpack(bytes, Wanted { channel, samples, max_side }).map_err(|error| thrown(&error))?;
    let header = JsValue::from_str(&unpacked.header_text());
    let samples: JsValue = match &unpacked.samples {
        Samples::U8(samples) => Uint8Array::from(&samples[..]).into(),
        Samples::U16(samples) => Uint16Array::from(&samples[..]).into(),
    };
    Ok([header, samples, Uint8Array::from(&unpacked.small[..]).into()].into_iter().collect())
}

/// The error for a trap of a decoder.
#[wasm_bindgen]
pub fn trapped(message: &str) -> String {
    let reason = Damage::Decoder { message: sightline::error::shortened(message) };
    text(&Error::BrokenImage { reason, at: Place::default() })
}

fn thrown(error: &Error) -> JsValue {
    JsValue::from_str(&text(error))
}

fn text(error: &Error) -> String {
    serde_json::to_string(error).unwrap_or_default()
}
