//! Covariance of an ellipse's centre from the noise of the pixels.
//!
//! A ray's edge is a weighted sum of bilinear samples, and these of pixels; the centre is a weighted sum of edges. Neighbouring
//! rays share pixels, so that their errors are alike: treated as independent they promise too much, by a third. Here the
//! weights of every pixel in the centre are added up, and the noise is propagated through them: Σ = n² W W'. The background's
//! slope comes from other pixels; its errors move the centre by the same weights.

use nalgebra::SMatrix;
use wide::f32x4;

use super::edge::{EdgeProfile, Edges, slopes};
use crate::detect::ellipse::outline::Outline;
use crate::detect::ellipse::rays::rim_points;
use crate::detect::normal::normal_distribution;

/// Sensitivity of a centre to its pixels.
pub(crate) struct CentreSensitivity {
    /// Covariance (uu, uv, vv) of the centre for pixels of unit noise.
    pub noise: [f64; 3],
    /// Change of the centre with the slope of the background that is taken off, and with that of the contrast.
    pub slope: [[f64; 2]; 2],
    pub light: [[f64; 2]; 2],
    /// Mean variance of a single edge, for pixels of unit noise.
    pub edge: f64,
}

/// Φ(z).
fn normal_share(z: f64) -> f64 {
    f64::from(normal_distribution(f32x4::splat(z.clamp(-5.5, 5.5) as f32)).0.to_array()[0])
}

/// Influence of the pixels on the centre of an ellipse.
///
/// `points` are the edges found on rays across `cast`, `fitted` is the ellipse through them and `cofactors` the inverse of its
/// normal matrix.
pub(crate) fn influence(
    cast: &Outline,
    profile: &EdgeProfile,
    points: &Edges,
    fitted: &Outline,
    cofactors: &SMatrix<f64, 5, 5>,
) -> CentreSensitivity {
    let slopes = slopes(profile.blur);
    let side = (slopes.len() / 2) as f64;
    let square: f64 = slopes.iter().map(|slope| slope * slope).sum();
    let (half_u, half_v) = cast.half_box();
    let [left, top] = [cast.u - half_u - side - 2.0, cast.v - half_v - side - 2.0].map(f64::floor);
    let [width, height] = [half_u, half_v].map(|half| (2.0 * (half + side)) as usize + 6);
    let mut weights = vec![[0.0; 2]; width * height];
    let (mut edges, mut used) = (0.0, 0usize);
    let mut shares: Vec<(usize, f64)> = Vec::with_capacity(4 * slopes.len());
    for (ray, rim) in rim_points(cast, points.len()).enumerate().filter(|(ray, _)| points.is_kept(*ray)) {
        shares.clear();
        for (i, slope) in slopes.iter().enumerate() {
            let t = i as f64 - side;
            let [x, y] = [rim.x + t * rim.normal[0] - 0.5 - left, rim.y + t * rim.normal[1] - 0.5 - top];
            let [fx, fy] = [x - x.floor(), y - y.floor()];
            let at = y as usize * width + x as usize;
            let weight = slope / (square * profile.contrast);
            for (offset, share) in
                [(0, (1.0 - fx) * (1.0 - fy)), (1, fx * (1.0 - fy)), (width, (1.0 - fx) * fy), (width + 1, fx * fy)]
            {
                shares.push((at + offset, weight * share));
            }
        }
        shares.sort_unstable_by_key(|share| share.0);
        let [x, y] = points.place(ray);
        let moves = fitted.nearest(x, y).0.moves;
        let moved = cofactors * SMatrix::<f64, 5, 1>::from(moves);
        for pixel in shares.chunk_by(|a, b| a.0 == b.0) {
            let share: f64 = pixel.iter().map(|share| share.1).sum();
            edges += share * share;
            if let Some(weight) = weights.get_mut(pixel[0].0) {
                *weight = [weight[0] + share * moved[0], weight[1] + share * moved[1]];
            }
        }
        used += 1;
    }
    let sum = |i: usize, j: usize| weights.iter().map(|weight| weight[i] * weight[j]).sum();
    let (mut slope, mut light) = ([[0.0; 2]; 2], [[0.0; 2]; 2]);
    for (at, weight) in weights.iter().enumerate().filter(|(_, weight)| **weight != [0.0; 2]) {
        let [x, y] = [(at % width) as f64 + 0.5 + left, (at / width) as f64 + 0.5 + top];
        let place = [x - profile.origin[0], y - profile.origin[1]];
        let disc = 1.0 - normal_share(cast.distance(x, y) / profile.blur);
        for ((row, lit), weight) in slope.iter_mut().zip(&mut light).zip(weight) {
            for (k, place) in place.into_iter().enumerate() {
                row[k] -= weight * place;
                lit[k] -= weight * place * disc;
            }
        }
    }
    CentreSensitivity { noise: [sum(0, 0), sum(0, 1), sum(1, 1)], slope, light, edge: edges / used.max(1) as f64 }
}
