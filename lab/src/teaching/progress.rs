//! Where a student is in the lessons, as a file: to continue in another browser, or to send to the teacher.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

/// The `format` of the file.
pub const PROGRESS_FORMAT: &str = "sightline-lesson-progress";

/// Progress in every lesson that was begun.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LessonProgress {
    /// [`PROGRESS_FORMAT`].
    pub format: String,
    /// Of the format: 1.
    pub version: u32,
    /// The lesson that is open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub open: Option<String>,
    /// By the lesson's id.
    pub lessons: BTreeMap<String, Reached>,
}

/// Progress in a lesson.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reached {
    /// The step that is shown, from 0; the number of steps at the summary.
    pub step: usize,
    /// Steps whose question was answered rightly.
    pub right: BTreeSet<usize>,
}

impl LessonProgress {
    /// Of these lessons.
    pub fn new(open: Option<String>, lessons: BTreeMap<String, Reached>) -> Self {
        Self { format: PROGRESS_FORMAT.to_owned(), version: 1, open, lessons }
    }

    /// The file's text.
    pub fn text(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default()
    }

    /// Reads the text of a file; `None` for a text of another format.
    ///
    /// # Errors
    /// The error, in English.
    pub fn read(text: &str) -> Option<Result<Self, String>> {
        let value: serde_json::Value = serde_json::from_str(text).ok()?;
        if value.get("format")?.as_str()? != PROGRESS_FORMAT {
            return None;
        }
        Some(match serde_json::from_value::<Self>(value) {
            Ok(progress) if progress.version == 1 => Ok(progress),
            Ok(progress) => {
                Err(format!("version {} of {PROGRESS_FORMAT}; this program reads version 1", progress.version))
            }
            Err(error) => Err(error.to_string()),
        })
    }
}
