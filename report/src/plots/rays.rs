//! Number of rays per point, and their intersection angles.

use std::collections::HashMap;

use super::chart::{Axis, Chart};
use super::svg::Anchor;
use super::{Group, Plot};
use crate::context::Context;
use crate::number::{count, fixed};

/// Width of a class of angles, degrees.
const CLASS: f64 = 10.0;

pub fn plots(context: &Context) -> Vec<Plot> {
    let mut plots = Vec::new();
    plots.extend(by_rays(context));
    plots.extend(angles(context));
    plots
}

fn by_rays(context: &Context) -> Option<Plot> {
    let words = context.words;
    let points = &context.adjustment.points;
    let most = points.iter().map(|p| p.rays).max()?;
    let fewest = points.iter().map(|p| p.rays).min()?;
    let mut counts = vec![0_usize; most + 1];
    points.iter().for_each(|p| counts[p.rays] += 1);
    let title = words.plot_rays();
    let two = points.iter().filter(|p| p.rays < 3).count();
    let sentence = words.plot_rays_says(&count(fewest), &count(most), &count(two));
    let top = counts.iter().copied().max().unwrap_or(1) as f64;
    let x = Axis::of(fewest as f64 - 0.7, most as f64 + 0.7, words.rays());
    let mut chart = Chart::new(title, &sentence, x, Axis::of(0.0, 1.12 * top, words.points()));
    for (rays, n) in counts.iter().enumerate().filter(|(_, n)| **n > 0) {
        chart.bar(if rays < 3 { "bar weak" } else { "bar" }, rays as f64, 0.8, *n as f64);
        if most - fewest <= 30 {
            let [x, y] = chart.at([rays as f64, *n as f64]);
            chart.svg.label("strong", [x, y - 4.0], Anchor::Middle, &count(*n));
        }
    }
    Some(Plot {
        name: "rays".into(),
        group: Group::Network,
        small: false,
        title: title.into(),
        sentence,
        svg: chart.finish(),
    })
}

/// The largest angle between two rays of each point, taken as acute: below 5° the depth is undetermined.
fn angles(context: &Context) -> Option<Plot> {
    let words = context.words;
    let a = context.adjustment;
    let centres: HashMap<&str, [f64; 3]> = a.photos.iter().map(|p| (p.id.as_str(), p.position)).collect();
    let mut rays: HashMap<&str, Vec<[f64; 3]>> = HashMap::new();
    for o in a.observations.iter().filter(|o| o.enabled) {
        if let Some(centre) = centres.get(o.photo.as_str()) {
            rays.entry(&o.point).or_default().push(*centre);
        }
    }
    let mut all = Vec::new();
    for point in &a.points {
        let Some(centres) = rays.get(point.id.as_str()).filter(|c| c.len() > 1) else { continue };
        let direction = |c: &[f64; 3]| {
            let d: [f64; 3] = std::array::from_fn(|k| c[k] - point.xyz[k]);
            let length = d[0].hypot(d[1]).hypot(d[2]).max(1e-300);
            d.map(|x| x / length)
        };
        let directions: Vec<[f64; 3]> = centres.iter().map(direction).collect();
        // of the largest acute angle
        let mut cosine = 1.0_f64;
        for (i, p) in directions.iter().enumerate() {
            for q in &directions[..i] {
                cosine = cosine.min((p[0] * q[0] + p[1] * q[1] + p[2] * q[2]).abs());
            }
        }
        all.push(cosine.acos().to_degrees());
    }
    if all.is_empty() {
        return None;
    }
    all.sort_by(f64::total_cmp);
    let mut counts = [0_usize; 9];
    all.iter().for_each(|angle| counts[((angle / CLASS) as usize).min(8)] += 1);
    let title = words.plot_angles();
    let sentence = words.plot_angles_says(&fixed(all[all.len() / 2], 0), &fixed(all[0], 0));
    let top = counts.iter().copied().max().unwrap_or(1) as f64;
    let mut chart = Chart::new(
        title,
        &sentence,
        Axis::of(0.0, 90.0, words.largest_angle()),
        Axis::of(0.0, 1.12 * top, words.points()),
    );
    for (k, n) in counts.iter().enumerate().filter(|(_, n)| **n > 0) {
        let middle = (k as f64 + 0.5) * CLASS;
        chart.bar(if k == 0 { "bar weak" } else { "bar" }, middle, 0.9 * CLASS, *n as f64);
        let [x, y] = chart.at([middle, *n as f64]);
        chart.svg.label("strong", [x, y - 4.0], Anchor::Middle, &count(*n));
    }
    Some(Plot {
        name: "angles".into(),
        group: Group::Network,
        small: false,
        title: title.into(),
        sentence,
        svg: chart.finish(),
    })
}
