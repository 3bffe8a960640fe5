//! The shooting plan on paper: stations with places, aims and rolls, what a second campaign detects, and a checklist in every language.

use std::sync::Arc;

use leptos::prelude::*;
use sightline_plan::Prediction;

use super::frame::rounded;
use super::predicted;
use super::repeated::on_paper;
use crate::format;
use crate::i18n::Language;
use crate::i18n::planning::{Words, words};
use crate::store::Desk;

/// A phrase in every language, without repetitions.
fn in_all(say: fn(&dyn Words) -> &'static str) -> String {
    let mut phrases = Vec::new();
    for phrase in Language::ALL.map(|language| say(words(language))) {
        if !phrases.contains(&phrase) {
            phrases.push(phrase);
        }
    }
    phrases.join(" / ")
}

#[component]
pub fn ShootingPlan() -> impl IntoView {
    let desk = expect_context::<Desk>();
    // Not computed while a station is dragged.
    let settled = Memo::new_with_compare(
        move |before: Option<&Option<Arc<Prediction>>>| match before {
            Some(before) if desk.planning.live.with(Option::is_some) => before.clone(),
            _ => predicted(desk),
        },
        |a, b| match (a.cloned().flatten(), b.cloned().flatten()) {
            (Some(a), Some(b)) => !Arc::ptr_eq(&a, &b),
            (None, None) => false,
            _ => true,
        },
    );
    let rows = move || {
        let plan = desk.plan().unwrap_or_default();
        let prediction = settled.get();
        let row = |(k, station): (usize, sightline::project::PlanStation)| {
            let sight = prediction.as_ref().and_then(|p| p.stations.get(k));
            let formatted = |place: [f64; 3]| desk.axes().shown(place).map(|x| format::compact(rounded(x)));
            let place = formatted(station.position);
            let aim = station.look_at.map_or(String::new(), |aim| formatted(aim).join(", "));
            let distance = sight.and_then(|s| s.distance).map_or(String::new(), format::compact);
            let sees = sight.map_or(String::new(), |s| format::count(s.points.len()));
            let roll = format::compact(station.roll.to_degrees().round());
            let [x, y, z] = place;
            view! {
                <tr>
                    <td>{if station.taken { "☑" } else { "☐" }}</td><td>{station.id}</td>
                    <td>{x}</td><td>{y}</td><td>{z}</td><td>{aim}</td><td>{roll} "°"</td><td>{distance}</td><td>{sees}</td>
                </tr>
            }
        };
        plan.stations.into_iter().enumerate().map(row).collect_view()
    };
    let checks: [fn(&dyn Words) -> &'static str; 5] =
        [|w| w.check_focus(), |w| w.check_light(), |w| w.check_targets(), |w| w.check_scale(), |w| w.check_photos()];
    let name = move || desk.document.with(|d| d.project.name.clone());
    let unit = move || desk.document.with(|d| d.project.unit.clone());
    let heads: [fn(&dyn Words) -> &'static str; 6] =
        [|w| w.taken(), |w| w.number(), |w| w.look_at(), |w| w.roll(), |w| w.distance(), |w| w.sees()];
    view! {
        <section class="shooting-plan">
            <h1>{in_all(|w| w.shooting_plan())} " " {name}</h1>
            <p>{in_all(|w| w.stations())} ", " {unit}</p>
            <table>
                <thead><tr>
                    {heads[..2].iter().map(|head| view! { <th>{in_all(*head)}</th> }).collect_view()}
                    {move || desk.axes().names().map(|axis| view! { <th>{axis}</th> }).collect_view()}
                    {heads[2..].iter().map(|head| view! { <th>{in_all(*head)}</th> }).collect_view()}
                </tr></thead>
                <tbody>{rows}</tbody>
            </table>
            {move || settled.get().map(|prediction| on_paper(desk, &prediction, in_all))}
            <h2>{in_all(|w| w.checklist())}</h2>
            <ul>{checks.map(|check| view! { <li>"☐ " {in_all(check)}</li> }).collect_view()}</ul>
        </section>
    }
}
