//! Both ends of a worker: the page starts it with its own compiled module and posts requests; the worker answers.

use std::cell::RefCell;
use std::rc::Rc;

use js_sys::{Array, Object, Reflect, Uint8Array};
use wasm_bindgen::prelude::*;
use web_sys::{DedicatedWorkerGlobalScope, ErrorEvent, MessageEvent, WorkerOptions, WorkerType};

use super::file::Blob;
use crate::protocol::{Answer, Request};

/// Bytes that stay on JavaScript's side.
#[derive(Clone)]
pub struct Bytes(pub(super) Uint8Array);

impl Bytes {
    pub fn to_vec(&self) -> Vec<u8> {
        self.0.to_vec()
    }
}

/// What a worker says.
pub enum Message {
    /// It has started and takes requests.
    Ready,
    /// Progress or the end of its request, with the bytes that belong to it.
    Answer(Answer, Vec<Bytes>),
    /// It is lost (out of memory, for instance).
    Crashed(String),
}

/// A running worker, seen from the page. Its listeners live as long as it does.
pub struct Worker {
    inner: web_sys::Worker,
    _on_message: Closure<dyn FnMut(MessageEvent)>,
    _on_error: Closure<dyn FnMut(ErrorEvent)>,
}

impl Worker {
    /// Starts a worker that runs this page's module.
    pub fn start(on_message: impl FnMut(Message) + 'static) -> Result<Self, String> {
        let inner = spawn().map_err(|e| describe(&e))?;
        let listener = Rc::new(RefCell::new(on_message));
        let for_errors = listener.clone();
        let on_message = Closure::new(move |event: MessageEvent| {
            if let Some(message) = read_answer(&event.data()) {
                (listener.borrow_mut())(message);
            }
        });
        let on_error = Closure::new(move |event: ErrorEvent| {
            (for_errors.borrow_mut())(Message::Crashed(event.message()));
        });
        inner.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
        inner.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        let start = Object::new();
        set(&start, "module", &wasm_bindgen::module());
        set(&start, "glue", &glue_address().into());
        inner.post_message(&start).map_err(|e| describe(&e))?;
        Ok(Self { inner, _on_message: on_message, _on_error: on_error })
    }

    /// Sends a request with the files it works on; the worker reads them itself.
    pub fn post(&self, request: &Request, files: &[Blob]) -> Result<(), String> {
        let message = Object::new();
        let body = to_text(request).map_err(|e| e.to_string())?;
        set(&message, "body", &body.into());
        set(&message, "files", &files.iter().map(Blob::as_js).collect::<Array>());
        self.inner.post_message(&message).map_err(|e| describe(&e))
    }

    /// Ends it at once, whatever it is doing.
    pub fn terminate(&self) {
        self.inner.set_onmessage(None);
        self.inner.set_onerror(None);
        self.inner.terminate();
    }
}

/// The single-file build has no worker.js beside it and leaves the address of its own in `sightlineWorker`.
fn spawn() -> Result<web_sys::Worker, JsValue> {
    match Reflect::get(&js_sys::global(), &"sightlineWorker".into())?.as_string() {
        Some(url) => web_sys::Worker::new(&url),
        None => {
            let options = WorkerOptions::new();
            options.set_type(WorkerType::Module);
            web_sys::Worker::new_with_options("worker.js", &options)
        }
    }
}

/// The page preloads the module's glue, under whatever name the build gave it.
fn glue_address() -> String {
    let document = web_sys::window().and_then(|w| w.document());
    let link = document.and_then(|d| d.query_selector("link[rel=modulepreload]").ok().flatten());
    link.map(|l| l.unchecked_into::<web_sys::HtmlLinkElement>().href()).unwrap_or_default()
}

fn read_answer(data: &JsValue) -> Option<Message> {
    let field = |name: &str| Reflect::get(data, &name.into()).ok();
    if let Some(reason) = field("crashed").and_then(|v| v.as_string()) {
        return Some(Message::Crashed(reason));
    }
    let body = field("body")?.as_string()?;
    let bytes = Array::from(&field("bytes")?).iter().map(|b| Bytes(b.unchecked_into())).collect();
    Some(match serde_json::from_str::<Answer>(&body) {
        Ok(Answer::Ready) => Message::Ready,
        Ok(answer) => Message::Answer(answer, bytes),
        Err(error) => Message::Crashed(error.to_string()),
    })
}

/// Serves a request with the bytes of its files; the last argument answers.
pub type Serve = fn(Request, Vec<Vec<u8>>, Reply);
/// Sends an answer with the bytes that belong to it.
pub type Reply<'a> = &'a mut dyn FnMut(Answer, Vec<Vec<u8>>);

/// Waits for requests in a worker and hands each to `serve` with a way to answer.
pub fn serve_requests(serve: Serve) {
    let scope: DedicatedWorkerGlobalScope = js_sys::global().unchecked_into();
    let on_message = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
        wasm_bindgen_futures::spawn_local(async move {
            let data = event.data();
            let field = |name: &str| Reflect::get(&data, &name.into()).unwrap_or_default();
            let body = field("body").as_string().unwrap_or_default();
            let mut files = Vec::new();
            for file in Array::from(&field("files")).iter() {
                match Blob::from_js(&file).read().await {
                    Ok(bytes) => files.push(bytes),
                    Err(detail) => return answer(&Answer::Unreadable { detail }, &[]),
                }
            }
            match serde_json::from_str(&body) {
                Ok(request) => serve(request, files, &mut |a, bytes| answer(&a, &bytes)),
                Err(error) => answer(&Answer::Unreadable { detail: error.to_string() }, &[]),
            }
        });
    });
    scope.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
    on_message.forget();
    answer(&Answer::Ready, &[]);
}

fn answer(answer: &Answer, bytes: &[Vec<u8>]) {
    let scope: DedicatedWorkerGlobalScope = js_sys::global().unchecked_into();
    let message = Object::new();
    let body = to_text(answer).unwrap_or_default();
    let arrays = bytes.iter().map(|b| Uint8Array::from(&b[..])).collect::<Vec<_>>();
    let transfer = arrays.iter().map(Uint8Array::buffer).collect::<Array>();
    set(&message, "body", &body.into());
    set(&message, "bytes", &arrays.iter().collect::<Array>());
    // Fails only where the page has gone, which then needs no answer.
    let _ = scope.post_message_with_transfer(&message, &transfer);
}

/// By way of a value, which has every name once: an adjusted camera's sigmas and its own share one.
fn to_text(message: &impl serde::Serialize) -> serde_json::Result<String> {
    serde_json::to_string(&serde_json::to_value(message)?)
}

fn set(object: &Object, name: &str, value: &JsValue) {
    // Setting a field of a fresh plain object cannot fail.
    let _ = Reflect::set(object, &name.into(), value);
}

pub(super) fn describe(error: &JsValue) -> String {
    match error.dyn_ref::<js_sys::Error>() {
        Some(error) => String::from(error.message()),
        None => format!("{error:?}"),
    }
}
