//! Photos of parts of an object: where targets would be too small in a picture that holds all of it, photos are taken from nearer, each
//! of the surroundings of one target, from in front of it and from its sides, so that one overlaps with the next.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::candidates::{allowed, rolls};
use super::setup::{Setup, Shot, principal_distance_px};

/// Targets, far from each other, whose surroundings are examined.
const SPOTS: usize = 24;
/// Angles to the target's normal, degrees, with so many directions around each: 40 and 50 degrees look around a box's edge at more of the
/// one face or more of the other.
const TILTS: [(f64, usize); 4] = [(0.0, 1), (25.0, 4), (40.0, 8), (50.0, 4)];
/// Distances as shares of that from which the target is just large enough.
const SHARES: [f64; 3] = [0.93, 0.75, 0.55];
/// Steps by the golden section meet every direction, distance and roll equally often.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// Targets that are far from each other, the first one farthest from the middle.
fn spots(setup: &Setup<'_>) -> Vec<usize> {
    let places = &setup.places;
    let facing = |k: &usize| setup.plan.points[*k].normal.is_some();
    let middle = places.iter().sum::<Vector3<f64>>() / places.len().max(1) as f64;
    let mut away: Vec<f64> = places.iter().map(|place| (place - middle).norm()).collect();
    let mut spots = Vec::new();
    while spots.len() < SPOTS {
        let farthest = (0..places.len()).filter(facing).max_by(|a, b| away[*a].total_cmp(&away[*b]));
        let Some(spot) = farthest.filter(|k| spots.is_empty() || away[*k] > 0.0) else { break };
        for (k, away) in away.iter_mut().enumerate() {
            let apart = (places[k] - places[spot]).norm();
            *away = if spots.is_empty() { apart } else { away.min(apart) };
        }
        spots.push(spot);
    }
    spots
}

/// At most so many photos of parts that see enough points.
pub fn parts(setup: &Setup<'_>, most: usize, sees: usize) -> Vec<Shot> {
    let c = principal_distance_px(&setup.plan.cameras[0]).unwrap_or(1.0);
    let mut shots = Vec::new();
    for spot in spots(setup) {
        let point = &setup.plan.points[spot];
        let (Some(normal), Some(diameter)) = (point.normal, point.diameter) else { continue };
        let normal = Vector3::from(normal).normalize();
        let other = if normal.z.abs() < 0.9 { Vector3::z() } else { Vector3::y() };
        let across = other.cross(&normal).normalize();
        let above = normal.cross(&across);
        for (tilt, count) in TILTS {
            let (s, cos) = tilt.to_radians().sin_cos();
            let far = diameter * c * cos / setup.plan.least_px;
            for k in 0..count {
                let (sa, ca) = (TAU * k as f64 / count as f64).sin_cos();
                let direction = cos * normal + s * (ca * across + sa * above);
                for share in SHARES {
                    for &roll in rolls(setup) {
                        let aim = setup.places[spot];
                        shots.extend(allowed(setup, aim + share * far * direction, aim, roll, sees));
                    }
                }
            }
        }
    }
    let mut ranked: Vec<(f64, Shot)> =
        shots.into_iter().enumerate().map(|(k, shot)| ((k as f64 * GOLDEN).fract(), shot)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    ranked.into_iter().take(most).map(|(_, shot)| shot).collect()
}
