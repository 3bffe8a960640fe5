//! Targets that have no name yet, in the photos that are oriented: what matching works on.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::photo::OrientedPhoto;
use super::{Doubt, Doubtful, PhotoTargets};
use crate::detection::{Polarity, Target};
use crate::initial::robust::{quantile, scale};
use crate::project::{Observation, Point, Project};

/// Options of [`match_uncoded`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct MatchOptions {
    /// Largest distance of a target from where its point should appear, pixels; null: from the residuals of the
    /// measurements that are there.
    pub tolerance_px: Option<f64>,
    /// Minimum number of rays of a new point; not below 3, since any two rays may meet.
    pub min_rays: usize,
}

/// Result of [`match_uncoded`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Matching {
    /// New points, with coordinates.
    pub points: Vec<Point>,
    /// New observations, of new points and of points that were there.
    pub observations: Vec<Observation>,
    /// Targets that fit in more than one way, or that too few rays support.
    pub doubtful: Vec<Doubtful>,
}

/// Tolerance in robust standard deviations of the residuals; its limits in pixels.
const TOLERANCE_SIGMAS: f64 = 6.0;

const TOLERANCE_PX: [f64; 2] = [0.4, 6.0];

/// Largest ratio of target sizes, brought to the object, within one point.
const SIZE_RATIO: f64 = 1.6;

/// A target on offer.
#[derive(Clone, Copy, Debug)]
pub struct Free {
    /// Place in the photo's list of targets.
    pub target: usize,
    /// Ideal coordinates.
    pub ray: [f64; 2],
    /// Longer axis of its image.
    pub diameter_px: f64,
    /// Bright or dark.
    pub polarity: Polarity,
    /// Whether a code names it.
    pub coded: bool,
}

/// An oriented photo with its targets.
pub struct FreeTargets<'a> {
    /// Its orientation.
    pub photo: OrientedPhoto,
    pub targets: &'a [Target],
    /// Free targets, ascending by x.
    pub free: Vec<Free>,
}

pub fn views<'a>(project: &Project, targets: &'a [PhotoTargets]) -> Vec<FreeTargets<'a>> {
    let by_photo: BTreeMap<&str, &PhotoTargets> = targets.iter().map(|t| (t.photo.as_str(), t)).collect();
    let mut named: BTreeMap<&str, Vec<[f64; 2]>> = BTreeMap::new();
    for o in project.observations.iter().filter(|o| o.enabled) {
        named.entry(&o.photo).or_default().push([o.u, o.v]);
    }
    let mut views = Vec::new();
    for photo in OrientedPhoto::all(project) {
        let Some(found) = by_photo.get(photo.id.as_str()) else { continue };
        let taken = named.get(photo.id.as_str()).map_or(&[][..], Vec::as_slice);
        let mut free: Vec<Free> = Vec::new();
        // what is occluded in part takes no part unless a user names it
        for (k, t) in found.targets.iter().enumerate().filter(|(_, t)| !t.occluded) {
            let near = (0.25 * t.minor).max(1.0);
            if taken.iter().any(|[u, v]| (u - t.u).hypot(v - t.v) < near) {
                continue;
            }
            let Some(ray) = photo.ray([t.u, t.v]) else { continue };
            free.push(Free { target: k, ray, diameter_px: t.major, polarity: t.polarity, coded: t.code.is_some() });
        }
        free.sort_by(|a, b| a.ray[0].total_cmp(&b.ray[0]));
        views.push(FreeTargets { photo, targets: &found.targets, free });
    }
    views
}

pub fn tolerance_px(project: &Project, views: &[FreeTargets]) -> f64 {
    let xyz: BTreeMap<&str, Vector3<f64>> =
        project.points.iter().filter_map(|p| Some((p.id.as_str(), Vector3::from(p.xyz?)))).collect();
    let by_id: BTreeMap<&str, &FreeTargets> = views.iter().map(|v| (v.photo.id.as_str(), v)).collect();
    let misfits = project.observations.iter().filter(|o| o.enabled).filter_map(|o| {
        let photo = &by_id.get(o.photo.as_str())?.photo;
        Some(photo.pose.misfit(xyz.get(o.point.as_str())?, photo.ray([o.u, o.v])?) * photo.principal_distance_px)
    });
    let noise = scale(&misfits.collect::<Vec<_>>(), 0);
    let sizes: Vec<f64> = views.iter().flat_map(|v| &v.free).map(|f| f.diameter_px).collect();
    // Half a target's size at most: beyond it the neighbour could be meant.
    let widest = TOLERANCE_PX[1].min((0.5 * quantile(&sizes, 0.5)).max(1.0));
    (TOLERANCE_SIGMAS * noise).clamp(TOLERANCE_PX[0], widest)
}

/// Whether two sizes at the object may be those of one target.
pub fn similar(a: f64, b: f64) -> bool {
    a < SIZE_RATIO * b && b < SIZE_RATIO * a
}

impl Default for MatchOptions {
    fn default() -> Self {
        Self { tolerance_px: None, min_rays: 3 }
    }
}

impl FreeTargets<'_> {
    /// The free target nearest to ideal coordinates, within a radius in pixels, of fitting size; and whether a second
    /// one lies there too.
    pub fn nearest(&self, image: [f64; 2], radius_px: f64, fits: impl Fn(&Free) -> bool) -> Option<(usize, bool)> {
        let radius = radius_px / self.photo.principal_distance_px;
        let from = self.free.partition_point(|f| f.ray[0] < image[0] - radius);
        let mut best: Option<(f64, usize)> = None;
        let mut count = 0;
        for (k, f) in self.free.iter().enumerate().skip(from).take_while(|(_, f)| f.ray[0] <= image[0] + radius) {
            let distance = (f.ray[0] - image[0]).hypot(f.ray[1] - image[1]);
            if distance <= radius && fits(f) {
                count += 1;
                if best.is_none_or(|(least, _)| distance < least) {
                    best = Some((distance, k));
                }
            }
        }
        best.map(|(_, k)| (k, count > 1))
    }

    /// Size of a target brought to the object.
    pub fn size(&self, diameter_px: f64, point: &Vector3<f64>) -> f64 {
        diameter_px * -self.photo.pose.to_camera(point).z / self.photo.principal_distance_px
    }

    pub fn observation(&self, free: usize, point: &str) -> Observation {
        super::observed(&self.photo.id, point, &self.targets[self.free[free].target])
    }

    pub fn doubtful(&self, free: usize, points: Vec<String>) -> Doubtful {
        let target = &self.targets[self.free[free].target];
        let (photo, number) = (self.photo.id.clone(), target.number());
        Doubtful { photo, u: target.u, v: target.v, target: number, points, reason: Doubt::Ambiguous }
    }
}
