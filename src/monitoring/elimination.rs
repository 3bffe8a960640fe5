//! Finds moved reference points: the global test, repeated without the point that contributes most until it is accepted.

use nalgebra::Vector3;

use super::LEAST;
use super::congruence::Weights;
use super::judgement::judged;
use super::result::{EliminationStep, Test};
use super::system::differences;

/// A group is ruled out as another stable one only where it is rejected with an error probability of this times the significance: the
/// stable points themselves are rejected at that rate.
const DOUBTED: f64 = 0.02;
/// Groups that are tested beside the one found: those of eight points that are half of them or more.
const SEARCHED: f64 = 1000.0;

/// Result of the elimination.
pub struct Eliminated {
    /// Global test of all; `None` if all are held.
    pub first: Option<Test>,
    /// Steps.
    pub steps: Vec<EliminationStep>,
    /// Stable points; empty if there is no stable group.
    pub stable: Vec<usize>,
    /// Whether another group of as many points or more is congruent too, and which.
    pub other: Vec<usize>,
}

/// Reference points as they go in.
pub struct References<'a> {
    /// Identifiers of all points.
    pub ids: &'a [String],
    /// Earlier coordinates of all points.
    pub earlier: &'a [Vector3<f64>],
    /// Later ones.
    pub later: &'a [Vector3<f64>],
    /// Datum defect.
    pub defect: usize,
    /// Degrees of freedom of the variance factor.
    pub f: Option<f64>,
    /// Error probability.
    pub alpha: f64,
}

/// Runs the tests from the weights of all reference points.
pub fn eliminated(references: &References, all: &Weights) -> Eliminated {
    let test = |weights: &Weights| -> Option<(Test, Vec<Vector3<f64>>)> {
        let d = differences(references.earlier, references.later, &weights.points, references.defect)?;
        let judged = judged(weights.omega(&d), weights.rank, references.f, references.alpha);
        (weights.rank > 0).then_some((judged, d))
    };
    let mut result = Eliminated { first: None, steps: Vec::new(), stable: all.points.clone(), other: Vec::new() };
    let Some((mut current, mut d)) = test(all) else { return result };
    result.first = Some(current);
    let mut weights = all.clone();
    let mut removed = Vec::new();
    while !current.passed {
        let contributions = weights.contributions(&d);
        let largest = (0..contributions.len()).max_by(|&a, &b| contributions[a].total_cmp(&contributions[b]));
        let Some(k) = largest.filter(|_| weights.points.len() > LEAST) else {
            result.stable.clear();
            return result;
        };
        let point = weights.points[k];
        weights = weights.without(k);
        removed.push(point);
        let Some(next) = test(&weights) else {
            result.stable.clear();
            return result;
        };
        (current, d) = next;
        let id = references.ids[point].clone();
        result.steps.push(EliminationStep { removed: id, contribution: contributions[k], test: current });
    }
    result.stable = weights.points;
    if !removed.is_empty() {
        result.other = another(references, all, &result.stable, &removed).unwrap_or_default();
    }
    result
}

/// Another congruent group with a point that was removed: of all groups as large as the stable one, or one point smaller where that has
/// less than two thirds of the points; of too many for that, the removed points by themselves. The largest, then that of the smallest
/// statistic.
fn another(references: &References, all: &Weights, stable: &[usize], removed: &[usize]) -> Option<Vec<usize>> {
    let d = differences(references.earlier, references.later, stable, references.defect)?;
    let statistic = |weights: &Weights| -> Option<f64> {
        let test = judged(weights.omega(&d), weights.rank, references.f, references.alpha * DOUBTED);
        (weights.rank > 0 && test.passed).then_some(test.statistic)
    };
    let r = all.points.len();
    // With a clear majority only a group of the same size is an alternative; else a group with one point fewer is as probable.
    let smallest = LEAST.max(if 3 * stable.len() >= 2 * r { stable.len() } else { stable.len() - 1 });
    let deepest = r - smallest;
    let mut groups = 1.0;
    let mut count = 1.0;
    for k in 0..deepest {
        groups *= (r - k) as f64 / (k + 1) as f64;
        count += groups;
    }
    if count > SEARCHED {
        let others = stable.iter().try_fold(all.clone(), |others, point| {
            Some(others.without(others.points.iter().position(|p| p == point)?))
        })?;
        return (removed.len() >= LEAST && statistic(&others).is_some()).then_some(others.points);
    }
    let mut best: Option<(usize, f64, Vec<usize>)> = None;
    // Groups by what is taken away, each set once: indices ascending.
    let mut open = vec![(all.clone(), 0)];
    while let Some((weights, from)) = open.pop() {
        let size = weights.points.len();
        let holds_removed = weights.points.iter().any(|point| removed.contains(point));
        if holds_removed
            && size < r
            && let Some(statistic) = statistic(&weights)
            && best.as_ref().is_none_or(|(s, t, _)| size > *s || size == *s && statistic < *t)
        {
            best = Some((size, statistic, weights.points.clone()));
        }
        if size > smallest {
            for k in from..size {
                open.push((weights.without(k), k));
            }
        }
    }
    best.map(|(_, _, points)| points)
}
