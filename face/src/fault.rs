//! Errors as JavaScript's Error: a stable `code`, the sentence as `message`, the place as `where`, the values as `data`.

use js_sys::{Error as JsError, Reflect};
use wasm_bindgen::prelude::*;

use super::value;
use sightline::error::Error;

/// The JavaScript error for an error of the engine.
pub fn thrown(error: &Error) -> JsValue {
    let thrown = JsError::new(&error.to_string());
    set(&thrown, "code", &JsValue::from_str(error.code()));
    set(&thrown, "where", &value::write(&error.place()));
    let data = value::write(error);
    if let Some(detail) = error.detail() {
        // The reason in words, as it was before there were names and values for it.
        let _ = Reflect::set(&data, &JsValue::from_str("detail"), &JsValue::from_str(&detail));
    }
    set(&thrown, "data", &data);
    thrown.into()
}

/// A bug in the engine throws too, with the code "internal", where an abort would stop the whole module.
pub fn throw_panics() {
    std::panic::set_hook(Box::new(|panic| {
        let thrown = JsError::new(&format!("a bug in the engine: {panic}; please report it with the project"));
        set(&thrown, "code", &JsValue::from_str("internal"));
        set(&thrown, "where", &js_sys::Object::new());
        set(&thrown, "data", &JsValue::NULL);
        wasm_bindgen::throw_val(thrown.into());
    }));
}

fn set(thrown: &JsError, name: &str, value: &JsValue) {
    // An Error made here takes every field.
    let _ = Reflect::set(thrown, &JsValue::from_str(name), value);
}
