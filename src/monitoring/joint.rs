//! The joint method: one adjustment of both epochs in which the stable reference points have one set of coordinates.
//!
//! With cameras and photos of their own, two epochs share nothing but these points, and their joint adjustment is that of their
//! coordinates with the condition d_R = 0 (sequential adjustment: W. Niemeier, Ausgleichungsrechnung, 2008, chapter 9): with N = C_RR⁺ in
//! the datum of R,
//!
//! ```text
//! d' = d - C_·R N d_R        C' = C - C_·R N C_R·        vᵀPv' = vᵀPv + d_RᵀN d_R with h more degrees of freedom
//! ```

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::bundle::Bundle;
use super::congruence::Weights;
use super::covariance::Transformed;

/// Covariance of displacements: in the datum of the stable points, or with these as one.
pub enum Displaced<'a> {
    /// As transformed.
    Separate(Transformed<'a>),
    /// From one adjustment of all epochs, three rows a point.
    Bundle(DMatrix<f64>),
    /// Under the condition.
    Joint {
        /// Without it.
        own: Transformed<'a>,
        /// C_·R, three rows a point.
        beside: DMatrix<f64>,
        /// C_·R N.
        gain: DMatrix<f64>,
        /// Factor of the common variance factor on that of the epochs.
        factor: f64,
    },
}

/// Brings displacements under the condition that the points of the weights have not moved; `f`: degrees of freedom of the variance factor
/// where it is one for both epochs. Also gives the new degrees of freedom.
pub fn conditioned<'a>(
    own: Transformed<'a>,
    weights: &Weights,
    d: &mut [Vector3<f64>],
    f: Option<f64>,
) -> (Displaced<'a>, Option<f64>) {
    let n = d.len();
    let mut beside = DMatrix::zeros(3 * n, 3 * weights.points.len());
    for i in 0..n {
        for (column, &j) in weights.points.iter().enumerate() {
            beside.fixed_view_mut::<3, 3>(3 * i, 3 * column).copy_from(&own.block(i, j));
        }
    }
    let gain = weights.times(&beside);
    let stable = DVector::from_iterator(beside.ncols(), weights.points.iter().flat_map(|&k| d[k].data.0[0]));
    let omega = weights.omega(d);
    let shift = &gain * stable;
    for (k, d) in d.iter_mut().enumerate() {
        *d = if weights.points.contains(&k) { Vector3::zeros() } else { *d - shift.fixed_rows::<3>(3 * k) };
    }
    let h = weights.rank as f64;
    let factor = f.map_or(1.0, |f| (f + omega) / (f + h));
    (Displaced::Joint { own, beside, gain, factor }, f.map(|f| f + h))
}

impl Displaced<'_> {
    /// Block of two points.
    pub fn block(&self, i: usize, j: usize) -> Matrix3<f64> {
        match self {
            Self::Separate(own) => own.block(i, j),
            Self::Bundle(matrix) => Bundle::block(matrix, i, j),
            Self::Joint { own, beside, gain, factor } => {
                let known: Matrix3<f64> =
                    (gain.rows(3 * i, 3) * beside.rows(3 * j, 3).transpose()).fixed_view::<3, 3>(0, 0).into();
                let block = own.block(i, j);
                let rest = block - known;
                // What is held by the condition keeps nothing but rounding.
                let rounding = 1e-9 * (own.block(i, i).trace() * own.block(j, j).trace()).sqrt();
                if rest.amax() <= rounding { Matrix3::zeros() } else { rest * *factor }
            }
        }
    }

    /// Matrix of some points, three rows each.
    pub fn matrix(&self, places: &[usize]) -> DMatrix<f64> {
        if let Self::Separate(own) = self {
            return own.matrix(places);
        }
        let mut matrix = DMatrix::zeros(3 * places.len(), 3 * places.len());
        for (a, &i) in places.iter().enumerate() {
            for (b, &j) in places.iter().enumerate() {
                matrix.fixed_view_mut::<3, 3>(3 * a, 3 * b).copy_from(&self.block(i, j));
            }
        }
        (&matrix + matrix.transpose()) * 0.5
    }
}
