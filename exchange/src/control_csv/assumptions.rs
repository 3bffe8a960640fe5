//! Assumptions made when reading a table, as data: each with its basis, so that it can be shown or, if undecided, asked.

use serde::{Deserialize, Serialize};

use super::angles::AngleForm;
use super::columns::Field;
use super::conventions::{Axes, Basis, Decimal, Separator};
use super::sigma::SigmaRule;
use crate::encoding::Encoding;
use sightline::axes::UserAxes;
use sightline::project::LocalSystem;
use sightline::units::Unit;

/// Kind of list.
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

/// Contents of a list other than points.
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
    /// Points that are given by latitude and longitude only, beside others with plane coordinates.
    Geographic,
}

/// How a table was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Assumption {
    /// Field separator.
    Separator {
        /// The separator.
        separator: Separator,
        /// Basis.
        by: Basis,
    },
    /// Decimal sign.
    DecimalSign {
        /// The sign.
        sign: Decimal,
        /// Basis.
        by: Basis,
        /// A number of the table that can be read in two ways, where there is one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        example: Option<String>,
    },
    /// Content of each column; null: it is ignored.
    Columns {
        /// Column by column.
        columns: Vec<Option<Field>>,
        /// Basis.
        by: Basis,
    },
    /// Which of the two horizontal coordinates comes first.
    AxisOrder {
        /// The order.
        order: Axes,
        /// Basis.
        by: Basis,
    },
    /// Latitudes, longitudes and heights, taken as ellipsoidal, are converted into a local system; its origin is rounded from the mean of the
    /// list where the caller gives none.
    LocalSystem {
        /// The system.
        system: LocalSystem,
        /// How the angles are written.
        form: AngleForm,
        /// Unit of the heights in the list.
        height_unit: Unit,
        /// What the origin rests on: given, or a convention.
        by: Basis,
    },
    /// Columns that are taken for standard errors.
    SigmaColumns {
        /// Their places, from 0.
        columns: Vec<usize>,
        /// Basis.
        by: Basis,
    },
    /// Unit of the coordinates; null: not known.
    Unit {
        /// The unit.
        unit: Option<Unit>,
        /// Basis.
        by: Basis,
    },
    /// One standard error for the points that have none of their own.
    CommonSigma {
        /// The rule.
        rule: SigmaRule,
        /// How many points.
        points: usize,
        /// Basis; undecided if the unit of the coordinates must be known first.
        by: Basis,
    },
    /// Kind of list.
    Format {
        /// The kind.
        format: ListFormat,
        /// Basis.
        by: Basis,
    },
    /// Encoding of the characters.
    Encoding {
        /// The encoding.
        encoding: Encoding,
        /// Basis; a convention if none of the others applies.
        by: Basis,
    },
    /// The first row of points, where lines before it are skipped.
    FirstRow {
        /// Line, counted from 1.
        line: usize,
        /// Basis.
        by: Basis,
    },
    /// Contents of the list other than points, which are not imported.
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
    /// Text in round brackets in a heading that is neither an axis nor a unit.
    Remarks {
        /// The headings.
        headings: Vec<String>,
    },
}

impl Assumption {
    /// Basis.
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
            | Self::LocalSystem { by, .. }
            | Self::Unit { by, .. } => *by,
            Self::Beside { .. } => Basis::Content,
            Self::NamesMade { .. } => Basis::Convention,
            Self::Ignored { .. } | Self::Remarks { .. } => Basis::Heading,
        }
    }
}

/// The user's choices for a table that is ambiguous.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct TableChoices {
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
    /// Field separator; null: detected from the rows.
    pub separator: Option<Separator>,
    /// Line of the first row of points, counted from 1; the row before it is the heading. Null: from the rows.
    pub first_line: Option<usize>,
    /// Unit of columns of standard errors whose heading has none; null: that of the coordinates.
    pub sigma_unit: Option<Unit>,
    /// One standard error for all points that have none of their own.
    pub sigma: Option<SigmaRule>,
    /// The local system of latitudes and longitudes, that of the project where it has one; null: at the mean of the list.
    pub local_system: Option<LocalSystem>,
}
