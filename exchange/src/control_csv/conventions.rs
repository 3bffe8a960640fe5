//! What a table leaves open - decimal sign, order of axes, separator - and what a decision of it rests on.

use serde::{Deserialize, Serialize};

/// Decimal sign of the numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Decimal {
    /// A point; commas are thousands separators.
    Point,
    /// A comma.
    Comma,
}

/// Order of the two horizontal coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Axes {
    /// X (east) before Y (north).
    Xy,
    /// Y (north) before X (east).
    Yx,
}

/// Separator of the fields of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Separator {
    /// A comma.
    Comma,
    /// A semicolon.
    Semicolon,
    /// A tab.
    Tab,
    /// Blanks.
    Blanks,
}

impl Separator {
    /// The byte that separates, where it is one.
    pub(super) fn byte(self) -> Option<u8> {
        match self {
            Self::Comma => Some(b','),
            Self::Semicolon => Some(b';'),
            Self::Tab => Some(b'\t'),
            Self::Blanks => None,
        }
    }
}

/// Basis of an assumption.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Basis {
    /// The heading says so.
    Heading,
    /// The rows leave no other choice.
    Content,
    /// The caller said so.
    Given,
    /// A convention of this program; nothing in the table contradicts it.
    Convention,
    /// Nothing decides: it has to be asked. The value is what was used meanwhile.
    Undecided,
}
