//! A photo that sees too few determined points is oriented relative to oriented neighbours.
//!
//! The relative orientation to a neighbour leaves one number open, the length of the base. Every determined point in the
//! photo gives a value of it, and so does the line to a second neighbour; the value that most measurements agree with is
//! taken. Measurements of points that are not determined yet vote by the distance from their epipolar lines. Where no neighbour has
//! enough in common, three determined points give up to four poses, and the same votes decide.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::block::OrientationBlock;
use super::bridge::wide_triples;
use crate::initial::Pose;
use crate::initial::intersection::{Ray, intersect};
use crate::initial::p3p::p3p;
use crate::initial::relative::{Relative, relative_orientation};

/// Minimum number of common points with a neighbour, and neighbours that are tried.
pub(super) const FEWEST_COMMON: usize = 5;
const MOST_NEIGHBOURS: usize = 4;
/// Share of the photo's comparable measurements that has to agree.
const AGREEING: f64 = 0.5;
/// Equations a pose takes, and those beyond them that must agree. Each agrees by chance with a probability of some
/// thousandths: the band of the tolerance over the photo.
const UNKNOWNS: usize = 6;
const SPARE: usize = 2;

/// Relative orientations of pairs found so far, with the principal distance they were found with.
#[derive(Default)]
pub(super) struct Pairs(BTreeMap<[usize; 2], (f64, Vec<Relative>)>);

/// Change of the principal distance beyond which a pair is oriented anew.
const CHANGED: f64 = 0.01;

impl Pairs {
    /// The relative orientations of `photo` to `neighbour` that three fifths of their common points agree with.
    fn of(&mut self, block: &OrientationBlock, neighbour: usize, photo: usize) -> &[Relative] {
        let units = block.pixels_per_unit(photo);
        let found = self.0.entry([neighbour, photo]).or_default();
        if (found.0 / units - 1.0).abs() > CHANGED {
            let all = relative(block, block, neighbour, photo);
            *found = (units, all);
        }
        &found.1
    }
}

/// The relative orientations of a photo of `other` to one of `block` that three fifths of their common points agree with.
pub(super) fn relative(
    block: &OrientationBlock,
    other: &OrientationBlock,
    first: usize,
    second: usize,
) -> Vec<Relative> {
    let common = block.common(first, second).into_iter();
    let (a, b): (Vec<_>, Vec<_>) =
        common.filter_map(|(a, b)| Some((block.observations[a].ray?, other.observations[b].ray?))).unzip();
    let seed = (second * block.photos.len() + first) as u64;
    let tolerance = other.tolerance_px(second) / other.pixels_per_unit(second);
    let mut found = relative_orientation(&a, &b, tolerance, seed).unwrap_or_default();
    found.retain(|r| 5 * r.inliers.iter().filter(|i| **i).count() >= 3 * a.len());
    found
}

/// Orients the photo for which there is most evidence; whether there is one.
pub(super) fn orient_one(block: &mut OrientationBlock, pairs: &mut Pairs) -> bool {
    let mut best: Option<(usize, usize, Pose)> = None;
    for photo in (0..block.photos.len()).filter(|&k| block.photos[k].pose.is_none()) {
        if let Some((votes, pose)) = best_pose(block, photo, pairs)
            && best.as_ref().is_none_or(|(most, ..)| votes > *most)
        {
            best = Some((votes, photo, pose));
        }
    }
    let Some((_, photo, pose)) = best else { return false };
    block.photos[photo].pose = Some(pose);
    for s in block.photos[photo].observations.clone() {
        let limit = 3.0 * block.tolerance_px(photo);
        block.observations[s].taken = block.misfit_px(s).is_none_or(|misfit| misfit <= limit);
    }
    true
}

/// A direction from a neighbour's projection centre in which the photo's lies, with its attitude.
struct Bearing {
    attitude: nalgebra::Matrix3<f64>,
    from: Vector3<f64>,
    direction: Vector3<f64>,
}

fn best_pose(block: &OrientationBlock, photo: usize, pairs: &mut Pairs) -> Option<(usize, Pose)> {
    let judged = poses(block, photo, pairs).into_iter().map(|pose| (votes(block, photo, &pose), pose));
    let ((agreeing, compared), pose) = judged.max_by(|a, b| a.0.0.cmp(&b.0.0))?;
    let enough = agreeing >= UNKNOWNS + SPARE && agreeing as f64 >= AGREEING * compared as f64;
    enough.then_some((agreeing, pose))
}

/// The poses that neighbours and triples of determined points give a photo.
pub(super) fn poses(block: &OrientationBlock, photo: usize, pairs: &mut Pairs) -> Vec<Pose> {
    let mut neighbours: Vec<(usize, usize)> = (0..block.photos.len())
        .filter(|&k| block.photos[k].pose.is_some())
        .map(|k| (block.common(k, photo).len(), k))
        .filter(|&(count, _)| count >= FEWEST_COMMON)
        .collect();
    neighbours.sort_by_key(|&(count, k)| (std::cmp::Reverse(count), k));
    let mut bearings = Vec::new();
    for &(_, neighbour) in neighbours.iter().take(MOST_NEIGHBOURS) {
        let Some(own) = block.photos[neighbour].pose else { continue };
        for relative in pairs.of(block, neighbour, photo) {
            bearings.push(Bearing {
                attitude: relative.pose.object_to_camera * own.object_to_camera,
                from: own.centre,
                direction: own.object_to_camera.tr_mul(&relative.pose.centre),
            });
        }
    }
    let mut poses: Vec<Pose> = Vec::new();
    let (_, object, image) = block.determined(photo);
    for (k, bearing) in bearings.iter().enumerate() {
        let bases = object.iter().zip(&image).filter_map(|(xyz, m)| base_to_point(bearing, xyz, *m));
        let lines = bearings.iter().enumerate().filter(|(other, _)| *other != k);
        let lines = lines.filter_map(|(_, other)| base_to_line(bearing, other));
        for base in bases.chain(lines).filter(|base| base.is_finite() && *base > 0.0) {
            let centre = bearing.from + bearing.direction * base;
            poses.push(Pose { object_to_camera: bearing.attitude, centre });
        }
    }
    let seen: Vec<(Vector3<f64>, [f64; 2])> = object.into_iter().zip(image).collect();
    for [i, j, k] in wide_triples(&seen) {
        poses.extend(p3p(&[seen[i].0, seen[j].0, seen[k].0], &[seen[i].1, seen[j].1, seen[k].1]));
    }
    poses
}

/// Length of the base with which a determined point appears where it was measured, least squares of its two equations.
fn base_to_point(bearing: &Bearing, xyz: &Vector3<f64>, [x, y]: [f64; 2]) -> Option<f64> {
    let p = bearing.attitude * (xyz - bearing.from);
    let t = bearing.attitude * bearing.direction;
    let rows = [(p.x + x * p.z, t.x + x * t.z), (p.y + y * p.z, t.y + y * t.z)];
    let (up, down) = rows.iter().fold((0.0, 0.0), |(u, d), (a, b)| (u + a * b, d + b * b));
    (down > 1e-12).then(|| up / down)
}

/// Length of the base to the point nearest to the line from a second neighbour, where they cross at 3° or more.
fn base_to_line(bearing: &Bearing, other: &Bearing) -> Option<f64> {
    let cosine = bearing.direction.dot(&other.direction);
    let determinant = 1.0 - cosine * cosine;
    let between = other.from - bearing.from;
    let (a, b) = (between.dot(&bearing.direction), between.dot(&other.direction));
    (determinant > 0.0027).then(|| (a - cosine * b) / determinant)
}

/// Equations of the photo that agree with the pose, among those that can be compared: two a determined point, one a
/// point that one oriented photo shows.
fn votes(block: &OrientationBlock, photo: usize, pose: &Pose) -> (usize, usize) {
    let units = block.pixels_per_unit(photo);
    let tolerance = 3.0 * block.tolerance_px(photo);
    let (mut agreeing, mut compared) = (0, 0);
    for &s in &block.photos[photo].observations {
        let observation = &block.observations[s];
        let Some(image) = observation.ray else { continue };
        if let Some(xyz) = block.points[observation.point].xyz {
            compared += 2;
            agreeing += 2 * usize::from(pose.misfit(&xyz, image) * units <= tolerance);
            continue;
        }
        let (_, others) = block.rays(observation.point);
        if let [other] = others[..] {
            compared += 1;
            let own = Ray { pose: *pose, image, weight: units * units };
            let meets = intersect(&[other, own])
                .is_ok_and(|found| found.residuals.iter().all(|r| r[0].hypot(r[1]) * units <= tolerance));
            agreeing += usize::from(meets);
        }
    }
    (agreeing, compared)
}
