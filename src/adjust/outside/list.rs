//! The list of data that were not used.

use std::collections::{HashMap, HashSet};

use crate::adjust::gross_errors::start::LEAST;
use crate::adjustment::{
    Adjustment, Given, GrossError, GrossErrorAction, LeftOutBy, LeftOutItem, LeftOutKind, LeftOutReason,
};
use crate::project::{DatumKind, Project, Role, SetAside, SetAsideBy, SetAsideReason};

use super::control::ControlDiscrepancy;

/// Everything of the document that was not used in an adjustment: photos, control, distances, points, observations of other kinds,
/// image observations. `predicted` has the prediction errors of rows, `control` the comparison of control points.
pub fn left_out(
    document: &Project,
    adjustment: &Adjustment,
    predicted: &HashMap<usize, f64>,
    control: &[ControlDiscrepancy],
) -> Vec<LeftOutItem> {
    let list = List::new(document, adjustment);
    let mut items = list.photos();
    items.extend(list.control(control));
    items.extend(list.given());
    items.extend(list.distances());
    items.extend(list.points());
    items.extend(list.observations(predicted));
    items
}

struct List<'a> {
    document: &'a Project,
    adjustment: &'a Adjustment,
    aside: HashMap<(&'a str, &'a str), &'a SetAside>,
    photos: HashSet<&'a str>,
    points: HashSet<&'a str>,
    disabled: HashSet<&'a str>,
    /// Rows of every photo and point, as places in the document.
    of_photo: HashMap<&'a str, Vec<usize>>,
    of_point: HashMap<&'a str, Vec<usize>>,
}

fn item(kind: LeftOutKind, by: LeftOutBy, reason: LeftOutReason) -> LeftOutItem {
    LeftOutItem { kind, photo: None, point: None, given: None, by, reason, size_px: None, size: None, size_sigma: None }
}

fn of_set_aside(aside: &SetAside) -> (LeftOutBy, LeftOutReason) {
    let by = match aside.by {
        SetAsideBy::Orientation => LeftOutBy::Orientation,
        SetAsideBy::Matching => LeftOutBy::Matching,
    };
    let reason = match aside.reason {
        SetAsideReason::Disagrees => LeftOutReason::Disagrees,
        SetAsideReason::PhotoNotOriented => LeftOutReason::PhotoNotOriented,
        SetAsideReason::PointNotDetermined => LeftOutReason::PointNotDetermined,
        SetAsideReason::Undecided => LeftOutReason::Undecided,
    };
    (by, reason)
}

impl<'a> List<'a> {
    fn new(document: &'a Project, adjustment: &'a Adjustment) -> Self {
        let mut of_photo: HashMap<&str, Vec<usize>> = HashMap::new();
        let mut of_point: HashMap<&str, Vec<usize>> = HashMap::new();
        for (row, o) in document.observations.iter().enumerate() {
            of_photo.entry(&o.photo).or_default().push(row);
            of_point.entry(&o.point).or_default().push(row);
        }
        Self {
            document,
            adjustment,
            aside: document.set_aside.iter().map(|s| ((s.photo.as_str(), s.point.as_str()), s)).collect(),
            photos: adjustment.photos.iter().map(|p| p.id.as_str()).collect(),
            points: adjustment.points.iter().map(|p| p.id.as_str()).collect(),
            disabled: document.photos.iter().filter(|p| !p.enabled).map(|p| p.id.as_str()).collect(),
            of_photo,
            of_point,
        }
    }

    /// Why none of these rows took part: what took out the first that was set aside, `fallback` where none was.
    fn why(&self, rows: Option<&Vec<usize>>, fallback: LeftOutReason) -> (LeftOutBy, LeftOutReason) {
        let rows = rows.map_or(&[][..], Vec::as_slice);
        let aside = rows.iter().filter_map(|&row| self.set_aside(row));
        let first =
            aside.min_by_key(|s| (s.reason != SetAsideReason::Disagrees, s.reason != SetAsideReason::Undecided));
        if let Some(aside) = first {
            return of_set_aside(aside);
        }
        let off = |row: &usize| {
            let o = &self.document.observations[*row];
            !o.enabled || self.disabled.contains(o.photo.as_str())
        };
        match rows.is_empty() || !rows.iter().all(off) {
            true => (LeftOutBy::Adjustment, fallback),
            false => (LeftOutBy::Document, LeftOutReason::Disabled),
        }
    }

    fn set_aside(&self, row: usize) -> Option<&'a SetAside> {
        let o = &self.document.observations[row];
        self.aside.get(&(o.photo.as_str(), o.point.as_str())).copied()
    }

    fn photos(&self) -> Vec<LeftOutItem> {
        let out = self.document.photos.iter().filter(|p| !self.photos.contains(p.id.as_str()));
        let one = |photo: &crate::project::Photo| {
            let (by, reason) = match photo.enabled {
                false => (LeftOutBy::Document, LeftOutReason::Disabled),
                true => self.why(self.of_photo.get(photo.id.as_str()), LeftOutReason::NotMeasured),
            };
            LeftOutItem { photo: Some(photo.id.clone()), ..item(LeftOutKind::Photo, by, reason) }
        };
        out.map(one).collect()
    }

    fn control(&self, compared: &[ControlDiscrepancy]) -> Vec<LeftOutItem> {
        if self.document.datum.kind != DatumKind::Control {
            return Vec::new();
        }
        let points = self.document.points.iter().enumerate();
        let out =
            points.filter(|(_, p)| p.role == Role::Control && p.xyz.is_some() && !self.points.contains(p.id.as_str()));
        let one = |(k, point): (usize, &crate::project::Point)| {
            let (by, reason) = self.why(self.of_point.get(point.id.as_str()), LeftOutReason::NotMeasured);
            let found = compared.iter().find(|c| c.point == k);
            LeftOutItem {
                point: Some(point.id.clone()),
                size: found.map(|c| c.difference[0].hypot(c.difference[1]).hypot(c.difference[2])),
                size_sigma: found.map(|c| c.ratio),
                ..item(LeftOutKind::Control, by, reason)
            }
        };
        out.map(one).collect()
    }

    /// The last entry of the record for an observation, if that took it out.
    fn removed(&self, same: impl Fn(&GrossError) -> bool) -> Option<&'a GrossError> {
        let last = self.adjustment.gross_errors.iter().rev().find(|entry| same(entry));
        last.filter(|entry| entry.action == GrossErrorAction::Removed)
    }

    fn given(&self) -> Vec<LeftOutItem> {
        let weightless = |weight: Option<f64>| weight.is_some_and(|w| w <= LEAST * LEAST);
        let out = self.adjustment.given.iter().filter(|g| !g.enabled || weightless(g.weight));
        let one = |given: &crate::adjustment::GivenObservation| {
            let (kind, photo, point) = match &given.what {
                Given::Control { point, .. } => (LeftOutKind::Control, None, Some(point.clone())),
                Given::Position { photo, .. } => (LeftOutKind::Position, Some(photo.clone()), None),
                Given::Distance { .. } => (LeftOutKind::Distance, None, None),
                Given::Parameter { photo, .. } => (LeftOutKind::Parameter, photo.clone(), None),
            };
            let (by, reason) = match given.enabled {
                true => (LeftOutBy::Robust, LeftOutReason::NoWeight),
                false => (LeftOutBy::Snooping, LeftOutReason::GrossError),
            };
            let entry = self.removed(|entry| entry.given.as_ref() == Some(&given.what));
            LeftOutItem {
                photo,
                point,
                given: Some(given.what.clone()),
                size: given.residual.map(f64::abs),
                size_sigma: entry.map(|entry| entry.statistic.abs()),
                ..item(kind, by, reason)
            }
        };
        out.map(one).collect()
    }

    fn distances(&self) -> Vec<LeftOutItem> {
        let used = |from: &str, to: &str| {
            let what = |given: &Given| matches!(given, Given::Distance { from: a, to: b } if a == from && b == to);
            self.adjustment.given.iter().any(|given| what(&given.what))
        };
        let out = self.document.distances.iter().filter(|d| !d.check && !used(&d.from, &d.to));
        let one = |distance: &crate::project::Distance| {
            let ends = [distance.from.as_str(), distance.to.as_str()];
            let lost = ends.into_iter().find(|end| !self.points.contains(end)).unwrap_or(ends[0]);
            let (by, _) = self.why(self.of_point.get(lost), LeftOutReason::NotMeasured);
            let reason = match self.of_point.contains_key(lost) {
                true => LeftOutReason::PointNotDetermined,
                false => LeftOutReason::NotMeasured,
            };
            let given = Given::Distance { from: distance.from.clone(), to: distance.to.clone() };
            LeftOutItem { given: Some(given), ..item(LeftOutKind::Distance, by, reason) }
        };
        out.map(one).collect()
    }

    /// Points that are measured, but not in what took part; control points have an item of their own.
    fn points(&self) -> Vec<LeftOutItem> {
        let controlled = self.document.datum.kind == DatumKind::Control;
        let out = self.document.points.iter().filter(|p| {
            let measured = self.of_point.contains_key(p.id.as_str());
            measured && !self.points.contains(p.id.as_str()) && !(controlled && p.role == Role::Control)
        });
        let one = |point: &crate::project::Point| {
            let (by, reason) = self.why(self.of_point.get(point.id.as_str()), LeftOutReason::PointNotDetermined);
            LeftOutItem { point: Some(point.id.clone()), ..item(LeftOutKind::Point, by, reason) }
        };
        out.map(one).collect()
    }

    fn observations(&self, predicted: &HashMap<usize, f64>) -> Vec<LeftOutItem> {
        let pixels: HashMap<&str, [f64; 2]> =
            self.adjustment.photos.iter().map(|photo| (photo.id.as_str(), photo.pixel)).collect();
        let mut items = Vec::new();
        for (row, (o, adjusted)) in self.document.observations.iter().zip(&self.adjustment.observations).enumerate() {
            let weightless = adjusted.weight.is_some_and(|weight| weight <= LEAST * LEAST);
            if adjusted.enabled && !weightless {
                continue;
            }
            let entry = self.removed(|e| e.given.is_none() && e.photo == o.photo && e.point == o.point);
            let aside = self.set_aside(row).filter(|_| !o.enabled);
            let (by, reason) = match (aside, entry) {
                _ if adjusted.enabled => (LeftOutBy::Robust, LeftOutReason::NoWeight),
                _ if self.disabled.contains(o.photo.as_str()) => (LeftOutBy::Document, LeftOutReason::PhotoDisabled),
                (_, Some(entry)) if entry.consequence => (LeftOutBy::Snooping, LeftOutReason::Consequence),
                (_, Some(_)) => (LeftOutBy::Snooping, LeftOutReason::GrossError),
                (Some(aside), None) => of_set_aside(aside),
                (None, None) if !o.enabled => (LeftOutBy::Document, LeftOutReason::Disabled),
                (None, None) => (LeftOutBy::Adjustment, LeftOutReason::PointNotDetermined),
            };
            let residual = adjusted.vx.zip(adjusted.vy).zip(pixels.get(o.photo.as_str()));
            let seen = residual.map(|((vx, vy), pixel)| (vx / pixel[0]).hypot(vy / pixel[1]));
            let own = entry.filter(|entry| !entry.consequence).map(|entry| entry.statistic.abs());
            items.push(LeftOutItem {
                photo: Some(o.photo.clone()),
                point: Some(o.point.clone()),
                size_px: seen.or(aside.and_then(|aside| aside.distance_px)).filter(|px| px.is_finite()),
                size_sigma: predicted.get(&row).copied().or(own),
                ..item(LeftOutKind::Observation, by, reason)
            });
        }
        items
    }
}
