//! The steps of an adjustment: back, forward, all, and their results.

use leptos::prelude::*;
use sightline::adjustment::Termination;

use super::number;
use crate::browser::event;
use crate::format;
use crate::i18n::{inside as words, text};
use crate::store::Desk;

/// Shares of the object's size by which start values can be moved.
const MOVED: [f64; 6] = [0.0, 0.001, 0.01, 0.03, 0.1, 0.3];

#[component]
pub fn Iterations() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    let ended = Memo::new(move |_| {
        let step = inside.step.get();
        inside.steps.with(|steps| steps.get(step).and_then(|looked| looked.state.termination))
    });
    let first = Memo::new(move |_| inside.step.get() == 0);
    let ending = move || match ended.get() {
        None => None,
        Some(Termination::Converged) => Some((text::converged(), false)),
        Some(Termination::IterationLimit) => Some((text::iteration_limit(), true)),
        Some(Termination::Diverged) => Some((text::diverged(), true)),
        Some(Termination::Stopped) => Some((text::stopped(), true)),
    };
    let strip = move || {
        let now = inside.step.get();
        let unit = inside.unit();
        let all = inside.steps.get().into_iter().enumerate().map(|(k, looked)| {
            let state = &looked.state;
            let sigma0 = state.sigma0.map_or("–".to_owned(), number);
            let step = state.iteration.as_ref().map(|iteration| words::step_of(number(iteration.step), &unit));
            let damped = state.iteration.as_ref().is_some_and(|iteration| iteration.damping > 0.0);
            view! {
                <li class:now=k == now data-step-number=k.to_string()>
                    <button aria-current=(k == now).then_some("step") on:click=move |_| desk.look_inside(k)>
                        <span class="number">{k}</span>
                        <span>"σ₀ "<b>{sigma0}</b></span>
                        <span>"vᵀPv "{number(state.weighted_squares)}</span>
                        <span>{step.unwrap_or_else(|| words::start_values().to_owned())}{damped.then(|| format!(", {}", text::damping()))}</span>
                    </button>
                </li>
            }
        });
        all.collect_view()
    };
    view! {
        <footer class="steps-taken" role="region" aria-label=text::iterations>
            <div class="row">
                <button class="button" data-action="step-back" disabled=first on:click=move |_| desk.look_inside(inside.step.get_untracked().saturating_sub(1))>"← " {words::back}</button>
                <button class="button primary" data-action="step" disabled=move || ended.get().is_some() || inside.waiting.get()
                    on:click=move |_| desk.look_inside(inside.step.get_untracked() + 1)>{words::step} " →"</button>
                <button class="button" data-action="run" disabled=move || ended.get().is_some() || inside.waiting.get() on:click=move |_| desk.run_inside_to(usize::MAX)>{words::run_all}</button>
                <label class="option"><span>{words::start_moved}</span>
                    <select name="moved" on:change=move |e| {
                        inside.moved.set(event::value(&e).parse().unwrap_or(0.0));
                        desk.begin_inside();
                    }>
                        {MOVED.map(|share| view! { <option value=share.to_string() prop:selected=move || inside.moved.get() == share>{format::fixed(100.0 * share, 1)} " %"</option> }).collect_view()}
                    </select></label>
            </div>
            <ol class="scroll">{strip}</ol>
            {move || ending().map(|(said, bad)| view! { <p class="note" class:warn=bad data-ended="">{said}</p> })}
        </footer>
    }
}
