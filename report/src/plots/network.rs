//! The network from above and from the front at one scale, and obliquely as a picture, with its error ellipses exaggerated by a round
//! factor that is said.

use std::collections::HashMap;

use super::svg::{Anchor, Svg};
use super::{Group, MARKS, Plot, drawn_sentence, every_nth};
use crate::context::Context;
use crate::number::{count, round, round_below};
use sightline::adjustment::AdjustedPoint;
use sightline::project::Role;
use sightline::rotation;

const WIDTH: f64 = 520.0;

/// Name of the picture of the object.
pub const PICTURE: &str = "network-object";
/// From where the picture of the object is seen: from the front, from the left and from above, as the 3-D view begins.
const FROM: [f64; 3] = [1.0, -1.35, 0.95];

pub fn plots(context: &Context) -> Vec<Plot> {
    let words = context.words;
    let above = Axes { right: [1.0, 0.0, 0.0], up: [0.0, 1.0, 0.0] };
    let front = Axes { right: [1.0, 0.0, 0.0], up: [0.0, 0.0, 1.0] };
    // One scale for both views: the widest or the highest of them decides.
    let scale = [&above, &front].into_iter().filter_map(|axes| scale(context, axes)).reduce(f64::min);
    let Some(scale) = scale else { return Vec::new() };
    // A view from above has east to the right and north upwards, whatever is named first.
    let [x, y, z] = [0, 1, 2].map(|axis| context.axes.letter(axis));
    vec![
        plot(context, "network-above", words.plot_network_above(), above, scale, &[&format!("{x} →  {y} ↑")]),
        plot(context, "network-front", words.plot_network_front(), front, scale, &[&format!("{x} →  {z} ↑")]),
    ]
}

/// The object with its photos, seen obliquely: what was measured, at a glance. `None` without points and photos.
pub fn picture(context: &Context) -> Option<Plot> {
    let norm = |v: [f64; 3]| {
        let length = (0..3).map(|k| v[k] * v[k]).sum::<f64>().sqrt();
        v.map(|x| x / length)
    };
    let [x, y, z] = norm(FROM);
    // Right lies in the ground plane, up is across both.
    let right = norm([-y, x, 0.0]);
    let axes = Axes { right, up: [-z * right[1], z * right[0], x * right[1] - y * right[0]] };
    let scale = scale(context, &axes)?;
    Some(plot(context, PICTURE, context.words.plot_network_object(), axes, scale, &[]))
}

/// The plane of a drawing: unit vectors to the right and upwards, in object space.
#[derive(Clone, Copy)]
struct Axes {
    right: [f64; 3],
    up: [f64; 3],
}

impl Axes {
    fn on(&self, v: [f64; 3]) -> [f64; 2] {
        [self.right, self.up].map(|axis| (0..3).map(|k| axis[k] * v[k]).sum())
    }
}

/// Low and high corner of points and photos in a drawing's plane; `None` without them.
fn bounds(context: &Context, axes: &Axes) -> Option<[[f64; 2]; 2]> {
    let a = context.adjustment;
    if a.points.is_empty() || a.photos.is_empty() {
        return None;
    }
    let all = a.points.iter().map(|p| p.xyz).chain(a.photos.iter().map(|p| p.position));
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for place in all.map(|xyz| axes.on(xyz)) {
        for k in 0..2 {
            (low[k], high[k]) = (low[k].min(place[k]), high[k].max(place[k]));
        }
    }
    Some([low, high])
}

/// Units of the drawing to a unit of length.
fn scale(context: &Context, axes: &Axes) -> Option<f64> {
    let [low, high] = bounds(context, axes)?;
    let side = |k: usize| (high[k] - low[k]).max(1e-12);
    Some(((WIDTH - 70.0) / side(0)).min(360.0 / side(1)))
}

fn plot(context: &Context, name: &str, title: &str, axes: Axes, scale: f64, legend: &[&str]) -> Plot {
    let a = context.adjustment;
    let [low, high] = bounds(context, &axes).unwrap_or_default();
    let typical = context.mean_sigma().unwrap_or(0.0);
    let exaggeration = if typical > 0.0 { round_below(7.0 / (typical * scale)).max(1.0) } else { 0.0 };
    let every = every_nth(a.points.len(), MARKS);
    let view = View { context, low, high, scale, axes, exaggeration, every };
    let sentence =
        context.words.plot_network_says(&count(a.photos.len()), &count(a.points.len()), &round(exaggeration));
    let sentence = drawn_sentence(sentence, every, context);
    let svg = view.drawn(title, &sentence, legend);
    Plot { name: name.into(), group: Group::Network, small: false, title: title.into(), sentence, svg }
}

struct View<'a> {
    context: &'a Context<'a>,
    low: [f64; 2],
    high: [f64; 2],
    scale: f64,
    axes: Axes,
    exaggeration: f64,
    /// Every n-th tie point is drawn.
    every: usize,
}

impl View<'_> {
    fn at(&self, xyz: [f64; 3]) -> [f64; 2] {
        let [h, v] = self.axes.on(xyz);
        let middle = (self.low[0] + self.high[0]) / 2.0;
        [WIDTH / 2.0 + (h - middle) * self.scale, 24.0 + (self.high[1] - v) * self.scale]
    }

    fn drawn(&self, title: &str, sentence: &str, legend: &[&str]) -> String {
        let a = self.context.adjustment;
        let height = (self.high[1] - self.low[1]) * self.scale + 76.0;
        let mut svg = Svg::new(WIDTH, height, title, sentence);
        self.rays(&mut svg);
        let given: std::collections::HashSet<&str> =
            self.context.project.points.iter().filter(|p| p.role != Role::Tie).map(|p| p.id.as_str()).collect();
        let points = [false, true].map(|known| {
            let points = a.points.iter().filter(|p| given.contains(p.id.as_str()) == known);
            points.step_by(if known { 1 } else { self.every }).collect::<Vec<_>>()
        });
        for point in points.iter().flatten() {
            self.ellipse(&mut svg, point);
        }
        for (known, points) in [false, true].into_iter().zip(&points) {
            let places: Vec<[f64; 2]> = points.iter().map(|p| self.at(p.xyz)).collect();
            svg.dots(if known { "point given" } else { "point" }, &places, if known { 4.0 } else { 2.2 });
        }
        let labels = a.photos.len() <= 60;
        let mut taken = Vec::new();
        for photo in &a.photos {
            let name = if labels { photo.id.as_str() } else { "" };
            self.camera(&mut svg, photo.position, photo.rotation, name, &mut taken);
        }
        let bottom = height - 10.0;
        let bar = round_below(90.0 / self.scale);
        let long = bar * self.scale;
        svg.path("edge", &[[14.0, bottom - 6.0], [14.0, bottom], [14.0 + long, bottom], [14.0 + long, bottom - 6.0]]);
        svg.label("axis", [20.0 + long, bottom], Anchor::Start, &self.context.in_unit(&round(bar)));
        match legend {
            [axes] => svg.label("strong", [WIDTH - 14.0, bottom], Anchor::End, axes),
            _ => self.triad(&mut svg, [WIDTH - 44.0, bottom - 22.0]),
        }
        svg.finish()
    }

    /// The directions of the axes.
    fn triad(&self, svg: &mut Svg, origin: [f64; 2]) {
        for k in 0..3 {
            let name = self.context.axes.letter(k);
            let [h, v] = [self.axes.right[k], self.axes.up[k]];
            let at = |length: f64| [origin[0] + length * h, origin[1] - length * v];
            svg.line("edge", origin, at(22.0));
            let [x, y] = at(30.0);
            svg.label("strong", [x, y + 4.0], Anchor::Middle, name);
        }
    }

    fn rays(&self, svg: &mut Svg) {
        let a = self.context.adjustment;
        // Each camera's line to the middle of what it sees: all rays would be a grey field.
        let points: HashMap<&str, &AdjustedPoint> = a.points.iter().map(|p| (p.id.as_str(), p)).collect();
        let mut seen: HashMap<&str, (f64, [f64; 3])> = HashMap::new();
        for o in a.observations.iter().filter(|o| o.enabled) {
            let Some(point) = points.get(o.point.as_str()) else { continue };
            let (n, sum) = seen.entry(&o.photo).or_default();
            *n += 1.0;
            (0..3).for_each(|k| sum[k] += point.xyz[k]);
        }
        let middle = |photo: &str| seen.get(photo).map(|(n, sum)| sum.map(|sum| sum / n));
        let lines: Vec<_> =
            a.photos.iter().filter_map(|p| Some((self.at(p.position), self.at(middle(&p.id)?)))).collect();
        svg.strokes("ray", &lines);
    }

    /// The ellipse of the two drawn axes: half axes and direction from their covariance.
    fn ellipse(&self, svg: &mut Svg, point: &AdjustedPoint) {
        let Some(c) = point.covariance.filter(|_| self.exaggeration > 0.0) else { return };
        let full = [[c[0], c[1], c[2]], [c[1], c[3], c[4]], [c[2], c[4], c[5]]];
        let along = |v: [f64; 3]| self.axes.on(full.map(|row| (0..3).map(|k| row[k] * v[k]).sum()));
        let ([p, q], [_, r]) = (along(self.axes.right), along(self.axes.up));
        let middle = (p + r) / 2.0;
        let half = ((p - r) / 2.0).hypot(q);
        let angle = 0.5 * (2.0 * q).atan2(p - r);
        let size = |variance: f64| variance.max(0.0).sqrt() * self.exaggeration * self.scale;
        let axes = [size(middle + half), size(middle - half)];
        if axes[0] >= 0.5 {
            // The drawing counts downwards.
            svg.ellipse("uncertain", self.at(point.xyz), axes, -angle.to_degrees());
        }
    }

    /// A triangle that opens to where the camera looks, with its name where that lies on none of the `taken` places.
    fn camera(
        &self,
        svg: &mut Svg,
        position: [f64; 3],
        angles: [f64; 3],
        name: &str,
        taken: &mut Vec<([f64; 2], f64)>,
    ) {
        let m = rotation::object_to_camera(angles);
        let [h, v] = self.axes.on([m[(2, 0)], m[(2, 1)], m[(2, 2)]]);
        let view = [-h, v];
        let place = self.at(position);
        let length = view[0].hypot(view[1]);
        let d = if length > 1e-6 { [view[0] / length, view[1] / length] } else { [0.0, 0.0] };
        // Foreshortened as what looks out of the drawing is.
        let (long, wide) = (3.0 + 8.0 * length, 5.0);
        let corner =
            |side: f64| [place[0] + d[0] * long - side * d[1] * wide, place[1] + d[1] * long + side * d[0] * wide];
        if length > 1e-6 {
            svg.path("camera", &[place, corner(1.0), corner(-1.0), place]);
        } else {
            svg.rect("camera", [place[0] - 3.0, place[1] - 3.0], [6.0, 6.0]);
        }
        if !name.is_empty() {
            let name = if name.chars().count() > 12 {
                format!("{}…", name.chars().take(11).collect::<String>())
            } else {
                name.to_owned()
            };
            // Behind the camera, else beside it; half the width that it has in print.
            let half = 4.0 * name.chars().count() as f64;
            let beside = [[-9.0 * d[0], -9.0 * d[1]], [0.0, -13.0], [0.0, 15.0], [half + 8.0, 0.0], [-half - 8.0, 0.0]];
            let free = |at: &[f64; 2]| {
                taken
                    .iter()
                    .all(|(other, wide)| (at[0] - other[0]).abs() > half + wide || (at[1] - other[1]).abs() > 13.0)
            };
            let at = beside.map(|by| [place[0] + by[0], place[1] + by[1] + 4.0]).into_iter().find(free);
            if let Some(at) = at {
                taken.push((at, half));
                svg.label("strong", at, Anchor::Middle, &name);
            }
        }
    }
}
