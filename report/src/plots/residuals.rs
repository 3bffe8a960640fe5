//! Residual vectors in the frame of their photo, and those of all photos of a camera in one frame, where a pattern is one of the lens.

use std::collections::HashMap;

use super::svg::{Anchor, Svg};
use super::{Group, MARKS, Plot, SMALL_MARKS, drawn_sentence, every_nth, file_name};
use crate::context::{Context, largest_w};
use crate::names::shown;
use crate::number::{count, fixed, round, round_below};
use sightline::adjustment::PhotoUnit;
use sightline::project::Camera;

/// A residual at its place, photo units.
struct Vector {
    at: [f64; 2],
    residual: [f64; 2],
    over: bool,
}

/// One plot a photo.
pub fn plots(context: &Context) -> Vec<Plot> {
    let words = context.words;
    let mut by_photo: HashMap<&str, Vec<usize>> = HashMap::new();
    for (k, o) in context.project.observations.iter().enumerate() {
        by_photo.entry(&o.photo).or_default().push(k);
    }
    let one = |photo: &sightline::adjustment::AdjustedPhoto| {
        let camera = context.camera_of(&photo.id)?;
        let own = by_photo.get(photo.id.as_str()).map(Vec::as_slice).unwrap_or_default();
        let vectors = of(context, own.iter().copied(), camera);
        let every = every_nth(vectors.len(), SMALL_MARKS);
        let (factor, unit) = shown(photo.unit);
        let decimals = if unit == "px" { 3 } else { 2 };
        let title = words.plot_residuals(&photo.id);
        let rms = [photo.rms_x, photo.rms_y].map(|rms| fixed(rms * factor, decimals));
        let sentence = words.plot_residuals_says(&rms[0], &rms[1], &unit, &count(photo.points));
        let sentence = drawn_sentence(sentence, every, context);
        let svg = drawn(camera, &vectors, every, [&title, &sentence], 300.0)?;
        let name = format!("residuals-{}", file_name(&photo.id));
        Some(Plot { name, group: Group::Residuals, small: true, title, sentence, svg })
    };
    context.adjustment.photos.iter().filter_map(one).collect()
}

/// One plot a camera.
pub fn all_in_one(context: &Context) -> Vec<Plot> {
    let words = context.words;
    let one = |camera: &Camera| {
        let own = |photo: &str| context.camera_of(photo).is_some_and(|c| c.id == camera.id);
        let all = context.project.observations.iter().enumerate();
        let vectors = of(context, all.filter(|(_, o)| own(&o.photo)).map(|(k, _)| k), camera);
        if vectors.is_empty() {
            return None;
        }
        let title = words.plot_all_residuals(&camera.id);
        let photos = context.adjustment.photos.iter().filter(|p| own(&p.id)).count();
        let every = every_nth(vectors.len(), MARKS);
        let sentence = words.plot_all_residuals_says(&count(vectors.len()), &count(photos));
        let sentence = drawn_sentence(sentence, every, context);
        let svg = drawn(camera, &vectors, every, [&title, &sentence], 520.0)?;
        let name = format!("residuals-of-{}", file_name(&camera.id));
        Some(Plot { name, group: Group::Residuals, small: false, title, sentence, svg })
    };
    context.project.cameras.iter().filter_map(one).collect()
}

/// Vectors of the given observations of a camera.
fn of(context: &Context, observations: impl Iterator<Item = usize>, camera: &Camera) -> Vec<Vector> {
    let [px, py] = PhotoUnit::of(camera).1;
    let (w, h) = (f64::from(camera.width), f64::from(camera.height));
    // Residuals in pixels count downwards.
    let down = if camera.interior.model().in_photo_units { 1.0 } else { -1.0 };
    let pairs =
        observations.filter_map(|k| context.project.observations.get(k).zip(context.adjustment.observations.get(k)));
    pairs
        .filter(|(_, r)| r.enabled)
        .filter_map(|(o, r)| {
            Some(Vector {
                at: [(o.u - w / 2.0) * px, (h / 2.0 - o.v) * py],
                residual: [r.vx?, down * r.vy?],
                over: largest_w(r).is_some_and(|w| w.abs() > context.adjustment.criteria.w),
            })
        })
        .collect()
}

/// Draws all significant vectors, and every `every`-th of the others.
fn drawn(
    camera: &Camera,
    vectors: &[Vector],
    every: usize,
    [title, sentence]: [&str; 2],
    width: f64,
) -> Option<String> {
    let (unit, [px, py]) = PhotoUnit::of(camera);
    let (w, h) = (f64::from(camera.width) * px, f64::from(camera.height) * py);
    let scale = (width - 4.0) / w;
    if !(scale > 0.0 && scale.is_finite()) {
        return None;
    }
    let height = h * scale + 24.0;
    let mut lengths: Vec<f64> = vectors.iter().map(|v| v.residual[0].hypot(v.residual[1])).collect();
    lengths.sort_by(f64::total_cmp);
    let typical = lengths.get(lengths.len() * 9 / 10).copied().unwrap_or(0.0);
    let exaggeration = if typical > 0.0 { round_below(0.045 * width / (typical * scale)) } else { 1.0 };
    let mut svg = Svg::new(width, height, title, sentence);
    let x = |at: f64| 2.0 + (at + w / 2.0) * scale;
    let y = |at: f64| 2.0 + (h / 2.0 - at) * scale;
    svg.rect("frame", [2.0, 2.0], [w * scale, h * scale]);
    svg.line("grid", [x(0.0), 2.0], [x(0.0), 2.0 + h * scale]);
    svg.line("grid", [2.0, y(0.0)], [2.0 + w * scale, y(0.0)]);
    for over in [false, true] {
        let lines: Vec<_> = vectors
            .iter()
            .filter(|v| v.over == over)
            .step_by(if over { 1 } else { every })
            .map(|v| {
                let from = [x(v.at[0]), y(v.at[1])];
                let long = scale * exaggeration;
                (from, [from[0] + v.residual[0] * long, from[1] - v.residual[1] * long])
            })
            .collect();
        svg.strokes(if over { "vector over" } else { "vector" }, &lines);
    }
    let (factor, unit) = shown(unit);
    let bar = round_below(0.12 * width / (scale * exaggeration));
    let long = bar * scale * exaggeration;
    let bottom = height - 6.0;
    svg.path("edge", &[[2.0, bottom - 6.0], [2.0, bottom], [2.0 + long, bottom], [2.0 + long, bottom - 6.0]]);
    svg.label("axis", [8.0 + long, bottom], Anchor::Start, &format!("{} {unit}", round(bar * factor)));
    svg.label("axis", [width - 2.0, bottom], Anchor::End, &format!("{} ×", round(exaggeration)));
    Some(svg.finish())
}
