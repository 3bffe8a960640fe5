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

/// Maps the object to the picture, and displacements by their exaggeration.
#[derive(Clone, Copy)]
struct Layout {
    right: [f64; 3],
    up: [f64; 3],
    middle: [f64; 2],
    /// Units of the picture in one of length.
    scale: f64,
    /// Exaggeration of displacements.
    factor: f64,
}

impl Layout {
    fn of(pair: &Pair, [right, up]: [[f64; 3]; 2], factor: f64) -> Self {
        let places: Vec<[f64; 2]> = pair.points.iter().map(|p| [dot(p.xyz, right), dot(p.xyz, up)]).collect();
        let end = |start: f64, of: fn(f64, f64) -> f64| {
            [0, 1].map(|axis| places.iter().map(|p: &[f64; 2]| p[axis]).fold(start, of))
        };
        let (low, high) = (end(f64::INFINITY, f64::min), end(f64::NEG_INFINITY, f64::max));
        let span = [high[0] - low[0], high[1] - low[1]].map(|s| if s > 0.0 { s } else { 1e-9 });
        let scale = ((WIDTH - 2.0 * MARGIN) / span[0]).min((HEIGHT - 2.0 * MARGIN) / span[1]);
        let middle = [0, 1].map(|axis| (low[axis] + high[axis]) / 2.0);
        Self { right, up, middle, scale, factor }
    }

    /// A vector in the plane of the picture.
    fn flat(self, xyz: [f64; 3]) -> [f64; 2] {
        [dot(xyz, self.right), dot(xyz, self.up)]
    }

    /// Place of a point in the picture.
    fn at(self, xyz: [f64; 3]) -> [f64; 2] {
        let [x, y] = self.flat(xyz);
        [WIDTH / 2.0 + (x - self.middle[0]) * self.scale, HEIGHT / 2.0 - (y - self.middle[1]) * self.scale]
    }
}

/// Head of an arrow between two places; `None` for a short one.
fn arrow_head([x, y]: [f64; 2], [tip_x, tip_y]: [f64; 2]) -> Option<impl IntoView> {
    let (dx, dy) = (tip_x - x, tip_y - y);
    let length = dx.hypot(dy);
    (length > 4.0).then(|| {
        let (ux, uy) = (dx / length, dy / length);
        let back = 6.0_f64.min(length);
        let side = |s: f64| (tip_x - back * ux - s * 3.5 * uy, tip_y - back * uy + s * 3.5 * ux);
        let ((ax, ay), (bx, by)) = (side(1.0), side(-1.0));
        view! { <path class="tip" d=format!("M{tip_x:.1} {tip_y:.1}L{ax:.1} {ay:.1}L{bx:.1} {by:.1}Z")></path> }
    })
}

/// A point with its displacement; with ellipse and value if it has moved or is chosen.
fn displacement(desk: Desk, pair: &Pair, k: usize, layout: Layout, unit: &str) -> impl IntoView + use<> {
    let chosen = desk.monitoring.point;
    let point = &pair.points[k];
    let look = look(pair, point);
    let own = chosen.with(|id| id.as_ref() == Some(&point.id));
    let decimals = sightline_report::epochs::decimals(pair);
    let [x, y] = layout.at(point.xyz);
    let [dx, dy] = layout.flat(point.difference).map(|d| d * layout.factor * layout.scale);
    let (tip_x, tip_y) = (x + dx, y - dy);
    let strong = matches!(look, "is-moved" | "is-out") || own;
    let ellipse = point.ellipsoid.as_ref().filter(|_| strong).map(|ellipsoid| {
        let (axes, angle) = ellipsoid.outline(layout.right, layout.up);
        let [a, b] = axes.map(|axis| axis * layout.factor * layout.scale);
        let turn = format!("rotate({:.2} {tip_x:.1} {tip_y:.1})", -angle.to_degrees());
        view! { <ellipse class="zone" cx=tip_x cy=tip_y rx=a ry=b transform=turn></ellipse> }
    });
    let head = arrow_head([x, y], [tip_x, tip_y]);
    let named = pair.points.len() <= NAMED || strong;
    let name = named.then(|| view! { <text x=x + 7.0 y=y - 6.0>{point.id.clone()}</text> });
    let value = strong.then(|| {
        // The name stands above the point: the value is below it, or beyond the tip.
        let below = if tip_y < y - 24.0 { tip_y - 8.0 } else { tip_y.max(y) + 16.0 };
        view! { <text class="value" x=tip_x + 6.0 y=below>{format::fixed(point.length, decimals)}</text> }
    });
    let id = point.id.clone();
    let title = format!("{} {} {unit}", point.id, format::fixed(point.length, decimals));
    view! {
        <g class=look class:chosen=own data-point=point.id.clone() on:click=move |_| chosen.set(Some(id.clone()))>
            <title>{title}</title>
            {ellipse}
            <path class="shift" d=format!("M{x:.1} {y:.1}L{tip_x:.1} {tip_y:.1}")></path>
            {head}{mark(look, x, y)}{name}{value}
        </g>
    }
}

/// The axes of the system that are not seen end on.
fn axes(layout: Layout, letters: ShownAxes) -> impl IntoView {
    let (from_x, from_y) = (40.0, HEIGHT - 26.0);
    let axis = |(k, axis): (usize, [f64; 3])| {
        let [x, y] = layout.flat(axis).map(|d| 34.0 * d);
        let name = letters.letter(k);
        (x.hypot(y) > 5.0).then(|| {
            view! {
                <path class="axes" d=format!("M{from_x:.1} {from_y:.1}l{x:.1} {:.1}", -y)></path>
                <text class="axis" x=from_x + 1.3 * x y=from_y - 1.3 * y + 4.0 text-anchor="middle">{name}</text>
            }
        })
    };
    let all = [(0, [1.0, 0.0, 0.0]), (1, [0.0, 1.0, 0.0]), (2, [0.0, 0.0, 1.0])];
    all.into_iter().filter_map(axis).collect_view()
}

fn rule(y: f64, length: f64, words: String) -> impl IntoView {
    let end = WIDTH - 14.0;
    let from = end - length;
    view! {
        <path class="rule" d=format!("M{from:.1} {:.1}v5H{end:.1}v-5", y - 5.0)></path>
        <text class="axis" x=from - 6.0 y=y text-anchor="end">{words}</text>
    }
}

fn drawn(desk: Desk) -> Option<impl IntoView> {
    let monitored = desk.monitoring;
    let (ran, (_, pair)) = monitored.current().zip(monitored.pair())?;
    let layout = Layout::of(&pair, monitored.seen.get().axes(), factor(desk));
    let unit = unit(&ran);
    // What moved is drawn last, above everything else.
    let chosen = monitored.point.get();
    let mut order: Vec<usize> = (0..pair.points.len()).collect();
    order.sort_by_key(|&k| (pair.points[k].moved, chosen.as_ref() == Some(&pair.points[k].id)));
    let marks = order.into_iter().map(|k| displacement(desk, &pair, k, layout, &unit)).collect_view();
    // Two rules: lengths of the object, and of displacements at their exaggeration.
    let bar = round(0.16 * WIDTH / layout.scale);
    let (length, small) = (bar * layout.scale, bar / layout.factor);
    Some(view! {
        <svg class="displacements" viewBox=format!("0 0 {WIDTH} {HEIGHT}") role="img" aria-label=words::picture>
            {marks}
            {axes(layout, ShownAxes::of(ran.found.axes))}
            {rule(HEIGHT - 30.0, length, format!("{} {unit}", format::round(bar)))}
            {rule(HEIGHT - 12.0, length, format!("{} {} {unit}", words::exaggeration(), format::round(small)))}
        </svg>
    })
}
