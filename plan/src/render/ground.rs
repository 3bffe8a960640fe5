//! The textured ground: one ray a pixel onto the nearest face, grains of noise on it, blurred by the point spread.

use nalgebra::Vector3;

use crate::scene::Scene;
use sightline::camera::ideal_from_pixel;
use sightline::initial::Pose;
use sightline::project::Camera;

/// Mean greys of the pixels without targets, row by row.
pub fn ground(camera: &Camera, pose: &Pose, scene: &Scene, psf: f64) -> Vec<f32> {
    let (width, height) = (camera.width as usize, camera.height as usize);
    if scene.faces.is_empty() {
        return vec![scene.background as f32; width * height];
    }
    // Rays at every other pixel corner, straight lines between: the grains are coarser and the point spread hides it.
    let (columns, rows) = (width / 2 + 2, height / 2 + 2);
    let camera_to_object = pose.object_to_camera.transpose();
    let mut nodes: Vec<f32> = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        for column in 0..columns {
            let grey =
                ideal_from_pixel(camera, [2.0 * column as f64, 2.0 * row as f64]).map_or(scene.background, |[x, y]| {
                    let ray = camera_to_object * Vector3::new(x, y, -1.0);
                    seen(scene, &pose.centre, &ray)
                });
            nodes.push(grey as f32);
        }
    }
    let mut greys = Vec::with_capacity(width * height);
    for row in 0..height {
        let (upper, lower) = (&nodes[row / 2 * columns..], &nodes[(row / 2 + 1) * columns..]);
        let down = if row % 2 == 0 { 0.25 } else { 0.75 };
        let between = |k: usize| upper[k] + down * (lower[k] - upper[k]);
        for column in 0..width {
            let across = if column % 2 == 0 { 0.25 } else { 0.75 };
            let left = between(column / 2);
            greys.push(left + across * (between(column / 2 + 1) - left));
        }
    }
    blur(&mut greys, width, psf);
    greys
}

/// Grey of the nearest face along a ray.
fn seen(scene: &Scene, from: &Vector3<f64>, ray: &Vector3<f64>) -> f64 {
    let hits = scene.faces.iter().enumerate().filter_map(|(i, face)| face.meet(from, ray).map(|hit| (i, hit)));
    let Some((index, (_, [a, b]))) = hits.min_by(|x, y| x.1.0.total_cmp(&y.1.0)) else { return scene.background };
    let face = &scene.faces[index];
    if face.texture == 0.0 {
        return face.grey;
    }
    let x = a * Vector3::from(face.along).norm() / face.grain;
    let y = b * Vector3::from(face.across).norm() / face.grain;
    let salt = index as u32 * 7;
    // Three octaves; their standard deviations add up to one.
    let texture =
        2.2 * grains(x, y, salt) + 1.3 * grains(2.1 * x, 2.1 * y, salt + 1) + grains(5.3 * x, 5.3 * y, salt + 2);
    face.grey + face.texture * texture
}

/// Smooth noise of mean 0: random values at whole numbers, blended by a cubic between them.
fn grains(x: f64, y: f64, salt: u32) -> f64 {
    let (column, row) = (x.floor(), y.floor());
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let (sx, sy) = (smooth(x - column), smooth(y - row));
    let (i, j) = (column as i64 as u32, row as i64 as u32);
    let value = |di: u32, dj: u32| scattered(i.wrapping_add(di), j.wrapping_add(dj), salt);
    let upper = value(0, 0) * (1.0 - sx) + value(1, 0) * sx;
    let lower = value(0, 1) * (1.0 - sx) + value(1, 1) * sx;
    upper * (1.0 - sy) + lower * sy
}

/// A number from -½ to ½ that depends on three whole numbers without a pattern (multiplicative hashing).
fn scattered(i: u32, j: u32, salt: u32) -> f64 {
    let mut h = i.wrapping_mul(0x9e37_79b1) ^ j.wrapping_mul(0x85eb_ca77) ^ salt.wrapping_mul(0xc2b2_ae3d);
    h = (h ^ h >> 15).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ h >> 12).wrapping_mul(0x297a_2d39);
    f64::from(h ^ h >> 15) / f64::from(u32::MAX) - 0.5
}

/// Gaussian blur along rows, then columns; the border repeats its last pixel.
fn blur(greys: &mut [f32], width: usize, sigma: f64) {
    let reach = (3.0 * sigma).ceil() as usize;
    let mut weights: Vec<f32> = (0..=reach).map(|d| (-0.5 * (d as f64 / sigma).powi(2)).exp() as f32).collect();
    let sum = 2.0 * weights.iter().sum::<f32>() - weights[0];
    weights.iter_mut().for_each(|w| *w /= sum);
    let height = greys.len() / width;
    let mut rows = vec![0.0; greys.len()];
    for (line, out) in greys.chunks_exact(width).zip(rows.chunks_exact_mut(width)) {
        for (column, out) in out.iter_mut().enumerate() {
            let side = |d: usize| line[column.saturating_sub(d)] + line[(column + d).min(width - 1)];
            *out = weights[0] * line[column] + (1..=reach).map(|d| weights[d] * side(d)).sum::<f32>();
        }
    }
    for row in 0..height {
        let out = &mut greys[row * width..(row + 1) * width];
        out.iter_mut().zip(&rows[row * width..]).for_each(|(o, v)| *o = weights[0] * v);
        for d in 1..=reach {
            for other in [row.saturating_sub(d), (row + d).min(height - 1)] {
                let line = &rows[other * width..(other + 1) * width];
                out.iter_mut().zip(line).for_each(|(o, v)| *o += weights[d] * v);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn texture_has_mean_zero_and_the_spread_of_one() {
        let n = 200;
        let mut sums = [0.0; 2];
        for i in 0..n * n {
            let (x, y) = ((i % n) as f64 * 0.37, (i / n) as f64 * 0.41);
            let t = 2.2 * grains(x, y, 0) + 1.3 * grains(2.1 * x, 2.1 * y, 1) + grains(5.3 * x, 5.3 * y, 2);
            sums[0] += t;
            sums[1] += t * t;
        }
        let (mean, square) = (sums[0] / (n * n) as f64, sums[1] / (n * n) as f64);
        assert!(mean.abs() < 0.05 && (0.25..1.2).contains(&square), "{mean} {square}");
    }

    #[test]
    fn blur_keeps_the_sum_and_has_its_width() {
        let width = 21;
        let mut greys = vec![0.0; width * width];
        greys[10 * width + 10] = 1.0;
        blur(&mut greys, width, 1.5);
        let sum: f32 = greys.iter().sum();
        let spread: f32 = greys.iter().enumerate().map(|(i, g)| g * ((i % width) as f32 - 10.0).powi(2)).sum();
        assert!((sum - 1.0).abs() < 1e-5 && (spread - 2.25).abs() < 0.15, "{sum} {spread}");
    }
}
