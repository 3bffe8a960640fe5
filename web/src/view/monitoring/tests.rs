//! Epochs, tests and notes: why the verdict is what it is.

use leptos::prelude::*;
use sightline::monitoring::{Outcome, Test};

use super::words::{basis, counts, epoch_notes, notes, p_words};
use crate::format;
use crate::i18n::{monitoring as words, name_list};
use crate::store::Desk;
use crate::view::components::icon::{Glyph, Icon};

/// The epochs; choosing one shows it against the first.
#[component]
pub fn Epochs() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    let rows = move || {
        let ran = monitored.current()?;
        let found = &ran.found;
        let shown = monitored.later.get();
        let rows = found.epochs.iter().enumerate().map(|(k, epoch)| {
            let against = match k.checked_sub(1).and_then(|pair| found.pairs.get(pair)) {
                None => view! { <span>{words::is_reference}</span> }.into_any(),
                Some(pair) if pair.outcome == Outcome::NoStableGroup => view! { <span class="bad">{words::no_statement}</span> }.into_any(),
                Some(pair) => match counts(pair).0 + pair.unstable.len() {
                    0 => view! { <span>{words::none_moved}</span> }.into_any(),
                    n => view! { <b class="warn">{words::n_moved(n)}</b> }.into_any(),
                },
            };
            let is_shown = k > 0 && shown == k;
            let choose = move |_| if k > 0 { monitored.later.set(k) };
            let date = epoch.date.clone().unwrap_or_default();
            view! {
                <tr class:chosen=is_shown data-epoch=k.to_string()>
                    <td><b>{k}</b></td>
                    <td class="left name"><button class="link" disabled=k == 0 on:click=choose aria-pressed=(shown == k).to_string()>{epoch.name.clone()}</button><small>{date}</small></td>
                    <td>{format::count(epoch.points)}</td>
                    <td>{format::maybe(epoch.sigma0, 3)}</td>
                    <td class="left">{against}</td>
                </tr>
            }
        });
        Some(rows.collect_view())
    };
    view! {
        <h2 class="section-head"><span>{words::epochs}</span></h2>
        <table class="table epoch-rows">
            <thead><tr><th>{words::number}</th><th class="left">{words::name}</th><th>{words::points}</th><th>"σ₀"</th><th class="left">{words::against_first}</th></tr></thead>
            <tbody>{rows}</tbody>
        </table>
    }
}

fn cells(test: &Test) -> impl IntoView + use<> {
    view! {
        <td><b>{format::fixed(test.statistic, 2)}</b></td>
        <td>{format::fixed(test.limit, 2)}</td>
        <td>{format::editable((10.0 * test.f1).round() / 10.0)}</td>
        <td>{test.f2.map_or("∞".to_owned(), |f| format::count(f.round() as usize))}</td>
        <td>{p_words(test.p)}</td>
        <td class=if test.passed { "pass" } else { "bad" }>
            <Glyph icon=if test.passed { Icon::Check } else { Icon::Cross } size=12/>
            <span class="visually-hidden">{if test.passed { words::passed() } else { words::failed() }}</span>
        </td>
    }
}

/// Variance factors, scale, congruence with every step of the elimination, second opinion.
#[component]
pub fn Tests() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    move || {
        let (ran, (_, pair)) = monitored.current().zip(monitored.pair())?;
        let alpha = monitored.options.with(|o| format::editable((1e6 * o.significance).round() / 1e4));
        let row = |key: &'static str, name: String, test: &Test| view! { <tr data-test=key><td class="left">{name}</td>{cells(test)}</tr> };
        let variance = pair.variance_test.as_ref().map(|test| row("variance", words::variance_test().to_owned(), test));
        let scale = pair.scale.as_ref().map(|scale| {
            let ppm = |value: f64| format::fixed(1e6 * value, 1);
            row("scale", words::scale_test(ppm(scale.value - 1.0), ppm(scale.sigma)), &scale.test)
        });
        let all = pair.stable.len() + pair.unstable.len();
        let global = pair.global_test.as_ref().map(|test| row("global", words::congruence_all(all), test));
        let steps = pair
            .steps
            .iter()
            .map(|step| row("step", words::congruence_without(&step.removed), &step.test))
            .collect_view();
        let largest = pair.steps.iter().map(|step| step.contribution).fold(0.0, f64::max);
        let bars = pair.steps.iter().map(|step| {
            let share = if largest > 0.0 { 100.0 * step.contribution / largest } else { 0.0 };
            view! {
                <li><b class="bad">{step.removed.clone()}</b><span>{format::fixed(step.contribution, 1)}</span>
                    <i aria-hidden="true" style:width=format!("{share:.0}%")></i><span>{format::fixed(step.test.statistic, 2)}</span></li>
            }
        });
        let bars = bars.collect_view();
        let robust = match pair.robust_datum.unstable.as_slice() {
            [] => words::all_stable().to_owned(),
            names => words::unstable_are(name_list(names)),
        };
        let eliminated = !pair.steps.is_empty();
        Some(view! {
            <h2 class="section-head"><span>{words::tests}</span><span class="aside">{words::level(alpha)}</span></h2>
            <table class="table tests-of-pair">
                <thead><tr><th class="left">{words::test}</th><th>"T"</th><th>{words::limit}</th><th>"f₁"</th><th>"f₂"</th><th>"p"</th><td></td></tr></thead>
                <tbody>{variance}{scale}{global}{steps}</tbody>
            </table>
            <p class="hint">{basis(&ran.found, &pair)}</p>
            {eliminated.then(|| view! {
                <h2 class="section-head"><span>{words::elimination}</span><span class="aside">{words::elimination_aside}</span></h2>
                <ol class="elimination">{bars}</ol>
            })}
            <h2 class="section-head"><span>{words::second_opinion}</span><span class="aside">{words::second_opinion_aside}</span></h2>
            <p class="hint" data-found="second">{robust}</p>
        })
    }
}

/// Note for the reader.
#[component]
pub fn Notes() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    move || {
        let (ran, (_, pair)) = monitored.current().zip(monitored.pair())?;
        let warnings = notes(&pair)
            .into_iter()
            .map(|words| view! { <li class="warn"><Glyph icon=Icon::Warning size=14/> <span>{words}</span></li> });
        let assumed = epoch_notes(&ran.found, &pair).into_iter().map(|words| view! { <li><span>{words}</span></li> });
        let (warnings, assumed) = (warnings.collect_view(), assumed.collect_view());
        (!warnings.is_empty() || !assumed.is_empty()).then(|| {
            view! {
                <h2 class="section-head"><span>{words::notes}</span></h2>
                <ul class="pair-notes" data-found="notes">{warnings}{assumed}</ul>
            }
        })
    }
}
