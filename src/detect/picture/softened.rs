//! A picture softened, and the inverse of its sharpening.
//!
//! An unsharp mask makes y = x + k (x - G x) of x, with G a Gaussian mean of sigma ρ: a linear map whose eigenvalues lie between
//! 1 and 1 + k. Its inverse therefore amplifies nothing, the noise of the picture included, and Richardson's iteration
//! x ← x + ω (y - x - k (x - G x)) with ω = 2 / (2 + k) finds it, each time nearer by k / (2 + k) at least.

use wide::f32x4;

use super::mean::{LANES, Levels, kernel, side};
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
        let mut samples = vec![0; width * height];
        let (mut levels, mut mean) = (Levels::of(width), Levels::of(width));
        for (strip, samples) in samples.chunks_mut(rows * width).enumerate() {
            let top = strip * rows;
            let bottom = (top + rows).min(height);
            let read = top.saturating_sub(reach)..(bottom + reach).min(height);
            levels.take(plane, read.clone());
            if let Some(Sharpening { amount, radius }) = sharpening {
                let (amount, kernel) = (amount as f32, kernel(radius));
                let step = 2.0 / (2.0 + amount);
                for _ in 0..ITERATIONS {
                    mean.copy(&levels);
                    mean.convolve(&kernel);
                    for ((levels, mean), y) in levels.rows_mut().zip(mean.rows()).zip(read.clone()) {
                        for ((level, mean), sharpened) in levels.iter_mut().zip(mean).zip(plane.row(y)) {
                            *level += step * (sharpened.level() as f32 - *level - amount * (*level - mean));
                        }
                    }
                }
            }
            let own = top - read.start..bottom - read.start;
            let kernel = if sigma > 0.0 { kernel(sigma) } else { vec![1.0] };
            levels.across(&kernel);
            levels.down(&kernel, own.clone(), |x, y, sums| {
                let end = (x + LANES).min(width);
                let to = &mut samples[(y - own.start) * width..][x..end];
                let fours = sums.map(|sum| {
                    let bounded = (sum * f32x4::splat(scale as f32)).fast_max(f32x4::ZERO).fast_min(f32x4::splat(most));
                    // to the nearest whole number; the rounding of the language is a call for every sample
                    (bounded + f32x4::splat(0.5)).fast_trunc_int().to_array()
                });
                for (to, level) in to.iter_mut().zip(fours.as_flattened()) {
                    *to = *level as u16;
                }
            });
        }
        Self { samples, width, height, scale }
    }

    /// Its samples.
    pub fn plane(&self) -> Plane<'_, u16> {
        Plane::new(self.width, self.height, &self.samples)
    }
}

/// How far a sample depends on others.
fn reach(sharpening: Option<Sharpening>, sigma: f64) -> usize {
    side(sigma) + sharpening.map_or(0, |sharpening| ITERATIONS * side(sharpening.radius))
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

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
        let kernel = kernel(1.1);
        let side = kernel.len() as i64 - 1;
        let at = |i: i64, t: i64| soft[(i / 60 * 60 + (i % 60 + t).clamp(0, 59)) as usize];
        let weighted = |i: i64, t: i64| kernel[t.unsigned_abs() as usize] * at(i, t);
        // all rows are the same
        let mean: Vec<f32> = (0..60 * 60).map(|i| (-side..=side).map(|t| weighted(i, t)).sum()).collect();
        let sharp: Vec<u8> = soft.iter().zip(&mean).map(|(s, m)| (s + 1.5 * (s - m)).round() as u8).collect();
        assert!(sharp.iter().zip(&soft).any(|(a, b)| (f32::from(*a) - b).abs() > 5.0));
        let undone = Softened::of(&Plane::new(60, 60, &sharp), Some(Sharpening { amount: 1.5, radius: 1.1 }), 0.0);
        let worst =
            undone.samples.iter().zip(&soft).map(|(a, b)| (f32::from(*a) / 128.0 - b).abs()).fold(0.0, f32::max);
        assert!(worst < 1.0, "{worst}");
    }
}
