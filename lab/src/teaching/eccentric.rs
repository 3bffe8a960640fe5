//! Bias of ellipse centres by the size of circular targets.

use serde::{Deserialize, Serialize};

use sightline::adjust::linearise;
use sightline::adjustment::AdjustOptions;
use sightline::error::Result;
use sightline::project::Project;

/// The bias of ellipse centres for one diameter of all targets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bias {
    /// Diameter in the document's unit.
    pub diameter: f64,
    /// Largest bias of a coordinate, in the unit of photo coordinates.
    pub largest: f64,
    /// Root mean square of all coordinates.
    pub rms: f64,
    /// The largest over the standard error of its observation.
    pub in_sigma: f64,
}

/// Biases at the document's values. Points whose plane nothing tells have none.
///
/// # Errors
/// As [`linearise`].
pub fn biases(project: &Project, options: &AdjustOptions, diameters: &[f64]) -> Result<Vec<Bias>> {
    let mut bare = project.clone();
    bare.points.iter_mut().for_each(|point| point.diameter = None);
    let values =
        |diameter: Option<f64>| linearise(&bare, &AdjustOptions { target_diameter: diameter, ..options.clone() });
    let without = values(None)?;
    let mut all = Vec::new();
    for &diameter in diameters {
        let with = values(Some(diameter))?;
        let mut bias = Bias { diameter, ..Bias::default() };
        let mut count = 0;
        for (before, after) in
            without.observations.iter().zip(&with.observations).filter(|(row, _)| row.given.is_none())
        {
            let shift = (before.value - after.value).abs();
            bias.largest = bias.largest.max(shift);
            bias.in_sigma = bias.in_sigma.max(shift / before.sigma);
            bias.rms += shift * shift;
            count += 1;
        }
        bias.rms = (bias.rms / f64::from(count.max(1))).sqrt();
        all.push(bias);
    }
    Ok(all)
}
