//! Orthogonal regression of a form to points: Σ d² is made least by Newton's steps, damped after Marquardt (1963) where a full one
//! does not lower it, and by Gauss-Newton's where the second derivatives lead to no minimum.
//!
//! With A = ∂d/∂form and B = ∂d/∂point the minimum has Aᵀd = 0 and N = AᵀA + Σ d ∂²d positive. Carried along with the points it
//! stays one by ∂form/∂point = -N⁻¹(AᵀB + Σ d ∂²d/∂form∂point). Of a short arc the second derivatives weigh as much as AᵀA: its bend
//! is hardly more than the residuals.

use nalgebra::{DMatrix, DVector, Matrix6, Vector3, Vector6};

use super::form::{GeometricForm, MOST};
use super::linear::Function;
use crate::error::{Error, Result};
use crate::error::{Place, Reason};

/// A fitted form with the derivatives of its parameters by the points.
pub struct Regression<F> {
    pub form: F,
    /// Per parameter.
    pub by: Vec<Function>,
    /// Σ d².
    pub cost: f64,
}

/// A fit that came to no form, with the Σ d² that it had come to: where one start of several ends so below all others, its valley
/// is the lowest and the others are not the answer.
pub struct Failure {
    pub cost: f64,
    pub error: Error,
}

const STEPS: usize = 100;
/// A step of this part of the form's size changes no digit.
const SETTLED: f64 = 1e-13;
/// What a further step would take off Σ d², over Σ d² a point: a form this near to the minimum is off by a thousandth of its
/// standard error. Farther away its figures are those of where the iteration stopped.
const CONVERGED: f64 = 1e-6;
/// Rounding of a distance, of the points' extent and the form's size.
const ROUNDING: f64 = 1e-15;
/// Smallest ratio of eigenvalues of the scaled normal equations at which a form counts as determined.
const DETERMINED: f64 = 1e-11;

/// Fits a form from its initial values; `numbers` are the points' numbers for the derivatives. Points are about 0 and of size 1.
///
/// # Errors
/// [`Reason::FeatureUndetermined`] if the points do not determine the form, [`Reason::FeatureUnsettled`] if the steps come to
/// no end.
pub fn fit<F: GeometricForm>(
    initial: F,
    points: &[Vector3<f64>],
    numbers: &[usize],
) -> std::result::Result<Regression<F>, Failure> {
    let n = F::PARAMETERS;
    let centroid = points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64;
    let mut form = initial.anchored(&centroid);
    let mut damping = 0.0;
    let mut now = equations(&form, points, n);
    for _ in 0..STEPS {
        let Some(step) = step(&now, damping, n) else { break };
        let change = step.iter().map(|s| s.abs()).fold(0.0, f64::max);
        let next = form.moved(&step).anchored(&centroid);
        let then = equations(&next, points, n);
        if then.cost.is_finite() && then.cost <= now.cost * (1.0 + 1e-14) {
            let full = damping == 0.0;
            damping = if damping < 1e-7 { 0.0 } else { damping / 10.0 };
            (form, now) = (next, then);
            if full && change <= SETTLED {
                break;
            }
        } else if damping == 0.0 && change <= 1e3 * SETTLED {
            break;
        } else {
            damping = if damping == 0.0 { 1e-4 } else { damping * 10.0 };
            if damping > 1e12 {
                break;
            }
        }
    }
    let failure = |error: Reason| Failure { cost: now.cost, error: refused(error) };
    if !determined(&now.gauss, n) {
        return Err(failure(Reason::FeatureUndetermined));
    }
    let least = now.gauss + now.second;
    let off = solved(&least, &now.right, n).map(|step| (0..n).map(|k| step[k] * now.right[k]).sum::<f64>());
    let count = points.len() as f64;
    let size = form.distance(&centroid).abs().max(1.0);
    let near = CONVERGED * now.cost / count + count * (ROUNDING * size).powi(2);
    if !off.is_some_and(|off| off <= near) {
        return Err(failure(Reason::FeatureUnsettled));
    }
    if !determined(&least, n) {
        return Err(failure(Reason::FeatureUndetermined));
    }
    let rows = form.rows(points);
    let mut right = DMatrix::<f64>::zeros(n, 3 * points.len());
    let mut add = |k: usize, point: usize, by: &Vector3<f64>| {
        (0..3).for_each(|axis| right[(k, 3 * point + axis)] += by[axis]);
    };
    for row in &rows {
        (0..n).for_each(|k| add(k, row.point, &(row.by_form[k] * row.by_point)));
    }
    for (point, x) in points.iter().enumerate() {
        let second = form.second(x);
        (0..n).for_each(|k| add(k, point, &second.by_point[k]));
    }
    let normal = DMatrix::from_fn(n, n, |i, j| least[(i, j)]);
    let Some(solved) = normal.cholesky().map(|factor| factor.solve(&right)) else {
        return Err(failure(Reason::FeatureUndetermined));
    };
    let by = (0..n).map(|k| {
        let column = |i: usize| -Vector3::new(solved[(k, 3 * i)], solved[(k, 3 * i + 1)], solved[(k, 3 * i + 2)]);
        numbers.iter().enumerate().map(|(i, number)| (*number, column(i))).collect()
    });
    Ok(Regression { by: by.collect(), cost: now.cost, form })
}

/// The best of several fits.
///
/// # Errors
/// That of the fit that came lowest, where it came to no form; [`Reason::FeatureUndetermined`] without any.
pub fn best<F: GeometricForm>(
    fits: impl Iterator<Item = std::result::Result<Regression<F>, Failure>>,
) -> Result<Regression<F>> {
    let cost = |fit: &std::result::Result<Regression<F>, Failure>| match fit {
        Ok(fit) => fit.cost,
        Err(failure) => failure.cost,
    };
    let best = fits.min_by(|a, b| cost(a).total_cmp(&cost(b)));
    best.map_or_else(|| Err(refused(Reason::FeatureUndetermined)), |fit| fit.map_err(|failure| failure.error))
}

fn refused(reason: Reason) -> Error {
    Error::Invalid { reason, at: Place::default() }
}

struct Equations {
    /// AᵀA.
    gauss: Matrix6<f64>,
    /// Σ d ∂²d.
    second: Matrix6<f64>,
    right: Vector6<f64>,
    cost: f64,
}

fn equations<F: GeometricForm>(form: &F, points: &[Vector3<f64>], n: usize) -> Equations {
    let zeros = Matrix6::zeros();
    let mut sum = Equations { gauss: zeros, second: zeros, right: Vector6::zeros(), cost: 0.0 };
    for row in form.rows(points) {
        sum.cost += row.distance * row.distance;
        for i in 0..n {
            sum.right[i] -= row.by_form[i] * row.distance;
            for j in 0..n {
                sum.gauss[(i, j)] += row.by_form[i] * row.by_form[j];
            }
        }
    }
    points.iter().for_each(|x| sum.second += form.second(x).by_form);
    sum
}

/// Newton's step, or that of Gauss and Newton where it leads to no minimum.
fn step(equations: &Equations, damping: f64, n: usize) -> Option<[f64; MOST]> {
    let gauss = &equations.gauss;
    let damped = |mut normal: Matrix6<f64>| {
        (0..n).for_each(|k| normal[(k, k)] += damping * gauss[(k, k)].max(f64::MIN_POSITIVE));
        solved(&normal, &equations.right, n)
    };
    damped(gauss + equations.second).or_else(|| damped(*gauss))
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
    let right = DVector::from_fn(n, |k, _| right[k] / unit[k]);
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
