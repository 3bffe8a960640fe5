//! The engine's findings in words: those of the report, in the language of the desk.

use sightline::monitoring::{GroupError, LeftOutPoint, Monitoring, Outcome, Pair, ThresholdState};
use sightline::project::ReportLanguage;
use sightline_report::epochs as told;
pub use sightline_report::epochs::{counts, probability as p_words};

use crate::i18n::speech;

fn language() -> ReportLanguage {
    speech().pages()
}

/// Whether nothing moved, the verdict in one sentence, and of what it is.
pub fn verdict(found: &Monitoring, pair: &Pair) -> (bool, String, String) {
    let calm = pair.outcome == Outcome::Congruent && counts(pair).0 == 0;
    (calm, told::verdict(pair, language()), told::particulars(found, pair, language()))
}

pub fn notes(pair: &Pair) -> Vec<String> {
    told::notes(pair, language())
}

/// Assumptions about the epochs of a pair.
pub fn epoch_notes(found: &Monitoring, pair: &Pair) -> Vec<String> {
    told::assumed(found, pair, language())
}

/// Where the reference points come from, and what the tests rest on.
pub fn basis(found: &Monitoring, pair: &Pair) -> String {
    told::basis(found, pair, language())
}

pub fn state_words(state: ThresholdState) -> &'static str {
    told::state(state, language())
}

pub fn group_error_words(error: &GroupError) -> String {
    told::group_error(error, language())
}

/// Points that were not used, by their reason.
pub fn left_out_words(left_out: &[LeftOutPoint]) -> Vec<String> {
    told::left_out(left_out, language())
}
