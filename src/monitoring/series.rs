//! Points through more than two epochs: displacements against the first, and linear velocities.
//!
//! All epochs are in one datum, that of the reference points which are stable in every pair with the first epoch. The coordinates of a
//! point are y_k = a + v t_k with the independent errors of the epochs; least squares with their 3 x 3 covariances gives v, whose
//! T = vᵀ C_v⁻¹ v / 3 is tested against F(3, f).

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, SVector, Vector3};

use super::bundle::Bundle;
use super::covariance::{ReferenceDatum, Transformed};
use super::epoch::Prepared;
use super::pair::{Common, defect};
use super::points::single;
use super::request::{Options, VarianceChoice};
use super::result::{Pair, Series, SeriesValue, VarianceUsed};
use super::system::differences;
use super::{LEAST, state_of};

/// Epochs of a velocity at least: two determine it without a check.
const DATED: usize = 3;

/// An epoch's place of a point, relative to that in the first, with its own covariance.
struct EpochPosition {
    epoch: usize,
    d: Vector3<f64>,
    covariance: Matrix3<f64>,
}

/// The series, and its datum.
pub fn series(
    epochs: &[Prepared],
    pairs: &[Pair],
    joint: Option<&Bundle>,
    options: &Options,
) -> (Vec<Series>, Vec<String>) {
    // Pairs with the first epoch come first.
    let pairs = &pairs[..epochs.len() - 1];
    let datum = stable_in_all(pairs);
    let datum: Vec<String> = if datum.len() >= LEAST { datum } else { Vec::new() };
    let (factors, f) = variance(epochs, pairs, options);
    let f = joint.map_or(f, |bundle| bundle.f);
    let mut values: BTreeMap<String, Vec<SeriesValue>> = BTreeMap::new();
    let mut places: BTreeMap<String, Vec<EpochPosition>> = BTreeMap::new();
    let mut single_datum = !datum.is_empty();
    for (k, pair) in pairs.iter().enumerate() {
        let later = k + 1;
        match in_datum(&epochs[0], &epochs[later], &datum, [factors[0], factors[later]], options) {
            Some(found) if joint.is_none() && !datum.is_empty() => {
                for (id, d, [first, own]) in found {
                    let sum = first + own;
                    let sigma = std::array::from_fn(|a| sum[(a, a)].max(0.0).sqrt());
                    let value = SeriesValue { epoch: pair.to.clone(), difference: d.into(), sigma };
                    values.entry(id.clone()).or_default().push(value);
                    let known = places.entry(id).or_default();
                    if known.is_empty() {
                        known.push(EpochPosition { epoch: 0, d: Vector3::zeros(), covariance: first });
                    }
                    known.push(EpochPosition { epoch: later, d, covariance: own });
                }
            }
            _ => {
                // One adjustment of all epochs has one datum, and its pairs are of it.
                single_datum = false;
                for point in &pair.points {
                    let epoch = pair.to.clone();
                    let value = SeriesValue { epoch, difference: point.difference, sigma: point.sigma };
                    values.entry(point.id.clone()).or_default().push(value);
                }
            }
        }
    }
    let order = epochs[0].ids.iter().filter_map(|id| Some((id.clone(), values.remove(id)?)));
    let series = order.map(|(id, values)| {
        let velocity = match joint {
            Some(bundle) if bundle.stable.contains(&id) => None,
            Some(bundle) => joint_velocity(epochs, bundle, &id),
            None => single_datum.then(|| velocity(epochs, places.get(&id)?)).flatten(),
        };
        let last = values.last().map_or(0.0, |value| Vector3::from(value.difference).norm());
        let state =
            options.thresholds.as_ref().map(|limits| state_of(last, limits.points.get(&id).unwrap_or(&limits.all)));
        Series {
            id,
            values,
            velocity: velocity.map(|(v, ..)| v.into()),
            velocity_sigma: velocity.map(|(_, c, _)| std::array::from_fn(|a| c[(a, a)].max(0.0).sqrt())),
            line_start: velocity.map(|(.., start)| start.into()),
            velocity_test: velocity.and_then(|(v, c, _)| single(&v, &c, f, options.significance)),
            state,
        }
    });
    (series.collect(), datum)
}

/// Reference points that are stable in all of these pairs.
pub fn stable_in_all(pairs: &[Pair]) -> Vec<String> {
    let stable = |pair: &Pair| pair.stable.iter().cloned().collect::<BTreeSet<String>>();
    let all = pairs.iter().map(stable).reduce(|a, b| a.intersection(&b).cloned().collect()).unwrap_or_default();
    all.into_iter().collect()
}

/// Factors on the covariances of all epochs, and the degrees of freedom: pooled over all where every pair was.
fn variance(epochs: &[Prepared], pairs: &[Pair], options: &Options) -> (Vec<f64>, Option<f64>) {
    if options.variance == VarianceChoice::Given {
        return (epochs.iter().map(|e| e.sigma0.map_or(1.0, |s| 1.0 / (s * s))).collect(), None);
    }
    if pairs.iter().all(|pair| pair.variance == VarianceUsed::Pooled) {
        let all = epochs.iter().map(|e| (e.redundancy.unwrap_or(0.0), e.sigma0.unwrap_or(1.0).powi(2)));
        let (sum, f) = all.fold((0.0, 0.0), |(sum, f), (r, s2)| (sum + r * s2, f + r));
        return (epochs.iter().map(|e| sum / f / e.sigma0.unwrap_or(1.0).powi(2)).collect(), Some(f));
    }
    // The fewest degrees of freedom of a pair: no test is sharper than its parts.
    let fewest = pairs.iter().filter_map(|pair| pair.redundancy).reduce(f64::min);
    (vec![1.0; epochs.len()], fewest)
}

type DatumDisplacement = (String, Vector3<f64>, [Matrix3<f64>; 2]);

/// Displacements in the datum of the series with the covariances of both epochs. `None` if it does not reach.
fn in_datum(
    first: &Prepared,
    later: &Prepared,
    datum: &[String],
    factors: [f64; 2],
    options: &Options,
) -> Option<Vec<DatumDisplacement>> {
    let ignored: BTreeSet<&str> = options.ignored.iter().map(String::as_str).collect();
    let common = Common::of(first, later, &ignored);
    let wanted: BTreeSet<&str> = datum.iter().map(String::as_str).collect();
    let carriers: Vec<usize> = (0..common.ids.len()).filter(|&k| wanted.contains(common.ids[k].as_str())).collect();
    let defect = defect(first, later, options);
    let weighted: Vec<(usize, f64)> = carriers.iter().map(|&k| (k, 1.0)).collect();
    let middle = common.middle();
    let system = ReferenceDatum::new(&middle, &weighted, defect)?;
    let d = differences(&common.xyz[0], &common.xyz[1], &carriers, defect)?;
    let own: [Transformed; 2] = std::array::from_fn(|e| Transformed::new(&common.covariance[e], &system));
    let one = |k: usize| (common.ids[k].clone(), d[k], std::array::from_fn(|e| own[e].block(k, k) * factors[e]));
    Some((0..common.ids.len()).map(one).collect())
}

/// As [`velocity`], with the correlations between the epochs of one adjustment.
fn joint_velocity(
    epochs: &[Prepared],
    bundle: &Bundle,
    id: &str,
) -> Option<(Vector3<f64>, Matrix3<f64>, Vector3<f64>)> {
    let (there, x, c) = bundle.places(id, epochs.len());
    let rows: Vec<usize> = (0..there.len()).filter(|&i| epochs[there[i]].day.is_some()).collect();
    let day = |i: usize| epochs[there[rows[i]]].day.unwrap_or_default();
    let mut days: Vec<f64> = (0..rows.len()).map(day).collect();
    days.sort_by(f64::total_cmp);
    days.dedup();
    if days.len() < DATED || there[0] != 0 {
        return None;
    }
    let (first, span) = (days[0], days[days.len() - 1] - days[0]);
    let n = 3 * rows.len();
    let row = |i: usize| 3 * rows[i / 3] + i % 3;
    let y = DVector::from_fn(n, |i, _| x[row(i)] - x[i % 3]);
    let weight = DMatrix::from_fn(n, n, |i, j| c[(row(i), row(j))]).try_inverse()?;
    let design = DMatrix::from_fn(n, 6, |i, j| match (i % 3 == j % 3, j < 3) {
        (false, _) => 0.0,
        (true, true) => 1.0,
        (true, false) => (day(i / 3) - first) / span,
    });
    let inverse = (design.transpose() * &weight * &design).try_inverse()?;
    let found = &inverse * design.transpose() * weight * y;
    let v = found.fixed_rows::<3>(3) / span;
    let c: Matrix3<f64> = inverse.fixed_view::<3, 3>(3, 3) / (span * span);
    let start: Vector3<f64> = found.fixed_rows::<3>(0).into();
    (v.iter().chain(c.iter()).chain(start.iter()).all(|x| x.is_finite())).then_some((v, c, start))
}

/// Linear velocity per day, its covariance, and the line at the earliest date.
fn velocity(epochs: &[Prepared], places: &[EpochPosition]) -> Option<(Vector3<f64>, Matrix3<f64>, Vector3<f64>)> {
    let dated: Vec<(f64, &EpochPosition)> =
        places.iter().filter_map(|place| Some((epochs[place.epoch].day?, place))).collect();
    let mut days: Vec<f64> = dated.iter().map(|(day, _)| *day).collect();
    days.sort_by(f64::total_cmp);
    days.dedup();
    if days.len() < DATED {
        return None;
    }
    let (first, span) = (days[0], days[days.len() - 1] - days[0]);
    let mut normal = SMatrix::<f64, 6, 6>::zeros();
    let mut right = SVector::<f64, 6>::zeros();
    for (day, place) in dated {
        let t = (day - first) / span;
        let weight = place.covariance.try_inverse().filter(|w| w.iter().all(|x| x.is_finite()))?;
        for (i, a) in [1.0, t].into_iter().enumerate() {
            let part = weight * a * place.d;
            let mut rows = right.fixed_rows_mut::<3>(3 * i);
            rows += part;
            for (j, b) in [1.0, t].into_iter().enumerate() {
                let mut block = normal.fixed_view_mut::<3, 3>(3 * i, 3 * j);
                block += weight * (a * b);
            }
        }
    }
    let inverse = normal.try_inverse()?;
    let x = inverse * right;
    let v = x.fixed_rows::<3>(3) / span;
    let c: Matrix3<f64> = inverse.fixed_view::<3, 3>(3, 3) / (span * span);
    let start: Vector3<f64> = x.fixed_rows::<3>(0).into();
    (v.iter().chain(c.iter()).chain(start.iter()).all(|x| x.is_finite())).then_some((v, c, start))
}
