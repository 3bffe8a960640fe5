//! The same observations under three datums: what differs (coordinates, their ellipses, the trace of Q) and what does not (vᵀPv).

use serde::{Deserialize, Serialize};

use sightline::adjust::{Adjuster, adjust, at_end};
use sightline::adjustment::{AdjustOptions, AdjustedPoint, StatisticsChoice};
use sightline::error::{Error, Result};
use sightline::project::{Datum, DatumKind, Project, Role};

/// The network under one datum.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DatumCase {
    /// The datum.
    pub kind: DatumKind,
    /// Why there is no result; without points and without a reason there are no control points.
    pub failed: Option<Box<Error>>,
    /// Adjusted points with their covariances.
    pub points: Vec<AdjustedPoint>,
    /// Observations less unknowns plus constraints.
    pub redundancy: usize,
    /// Constraints.
    pub constraints: usize,
    /// Given coordinates that take part as observations.
    pub given: usize,
    /// vᵀPv.
    pub weighted_squares: f64,
    /// Its part from image coordinates.
    pub of_image: f64,
    /// √(vᵀPv / redundancy).
    pub sigma0: Option<f64>,
    /// Trace of the cofactor matrix of the point coordinates, squared unit of length: covariances over sigma0².
    pub trace: f64,
    /// Root mean square per axis of the standard errors of all points.
    pub rms: [f64; 3],
}

/// A movement of the whole network that no image coordinate sees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// As in [`sightline::adjust::Motion`].
    pub name: String,
    /// Change of every point, in the order of the free network's points, for a movement of one.
    pub points: Vec<[f64; 3]>,
    /// Largest change of an observation when the fastest point moves by one unit of length: |A g|∞ over the largest entry of g at a point.
    pub seen: f64,
}

/// The comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Datums {
    /// Control, minimal, free.
    pub cases: Vec<DatumCase>,
    /// The datum defect of the free network.
    pub motions: Vec<Motion>,
}

/// Adjusts the project under control, minimal constraints (on the points named, or chosen by the engine) and inner constraints.
///
/// # Errors
/// [`Error::Invalid`] for a document that is not sound; a datum that cannot be adjusted is a case with its reason.
pub fn datums(project: &Project, options: &AdjustOptions, held: Option<&[String]>) -> Result<Datums> {
    project.validate()?;
    let options = precision(options);
    let mut cases = Vec::new();
    let mut motions = Vec::new();
    for kind in [DatumKind::Control, DatumKind::Minimal, DatumKind::Free] {
        let under = under(project, kind, held);
        let control = under.points.iter().any(|point| point.role == Role::Control);
        if kind == DatumKind::Control && !control {
            cases.push(failed_case(kind, None));
            continue;
        }
        // Residuals at control points are part of vᵀPv, and their standard errors of its redundancy.
        match adjust(&under, &options, &mut |_| true) {
            Err(error) => cases.push(failed_case(kind, Some(Box::new(error)))),
            Ok(adjustment) => {
                let sigma0 = adjustment.sigma0;
                let variance = sigma0.map_or(1.0, |sigma0| sigma0 * sigma0);
                let end = at_end(&under, &options)?;
                let system = end.linear_system()?;
                let squares = |image: bool| -> f64 {
                    let rows = system.observations.iter().zip(system.l.iter().zip(&system.p));
                    rows.filter(|(row, _)| !image || row.given.is_none()).map(|(_, (l, p))| p * l * l).sum()
                };
                let diagonal = |point: &AdjustedPoint| point.covariance.map(|c| [c[0], c[3], c[5]]);
                let all: Vec<[f64; 3]> = adjustment.points.iter().filter_map(diagonal).collect();
                let sum = |axis: usize| all.iter().map(|variances| variances[axis]).sum::<f64>();
                let count = all.len().max(1) as f64;
                if kind == DatumKind::Free {
                    motions = moved(&end, &adjustment.points)?;
                }
                cases.push(DatumCase {
                    kind,
                    failed: None,
                    redundancy: adjustment.redundancy,
                    constraints: adjustment.constraints,
                    given: system.observations.iter().filter(|row| row.given.is_some()).count(),
                    weighted_squares: squares(false),
                    of_image: squares(true),
                    sigma0,
                    trace: (sum(0) + sum(1) + sum(2)) / variance,
                    rms: [sum(0), sum(1), sum(2)].map(|sum| (sum / count).sqrt()),
                    points: adjustment.points,
                });
            }
        }
    }
    Ok(Datums { cases, motions })
}

/// Options with which datums are compared: least squares with precision.
pub(super) fn precision(options: &AdjustOptions) -> AdjustOptions {
    AdjustOptions {
        statistics: StatisticsChoice::Precision,
        snooping: false,
        robust: None,
        variance_components: None,
        covariance_of: Vec::new(),
        ..options.clone()
    }
}

/// The project under a datum; minimal constraints on the points named, or chosen by the engine.
pub(super) fn under(project: &Project, kind: DatumKind, held: Option<&[String]>) -> Project {
    let points = held.filter(|_| kind == DatumKind::Minimal).map(<[String]>::to_vec);
    Project { datum: Datum { kind, points }, ..project.clone() }
}

fn failed_case(kind: DatumKind, failed: Option<Box<Error>>) -> DatumCase {
    DatumCase {
        kind,
        failed,
        points: Vec::new(),
        redundancy: 0,
        constraints: 0,
        given: 0,
        weighted_squares: 0.0,
        of_image: 0.0,
        sigma0: None,
        trace: 0.0,
        rms: [0.0; 3],
    }
}

fn moved(end: &Adjuster, points: &[AdjustedPoint]) -> Result<Vec<Motion>> {
    let (system, normal) = end.equations()?;
    let motion = |motion: sightline::adjust::Motion| {
        let at = |point: &AdjustedPoint| {
            let mut moved = [0.0; 3];
            for (unknown, g) in system.unknowns.iter().zip(&motion.vector) {
                if unknown.point.as_ref() == Some(&point.id) {
                    let axis = ["X", "Y", "Z"].iter().position(|axis| unknown.name.ends_with(&format!(" {axis}")));
                    moved[axis.unwrap_or_default()] = *g;
                }
            }
            moved
        };
        let points: Vec<[f64; 3]> = points.iter().map(at).collect();
        let fastest = points.iter().flatten().fold(f64::MIN_POSITIVE, |most, g| most.max(g.abs()));
        let row = |row: usize| system.a.row(row).map(|(column, a)| a * motion.vector[column]).sum::<f64>().abs();
        let seen = (0..system.a.rows).map(row).fold(0.0, f64::max) / fastest;
        Motion { name: motion.name, points, seen }
    };
    Ok(normal.null_space.into_iter().map(motion).collect())
}
