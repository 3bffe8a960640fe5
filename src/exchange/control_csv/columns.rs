//! Contents of the columns of a control table; without a heading, from their number and contents.

use serde::{Deserialize, Serialize};

use super::assumptions::{Axes, Basis};
use crate::axes::UserAxes;
use crate::error::Reason;
use crate::units::Unit;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Field {
    /// Identifier.
    #[serde(rename = "id")]
    Id,
    /// Second name or description.
    #[serde(rename = "label")]
    Label,
    /// X, to the east.
    #[serde(rename = "X")]
    X,
    /// Y, to the north.
    #[serde(rename = "Y")]
    Y,
    /// Z, upwards.
    #[serde(rename = "Z")]
    Z,
    /// Standard error of X.
    #[serde(rename = "sX")]
    Sx,
    /// Standard error of Y.
    #[serde(rename = "sY")]
    Sy,
    /// Standard error of Z.
    #[serde(rename = "sZ")]
    Sz,
    /// One standard error for X and Y.
    #[serde(rename = "sXY")]
    Sxy,
    /// One standard error for all axes.
    #[serde(rename = "sigma")]
    Sigma,
    /// Control, check or tie.
    #[serde(rename = "role")]
    Role,
    /// Diameter of the target.
    #[serde(rename = "diameter")]
    Diameter,
}

/// What is wrong in which field.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fault {
    pub field: &'static str,
    pub reason: Reason,
}

impl Field {
    /// Its name in documents.
    pub fn name(self) -> &'static str {
        match self {
            Self::Id => "id",
            Self::Label => "label",
            Self::X => "X",
            Self::Y => "Y",
            Self::Z => "Z",
            Self::Sx => "sX",
            Self::Sy => "sY",
            Self::Sz => "sZ",
            Self::Sxy => "sXY",
            Self::Sigma => "sigma",
            Self::Role => "role",
            Self::Diameter => "diameter",
        }
    }

    pub(super) fn fault(self, reason: Reason) -> Fault {
        Fault { field: self.name(), reason }
    }

    /// Whether it is a coordinate or a standard error.
    pub fn is_number(self) -> bool {
        self.is_coordinate() || self.is_sigma() || self == Self::Diameter
    }

    pub(super) fn is_coordinate(self) -> bool {
        matches!(self, Self::X | Self::Y | Self::Z)
    }

    pub(super) fn is_sigma(self) -> bool {
        matches!(self, Self::Sx | Self::Sy | Self::Sz | Self::Sxy | Self::Sigma)
    }
}

/// The fields of a table in the order of its columns.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Columns {
    pub fields: Vec<Option<Field>>,
    pub by: Basis,
    /// Unit of each column, as its heading has it.
    pub units: Vec<Option<Unit>>,
    pub order: (Axes, Basis),
    pub ignored: Vec<String>,
    pub remarks: Vec<String>,
}

impl Columns {
    /// Column of a field.
    pub fn place(&self, field: Field) -> Option<usize> {
        self.fields.iter().position(|column| *column == Some(field))
    }

    /// Places of the standard errors.
    pub fn sigmas(&self) -> Vec<usize> {
        let of = |k: &usize| self.fields[*k].is_some_and(Field::is_sigma);
        (0..self.fields.len()).filter(of).collect()
    }
}

/// The columns of a table without heading: id, perhaps a label, X, Y, Z, then one sigma or three, perhaps a description at the end; what
/// follows is left alone.
///
/// One number more may be a standard error or a code: where it is a whole one beside decimals it is asked. Two more may be horizontal and
/// vertical, as Pix4D writes them, or something else: they are asked too.
///
/// Surveying instruments write point, north, east, height, description as often as point, east, north, height, description: with a
/// description at the end the order is asked.
pub(super) fn guessed(rows: &[&[String]], axes: Option<Axes>, project: Option<UserAxes>) -> Result<Columns, Fault> {
    let widest = rows.iter().map(|row| row.len()).max().unwrap_or(0);
    if widest < 4 {
        return Err(Fault { field: "Z", reason: Reason::ControlColumns { columns: widest } });
    }
    // Numbers of either decimal sign, as long as nothing else is in them.
    let numeric = |word: &String| word.replacen(',', ".", 1).parse::<f64>().is_ok();
    let labelled =
        rows.iter().filter(|row| row.len() >= 5 && !numeric(&row[1]) && row[2..5].iter().all(numeric)).count();
    let mut fields = vec![Some(Field::Id)];
    if labelled * 2 > rows.len() {
        fields.push(Some(Field::Label));
    }
    let first = fields.len();
    fields.extend([Field::X, Field::Y, Field::Z].map(Some));
    // Columns behind the coordinates that hold words: a description.
    let held = |word: &String| matches!(word.to_ascii_lowercase().as_str(), "" | "-" | "fix" | "fixed");
    let described = |k: usize| {
        let words = rows.iter().filter_map(|row| row.get(k)).filter(|word| !held(word));
        let (all, texts) = words.fold((0, 0), |(all, texts), word| (all + 1, texts + usize::from(!numeric(word))));
        all > 0 && texts * 2 > all
    };
    let extra: Vec<usize> = (fields.len()..widest).collect();
    let sigmas = extra.iter().take_while(|k| !described(**k)).count();
    match sigmas {
        0 => {}
        1 | 2 => {
            fields.push(Some(Field::Sigma));
            fields.extend(vec![None; sigmas - 1]);
        }
        _ => {
            fields.extend([Field::Sx, Field::Sy, Field::Sz].map(Some));
            fields.extend(vec![None; sigmas - 3]);
        }
    }
    let description = sigmas < extra.len() && !fields.contains(&Some(Field::Label));
    if description {
        fields.push(Some(Field::Label));
    }
    fields.resize(widest, None);
    let column = |k: usize| rows.iter().filter_map(move |row| row.get(k)).filter(|word| !held(word));
    let whole = |word: &String| word.bytes().all(|byte| byte.is_ascii_digit() || byte == b'-');
    let decimals = (first..first + 3).any(|k| column(k).any(|word| numeric(word) && !whole(word)));
    let behind = first + 3..first + 3 + sigmas.min(3);
    let codes = decimals
        && behind
            .clone()
            .any(|k| column(k).next().is_some() && column(k).all(whole) && column(k).any(|word| word != "0"));
    let by = if sigmas == 2 || codes { Basis::Undecided } else { Basis::Convention };
    let order = match (axes, project) {
        (Some(axes), _) => (axes, Basis::Given),
        // Beside coordinates of the project, what is typed or pasted stands as they do.
        (None, Some(UserAxes::Enh)) => (Axes::Xy, Basis::Convention),
        (None, Some(UserAxes::Neh)) => (Axes::Yx, Basis::Convention),
        (None, None) if description => (Axes::Xy, Basis::Undecided),
        (None, None) => (Axes::Xy, Basis::Convention),
    };
    if order.0 == Axes::Yx {
        fields.swap(first, first + 1);
        let sigma = |field| fields.iter().position(|column| *column == Some(field));
        if let (Some(x), Some(y)) = (sigma(Field::Sx), sigma(Field::Sy)) {
            fields.swap(x, y);
        }
    }
    Ok(Columns { units: vec![None; fields.len()], fields, by, order, ignored: Vec::new(), remarks: Vec::new() })
}
