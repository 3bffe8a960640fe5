//! Matches targets without a code by the geometry of oriented photos.
//!
//! First, points that have coordinates are looked for where they should appear. Then the free targets are searched for
//! clusters of rays that meet ([`super::cluster`]).

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::cluster::Search;
use super::known;
use super::photo::OrientedPhoto;
use super::{Doubt, Doubtful, PhotoTargets};
use crate::detection::{Polarity, Target};
use crate::error::Result;
use crate::initial::robust::{quantile, scale};
use crate::project::{Observation, Point, Project, Role};

/// Options of [`match_uncoded`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct MatchOptions {
    /// Largest distance of a target from where its point should appear, pixels; null: from the residuals of the
    /// measurements that are there.
    pub tolerance_px: Option<f64>,
    /// Fewest rays of a new point; not below 3, since any two rays may meet.
    pub min_rays: usize,
}

impl Default for MatchOptions {
    fn default() -> Self {
        Self { tolerance_px: None, min_rays: 3 }
    }
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
pub(super) struct Free {
    /// Place in the photo's list of targets.
    target: usize,
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
pub(super) struct View<'a> {
    /// Its orientation.
    pub photo: OrientedPhoto,
    targets: &'a [Target],
    /// Free targets, ascending by x.
    pub free: Vec<Free>,
}

/// Names targets of oriented photos that have no name yet.
///
/// `project` is oriented (better: adjusted) and holds the observations named so far; `targets` are all detected ones.
/// Targets where the project has a control point that no photo names yet are that point, as soon as three control points are named and seen in
/// their places. New points are called "u1", "u2" … as far as these identifiers are free; they have the diameter that their images show
/// where the project fixes the scale. Matching and adjusting take turns until nothing more is
/// found ([`super::rounds`]); the project is left as it is.
///
/// # Errors
/// Those of [`Project::validate`]. Photos without orientation, and targets of photos that do not exist, are passed over.
pub fn match_uncoded(project: &Project, targets: &[PhotoTargets], options: &MatchOptions) -> Result<Matching> {
    project.validate()?;
    Ok(super::rounds::settled(project, targets, options))
}

/// What is found with the orientations and points as they are.
pub(super) fn one_round(project: &Project, targets: &[PhotoTargets], options: &MatchOptions) -> Matching {
    let mut views = views(project, targets);
    let narrowest = tolerance_px(project, &views);
    let tolerance = options.tolerance_px.unwrap_or(narrowest);
    let mut matching = Matching::default();
    predict(project, &mut views, tolerance, &mut matching);
    views.iter_mut().for_each(|view| view.free.retain(|f| !f.coded));
    let mut search = Search { bounds: bounds(project), views, tolerance, min_rays: options.min_rays.max(3) };
    search.resolve(narrowest, project, &mut matching);
    matching
}

pub(super) fn views<'a>(project: &Project, targets: &'a [PhotoTargets]) -> Vec<View<'a>> {
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
        for (k, t) in found.targets.iter().enumerate() {
            let near = (0.25 * t.minor).max(1.0);
            if taken.iter().any(|[u, v]| (u - t.u).hypot(v - t.v) < near) {
                continue;
            }
            let Some(ray) = photo.ray([t.u, t.v]) else { continue };
            free.push(Free { target: k, ray, diameter_px: t.major, polarity: t.polarity, coded: t.code.is_some() });
        }
        free.sort_by(|a, b| a.ray[0].total_cmp(&b.ray[0]));
        views.push(View { photo, targets: &found.targets, free });
    }
    views
}

pub(super) fn tolerance_px(project: &Project, views: &[View]) -> f64 {
    let xyz: BTreeMap<&str, Vector3<f64>> =
        project.points.iter().filter_map(|p| Some((p.id.as_str(), Vector3::from(p.xyz?)))).collect();
    let by_id: BTreeMap<&str, &View> = views.iter().map(|v| (v.photo.id.as_str(), v)).collect();
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

impl View<'_> {
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

/// Whether two sizes at the object may be those of one target.
pub(super) fn similar(a: f64, b: f64) -> bool {
    a < SIZE_RATIO * b && b < SIZE_RATIO * a
}

/// Looks for points that have coordinates, and two rays to vouch for them or coordinates that are given ([`known`]), in the photos that lack them.
fn predict<'a>(project: &'a Project, views: &mut [View], tolerance: f64, matching: &mut Matching) {
    let mut seen = known::Seen::new();
    for o in project.observations.iter().filter(|o| o.enabled) {
        seen.entry(&o.point).or_default().push((&o.photo, [o.u, o.v]));
    }
    let mut claims: BTreeMap<(usize, usize), Vec<&str>> = BTreeMap::new();
    let mut claim = |at: (usize, usize), point: &'a str, alone: bool| {
        let claim = claims.entry(at).or_default();
        claim.push(point);
        if !alone {
            // Two targets where one is expected: a second claim without a name keeps both out.
            claim.push(point);
        }
    };
    let given = known::is_their_system(project, views, &seen, tolerance);
    for point in project.points.iter().filter(|point| given && point.role == Role::Control) {
        let rays = seen.get(point.id.as_str()).map_or(&[][..], Vec::as_slice);
        // Two rays vouch for a point by themselves.
        for (k, view) in views.iter().enumerate().filter(|_| rays.len() < 2) {
            if rays.iter().all(|(photo, _)| *photo != view.photo.id)
                && let Some((free, alone)) = known::target(view, point, tolerance)
            {
                claim((k, free), &point.id, alone);
            }
        }
    }
    for point in &project.points {
        let (Some(xyz), Some(rays)) = (point.xyz.map(Vector3::from), seen.get(point.id.as_str())) else { continue };
        if rays.len() < 2 || point.role == Role::Check {
            continue;
        }
        let sizes: Vec<f64> = views
            .iter()
            .flat_map(|view| {
                let here = rays.iter().filter(|(photo, _)| *photo == view.photo.id);
                here.filter_map(|(_, [u, v])| {
                    let target = view.targets.iter().find(|t| (t.u - u).hypot(t.v - v) < 1.0)?;
                    Some(view.size(target.major, &xyz))
                })
                .collect::<Vec<_>>()
            })
            .collect();
        for (k, view) in views.iter().enumerate() {
            if rays.iter().any(|(photo, _)| *photo == view.photo.id) {
                continue;
            }
            let Some(image) = view.photo.pose.image(&xyz) else { continue };
            let size = quantile(&sizes, 0.5);
            let fits = |f: &Free| sizes.is_empty() || similar(view.size(f.diameter_px, &xyz), size);
            if let Some((free, alone)) = view.nearest(image, tolerance, fits).map(|(f, more)| (f, !more)) {
                claim((k, free), &point.id, alone);
            }
        }
    }
    let mut used: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); views.len()];
    for ((k, free), points) in claims {
        used[k].insert(free);
        match points[..] {
            [point] => matching.observations.push(views[k].observation(free, point)),
            _ => {
                let names: BTreeSet<String> = points.iter().map(|p| (*p).to_string()).collect();
                matching.doubtful.push(views[k].doubtful(free, names.into_iter().collect()));
            }
        }
    }
    for (view, used) in views.iter_mut().zip(used) {
        let mut k = 0;
        view.free.retain(|_| {
            k += 1;
            !used.contains(&(k - 1))
        });
    }
}

/// Box of the points that have coordinates, widened by half its diagonal; none without two points.
fn bounds(project: &Project) -> Option<[Vector3<f64>; 2]> {
    let points: Vec<Vector3<f64>> = project.points.iter().filter_map(|p| p.xyz.map(Vector3::from)).collect();
    let first = *points.first()?;
    let low = points.iter().fold(first, |a, b| a.inf(b));
    let high = points.iter().fold(first, |a, b| a.sup(b));
    let margin = Vector3::repeat(0.5 * (high - low).norm());
    (points.len() > 1).then(|| [low - margin, high + margin])
}
