//! The page's end of a worker: it is started with the engine's compiled module and gets requests; it answers.

use std::cell::RefCell;
use std::rc::Rc;

use js_sys::{Array, Object, Promise, Reflect, Uint8Array, WebAssembly};
use sightline_protocol::{Request, to_text};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, future_to_promise, spawn_local};
use web_sys::{ErrorEvent, MessageEvent, Response, WorkerOptions, WorkerType};

use super::file::Blob;

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
    /// A word on its task, with the bytes that belong to it.
    Said(String, Vec<Bytes>),
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
    /// Starts a worker that runs the engine's module.
    pub fn start(on_message: impl FnMut(Message) + 'static) -> Result<Self, String> {
        let inner = spawn().map_err(|e| describe(&e))?;
        let listener = Rc::new(RefCell::new(on_message));
        let (for_errors, for_the_module) = (listener.clone(), listener.clone());
        let on_message = Closure::new(move |event: MessageEvent| {
            if let Some(message) = read_message(&event.data()) {
                (listener.borrow_mut())(message);
            }
        });
        let on_error = Closure::new(move |event: ErrorEvent| {
            (for_errors.borrow_mut())(Message::Crashed(event.message()));
        });
        inner.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
        inner.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        let worker = inner.clone();
        spawn_local(async move {
            let posted = match JsFuture::from(engine()).await {
                Ok(module) => {
                    let start = Object::new();
                    set(&start, "module", &module);
                    worker.post_message(&start)
                }
                Err(error) => {
                    forget_engine();
                    Err(error)
                }
            };
            if let Err(error) = posted {
                (for_the_module.borrow_mut())(Message::Crashed(describe(&error)));
            }
        });
        Ok(Self { inner, _on_message: on_message, _on_error: on_error })
    }

    /// Sends a request with the files it works on; the worker reads them itself.
    pub fn post(&self, request: &Request, files: &[Blob]) -> Result<(), String> {
        let message = Object::new();
        set(&message, "body", &to_text(request).into());
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

/// The engine's module in dist/, beside its glue of the same name.
const MODULE: &str = "sightline-worker_bg.wasm";

thread_local! {
    /// Compiled once for all workers.
    static ENGINE: RefCell<Option<Promise>> = const { RefCell::new(None) };
}

/// Fetches and compiles the engine's module unless that is under way: the page calls it as soon as it stands.
pub fn engine() -> Promise {
    ENGINE.with_borrow_mut(|engine| engine.get_or_insert_with(|| future_to_promise(compile())).clone())
}

/// After a failure (no network, say) the next worker tries again.
fn forget_engine() {
    ENGINE.with_borrow_mut(|engine| *engine = None);
}

async fn compile() -> Result<JsValue, JsValue> {
    let fetched = || web_sys::window().ok_or(JsValue::from("no window")).map(|window| window.fetch_with_str(MODULE));
    match JsFuture::from(WebAssembly::compile_streaming(&fetched()?)).await {
        Ok(module) => Ok(module),
        // Hosts that do not know the type of wasm files: compiled from its bytes.
        Err(_) => {
            let response: Response = JsFuture::from(fetched()?).await?.dyn_into()?;
            if !response.ok() {
                return Err(format!("{MODULE}: {} {}", response.status(), response.status_text()).into());
            }
            let bytes = JsFuture::from(response.array_buffer()?).await?;
            JsFuture::from(WebAssembly::compile(&bytes)).await
        }
    }
}

fn read_message(data: &JsValue) -> Option<Message> {
    let field = |name: &str| Reflect::get(data, &name.into()).ok();
    if let Some(reason) = field("crashed").and_then(|v| v.as_string()) {
        return Some(Message::Crashed(reason));
    }
    if field("ready").is_some_and(|ready| ready.is_truthy()) {
        return Some(Message::Ready);
    }
    let body = field("body")?.as_string()?;
    let bytes = Array::from(&field("bytes")?).iter().map(|b| Bytes(b.unchecked_into())).collect();
    Some(Message::Said(body, bytes))
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
