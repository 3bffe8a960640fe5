//! Criteria of a result: the limits of its tests.

use serde::{Deserialize, Serialize};

use crate::project::Parameter;
use crate::statistics::distribution::{ALPHA, GLOBAL_ALPHA, POWER, critical_tau, critical_w, noncentrality};
use crate::statistics::reliability::UNCHECKED;

/// Correlations above this are reported.
pub(crate) const HIGH_CORRELATION: f64 = 0.95;
/// Redundancy numbers below this are reported.
pub(crate) const LOW_REDUNDANCY: f64 = 0.1;
/// Smaller intersection angles than this are reported, radians.
pub(crate) const NARROW_INTERSECTION: f64 = 5.0 * std::f64::consts::PI / 180.0;

/// The limits that observations, parameters and the network are judged by.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Criteria {
    /// Two-sided error probability of the tests on single observations.
    pub alpha: f64,
    /// Power with which a minimal detectable bias is found.
    pub power: f64,
    /// Two-sided error probability of the global test.
    pub global_alpha: f64,
    /// Critical value of Baarda's |w|.
    pub w: f64,
    /// Critical value of Pope's |τ|, by which data snooping decides; null with a redundancy below 2.
    pub tau: Option<f64>,
    /// Non-centrality δ0 of minimal detectable biases.
    pub noncentrality: f64,
    /// Observations with a smaller redundancy number are checked by nothing: their residual is rounding.
    pub unchecked: f64,
    /// Observations with a smaller redundancy number are hardly checked.
    pub low_redundancy: f64,
    /// Parameters with a larger |correlation| are strongly correlated.
    pub high_correlation: f64,
    /// Rays that meet under a smaller angle determine no depth, radians.
    pub narrow_intersection: f64,
    /// Parameters of distortion below so many of their standard errors are not significantly different from 0.
    pub significance: f64,
    /// A σ0 beyond this, with the global test failed, means that the standard errors of the image coordinates are too small.
    pub sigma0: f64,
}

impl Criteria {
    /// The limits for a result of this redundancy.
    pub fn of(redundancy: usize) -> Self {
        Self { tau: critical_tau(redundancy), ..Self::default() }
    }
}

impl Default for Criteria {
    fn default() -> Self {
        Self {
            alpha: ALPHA,
            power: POWER,
            global_alpha: GLOBAL_ALPHA,
            w: critical_w(),
            tau: None,
            noncentrality: noncentrality(),
            unchecked: UNCHECKED,
            low_redundancy: LOW_REDUNDANCY,
            high_correlation: HIGH_CORRELATION,
            narrow_intersection: NARROW_INTERSECTION,
            significance: 2.0,
            sigma0: 2.0,
        }
    }
}

/// Whether a parameter is one of distortion, whose neutral value is 0: only of these it means something not to be significantly different from 0.
pub(crate) fn is_distortion(parameter: Parameter) -> bool {
    use Parameter as P;
    matches!(parameter, P::K1 | P::K2 | P::K3 | P::K4 | P::K5 | P::K6 | P::P1 | P::P2 | P::B1 | P::B2)
}
