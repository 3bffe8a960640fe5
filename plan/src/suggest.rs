//! Where the next photo should be: every place that is tried is judged by the network's own equations, the best are moved and
//! turned until nothing gets better.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::candidates::{Frame, Held, LEAST_KNOWN, about, allowed, candidates, rolls};
use super::judgement::value;
use super::setup::{Setup, Shot};
use super::{Criterion, Progress};
use sightline::error::{Error, Result};
use sightline::project::{Plan, PlanStation};

/// Maximum number of photos that are tried, and how many of them are judged exactly where the network is large.
const MOST: usize = 900;
const JUDGED_OF_LARGE: usize = 150;
/// A network of more rays is large.
const LARGE: usize = 3000;
/// Points asked for that are examined by themselves.
const ASKED: usize = 3;
/// So many of the best are moved.
const MOVED: usize = 4;
/// Steps: angle in radians, share of the distance, share of the object's radius.
const STEPS: [[f64; 3]; 4] = [[0.16, 0.14, 0.25], [0.08, 0.07, 0.12], [0.04, 0.035, 0.06], [0.02, 0.018, 0.03]];
/// Number of suggestions returned.
const TOLD: usize = 5;

/// A suggested photo.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Suggested {
    /// Where; its identifier is the next free number.
    pub station: PlanStation,
    /// The criterion with it; null if it leaves points undetermined.
    pub value: Option<f64>,
    /// Points it sees.
    pub sees: usize,
    /// How many places were compared.
    pub compared: usize,
}

/// The best places for the next photo, the best first.
///
/// # Errors
/// As [`super::predict`]; [`Error::Cancelled`].
pub fn suggest(plan: &Plan, criterion: &Criterion, progress: Progress) -> Result<Vec<Suggested>> {
    let setup = Setup::new(plan)?;
    let present = plan.stations.iter().map(|station| setup.shot(station)).collect::<Result<Vec<_>>>()?;
    let now: Vec<&Shot> = present.iter().collect();
    let mut tried = candidates(&setup, MOST, LEAST_KNOWN);
    if let Criterion::Points { points } = criterion {
        // What shows them best may be none of the photos that show as much as possible.
        let asked = points.iter().filter_map(|id| setup.index.get(id.as_str())).take(ASKED);
        tried.extend(asked.flat_map(|k| about(&setup, setup.places[*k], LEAST_KNOWN)));
    }
    let rays: usize = now.iter().map(|shot| shot.seen.len()).sum();
    if rays > LARGE && tried.len() > JUDGED_OF_LARGE {
        let held = Held::new(&setup, &now);
        let ordered = |shots: Vec<Shot>, given: &[bool]| {
            let mut all: Vec<(f64, Shot)> = shots.into_iter().map(|s| (held.with(&setup, &s, given), s)).collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0));
            all.into_iter().map(|(_, shot)| shot).collect::<Vec<_>>()
        };
        // What is good for the points that are asked for, and what is good for all of them.
        let own = not_asked(&setup, criterion);
        let mut first = Vec::new();
        if own != setup.given {
            first = ordered(tried, &own);
            tried = first.split_off(JUDGED_OF_LARGE / 2);
        }
        first.extend(ordered(tried, &setup.given));
        first.truncate(JUDGED_OF_LARGE);
        tried = first;
    }
    let judge = |shot: &Shot| {
        let with: Vec<&Shot> = now.iter().copied().chain([shot]).collect();
        value(&setup, &with, criterion)
    };
    let total = tried.len() + MOVED * 40;
    let mut compared = tried.len();
    let mut ranked = Vec::with_capacity(tried.len());
    for (k, shot) in tried.into_iter().enumerate() {
        if !progress(k, total) {
            return Err(Error::Cancelled);
        }
        ranked.push((judge(&shot), shot));
    }
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let frame = Frame::of(&setup);
    let mut best: Vec<(f64, Shot)> = Vec::new();
    for (k, (own, shot)) in distinct(ranked, frame.radius).into_iter().take(TOLD + MOVED).enumerate() {
        if k < MOVED {
            let (moved, more) = improved(&setup, &frame, own, shot, &judge);
            compared += more;
            best.push(moved);
            if !progress(total - (MOVED - k) * 40, total) {
                return Err(Error::Cancelled);
            }
        } else {
            best.push((own, shot));
        }
    }
    best.sort_by(|a, b| a.0.total_cmp(&b.0));
    let id = next_id(plan);
    let told = distinct(best, frame.radius).into_iter().take(TOLD).map(|(value, shot)| Suggested {
        station: PlanStation { id: id.clone(), ..shot.station },
        value: super::judgement::is_determined(value).then_some(value),
        sees: shot.seen.len(),
        compared,
    });
    Ok(told.collect())
}

/// Points that a criterion does not ask for.
fn not_asked(setup: &Setup<'_>, criterion: &Criterion) -> Vec<bool> {
    let Criterion::Points { points } = criterion else { return setup.given.clone() };
    let mut out = vec![true; setup.given.len()];
    for place in points.iter().filter_map(|id| setup.index.get(id.as_str())) {
        out[*place] = setup.given[*place];
    }
    out
}

/// The next number that no station has.
pub fn next_id(plan: &Plan) -> String {
    let free = |n: &usize| !plan.stations.iter().any(|s| s.id == n.to_string());
    (plan.stations.len() + 1..).find(free).unwrap_or(1).to_string()
}

/// Without those that stand where a better one does.
fn distinct(ranked: Vec<(f64, Shot)>, radius: f64) -> Vec<(f64, Shot)> {
    let mut kept: Vec<(f64, Shot)> = Vec::new();
    for (value, shot) in ranked {
        let near = |other: &Shot| {
            (shot.pose.centre - other.pose.centre).norm() < 0.3 * radius
                && (shot.station.roll - other.station.roll).abs() < 0.1
        };
        if kept.len() < TOLD + MOVED && !kept.iter().any(|(_, other)| near(other)) {
            kept.push((value, shot));
        }
    }
    kept
}

/// Pattern search over place, aim and roll with shrinking steps; also how many places it judged.
pub fn improved(
    setup: &Setup<'_>,
    frame: &Frame,
    own: f64,
    shot: Shot,
    judge: &dyn Fn(&Shot) -> f64,
) -> ((f64, Shot), usize) {
    let (mut best, mut compared) = ((own, shot), 0);
    for [angle, share, shift] in STEPS {
        for _ in 0..3 {
            let before = best.0;
            for trial in neighbours(setup, frame, &best.1, angle, share, shift) {
                compared += 1;
                let value = judge(&trial);
                if value < best.0 {
                    best = (value, trial);
                }
            }
            if best.0 > 0.999 * before {
                break;
            }
        }
    }
    (best, compared)
}

/// Photos a step away.
fn neighbours(setup: &Setup<'_>, frame: &Frame, shot: &Shot, angle: f64, share: f64, shift: f64) -> Vec<Shot> {
    let aim = Vector3::from(shot.station.look_at.unwrap_or(frame.centre.into()));
    let out = shot.pose.centre - aim;
    let rows = shot.pose.object_to_camera;
    let [right, up]: [Vector3<f64>; 2] = [rows.row(0).transpose(), rows.row(1).transpose()];
    let roll = shot.station.roll;
    let mut places: Vec<(Vector3<f64>, Vector3<f64>, f64)> = Vec::new();
    for sign in [-1.0, 1.0] {
        for side in [right, up] {
            let turned = (out + sign * angle * out.norm() * side).normalize() * out.norm();
            places.push((aim + turned, aim, roll));
            let moved = sign * shift * frame.radius * side;
            places.push((shot.pose.centre, aim + moved, roll));
            places.push((shot.pose.centre + moved, aim + moved, roll));
        }
        places.push((aim + out * (1.0 + sign * share), aim, roll));
    }
    places.extend(rolls(setup).iter().filter(|r| (**r - roll).abs() > 0.1).map(|r| (shot.pose.centre, aim, *r)));
    places.into_iter().filter_map(|(position, aim, roll)| allowed(setup, position, aim, roll, LEAST_KNOWN)).collect()
}
