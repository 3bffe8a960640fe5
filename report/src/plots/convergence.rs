//! σ0 iteration by iteration on a logarithmic axis.

use super::chart::{Axis, Chart};
use super::svg::Anchor;
use super::{Group, Plot};
use crate::context::Context;
use crate::number::{compact, count, fixed};

pub fn plots(context: &Context) -> Vec<Plot> {
    let words = context.words;
    let iterations = &context.adjustment.iterations;
    let logs: Vec<f64> = iterations.iter().filter(|i| i.sigma0 > 0.0).map(|i| i.sigma0.log10()).collect();
    let Some(last) = logs.last() else { return Vec::new() };
    let title = words.plot_convergence();
    let sentence = words.plot_convergence_says(&count(iterations.len()), &compact(10f64.powf(*last)));
    let n = logs.len();
    // Few iterations are named one by one: there is nothing between them.
    let few = n <= 12;
    let mut x = if few { Axis::named((1..=n).map(count).collect()) } else { Axis::of(0.5, n as f64 + 0.5, "") };
    words.iteration().clone_into(&mut x.name);
    let first = if few { 0.0 } else { 1.0 };
    let y = Axis::around(logs.iter().copied().chain([0.0]), "log₁₀ σ₀");
    let mut chart = Chart::new(title, &sentence, x, y);
    let values: Vec<[f64; 2]> = logs.iter().enumerate().map(|(k, log)| [k as f64 + first, *log]).collect();
    chart.line("line-a", &values);
    chart.dots("dot-a", &values, 6.0);
    let place = chart.at([(n - 1) as f64 + first, *last]);
    let text = fixed(10f64.powf(*last), 3);
    chart.svg.label("strong", [place[0] - 8.0, place[1] - 8.0], Anchor::End, &text);
    vec![Plot {
        name: "convergence".into(),
        group: Group::Statistics,
        small: false,
        title: title.into(),
        sentence,
        svg: chart.finish(),
    }]
}
