//! A plot as the report prints it, in the colours of the desk.

use leptos::html::Div;
use leptos::prelude::*;
use sightline_report::plots::Plot;

use crate::browser::paper;
use crate::i18n::text;
use crate::store::Desk;

/// Position of a plot in the page.
pub fn place(name: &str) -> String {
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
            paper::draw(&host, sightline_report::plots::STYLE, &svg);
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
