//! The title bar of a step.

use leptos::prelude::*;

use super::progress::Progress;
use crate::document::Document;
use crate::i18n::{self, experiments as words, monitoring, planning as plan_words, printing as before, text};
use crate::store::{Desk, Step};

/// The title bar of a step with its sentence and the one action slot: progress while there is any, else the action.
#[component]
pub fn TitleBar(
    title: fn() -> &'static str,
    #[prop(into)] sentence: Signal<String>,
    #[prop(optional)] children: Option<Children>,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let busy = Memo::new(move |_| desk.tasks.job.with(Option::is_some));
    let action = children.map(|children| children());
    let beside = Memo::new(move |_| !Step::ROW.contains(&desk.step.get()));
    // A step of the path needs a project, which may have gone meanwhile.
    let back = move || if desk.document.with(Document::is_empty) { Step::Start } else { desk.window.came_from.get() };
    view! {
        <div class="bar" role="region" aria-label=title>
            <Show when=move || beside.get()>
                <button class="link back" data-action="back" on:click=move |_| desk.go(back())>"← " {move || step_label(back())}</button>
            </Show>
            <h1>{title}</h1>
            <p>{move || sentence.get()}</p>
            <div class="slot" class:busy=busy>
                <div class="action">{action}</div>
                <Progress/>
            </div>
        </div>
    }
}

pub fn step_label(step: Step) -> &'static str {
    match step {
        Step::Start => text::start_page(),
        Step::Photos => text::photos(),
        Step::Targets => text::targets(),
        Step::Identities => text::identities(),
        Step::Control => text::control_and_scale(),
        Step::Adjust => text::adjustment(),
        Step::Results => text::results(),
        Step::Object => i18n::object::object(),
        Step::Report => text::report(),
        Step::Experiments => words::experiments(),
        Step::Tables => text::tables(),
        Step::Plan => plan_words::plan(),
        Step::Print => before::targets_to_print(),
        Step::Equipment => i18n::equipment::equipment(),
        Step::Monitoring => monitoring::monitoring(),
        Step::Calibrate => i18n::calibrating::calibrate(),
        Step::Files => i18n::interchange::files_for_others(),
        Step::Inside => i18n::inside::inside(),
    }
}
