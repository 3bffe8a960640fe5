//! Cofactors of a small network from its dense normal equations, bordered by the datum's constraints:
//!
//! ```text
//! | N  Dᵀ |⁻¹   | Q  · |
//! | D  0  |   = | ·  · |        r_i = 1 - p_i a_i Q a_iᵀ
//! ```
//!
//! Rows and columns are scaled to a unit diagonal of N first: radians and millimetres differ by orders of magnitude.

use nalgebra::DMatrix;

use sightline::adjust::{Adjuster, LinearSystem};
use sightline::error::Result;

/// Largest number of unknowns: the inverse of 600 takes half a second and the memory of a photo; with ten times as many the page would
/// wait for minutes.
pub const LARGEST: usize = 600;

/// Q of the unknowns, unscaled by sigma0; `None` above [`LARGEST`] unknowns, and where the bordered equations are singular.
pub fn cofactors(system: &LinearSystem) -> Option<DMatrix<f64>> {
    let (u, d) = (system.unknowns.len(), system.constraints.rows);
    if u == 0 || u > LARGEST {
        return None;
    }
    let n = system.a.normal(&system.p).dense();
    let scale: Vec<f64> = (0..u).map(|k| if n[(k, k)] > 0.0 { n[(k, k)].sqrt().recip() } else { 1.0 }).collect();
    let border = system.constraints.dense();
    let mut bordered = DMatrix::zeros(u + d, u + d);
    for i in 0..u {
        for j in 0..u {
            bordered[(i, j)] = n[(i, j)] * scale[i] * scale[j];
        }
    }
    for k in 0..d {
        let length = (0..u).map(|j| (border[(k, j)] * scale[j]).powi(2)).sum::<f64>().sqrt();
        for j in 0..u {
            let value = border[(k, j)] * scale[j] / length;
            bordered[(u + k, j)] = value;
            bordered[(j, u + k)] = value;
        }
    }
    let inverse = bordered.lu().try_inverse()?;
    let q = DMatrix::from_fn(u, u, |i, j| inverse[(i, j)] * scale[i] * scale[j]);
    q.iter().all(|value| value.is_finite()).then_some(q)
}

/// Q a_iᵀ of a row.
pub fn carried(system: &LinearSystem, q: &DMatrix<f64>, row: usize) -> Vec<f64> {
    let mut product = vec![0.0; q.nrows()];
    for (column, a) in system.a.row(row) {
        product.iter_mut().zip(q.column(column).iter()).for_each(|(sum, q)| *sum += q * a);
    }
    product
}

/// The row's redundancy number, from Q a_iᵀ.
pub fn redundancy(system: &LinearSystem, carried: &[f64], row: usize) -> f64 {
    1.0 - system.p[row] * system.a.row(row).map(|(column, a)| a * carried[column]).sum::<f64>()
}

/// Standard errors of the unknowns with the sigma0 of the present step; `None` where there are no [`cofactors`].
///
/// # Errors
/// As [`Adjuster::linear_system`].
pub fn sigmas(adjuster: &Adjuster) -> Result<Option<Vec<f64>>> {
    let sigma0 = adjuster.state().sigma0.unwrap_or(1.0);
    let q = cofactors(&adjuster.linear_system()?);
    // Held coordinates have none; rounding may leave less than nothing of theirs.
    Ok(q.map(|q| q.diagonal().iter().map(|q| sigma0 * q.max(0.0).sqrt()).collect()))
}
