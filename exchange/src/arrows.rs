//! Displacements of a pair of epochs as a scene of arrows for 3-D viewers (glTF 2.0, binary), a mesh for each judgement.
//!
//! An arrow begins at the point in the earlier epoch and ends at x + factor·d; points that moved have their confidence ellipsoid at the
//! tip, at the same exaggeration. Units, axes and precision are those of [`super::gltf`].

use nalgebra::Vector3;
use serde_json::json;

use super::displacements::{colour, judgement};
use super::gltf::{POINTS, Scene, TRIANGLES, metres};
use super::spatial::sphere;
use sightline::depiction::extent;
use sightline::monitoring::{Displacement, Monitoring, Pair};

/// Sides of shafts and heads.
const SIDES: usize = 10;
/// Radius of a shaft in parts of the object's diagonal; a head is three times as wide, and as long as it is wide three times.
const SHAFT: f64 = 0.0015;

/// The bytes of the scene.
pub fn write(found: &Monitoring, pair: &Pair, factor: f64) -> Vec<u8> {
    let (centre, size) = extent(pair.points.iter().map(|p| p.xyz));
    let mut scene = Scene::default();
    let unit = found.unit.as_deref().unwrap_or_default();
    let about = |v: Vector3<f64>| -> [f32; 3] { std::array::from_fn(|k| (v[k] - centre[k]) as f32) };
    let places: Vec<[f32; 3]> = pair.points.iter().map(|p| about(p.xyz.into())).collect();
    let names: Vec<&str> = pair.points.iter().map(|p| p.id.as_str()).collect();
    if !places.is_empty() {
        let position = scene.positions(&places);
        let extras = json!({ "names": names, "unit": unit, "from": pair.from, "to": pair.to });
        scene.mesh("points", json!({ "POSITION": position }), None, POINTS, [60; 3], extras);
    }
    let judgements = ["moved", "unstable_reference", "reference", "not_significant", "not_tested"];
    for one in judgements {
        let own: Vec<&Displacement> = pair.points.iter().filter(|p| judgement(pair, p) == one).collect();
        let arrows = own.iter().flat_map(|p| arrow(p.xyz.into(), factor * Vector3::from(p.difference), SHAFT * size));
        let corners: Vec<[f32; 3]> = arrows.map(about).collect();
        if !corners.is_empty() {
            let names: Vec<&str> = own.iter().map(|p| p.id.as_str()).collect();
            let lengths: Vec<f64> = own.iter().map(|p| p.length).collect();
            let extras = json!({ "names": names, "lengths": lengths, "exaggeration": factor, "unit": unit });
            let position = scene.positions(&corners);
            scene.mesh(&format!("arrows {one}"), json!({ "POSITION": position }), None, TRIANGLES, colour(one), extras);
        }
        if matches!(one, "moved" | "unstable_reference") {
            ellipsoids(&mut scene, &own, factor, one, about);
        }
    }
    scene.packed(centre, metres(unit))
}

/// Confidence ellipsoids at the tips, see-through.
fn ellipsoids(
    scene: &mut Scene,
    points: &[&Displacement],
    factor: f64,
    judgement: &str,
    about: impl Fn(Vector3<f64>) -> [f32; 3],
) {
    let (unit, faces) = sphere();
    let mut corners = Vec::new();
    for (point, ellipsoid) in points.iter().filter_map(|p| Some((p, p.ellipsoid.as_ref()?))) {
        let tip = Vector3::from(point.xyz) + factor * Vector3::from(point.difference);
        let place = |c: &[f64; 3]| {
            let axes = ellipsoid.directions.iter().zip(ellipsoid.semi_axes).zip(c);
            tip + axes.map(|((u, s), c)| factor * s * c * Vector3::from(*u)).sum::<Vector3<f64>>()
        };
        let places: Vec<[f32; 3]> = unit.iter().map(|c| about(place(c))).collect();
        corners.extend(faces.iter().flatten().map(|k| places[*k as usize]));
    }
    if !corners.is_empty() {
        let position = scene.positions(&corners);
        let name = format!("ellipsoids {judgement}");
        let extras = json!({ "exaggeration": factor });
        scene.mesh(&name, json!({ "POSITION": position }), None, TRIANGLES, colour(judgement), extras);
        scene.see_through(0.25);
    }
}

/// Triangles of an arrow, three corners each, outside in front: a shaft and a cone. Nothing where it has no length.
fn arrow(from: Vector3<f64>, along: Vector3<f64>, radius: f64) -> Vec<Vector3<f64>> {
    let length = along.norm();
    if !(length > 0.0) || !length.is_finite() {
        return Vec::new();
    }
    let axis = along / length;
    let least = (0..3).min_by(|a, b| axis[*a].abs().total_cmp(&axis[*b].abs())).unwrap_or(0);
    let right = axis.cross(&Vector3::ith(least, 1.0)).normalize();
    let up = axis.cross(&right);
    // A short arrow is all head.
    let head = (9.0 * radius).min(length);
    let (neck, tip) = (from + axis * (length - head), from + along);
    let ring = |middle: Vector3<f64>, radius: f64| -> Vec<Vector3<f64>> {
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / SIDES as f64;
        (0..=SIDES).map(|k| middle + (right * angle(k).cos() + up * angle(k).sin()) * radius).collect()
    };
    let wide = ring(neck, head / 3.0);
    let mut corners = Vec::new();
    for k in 0..SIDES {
        corners.extend([wide[k], wide[k + 1], tip]);
        corners.extend([wide[k + 1], wide[k], neck]);
    }
    if length > head {
        let (back, front) = (ring(from, radius), ring(neck, radius));
        for k in 0..SIDES {
            corners.extend([back[k], back[k + 1], front[k + 1], back[k], front[k + 1], front[k]]);
            corners.extend([back[k + 1], back[k], from]);
        }
    }
    corners
}
