//! Which diameter for which distance: a dot's smaller axis in the photo is d·c·cos(α) / D with the principal distance c in
//! pixels, the distance D and the angle α between the ray and the dot's normal.

use crate::reason::ReportReason;
use serde::{Deserialize, Serialize};

use sightline::error::{Error, Place, Result};

/// Pixels across that a dot needs at least, and those with which its centre is measured best.
pub const LEAST_PX: f64 = 8.0;
/// See [`LEAST_PX`].
pub const BEST_PX: f64 = 15.0;

/// For which camera and where.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AdviceOptions {
    /// Principal distance in pixels.
    pub c_px: f64,
    /// Distances in mm.
    pub distances: Vec<f64>,
    /// Angles between ray and normal, radians.
    pub angles: Vec<f64>,
    /// Diameter of the dots, mm.
    pub diameter: f64,
}

/// Recommendation for a distance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Advised {
    /// Distance in mm.
    pub distance: f64,
    /// A pixel on the object, seen straight on, mm.
    pub pixel: f64,
    /// Diameter of [`LEAST_PX`] at each angle, mm.
    pub least: Vec<f64>,
    /// Diameter of [`BEST_PX`] at each angle, mm.
    pub best: Vec<f64>,
    /// Smaller axis of the dots at each angle, pixels.
    pub pixels: Vec<f64>,
}

/// The table, a row a distance.
///
/// # Errors
/// [`Error::Invalid`] for a principal distance, distance or diameter that is not above 0, or an angle of 90° and more.
pub fn advice(options: &AdviceOptions) -> Result<Vec<Advised>> {
    let positive = |value: f64| value > 0.0 && value < 1e9;
    let sound = positive(options.c_px)
        && positive(options.diameter)
        && options.distances.iter().all(|d| positive(*d))
        && options.angles.iter().all(|a| (0.0..1.56).contains(a));
    if !sound {
        return Err(Error::Invalid { reason: ReportReason::SheetAdvice.into(), at: Place::default() });
    }
    let row = |&distance: &f64| {
        let pixel = distance / options.c_px;
        let each = |f: &dyn Fn(f64) -> f64| options.angles.iter().map(|angle| f(angle.cos())).collect();
        Advised {
            distance,
            pixel,
            least: each(&|cos| LEAST_PX * pixel / cos),
            best: each(&|cos| BEST_PX * pixel / cos),
            pixels: each(&|cos| options.diameter * cos / pixel),
        }
    };
    Ok(options.distances.iter().map(row).collect())
}
