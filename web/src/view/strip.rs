//! The photos at the side of the photo view, by camera, with the count of their targets.

use leptos::html::Canvas;
use leptos::prelude::*;

use super::icon::{Glyph, Icon};
use super::shell::problem_sentence;
use super::transform::Placement;
use crate::browser::canvas::{SizeWatch, Surface};
use crate::browser::picture::Picture;
use crate::format;
use crate::i18n::text;
use crate::store::{Desk, Problem};

/// A small picture, upright.
#[component]
pub fn Thumbnail(picture: Picture, orientation: u8) -> impl IntoView {
    let canvas = NodeRef::<Canvas>::new();
    let size = [f64::from(picture.width), f64::from(picture.height)];
    let [w, h] = Placement { size, orientation, scale: 1.0, shift: [0.0; 2] }.upright();
    let watch = StoredValue::new_local(None);
    canvas.on_load(move |element| {
        watch.set_value(SizeWatch::new(&element, move |element| {
            if let Some(surface) = Surface::new(element) {
                let placement = Placement::fitted(size, orientation, surface.width, surface.height);
                surface.picture(&picture, placement.affine(), false);
            }
        }));
    });
    view! { <canvas node_ref=canvas class="thumbnail" class:portrait=w < h style:aspect-ratio=format!("{w} / {h}")></canvas> }
}

/// What stands for a photo whose file is not here.
#[component]
pub fn NoThumbnail() -> impl IntoView {
    view! { <span class="thumbnail absent"><Glyph icon=Icon::Warning/></span> }
}

/// Cameras and their photos, one of them chosen.
#[component]
pub fn Strip() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let cameras = move || desk.document.with(|d| d.project.cameras.clone());
    view! {
        <nav class="strip" aria-label=text::photos>
            {move || cameras().into_iter().map(|camera| {
                let id = camera.id.clone();
                let photos = desk.document.with(|d| {
                    d.project.photos.iter().filter(|p| p.camera == id).map(|p| (p.id.clone(), p.file.clone())).collect::<Vec<_>>()
                });
                (!photos.is_empty()).then(|| view! {
                    <div class="strip-camera">
                        <b>{move || text::camera_named(&camera.id)}</b>
                        <span>{format!("{} × {}", format::count(camera.width as usize), format::count(camera.height as usize))}</span>
                        <span>{move || match camera.pixel_pitch {
                            Some(pitch) => text::pitch_um(format::fixed(pitch[0] * 1000.0, 2)),
                            None => text::pitch_unknown().to_owned(),
                        }}</span>
                    </div>
                    <ul>
                        {photos.into_iter().map(|(id, file)| view! { <StripPhoto id file/> }).collect_view()}
                    </ul>
                })
            }).collect_view()}
            <ul>
                {move || desk.left_out().into_iter().map(|problem| view! { <StripProblem problem/> }).collect_view()}
            </ul>
        </nav>
    }
}

#[component]
fn StripPhoto(id: String, file: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(id);
    let chosen = move || desk.selection.with(|s| s.photo == Some(id.get_value()));
    let count = move || {
        let found = desk.document.with(|d| d.detections.get(&id.get_value()).map(|detection| detection.targets.len()));
        found.map_or("–".to_owned(), format::count)
    };
    let small = Memo::new(move |_| desk.files.with(|files| files.get(&id.get_value()).map(|f| f.digest)));
    let stem = file.rsplit_once('.').map_or(file.clone(), |(stem, _)| stem.to_owned());
    view! {
        <li class:chosen=chosen>
            <button data-photo=id.get_value() aria-pressed=move || chosen().to_string() on:click=move |_| desk.select_photo(&id.get_value())>
                {move || {
                    small.get();
                    let file = desk.files.with_untracked(|files| files.get(&id.get_value()).cloned());
                    match file {
                        Some(file) => view! { <Thumbnail picture=file.small orientation=file.info.orientation/> }.into_any(),
                        None => view! { <NoThumbnail/> }.into_any(),
                    }
                }}
                <span class="photo-name"><b>{id.get_value()}<u>{count}</u></b>{stem}</span>
            </button>
        </li>
    }
}

#[component]
fn StripProblem(problem: Problem) -> impl IntoView {
    let file = problem.file.clone();
    view! {
        <li class="problem">
            <NoThumbnail/>
            <span class="photo-name">{file}</span>
            <span class="reason">{move || problem_sentence(&problem.reason)}</span>
        </li>
    }
}
