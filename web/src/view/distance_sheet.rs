//! Preview of a list of distances before its import: how it was read, open questions, rejected rows, and resulting distances.

use std::collections::HashMap;

use leptos::prelude::*;
use sightline::project::Distance;
use sightline::units::Unit;
use sightline_exchange::control_csv::{Assumption, Basis, Decimal};

use super::components::field::Field;
use super::components::icon::{Glyph, Icon};
use super::import::{DecimalChoice, SheetOver, keep_focus};
use crate::browser::event;
use crate::format;
use crate::i18n::{errors, lists, text};
use crate::store::Desk;
use crate::store::distance_list::DistanceFile;

/// The sheet over a step that is not that of control points.
#[component]
pub fn DistancesOver() -> impl IntoView {
    view! {
        <SheetOver title=lists::import_distances discard=|desk: Desk| desk.intake.distances.set(None)><DistanceSheet/></SheetOver>
    }
}

/// The content that was read, before it is imported.
#[component]
pub fn DistanceSheet() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sheet = move || {
        keep_focus();
        desk.intake.distances.get().map(|file| sheet(desk, &file))
    };
    view! { {sheet} }
}

fn sheet(desk: Desk, file: &DistanceFile) -> impl IntoView + use<> {
    let (good, rejected) = (file.good(), file.rejected());
    let (count, all) = (good.len(), good.len() + rejected.len());
    let unit = file.unit;
    let choose_unit = move |e: leptos::ev::Event| {
        let chosen = Unit::named(&event::value(&e));
        desk.choose_distances(|file| (file.unit, file.unit_assumed) = (chosen, false));
    };
    let bad = rejected.len();
    view! {
        <section class="panel import" data-distances="">
            <h2 class="section-head">
                <span>{file.source.clone()}</span>
                <span class="aside" class:warn=(bad > 0)>{text::rows_read(format::count(all), format::count(bad))}</span>
                <label class="unit-field" class:asked=unit.is_none()><span>{lists::unit_of_lengths}</span>
                    <select name="distances-unit" disabled=file.says_unit() on:change=choose_unit>
                        {unit.is_none().then(|| view! { <option value="" selected=true>{text::choose_unit}</option> })}
                        {Unit::ALL.map(|one| view! {
                            <option value=one.symbol() selected=unit == Some(one)>{one.symbol()}</option>
                        }).collect_view()}
                    </select>
                </label>
                <button class="link" on:click=move |_| desk.intake.distances.set(None)>{text::discard}</button>
                <button class="button small primary" disabled=count == 0 || file.is_asked() on:click=move |_| desk.take_distances()>
                    {lists::import_distances_count(format::count(count))}
                </button>
            </h2>
            <div class="import-parts">
                <div class="import-part">
                    <h3 class="section-head"><span>{lists::how_read}</span><span class="aside">{lists::how_read_hint}</span></h3>
                    {ways(desk, file)}
                    <h3 class="section-head" class:warn=(bad > 0)><span>{lists::rejected_lines} " " <span class="id">{format::count(bad)}</span></span>
                        {(bad == 0).then(|| view! { <span class="aside">{lists::none_rejected}</span> })}</h3>
                    <ul class="rejected-lines scroll" data-rejected=bad.to_string()>
                        {rejected.into_iter().map(|error| view! {
                            <li><b>{error.place().line}</b> " " <span>{errors::sentence(&error)}</span></li>
                        }).collect_view()}
                    </ul>
                </div>
                <div class="import-part">
                    <h3 class="section-head"><span>{lists::resulting_distances} " " <span class="id">{format::count(count)}</span></span></h3>
                    {resulting(desk, file, good)}
                </div>
            </div>
        </section>
    }
}

/// Decimal mark and common standard error, and what has to be answered.
fn ways(desk: Desk, file: &DistanceFile) -> impl IntoView + use<> {
    let choose = move |sign| desk.choose_distances(|file| file.choices.decimal = sign);
    let question = file.list.assumptions.iter().find_map(|assumption| match assumption {
        Assumption::DecimalSign { example: Some(example), by: Basis::Undecided, .. } => format::ambiguous(example),
        _ => None,
    });
    let pick = move |sign| move |_| desk.choose_distances(|file| file.choices.decimal = Some(sign));
    let (typed, fault) = file.typed_sigma.clone();
    let assumed = file.unit.filter(|_| file.unit_assumed).map(|unit| lists::distance_unit_assumed(unit.symbol()));
    let without_sigma = Some(file.without_sigma()).filter(|count| *count > 0);
    view! {
        <div class="ways">
            <DecimalChoice name="distances-decimal" assumptions=file.list.assumptions.clone() chosen=file.choices.decimal
                choose=Callback::new(choose)/>
            <label class="way"><span>{lists::sigma_of_lengths}</span>
                <Field value=Signal::stored(typed) commit=move |typed: String| desk.set_distances_sigma(&typed)
                    attr:name="distances-sigma" attr:placeholder="0.02 mm + 2 ppm"/>
            </label>
        </div>
        {fault.map(|error| view! { <p class="note bad" role="alert">{errors::sentence(&error)}</p> })}
        {question.map(|[decimal, thousands]| view! {
            <p class="note warn" data-asked="decimal">{text::ask_decimal} " "
                <button class="button small" on:click=pick(Decimal::Comma)>{decimal}</button> " "
                <button class="button small" on:click=pick(Decimal::Point)>{thousands}</button>
            </p>
        })}
        {without_sigma.map(|count| view! { <p class="note warn" data-asked="sigma">{lists::distance_sigma_missing(format::count(count))}</p> })}
        {assumed.map(|said| view! { <p class="note" data-assumed="unit">{said}</p> })}
        {(!file.list.has_heading).then(|| view! { <p class="note">{lists::distance_columns}</p> })}
    }
}

/// The distances as the project will have them, each with what it does there.
fn resulting(desk: Desk, file: &DistanceFile, good: Vec<Distance>) -> AnyView {
    let planned = match desk.distances_planned(file) {
        Ok(planned) => planned,
        Err(error) => return view! { <p class="note bad" role="alert">{errors::sentence(&error)}</p> }.into_any(),
    };
    let ends = |d: &Distance| (d.from.clone(), d.to.clone());
    let mut replaced: HashMap<_, Vec<f64>> = HashMap::new();
    for (was, is) in planned.replaced.iter().rev() {
        replaced.entry(ends(is)).or_default().push(was.length);
    }
    let project_unit = desk.document.with(|d| d.project.unit.clone());
    let rows = good.into_iter().map(|distance| {
        let strangers: Vec<&str> = [&distance.from, &distance.to]
            .into_iter()
            .filter(|end| planned.strangers.contains(end))
            .map(String::as_str)
            .collect();
        let left_out = !strangers.is_empty();
        let fate = match (left_out, replaced.get_mut(&ends(&distance)).and_then(Vec::pop)) {
            (true, _) => lists::distance_left_out(strangers.join(", ")),
            (false, Some(was)) => lists::distance_replaces(format!("{} {project_unit}", format::editable(was))),
            (false, None) => lists::distance_is_new().to_owned(),
        };
        view! {
            <tr class:wrong=left_out>
                <td class="left id">{distance.from.clone()}</td><td class="left id">{distance.to.clone()}</td>
                <td>{format::editable(distance.length)}</td><td>{format::editable(distance.sigma)}</td>
                <td class="left wide" class:warn=left_out>{left_out.then(|| view! { <Glyph icon=Icon::Cross size=12/> " " })}{fate}</td>
            </tr>
        }
    });
    let unit = file.unit.map_or("?", Unit::symbol);
    view! {
        <div class="scroll preview" tabindex="0" role="region" aria-label=lists::resulting_distances>
            <table class="table">
                <thead><tr><th class="left">{text::from_point}</th><th class="left">{text::to_point}</th>
                    <th>{text::length} " " <u>{unit}</u></th><th>"σ " <u>{unit}</u></th><th class="left">{lists::distance_fate}</th></tr></thead>
                <tbody>{rows.collect_view()}</tbody>
            </table>
        </div>
    }
    .into_any()
}
