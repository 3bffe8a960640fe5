//! What the desk tells and asks, and how long there is reason to.

use std::rc::Rc;
use std::sync::Arc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::Error;

use super::document::Document;
use super::{Desk, Step};
use crate::browser::page;
use crate::i18n::{Text, errors, text};

/// A question that something waits for; cancelling it is always possible.
#[derive(Clone)]
pub struct Asking {
    pub text: Rc<dyn Fn() -> String>,
    /// What can be chosen, the most likely first.
    pub choices: Vec<(Text, Rc<dyn Fn()>)>,
}

/// Something to tell, in whatever language is in use when it is read. It goes when its cause goes.
#[derive(Clone)]
pub struct Notice {
    pub warning: bool,
    pub text: Arc<dyn Fn() -> String + Send + Sync>,
    until: Until,
    /// The document, step and photo that it was told of.
    of: (Document, Step, Option<String>),
}

/// How long there is reason to tell something; new work ends it in any case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Until {
    /// It is of what was done last, and stays until something else is done.
    NextWork,
    /// It is of the document as it was.
    Document,
    /// It is of what is in sight: the document, the step and the photo.
    Sight,
    /// It is of the work under way.
    WorkEnds,
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
        self.notice.set(Some(Notice { warning, text: Arc::new(text), until, of }));
    }

    fn in_sight(self) -> (Document, Step, Option<String>) {
        (self.document.get(), self.step.get(), self.selection.with(|s| s.photo.clone()))
    }

    /// Takes the notice away when its cause is gone; to be run whenever something changes.
    pub fn drop_stale_notice(self) {
        let (document, step, photo) = self.in_sight();
        let busy = self.job.with(Option::is_some);
        let stale = self.notice.with_untracked(|notice| {
            notice.as_ref().is_some_and(|notice| match notice.until {
                Until::NextWork => false,
                Until::Document => !document.same(&notice.of.0),
                Until::Sight => !document.same(&notice.of.0) || (step, &photo) != (notice.of.1, &notice.of.2),
                Until::WorkEnds => !busy,
            })
        });
        if stale {
            self.notice.set(None);
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
                self.outdated.set(true);
            }
        });
    }
}
