//! Plain objects in and out, with the path of what is wrong in them.

use std::collections::BTreeMap;

use js_sys::{Function, Object, Reflect, Uint8Array, Uint16Array};
use serde::de::{DeserializeOwned, IgnoredAny};
use serde::{Deserialize, Serialize};
use wasm_bindgen::prelude::*;

use super::{plain, table};
use sightline::adjustment::Adjustment;
use sightline::calibration::ModelConversion;
use sightline::detection::Detection;
use sightline::error::{Error, Expected, Names, Place, Reason, Result, shortened};
use sightline::image::{Grey, Samples};
use sightline::orient::Oriented;
use sightline::project::{Project, RemovedFields};
use sightline_exchange::{self as exchange, Files, Imported};

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
    of_json(&plain::json(value, name, &[])?, name)
}

/// A list of texts or numbers, as texts.
pub fn identifiers(value: &JsValue, name: &str) -> Result<Vec<String>> {
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Identifier {
        Text(String),
        Number(serde_json::Number),
    }
    let list: Vec<Identifier> = read(value, name)?;
    let text = |one| match one {
        Identifier::Text(text) => text,
        Identifier::Number(number) => number.to_string(),
    };
    Ok(list.into_iter().map(text).collect())
}

fn of_json<T: DeserializeOwned>(text: &str, name: &str) -> Result<T> {
    serde_path_to_error::deserialize(&mut serde_json::Deserializer::from_str(text)).map_err(|error| {
        let path = error.path().to_string().replace(".?", "");
        let field = match path.as_str() {
            "." => name.to_owned(),
            _ if name.is_empty() => path,
            _ if path.starts_with('[') => format!("{name}{path}"),
            _ => format!("{name}.{path}"),
        };
        // The line and column are of a text that the caller has never seen.
        let message = error.into_inner().to_string();
        let message = shortened(message.split(" at line ").next().unwrap_or_default());
        let name = if field.is_empty() { "value".into() } else { field.clone() };
        invalid(&field, Reason::Unreadable { name, message })
    })
}

/// A value as plain objects: null for what is absent, numbers for numbers.
pub fn write(value: &impl Serialize) -> JsValue {
    // Serialisation fails for types that have no counterpart, which the engine's do not hold.
    value.serialize(&serde_wasm_bindgen::Serializer::json_compatible()).unwrap_or(JsValue::UNDEFINED)
}

/// Options: every field may be left out, none may be unknown. Fields named in `taken` are read elsewhere.
pub fn options<T: DeserializeOwned + Serialize + Default>(value: &JsValue, taken: &[&str]) -> Result<T> {
    let text = plain::json(value, "", taken)?;
    if text == "null" {
        return Ok(T::default());
    }
    if !text.starts_with('{') {
        return Err(not("options", Expected::Object));
    }
    let given: BTreeMap<String, IgnoredAny> = of_json(&text, "options")?;
    let known: BTreeMap<String, serde_json::Value> =
        serde_json::to_value(T::default()).and_then(serde_json::from_value).map_err(|error| {
            let (name, message) = ("options".into(), error.to_string());
            invalid("options", Reason::Unreadable { name, message })
        })?;
    if let Some(name) = given.keys().find(|name| !known.contains_key(*name)) {
        let all = known.into_keys().chain(taken.iter().map(|name| (*name).to_owned())).collect();
        return Err(invalid(name, Reason::NoSuchOption { name: shortened(name), known: Names(all) }));
    }
    of_json(&text, "")
}

/// A function among the options, if there is one.
pub fn callback(options: &JsValue, name: &str) -> Result<Option<Function>> {
    let value = plain::field(options, name)?;
    if value.is_undefined() || value.is_null() {
        return Ok(None);
    }
    value.dyn_into().map(Some).map_err(|_| not(name, Expected::Function))
}

/// Field that identifies a document.
#[derive(Deserialize)]
struct Head {
    format: Option<serde_json::Value>,
    version: Option<serde_json::Value>,
}

/// A document.
pub fn project(value: &JsValue) -> Result<Project> {
    let text = plain::json(value, "", &["observations", "points"])?;
    if !text.starts_with('{') {
        return Err(not("project", Expected::Object));
    }
    let Head { format, version } = of_json(&text, "")?;
    exchange::check_head(format.as_ref(), version.as_ref())?;
    let mut project: Project = of_json(&text, "")?;
    RemovedFields::of(&text).note_in(&mut project);
    project.observations = table::observations(&plain::field(value, "observations")?)?.into();
    project.points = table::points(&plain::field(value, "points")?)?.into();
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

/// A document with a camera in another model, and what that has left.
pub fn converted_object(project: Project, conversion: &ModelConversion) -> JsValue {
    let object = Object::new();
    set(&object, "project", &project_object(project));
    set(&object, "conversion", &write(conversion));
    object.into()
}

/// An imported document as plain objects, with the assumptions among its fields where the format leaves something open.
pub fn imported_object(imported: Imported) -> JsValue {
    let Imported { project, assumptions, recognised, conversions, notes } = imported;
    let object = project_object(project);
    let add = |name: &str, value: JsValue| set(object.unchecked_ref(), name, &value);
    if !assumptions.is_empty() {
        add("assumptions", write(&assumptions));
    }
    if let Some(format) = recognised {
        add("recognised", format.into());
    }
    if !conversions.is_empty() {
        add("conversions", write(&conversions));
    }
    if !notes.assumed.is_empty() {
        add("assumed", write(&notes.assumed));
    }
    if !notes.ignored.is_empty() {
        add("ignored", write(&notes.ignored));
    }
    object
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

/// Files by name: bytes, or text.
pub fn files(value: &JsValue) -> Result<Files> {
    Ok(plain::files(value, "files")?.into_iter().collect())
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

/// Gives a plain object a field.
pub fn set(object: &Object, name: &str, value: &JsValue) {
    // A plain object made here takes every field.
    let _ = Reflect::set(object, &JsValue::from_str(name), value);
}
