//! Monitoring: movements between epochs of one object, their size and significance.
//!
//! Epochs are projects or lists of points with standard errors. Every epoch is compared with the first and with its predecessor,
//! by the coordinates of separate adjustments: d = x₂ - x₁, Q_d = Q₁ + Q₂. With the method `joint` the stable reference points
//! have one set of coordinates after that, in one adjustment of all epochs where cameras are shared ([`ComparisonMethod::Joint`]). The steps, each with its test:
//!
//! 1. equality of the variance factors ([`Pair::variance_test`]);
//! 2. S-transformation of both epochs to the datum of the reference points, the scale kept where both have one and its difference tested;
//! 3. global congruence test of the reference points in the h = rank(Q_d) estimable directions;
//! 4. where it rejects, backward elimination until the rest is congruent or fewer than four points remain, with the datum of smallest
//!    displacements as a second opinion;
//! 5. tests of single points, corrected for their number, with detectable displacements;
//! 6. movements of groups;
//! 7. series, velocities and thresholds over all epochs.
//!
//! Sources: H. Pelzer, Zur Analyse geodätischer Deformationsmessungen, DGK C 164, 1971; W. Niemeier, Ausgleichungsrechnung, 2008;
//! A. Chrzanowski and Y. Q. Chen, FIG 1981-1986; W. Baarda, S-transformations and criterion matrices, 1973.

mod bundle;
mod congruence;
pub(crate) mod covariance;
mod date;
mod elimination;
mod epoch;
mod groups;
mod joint;
mod judgement;
mod pair;
pub mod planned;
mod points;
mod request;
mod result;
mod robust;
mod series;
mod system;

use std::collections::{BTreeSet, HashMap};

pub use date::days;
pub use request::{
    ComparisonMethod, ControlUse, Correction, DatumChoice, Epoch, Group, GroupModel, Limits, ListedCovariance,
    ListedPoint, Options, Thresholds, VarianceChoice,
};
pub use result::{
    Detectable, Displacement, EliminationStep, Ellipsoid, EpochNote, GroupError, GroupMovement, GroupResidual,
    JointAdjustment, LeftOutPoint, LeftOutPointReason, Monitoring, Outcome, Pair, PairNote, PointRole, ReferenceFrom,
    RobustDatum, ScaleDifference, Series, SeriesValue, SharedCamera, Test, Tested, ThresholdState, UsedEpoch,
    VarianceUsed,
};

use epoch::{Prepared, at, prepared};
use pair::Input;

use crate::error::{Error, Place, Reason, Result, Thing, shortened};
use crate::units::Unit;

/// Minimum number of reference points: with three, nothing shows which of them has moved.
pub const LEAST: usize = 4;
/// Reference points at most: their weights are a matrix of three rows each, which is inverted once a pair.
pub const MOST: usize = 500;
/// Epochs at most: a reading every week for ten years.
const EPOCHS: usize = 520;

/// State of a displacement by its length.
fn state_of(length: f64, limits: &Limits) -> ThresholdState {
    match length {
        length if length >= limits.alarm => ThresholdState::Alarm,
        length if length >= limits.warning => ThresholdState::Warning,
        _ => ThresholdState::Quiet,
    }
}

/// Compares epochs.
///
/// # Errors
/// Whatever adjusting a project finds. [`Error::Invalid`] with the place `epochs[k]` and the reason: fewer than two epochs, an epoch that
/// is neither a project nor a list, did not converge, has no standard errors, another unit, an invalid covariance matrix, no common points, is
/// mirrored or unlike the first; fewer than four common reference points, or all on a line; options out of range. [`Error::Unknown`] for
/// named points that no epoch has, [`Error::Duplicate`] for names that occur twice.
pub fn compare_epochs(epochs: &[Epoch], options: &Options) -> Result<Monitoring> {
    compare_epochs_watched(epochs, options, &mut |_, _| true)
}

/// As [`compare_epochs`]. `progress` gets the steps done and their number, an epoch or a pair each; it returns false to cancel.
///
/// # Errors
/// As [`compare_epochs`]; [`Error::Cancelled`].
pub fn compare_epochs_watched(
    epochs: &[Epoch],
    options: &Options,
    progress: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<Monitoring> {
    checked(epochs, options)?;
    // Every epoch, every pair with the first, every pair with the predecessor, and the series.
    let total = 3 * epochs.len() - 2;
    let mut done = 0;
    let mut step = || {
        done += 1;
        if progress(done, total) { Ok(()) } else { Err(Error::Cancelled) }
    };
    let mut all = Vec::new();
    for (k, epoch) in epochs.iter().enumerate() {
        all.push(prepared(k, epoch)?);
        step()?;
    }
    let unit = one_unit(&all)?;
    let axes = all.iter().find_map(|epoch| epoch.axes);
    known_points(&all, options)?;
    let (reference, reference_from) = reference_of(&all, options);
    let named = options.reference.as_ref().map(|named| (named.clone(), ReferenceFrom::Named));
    let given: Option<(Vec<String>, ReferenceFrom)> = named.or_else(|| reference_from.map(|from| (reference, from)));
    let anchors = given.as_ref().map_or(&[][..], |(ids, _)| ids);
    let (first, others) = all.split_at_mut(1);
    let mut carried = vec![system::Carried::default()];
    for (k, epoch) in others.iter_mut().enumerate() {
        carried.push(system::carried(k + 1, &first[0], epoch, anchors, &options.automatic, options.datum)?);
    }
    let with_first = (1..all.len()).map(|k| (0, k));
    let with_predecessor = (2..all.len()).map(|k| (k - 1, k));
    let one = |(from, to): (usize, usize), joint: Option<&bundle::Bundle>| {
        let joint = joint.map(|bundle| (bundle, [from, to]));
        let left_out = if from == 0 { carried[to].left_out.clone() } else { Vec::new() };
        let reference = given.as_ref().map(|(ids, from)| (&ids[..], *from));
        let renamed = if from == 0 { carried[to].renamed.clone() } else { HashMap::new() };
        let to = (to, &all[to]);
        pair::compared(Input { from: &all[from], to, reference, options, renamed: &renamed, left_out, joint })
    };
    let all_together = bundle::wanted(&all, options)?;
    let places: Vec<(usize, usize)> = with_first.chain(with_predecessor).collect();
    let mut pairs = Vec::new();
    for &pair in &places {
        pairs.push(one(pair, None)?);
        step()?;
    }
    let mut joint = None;
    if all_together {
        let stable = series::stable_in_all(&pairs[..all.len() - 1]);
        let points = bundle::points(&all, &stable);
        if points > bundle::MOST {
            bundle::refused(points, options)?;
            let note = PairNote::TooManyTogether { points, limit: bundle::MOST };
            pairs.iter_mut().for_each(|pair| pair.notes.push(note.clone()));
        } else if stable.len() >= LEAST {
            let renamed: Vec<&HashMap<String, String>> = carried.iter().map(|c| &c.renamed).collect();
            joint = Some(bundle::adjusted(&all, &renamed, &stable, options)?);
            pairs = places.iter().map(|&pair| one(pair, joint.as_ref())).collect::<Result<_>>()?;
        } else {
            pairs.iter_mut().for_each(|pair| pair.notes.push(PairNote::NotJoint));
        }
    }
    let (series, series_datum) = series::series(&all, &pairs, joint.as_ref(), options);
    step()?;
    let epochs = all.into_iter().map(|epoch| epoch.used).collect();
    let joint = joint.map(|bundle| bundle.told);
    Ok(Monitoring { method: options.method, joint, unit, axes, epochs, pairs, series, series_datum })
}

/// Options and names.
fn checked(epochs: &[Epoch], options: &Options) -> Result<()> {
    let invalid = |reason, at| Err(Error::Invalid { reason, at });
    if epochs.len() < 2 || epochs.len() > EPOCHS {
        return invalid(Reason::EpochsCount { given: epochs.len(), limit: EPOCHS }, Place::field("epochs"));
    }
    let mut names = BTreeSet::new();
    for (k, epoch) in epochs.iter().enumerate() {
        if !names.insert(epoch.name.as_str()) {
            return Err(Error::Duplicate { kind: Thing::Epoch, name: shortened(&epoch.name), at: at(k, "name") });
        }
    }
    for (name, value, most) in [("significance", options.significance, 0.5), ("power", options.power, 0.999_999)] {
        if !(value > 0.0 && value <= most) {
            return invalid(
                Reason::MonitoringProbability { name: name.into(), value: value.into() },
                Place::field(name),
            );
        }
    }
    if let Some(thresholds) = &options.thresholds {
        let all = thresholds.points.values().chain(thresholds.groups.values()).chain([&thresholds.all]);
        if !all.into_iter().all(|l| l.warning > 0.0 && l.warning <= l.alarm && l.alarm.is_finite()) {
            return invalid(Reason::MonitoringThresholds, Place::field("thresholds"));
        }
    }
    let mut groups = BTreeSet::new();
    for (k, group) in options.groups.iter().enumerate() {
        let place = || Place::field(format!("groups[{k}]"));
        if !groups.insert(group.name.as_str()) {
            return Err(Error::Duplicate { kind: Thing::Group, name: shortened(&group.name), at: place() });
        }
        let mut members = BTreeSet::new();
        if let Some(twice) = group.points.iter().find(|id| !members.insert(id.as_str())) {
            return Err(Error::Duplicate { kind: Thing::Point, name: shortened(twice), at: place() });
        }
    }
    Ok(())
}

/// The unit of all epochs.
fn one_unit(epochs: &[Prepared]) -> Result<Option<String>> {
    let stated = |epoch: &Prepared| epoch.unit.clone();
    let Some(first) = epochs.iter().find_map(stated) else { return Ok(None) };
    let same = |unit: &str| match (Unit::named(unit), Unit::named(&first)) {
        (Some(a), Some(b)) => a == b,
        _ => unit == first,
    };
    for (k, epoch) in epochs.iter().enumerate() {
        if let Some(unit) = epoch.unit.as_deref().filter(|unit| !same(unit)) {
            let (name, unit, expected) = (epoch.name.clone(), shortened(unit), first.clone());
            return Err(Error::Invalid { reason: Reason::EpochUnit { name, unit, expected }, at: at(k, "unit") });
        }
    }
    Ok(Some(first))
}

/// Named points are somewhere.
fn known_points(epochs: &[Prepared], options: &Options) -> Result<()> {
    let mut there: BTreeSet<&str> = epochs.iter().flat_map(|e| e.ids.iter().map(String::as_str)).collect();
    there.extend(epochs.iter().flat_map(|e| e.left_out.iter().map(|l| l.id.as_str())));
    let lists = [("reference", options.reference.as_deref().unwrap_or_default()), ("ignored", &options.ignored[..])];
    for (field, ids) in lists {
        if let Some(id) = ids.iter().find(|id| !there.contains(id.as_str())) {
            return Err(Error::Unknown { kind: Thing::Point, name: shortened(id), at: Place::field(field) });
        }
    }
    Ok(())
}

/// The reference points that the projects hold: control points, else datum points.
fn reference_of(epochs: &[Prepared], options: &Options) -> (Vec<String>, Option<ReferenceFrom>) {
    let ignored: BTreeSet<&String> = options.ignored.iter().collect();
    let gathered = |of: &dyn Fn(&Prepared) -> &Vec<String>| -> Vec<String> {
        let all: BTreeSet<&String> = epochs.iter().flat_map(of).filter(|id| !ignored.contains(id)).collect();
        all.into_iter().cloned().collect()
    };
    let (control, datum) = (gathered(&|e| &e.control), gathered(&|e| &e.datum));
    match (control.len() >= LEAST, datum.len() >= LEAST) {
        (true, _) => (control, Some(ReferenceFrom::Control)),
        (false, true) => (datum, Some(ReferenceFrom::Datum)),
        (false, false) => (Vec::new(), None),
    }
}
