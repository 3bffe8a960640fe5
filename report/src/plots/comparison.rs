//! Comparison of two adjustments of the same points: movement of each point and its standard error.

use super::chart::{Axis, Chart};
use super::svg::Anchor;
use super::{Group, Plot};
use crate::context::Context;
use crate::number::{count, fixed, maybe};
use sightline::comparison::Comparison;

pub fn plot(context: &Context, comparison: &Comparison) -> Option<Plot> {
    let words = context.words;
    let length = |d: [f64; 3]| d[0].hypot(d[1]).hypot(d[2]);
    let mut moved: Vec<(&str, f64, f64)> =
        comparison.points.iter().map(|m| (m.id.as_str(), m.length(), m.sigma.map_or(0.0, length))).collect();
    let rms = comparison.rms.filter(|_| moved.len() >= 2)?;
    moved.sort_by(|a, b| a.1.total_cmp(&b.1));
    let n = moved.len();
    let (worst, largest, _) = moved[n - 1];
    let title = words.plot_comparison();
    let sigma0 = comparison.sigma0.map(|s| maybe(s, 3));
    let sentence = words.plot_comparison_says(
        &count(n),
        &context.with_unit(rms),
        &context.with_unit(largest),
        &worst,
        &fixed(comparison.limit, 2),
        &count(comparison.beyond),
        &sigma0[0],
        &sigma0[1],
    );
    let top = moved.iter().map(|m| m.1.max(m.2)).fold(0.0, f64::max);
    let x = Axis::of(0.5, n as f64 + 0.5, words.points_by_shift());
    let mut chart = Chart::new(title, &sentence, x, Axis::of(0.0, 1.05 * top, &format!("|Δ|, σ {}", context.unit)));
    let size = if n > 200 { 2.0 } else { 3.5 };
    let values = |of: fn(&(&str, f64, f64)) -> f64| -> Vec<[f64; 2]> {
        moved.iter().enumerate().map(|(k, m)| [k as f64 + 1.0, of(m)]).collect()
    };
    chart.dots("dot-b", &values(|m| m.2), size);
    chart.dots("dot-a", &values(|m| m.1), size);
    let [left, top, ..] = chart.frame();
    chart.svg.label(
        "a",
        [left + 10.0, top + 12.0],
        Anchor::Start,
        &format!("|Δ| ({} {})", words.rms(), fixed(rms, context.decimals)),
    );
    chart.svg.label("b", [left + 10.0, top + 27.0], Anchor::Start, "σ");
    Some(Plot {
        name: "comparison".into(),
        group: Group::Points,
        small: false,
        title: title.into(),
        sentence,
        svg: chart.finish(),
    })
}
