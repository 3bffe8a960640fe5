//! The S-transformation of a whole cofactor matrix from any datum into another (W. Baarda 1973):
//!
//! ```text
//! Q' = S Q Sᵀ,   S = I - G (D G)⁻¹ D
//! ```
//!
//! with the motions G that no observation sees (u x d) and the constraints D δ = 0 of the new datum (d x u). S does not depend on the
//! old datum: all of them give the same Q'. It creates no information and loses none, unless the old datum was control, which adds
//! observations.

use nalgebra::DMatrix;

use super::normal_equations::Motion;
use super::sparse::SparseMatrix;

/// Q', from the cofactors `q` of all unknowns (u x u). `None` where the constraints leave a motion free, or the sizes differ.
pub fn s_transformed(q: &DMatrix<f64>, motions: &[Motion], constraints: &SparseMatrix) -> Option<DMatrix<f64>> {
    let unknowns = q.nrows();
    let of_motions = motions.iter().all(|motion| motion.vector.len() == unknowns);
    if !of_motions || q.ncols() != unknowns || constraints.columns != unknowns || constraints.rows != motions.len() {
        return None;
    }
    let g = DMatrix::from_fn(unknowns, motions.len(), |k, j| motions[j].vector[k]);
    let d = constraints.dense();
    let carried = (&d * &g).try_inverse()? * d;
    let half = q - &g * (&carried * q);
    let transformed = &half - (&half * carried.transpose()) * g.transpose();
    transformed.iter().all(|value| value.is_finite()).then_some(transformed)
}
