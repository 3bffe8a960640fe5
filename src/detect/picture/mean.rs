//! Gaussian means of rows and columns.
//!
//! A mean is the same in rows and in columns: rows first, then columns, sixteen sums at a time in registers. The order of the
//! additions is that of the kernel from its middle on.

use std::ops::Range;

use wide::f32x4;

use crate::image::{Sample, SampleView};

/// How many samples a Gaussian mean takes on each side.
pub(crate) fn side(sigma: f64) -> usize {
    (3.5 * sigma).ceil() as usize
}

/// Weights of a Gaussian mean from the middle on.
pub(crate) fn kernel(sigma: f64) -> Vec<f32> {
    let side = side(sigma) as i32;
    let weight = |t: i32| (-0.5 * (f64::from(t) / sigma).powi(2)).exp();
    let sum: f64 = (-side..=side).map(weight).sum();
    (0..=side).map(|t| (weight(t) / sum) as f32).collect()
}

/// Columns that are summed at a time, in registers.
pub(crate) const LANES: usize = 16;
/// Columns that are walked down together: as many rows of them as a mean takes stay near the processor.
const TILE: usize = 256;

/// Rows in fractions, each filled up to whole [`LANES`].
pub(crate) struct Levels {
    levels: Vec<f32>,
    width: usize,
    stride: usize,
    /// A row with what lies beyond its ends, and sums: memory that is reused.
    padded: Vec<f32>,
    sums: Vec<f32>,
}

impl Levels {
    /// No row yet of so many columns.
    pub fn of(width: usize) -> Self {
        Self { levels: Vec::new(), width, stride: width.next_multiple_of(LANES), padded: Vec::new(), sums: Vec::new() }
    }

    /// The rows of a picture instead of its own.
    pub fn take<T: Sample>(&mut self, plane: &SampleView<T>, rows: Range<usize>) {
        self.levels.resize(rows.len() * self.stride, 0.0);
        for (levels, y) in self.rows_mut().zip(rows) {
            for (level, sample) in levels.iter_mut().zip(plane.row(y)) {
                *level = sample.level() as f32;
            }
        }
    }

    /// The rows of others of the same width instead of its own, times a factor.
    pub fn scaled(&mut self, other: &Self, factor: f32) {
        self.levels.clear();
        self.levels.extend(other.levels.iter().map(|level| factor * level));
    }

    pub fn rows_mut(&mut self) -> impl Iterator<Item = &mut [f32]> {
        self.levels.chunks_exact_mut(self.stride).map(|row| &mut row[..self.width])
    }

    /// Convolves rows and columns with a symmetric kernel and adds other rows times a factor; beyond the border samples go on.
    pub fn convolve(&mut self, kernel: &[f32], factor: f32, added: &Self) {
        self.across(kernel);
        let (stride, mut sums) = (self.stride, std::mem::take(&mut self.sums));
        sums.resize(self.levels.len(), 0.0);
        let factor = f32x4::splat(factor);
        self.down(kernel, 0..sums.len() / stride, |x, y, mut sum| {
            let at = y * stride + x;
            for (sum, added) in sum.iter_mut().zip(fours(&added.levels[at..][..LANES])) {
                *sum += factor * added;
            }
            sums[at..][..LANES].copy_from_slice(sum.map(f32x4::to_array).as_flattened());
        });
        self.sums = std::mem::replace(&mut self.levels, sums);
    }

    /// Convolves rows.
    #[inline(never)]
    pub fn across(&mut self, kernel: &[f32]) {
        let Self { levels, width, stride, padded, .. } = self;
        let side = kernel.len() - 1;
        for row in levels.chunks_exact_mut(*stride) {
            let (first, last) = (row[0], row[*width - 1]);
            padded.clear();
            padded.resize(side, first);
            padded.extend_from_slice(&row[..*width]);
            padded.resize(*stride + 2 * side, last);
            for (k, sixteen) in row.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
                let around = &padded[k * LANES..][..LANES + 2 * side];
                let sums = weighted(kernel, |t| [&around[side - t..][..LANES], &around[side + t..][..LANES]]);
                sixteen.copy_from_slice(sums.map(f32x4::to_array).as_flattened());
            }
        }
    }

    /// Convolves columns: hands over column, row and sums of every sixteen of these rows.
    #[inline(never)]
    pub fn down(&self, kernel: &[f32], rows: Range<usize>, mut take: impl FnMut(usize, usize, [f32x4; 4])) {
        let last = self.levels.len() / self.stride - 1;
        let row = |y: usize| &self.levels[y * self.stride..][..self.stride];
        // the rows at each distance, looked up once for all of a tile's columns
        let mut pairs = Vec::with_capacity(kernel.len());
        for tile in (0..self.stride).step_by(TILE) {
            for y in rows.clone() {
                pairs.clear();
                pairs.extend((0..kernel.len()).map(|t| [row(y.saturating_sub(t)), row((y + t).min(last))]));
                for x in (tile..self.stride.min(tile + TILE)).step_by(LANES) {
                    let sums = weighted(kernel, |t| {
                        let [above, below] = pairs[t];
                        [&above[x..x + LANES], &below[x..x + LANES]]
                    });
                    take(x, y, sums);
                }
            }
        }
    }
}

/// Sums of sixteen samples and their neighbours on both sides, `pair(t)` those at distance t.
#[inline(always)]
fn weighted<'a>(kernel: &[f32], pair: impl Fn(usize) -> [&'a [f32]; 2]) -> [f32x4; 4] {
    let own = fours(pair(0)[0]);
    let weight = f32x4::splat(kernel[0]);
    let mut sums = [weight * own[0], weight * own[1], weight * own[2], weight * own[3]];
    for (t, weight) in kernel.iter().enumerate().skip(1) {
        let [one, other] = pair(t);
        let (one, other, weight) = (fours(one), fours(other), f32x4::splat(*weight));
        for i in 0..4 {
            sums[i] += weight * (one[i] + other[i]);
        }
    }
    sums
}

/// Sixteen samples as they are loaded: written out, because compilers do not always inline an array's own methods.
#[inline(always)]
fn fours(values: &[f32]) -> [f32x4; 4] {
    match values.as_chunks::<4>().0 {
        [a, b, c, d] => [f32x4::new(*a), f32x4::new(*b), f32x4::new(*c), f32x4::new(*d)],
        _ => [f32x4::ZERO; 4],
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    /// Rows of samples, convolved.
    fn convolved(samples: &[f32], width: usize, kernel: &[f32], factor: f32) -> Vec<f32> {
        let mut levels = Levels::of(width);
        levels.levels.resize(samples.len() / width * levels.stride, 0.0);
        levels.rows_mut().zip(samples.chunks_exact(width)).for_each(|(row, samples)| row.copy_from_slice(samples));
        let mut own = Levels::of(width);
        own.scaled(&levels, 1.0);
        levels.convolve(kernel, factor, &own);
        levels.rows_mut().flat_map(|row| row.to_vec()).collect()
    }

    #[test]
    fn a_mean_keeps_the_light_and_a_flat_picture() {
        let mut levels = vec![0f32; 41 * 41];
        levels[20 * 41 + 20] = 1000.0;
        let levels = convolved(&levels, 41, &kernel(1.6), 0.0);
        assert!((levels.iter().sum::<f32>() - 1000.0).abs() < 0.1);
        let variance: f32 =
            (0..41 * 41).map(|i| levels[i] * (i as f32 / 41.0).floor().mul_add(1.0, -20.0).powi(2)).sum();
        assert!((variance / 1000.0 - 2.56).abs() < 0.05, "{variance}");
        let turned: Vec<f32> = (0..41 * 41).map(|i| levels[(i % 41) * 41 + i / 41]).collect();
        assert!(levels.iter().zip(&turned).all(|(a, b)| (a - b).abs() < 1e-3));
        let flat = convolved(&[7f32; 12 * 5], 12, &kernel(3.0), 0.0);
        assert!(flat.iter().all(|level| (level - 7.0).abs() < 1e-4));
    }

    #[test]
    fn sums_are_those_of_the_definition() {
        let kernel = kernel(1.1);
        let weight = |t: i64| kernel.get(t.unsigned_abs() as usize).map_or(0.0, |weight| f64::from(*weight));
        for (width, height) in [(1, 1), (5, 3), (16, 2), (37, 9), (300, 4)] {
            let noise: Vec<f32> =
                (0..width * height).map(|i| (i as u32).wrapping_mul(2_654_435_761) as f32 / 2e7).collect();
            let at = |x: i64, y: i64| {
                let (x, y) = (x.clamp(0, width - 1), y.clamp(0, height - 1));
                f64::from(noise[(y * width + x) as usize])
            };
            let sums = convolved(&noise, width as usize, &kernel, -0.7);
            for (i, sum) in sums.iter().enumerate() {
                let (x, y) = (i as i64 % width, i as i64 / width);
                let around = (-4..=4).flat_map(|dy| (-4..=4).map(move |dx| (dx, dy)));
                let plain: f64 = around.map(|(dx, dy)| weight(dx) * weight(dy) * at(x + dx, y + dy)).sum();
                let plain = plain - 0.7 * at(x, y);
                assert!((f64::from(*sum) - plain).abs() < 1e-3, "{width} x {height}, {x} {y}: {sum} {plain}");
            }
        }
    }
}
