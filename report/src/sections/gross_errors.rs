//! Rejected observations with reasons, and the record of the gross error search.

use crate::context::Context;
use crate::html::{Html, Table};
use crate::number::{count, fixed};
use sightline::adjustment::GrossErrorAction;

pub fn write(context: &Context, html: &mut Html) {
    super::left_out::write(context, html);
    search(context, html);
}

/// The record of the search for gross errors.
fn search(context: &Context, html: &mut Html) {
    let words = context.words;
    let mut table = Table::new()
        .number(words.round())
        .words(words.photo())
        .words(words.observation())
        .words(words.action())
        .number(words.statistic())
        .number(words.limit());
    for error in &context.adjustment.gross_errors {
        let what = error.given.as_ref().map_or_else(
            || error.point.clone(),
            |given| format!("{} {}", context.given_kind(given), context.given_name(given)),
        );
        let action = match error.action {
            GrossErrorAction::Removed if error.consequence => words.removed_with(),
            GrossErrorAction::Removed => words.removed(),
            GrossErrorAction::Restored => words.restored(),
            GrossErrorAction::Downweighted => words.downweighted(),
            GrossErrorAction::Kept => words.kept(),
        };
        table.row(vec![
            count(error.round),
            error.photo.clone(),
            what,
            action.to_owned(),
            fixed(error.statistic, 2),
            fixed(error.limit, 2),
        ]);
    }
    if table.is_empty() {
        let options = &context.adjustment.options;
        let searched = options.snooping || options.robust.is_some();
        html.note(if searched { words.search_found_nothing() } else { words.no_search() });
    } else {
        html.h3(words.record_of_search()).table(table);
    }
}
