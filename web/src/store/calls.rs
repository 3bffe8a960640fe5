//! What is asked of the storage's worker and what it answers, and the card of a project in the list.

use serde::{Deserialize, Serialize};

use super::Step;
use crate::browser::page;
use crate::browser::storage::{Fault, Piece};
use crate::document::Document;

/// A project in the list.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Card {
    pub name: String,
    /// In milliseconds.
    pub changed: f64,
    pub photos: usize,
    pub points: usize,
    pub outcome: CardOutcome,
    pub sigma0: Option<f64>,
    /// Of image coordinates whose standard errors were estimated: the factor, and the a priori pixels it belongs to.
    #[serde(default)]
    pub estimated: Option<(f64, f64)>,
    pub step: String,
}

/// How far a project is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum CardOutcome {
    None,
    Passed,
    Failed,
    OutOfDate,
    /// Standard errors were estimated from the residuals: there is no verdict.
    Estimated,
}

#[derive(Serialize)]
pub(super) struct Append {
    pub(super) id: String,
    pub(super) snapshot: bool,
    pub(super) note: String,
    pub(super) parts: Vec<(u64, String)>,
    pub(super) card: KeptCard,
    #[serde(skip)]
    pub(super) texts: Vec<Vec<Piece>>,
}

#[derive(Serialize)]
pub(super) struct KeptCard {
    #[serde(flatten)]
    pub(super) card: Card,
    /// Of the photos, the one on the cover first.
    pub(super) keys: Vec<String>,
}

/// Answer of the worker for a project that it opened.
#[derive(Deserialize)]
pub(super) struct Opened {
    pub(super) notes: Vec<String>,
    pub(super) following: bool,
    #[serde(rename = "nextPart")]
    pub(super) next_part: u64,
    pub(super) damage: Option<Damage>,
}

/// Error of a journal.
#[derive(Clone, Copy, Deserialize)]
pub(super) struct Damage {
    /// Nothing is lost.
    pub(super) mended: bool,
    /// Whether notes follow what is lost.
    pub(super) gap: bool,
}

impl Opened {
    pub(super) fn has_gap(&self) -> bool {
        self.damage.is_some_and(|damage| damage.gap)
    }
}

impl Append {
    /// Whether a journal ends with this: then it was written, though not confirmed.
    pub(super) fn is_last_of(&self, opened: &Opened) -> bool {
        opened.notes.last() == Some(&self.note) && self.parts.iter().all(|(number, _)| *number < opened.next_part)
    }
}

#[derive(Deserialize)]
pub(super) struct Copied {
    pub(super) missed: Vec<String>,
    pub(super) failure: Option<Fault>,
}

#[derive(Deserialize)]
pub(super) struct Appended {
    /// Of the journal.
    pub(super) size: f64,
}

#[derive(Serialize)]
pub(super) struct Starting {
    /// Where storage was cleared under the page: "noticed" by this window, or "told" by another one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub after: Option<&'static str>,
}

#[derive(Deserialize)]
pub(super) struct Started {
    pub kind: String,
    pub fresh: bool,
}

/// Answer of a call without a result.
#[derive(Serialize)]
pub(super) struct Plain {}

#[derive(Serialize)]
pub(super) struct Ids<'a> {
    pub ids: &'a [u64],
}

#[derive(Serialize)]
pub(super) struct PhotoKeys<'a> {
    pub(super) keys: &'a [String],
}

/// A call that names a project.
#[derive(Serialize)]
pub(super) struct ProjectId<'a> {
    pub id: &'a str,
}

/// Entry of a document in the list.
pub(super) fn card(document: &Document, step: Step) -> Card {
    let current = document.current();
    let passed = current.and_then(|r| r.adjustment.global_test.as_ref()).map(|test| test.passed);
    let adjustment = current.map(|r| &r.adjustment).filter(|a| a.standard_errors_estimated());
    let outcome = match passed {
        _ if document.out_of_date() => CardOutcome::OutOfDate,
        _ if adjustment.is_some() => CardOutcome::Estimated,
        Some(true) => CardOutcome::Passed,
        Some(false) => CardOutcome::Failed,
        None => CardOutcome::None,
    };
    Card {
        name: document.project.name.clone(),
        changed: page::now(),
        photos: document.project.photos.len(),
        points: document.project.points.len(),
        outcome,
        sigma0: current.and_then(|r| r.adjustment.sigma0),
        estimated: adjustment.and_then(|a| {
            let mut told = a.variance_components.iter().filter(|c| c.not_estimated.is_none());
            told.find_map(|c| Some((c.factor, c.a_priori_px?)))
        }),
        step: step.name().to_owned(),
    }
}
