//! A page of paper inside the page: its own style in a shadow, the style of printed pages with the document while it is shown.
//! Style sheets are constructed, which the Content-Security-Policy allows: nothing inline is in them.

use js_sys::{Array, Function, Object, Reflect, global};
use wasm_bindgen::prelude::*;
use web_sys::HtmlElement;

fn sheet(css: &str) -> Result<JsValue, JsValue> {
    let class: Function = Reflect::get(&global(), &"CSSStyleSheet".into())?.dyn_into()?;
    let sheet = Reflect::construct(&class, &Array::new())?;
    let replace: Function = Reflect::get(&sheet, &"replaceSync".into())?.dyn_into()?;
    replace.call1(&sheet, &css.into())?;
    Ok(sheet)
}

fn adopt(root: &JsValue, sheets: &Array) -> Result<(), JsValue> {
    Reflect::set(root, &"adoptedStyleSheets".into(), sheets).map(|_| ())
}

fn shadow(host: &HtmlElement) -> Result<JsValue, JsValue> {
    let known = Reflect::get(host, &"shadowRoot".into())?;
    if known.is_object() {
        return Ok(known);
    }
    let options = Object::new();
    Reflect::set(&options, &"mode".into(), &"open".into())?;
    let attach: Function = Reflect::get(host, &"attachShadow".into())?.dyn_into()?;
    attach.call1(host, &options)
}

fn document() -> Result<JsValue, JsValue> {
    Reflect::get(&global(), &"document".into())
}

/// Shows a page's content in `host`, and has the document printed as its pages are.
pub fn show(host: &HtmlElement, page_style: &str, style: &str, body: &str) {
    let shown = || -> Result<(), JsValue> {
        let shadow = shadow(host)?;
        adopt(&shadow, &Array::of1(&sheet(style)?))?;
        Reflect::set(&shadow, &"innerHTML".into(), &body.into())?;
        adopt(&document()?, &Array::of1(&sheet(page_style)?))
    };
    if let Err(fault) = shown() {
        web_sys::console::error_1(&fault);
    }
}

/// Shows a drawing in `host` with a style of its own; variables of the page's themes reach into it.
pub fn draw(host: &HtmlElement, style: &str, content: &str) {
    let shown = || -> Result<(), JsValue> {
        let shadow = shadow(host)?;
        adopt(&shadow, &Array::of1(&sheet(style)?))?;
        Reflect::set(&shadow, &"innerHTML".into(), &content.into()).map(|_| ())
    };
    if let Err(fault) = shown() {
        web_sys::console::error_1(&fault);
    }
}

/// Takes the content away.
pub fn clear(host: &HtmlElement) {
    let _ = shadow(host).and_then(|shadow| Reflect::set(&shadow, &"innerHTML".into(), &"".into()));
    without_page_style();
}

/// Has the document printed in the browser's own way again.
pub fn without_page_style() {
    let _ = document().and_then(|document| adopt(&document, &Array::new()));
}

/// Opens the browser's print dialogue.
pub fn print() {
    if let Some(window) = web_sys::window() {
        let _ = window.print();
    }
}
