//! Messages and questions of the desk, and how long a message is shown.

use std::rc::Rc;
use std::sync::Arc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::Error;

use super::{Desk, Step};
use crate::browser::page;
use crate::document::Document;
use crate::i18n::{Text, errors, text};

/// A question that something waits for; cancelling it is always possible.
#[derive(Clone)]
pub struct Asking {
    pub text: Rc<dyn Fn() -> String>,
    /// Choices, the most probable first.
    pub choices: Vec<(Text, Rc<dyn Fn()>)>,
}

/// A message, in the language in use when it is read. It disappears with its cause.
#[derive(Clone)]
pub struct Notice {
    pub warning: bool,
    pub text: Arc<dyn Fn() -> String + Send + Sync>,
    until: Until,
    /// The document, step and photo that it is about.
    of: (Document, Step, Option<String>),
}

/// How long a message is shown; a new task ends it in any case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Until {
    /// About the last task: until another one starts.
    NextWork,
    /// About the document: until it changes.
    Document,
    /// About what is in sight: until document, step or photo change.
    Sight,
    /// About the running task: until it ends.
    WorkEnds,
}

/// Signals of the message and the question in front of the user.
#[derive(Clone, Copy, Default)]
pub struct Messages {
    pub notice: RwSignal<Option<Notice>>,
    /// A question that the running action waits for.
    pub asking: RwSignal<Option<Asking>, LocalStorage>,
}

impl Desk {
    /// Tells something of the document as it is.
    pub fn tell(self, text: impl Fn() -> String + Send + Sync + 'static) {
        self.say(false, Until::Document, text);
    }

    /// Tells something of what is in sight.
    pub fn tell_here(self, text: impl Fn() -> String + Send + Sync + 'static) {
        self.say(false, Until::Sight, text);
    }

    /// Tells what is wrong with the document as it is.
    pub fn warn(self, text: impl Fn() -> String + Send + Sync + 'static) {
        self.say(true, Until::Document, text);
    }

    /// Tells what is wrong with what was typed or pointed at.
    pub fn warn_here(self, text: impl Fn() -> String + Send + Sync + 'static) {
        self.say(true, Until::Sight, text);
    }

    /// Tells something until there is no reason to any more, until it is dismissed or until something newer is told.
    pub fn say(self, warning: bool, until: Until, text: impl Fn() -> String + Send + Sync + 'static) {
        let of = untrack(|| self.in_sight());
        self.messages.notice.set(Some(Notice { warning, text: Arc::new(text), until, of }));
    }

    fn in_sight(self) -> (Document, Step, Option<String>) {
        (self.document.get(), self.step.get(), self.selection.with(|s| s.photo.clone()))
    }

    /// Takes the notice away when its cause is gone; to be run whenever something changes.
    pub fn drop_stale_notice(self) {
        let (document, step, photo) = self.in_sight();
        let busy = self.tasks.job.with(Option::is_some);
        let stale = self.messages.notice.with_untracked(|notice| {
            notice.as_ref().is_some_and(|notice| match notice.until {
                Until::NextWork => false,
                Until::Document => !document.same(&notice.of.0),
                Until::Sight => !document.same(&notice.of.0) || (step, &photo) != (notice.of.1, &notice.of.2),
                Until::WorkEnds => !busy,
            })
        });
        if stale {
            self.messages.notice.set(None);
        }
    }

    pub fn warn_error(self, error: Error) {
        self.warn(move || errors::sentence(&error));
    }

    pub fn warn_crash(self, detail: String) {
        self.say(true, Until::NextWork, move || text::worker_lost(&detail));
        self.look_for_another_build();
    }

    /// A file of the page did not come: where the host has another build by now, the page has to be loaded anew.
    pub fn look_for_another_build(self) {
        spawn_local(async move {
            if page::host_has_another_build().await {
                self.connection.outdated.set(true);
            }
        });
    }
}
