//! Removes data that keep an adjustment of the oriented project from converging: points that diverge along nearly
//! parallel rays, and the data named by a rank defect. A wrong name left in a point of two rays is the usual cause.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;

use super::block::OrientationBlock;
use crate::adjust::ending;
use crate::adjustment::{AdjustOptions, StatisticsChoice, Termination};
use crate::error::{Defect, Error};
use crate::initial::intersection::SMALLEST_ANGLE;
use crate::project::{Project, Role};

/// Adjustments tried, at most: the search ends when nothing more is found; this only bounds its time.
const MOST_TRIALS: usize = 20;
/// Iterations more in which it is seen what does not come to rest.
const MORE: usize = 3;
/// Movement in them, as a share of the distance from the nearest photo, of a point that does not come to rest, and the
/// part of the largest one from which points are given up together: one that runs away drags its neighbours along.
const RESTLESS: f64 = 1e-4;
const TOGETHER: f64 = 0.3;
/// Where more than one point in so many moves it is the network that does, and no point is to blame.
const FEW: usize = 10;

/// Gives up points and photos of the block until `as_project` of it can be adjusted, or nothing more is found; whether it can.
pub(super) fn settle(block: &mut OrientationBlock, as_project: impl Fn(&OrientationBlock) -> Project) -> bool {
    for _ in 0..MOST_TRIALS {
        let project = as_project(block);
        let options = AdjustOptions { statistics: StatisticsChoice::None, ..AdjustOptions::default() };
        let (points, photos) = match ending(&project, &options) {
            Ok((Termination::Converged, _)) => return true,
            Ok((_, adjusted)) => (runaways(&adjusted, &options), BTreeSet::new()),
            Err(Error::RankDefect { defects }) => named(&defects),
            Err(_) => return false,
        };
        let mut changed = false;
        for (point, block_point) in project.points.iter().zip(&mut block.points) {
            if block_point.xyz.is_some() && point.role == Role::Tie && points.contains(&point.id) {
                block_point.xyz = None;
                changed = true;
            }
        }
        for (photo, block_photo) in project.photos.iter().zip(&mut block.photos) {
            if !changed && block_photo.pose.is_some() && !block_photo.given && photos.contains(&photo.id) {
                block_photo.pose = None;
                changed = true;
            }
        }
        if !changed {
            return false;
        }
    }
    false
}

/// Points and photos of defects that leaving them out mends. Cameras and datum are the user's to hold or observe.
fn named(defects: &[Defect]) -> (BTreeSet<String>, BTreeSet<String>) {
    let (mut points, mut photos) = (BTreeSet::new(), BTreeSet::new());
    for defect in defects {
        match defect {
            Defect::TooFewRays { points: few } => points.extend(few.iter().cloned()),
            Defect::PhotoUndetermined { photos: few } => photos.extend(few.iter().cloned()),
            Defect::Combination { points: some, photos: others, parameters } if parameters.is_empty() => {
                points.extend(some.iter().cloned());
                photos.extend(others.iter().cloned());
            }
            _ => {}
        }
    }
    (points, photos)
}

/// The points whose rays have become parallel, or else those that a few more iterations move most.
fn runaways(project: &Project, options: &AdjustOptions) -> BTreeSet<String> {
    let centres: BTreeMap<&str, Vector3<f64>> =
        project.photos.iter().filter_map(|p| Some((p.id.as_str(), p.position?.into()))).collect();
    let mut rays: BTreeMap<&str, Vec<Vector3<f64>>> = BTreeMap::new();
    let xyz: BTreeMap<&str, Vector3<f64>> = project
        .points
        .iter()
        .filter(|p| p.role == Role::Tie)
        .filter_map(|p| Some((p.id.as_str(), p.xyz?.into())))
        .collect();
    for o in project.observations.iter().filter(|o| o.enabled) {
        if let (Some(centre), Some(point)) = (centres.get(o.photo.as_str()), xyz.get(o.point.as_str())) {
            rays.entry(&o.point).or_default().push(point - centre);
        }
    }
    let widest = |rays: &[Vector3<f64>]| {
        let pairs = rays.iter().enumerate().flat_map(|(k, a)| rays[k + 1..].iter().map(move |b| (a, b)));
        pairs.map(|(a, b)| a.cross(b).norm() / (a.norm() * b.norm())).fold(0.0, f64::max)
    };
    let parallel = rays.iter().filter(|(_, rays)| !(widest(rays) >= SMALLEST_ANGLE));
    let away: BTreeSet<String> = parallel.map(|(id, _)| (*id).to_owned()).collect();
    // where most have run away it is the network that has, and those that are no worse than the others must not pay for it
    if 2 * away.len() > rays.len() {
        return BTreeSet::new();
    }
    if !away.is_empty() {
        return away;
    }
    let more = AdjustOptions { max_iterations: MORE, ..options.clone() };
    let Ok((_, later)) = ending(project, &more) else { return away };
    let moved = later.points.iter().filter_map(|p| {
        let (before, near) = (xyz.get(p.id.as_str())?, rays.get(p.id.as_str())?);
        let distance = near.iter().map(|ray| ray.norm()).fold(f64::INFINITY, f64::min);
        Some(((Vector3::from(p.xyz?) - before).norm() / distance, p.id.as_str()))
    });
    let moved: Vec<(f64, &str)> = moved.collect();
    let most = moved.iter().map(|(share, _)| *share).fold(0.0, f64::max);
    let restless = moved.iter().filter(|(share, _)| *share > RESTLESS.max(TOGETHER * most));
    let restless: BTreeSet<String> = restless.map(|(_, id)| (*id).to_owned()).collect();
    if restless.len() * FEW <= moved.len() { restless } else { BTreeSet::new() }
}
