//! The papers' experiments and one of our own, a page each: the question, the network, what may be varied, and our figures beside theirs.

mod chart;
mod drawing;
mod inputs;
mod names;
mod outcome;
mod plates;
mod turned;

use leptos::prelude::*;
use sightline_lab::experiments::{Drawing, NAMES, drawings};

use super::components::icon::{Glyph, Icon};
use crate::browser::event;
use crate::format;
use crate::i18n::Text;
use crate::i18n::experiments as words;
use crate::i18n::{inside, text};
use crate::store::inside::Network;
use crate::store::{Desk, JobKind};
use crate::view::components::title::TitleBar;
use drawing::NetworkDrawing;
use inputs::Inputs;
use outcome::Outcome;
use plates::Plates;
use turned::TurnedNetwork;

/// Title, question, source.
fn described(name: &str) -> [Text; 3] {
    match name {
        "kang" => [words::kang, words::kang_question, words::kang_source],
        "film" => [words::film, words::film_question, words::film_source],
        "lee-calibration" => [words::lee_calibration, words::lee_calibration_question, words::lee_source],
        "lee-structure" => [words::lee_structure, words::lee_structure_question, words::lee_source],
        "sensor" => [words::sensor, words::sensor_question, words::sensor_source],
        _ => [words::kim, words::kim_question, words::kim_source],
    }
}

#[component]
pub fn Experiments() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let shown = desk.experiments.shown;
    view! {
        <nav class="tabs" aria-label=words::experiments>
            {NAMES.map(|name| {
                let [title, ..] = described(name);
                view! {
                    <button
                        data-experiment=name
                        aria-current=move || (shown.get() == name).then_some("page")
                        disabled=move || desk.tasks.job.with(|job| job.as_ref().is_some_and(|job| job.kind != JobKind::Experiment))
                        on:click=move |_| desk.show_experiment(name)
                    >
                        {title}
                    </button>
                }
            }).collect_view()}
        </nav>
        {move || view! { <Page name=shown.get()/> }}
    }
}

#[component]
fn Page(name: &'static str) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let [title, question, source] = described(name);
    let current = Memo::new_with_compare(
        move |_| desk.experiments.current(name),
        |a, b| a.as_ref().map(|r| std::ptr::from_ref(&**r)) != b.as_ref().map(|r| std::ptr::from_ref(&**r)),
    );
    let done = Memo::new(move |_| current.with(Option::is_some));
    // The network that is turned, while one is.
    let turned = RwSignal::new(None::<Drawing>);
    let turns = Memo::new(move |_| turned.with(Option::is_some));
    let stale = Memo::new(move |_| !done.get() && desk.experiments.ran(name).is_some());
    view! {
        <TitleBar title=title sentence=Signal::derive(move || question().to_owned())>
            <button class="button run" class:primary=move || !done.get() on:click=move |_| desk.run_experiment()>
                {move || if done.get() { words::run_again() } else { words::run() }}
            </button>
            <Show when=move || done.get()>
                <button class="button" data-action="inside" on:click=move |_| {
                    if let Some(ran) = untrack(|| desk.experiments.current(name)) {
                        desk.open_inside(Network::Experiment(ran));
                    }
                }>{inside::inside}</button>
                <button class="button export" on:click=move |_| desk.export_experiment(None)>{text::export_csv}</button>
                <button class="button primary open" on:click=move |_| desk.open_experiment()>
                    {words::open_as_project} <Glyph icon=Icon::Arrow/>
                </button>
            </Show>
        </TitleBar>
        <main class="experiment">
            <aside class="scroll">
                <h2 class="section-head"><span>{words::vary}</span></h2>
                <Inputs name/>
                <Drawings name turned/>
                <p class="note source">{source}</p>
            </aside>
            <section class="scroll outcome" data-experiment=name>
                <Show when=move || turns.get()><TurnedNetwork drawing=turned/></Show>
                {move || match current.get() {
                    Some(ran) => view! { <Outcome ran/> }.into_any(),
                    None if stale.get() => view! {
                        <p class="note warn"><Glyph icon=Icon::Clock/> " " {words::inputs_changed}</p>
                    }.into_any(),
                    None => view! { <p class="note">{words::not_run_yet}</p> }.into_any(),
                }}
                {(name == "film").then(|| view! { <Plates/> })}
            </section>
        </main>
    }
}

/// The networks as they follow from what is chosen, one at a time.
#[component]
fn Drawings(name: &'static str, turned: RwSignal<Option<Drawing>>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all =
        Memo::new(move |_| -> Vec<Drawing> { drawings(name, &desk.experiments.options(name)).unwrap_or_default() });
    let place = RwSignal::new(0_usize);
    // A new choice shows what was chosen.
    Effect::new(move || {
        all.track();
        place.set(0);
    });
    let ids = Memo::new(move |_| all.with(|all| all.iter().map(|d| d.id.clone()).collect::<Vec<_>>()));
    let shown = Memo::new(move |_| all.with(|all| all.get(place.get()).cloned()));
    let turns = Memo::new(move |_| turned.with(Option::is_some));
    // What is turned follows the choice.
    Effect::new(move || {
        let drawing = shown.get();
        if turned.with_untracked(Option::is_some) {
            turned.set(drawing);
        }
    });
    let photos = move || all.with(|all| all.get(place.get()).map_or(0, |d| d.photos.len()));
    let shown_name = |id: &str| if id == "all" { words::all_photos().to_owned() } else { names::name(id) };
    view! {
        <h2 class="section-head">
            <span>{words::network}</span>
            <span class="aside">{move || text::photo_count(format::count(photos()))}</span>
            <Show when=move || ids.with(|ids| ids.len() > 1)>
                <select
                    aria-label=words::drawing_shown
                    prop:value=move || place.get().to_string()
                    on:change=move |e| place.set(event::value(&e).parse().unwrap_or(0))
                >
                    {move || ids.get().into_iter().enumerate().map(|(i, id)| view! {
                        <option value=i.to_string()>{move || shown_name(&id)}</option>
                    }).collect_view()}
                </select>
            </Show>
        </h2>
        {move || shown.get().map(|drawing| view! { <NetworkDrawing drawing/> })}
        <button class="text-button" data-action="turn" aria-pressed=move || turns.get().to_string()
            on:click=move |_| turned.set(if turned.with_untracked(Option::is_some) { None } else { shown.get_untracked() })>{words::turn}</button>
    }
}
