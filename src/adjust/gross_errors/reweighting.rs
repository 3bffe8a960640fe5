//! Robust estimation: weights from standardised residuals until they settle, their scale, and the variance of the result.

use crate::adjust::problem::additional::{self, Observed};
use crate::adjust::solve::session::{Log, RobustVariance, Session};
use crate::adjustment::{
    AdjustOptions, GrossError, GrossErrorAction, Robust, RobustScale, StatisticsChoice, Termination,
};
use crate::error::Result;
use crate::statistics::distribution::critical_w;

use super::robust::{factor, predicting, prediction, scale, variance};
use super::snooping::{Item, TESTABLE};
use super::start::LEAST;

/// Robust weights that change less are settled.
const SETTLED: f64 = 1e-5;
/// Rounds with one function, after the first few of which the scale is held.
const MOST_ROUNDS: usize = 80;
const SCALING_ROUNDS: usize = 12;
/// An observation whose weight is nearly lost and which still fixes more than half of its own adjusted value is the only one that
/// determines something.
const NEEDED: f64 = 0.5;
const LOST: f64 = 1e-3;
/// Rounds in which observations that are needed are given their weight again.
const MOST_KEPT: usize = 10;

/// What the residuals are standardised with.
struct Standards {
    /// Square roots of the redundancy numbers of the image coordinates at their own weights; 0 where nothing checks them.
    rays: Vec<[f64; 2]>,
    /// Per additional observation the cofactor by which the others predict it, in units of its own variance.
    given: Vec<f64>,
}

impl Session<'_> {
    /// Robust weights from a state near the solution; returns whether they settled. Sets the variance of the result.
    ///
    /// # Errors
    /// As [`Self::iterate`].
    pub fn reweight(
        &mut self,
        kind: Robust,
        options: &AdjustOptions,
        log: &mut Log<'_>,
        record: &mut Vec<GrossError>,
    ) -> Result<bool> {
        let given = additional::all(&self.network);
        // What is in the weights already belongs to the start.
        let own: Vec<f64> = (given.iter().enumerate())
            .map(|(k, observed)| {
                observed.sqrt_weight(&self.network) / self.given_factors.get(k).copied().unwrap_or(1.0)
            })
            .collect();
        let before = self.state.clone();
        self.reweighted(kind, options, log, (&given, &own), record).or_else(|_| {
            // Weights must not take away what determines the network: it is solved without them.
            self.state = before;
            self.forget_weights(&own);
            self.iterate(options, log)?;
            Ok(false)
        })
    }

    fn reweighted(
        &mut self,
        kind: Robust,
        options: &AdjustOptions,
        log: &mut Log<'_>,
        (given, own): (&[Observed], &[f64]),
        record: &mut Vec<GrossError>,
    ) -> Result<bool> {
        let started = std::mem::take(&mut self.weights);
        let mut standards = self.standards(options, given)?;
        self.weights = if started.is_empty() { vec![[1.0; 2]; self.network.rays.len()] } else { started };
        self.given_factors.resize(given.len(), 1.0);
        let mut kept_rays = vec![false; self.network.rays.len()];
        let mut kept_given = vec![false; given.len()];
        let stages: &[Robust] = if kind == Robust::Tukey { &[Robust::Huber, Robust::Tukey] } else { &[Robust::Huber] };
        let (mut settled, mut round, mut s) = (false, 0, 1.0);
        for again in 0..=MOST_KEPT {
            for stage in stages {
                settled = false;
                for turn in 0..MOST_ROUNDS {
                    round += 1;
                    let residuals = self.residuals(options)?;
                    if *stage == Robust::Huber && turn < SCALING_ROUNDS {
                        s = self.scale(&residuals, &standards, options.robust_scale);
                    }
                    let change = self.weigh_rays(*stage, &residuals, &standards, &kept_rays, s);
                    let change = change.max(self.weigh_given(*stage, given, own, &standards, &kept_given, s));
                    if change < SETTLED {
                        settled = true;
                        break;
                    }
                    if self.iterate(options, log)? != Termination::Converged {
                        return Ok(false);
                    }
                }
                standards.given = self.predicting(options, given)?;
            }
            let needed = self.needed(options, given)?;
            if needed.is_empty() || again == MOST_KEPT {
                break;
            }
            for item in needed {
                match item {
                    Item::Ray(ray) => kept_rays[ray] = true,
                    Item::Given(observed) => {
                        given.iter().zip(&mut kept_given).filter(|(g, _)| **g == observed).for_each(|(_, k)| *k = true);
                    }
                }
                let entry = self.gross_error(item, GrossErrorAction::Kept, round);
                record.push(GrossError { statistic: 0.0, limit: LOST, ..entry });
            }
        }
        let sigma0 = self.hard_sigma0(options, log, given, own, &standards, s)?;
        self.robust = Some(RobustVariance { sigma0, variance: variance(kind, sigma0, s) });
        let of_rays = self.weights.iter().enumerate().map(|(ray, w)| (Item::Ray(ray), w[0].min(w[1])));
        let of_given = given.iter().zip(&self.given_factors).map(|(observed, w)| (Item::Given(*observed), *w));
        for (item, factor) in of_rays.chain(of_given).map(|(item, w)| (item, w * w)).filter(|(_, f)| *f < 0.5) {
            let entry = self.gross_error(item, GrossErrorAction::Downweighted, round);
            record.push(GrossError { statistic: factor, limit: 0.5, ..entry });
        }
        Ok(settled)
    }

    /// sigma0 of least squares without what stands out of the robust solution: residuals of a robust solution are smaller than those
    /// their redundancy numbers stand for, and the fewer there are the more so. Leaves state and weights as they are.
    fn hard_sigma0(
        &mut self,
        options: &AdjustOptions,
        log: &mut Log<'_>,
        given: &[Observed],
        own: &[f64],
        standards: &Standards,
        s: f64,
    ) -> Result<f64> {
        let (state, weights, factors) = (self.state.clone(), self.weights.clone(), self.given_factors.clone());
        let residuals = self.residuals(options)?;
        let limit = critical_w();
        let soft = scale(&standardised(&residuals, standards));
        let decided = |t: f64| if t.abs() <= limit * s { 1.0 } else { LEAST };
        for (ray, weight) in self.weights.iter_mut().enumerate() {
            let side = |k: usize| match standards.rays[ray][k] {
                root if root > 0.0 => residuals[ray][k] / root,
                _ => 0.0,
            };
            *weight = [decided(side(0)), decided(side(1))];
        }
        for (k, observed) in given.iter().enumerate() {
            let e = observed.residual(&self.network, &self.state) * own[k];
            let t = prediction(e, factors[k].powi(2), standards.given[k], TESTABLE);
            self.given_factors[k] = t.map_or(1.0, decided);
            observed.set_sqrt_weight(&mut self.network, own[k] * self.given_factors[k]);
        }
        let solved = self.iterate(options, log).is_ok_and(|t| t == Termination::Converged);
        let full = AdjustOptions { statistics: StatisticsChoice::Full, covariance_of: Vec::new(), ..options.clone() };
        let solution = if solved { self.finish(&full, false).ok() } else { None };
        let sigma0 = solution.as_ref().and_then(|solution| {
            let cofactors = solution.cofactors.as_ref()?;
            let rays = self.weights.iter().flatten().zip(cofactors.rays.iter().flatten());
            let image: f64 = rays.filter(|(w, _)| **w == 1.0).map(|(_, c)| 1.0 - c).sum();
            let of_given = given.iter().zip(&self.given_factors).filter(|(_, w)| **w == 1.0);
            let others: f64 = of_given.map(|(observed, _)| 1.0 - observed.cofactor(&self.network, cofactors)).sum();
            let redundancy = image + others;
            (redundancy > 0.5).then(|| (solution.cost / redundancy).sqrt())
        });
        (self.state, self.weights, self.given_factors) = (state, weights, factors);
        for (k, observed) in given.iter().enumerate() {
            observed.set_sqrt_weight(&mut self.network, own[k] * self.given_factors[k]);
        }
        Ok(sigma0.unwrap_or(soft))
    }

    /// Scale of the weights: that of the standardised residuals, and unless asked never below the a priori one.
    fn scale(&self, residuals: &[[f64; 2]], standards: &Standards, choice: RobustScale) -> f64 {
        let s = scale(&standardised(residuals, standards));
        match choice {
            RobustScale::AtLeastPrior => s.max(1.0),
            RobustScale::Estimated => s,
        }
    }

    fn standards(&mut self, options: &AdjustOptions, given: &[Observed]) -> Result<Standards> {
        let full = AdjustOptions { statistics: StatisticsChoice::Full, covariance_of: Vec::new(), ..options.clone() };
        let solution = self.finish(&full, false)?;
        let Some(cofactors) = &solution.cofactors else {
            return Ok(Standards {
                rays: vec![[1.0; 2]; self.network.rays.len()],
                given: vec![f64::INFINITY; given.len()],
            });
        };
        let root = |c: &f64| Some(1.0 - c).filter(|r| *r > TESTABLE).map_or(0.0, f64::sqrt);
        let rays = cofactors.rays.iter().map(|[x, y]| [root(x), root(y)]).collect();
        Ok(Standards { rays, given: self.predicting_with(cofactors, given) })
    }

    fn predicting(&mut self, options: &AdjustOptions, given: &[Observed]) -> Result<Vec<f64>> {
        if given.is_empty() {
            return Ok(Vec::new());
        }
        let full = AdjustOptions { statistics: StatisticsChoice::Full, covariance_of: Vec::new(), ..options.clone() };
        let solution = self.finish(&full, false)?;
        Ok(match &solution.cofactors {
            Some(cofactors) => self.predicting_with(cofactors, given),
            None => vec![f64::INFINITY; given.len()],
        })
    }

    fn predicting_with(
        &self,
        cofactors: &crate::adjust::statistics::cofactors::Cofactors,
        given: &[Observed],
    ) -> Vec<f64> {
        let of = |(k, observed): (usize, &Observed)| {
            let factor = self.given_factors.get(k).copied().unwrap_or(1.0);
            predicting(observed.cofactor(&self.network, cofactors), factor * factor)
        };
        given.iter().enumerate().map(of).collect()
    }

    fn weigh_rays(
        &mut self,
        kind: Robust,
        residuals: &[[f64; 2]],
        standards: &Standards,
        kept: &[bool],
        s: f64,
    ) -> f64 {
        let mut change = 0.0_f64;
        for (ray, weight) in self.weights.iter_mut().enumerate() {
            for side in 0..2 {
                let root = standards.rays[ray][side];
                let free = root == 0.0 || kept[ray];
                let t = if free { 0.0 } else { residuals[ray][side] / (s * root) };
                let new = factor(kind, t).sqrt().max(LEAST);
                change = change.max((new - weight[side]).abs());
                weight[side] = new;
            }
        }
        change
    }

    fn weigh_given(
        &mut self,
        kind: Robust,
        given: &[Observed],
        own: &[f64],
        standards: &Standards,
        kept: &[bool],
        s: f64,
    ) -> f64 {
        let mut change = 0.0_f64;
        for (k, observed) in given.iter().enumerate() {
            let e = observed.residual(&self.network, &self.state) * own[k];
            let t = prediction(e, self.given_factors[k].powi(2), standards.given[k], TESTABLE);
            let new = match t.filter(|_| !kept[k]) {
                Some(t) => factor(kind, t / s).sqrt().max(LEAST),
                None => 1.0,
            };
            change = change.max((new - self.given_factors[k]).abs());
            self.given_factors[k] = new;
            observed.set_sqrt_weight(&mut self.network, own[k] * new);
        }
        change
    }

    /// Observations that have lost their weight and that nothing replaces.
    fn needed(&mut self, options: &AdjustOptions, given: &[Observed]) -> Result<Vec<Item>> {
        let lost = |w: f64| w * w <= LOST;
        let rays = self.weights.iter().flatten().any(|w| lost(*w));
        if !rays && !self.given_factors.iter().any(|w| lost(*w)) {
            return Ok(Vec::new());
        }
        let full = AdjustOptions { statistics: StatisticsChoice::Full, covariance_of: Vec::new(), ..options.clone() };
        let solution = self.finish(&full, false)?;
        let Some(cofactors) = &solution.cofactors else { return Ok(Vec::new()) };
        let mut needed = Vec::new();
        for point in &self.network.points {
            // A point all of whose rays have lost their weight is alone in what it does not know.
            if point.rays.clone().all(|k| self.weights[k].iter().any(|w| lost(*w))) {
                continue;
            }
            let ray = |k: &usize| (0..2).any(|s| lost(self.weights[*k][s]) && cofactors.rays[*k][s] > NEEDED);
            needed.extend(point.rays.clone().filter(ray).map(Item::Ray));
        }
        needed.extend(given.iter().zip(&self.given_factors).filter_map(|(observed, w)| {
            (lost(*w) && observed.cofactor(&self.network, cofactors) > NEEDED).then_some(Item::Given(*observed))
        }));
        Ok(needed)
    }
}

/// v/(σ√r) of the image coordinates that others check.
fn standardised(residuals: &[[f64; 2]], standards: &Standards) -> Vec<f64> {
    let pairs = residuals.iter().flatten().zip(standards.rays.iter().flatten());
    pairs.filter(|(_, root)| **root > 0.0).map(|(e, root)| e / root).collect()
}
