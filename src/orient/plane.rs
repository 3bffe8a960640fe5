//! Starts for objects that are nearly flat where no two photos share enough points to be oriented to each other.
//!
//! If the points lie in a plane, one photo determines all it shows: every ray meets the plane. A plane of trial normal is laid
//! before one photo; another that shows some of these points is oriented by resection and lays its own in turn, until the photos
//! hang together that had hardly a pair in common. The normals under which most measurements agree best are kept; an adjustment
//! in space makes the relief of them.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::block::OrientationBlock;
use super::growth::{FEWEST, resect};
use super::refine::{Freedom, refine};
use super::seed::{NetworkQuality, without_poses};
use crate::initial::Pose;
use crate::initial::robust::quantile;

/// Photos that a plane is laid before, those first that share most with others beyond what a resection takes up.
const MOST_BASES: usize = 3;
/// Rings of trial normals, 15° apart: a true normal is at most some 8° from one of them.
const RING: f64 = TAU / 24.0;
const RINGS: usize = 4;
/// Photos by which a normal is judged, and normals that are followed to the end.
const JUDGED: usize = 8;
const MOST_FOLLOWED: usize = 4;
/// Noise, as a multiple of the limit for an accepted network, of what the adjustment in space has made of a true start: seven of them
/// came to at most 6, false ones to 30 and more.
const ADJUSTED: f64 = 10.0;
/// Rounds in which points and poses take turns.
const ROUNDS: usize = 3;

/// A plane in front of a photo: all points X with n·(X - F) = 0, where F lies one unit before the projection centre.
#[derive(Clone, Copy)]
struct ScenePlane {
    normal: Vector3<f64>,
}

impl ScenePlane {
    const FOOT: Vector3<f64> = Vector3::new(0.0, 0.0, -1.0);

    /// Where a ray meets it; `None` if it does so behind the camera or far away.
    fn meets(&self, pose: &Pose, image: [f64; 2]) -> Option<Vector3<f64>> {
        let direction = pose.object_to_camera.tr_mul(&Vector3::new(image[0], image[1], -1.0));
        let along = self.normal.dot(&(Self::FOOT - pose.centre)) / self.normal.dot(&direction);
        (along > 0.05 && along < 20.0).then(|| pose.centre + direction * along)
    }
}

/// Models of a block's unused photos that suppose a plane, best first.
pub(super) fn cores(block: &OrientationBlock, used: &[bool], fine_px: f64) -> Vec<OrientationBlock> {
    let mut judged: Vec<(f64, OrientationBlock, ScenePlane)> = Vec::new();
    for base in bases(block, used) {
        for plane in normals().map(|normal| ScenePlane { normal }) {
            let mut model = without_poses(block);
            model.photos[base].pose = Some(Pose::identity());
            spread(&mut model, &plane, JUDGED);
            if model.oriented() > 2 {
                judged.push((evidence(&model, &plane), model, plane));
            }
        }
    }
    judged.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut cores: Vec<(f64, OrientationBlock)> = Vec::new();
    for (_, mut model, plane) in judged.into_iter().take(MOST_FOLLOWED) {
        spread(&mut model, &plane, usize::MAX);
        level(&mut model, &plane);
        single_rays_out(&mut model);
        model.review();
        refine(&mut model, Freedom::Distance);
        if model.noise_px.is_some_and(|noise| noise <= ADJUSTED * fine_px) {
            let quality = NetworkQuality::of(&model);
            let certain = quality.is_evident(&model, fine_px);
            cores.push((quality.evidence, model));
            // The others cost as many adjustments of all photos, and at best they come to the same network.
            if certain {
                break;
            }
        }
    }
    cores.sort_by(|a, b| b.0.total_cmp(&a.0));
    cores.into_iter().map(|(_, model)| model).collect()
}

/// Unused photos by the points they share with others beyond three each.
fn bases(block: &OrientationBlock, used: &[bool]) -> Vec<usize> {
    let free: Vec<usize> = (0..block.photos.len()).filter(|&k| !used[k]).collect();
    let shared = |a: usize| -> usize {
        free.iter().filter(|&&b| b != a).map(|&b| block.common(a, b).len().saturating_sub(FEWEST - 1)).sum()
    };
    let mut counted: Vec<(usize, usize)> = free.iter().map(|&k| (shared(k), k)).filter(|(n, _)| *n > 0).collect();
    counted.sort_by_key(|&(n, k)| (std::cmp::Reverse(n), k));
    counted.into_iter().take(MOST_BASES).map(|(_, k)| k).collect()
}

/// Trial normals in the camera frame of the photo that the plane is laid before: towards it, in rings around its axis.
fn normals() -> impl Iterator<Item = Vector3<f64>> {
    (0..RINGS).flat_map(|ring| {
        let (tilt, around) = (RING * ring as f64, (6 * ring).max(1));
        (0..around).map(move |k| {
            let azimuth = TAU * k as f64 / around as f64;
            Vector3::new(tilt.sin() * azimuth.cos(), tilt.sin() * azimuth.sin(), tilt.cos())
        })
    })
}

/// Lays the points of oriented photos on the plane and orients photos by them, in turns, until `most` are oriented.
fn spread(model: &mut OrientationBlock, plane: &ScenePlane, most: usize) {
    let mut tried = vec![0; model.photos.len()];
    lay(model, plane);
    while model.oriented() < most {
        let left = (0..tried.len()).filter(|&k| model.photos[k].pose.is_none());
        let counted = left.map(|k| (model.determined(k).0.len(), k)).filter(|&(n, k)| n > FEWEST && n > tried[k]);
        let Some((count, photo)) = counted.max_by_key(|&(n, k)| (n, std::cmp::Reverse(k))) else { break };
        if resect(model, photo) {
            lay(model, plane);
        } else {
            tried[photo] = count;
        }
    }
}

/// Gives every point the middle of the places where its rays meet the plane.
fn lay(model: &mut OrientationBlock, plane: &ScenePlane) {
    for point in 0..model.points.len() {
        let (_, rays) = model.rays(point);
        let places: Vec<Vector3<f64>> = rays.iter().filter_map(|ray| plane.meets(&ray.pose, ray.image)).collect();
        let middle = |k: usize| quantile(&places.iter().map(|p| p[k]).collect::<Vec<_>>(), 0.5);
        model.points[point].xyz = (!places.is_empty()).then(|| Vector3::new(middle(0), middle(1), middle(2)));
    }
}

/// Points and poses take turns in fitting each other.
fn level(model: &mut OrientationBlock, plane: &ScenePlane) {
    for _ in 0..ROUNDS {
        for photo in 0..model.photos.len() {
            let Some(pose) = model.photos[photo].pose else { continue };
            let (_, object, image) = model.determined(photo);
            let limit = 3.0 * model.tolerance_px(photo) / model.pixels_per_unit(photo);
            let near = object.iter().zip(&image).filter(|(xyz, m)| pose.misfit(xyz, **m) <= limit);
            let (object, image): (Vec<_>, Vec<_>) = near.map(|(xyz, m)| (*xyz, *m)).unzip();
            if object.len() > FEWEST {
                model.photos[photo].pose = pose.refined(&object, &image).or(Some(pose));
            }
        }
        lay(model, plane);
    }
}

/// Points of one ray lie on it and tell nothing.
fn single_rays_out(model: &mut OrientationBlock) {
    for point in 0..model.points.len() {
        if model.rays(point).0.len() < 2 {
            model.points[point].xyz = None;
        }
    }
}

/// Measure of the agreement of a plane model.
fn evidence(model: &OrientationBlock, plane: &ScenePlane) -> f64 {
    let mut model = model.clone();
    level(&mut model, plane);
    single_rays_out(&mut model);
    model.review();
    NetworkQuality::of(&model).evidence
}
