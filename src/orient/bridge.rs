//! Two models that share too few determined points are joined over pairs of photos, one of each, that show the same points.
//!
//! The relative orientation of such a pair gives the rotation between the models and the direction from one projection
//! centre to the other. The length t of that base and the scale s of the model stay open. With X = C + t·b + s·d, where C is
//! the block's projection centre, b the direction of the base and d the turned vector from the other projection centre, every
//! determined point that the other model's photos show gives two equations that are linear in t and s. Where no pair shows
//! enough, three determined points of one in a photo of the other give its pose (up to four of them), and s alone stays open.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::block::OrientationBlock;
use super::neighbour::{FEWEST_COMMON, relative};
use crate::initial::Pose;
use crate::initial::p3p::p3p;
use crate::initial::similarity::Similarity;

/// Pairs of photos that are tried, those with most common points first, and pairs of measurements for each.
const MOST_PAIRS: usize = 8;
const MOST_SAMPLES: usize = 400;
/// Triples of points of one photo, those that span the most of it first.
const MOST_TRIPLES: usize = 20;
/// Tolerances of a measurement within which it agrees: points at the edge of a model are its least certain ones, and the
/// models' cameras differ.
const WIDE: f64 = 20.0;
/// Equations beyond the unknowns that must agree, and the share of all: each agrees by chance in about one of a hundred cases.
const SPARE: usize = 4;
const AGREEING: f64 = 0.6;

/// p(t, s) = at + t·by_base + s·by_scale, in a camera frame, with where it was measured and what turns residuals into tolerances.
struct Sighting {
    at: Vector3<f64>,
    by_base: Vector3<f64>,
    by_scale: Vector3<f64>,
    image: [f64; 2],
    per_tolerance: f64,
}

impl Sighting {
    /// Rows of the two equations p_x + x·p_z = 0 and p_y + y·p_z = 0: coefficients of t and s, and the constant.
    fn rows(&self) -> [(Vector2<f64>, f64); 2] {
        [0, 1].map(|k| {
            let row = |p: &Vector3<f64>| p[k] + self.image[k] * p.z;
            (Vector2::new(row(&self.by_base), row(&self.by_scale)), row(&self.at))
        })
    }

    /// Distance from where it was measured, in tolerances; infinite behind the camera.
    fn misfit(&self, ts: &Vector2<f64>) -> f64 {
        let p = self.at + self.by_base * ts.x + self.by_scale * ts.y;
        let [x, y] = [-p.x / p.z - self.image[0], -p.y / p.z - self.image[1]];
        if p.z < 0.0 { x.hypot(y) * self.per_tolerance } else { f64::INFINITY }
    }
}

/// The similarity from the model to the block with which the common photos of both agree, if there is one.
pub(super) fn similarity(block: &OrientationBlock, model: &OrientationBlock) -> Option<Similarity> {
    let over_pairs = over_pairs(block, model);
    let over_points = over_points(block, model)
        .into_iter()
        .chain(over_points(model, block).into_iter().map(|(evidence, similarity)| (evidence, inverse(&similarity))));
    over_pairs
        .into_iter()
        .chain(over_points)
        .reduce(|a, b| if b.0 > a.0 { b } else { a })
        .map(|(_, similarity)| similarity)
}

/// Photos that `one` has oriented and `other` has not.
fn own(one: &OrientationBlock, other: &OrientationBlock) -> Vec<usize> {
    (0..one.photos.len()).filter(|&k| one.photos[k].pose.is_some() && other.photos[k].pose.is_none()).collect()
}

/// The best similarity over relative orientations, with its evidence.
fn over_pairs(block: &OrientationBlock, model: &OrientationBlock) -> Option<(usize, Similarity)> {
    let (firsts, seconds) = (own(block, model), own(model, block));
    let mut pairs: Vec<(usize, usize, usize)> = Vec::new();
    for &a in &firsts {
        pairs.extend(seconds.iter().map(|&b| (block.common(a, b).len(), a, b)));
    }
    pairs.retain(|(count, ..)| *count >= FEWEST_COMMON);
    pairs.sort_by_key(|&(count, a, b)| (std::cmp::Reverse(count), a, b));
    let mut best: Option<(usize, Similarity)> = None;
    for (_, a, b) in pairs.into_iter().take(MOST_PAIRS) {
        let (Some(first), Some(second)) = (block.photos[a].pose, model.photos[b].pose) else { continue };
        for found in relative(block, model, a, b) {
            let attitude = found.pose.object_to_camera * first.object_to_camera;
            let rotation = attitude.tr_mul(&second.object_to_camera);
            let direction = first.object_to_camera.tr_mul(&found.pose.centre);
            let sightings = sightings(block, model, (first.centre, direction), (second.centre, rotation));
            let inliers = found.inliers.iter().filter(|i| **i).count();
            let Some((ts, agreeing)) = solved(&sightings, true) else { continue };
            // One of every sighting's equations: the other may be what the pair itself has used up.
            let enough = inliers + agreeing >= 5 + 2 + SPARE && agreeing as f64 >= AGREEING * sightings.len() as f64;
            let evidence = (inliers + agreeing).saturating_sub(5 + 2);
            if enough && best.as_ref().is_none_or(|(most, _)| evidence > *most) {
                let target_centroid = first.centre + direction * ts.x;
                let similarity = Similarity { scale: ts.y, rotation, source_centroid: second.centre, target_centroid };
                best = Some((evidence, similarity));
            }
        }
    }
    best
}

/// The best similarity over three points of the block in a photo of the model, with its evidence.
fn over_points(block: &OrientationBlock, model: &OrientationBlock) -> Option<(usize, Similarity)> {
    let mut best: Option<(usize, Similarity)> = None;
    for b in own(model, block) {
        let Some(second) = model.photos[b].pose else { continue };
        let seen = model.photos[b].observations.iter();
        let seen: Vec<(Vector3<f64>, [f64; 2])> = seen
            .filter_map(|&s| Some((block.points[model.observations[s].point].xyz?, model.observations[s].ray?)))
            .collect();
        for [i, j, k] in wide_triples(&seen) {
            for pose in p3p(&[seen[i].0, seen[j].0, seen[k].0], &[seen[i].1, seen[j].1, seen[k].1]) {
                let Pose { object_to_camera, centre } = pose;
                let rotation = object_to_camera.tr_mul(&second.object_to_camera);
                let sightings = sightings(block, model, (centre, Vector3::zeros()), (second.centre, rotation));
                let Some((ts, agreeing)) = solved(&sightings, false) else { continue };
                let enough = 2 * agreeing >= 6 + 1 + SPARE && agreeing as f64 >= AGREEING * sightings.len() as f64;
                let evidence = (2 * agreeing).saturating_sub(6 + 1);
                if enough && best.as_ref().is_none_or(|(most, _)| evidence > *most) {
                    let similarity =
                        Similarity { scale: ts.y, rotation, source_centroid: second.centre, target_centroid: centre };
                    best = Some((evidence, similarity));
                }
            }
        }
    }
    best
}

/// Triples of image points by the area they span, largest first.
pub(super) fn wide_triples(seen: &[(Vector3<f64>, [f64; 2])]) -> Vec<[usize; 3]> {
    let n = seen.len();
    let area = |[i, j, k]: [usize; 3]| {
        let [a, b, c] = [i, j, k].map(|m| seen[m].1);
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
    };
    let all = (0..n).flat_map(|i| (i + 1..n).flat_map(move |j| (j + 1..n).map(move |k| [i, j, k])));
    let mut triples: Vec<(f64, [usize; 3])> = all.map(|triple| (area(triple), triple)).collect();
    triples.sort_by(|a, b| b.0.total_cmp(&a.0));
    triples.into_iter().take(MOST_TRIPLES).map(|(_, triple)| triple).collect()
}

/// From the target to the source.
fn inverse(similarity: &Similarity) -> Similarity {
    Similarity {
        scale: 1.0 / similarity.scale,
        rotation: similarity.rotation.transpose(),
        source_centroid: similarity.target_centroid,
        target_centroid: similarity.source_centroid,
    }
}

/// Determined points of either model in photos of the other.
fn sightings(
    block: &OrientationBlock,
    model: &OrientationBlock,
    (centre, direction): (Vector3<f64>, Vector3<f64>),
    (origin, rotation): (Vector3<f64>, Matrix3<f64>),
) -> Vec<Sighting> {
    let mut all = Vec::new();
    for (own, other) in block.points.iter().zip(&model.points) {
        for &s in &own.observations {
            let photo = block.observations[s].photo;
            // What both models have in common agrees in each by itself.
            match (block.photos[photo].pose, model.photos[photo].pose) {
                (Some(pose), None) => {
                    let (Some(xyz), Some(image)) = (other.xyz, block.observations[s].ray) else { continue };
                    let m = pose.object_to_camera;
                    all.push(Sighting {
                        at: m * (centre - pose.centre),
                        by_base: m * direction,
                        by_scale: m * (rotation * (xyz - origin)),
                        image,
                        per_tolerance: block.pixels_per_unit(photo) / block.tolerance_px(photo),
                    });
                }
                (None, Some(pose)) => {
                    let (Some(xyz), Some(image)) = (own.xyz, model.observations[s].ray) else { continue };
                    let m = pose.object_to_camera * rotation.transpose();
                    all.push(Sighting {
                        at: m * (xyz - centre),
                        by_base: -(m * direction),
                        by_scale: -(m * (rotation * (pose.centre - origin))),
                        image,
                        per_tolerance: model.pixels_per_unit(photo) / model.tolerance_px(photo),
                    });
                }
                _ => {}
            }
        }
    }
    all
}

/// Base and scale that most sightings agree with, and how many do; the scale alone where there is no base to be found.
fn solved(sightings: &[Sighting], base: bool) -> Option<(Vector2<f64>, usize)> {
    let n = sightings.len();
    let samples: Vec<Vec<usize>> = if base {
        let step = (n * n.saturating_sub(1) / 2).div_ceil(MOST_SAMPLES).max(1);
        (0..n).flat_map(|i| (i + 1..n).map(move |j| vec![i, j])).step_by(step).collect()
    } else {
        (0..n).map(|i| vec![i]).collect()
    };
    let agreeing = |ts: &Vector2<f64>| -> Vec<usize> { (0..n).filter(|&k| sightings[k].misfit(ts) <= WIDE).collect() };
    let mut best: Option<(Vector2<f64>, Vec<usize>)> = None;
    for sample in samples {
        let Some(mut ts) = fitted(sightings, &sample, base) else { continue };
        let mut set = agreeing(&ts);
        if best.as_ref().is_some_and(|(_, most)| set.len() <= most.len()) {
            continue;
        }
        if let Some(again) = fitted(sightings, &set, base) {
            let next = agreeing(&again);
            if next.len() >= set.len() {
                (ts, set) = (again, next);
            }
        }
        best = Some((ts, set));
    }
    best.map(|(ts, set)| (ts, set.len()))
}

/// Least squares of the equations of some sightings; `None` if they do not determine what is asked, or not as positive numbers.
fn fitted(sightings: &[Sighting], some: &[usize], base: bool) -> Option<Vector2<f64>> {
    let (mut tt, mut ts, mut ss, mut t0, mut s0) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (row, constant) in some.iter().flat_map(|&k| sightings[k].rows()) {
        tt += row.x * row.x;
        ts += row.x * row.y;
        ss += row.y * row.y;
        t0 -= row.x * constant;
        s0 -= row.y * constant;
    }
    let sound = |x: f64| x.is_finite() && x > 0.0;
    if !base {
        let scale = s0 / ss;
        return sound(scale).then(|| Vector2::new(0.0, scale));
    }
    let determinant = tt * ss - ts * ts;
    let found = Vector2::new((ss * t0 - ts * s0) / determinant, (tt * s0 - ts * t0) / determinant);
    (determinant > 1e-12 * tt * ss && found.iter().all(|x| sound(*x))).then_some(found)
}
