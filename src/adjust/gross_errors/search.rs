//! The search for gross errors: data snooping ([`super::snooping`]) and robust weights ([`super::robust`]) over observations
//! of every kind, and the record that it leaves.

use crate::adjust::equations::collinearity::Weighting;
use crate::adjust::equations::right_hand_side;
use crate::adjust::problem::additional::{self, LeftOut, Observed};
use crate::adjust::problem::network::Network;
use crate::adjust::solve::session::{Log, Session, unsound};
use crate::adjustment::{AdjustOptions, Given, GrossError, GrossErrorAction, Robust, StatisticsChoice, Termination};
use crate::error::Result;

use super::robust::{factor, prediction, reweight, scale};
use super::snooping::{Decision, Item, TESTABLE, Tests, VANISHING, consequences, decide, items};

/// Rounds of a search for gross errors.
const MOST_ROUNDS: usize = 500;
/// Robust weights that change less are settled.
const SETTLED: f64 = 1e-6;

impl Session<'_> {
    fn residuals(&self, options: &AdjustOptions) -> Result<Vec<[f64; 2]>> {
        let weighting = Weighting { place: options.residuals, robust: &[], shift: &self.shift };
        right_hand_side::weighted_residuals(&self.network, &self.state, weighting).ok_or_else(unsound)
    }

    /// An entry of the record; the caller completes what led to it.
    fn gross_error(&self, item: Item, action: GrossErrorAction, round: usize) -> GrossError {
        let (photo, point, given) = match item {
            Item::Ray(ray) => {
                let observation = &self.project.observations[self.network.rays[ray].row];
                (observation.photo.clone(), observation.point.clone(), None)
            }
            Item::Given(observed) => {
                let what = observed.key(&self.network).named(self.project);
                match &what {
                    Given::Control { point, .. } => (String::new(), point.clone(), Some(what)),
                    Given::Position { photo, .. } => (photo.clone(), String::new(), Some(what)),
                    Given::Parameter { photo, .. } => (photo.clone().unwrap_or_default(), String::new(), Some(what)),
                    Given::Distance { .. } => (String::new(), String::new(), Some(what)),
                }
            }
        };
        GrossError { photo, point, given, action, statistic: 0.0, limit: 0.0, round, consequence: false }
    }

    /// Data snooping from a converged state. Adds what is taken out to `left_out` and returns whether the search came to an
    /// end.
    ///
    /// # Errors
    /// As [`Self::iterate`].
    pub fn snoop(
        &mut self,
        options: &AdjustOptions,
        log: &mut Log<'_>,
        left_out: &mut LeftOut,
        record: &mut Vec<GrossError>,
    ) -> Result<bool> {
        let full = AdjustOptions { statistics: StatisticsChoice::Full, covariance_of: Vec::new(), ..options.clone() };
        let items = items(&self.network);
        let weight = |item: &Item, network: &Network| match item {
            Item::Ray(_) => 1.0,
            Item::Given(observed) => observed.weight(network),
        };
        let weights: Vec<f64> = items.iter().map(|item| weight(item, &self.network)).collect();
        let n = items.len();
        let (mut out, mut settled, mut restored) = (vec![false; n], vec![false; n], vec![0; n]);
        let all = self.redundancy;
        self.weights = vec![[1.0; 2]; self.network.rays.len()];
        let mut ended = false;
        for round in 1..=MOST_ROUNDS {
            let solution = self.finish(&full, false)?;
            let Some(cofactors) = &solution.cofactors else { break };
            let sigma0 = (solution.cost / self.redundancy.max(1) as f64).sqrt();
            let residuals = self.residuals(options)?;
            let tests: Vec<Tests> = (items.iter().zip(&weights))
                .map(|(item, weight)| match item {
                    Item::Ray(ray) => [0, 1].map(|s| Some((residuals[*ray][s], cofactors.rays[*ray][s]))),
                    Item::Given(observed) => {
                        let e = observed.residual(&self.network, &self.state) * weight;
                        [Some((e, observed.cofactor(&self.network, cofactors))), None]
                    }
                })
                .collect();
            match decide(&tests, &out, &settled, self.redundancy, sigma0) {
                Decision::Done => {
                    ended = true;
                    break;
                }
                Decision::Remove { item, statistic, limit } => {
                    let Some(together) = consequences(&self.network, &items, &out, item) else {
                        settled[item] = true;
                        continue;
                    };
                    for at in together {
                        out[at] = true;
                        self.weigh(items[at], weights[at], VANISHING);
                        let entry = self.gross_error(items[at], GrossErrorAction::Removed, round);
                        record.push(GrossError { statistic, limit, consequence: at != item, ..entry });
                    }
                }
                Decision::Restore { item, statistic, limit } => {
                    out[item] = false;
                    restored[item] += 1;
                    // What comes back a second time stays.
                    settled[item] = restored[item] > 1;
                    self.weigh(items[item], weights[item], 1.0);
                    let entry = self.gross_error(items[item], GrossErrorAction::Restored, round);
                    record.push(GrossError { statistic, limit, ..entry });
                }
            }
            let lost = |(item, _): (&Item, _)| if matches!(item, Item::Ray(_)) { 2 } else { 1 };
            self.redundancy = all.saturating_sub(items.iter().zip(&out).filter(|(_, o)| **o).map(lost).sum());
            if self.iterate(options, log)? != Termination::Converged {
                break;
            }
        }
        self.redundancy = all;
        for (item, _) in items.iter().zip(&out).filter(|(_, out)| **out) {
            match item {
                Item::Ray(ray) => left_out.observations[self.network.rays[*ray].row] = true,
                Item::Given(observed) => left_out.given.push(observed.key(&self.network)),
            }
        }
        (items.iter().zip(&weights)).for_each(|(item, weight)| self.weigh(*item, *weight, 1.0));
        self.weights = Vec::new();
        Ok(ended)
    }

    /// Sets the factor on the square root of an observation's own weight.
    fn weigh(&mut self, item: Item, weight: f64, factor: f64) {
        match item {
            Item::Ray(ray) => self.weights[ray] = [factor; 2],
            Item::Given(observed) => observed.set_weight(&mut self.network, weight * factor),
        }
    }

    /// Robust weights from a converged state; returns whether they settled.
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
        self.weights = vec![[1.0; 2]; self.network.rays.len()];
        let given = additional::all(&self.network);
        let weights: Vec<f64> = given.iter().map(|observed| observed.weight(&self.network)).collect();
        self.given_factors = vec![1.0; given.len()];
        let mut settled = false;
        let stages: &[Robust] = if kind == Robust::Tukey { &[Robust::Huber, Robust::Tukey] } else { &[Robust::Huber] };
        let mut round = 0;
        'stages: for stage in stages {
            settled = false;
            let predicted = self.predictability(options, &given)?;
            for _ in 0..60 {
                round += 1;
                let residuals = self.residuals(options)?;
                let change = reweight(*stage, &residuals, &mut self.weights);
                if change.max(self.reweight_given(*stage, &given, &weights, &predicted, scale(&residuals))) < SETTLED {
                    settled = true;
                    break;
                }
                if self.iterate(options, log)? != Termination::Converged {
                    settled = false;
                    break 'stages;
                }
            }
        }
        let of_rays = self.weights.iter().enumerate().map(|(ray, w)| (Item::Ray(ray), w[0].min(w[1])));
        let of_given = given.iter().zip(&self.given_factors).map(|(observed, w)| (Item::Given(*observed), *w));
        for (item, factor) in of_rays.chain(of_given).map(|(item, w)| (item, w * w)).filter(|(_, f)| *f < 0.5) {
            let entry = self.gross_error(item, GrossErrorAction::Downweighted, round);
            record.push(GrossError { statistic: factor, limit: 0.5, ..entry });
        }
        Ok(settled)
    }

    /// Per given observation the cofactor by which the others predict it, in units of its own variance (infinite where they
    /// do not), and the mean redundancy number of the image coordinates.
    fn predictability(&mut self, options: &AdjustOptions, given: &[Observed]) -> Result<(Vec<f64>, f64)> {
        if given.is_empty() {
            return Ok((Vec::new(), 1.0));
        }
        let full = AdjustOptions { statistics: StatisticsChoice::Full, covariance_of: Vec::new(), ..options.clone() };
        let solution = self.finish(&full, false)?;
        let Some(cofactors) = &solution.cofactors else { return Ok((vec![f64::INFINITY; given.len()], 1.0)) };
        let of = |(observed, factor): (&Observed, &f64)| {
            let c = observed.cofactor(&self.network, cofactors);
            if c < 1.0 { c.max(0.0) / (factor * factor * (1.0 - c)) } else { f64::INFINITY }
        };
        let image: f64 = cofactors.rays.iter().flatten().map(|c| 1.0 - c).sum();
        let mean = image / (2 * cofactors.rays.len()).max(1) as f64;
        Ok((given.iter().zip(&self.given_factors).map(of).collect(), mean.clamp(TESTABLE, 1.0)))
    }

    /// Factors of the given observations from the errors with which the others predict them; their largest change.
    /// `scale` is that of the image residuals, whose mean redundancy number makes it one of standardised residuals.
    fn reweight_given(
        &mut self,
        kind: Robust,
        given: &[Observed],
        weights: &[f64],
        (predicted, mean): &(Vec<f64>, f64),
        scale: f64,
    ) -> f64 {
        let mut change = 0.0_f64;
        for (k, observed) in given.iter().enumerate() {
            let e = observed.residual(&self.network, &self.state) * weights[k];
            let Some(t) = prediction(e, self.given_factors[k].powi(2), predicted[k], TESTABLE) else { continue };
            // Never quite 0, so that it stays an observation with a residual.
            let new = factor(kind, t / (scale / mean.sqrt())).sqrt().max(VANISHING);
            change = change.max((new - self.given_factors[k]).abs());
            self.given_factors[k] = new;
            observed.set_weight(&mut self.network, weights[k] * new);
        }
        change
    }
}
