//! Who is who: names of targets, by code, by an earlier measurement, by hand, by matching.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use leptos::prelude::*;
use sightline::detection::{Detection, Target};
use sightline::exchange::mark_points;
use sightline::matching::{Mark, Matching, PhotoTargets, Snapped, name_coded, snap};
use sightline::project::{Observation, Point, Project, Role, Sigma};
use sightline_protocol::Measure;

use super::document::{Change, Document};
use super::pool::Outcome;
use super::{Desk, Step};
use crate::format;
use crate::i18n::text;

/// Standard error of a place that was set by hand, in pixels.
pub const BY_HAND_SIGMA: f64 = 0.5;
/// How far a name follows its target when the photo is measured again, in pixels.
const FOLLOW: f64 = 2.0;

/// Marks of an earlier measurement, waiting to be taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Marks {
    pub file: String,
    pub marks: Vec<Mark>,
    pub radius: f64,
}

impl Document {
    /// Targets of all photos, as matching takes them.
    pub fn photo_targets(&self) -> Vec<PhotoTargets> {
        let of = |(photo, detection): (&String, &Arc<Detection>)| PhotoTargets {
            photo: photo.clone(),
            targets: detection.targets.clone(),
        };
        self.detections.iter().map(of).collect()
    }

    /// Takes a new detection of a photo: names follow their targets, codes name the rest.
    pub fn take_detection(&mut self, photo: &str, detection: Detection) {
        let new = [PhotoTargets { photo: photo.to_owned(), targets: detection.targets.clone() }];
        let old = self.detections.get(photo).cloned();
        let (before, others): (Vec<_>, Vec<_>) =
            self.project.observations.iter().cloned().partition(|o: &Observation| o.photo == photo);
        let coded = name_coded(&new);
        let mut doubtful = (*self.doubtful).clone();
        doubtful.retain(|d| d.photo != photo);
        doubtful.extend(coded.doubtful);
        self.doubtful = Arc::new(doubtful);
        let project = self.project_mut();
        let marks = before.iter().map(|o| Mark {
            photo: photo.to_owned(),
            point: o.point.clone(),
            u: o.u,
            v: o.v,
            sigma: o.sigma.both()[0],
        });
        let snapped = snap(&marks.collect::<Vec<_>>(), &new, FOLLOW);
        let mut now = coded.observations;
        let named = now.iter().map(|o| (o.point.clone(), place(o.u, o.v))).collect::<Vec<_>>();
        let free = |o: &Observation| !named.iter().any(|(point, at)| *point == o.point || *at == place(o.u, o.v));
        now.extend(snapped.observations.into_iter().filter(free));
        let was_target = |o: &Observation| {
            old.as_ref().is_some_and(|d| d.targets.iter().any(|t| place(t.u, t.v) == place(o.u, o.v)))
        };
        let still_here = now.iter().map(|o| o.point.clone()).collect::<BTreeSet<_>>();
        now.extend(before.iter().filter(|o| !still_here.contains(&o.point) && !was_target(o)).cloned());
        for observation in &mut now {
            if let Some(earlier) = before.iter().find(|o| o.point == observation.point) {
                observation.enabled = earlier.enabled;
            }
        }
        project.observations = others;
        project.observations.append(&mut now);
        tidy_points(project);
        self.detections_mut().insert(photo.to_owned(), Arc::new(detection));
    }

    /// Names a target, a place or an earlier observation of a photo.
    fn observe(&mut self, observation: Observation) {
        let project = self.project_mut();
        let same = |o: &Observation| {
            o.photo == observation.photo
                && (o.point == observation.point || place(o.u, o.v) == place(observation.u, observation.v))
        };
        project.observations.retain(|o| !same(o));
        project.observations.push(observation);
        tidy_points(project);
    }
}

/// A place as something that can be compared: names belong to exactly the centre they were given to.
pub fn place(u: f64, v: f64) -> (u64, u64) {
    (u.to_bits(), v.to_bits())
}

/// Every observed point is in the list; tie points that nothing observes and nothing names are not.
fn tidy_points(project: &mut Project) {
    let observed = project.observations.iter().map(|o| o.point.as_str()).collect::<BTreeSet<_>>();
    let in_distance = |id: &str| project.distances.iter().any(|d| d.from == id || d.to == id);
    let keep = |p: &Point| p.role != Role::Tie || observed.contains(p.id.as_str()) || in_distance(&p.id);
    let mut points = project.points.iter().filter(|p| keep(p)).cloned().collect::<Vec<_>>();
    let known = points.iter().map(|p| p.id.clone()).collect::<BTreeSet<_>>();
    let new =
        observed.iter().filter(|id| !known.contains(**id)).map(|id| Point { id: (*id).to_owned(), ..Point::default() });
    let mut new = new.collect::<Vec<_>>();
    new.sort_by(|a, b| super::intake::natural(&a.id, &b.id));
    points.extend(new);
    project.points = points;
}

fn sigma_of(target: &Target) -> Sigma {
    Sigma::Two([target.sigma_u, target.sigma_v])
}

impl Desk {
    /// The observation chosen in the photo that is shown.
    pub fn chosen_observation(self) -> Option<Observation> {
        let (photo, point) = self.selection.with(|s| (s.photo.clone(), s.point.clone()));
        let (photo, point) = (photo?, point?);
        self.document.with(|d| d.project.observations.iter().find(|o| o.photo == photo && o.point == point).cloned())
    }

    /// Chooses a point everywhere; a photo that shows it comes forward unless the present one does.
    pub fn select_point(self, point: &str) {
        let place = self.document.with_untracked(|d| {
            let of_point = || d.project.observations.iter().filter(|o| o.point == point);
            let here = self.selection.with_untracked(|s| s.photo.clone());
            of_point().find(|o| Some(&o.photo) == here.as_ref()).or_else(|| of_point().next()).cloned()
        });
        self.selection.update(|s| {
            s.point = Some(point.to_owned());
            s.target = None;
            if let Some(observation) = &place {
                s.photo = Some(observation.photo.clone());
            }
        });
        self.centre_on.set(place.map(|o| [o.u, o.v]));
    }

    /// Chooses a point in one photo.
    pub fn select_observation(self, photo: &str, point: &str) {
        self.selection.update(|s| {
            s.photo = Some(photo.to_owned());
            s.point = Some(point.to_owned());
            s.target = None;
        });
        let place = self.document.with_untracked(|d| {
            let here = |o: &&Observation| o.photo == photo && o.point == point;
            d.project.observations.iter().find(here).map(|o| [o.u, o.v])
        });
        self.centre_on.set(place);
    }

    /// Gives the selected target of the photo a name.
    pub fn name_target(self, photo: &str, target: usize, point: &str) {
        let point = point.trim().to_owned();
        let found =
            self.document.with_untracked(|d| d.detections.get(photo).and_then(|d| d.targets.get(target).cloned()));
        let (Some(target), false) = (found, point.is_empty()) else { return };
        let photo = photo.to_owned();
        let sigma = sigma_of(&target);
        self.change(Change::Named(point.clone()), |document| {
            document.observe(Observation {
                photo,
                point: point.clone(),
                u: target.u,
                v: target.v,
                sigma,
                enabled: true,
            });
        });
        self.selection.update(|s| s.point = Some(point));
    }

    /// Leaves the chosen target without a name.
    pub fn ask_no_more(self) {
        if self.selection.with_untracked(|s| s.target.is_some()) {
            self.selection.update(|s| s.target = None);
        }
    }

    /// Measures at a place of the photo; where there is nothing to measure, the place itself is taken.
    pub fn measure_at(self, photo: &str, u: f64, v: f64) {
        let file = self.files.with_untracked(|f| f.get(photo).map(|f| (f.content.clone(), f.digest)));
        let Some((file, digest)) = file else {
            self.warn(|| text::no_photo_files().to_owned());
            return;
        };
        let options = self.detect_options.get_untracked();
        let photo = photo.to_owned();
        let on_outcome = move |outcome: Outcome<Measure>| match outcome {
            Outcome::Done(Some(target), _) => self.add_target(&photo, target),
            Outcome::Done(None, _) => {
                self.tell(|| text::placed_by_hand().to_owned());
                self.add_by_hand(&photo, u, v);
            }
            Outcome::Failed(failure) => self.tell_failure(failure),
            Outcome::Progress(nothing) => match nothing {},
        };
        self.pool.with_value(|pool| pool.submit_first(Measure { digest, u, v, options }, vec![file], on_outcome));
    }

    /// A target measured on request joins the photo's list and is chosen, to be named.
    fn add_target(self, photo: &str, target: Target) {
        let mut at = 0;
        self.change(Change::TargetMeasured(photo.to_owned()), |document| {
            let detections = document.detections_mut();
            let mut detection = detections.get(photo).map(|d| (**d).clone()).unwrap_or_default();
            let same = |t: &Target| (t.u - target.u).hypot(t.v - target.v) < 0.5;
            at = detection.targets.iter().position(same).unwrap_or(detection.targets.len());
            if at == detection.targets.len() {
                detection.targets.push(target);
            }
            detections.insert(photo.to_owned(), Arc::new(detection));
        });
        self.selection.update(|s| {
            s.photo = Some(photo.to_owned());
            s.target = Some(at);
            s.point = None;
        });
    }

    fn add_by_hand(self, photo: &str, u: f64, v: f64) {
        let point = self.free_name();
        let photo = photo.to_owned();
        self.change(Change::Named(point.clone()), |document| {
            document.observe(Observation {
                photo,
                point: point.clone(),
                u,
                v,
                sigma: Sigma::One(BY_HAND_SIGMA),
                enabled: true,
            });
        });
        self.selection.update(|s| {
            s.point = Some(point);
            s.target = None;
        });
    }

    /// A point name that is not in use.
    pub fn free_name(self) -> String {
        self.document.with_untracked(|d| {
            let largest = d.project.points.iter().filter_map(|p| p.id.parse::<u64>().ok()).max().unwrap_or(0);
            (largest.max(9000) + 1).to_string()
        })
    }

    /// Moves the chosen observation; its place is then by hand.
    pub fn nudge(self, step: [f64; 2]) {
        let Some(chosen) = untrack(|| self.chosen_observation()) else { return };
        let change = Change::Moved { point: chosen.point.clone(), photo: chosen.photo.clone() };
        self.change(change, |document| {
            let same = |o: &&mut Observation| o.photo == chosen.photo && o.point == chosen.point;
            if let Some(observation) = document.project_mut().observations.iter_mut().find(same) {
                observation.u += step[0];
                observation.v += step[1];
                observation.sigma = Sigma::One(BY_HAND_SIGMA);
            }
        });
    }

    /// Takes an observation away; the target stays, without a name.
    pub fn remove_observation(self, photo: &str, point: &str) {
        let change = Change::ObservationRemoved { point: point.to_owned(), photo: photo.to_owned() };
        self.change(change, |document| {
            let project = document.project_mut();
            project.observations.retain(|o| o.photo != photo || o.point != point);
            tidy_points(project);
        });
    }

    /// Lets an observation take part or not.
    pub fn switch_observation(self, photo: &str, point: &str, enabled: bool) {
        let change = Change::ObservationSwitched { point: point.to_owned(), photo: photo.to_owned() };
        self.change(change, |document| {
            for o in &mut document.project_mut().observations {
                if o.photo == photo && o.point == point {
                    o.enabled = enabled;
                }
            }
        });
    }

    /// Gives a point another name; an existing name joins the two, unless a photo shows both.
    pub fn rename_point(self, from: &str, to: &str) {
        let to = to.trim().to_owned();
        if to.is_empty() || to == from {
            return;
        }
        let clash = self.document.with_untracked(|d| {
            let photos = |id: &str| {
                let of = d.project.observations.iter().filter(|o| o.point == id);
                of.map(|o| o.photo.clone()).collect::<BTreeSet<_>>()
            };
            photos(from).intersection(&photos(&to)).next().cloned()
        });
        if let Some(photo) = clash {
            let from = from.to_owned();
            self.warn(move || text::both_in_photo(&from, &to, &photo));
            return;
        }
        let change = Change::Renamed { from: from.to_owned(), to: to.clone() };
        self.change(change, |document| {
            let project = document.project_mut();
            for o in project.observations.iter_mut().filter(|o| o.point == from) {
                o.point = to.clone();
            }
            for d in &mut project.distances {
                for end in [&mut d.from, &mut d.to] {
                    if *end == from {
                        *end = to.clone();
                    }
                }
            }
            if let Some(points) = &mut project.datum.points {
                for id in points.iter_mut().filter(|id| *id == from) {
                    *id = to.clone();
                }
            }
            let exists = project.points.iter().any(|p| p.id == to);
            if exists {
                project.points.retain(|p| p.id != from);
            } else if let Some(point) = project.points.iter_mut().find(|p| p.id == from) {
                point.id = to.clone();
            }
            tidy_points(project);
        });
        self.selection.update(|s| s.point = Some(to));
    }

    /// Takes a point out of the project with its observations and distances.
    pub fn remove_point(self, id: &str) {
        self.change(Change::PointRemoved(id.to_owned()), |document| {
            let project = document.project_mut();
            project.observations.retain(|o| o.point != id);
            project.distances.retain(|d| d.from != id && d.to != id);
            project.points.retain(|p| p.id != id);
        });
        self.selection.update(|s| s.point = None);
    }

    /// Takes what matching found; what is doubtful is listed and not used.
    pub fn take_matching(self, matching: Matching) {
        let found = matching.observations.len();
        let doubtful = matching.doubtful.len();
        self.change(Change::Matched(found), |document| {
            document.doubtful = Arc::new(matching.doubtful);
            let project = document.project_mut();
            let taken =
                project.observations.iter().map(|o| (o.photo.clone(), o.point.clone())).collect::<BTreeSet<_>>();
            let centres =
                project.observations.iter().map(|o| (o.photo.clone(), place(o.u, o.v))).collect::<BTreeSet<_>>();
            let new = |o: &Observation| {
                !taken.contains(&(o.photo.clone(), o.point.clone()))
                    && !centres.contains(&(o.photo.clone(), place(o.u, o.v)))
            };
            project.observations.extend(matching.observations.into_iter().filter(new));
            for point in matching.points {
                if !project.points.iter().any(|p| p.id == point.id) {
                    project.points.push(Point { xyz: None, ..point });
                }
            }
            tidy_points(project);
        });
        self.tell(move || text::matched(format::count(found), format::count(doubtful)));
    }

    /// Reads a file of marks and shows what they would become.
    pub fn read_marks(self, file: String, content: &str) {
        match mark_points::parse(content) {
            Ok(marks) => {
                self.marks.set(Some(Marks { file, marks, radius: 5.0 }));
                self.go(Step::Identities);
            }
            Err(error) => self.warn_error(error.in_file(&file)),
        }
    }

    /// What the marks snap to at the radius that is set.
    pub fn snapped(self) -> Option<(Marks, Snapped)> {
        let marks = self.marks.get()?;
        let snapped = self.document.with(|d| snap(&marks.marks, &d.photo_targets(), marks.radius));
        Some((marks, snapped))
    }

    /// Takes the marks that snapped as observations of the measured centres.
    pub fn take_marks(self, snapped: &Snapped) {
        let mut taken = BTreeMap::<(String, String), Observation>::new();
        for o in &snapped.observations {
            taken.insert((o.photo.clone(), o.point.clone()), o.clone());
        }
        let centres = taken.values().map(|o| (o.photo.clone(), place(o.u, o.v))).collect::<BTreeSet<_>>();
        self.change(Change::MarksTaken(taken.len()), |document| {
            let project = document.project_mut();
            let replaced = |o: &Observation| {
                taken.contains_key(&(o.photo.clone(), o.point.clone()))
                    || centres.contains(&(o.photo.clone(), place(o.u, o.v)))
            };
            project.observations.retain(|o| !replaced(o));
            project.observations.extend(taken.into_values());
            tidy_points(project);
        });
        self.marks.set(None);
    }
}
