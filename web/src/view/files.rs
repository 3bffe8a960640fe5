//! Files for other programs, by what people do with them: a calibrated camera, the whole network, points, drawings. What a conversion leaves
//! is stated before a file is handed over.

use leptos::prelude::*;

use super::components::icon::{Glyph, Icon};
use super::origin::{ConversionLine, ignored_words};
use crate::browser::event;
use crate::document::Document;
use crate::i18n::{Text, errors, interchange as words, lists};
use crate::store::Desk;
use crate::store::foreign::{Prepared, Wanted, asks_to_convert};
use crate::view::components::title::TitleBar;

/// Name of a format in the interface of the engine, its name for users, and its content.
type WrittenFile = (&'static str, &'static str, Text);

const CAMERAS: [WrittenFile; 7] = [
    ("opencv", "OpenCV", words::opencv_means),
    ("ros", "ROS", words::ros_means),
    ("kalibr", "Kalibr", words::kalibr_means),
    ("mrcal", "mrcal", words::mrcal_means),
    ("agisoft-lens", "Metashape, Agisoft Lens", words::agisoft_means),
    ("micmac", "MicMac", words::micmac_means),
    ("colmap", "COLMAP", words::colmap_camera_means),
];
const NETWORKS: [WrittenFile; 7] = [
    ("colmap", "COLMAP", words::colmap_means),
    ("colmap-binary", "COLMAP, binary", words::colmap_binary_means),
    ("metashape", "Metashape", words::metashape_means),
    ("meshroom", "Meshroom", words::meshroom_means),
    ("bundler", "Bundler", words::bundler_means),
    ("bal", "BAL", words::bal_means),
    ("opencv", "OpenCV", words::opencv_points_means),
];
const POINTS: [WrittenFile; 7] = [
    ("spreadsheet", "CSV", lists::spreadsheet_means),
    ("spreadsheet-cp949", "CSV, CP949", lists::spreadsheet_cp949_means),
    ("csv", "CSV", words::tables_means),
    ("tsv", "TSV", words::tabs_means),
    ("control-csv", "CSV", words::control_means),
    ("landxml", "LandXML", lists::landxml_means),
    ("vstars", "V-STARS", words::vstars_means),
];
const RECORD: WrittenFile = ("calibration", "CSV, JSON", lists::calibration_means);
const DRAWINGS: [WrittenFile; 4] = [
    ("dxf-2010", "DXF 2010", lists::dxf_2010_means),
    ("dxf", "DXF 12", words::dxf_means),
    ("ply", "PLY", words::ply_means),
    ("gltf", "glTF", words::gltf_means),
];

#[component]
pub fn Files() -> impl IntoView {
    let desk = expect_context::<Desk>();
    // Files of a document that has changed are not handed over.
    Effect::new(move || {
        desk.document.track();
        desk.other_programs.prepared.update(|all| all.clear());
    });
    let sentence = move || match desk.document.with(Document::out_of_date) {
        true => words::files_stale(),
        false => words::files_sentence(),
    };
    view! {
        <TitleBar title=words::files_for_others sentence=Signal::derive(move || sentence().to_owned())/>
        <main class="files scroll" tabindex="0" aria-label=words::files_for_others>
            <Cameras/>
            <section class="panel" data-group="network">
                <h2 class="section-head"><span>{words::whole_network}</span></h2>
                <ul>{NETWORKS.map(|row| view! { <Item row wanted=Signal::stored(Wanted::Network(row.0.to_owned()))/> }).collect_view()}</ul>
            </section>
            <section class="panel" data-group="points">
                <h2 class="section-head"><span>{words::points}</span></h2>
                <ul>{POINTS.map(|row| view! { <Direct row/> }).collect_view()}</ul>
            </section>
            <section class="panel" data-group="cad">
                <h2 class="section-head"><span>{words::cad}</span></h2>
                <ul>{DRAWINGS.map(|row| view! { <Direct row/> }).collect_view()}</ul>
            </section>
        </main>
    }
}

#[component]
fn Cameras() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all =
        Memo::new(move |_| desk.document.with(|d| d.project.cameras.iter().map(|c| c.id.clone()).collect::<Vec<_>>()));
    let chosen = RwSignal::new(String::new());
    // One that is there, whatever was chosen before.
    let camera = Memo::new(move |_| {
        all.with(|all| all.iter().find(|id| **id == chosen.get()).or(all.first()).cloned().unwrap_or_default())
    });
    let adjusted = Memo::new(move |_| desk.outgoing_camera(&camera.get()).is_some_and(|(_, o)| o.covariance.is_some()));
    view! {
        <section class="panel" data-group="camera">
            <h2 class="section-head">
                <span>{words::calibrated_camera}</span>
                <span class="aside">{move || (!all.with(Vec::is_empty)).then(|| if adjusted.get() { words::values_adjusted() } else { words::values_given() })}</span>
            </h2>
            <Show when=move || all.with(Vec::is_empty)><p class="note">{words::no_camera_yet}</p></Show>
            <Show when=move || all.with(|all| all.len() > 1)>
                <label class="files-camera"><span>{words::camera}</span>
                    <select name="files-camera" on:change=move |e| chosen.set(event::value(&e))>
                        {move || all.get().into_iter().map(|id| view! {
                            <option value=id.clone() selected={ let id = id.clone(); move || camera.get() == id }>{id.clone()}</option>
                        }).collect_view()}
                    </select>
                </label>
            </Show>
            <Show when=move || !all.with(Vec::is_empty)>
                <ul>{CAMERAS.map(|row| view! {
                    <Item row wanted=Signal::derive(move || Wanted::Camera(camera.get(), row.0.to_owned()))/>
                }).collect_view()}<Direct row=RECORD/></ul>
            </Show>
        </section>
    }
}

/// Files that nothing is converted for.
#[component]
fn Direct(row: WrittenFile) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let (format, name, means) = row;
    view! {
        <li class="file-row">
            <b>{name}</b> <span>{means}</span>
            <button class="button small" data-export=format aria-label=move || words::download_format(name)
                on:click=move |_| desk.export(format)><Glyph icon=Icon::Save size=14/> {words::download}</button>
        </li>
    }
}

/// Files that are prepared first: what the conversion leaves is read before they are downloaded.
#[component]
fn Item(row: WrittenFile, wanted: Signal<Wanted>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let (format, name, means) = row;
    let prepared = move || desk.other_programs.prepared.with(|all| all.get(&wanted.with(Wanted::key)).cloned());
    let button = move || {
        match prepared() {
        Some(Prepared::Waiting) => view! { <span class="aside" aria-busy="true">{words::preparing}</span> }.into_any(),
        Some(Prepared::Ready(..)) => view! {
            <button class="button small primary" data-download=format aria-label=move || words::download_format(name)
                on:click=move |_| desk.hand_over_prepared(&wanted.get_untracked())><Glyph icon=Icon::Save size=14/> {words::download}</button>
        }
        .into_any(),
        _ => view! {
            <button class="button small" data-prepare=format aria-label=move || words::prepare_format(name)
                on:click=move |_| desk.prepare(&wanted.get_untracked(), false)>{words::prepare}</button>
        }
        .into_any(),
    }
    };
    let stated = move || match prepared()? {
        Prepared::Waiting => None,
        Prepared::Ready(written, _) => {
            let covariance = written.names.iter().any(|name| name.ends_with("covariance.json"));
            let (exact, ignored) = (written.conversions.is_empty(), written.ignored);
            let any = !ignored.is_empty();
            Some(
                view! {
                    <ul class="stated" role="status">
                        {exact.then(|| view! { <li>{words::exact}</li> })}
                        {written.conversions.into_iter().map(|conversion| view! { <ConversionLine conversion/> }).collect_view()}
                        {covariance.then(|| view! { <li>{words::converted_covariance}</li> })}
                        {any.then(|| view! { <li>{move || words::no_place(ignored_words(&ignored))}</li> })}
                    </ul>
                }
                .into_any(),
            )
        }
        Prepared::Refused(error) => {
            let converts = asks_to_convert(&error);
            Some(
                view! {
                    <ul class="stated" role="alert">
                        <li class="bad">{move || errors::sentence(&error)}</li>
                        {converts.then(|| view! { <li><button class="button small" data-convert=format
                            on:click=move |_| desk.prepare(&wanted.get_untracked(), true)>{words::write_anyway}</button></li> })}
                    </ul>
                }
                .into_any(),
            )
        }
    };
    view! { <li class="file-row"><b>{name}</b> <span>{means}</span> {button} {stated}</li> }
}
