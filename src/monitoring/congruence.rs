//! Global congruence test of reference points and backward elimination of those that moved.
//!
//! With the differences d of the reference points and the weights N = Q_d⁺ in their own datum, Ω = dᵀNd is χ² with h = rank(Q_d) degrees
//! of freedom where nothing has moved (H. Pelzer, Zur Analyse geodätischer Deformationsmessungen, 1971). N is the matrix of normal
//! equations of the differences: N G = 0. Splitting off point i after decorrelation (W. Niemeier, Ausgleichungsrechnung, 2008, chapter 12),
//!
//! ```text
//! Ω = Ω_i + Ω_rest      Ω_i = w_iᵀ N_ii⁻¹ w_i, w = N d      N_rest = N_FF - N_Fi N_ii⁻¹ N_iF
//! ```
//!
//! where N_rest is the weight matrix of the remaining points in any datum, so that one inversion serves all steps.

use nalgebra::{DMatrix, DVector, Matrix3, SymmetricEigen, Vector3};

use super::covariance::{ReferenceDatum, Transformed};

/// Eigenvalues below this part of the largest belong to directions that are not determined. Variances of one matrix differ by 10⁶ for
/// standard errors that differ by 1000; rounding of the S-transformation leaves 10⁻¹⁵.
pub const SINGULAR: f64 = 1e-11;

/// Weights of the differences of reference points.
#[derive(Clone, Debug)]
pub struct Weights {
    /// The points, in the order of the rows.
    pub points: Vec<usize>,
    /// N.
    n: DMatrix<f64>,
    /// Its rank.
    pub rank: usize,
}

/// A generalised inverse by eigenvalues, and the rank.
pub fn pseudo_inverse(matrix: DMatrix<f64>) -> (DMatrix<f64>, usize) {
    let n = matrix.nrows();
    let largest = matrix.amax();
    if n == 0 || !(largest > 0.0) || !matrix.iter().all(|x| x.is_finite()) {
        return (DMatrix::zeros(n, n), 0);
    }
    let eigen = SymmetricEigen::new(matrix / largest);
    let limit = SINGULAR * eigen.eigenvalues.max();
    let kept: Vec<usize> = (0..n).filter(|&k| eigen.eigenvalues[k] > limit).collect();
    let vectors = eigen.eigenvectors.select_columns(&kept);
    let mut scaled = vectors.clone();
    for (column, &k) in kept.iter().enumerate() {
        scaled.column_mut(column).scale_mut(1.0 / (eigen.eigenvalues[k] * largest));
    }
    (scaled * vectors.transpose(), kept.len())
}

/// The same of three rows.
pub fn pseudo_inverse3(matrix: &Matrix3<f64>) -> (Matrix3<f64>, usize) {
    let largest = matrix.amax();
    if !(largest > 0.0) || !matrix.iter().all(|x| x.is_finite()) {
        return (Matrix3::zeros(), 0);
    }
    let eigen = (matrix / largest).symmetric_eigen();
    let limit = SINGULAR * eigen.eigenvalues.max();
    let kept = (0..3).filter(|&k| eigen.eigenvalues[k] > limit);
    let mut rank = 0;
    let inverse = kept.fold(Matrix3::zeros(), |sum, k| {
        rank += 1;
        let v = eigen.eigenvectors.column(k);
        sum + v * v.transpose() / (eigen.eigenvalues[k] * largest)
    });
    (inverse, rank)
}

impl Weights {
    /// Weights of the points that define the datum, from their covariance in it.
    pub fn new(points: &[usize], covariance: &Transformed, datum: &ReferenceDatum) -> Self {
        let q = covariance.matrix(points);
        let mean = q.trace() / q.nrows().max(1) as f64;
        let basis = (datum.defect > 0).then(|| datum.null_space());
        let projector = basis.map(|basis| &basis * basis.transpose());
        let lifted = projector.as_ref().map_or_else(|| q.clone(), |projector| &q + projector * mean);
        // Regular apart from the datum nearly always: then a Cholesky factor is all that is needed.
        let regular = lifted.cholesky().filter(|factor| {
            let pivots = factor.l_dirty().diagonal();
            pivots.min().powi(2) > 1e-9 * pivots.max().powi(2)
        });
        let (n, rank) = match regular {
            Some(factor) => {
                let mut n = factor.inverse();
                if let Some(projector) = projector {
                    n -= projector / mean;
                }
                (n, q.nrows() - datum.defect)
            }
            None => pseudo_inverse(q),
        };
        Self { points: points.to_vec(), n, rank }
    }

    /// Ω of differences at all points.
    pub fn omega(&self, d: &[Vector3<f64>]) -> f64 {
        let d = self.stacked(d);
        d.dot(&(&self.n * &d)).max(0.0)
    }

    /// dᵀN of two vectors at all points.
    pub fn product(&self, a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
        self.stacked(a).dot(&(&self.n * self.stacked(b)))
    }

    /// A matrix with a row for each of the points' coordinates as columns, times N.
    pub fn times(&self, rows: &DMatrix<f64>) -> DMatrix<f64> {
        rows * &self.n
    }

    fn stacked(&self, d: &[Vector3<f64>]) -> DVector<f64> {
        DVector::from_iterator(3 * self.points.len(), self.points.iter().flat_map(|&k| d[k].iter().copied()))
    }

    /// Ω_i of every point, in the order of the rows.
    pub fn contributions(&self, d: &[Vector3<f64>]) -> Vec<f64> {
        let w = &self.n * self.stacked(d);
        let own = |k: usize| {
            let block: Matrix3<f64> = self.n.fixed_view::<3, 3>(3 * k, 3 * k).into_owned();
            let w: Vector3<f64> = w.fixed_rows::<3>(3 * k).into_owned();
            w.dot(&(pseudo_inverse3(&block).0 * w)).max(0.0)
        };
        (0..self.points.len()).map(own).collect()
    }

    /// Largest variance of every point's displacement against the other points, N_ii⁻¹, in the order of the rows.
    pub fn against_others(&self) -> Vec<f64> {
        let own = |k: usize| {
            let block: Matrix3<f64> = self.n.fixed_view::<3, 3>(3 * k, 3 * k).into_owned();
            let (inverse, rank) = pseudo_inverse3(&block);
            if rank == 3 { inverse.symmetric_eigenvalues().max() } else { f64::MAX }
        };
        (0..self.points.len()).map(own).collect()
    }

    /// Weights without the point of row `k`.
    pub fn without(&self, k: usize) -> Self {
        let block: Matrix3<f64> = self.n.fixed_view::<3, 3>(3 * k, 3 * k).into_owned();
        let (inverse, rank) = pseudo_inverse3(&block);
        let kept: Vec<usize> = (0..self.points.len()).filter(|&i| i != k).collect();
        let rows: Vec<usize> = kept.iter().flat_map(|i| 3 * i..3 * i + 3).collect();
        let beside = self.n.columns(3 * k, 3).select_rows(&rows);
        let mut n = self.n.select_rows(&rows).select_columns(&rows);
        n -= &beside * inverse * beside.transpose();
        Self { points: kept.iter().map(|&i| self.points[i]).collect(), n, rank: self.rank - rank }
    }
}
