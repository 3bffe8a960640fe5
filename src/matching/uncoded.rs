//! Targets without a code: who is who, from the geometry of oriented photos.
//!
//! First, points that have coordinates are looked for where they should appear. Then pairs of targets on each other's
//! epipolar lines are intersected, and each such place collects the targets of the other photos that lie where it is
//! seen: a cluster of rays. Large clusters win over the smaller ones that share targets with them. A cluster is
//! believed when so many rays would not meet by chance: with h pairs tried and the share p of a photo that its free
//! targets cover with the tolerance, h·C(v-2, k-2)·p^(k-2) clusters of k rays among v photos are expected by chance.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::photo::OrientedPhoto;
use super::{Doubt, Doubtful, PhotoTargets};
use crate::detection::{Polarity, Target};
use crate::error::Result;
use crate::initial::intersection::{Intersection, Ray, intersect};
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
/// Two-ray intersections miss the other photos by more than the tolerance of a well-determined point.
const TWO_RAY_FACTOR: f64 = 2.5;
/// Chance clusters accepted, on average, per call.
const CHANCE: f64 = 0.1;
/// Largest ratio of target sizes, brought to the object, within one point.
const SIZE_RATIO: f64 = 1.6;
/// Smallest angle, 1.5°, at which the widest pair of rays of a new point meets.
const SMALLEST_ANGLE: f64 = 0.026;
/// How many other photos each photo is paired with.
const NEIGHBOURS: usize = 10;

/// A target on offer.
#[derive(Clone, Copy, Debug)]
struct Free {
    /// Place in the photo's list of targets.
    target: usize,
    ray: [f64; 2],
    diameter_px: f64,
    polarity: Polarity,
    coded: bool,
}

struct View<'a> {
    photo: OrientedPhoto,
    targets: &'a [Target],
    /// Free targets, ascending by x.
    free: Vec<Free>,
}

/// Targets as (photo, free target), ascending.
type Cluster = Vec<(usize, usize)>;

/// Names targets of oriented photos that have no name yet.
///
/// `project` is oriented (better: adjusted) and holds the observations named so far; `targets` are all detected ones.
/// New points are called "u1", "u2" … as far as these identifiers are free.
///
/// # Errors
/// Those of [`Project::validate`]. Photos without orientation, and targets of photos that do not exist, are passed over.
pub fn match_uncoded(project: &Project, targets: &[PhotoTargets], options: &MatchOptions) -> Result<Matching> {
    project.validate()?;
    let mut views = views(project, targets);
    let tolerance = options.tolerance_px.unwrap_or_else(|| tolerance_px(project, &views));
    let mut matching = Matching::default();
    predict(project, &mut views, tolerance, &mut matching);
    views.iter_mut().for_each(|view| view.free.retain(|f| !f.coded));
    let search = Search { bounds: bounds(project), views, tolerance, min_rays: options.min_rays.max(3) };
    search.resolve(project, &mut matching);
    Ok(matching)
}

fn views<'a>(project: &Project, targets: &'a [PhotoTargets]) -> Vec<View<'a>> {
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

fn tolerance_px(project: &Project, views: &[View]) -> f64 {
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
    fn nearest(&self, image: [f64; 2], radius_px: f64, fits: impl Fn(&Free) -> bool) -> Option<(usize, bool)> {
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
    fn size(&self, diameter_px: f64, point: &Vector3<f64>) -> f64 {
        diameter_px * -self.photo.pose.to_camera(point).z / self.photo.principal_distance_px
    }

    fn observation(&self, free: usize, point: &str) -> Observation {
        super::observed(&self.photo.id, point, &self.targets[self.free[free].target])
    }

    fn doubtful(&self, free: usize, points: Vec<String>) -> Doubtful {
        let target = &self.targets[self.free[free].target];
        let (photo, number) = (self.photo.id.clone(), target.number());
        Doubtful { photo, u: target.u, v: target.v, target: number, points, reason: Doubt::Ambiguous }
    }
}

fn similar(a: f64, b: f64) -> bool {
    a < SIZE_RATIO * b && b < SIZE_RATIO * a
}

/// Looks for points that have coordinates, and two rays to vouch for them, in the photos that lack them.
fn predict(project: &Project, views: &mut [View], tolerance: f64, matching: &mut Matching) {
    let mut seen: BTreeMap<&str, Vec<(&str, [f64; 2])>> = BTreeMap::new();
    for o in project.observations.iter().filter(|o| o.enabled) {
        seen.entry(&o.point).or_default().push((&o.photo, [o.u, o.v]));
    }
    let mut claims: BTreeMap<(usize, usize), Vec<&str>> = BTreeMap::new();
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
                let claim = claims.entry((k, free)).or_default();
                claim.push(&point.id);
                if !alone {
                    // Two targets where one is expected: a second claim without a name keeps both out.
                    claim.push(&point.id);
                }
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

struct Search<'a> {
    views: Vec<View<'a>>,
    bounds: Option<[Vector3<f64>; 2]>,
    tolerance: f64,
    min_rays: usize,
}

impl Search<'_> {
    fn ray(&self, (view, free): (usize, usize)) -> Ray {
        let v = &self.views[view];
        Ray { pose: v.photo.pose, image: v.free[free].ray, weight: v.photo.principal_distance_px.powi(2) }
    }

    /// The rays' intersection when all of them meet within the tolerance; its rms in pixels.
    fn meets(&self, cluster: &Cluster, tolerance: f64) -> Option<(Intersection, f64)> {
        let rays: Vec<Ray> = cluster.iter().map(|&c| self.ray(c)).collect();
        let found = intersect(&rays).ok()?;
        let squares: Vec<f64> =
            found.residuals.iter().zip(&rays).map(|(r, ray)| (r[0] * r[0] + r[1] * r[1]) * ray.weight).collect();
        let within = squares.iter().all(|s| *s <= tolerance * tolerance);
        let inside = self.bounds.is_none_or(|[low, high]| found.point >= low && found.point <= high);
        let rms = (squares.iter().sum::<f64>() / rays.len() as f64).sqrt();
        (within && inside).then_some((found, rms))
    }

    /// Photos worth pairing with each photo: the nearest ones that look at the object from another side.
    fn neighbours(&self, view: usize) -> Vec<usize> {
        let centre = |k: usize| self.views[k].photo.pose.centre;
        let mut others: Vec<usize> = (0..self.views.len()).filter(|&k| k != view).collect();
        others.sort_by(|&a, &b| (centre(a) - centre(view)).norm().total_cmp(&(centre(b) - centre(view)).norm()));
        others.truncate(NEIGHBOURS);
        others
    }

    /// Every cluster that some pair of targets leads to, with its rms, and the number of pairs tried.
    fn clusters(&self) -> (BTreeMap<Cluster, f64>, usize) {
        let mut clusters = BTreeMap::new();
        let mut tried = 0;
        for a in 0..self.views.len() {
            for b in self.neighbours(a) {
                if b < a && self.neighbours(b).contains(&a) {
                    continue;
                }
                for i in 0..self.views[a].free.len() {
                    for j in self.on_epipolar_line(a, i, b) {
                        let pair = if a < b { vec![(a, i), (b, j)] } else { vec![(b, j), (a, i)] };
                        let Some((seed, _)) = self.meets(&pair, self.tolerance) else { continue };
                        tried += 1;
                        if let Some((cluster, rms)) = self.collected(&pair, &seed.point) {
                            clusters.insert(cluster, rms);
                        }
                    }
                }
            }
        }
        (clusters, tried)
    }

    fn on_epipolar_line(&self, a: usize, i: usize, b: usize) -> Vec<usize> {
        let (first, second) = (&self.views[a], &self.views[b]);
        let (from, to) = (&first.photo.pose, &second.photo.pose);
        let base = to.object_to_camera * (from.centre - to.centre);
        let direction = to.object_to_camera * from.ray(first.free[i].ray);
        // Line through the images of the other centre and of the ray; homogeneous coordinates (x, y, -1).
        let line = base.cross(&direction);
        let slope = line.x.hypot(line.y);
        let limit = 2.0 * self.tolerance / second.photo.principal_distance_px * slope;
        let near = |f: &Free| (line.x * f.ray[0] + line.y * f.ray[1] - line.z).abs() <= limit;
        let same = |f: &Free| f.polarity == first.free[i].polarity;
        (0..second.free.len()).filter(|&j| near(&second.free[j]) && same(&second.free[j])).collect()
    }

    /// The pair with the targets of the other photos that lie where its point is seen.
    fn collected(&self, pair: &Cluster, point: &Vector3<f64>) -> Option<(Cluster, f64)> {
        let free = |(view, k): (usize, usize)| &self.views[view].free[k];
        let sizes = [0, 1].map(|k| self.views[pair[k].0].size(free(pair[k]).diameter_px, point));
        if !similar(sizes[0], sizes[1]) {
            return None;
        }
        let (size, polarity) = (0.5 * (sizes[0] + sizes[1]), free(pair[0]).polarity);
        let mut cluster = pair.clone();
        let mut place = *point;
        // Twice: the second time from the place that all rays of the first time give.
        for round in 0..2 {
            let radius = if round == 0 { TWO_RAY_FACTOR * self.tolerance } else { 1.5 * self.tolerance };
            cluster.clone_from(pair);
            for (k, view) in self.views.iter().enumerate().filter(|(k, _)| pair.iter().all(|p| p.0 != *k)) {
                let fits = |f: &Free| f.polarity == polarity && similar(view.size(f.diameter_px, &place), size);
                let seen = view.photo.pose.image(&place);
                cluster.extend(seen.and_then(|image| view.nearest(image, radius, fits)).map(|(f, _)| (k, f)));
            }
            cluster.sort_unstable();
            let rays: Vec<Ray> = cluster.iter().map(|&c| self.ray(c)).collect();
            place = intersect(&rays).ok()?.point;
        }
        self.trimmed(cluster)
    }

    /// The cluster without the rays beyond the tolerance, worst first; none when too few are left.
    fn trimmed(&self, mut cluster: Cluster) -> Option<(Cluster, f64)> {
        while cluster.len() >= self.min_rays {
            if let Some((_, rms)) = self.meets(&cluster, self.tolerance) {
                return Some((cluster, rms));
            }
            let rays: Vec<Ray> = cluster.iter().map(|&c| self.ray(c)).collect();
            let found = intersect(&rays).ok()?;
            let miss = |k: usize| found.residuals[k][0].hypot(found.residuals[k][1]) * rays[k].weight.sqrt();
            let worst = (0..rays.len()).max_by(|&a, &b| miss(a).total_cmp(&miss(b)))?;
            cluster.remove(worst);
        }
        None
    }

    /// Whether so many rays would hardly meet by chance.
    fn believable(&self, rays: usize, point: &Vector3<f64>, tried: usize) -> bool {
        let showing = self.views.iter().filter(|v| v.photo.shows(point)).count().max(rays);
        let area = std::f64::consts::PI * self.tolerance * self.tolerance;
        let covered = |v: &View| {
            v.free.len() as f64 * area / (f64::from(v.photo.camera.width) * f64::from(v.photo.camera.height))
        };
        let share = self.views.iter().map(covered).sum::<f64>() / self.views.len().max(1) as f64;
        let mut expected = tried as f64;
        for k in 0..rays - 2 {
            expected *= share * (showing - 2 - k) as f64 / (k + 1) as f64;
        }
        expected < CHANCE
    }

    /// Largest clusters first, each target once.
    fn resolve(&self, project: &Project, matching: &mut Matching) {
        let (clusters, tried) = self.clusters();
        let order = |cluster: &Cluster, rms: f64| (Reverse(cluster.len()), (rms * 1e6) as u64, cluster.clone());
        let mut queue: BTreeSet<_> = clusters.iter().map(|(cluster, rms)| order(cluster, *rms)).collect();
        let mut of_target: BTreeMap<(usize, usize), Vec<&Cluster>> = BTreeMap::new();
        for cluster in clusters.keys() {
            cluster.iter().for_each(|&c| of_target.entry(c).or_default().push(cluster));
        }
        let ids: BTreeSet<&str> = project.points.iter().map(|p| p.id.as_str()).collect();
        let mut names = (1..).map(|k| format!("u{k}")).filter(|name| !ids.contains(name.as_str()));
        let mut used: BTreeSet<(usize, usize)> = BTreeSet::new();
        let mut doubtful: BTreeSet<(usize, usize)> = BTreeSet::new();
        while let Some((_, rms, cluster)) = queue.pop_first() {
            let rest: Cluster = cluster.iter().copied().filter(|c| !used.contains(c)).collect();
            if rest.len() < cluster.len() {
                queue.extend(self.trimmed(rest).map(|(cluster, rms)| order(&cluster, rms)));
                continue;
            }
            // Rivals of the same size that fit about as well leave only what they share.
            let shared = cluster
                .iter()
                .flat_map(|c| of_target.get(c).map_or(&[][..], Vec::as_slice))
                .filter(|rival| rival.len() == cluster.len() && **rival != &cluster)
                .filter(|rival| rival.iter().all(|c| !used.contains(c)))
                .filter(|rival| clusters[**rival] * 1e6 < 2.0 * rms as f64 + 0.1 * self.tolerance * 1e6)
                .fold(cluster.clone(), |shared, rival| shared.into_iter().filter(|c| rival.contains(c)).collect());
            used.extend(&cluster);
            let found = self.meets(&shared, self.tolerance).filter(|(found, _)| found.angle >= SMALLEST_ANGLE);
            let enough = shared.len() >= self.min_rays;
            let Some((found, _)) = found.filter(|(f, _)| enough && self.believable(shared.len(), &f.point, tried))
            else {
                doubtful.extend(&cluster);
                continue;
            };
            doubtful.extend(cluster.iter().filter(|c| !shared.contains(c)));
            let Some(id) = names.next() else { break };
            matching.observations.extend(shared.iter().map(|&(view, free)| self.views[view].observation(free, &id)));
            matching.points.push(Point { id, xyz: Some(found.point.into()), ..Point::default() });
        }
        matching.doubtful.extend(doubtful.into_iter().map(|(view, free)| self.views[view].doubtful(free, Vec::new())));
    }
}
