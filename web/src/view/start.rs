//! The start page.

use leptos::prelude::*;

use super::components::icon::{Glyph, Icon};
use super::photos::Problems;
use super::picture::Purpose;
use super::projects::Projects;
use crate::i18n::{Text, calibrating, equipment, experiments as words, first, monitoring, planning, printing, text};
use crate::store::{Desk, Step};
use crate::view::components::choosing::choose_photos;
use crate::view::components::choosing::choose_project;
use crate::view::components::progress::Progress;

#[component]
pub fn Start() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let busy = move || desk.tasks.job.with(Option::is_some);
    view! {
        <main class="start">
            <div class="drop-zone">
                <div class="invitation">
                    <h1>{first::purpose}</h1>
                    <p>{first::drop_photos}</p>
                    <Purpose/>
                    <div class="row">
                        <button class="button large primary" data-action="new-project" disabled=busy on:click=move |_| desk.new_project()>{first::new_project}</button>
                        <button class="button large" on:click=move |_| choose_photos(desk)>{text::choose_photos}</button>
                        <button class="button large" on:click=move |_| choose_project(desk)>{text::open_project}</button>
                    </div>
                    <p class="fine">{text::formats}</p>
                </div>
                <div class="slot start-slot"><Progress/></div>
                <div role="alert"><Problems/></div>
            </div>
            <div class="start-lists">
                <Projects/>
                <section class="entries" aria-labelledby="begin-without">
                    <h2 id="begin-without">{first::without_photos}</h2>
                    <Entry class="sample" open="sample" name=text::open_sample said=text::sample_words waits=true go=|desk| desk.open_sample()/>
                    <Entry open="plan" name=planning::plan said=planning::plan_words go=|desk| desk.go(Step::Plan)/>
                    <Entry open="calibrate" name=calibrating::calibrate said=calibrating::calibrate_words waits=true go=|desk| desk.calibrate_anew()/>
                    <Entry open="print" name=printing::targets_to_print said=printing::targets_to_print_words go=|desk| desk.go(Step::Print)/>
                    <Entry open="equipment" name=equipment::equipment said=equipment::equipment_words go=|desk| desk.go(Step::Equipment)/>
                    <Entry open="monitoring" name=monitoring::monitoring said=monitoring::monitoring_words go=|desk| desk.show_monitoring()/>
                    <Entry open="sample-epochs" name=monitoring::sample said=monitoring::sample_words waits=true go=|desk| desk.open_sample_epochs()/>
                    <Entry class="entry experiments-entry" open="experiments" name=first::papers said=words::experiments_words
                        go=|desk| desk.show_experiment(desk.experiments.shown.get_untracked())/>
                </section>
                <p class="start-links">
                    <a class="link licences" href="THIRD-PARTY.txt" target="_blank" rel="noopener">{text::licences}</a>
                    <button class="link wipe" on:click=move |_| desk.wipe()>{text::wipe}</button>
                </p>
            </div>
        </main>
    }
}

/// A way to something that needs no photos.
#[component]
fn Entry(
    #[prop(default = "entry")] class: &'static str,
    open: &'static str,
    name: Text,
    said: Text,
    /// Whether other work has to be done first.
    #[prop(optional)]
    waits: bool,
    go: fn(Desk),
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <button class=class data-open=open disabled=move || waits && desk.tasks.job.with(Option::is_some) on:click=move |_| go(desk)>
            <span>
                <b>{name}</b>
                <span>{said}</span>
            </span>
            <Glyph icon=Icon::Arrow/>
        </button>
    }
}
