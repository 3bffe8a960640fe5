//! The noise of a sensor's samples, from one photo.
//!
//! Light comes in whole photons and its readout adds a constant: the variance of a sample is linear in the light,
//! σ² = r + g s (EMVA Standard 1288), with the gain g and the variance r of the readout in sample units. Where the picture is flat the
//! second difference of three sites of a row has the variance 6 σ², and its median size 0.6745 sqrt(6) σ. Whether it is flat there
//! the rows above and below tell, whose noise is not that of the difference: nothing is selected by what is measured.

use super::Sites;
use crate::detect::acceptance::sites::TOLD;

/// Rows that are examined.
const ROWS: usize = 160;
/// Classes of light, at even steps of its root.
const CLASSES: usize = 48;
/// Differences kept of a class.
const KEPT: usize = 20_000;
/// Minimum number of differences for an estimate.
const FEWEST: usize = 40;
/// Variance of a variance that is estimated by a median, in units of its square over the number of differences.
const SPREAD: f64 = 2.7;
/// Rounding to whole samples.
const ROUNDING: f64 = 1.0 / 12.0;
/// Half the median of the size of a normal number of variance 1, times the root of 6.
const MEDIAN: f64 = 0.674_489_75 * 2.449_489_743;

/// σ² = read + gain · light, in squared samples.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NoiseModel {
    pub gain: f64,
    pub read: f64,
    /// Light that most of the picture has.
    pub usual: f64,
    /// Standard error of `read`.
    pub read_sigma: f64,
}

impl NoiseModel {
    /// Variance of a sample of so much light.
    #[inline]
    pub fn variance(&self, light: f64) -> f64 {
        self.read + self.gain * light.max(0.0)
    }

    /// Standard deviation of a sample without light, where the photo has parts dark enough to tell.
    pub fn readout(&self) -> Option<f64> {
        (self.read_sigma <= TOLD * self.read).then(|| self.read.sqrt())
    }

    /// Its root.
    pub fn deviation(&self, light: f64) -> f64 {
        self.variance(light).sqrt()
    }
}

/// Sample from which one is saturated: the white level, or the largest sample that occurs where samples pile up at it.
pub(super) fn clipping(sites: &Sites) -> f64 {
    let white = sites.sensor.mosaic.white;
    let [left, top, right, bottom] = sites.lit;
    let rows = || (top..bottom).step_by(((bottom - top) / (4 * ROWS)).max(1)).filter(|y| sites.is_whole(*y));
    let samples = |y: usize| (left..right).filter(move |x| sites.has(*x, y)).map(move |x| sites.raw(x, y));
    let largest = rows().flat_map(samples).max().unwrap_or(0);
    let (at, below) = at_and_below(largest, rows().flat_map(samples));
    let piles_up = at > 20 && at > 2 * below && f64::from(largest) > 0.25 * white;
    if piles_up { f64::from(largest).min(white) } else { white }
}

/// How many samples are the largest one, and how many are up to eight below it.
fn at_and_below(largest: u16, samples: impl Iterator<Item = u16>) -> (usize, usize) {
    samples.fold((0, 0), |(at, below), sample| match largest.abs_diff(sample) {
        0 => (at + 1, below),
        1..=8 => (at, below + 1),
        _ => (at, below),
    })
}

/// Gain and readout of the photo.
pub(super) fn estimate(sites: &Sites) -> NoiseModel {
    let first = Classes::collect(sites, None);
    let unknown = NoiseModel { read: 1.0, read_sigma: f64::INFINITY, ..NoiseModel::default() };
    let Some(start) = first.fullest() else { return unknown };
    // before anything is known: some of the noise is the light's
    let [light, variance] = start;
    let (gain, read) = (0.9 * variance / light.max(1.0), 0.1 * variance + ROUNDING);
    let mut model = NoiseModel { gain, read, usual: light, read_sigma: f64::INFINITY };
    let masked = masked(sites);
    for _ in 0..3 {
        let mut known = Classes::collect(sites, Some(&model)).known();
        known.extend(masked);
        let Some(next) = line(&known, &model) else { break };
        model = NoiseModel { usual: light, ..next };
    }
    model
}

/// Variance and number of the differences of the masked columns left of the lit part, where no light falls: the readout alone. What is
/// the same everywhere or cut off at zero does not show it, and what is not black is not masked.
fn masked(sites: &Sites) -> Option<[f64; 3]> {
    let pattern = &sites.sensor.mosaic.pattern;
    let across = pattern.width().max(2);
    let [left, top, _, bottom] = sites.lit;
    let step = ((bottom - top) / (4 * ROWS)).max(1);
    let step = step + usize::from(step > 1 && step.is_multiple_of(2));
    let (mut sizes, mut levels, mut cut) = (Vec::new(), Vec::new(), 0);
    for y in (top..bottom).step_by(step).filter(|y| sites.is_whole(*y)) {
        // beside the lit part light leaks in
        for x in (across..left.saturating_sub(2 * across)).filter(|x| sites.has(*x, y)) {
            let [a, b, c] = [x - across, x, x + across].map(|x| sites.light(x, y));
            sizes.push((a - 2.0 * b + c).abs() as f32);
            levels.push(b as f32);
            cut += usize::from(sites.raw(x, y) == 0);
        }
    }
    let same = sizes.iter().filter(|size| **size == 0.0).count();
    if sizes.len() < FEWEST || 20 * cut > sizes.len() || 10 * same > 9 * sizes.len() {
        return None;
    }
    let middle = levels.len() / 2;
    let level = f64::from(*levels.select_nth_unstable_by(middle, f32::total_cmp).1);
    let deviation = median_size(&sizes) / MEDIAN;
    let black = level.abs() <= 3.0 * deviation + 1.0;
    black.then(|| [0.0, (deviation * deviation).max(ROUNDING), sizes.len() as f64])
}

/// Median of sizes that are whole numbers, as those of samples are: each stands for all between its halves, so that noise of few samples
/// is no step of them.
fn median_size(sizes: &[f32]) -> f64 {
    let mut ordered = sizes.to_vec();
    let half = sizes.len() as f64 / 2.0;
    let middle = f64::from(ordered.select_nth_unstable_by(sizes.len() / 2, f32::total_cmp).1.round());
    let count =
        |from: f64, to: f64| ordered.iter().filter(|size| (from..to).contains(&f64::from(**size))).count() as f64;
    let low = (middle - 0.5).max(0.0);
    low + (half - count(0.0, low)) / count(low, middle + 0.5).max(1.0) * (middle + 0.5 - low)
}

/// Sizes of second differences, by light.
struct Classes {
    lights: Vec<(f64, usize)>,
    sizes: Vec<Vec<f32>>,
}

impl Classes {
    /// Differences of all places that are flat as far as a first model can tell.
    fn collect(sites: &Sites, model: Option<&NoiseModel>) -> Self {
        let pattern = &sites.sensor.mosaic.pattern;
        let (across, down) = (pattern.width().max(2), pattern.height().max(2));
        let [left, top, right, bottom] = sites.lit;
        let mut classes = Self { lights: vec![(0.0, 0); CLASSES], sizes: vec![Vec::new(); CLASSES] };
        let step = ((bottom - top) / ROWS).max(1);
        // an odd step, so that rows of every kind are among them
        let step = step + usize::from(step > 1 && step.is_multiple_of(2));
        for y in (top + down..bottom.saturating_sub(down)).step_by(step) {
            if !sites.is_whole(y) {
                continue;
            }
            for x in (left + across..right.saturating_sub(across)).filter(|x| sites.has(*x, y)) {
                let triple = |y: usize| [x - across, x, x + across].map(|x| sites.light(x, y));
                let raw = [x - across, x, x + across].map(|x| f64::from(sites.raw(x, y)));
                if raw.iter().any(|raw| *raw >= sites.clip || *raw < 1.0) {
                    continue;
                }
                let (above, below) = (triple(y - down), triple(y + down));
                let sums = [above, below].map(|[a, b, c]| a + b + c);
                let light = (sums[0] + sums[1]) / 6.0;
                if let Some(model) = model {
                    let limit = 2.5 * model.deviation(light);
                    let slopes = [above, below].map(|[a, _, c]| (c - a) / 2f64.sqrt());
                    let fall = (sums[1] - sums[0]) / 6f64.sqrt();
                    let bends = [above, below].map(|[a, b, c]| (a - 2.0 * b + c) / 6f64.sqrt());
                    if slopes.iter().chain(&bends).chain([&fall]).any(|contrast| contrast.abs() > limit) {
                        continue;
                    }
                }
                let [a, b, c] = triple(y);
                let class = ((light.max(0.0) / sites.clip).sqrt() * CLASSES as f64) as usize;
                let class = class.min(CLASSES - 1);
                let sizes = &mut classes.sizes[class];
                let (sum, count) = &mut classes.lights[class];
                if sizes.len() < KEPT {
                    (*sum, *count) = (*sum + light.max(0.0), *count + 1);
                    sizes.push((a - 2.0 * b + c).abs() as f32);
                }
            }
        }
        classes
    }

    /// Mean light, variance and number of each class that tells something.
    fn known(&self) -> Vec<[f64; 3]> {
        let of = |((sum, count), sizes): (&(f64, usize), &Vec<f32>)| {
            if *count < FEWEST {
                return None;
            }
            let deviation = median_size(sizes) / MEDIAN;
            Some([sum / *count as f64, (deviation * deviation).max(ROUNDING), *count as f64])
        };
        self.lights.iter().zip(&self.sizes).filter_map(of).collect()
    }

    /// Light and variance of the class that most of the picture is in.
    fn fullest(&self) -> Option<[f64; 2]> {
        let known = self.known();
        let fullest = known.iter().max_by(|a, b| a[2].total_cmp(&b[2]))?;
        Some([fullest[0], fullest[1]])
    }
}

/// The line through classes of light, variance and number. A median of n sizes has the variance 2.7 σ⁴ / n as a variance; classes
/// far above the line are of places that are not flat.
fn line(known: &[[f64; 3]], start: &NoiseModel) -> Option<NoiseModel> {
    let mut model = *start;
    for round in 0..6 {
        let (mut n, mut l, mut ll, mut v, mut lv) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for [light, variance, count] in known {
            let expected = model.variance(*light);
            // the first rounds know little of the line
            if round > 1 && !(0.5 * expected..1.6 * expected).contains(variance) {
                continue;
            }
            let weight = count / (expected * expected);
            n += weight;
            l += weight * light;
            ll += weight * light * light;
            v += weight * variance;
            lv += weight * light * variance;
        }
        if !(n > 0.0) {
            return None;
        }
        let determinant = n * ll - l * l;
        let (mut gain, mut read, mut read_sigma) = if determinant > 1e-4 * n * ll {
            let gain = (n * lv - l * v) / determinant;
            (gain, (v - gain * l) / n, (SPREAD * ll / determinant).sqrt())
        } else if ll > 0.0 {
            // one light only: all of the noise is the light's
            (lv / ll, 0.0, f64::INFINITY)
        } else {
            (0.0, v / n, (SPREAD / n).sqrt())
        };
        if gain < 0.0 {
            (gain, read) = (0.0, v / n);
        }
        if read < ROUNDING {
            read = ROUNDING;
            gain = ((lv - read * l) / ll.max(1e-9)).max(0.0);
            read_sigma = f64::INFINITY;
        }
        model = NoiseModel { gain, read, read_sigma, ..model };
    }
    (model.gain.is_finite() && model.read.is_finite()).then_some(model)
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn what_lies_just_below_the_largest_sample_is_counted_in_sixteen_bits_too() {
        assert_eq!(at_and_below(u16::MAX, [65535, 65535, 65530, 65527, 65526, 7].into_iter()), (2, 2));
        assert_eq!(at_and_below(3, [3, 0, 1].into_iter()), (1, 2));
    }
}
