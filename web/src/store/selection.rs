//! The selection, shared by tables, photos, plots and the 3-D view.
//!
//! One thing of each kind is examined (`photo`, `point`, `target`, `spot`); any number may be marked besides, for what is
//! done with many at once. Choosing a thing in a table marks it alone; Control adds or takes away, Shift marks a range.

use crate::document::keys::{Kind, observation_key, observation_of_key};
use std::collections::{BTreeMap, BTreeSet};

use leptos::prelude::*;
use sightline::project::Observation;

use super::Desk;
use crate::document::Document;

/// How a row is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Marking {
    /// It alone.
    #[default]
    Only,
    /// It besides the others, or no more.
    Besides,
    /// All from the last one on.
    Range,
}

/// The selection, shared by photo, table and plot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    pub photo: Option<String>,
    pub point: Option<String>,
    /// Place in the photo's list of targets.
    pub target: Option<usize>,
    /// A position in the photo without a target, waiting for a name.
    pub spot: Option<[f64; 2]>,
    /// Marked for what is done with many at once: identifiers, and keys of observations and distances.
    pub(super) marked: BTreeMap<Kind, BTreeSet<String>>,
    /// Where a range begins.
    pub(super) anchor: Option<(Kind, String)>,
}

impl Selection {
    /// Selected rows of a kind.
    pub fn marked(&self, kind: Kind) -> Option<&BTreeSet<String>> {
        self.marked.get(&kind).filter(|keys| !keys.is_empty())
    }

    pub fn is_marked(&self, kind: Kind, key: &str) -> bool {
        self.marked.get(&kind).is_some_and(|keys| keys.contains(key))
    }

    /// Marks a row; `order` has the keys of the rows as they stand, for ranges.
    pub fn mark(&mut self, kind: Kind, key: &str, how: Marking, order: &[String]) {
        let keys = self.marked.entry(kind).or_default();
        let anchor = self.anchor.as_ref().filter(|(of, _)| *of == kind).map(|(_, key)| key.clone());
        let place = |key: &str| order.iter().position(|k| k == key);
        match (how, anchor.as_deref().and_then(place), place(key)) {
            (Marking::Range, Some(from), Some(to)) => {
                *keys = order[from.min(to)..=from.max(to)].iter().cloned().collect();
                return;
            }
            (Marking::Besides, ..) => {
                if !keys.remove(key) {
                    keys.insert(key.to_owned());
                }
            }
            _ => *keys = BTreeSet::from([key.to_owned()]),
        }
        self.anchor = Some((kind, key.to_owned()));
    }

    /// Marks just these.
    pub fn mark_all(&mut self, kind: Kind, keys: BTreeSet<String>) {
        self.marked.insert(kind, keys);
    }

    pub fn unmark(&mut self, kind: Kind) {
        self.marked.remove(&kind);
    }

    /// A thing has another name.
    pub fn renamed(&mut self, kind: Kind, from: &str, to: &str) {
        if self.marked.get_mut(&kind).is_some_and(|keys| keys.remove(from)) {
            self.marked.entry(kind).or_default().insert(to.to_owned());
        }
    }
}

/// Whether there is such a thing in the project.
fn exists(document: &Document, kind: Kind, key: &str) -> bool {
    let project = &document.project;
    match kind {
        Kind::Photos => project.photos.iter().any(|p| p.id == key),
        Kind::Cameras => project.cameras.iter().any(|c| c.id == key),
        Kind::Points => project.points.iter().any(|p| p.id == key),
        Kind::Distances => key.parse::<usize>().is_ok_and(|k| k < project.distances.len()),
        Kind::Targets => observation_of_key(key).is_some_and(|(photo, target)| {
            let number = target.parse().unwrap_or(0);
            document.detections.get(photo).is_some_and(|d| d.target(number).is_some())
        }),
        Kind::Observations => observation_of_key(key)
            .is_some_and(|(photo, point)| project.observations.iter().any(|o| o.photo == photo && o.point == point)),
    }
}

impl Desk {
    /// Selected and existing rows of a kind, in the order of keys.
    pub fn marked(self, kind: Kind) -> BTreeSet<String> {
        let keys = self.selection.with(|s| s.marked(kind).cloned()).unwrap_or_default();
        if keys.len() < 2 {
            return self.document.with(|d| keys.into_iter().filter(|key| exists(d, kind, key)).collect());
        }
        let there = self.document.with(|d| keys_of(d, kind));
        keys.into_iter().filter(|key| there.contains(key)).collect()
    }

    /// Chooses a row of a table: it is marked, and looked at.
    pub fn choose_row(self, kind: Kind, key: &str, how: Marking, order: &[String]) {
        self.selection.update(|s| s.mark(kind, key, how, order));
        if how == Marking::Besides && !self.selection.with_untracked(|s| s.is_marked(kind, key)) {
            return;
        }
        match kind {
            Kind::Photos => self.select_photo(key),
            Kind::Points => self.look_at_point(key),
            Kind::Observations => {
                if let Some((photo, point)) = observation_of_key(key) {
                    self.look_at_observation(photo, point);
                }
            }
            Kind::Targets => {
                if let Some((photo, target)) = observation_of_key(key) {
                    self.look_at_target(photo, target.parse().unwrap_or(0));
                }
            }
            Kind::Cameras | Kind::Distances => {}
        }
    }

    /// Chooses a point everywhere; a photo that shows it comes forward unless the present one does.
    pub fn select_point(self, point: &str) {
        self.selection.update(|s| s.mark(Kind::Points, point, Marking::Only, &[]));
        self.look_at_point(point);
    }

    fn look_at_point(self, point: &str) {
        let place = self.document.with_untracked(|d| {
            let of_point = || d.project.observations.iter().filter(|o| o.point == point);
            let here = self.selection.with_untracked(|s| s.photo.clone());
            of_point().find(|o| Some(&o.photo) == here.as_ref()).or_else(|| of_point().next()).cloned()
        });
        self.selection.update(|s| {
            s.point = Some(point.to_owned());
            (s.target, s.spot) = (None, None);
            if let Some(observation) = &place {
                s.photo = Some(observation.photo.clone());
            }
        });
        self.photo_view.centre_on.set(place.map(|o| [o.u, o.v]));
    }

    /// Chooses a point in one photo.
    pub fn select_observation(self, photo: &str, point: &str) {
        self.selection.update(|s| {
            s.mark(Kind::Points, point, Marking::Only, &[]);
            s.mark(Kind::Observations, &observation_key(photo, point), Marking::Only, &[]);
        });
        self.look_at_observation(photo, point);
    }

    fn look_at_observation(self, photo: &str, point: &str) {
        self.selection.update(|s| {
            s.photo = Some(photo.to_owned());
            s.point = Some(point.to_owned());
            (s.target, s.spot) = (None, None);
        });
        let place = self.document.with_untracked(|d| {
            let here = |o: &&Observation| o.photo == photo && o.point == point;
            d.project.observations.iter().find(here).map(|o| [o.u, o.v])
        });
        self.photo_view.centre_on.set(place);
    }

    /// Shows a target by its number, with the point it is.
    fn look_at_target(self, photo: &str, number: u32) {
        let found = self.document.with_untracked(|d| {
            let targets = &d.detections.get(photo)?.targets;
            let at = targets.iter().position(|t| t.id == number)?;
            let named = d.project.observations.iter().find(|o| o.photo == photo && o.target == Some(number));
            Some((at, [targets[at].u, targets[at].v], named.map(|o| o.point.clone())))
        });
        let Some((at, place, point)) = found else { return };
        self.selection.update(|s| {
            s.photo = Some(photo.to_owned());
            (s.target, s.point, s.spot) = (Some(at), point, None);
        });
        self.photo_view.centre_on.set(Some(place));
    }

    /// Meaning of a click in the photo: the target there with the name it has, else an observation that lies on no target.
    pub fn choose_in_photo(self, photo: &str, target: Option<usize>, point: Option<String>) {
        self.selection.update(|s| {
            if let Some(point) = &point {
                s.mark(Kind::Points, point, Marking::Only, &[]);
            }
            s.photo = Some(photo.to_owned());
            (s.target, s.point, s.spot) = (target, point, None);
        });
    }

    /// Chooses a place of the photo that has no target, to be named.
    pub fn choose_spot(self, photo: &str, spot: [f64; 2]) {
        self.selection.update(|s| {
            s.photo = Some(photo.to_owned());
            (s.target, s.point, s.spot) = (None, None, Some(spot));
        });
    }

    /// Leaves the chosen target or place without a name.
    pub fn ask_no_more(self) {
        if self.selection.with_untracked(|s| s.point.is_none() && (s.target.is_some() || s.spot.is_some())) {
            self.selection.update(|s| (s.target, s.spot) = (None, None));
        }
    }

    /// Takes back what is chosen or asked.
    pub fn escape(self) {
        self.messages.asking.set(None);
        self.end_modes();
        self.selection.update(|s| {
            *s = Selection { photo: s.photo.take(), ..Selection::default() };
        });
    }

    /// Shows a photo further on in the list.
    pub fn next_photo(self, step: isize) {
        let next = self.document.with_untracked(|d| {
            let now = self.selection.with_untracked(|s| s.photo.clone());
            let place = d.project.photos.iter().position(|p| Some(&p.id) == now.as_ref()).unwrap_or(0);
            d.project.photos.get(place.checked_add_signed(step)?).map(|p| p.id.clone())
        });
        if let Some(photo) = next {
            self.select_photo(&photo);
        }
    }

    /// Shows a photo, with nothing in it chosen.
    pub fn select_photo(self, photo: &str) {
        self.selection.update(|s| {
            if s.photo.as_deref() != Some(photo) {
                s.photo = Some(photo.to_owned());
                (s.target, s.spot) = (None, None);
            }
        });
    }
}

/// All keys of a kind.
fn keys_of(document: &Document, kind: Kind) -> BTreeSet<String> {
    let project = &document.project;
    match kind {
        Kind::Photos => project.photos.iter().map(|p| p.id.clone()).collect(),
        Kind::Cameras => project.cameras.iter().map(|c| c.id.clone()).collect(),
        Kind::Points => project.points.iter().map(|p| p.id.clone()).collect(),
        Kind::Observations => project.observations.iter().map(|o| observation_key(&o.photo, &o.point)).collect(),
        Kind::Distances => (0..project.distances.len()).map(|k| k.to_string()).collect(),
        Kind::Targets => {
            let of = |(photo, found): (&String, &std::sync::Arc<sightline::detection::Detection>)| {
                found.targets.iter().map(|t| observation_key(photo, &t.id.to_string())).collect::<Vec<_>>()
            };
            document.detections.iter().flat_map(of).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_marked_alone_besides_and_in_ranges() {
        let order = ["a", "b", "c", "d"].map(str::to_owned);
        let mut s = Selection::default();
        let marked = |s: &Selection| s.marked(Kind::Points).map(|keys| keys.iter().cloned().collect::<String>());
        s.mark(Kind::Points, "b", Marking::Only, &order);
        s.mark(Kind::Points, "d", Marking::Range, &order);
        assert_eq!(marked(&s).as_deref(), Some("bcd"));
        s.mark(Kind::Points, "a", Marking::Range, &order);
        assert_eq!(marked(&s).as_deref(), Some("ab"));
        s.mark(Kind::Points, "d", Marking::Besides, &order);
        s.mark(Kind::Points, "a", Marking::Besides, &order);
        assert_eq!(marked(&s).as_deref(), Some("bd"));
        s.renamed(Kind::Points, "d", "e");
        assert!(s.is_marked(Kind::Points, "e") && !s.is_marked(Kind::Photos, "e"));
        s.mark(Kind::Points, "c", Marking::Only, &order);
        assert_eq!(marked(&s).as_deref(), Some("c"));
        s.unmark(Kind::Points);
        assert!(marked(&s).is_none());
    }

    #[test]
    fn a_range_without_a_beginning_is_one_row() {
        let order = ["1\u{1f}a", "1\u{1f}b"].map(str::to_owned);
        let mut s = Selection::default();
        s.mark(Kind::Points, "9", Marking::Only, &[]);
        s.mark(Kind::Observations, &order[1], Marking::Range, &order);
        assert!(s.is_marked(Kind::Observations, &observation_key("1", "b")) && s.is_marked(Kind::Points, "9"));
        assert!(!s.is_marked(Kind::Observations, &order[0]));
        assert_eq!(observation_of_key(&order[0]), Some(("1", "a")));
    }
}
