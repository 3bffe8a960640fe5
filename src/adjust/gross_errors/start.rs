//! A robust start: weights that follow the residuals while the iteration is still on its way, so that a gross error can neither
//! stop it nor distort it.
//!
//! Every few steps the weights are set anew from the errors with which all others predict each observation, at first by Huber's
//! function, which has a single minimum, then by Tukey's, which ignores large residuals. The scale is that of the present errors, so
//! that poor initial values, which make all of them large, weigh nothing down.

use crate::adjust::problem::additional;
use crate::adjust::solve::session::{Log, Session};
use crate::adjustment::{AdjustOptions, Robust, Termination};
use crate::error::Result;

use super::robust::{factor, median_scale, prediction};
use super::snooping::TESTABLE;

/// Rounds with either function, and steps in each.
const ROUNDS: [(Robust, usize); 2] = [(Robust::Huber, 15), (Robust::Tukey, 10)];
const STEPS: usize = 4;
/// Weights that change less are settled.
const SETTLED: f64 = 0.02;
/// Minimum square root of a factor: a downweighted observation must still determine unknowns that no other one determines.
pub const LEAST: f64 = 1e-3;
/// Maximum influence of an observation downweighted in this way, in standard errors.
const PULL: f64 = 0.1;

/// Minimum square root of the factor of an observation off by t standard errors.
pub fn least(t: f64) -> f64 {
    LEAST.min(PULL / t.abs())
}

impl Session<'_> {
    /// Iterates to a state that gross errors have not distorted, and leaves the robust weights set. Where the network does not
    /// come to rest that way it is iterated without them, from its initial values.
    ///
    /// # Errors
    /// As [`Self::iterate`].
    pub fn robust_start(&mut self, options: &AdjustOptions, log: &mut Log<'_>) -> Result<Termination> {
        let before = self.state.clone();
        let given = additional::all(&self.network);
        let own: Vec<f64> = given.iter().map(|observed| observed.sqrt_weight(&self.network)).collect();
        let approached = self.approach(options, log, &own);
        match approached {
            Ok(termination @ (Termination::Converged | Termination::Stopped)) => Ok(termination),
            _ => {
                self.state = before;
                self.forget_weights(&own);
                self.iterate(options, log)
            }
        }
    }

    /// Gives every observation its own weight again.
    pub fn forget_weights(&mut self, own: &[f64]) {
        self.weights = Vec::new();
        self.additional_factors = Vec::new();
        for (observed, own) in additional::all(&self.network).into_iter().zip(own) {
            observed.set_sqrt_weight(&mut self.network, *own);
        }
    }

    fn approach(&mut self, options: &AdjustOptions, log: &mut Log<'_>, own: &[f64]) -> Result<Termination> {
        let short = AdjustOptions { max_iterations: STEPS, ..options.clone() };
        let given = additional::all(&self.network);
        self.weights = vec![[1.0; 2]; self.network.rays.len()];
        self.additional_factors = vec![1.0; given.len()];
        // Where the first equations have no cofactors the residuals themselves have to do.
        let standards = self.standards(options, &given).ok();
        let mut termination = Termination::IterationLimit;
        for (kind, rounds) in ROUNDS {
            for _ in 0..rounds {
                let residuals = self.residuals(options)?;
                let errors: Vec<[f64; 2]> = match &standards {
                    Some(standards) => (0..residuals.len())
                        .map(|ray| {
                            let side = |side| self.standardised_ray(&residuals, standards, ray, side).unwrap_or(0.0);
                            [side(0), side(1)]
                        })
                        .collect(),
                    None => residuals,
                };
                let s = median_scale(errors.iter().flatten().copied().collect()).max(1.0);
                let weigh = |e: f64| factor(kind, e / s).sqrt().max(least(e));
                let mut change = 0.0_f64;
                for (weight, e) in self.weights.iter_mut().zip(&errors) {
                    // Both coordinates come from one mark: a wrong one is wrong in both.
                    let new = weigh(e[0].abs().max(e[1].abs()));
                    change = change.max((new - weight[0]).abs());
                    *weight = [new; 2];
                }
                for (k, observed) in given.iter().enumerate() {
                    let e = observed.residual(&self.network, &self.state) * own[k];
                    let new = weigh(match &standards {
                        Some(standards) => {
                            let factor = self.additional_factors[k].powi(2);
                            prediction(e, factor, standards.given[k], TESTABLE).unwrap_or(0.0)
                        }
                        None => e,
                    });
                    change = change.max((new - self.additional_factors[k]).abs());
                    self.additional_factors[k] = new;
                    observed.set_sqrt_weight(&mut self.network, own[k] * new);
                }
                if change < SETTLED && termination == Termination::Converged {
                    break;
                }
                termination = self.iterate(&short, log)?;
                if termination == Termination::Stopped {
                    return Ok(termination);
                }
            }
        }
        if termination != Termination::Converged {
            termination = self.iterate(options, log)?;
        }
        Ok(termination)
    }
}
