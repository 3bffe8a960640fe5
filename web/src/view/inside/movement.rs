//! What a step moves: points and projection centres in a plan, residuals in the photos; both follow the step that is shown.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use leptos::prelude::*;
use sightline::adjust::{StepState, Unknown};
use sightline::depiction::round;

use crate::browser::event;
use crate::format;
use crate::i18n::inside as words;
use crate::store::Desk;
use crate::store::inside::StepShown;

const SIDE: [f64; 2] = [520.0, 380.0];
const MARGIN: f64 = 34.0;
/// Length of the largest vector of the plan, and of the photos.
const LONGEST: [f64; 2] = [46.0, 22.0];
/// Side of a photo's frame.
const FRAME: f64 = 150.0;
/// More places than these stand without their names.
const NAMED: usize = 40;
/// More photos than these are shown one at a time.
const TOGETHER: usize = 8;

/// Axes across and up.
const VIEWS: [(&str, [usize; 2]); 3] = [("XY", [0, 1]), ("XZ", [0, 2]), ("YZ", [1, 2])];

/// A point or a projection centre after a step.
struct Place {
    name: String,
    is_photo: bool,
    xyz: [f64; 3],
    /// Its change by the last step.
    change: [f64; 3],
}

/// A coordinate and its change or residual, where it is known.
type ValueAndChange = Option<(f64, f64)>;

/// Every point and projection centre whose three coordinates are unknowns.
fn places(unknowns: &[Unknown], state: &StepState) -> Vec<Place> {
    // By kind and name.
    let mut found: BTreeMap<(bool, &str), [ValueAndChange; 3]> = BTreeMap::new();
    for (k, unknown) in unknowns.iter().enumerate() {
        let (is_photo, owner) = match (&unknown.photo, &unknown.point) {
            (_, Some(point)) => (false, point),
            (Some(photo), _) => (true, photo),
            _ => continue,
        };
        let axis = unknown
            .name
            .strip_prefix(owner.as_str())
            .and_then(|rest| ["X", "Y", "Z"].iter().position(|axis| rest.trim() == *axis));
        if let (Some(axis), Some(value), Some(change)) = (axis, state.values.get(k), state.corrections.get(k)) {
            found.entry((is_photo, owner.as_str())).or_default()[axis] = Some((*value, *change));
        }
    }
    let whole = found.into_iter().filter_map(|((is_photo, name), [x, y, z])| {
        let all = [x?, y?, z?];
        Some(Place { name: name.to_owned(), is_photo, xyz: all.map(|one| one.0), change: all.map(|one| one.1) })
    });
    whole.collect()
}

/// A line with a head at its end, where it is long enough for one.
fn arrow(path: &mut String, [x, y]: [f64; 2], [dx, dy]: [f64; 2]) {
    let (tip_x, tip_y) = (x + dx, y + dy);
    let _ = write!(path, "M{x:.1} {y:.1}L{tip_x:.1} {tip_y:.1}");
    let length = dx.hypot(dy);
    if length > 3.0 {
        let (ux, uy) = (dx / length, dy / length);
        let side = |s: f64| (tip_x - 5.0 * ux - s * 2.5 * uy, tip_y - 5.0 * uy + s * 2.5 * ux);
        let ((ax, ay), (bx, by)) = (side(1.0), side(-1.0));
        let _ = write!(path, "M{ax:.1} {ay:.1}L{tip_x:.1} {tip_y:.1}L{bx:.1} {by:.1}");
    }
}

/// The factor at which the largest length has this many pixels, rounded so that it can be read; 0 if there is none.
fn factor(largest: f64, pixels: f64) -> f64 {
    if largest > 0.0 && largest.is_finite() { round(pixels / largest) } else { 0.0 }
}

#[component]
pub fn Movement() -> impl IntoView {
    let inside = expect_context::<Desk>().inside;
    let axes = RwSignal::new(VIEWS[0].1);
    let photo = RwSignal::new(None::<String>);
    let first = inside.first();
    let names = Memo::new(move |_| {
        let first = first.get();
        let mut names: Vec<String> = Vec::new();
        for row in first.iter().flat_map(|looked| &looked.system.observations).filter(|row| row.given.is_none()) {
            if let Some(name) = row.photo.as_ref().filter(|name| names.last() != Some(*name) && !names.contains(name)) {
                names.push(name.clone());
            }
        }
        names
    });
    let plan = move || {
        let (first, looked) = (first.get()?, inside.looked()?);
        Some(plan(&first.state, &looked, axes.get()))
    };
    let residuals = move || {
        let looked = inside.looked()?;
        let names = names.get();
        let shown = if names.len() <= TOGETHER {
            names
        } else {
            let chosen = photo.get().filter(|photo| names.contains(photo));
            chosen.or_else(|| names.into_iter().next()).into_iter().collect()
        };
        Some(photos(&looked, &shown))
    };
    view! {
        <div class="movement">
            <div class="row">
                <h2 class="section-head"><span>{words::movement}</span></h2>
                {VIEWS.map(|(name, pair)| view! {
                    <button class="text-button" aria-pressed=move || (axes.get() == pair).to_string() on:click=move |_| axes.set(pair)>{name}</button>
                }).collect_view()}
            </div>
            {plan}
            <div class="row">
                <h2 class="section-head"><span>{words::residuals_of_step}</span></h2>
                <Show when=move || names.with(|names| names.len() > TOGETHER)>
                    <label><span class="visually-hidden">{words::photo_shown}</span>
                        <select name="residual-photo" on:change=move |e| photo.set(Some(event::value(&e)))>
                            {move || names.get().into_iter().map(|name| view! { <option value=name.clone()>{name.clone()}</option> }).collect_view()}
                        </select></label>
                </Show>
            </div>
            {residuals}
        </div>
    }
}

/// Places after the step; the picture keeps the bounds of the initial values, so that what moves is seen to move.
fn plan(first: &StepState, looked: &StepShown, axes: [usize; 2]) -> AnyView {
    let unknowns = looked.unknowns();
    let (start, now) = (places(unknowns, first), places(unknowns, &looked.state));
    let ends = axes.map(|axis| {
        let all = || start.iter().map(|place| place.xyz[axis]);
        [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
    });
    let fit = |k: usize| (SIDE[k] - 2.0 * MARGIN) / (ends[k][1] - ends[k][0]).max(f64::MIN_POSITIVE);
    let scale = fit(0).min(fit(1));
    let flat = |v: [f64; 3]| [v[axes[0]] * scale, -v[axes[1]] * scale];
    let middle = ends.map(|[low, high]| 0.5 * (low + high));
    let at = |xyz: [f64; 3]| {
        [SIDE[0] / 2.0 + (xyz[axes[0]] - middle[0]) * scale, SIDE[1] / 2.0 - (xyz[axes[1]] - middle[1]) * scale]
    };
    let length = |v: [f64; 2]| v[0].hypot(v[1]);
    let largest = now.iter().map(|place| length(flat(place.change))).fold(0.0, f64::max);
    let factor = factor(largest, LONGEST[0]);
    let named = now.len() <= NAMED;
    let (mut arrows, mut marks) = (String::new(), Vec::new());
    for place in &now {
        let [x, y] = at(place.xyz);
        // A vector ends where the place is now.
        let [dx, dy] = flat(place.change).map(|d| d * factor);
        if factor > 0.0 {
            arrow(&mut arrows, [x - dx, y - dy], [dx, dy]);
        }
        let mark = if place.is_photo {
            view! { <path class="camera-at" d=format!("M{x:.1} {:.1}l4.5 8h-9z", y - 5.0)></path> }.into_any()
        } else {
            view! { <circle class="dot" cx=x cy=y r="2.5"></circle> }.into_any()
        };
        let name = named.then(|| view! { <text x=x + 6.0 y=y + 12.0>{place.name.clone()}</text> });
        marks.push(view! { <g data-place=place.name.clone()>{mark}{name}</g> });
    }
    let longest = now.iter().map(|place| place.change.iter().map(|d| d * d).sum::<f64>().sqrt()).fold(0.0, f64::max);
    let unit = unknowns.iter().find(|one| one.point.is_some()).map(|one| one.unit.clone());
    let said = if factor > 0.0 {
        words::vectors_at(format::round(factor), format::compact(longest), unit.unwrap_or_default())
    } else {
        words::no_vectors().to_owned()
    };
    view! {
        <svg class="plan" viewBox=format!("0 0 {} {}", SIDE[0], SIDE[1]) role="img" aria-label=words::movement data-factor=factor.to_string()>
            <path class="vectors" d=arrows></path>
            {marks}
        </svg>
        <p class="hint" data-vectors="">{said}</p>
    }
    .into_any()
}

/// Residual vectors at their image points, all photos at one scale.
fn photos(looked: &StepShown, names: &[String]) -> AnyView {
    let (rows, residuals) = (looked.observations(), looked.observed.iter().zip(&looked.state.residuals));
    // By photo and point: observed coordinates and residuals.
    let mut all: BTreeMap<(&str, &str), [ValueAndChange; 2]> = BTreeMap::new();
    for (row, (value, v)) in rows.iter().zip(residuals).filter(|(row, _)| row.given.is_none()) {
        let (Some(photo), Some(point)) = (&row.photo, &row.point) else { continue };
        let side = match row.axis.as_deref() {
            Some("x") => 0,
            Some("y") => 1,
            _ => continue,
        };
        all.entry((photo.as_str(), point.as_str())).or_default()[side] = Some((*value, *v));
    }
    let whole: Vec<(&str, [f64; 2], [f64; 2])> =
        all.into_iter().filter_map(|((photo, _), [x, y])| Some((photo, [x?.0, y?.0], [x?.1, y?.1]))).collect();
    let unit = rows.iter().find(|row| row.given.is_none()).map(|row| row.unit.clone()).unwrap_or_default();
    // Photo coordinates are counted from the middle, y up; pixels from a corner, y down.
    let pixels = unit == "px";
    let end = |axis: usize, start: f64, of: fn(f64, f64) -> f64| whole.iter().map(|one| one.1[axis]).fold(start, of);
    let middle = [0, 1].map(|axis| {
        let mean = 0.5 * (end(axis, f64::INFINITY, f64::min) + end(axis, f64::NEG_INFINITY, f64::max));
        if pixels { mean } else { 0.0 }
    });
    let up = if pixels { 1.0 } else { -1.0 };
    let off = |place: [f64; 2]| [place[0] - middle[0], up * (place[1] - middle[1])];
    let reach = whole.iter().flat_map(|one| off(one.1)).map(f64::abs).fold(f64::MIN_POSITIVE, f64::max);
    let scale = (0.5 * FRAME - 12.0) / reach;
    let largest = whole.iter().map(|(.., v)| v[0].hypot(v[1])).fold(0.0, f64::max);
    let factor = factor(largest * scale, LONGEST[1]);
    let frames = names.iter().map(|name| {
        let (mut arrows, mut dots) = (String::new(), String::new());
        for (_, place, [vx, vy]) in whole.iter().filter(|(photo, ..)| photo == name) {
            let at = off(*place).map(|x| 0.5 * FRAME + x * scale);
            let _ = write!(dots, "M{:.1} {:.1}h2v2h-2z", at[0] - 1.0, at[1] - 1.0);
            arrow(&mut arrows, at, [vx * scale * factor, up * vy * scale * factor]);
        }
        view! {
            <figure data-residuals=name.clone()>
                <svg viewBox=format!("0 0 {FRAME} {FRAME}") role="img" aria-label=name.clone()>
                    <rect x="0.5" y="0.5" width=FRAME - 1.0 height=FRAME - 1.0></rect>
                    <path class="dot" d=dots></path>
                    <path class="vectors" d=arrows></path>
                </svg>
                <figcaption>{name.clone()}</figcaption>
            </figure>
        }
    });
    let frames = frames.collect_view();
    view! {
        <div class="residual-photos">{frames}</div>
        <p class="hint">{words::vectors_at(format::round(factor), format::compact(largest), unit)}</p>
    }
    .into_any()
}
