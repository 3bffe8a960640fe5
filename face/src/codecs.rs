//! Files whose decoders are a module of their own: `codecs.js` loads it and hands over what it makes of a file.

use js_sys::{Array, Promise, Uint8Array, Uint16Array};
use sightline::decode::{self, Packed};
use sightline::detection::Channel;
use sightline::error::{Damage, Error, Place, Result};
use sightline::image::Samples;
use sightline::sensor::{Shot, Unpacked};
use wasm_bindgen::prelude::*;

#[wasm_bindgen(module = "/src/codecs.js")]
extern "C" {
    type Answer;
    #[wasm_bindgen(method, getter)]
    fn unpacked(this: &Answer) -> Option<Array>;
    #[wasm_bindgen(method, getter)]
    fn fault(this: &Answer) -> Option<String>;
    #[wasm_bindgen(method, getter)]
    fn missing(this: &Answer) -> Option<String>;

    #[wasm_bindgen(js_name = loadDecoders)]
    fn load(source: &JsValue) -> Promise;
    #[wasm_bindgen(catch, js_name = loadDecodersSync)]
    fn load_sync(module: &JsValue) -> std::result::Result<(), JsValue>;
    #[wasm_bindgen(js_name = unpack)]
    fn ask(bytes: &[u8], channel: &str, samples: bool, max_side: u32) -> Answer;
}

/// Loads the decoders of HEIC and RAW: from a wasm module, a response or an address, else from beside this module. In Node and in
/// workers they load by themselves when the first such file comes.
#[wasm_bindgen(js_name = initCodecs, unchecked_return_type = "Promise<void>")]
pub fn init_codecs(
    #[wasm_bindgen(unchecked_optional_param_type = "InitInput | Promise<InitInput>")] source: JsValue,
) -> Promise {
    load(&source)
}

/// The same at once, from bytes or a compiled module.
#[wasm_bindgen(js_name = initCodecsSync)]
pub fn init_codecs_sync(
    #[wasm_bindgen(unchecked_param_type = "SyncInitInput")] module: JsValue,
) -> std::result::Result<(), JsValue> {
    load_sync(&module)
}

/// A photo ready to be measured, from any decoder.
pub fn shot(bytes: &[u8], channel: Channel) -> Result<Shot> {
    match decode::packed(bytes) {
        None => decode::photo(bytes, channel).map(Shot::Photo),
        Some(format) => unpack(bytes, format, channel, true)?.into_shot(),
    }
}

/// Output of the decoders for a file; without samples unless they are requested.
pub fn unpack(bytes: &[u8], format: Packed, channel: Channel, samples: bool) -> Result<Unpacked> {
    let name = match channel {
        Channel::Grey => "grey",
        Channel::Red => "red",
        Channel::Green => "green",
        Channel::Blue => "blue",
    };
    let answer = ask(bytes, name, samples, 0);
    if let Some(message) = answer.missing() {
        return Err(Error::DecoderMissing { format: format.to_string(), message, at: Place::default() });
    }
    let Some(parts) = answer.unpacked() else {
        return Err(serde_json::from_str(&answer.fault().unwrap_or_default()).unwrap_or(Error::BrokenImage {
            reason: Damage::Decoder { message: "the decoder stopped".into() },
            at: Place::default(),
        }));
    };
    let samples = match parts.get(1).dyn_into::<Uint16Array>() {
        Ok(words) => Samples::U16(words.to_vec()),
        Err(bytes) => Samples::U8(bytes.unchecked_into::<Uint8Array>().to_vec()),
    };
    Unpacked::read(&parts.get(0).as_string().unwrap_or_default(), samples, Vec::new())
}
