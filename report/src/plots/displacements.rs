//! Displacements between two epochs as arrows at a stated exaggeration, seen along the axis of which the points show least, and along
//! another where the object is deep.

use super::svg::{Anchor, Svg};
use super::{Group, Plot};
use crate::number::{fixed, round as rounded};
use crate::texts::Words;
use sightline::depiction::{extent, round};
use sightline::monitoring::{Displacement, Pair, PointRole};

const WIDTH: f64 = 520.0;
const HIGHEST: f64 = 360.0;
/// Room for names and arrows around the points.
const MARGIN: f64 = 46.0;
/// Share of the object's diagonal that the largest displacement takes.
const SHARE: f64 = 0.12;
/// A second view is drawn where the object is deeper than this share of its width: a wall has one.
const DEEP: f64 = 0.15;
/// More points than this have names only where they moved.
const NAMED: usize = 80;

/// Labels that do not overlap.
#[derive(Default)]
struct Names {
    /// Left, top, right and bottom of the labels so far.
    taken: Vec<[f64; 4]>,
}

impl Names {
    /// Writes a label to the right of a place; one that would overlap another only if it must.
    fn put(&mut self, svg: &mut Svg, class: &str, at: [f64; 2], text: &str, must: bool) {
        let long = 6.5 * text.chars().count() as f64;
        let room = [at[0], at[1] - 10.0, at[0] + long, at[1] + 2.0];
        let apart =
            |other: &[f64; 4]| room[2] < other[0] || other[2] < room[0] || room[3] < other[1] || other[3] < room[1];
        if must || self.taken.iter().all(apart) {
            self.taken.push(room);
            svg.label(class, at, Anchor::Start, text);
        }
    }
}

/// Views of a pair; none without points.
pub fn plots(pair: &Pair, unit: &str, decimals: usize, w: &'static dyn Words) -> Vec<Plot> {
    let (_, size) = extent(pair.points.iter().map(|p| p.xyz));
    let spans: [f64; 3] = std::array::from_fn(|a| {
        let along = || pair.points.iter().map(|p| p.xyz[a]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    });
    let largest = pair.points.iter().map(|p| p.length).fold(0.0, f64::max);
    if pair.points.is_empty() || !spans.iter().all(|s| s.is_finite()) {
        return Vec::new();
    }
    let factor = if largest > 0.0 { round(SHARE * size / largest).max(1.0) } else { 1.0 };
    // From above, from the front, from the side.
    let mut views = [([0, 1], w.epochs_from_above()), ([0, 2], w.epochs_from_front()), ([1, 2], w.epochs_from_side())];
    views.sort_by(|(a, _), (b, _)| {
        let area = |axes: &[usize; 2]| spans[axes[0]] * spans[axes[1]];
        area(b).total_cmp(&area(a))
    });
    let deepest = spans.iter().copied().fold(f64::INFINITY, f64::min);
    let count = if deepest > DEEP * spans.iter().copied().fold(0.0, f64::max) { 2 } else { 1 };
    let scale = views[..count].iter().map(|([right, up], _)| {
        let across = |k: usize| spans[k].max(1e-9 * size);
        ((WIDTH - 2.0 * MARGIN) / across(*right)).min((HIGHEST - 2.0 * MARGIN) / across(*up))
    });
    // One scale for all views.
    let scale = scale.fold(f64::INFINITY, f64::min);
    let bar = round(0.2 * size);
    let one = |(axes, seen): &([usize; 2], &str)| {
        let title = w.epochs_figure(&seen);
        let sentence = w.epochs_figure_says(&rounded(factor), &rounded(bar / factor), &unit);
        let drawing = Drawing { pair, axes: *axes, spans, factor, scale, decimals, unit };
        let svg = drawing.drawn(&title, &sentence, (bar, w));
        let [right, up] = axes.map(|a| ["x", "y", "z"][a]);
        let name = format!("displacements-{right}{up}");
        Plot { name, group: Group::Points, small: false, title, sentence, svg }
    };
    views[..count].iter().map(one).collect()
}

struct Drawing<'a> {
    pair: &'a Pair,
    axes: [usize; 2],
    spans: [f64; 3],
    factor: f64,
    scale: f64,
    decimals: usize,
    unit: &'a str,
}

impl Drawing<'_> {
    fn drawn(&self, title: &str, sentence: &str, (bar, w): (f64, &dyn Words)) -> String {
        let [right, up] = self.axes;
        let low = |a: usize| self.pair.points.iter().map(|p| p.xyz[a]).fold(f64::INFINITY, f64::min);
        let middle = [right, up].map(|a| low(a) + self.spans[a] / 2.0);
        let high = (self.spans[up] * self.scale + 2.0 * MARGIN).max(2.0 * MARGIN + 20.0);
        let at = |xyz: [f64; 3]| {
            [WIDTH / 2.0 + (xyz[right] - middle[0]) * self.scale, high / 2.0 - (xyz[up] - middle[1]) * self.scale]
        };
        let mut svg = Svg::new(WIDTH, high + 34.0, title, sentence);
        let (mut still, mut reference) = (Vec::new(), Vec::new());
        let few = self.pair.points.len() <= NAMED;
        let mut names = Names::default();
        // What moved has its name and length first.
        let strong = |p: &&Displacement| self.is_strong(p);
        let order = self.pair.points.iter().filter(strong).chain(self.pair.points.iter().filter(|p| !strong(p)));
        for point in order {
            let (place, strong) = (at(point.xyz), self.is_strong(point));
            let tip = at(std::array::from_fn(|a| point.xyz[a] + self.factor * point.difference[a]));
            self.arrow(&mut svg, point, place, tip);
            if point.role == PointRole::Reference {
                reference.push(place)
            } else {
                still.push(place)
            }
            if few || strong {
                let class = if strong { "strong" } else { "axis" };
                names.put(&mut svg, class, [place[0] + 6.0, place[1] - 5.0], &point.id, strong);
            }
            if strong {
                let below = if tip[1] < place[1] { tip[1] - 8.0 } else { tip[1] + 16.0 };
                let length = fixed(point.length, self.decimals);
                names.put(&mut svg, "b", [tip[0] + 5.0, below], &length, true);
            }
        }
        svg.dots("point", &still, 4.0);
        svg.dots("point given", &reference, 6.0);
        let long = bar * self.scale;
        let bottom = high + 16.0;
        svg.path("edge", &[[14.0, bottom - 5.0], [14.0, bottom], [14.0 + long, bottom], [14.0 + long, bottom - 5.0]]);
        let told = format!(
            "{} {}, {} {} {}",
            rounded(bar),
            self.unit,
            w.epochs_displacements(),
            rounded(bar / self.factor),
            self.unit
        );
        svg.label("axis", [20.0 + long, bottom], Anchor::Start, &told);
        let names = ["X", "Y", "Z"];
        svg.label("strong", [WIDTH - 14.0, bottom], Anchor::End, &format!("{} →  {} ↑", names[right], names[up]));
        svg.finish()
    }

    /// Whether a point moved.
    fn is_strong(&self, point: &Displacement) -> bool {
        point.moved || self.pair.unstable.contains(&point.id)
    }

    fn arrow(&self, svg: &mut Svg, point: &Displacement, from: [f64; 2], tip: [f64; 2]) {
        let strong = self.is_strong(point);
        let class = if strong { "vector over" } else { "vector" };
        svg.line(class, from, tip);
        let (dx, dy) = (tip[0] - from[0], tip[1] - from[1]);
        let length = dx.hypot(dy);
        if length > 4.0 {
            let back = 6.0_f64.min(length);
            let (x, y) = (dx / length, dy / length);
            let side = |s: f64| [tip[0] - back * x - s * 3.0 * y, tip[1] - back * y + s * 3.0 * x];
            svg.path(class, &[side(1.0), tip, side(-1.0)]);
        }
        if let Some(ellipsoid) = point.ellipsoid.as_ref().filter(|_| strong) {
            let unit = |a: usize| std::array::from_fn(|k| if k == a { 1.0 } else { 0.0 });
            let (axes, angle) = ellipsoid.outline(unit(self.axes[0]), unit(self.axes[1]));
            let axes = axes.map(|a| a * self.factor * self.scale);
            svg.ellipse("uncertain", tip, axes, -angle.to_degrees());
        }
    }
}
