//! Polygon files (Turk 1994, ASCII) for viewers of point clouds: the points with their standard errors, the exaggerated error
//! ellipsoids as triangles, the cameras as edges.

use std::fmt::Write;

use nalgebra::Vector3;

use super::Files;
use super::spatial::{Spatial, colour, sphere};
use sightline::adjustment::Adjustment;
use sightline::project::Project;

/// `points.ply`, `ellipsoids.ply` where there are covariances, `cameras.ply` where photos are oriented.
pub fn write(project: &Project, adjustment: Option<&Adjustment>) -> Files {
    let spatial = Spatial::of(project, adjustment);
    let unit: String = project.unit.chars().filter(char::is_ascii_graphic).collect();
    let head = |comment: &str| format!("ply\nformat ascii 1.0\ncomment Sightline, unit {unit}{comment}\n");
    let mut files = Files::new();
    let mut text = head("");
    let _ = write!(text, "element vertex {}\n{XYZ}", spatial.spots.len());
    text.push_str("property uchar red\nproperty uchar green\nproperty uchar blue\n");
    text.push_str("property double sx\nproperty double sy\nproperty double sz\nproperty int rays\nend_header\n");
    for spot in &spatial.spots {
        let ([x, y, z], [r, g, b]) = (spot.xyz, colour(spot.point.role));
        let [sx, sy, sz] = spot.sigma.unwrap_or_default();
        let _ = writeln!(text, "{x} {y} {z} {r} {g} {b} {sx} {sy} {sz} {}", spot.rays);
    }
    files.insert("points.ply".into(), text.into_bytes());
    if spatial.spots.iter().any(|s| s.ellipsoid.is_some()) {
        files.insert("ellipsoids.ply".into(), ellipsoids(&spatial, &head).into_bytes());
    }
    if !spatial.views.is_empty() {
        files.insert("cameras.ply".into(), cameras(&spatial, &head).into_bytes());
    }
    files
}

const XYZ: &str = "property double x\nproperty double y\nproperty double z\n";

fn ellipsoids(spatial: &Spatial, head: &impl Fn(&str) -> String) -> String {
    let (corners, faces) = sphere();
    let all: Vec<_> = spatial.spots.iter().filter_map(|s| Some((s, s.ellipsoid?))).collect();
    let mut text = head(&format!(", error ellipsoids of 1 sigma, {} times", spatial.factor));
    let _ = write!(text, "element vertex {}\n{XYZ}", all.len() * corners.len());
    let _ =
        write!(text, "element face {}\nproperty list uchar int vertex_indices\nend_header\n", all.len() * faces.len());
    for (spot, axes) in &all {
        for corner in &corners {
            let at = Vector3::from(spot.xyz) + spatial.factor * (axes * Vector3::from(*corner));
            let _ = writeln!(text, "{} {} {}", at.x, at.y, at.z);
        }
    }
    for k in 0..all.len() {
        for face in &faces {
            let [a, b, c] = face.map(|corner| corner as usize + k * corners.len());
            let _ = writeln!(text, "3 {a} {b} {c}");
        }
    }
    text
}

fn cameras(spatial: &Spatial, head: &impl Fn(&str) -> String) -> String {
    let mut text = head(", projection centres and photos");
    let _ = write!(text, "element vertex {}\n{XYZ}element edge {}\n", spatial.views.len() * 5, spatial.views.len() * 8);
    text.push_str("property int vertex1\nproperty int vertex2\nend_header\n");
    for [x, y, z] in spatial.views.iter().flat_map(|v| v.frustum) {
        let _ = writeln!(text, "{x} {y} {z}");
    }
    for k in 0..spatial.views.len() {
        for corner in 0..4 {
            let at = 5 * k + 1;
            let _ = writeln!(text, "{} {}\n{} {}", 5 * k, at + corner, at + corner, at + (corner + 1) % 4);
        }
    }
    text
}
