//! Lengths in a wrong unit.
//!
//! Control coordinates, distances, target diameters and the principal distance each give the network a size. Two of them that differ by the
//! ratio of two units of length were given in two units: a gross error of a thousand to one, which weights would spread over everything.

use std::collections::{HashMap, HashSet};

use nalgebra::Vector3;

use super::seen::{Shot, distance_px, longer_side, shots};
use crate::adjustment::{UnitOf, UnitRatio};
use crate::initial::Pose;
use crate::initial::robust::quantile;
use crate::project::{Project, Role};

/// Units of length in millimetres: millimetre, centimetre, metre, inch, foot.
const UNITS: [f64; 5] = [1.0, 10.0, 1000.0, 25.4, 304.8];
/// Part of a ratio by which measured lengths may miss it. Coordinates of an orientation are good to that; 10 and 12 are 20 % apart.
const MEASURED: f64 = 0.04;
/// The same where a principal distance is compared that an orientation has found.
const FOUND: f64 = 0.08;
/// Part by which distances of the same unit may differ before the adjustment.
const SAME: f64 = 0.05;
/// Principal distance over the distance of the object beyond which a picture is no ordinary close-up: half of life size.
const MAGNIFIED: f64 = 0.5;
/// Images of targets, pixels and shares of the longer side, between which a diameter is possible, and those that are usual.
const POSSIBLE_PX: f64 = 0.3;
const POSSIBLE_SHARE: f64 = 0.25;
const USUAL_PX: [f64; 2] = [2.0, 300.0];
/// Ratios of units tried for diameters, likeliest first.
const TRIED: [f64; 5] = [1000.0, 10.0, 100.0, 25.4, 304.8];

/// The ratio of two different units that a ratio is near to.
pub fn nearest(ratio: f64, tolerance: f64) -> Option<f64> {
    let all = UNITS.iter().flat_map(|a| UNITS.iter().map(move |b| a / b));
    let off = |of: &f64| (ratio / of).ln().abs();
    let best = all.filter(|of| (of - 1.0).abs() > 1e-9).min_by(|a, b| off(a).total_cmp(&off(b)))?;
    (off(&best) <= tolerance).then_some(best)
}

/// A distance beside its length in the document's coordinates.
struct Bar<'a> {
    ends: (&'a str, &'a str),
    /// Given over that length.
    ratio: f64,
}

/// What the document's coordinates, distances and diameters say of each other's unit. Coordinates of tie points are those of an
/// orientation: in the system of the control points where there are such, else of the size that the distances give.
pub fn of_lengths(project: &Project) -> Vec<UnitRatio> {
    let shots = shots(project);
    let seen: HashSet<usize> = shots.iter().flat_map(|shot| shot.marks.iter().map(|mark| mark.point)).collect();
    let at: HashMap<&str, Vector3<f64>> = project
        .points
        .iter()
        .enumerate()
        .filter(|(k, _)| seen.contains(k))
        .filter_map(|(_, p)| Some((p.id.as_str(), p.xyz?.into())))
        .collect();
    let bar = |d: &'_ crate::project::Distance| -> Option<f64> {
        let length = (at.get(d.from.as_str())? - at.get(d.to.as_str())?).norm();
        Some(d.length / length).filter(|ratio| ratio.is_finite() && *ratio > 0.0)
    };
    let bars: Vec<Bar> = project
        .distances
        .iter()
        .filter_map(|d| Some(Bar { ends: (d.from.as_str(), d.to.as_str()), ratio: bar(d)? }))
        .collect();
    let control = project.points.iter().enumerate();
    let control = control.filter(|(k, p)| p.role == Role::Control && p.xyz.is_some() && seen.contains(k)).count() >= 2;
    let mut found = against(project, &shots, &bars, control);
    if found.is_empty() && (control || !bars.is_empty()) {
        let of = if control { UnitOf::Control } else { UnitOf::Distance };
        found.extend(by_diameters(project, &shots, of));
    }
    found
}

/// Distances against the control points, or against each other.
fn against(project: &Project, shots: &[Shot], bars: &[Bar], control: bool) -> Vec<UnitRatio> {
    let mut of_ratio: Vec<(f64, Vec<&Bar>)> = Vec::new();
    for bar in bars {
        match of_ratio.iter_mut().find(|(ratio, _)| (bar.ratio / *ratio).ln().abs() <= SAME) {
            Some((_, all)) => all.push(bar),
            None => of_ratio.push((bar.ratio, vec![bar])),
        }
    }
    let named = |bars: &[&Bar]| bars.iter().map(|b| (b.ends.0.to_owned(), b.ends.1.to_owned())).collect();
    let told = |of: UnitOf, ratio: f64, bars: &[&Bar]| {
        let nearest = nearest(ratio, MEASURED)?;
        Some(UnitRatio { of, ratio, nearest, distances: named(bars), camera: None })
    };
    if control {
        // With all distances against it, the coordinates may be what is wrong: the size of the object that the lens implies tells.
        let apart = of_ratio.iter().filter(|(ratio, _)| ratio.ln().abs() > SAME);
        let together = of_ratio.len() == 1;
        return apart
            .filter_map(|(ratio, bars)| {
                let by_control = together && !is_possible(project, shots, 1.0) && is_possible(project, shots, *ratio);
                if by_control { told(UnitOf::Control, 1.0 / ratio, bars) } else { told(UnitOf::Distance, *ratio, bars) }
            })
            .collect();
    }
    // The size that most distances agree on, that which the lens allows where as many agree on another.
    let rank = |(ratio, bars): &(f64, Vec<&Bar>)| (bars.len(), is_possible(project, shots, *ratio));
    let Some(most) = of_ratio.iter().map(rank).max() else { return Vec::new() };
    let (usual, _) = of_ratio.iter().find(|group| rank(group) == most).unwrap_or(&of_ratio[0]);
    let others = of_ratio.iter().filter(|(ratio, _)| (ratio / usual).ln().abs() > SAME);
    others.filter_map(|(ratio, bars)| told(UnitOf::Distance, ratio / usual, bars)).collect()
}

/// Distances of the cameras from what they show in the document's coordinates, with the lens of each.
fn depths(project: &Project, shots: &[Shot]) -> Vec<(usize, f64)> {
    let posed = shots.iter().enumerate().filter_map(|(k, s)| Some((k, s, Pose::of_photo(&project.photos[s.photo])?)));
    posed
        .filter_map(|(k, shot, pose)| {
            let points = shot.marks.iter().filter_map(|mark| project.points[mark.point].xyz);
            let lengths: Vec<f64> = points.map(|xyz| (Vector3::from(xyz) - pose.centre).norm()).collect();
            let depth = quantile(&lengths, 0.5);
            (depth > 0.0 && depth.is_finite()).then_some((k, depth))
        })
        .collect()
}

/// Whether a network of `factor` times the document's size can be photographed with its lenses, as far as units and pixel pitch tell: no
/// object is nearer than twice the principal distance, and images of targets have an ordinary size.
fn is_possible(project: &Project, shots: &[Shot], factor: f64) -> bool {
    let millimetres = match project.unit.trim() {
        "mm" => Some(1.0),
        "cm" => Some(10.0),
        "m" => Some(1000.0),
        "km" => Some(1e6),
        "in" => Some(25.4),
        "ft" => Some(304.8),
        _ => None,
    };
    let depths = depths(project, shots);
    let near = depths.iter().filter(|(k, depth)| {
        let lens = &shots[*k].lens;
        let model = lens.interior.model();
        let c = lens.pixel_pitch.and_then(|[pitch, _]| match model.in_photo_units {
            true => lens.interior.get(model.distance),
            false => distance_px(lens).map(|px| px * pitch),
        });
        c.zip(millimetres).is_some_and(|(c, unit)| c > MAGNIFIED * depth * unit * factor)
    });
    2 * near.count() <= depths.len() && images(project, shots, factor).is_none_or(|(px, side)| is_image(px, side))
}

fn is_image(px: f64, side: f64) -> bool {
    px >= POSSIBLE_PX && px <= POSSIBLE_SHARE * side
}

/// Median diameter of the images of targets with a diameter, in a network of `factor` times the document's size, pixels, and the longer side.
fn images(project: &Project, shots: &[Shot], factor: f64) -> Option<(f64, f64)> {
    let depths = depths(project, shots);
    let of_shots = depths.iter().flat_map(|(k, depth)| {
        let shot = &shots[*k];
        let px = distance_px(&shot.lens);
        let diameters = shot.marks.iter().filter_map(|mark| project.points[mark.point].diameter);
        diameters.filter_map(move |d| Some(d * px? / (depth * factor)))
    });
    let all: Vec<f64> = of_shots.filter(|px| px.is_finite() && *px > 0.0).collect();
    let side = shots.iter().map(|shot| longer_side(&shot.lens)).fold(0.0, f64::max);
    (!all.is_empty()).then(|| (quantile(&all, 0.5), side))
}

/// Diameters of targets against the size of the network: their images would be points, or wider than the photo.
fn by_diameters(project: &Project, shots: &[Shot], of: UnitOf) -> Option<UnitRatio> {
    let (px, side) = images(project, shots, 1.0)?;
    if is_image(px, side) {
        return None;
    }
    // Too large images: the network is too small.
    let power = if px > 1.0 { 1.0 } else { -1.0 };
    let usual = |ratio: &f64| (USUAL_PX[0]..=USUAL_PX[1]).contains(&(px * ratio));
    let ratio = TRIED.map(|ratio: f64| ratio.powf(-power)).into_iter().find(usual)?;
    Some(UnitRatio { of, ratio, nearest: ratio, distances: Vec::new(), camera: None })
}

/// A camera's principal distance in millimetres against the one that the photos imply.
pub fn of_camera(camera: &str, given: f64, found: f64) -> Option<UnitRatio> {
    let ratio = given / found;
    let nearest = nearest(ratio, FOUND).filter(|of| *of > 5.0 || *of < 0.2)?;
    Some(UnitRatio { of: UnitOf::Camera, ratio, nearest, distances: Vec::new(), camera: Some(camera.to_owned()) })
}

#[cfg(test)]
mod tests;
