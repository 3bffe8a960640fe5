//! Summary for the client: what was measured, its accuracy and datum, and data that were not used.

use crate::context::{Context, listed};
use crate::html::{Html, escaped};
use crate::number::{count, fixed};
use sightline::adjustment::Termination;
use sightline::project::DatumKind;

use super::left_out::{self, LeftOut};

pub fn write(context: &Context, html: &mut Html) {
    let (words, adjustment) = (context.words, context.adjustment);
    let estimated = adjustment.cameras.iter().any(|camera| !camera.sigma.is_empty());
    let cameras = context.project.cameras.iter().filter(|camera| {
        let photos = context.project.photos.iter().filter(|photo| photo.camera == camera.id);
        photos.into_iter().any(|photo| adjustment.photos.iter().any(|found| found.id == photo.id))
    });
    let (points, photos, cameras) =
        (count(adjustment.points.len()), count(adjustment.photos.len()), count(cameras.count()));
    let mut lead = if estimated {
        words.measured_self_calibrating(&points, &photos, &cameras)
    } else {
        words.measured(&points, &photos, &cameras)
    };
    for sentence in [datum(context), scale(context)] {
        lead = format!("{lead} {sentence}");
    }
    let left_out = LeftOut::of(context);
    if !left_out.is_empty() {
        lead = format!("{lead} {}", left_out.sentence(context));
    }
    let questions = super::network::questions(context);
    let mut verdict = tested(context);
    if !questions.is_empty() {
        // A test that passes hides none of them.
        verdict = format!("{verdict} {}", words.open_questions(&count(questions.len())));
    }
    html.element("p", "verdict", &verdict).element("p", "lead", &lead);
    for question in questions {
        html.p(&question);
    }
    accuracy(context, html);
    checked(context, html);
    left_out::summary(context, html);
}

/// Reference of the coordinates.
pub fn datum(context: &Context) -> String {
    let words = context.words;
    match context.project.datum.kind {
        DatumKind::Control => {
            let ids: Vec<&str> = context.used_control().map(|point| point.id.as_str()).collect();
            words.datum_control(&count(ids.len()), &listed(ids.iter().copied(), 12))
        }
        DatumKind::Free => match &context.project.datum.points {
            Some(points) => words.datum_free_chosen(&count(points.len())),
            None => words.datum_free().to_owned(),
        },
        DatumKind::Minimal => words.datum_minimal().to_owned(),
    }
}

/// Where lengths have their size from.
pub fn scale(context: &Context) -> String {
    let words = context.words;
    let distances = used_distances(context);
    match distances.len() {
        _ if !context.scaled => words.scale_none().to_owned(),
        0 => words.scale_control().to_owned(),
        n => words.scale_distances(&count(n)),
    }
}

/// Distances that took part.
pub fn used_distances<'a>(context: &Context<'a>) -> Vec<&'a sightline::adjustment::GivenObservation> {
    let is_distance =
        |what: &sightline::adjustment::Given| matches!(what, sightline::adjustment::Given::Distance { .. });
    context.adjustment.given.iter().filter(|given| given.enabled && is_distance(&given.what)).collect()
}

/// Whether the observations agree with what was assumed of them.
fn tested(context: &Context) -> String {
    let (words, adjustment) = (context.words, context.adjustment);
    if adjustment.termination != Termination::Converged {
        return words.not_converged().to_owned();
    }
    if let Some(estimated) = super::statistics::estimated(context) {
        return words.standard_errors_estimated(&estimated);
    }
    let Some((sigma0, test)) = adjustment.sigma0.zip(adjustment.global_test.as_ref()) else {
        return words.nothing_checked().to_owned();
    };
    let sigma0 = fixed(sigma0, 3);
    let percent = fixed(100.0 * adjustment.criteria.global_alpha, 0);
    match (test.passed, test.statistic > test.upper) {
        (true, _) => words.test_passed(&sigma0, &percent),
        (false, true) => words.test_too_large(&sigma0, &percent),
        (false, false) => words.test_too_small(&sigma0, &percent),
    }
}

/// The probability of a coverage factor, percent.
pub fn confidence(k: f64) -> String {
    let percent = 100.0 * libm::erf(k / std::f64::consts::SQRT_2);
    // 2 is spoken of as 95 %, 3 as 99.7 %.
    if percent < 99.0 { fixed(percent.floor(), 0) } else { fixed((percent * 10.0).floor().min(999.0) / 10.0, 1) }
}

fn accuracy(context: &Context, html: &mut Html) {
    let words = context.words;
    let Some(sigma) = context.mean_sigma() else {
        html.p(words.no_statistics());
        return;
    };
    let k = context.settings().coverage_factor;
    let (factor, percent) = (fixed(k, usize::from(k.fract() != 0.0)), confidence(k));
    if !context.scaled {
        // A coordinate that is known to so much of nothing is known to nothing.
        return;
    }
    html.open("div", "stated");
    let value = format!("± {}", context.with_unit(k * sigma));
    let sentence = words.known_to(&"\u{1}", &factor, &percent);
    let (before, after) = sentence.split_once('\u{1}').unwrap_or((sentence.as_str(), ""));
    html.raw(&format!("<p>{}<b>{}</b>{}</p>\n", escaped(before), escaped(&value), escaped(after)));
    if let Some((point, axis, sigma)) = context.weakest() {
        html.note(&words.least_certain(&point, &context.axes.letter(axis), &context.with_unit(k * sigma)));
    }
    html.note(words.within_the_network());
    html.close("div");
}

/// Known values that were not used, compared with the results.
fn checked(context: &Context, html: &mut Html) {
    let (words, adjustment) = (context.words, context.adjustment);
    if let Some(check) = adjustment.check_statistics.as_ref().filter(|check| check.count > 0) {
        html.p(&words.check_points_agree(&count(check.count), &context.with_unit(check.rms_all)));
    } else {
        html.p(words.no_independent_check());
    }
}
