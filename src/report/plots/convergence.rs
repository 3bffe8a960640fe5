//! σ0 iteration by iteration on a logarithmic axis.

use super::chart::{Axis, Chart};
use super::svg::Anchor;
use super::{Group, Plot};
use crate::report::context::Context;
use crate::report::number::{compact, count, fixed};

pub fn plots(context: &Context) -> Vec<Plot> {
    let words = context.words;
    let iterations = &context.adjustment.iterations;
    let logs: Vec<f64> = iterations.iter().filter(|i| i.sigma0 > 0.0).map(|i| i.sigma0.log10()).collect();
    let Some(last) = logs.last() else { return Vec::new() };
    let title = words.plot_convergence();
    let sentence = words.plot_convergence_says(&count(iterations.len()), &compact(10f64.powf(*last)));
    let x = Axis::of(0.5, logs.len() as f64 + 0.5, words.iteration());
    let y = Axis::around(logs.iter().copied().chain([0.0]), "log₁₀ σ₀");
    let mut chart = Chart::new(title, &sentence, x, y);
    let values: Vec<[f64; 2]> = logs.iter().enumerate().map(|(k, log)| [k as f64 + 1.0, *log]).collect();
    chart.line("line-a", &values);
    chart.dots("dot-a", &values, 6.0);
    let place = chart.at([logs.len() as f64, *last]);
    let text = fixed(10f64.powf(*last), 3);
    chart.svg.label("strong", [place[0], place[1] - 8.0], Anchor::End, &text);
    vec![Plot {
        name: "convergence".into(),
        group: Group::Statistics,
        small: false,
        title: title.into(),
        sentence,
        svg: chart.finish(),
    }]
}
