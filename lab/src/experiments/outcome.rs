//! Result of an experiment: figures, tables and charts as data, and the project to open.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use sightline::project::{Project, Role};
use sightline_plan::network::Network;

/// Result of an experiment. Identifiers are stable; units are symbols.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Experiment {
    /// Name of the experiment.
    pub name: String,
    /// Networks, for drawing.
    pub drawings: Vec<Drawing>,
    /// The figures that matter, with the paper's.
    pub figures: Vec<Figure>,
    /// Tables.
    pub tables: Vec<Table>,
    /// Charts.
    pub charts: Vec<Chart>,
    /// Assumptions: values that the paper does not give or gives differently.
    pub assumptions: Vec<Assumption>,
    /// A project of the experiment, ready to be opened and adjusted.
    pub project: Project,
}

/// A choice that is not the paper's.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Assumption {
    /// Identifier.
    pub id: String,
    /// Unit.
    pub unit: String,
    /// The value used here; null if the choice is not a number.
    pub ours: Option<f64>,
    /// Value of the paper; null if it gives none.
    pub paper: Option<f64>,
}

/// One figure of ours beside the paper's.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// Identifier, with the network it belongs to after a slash where there are several.
    pub id: String,
    /// Unit.
    pub unit: String,
    /// Ours.
    pub ours: f64,
    /// The paper's; null if it prints none.
    pub paper: Option<f64>,
    /// From an independent calculation of the same geometry, where there is one.
    pub independent: Option<f64>,
}

/// A table.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// Identifier.
    pub id: String,
    /// Columns.
    pub columns: Vec<Column>,
    /// Rows, as long as there are columns.
    pub rows: Vec<Vec<Cell>>,
}

/// A column.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// Identifier.
    pub id: String,
    /// Unit.
    pub unit: String,
    /// Decimals that mean something.
    pub decimals: usize,
    /// Whether its values are the paper's.
    pub paper: bool,
}

/// A cell: a number, a text or nothing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Cell {
    /// A number.
    Number(f64),
    /// A name.
    Text(String),
    /// Nothing.
    Empty(()),
}

/// An axis of a chart.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// Identifier.
    pub id: String,
    /// Unit.
    pub unit: String,
    /// Names of places along the axis; empty if the axis shows numbers.
    pub ticks: Vec<Tick>,
}

/// A named place on an axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tick {
    /// Where.
    pub at: f64,
    /// Name.
    pub text: String,
    /// Whether it names the group of places around it, in a second row.
    pub group: bool,
}

/// A chart.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Chart {
    /// Identifier.
    pub id: String,
    /// Across.
    pub x: Axis,
    /// Up.
    pub y: Axis,
    /// Lines.
    pub series: Vec<Series>,
}

/// A line of a chart, or a piece of one: pieces of a broken line share their identifier.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Identifier.
    pub id: String,
    /// Whether its values are the paper's.
    pub paper: bool,
    /// Places (x, y).
    pub points: Vec<[f64; 2]>,
}

/// A network for drawing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Drawing {
    /// Identifier.
    pub id: String,
    /// Unit of the coordinates.
    pub unit: String,
    /// Points.
    pub points: Vec<Drawn>,
    /// Photos.
    pub photos: Vec<Drawn>,
}

/// Something to draw.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Drawn {
    /// Identifier.
    pub id: String,
    /// Where it is.
    pub xyz: [f64; 3],
    /// Viewing direction of a photo, unit length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f64; 3]>,
    /// Role of a point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub role: Option<Role>,
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        if value.is_finite() { Self::Number(value) } else { Self::Empty(()) }
    }
}

impl From<usize> for Cell {
    fn from(value: usize) -> Self {
        Self::Number(value as f64)
    }
}

impl From<Option<f64>> for Cell {
    fn from(value: Option<f64>) -> Self {
        value.map_or(Self::Empty(()), Self::from)
    }
}

impl From<&str> for Cell {
    fn from(value: &str) -> Self {
        Self::Text(value.to_owned())
    }
}

impl Table {
    /// An empty table. Columns are written `id|unit|decimals`; a `*` before the id marks the paper's.
    pub(super) fn new(id: &str, columns: &[&str]) -> Self {
        let column = |text: &&str| {
            let mut parts = text.split('|');
            let id = parts.next().unwrap_or_default();
            Column {
                id: id.trim_start_matches('*').to_owned(),
                unit: parts.next().unwrap_or_default().to_owned(),
                decimals: parts.next().and_then(|d| d.parse().ok()).unwrap_or(0),
                paper: id.starts_with('*'),
            }
        };
        Self { id: id.to_owned(), columns: columns.iter().map(column).collect(), rows: Vec::new() }
    }
}

impl Figure {
    /// A figure beside the paper's.
    pub(super) fn new(id: impl Into<String>, unit: &str, ours: f64, paper: impl Into<Option<f64>>) -> Self {
        Self { id: id.into(), unit: unit.into(), ours, paper: paper.into(), independent: None }
    }

    /// The same with an independent calculation.
    pub(super) fn independent(mut self, value: f64) -> Self {
        self.independent = Some(value);
        self
    }
}

impl Assumption {
    /// A number that the paper does not print, or prints otherwise.
    pub(super) fn new(id: &str, unit: &str, ours: f64, paper: impl Into<Option<f64>>) -> Self {
        Self { id: id.into(), unit: unit.into(), ours: Some(ours), paper: paper.into() }
    }

    /// A choice other than a number.
    pub(super) fn of_kind(id: &str) -> Self {
        Self { id: id.into(), ..Self::default() }
    }
}

impl Series {
    /// A line of ours.
    pub(super) fn new(id: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self { id: id.into(), paper: false, points }
    }
}

impl Chart {
    /// A chart; axes are written `id|unit`.
    pub(super) fn new(id: impl Into<String>, x: &str, y: &str, series: Vec<Series>) -> Self {
        let axis = |text: &str| {
            let (id, unit) = text.split_once('|').unwrap_or((text, ""));
            Axis { id: id.into(), unit: unit.into(), ticks: Vec::new() }
        };
        Self { id: id.into(), x: axis(x), y: axis(y), series }
    }

    /// The same with names at 0, 1, 2 … across.
    pub(super) fn named<'a>(mut self, names: impl IntoIterator<Item = &'a str>) -> Self {
        let tick = |(at, name): (usize, &str)| Tick { at: at as f64, text: name.into(), group: false };
        self.x.ticks.extend(names.into_iter().enumerate().map(tick));
        self
    }
}

impl Drawing {
    /// Options of the drawing of a network.
    pub(super) fn of(id: impl Into<String>, network: &Network) -> Self {
        let point = |p: &sightline_plan::network::NetworkPoint| Drawn {
            id: p.id.clone(),
            xyz: p.xyz,
            direction: None,
            role: Some(p.role),
        };
        let photo = |s: &sightline_plan::network::Station| {
            let pose = s.pose().ok()?;
            let axis = pose.object_to_camera.transpose() * Vector3::new(0.0, 0.0, -1.0);
            Some(Drawn { id: s.id.clone(), xyz: s.position, direction: Some(axis.into()), role: None })
        };
        Self {
            id: id.into(),
            unit: network.unit.clone(),
            points: network.points.iter().map(point).collect(),
            photos: network.stations.iter().filter_map(photo).collect(),
        }
    }
}
