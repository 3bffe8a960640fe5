//! Settings for reproducing the result: options, a priori values, versions and digests of every input.

use crate::context::Context;
use crate::html::{Html, Table};
use crate::number::{compact, count, fixed};
use crate::{digest, names};
use sightline::adjustment::{AdjustOptions, ResidualPlace, Robust, StatisticsChoice, Termination};
use sightline::project::Sigma;

pub fn write(context: &Context, html: &mut Html) {
    let words = context.words;
    html.h3(words.options()).pairs(&options(context));
    html.h3(words.estimated_parameters()).table(parameters(context));
    super::origin::write(context, html);
    html.h3(words.inputs()).p(words.inputs_explained());
    html.open("div", "digest");
    let mut table = Table::new().words(words.input()).words("SHA-256");
    // The document was read from JSON or can be written as it: a failure would have been told before.
    table.row(vec![words.the_document().to_owned(), digest(context.project).unwrap_or_default()]);
    for photo in &context.project.photos {
        let known = if photo.sha256.is_empty() { words.not_recorded().to_owned() } else { photo.sha256.clone() };
        let file = if photo.file.is_empty() { String::new() } else { format!(" {}", photo.file) };
        table.row(vec![format!("{} {}{file}", words.photo(), photo.id), known]);
    }
    html.table(table.dense()).close("div");
}

fn options(context: &Context) -> Vec<(String, String)> {
    let (words, a) = (context.words, context.adjustment);
    let AdjustOptions { max_iterations, statistics, robust, snooping, residuals, unmodelled, target_diameter, .. } =
        &a.options;
    let yes = |on: bool| if on { words.yes() } else { words.no() }.to_owned();
    let termination = match a.termination {
        Termination::Converged => words.converged(),
        Termination::IterationLimit => words.iteration_limit(),
        Termination::Diverged => words.diverged(),
        Termination::Stopped => words.stopped(),
    };
    let mut sigmas: Vec<f64> = context
        .project
        .observations
        .iter()
        .filter(|o| o.enabled)
        .flat_map(|o| match o.sigma {
            Sigma::One(s) => [s, s],
            Sigma::Two(s) => s,
        })
        .collect();
    sigmas.sort_by(f64::total_cmp);
    let image = match (sigmas.first(), sigmas.last()) {
        (Some(least), Some(most)) if least == most => format!("{} px", compact(*least)),
        (Some(least), Some(most)) => format!("{} … {} px", compact(*least), compact(*most)),
        _ => "–".to_owned(),
    };
    vec![
        (words.software().to_owned(), format!("Sightline {}", env!("CARGO_PKG_VERSION"))),
        (words.termination().to_owned(), format!("{termination} ({})", count(a.iterations.len()))),
        (words.max_iterations().to_owned(), count(*max_iterations)),
        (words.a_priori_image().to_owned(), image),
        (
            words.residuals_taken().to_owned(),
            match residuals {
                ResidualPlace::Measured => words.residuals_measured(),
                ResidualPlace::Corrected => words.residuals_corrected(),
            }
            .to_owned(),
        ),
        (
            words.statistics().to_owned(),
            match statistics {
                StatisticsChoice::None => words.statistics_none(),
                StatisticsChoice::Precision => words.statistics_precision(),
                StatisticsChoice::Full => words.statistics_full(),
            }
            .to_owned(),
        ),
        (words.snooping().to_owned(), yes(*snooping)),
        (
            words.robust().to_owned(),
            match robust {
                None => words.no(),
                Some(Robust::Huber) => "Huber",
                Some(Robust::Tukey) => "Tukey",
            }
            .to_owned(),
        ),
        (words.variance_components().to_owned(), yes(a.options.variance_components.is_some())),
        (words.unmodelled_px().to_owned(), fixed(*unmodelled, if *unmodelled > 0.0 { 3 } else { 0 })),
        (words.target_diameter().to_owned(), target_diameter.map_or("–".to_owned(), |d| context.in_unit(&compact(d)))),
    ]
}

fn parameters(context: &Context) -> Table {
    let words = context.words;
    let mut table = Table::new().words(words.camera()).words(words.free()).words(words.observed()).words(words.held());
    for camera in &context.project.cameras {
        let names = |wanted: &dyn Fn(&sightline::project::Parameter) -> bool| {
            let all = camera.interior.parameters().iter().filter(|p| wanted(p)).map(|p| names::parameter_name(*p));
            all.collect::<Vec<_>>().join(", ")
        };
        let observed = |p: &sightline::project::Parameter| camera.sigma.contains_key(p);
        let free = |p: &sightline::project::Parameter| camera.free.contains(p) && !observed(p);
        let focal = free(&sightline::project::Parameter::F) || observed(&sightline::project::Parameter::F);
        let held = |p: &sightline::project::Parameter| {
            use sightline::project::Parameter as P;
            let is_focal = matches!(p, P::F) || (focal && matches!(p, P::Fx | P::Fy));
            !free(p) && !observed(p) && !is_focal
        };
        table.row(vec![camera.id.clone(), names(&free), names(&observed), names(&held)]);
    }
    table
}
