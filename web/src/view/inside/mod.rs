//! The page "Inside the adjustment": matrices and steps, datum, errors and weights.

mod datum;
mod equation;
mod errors;
mod iterations;
mod lesson;
mod matrices;
mod movement;
mod painting;
mod picture;
mod transformed;
mod unknowns;
mod weights;

use leptos::prelude::*;

use crate::browser::event;
use crate::format;
use crate::i18n::{Text, inside as words};
use crate::store::Desk;
use crate::store::inside::{Network, Tab};
use crate::view::components::title::TitleBar;

use datum::Datum;
use errors::Errors;
use lesson::Lessons;
use matrices::Matrices;
use weights::Weights;

const TABS: [(Tab, &str, Text); 4] = [
    (Tab::Matrices, "matrices", words::equations),
    (Tab::Datum, "datum", words::datum),
    (Tab::Errors, "errors", words::errors),
    (Tab::Weights, "weights", words::weights),
];

#[component]
pub fn Inside() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    desk.ready_inside();
    desk.follow_lesson_in_address();
    let sentence = move || match inside.looked() {
        Some(looked) => {
            let (rows, columns) = (looked.observations().len(), looked.unknowns().len());
            words::sentence(format::count(rows), format::count(columns), format::count(looked.system.redundancy))
        }
        None => words::sentence_before().to_owned(),
    };
    view! {
        <TitleBar title=words::inside sentence=Memo::new(move |_| sentence())>
            <Networks/>
            <button class="button" data-action="export-inside" on:click=move |_| desk.export_inside()>{words::save_matrices}</button>
        </TitleBar>
        <nav class="tabs" aria-label=words::inside>
            {TABS.map(|(tab, name, title)| view! {
                <button data-inside=name aria-current=move || (inside.tab.get() == tab).then_some("page")
                    on:click=move |_| inside.tab.set(tab)>{title}</button>
            }).collect_view()}
            <button class="lessons" data-inside="lessons" aria-pressed=move || desk.lessons.shown.get().to_string()
                on:click=move |_| desk.show_lessons(!desk.lessons.shown.get_untracked())>{words::lessons}</button>
        </nav>
        <div class="with-lesson">
            <Show when=move || desk.lessons.shown.get()><Lessons/></Show>
            {move || match inside.tab.get() {
                Tab::Matrices => view! { <Matrices/> }.into_any(),
                Tab::Datum => view! { <Datum/> }.into_any(),
                Tab::Errors => view! { <Errors/> }.into_any(),
                Tab::Weights => view! { <Weights/> }.into_any(),
            }}
        </div>
    }
}

/// Which network is laid open.
#[component]
fn Networks() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    let project = Memo::new(move |_| desk.document.with(|d| !d.is_empty()));
    let ran = Memo::new_with_compare(
        move |_| {
            inside.network.with(|network| if let Network::Experiment(ran) = network { Some(ran.clone()) } else { None })
        },
        |a, b| a.is_some() != b.is_some(),
    );
    let now = move || match inside.network.get() {
        Network::Lab => "lab",
        Network::Document => "document",
        Network::Experiment(_) => "experiment",
        Network::Lesson(_) => "lesson",
    };
    view! {
        <label class="inside-network">
            <span class="visually-hidden">{words::network}</span>
            <select name="network" on:change=move |e| match event::value(&e).as_str() {
                "document" => desk.open_inside(Network::Document),
                "lab" => desk.open_inside(Network::Lab),
                _ => {}
            }>
                <Show when=move || now() == "lesson"><option value="lesson" prop:selected=true>{words::of_the_lesson}</option></Show>
                <option value="lab" prop:selected=move || now() == "lab">{words::lab}</option>
                <Show when=move || project.get()><option value="document" prop:selected=move || now() == "document">{words::this_project}</option></Show>
                <Show when=move || ran.with(Option::is_some)>
                    <option value="experiment" prop:selected=move || now() == "experiment">{move || ran.with(|ran| ran.as_ref().map(|ran| ran.experiment.project.name.clone()))}</option>
                </Show>
            </select>
        </label>
    }
}

/// Placeholder while no matrices are shown.
#[component]
pub fn NothingYet() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! { <p class="note">{move || if desk.inside.waiting.get() { words::computing() } else { words::nothing() }}</p> }
}

/// A number with five digits that count.
pub fn number(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format::compact(value) }
}
