//! The steps of the path and the way between them, by a click or by the address.

use leptos::prelude::*;

use super::{Desk, experiments};
use crate::browser::page;
use crate::document::Document;

/// The steps of the path, and the page before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Step {
    #[default]
    Start,
    Photos,
    Targets,
    Identities,
    Control,
    Adjust,
    Results,
    Report,
    /// A view of the results, beside the path.
    Object,
    /// Beside the path.
    Experiments,
    /// Beside the path too.
    Tables,
    /// Before it: the plan of the photos.
    Plan,
    /// Targets to print.
    Print,
    /// Cameras and scale bars that are of no project.
    Equipment,
    /// Epochs of an object beside each other.
    Monitoring,
    /// A camera calibrated with a board or a sheet.
    Calibrate,
    /// Files for other programs.
    Files,
    /// Matrices, steps, datums and errors of an adjustment.
    Inside,
}

impl Step {
    /// The steps in their order, without the start page.
    pub const ROW: [Self; 7] =
        [Self::Photos, Self::Targets, Self::Identities, Self::Control, Self::Adjust, Self::Results, Self::Report];

    /// Tasks before there are photos.
    pub const BEFORE: [Self; 3] = [Self::Plan, Self::Print, Self::Equipment];

    pub fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Photos => "photos",
            Self::Targets => "targets",
            Self::Identities => "identities",
            Self::Control => "control",
            Self::Adjust => "adjust",
            Self::Results => "results",
            Self::Report => "report",
            Self::Object => "object",
            Self::Experiments => "experiments",
            Self::Tables => "tables",
            Self::Plan => "plan",
            Self::Print => "print",
            Self::Equipment => "equipment",
            Self::Monitoring => "monitoring",
            Self::Calibrate => "calibrate",
            Self::Files => "files",
            Self::Inside => "inside",
        }
    }

    pub(super) fn from_name(name: &str) -> Self {
        // A lesson and its state may follow.
        let name = if name.starts_with("inside/") { Self::Inside.name() } else { name };
        let beside = [Self::Tables, Self::Object, Self::Monitoring, Self::Calibrate, Self::Files, Self::Inside]
            .into_iter()
            .chain(Self::BEFORE);
        Self::ROW.into_iter().chain(beside).find(|s| s.name() == name).unwrap_or_default()
    }

    /// Whether it shows a project, so that a project can be left at it.
    pub fn of_a_project(self) -> bool {
        !matches!(self, Self::Start | Self::Experiments | Self::Print | Self::Equipment | Self::Inside)
    }

    /// Whether it needs no project.
    pub fn is_before(self) -> bool {
        Self::BEFORE.contains(&self) || matches!(self, Self::Monitoring | Self::Inside)
    }
}

impl Desk {
    pub fn go(self, step: Step) {
        self.leave_for(step);
        self.step.set(step);
        page::set_hash(step.name());
    }

    /// Ends what ends with the step, and remembers where the way back from beside the path leads.
    pub(super) fn leave_for(self, step: Step) {
        let now = self.step.get_untracked();
        if now != step {
            if now == Step::Experiments {
                self.stop_what_runs_by_itself();
            }
            self.end_modes();
            if now == Step::Start || Step::ROW.contains(&now) {
                self.window.came_from.set(now);
            }
        }
    }

    /// Follows the address after '#', where the step is open already.
    pub fn follow_hash(self) {
        if let Some(name) = experiments::from_hash(&page::hash()) {
            return self.show_experiment(name);
        }
        self.follow_lesson_in_address();
        let step = Step::from_name(&page::hash());
        let coming = self.intake.coming.with_untracked(|coming| !coming.is_empty());
        let empty = self.document.with_untracked(Document::is_empty) && !coming;
        let allowed = if empty && !step.is_before() { Step::Start } else { step };
        if self.step.get_untracked() != allowed {
            self.leave_for(allowed);
            self.step.set(allowed);
        }
    }

    /// Shows what the address names, where it needs no project.
    pub fn follow_hash_at_start(self) -> bool {
        let step = Step::from_name(&page::hash());
        if step.is_before() {
            self.step.set(step);
        }
        step.is_before()
    }
}
