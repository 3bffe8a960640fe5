//! Stored cameras and scale bars, and offers to use them.

use leptos::prelude::*;
use sightline::adjustment::AdjustedCamera;
use sightline::equipment::{Calibration, KnownCamera, ScaleBar, Use};
use sightline::project::{Camera, Parameter};

use super::components::icon::{Glyph, Icon};
use super::origin::{OriginNotes, read_from};
use crate::browser::{event, file};
use crate::edit::control::Unit;
use crate::format;
use crate::i18n::{Text, equipment as words, interchange as exchange, text};
use crate::store::Desk;
use crate::store::equipment::TypedBar;
use crate::view::components::parameters::parameter_cells;
use crate::view::components::parameters::parameter_name;
use crate::view::components::title::TitleBar;

#[component]
pub fn Equipment() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = desk.equipment.all;
    let sentence = move || {
        all.with(|all| {
            let calibrations = all.cameras.iter().map(|camera| camera.calibrations.len()).sum::<usize>();
            words::sentence(all.cameras.len(), calibrations, all.bars.len())
        })
    };
    let choose = move || {
        file::choose(".json,application/json", false, move |files| {
            if let Some(file) = files.into_iter().next() {
                desk.import_equipment(file);
            }
        });
    };
    view! {
        <TitleBar title=words::equipment sentence=Signal::derive(sentence)>
            <button class="button" on:click=move |_| choose()>{words::import_file}</button>
            <button class="button primary" data-action="export-equipment" on:click=move |_| desk.export_equipment()>
                <Glyph icon=Icon::Save/> {words::export_file}
            </button>
        </TitleBar>
        <main class="equipment scroll" tabindex="0" aria-label=words::equipment>
            <Removed/>
            <section class="panel">
                <h2 class="section-head"><span>{words::kept_cameras}</span></h2>
                <Show when=move || all.with(|all| all.cameras.is_empty())><p class="note">{words::no_cameras}</p></Show>
                {move || all.with(|all| all.cameras.clone()).into_iter().map(|camera| view! { <Kept camera/> }).collect_view()}
                <OfThisResult/>
                <ForThisProject/>
            </section>
            <section class="panel">
                <h2 class="section-head"><span>{words::kept_bars}</span></h2>
                <Show when=move || all.with(|all| all.bars.is_empty())><p class="note">{words::no_bars}</p></Show>
                <Bars/>
                <BarForm/>
            </section>
        </main>
    }
}

/// The last removal can be undone.
#[component]
fn Removed() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <Show when=move || desk.equipment.before.with(Option::is_some)>
            <p class="note row" role="status">
                <span>{words::removed}</span>
                <button class="button small" data-action="put-back" on:click=move |_| desk.put_equipment_back()>{words::put_back}</button>
            </p>
        </Show>
    }
}

fn camera_words(camera: &KnownCamera) -> String {
    let exif = [camera.make.clone(), camera.model.clone(), camera.focal_length_mm.map(|f| format!("{f} mm"))];
    let grid = format!("{} × {} px", format::count(camera.width as usize), format::count(camera.height as usize));
    exif.into_iter().flatten().chain([grid]).collect::<Vec<_>>().join(", ")
}

/// The parameters of a calibration in one line, those that were estimated with their standard errors.
fn values(camera: &Camera, sigma: impl Fn(Parameter) -> Option<f64>) -> String {
    let shown = |p: &Parameter| {
        let value = camera.interior.get(*p).filter(|value| *value != 0.0 || sigma(*p).is_some())?;
        let (value, sigma, unit) = parameter_cells(camera, *p, value, sigma(*p));
        let sigma = if sigma.is_empty() || sigma == "–" { String::new() } else { format!(" ± {sigma}") };
        Some(format!("{} {value}{sigma} {unit}", parameter_name(*p)))
    };
    let all = camera.interior.parameters().iter().filter(|p| **p != Parameter::F);
    all.filter_map(shown).collect::<Vec<_>>().join(";  ")
}

#[component]
fn Kept(camera: KnownCamera) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let plain = Camera::new(&camera.id, camera.width, camera.height, sightline::project::Interior::brown(1.0));
    let rows = camera.calibrations.iter().enumerate().rev().map(|(place, calibration)| {
        let mut with = plain.clone();
        calibration.apply(&mut with, Use::Held);
        let line = values(&with, |p| calibration.sigma.get(&p).copied());
        let (id, date) = (camera.id.clone(), calibration.date.clone());
        let label = date.clone();
        let origin = calibration.origin.as_deref().cloned();
        let dated = {
            let origin = origin.clone();
            move || match &origin {
                Some(origin) => read_from(origin),
                None => words::calibrated_on(&date),
            }
        };
        view! {
            <li class="calibration">
                <b>{dated}</b> <span>{line}</span> <span>{calibration.remark.clone()}</span>
                <button class="icon-button small" aria-label=move || words::remove_calibration(&label)
                    on:click=move |_| desk.remove_calibration(&id, place)><Glyph icon=Icon::Cross size=12/></button>
                {origin.map(|origin| view! { <OriginNotes origin/> })}
            </li>
        }
    });
    let rows = rows.collect_view();
    let (id, label) = (camera.id.clone(), camera.id.clone());
    view! {
        <div class="known-camera" data-known-camera=camera.id.clone()>
            <h3><b>{camera.id.clone()}</b> <span class="aside">{camera_words(&camera)}</span>
                <button class="icon-button small" aria-label=move || words::remove_camera(&label)
                    on:click=move |_| desk.remove_known_camera(&id)><Glyph icon=Icon::Cross size=12/></button>
            </h3>
            <ul>{rows}</ul>
        </div>
    }
}

/// The cameras that the present result has calibrated.
#[component]
fn OfThisResult() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let adjusted = Memo::new(move |_| desk.adjusted_cameras());
    let row = move |adjusted: AdjustedCamera| {
        let (name, key) = (adjusted.camera.id.clone(), adjusted.camera.id.clone());
        let line = values(&adjusted.camera, |p| adjusted.sigma.get(&p).copied());
        view! {
            <li class="calibration">
                <b>{adjusted.camera.id.clone()}</b> <span>{line}</span>
                <button class="button small" data-keep=key on:click=move |_| desk.keep_calibration(&name)>{words::keep_calibration}</button>
            </li>
        }
    };
    view! {
        <Show when=move || adjusted.with(|all| !all.is_empty())>
            <h3>{words::of_this_result}</h3>
            <ul>{move || adjusted.get().into_iter().map(row).collect_view()}</ul>
        </Show>
    }
}

/// Calibrations that fit cameras of the open project.
#[component]
fn ForThisProject() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let fitting = Memo::new(move |_| {
        let all = desk.document.with(|d| d.project.cameras.iter().map(|c| c.id.clone()).collect::<Vec<_>>());
        all.into_iter().filter(|id| !desk.calibrations_of(id).is_empty()).collect::<Vec<_>>()
    });
    view! {
        <Show when=move || fitting.with(|all| !all.is_empty())>
            <h3>{exchange::for_this_project}</h3>
            {move || fitting.get().into_iter().map(|id| {
                let name = id.clone();
                view! { <p class="note"><b>{move || exchange::for_camera(&name)}</b></p> <KnownCameraOffer id/> }
            }).collect_view()}
        </Show>
    }
}

#[component]
fn Bars() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let row = move |bar: ScaleBar| {
        let (id, label, key) = (bar.id.clone(), bar.id.clone(), bar.id.clone());
        view! {
            <tr data-bar=key>
                <td class="left id">{bar.id}</td><td class="left">{bar.from}</td><td class="left">{bar.to}</td>
                <td>{format::editable(bar.length)}</td><td>{format::editable(bar.sigma)}</td><td class="left">{bar.unit}</td>
                <td class="left">{bar.certificate}</td><td class="left">{bar.date}</td>
                <td class="left wide"><button class="icon-button small" aria-label=move || words::remove_bar(&label)
                    on:click=move |_| desk.remove_bar(&id)><Glyph icon=Icon::Cross size=12/></button></td>
            </tr>
        }
    };
    view! {
        <Show when=move || desk.equipment.all.with(|all| !all.bars.is_empty())>
            <div class="bars-table">
                <table class="table">
                    <thead><tr>
                        <th class="left">{words::bar_name}</th><th class="left">{text::from_point}</th><th class="left">{text::to_point}</th>
                        <th>{text::length}</th><th>"σ"</th><th class="left">{text::unit}</th><th class="left">{words::certificate}</th>
                        <th class="left">{words::date}</th><td class="left wide"></td>
                    </tr></thead>
                    <tbody>{move || desk.equipment.all.with(|all| all.bars.clone()).into_iter().map(row).collect_view()}</tbody>
                </table>
            </div>
        </Show>
    }
}

/// Field of the form for a scale bar.
type BarField = fn(&mut TypedBar) -> &mut String;

#[component]
fn BarForm() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let typed = RwSignal::new(TypedBar { unit: "mm".into(), ..TypedBar::default() });
    let fields: [(&'static str, Text, BarField); 7] = [
        ("bar-name", words::bar_name, |bar| &mut bar.id),
        ("bar-from", text::from_point, |bar| &mut bar.from),
        ("bar-to", text::to_point, |bar| &mut bar.to),
        ("bar-length", text::length, |bar| &mut bar.length),
        ("bar-sigma", || "σ", |bar| &mut bar.sigma),
        ("bar-certificate", words::certificate, |bar| &mut bar.certificate),
        ("bar-date", words::date, |bar| &mut bar.date),
    ];
    let keep = move || {
        if desk.keep_bar(&typed.get_untracked()) {
            typed.update(|bar| *bar = TypedBar { unit: std::mem::take(&mut bar.unit), ..TypedBar::default() });
        }
    };
    let field = move |(name, label, part): (&'static str, Text, BarField)| {
        let value = move || typed.with(|bar| part(&mut bar.clone()).clone());
        let hint = move || if name == "bar-date" { words::date_hint() } else { "" };
        view! {
            <label class="bar-field">
                <span>{label}</span>
                <input type="text" name=name autocomplete="off" placeholder=hint prop:value=value
                    on:input=move |e| typed.update(|bar| *part(bar) = event::value(&e))/>
            </label>
        }
    };
    view! {
        <form class="bar-form" on:submit=move |e| { e.prevent_default(); keep(); }>
            {fields.map(field).collect_view()}
            <label class="bar-field">
                <span>{text::unit}</span>
                <select name="bar-unit" on:change=move |e| typed.update(|bar| bar.unit = event::value(&e))>
                    {Unit::ALL.map(Unit::symbol).map(|name| view! { <option value=name selected=move || typed.with(|bar| bar.unit == name)>{name}</option> }).collect_view()}
                </select>
            </label>
            <button class="button small" type="submit">{words::keep_bar}</button>
        </form>
    }
}

/// Stored calibrations of a camera of the project, offered if its photos were taken with it.
#[component]
pub fn KnownCameraOffer(id: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(id);
    let offers = Memo::new(move |_| desk.calibrations_of(&id.get_value()));
    let uses: [(Use, &str, Text, Text); 3] = [
        (Use::Held, "held", words::held, words::held_means),
        (Use::Observed, "observed", words::observed, words::observed_means),
        (Use::Free, "free", words::free, words::free_means),
    ];
    let offer = move |(name, calibration): (String, Calibration)| {
        let (date, key) = (calibration.date.clone(), calibration.date.clone());
        let source = calibration.origin.as_deref().cloned();
        // Without standard errors there is nothing to observe, and nothing that was estimated.
        let count = if calibration.sigma.is_empty() { 1 } else { uses.len() };
        let calibration = StoredValue::new(calibration);
        view! {
            <div class="known-offer" data-offer=key>
                <span>{move || words::known_camera(&name, &date)} {move || source.as_ref().map(|origin| format!(" ({})", read_from(origin)))}</span>
                <span class="row">
                    {uses.into_iter().take(count).map(|(how, key, label, means)| {
                        let in_use = move || {
                            desk.document.with(|d| {
                                let camera = d.project.cameras.iter().find(|c| c.id == id.get_value());
                                camera.is_some_and(|camera| {
                                    let mut with = camera.clone();
                                    calibration.with_value(|c| c.apply(&mut with, how));
                                    with == *camera
                                })
                            })
                        };
                        view! {
                            <button class="button small" data-use=key title=means aria-pressed=move || in_use().to_string()
                                on:click=move |_| desk.use_calibration(&id.get_value(), &calibration.get_value(), how)>{label}</button>
                        }
                    }).collect_view()}
                </span>
            </div>
        }
    };
    view! { {move || offers.get().into_iter().map(offer).collect_view()} }
}

/// Scale bars that the photos show and whose distances the project lacks.
#[component]
pub fn BarsOffer() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let offered = Memo::new(move |_| desk.offered_bars());
    let names = move || {
        let name = |bar: &ScaleBar| {
            format!("{} ({} – {}, {} {})", bar.id, bar.from, bar.to, format::editable(bar.length), bar.unit)
        };
        offered.with(|all| all.iter().map(name).collect::<Vec<_>>().join(", "))
    };
    view! {
        <Show when=move || offered.with(|all| !all.is_empty())>
            <p class="note row bars-offer">
                <span>{move || words::bars_seen(names())}</span>
                <button class="button small" data-action="take-bars" on:click=move |_| desk.take_bars()>{words::take_bars}</button>
            </p>
        </Show>
    }
}
