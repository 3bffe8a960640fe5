//! Measuring by hand, point after point through the photos: each click is stored at once, and the next photo that should
//! show the point is shown.

use std::collections::BTreeSet;

use leptos::prelude::*;
use sightline::matching::Prediction;

use super::Desk;
use super::identity::PhotoPlace;
use crate::edit::points;
use crate::edit::questions::Question;
use crate::i18n::text;

/// Measuring point after point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Name of the next new point.
    pub next: String,
    /// The photo in which the present point was begun, and the next one will be.
    home: Option<String>,
}

/// How near a place is examined: photo pixels on either side, at least.
const NEAR: f64 = 60.0;
/// How far, in standard errors, a ray may deviate from the others for a prediction to be accepted.
const SOUND: f64 = 5.0;

/// Signals of measuring and naming points by hand.
#[derive(Clone, Copy, Default)]
pub struct Measuring {
    /// Measuring of point after point through the photos, if it is on.
    pub series: RwSignal<Option<Series>>,
    /// Whether clicks in a photo place points without measuring a target there, as with Alt.
    pub placing: RwSignal<bool>,
    /// The open question of matching that is shown.
    pub question: RwSignal<Option<Question>>,
}

impl Desk {
    /// Begins or ends measuring point after point.
    pub fn switch_series(self) {
        let next = self.free_name();
        self.measuring.series.update(|series| {
            *series = match series {
                Some(_) => None,
                None => Some(Series { next, home: None }),
            };
        });
    }

    /// Gives the next new point of the series its name.
    pub fn set_next_name(self, typed: &str) {
        let name = typed.trim().to_owned();
        if !name.is_empty() {
            self.measuring.series.update(|series| {
                if let Some(series) = series {
                    series.next = name;
                }
            });
        }
    }

    pub fn in_series(self) -> bool {
        self.measuring.series.with(Option::is_some)
    }

    /// Whether the chosen point is measured in the photo that is shown.
    pub fn measured_here(self) -> bool {
        self.chosen_observation().is_some()
    }

    /// Takes a place of the photo for the point of the series, or begins the next one with it, and goes on.
    pub fn take_in_series(self, photo: &str, asked: PhotoPlace) {
        let point = self.selection.with_untracked(|s| s.point.clone()).filter(|_| !untrack(|| self.measured_here()));
        let Some(series) = self.measuring.series.get_untracked() else { return };
        let name = match &point {
            Some(point) => point.clone(),
            None => self.document.with_untracked(|d| points::next_free(&d.project, &series.next)),
        };
        self.name_place(photo, asked, &name);
        if point.is_none() {
            let next = self.document.with_untracked(|d| points::next_free(&d.project, &name));
            self.measuring.series.set(Some(Series { next, home: Some(photo.to_owned()) }));
        }
        self.next_place();
    }

    /// Photos further on in the list, round to the present one, in which the chosen point should be and is not measured.
    fn further_photos(self) -> Vec<String> {
        let (here, point) = self.selection.with_untracked(|s| (s.photo.clone(), s.point.clone()));
        // A point contradicted by its own rays is no evidence about the photos that should not show it.
        let sound =
            |p: &Prediction| p.rays > 2 && p.photos.iter().all(|photo| photo.off_sigmas.is_none_or(|off| off < SOUND));
        let prediction = untrack(|| self.prediction()).filter(|p| sound(p));
        self.document.with_untracked(|d| {
            let photos = &d.project.photos;
            let of_point = d.project.observations.iter().filter(|o| Some(&o.point) == point.as_ref());
            let measured = of_point.map(|o| o.photo.as_str()).collect::<BTreeSet<_>>();
            let unseen = |photo: &str| {
                let known = prediction.as_ref().and_then(|p| p.photos.iter().find(|p| p.photo == photo));
                known.is_some_and(|p| p.place.is_some() && !p.inside)
            };
            let at = photos.iter().position(|p| Some(&p.id) == here.as_ref()).unwrap_or(0);
            let further = (1..photos.len()).map(|k| &photos[(at + k) % photos.len()]);
            let further = further.filter(|p| p.enabled && !measured.contains(p.id.as_str()) && !unseen(&p.id));
            further.map(|p| p.id.clone()).collect()
        })
    }

    /// Shows the next photo in which the chosen point should be; in a series a point that is in all of them is done.
    pub fn next_place(self) {
        if self.selection.with_untracked(|s| s.point.is_none()) {
            return self.next_photo(1);
        }
        match self.further_photos().into_iter().next() {
            Some(photo) => self.look_for_point(&photo),
            None if self.measuring.series.with_untracked(Option::is_some) => self.finish_point(),
            None => self.tell_here(|| text::in_all_it_should_be().to_owned()),
        }
    }

    /// Shows a photo where it should show the chosen point.
    pub fn look_for_point(self, photo: &str) {
        let prediction = untrack(|| self.prediction());
        self.select_photo(photo);
        let predicted = prediction.as_ref().and_then(|p| p.photos.iter().find(|p| p.photo == photo));
        if let Some((place, ellipse)) = predicted.and_then(|p| Some((p.place?, p.ellipse(3.0)))) {
            self.photo_view.show_place.set(Some((place, NEAR.max(2.0 * ellipse.map_or(0.0, |ellipse| ellipse[0])))));
        }
    }

    /// Ends the present point of the series: the next one begins where this one did.
    pub fn finish_point(self) {
        let home = self.measuring.series.with_untracked(|s| s.as_ref().and_then(|s| s.home.clone()));
        self.selection.update(|s| (s.point, s.target, s.spot) = (None, None, None));
        if let Some(home) = home {
            self.select_photo(&home);
        }
    }

    /// Targets of the photo that may be the chosen point, nearest first: places in its list, and distances in standard errors.
    /// None where the point is measured here; targets with a name are not offered.
    pub fn candidates_here(self) -> Vec<(usize, f64)> {
        let (Some(photo), false) = (self.selection.with(|s| s.photo.clone()), self.measured_here()) else {
            return Vec::new();
        };
        let Some(predicted) = self.prediction_here() else { return Vec::new() };
        self.document.with(|d| {
            let Some(found) = d.detections.get(&photo) else { return Vec::new() };
            let of_photo = d.project.observations.iter().filter(|o| o.photo == photo);
            let named = of_photo.filter_map(|o| o.target).collect::<BTreeSet<_>>();
            let mut near = predicted.candidates(&found.targets);
            near.retain(|(k, _)| found.targets[*k].number().is_none_or(|id| !named.contains(&id)));
            near
        })
    }

    /// Takes the target that lies nearest to where the chosen point should be, or measures there; then goes on.
    pub fn take_candidate(self) {
        let (photo, point) = self.selection.with_untracked(|s| (s.photo.clone(), s.point.clone()));
        let (Some(photo), Some(point)) = (photo, point) else { return };
        if let Some((target, _)) = untrack(|| self.candidates_here()).first().copied() {
            self.name_place(&photo, PhotoPlace::Target(target), &point);
            self.next_place();
        } else if let Some([u, v]) = untrack(|| self.prediction_here()).and_then(|p| p.place)
            && !untrack(|| self.measured_here())
        {
            self.measure_at(&photo, u, v);
        }
    }
}
