//! Effect of scaling the standard errors of a group.

use serde::{Deserialize, Serialize};

use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, GlobalTest, VarianceComponent, VarianceComponents};
use sightline::error::Result;
use sightline::project::{Project, Sigma};

/// A network with scaled standard errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Weighted {
    /// Sigma0; null without redundancy.
    pub sigma0: Option<f64>,
    /// Global test.
    pub test: Option<GlobalTest>,
    /// Root mean square of the image residuals, pixels.
    pub rms_px: Option<f64>,
    /// Rms of the tie points' standard errors per axis, with sigma0.
    pub rms_sigma: Option<[f64; 3]>,
    /// Root mean square of the residuals of given coordinates, over their a priori standard errors before they were scaled; null without any.
    pub given: Option<f64>,
    /// Variance components: by what the scaled standard errors are to be multiplied.
    pub components: Vec<VarianceComponent>,
}

/// Adjusts with the standard errors of image coordinates times `image` and those of control coordinates times `control`.
///
/// # Errors
/// As [`adjust`].
pub fn weighted(project: &Project, options: &AdjustOptions, image: f64, control: f64) -> Result<Weighted> {
    let project = scaled(project, image, control);
    let plain = AdjustOptions { snooping: false, robust: None, variance_components: None, ..options.clone() };
    let found = adjust(&project, &plain, &mut |_| true)?;
    let estimated = AdjustOptions { variance_components: Some(VarianceComponents::default()), ..plain };
    // For a group without enough redundancy no component is estimated, and its entry states that.
    let components = adjust(&project, &estimated, &mut |_| true).map(|a| a.variance_components).unwrap_or_default();
    let squares: Vec<f64> = found
        .given
        .iter()
        .filter(|given| given.sigma > 0.0)
        .filter_map(|given| given.residual.map(|v| (control * v / given.sigma).powi(2)))
        .collect();
    let given = (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt());
    Ok(Weighted {
        sigma0: found.sigma0,
        test: found.global_test,
        rms_px: found.rms_px,
        rms_sigma: found.precision.map(|precision| precision.rms_sigma),
        given,
        components,
    })
}

/// The project with the standard errors of image coordinates times `image` and those of control coordinates times `control`.
pub(super) fn scaled(project: &Project, image: f64, control: f64) -> Project {
    let mut project = project.clone();
    for observation in &mut project.observations {
        observation.sigma = match observation.sigma {
            Sigma::One(sigma) => Sigma::One(image * sigma),
            both => {
                let [u, v] = both.both();
                Sigma::Two([image * u, image * v])
            }
        };
    }
    for point in &mut project.points {
        point.sigma = point.sigma.map(|sigma| sigma.map(|sigma| sigma.map(|sigma| control * sigma)));
    }
    project
}
