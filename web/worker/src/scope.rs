//! The worker's own scope: requests come in with files beside them, answers go out with bytes or pictures beside them.

use std::cell::RefCell;
use std::io::{self, Read, Seek, SeekFrom};

use js_sys::{Array, Function, Object, Promise, Reflect, Uint8Array, Uint8ClampedArray, Uint16Array};
use sightline::decode;
use sightline::image::Samples;
use sightline_protocol::{Given, Networks, Photos, Said, SaidTo, ShowPhoto, Stream, from_bytes, unreadable};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use wasm_split_helpers::SplitLoaderError;
use web_sys::{
    Blob, DedicatedWorkerGlobalScope, FileReaderSync, ImageBitmap, ImageData, MessageEvent, ReadableStreamByobReader,
};

use crate::Engine;

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
    let body = field("body").dyn_into::<Uint8Array>().map(|body| body.to_vec()).unwrap_or_default();
    let mut files = Vec::new();
    for file in Array::from(&field("files")).iter() {
        let streams = field("streams").is_truthy();
        let given = if streams { stream(&file) } else { read(&file).await.map(Given::Whole) };
        match given {
            Ok(given) => files.push(given),
            Err(detail) => return say(unreadable(detail), Vec::new()),
        }
    }
    let served = match field("part").as_string().as_deref() {
        Some(Photos::NAME) => serve_photos(&body, files).await,
        Some(Networks::NAME) => match serve_networks(body, files).await {
            Ok(served) => served,
            Err(_) => Err("a part of the engine could not be loaded".into()),
        },
        part => Err(format!("{part:?} is no part of the engine")),
    };
    if let Err(detail) = served {
        crashed(&detail);
    }
}

async fn serve_photos(body: &[u8], mut files: Vec<Given>) -> Result<(), String> {
    let request = from_bytes::<Photos>(body)?;
    let glances = matches!(request, Photos::Glance(_));
    let packed = |file: &mut Given| match file {
        Given::Whole(bytes) => decode::packed(bytes).is_some(),
        Given::Stream(stream) => glances && is_heic(stream),
    };
    if files.iter_mut().any(packed) {
        load_codecs().await;
    }
    if !request.draws() {
        request.serve(&Engine, files, &mut say);
        return Ok(());
    }
    let mut words = Vec::new();
    request.serve(&Engine, files, &mut |body, bytes| words.push((body, bytes)));
    for (body, bytes) in words {
        match from_bytes::<SaidTo<ShowPhoto>>(&body) {
            Ok(Said::Done(plan)) => {
                let tiles = (0..plan.levels.len()).flat_map(|level| plan.tiles(level));
                let sizes = tiles.map(|[.., width, height]| [width, height]);
                match draw(&bytes, sizes).await {
                    Ok(pictures) => send(&body, &pictures, &Array::from(&pictures)),
                    // A browser whose workers cannot: the page does it.
                    Err(_) => say(body, bytes),
                }
            }
            _ => say(body, bytes),
        }
    }
    Ok(())
}

/// In a part of the module that the first such task loads, where the module is handed out; it fails where that part does not come.
#[cfg(in_parts)]
#[wasm_split_helpers::wasm_split(networks, fallible)]
fn serve_networks(body: Vec<u8>, files: Vec<Given>) -> Result<Result<(), String>, SplitLoaderError> {
    Ok(serve_networks_here(&body, files))
}

#[cfg(not(in_parts))]
async fn serve_networks(body: Vec<u8>, files: Vec<Given>) -> Result<Result<(), String>, SplitLoaderError> {
    Ok(serve_networks_here(&body, files))
}

fn serve_networks_here(body: &[u8], files: Vec<Given>) -> Result<(), String> {
    from_bytes::<Networks>(body)?.serve(&Engine, files, &mut say);
    Ok(())
}

/// Whether the embedded preview is packed as the photo is.
fn is_heic(file: &mut dyn Stream) -> bool {
    let mut head = Vec::new();
    let read = Read::take(&mut *file, 64).read_to_end(&mut head).and_then(|_| file.rewind());
    read.is_ok() && decode::packed(&head).is_some_and(|format| !format.is_raw())
}

/// Pictures that a canvas can draw, from red, green, blue, alpha bytes of these widths and heights.
async fn draw(bytes: &[Vec<u8>], sizes: impl Iterator<Item = [u32; 2]>) -> Result<Array, JsValue> {
    let pictures = Array::new();
    for (bytes, [width, height]) in bytes.iter().zip(sizes) {
        let bytes = Uint8ClampedArray::from(&bytes[..]);
        let data = ImageData::new_with_js_u8_clamped_array_and_sh(&bytes, width, height)?;
        let picture = JsFuture::from(scope().create_image_bitmap_with_image_data(&data)?).await?;
        pictures.push(picture.unchecked_ref::<ImageBitmap>());
    }
    Ok(pictures)
}

thread_local! {
    /// The decoders of HEIC and RAW, or why they are not here.
    static CODECS: RefCell<Result<Option<JsValue>, String>> = const { RefCell::new(Ok(None)) };
}

/// Has the decoders loaded, by `worker.js`, unless they are. After a failure the next file tries again.
async fn load_codecs() {
    if CODECS.with_borrow(|codecs| matches!(codecs, Ok(Some(_)))) {
        return;
    }
    let load = Reflect::get(&js_sys::global(), &"sightlineCodecs".into()).unwrap_or_default();
    let promise = load.dyn_into::<Function>().and_then(|load| load.call0(&JsValue::NULL));
    let loaded = match promise.and_then(|promise| promise.dyn_into::<Promise>()) {
        Ok(promise) => JsFuture::from(promise).await,
        Err(error) => Err(error),
    };
    CODECS.set(loaded.map(Some).map_err(|error| words(&error)));
}

/// Output of the decoders for a file: the header, the samples as bytes or words, the small picture.
///
/// # Errors
/// That the decoders are missing, and why; or the error they give, as JSON.
pub fn unpack(bytes: &[u8], channel: &str, samples: bool, max_side: u32) -> Result<Parts, Refusal> {
    let codecs = CODECS.with_borrow(|codecs| match codecs {
        Ok(Some(codecs)) => Ok(codecs.clone()),
        Ok(None) => Err(Refusal::Missing(String::new())),
        Err(message) => Err(Refusal::Missing(message.clone())),
    })?;
    let function = |name: &str| Reflect::get(&codecs, &name.into()).unwrap_or_default().unchecked_into::<Function>();
    let arguments: Array = [
        JsValue::from(Uint8Array::from(bytes)),
        JsValue::from(channel),
        JsValue::from(samples),
        JsValue::from(max_side),
    ]
    .into_iter()
    .collect();
    let parts = function("unpack").apply(&JsValue::NULL, &arguments).map_err(|error| {
        let told = error.as_string().unwrap_or_else(|| {
            let trapped = function("trapped").call1(&JsValue::NULL, &words(&error).into());
            trapped.ok().and_then(|text| text.as_string()).unwrap_or_default()
        });
        Refusal::Error(told)
    })?;
    let parts: Array = parts.unchecked_into();
    let samples = match parts.get(1).dyn_into::<Uint16Array>() {
        Ok(words) => Samples::U16(words.to_vec()),
        Err(bytes) => Samples::U8(bytes.unchecked_into::<Uint8Array>().to_vec()),
    };
    let small = parts.get(2).unchecked_into::<Uint8Array>().to_vec();
    Ok((parts.get(0).as_string().unwrap_or_default(), samples, small))
}

/// The header as JSON, the samples, the small picture.
pub type Parts = (String, Samples, Vec<u8>);

/// Why there are no parts.
pub enum Refusal {
    /// The decoders could not be loaded.
    Missing(String),
    /// An error of the engine, as JSON.
    Error(String),
}

fn words(error: &JsValue) -> String {
    match error.dyn_ref::<js_sys::Error>() {
        Some(error) => String::from(error.message()),
        None => format!("{error:?}"),
    }
}

async fn read(file: &JsValue) -> Result<Vec<u8>, String> {
    let blob = file.dyn_ref::<Blob>().ok_or("no file")?;
    read_in_pieces(blob).await.map_err(|error| words(&error))
}

/// Bytes of a file that are read at a time.
const PIECE: u32 = 1 << 20;

/// Reads a file through one small buffer: photo after photo in a buffer of its own lies there until the collector comes, a hundred
/// megabytes and more in each worker.
async fn read_in_pieces(blob: &Blob) -> Result<Vec<u8>, JsValue> {
    let Ok(reader) = ReadableStreamByobReader::new(&blob.stream()) else {
        // Browsers whose files are no streams of bytes.
        let buffer = JsFuture::from(blob.array_buffer()).await?;
        return Ok(Uint8Array::new(&buffer).to_vec());
    };
    let mut content = Vec::with_capacity(blob.size() as usize);
    let mut buffer = Uint8Array::new_with_length(PIECE);
    loop {
        let read = JsFuture::from(reader.read_with_array_buffer_view(&buffer)).await?;
        if Reflect::get(&read, &"done".into())?.is_truthy() {
            return Ok(content);
        }
        let piece = Reflect::get(&read, &"value".into())?.dyn_into::<Uint8Array>()?;
        let at = content.len();
        content.resize(at + piece.length() as usize, 0);
        piece.copy_to(&mut content[at..]);
        buffer = Uint8Array::new(&piece.buffer());
    }
}

fn stream(file: &JsValue) -> Result<Given, String> {
    let blob = file.dyn_ref::<Blob>().ok_or("no file")?;
    Ok(Given::Stream(Box::new(BlobStream { blob: blob.clone(), at: 0.0 })))
}

/// A file of which each part is read when it is asked for; only workers may wait for one.
struct BlobStream {
    blob: Blob,
    at: f64,
}

impl Read for BlobStream {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let read = || -> Result<Uint8Array, JsValue> {
            let part = self.blob.slice_with_f64_and_f64(self.at, self.at + into.len() as f64)?;
            Ok(Uint8Array::new(&FileReaderSync::new()?.read_as_array_buffer(&part)?.into()))
        };
        let part = read().map_err(|error| io::Error::other(words(&error)))?;
        let length = part.length() as usize;
        part.copy_to(&mut into[..length]);
        self.at += length as f64;
        Ok(length)
    }
}

impl Seek for BlobStream {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let at = match to {
            SeekFrom::Start(at) => at as f64,
            SeekFrom::Current(by) => self.at + by as f64,
            SeekFrom::End(by) => self.blob.size() + by as f64,
        };
        if at < 0.0 {
            return Err(io::ErrorKind::InvalidInput.into());
        }
        self.at = at;
        Ok(at as u64)
    }
}

fn say(body: Vec<u8>, bytes: Vec<Vec<u8>>) {
    let arrays = bytes.iter().map(|bytes| Uint8Array::from(&bytes[..])).collect::<Vec<_>>();
    send(&body, &arrays.iter().collect(), &arrays.iter().map(Uint8Array::buffer).collect());
}

/// Sends a message with its objects, which are transferred according to `transfer`.
fn send(body: &[u8], beside: &Array, transfer: &Array) {
    let message = Object::new();
    let body = Uint8Array::from(body);
    set(&message, "body", &body);
    // It only ever grows: the page counts with it.
    set(&message, "memory", &(core::arch::wasm32::memory_size::<0>() as f64 * 65536.0).into());
    set(&message, "bytes", beside);
    transfer.push(&body.buffer());
    post(&message, transfer);
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
