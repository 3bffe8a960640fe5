//! Assumptions made when reading a table, as data: each with its basis, so that it can be shown or, if undecided, asked.

use serde::{Deserialize, Serialize};

use super::columns::Field;
use super::sigma::SigmaRule;
use crate::axes::UserAxes;
use crate::exchange::encoding::Encoding;
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

/// What kind of list it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ListFormat {
    /// A table.
    #[default]
    Table,
    /// Leica GSI, of 8 or 16 places.
    LeicaGsi,
    /// Sokkia SDR 2x or 33.
    SokkiaSdr,
    /// Trimble JobXML.
    JobXml,
    /// LandXML.
    LandXml,
    /// Ground control points of ODM, a row an image measurement.
    OdmGcp,
}

/// What a list has beside points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Beside {
    /// Lines before the heading or the first row.
    LinesBefore,
    /// Measurements of an instrument: directions, distances, heights of prisms.
    Measurements,
    /// Places of points in photos.
    ImageMeasurements,
    /// Points that are marked as deleted.
    Deleted,
    /// References to points given elsewhere.
    References,
    /// Points that are given by latitude and longitude only.
    Geographic,
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
    /// One standard error for the points that have none of their own.
    CommonSigma {
        /// The rule.
        rule: SigmaRule,
        /// How many points.
        points: usize,
        /// What it rests on; undecided: the unit of the coordinates has to be known first.
        by: Basis,
    },
    /// What kind of list it is.
    Format {
        /// The kind.
        format: ListFormat,
        /// What it rests on.
        by: Basis,
    },
    /// Encoding of the characters.
    Encoding {
        /// The encoding.
        encoding: Encoding,
        /// What it rests on; a convention: it is none of the others.
        by: Basis,
    },
    /// The first row of points, where lines before it are passed over.
    FirstRow {
        /// Line, counted from 1.
        line: usize,
        /// What it rests on.
        by: Basis,
    },
    /// What the list has beside its points and is not kept.
    Beside {
        /// What.
        what: Beside,
        /// How many.
        count: usize,
    },
    /// Names that were made up, since the list has none: "GCP 1" and so on.
    NamesMade {
        /// How many.
        count: usize,
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
            | Self::CommonSigma { by, .. }
            | Self::Format { by, .. }
            | Self::Encoding { by, .. }
            | Self::FirstRow { by, .. }
            | Self::Unit { by, .. } => *by,
            Self::Beside { .. } => Basis::Content,
            Self::NamesMade { .. } => Basis::Convention,
            Self::Ignored { .. } | Self::Remarks { .. } => Basis::Heading,
        }
    }
}

/// What the reader of a table knows and the table does not say.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Choices {
    /// Decimal sign; null: from the rows.
    pub decimal: Option<Decimal>,
    /// Order of the horizontal coordinates of a table without heading; null: X before Y.
    pub axes: Option<Axes>,
    /// Axes of the project that the list is for: the order of a table without heading where `axes` chooses none.
    pub project_axes: Option<UserAxes>,
    /// Unit of the coordinates of a table whose heading has none.
    pub unit: Option<Unit>,
    /// What each column holds, null: it is left alone; in place of what heading and content say.
    pub columns: Option<Vec<Option<Field>>>,
    /// Encoding of the bytes; null: from what is in them.
    pub encoding: Option<Encoding>,
    /// What separates the fields; null: from the rows.
    pub separator: Option<Separator>,
    /// Line of the first row of points, counted from 1; the row before it is the heading. Null: from the rows.
    pub first_line: Option<usize>,
    /// Unit of columns of standard errors whose heading has none; null: that of the coordinates.
    pub sigma_unit: Option<Unit>,
    /// One standard error for all points that have none of their own.
    pub sigma: Option<SigmaRule>,
}
