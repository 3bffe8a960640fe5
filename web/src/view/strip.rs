//! The photos at the side of the photo view, by camera, with the count of their targets.

use std::collections::HashMap;

use leptos::html::Canvas;
use leptos::prelude::*;
use sightline::project::{Camera, Project};

use super::components::icon::{Glyph, Icon};
use crate::browser::canvas::{SizeWatch, Surface};
use crate::browser::picture::Picture;
use crate::format;
use crate::i18n::text;
use crate::store::intake::problem_sentence;
use crate::store::{Desk, Problem};
use crate::view::components::transform::Placement;

/// A small picture, upright.
#[component]
pub fn Thumbnail(picture: Picture, orientation: u8) -> impl IntoView {
    let canvas = NodeRef::<Canvas>::new();
    let size = [f64::from(picture.width), f64::from(picture.height)];
    let [w, h] = Placement { size, orientation, scale: 1.0, shift: [0.0; 2] }.upright();
    let watch = StoredValue::new_local(None);
    canvas.on_load(move |element| {
        watch.set_value(SizeWatch::new(&element, move |element, bounds| {
            if let Some(surface) = Surface::new(element, bounds) {
                let placement = Placement::fitted(size, orientation, surface.width, surface.height);
                surface.picture(&picture, placement.affine(), false);
            }
        }));
    });
    view! { <canvas node_ref=canvas class="thumbnail" class:portrait=w < h style:aspect-ratio=format!("{w} / {h}")></canvas> }
}

/// Placeholder for a photo whose file is missing.
#[component]
pub fn NoThumbnail() -> impl IntoView {
    view! { <span class="thumbnail absent"><Glyph icon=Icon::Warning/></span> }
}

/// A camera with its photos, as the strip shows them.
#[derive(Clone, PartialEq)]
struct Group {
    camera: String,
    size: [u32; 2],
    pitch_mm: Option<f64>,
    /// Names and files.
    photos: Vec<(String, String)>,
}

/// Cameras that have photos, in the order of the document.
fn groups(project: &Project) -> Vec<Group> {
    let mut photos = HashMap::<&str, Vec<(String, String)>>::new();
    for photo in &project.photos {
        photos.entry(&photo.camera).or_default().push((photo.id.clone(), photo.file.clone()));
    }
    let group = |camera: &Camera| {
        Some(Group {
            camera: camera.id.clone(),
            size: [camera.width, camera.height],
            pitch_mm: camera.pixel_pitch.map(|pitch| pitch[0]),
            photos: photos.remove(&*camera.id)?,
        })
    };
    project.cameras.iter().filter_map(group).collect()
}

/// Cameras and their photos, one of them chosen. What is shown of a photo is made once and stays: a strip that was made anew with every change of
/// the document took most of the time of a detection in hundreds of photos.
#[component]
pub fn Strip() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = Memo::new(move |_| desk.document.with(|d| groups(&d.project)));
    let names = move || all.with(|all| all.iter().map(|group| group.camera.clone()).collect::<Vec<_>>());
    let left_out = Memo::new(move |_| desk.left_out());
    view! {
        <nav class="strip" aria-label=text::photos>
            <For each=names key=Clone::clone children=move |camera| view! { <StripCamera camera all/> }/>
            <ul>
                {move || left_out.get().into_iter().map(|problem| view! { <StripProblem problem/> }).collect_view()}
            </ul>
        </nav>
    }
}

#[component]
fn StripCamera(camera: String, all: Memo<Vec<Group>>) -> impl IntoView {
    let group = Memo::new(move |_| all.with(|all| all.iter().find(|group| group.camera == camera).cloned()));
    let head = Memo::new(move |_| group.with(|group| group.as_ref().map(|g| (g.camera.clone(), g.size, g.pitch_mm))));
    view! {
        {move || head.get().map(|(camera, [width, height], pitch_mm)| view! {
            <div class="strip-camera">
                <b>{move || text::camera_named(&camera)}</b>
                <span>{format!("{} × {}", format::count(width as usize), format::count(height as usize))}</span>
                <span>{move || match pitch_mm {
                    Some(pitch) => text::pitch_um(format::fixed(pitch * 1000.0, 2)),
                    None => text::pitch_unknown().to_owned(),
                }}</span>
            </div>
        })}
        <ul>
            <For each=move || group.get().map(|group| group.photos).unwrap_or_default() key=Clone::clone
                children=move |(id, file)| view! { <StripPhoto id file/> }/>
        </ul>
    }
}

#[component]
fn StripPhoto(id: String, file: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(id);
    let chosen = Memo::new(move |_| id.with_value(|id| desk.selection.with(|s| s.photo.as_ref() == Some(id))));
    let found = Memo::new(move |_| {
        id.with_value(|id| desk.document.with(|d| d.detections.get(id).map(|detection| detection.targets.len())))
    });
    let count = move || found.get().map_or("–".to_owned(), format::count);
    let small = Memo::new(move |_| desk.photos.files.with(|files| files.get(&id.get_value()).map(|f| f.digest)));
    let stem = file.rsplit_once('.').map_or(file.clone(), |(stem, _)| stem.to_owned());
    view! {
        <li class:chosen=chosen>
            <button data-photo=id.get_value() aria-pressed=move || chosen.get().to_string() on:click=move |_| desk.select_photo(&id.get_value())>
                {move || {
                    small.get();
                    let file = desk.photos.files.with_untracked(|files| files.get(&id.get_value()).cloned());
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
