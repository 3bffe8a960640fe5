//! Two adjustments of the same points: how far the later one moved each, beside its standard error.

use std::collections::HashMap;

use super::chart::{Axis, Chart};
use super::svg::Anchor;
use super::{Group, Plot};
use crate::adjustment::Adjustment;
use crate::report::context::Context;
use crate::report::number::{count, fixed, maybe};

pub fn plot(context: &Context, before: &Adjustment) -> Option<Plot> {
    let words = context.words;
    let earlier: HashMap<&str, [f64; 3]> = before.points.iter().map(|p| (p.id.as_str(), p.xyz)).collect();
    let length = |d: [f64; 3]| d[0].hypot(d[1]).hypot(d[2]);
    let common = context.adjustment.points.iter().filter_map(|p| Some((p, earlier.get(p.id.as_str())?)));
    let mut moved: Vec<(&str, f64, f64)> = common
        .map(|(p, old)| {
            let shift = length(std::array::from_fn(|k| p.xyz[k] - old[k]));
            (p.id.as_str(), shift, p.sigma.map_or(0.0, length))
        })
        .collect();
    if moved.len() < 2 {
        return None;
    }
    moved.sort_by(|a, b| a.1.total_cmp(&b.1));
    let n = moved.len();
    let rms = (moved.iter().map(|m| m.1 * m.1).sum::<f64>() / n as f64).sqrt();
    let beyond = moved.iter().filter(|m| m.1 > 2.0 * m.2).count();
    let (worst, largest, _) = moved[n - 1];
    let title = words.plot_comparison();
    let sigma0 = [before.sigma0, context.adjustment.sigma0].map(|s| maybe(s, 3));
    let sentence = words.plot_comparison_says(
        &count(n),
        &context.with_unit(rms),
        &context.with_unit(largest),
        &worst,
        &count(beyond),
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
