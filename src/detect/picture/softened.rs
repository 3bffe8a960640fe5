//! A smoothed copy of a picture, and the inverse of its sharpening.
//!
//! An unsharp mask makes y = x + k (x - G x) of x, with G a Gaussian mean of sigma ρ: a linear map, 1 + k - k g on what G multiplies
//! by g, between 1 and 1 + k. Its inverse therefore amplifies nothing, the noise of the picture included. It is a function of g alone, and so
//! is a polynomial in G: of those of n terms the one that Chebyshev's iteration (Golub and Varga, 1961) takes,
//! p(g) = (1 - T(2g - 1) / T(1 + 2/k)) / (1 + k - k g), with T Chebyshev's polynomial of degree n, leaves least of the sharpening in the
//! worst case, 1 / T(1 + 2/k). By Horner's rule its n - 1 means follow one on the other.

use wide::f32x4;

use super::mean::{LANES, Levels, kernel, side};
use super::sharpening::Sharpening;
use crate::detect::window::Window;
use crate::image::{Sample, SampleView};

/// What a grey level of 8 bits becomes: the fractions that a mean has are kept.
const FINE: f64 = 128.0;

/// Maximum amplification at any frequency when a sharpening is undone: with two means at k = 1, three at 2.
const LEFT: f64 = 0.0115;

/// A picture of 16 bits made of another one.
pub(crate) struct Softened {
    pub samples: Vec<u16>,
    width: usize,
    height: usize,
    /// Its levels per level of the picture.
    pub scale: f64,
}

impl Softened {
    /// The picture with its sharpening undone, if there is one, and then a Gaussian mean of this sigma in pixels.
    pub fn of<T: Sample>(plane: &SampleView<T>, sharpening: Option<Sharpening>, sigma: f64) -> Self {
        let (width, height) = (plane.width, plane.height);
        let scale = if T::MAX < 256 { FINE } else { 1.0 };
        let most = (f64::from(T::MAX) * scale) as f32;
        let mut samples = vec![0; width * height];
        let mut levels = Levels::of(width);
        levels.take(plane, 0..height);
        if let Some(sharpening) = sharpening {
            let (kernel, factors) = (kernel(sharpening.radius), inverse(sharpening.amount));
            if let Some((highest, others)) = factors.split_last() {
                let mut sharpened = Levels::of(width);
                sharpened.scaled(&levels, 1.0);
                levels.scaled(&sharpened, *highest);
                others.iter().rev().for_each(|factor| levels.convolve(&kernel, *factor, &sharpened));
            }
        }
        let mean = if sigma > 0.0 { kernel(sigma) } else { vec![1.0] };
        levels.across(&mean);
        levels.down(&mean, 0..height, |x, y, sums| {
            let end = (x + LANES).min(width);
            let to = &mut samples[y * width + x..y * width + end];
            let fours = sums.map(|sum| {
                let bounded = (sum * f32x4::splat(scale as f32)).fast_max(f32x4::ZERO).fast_min(f32x4::splat(most));
                // to the nearest whole number; the rounding of the language is a call for every sample
                (bounded + f32x4::splat(0.5)).fast_trunc_int().to_array()
            });
            for (to, level) in to.iter_mut().zip(fours.as_flattened()) {
                *to = *level as u16;
            }
        });
        Self { samples, width, height, scale }
    }

    /// A part of that picture, from a pixel on.
    pub fn part<T: Sample>(
        plane: &SampleView<T>,
        sharpening: Option<Sharpening>,
        sigma: f64,
        [left, top]: [usize; 2],
        [width, height]: [usize; 2],
    ) -> Self {
        let reach = reach(sharpening, sigma);
        let [x, y] = [left.saturating_sub(reach), top.saturating_sub(reach)];
        let [end, bottom] = [(left + width + reach).min(plane.width), (top + height + reach).min(plane.height)];
        let wider = Window::at(plane, [x, y], [end - x, bottom - y]);
        let Self { samples, scale, .. } = Self::of(&wider.plane(), sharpening, sigma);
        let part = Window::at(&SampleView::new(end - x, bottom - y, &samples), [left - x, top - y], [width, height]);
        Self { samples: part.samples, width, height, scale }
    }

    /// Its samples.
    pub fn plane(&self) -> SampleView<'_, u16> {
        SampleView::new(self.width, self.height, &self.samples)
    }
}

/// How far a sample depends on others.
fn reach(sharpening: Option<Sharpening>, sigma: f64) -> usize {
    side(sigma) + sharpening.map_or(0, |sharpening| (inverse(sharpening.amount).len() - 1) * side(sharpening.radius))
}

/// The softened picture at half of its size, of means of two by two pixels.
///
/// Computed in bands of rows, each with the rows above and below that the Gaussian mean needs: a band fits into the cache of the processor.
pub(crate) fn halved<T: Sample>(plane: &SampleView<T>, sigma: f64) -> Softened {
    const BAND: usize = 64;
    // the mean of four pixels has a variance already, a quarter of a pixel of the whole picture
    let sigma = (sigma * sigma - 0.25).max(0.0).sqrt() / 2.0;
    let (width, height) = (plane.width / 2, plane.height / 2);
    let fine = if T::MAX < 256 { FINE as u32 } else { 1 };
    // of a single row or column nothing is left
    let height = if width == 0 { 0 } else { height };
    let (mut samples, mut means) = (Vec::with_capacity(width * height), Vec::new());
    for top in (0..height).step_by(BAND) {
        let bottom = (top + BAND).min(height);
        let rows = top.saturating_sub(side(sigma))..(bottom + side(sigma)).min(height);
        means.clear();
        for y in rows.clone() {
            let (upper, lower) = (plane.row(2 * y).as_chunks::<2>().0, plane.row(2 * y + 1).as_chunks::<2>().0);
            means.extend(upper.iter().zip(lower).map(|([a, b], [c, d])| {
                let sum = a.level() + b.level() + c.level() + d.level();
                ((fine * sum + 2) / 4) as u16
            }));
        }
        let band = Softened::of(&SampleView::new(width, rows.len(), &means), None, sigma);
        samples.extend_from_slice(&band.samples[(top - rows.start) * width..][..(bottom - top) * width]);
    }
    Softened { samples, width, height, scale: f64::from(fine) }
}

/// Factors of the powers of the mean, from its zeroth on, whose sum undoes a sharpening of this amount; what is even stays as it is.
fn inverse(amount: f64) -> Vec<f32> {
    // T(2g - 1) of two degrees, and its value where p has its pole, at g = 1 + 1 / k
    let (mut before, mut last) = (vec![1.0], vec![-1.0, 2.0]);
    let [mut there_before, mut there] = [1.0, 1.0 + 2.0 / amount];
    while LEFT * there < 1.0 {
        let mut next = vec![0.0; last.len() + 1];
        for (k, factor) in last.iter().enumerate() {
            next[k] -= 2.0 * factor;
            next[k + 1] += 4.0 * factor;
        }
        before.iter().enumerate().for_each(|(k, factor)| next[k] -= factor);
        (before, last) = (last, next);
        (there_before, there) = (there, 2.0 * (1.0 + 2.0 / amount) * there - there_before);
    }
    // divided by 1 + k - k g from the highest power down: the rest is none; and by its value at g = 1
    let mut factors = vec![0.0f32; last.len() - 1];
    let mut carried = 0.0;
    for k in (0..factors.len()).rev() {
        carried = carried * (1.0 + 1.0 / amount) + last[k + 1] / there;
        factors[k] = (carried / amount / (1.0 - 1.0 / there)) as f32;
    }
    factors
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn a_part_is_that_of_the_picture_taken_whole() {
        let noise: Vec<u8> = (0..61u32 * 90).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
        let plane = SampleView::new(61, 90, &noise);
        for sharpening in [None, Some(Sharpening { amount: 1.2, radius: 0.5 })] {
            let whole = Softened::of(&plane, sharpening, 0.7);
            for (place, size) in [([0, 0], [16, 20]), ([30, 41], [31, 17]), ([17, 73], [16, 17])] {
                let part = Softened::part(&plane, sharpening, 0.7, place, size);
                assert!(part.samples == Window::at(&whole.plane(), place, size).samples, "{place:?}");
            }
        }
    }

    #[test]
    fn a_halved_picture_is_every_second_sample_of_the_softened_one() {
        // a slope and a wave of 14 pixels, as fine as a softened picture shows
        let level =
            |k: usize| 100.0 + (k % 150) as f64 / 3.0 + 40.0 * ((k / 150) as f64 / 14.0 * std::f64::consts::TAU).sin();
        let samples: Vec<u8> = (0..150 * 201).map(|k| level(k) as u8).collect();
        let plane = SampleView::new(150, 201, &samples);
        let (whole, half) = (Softened::of(&plane, None, 1.6), halved(&plane, 1.6));
        assert_eq!((half.width, half.height, half.scale), (75, 100, 128.0));
        assert!(halved(&SampleView::new(1, 3, &samples[..3]), 1.6).samples.is_empty());
        for (x, y) in (5..70).flat_map(|x| (5..95).map(move |y| (x, y))) {
            let at = |x: usize, y: usize| i64::from(whole.samples[y * 150 + x]);
            let mean = (at(2 * x, 2 * y) + at(2 * x + 1, 2 * y) + at(2 * x, 2 * y + 1) + at(2 * x + 1, 2 * y + 1)) / 4;
            assert!((mean - i64::from(half.samples[y * 75 + x])).abs() < 128, "{x} {y}");
        }
    }

    #[test]
    fn the_inverse_undoes_a_sharpening_of_any_amount_at_every_frequency() {
        for amount in [0.05, 0.3, 1.0, 2.0, 3.5, 6.0] {
            let factors = inverse(amount);
            let at = |g: f64| factors.iter().rev().fold(0.0, |sum, factor| sum * g + f64::from(*factor));
            assert!((at(1.0) - 1.0).abs() < 1e-5, "{amount}");
            let left =
                (0..=100).map(|k| 0.01 * f64::from(k)).map(|g| (at(g) * (1.0 + amount - amount * g) - 1.0).abs());
            let left = left.fold(0.0, f64::max);
            assert!(left < 2.1 * LEFT, "{amount}: {left}");
        }
        assert_eq!([0.3, 1.0, 2.0, 6.0].map(|amount| inverse(amount).len()), [2, 3, 4, 7]);
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
        let undone = Softened::of(&SampleView::new(60, 60, &sharp), Some(Sharpening { amount: 1.5, radius: 1.1 }), 0.0);
        let worst =
            undone.samples.iter().zip(&soft).map(|(a, b)| (f32::from(*a) / 128.0 - b).abs()).fold(0.0, f32::max);
        assert!(worst < 1.0, "{worst}");
    }
}
