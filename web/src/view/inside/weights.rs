//! Standard errors of a group scaled, and the size of targets against the bias of their ellipse centres.

use leptos::prelude::*;
use sightline_protocol::Inquiry;

use super::super::estimated::group_name;
use super::number;
use crate::browser::event;
use crate::format;
use crate::i18n::{inside as words, text};
use crate::store::Desk;

/// Diameters as shares of the largest diameter asked for.
const SHARES: [f64; 8] = [0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 1.0];

#[component]
pub fn Weights() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    let (image, control) = (RwSignal::new(1.0_f64), RwSignal::new(1.0_f64));
    let largest = RwSignal::new(40.0_f64);
    let weigh = move || desk.inquire(Inquiry::Weigh(image.get_untracked(), control.get_untracked()));
    let size = move || desk.inquire(Inquiry::Biases(SHARES.map(|share| share * largest.get_untracked()).to_vec()));
    // What a lesson refers to.
    Effect::new(move || {
        let wanted = inside.wanted.get();
        if wanted.image.is_some() || wanted.control.is_some() {
            image.set(wanted.image.unwrap_or(1.0));
            control.set(wanted.control.unwrap_or(1.0));
            if inside.weighted.with_untracked(Option::is_some) {
                weigh();
            }
        }
    });
    Effect::new(move || {
        if inside.steps.with(|steps| !steps.is_empty()) {
            if inside.weighted.with_untracked(Option::is_none) {
                weigh();
            }
            if inside.biases.with_untracked(Vec::is_empty) {
                size();
            }
        }
    });
    let slider = move |label: crate::i18n::Text, name: &'static str, value: RwSignal<f64>| {
        view! {
            <label class="option wide"><span>{move || format!("{} × {}", label(), format::fixed(value.get(), 2))}</span>
                <input type="range" name=name min="-1" max="1" step="0.05" prop:value=move || value.get().log10().to_string()
                    on:input=move |e| value.set(10f64.powf(event::value(&e).parse().unwrap_or(0.0))) on:change=move |_| weigh()/></label>
        }
    };
    view! {
        <main class="inside-page scroll">
            <div class="errors">
                <section>
                    <h2 class="section-head"><span>{words::weights_title}</span></h2>
                    <p class="hint">{words::weights_hint}</p>
                    <div class="inside-options">{slider(words::image_sigma, "image-sigma", image)}{slider(words::control_sigma, "control-sigma", control)}</div>
                    <Weighted/>
                </section>
                <section>
                    <h2 class="section-head"><span>{words::target_size}</span></h2>
                    <p class="hint">{words::target_size_hint}</p>
                    <div class="inside-options"><label class="option wide"><span>{move || words::largest_diameter(format::fixed(largest.get(), 1))}</span>
                        <input type="range" name="diameter" min="0.3" max="2.5" step="0.05" prop:value=move || largest.get().log10().to_string()
                            on:input=move |e| largest.set(10f64.powf(event::value(&e).parse().unwrap_or(1.6))) on:change=move |_| size()/></label></div>
                    <Biases/>
                </section>
            </div>
        </main>
    }
}

/// The adjustment with the scaled standard errors.
#[component]
fn Weighted() -> impl IntoView {
    let inside = expect_context::<Desk>().inside;
    move || {
        let found = inside.weighted.get()?;
        let test = found.test.as_ref().map(|test| {
            let said = if test.passed { text::test_passed() } else { text::test_failed() };
            (
                format!(
                    "{} ({} … {})",
                    format::fixed(test.statistic, 1),
                    format::fixed(test.lower, 1),
                    format::fixed(test.upper, 1)
                ),
                said,
                test.passed,
            )
        });
        let components = found.components.iter().map(|one| {
            let factor = match one.factor_sigma {
                Some(sigma) => format!("× {} ± {}", format::fixed(one.factor, 2), format::fixed(sigma, 2)),
                None => words::not_estimated().to_owned(),
            };
            view! { <tr><td class="left">{words::component_of(group_name(&one.group))}</td><td>{factor}</td></tr> }
        });
        let components = components.collect_view();
        let [x, y, z] = found.rms_sigma.map_or([const { String::new() }; 3], |rms| rms.map(number));
        Some(view! {
            <table class="table words"><tbody>
                <tr><td class="left">"σ₀"</td><td><b data-weighted="sigma0">{found.sigma0.map_or("–".to_owned(), |sigma0| format::fixed(sigma0, 3))}</b></td></tr>
                {test.map(|(figures, said, passed)| view! { <tr><td class="left">"vᵀPv, " {said}</td><td class:pass=passed class:bad=!passed>{figures}</td></tr> })}
                <tr><td class="left">{words::image_residuals} " " <u>"px"</u></td><td>{found.rms_px.map(number)}</td></tr>
                <tr><td class="left">{words::control_residuals}</td><td>{found.given.map(|given| format::fixed(given, 2))}</td></tr>
                <tr><td class="left">{words::rms_sigma} " " <u>{inside.unit()}</u></td><td>{format!("{x}  {y}  {z}")}</td></tr>
                {components}
            </tbody></table>
        })
    }
}

/// Bias of ellipse centres by the diameter of the targets.
#[component]
fn Biases() -> impl IntoView {
    let inside = expect_context::<Desk>().inside;
    move || {
        let all = inside.biases.get();
        let unit = inside.steps.with(|steps| {
            steps.first().and_then(|looked| {
                looked.system.observations.iter().find(|row| row.given.is_none()).map(|row| row.unit.clone())
            })
        });
        let unit = unit.unwrap_or_default();
        let most = all.iter().map(|bias| bias.in_sigma).fold(f64::MIN_POSITIVE, f64::max);
        let none = all.iter().all(|bias| bias.largest == 0.0);
        let rows = all.iter().map(|bias| {
            view! {
                <tr><td>{format::fixed(bias.diameter, 1)}</td><td>{number(bias.rms)}</td><td>{number(bias.largest)}</td><td><b>{format::fixed(bias.in_sigma, 2)}</b></td>
                <td class="left wide"><i class="bar-cell" style:width=format!("{:.0}px", 50.0 * bias.in_sigma / most)></i></td></tr>
            }
        });
        let rows = rows.collect_view();
        view! {
            {none.then(|| view! { <p class="hint">{words::no_planes}</p> })}
            <table class="table"><thead><tr><th>{words::diameter}</th><th>{words::rms_bias} " " <u>{unit.clone()}</u></th><th>{words::largest_bias} " " <u>{unit}</u></th><th>{words::in_sigma}</th><td class="left wide"></td></tr></thead>
            <tbody>{rows}</tbody></table>
        }
    }
}
