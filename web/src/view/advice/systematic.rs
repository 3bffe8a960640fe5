//! Systematic residuals: the pattern, its cause and the remedy, as an item.

use sightline::adjustment::{Adjustment, Advice, PatternKind, Remedy};
use sightline::project::Parameter;

use super::{Item, Step, Target, parameter_name};
use crate::format;
use crate::i18n::{name_list, systematic as words};

/// The item about a named pattern; nothing of other advice.
pub fn item(advice: &Advice) -> Option<Item> {
    let Advice::ResidualPattern { camera, pattern, photos, p_value, max_px, sigma0, remedy, .. } = advice else {
        return None;
    };
    Some(sentences(camera, (*pattern, photos), [*max_px, *p_value, *sigma0], remedy))
}

/// The item about a pattern of a camera: its largest length in pixels, its probability by chance, sigma0 without it.
pub fn sentences(
    camera: &str,
    (pattern, photos): (PatternKind, &[String]),
    [max_px, p_value, sigma0]: [f64; 3],
    remedy: &Remedy,
) -> Item {
    let px = format::fixed(max_px, 2);
    let (title, cause) = match pattern {
        PatternKind::Radius => (words::radius(camera, px), words::radius_body()),
        PatternKind::Tangential => (words::tangential(camera, px), words::tangential_body()),
        PatternKind::Affine => (words::affine(camera, px), words::affine_body()),
        PatternKind::Row => (words::row(camera, px), words::read_out_body()),
        PatternKind::Column => (words::column(camera, px), words::read_out_body()),
        PatternKind::Position => (words::position(camera, px), words::position_body()),
        PatternKind::Photo if photos.is_empty() => (words::every_photo(camera, px), words::every_photo_body()),
        PatternKind::Photo => (words::photo(name_list(photos), px), words::photo_body()),
    };
    let (remedy, target) = match remedy {
        Remedy::Estimate { parameters } => (
            words::estimate(names(parameters)),
            Target::Estimate { camera: camera.to_owned(), parameters: parameters.clone() },
        ),
        Remedy::Model { models } => (words::other_model(models.join(", ")), Target::Step(Step::Adjust)),
        Remedy::HoldStill => (words::hold_still().to_owned(), Target::Step(Step::Photos)),
        Remedy::OwnCamera { photos } => {
            let target = photos.first().map_or(Target::Step(Step::Photos), |photo| Target::Photo(photo.clone()));
            (words::own_camera().to_owned(), target)
        }
        Remedy::PerPhoto => (words::per_photo().to_owned(), Target::Step(Step::Photos)),
        Remedy::Inspect => (words::inspect().to_owned(), Target::Step(Step::Results)),
    };
    // smaller probabilities are all the same to a person
    let p = if p_value < 1e-6 { "p < 0.000001".to_owned() } else { format!("p {}", format::fixed(p_value, 6)) };
    Item {
        warning: true,
        title,
        body: format!("{cause} {remedy} {}", words::not_noise()),
        evidence: format!("{p}, σ₀ → {}", format::fixed(sigma0, 2)),
        target,
    }
}

/// An item, with how many of its camera's photos were tested one by one where these are not all: of large networks they are a sample.
pub fn with_tested(mut item: Item, advice: &Advice, adjustment: &Adjustment) -> Item {
    let Advice::ResidualPattern { camera, pattern, .. } = advice else { return item };
    let named = adjustment.patterns.iter().find(|p| p.named && p.camera == *camera && p.kind == *pattern);
    if let Some(tested) = named.and_then(|pattern| pattern.photos_tested) {
        item.evidence = format!("{}, {}", item.evidence, words::photos_tested(tested));
    }
    item
}

/// Names of parameters, one after the other.
pub fn names(parameters: &[Parameter]) -> String {
    name_list(parameters.iter().map(|p| parameter_name(*p)))
}
