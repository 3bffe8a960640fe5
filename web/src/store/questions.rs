//! The open questions of matching, doubtful ones first.

use leptos::prelude::*;

use super::{Desk, Kind, Marking};
use crate::document::Change;
use crate::edit::questions::{self, Question};
use crate::i18n::text;

impl Desk {
    /// All open questions.
    pub fn questions(self) -> Vec<Question> {
        self.document.with(questions::open)
    }

    /// The question that is asked, while its place is in sight.
    pub fn asked_question(self) -> Option<Question> {
        let asked = self.measuring.question.get()?;
        let here = self.selection.with(|s| s.photo.as_ref() == Some(&asked.photo) && s.point == asked.point);
        (here && self.document.with(|d| questions::open(d).contains(&asked))).then_some(asked)
    }

    /// Asks a question: its place is shown, with the point it may be.
    pub fn ask_question(self, question: Question) {
        let target = self.document.with_untracked(|d| {
            let found = d.detections.get(&question.photo)?;
            found.targets.iter().position(|t| t.number().is_some() && t.number() == question.target)
        });
        self.select_photo(&question.photo);
        self.selection.update(|s| {
            s.point.clone_from(&question.point);
            (s.target, s.spot) = (target, None);
            if let Some(point) = &question.point {
                s.mark(Kind::Points, point, Marking::Only, &[]);
            }
        });
        self.photo_view.show_place.set(Some((question.place, 60.0)));
        self.measuring.question.set(Some(question));
    }

    /// Asks the question after the present one, round to the first.
    pub fn next_question(self) {
        let all = untrack(|| self.questions());
        let now = self.measuring.question.get_untracked();
        let at = now.and_then(|now| all.iter().position(|q| *q == now)).map_or(0, |at| at + 1);
        match all.get(at).or_else(|| all.first()) {
            Some(question) => self.ask_question(question.clone()),
            None => self.tell_here(|| text::no_questions().to_owned()),
        }
    }

    /// Answers the question that is asked: it is this point, its own where none is given.
    pub fn answer_yes(self, other: Option<&str>) {
        let Some(question) = untrack(|| self.asked_question()) else { return };
        let point = other.map(str::to_owned).or_else(|| question.point.clone());
        let Some(point) = point.map(|p| p.trim().to_owned()).filter(|p| !p.is_empty()) else { return };
        self.answer(&question, |d, q| questions::yes(d, q, &point));
    }

    /// Answers the question that is asked: it is not this point.
    pub fn answer_no(self) {
        if let Some(question) = untrack(|| self.asked_question()) {
            self.answer(&question, questions::no);
        }
    }

    fn answer(self, question: &Question, answer: impl FnOnce(&mut crate::document::Document, &Question)) {
        let before = untrack(|| self.questions());
        let at = before.iter().position(|q| q == question).unwrap_or(0);
        self.change(Change::QuestionAnswered { photo: question.photo.clone() }, |d| answer(d, question));
        // The next of those that were left, in their order.
        let left = untrack(|| self.questions());
        let next = before[at..].iter().find(|q| left.contains(q)).or_else(|| left.first());
        match next.cloned() {
            Some(next) => self.ask_question(next),
            None => {
                self.measuring.question.set(None);
                self.tell_here(|| text::no_questions().to_owned());
            }
        }
    }
}
