//! Lessons as data: texts in several languages, what each step shows on the real screens, and questions whose answers are expressions
//! of the network ([`super::evaluate`]), so that no answer is typed. `docs/lessons.md` describes the file.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use sightline::project::Project;

/// The `format` of a lesson's file.
pub const LESSON_FORMAT: &str = "sightline-lesson";

/// A text by tags of languages (`en`, `ko`). In braces stand expressions whose values are put in: `{n - u}`, `{sigma0|3}` with three decimals.
pub type Words = BTreeMap<String, String>;

/// A lesson.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lesson {
    /// [`LESSON_FORMAT`].
    pub format: String,
    /// Of the format: 1.
    pub version: u32,
    /// Short name, under which progress is kept.
    pub id: String,
    /// How long it takes.
    pub minutes: u32,
    /// Title.
    pub title: Words,
    /// Learning goal.
    pub aim: Words,
    /// The network; without one that of [`super::lab`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub project: Option<Project>,
    /// Steps, in their order.
    pub steps: Vec<LessonStep>,
    /// What is to be kept.
    pub summary: Words,
}

/// A step of a lesson.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LessonStep {
    /// Contents that are read.
    pub text: Words,
    /// Picture for the screen.
    pub show: Show,
    /// The question.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ask: Option<Question>,
}

/// A part of the view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Screen {
    /// Equations, matrices, unknowns, iterations.
    #[default]
    Matrices,
    /// Three datums.
    Datum,
    /// A planted error.
    Errors,
    /// Standard errors of groups, size of targets.
    Weights,
}

/// State of the screen; settings that are not given stay as the user left them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Show {
    /// Part of the view.
    pub screen: Screen,
    /// Share of the object's size by which start values are moved ([`super::moved`]).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moved: Option<f64>,
    /// Steps of the iteration taken.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step: Option<usize>,
    /// The observation that is explained, or has the planted error: `2 7 x`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub observation: Option<String>,
    /// Size of the planted error in standard errors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size: Option<f64>,
    /// Factor on the standard errors of image coordinates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<f64>,
    /// Factor on those of control coordinates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub control: Option<f64>,
    /// The movement of the free network that is drawn, as in [`sightline::adjust::Motion`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<String>,
}

/// A question: for a number (`value` and `tolerance`) or for one of several choices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Question {
    /// The question.
    pub text: Words,
    /// Expression of the number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
    /// How far a typed number may be off: as much as the screen rounds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Unit of the number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// Answers to choose from.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub choices: Vec<Choice>,
    /// Help after a wrong answer.
    pub hint: Words,
    /// Text after the right answer.
    pub why: Words,
}

/// An answer to choose.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// The answer.
    pub text: Words,
    /// It is right where this expression is not 0.
    pub when: String,
}

impl Lesson {
    /// Reads the text of a lesson's file.
    ///
    /// # Errors
    /// The error, in English, for the author.
    pub fn read(text: &str) -> Result<Self, String> {
        let lesson: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        if lesson.format != LESSON_FORMAT || lesson.version != 1 {
            return Err(format!("format is not \"{LESSON_FORMAT}\", version 1"));
        }
        if lesson.id.is_empty() || !lesson.id.chars().all(|c| c.is_ascii_alphanumeric() || c == '-') {
            return Err(format!("id \"{}\": letters, digits and hyphens", lesson.id));
        }
        if lesson.steps.is_empty() {
            return Err("no steps".to_owned());
        }
        for (k, step) in lesson.steps.iter().enumerate() {
            let Some(ask) = &step.ask else { continue };
            let number = ask.value.is_some() && ask.tolerance.is_some_and(|by| by.is_finite() && by >= 0.0);
            if number == (ask.choices.len() >= 2) {
                return Err(format!("step {}: either a value with a tolerance or at least two choices", k + 1));
            }
        }
        if let Some(words) = lesson.all_words().find(|words| words.is_empty()) {
            return Err(format!("a text without a language: {words:?}"));
        }
        Ok(lesson)
    }

    /// All texts.
    pub fn all_words(&self) -> impl Iterator<Item = &Words> {
        [&self.title, &self.aim, &self.summary].into_iter().chain(self.steps.iter().flat_map(LessonStep::words))
    }
}

impl LessonStep {
    /// Its texts.
    pub fn words(&self) -> impl Iterator<Item = &Words> {
        let asked = self.ask.iter().flat_map(|ask| {
            [&ask.text, &ask.hint, &ask.why].into_iter().chain(ask.choices.iter().map(|choice| &choice.text))
        });
        std::iter::once(&self.text).chain(asked)
    }

    /// All expressions of the step: in its texts, its value, its choices.
    pub fn expressions(&self) -> Vec<String> {
        let mut all: Vec<String> = self.words().flat_map(expressions).collect();
        if let Some(ask) = &self.ask {
            all.extend(ask.value.iter().cloned().chain(ask.choices.iter().map(|choice| choice.when.clone())));
        }
        all.sort();
        all.dedup();
        all
    }
}

/// Expressions in the braces of a text.
pub fn expressions(words: &Words) -> impl Iterator<Item = String> {
    words.values().flat_map(|text| pieces(text)).filter_map(|(_, inside)| Some(inside?.0.to_owned()))
}

/// Text before a brace, and the expression inside it with its decimals; the last piece of a text has none.
pub type Piece<'a> = (&'a str, Option<(&'a str, Option<usize>)>);

/// A text cut at its braces.
pub fn pieces(text: &str) -> Vec<Piece<'_>> {
    let mut all = Vec::new();
    let mut rest = text;
    while let Some((before, (inside, after))) =
        rest.split_once('{').and_then(|(before, after)| Some((before, after.split_once('}')?)))
    {
        let (expression, decimals) = match inside.split_once('|') {
            Some((expression, decimals)) => (expression, decimals.trim().parse().ok()),
            None => (inside, None),
        };
        all.push((before, Some((expression.trim(), decimals))));
        rest = after;
    }
    all.push((rest, None));
    all
}

/// The lessons that come with the program; a test reads every file.
pub fn lessons() -> Vec<Lesson> {
    let files = [
        include_str!("lessons/weights.json"),
        include_str!("lessons/collinearity.json"),
        include_str!("lessons/iteration.json"),
        include_str!("lessons/datum.json"),
        include_str!("lessons/reliability.json"),
        include_str!("lessons/calibration.json"),
        include_str!("lessons/eccentricity.json"),
        include_str!("lessons/design.json"),
    ];
    files.into_iter().filter_map(|text| Lesson::read(text).ok()).collect()
}
