//! The camera of the plan: one of the project's, or from the metadata of a photo.

use leptos::prelude::*;

use crate::browser::{event, file};
use crate::edit::plan;
use crate::i18n::planning as words;
use crate::store::Desk;

/// Ways to a camera that need no typing.
#[component]
pub fn KnownCameras() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let known = Memo::new(move |_| {
        desk.document.with(|d| {
            let ready = d.project.cameras.iter().filter(|c| plan::is_known(c));
            ready.map(|c| c.id.clone()).collect::<Vec<_>>()
        })
    });
    let chosen = Memo::new(move |_| desk.document.with(|d| Some(d.project.plan.as_ref()?.cameras.first()?.id.clone())));
    view! {
        <Show when=move || known.with(|all| !all.is_empty())>
            <label class="field">
                <span>{words::of_project}</span>
                <select name="camera" on:change=move |e| desk.plan_with_camera(&event::value(&e))>
                    <option value="" selected=move || chosen.get().is_none_or(|id| known.with(|all| !all.contains(&id)))>"–"</option>
                    {move || known.get().into_iter().map(|id| {
                        let (value, own) = (id.clone(), id.clone());
                        view! { <option value=value selected=move || chosen.get().as_ref() == Some(&own)>{id}</option> }
                    }).collect_view()}
                </select>
            </label>
        </Show>
        <button class="button small" data-action="camera-photo" on:click=move |_| {
            file::choose(".jpg,.jpeg,.png,.tif,.tiff,.heic,.heif,.dng,image/*", false, move |files| {
                if let Some(photo) = files.into_iter().next() {
                    desk.plan_with_photo(photo);
                }
            });
        }>{words::camera_from_photo}</button>
    }
}
