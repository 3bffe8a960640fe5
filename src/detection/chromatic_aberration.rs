//! Lateral colour: differences of red and blue from green.

use serde::{Deserialize, Serialize};

use super::Colour;

/// A target in another colour, less the same in green.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shift {
    /// Centre in green, to the right.
    pub u: f64,
    /// Centre in green, downwards.
    pub v: f64,
    /// Difference to the right.
    pub du: f64,
    /// Difference downwards.
    pub dv: f64,
    /// Standard error of du.
    pub sigma_u: f64,
    /// Standard error of dv.
    pub sigma_v: f64,
}

/// Lateral chromatic aberration of a colour against green.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lateral {
    /// Shift of the whole picture, to the right.
    pub shift_u: f64,
    /// Shift of the whole picture, downwards.
    pub shift_v: f64,
    /// Part that grows with the radius, in pixels at the corner; positive outwards.
    pub linear: f64,
    /// Part that grows with its third power, in pixels at the corner.
    pub cubic: f64,
    /// Both together: pixels at the corner.
    pub at_corner: f64,
    /// Its standard error.
    pub sigma_at_corner: f64,
    /// Rms of what is left of a difference, in pixels.
    pub rms: f64,
    /// The same in units of its standard errors: 1 where the model and they are right.
    pub sigma0: f64,
    /// Targets that it is from.
    pub targets: usize,
    /// Whether the shift at some radius exceeds three of its standard errors and 0.02 pixels.
    #[serde(default)]
    pub significant: bool,
    /// Covariances of `shift_u`, `shift_v`, `linear` and `cubic` in square pixels: the upper triangle, row by row.
    #[serde(default)]
    pub covariance: [f64; 10],
}

impl Lateral {
    /// Shift at a share ρ of the corner's radius, pixels outwards, and its standard error:
    /// l ρ + c ρ³ and sqrt(σ_l² ρ² + 2 σ_lc ρ⁴ + σ_c² ρ⁶).
    pub fn at(&self, share: f64) -> [f64; 2] {
        let [.., linear, mixed, cubic] = self.covariance;
        let (first, third) = (share, share.powi(3));
        let variance = linear * first * first + 2.0 * mixed * first * third + cubic * third * third;
        [self.linear * first + self.cubic * third, variance.max(0.0).sqrt()]
    }
}

/// A colour beside green.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ColourApart {
    /// Red or blue.
    pub colour: Colour,
    /// Every target measured in both.
    pub shifts: Vec<Shift>,
    /// Common blur and contrast; `None` if there are too few.
    pub lateral: Option<Lateral>,
}

/// Colours of a photo, measured apart.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ColoursApart {
    /// Middle of the lit part, from which radii count.
    pub centre: [f64; 2],
    /// Radius of its corners, in pixels.
    pub corner: f64,
    /// Red and blue; none of a sensor without filters.
    pub colours: Vec<ColourApart>,
}
