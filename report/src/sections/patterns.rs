//! Systematic patterns of the residuals, their causes and remedies, in sentences.

use crate::context::{Context, listed};
use crate::names::parameter_name;
use crate::number::fixed;
use sightline::adjustment::{PatternKind, Remedy};
use sightline::project::Parameter;

/// Sentences on the cause and the remedy of a pattern; `max_px` is its largest displacement in pixels.
pub fn sentence(
    context: &Context,
    camera: &str,
    (pattern, photos): (PatternKind, &[String]),
    max_px: f64,
    remedy: &Remedy,
) -> String {
    let words = context.words;
    let px = fixed(max_px, 2);
    let names = |photos: &[String]| listed(photos.iter().map(String::as_str), 8);
    let cause = match pattern {
        PatternKind::Radius => words.pattern_radius(&camera, &px),
        PatternKind::Tangential => words.pattern_tangential(&camera, &px),
        PatternKind::Affine => words.pattern_affine(&camera, &px),
        PatternKind::Row => words.pattern_row(&camera, &px),
        PatternKind::Column => words.pattern_column(&camera, &px),
        PatternKind::Position => words.pattern_position(&camera, &px),
        PatternKind::Photo if photos.is_empty() => words.pattern_every_photo(&camera, &px),
        PatternKind::Photo => words.pattern_photo(&names(photos), &px),
    };
    let parameters = |all: &[Parameter]| listed(all.iter().map(|p| parameter_name(*p)), 8);
    let remedy = match remedy {
        Remedy::Estimate { parameters: held } => words.remedy_estimate(&parameters(held)),
        Remedy::Model { models } => words.remedy_model(&listed(models.iter().map(String::as_str), 8)),
        Remedy::HoldStill => words.remedy_hold_still().to_owned(),
        Remedy::OwnCamera { .. } => words.remedy_own_camera().to_owned(),
        Remedy::PerPhoto => words.remedy_per_photo().to_owned(),
        Remedy::Inspect => words.remedy_inspect().to_owned(),
    };
    format!("{cause} {remedy}")
}
