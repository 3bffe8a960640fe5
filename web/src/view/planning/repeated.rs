//! Before a monitoring: the displacements that a second campaign like the plan will be able to show.

use leptos::prelude::*;
use sightline::monitoring::{Detectable, ReferenceFrom};
use sightline_plan::{Prediction, Repeated};

use super::predicted;
use crate::format;
use crate::i18n::monitoring;
use crate::i18n::planning::{self as words, Words};
use crate::i18n::text;
use crate::i18n::{Language, language};
use crate::store::Desk;

/// Points in the table at most; the others are one click away.
const SHOWN: usize = 12;

/// Lengths of a table, with the decimals of the smallest.
fn lengths(all: &[(String, bool, Detectable)]) -> impl Fn(Option<f64>) -> String + use<> {
    let least = all.iter().map(|(_, _, d)| d.worst).fold(f64::INFINITY, f64::min);
    let decimals = format::decimals_for(least);
    move |value| value.map_or_else(|| "–".to_owned(), |value| format::fixed(value, decimals))
}

fn from_words(words: &dyn Words, from: ReferenceFrom, count: usize) -> String {
    let count = format::count(count);
    match from {
        ReferenceFrom::Control => words.second_control(&count),
        ReferenceFrom::Datum => words.second_datum(&count),
        _ => words.second_all(&count),
    }
}

/// Reference points and the largest of the smallest detectable displacements.
fn sentences(words: &dyn Words, repeated: &Repeated, length: impl Fn(Option<f64>) -> String, unit: &str) -> String {
    let percent = |share: f64| format::editable((1e5 * share).round() / 1e3);
    let largest = repeated.point.as_ref().zip(repeated.largest).map(|(point, worst)| {
        let (power, level) = (percent(repeated.power), percent(repeated.significance));
        words.second_largest(point, &length(Some(worst)), &unit, &power, &level)
    });
    let from = from_words(words, repeated.reference_from, repeated.reference.len());
    [Some(from), largest].into_iter().flatten().collect::<Vec<_>>().join(" ")
}

/// Points with a smallest detectable displacement, whether they are reference points, the largest first.
fn rows(prediction: &Prediction, repeated: &Repeated) -> Vec<(String, bool, Detectable)> {
    let is_reference = |id: &String| repeated.reference.contains(id);
    let mut rows: Vec<(String, bool, Detectable)> =
        (prediction.points.iter()).filter_map(|p| Some((p.id.clone(), is_reference(&p.id), p.detectable?))).collect();
    rows.sort_by(|a, b| b.2.worst.total_cmp(&a.2.worst));
    rows
}

fn found(desk: Desk, all: RwSignal<bool>, prediction: &Prediction, repeated: &Repeated) -> impl IntoView + use<> {
    let unit = desk.document.with(|d| d.project.unit.clone());
    let rows = rows(prediction, repeated);
    let length = lengths(&rows);
    let said = sentences(words::words(language()), repeated, &length, &unit);
    let axes = desk.axes();
    let [first, second, third] = axes.names();
    let count = rows.len();
    let shown = if all.get() { count } else { SHOWN };
    let body = rows.into_iter().take(shown).map(|(id, reference, found)| {
        let [x, y, z] = axes.shown(found.axes).map(&length);
        view! {
            <tr data-detectable=id.clone()>
                <td class="left id">{id.clone()}</td><td class="left">{reference.then(monitoring::legend_reference)}</td>
                <td>{x}</td><td>{y}</td><td>{z}</td><td><b>{length(Some(found.worst))}</b></td>
            </tr>
        }
    });
    view! {
        <p class="note" data-second="words">{said}</p>
        <div class="scroll-x" tabindex="0" role="region" aria-label=words::second>
            <table class="table detectable">
                <thead><tr>
                    <th class="left">{text::id}</th><td></td><th>{first} " " {unit.clone()}</th><th>{second}</th><th>{third}</th>
                    <th>{words::second_least}</th>
                </tr></thead>
                <tbody>{body.collect_view()}</tbody>
            </table>
        </div>
        {(count > SHOWN && !all.get()).then(|| view! {
            <button class="link" data-action="all-detectable" on:click=move |_| all.set(true)>{words::second_show_all(format::count(count))}</button>
        })}
    }
}

#[component]
pub fn SecondCampaign() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = RwSignal::new(false);
    let told = move || {
        let prediction = predicted(desk)?;
        // Without a determined network the verdict lists what is missing.
        prediction.redundancy?;
        Some(match &prediction.repeated {
            Some(repeated) => found(desk, all, &prediction, repeated).into_any(),
            None => view! { <p class="note">{words::second_none}</p> }.into_any(),
        })
    };
    view! {
        <h2 class="section-head"><span>{words::second}</span><span class="aside">{words::second_aside}</span></h2>
        {told}
    }
}

/// Says a phrase in every language.
type InAll = fn(fn(&dyn Words) -> &'static str) -> String;

/// The same on the printed shooting plan: every point, sentences in every language.
pub fn on_paper(desk: Desk, prediction: &Prediction, in_all: InAll) -> AnyView {
    let Some(repeated) = prediction.redundancy.and(prediction.repeated.as_ref()) else { return ().into_any() };
    let unit = desk.document.with(|d| d.project.unit.clone());
    let rows = rows(prediction, repeated);
    let length = lengths(&rows);
    let axes = desk.axes();
    let said = Language::ALL.map(|language| sentences(words::words(language), repeated, &length, &unit));
    let body = rows.into_iter().map(|(id, reference, found)| {
        let [x, y, z] = axes.shown(found.axes).map(&length);
        view! {
            <tr data-printed-detectable=id.clone()>
                <td>{id.clone()} {reference.then_some(" ▲")}</td><td>{x}</td><td>{y}</td><td>{z}</td><td>{length(Some(found.worst))}</td>
            </tr>
        }
    });
    view! {
        <h2>{in_all(|w| w.second())} ": " {in_all(|w| w.second_aside())} ", " {unit.clone()}</h2>
        {said.map(|said| view! { <p>{said}</p> }).collect_view()}
        <p>"▲ " {in_all(|w| w.second_reference())}</p>
        <div class="in-columns"><table>
            <thead><tr>
                <th>{in_all(|w| w.number())}</th>{axes.names().map(|axis| view! { <th>{axis}</th> }).collect_view()}
                <th>{in_all(|w| w.second_least())}</th>
            </tr></thead>
            <tbody>{body.collect_view()}</tbody>
        </table></div>
    }
    .into_any()
}
