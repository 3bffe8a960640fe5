//! Units of displayed lengths and residuals.

use sightline::adjustment::{Adjustment, Advice, PhotoUnit};
use sightline::project::{Camera, Project};
pub use sightline_report::names::{common_unit, factors};

use crate::document::Document;
use crate::i18n::text;

/// The unit of adjusted lengths: none where nothing gave them a scale.
pub fn unit_of(adjustment: &Adjustment, project: &Project) -> String {
    if adjustment.advice.contains(&Advice::NoScale) { text::no_unit().to_owned() } else { project.unit.clone() }
}

/// The same of the document's result, or the project's unit before there is one.
pub fn length_unit(document: &Document) -> String {
    document.current().map_or_else(|| document.project.unit.clone(), |r| unit_of(&r.adjustment, &document.project))
}

/// Width and height of a pixel in the unit of the camera's residuals.
pub fn pixel_of(camera: &Camera) -> [f64; 2] {
    PhotoUnit::of(camera).1
}

/// How residuals of a camera are shown.
pub fn shown_as(camera: Option<&Camera>) -> (f64, &'static str) {
    sightline_report::names::shown(camera.map(|camera| PhotoUnit::of(camera).0).unwrap_or_default())
}
