//! The adjustment step by step: the state after each iteration, forwards and back.
//!
//! After k steps the values are those of [`adjust`](crate::adjust::adjust) stopped after its k-th iteration, bit by bit: both run the same
//! iteration. Robust estimation, the search for gross errors and variance components follow after it and are not stepped through.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::adjust::equations::right_hand_side;
use crate::adjust::problem::left_out::RejectedObservations;
use crate::adjust::problem::numbering::Numbering;
use crate::adjust::problem::state::State;
use crate::adjust::problem::{eccentric, far_points, unmodelled};
use crate::adjust::solve::session::{Log, Session, unsound};
use crate::adjust::solve::values::applied;
use crate::adjust::{adjust, outside};
use crate::adjustment::{AdjustOptions, Adjustment, Iteration, Termination};
use crate::error::Result;
use crate::project::Project;
use crate::rotation;

use super::linear_system::{Columns, LinearSystem, RowNames, of_session};
use super::normal_equations::{NormalEquations, numbers_of_system, of_system};

/// State after a step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StepState {
    /// Steps taken so far.
    pub step: usize,
    /// The document with the present values as initial values.
    pub project: Project,
    /// The iteration that led here: its sigma0 before the step, length and damping of the step; `None` at the initial values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub iteration: Option<Iteration>,
    /// vᵀPv at the present values.
    pub weighted_squares: f64,
    /// √(vᵀPv / redundancy); `None` without redundancy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sigma0: Option<f64>,
    /// Values of the unknowns, in the order and units of [`LinearSystem::unknowns`](super::linear_system::LinearSystem::unknowns); rotations are 0.
    pub values: Vec<f64>,
    /// Change of every unknown by the last step; rotations as vectors about the camera axes.
    pub corrections: Vec<f64>,
    /// Residuals computed minus observed, in the order and units of [`LinearSystem::observations`](super::linear_system::LinearSystem::observations).
    pub residuals: Vec<f64>,
    /// How the iteration ended, after its last step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub termination: Option<Termination>,
}

/// An adjustment under way.
#[derive(Clone, Debug)]
pub struct Adjuster {
    project: Project,
    options: AdjustOptions,
    reached: Vec<Reached>,
    at: usize,
}

/// A state with all its values; the document of [`StepState`] keeps given values as given.
#[derive(Clone, Debug)]
struct Reached {
    told: StepState,
    values: State,
    shift: Vec<[f64; 2]>,
}

/// Begins an adjustment at the document's values.
///
/// # Errors
/// As [`adjust`].
pub fn start_adjustment(project: &Project, options: &AdjustOptions) -> Result<Adjuster> {
    let (first, ()) = after(project, options, 0, None, nothing)?;
    Ok(Adjuster { project: project.clone(), options: options.clone(), reached: vec![first], at: 0 })
}

/// An adjustment at the end of its iteration, without the states on the way.
///
/// # Errors
/// As [`adjust`].
pub fn at_end(project: &Project, options: &AdjustOptions) -> Result<Adjuster> {
    let (last, ()) = after(project, options, usize::MAX, None, nothing)?;
    Ok(Adjuster { project: project.clone(), options: options.clone(), reached: vec![last], at: 0 })
}

impl Adjuster {
    /// Takes one step; nothing changes after the last one.
    ///
    /// # Errors
    /// As [`adjust`].
    pub fn step(&mut self) -> Result<&StepState> {
        if self.at + 1 == self.reached.len() && self.state().termination.is_none() {
            let (next, ()) = after(&self.project, &self.options, self.at + 1, Some(self.state()), nothing)?;
            self.reached.push(next);
        }
        self.at = (self.at + 1).min(self.reached.len() - 1);
        Ok(self.state())
    }

    /// Takes one step as [`Self::step`] does and gives the equations after it without what is the same after every step:
    /// [`Self::numbers`] in the time of the step.
    ///
    /// # Errors
    /// As [`adjust`].
    pub fn step_with_numbers(&mut self) -> Result<(LinearSystem, NormalEquations)> {
        if self.at + 1 < self.reached.len() || self.state().termination.is_some() {
            self.step()?;
            return self.numbers();
        }
        let (next, numbers) = after(&self.project, &self.options, self.at + 1, Some(self.state()), with_normal)?;
        self.reached.push(next);
        self.at += 1;
        Ok(numbers)
    }

    /// Goes back by one step; stays at the initial values.
    pub fn back(&mut self) -> &StepState {
        self.at = self.at.saturating_sub(1);
        self.state()
    }

    /// The present state.
    pub fn state(&self) -> &StepState {
        &self.reached[self.at].told
    }

    /// The observation equations at the present values. [`linearise`](super::linear_system::linearise) of the state's document differs
    /// where given values take part: there the document has the given value of a control point, here its present one counts.
    ///
    /// # Errors
    /// As [`adjust`].
    pub fn linear_system(&self) -> Result<LinearSystem> {
        self.here(|session| of_session(session, &self.options, RowNames::Given))
    }

    /// The normal equations at the present values.
    ///
    /// # Errors
    /// As [`adjust`].
    pub fn normal_equations(&self) -> Result<NormalEquations> {
        self.here(|session| of_system(session, &self.options, &of_session(session, &self.options, RowNames::Omitted)?))
    }

    /// Both, for the time of one.
    ///
    /// # Errors
    /// As [`adjust`].
    pub fn equations(&self) -> Result<(LinearSystem, NormalEquations)> {
        self.here(|session| {
            let system = of_session(session, &self.options, RowNames::Given)?;
            let normal = of_system(session, &self.options, &system)?;
            Ok((system, normal))
        })
    }

    /// Both at the present values without what is the same after every step: names and units are empty, the order of elimination is empty,
    /// and fill-in is 0.
    ///
    /// # Errors
    /// As [`adjust`].
    pub fn numbers(&self) -> Result<(LinearSystem, NormalEquations)> {
        self.here(|session| with_normal(session, of_session(session, &self.options, RowNames::Omitted)?))
    }

    fn here<T>(&self, work: impl FnOnce(&Session<'_>) -> Result<T>) -> Result<T> {
        let reached = &self.reached[self.at];
        with_session(&self.project, &self.options, |mut session| {
            session.state = reached.values.clone();
            session.shift.clone_from(&reached.shift);
            work(&session)
        })
    }

    /// The whole adjustment.
    ///
    /// # Errors
    /// As [`adjust`].
    pub fn finish(&self) -> Result<Adjustment> {
        adjust(&self.project, &self.options, &mut |_| true)
    }
}

/// The session with which [`adjust`] begins.
pub(in crate::adjust) fn with_session<T>(
    project: &Project,
    options: &AdjustOptions,
    work: impl FnOnce(Session<'_>) -> Result<T>,
) -> Result<T> {
    project.validate()?;
    let weighted = unmodelled::weighted(project, options.unmodelled)?;
    let sized = eccentric::sized(weighted, options.target_diameter)?;
    let numbering = Numbering::of(project);
    let ready = far_points::brought_back(sized, &numbering);
    let ready = outside::retest::with_what_fits(ready, &numbering, options, &mut Vec::new());
    outside::control::enough(ready.as_ref(), &numbering)?;
    let mut session = Session::new(ready.as_ref(), &numbering, &RejectedObservations::nothing(ready.as_ref()))?;
    session.start_at(&far_points::control_starts(ready.as_ref(), &numbering));
    work(session)
}

/// Nothing but the state is asked for.
fn nothing(_: &Session<'_>, _: LinearSystem) -> Result<()> {
    Ok(())
}

fn with_normal(session: &Session<'_>, system: LinearSystem) -> Result<(LinearSystem, NormalEquations)> {
    let normal = numbers_of_system(session, &system, RowNames::Omitted)?;
    Ok((system, normal))
}

/// The state after so many steps from the document's values, and what else is made of the observation equations there, which have no names.
fn after<T>(
    project: &Project,
    options: &AdjustOptions,
    steps: usize,
    before: Option<&StepState>,
    work: impl FnOnce(&Session<'_>, LinearSystem) -> Result<T>,
) -> Result<(Reached, T)> {
    with_session(project, options, |mut session| {
        let (mut iteration, mut termination, mut taken) = (None, None, 0);
        if steps == 0 {
            session.shift = eccentric::shifts(session.project, &session.network, &session.state);
        } else {
            let mut each = |one: &Iteration| {
                taken += 1;
                iteration = Some(one.clone());
                taken < steps
            };
            let mut log = Log { iterations: Vec::new(), on_iteration: &mut each };
            let ended = session.iterate(options, &mut log)?;
            termination = Some(ended).filter(|ended| *ended != Termination::Stopped);
        }
        let (weighted_squares, _) = right_hand_side::cost(session.context(options.residuals)).ok_or_else(unsound)?;
        let system = of_session(&session, options, RowNames::Omitted)?;
        let values: Vec<f64> = system.unknowns.iter().map(|unknown| unknown.value).collect();
        let corrections =
            before.map_or_else(|| vec![0.0; values.len()], |before| corrections(&session, &values, before));
        let redundancy = session.redundancy;
        let told = StepState {
            // At values that are the solution already a step takes no iteration.
            step: steps.min(taken.max(1)),
            project: applied(&session),
            iteration,
            weighted_squares,
            sigma0: (redundancy > 0).then(|| (weighted_squares / redundancy as f64).sqrt()),
            values,
            corrections,
            residuals: system.l.iter().map(|l| -l).collect(),
            termination,
        };
        let made = work(&session, system)?;
        Ok((Reached { told, values: session.state.clone(), shift: session.shift.clone() }, made))
    })
}

fn corrections(session: &Session<'_>, values: &[f64], before: &StepState) -> Vec<f64> {
    let mut corrections: Vec<f64> = values.iter().zip(&before.values).map(|(now, then)| now - then).collect();
    let columns = Columns::new(&session.network);
    for (k, (block, pose)) in session.network.photos.iter().zip(&session.state.poses).enumerate() {
        let then = rotation::object_to_camera(before.project.photos[block.index].rotation.unwrap_or_default());
        let turn = turn_vector(&(pose.matrix() * then.transpose()));
        let first = columns.photo(k).start;
        corrections[first..first + 3].copy_from_slice(turn.as_slice());
    }
    corrections
}

/// δ of R = exp([δ]×), from the skew part sin|δ| δ/|δ|: from the trace alone small turns would lose half their digits, and where rounding
/// makes it larger than 3 there is none.
fn turn_vector(r: &Matrix3<f64>) -> Vector3<f64> {
    let skew = 0.5 * Vector3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]);
    let sine = skew.norm();
    if sine == 0.0 { skew } else { skew * (sine.atan2(0.5 * (r.trace() - 1.0)) / sine) }
}
