//! What was measured on the result: features with their standard errors, and the object's own coordinate systems.

use crate::context::{Context, listed};
use crate::html::{Html, Table};
use crate::number::{compact, count, decimals_for, fixed, maybe};
use sightline::adjustment::{MeasuredFeature, MeasuredSystem, Quantity};
use sightline::axes::ShownAxes;
use sightline::error::{Error, Reason};
use sightline::project::{CoordinateSystem, End, Feature, FeatureKind, SystemKind};

/// Names of points that are listed of a feature; more are counted.
const LISTED: usize = 6;

pub fn write(context: &Context, html: &mut Html) {
    if context.project.features.is_empty() && context.project.systems.is_empty() {
        return;
    }
    let measured = |id: &str| context.adjustment.features.iter().find(|f| f.id == id);
    figures(context, html, &measured);
    places(context, html);
    for system in &context.project.systems {
        let found = context.adjustment.systems.iter().find(|s| s.id == system.id);
        coordinates(context, html, system, found);
    }
}

/// The one figure of each, or its form.
fn figures<'a>(context: &Context<'a>, html: &mut Html, measured: &dyn Fn(&str) -> Option<&'a MeasuredFeature>) {
    let words = context.words;
    let mut table = Table::new().words("").words(words.feature()).words(words.feature_of()).words("");
    table = table.number(words.value()).number("σ").words(words.unit()).low(words.form_rms(), "", context.unit);
    table = table.low(words.smallest_largest(), "", context.unit);
    let mut notes = Vec::new();
    for feature in &context.project.features {
        let name = vec![feature.id.clone(), kind(context, &feature.kind).to_owned(), made_of(context, feature)];
        let rest = match measured(&feature.id) {
            Some(found) if found.error.is_none() => {
                if !found.missing.is_empty() {
                    let missing = listed(found.missing.iter().map(String::as_str), LISTED);
                    notes.push(words.feature_lacks(&feature.id, &missing));
                }
                if let (Some(misfit), Some(rms)) = (found.misfit, found.rms) {
                    notes.push(words.feature_misfit(&feature.id, &context.with_unit(rms), &fixed(100.0 * misfit, 0)));
                }
                if let Some(weak) = found.weak {
                    notes.push(words.feature_weak(&feature.id, &fixed(100.0 * weak, 0)));
                }
                figure(context, found)
            }
            Some(found) => {
                let why = found.error.as_ref().map(|error| why(context, error)).unwrap_or_default();
                notes.push(words.feature_failed(&feature.id, &why));
                nothing()
            }
            None => {
                notes.push(words.feature_not_measured(&feature.id));
                nothing()
            }
        };
        table.row(name.into_iter().chain(rest).collect());
    }
    if table.is_empty() {
        return;
    }
    html.p(words.features_explained()).table(table);
    for note in notes {
        html.note(&note);
    }
}

fn nothing() -> [String; 6] {
    ["", "–", "–", "", "–", "–"].map(str::to_owned)
}

/// Quantity, value, standard error, unit, rms and range.
fn figure(context: &Context, feature: &MeasuredFeature) -> [String; 6] {
    let words = context.words;
    let angle = feature.quantity == Some(Quantity::Angle);
    let shown = |x: f64| if angle { x.to_degrees() } else { x };
    let sigma = feature.sigma.map(shown);
    let decimals = sigma.filter(|s| *s > 0.0).map_or(context.decimals, decimals_for);
    let form = feature.rms.map_or(context.decimals, |rms| decimals_for(rms).max(3));
    [
        match feature.quantity {
            Some(Quantity::Distance) => words.feature_distance(),
            Some(Quantity::Angle) => words.feature_angle(),
            Some(Quantity::Diameter) => words.feature_diameter(),
            None => "",
        }
        .to_owned(),
        maybe(feature.value.map(shown), decimals),
        maybe(sigma, decimals),
        match feature.quantity {
            Some(_) if angle => "°",
            Some(_) => context.unit,
            None => "",
        }
        .to_owned(),
        maybe(feature.rms, form),
        feature.range.map_or("–".into(), |[low, high]| format!("{} … {}", fixed(low, form), fixed(high, form))),
    ]
}

/// Where forms lie, and along what.
fn places(context: &Context, html: &mut Html) {
    let (words, unit) = (context.words, context.unit);
    let mut table = Table::new().words("");
    for axis in context.axes.names() {
        table = table.low(axis, "", unit);
    }
    for axis in context.axes.names() {
        table = table.low("σ", axis, unit);
    }
    table = table.words(words.feature_direction()).low("σ", "", "°").dense();
    for feature in context.adjustment.features.iter().filter(|f| f.error.is_none()) {
        let Some(place) = feature.position else { continue };
        let mut row = vec![feature.id.clone()];
        row.extend(context.axes.shown(place).map(|x| context.length(x)));
        row.extend((0..3).map(|k| context.maybe_length(feature.sigma_position.map(|s| context.axes.shown(s)[k]))));
        row.push(feature.direction.map_or("–".into(), |d| context.axes.shown(d).map(|x| fixed(x, 6)).join("  ")));
        row.push(feature.sigma_direction.map_or("–".into(), |s| compact(s.to_degrees())));
        table.row(row);
    }
    if !table.is_empty() {
        html.h3(words.feature_places()).table(table);
    }
}

/// The points in a system of the object's own.
fn coordinates(context: &Context, html: &mut Html, system: &CoordinateSystem, found: Option<&MeasuredSystem>) {
    let (words, unit) = (context.words, context.unit);
    let how = match system.kind {
        SystemKind::Automatic { .. } => words.system_automatic(),
        SystemKind::PlaneLinePoint { .. } => words.system_plane_line_point(),
        SystemKind::BestFit { .. } => words.system_best_fit(),
    };
    html.h3(&words.system_named(&system.id)).p(how);
    let Some(found) = found else {
        html.note(&words.feature_not_measured(&system.id));
        return;
    };
    if let Some(error) = &found.error {
        html.note(&words.feature_failed(&system.id, &why(context, error)));
        return;
    }
    if let Some(sigma0) = found.sigma0 {
        let redundancy = found.redundancy.unwrap_or(0);
        // Without weights of their own it is that of a coordinate.
        let weighted =
            matches!(&system.kind, SystemKind::BestFit { given, .. } if given.iter().any(|g| g.sigma.is_some()));
        let unit = if weighted { String::new() } else { format!(" {unit}") };
        let sigma0 = format!("{}{unit}", fixed(sigma0, decimals_for(sigma0)));
        html.p(&words.system_fit(&sigma0, &count(redundancy), &fixed(found.scale, 7)));
    }
    if !found.missing.is_empty() {
        html.note(&words.feature_lacks(&system.id, &listed(found.missing.iter().map(String::as_str), LISTED)));
    }
    let mut table = Table::new().words(words.point());
    // A system of the object's own has no east and no north.
    for axis in ShownAxes::XYZ.names() {
        table = table.low(axis, "", unit);
    }
    for axis in ShownAxes::XYZ.names() {
        table = table.low("σ", axis, unit);
    }
    for point in &found.points {
        let mut row = vec![point.id.clone()];
        row.extend(point.xyz.map(|x| context.length(x)));
        row.extend((0..3).map(|k| context.maybe_length(point.sigma.map(|s| s[k]))));
        table.row(row);
    }
    html.table(table);
}

fn kind(context: &Context, kind: &FeatureKind) -> &'static str {
    let words = context.words;
    match kind {
        FeatureKind::Line { .. } => words.feature_line(),
        FeatureKind::Plane { .. } => words.feature_plane(),
        FeatureKind::Circle { .. } => words.feature_circle(),
        FeatureKind::Sphere { .. } => words.feature_sphere(),
        FeatureKind::Cylinder { .. } => words.feature_cylinder(),
        FeatureKind::Distance { .. } => words.feature_distance(),
        FeatureKind::Angle { .. } => words.feature_angle(),
        FeatureKind::Deviations { .. } => words.feature_deviations(),
    }
}

/// Points and features that it is made of.
fn made_of(context: &Context, feature: &Feature) -> String {
    let end = |end: &End| match end {
        End::Point(id) | End::Feature(id) => id.clone(),
    };
    let some = |all: &[String]| match all.len() {
        0..=LISTED => all.join(", "),
        n => context.words.feature_points(&count(n)),
    };
    match &feature.kind {
        FeatureKind::Distance { from, to } => format!("{} – {}", end(from), end(to)),
        FeatureKind::Angle { from, at, to } => {
            let ends = [Some(from), at.as_ref(), Some(to)];
            ends.into_iter().flatten().map(end).collect::<Vec<_>>().join(" – ")
        }
        FeatureKind::Deviations { feature: Some(from), .. } => context.words.feature_from(from),
        FeatureKind::Deviations { given, .. } => context.words.feature_from_given(&count(given.len())),
        other => some(other.points()),
    }
}

/// Why a feature or a system could not be measured.
fn why(context: &Context, error: &Error) -> String {
    let words = context.words;
    match error {
        Error::Invalid { reason: Reason::FeaturePoints { needed, given }, .. } => {
            words.lacks_points(&count(*given), &count(*needed))
        }
        Error::Invalid { reason: Reason::FeaturePointMissing { name }, .. } => words.lacks_point(name),
        Error::Invalid { reason: Reason::FeatureUndetermined, .. } => words.points_undetermined().to_owned(),
        Error::Invalid { reason: Reason::FeatureUnsettled, .. } => words.fit_unsettled().to_owned(),
        Error::Invalid { reason: Reason::FeatureNotFitted { name }, .. } => words.not_fitted(name),
        Error::Invalid { reason: Reason::FeatureBroken { name }, .. } => words.built_on_broken(name),
        Error::Invalid { reason: Reason::FeatureNoDirection, .. } => words.lacks_direction().to_owned(),
        other => other.code().to_owned(),
    }
}
