//! Opening and saving of files.

use js_sys::{Array, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::{BlobPropertyBag, DataTransfer, FileList, HtmlAnchorElement, HtmlInputElement, Url};

use super::worker::{Bytes, describe};

/// A file's content, on the disk or in the browser's memory, read only when it is needed.
#[derive(Clone)]
pub struct Blob {
    inner: web_sys::Blob,
    /// Whether it is a person's file, or part of one.
    own: bool,
}

/// A file with its name.
#[derive(Clone)]
pub struct NamedFile {
    pub name: String,
    pub content: Blob,
}

impl Blob {
    pub fn from_bytes(bytes: &Bytes) -> Result<Self, String> {
        web_sys::Blob::new_with_u8_array_sequence(&Array::of1(&bytes.0)).map(Self::of).map_err(|e| describe(&e))
    }

    pub fn of_text(text: &[u8]) -> Result<Self, String> {
        Self::from_bytes(&Bytes(Uint8Array::from(text)))
    }

    /// Some of its bytes: they stay where they are.
    pub fn part(&self, start: f64, size: f64) -> Result<Self, String> {
        let inner = self.inner.slice_with_f64_and_f64(start, start + size).map_err(|e| describe(&e))?;
        Ok(Self { inner, own: self.own })
    }

    pub async fn read(&self) -> Result<Vec<u8>, String> {
        let buffer = JsFuture::from(self.inner.array_buffer()).await.map_err(|e| describe(&e))?;
        Ok(Uint8Array::new(&buffer).to_vec())
    }

    /// Its first bytes.
    pub async fn head(&self, bytes: usize) -> Result<Vec<u8>, String> {
        self.part(0.0, bytes as f64)?.read().await
    }

    pub fn is_empty(&self) -> bool {
        self.inner.size() == 0.0
    }

    pub fn size(&self) -> f64 {
        self.inner.size()
    }

    /// Whether its bytes are in a person's own file: keeping it takes no additional memory.
    pub fn is_own_file(&self) -> bool {
        self.own
    }

    pub(super) fn of(inner: web_sys::Blob) -> Self {
        Self { inner, own: false }
    }

    fn own(file: web_sys::File) -> Self {
        Self { inner: file.into(), own: true }
    }

    pub(super) fn inner(&self) -> &web_sys::Blob {
        &self.inner
    }

    pub(super) fn as_js(&self) -> JsValue {
        self.inner.clone().into()
    }
}

fn of_list(files: Option<FileList>) -> Vec<NamedFile> {
    let Some(files) = files else { return Vec::new() };
    let mut all: Vec<_> = (0..files.length())
        .filter_map(|i| files.get(i))
        .map(|f| NamedFile { name: f.name(), content: Blob::own(f) })
        .collect();
    all.sort_by(|a, b| a.name.cmp(&b.name));
    all
}

/// The files of a JavaScript array.
pub(super) fn of_array(files: &JsValue) -> Vec<NamedFile> {
    let Some(files) = files.dyn_ref::<Array>() else { return Vec::new() };
    let files = files.iter().filter_map(|file| file.dyn_into::<web_sys::File>().ok());
    files.map(|file| NamedFile { name: file.name(), content: Blob::own(file) }).collect()
}

/// The files dropped or pasted with an event, in the order of their names.
pub fn dropped(transfer: Option<DataTransfer>) -> Vec<NamedFile> {
    of_list(transfer.and_then(|t| t.files()))
}

/// Opens the browser's file chooser; `on_files` gets what was chosen.
pub fn choose(accept: &str, multiple: bool, on_files: impl FnOnce(Vec<NamedFile>) + 'static) {
    let Some(document) = web_sys::window().and_then(|w| w.document()) else { return };
    let Ok(element) = document.create_element("input") else { return };
    let input: HtmlInputElement = element.unchecked_into();
    input.set_type("file");
    input.set_accept(accept);
    input.set_multiple(multiple);
    input.set_hidden(true);
    // In the document, so that tests and assistive tools see it.
    if let Some(body) = document.body() {
        let _ = body.append_child(&input);
    }
    let chosen = input.clone();
    let on_change = Closure::once_into_js(move |_: web_sys::Event| {
        let files = of_list(chosen.files());
        chosen.remove();
        on_files(files);
    });
    input.set_onchange(Some(on_change.unchecked_ref()));
    input.click();
}

/// Hands a file to the person, in the browser's own way.
pub fn download(name: &str, kind: &str, bytes: &[u8]) -> Result<(), String> {
    download_around(name, kind, &[Bytes(Uint8Array::from(bytes))], &[])
}

/// The same of a file that is made of pieces with other files between them, which are not in memory at once.
pub fn download_around(name: &str, kind: &str, pieces: &[Bytes], between: &[Blob]) -> Result<(), String> {
    let options = BlobPropertyBag::new();
    options.set_type(kind);
    let content = Array::new();
    for (i, piece) in pieces.iter().enumerate() {
        content.push(&piece.0);
        if let Some(blob) = between.get(i) {
            content.push(&blob.inner);
        }
    }
    let blob = web_sys::Blob::new_with_u8_array_sequence_and_options(&content, &options).map_err(|e| describe(&e))?;
    download_blob(name, &blob)
}

/// The same of what the browser keeps.
pub fn download_kept_file(name: &str, file: &Blob) -> Result<(), String> {
    download_blob(name, &file.inner)
}

/// The same of what JavaScript made.
pub fn download_blob(name: &str, blob: &web_sys::Blob) -> Result<(), String> {
    let save = || -> Result<(), JsValue> {
        let url = Url::create_object_url_with_blob(blob)?;
        let document = web_sys::window().and_then(|w| w.document()).ok_or("no document")?;
        let anchor: HtmlAnchorElement = document.create_element("a")?.unchecked_into();
        anchor.set_href(&url);
        anchor.set_download(name);
        anchor.click();
        // The download has its own reference after a moment.
        super::page::after(60_000, move || {
            let _ = Url::revoke_object_url(&url);
        });
        Ok(())
    };
    save().map_err(|e| describe(&e))
}
