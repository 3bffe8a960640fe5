//! The stations in a table, what the chosen one is aimed at, and what to look after on site.

use leptos::prelude::*;

use super::frame::rounded;
use super::predicted;
use crate::browser::event;
use crate::document::Change;
use crate::edit::plan;
use crate::format;
use crate::i18n::planning as words;
use crate::i18n::{Text, errors, text};
use crate::store::Desk;
use crate::view::components::field::Field;
use crate::view::components::icon::{Glyph, Icon};

/// The stations in a table: places can be typed, photos rolled, ticked off and taken away.
#[component]
pub fn Stations() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let planning = desk.planning;
    let rows = move || {
        let plan = desk.plan().unwrap_or_default();
        let chosen = planning.chosen.get();
        let row = |(k, station): (usize, sightline::project::PlanStation)| {
            let id = StoredValue::new(station.id.clone());
            let coordinate = move |axis: usize| {
                let value = Signal::derive(move || {
                    let place = desk.with_plan(|p| p.stations.get(k).map(|s| s.position[axis])).flatten();
                    place.map_or(String::new(), |v| format::editable(rounded(v)))
                });
                let commit = move |typed: String| {
                    let Some(number) = format::parse(&typed).filter(|v| v.is_finite() && v.abs() < 1e9) else {
                        return desk.warn_here(move || errors::refusal(&typed, text::not_a_number));
                    };
                    desk.edit_plan(Change::StationMoved(id.get_value()), |plan| {
                        plan::move_station(plan, &id.get_value(), axis, number);
                    });
                };
                let name = desk.axes().letter(axis);
                view! { <td><Field value commit attr:class="short" attr:aria-label=move || format!("{name} {}", id.get_value())/></td> }
            };
            let sight = move |read: fn(&sightline_plan::StationSight) -> String| {
                move || predicted(desk).and_then(|p| p.stations.get(k).map(read)).unwrap_or_default()
            };
            let taken = station.taken;
            let roll = station.roll.to_degrees().round();
            view! {
                <tr class:chosen=chosen.as_deref() == Some(station.id.as_str()) data-station=station.id.clone()
                    on:click=move |_| planning.chosen.set(Some(id.get_value()))>
                    <td class="left id">{station.id.clone()}</td>
                    <td>
                        <input type="checkbox" aria-label=move || words::taken_station(id.get_value()) prop:checked=taken on:change=move |e| {
                            let on = event::checked(&e);
                            desk.edit_plan(Change::PlanEdited, |plan| if let Some(s) = plan.stations.get_mut(k) { s.taken = on });
                        }/>
                    </td>
                    {desk.axes().order().map(coordinate).into_iter().collect_view()}
                    <td>
                        <button class="link" aria-label=move || words::turn_station(id.get_value()) on:click=move |_| {
                            desk.edit_plan(Change::StationMoved(id.get_value()), |plan| {
                                if let Some(s) = plan.stations.get_mut(k).filter(|s| s.rotation.is_none()) {
                                    s.roll = if s.roll.abs() < 0.1 { std::f64::consts::FRAC_PI_2 } else { 0.0 };
                                }
                            });
                        }>{format::compact(roll)} "°"</button>
                    </td>
                    <td>{sight(|s| s.distance.map_or("–".to_owned(), format::compact))}</td>
                    <td>{sight(|s| format::count(s.points.len()))}</td>
                    <td>
                        <button class="icon-button small" aria-label=move || words::remove_station(id.get_value()) on:click=move |e| {
                            e.stop_propagation();
                            desk.edit_plan(Change::StationRemoved(id.get_value()), |plan| plan.stations.retain(|s| s.id != id.get_value()));
                        }><Glyph icon=Icon::Cross size=12/></button>
                    </td>
                </tr>
            }
        };
        plan.stations.into_iter().enumerate().map(row).collect_view()
    };
    let on_site = move || {
        let (taken, all) = desk.document.with(|d| {
            let stations = d.project.plan.as_ref().map_or(&[][..], |plan| &plan.stations);
            (stations.iter().filter(|s| s.taken).count(), stations.len())
        });
        words::taken_of(format::count(taken), format::count(all))
    };
    view! {
        <h2 class="section-head"><span>{words::stations}</span><span class="aside">{on_site}</span></h2>
        <div class="scroll-x">
            <table class="table stations">
                <thead><tr>
                    <th class="left">{words::number}</th><th>{words::taken}</th>{move || desk.axes().names().map(|axis| view! { <th>{axis}</th> }).collect_view()}
                    <th>{words::roll}</th><th>{words::distance}</th><th>{words::sees}</th><td></td>
                </tr></thead>
                <tbody>{rows}</tbody>
            </table>
        </div>
        <Aim/>
        <Unseen/>
    }
}

/// Aim point of the selected station.
#[component]
fn Aim() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let place = move || {
        let id = desk.planning.chosen.get()?;
        desk.document.with(|d| d.project.plan.as_ref()?.stations.iter().position(|s| s.id == id && s.look_at.is_some()))
    };
    let fields = move || {
        let k = place()?;
        let id = desk.planning.chosen.get_untracked()?;
        let named = id.clone();
        let coordinate = |axis: usize| {
            let id = id.clone();
            let value = Signal::derive(move || {
                let aim = desk.document.with(|d| d.project.plan.as_ref()?.stations.get(k)?.look_at);
                aim.map_or(String::new(), |aim| format::editable(rounded(aim[axis])))
            });
            let commit = move |typed: String| match format::parse(&typed).filter(|v| v.is_finite() && v.abs() < 1e9) {
                Some(number) => {
                    desk.edit_plan(Change::StationMoved(id.clone()), |plan| plan::aim_station(plan, &id, axis, number))
                }
                None => desk.warn_here(move || errors::refusal(&typed, text::not_a_number)),
            };
            let name = desk.axes().letter(axis);
            view! { <Field value commit attr:class="short" attr:name=format!("aim-{}", name.to_lowercase()) attr:aria-label=move || format!("{} {name}", words::look_at())/> }
        };
        Some(view! {
            <p class="aim">
                <span>{move || words::station_aim(named.clone())}</span>
                {desk.axes().order().map(coordinate).into_iter().collect_view()}
            </p>
        })
    };
    view! { <div>{fields}</div> }
}

/// Points not visible from the selected station, with the reason.
#[component]
fn Unseen() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let told = move || {
        let id = desk.planning.chosen.get()?;
        let prediction = predicted(desk)?;
        let sight = prediction.stations.iter().find(|s| s.id == id)?;
        let unseen = sight.unseen;
        let reasons = [
            (unseen.outside, words::unseen_outside as fn(String) -> String),
            (unseen.turned_away, words::unseen_turned_away),
            (unseen.hidden, words::unseen_hidden),
            (unseen.too_small, words::unseen_too_small),
            (unseen.blurred, words::unseen_blurred),
        ];
        let told: Vec<String> =
            reasons.into_iter().filter(|(n, _)| *n > 0).map(|(n, words)| words(format::count(n))).collect();
        let smallest = sight.smallest_px.map(|px| words::smallest_target(format::fixed(px, 1)));
        let all = if told.is_empty() { words::sees_all().to_owned() } else { words::does_not_see(told.join(", ")) };
        Some(view! { <p class="note" data-unseen>{all} " " {smallest}</p> })
    };
    view! { <div>{told}</div> }
}

/// Checklist for the site.
#[component]
pub fn Checklist() -> impl IntoView {
    let checks: [Text; 5] =
        [words::check_focus, words::check_light, words::check_targets, words::check_scale, words::check_photos];
    view! {
        <details class="checklist">
            <summary>{words::shooting_plan} ": " {words::checklist}</summary>
            <ul>{checks.map(|check| view! { <li>{check}</li> }).collect_view()}</ul>
        </details>
    }
}
