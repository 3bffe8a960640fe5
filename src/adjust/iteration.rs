//! The damped iteration: Gauss-Newton while it works, Levenberg-Marquardt damping where it does not.
//!
//! A step is taken when it lowers vᵀPv by a fair part of what the linear model predicts; else the damping λ rises. The
//! iteration ends when the undamped step is negligible against the standard errors, δᵀNδ ≤ ε² vᵀPv / r, or against the
//! rounding of the observations, so that exact observations (sigma0 of 0) converge like any others.
//! D. Marquardt, J. SIAM 11 (1963); K. Madsen, H. B. Nielsen, O. Tingleff 2004.

use crate::adjustment::{Iteration, Termination};

use super::layout::Layout;
use super::network::Network;
use super::normal::{Normal, cost};
use super::parameters::State;
use super::rows::Weighting;

/// Steps shorter than this part of the standard errors end the iteration.
const NEGLIGIBLE: f64 = 1e-5;
/// First damping when an undamped step fails.
const FIRST_DAMPING: f64 = 1e-4;
/// Damping beyond which no step is left to try.
const LARGEST_DAMPING: f64 = 1e12;

/// What the iteration works on.
pub struct Setting<'a> {
    /// The network.
    pub network: &'a Network,
    /// Places of its blocks.
    pub layout: &'a Layout,
    /// Photo unknowns that take up a free datum.
    pub pins: &'a [usize],
    /// Weights and place of the residuals.
    pub weighting: Weighting<'a>,
    /// n - u + d.
    pub redundancy: usize,
    /// Largest number of iterations.
    pub max_iterations: usize,
}

/// How it ended.
pub struct Outcome {
    /// Last accepted state.
    pub state: State,
    /// Why it ended.
    pub termination: Termination,
    /// Pivots of the last undamped factorisation that were lost to rounding.
    pub singular: Vec<usize>,
}

/// Iterates from `state`; `normal` is working space. `log` receives every iteration and says whether to go on.
pub fn iterate(
    setting: &Setting<'_>,
    normal: &mut Normal,
    mut state: State,
    log: &mut dyn FnMut(Iteration) -> bool,
) -> Outcome {
    let Setting { network, layout, pins, weighting, redundancy, max_iterations } = *setting;
    let rounding = rounding(network);
    let unit = redundancy.max(1) as f64;
    let mut lambda = 0.0;
    let mut growth = 4.0;
    let mut flat_steps = 0;
    let mut built = normal.build(network, layout, &state, weighting, lambda, pins);
    let mut behind = normal.behind;
    let mut singular = Vec::new();
    let outcome = |state, termination, singular| Outcome { state, termination, singular };
    if !built {
        return outcome(state, Termination::Diverged, singular);
    }
    for _ in 0..max_iterations {
        if !built && !normal.build(network, layout, &state, weighting, lambda, pins) {
            return outcome(state, Termination::Diverged, singular);
        }
        built = false;
        let before = normal.cost;
        let lost = normal.factor();
        if lambda == 0.0 {
            singular.clone_from(&lost);
        }
        let solution = normal.solve(network, layout, &state, weighting);
        let trial = state.stepped(network, &solution.step);
        let going = log(Iteration {
            sigma0: (before / unit).sqrt(),
            step: solution.step.largest() * network.frame.scale,
            damping: lambda,
        });
        let usable = trial.is_sound() && solution.decrement.is_finite() && lost.is_empty();
        let limit = NEGLIGIBLE * NEGLIGIBLE * before / unit + rounding;
        if usable && lambda == 0.0 && solution.decrement <= limit {
            return outcome(trial, Termination::Converged, singular);
        }
        if usable && solution.decrement <= limit && !singular.is_empty() {
            // What can be determined is determined; the rest is for the doctor.
            return outcome(trial, Termination::Converged, singular);
        }
        let after = if !usable {
            None
        } else if lambda == 0.0 {
            // A full step is nearly always good: its equations are built at once.
            built = normal.build(network, layout, &trial, weighting, 0.0, pins);
            built.then_some((normal.cost, normal.behind))
        } else {
            cost(network, &trial, weighting)
        };
        let gain = match after {
            Some((after, now_behind)) if behind > 0 || now_behind == 0 => (before - after) / solution.predicted,
            _ => f64::NEG_INFINITY,
        };
        let noise = 1e-12 * before + rounding;
        let flat = after.is_some_and(|(after, _)| (after - before).abs() <= noise) && solution.predicted <= noise;
        if gain > 1e-3 || flat {
            behind = after.map_or(behind, |(_, now)| now);
            state = trial;
            // The sum no longer tells steps apart; a few more are taken for the unknowns' own digits.
            flat_steps += usize::from(flat && lambda == 0.0);
            if flat_steps > 2 {
                return outcome(state, Termination::Converged, singular);
            }
            if lambda > 0.0 {
                lambda *= (1.0 - (2.0 * gain - 1.0).powi(3)).clamp(0.1, 1.0);
                growth = 4.0;
                if gain > 0.25 && (lambda < FIRST_DAMPING || solution.decrement <= limit) {
                    lambda = 0.0;
                }
            }
        } else {
            built = false;
            lambda = if lambda == 0.0 { FIRST_DAMPING } else { lambda * growth };
            growth *= 2.0;
            if lambda > LARGEST_DAMPING {
                return outcome(state, Termination::Diverged, singular);
            }
        }
        if !going {
            return outcome(state, Termination::Stopped, singular);
        }
    }
    outcome(state, Termination::IterationLimit, singular)
}

/// Square of what rounding leaves of the weighted residuals.
fn rounding(network: &Network) -> f64 {
    let one = |measured: f64, weight: f64| (64.0 * f64::EPSILON * weight * (measured.abs() + 1.0)).powi(2);
    network.rays.iter().map(|r| one(r.measured[0], r.weight[0]) + one(r.measured[1], r.weight[1])).sum()
}
