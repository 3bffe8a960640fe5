//! Clusters of intersecting rays: unnamed targets in three photos or more.
//!
//! Pairs of targets on each other's epipolar lines ([`super::epipolar`]) are intersected, and each such place collects the
//! targets of the other photos that lie where it is seen. Clusters of many rays without a rival in any photo are sure and
//! take their targets out of the search. Of the rest large clusters win over the smaller ones that share targets with
//! them, and rivals of one size wait until one of them is impossible.
//!
//! A cluster is accepted if so many rays would not intersect by chance. A chance cluster is made of targets that are in no
//! true one: with h pairs tried among the targets left over and the share p of a photo that these cover with the
//! tolerance, h·C(v - 2, k - 2)·p^(k - 2) clusters of k rays among v photos are expected by chance.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;

use super::epipolar::EpipolarIndex;
use super::free::{Free, FreeTargets, Matching, similar};
use crate::initial::intersection::{Intersection, Ray, intersect};
use crate::project::{Point, Project};

/// Targets as (photo, free target), ascending.
type Cluster = Vec<(usize, usize)>;

/// Two-ray intersections miss the other photos by more than the tolerance of a well-determined point.
const TWO_RAY_FACTOR: f64 = 2.5;
/// Chance clusters accepted, on average, per call.
const CHANCE: f64 = 0.1;
/// Smallest angle, 1.5°, at which the widest pair of rays of a new point meets.
const SMALLEST_ANGLE: f64 = 0.026;
/// How many other photos each photo is paired with.
const NEIGHBOURS: usize = 10;
/// Rays of a cluster that needs no comparison with others where no photo shows a second candidate.
const SURE: usize = 5;
/// Tolerances within which a target may be that of a cluster without a ray in its photo.
const CONTESTED: f64 = 2.0;
/// A rival fits about as well when its rms is below this multiple, and this share of the tolerance, of the cluster's.
const RIVAL_FACTOR: f64 = 2.0;
const RIVAL_SHARE: f64 = 0.2;

/// Input of the search: oriented photos with their free targets, and limits of a cluster.
pub(super) struct ClusterSearch<'a> {
    pub views: Vec<FreeTargets<'a>>,
    pub bounds: Option<[Vector3<f64>; 2]>,
    pub tolerance: f64,
    pub min_rays: usize,
}

/// Clusters found from pairs.
#[derive(Default)]
struct ClusterCandidates {
    /// Clusters beyond doubt, disjoint.
    sure: Vec<Cluster>,
    /// The others, with their rms in pixels.
    clusters: BTreeMap<Cluster, f64>,
    /// Pairs that met.
    tried: Vec<[(usize, usize); 2]>,
}

impl ClusterSearch<'_> {
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

    /// Photos to pair with each photo: the nearest ones.
    fn neighbours(&self, view: usize) -> Vec<usize> {
        let centre = |k: usize| self.views[k].photo.pose.centre;
        let mut others: Vec<usize> = (0..self.views.len()).filter(|&k| k != view).collect();
        others.sort_by(|&a, &b| (centre(a) - centre(view)).norm().total_cmp(&(centre(b) - centre(view)).norm()));
        others.truncate(NEIGHBOURS);
        others
    }

    /// The sure clusters at a tolerance that is doubled up to the one asked for: what stands out at the measurements' own
    /// noise is not lost among the candidates of a wide tolerance. At the last one also every other cluster.
    fn found(&mut self, narrowest: f64) -> ClusterCandidates {
        let mut found = ClusterCandidates::default();
        let mut settled: Vec<Vec<bool>> = self.views.iter().map(|v| vec![false; v.free.len()]).collect();
        let widest = self.tolerance;
        let mut tolerance = narrowest;
        while tolerance < widest {
            self.tolerance = tolerance;
            self.search(&mut found, &mut settled);
            found.clusters.clear();
            found.tried.clear();
            tolerance *= 2.0;
        }
        self.tolerance = widest;
        self.search(&mut found, &mut settled);
        found
    }

    /// Every cluster that some pair of targets leads to.
    fn search(&self, found: &mut ClusterCandidates, settled: &mut [Vec<bool>]) {
        let neighbours: Vec<Vec<usize>> = (0..self.views.len()).map(|k| self.neighbours(k)).collect();
        let reach = 2.0 * self.tolerance;
        for a in 0..self.views.len() {
            for &b in &neighbours[a] {
                if b < a && neighbours[b].contains(&a) || settled[a].iter().all(|s| *s) {
                    continue;
                }
                let (first, second) = (&self.views[a], &self.views[b]);
                let left: Vec<usize> = (0..second.free.len()).filter(|&j| !settled[b][j]).collect();
                let rays: Vec<[f64; 2]> = left.iter().map(|&j| second.free[j].ray).collect();
                let Some(band) = EpipolarIndex::new(&first.photo, &second.photo, &rays, reach) else { continue };
                for i in 0..first.free.len() {
                    if settled[a][i] {
                        continue;
                    }
                    let candidates = band.candidates(&first.photo, first.free[i].ray, reach);
                    for j in self.on_epipolar_line(a, i, b, candidates.into_iter().map(|k| left[k])) {
                        if settled[b][j] || settled[a][i] {
                            continue;
                        }
                        let pair = if a < b { [(a, i), (b, j)] } else { [(b, j), (a, i)] };
                        let Some((seed, _)) = self.meets(&pair.to_vec(), self.tolerance) else { continue };
                        found.tried.push(pair);
                        let Some((cluster, rms, alone)) = self.collected(&pair, &seed.point, settled) else {
                            continue;
                        };
                        if alone && cluster.len() >= SURE.max(self.min_rays) {
                            cluster.iter().for_each(|&(view, free)| settled[view][free] = true);
                            found.sure.push(cluster);
                        } else {
                            found.clusters.insert(cluster, rms);
                        }
                    }
                }
            }
        }
    }

    /// Those candidates in photo b that lie within twice the tolerance of the epipolar line and look alike.
    fn on_epipolar_line(&self, a: usize, i: usize, b: usize, candidates: impl Iterator<Item = usize>) -> Vec<usize> {
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
        candidates.filter(|&j| near(&second.free[j]) && same(&second.free[j])).collect()
    }

    /// The pair with the targets of the other photos that lie where its point is seen, the rms, and whether no photo shows
    /// a second candidate near any of them.
    fn collected(
        &self,
        pair: &[(usize, usize); 2],
        point: &Vector3<f64>,
        settled: &[Vec<bool>],
    ) -> Option<(Cluster, f64, bool)> {
        let free = |(view, k): (usize, usize)| &self.views[view].free[k];
        let sizes = [0, 1].map(|k| self.views[pair[k].0].size(free(pair[k]).diameter_px, point));
        if !similar(sizes[0], sizes[1]) {
            return None;
        }
        let (size, polarity) = (0.5 * (sizes[0] + sizes[1]), free(pair[0]).polarity);
        let mut cluster = Cluster::new();
        let mut place = *point;
        let mut alone = true;
        // Twice: the second time from the place that all rays of the first time give.
        for round in 0..2 {
            let radius = if round == 0 { TWO_RAY_FACTOR * self.tolerance } else { 1.5 * self.tolerance };
            cluster.clear();
            cluster.extend(pair);
            for (k, view) in self.views.iter().enumerate().filter(|(k, _)| pair.iter().all(|p| p.0 != *k)) {
                let fits = |f: &Free| f.polarity == polarity && similar(view.size(f.diameter_px, &place), size);
                let Some(image) = view.photo.pose.image(&place) else { continue };
                if let Some((f, more)) = view.nearest(image, radius, fits) {
                    // What belongs to a sure point is not asked again.
                    if settled[k][f] {
                        alone = false;
                        continue;
                    }
                    alone &= !more || round == 0;
                    cluster.push((k, f));
                }
            }
            cluster.sort_unstable();
            let rays: Vec<Ray> = cluster.iter().map(|&c| self.ray(c)).collect();
            place = intersect(&rays).ok()?.point;
        }
        let whole = cluster.len();
        let own = |(k, f): &(usize, usize)| {
            let view = &self.views[*k];
            let image = view.photo.pose.image(&place);
            image.is_some_and(|image| {
                view.nearest(image, 1.5 * self.tolerance, |_| true).is_some_and(|(other, more)| other == *f && !more)
            })
        };
        alone = alone && pair.iter().all(own);
        let (cluster, rms) = self.trimmed(cluster)?;
        alone &= cluster.len() == whole;
        Some((cluster, rms, alone))
    }

    /// The cluster without the rays beyond the tolerance, worst first; `None` if too few are left.
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

    /// Whether so many rays would hardly meet by chance among the targets left over, of which `pairs` met two by two.
    fn believable(&self, rays: usize, point: &Vector3<f64>, pairs: usize, left_over: &[usize]) -> bool {
        let showing = self.views.iter().filter(|v| v.photo.shows(point)).count().max(rays);
        let area = std::f64::consts::PI * self.tolerance * self.tolerance;
        let covered = |(v, count): (&FreeTargets, &usize)| {
            *count as f64 * area / (f64::from(v.photo.camera.width) * f64::from(v.photo.camera.height))
        };
        let share = self.views.iter().zip(left_over).map(covered).sum::<f64>() / self.views.len().max(1) as f64;
        let mut expected = pairs as f64;
        for k in 0..rays - 2 {
            expected *= share * (showing - 2 - k) as f64 / (k + 1) as f64;
        }
        expected < CHANCE
    }

    /// Disjoint clusters: the sure ones, then the largest first; and the targets in doubt between some.
    fn resolved(&self, found: &ClusterCandidates) -> (Vec<Cluster>, BTreeSet<(usize, usize)>) {
        let clusters = &found.clusters;
        let order = |cluster: &Cluster, rms: f64| (Reverse(cluster.len()), (rms * 1e6) as u64, cluster.clone());
        let mut used: BTreeSet<(usize, usize)> = found.sure.iter().flatten().copied().collect();
        let mut queue: BTreeSet<_> = clusters.iter().map(|(cluster, rms)| order(cluster, *rms)).collect();
        let mut of_target: BTreeMap<(usize, usize), Vec<&Cluster>> = BTreeMap::new();
        for cluster in clusters.keys() {
            cluster.iter().for_each(|&c| of_target.entry(c).or_default().push(cluster));
        }
        let mut taken = found.sure.clone();
        let mut waiting = Vec::new();
        let mut doubtful = BTreeSet::new();
        loop {
            let before = taken.len();
            // Targets of the larger clusters that wait: a smaller one must not take them.
            let mut kept: BTreeMap<(usize, usize), usize> = BTreeMap::new();
            while let Some((size, rms, cluster)) = queue.pop_first() {
                let rest: Cluster = cluster.iter().copied().filter(|c| !used.contains(c)).collect();
                if rest.len() < cluster.len() {
                    queue.extend(self.trimmed(rest).map(|(cluster, rms)| order(&cluster, rms)));
                    continue;
                }
                if cluster.iter().any(|c| kept.get(c).is_some_and(|size| *size > cluster.len())) {
                    waiting.push((size, rms, cluster));
                    continue;
                }
                // Rivals of the same size that fit about as well leave only what they share.
                let limit = RIVAL_FACTOR * rms as f64 + RIVAL_SHARE * self.tolerance * 1e6;
                let shared = cluster
                    .iter()
                    .flat_map(|c| of_target.get(c).map_or(&[][..], Vec::as_slice))
                    .filter(|rival| rival.len() == cluster.len() && **rival != &cluster)
                    .filter(|rival| rival.iter().all(|c| !used.contains(c)))
                    .filter(|rival| clusters[**rival] * 1e6 < limit)
                    .fold(cluster.clone(), |shared, rival| shared.into_iter().filter(|c| rival.contains(c)).collect());
                if shared.len() < self.min_rays {
                    for &target in &cluster {
                        kept.entry(target).or_insert(cluster.len());
                    }
                    waiting.push((size, rms, cluster));
                    continue;
                }
                used.extend(&cluster);
                doubtful.extend(cluster.iter().filter(|c| !shared.contains(c)));
                taken.push(shared);
            }
            if taken.len() == before {
                break;
            }
            // What was taken may have made a rival impossible.
            queue.extend(waiting.drain(..));
        }
        doubtful.extend(waiting.into_iter().flat_map(|(.., cluster)| cluster).filter(|c| !used.contains(c)));
        (taken, doubtful)
    }

    /// Gives up rays that two clusters lay claim to: where a cluster has no ray in a photo although its point appears beside
    /// a target of another cluster, that target may be either's; and rays beside which another target lies as near.
    fn release_contested(&self, taken: &mut Vec<Cluster>, doubtful: &mut BTreeSet<(usize, usize)>) {
        let owner: BTreeMap<(usize, usize), usize> =
            taken.iter().enumerate().flat_map(|(n, cluster)| cluster.iter().map(move |&c| (c, n))).collect();
        let mut contested = BTreeSet::new();
        for (n, cluster) in taken.iter().enumerate() {
            let rays: Vec<Ray> = cluster.iter().map(|&c| self.ray(c)).collect();
            let Ok(met) = intersect(&rays) else { continue };
            contested.extend(cluster.iter().filter(|c| self.has_rival(**c, &met.point)));
            for (k, view) in self.views.iter().enumerate().filter(|(k, _)| cluster.iter().all(|c| c.0 != *k)) {
                let Some(image) = view.photo.pose.image(&met.point) else { continue };
                if let Some((f, _)) = view.nearest(image, CONTESTED * self.tolerance, |_| true)
                    && owner.get(&(k, f)).is_some_and(|other| *other != n)
                {
                    contested.insert((k, f));
                }
            }
        }
        taken.iter_mut().for_each(|cluster| cluster.retain(|c| !contested.contains(c)));
        let min_rays = self.min_rays;
        taken.retain(|cluster| {
            let enough = cluster.len() >= min_rays;
            if !enough {
                doubtful.extend(cluster);
            }
            enough
        });
        doubtful.extend(contested);
    }

    /// Whether another target lies about as near to where a point appears as the one that was taken for it.
    fn has_rival(&self, (view, free): (usize, usize), point: &Vector3<f64>) -> bool {
        let view = &self.views[view];
        let Some(image) = view.photo.pose.image(point) else { return false };
        let [x, y] = view.free[free].ray;
        let own = (x - image[0]).hypot(y - image[1]) * view.photo.principal_distance_px;
        let radius = RIVAL_FACTOR * own + RIVAL_SHARE * self.tolerance;
        view.nearest(image, radius, |_| true).is_some_and(|(nearest, more)| more || nearest != free)
    }

    /// Names the accepted clusters.
    ///
    /// `narrowest` is the tolerance of the first search.
    pub fn resolve(&mut self, narrowest: f64, project: &Project, matching: &mut Matching) {
        let found = self.found(narrowest);
        let (mut taken, mut doubtful) = self.resolved(&found);
        self.release_contested(&mut taken, &mut doubtful);
        let accounted: BTreeSet<(usize, usize)> = taken.iter().flatten().copied().collect();
        let left_over: Vec<usize> = (0..self.views.len())
            .map(|k| (0..self.views[k].free.len()).filter(|&f| !accounted.contains(&(k, f))).count())
            .collect();
        let pairs = found.tried.iter().filter(|pair| pair.iter().all(|c| !accounted.contains(c))).count();
        let ids: BTreeSet<&str> = project.points.iter().map(|p| p.id.as_str()).collect();
        let mut names = (1..).map(|k| format!("u{k}")).filter(|name| !ids.contains(name.as_str()));
        for cluster in taken {
            let met = self.meets(&cluster, self.tolerance).filter(|(met, _)| met.angle >= SMALLEST_ANGLE);
            // The cluster's own pairs represent those that its targets may form by chance.
            let pairs = pairs + cluster.len();
            let Some((met, _)) = met.filter(|(m, _)| self.believable(cluster.len(), &m.point, pairs, &left_over))
            else {
                doubtful.extend(&cluster);
                continue;
            };
            let Some(id) = names.next() else { break };
            matching.observations.extend(cluster.iter().map(|&(view, free)| self.views[view].observation(free, &id)));
            matching.points.push(Point { id, xyz: Some(met.point.into()), ..Point::default() });
        }
        matching.doubtful.extend(doubtful.into_iter().map(|(view, free)| self.views[view].doubtful(free, Vec::new())));
    }
}
