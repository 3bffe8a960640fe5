//! Identification of targets: by code, by an earlier measurement, by hand, by matching.

use std::collections::BTreeSet;

use leptos::prelude::*;
use sightline::detection::Target;
use sightline::matching::{Mark, Matching, Snapped, snap};
use sightline::project::{Observation, Sigma};
use sightline_exchange::mark_points;
use sightline_protocol::Measure;

use super::background::Stop;
use super::pool::TaskOutcome;
use super::{Desk, Kind};
use crate::document::Change;
use crate::edit::points::{self, Naming, Renamed};
use crate::edit::targets;
use crate::format;
use crate::i18n::background as words;
use crate::i18n::text;

/// Marks of an earlier measurement, waiting to be taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Marks {
    pub file: String,
    pub marks: Vec<Mark>,
    pub radius: f64,
}

impl Desk {
    /// The observation chosen in the photo that is shown.
    pub fn chosen_observation(self) -> Option<Observation> {
        let (photo, point) = self.selection.with(|s| (s.photo.clone(), s.point.clone()));
        let (photo, point) = (photo?, point?);
        self.document.with(|d| d.project.observations.iter().find(|o| o.photo == photo && o.point == point).cloned())
    }

    /// Gives a place of the photo a name: a target's centre, or a place set by hand.
    pub fn name_place(self, photo: &str, asked: PhotoPlace, point: &str) {
        let point = point.trim().to_owned();
        let found = match asked {
            PhotoPlace::Target(target) => self.document.with_untracked(|d| {
                let target = d.detections.get(photo)?.targets.get(target)?;
                Some(([target.u, target.v], Sigma::Two([target.sigma_u, target.sigma_v]), target.number()))
            }),
            PhotoPlace::Spot(spot) => Some((spot, Sigma::One(points::BY_HAND_SIGMA), None)),
        };
        let (Some(([u, v], sigma, target)), false) = (found, point.is_empty()) else { return };
        let (photo_id, id) = (photo.to_owned(), point.clone());
        let observation = Observation { photo: photo_id, point: id, u, v, sigma, enabled: true, target };
        let mut naming = Naming::default();
        self.change(Change::Named(point.clone()), |d| naming = points::observe(d.project_mut(), observation));
        self.selection.update(|s| (s.point, s.spot) = (Some(point.clone()), None));
        self.tell_naming(photo, &point, naming, matches!(asked, PhotoPlace::Spot(_)));
    }

    fn tell_naming(self, photo: &str, point: &str, naming: Naming, by_hand: bool) {
        let (photo, point) = (photo.to_owned(), point.to_owned());
        match naming {
            Naming { before: Some(before), .. } => {
                self.tell_here(move || text::name_taken_from(&before, &photo, &point));
            }
            Naming { elsewhere: true, .. } => self.tell_here(move || text::name_moved(&point, &photo)),
            _ if by_hand => self.tell_here(|| text::placed_by_hand().to_owned()),
            _ => {}
        }
    }

    /// Measures at a place of the photo; if there is nothing to measure, explains how to place a point freely.
    pub fn measure_at(self, photo: &str, u: f64, v: f64) {
        let file = self.photos.files.with_untracked(|f| f.get(photo).map(|f| (f.content.clone(), f.digest)));
        let Some((file, digest)) = file else {
            self.warn_here(|| text::no_photo_files().to_owned());
            return;
        };
        let mut options = self.processing.detect_options.get_untracked();
        options.codes = self.document.with_untracked(|d| targets::codes_of_one(options.codes, &d.rings));
        let photo = photo.to_owned();
        let on_outcome = move |outcome: TaskOutcome<Measure>| match outcome {
            TaskOutcome::Done(Some(target), _) => self.add_target(&photo, target),
            TaskOutcome::Done(None, _) => {
                self.tell_here(|| text::nothing_to_measure().to_owned());
            }
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        let stop = Stop(words::target, || ());
        self.ask(stop, Measure { digest, u, v, options }, vec![file], on_outcome);
    }

    /// A target measured on request joins the photo's list and is chosen: with its code for a name, or to be named.
    fn add_target(self, photo: &str, target: Target) {
        let code = target.code.map(|code| code.to_string());
        let (mut at, mut point) = (0, None);
        self.change(Change::TargetMeasured(photo.to_owned()), |document| {
            let (u, v, sigma) = (target.u, target.v, Sigma::Two([target.sigma_u, target.sigma_v]));
            at = targets::add(document, photo, target);
            let number = document.detections.get(photo).and_then(|d| d.targets.get(at)?.number());
            let project = document.project_mut();
            point = number.and_then(|id| points::observation_of(project, photo, id)).map(|o| o.point.clone());
            let free = |code: &String| !project.observations.iter().any(|o| o.photo == photo && o.point == *code);
            if let (None, Some(code)) = (&point, code.filter(free)) {
                let (photo, id) = (photo.to_owned(), code.clone());
                let observation = Observation { photo, point: id, u, v, sigma, enabled: true, target: number };
                points::observe(project, observation);
                point = Some(code);
            }
        });
        let unnamed = point.is_none();
        if unnamed && self.measuring.series.with_untracked(Option::is_some) {
            return self.take_in_series(photo, PhotoPlace::Target(at));
        }
        self.choose_in_photo(photo, Some(at), point);
    }

    /// A point name that is not in use.
    pub fn free_name(self) -> String {
        self.document.with_untracked(|d| points::free_name(&d.project))
    }

    /// Moves the chosen observation; its place is then by hand.
    pub fn nudge(self, step: [f64; 2]) {
        let Some(chosen) = untrack(|| self.chosen_observation()) else { return };
        let change = Change::Moved { point: chosen.point.clone(), photo: chosen.photo.clone() };
        self.change(change, |d| {
            points::nudge(d.project_mut(), &chosen.photo, &chosen.point, step);
        });
    }

    /// Takes an observation away; the target stays, without a name.
    pub fn remove_observation(self, photo: &str, point: &str) {
        let change = Change::ObservationRemoved { point: point.to_owned(), photo: photo.to_owned() };
        self.change(change, |d| points::remove_observation(d.project_mut(), photo, point));
        // A point goes with its last observation.
        let gone = self.document.with_untracked(|d| !d.project.points.iter().any(|p| p.id == point));
        if gone && self.selection.with_untracked(|s| s.point.as_deref() == Some(point)) {
            self.selection.update(|s| s.point = None);
            let point = point.to_owned();
            self.tell_here(move || text::point_went(&point));
        }
    }

    /// Lets an observation take part or not.
    pub fn switch_observation(self, photo: &str, point: &str, enabled: bool) {
        let change = Change::ObservationSwitched { point: point.to_owned(), photo: photo.to_owned() };
        self.change(change, |d| points::switch_observation(d.project_mut(), photo, point, enabled));
    }

    /// Lets an observation take part again that was set aside.
    pub fn take_back(self, photo: &str, point: &str) {
        let change = Change::ObservationSwitched { point: point.to_owned(), photo: photo.to_owned() };
        self.change(change, |d| points::take_back(d.project_mut(), photo, point));
    }

    /// Gives a point another name; an existing name joins the two, unless a photo shows both. False when it is refused.
    pub fn rename_point(self, from: &str, to: &str) -> bool {
        let to = to.trim().to_owned();
        if to.is_empty() || to == from {
            return to == from;
        }
        let clash = self.document.with_untracked(|d| points::shared_photo(&d.project, from, &to));
        let from = from.to_owned();
        if let Some(photo) = clash {
            self.warn_here(move || text::both_in_photo(&from, &to, &photo));
            return false;
        }
        let mut renamed = None;
        let change = Change::Renamed { from: from.clone(), to: to.clone() };
        self.change(change, |d| renamed = points::rename(d.project_mut(), &from, &to).ok());
        self.selection.update(|s| {
            s.point = Some(to.clone());
            s.renamed(Kind::Points, &from, &to);
        });
        match renamed {
            Some(Renamed::Joined { photos }) => {
                self.tell_here(move || text::points_joined(&from, &to, format::count(photos)));
            }
            Some(Renamed::Alone { photos }) => {
                self.tell_here(move || text::point_renamed(&from, &to, format::count(photos)));
            }
            None => {}
        }
        true
    }

    /// Gives what one photo shows of a point to another point. False when it is refused.
    pub fn rename_in_photo(self, photo: &str, from: &str, to: &str) -> bool {
        let to = to.trim().to_owned();
        if to.is_empty() || to == from {
            return to == from;
        }
        let mut naming = Naming::default();
        let change = Change::Renamed { from: from.to_owned(), to: to.clone() };
        self.change(change, |d| naming = points::rename_here(d.project_mut(), photo, from, &to));
        self.selection.update(|s| s.point = Some(to.clone()));
        self.tell_naming(photo, &to, naming, false);
        true
    }

    /// Takes a point out of the project with its observations and distances.
    pub fn remove_point(self, id: &str) {
        self.change(Change::PointRemoved(id.to_owned()), |d| points::remove(d.project_mut(), id));
        self.selection.update(|s| s.point = None);
    }

    /// Takes what matching found; what is doubtful is listed and not used. How many observations are new, and how many targets are
    /// doubtful.
    pub fn take_matching(self, matching: Matching) -> (usize, usize) {
        let doubtful = matching.doubtful.len();
        let before = self.document.with_untracked(|d| d.project.observations.len());
        let mut after = self.document.get_untracked();
        targets::take_matching(&mut after, matching);
        let found = after.project.observations.len().saturating_sub(before);
        match found {
            // A result stays current where nothing was added to what it was made from.
            0 => self.change_on(|document| document.doubtful = after.doubtful),
            _ => {
                self.change(Change::Matched(found), |document| *document = after);
                self.tell(move || text::matched(format::count(found), format::count(doubtful)));
            }
        }
        (found, doubtful)
    }

    /// Reads a file of marks, to be examined before they are taken; whether there are any.
    pub fn read_marks(self, file: String, content: &str) -> bool {
        match mark_points::parse(content) {
            Ok(marks) => {
                self.intake.marks.set(Some(Marks { file, marks, radius: 5.0 }));
                true
            }
            Err(error) => {
                self.warn_error(error.in_file(&file));
                false
            }
        }
    }

    /// Targets to which the measurements snap with the present radius.
    pub fn snapped(self) -> Option<(Marks, Snapped)> {
        let marks = self.intake.marks.get()?;
        let snapped = self.document.with(|d| snap(&marks.marks, &targets::by_photo(d), marks.radius));
        Some((marks, snapped))
    }

    /// Takes the marks that snapped as observations of the measured centres.
    pub fn take_marks(self, snapped: &Snapped) {
        let places = snapped.observations.iter().map(|o| (&o.photo, &o.point)).collect::<BTreeSet<_>>();
        self.change(Change::MarksTaken(places.len()), |d| {
            targets::take_marks(d.project_mut(), snapped);
        });
        self.intake.marks.set(None);
    }
}

/// A place in a photo that the user is asked to name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PhotoPlace {
    /// By its place in the photo's list of targets.
    Target(usize),
    Spot([f64; 2]),
}
