//! Reliability of one observation (W. Baarda, A testing procedure for use in geodetic networks, 1968).
//!
//! With the weighted residual e = v/σ and the redundancy number r (the part of an error that shows in its own residual):
//! w = e/√r is standard normal without gross errors; a bias of ∇ = δ0 σ/√r is found with the stated power.

use serde::{Deserialize, Serialize};

use super::distribution::noncentrality;

/// Redundancy numbers below this are treated as 0: no other observation checks this one, and its residual is only rounding. An error of
/// less than 4000 standard errors could not be detected.
pub const UNCHECKED: f64 = 1e-6;

/// Reliability of one observation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reliability {
    /// Redundancy number, 0 to 1.
    pub redundancy: f64,
    /// Baarda's w with the a priori standard error; null if the redundancy number is 0.
    pub w: Option<f64>,
    /// Minimal detectable bias in the units of the observation; null if the redundancy number is 0.
    pub mdb: Option<f64>,
}

impl Reliability {
    /// From the weighted residual, the weighted cofactor of the adjusted observation (1 - r) and the a priori standard
    /// error.
    pub fn new(weighted_residual: f64, adjusted_cofactor: f64, sigma: f64) -> Self {
        let redundancy = (1.0 - adjusted_cofactor).clamp(0.0, 1.0);
        let checked = redundancy > UNCHECKED;
        Self {
            redundancy,
            w: checked.then(|| weighted_residual / redundancy.sqrt()),
            mdb: checked.then(|| noncentrality() * sigma / redundancy.sqrt()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn an_unchecked_observation_has_no_test() {
        assert_eq!(Reliability::new(0.5, 1.0 + 1e-15, 0.1), Reliability::default());
        let half = Reliability::new(0.5, 0.75, 0.1);
        assert_eq!(half.w, Some(1.0));
        assert!((half.mdb.expect("checked") - 0.826_43).abs() < 1e-4);
    }
}
