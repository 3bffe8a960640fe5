//! Extra image error that the standard error of a measurement does not include: lens, flatness of targets, light, compression.
//!
//! A target's centre is measured to a hundredth of a pixel while the model of the photo is often good to a tenth. With one
//! standard deviation u for what is not modelled, σ² = s² + u² for every image coordinate of own standard error s.

use std::borrow::Cow;

use crate::adjustment::Adjustment;
use crate::error::{Error, Place, Reason, Result};
use crate::project::{Project, Sigma};

/// The project with `px` added in quadrature to the standard errors of all image coordinates.
///
/// # Errors
/// [`Error::Invalid`] unless `px` is a finite number from 0.
pub fn weighted(project: &Project, px: f64) -> Result<Cow<'_, Project>> {
    if !(0.0..1e6).contains(&px) {
        return Err(Error::Invalid { reason: Reason::Unmodelled { value: px.into() }, at: Place::field("unmodelled") });
    }
    if px == 0.0 {
        return Ok(Cow::Borrowed(project));
    }
    let mut project = project.clone();
    for observation in &mut project.observations {
        observation.sigma = match observation.sigma {
            Sigma::One(s) => Sigma::One(s.hypot(px)),
            Sigma::Two([su, sv]) => Sigma::Two([su.hypot(px), sv.hypot(px)]),
        };
    }
    Ok(Cow::Owned(project))
}

/// The u in pixels with which the image residuals v of an adjustment would agree with their standard errors:
/// u² = Σv² / Σr - mean s², over all image coordinates that took part, r their redundancy numbers.
///
/// `None` without redundancy numbers, or if the residuals are not larger than the standard errors.
pub fn estimate(project: &Project, adjustment: &Adjustment) -> Option<f64> {
    let pitches: std::collections::HashMap<&str, [f64; 2]> = project
        .photos
        .iter()
        .filter_map(|photo| {
            let camera = project.cameras.iter().find(|camera| camera.id == photo.camera)?;
            Some((photo.id.as_str(), camera.residual_pitch()))
        })
        .collect();
    let (mut squares, mut redundancy, mut own, mut count) = (0.0, 0.0, 0.0, 0.0);
    for (row, observation) in adjustment.observations.iter().zip(&project.observations).filter(|(row, _)| row.enabled) {
        let [px, py] = *pitches.get(row.photo.as_str())?;
        let [su, sv] = observation.sigma.both();
        squares += (row.vx? / px).powi(2) + (row.vy? / py).powi(2);
        redundancy += row.rx? + row.ry?;
        own += su * su + sv * sv;
        count += 2.0;
    }
    let square = squares / redundancy - own / count;
    (square > 0.0 && square.is_finite()).then(|| square.sqrt())
}
