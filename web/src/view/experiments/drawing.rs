//! The network in plan and elevation, to one scale.

use leptos::prelude::*;
use sightline::project::Role;
use sightline_lab::experiments::{Drawing, Drawn};

use super::names;
use crate::format;
use crate::i18n::experiments as words;

const WIDTH: f64 = 340.0;
/// Both views together, without their labels.
const HEIGHT: f64 = 360.0;
const MARGIN: f64 = 22.0;
/// More places than this are drawn without names.
const NAMED: usize = 16;

/// Low and high end along an axis.
type Extent = [f64; 2];

fn extent(drawing: &Drawing, axis: usize) -> Extent {
    let all = || drawing.points.iter().chain(&drawing.photos).map(|d| d.xyz[axis]);
    [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
}

/// The drawing, of X across and `up` (1: plan, 2: elevation) upwards.
fn seen(drawing: &Drawing, up: usize, scale: f64, x: Extent, y: Extent, top: f64) -> impl IntoView + use<> {
    let middle = (x[0] + x[1]) / 2.0;
    let right = move |d: &Drawn| WIDTH / 2.0 + (d.xyz[0] - middle) * scale;
    let down = move |d: &Drawn| top + (y[1] - d.xyz[up]) * scale;
    let points = drawing.points.iter().map(|p| point(p, right(p), down(p))).collect_view();
    let photos = drawing.photos.iter().map(|p| {
        let [dx, dy] = p.direction.map_or([0.0, 1.0], |d| [d[0], -d[up]]);
        // A camera that looks at the reader is a square, another an open wedge along its axis.
        let length = dx.hypot(dy);
        let (x, y) = (right(p), down(p));
        let path = if length < 0.3 {
            format!("M{:.1} {:.1}h7v7h-7z", x - 3.5, y - 3.5)
        } else {
            let (ux, uy) = (dx / length, dy / length);
            let side = |s: f64| (x + 11.0 * ux - s * 5.0 * uy, y + 11.0 * uy + s * 5.0 * ux);
            let ((ax, ay), (bx, by)) = (side(1.0), side(-1.0));
            format!("M{x:.1} {y:.1}L{ax:.1} {ay:.1}L{bx:.1} {by:.1}Z")
        };
        let id = p.id.clone();
        view! { <path class="camera" d=path><title>{id}</title></path> }
    });
    let photos = photos.collect_view();
    // Photos of one place share a label.
    let mut places: Vec<(f64, f64, Vec<String>)> = Vec::new();
    for p in &drawing.photos {
        let (x, y) = (right(p), down(p));
        match places.iter_mut().find(|(a, b, _)| (a - x).hypot(b - y) < 6.0) {
            Some((_, _, ids)) => ids.push(p.id.clone()),
            None => places.push((x, y, vec![p.id.clone()])),
        }
    }
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let few = places.len() <= NAMED && places.iter().all(|(_, _, ids)| ids.len() <= 3);
    let labels = few.then(|| {
        // A label that would run into the one before stands a line lower.
        let mut before = (f64::NEG_INFINITY, 0.0);
        let label = |(x, y, ids): (f64, f64, Vec<String>)| {
            let row = if x - before.0 < 24.0 { 11.0 - before.1 } else { 0.0 };
            before = (x, row);
            view! { <text class="axis" x=x y=y + 15.0 + row text-anchor="middle">{ids.join(", ")}</text> }
        };
        places.into_iter().map(label).collect_view()
    });
    (points, photos, labels)
}

fn point(p: &Drawn, x: f64, y: f64) -> AnyView {
    let id = p.id.clone();
    match p.role {
        Some(Role::Control) => {
            view! { <path class="control-at" d=format!("M{x:.1} {:.1}l4 7h-8z", y - 4.5)><title>{id}</title></path> }
                .into_any()
        }
        Some(Role::Check) => {
            view! { <rect class="check-at" x=x - 3.0 y=y - 3.0 width="6" height="6"><title>{id}</title></rect> }
                .into_any()
        }
        _ => view! { <circle class="tie-at" cx=x cy=y r="1.6"><title>{id}</title></circle> }.into_any(),
    }
}

/// Plan above elevation, with a bar for the scale.
#[component]
pub fn NetworkDrawing(drawing: Drawing) -> impl IntoView {
    let [x, y, z] = [0, 1, 2].map(|axis| extent(&drawing, axis));
    let size = |e: Extent| (e[1] - e[0]).max(1e-9);
    let scale = ((WIDTH - 2.0 * MARGIN) / size(x)).min(HEIGHT / (size(y) + size(z)));
    let plan_top = 34.0;
    let elevation_top = plan_top + size(y) * scale + 58.0;
    let bottom = elevation_top + size(z) * scale + 24.0;
    let bar = round_length(90.0 / scale);
    let unit = drawing.unit.clone();
    let plan = seen(&drawing, 1, scale, x, y, plan_top);
    let elevation = seen(&drawing, 2, scale, x, z, elevation_top);
    let title = drawing.id.clone();
    view! {
        <svg class="network" viewBox=format!("0 0 {WIDTH} {:.0}", bottom + 20.0) role="img"
            aria-label=move || format!("{} {}", words::network(), names::name(&title))>
            <text class="axis" x="4" y="12">{words::plan} " X, Y"</text>
            {plan}
            <text class="axis" x="4" y=elevation_top - 24.0>{words::elevation} " X, Z"</text>
            {elevation}
            <path class="rule" d=format!("M{:.1} {bottom:.1}v5h{:.1}v-5", WIDTH - 12.0 - bar * scale, bar * scale)></path>
            <text class="axis" x=WIDTH - 20.0 - bar * scale y=bottom + 6.0 text-anchor="end">{format!("{} {unit}", format::round(bar))}</text>
        </svg>
    }
}

/// The largest of 1, 2, 5 times a power of ten that is not above a length.
fn round_length(length: f64) -> f64 {
    let power = 10f64.powf(length.log10().floor());
    let share = length / power;
    power
        * if share >= 5.0 {
            5.0
        } else if share >= 2.0 {
            2.0
        } else {
            1.0
        }
}
