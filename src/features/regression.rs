//! Orthogonal regression of a form to points: Σ d² is made least by Gauss-Newton steps, damped after Marquardt (1963) where a full
//! one does not lower it.
//!
//! At the minimum Aᵀd = 0 with A = ∂d/∂form. Carried along with the points (B = ∂d/∂point) it stays so by
//! ∂form/∂point = -(AᵀA)⁻¹AᵀB; what is left out is of the order of d over the size of the form.

use nalgebra::{DMatrix, Matrix6, Vector3, Vector6};

use super::form::{Form, MOST};
use super::linear::Function;
use crate::error::{Error, Result};
use crate::error::{Place, Reason};

/// A fitted form with the derivatives of its parameters by the points.
pub struct Regression<F> {
    pub form: F,
    /// Per parameter.
    pub by: Vec<Function>,
}

const STEPS: usize = 200;
/// A step of this part of the form's size changes no digit.
const SETTLED: f64 = 1e-13;
/// Smallest ratio of eigenvalues of the scaled normal equations at which a form counts as determined.
const DETERMINED: f64 = 1e-11;

/// Fits a form from its initial values; `numbers` are the points' numbers for the derivatives, `size` their extent.
///
/// # Errors
/// [`Reason::FeatureUndetermined`] where the points do not determine the form.
pub fn fit<F: Form>(initial: F, points: &[Vector3<f64>], numbers: &[usize], size: f64) -> Result<Regression<F>> {
    let n = F::PARAMETERS;
    let centroid = points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64;
    let mut form = initial.anchored(&centroid);
    let mut damping = 0.0;
    let mut now = equations(&form, points, n);
    for _ in 0..STEPS {
        let mut normal = now.normal;
        for k in 0..n {
            normal[(k, k)] += damping * normal[(k, k)].max(f64::MIN_POSITIVE);
        }
        let Some(step) = solved(&normal, &now.right, n) else { return Err(undetermined()) };
        let change = step.iter().map(|s| s.abs()).fold(0.0, f64::max);
        let next = form.moved(&step).anchored(&centroid);
        let then = equations(&next, points, n);
        if then.cost.is_finite() && then.cost <= now.cost * (1.0 + 1e-14) {
            damping = if damping < 1e-7 { 0.0 } else { damping / 10.0 };
            (form, now) = (next, then);
            if change <= SETTLED * size.max(1.0) {
                break;
            }
        } else if change <= 1e3 * SETTLED * size.max(1.0) {
            break;
        } else {
            damping = if damping == 0.0 { 1e-4 } else { damping * 10.0 };
            if damping > 1e12 {
                break;
            }
        }
    }
    if !determined(&now.normal, n) {
        return Err(undetermined());
    }
    let rows = form.rows(points);
    let mut right = DMatrix::<f64>::zeros(n, 3 * points.len());
    for row in &rows {
        for k in 0..n {
            for axis in 0..3 {
                right[(k, 3 * row.point + axis)] += row.by_form[k] * row.by_point[axis];
            }
        }
    }
    let normal = DMatrix::from_fn(n, n, |i, j| now.normal[(i, j)]);
    let Some(solved) = normal.cholesky().map(|factor| factor.solve(&right)) else { return Err(undetermined()) };
    let by = (0..n).map(|k| {
        let column = |i: usize| -Vector3::new(solved[(k, 3 * i)], solved[(k, 3 * i + 1)], solved[(k, 3 * i + 2)]);
        numbers.iter().enumerate().map(|(i, number)| (*number, column(i))).collect()
    });
    Ok(Regression { by: by.collect(), form })
}

fn undetermined() -> Error {
    Error::Invalid { reason: Reason::FeatureUndetermined, at: Place::default() }
}

struct Equations {
    normal: Matrix6<f64>,
    right: Vector6<f64>,
    cost: f64,
}

fn equations<F: Form>(form: &F, points: &[Vector3<f64>], n: usize) -> Equations {
    let mut sum = Equations { normal: Matrix6::zeros(), right: Vector6::zeros(), cost: 0.0 };
    for row in form.rows(points) {
        sum.cost += row.distance * row.distance;
        for i in 0..n {
            sum.right[i] -= row.by_form[i] * row.distance;
            for j in 0..n {
                sum.normal[(i, j)] += row.by_form[i] * row.by_form[j];
            }
        }
    }
    sum
}

/// Parameters have units of their own: scaled to a diagonal of ones before anything is judged or solved.
fn scaled(normal: &Matrix6<f64>, n: usize) -> Option<(DMatrix<f64>, [f64; MOST])> {
    let mut unit = [1.0; MOST];
    for k in 0..n {
        unit[k] = normal[(k, k)].sqrt();
        if !(unit[k] > 0.0) || !unit[k].is_finite() {
            return None;
        }
    }
    Some((DMatrix::from_fn(n, n, |i, j| normal[(i, j)] / (unit[i] * unit[j])), unit))
}

fn solved(normal: &Matrix6<f64>, right: &Vector6<f64>, n: usize) -> Option<[f64; MOST]> {
    let (matrix, unit) = scaled(normal, n)?;
    let right = nalgebra::DVector::from_fn(n, |k, _| right[k] / unit[k]);
    let solution = matrix.cholesky()?.solve(&right);
    let mut step = [0.0; MOST];
    for k in 0..n {
        step[k] = solution[k] / unit[k];
    }
    step.iter().all(|s| s.is_finite()).then_some(step)
}

fn determined(normal: &Matrix6<f64>, n: usize) -> bool {
    let Some((matrix, _)) = scaled(normal, n) else { return false };
    let values = matrix.symmetric_eigenvalues();
    values.min() > DETERMINED * values.max()
}
