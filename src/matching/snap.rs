//! Snaps approximate positions, such as those of an earlier measurement, to measured centres.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::{PhotoTargets, observed};
use crate::project::Observation;

/// An approximate measurement: a point seen at a place of a photo.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// Identifier of the photo.
    pub photo: String,
    /// Identifier of the point.
    pub point: String,
    /// To the right, pixels.
    pub u: f64,
    /// Downwards, pixels.
    pub v: f64,
    /// Standard error in pixels.
    pub sigma: f64,
}

/// Why a mark found no target.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "reason", rename_all = "snake_case")]
pub enum UnsnappedReason {
    /// No targets are known for the photo.
    NoDetection,
    /// No target lies within the radius.
    NoTarget,
    /// Marks of other points are about as near to the same target.
    Contested {
        /// The other points.
        points: Vec<String>,
    },
    /// The point is marked more than once in the photo.
    MarkedTwice,
}

/// A mark that stays where it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Unsnapped {
    /// The mark.
    pub mark: Mark,
    /// Why.
    #[serde(flatten)]
    pub reason: UnsnappedReason,
}

/// Result of [`snap`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Snapped {
    /// Observations at measured centres, in the order of the marks.
    pub observations: Vec<Observation>,
    /// The other marks, in their order.
    pub unsnapped: Vec<Unsnapped>,
}

/// A mark takes a contested target only when it is nearer than this share of the next mark's distance.
const CLEARLY_NEARER: f64 = 0.5;

/// Moves each mark onto the nearest target of its photo within `radius_px`.
///
/// Where marks of several points have the same nearest target, it goes to the one that is less than half as far as the
/// next; the others, or all of them, are reported. Nothing is dropped: every mark comes back in one list or the other.
pub fn snap(marks: &[Mark], photos: &[PhotoTargets], radius_px: f64) -> Snapped {
    let targets: BTreeMap<&str, &PhotoTargets> = photos.iter().map(|p| (p.photo.as_str(), p)).collect();
    let mut times_marked: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for mark in marks {
        *times_marked.entry((&mark.photo, &mark.point)).or_default() += 1;
    }
    // Nearest target of every mark, and the marks that want each target.
    let mut wanted: BTreeMap<(&str, usize), Vec<(f64, usize)>> = BTreeMap::new();
    let mut nearest: Vec<Option<usize>> = vec![None; marks.len()];
    for (k, mark) in marks.iter().enumerate() {
        let Some(photo) = targets.get(mark.photo.as_str()) else { continue };
        let distances =
            photo.targets.iter().enumerate().map(|(t, target)| ((target.u - mark.u).hypot(target.v - mark.v), t));
        let found = distances.filter(|(d, _)| *d <= radius_px).min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((distance, t)) = found {
            nearest[k] = Some(t);
            wanted.entry((&photo.photo, t)).or_default().push((distance, k));
        }
    }
    let mut winners = BTreeSet::new();
    for claims in wanted.values_mut() {
        claims.sort_by(|a, b| a.0.total_cmp(&b.0));
        if claims.len() == 1 || claims[0].0 < CLEARLY_NEARER * claims[1].0 {
            winners.insert(claims[0].1);
        }
    }
    let mut snapped = Snapped::default();
    for (k, mark) in marks.iter().enumerate() {
        let reason = match (targets.get(mark.photo.as_str()), nearest[k]) {
            _ if times_marked[&(mark.photo.as_str(), mark.point.as_str())] > 1 => UnsnappedReason::MarkedTwice,
            (None, _) => UnsnappedReason::NoDetection,
            (_, None) => UnsnappedReason::NoTarget,
            (Some(photo), Some(t)) if winners.contains(&k) => {
                snapped.observations.push(observed(&mark.photo, &mark.point, &photo.targets[t]));
                continue;
            }
            (Some(photo), Some(t)) => {
                let claims = &wanted[&(photo.photo.as_str(), t)];
                let others = claims.iter().filter(|(_, other)| *other != k);
                UnsnappedReason::Contested { points: others.map(|(_, other)| marks[*other].point.clone()).collect() }
            }
        };
        snapped.unsnapped.push(Unsnapped { mark: mark.clone(), reason });
    }
    snapped
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matching::target;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn mark(photo: &str, point: &str, u: f64, v: f64) -> Mark {
        Mark { photo: photo.into(), point: point.into(), u, v, sigma: 0.1 }
    }

    #[test]
    fn every_mark_comes_back_once_with_its_reason() {
        let photos = [PhotoTargets {
            photo: "a".into(),
            targets: vec![target(10.0, 10.0, None), target(50.0, 10.0, None), target(90.0, 10.0, None)],
        }];
        let marks = [
            mark("a", "1", 11.0, 10.0), // clearly nearer than point 2
            mark("a", "2", 10.0, 13.0),
            mark("a", "3", 49.0, 10.0), // as near as point 4
            mark("a", "4", 50.0, 11.2),
            mark("a", "5", 70.0, 70.0), // nothing there
            mark("b", "1", 10.0, 10.0), // photo without targets
            mark("a", "6", 90.0, 10.0), // marked twice
            mark("a", "6", 91.0, 10.0),
        ];
        let snapped = snap(&marks, &photos, 5.0);
        assert_eq!(snapped.observations.len(), 1);
        assert_eq!((snapped.observations[0].point.as_str(), snapped.observations[0].u), ("1", 10.0));
        let contested = |p: &str| UnsnappedReason::Contested { points: vec![p.into()] };
        let reasons: Vec<_> = snapped.unsnapped.iter().map(|u| u.reason.clone()).collect();
        use UnsnappedReason::{MarkedTwice, NoDetection, NoTarget};
        assert_eq!(
            reasons,
            [contested("1"), contested("4"), contested("3"), NoTarget, NoDetection, MarkedTwice, MarkedTwice]
        );
    }
}
