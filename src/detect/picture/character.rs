//! In-camera processing, estimated from the rows of a picture: sharpened edges, saturated samples, JPEG blocks, noise
//! autocorrelation. It decides whether a picture is searched as a laboratory's or softened as well.

use super::noise::GreyStatistics;
use crate::detect::acceptance::picture as limits;
use crate::image::{Sample, SampleView};

/// Rows that are examined.
const ROWS: usize = 96;
/// Distance beyond which noise is not correlated.
pub(crate) const APART: usize = 5;

/// Observed values.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Character {
    /// Median undershoot on that side of steps, dark or bright, that has more of it, as a share of them; 0 if there are too few.
    pub undershoot: f64,
    /// Share of samples at the dark and at the bright end of the scale.
    pub clipped: [f64; 2],
    /// How much larger differences are across the borders of blocks of eight than at any other place in eight, as a share.
    pub blocks: f64,
    /// Noise relative to the range.
    pub noise: f64,
}

impl Character {
    pub fn of<T: Sample>(plane: &SampleView<T>, levels: &GreyStatistics) -> Self {
        let step = (plane.height / ROWS).max(1);
        let rows = || (step / 2..plane.height).step_by(step).map(|y| plane.row(y));
        let (mut dark, mut bright, mut all) = (0, 0, 0);
        let saturation = levels.saturation.ceil() as u32;
        // of each column to the next
        let mut differences = vec![0f32; plane.width.saturating_sub(1)];
        let most = (4.0 * levels.noise + 4.0) as f32;
        let mut undershoots = [Vec::new(), Vec::new()];
        for row in rows() {
            all += row.len();
            dark += row.iter().filter(|sample| sample.level() == 0).count();
            bright += row.iter().filter(|sample| sample.level() >= saturation).count();
            for ((left, right), sum) in row.iter().zip(row.iter().skip(1)).zip(&mut differences) {
                let difference = left.level().abs_diff(right.level()) as f32;
                *sum += if difference < most { difference } else { most };
            }
            undershoots_of(row, levels, &mut undershoots);
        }
        // A tone curve after the sharpening flattens what it did to the bright side of a step, and steepens the dark one: each
        // side is used alone, and both together if each has few samples.
        let both = undershoots.concat();
        let median = |mut found: Vec<f64>| {
            found.sort_by(f64::total_cmp);
            if found.len() < limits::STEPS { 0.0 } else { found[found.len() / 2].max(0.0) }
        };
        let [dark_side, bright_side] = undershoots;
        let undershoot = median(dark_side).max(median(bright_side)).max(median(both));
        let share = |count: usize| if levels.stairs { 0.0 } else { count as f64 / all.max(1) as f64 };
        Self {
            undershoot,
            clipped: [share(dark), share(bright)],
            blocks: blocks(&differences.iter().map(|sum| f64::from(*sum)).collect::<Vec<_>>()),
            noise: levels.noise / levels.range.max(1.0),
        }
    }

    /// Whether it was processed by a camera.
    pub fn is_processed(&self, levels: &GreyStatistics) -> bool {
        let hidden = self.noise > limits::NOISY || self.undershoot > limits::SHARPENED || self.is_clipped();
        !levels.stairs && (self.is_compressed() || hidden)
    }

    /// Whether paper, lamps or sky are brighter than the scale.
    pub fn is_clipped(&self) -> bool {
        self.clipped[1] > limits::OVEREXPOSED
    }

    /// Whether a compression has skipped it, and neighbouring samples share their noise.
    pub fn is_compressed(&self) -> bool {
        self.blocks > limits::COMPRESSED
    }
}

/// By how much the differences of columns are larger at the borders of blocks of eight than at any other place in eight; 0 where
/// that may be chance.
fn blocks(differences: &[f64]) -> f64 {
    let mut sums = [[0f64; 2]; 8];
    for (x, difference) in differences.iter().enumerate() {
        let [sum, count] = &mut sums[x % 8];
        (*sum, *count) = (*sum + difference, *count + 1.0);
    }
    let means = sums.map(|[sum, count]| sum / count.max(1.0));
    // a pattern of the scene may favour one place in eight, but hardly the last one alone
    let other = means[..7].iter().copied().fold(0.0, f64::max);
    if other <= 0.0 {
        return 0.0;
    }
    let beside = differences.windows(3).skip(6).step_by(8).map(|three| three[1] - (three[0] + three[2]) / 2.0);
    let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for excess in beside {
        (count, sum, squares) = (count + 1.0, sum + excess, squares + excess * excess);
    }
    let mean: f64 = sum / f64::max(count, 1.0);
    // as far as columns differ among themselves: in a small picture a few edges make as much of a difference
    let error = ((squares / f64::max(count, 1.0) - mean * mean).max(0.0) / f64::max(count - 1.0, 1.0)).sqrt();
    if count < 4.0 || mean < limits::CERTAIN * error { 0.0 } else { (means[7] / other - 1.0).max(0.0) }
}

/// Undershoots on the flat sides of a row's steps, dark ones and bright ones, as shares of the steps, less what noise does.
fn undershoots_of<T: Sample>(row: &[T], levels: &GreyStatistics, found: &mut [Vec<f64>; 2]) {
    const FAR: usize = 8;
    const NEAR: usize = 5;
    let level = |x: usize| f64::from(row[x].level());
    let [share, times, steep] = limits::STEP;
    let least = (share * levels.range).max(times * levels.noise);
    if least <= 0.0 {
        return;
    }
    let mut x = FAR;
    while x + FAR < row.len() {
        let rise = level(x + 1) - level(x - 1);
        let steepest = |y: usize| rise.abs() >= (level(y + 1) - level(y - 1)).abs();
        if rise.abs() < steep * least || !(steepest(x - 1) && steepest(x + 1)) {
            x += 1;
            continue;
        }
        let sides = [1i64, -1].map(|direction| {
            let at = |t: usize| level((x as i64 + direction * t as i64) as usize);
            let far = (NEAR..=FAR).map(at);
            let (low, high) = far.clone().fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
            let mean = far.sum::<f64>() / (FAR - NEAR + 1) as f64;
            let beyond = (1..NEAR).map(|t| direction as f64 * rise.signum() * (at(t) - mean)).fold(0.0, f64::max);
            // a slope of the light goes on to the step
            let slope = (at(FAR) - at(NEAR)).abs() / (FAR - NEAR) as f64;
            (mean, high - low, beyond - slope * NEAR as f64)
        });
        // the way back from an overshoot is no step of its own
        let contrast = (sides[0].0 - sides[1].0) * rise.signum();
        if contrast < least || rise.abs() < steep * contrast {
            x += 1;
            continue;
        }
        let darker = usize::from(sides[0].0 > sides[1].0);
        for (k, (_, spread, beyond)) in sides.into_iter().enumerate() {
            if spread < limits::FLAT[0] * contrast + limits::FLAT[1] * levels.noise {
                found[usize::from(k != darker)].push((beyond - levels.noise) / contrast);
            }
        }
        x += NEAR;
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::detect::picture::noise;

    fn stripes(sharpened: bool) -> Character {
        let level = |x: usize| {
            let d = ((x % 60) as f64 - 30.0).abs() - 14.0;
            let overshoot = if sharpened { 30.0 * d.signum() * (-(d.abs() - 2.0).powi(2)).exp() } else { 0.0 };
            (130.0 + 60.0 * (d / 1.2).tanh() + overshoot).round() as u8
        };
        let samples: Vec<u8> = (0..300 * 40).map(|i| level(i % 300)).collect();
        let plane = SampleView::new(300, 40, &samples);
        Character::of(&plane, &noise::levels(&plane))
    }

    #[test]
    fn sharpened_edges_undershoot() {
        assert!(stripes(false).undershoot < 0.02, "{:?}", stripes(false));
        assert!(stripes(true).undershoot > 0.1, "{:?}", stripes(true));
    }

    #[test]
    fn blocks_stand_out_of_their_neighbours_and_a_few_edges_do_not() {
        let ripple = |x: usize| 2.0 + 0.1 * ((x * 7919) % 13) as f64;
        let blocky: Vec<f64> = (0..255).map(|x| ripple(x) + if x % 8 == 7 { 0.8 } else { 0.0 }).collect();
        assert!(blocks(&blocky) > limits::COMPRESSED, "{}", blocks(&blocky));
        let edges: Vec<f64> = (0..79).map(|x| ripple(x) + if x == 31 { 20.0 } else { 0.0 }).collect();
        assert_eq!(blocks(&edges), 0.0);
    }
}
