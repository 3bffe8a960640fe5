//! Arguments as text and bytes: `plain.js` looks at every value before anything is made of it, and throws nothing.

use js_sys::{Array, JsString, Uint8Array};
use sightline::error::{Error, Expected, Place, Reason, Result, shortened};
use wasm_bindgen::prelude::*;

#[wasm_bindgen(module = "/src/plain.js")]
extern "C" {
    /// The content that was read, or the error with its place.
    type Read;
    #[wasm_bindgen(method, getter)]
    fn text(this: &Read) -> Option<String>;
    #[wasm_bindgen(method, getter)]
    fn value(this: &Read) -> JsValue;
    #[wasm_bindgen(method, getter)]
    fn path(this: &Read) -> Option<String>;
    #[wasm_bindgen(method, getter)]
    fn expected(this: &Read) -> Option<String>;
    #[wasm_bindgen(method, getter)]
    fn message(this: &Read) -> Option<String>;

    #[wasm_bindgen(js_name = readPlain)]
    fn read_plain(value: &JsValue, name: &str, without: &Array) -> Read;
    #[wasm_bindgen(js_name = readField)]
    fn read_field(value: &JsValue, name: &str) -> Read;
    #[wasm_bindgen(js_name = readBytes)]
    fn read_bytes(value: &JsValue, name: &str) -> Read;
    #[wasm_bindgen(js_name = readSamples)]
    fn read_samples(value: &JsValue, name: &str) -> Read;
    #[wasm_bindgen(js_name = readFiles)]
    fn read_files(value: &JsValue, name: &str) -> Read;
}

impl Read {
    fn checked(self) -> Result<Self> {
        let Some(expected) = self.expected() else { return Ok(self) };
        let path = self.path().unwrap_or_default();
        let name = if path.is_empty() { "value".to_owned() } else { shortened(&path) };
        let reason = match Expected::named(&expected) {
            Some(expected) => Reason::NotOfKind { name, expected },
            None => Reason::Unreadable { name, message: shortened(&self.message().unwrap_or_default()) },
        };
        Err(Error::Invalid { reason, at: Place::field(path) })
    }
}

/// JSON of a value; `name` stands before the path of what is wrong, fields named in `without` are left out of an object.
pub fn json(value: &JsValue, name: &str, without: &[&str]) -> Result<String> {
    let without: Array = without.iter().map(|name| JsString::from(*name)).collect();
    Ok(read_plain(value, name, &without).checked()?.text().unwrap_or_default())
}

/// A field of an object; undefined where there is none.
pub fn field(value: &JsValue, name: &str) -> Result<JsValue> {
    Ok(read_field(value, name).checked()?.value())
}

/// Bytes of a file.
pub fn bytes(value: &JsValue, name: &str) -> Result<Vec<u8>> {
    Ok(read_bytes(value, name).checked()?.value().unchecked_into::<Uint8Array>().to_vec())
}

/// Samples of a picture: a Uint8Array, Uint8ClampedArray or Uint16Array.
pub fn samples(value: &JsValue, name: &str) -> Result<JsValue> {
    Ok(read_samples(value, name).checked()?.value())
}

/// Files by name.
pub fn files(value: &JsValue, name: &str) -> Result<Vec<(String, Vec<u8>)>> {
    let read: Array = read_files(value, name).checked()?.value().unchecked_into();
    let (names, contents): (Array, Array) = (read.get(0).unchecked_into(), read.get(1).unchecked_into());
    let content = |(name, content): (JsValue, JsValue)| {
        (name.as_string().unwrap_or_default(), content.unchecked_into::<Uint8Array>().to_vec())
    };
    Ok(names.iter().zip(contents.iter()).map(content).collect())
}
