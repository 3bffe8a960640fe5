//! Numbers of observations and unknowns, and the precision of the result.

use crate::context::Context;
use crate::html::Html;
use crate::number::{count, decimals_for, fixed, maybe, three_digits};
use sightline::adjustment::Given;

pub fn write(context: &Context, html: &mut Html) {
    html.open("div", "two");
    html.open("div", "").h3(context.words.counts()).pairs(&counts(context)).close("div");
    html.open("div", "").h3(context.words.precision_and_checks()).pairs(&precision(context)).close("div");
    html.close("div");
}

fn counts(context: &Context) -> Vec<(String, String)> {
    let (words, a) = (context.words, context.adjustment);
    let given = |kind: fn(&Given) -> bool| a.given.iter().filter(|g| g.enabled && kind(&g.what)).count();
    let image = 2 * a.observations.iter().filter(|o| o.enabled).count();
    let kinds = [
        (words.image_coordinates(), image),
        (words.control_coordinates(), given(|g| matches!(g, Given::Control { .. }))),
        (words.observed_centres(), given(|g| matches!(g, Given::Position { .. }))),
        (words.distances(), given(|g| matches!(g, Given::Distance { .. }))),
        (words.observed_parameters(), given(|g| matches!(g, Given::Parameter { .. }))),
    ];
    let mut pairs = vec![(words.observations().to_owned(), count(a.observations_count))];
    pairs.extend(kinds.into_iter().filter(|(_, n)| *n > 0).map(|(name, n)| (format!("– {name}"), count(n))));
    pairs.push((words.unknowns().to_owned(), count(a.unknowns)));
    pairs.push((words.datum_constraints().to_owned(), count(a.constraints)));
    pairs.push((words.redundancy().to_owned(), count(a.redundancy)));
    pairs.push((words.iterations().to_owned(), count(a.iterations.len())));
    pairs
}

fn precision(context: &Context) -> Vec<(String, String)> {
    let (words, a) = (context.words, context.adjustment);
    let mut pairs = Vec::new();
    if let Some(precision) = &a.precision {
        let each = context.axes.shown(precision.rms_sigma).map(|s| context.length(s)).join(", ");
        pairs.push((words.rms_sigma_xyz(&context.axes.list(), &context.unit), each));
        pairs.push((
            words.largest_dimension(&context.unit),
            fixed(precision.largest_dimension, context.decimals.min(3)),
        ));
        if let Some(n) = precision.relative {
            pairs.push((words.relative_accuracy().to_owned(), format!("1 : {}", count(three_digits(n)))));
        }
    }
    if let Some((point, axis, sigma)) = context.weakest() {
        let axis = context.axes.letter(axis);
        pairs.push((words.largest_sigma(&point, &axis, &context.unit), fixed(sigma, decimals_for(sigma))));
    }
    pairs.push((words.rms_residual_px().to_owned(), maybe(a.rms_px, 3)));
    if let Some(check) = &a.check_statistics {
        pairs.push((words.check_rms(&count(check.count), &context.unit), context.length(check.rms_all)));
    }
    let over = a.observations.iter().filter(|o| o.enabled);
    let over = over.filter(|o| super::super::context::largest_w(o).is_some_and(|w| w.abs() > a.criteria.w)).count();
    pairs.push((words.over_w(&fixed(a.criteria.w, 2)), count(over)));
    pairs
}
