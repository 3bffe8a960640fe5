//! The search for gross errors by data snooping ([`super::snooping`]) over observations of every kind, and the record that it
//! leaves.
//!
//! It begins at a robust start ([`super::start`]): its outliers are rejected at once, the largest first, and then one
//! observation a round goes or comes back. Nothing is taken out that the network cannot do without: such an observation is
//! kept and named.

use crate::adjust::equations::right_hand_side;
use crate::adjust::problem::additional;
use crate::adjust::problem::left_out::RejectedObservations;
use crate::adjust::problem::network::Network;
use crate::adjust::problem::state::State;
use crate::adjust::solve::session::{Log, Session, unsound};
use crate::adjust::statistics::cofactors::Cofactors;
use crate::adjustment::{AdjustOptions, Advice, Given, GrossError, GrossErrorAction, StatisticsChoice, Termination};
use crate::error::Result;
use crate::project::Project;
use crate::statistics::distribution::critical_t;

use super::robust::{predicting, prediction, scale};
use super::snooping::{Decision, Item, TESTABLE, Tests, consequences, decide, items, vanishing};

/// Rounds of a search for gross errors.
const MOST_ROUNDS: usize = 500;
/// What has hardly any weight and still fixes more than this part of its own adjusted value is needed.
const NEEDED: f64 = 0.5;
/// More than this part of all observations is not taken out at once: then it is not single observations that are wrong.
const MOST_AT_ONCE: f64 = 0.3;

/// State of the search.
struct GrossErrorSearch {
    items: Vec<Item>,
    /// Reciprocal standard errors of additional observations, 1 for rays.
    own: Vec<f64>,
    /// Square root of the weight of what is taken out.
    out: Vec<Option<f64>>,
    /// Not to be taken out any more.
    settled: Vec<bool>,
    restored: Vec<usize>,
    /// Redundancy with everything in.
    all: usize,
    round: usize,
}

impl GrossErrorSearch {
    fn redundancy(&self) -> usize {
        let lost = |(item, _): (&Item, _)| if matches!(item, Item::Ray(_)) { 2 } else { 1 };
        self.all.saturating_sub(self.items.iter().zip(&self.out).filter(|(_, out)| out.is_some()).map(lost).sum())
    }
}

impl Session<'_> {
    /// Weighted residuals of the image coordinates, without robust factors.
    ///
    /// # Errors
    /// [`crate::Error::Invalid`] if a point has no image.
    pub fn residuals(&self, options: &AdjustOptions) -> Result<Vec<[f64; 2]>> {
        right_hand_side::weighted_residuals(self.context(options.residuals)).ok_or_else(unsound)
    }

    /// An entry of the record; the caller completes what led to it.
    pub fn gross_error(&self, item: Item, action: GrossErrorAction, round: usize) -> GrossError {
        let (photo, point, given) = match item {
            Item::Ray(ray) => {
                let observation = &self.project.observations[self.network.rays[ray].row];
                (observation.photo.clone(), observation.point.clone(), None)
            }
            Item::Additional(observed) => {
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

    /// Data snooping from a robust start. Adds what is taken out to `left_out` and returns whether the search came to an
    /// end. The session keeps the values and gives every observation its own weight again.
    ///
    /// # Errors
    /// [`crate::Error::RankDefect`] of the network as it is, with every observation in.
    pub fn snoop(
        &mut self,
        options: &AdjustOptions,
        log: &mut Log<'_>,
        left_out: &mut RejectedObservations,
        record: &mut Vec<GrossError>,
    ) -> Result<bool> {
        let (out, ended) = self.searched(options, log, record)?;
        for item in out {
            match item {
                Item::Ray(ray) => left_out.observations[self.network.rays[ray].row] = true,
                Item::Additional(observed) => left_out.given.push(observed.key(&self.network)),
            }
        }
        Ok(ended)
    }

    /// Observations rejected by data snooping, as the start of robust weights; none if it does not converge. The session keeps
    /// its weights, and the values of the solution without these.
    pub fn standing_out(&mut self, options: &AdjustOptions, log: &mut Log<'_>) -> Vec<Item> {
        let (state, weights, factors) = (self.state.clone(), self.weights.clone(), self.additional_factors.clone());
        let given = additional::all(&self.network);
        let own: Vec<f64> = given.iter().map(|observed| observed.sqrt_weight(&self.network)).collect();
        let found = self.searched(options, log, &mut Vec::new());
        (self.weights, self.additional_factors) = (weights, factors);
        for (observed, own) in given.iter().zip(own) {
            observed.set_sqrt_weight(&mut self.network, own);
        }
        match found {
            Ok((out, true)) => out,
            _ => {
                self.state = state;
                Vec::new()
            }
        }
    }

    /// Observations rejected by the search, and whether it converged; the weights are restored.
    fn searched(
        &mut self,
        options: &AdjustOptions,
        log: &mut Log<'_>,
        record: &mut Vec<GrossError>,
    ) -> Result<(Vec<Item>, bool)> {
        let mut search = self.search();
        let redundancy = search.all;
        let result = self.search_from_start(options, log, &mut search, record);
        self.redundancy = redundancy;
        let ended = result?;
        let back: Vec<(Item, f64)> = search.items.iter().copied().zip(search.own.iter().copied()).collect();
        back.into_iter().for_each(|(item, own)| self.weigh(item, own, 1.0));
        self.weights = Vec::new();
        self.additional_factors = Vec::new();
        let out = search.items.iter().zip(&search.out).filter(|(_, out)| out.is_some()).map(|(item, _)| *item);
        Ok((out.collect(), ended))
    }

    fn search_from_start(
        &mut self,
        options: &AdjustOptions,
        log: &mut Log<'_>,
        search: &mut GrossErrorSearch,
        record: &mut Vec<GrossError>,
    ) -> Result<bool> {
        let first = self.stand_out(options, search)?;
        let ended = self.take_out_at_once(options, log, search, first, record)?;
        Ok(ended && self.one_at_a_time(options, log, search, record)?)
    }

    /// Observations and others that stand out of a robust start, with their statistics, the largest first; none where it comes to no
    /// rest. For an adjustment that finds no way because of them.
    pub fn suspects(&mut self, options: &AdjustOptions, log: &mut Log<'_>) -> Vec<(Item, f64)> {
        if !self.robust_start(options, log).is_ok_and(|t| t == Termination::Converged) {
            return Vec::new();
        }
        let search = self.search();
        let found = self.stand_out(options, &search).unwrap_or_default();
        found.into_iter().map(|(item, statistic, _)| (search.items[item], statistic)).collect()
    }

    /// A search that has found nothing yet, after a robust start.
    fn search(&self) -> GrossErrorSearch {
        let items = items(&self.network);
        // The start's factors are in the weights of additional observations.
        let mut factors = self.additional_factors.iter();
        let own = items.iter().map(|item| match item {
            Item::Ray(_) => 1.0,
            Item::Additional(observed) => observed.sqrt_weight(&self.network) / factors.next().unwrap_or(&1.0),
        });
        let own: Vec<f64> = own.collect();
        let n = items.len();
        GrossErrorSearch {
            items,
            own,
            out: vec![None; n],
            settled: vec![false; n],
            restored: vec![0; n],
            all: self.redundancy,
            round: 1,
        }
    }

    /// Outliers of the robust start, the largest statistic first, from the error of the prediction by all others.
    fn stand_out(&mut self, options: &AdjustOptions, search: &GrossErrorSearch) -> Result<Vec<(usize, f64, f64)>> {
        let Some(limit) = critical_t(search.all) else { return Ok(Vec::new()) };
        let weights = self.weights.clone();
        let solution = self.finish(&full(options), false)?;
        let Some(cofactors) = &solution.cofactors else { return Ok(Vec::new()) };
        let residuals = self.residuals(options)?;
        let mut given = 0;
        let statistics: Vec<f64> = (search.items.iter().zip(&search.own))
            .map(|(item, own)| {
                let one = |e: f64, c: f64, factor: f64| {
                    let p = factor * factor;
                    prediction(e, p, predicting(c, p), TESTABLE).map_or(0.0, f64::abs)
                };
                match item {
                    Item::Ray(ray) => {
                        let factor = |s: usize| weights.get(*ray).map_or(1.0, |w| w[s]);
                        let side = |s: usize| one(residuals[*ray][s], cofactors.rays[*ray][s], factor(s));
                        side(0).max(side(1))
                    }
                    Item::Additional(observed) => {
                        let factor = self.additional_factors.get(given).copied().unwrap_or(1.0);
                        given += 1;
                        let e = observed.residual(&self.network, &self.state) * own;
                        one(e, observed.cofactor(&self.network, cofactors), factor)
                    }
                }
            })
            .collect();
        // Of a ray the larger of two: the scale is that of single coordinates.
        let coordinates: Vec<f64> = (residuals.iter().zip(&cofactors.rays).enumerate())
            .flat_map(|(ray, (e, c))| {
                let p = weights.get(ray).map_or([1.0; 2], |w| w.map(|w| w * w));
                [0, 1].map(|s| prediction(e[s], p[s], predicting(c[s], p[s]), TESTABLE))
            })
            .flatten()
            .collect();
        let s = scale(&coordinates);
        let mut found: Vec<(usize, f64, f64)> = (statistics.iter().enumerate())
            .map(|(item, t)| (item, t / s, limit))
            .filter(|(_, t, _)| *t > limit && t.is_finite())
            .collect();
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        if found.len() as f64 > MOST_AT_ONCE * search.items.len() as f64 {
            found.clear();
        }
        Ok(found)
    }

    /// Takes the first ones out and gives all others their own weight; where that leads to no solution nothing is out.
    /// Returns false if not even that does.
    fn take_out_at_once(
        &mut self,
        options: &AdjustOptions,
        log: &mut Log<'_>,
        search: &mut GrossErrorSearch,
        first: Vec<(usize, f64, f64)>,
        record: &mut Vec<GrossError>,
    ) -> Result<bool> {
        let start = self.state.clone();
        self.weights = vec![[1.0; 2]; self.network.rays.len()];
        self.additional_factors = Vec::new();
        for item in 0..search.items.len() {
            self.weigh(search.items[item], search.own[item], 1.0);
        }
        for (item, statistic, limit) in first {
            if search.out[item].is_none() {
                self.take_out(search, item, (statistic, limit), record);
            }
        }
        self.redundancy = search.redundancy();
        let none = search.out.iter().all(Option::is_none);
        match self.iterate(options, log) {
            Ok(Termination::Converged) => return Ok(true),
            Ok(Termination::Stopped) => return Ok(false),
            result if none => return result.map(|_| false),
            _ => {}
        }
        for item in 0..search.items.len() {
            search.out[item] = None;
            self.weigh(search.items[item], search.own[item], 1.0);
        }
        record.clear();
        self.state = start;
        self.redundancy = search.all;
        Ok(self.iterate(options, log)? == Termination::Converged)
    }

    /// Takes an item out with what goes with it; false if a photo would keep too little.
    fn take_out(
        &mut self,
        search: &mut GrossErrorSearch,
        item: usize,
        (statistic, limit): (f64, f64),
        record: &mut Vec<GrossError>,
    ) -> bool {
        let Some(together) = consequences(&self.network, &search.items, &search.out, item) else {
            self.keep(search, item, (statistic, limit), record);
            return false;
        };
        for at in together {
            let vanishing = vanishing(statistic);
            search.out[at] = Some(vanishing);
            self.weigh(search.items[at], search.own[at], vanishing);
            let entry = self.gross_error(search.items[at], GrossErrorAction::Removed, search.round);
            record.push(GrossError { statistic, limit, consequence: at != item, ..entry });
        }
        true
    }

    /// Names an item that the network cannot do without.
    fn keep(
        &mut self,
        search: &mut GrossErrorSearch,
        item: usize,
        (statistic, limit): (f64, f64),
        record: &mut Vec<GrossError>,
    ) {
        search.settled[item] = true;
        search.out[item] = None;
        self.weigh(search.items[item], search.own[item], 1.0);
        let entry = self.gross_error(search.items[item], GrossErrorAction::Kept, search.round);
        record.push(GrossError { statistic, limit, ..entry });
    }

    /// Rounds of one decision each; returns whether they came to an end.
    fn one_at_a_time(
        &mut self,
        options: &AdjustOptions,
        log: &mut Log<'_>,
        search: &mut GrossErrorSearch,
        record: &mut Vec<GrossError>,
    ) -> Result<bool> {
        for round in 1..=MOST_ROUNDS {
            search.round = round;
            let solution = self.finish(&full(options), false)?;
            let Some(cofactors) = &solution.cofactors else { return Ok(false) };
            let tests = self.tests(options, search, cofactors)?;
            // What is out adds what little weight it has.
            let squares = |(tests, out): (&Tests, &Option<f64>)| {
                out.map_or(0.0, |factor| tests.iter().flatten().map(|(e, _)| (e * factor).powi(2)).sum())
            };
            let outside: f64 = tests.iter().zip(&search.out).map(squares).sum();
            let sigma0 = ((solution.cost - outside).max(0.0) / self.redundancy.max(1) as f64).sqrt();
            let needed = (0..tests.len())
                .filter(|k| search.out[*k].is_some() && !lost_with_its_point(&self.network, search, *k));
            let needed = needed.filter(|k| tests[*k].iter().flatten().any(|(_, c)| *c > NEEDED)).min_by(|a, b| {
                let size = |k: usize| tests[k].iter().flatten().map(|(e, _)| e.abs()).fold(0.0, f64::max);
                size(*a).total_cmp(&size(*b))
            });
            let before: (State, Vec<Option<f64>>, usize) = (self.state.clone(), search.out.clone(), record.len());
            let mut changed = None;
            if let Some(item) = needed {
                self.keep(search, item, (0.0, 0.0), record);
            } else {
                match decide(&tests, &search.out, &search.settled, self.redundancy, sigma0) {
                    Decision::Done => return Ok(true),
                    Decision::Remove { item, statistic, limit } => {
                        if !self.take_out(search, item, (statistic, limit), record) {
                            continue;
                        }
                        changed = Some((item, statistic, limit));
                    }
                    Decision::Restore { item, statistic, limit } => {
                        search.out[item] = None;
                        search.restored[item] += 1;
                        // What comes back a second time stays.
                        search.settled[item] = search.restored[item] > 1;
                        self.weigh(search.items[item], search.own[item], 1.0);
                        let entry = self.gross_error(search.items[item], GrossErrorAction::Restored, round);
                        record.push(GrossError { statistic, limit, ..entry });
                    }
                }
            }
            self.redundancy = search.redundancy();
            match (self.iterate(options, log), changed) {
                (Ok(Termination::Converged), _) => {}
                (Ok(Termination::Stopped), _) | (_, None) => return Ok(false),
                (_, Some((item, statistic, limit))) => {
                    // Without it there is no solution: it is kept.
                    let (state, out, entries) = before;
                    (self.state, search.out) = (state, out);
                    record.truncate(entries);
                    for at in 0..search.items.len() {
                        self.weigh(search.items[at], search.own[at], search.out[at].unwrap_or(1.0));
                    }
                    self.keep(search, item, (statistic, limit), record);
                    self.redundancy = search.redundancy();
                }
            }
        }
        Ok(false)
    }

    fn tests(&self, options: &AdjustOptions, search: &GrossErrorSearch, cofactors: &Cofactors) -> Result<Vec<Tests>> {
        let residuals = self.residuals(options)?;
        let one = |(item, own): (&Item, &f64)| match item {
            Item::Ray(ray) => [0, 1].map(|s| Some((residuals[*ray][s], cofactors.rays[*ray][s]))),
            Item::Additional(observed) => {
                let e = observed.residual(&self.network, &self.state) * own;
                [Some((e, observed.cofactor(&self.network, cofactors))), None]
            }
        };
        Ok(search.items.iter().zip(&search.own).map(one).collect())
    }

    /// Sets the factor on the square root of an observation's own weight.
    fn weigh(&mut self, item: Item, own: f64, factor: f64) {
        match item {
            Item::Ray(ray) => self.weights[ray] = [factor; 2],
            Item::Additional(observed) => observed.set_sqrt_weight(&mut self.network, own * factor),
        }
    }

    /// The session without what the search took out. What the numbering of the rest does not allow comes back, last taken
    /// first, and is named.
    ///
    /// # Errors
    /// As [`Session::new`], with everything in.
    pub fn without_found(&self, left_out: &mut RejectedObservations, record: &mut Vec<GrossError>) -> Result<Self> {
        loop {
            match self.without(left_out) {
                Ok(session) => return Ok(session),
                Err(error) if left_out.is_empty() => return Err(error),
                Err(_) => {
                    let back = match left_out.given.pop() {
                        Some(key) => {
                            let mut items = items(&self.network).into_iter();
                            items.find(|item| matches!(item, Item::Additional(o) if o.key(&self.network) == key))
                        }
                        None => {
                            // The least of those that went last.
                            let out = |k: &usize| left_out.observations[self.network.rays[*k].row];
                            let place = |k: &usize| {
                                let o = &self.project.observations[self.network.rays[*k].row];
                                record.iter().rposition(|g| g.photo == o.photo && g.point == o.point)
                            };
                            let last = (0..self.network.rays.len()).filter(out).max_by_key(place);
                            last.map(|ray| {
                                left_out.observations[self.network.rays[ray].row] = false;
                                Item::Ray(ray)
                            })
                        }
                    };
                    if let Some(item) = back {
                        let round = record.last().map_or(1, |g| g.round);
                        record.push(self.gross_error(item, GrossErrorAction::Kept, round));
                    }
                }
            }
        }
    }
}

/// Advice about suspected observations; `None` without any.
pub fn suspicion(project: &Project, network: &Network, suspects: &[(Item, f64)]) -> Option<Advice> {
    let (mut observations, mut given) = (Vec::new(), Vec::new());
    for (item, statistic) in suspects {
        match item {
            Item::Ray(ray) => {
                let o = &project.observations[network.rays[*ray].row];
                observations.push((o.photo.clone(), o.point.clone(), *statistic));
            }
            Item::Additional(observed) => given.push((observed.key(network).named(project), *statistic)),
        }
    }
    observations.truncate(Advice::SUSPECTS);
    (!suspects.is_empty()).then_some(Advice::Suspected { count: suspects.len(), observations, given })
}

/// Whether all rays of the item's point are out: the point is gone, and nothing needs them.
fn lost_with_its_point(network: &Network, search: &GrossErrorSearch, item: usize) -> bool {
    let Item::Ray(ray) = search.items[item] else { return false };
    // Rays are numbered as in the network.
    let point = network.points.iter().find(|p| p.rays.contains(&ray));
    point.is_some_and(|p| p.rays.clone().all(|ray| search.out[ray].is_some()))
}

fn full(options: &AdjustOptions) -> AdjustOptions {
    AdjustOptions { statistics: StatisticsChoice::Full, covariance_of: Vec::new(), ..options.clone() }
}
