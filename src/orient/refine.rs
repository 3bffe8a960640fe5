//! A small bundle adjustment of what is oriented so far, so that errors do not pile up from photo to photo.

use std::collections::BTreeMap;

use super::block::{OrientationBlock, principal_distance_px};
use crate::adjust::{Numbering, camera_sigmas, values};
use crate::initial::Pose;
use crate::project::{Camera, Datum, DatumKind, Observation, Parameter, Photo, Point, Project, Role, Sigma};
use crate::rotation;

/// Largest factor a principal distance may be off from a given one.
const FARTHEST_FROM_GIVEN: f64 = 1.55;

/// Estimated parameters of the cameras.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Freedom {
    /// Nothing.
    Held,
    /// The principal distance and the first term of the radial distortion, where the project leaves them free.
    Distance,
    /// Everything the project leaves free.
    Everything,
}

/// Minimum number of photos of a network, and measurements per camera, that a principal distance is estimated from.
const FEWEST_PHOTOS: usize = 3;
const FEWEST_OBSERVATIONS: usize = 30;
/// Maximum number of adjustments in a row, each of so many iterations at most.
const MOST_ROUNDS: usize = 4;
const MOST_ITERATIONS: usize = 30;
/// Steps shorter than this part of the standard errors end an adjustment on the way: what follows tells measurements
/// apart by several of them.
const NEGLIGIBLE: f64 = 0.3;
/// While photos are still to come, a model is settled when no more than one in so many measurements changes sides.
const FEW: usize = 100;
/// Of the measurements that agreed before, one in so many agrees at least after an adjustment that has not run away.
const KEPT: usize = 3;
/// Largest factor a principal distance may change by in one refinement.
const LARGEST_CHANGE: f64 = 2.0;

/// Adjusts poses, points and, as far as asked, cameras; then reviews which measurements agree. Tries with less freedom
/// where the network does not determine more, and leaves the block as it was where nothing converges.
pub(super) fn refine(block: &mut OrientationBlock, freedom: Freedom) {
    let steps: &[Freedom] = match freedom {
        Freedom::Held => &[Freedom::Held],
        Freedom::Distance => &[Freedom::Distance, Freedom::Held],
        Freedom::Everything => &[Freedom::Everything, Freedom::Distance, Freedom::Held],
    };
    for &step in steps {
        let Some(mut best) = attempt(block, step) else { continue };
        // Again as long as it changes which measurements agree: those that stood out of a rough model come back in.
        for _ in 0..MOST_ROUNDS {
            let Some(next) = attempt(&best, step) else { break };
            let changed = next.observations.iter().zip(&best.observations).filter(|(a, b)| a.taken != b.taken).count();
            best = next;
            if changed == 0 || freedom != Freedom::Everything && changed * FEW <= best.agreeing() {
                break;
            }
        }
        *block = best;
        return;
    }
    block.review();
}

/// Standard errors of the principal distances in pixels as the network alone determines them, per camera; infinite where
/// it does not, `None` if a camera's is not estimated.
pub(super) fn distance_sigmas_px(block: &OrientationBlock) -> Vec<Option<f64>> {
    let mut sigmas = vec![None; block.cameras.len()];
    let Some(mut part) = part(block, Freedom::Everything) else { return sigmas };
    // However weak the network: that is what is asked.
    for (camera, &k) in part.project.cameras.iter_mut().zip(&part.cameras) {
        *camera = freed(block, k, Freedom::Everything);
    }
    let distances = [Parameter::C, Parameter::F, Parameter::Fx, Parameter::Fy];
    let found = camera_sigmas(&part.project, &part.numbering);
    for (at, (camera, &k)) in part.project.cameras.iter().zip(&part.cameras).enumerate() {
        let Some(parameter) = distances.into_iter().find(|p| camera.free.contains(p)) else { continue };
        let unit = if parameter == Parameter::C { camera.pitch()[0] } else { 1.0 };
        let sigma = found.as_ref().and_then(|sigmas| sigmas[at].get(&parameter)).map(|s| s / unit);
        sigmas[k] = Some(sigma.filter(|s| s.is_finite()).unwrap_or(f64::INFINITY));
    }
    sigmas
}

fn attempt(block: &OrientationBlock, freedom: Freedom) -> Option<OrientationBlock> {
    let part = part(block, freedom)?;
    let adjusted = values(&part.project, &part.numbering, MOST_ITERATIONS, NEGLIGIBLE)?;
    let mut next = block.clone();
    for (camera, &camera_at) in adjusted.cameras.into_iter().zip(&part.cameras) {
        let place = &mut next.cameras[camera_at];
        let ratio = principal_distance_px(&camera)? / principal_distance_px(place)?;
        let from_given =
            block.given_px[camera_at].map_or(Some(1.0), |px| Some(principal_distance_px(&camera)? / px))?;
        let within = |ratio: f64, most: f64| ratio < most && ratio > 1.0 / most;
        if !(within(ratio, LARGEST_CHANGE) && within(from_given, FARTHEST_FROM_GIVEN)) {
            return None;
        }
        place.interior = camera.interior;
    }
    for (photo, &k) in adjusted.photos.iter().zip(&part.photos) {
        next.photos[k].pose = Pose::of_photo(photo);
    }
    for (point, &k) in adjusted.points.iter().zip(&part.points) {
        let xyz = point.xyz.filter(|xyz| xyz.iter().all(|x| x.is_finite()))?;
        next.points[k].xyz = Some(xyz.into());
    }
    next.refresh_rays();
    next.review();
    // What ends with the object behind the cameras, or with hardly a measurement that agrees, has run away.
    let stands = next.noise_px.is_some_and(f64::is_finite) && KEPT * next.agreeing() >= block.agreeing();
    if !stands {
        return None;
    }
    // Points may have been carried behind a camera by what turned out to disagree: they start again.
    for point in 0..next.points.len() {
        let lost =
            next.points[point].observations.iter().filter(|&&s| next.misfit_px(s) == Some(f64::INFINITY)).count();
        if lost > 0 {
            next.points[point].xyz = if next.anchored { next.points[point].known } else { None };
        }
    }
    Some(next)
}

/// The oriented part as a document without names, numbered; of its photos, points and cameras the places in the whole project.
struct OrientedPart {
    project: Project,
    numbering: Numbering,
    photos: Vec<usize>,
    points: Vec<usize>,
    cameras: Vec<usize>,
}

fn part(block: &OrientationBlock, freedom: Freedom) -> Option<OrientedPart> {
    let sigma = Sigma::One(block.noise_px.unwrap_or(1.0).max(0.02));
    let (mut project, mut numbering) = (Project::default(), Numbering::default());
    let mut rays: BTreeMap<usize, usize> = BTreeMap::new();
    let usable = |s: &&super::block::BlockObservation| {
        let is_wide = block.cameras[block.photos[s.photo].camera].interior.model().is_wide;
        let imaged = s.ray.is_some() || is_wide;
        s.taken && imaged && block.photos[s.photo].pose.is_some() && block.points[s.point].xyz.is_some()
    };
    for observation in block.observations.iter().filter(usable) {
        *rays.entry(observation.point).or_default() += 1;
    }
    let held = |point: usize| block.anchored && block.points[point].control && block.points[point].known.is_some();
    rays.retain(|point, count| *count >= 2 || held(*point));
    let points: Vec<usize> = rays.keys().copied().collect();
    let mut measured = vec![0; block.photos.len()];
    for observation in block.observations.iter().filter(usable).filter(|s| rays.contains_key(&s.point)) {
        measured[observation.photo] += 1;
        numbering.observations.push((observation.photo, points.partition_point(|p| *p < observation.point)));
        project.observations.push(Observation {
            photo: String::new(),
            point: String::new(),
            u: observation.pixel[0],
            v: observation.pixel[1],
            sigma,
            enabled: true,
            target: None,
        });
    }
    let mut controls = 0;
    for &point in &points {
        let block_point = &block.points[point];
        controls += usize::from(held(point));
        project.points.push(Point {
            role: if held(point) { Role::Control } else { Role::Tie },
            sigma: if held(point) { block_point.sigma } else { None },
            xyz: if held(point) { block_point.known } else { block_point.xyz }.map(Into::into),
            ..Point::default()
        });
    }
    let mut photos = Vec::new();
    let mut cameras: BTreeMap<usize, usize> = BTreeMap::new();
    for (k, block_photo) in block.photos.iter().enumerate() {
        let (Some(pose), true) = (block_photo.pose, measured[k] > 0) else { continue };
        *cameras.entry(block_photo.camera).or_default() += measured[k];
        photos.push(k);
        project.photos.push(Photo {
            position: Some(pose.centre.into()),
            rotation: Some(rotation::angles(&pose.object_to_camera)),
            ..block_photo.as_photo()
        });
    }
    for (&camera, &observations) in &cameras {
        let strong = (project.photos.len() >= FEWEST_PHOTOS || controls >= 6) && observations >= FEWEST_OBSERVATIONS;
        project.cameras.push(freed(
            block,
            camera,
            if strong && !block.cameras[camera].per_photo { freedom } else { Freedom::Held },
        ));
    }
    let cameras: Vec<usize> = cameras.into_keys().collect();
    for (photo, _) in &mut numbering.observations {
        *photo = photos.partition_point(|k| k < photo);
    }
    numbering.cameras = photos.iter().map(|k| cameras.partition_point(|c| *c < block.photos[*k].camera)).collect();
    let kind = if controls >= 3 { DatumKind::Control } else { DatumKind::Free };
    project.datum = Datum { kind, points: None };
    let enough = project.photos.len() >= 2 || controls >= 3;
    enough.then_some(OrientedPart { project, numbering, photos, points, cameras })
}

/// The camera with what may be estimated of it at this freedom, and nothing else.
fn freed(block: &OrientationBlock, camera: usize, freedom: Freedom) -> Camera {
    let mut part = block.cameras[camera].clone();
    let distance = part.interior.model().distance;
    if freedom != Freedom::Everything {
        part.free.retain(|p| freedom == Freedom::Distance && *p == Parameter::K1);
        part.sigma.clear();
    }
    let has_distance = [Parameter::C, Parameter::F, Parameter::Fx, Parameter::Fy].iter().any(|p| part.free.contains(p));
    if freedom != Freedom::Held && block.adjustable[camera] && !has_distance {
        part.free.push(distance);
    }
    part
}
