//! Displacements as a picture: from above, from the front or from the side, at a stated exaggeration.

use leptos::prelude::*;
use sightline::axes::ShownAxes;
use sightline::depiction::round;
use sightline::monitoring::{Displacement, Pair, PointRole};

use super::unit;
use crate::browser::event;
use crate::format;
use crate::i18n::{Text, monitoring as words};
use crate::store::Desk;
use crate::store::monitoring::Seen;

const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 500.0;
const MARGIN: f64 = 56.0;
/// More points than this have their names where they are chosen or moved.
const NAMED: usize = 60;
/// The slider reaches from this factor to its power of ten above, in steps of a tenth of a decade.
const DECADES: [f64; 2] = [0.0, 6.0];

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The factor in use.
pub fn factor(desk: Desk) -> f64 {
    desk.monitoring.shown_factor()
}

fn look(pair: &Pair, point: &Displacement) -> &'static str {
    match (point.role, pair.unstable.contains(&point.id)) {
        (PointRole::Reference, _) => "is-reference",
        (PointRole::Object, true) => "is-out",
        (PointRole::Object, false) if point.moved => "is-moved",
        (PointRole::Object, false) => "is-still",
    }
}

/// The mark of a point: full where it moved, a triangle for a reference point, crossed out where that is not stable.
fn mark(look: &str, x: f64, y: f64) -> AnyView {
    match look {
        "is-reference" => view! { <path class="place" d=format!("M{x:.1} {:.1}l5.5 9h-11z", y - 5.5)></path> }.into_any(),
        "is-out" => view! { <path class="place" d=format!("M{x:.1} {:.1}l5.5 9h-11zM{:.1} {:.1}l8 8m0 -8l-8 8", y - 5.5, x - 4.0, y - 4.0)></path> }.into_any(),
        "is-moved" => view! { <circle class="place" cx=x cy=y r="3.5"></circle> }.into_any(),
        _ => view! { <circle class="place" cx=x cy=y r="2.5"></circle> }.into_any(),
    }
}

#[component]
pub fn Picture() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    let views: [(Seen, &str, Text); 4] = [
        (Seen::Oblique, "oblique", words::oblique),
        (Seen::Top, "top", words::top),
        (Seen::Front, "front", words::front),
        (Seen::Side, "side", words::side),
    ];
    // One digit, so that what is stated is what is drawn.
    let slide = move |typed: &str| {
        if let Ok(power) = typed.parse::<f64>() {
            let factor = 10f64.powf(power);
            let digits = 10f64.powf(factor.log10().floor());
            monitored.factor.set(Some((factor / digits).round().max(1.0) * digits));
        }
    };
    let slider = move || format!("{:.1}", factor(desk).max(1.0).log10());
    let percent = move || monitored.options.with(|o| format::editable((1e6 * (1.0 - o.significance)).round() / 1e4));
    let legend: [(&str, Text); 4] = [
        ("is-moved", words::legend_moved),
        ("is-still", words::legend_stable),
        ("is-reference", words::legend_reference),
        ("is-out", words::legend_out),
    ];
    view! {
        <section class="epoch-picture">
            <div class="toggles">
                {views.map(|(one, key, name)| view! {
                    <button class="toggle" data-seen=key aria-pressed=move || (monitored.seen.get() == one).to_string()
                        on:click=move |_| monitored.seen.set(one)>{name}</button>
                }).collect_view()}
                <span class="gap"></span>
                <Show when=move || desk.shows_displacements()>
                    <button class="toggle" data-action="in-photos" on:click=move |_| desk.show_in_photo()>{words::in_photos}</button>
                </Show>
                <button class="toggle" data-action="csv" on:click=move |_| desk.export_monitoring("csv", 1.0)>{words::table_file}</button>
                <button class="toggle" data-action="dxf" on:click=move |_| desk.export_monitoring("dxf", untrack(|| factor(desk)))>{words::drawing}</button>
                <button class="toggle" data-action="gltf" on:click=move |_| desk.export_monitoring("gltf", untrack(|| factor(desk)))>{words::scene}</button>
                <button class="toggle" data-action="json" on:click=move |_| desk.export_monitoring("json", 1.0)>{words::all_file}</button>
            </div>
            <div class="picture-host">{move || drawn(desk)}</div>
            <div class="scales">
                <label class="scale"><span>{words::exaggeration}</span>
                    <input type="range" name="exaggeration" min=DECADES[0] max=DECADES[1] step="0.1" prop:value=slider
                        on:input=move |e| slide(&event::value(&e))/>
                    <b data-found="factor">{move || format!("× {}", format::count(factor(desk).round() as usize))}</b>
                </label>
                <span>{move || words::ellipses(percent())}</span>
                <span class="gap"></span>
                <ul class="picture-legend">
                    {legend.map(|(look, name)| view! {
                        <li><svg width="16" height="14" viewBox="0 0 16 14" aria-hidden="true"><g class=look>{mark(look, 8.0, 7.0)}</g></svg><span>{name}</span></li>
                    }).collect_view()}
                </ul>
            </div>
        </section>
    }
}

fn drawn(desk: Desk) -> Option<impl IntoView> {
    let monitored = desk.monitoring;
    let (ran, (_, pair)) = monitored.current().zip(monitored.pair())?;
    let seen = monitored.seen.get();
    let [right, up] = seen.axes();
    let flat = |xyz: [f64; 3]| [dot(xyz, right), dot(xyz, up)];
    let places: Vec<[f64; 2]> = pair.points.iter().map(|p| flat(p.xyz)).collect();
    let end = |axis: usize, start: f64, of: fn(f64, f64) -> f64| places.iter().map(|p| p[axis]).fold(start, of);
    let low = [end(0, f64::INFINITY, f64::min), end(1, f64::INFINITY, f64::min)];
    let high = [end(0, f64::NEG_INFINITY, f64::max), end(1, f64::NEG_INFINITY, f64::max)];
    let span = [high[0] - low[0], high[1] - low[1]].map(|s| if s > 0.0 { s } else { 1e-9 });
    let scale = ((WIDTH - 2.0 * MARGIN) / span[0]).min((HEIGHT - 2.0 * MARGIN) / span[1]);
    let at = move |p: [f64; 2]| {
        (
            WIDTH / 2.0 + (p[0] - (low[0] + high[0]) / 2.0) * scale,
            HEIGHT / 2.0 - (p[1] - (low[1] + high[1]) / 2.0) * scale,
        )
    };
    let factor = factor(desk);
    let few = pair.points.len() <= NAMED;
    let chosen = monitored.point.get();
    let unit = unit(&ran);
    let decimals = sightline::report::epochs::decimals(&pair);
    // What moved is drawn last, above everything else.
    let mut order: Vec<usize> = (0..pair.points.len()).collect();
    order.sort_by_key(|&k| (pair.points[k].moved, chosen.as_ref() == Some(&pair.points[k].id)));
    let marks = order.into_iter().map(|k| {
        let point = &pair.points[k];
        let look = look(&pair, point);
        let own = chosen.as_ref() == Some(&point.id);
        let (x, y) = at(places[k]);
        let [dx, dy] = flat(point.difference).map(|d| d * factor * scale);
        let (tip_x, tip_y) = (x + dx, y - dy);
        let strong = matches!(look, "is-moved" | "is-out") || own;
        let ellipse = point.ellipsoid.as_ref().filter(|_| strong).map(|ellipsoid| {
            let (axes, angle) = ellipsoid.outline(right, up);
            let [a, b] = axes.map(|axis| axis * factor * scale);
            let turn = format!("rotate({:.2} {tip_x:.1} {tip_y:.1})", -angle.to_degrees());
            view! { <ellipse class="zone" cx=tip_x cy=tip_y rx=a ry=b transform=turn></ellipse> }
        });
        let length = dx.hypot(dy);
        let head = (length > 4.0).then(|| {
            let (ux, uy) = (dx / length, -dy / length);
            let back = 6.0_f64.min(length);
            let side = |s: f64| (tip_x - back * ux - s * 3.5 * uy, tip_y - back * uy + s * 3.5 * ux);
            let ((ax, ay), (bx, by)) = (side(1.0), side(-1.0));
            view! { <path class="tip" d=format!("M{tip_x:.1} {tip_y:.1}L{ax:.1} {ay:.1}L{bx:.1} {by:.1}Z")></path> }
        });
        let name = (few || strong).then(|| view! { <text x=x + 7.0 y=y - 6.0>{point.id.clone()}</text> });
        let value = strong.then(|| {
            // The name stands above the point: the value is below it, or beyond the tip.
            let below = if tip_y < y - 24.0 { tip_y - 8.0 } else { tip_y.max(y) + 16.0 };
            view! { <text class="value" x=tip_x + 6.0 y=below>{format::fixed(point.length, decimals)}</text> }
        });
        let id = point.id.clone();
        let title = format!("{} {} {unit}", point.id, format::fixed(point.length, decimals));
        view! {
            <g class=look class:chosen=own data-point=point.id.clone() on:click=move |_| monitored.point.set(Some(id.clone()))>
                <title>{title}</title>
                {ellipse}
                <path class="shift" d=format!("M{x:.1} {y:.1}L{tip_x:.1} {tip_y:.1}")></path>
                {head}{mark(look, x, y)}{name}{value}
            </g>
        }
    });
    let marks = marks.collect_view();
    // Two rules: lengths of the object, and of displacements at their exaggeration.
    let bar = round(0.16 * WIDTH / scale);
    let small = bar / factor;
    // The axes of the system, as far as they are seen.
    let letters = ShownAxes::of(ran.found.axes);
    let axes = [(0, [1.0, 0.0, 0.0]), (1, [0.0, 1.0, 0.0]), (2, [0.0, 0.0, 1.0])]
        .map(|(k, axis)| (letters.letter(k), axis))
        .into_iter()
        .filter_map(|(name, axis)| {
            let [x, y] = flat(axis).map(|d| 34.0 * d);
            let (from_x, from_y) = (40.0, HEIGHT - 26.0);
            (x.hypot(y) > 5.0).then(|| {
                view! {
                    <path class="axes" d=format!("M{from_x:.1} {from_y:.1}l{x:.1} {:.1}", -y)></path>
                    <text class="axis" x=from_x + 1.3 * x y=from_y - 1.3 * y + 4.0 text-anchor="middle">{name}</text>
                }
            })
        });
    let axes = axes.collect_view();
    let rule = |y: f64, length: f64, words: String| {
        let end = WIDTH - 14.0;
        let from = end - length;
        view! {
            <path class="rule" d=format!("M{from:.1} {:.1}v5H{end:.1}v-5", y - 5.0)></path>
            <text class="axis" x=from - 6.0 y=y text-anchor="end">{words}</text>
        }
    };
    Some(view! {
        <svg class="displacements" viewBox=format!("0 0 {WIDTH} {HEIGHT}") role="img" aria-label=words::picture>
            {marks}
            {axes}
            {rule(HEIGHT - 30.0, bar * scale, format!("{} {unit}", format::round(bar)))}
            {rule(HEIGHT - 12.0, bar * scale, format!("{} {} {unit}", words::exaggeration(), format::round(small)))}
        </svg>
    })
}
