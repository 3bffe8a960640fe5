//! Detects lengths given in a wrong unit.
//!
//! Control coordinates, distances, target diameters and the principal distance each determine the scale of the network. If two of them
//! differ by the ratio of two units of length, they were probably given in different units. An adjustment would spread such a gross
//! error (for example a factor of 1000) over all observations.

use std::collections::{HashMap, HashSet};

use nalgebra::Vector3;

use super::seen::{PhotoMeasurements, distance_px, longer_side, measured_photos};
use crate::adjustment::{UnitOf, UnitRatio};
use crate::initial::Pose;
use crate::initial::robust::quantile;
use crate::project::{Project, Role};

/// Units of length in millimetres: millimetre, centimetre, metre, inch, foot.
const UNITS: [f64; 5] = [1.0, 10.0, 1000.0, 25.4, 304.8];
/// Tolerance |ln(ratio / ratio of units)| for measured lengths: coordinates of an orientation are accurate to 4 %, and the closest
/// ratios, 10 and 12, differ by 20 %.
const MEASURED: f64 = 0.04;
/// The same tolerance for a principal distance estimated by an orientation.
const FOUND: f64 = 0.08;
/// Relative difference that distances in the same unit may have before the adjustment.
const SAME: f64 = 0.05;
/// Maximum image scale (principal distance over object distance) of an ordinary close-up: half of life size.
const MAGNIFIED: f64 = 0.5;
/// Smallest possible diameter of a target's image, pixels.
const POSSIBLE_PX: f64 = 0.3;
/// Largest possible diameter, as a share of the photo's longer side.
const POSSIBLE_SHARE: f64 = 0.25;
/// Smallest and largest usual diameter, pixels.
const USUAL_PX: [f64; 2] = [2.0, 300.0];
/// Ratios of units tried for diameters, the most probable first.
const TRIED: [f64; 5] = [1000.0, 10.0, 100.0, 25.4, 304.8];

/// The ratio of two different units nearest to `ratio`; `None` if it is off by more than `tolerance` (difference of logarithms).
pub fn nearest(ratio: f64, tolerance: f64) -> Option<f64> {
    let all = UNITS.iter().flat_map(|a| UNITS.iter().map(move |b| a / b));
    let off = |of: &f64| (ratio / of).ln().abs();
    let best = all.filter(|of| (of - 1.0).abs() > 1e-9).min_by(|a, b| off(a).total_cmp(&off(b)))?;
    (off(&best) <= tolerance).then_some(best)
}

/// A given distance compared with the document's coordinates.
struct ComparedDistance<'a> {
    ends: (&'a str, &'a str),
    /// Given length over the length computed from the coordinates.
    ratio: f64,
}

/// Unit errors among the document's coordinates, distances and diameters. The coordinates of tie points come from an orientation: they
/// are in the system of the control points if there are any, else scaled by the distances.
pub fn of_lengths(project: &Project) -> Vec<UnitRatio> {
    let photos = measured_photos(project);
    let seen: HashSet<usize> =
        photos.iter().flat_map(|photo| photo.measurements.iter().map(|measurement| measurement.point)).collect();
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
    let bars: Vec<ComparedDistance> = project
        .distances
        .iter()
        .filter_map(|d| Some(ComparedDistance { ends: (d.from.as_str(), d.to.as_str()), ratio: bar(d)? }))
        .collect();
    let control = project.points.iter().enumerate();
    let control = control.filter(|(k, p)| p.role == Role::Control && p.xyz.is_some() && seen.contains(k)).count() >= 2;
    let mut found = compare_distances(project, &photos, &bars, control);
    if found.is_empty() && (control || !bars.is_empty()) {
        let of = if control { UnitOf::Control } else { UnitOf::Distance };
        found.extend(by_diameters(project, &photos, of));
    }
    found
}

/// Compares the distances with the control points, or with each other if there are none.
fn compare_distances(
    project: &Project,
    photos: &[PhotoMeasurements],
    bars: &[ComparedDistance],
    control: bool,
) -> Vec<UnitRatio> {
    let mut of_ratio: Vec<(f64, Vec<&ComparedDistance>)> = Vec::new();
    for bar in bars {
        match of_ratio.iter_mut().find(|(ratio, _)| (bar.ratio / *ratio).ln().abs() <= SAME) {
            Some((_, all)) => all.push(bar),
            None => of_ratio.push((bar.ratio, vec![bar])),
        }
    }
    let named = |bars: &[&ComparedDistance]| bars.iter().map(|b| (b.ends.0.to_owned(), b.ends.1.to_owned())).collect();
    let unit_error = |of: UnitOf, ratio: f64, bars: &[&ComparedDistance]| {
        let nearest = nearest(ratio, MEASURED)?;
        Some(UnitRatio { of, ratio, nearest, distances: named(bars), camera: None })
    };
    if control {
        // If all distances contradict the coordinates by the same ratio, the coordinates may be wrong instead: the object size that the
        // principal distance implies decides.
        let apart = of_ratio.iter().filter(|(ratio, _)| ratio.ln().abs() > SAME);
        let together = of_ratio.len() == 1;
        return apart
            .filter_map(|(ratio, bars)| {
                let by_control = together && !is_possible(project, photos, 1.0) && is_possible(project, photos, *ratio);
                if by_control {
                    unit_error(UnitOf::Control, 1.0 / ratio, bars)
                } else {
                    unit_error(UnitOf::Distance, *ratio, bars)
                }
            })
            .collect();
    }
    // The scale with which most distances agree; among equally many, the one that the lens allows.
    let rank = |(ratio, bars): &(f64, Vec<&ComparedDistance>)| (bars.len(), is_possible(project, photos, *ratio));
    let Some(most) = of_ratio.iter().map(rank).max() else { return Vec::new() };
    let (usual, _) = of_ratio.iter().find(|group| rank(group) == most).unwrap_or(&of_ratio[0]);
    let others = of_ratio.iter().filter(|(ratio, _)| (ratio / usual).ln().abs() > SAME);
    others.filter_map(|(ratio, bars)| unit_error(UnitOf::Distance, ratio / usual, bars)).collect()
}

/// Per oriented photo: its index in `photos` and the median distance of its points from the projection centre, in the document's unit.
fn depths(project: &Project, photos: &[PhotoMeasurements]) -> Vec<(usize, f64)> {
    let posed = photos.iter().enumerate().filter_map(|(k, s)| Some((k, s, Pose::of_photo(&project.photos[s.photo])?)));
    posed
        .filter_map(|(k, photo, pose)| {
            let points = photo.measurements.iter().filter_map(|measurement| project.points[measurement.point].xyz);
            let lengths: Vec<f64> = points.map(|xyz| (Vector3::from(xyz) - pose.centre).norm()).collect();
            let depth = quantile(&lengths, 0.5);
            (depth > 0.0 && depth.is_finite()).then_some((k, depth))
        })
        .collect()
}

/// Whether the network, scaled by `factor`, can be photographed with its lenses: for at least half of the photos the object distance is
/// at least twice the principal distance, and the images of targets have a possible size. Without unit or pixel pitch the first condition
/// is not tested.
fn is_possible(project: &Project, photos: &[PhotoMeasurements], factor: f64) -> bool {
    let millimetres = match project.unit.trim() {
        "mm" => Some(1.0),
        "cm" => Some(10.0),
        "m" => Some(1000.0),
        "km" => Some(1e6),
        "in" => Some(25.4),
        "ft" => Some(304.8),
        _ => None,
    };
    let depths = depths(project, photos);
    let near = depths.iter().filter(|(k, depth)| {
        let lens = &photos[*k].lens;
        let model = lens.interior.model();
        let c = lens.pixel_pitch.and_then(|[pitch, _]| match model.in_photo_units {
            true => lens.interior.get(model.distance),
            false => distance_px(lens).map(|px| px * pitch),
        });
        c.zip(millimetres).is_some_and(|(c, unit)| c > MAGNIFIED * depth * unit * factor)
    });
    2 * near.count() <= depths.len() && images(project, photos, factor).is_none_or(|(px, side)| is_image(px, side))
}

/// Whether a diameter of a target's image is possible.
fn is_image(px: f64, side: f64) -> bool {
    px >= POSSIBLE_PX && px <= POSSIBLE_SHARE * side
}

/// Median diameter in pixels of the images of targets with a given diameter, in the network scaled by `factor`, and the longer side of
/// the largest photo; `None` without such targets.
fn images(project: &Project, photos: &[PhotoMeasurements], factor: f64) -> Option<(f64, f64)> {
    let depths = depths(project, photos);
    let of_photos = depths.iter().flat_map(|(k, depth)| {
        let photo = &photos[*k];
        let px = distance_px(&photo.lens);
        let diameters = photo.measurements.iter().filter_map(|measurement| project.points[measurement.point].diameter);
        diameters.filter_map(move |d| Some(d * px? / (depth * factor)))
    });
    let all: Vec<f64> = of_photos.filter(|px| px.is_finite() && *px > 0.0).collect();
    let side = photos.iter().map(|photo| longer_side(&photo.lens)).fold(0.0, f64::max);
    (!all.is_empty()).then(|| (quantile(&all, 0.5), side))
}

/// Compares the diameters of targets with the scale of the network: a wrong unit makes their images impossibly small or large.
fn by_diameters(project: &Project, photos: &[PhotoMeasurements], of: UnitOf) -> Option<UnitRatio> {
    let (px, side) = images(project, photos, 1.0)?;
    if is_image(px, side) {
        return None;
    }
    // Too large images mean that the network is too small.
    let power = if px > 1.0 { 1.0 } else { -1.0 };
    let usual = |ratio: &f64| (USUAL_PX[0]..=USUAL_PX[1]).contains(&(px * ratio));
    let ratio = TRIED.map(|ratio: f64| ratio.powf(-power)).into_iter().find(usual)?;
    Some(UnitRatio { of, ratio, nearest: ratio, distances: Vec::new(), camera: None })
}

/// Compares a camera's given principal distance with the one estimated from the photos, both in millimetres.
pub fn of_camera(camera: &str, given: f64, found: f64) -> Option<UnitRatio> {
    let ratio = given / found;
    let nearest = nearest(ratio, FOUND).filter(|of| *of > 5.0 || *of < 0.2)?;
    Some(UnitRatio { of: UnitOf::Camera, ratio, nearest, distances: Vec::new(), camera: Some(camera.to_owned()) })
}

#[cfg(test)]
mod tests;
