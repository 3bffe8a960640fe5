//! The damped iteration: Gauss-Newton steps, with Levenberg-Marquardt damping if a step fails.
//!
//! A step is taken when it lowers vᵀPv by a fair part of what the linear model predicts; else the damping λ rises. The
//! iteration ends when the undamped step is negligible against the standard errors, δᵀNδ ≤ ε² vᵀPv / r, or against the
//! rounding of the observations, so that exact observations (sigma0 of 0) converge like any others. It ends too where a hundred
//! steps no longer gain anything, however many are allowed.
//! D. Marquardt, J. SIAM 11 (1963); K. Madsen, H. B. Nielsen, O. Tingleff 2004.

use crate::adjust::equations::context::Context;
use crate::adjust::equations::normal::ReducedNormalEquations;
use crate::adjust::equations::right_hand_side::cost;
use crate::adjust::problem::network::Network;
use crate::adjust::problem::state::State;
use crate::adjustment::{Iteration, Termination};

/// Steps shorter than this part of the standard errors end the iteration of an adjustment whose result is handed out.
pub const NEGLIGIBLE: f64 = 1e-5;
/// A step this much shorter than the one before leaves the factor of the equations as it is: the next step solves them for a
/// new right-hand side alone (simplified Newton iteration; P. Deuflhard, Newton Methods, 2004).
const KEEPING: f64 = 0.01;
/// While steps shrink at least by this factor c, what is left after one of length l is about l·c/(1 - c).
const SHRINKING: f64 = 0.1;
/// First damping when an undamped step fails, and below which an undamped step is tried at first.
const FIRST_DAMPING: f64 = 1e-4;
/// After each failed undamped step, the damping must become smaller by this factor before the next one is tried, else a long way to the
/// minimum alternates between steps that fail and steps that do not; and the least that is asked for.
const PATIENCE: f64 = 0.1;
const LEAST_DAMPING: f64 = 1e-8;
/// Steps that crawl: where so many iterations lower the squares by less than this part, none of those that follow will end.
const LOOK_BACK: usize = 100;
const LEAST_GAIN: f64 = 1e-2;
/// Damping beyond which no step is left to try.
const LARGEST_DAMPING: f64 = 1e12;

/// Contents of the normal equations at the present state.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Ready {
    /// Nothing.
    No,
    /// The equations, not factored.
    Built,
    /// An earlier factor and the present right-hand side.
    Renewed,
}

/// Input of the iteration.
pub struct IterationSetup<'a> {
    /// The network at its first values.
    pub context: Context<'a>,
    /// Photo unknowns that take up a free datum.
    pub pins: &'a [usize],
    /// n - u + d.
    pub redundancy: usize,
    /// Largest number of iterations.
    pub max_iterations: usize,
    /// Steps shorter than this part of the standard errors end the iteration.
    pub negligible: f64,
}

/// Result of the iteration.
pub struct IterationResult {
    /// Last accepted state.
    pub state: State,
    /// Why it ended.
    pub termination: Termination,
    /// Pivots of the last undamped factorisation that were lost to rounding.
    pub singular: Vec<usize>,
}

/// Iterates; `normal` is working space. `log` receives every iteration and returns whether to continue.
pub fn iterate(
    setting: &IterationSetup<'_>,
    normal: &mut ReducedNormalEquations,
    log: &mut dyn FnMut(Iteration) -> bool,
) -> IterationResult {
    let IterationSetup { context, pins, redundancy, max_iterations, negligible } = *setting;
    let Context { network, layout, .. } = context;
    let mut state = context.state.clone();
    let rounding = rounding(network);
    let unit = redundancy.max(1) as f64;
    let mut lambda = 0.0;
    let mut growth = 2.0;
    let mut undamped_below = FIRST_DAMPING;
    let mut flat_steps = 0;
    let mut ready = if normal.build(context, lambda, pins) { Ready::Built } else { Ready::No };
    let mut behind = normal.behind;
    let mut singular = Vec::new();
    // Length of the last full step in standard errors.
    let mut length: Option<f64> = None;
    let outcome = |state, termination, singular| IterationResult { state, termination, singular };
    if ready == Ready::No {
        return outcome(state, Termination::Diverged, singular);
    }
    let mut looked = f64::INFINITY;
    for count in 0..max_iterations {
        if ready == Ready::No && !normal.build(context.at(&state), lambda, pins) {
            return outcome(state, Termination::Diverged, singular);
        }
        let before = normal.cost;
        if count.is_multiple_of(LOOK_BACK) {
            if before > (1.0 - LEAST_GAIN) * looked {
                return outcome(state, Termination::Diverged, singular);
            }
            looked = before;
        }
        let kept = ready == Ready::Renewed;
        let lost = if kept { Vec::new() } else { normal.factor() };
        ready = Ready::No;
        if lambda == 0.0 && !kept {
            singular.clone_from(&lost);
        }
        let solution = normal.solve(network, layout);
        let trial = state.stepped(network, &solution.step);
        let going = log(Iteration {
            sigma0: (before / unit).sqrt(),
            // A step that overflows is not taken, but it is told by a number, which files can hold.
            step: (solution.step.largest() * network.frame.scale).min(f64::MAX),
            damping: lambda,
        });
        let usable = trial.is_sound() && solution.decrement.is_finite() && lost.is_empty();
        let limit = negligible * negligible * before / unit + rounding;
        let contraction = length.filter(|_| lambda == 0.0).map(|length| solution.decrement.max(0.0).sqrt() / length);
        // What is left after the step, when the steps go on shrinking as they did.
        let left = match contraction {
            Some(c) if c < SHRINKING => solution.decrement * (c / (1.0 - c)).powi(2),
            _ => solution.decrement,
        };
        if usable && lambda == 0.0 && left <= limit {
            return outcome(trial, Termination::Converged, singular);
        }
        if usable && solution.decrement <= limit && !singular.is_empty() {
            // What can be determined is determined; the rest is for the doctor.
            return outcome(trial, Termination::Converged, singular);
        }
        let after = if !usable {
            None
        } else if lambda == 0.0 {
            // A full step is nearly always good: its equations are built at once, or, where the steps shrink fast, the
            // right-hand side alone.
            let keep = contraction.is_some_and(|c| c < KEEPING);
            let built =
                if keep { normal.renew(context.at(&trial)) } else { normal.build(context.at(&trial), 0.0, pins) };
            ready = match (built, keep) {
                (true, true) => Ready::Renewed,
                (true, false) => Ready::Built,
                _ => Ready::No,
            };
            built.then_some((normal.cost, normal.behind))
        } else {
            cost(context.at(&trial))
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
            length = Some(solution.decrement.max(0.0).sqrt()).filter(|length| lambda == 0.0 && *length > 0.0);
            // The sum no longer tells steps apart; a few more are taken for the unknowns' own digits.
            flat_steps += usize::from(flat && lambda == 0.0);
            if flat_steps > 2 {
                return outcome(state, Termination::Converged, singular);
            }
            if lambda > 0.0 {
                // Nielsen's rule: by the gain, smoothly from a third to twice.
                lambda *= (1.0 - (2.0 * gain - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0);
                growth = 2.0;
                if gain > 0.25 && (lambda < undamped_below || solution.decrement <= limit) {
                    lambda = 0.0;
                }
            }
        } else {
            ready = Ready::No;
            length = None;
            // A step with a kept factor is tried again with new equations first.
            if !kept {
                if lambda == 0.0 {
                    undamped_below = (undamped_below * PATIENCE).max(LEAST_DAMPING);
                }
                lambda = if lambda == 0.0 { FIRST_DAMPING } else { lambda * growth };
                growth *= 2.0;
            }
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
pub fn rounding(network: &Network) -> f64 {
    let one = |measured: f64, weight: f64| (64.0 * f64::EPSILON * weight * (measured.abs() + 1.0)).powi(2);
    network.rays.iter().map(|r| one(r.measured[0], r.sqrt_weight[0]) + one(r.measured[1], r.sqrt_weight[1])).sum()
}
