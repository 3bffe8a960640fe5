//! Standardised residuals against the normal distribution: as a histogram, and quantile by quantile (normal plot).
//! Source: J. W. Tukey 1977; plotting positions (k - 3/8) / (n + 1/4) of G. Blom 1958.

use super::chart::{Axis, Chart};
use super::{Group, Plot};
use crate::context::Context;
use crate::number::{count, fixed};
use sightline::statistics::distribution::normal_quantile;

/// Width of a class.
const CLASS: f64 = 0.5;
/// Classes reach so far; what is beyond is counted in the last.
const REACH: f64 = 5.0;
/// Maximum number of dots of the normal plot.
const DOTS: usize = 400;

pub fn plots(context: &Context) -> Vec<Plot> {
    let enabled = context.adjustment.observations.iter().filter(|o| o.enabled);
    let mut w: Vec<f64> = enabled.flat_map(|o| [o.wx, o.wy]).flatten().filter(|w| w.is_finite()).collect();
    if w.len() < 10 {
        return Vec::new();
    }
    w.sort_by(f64::total_cmp);
    vec![histogram(context, &w), normal_plot(context, &w)]
}

/// Standard deviation of w: σ0 where nothing is wrong.
fn spread(w: &[f64]) -> f64 {
    (w.iter().map(|w| w * w).sum::<f64>() / w.len() as f64).sqrt()
}

fn histogram(context: &Context, w: &[f64]) -> Plot {
    let words = context.words;
    let classes = (2.0 * REACH / CLASS) as usize;
    let mut counts = vec![0_usize; classes];
    for w in w {
        let class = ((w + REACH) / CLASS).floor().clamp(0.0, classes as f64 - 1.0) as usize;
        counts[class] += 1;
    }
    let scale = w.len() as f64 * CLASS;
    let normal = |x: f64| scale * (-0.5 * x * x).exp() / std::f64::consts::TAU.sqrt();
    let limit = context.adjustment.criteria.w;
    let beyond = w.iter().filter(|w| w.abs() > limit).count();
    let title = words.plot_histogram();
    let sentence = words.plot_histogram_says(&count(w.len()), &fixed(spread(w), 2), &count(beyond), &fixed(limit, 2));
    let most = counts.iter().map(|n| *n as f64).fold(normal(0.0), f64::max);
    let y = Axis::of(0.0, 1.05 * most, words.number_of());
    let mut chart = Chart::new(title, &sentence, Axis::of(-REACH, REACH, "w"), y);
    for (k, n) in counts.iter().enumerate() {
        let middle = -REACH + (k as f64 + 0.5) * CLASS;
        chart.bar("bar pale", middle, 0.92 * CLASS, *n as f64);
    }
    let curve: Vec<[f64; 2]> =
        (0..=100).map(|k| -REACH + 0.02 * REACH * f64::from(k)).map(|x| [x, normal(x)]).collect();
    chart.line("line-b", &curve);
    for x in [-limit, limit] {
        chart.mark(x, "");
    }
    Plot {
        name: "histogram".into(),
        group: Group::Statistics,
        small: false,
        title: title.into(),
        sentence,
        svg: chart.finish(),
    }
}

fn normal_plot(context: &Context, w: &[f64]) -> Plot {
    let words = context.words;
    let n = w.len();
    let quantile = |k: usize| normal_quantile((k as f64 + 1.0 - 0.375) / (n as f64 + 0.25));
    // The ends are all there, the middle is thinned.
    let every = n.div_ceil(DOTS);
    let kept = (0..n).filter(|k| *k < 20 || *k + 20 >= n || k.is_multiple_of(every));
    let dots: Vec<[f64; 2]> = kept.map(|k| [quantile(k), w[k]]).collect();
    let title = words.plot_normal();
    let sentence = words.plot_normal_says().to_owned();
    let reach = quantile(n - 1).max(1.0);
    let x = Axis::of(-1.05 * reach, 1.05 * reach, words.normal_quantile());
    let y = Axis::around(dots.iter().map(|d| d[1]).chain([-reach, reach]), "w");
    let mut chart = Chart::new(title, &sentence, x, y);
    chart.line("line-b", &[[-reach, -reach], [reach, reach]]);
    chart.dots("dot-a", &dots, 3.0);
    Plot {
        name: "normal-plot".into(),
        group: Group::Statistics,
        small: false,
        title: title.into(),
        sentence,
        svg: chart.finish(),
    }
}
