//! A lesson in progress: step, correct answers, values of its expressions. Progress is stored in this browser.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use leptos::prelude::*;
use sightline_lab::teaching::{Lesson, LessonProgress, LessonStep, Reached, Screen, pieces};
use sightline_protocol::Inquiry;

use super::inside::{Network, Tab};
use super::{Desk, Step, Until};
use crate::browser::file::{choose, download};
use crate::browser::page;
use crate::format;
use crate::i18n::{language, text};

/// The state of the lessons.
#[derive(Clone, Copy, Default)]
pub struct Lessons {
    /// Whether their pane is shown.
    pub shown: RwSignal<bool>,
    /// Those of the program, and files that were opened.
    pub all: RwSignal<Vec<Arc<Lesson>>>,
    pub now: RwSignal<Option<Arc<Lesson>>>,
    /// From 0; after the last one comes the summary.
    pub step: RwSignal<usize>,
    /// Steps whose question was answered rightly.
    pub right: RwSignal<BTreeSet<usize>>,
    /// Whether the last answer to this step's question was right.
    pub answered: RwSignal<Option<bool>>,
    /// Values of the step's expressions.
    pub values: RwSignal<BTreeMap<String, Result<f64, String>>>,
    /// Why a lesson's file was not taken.
    pub refused: RwSignal<Option<String>>,
    /// State of a link, until the lessons are known.
    linked: RwSignal<Option<String>>,
}

impl Lessons {
    /// The step that is shown; `None` before a lesson is chosen and at its summary.
    pub fn current(self) -> Option<LessonStep> {
        let step = self.step.get();
        self.now.with(|now| now.as_ref().and_then(|lesson| lesson.steps.get(step).cloned()))
    }

    /// A text in the language of the desk, with the values of its expressions.
    pub fn in_language(self, words: &BTreeMap<String, String>) -> String {
        let text = words.get(language().tag()).or_else(|| words.get("en")).or_else(|| words.values().next());
        let value = |(expression, decimals): (&str, Option<usize>)| {
            self.values.with(|values| match (values.get(expression), decimals) {
                (Some(Ok(value)), Some(decimals)) => format::fixed(*value, decimals),
                (Some(Ok(value)), None) if value.fract() == 0.0 && value.abs() < 1e6 => format::fixed(*value, 0),
                (Some(Ok(value)), None) => format::compact(*value),
                (Some(Err(error)), _) => format!("[{error}]"),
                (None, _) => "…".to_owned(),
            })
        };
        let all = pieces(text.map_or("", String::as_str));
        all.into_iter().map(|(before, inside)| before.to_owned() + &inside.map_or(String::new(), value)).collect()
    }

    /// Step and right answers, as in a link: `2;0,1`.
    pub fn state(self) -> String {
        self.right.with(|right| written(self.step.get(), right))
    }

    /// How many questions of a lesson are answered, and how many there are.
    pub fn progress(self, lesson: &Lesson) -> (usize, usize) {
        let (_, right) = kept(lesson);
        (right.len(), lesson.steps.iter().filter(|step| step.ask.is_some()).count())
    }
}

/// Step and right answers, as they are kept.
fn written(step: usize, right: &BTreeSet<usize>) -> String {
    let right: Vec<String> = right.iter().map(usize::to_string).collect();
    format!("{step};{}", right.join(","))
}

fn key(lesson: &Lesson) -> String {
    format!("lesson.{}", lesson.id)
}

fn kept(lesson: &Lesson) -> (usize, BTreeSet<usize>) {
    page::preference(&key(lesson)).map_or_else(Default::default, |state| parsed(&state, lesson))
}

fn parsed(state: &str, lesson: &Lesson) -> (usize, BTreeSet<usize>) {
    let (step, right) = state.split_once(';').unwrap_or((state, ""));
    let steps = lesson.steps.len();
    let right = right.split(',').filter_map(|step| step.parse().ok()).filter(|step| *step < steps);
    (step.parse().unwrap_or(0).min(steps), right.collect())
}

impl Desk {
    /// Shows or hides the lessons.
    pub fn show_lessons(self, shown: bool) {
        self.lessons.shown.set(shown);
        if shown && self.lessons.all.with_untracked(Vec::is_empty) {
            self.inquire(Inquiry::Lessons);
        }
    }

    /// Takes the lessons of the program.
    pub(super) fn lessons_came(self, all: Vec<Lesson>) {
        self.lessons.all.set(all.into_iter().map(Arc::new).collect());
        if let Some(linked) = self.lessons.linked.try_update(Option::take).flatten() {
            self.follow_lesson(&linked);
        }
    }

    /// Takes a lesson's file, or tells what is wrong with it.
    pub(super) fn lesson_read(self, read: Result<Lesson, String>) {
        match read {
            Ok(lesson) => {
                let lesson = Arc::new(lesson);
                self.lessons.refused.set(None);
                self.lessons.all.update(|all| {
                    all.retain(|other| other.id != lesson.id);
                    all.push(lesson.clone());
                });
                self.begin_lesson(&lesson);
            }
            Err(error) => self.lessons.refused.set(Some(error)),
        }
    }

    /// Hands over progress in all lessons as a file.
    pub fn save_lesson_progress(self) {
        let open = self.lessons.now.with_untracked(|now| now.as_ref().map(|lesson| lesson.id.clone()));
        let begun = self.lessons.all.with_untracked(|all| {
            let begun = all.iter().filter(|lesson| page::preference(&key(lesson)).is_some());
            let reached = |lesson: &Arc<Lesson>| {
                let (step, right) = kept(lesson);
                (lesson.id.clone(), Reached { step, right })
            };
            begun.map(reached).collect()
        });
        let progress = LessonProgress::new(open, begun).text();
        if let Err(detail) = download("lesson-progress.json", "application/json", progress.as_bytes()) {
            self.say(true, Until::NextWork, move || text::cannot_save(&detail));
        }
    }

    /// Takes the progress of a file in place of what was kept of these lessons, and opens the one that was open.
    fn take_lesson_progress(self, progress: &LessonProgress) {
        let lessons = self.lessons;
        lessons.refused.set(None);
        for (id, Reached { step, right }) in &progress.lessons {
            page::set_preference(&format!("lesson.{id}"), &written(*step, right));
        }
        // The list shows what is kept; nothing else reports it.
        lessons.all.update(|_| ());
        let open = progress.open.as_ref();
        let known = open.and_then(|id| lessons.all.with_untracked(|all| all.iter().find(|one| one.id == *id).cloned()));
        if let Some(lesson) = known {
            self.begin_lesson(&lesson);
        }
    }

    /// Lets a lesson's file be chosen, or one of progress.
    pub fn open_lesson_file(self) {
        choose(".json", false, move |files| {
            leptos::task::spawn_local(async move {
                for file in files {
                    match file.content.read().await {
                        Ok(bytes) => {
                            let text = String::from_utf8_lossy(&bytes).into_owned();
                            match LessonProgress::read(&text) {
                                Some(Ok(progress)) => self.take_lesson_progress(&progress),
                                Some(Err(error)) => self.lessons.refused.set(Some(error)),
                                None => self.inquire(Inquiry::ReadLesson(text)),
                            }
                        }
                        Err(error) => self.lessons.refused.set(Some(error)),
                    }
                }
            });
        });
    }

    /// Begins a lesson, or goes on with it.
    pub fn begin_lesson(self, lesson: &Arc<Lesson>) {
        let (step, right) = kept(lesson);
        self.lessons.now.set(Some(lesson.clone()));
        self.lessons.right.set(right);
        let network =
            lesson.project.as_ref().map_or(Network::Lab, |project| Network::Lesson(Arc::new(project.clone())));
        self.inside.network.set(network);
        self.inside
            .moved
            .set(lesson.steps.iter().take(step + 1).filter_map(|one| one.show.moved).next_back().unwrap_or(0.0));
        self.begin_inside();
        // A lesson that is through begins anew, with its answers.
        self.go_to_lesson_step(if step < lesson.steps.len() { step } else { 0 });
    }

    /// Goes to a step of the lesson and shows its view.
    pub fn go_to_lesson_step(self, step: usize) {
        let (lessons, inside) = (self.lessons, self.inside);
        let Some(lesson) = lessons.now.get_untracked() else { return };
        lessons.step.set(step);
        lessons.answered.set(None);
        lessons.values.set(BTreeMap::new());
        page::set_preference(&key(&lesson), &untrack(|| lessons.state()));
        let Some(now) = lesson.steps.get(step) else { return };
        let show = &now.show;
        inside.tab.set(match show.screen {
            Screen::Matrices => Tab::Matrices,
            Screen::Datum => Tab::Datum,
            Screen::Errors => Tab::Errors,
            Screen::Weights => Tab::Weights,
        });
        // Going back to a step, what earlier ones set holds.
        let moved = lesson.steps[..=step].iter().filter_map(|one| one.show.moved).next_back();
        if moved.is_some_and(|moved| moved != inside.moved.get_untracked()) {
            inside.moved.set(moved.unwrap_or_default());
            self.begin_inside();
        } else if let Some(step) = show.step {
            self.run_inside_to(step);
        }
        inside.wanted.set(show.clone());
        self.value_lesson();
    }

    /// Asks for the values of this step's expressions, of the network that is laid open.
    pub(super) fn value_lesson(self) {
        let lessons = self.lessons;
        if let Some(now) = untrack(|| lessons.current()) {
            lessons.values.set(BTreeMap::new());
            self.inquire(Inquiry::Evaluate(now.expressions()));
        }
    }

    /// Takes the values of the step's expressions.
    pub(super) fn lesson_valued(self, texts: Vec<String>, values: Vec<Result<f64, String>>) {
        let now = untrack(|| self.lessons.current()).map(|step| step.expressions());
        if now.as_ref() == Some(&texts) {
            self.lessons.values.set(texts.into_iter().zip(values).collect());
        }
    }

    /// Whether the value of an expression is known; what is wrong with it.
    pub fn lesson_value(self, expression: &str) -> Option<Result<f64, String>> {
        self.lessons.values.with(|values| values.get(expression).cloned())
    }

    /// Takes an answer to the question of this step.
    pub fn answer_lesson(self, right: bool) {
        let lessons = self.lessons;
        lessons.answered.set(Some(right));
        if right {
            lessons.right.update(|all| {
                all.insert(lessons.step.get_untracked());
            });
        }
        if let Some(lesson) = lessons.now.get_untracked() {
            page::set_preference(&key(&lesson), &untrack(|| lessons.state()));
        }
    }

    /// Applies the part of the address after `inside/`: a lesson and its state.
    pub fn follow_lesson(self, rest: &str) {
        let (id, state) = rest.split_once('/').unwrap_or((rest, ""));
        let known = self.lessons.all.with_untracked(|all| all.iter().find(|lesson| lesson.id == id).cloned());
        match known {
            Some(lesson) => {
                let (step, right) = parsed(state, &lesson);
                page::set_preference(&key(&lesson), &written(step, &right));
                self.lessons.shown.set(true);
                self.begin_lesson(&lesson);
            }
            None if self.lessons.all.with_untracked(Vec::is_empty) => {
                self.lessons.linked.set(Some(rest.to_owned()));
                self.show_lessons(true);
            }
            None => {}
        }
    }

    /// Follows the address where it names a lesson.
    pub fn follow_lesson_in_address(self) {
        let hash = page::hash();
        if let Some(rest) = hash.strip_prefix(Step::Inside.name()).and_then(|rest| rest.strip_prefix('/')) {
            self.follow_lesson(rest);
        }
    }
}
