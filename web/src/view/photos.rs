//! Step 1: the photos, and the cameras they were taken with.

use std::collections::BTreeSet;

use leptos::prelude::*;
use sightline::project::Camera;

use super::calibrating::ProposedModel;
use super::components::field::Field;
use super::components::icon::{Glyph, Icon};
use super::equipment::KnownCameraOffer;
use super::models::ModelMenu;
use super::origin::ProjectOrigin;
use super::rig::RigPanel;
use super::strip::{NoThumbnail, Thumbnail};
use crate::browser::event;
use crate::edit::cameras::distance_parameter;
use crate::format;
use crate::i18n::{equipment, first, interchange, monitoring, planning, text};
use crate::store::intake::problem_sentence;
use crate::store::{Desk, Problem, Reason, Step};
use crate::view::components::choosing::choose_photos;
use crate::view::components::title::TitleBar;

#[component]
pub fn Photos() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let picked = RwSignal::new(BTreeSet::<String>::new());
    let sentence = move || {
        let (photos, cameras) = desk.document.with(|d| (d.project.photos.len(), d.project.cameras.len()));
        text::photos_sentence(format::count(photos), format::count(cameras))
    };
    let cameras =
        Memo::new(move |_| desk.document.with(|d| d.project.cameras.iter().map(|c| c.id.clone()).collect::<Vec<_>>()));
    let any = Memo::new(move |_| desk.document.with(|d| !d.project.photos.is_empty()));
    view! {
        <TitleBar title=text::photos sentence=Signal::derive(sentence)>
            <button class="button" on:click=move |_| choose_photos(desk)>{text::add_photos}</button>
            <button class="button" data-open="equipment" on:click=move |_| desk.go(Step::Equipment)>{equipment::equipment}</button>
            <Show when=move || any.get()>
                <button class="button" data-open="files" title=interchange::files_for_others
                    on:click=move |_| desk.go(Step::Files)>{interchange::files}</button>
            </Show>
            <button class="button" data-open="plan" on:click=move |_| desk.go(Step::Plan)>{planning::plan}</button>
            <Show when=move || any.get()>
                <button class="button primary" on:click=move |_| desk.go(Step::Targets)>
                    {text::on_to_targets} <Glyph icon=Icon::Arrow/>
                </button>
            </Show>
        </TitleBar>
        <main class="photos">
            <div class="gallery scroll">
                <Problems/>
                <Show when=move || !any.get() && desk.intake.coming.with(Vec::is_empty)>
                    <div class="empty-state" data-empty="photos">
                        <h2>{first::no_photos}</h2>
                        <p>{move || desk.document.with(|d| match &d.project.epoch {
                            Some(epoch) => monitoring::next_epoch_photos(&epoch.name),
                            None => first::drop_here().to_owned(),
                        })}</p>
                        <button class="button large primary" on:click=move |_| choose_photos(desk)>{text::choose_photos}</button>
                        <p class="fine">{text::formats}</p>
                    </div>
                </Show>
                {move || cameras.get().into_iter().map(|camera| view! { <Gallery camera picked/> }).collect_view()}
                <Coming/>
            </div>
            <aside class="side scroll" aria-label=text::cameras>
                <ProjectOrigin/>
                <Picked picked/>
                {move || cameras.get().into_iter().map(|camera| view! { <CameraPanel id=camera/> }).collect_view()}
                <RigPanel/>
            </aside>
        </main>
    }
}

/// The photos of one camera.
#[component]
fn Gallery(camera: String, picked: RwSignal<BTreeSet<String>>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let name = camera.clone();
    let photos = Memo::new(move |_| {
        desk.document.with(|d| {
            let of = d.project.photos.iter().filter(|p| p.camera == camera);
            of.map(|p| (p.id.clone(), p.file.clone(), p.enabled)).collect::<Vec<_>>()
        })
    });
    view! {
        <Show when=move || !photos.with(Vec::is_empty)>
            <h2 class="section-head">
                <span>{text::camera_named(&name)}</span>
                <span class="aside">{move || text::photo_count(format::count(photos.with(Vec::len)))}</span>
            </h2>
        </Show>
        <ul class="tiles">
            {move || photos.get().into_iter().map(|(id, file, enabled)| view! { <Tile id file enabled picked/> }).collect_view()}
        </ul>
    }
}

/// The photos that are being read, with their embedded previews.
#[component]
fn Coming() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let names = Memo::new(move |_| {
        desk.intake.coming.with(|all| all.iter().map(|photo| photo.name.clone()).collect::<Vec<_>>())
    });
    let tile = move |(place, name): (usize, String)| {
        let here = Memo::new(move |_| {
            desk.intake.coming.with(|all| all.get(place).is_some_and(|photo| photo.picture.is_some()))
        });
        let picture = move || {
            here.get();
            let picture = desk.intake.coming.with_untracked(|all| all.get(place)?.picture.clone());
            picture.map(|(picture, orientation)| view! { <Thumbnail picture orientation/> })
        };
        view! {
            <li class="coming-tile">
                <span class="frame">{picture}</span>
                <span class="tile-name">{name}</span>
            </li>
        }
    };
    view! {
        <Show when=move || !names.with(Vec::is_empty)>
            <h2 class="section-head">
                <span>{text::being_read}</span>
                <span class="aside">{move || text::photo_count(format::count(names.with(Vec::len)))}</span>
            </h2>
            <ul class="tiles" aria-busy="true">{move || names.get().into_iter().enumerate().map(tile).collect_view()}</ul>
        </Show>
    }
}

#[component]
fn Tile(id: String, file: String, enabled: bool, picked: RwSignal<BTreeSet<String>>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(id);
    let chosen = move || picked.with(|p| p.contains(&id.get_value()));
    let digest = Memo::new(move |_| desk.photos.files.with(|files| files.get(&id.get_value()).map(|f| f.digest)));
    let choose = move |e: leptos::ev::MouseEvent| {
        let id = id.get_value();
        desk.select_photo(&id);
        picked.update(|all| {
            let more = e.ctrl_key() || e.meta_key() || e.shift_key();
            let had = all.contains(&id);
            let only = all.len() == 1;
            if !more {
                all.clear();
            }
            if had && (more || only) {
                all.remove(&id);
            } else {
                all.insert(id);
            }
        });
    };
    view! {
        <li>
            <button class="tile" class:chosen=chosen class:off=!enabled aria-pressed=move || chosen().to_string() on:click=choose
                on:dblclick=move |_| desk.go(Step::Targets)>
                <span class="frame">
                    {move || {
                        digest.get();
                        match desk.photos.files.with_untracked(|files| files.get(&id.get_value()).cloned()) {
                            Some(file) => view! { <Thumbnail picture=file.small orientation=file.info.orientation/> }.into_any(),
                            None => view! { <NoThumbnail/> }.into_any(),
                        }
                    }}
                </span>
                <span class="tile-name"><b>{id.get_value()}</b> {file}</span>
            </button>
        </li>
    }
}

/// Actions for the photos selected in the gallery.
#[component]
fn Picked(picked: RwSignal<BTreeSet<String>>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let own = "\u{0}own";
    let assign = move |e: leptos::ev::Event| {
        let value = event::value(&e);
        let photos = picked.get_untracked();
        match value.as_str() {
            "" => {}
            v if v == own => desk.assign_own_camera(&photos),
            camera => desk.assign_camera(&photos, camera),
        }
    };
    let common = move || {
        picked.with(|p| {
            desk.document.with(|d| {
                let mut cameras =
                    d.project.photos.iter().filter(|photo| p.contains(&photo.id)).map(|photo| &photo.camera);
                let first = cameras.next()?.clone();
                cameras.all(|c| *c == first).then_some(first)
            })
        })
    };
    let cameras = move || desk.document.with(|d| d.project.cameras.iter().map(|c| c.id.clone()).collect::<Vec<_>>());
    let enabled = move || {
        picked.with(|p| {
            desk.document.with(|d| d.project.photos.iter().all(|photo| !p.contains(&photo.id) || photo.enabled))
        })
    };
    view! {
        <Show when=move || picked.with(|p| !p.is_empty())>
            <h2 class="section-head"><span>{move || text::picked_photos(picked.with(BTreeSet::len))}</span></h2>
            <div class="fields">
                <label class="field">
                    <span>{text::camera}</span>
                    <select on:change=assign>
                        {move || {
                            let now = common();
                            let none = now.is_none();
                            view! {
                                <Show when=move || none><option value="" selected=true>"–"</option></Show>
                                {cameras().into_iter().map(|camera| {
                                    let selected = Some(&camera) == now.as_ref();
                                    view! { <option value=camera.clone() selected=selected>{camera.clone()}</option> }
                                }).collect_view()}
                                <option value=own>{text::camera_of_their_own}</option>
                            }
                        }}
                    </select>
                </label>
                <label class="tick">
                    <input type="checkbox" prop:checked=enabled on:change=move |e| desk.switch_photos(&picked.get_untracked(), event::checked(&e))/>
                    <span>{text::take_part}</span>
                </label>
                <button class="link bad" on:click=move |_| {
                    let photos = picked.get_untracked();
                    picked.set(BTreeSet::new());
                    desk.remove_photos(&photos);
                }>{text::remove_from_project}</button>
            </div>
        </Show>
    }
}

/// A camera: its EXIF data and initial values.
#[component]
fn CameraPanel(id: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(id);
    let camera =
        Memo::new(move |_| desk.document.with(|d| d.project.cameras.iter().find(|c| c.id == id.get_value()).cloned()));
    let info = move || {
        let photo = desk
            .document
            .with(|d| d.project.photos.iter().find(|p| p.camera == id.get_value()).map(|p| p.id.clone()))?;
        desk.photos.files.with(|files| files.get(&photo).map(|f| f.info.clone()))
    };
    let model = move || {
        let info = info()?;
        let words = [info.make, info.model].into_iter().flatten().collect::<Vec<_>>().join(" ");
        (!words.is_empty()).then_some(words)
    };
    let lens = move || {
        let info = info()?;
        let mm = info.focal_length_mm.map(|f| format!("{} mm", format::fixed(f, 1)));
        let film = info.focal_length_35mm.map(|f| text::film_equivalent(format::fixed(f, 0)));
        let words = mm.into_iter().chain(film).collect::<Vec<_>>().join(", ");
        (!words.is_empty()).then_some(words)
    };
    let corrections = move || {
        let photo = desk
            .document
            .with(|d| d.project.photos.iter().find(|p| p.camera == id.get_value()).map(|p| p.id.clone()))?;
        desk.photos.files.with(|files| files.get(&photo).and_then(|f| super::corrections::sentence(&f.name, &f.info)))
    };
    let exif = move |value: Option<String>| value.unwrap_or_else(|| text::not_in_exif().to_owned());
    let unit = move || if camera.with(|c| c.as_ref().is_some_and(|c| c.pixel_pitch.is_some())) { "mm" } else { "px" };
    let with = move |read: fn(&Camera) -> String| camera.with(|c| c.as_ref().map(read).unwrap_or_default());
    view! {
        <h2 class="section-head">
            <span>{text::camera_named(id.get_value())}</span>
            <span class="aside">{move || with(|c| format!("{} × {}", format::count(c.width as usize), format::count(c.height as usize)))}</span>
        </h2>
        <KnownCameraOffer id=id.get_value()/>
        <dl class="pairs">
            <dt>{text::make_and_model}</dt><dd>{move || exif(model())}</dd>
            <dt>{text::focal_length}</dt><dd>{move || exif(lens())}</dd>
        </dl>
        <div class="fields">
            {move || corrections().map(|text| view! { <p class="hint" data-result="corrections">{text}</p> })}
            <label class="field">
                <span>{text::name}</span>
                <Field value=Signal::stored(id.get_value()) commit=move |typed: String| desk.rename_camera(&id.get_value(), &typed) attr:data-field="name"/>
            </label>
            <ModelMenu camera=id.get_value()/>
            <ProposedModel camera=id.get_value()/>
            <label class="field">
                <span>{text::pixel_pitch} " " <u>"µm"</u></span>
                <Field value=Signal::derive(move || with(|c| c.pixel_pitch.map(pitch_text).unwrap_or_default()))
                    commit=move |typed: String| desk.set_pitch(&id.get_value(), &typed)
                    attr:inputmode="decimal" attr:placeholder=text::unknown attr:data-field="pitch"/>
            </label>
            <label class="field">
                <span>{text::principal_distance} " " <u>{unit}</u></span>
                <Field value=Signal::derive(move || with(|c| c.interior.get(distance_parameter(c)).map(format::editable).unwrap_or_default()))
                    commit=move |typed: String| desk.set_principal_distance(&id.get_value(), &typed)
                    attr:inputmode="decimal" attr:data-field="c" attr:placeholder=text::found_by_orientation/>
            </label>
            <Show when=move || unit() == "px"><p class="hint">{text::pitch_hint}</p></Show>
        </div>
    }
}

fn pitch_text([x, y]: [f64; 2]) -> String {
    let um = |p: f64| format::editable((p * 1e9).round() / 1e6);
    if (x - y).abs() < 1e-12 { um(x) } else { format!("{} × {}", um(x), um(y)) }
}

fn is_other_of_a_shot(problem: &Problem) -> bool {
    matches!(problem.reason, Reason::RawOf { .. } | Reason::Developed { .. })
}

/// Files that were not taken, each with its reason.
#[component]
pub fn Problems() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <Show when=move || desk.intake.problems.with(|p| !p.is_empty())>
            <h2 class="section-head">
                <span>{text::not_taken}</span>
                <Show when=move || desk.left_out().iter().any(is_other_of_a_shot)>
                    <button class="link" data-action="swap" on:click=move |_| desk.swap_shots()>
                        {move || match desk.left_out().iter().any(|p| matches!(p.reason, Reason::RawOf { .. })) {
                            true => text::measure_raw(),
                            false => text::measure_developed(),
                        }}
                    </button>
                </Show>
                <button class="link" on:click=move |_| desk.intake.problems.set(Vec::new())>{text::dismiss}</button>
            </h2>
            <ul class="problems">
                {move || desk.left_out().into_iter().map(|Problem { file, reason }| view! {
                    <li><Glyph icon=Icon::Warning/><b>{file}</b><span>{move || problem_sentence(&reason)}</span></li>
                }).collect_view()}
            </ul>
        </Show>
    }
}
