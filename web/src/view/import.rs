//! Preview of a list of points before its import: how it was read, open questions, rejected lines, and resulting points. On step 4 it stands
//! among the other tables, on every other step over what is there.

mod choices;
mod words;

use std::collections::{BTreeMap, HashSet};

use leptos::prelude::*;
use sightline::axes::ShownAxes;
use sightline::project::{Point, Role};
use sightline::units::Unit;
use sightline_exchange::control_csv::{Assumption, Axes, Basis, ControlTable, Decimal, Field as ControlField};

pub use choices::DecimalChoice;
use choices::ReadingChoices;
use words::{assumption_words, field_word};

use super::components::icon::{Glyph, Icon};
use crate::browser::{event, page};
use crate::format;
use crate::i18n::{Text, errors, language, lists, text, text::role_word};
use crate::store::Desk;
use crate::store::control::Pasted;
use crate::view::components::coordinates::CoordinateHead;
use crate::view::components::coordinates::sigma_cells;
use crate::view::components::coordinates::xyz_cells;

/// Lines of the list that are shown around the first ones; the rejected ones are all listed.
const LINES: usize = 60;

/// A sheet over a step that is not that of control points; Esc discards the list.
#[component]
pub fn SheetOver(title: Text, discard: fn(Desk), children: Children) -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <div class="import-over" role="dialog" aria-label=title
            on:keydown=move |e| if event::key(&e).key == "Escape" {
                discard(desk);
            }>
            <div class="import-title"><h1>{title}</h1> <p>{lists::nothing_stored}</p></div>
            {children()}
        </div>
    }
}

/// The list of points over such a step.
#[component]
pub fn ImportOver() -> impl IntoView {
    view! {
        <SheetOver title=lists::import_points discard=|desk: Desk| desk.intake.pasted.set(None)><ImportSheet/></SheetOver>
    }
}

/// A list is read anew with every choice, and its menus do not change their language by themselves: the field that has the focus keeps it.
pub fn keep_focus() {
    language();
    if let Some(field) = page::focused_field() {
        page::after(0, move || page::focus_first(&format!(".import {field}")));
    }
}

/// The rows that were read, before they are imported.
#[component]
pub fn ImportSheet() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sheet = move || {
        keep_focus();
        desk.intake.pasted.get().map(|pasted| view! { <Sheet pasted/> })
    };
    view! { {sheet} }
}

#[component]
fn Sheet(pasted: Pasted) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = pasted.table.rows.len();
    let good = pasted.table.rows.iter().filter(|r| r.is_ok()).count();
    let (typed_sigma, sigma_fault) = pasted.typed_sigma.clone();
    let unasked = pasted.is_asked() || sigma_fault.is_some();
    let unit = pasted.unit.clone();
    let by_list = pasted.unit_of_the_list();
    let mut units: Vec<String> = Unit::ALL.map(|unit| unit.symbol().to_owned()).into();
    if let Some(other) = unit.clone().filter(|unit| !units.contains(unit)) {
        units.push(other);
    }
    view! {
        <section class="panel import">
            <h2 class="section-head">
                <span>{pasted.source.clone()}</span>
                <span class="aside" class:warn=good < all>
                    {move || text::rows_read(format::count(all), format::count(all - good))}
                </span>
                <label class="unit-field" class:asked=unit.is_none()><span>{text::unit_of_these}</span>
                    <select name="pasted-unit" disabled=by_list on:change=move |e| desk.set_pasted_unit(&event::value(&e))>
                        {unit.is_none().then(|| view! { <option value="" selected=true>{text::choose_unit}</option> })}
                        {units.into_iter().map(|name| view! {
                            <option value=name.clone() selected=unit.as_ref() == Some(&name)>{name.clone()}</option>
                        }).collect_view()}
                    </select>
                </label>
                <button class="link" on:click=move |_| desk.intake.pasted.set(None)>{text::discard}</button>
                <button class="button small primary" disabled=good == 0 || unasked on:click=move |_| desk.take_control()>
                    {move || text::take_points(format::count(good))}
                </button>
            </h2>
            <div class="import-parts">
                <div class="import-part">
                    <Lines pasted=pasted.clone()/>
                </div>
                <div class="import-part">
                    <h3 class="section-head"><span>{lists::how_read}</span><span class="aside">{lists::how_read_hint}</span></h3>
                    <ReadingChoices pasted=pasted.clone() typed_sigma/>
                    {sigma_fault.map(|error| view! { <p class="note bad" role="alert">{move || errors::sentence(&error)}</p> })}
                    <ListReading table=pasted.table.clone() axes=pasted.shown_axes()/>
                    {pasted.brings_another_system().then(|| view! { <p class="note warn" data-system="">{lists::local_system_new}</p> })}
                    <Columns pasted=pasted.clone()/>
                </div>
                <div class="import-part">
                    <h3 class="section-head"><span>{lists::resulting_points} " " <span class="id">{format::count(good)}</span></span></h3>
                    <Rows pasted/>
                </div>
            </div>
        </section>
    }
}

/// The list as it is, with what became of each line.
#[component]
fn Lines(pasted: Pasted) -> impl IntoView {
    let place = |row: &sightline::Result<sightline_exchange::control_csv::ControlRow>| match row {
        Ok(row) => (row.line, None),
        Err(error) => (error.place().line.unwrap_or_default(), Some(error.clone())),
    };
    let fates: BTreeMap<usize, Option<sightline::Error>> = pasted.table.rows.iter().map(place).collect();
    let count = pasted.content.lines().count();
    let lines = pasted.content.lines().take(LINES).enumerate().map(|(k, line)| {
        let fate = fates.get(&(k + 1));
        let (taken, rejected) = (matches!(fate, Some(None)), matches!(fate, Some(Some(_))));
        view! {
            <li class:taken=taken class:rejected=rejected>
                <span class="number">{k + 1}</span>
                <span class="fate">{taken.then(|| view! { <Glyph icon=Icon::Check size=12/> })}{rejected.then(|| view! { <Glyph icon=Icon::Cross size=12/> })}</span>
                <code>{line.chars().take(160).collect::<String>()}</code>
            </li>
        }
    });
    let lines = lines.collect_view();
    let rejected: Vec<(usize, sightline::Error)> =
        fates.into_iter().filter_map(|(line, error)| Some((line, error?))).collect();
    let any = !rejected.is_empty();
    let number = rejected.len();
    view! {
        <h3 class="section-head"><span>{lists::the_list}</span><span class="aside">{move || lists::lines_count(format::count(count))}</span></h3>
        <ol class="list-lines scroll" tabindex="0" aria-label=lists::the_list>{lines}</ol>
        <h3 class="section-head" class:warn=any><span>{lists::rejected_lines} " " <span class="id">{format::count(number)}</span></span>
            {(!any).then(|| view! { <span class="aside">{lists::none_rejected}</span> })}</h3>
        <ul class="rejected-lines scroll" data-rejected=number.to_string()>
            {rejected.into_iter().map(|(line, error)| view! {
                <li><b>{line}</b> <span>{move || errors::sentence(&error)}</span></li>
            }).collect_view()}
        </ul>
    }
}

/// How a list was read, and what has to be answered before it is taken.
#[component]
fn ListReading(table: ControlTable, axes: ShownAxes) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let lines: Vec<usize> = table.rows.iter().flatten().map(|row| row.line).collect();
    let assumptions = table.assumptions;
    let sentence = {
        let assumptions = assumptions.clone();
        move || {
            let points = match (lines.first(), lines.last()) {
                (Some(first), Some(last)) => lists::understood_points(format::count(lines.len()), first, last),
                _ => lists::understood_none().to_owned(),
            };
            std::iter::once(points)
                .chain(assumptions.iter().filter_map(|assumption| assumption_words(axes, assumption)))
                .collect::<Vec<_>>()
                .join(" ")
        }
    };
    let questions = assumptions
        .into_iter()
        .filter(|assumption| assumption.by() == Basis::Undecided)
        .filter_map(|assumption| match assumption {
            Assumption::DecimalSign { example, .. } => {
                let [decimal, thousands] = format::ambiguous(&example?)?;
                let pick = move |sign| move |_| desk.choose_reading(|choices, _| choices.decimal = Some(sign));
                Some(
                    view! {
                        <p class="note warn" data-asked="decimal">{text::ask_decimal} " "
                            <button class="button small" on:click=pick(Decimal::Comma)>{decimal}</button> " "
                            <button class="button small" on:click=pick(Decimal::Point)>{thousands}</button>
                        </p>
                    }
                    .into_any(),
                )
            }
            Assumption::AxisOrder { .. } => {
                let pick = move |order| move |_| desk.choose_reading(|choices, _| choices.axes = Some(order));
                Some(
                    view! {
                        <p class="note warn" data-asked="axes">{text::ask_axes} " "
                            <button class="button small" on:click=pick(Axes::Xy)>{text::axes_xy}</button> " "
                            <button class="button small" on:click=pick(Axes::Yx)>{text::axes_yx}</button>
                        </p>
                    }
                    .into_any(),
                )
            }
            Assumption::Columns { .. } => {
                let agree = move |_| desk.choose_reading(|choices, columns| choices.columns = Some(columns.to_vec()));
                Some(
                    view! {
                        <p class="note warn" data-asked="columns">{lists::ask_columns} " "
                            <button class="button small" on:click=agree>{lists::columns_right}</button>
                        </p>
                    }
                    .into_any(),
                )
            }
            _ => None,
        })
        .collect_view();
    view! {
        <p class="note understood" data-reading=""><b>{lists::understood}</b> " " {sentence}</p>
        {questions}
    }
}

/// Possible contents of columns.
const FIELDS: [ControlField; 14] = [
    ControlField::Id,
    ControlField::X,
    ControlField::Y,
    ControlField::Z,
    ControlField::Latitude,
    ControlField::Longitude,
    ControlField::Sx,
    ControlField::Sy,
    ControlField::Sz,
    ControlField::Sxy,
    ControlField::Sigma,
    ControlField::Label,
    ControlField::Diameter,
    ControlField::Role,
];

/// The columns as the text has them, each with a menu of what it holds.
#[component]
fn Columns(pasted: Pasted) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let columns = pasted.columns();
    if columns.is_empty() {
        return ().into_any();
    }
    let heading = pasted.table.heading.clone();
    let axes = pasted.shown_axes();
    let menu = move |(place, holds): (usize, Option<ControlField>)| {
        let name = heading.get(place).cloned().unwrap_or_default();
        let label = move || lists::column_number(place + 1);
        view! {
            <th class="left" class:ignored=holds.is_none()><small>{name}</small>
                <select data-column=place.to_string() aria-label=label on:change=move |e| {
                    let chosen = event::value(&e);
                    desk.set_column(place, FIELDS.into_iter().find(|field| field.name() == chosen));
                }>
                    <option value="" selected=holds.is_none()>{lists::column_ignored}</option>
                    {FIELDS.map(|field| view! {
                        <option value=field.name() selected=holds == Some(field)>{move || field_word(axes, field)}</option>
                    }).collect_view()}
                </select>
            </th>
        }
    };
    let row = |fields: Vec<String>| view! { <tr>{fields.into_iter().map(|field| view! { <td class="left">{field}</td> }).collect_view()}</tr> };
    view! {
        <h3 class="section-head"><span>{lists::columns}</span><span class="aside">{lists::columns_hint}</span></h3>
        {pasted.remembered.then(|| view! {
            <p class="note row" data-remembered=""><span>{lists::as_before}</span> " "
                <button class="link" on:click=move |_| desk.forget_reading()>{lists::by_itself}</button></p>
        })}
        <div class="scroll list-columns" tabindex="0" role="region" aria-label=lists::columns>
            <table class="table"><thead><tr>{columns.into_iter().enumerate().map(menu).collect_view()}</tr></thead>
                <tbody>{pasted.table.sample.into_iter().map(row).collect_view()}</tbody></table>
        </div>
    }
    .into_any()
}

/// The points as the project will have them; bad rows with line and reason.
#[component]
fn Rows(pasted: Pasted) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let measured: HashSet<String> =
        desk.document.with(|d| d.project.observations.iter().map(|o| o.point.clone()).collect());
    let (by_column, chosen, axes) = (pasted.has_roles(), pasted.role, pasted.shown_axes());
    let rows = pasted.table.rows.into_iter().map(|row| match row {
        Ok(row) => {
            let role = match (by_column, row.point.role) {
                (true, Role::Tie) => Role::Control,
                (true, own) => own,
                (false, _) => chosen,
            };
            let point = Point { role, ..row.point };
            let seen = measured.contains(&point.id);
            let label = row.label.map(|label| format!(" {label}"));
            view! {
                <tr class="new">
                    <td class="left id">{point.id.clone()} <span class="quiet">{label}</span></td>
                    <td class="left">{move || role_word(role)}</td>
                    {xyz_cells(axes, &point, 4)}
                    {sigma_cells(axes, &point)}
                    <td class="left wide" class:warn=!seen>{move || if seen { text::measured() } else { text::not_measured() }}</td>
                </tr>
            }.into_any()
        }
        Err(error) => view! {
            <tr class="wrong"><td class="left bad" colspan="9"><Glyph icon=Icon::Cross size=12/> " " {move || errors::sentence(&error)}</td></tr>
        }.into_any(),
    }).collect_view();
    let unit = pasted.unit.unwrap_or_else(|| "?".to_owned());
    view! {
        <div class="scroll preview" tabindex="0" role="region" aria-label=lists::resulting_points>
            <table class="table"><thead><tr><CoordinateHead unit axes/></tr></thead><tbody>{rows}</tbody></table>
        </div>
    }
}
