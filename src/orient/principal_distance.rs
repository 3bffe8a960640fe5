//! Initial value of the principal distance: given, from known points, or assumed.
//!
//! Known points determine it photo by photo (direct linear transformation) or from all photos of a plane (homographies). The result is
//! the value with the smallest residuals of the space resections, searched over the range of usual lenses.

use nalgebra::Vector3;

use super::block::{OrientationBlock, longer_side, set_principal_distance_px};
use crate::camera::ideal_from_pixel;
use crate::initial::dlt::dlt;
use crate::initial::homography::{of_plane, principal_distance};
use crate::initial::resection::space_resection;
use crate::initial::robust::quantile;
use crate::project::Camera;

/// Principal distance assumed when nothing is known, over the longer side of the sensor: a field of view of 45°.
pub(super) const ASSUMED: f64 = 1.2;
/// Shortest and longest principal distance looked for, over the longer side of the sensor.
const RANGE: [f64; 2] = [0.35, 12.0];
/// Maximum number of photos used in the search; more cost time without improving the result.
const MOST_PHOTOS: usize = 12;
/// Maximum number of points per photo used in the search.
const MOST_POINTS: usize = 16;

/// Known points measured in one photo.
struct KnownPoints {
    object: Vec<Vector3<f64>>,
    pixels: Vec<[f64; 2]>,
}

/// The principal distance of a camera in pixels from known points; `None` if no photo shows four of them, or if they do not determine
/// it.
pub(super) fn from_known(block: &OrientationBlock, camera: usize) -> Option<f64> {
    let seen = seen(block, camera);
    if seen.is_empty() {
        return None;
    }
    let side = longer_side(&block.cameras[camera]);
    let cost = |px: f64| misfit(&block.cameras[camera], &seen, px);
    let steps = 16;
    let ratio: f64 = RANGE[1] / RANGE[0];
    let grid = (0..=steps).map(|k| side * RANGE[0] * ratio.powf(f64::from(k) / f64::from(steps)));
    let candidates = closed_forms(&block.cameras[camera], &seen);
    let mut best: Option<(f64, f64)> = None;
    let mut largest: f64 = 0.0;
    for px in grid.chain(candidates).filter(|px| *px > side * RANGE[0] && *px < side * RANGE[1]) {
        let value = cost(px);
        if value.is_finite() {
            largest = largest.max(value);
            if best.is_none_or(|(least, _)| value < least) {
                best = Some((value, px));
            }
        }
    }
    let (least, start) = best?;
    let found = golden_section(&cost, start / 1.3, start * 1.3);
    // A flat minimum (photos parallel to a plane) does not determine it; a minimum at an end of the range is not one.
    let decided = largest > 1.5 * least.min(cost(found)) + 1e-9;
    let inside = found > 1.02 * side * RANGE[0] && found < 0.98 * side * RANGE[1];
    (decided && inside).then_some(found)
}

fn seen(block: &OrientationBlock, camera: usize) -> Vec<KnownPoints> {
    let mut all: Vec<KnownPoints> = Vec::new();
    for block_photo in block.photos.iter().filter(|v| v.camera == camera) {
        let known = block_photo.observations.iter().filter_map(|&s| {
            let observation = &block.observations[s];
            block.points[observation.point].known.map(|xyz| (xyz, observation.pixel))
        });
        let (object, pixels): (Vec<_>, Vec<_>) = known.unzip();
        if object.len() >= 4 {
            all.push(KnownPoints { object, pixels });
        }
    }
    let keep = |count: usize, most: usize| -> Vec<usize> {
        (0..count.min(most)).map(|k| k * count / count.min(most)).collect()
    };
    keep(all.len(), MOST_PHOTOS)
        .into_iter()
        .map(|k| {
            let some = keep(all[k].object.len(), MOST_POINTS);
            KnownPoints {
                object: some.iter().map(|&i| all[k].object[i]).collect(),
                pixels: some.iter().map(|&i| all[k].pixels[i]).collect(),
            }
        })
        .collect()
}

/// Median over the photos of the resection's root mean square residual, pixels.
fn misfit(camera: &Camera, seen: &[KnownPoints], px: f64) -> f64 {
    let mut camera = camera.clone();
    set_principal_distance_px(&mut camera, px);
    let each: Vec<f64> = seen
        .iter()
        .map(|photo| {
            let rays: Option<Vec<[f64; 2]>> = photo.pixels.iter().map(|&p| ideal_from_pixel(&camera, p)).collect();
            let solved = rays.and_then(|rays| space_resection(&photo.object, &rays).ok());
            solved.map_or(f64::INFINITY, |s| (s[0].squares() / photo.object.len() as f64).sqrt() * px)
        })
        .collect();
    quantile(&each, 0.5)
}

/// Principal distances from direct linear transformations and plane homographies, pixels.
fn closed_forms(camera: &Camera, seen: &[KnownPoints]) -> Vec<f64> {
    let [px, py] = camera.pitch();
    let model = camera.interior.model();
    if model.is_wide {
        // Both assume perspective images.
        return Vec::new();
    }
    let centre = model.centre.map(|p| camera.interior.get(p).unwrap_or_default());
    let principal_point = if model.in_photo_units { centre } else { camera.photo_from_pixel(centre) };
    let mut found = Vec::new();
    let mut planes = Vec::new();
    for photo in seen {
        let image: Vec<[f64; 2]> = photo
            .pixels
            .iter()
            .map(|&p| {
                let [x, y] = camera.photo_from_pixel(p);
                [x - principal_point[0], y - principal_point[1]]
            })
            .collect();
        match dlt(&photo.object, &image) {
            Ok(solved) => found.push((solved.cx / px * solved.cy / py).sqrt()),
            Err(_) => planes.extend(of_plane(&photo.object, &image)),
        }
    }
    let median = (!found.is_empty()).then(|| quantile(&found, 0.5));
    median.into_iter().chain(principal_distance(&planes).map(|c| c / (px * py).sqrt())).collect()
}

fn golden_section(cost: &impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let golden = (5f64.sqrt() - 1.0) / 2.0;
    let (mut a, mut b) = (low.ln(), high.ln());
    let (mut left, mut right) = (b - golden * (b - a), a + golden * (b - a));
    let (mut at_left, mut at_right) = (cost(left.exp()), cost(right.exp()));
    while b - a > 1e-3 {
        if at_left < at_right {
            (b, right, at_right) = (right, left, at_left);
            left = b - golden * (b - a);
            at_left = cost(left.exp());
        } else {
            (a, left, at_left) = (left, right, at_right);
            right = a + golden * (b - a);
            at_right = cost(right.exp());
        }
    }
    (0.5 * (a + b)).exp()
}
