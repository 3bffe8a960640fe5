//! The camera motion that compensates most of a change of the camera's parameters.
//!
//! A change θ of the parameters moves the image by Jθ, a motion m = (ω, t) by Km. The motion that leaves least over a region is
//!
//! ```text
//! m = Gθ,   G = -(Σ KᵀK)⁻¹ Σ KᵀJ
//! ```

use nalgebra::{DMatrix, DVector};

use super::MotionReference;
use super::places::ImagePlace;
use crate::error::{Error, Place, Reason, Result};

/// Components of a motion that a reference leaves open.
pub fn components(reference: MotionReference) -> usize {
    match reference {
        MotionReference::Rotation => 3,
        MotionReference::RotationTranslation => 6,
        MotionReference::Photos | MotionReference::None => 0,
    }
}

/// # Errors
/// [`Error::Invalid`] for a translation without a distance: at infinity it moves nothing.
pub fn checked(reference: MotionReference, distance: Option<f64>) -> Result<()> {
    if reference == MotionReference::RotationTranslation && distance.is_none() {
        return Err(Error::Invalid { reason: Reason::TranslationWithoutDistance, at: Place::field("distance") });
    }
    Ok(())
}

/// Σ KᵀK of the first `components` columns, with those of a translation in units of the distance so that all are angles; and these units.
fn normal_matrix(places: &[ImagePlace], components: usize) -> (DMatrix<f64>, DVector<f64>) {
    let mean = places.iter().map(|place| place.point.norm()).sum::<f64>() / places.len().max(1) as f64;
    let unit = DVector::from_fn(components, |k, _| if k < 3 { 1.0 } else { mean });
    let mut sum = DMatrix::zeros(components, components);
    for place in places {
        let k = place.by_motion.columns(0, components) * DMatrix::from_diagonal(&unit);
        sum += k.transpose() * &k;
    }
    (sum, unit)
}

/// The motion of least squares against given image shifts: minimises Σ |e + Km|².
///
/// # Errors
/// [`Error::Invalid`] if the region has too few places to tell.
pub fn against(places: &[ImagePlace], components: usize, shifts: &[DMatrix<f64>]) -> Result<DMatrix<f64>> {
    let columns = shifts.first().map_or(0, |e| e.ncols());
    let mut found = DMatrix::zeros(6, columns);
    if components == 0 {
        return Ok(found);
    }
    let (normal, unit) = normal_matrix(places, components);
    let mut right = DMatrix::zeros(components, columns);
    for (place, e) in places.iter().zip(shifts) {
        right -= DMatrix::from_diagonal(&unit) * place.by_motion.columns(0, components).transpose() * e;
    }
    let untold = || Error::Invalid { reason: Reason::RegionWithoutRays, at: Place::field("region") };
    let solved = normal.cholesky().ok_or_else(untold)?.solve(&right);
    found.rows_mut(0, components).copy_from(&(DMatrix::from_diagonal(&unit) * solved));
    if found.iter().all(|x| x.is_finite()) { Ok(found) } else { Err(untold()) }
}

/// G, six rows, for the parameters that the places were taken by.
///
/// # Errors
/// As [`against`].
pub fn absorbing(places: &[ImagePlace], reference: MotionReference) -> Result<DMatrix<f64>> {
    let shifts: Vec<DMatrix<f64>> = places.iter().map(|place| place.by_parameter.clone()).collect();
    if shifts.is_empty() && components(reference) > 0 {
        return Err(Error::Invalid { reason: Reason::RegionWithoutRays, at: Place::field("region") });
    }
    against(places, components(reference), &shifts)
}
