//! The plots of the result, as the report prints them, in the colours of the desk.

use leptos::html::Div;
use leptos::prelude::*;
use sightline::report::plots::Plot;

use crate::browser::{page, paper};
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

/// Where a plot stands in the page.
fn place(name: &str) -> String {
    format!("plot-{name}")
}

/// A plot with its title, its sentence and its file.
#[component]
pub fn Drawing(plot: Plot) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let host = NodeRef::<Div>::new();
    let svg = plot.svg.clone();
    Effect::new(move || {
        if let Some(host) = host.get() {
            paper::draw(&host, sightline::report::plots::STYLE, &svg);
        }
    });
    let (title, sentence, small, id) = (plot.title.clone(), plot.sentence.clone(), plot.small, place(&plot.name));
    let kept = StoredValue::new(plot);
    view! {
        <figure class:small=small id=id tabindex="-1">
            <figcaption>
                <h2 class="section-head"><span>{title}</span>
                    <button class="link" on:click=move |_| kept.with_value(|plot| desk.save_plot(plot))>{text::save_svg}</button>
                </h2>
                <p class="note">{sentence}</p>
            </figcaption>
            <div class="drawing" node_ref=host></div>
        </figure>
    }
}
