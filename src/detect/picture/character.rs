//! What a camera has done to a picture, as far as its rows show it: clipped samples, blocks of a JPEG, noise of
//! which neighbours know. It decides whether a picture is searched as a laboratory's or softened as well.

use super::noise::Levels;
use crate::image::{Plane, Sample};

/// Rows that are looked at.
const ROWS: usize = 96;
/// Noise, as a share of the range, that hides small targets from the search's own thresholds.
const NOISY: f64 = 0.014;
/// Blocks from which a picture is a compressed one: what is not shows at most some hundredths by chance.
const COMPRESSED: f64 = 0.12;
/// Distance at which noise no longer knows of its neighbours.
pub(crate) const APART: usize = 5;

/// What was seen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Character {
    /// Share of samples at the dark and at the bright end of the scale.
    pub clipped: [f64; 2],
    /// How much larger differences are across the borders of blocks of eight than at any other place in eight, as a share.
    pub blocks: f64,
    /// Noise relative to the range.
    pub noise: f64,
}

impl Character {
    pub fn of<T: Sample>(plane: &Plane<T>, levels: &Levels) -> Self {
        let step = (plane.height / ROWS).max(1);
        let rows = || (step / 2..plane.height).step_by(step).map(|y| plane.row(y));
        let (mut dark, mut bright, mut all) = (0u64, 0u64, 0u64);
        let mut differences = [[0f64; 2]; 8];
        for row in rows() {
            for sample in row {
                all += 1;
                dark += u64::from(sample.level() == 0);
                bright += u64::from(f64::from(sample.level()) >= levels.saturation);
            }
            for (x, pair) in row.windows(2).enumerate() {
                let difference = f64::from(pair[0].level().abs_diff(pair[1].level())).min(4.0 * levels.noise + 4.0);
                let sum = &mut differences[x % 8];
                *sum = [sum[0] + difference, sum[1] + 1.0];
            }
        }
        let share = |count: u64| if levels.stairs { 0.0 } else { count as f64 / all.max(1) as f64 };
        let means = differences.map(|[sum, count]| sum / count.max(1.0));
        // a pattern of the scene may favour one place in eight, but hardly the last one alone
        let other = means[..7].iter().copied().fold(1e-3, f64::max);
        Self {
            clipped: [share(dark), share(bright)],
            blocks: (means[7] / other - 1.0).max(0.0),
            noise: levels.noise / levels.range.max(1.0),
        }
    }

    /// Whether it is no picture of a laboratory.
    pub fn is_processed(&self, levels: &Levels) -> bool {
        !levels.stairs && (self.is_compressed() || self.noise > NOISY)
    }

    /// Whether a compression has passed over it, and neighbouring samples share their noise.
    pub fn is_compressed(&self) -> bool {
        self.blocks > COMPRESSED
    }
}
