//! Length measurement errors of check distances, compared with the agreed limit.
//! Source: VDI/VDE 2634 part 1 (imaging systems with point-by-point probing): E = measured - calibrated, |E| <= A + L / K.

use crate::context::Context;
use crate::html::{Html, Table};
use crate::number::{count, maybe, round};

pub fn write(context: &Context, html: &mut Html) {
    let (words, unit, limit) = (context.words, context.unit, context.settings().length_limit);
    let known = &context.adjustment.check_distances;
    if known.is_empty() {
        return;
    }
    html.p(words.lengths_explained());
    let mut table = Table::new().words(words.distance()).low(words.calibrated(), "", unit);
    table = table.low(words.measured_length(), "", unit).low("E", "", unit).low("σ", "E", unit);
    if limit.is_some() {
        table = table.low(words.limit(), "", unit).words("");
    }
    let (mut over, mut worst) = (0, 0.0_f64);
    for distance in known {
        let decimals = context.decimals;
        let error = distance.difference;
        worst = worst.max(error.map_or(0.0, f64::abs));
        let mut row = vec![
            format!("{} – {}", distance.from, distance.to),
            maybe(Some(distance.length), decimals),
            maybe(error.map(|e| distance.length + e), decimals),
            maybe(error, decimals),
            maybe(distance.sigma, decimals),
        ];
        let mut class = "";
        if let Some(limit) = limit {
            let permitted = limit.of(distance.length);
            let within = error.is_some_and(|e| e.abs() <= permitted);
            row.push(maybe(Some(permitted), decimals));
            row.push(match (error, within) {
                (None, _) => "–".to_owned(),
                (_, true) => format!("✓ {}", words.within()),
                (_, false) => format!("✕ {}", words.beyond()),
            });
            if error.is_some() && !within {
                class = "bad";
                over += 1;
            }
        }
        table.row_of(class, row);
    }
    html.table(table);
    let measured = known.iter().filter(|d| d.difference.is_some()).count();
    html.p(&words.largest_length_error(&context.with_unit(worst), &count(measured)));
    if let Some(limit) = limit {
        let formula = match limit.per {
            Some(per) => format!("{} {unit} + L / {}", as_agreed(limit.constant), as_agreed(per)),
            None => format!("{} {unit}", as_agreed(limit.constant)),
        };
        html.p(&if over == 0 { words.limit_kept(&formula) } else { words.limit_broken(&formula, &count(over)) });
    }
    html.note(words.lengths_of_the_guideline());
}

/// A number of the limit as people write it: 0.02, 100 000.
fn as_agreed(value: f64) -> String {
    let whole = value.fract() == 0.0 && (1.0..1e12).contains(&value);
    if whole { count(value as usize) } else { round(value) }
}
