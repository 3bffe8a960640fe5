//! Robust estimation: weights from standardised residuals until they settle, their scale, and the variance of the result.
//!
//! The way begins at what data snooping decides, as that of an MM-estimate does at a solution of high breakdown (V. J.
//! Yohai 1987): in poorly controlled networks Huber's weights alone are distorted by a wrong observation that holds
//! its own place. What stands out there has no weight as long as it stands out.

use crate::adjust::problem::additional::{self, AdditionalObservation};
use crate::adjust::solve::session::{Log, RobustVariance, Session, Solution};
use crate::adjust::statistics::cofactors::Cofactors;
use crate::adjustment::{
    AdjustOptions, GrossError, GrossErrorAction, Robust, RobustScale, StatisticsChoice, Termination,
};
use crate::error::Result;
use crate::statistics::distribution::critical_w;

use super::robust::{factor, predicting, prediction, scale, variance};
use super::snooping::{Item, TESTABLE};
use super::start::{LEAST, least};

/// Robust weights that change less are settled.
const SETTLED: f64 = 1e-4;
/// Rounds with one function, after the first few of which the scale is held.
const MOST_ROUNDS: usize = 80;
const SCALING_ROUNDS: usize = 12;
/// An observation whose weight is nearly lost and which still fixes more than half of its own adjusted value is the only one that
/// determines something.
const NEEDED: f64 = 0.5;
const LOST: f64 = 1e-3;
/// Rounds in which observations that are needed are given their weight again.
const MOST_KEPT: usize = 10;

/// Rounds of least squares in which outliers are determined.
const MOST_DECISIONS: usize = 10;
/// Minimum redundancy for an estimate of sigma0.
const LEAST_REDUNDANCY: f64 = 0.5;

/// What errors are standardised with: cofactors by which all others predict an observation, in units of its own variance (see
/// [`prediction`]). With its own weight the standardised error is v/(σ√r); what has lost its weight no longer draws the
/// solution to itself, and its larger residual is not taken for a larger error.
pub struct Standards {
    /// Per image coordinate, all having their own weights.
    pub rays: Vec<[f64; 2]>,
    /// Per additional observation.
    pub given: Vec<f64>,
}

/// Observations rejected by data snooping: flags per ray and per additional observation.
struct Outside {
    rays: Vec<bool>,
    given: Vec<bool>,
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
                observed.sqrt_weight(&self.network) / self.additional_factors.get(k).copied().unwrap_or(1.0)
            })
            .collect();
        let before = self.state.clone();
        let found = self.standing_out(options, log);
        let out = Outside {
            rays: (0..self.network.rays.len()).map(|ray| found.contains(&Item::Ray(ray))).collect(),
            given: given.iter().map(|observed| found.contains(&Item::Additional(*observed))).collect(),
        };
        if !found.is_empty() {
            // The weights that belong to its values.
            let factor = |out: &bool| if *out { LEAST } else { 1.0 };
            self.weights = out.rays.iter().map(|out| [factor(out); 2]).collect();
            self.additional_factors = out.given.iter().map(factor).collect();
            for (k, observed) in given.iter().enumerate() {
                observed.set_sqrt_weight(&mut self.network, own[k] * self.additional_factors[k]);
            }
        }
        self.reweighted(kind, options, log, (&given, &own), &out, record).or_else(|_| {
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
        (given, own): (&[AdditionalObservation], &[f64]),
        out: &Outside,
        record: &mut Vec<GrossError>,
    ) -> Result<bool> {
        let started = std::mem::take(&mut self.weights);
        let mut standards = self.standards(options, given)?;
        self.weights = if started.is_empty() { vec![[1.0; 2]; self.network.rays.len()] } else { started };
        self.additional_factors.resize(given.len(), 1.0);
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
                        s = at_least(options.robust_scale, scale(&self.standardised(&residuals, &standards)));
                    }
                    let change = self.weigh_rays(*stage, &residuals, &standards, (&kept_rays, &out.rays), s);
                    let change =
                        change.max(self.weigh_given(*stage, (given, own), &standards, (&kept_given, &out.given), s));
                    if change < SETTLED {
                        settled = true;
                        break;
                    }
                    match self.iterate(options, log)? {
                        Termination::Converged => {}
                        Termination::Stopped => return Ok(false),
                        Termination::IterationLimit | Termination::Diverged => break,
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
                    Item::Additional(observed) => {
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
        let of_given =
            given.iter().zip(&self.additional_factors).map(|(observed, w)| (Item::Additional(*observed), *w));
        for (item, factor) in of_rays.chain(of_given).map(|(item, w)| (item, w * w)).filter(|(_, f)| *f < 0.5) {
            let entry = self.gross_error(item, GrossErrorAction::Downweighted, round);
            record.push(GrossError { statistic: factor, limit: 0.5, ..entry });
        }
        Ok(settled)
    }

    /// sigma0 of least squares without the outliers of the robust solution: residuals of a robust solution are smaller than those
    /// their redundancy numbers stand for, and the fewer there are the more so. Outliers are determined again with every such
    /// solution until it stays the same, always by the robust scale: what is still inside must not widen the limits by which it
    /// is judged. Leaves state and weights as they are.
    fn hard_sigma0(
        &mut self,
        options: &AdjustOptions,
        log: &mut Log<'_>,
        given: &[AdditionalObservation],
        own: &[f64],
        standards: &Standards,
        s: f64,
    ) -> Result<f64> {
        let (state, weights, factors) = (self.state.clone(), self.weights.clone(), self.additional_factors.clone());
        let residuals = self.residuals(options)?;
        let mut sigma0 = scale(&self.standardised(&residuals, standards));
        let mut decided = self.decided(&residuals, given, own, standards, s);
        for _ in 0..MOST_DECISIONS {
            let (of_rays, of_given) = decided.split_at(self.weights.len());
            self.weights = of_rays.iter().map(|factor| [*factor; 2]).collect();
            for (k, observed) in given.iter().enumerate() {
                self.additional_factors[k] = of_given[k];
                observed.set_sqrt_weight(&mut self.network, own[k] * self.additional_factors[k]);
            }
            if !self.iterate(options, log).is_ok_and(|t| t == Termination::Converged) {
                break;
            }
            let full =
                AdjustOptions { statistics: StatisticsChoice::Full, covariance_of: Vec::new(), ..options.clone() };
            let Ok(Solution { cofactors: Some(cofactors), .. }) = self.finish(&full, false) else { break };
            let residuals = self.residuals(options)?;
            let (mut squares, mut redundancy) = (0.0, 0.0);
            for (ray, _) in of_rays.iter().enumerate().filter(|(_, factor)| **factor == 1.0) {
                squares += residuals[ray].iter().map(|e| e * e).sum::<f64>();
                redundancy += cofactors.rays[ray].iter().map(|c| 1.0 - c).sum::<f64>();
            }
            for (k, observed) in given.iter().enumerate().filter(|(k, _)| of_given[*k] == 1.0) {
                squares += (observed.residual(&self.network, &self.state) * own[k]).powi(2);
                redundancy += 1.0 - observed.cofactor(&self.network, &cofactors);
            }
            if redundancy < LEAST_REDUNDANCY {
                break;
            }
            sigma0 = (squares / redundancy).sqrt();
            let present =
                Standards { rays: self.predicting_rays(&cofactors), given: self.predicting_with(&cofactors, given) };
            let next = self.decided(&residuals, given, own, &present, s);
            let settled = next.iter().zip(&decided).all(|(a, b)| (*a == 1.0) == (*b == 1.0));
            decided = next;
            if settled {
                break;
            }
        }
        (self.state, self.weights, self.additional_factors) = (state, weights, factors);
        for (k, observed) in given.iter().enumerate() {
            observed.set_sqrt_weight(&mut self.network, own[k] * self.additional_factors[k]);
        }
        Ok(sigma0)
    }

    /// Square roots of the factors on the weights by hard decision: 1 for rays, both coordinates together, and additional observations
    /// whose errors are within what the scale `s` allows, or that nothing checks.
    fn decided(
        &self,
        residuals: &[[f64; 2]],
        given: &[AdditionalObservation],
        own: &[f64],
        standards: &Standards,
        s: f64,
    ) -> Vec<f64> {
        let limit = critical_w() * s;
        let factor = |t: f64| if t.abs() <= limit { 1.0 } else { least(t) };
        let of_rays = (0..self.weights.len()).map(|ray| {
            let side = |side| self.standardised_ray(residuals, standards, ray, side).map_or(1.0, factor);
            side(0).min(side(1))
        });
        let of_given = given.iter().enumerate().map(|(k, observed)| {
            let e = observed.residual(&self.network, &self.state) * own[k];
            prediction(e, self.additional_factors[k].powi(2), standards.given[k], TESTABLE).map_or(1.0, factor)
        });
        of_rays.chain(of_given).collect()
    }

    /// Standardised error of an image coordinate; `None` if nothing checks it.
    pub fn standardised_ray(
        &self,
        residuals: &[[f64; 2]],
        standards: &Standards,
        ray: usize,
        side: usize,
    ) -> Option<f64> {
        let factor = self.weights[ray][side].powi(2);
        prediction(residuals[ray][side], factor, standards.rays[ray][side], TESTABLE)
    }

    /// Standardised errors of the image coordinates that others check.
    fn standardised(&self, residuals: &[[f64; 2]], standards: &Standards) -> Vec<f64> {
        let one = |ray| [0, 1].map(|side| self.standardised_ray(residuals, standards, ray, side));
        (0..self.weights.len()).flat_map(one).flatten().collect()
    }

    /// At the present weights and values.
    ///
    /// # Errors
    /// As [`Self::finish`].
    pub fn standards(&mut self, options: &AdjustOptions, given: &[AdditionalObservation]) -> Result<Standards> {
        let full = AdjustOptions { statistics: StatisticsChoice::Full, covariance_of: Vec::new(), ..options.clone() };
        let solution = self.finish(&full, false)?;
        let Some(cofactors) = &solution.cofactors else {
            return Ok(Standards {
                rays: vec![[f64::INFINITY; 2]; self.network.rays.len()],
                given: vec![f64::INFINITY; given.len()],
            });
        };
        Ok(Standards { rays: self.predicting_rays(cofactors), given: self.predicting_with(cofactors, given) })
    }

    fn predicting_rays(&self, cofactors: &Cofactors) -> Vec<[f64; 2]> {
        let factor = |ray: usize, side: usize| self.weights.get(ray).map_or(1.0, |w| w[side].powi(2));
        let of = |(ray, c): (usize, &[f64; 2])| [0, 1].map(|side| predicting(c[side], factor(ray, side)));
        cofactors.rays.iter().enumerate().map(of).collect()
    }

    fn predicting(&mut self, options: &AdjustOptions, given: &[AdditionalObservation]) -> Result<Vec<f64>> {
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

    fn predicting_with(&self, cofactors: &Cofactors, given: &[AdditionalObservation]) -> Vec<f64> {
        let of = |(k, observed): (usize, &AdditionalObservation)| {
            let factor = self.additional_factors.get(k).copied().unwrap_or(1.0);
            predicting(observed.cofactor(&self.network, cofactors), factor * factor)
        };
        given.iter().enumerate().map(of).collect()
    }

    fn weigh_rays(
        &mut self,
        kind: Robust,
        residuals: &[[f64; 2]],
        standards: &Standards,
        (kept, out): (&[bool], &[bool]),
        s: f64,
    ) -> f64 {
        let mut change = 0.0_f64;
        for ray in 0..self.weights.len() {
            let both = [0, 1].map(|side| self.standardised_ray(residuals, standards, ray, side).filter(|_| !kept[ray]));
            // Both coordinates come from one mark.
            let outside = out[ray] && both.iter().flatten().any(|t| t.abs() > critical_w() * s);
            for side in 0..2 {
                let new = both[side].map_or(1.0, |t| weight(kind, t, s, outside));
                change = change.max((new - self.weights[ray][side]).abs());
                self.weights[ray][side] = new;
            }
        }
        change
    }

    fn weigh_given(
        &mut self,
        kind: Robust,
        (given, own): (&[AdditionalObservation], &[f64]),
        standards: &Standards,
        (kept, out): (&[bool], &[bool]),
        s: f64,
    ) -> f64 {
        let mut change = 0.0_f64;
        for (k, observed) in given.iter().enumerate() {
            let e = observed.residual(&self.network, &self.state) * own[k];
            let t = prediction(e, self.additional_factors[k].powi(2), standards.given[k], TESTABLE);
            let new = match t.filter(|_| !kept[k]) {
                Some(t) => weight(kind, t, s, out[k] && t.abs() > critical_w() * s),
                None => 1.0,
            };
            change = change.max((new - self.additional_factors[k]).abs());
            self.additional_factors[k] = new;
            observed.set_sqrt_weight(&mut self.network, own[k] * new);
        }
        change
    }

    /// Observations that have lost their weight and that nothing replaces.
    fn needed(&mut self, options: &AdjustOptions, given: &[AdditionalObservation]) -> Result<Vec<Item>> {
        let lost = |w: f64| w * w <= LOST;
        let rays = self.weights.iter().flatten().any(|w| lost(*w));
        if !rays && !self.additional_factors.iter().any(|w| lost(*w)) {
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
        needed.extend(given.iter().zip(&self.additional_factors).filter_map(|(observed, w)| {
            (lost(*w) && observed.cofactor(&self.network, cofactors) > NEEDED).then_some(Item::Additional(*observed))
        }));
        Ok(needed)
    }
}

/// Square root of the factor on the weight of an observation whose error is t standard errors, at the scale s.
fn weight(kind: Robust, t: f64, s: f64, outside: bool) -> f64 {
    if outside { least(t) } else { factor(kind, t / s).sqrt().max(least(t)) }
}

/// The scale of weights and decisions: unless asked never below that of the a priori standard errors.
fn at_least(choice: RobustScale, s: f64) -> f64 {
    match choice {
        RobustScale::AtLeastPrior => s.max(1.0),
        RobustScale::Estimated => s,
    }
}
