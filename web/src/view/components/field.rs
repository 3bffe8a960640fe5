//! An input field whose value is accepted or refused; after a refusal the last valid value is restored.

use leptos::html::Input;
use leptos::prelude::*;

use crate::browser::event;

/// A text field showing `value`. `commit` gets the typed text and reports itself what it refuses; the field then shows what
/// the document holds. Escape takes back what is being typed.
#[component]
pub fn Field(#[prop(into)] value: Signal<String>, #[prop(into)] commit: Callback<String>) -> impl IntoView {
    let input = NodeRef::<Input>::new();
    // What is typed may take the field itself away, and its signals with it.
    let restore = move || {
        if let (Some(input), Some(value)) = (input.try_get_untracked().flatten(), value.try_get_untracked()) {
            input.set_value(&value);
        }
    };
    view! {
        <input type="text" autocomplete="off" node_ref=input prop:value=value
            on:change=move |e| {
                commit.run(event::value(&e));
                restore();
            }
            on:keydown=move |e| if event::key(&e).key == "Escape" {
                e.stop_propagation();
                restore();
            }/>
    }
}
