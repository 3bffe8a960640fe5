//! Data of pointer, wheel and key events.

use wasm_bindgen::prelude::*;
use web_sys::{DragEvent, Element, Event, HtmlElement, HtmlInputElement, HtmlSelectElement, HtmlTextAreaElement};
use web_sys::{KeyboardEvent, PointerEvent, WheelEvent};

use super::file::{NamedFile, dropped};

/// Modifier keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Modifiers {
    pub shift: bool,
    pub alt: bool,
    /// Control, or Command on a Mac.
    pub control: bool,
}

/// A pointer over an element: position in CSS pixels from its top left corner.
#[derive(Clone, Copy, Debug)]
pub struct Pointer {
    pub id: i32,
    pub x: f64,
    pub y: f64,
    /// 0 main, 1 middle, 2 secondary.
    pub button: i16,
    pub touch: bool,
    pub modifiers: Modifiers,
}

fn offset(event: &Event, client_x: i32, client_y: i32) -> (f64, f64) {
    let Some(element) = event.current_target().and_then(|t| t.dyn_into::<Element>().ok()) else {
        return (0.0, 0.0);
    };
    let rect = element.get_bounding_client_rect();
    (f64::from(client_x) - rect.left(), f64::from(client_y) - rect.top())
}

pub fn pointer(event: &PointerEvent) -> Pointer {
    let (x, y) = offset(event, event.client_x(), event.client_y());
    Pointer {
        id: event.pointer_id(),
        x,
        y,
        button: event.button(),
        touch: event.pointer_type() == "touch",
        modifiers: Modifiers {
            shift: event.shift_key(),
            alt: event.alt_key(),
            control: event.ctrl_key() || event.meta_key(),
        },
    }
}

/// Where a pointer is in an element, as shares of its width and height.
pub fn share(event: &PointerEvent) -> [f64; 2] {
    let (x, y) = offset(event, event.client_x(), event.client_y());
    let size = event.current_target().and_then(|t| t.dyn_into::<Element>().ok()).map(|e| e.get_bounding_client_rect());
    size.map_or([0.0; 2], |rect| [x / rect.width().max(1.0), y / rect.height().max(1.0)])
}

/// Keeps the pointer's further events with its element.
pub fn capture(event: &PointerEvent) {
    if let Some(element) = event.current_target().and_then(|t| t.dyn_into::<Element>().ok()) {
        let _ = element.set_pointer_capture(event.pointer_id());
    }
}

/// A wheel or trackpad step: position, steps in CSS pixels, and whether it asks for zoom (pinch or a mouse wheel).
#[derive(Clone, Copy, Debug)]
pub struct Wheel {
    pub x: f64,
    pub y: f64,
    pub dx: f64,
    pub dy: f64,
    pub zoom: bool,
}

pub fn wheel(event: &WheelEvent) -> Wheel {
    event.prevent_default();
    let (x, y) = offset(event, event.client_x(), event.client_y());
    let unit = match event.delta_mode() {
        WheelEvent::DOM_DELTA_LINE => 33.0,
        WheelEvent::DOM_DELTA_PAGE => 400.0,
        _ => 1.0,
    };
    let (dx, dy) = (event.delta_x() * unit, event.delta_y() * unit);
    // A trackpad scrolls in both directions and in small fractions, and marks a pinch as control and wheel.
    let trackpad = !event.ctrl_key() && (dx != 0.0 || dy.fract() != 0.0 || dy.abs() < 40.0);
    Wheel { x, y, dx, dy, zoom: !trackpad }
}

/// A key press with its modifiers.
#[derive(Clone, Debug)]
pub struct Key {
    pub key: String,
    pub modifiers: Modifiers,
    /// Text is being typed (a field has the focus or a composition is under way): shortcuts are suspended.
    pub typing: bool,
    /// The key goes to a table itself, and not to a button in it.
    pub on_table: bool,
}

pub fn key(event: &KeyboardEvent) -> Key {
    let target = event.target().and_then(|t| t.dyn_into::<HtmlElement>().ok());
    let tag = target.as_ref().map(|t| t.tag_name()).unwrap_or_default();
    let typing = event.is_composing() || matches!(tag.as_str(), "INPUT" | "TEXTAREA" | "SELECT");
    Key {
        key: event.key(),
        modifiers: Modifiers {
            shift: event.shift_key(),
            alt: event.alt_key(),
            control: event.ctrl_key() || event.meta_key(),
        },
        typing,
        on_table: tag == "TABLE",
    }
}

/// Calls `on_key` for every key pressed on the page; what it uses up goes no further.
pub fn listen_to_keys(on_key: impl Fn(Key) -> bool + 'static) {
    let listener = Closure::<dyn FnMut(KeyboardEvent)>::new(move |event: KeyboardEvent| {
        if on_key(key(&event)) {
            event.prevent_default();
        }
    });
    listen("keydown", listener.into_js_value().unchecked_ref());
}

/// Calls `on_hash` when the address after '#' changes.
pub fn listen_to_hash(on_hash: impl Fn() + 'static) {
    let listener = Closure::<dyn FnMut()>::new(on_hash);
    listen("hashchange", listener.into_js_value().unchecked_ref());
}

fn listen(name: &str, listener: &js_sys::Function) {
    if let Some(window) = web_sys::window() {
        let _ = window.add_event_listener_with_callback(name, listener);
    }
}

/// The files of a drop; the browser must not open them itself.
pub fn files_of_drop(event: &DragEvent) -> Vec<NamedFile> {
    event.prevent_default();
    dropped(event.data_transfer())
}

/// Value of an input, text area or select.
pub fn value(event: &Event) -> String {
    let Some(target) = event.target() else { return String::new() };
    if let Some(input) = target.dyn_ref::<HtmlInputElement>() {
        input.value()
    } else if let Some(select) = target.dyn_ref::<HtmlSelectElement>() {
        select.value()
    } else if let Some(area) = target.dyn_ref::<HtmlTextAreaElement>() {
        area.value()
    } else {
        String::new()
    }
}

/// Empties a text area.
pub fn clear(event: &Event) {
    if let Some(area) = event.target().and_then(|t| t.dyn_into::<HtmlTextAreaElement>().ok()) {
        area.set_value("");
    }
}

/// Puts a select back to its first choice: it was a verb.
pub fn choose_first(event: &Event) {
    if let Some(select) = event.target().and_then(|t| t.dyn_into::<HtmlSelectElement>().ok()) {
        select.set_selected_index(0);
    }
}

/// Whether a check box is ticked.
pub fn checked(event: &Event) -> bool {
    event.target().and_then(|t| t.dyn_into::<HtmlInputElement>().ok()).is_some_and(|i| i.checked())
}
