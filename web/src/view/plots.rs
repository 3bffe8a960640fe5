//! Plots as drawings that scale with their box: convergence, residual vectors, correlations.

use leptos::prelude::*;
use sightline::adjustment::Iteration;

use crate::format;

/// σ0 per iteration on a logarithmic axis; the line at 1 is where it should end.
#[component]
pub fn Convergence(#[prop(into)] iterations: Signal<Vec<Iteration>>) -> impl IntoView {
    const WIDTH: f64 = 430.0;
    const HEIGHT: f64 = 200.0;
    const LEFT: f64 = 44.0;
    let plot = move || {
        let all = iterations.get();
        let logs = all.iter().filter(|i| i.sigma0 > 0.0).map(|i| i.sigma0.log10()).collect::<Vec<_>>();
        if logs.is_empty() {
            return None;
        }
        let top = logs.iter().copied().fold(1.0_f64, f64::max).ceil();
        let bottom = logs.iter().copied().fold(0.0_f64, f64::min).floor().max(top - 12.0);
        let steps = (logs.len() - 1).max(4) as f64;
        let x = move |i: usize| LEFT + i as f64 / steps * (WIDTH - LEFT - 20.0);
        let y = move |log: f64| 14.0 + (top - log) / (top - bottom) * (HEIGHT - 44.0);
        let path =
            logs.iter().enumerate().map(|(i, l)| format!("{}{:.1} {:.1}", if i == 0 { "M" } else { "L" }, x(i), y(*l)));
        let path = path.collect::<String>();
        let dots = logs
            .iter()
            .enumerate()
            .map(|(i, l)| view! { <circle class="dot-a" cx=x(i) cy=y(*l) r="3"></circle> })
            .collect_view();
        let step = ((top - bottom) / 5.0).ceil().max(1.0) as usize;
        let grid = (bottom as i32..=top as i32)
            .step_by(step)
            .map(|power| {
                let at = y(f64::from(power));
                let label =
                    if (-2..=4).contains(&power) { format::round(10f64.powi(power)) } else { format::power(power) };
                view! {
                    <line class=if power == 0 { "reference" } else { "grid" } x1=LEFT x2=WIDTH - 8.0 y1=at y2=at></line>
                    <text class="axis" x=LEFT - 6.0 y=at + 4.0 text-anchor="end">{label}</text>
                }
            })
            .collect_view();
        let every = (logs.len() / 10).max(1);
        let numbers = (0..logs.len())
            .step_by(every)
            .map(|i| {
                view! {
                    <text class="axis" x=x(i) y=HEIGHT - 8.0 text-anchor="middle">{i + 1}</text>
                }
            })
            .collect_view();
        let last = logs.len() - 1;
        let value = all.last().map(|i| format::compact(i.sigma0)).unwrap_or_default();
        Some(view! {
            <svg class="plot" viewBox=format!("0 0 {WIDTH} {HEIGHT}") role="img" aria-label="σ₀">
                {grid}{numbers}
                <path class="line-a" d=path></path>
                {dots}
                <text class="axis strong" x=x(last) y=y(logs[last]) - 10.0 text-anchor="middle">{value}</text>
            </svg>
        })
    };
    view! { <div class="plot-box">{plot}</div> }
}

/// A vector of the residual plot: place and residual in photo units, whether it is the chosen one.
#[derive(Clone, Debug, PartialEq)]
pub struct Vector {
    pub point: String,
    pub at: [f64; 2],
    pub residual: [f64; 2],
    pub chosen: bool,
    pub over: bool,
}

/// Residual vectors in the frame of their photo, exaggerated by a stated round factor.
#[component]
pub fn ResidualPlot(
    /// Width and height of the photo in photo units.
    #[prop(into)]
    size: Signal<[f64; 2]>,
    #[prop(into)] vectors: Signal<Vec<Vector>>,
    /// Unit of photo coordinates and how residuals are shown: factor and unit.
    #[prop(into)]
    shown: Signal<(f64, &'static str)>,
    on_choose: Callback<String>,
) -> impl IntoView {
    const WIDTH: f64 = 420.0;
    let plot = move || {
        let [w, h] = size.get();
        if w <= 0.0 || h <= 0.0 {
            return None;
        }
        let scale = (WIDTH - 24.0) / w;
        let height = h * scale + 44.0;
        let all = vectors.get();
        let mut lengths = all.iter().map(|v| v.residual[0].hypot(v.residual[1])).collect::<Vec<_>>();
        lengths.sort_by(f64::total_cmp);
        let typical = lengths.get(lengths.len() * 9 / 10).copied().unwrap_or(0.0);
        let exaggeration = if typical > 0.0 { format::round_below(18.0 / (typical * scale)) } else { 1.0 };
        let x = move |at: f64| 12.0 + (at + w / 2.0) * scale;
        let y = move |at: f64| 8.0 + (h / 2.0 - at) * scale;
        let drawn = all.into_iter().map(|v| {
            let (x1, y1) = (x(v.at[0]), y(v.at[1]));
            let (x2, y2) = (x1 + v.residual[0] * scale * exaggeration, y1 - v.residual[1] * scale * exaggeration);
            let point = v.point.clone();
            let class = match (v.chosen, v.over) {
                (true, _) => "vector chosen",
                (_, true) => "vector over",
                _ => "vector",
            };
            view! {
                <g class=class on:click=move |_| on_choose.run(point.clone())>
                    <line x1=x1 y1=y1 x2=x2 y2=y2></line>
                    <circle cx=x1 cy=y1 r=if v.chosen { "5" } else { "1.2" }></circle>
                    {v.chosen.then(|| view! { <text class="chosen-label" x=x1 + 8.0 y=y1 - 6.0>{v.point.clone()}</text> })}
                </g>
            }
        }).collect_view();
        let (factor, unit) = shown.get();
        let bar = format::round_below(40.0 / (scale * exaggeration));
        Some(view! {
            <svg class="plot" viewBox=format!("0 0 {WIDTH} {height:.0}") role="img" aria-label=crate::i18n::text::residuals>
                <rect class="frame" x="12" y="8" width=w * scale height=h * scale></rect>
                <line class="grid" x1=x(0.0) x2=x(0.0) y1="8" y2=8.0 + h * scale></line>
                <line class="grid" x1="12" x2=12.0 + w * scale y1=y(0.0) y2=y(0.0)></line>
                {drawn}
                <path class="rule" d=format!("M12 {} v5 h{:.1} v-5", height - 22.0, bar * scale * exaggeration)></path>
                <text class="axis" x=18.0 + bar * scale * exaggeration y=height - 14.0>{format!("{} {unit}", format::round(bar * factor))}</text>
                <text class="axis" x=WIDTH - 12.0 y=height - 14.0 text-anchor="end">{format!("{} ×", format::round(exaggeration))}</text>
            </svg>
        })
    };
    view! { <div class="plot-box">{plot}</div> }
}
