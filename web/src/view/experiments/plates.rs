//! Your own plates: fiducial marks and distortion table entered, readings from a file or measured in scanned photos.

use leptos::prelude::*;
use sightline_exchange::comparator::Reduced;
use sightline_lab::experiments::film_description;

use super::names;
use crate::browser::{event, file};
use crate::format;
use crate::i18n::errors;
use crate::i18n::experiments as words;
use crate::store::Desk;

#[component]
pub fn Plates() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let plates = desk.experiments.plates;
    let from_files = move |_| file::choose(".csv,.txt,.dat", true, move |files| desk.reduce_plates(files));
    let measured = Memo::new(move |_| desk.document.with(|d| d.project.observations.len()));
    view! {
        <section class="plates">
            <h2 class="section-head"><span>{words::plates}</span></h2>
            <p class="note">{words::plates_words}</p>
            <textarea
                rows="12" spellcheck="false" aria-label=words::plates_description
                prop:value=move || plates.description.get().unwrap_or_else(film_description)
                on:change=move |e| plates.description.set(Some(event::value(&e)))
            ></textarea>
            <div class="row plates-actions">
                <button class="button choose-readings" on:click=from_files>{words::plates_files}</button>
                <button class="button" disabled=move || measured.get() == 0 on:click=move |_| desk.reduce_scans()>
                    {words::plates_scans}
                </button>
                <span class="hint">{words::plates_scans_words}</span>
            </div>
            {move || plates.outcome.get().map(|outcome| match outcome {
                Ok(reduced) => view! { <Fits reduced=(*reduced).clone()/> }.into_any(),
                Err(error) => view! { <p class="note warn" role="alert">{move || errors::sentence(&error)}</p> }.into_any(),
            })}
        </section>
    }
}

/// The fits on the way to observations, and the way on.
#[component]
fn Fits(reduced: Reduced) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let um = |mm: f64| format::fixed(1000.0 * mm, 1);
    let marks = reduced
        .inner_orientations
        .iter()
        .flat_map(|inner| {
            let sigma0 = inner.transformation.sigma0.map(um).unwrap_or_default();
            let row = move |(mark, v): (&String, &[f64; 2])| {
                view! {
                    <tr>
                        <td class="left">{inner.photo.clone()}</td>
                        <td class="left">{mark.clone()}</td>
                        <td>{um(v[0])}</td>
                        <td>{um(v[1])}</td>
                        <td>{sigma0.clone()}</td>
                    </tr>
                }
            };
            inner.marks.iter().zip(&inner.transformation.residuals).map(row).collect::<Vec<_>>()
        })
        .collect_view();
    let kind = reduced.inner_orientations.first().map(|i| match i.transformation.kind.parameters() {
        4 => "similarity",
        6 => "affine",
        _ => "projective",
    });
    let distortion = reduced.distortion.as_ref().map(|fitted| {
        let rows = fitted
            .table
            .iter()
            .zip(&fitted.polynomial.residuals)
            .map(|([r, table], residual)| {
                view! {
                    <tr>
                        <td>{format::fixed(*r, 1)}</td>
                        <td>{format::fixed(*table, 1)}</td>
                        <td>{um(fitted.polynomial.at(*r))}</td>
                        <td>{format::fixed(1000.0 * residual, 2)}</td>
                    </tr>
                }
            })
            .collect_view();
        view! {
            <h2 class="section-head"><span>{words::t_distortion}</span></h2>
            <div class="framed scroll" tabindex="0"><table class="table">
                <thead><tr>
                    <th>{words::radius} " " <u>"mm"</u></th>
                    <th>{words::table} " " <u>"µm"</u></th>
                    <th>{words::polynomial} " " <u>"µm"</u></th>
                    <th>{words::residual} " " <u>"µm"</u></th>
                </tr></thead>
                <tbody>{rows}</tbody>
            </table></div>
        }
    });
    let (photos, observations) = (reduced.project.photos.len(), reduced.project.observations.len());
    view! {
        <p class="note reduced">
            {move || words::plates_reduced(format::count(photos), format::count(observations))} " "
            <button class="button small primary open-plates" on:click=move |_| desk.open_plates()>{words::open_as_project}</button>
        </p>
        <h2 class="section-head">
            <span>{words::t_fiducials}</span>
            <span class="aside">{move || kind.map(names::name)}</span>
        </h2>
        <div class="framed scroll" data-table="own-fiducials" tabindex="0"><table class="table">
            <thead><tr>
                <th class="left">{words::photo}</th>
                <th class="left">{words::mark}</th>
                <th>"vₓ " <u>"µm"</u></th>
                <th>"vᵧ " <u>"µm"</u></th>
                <th>{words::marks_sigma0} " " <u>"µm"</u></th>
            </tr></thead>
            <tbody>{marks}</tbody>
        </table></div>
        {distortion}
    }
}
