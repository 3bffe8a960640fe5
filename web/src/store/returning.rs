//! Return paths: a new project, the project that was open before a reload, the last step of a project.

use leptos::prelude::*;
use leptos::task::spawn_local;

use super::calls::Plain;
use super::shelf::Listed;
use super::{Desk, Step, experiments};
use crate::browser::page;
use crate::document::Document;
use crate::edit::naming;
use crate::i18n::first;

/// Of this window: the project that is open in it.
const OPEN: &str = "open";

impl Desk {
    /// Remembers what is open in this window and at which step, as either changes.
    pub(super) fn start_remembering(self) {
        self.remember_monitoring();
        Effect::new(move || {
            // A project has its key from the time when it is written first.
            self.persistence.kept.track();
            let step = self.step.get();
            let Some(id) = self.open_id() else { return };
            page::set_visit(OPEN, &id);
            if step.of_a_project() {
                page::set_preference(&format!("step.{id}"), step.name());
            }
        });
    }

    /// The step that a project was left at; before this was remembered, the one of its last change.
    pub fn last_step(self, id: &str, of_card: &str) -> Step {
        let left = page::preference(&format!("step.{id}"));
        let step = Step::from_name(left.as_deref().unwrap_or(of_card));
        if step.of_a_project() { step } else { Step::Photos }
    }

    /// Whether the page was loaded again while a project was open: then it waits for the storage to give it back.
    pub fn expects_to_return(self) -> bool {
        let step = Step::from_name(&page::hash());
        let expects =
            page::visit(OPEN).is_some() && step != Step::Start && experiments::from_hash(&page::hash()).is_none();
        self.persistence.returning.set(expects.then_some(step));
        expects
    }

    /// Opens what was open before the page was loaded again, at the same step.
    pub(super) fn return_to_open(self) {
        let Some(step) = self.persistence.returning.get_untracked() else { return };
        let (Some(storage), Some(id)) = (self.storage(), page::visit(OPEN)) else { return self.return_nowhere() };
        spawn_local(async move {
            // What was deleted meanwhile is not asked for.
            let listed = storage.call::<Vec<Listed>>("list", &Plain {}, Vec::new()).await;
            let there = listed.is_ok_and(|(all, _)| all.iter().any(|one| one.id == id && !one.deleted));
            let empty = self.document.with_untracked(Document::is_empty);
            if there && empty && self.open_call("open", &id).await {
                self.persistence.returning.set(None);
                if step == Step::Monitoring {
                    self.recall_epochs();
                }
                self.go(step);
            } else {
                self.return_nowhere();
            }
        });
    }

    /// There is nothing to return to.
    pub(super) fn return_nowhere(self) {
        if self.persistence.returning.try_update(Option::take).flatten().is_some() {
            page::forget_visit(OPEN);
            if self.document.with_untracked(Document::is_empty) && !self.follow_hash_at_start() {
                self.go(Step::Start);
            }
        }
    }

    /// No project is open in this window any more.
    pub(super) fn forget_open(self) {
        page::forget_visit(OPEN);
    }

    /// Begins a project with nothing in it but its name.
    pub fn new_project(self) {
        self.over_unsaved(move || {
            let mut document = Document::default();
            document.project_mut().name = self.name_apart(format!("{} {}", first::project(), page::today()));
            self.begin_with(document);
            self.go(Step::Photos);
        });
    }

    /// Puts a document in the place of the present one, with nothing left of what was shown of that.
    pub(super) fn begin_with(self, document: Document) {
        self.begin(document);
        self.forget_waiting();
        self.photos.files.set(Default::default());
        self.photos.others.set_value(Vec::new());
        self.processing.iterations.set(Vec::new());
        self.selection.set(Default::default());
    }

    /// A name that no other project on this computer has.
    pub(super) fn name_apart(self, name: String) -> String {
        let open = self.open_id();
        let taken = self.shelf.projects.with_untracked(|all| {
            let others = all.iter().flatten().filter(|one| Some(&one.id) != open.as_ref());
            others.map(|one| one.card.name.clone()).collect::<Vec<_>>()
        });
        naming::apart_from(name, &taken)
    }

    /// Ends every mode: clicks mean what they mean at first.
    pub fn end_modes(self) {
        if self.measuring.placing.get_untracked() {
            self.measuring.placing.set(false);
        }
        if self.measuring.series.with_untracked(Option::is_some) {
            self.measuring.series.set(None);
        }
        if self.window.menu.get_untracked().is_some() {
            self.window.menu.set(None);
        }
    }
}
