//! Covariance of the relative poses of a rig's cameras, and tests of what single exposures are off.
//!
//! The mean relative pose over the n exposures was eliminated from the equations. Given the photos' unknowns it is the linear function
//! f = Σ J_e / n of them, and its own conditional cofactor is W⁻¹/n, W being the weight matrix of an exposure:
//! Q_rel = fᵀQf + W⁻¹/n. Q is taken in the chosen datum as in [`super::calibration`].
//!
//! The deviation d_e of an exposure is the residual of six observations; with g_e = J_e - f its cofactors are Q_d = (1 - 1/n) W⁻¹ - g_eᵀQg_e. An
//! exposure at which the mount moved, or whose photos were not taken together, lowers vᵀPv by T = dᵀQ_d⁻¹d if its relative pose is free,
//! and F = (T / k) / ((vᵀPv - T) / (r - k)) is tested, k = 6 unless a part of the deviation is not checked. W. Baarda, A testing procedure for use in
//! geodetic networks, 1968, for a group of observations; the variance factor is that of the others.

use nalgebra::{DMatrix, Matrix6, SymmetricEigen};

use super::Session;
use crate::adjust::datum::free::{FreeDatum, SIMILARITY, at_photo};
use crate::adjust::equations::back_substitution::Full;
use crate::adjust::problem::rig::Member;
use crate::error::Result;
use crate::statistics::fisher::Fisher;

/// A free datum with the rows of its constraint.
type Constraint<'a> = (&'a FreeDatum, DMatrix<f64>);

/// Part of a deviation's weight that has to be left to the residual for it to be tested.
const CHECKED: f64 = 1e-4;

/// A camera of the rig: the covariance of its relative pose, and the test of every exposure.
#[derive(Clone, Debug)]
pub struct RigStatistics {
    /// Small turn about the camera's own axes (radians), then its projection centre in the first camera's axes (the document's unit).
    pub covariance: Matrix6<f64>,
    /// Per exposure; empty where nothing can be tested, as with one exposure or under robust weights.
    pub tests: Vec<Option<DeviationTest>>,
}

/// Whether chance explains a deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviationTest {
    /// Degrees of freedom of the numerator, 6 or fewer.
    pub degrees: usize,
    /// Sum of the redundancy numbers, 0 to 6.
    pub redundancy: f64,
    /// F.
    pub statistic: f64,
    /// How often chance makes it as large.
    pub p_value: f64,
}

impl Session<'_> {
    /// Covariance and tests of each camera of the rig except the first. `cost` is vᵀPv, from which the variance factor is computed. Uses the
    /// equations that [`Session::finish`] has factored.
    ///
    /// # Errors
    /// [`crate::Error::Invalid`] if the datum points coincide.
    pub(super) fn rig_statistics(&self, cost: f64) -> Result<Vec<RigStatistics>> {
        let constraint = self.constraint()?;
        let of = |member| self.member_statistics(member, constraint.as_ref(), cost);
        Ok(self.network.rig.iter().map(of).collect())
    }

    fn member_statistics(&self, member: &Member, constraint: Option<&Constraint<'_>>, cost: f64) -> RigStatistics {
        let n = member.exposures.len();
        let share = 1.0 / n as f64;
        let scale = |k: usize| if k < 3 { 1.0 } else { self.network.frame.scale };
        let mut q = self.cofactors_of(member, constraint, &vec![share; n]);
        for k in 0..6 {
            q[(k, k)] += share / member.sqrt_weight[k / 3].powi(2);
        }
        let variance = self.variance(cost);
        let covariance = Matrix6::from_fn(|a, b| variance * q[(a, b)] * scale(a) * scale(b));
        let mut tests = Vec::new();
        if n > 1 && self.robust.is_none() {
            let equations = member.equations(&self.state);
            tests.extend(equations.iter().enumerate().map(|(exposure, (deviation, _))| {
                let coefficients: Vec<f64> = (0..n).map(|e| f64::from(e == exposure) - share).collect();
                let by_photos = self.cofactors_of(member, constraint, &coefficients);
                let weight = |k: usize| member.sqrt_weight[k / 3];
                let left = Matrix6::from_fn(|a, b| {
                    let own = if a == b { 1.0 - share } else { 0.0 };
                    own - weight(a) * by_photos[(a, b)] * weight(b)
                });
                let eigen = SymmetricEigen::new(left);
                let (mut lowered, mut degrees) = (0.0, 0);
                for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
                    if *value > CHECKED {
                        lowered += vector.dot(deviation).powi(2) / value;
                        degrees += 1;
                    }
                }
                let others = self.redundancy.checked_sub(degrees).filter(|others| *others > 0 && degrees > 0)? as f64;
                // Rounding may leave nothing or less.
                let rest = (cost - lowered).max(1e-12 * cost);
                let statistic = lowered / degrees as f64 / (rest / others);
                let p_value = Fisher::new(degrees, Some(others)).tails(statistic)[1];
                let test = DeviationTest { degrees, redundancy: left.trace(), statistic, p_value };
                statistic.is_finite().then_some(test)
            }));
        }
        RigStatistics { covariance, tests }
    }

    /// Cofactors of the six functions Σ c_e J_e of the photos' unknowns.
    fn cofactors_of(&self, member: &Member, constraint: Option<&Constraint<'_>>, coefficients: &[f64]) -> Matrix6<f64> {
        let mut functions: Vec<Full> = (0..6).map(|_| Full::zeros(&self.network, &self.layout)).collect();
        let mut taken = [[0.0; SIMILARITY]; 6];
        for (exposure, ((_, photos), coefficient)) in member.exposures.iter().zip(coefficients).enumerate() {
            let j = member.by_photos(&self.state, exposure) * *coefficient;
            let directions = photos.map(|photo| {
                let pose = &self.state.poses[photo];
                at_photo(&pose.m, &pose.centre)
            });
            for (row, function) in functions.iter_mut().enumerate() {
                for column in 0..12 {
                    let by = j[(row, column)];
                    function.reduced[member.place(&self.layout.photo, exposure, column)] += by;
                    let direction = directions[column / 6][column % 6];
                    taken[row].iter_mut().zip(direction).for_each(|(sum, g)| *sum += by * g);
                }
            }
        }
        if let Some((datum, d)) = constraint {
            for (function, taken) in functions.iter_mut().zip(&taken) {
                for (k, &(carrier, axis)) in datum.carriers.iter().enumerate() {
                    let product: f64 = (0..datum.defect).map(|n| d[(k, n)] * taken[n]).sum();
                    function.add_at_point(&self.layout, carrier, axis, -product);
                }
            }
        }
        let mut solved = functions.clone();
        self.normal.solve_all(&self.network, &self.layout, &mut solved);
        let q = Matrix6::from_fn(|a, b| functions[a].product(&solved[b]));
        (q + q.transpose()) * 0.5
    }
}
