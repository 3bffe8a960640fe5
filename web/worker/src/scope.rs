//! The worker's own scope: requests come in as text with files beside them, answers go out as text with bytes.

use js_sys::{Array, Object, Reflect, Uint8Array};
use sightline_protocol::{Request, from_text};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::{Blob, DedicatedWorkerGlobalScope, MessageEvent};

use crate::tasks::Engine;

/// Says that the worker is there, and does one task after the other.
pub fn serve_requests() {
    std::panic::set_hook(Box::new(|info| web_sys::console::error_1(&info.to_string().into())));
    let on_message = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
        wasm_bindgen_futures::spawn_local(async move { serve(&event.data()).await });
    });
    scope().set_onmessage(Some(on_message.as_ref().unchecked_ref()));
    on_message.forget();
    let ready = Object::new();
    set(&ready, "ready", &JsValue::TRUE);
    post(&ready, &Array::new());
}

async fn serve(message: &JsValue) {
    let field = |name: &str| Reflect::get(message, &name.into()).unwrap_or_default();
    let body = field("body").as_string().unwrap_or_default();
    let request = match from_text::<Request>(&body) {
        Ok(request) => request,
        Err(detail) => return crashed(&detail),
    };
    let mut files = Vec::new();
    for file in Array::from(&field("files")).iter() {
        match read(&file).await {
            Ok(bytes) => files.push(bytes),
            Err(detail) => return say(request.unreadable(detail), Vec::new()),
        }
    }
    request.serve(&Engine, files, &mut say);
}

async fn read(file: &JsValue) -> Result<Vec<u8>, String> {
    let blob = file.dyn_ref::<Blob>().ok_or("no file")?;
    let buffer = JsFuture::from(blob.array_buffer()).await.map_err(|error| match error.dyn_ref::<js_sys::Error>() {
        Some(error) => String::from(error.message()),
        None => format!("{error:?}"),
    })?;
    Ok(Uint8Array::new(&buffer).to_vec())
}

fn say(body: String, bytes: Vec<Vec<u8>>) {
    let message = Object::new();
    let arrays = bytes.iter().map(|bytes| Uint8Array::from(&bytes[..])).collect::<Vec<_>>();
    set(&message, "body", &body.into());
    set(&message, "bytes", &arrays.iter().collect::<Array>());
    post(&message, &arrays.iter().map(Uint8Array::buffer).collect());
}

fn crashed(detail: &str) {
    let message = Object::new();
    set(&message, "crashed", &detail.into());
    post(&message, &Array::new());
}

fn post(message: &Object, transfer: &Array) {
    // Fails only where the page has gone, which then needs no answer.
    let _ = scope().post_message_with_transfer(message, transfer);
}

fn scope() -> DedicatedWorkerGlobalScope {
    js_sys::global().unchecked_into()
}

fn set(object: &Object, name: &str, value: &JsValue) {
    // Setting a field of a fresh plain object cannot fail.
    let _ = Reflect::set(object, &name.into(), value);
}
