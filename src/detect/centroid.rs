//! Weighted centroids, the classical centre operators.
//!
//! u = Σ w x / Σ w over the pixels around the target, with w either the grey level above a threshold (intensity-weighted,
//! Lee 1996 eq. 3-2) or the squared gradient of the grey levels (gradient-weighted, eq. 3-1). Both are simple and fast; the
//! first takes in what lies in the window beside the target, the second weighs the rim and its noise twice. Their sigma is
//! the propagated noise of the pixels and of the slopes; for the first also the coming and going of pixels at its threshold, and what
//! that cuts off.
//!
//! Levels are taken less the background and over the light of their place ([`lit`](super::edges::lit)): light that rises by a tenth
//! over a disc of diameter d moves the first by 0.006 d, the second by 0.025 d.

use wide::f32x4;

use super::acceptance::place::{STEEP, WEIGHTED};
use super::edges::lit::Light;
use super::edges::surround::Surround;
use super::ellipse::outline::Outline;
use super::normal::normal_distribution;
use crate::image::{Sample, SampleView};

/// A centre with its covariance (uu, uv, vv).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Centre {
    pub u: f64,
    pub v: f64,
    pub covariance: [f64; 3],
}

/// Sums of a weighted centroid; places are relative to the outline's centre.
#[derive(Default)]
struct CentroidSums {
    w: f64,
    wx: f64,
    wy: f64,
}

impl CentroidSums {
    fn add(&mut self, w: f64, x: f64, y: f64) {
        self.w += w;
        self.wx += w * x;
        self.wy += w * y;
    }

    fn centre(&self) -> Option<[f64; 2]> {
        let centre = [self.wx / self.w, self.wy / self.w];
        (self.w > 0.0 && centre.iter().all(|c| c.is_finite())).then_some(centre)
    }
}

/// Centroid of the grey levels above the background plane plus a threshold, within `margin` pixels of the outline.
pub(crate) fn intensity<T: Sample>(
    plane: &SampleView<T>,
    outline: &Outline,
    surround: &Surround,
    light: &Light,
    margin: f64,
) -> Option<Centre> {
    let above = |column: usize, row: usize, x: f64, y: f64| {
        let background = surround.level + surround.slope[0] * x + surround.slope[1] * y;
        let level = f64::from(plane.row(row)[column].level());
        (level - background) * surround.contrast.signum() / light.at(x, y)
    };
    let threshold = (WEIGHTED[0] * surround.contrast.abs()).max(WEIGHTED[1] * surround.noise);
    let weights = |visit: &mut dyn FnMut(f64, f64, f64)| {
        pixels(plane, outline, margin, &mut |column, row, x, y| {
            let above = above(column, row, x, y);
            if above > threshold {
                visit(above, x, y);
            }
        });
    };
    let mut sums = CentroidSums::default();
    weights(&mut |w, x, y| sums.add(w, x, y));
    let [u, v] = sums.centre()?;
    let mut covariance = [0.0; 3];
    let noise = surround.noise.max(12f64.sqrt().recip());
    let (mut slopes, mut cut, mut chance) = ([[[0.0; 2]; 2]; 2], [0.0; 2], 0.0);
    pixels(plane, outline, margin, &mut |column, row, x, y| {
        let (above, lit) = (above(column, row, x, y), light.at(x, y));
        let noise = noise / lit;
        let moved = [(x - u) / sums.w, (y - v) / sums.w];
        add_outer(&mut covariance, moved[0], moved[1], variance_above(above, threshold, noise));
        if above > threshold {
            let [of_background, of_contrast] = [surround.contrast.signum() / lit, above / surround.contrast / lit];
            add_slopes(&mut slopes, moved, [x, y], [of_background, of_contrast]);
        } else {
            // what the threshold cuts off at the rim is lost, a little more on one side than on the other
            cut = [cut[0] + above * moved[0], cut[1] + above * moved[1]];
            chance += (moved[0] * moved[0] + moved[1] * moved[1]) * noise * noise;
        }
    });
    for (sum, carried) in covariance.iter_mut().zip(light.carried(slopes[0], slopes[1])) {
        *sum += carried;
    }
    // as far as it is more than the noise of what was cut off
    let square = cut[0] * cut[0] + cut[1] * cut[1];
    add_outer(&mut covariance, cut[0], cut[1], (1.0 - chance / square.max(1e-300)).max(0.0));
    Some(Centre { u: outline.u + u, v: outline.v + v, covariance })
}

/// Variance of what a level m with noise n leaves above a threshold T: of w where w > T, else 0. Near the threshold a pixel
/// comes and goes with its noise, and with it all of T. From the moments of the truncated normal distribution, with a =
/// (T - m) / n: E = m P + n φ(a), E² = (m² + n²) P + n (m + T) φ(a), P = Φ(-a).
fn variance_above(level: f64, threshold: f64, noise: f64) -> f64 {
    let a = ((threshold - level) / noise).clamp(-5.5, 5.5);
    let (below, density) = normal_distribution(f32x4::splat(a as f32));
    let [share, density] = [1.0 - f64::from(below.to_array()[0]), f64::from(density.to_array()[0])];
    let mean = level * share + noise * density;
    let square = (level * level + noise * noise) * share + noise * (level + threshold) * density;
    (square - mean * mean).max(0.0)
}

/// Centroid of the squared gradient (central differences), within `margin` pixels of the outline.
pub(crate) fn gradient<T: Sample>(
    plane: &SampleView<T>,
    outline: &Outline,
    surround: &Surround,
    light: &Light,
    margin: f64,
) -> Option<Centre> {
    let slope = |column: usize, row: usize| {
        let at = |column: usize, row: usize| {
            let (column, row) = (column.min(plane.width - 1), row.min(plane.height - 1));
            let (x, y) = (column as f64 + 0.5 - outline.u, row as f64 + 0.5 - outline.v);
            let background = surround.level + surround.slope[0] * x + surround.slope[1] * y;
            (f64::from(plane.row(row)[column].level()) - background) / light.at(x, y)
        };
        let gx = (at(column + 1, row) - at(column.saturating_sub(1), row)) / 2.0;
        let gy = (at(column, row + 1) - at(column, row.saturating_sub(1))) / 2.0;
        // differences of noise alone have a variance of half the noise's in each direction
        let square = gx * gx + gy * gy;
        if square > STEEP * surround.noise.powi(2) { [gx, gy] } else { [0.0, 0.0] }
    };
    let mut sums = CentroidSums::default();
    pixels(plane, outline, margin, &mut |column, row, x, y| {
        let [gx, gy] = slope(column, row);
        sums.add(gx * gx + gy * gy, x, y);
    });
    let [u, v] = sums.centre()?;
    // each pixel enters the gradients of its four neighbours
    let (mut covariance, mut slopes) = ([0.0; 3], [[[0.0; 2]; 2]; 2]);
    let noise = surround.noise.powi(2).max(1.0 / 12.0);
    pixels(plane, outline, margin + 1.0, &mut |column, row, x, y| {
        let lit = light.at(x, y);
        let left = slope(column.saturating_sub(1), row)[0];
        let right = slope(column + 1, row)[0];
        let above = slope(column, row.saturating_sub(1))[1];
        let below = slope(column, row + 1)[1];
        let du = (x - 1.0 - u) * left - (x + 1.0 - u) * right + (x - u) * (above - below);
        let dv = (y - v) * (left - right) + (y - 1.0 - v) * above - (y + 1.0 - v) * below;
        add_outer(&mut covariance, du / sums.w, dv / sums.w, noise / (lit * lit));
        // what each pixel's level moves, its part in both slopes moves
        let level = f64::from(plane.row(row)[column].level());
        let above = level - surround.level - surround.slope[0] * x - surround.slope[1] * y;
        add_slopes(
            &mut slopes,
            [du / sums.w, dv / sums.w],
            [x, y],
            [1.0 / lit, above / surround.contrast / (lit * lit)],
        );
    });
    for (sum, carried) in covariance.iter_mut().zip(light.carried(slopes[0], slopes[1])) {
        *sum += carried;
    }
    Some(Centre { u: outline.u + u, v: outline.v + v, covariance })
}

/// Adds what the slopes of background and contrast do to a centre through a pixel: `moved` is the centre's change with the level there,
/// which changes by so much with each.
fn add_slopes(slopes: &mut [[[f64; 2]; 2]; 2], moved: [f64; 2], place: [f64; 2], of_level: [f64; 2]) {
    for (slope, of_level) in slopes.iter_mut().zip(of_level) {
        for (row, moved) in slope.iter_mut().zip(moved) {
            for (sum, place) in row.iter_mut().zip(place) {
                *sum -= moved * place * of_level;
            }
        }
    }
}

fn add_outer(covariance: &mut [f64; 3], du: f64, dv: f64, variance: f64) {
    for (sum, product) in covariance.iter_mut().zip([du * du, du * dv, dv * dv]) {
        *sum += product * variance;
    }
}

/// Visits the pixels within `margin` pixels of the outline: column, row, place relative to the outline's centre.
fn pixels<T: Sample>(
    plane: &SampleView<T>,
    outline: &Outline,
    margin: f64,
    visit: &mut dyn FnMut(usize, usize, f64, f64),
) {
    let grown = outline.grown(margin);
    let half = grown.half_box().1;
    for row in (outline.v - half).max(0.0) as usize..((outline.v + half + 1.0).max(0.0) as usize).min(plane.height) {
        let Some((from, to)) = grown.chord(row as f64 + 0.5) else { continue };
        for column in (from + 0.5).max(0.0) as usize..((to + 0.5).max(0.0) as usize).min(plane.width) {
            visit(column, row, column as f64 + 0.5 - outline.u, row as f64 + 0.5 - outline.v);
        }
    }
}
