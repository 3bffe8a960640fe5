//! Reasons of errors in English, as each crate declares them.

use sightline::error::Reason;
use sightline_exchange::reason::ExchangeReason;
use sightline_lab::reason::LabReason;
use sightline_plan::reason::PlanReason;
use sightline_report::reason::ReportReason;

/// The sentence of a reason; what crates above the engine declare comes from the workers without it.
pub fn english(reason: &Reason) -> String {
    let known = ExchangeReason::of(reason).map(|reason| reason.to_string());
    let known = known.or_else(|| PlanReason::of(reason).map(|reason| reason.to_string()));
    let known = known.or_else(|| ReportReason::of(reason).map(|reason| reason.to_string()));
    known.or_else(|| LabReason::of(reason).map(|reason| reason.to_string())).unwrap_or_else(|| reason.to_string())
}
