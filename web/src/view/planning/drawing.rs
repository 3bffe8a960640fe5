//! Plan and elevation to one scale each, with stations that can be dragged, and points by what they reach.

use leptos::prelude::*;
use sightline::plan::Prediction;
use sightline::project::{Plan, Role};

use super::predicted;
use crate::browser::event;
use crate::edit::plan::move_station;
use crate::format;
use crate::i18n::planning as words;
use crate::store::Desk;
use crate::store::document::Change;

const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 276.0;
const MARGIN: f64 = 26.0;
/// Length of a station's sign.
const SIGN: f64 = 13.0;

/// How lengths become places in the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Frame {
    /// Axes across and up.
    axes: [usize; 2],
    middle: [f64; 2],
    scale: f64,
}

impl Frame {
    /// Everything of the plan in sight, with some room to move stations in.
    fn of(plan: &Plan, axes: [usize; 2]) -> Self {
        let points = plan.points.iter().filter_map(|p| p.xyz);
        let regions = plan.forbidden.iter().flat_map(|r| [r.low, r.high]).filter(|c| c.iter().all(|x| x.abs() < 1e6));
        let all: Vec<[f64; 3]> = points.chain(plan.stations.iter().map(|s| s.position)).chain(regions).collect();
        let extent = |axis: usize| {
            let low = all.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
            let high = all.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
            if low <= high { (low, high) } else { (-1.0, 1.0) }
        };
        let [across, up] = axes.map(extent);
        let size = |(low, high): (f64, f64)| (1.15 * (high - low)).max(1e-9);
        let scale = ((WIDTH - 2.0 * MARGIN) / size(across)).min((HEIGHT - 2.0 * MARGIN) / size(up));
        Self { axes, middle: [(across.0 + across.1) / 2.0, (up.0 + up.1) / 2.0], scale: scale.min(1e9) }
    }

    fn at(&self, xyz: &[f64; 3]) -> [f64; 2] {
        [
            WIDTH / 2.0 + (xyz[self.axes[0]] - self.middle[0]) * self.scale,
            HEIGHT / 2.0 - (xyz[self.axes[1]] - self.middle[1]) * self.scale,
        ]
    }

    /// The lengths of a place.
    fn back(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.middle[0] + (x - WIDTH / 2.0) / self.scale, self.middle[1] - (y - HEIGHT / 2.0) / self.scale]
    }
}

#[component]
pub fn Views() -> impl IntoView {
    view! {
        <h2 class="section-head"><span>{words::top_view}</span><span class="aside">{words::drag_hint}</span></h2>
        <Drawing axes=[0, 1] name="top"/>
        <h2 class="section-head"><span>{words::front_view}</span><Legend/></h2>
        <Drawing axes=[0, 2] name="front"/>
    }
}

#[component]
fn Legend() -> impl IntoView {
    view! {
        <span class="plan-legend">
            <i class="dot good"></i>{words::legend_good}
            <i class="dot beyond"></i>{words::legend_beyond}
            <i class="dot none"></i>{words::legend_none}
        </span>
    }
}

/// How a point is coloured: by its half axis over what is wanted.
fn class_of(plan: &Plan, prediction: Option<&Prediction>, place: usize) -> &'static str {
    let Some(prediction) = prediction else { return "none" };
    let point = &plan.points[place];
    if point.role == Role::Control && plan.datum.kind == sightline::project::DatumKind::Control {
        return "given";
    }
    let Some(axis) = prediction.points.get(place).and_then(|p| p.axis) else { return "none" };
    let share = axis * prediction.factor / plan.wanted.precision;
    match share {
        s if s > 1.0 => "beyond",
        s if s > 0.8 => "good near",
        s if s > 0.5 => "good middle",
        _ => "good far",
    }
}

#[component]
fn Drawing(axes: [usize; 2], name: &'static str) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let planning = desk.planning;
    // While a station is dragged the drawing stands still.
    let frame = Memo::new(move |_| desk.document.with(|d| d.project.plan.as_deref().map(|plan| Frame::of(plan, axes))));
    let dragged = StoredValue::new(None::<String>);
    let moved = StoredValue::new(false);
    let place = move |e: &leptos::ev::PointerEvent| {
        let [x, y] = event::share(e);
        [x * WIDTH, y * HEIGHT]
    };
    let on_down = move |e: leptos::ev::PointerEvent| {
        let (Some(frame), Some(plan)) = (frame.get_untracked(), untrack(|| desk.plan())) else { return };
        let at = place(&e);
        let far = |xyz: &[f64; 3]| {
            let [x, y] = frame.at(xyz);
            (x - at[0]).hypot(y - at[1])
        };
        let near = plan.stations.iter().min_by(|a, b| far(&a.position).total_cmp(&far(&b.position)));
        let reach = if event::pointer(&e).touch { 30.0 } else { 16.0 };
        if let Some(station) = near.filter(|s| far(&s.position) < reach) {
            event::capture(&e);
            e.prevent_default();
            planning.chosen.set(Some(station.id.clone()));
            dragged.set_value(Some(station.id.clone()));
            moved.set_value(false);
        }
    };
    let on_move = move |e: leptos::ev::PointerEvent| {
        let (Some(id), Some(frame)) = (dragged.get_value(), frame.get_untracked()) else { return };
        let Some(mut plan) = untrack(|| desk.shown_plan()) else { return };
        moved.set_value(true);
        move_station(&mut plan, &id, frame.axes, frame.back(place(&e)).map(rounded));
        planning.live.set(Some(plan));
    };
    let on_up = move |_: leptos::ev::PointerEvent| {
        let Some(id) = dragged.get_value() else { return };
        dragged.set_value(None);
        let live = planning.live.get_untracked();
        if let (true, Some(live)) = (moved.get_value(), live) {
            let stations = live.stations;
            desk.edit_plan(Change::StationMoved(id), |plan| plan.stations = stations);
        }
    };
    let content = move || {
        let frame = frame.get()?;
        let plan = desk.shown_plan()?;
        let prediction = predicted(desk);
        Some(drawn(&frame, &plan, prediction.as_ref(), planning.chosen.get().as_deref(), &desk))
    };
    view! {
        <svg class="plan-view" data-view=name viewBox=format!("0 0 {WIDTH} {HEIGHT}") role="img"
            aria-label=move || if axes[1] == 1 { words::top_view() } else { words::front_view() }
            on:pointerdown=on_down on:pointermove=on_move on:pointerup=on_up on:pointercancel=on_up>
            {content}
        </svg>
    }
}

/// A coordinate to three digits after the first that matters in a drawing.
pub fn rounded(value: f64) -> f64 {
    let step = 10f64.powf((value.abs().max(1e-9)).log10().floor() - 3.0);
    (value / step).round() * step
}

fn drawn(
    frame: &Frame,
    plan: &Plan,
    prediction: Option<&Prediction>,
    chosen: Option<&str>,
    desk: &Desk,
) -> impl IntoView + use<> {
    let regions = plan.forbidden.iter().map(|region| {
        let (a, b) = (frame.at(&region.low), frame.at(&region.high));
        let clip = |v: f64| v.clamp(-50.0, WIDTH + 50.0);
        let (x, y) = (clip(a[0].min(b[0])), clip(a[1].min(b[1])));
        let (x1, y1) = (clip(a[0].max(b[0])), clip(a[1].max(b[1])));
        view! { <rect class="forbidden" x=x y=y width=x1 - x height=y1 - y></rect> }
    });
    let regions = regions.collect_view();
    // What the chosen station sees, as its picture's corners at the object's distance.
    let cone = chosen.and_then(|id| {
        let place = plan.stations.iter().position(|s| s.id == id)?;
        let sight = prediction?.stations.get(place)?;
        let reach = sight.distance? * 1.05;
        let from = frame.at(&plan.stations[place].position);
        let ends = sight.corners.map(|c| {
            let p = plan.stations[place].position;
            frame.at(&[0, 1, 2].map(|k| p[k] + reach * c[k]))
        });
        let rays = ends.map(|e| format!("M{:.1} {:.1}L{:.1} {:.1}", from[0], from[1], e[0], e[1])).concat();
        let frame = format!(
            "M{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}Z",
            ends[0][0], ends[0][1], ends[1][0], ends[1][1], ends[2][0], ends[2][1], ends[3][0], ends[3][1]
        );
        Some(view! { <path class="cone" d=frame></path><path class="cone-rays" d=rays></path> })
    });
    let points = (0..plan.points.len()).filter_map(|k| {
        let [x, y] = frame.at(&plan.points[k].xyz?);
        let class = class_of(plan, prediction, k);
        let id = plan.points[k].id.clone();
        let told = prediction
            .and_then(|p| p.points.get(k))
            .and_then(|p| p.axis)
            .zip(prediction)
            .map_or_else(|| id.clone(), |(axis, p)| format!("{id}: {}", format::compact(axis * p.factor)));
        Some(if class == "beyond" {
            let d = format!("M{:.1} {:.1}l6 6m0 -6l-6 6", x - 3.0, y - 3.0);
            view! { <path class="beyond-at" d=d><title>{told}</title></path> }.into_any()
        } else {
            view! { <circle class=format!("point-at {class}") cx=x cy=y r="3"><title>{told}</title></circle> }
                .into_any()
        })
    });
    let points = points.collect_view();
    let suggested = desk.planning.suggested.get();
    let hints = suggested.iter().enumerate().map(|(k, s)| {
        let [x, y] = frame.at(&s.station.position);
        let label = (k + 1).to_string();
        view! {
            <circle class="hint-at" cx=x cy=y r="9"></circle>
            <text class="axis hint-label" x=x y=y + 3.5 text-anchor="middle">{label}</text>
        }
    });
    let hints = hints.collect_view();
    let stations = plan.stations.iter().enumerate().map(|(k, station)| {
        let [x, y] = frame.at(&station.position);
        let sight = prediction.and_then(|p| p.stations.get(k)).filter(|s| s.id == station.id);
        let look = sight.map_or([0.0, 1.0, 0.0], |s| s.direction);
        let [dx, dy] = [look[frame.axes[0]], -look[frame.axes[1]]];
        let length = dx.hypot(dy);
        let path = if length < 0.3 {
            format!("M{:.1} {:.1}h10v10h-10z", x - 5.0, y - 5.0)
        } else {
            let (ux, uy) = (dx / length, dy / length);
            let side = |s: f64| (x + SIGN * ux - s * 6.0 * uy, y + SIGN * uy + s * 6.0 * ux);
            let ((ax, ay), (bx, by)) = (side(1.0), side(-1.0));
            format!("M{x:.1} {y:.1}L{ax:.1} {ay:.1}L{bx:.1} {by:.1}Z")
        };
        let class = format!(
            "station-at{}{}",
            if chosen == Some(station.id.as_str()) { " chosen" } else { "" },
            if station.taken { " taken" } else { "" }
        );
        let (id, label) = (station.id.clone(), station.id.clone());
        // Behind the camera, where its sign is not.
        let (lx, ly) =
            if length < 0.3 { (x, y + 18.0) } else { (x - 10.0 * dx / length, y - 10.0 * dy / length + 4.0) };
        view! {
            <g class=class data-station=id>
                <path d=path></path>
                <text class="axis" x=lx y=ly text-anchor="middle">{label}</text>
            </g>
        }
    });
    let stations = stations.collect_view();
    let unit = desk.document.with(|d| d.project.unit.clone());
    let bar = round_length(110.0 / frame.scale);
    let long = bar * frame.scale;
    view! {
        {regions}{cone}{points}{hints}{stations}
        <path class="rule" d=format!("M{:.1} {:.1}v5h{long:.1}v-5", WIDTH - 14.0 - long, HEIGHT - 16.0)></path>
        <text class="axis" x=WIDTH - 20.0 - long y=HEIGHT - 11.0 text-anchor="end">{format!("{} {unit}", format::round(bar))}</text>
    }
}

/// The largest of 1, 2, 5 times a power of ten that is not above a length.
fn round_length(length: f64) -> f64 {
    let power = 10f64.powf(length.max(1e-12).log10().floor());
    let share = length / power;
    let first = [5.0, 2.0, 1.0].into_iter().find(|step| share >= *step).unwrap_or(1.0);
    power * first
}
