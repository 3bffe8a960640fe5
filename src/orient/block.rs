//! The working state of an orientation: cameras with a principal distance to work with, photos that have a pose so far,
//! points that have coordinates so far, and which measurements agree with them.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};

use crate::camera::{ideal_from_pixel, pixel_from_camera_point};
use crate::initial::intersection::{Intersection, Ray, intersect};
use crate::initial::pose::image_jacobian;
use crate::initial::robust::scale;
use crate::initial::{Degeneracy, Pose};
use crate::project::{Camera, Interior, Parameter, Photo, Project, Role};

/// A measurement of a point in a photo.
#[derive(Clone, Debug)]
pub(super) struct BlockObservation {
    /// Photo, as its place in the project.
    pub photo: usize,
    /// Point, as its place in the project.
    pub point: usize,
    /// Pixel measured.
    pub pixel: [f64; 2],
    /// Ideal coordinates with the camera's present parameters.
    pub ray: Option<[f64; 2]>,
    /// A priori standard error, pixels.
    pub sigma_px: f64,
    /// Whether it agrees with the rest, as far as known.
    pub taken: bool,
}

/// A photo.
#[derive(Clone, Debug)]
pub(super) struct BlockPhoto {
    /// Camera, as its place in the project.
    pub camera: usize,
    /// Interior orientation of its own, where the photo has one.
    pub interior: Option<Interior>,
    /// Exterior orientation, so far.
    pub pose: Option<Pose>,
    /// Whether the orientation was given.
    pub given: bool,
    /// Its measurements.
    pub observations: Vec<usize>,
}

impl BlockPhoto {
    /// The photo with its interior orientation, for the camera models.
    pub fn as_photo(&self) -> Photo {
        Photo { interior: self.interior, enabled: true, ..Photo::default() }
    }
}

/// An object point of the block.
#[derive(Clone, Debug)]
pub(super) struct BlockPoint {
    /// Given coordinates that may be used, reduced by the origin.
    pub known: Option<Vector3<f64>>,
    /// Whether it is a control point.
    pub control: bool,
    /// Standard errors of given coordinates, as in the project.
    pub sigma: Option<[Option<f64>; 3]>,
    /// Coordinates, so far.
    pub xyz: Option<Vector3<f64>>,
    /// Its measurements.
    pub observations: Vec<usize>,
}

/// The photogrammetric block under orientation: cameras, photos and points with their present values.
#[derive(Clone, Debug)]
pub(super) struct OrientationBlock {
    /// Cameras with working values of their parameters, in the project's order.
    pub cameras: Vec<Camera>,
    /// Whether a camera's principal distance may be changed: it is missing, or free and not observed.
    pub adjustable: Vec<bool>,
    /// Principal distances given for adjustable cameras, pixels: information, though not exact.
    pub given_px: Vec<Option<f64>>,
    /// Photos in the project's order.
    pub photos: Vec<BlockPhoto>,
    /// Points in the project's order.
    pub points: Vec<BlockPoint>,
    /// Enabled measurements.
    pub observations: Vec<BlockObservation>,
    /// Origin to which coordinates are reduced, so that large ones lose no digits.
    pub origin: Vector3<f64>,
    /// Whether poses and points are in the system of the given coordinates.
    pub anchored: bool,
    /// Robust standard deviation of the residuals, pixels; `None` before anything was compared.
    pub noise_px: Option<f64>,
}

/// Tolerances within which a ray is near the point of a pair: two rays place a point less well than all of them.
pub(super) const NEAR_A_PAIR: f64 = 4.0;
/// Among so many rays no other set is looked for once this share of them meets.
const MANY: usize = 5;
const MOST: f64 = 0.7;
/// Disagreement, as a share of the longer side of the photo, that unmodelled distortion and a rough principal distance
/// may cause.
const ROUGH: f64 = 4e-3;
/// Tangent of the angle off the axis, 75 degrees, within which rays of a wide lens give initial values: farther out, ideal coordinates grow without
/// bound and with them their noise. All measurements are compared and adjusted.
const WIDE: f64 = 3.7;
/// Robust standard deviations, and pixels in any case, within which a measurement agrees.
const AGREEING: f64 = 6.5;
const SMALLEST_LIMIT_PX: f64 = 0.25;
/// Robust standard deviations, and pixels in any case, beyond which a measurement is called wrong.
const WRONG: f64 = 15.0;
const SMALLEST_WRONG_PX: f64 = 1.5;

/// Principal distance in pixels.
pub(super) fn principal_distance_px(camera: &Camera) -> Option<f64> {
    camera.principal_distance_px().filter(|px| px.is_finite() && *px > 0.0)
}

/// Sets the principal distance in pixels.
pub(super) fn set_principal_distance_px(camera: &mut Camera, px: f64) {
    camera.set_principal_distance_px(px);
}

/// The longer side of the sensor grid in pixels.
pub(super) fn longer_side(camera: &Camera) -> f64 {
    f64::from(camera.width.max(camera.height))
}

/// Whether the orientation may change a camera's principal distance: it is missing, or free and not observed.
fn adjustable(camera: &Camera) -> bool {
    let names = [Parameter::C, Parameter::F, Parameter::Fx, Parameter::Fy];
    principal_distance_px(camera).is_none()
        || names.iter().any(|p| camera.free.contains(p)) && !names.iter().any(|p| camera.sigma.contains_key(p))
}

fn index<'a>(ids: impl Iterator<Item = &'a String>) -> BTreeMap<&'a str, usize> {
    ids.enumerate().map(|(k, id)| (id.as_str(), k)).collect()
}

impl OrientationBlock {
    /// The state at the start: what is given, nothing else. The project is valid.
    pub fn new(project: &Project) -> Self {
        let camera_index = index(project.cameras.iter().map(|c| &c.id));
        let photo_index = index(project.photos.iter().map(|p| &p.id));
        let point_index = index(project.points.iter().map(|p| &p.id));
        let mut photos: Vec<BlockPhoto> = project
            .photos
            .iter()
            .map(|photo| {
                let pose = Pose::of_photo(photo);
                let camera = camera_index.get(photo.camera.as_str()).copied().unwrap_or_default();
                BlockPhoto { camera, interior: photo.interior, pose, given: pose.is_some(), observations: Vec::new() }
            })
            .collect();
        let given: Vec<Option<Vector3<f64>>> = project
            .points
            .iter()
            // A check point's coordinates are for comparing only.
            .map(|p| p.xyz.filter(|xyz| p.role != Role::Check && xyz.iter().all(|x| x.is_finite())).map(Into::into))
            .collect();
        let known: Vec<Vector3<f64>> = given.iter().flatten().copied().collect();
        let centres: Vec<Vector3<f64>> = photos.iter().filter_map(|v| v.pose.map(|p| p.centre)).collect();
        let all = if known.is_empty() { &centres } else { &known };
        let origin = all.iter().sum::<Vector3<f64>>() / all.len().max(1) as f64;
        for block_photo in &mut photos {
            if let Some(pose) = &mut block_photo.pose {
                pose.centre -= origin;
            }
        }
        let mut points: Vec<BlockPoint> = project
            .points
            .iter()
            .zip(given)
            .map(|(p, xyz)| BlockPoint {
                known: xyz.map(|x| x - origin),
                control: p.role == Role::Control,
                sigma: p.sigma,
                xyz: None,
                observations: Vec::new(),
            })
            .collect();
        let aside = super::aside::of(project);
        let mut observations: Vec<BlockObservation> = Vec::new();
        for row in &project.observations {
            let ids = photo_index.get(row.photo.as_str()).zip(point_index.get(row.point.as_str()));
            // Observations that an earlier orientation set aside are tested again.
            let offered = super::aside::is_offered(&aside, row);
            let Some((&photo, &point)) = ids.filter(|(photo, _)| offered && project.photos[**photo].enabled) else {
                continue;
            };
            photos[photo].observations.push(observations.len());
            points[point].observations.push(observations.len());
            let [su, sv] = row.sigma.both();
            let sigma_px = (0.5 * (su * su + sv * sv)).sqrt();
            let pixel = [row.u, row.v];
            observations.push(BlockObservation { photo, point, pixel, ray: None, sigma_px, taken: true });
        }
        let mut block = Self {
            cameras: project.cameras.clone(),
            adjustable: project.cameras.iter().map(adjustable).collect(),
            given_px: project.cameras.iter().map(|c| principal_distance_px(c).filter(|_| adjustable(c))).collect(),
            photos,
            points,
            observations,
            origin,
            anchored: false,
            noise_px: None,
        };
        block.refresh_rays();
        block
    }

    /// Recomputes ideal coordinates after a camera changed.
    pub fn refresh_rays(&mut self) {
        let as_taken = |block_photo: &BlockPhoto| self.cameras[block_photo.camera].of_photo(&block_photo.as_photo());
        let cameras: Vec<Camera> = self.photos.iter().map(as_taken).collect();
        for observation in &mut self.observations {
            let camera = &cameras[observation.photo];
            observation.ray = ideal_from_pixel(camera, observation.pixel);
            if camera.interior.model().is_wide {
                observation.ray = observation.ray.filter(|[x, y]| x * x + y * y < WIDE * WIDE);
            }
        }
    }

    /// How much smaller a step in ideal coordinates is in the image of a wide lens than at its axis, along the radius: cos² θ. 1 for others.
    fn shrinking(&self, observation: usize) -> f64 {
        let s = &self.observations[observation];
        let is_wide = self.cameras[self.photos[s.photo].camera].interior.model().is_wide;
        s.ray.filter(|_| is_wide).map_or(1.0, |[x, y]| 1.0 / (1.0 + x * x + y * y))
    }

    /// Principal distance of a photo's camera in pixels; what turns ideal coordinates into pixels.
    pub fn pixels_per_unit(&self, photo: usize) -> f64 {
        let camera = &self.cameras[self.photos[photo].camera];
        principal_distance_px(camera).unwrap_or_else(|| longer_side(camera))
    }

    /// Disagreement in pixels that is not held against a measurement: a share of the photo while nothing is known,
    /// then what the residuals say.
    pub fn tolerance_px(&self, photo: usize) -> f64 {
        let rough = ROUGH * longer_side(&self.cameras[self.photos[photo].camera]);
        self.noise_px.map_or(rough, |noise| (5.0 * noise).clamp(0.5, 3.0 * rough))
    }

    /// Photos that have a pose.
    pub fn oriented(&self) -> usize {
        self.photos.iter().filter(|v| v.pose.is_some() && !v.observations.is_empty()).count()
    }

    /// Measurements that agree with a pose and a point.
    pub fn agreeing(&self) -> usize {
        (0..self.observations.len()).filter(|&s| self.observations[s].taken && self.misfit_px(s).is_some()).count()
    }

    /// Takes the given coordinates as the points' own and is in their system from now on.
    pub fn anchor(&mut self) {
        self.anchored = true;
        for block_point in &mut self.points {
            block_point.xyz = block_point.known.or(block_point.xyz);
        }
    }

    /// Object points and ideal coordinates of a photo's measurements of points that have coordinates.
    pub fn determined(&self, photo: usize) -> (Vec<usize>, Vec<Vector3<f64>>, Vec<[f64; 2]>) {
        let (mut observations, mut object, mut image) = (Vec::new(), Vec::new(), Vec::new());
        for &s in &self.photos[photo].observations {
            if let (Some(xyz), Some(ray)) = (self.points[self.observations[s].point].xyz, self.observations[s].ray) {
                observations.push(s);
                object.push(xyz);
                image.push(ray);
            }
        }
        (observations, object, image)
    }

    /// Measurements of the points that both photos show.
    pub fn common(&self, first: usize, second: usize) -> Vec<(usize, usize)> {
        let measured = |s: &&usize| self.observations[**s].ray.is_some();
        let mut of_point: BTreeMap<usize, usize> = BTreeMap::new();
        of_point
            .extend(self.photos[second].observations.iter().filter(measured).map(|&s| (self.observations[s].point, s)));
        let firsts = self.photos[first].observations.iter().filter(measured);
        firsts.filter_map(|&a| of_point.get(&self.observations[a].point).map(|&b| (a, b))).collect()
    }

    /// Residual of a measurement in pixels; none while its photo or point is not determined, infinite behind the
    /// camera.
    pub fn misfit_px(&self, observation: usize) -> Option<f64> {
        let s = &self.observations[observation];
        let (pose, xyz) = (self.photos[s.photo].pose?, self.points[s.point].xyz?);
        let block_photo = &self.photos[s.photo];
        if self.cameras[block_photo.camera].interior.model().is_wide {
            let camera = self.cameras[block_photo.camera].of_photo(&block_photo.as_photo());
            let seen = pixel_from_camera_point(&camera, pose.to_camera(&xyz));
            return Some(seen.map_or(f64::INFINITY, |[u, v]| (u - s.pixel[0]).hypot(v - s.pixel[1])));
        }
        let ray = s.ray?;
        Some(pose.misfit(&xyz, ray) * self.pixels_per_unit(s.photo))
    }

    /// Rays of a point in oriented photos, with the measurement each belongs to.
    pub fn rays(&self, point: usize) -> (Vec<usize>, Vec<Ray>) {
        let mut which = Vec::new();
        let mut rays = Vec::new();
        for &s in &self.points[point].observations {
            let observation = &self.observations[s];
            if let (Some(pose), Some(image)) = (self.photos[observation.photo].pose, observation.ray) {
                which.push(s);
                rays.push(Ray {
                    pose,
                    image,
                    weight: (self.pixels_per_unit(observation.photo) * self.shrinking(s)).powi(2),
                });
            }
        }
        (which, rays)
    }

    /// The intersection of the largest set of a point's rays that meet, and the measurements that do not take part.
    ///
    /// Where not all rays meet, every pair that meets collects the rays that pass near its point. Two rays are enough of
    /// a set only where there are two, or where one pair alone of three meets.
    ///
    /// # Errors
    /// As [`intersect`]; [`Degeneracy::NoSolution`] if no set of rays stands out.
    pub fn intersection(&self, point: usize) -> Result<(Intersection, Vec<usize>), Degeneracy> {
        let (which, rays) = self.rays(point);
        let tolerance: Vec<f64> = which.iter().map(|&s| self.tolerance_px(self.observations[s].photo)).collect();
        let chosen = |set: &[usize]| intersect(&set.iter().map(|&k| rays[k]).collect::<Vec<_>>());
        let excess = |found: &Vector3<f64>, k: usize| {
            rays[k].pose.misfit(found, rays[k].image) * rays[k].weight.sqrt() / tolerance[k]
        };
        let everything: Vec<usize> = (0..rays.len()).collect();
        let all = chosen(&everything);
        if let Ok(found) = &all
            && everything.iter().all(|&k| excess(&found.point, k) <= 1.0)
        {
            return Ok((all?, Vec::new()));
        }
        if rays.len() < 3 {
            return Err(all.err().unwrap_or(Degeneracy::NoSolution));
        }
        let mut best: Option<(usize, f64, Intersection, Vec<usize>)> = None;
        let mut distinct = 0;
        let mut largest: Vec<Vec<usize>> = Vec::new();
        for [a, b] in pairs_of(rays.len()) {
            let Ok(seed) = chosen(&[a, b]) else { continue };
            if excess(&seed.point, a).max(excess(&seed.point, b)) > 1.0 {
                continue;
            }
            let mut set: Vec<usize> =
                everything.iter().copied().filter(|&k| excess(&seed.point, k) <= NEAR_A_PAIR).collect();
            let mut settled = None;
            while set.len() >= 2 {
                let Ok(found) = chosen(&set) else { break };
                let worst = (0..set.len())
                    .max_by(|&i, &j| excess(&found.point, set[i]).total_cmp(&excess(&found.point, set[j])));
                match worst.filter(|&k| excess(&found.point, set[k]) > 1.0) {
                    Some(k) => drop(set.remove(k)),
                    None => {
                        settled = Some(found);
                        break;
                    }
                }
            }
            let Some(found) = settled else { continue };
            if rays.len() >= MANY && set.len() as f64 >= MOST * rays.len() as f64 {
                let out = everything.iter().filter(|k| !set.contains(k)).map(|&k| which[k]).collect();
                return Ok((found, out));
            }
            let rms = set.iter().map(|&k| excess(&found.point, k).powi(2)).sum::<f64>() / set.len() as f64;
            let better = best.as_ref().is_none_or(|(n, least, ..)| set.len() > *n || set.len() == *n && rms < *least);
            let same = best.as_ref().is_some_and(|(.., other)| *other == set);
            let as_large = best.as_ref().is_some_and(|(n, ..)| set.len() == *n);
            if better && !as_large {
                distinct = 1;
                largest.clear();
            } else if as_large && !same {
                distinct += 1;
            }
            if better || as_large {
                largest.push(set.clone());
            }
            if better {
                best = Some((set.len(), rms, found, set));
            }
        }
        let Some((size, _, found, set)) = best else { return Err(all.err().unwrap_or(Degeneracy::NoSolution)) };
        // As many rays meet elsewhere: nothing decides between the two places.
        let tied = largest.iter().any(|other| !other.iter().any(|k| set.contains(k)));
        if tied || size == 2 && (rays.len() > 3 || distinct > 1) {
            return Err(Degeneracy::NoSolution);
        }
        let out = everything.iter().filter(|k| !set.contains(k)).map(|&k| which[k]).collect();
        Ok((found, out))
    }

    /// Intersects every point that has no coordinates yet; `smallest` is the least angle between rays to accept.
    pub fn intersect_new(&mut self, smallest: f64) {
        for point in 0..self.points.len() {
            if self.points[point].xyz.is_some() || self.points[point].observations.len() < 2 {
                continue;
            }
            if let Ok((found, out)) = self.intersection(point)
                && found.angle >= smallest
            {
                self.points[point].xyz = Some(found.point);
                // One of them, a thousand pixels off, would make the next adjustment fail.
                out.into_iter().for_each(|observation| self.observations[observation].taken = false);
            }
        }
    }

    /// Compares every measurement with the present poses and points: keeps the noise, and takes those measurements
    /// that agree within [`AGREEING`] robust standard deviations. A point that many of its rays disagree with is
    /// intersected anew from the largest set of rays that meet, since it may be the point that is wrong.
    pub fn review(&mut self) {
        let lengths: Vec<f64> = (0..self.observations.len()).filter_map(|s| self.misfit_px(s)).collect();
        if lengths.is_empty() {
            return;
        }
        let noise = scale(&lengths, 0) * self.shrinkage();
        let mut sigmas: Vec<f64> = self.observations.iter().map(|s| s.sigma_px).collect();
        let middle = sigmas.len() / 2;
        let a_priori = *sigmas.select_nth_unstable_by(middle, f64::total_cmp).1;
        let side = self.cameras.iter().map(longer_side).fold(0.0, f64::max);
        // Residuals of few rays a point are small by themselves: the measurements are not better than stated.
        self.noise_px = Some(noise.max(a_priori.min(0.1 * ROUGH * side)));
        for point in 0..self.points.len() {
            let held = self.anchored && self.points[point].known.is_some();
            let agreeing = |block: &Self| {
                let observations = block.points[point].observations.iter();
                observations.filter(|&&s| block.misfit_px(s).is_some_and(|misfit| misfit <= block.limit_px(s))).count()
            };
            let compared = self.points[point].observations.iter().filter(|&&s| self.misfit_px(s).is_some()).count();
            let before = agreeing(self);
            let stands = compared >= MANY && before as f64 >= MOST * compared as f64;
            if held || stands || before == compared {
                continue;
            }
            let old = self.points[point].xyz;
            self.points[point].xyz = self.intersection(point).ok().map(|(found, _)| found.point);
            if before >= 2 && agreeing(self) <= before {
                self.points[point].xyz = old;
            }
        }
        for s in 0..self.observations.len() {
            if let Some(misfit) = self.misfit_px(s) {
                self.observations[s].taken = misfit <= self.limit_px(s);
            }
        }
    }

    /// Largest misfit of a measurement that agrees. Wide, because what a rough model leaves is systematic: it is the
    /// wrong names, tens of pixels off, that have to stay out.
    pub fn limit_px(&self, observation: usize) -> f64 {
        let camera = &self.cameras[self.photos[self.observations[observation].photo].camera];
        let own = self.observations[observation].sigma_px.min(ROUGH * longer_side(camera));
        let limit = (AGREEING * self.noise_px.unwrap_or(own).max(own)).max(SMALLEST_LIMIT_PX);
        limit.hypot(AGREEING * self.control_px(observation))
    }

    /// Standard error, in the photo, of where given coordinates of a control point place it, the larger half axis: what is measured there
    /// may be off by so much without being wrong. 0 for other points, and for coordinates that are held.
    fn control_px(&self, observation: usize) -> f64 {
        let s = &self.observations[observation];
        let block_point = &self.points[s.point];
        let sigma = block_point.sigma.filter(|_| self.anchored && block_point.control && block_point.known.is_some());
        let (Some(sigma), Some(pose), Some(xyz)) = (sigma, self.photos[s.photo].pose, block_point.xyz) else {
            return 0.0;
        };
        let sigma = Vector3::from(sigma.map(|s| s.filter(|s| *s > 0.0 && s.is_finite()).unwrap_or(0.0)));
        let to_camera = pose.to_camera(&xyz);
        if sigma == Vector3::zeros() || to_camera.z >= 0.0 {
            return 0.0;
        }
        let by_point = image_jacobian(&to_camera) * pose.object_to_camera * Matrix3::from_diagonal(&sigma);
        let c = by_point * by_point.transpose();
        let (mean, half) = (0.5 * (c.m11 + c.m22), 0.5 * (c.m11 - c.m22));
        let larger = (mean + half.hypot(c.m12)).sqrt() * self.pixels_per_unit(s.photo) * self.shrinking(observation);
        if larger.is_finite() { larger } else { 0.0 }
    }

    /// Whether a measurement is called wrong: it is far from its point, or its point's other rays leave no place to
    /// compare it with. Tails of real measurements, which an adjustment's own tests judge, are not.
    pub fn is_wrong(&self, observation: usize) -> bool {
        let noise = self.noise_px.unwrap_or(0.0).max(self.observations[observation].sigma_px);
        let limit = (WRONG * noise).max(SMALLEST_WRONG_PX).hypot(AGREEING * self.control_px(observation));
        !self.observations[observation].taken && self.misfit_px(observation).is_some_and(|misfit| misfit > limit)
    }

    /// Factor for residuals that accounts for the estimated parameters: √(n/(n - u)), at most 3.
    fn shrinkage(&self) -> f64 {
        let (compared, unknowns) = self.counts();
        let spare = (2 * compared).saturating_sub(unknowns).max(1);
        (2.0 * compared as f64 / spare as f64).sqrt().clamp(1.0, 3.0)
    }

    /// Measurements in oriented photos of points that two of these show, or that are known.
    pub fn offered(&self) -> usize {
        let rays = |m: &BlockPoint| {
            m.observations.iter().filter(|&&s| self.photos[self.observations[s].photo].pose.is_some()).count()
        };
        let counted = self.points.iter().map(|m| (rays(m), self.anchored && m.known.is_some()));
        counted.filter(|&(rays, known)| rays > 1 || known).map(|(rays, _)| rays).sum()
    }

    /// Measurements in oriented photos of points that have coordinates and two such measurements, and the unknowns of
    /// these photos and points.
    pub fn counts(&self) -> (usize, usize) {
        let (mut compared, mut points) = (0, 0);
        for block_point in self.points.iter().filter(|m| m.xyz.is_some()) {
            let rays = block_point
                .observations
                .iter()
                .filter(|&&s| self.photos[self.observations[s].photo].pose.is_some())
                .count();
            if rays >= 2 {
                compared += rays;
                points += usize::from(!(self.anchored && block_point.control));
            }
        }
        (compared, 6 * self.photos.iter().filter(|v| v.pose.is_some() && !v.given).count() + 3 * points)
    }
}

/// Pairs of `count` rays: all of few, the ones with every later distance in the list for many.
pub(super) fn pairs_of(count: usize) -> Vec<[usize; 2]> {
    if count <= 8 {
        return (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b])).collect();
    }
    let half = count / 2;
    (0..count).flat_map(|a| [[a, (a + half) % count], [a, (a + half / 2 + 1) % count]]).collect()
}
