//! The normal distribution, four values at a time.

use wide::f32x4;

/// Smallest and largest blur that is rendered, sigma in pixels.
pub(crate) const BLUR: (f64, f64) = (0.2, 7.0);

/// Φ(z) to 1e-7 and its density, by products and sums only, so that every machine gives the same bits.
/// Φ after Abramowitz & Stegun 7.1.26.
#[inline(always)]
pub(crate) fn normal_distribution(z: f32x4) -> (f32x4, f32x4) {
    let horner = |t: f32x4, coefficients: &[f32]| {
        let (last, others) = coefficients.split_last().unwrap_or((&0.0, &[]));
        others.iter().rev().fold(f32x4::splat(*last), |sum, coefficient| f32x4::splat(*coefficient) + t * sum)
    };
    // exp(-z²/2) = exp(-z²/64)^32, the small one by its series
    let x = z * z * f32x4::splat(-1.0 / 64.0);
    let series = horner(x, &[1.0, 1.0, 0.5, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0]);
    let mut exponential = series * series;
    for _ in 0..4 {
        exponential = exponential * exponential;
    }
    let slope = f32x4::splat(0.327_591_1 * std::f32::consts::FRAC_1_SQRT_2);
    let t = f32x4::ONE / (f32x4::ONE + slope * z.abs());
    let coefficients = [0.254_829_592, -0.284_496_736, 1.421_413_741, -1.453_152_027, 1.061_405_429];
    let tail = t * horner(t, &coefficients) * (f32x4::splat(0.5) * exponential);
    let below = z.simd_lt(f32x4::ZERO).select(tail, f32x4::ONE - tail);
    (below, exponential * f32x4::splat(0.398_942_3))
}
