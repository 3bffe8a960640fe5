//! Distortion parameters divided by their standard errors: those below the limit are not significantly different from 0.

use super::chart::{Axis, Chart};
use super::svg::Anchor;
use super::{Group, Plot, file_name};
use crate::context::Context;
use crate::names::parameter_name;
use crate::number::fixed;

pub fn plots(context: &Context) -> Vec<Plot> {
    let words = context.words;
    let limit = context.adjustment.criteria.significance;
    let mut plots = Vec::new();
    for camera in context.adjustment.cameras.iter().filter(|camera| !camera.significance.is_empty()) {
        let own =
            camera.photo.as_ref().map_or(camera.camera.id.clone(), |photo| format!("{} · {photo}", camera.camera.id));
        let all: Vec<(&str, f64)> =
            camera.significance.iter().map(|(p, ratio)| (parameter_name(*p), ratio.abs())).collect();
        let weak: Vec<&str> = all.iter().filter(|(_, ratio)| *ratio < limit).map(|(name, _)| *name).collect();
        let title = words.plot_significance(&own);
        let sentence = if weak.is_empty() {
            words.plot_significance_all(&fixed(limit, 0))
        } else {
            words.plot_significance_says(&weak.join(", "), &fixed(limit, 0))
        };
        // Sizes differ by powers of ten.
        let log = |ratio: f64| ratio.max(0.1).log10();
        let y = Axis::of(-1.0, all.iter().map(|(_, r)| log(*r)).fold(log(limit), f64::max) + 0.2, words.log_ratio());
        let names = all.iter().map(|(name, _)| (*name).to_owned()).collect();
        let mut chart = Chart::new(&title, &sentence, Axis::named(names), y);
        let [left, _, right, bottom] = chart.frame();
        for (k, (_, ratio)) in all.iter().enumerate() {
            let class = if *ratio < limit { "bar weak" } else { "bar" };
            let (x0, x1) = (chart.x(k as f64 - 0.3), chart.x(k as f64 + 0.3));
            let y = chart.y(log(*ratio));
            chart.svg.rect(class, [x0, y], [x1 - x0, bottom - y]);
            chart.svg.label("strong", [(x0 + x1) / 2.0, y - 4.0], Anchor::Middle, &fixed(*ratio, 1));
        }
        let y = chart.y(log(limit));
        chart.svg.line("dashed", [left, y], [right, y]);
        let name = format!("significance-{}", file_name(&own));
        plots.push(Plot { name, group: Group::Cameras, small: false, title, sentence, svg: chart.finish() });
    }
    plots
}
