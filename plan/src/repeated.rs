//! Detectable displacements of two campaigns taken as planned: the plan's network in the datum that the comparison will use.
//!
//! Reference points are chosen as [`sightline::monitoring::compare_epochs`] chooses them where none are named: the control points, else the
//! datum points, else all. Given coordinates are not used in either: they are the same in both campaigns, see
//! [`sightline::monitoring::ControlUse`].

use std::collections::BTreeSet;

use nalgebra::{Matrix3, Vector3};

use sightline::adjustment::Adjustment;
use sightline::monitoring::planned::{PlannedNetwork, detectable};
use sightline::monitoring::{LEAST, MOST, Options, ReferenceFrom};
use sightline::project::{Datum, DatumKind, Plan, Role};

use super::judgement::{JudgedNetwork, network};
use super::setup::{Setup, Shot};
use super::{PredictedPoint, Repeated};

/// The reference points of a comparison, by their places in the plan. `None` if there are too few, or more than it takes.
fn reference_of(setup: &Setup<'_>, takes_part: &[bool]) -> Option<(Vec<usize>, ReferenceFrom)> {
    let plan = setup.plan;
    let all = || (0..plan.points.len()).filter(|k| takes_part[*k]);
    let control: Vec<usize> = all().filter(|k| plan.points[*k].role == Role::Control).collect();
    let named: BTreeSet<usize> =
        plan.datum.points.iter().flatten().filter_map(|id| setup.index.get(id.as_str()).copied()).collect();
    let named: Vec<usize> = all().filter(|k| named.contains(k)).collect();
    let (chosen, from) = match (control.len() >= LEAST, named.len() >= LEAST) {
        (true, _) => (control, ReferenceFrom::Control),
        (false, true) => (named, ReferenceFrom::Datum),
        (false, false) => (all().collect(), ReferenceFrom::Common),
    };
    (LEAST..=MOST).contains(&chosen.len()).then_some((chosen, from))
}

/// The plan with inner constraints at these points and nothing given.
fn released(plan: &Plan, reference: &[usize]) -> Plan {
    let mut free = plan.clone();
    free.points.iter_mut().filter(|p| p.role == Role::Control).for_each(|p| {
        p.role = Role::Tie;
        p.sigma = None;
    });
    let points = reference.iter().map(|k| plan.points[*k].id.clone()).collect();
    free.datum = Datum { kind: DatumKind::Free, points: Some(points) };
    free
}

/// Whether the plan's own datum is that of the reference points.
fn is_own(setup: &Setup<'_>, takes_part: &[bool], reference: &[usize]) -> bool {
    let carriers: Vec<usize> = match &setup.plan.datum.points {
        Some(ids) => {
            let named: BTreeSet<usize> = ids.iter().filter_map(|id| setup.index.get(id.as_str()).copied()).collect();
            named.into_iter().filter(|k| takes_part[*k]).collect()
        }
        None => (0..takes_part.len()).filter(|k| takes_part[*k]).collect(),
    };
    setup.plan.datum.kind == DatumKind::Free && carriers == reference
}

/// Fills in the detectable displacement of each point and returns the reference it is against. `None` if the network is not determined without
/// given coordinates.
pub fn repeated(
    setup: &Setup<'_>,
    shots: &[&Shot],
    planned: (&[bool], &Adjustment),
    points: &mut [PredictedPoint],
) -> Option<Repeated> {
    let (reference, from) = reference_of(setup, planned.0)?;
    if is_own(setup, planned.0, &reference) {
        return filled(setup, planned, (reference, from), points);
    }
    let free = released(setup.plan, &reference);
    let free = Setup::new(&free).ok()?;
    let JudgedNetwork { takes_part, adjustment, .. } = network(&free, shots);
    let adjustment = adjustment.ok()?;
    // A control point with one ray is in the network of the plan and not in the free one.
    let reference: Vec<usize> = reference.into_iter().filter(|k| takes_part[*k]).collect();
    let enough = reference.len() >= LEAST;
    enough.then(|| filled(setup, (&takes_part, &adjustment), (reference, from), points)).flatten()
}

fn filled(
    setup: &Setup<'_>,
    (_, adjustment): (&[bool], &Adjustment),
    (reference, reference_from): (Vec<usize>, ReferenceFrom),
    points: &mut [PredictedPoint],
) -> Option<Repeated> {
    let known = adjustment.points.iter().filter_map(|p| {
        let [xx, xy, xz, yy, yz, zz] = p.covariance?;
        let at = *setup.index.get(p.id.as_str())?;
        Some((at, Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)))
    });
    let (at, covariances): (Vec<usize>, Vec<Matrix3<f64>>) = known.unzip();
    let places: Vec<Vector3<f64>> = at.iter().map(|k| setup.places[*k]).collect();
    let carriers: BTreeSet<usize> = reference.iter().copied().collect();
    let rows: Vec<usize> = (0..at.len()).filter(|row| carriers.contains(&at[*row])).collect();
    if rows.len() != reference.len() {
        return None;
    }
    let bar = |id: &str| setup.index.get(id).is_some_and(|k| at.contains(k));
    let scaled = setup.plan.distances.iter().any(|d| bar(&d.from) && bar(&d.to));
    let redundancy = adjustment.redundancy;
    let options = Options::default();
    let network = PlannedNetwork { places: &places, covariances: &covariances, reference: &rows, scaled, redundancy };
    for (k, found) in at.iter().zip(detectable(&network, &options)) {
        points[*k].detectable = found;
    }
    let worst = |p: &PredictedPoint| p.detectable.map(|d| d.worst);
    let last = points.iter().filter(|p| p.detectable.is_some()).max_by(|a, b| {
        let [a, b] = [a, b].map(|p| worst(p).unwrap_or_default());
        a.total_cmp(&b)
    });
    let ids = |places: &[usize]| places.iter().map(|k| setup.plan.points[*k].id.clone()).collect();
    Some(Repeated {
        reference: ids(&reference),
        reference_from,
        significance: options.significance,
        power: options.power,
        redundancy: 2 * redundancy,
        point: last.map(|p| p.id.clone()),
        largest: last.and_then(worst),
    })
}
