//! Two models that share too few determined points are joined over pairs of photos, one of each, that show the same points.
//!
//! The relative orientation of such a pair gives the rotation between the models and the direction from one projection
//! centre to the other. The length t of that base and the scale s of the model stay open. With X = C + t·b + s·d, where C is
//! the block's projection centre, b the direction of the base and d the turned vector from the other projection centre, every
//! determined point that the other model's photos show gives two equations that are linear in t and s.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::block::Block;
use super::neighbour::{FEWEST_COMMON, relative};
use crate::initial::similarity::Similarity;

/// Pairs of photos that are tried, those with most common points first, and pairs of measurements for each.
const MOST_PAIRS: usize = 8;
const MOST_SAMPLES: usize = 400;
/// Tolerances of a measurement within which it agrees: points at the edge of a model are its least certain ones.
const WIDE: f64 = 6.0;
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

/// The similarity from the model to the block that common points of a pair of photos bear out, if there is one.
pub(super) fn similarity(block: &Block, model: &Block) -> Option<Similarity> {
    let own = |one: &Block, other: &Block| -> Vec<usize> {
        (0..one.views.len()).filter(|&k| one.views[k].pose.is_some() && other.views[k].pose.is_none()).collect()
    };
    let (firsts, seconds) = (own(block, model), own(model, block));
    let mut pairs: Vec<(usize, usize, usize)> = Vec::new();
    for &a in &firsts {
        pairs.extend(seconds.iter().map(|&b| (block.common(a, b).len(), a, b)));
    }
    pairs.retain(|(count, ..)| *count >= FEWEST_COMMON);
    pairs.sort_by_key(|&(count, a, b)| (std::cmp::Reverse(count), a, b));
    let mut best: Option<(usize, Similarity)> = None;
    for (_, a, b) in pairs.into_iter().take(MOST_PAIRS) {
        let (Some(first), Some(second)) = (block.views[a].pose, model.views[b].pose) else { continue };
        for found in relative(block, model, a, b) {
            let attitude = found.pose.object_to_camera * first.object_to_camera;
            let rotation = attitude.tr_mul(&second.object_to_camera);
            let direction = first.object_to_camera.tr_mul(&found.pose.centre);
            let sightings = sightings(block, model, (first.centre, direction), (second.centre, rotation));
            let inliers = found.inliers.iter().filter(|i| **i).count();
            let Some((ts, agreeing)) = solved(&sightings) else { continue };
            // Two of every point's equations, less what the pair itself has used up.
            let evidence = inliers + agreeing;
            let enough = evidence >= 5 + 2 + SPARE && agreeing as f64 >= AGREEING * sightings.len() as f64;
            if enough && best.as_ref().is_none_or(|(most, _)| evidence > *most) {
                let target_centroid = first.centre + direction * ts.x;
                best = Some((
                    evidence,
                    Similarity { scale: ts.y, rotation, source_centroid: second.centre, target_centroid },
                ));
            }
        }
    }
    best.map(|(_, similarity)| similarity)
}

/// Determined points of either model in photos of the other.
fn sightings(
    block: &Block,
    model: &Block,
    (centre, direction): (Vector3<f64>, Vector3<f64>),
    (origin, rotation): (Vector3<f64>, Matrix3<f64>),
) -> Vec<Sighting> {
    let mut all = Vec::new();
    for (own, other) in block.marks.iter().zip(&model.marks) {
        for &s in &own.sights {
            let photo = block.sights[s].photo;
            // What both models have in common agrees in each by itself.
            match (block.views[photo].pose, model.views[photo].pose) {
                (Some(pose), None) => {
                    let (Some(xyz), Some(image)) = (other.xyz, block.sights[s].ray) else { continue };
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
                    let (Some(xyz), Some(image)) = (own.xyz, model.sights[s].ray) else { continue };
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

/// Base and scale that most sightings agree with, and how many do.
fn solved(sightings: &[Sighting]) -> Option<(Vector2<f64>, usize)> {
    let n = sightings.len();
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| [i, j]));
    let step = (n * n.saturating_sub(1) / 2).div_ceil(MOST_SAMPLES).max(1);
    let agreeing = |ts: &Vector2<f64>| -> Vec<usize> { (0..n).filter(|&k| sightings[k].misfit(ts) <= WIDE).collect() };
    let mut best: Option<(Vector2<f64>, Vec<usize>)> = None;
    for pair in pairs.step_by(step) {
        let Some(ts) = fitted(sightings, &pair) else { continue };
        let mut set = agreeing(&ts);
        let mut ts = ts;
        if best.as_ref().is_none_or(|(_, most)| set.len() > most.len()) {
            if let Some(again) = fitted(sightings, &set) {
                let next = agreeing(&again);
                if next.len() >= set.len() {
                    (ts, set) = (again, next);
                }
            }
            best = Some((ts, set));
        }
    }
    best.map(|(ts, set)| (ts, set.len()))
}

/// Least squares of the equations of some sightings; none where they do not determine both, or not as positive numbers.
fn fitted(sightings: &[Sighting], some: &[usize]) -> Option<Vector2<f64>> {
    let (mut normal, mut right) = (Matrix2::zeros(), Vector2::zeros());
    for (row, constant) in some.iter().flat_map(|&k| sightings[k].rows()) {
        normal += row * row.transpose();
        right -= row * constant;
    }
    let ts = normal.cholesky()?.solve(&right);
    ts.iter().all(|x| x.is_finite() && *x > 0.0).then_some(ts)
}
