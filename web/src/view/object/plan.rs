//! The object from above, as SVG: where there is no WebGL.

use leptos::prelude::*;
use sightline::depiction::extent;

use crate::i18n::object as words;
use crate::store::Desk;

const SIDE: f64 = 480.0;
const MARGIN: f64 = 24.0;
/// More points than this stand without their names.
const NAMED: usize = 150;

#[component]
pub fn Plan() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let drawn = move || {
        desk.document.with(|d| {
            let Some(result) = d.current() else { return Vec::new() };
            let a = &result.adjustment;
            let all = a.points.iter().map(|p| p.xyz).chain(a.photos.iter().map(|p| p.position));
            let flat: Vec<[f64; 3]> = all.map(|[x, y, _]| [x, y, 0.0]).collect();
            let (centre, size) = extent(flat.iter().copied());
            let scale = (SIDE - 2.0 * MARGIN) / size;
            let at =
                move |[x, y, _]: [f64; 3]| (SIDE / 2.0 + (x - centre[0]) * scale, SIDE / 2.0 - (y - centre[1]) * scale);
            let points = a.points.iter().map(|p| (p.id.clone(), at(p.xyz), true));
            points.chain(a.photos.iter().map(|p| (p.id.clone(), at(p.position), false))).collect()
        })
    };
    let chosen = move || desk.selection.with(|s| s.point.clone());
    view! {
        <svg class="object-plan" viewBox=format!("0 0 {SIDE} {SIDE}") role="img" aria-label=words::plan_label>
            {move || {
                let all = drawn();
                let named = all.len() <= NAMED;
                let chosen = chosen();
                all.into_iter().map(|(id, (x, y), point)| {
                    let is_chosen = point && chosen.as_ref() == Some(&id);
                    let choose = id.clone();
                    let mark = if point {
                        view! { <circle class:chosen=is_chosen cx=x cy=y r="3" on:click=move |_| desk.select_point(&choose)></circle> }.into_any()
                    } else {
                        view! { <path class="camera" d=format!("M{} {}h8v8h-8z", x - 4.0, y - 4.0)></path> }.into_any()
                    };
                    let label = (named || is_chosen).then(|| view! { <text x=x + 5.0 y=y - 4.0>{id}</text> });
                    view! { {mark}{label} }
                }).collect_view()
            }}
        </svg>
    }
}
