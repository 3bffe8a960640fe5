//! Every key and what it does, under "?"; keys of one letter can be switched off.

use leptos::html::Dialog;
use leptos::prelude::*;

use crate::browser::event;
use crate::i18n::{Text, text};
use crate::store::Desk;

/// Keys and what they do, by where they work.
fn all() -> [(Text, Vec<(&'static str, Text)>); 4] {
    [
        (
            text::keys_everywhere as Text,
            vec![
                ("Ctrl Z", text::undo as Text),
                ("Ctrl Shift Z, Ctrl Y", text::redo),
                ("Ctrl S", text::save),
                ("Ctrl Shift S", text::save_with_photos),
                ("T", text::tables),
                ("Esc", text::key_escape),
                ("?", text::keys_title),
            ],
        ),
        (
            text::keys_measuring,
            vec![
                ("M", text::point_by_point as Text),
                ("Y", text::key_yes),
                ("N", text::key_no),
                ("P", text::next_point),
                ("D", text::key_doubtful),
                ("PgDn, PgUp", text::key_photos),
            ],
        ),
        (
            text::keys_in_photo,
            vec![
                ("← → ↑ ↓", text::key_arrows as Text),
                ("Enter", text::key_enter),
                ("Alt Enter", text::place_freely),
                ("X", text::key_exclude),
                ("Delete", text::remove_observation),
                ("F, 0", text::fit),
                ("1", text::key_one_to_one),
                ("+ −", text::key_zoom),
                ("Space", text::key_pan),
            ],
        ),
        (
            text::keys_in_tables,
            vec![
                ("← → ↑ ↓", text::key_cells as Text),
                ("Shift ↑ ↓", text::key_range),
                ("Ctrl A", text::key_all),
                ("Enter, F2", text::key_edit),
                ("Ctrl D", text::fill_down),
                ("Ctrl C", text::copy),
                ("Ctrl V", text::paste),
                ("Delete", text::delete_rows),
            ],
        ),
    ]
}

#[component]
pub fn Help() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let dialog = NodeRef::<Dialog>::new();
    Effect::new(move |_| {
        let open = desk.window.help.get();
        if let Some(dialog) = dialog.get() {
            if open && !dialog.open() {
                let _ = dialog.show_modal();
            } else if !open && dialog.open() {
                dialog.close();
            }
        }
    });
    view! {
        <dialog class="help" node_ref=dialog aria-labelledby="help-title" on:close=move |_| desk.window.help.set(false)>
            <div class="help-head">
                <h2 id="help-title">{text::keys_title}</h2>
                <button class="button small" type="button" on:click=move |_| desk.window.help.set(false)>{text::close}</button>
            </div>
            <p>{text::keys_note}</p>
            <label class="tick"><input type="checkbox" name="single-keys" prop:checked=move || desk.window.single_keys.get()
                on:change=move |e| desk.set_single_keys(event::checked(&e))/><span>{text::single_keys}</span></label>
            <div class="help-keys" tabindex="0" role="region" aria-label=text::keys_title>
                {all().into_iter().map(|(title, keys)| view! {
                    <section>
                        <h3>{title}</h3>
                        <dl>{keys.into_iter().map(|(key, words)| view! { <dt><kbd>{key}</kbd></dt><dd>{words}</dd> }).collect_view()}</dl>
                    </section>
                }).collect_view()}
            </div>
        </dialog>
    }
}
