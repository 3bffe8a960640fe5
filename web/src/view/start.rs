//! The page before there is a project.

use leptos::prelude::*;

use super::icon::{Glyph, Icon};
use super::photos::Problems;
use super::projects::Projects;
use super::shell::{Progress, choose_photos, choose_project};
use crate::i18n::{equipment, experiments as words, planning, printing, text};
use crate::store::{Desk, Step};

#[component]
pub fn Start() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <main class="start" class:with-shelf=move || desk.shelf.with(|all| all.as_ref().is_some_and(|all| !all.is_empty())) || desk.bin.with(|bin| !bin.is_empty())>
            <div class="drop-zone">
                <div class="invitation">
                    <Glyph icon=Icon::Drop size=40/>
                    <h1>{text::drop_here}</h1>
                    <p>{text::formats}</p>
                    <div class="row">
                        <button class="button large primary" on:click=move |_| choose_photos(desk)>
                            {text::choose_photos}
                        </button>
                        <button class="button large" on:click=move |_| choose_project(desk)>{text::open_project}</button>
                    </div>
                    <p class="fine">{text::heic_and_raw}</p>
                </div>
                <div class="slot start-slot"><Progress/></div>
                <div role="alert"><Problems/></div>
                <button class="sample" on:click=move |_| desk.open_sample() disabled=move || desk.job.with(Option::is_some)>
                    <span>
                        <b>{text::open_sample}</b>
                        <span>{text::sample_words}</span>
                    </span>
                    <Glyph icon=Icon::Arrow/>
                </button>
                <button class="entry" data-open="plan" on:click=move |_| desk.go(Step::Plan)>
                    <span>
                        <b>{planning::plan}</b>
                        <span>{planning::plan_words}</span>
                    </span>
                    <Glyph icon=Icon::Arrow/>
                </button>
                <button class="entry" data-open="print" on:click=move |_| desk.go(Step::Print)>
                    <span>
                        <b>{printing::targets_to_print}</b>
                        <span>{printing::targets_to_print_words}</span>
                    </span>
                    <Glyph icon=Icon::Arrow/>
                </button>
                <button class="entry" data-open="equipment" on:click=move |_| desk.go(Step::Equipment)>
                    <span>
                        <b>{equipment::equipment}</b>
                        <span>{equipment::equipment_words}</span>
                    </span>
                    <Glyph icon=Icon::Arrow/>
                </button>
                <button class="experiments-entry" on:click=move |_| desk.show_experiment(desk.experiments.shown.get_untracked())>
                    <span>
                        <b>{words::experiments}</b>
                        <span>{words::experiments_words}</span>
                    </span>
                    <Glyph icon=Icon::Arrow/>
                </button>
                <button class="link wipe" on:click=move |_| desk.wipe()>{text::wipe}</button>
            </div>
            <Projects/>
        </main>
    }
}
