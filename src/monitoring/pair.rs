//! Comparison of two epochs, step by step.

use std::collections::{BTreeSet, HashMap};

use nalgebra::{Matrix3, Vector3};

use super::bundle::Bundle;
use super::congruence::Weights;
use super::covariance::{DIRECTIONS, PointsCovariance, ReferenceDatum, Transformed};
use super::elimination::{References, eliminated};
use super::epoch::{Prepared, at};
use super::groups::{Members, movement};
use super::joint::{Displaced, conditioned};
use super::judgement::{Factors, factors, judged, variance_test};
use super::points::{PointDifference, displacements, omega, sorted};
use super::request::{ComparisonMethod, DatumChoice, Options};
use super::result::{
    LeftOutPoint, LeftOutPointReason, Outcome, Pair, PairNote, PointRole, ReferenceFrom, RobustDatum, ScaleDifference,
    VarianceUsed,
};
use super::robust::robust_datum;
use super::system::{differences, is_automatic};
use super::{LEAST, MOST, state_of};
use crate::error::{Error, Reason, Result};
use crate::initial::robust::quantile;
use crate::statistics::fisher::Fisher;

/// Reference points from whose displacements standard errors are judged: the median of fewer is uncertain by more than a third.
const DISPERSED: usize = 12;
/// Standard errors are too small where so many more tests than half are beyond their median, in standard deviations of that number.
const CHANCE: f64 = 3.3;

/// Standard errors of a displacement that must not stay hidden among the stable points.
const HIDDEN: f64 = 10.0;

/// Inputs of a comparison of two epochs.
pub struct Input<'a> {
    /// Earlier epoch.
    pub from: &'a Prepared,
    /// Later epoch, in the system of the first, and its place in the list.
    pub to: (usize, &'a Prepared),
    /// Reference points that were named or found in the projects.
    pub reference: Option<(&'a [String], ReferenceFrom)>,
    /// Options.
    pub options: &'a Options,
    /// Names of matched points in the later epoch.
    pub renamed: &'a HashMap<String, String>,
    /// Points that could not be matched.
    pub left_out: Vec<LeftOutPoint>,
    /// The adjustment of all epochs, and the places of both in the list.
    pub joint: Option<(&'a Bundle, [usize; 2])>,
}

/// Points of two epochs in one order.
pub struct Common {
    /// Identifiers.
    pub ids: Vec<String>,
    /// Coordinates of both.
    pub xyz: [Vec<Vector3<f64>>; 2],
    /// Covariances of both.
    pub covariance: [PointsCovariance; 2],
}

impl Common {
    /// The common points of two epochs, in the order of the earlier one.
    pub fn of(from: &Prepared, to: &Prepared, ignored: &BTreeSet<&str>) -> Self {
        let places: HashMap<&str, usize> = to.ids.iter().enumerate().map(|(k, id)| (id.as_str(), k)).collect();
        let pairs = from.ids.iter().enumerate().filter(|(_, id)| !ignored.contains(id.as_str()));
        let pairs: Vec<(usize, usize)> = pairs.filter_map(|(i, id)| Some((i, *places.get(id.as_str())?))).collect();
        let (first, second): (Vec<usize>, Vec<usize>) = pairs.into_iter().unzip();
        Self {
            ids: first.iter().map(|&i| from.ids[i].clone()).collect(),
            xyz: [first.iter().map(|&i| from.xyz[i]).collect(), second.iter().map(|&j| to.xyz[j]).collect()],
            covariance: [from.covariance.chosen(&first), to.covariance.chosen(&second)],
        }
    }

    /// Middle of both places: where directions of a datum are taken.
    pub fn middle(&self) -> Vec<Vector3<f64>> {
        self.xyz[0].iter().zip(&self.xyz[1]).map(|(a, b)| (a + b) * 0.5).collect()
    }
}

/// Datum defect of two epochs.
pub fn defect(from: &Prepared, to: &Prepared, options: &Options) -> usize {
    match options.datum {
        DatumChoice::Given => 0,
        DatumChoice::Reference if from.scaled && to.scaled => DIRECTIONS - 1,
        DatumChoice::Reference => DIRECTIONS,
    }
}

/// Compares two epochs.
///
/// # Errors
/// [`Reason::EpochNoCommon`], [`Reason::EpochReference`], [`Reason::EpochReferenceMany`], [`Reason::EpochReferenceLine`].
pub fn compared(input: Input) -> Result<Pair> {
    let Input { from, to: (index, to), options, renamed, .. } = input;
    let fault = |reason| Error::Invalid { reason, at: at(index, "") };
    let ignored: BTreeSet<&str> = options.ignored.iter().map(String::as_str).collect();
    let common = Common::of(from, to, &ignored);
    if common.ids.is_empty() {
        return Err(fault(Reason::EpochNoCommon { name: to.name.clone(), first: from.name.clone() }));
    }
    let alpha = options.significance;
    let all: Vec<usize> = (0..common.ids.len()).collect();
    let (reference, reference_from) = references(&common, input.reference, options);
    if reference.len() < LEAST {
        let (given, needed) = (reference.len(), LEAST);
        return Err(fault(Reason::EpochReference { name: to.name.clone(), given, needed }));
    }
    if reference.len() > MOST {
        return Err(fault(Reason::EpochReferenceMany { given: reference.len(), limit: MOST }));
    }
    let defect = defect(from, to, options);
    let middle = common.middle();
    let weighted = |carriers: &[usize]| -> Vec<(usize, f64)> { carriers.iter().map(|&k| (k, 1.0)).collect() };
    let on_a_line = || fault(Reason::EpochReferenceLine);
    let datum = ReferenceDatum::new(&middle, &weighted(&reference), defect).ok_or_else(on_a_line)?;

    // Step 1
    let variances = variance_test(from, to, alpha);
    let Factors { from: a, to: b, f, used, sigma0 } = factors(from, to, options.variance, variances.as_ref(), || {
        let trace = |epoch: usize| {
            let own = Transformed::new(&common.covariance[epoch], &datum);
            reference.iter().map(|&k| own.block(k, k).trace()).sum()
        };
        [trace(0), trace(1)]
    });
    let covariance = PointsCovariance::sum(a, &common.covariance[0], b, &common.covariance[1]);

    // Steps 2 to 4
    let transformed = Transformed::new(&covariance, &datum);
    let weights = Weights::new(&reference, &transformed, &datum);
    let [earlier, later] = &common.xyz;
    let found = eliminated(&References { ids: &common.ids, earlier, later, defect, f, alpha }, &weights);
    let certain = !found.stable.is_empty();
    let carriers = if certain { found.stable.clone() } else { reference.clone() };
    let d_all = differences(earlier, later, &reference, defect).ok_or_else(on_a_line)?;
    let (robust, too_small) = second_opinion(&common, &d_all, &reference, &covariance, &middle, defect, f, options);

    let datum = ReferenceDatum::new(&middle, &weighted(&carriers), defect).ok_or_else(on_a_line)?;
    let transformed = Transformed::new(&covariance, &datum);
    let mut d = differences(earlier, later, &carriers, defect).ok_or_else(on_a_line)?;
    let weights = Weights::new(&carriers, &transformed, &datum);
    let scale = (defect == DIRECTIONS - 1).then(|| scale_difference(&weights, &middle, &d, f, alpha)).flatten();
    let weak = if found.steps.is_empty() { Vec::new() } else { weakly_controlled(&weights, &transformed, f, options) };
    let bundled = input.joint.and_then(|(bundle, both)| {
        let (moved, matrix) = bundle.displacements(both, &common.ids)?;
        d = moved;
        Some((bundle, matrix))
    });
    let one_for_all = bundled.as_ref().map(|(bundle, _)| *bundle);
    let (displaced, points_f) = match (bundled, options.method) {
        (Some((bundle, matrix)), _) => (Displaced::Bundle(matrix), bundle.f),
        (None, ComparisonMethod::Joint) if certain => {
            let pooled = f.filter(|_| used == VarianceUsed::Pooled);
            let (joint, sum) = conditioned(transformed, &weights, &mut d, pooled);
            (joint, sum.or(f))
        }
        _ => (Displaced::Separate(transformed), f),
    };

    // Step 5
    let stable: BTreeSet<usize> = found.stable.iter().copied().collect();
    let moved = |&k: &usize| PointDifference {
        id: common.ids[k].clone(),
        later_id: renamed.get(&common.ids[k]).cloned(),
        role: if one_for_all.map_or(stable.contains(&k), |bundle| bundle.stable.contains(&common.ids[k])) {
            PointRole::Reference
        } else {
            PointRole::Object
        },
        xyz: earlier[k],
        d: d[k],
        covariance: displaced.block(k, k),
    };
    let points = displacements(all.iter().map(moved).collect(), points_f, options, certain);

    // Step 6
    let places: HashMap<&str, usize> = common.ids.iter().enumerate().map(|(k, id)| (id.as_str(), k)).collect();
    let groups = options.groups.iter().map(|group| {
        let (there, missing): (Vec<&String>, Vec<&String>) =
            group.points.iter().partition(|id| places.contains_key(id.as_str()));
        let there: Vec<usize> = there.iter().map(|id| places[id.as_str()]).collect();
        let members = Members {
            ids: there.iter().map(|&k| common.ids[k].clone()).collect(),
            missing: missing.into_iter().cloned().collect(),
            xyz: there.iter().map(|&k| earlier[k]).collect(),
            d: there.iter().map(|&k| d[k]).collect(),
            covariance: displaced.matrix(&there),
        };
        let mut found = movement(group, members, points_f, alpha, certain);
        let length = found.translation.as_ref().map(|t| t.value.iter().map(|x| x * x).sum::<f64>().sqrt());
        found.state = length.and_then(|length| {
            let limits = options.thresholds.as_ref()?;
            Some(state_of(length, limits.groups.get(&group.name).unwrap_or(&limits.all)))
        });
        found
    });
    let groups = groups.collect();

    let mut left_out = input.left_out;
    left_out.extend(outside(from, to, &ignored, options, renamed));
    let held = |k: usize| common.covariance.iter().all(|c| c.block(k, k).amax() == 0.0);
    let held = (0..points.len()).filter(|&k| held(k)).map(|k| &points[k]);
    left_out.extend(held.map(|p| LeftOutPoint { id: p.id.clone(), reason: LeftOutPointReason::Held }));
    let mut seen = HashMap::new();
    left_out.retain(|l| seen.insert((l.id.clone(), format!("{:?}", l.reason)), ()).is_none());

    let name = |k: &usize| common.ids[*k].clone();
    let unstable: Vec<usize> = reference.iter().copied().filter(|k| !stable.contains(k)).collect();
    let outcome = match (certain, unstable.is_empty()) {
        (false, _) => Outcome::NoStableGroup,
        (true, true) => Outcome::Congruent,
        (true, false) => Outcome::StableGroup,
    };
    let mut notes = Vec::new();
    if variances.is_some_and(|test| !test.passed) {
        notes.push(PairNote::VariancesDiffer);
    }
    notes.extend(too_small.map(|factor| PairNote::SigmasTooSmall { factor }));
    if scale.is_some_and(|scale| !scale.test.passed) {
        notes.push(PairNote::ScaleDiffers);
    }
    match outcome {
        Outcome::NoStableGroup => notes.push(PairNote::NoStableGroup),
        Outcome::StableGroup if 2 * stable.len() <= reference.len() => {
            notes.push(PairNote::NoMajority { stable: stable.len(), reference: reference.len() });
        }
        _ => {}
    }
    if !found.other.is_empty() {
        notes.push(PairNote::AnotherGroup { points: found.other.iter().map(name).collect() });
    }
    if certain && !weak.is_empty() {
        notes.push(PairNote::WeaklyControlled { points: weak.iter().map(name).collect() });
    }
    let doubted = robust.unstable.iter().filter(|id| stable.contains(&places[id.as_str()]));
    let cleared = robust.stable.iter().filter(|id| certain && !stable.contains(&places[id.as_str()]));
    let points_differing: Vec<String> = doubted.chain(cleared).cloned().collect();
    if !points_differing.is_empty() {
        notes.push(PairNote::SecondOpinionDiffers { points: points_differing });
    }
    if let Some(bundle) = one_for_all {
        let differs = bundle.told.cameras.iter().filter(|c| c.test.is_some_and(|test| !test.passed));
        notes.extend(differs.map(|c| PairNote::CameraDiffers { camera: c.id.clone() }));
    }
    let (used, sigma0, f) = match (one_for_all, used) {
        (Some(bundle), VarianceUsed::Given) => (used, Some(bundle.sigma0), bundle.f),
        (Some(bundle), _) => (VarianceUsed::Pooled, Some(bundle.sigma0), bundle.f),
        (None, _) => (used, sigma0, f),
    };
    Ok(Pair {
        from: from.name.clone(),
        to: to.name.clone(),
        variance_test: variances,
        variance: used,
        sigma0,
        redundancy: f,
        reference_from,
        scale,
        global_test: found.first,
        steps: found.steps,
        outcome,
        stable: found.stable.iter().map(name).collect(),
        unstable: unstable.iter().map(name).collect(),
        robust_datum: robust,
        points,
        groups,
        left_out,
        notes,
    })
}

/// Reference points among the common ones.
fn references(
    common: &Common,
    given: Option<(&[String], ReferenceFrom)>,
    options: &Options,
) -> (Vec<usize>, ReferenceFrom) {
    if let Some((ids, from)) = given {
        let wanted: BTreeSet<&str> = ids.iter().map(String::as_str).collect();
        let found: Vec<usize> = (0..common.ids.len()).filter(|&k| wanted.contains(common.ids[k].as_str())).collect();
        // Named points are what was asked for; what a project happens to hold must suffice.
        if from == ReferenceFrom::Named || found.len() >= LEAST {
            return (found, from);
        }
    }
    let own = |k: &usize| !is_automatic(&common.ids[*k], &options.automatic);
    ((0..common.ids.len()).filter(own).collect(), ReferenceFrom::Common)
}

/// Points of one epoch alone, and those that are ignored.
fn outside(
    from: &Prepared,
    to: &Prepared,
    ignored: &BTreeSet<&str>,
    options: &Options,
    renamed: &HashMap<String, String>,
) -> Vec<LeftOutPoint> {
    let mut left: Vec<LeftOutPoint> = from.left_out.iter().chain(&to.left_out).cloned().collect();
    let told: BTreeSet<String> = left.iter().map(|l| l.id.clone()).collect();
    let there = |epoch: &Prepared| epoch.ids.iter().cloned().collect::<BTreeSet<String>>();
    let (first, second) = (there(from), there(to));
    let mut only = |epoch: &Prepared, own: &BTreeSet<String>, other: &BTreeSet<String>| {
        for id in own.difference(other) {
            let matched = is_automatic(id, &options.automatic) || renamed.contains_key(id) || told.contains(id);
            if !matched && !ignored.contains(id.as_str()) {
                left.push(LeftOutPoint {
                    id: id.clone(),
                    reason: LeftOutPointReason::OnlyIn { epoch: epoch.name.clone() },
                });
            }
        }
    };
    only(from, &first, &second);
    only(to, &second, &first);
    let named = first.union(&second).filter(|id| ignored.contains(id.as_str()));
    left.extend(named.map(|id| LeftOutPoint { id: id.clone(), reason: LeftOutPointReason::Ignored }));
    left
}

#[allow(clippy::too_many_arguments)]
fn second_opinion(
    common: &Common,
    d: &[Vector3<f64>],
    reference: &[usize],
    covariance: &PointsCovariance,
    middle: &[Vector3<f64>],
    defect: usize,
    f: Option<f64>,
    options: &Options,
) -> (RobustDatum, Option<f64>) {
    let traces: f64 = reference.iter().map(|&k| covariance.block(k, k).trace()).sum();
    let sigma = (traces / (3 * reference.len()) as f64).sqrt();
    let Some((datum, d)) = robust_datum(middle, d, reference, sigma, defect) else {
        return (RobustDatum::default(), None);
    };
    let transformed = Transformed::new(covariance, &datum);
    let points: Vec<(usize, Vector3<f64>, Matrix3<f64>)> =
        reference.iter().map(|&k| (k, d[k], transformed.block(k, k))).collect();
    // A point that defines the datum nearly alone has no variance left, and no displacement.
    let points: Vec<_> = points
        .into_iter()
        .map(|(k, d, c)| if omega(&d, &c).1 < 3 { (k, d, covariance.block(k, k)) } else { (k, d, c) })
        .collect();
    let (stable, unstable) = sorted(&points, f, options);
    let names = |places: Vec<usize>| places.into_iter().map(|k| common.ids[k].clone()).collect();
    let forms = points.iter().map(|(_, d, c)| omega(d, c)).filter(|(_, rank)| *rank == 3);
    let statistics: Vec<f64> = forms.map(|(omega, _)| omega / 3.0).collect();
    let median = Fisher::new(3, f).limit(0.5);
    let n = statistics.len() as f64;
    let above = statistics.iter().filter(|statistic| **statistic > median).count() as f64;
    let factor = (quantile(&statistics, 0.5) / median).sqrt();
    let beyond_chance = above > 0.5 * n + CHANCE * 0.5 * n.sqrt();
    let too_small = Some(factor).filter(|_| statistics.len() >= DISPERSED && beyond_chance);
    (RobustDatum { stable: names(stable), unstable: names(unstable) }, too_small)
}

/// Stable points of which a displacement of [`HIDDEN`] standard errors may be hidden: δ = √(λ₀ / μ) with the least eigenvalue μ of N_ii and
/// the non-centrality λ₀ of the global test.
fn weakly_controlled(weights: &Weights, own: &Transformed, f: Option<f64>, options: &Options) -> Vec<usize> {
    let law = Fisher::new(weights.rank, f);
    let lambda = law.noncentrality(law.limit(options.significance), options.power);
    let hidden = |(&k, variance): (&usize, f64)| {
        let largest = own.block(k, k).symmetric_eigenvalues().max();
        (lambda * variance > HIDDEN * HIDDEN * largest).then_some(k)
    };
    weights.points.iter().zip(weights.against_others()).filter_map(hidden).collect()
}

/// The change of scale of the stable points: d = m a with a their coordinates in the datum, m = aᵀNd / aᵀNa, σ² = 1 / aᵀNa.
fn scale_difference(
    weights: &Weights,
    middle: &[Vector3<f64>],
    d: &[Vector3<f64>],
    f: Option<f64>,
    alpha: f64,
) -> Option<ScaleDifference> {
    let centre = weights.points.iter().map(|&k| middle[k]).sum::<Vector3<f64>>() / weights.points.len() as f64;
    let arms: Vec<Vector3<f64>> = middle.iter().map(|x| x - centre).collect();
    let weight = weights.product(&arms, &arms);
    if !(weight > 0.0) || !weight.is_finite() {
        return None;
    }
    let m = weights.product(&arms, d) / weight;
    if !m.is_finite() {
        return None;
    }
    let test = judged(m * m * weight, 1, f, alpha);
    Some(ScaleDifference { value: 1.0 + m, sigma: 1.0 / weight.sqrt(), test })
}
