//! What was left out: by the search for gross errors, by orientation, by hand, and why.

use std::collections::HashSet;

use crate::adjustment::{GrossError, GrossErrorAction};
use crate::project::SetAsideReason;
use crate::report::context::{Context, listed};
use crate::report::html::{Html, Table};
use crate::report::number::{count, fixed};

/// Everything that took no part.
pub struct LeftOut<'a> {
    /// Taken out by data snooping and not taken back.
    removed: Vec<&'a GrossError>,
    /// Photo, point and reason.
    set_aside: Vec<(&'a str, &'a str, SetAsideReason)>,
    /// Photo and point.
    by_hand: Vec<(&'a str, &'a str)>,
    photos: Vec<&'a str>,
}

impl<'a> LeftOut<'a> {
    pub fn of(context: &Context<'a>) -> Self {
        let (project, adjustment) = (context.project, context.adjustment);
        let record = &adjustment.gross_errors;
        let same = |a: &GrossError, b: &GrossError| a.photo == b.photo && a.point == b.point && a.given == b.given;
        let last = |k: usize| record[k + 1..].iter().all(|later| !same(&record[k], later));
        let removed = record.iter().enumerate().filter(|(k, e)| e.action == GrossErrorAction::Removed && last(*k));
        let set_aside: Vec<_> =
            project.set_aside.iter().map(|s| (s.photo.as_str(), s.point.as_str(), s.reason)).collect();
        let aside: HashSet<(&str, &str)> = set_aside.iter().map(|(photo, point, _)| (*photo, *point)).collect();
        let enabled: HashSet<&str> = project.photos.iter().filter(|p| p.enabled).map(|p| p.id.as_str()).collect();
        let off = project.observations.iter().filter(|o| !o.enabled && enabled.contains(o.photo.as_str()));
        let off = off.map(|o| (o.photo.as_str(), o.point.as_str())).filter(|pair| !aside.contains(pair));
        Self {
            removed: removed.map(|(_, error)| error).collect(),
            by_hand: off.collect(),
            photos: project.photos.iter().filter(|p| !p.enabled).map(|p| p.id.as_str()).collect(),
            set_aside,
        }
    }

    /// In one sentence.
    pub fn sentence(&self, context: &Context) -> String {
        let words = context.words;
        let parts = [
            (self.removed.len(), words.n_by_snooping(&count(self.removed.len()))),
            (self.set_aside.len(), words.n_by_orientation(&count(self.set_aside.len()))),
            (self.by_hand.len(), words.n_by_hand(&count(self.by_hand.len()))),
            (self.photos.len(), words.n_photos_off(&listed(self.photos.iter().copied(), 8))),
        ];
        let told: Vec<String> = parts.into_iter().filter(|(n, _)| *n > 0).map(|(_, words)| words).collect();
        if told.is_empty() { words.nothing_left_out().to_owned() } else { words.left_out_sentence(&told.join("; ")) }
    }
}

pub fn write(context: &Context, html: &mut Html) {
    let words = context.words;
    let left_out = LeftOut::of(context);
    html.p(&left_out.sentence(context));
    search(context, html);
    let mut table = Table::new().words(words.photo()).words(words.point()).words(words.reason());
    for (photo, point, reason) in &left_out.set_aside {
        let reason = match reason {
            SetAsideReason::Disagrees => words.aside_disagrees(),
            SetAsideReason::PhotoNotOriented => words.aside_photo(),
            SetAsideReason::PointNotDetermined => words.aside_point(),
            SetAsideReason::Undecided => words.aside_undecided(),
        };
        table.row(vec![(*photo).to_owned(), (*point).to_owned(), reason.to_owned()]);
    }
    for (photo, point) in &left_out.by_hand {
        table.row(vec![(*photo).to_owned(), (*point).to_owned(), words.aside_by_hand().to_owned()]);
    }
    if !table.is_empty() {
        html.h3(words.left_out_before()).table(table);
    }
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
