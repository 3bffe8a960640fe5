//! The network under three datums beside each other, at one scale, and the movements that no photo sees.

use leptos::prelude::*;
use sightline::adjustment::AdjustedPoint;
use sightline::project::DatumKind;
use sightline_lab::teaching::{DatumCase, Datums};
use sightline_protocol::Inquiry;

use super::number;
use super::transformed::STransformation;
use crate::browser::event;
use crate::format;
use crate::i18n::{errors, inside as words};
use crate::store::Desk;

const SIDE: [f64; 2] = [420.0, 300.0];
const MARGIN: f64 = 36.0;
/// More points than these stand without their names.
const NAMED: usize = 40;

/// Axes across and up.
const VIEWS: [(&str, [usize; 2]); 3] = [("XY", [0, 1]), ("XZ", [0, 2]), ("YZ", [1, 2])];

#[component]
pub fn Datum() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    let held = RwSignal::new(Vec::<String>::new());
    let axes = RwSignal::new(VIEWS[0].1);
    let motion = RwSignal::new(None::<usize>);
    let share = RwSignal::new(1.0_f64);
    Effect::new(move || {
        let ready = inside.steps.with(|steps| !steps.is_empty());
        if ready && inside.datums.with_untracked(Option::is_none) {
            desk.inquire(Inquiry::Datums(None));
        }
    });
    // The movement that a lesson refers to.
    Effect::new(move || {
        if let Some(wanted) = inside.wanted.get().motion {
            let place = inside.datums.with(|found| {
                found.as_ref().and_then(|found| found.motions.iter().position(|motion| motion.name == wanted))
            });
            motion.set(place);
        }
    });
    let hold = move |id: String| {
        held.update(|held| match held.iter().position(|one| *one == id) {
            Some(at) => {
                held.remove(at);
            }
            None => held.push(id),
        });
        let points = held.get_untracked();
        // Three points carry seven coordinates; with fewer the engine chooses.
        if points.is_empty() || points.len() >= 3 {
            desk.inquire(Inquiry::Datums((!points.is_empty()).then_some(points)));
        }
    };
    let shown = move || {
        let found = inside.datums.get()?;
        let (axes, motion) = (axes.get(), motion.get());
        let frame = PlotFrame::new(&found, axes, share.get());
        let columns = found.cases.iter().map(|case| {
            let moved = motion.filter(|_| case.kind == DatumKind::Free).and_then(|k| found.motions.get(k));
            let moved = moved.map(|motion| motion.points.clone());
            column(case, &frame, moved, hold, held)
        });
        let columns = columns.collect_view();
        Some(view! { <div class="datums">{columns}</div>{equality(&found)} })
    };
    let motions = move || {
        let found = inside.datums.get()?;
        let seen = motion.get().and_then(|k| found.motions.get(k)).map(|motion| motion.seen);
        let buttons = found.motions.iter().enumerate().map(|(k, one)| {
            let (name, key) = (one.name.clone(), one.name.clone());
            view! {
                <button class="button" data-motion=key aria-pressed=move || (motion.get() == Some(k)).to_string()
                    on:click=move |_| motion.update(|now| *now = if *now == Some(k) { None } else { Some(k) })>{move || motion_name(&name)}</button>
            }
        });
        let buttons = buttons.collect_view();
        Some(view! {
            <div class="motions">
                <div><b>{words::not_seen}</b><small>{words::motions_of(found.motions.len())}</small></div>
                {buttons}
                {seen.map(|seen| view! { <p>{words::changes_nothing(number(seen))}</p> })}
            </div>
        })
    };
    view! {
        <main class="inside-page scroll">
            <div class="inside-options">
                <span>{words::ellipses_at_one_scale}</span>
                <label class="option"><span>{words::ellipse_size}</span>
                    <input type="range" min="-1" max="1" step="0.1" name="ellipse-size" prop:value=move || share.get().log10().to_string()
                        on:input=move |e| share.set(10f64.powf(event::value(&e).parse().unwrap_or(0.0)))/></label>
                {VIEWS.map(|(name, pair)| view! {
                    <button class="text-button" aria-pressed=move || (axes.get() == pair).to_string() on:click=move |_| axes.set(pair)>{name}</button>
                }).collect_view()}
                <span class="hint">{move || {
                    let held = held.get();
                    if held.is_empty() { words::hold_by_click().to_owned() } else if held.len() < 3 { words::hold_more(held.join(", ")) } else { words::held_points(held.join(", ")) }
                }}</span>
            </div>
            {move || shown().map_or_else(|| view! { <p class="note">{words::computing}</p> }.into_any(), IntoAny::into_any)}
            {motions}
            <STransformation held/>
        </main>
    }
}

fn motion_name(name: &str) -> &'static str {
    match name {
        "shift_x" => words::shift_x(),
        "shift_y" => words::shift_y(),
        "shift_z" => words::shift_z(),
        "rotation_x" => words::rotation_x(),
        "rotation_y" => words::rotation_y(),
        "rotation_z" => words::rotation_z(),
        _ => words::scale(),
    }
}

/// The name of a datum.
pub(super) fn datum_name(kind: DatumKind) -> &'static str {
    match kind {
        DatumKind::Control => words::datum_control(),
        DatumKind::Minimal => words::datum_minimal(),
        DatumKind::Free => words::datum_free(),
    }
}

/// Maps coordinates to the three pictures of the datums.
#[derive(Clone, Copy)]
struct PlotFrame {
    axes: [usize; 2],
    middle: [f64; 2],
    scale: f64,
    /// Times the size of standard errors.
    factor: f64,
}

impl PlotFrame {
    fn new(found: &Datums, axes: [usize; 2], share: f64) -> Self {
        let all = || found.cases.iter().flat_map(|case| &case.points);
        let range = |axis: usize| {
            let low = all().map(|point| point.xyz[axis]).fold(f64::INFINITY, f64::min);
            let high = all().map(|point| point.xyz[axis]).fold(f64::NEG_INFINITY, f64::max);
            if low <= high { [low, high] } else { [0.0, 1.0] }
        };
        let ranges = axes.map(range);
        let middle = ranges.map(|[low, high]| 0.5 * (low + high));
        let fit = |k: usize| (SIDE[k] - 2.0 * MARGIN) / (ranges[k][1] - ranges[k][0]).max(f64::MIN_POSITIVE);
        let scale = fit(0).min(fit(1));
        let sigmas = || all().filter_map(|point| point.sigma).flatten();
        let largest = sigmas().fold(f64::MIN_POSITIVE, f64::max);
        Self { axes, middle, scale, factor: share * 30.0 / (largest * scale) }
    }

    fn at(&self, xyz: [f64; 3]) -> [f64; 2] {
        let [a, b] = self.axes;
        [SIDE[0] / 2.0 + (xyz[a] - self.middle[0]) * self.scale, SIDE[1] / 2.0 - (xyz[b] - self.middle[1]) * self.scale]
    }

    /// Half axes in the picture and the angle of the first in degrees.
    fn ellipse(&self, covariance: [f64; 6]) -> [f64; 3] {
        let [xx, xy, xz, yy, yz, zz] = covariance;
        let full = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let [a, b] = self.axes;
        let (p, q, r) = (full[a][a], full[b][b], full[a][b]);
        let (mean, half) = (0.5 * (p + q), (0.25 * (p - q).powi(2) + r * r).sqrt());
        let size = |variance: f64| variance.max(0.0).sqrt() * self.scale * self.factor;
        // The picture's second axis points down.
        [size(mean + half), size(mean - half), -0.5 * (2.0 * r).atan2(p - q).to_degrees()]
    }
}

fn column(
    case: &DatumCase,
    frame: &PlotFrame,
    moved: Option<Vec<[f64; 3]>>,
    hold: impl Fn(String) + Copy + Send + Sync + 'static,
    held: RwSignal<Vec<String>>,
) -> AnyView {
    let kind = case.kind;
    let body = if case.points.is_empty() {
        let said = case.failed.as_deref().map_or_else(|| words::no_control().to_owned(), errors::sentence);
        view! { <p class="note warn">{said}</p> }.into_any()
    } else {
        let named = case.points.len() <= NAMED;
        let reach = moved.as_ref().map_or(1.0, |all| {
            let fastest = all.iter().flat_map(|g| frame.axes.map(|k| g[k].abs())).fold(0.0, f64::max);
            if fastest > 0.0 { 30.0 / fastest } else { 0.0 }
        });
        let marks = case.points.iter().enumerate().map(|(k, point)| {
            let [x, y] = frame.at(point.xyz);
            let [a, b, angle] = point.covariance.map_or([0.0; 3], |covariance| frame.ellipse(covariance));
            let arrow = moved.as_ref().and_then(|all| all.get(k)).map(|g| {
                let [dx, dy] = [g[frame.axes[0]] * reach, -g[frame.axes[1]] * reach];
                view! { <line class="arrow" x1=x y1=y x2=x + dx y2=y + dy></line><circle class="arrow" cx=x + dx cy=y + dy r="2.5"></circle> }
            });
            let (id, own) = (point.id.clone(), point.id.clone());
            let is_held = move || kind == DatumKind::Minimal && held.with(|held| held.contains(&own));
            let choose = id.clone();
            view! {
                <g class="held-point" class:chosen=is_held on:click=move |_| if kind == DatumKind::Minimal { hold(choose.clone()) }>
                    <circle class="reach" cx=x cy=y r="12"></circle>
                    <ellipse cx=x cy=y rx=a ry=b transform=format!("rotate({angle:.2} {x:.2} {y:.2})")></ellipse>
                    <circle class="dot" cx=x cy=y r="2"></circle>
                    {named.then(|| view! { <text x=x + 6.0 y=y - 6.0>{id}</text> })}
                </g>
                {arrow}
            }
        });
        let marks = marks.collect_view();
        let worst = worst(&case.points);
        let [x, y, z] = case.rms.map(number);
        let unit = expect_context::<Desk>().inside.unit();
        view! {
            <svg viewBox=format!("0 0 {} {}", SIDE[0], SIDE[1]) role="img" aria-label=datum_name(kind)>{marks}</svg>
            <table class="table words"><tbody>
                <tr><td class="left">{words::trace} " " <u>{unit.clone()}"²"</u></td><td><b data-trace="">{number(case.trace)}</b></td></tr>
                <tr><td class="left">{words::rms_sigma} " " <u>{unit.clone()}</u></td><td><b>{format!("{x}  {y}  {z}")}</b></td></tr>
                {worst.map(|(id, sigma)| view! { <tr><td class="left">{words::largest_sigma} " " <u>{unit.clone()}</u></td><td>{number(sigma)} " (" {id} ")"</td></tr> })}
                <tr><td class="left">{words::fixed_by}</td><td>{if kind == DatumKind::Control { words::given_coordinates(case.given) } else { words::constraints(case.constraints) }}</td></tr>
            </tbody></table>
        }.into_any()
    };
    view! {
        <section data-datum=format!("{kind:?}").to_lowercase()>
            <h2 class="section-head"><span>{move || datum_name(kind)}</span></h2>
            {body}
        </section>
    }
    .into_any()
}

fn worst(points: &[AdjustedPoint]) -> Option<(String, f64)> {
    let all = points.iter().filter_map(|point| Some((point.id.clone(), point.sigma?.into_iter().fold(0.0, f64::max))));
    all.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// vᵀPv under each datum, with the signs between them.
fn equality(found: &Datums) -> impl IntoView + use<> {
    let done: Vec<&DatumCase> = found.cases.iter().filter(|case| !case.points.is_empty()).collect();
    let mut parts = Vec::new();
    for (k, case) in done.iter().enumerate() {
        if k > 0 {
            let (a, b) = (done[k - 1].weighted_squares, case.weighted_squares);
            let apart = (a - b).abs() / a.max(b).max(f64::MIN_POSITIVE);
            // As far as iterations that end at a negligible step can agree.
            let same = apart < 1e-9;
            let sign = if same { "=" } else { "≠" };
            parts.push(view! { <div class="sign" class:pass=same data-equal=same.to_string()><b>{sign}</b><small>{if same { words::to_within(number(apart)) } else { String::new() }}</small></div> }.into_any());
        }
        let sigma0 = case.sigma0.map_or("–".to_owned(), |sigma0| format::fixed(sigma0, 4));
        let under = words::redundancy_and_sigma(format::count(case.redundancy), sigma0);
        let image = (case.given > 0).then(|| words::of_image(format::fixed(case.of_image, 3)));
        parts.push(view! { <div><b>{format::fixed(case.weighted_squares, 3)}</b><small>{under}</small><small>{image}</small></div> }.into_any());
    }
    view! { <div class="equality"><b>"vᵀPv"</b>{parts}</div> }
}
