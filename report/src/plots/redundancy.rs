//! Redundancy numbers over the photo: where observations are hardly checked by others.

use super::svg::{Anchor, Svg};
use super::{Group, MARKS, Plot, drawn_sentence, every_nth, file_name};
use crate::context::Context;
use crate::number::{count, fixed};
use sightline::project::Camera;

const WIDTH: f64 = 520.0;

pub fn plots(context: &Context) -> Vec<Plot> {
    context.project.cameras.iter().filter_map(|camera| one(context, camera)).collect()
}

fn one(context: &Context, camera: &Camera) -> Option<Plot> {
    let words = context.words;
    let pairs = context.project.observations.iter().zip(&context.adjustment.observations);
    let own = pairs.filter(|(o, r)| r.enabled && context.camera_of(&o.photo).is_some_and(|c| c.id == camera.id));
    let all: Vec<([f64; 2], f64)> = own.filter_map(|(o, r)| Some(([o.u, o.v], r.rx?.min(r.ry?)))).collect();
    if all.is_empty() {
        return None;
    }
    let limit = context.adjustment.criteria.low_redundancy;
    let low = all.iter().filter(|(_, r)| *r < limit).count();
    let mean = all.iter().map(|(_, r)| r).sum::<f64>() / all.len() as f64;
    let title = words.plot_redundancy(&camera.id);
    let sentence = words.plot_redundancy_says(&fixed(mean, 2), &count(low), &fixed(limit, 1));
    let every = every_nth(all.len(), MARKS);
    let sentence = drawn_sentence(sentence, every, context);
    let scale = (WIDTH - 4.0) / f64::from(camera.width).max(1.0);
    let (w, h) = (f64::from(camera.width) * scale, f64::from(camera.height) * scale);
    let mut svg = Svg::new(WIDTH, h + 24.0, &title, &sentence);
    svg.rect("frame", [2.0, 2.0], [w, h]);
    // Four sizes: the less an observation is checked, the larger its dot.
    let steps = [(0.7, 2.0, "dot-a"), (0.4, 4.0, "dot-a"), (limit, 6.5, "dot-b"), (f64::NEG_INFINITY, 9.0, "dot-bad")];
    let mut above = f64::INFINITY;
    let mut legend = 2.0;
    for (from, size, class) in steps {
        let within = all.iter().step_by(every).filter(|(_, r)| *r >= from && *r < above);
        let places: Vec<[f64; 2]> = within.map(|([u, v], _)| [2.0 + u * scale, 2.0 + v * scale]).collect();
        svg.dots(class, &places, size);
        let name =
            if from.is_finite() { format!("r ≥ {}", fixed(from, 1)) } else { format!("r < {}", fixed(limit, 1)) };
        svg.dots(class, &[[legend + 5.0, h + 15.0]], size);
        svg.label("axis", [legend + 14.0, h + 19.0], Anchor::Start, &name);
        legend += 74.0;
        above = from;
    }
    let name = format!("redundancy-{}", file_name(&camera.id));
    Some(Plot { name, group: Group::Residuals, small: false, title, sentence, svg: svg.finish() })
}
