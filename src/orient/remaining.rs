//! Orients the photos that remain when the rest of the block is oriented.
//!
//! While a model grows, its cameras are inaccurate and few points are determined. Photos that could not be oriented then, or whose pose
//! was removed because too few observations agreed, are tried again with the final cameras and points. Initial values of a robust pose
//! from points and rays together are: resections from three determined points, neighbouring photos, and guesses (poses of photos that
//! show the same points, rotated by multiples of 90° about the axis, and resections from points placed at the usual depth on their only
//! ray). The best few poses are adjusted with the block. One is accepted if agreement by chance is improbable
//! ([`evidence::expected_wrong_poses`]) and a hundred times less probable than for any other pose.

use nalgebra::{Matrix3, Vector3};

use super::block::{OrientationBlock, longer_side};
use super::bridge::wide_triples;
use super::evidence::{self, UNKNOWNS};
use super::neighbour::{self, Pairs};
use super::refine::{Freedom, refine};
use crate::initial::Pose;
use crate::initial::intersection::Ray;
use crate::initial::p3p::p3p;
use crate::initial::pose_from_rays::{ResectionObservation, ResectionTarget, settled};
use crate::initial::robust::quantile;

/// Widths of the robust loss as shares of the longer side, from guessed poses.
const FROM_GUESSES: [f64; 5] = [0.1, 0.03, 0.01, 0.003, 0.001];
/// Index of the first width for poses that are exact except for noise.
const FROM_POSES: usize = 2;
/// Tolerance of agreement, the last width: points with two rays are about that uncertain.
const TOLERANCE: f64 = FROM_GUESSES[FROM_GUESSES.len() - 1];
/// Maximum number of neighbours whose poses are used as guesses.
const MOST_GUESSES: usize = 16;
/// Maximum number of poses that are adjusted with the block.
const MOST_ADJUSTED: usize = 3;
/// Maximum ratio of the expected number of wrong poses to that of the second best pose.
const FEWER: f64 = 0.01;

/// Orients the remaining photos with enough evidence, each once, and sets `accepted` for them. Returns whether there was one.
pub(super) fn orient(block: &mut OrientationBlock, accepted: &mut [bool]) -> bool {
    let mut any = false;
    let mut pairs = Pairs::default();
    loop {
        let left = (0..block.photos.len()).filter(|&k| block.photos[k].pose.is_none() && !accepted[k]);
        let counted = left.map(|k| (seen(block, k).iter().map(|(_, s)| s.equations()).sum::<usize>(), k));
        let mut photos: Vec<(usize, usize)> = counted.filter(|(equations, _)| *equations > UNKNOWNS).collect();
        photos.sort_by_key(|&(equations, k)| (std::cmp::Reverse(equations), k));
        let Some((photo, next)) = photos.into_iter().find_map(|(_, k)| Some((k, with_photo(block, k, &mut pairs)?)))
        else {
            return any;
        };
        *block = next;
        accepted[photo] = true;
        any = true;
    }
}

/// The photo's observations of determined points, and of points with a ray in one oriented photo.
fn seen(block: &OrientationBlock, photo: usize) -> Vec<(usize, ResectionObservation)> {
    let all = block.photos[photo].observations.iter().filter_map(|&s| {
        let observation = &block.observations[s];
        let image = observation.ray?;
        if let Some(xyz) = block.points[observation.point].xyz {
            return Some((s, ResectionObservation { target: ResectionTarget::Point(xyz), image }));
        }
        let (_, rays) = block.rays(observation.point);
        let [ray] = rays[..] else { return None };
        Some((s, ResectionObservation { target: ResectionTarget::Ray(ray), image }))
    });
    all.collect()
}

/// Initial poses of a photo: those computed from its observations, and guesses.
fn starts(block: &OrientationBlock, photo: usize, pairs: &mut Pairs) -> (Vec<Pose>, Vec<Pose>) {
    let exact = neighbour::poses(block, photo, pairs);
    let mut near: Vec<(usize, usize)> = (0..block.photos.len())
        .filter(|&k| block.photos[k].pose.is_some())
        .map(|k| (block.common(k, photo).len(), k))
        .filter(|(count, _)| *count > 0)
        .collect();
    near.sort_by_key(|&(count, k)| (std::cmp::Reverse(count), k));
    near.truncate(MOST_GUESSES);
    let poses: Vec<Pose> = near.iter().filter_map(|&(_, k)| block.photos[k].pose).collect();
    let mut guesses = Vec::new();
    for (k, pose) in poses.iter().enumerate() {
        // between two neighbours: at the projection centre of one, its rays have no epipolar lines
        let centre = 0.5 * (pose.centre + poses[(k + 1) % poses.len()].centre);
        for quarter in 0..4 {
            let (sin, cos) = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][quarter];
            let roll = Matrix3::new(cos, sin, 0.0, -sin, cos, 0.0, 0.0, 0.0, 1.0);
            guesses.push(Pose { object_to_camera: roll * pose.object_to_camera, centre });
        }
    }
    let all = at_usual_depth(block, photo);
    for [i, j, k] in wide_triples(&all) {
        guesses.extend(p3p(&[all[i].0, all[j].0, all[k].0], &[all[i].1, all[j].1, all[k].1]));
    }
    (exact, guesses)
}

/// The photo's observed points with ideal coordinates. A point that only one other photo shows is placed on the ray of that photo, at the
/// median distance of that photo's determined points.
fn at_usual_depth(block: &OrientationBlock, photo: usize) -> Vec<(Vector3<f64>, [f64; 2])> {
    let usual = |other: usize, pose: &Pose| {
        let (_, object, _) = block.determined(other);
        let lengths: Vec<f64> = object.iter().map(|xyz| (xyz - pose.centre).norm()).collect();
        (!lengths.is_empty()).then(|| quantile(&lengths, 0.5))
    };
    let all = seen(block, photo).into_iter().filter_map(|(s, ResectionObservation { target, image })| match target {
        ResectionTarget::Point(xyz) => Some((xyz, image)),
        ResectionTarget::Ray(Ray { pose, image: other, .. }) => {
            let (which, _) = block.rays(block.observations[s].point);
            let depth = usual(block.observations[*which.first()?].photo, &pose)?;
            Some((pose.centre + pose.ray(other) * depth, image))
        }
    });
    all.collect()
}

/// The block with the photo oriented; `None` if no pose is supported by the photo's observations well enough, or more than one is.
fn with_photo(block: &OrientationBlock, photo: usize, pairs: &mut Pairs) -> Option<OrientationBlock> {
    let (observations, seen): (Vec<usize>, Vec<ResectionObservation>) = seen(block, photo).into_iter().unzip();
    let side_px = longer_side(&block.cameras[block.photos[photo].camera]);
    // in a less accurate block, observations agree within larger limits than the probabilities assume
    if observations.iter().any(|&s| block.limit_px(s) > TOLERANCE * side_px) {
        return None;
    }
    let side = side_px / block.pixels_per_unit(photo);
    let widths = FROM_GUESSES.map(|share| share * side);
    let (exact, guesses) = starts(block, photo, pairs);
    let found = exact
        .into_iter()
        .map(|pose| settled(pose, &seen, &widths[FROM_POSES..]))
        .chain(guesses.into_iter().map(|pose| settled(pose, &seen, &widths)));
    let agreeing = |pose: &Pose| -> usize {
        seen.iter().filter(|s| s.misfit(pose) <= TOLERANCE * side).map(ResectionObservation::equations).sum()
    };
    let mut poses: Vec<(usize, f64, Pose)> = Vec::new();
    for pose in found {
        let equations = agreeing(&pose);
        let cost: f64 = seen.iter().map(|s| s.misfit(&pose).min(TOLERANCE * side)).sum();
        if equations > UNKNOWNS {
            poses.push((equations, cost, pose));
        }
    }
    poses.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.total_cmp(&b.1)));
    let mut distinct: Vec<(usize, f64, Pose)> = Vec::new();
    for candidate in poses {
        if !distinct.iter().any(|(.., other)| same(block, other, &candidate.2)) {
            distinct.push(candidate);
            if distinct.len() == MOST_ADJUSTED {
                break;
            }
        }
    }
    let mut found: Vec<(f64, OrientationBlock)> = Vec::new();
    for (.., pose) in distinct {
        let Some((chance, next)) = adjusted(block, photo, pose, &observations, &seen) else { continue };
        let pose = next.photos[photo].pose;
        match found
            .iter_mut()
            .find(|(_, other)| other.photos[photo].pose.zip(pose).is_some_and(|(a, b)| same(block, &a, &b)))
        {
            Some(known) if chance < known.0 => *known = (chance, next),
            Some(_) => {}
            None => found.push((chance, next)),
        }
    }
    let least = found.iter().map(|(chance, _)| *chance).fold(f64::INFINITY, f64::min);
    found.retain(|(chance, _)| *chance < evidence::CHANCE && *chance * FEWER <= least);
    // without a known noise only the expected number of wrong poses decides
    let noise = block.noise_px.unwrap_or(f64::INFINITY);
    let best =
        (0..found.len()).find(|&k| (0..found.len()).all(|l| l == k || is_likelier(&found[k], &found[l], noise)))?;
    Some(found.swap_remove(best).1)
}

/// Whether the first of two blocks is more probable than the second by the factor 1/[`FEWER`]: by the expected numbers of wrong poses,
/// and by the residuals of the observations that agree in both, since with a plane object the same observations may agree with two poses.
fn is_likelier(
    (chance, model): &(f64, OrientationBlock),
    (other_chance, other): &(f64, OrientationBlock),
    noise_px: f64,
) -> bool {
    let squares = |a: &OrientationBlock, b: &OrientationBlock| -> f64 {
        let both = (0..a.observations.len()).filter(|&s| a.observations[s].taken && b.observations[s].taken);
        both.filter_map(|s| Some(a.misfit_px(s)?.powi(2) - b.misfit_px(s)?.powi(2))).sum()
    };
    (chance / other_chance).ln() + squares(model, other) / (2.0 * noise_px * noise_px) < FEWER.ln()
}

/// Whether two poses of a photo are so close that an adjustment leads both to the same solution.
fn same(block: &OrientationBlock, a: &Pose, b: &Pose) -> bool {
    let lengths = block.photos.iter().filter_map(|v| v.pose).map(|pose| (pose.centre - a.centre).norm());
    let away = lengths.fold(0.0, f64::max);
    (a.object_to_camera - b.object_to_camera).norm() < 0.05 && (a.centre - b.centre).norm() < 0.05 * away
}

/// The block adjusted with the photo in this pose, and the expected number of wrong poses with as many agreeing observations; `None` if
/// other observations no longer agree or too few do.
fn adjusted(
    block: &OrientationBlock,
    photo: usize,
    pose: Pose,
    observations: &[usize],
    seen: &[ResectionObservation],
) -> Option<(f64, OrientationBlock)> {
    let side = longer_side(&block.cameras[block.photos[photo].camera]);
    let units = block.pixels_per_unit(photo);
    let mut next = block.clone();
    next.photos[photo].pose = Some(pose);
    for (&s, seen) in observations.iter().zip(seen) {
        next.observations[s].taken = seen.misfit(&pose) * units <= TOLERANCE * side;
    }
    next.intersect_new(0.0);
    refine(&mut next, Freedom::Distance);
    next.intersect_new(0.0);
    next.review();
    let before = block.agreeing();
    let (mut points, mut rays) = (0, 0);
    for (&s, seen) in observations.iter().zip(seen) {
        if next.observations[s].taken && next.misfit_px(s).is_some() {
            match seen.target {
                ResectionTarget::Point(_) => points += 1,
                ResectionTarget::Ray(_) => rays += 1,
            }
        }
    }
    // no observation that agreed before may be lost
    let suffered = next.agreeing() < before + points + rays;
    (!suffered && 2 * points + rays > UNKNOWNS)
        .then(|| (evidence::expected_wrong_poses(seen.len(), points, rays), next))
}
