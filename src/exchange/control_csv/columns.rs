//! Which column of a control table holds what: from its heading, else from the number of columns and what is in them.

use crate::error::Reason;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    Id,
    Label,
    X,
    Y,
    Z,
    Sx,
    Sy,
    Sz,
    /// One sigma for all axes.
    Sigma,
    Role,
}

/// What is wrong in which field.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    pub field: &'static str,
    pub reason: Reason,
}

impl Field {
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
            Self::Sigma => "sigma",
            Self::Role => "role",
        }
    }

    pub fn fault(self, reason: Reason) -> Fault {
        Fault { field: self.name(), reason }
    }

    /// The field that a heading names, whatever its case, unit ("X [mm]") and punctuation ("s_x", "sigma X").
    fn named(heading: &str) -> Option<Self> {
        let bare = heading.split(['[', '(']).next().unwrap_or_default();
        let plain: String = bare.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect();
        Some(match plain.as_str() {
            "id" | "point" | "pointid" | "pt" | "no" | "nr" | "number" | "pointno" | "code" | "점" | "점번호"
            | "번호" => Self::Id,
            "label" | "name" | "description" | "이름" => Self::Label,
            "x" | "e" | "east" | "easting" => Self::X,
            "y" | "n" | "north" | "northing" => Self::Y,
            "z" | "h" | "height" | "elevation" => Self::Z,
            "sx" | "sigmax" | "σx" | "stdx" | "mx" | "sdx" | "se" | "sigmae" => Self::Sx,
            "sy" | "sigmay" | "σy" | "stdy" | "my" | "sdy" | "sn" | "sigman" => Self::Sy,
            "sz" | "sigmaz" | "σz" | "stdz" | "mz" | "sdz" | "sh" | "sigmah" => Self::Sz,
            "s" | "sigma" | "σ" | "std" | "sd" | "sxyz" | "sigmaxyz" => Self::Sigma,
            "role" | "type" => Self::Role,
            _ => return None,
        })
    }
}

/// The fields of a table in the order of its columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns(Vec<Option<Field>>);

impl Columns {
    /// Column of a field.
    pub fn place(&self, field: Field) -> Option<usize> {
        self.0.iter().position(|column| *column == Some(field))
    }
}

/// The columns that a heading names: one that has X, Y and Z.
pub fn heading(fields: &[String]) -> Option<Columns> {
    let mut columns: Vec<Option<Field>> = fields.iter().map(|field| Field::named(field)).collect();
    let has = |columns: &[Option<Field>], field| columns.contains(&Some(field));
    if ![Field::X, Field::Y, Field::Z].into_iter().all(|field| has(&columns, field)) {
        return None;
    }
    // "name" stands for the id where there is no other, and so does a first column of any other name.
    if !has(&columns, Field::Id) {
        match columns.iter().position(|column| *column == Some(Field::Label)) {
            Some(place) => columns[place] = Some(Field::Id),
            None if columns[0].is_none() => columns[0] = Some(Field::Id),
            None => return None,
        }
    }
    Some(Columns(columns))
}

/// The columns of a table without heading: id, perhaps a label, X, Y, Z, then one sigma or three; what follows is left alone.
pub fn guessed<'a>(rows: impl Iterator<Item = &'a [String]>) -> Result<Columns, Fault> {
    let rows: Vec<&[String]> = rows.collect();
    let widest = rows.iter().map(|row| row.len()).max().unwrap_or(0);
    if widest < 4 {
        return Err(Fault { field: "Z", reason: Reason::ControlColumns { columns: widest } });
    }
    // Numbers of either decimal mark, as long as nothing else is in them.
    let numeric = |word: &String| word.replacen(',', ".", 1).parse::<f64>().is_ok();
    let labelled =
        rows.iter().filter(|row| row.len() >= 5 && !numeric(&row[1]) && row[2..5].iter().all(numeric)).count();
    let mut columns = vec![Some(Field::Id)];
    if labelled * 2 > rows.len() {
        columns.push(Some(Field::Label));
    }
    columns.extend([Field::X, Field::Y, Field::Z].map(Some));
    match widest - columns.len() {
        0 => {}
        1 | 2 => columns.push(Some(Field::Sigma)),
        _ => columns.extend([Field::Sx, Field::Sy, Field::Sz].map(Some)),
    }
    Ok(Columns(columns))
}
