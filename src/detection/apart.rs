//! Lateral colour: differences of red and blue from green.

use serde::{Deserialize, Serialize};

use super::Colour;
use crate::project::{ColourShift, PhotoColours};

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
    /// Covariances of `shift_u`, `shift_v`, `linear` and `cubic` in square pixels: the upper triangle, row by row.
    #[serde(default)]
    pub covariance: [f64; 10],
}

/// A colour beside green.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ColourApart {
    /// Red or blue.
    pub colour: Colour,
    /// Every target measured in both.
    pub shifts: Vec<Shift>,
    /// What they have in common; absent where there are too few.
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

impl ColoursApart {
    /// What a report tells of it.
    pub fn of_photo(&self, photo: &str) -> PhotoColours {
        let of = |colour: Colour| {
            let Lateral { shift_u, shift_v, linear, cubic, sigma_at_corner: sigma, rms, targets, covariance, .. } =
                self.colours.iter().find(|apart| apart.colour == colour)?.lateral?;
            let (shift, covariance) = (Some([shift_u, shift_v]), Some(covariance));
            Some(ColourShift { linear, cubic, sigma, rms, targets, shift, covariance })
        };
        let centre = Some(self.centre);
        PhotoColours {
            photo: photo.to_owned(),
            corner: self.corner,
            centre,
            red: of(Colour::Red),
            blue: of(Colour::Blue),
        }
    }
}
