//! Observations of other kinds than image coordinates in words, and the way to them.

use sightline::adjustment::Given;

use super::parameters::parameter_name;
use crate::i18n::text;
use crate::store::{Desk, Step, axes_here};

/// The observation, by name: a point or photo with its axis, the ends of a distance, a parameter of a camera.
pub fn given_name(what: &Given) -> String {
    let axes = axes_here();
    let axis = |axis: usize| axes.letter(axis);
    match what {
        Given::Control { point: id, axis: a } | Given::Position { photo: id, axis: a } => format!("{id} {}", axis(*a)),
        Given::Distance { from, to } => format!("{from} – {to}"),
        Given::Parameter { camera, photo, parameter } => {
            let photo = photo.as_ref().map(|photo| format!(" · {photo}")).unwrap_or_default();
            format!("{camera}{photo} {}", parameter_name(*parameter))
        }
    }
}

/// The kind in words.
pub fn given_kind(what: &Given) -> &'static str {
    match what {
        Given::Control { .. } => text::control_coordinate(),
        Given::Position { .. } => text::projection_centre(),
        Given::Distance { .. } => text::distance(),
        Given::Parameter { .. } => text::camera_parameter(),
    }
}

/// Goes to where the observation can be seen and changed.
pub fn follow(desk: Desk, photo: &str, point: &str, given: Option<&Given>) {
    match given {
        None => {
            desk.select_observation(photo, point);
            desk.go(Step::Identities);
        }
        Some(Given::Control { point, .. }) => {
            desk.select_point(point);
            desk.go(Step::Control);
        }
        Some(Given::Distance { from, .. }) => {
            desk.select_point(from);
            desk.go(Step::Control);
        }
        Some(Given::Position { photo, .. }) => {
            desk.select_photo(photo);
            desk.go(Step::Identities);
        }
        Some(Given::Parameter { .. }) => desk.go(Step::Adjust),
    }
}
