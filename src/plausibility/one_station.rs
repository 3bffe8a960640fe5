//! Photos that were taken from one place.
//!
//! Without a base there is no parallax: r = R l for the rays l, r of every common point, whatever its distance, that is, the photos are
//! related by the homography K R K⁻¹ (Hartley and Zisserman, Multiple View Geometry, 8.4). Such photos give no depth; a relative orientation
//! of them puts the points where its noise does. A plane gives a homography too, but not that of a rotation.
//!
//! Two photos are of one place when R, and the lens where it is not calibrated (principal distance, principal point, first radial term, whatever
//! of these the document frees: held at 0 they are wrong), leave nothing but the noise of the measurements, robustly: the epipolar lines of no
//! base could explain more. Principal distances stay within what lenses have, since a long enough one makes a shift of a plane out of a
//! rotation.

use nalgebra::{DVector, Matrix3, Vector3};

use super::least_squares::robust;
use super::seen::{
    DISTANCES, PhotoMeasurements, PixelMeasurement, common, distance_px, is_free, longer_side, measured_photos,
    set_distance_px,
};
use crate::adjustment::OneStation;
use crate::camera::ideal_from_pixel;
use crate::initial::Pose;
use crate::initial::robust::{quantile, scale};
use crate::project::{Camera, Parameter, Project};
use crate::rotation;

/// Common points that two photos need to be compared: of fewer the lens makes up for anything. And those that are compared at most.
const FEWEST: usize = 8;
const MOST: usize = 60;
/// Photos that are compared with the first one at once.
const TOGETHER: usize = 6;
/// Median residual of a rotation, as a share of the photo, beyond which no lens that is free makes up for it.
const COARSE: f64 = 0.04;
/// Standard error of a measurement at least, pixels: less parallax than this is of no use, however finely it was measured.
const FINEST_PX: f64 = 0.1;
/// Residuals over their standard errors, robustly, that are noise still; standard errors are rarely right to more than a factor of two.
const NOISE: f64 = 2.5;
/// Robust standard deviations beyond which a pair does not agree, and the share that must agree: others are wrong names. More would be the
/// near points of photos that have a base.
const AGREEING: f64 = 6.0;
const SHARE: f64 = 0.9;
/// Principal distances over a given one, and over the longer side where none is given.
const GIVEN: [f64; 2] = [0.7, 1.4];
const MISSING: [f64; 2] = [0.4, 4.0];
/// Farthest that a principal point may be from the one given, and largest radial correction at half the longer side, as shares of it.
const ASIDE: f64 = 0.03;
const BENT: f64 = 0.15;
/// Of the base over the depth below which oriented photos are compared.
const NEAR: f64 = 0.05;
/// Roll against each other, radians, beyond which photos of one place are so on purpose.
const ROLLED: f64 = 0.8;

/// Camera of a photo with its possible principal distance.
struct PhotoLens<'a> {
    camera: &'a Camera,
    given: Option<f64>,
    side: f64,
    /// Whether its interior orientation is uncertain.
    open: bool,
}

impl<'a> PhotoLens<'a> {
    /// That of a photo; `calibrated`: as the network of all photos determines it.
    fn of(photo: &'a PhotoMeasurements, calibrated: bool) -> Self {
        let (camera, given) = (&photo.lens, distance_px(&photo.lens));
        let open = !calibrated && (given.is_none() || DISTANCES.iter().any(|p| is_free(camera, *p)));
        Self { camera, given, side: longer_side(camera), open }
    }

    /// Principal distances to start from, pixels.
    fn starts(&self) -> Vec<f64> {
        self.given.map_or_else(|| [0.6, 0.9, 1.2, 1.7, 2.6].map(|x| x * self.side).to_vec(), |given| vec![given])
    }

    /// The camera with a principal distance, with `bent`, the radial correction at half the longer side, and with its principal point moved by
    /// `aside`, both as shares of that side.
    fn with(&self, px: f64, bent: f64, aside: [f64; 2]) -> Camera {
        let mut camera = self.camera.clone();
        if !self.open {
            return camera;
        }
        let range = self.given.map_or(MISSING.map(|x| x * self.side), |given| GIVEN.map(|x| x * given));
        let px = px.clamp(range[0], range[1]);
        set_distance_px(&mut camera, px);
        let aside = aside.map(|share| share.clamp(-ASIDE, ASIDE) * self.side);
        let (model, unit) = (camera.interior.model(), camera.residual_pitch()[0]);
        let half = if model.in_photo_units { 0.5 * self.side * unit } else { 0.5 * self.side / px };
        for (name, aside) in model.centre.into_iter().zip(aside) {
            let value = camera.interior.get(name).unwrap_or_default();
            camera.interior.set(name, value + aside * unit);
        }
        let k1 = camera.interior.get(Parameter::K1).unwrap_or_default();
        camera.interior.set(Parameter::K1, k1 + bent.clamp(-BENT, BENT) / (half * half));
        camera
    }
}

/// Rotation of least squares from one set of directions to another.
fn turn(from: &[Vector3<f64>], to: &[Vector3<f64>]) -> Matrix3<f64> {
    let cross = from.iter().zip(to).fold(Matrix3::zeros(), |sum, (a, b)| sum + b * a.transpose());
    rotation::nearest(&cross)
}

fn rays(camera: &Camera, measurements: &[PixelMeasurement]) -> Option<Vec<Vector3<f64>>> {
    let ray = |measurement: &PixelMeasurement| {
        ideal_from_pixel(camera, measurement.pixel).map(|[x, y]| Vector3::new(x, y, -1.0))
    };
    measurements.iter().map(ray).collect()
}

/// Difference of two rays in the second photo, pixels.
fn off(turned: &Vector3<f64>, ray: &Vector3<f64>, px: f64) -> [f64; 2] {
    if turned.z < 0.0 { [0, 1].map(|k| (-turned[k] / turned.z - ray[k]) * px) } else { [f64::INFINITY, 0.0] }
}

/// A photo beside the one that all are compared with.
struct Beside<'a> {
    lens: PhotoLens<'a>,
    camera: usize,
    /// Common points in the first photo and in this one.
    first: Vec<PixelMeasurement>,
    own: Vec<PixelMeasurement>,
    sigmas: Vec<f64>,
    /// Principal distance and rotation from the first photo to this one to start from.
    px: f64,
    start: Matrix3<f64>,
}

/// Rotation of least squares with a principal distance for each photo, and the median of what it leaves, pixels.
fn turned(
    lens: &PhotoLens,
    px: f64,
    first: &[PixelMeasurement],
    other: &PhotoLens,
    other_px: f64,
    own: &[PixelMeasurement],
) -> Option<(f64, Matrix3<f64>)> {
    let (from, to) = (rays(&lens.with(px, 0.0, [0.0; 2]), first)?, rays(&other.with(other_px, 0.0, [0.0; 2]), own)?);
    let unit = |all: &[Vector3<f64>]| all.iter().map(Vector3::normalize).collect::<Vec<_>>();
    let turn = turn(&unit(&from), &unit(&to));
    let lengths = from.iter().zip(&to).map(|(l, r)| off(&(turn * l), r, other_px)).map(|[x, y]| x.hypot(y));
    let lengths: Vec<f64> = lengths.map(|l| if l.is_finite() { l } else { f64::MAX }).collect();
    Some((quantile(&lengths, 0.5), turn))
}

/// Whether photos were taken from the place of the first one, as far as the points show that each has in common with it. One lens explains all
/// photos of a camera: with one of its own each, two photos of a plane with a small base would be rotations.
fn are_turned(first: &PhotoMeasurements, others: &[&PhotoMeasurements], calibrated: bool) -> bool {
    let lens = PhotoLens::of(first, calibrated);
    let mut beside: Vec<Beside> = Vec::new();
    let mut usual: Option<f64> = None;
    for other in others {
        let all = common(first, other);
        if all.len() < FEWEST {
            return false;
        }
        let chosen = (0..all.len().min(MOST)).map(|k| all[k * all.len() / all.len().min(MOST)]);
        let (measurements, own): (Vec<PixelMeasurement>, Vec<PixelMeasurement>) = chosen.unzip();
        let of_other = PhotoLens::of(other, calibrated);
        let shared = first.camera == other.camera;
        let mut best: Option<(f64, [f64; 2], Matrix3<f64>)> = None;
        for px in usual.map_or_else(|| lens.starts(), |px| vec![px]) {
            for other_px in if shared { vec![px] } else { of_other.starts() } {
                let found = turned(&lens, px, &measurements, &of_other, other_px, &own);
                if let Some((median, turn)) = found.filter(|(m, _)| best.as_ref().is_none_or(|(least, ..)| m < least)) {
                    best = Some((median, [px, other_px], turn));
                }
            }
        }
        let Some((_, [own_px, px], start)) = best.filter(|(median, ..)| *median <= COARSE * of_other.side) else {
            return false;
        };
        usual = Some(own_px);
        let sigmas = measurements.iter().zip(&own).map(|(a, b)| a.sigma_px.hypot(b.sigma_px).max(FINEST_PX)).collect();
        beside.push(Beside { lens: of_other, camera: other.camera, first: measurements, own, sigmas, px, start });
    }
    // Three angles a photo, then distance and radial term of every camera that is not calibrated; a principal point where there is one
    // camera only, since that of a second one would be equivalent to a rotation.
    let mut steps = vec![1e-7; 3 * beside.len()];
    let alone = beside.iter().all(|b| b.camera == first.camera);
    let mut places: Vec<(usize, usize)> = Vec::new();
    for (camera, open) in
        std::iter::once((first.camera, lens.open)).chain(beside.iter().map(|b| (b.camera, b.lens.open)))
    {
        if open && !places.iter().any(|(known, _)| *known == camera) {
            places.push((camera, steps.len()));
            steps.extend(vec![1e-6; if alone { 4 } else { 2 }]);
        }
    }
    let residuals = |p: &DVector<f64>| -> Vec<[f64; 2]> {
        let with = |lens: &PhotoLens, camera: usize, px: f64| match places.iter().find(|(known, _)| *known == camera) {
            Some(&(_, at)) => {
                let aside = if alone { [p[at + 2], p[at + 3]] } else { [0.0; 2] };
                lens.with(px * p[at].exp(), p[at + 1], aside)
            }
            None => lens.camera.clone(),
        };
        let one = with(&lens, first.camera, usual.unwrap_or(lens.side));
        let each = beside.iter().enumerate().flat_map(|(k, b)| {
            let other = with(&b.lens, b.camera, b.px);
            let units = distance_px(&other).unwrap_or(b.lens.side);
            let m = rotation::turned(&b.start, Vector3::new(p[3 * k], p[3 * k + 1], p[3 * k + 2]));
            match rays(&one, &b.first).zip(rays(&other, &b.own)) {
                Some((from, to)) => from
                    .iter()
                    .zip(&to)
                    .zip(&b.sigmas)
                    .map(|((l, r), sigma)| off(&(m * l), r, units).map(|x| x / sigma))
                    .collect::<Vec<_>>(),
                None => vec![[f64::INFINITY, 0.0]; b.own.len()],
            }
        });
        each.collect()
    };
    let (_, lengths) = robust(DVector::zeros(steps.len()), &steps, &residuals);
    let noise = scale(&lengths, steps.len());
    let agreeing = lengths.iter().filter(|l| **l <= AGREEING * noise.max(1.0)).count();
    noise <= NOISE && agreeing as f64 >= SHARE * lengths.len() as f64
}

/// Whether all photos in which enough was measured were taken from one place.
pub fn is_all(project: &Project) -> Option<OneStation> {
    let mut open: Vec<PhotoMeasurements> =
        measured_photos(project).into_iter().filter(|photo| photo.measurements.len() >= FEWEST).collect();
    if open.len() < 2 {
        return None;
    }
    let mut joined = vec![open.remove(0)];
    while !open.is_empty() {
        let pairs = (0..open.len()).flat_map(|k| (0..joined.len()).map(move |j| (k, j)));
        let (count, k, j) = pairs.map(|(k, j)| (common(&joined[j], &open[k]).len(), k, j)).max_by_key(|best| best.0)?;
        if count < FEWEST || !are_turned(&joined[j], &[&open[k]], false) {
            return None;
        }
        joined.push(open.remove(k));
    }
    // Two by two they are; all of them with one lens?
    let star: Vec<&PhotoMeasurements> =
        joined[1..].iter().filter(|s| common(&joined[0], s).len() >= FEWEST).take(TOGETHER).collect();
    if star.len() > 1 && !are_turned(&joined[0], &star, false) {
        return None;
    }
    joined.sort_by_key(|photo| photo.photo);
    let photos = joined.iter().map(|photo| project.photos[photo.photo].id.clone()).collect();
    Some(OneStation { photos, all: true })
}

/// Groups of photos that were taken from one place each and held alike, in a document with the cameras that its network determines. Photos
/// that are rotated about the axis are not such a group: they add to the calibration of their camera, and are taken so on purpose. Oriented
/// photos are compared where their centres are near to each other for the depth of what they show, others with all.
pub fn groups(project: &Project) -> Vec<OneStation> {
    let photos: Vec<PhotoMeasurements> =
        measured_photos(project).into_iter().filter(|photo| photo.measurements.len() >= FEWEST).collect();
    let poses: Vec<Option<Pose>> = photos.iter().map(|photo| Pose::of_photo(&project.photos[photo.photo])).collect();
    let depths: Vec<f64> = photos
        .iter()
        .zip(&poses)
        .map(|(photo, pose)| {
            let points = photo.measurements.iter().filter_map(|measurement| project.points[measurement.point].xyz);
            let lengths: Vec<f64> = pose
                .iter()
                .flat_map(|pose| points.clone().map(move |xyz| (Vector3::from(xyz) - pose.centre).norm()))
                .collect();
            quantile(&lengths, 0.5)
        })
        .collect();
    let mut group: Vec<usize> = (0..photos.len()).collect();
    for a in 0..photos.len() {
        for b in a + 1..photos.len() {
            let near = match (poses[a], poses[b]) {
                (Some(p), Some(q)) => {
                    let turn = p.object_to_camera * q.object_to_camera.transpose();
                    let alike = turn[(1, 0)].atan2(turn[(0, 0)]).abs() < ROLLED;
                    alike && (p.centre - q.centre).norm() <= NEAR * depths[a].min(depths[b])
                }
                // Without poses at all there is no network to add to.
                (None, None) => false,
                _ => true,
            };
            if near && group[a] != group[b] && are_turned(&photos[a], &[&photos[b]], true) {
                let (kept, gone) = (group[a].min(group[b]), group[a].max(group[b]));
                group.iter_mut().filter(|g| **g == gone).for_each(|g| *g = kept);
            }
        }
    }
    (0..photos.len())
        .map(|k| (0..photos.len()).filter(|n| group[*n] == k).collect::<Vec<_>>())
        .filter(|members| members.len() > 1)
        .map(|members| OneStation {
            photos: members.iter().map(|n| project.photos[photos[*n].photo].id.clone()).collect(),
            all: members.len() == photos.len(),
        })
        .collect()
}

#[cfg(test)]
mod tests;
