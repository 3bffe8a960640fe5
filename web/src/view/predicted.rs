//! How well a calibrated camera predicts pixels: over the image, by distance; its residuals by column and row.

use leptos::prelude::*;
use sightline::calibration::{DistanceUncertainty, ResidualBand};
use sightline_protocol::CameraJudged;

use super::calibrating::{Map, MapKey};
use crate::format;
use crate::i18n::{calibrating as words, errors};
use crate::store::Desk;
use crate::view::components::units::length_unit;

const WIDTH: f64 = 430.0;
const HEIGHT: f64 = 230.0;
const LEFT: f64 = 48.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 22.0;
const BOTTOM: f64 = 40.0;

/// The button, and what was found.
#[component]
pub fn Predicted(camera: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(camera);
    let is_calibrated = Memo::new(move |_| desk.is_calibrated(&id.get_value()));
    view! {
        <Show when=move || is_calibrated.get()>
            <button class="button" data-action="judge-camera" title=words::predict_why on:click=move |_| desk.judge_camera(&id.get_value())>{words::predict}</button>
            {move || desk.judged_camera(&id.get_value()).map(|found| view! { <Judged found=(*found).clone()/> })}
        </Show>
    }
}

/// Pixels with two significant digits.
fn px(value: f64) -> String {
    format::fixed(value, format::decimals_for(value))
}

#[component]
fn Judged(found: CameraJudged) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let unit = desk.document.with_untracked(length_unit);
    let CameraJudged { uncertainty, distance, why, bands } = found;
    let said = uncertainty.median.zip(uncertainty.worst).map(|(median, worst)| {
        let [u, v] = [worst.u, worst.v].map(|at| format::fixed(at, 0));
        words::predicts(px(median), px(worst.sigma), u, v)
    });
    let largest = bands.columns.iter().chain(&bands.rows).flat_map(|b| [b.rms, b.expected]).flatten();
    let largest = largest.fold(0.0, f64::max);
    view! {
        <div data-result="predicted-uncertainty">
            <p class="note" role="status">{said}</p>
            <div class="maps">
                <Map name=words::uncertainty_map values=uncertainty.sigma covered=uncertainty.covered/>
                {distance.map(|found| view! { <ByDistance found unit/> })}
                <Bands name=words::by_column bands=bands.columns largest of="columns"/>
                <Bands name=words::by_row bands=bands.rows largest of="rows"/>
            </div>
            {why.map(|error| view! { <p class="note warn">{words::no_distance(errors::sentence(&error))}</p> })}
            <MapKey/>
            <p class="hint">{words::predict_words}</p>
        </div>
    }
}

/// Numbers 1, 2, 5 of every power of ten between two limits; only the powers where there are many.
fn ticks(from: f64, to: f64) -> Vec<f64> {
    let powers = from.log10().floor() as i32..=to.log10().ceil() as i32;
    let steps: &[f64] = if to / from > 1e3 { &[1.0] } else { &[1.0, 2.0, 5.0] };
    let all = powers.flat_map(|power| steps.iter().map(move |step| step * 10f64.powi(power)));
    all.filter(|tick| (from * 0.999..=to * 1.001).contains(tick)).collect()
}

/// Standard errors of the pixel by distance, both on logarithmic axes: at the centre, and the largest of the corners.
#[component]
fn ByDistance(found: DistanceUncertainty, unit: String) -> impl IntoView {
    let centre: Vec<Option<f64>> = found.places.first().map_or_else(Vec::new, |place| place.sigma.clone());
    let outer = found.places.get(1..).unwrap_or_default();
    let worst = |values: Vec<Option<f64>>| values.into_iter().flatten().reduce(f64::max);
    let corners: Vec<Option<f64>> = (0..found.distances.len())
        .map(|k| worst(outer.iter().map(|place| place.sigma.get(k).copied().flatten()).collect()))
        .collect();
    let ends =
        [found.places.first().and_then(|place| place.infinity), worst(outer.iter().map(|p| p.infinity).collect())];
    let all = || centre.iter().chain(&corners).chain(&ends).flatten().copied().filter(|s| *s > 0.0);
    let (low, high) = all().fold((f64::INFINITY, 0.0_f64), |(a, b), s| (a.min(s), b.max(s)));
    let (near, far) = found.distances.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), d| (a.min(*d), b.max(*d)));
    if !(low > 0.0 && low.is_finite() && near < far) {
        return ().into_any();
    }
    let (low, high) = (low / 1.3, high * 1.3);
    let share = |value: f64, from: f64, to: f64| (value / from).ln() / (to / from).ln();
    // infinity has a place of its own at the right
    let last = WIDTH - RIGHT - 34.0;
    let x = move |distance: f64| LEFT + share(distance, near, far) * (last - LEFT);
    let y = move |sigma: f64| HEIGHT - BOTTOM - share(sigma, low, high) * (HEIGHT - BOTTOM - TOP);
    let line = |values: &[Option<f64>]| {
        let mut path = String::new();
        let mut before = false;
        for (distance, sigma) in found.distances.iter().zip(values) {
            if let Some(sigma) = sigma {
                path += &format!("{}{:.1} {:.1}", if before { "L" } else { "M" }, x(*distance), y(*sigma));
            }
            before = sigma.is_some();
        }
        path
    };
    let paths = [line(&centre), line(&corners)];
    let [from, to] = found.measured.map(x);
    let across = ticks(near, far).into_iter().map(|tick| {
        view! {
            <line class="grid" x1=x(tick) x2=x(tick) y1=TOP y2=HEIGHT - BOTTOM></line>
            <text class="axis" x=x(tick) y=HEIGHT - BOTTOM + 14.0 text-anchor="middle">{format::round(tick)}</text>
        }
    });
    let across = across.collect_view();
    let up = ticks(low, high).into_iter().map(|tick| {
        view! {
            <line class="grid" x1=LEFT x2=WIDTH - RIGHT y1=y(tick) y2=y(tick)></line>
            <text class="axis" x=LEFT - 5.0 y=y(tick) + 4.0 text-anchor="end">{format::round(tick)}</text>
        }
    });
    let up = up.collect_view();
    let end = |sigma: Option<f64>, class: &'static str| {
        sigma.map(
            |sigma| view! { <path class=class d=format!("M{:.1} {:.1}h16", WIDTH - RIGHT - 18.0, y(sigma))></path> },
        )
    };
    // the names stand at the left ends of their lines, where these are farthest apart from the band of the photos
    let label = |values: &[Option<f64>], name: crate::i18n::Text, class: &'static str, by: f64| {
        let first = found.distances.iter().zip(values).find_map(|(d, s)| Some((*d, (*s)?)));
        first.map(|(d, sigma)| view! { <text class=class x=x(d) + 8.0 y=(y(sigma) + by).clamp(TOP + 10.0, HEIGHT - BOTTOM - 4.0)>{name}</text> })
    };
    let labels = (label(&corners, words::corners, "axis b", -2.0), label(&centre, words::centre, "axis a", 22.0));
    view! {
        <figure class="map" data-plot="distance">
            <figcaption>{words::by_distance}</figcaption>
            <svg class="plot" viewBox=format!("0 0 {WIDTH} {HEIGHT}") role="img" aria-label=words::by_distance>
                <rect class="within-photos" x=from y=TOP width=(to - from).max(1.0) height=HEIGHT - BOTTOM - TOP></rect>
                <text class="axis" x=(from + to) / 2.0 y=HEIGHT - BOTTOM - 6.0 text-anchor="middle">{words::of_photos}</text>
                {across}{up}
                <text class="axis" x=WIDTH - RIGHT - 10.0 y=HEIGHT - BOTTOM + 14.0 text-anchor="middle">"∞"</text>
                <text class="axis" x=LEFT y=TOP - 8.0>"1σ px"</text>
                <text class="axis" x=WIDTH - RIGHT y=HEIGHT - 8.0 text-anchor="end">{words::distance_in(unit)}</text>
                <path class="line-a" d=paths[0].clone()></path>
                <path class="line-b" d=paths[1].clone()></path>
                {end(ends[0], "line-a")}{end(ends[1], "line-b")}
                {labels}
            </svg>
        </figure>
    }
    .into_any()
}

/// Root mean square of the residuals in bands of the image; a line at what their standard errors let expect.
#[component]
fn Bands(name: crate::i18n::Text, bands: Vec<ResidualBand>, largest: f64, of: &'static str) -> impl IntoView {
    let high = if largest > 0.0 { 1.1 * largest } else { 1.0 };
    let end = bands.last().map_or(1.0, |band| band.to).max(1.0);
    let x = move |at: f64| LEFT + at / end * (WIDTH - RIGHT - LEFT);
    let y = move |value: f64| HEIGHT - BOTTOM - value / high * (HEIGHT - BOTTOM - TOP);
    let step = format::round_below(high / 2.0);
    let up = (0..=(high / step) as usize).map(|k| {
        let value = k as f64 * step;
        view! {
            <line class="grid" x1=LEFT x2=WIDTH - RIGHT y1=y(value) y2=y(value)></line>
            <text class="axis" x=LEFT - 5.0 y=y(value) + 4.0 text-anchor="end">{format::round(value)}</text>
        }
    });
    let up = up.collect_view();
    let expected: String = (bands.iter())
        .filter_map(|band| Some(format!("M{:.1} {:.1}H{:.1}", x(band.from), y(band.expected?), x(band.to))))
        .collect();
    let bars = bands.into_iter().filter_map(|band| {
        let rms = band.rms?;
        let (left, right) = (x(band.from) + 1.0, x(band.to) - 1.0);
        let said = words::band(format::fixed(band.from, 0), format::fixed(band.to, 0), px(rms), format::count(band.count));
        Some(view! { <rect class="bar-a" x=left y=y(rms) width=right - left height=y(0.0) - y(rms)><title>{said}</title></rect> })
    });
    let bars = bars.collect_view();
    view! {
        <figure class="map" data-plot=of>
            <figcaption>{name}</figcaption>
            <svg class="plot" viewBox=format!("0 0 {WIDTH} {HEIGHT}") role="img" aria-label=name>
                {up}{bars}
                <path class="expected" d=expected></path>
                <text class="axis" x=LEFT y=TOP - 8.0>"rms px"</text>
                <text class="axis" x=LEFT y=HEIGHT - BOTTOM + 14.0>"0"</text>
                <text class="axis" x=WIDTH - RIGHT y=HEIGHT - BOTTOM + 14.0 text-anchor="end">{format::fixed(end, 0)}</text>
            </svg>
        </figure>
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn ticks_are_round_within_the_limits_and_few() {
        let near =
            |a: Vec<f64>, b: &[f64]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a / b - 1.0).abs() < 1e-12);
        assert!(near(ticks(0.09, 1.0), &[0.1, 0.2, 0.5, 1.0]));
        assert!(near(ticks(100.0, 5000.0), &[100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0]));
        assert!(near(ticks(0.001, 20.0), &[0.001, 0.01, 0.1, 1.0, 10.0]));
    }
}
