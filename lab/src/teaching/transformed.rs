//! S-transformation of covariances from one datum to another, compared with the adjustment under the new datum. It shows that the
//! precision of a network's shape does not depend on the datum.

use serde::{Deserialize, Serialize};

use nalgebra::DMatrix;

use super::datums::{precision, under};
use super::dense::cofactors;
use sightline::adjust::{LinearSystem, adjust, at_end, s_transformed};
use sightline::adjustment::AdjustOptions;
use sightline::error::Result;
use sightline::project::{DatumKind, Project};

/// Covariances of a point: xx, xy, xz, yy, yz, zz, squared unit of length.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TransformedPoint {
    /// Point.
    pub id: String,
    /// Under the old datum.
    pub before: [f64; 6],
    /// S-transformed into the new datum.
    pub transformed: [f64; 6],
    /// From the adjustment under the new datum.
    pub adjusted: [f64; 6],
}

/// An S-transformation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Transformed {
    /// Old datum.
    pub from: DatumKind,
    /// New datum.
    pub to: DatumKind,
    /// Points of the adjustment under the new datum.
    pub points: Vec<TransformedPoint>,
    /// Largest difference between transformed and adjusted, as a share of the product of the adjusted standard errors.
    pub apart: f64,
}

/// Transforms the cofactor matrix of the datum `from` into the datum `to` and adjusts under `to`. Both are linearised at the values of
/// the adjustment under `to` and scaled by its sigma0, so that only the datum differs; if `from` is control, its given coordinates remain
/// observations. `held` are the points of the minimal constraints, if the user chose them.
///
/// `None` above [`LARGEST`](super::LARGEST) unknowns, if both datums are the same, if `to` is control, and if held control coordinates
/// are not unknowns.
///
/// # Errors
/// As [`adjust`].
pub fn transformed(
    project: &Project,
    options: &AdjustOptions,
    held: Option<&[String]>,
    [from, to]: [DatumKind; 2],
) -> Result<Option<Transformed>> {
    if from == to || to == DatumKind::Control {
        return Ok(None);
    }
    let options = precision(options);
    let new = under(project, to, held);
    let end = at_end(&new, &options)?;
    let (system, normal) = end.equations()?;
    let other = at_end(&under(project, from, held), &options)?.linear_system()?;
    if other.unknowns.len() != system.unknowns.len() {
        return Ok(None);
    }
    let old = if from == DatumKind::Control {
        other
    } else {
        LinearSystem { constraints: other.constraints, ..system.clone() }
    };
    let Some(before) = cofactors(&old) else { return Ok(None) };
    let Some(after) = s_transformed(&before, &normal.null_space, &system.constraints) else { return Ok(None) };
    let adjustment = adjust(&new, &options, &mut |_| true)?;
    let variance = adjustment.sigma0.map_or(1.0, |sigma0| sigma0 * sigma0);
    let mut apart = 0.0_f64;
    let mut points = Vec::new();
    for point in &adjustment.points {
        let Some(adjusted) = point.covariance else { continue };
        let column = |axis: &str| {
            let name = format!("{} {axis}", point.id);
            system.unknowns.iter().position(|one| one.point.as_ref() == Some(&point.id) && one.name == name)
        };
        let [Some(x), Some(y), Some(z)] = ["X", "Y", "Z"].map(column) else { continue };
        let of = |q: &DMatrix<f64>| [(x, x), (x, y), (x, z), (y, y), (y, z), (z, z)].map(|place| variance * q[place]);
        let (before, transformed) = (of(&before), of(&after));
        let sigma = [adjusted[0], adjusted[3], adjusted[5]].map(f64::sqrt);
        for (k, [i, j]) in [[0, 0], [0, 1], [0, 2], [1, 1], [1, 2], [2, 2]].into_iter().enumerate() {
            // Held coordinates have a standard error of 0 in both.
            let scale = sigma[i] * sigma[j];
            if scale > 0.0 {
                apart = apart.max((transformed[k] - adjusted[k]).abs() / scale);
            }
        }
        points.push(TransformedPoint { id: point.id.clone(), before, transformed, adjusted });
    }
    Ok(Some(Transformed { from, to, points, apart }))
}
