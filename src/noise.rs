//! Normal noise from a seed: the same numbers on every machine.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

/// A stream of normally distributed numbers.
#[derive(Clone, Debug)]
pub struct Noise(ChaCha8Rng);

impl Noise {
    /// The stream of a seed; `stream` keeps the photos or repetitions of one seed apart.
    pub fn new(seed: u64, stream: u64) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(stream);
        Self(generator)
    }

    /// The next number of mean 0 and standard deviation 1.
    pub fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn moments_are_normal_and_streams_differ() {
        let n = 40_000;
        let sample = |stream| {
            let mut noise = Noise::new(7, stream);
            (0..n).map(|_| noise.normal()).collect::<Vec<_>>()
        };
        let (a, b) = (sample(0), sample(1));
        let mean = |f: &dyn Fn(usize) -> f64| (0..n).map(f).sum::<f64>() / n as f64;
        assert!(mean(&|i| a[i]).abs() < 0.02);
        assert!((mean(&|i| a[i] * a[i]) - 1.0).abs() < 0.03);
        assert!((mean(&|i| a[i].powi(4)) - 3.0).abs() < 0.2);
        assert!(mean(&|i| a[i] * b[i]).abs() < 0.02);
        assert_eq!(a, sample(0));
    }
}
