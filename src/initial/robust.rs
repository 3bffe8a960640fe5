//! Code shared by the robust initial solutions: a seeded generator, samples without repetition, and the robust scale of residuals.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// The generator of a seed: the same numbers on every machine.
pub fn generator(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// A number from 0 up to but not including 1.
pub fn uniform(generator: &mut ChaCha8Rng) -> f64 {
    (generator.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// `K` different numbers below `count`, which is at least `K`.
pub fn sample<const K: usize>(generator: &mut ChaCha8Rng, count: usize) -> [usize; K] {
    let mut chosen = [usize::MAX; K];
    for k in 0..K {
        loop {
            let candidate = (uniform(generator) * count as f64) as usize;
            if !chosen[..k].contains(&candidate) {
                chosen[k] = candidate;
                break;
            }
        }
    }
    chosen
}

/// The value at share `q` (0 to 1) of the sorted values; infinite ones count as the largest. 0 without values.
pub fn quantile(values: &[f64], q: f64) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let mut sorted = values.to_vec();
    let rank = (((sorted.len() - 1) as f64 * q).round() as usize).min(sorted.len() - 1);
    *sorted.select_nth_unstable_by(rank, f64::total_cmp).1
}

/// Standard deviation of the good ones among lengths of two-dimensional residuals, from their median, for a model of
/// `parameters` numbers: Rousseeuw and Leroy's small-sample factor on the median of a Rayleigh distribution.
pub fn scale(lengths: &[f64], parameters: usize) -> f64 {
    let spare = (2 * lengths.len()).saturating_sub(parameters).max(1) as f64;
    quantile(lengths, 0.5) / 1.1774 * (1.0 + 5.0 / spare)
}
