//! Photos that are left over when everything else stands.
//!
//! While a model grows, its cameras are rough and few points are determined; what could not be oriented then, or lost its
//! pose because too little agreed with it, is looked at once more against cameras and points that stand. Three determined
//! points, neighbours, and rough guesses (the poses of photos that show the same points, rolled by quarters, and resections
//! from points put at the usual depth of their one ray) are starts of a robust pose from points and rays together. The best
//! few are adjusted with everything else, and one is kept if it would hardly come about by chance ([`evidence::by_chance`]) and is
//! a hundred times likelier than any other.

use nalgebra::{Matrix3, Vector3};

use super::block::{Block, longer_side};
use super::bridge::wide_triples;
use super::evidence::{self, UNKNOWNS};
use super::neighbour::{self, Pairs};
use super::refine::{Freedom, refine};
use crate::initial::Pose;
use crate::initial::intersection::Ray;
use crate::initial::p3p::p3p;
use crate::initial::pose_from_rays::{Seen, Target, settled};
use crate::initial::robust::quantile;

/// Widths of the robust loss as shares of the longer side: from guesses, and from poses that are exact but for noise.
const FROM_GUESSES: [f64; 5] = [0.1, 0.03, 0.01, 0.003, 0.001];
const FROM_POSES: usize = 2;
/// The last of them is the tolerance: points of two rays are as uncertain as that.
const TOLERANCE: f64 = FROM_GUESSES[FROM_GUESSES.len() - 1];
/// Neighbours whose poses are guesses, poses that are adjusted with everything else.
const MOST_GUESSES: usize = 16;
const MOST_ADJUSTED: usize = 3;
/// The pose kept is as many times likelier than any other.
const FEWER: f64 = 0.01;

/// Orients the photos for which there is evidence now, each once, and marks them; whether there was one.
pub(super) fn orient(block: &mut Block, borne: &mut [bool]) -> bool {
    let mut any = false;
    let mut pairs = Pairs::default();
    loop {
        let left = (0..block.views.len()).filter(|&k| block.views[k].pose.is_none() && !borne[k]);
        let counted = left.map(|k| (seen(block, k).iter().map(|(_, s)| s.equations()).sum::<usize>(), k));
        let mut photos: Vec<(usize, usize)> = counted.filter(|(equations, _)| *equations > UNKNOWNS).collect();
        photos.sort_by_key(|&(equations, k)| (std::cmp::Reverse(equations), k));
        let Some((photo, next)) = photos.into_iter().find_map(|(_, k)| Some((k, with_photo(block, k, &mut pairs)?)))
        else {
            return any;
        };
        *block = next;
        borne[photo] = true;
        any = true;
    }
}

/// What a photo shows of determined points, and of points that one oriented photo shows.
fn seen(block: &Block, photo: usize) -> Vec<(usize, Seen)> {
    let all = block.views[photo].sights.iter().filter_map(|&s| {
        let sight = &block.sights[s];
        let image = sight.ray?;
        if let Some(xyz) = block.marks[sight.point].xyz {
            return Some((s, Seen { target: Target::Point(xyz), image }));
        }
        let (_, rays) = block.rays(sight.point);
        let [ray] = rays[..] else { return None };
        Some((s, Seen { target: Target::Ray(ray), image }))
    });
    all.collect()
}

/// Poses to start from: exact ones, then guesses.
fn starts(block: &Block, photo: usize, pairs: &mut Pairs) -> (Vec<Pose>, Vec<Pose>) {
    let exact = neighbour::poses(block, photo, pairs);
    let mut near: Vec<(usize, usize)> = (0..block.views.len())
        .filter(|&k| block.views[k].pose.is_some())
        .map(|k| (block.common(k, photo).len(), k))
        .filter(|(count, _)| *count > 0)
        .collect();
    near.sort_by_key(|&(count, k)| (std::cmp::Reverse(count), k));
    near.truncate(MOST_GUESSES);
    let poses: Vec<Pose> = near.iter().filter_map(|&(_, k)| block.views[k].pose).collect();
    let mut guesses = Vec::new();
    for (k, pose) in poses.iter().enumerate() {
        // not in the very place of a neighbour, where its rays have no epipolar lines
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

/// What a photo shows as points: those that are not determined stand on their one ray, as far off as what else its photo shows.
fn at_usual_depth(block: &Block, photo: usize) -> Vec<(Vector3<f64>, [f64; 2])> {
    let usual = |other: usize, pose: &Pose| {
        let (_, object, _) = block.determined(other);
        let lengths: Vec<f64> = object.iter().map(|xyz| (xyz - pose.centre).norm()).collect();
        (!lengths.is_empty()).then(|| quantile(&lengths, 0.5))
    };
    let all = seen(block, photo).into_iter().filter_map(|(s, Seen { target, image })| match target {
        Target::Point(xyz) => Some((xyz, image)),
        Target::Ray(Ray { pose, image: other, .. }) => {
            let (which, _) = block.rays(block.sights[s].point);
            let depth = usual(block.sights[*which.first()?].photo, &pose)?;
            Some((pose.centre + pose.ray(other) * depth, image))
        }
    });
    all.collect()
}

/// The block with the photo in the one pose that its measurements bear out.
fn with_photo(block: &Block, photo: usize, pairs: &mut Pairs) -> Option<Block> {
    let (sights, seen): (Vec<usize>, Vec<Seen>) = seen(block, photo).into_iter().unzip();
    let side_px = longer_side(&block.cameras[block.views[photo].camera]);
    // what agrees in a rougher model is not what is counted on
    if sights.iter().any(|&s| block.limit_px(s) > TOLERANCE * side_px) {
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
        seen.iter().filter(|s| s.misfit(pose) <= TOLERANCE * side).map(Seen::equations).sum()
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
    let mut found: Vec<(f64, Block)> = Vec::new();
    for (.., pose) in distinct {
        let Some((chance, next)) = adjusted(block, photo, pose, &sights, &seen) else { continue };
        let pose = next.views[photo].pose;
        match found
            .iter_mut()
            .find(|(_, other)| other.views[photo].pose.zip(pose).is_some_and(|(a, b)| same(block, &a, &b)))
        {
            Some(known) if chance < known.0 => *known = (chance, next),
            Some(_) => {}
            None => found.push((chance, next)),
        }
    }
    let least = found.iter().map(|(chance, _)| *chance).fold(f64::INFINITY, f64::min);
    found.retain(|(chance, _)| *chance < evidence::CHANCE && *chance * FEWER <= least);
    // without a noise to compare with, chance alone decides
    let noise = block.noise_px.unwrap_or(f64::INFINITY);
    let best =
        (0..found.len()).find(|&k| (0..found.len()).all(|l| l == k || is_likelier(&found[k], &found[l], noise)))?;
    Some(found.swap_remove(best).1)
}

/// Whether the first of two models with a photo is [`FEWER`] times likelier than the second: by what would agree by chance, and by
/// the residuals of what agrees in both, for two poses of a plane may have the same measurements within the tolerance.
fn is_likelier((chance, model): &(f64, Block), (other_chance, other): &(f64, Block), noise_px: f64) -> bool {
    let squares = |a: &Block, b: &Block| -> f64 {
        let both = (0..a.sights.len()).filter(|&s| a.sights[s].taken && b.sights[s].taken);
        both.filter_map(|s| Some(a.misfit_px(s)?.powi(2) - b.misfit_px(s)?.powi(2))).sum()
    };
    (chance / other_chance).ln() + squares(model, other) / (2.0 * noise_px * noise_px) < FEWER.ln()
}

/// Whether two poses of a photo are the same but for what an adjustment evens out.
fn same(block: &Block, a: &Pose, b: &Pose) -> bool {
    let lengths = block.views.iter().filter_map(|v| v.pose).map(|pose| (pose.centre - a.centre).norm());
    let away = lengths.fold(0.0, f64::max);
    (a.object_to_camera - b.object_to_camera).norm() < 0.05 && (a.centre - b.centre).norm() < 0.05 * away
}

/// The block adjusted with the photo in this pose, and how many poses would agree with as much by chance.
fn adjusted(block: &Block, photo: usize, pose: Pose, sights: &[usize], seen: &[Seen]) -> Option<(f64, Block)> {
    let side = longer_side(&block.cameras[block.views[photo].camera]);
    let units = block.pixels_per_unit(photo);
    let mut next = block.clone();
    next.views[photo].pose = Some(pose);
    for (&s, seen) in sights.iter().zip(seen) {
        next.sights[s].taken = seen.misfit(&pose) * units <= TOLERANCE * side;
    }
    next.intersect_new(0.0);
    refine(&mut next, Freedom::Distance);
    next.intersect_new(0.0);
    next.review();
    let before = block.agreeing();
    let (mut points, mut rays) = (0, 0);
    for (&s, seen) in sights.iter().zip(seen) {
        if next.sights[s].taken && next.misfit_px(s).is_some() {
            match seen.target {
                Target::Point(_) => points += 1,
                Target::Ray(_) => rays += 1,
            }
        }
    }
    // what the others agreed with must not suffer
    let suffered = next.agreeing() < before + points + rays;
    (!suffered && 2 * points + rays > UNKNOWNS).then(|| (evidence::by_chance(seen.len(), points, rays), next))
}
