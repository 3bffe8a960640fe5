//! Object points with standard errors and rays.

use std::collections::HashMap;

use crate::project::Role;
use crate::report::context::Context;
use crate::report::html::{Html, Table};
use crate::report::number::count;

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
    for point in &context.adjustment.points {
        let role = roles.get(point.id.as_str()).copied().unwrap_or_default();
        let mut row = vec![point.id.clone(), context.role(role).to_owned(), count(point.rays)];
        row.extend(context.axes.shown(point.xyz).map(|x| context.length(x)));
        row.extend((0..3).map(|k| context.maybe_length(point.sigma.map(|s| context.axes.shown(s)[k]))));
        table.row(row);
    }
    html.table(table.dense());
}
