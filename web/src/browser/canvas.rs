//! Drawing on canvases in CSS pixels; the device's pixel ratio is dealt with here.

use std::f64::consts::TAU;

use wasm_bindgen::prelude::*;
use web_sys::{CanvasRenderingContext2d, HtmlCanvasElement, ImageData, ResizeObserver};

use super::picture::{Picture, Pyramid};

/// Height of text on a canvas, whatever the zoom.
pub const TEXT_SIZE: f64 = 12.0;

/// A canvas of the page.
pub type CanvasElement = HtmlCanvasElement;

/// A canvas ready to be drawn on, cleared.
pub struct Surface {
    context: CanvasRenderingContext2d,
    pub width: f64,
    pub height: f64,
    ratio: f64,
    style: Option<web_sys::CssStyleDeclaration>,
}

/// A plane affine map (x, y) -> (a x + c y + e, b x + d y + f).
pub type Affine = [f64; 6];

impl Surface {
    /// Fits the canvas to its box on the page, whose width and height [`SizeWatch`] found, and clears it. Asking the page for them here would
    /// have it laid out at once, in the middle of an edit.
    pub fn new(canvas: &HtmlCanvasElement, [width, height]: [f64; 2]) -> Option<Self> {
        let window = web_sys::window()?;
        let ratio = window.device_pixel_ratio().clamp(1.0, 3.0);
        let (w, h) = ((width * ratio).round() as u32, (height * ratio).round() as u32);
        if canvas.width() != w || canvas.height() != h {
            canvas.set_width(w);
            canvas.set_height(h);
        }
        let context: CanvasRenderingContext2d = canvas.get_context("2d").ok()??.unchecked_into();
        let _ = context.set_transform(ratio, 0.0, 0.0, ratio, 0.0, 0.0);
        context.clear_rect(0.0, 0.0, width, height);
        let style = window.get_computed_style(canvas).ok().flatten();
        Some(Self { context, width, height, ratio, style })
    }

    /// The value of a design token, such as "--p-accent".
    pub fn token(&self, name: &str) -> String {
        let value = self.style.as_ref().and_then(|s| s.get_property_value(name).ok()).unwrap_or_default();
        value.trim().to_owned()
    }

    /// Draws a picture whose pixel frame is mapped to the canvas by `map`; crisp keeps pixels square.
    pub fn picture(&self, picture: &Picture, map: Affine, crisp: bool) {
        let [a, b, c, d, e, f] = map.map(|x| x * self.ratio);
        let _ = self.context.set_transform(a, b, c, d, e, f);
        self.context.set_image_smoothing_enabled(!crisp);
        let _ = self.context.draw_image_with_image_bitmap(&picture.bitmap, 0.0, 0.0);
        let _ = self.context.set_transform(self.ratio, 0.0, 0.0, self.ratio, 0.0, 0.0);
    }

    /// Draws what is in sight of a photo, its pixel frame mapped to the canvas by `map`, from the level that has at most two pixels
    /// for one of the screen.
    pub fn pyramid(&self, pyramid: &Pyramid, map: Affine, crisp: bool) {
        let scale = self.ratio * map[0].hypot(map[1]);
        let last = pyramid.tiles.0.len().saturating_sub(1);
        let level = if scale < 1.0 { ((1.0 / scale).log2().floor() as usize).min(last) } else { 0 };
        let factor = f64::from(1u32 << level);
        let [a, b, c, d, e, f] = map;
        let map = [a * factor, b * factor, c * factor, d * factor, e, f];
        let [left, top, right, bottom] = self.sight(map);
        let [m0, m1, m2, m3, m4, m5] = map.map(|x| x * self.ratio);
        let _ = self.context.set_transform(m0, m1, m2, m3, m4, m5);
        self.context.set_image_smoothing_enabled(!crisp);
        let Some(tiles) = pyramid.tiles.0.get(level) else { return };
        for ([x, y, width, height], tile) in pyramid.plan.tiles(level).into_iter().zip(tiles) {
            let [x, y, width, height] = [x, y, width, height].map(f64::from);
            if x < right && x + width > left && y < bottom && y + height > top {
                let _ = self.context.draw_image_with_image_bitmap(tile, x, y);
            }
        }
        let _ = self.context.set_transform(self.ratio, 0.0, 0.0, self.ratio, 0.0, 0.0);
    }

    /// Pixels of the device that a CSS pixel has.
    pub fn ratio(&self) -> f64 {
        self.ratio
    }

    /// Puts device pixels (RGBA, row by row) over the canvas from its top left corner.
    pub fn raster(&self, rgba: &[u8], width: u32, height: u32) {
        let clamped = js_sys::Uint8ClampedArray::from(rgba);
        if let Ok(data) = ImageData::new_with_js_u8_clamped_array_and_sh(&clamped, width, height) {
            let _ = self.context.put_image_data(&data, 0.0, 0.0);
        }
    }

    /// Visible part of a frame that `map` maps to the canvas: left, top, right, bottom.
    pub fn sight(&self, [a, b, c, d, e, f]: Affine) -> [f64; 4] {
        let determinant = a * d - b * c;
        let place = |x: f64, y: f64| {
            let (x, y) = (x - e, y - f);
            [(d * x - c * y) / determinant, (a * y - b * x) / determinant]
        };
        let corners =
            [place(0.0, 0.0), place(self.width, 0.0), place(0.0, self.height), place(self.width, self.height)];
        let of = |axis: usize, pick: fn(f64, f64) -> f64| {
            corners.iter().map(|corner| corner[axis]).reduce(pick).unwrap_or_default()
        };
        [of(0, f64::min), of(1, f64::min), of(0, f64::max), of(1, f64::max)]
    }

    /// Small texts around their places, readable on any ground.
    pub fn values<'a>(&self, texts: impl Iterator<Item = (&'a str, [f64; 2])>, colour: &str, outline: &str) {
        self.font(false);
        self.context.set_text_align("center");
        self.context.set_text_baseline("middle");
        self.context.set_line_join("round");
        self.pen(outline, 3.0, &[]);
        self.context.set_fill_style_str(colour);
        for (text, [x, y]) in texts {
            let _ = self.context.stroke_text(text, x, y);
            let _ = self.context.fill_text(text, x, y);
        }
        self.context.set_text_align("start");
        self.context.set_text_baseline("alphabetic");
    }

    /// Sets colour, width (0 for fills) and dashes of what follows.
    pub fn pen(&self, colour: &str, width: f64, dashes: &[f64]) {
        self.context.set_stroke_style_str(colour);
        self.context.set_fill_style_str(colour);
        self.context.set_line_width(width);
        let list = dashes.iter().map(|&d| JsValue::from(d)).collect::<js_sys::Array>();
        let _ = self.context.set_line_dash(&list);
    }

    /// An ellipse by centre, half axes and the angle of the first.
    pub fn ellipse(&self, x: f64, y: f64, a: f64, b: f64, angle: f64) {
        self.context.begin_path();
        let _ = self.context.ellipse(x, y, a, b, angle, 0.0, TAU);
        self.context.stroke();
    }

    pub fn line(&self, x1: f64, y1: f64, x2: f64, y2: f64) {
        self.context.begin_path();
        self.context.move_to(x1, y1);
        self.context.line_to(x2, y2);
        self.context.stroke();
    }

    pub fn rectangle(&self, x: f64, y: f64, width: f64, height: f64) {
        self.context.stroke_rect(x, y, width, height);
    }

    /// Text with an outline that keeps it readable on any photo.
    pub fn label(&self, text: &str, [x, y]: [f64; 2], strong: bool, colour: &str, outline: &str) {
        self.font(strong);
        self.pen(outline, 3.0, &[]);
        self.context.set_line_join("round");
        let _ = self.context.stroke_text(text, x, y);
        self.pen(colour, 0.0, &[]);
        let _ = self.context.fill_text(text, x, y);
    }

    /// Text on a filled field.
    pub fn chip(&self, text: &str, [x, y]: [f64; 2], field: &str, ink: &str) {
        self.font(true);
        let width = self.context.measure_text(text).map(|m| m.width()).unwrap_or(0.0) + 12.0;
        self.pen(field, 0.0, &[]);
        self.context.fill_rect(x, y - TEXT_SIZE - 3.0, width, TEXT_SIZE + 8.0);
        self.pen(ink, 0.0, &[]);
        let _ = self.context.fill_text(text, x + 6.0, y);
    }

    fn font(&self, strong: bool) {
        let weight = if strong { 600 } else { 400 };
        self.context.set_font(&format!("{weight} {TEXT_SIZE}px {}", self.token("--font")));
    }
}

/// Calls back with the size of a canvas on the page, now and when it changes, as long as this is kept.
pub struct SizeWatch {
    observer: ResizeObserver,
    _callback: Closure<dyn FnMut()>,
}

impl SizeWatch {
    /// Calls `on_size` with width and height.
    pub fn new(canvas: &HtmlCanvasElement, on_size: impl Fn(&HtmlCanvasElement, [f64; 2]) + 'static) -> Option<Self> {
        let element = canvas.clone();
        let callback = Closure::<dyn FnMut()>::new(move || {
            on_size(&element, [element.client_width(), element.client_height()].map(f64::from));
        });
        let observer = ResizeObserver::new(callback.as_ref().unchecked_ref()).ok()?;
        observer.observe(canvas);
        Some(Self { observer, _callback: callback })
    }
}

impl Drop for SizeWatch {
    fn drop(&mut self) {
        self.observer.disconnect();
    }
}
