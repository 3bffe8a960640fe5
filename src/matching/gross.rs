//! Gross errors after an adjustment: measurements with a wrong name.
//!
//! A wrong name moves its target by many standard deviations, and its point with it. Each point's rays are judged by
//! themselves: the ray without which the others meet best is the wrong one.

use std::collections::{BTreeMap, BTreeSet};

use super::photo::OrientedPhoto;
use super::{Doubt, Doubtful};
use crate::adjust::{adjust, apply};
use crate::adjustment::{AdjustOptions, Adjustment, Iteration, Robust};
use crate::error::Result;
use crate::initial::intersection::{Ray, intersect};
use crate::initial::robust::scale;
use crate::project::{Project, Role, SetAside, SetAsideBy, SetAsideReason};

/// Robust standard deviations beyond which a ray does not belong to its point, and pixels it may be off in any case.
const LIMIT_SIGMAS: f64 = 7.0;
const LIMIT_PX: f64 = 0.3;
/// Rounds of adjusting and judging.
const MOST_ROUNDS: usize = 6;

/// An adjustment whose gross errors were taken out.
#[derive(Clone, Debug)]
pub struct Cleaned {
    /// The project with adjusted values and with wrong measurements disabled.
    pub project: Project,
    /// The last adjustment.
    pub adjustment: Adjustment,
    /// The measurements disabled, in the order they were found.
    pub removed: Vec<Doubtful>,
}

/// Adjusts, disables measurements that disagree with the other rays of their point, and adjusts again until none does. The first
/// adjustment is a robust one: what is to be judged must not have distorted the state by which it is judged.
///
/// # Errors
/// Those of [`adjust`].
pub fn without_gross_errors(
    project: &Project,
    options: &AdjustOptions,
    on_iteration: &mut dyn FnMut(&Iteration) -> bool,
) -> Result<Cleaned> {
    let mut project = project.clone();
    let mut removed = Vec::new();
    let robust = AdjustOptions { robust: options.robust.or(Some(Robust::Huber)), ..options.clone() };
    let mut adjustment = adjust(&project, &robust, on_iteration)?;
    for round in 0..MOST_ROUNDS {
        project = apply(&project, &adjustment);
        let wrong = disagreeing(&project);
        if round > 0 && wrong.is_empty() {
            break;
        }
        for k in wrong {
            let observation = &mut project.observations[k];
            observation.enabled = false;
            project.set_aside.push(SetAside {
                photo: observation.photo.clone(),
                point: observation.point.clone(),
                reason: SetAsideReason::Disagrees,
                distance_px: None,
                by: SetAsideBy::Matching,
            });
            removed.push(Doubtful {
                photo: observation.photo.clone(),
                u: observation.u,
                v: observation.v,
                target: observation.target,
                points: vec![observation.point.clone()],
                reason: Doubt::Disagrees,
            });
        }
        adjustment = adjust(&project, options, on_iteration)?;
    }
    Ok(Cleaned { project: apply(&project, &adjustment), adjustment, removed })
}

/// Places, in the project's list, of the enabled observations that do not agree with the other rays of their point,
/// judged with the orientations and cameras the project holds.
///
/// Where two rays are left and do not meet, neither can be trusted and both are listed.
pub fn disagreeing(project: &Project) -> Vec<usize> {
    let photos = OrientedPhoto::all(project);
    let by_id: BTreeMap<&str, &OrientedPhoto> = photos.iter().map(|p| (p.id.as_str(), p)).collect();
    let mut of_point: BTreeMap<&str, Vec<(usize, Ray)>> = BTreeMap::new();
    for (k, o) in project.observations.iter().enumerate().filter(|(_, o)| o.enabled) {
        let Some(photo) = by_id.get(o.photo.as_str()) else { continue };
        let Some(image) = photo.ray([o.u, o.v]) else { continue };
        let weight = photo.principal_distance_px.powi(2);
        of_point.entry(&o.point).or_default().push((k, Ray { pose: photo.pose, image, weight }));
    }
    let residuals = |rays: &[(usize, Ray)]| -> Vec<f64> {
        let only: Vec<Ray> = rays.iter().map(|(_, ray)| *ray).collect();
        match intersect(&only) {
            Ok(found) => {
                found.residuals.iter().zip(&only).map(|(r, ray)| r[0].hypot(r[1]) * ray.weight.sqrt()).collect()
            }
            Err(_) => vec![f64::INFINITY; rays.len()],
        }
    };
    let lengths: Vec<f64> = of_point.values().filter(|r| r.len() > 1).flat_map(|rays| residuals(rays)).collect();
    let limit = (LIMIT_SIGMAS * scale(&lengths, 0)).max(LIMIT_PX);
    let control: BTreeSet<&str> =
        project.points.iter().filter(|p| p.role == Role::Control).map(|p| p.id.as_str()).collect();
    let mut wrong = Vec::new();
    for (id, mut rays) in of_point {
        // A point with given coordinates is judged by the adjustment alone once it has a single ray.
        let known = control.contains(id);
        let worst_of = |rays: &[(usize, Ray)]| residuals(rays).into_iter().fold(0.0, f64::max);
        while rays.len() >= 2 && worst_of(&rays) > limit {
            if rays.len() == 2 {
                if !known {
                    wrong.extend(rays.iter().map(|(k, _)| *k));
                }
                break;
            }
            let without = |leave: usize| -> Vec<(usize, Ray)> {
                rays.iter().enumerate().filter(|(k, _)| *k != leave).map(|(_, ray)| *ray).collect()
            };
            let trial = |leave: usize| worst_of(&without(leave));
            let judged = (0..rays.len()).map(|leave| (trial(leave), leave));
            let Some((_, leave)) = judged.min_by(|a, b| a.0.total_cmp(&b.0)) else { break };
            wrong.push(rays.remove(leave).0);
        }
    }
    wrong.sort_unstable();
    wrong
}
