//! Every image observation with its residuals and tests.

use crate::context::{Context, largest_w};
use crate::html::{Html, Table};
use crate::number::{fixed, maybe};

pub fn write(context: &Context, html: &mut Html) {
    let (words, unit) = (context.words, context.residual_unit);
    let mut table = Table::new().words(words.photo()).words(words.point()).low("u", "", "px").low("v", "", "px");
    table = table.low("v", "x", unit).low("v", "y", unit).low("r", "x", "").low("r", "y", "");
    table = table.low("w", "x", "").low("w", "y", "").words("");
    for (given, found) in context.project.observations.iter().zip(&context.adjustment.observations) {
        let [fx, fy] = context.residual_factors(&found.photo);
        let decimals = context.residual_decimals(&found.photo);
        let over = found.enabled && largest_w(found).is_some_and(|w| w.abs() > context.adjustment.criteria.w);
        let state = if !found.enabled {
            words.took_no_part()
        } else if over {
            "✕"
        } else {
            ""
        };
        table.row_of(
            if over { "bad" } else { "" },
            vec![
                found.photo.clone(),
                found.point.clone(),
                fixed(given.u, 3),
                fixed(given.v, 3),
                maybe(found.vx.map(|v| v * fx), decimals),
                maybe(found.vy.map(|v| v * fy), decimals),
                maybe(found.rx, 2),
                maybe(found.ry, 2),
                maybe(found.wx, 2),
                maybe(found.wy, 2),
                state.to_owned(),
            ],
        );
    }
    html.table(table.dense());
}
