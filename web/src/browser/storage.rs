//! The page's end of the worker that keeps projects (`web/storage.js`): calls with texts, blobs and pictures beside them.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;

use js_sys::{Array, Function, Object, Promise};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sightline_protocol::{from_text, to_text};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::{ErrorEvent, MessageEvent};

use super::file::Blob;
use super::picture::Picture;
use super::worker::{Bytes, describe, error_words, field, set, start_script, when_ended};

/// Objects transferred with a call or its answer.
pub enum Extra {
    Text(String),
    /// A text in pieces.
    Pieces(Vec<Piece>),
    Blob(Blob),
    Picture(Picture),
    /// The requested item does not exist.
    Nothing,
}

/// Of a text: bytes stay what they are on the way.
#[derive(Clone)]
pub enum Piece {
    Text(String),
    Bytes(Bytes),
}

/// Why a call gave nothing: the browser's name for it, and its words.
#[derive(Clone, Debug, Default, Deserialize)]
pub struct Fault {
    pub name: String,
    pub detail: String,
}

type Waiting = Rc<RefCell<HashMap<u32, Function>>>;

/// The worker that keeps projects.
#[derive(Clone)]
pub struct Storage {
    worker: web_sys::Worker,
    waiting: Waiting,
    calls: Rc<Cell<u32>>,
    ended: Rc<Cell<bool>>,
}

/// The name of the error of unanswered calls, and the message when the worker has ended by itself.
pub const LOST: &str = "Lost";
const ENDED: &str = "the worker was ended";
const ENDED_ITSELF: &str = "the storage worker has ended";

/// Answers all that wait.
fn give_up(waiting: &RefCell<HashMap<u32, Function>>, words: &str) {
    for (_, resolve) in waiting.take() {
        let answer = Object::new();
        set(&answer, "fault", &LOST.into());
        set(&answer, "text", &words.into());
        let _ = resolve.call1(&JsValue::UNDEFINED, &answer);
    }
}

impl Storage {
    /// Starts it; `on_told` gets messages that are not answers, and [`LOST`] if it has ended by itself.
    pub fn start(on_told: impl Fn(&str) + 'static) -> Result<Self, String> {
        let worker = start_script("storage.js").map_err(|e| describe(&e))?;
        let waiting = Waiting::default();
        let ended = Rc::new(Cell::new(false));
        let on_told = Rc::new(on_told);
        let (answers, ended_before) = (waiting.clone(), ended.clone());
        let on_message = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
            let data = event.data();
            if let Some(told) = field(&data, "told").as_string() {
                return on_told(&told);
            }
            let (tell, unanswered, ended) = (on_told.clone(), answers.clone(), ended_before.clone());
            let when = when_ended(&data, move || {
                if !ended.replace(true) {
                    give_up(&unanswered, ENDED_ITSELF);
                    tell(LOST);
                }
            });
            if when {
                return;
            }
            let call = field(&data, "call").as_f64().unwrap_or_default() as u32;
            let resolve = answers.borrow_mut().remove(&call);
            if let Some(resolve) = resolve {
                let _ = resolve.call1(&JsValue::UNDEFINED, &data);
            }
        });
        let lost = waiting.clone();
        let on_error = Closure::<dyn FnMut(ErrorEvent)>::new(move |event: ErrorEvent| {
            give_up(&lost, &error_words(&event));
        });
        worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
        worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        // It lives as long as the page, nearly always.
        on_message.forget();
        on_error.forget();
        Ok(Self { worker, waiting, calls: Rc::default(), ended })
    }

    /// Ends it and its memory: pending and later calls get an error.
    pub fn end(&self) {
        self.ended.set(true);
        self.worker.terminate();
        give_up(&self.waiting, ENDED);
    }

    /// Calls it, and waits for the answer.
    pub async fn call<A: DeserializeOwned>(
        &self,
        name: &str,
        arguments: &impl Serialize,
        extras: Vec<Extra>,
    ) -> Result<(A, Vec<Extra>), Fault> {
        let fault = |name: &str, detail: String| Fault { name: name.to_owned(), detail };
        if self.ended.get() {
            return Err(fault(LOST, ENDED.to_owned()));
        }
        let call = self.calls.get();
        self.calls.set(call + 1);
        let answered = Promise::new(&mut |resolve, _| {
            self.waiting.borrow_mut().insert(call, resolve);
        });
        let message = Object::new();
        set(&message, "call", &call.into());
        set(&message, "name", &name.into());
        set(&message, "text", &to_text(arguments).into());
        set(&message, "extras", &extras.iter().map(Extra::as_js).collect::<Array>());
        self.worker.post_message(&message).map_err(|e| fault(LOST, describe(&e)))?;
        let answer = JsFuture::from(answered).await.map_err(|e| fault(LOST, describe(&e)))?;
        let text = field(&answer, "text").as_string().unwrap_or_default();
        if let Some(name) = field(&answer, "fault").as_string() {
            return Err(fault(&name, text));
        }
        let extras = Array::from(&field(&answer, "extras")).iter().map(Extra::from_js).collect();
        Ok((from_text(&text).map_err(|detail| fault("DataError", detail))?, extras))
    }
}

impl Piece {
    fn as_js(&self) -> JsValue {
        match self {
            Self::Text(text) => text.into(),
            Self::Bytes(Bytes(bytes)) => bytes.into(),
        }
    }
}

impl Extra {
    fn as_js(&self) -> JsValue {
        match self {
            Self::Text(text) => text.into(),
            Self::Pieces(pieces) => pieces.iter().map(Piece::as_js).collect::<Array>().into(),
            Self::Blob(blob) => blob.as_js(),
            Self::Picture(picture) => picture.bitmap.clone().into(),
            Self::Nothing => JsValue::NULL,
        }
    }

    fn from_js(value: JsValue) -> Self {
        match value.dyn_into::<web_sys::Blob>() {
            Ok(blob) => Self::Blob(Blob::of(blob)),
            Err(value) => value.as_string().map_or(Self::Nothing, Self::Text),
        }
    }

    pub fn text(self) -> Option<String> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }

    pub fn blob(self) -> Option<Blob> {
        if let Self::Blob(blob) = self { Some(blob) } else { None }
    }
}
