//! Epochs in one coordinate system, and identification of their points.
//!
//! Every epoch is transformed to the first one by the similarity of the points that agree ([`similarity::fit_robust`]), so that what follows is
//! linear in small differences. Points that a program has numbered are matched after that, by their positions: a pair is taken where each is
//! nearest to the other, nearer than a third of the distance to any other point of either epoch, and no farther than identified points
//! have moved. Anything else is listed.

use std::collections::{BTreeSet, HashMap};

use nalgebra::{Matrix3, Vector3};

use super::epoch::{Prepared, at};
use super::request::DatumChoice;
use super::result::{LeftOutPoint, LeftOutPointReason};
use crate::error::{Error, Reason, Result};
use crate::initial::PrincipalAxes;
use crate::initial::robust::quantile;
use crate::initial::similarity::{self, Similarity};

/// Points that determine a similarity.
const FEWEST: usize = 3;
/// Median residual over the extent beyond which names do not mean the same points: nothing deforms like that as a whole.
const UNLIKE: f64 = 0.05;
/// A mirror image has to fit so many times better.
const MIRRORED: f64 = 10.0;
/// A scale of more than this off 1 is another unit.
const OTHER_UNIT: f64 = 0.01;
/// Share of the distance to the next other point within which a position is an identity.
const NEAR: f64 = 1.0 / 3.0;
/// Identified points move by less than this times their 90 % quantile, but for few; and what is within so many standard errors has not moved.
const REACH: f64 = 4.0;
/// See [`REACH`].
const REACH_SIGMAS: f64 = 10.0;

/// Whether a name is a number that a program has given: a prefix and digits.
pub fn is_automatic(id: &str, prefixes: &[String]) -> bool {
    let numbered = |rest: &str| !rest.is_empty() && rest.bytes().all(|byte| byte.is_ascii_digit());
    prefixes.iter().any(|prefix| id.strip_prefix(prefix.as_str()).is_some_and(numbered))
}

/// Result of transforming an epoch onto the first one.
#[derive(Clone, Debug, Default)]
pub struct Carried {
    /// Own names of points that were matched under another one, by the name in the first epoch.
    pub renamed: HashMap<String, String>,
    /// Points that could not be matched.
    pub left_out: Vec<LeftOutPoint>,
}

/// Carries an epoch onto the first one and matches what is numbered automatically. `anchors` are points to prefer.
///
/// # Errors
/// [`Reason::EpochNoCommon`], [`Reason::EpochReference`], [`Reason::EpochReferenceLine`], [`Reason::EpochMirrored`],
/// [`Reason::EpochUnlike`], [`Reason::EpochUnitRatio`].
pub fn carried(
    index: usize,
    first: &Prepared,
    epoch: &mut Prepared,
    anchors: &[String],
    automatic: &[String],
    datum: DatumChoice,
) -> Result<Carried> {
    let named: BTreeSet<&str> = anchors.iter().map(String::as_str).collect();
    let is_number = |id: &str| is_automatic(id, automatic);
    let places: HashMap<&str, usize> = first.ids.iter().enumerate().map(|(k, id)| (id.as_str(), k)).collect();
    let common = epoch.ids.iter().enumerate().filter(|(_, id)| !is_number(id));
    let common: Vec<(usize, usize)> = common.filter_map(|(j, id)| Some((*places.get(id.as_str())?, j))).collect();
    let preferred: Vec<_> = common.iter().copied().filter(|(i, _)| named.contains(first.ids[*i].as_str())).collect();
    let pairs = if preferred.len() >= FEWEST { preferred } else { common.clone() };
    let fault = |reason| Error::Invalid { reason, at: at(index, "") };
    if common.is_empty() {
        return Err(fault(Reason::EpochNoCommon { name: epoch.name.clone(), first: first.name.clone() }));
    }
    if datum == DatumChoice::Reference {
        if pairs.len() < FEWEST {
            return Err(fault(Reason::EpochReference {
                name: epoch.name.clone(),
                given: pairs.len(),
                needed: super::LEAST,
            }));
        }
        let transform = transform(first, epoch, &pairs).map_err(fault)?;
        apply(epoch, &transform);
    }
    Ok(matched(first, epoch, &common, &is_number))
}

fn apply(epoch: &mut Prepared, transform: &Similarity) {
    epoch.xyz.iter_mut().for_each(|x| *x = transform.point(x));
    epoch.covariance = epoch.covariance.turned(&(transform.rotation * transform.scale));
}

fn transform(first: &Prepared, epoch: &Prepared, pairs: &[(usize, usize)]) -> std::result::Result<Similarity, Reason> {
    let target: Vec<_> = pairs.iter().map(|&(i, _)| first.xyz[i]).collect();
    let source: Vec<_> = pairs.iter().map(|&(_, j)| epoch.xyz[j]).collect();
    let (fit, _) = similarity::fit_robust(&source, &target, 0).map_err(|_| Reason::EpochReferenceLine)?;
    let median = |t: &Similarity, source: &[Vector3<f64>]| {
        let lengths: Vec<f64> = source.iter().zip(&target).map(|(p, q)| (t.point(p) - q).norm()).collect();
        quantile(&lengths, 0.5)
    };
    let direct = median(&fit.transform, &source);
    let sigma =
        |&(i, j): &(usize, usize)| (first.covariance.block(i, i).trace() + epoch.covariance.block(j, j).trace()).sqrt();
    let sigmas: Vec<f64> = pairs.iter().map(sigma).collect();
    let extent = PrincipalAxes::of(&target).map_or(0.0, |spread| spread.extent.norm());
    let name = epoch.name.clone();
    if direct > 10.0 * quantile(&sigmas, 0.5) {
        let mirror: Vec<_> = source.iter().map(|p| Vector3::new(-p.x, p.y, p.z)).collect();
        let mirrored = similarity::fit_robust(&mirror, &target, 0);
        if mirrored.is_ok_and(|(fit, _)| MIRRORED * median(&fit.transform, &mirror) < direct) {
            return Err(Reason::EpochMirrored { name });
        }
    }
    if direct > UNLIKE * extent {
        return Err(Reason::EpochUnlike { name, share: digits(direct / extent, 2).into() });
    }
    if !(first.scaled && epoch.scaled) {
        return Ok(fit.transform);
    }
    if (fit.transform.scale - 1.0).abs() > OTHER_UNIT {
        return Err(Reason::EpochUnitRatio { name, ratio: digits(1.0 / fit.transform.scale, 6).into() });
    }
    // About the centroids rotation and shift of least squares are the same with and without a scale.
    Ok(Similarity { scale: 1.0, ..fit.transform })
}

/// Distance to the nearest other point.
fn spacing(xyz: &[Vector3<f64>], k: usize) -> f64 {
    let others = xyz.iter().enumerate().filter(|(i, _)| *i != k);
    others.map(|(_, x)| (x - xyz[k]).norm()).fold(f64::MAX, f64::min)
}

/// Matches automatically numbered points; those without a counterpart leave the epoch.
fn matched(
    first: &Prepared,
    epoch: &mut Prepared,
    common: &[(usize, usize)],
    is_number: &dyn Fn(&str) -> bool,
) -> Carried {
    let automatic = |p: &Prepared| (0..p.ids.len()).filter(|&k| is_number(&p.ids[k])).collect::<Vec<_>>();
    let (ours, theirs) = (automatic(first), automatic(epoch));
    let mut carried = Carried::default();
    if theirs.is_empty() && ours.is_empty() {
        return carried;
    }
    let moved: Vec<f64> = common.iter().map(|&(i, j)| (epoch.xyz[j] - first.xyz[i]).norm()).collect();
    let identified = common.len() >= FEWEST;
    let gate = REACH * quantile(&moved, 0.9);
    let error = |p: &Prepared, k: usize| p.covariance.block(k, k).trace();
    let distance = |i: usize, j: usize| (epoch.xyz[j] - first.xyz[i]).norm();
    let reach = |i: usize, j: usize| gate.max(REACH_SIGMAS * (error(first, i) + error(epoch, j)).sqrt());
    let nearest = |to: &mut dyn Iterator<Item = (usize, f64)>| to.min_by(|a, b| a.1.total_cmp(&b.1));
    let mut taken: HashMap<usize, usize> = HashMap::new();
    let mut seen = BTreeSet::new();
    let mut kept: Vec<usize> = (0..epoch.ids.len()).filter(|&j| !is_number(&epoch.ids[j])).collect();
    for &j in &theirs {
        let left = |reason| LeftOutPoint { id: epoch.ids[j].clone(), reason };
        if !identified {
            carried.left_out.push(left(LeftOutPointReason::NoIdentity { epoch: epoch.name.clone() }));
            continue;
        }
        let candidates: Vec<usize> = ours.iter().copied().filter(|&i| distance(i, j) <= reach(i, j)).collect();
        let best = nearest(&mut candidates.iter().map(|&i| (i, distance(i, j))));
        let Some((i, apart)) = best else {
            carried.left_out.push(left(LeftOutPointReason::NoCounterpart { epoch: epoch.name.clone() }));
            continue;
        };
        let back = nearest(&mut theirs.iter().map(|&k| (k, distance(i, k)))).map(|(k, _)| k);
        // Points that stand as near to each other as errors reach may have changed their places.
        let alone = spacing(&first.xyz, i).min(spacing(&epoch.xyz, j));
        let clear = apart <= NEAR * alone && alone >= REACH_SIGMAS * (error(first, i) + error(epoch, j)).sqrt();
        if back == Some(j) && clear {
            taken.insert(j, i);
            seen.insert(i);
            kept.push(j);
        } else {
            seen.extend(&candidates);
            let candidates = candidates.iter().take(10).map(|&i| first.ids[i].clone()).collect();
            carried.left_out.push(left(LeftOutPointReason::Ambiguous { epoch: epoch.name.clone(), candidates }));
        }
    }
    let unseen = ours.iter().filter(|i| !seen.contains(i)).map(|&i| {
        let epoch = first.name.clone();
        let reason = if identified {
            LeftOutPointReason::NoCounterpart { epoch }
        } else {
            LeftOutPointReason::NoIdentity { epoch }
        };
        LeftOutPoint { id: first.ids[i].clone(), reason }
    });
    carried.left_out.extend(unseen);
    kept.sort_unstable();
    let ids = kept.iter().map(|j| match taken.get(j) {
        Some(&i) => {
            if first.ids[i] != epoch.ids[*j] {
                carried.renamed.insert(first.ids[i].clone(), epoch.ids[*j].clone());
            }
            first.ids[i].clone()
        }
        None => epoch.ids[*j].clone(),
    });
    epoch.ids = ids.collect();
    epoch.xyz = kept.iter().map(|&j| epoch.xyz[j]).collect();
    epoch.covariance = epoch.covariance.chosen(&kept);
    carried
}

/// The rotation, shift and, where it is free, scale of least squares that transforms the later coordinates of the carriers to the earlier
/// ones: differences after it are those of the datum of these points, without linearisation.
pub fn differences(
    earlier: &[Vector3<f64>],
    later: &[Vector3<f64>],
    carriers: &[usize],
    defect: usize,
) -> Option<Vec<Vector3<f64>>> {
    let plain = || earlier.iter().zip(later).map(|(a, b)| b - a).collect();
    if defect == 0 {
        return Some(plain());
    }
    let pick = |points: &[Vector3<f64>]| -> Vec<Vector3<f64>> { carriers.iter().map(|&k| points[k]).collect() };
    let mut transform = similarity::fit(&pick(later), &pick(earlier)).ok()?.transform;
    if defect < super::covariance::DIRECTIONS {
        transform.scale = 1.0;
    }
    // Differences of large coordinates, through small ones.
    let turn = transform.rotation * transform.scale - Matrix3::identity();
    let shift = transform.target_centroid - transform.source_centroid;
    let one = |(a, b): (&Vector3<f64>, &Vector3<f64>)| b - a + shift + turn * (b - transform.source_centroid);
    Some(earlier.iter().zip(later).map(one).collect())
}
/// A number rounded to so many significant digits, for sentences.
fn digits(value: f64, digits: i32) -> f64 {
    let power = 10f64.powi(digits - 1 - value.abs().log10().floor().clamp(-200.0, 200.0) as i32);
    (value * power).round() / power
}
