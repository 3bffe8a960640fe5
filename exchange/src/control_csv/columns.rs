//! Contents of the columns of a control table; without a heading, from their number and contents.

use crate::reason::ExchangeReason;
use serde::{Deserialize, Serialize};

use super::conventions::{Axes, Basis};
use super::{angles, decimals};
use sightline::axes::UserAxes;
use sightline::error::Reason;
use sightline::units::Unit;

/// Content of a column.
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
    /// Latitude, in place of Y; then Z is the height over the ellipsoid.
    #[serde(rename = "latitude")]
    Latitude,
    /// Longitude, in place of X.
    #[serde(rename = "longitude")]
    Longitude,
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

/// The error and its field.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fault {
    pub field: String,
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
            Self::Latitude => "latitude",
            Self::Longitude => "longitude",
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
        Fault { field: self.name().to_owned(), reason }
    }

    /// Whether it is a coordinate or a standard error.
    pub fn is_number(self) -> bool {
        self.is_coordinate() || self.is_sigma() || self == Self::Diameter
    }

    /// The axis that a coordinate or a standard error is of.
    pub(super) fn axis(self) -> Option<usize> {
        match self {
            Self::X | Self::Longitude | Self::Sx => Some(0),
            Self::Y | Self::Latitude | Self::Sy => Some(1),
            Self::Z | Self::Sz => Some(2),
            _ => None,
        }
    }

    pub(super) fn is_coordinate(self) -> bool {
        matches!(self, Self::X | Self::Y | Self::Z) || self.is_angle()
    }

    /// Whether it is a latitude or a longitude.
    pub fn is_angle(self) -> bool {
        matches!(self, Self::Latitude | Self::Longitude)
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

    /// Whether places are given by latitude and longitude.
    pub fn is_geographic(&self) -> bool {
        self.place(Field::Latitude).is_some() && self.place(Field::Longitude).is_some()
    }

    /// The fields of the coordinates, east first.
    pub fn coordinates(&self) -> [Field; 3] {
        if self.is_geographic() {
            [Field::Longitude, Field::Latitude, Field::Z]
        } else {
            [Field::X, Field::Y, Field::Z]
        }
    }

    /// Takes two columns of angles that are called X and Y, or nothing at all, for latitude and longitude: by the letters of their directions,
    /// else by `by_axis`, whether it is certain that X is the one to the east, else by a number above 90; else it is asked.
    pub fn take_angles(&mut self, rows: &[&[String]], by_axis: bool) {
        let (Some(x), Some(y)) = (self.place(Field::X), self.place(Field::Y)) else { return };
        let angles = |k: usize| rows.iter().filter_map(move |row| row.get(k)).filter_map(|word| angles::marked(word));
        if [x, y].iter().any(|k| 2 * angles(*k).count() <= rows.len()) {
            return;
        }
        let lettered = |k: usize, axis: usize| angles(k).any(|angle| angle.axis == Some(axis));
        let beyond = |k: usize| angles(k).any(|angle| angle.degrees.abs() > 90.0);
        let exchanged = match () {
            () if lettered(x, 0) || lettered(y, 1) => false,
            () if lettered(x, 1) || lettered(y, 0) => true,
            () if by_axis || beyond(x) => false,
            () if beyond(y) => true,
            () => {
                self.by = Basis::Undecided;
                false
            }
        };
        let (east, north) = if exchanged { (y, x) } else { (x, y) };
        self.fields[east] = Some(Field::Longitude);
        self.fields[north] = Some(Field::Latitude);
        if exchanged && let (Some(sx), Some(sy)) = (self.place(Field::Sx), self.place(Field::Sy)) {
            self.fields.swap(sx, sy);
        }
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
        return Err(Fault { field: "Z".to_owned(), reason: ExchangeReason::ControlColumns { columns: widest }.into() });
    }
    // Numbers of either decimal sign, as long as nothing else is in them.
    let numeric = |word: &String| decimals::is_value(word);
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
