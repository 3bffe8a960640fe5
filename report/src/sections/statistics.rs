//! Tests and their results: the global test, the limits of single tests, variance components, the largest |w|.

use crate::context::{Context, largest_w};
use crate::html::{Html, Table};
use crate::number::{count, decimals_for, fixed, maybe};
use sightline::adjustment::{NotEstimated, ObservationGroup, VarianceComponent};

use super::left_out::LeftOut;

/// So many of the largest are printed.
const SHOWN: usize = 20;

pub fn write(context: &Context, html: &mut Html) {
    global(context, html);
    components(context, html);
    iterations(context, html);
    worst(context, html);
}

fn global(context: &Context, html: &mut Html) {
    let (words, a) = (context.words, context.adjustment);
    let criteria = &a.criteria;
    let mut pairs = vec![(words.sigma0_long().to_owned(), maybe(a.sigma0, 4))];
    let left_out = LeftOut::of(context);
    if !left_out.is_empty() {
        pairs.push((words.left_out_short().to_owned(), left_out.sentence(context)));
    }
    if let Some(test) = &a.global_test {
        let verdict = if test.passed { words.passed() } else { words.failed() };
        let interval = format!("{} … {}", fixed(test.lower, 1), fixed(test.upper, 1));
        pairs.push((words.global_test(&fixed(100.0 * criteria.global_alpha, 0)), verdict.to_owned()));
        pairs.push((words.statistic_vpv().to_owned(), fixed(test.statistic, 1)));
        pairs.push((words.interval().to_owned(), interval));
    }
    if let Some(estimated) = estimated(context) {
        pairs.push((words.global_test(&fixed(100.0 * criteria.global_alpha, 0)), words.no_verdict().to_owned()));
        pairs.push((words.estimated_from_residuals().to_owned(), estimated));
    }
    pairs.push((words.critical_w(&fixed(100.0 * criteria.alpha, 1)), fixed(criteria.w, 2)));
    if let Some(tau) = criteria.tau {
        pairs.push((words.critical_tau(&fixed(100.0 * criteria.alpha, 1)), fixed(tau, 2)));
    }
    pairs.push((words.noncentrality(&fixed(100.0 * criteria.power, 0)), fixed(criteria.noncentrality, 2)));
    let redundancy: Vec<f64> =
        a.observations.iter().filter(|o| o.enabled).flat_map(|o| [o.rx, o.ry]).flatten().collect();
    if !redundancy.is_empty() {
        let mean = redundancy.iter().sum::<f64>() / redundancy.len() as f64;
        let low = redundancy.iter().filter(|r| **r < criteria.low_redundancy).count();
        pairs.push((words.mean_redundancy().to_owned(), fixed(mean, 2)));
        pairs.push((words.low_redundancy(&fixed(criteria.low_redundancy, 1)), count(low)));
    }
    html.pairs(&pairs);
}

fn group_name(context: &Context, group: &ObservationGroup) -> String {
    let words = context.words;
    match group {
        ObservationGroup::Image { camera: Some(camera) } => format!("{} {camera}", words.image_coordinates()),
        ObservationGroup::Image { camera: None } => words.image_coordinates().to_owned(),
        ObservationGroup::Control => words.control_coordinates().to_owned(),
        ObservationGroup::Position => words.observed_centres().to_owned(),
        ObservationGroup::Distance => words.distances().to_owned(),
        ObservationGroup::Parameter => words.observed_parameters().to_owned(),
    }
}

/// What became of the a priori standard errors where they were estimated: "1.88 times the a priori 0.0082 px"; with the group's
/// name where there are several.
pub fn estimated(context: &Context) -> Option<String> {
    let (words, all) = (context.words, &context.adjustment.variance_components);
    let one = |component: &VarianceComponent| {
        let factor = fixed(component.factor, component.factor_sigma.map_or(2, decimals_for).max(2));
        let mut said = match component.a_priori_px {
            Some(px) => words.times_a_priori_px(&factor, &fixed(px, decimals_for(px))),
            None => words.times_a_priori(&factor),
        };
        if let Some(px) = component.unmodelled.filter(|px| *px > 0.0) {
            said = words.and_unmodelled(&said, &fixed(px, decimals_for(px)));
        }
        if all.len() > 1 { format!("{}: {said}", group_name(context, &component.group)) } else { said }
    };
    let said: Vec<String> = all.iter().filter(|c| c.not_estimated.is_none()).map(one).collect();
    (!said.is_empty()).then(|| said.join("; "))
}

fn components(context: &Context, html: &mut Html) {
    let (words, a) = (context.words, context.adjustment);
    let mut table = Table::new().words(words.group()).number(words.observations()).number(words.redundancy());
    table = table.number(words.factor()).number("σ").number(words.unmodelled_px()).number("σ");
    for component in &a.variance_components {
        let group = group_name(context, &component.group);
        let decimals = component.factor_sigma.map_or(2, decimals_for);
        table.row(vec![
            group,
            count(component.observations),
            fixed(component.redundancy, 1),
            fixed(component.factor, decimals),
            maybe(component.factor_sigma, decimals),
            maybe(component.unmodelled, 4),
            maybe(component.unmodelled_sigma, 4),
        ]);
    }
    if !table.is_empty() {
        html.h3(words.variance_components()).table(table);
        for component in &a.variance_components {
            let (name, found) = (group_name(context, &component.group), fixed(component.redundancy, 1));
            match component.not_estimated {
                Some(NotEstimated::LittleRedundancy { needed }) => {
                    html.note(&words.not_estimated(&name, &found, &fixed(needed, 0)));
                }
                Some(NotEstimated::NoResiduals) => {
                    html.note(&words.no_residuals(&name));
                }
                None => {}
            }
        }
    }
}

fn iterations(context: &Context, html: &mut Html) {
    let words = context.words;
    let mut table = Table::new().number(words.iteration()).number("σ₀").low(words.step(), "", context.unit);
    for (k, iteration) in context.adjustment.iterations.iter().enumerate() {
        use crate::number::compact;
        table.row(vec![count(k + 1), compact(iteration.sigma0), compact(iteration.step)]);
    }
    html.h3(words.iterations()).table(table);
}

fn worst(context: &Context, html: &mut Html) {
    let (words, a, unit) = (context.words, context.adjustment, context.residual_unit);
    let mut all: Vec<_> =
        a.observations.iter().filter(|o| o.enabled).filter_map(|o| Some((o, largest_w(o)?))).collect();
    all.sort_by(|x, y| y.1.abs().total_cmp(&x.1.abs()));
    let mut table = Table::new().words(words.point()).words(words.photo());
    table = table.low("v", "x", unit).low("v", "y", unit).number("r").number("w").words("");
    for (o, w) in all.iter().take(SHOWN) {
        let [fx, fy] = context.residual_factors(&o.photo);
        let decimals = context.residual_decimals(&o.photo);
        let redundancy = [o.rx, o.ry].into_iter().flatten().min_by(f64::total_cmp);
        let over = w.abs() > a.criteria.w;
        let verdict = if over { format!("✕ {} {}", words.over(), fixed(a.criteria.w, 2)) } else { String::new() };
        table.row_of(
            if over { "bad" } else { "" },
            vec![
                o.point.clone(),
                o.photo.clone(),
                maybe(o.vx.map(|v| v * fx), decimals),
                maybe(o.vy.map(|v| v * fy), decimals),
                maybe(redundancy, 2),
                fixed(*w, 2),
                verdict,
            ],
        );
    }
    if !table.is_empty() {
        html.h3(words.largest_w()).table(table);
        // Of so many tests some exceed the limit by chance.
        let tests = 2 * all.len();
        let expected = tests as f64 * a.criteria.alpha;
        let over = all.iter().filter(|(_, w)| w.abs() > a.criteria.w).count();
        let formula = (fixed(a.criteria.w, 2), count(tests), fixed(expected, 1));
        html.note(&words.by_chance(&count(over), &formula.0, &formula.1, &formula.2));
    }
}
