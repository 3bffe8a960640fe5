//! The page itself: where the program runs, language and theme of the document, preferences, address, clipboard.

use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::{HtmlElement, Window};

#[wasm_bindgen]
extern "C" {
    type MessageChannel;
    type MessagePort;
    #[wasm_bindgen(constructor, catch)]
    fn new() -> Result<MessageChannel, JsValue>;
    #[wasm_bindgen(method, getter)]
    fn port1(this: &MessageChannel) -> MessagePort;
    #[wasm_bindgen(method, getter)]
    fn port2(this: &MessageChannel) -> MessagePort;
    #[wasm_bindgen(method, setter)]
    fn set_onmessage(this: &MessagePort, listener: &js_sys::Function);
    #[wasm_bindgen(method, js_name = postMessage)]
    fn post_message(this: &MessagePort, message: &JsValue);
    #[wasm_bindgen(method)]
    fn close(this: &MessagePort);
}

fn window() -> Option<Window> {
    web_sys::window()
}

/// A number of workers that leaves the machine usable, each of them busy with a photo of so many pixels, where the largest has taken so
/// many bytes.
pub fn worker_count(pixels: f64, taken: f64) -> usize {
    let Some(navigator) = window().map(|w| w.navigator()) else { return 1 };
    // Browsers that do not report it (none does over plain HTTP) may be on a phone.
    let gigabytes = js_sys::Reflect::get(&navigator, &"deviceMemory".into()).ok().and_then(|m| m.as_f64());
    workers_for(navigator.hardware_concurrency(), gigabytes.unwrap_or(2.0), pixels, taken)
}

/// Memory of a worker before its first task.
const MODULE: f64 = 40e6;

/// Processors less those that memory has no room for: a worker has its module and its heap, the file, its luma and what detection
/// takes of it, about eight bytes a pixel (measured); a quarter of the memory, and never more than 0.9 GB, is for all of them.
fn workers_for(cores: f64, gigabytes: f64, pixels: f64, taken: f64) -> usize {
    let room = (gigabytes * 0.25e9).min(0.9e9);
    let each = (MODULE + 8.0 * pixels).max(MODULE + taken);
    (cores.min(room / each) as usize).clamp(1, 8)
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

/// Opens the browser's own dialogue for printing.
pub fn print() {
    if let Some(window) = web_sys::window() {
        let _ = window.print();
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

/// A preference of this browser; `None` if storage is switched off.
pub fn preference(name: &str) -> Option<String> {
    window()?.local_storage().ok()??.get_item(&format!("sightline.{name}")).ok()?
}

pub fn set_preference(name: &str, value: &str) {
    // Without storage the preference lasts as long as the page.
    if let Some(Ok(Some(storage))) = window().map(|w| w.local_storage()) {
        let _ = storage.set_item(&format!("sightline.{name}"), value);
    }
}

/// State of this window that survives a reload of its page; `None` if storage is switched off.
pub fn visit(name: &str) -> Option<String> {
    window()?.session_storage().ok()??.get_item(&format!("sightline.{name}")).ok()?
}

pub fn set_visit(name: &str, value: &str) {
    if let Some(Ok(Some(storage))) = window().map(|w| w.session_storage()) {
        let _ = storage.set_item(&format!("sightline.{name}"), value);
    }
}

pub fn forget_visit(name: &str) {
    if let Some(Ok(Some(storage))) = window().map(|w| w.session_storage()) {
        let _ = storage.remove_item(&format!("sightline.{name}"));
    }
}

/// Forgets all preferences, and the copies of the page for times without a network.
pub async fn forget_everything() {
    if let Some(Ok(Some(storage))) = window().map(|w| w.local_storage()) {
        let all = 0..storage.length().unwrap_or(0);
        let names = all.filter_map(|i| storage.key(i).ok().flatten()).filter(|name| name.starts_with("sightline."));
        for name in names.collect::<Vec<_>>() {
            let _ = storage.remove_item(&name);
        }
    }
    let forget = js_sys::Reflect::get(&js_sys::global(), &"sightlineForget".into()).unwrap_or_default();
    let forgotten = forget.dyn_into::<js_sys::Function>().ok().and_then(|f| f.call0(&JsValue::UNDEFINED).ok());
    if let Some(forgotten) = forgotten.and_then(|promise| promise.dyn_into::<js_sys::Promise>().ok()) {
        let _ = JsFuture::from(forgotten).await;
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

/// Lets the page do what waits before this goes on, at once; timers would wait for seconds where the page is not shown.
pub async fn breathe() {
    let Ok(channel) = MessageChannel::new() else { return };
    let came = js_sys::Promise::new(&mut |resolve, _| channel.port1().set_onmessage(&resolve));
    channel.port2().post_message(&JsValue::NULL);
    let _ = JsFuture::from(came).await;
    channel.port1().close();
}

/// Waits so many milliseconds.
pub async fn pause(milliseconds: i32) {
    let waited = js_sys::Promise::new(&mut |resolve, _| {
        after(milliseconds, move || {
            let _ = resolve.call0(&JsValue::UNDEFINED);
        });
    });
    let _ = JsFuture::from(waited).await;
}

/// Puts text on the clipboard; calls `on_failure` where the browser does not let it.
pub fn copy(text: String, on_failure: impl FnOnce() + 'static) {
    wasm_bindgen_futures::spawn_local(async move {
        if written_to_clipboard(&text).await.is_none() && copied_as_selection(&text) != Some(true) {
            on_failure();
        }
    });
}

/// Over plain HTTP there is no such clipboard.
async fn written_to_clipboard(text: &str) -> Option<()> {
    let field = |object: &JsValue, name: &str| js_sys::Reflect::get(object, &name.into()).ok();
    let clipboard = field(&window()?.navigator(), "clipboard")?;
    let write = field(&clipboard, "writeText")?.dyn_into::<js_sys::Function>().ok()?;
    let written: js_sys::Promise = write.call1(&clipboard, &text.into()).ok()?.dyn_into().ok()?;
    JsFuture::from(written).await.ok().map(drop)
}

/// The way before there was one: what is selected is copied by a command, within the click that asked for it.
fn copied_as_selection(text: &str) -> Option<bool> {
    let document = window()?.document()?;
    let before = document.active_element();
    let field: web_sys::HtmlTextAreaElement = document.create_element("textarea").ok()?.dyn_into().ok()?;
    field.set_value(text);
    document.body()?.append_child(&field).ok()?;
    field.select();
    let command = js_sys::Reflect::get(&document, &"execCommand".into()).ok()?.dyn_into::<js_sys::Function>().ok()?;
    let copied = command.call1(&document, &"copy".into()).ok().and_then(|done| done.as_bool());
    field.remove();
    if let Some(before) = before.and_then(|element| element.dyn_into::<HtmlElement>().ok()) {
        let _ = before.focus();
    }
    copied
}

/// Whether the host has another build of the page by now: one that does not name the folder in which the files of this one lie.
pub async fn host_has_another_build() -> bool {
    let asked = async {
        let base = js_sys::Reflect::get(&js_sys::global(), &"sightlineBase".into()).ok()?.as_string()?;
        let folder = base.trim_end_matches('/').rsplit('/').next()?.to_owned();
        let options = js_sys::Object::new();
        js_sys::Reflect::set(&options, &"cache".into(), &"no-store".into()).ok()?;
        let fetch =
            js_sys::Reflect::get(&js_sys::global(), &"fetch".into()).ok()?.dyn_into::<js_sys::Function>().ok()?;
        let fetched =
            fetch.call2(&js_sys::global(), &"./".into(), &options).ok()?.dyn_into::<js_sys::Promise>().ok()?;
        let response: web_sys::Response = JsFuture::from(fetched).await.ok()?.dyn_into().ok()?;
        let page = JsFuture::from(response.text().ok()?).await.ok()?.as_string()?;
        Some(response.ok() && page.contains("desk_bg.wasm") && !page.contains(&format!("{folder}/")))
    };
    asked.await.unwrap_or(false)
}

/// Loads the page anew.
pub fn reload() {
    if let Some(window) = window() {
        let _ = window.location().reload();
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

/// The local date: 2026-11-22.
pub fn today() -> String {
    let now = js_sys::Date::new_0();
    format!("{:04}-{:02}-{:02}", now.get_full_year(), now.get_month() + 1, now.get_date())
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

/// Gives the first such element of a box the focus.
pub fn focus_in(frame: &HtmlElement, which: &str) {
    if let Some(element) = frame.query_selector(which).ok().flatten().and_then(|e| e.dyn_into::<HtmlElement>().ok()) {
        let _ = element.focus();
    }
}

/// Gives the element of this name the focus.
pub fn focus_id(id: &str) {
    let found = window().and_then(|w| w.document()).and_then(|d| d.get_element_by_id(id));
    if let Some(element) = found.and_then(|e| e.dyn_into::<HtmlElement>().ok()) {
        let _ = element.focus();
    }
}

/// A selector of the field that has the focus, by its name or column: it finds the field again where the page draws it anew.
pub fn focused_field() -> Option<String> {
    let element = window()?.document()?.active_element()?;
    let by = |name: &str| Some(format!("[{name}=\"{}\"]", element.get_attribute(name)?));
    by("name").or_else(|| by("data-column"))
}

/// Gives the first such element of the page the focus.
pub fn focus_first(which: &str) {
    let found = window().and_then(|w| w.document()).and_then(|d| d.query_selector(which).ok().flatten());
    if let Some(element) = found.and_then(|e| e.dyn_into::<HtmlElement>().ok()) {
        let _ = element.focus();
    }
}

/// A name that no other has.
pub fn unique_name() -> String {
    let part = || format!("{:08x}", (js_sys::Math::random() * 4_294_967_296.0) as u32);
    format!("{:x}-{}{}", now() as u64, part(), part())
}

/// Whether the browser reports that there is no network.
pub fn is_offline() -> bool {
    window().is_some_and(|w| !w.navigator().on_line())
}

/// Calls `on_change` when the network comes or goes.
pub fn listen_to_network(on_change: impl Fn() + 'static) {
    let listener = Closure::<dyn FnMut()>::new(on_change).into_js_value();
    if let Some(window) = window() {
        for name in ["online", "offline"] {
            let _ = window.add_event_listener_with_callback(name, listener.unchecked_ref());
        }
    }
}

/// Messages of the page's start (`web/start.js`).
pub enum Told {
    /// A new build is here, and waits to be agreed to.
    Update,
    /// The page works only with the network: the browser or the host has no place for it.
    Network,
    /// The installed page was opened with files.
    Files(Vec<super::file::NamedFile>),
}

/// Calls `on_told` for past and future messages of the start.
pub fn listen_to_start(on_told: impl Fn(Told) + 'static) {
    let listener = Closure::<dyn FnMut()>::new(move || {
        let told = js_sys::Reflect::get(&js_sys::global(), &"sightlineTold".into()).unwrap_or_default();
        let Ok(told) = told.dyn_into::<js_sys::Array>() else { return };
        while told.length() > 0 {
            let next = told.shift();
            let field = |name: &str| js_sys::Reflect::get(&next, &name.into()).unwrap_or_default();
            match field("word").as_string().as_deref() {
                Some("update") => on_told(Told::Update),
                Some("network") => on_told(Told::Network),
                Some("files") => on_told(Told::Files(super::file::of_array(&field("detail")))),
                _ => {}
            }
        }
    })
    .into_js_value();
    let listener: js_sys::Function = listener.unchecked_into();
    if let Some(window) = window() {
        let _ = window.add_event_listener_with_callback("sightline", &listener);
        let _ = listener.call0(&JsValue::UNDEFINED);
    }
}

/// Agrees to the new build: the page reloads with it.
pub fn take_update() {
    if let (Some(window), Ok(event)) = (window(), web_sys::Event::new("sightline-update")) {
        let _ = window.dispatch_event(&event);
    }
}

/// A moment as this browser writes dates: the time where it is of today, else the day.
pub fn moment(milliseconds: f64, language: &str) -> String {
    let (date, now) = (js_sys::Date::new(&milliseconds.into()), js_sys::Date::new_0());
    let day = |d: &js_sys::Date| (d.get_full_year(), d.get_month(), d.get_date());
    if day(&date) == day(&now) {
        return format!("{:02}:{:02}", date.get_hours(), date.get_minutes());
    }
    let options = js_sys::Object::new();
    for (name, value) in [("day", "numeric"), ("month", "short")] {
        let _ = js_sys::Reflect::set(&options, &name.into(), &value.into());
    }
    String::from(date.to_locale_date_string(language, &options))
}

/// Bytes of this origin in the browser's storage: used, and in all. `None` if it does not report it.
pub async fn space() -> Option<(f64, f64)> {
    let storage = storage_manager()?;
    let estimate = JsFuture::from(storage.estimate().ok()?).await.ok()?;
    let value = |name: &str| js_sys::Reflect::get(&estimate, &name.into()).ok()?.as_f64();
    Some((value("usage")?, value("quota")?))
}

/// Asks that what is stored here is kept when space runs short; whether it is.
pub async fn ask_to_persist() -> bool {
    let asked = async { JsFuture::from(storage_manager()?.persist().ok()?).await.ok()?.as_bool() };
    asked.await.unwrap_or(false)
}

/// Absent where the page does not come from a secure origin.
fn storage_manager() -> Option<web_sys::StorageManager> {
    let navigator = window()?.navigator();
    let storage = js_sys::Reflect::get(&navigator, &"storage".into()).ok()?;
    storage.dyn_into().ok()
}

/// Shows an element on the whole screen, or no more.
pub fn switch_full_screen(element: &HtmlElement) {
    let Some(document) = window().and_then(|w| w.document()) else { return };
    if document.fullscreen_element().is_some() {
        document.exit_fullscreen();
    } else {
        // Where the browser refuses, the view stays as large as it is.
        let _ = element.request_fullscreen();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn workers_follow_memory_and_the_size_of_photos() {
        assert_eq!(workers_for(16.0, 8.0, 2e6, 0.0), 8);
        assert_eq!(workers_for(8.0, 8.0, 24e6, 100e6), 3);
        assert_eq!(workers_for(8.0, 8.0, 24e6, 400e6), 2);
        assert_eq!(workers_for(8.0, 2.0, 24e6, 0.0), 2);
        assert_eq!(workers_for(8.0, 0.5, 100e6, 0.0), 1);
        assert_eq!(workers_for(2.0, 8.0, 24e6, 0.0), 2);
    }
}
