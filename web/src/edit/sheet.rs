//! The document as tables: the content of each cell. Nothing is copied until a row is read, so that a hundred thousand
//! rows cost no more than their order.

use crate::document::Table;
use std::cmp::Ordering;
use std::collections::{BTreeMap, HashMap, HashSet};

use sightline::adjustment::{AdjustedObservation, Given, LeftOutItem, LeftOutKind};
use sightline::axes::ShownAxes;
use sightline::project::{Project, Role};

use super::natural;
use crate::document::keys::Kind;
use crate::document::keys::observation_key;
use crate::document::{AdjustmentResult, Document};
use crate::edit::cameras::distance_parameter;

/// Columns of the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Col {
    Id,
    File,
    Camera,
    TakesPart,
    Count,
    Width,
    Height,
    Pitch,
    Distance,
    Model,
    Rays,
    Role,
    X,
    Y,
    Z,
    SigmaX,
    SigmaY,
    SigmaZ,
    Diameter,
    Photo,
    Point,
    U,
    V,
    Sigma,
    ResidualX,
    ResidualY,
    W,
    Redundancy,
    From,
    To,
    Length,
    Target,
    Code,
    Contrast,
}

impl Col {
    /// Whether its values are words.
    fn has_words(self) -> bool {
        use Col::{Camera, File, From, Id, Model, Photo, Point, To};
        matches!(self, Id | File | Camera | Model | Photo | Point | From | To)
    }
}

/// Whether a text, in small letters, occurs in words however they are written.
fn occurs(text: &str, words: &str) -> bool {
    if !words.is_ascii() {
        return words.to_lowercase().contains(text);
    }
    let mut parts = words.as_bytes().windows(text.len().max(1));
    text.is_empty() || parts.any(|part| part.eq_ignore_ascii_case(text.as_bytes()))
}

/// Content of a cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Nothing,
    Words(String),
    Count(usize),
    /// With its decimals.
    Number(f64, usize),
    Flag(bool),
    /// It is to take part, and did not in the present result.
    NotUsed,
    Role(Role),
}

impl Table {
    pub const ALL: [Self; 7] = [
        Self::Photos,
        Self::Cameras,
        Self::Points,
        Self::Observations,
        Self::Distances,
        Self::Control,
        Self::Identities,
    ];

    /// Kind of selection of its rows.
    pub fn kind(self) -> Kind {
        match self {
            Self::Photos => Kind::Photos,
            Self::Cameras => Kind::Cameras,
            Self::Points | Self::Control => Kind::Points,
            Self::Observations => Kind::Observations,
            Self::Distances => Kind::Distances,
            Self::Identities => Kind::Targets,
        }
    }

    pub fn columns(self) -> &'static [Col] {
        use Col::{
            Camera, Code, Contrast, Count, Diameter, Distance, File, From, Height, Id, Length, Model, Photo, Pitch,
            Point, Rays, Redundancy, ResidualX, ResidualY, Role, Sigma, SigmaX, SigmaY, SigmaZ, TakesPart, Target, To,
            U, V, W, Width, X, Y, Z,
        };
        match self {
            Self::Photos => &[Id, File, Camera, TakesPart, Count, X, Y, Z],
            Self::Cameras => &[Id, Width, Height, Pitch, Distance, Model, Count],
            Self::Points => &[Id, Rays, Role, X, Y, Z, SigmaX, SigmaY, SigmaZ, Diameter],
            Self::Observations => &[Photo, Point, U, V, Sigma, TakesPart, ResidualX, ResidualY, W, Redundancy],
            Self::Distances => &[From, To, Length, Sigma],
            Self::Control => &[Id, Role, X, Y, Z, SigmaX, SigmaY, SigmaZ, Rays],
            Self::Identities => &[Photo, Target, Code, Point, U, V, Sigma, Contrast],
        }
    }

    /// The columns with coordinates in the order of the user.
    pub fn shown_columns(self, axes: ShownAxes) -> Vec<Col> {
        let triples = [[Col::X, Col::Y, Col::Z], [Col::SigmaX, Col::SigmaY, Col::SigmaZ]];
        let shown = |col: &Col| {
            let place = |triple: &[Col; 3]| Some(axes.shown(*triple)[triple.iter().position(|own| own == col)?]);
            triples.iter().find_map(place).unwrap_or(*col)
        };
        self.columns().iter().map(shown).collect()
    }

    /// Columns that together identify a row.
    pub fn names(self) -> &'static [Col] {
        match self {
            Self::Photos | Self::Cameras | Self::Points | Self::Control => &[Col::Id],
            Self::Observations => &[Col::Photo, Col::Point],
            Self::Distances => &[Col::From, Col::To],
            Self::Identities => &[Col::Photo, Col::Target],
        }
    }

    /// Whether a cell of the column can be changed.
    pub fn editable(self, col: Col) -> bool {
        use Col::{
            Camera, Diameter, Distance, From, Id, Length, Pitch, Point, Role, Sigma, SigmaX, SigmaY, SigmaZ, TakesPart,
            To, U, V, X, Y, Z,
        };
        match self {
            Self::Photos => matches!(col, Camera | TakesPart),
            Self::Cameras => matches!(col, Id | Pitch | Distance),
            Self::Points => matches!(col, Id | Role | Diameter),
            Self::Observations => matches!(col, Point | U | V | Sigma | TakesPart),
            Self::Distances => matches!(col, From | To | Length | Sigma),
            Self::Control => matches!(col, Id | Role | X | Y | Z | SigmaX | SigmaY | SigmaZ),
            Self::Identities => matches!(col, Point),
        }
    }
}

/// Keys of rows of which nothing took part.
fn not_used(table: Table, project: &Project, left_out: &[LeftOutItem]) -> HashSet<String> {
    let of = |item: &LeftOutItem| match (table, item.kind, &item.given) {
        (Table::Observations, LeftOutKind::Observation, _) => {
            Some(observation_key(item.photo.as_deref()?, item.point.as_deref()?))
        }
        (Table::Photos, LeftOutKind::Photo, _) => item.photo.clone(),
        (Table::Points, LeftOutKind::Point, _) | (Table::Control, LeftOutKind::Control, None) => item.point.clone(),
        (Table::Distances, LeftOutKind::Distance, Some(Given::Distance { from, to })) => {
            project.distances.iter().position(|d| (&d.from, &d.to) == (from, to)).map(|row| row.to_string())
        }
        _ => None,
    };
    left_out.iter().filter_map(of).collect()
}

/// Rays of a point: taking part, and in all.
type Rays = HashMap<String, (usize, usize)>;

/// A table of a document.
pub struct Sheet {
    pub table: Table,
    document: Document,
    result: Option<std::sync::Arc<AdjustmentResult>>,
    /// Points that are shown, where these are not all of them.
    places: Option<Vec<u32>>,
    /// Photos and places in their lists of targets.
    targets: Vec<(String, usize)>,
    /// Names by photo and number of the target.
    named: HashMap<(String, u32), String>,
    rays: Rays,
    counts: BTreeMap<String, usize>,
    /// Adjusted points or photos by identifier.
    adjusted: HashMap<String, usize>,
    /// Keys of rows of which the present result used nothing.
    not_used: HashSet<String>,
}

impl Sheet {
    pub fn new(table: Table, document: &Document) -> Self {
        let document = document.clone();
        let project = &document.project;
        let result = document.current().cloned();
        let (mut rays, mut counts, mut adjusted) = (Rays::new(), BTreeMap::<String, usize>::new(), HashMap::new());
        let (mut targets, mut named, mut places) = (Vec::new(), HashMap::new(), None);
        match table {
            Table::Points | Table::Control => {
                for o in &project.observations {
                    let enabled = usize::from(o.enabled);
                    match rays.get_mut(&o.point) {
                        Some(count) => *count = (count.0 + enabled, count.1 + 1),
                        None => drop(rays.insert(o.point.clone(), (enabled, 1))),
                    }
                }
                if table == Table::Control {
                    let known = project.points.iter().enumerate().filter(|(_, p)| p.role != Role::Tie);
                    places = Some(known.map(|(k, _)| k as u32).collect());
                } else if let Some(result) = &result {
                    let points = result.adjustment.points.iter().enumerate();
                    adjusted = points.map(|(k, p)| (p.id.clone(), k)).collect();
                }
            }
            Table::Photos => {
                for o in project.observations.iter().filter(|o| o.enabled) {
                    match counts.get_mut(&o.photo) {
                        Some(count) => *count += 1,
                        None => drop(counts.insert(o.photo.clone(), 1)),
                    }
                }
                if let Some(result) = &result {
                    let photos = result.adjustment.photos.iter().enumerate();
                    adjusted = photos.map(|(k, p)| (p.id.clone(), k)).collect();
                }
            }
            Table::Cameras => {
                for photo in &project.photos {
                    *counts.entry(photo.camera.clone()).or_default() += 1;
                }
            }
            Table::Identities => {
                for photo in &project.photos {
                    let found = document.detections.get(&photo.id).map_or(0, |d| d.targets.len());
                    targets.extend((0..found).map(|k| (photo.id.clone(), k)));
                }
                let of = |o: &sightline::project::Observation| Some(((o.photo.clone(), o.target?), o.point.clone()));
                named = project.observations.iter().filter_map(of).collect();
            }
            Table::Observations => {
                if let Some(result) = &result {
                    let photos = result.adjustment.photos.iter().enumerate();
                    adjusted = photos.map(|(k, p)| (p.id.clone(), k)).collect();
                }
            }
            Table::Distances => {}
        }
        let not_used = result.as_ref().map_or_else(HashSet::new, |r| not_used(table, project, &r.adjustment.left_out));
        Self { table, document, result, places, targets, named, rays, counts, adjusted, not_used }
    }

    pub fn len(&self) -> usize {
        let project = &self.document.project;
        match self.table {
            Table::Photos => project.photos.len(),
            Table::Cameras => project.cameras.len(),
            Table::Points | Table::Control => self.places.as_ref().map_or(project.points.len(), Vec::len),
            Table::Observations => project.observations.len(),
            Table::Distances => project.distances.len(),
            Table::Identities => self.targets.len(),
        }
    }

    fn point(&self, row: usize) -> &sightline::project::Point {
        let at = self.places.as_ref().map_or(row, |places| places[row] as usize);
        &self.document.project.points[at]
    }

    fn target(&self, row: usize) -> (&str, &sightline::detection::Target) {
        let (photo, at) = &self.targets[row];
        (photo, &self.document.detections[photo].targets[*at])
    }

    /// Key of a row in the selection.
    pub fn key(&self, row: usize) -> String {
        let project = &self.document.project;
        match self.table {
            Table::Photos => project.photos[row].id.clone(),
            Table::Cameras => project.cameras[row].id.clone(),
            Table::Points | Table::Control => self.point(row).id.clone(),
            Table::Observations => observation_key(&project.observations[row].photo, &project.observations[row].point),
            Table::Distances => row.to_string(),
            Table::Identities => {
                let (photo, target) = self.target(row);
                observation_key(photo, &target.id.to_string())
            }
        }
    }

    /// Whether a row takes part in the adjustment: it is to, and the present result did not leave it out.
    pub fn takes_part(&self, row: usize) -> bool {
        self.is_to_take_part(row) && (self.not_used.is_empty() || !self.not_used.contains(&self.key(row)))
    }

    /// Whether it takes part, as a value of its cell.
    fn part(&self, row: usize) -> Value {
        match self.is_to_take_part(row) {
            true if !self.takes_part(row) => Value::NotUsed,
            flag => Value::Flag(flag),
        }
    }

    fn is_to_take_part(&self, row: usize) -> bool {
        let project = &self.document.project;
        match self.table {
            Table::Photos => project.photos[row].enabled,
            Table::Observations => project.observations[row].enabled,
            Table::Points | Table::Control => {
                self.rays.get(&self.point(row).id).is_none_or(|(enabled, all)| *all == 0 || *enabled > 0)
            }
            _ => true,
        }
    }

    fn adjusted_observation(&self, row: usize) -> Option<&AdjustedObservation> {
        self.result.as_ref()?.adjustment.observations.get(row)
    }

    /// Baarda's w of an observation, the larger of both coordinates.
    pub fn w(&self, row: usize) -> Option<f64> {
        let o = self.adjusted_observation(row).filter(|_| self.table == Table::Observations)?;
        [o.wx, o.wy].into_iter().flatten().max_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// Rays of a point that take part.
    pub fn rays(&self, row: usize) -> usize {
        self.rays.get(&self.point(row).id).map_or(0, |rays| rays.0)
    }

    /// Whether a target has a name.
    pub fn is_named(&self, row: usize) -> bool {
        let (photo, target) = self.target(row);
        self.named.contains_key(&(photo.to_owned(), target.id))
    }

    /// Its columns as they are shown.
    pub fn columns(&self) -> Vec<Col> {
        self.table.shown_columns(self.document.project.shown_axes())
    }

    pub fn value(&self, row: usize, col: Col) -> Value {
        let value = match self.table {
            Table::Photos => self.photo_value(row, col),
            Table::Cameras => self.camera_value(row, col),
            Table::Points | Table::Control => self.point_value(row, col),
            Table::Observations => self.observation_value(row, col),
            Table::Distances => self.distance_value(row, col),
            Table::Identities => self.target_value(row, col),
        };
        value.unwrap_or(Value::Nothing)
    }

    fn photo_value(&self, row: usize, col: Col) -> Option<Value> {
        let photo = &self.document.project.photos[row];
        let adjusted = || self.result.as_ref()?.adjustment.photos.get(*self.adjusted.get(&photo.id)?);
        let position = |k: usize| Some(Value::Number(adjusted().map(|p| p.position).or(photo.position)?[k], 3));
        match col {
            Col::Id => Some(Value::Words(photo.id.clone())),
            Col::File => Some(Value::Words(photo.file.clone())),
            Col::Camera => Some(Value::Words(photo.camera.clone())),
            Col::TakesPart => Some(self.part(row)),
            Col::Count => Some(Value::Count(self.counts.get(&photo.id).copied().unwrap_or(0))),
            Col::X => position(0),
            Col::Y => position(1),
            Col::Z => position(2),
            _ => None,
        }
    }

    fn camera_value(&self, row: usize, col: Col) -> Option<Value> {
        let camera = &self.document.project.cameras[row];
        match col {
            Col::Id => Some(Value::Words(camera.id.clone())),
            Col::Width => Some(Value::Count(camera.width as usize)),
            Col::Height => Some(Value::Count(camera.height as usize)),
            Col::Pitch => Some(Value::Number(camera.pixel_pitch?[0] * 1000.0, 3)),
            Col::Distance => Some(Value::Number(camera.interior.get(distance_parameter(camera))?, 4)),
            Col::Model => Some(Value::Words(camera.interior.model().name.to_owned())),
            Col::Count => Some(Value::Count(self.counts.get(&camera.id).copied().unwrap_or(0))),
            _ => None,
        }
    }

    fn point_value(&self, row: usize, col: Col) -> Option<Value> {
        let point = self.point(row);
        let adjusted = || self.result.as_ref()?.adjustment.points.get(*self.adjusted.get(&point.id)?);
        let coordinate = |k: usize| Some(Value::Number(adjusted().map(|p| p.xyz).or(point.xyz)?[k], 3));
        let sigma = |k: usize| {
            let value = match self.table {
                Table::Control => point.sigma?[k]?,
                _ => adjusted()?.sigma?[k],
            };
            Some(Value::Number(value, crate::format::decimals_for(value)))
        };
        match col {
            Col::Id => Some(Value::Words(point.id.clone())),
            Col::Rays => Some(Value::Count(self.rays(row))),
            Col::Role => Some(Value::Role(point.role)),
            Col::X => coordinate(0),
            Col::Y => coordinate(1),
            Col::Z => coordinate(2),
            Col::SigmaX => sigma(0),
            Col::SigmaY => sigma(1),
            Col::SigmaZ => sigma(2),
            Col::Diameter => Some(Value::Number(point.diameter?, 2)),
            _ => None,
        }
    }

    fn observation_value(&self, row: usize, col: Col) -> Option<Value> {
        let o = &self.document.project.observations[row];
        let adjusted = || self.adjusted_observation(row);
        // Residuals are in the photo's unit; a table has one: pixels.
        let pixel = || Some(self.result.as_ref()?.adjustment.photos.get(*self.adjusted.get(&o.photo)?)?.pixel);
        match col {
            Col::Photo => Some(Value::Words(o.photo.clone())),
            Col::Point => Some(Value::Words(o.point.clone())),
            Col::U => Some(Value::Number(o.u, 3)),
            Col::V => Some(Value::Number(o.v, 3)),
            Col::Sigma => {
                let [u, v] = o.sigma.both();
                Some(Value::Number(u.hypot(v) / 2f64.sqrt(), 3))
            }
            Col::TakesPart => Some(self.part(row)),
            Col::ResidualX => Some(Value::Number(adjusted()?.vx? / pixel()?[0], 3)),
            Col::ResidualY => Some(Value::Number(adjusted()?.vy? / pixel()?[1], 3)),
            Col::W => Some(Value::Number(self.w(row)?, 2)),
            Col::Redundancy => {
                let o = adjusted()?;
                Some(Value::Number(o.rx?.min(o.ry?), 2))
            }
            _ => None,
        }
    }

    fn distance_value(&self, row: usize, col: Col) -> Option<Value> {
        let distance = &self.document.project.distances[row];
        match col {
            Col::From => Some(Value::Words(distance.from.clone())),
            Col::To => Some(Value::Words(distance.to.clone())),
            Col::Length => Some(Value::Number(distance.length, 4)),
            Col::Sigma => Some(Value::Number(distance.sigma, crate::format::decimals_for(distance.sigma))),
            _ => None,
        }
    }

    fn target_value(&self, row: usize, col: Col) -> Option<Value> {
        let (photo, target) = self.target(row);
        match col {
            Col::Photo => Some(Value::Words(photo.to_owned())),
            Col::Target => Some(Value::Count(target.id as usize)),
            Col::Code => Some(Value::Count(target.code? as usize)),
            Col::Point => Some(Value::Words(self.named.get(&(photo.to_owned(), target.id))?.clone())),
            Col::U => Some(Value::Number(target.u, 3)),
            Col::V => Some(Value::Number(target.v, 3)),
            Col::Sigma => Some(Value::Number(target.sigma_u.hypot(target.sigma_v) / 2f64.sqrt(), 3)),
            Col::Contrast => Some(Value::Number(target.contrast, 0)),
            _ => None,
        }
    }

    /// Rows in whose names a text occurs, and that meet a condition.
    pub fn filtered(&self, text: &str, meets: impl Fn(usize) -> bool) -> Vec<u32> {
        let text = text.trim().to_lowercase();
        // the values of other columns are looked up, row by row, for nothing
        let columns: Vec<Col> = self.table.columns().iter().copied().filter(|col| col.has_words()).collect();
        let words = |row: usize| {
            text.is_empty()
                || columns
                    .iter()
                    .any(|col| matches!(self.value(row, *col), Value::Words(words) if occurs(&text, &words)))
        };
        (0..self.len()).filter(|row| meets(*row) && words(*row)).map(|row| row as u32).collect()
    }

    /// Sorts rows by a column; what has no value comes last either way, and equal ones stay in their order.
    pub fn sort(&self, rows: &mut [u32], col: Col, descending: bool) {
        let keys = self.ranks(rows, col);
        let order = |a: &u32, b: &u32| match (keys[*a as usize], keys[*b as usize]) {
            (Some(a), Some(b)) if descending => b.total_cmp(&a),
            (Some(a), Some(b)) => a.total_cmp(&b),
            (Some(_), None) => Ordering::Less,
            (None, Some(_)) => Ordering::Greater,
            (None, None) => Ordering::Equal,
        };
        rows.sort_by(order);
    }

    /// A number for each row that sorts as its cell does: words by their place among all words of the column.
    fn ranks(&self, rows: &[u32], col: Col) -> Vec<Option<f64>> {
        let mut ranks = vec![None; self.len()];
        let mut words = HashMap::<String, Vec<u32>>::new();
        for &row in rows {
            ranks[row as usize] = match self.value(row as usize, col) {
                Value::Nothing => None,
                Value::Count(n) => Some(n as f64),
                Value::Number(value, _) if col == Col::W => Some(value.abs()),
                Value::Number(value, _) => Some(value),
                Value::Flag(flag) => Some(f64::from(u8::from(flag))),
                Value::NotUsed => Some(0.5),
                Value::Role(role) => Some(f64::from(role as u8)),
                Value::Words(word) => {
                    match words.get_mut(&word) {
                        Some(rows) => rows.push(row),
                        None => drop(words.insert(word, vec![row])),
                    }
                    None
                }
            };
        }
        let mut words = words.into_iter().collect::<Vec<_>>();
        words.sort_by(|a, b| natural(&a.0, &b.0));
        for (rank, (_, rows)) in words.into_iter().enumerate() {
            for row in rows {
                ranks[row as usize] = Some(rank as f64);
            }
        }
        ranks
    }
}

impl Value {
    /// As a spreadsheet takes it: '.' for decimals, no grouping, all digits.
    pub fn plain(&self) -> String {
        match self {
            Self::Nothing => String::new(),
            Self::Words(words) => words.clone(),
            Self::Count(n) => n.to_string(),
            Self::Number(value, _) => value.to_string(),
            Self::Flag(flag) => u8::from(*flag).to_string(),
            // The value of the document.
            Self::NotUsed => "1".into(),
            Self::Role(Role::Tie) => "tie".into(),
            Self::Role(Role::Control) => "control".into(),
            Self::Role(Role::Check) => "check".into(),
        }
    }
}

#[cfg(test)]
mod tests;
