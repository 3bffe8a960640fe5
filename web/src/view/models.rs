//! The model of a camera: chosen, converted, compared with the others.

use crate::view::components::parameters::model_name;
use leptos::prelude::*;
use sightline::calibration::{ComparedModel, ModelVerdict};
use sightline::project::{Camera, CameraModel, Parameter};
use sightline_report::names::parameter_name;

use super::calibrating::CrossCheck;
use super::predicted::Predicted;
use crate::browser::event;
use crate::format;
use crate::i18n::{errors, modelling as words};
use crate::store::Desk;

fn names(parameters: &[Parameter]) -> String {
    parameters.iter().map(|p| parameter_name(*p)).collect::<Vec<_>>().join(", ")
}

/// Pixels with as many digits as they need.
fn px(value: f64) -> String {
    format::fixed(value, if value < 0.1 { 3 } else { 2 })
}

/// The model of a camera as a menu, and what its conversion has left.
#[component]
pub fn ModelMenu(camera: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(camera);
    let camera =
        Memo::new(move |_| desk.document.with(|d| d.project.cameras.iter().find(|c| c.id == id.get_value()).cloned()));
    let model = move || camera.with(|c| c.as_ref().map_or("", |c| c.interior.model().name));
    let left = move || {
        let left = camera.with(|c| c.as_ref().and_then(|c| desk.conversion_of(c)))?;
        let mut said = match left.max_px.zip(left.rms_px) {
            Some((max, rms)) => words::converted(model_name(&left.from), px(max), px(rms)),
            None => words::converted_unknown().to_owned(),
        };
        if left.share < 0.995 {
            said = format!("{said} {}", words::converted_part(format::fixed(100.0 * left.share, 0)));
        }
        if !left.dropped.is_empty() {
            said = format!("{said} {}", words::dropped(names(&left.dropped)));
        }
        // as large as a good target's standard error: the adjustment would feel it
        let is_large = left.max_px.is_some_and(|max| max > 0.05);
        Some(view! { <p class="note" class:warn=is_large data-result="conversion">{said}</p> })
    };
    view! {
        <label class="field">
            <span>{words::camera_model}</span>
            <select name="camera-model" prop:value=model on:change=move |e| desk.choose_model(&id.get_value(), &event::value(&e))>
                {CameraModel::ALL.map(|m| view! {
                    <option value=m.name selected=move || model() == m.name>{move || model_name(m.name)}</option>
                }).collect_view()}
            </select>
        </label>
        {left}
    }
}

/// Whether the coefficients of the rational model are estimated that are nearly equivalent to its others.
fn has_all(parameters: &[Parameter]) -> bool {
    parameters.contains(&Parameter::K5)
}

/// All models of a camera on the network, with one click to take one.
#[component]
pub fn ModelComparison(camera: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(camera);
    let is_measured = Memo::new(move |_| desk.document.with(|d| d.project.observations.iter().any(|o| o.enabled)));
    let present = Memo::new(move |_| {
        desk.document.with(|d| {
            let of = |c: &&Camera| c.id == id.get_value();
            d.project.cameras.iter().find(of).map(|c| (c.interior.model().name, has_all(&c.estimated())))
        })
    });
    let row = move |row: ComparedModel| {
        let (best, model) = (row.verdict == ModelVerdict::Best, row.model.clone());
        let number = |value: Option<f64>, decimals: usize| value.map(|v| format::fixed(v, decimals));
        let verdict = match (row.verdict, &row.failure) {
            (_, Some(error)) => errors::sentence(error),
            (ModelVerdict::Best, _) => words::best().to_owned(),
            (ModelVerdict::AsGoodWithFewer, _) => words::as_good_with_fewer().to_owned(),
            (ModelVerdict::AsGood, _) => words::as_good().to_owned(),
            (ModelVerdict::TooStiff, _) => words::too_stiff().to_owned(),
            (ModelVerdict::Overfits, _) => words::overfits().to_owned(),
            (ModelVerdict::Failed, None) => words::failed().to_owned(),
        };
        let small = (!row.insignificant.is_empty()).then(|| words::not_told(names(&row.insignificant)));
        // The rational model is listed without and with K5 and K6.
        let is_present =
            present.get().is_some_and(|(model, whole)| model == row.model && whole == has_all(&row.parameters));
        let taken = row.clone();
        let action = match (is_present, row.camera.is_some()) {
            (true, _) => view! { <span class="aside">{words::in_use}</span> }.into_any(),
            (false, true) => view! {
                <button class="button small" class:primary=best data-take=model.clone() on:click=move |_| desk.take_model(&id.get_value(), &taken)>{words::take}</button>
            }
            .into_any(),
            (false, false) => ().into_any(),
        };
        let code = match row.verdict {
            ModelVerdict::Best => "best",
            ModelVerdict::AsGoodWithFewer => "as_good_with_fewer",
            ModelVerdict::AsGood => "as_good",
            ModelVerdict::TooStiff => "too_stiff",
            ModelVerdict::Overfits => "overfits",
            ModelVerdict::Failed => "failed",
        };
        view! {
            <tr class:chosen=best data-model=model data-verdict=code>
                <td class="left"><b>{model_name(&row.model)}</b>{has_all(&row.parameters).then_some(", K₁–K₆")}</td>
                <td>{number(row.sigma0, 2)}</td>
                <td>{(!row.parameters.is_empty()).then(|| format::count(row.parameters.len()))}</td>
                <td>{row.held_out_rms.map(px)}</td>
                <td>{number(row.bic, 0)}</td>
                <td>{action}</td>
            </tr>
            <tr class="about" class:chosen=best><td class="left" colspan="6"><small>{verdict}{small.map(|small| format!(". {small}"))}</small></td></tr>
        }
    };
    view! {
        <Show when=move || is_measured.get()>
            <tr><td class="left models" colspan="2">
            <button class="button" data-action="compare-models" title=words::compare_why on:click=move |_| desk.compare_models(&id.get_value())>{words::compare}</button>
            {move || desk.compared_models(&id.get_value()).map(|compared| view! {
                <table class="table" data-result="models">
                    <thead><tr>
                        <th class="left">{words::camera_model}</th><th>"σ₀"</th><th>{words::parameters}</th>
                        <th title=words::held_out_why>{words::held_out} " " <u>"px"</u></th><th title=words::bic_why>"ΔBIC"</th><td class="left"></td>
                    </tr></thead>
                    <tbody>{compared.rows.into_iter().map(row).collect_view()}</tbody>
                </table>
                <p class="note">{words::compared_note}</p>
            })}
            <CrossCheck camera=id.get_value()/>
            <Predicted camera=id.get_value()/>
            </td></tr>
        </Show>
    }
}
