//! The page's end of a worker: it is started with the engine's compiled module and gets requests; it answers.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use js_sys::{Array, Object, Promise, Reflect, Uint8Array, WebAssembly};
use sightline_protocol::Request;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, future_to_promise, spawn_local};
use web_sys::{ErrorEvent, MessageEvent, Response, WorkerOptions, WorkerType};

use super::file::Blob;

/// Bytes that stay on JavaScript's side, or the picture that a worker made of them.
#[derive(Clone)]
pub struct Bytes(pub(super) Uint8Array);

impl Bytes {
    pub fn to_vec(&self) -> Vec<u8> {
        self.0.to_vec()
    }
}

/// Message of a worker.
pub enum Message {
    /// It has started and takes requests.
    Ready,
    /// A word on its task, with the bytes that belong to it; and how much memory the engine there has taken.
    Said(Vec<u8>, Vec<Bytes>, f64),
    /// It is lost (out of memory, for instance).
    Crashed(String),
}

/// A running worker, seen from the page. Its listeners live as long as it does.
pub struct Worker {
    inner: web_sys::Worker,
    _on_message: Closure<dyn FnMut(MessageEvent)>,
    _on_error: Closure<dyn FnMut(ErrorEvent)>,
    /// Whether it has not been ended yet.
    wanted: Rc<Cell<bool>>,
}

impl Worker {
    /// Starts a worker that runs the engine's module.
    pub fn start(on_message: impl FnMut(Message) + 'static) -> Result<Self, String> {
        let inner = start_script("worker.js").map_err(|e| describe(&e))?;
        let listener = Rc::new(RefCell::new(on_message));
        let (for_errors, for_the_module, for_its_end) = (listener.clone(), listener.clone(), listener.clone());
        let wanted = Rc::new(Cell::new(true));
        let still_wanted = wanted.clone();
        let on_message = Closure::new(move |event: MessageEvent| {
            let data = event.data();
            let (ended, wanted) = (for_its_end.clone(), still_wanted.clone());
            let when = when_ended(&data, move || {
                if wanted.get() {
                    (ended.borrow_mut())(Message::Crashed("it ended without a word".into()));
                }
            });
            if when {
                return;
            }
            (listener.borrow_mut())(read_message(&data));
        });
        let on_error = Closure::new(move |event: ErrorEvent| {
            (for_errors.borrow_mut())(Message::Crashed(error_words(&event)));
        });
        inner.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
        inner.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        let worker = inner.clone();
        spawn_local(async move {
            let posted = match JsFuture::from(engine()).await {
                Ok(module) => {
                    let start = Object::new();
                    set(&start, "module", &module);
                    set(&start, "codecs", &located(CODECS).into());
                    set(&start, "life", &format!("sightline life {}", super::page::unique_name()).into());
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
        Ok(Self { inner, _on_message: on_message, _on_error: on_error, wanted })
    }

    /// Sends a request with the files it works on; the worker reads them itself.
    pub fn post(&self, request: &Request, files: &[Blob]) -> Result<(), String> {
        let message = Object::new();
        let (part, body) = request.written();
        let body = Uint8Array::from(&body[..]);
        set(&message, "part", &part.into());
        set(&message, "body", &body);
        set(&message, "streams", &request.streams().into());
        set(&message, "files", &files.iter().map(Blob::as_js).collect::<Array>());
        self.inner.post_message_with_transfer(&message, &Array::of1(&body.buffer())).map_err(|e| describe(&e))
    }

    /// Ends it at once, whatever it is doing.
    pub fn terminate(&self) {
        self.wanted.set(false);
        self.inner.set_onmessage(None);
        self.inner.set_onerror(None);
        self.inner.terminate();
    }
}

/// Calls `work` when the worker that says by `told` what name it holds (`web/storage/life.js`) has ended; false if it says no such thing. The
/// name is that of a database, which cannot be deleted before, or of a lock, which cannot be had.
pub(super) fn when_ended(told: &JsValue, work: impl FnOnce() + 'static) -> bool {
    let Some(life) = field(told, "held").as_string() else { return false };
    let work = Closure::once_into_js(work);
    let method = |object: &JsValue, name: &str| field(object, name).dyn_into::<js_sys::Function>().ok();
    if field(told, "by").as_string().as_deref() == Some("lock") {
        let locks = field(&field(&js_sys::global(), "navigator"), "locks");
        let _ = method(&locks, "request").map(|request| request.call2(&locks, &life.into(), &work));
        return true;
    }
    let base = field(&js_sys::global(), "indexedDB");
    if let Some(Ok(deleting)) = method(&base, "deleteDatabase").map(|delete| delete.call1(&base, &life.into())) {
        // An error is no end of the worker: the browser has cleared its storage.
        set(deleting.unchecked_ref(), "onsuccess", &work);
    }
    true
}

/// Where a file of the page lies: with the others of its build, which `web/start.js` leaves in `sightlineBase`, or inside the page where all is
/// one file, which leaves addresses in `sightlineFiles`.
fn located(name: &str) -> String {
    let base = || field(&js_sys::global(), "sightlineBase").as_string().unwrap_or_default();
    inside(name).unwrap_or_else(|| format!("{}{name}", base()))
}

fn inside(name: &str) -> Option<String> {
    let files = field(&js_sys::global(), "sightlineFiles");
    if files.is_undefined() { None } else { field(&files, name).as_string() }
}

/// Starts a script of the page as a worker.
pub(super) fn start_script(name: &str) -> Result<web_sys::Worker, JsValue> {
    // A page from a disk may start no modules.
    if let Some(address) = inside(name) {
        return web_sys::Worker::new(&address);
    }
    let options = WorkerOptions::new();
    options.set_type(WorkerType::Module);
    web_sys::Worker::new_with_options(&located(name), &options)
}

/// The engine's module in dist/, beside its glue of the same name.
const MODULE: &str = "sightline-worker_bg.wasm";

/// The decoders' module in dist/: a worker fetches it when it needs it.
const CODECS: &str = "sightline-codecs_bg.wasm";

thread_local! {
    /// Compiled once for all workers.
    static ENGINE: RefCell<Option<Promise>> = const { RefCell::new(None) };
}

/// Fetches and compiles the engine's module unless that is under way: the page calls it as soon as it stands.
pub fn engine() -> Promise {
    ENGINE.with_borrow_mut(|engine| engine.get_or_insert_with(|| future_to_promise(compile())).clone())
}

/// Waits until the engine's module has come, or has not.
pub async fn engine_is_there() {
    let _ = JsFuture::from(engine()).await;
}

/// After a failure (no network, say) the next worker tries again.
fn forget_engine() {
    ENGINE.with_borrow_mut(|engine| *engine = None);
}

async fn compile() -> Result<JsValue, JsValue> {
    let fetched =
        || web_sys::window().ok_or(JsValue::from("no window")).map(|window| window.fetch_with_str(&located(MODULE)));
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

/// A message of a worker. An unknown message counts as a lost worker, since its task would never end.
fn read_message(data: &JsValue) -> Message {
    if let Some(reason) = field(data, "crashed").as_string() {
        return Message::Crashed(reason);
    }
    if field(data, "ready").is_truthy() {
        return Message::Ready;
    }
    let Ok(body) = field(data, "body").dyn_into::<Uint8Array>() else {
        return Message::Crashed("it said what is no answer".into());
    };
    let bytes = Array::from(&field(data, "bytes")).iter().map(|b| Bytes(b.unchecked_into())).collect();
    Message::Said(body.to_vec(), bytes, field(data, "memory").as_f64().unwrap_or_default())
}

/// Words of an error of a worker: there are none where its script could not be fetched.
pub(super) fn error_words(event: &ErrorEvent) -> String {
    field(event, "message").as_string().unwrap_or_default()
}

/// A field of an object; undefined where there is none.
pub(super) fn field(object: &JsValue, name: &str) -> JsValue {
    Reflect::get(object, &name.into()).unwrap_or_default()
}

pub(super) fn set(object: &Object, name: &str, value: &JsValue) {
    // Setting a field of a fresh plain object cannot fail.
    let _ = Reflect::set(object, &name.into(), value);
}

pub(super) fn describe(error: &JsValue) -> String {
    match error.dyn_ref::<js_sys::Error>() {
        Some(error) => String::from(error.message()),
        None => format!("{error:?}"),
    }
}
