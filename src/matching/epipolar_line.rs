//! The image of a ray in another photo: a straight line in ideal coordinates, curved by the distortion.
//!
//! Points C₁ + t·d of the ray have the camera-frame image a + t·b with a = M₂(C₁ - C₂) and b = M₂·d. Its part in the picture
//! is found in ideal coordinates, in the box of the picture's border; corners are added until no piece bends away from its
//! chord by more than [`BEND_PX`].

use nalgebra::Vector3;

use super::photo::OrientedPhoto;
use crate::camera::pixel_from_camera_point;

/// Largest distance of the course from its chords, pixels.
const BEND_PX: f64 = 0.1;
/// Halvings of a piece at most.
const DEEPEST: u32 = 8;
/// Pieces that the visible part begins with: some may lie where the distortion has no inverse.
const PIECES: usize = 8;

/// Course of the ray of ideal coordinates `image` of `first` in `second`, pixels; empty if it does not cross the picture.
pub(super) fn epipolar_line(first: &OrientedPhoto, second: &OrientedPhoto, image: [f64; 2]) -> Vec<[f64; 2]> {
    let a = second.pose.object_to_camera * (first.pose.centre - second.pose.centre);
    let b = second.pose.object_to_camera * first.pose.ray(image);
    let Some((from, to)) = visible(second, &a, &b) else { return Vec::new() };
    let (width, height) = (f64::from(second.camera.width), f64::from(second.camera.height));
    let pixel = |s: f64| {
        let at = [0, 1].map(|k| from[k] + s * (to[k] - from[k]));
        let [u, v] = pixel_from_camera_point(&second.camera, Vector3::new(at[0], at[1], -1.0))?;
        let near = (-0.1 * width..1.1 * width).contains(&u) && (-0.1 * height..1.1 * height).contains(&v);
        near.then_some([u, v])
    };
    let mut longest = Vec::new();
    let mut course = Vec::new();
    for k in 0..PIECES {
        let (start, end) = (k as f64 / PIECES as f64, (k + 1) as f64 / PIECES as f64);
        if let (Some(p), Some(q)) = (pixel(start), pixel(end)) {
            if course.is_empty() {
                course.push(p);
            }
            bend(&pixel, [start, end], [p, q], DEEPEST, &mut course);
        } else {
            course.clear();
        }
        if course.len() > longest.len() {
            longest.clone_from(&course);
        }
    }
    longest
}

/// Adds the corners of a piece after its first.
fn bend(
    pixel: &impl Fn(f64) -> Option<[f64; 2]>,
    [start, end]: [f64; 2],
    [p, q]: [[f64; 2]; 2],
    depth: u32,
    course: &mut Vec<[f64; 2]>,
) {
    let middle = 0.5 * (start + end);
    if let Some(m) = pixel(middle).filter(|_| depth > 0) {
        let (length, area) =
            ((q[0] - p[0]).hypot(q[1] - p[1]), (q[0] - p[0]) * (m[1] - p[1]) - (q[1] - p[1]) * (m[0] - p[0]));
        if area.abs() > BEND_PX * length {
            bend(pixel, [start, middle], [p, m], depth - 1, course);
            return bend(pixel, [middle, end], [m, q], depth - 1, course);
        }
    }
    course.push(q);
}

/// Ends, in ideal coordinates, of the part of the half-line a + t·b, t > 0, that is before the camera and in the picture.
fn visible(photo: &OrientedPhoto, a: &Vector3<f64>, b: &Vector3<f64>) -> Option<([f64; 2], [f64; 2])> {
    let [low, high] = bounds(photo);
    // Homogeneous points a + t·b with t = s/(1 - s): each condition is linear in s, so that infinity is a place like others.
    let scale = a.norm();
    let (a, b) = (*a, b * scale);
    let mut range = [0.0_f64, 1.0_f64];
    let depth = |p: &Vector3<f64>| -p.z - 1e-6 * scale;
    let mut conditions = vec![[depth(&a), depth(&b)]];
    for k in 0..2 {
        conditions.push([a[k] + low[k] * a.z, b[k] + low[k] * b.z]);
        conditions.push([-a[k] - high[k] * a.z, -b[k] - high[k] * b.z]);
    }
    for [at_start, at_end] in conditions {
        let root = at_start / (at_start - at_end);
        match (at_start >= 0.0, at_end >= 0.0) {
            (true, true) => {}
            (false, false) => return None,
            (true, false) => range[1] = range[1].min(root),
            (false, true) => range[0] = range[0].max(root),
        }
    }
    let image = |s: f64| {
        let p = a * (1.0 - s) + b * s;
        [-p.x / p.z, -p.y / p.z]
    };
    let ends = (image(range[0]), image(range[1]));
    let finite = ends.0.iter().chain(&ends.1).all(|x| x.is_finite());
    (scale > 0.0 && range[0] < range[1] && finite).then_some(ends)
}

/// Box of the picture's border in ideal coordinates.
fn bounds(photo: &OrientedPhoto) -> [[f64; 2]; 2] {
    let (width, height) = (f64::from(photo.camera.width), f64::from(photo.camera.height));
    let parts = [0.0, 0.25, 0.5, 0.75, 1.0];
    let border =
        parts.iter().flat_map(|p| [[p * width, 0.0], [p * width, height], [0.0, p * height], [width, p * height]]);
    let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for at in border.filter_map(|pixel| photo.ray(pixel)) {
        for k in 0..2 {
            bounds[0][k] = bounds[0][k].min(at[k]);
            bounds[1][k] = bounds[1][k].max(at[k]);
        }
    }
    bounds
}
