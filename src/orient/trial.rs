//! What keeps an adjustment of the oriented project from its end is given up: points that run away along nearly parallel
//! rays, and what a rank defect names. A wrong name left in a point of two rays is the usual cause.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;

use super::block::Block;
use crate::adjust::{adjust, apply};
use crate::adjustment::{AdjustOptions, StatisticsChoice, Termination};
use crate::error::{Defect, Error};
use crate::project::{Project, Role};

/// Adjustments tried, at most.
const MOST_TRIALS: usize = 6;
/// Angle between the rays of a point, 0.3°, below which it has run away, and 1.5°, below which it may be what does not settle.
const RUN_AWAY: f64 = 0.005;
const NARROW: f64 = 0.026;

/// Gives up points and photos of the block until `as_project` of it can be adjusted, or nothing more is found.
pub(super) fn settle(block: &mut Block, as_project: impl Fn(&Block) -> Project) {
    for _ in 0..MOST_TRIALS {
        let project = as_project(block);
        let options = AdjustOptions { statistics: StatisticsChoice::None, ..AdjustOptions::default() };
        let (points, photos) = match adjust(&project, &options, &mut |_| true) {
            Ok(adjustment) if adjustment.termination == Termination::Converged => return,
            Ok(adjustment) => (runaways(&apply(&project, &adjustment)), BTreeSet::new()),
            Err(Error::RankDefect { defects }) => named(&defects),
            Err(_) => return,
        };
        let mut changed = false;
        for (point, mark) in project.points.iter().zip(&mut block.marks) {
            if mark.xyz.is_some() && point.role == Role::Tie && points.contains(&point.id) {
                mark.xyz = None;
                changed = true;
            }
        }
        for (photo, view) in project.photos.iter().zip(&mut block.views) {
            if !changed && view.pose.is_some() && !view.given && photos.contains(&photo.id) {
                view.pose = None;
                changed = true;
            }
        }
        if !changed {
            return;
        }
    }
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

/// The points whose rays have become parallel, or else the one whose rays are nearest to it.
fn runaways(project: &Project) -> BTreeSet<String> {
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
            rays.entry(&o.point).or_default().push((point - centre).normalize());
        }
    }
    let widest = |rays: &[Vector3<f64>]| {
        let pairs = rays.iter().enumerate().flat_map(|(k, a)| rays[k + 1..].iter().map(move |b| a.cross(b).norm()));
        pairs.fold(0.0, f64::max)
    };
    let mut angles: Vec<(f64, &str)> = rays.iter().map(|(id, rays)| (widest(rays), *id)).collect();
    angles.sort_by(|a, b| a.0.total_cmp(&b.0));
    let away: BTreeSet<String> =
        angles.iter().take_while(|(angle, _)| !(*angle >= RUN_AWAY)).map(|(_, id)| (*id).to_owned()).collect();
    if !away.is_empty() {
        return away;
    }
    angles.first().filter(|(angle, _)| *angle < NARROW).map(|(_, id)| (*id).to_owned()).into_iter().collect()
}
