//! A robust start: weights that follow the residuals while the iteration is still on its way, so that a gross error can neither
//! stop it nor carry it away.
//!
//! Every few steps the weights are set anew from the residuals, at first by Huber's function, whose way has one end, then
//! by Tukey's, which forgets what is far off. The scale is that of the residuals at hand, so that poor initial values, which make
//! all residuals large, weigh nothing down.

use crate::adjust::problem::additional;
use crate::adjust::solve::session::{Log, Session};
use crate::adjustment::{AdjustOptions, Robust, Termination};
use crate::error::Result;

use super::robust::{factor, median_scale};

/// Rounds with either function, and steps in each.
const ROUNDS: [(Robust, usize); 2] = [(Robust::Huber, 15), (Robust::Tukey, 10)];
const STEPS: usize = 4;
/// Weights that change less are settled.
const SETTLED: f64 = 0.02;
/// Least square root of a factor: what is weighed down goes on holding what nothing else holds.
pub const LEAST: f64 = 1e-3;

impl Session<'_> {
    /// Iterates to a state that gross errors have not carried away, and leaves the robust weights set. Where the network does not
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
        self.given_factors = Vec::new();
        for (observed, own) in additional::all(&self.network).into_iter().zip(own) {
            observed.set_sqrt_weight(&mut self.network, *own);
        }
    }

    fn approach(&mut self, options: &AdjustOptions, log: &mut Log<'_>, own: &[f64]) -> Result<Termination> {
        let short = AdjustOptions { max_iterations: STEPS, ..options.clone() };
        let given = additional::all(&self.network);
        self.weights = vec![[1.0; 2]; self.network.rays.len()];
        self.given_factors = vec![1.0; given.len()];
        let mut termination = Termination::IterationLimit;
        for (kind, rounds) in ROUNDS {
            for _ in 0..rounds {
                let residuals = self.residuals(options)?;
                let s = median_scale(residuals.iter().flatten().copied().collect()).max(1.0);
                let weigh = |e: f64| factor(kind, e / s).sqrt().max(LEAST);
                let mut change = 0.0_f64;
                for (weight, e) in self.weights.iter_mut().zip(&residuals) {
                    // Both coordinates come from one mark: a wrong one is wrong in both.
                    let new = weigh(e[0].abs().max(e[1].abs()));
                    change = change.max((new - weight[0]).abs());
                    *weight = [new; 2];
                }
                for (k, observed) in given.iter().enumerate() {
                    let new = weigh(observed.residual(&self.network, &self.state) * own[k]);
                    change = change.max((new - self.given_factors[k]).abs());
                    self.given_factors[k] = new;
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
