//! Before a monitoring: the displacements that a second campaign like the plan will be able to show.

use leptos::prelude::*;
use sightline::monitoring::{Detectable, ReferenceFrom};
use sightline::plan::{Prediction, Repeated};

use super::predicted;
use crate::format;
use crate::i18n::monitoring;
use crate::i18n::planning as words;
use crate::i18n::text;
use crate::store::Desk;

/// Points in the table at most; the others are one click away.
const SHOWN: usize = 12;

/// Lengths of a table, with as many decimals as the smallest asks for.
fn lengths(all: &[(String, bool, Detectable)]) -> impl Fn(Option<f64>) -> String + use<> {
    let least = all.iter().map(|(_, _, d)| d.worst).fold(f64::INFINITY, f64::min);
    let decimals = format::decimals_for(least);
    move |value| value.map_or_else(|| "–".to_owned(), |value| format::fixed(value, decimals))
}

fn from_words(from: ReferenceFrom, count: usize) -> String {
    let count = format::count(count);
    match from {
        ReferenceFrom::Control => words::second_control(count),
        ReferenceFrom::Datum => words::second_datum(count),
        _ => words::second_all(count),
    }
}

fn found(desk: Desk, all: RwSignal<bool>, prediction: &Prediction, repeated: &Repeated) -> impl IntoView + use<> {
    let unit = desk.document.with(|d| d.project.unit.clone());
    let is_reference = |id: &String| repeated.reference.contains(id);
    let mut rows: Vec<(String, bool, Detectable)> =
        (prediction.points.iter()).filter_map(|p| Some((p.id.clone(), is_reference(&p.id), p.detectable?))).collect();
    rows.sort_by(|a, b| b.2.worst.total_cmp(&a.2.worst));
    let length = lengths(&rows);
    let percent = |share: f64| format::editable((1e5 * share).round() / 1e3);
    let largest = repeated.point.as_ref().zip(repeated.largest).map(|(point, worst)| {
        words::second_largest(
            point,
            length(Some(worst)),
            &unit,
            percent(repeated.power),
            percent(repeated.significance),
        )
    });
    let count = rows.len();
    let shown = if all.get() { count } else { SHOWN };
    let body = rows.into_iter().take(shown).map(|(id, reference, found)| {
        let [x, y, z] = found.axes.map(&length);
        view! {
            <tr data-detectable=id.clone()>
                <td class="left id">{id.clone()}</td><td class="left">{reference.then(monitoring::legend_reference)}</td>
                <td>{x}</td><td>{y}</td><td>{z}</td><td><b>{length(Some(found.worst))}</b></td>
            </tr>
        }
    });
    view! {
        <p class="note" data-second="words">{from_words(repeated.reference_from, repeated.reference.len())} " " {largest}</p>
        <div class="scroll-x" tabindex="0" role="region" aria-label=words::second>
            <table class="table detectable">
                <thead><tr>
                    <th class="left">{text::id}</th><td></td><th>"X " {unit.clone()}</th><th>"Y"</th><th>"Z"</th>
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
        // Without a determined network the verdict says what is missing.
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
