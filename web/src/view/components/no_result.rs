//! Where numbers would stand while there is no result, or one of an earlier state of the project.

use leptos::prelude::*;

use super::changes::change_words;
use super::icon::{Glyph, Icon};
use crate::i18n::text;
use crate::store::{Desk, Step};

/// Why there are no numbers: no result yet, or an earlier one.
#[component]
pub fn NoNumbers() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let any = Memo::new(move |_| desk.document.with(|d| d.result.is_some()));
    view! {
        <Show when=move || any.get() fallback=|| view! { <NoResult/> }><OutOfDate/></Show>
    }
}

#[component]
pub fn NoResult() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <main class="out-of-date">
            <h1>{text::no_result}</h1>
            <p>{text::no_result_body}</p>
            <button class="button primary" on:click=move |_| desk.go(Step::Adjust)>{text::adjustment} <Glyph icon=Icon::Arrow/></button>
        </main>
    }
}

#[component]
pub fn OutOfDate() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let changes = move || {
        let changes = desk.changes_since_result();
        let words = changes.iter().rev().take(4).map(change_words).collect::<Vec<_>>();
        words.join("; ")
    };
    view! {
        <main class="out-of-date">
            <Glyph icon=Icon::Clock size=24/>
            <h1>{text::results_stale}</h1>
            <p>{text::changed_since} " " {changes} ". " {text::no_number_until}</p>
            <div class="row">
                <button class="button primary" on:click=move |_| desk.adjust()>{text::adjust_again}</button>
                <button class="button" on:click=move |_| desk.undo()><Glyph icon=Icon::Undo/> {text::undo}</button>
            </div>
        </main>
    }
}
