//! Deviations of points from a fitted form, each at its position on the flattened form: a plane from above, a cylinder unrolled, a
//! sphere by longitude and latitude, a circle by its angle, a line along its length.

use nalgebra::Vector3;

use super::chart::{Axis, Chart};
use super::svg::Anchor;
use super::{Group, Plot, deviations_name};
use crate::context::Context;
use crate::number::{count, decimals_for, fixed, round, round_below};
use sightline::adjustment::MeasuredFeature;
use sightline::project::{Feature, FeatureKind};

/// Length of a stick that nine of ten stay below, units of the drawing.
const STICK: f64 = 24.0;

/// A point on the form laid flat; none of forms that are laid out along one axis, where the deviation itself is the other.
struct Flat {
    across: f64,
    up: Option<f64>,
    deviation: f64,
}

/// Lays a place out: across, and upwards where the form has two directions.
type Lay<'a> = &'a dyn Fn(&Vector3<f64>) -> (f64, Option<f64>);

/// One plot a form that points deviate from.
pub fn plots(context: &Context) -> Vec<Plot> {
    context.project.features.iter().filter_map(|feature| plot(context, feature)).collect()
}

/// The form that a feature's residuals are distances from.
fn form<'a>(context: &Context<'a>, feature: &'a Feature) -> Option<(&'a FeatureKind, &'a MeasuredFeature)> {
    let id = match &feature.kind {
        FeatureKind::Deviations { feature: Some(from), .. } => from,
        FeatureKind::Deviations { feature: None, .. } => return None,
        _ => &feature.id,
    };
    let kind = &context.project.features.iter().find(|f| f.id == *id)?.kind;
    Some((kind, context.adjustment.features.iter().find(|f| f.id == *id)?))
}

fn plot(context: &Context, feature: &Feature) -> Option<Plot> {
    let words = context.words;
    let found = context.adjustment.features.iter().find(|f| f.id == feature.id && f.error.is_none())?;
    let (kind, form) = form(context, feature)?;
    let middle = Vector3::from(form.position?);
    let places: Vec<(Vector3<f64>, f64)> = found
        .residuals
        .iter()
        .filter_map(|r| {
            let point = context.adjustment.points.iter().find(|p| p.id == r.point)?;
            Some((Vector3::from(point.xyz) - middle, r.value))
        })
        .collect();
    if places.len() < 3 {
        return None;
    }
    let (flat, how, [x_name, y_name]) = laid_flat(context, kind, form, &places)?;
    let rms = (flat.iter().map(|f| f.deviation * f.deviation).sum::<f64>() / flat.len() as f64).sqrt();
    let decimals = decimals_for(rms).max(3);
    let [low, high] = [f64::min, f64::max].map(|pick| flat.iter().map(|f| f.deviation).reduce(pick).unwrap_or(0.0));
    let title = words.plot_deviations(&feature.id);
    let figures = [rms, low, high].map(|x| fixed(x, decimals));
    let sentence = format!(
        "{} {how}",
        words.plot_deviations_says(&count(flat.len()), &figures[0], &figures[1], &figures[2], &context.unit)
    );
    let svg = drawn(&flat, [&x_name, &y_name], &title, &sentence, context.unit);
    Some(Plot { name: deviations_name(&feature.id), group: Group::Features, small: false, title, sentence, svg })
}

/// Two directions at right angles to a direction and to each other.
fn beside(direction: &Vector3<f64>) -> [Vector3<f64>; 2] {
    // The axis of coordinates that is farthest from it keeps the layout where a reader expects it.
    let axis = [Vector3::x(), Vector3::y(), Vector3::z()]
        .into_iter()
        .min_by(|a, b| a.dot(direction).abs().total_cmp(&b.dot(direction).abs()))
        .unwrap_or_else(Vector3::x);
    let first = (axis - direction * axis.dot(direction)).normalize();
    [first, direction.cross(&first)]
}

/// Every point on the form laid flat, how that was done, and the axes' names.
fn laid_flat(
    context: &Context,
    kind: &FeatureKind,
    form: &MeasuredFeature,
    places: &[(Vector3<f64>, f64)],
) -> Option<(Vec<Flat>, &'static str, [String; 2])> {
    let (words, unit) = (context.words, context.unit);
    let direction = form.direction.map(Vector3::from);
    let turn = |a: f64, b: f64| b.atan2(a).to_degrees().rem_euclid(360.0);
    let laid = |lay: Lay| -> Vec<Flat> {
        let one = |(at, deviation): &(Vector3<f64>, f64)| {
            let (across, up) = lay(at);
            Flat { across, up, deviation: *deviation }
        };
        places.iter().map(one).collect()
    };
    Some(match kind {
        FeatureKind::Plane { .. } => {
            let [e, f] = beside(&direction?);
            let flat = laid(&|at| (at.dot(&e), Some(at.dot(&f))));
            (flat, words.laid_plane(), [unit.to_owned(), unit.to_owned()])
        }
        FeatureKind::Cylinder { .. } => {
            let axis = direction?;
            let [e, f] = beside(&axis);
            let flat = laid(&|at| (turn(at.dot(&e), at.dot(&f)), Some(at.dot(&axis))));
            (flat, words.laid_cylinder(), ["°".into(), unit.to_owned()])
        }
        FeatureKind::Sphere { .. } => {
            let flat = laid(&|at| {
                let latitude = (at.z / at.norm().max(f64::MIN_POSITIVE)).asin().to_degrees();
                (turn(at.x, at.y), Some(latitude))
            });
            (flat, words.laid_sphere(), ["°".into(), "°".into()])
        }
        FeatureKind::Circle { .. } => {
            let [e, f] = beside(&direction?);
            let flat = laid(&|at| (turn(at.dot(&e), at.dot(&f)), None));
            (flat, words.laid_circle(), ["°".into(), unit.to_owned()])
        }
        FeatureKind::Line { .. } => {
            let axis = direction?;
            (laid(&|at| (at.dot(&axis), None)), words.laid_line(), [unit.to_owned(), unit.to_owned()])
        }
        FeatureKind::Distance { .. } | FeatureKind::Angle { .. } | FeatureKind::Deviations { .. } => return None,
    })
}

fn drawn(flat: &[Flat], [x_name, y_name]: [&str; 2], title: &str, sentence: &str, unit: &str) -> String {
    let x =
        if x_name == "°" { Axis::of(0.0, 360.0, x_name) } else { Axis::around(flat.iter().map(|f| f.across), x_name) };
    let lying = flat.iter().all(|f| f.up.is_none());
    let y = if lying {
        let reach = flat.iter().map(|f| f.deviation.abs()).fold(0.0, f64::max).max(1e-12);
        Axis::of(if flat.iter().any(|f| f.deviation < 0.0) { -1.1 * reach } else { 0.0 }, 1.1 * reach, y_name)
    } else {
        // Room for the sticks of the outermost points.
        let ups: Vec<f64> = flat.iter().filter_map(|f| f.up).collect();
        let [low, high] = [f64::min, f64::max].map(|pick| ups.iter().copied().reduce(pick).unwrap_or(0.0));
        let room = 0.16 * (high - low).max(1e-9);
        Axis::of(low - room, high + room, y_name)
    };
    let mut chart = Chart::new(title, sentence, x, y);
    let mut lengths: Vec<f64> = flat.iter().map(|f| f.deviation.abs()).collect();
    lengths.sort_by(f64::total_cmp);
    let typical = lengths[lengths.len() * 9 / 10].max(1e-300);
    let scale = STICK / typical;
    for (class, positive) in [("stick-a", true), ("stick-b", false)] {
        let sticks: Vec<_> = flat
            .iter()
            .filter(|f| (f.deviation >= 0.0) == positive)
            .map(|f| match f.up {
                Some(up) => {
                    let from = chart.at([f.across, up]);
                    // A blunder would cross the whole drawing.
                    let long = (f.deviation * scale).clamp(-4.0 * STICK, 4.0 * STICK);
                    (from, [from[0], from[1] - long])
                }
                None => (chart.at([f.across, 0.0]), chart.at([f.across, f.deviation])),
            })
            .collect();
        chart.svg.strokes(class, &sticks);
    }
    if !lying {
        let feet: Vec<[f64; 2]> = flat.iter().filter_map(|f| Some([f.across, f.up?])).collect();
        chart.dots("dot-c", &feet, 2.5);
        let bar = round_below(typical);
        let [_, top, right, _] = chart.frame();
        let long = bar * scale;
        chart.svg.path(
            "edge",
            &[[right - 6.0, top - 2.0], [right, top - 2.0], [right, top - 2.0 + long], [right - 6.0, top - 2.0 + long]],
        );
        chart.svg.label("axis", [right - 10.0, top - 8.0], Anchor::End, &format!("{} {unit}", round(bar)));
    }
    chart.finish()
}
