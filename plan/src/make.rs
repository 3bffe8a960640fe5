//! A plan from nothing: photos are added where they help most until the precision is reached, then taken away and exchanged for
//! others as long as fewer do.
//!
//! V. V. Fedorov, Theory of Optimal Experiments, 1972: exchange of single observations. Which photos are worth an exact look is
//! told by the half axes with held orientations ([`super::candidates::Held`]).

use crate::reason::PlanReason;
use serde::{Deserialize, Serialize};

use super::candidates::{Held, LEAST_SEEN, candidates};
use super::judgement::{factor, is_determined, value};
use super::setup::{Setup, Shot};
use super::{Criterion, Prediction, Progress, judged};
use sightline::error::{Error, Place, Result};
use sightline::project::{Plan, PlanStation};

/// Photos that could be taken.
const POOL: usize = 240;
/// Of them, those that are judged exactly when one is added or exchanged.
const ADDED: usize = 24;
const EXCHANGED: usize = 8;
/// Points that a photo shares with the others at least, so that one hangs together with the next; fewer where none shares as many.
const SHARED: [usize; 3] = [5, 4, 3];
/// Photos that may be added without any gain before the search ends.
const PATIENCE: usize = 6;
/// Rounds of exchange with one number of photos.
const ROUNDS: usize = 4;
/// Work that may be spent, in rays times photos judged: about eight seconds in a worker.
const WORK: f64 = 3.0e7;
/// Maximum number of photos of a plan.
const MOST: usize = 60;

/// How a plan is made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct MakeOptions {
    /// Maximum number of photos.
    pub most: usize,
}

impl Default for MakeOptions {
    fn default() -> Self {
        Self { most: 40 }
    }
}

/// A plan that was made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Made {
    /// Its photos; those of the plan that are taken already come first.
    pub stations: Vec<PlanStation>,
    /// Their prediction.
    pub prediction: Prediction,
    /// How many sets of photos were judged.
    pub compared: usize,
    /// Why the search ended.
    #[serde(default)]
    pub ended: Ended,
}

/// Why a search for a plan ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "why", rename_all = "snake_case")]
pub enum Ended {
    /// The plan reaches what is wanted.
    #[default]
    Reached,
    /// It has as many photos as it may have.
    MostPhotos {
        /// How many that are.
        most: usize,
    },
    /// No further photo makes it better: the limit is the object, the camera, or where photos can be taken.
    NoGain {
        /// Photos that were added without any gain.
        tried: usize,
    },
    /// No other place shows enough points of the plan.
    NoPlace,
    /// The search has spent the time it may take.
    Time,
}

/// The search with what it has spent.
struct Search<'a> {
    setup: &'a Setup<'a>,
    pool: Vec<Shot>,
    /// Photos that are taken already.
    taken: Vec<Shot>,
    /// Required largest semi-axis.
    goal: f64,
    work: f64,
    compared: usize,
}

impl Search<'_> {
    fn shots(&self, chosen: &[usize]) -> Vec<&Shot> {
        self.taken.iter().chain(chosen.iter().map(|k| &self.pool[*k])).collect()
    }

    fn judge(&mut self, chosen: &[usize]) -> f64 {
        let shots = self.shots(chosen);
        let rays: usize = shots.iter().map(|shot| shot.seen.len()).sum();
        let work = (rays * shots.len()) as f64 + 2000.0;
        let value = value(self.setup, &shots, &Criterion::Worst);
        self.work += work;
        self.compared += 1;
        value
    }

    fn spent(&self) -> bool {
        self.work > WORK
    }

    /// The photos of the pool that help most with held orientations.
    fn promising(&self, chosen: &[usize], count: usize) -> Vec<usize> {
        let held = Held::new(self.setup, &self.shots(chosen));
        let free = self.tied(chosen);
        let mut ranked: Vec<(f64, usize)> =
            free.into_iter().map(|k| (held.with(self.setup, &self.pool[k], &self.setup.given), k)).collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        ranked.into_iter().take(count).map(|(_, k)| k).collect()
    }

    /// The photos of the pool that share enough points with those chosen to be oriented with them; all where control points tie them,
    /// and where none does.
    fn tied(&self, chosen: &[usize]) -> Vec<usize> {
        let shots = self.shots(chosen);
        let free: Vec<usize> = (0..self.pool.len()).filter(|k| !chosen.contains(k)).collect();
        if shots.is_empty() || self.setup.given.iter().filter(|given| **given).count() >= 3 {
            return free;
        }
        let mut known = vec![false; self.setup.places.len()];
        shots.iter().flat_map(|shot| &shot.seen).for_each(|(k, _)| known[*k] = true);
        let shared = |k: &usize| self.pool[*k].seen.iter().filter(|(point, _)| known[*point]).count();
        let tied = SHARED.map(|least| free.iter().copied().filter(|k| shared(k) >= least).collect::<Vec<_>>());
        tied.into_iter().find(|tied| !tied.is_empty()).unwrap_or(free)
    }

    /// How much a photo's attitude differs from that of the chosen photo which is most like it, radians; roll counts like direction.
    fn variety(&self, chosen: &[usize], other: usize) -> f64 {
        let own = &self.pool[other].pose.object_to_camera;
        let shots = self.shots(chosen);
        let turns = shots.iter().map(|shot| {
            let turn = own * shot.pose.object_to_camera.transpose();
            (0.5 * (turn.trace() - 1.0)).clamp(-1.0, 1.0).acos()
        });
        turns.fold(f64::INFINITY, f64::min)
    }

    /// Exchanges single photos until the goal is reached or nothing gets better.
    fn exchange(&mut self, chosen: &mut [usize], mut best: f64) -> f64 {
        for _ in 0..ROUNDS {
            let before = best;
            for place in 0..chosen.len() {
                if best <= self.goal || self.spent() {
                    return best;
                }
                let mut others = chosen.to_vec();
                others.remove(place);
                for other in self.promising(&others, EXCHANGED) {
                    let mut trial = chosen.to_vec();
                    trial[place] = other;
                    let value = self.judge(&trial);
                    if value < best {
                        best = value;
                        chosen[place] = other;
                    }
                }
            }
            if best > 0.998 * before {
                break;
            }
        }
        best
    }
}

/// Makes a plan of few photos with which every point reaches what is wanted, or comes as near to it as `most` photos do.
///
/// # Errors
/// As [`super::predict`]; [`Error::Invalid`] if no photo sees four points; [`Error::Cancelled`].
pub fn make(plan: &Plan, options: &MakeOptions, progress: Progress) -> Result<Made> {
    let setup = Setup::new(plan)?;
    let pool = candidates(&setup, POOL, LEAST_SEEN);
    if pool.is_empty() {
        return Err(Error::Invalid { reason: PlanReason::PlanNothingSeen.into(), at: Place::field("cameras") });
    }
    let taken = plan.stations.iter().filter(|station| station.taken).map(|station| setup.shot(station));
    let taken = taken.collect::<Result<Vec<_>>>()?;
    let goal = plan.wanted.precision / factor(plan.wanted.probability);
    let mut search = Search { setup: &setup, pool, taken, goal, work: 0.0, compared: 0 };
    let most = options.most.clamp(2, MOST);
    let mut chosen: Vec<usize> = Vec::new();
    let mut best = search.judge(&chosen);
    let (mut least, mut of) = (best, 0);
    let mut ended = Ended::MostPhotos { most };
    while best > goal && chosen.len() < most && !search.spent() {
        if !progress(chosen.len(), 2 * most) {
            return Err(Error::Cancelled);
        }
        // A single photo is nothing yet to be judged exactly.
        let alone = chosen.len() + search.taken.len() == 0;
        let mut promising = search.promising(&chosen, if alone { 1 } else { ADDED });
        if !alone && !is_determined(best) {
            // Photos that tie others together are not those that help single points most.
            let step = (search.pool.len() / ADDED).max(1);
            promising.extend(search.tied(&chosen).into_iter().step_by(step));
        }
        // A network that is not determined has the same value whatever is added: then the photo that differs most from the others, in
        // direction or roll, is what determines a camera.
        let mut added: Option<(f64, f64, usize)> = None;
        for other in promising {
            let mut trial = chosen.clone();
            trial.push(other);
            let (value, variety) = (search.judge(&trial), search.variety(&chosen, other));
            if added.is_none_or(|(least, most, _)| value < least || value == least && variety > most) {
                added = Some((value, variety, other));
            }
        }
        let Some((value, _, other)) = added else {
            ended = Ended::NoPlace;
            break;
        };
        chosen.push(other);
        best = value;
        if best < least {
            (least, of) = (best, chosen.len());
        } else if chosen.len() >= of + PATIENCE {
            ended = Ended::NoGain { tried: PATIENCE };
            break;
        }
    }
    if search.spent() && matches!(ended, Ended::MostPhotos { .. }) && chosen.len() < most {
        ended = Ended::Time;
    }
    // A question without an improvement at the end is not shown.
    if best > goal && of > 0 {
        chosen.truncate(of);
        best = least;
    }
    // Fewer: without the photo that is missed least, the others exchanged.
    let reached = best <= goal;
    while reached && chosen.len() + search.taken.len() > 2 && !search.spent() {
        if !progress(2 * most - chosen.len(), 2 * most) {
            return Err(Error::Cancelled);
        }
        let mut without: Vec<(f64, Vec<usize>)> = Vec::new();
        for place in 0..chosen.len() {
            let mut trial = chosen.clone();
            trial.remove(place);
            without.push((search.judge(&trial), trial));
        }
        without.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut found = None;
        for (value, mut trial) in without.into_iter().take(3) {
            if search.exchange(&mut trial, value) <= goal {
                found = Some(trial);
                break;
            }
            if search.spent() {
                break;
            }
        }
        match found {
            Some(fewer) => chosen = fewer,
            None => break,
        }
    }
    if !reached && !search.spent() {
        search.exchange(&mut chosen, best);
    }
    let mut shots: Vec<Shot> = search.shots(&chosen).into_iter().cloned().collect();
    name(&mut shots, search.taken.len());
    let prediction = judged(&setup, &shots);
    let stations = shots.into_iter().map(|shot| shot.station).collect();
    let ended = if prediction.reached { Ended::Reached } else { ended };
    Ok(Made { stations, prediction, compared: search.compared, ended })
}

/// Numbers for the new photos, in the order of their directions, so that one walks around the object once.
fn name(shots: &mut [Shot], taken: usize) {
    let (old, new) = shots.split_at_mut(taken);
    let around = |shot: &Shot| {
        let look = shot.pose.object_to_camera.row(2);
        look[1].atan2(look[0])
    };
    new.sort_by(|a, b| around(a).total_cmp(&around(b)).then(a.station.roll.total_cmp(&b.station.roll)));
    let mut next = 1;
    for shot in new {
        while old.iter().any(|other| other.station.id == next.to_string()) {
            next += 1;
        }
        shot.station.id = next.to_string();
        next += 1;
    }
}
