//! The plots of the result, as the report prints them, in the colours of the desk.

use crate::view::components::drawing::{Drawing, place};
use leptos::prelude::*;

use crate::browser::page;
use crate::i18n::text;
use crate::store::Desk;

#[component]
pub(super) fn Drawings() -> impl IntoView {
    let desk = expect_context::<Desk>();
    Effect::new(move || desk.make_plots());
    let plots = move || desk.reports.plots.get();
    view! {
        <main class="drawings scroll" tabindex="0" aria-label=text::plots data-ready=move || (!plots().is_empty()).to_string()>
            <Show when=move || desk.reports.plots.with(Vec::is_empty)>
                <p class="note" role="status">{text::drawing_plots}</p>
            </Show>
            <nav class="plot-index" aria-label=text::plots>
                {move || {
                    // Photos have one entry: theirs are alike, and last.
                    let all = plots();
                    let first_small = all.iter().position(|plot| plot.small);
                    let listed = all.iter().enumerate().filter(move |(k, plot)| !plot.small || Some(*k) == first_small);
                    listed.map(|(_, plot)| {
                        let id = place(&plot.name);
                        let title = if plot.small { text::residuals_of_photos().to_owned() } else { plot.title.clone() };
                        view! { <button class="link" on:click=move |_| page::focus_id(&id)>{title}</button> }
                    }).collect_view()
                }}
            </nav>
            {move || plots().into_iter().map(|plot| view! { <Drawing plot/> }).collect_view()}
        </main>
    }
}
