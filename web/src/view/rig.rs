//! Cameras fixed to each other: which photos were taken together, how well the mount keeps, and what the adjustment found.

use leptos::prelude::*;
use sightline::project::Rig;

use super::components::field::Field;
use crate::edit::rig;
use crate::format;
use crate::i18n::{mounted as words, text};
use crate::store::Desk;

/// Stands below the cameras where there are two or more, or where there is a rig.
#[component]
pub fn RigPanel() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let several = Memo::new(move |_| desk.document.with(|d| d.project.cameras.len() > 1 || d.project.rig.is_some()));
    let there = Memo::new(move |_| desk.document.with(|d| d.project.rig.is_some()));
    view! {
        <Show when=move || several.get()>
            <section data-panel="rig">
                <h2 class="section-head">
                    <span>{words::rig}</span>
                    <Show when=move || there.get() fallback=move || view! {
                        <button class="link" data-action="make-rig" on:click=move |_| desk.make_rig()>{words::taken_together}</button>
                    }>
                        <button class="link bad" data-action="remove-rig" on:click=move |_| desk.remove_rig()>{words::remove}</button>
                    </Show>
                </h2>
                <p class="hint">{move || if there.get() { words::means() } else { words::offer() }}</p>
                <Show when=move || there.get()><Together/><RelativePoses/></Show>
            </section>
        </Show>
    }
}

/// The exposures as a table of photo names, and the standard errors of the mount.
#[component]
fn Together() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let rig = Memo::new(move |_| desk.document.with(|d| d.project.rig.as_deref().cloned()));
    let cameras = Memo::new(move |_| desk.document.with(|d| rig::cameras(&d.project)));
    let shape = Memo::new(move |_| rig.with(|r| r.as_ref().map_or((0, 0), |r| (r.exposures.len(), r.cameras()))));
    let sigma = move |read: fn(&Rig) -> f64| {
        Signal::derive(move || rig.with(|r| r.as_ref().map(|r| format::editable(read(r))).unwrap_or_default()))
    };
    let photo = move |row: usize, column: usize| {
        let name = Signal::derive(move || {
            rig.with(|r| r.as_ref()?.exposures.get(row)?.get(column)?.clone()).unwrap_or_default()
        });
        view! {
            <td class="left"><Field value=name commit=move |typed: String| desk.put_in_rig(row, column, &typed)
                attr:aria-label=move || words::photo_of(row + 1, column + 1) attr:data-exposure=row attr:data-column=column/></td>
        }
    };
    view! {
        <div class="fields">
            <label class="field">
                <span>{words::sigma_position} " " <u>{move || desk.document.with(|d| d.project.unit.clone())}</u></span>
                <Field value=sigma(|r| r.sigma_position) commit=move |typed: String| desk.set_rig_sigma(true, &typed)
                    attr:inputmode="decimal" attr:data-field="rig-position"/>
            </label>
            <label class="field">
                <span>{words::sigma_rotation} " " <u>"mrad"</u></span>
                <Field value=sigma(|r| 1000.0 * r.sigma_rotation) commit=move |typed: String| desk.set_rig_sigma(false, &typed)
                    attr:inputmode="decimal" attr:data-field="rig-rotation"/>
            </label>
        </div>
        <div class="scroll short-list" tabindex="0" role="region" aria-label=words::taken_together>
            <table class="table" data-table="rig">
                <thead><tr>{move || cameras.get().into_iter().map(|camera| view! {
                    <th class="left">{camera.map_or_else(|| "–".to_owned(), |id| text::camera_named(&id))}</th>
                }).collect_view()}</tr></thead>
                <tbody>{move || {
                    let (rows, columns) = shape.get();
                    (0..rows).map(|row| view! {
                        <tr>{(0..columns).map(|column| photo(row, column)).collect_view()}</tr>
                    }).collect_view()
                }}</tbody>
            </table>
        </div>
    }
}

/// Its result in the last adjustment.
#[component]
fn RelativePoses() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let found = Memo::new(move |_| {
        desk.document.with(|d| d.current().map(|r| (r.adjustment.rig.clone(), d.project.unit.clone())))
    });
    let sentence = |pose: &sightline::adjustment::RelativePose, unit: &str| {
        let base = match pose.sigma_base {
            Some(sigma) => format!("{} ± {} {unit}", format::fixed(pose.base, 3), format::fixed(sigma, 3)),
            None => format!("{} {unit}", format::fixed(pose.base, 3)),
        };
        let said = words::base(&pose.camera, &pose.relative_to, base);
        match pose.scatter_position.zip(pose.scatter_rotation) {
            Some((position, rotation)) => format!(
                "{said} {}",
                words::scatter(
                    format::count(pose.exposures.len()),
                    format!("{} {unit}", format::fixed(position, 3)),
                    format!("{} mrad", format::fixed(1000.0 * rotation, 3)),
                )
            ),
            None => format!("{said} {}", words::one_exposure()),
        }
    };
    let outlier = |off: &sightline::adjustment::RelativeDeviation, unit: &str| {
        let length = |[x, y, z]: [f64; 3]| x.hypot(y).hypot(z);
        let position = format!("{} {unit}", format::fixed(length(off.position), 3));
        let rotation = format!("{} mrad", format::fixed(1000.0 * length(off.rotation), 3));
        let [first, own] = &off.photos;
        words::outlier(first, own, position, rotation)
    };
    move || {
        let (poses, unit) = found.get()?;
        Some(view! {
            <ul class="note" data-result="rig">
                {poses.iter().map(|pose| view! { <li>{sentence(pose, &unit)}</li> }).collect_view()}
                {poses.iter().flat_map(|pose| &pose.exposures).filter(|off| off.outlier).map(|off| {
                    view! { <li class="warn" data-outlier=off.exposure.to_string()>{outlier(off, &unit)}</li> }
                }).collect_view()}
            </ul>
        })
    }
}
