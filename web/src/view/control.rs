//! Step 4: control points, measured distances, unit and datum.

use std::collections::HashSet;

use leptos::prelude::*;
use sightline::project::{DatumKind, Point, Role};

use super::icon::{Glyph, Icon};
use super::identities::NamedPhoto;
use super::shell::TitleBar;
use crate::browser::{event, file};
use crate::format;
use crate::i18n::{Text, errors, text, text::role_word};
use crate::store::control::{DistanceFault, distance_fault};
use crate::store::{Desk, Step};

#[component]
pub fn Control() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sentence = move || {
        let (control, check, distances) = desk.document.with(|d| {
            let of = |role| d.project.points.iter().filter(|p| p.role == role).count();
            (of(Role::Control), of(Role::Check), d.project.distances.len())
        });
        text::control_sentence(format::count(control), format::count(check), format::count(distances))
    };
    view! {
        <TitleBar title=text::control_and_scale sentence=Signal::derive(sentence)>
            <button class="button" on:click=move |_| choose_control(desk)>{text::open_control}</button>
            <button class="button primary" on:click=move |_| desk.go(Step::Adjust)>{text::adjustment} <Glyph icon=Icon::Arrow/></button>
        </TitleBar>
        <main class="control">
            <NamedPhoto/>
            <div class="columns scroll">
                <PasteBox/>
                <Preview/>
                <Known/>
                <Distances/>
                <DatumChoice/>
            </div>
        </main>
    }
}

fn choose_control(desk: Desk) {
    file::choose(".csv,.txt,.tsv,.dat,text/plain,text/csv", false, move |files| {
        if let Some(file) = files.into_iter().next() {
            desk.read_text(file, Desk::read_control);
        }
    });
}

/// Rows pasted from a spreadsheet or a list.
#[component]
fn PasteBox() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <section class="panel">
            <h2 class="section-head"><span><label for="paste">{text::control_points}</label></span></h2>
            <div class="fields">
                <textarea id="paste" rows="2" placeholder=text::paste_control on:input=move |e| {
                    let typed = event::value(&e);
                    if typed.trim().is_empty() {
                        desk.pasted.set(None);
                    } else {
                        desk.read_control(text::pasted().to_owned(), &typed);
                    }
                }></textarea>
            </div>
        </section>
    }
}

fn xyz_cells(point: &Point, decimals: usize) -> impl IntoView + use<> {
    let xyz = point.xyz;
    (0..3).map(|k| view! { <td>{format::maybe(xyz.map(|x| x[k]), decimals)}</td> }).collect_view()
}

fn sigma_cells(point: &Point) -> impl IntoView + use<> {
    let sigma = point.sigma.unwrap_or_default();
    let role = point.role;
    (0..3)
        .map(|k| {
            let shown = match sigma[k] {
                Some(s) if s > 0.0 => format::fixed(s, format::decimals_for(s)),
                _ if role == Role::Tie => "–".to_owned(),
                _ => text::fixed().to_owned(),
            };
            view! { <td>{shown}</td> }
        })
        .collect_view()
}

#[component]
fn CoordinateHead() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let unit = Memo::new(move |_| desk.document.with(|d| d.project.unit.clone()));
    let coordinate = move |name: &'static str| view! { <th>{name} " " <u>{unit}</u></th> };
    let sigma = move |name: &'static str| view! { <th>"σ"<sub>{name}</sub> " " <u>{unit}</u></th> };
    view! {
        <th class="left">{text::id}</th>
        <th class="left">{text::role}</th>
        {coordinate("X")}{coordinate("Y")}{coordinate("Z")}
        {sigma("X")}{sigma("Y")}{sigma("Z")}
        <th class="left wide"></th>
    }
}

/// What was read, row by row, before it is taken: bad rows are named with line and reason.
#[component]
fn Preview() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        {move || desk.pasted.get().map(|pasted| {
            let all = pasted.table.rows.len();
            let good = pasted.table.rows.iter().filter(|r| r.is_ok()).count();
            let measured: HashSet<String> = desk.document.with(|d| d.project.observations.iter().map(|o| o.point.clone()).collect());
            let rows = pasted.table.rows.into_iter().map(|row| match row {
                Ok(row) => {
                    let role = if row.point.role == Role::Tie { Role::Control } else { row.point.role };
                    let point = Point { role, ..row.point };
                    let seen = measured.contains(&point.id);
                    view! {
                        <tr class="new">
                            <td class="left id">{point.id.clone()}</td>
                            <td class="left">{move || role_word(role)}</td>
                            {xyz_cells(&point, 4)}
                            {sigma_cells(&point)}
                            <td class="left wide" class:warn=!seen>{move || if seen { text::measured() } else { text::not_measured() }}</td>
                        </tr>
                    }.into_any()
                }
                Err(error) => view! {
                    <tr class="wrong"><td class="left bad" colspan="9"><Glyph icon=Icon::Cross size=12/> " " {move || errors::sentence(&error)}</td></tr>
                }.into_any(),
            }).collect_view();
            view! {
                <section class="panel">
                    <h2 class="section-head">
                        <span>{pasted.source.clone()}</span>
                        <span class="aside" class:warn=good < all>
                            {move || text::rows_read(format::count(all), format::count(all - good))}
                        </span>
                        <button class="link" on:click=move |_| desk.pasted.set(None)>{text::discard}</button>
                        <button class="button small primary" disabled=good == 0 on:click=move |_| desk.take_control()>
                            {move || text::take_points(format::count(good))}
                        </button>
                    </h2>
                    <div class="scroll preview">
                        <table class="table"><thead><tr><CoordinateHead/></tr></thead><tbody>{rows}</tbody></table>
                    </div>
                </section>
            }
        })}
    }
}

/// Control and check points of the project.
#[component]
fn Known() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let points = Memo::new(move |_| {
        desk.document.with(|d| d.project.points.iter().filter(|p| p.role != Role::Tie).cloned().collect::<Vec<_>>())
    });
    view! {
        <Show when=move || points.with(|p| !p.is_empty())>
            <section class="panel">
                <div class="scroll preview">
                    <table class="table">
                        <thead><tr><CoordinateHead/></tr></thead>
                        <tbody>{move || points.get().into_iter().map(|point| view! { <KnownRow point/> }).collect_view()}</tbody>
                    </table>
                </div>
            </section>
        </Show>
    }
}

#[component]
fn KnownRow(point: Point) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(point.id.clone());
    let role = point.role;
    let chosen = move || desk.selection.with(|s| s.point == Some(id.get_value()));
    let seen = move || desk.document.with(|d| d.project.observations.iter().any(|o| o.point == id.get_value()));
    view! {
        <tr class:chosen=chosen>
            <td class="left id"><button class="link" on:click=move |_| desk.select_point(&id.get_value())>{id.get_value()}</button></td>
            <td class="left">
                <select aria-label=text::role on:change=move |e| desk.set_role(&id.get_value(), match event::value(&e).as_str() {
                    "control" => Role::Control,
                    "check" => Role::Check,
                    _ => Role::Tie,
                })>
                    {[(Role::Control, "control"), (Role::Check, "check"), (Role::Tie, "tie")].into_iter().map(|(r, value)| view! {
                        <option value=value selected=r == role>{move || role_word(r)}</option>
                    }).collect_view()}
                </select>
            </td>
            {xyz_cells(&point, 4)}
            {sigma_cells(&point)}
            <td class="left wide warn">{move || if seen() { "" } else { text::not_measured() }}</td>
        </tr>
    }
}

/// Distances between two points.
#[component]
fn Distances() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let distances = Memo::new(move |_| desk.document.with(|d| d.project.distances.clone()));
    let unit = Memo::new(move |_| desk.document.with(|d| d.project.unit.clone()));
    let fields: [RwSignal<String>; 4] = std::array::from_fn(|_| RwSignal::new(String::new()));
    let [from, to, length, sigma] = fields;
    let fault = RwSignal::new(None::<DistanceFault>);
    let add = move || match desk.add_distance(
        &from.get_untracked(),
        &to.get_untracked(),
        &length.get_untracked(),
        &sigma.get_untracked(),
    ) {
        Ok(()) => {
            fault.set(None);
            fields.iter().for_each(|f| f.set(String::new()));
        }
        Err(why) => fault.set(Some(why)),
    };
    let input = move |signal: RwSignal<String>, label: fn() -> &'static str, name: &'static str| {
        view! {
            <input type="text" name=name aria-label=label placeholder=label autocomplete="off" prop:value=signal on:input=move |e| signal.set(event::value(&e))/>
        }
    };
    view! {
        <section class="panel">
            <h2 class="section-head">
                <span>{text::distances}</span>
                <label class="unit-field"><span>{text::unit_of_length}</span>
                    <input type="text" class="short" prop:value=unit on:change=move |e| desk.set_unit(&event::value(&e))/>
                </label>
            </h2>
            <table class="table">
                <thead><tr>
                    <th class="left">{text::from_point}</th><th class="left">{text::to_point}</th>
                    <th>{text::length} " " <u>{unit}</u></th><th>"σ " <u>{unit}</u></th><th class="wide"></th>
                </tr></thead>
                <tbody>
                    {move || distances.get().into_iter().enumerate().map(|(i, d)| view! {
                        <tr>
                            <td class="left id">{d.from}</td><td class="left id">{d.to}</td>
                            <td>{format::fixed(d.length, format::decimals_for(d.sigma))}</td>
                            <td>{format::fixed(d.sigma, format::decimals_for(d.sigma))}</td>
                            <td class="left wide"><button class="icon-button small" aria-label=text::remove_distance on:click=move |_| desk.remove_distance(i)><Glyph icon=Icon::Cross size=12/></button></td>
                        </tr>
                    }).collect_view()}
                </tbody>
            </table>
            <form class="distance-form" on:submit=move |e| { e.prevent_default(); add(); }>
                {input(from, text::from_point, "from")}{input(to, text::to_point, "to")}{input(length, text::length, "length")}{input(sigma, || "σ", "sigma")}
                <button class="button small" type="submit">{text::add_distance}</button>
            </form>
            {move || fault.get().map(|why| view! { <p class="note bad" role="alert">{move || distance_fault(why)}</p> })}
        </section>
    }
}

/// The datum, each kind with the sentence that says what it means.
#[component]
pub fn DatumChoice() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let kinds: [(DatumKind, Text, Text); 3] = [
        (DatumKind::Control, text::datum_control, text::datum_control_means),
        (DatumKind::Minimal, text::datum_minimal, text::datum_minimal_means),
        (DatumKind::Free, text::datum_free, text::datum_free_means),
    ];
    view! {
        <section class="panel">
            <h2 class="section-head"><span>{text::datum}</span></h2>
            <fieldset class="datum">
                <legend class="visually-hidden">{text::datum}</legend>
                {kinds.into_iter().map(|(kind, name, means)| {
                    let on = move || desk.document.with(|d| d.project.datum.kind == kind);
                    view! {
                        <label class="radio" class:chosen=on>
                            <input type="radio" name="datum" prop:checked=on on:change=move |_| desk.set_datum(kind)/>
                            <span><b>{name}</b><span>{means}</span></span>
                        </label>
                    }
                }).collect_view()}
            </fieldset>
        </section>
    }
}
