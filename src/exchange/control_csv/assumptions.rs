//! What reading a table took for granted, as data: each with what it rests on, so that it can be shown and, where nothing
//! decides, asked.

use serde::{Deserialize, Serialize};

use super::columns::Field;
use crate::units::Unit;

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

/// What separates the fields of a row.
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

/// What an assumption rests on.
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

/// How a table was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Assumption {
    /// What separates the fields.
    Separator {
        /// The separator.
        separator: Separator,
        /// What it rests on.
        by: Basis,
    },
    /// Decimal sign.
    DecimalSign {
        /// The sign.
        sign: Decimal,
        /// What it rests on.
        by: Basis,
        /// A number of the table that can be read in two ways, where there is one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        example: Option<String>,
    },
    /// What each column holds; null: it is left alone.
    Columns {
        /// Column by column.
        columns: Vec<Option<Field>>,
        /// What it rests on.
        by: Basis,
    },
    /// Which of the two horizontal coordinates comes first.
    AxisOrder {
        /// The order.
        order: Axes,
        /// What it rests on.
        by: Basis,
    },
    /// Columns that are taken for standard errors.
    SigmaColumns {
        /// Their places, from 0.
        columns: Vec<usize>,
        /// What it rests on.
        by: Basis,
    },
    /// Unit of the coordinates; null: not known.
    Unit {
        /// The unit.
        unit: Option<Unit>,
        /// What it rests on.
        by: Basis,
    },
    /// Columns whose headings are not understood, and which are left alone.
    Ignored {
        /// Their headings.
        columns: Vec<String>,
    },
    /// What a heading has in round brackets and is neither an axis nor a unit.
    Remarks {
        /// The headings.
        headings: Vec<String>,
    },
}

impl Assumption {
    /// What it rests on.
    pub fn by(&self) -> Basis {
        match self {
            Self::Separator { by, .. }
            | Self::DecimalSign { by, .. }
            | Self::Columns { by, .. }
            | Self::AxisOrder { by, .. }
            | Self::SigmaColumns { by, .. }
            | Self::Unit { by, .. } => *by,
            Self::Ignored { .. } | Self::Remarks { .. } => Basis::Heading,
        }
    }
}

/// What the reader of a table knows and the table does not say.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Choices {
    /// Decimal sign; null: from the rows.
    pub decimal: Option<Decimal>,
    /// Order of the horizontal coordinates of a table without heading; null: X before Y.
    pub axes: Option<Axes>,
    /// Unit of the coordinates of a table whose heading has none.
    pub unit: Option<Unit>,
}
