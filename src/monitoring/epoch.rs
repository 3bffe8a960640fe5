//! An epoch as the comparison uses it: coordinates with their covariance, whatever it was given as.

use std::collections::{BTreeSet, HashMap};

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::bundle::{EpochNetwork, network};
use super::covariance::PointsCovariance;
use super::date;
use super::request::{ControlUse, Epoch, ListedCovariance};
use super::result::{EpochNote, LeftOutPoint, LeftOutPointReason, UsedEpoch};
use crate::adjust::{adjust, apply};
use crate::adjustment::{AdjustOptions, Adjustment, Robust, StatisticsChoice, Termination};
use crate::axes::UserAxes;
use crate::error::{Error, Place, Reason, Result, Thing};
use crate::project::{Datum, DatumKind, LARGEST, Project, Role};

/// Relative asymmetry of a covariance matrix that is rounding: such texts have few digits.
const ASYMMETRY: f64 = 1e-3;

/// Variance factors and redundancies below this, or above its reciprocal, are no numbers to compute with.
const SMALLEST: f64 = 1e-50;

/// An epoch ready to be compared.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// Name.
    pub name: String,
    /// Days since 1970-01-01.
    pub day: Option<f64>,
    /// Identifiers.
    pub ids: Vec<String>,
    /// Coordinates.
    pub xyz: Vec<Vector3<f64>>,
    /// Covariance, including σ0².
    pub covariance: PointsCovariance,
    /// Standard deviation of unit weight.
    pub sigma0: Option<f64>,
    /// Degrees of freedom of σ0; `None`: not known, or none.
    pub redundancy: Option<f64>,
    /// Whether it has a scale of its own.
    pub scaled: bool,
    /// Unit.
    pub unit: Option<String>,
    /// Letters and order of its coordinates.
    pub axes: Option<UserAxes>,
    /// Control points of its project.
    pub control: Vec<String>,
    /// Datum points of its project.
    pub datum: Vec<String>,
    /// Points that cannot be used.
    pub left_out: Vec<LeftOutPoint>,
    /// Inputs of an adjustment of all epochs; `None` if it is not possible.
    pub network: Option<EpochNetwork>,
    /// As reported.
    pub used: UsedEpoch,
}

/// An error in a field of the epoch at a place of the list.
pub fn at(index: usize, field: &str) -> Place {
    let dot = if field.is_empty() { "" } else { "." };
    Place::field(format!("epochs[{index}]{dot}{field}"))
}

fn invalid(reason: Reason, at: Place) -> Error {
    Error::Invalid { reason, at }
}

/// Prepares an epoch.
///
/// # Errors
/// As [`super::compare_epochs`].
pub fn prepared(index: usize, epoch: &Epoch) -> Result<Prepared> {
    let day = epoch.date.as_deref().map(|text| {
        date::days(text).ok_or_else(|| {
            let reason = Reason::EpochDate { text: crate::error::shortened(text) };
            invalid(reason, at(index, "date"))
        })
    });
    let day = day.transpose()?;
    if epoch.temperature.is_some_and(|t| !t.is_finite()) {
        return Err(invalid(Reason::NotFinite, at(index, "temperature")));
    }
    let mut prepared = match (&epoch.project, &epoch.points) {
        (Some(project), None) => of_project(index, epoch, project)?,
        (None, Some(_)) => of_list(index, epoch)?,
        _ => return Err(invalid(Reason::EpochSource { name: epoch.name.clone() }, at(index, ""))),
    };
    prepared.day = day;
    prepared.used = UsedEpoch {
        name: epoch.name.clone(),
        date: epoch.date.clone(),
        temperature: epoch.temperature,
        sigma0: prepared.sigma0,
        redundancy: prepared.redundancy,
        points: prepared.ids.len(),
        scaled: prepared.scaled,
        notes: std::mem::take(&mut prepared.used.notes),
    };
    if prepared.redundancy.is_none() {
        prepared.used.notes.push(EpochNote::NoRedundancy);
    }
    if prepared.ids.is_empty() {
        return Err(invalid(Reason::EpochNoSigmas { name: epoch.name.clone() }, at(index, "points")));
    }
    Ok(prepared)
}

/// The project as a free network: control points as unknown points, scale bars as they are.
pub fn released(project: &Project) -> Project {
    let mut free = project.clone();
    for point in free.points.iter_mut().filter(|p| p.role == Role::Control) {
        point.role = Role::Tie;
        point.sigma = None;
    }
    free.datum = Datum { kind: DatumKind::Free, points: None };
    free
}

/// Adjusts for coordinates and the covariance of all of them.
fn with_covariance(project: &Project, options: &AdjustOptions) -> Result<Adjustment> {
    let statistics = StatisticsChoice::Precision;
    let options = AdjustOptions { statistics, covariance_of: Vec::new(), ..options.clone() };
    // What takes part is known only after an adjustment: control points that no photo sees are gone from a free network.
    let first = adjust(project, &options, &mut |_| true)?;
    let covariance_of = first.points.iter().map(|p| p.id.clone()).collect();
    let mut project = apply(project, &first);
    project.features.clear();
    project.systems.clear();
    adjust(&project, &AdjustOptions { covariance_of, ..options }, &mut |_| true)
}

fn of_project(index: usize, epoch: &Epoch, project: &Project) -> Result<Prepared> {
    let name = epoch.name.clone();
    project.validate()?;
    let unsettled = || invalid(Reason::EpochNotConverged { name: epoch.name.clone() }, at(index, "adjustment"));
    if epoch.adjustment.as_ref().is_some_and(|a| a.termination != Termination::Converged) {
        return Err(unsettled());
    }
    let by_control = project.datum.kind == DatumKind::Control;
    let release = by_control && epoch.control == ControlUse::Released;
    let mut options = epoch.adjustment.as_ref().map_or_else(AdjustOptions::default, |a| a.options.clone());
    if let (true, Some(Robust::Huber | Robust::Tukey)) = (release, options.robust) {
        // Its scale was that of another network.
        options.robust_scale = Default::default();
    }
    let started = match &epoch.adjustment {
        Some(adjustment) => apply(project, adjustment),
        None => project.clone(),
    };
    let own = epoch.adjustment.as_ref().filter(|a| !release && has_all(a));
    let free = if release { released(&started) } else { started.clone() };
    let adjustment = match own {
        Some(adjustment) => adjustment.clone(),
        None => with_covariance(&free, &options)?,
    };
    if adjustment.termination != Termination::Converged {
        return Err(unsettled());
    }
    let Some(stated) = &adjustment.covariance else {
        return Err(invalid(Reason::EpochNoSigmas { name }, at(index, "adjustment")));
    };
    let n = stated.points.len();
    let there: BTreeSet<&str> = adjustment.points.iter().map(|p| p.id.as_str()).collect();
    let bar = |from: &str, to: &str| there.contains(from) && there.contains(to);
    let bars = project.distances.iter().any(|d| !d.check && bar(&d.from, &d.to));
    let places: HashMap<&str, [f64; 3]> = adjustment.points.iter().map(|p| (p.id.as_str(), p.xyz)).collect();
    let control = project.points.iter().filter(|p| p.role == Role::Control).map(|p| p.id.clone());
    let control: Vec<String> = control.collect();
    let mut notes = Vec::new();
    if release && !control.is_empty() {
        notes.push(EpochNote::ControlReleased { points: control.clone() });
    }
    let sound = stated.matrix.len() == 3 * n && stated.matrix.iter().all(|row| row.len() == 3 * n);
    let finite = stated.matrix.iter().flatten().all(|c| c.abs() < LARGEST);
    let xyz = stated.points.iter().map(|id| places.get(id.as_str()).copied().map(Vector3::from));
    let xyz: Option<Vec<Vector3<f64>>> = xyz.collect();
    let (true, true, Some(xyz)) = (sound, finite, xyz) else {
        let reason = Reason::EpochMatrix { rows: stated.matrix.len(), expected: 3 * n };
        return Err(invalid(reason, at(index, "adjustment.covariance")));
    };
    Ok(Prepared {
        name,
        day: None,
        ids: stated.points.clone(),
        xyz,
        covariance: PointsCovariance::Full(DMatrix::from_fn(3 * n, 3 * n, |i, j| stated.matrix[i][j])),
        sigma0: adjustment.sigma0.filter(|s| *s > 0.0),
        redundancy: Some(adjustment.redundancy as f64).filter(|r| *r > 0.0),
        scaled: bars || (by_control && !release),
        unit: Some(project.unit.clone()),
        axes: project.axes,
        control,
        datum: project.datum.points.clone().unwrap_or_default(),
        left_out: Vec::new(),
        // Control points that stay observations tie an epoch to a system of its own.
        network: if by_control && !release { None } else { network(&free, &adjustment) },
        used: UsedEpoch { notes, ..UsedEpoch::default() },
    })
}

/// Whether an adjustment has the covariance of all its points already.
fn has_all(adjustment: &Adjustment) -> bool {
    adjustment.covariance.as_ref().is_some_and(|covariance| {
        let stated: BTreeSet<&str> = covariance.points.iter().map(String::as_str).collect();
        stated.len() == adjustment.points.len() && adjustment.points.iter().all(|p| stated.contains(p.id.as_str()))
    })
}

fn of_list(index: usize, epoch: &Epoch) -> Result<Prepared> {
    let name = epoch.name.clone();
    let points = epoch.points.as_deref().unwrap_or_default();
    let mut seen = BTreeSet::new();
    for (k, point) in points.iter().enumerate() {
        let place = || at(index, &format!("points[{k}]"));
        if !seen.insert(point.id.as_str()) {
            return Err(Error::Duplicate { kind: Thing::Point, name: point.id.clone(), at: place() });
        }
        if !point.xyz.iter().chain(point.sigma.iter().flatten()).all(|x| x.abs() < LARGEST) {
            return Err(invalid(Reason::NotFinite, place()));
        }
        if point.sigma.iter().flatten().any(|s| *s < 0.0) {
            return Err(invalid(Reason::NegativeSigma, place()));
        }
    }
    for (field, value) in [("sigma0", epoch.sigma0), ("redundancy", epoch.redundancy)] {
        if value.is_some_and(|value| !(value > SMALLEST) || !(value < 1.0 / SMALLEST)) {
            let reason = Reason::NotPositive { name: field.into(), value: value.unwrap_or_default().into() };
            return Err(invalid(reason, at(index, field)));
        }
    }
    let stated = epoch.covariance.as_ref().map(|c| matrix(index, c, &seen)).transpose()?;
    let in_matrix: HashMap<&str, usize> = match &epoch.covariance {
        Some(c) => c.points.iter().enumerate().map(|(k, id)| (id.as_str(), k)).collect(),
        None => HashMap::new(),
    };
    let usable = |p: &&super::request::ListedPoint| p.sigma.is_some() || in_matrix.contains_key(p.id.as_str());
    let kept: Vec<_> = points.iter().filter(usable).collect();
    let no_sigma = || LeftOutPointReason::NoSigma { epoch: epoch.name.clone() };
    let left_out = points.iter().filter(|p| !usable(p)).map(|p| LeftOutPoint { id: p.id.clone(), reason: no_sigma() });
    let own = |p: &super::request::ListedPoint| {
        let sigma = p.sigma.unwrap_or_default();
        Matrix3::from_diagonal(&Vector3::from(sigma.map(|s| s * s)))
    };
    let mut covariance = PointsCovariance::Blocks(kept.iter().map(|p| own(p)).collect());
    if let Some(stated) = &stated {
        let places: Vec<Option<usize>> = kept.iter().map(|p| in_matrix.get(p.id.as_str()).copied()).collect();
        let n = 3 * kept.len();
        covariance = PointsCovariance::Full(DMatrix::from_fn(n, n, |i, j| match (places[i / 3], places[j / 3]) {
            (Some(a), Some(b)) => stated[(3 * a + i % 3, 3 * b + j % 3)],
            (None, None) if i == j => covariance.block(i / 3, i / 3)[(i % 3, i % 3)],
            _ => 0.0,
        }));
    }
    let largest = (0..kept.len()).map(|k| covariance.block(k, k).trace()).fold(0.0, f64::max);
    if !(largest > 0.0) {
        return Err(invalid(Reason::EpochNoSigmas { name }, at(index, "points")));
    }
    let notes = if stated.is_none() { vec![EpochNote::NoCovariance] } else { Vec::new() };
    Ok(Prepared {
        name,
        day: None,
        ids: kept.iter().map(|p| p.id.clone()).collect(),
        xyz: kept.iter().map(|p| Vector3::from(p.xyz)).collect(),
        covariance,
        sigma0: epoch.sigma0,
        redundancy: epoch.redundancy,
        scaled: epoch.scale.unwrap_or(true),
        unit: epoch.unit.clone(),
        axes: None,
        control: Vec::new(),
        datum: Vec::new(),
        left_out: left_out.collect(),
        network: None,
        used: UsedEpoch { notes, ..UsedEpoch::default() },
    })
}

/// The stated matrix, made symmetric.
///
/// # Errors
/// [`Reason::EpochMatrix`] of a wrong size, [`Reason::EpochNotCovariance`] if it cannot be one, [`Error::Unknown`] for a point that is
/// not in the list.
fn matrix(index: usize, stated: &ListedCovariance, known: &BTreeSet<&str>) -> Result<DMatrix<f64>> {
    let mut seen = BTreeSet::new();
    for (k, id) in stated.points.iter().enumerate() {
        let place = || at(index, &format!("covariance.points[{k}]"));
        if !known.contains(id.as_str()) {
            return Err(Error::Unknown { kind: Thing::Point, name: id.clone(), at: place() });
        }
        if !seen.insert(id.as_str()) {
            return Err(Error::Duplicate { kind: Thing::Point, name: id.clone(), at: place() });
        }
    }
    let (rows, n) = (&stated.matrix, 3 * stated.points.len());
    let triangle = rows.iter().enumerate().all(|(i, row)| row.len() == i + 1);
    let full = rows.iter().all(|row| row.len() == n);
    if rows.len() != n || !(triangle || full) {
        let reason = Reason::EpochMatrix { rows: rows.len(), expected: n };
        return Err(invalid(reason, at(index, "covariance.matrix")));
    }
    let no_covariance = |i: usize| invalid(Reason::EpochNotCovariance, at(index, &format!("covariance.matrix[{i}]")));
    // Zeros above the diagonal alone are the rest of a triangle.
    let lower = triangle || strictly_lower(rows);
    let mut matrix = DMatrix::zeros(n, n);
    for i in 0..n {
        for j in 0..=i {
            let own = (rows[i][i] * rows[j][j]).sqrt();
            let other = if lower { rows[i][j] } else { rows[j][i] };
            let mean = 0.5 * (rows[i][j] + other);
            let symmetric = (rows[i][j] - other).abs() <= ASYMMETRY * own;
            if !(mean.abs() < LARGEST) || !(rows[i][i] >= 0.0) || !symmetric || !(mean.abs() <= own * (1.0 + ASYMMETRY))
            {
                return Err(no_covariance(i));
            }
            (matrix[(i, j)], matrix[(j, i)]) = (mean, mean);
        }
    }
    // No combination of coordinates has a negative variance, but for the digits that the text has.
    let mut lifted = matrix.clone();
    let mean = matrix.trace() / n.max(1) as f64;
    (0..n).for_each(|k| lifted[(k, k)] += ASYMMETRY * mean);
    if n > 0 && mean > 0.0 && lifted.cholesky().is_none() {
        return Err(no_covariance(0));
    }
    Ok(matrix)
}

/// Whether only zeros stand above the diagonal, and something below it.
fn strictly_lower(rows: &[Vec<f64>]) -> bool {
    let above = rows.iter().enumerate().all(|(i, row)| row.iter().skip(i + 1).all(|x| *x == 0.0));
    above && rows.iter().enumerate().any(|(i, row)| row.iter().take(i).any(|x| *x != 0.0))
}
