//! A chart: two axes with round numbers, a grid, and places in it.

use super::svg::{Anchor, Svg};
use crate::number::{fixed, round};

/// Size of a chart.
pub const SIZE: [f64; 2] = [520.0, 280.0];
/// Left, top, right and bottom of what is drawn in.
const ROOM: [f64; 4] = [58.0, 22.0, 14.0, 38.0];

/// An axis: its limits and its name with the unit.
#[derive(Clone, Debug)]
pub struct Axis {
    pub from: f64,
    pub to: f64,
    pub name: String,
    /// Names in place of numbers, at 0, 1, 2 …
    pub names: Vec<String>,
}

impl Axis {
    /// From numbers that have to be on it, with a little room.
    pub fn around(values: impl IntoIterator<Item = f64>, name: &str) -> Self {
        let finite = values.into_iter().filter(|v| v.is_finite());
        let (from, to) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        let (from, to) = if from > to { (0.0, 1.0) } else { (from, to) };
        let room = if to > from { 0.05 * (to - from) } else { 0.5 * from.abs().max(1e-12) };
        Self { from: from - room, to: to + room, name: name.to_owned(), names: Vec::new() }
    }

    pub fn of(from: f64, to: f64, name: &str) -> Self {
        let to = if to > from { to } else { from + 1.0 };
        Self { from, to, name: name.to_owned(), names: Vec::new() }
    }

    /// Places 0, 1, 2 … with names.
    pub fn named(names: Vec<String>) -> Self {
        Self { from: -0.5, to: names.len() as f64 - 0.5, name: String::new(), names }
    }

    /// Round numbers on it, about so many, and their decimals.
    pub fn ticks(&self, about: f64) -> (Vec<f64>, usize) {
        let raw = (self.to - self.from) / about;
        let power = 10f64.powf(raw.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|s| s * power).find(|s| *s >= raw * 0.999).unwrap_or(raw);
        let first = (self.from / step).ceil() as i64;
        let last = (self.to / step).floor() as i64;
        let decimals = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
        ((first..=last.min(first + 50)).map(|k| k as f64 * step).collect(), decimals)
    }
}

/// A chart in the making.
pub struct Chart {
    pub svg: Svg,
    x: Axis,
    y: Axis,
}

impl Chart {
    /// Grid and axes.
    pub fn new(title: &str, description: &str, x: Axis, y: Axis) -> Self {
        let svg = Svg::new(SIZE[0], SIZE[1], title, description);
        let mut chart = Self { svg, x, y };
        chart.axes();
        chart
    }

    pub fn x(&self, value: f64) -> f64 {
        ROOM[0] + (value - self.x.from) / (self.x.to - self.x.from) * (SIZE[0] - ROOM[0] - ROOM[2])
    }

    pub fn y(&self, value: f64) -> f64 {
        SIZE[1] - ROOM[3] - (value - self.y.from) / (self.y.to - self.y.from) * (SIZE[1] - ROOM[1] - ROOM[3])
    }

    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x(x), self.y(y)]
    }

    /// Left, top, right and bottom of what is drawn in.
    pub fn frame(&self) -> [f64; 4] {
        [ROOM[0], ROOM[1], SIZE[0] - ROOM[2], SIZE[1] - ROOM[3]]
    }

    fn axes(&mut self) {
        let [left, top, right, bottom] = self.frame();
        let number = |value: f64, decimals: usize| {
            if value.abs() >= 1e5 || (value != 0.0 && decimals > 4) { round(value) } else { fixed(value, decimals) }
        };
        let (ticks, decimals) = self.y.ticks(5.0);
        for value in ticks {
            let y = self.y(value);
            self.svg.line(if value == 0.0 { "zero" } else { "grid" }, [left, y], [right, y]);
            self.svg.label("axis", [left - 6.0, y + 4.0], Anchor::End, &number(value, decimals));
        }
        if self.x.names.is_empty() {
            let (ticks, decimals) = self.x.ticks(7.0);
            for value in ticks {
                let x = self.x(value);
                self.svg.line("grid", [x, top], [x, bottom]);
                self.svg.label("axis", [x, bottom + 15.0], Anchor::Middle, &number(value, decimals));
            }
        } else {
            for (k, name) in self.x.names.clone().iter().enumerate() {
                let x = self.x(k as f64);
                self.svg.label("axis", [x, bottom + 15.0], Anchor::Middle, name);
            }
        }
        self.svg.line("edge", [left, bottom], [right, bottom]);
        let (x_name, y_name) = (self.x.name.clone(), self.y.name.clone());
        self.svg.label("axis", [right, bottom + 31.0], Anchor::End, &x_name);
        self.svg.label("axis", [left, top - 8.0], Anchor::Start, &y_name);
    }

    /// A line through values.
    pub fn line(&mut self, class: &str, values: &[[f64; 2]]) {
        let places: Vec<[f64; 2]> = values.iter().map(|v| self.clipped(*v)).collect();
        self.svg.path(class, &places);
    }

    /// A place, no higher and no lower than the chart.
    fn clipped(&self, value: [f64; 2]) -> [f64; 2] {
        let [_, top, _, bottom] = self.frame();
        let [x, y] = self.at(value);
        [x, y.clamp(top, bottom)]
    }

    /// The area between a lower and an upper line.
    pub fn band(&mut self, class: &str, lower: &[[f64; 2]], upper: &[[f64; 2]]) {
        let places = upper.iter().chain(lower.iter().rev()).map(|v| self.clipped(*v));
        let places: Vec<[f64; 2]> = places.collect();
        self.svg.path(class, &places);
    }

    pub fn dots(&mut self, class: &str, values: &[[f64; 2]], size: f64) {
        let places: Vec<[f64; 2]> = values.iter().map(|v| self.at(*v)).collect();
        self.svg.dots(class, &places, size);
    }

    /// A bar from 0, of a width in units of the axis.
    pub fn bar(&mut self, class: &str, x: f64, width: f64, value: f64) {
        let (left, right) = (self.x(x - width / 2.0), self.x(x + width / 2.0));
        let (zero, y) = (self.clipped([x, 0.0])[1], self.clipped([x, value])[1]);
        self.svg.rect(class, [left, zero.min(y)], [right - left, (zero - y).abs()]);
    }

    /// An upright line with a label at its top.
    pub fn mark(&mut self, x: f64, label: &str) {
        let [left, top, right, bottom] = self.frame();
        let at = self.x(x);
        self.svg.line("dashed", [at, top], [at, bottom]);
        let anchor = if at > (left + right) / 2.0 { Anchor::End } else { Anchor::Start };
        let side = if at > (left + right) / 2.0 { -4.0 } else { 4.0 };
        self.svg.label("axis", [at + side, top + 10.0], anchor, label);
    }

    pub fn finish(self) -> String {
        self.svg.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn ticks_are_round_and_lie_on_the_axis() {
        let (ticks, decimals) = Axis::of(0.0, 0.93, "").ticks(5.0);
        assert_eq!((ticks, decimals), (vec![0.0, 0.2, 0.4, 0.6000000000000001, 0.8], 1));
        for axis in
            [Axis::around([3.0], ""), Axis::around([], ""), Axis::of(1.0, 1.0, ""), Axis::around([f64::NAN, 0.0], "")]
        {
            let (ticks, _) = axis.ticks(5.0);
            assert!(!ticks.is_empty() && ticks.iter().all(|t| (axis.from..=axis.to).contains(t)), "{axis:?}");
        }
    }
}
