//! Bundle adjustment: weighted least squares on image coordinates, control, distances and observed parameters.
//!
//! The rooms, each using only those before it: `linear` (tiles and small factors), `problem` (the numbered document, its
//! values, what is known of it beforehand), `equations` (collinearity, Schur complement, ordering), `datum`, `statistics`
//! (cofactors), `diagnosis` (rank defect, advice), `solve` (iteration, session), `gross_errors` (snooping, robust weights),
//! `variance_components`, `patterns` (systematic residuals), `report`, `outside` (items that were not used) and `inside` (equations and iterations laid open).

mod datum;
mod diagnosis;
mod equations;
mod gross_errors;
pub(crate) mod inside;
mod linear;
mod outside;
mod patterns;
mod problem;
mod report;
mod solve;
mod statistics;
mod variance_components;

use std::collections::{BTreeMap, HashMap, HashSet};

use nalgebra::{DMatrix, Matrix3};

use crate::adjustment::{
    AdjustOptions, AdjustedCamera, AdjustedPoint, Adjustment, Advice, Iteration, Measured, ResidualPlace,
    StatisticsChoice, Termination, correlation_groups,
};
use crate::error::{Defect, Error, Place, Reason, Result};
use crate::features::{self, Function};
use crate::project::{Datum, DatumKind, Parameter, Project, Role};

use diagnosis::judgement::judgement;
use diagnosis::{advice, questions, structure};
use outside::control::{ControlDiscrepancy, Findings};
pub(crate) use outside::double_points::{DoublePointCandidate, pairs as pairs_of_one};
use problem::left_out::{Key, RejectedObservations};
use problem::network::Network;
pub use problem::numbering::Numbering;
use problem::{eccentric, far_points, unmodelled};
use report::result::Solved;
use solve::session::{Log, RobustVariance, Session};

pub use inside::cholesky::{Elimination, Factor};
pub use inside::linear_system::{Equation, LinearSystem, Unknown, UnknownKind, linearise};
pub use inside::normal_equations::{Block, BlockKind, FillIn, Motion, NormalEquations, Reduced, normal_equations};
pub use inside::s_transformation::s_transformed;
pub use inside::sparse::{SparseMatrix, npy};
pub use inside::stepping::{Adjuster, StepState, at_end, start_adjustment};
pub use problem::unmodelled::estimate as unmodelled;

/// Variance factors of the parameters of one camera are one factor; equations at the adjusted values repeat it to rounding and the last
/// step of the iteration, those of another document miss it by much more.
const SAME_FACTOR: f64 = 1e-3;

/// Adjusts the project; `on_iteration` sees every iteration and stops the work by returning false.
///
/// # Errors
/// Whatever [`Project::validate`] finds; [`crate::Error::Empty`] without observations;
/// [`crate::Error::MissingInitialValues`]; [`crate::Error::RankDefect`] if the network does not determine what is to be
/// estimated, or when all photos were taken from one place. An iteration that does not converge is a result.
pub fn adjust(
    project: &Project,
    options: &AdjustOptions,
    on_iteration: &mut dyn FnMut(&Iteration) -> bool,
) -> Result<Adjustment> {
    project.validate()?;
    if let Some(error) = questions::one_place(project) {
        return Err(error);
    }
    let document = project;
    let weighted = unmodelled::weighted(project, options.unmodelled)?;
    let sized = eccentric::sized(weighted, options.target_diameter)?;
    let numbering = Numbering::of(document);
    let ready = far_points::brought_back(sized, &numbering);
    let mut record = Vec::new();
    let ready = outside::retest::with_what_fits(ready, &numbering, options, &mut record);
    let project = ready.as_ref();
    outside::control::enough(project, &numbering)?;
    let mut left_out = RejectedObservations::nothing(project);
    let mut log = Log { iterations: Vec::new(), on_iteration };
    let mut settled = true;
    let starts = far_points::control_starts(project, &numbering);
    let mut session = Session::new(project, &numbering, &left_out)?;
    session.start_at(&starts);
    let searching = options.snooping || options.robust.is_some();
    let mut termination =
        if searching { session.robust_start(options, &mut log)? } else { session.iterate(options, &mut log)? };
    if options.snooping && termination == Termination::Converged {
        settled &= session.snoop(options, &mut log, &mut left_out, &mut record)?;
        if !left_out.is_empty() {
            session = session.without_found(&mut left_out, &mut record)?;
        }
        termination = session.iterate(options, &mut log)?;
    }
    if let (Some(kind), Termination::Converged) = (options.robust, termination) {
        settled &= session.reweight(kind, options, &mut log, &mut record)?;
    }
    let mut components = (Vec::new(), true);
    if let (Some(choice), None, Termination::Converged) = (&options.variance_components, options.robust, termination) {
        components = variance_components::estimate(&mut session, choice, options, &mut log)?;
    }
    let solution = session.finish(options, termination == Termination::Converged)?;
    let mut adjustment = Solved::new(&session, options, &solution).adjustment();
    adjustment.options = options.clone();
    adjustment.termination = termination;
    adjustment.iterations = std::mem::take(&mut log.iterations);
    adjustment.variance_components = components.0;
    if adjustment.standard_errors_estimated() {
        adjustment.global_test = None;
    }
    adjustment.advice = questions::questions(document, session.network.bars.len(), &adjustment);
    if solution.cofactors.is_some()
        && options.statistics == StatisticsChoice::Full
        && termination == Termination::Converged
    {
        adjustment.patterns = patterns::patterns(&mut session, options, solution.cost);
        let named = named_pattern(&adjustment);
        adjustment.advice.extend(named);
    }
    adjustment.advice.extend(judgement(&adjustment, unmodelled::estimate(document, &adjustment)));
    adjustment.advice.extend(advice::advice(project, &session.network, &session.state, &adjustment));
    if !searching && matches!(termination, Termination::IterationLimit | Termination::Diverged) {
        // Its own residuals show no gross error: those of a robust start do.
        adjustment.advice.retain(|advice| !matches!(advice, Advice::Suspected { .. }));
        let mut quiet = Log { iterations: Vec::new(), on_iteration: log.on_iteration };
        let suspects = Session::new(project, &numbering, &left_out).map(|mut session| {
            session.start_at(&starts);
            session.suspects(options, &mut quiet)
        });
        adjustment.advice.extend(gross_errors::search::suspicion(
            project,
            &session.network,
            &suspects.unwrap_or_default(),
        ));
    }
    if !settled {
        adjustment.advice.push(Advice::GrossErrorsUnsettled);
    }
    if !components.1 {
        adjustment.advice.push(Advice::VarianceComponentsUnsettled);
    }
    adjustment.gross_errors = record;
    adjustment.covariance = solution.covariance;
    tell_of_what_is_outside(document, &session, &left_out, &mut adjustment);
    // Wrong coordinates, axes or units bend the photos' fit: they are the cause of what looks like a lens.
    if adjustment.patterns.iter().any(|pattern| pattern.named) && adjustment.advice.iter().any(questions::bends) {
        adjustment.advice.retain(|advice| !matches!(advice, Advice::ResidualPattern { .. }));
        adjustment.patterns.iter_mut().for_each(|pattern| pattern.named = false);
        // What the pattern had explained of the standard errors is open again.
        let again = judgement(&adjustment, unmodelled::estimate(document, &adjustment));
        let new: Vec<Advice> = again.into_iter().filter(|advice| !adjustment.advice.contains(advice)).collect();
        adjustment.advice.extend(new);
    }
    // Wrong axes or units make single points misfit: they are the cause.
    adjustment.advice.sort_by_key(|advice| !questions::is_cause(advice));
    adjustment.correlation_groups = correlation_groups(&adjustment.advice);
    if !document.features.is_empty() || !document.systems.is_empty() {
        let stated = solution.cofactors.is_some();
        let mut carry = |functions: &[Function]| match stated {
            true => session.carried(functions, solution.cost).map(Some),
            false => Ok(None),
        };
        let Measured { features, systems } =
            features::measure(document, &adjustment.points, &adjustment.photos, &mut carry)?;
        (adjustment.features, adjustment.systems) = (features, systems);
    }
    Ok(adjustment)
}

/// The advice about the pattern that is named.
fn named_pattern(adjustment: &Adjustment) -> Option<Advice> {
    let pattern = adjustment.patterns.iter().find(|pattern| pattern.named)?;
    let adjusted = adjustment.cameras.iter().find(|adjusted| adjusted.camera.id == pattern.camera)?;
    let estimated: Vec<Parameter> = adjusted.sigma.keys().copied().collect();
    Some(patterns::advice(pattern, &adjusted.camera, &estimated))
}

/// Lists items that were not used, with its size, and compares control with the photos where anything contradicts it.
fn tell_of_what_is_outside(
    document: &Project,
    session: &Session,
    left_out: &RejectedObservations,
    adjustment: &mut Adjustment,
) {
    let options = adjustment.options.clone();
    let settled = adjustment.termination == Termination::Converged;
    let stated = settled && options.statistics != StatisticsChoice::None;
    let out = (0..adjustment.observations.len()).filter(|&row| !adjustment.observations[row].enabled);
    let out: Vec<usize> = out.collect();
    let predicted = if stated && !out.is_empty() {
        let unit = outside::retest::unit(session, &options);
        outside::retest::predicted(session, &out, left_out, unit, &options)
    } else {
        HashMap::new()
    };
    let doubted = |advice: &Advice| matches!(advice, Advice::Suspected { .. } | Advice::SigmasTooSmall { .. });
    let failed = adjustment.global_test.as_ref().is_some_and(|test| test.statistic > test.upper);
    let taken_out = left_out.given.iter().any(|key| matches!(key, Key::Control(..)));
    let adjusted: HashSet<&str> = adjustment.points.iter().map(|point| point.id.as_str()).collect();
    let control = document.points.iter().filter(|p| p.role == Role::Control && p.xyz.is_some());
    let without = control.into_iter().any(|p| !adjusted.contains(p.id.as_str()));
    let asked = failed || taken_out || without || adjustment.advice.iter().any(doubted);
    let mut found = None;
    if document.datum.kind == DatumKind::Control && stated && asked {
        let numbering = session.numbering;
        found = outside::control::compare(&solve::values::applied(session), numbering, &options);
    }
    let found = found.unwrap_or_default();
    adjustment.left_out = outside::list::left_out(document, adjustment, &predicted, &found.compared);
    let mut advice = advice_on_control(document, &found);
    advice.append(&mut adjustment.advice);
    adjustment.advice = advice;
    let pairs = double_points(document, adjustment);
    if !pairs.is_empty() {
        adjustment.advice.push(Advice::DoublePoints { pairs });
    }
}

/// Errors of control: exchanged pairs, then single points, the largest first.
fn advice_on_control(document: &Project, found: &Findings) -> Vec<Advice> {
    let (exchanged, wrong) = control_faults(document, found);
    let exchanged = exchanged.into_iter().map(|points| Advice::ExchangedPoints { points });
    let wrong = wrong.into_iter();
    let wrong = wrong.map(|(point, difference, sigma_ratio)| Advice::ControlMisfit { point, difference, sigma_ratio });
    exchanged.chain(wrong).collect()
}

/// A control point, given minus seen, and the size of that in standard errors.
pub(crate) type ControlFault = (String, [f64; 3], f64);

fn control_faults(document: &Project, found: &Findings) -> (Vec<[String; 2]>, Vec<ControlFault>) {
    let id = |k: usize| document.points[k].id.clone();
    let mut wrong: Vec<&ControlDiscrepancy> = found.compared.iter().filter(|c| c.wrong).collect();
    wrong.sort_by(|a, b| b.ratio.total_cmp(&a.ratio));
    let exchanged = |c: &&&ControlDiscrepancy| !found.exchanged.iter().any(|pair| pair.contains(&c.point));
    (
        found.exchanged.iter().map(|pair| pair.map(id)).collect(),
        wrong.iter().filter(exchanged).map(|c| (id(c.point), c.difference, c.ratio)).collect(),
    )
}

/// Exchanged pairs and wrong control points of an oriented document, as its photos, oriented by the other control points, see them;
/// under the control datum, whatever the document's is. Nothing where it cannot be adjusted.
pub(crate) fn wrong_control(project: &Project) -> (Vec<[String; 2]>, Vec<ControlFault>) {
    let datum = Datum { kind: DatumKind::Control, points: None };
    let project = Project { datum, ..project.clone() };
    let found = outside::control::compare(&project, &Numbering::of(&project), &AdjustOptions::default());
    control_faults(&project, &found.unwrap_or_default())
}

/// Pairs of adjusted points that may be one.
fn double_points(document: &Project, adjustment: &Adjustment) -> Vec<(String, String)> {
    let photos: HashMap<&str, usize> = document.photos.iter().enumerate().map(|(k, p)| (p.id.as_str(), k)).collect();
    let mut places: HashMap<&str, Vec<(usize, [f64; 2])>> = HashMap::new();
    for (o, _) in document.observations.iter().zip(&adjustment.observations).filter(|(_, adjusted)| adjusted.enabled) {
        places.entry(&o.point).or_default().push((photos[o.photo.as_str()], [o.u, o.v]));
    }
    let candidate = |point: &AdjustedPoint| -> Option<(String, DoublePointCandidate)> {
        let [xx, xy, xz, yy, yz, zz] = point.covariance?;
        let mut places = places.get(point.id.as_str()).cloned().unwrap_or_default();
        places.sort_unstable_by_key(|place| place.0);
        let covariance = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        Some((point.id.clone(), DoublePointCandidate { xyz: point.xyz.into(), covariance, places }))
    };
    let (ids, candidates): (Vec<String>, Vec<DoublePointCandidate>) =
        adjustment.points.iter().filter_map(candidate).unzip();
    let pairs = pairs_of_one(&candidates).into_iter();
    pairs.map(|[a, b]| (ids[a].clone(), ids[b].clone())).collect()
}

/// Measures the project's features and systems on an adjustment that was made of it before they were there. The equations are
/// set up again at the adjusted values, with the same options, since an adjustment does not keep its full covariance.
///
/// # Errors
/// As [`adjust`].
pub fn measured(project: &Project, adjustment: &Adjustment) -> Result<Measured> {
    measured_at(&apply(project, adjustment), &adjustment.options)
}

/// The same of a project that has the adjusted values already, with the options of that adjustment.
///
/// # Errors
/// As [`adjust`].
pub fn measured_at(project: &Project, options: &AdjustOptions) -> Result<Measured> {
    let statistics = options.statistics.min(StatisticsChoice::Precision);
    let options = AdjustOptions { statistics, covariance_of: Vec::new(), ..options.clone() };
    let Adjustment { features, systems, .. } = adjust(project, &options, &mut |_| true)?;
    Ok(Measured { features, systems })
}

/// How the plain adjustment of a project ends, and its values: no statistics, no advice, no search for what is wrong.
///
/// # Errors
/// As [`adjust`].
pub(crate) fn ending(project: &Project, options: &AdjustOptions) -> Result<(Termination, Project)> {
    project.validate()?;
    let weighted = unmodelled::weighted(project, options.unmodelled)?;
    let sized = eccentric::sized(weighted, options.target_diameter)?;
    let numbering = Numbering::of(project);
    let ready = far_points::brought_back(sized, &numbering);
    let project = ready.as_ref();
    let mut session = Session::new(project, &numbering, &RejectedObservations::nothing(project))?;
    session.start_at(&far_points::control_starts(project, &numbering));
    let termination = session.iterate(options, &mut Log { iterations: Vec::new(), on_iteration: &mut |_| true })?;
    Ok((termination, solve::values::applied(&session)))
}

/// The values alone of a sound document without circular targets, for orientations that adjust on their way: no
/// statistics, no advice, no search for what is wrong. It is read by its numbering and needs no names. Ends at steps shorter
/// than `negligible` standard errors. `None` if the document cannot be adjusted, its equations are singular, or nothing
/// converges.
pub(crate) fn values(
    project: &Project,
    numbering: &Numbering,
    max_iterations: usize,
    negligible: f64,
) -> Option<Project> {
    let ready = far_points::brought_back(std::borrow::Cow::Borrowed(project), numbering);
    let project = ready.as_ref();
    let mut session = Session::new(project, numbering, &RejectedObservations::nothing(project)).ok()?;
    session.start_at(&far_points::control_starts(project, numbering));
    let (termination, singular) = session.steps(ResidualPlace::Corrected, max_iterations, negligible, &mut |_| true);
    (!singular && termination != Termination::Diverged).then(|| solve::values::applied(&session))
}

/// Standard errors of the estimated parameters of every camera of a sound document without circular targets, read by its
/// numbering; of the first photo where each has an interior orientation of its own. `None` if nothing converges.
pub(crate) fn camera_sigmas(project: &Project, numbering: &Numbering) -> Option<Vec<BTreeMap<Parameter, f64>>> {
    let options = AdjustOptions {
        statistics: StatisticsChoice::Precision,
        residuals: ResidualPlace::Corrected,
        ..AdjustOptions::default()
    };
    let ready = far_points::brought_back(std::borrow::Cow::Borrowed(project), numbering);
    let project = ready.as_ref();
    let mut session = Session::new(project, numbering, &RejectedObservations::nothing(project)).ok()?;
    session.start_at(&far_points::control_starts(project, numbering));
    let log = &mut Log { iterations: Vec::new(), on_iteration: &mut |_| true };
    if session.iterate(&options, log).ok()? != Termination::Converged {
        return None;
    }
    let solution = session.finish(&options, true).ok()?;
    let mut sigmas = vec![BTreeMap::new(); project.cameras.len()];
    let blocks = session.network.interiors.iter().zip(Solved::new(&session, &options, &solution).cameras());
    for (block, adjusted) in blocks.rev() {
        sigmas[block.camera] = adjusted.sigma;
    }
    Some(sigmas)
}

/// Predicted precision of an adjustment of the project, with its present coordinates and a priori standard errors
/// that are right: the normal equations of [`adjust`] at the initial values, and the cofactors of their inverse times a variance
/// factor of 1. Image coordinates are not looked at further: those of a plan are projections.
///
/// # Errors
/// As [`adjust`].
pub fn predict(project: &Project) -> Result<Adjustment> {
    project.validate()?;
    predict_numbered(project, &Numbering::of(project))
}

/// [`predict`] of a sound document that is read by its numbering: its photos may be named alike, its observations not at all.
///
/// # Errors
/// As [`adjust`].
pub fn predict_numbered(project: &Project, numbering: &Numbering) -> Result<Adjustment> {
    let options = AdjustOptions { statistics: StatisticsChoice::Precision, ..AdjustOptions::default() };
    let mut session = Session::new(project, numbering, &RejectedObservations::nothing(project))?;
    session.robust = Some(RobustVariance { sigma0: 1.0, variance: 1.0 });
    let solution = session.finish(&options, false)?;
    let mut adjustment = Solved::new(&session, &options, &solution).adjustment();
    adjustment.advice = advice::advice(project, &session.network, &session.state, &adjustment);
    adjustment.options = options;
    Ok(adjustment)
}

/// Covariance of a camera's estimated parameters, in the order of its correlations, and of the mean turn and shift of its photos: see
/// `src/adjust/solve/session/calibration.rs`. The equations are those of the document at the adjustment's values, without the observations
/// that was not used in it; they are scaled to its standard errors.
///
/// # Errors
/// [`Error::Invalid`] if they do not give the adjustment's standard errors; as [`adjust`].
pub(crate) fn calibration(
    project: &Project,
    adjustment: &Adjustment,
    adjusted: &AdjustedCamera,
) -> Result<DMatrix<f64>> {
    let another = || Error::Invalid { reason: Reason::EquationsOfAnother, at: Place::camera(&adjusted.camera.id) };
    let mut applied = apply(project, adjustment);
    if applied.observations.len() != adjustment.observations.len() {
        return Err(another());
    }
    for (observation, row) in applied.observations.iter_mut().zip(&adjustment.observations) {
        observation.enabled = row.enabled;
    }
    applied.set_aside.clear();
    let options = AdjustOptions { statistics: StatisticsChoice::Precision, ..adjustment.options.clone() };
    inside::stepping::with_session(&applied, &options, |mut session| {
        session.adopt(adjustment);
        session.shift = eccentric::shifts(session.project, &session.network, &session.state);
        let own = |(k, _): &(usize, &problem::network::InteriorBlock)| {
            let block = &session.network.interiors[*k];
            let photo = block.photo.map(|p| session.project.photos[session.network.photos[p].index].id.as_str());
            session.project.cameras[block.camera].id == adjusted.camera.id && photo == adjusted.photo.as_deref()
        };
        let interior = session.network.interiors.iter().enumerate().find(own).map(|(k, _)| k).ok_or_else(another)?;
        let estimated = &session.network.interiors[interior].estimated;
        let sigmas: Option<Vec<f64>> = estimated.iter().map(|e| adjusted.sigma.get(&e.parameter).copied()).collect();
        let names = estimated.iter().map(|e| e.parameter.name());
        let sigmas = sigmas.filter(|_| names.eq(adjusted.correlation.names.iter().map(String::as_str)));
        let sigmas = sigmas.filter(|sigmas| !sigmas.is_empty()).ok_or_else(another)?;
        session.finish(&options, false)?;
        let cofactors = session.calibration(interior)?;
        let factors: Vec<f64> = sigmas.iter().enumerate().map(|(k, s)| s * s / cofactors[(k, k)]).collect();
        let factor = factors[0];
        let alike = |f: &f64| *f > 0.0 && (f / factor - 1.0).abs() < SAME_FACTOR;
        if factors.iter().all(alike) { Ok(cofactors * factor) } else { Err(another()) }
    })
}

/// The groups that [`Defect::NotTied`] of a prediction has by the names of their photos, by their places in the document.
pub fn groups_of(defect: &Defect, project: &Project, numbering: &Numbering) -> Option<Vec<Vec<usize>>> {
    let Defect::NotTied { groups } = defect else { return None };
    let (network, _) = Network::new(project, numbering, &RejectedObservations::nothing(project)).ok()?;
    // Ties of three points are ties of one as well: as many groups are the same groups.
    let mut numbered = [1, 3].into_iter().map(|shared| structure::groups(&network, shared));
    let numbered = numbered.find(|numbered| numbered.len() == groups.len())?;
    let places = |group: Vec<usize>| group.into_iter().map(|photo| network.photos[photo].index).collect();
    Some(numbered.into_iter().map(places).collect())
}

/// The project with the adjusted values as new initial values. What is given stays as given: control and check
/// coordinates, observed projection centres and observed parameters. What an orientation had set aside and the adjustment has taken back
/// is enabled.
pub fn apply(project: &Project, adjustment: &Adjustment) -> Project {
    let mut applied = project.clone();
    for adjusted in &adjustment.cameras {
        let Some(camera) = applied.cameras.iter_mut().find(|c| c.id == adjusted.camera.id) else { continue };
        let mut interior = adjusted.camera.interior;
        for parameter in camera.sigma.keys() {
            if let Some(given) = camera.interior.get(*parameter) {
                interior.set(*parameter, given);
            }
        }
        match &adjusted.photo {
            None => camera.interior = interior,
            Some(id) => applied.photos.iter_mut().filter(|p| p.id == *id).for_each(|p| p.interior = Some(interior)),
        }
    }
    let photos: HashMap<&str, _> = adjustment.photos.iter().map(|p| (p.id.as_str(), p)).collect();
    for photo in &mut applied.photos {
        if let Some(adjusted) = photos.get(photo.id.as_str()) {
            if photo.sigma_position.is_none() {
                photo.position = Some(adjusted.position);
            }
            photo.rotation = Some(adjusted.rotation);
        }
    }
    let points: HashMap<&str, _> = adjustment.points.iter().map(|p| (p.id.as_str(), p)).collect();
    for point in applied.points.iter_mut().filter(|p| p.role == Role::Tie) {
        if let Some(adjusted) = points.get(point.id.as_str()) {
            point.xyz = Some(adjusted.xyz);
        }
    }
    // What was set aside and has taken part all the same is set aside no more.
    let rows = applied.observations.iter_mut().zip(&adjustment.observations);
    let mut back = HashSet::new();
    for (observation, adjusted) in rows.filter(|(o, adjusted)| !o.enabled && adjusted.enabled) {
        observation.enabled = true;
        back.insert((adjusted.photo.as_str(), adjusted.point.as_str()));
    }
    applied.set_aside.retain(|aside| !back.contains(&(aside.photo.as_str(), aside.point.as_str())));
    applied
}
