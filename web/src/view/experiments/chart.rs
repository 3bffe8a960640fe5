//! A chart of an experiment: lines over numbers or named places, the paper's dashed beside ours.

use leptos::prelude::*;
use sightline_lab::experiments::{Axis, Chart, Series, Tick};

use super::names;
use crate::format;
use crate::i18n::experiments as words;

const WIDTH: f64 = 500.0;
const HEIGHT: f64 = 270.0;
const LEFT: f64 = 52.0;
const RIGHT: f64 = 12.0;
const TOP: f64 = 26.0;
const BOTTOM: f64 = 46.0;
/// Lines of more points than this have no marks.
const MARKED: usize = 20;

/// An axis of numbers: linear, or logarithmic where the numbers are positive and far apart.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Scale {
    from: f64,
    to: f64,
    logarithmic: bool,
}

impl Scale {
    /// An axis that holds all values; `spread` lets it be logarithmic.
    fn of(values: impl Iterator<Item = f64> + Clone, spread: bool) -> Self {
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(f64::NEG_INFINITY, f64::max);
        if !low.is_finite() || !high.is_finite() {
            return Self { from: 0.0, to: 1.0, logarithmic: false };
        }
        if spread && low > 0.0 && high > 25.0 * low {
            return Self { from: low / 1.25, to: high * 1.25, logarithmic: true };
        }
        // Zero belongs to a scale of sizes, unless everything lies far from it.
        let (low, high) = if low > 0.0 && low < 0.6 * high { (0.0, high) } else { (low, high) };
        let step = step((high - low).max(1e-12 * high.abs().max(1e-300)));
        Self { from: (low / step).floor() * step, to: (high / step).ceil() * step, logarithmic: false }
    }

    /// From 0 at the lower end to 1 at the upper.
    fn share(self, value: f64) -> f64 {
        let f = |v: f64| if self.logarithmic { v.ln() } else { v };
        let width = f(self.to) - f(self.from);
        if width > 0.0 { (f(value) - f(self.from)) / width } else { 0.5 }
    }

    fn ticks(self) -> Vec<f64> {
        if self.logarithmic {
            let powers = self.from.log10().floor() as i32..=self.to.log10().ceil() as i32;
            let all = powers.flat_map(|p| [1.0, 2.0, 5.0].map(|d| d * 10f64.powi(p)));
            return all.filter(|t| (self.from..=self.to).contains(t)).collect();
        }
        let step = step(self.to - self.from);
        let first = (self.from / step - 1e-9).ceil();
        let count = ((self.to / step + 1e-9).floor() - first).max(0.0) as usize;
        (0..=count.min(20)).map(|k| (first + k as f64) * step).collect()
    }

    /// Decimals needed to distinguish the ticks.
    fn decimals(self) -> usize {
        (-step(self.to - self.from).log10()).ceil().clamp(0.0, 8.0) as usize
    }

    fn tick(self, value: f64) -> String {
        if self.logarithmic { format::round(value) } else { format::fixed(value, self.decimals()) }
    }
}

/// A round step of 1, 2 or 5 that cuts a width into four to ten.
fn step(width: f64) -> f64 {
    let power = 10f64.powf((width / 4.0).log10().floor());
    let share = width / 4.0 / power;
    power
        * if share >= 5.0 {
            5.0
        } else if share >= 2.0 {
            2.0
        } else {
            1.0
        }
}

/// Look of a line: colour and mark by the place of its identifier among all.
fn look(ids: &[String], series: &Series) -> String {
    let place = ids.iter().position(|id| *id == series.id).unwrap_or(0);
    let second = if place / 3 % 2 == 1 { " second" } else { "" };
    format!("line c{}{second}{}", place % 3, if series.paper { " of-paper" } else { "" })
}

/// The two scales of a chart, and its coordinates on the page.
#[derive(Clone, Copy)]
struct Plane {
    x: Scale,
    y: Scale,
}

impl Plane {
    fn of(chart: &Chart) -> Self {
        let points = || chart.series.iter().flat_map(|s| s.points.iter().copied());
        let y = Scale::of(points().map(|p| p[1]), chart.y.unit != "%");
        let x = if chart.x.ticks.is_empty() {
            Scale::of(points().map(|p| p[0]), false)
        } else {
            let at = || chart.x.ticks.iter().map(|t| t.at);
            let (low, high) = (at().fold(f64::INFINITY, f64::min), at().fold(f64::NEG_INFINITY, f64::max));
            Scale { from: low - 0.5, to: high + 0.5, logarithmic: false }
        };
        Self { x, y }
    }

    fn right(self, v: f64) -> f64 {
        LEFT + self.x.share(v) * (WIDTH - LEFT - RIGHT)
    }

    fn down(self, v: f64) -> f64 {
        HEIGHT - BOTTOM - self.y.share(v) * (HEIGHT - BOTTOM - TOP)
    }
}

/// Horizontal lines with the values of y.
fn grid(plane: Plane) -> impl IntoView {
    let line = |v: f64| {
        let y = plane.down(v);
        view! {
            <line class=if v == 0.0 { "zero" } else { "grid" } x1=LEFT x2=WIDTH - RIGHT y1=y y2=y></line>
            <text class="axis" x=LEFT - 6.0 y=y + 4.0 text-anchor="end">{plane.y.tick(v)}</text>
        }
    };
    plane.y.ticks().into_iter().map(line).collect_view()
}

/// Names of the cases along x, or vertical lines with the values of x.
fn ticks(chart: &Chart, plane: Plane) -> AnyView {
    if !chart.x.ticks.is_empty() {
        let tick = |t: &Tick| {
            let y = HEIGHT - BOTTOM + if t.group { 31.0 } else { 16.0 };
            let class = if t.group { "axis strong" } else { "axis" };
            view! { <text class=class x=plane.right(t.at) y=y text-anchor="middle">{names::name(&t.text)}</text> }
        };
        return chart.x.ticks.iter().map(tick).collect_view().into_any();
    }
    let tick = |v: f64| {
        let x = plane.right(v);
        view! {
            <line class="grid" x1=x x2=x y1=TOP y2=HEIGHT - BOTTOM></line>
            <text class="axis" x=x y=HEIGHT - BOTTOM + 16.0 text-anchor="middle">{plane.x.tick(v)}</text>
        }
    };
    plane.x.ticks().into_iter().map(tick).collect_view().into_any()
}

fn line(series: &Series, ids: &[String], plane: Plane) -> impl IntoView + use<> {
    let places = || series.points.iter().map(|p| [plane.right(p[0]), plane.down(p[1])]);
    let path = places().enumerate().map(|(i, [x, y])| format!("{}{x:.1} {y:.1}", if i == 0 { "M" } else { "L" }));
    let place = ids.iter().position(|id| *id == series.id).unwrap_or(0) % 3;
    let marks = (series.points.len() <= MARKED).then(|| places().map(|[x, y]| mark(place, x, y)).collect_view());
    let (class, path) = (look(ids, series), path.collect::<String>());
    view! { <g class=class><path class="way" d=path></path>{marks}</g> }
}

/// An entry for each line; those of the paper have entries of their own.
fn legend(chart: &Chart, ids: &[String]) -> impl IntoView + use<> {
    let mut entries: Vec<&Series> = Vec::new();
    for s in &chart.series {
        if !entries.iter().any(|known| known.id == s.id && known.paper == s.paper) {
            entries.push(s);
        }
    }
    let entry = |series: &Series| {
        let place = ids.iter().position(|known| *known == series.id).unwrap_or(0) % 3;
        let (id, paper, look) = (series.id.clone(), series.paper, look(ids, series));
        let words = move || {
            let label = names::label(&id);
            if paper && id != "planted" { words::paper_of(label) } else { label }
        };
        view! {
            <li>
                <svg class="swatch-line" width="30" height="12" viewBox="0 0 30 12" aria-hidden="true">
                    <g class=look><path class="way" d="M1 6H29"></path>{mark(place, 15.0, 6.0)}</g>
                </svg>
                <span>{words}</span>
            </li>
        }
    };
    entries.into_iter().map(entry).collect_view()
}

/// Name of an axis with its unit.
fn axis_label(axis: &Axis) -> impl Fn() -> String + Clone + Send + Sync + use<> {
    let (id, unit) = (axis.id.clone(), axis.unit.clone());
    move || {
        let label = names::label(&id);
        if unit.is_empty() || label == unit { label } else { format!("{label} {unit}") }
    }
}

/// The chart with its title and legend.
#[component]
pub fn LineChart(chart: Chart) -> impl IntoView {
    let mut ids: Vec<String> = Vec::new();
    chart.series.iter().for_each(|s| {
        if !ids.contains(&s.id) {
            ids.push(s.id.clone());
        }
    });
    let plane = Plane::of(&chart);
    let lines = chart.series.iter().map(|series| line(series, &ids, plane)).collect_view();
    let (across, entries) = (ticks(&chart, plane), legend(&chart, &ids));
    let (across_label, up_label) = (axis_label(&chart.x), axis_label(&chart.y));
    let id = chart.id.clone();
    let title = Signal::derive(move || names::chart(&chart));
    view! {
        <figure class="chart" data-chart=id>
            <h2 class="section-head"><span>{title}</span></h2>
            <svg class="plot" viewBox=format!("0 0 {WIDTH} {HEIGHT}") role="img" aria-label=title>
                {grid(plane)}{across}
                <text class="axis" x=LEFT - 44.0 y="12">{up_label}</text>
                <text class="axis" x=WIDTH - RIGHT y=HEIGHT - 2.0 text-anchor="end">{across_label}</text>
                {lines}
            </svg>
            <ul class="lines">{entries}</ul>
        </figure>
    }
}

/// A mark of its own shape for every colour.
fn mark(place: usize, x: f64, y: f64) -> AnyView {
    match place {
        0 => view! { <circle class="mark-at" cx=x cy=y r="3"></circle> }.into_any(),
        1 => view! { <rect class="mark-at" x=x - 2.75 y=y - 2.75 width="5.5" height="5.5"></rect> }.into_any(),
        _ => view! { <path class="mark-at" d=format!("M{x:.1} {:.1}l3.5 6h-7z", y - 3.8)></path> }.into_any(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_hold_their_values_and_step_roundly() {
        let scale = Scale::of([3.0, 47.0].into_iter(), false);
        assert_eq!((scale.from, scale.to), (0.0, 50.0));
        assert_eq!(scale.ticks(), [0.0, 10.0, 20.0, 30.0, 40.0, 50.0]);
        let near = Scale::of([0.6796, 0.6852].into_iter(), false);
        assert!(near.from > 0.67 && near.to < 0.69 && near.ticks().len() >= 4);
        let wide = Scale::of([0.05, 5.0].into_iter(), true);
        assert!(wide.logarithmic && wide.ticks().contains(&1.0));
        assert!((wide.share(0.5) - 0.5).abs() < 1e-12);
        let same = Scale::of([2.0, 2.0].into_iter(), false);
        assert!(same.share(2.0).is_finite() && !same.ticks().is_empty() && same.ticks().len() < 25);
    }
}
