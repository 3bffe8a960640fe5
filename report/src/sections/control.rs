//! Control points, check points and distances with their differences.

use crate::context::{Context, listed};
use crate::html::{Html, Table};
use crate::number::{count, decimals_for, decimals_of, fixed, maybe};
use sightline::adjustment::{Given, GivenObservation};
use sightline::project::DatumKind;

pub fn write(context: &Context, html: &mut Html) {
    fixed_points(context, html);
    observed(context, html);
    distances(context, html);
    check_points(context, html);
}

/// Control points that the datum holds have no residuals: they are named.
fn fixed_points(context: &Context, html: &mut Html) {
    if context.project.datum.kind != DatumKind::Control {
        return;
    }
    let control = context.used_control();
    let held = |sigma: Option<[Option<f64>; 3]>| sigma.unwrap_or_default().iter().all(|s| s.is_none_or(|s| s == 0.0));
    let held: Vec<&str> = control.filter(|p| held(p.sigma)).map(|p| p.id.as_str()).collect();
    if !held.is_empty() {
        html.p(&context.words.control_held(&count(held.len()), &listed(held.iter().copied(), 40)));
    }
}

/// Control coordinates and projection centres with a standard error of their own.
fn observed(context: &Context, html: &mut Html) {
    let words = context.words;
    let mut table = table(context);
    for given in in_order(context) {
        if matches!(given.what, Given::Control { .. } | Given::Position { .. }) {
            let decimals = decimals_for(given.sigma);
            let taken_out = if given.enabled { String::new() } else { format!(" ({})", words.took_no_part()) };
            let name = format!("{}{taken_out}", context.given_name(&given.what));
            let mut row = vec![context.given_kind(&given.what).to_owned(), name];
            row.extend(tested(context, given, decimals));
            table.row_of(class(context, given), row);
        }
    }
    if !table.is_empty() {
        html.h3(words.control_observed()).note(words.adjusted_minus_given()).table(table);
    }
}

/// What was given, the coordinates of each point and photo in the order of the user's axes.
fn in_order<'a>(context: &Context<'a>) -> Vec<&'a GivenObservation> {
    let mut all: Vec<&GivenObservation> = context.adjustment.given.iter().collect();
    let place = |axis: usize| context.axes.order().iter().position(|of| *of == axis);
    for run in all.chunk_by_mut(|a, b| matches!((coordinate(a), coordinate(b)), (Some(a), Some(b)) if a.0 == b.0)) {
        run.sort_by_key(|given| coordinate(given).and_then(|(_, axis)| place(axis)));
    }
    all
}

/// Of what, and which coordinate.
fn coordinate(given: &GivenObservation) -> Option<((&str, bool), usize)> {
    match &given.what {
        Given::Control { point, axis } => Some(((point, false), *axis)),
        Given::Position { photo, axis } => Some(((photo, true), *axis)),
        _ => None,
    }
}

fn table(context: &Context) -> Table {
    let words = context.words;
    let table = Table::new().words(words.kind()).words("");
    table.low(words.difference(), "", context.unit).low("σ", "", context.unit).number("r").number("w")
}

/// Residual, a priori standard error, redundancy number and w.
fn tested(context: &Context, given: &GivenObservation, decimals: usize) -> [String; 4] {
    let redundancy = given.reliability.map(|r| r.redundancy);
    let unchecked = redundancy.is_some_and(|r| r < context.adjustment.criteria.unchecked);
    let w = given.reliability.and_then(|r| r.w).filter(|_| !unchecked);
    [
        given.residual.map_or("–".into(), |v| fixed(v, decimals_of(v, decimals))),
        fixed(given.sigma, decimals),
        // Of what nothing checks all digits are rounding.
        redundancy.map_or("–".into(), |r| fixed(r, if unchecked { 2 } else { decimals_of(r, 2) })),
        maybe(w, 2),
    ]
}

fn class(context: &Context, given: &GivenObservation) -> &'static str {
    let w = given.reliability.and_then(|r| r.w);
    if w.is_some_and(|w| w.abs() > context.adjustment.criteria.w) { "bad" } else { "" }
}

fn distances(context: &Context, html: &mut Html) {
    let (words, unit) = (context.words, context.unit);
    let mut table = Table::new().words(words.distance()).low(words.given(), "", unit).low(words.adjusted(), "", unit);
    table = table.low(words.difference(), "", unit).low("σ", "", unit).number("r").number("w");
    for given in &context.adjustment.given {
        let Given::Distance { from, to } = &given.what else { continue };
        let known = context.project.distances.iter().find(|d| d.from == *from && d.to == *to);
        let decimals = decimals_for(given.sigma);
        let length = known.map(|d| d.length);
        let adjusted = length.zip(given.residual).map(|(length, residual)| length + residual);
        let taken_out = if given.enabled { String::new() } else { format!(" ({})", words.took_no_part()) };
        let mut row = vec![format!("{from} – {to}{taken_out}"), maybe(length, decimals), maybe(adjusted, decimals)];
        row.extend(tested(context, given, decimals));
        table.row_of(class(context, given), row);
    }
    if !table.is_empty() {
        html.h3(words.distances()).table(table);
    }
}

fn check_points(context: &Context, html: &mut Html) {
    let (words, unit, a) = (context.words, context.unit, context.adjustment);
    let mut table = Table::new().words(words.point());
    for axis in context.axes.names() {
        table = table.low(&format!("Δ{axis}"), "", unit);
    }
    for check in &a.check_points {
        let mut row = vec![check.id.clone()];
        row.extend((0..3).map(|k| context.maybe_length(check.difference.map(|d| context.axes.shown(d)[k]))));
        table.row(row);
    }
    if table.is_empty() {
        html.note(words.no_check_points());
        return;
    }
    if let Some(all) = &a.check_statistics {
        let mut sum = |name: &str, values: [f64; 3]| {
            let mut row = vec![name.to_owned()];
            row.extend(context.axes.shown(values).map(|v| context.length(v)));
            table.row_of("sum", row);
        };
        sum(words.mean(), all.mean);
        sum(words.rms(), all.rms);
    }
    html.h3(words.check_points()).note(words.adjusted_minus_given()).table(table);
    if let Some(all) = &a.check_statistics {
        html.p(&words.check_rms_all(&count(all.count), &context.with_unit(all.rms_all)));
    }
}
