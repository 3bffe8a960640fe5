//! Plain objects in and out, with the path of what is wrong in them.

use std::collections::BTreeMap;

use js_sys::{Array, ArrayBuffer, Function, Object, Reflect, Uint8Array, Uint16Array};
use serde::Serialize;
use serde::de::DeserializeOwned;
use wasm_bindgen::prelude::*;

use super::table;
use sightline::adjustment::Adjustment;
use sightline::detection::Detection;
use sightline::error::{Error, Expected, Names, Place, Reason, Result, shortened};
use sightline::exchange::Files;
use sightline::image::{Grey, Samples};
use sightline::orient::Oriented;
use sightline::project::Project;

/// An error in a named field.
pub fn invalid(field: &str, reason: Reason) -> Error {
    Error::Invalid { reason, at: Place::field(field) }
}

/// An error in an argument that is not what it has to be.
pub fn not(field: &str, expected: Expected) -> Error {
    invalid(field, Reason::NotOfKind { name: field.into(), expected })
}

/// A value of any serialisable type; `name` stands before the path of what is wrong.
pub fn read<T: DeserializeOwned>(value: &JsValue, name: &str) -> Result<T> {
    serde_path_to_error::deserialize(serde_wasm_bindgen::Deserializer::from(value.clone())).map_err(|error| {
        let path = error.path().to_string();
        let field = match path.as_str() {
            "." => name.to_owned(),
            _ if name.is_empty() => path,
            _ if path.starts_with('[') => format!("{name}{path}"),
            _ => format!("{name}.{path}"),
        };
        let message = error.into_inner().to_string();
        let message = shortened(message.trim_start_matches("Error: "));
        invalid(
            &field,
            Reason::Unreadable { name: if field.is_empty() { "value".into() } else { field.clone() }, message },
        )
    })
}

/// A value as plain objects: null for what is absent, numbers for numbers.
pub fn write(value: &impl Serialize) -> JsValue {
    // Serialisation fails for types that have no counterpart, which the engine's do not hold.
    value.serialize(&serde_wasm_bindgen::Serializer::json_compatible()).unwrap_or(JsValue::UNDEFINED)
}

/// Options: every field may be left out, none may be unknown. Fields named in `taken` are read elsewhere.
pub fn options<T: DeserializeOwned + Serialize + Default>(value: &JsValue, taken: &[&str]) -> Result<T> {
    if value.is_undefined() || value.is_null() {
        return Ok(T::default());
    }
    let given = plain_object(value, "options")?;
    let known: BTreeMap<String, serde_json::Value> =
        serde_json::to_value(T::default()).and_then(serde_json::from_value).map_err(|error| {
            let (name, message) = ("options".into(), error.to_string());
            invalid("options", Reason::Unreadable { name, message })
        })?;
    let kept = Object::new();
    for entry in Object::entries(given).iter() {
        let entry: Array = entry.unchecked_into();
        let (key, value) = (entry.get(0), entry.get(1));
        let name = key.as_string().unwrap_or_default();
        if taken.contains(&name.as_str()) || value.is_undefined() {
            continue;
        }
        if !known.contains_key(&name) {
            let all = known.into_keys().chain(taken.iter().map(|name| (*name).to_owned())).collect();
            let reason = Reason::NoSuchOption { name: shortened(&name), known: Names(all) };
            return Err(invalid(&name, reason));
        }
        if value.as_f64().is_some_and(|number| !number.is_finite()) {
            return Err(not(&name, Expected::FiniteNumber));
        }
        set(&kept, &name, &value);
    }
    read(&kept, "")
}

/// A function among the options, if there is one.
pub fn callback(options: &JsValue, name: &str) -> Result<Option<Function>> {
    let value = if options.is_object() { get(options, name) } else { JsValue::UNDEFINED };
    if value.is_undefined() || value.is_null() {
        return Ok(None);
    }
    value.dyn_into().map(Some).map_err(|_| not(name, Expected::Function))
}

/// A document.
pub fn project(value: &JsValue) -> Result<Project> {
    let given = plain_object(value, "project")?;
    if get(given, "format").as_string().as_deref() != Some("sightline") {
        return Err(invalid("format", Reason::NotADocument));
    }
    match get(given, "version").as_f64() {
        Some(1.0) => {}
        Some(other) => {
            return Err(invalid("version", Reason::NewerVersion { version: other.to_string() }));
        }
        None => {
            let reason = match get(given, "version").as_string() {
                Some(other) => Reason::NewerVersion { version: shortened(&other) },
                None => Reason::NoVersion,
            };
            return Err(invalid("version", reason));
        }
    }
    let rest = Object::assign(&Object::new(), given);
    let (observations, points) = (get(given, "observations"), get(given, "points"));
    set(&rest, "observations", &Array::new());
    set(&rest, "points", &Array::new());
    let mut project: Project = read(&rest, "")?;
    project.observations = table::observations(&observations)?;
    project.points = table::points(&points)?;
    Ok(project)
}

/// A document as plain objects.
pub fn project_object(mut project: Project) -> JsValue {
    let (observations, points) = (std::mem::take(&mut project.observations), std::mem::take(&mut project.points));
    let object: Object = write(&project).unchecked_into();
    set(&object, "observations", &table::observation_rows(&observations));
    set(&object, "points", &table::point_rows(&points));
    object.into()
}

/// An oriented document as plain objects, its notes among its fields.
pub fn oriented_object(oriented: Oriented) -> JsValue {
    let object = project_object(oriented.project);
    set(object.unchecked_ref(), "notes", &write(&oriented.notes));
    object
}

/// A detection as plain objects.
pub fn detection_object(mut detection: Detection) -> JsValue {
    let rejected = std::mem::take(&mut detection.rejected_blobs);
    let object: Object = write(&detection).unchecked_into();
    table::add_rejected_blobs(&object, &rejected);
    object.into()
}

/// An adjustment as plain objects.
pub fn adjustment_object(mut adjustment: Adjustment) -> JsValue {
    let (observations, points) = (std::mem::take(&mut adjustment.observations), std::mem::take(&mut adjustment.points));
    let object: Object = write(&adjustment).unchecked_into();
    table::add_adjusted_observations(&object, &observations);
    set(&object, "points", &table::adjusted_point_rows(&points));
    object.into()
}

/// A grey picture.
pub fn picture(grey: &Grey) -> JsValue {
    let object = Object::new();
    set(&object, "width", &JsValue::from(grey.width as u32));
    set(&object, "height", &JsValue::from(grey.height as u32));
    let samples = match &grey.samples {
        Samples::U8(samples) => Uint8Array::from(samples.as_slice()).into(),
        Samples::U16(samples) => JsValue::from(Uint16Array::from(samples.as_slice())),
    };
    set(&object, "samples", &samples);
    object.into()
}

/// Bytes of a file.
pub fn bytes(value: &JsValue, field: &str) -> Result<Vec<u8>> {
    if let Some(array) = value.dyn_ref::<Uint8Array>() {
        return Ok(array.to_vec());
    }
    if let Some(buffer) = value.dyn_ref::<ArrayBuffer>() {
        return Ok(Uint8Array::new(buffer).to_vec());
    }
    Err(not(field, Expected::Bytes))
}

/// Files by name: bytes, or text.
pub fn files(value: &JsValue) -> Result<Files> {
    let mut files = Files::new();
    for entry in Object::entries(plain_object(value, "files")?).iter() {
        let entry: Array = entry.unchecked_into();
        let (name, content) = (entry.get(0).as_string().unwrap_or_default(), entry.get(1));
        let content = match content.as_string() {
            Some(text) => text.into_bytes(),
            None => bytes(&content, &format!("files.{name}"))?,
        };
        files.insert(name, content);
    }
    Ok(files)
}

/// Files as an object of bytes.
pub fn files_object(files: &Files) -> JsValue {
    let object = Object::new();
    for (name, content) in files {
        set(&object, name, &Uint8Array::from(content.as_slice()));
    }
    object.into()
}

/// A text argument.
pub fn text(value: &JsValue, field: &str) -> Result<String> {
    value.as_string().ok_or_else(|| not(field, Expected::Text))
}

/// A finite number.
pub fn number(value: &JsValue, field: &str) -> Result<f64> {
    value.as_f64().filter(|number| number.is_finite()).ok_or_else(|| not(field, Expected::FiniteNumber))
}

/// A size in pixels.
pub fn whole(value: &JsValue, field: &str) -> Result<usize> {
    let wrong = || not(field, Expected::Pixels);
    value
        .as_f64()
        .filter(|number| number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(number))
        .map(|number| number as usize)
        .ok_or_else(wrong)
}

/// An own field of an object.
pub fn get(object: &JsValue, name: &str) -> JsValue {
    Reflect::get(object, &JsValue::from_str(name)).unwrap_or(JsValue::UNDEFINED)
}

fn set(object: &Object, name: &str, value: &JsValue) {
    // A plain object made here takes every field.
    let _ = Reflect::set(object, &JsValue::from_str(name), value);
}

fn plain_object<'a>(value: &'a JsValue, name: &str) -> Result<&'a Object> {
    let plain = value.is_object() && !Array::is_array(value) && !ArrayBuffer::is_view(value);
    value.dyn_ref::<Object>().filter(|_| plain).ok_or_else(|| not(name, Expected::Object))
}
