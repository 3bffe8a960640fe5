//! Matches targets without a code by the geometry of oriented photos.
//!
//! First, points that have coordinates are looked for where they should appear. Then the free targets are searched for
//! clusters of rays that meet ([`super::cluster`]).

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;

use super::PhotoTargets;
use super::cluster::ClusterSearch;
use super::free::{Free, FreeTargets, MatchOptions, Matching, similar, tolerance_px, views};
use super::known;
use crate::initial::robust::quantile;
use crate::project::{Project, Role};

/// Targets matched with the present orientations and points.
pub(super) fn one_round(project: &Project, targets: &[PhotoTargets], options: &MatchOptions) -> Matching {
    let mut views = views(project, targets);
    let narrowest = tolerance_px(project, &views);
    let tolerance = options.tolerance_px.unwrap_or(narrowest);
    let mut matching = Matching::default();
    predict(project, &mut views, tolerance, &mut matching);
    views.iter_mut().for_each(|view| view.free.retain(|f| !f.coded));
    let mut search = ClusterSearch { bounds: bounds(project), views, tolerance, min_rays: options.min_rays.max(3) };
    search.resolve(narrowest, project, &mut matching);
    matching
}

/// Looks for points that have coordinates, and two rays to vouch for them or coordinates that are given ([`known`]), in the photos that lack them.
fn predict<'a>(project: &'a Project, views: &mut [FreeTargets], tolerance: f64, matching: &mut Matching) {
    let mut seen = known::MeasuredPixels::new();
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

/// Box of the points that have coordinates, widened by half its diagonal; `None` without two points.
fn bounds(project: &Project) -> Option<[Vector3<f64>; 2]> {
    let points: Vec<Vector3<f64>> = project.points.iter().filter_map(|p| p.xyz.map(Vector3::from)).collect();
    let first = *points.first()?;
    let low = points.iter().fold(first, |a, b| a.inf(b));
    let high = points.iter().fold(first, |a, b| a.sup(b));
    let margin = Vector3::repeat(0.5 * (high - low).norm());
    (points.len() > 1).then(|| [low - margin, high + margin])
}
