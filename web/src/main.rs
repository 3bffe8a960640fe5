//! The page's own module: the document, the results and the interface. The engine works in the workers ([`sightline_protocol`]).

mod browser;
mod document;
mod edit;
mod format;
mod i18n;
mod parts;
mod store;
mod view;

fn main() {
    browser::page::report_panics();
    i18n::restore_language();
    leptos::mount::mount_to_body(view::shell::App);
    // The page stands: the engine may come.
    let _ = browser::worker::engine();
}
