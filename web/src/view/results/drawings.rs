//! The plots of the result, as the report prints them, in the colours of the desk.

use leptos::html::Div;
use leptos::prelude::*;
use sightline::report::plots::Plot;

use crate::browser::paper;
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
            {move || plots().into_iter().map(|plot| view! { <Drawing plot/> }).collect_view()}
        </main>
    }
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
    let (title, sentence, small) = (plot.title.clone(), plot.sentence.clone(), plot.small);
    let kept = StoredValue::new(plot);
    view! {
        <figure class:small=small>
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
