//! Calibrating a camera: board or sheet, photos with what they cover, the result, files.

use leptos::prelude::*;
use sightline::calibration::{Coverage, CoverageLack, CrossValidation, CrossVerdict, diagonal_field, proposed_models};

use super::components::icon::{Glyph, Icon};
use super::models::{ModelComparison, ModelMenu};
use crate::format;
use crate::i18n::{calibrating as words, text};
use crate::store::{Desk, Step};
use crate::view::components::choosing::choose_photos;
use crate::view::components::parameters::model_name;
use crate::view::components::title::TitleBar;

#[component]
pub fn Calibrate() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sentence = move || {
        let (photos, measured) = desk.document.with(|d| (d.project.photos.len(), d.project.observations.len()));
        match photos {
            0 => words::nothing_yet().to_owned(),
            _ => words::sentence(photos, format::count(measured)),
        }
    };
    let cameras =
        Memo::new(move |_| desk.document.with(|d| d.project.cameras.iter().map(|c| c.id.clone()).collect::<Vec<_>>()));
    let any = Memo::new(move |_| desk.document.with(|d| !d.project.photos.is_empty()));
    view! {
        <TitleBar title=words::calibrate sentence=Signal::derive(sentence)>
            <Show when=move || any.get()>
                <button class="button primary" data-action="adjust" disabled=move || desk.tasks.job.with(Option::is_some) on:click=move |_| desk.adjust()>{text::adjust_now}</button>
            </Show>
        </TitleBar>
        <main class="files calibrating scroll" tabindex="0" aria-label=words::calibrate>
            <section class="panel" data-part="object">
                <h2 class="section-head"><span>{words::object}</span></h2>
                <p class="note">{words::object_words}</p>
                <div class="row note">
                    <button class="button" on:click=move |_| desk.go(Step::Print)>{words::print}</button>
                    <button class="button" on:click=move |_| desk.go(Step::Control)>{words::load_control}</button>
                    <Show when=move || any.get()>
                        <button class="button" on:click=move |_| desk.go(Step::Identities)>{words::name_dots}</button>
                    </Show>
                </div>
            </section>
            <section class="panel" data-part="photos">
                <h2 class="section-head"><span>{words::photos}</span></h2>
                <p class="note">{words::photos_words}</p>
                <div class="row note">
                    <button class="button" class:primary=move || !any.get() on:click=move |_| choose_photos(desk)>{text::choose_photos}</button>
                    <Show when=move || any.get()>
                        <button class="button" on:click=move |_| desk.go(Step::Targets)>{words::detect}</button>
                    </Show>
                </div>
                {move || cameras.get().into_iter().map(|camera| view! { <Covered camera/> }).collect_view()}
            </section>
            <section class="panel" data-part="result">
                <h2 class="section-head"><span>{words::result}</span></h2>
                {move || cameras.get().into_iter().map(|camera| view! {
                    <h3 class="note">{text::camera_named(&camera)}</h3>
                    <div class="fields"><ModelMenu camera=camera.clone()/></div>
                    <ProposedModel camera=camera.clone()/>
                    <table class="table"><tbody><ModelComparison camera=camera.clone()/></tbody></table>
                }).collect_view()}
                <div class="row note">
                    <button class="button" on:click=move |_| desk.go(Step::Adjust)>{words::to_adjustment}</button>
                    <Show when=move || desk.document.with(|d| d.current().is_some())>
                        <button class="button" on:click=move |_| desk.go(Step::Results)>{words::to_results} <Glyph icon=Icon::Arrow/></button>
                    </Show>
                </div>
            </section>
            <section class="panel" data-part="files">
                <h2 class="section-head"><span>{words::files}</span></h2>
                <p class="note">{words::files_words}</p>
                <div class="row note">
                    <button class="button" on:click=move |_| desk.go(Step::Files)>{words::to_files}</button>
                </div>
            </section>
        </main>
    }
}

/// Coverage of the image by the targets of a camera's photos, updated when the document changes.
#[component]
fn Covered(camera: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(camera);
    let measured = Memo::new(move |_| desk.document.with(|d| !d.project.observations.is_empty()));
    Effect::new(move || {
        desk.document.track();
        if measured.get() && desk.coverage_of(&id.get_value()).is_none() {
            desk.look_at_coverage(&id.get_value());
        }
    });
    move || {
        let found = desk.coverage_of(&id.get_value())?;
        Some(view! { <Shown found=(*found).clone()/> })
    }
}

fn lack_words(lack: CoverageLack, found: &Coverage) -> String {
    match lack {
        CoverageLack::Photos => words::lack_photos(found.photos),
        CoverageLack::Radius => words::lack_radius().to_owned(),
        CoverageLack::Cells => words::lack_cells().to_owned(),
        CoverageLack::Roll => words::lack_roll().to_owned(),
        CoverageLack::Tilt => words::lack_tilt().to_owned(),
        _ => String::new(),
    }
}

#[component]
fn Shown(found: Coverage) -> impl IntoView {
    let name = found.camera.clone();
    let key = name.clone();
    let rings = found.rings.iter().enumerate().map(|(k, n)| {
        let width = 100 / found.rings.len().max(1);
        (format!("{}–{} %", k * width, (k + 1) * width), *n)
    });
    let rings: Vec<(String, usize)> = rings.collect();
    let rolls: Vec<(String, usize)> =
        found.rolls.iter().enumerate().map(|(k, n)| (format!("{}°", 90 * k), *n)).collect();
    let tilts: Vec<(String, usize)> = ["0–15°", "15–30°", "30–45°", "45–90°"]
        .iter()
        .zip(found.tilts)
        .map(|(name, n)| ((*name).to_owned(), n))
        .collect();
    let oriented = found.oriented > 0;
    let reach = format::fixed(100.0 * found.reach, 0);
    let lacks = found.lacks.clone();
    view! {
        <div data-result="coverage" data-camera=key>
            <h3 class="note">{move || format!("{} · {}", words::covered(), text::camera_named(&name))}</h3>
            <Bars head=words::by_radius rows=rings of="radius"/>
            {oriented.then(|| view! { <Bars head=words::by_roll rows=rolls of="roll"/> <Bars head=words::by_tilt rows=tilts of="tilt"/> })}
            {(!oriented).then(|| view! { <p class="hint">{words::not_oriented}</p> })}
            <p class="hint">{move || words::reach(&reach)}</p>
            {lacks.is_empty().then(|| view! { <p class="hint">{words::covers_all}</p> })}
            <ul class="note">
                {lacks.into_iter().map(|lack| {
                    let found = found.clone();
                    view! { <li class="warn" data-lack=format!("{lack:?}").to_lowercase()>{move || lack_words(lack, &found)}</li> }
                }).collect_view()}
            </ul>
        </div>
    }
}

/// Counts as bars with their numbers.
#[component]
fn Bars(head: crate::i18n::Text, rows: Vec<(String, usize)>, of: &'static str) -> impl IntoView {
    let most = rows.iter().map(|(_, n)| *n).max().unwrap_or(0).max(1);
    view! {
        <table class="table counted" data-bars=of>
            <thead><tr><th class="left wide" colspan="3">{head}</th></tr></thead>
            <tbody>{rows.into_iter().map(|(name, n)| view! {
                <tr>
                    <td class="left">{name}</td><td>{format::count(n)}</td>
                    <td class="left wide"><i class="counted-bar" style:width=format!("{}%", 100 * n / most)></i></td>
                </tr>
            }).collect_view()}</tbody>
        </table>
    }
}

/// The camera model suggested by the focal length in the photos' files: offered, never set automatically.
#[component]
pub fn ProposedModel(camera: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(camera);
    let proposal = Memo::new(move |_| {
        let (camera, photo) = desk.document.with(|d| {
            let camera = d.project.cameras.iter().find(|c| c.id == id.get_value())?.clone();
            let photo = d.project.photos.iter().find(|p| p.camera == camera.id).map(|p| p.id.clone())?;
            Some((camera, photo))
        })?;
        let distance = desk.photos.files.with(|files| {
            let info = &files.get(&photo)?.info;
            info.principal_distance_px(camera.width, camera.height)
        })?;
        let models = proposed_models(&camera, distance);
        (!models.is_empty()).then_some((diagonal_field(&camera, distance)?, models))
    });
    move || {
        let (field, models) = proposal.get()?;
        let names = models.iter().map(|model| model_name(model)).collect::<Vec<_>>().join(", ");
        Some(view! {
            <p class="note warn" data-result="proposed-model">{words::proposed(format::fixed(field, 0), names)}</p>
            <div class="row note">
                {models.into_iter().map(|model| view! {
                    <button class="button small" data-propose=model on:click=move |_| desk.choose_model(&id.get_value(), model)>{words::propose_use(model_name(model))}</button>
                }).collect_view()}
            </div>
        })
    }
}

/// The halves of the photos against each other: the button, the verdict, predicted and observed difference in one scale.
#[component]
pub fn CrossCheck(camera: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(camera);
    view! {
        <button class="button" data-action="cross-validate" title=words::cross_why on:click=move |_| desk.cross_validate(&id.get_value())>{words::cross}</button>
        {move || desk.cross_validation_of(&id.get_value()).map(|found| view! { <Crossed found=(*found).clone()/> })}
    }
}

/// Upper ends of the classes of the maps, pixels.
const CLASSES: [f64; 6] = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5];

#[component]
fn Crossed(found: CrossValidation) -> impl IntoView {
    let ratio = |value: Option<f64>| value.map_or("–".to_owned(), |value| format::fixed(value, 1));
    let limit = format::fixed(found.limit, 1);
    let (code, said) = match found.verdict {
        CrossVerdict::Agrees => ("agrees", words::agrees(ratio(found.ratio), limit)),
        CrossVerdict::LargerNoise => ("larger_noise", words::larger_noise(ratio(found.ratio), limit)),
        CrossVerdict::WrongModel => ("wrong_model", words::wrong_model(ratio(found.ratio), limit)),
    };
    let worst = found.worst.as_ref().map(|worst| words::worst(format::fixed(worst.u, 0), format::fixed(worst.v, 0)));
    let is_bad = found.verdict != CrossVerdict::Agrees;
    view! {
        <div data-result="cross-validation" data-verdict=code>
            <p class="note" class:warn=is_bad role="status">{said} " " {worst}</p>
            <div class="maps">
                <Map name=words::predicted values=found.predicted.clone() covered=found.covered.clone()/>
                <Map name=words::observed values=found.observed.clone() covered=found.covered.clone()/>
            </div>
            <MapKey/>
            <p class="hint">{words::map_words}</p>
        </div>
    }
}

/// The classes of the maps.
#[component]
pub(super) fn MapKey() -> impl IntoView {
    let edges = [CLASSES.map(words::up_to).to_vec(), vec![words::beyond(CLASSES[CLASSES.len() - 1])]].concat();
    view! {
        <p class="hint map-key">{edges.into_iter().enumerate().map(|(k, edge)| view! {
            <span><i class=format!("map-class map-{k}")></i>{edge}</span>
        }).collect_view()}</p>
    }
}

/// A map over the picture, a cell a place of the grid.
#[component]
pub(super) fn Map(name: crate::i18n::Text, values: Vec<Vec<Option<f64>>>, covered: Vec<Vec<bool>>) -> impl IntoView {
    let (rows, columns) = (values.len(), values.first().map_or(0, Vec::len));
    let class = |value: Option<f64>| match value {
        Some(value) => format!("map-{}", CLASSES.iter().filter(|end| value > **end).count()),
        None => "map-none".to_owned(),
    };
    let cell = |row: usize, column: usize| {
        let is_covered = covered.get(row).and_then(|r| r.get(column)).copied().unwrap_or(false);
        view! {
            <rect class=class(values[row][column]) x=column * 10 y=row * 10 width="10.2" height="10.2"></rect>
            {(!is_covered).then(|| view! { <path class="map-open" d=format!("M{} {}l10 -10", column * 10, row * 10 + 10)></path> })}
        }
    };
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let cells = cells.map(|(row, column)| cell(row, column)).collect_view();
    view! {
        <figure class="map">
            <figcaption>{name}</figcaption>
            <svg viewBox=format!("0 0 {} {}", columns * 10, rows * 10) role="img" aria-label=name>{cells}</svg>
        </figure>
    }
}
