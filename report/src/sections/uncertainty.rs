//! Contributions that the stated uncertainty includes and those it does not.
//! Source: JCGM 100:2008 (Guide to the Expression of Uncertainty in Measurement), 6.2 and 7.2.

use crate::context::{Context, listed, smallest};
use crate::html::Html;
use crate::names::parameter_name;
use crate::number::{count, decimals_for, fixed};
use sightline::adjustment::Given;
use sightline::project::DatumKind;

use super::summary::{confidence, used_distances};

pub fn write(context: &Context, html: &mut Html) {
    let words = context.words;
    let Some(sigma) = context.mean_sigma() else { return };
    let settings = context.settings();
    let k = settings.coverage_factor;
    let factor = fixed(k, usize::from(k.fract() != 0.0));
    let expanded = context.with_unit(k * sigma);
    if context.scaled {
        html.p(&words.gum_statement(&context.with_unit(sigma), &factor, &expanded, &confidence(k)));
    } else {
        html.p(words.scale_none());
    }
    html.h3(words.gum_included()).list(&included(context));
    html.h3(words.gum_not_included()).list(&not_included(context));
}

/// Contributions, and how they were evaluated.
fn included(context: &Context) -> Vec<String> {
    let (words, a, project) = (context.words, context.adjustment, context.project);
    let mut all = Vec::new();
    let mut sigmas: Vec<f64> = project.observations.iter().filter(|o| o.enabled).flat_map(|o| o.sigma.both()).collect();
    sigmas.sort_by(f64::total_cmp);
    if let Some(median) = sigmas.get(sigmas.len() / 2) {
        all.push(words.gum_image(&fixed(*median, decimals_for(*median))));
    }
    if a.options.unmodelled > 0.0 {
        all.push(words.gum_unmodelled(&fixed(a.options.unmodelled, decimals_for(a.options.unmodelled))));
    }
    for component in a.variance_components.iter().filter_map(|c| c.unmodelled.filter(|u| *u > 0.0)) {
        all.push(words.gum_unmodelled(&fixed(component, decimals_for(component))));
    }
    if let Some(estimated) = super::statistics::estimated(context) {
        all.push(words.gum_estimated(&estimated));
    }
    if let Some(sigma0) = a.sigma0 {
        all.push(words.gum_sigma0(&fixed(sigma0, 3), &count(a.redundancy)));
    }
    let estimated = a.cameras.iter().flat_map(|camera| camera.sigma.keys().map(|p| parameter_name(*p)));
    let mut estimated: Vec<&str> = estimated.collect();
    estimated.sort_unstable();
    estimated.dedup();
    if !estimated.is_empty() {
        all.push(words.gum_cameras(&estimated.join(", ")));
    }
    let control: Vec<f64> =
        a.given.iter().filter(|g| g.enabled && matches!(g.what, Given::Control { .. })).map(|g| g.sigma).collect();
    if !control.is_empty() {
        let range = range(context, &control);
        all.push(words.gum_control(&count(control.len()), &range));
    }
    let distances = used_distances(context);
    if !distances.is_empty() {
        let sigmas: Vec<f64> = distances.iter().map(|g| g.sigma).collect();
        all.push(words.gum_scale(&count(distances.len()), &range(context, &sigmas)));
        if let Some(part) = relative_scale(context) {
            all.push(words.gum_scale_relative(
                &fixed(part * 1e6, decimals_for(part * 1e6)),
                &context.with_unit(part * largest(context)),
            ));
        }
    }
    all
}

fn largest(context: &Context) -> f64 {
    context.adjustment.precision.as_ref().map_or(0.0, |p| p.largest_dimension)
}

/// Standard error of the scale from the distances alone: 1 / sqrt(sum (L / σ)²), where nothing else gives it.
fn relative_scale(context: &Context) -> Option<f64> {
    if context.project.datum.kind == DatumKind::Control {
        return None;
    }
    let used = used_distances(context);
    let lengths = used.iter().filter_map(|given| {
        let Given::Distance { from, to } = &given.what else { return None };
        let known = context.project.distances.iter().find(|d| d.from == *from && d.to == *to)?;
        Some((known.length / given.sigma).powi(2))
    });
    let sum: f64 = lengths.sum();
    (sum > 0.0).then(|| 1.0 / sum.sqrt())
}

fn range(context: &Context, sigmas: &[f64]) -> String {
    let (least, most) = (smallest(sigmas), sigmas.iter().copied().fold(0.0, f64::max));
    let decimals = decimals_for(least);
    if fixed(least, decimals) == fixed(most, decimals) {
        return context.in_unit(&fixed(least, decimals));
    }
    context.in_unit(&format!("{}–{}", fixed(least, decimals), fixed(most, decimals)))
}

fn not_included(context: &Context) -> Vec<String> {
    let (words, project) = (context.words, context.project);
    let mut all = Vec::new();
    if !context.scaled {
        all.push(words.gum_no_scale().to_owned());
    }
    let held = |sigma: Option<[Option<f64>; 3]>| sigma.unwrap_or_default().iter().any(|s| s.is_none_or(|s| s == 0.0));
    let control = context.used_control().filter(|p| held(p.sigma));
    let control: Vec<&str> = control.map(|p| p.id.as_str()).collect();
    if project.datum.kind == DatumKind::Control && !control.is_empty() {
        all.push(words.gum_control_held(&listed(control.iter().copied(), 8)));
    }
    let calibrated: Vec<&str> = context
        .adjustment
        .cameras
        .iter()
        .filter(|camera| camera.sigma.is_empty())
        .map(|camera| camera.camera.id.as_str())
        .collect();
    if !calibrated.is_empty() {
        all.push(words.gum_cameras_held(&listed(calibrated.iter().copied(), 8)));
    }
    all.extend(
        [words.gum_temperature(), words.gum_targets(), words.gum_movement(), words.gum_systematic()].map(str::to_owned),
    );
    all
}
