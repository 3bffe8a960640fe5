//! Whether a station sees a target.
//!
//! The smaller axis of its image is d·c·cos(α)/D, with the incidence α and the distance D along the camera's axis. It is sharp where
//! the circle of confusion c²·|D - F| / (N·D·(F - c)) is small enough, with the focused distance F and the f-number N.

use nalgebra::Vector3;

use crate::scene::incidence;
use sightline::camera::pixel_from_camera_point;
use sightline::initial::Pose;
use sightline::project::Camera;

use super::setup::{Setup, principal_distance_px};

/// Why a target is not seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hindrance {
    Outside,
    TurnedAway,
    Hidden,
    TooSmall,
    Blurred,
}

/// The pixel of a target with the smaller axis of its image, where that is known.
pub fn see(setup: &Setup<'_>, camera: &Camera, pose: &Pose, k: usize) -> Result<([f64; 2], Option<f64>), Hindrance> {
    let plan = setup.plan;
    let (place, point) = (&setup.places[k], &plan.points[k]);
    let seen = pose.to_camera(place);
    let m = plan.margin;
    let inside = |[u, v]: &[f64; 2]| {
        *u >= m && *v >= m && *u <= f64::from(camera.width) - m && *v <= f64::from(camera.height) - m
    };
    let pixel = pixel_from_camera_point(camera, seen).filter(inside).ok_or(Hindrance::Outside)?;
    let angle = point.normal.map(|normal| incidence(pose, place, &Vector3::from(normal)));
    if angle.is_some_and(|angle| angle > plan.max_incidence) {
        return Err(Hindrance::TurnedAway);
    }
    // Equidistant images keep their scale across the axis of a wide lens, where the depth along it goes to zero.
    let depth = if camera.interior.model().is_wide { seen.norm() } else { -seen.z };
    let across = point.diameter.and_then(|d| {
        Some(d * principal_distance_px(camera)? * angle.map_or(1.0, f64::cos) / depth).filter(|px| px.is_finite())
    });
    if across.is_some_and(|px| px < plan.least_px) {
        return Err(Hindrance::TooSmall);
    }
    if confusion_px(setup, camera, depth).is_some_and(|circle| circle > plan.lens.circle_px) {
        return Err(Hindrance::Blurred);
    }
    // The dearest question last.
    if setup.scene.hides(&pose.centre, place) {
        return Err(Hindrance::Hidden);
    }
    Ok((pixel, across))
}

/// Circle of confusion at a distance; `None` if everything is taken for sharp.
fn confusion_px(setup: &Setup<'_>, camera: &Camera, depth: f64) -> Option<f64> {
    let lens = setup.plan.lens;
    let (number, focus, pitch) = (lens.f_number?, lens.focus?, camera.pixel_pitch?);
    let model = camera.interior.model();
    let distance = camera.interior.get(model.distance)?;
    let c = if model.in_photo_units { distance } else { distance * pitch[0] };
    let [depth, focus] = [depth, focus].map(|length| length * lens.unit_mm);
    (focus > c).then(|| c * c * (depth - focus).abs() / (number * depth * (focus - c)) / pitch[0])
}
