//! The S-transformation from one datum into another, point by point beside the adjustment under that datum.

use leptos::prelude::*;
use sightline::project::DatumKind;
use sightline_lab::teaching::Transformed;
use sightline_protocol::Inquiry;

use super::datum::datum_name;
use super::number;
use crate::i18n::inside as words;
use crate::store::Desk;

/// Old and new datum.
const PAIRS: [[DatumKind; 2]; 4] = [
    [DatumKind::Minimal, DatumKind::Free],
    [DatumKind::Free, DatumKind::Minimal],
    [DatumKind::Control, DatumKind::Free],
    [DatumKind::Control, DatumKind::Minimal],
];
/// More points than these are not listed; the largest difference is that of all.
const MOST: usize = 60;
/// Share of the standard errors up to which covariances are the same: iterations end at a negligible step, not at none.
const SAME: f64 = 1e-5;

#[component]
pub fn STransformation(held: RwSignal<Vec<String>>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    let pair = RwSignal::new(PAIRS[0]);
    Effect::new(move || {
        // Asked again when the network or the held points are others.
        let points = held.get();
        let known = inside.datums.with(Option::is_some);
        let pair = pair.get();
        if known && (points.is_empty() || points.len() >= 3) {
            inside.transformed.set(None);
            desk.inquire(Inquiry::Transform(pair, (!points.is_empty()).then_some(points)));
        }
    });
    let control = move || {
        inside.datums.with(|found| {
            let cases = found.as_ref().map(|found| &found.cases);
            cases.is_some_and(|cases| {
                cases.iter().any(|case| case.kind == DatumKind::Control && !case.points.is_empty())
            })
        })
    };
    let buttons = move || {
        let control = control();
        let possible = PAIRS.into_iter().filter(|[from, _]| control || *from != DatumKind::Control);
        let button = |[from, to]: [DatumKind; 2]| {
            view! {
                <button class="text-button" data-transform=format!("{from:?}-{to:?}").to_lowercase()
                    aria-pressed=move || (pair.get() == [from, to]).to_string() on:click=move |_| pair.set([from, to])>
                    {datum_name(from)} " → " {datum_name(to)}
                </button>
            }
        };
        possible.map(button).collect_view()
    };
    let body = move || match inside.transformed.get() {
        None => view! { <p class="note">{words::computing}</p> }.into_any(),
        Some(None) => view! { <p class="note">{words::no_transformation}</p> }.into_any(),
        Some(Some(found)) => table(&found).into_any(),
    };
    view! {
        <section class="transformation">
            <h2 class="section-head"><span>{words::s_transformation}</span><span class="aside">"Q′ = S Q Sᵀ,  S = I − G(DG)⁻¹D"</span></h2>
            <p class="hint">{words::s_transformation_is}</p>
            <div class="inside-options">{buttons}</div>
            {body}
        </section>
    }
}

fn table(found: &Transformed) -> impl IntoView + use<> {
    let same = found.apart < SAME;
    let said = match (same, found.from) {
        (true, _) => words::transformed_is_adjusted(number(found.apart)),
        (false, DatumKind::Control) => words::control_adds(number(found.apart)),
        (false, _) => words::transformed_differs(number(found.apart)),
    };
    let sigmas = |covariance: [f64; 6]| {
        let [x, y, z] = [covariance[0], covariance[3], covariance[5]].map(|variance| number(variance.max(0.0).sqrt()));
        format!("{x}  {y}  {z}")
    };
    let rows = found.points.iter().take(MOST).map(|point| {
        view! {
            <tr><td class="left">{point.id.clone()}</td><td>{sigmas(point.before)}</td><td data-transformed="">{sigmas(point.transformed)}</td><td><b>{sigmas(point.adjusted)}</b></td></tr>
        }
    });
    let rows = rows.collect_view();
    let (from, to) = (datum_name(found.from), datum_name(found.to));
    view! {
        <p class="inside-said" data-same=same.to_string() role="status">{said}</p>
        <table class="table transformed">
            <thead><tr><th class="left">{words::point}</th><th>"σ X, Y, Z: " {from}</th><th>{words::after_transformation}</th><th>{words::adjusted_under(to)}</th></tr></thead>
            <tbody>{rows}</tbody>
        </table>
    }
}
