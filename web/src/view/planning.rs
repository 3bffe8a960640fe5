//! The plan: object, camera and required accuracy; stations in plan and elevation; predicted accuracy.

mod camera;
mod drawing;
mod frame;
mod inputs;
mod labels;
mod object;
mod print;
mod repeated;
mod stations;
mod verdict;

use std::sync::Arc;

use leptos::prelude::*;
use sightline_plan::Prediction;

use super::components::icon::{Glyph, Icon};
use crate::browser::page;
use crate::document::Change;
use crate::i18n::planning as words;
use crate::store::Desk;
use crate::view::components::title::TitleBar;
use drawing::Views;
use inputs::{Beginnings, Inputs};
use print::ShootingPlan;
use repeated::SecondCampaign;
use stations::{Checklist, Stations};
use verdict::{Compared, Next, Reached, Verdict};

#[component]
pub fn Planning() -> impl IntoView {
    let desk = expect_context::<Desk>();
    Effect::new(move || {
        if let Some(plan) = desk.shown_plan() {
            desk.predict_plan(plan);
        }
    });
    let planned = Memo::new(move |_| desk.document.with(|d| d.project.plan.is_some()));
    view! {
        <TitleBar title=words::plan sentence=Signal::derive(|| words::plan_sentence().to_owned())>
            <Show when=move || planned.get()>
                <button class="button" data-action="print" on:click=move |_| page::print()>{words::print_plan}</button>
                <button class="button" data-action="make" on:click=move |_| desk.make_plan()>{words::make}</button>
                <button class="button primary" data-action="add" on:click=move |_| add(desk)>
                    {words::add_station} <Glyph icon=Icon::Arrow/>
                </button>
            </Show>
        </TitleBar>
        <Show when=move || planned.get() fallback=|| view! { <main class="beginnings"><Beginnings/></main> }>
            <main class="planning">
                <aside class="scroll" aria-label=words::plan><Inputs/></aside>
                <section class="scroll"><Views/></section>
                <aside class="scroll">
                    <Verdict/>
                    <Next/>
                    <Compared/>
                    <SecondCampaign/>
                    <Stations/>
                    <Checklist/>
                    <Reached/>
                </aside>
                <ShootingPlan/>
            </main>
        </Show>
    }
}

fn add(desk: Desk) {
    let Some(plan) = untrack(|| desk.plan()) else { return };
    let id = crate::edit::plan::next_id(&plan);
    desk.edit_plan(Change::StationAdded(id.clone()), |plan| {
        crate::edit::plan::add_station(plan);
    });
    desk.planning.chosen.set(Some(id));
}

/// The prediction of the plan that is shown.
fn predicted(desk: Desk) -> Option<Arc<Prediction>> {
    desk.planning.predicted.with(|p| p.as_ref()?.as_ref().ok()?.first().cloned())
}
