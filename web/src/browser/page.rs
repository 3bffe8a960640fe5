//! The page itself: where the program runs, language and theme of the document, preferences, address, clipboard.

use wasm_bindgen::prelude::*;
use web_sys::{HtmlElement, Window};

fn window() -> Option<Window> {
    web_sys::window()
}

/// A number of workers that leaves the machine usable.
pub fn worker_count() -> usize {
    let cores = window().map_or(2.0, |w| w.navigator().hardware_concurrency());
    (cores as usize).clamp(1, 8)
}

/// Sets an attribute of the root element (`lang`, `data-theme`).
pub fn set_root_attribute(name: &str, value: &str) {
    if let Some(root) = window().and_then(|w| w.document()).and_then(|d| d.document_element()) {
        let _ = root.set_attribute(name, value);
    }
}

pub fn set_title(title: &str) {
    if let Some(document) = window().and_then(|w| w.document()) {
        document.set_title(title);
    }
}

/// The first language that the browser's user prefers.
pub fn preferred_language() -> String {
    window().and_then(|w| w.navigator().language()).unwrap_or_default()
}

/// Whether the browser's user prefers dark pages.
pub fn prefers_dark() -> bool {
    window().and_then(|w| w.match_media("(prefers-color-scheme: dark)").ok().flatten()).is_some_and(|m| m.matches())
}

/// A preference of this browser; none where storage is switched off.
pub fn preference(name: &str) -> Option<String> {
    window()?.local_storage().ok()??.get_item(&format!("sightline.{name}")).ok()?
}

pub fn set_preference(name: &str, value: &str) {
    // Without storage the preference lasts as long as the page.
    if let Some(Ok(Some(storage))) = window().map(|w| w.local_storage()) {
        let _ = storage.set_item(&format!("sightline.{name}"), value);
    }
}

/// The address after '#'.
pub fn hash() -> String {
    let hash = window().and_then(|w| w.location().hash().ok()).unwrap_or_default();
    hash.trim_start_matches('#').to_owned()
}

pub fn set_hash(value: &str) {
    if let Some(window) = window().filter(|_| hash() != value) {
        let _ = window.location().set_hash(value);
    }
}

/// Calls `work` after so many milliseconds.
pub fn after(milliseconds: i32, work: impl FnOnce() + 'static) {
    if let Some(window) = window() {
        let work = Closure::once_into_js(work);
        let _ = window.set_timeout_with_callback_and_timeout_and_arguments_0(work.unchecked_ref(), milliseconds);
    }
}

/// Puts text on the clipboard.
pub fn copy(text: &str) {
    if let Some(window) = window() {
        let _ = window.navigator().clipboard().write_text(text);
    }
}

/// Milliseconds of the page's clock.
pub fn now() -> f64 {
    js_sys::Date::now()
}

/// Local time as hours and minutes.
pub fn clock() -> String {
    let now = js_sys::Date::new_0();
    format!("{:02}:{:02}", now.get_hours(), now.get_minutes())
}

/// Asks before the page with unsaved work is left.
pub fn warn_before_leaving(unsaved: impl Fn() -> bool + 'static) {
    let listener = Closure::<dyn FnMut(web_sys::Event)>::new(move |event: web_sys::Event| {
        if unsaved() {
            event.prevent_default();
        }
    });
    if let Some(window) = window() {
        let _ = window.add_event_listener_with_callback("beforeunload", listener.as_ref().unchecked_ref());
    }
    listener.forget();
}

/// A panic ends the module: its words go to the console, since nothing else can show them any more.
pub fn report_panics() {
    std::panic::set_hook(Box::new(|info| {
        web_sys::console::error_1(&info.to_string().into());
    }));
}

/// How far a box is scrolled, how high it is, and how high its first row is.
pub fn scroll_state(frame: &HtmlElement, row: &str) -> (f64, f64, Option<f64>) {
    let row = frame.query_selector(row).ok().flatten().map(|r| r.get_bounding_client_rect().height());
    (f64::from(frame.scroll_top()), f64::from(frame.client_height()), row.filter(|h| *h > 0.0))
}
