//! Iterative data snooping: the one worst observation is taken out at a time, and comes back when it fits after all.
//!
//! The test statistic is Pope's τ, e/(σ0 √r_i), with σ0 from the adjustment, since the a priori standard errors of real
//! images are seldom right (A. J. Pope 1976). Observations taken out stay in the equations with a vanishing weight, so
//! that their prediction error e/(σ0 √(1 + q)) is at hand: they come back when it is below the same limit.

use crate::statistics::distribution::critical_tau;

use super::network::Network;

/// Square root of the weight of what is taken out.
pub const VANISHING: f64 = 1e-6;

/// Redundancy numbers below this leave nothing to test.
const TESTABLE: f64 = 1e-3;

/// What one round decides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Decision {
    /// Take this ray out.
    Remove {
        /// The ray.
        ray: usize,
        /// Its statistic.
        statistic: f64,
        /// The limit.
        limit: f64,
    },
    /// Take this ray back.
    Restore {
        /// The ray.
        ray: usize,
        /// Its statistic.
        statistic: f64,
        /// The limit.
        limit: f64,
    },
    /// Nothing is left to do.
    Done,
}

/// The next step, from weighted residuals (`residuals`, without the vanishing weights), cofactors of the weighted adjusted
/// observations and σ0. Rays in `settled` are not taken out.
pub fn decide(
    network: &Network,
    residuals: &[[f64; 2]],
    cofactors: &[[f64; 2]],
    removed: &[bool],
    settled: &[bool],
    redundancy: usize,
    sigma0: f64,
) -> Decision {
    let Some(limit) = critical_tau(redundancy).filter(|_| sigma0 > 0.0) else { return Decision::Done };
    let mut worst = (0, limit);
    let mut best = (0, limit);
    for ray in 0..network.rays.len() {
        let largest = |r: &dyn Fn(usize) -> Option<f64>| {
            (0..2).filter_map(|s| r(s).map(|r| (residuals[ray][s] / (sigma0 * r.sqrt())).abs())).fold(0.0, f64::max)
        };
        if removed[ray] {
            let predicted = largest(&|s| Some(1.0 + cofactors[ray][s] / (VANISHING * VANISHING)));
            // A little below the limit, so that nothing goes in and out forever.
            if predicted < 0.95 * best.1 {
                best = (ray, predicted);
            }
        } else if !settled[ray] {
            let statistic = largest(&|s| Some(1.0 - cofactors[ray][s]).filter(|r| *r > TESTABLE));
            if statistic > worst.1 {
                worst = (ray, statistic);
            }
        }
    }
    if worst.1 > limit {
        Decision::Remove { ray: worst.0, statistic: worst.1, limit }
    } else if best.1 < limit {
        Decision::Restore { ray: best.0, statistic: best.1, limit }
    } else {
        Decision::Done
    }
}

/// Rays to take out together with `ray`: a point left with a single ray loses that too. None when the photo would be left
/// with fewer than three points.
pub fn consequences(network: &Network, removed: &[bool], ray: usize) -> Option<Vec<usize>> {
    let point = network.points.iter().find(|p| p.rays.contains(&ray))?;
    let given = (0..3).all(|a| point.fixed[a] || point.prior[a].1 > 0.0);
    let others: Vec<usize> = point.rays.clone().filter(|r| *r != ray && !removed[*r]).collect();
    let mut out = vec![ray];
    if others.len() == 1 && !given {
        out.extend(others);
    }
    let left = |photo: usize| {
        network.rays.iter().enumerate().filter(|(k, r)| r.photo == photo && !removed[*k] && !out.contains(k)).count()
    };
    out.iter().all(|r| left(network.rays[*r].photo) >= 3).then_some(out)
}
