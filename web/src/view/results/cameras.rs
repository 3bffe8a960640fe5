//! Adjusted cameras: parameters with standard errors, and their correlations as a heat map.

use crate::view::components::parameters::parameter_cells;
use leptos::prelude::*;
use sightline::adjustment::AdjustedCamera;
use sightline::project::Parameter;

use super::read;
use crate::format;
use crate::i18n::{equipment, text};
use crate::store::Desk;
use crate::view::components::parameters::parameter_name;

#[component]
pub(super) fn Cameras() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let cameras = Memo::new(move |_| read(desk, |a, _| a.cameras.clone()));
    view! { {move || cameras.get().into_iter().map(|camera| view! { <CameraTable camera/> }).collect_view()} }
}

/// A camera's parameters with their correlations in the same rows.
#[component]
pub(super) fn CameraTable(camera: AdjustedCamera) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let names =
        camera.correlation.names.iter().map(|n| n.parse::<Parameter>().map_or("", parameter_name)).collect::<Vec<_>>();
    let id = camera.camera.id.clone();
    let estimated =
        camera.correlation.names.iter().enumerate().filter_map(|(i, n)| Some((i, n.parse::<Parameter>().ok()?)));
    let rows = estimated.map(|(i, p)| {
        let value = camera.camera.interior.get(p).unwrap_or(0.0);
        let sigma = camera.sigma.get(&p).copied();
        let (value, sigma, unit) = parameter_cells(&camera.camera, p, value, sigma);
        let row = camera.correlation.matrix.get(i).cloned().unwrap_or_default();
        let cells = (0..names.len()).map(|j| correlation_cell(i, j, row.get(j).copied().unwrap_or(0.0))).collect_view();
        view! {
            <tr data-camera=camera.camera.id.clone() data-parameter=p.name()>
                <td class="left id">{parameter_name(p)}</td><td><b>{value}</b></td><td>{sigma}</td><td class="left">{unit}</td>{cells}
            </tr>
        }
    }).collect_view();
    let interior = camera.camera.interior;
    let held = camera
        .camera
        .interior
        .parameters()
        .iter()
        .filter(|p| **p != Parameter::F && !camera.camera.estimated().contains(p));
    let held = held.map(|p| parameter_name(*p)).collect::<Vec<_>>().join(", ");
    // One of all photos can be kept for other projects.
    let keep = (camera.photo.is_none() && !camera.sigma.is_empty()).then(|| {
        let id = camera.camera.id.clone();
        view! { <button class="link" data-keep=id.clone() on:click=move |_| desk.keep_calibration(&id)>{equipment::keep_calibration}</button> }
    });
    view! {
        <h2 class="section-head">
            <span>{move || text::camera_and_correlations(&id)}</span>
            {keep}
            <span class="aside"><i class="swatch minus"></i>" −1 " <i class="swatch plus"></i> " +1"</span>
        </h2>
        <table class="table correlations">
            <thead><tr>
                <td class="left"></td><th>{text::value}</th><th>"σ 1σ"</th><th class="left">{text::unit}</th>
                {names.iter().map(|n| view! { <th class="cell">{*n}</th> }).collect_view()}
            </tr></thead>
            <tbody>{rows}</tbody>
        </table>
        <p class="note" data-model=interior.model().name>
            {move || if held.is_empty() { text::model_name(&interior).to_owned() } else { text::of_model(text::model_name(&interior), text::all_held(&held)) }}
        </p>
    }
}

pub(super) fn correlation_cell(i: usize, j: usize, r: f64) -> impl IntoView {
    let shown = if i != j && r.abs() >= 0.4 { format::fixed(r, 2).replacen("0.", ".", 1) } else { String::new() };
    let class = match (j.cmp(&i), r < 0.0) {
        (std::cmp::Ordering::Greater, _) => "cell",
        (std::cmp::Ordering::Equal, _) => "cell own",
        (_, true) => "cell minus",
        _ => "cell plus",
    };
    let strength = if r.abs() > 0.8 { 100.0 } else { 55.0 * r.abs() };
    let shown = if j > i { String::new() } else { shown };
    view! { <td class=class class:full={j < i && r.abs() > 0.8} style:--strength=format!("{strength:.0}%")>{shown}</td> }
}
