//! The plan from above and from another side to one scale each, with stations that can be dragged, and points by what they reach.

use std::sync::Arc;

use leptos::ev::PointerEvent;
use leptos::prelude::*;
use sightline::axes::ShownAxes;
use sightline::project::{DatumKind, Plan, Role};
use sightline_plan::Prediction;

use super::frame::{DrawingFrame, HEIGHT, Look, WIDTH};
use super::labels::{Sign, labels};
use super::predicted;
use crate::browser::event;
use crate::document::Change;
use crate::format;
use crate::i18n::planning as words;
use crate::store::Desk;

/// Length of a station's sign.
const SIGN: f64 = 13.0;
/// Half axis of an ellipse as large as is wanted.
const WANTED: f64 = 8.0;
/// Largest half axis that is drawn.
const LARGEST: f64 = 60.0;
/// Turn and tilt that the view in space begins with.
const BEGIN: [f64; 2] = [-0.6, 0.45];

#[component]
pub fn Views() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let upper = RwSignal::new(Look::Top);
    let lower = RwSignal::new(Look::Front);
    let tab = move |look: Look| {
        let label = move || look_words(desk.axes(), look);
        let chosen = move || lower.with(|l| l.name() == look.name());
        view! {
            <button class="link" class:chosen=chosen aria-pressed=move || chosen().to_string() data-look=look.name()
                on:click=move |_| lower.set(look)>{label}</button>
        }
    };
    view! {
        <h2 class="section-head"><span>{move || look_words(desk.axes(), Look::Top)}</span><span class="aside">{words::drag_hint}</span></h2>
        <Drawing look=upper/>
        <div class="section-head">
            <span class="looks">
                {tab(Look::Front)}{tab(Look::Side)}{tab(Look::Space(BEGIN))}
            </span>
            <Legend/>
        </div>
        <Drawing look=lower/>
    }
}

/// Axes of a view of the plan: to the right and upwards.
fn look_words(axes: ShownAxes, look: Look) -> String {
    let [x, y, z] = [0, 1, 2].map(|axis| axes.letter(axis));
    match look {
        Look::Top => words::top_view(x, y),
        Look::Front => words::elevation(x, z),
        Look::Side => words::elevation(y, z),
        Look::Space(_) => words::space_view().to_owned(),
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
    let Some(point) = plan.points.get(place) else { return "none" };
    if point.role == Role::Control && plan.datum.kind == DatumKind::Control {
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

/// The dragged object.
#[derive(Clone, PartialEq)]
enum Dragged {
    Station(String),
    /// The view itself, from this place.
    Space([f64; 2]),
    /// A region without access, from this corner.
    Region([f64; 2]),
}

/// Dragging in the drawing: stations, the 3-D view, or a new region without access.
#[derive(Clone, Copy)]
struct Dragging {
    desk: Desk,
    look: RwSignal<Look>,
    frame: Memo<Option<DrawingFrame>>,
    dragged: StoredValue<Option<Dragged>>,
    /// Opposite corners of the region that is being drawn.
    fence: RwSignal<Option<[[f64; 2]; 2]>>,
}

/// Place of a pointer in the drawing.
fn place(e: &PointerEvent) -> [f64; 2] {
    let [x, y] = event::share(e);
    [x * WIDTH, y * HEIGHT]
}

impl Dragging {
    fn new(desk: Desk, look: RwSignal<Look>, frame: Memo<Option<DrawingFrame>>) -> Self {
        Self { desk, look, frame, dragged: StoredValue::new(None), fence: RwSignal::new(None) }
    }

    /// Whether a region is to be drawn.
    fn fencing(self) -> bool {
        self.desk.planning.fencing.get() && !matches!(self.look.get(), Look::Space(_))
    }

    fn down(self, e: &PointerEvent) {
        let (Some(frame), Some(plan)) = (self.frame.get_untracked(), untrack(|| self.desk.plan())) else { return };
        let at = place(e);
        let near = || {
            let far = |xyz: &[f64; 3]| {
                let [x, y] = frame.at(xyz);
                (x - at[0]).hypot(y - at[1])
            };
            let nearest = plan.stations.iter().min_by(|a, b| far(&a.position).total_cmp(&far(&b.position)));
            let reach = if event::pointer(e).touch { 30.0 } else { 16.0 };
            nearest.filter(|station| far(&station.position) < reach)
        };
        let what = if untrack(|| self.fencing()) {
            Dragged::Region(at)
        } else if let Some(station) = near() {
            self.desk.planning.chosen.set(Some(station.id.clone()));
            Dragged::Station(station.id.clone())
        } else if matches!(self.look.get_untracked(), Look::Space(_)) {
            Dragged::Space(at)
        } else {
            return;
        };
        event::capture(e);
        e.prevent_default();
        self.dragged.set_value(Some(what));
    }

    fn moved(self, e: &PointerEvent) {
        let (Some(what), Some(frame)) = (self.dragged.get_value(), self.frame.get_untracked()) else { return };
        let to = place(e);
        match what {
            Dragged::Station(id) => {
                let Some(mut plan) = untrack(|| self.desk.shown_plan()) else { return };
                if let Some(station) = plan.stations.iter_mut().find(|s| s.id == id) {
                    station.position = frame.moved(&station.position, to);
                    self.desk.planning.live.set(Some(Arc::new(plan)));
                }
            }
            Dragged::Space(from) => {
                if let Look::Space([turn, tilt]) = self.look.get_untracked() {
                    let turned = [turn - (to[0] - from[0]) * 0.01, (tilt + (to[1] - from[1]) * 0.01).clamp(-1.5, 1.5)];
                    self.look.set(Look::Space(turned));
                }
                self.dragged.set_value(Some(Dragged::Space(to)));
            }
            Dragged::Region(from) => self.fence.set(Some([from, to])),
        }
    }

    fn up(self) {
        let planning = self.desk.planning;
        let what = self.dragged.get_value();
        self.dragged.set_value(None);
        if let Some(corners) = self.fence.get_untracked() {
            self.fence.set(None);
            planning.fencing.set(false);
            let side = (corners[0][0] - corners[1][0]).abs().min((corners[0][1] - corners[1][1]).abs());
            if let Some(region) = self.frame.get_untracked().and_then(|f| f.region(corners)).filter(|_| side > 3.0) {
                self.desk.edit_plan(Change::PlanEdited, |plan| plan.forbidden.push(region));
            }
            return;
        }
        let (Some(Dragged::Station(id)), Some(live)) = (what, planning.live.get_untracked()) else { return };
        let stations = live.stations.clone();
        self.desk.edit_plan(Change::StationMoved(id), |plan| plan.stations = stations);
    }
}

#[component]
fn Drawing(look: RwSignal<Look>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let planning = desk.planning;
    // While a station is dragged the drawing stands still.
    let frame = Memo::new(move |_| {
        let look = look.get();
        desk.document.with(|d| d.project.plan.as_deref().map(|plan| DrawingFrame::of(plan, look)))
    });
    let dragging = Dragging::new(desk, look, frame);
    let object = move || {
        let frame = frame.get()?;
        desk.document.with(|d| d.project.plan.as_deref().map(|plan| object(&frame, plan)))
    };
    let points = move || {
        let (frame, prediction) = (frame.get()?, predicted(desk));
        desk.document.with(|d| d.project.plan.as_deref().map(|plan| points(&frame, plan, prediction.as_deref())))
    };
    let hints = move || Some(hints(&frame.get()?, &desk));
    let stations = move || {
        let (frame, prediction, chosen) = (frame.get()?, predicted(desk), planning.chosen.get());
        desk.with_plan(|plan| stations(&frame, plan, prediction.as_deref(), chosen.as_deref()))
    };
    let rule = move || {
        let frame = frame.get()?;
        let (unit, wanted) = desk
            .document
            .with(|d| (d.project.unit.clone(), d.project.plan.as_deref().map_or(1.0, |plan| plan.wanted.precision)));
        Some(rule(&frame, &unit, wanted))
    };
    let fenced = move || {
        let [[x, y], [to_x, to_y]] = dragging.fence.get()?;
        Some(view! {
            <rect class="forbidden" x=x.min(to_x) y=y.min(to_y) width=(x - to_x).abs() height=(y - to_y).abs()></rect>
        })
    };
    view! {
        <svg class="plan-view" class:fencing=move || dragging.fencing() data-view=move || look.with(|l| l.name()) viewBox=format!("0 0 {WIDTH} {HEIGHT}") role="img"
            aria-label=move || look_words(desk.axes(), look.get())
            on:pointerdown=move |e| dragging.down(&e) on:pointermove=move |e| dragging.moved(&e)
            on:pointerup=move |_| dragging.up() on:pointercancel=move |_| dragging.up()>
            {object}{points}{hints}{stations}{fenced}{rule}
        </svg>
    }
}

/// Faces, and regions without access.
fn object(frame: &DrawingFrame, plan: &Plan) -> impl IntoView + use<> {
    let clip = |[x, y]: [f64; 2]| (x.clamp(-50.0, WIDTH + 50.0), y.clamp(-50.0, HEIGHT + 50.0));
    let faces = plan.faces.iter().map(|face| {
        let corner =
            |a: f64, b: f64| frame.at(&[0, 1, 2].map(|k| face.corner[k] + a * face.along[k] + b * face.across[k]));
        let [p, q, r, s] = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
        format!("M{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}Z", p[0], p[1], q[0], q[1], r[0], r[1], s[0], s[1])
    });
    let faces: String = faces.collect();
    let regions = plan.forbidden.iter().map(|region| {
        // The outline of its eight corners, as wide and high as they are seen.
        let corners = (0..8).map(|n| {
            let side = |k: usize| if n >> k & 1 == 0 { region.low[k] } else { region.high[k] };
            clip(frame.at(&[side(0), side(1), side(2)]))
        });
        let (mut low, mut high) = ((f64::INFINITY, f64::INFINITY), (f64::NEG_INFINITY, f64::NEG_INFINITY));
        for (x, y) in corners {
            low = (low.0.min(x), low.1.min(y));
            high = (high.0.max(x), high.1.max(y));
        }
        view! { <rect class="forbidden" x=low.0 y=low.1 width=high.0 - low.0 height=high.1 - low.1></rect> }
    });
    let regions = regions.collect_view();
    view! { {regions}<path class="faces" d=faces></path> }
}

/// Points by what they reach, with their ellipses.
fn points(frame: &DrawingFrame, plan: &Plan, prediction: Option<&Prediction>) -> impl IntoView + use<> {
    // As large as is wanted, with the wanted probability, is as large everywhere.
    let times = prediction.map_or(1.0, |p| p.factor) * WANTED / plan.wanted.precision;
    // One path for all of a colour: elements by the hundred cost more than what they show while a station is dragged.
    let mut ellipses = [String::new(), String::new()];
    let signs = (0..plan.points.len()).filter_map(|k| {
        let [x, y] = frame.at(&plan.points[k].xyz?);
        let class = class_of(plan, prediction, k);
        let predicted = prediction.and_then(|p| p.points.get(k));
        if let Some(covariance) = predicted.and_then(|p| p.covariance).filter(|_| class != "given") {
            let [large, small, angle] = frame.ellipse(&covariance);
            let [large, small] = [large, small].map(|axis| (axis * times).min(LARGEST));
            // From one end of the larger axis over the other and back.
            let (sin, cos) = angle.to_radians().sin_cos();
            let (dx, dy) = (large * cos, large * sin);
            let turn = |to: f64| format!("a{large:.2} {small:.2} {angle:.1} 1 0 {:.2} {:.2}", to * dx, to * dy);
            let outline = format!("M{:.2} {:.2}{}{}", x - dx, y - dy, turn(2.0), turn(-2.0));
            ellipses[usize::from(class == "beyond")].push_str(&outline);
        }
        let id = &plan.points[k].id;
        let told = predicted
            .and_then(|p| p.axis)
            .zip(prediction)
            .map_or_else(|| id.clone(), |(axis, p)| format!("{id}: {}", format::compact(axis * p.factor)));
        Some(if class == "beyond" {
            let d = format!("M{:.1} {:.1}l6 6m0 -6l-6 6", x - 3.0, y - 3.0);
            view! { <path class="beyond-at" d=d><title>{told}</title></path> }.into_any()
        } else {
            view! { <circle class=format!("point-at {class}") cx=format!("{x:.1}") cy=format!("{y:.1}") r="3"><title>{told}</title></circle> }
                .into_any()
        })
    });
    let signs = signs.collect_view();
    let [within, beyond] = ellipses;
    view! { <path class="ellipse" d=within></path><path class="ellipse beyond" d=beyond></path>{signs} }
}

/// Places for the next photo.
fn hints(frame: &DrawingFrame, desk: &Desk) -> impl IntoView + use<> {
    let suggested = desk.planning.suggested.get();
    let hints = suggested.iter().enumerate().map(|(k, s)| {
        let [x, y] = frame.at(&s.station.position);
        let label = (k + 1).to_string();
        view! {
            <circle class="hint-at" cx=x cy=y r="9"></circle>
            <text class="axis hint-label" x=x y=y + 3.5 text-anchor="middle">{label}</text>
        }
    });
    hints.collect_view()
}

/// Stations with their numbers, and what the chosen one sees: its picture's corners at the object's distance.
fn stations(
    frame: &DrawingFrame,
    plan: &Plan,
    prediction: Option<&Prediction>,
    chosen: Option<&str>,
) -> impl IntoView + use<> {
    let cone = chosen.and_then(|id| {
        let place = plan.stations.iter().position(|s| s.id == id)?;
        let sight = prediction?.stations.get(place)?;
        let reach = sight.distance? * 1.05;
        let p = plan.stations[place].position;
        let from = frame.at(&p);
        let ends = sight.corners.map(|c| frame.at(&[0, 1, 2].map(|k| p[k] + reach * c[k])));
        let rays = ends.map(|e| format!("M{:.1} {:.1}L{:.1} {:.1}", from[0], from[1], e[0], e[1])).concat();
        let outline = format!(
            "M{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}Z",
            ends[0][0], ends[0][1], ends[1][0], ends[1][1], ends[2][0], ends[2][1], ends[3][0], ends[3][1]
        );
        Some(view! { <path class="cone" d=outline></path><path class="cone-rays" d=rays></path> })
    });
    let (mut signs, mut marks) = (Vec::new(), Vec::new());
    for (k, station) in plan.stations.iter().enumerate() {
        let [x, y] = frame.at(&station.position);
        let sight = prediction.and_then(|p| p.stations.get(k)).filter(|s| s.id == station.id);
        let [dx, dy] = frame.along(&sight.map_or([0.0, 1.0, 0.0], |s| s.direction));
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
        let id = station.id.clone();
        // Behind the camera, where its sign is not.
        let back = if length < 0.3 { [0.0, 1.0] } else { [-dx / length, -dy / length] };
        marks.push(Sign { at: [x, y], back, id: id.clone() });
        signs.push(view! { <g class=class data-station=id><path d=path></path></g> });
    }
    let labels = labels(&marks).into_iter().map(|label| {
        let leader = label.leader.map(|[x, y]| {
            let d = format!("M{x:.1} {y:.1}L{:.1} {:.1}", label.at[0], label.at[1] - 4.0);
            view! { <path class="leader" d=d></path> }
        });
        let chosen = label.of.iter().any(|k| chosen == Some(plan.stations[*k].id.as_str()));
        let (x, y) = (format!("{:.1}", label.at[0]), format!("{:.1}", label.at[1]));
        view! { {leader}<text class="axis station-label" class:chosen=chosen x=x y=y text-anchor="middle">{label.text}</text> }
    });
    let labels = labels.collect_view();
    view! { {cone}{labels}{signs} }
}

/// The scale of the drawing, and how much larger the ellipses are.
fn rule(frame: &DrawingFrame, unit: &str, wanted: f64) -> impl IntoView + use<> {
    let bar = round_length(110.0 / frame.scale);
    let long = bar * frame.scale;
    let times = WANTED / (wanted * frame.scale);
    let enlarged = (times > 1.0).then(|| words::ellipses_enlarged(two_digits(times)));
    view! {
        <path class="rule" d=format!("M{:.1} {:.1}v5h{long:.1}v-5", WIDTH - 14.0 - long, HEIGHT - 16.0)></path>
        <text class="axis" x=WIDTH - 20.0 - long y=HEIGHT - 11.0 text-anchor="end">{format!("{} {unit}", format::round(bar))}</text>
        <text class="axis" x="12" y=HEIGHT - 11.0>{enlarged}</text>
    }
}

/// The largest of 1, 2, 5 times a power of ten that is not above a length.
fn round_length(length: f64) -> f64 {
    let power = 10f64.powf(length.max(1e-12).log10().floor());
    let share = length / power;
    let first = [5.0, 2.0, 1.0].into_iter().find(|step| share >= *step).unwrap_or(1.0);
    power * first
}

/// A number to two digits.
fn two_digits(value: f64) -> String {
    let step = 10f64.powf(value.max(1e-9).log10().floor() - 1.0);
    format::count(((value / step).round() * step).max(1.0) as usize)
}
