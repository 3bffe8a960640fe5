//! The desk of Sightline. One module serves the page and its workers: where there is a page the desk is put on it,
//! elsewhere requests are waited for.

mod browser;
mod format;
mod i18n;
mod protocol;
mod store;
mod view;
mod worker;

fn main() {
    browser::page::report_panics();
    if browser::page::is_page() {
        i18n::restore_language();
        leptos::mount::mount_to_body(view::shell::App);
    } else {
        browser::worker::serve_requests(worker::serve);
    }
}
