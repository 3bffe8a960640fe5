//! Residuals against the distance from the principal point: radial distortion that is not modelled appears as a slope or a wave.

use super::chart::{Axis, Chart};
use super::{Group, MARKS, Plot, drawn_sentence, every_nth};
use crate::context::Context;
use crate::number::fixed;

/// Classes along the radius.
const CLASSES: usize = 12;

pub fn plots(context: &Context) -> Vec<Plot> {
    let words = context.words;
    let unit = context.residual_unit;
    let mut all: Vec<[f64; 2]> = Vec::new();
    for (o, found) in context.project.observations.iter().zip(&context.adjustment.observations) {
        let (Some(vx), Some(vy), true) = (found.vx, found.vy, found.enabled) else { continue };
        let Some(camera) = context.camera_of(&o.photo) else { continue };
        let adjusted =
            context.adjustment.cameras.iter().find(|c| c.camera.id == camera.id).map_or(camera, |c| &c.camera);
        let get = |p| adjusted.interior.get(p).unwrap_or(0.0);
        let model = camera.interior.model();
        let [x0, y0] = model.centre.map(get);
        let (at, centre) = if model.in_photo_units {
            (camera.photo_from_pixel([o.u, o.v]), [x0, y0])
        } else {
            ([o.u, -o.v], [x0, -y0])
        };
        let pitch = camera.residual_pitch();
        let d = [at[0] - centre[0], at[1] - centre[1]];
        let r = d[0].hypot(d[1]);
        if !(r > 0.0) {
            continue;
        }
        let [fx, fy] = context.residual_factors(&o.photo);
        // Pixels count v downwards.
        let vy = if model.in_photo_units { vy } else { -vy };
        let along = (vx * fx * d[0] + vy * fy * d[1]) / r;
        all.push([r / pitch[0], along]);
    }
    if all.len() < 20 {
        return Vec::new();
    }
    let largest = all.iter().map(|p| p[0]).fold(0.0, f64::max);
    let mut sums = [(0.0, 0.0, 0.0); CLASSES];
    for [r, v] in &all {
        let class = ((r / largest * CLASSES as f64) as usize).min(CLASSES - 1);
        sums[class] = (sums[class].0 + 1.0, sums[class].1 + v, sums[class].2 + v * v);
    }
    // A class tells of a pattern where its mean is beyond what its scatter allows.
    let means: Vec<(f64, f64, f64)> = sums
        .iter()
        .enumerate()
        .filter(|(_, (n, ..))| *n >= 5.0)
        .map(|(k, (n, sum, squares))| {
            let mean = sum / n;
            let sigma = ((squares / n - mean * mean).max(0.0) / n).sqrt();
            ((k as f64 + 0.5) / CLASSES as f64 * largest, mean, sigma)
        })
        .collect();
    let beyond = means.iter().filter(|(_, mean, sigma)| mean.abs() > 3.0 * sigma).count();
    let worst = means.iter().map(|m| m.1.abs()).fold(0.0, f64::max);
    let title = words.plot_radius();
    let worst = fixed(worst, 3);
    let sentence = if beyond == 0 {
        words.plot_radius_clean(&worst, &unit)
    } else {
        words.plot_radius_says(&beyond, &worst, &unit)
    };
    let every = every_nth(all.len(), MARKS);
    let sentence = drawn_sentence(sentence, every, context);
    let dots: Vec<[f64; 2]> = all.iter().step_by(every).copied().collect();
    let reach = dots.iter().map(|d| d[1].abs()).fold(0.0, f64::max);
    let y = Axis::of(-1.05 * reach, 1.05 * reach.max(1e-9), &format!("v(r) {unit}"));
    let mut chart = Chart::new(title, &sentence, Axis::of(0.0, largest, "r px"), y);
    chart.dots("dot-a", &dots, 2.0);
    let line: Vec<[f64; 2]> = means.iter().map(|m| [m.0, m.1]).collect();
    chart.line("line-b", &line);
    chart.dots("dot-b", &line, 5.0);
    let plot = Plot {
        name: "residuals-radius".into(),
        group: Group::Residuals,
        small: false,
        title: title.into(),
        sentence,
        svg: chart.finish(),
    };
    vec![plot]
}
