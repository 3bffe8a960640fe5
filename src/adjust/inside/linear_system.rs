//! The linearised observation equations v = A δ - l at the present values, in the units of the document.
//!
//! | unknown | unit of δ |
//! | --- | --- |
//! | rotation of a photo about its camera axes x, y, z | radians: M' = exp([δ]×) M |
//! | projection centre, object point | the document's unit of length |
//! | interior orientation | that of the parameter |
//!
//! Rows are the observations that take part: image coordinates (photo coordinates x, y; millimetres where the pixel pitch is known, else
//! pixels), then given coordinates, projection centres, distances and camera parameters,
//! then comparisons of a rig's relative poses (the relative pose itself is eliminated).
//! l is observed minus computed, p = 1/σ². The
//! corrections are δ = (AᵀPA)⁻¹ AᵀPl; without control they also fulfil the datum's constraints D δ = 0.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::sparse::SparseMatrix;
use crate::adjust::datum::free::FreeDatum;
use crate::adjust::equations::collinearity::Linearisation;
use crate::adjust::equations::context::Context;
use crate::adjust::equations::normal::with_interior_size;
use crate::adjust::problem::additional::{self, AdditionalObservation, distance_row};
use crate::adjust::problem::eccentric;
use crate::adjust::problem::network::Network;
use crate::adjust::problem::rig::Member;
use crate::adjust::solve::session::{Session, unsound};
use crate::adjustment::{AdjustOptions, Given};
use crate::camera::{parameter_unit, photo_unit};
use crate::error::Result;
use crate::project::Project;

/// Kind of an unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum UnknownKind {
    /// Rotation of a photo about a camera axis.
    Rotation,
    /// Coordinate of a projection centre.
    ProjectionCentre,
    /// Parameter of an interior orientation.
    InteriorOrientation,
    /// Coordinate of an object point.
    Point,
}

/// An unknown: a column of A.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Unknown {
    /// Photo, camera or point, and what of it.
    pub name: String,
    /// Kind.
    pub kind: UnknownKind,
    /// Photo, for rotations, projection centres and interior orientations per photo.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub photo: Option<String>,
    /// Camera, for interior orientations.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<String>,
    /// Point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<String>,
    /// Present value; 0 for rotations, which are counted from the present attitude.
    pub value: f64,
    /// Unit of the value.
    pub unit: String,
    /// Size of one unit of the engine's scaled unknown: the scaled matrix is A with its columns multiplied by this.
    pub scale: f64,
}

/// An observation: a row of A.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Equation {
    /// Names of photo and point, or of what was given.
    pub name: String,
    /// Photo.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub photo: Option<String>,
    /// Point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<String>,
    /// Observations of other kinds than image coordinates.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub given: Option<Given>,
    /// Axis of a coordinate: x, y in photos, X, Y, Z of the object.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<String>,
    /// Observed value.
    pub value: f64,
    /// Its standard error.
    pub sigma: f64,
    /// Unit of both.
    pub unit: String,
}

/// The linearised observation equations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LinearSystem {
    /// Columns.
    pub unknowns: Vec<Unknown>,
    /// Rows.
    pub observations: Vec<Equation>,
    /// Design matrix, unweighted.
    #[serde(rename = "A")]
    pub a: SparseMatrix,
    /// Observed minus computed, in the unit of the observation.
    pub l: Vec<f64>,
    /// Weights 1/σ².
    pub p: Vec<f64>,
    /// Rows D of the datum's constraints D δ = 0; none under control.
    pub constraints: SparseMatrix,
    /// n - u + d.
    pub redundancy: usize,
}

/// The observation equations of a document at its present values.
///
/// # Errors
/// As [`crate::adjust::adjust`].
pub fn linearise(project: &Project, options: &AdjustOptions) -> Result<LinearSystem> {
    super::stepping::with_session(project, options, |mut session| {
        session.shift = eccentric::shifts(session.project, &session.network, &session.state);
        of_session(&session, options, RowNames::Given)
    })
}

/// Whether rows, columns and blocks are built with their names, which are the same after every step and take longer than the numbers.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum RowNames {
    Given,
    /// Names and units are empty.
    Omitted,
}

impl RowNames {
    pub fn text(self, name: impl FnOnce() -> String) -> String {
        if self == Self::Given { name() } else { String::new() }
    }

    fn id(self, id: &str) -> Option<String> {
        (self == Self::Given).then(|| id.to_owned())
    }
}

/// First column of every block, and the columns of points, which have none for a fixed axis.
pub(super) struct Columns {
    photo: Vec<usize>,
    interior: Vec<usize>,
    point: Vec<[Option<usize>; 3]>,
    pub count: usize,
}

impl Columns {
    /// Photos, interior orientations, points, in the order of the network.
    pub fn new(network: &Network) -> Self {
        let mut count = 0;
        let mut next = |length: usize| {
            count += length;
            count - length
        };
        let photo = network.photos.iter().map(|_| next(6)).collect();
        let interior = network.interiors.iter().map(|block| next(block.estimated.len())).collect();
        let point = network.points.iter().map(|block| block.fixed.map(|fixed| (!fixed).then(|| next(1)))).collect();
        Self { photo, interior, point, count }
    }

    pub fn photo(&self, photo: usize) -> std::ops::Range<usize> {
        self.photo[photo]..self.photo[photo] + 6
    }

    pub fn interior(&self, network: &Network, interior: usize) -> std::ops::Range<usize> {
        let first = self.interior[interior];
        first..first + network.interiors[interior].estimated.len()
    }

    pub fn point(&self, point: usize) -> impl Iterator<Item = usize> {
        self.point[point].iter().flatten().copied()
    }
}

/// The equations of a session.
pub(super) fn of_session(session: &Session<'_>, options: &AdjustOptions, names: RowNames) -> Result<LinearSystem> {
    let (project, network) = (session.project, &session.network);
    let columns = Columns::new(network);
    let unknowns = unknowns(session, names);
    let context = session.context(options.residuals);
    let mut rows = with_interior_size!(network, image_rows(context, &columns, project, names)).ok_or_else(unsound)?;
    // In the document's order.
    rows.sort_by_key(|row| row.0);
    let mut rows: Vec<EquationRow> = rows.into_iter().map(|row| row.1).collect();
    rows.extend(additional::all(network).into_iter().map(|observed| additional_row(session, &columns, observed)));
    network.rig.iter().for_each(|member| rows.extend(rig_rows(session, &columns, member)));
    let constraints = session.datum.as_ref().map_or_else(Vec::new, |datum| constraints(session, datum, &columns));
    let p = rows.iter().map(|row| row.equation.sigma.powi(-2)).collect();
    let l = rows.iter().map(|row| row.l).collect();
    let (observations, a) = rows.into_iter().map(|row| (row.equation, row.a)).unzip::<_, _, Vec<_>, Vec<_>>();
    Ok(LinearSystem {
        unknowns,
        observations,
        a: SparseMatrix::from_rows(columns.count, a),
        l,
        p,
        constraints: SparseMatrix::from_rows(columns.count, constraints),
        redundancy: session.redundancy,
    })
}

/// An observation with its coefficients.
struct EquationRow {
    equation: Equation,
    a: Vec<(usize, f64)>,
    l: f64,
}

fn unknowns(session: &Session<'_>, names: RowNames) -> Vec<Unknown> {
    let (project, network, state) = (session.project, &session.network, &session.state);
    let length = &project.unit;
    let mut all = Vec::new();
    for (block, pose) in network.photos.iter().zip(&state.poses) {
        let id = &project.photos[block.index].id;
        let of = |name: String, kind, value, unit: &str, scale| Unknown {
            name,
            kind,
            photo: names.id(id),
            camera: None,
            point: None,
            value,
            unit: names.text(|| unit.to_owned()),
            scale,
        };
        all.extend(
            ["x", "y", "z"]
                .map(|axis| of(names.text(|| format!("{id} rotation {axis}")), UnknownKind::Rotation, 0.0, "rad", 1.0)),
        );
        let centre = network.frame.outside(pose.centre);
        all.extend(AXES.iter().zip(centre).map(|(axis, value)| {
            let name = names.text(|| format!("{id} {axis}"));
            of(name, UnknownKind::ProjectionCentre, value, length, network.frame.scale)
        }));
    }
    for (block, interior) in network.interiors.iter().zip(&state.interiors) {
        let camera = &project.cameras[block.camera];
        let photo = block.photo.map(|photo| &project.photos[network.photos[photo].index].id);
        for estimated in &block.estimated {
            let of = photo.unwrap_or(&camera.id);
            all.push(Unknown {
                name: names.text(|| format!("{of} {}", estimated.parameter.name())),
                kind: UnknownKind::InteriorOrientation,
                photo: photo.and_then(|photo| names.id(photo)),
                camera: names.id(&camera.id),
                point: None,
                value: interior.get(estimated.parameter).unwrap_or_default(),
                unit: names.text(|| parameter_unit(camera, estimated.parameter)),
                scale: estimated.scale,
            });
        }
    }
    for (block, x) in network.points.iter().zip(&state.points) {
        let id = &project.points[block.index].id;
        let xyz = network.frame.outside(*x);
        all.extend((0..3).filter(|axis| !block.fixed[*axis]).map(|axis| Unknown {
            name: names.text(|| format!("{id} {}", AXES[axis])),
            kind: UnknownKind::Point,
            photo: None,
            camera: None,
            point: names.id(id),
            value: xyz[axis],
            unit: names.text(|| length.clone()),
            scale: network.frame.scale,
        }));
    }
    all
}

const AXES: [&str; 3] = ["X", "Y", "Z"];

/// Both rows of every image observation, with their places in the document.
fn image_rows<const N: usize>(
    context: Context<'_>,
    columns: &Columns,
    project: &Project,
    names: RowNames,
) -> Option<Vec<((usize, usize), EquationRow)>> {
    let Context { network, weighting, .. } = context;
    let linearisation = Linearisation::<N>::new(context)?;
    let scale = network.frame.scale;
    let (mut behind, mut room, mut all) = (0, Vec::new(), Vec::new());
    for (point, block) in network.points.iter().enumerate() {
        let rows = linearisation.point(point, &mut room, &mut behind)?;
        for (k, row) in block.rays.clone().zip(rows) {
            let ray = &network.rays[k];
            let observation = &project.observations[ray.row];
            let interior = &network.interiors[row.interior];
            let camera = &project.cameras[interior.camera];
            for side in 0..2 {
                // Rows are weighted.
                let weight = ray.sqrt_weight[side] * weighting.robust.get(k).map_or(1.0, |factor| factor[side]);
                let mut a = Vec::with_capacity(9 + N);
                for (n, column) in columns.photo(row.photo).enumerate() {
                    a.push((column, row.pose[side][n] / weight / if n < 3 { 1.0 } else { scale }));
                }
                for (n, column) in columns.interior(network, row.interior).enumerate() {
                    a.push((column, row.interior_rows[side][n] / weight / interior.estimated[n].scale));
                }
                for (axis, column) in columns.point[point].iter().enumerate() {
                    a.extend(column.map(|column| (column, row.point[side][axis] / weight / scale)));
                }
                let axis = ["x", "y"][side];
                let equation = Equation {
                    name: names.text(|| format!("{} {} {axis}", observation.photo, observation.point)),
                    photo: names.id(&observation.photo),
                    point: names.id(&observation.point),
                    given: None,
                    axis: names.id(axis),
                    value: ray.measured[side] - weighting.shift.get(k).map_or(0.0, |shift| shift[side]),
                    sigma: 1.0 / weight,
                    unit: names.text(|| photo_unit(camera).to_owned()),
                };
                all.push(((ray.row, side), EquationRow { equation, a, l: -row.e[side] / weight }));
            }
        }
    }
    Some(all)
}

fn additional_row(session: &Session<'_>, columns: &Columns, observed: AdditionalObservation) -> EquationRow {
    let (project, network, state) = (session.project, &session.network, &session.state);
    let unit = observed.unit(network);
    let length = || project.unit.clone();
    let given = observed.key(network).named(project);
    let outside = |axis: usize, inside: f64| inside * network.frame.scale + network.frame.offset[axis];
    let (mut photo, mut point, mut axis) = (None, None, None);
    let (name, a, value, of) = match observed {
        AdditionalObservation::Control(k, n) => {
            let id = &project.points[network.points[k].index].id;
            (point, axis) = (Some(id.clone()), Some(AXES[n].to_owned()));
            let column = columns.point[k][n];
            let a = column.map(|column| (column, 1.0)).into_iter().collect();
            (format!("{id} {}", AXES[n]), a, outside(n, network.points[k].prior[n].0), length())
        }
        AdditionalObservation::Position(k, n) => {
            let id = &project.photos[network.photos[k].index].id;
            (photo, axis) = (Some(id.clone()), Some(AXES[n].to_owned()));
            let a = vec![(columns.photo(k).start + 3 + n, 1.0)];
            (format!("{id} {}", AXES[n]), a, outside(n, network.photos[k].prior[n].0), length())
        }
        AdditionalObservation::Distance(k) => {
            let bar = &network.bars[k];
            let distance = &project.distances[bar.index];
            // Weighted, between coordinates and lengths of the same scale.
            let (_, rows) = distance_row(network, state, bar);
            let ends = columns.point[bar.from].iter().chain(&columns.point[bar.to]);
            let a = ends.zip(rows).filter_map(|(column, slope)| Some(((*column)?, slope / bar.sqrt_weight))).collect();
            (format!("{} - {}", distance.from, distance.to), a, distance.length, length())
        }
        AdditionalObservation::Parameter(k, n) => {
            let block = &network.interiors[k];
            let camera = &project.cameras[block.camera];
            let estimated = &block.estimated[n];
            photo = block.photo.map(|photo| project.photos[network.photos[photo].index].id.clone());
            let a = vec![(columns.interior(network, k).start + n, 1.0)];
            let name = format!("{} {}", photo.as_ref().unwrap_or(&camera.id), estimated.parameter.name());
            (name, a, estimated.prior.0, parameter_unit(camera, estimated.parameter))
        }
    };
    let sigma = unit / observed.sqrt_weight(network);
    let l = -observed.residual(network, state) * unit;
    EquationRow { equation: Equation { name, photo, point, given: Some(given), axis, value, sigma, unit: of }, a, l }
}

/// The relative poses of a rig's camera, without unknowns of their own: exposure k minus the mean of those before it, times
/// √(k / (k + 1)), has the standard error of one exposure and nothing in common with the others (Helmert's contrasts).
fn rig_rows(session: &Session<'_>, columns: &Columns, member: &Member) -> Vec<EquationRow> {
    let (network, state) = (&session.network, &session.state);
    let mean = member.mean(state);
    let id = |photo: usize| &session.project.photos[network.photos[photo].index].id;
    let mut rows = Vec::new();
    for k in 1..member.exposures.len() {
        let size = (k as f64 / (k + 1) as f64).sqrt();
        let factor = |exposure: usize| if exposure == k { size } else { -size / k as f64 };
        let [first, own] = member.exposures[k].1.map(id);
        for row in 0..6 {
            let scale = if row < 3 { 1.0 } else { network.frame.scale };
            let mut a = BTreeMap::new();
            let mut l = 0.0;
            for exposure in 0..=k {
                let by_photos = member.by_photos(state, exposure);
                for column in 0..12 {
                    let at = columns.photo(member.exposures[exposure].1[column / 6]).start + column % 6;
                    let of_unknown = if column % 6 < 3 { 1.0 } else { network.frame.scale };
                    *a.entry(at).or_insert(0.0) += factor(exposure) * by_photos[(row, column)] * scale / of_unknown;
                }
                l -= factor(exposure) * mean.deviations[exposure][row] * scale;
            }
            let axis = ["x", "y", "z"][row % 3].to_owned();
            let of = if row < 3 { "rotation" } else { "position" };
            let equation = Equation {
                name: format!("{own} - {first} {of} {axis}"),
                photo: Some(own.clone()),
                point: None,
                given: None,
                axis: Some(axis),
                value: 0.0,
                sigma: scale / member.sqrt_weight[row / 3],
                unit: if row < 3 { "rad".to_owned() } else { session.project.unit.clone() },
            };
            rows.push(EquationRow { equation, a: a.into_iter().collect(), l });
        }
    }
    rows
}

/// D': inner constraints, or the held coordinates; a row a constraint.
fn constraints(session: &Session<'_>, datum: &FreeDatum, columns: &Columns) -> Vec<Vec<(usize, f64)>> {
    let rows = datum.constraint_rows(&session.state);
    let constraint = |j: usize| {
        let carriers = datum.carriers.iter().enumerate();
        carriers.filter_map(|(k, &(point, axis))| Some((columns.point[point][axis]?, rows[(k, j)]))).collect()
    };
    (0..rows.ncols()).map(constraint).collect()
}
