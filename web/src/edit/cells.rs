//! Values typed or pasted into cells of a table: accepted or refused, cell by cell, with the reason.

use std::collections::HashMap;

use sightline::project::{Role, Sigma};

use super::sheet::Col;
use super::{cameras, control, points};
use crate::document::Document;
use crate::document::Table;
use crate::document::keys::observation_key;
use crate::document::keys::observation_of_key;
use crate::format;

/// An edit of a cell: the row by its key, the column, and the typed text.
#[derive(Clone, Debug, PartialEq)]
pub struct CellEdit {
    pub key: String,
    pub col: Col,
    pub typed: String,
}

/// Why a cell is not changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    NoSuchRow,
    NotEditable,
    NotANumber,
    NotPositive,
    NotAFlag,
    NotARole,
    NoName,
    /// Another row has this name.
    NameTaken,
    NoSuchCamera,
    NoSuchPoint,
    SamePoint,
    /// Both points are seen in this photo.
    BothInPhoto(String),
}

const YES: [&str; 7] = ["1", "yes", "y", "true", "✓", "예", "x"];
const NO: [&str; 6] = ["0", "no", "n", "false", "", "아니요"];
const ROLES: [(Role, [&str; 3]); 3] = [
    (Role::Tie, ["tie", "결합점", "tie point"]),
    (Role::Control, ["control", "기준점", "control point"]),
    (Role::Check, ["check", "검사점", "check point"]),
];

fn number(typed: &str) -> Result<f64, Refusal> {
    format::parse(typed).ok_or(Refusal::NotANumber)
}

fn positive(typed: &str) -> Result<f64, Refusal> {
    number(typed).and_then(|value| if value > 0.0 { Ok(value) } else { Err(Refusal::NotPositive) })
}

/// A positive number, or nothing.
fn maybe_positive(typed: &str) -> Result<Option<f64>, Refusal> {
    if typed.trim().is_empty() { Ok(None) } else { positive(typed).map(Some) }
}

fn flag(typed: &str) -> Result<bool, Refusal> {
    let typed = typed.trim().to_lowercase();
    match (YES.contains(&typed.as_str()), NO.contains(&typed.as_str())) {
        (true, _) => Ok(true),
        (_, true) => Ok(false),
        _ => Err(Refusal::NotAFlag),
    }
}

fn role(typed: &str) -> Result<Role, Refusal> {
    let typed = typed.trim().to_lowercase();
    let known = ROLES.iter().find(|(_, words)| words.contains(&typed.as_str()));
    known.map(|(role, _)| *role).ok_or(Refusal::NotARole)
}

/// Writes cells into a document; the rows are indexed once.
pub struct Editor<'a> {
    document: &'a mut Document,
    table: Table,
    rows: HashMap<String, usize>,
}

impl<'a> Editor<'a> {
    pub fn new(document: &'a mut Document, table: Table) -> Self {
        let rows = rows(document, table);
        Self { document, table, rows }
    }

    /// Writes one cell.
    ///
    /// # Errors
    /// The reason for which the value is refused; the document is then unchanged.
    pub fn set(&mut self, cell: &CellEdit) -> Result<(), Refusal> {
        if !self.table.editable(cell.col) {
            return Err(Refusal::NotEditable);
        }
        let at = *self.rows.get(&cell.key).ok_or(Refusal::NoSuchRow)?;
        let renames = match self.table {
            Table::Photos => self.photo(at, cell),
            Table::Cameras => self.camera(at, cell),
            Table::Points | Table::Control => self.point(at, cell),
            Table::Observations => self.observation(at, cell),
            Table::Distances => self.distance(at, cell),
            Table::Identities => self.identity(cell),
        }?;
        if renames {
            self.rows = rows(self.document, self.table);
        }
        Ok(())
    }

    fn photo(&mut self, at: usize, cell: &CellEdit) -> Result<bool, Refusal> {
        match cell.col {
            Col::Camera => {
                let camera = cell.typed.trim();
                if !self.document.project.cameras.iter().any(|c| c.id == camera) {
                    return Err(Refusal::NoSuchCamera);
                }
                let photos = [cell.key.clone()].into();
                cameras::assign(self.document.project_mut(), &photos, camera);
                Ok(false)
            }
            _ => {
                let enabled = flag(&cell.typed)?;
                self.document.project_mut().photos[at].enabled = enabled;
                Ok(false)
            }
        }
    }

    fn camera(&mut self, at: usize, cell: &CellEdit) -> Result<bool, Refusal> {
        match cell.col {
            Col::Id => {
                let name = new_name(&cell.typed)?;
                if self.document.project.cameras.iter().enumerate().any(|(k, c)| k != at && c.id == name) {
                    return Err(Refusal::NameTaken);
                }
                cameras::rename(self.document.project_mut(), &cell.key, &name);
                Ok(true)
            }
            Col::Pitch => {
                let pitch = maybe_positive(&cell.typed)?.map(|um| [um / 1000.0; 2]);
                cameras::set_pitch(self.document.project_mut(), &cell.key, pitch, &Default::default());
                Ok(false)
            }
            _ => {
                let value = maybe_positive(&cell.typed)?;
                cameras::set_principal_distance(self.document.project_mut(), &cell.key, value);
                Ok(false)
            }
        }
    }

    fn point(&mut self, at: usize, cell: &CellEdit) -> Result<bool, Refusal> {
        let axis = match cell.col {
            Col::X | Col::SigmaX => 0,
            Col::Y | Col::SigmaY => 1,
            _ => 2,
        };
        match cell.col {
            Col::Id => {
                let name = new_name(&cell.typed)?;
                let renamed = points::rename(self.document.project_mut(), &cell.key, &name);
                renamed.map(|_| true).map_err(Refusal::BothInPhoto)
            }
            Col::Role => {
                let role = role(&cell.typed)?;
                self.document.project_mut().points[at].role = role;
                Ok(self.table == Table::Control)
            }
            Col::Diameter => {
                let diameter = maybe_positive(&cell.typed)?;
                self.document.project_mut().points[at].diameter = diameter;
                Ok(false)
            }
            Col::X | Col::Y | Col::Z => {
                let value = number(&cell.typed)?;
                control::set_coordinate(self.document.project_mut(), &cell.key, axis, value);
                Ok(false)
            }
            _ => {
                let sigma = match number(&cell.typed) {
                    Err(_) if cell.typed.trim().is_empty() => None,
                    Ok(sigma) if sigma >= 0.0 => Some(sigma).filter(|sigma| *sigma > 0.0),
                    Ok(_) => return Err(Refusal::NotPositive),
                    Err(refusal) => return Err(refusal),
                };
                control::set_sigma(self.document.project_mut(), &cell.key, axis, sigma);
                Ok(false)
            }
        }
    }

    fn observation(&mut self, at: usize, cell: &CellEdit) -> Result<bool, Refusal> {
        if cell.col == Col::Point {
            let name = new_name(&cell.typed)?;
            let (photo, point) = observation_of_key(&cell.key).ok_or(Refusal::NoSuchRow)?;
            if name != point && self.rows.contains_key(&observation_key(photo, &name)) {
                return Err(Refusal::BothInPhoto(photo.to_owned()));
            }
            points::rename_here(self.document.project_mut(), photo, point, &name);
            return Ok(true);
        }
        let value = match cell.col {
            Col::TakesPart => f64::from(u8::from(flag(&cell.typed)?)),
            Col::Sigma => positive(&cell.typed)?,
            _ => number(&cell.typed)?,
        };
        let o = &mut self.document.project_mut().observations[at];
        match cell.col {
            Col::TakesPart => o.enabled = value > 0.0,
            Col::Sigma => o.sigma = Sigma::One(value),
            // A typed position is not the centre of the detected target any more.
            Col::U if o.u != value => (o.u, o.target) = (value, None),
            Col::V if o.v != value => (o.v, o.target) = (value, None),
            _ => {}
        }
        Ok(false)
    }

    fn distance(&mut self, at: usize, cell: &CellEdit) -> Result<bool, Refusal> {
        let mut distance = self.document.project.distances[at].clone();
        match cell.col {
            Col::Length => distance.length = positive(&cell.typed)?,
            Col::Sigma => distance.sigma = positive(&cell.typed)?,
            end => {
                let name = new_name(&cell.typed)?;
                if !self.document.project.points.iter().any(|p| p.id == name) {
                    return Err(Refusal::NoSuchPoint);
                }
                *(if end == Col::From { &mut distance.from } else { &mut distance.to }) = name;
                if distance.from == distance.to {
                    return Err(Refusal::SamePoint);
                }
            }
        }
        self.document.project_mut().distances[at] = distance;
        Ok(false)
    }

    /// Names a target, or removes its name.
    fn identity(&mut self, cell: &CellEdit) -> Result<bool, Refusal> {
        let (photo, number) = observation_of_key(&cell.key).ok_or(Refusal::NoSuchRow)?;
        let number = number.parse::<u32>().map_err(|_| Refusal::NoSuchRow)?;
        let found = self.document.detections.get(photo).and_then(|d| d.target(number));
        let target = found.cloned().ok_or(Refusal::NoSuchRow)?;
        let before = points::observation_of(&self.document.project, photo, number).map(|o| o.point.clone());
        let name = cell.typed.trim();
        if name.is_empty() {
            if let Some(before) = before {
                points::remove_observation(self.document.project_mut(), photo, &before);
            }
            return Ok(false);
        }
        let elsewhere =
            |o: &sightline::project::Observation| o.photo == photo && o.point == name && o.target != Some(number);
        if self.document.project.observations.iter().any(elsewhere) {
            return Err(Refusal::BothInPhoto(photo.to_owned()));
        }
        let observation = sightline::project::Observation {
            photo: photo.to_owned(),
            point: name.to_owned(),
            u: target.u,
            v: target.v,
            sigma: Sigma::Two([target.sigma_u, target.sigma_v]),
            enabled: true,
            target: Some(number),
        };
        points::observe(self.document.project_mut(), observation);
        Ok(false)
    }
}

fn new_name(typed: &str) -> Result<String, Refusal> {
    Some(typed.trim()).filter(|name| !name.is_empty()).map(str::to_owned).ok_or(Refusal::NoName)
}

/// Indices of rows by their keys.
fn rows(document: &Document, table: Table) -> HashMap<String, usize> {
    let project = &document.project;
    match table {
        Table::Photos => project.photos.iter().enumerate().map(|(k, p)| (p.id.clone(), k)).collect(),
        Table::Cameras => project.cameras.iter().enumerate().map(|(k, c)| (c.id.clone(), k)).collect(),
        Table::Points => project.points.iter().enumerate().map(|(k, p)| (p.id.clone(), k)).collect(),
        Table::Control => {
            let known = project.points.iter().enumerate().filter(|(_, p)| p.role != Role::Tie);
            known.map(|(k, p)| (p.id.clone(), k)).collect()
        }
        Table::Observations => {
            let all = project.observations.iter().enumerate();
            all.map(|(k, o)| (observation_key(&o.photo, &o.point), k)).collect()
        }
        Table::Distances => (0..project.distances.len()).map(|k| (k.to_string(), k)).collect(),
        Table::Identities => {
            let of = |(photo, found): (&String, &std::sync::Arc<sightline::detection::Detection>)| {
                found.targets.iter().map(|t| observation_key(photo, &t.id.to_string())).collect::<Vec<_>>()
            };
            document.detections.iter().flat_map(of).map(|key| (key, 0)).collect()
        }
    }
}

/// Writes the cells to a copy of the document. Returns the copy and the result for each cell.
pub fn tried(document: &Document, table: Table, cells: &[CellEdit]) -> (Document, Vec<Result<(), Refusal>>) {
    let mut document = document.clone();
    let mut editor = Editor::new(&mut document, table);
    let taken = cells.iter().map(|cell| editor.set(cell)).collect();
    (document, taken)
}

#[cfg(test)]
mod tests {
    use sightline::project::{Camera, Distance, Interior, Observation, Photo, Point, Project};

    use super::*;

    fn document() -> Document {
        let seen = |photo: &str, point: &str| Observation {
            photo: photo.into(),
            point: point.into(),
            u: 5.0,
            v: 1.0,
            sigma: Sigma::One(0.1),
            enabled: true,
            target: Some(1),
        };
        let project = Project {
            cameras: vec![
                Camera::new("a", 10, 10, Interior::brown(5.0)),
                Camera::new("b", 10, 10, Interior::brown(5.0)),
            ],
            photos: vec![Photo { id: "1".into(), camera: "a".into(), enabled: true, ..Photo::default() }].into(),
            points: ["p", "q", "r"].map(|id| Point { id: id.into(), ..Point::default() }).into(),
            observations: vec![seen("1", "p"), seen("1", "q"), seen("2", "r")].into(),
            distances: vec![Distance { from: "p".into(), to: "q".into(), length: 1.0, sigma: 0.1, check: false }],
            ..Project::default()
        };
        Document { project: std::sync::Arc::new(project), ..Document::default() }
    }

    fn set(d: &mut Document, table: Table, key: &str, col: Col, typed: &str) -> Result<(), Refusal> {
        Editor::new(d, table).set(&CellEdit { key: key.into(), col, typed: typed.into() })
    }

    #[test]
    fn cells_accept_valid_values_and_refuse_others() {
        let mut d = document();
        let before = d.project.clone();
        for (table, key, col, typed, why) in [
            (Table::Photos, "1", Col::Camera, "z", Refusal::NoSuchCamera),
            (Table::Photos, "1", Col::TakesPart, "perhaps", Refusal::NotAFlag),
            (Table::Photos, "9", Col::TakesPart, "1", Refusal::NoSuchRow),
            (Table::Photos, "1", Col::Id, "2", Refusal::NotEditable),
            (Table::Cameras, "a", Col::Id, "b", Refusal::NameTaken),
            (Table::Cameras, "a", Col::Distance, "-5", Refusal::NotPositive),
            (Table::Points, "p", Col::Id, "q", Refusal::BothInPhoto("1".into())),
            (Table::Points, "p", Col::Id, " ", Refusal::NoName),
            (Table::Points, "p", Col::Role, "boss", Refusal::NotARole),
            (Table::Observations, "1\u{1f}p", Col::Sigma, "0", Refusal::NotPositive),
            (Table::Observations, "1\u{1f}p", Col::Point, "q", Refusal::BothInPhoto("1".into())),
            (Table::Observations, "1\u{1f}p", Col::U, "5 px", Refusal::NotANumber),
            (Table::Distances, "0", Col::To, "p", Refusal::SamePoint),
            (Table::Distances, "0", Col::To, "z", Refusal::NoSuchPoint),
            (Table::Control, "p", Col::X, "1", Refusal::NoSuchRow),
        ] {
            assert_eq!(set(&mut d, table, key, col, typed), Err(why), "{key} {col:?} {typed}");
        }
        assert_eq!(d.project, before);
        for (table, key, col, typed) in [
            (Table::Cameras, "b", Col::Id, "c"),
            (Table::Photos, "1", Col::Camera, "c"),
            (Table::Photos, "1", Col::TakesPart, "아니요"),
            (Table::Points, "p", Col::Role, "기준점"),
            (Table::Control, "p", Col::X, "1,5"),
            (Table::Control, "p", Col::SigmaX, "0"),
            (Table::Points, "r", Col::Id, "p"),
            (Table::Observations, "1\u{1f}q", Col::Point, "s"),
            (Table::Observations, "1\u{1f}s", Col::U, "7"),
            (Table::Distances, "0", Col::Length, "2.5"),
        ] {
            assert_eq!(set(&mut d, table, key, col, typed), Ok(()), "{key} {col:?} {typed}");
        }
        let p = &d.project;
        assert_eq!((p.photos[0].camera.as_str(), p.photos[0].enabled, p.cameras[0].id.as_str()), ("c", false, "c"));
        assert_eq!(p.points.iter().map(|p| p.id.as_str()).collect::<Vec<_>>(), ["p", "q", "s"]);
        assert_eq!(
            (p.points[0].role, p.points[0].xyz, p.points[0].sigma),
            (Role::Control, Some([1.5, 0.0, 0.0]), None)
        );
        let o = p.observations.iter().find(|o| o.point == "s").expect("an observation");
        assert_eq!((o.u, o.target, p.distances[0].length), (7.0, None, 2.5));
    }

    #[test]
    fn many_cells_are_tried_on_a_copy() {
        let d = document();
        let cell = |key: &str, typed: &str| CellEdit { key: key.into(), col: Col::Id, typed: typed.into() };
        let (after, taken) = tried(&d, Table::Points, &[cell("p", "x"), cell("p", "y"), cell("q", "x")]);
        assert_eq!(taken, [Ok(()), Err(Refusal::NoSuchRow), Err(Refusal::BothInPhoto("1".into()))]);
        assert_eq!((d.project.points[0].id.as_str(), after.project.points[0].id.as_str()), ("p", "x"));
    }
}
