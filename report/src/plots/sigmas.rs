//! Standard errors per axis over the points, in the order of their size.

use super::chart::{Axis, Chart};
use super::svg::Anchor;
use super::{Group, MARKS, Plot, drawn_sentence, every_nth};
use crate::context::Context;
use crate::number::{count, fixed};

pub fn plots(context: &Context) -> Vec<Plot> {
    let words = context.words;
    let mut sigmas: Vec<[f64; 3]> = context.adjustment.points.iter().filter_map(|p| p.sigma).collect();
    if sigmas.len() < 2 {
        return Vec::new();
    }
    let largest = |s: &[f64; 3]| s.iter().copied().fold(0.0, f64::max);
    sigmas.sort_by(|a, b| largest(a).total_cmp(&largest(b)));
    let top = sigmas.last().map_or(1.0, largest);
    let title = words.plot_sigmas();
    let median = largest(&sigmas[sigmas.len() / 2]);
    let ratio = if median > 0.0 { top / median } else { 1.0 };
    let sentence = words.plot_sigmas_says(
        &count(sigmas.len()),
        &context.with_unit(median),
        &context.with_unit(top),
        &fixed(ratio, 1),
    );
    let every = every_nth(sigmas.len(), MARKS);
    let sentence = drawn_sentence(sentence, every, context);
    let x = Axis::of(0.5, sigmas.len() as f64 + 0.5, words.points_by_size());
    let mut chart = Chart::new(title, &sentence, x, Axis::of(0.0, 1.05 * top, &format!("σ {}", context.unit)));
    let [left, top, ..] = chart.frame();
    let marks = [("dot-a", "a"), ("dot-b", "b"), ("dot-z", "strong")];
    for (axis, (name, (class, line))) in context.axes.names().into_iter().zip(marks).enumerate() {
        let of = context.axes.order()[axis];
        // The last is always drawn: it is the one that the sentence names.
        let ordered = sigmas.iter().enumerate().rev().step_by(every);
        let values: Vec<[f64; 2]> = ordered.map(|(k, s)| [k as f64 + 1.0, s[of]]).collect();
        chart.dots(class, &values, if sigmas.len() > 200 { 2.0 } else { 3.5 });
        chart.svg.label(line, [left + 10.0 + 30.0 * axis as f64, top + 12.0], Anchor::Start, &format!("σ {name}"));
    }
    let plot = Plot {
        name: "sigmas".into(),
        group: Group::Points,
        small: false,
        title: title.into(),
        sentence,
        svg: chart.finish(),
    };
    vec![plot]
}
