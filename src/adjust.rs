//! Bundle adjustment: weighted least squares on image coordinates, control, distances and observed parameters.
//!
//! [`adjust`] numbers the document (`network`), chooses an order of the photos (`layout`), iterates (`iteration`) on
//! reduced normal equations (`normal`: points are eliminated in `eliminate`, kept in `eliminated`) factored in tiles
//! (`tiles`, `kernel`), brings the result into its datum (`datum`) and computes the statistics (`cofactor`, `ray_cofactor`, `result`).
//! Circular targets of known diameter are freed of their eccentricity (`eccentric`). Gross errors are searched in `search`, by
//! `snooping` or `robust` weights.

mod blocks;
mod cofactor;
mod datum;
mod doctor;
mod eccentric;
mod eliminate;
mod eliminated;
mod given;
mod gradient;
mod influence;
mod iteration;
mod kernel;
mod layout;
mod network;
mod normal;
mod parameters;
mod ray_cofactor;
mod result;
mod result_given;
mod robust;
mod rows;
mod search;
mod session;
mod snooping;
mod tiles;
mod transformation;
mod triple;
mod unmodelled;

use crate::adjustment::{AdjustOptions, Adjustment, Advice, Iteration, Termination};
use crate::error::Result;
use crate::project::{Project, Role};

use given::LeftOut;
use session::{Log, Session};

pub use unmodelled::estimate as unmodelled;

/// Adjusts the project; `on_iteration` sees every iteration and stops the work by returning false.
///
/// # Errors
/// Whatever [`Project::validate`] finds; [`crate::Error::Empty`] without observations;
/// [`crate::Error::MissingInitialValues`]; [`crate::Error::RankDefect`] when the network does not determine what is to be
/// estimated. An iteration that does not converge is a result.
pub fn adjust(
    project: &Project,
    options: &AdjustOptions,
    on_iteration: &mut dyn FnMut(&Iteration) -> bool,
) -> Result<Adjustment> {
    project.validate()?;
    let weighted = unmodelled::weighted(project, options.unmodelled)?;
    let sized = eccentric::sized(weighted, options.target_diameter)?;
    let project = sized.as_ref();
    let mut left_out = LeftOut::nothing(project);
    let mut log = Log { iterations: Vec::new(), on_iteration };
    let mut record = Vec::new();
    let mut settled = true;
    let mut session = Session::new(project, &left_out)?;
    let mut termination = session.iterate(options, &mut log)?;
    if options.snooping && termination == Termination::Converged {
        settled &= session.snoop(options, &mut log, &mut left_out, &mut record)?;
        if !left_out.is_empty() {
            session = session.without(&left_out)?;
            termination = session.iterate(options, &mut log)?;
        }
    }
    if let (Some(kind), Termination::Converged) = (options.robust, termination) {
        settled &= session.reweight(kind, options, &mut log, &mut record)?;
    }
    let solution = session.finish(options, termination == Termination::Converged)?;
    let mut adjustment = session.solved(options, &solution).adjustment();
    adjustment.options = options.clone();
    adjustment.termination = termination;
    adjustment.iterations = log.iterations;
    adjustment.advice = doctor::advice(project, &session.network, &session.state, &adjustment);
    if !settled {
        adjustment.advice.push(Advice::GrossErrorsUnsettled);
    }
    adjustment.gross_errors = record;
    adjustment.covariance = solution.covariance;
    Ok(adjustment)
}

/// The project with the adjusted values as new initial values. What is given stays as given: control and check
/// coordinates, observed projection centres and observed parameters.
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
    let photos: std::collections::HashMap<&str, _> = adjustment.photos.iter().map(|p| (p.id.as_str(), p)).collect();
    for photo in &mut applied.photos {
        if let Some(adjusted) = photos.get(photo.id.as_str()) {
            if photo.sigma_position.is_none() {
                photo.position = Some(adjusted.position);
            }
            photo.rotation = Some(adjusted.rotation);
        }
    }
    let points: std::collections::HashMap<&str, _> = adjustment.points.iter().map(|p| (p.id.as_str(), p)).collect();
    for point in applied.points.iter_mut().filter(|p| p.role == Role::Tie) {
        if let Some(adjusted) = points.get(point.id.as_str()) {
            point.xyz = Some(adjusted.xyz);
        }
    }
    applied
}
