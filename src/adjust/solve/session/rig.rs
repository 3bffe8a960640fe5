//! Covariance of the relative poses of a rig's cameras.
//!
//! A relative pose is the mean over the n exposures, a linear function f = Σ J_e / n of the photos' unknowns, and what is left of its own
//! elimination: with W the weights of an exposure, Q_rel = fᵀQf + W⁻¹/n. The datum sets Q as in [`super::calibration`].

use nalgebra::Matrix6;

use super::Session;
use crate::adjust::datum::free::{SIMILARITY, at_photo};
use crate::adjust::equations::back_substitution::Full;
use crate::adjust::problem::rig::Member;
use crate::error::Result;

impl Session<'_> {
    /// Covariance of the relative pose of every camera of the rig but the first: its small turn about the camera's own axes (radians), then
    /// its projection centre in the first camera's axes (the document's unit). Of weighted squares `cost`; the equations are those that
    /// [`Session::finish`] has factored.
    ///
    /// # Errors
    /// [`crate::Error::Invalid`] where the datum's points have come together.
    pub(super) fn relative_poses(&self, cost: f64) -> Result<Vec<Matrix6<f64>>> {
        self.network.rig.iter().map(|member| self.relative_pose(member, self.variance(cost))).collect()
    }

    fn relative_pose(&self, member: &Member, variance: f64) -> Result<Matrix6<f64>> {
        let constraint = self.constraint()?;
        let share = 1.0 / member.exposures.len() as f64;
        let mut functions: Vec<Full> = (0..6).map(|_| Full::zeros(&self.network, &self.layout)).collect();
        let mut taken = [[0.0; SIMILARITY]; 6];
        for (exposure, (_, photos)) in member.exposures.iter().enumerate() {
            let j = member.by_photos(&self.state, exposure) * share;
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
        if let Some((datum, d)) = &constraint {
            for (function, taken) in functions.iter_mut().zip(&taken) {
                for (k, &(carrier, axis)) in datum.carriers.iter().enumerate() {
                    let product: f64 = (0..datum.defect).map(|n| d[(k, n)] * taken[n]).sum();
                    function.add_at_point(&self.layout, carrier, axis, -product);
                }
            }
        }
        let mut solved = functions.clone();
        self.normal.solve_all(&self.network, &self.layout, &mut solved);
        let scale = |k: usize| if k < 3 { 1.0 } else { self.network.frame.scale };
        let mut q = Matrix6::from_fn(|a, b| functions[a].product(&solved[b]));
        for k in 0..6 {
            q[(k, k)] += share / member.sqrt_weight[k / 3].powi(2);
        }
        let q = (q + q.transpose()) * 0.5;
        Ok(Matrix6::from_fn(|a, b| variance * q[(a, b)] * scale(a) * scale(b)))
    }
}
