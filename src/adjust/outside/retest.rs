//! Observations that were not used, tested with the full covariance of the network.
//!
//! An orientation judges measurements by fixed limits in the photo. The adjustment knows more: the prediction of an image
//! coordinate by everything else has the cofactor q, and its error e/(σ √(1 + q)) is normal if the measurement is right (Baarda's w
//! of an observation that is left out). q has the uncertainty of the exterior orientation, of the point and of given coordinates.
//! Tested observations are in the equations with a vanishing weight, so that q is available with the cofactors.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use crate::adjust::gross_errors::robust::scale;
use crate::adjust::gross_errors::snooping::vanishing;
use crate::adjust::problem::left_out::RejectedObservations;
use crate::adjust::problem::numbering::Numbering;
use crate::adjust::problem::{eccentric, far_points};
use crate::adjust::solve::session::{Log, Session};
use crate::adjustment::{AdjustOptions, GrossError, GrossErrorAction, StatisticsChoice, Termination};
use crate::project::{DatumKind, Project, Role, SetAsideBy, SetAsideReason};
use crate::statistics::distribution::critical_w;

/// A measurement whose weight vanishes and whose cofactor is larger all the same is the only one that determines its place.
const UNPREDICTED: f64 = 0.01;
/// Rounds of taking back: what has come back may show that more fits.
const MOST_ROUNDS: usize = 3;

/// The image coordinates' standard deviation in units of their a priori ones, from residuals, which large ones do not change; at least 1:
/// an item within the limit of its own standard errors fits.
pub fn unit(session: &Session<'_>, options: &AdjustOptions) -> f64 {
    let Ok(residuals) = session.residuals(options) else { return 1.0 };
    let coordinates: Vec<f64> = residuals.into_iter().flatten().collect();
    if coordinates.is_empty() || session.redundancy == 0 {
        return 1.0;
    }
    let spread = (session.network.observations_count() as f64 / session.redundancy as f64).sqrt();
    let unit = scale(&coordinates) * spread;
    if unit.is_finite() { unit.max(1.0) } else { 1.0 }
}

/// Prediction errors, in standard errors, of rows of the document that were not used in a session, of a standard deviation of unit
/// weight `unit`. Rows are skipped whose photo is not used, or whose point nothing else determines.
pub fn predicted(
    session: &Session<'_>,
    rows: &[usize],
    left_out: &RejectedObservations,
    unit: f64,
    options: &AdjustOptions,
) -> HashMap<usize, f64> {
    tested(session, rows, left_out, unit, options).unwrap_or_default()
}

fn tested(
    session: &Session<'_>,
    rows: &[usize],
    left_out: &RejectedObservations,
    unit: f64,
    options: &AdjustOptions,
) -> Option<HashMap<usize, f64>> {
    let rows = determined(session, rows);
    if rows.is_empty() {
        return Some(HashMap::new());
    }
    let (mut project, mut left_out) = (session.project.clone(), left_out.clone());
    for &row in &rows {
        project.observations[row].enabled = true;
        left_out.observations[row] = false;
    }
    let mut probe = Session::new(&project, session.numbering, &left_out).ok()?;
    probe.state.adopt(&probe.network, &session.state, &session.network);
    probe.shift = eccentric::shifts(&project, &probe.network, &probe.state);
    let residuals = probe.residuals(options).ok()?;
    let own: HashMap<usize, [f64; 2]> =
        session.network.rays.iter().zip(&session.weights).map(|(ray, weight)| (ray.row, *weight)).collect();
    let asked: HashSet<usize> = rows.into_iter().collect();
    let factors = probe.network.rays.iter().zip(&residuals).map(|(ray, e)| match asked.contains(&ray.row) {
        true => [vanishing(e[0].abs().max(e[1].abs()) / unit); 2],
        false => own.get(&ray.row).copied().unwrap_or([1.0; 2]),
    });
    probe.weights = factors.collect();
    let full = AdjustOptions { statistics: StatisticsChoice::Full, covariance_of: Vec::new(), ..options.clone() };
    let cofactors = probe.finish(&full, false).ok()?.cofactors?;
    let one = |(k, ray): (usize, &crate::adjust::problem::network::ImageObservation)| {
        let (e, q, factor) = (residuals[k], cofactors.rays[k], probe.weights[k][0]);
        let alone = q.iter().any(|q| *q > UNPREDICTED);
        let error = |s: usize| e[s].abs() / (unit * (1.0 + q[s].max(0.0) / (factor * factor)).sqrt());
        let error = error(0).max(error(1));
        (asked.contains(&ray.row) && !alone && error.is_finite()).then_some((ray.row, error))
    };
    Some(probe.network.rays.iter().enumerate().filter_map(one).collect())
}

/// Of some rows those whose photo took part and whose point did, or is given, in front of the camera.
fn determined(session: &Session<'_>, rows: &[usize]) -> Vec<usize> {
    let (project, network) = (session.project, &session.network);
    let photos: HashMap<usize, usize> = network.photos.iter().enumerate().map(|(k, photo)| (photo.index, k)).collect();
    let points: HashMap<usize, usize> = network.points.iter().enumerate().map(|(k, point)| (point.index, k)).collect();
    let controlled = project.datum.kind == DatumKind::Control;
    let place = |point: usize| match points.get(&point) {
        Some(&k) => Some(session.state.points[k]),
        None => {
            let given = &project.points[point];
            given.xyz.filter(|_| controlled && given.role == Role::Control).map(|xyz| network.frame.inside(xyz))
        }
    };
    let stands = |row: &&usize| {
        let (photo, point) = session.numbering.observations[**row];
        let pose = photos.get(&photo).map(|k| &session.state.poses[*k]);
        let is_wide = project.cameras[session.numbering.cameras[photo]].interior.model().is_wide;
        pose.zip(place(point)).is_some_and(|(pose, x)| is_wide || pose.camera_point(&x)[2] < 0.0)
    };
    rows.iter().filter(stands).copied().collect()
}

/// The document with what an orientation has set aside and fits in the adjustment; the record has what came back.
pub fn with_what_fits<'a>(
    mut project: Cow<'a, Project>,
    numbering: &Numbering,
    options: &AdjustOptions,
    record: &mut Vec<GrossError>,
) -> Cow<'a, Project> {
    for _ in 0..MOST_ROUNDS {
        let fitting = fitting(&project, numbering, options).unwrap_or_default();
        if fitting.is_empty() {
            break;
        }
        for (row, statistic) in fitting {
            let observation = &mut project.to_mut().observations[row];
            observation.enabled = true;
            record.push(GrossError {
                photo: observation.photo.clone(),
                point: observation.point.clone(),
                given: None,
                action: GrossErrorAction::Restored,
                statistic,
                limit: critical_w(),
                round: 0,
                consequence: false,
            });
        }
    }
    project
}

/// Rows that were set aside though they fit, with their prediction errors.
fn fitting(project: &Project, numbering: &Numbering, options: &AdjustOptions) -> Option<Vec<(usize, f64)>> {
    let set_aside = project.set_aside.iter();
    let aside: HashSet<(&str, &str)> = set_aside
        .filter(|s| s.by == SetAsideBy::Orientation && s.reason == SetAsideReason::Disagrees)
        .map(|s| (s.photo.as_str(), s.point.as_str()))
        .collect();
    let is_aside = |row: &usize| {
        let o = &project.observations[*row];
        !o.enabled && aside.contains(&(o.photo.as_str(), o.point.as_str()))
    };
    let rows: Vec<usize> = (0..project.observations.len()).filter(is_aside).collect();
    if rows.is_empty() {
        return None;
    }
    let nothing = RejectedObservations::nothing(project);
    let mut session = Session::new(project, numbering, &nothing).ok()?;
    session.start_at(&far_points::control_starts(project, numbering));
    let mut log = Log { iterations: Vec::new(), on_iteration: &mut |_| true };
    if session.iterate(options, &mut log).ok()? != Termination::Converged {
        return None;
    }
    let unit = unit(&session, options);
    let errors = predicted(&session, &rows, &nothing, unit, options);
    let mut fitting: Vec<(usize, f64)> = errors.into_iter().filter(|(_, error)| *error < critical_w()).collect();
    fitting.sort_by_key(|(row, _)| *row);
    Some(fitting)
}
