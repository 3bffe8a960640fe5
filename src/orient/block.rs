//! The working state of an orientation: cameras with a principal distance to work with, photos that have a pose so far,
//! points that have coordinates so far, and which measurements agree with them.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use crate::camera::ideal_from_pixel;
use crate::initial::intersection::{Intersection, Ray, intersect};
use crate::initial::robust::scale;
use crate::initial::{Degeneracy, Pose};
use crate::project::{Camera, Interior, Parameter, Project, Role};

/// A measurement of a point in a photo.
#[derive(Clone, Debug)]
pub(super) struct Sight {
    /// Photo, as its place in the project.
    pub photo: usize,
    /// Point, as its place in the project.
    pub point: usize,
    /// Pixel measured.
    pub pixel: [f64; 2],
    /// Ideal coordinates with the camera's present parameters.
    pub ray: Option<[f64; 2]>,
    /// Whether it agrees with the rest, as far as known.
    pub taken: bool,
}

/// A photo.
#[derive(Clone, Debug)]
pub(super) struct View {
    /// Camera, as its place in the project.
    pub camera: usize,
    /// Interior orientation of its own, where the photo has one.
    pub interior: Option<Interior>,
    /// Exterior orientation, so far.
    pub pose: Option<Pose>,
    /// Whether the orientation was given.
    pub given: bool,
    /// Its measurements.
    pub sights: Vec<usize>,
}

/// An object point.
#[derive(Clone, Debug)]
pub(super) struct Mark {
    /// Given coordinates that may be used, reduced by the origin.
    pub known: Option<Vector3<f64>>,
    /// Whether it is a control point.
    pub control: bool,
    /// Standard errors of given coordinates, as in the project.
    pub sigma: Option<[Option<f64>; 3]>,
    /// Coordinates, so far.
    pub xyz: Option<Vector3<f64>>,
    /// Its measurements.
    pub sights: Vec<usize>,
}

/// The working state.
#[derive(Clone, Debug)]
pub(super) struct Block {
    /// Cameras with working values of their parameters, in the project's order.
    pub cameras: Vec<Camera>,
    /// Whether a camera's principal distance may be changed: it is missing, or free and not observed.
    pub adjustable: Vec<bool>,
    /// Photos in the project's order.
    pub views: Vec<View>,
    /// Points in the project's order.
    pub marks: Vec<Mark>,
    /// Enabled measurements.
    pub sights: Vec<Sight>,
    /// What given coordinates are reduced by, so that large ones lose no digits.
    pub origin: Vector3<f64>,
    /// Whether poses and points are in the system of the given coordinates.
    pub anchored: bool,
    /// Robust standard deviation of the residuals, pixels; none before anything was compared.
    pub noise_px: Option<f64>,
}

/// Disagreement, as a share of the longer side of the photo, that unmodelled distortion and a rough principal distance
/// may cause.
const ROUGH: f64 = 4e-3;
/// Robust standard deviations, and pixels in any case, within which a measurement agrees.
const AGREEING: f64 = 6.5;
const SMALLEST_LIMIT_PX: f64 = 0.25;

/// Principal distance in pixels.
pub(super) fn principal_distance_px(camera: &Camera) -> Option<f64> {
    let c = camera.interior.get(match camera.interior {
        Interior::Brown { .. } => Parameter::C,
        Interior::Opencv { .. } => Parameter::Fx,
    })?;
    let pitch = match camera.interior {
        Interior::Brown { .. } => camera.pitch()[0],
        Interior::Opencv { .. } => 1.0,
    };
    Some(c / pitch).filter(|px| px.is_finite() && *px > 0.0)
}

/// Sets the principal distance in pixels.
pub(super) fn set_principal_distance_px(camera: &mut Camera, px: f64) {
    match camera.interior {
        Interior::Brown { .. } => {
            let c = px * camera.pitch()[0];
            camera.interior.set(Parameter::C, c);
        }
        Interior::Opencv { .. } => {
            if camera.interior.get(Parameter::Fy).is_none() {
                camera.interior.set(Parameter::Fy, px);
            }
            camera.interior.set(Parameter::F, px);
        }
    }
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

impl Block {
    /// The state at the start: what is given, nothing else. The project is valid.
    pub fn new(project: &Project) -> Self {
        let cameras = index(project.cameras.iter().map(|c| &c.id));
        let photos = index(project.photos.iter().map(|p| &p.id));
        let points = index(project.points.iter().map(|p| &p.id));
        let mut views: Vec<View> = project
            .photos
            .iter()
            .map(|photo| {
                let pose = Pose::of_photo(photo);
                let camera = cameras.get(photo.camera.as_str()).copied().unwrap_or_default();
                View { camera, interior: photo.interior, pose, given: pose.is_some(), sights: Vec::new() }
            })
            .collect();
        let given: Vec<Option<Vector3<f64>>> = project
            .points
            .iter()
            // A check point's coordinates are for comparing only.
            .map(|p| p.xyz.filter(|xyz| p.role != Role::Check && xyz.iter().all(|x| x.is_finite())).map(Into::into))
            .collect();
        let known: Vec<Vector3<f64>> = given.iter().flatten().copied().collect();
        let centres: Vec<Vector3<f64>> = views.iter().filter_map(|v| v.pose.map(|p| p.centre)).collect();
        let all = if known.is_empty() { &centres } else { &known };
        let origin = all.iter().sum::<Vector3<f64>>() / all.len().max(1) as f64;
        for view in &mut views {
            if let Some(pose) = &mut view.pose {
                pose.centre -= origin;
            }
        }
        let mut marks: Vec<Mark> = project
            .points
            .iter()
            .zip(given)
            .map(|(p, xyz)| Mark {
                known: xyz.map(|x| x - origin),
                control: p.role == Role::Control,
                sigma: p.sigma,
                xyz: None,
                sights: Vec::new(),
            })
            .collect();
        let mut sights: Vec<Sight> = Vec::new();
        for observation in &project.observations {
            let ids = photos.get(observation.photo.as_str()).zip(points.get(observation.point.as_str()));
            let Some((&photo, &point)) =
                ids.filter(|(photo, _)| observation.enabled && project.photos[**photo].enabled)
            else {
                continue;
            };
            views[photo].sights.push(sights.len());
            marks[point].sights.push(sights.len());
            sights.push(Sight { photo, point, pixel: [observation.u, observation.v], ray: None, taken: true });
        }
        let mut block = Self {
            cameras: project.cameras.clone(),
            adjustable: project.cameras.iter().map(adjustable).collect(),
            views,
            marks,
            sights,
            origin,
            anchored: false,
            noise_px: None,
        };
        block.refresh_rays();
        block
    }

    /// Recomputes ideal coordinates after a camera changed.
    pub fn refresh_rays(&mut self) {
        for sight in &mut self.sights {
            let view = &self.views[sight.photo];
            sight.ray = match view.interior {
                Some(interior) => {
                    ideal_from_pixel(&Camera { interior, ..self.cameras[view.camera].clone() }, sight.pixel)
                }
                None => ideal_from_pixel(&self.cameras[view.camera], sight.pixel),
            };
        }
    }

    /// Principal distance of a photo's camera in pixels; what turns ideal coordinates into pixels.
    pub fn pixels_per_unit(&self, photo: usize) -> f64 {
        let camera = &self.cameras[self.views[photo].camera];
        principal_distance_px(camera).unwrap_or_else(|| longer_side(camera))
    }

    /// Disagreement in pixels that is not held against a measurement: a share of the photo while nothing is known,
    /// then what the residuals say.
    pub fn tolerance_px(&self, photo: usize) -> f64 {
        let rough = ROUGH * longer_side(&self.cameras[self.views[photo].camera]);
        self.noise_px.map_or(rough, |noise| (5.0 * noise).clamp(0.5, 3.0 * rough))
    }

    /// Photos that have a pose.
    pub fn oriented(&self) -> usize {
        self.views.iter().filter(|v| v.pose.is_some() && !v.sights.is_empty()).count()
    }

    /// Takes the given coordinates as the points' own and is in their system from now on.
    pub fn anchor(&mut self) {
        self.anchored = true;
        for mark in &mut self.marks {
            mark.xyz = mark.known.or(mark.xyz);
        }
    }

    /// Object points and ideal coordinates of a photo's measurements of points that have coordinates.
    pub fn determined(&self, photo: usize) -> (Vec<usize>, Vec<Vector3<f64>>, Vec<[f64; 2]>) {
        let (mut sights, mut object, mut image) = (Vec::new(), Vec::new(), Vec::new());
        for &s in &self.views[photo].sights {
            if let (Some(xyz), Some(ray)) = (self.marks[self.sights[s].point].xyz, self.sights[s].ray) {
                sights.push(s);
                object.push(xyz);
                image.push(ray);
            }
        }
        (sights, object, image)
    }

    /// Residual of a measurement in pixels; none while its photo or point is not determined, infinite behind the
    /// camera.
    pub fn misfit_px(&self, sight: usize) -> Option<f64> {
        let s = &self.sights[sight];
        let (pose, xyz, ray) = (self.views[s.photo].pose?, self.marks[s.point].xyz?, s.ray?);
        Some(pose.misfit(&xyz, ray) * self.pixels_per_unit(s.photo))
    }

    /// Rays of a point in oriented photos, with the measurement each belongs to.
    pub fn rays(&self, point: usize) -> (Vec<usize>, Vec<Ray>) {
        let mut which = Vec::new();
        let mut rays = Vec::new();
        for &s in &self.marks[point].sights {
            let sight = &self.sights[s];
            if let (true, Some(pose), Some(image)) = (sight.taken, self.views[sight.photo].pose, sight.ray) {
                which.push(s);
                rays.push(Ray { pose, image, weight: self.pixels_per_unit(sight.photo).powi(2) });
            }
        }
        (which, rays)
    }

    /// The intersection of a point's rays, without the worst rays as long as there are three and they disagree.
    /// Returns the measurements left out, too.
    pub fn intersection(&self, point: usize) -> Result<(Intersection, Vec<usize>), Degeneracy> {
        let (mut which, mut rays) = self.rays(point);
        let mut left_out = Vec::new();
        loop {
            let found = intersect(&rays);
            let worst = match &found {
                Ok(intersection) => {
                    let excess = |k: usize| {
                        let [x, y] = intersection.residuals[k];
                        let photo = self.sights[which[k]].photo;
                        x.hypot(y) * self.pixels_per_unit(photo) / self.tolerance_px(photo)
                    };
                    let Some(worst) = (0..rays.len()).max_by(|&a, &b| excess(a).total_cmp(&excess(b))) else {
                        return found.map(|i| (i, left_out));
                    };
                    if excess(worst) <= 1.0 {
                        return found.map(|i| (i, left_out));
                    }
                    worst
                }
                Err(Degeneracy::BehindCamera { ray }) => *ray,
                Err(reason) => return Err(*reason),
            };
            if rays.len() < 3 {
                return Err(found.err().unwrap_or(Degeneracy::NoSolution));
            }
            rays.remove(worst);
            left_out.push(which.remove(worst));
        }
    }

    /// Intersects every point that has no coordinates yet; `smallest` is the least angle between rays to accept.
    pub fn intersect_new(&mut self, smallest: f64) {
        for point in 0..self.marks.len() {
            if self.marks[point].xyz.is_some() || self.marks[point].sights.len() < 2 {
                continue;
            }
            if let Ok((found, _)) = self.intersection(point)
                && found.angle >= smallest
            {
                self.marks[point].xyz = Some(found.point);
            }
        }
    }

    /// Compares every measurement with the present poses and points: keeps the noise, and takes those measurements
    /// that agree within [`AGREEING`] robust standard deviations.
    pub fn review(&mut self) {
        let misfits: Vec<Option<f64>> = (0..self.sights.len()).map(|s| self.misfit_px(s)).collect();
        let lengths: Vec<f64> = misfits.iter().flatten().copied().collect();
        if lengths.is_empty() {
            return;
        }
        let noise = scale(&lengths, 0);
        self.noise_px = Some(noise);
        // Wide, because what a rough model leaves is systematic: it is the wrong names, tens of pixels off, that have
        // to stay out.
        let limit = (AGREEING * noise).max(SMALLEST_LIMIT_PX);
        for (sight, misfit) in self.sights.iter_mut().zip(misfits) {
            if let Some(misfit) = misfit {
                sight.taken = misfit <= limit;
            }
        }
    }
}
