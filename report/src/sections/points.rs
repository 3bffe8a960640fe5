//! Object points with standard errors and rays.

use std::collections::HashMap;

use crate::context::Context;
use crate::html::{Html, Table};
use crate::number::count;
use sightline::adjustment::AdjustedPoint;
use sightline::project::Role;

/// Maximum number of rows: 5000 fill about 80 pages; 100,000 points would fill 1600.
const ROWS: usize = 5000;

pub fn write(context: &Context, html: &mut Html) {
    let (words, unit) = (context.words, context.unit);
    let roles: HashMap<&str, Role> = context.project.points.iter().map(|p| (p.id.as_str(), p.role)).collect();
    let mut table = Table::new().words(words.point()).words(words.role()).number(words.rays());
    for axis in context.axes.names() {
        table = table.low(axis, "", unit);
    }
    for axis in context.axes.names() {
        table = table.low("σ", axis, unit);
    }
    let points = listed(context, &roles);
    for point in &points {
        let role = roles.get(point.id.as_str()).copied().unwrap_or_default();
        let mut row = vec![point.id.clone(), context.role(role).to_owned(), count(point.rays)];
        row.extend(context.axes.shown(point.xyz).map(|x| context.length(x)));
        row.extend((0..3).map(|k| context.maybe_length(point.sigma.map(|s| context.axes.shown(s)[k]))));
        table.row(row);
    }
    let all = context.adjustment.points.len();
    if points.len() < all {
        html.note(&words.points_listed(&count(points.len()), &count(all)));
    }
    html.table(table.dense());
}

/// Points that have a row, in the order of the result. If there are more than [`ROWS`]: control and check points, and the tie points with the
/// largest standard errors.
fn listed<'a>(context: &Context<'a>, roles: &HashMap<&str, Role>) -> Vec<&'a AdjustedPoint> {
    let all = &context.adjustment.points;
    if all.len() <= ROWS {
        return all.iter().collect();
    }
    let tie = |point: &AdjustedPoint| roles.get(point.id.as_str()).copied().unwrap_or_default() == Role::Tie;
    // A point without a standard error is the least certain of all.
    let sigma = |k: usize| all[k].sigma.map_or(f64::INFINITY, |s| s.into_iter().fold(0.0, f64::max));
    let (mut ties, mut chosen): (Vec<usize>, Vec<usize>) = (0..all.len()).partition(|&k| tie(&all[k]));
    ties.sort_by(|&a, &b| sigma(b).total_cmp(&sigma(a)));
    chosen.extend(ties.into_iter().take(ROWS.saturating_sub(chosen.len())));
    chosen.sort_unstable();
    chosen.into_iter().map(|k| &all[k]).collect()
}
