//! Noise and grey level range of a whole picture, for the threshold of the search.

use crate::detect::acceptance::picture as limits;
use crate::image::{Sample, SampleView};

/// Rows that are examined, spread over the picture.
const ROWS: usize = 48;
/// Golden section: the rows for the range lie at its multiples in their strips. At even distances all of them might pass between
/// the targets of a regular field.
pub(crate) const GOLDEN: f64 = 0.618_033_988_749_895;

/// Statistics of a picture in grey levels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GreyStatistics {
    /// Standard deviation of the noise.
    pub noise: f64,
    /// From the 0.1 % to the 99.9 % quantile.
    pub range: f64,
    /// Level from which samples count as saturated.
    pub saturation: f64,
    /// Whether it is a drawing of few grey levels, whose edges are aliased.
    pub stairs: bool,
    /// Distance of two levels: more than one where the scale has few, as the sixteen of a scanner.
    pub quantum: f64,
    /// Whether a camera has sharpened or compressed it, while its edges do not end at the end of the scale.
    pub developed: bool,
}

impl GreyStatistics {
    /// Smallest step of an edge that counts.
    pub fn step(&self) -> f64 {
        let [noise, range, levels] = limits::EDGE;
        (noise * self.noise).max(range * self.range).max(levels)
    }

    /// Standard deviation of an aliased edge: that of a uniform distribution over one pixel.
    pub fn jag(&self) -> f64 {
        if self.stairs { 12f64.sqrt().recip() } else { 0.0 }
    }
}

/// Noise from second differences along rows: |g(x-1) - 2 g(x) + g(x+1)| has the median 0.6745 sqrt(6) sigma where the
/// picture is plane, and edges are too few to move a median. Quantiles of integers are interpolated inside their bin.
pub(crate) fn levels<T: Sample>(plane: &SampleView<T>) -> GreyStatistics {
    levels_at(plane, 1)
}

/// The same with second differences over `apart` pixels, for noise of which neighbours know.
pub(crate) fn levels_at<T: Sample>(plane: &SampleView<T>, apart: usize) -> GreyStatistics {
    let bins = T::MAX as usize + 1;
    let (mut values, mut differences) = (vec![0u32; bins], vec![0u32; bins]);
    let step = (plane.height / ROWS).max(1);
    for strip in 0..plane.height / step {
        let row = plane.row(strip * step + ((strip as f64 * GOLDEN).fract() * step as f64) as usize);
        row.windows(3).step_by(2).for_each(|triple| values[triple[1].level() as usize] += 1);
    }
    let end = saturation(&values) as u32;
    // what is saturated has lost its noise
    let clipped = |level: u32| level == 0 || level >= end;
    let mut whole = vec![0u32; bins];
    for y in (step / 2..plane.height).step_by(step) {
        for places in plane.row(y).windows(2 * apart + 1).step_by(2) {
            let levels = [places[0].level(), places[apart].level(), places[2 * apart].level()];
            let difference = ((levels[0] + levels[2]).abs_diff(2 * levels[1]) as usize).min(bins - 1);
            differences[difference] += 1;
            whole[difference] += u32::from(!levels.into_iter().any(clipped));
        }
    }
    // where most is saturated, the rest has many edges: the least quarter tells of the noise. Of a drawing nothing may be left
    let count = |of: &[u32]| of.iter().map(|n| u64::from(*n)).sum::<u64>();
    let mostly_clipped = apart == 1 && 2 * count(&whole) < count(&differences) && count(&whole) > limits::ENOUGH;
    let (differences, share, normal) = if mostly_clipped { (whole, 0.25, 0.3186) } else { (differences, 0.5, 0.6745) };
    let noise = quantile(&differences, share).unwrap_or(0.0) / (normal * 6f64.sqrt());
    let range = quantile(&values, 0.999).unwrap_or(0.0) - quantile(&values, 0.001).unwrap_or(0.0);
    let occupied: Vec<usize> = (0..bins).filter(|level| values[*level] > 0).collect();
    let stairs = noise < limits::DRAWN && occupied.len() <= limits::FEW;
    let quantum = if occupied.len() > limits::FEW { quantum(&occupied) } else { 1 } as f64;
    // nothing is saturated where there is nothing between the levels
    let saturation = if stairs { bins as f64 } else { f64::from(end) };
    GreyStatistics { noise, range: range.max(0.0), saturation, stairs, quantum, developed: false }
}

/// Distance of the levels of a scale that has few, by those of it that occur: all lie on it but for rounding. One where they are chance.
fn quantum(occupied: &[usize]) -> usize {
    let gaps = || occupied.windows(2).map(|two| two[1] - two[0]);
    let least = gaps().min().unwrap_or(1);
    if gaps().all(|gap| gap <= least + 1 || gap + 1 >= 2 * least) { least } else { 1 }
}

/// Quantile of a histogram of integers; a value stands for the interval of half a step to both sides (from 0 on for 0).
fn quantile(histogram: &[u32], share: f64) -> Option<f64> {
    let total: u64 = histogram.iter().map(|&n| u64::from(n)).sum();
    let wanted = share * total as f64;
    let mut below = 0.0;
    for (value, &count) in histogram.iter().enumerate() {
        let count = f64::from(count);
        if count > 0.0 && below + count >= wanted {
            let inside = (wanted - below) / count;
            return Some((value as f64 - 0.5 + inside).max(0.0));
        }
        below += count;
    }
    None
}

/// The largest value that occurs is the clipping level when it piles up: more samples than twice the four occupied levels next
/// to it together. Levels between which nothing lies, as those of 12 bits in 16, are neighbours. Otherwise, and where other
/// levels than black pile up too, as the even ones of a drawing do, only the end of the scale clips.
fn saturation(values: &[u32]) -> f64 {
    let end = values.len() - 1;
    let occupied: Vec<(usize, u32)> = values.iter().copied().enumerate().filter(|(_, n)| *n > 0).collect();
    let Some(&(top, _)) = occupied.last() else { return end as f64 };
    let piles_up = |at: usize| {
        let around = &occupied[at.saturating_sub(4)..(at + 5).min(occupied.len())];
        let (level, count) = occupied[at];
        level > 0
            && count > limits::PILE
            && count > limits::PILED * (around.iter().map(|(_, n)| n).sum::<u32>() - count)
    };
    let last = occupied.len() - 1;
    if top > end / 16 && piles_up(last) && !(0..last.saturating_sub(4)).any(piles_up) { top as f64 } else { end as f64 }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    /// Sum of twelve uniform numbers less six: normal enough.
    fn noisy(sigma: f64) -> Vec<u8> {
        let mut state = 7u64;
        let mut uniform = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f64 / (1u64 << 24) as f64
        };
        (0..200 * 200)
            .map(|k| {
                let normal = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
                (60.0 + 0.2 * f64::from(k % 200) + sigma * normal).round() as u8
            })
            .collect()
    }

    #[test]
    fn a_scale_of_few_levels_is_told_from_levels_that_occur_by_chance() {
        for (count, low, high) in [(10, 0.0, 255.0), (16, 40.0, 210.0), (32, 5.0, 250.0)] {
            let step: f64 = (high - low) / f64::from(count - 1);
            let mut scale: Vec<usize> = (0..count).map(|k| (low + step * f64::from(k)).round() as usize).collect();
            assert!((quantum(&scale) as f64 - step).abs() < 1.0, "{scale:?}");
            // of which not all occur
            scale.remove(3);
            assert!((quantum(&scale) as f64 - step).abs() < 1.0, "{scale:?}");
        }
        assert_eq!(quantum(&[3, 21, 40, 66, 84, 101, 131, 150, 190, 211]), 1);
        assert_eq!(quantum(&[20, 21, 23, 60, 61, 200]), 1);
    }

    #[test]
    fn noise_is_measured_on_a_slope() {
        for sigma in [1.0, 2.0, 6.0] {
            let samples = noisy(sigma);
            let found = levels(&SampleView::new(200, 200, &samples)).noise;
            assert!((found / sigma - 1.0).abs() < 0.1, "{sigma}: {found}");
        }
    }

    #[test]
    fn the_range_sees_the_bright_bands_of_a_regular_pattern() {
        for period in [12, 24, 32, 48, 96] {
            let samples: Vec<u8> =
                (0..64 * 1152).map(|k| if k / 64 % period < period / 4 { 200 } else { 20 }).collect();
            let found = levels(&SampleView::new(64, 1152, &samples)).range;
            assert!(found > 170.0, "{period}: {found}");
        }
    }

    #[test]
    fn a_pile_at_the_top_is_saturation() {
        let mut samples = noisy(2.0);
        assert_eq!(levels(&SampleView::new(200, 200, &samples)).saturation, 255.0);
        for sample in &mut samples {
            *sample = (*sample).min(80);
        }
        assert_eq!(levels(&SampleView::new(200, 200, &samples)).saturation, 80.0);
    }

    #[test]
    fn twelve_bits_in_sixteen_are_clipped_at_their_own_end() {
        let spread = |top: u16| noisy(2.0).into_iter().map(|level| (u16::from(level) * 16).min(top) * 16).collect();
        let clipped: Vec<u16> = spread(80 * 16);
        assert_eq!(levels(&SampleView::new(200, 200, &clipped)).saturation, f64::from(80u16 * 256));
        let whole: Vec<u16> = spread(4095);
        assert_eq!(levels(&SampleView::new(200, 200, &whole)).saturation, 65535.0);
    }

    #[test]
    fn an_even_level_of_a_drawing_is_no_saturation() {
        let samples: Vec<u8> = (0..200 * 200).map(|k| if k % 200 < 100 { 40 } else { 220 }).collect();
        assert!(levels(&SampleView::new(200, 200, &samples)).saturation > 220.0);
    }

    #[test]
    fn tiny_pictures_have_levels_too() {
        let found = levels(&SampleView::new(1, 1, &[9u8]));
        assert_eq!((found.noise, found.range), (0.0, 0.0));
    }
}
