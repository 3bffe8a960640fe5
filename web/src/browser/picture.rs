//! Pictures for the screen, stored as JavaScript objects. The engine decodes photos, since a browser would rotate, colour-manage or
//! refuse them.

use std::rc::Rc;

use js_sys::Uint8ClampedArray;
use sightline_protocol::Pyramid as Plan;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::{ImageBitmap, ImageData};

use super::file::Blob;
use super::worker::{Bytes, describe};

/// A picture that a canvas can draw.
#[derive(Clone)]
pub struct Picture {
    pub(super) bitmap: ImageBitmap,
    pub width: u32,
    pub height: u32,
}

impl Picture {
    /// From red, green, blue, alpha bytes, row by row, or from the bitmap that a worker has made of them.
    pub async fn from_rgba(bytes: Bytes, width: u32, height: u32) -> Result<Self, String> {
        if let Some(bitmap) = bytes.0.dyn_ref::<ImageBitmap>() {
            return Ok(Self { bitmap: bitmap.clone(), width, height });
        }
        let make = || -> Result<js_sys::Promise, JsValue> {
            let clamped = Uint8ClampedArray::new(&bytes.0.buffer());
            let data = ImageData::new_with_js_u8_clamped_array_and_sh(&clamped, width, height)?;
            let window = web_sys::window().ok_or("no window")?;
            window.create_image_bitmap_with_image_data(&data)
        };
        let promise = make().map_err(|e| describe(&e))?;
        let bitmap = JsFuture::from(promise).await.map_err(|e| describe(&e))?;
        Ok(Self { bitmap: bitmap.unchecked_into(), width, height })
    }

    /// From a file that the page itself wrote; never for measuring.
    pub async fn from_blob(blob: &Blob) -> Result<Self, String> {
        let made = web_sys::window().ok_or(JsValue::from("no window"));
        let promise = made.and_then(|window| window.create_image_bitmap_with_blob(blob.inner()));
        let promise = promise.map_err(|e| describe(&e))?;
        let bitmap = JsFuture::from(promise).await.map_err(|e| describe(&e))?.unchecked_into::<ImageBitmap>();
        let (width, height) = (bitmap.width(), bitmap.height());
        Ok(Self { bitmap, width, height })
    }
}

/// A photo as an image pyramid: each level has half the size of the one before and is cut into tiles.
#[derive(Clone)]
pub struct Pyramid {
    pub(super) plan: Rc<Plan>,
    /// Level by level, in the order of the plan.
    pub(super) tiles: Rc<Tiles>,
}

/// Tiles whose bitmaps are closed when the last owner is dropped. The garbage collector would free them late, since it does not count
/// the memory of a bitmap.
#[derive(Default)]
pub(super) struct Tiles(pub(super) Vec<Vec<ImageBitmap>>);

impl Drop for Tiles {
    fn drop(&mut self) {
        self.0.iter().flatten().for_each(ImageBitmap::close);
    }
}

impl Pyramid {
    /// From the tiles in the order of the plan: bitmaps that a worker has made, or bytes if it could not.
    pub async fn from_tiles(plan: Plan, bytes: Vec<Bytes>) -> Result<Self, String> {
        let mut bytes = bytes.into_iter();
        let mut levels = Tiles::default();
        for level in 0..plan.levels.len() {
            levels.0.push(Vec::new());
            for [_, _, width, height] in plan.tiles(level) {
                let tile = bytes.next().ok_or("a tile is missing")?;
                let bitmap = Picture::from_rgba(tile, width, height).await?.bitmap;
                levels.0.last_mut().ok_or("no level")?.push(bitmap);
            }
        }
        Ok(Self { plan: Rc::new(plan), tiles: Rc::new(levels) })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [f64; 2] {
        self.plan.levels.first().map_or([1.0; 2], |size| size.map(f64::from))
    }
}
