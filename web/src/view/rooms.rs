//! What the window shows below its head: the start page, which is there from the beginning, or the room of a step, whose part of the
//! module comes as soon as the window stands, or, for what lies beside the path, when it is asked for.

use std::future::Future;
use std::pin::pin;
use std::task::{Context, Poll, Waker};

use leptos::prelude::*;
use leptos::task::spawn_local;

use super::start::Start;
use super::{
    adjust, calibrating, control, distance_sheet, equipment, experiments, files, identities, import, inside,
    monitoring, object, photos, planning, printing, report, results, tables, targets,
};
use crate::browser::worker;
use crate::i18n::text;
use crate::parts::{Absent, part};
use crate::store::{Desk, Step};

part! { steps, fn on_the_path(step: Step) -> AnyView, fetched by fetch_steps, {
    match step {
        Step::Photos => view! { <photos::Photos/> }.into_any(),
        Step::Targets => view! { <targets::Targets/> }.into_any(),
        Step::Identities => view! { <identities::Identities/> }.into_any(),
        Step::Control => view! { <control::Control/> }.into_any(),
        Step::Adjust => view! { <adjust::Adjust/> }.into_any(),
        _ => view! { <results::Results/> }.into_any(),
    }
} }

part! { beside, fn beside_the_path(step: Step) -> AnyView, fetched by fetch_beside, {
    match step {
        Step::Object => view! { <object::Object/> }.into_any(),
        Step::Experiments => view! { <experiments::Experiments/> }.into_any(),
        Step::Tables => view! { <tables::Tables/> }.into_any(),
        Step::Plan => view! { <planning::Planning/> }.into_any(),
        Step::Print => view! { <printing::Printing/> }.into_any(),
        Step::Equipment => view! { <equipment::Equipment/> }.into_any(),
        Step::Monitoring => view! { <monitoring::Monitoring/> }.into_any(),
        Step::Calibrate => view! { <calibrating::Calibrate/> }.into_any(),
        Step::Files => view! { <files::Files/> }.into_any(),
        Step::Inside => view! { <inside::Inside/> }.into_any(),
        _ => view! { <report::Report/> }.into_any(),
    }
} }

part! { steps, fn import_over() -> AnyView, {
    view! { <import::ImportOver/> }.into_any()
} }

part! { steps, fn distances_over() -> AnyView, {
    view! { <distance_sheet::DistancesOver/> }.into_any()
} }

/// A part of the page's module that is loaded after the first.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ModulePart {
    Steps,
    Beside,
}

impl ModulePart {
    /// Of a step's room; the start page is there from the beginning.
    fn of(step: Step) -> Option<Self> {
        match step {
            Step::Start => None,
            Step::Photos | Step::Targets | Step::Identities | Step::Control | Step::Adjust | Step::Results => {
                Some(Self::Steps)
            }
            Step::Object
            | Step::Report
            | Step::Experiments
            | Step::Tables
            | Step::Plan
            | Step::Print
            | Step::Equipment
            | Step::Monitoring
            | Step::Calibrate
            | Step::Files
            | Step::Inside => Some(Self::Beside),
        }
    }
}

/// Whether a part has been loaded.
#[derive(Clone, Copy, PartialEq, Eq)]
enum LoadState {
    Unasked,
    Coming,
    There,
    Failed,
}

/// The room of the step that is shown.
#[component]
pub fn Rooms() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let states = [RwSignal::new(LoadState::Unasked), RwSignal::new(LoadState::Unasked)];
    let ask = move |part: ModulePart| {
        let state = states[part as usize];
        if matches!(state.get_untracked(), LoadState::Coming | LoadState::There) {
            return;
        }
        state.set(LoadState::Coming);
        spawn_local(async move {
            let came = match part {
                ModulePart::Steps => fetch_steps().await,
                ModulePart::Beside => fetch_beside().await,
            };
            state.set(if came.is_ok() { LoadState::There } else { LoadState::Failed });
            if came.is_err() {
                desk.look_for_another_build();
            }
        });
    };
    let wanted = Memo::new(move |_| ModulePart::of(desk.step.get()));
    // The next that is needed, while nothing is done yet; and when all else is there, the rest: the page goes on without a network.
    ask(ModulePart::Steps);
    spawn_local(async move {
        worker::engine_is_there().await;
        ask(ModulePart::Beside);
    });
    Effect::new(move || {
        if let Some(part) = wanted.get() {
            ask(part);
        }
    });
    // A list is answered on whatever step it came to; on that of control points it stands among the tables.
    let waits = Memo::new(move |_| {
        let here = desk.step.get();
        let at = |step: Option<Step>| here != Step::Control && step == Some(here);
        [
            at(desk.intake.pasted.with(|p| p.as_ref().map(|p| p.at))),
            at(desk.intake.distances.with(|d| d.as_ref().map(|d| d.at))),
        ]
    });
    let over = move || {
        let there = states[ModulePart::Steps as usize].get() == LoadState::There;
        let [points, distances] = waits.get();
        there.then(|| (points.then(|| at_once(import_over())), distances.then(|| at_once(distances_over()))))
    };
    Effect::new(move || desk.show_next_list());
    let room = move || {
        let step = desk.step.get();
        if desk.persistence.returning.with(Option::is_some) {
            return view! { <main class="absent" aria-busy="true"></main> }.into_any();
        }
        let Some(part) = ModulePart::of(step) else { return view! { <Start/> }.into_any() };
        match states[part as usize].get() {
            LoadState::There => match part {
                ModulePart::Steps => at_once(on_the_path(step)),
                ModulePart::Beside => at_once(beside_the_path(step)),
            },
            LoadState::Failed => view! {
                <main class="absent" role="alert">
                    <p>{text::part_did_not_come}</p>
                    <button class="button primary" on:click=move |_| ask(part)>{text::try_again}</button>
                </main>
            }
            .into_any(),
            LoadState::Unasked | LoadState::Coming => {
                view! { <main class="absent" aria-busy="true"></main> }.into_any()
            }
        }
    };
    view! { {room}{over} }
}

/// The room of a part that is there: nothing is waited for.
fn at_once(room: impl Future<Output = Result<AnyView, Absent>>) -> AnyView {
    match pin!(room).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(Ok(view)) => view,
        _ => ().into_any(),
    }
}
