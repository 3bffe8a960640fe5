//! A picture softened, and the inverse of its sharpening.
//!
//! An unsharp mask makes y = x + k (x - G x) of x, with G a Gaussian mean of sigma ρ: a linear map whose eigenvalues lie between
//! 1 and 1 + k. Its inverse therefore amplifies nothing, the noise of the picture included, and Richardson's iteration
//! x ← x + ω (y - x - k (x - G x)) with ω = 2 / (2 + k) finds it, each time nearer by k / (2 + k) at least.

use super::sharpening::Sharpening;
use crate::image::{Plane, Sample};

/// What a grey level of 8 bits becomes: the fractions that a mean has are kept.
const FINE: f64 = 128.0;

/// Iterations of the inverse: at k = 2 what is left is 2^-7 of the sharpening.
const ITERATIONS: usize = 7;

/// Rows of a strip, in those that are read beyond it on each side: a third of all is read twice.
const STRIP: usize = 6;

/// A picture of 16 bits made of another one.
pub(crate) struct Softened {
    samples: Vec<u16>,
    width: usize,
    height: usize,
    /// Its levels per level of the picture.
    pub scale: f64,
}

impl Softened {
    /// The picture with its sharpening undone, if there is one, and then a Gaussian mean of this sigma in pixels.
    ///
    /// Strip by strip: in fractions a large picture would take several times its own memory. A strip reads as many rows beyond its own
    /// as the means reach, so that every sample is that of the picture taken whole.
    pub fn of<T: Sample>(plane: &Plane<T>, sharpening: Option<Sharpening>, sigma: f64) -> Self {
        let reach = reach(sharpening, sigma);
        Self::in_strips(plane, sharpening, sigma, (STRIP * reach).max(1))
    }

    fn in_strips<T: Sample>(plane: &Plane<T>, sharpening: Option<Sharpening>, sigma: f64, rows: usize) -> Self {
        let (width, height) = (plane.width, plane.height);
        let reach = reach(sharpening, sigma);
        let scale = if T::MAX < 256 { FINE } else { 1.0 };
        let most = (f64::from(T::MAX) * scale) as f32;
        let mut samples = Vec::with_capacity(width * height);
        let (mut levels, mut mean) = (Vec::new(), Vec::new());
        for top in (0..height).step_by(rows) {
            let bottom = (top + rows).min(height);
            let read = top.saturating_sub(reach)..(bottom + reach).min(height);
            levels.clear();
            for y in read.clone() {
                levels.extend(plane.row(y).iter().map(|sample| sample.level() as f32));
            }
            if let Some(Sharpening { amount, radius }) = sharpening {
                let (amount, kernel) = (amount as f32, kernel(radius));
                let step = 2.0 / (2.0 + amount);
                for _ in 0..ITERATIONS {
                    mean.clone_from(&levels);
                    convolve(&mut mean, width, &kernel);
                    let rows = levels.chunks_exact_mut(width).zip(mean.chunks_exact(width));
                    for ((levels, mean), y) in rows.zip(read.clone()) {
                        for ((level, mean), sharpened) in levels.iter_mut().zip(mean).zip(plane.row(y)) {
                            *level += step * (sharpened.level() as f32 - *level - amount * (*level - mean));
                        }
                    }
                }
            }
            if sigma > 0.0 {
                convolve(&mut levels, width, &kernel(sigma));
            }
            // to the nearest whole number; the rounding of the language is a call for every sample
            let own = &levels[(top - read.start) * width..(bottom - read.start) * width];
            samples.extend(own.iter().map(|level| ((level * scale as f32).clamp(0.0, most) + 0.5) as u16));
        }
        Self { samples, width, height, scale }
    }

    /// Its samples.
    pub fn plane(&self) -> Plane<'_, u16> {
        Plane::new(self.width, self.height, &self.samples)
    }
}

/// How many samples a Gaussian mean takes on each side.
fn side(sigma: f64) -> usize {
    (3.5 * sigma).ceil() as usize
}

/// How far a sample depends on others.
fn reach(sharpening: Option<Sharpening>, sigma: f64) -> usize {
    side(sigma) + sharpening.map_or(0, |sharpening| ITERATIONS * side(sharpening.radius))
}

/// Weights of a Gaussian mean from the middle on.
fn kernel(sigma: f64) -> Vec<f32> {
    let side = side(sigma) as i32;
    let weight = |t: i32| (-0.5 * (f64::from(t) / sigma).powi(2)).exp();
    let sum: f64 = (-side..=side).map(weight).sum();
    (0..=side).map(|t| (weight(t) / sum) as f32).collect()
}

/// Convolves rows and columns with a symmetric kernel; beyond the border its samples go on.
fn convolve(levels: &mut [f32], width: usize, kernel: &[f32]) {
    let side = kernel.len() - 1;
    let mut padded = vec![0f32; width + 2 * side];
    for row in levels.chunks_exact_mut(width) {
        padded[side..side + width].copy_from_slice(row);
        padded[..side].fill(row[0]);
        padded[side + width..].fill(row[width - 1]);
        for (x, level) in row.iter_mut().enumerate() {
            *level = kernel[0] * padded[x + side];
        }
        for (t, weight) in kernel.iter().enumerate().skip(1) {
            let pairs = padded[side - t..].iter().zip(&padded[side + t..]);
            for (level, (left, right)) in row.iter_mut().zip(pairs) {
                *level += weight * (left + right);
            }
        }
    }
    // columns: whole rows are added, of which as many as the kernel reaches are kept as they were
    let height = levels.len() / width;
    let mut above: std::collections::VecDeque<Vec<f32>> = (0..=side).map(|_| levels[..width].to_vec()).collect();
    for y in 0..height {
        let own = levels[y * width..(y + 1) * width].to_vec();
        above.rotate_left(1);
        if let Some(last) = above.back_mut() {
            last.clone_from(&own);
        }
        let mut sum: Vec<f32> = own.iter().map(|level| kernel[0] * level).collect();
        for (t, weight) in kernel.iter().enumerate().skip(1) {
            let upper = &above[side - t];
            let below = (y + t).min(height - 1) * width;
            // a row above the last one stands as it was; the last row itself is still its own
            for ((sum, upper), lower) in sum.iter_mut().zip(upper).zip(&levels[below..below + width]) {
                *sum += weight * (upper + lower);
            }
        }
        levels[y * width..(y + 1) * width].copy_from_slice(&sum);
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn a_mean_keeps_the_light_and_a_flat_picture() {
        let mut levels = vec![0f32; 41 * 41];
        levels[20 * 41 + 20] = 1000.0;
        convolve(&mut levels, 41, &kernel(1.6));
        assert!((levels.iter().sum::<f32>() - 1000.0).abs() < 0.1);
        let variance: f32 =
            (0..41 * 41).map(|i| levels[i] * (i as f32 / 41.0).floor().mul_add(1.0, -20.0).powi(2)).sum();
        assert!((variance / 1000.0 - 2.56).abs() < 0.05, "{variance}");
        let turned: Vec<f32> = (0..41 * 41).map(|i| levels[(i % 41) * 41 + i / 41]).collect();
        assert!(levels.iter().zip(&turned).all(|(a, b)| (a - b).abs() < 1e-3));
        let mut flat = vec![7f32; 12 * 5];
        convolve(&mut flat, 12, &kernel(3.0));
        assert!(flat.iter().all(|level| (level - 7.0).abs() < 1e-4));
    }

    #[test]
    fn strips_are_the_picture_taken_whole() {
        let noise: Vec<u8> = (0..37u32 * 90).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
        let plane = Plane::new(37, 90, &noise);
        for sharpening in [None, Some(Sharpening { amount: 1.2, radius: 0.5 })] {
            let whole = Softened::in_strips(&plane, sharpening, 0.7, 90);
            for rows in [1, 16, 41] {
                assert!(Softened::in_strips(&plane, sharpening, 0.7, rows).samples == whole.samples, "{rows} rows");
            }
        }
    }

    #[test]
    fn sharpening_is_undone() {
        let soft: Vec<f32> =
            (0..60 * 60).map(|i| 60.0 + 100.0 / (1.0 + (-(i as f32 % 60.0 - 30.0) / 0.8).exp())).collect();
        let mut mean = soft.clone();
        convolve(&mut mean, 60, &kernel(1.1));
        let sharp: Vec<u8> = soft.iter().zip(&mean).map(|(s, m)| (s + 1.5 * (s - m)).round() as u8).collect();
        assert!(sharp.iter().zip(&soft).any(|(a, b)| (f32::from(*a) - b).abs() > 5.0));
        let undone = Softened::of(&Plane::new(60, 60, &sharp), Some(Sharpening { amount: 1.5, radius: 1.1 }), 0.0);
        let worst =
            undone.samples.iter().zip(&soft).map(|(a, b)| (f32::from(*a) / 128.0 - b).abs()).fold(0.0, f32::max);
        assert!(worst < 1.0, "{worst}");
    }
}
