//! Iterative data snooping: one observation, the worst, is excluded per round, and restored if it fits after all.
//!
//! Observations of every kind are tested alike: image coordinates (both of a ray together), control coordinates, observed
//! projection centres, distances and observed parameters. The test statistic is Pope's τ, e/(σ0 √r_i), with σ0 from the
//! adjustment, since the a priori standard errors of real images are seldom right (A. J. Pope 1976). Observations taken
//! out stay in the equations with a vanishing weight, so that their prediction error e/(σ0 √(1 + q)) is available: they come
//! back when it is below the limit of Student's t, since σ0 is one they have no part in. With little redundancy that one
//! is far wider than τ's, and what chance has taken out would else never return.

use crate::adjust::problem::additional::{self, AdditionalObservation};
use crate::adjust::problem::network::Network;
use crate::statistics::distribution::{critical_t, critical_tau};

/// Square root of the weight of what is taken out, and what it pulls at most in standard errors.
const VANISHING: f64 = 1e-4;
const PULL: f64 = 0.01;

/// Square root of the weight of what is taken out with this statistic.
pub fn vanishing(statistic: f64) -> f64 {
    VANISHING.min(PULL / statistic.abs())
}

/// An observation taken out whose weighted cofactor is larger all the same is the only one that determines its place.
const UNPREDICTED: f64 = 0.01;

/// Redundancy numbers below this leave nothing to test.
pub const TESTABLE: f64 = 1e-3;

/// Observations that are tested and rejected as one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Item {
    /// A ray: two image coordinates.
    Ray(usize),
    /// An observation of another kind.
    Additional(AdditionalObservation),
}

/// All items of a network, rays first.
pub fn items(network: &Network) -> Vec<Item> {
    let rays = (0..network.rays.len()).map(Item::Ray);
    rays.chain(additional::all(network).into_iter().map(Item::Additional)).collect()
}

/// What the tests of an item need: per scalar observation the weighted residual, without the vanishing weight, and the
/// cofactor of the weighted adjusted observation.
pub type Tests = [Option<(f64, f64)>; 2];

/// Decisions of one round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Decision {
    /// Take this item out.
    Remove {
        /// Its number.
        item: usize,
        /// Its statistic.
        statistic: f64,
        /// The limit.
        limit: f64,
    },
    /// Take this item back.
    Restore {
        /// Its number.
        item: usize,
        /// Its statistic.
        statistic: f64,
        /// The limit.
        limit: f64,
    },
    /// Nothing is left to do.
    Done,
}

/// The next step. Items in `settled` are not taken out; those taken out have the square root of their weight in `removed`.
pub fn decide(tests: &[Tests], removed: &[Option<f64>], settled: &[bool], redundancy: usize, sigma0: f64) -> Decision {
    let limits = critical_tau(redundancy).zip(critical_t(redundancy)).filter(|_| sigma0 > 0.0);
    let Some((limit, limit_outside)) = limits else { return Decision::Done };
    let mut worst = (0, limit);
    let mut best = (0, limit_outside);
    for (item, tests) in tests.iter().enumerate() {
        let largest = |variance: &dyn Fn(f64) -> Option<f64>| {
            let one = |(e, q): (f64, f64)| variance(q).map(|r| (e / (sigma0 * r.sqrt())).abs());
            tests.iter().flatten().filter_map(|test| one(*test)).fold(0.0, f64::max)
        };
        if let Some(vanishing) = removed[item] {
            // An observation that no other predicts agrees only with itself, so it stays rejected.
            if tests.iter().flatten().any(|(_, q)| *q > UNPREDICTED) {
                continue;
            }
            let predicted = largest(&|q| Some(1.0 + q / (vanishing * vanishing)));
            // A little below the limit, so that nothing goes in and out forever.
            if predicted < 0.95 * best.1 {
                best = (item, predicted);
            }
        } else if !settled[item] {
            let statistic = largest(&|q| Some(1.0 - q).filter(|r| *r > TESTABLE));
            if statistic > worst.1 {
                worst = (item, statistic);
            }
        }
    }
    if worst.1 > limit {
        Decision::Remove { item: worst.0, statistic: worst.1, limit }
    } else if best.1 < limit_outside {
        Decision::Restore { item: best.0, statistic: best.1, limit: limit_outside }
    } else {
        Decision::Done
    }
}

/// Items to take out together with `item`, itself first: a point left with a single ray loses that too. `None` if a photo
/// would be left with fewer than three points. What no other observation determines has a redundancy number of 0 and is
/// never asked for.
pub fn consequences(network: &Network, items: &[Item], removed: &[Option<f64>], item: usize) -> Option<Vec<usize>> {
    // Rays are numbered as in the network.
    let Item::Ray(ray) = items[item] else { return Some(vec![item]) };
    let at = network.points.iter().position(|p| p.rays.contains(&ray))?;
    let point = &network.points[at];
    let known = |a: usize| {
        let own = items.iter().position(|item| *item == Item::Additional(AdditionalObservation::Control(at, a)));
        point.fixed[a] || own.is_some_and(|k| removed[k].is_none())
    };
    let others: Vec<usize> = point.rays.clone().filter(|r| *r != ray && removed[*r].is_none()).collect();
    let mut out = vec![item];
    if others.len() == 1 && !(0..3).all(known) {
        out.extend(others);
    }
    let left = |photo: usize| {
        network
            .rays
            .iter()
            .enumerate()
            .filter(|(k, r)| r.photo == photo && removed[*k].is_none() && !out.contains(k))
            .count()
    };
    out.iter().all(|r| left(network.rays[*r].photo) >= 3).then_some(out)
}
