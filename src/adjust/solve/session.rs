//! The session that solves one network: iteration and cofactors; the gross error search is in [`crate::adjust::gross_errors::search`].

mod calibration;
mod rig;

use nalgebra::{DMatrix, Vector3};

use crate::adjust::datum::free::{self, FreeDatum, SIMILARITY, at_point};
use crate::adjust::diagnosis::{rank_defect, slips, structure};
use crate::adjust::equations::back_substitution::Full;
use crate::adjust::equations::context::{Context, Weighting};
use crate::adjust::equations::normal::ReducedNormalEquations;
use crate::adjust::equations::ordering::{Layout, layout};
use crate::adjust::equations::right_hand_side;
use crate::adjust::problem::eccentric;
use crate::adjust::problem::left_out::RejectedObservations;
use crate::adjust::problem::network::Network;
use crate::adjust::problem::numbering::Numbering;
use crate::adjust::problem::state::State;
use crate::adjust::problem::step::Step;
use crate::adjust::statistics::cofactors::{Cofactors, cofactors};
use crate::adjustment::{AdjustOptions, Covariance, Iteration, ResidualPlace, StatisticsChoice, Termination};
use crate::error::{Error, Place, Reason, Result, Thing};
use crate::project::{Distance, Project};

pub use rig::RigStatistics;

use super::iteration::{IterationResult, IterationSetup, NEGLIGIBLE, iterate, rounding};

/// The network at the present values; not a method, since the normal equations are borrowed beside it.
macro_rules! context {
    ($session:ident, $place:expr) => {
        Context {
            network: &$session.network,
            layout: &$session.layout,
            state: &$session.state,
            weighting: Weighting { place: $place, robust: &$session.weights, shift: &$session.shift },
        }
    };
}

/// Rounds of eccentricity corrections, and their change in standard errors of a measurement that no longer matters.
const MOST_CORRECTIONS: usize = 4;
const CORRECTED: f64 = 1e-3;
/// A step of this part of the standard errors changes no digit of the statistics.
const POLISHED: f64 = 1e-8;
/// Steps with one factor on the way there.
const MOST_POLISHING: usize = 4;

/// If vᵀPv increases by more than this share, the step is not accepted as a final refinement.
const RISING: f64 = 1e-6;

/// Progress to the caller: the iterations so far and whether to go on.
pub struct Log<'a> {
    /// Iterations so far.
    pub iterations: Vec<Iteration>,
    /// Sees every iteration; false stops.
    pub on_iteration: &'a mut dyn FnMut(&Iteration) -> bool,
}

/// The network with its values.
pub struct Session<'a> {
    /// The document.
    pub project: &'a Project,
    /// Meaning of its rows.
    pub numbering: &'a Numbering,
    /// The network.
    pub network: Network,
    layout: Layout,
    initial: State,
    /// Present values.
    pub state: State,
    /// The datum of a network without control.
    pub datum: Option<FreeDatum>,
    /// n - u + d.
    pub redundancy: usize,
    normal: ReducedNormalEquations,
    /// Square roots of robust factors, per ray; empty for none.
    pub weights: Vec<[f64; 2]>,
    /// Square roots of robust factors of the other observations, contained in the network's weights; empty for none.
    pub additional_factors: Vec<f64>,
    /// Eccentricity corrections, per ray; empty for none.
    pub shift: Vec<[f64; 2]>,
    /// The variance factor after robust estimation.
    pub robust: Option<RobustVariance>,
}

/// Variances after robust estimation, where weighted squares over redundancy mean neither.
#[derive(Clone, Copy, Debug)]
pub struct RobustVariance {
    /// Consistent estimate of the standard deviation of unit weight.
    pub sigma0: f64,
    /// Factor from the cofactors of the equations with weights to covariances.
    pub variance: f64,
}

/// State at the end.
pub struct Solution {
    /// vᵀPv.
    pub cost: f64,
    /// With statistics.
    pub cofactors: Option<Cofactors>,
    /// Covariance of the points asked for.
    pub covariance: Option<Covariance>,
    /// Covariances and tests of the relative poses of the rig, in the network's order of its cameras.
    pub rig: Vec<RigStatistics>,
    /// Standard errors of the check distances, in the document's order of these.
    pub check_lengths: Vec<Option<f64>>,
}

impl Solution {
    /// Without statistics.
    fn of_cost(cost: f64) -> Self {
        Self { cost, cofactors: None, covariance: None, rig: Vec::new(), check_lengths: Vec::new() }
    }
}

/// Where the equations cannot be set up.
pub fn unsound() -> Error {
    Error::Invalid { reason: Reason::NoImage, at: Place::default() }
}

impl<'a> Session<'a> {
    /// Numbers the document without the observations in `left_out`.
    ///
    /// # Errors
    /// As [`super::adjust`].
    pub fn new(project: &'a Project, numbering: &'a Numbering, left_out: &RejectedObservations) -> Result<Self> {
        let (mut network, state) = Network::new(project, numbering, left_out)?;
        let layout = layout(&mut network);
        structure::structure(project, &network, &state)?;
        let datum = free::free_datum(&network, &state)?;
        let constraints = datum.as_ref().map_or(0, |d| d.defect);
        let (n, u) = (network.observations_count() + constraints, network.unknowns());
        let normal = ReducedNormalEquations::new(&network, &layout);
        let mut session = Self {
            project,
            numbering,
            network,
            layout,
            initial: state.clone(),
            state,
            datum,
            redundancy: 0,
            normal,
            weights: Vec::new(),
            additional_factors: Vec::new(),
            shift: Vec::new(),
            robust: None,
        };
        match n.checked_sub(u) {
            Some(redundancy) => session.redundancy = redundancy,
            None => return Err(session.rank_defect()),
        }
        Ok(session)
    }

    /// Starts points of the document, which are given with standard errors, elsewhere.
    pub fn start_at(&mut self, starts: &[(usize, [f64; 3])]) {
        for (index, xyz) in starts {
            let Some(k) = self.network.points.iter().position(|p| p.index == *index) else { continue };
            let inside = self.network.frame.inside(*xyz);
            for a in (0..3).filter(|a| !self.network.points[k].fixed[*a]) {
                self.state.points[k][a] = inside[a];
            }
        }
    }

    /// The network at the present values.
    pub fn context(&self, place: ResidualPlace) -> Context<'_> {
        context!(self, place)
    }

    /// The step that the factored equations still ask for at the present values: what [`Self::finish`] leaves as negligible. `None` if
    /// a projection does not exist.
    pub fn remaining_step(&mut self, place: ResidualPlace) -> Option<Step> {
        let sound = self.normal.renew(context!(self, place));
        sound.then(|| self.normal.solve(&self.network, &self.layout).step)
    }

    /// The equations that [`Self::finish`] has factored, with their layout.
    pub fn factored(&self) -> (&ReducedNormalEquations, &Layout) {
        (&self.normal, &self.layout)
    }

    fn pins(&self) -> Vec<usize> {
        self.datum.as_ref().map_or_else(Vec::new, |d| free::pins(&self.layout, &self.state, d.defect))
    }

    /// Iterates to the end; a rank defect is an error.
    ///
    /// # Errors
    /// [`Error::RankDefect`].
    pub fn iterate(&mut self, options: &AdjustOptions, log: &mut Log<'_>) -> Result<Termination> {
        self.shift = eccentric::shifts(self.project, &self.network, &self.state);
        for _ in 0..MOST_CORRECTIONS {
            let termination = self.iterate_held(options, log)?;
            let shift = eccentric::shifts(self.project, &self.network, &self.state);
            let settled = eccentric::difference(&self.network, &shift, &self.shift) <= CORRECTED;
            if settled || termination != Termination::Converged {
                return Ok(termination);
            }
            self.shift = shift;
        }
        self.iterate_held(options, log)
    }

    /// The iteration with its eccentricity corrections held.
    fn iterate_held(&mut self, options: &AdjustOptions, log: &mut Log<'_>) -> Result<Termination> {
        let mut each = |iteration: Iteration| {
            let going = (log.on_iteration)(&iteration);
            log.iterations.push(iteration);
            going
        };
        let (termination, singular) = self.steps(options.residuals, options.max_iterations, NEGLIGIBLE, &mut each);
        if singular && termination != Termination::Stopped { Err(self.rank_defect()) } else { Ok(termination) }
    }

    /// Iterates to steps shorter than `negligible` standard errors; the second value is whether the equations stayed
    /// singular.
    pub fn steps(
        &mut self,
        place: ResidualPlace,
        max_iterations: usize,
        negligible: f64,
        each: &mut dyn FnMut(Iteration) -> bool,
    ) -> (Termination, bool) {
        let pins = self.pins();
        let setting = IterationSetup {
            context: context!(self, place),
            pins: &pins,
            redundancy: self.redundancy,
            max_iterations,
            negligible,
        };
        let IterationResult { state, termination, singular } = iterate(&setting, &mut self.normal, each);
        self.state = state;
        self.state.orthonormalise();
        if !singular.is_empty() {
            return (termination, true);
        }
        if let Some(datum) = &self.datum {
            datum.align(&mut self.state, &self.initial);
        }
        (termination, false)
    }

    /// A new session without the observations in `left_out`, from this one's values.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn without(&self, left_out: &RejectedObservations) -> Result<Self> {
        let mut session = Self::new(self.project, self.numbering, left_out)?;
        session.state.adopt(&session.network, &self.state, &self.network);
        Ok(session)
    }

    /// Weighted squares and cofactors at the present values, which a converged iteration has polished by a last step.
    ///
    /// # Errors
    /// [`Error::RankDefect`]; [`Error::Invalid`] if a point has no image.
    pub fn finish(&mut self, options: &AdjustOptions, polish: bool) -> Result<Solution> {
        let pins = self.pins();
        let (mut last, mut refused) = (None, None);
        if options.statistics == StatisticsChoice::None {
            let (cost, _) = right_hand_side::cost(context!(self, options.residuals)).ok_or_else(unsound)?;
            return Ok(Solution::of_cost(cost));
        }
        // The equations are factored for the statistics anyway: further steps with that factor, until the unknowns keep
        // all their digits.
        for _ in 0..4 {
            if !self.normal.build(context!(self, options.residuals), 0.0, &pins) {
                return Err(unsound());
            }
            if !self.normal.factor().is_empty() {
                return Err(self.rank_defect());
            }
            if !polish {
                break;
            }
            let cost = self.normal.cost;
            let (polished, near) = self.polished(options.residuals)?;
            if near {
                last = polished;
                break;
            }
            match polished {
                Some(polished) => self.state = polished,
                None => {
                    refused = Some(cost);
                    break;
                }
            }
        }
        let cost = refused.unwrap_or(self.normal.cost);
        let full = options.statistics == StatisticsChoice::Full;
        let cofactors = cofactors(&self.normal, context!(self, options.residuals), self.datum.as_ref(), full);
        let cofactors = cofactors.ok_or_else(unsound)?;
        if !cofactors.are_sound() {
            // What has come to rest there is determined by nothing; what ended on its way has no standard errors to state.
            return if polish { Err(self.rank_defect()) } else { Ok(Solution::of_cost(cost)) };
        }
        let cofactors = Some(cofactors);
        let variance = self.variance(cost);
        let covariance = if options.covariance_of.is_empty() {
            None
        } else {
            Some(self.covariance_of(&options.covariance_of, variance)?)
        };
        let check_lengths = self.check_lengths(variance);
        let rig = self.rig_statistics(cost)?;
        if let Some(last) = last {
            self.state = last;
        }
        Ok(Solution { cost, cofactors, covariance, rig, check_lengths })
    }

    /// The state after a few steps with the present factor, the last of them negligible, and whether the first was already,
    /// so that the factor serves for the cofactors. `None` if the steps lead nowhere: of unknowns that are hardly determined they
    /// are rounding, and may lead far off.
    fn polished(&mut self, place: ResidualPlace) -> Result<(Option<State>, bool)> {
        let limit = POLISHED * POLISHED * self.normal.cost / self.redundancy.max(1) as f64;
        let most = self.normal.cost * (1.0 + RISING) + rounding(&self.network);
        let mut state = self.state.clone();
        for step in 0..MOST_POLISHING {
            let solution = self.normal.solve(&self.network, &self.layout);
            let mut next = state.stepped(&self.network, &solution.step);
            next.orthonormalise();
            if let Some(datum) = &self.datum {
                datum.align(&mut next, &self.initial);
            }
            if !next.is_sound() {
                return Ok((None, false));
            }
            state = next;
            if solution.decrement <= limit {
                return Ok((Some(state), step == 0));
            }
            if !self.normal.renew(context!(self, place).at(&state)) || self.normal.cost > most {
                return Ok((None, false));
            }
        }
        Ok((Some(state), false))
    }

    /// Factor from cofactors to covariances: σ0², or 1 where nothing determines it.
    fn variance(&self, cost: f64) -> f64 {
        match self.robust {
            Some(robust) => robust.variance,
            None if self.redundancy > 0 => cost / self.redundancy as f64,
            None => 1.0,
        }
    }

    /// Covariance of functions of points, by their derivatives, with all points, in the network's order of points; of weighted
    /// squares `cost`. The equations are the errors of [`Self::finish`] factored: Q' f = S Q Sᵀ f, a solution for each function.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the datum's points have come together.
    pub fn carried(&self, functions: &[Vec<(usize, Vector3<f64>)>], cost: f64) -> Result<Vec<Vec<Vector3<f64>>>> {
        let constraint = self.constraint()?;
        let vectors = functions.iter().map(|function| {
            let mut e = Full::zeros(&self.network, &self.layout);
            for (point, by) in function {
                for axis in 0..3 {
                    self.add_constrained(&mut e, constraint.as_ref(), (*point, axis), by[axis]);
                }
            }
            e
        });
        let mut vectors: Vec<Full> = vectors.collect();
        self.normal.solve_all(&self.network, &self.layout, &mut vectors);
        let factor = self.variance(cost) * self.network.frame.scale.powi(2);
        let constraint = constraint.as_ref();
        let with = |x: &Full| {
            // What a unit of each datum parameter takes back, once for all points.
            let taken: Option<[f64; SIMILARITY]> = constraint.map(|(datum, d)| {
                std::array::from_fn(|j| {
                    let carriers = datum.carriers.iter().enumerate().filter(|_| j < datum.defect);
                    carriers.map(|(k, &(carrier, axis))| d[(k, j)] * x.at_point(&self.layout, carrier, axis)).sum()
                })
            });
            let at = |point: usize| {
                Vector3::from_fn(|axis, _| {
                    if self.network.points[point].fixed[axis] {
                        return 0.0;
                    }
                    let g = at_point(&self.state.points[point])[axis];
                    let back = taken.map_or(0.0, |t| (0..SIMILARITY).map(|j| t[j] * g[j]).sum());
                    factor * (x.at_point(&self.layout, point, axis) - back)
                })
            };
            (0..self.network.points.len()).map(at).collect()
        };
        Ok(vectors.iter().map(with).collect())
    }

    /// The free datum with the rows of its constraint, inverted for the S-transformation.
    pub fn constraint(&self) -> Result<Option<(&FreeDatum, DMatrix<f64>)>> {
        let Some(datum) = &self.datum else { return Ok(None) };
        let inverse = datum.inverse_of_constrained(&self.state).ok_or_else(unsound)?;
        Ok(Some((datum, datum.constraint_rows(&self.state) * inverse.transpose())))
    }

    /// Adds `factor` Sᵀe for a coordinate of a point.
    fn add_constrained(
        &self,
        e: &mut Full,
        constraint: Option<&(&FreeDatum, DMatrix<f64>)>,
        (point, axis): (usize, usize),
        factor: f64,
    ) {
        if !self.network.points[point].fixed[axis] {
            e.add_at_point(&self.layout, point, axis, factor);
        }
        self.subtract_datum(e, constraint, &at_point(&self.state.points[point])[axis], factor);
    }

    /// Subtracts `factor` D(DᵀG)⁻ᵀg of a quantity with the datum's directions g: what is left of it is Sᵀe.
    pub fn subtract_datum(
        &self,
        e: &mut Full,
        constraint: Option<&(&FreeDatum, DMatrix<f64>)>,
        g: &[f64; SIMILARITY],
        factor: f64,
    ) {
        let Some((datum, d)) = constraint else { return };
        for (k, &(carrier, axis)) in datum.carriers.iter().enumerate() {
            let product: f64 = (0..datum.defect).map(|j| d[(k, j)] * g[j]).sum();
            e.add_at_point(&self.layout, carrier, axis, -factor * product);
        }
    }

    /// Standard errors of the lengths that are compared only: σ² = dᵀ (C_aa + C_bb - C_ab - C_ba) d with the direction d from a to b.
    fn check_lengths(&self, variance: f64) -> Vec<Option<f64>> {
        let place = |id: &str| self.network.points.iter().position(|p| self.project.points[p.index].id == id);
        let one = |distance: &Distance| {
            let ends = [place(&distance.from)?, place(&distance.to)?].map(|k| self.state.points[k]);
            let d: [f64; 3] = std::array::from_fn(|a| ends[1][a] - ends[0][a]);
            let length = d[0].hypot(d[1]).hypot(d[2]);
            let matrix = self.covariance_of(&[distance.from.clone(), distance.to.clone()], variance).ok()?.matrix;
            let along = |k: usize| d[k % 3] / length * if k < 3 { -1.0 } else { 1.0 };
            let sum: f64 =
                (0..6).flat_map(|i| (0..6).map(move |j| (i, j))).map(|(i, j)| along(i) * matrix[i][j] * along(j)).sum();
            Some(sum.max(0.0).sqrt()).filter(|sigma| sigma.is_finite())
        };
        self.project.distances.iter().filter(|d| d.check).map(one).collect()
    }

    /// Full covariance of chosen points: Q' e = S Q Sᵀ e for every axis e, S the datum's S-transformation.
    fn covariance_of(&self, ids: &[String], variance: f64) -> Result<Covariance> {
        let places = ids.iter().map(|id| {
            let at = self.network.points.iter().position(|p| self.project.points[p.index].id == *id);
            let missing = || Error::Unknown { kind: Thing::Point, name: id.clone(), at: Place::field("covariance_of") };
            at.ok_or_else(missing)
        });
        let places: Vec<usize> = places.collect::<Result<_>>()?;
        let axes: Vec<(usize, usize)> = places.iter().flat_map(|p| (0..3).map(move |a| (*p, a))).collect();
        let direction = |(point, axis): (usize, usize)| at_point(&self.state.points[point])[axis];
        let constraint = self.constraint()?;
        let mut vectors: Vec<Full> = Vec::with_capacity(axes.len());
        for &place in &axes {
            let mut e = Full::zeros(&self.network, &self.layout);
            self.add_constrained(&mut e, constraint.as_ref(), place, 1.0);
            vectors.push(e);
        }
        self.normal.solve_all(&self.network, &self.layout, &mut vectors);
        let factor = variance * self.network.frame.scale.powi(2);
        let value = |column: usize, (point, axis): (usize, usize)| {
            let x = &vectors[column];
            let mut value = x.at_point(&self.layout, point, axis);
            if let Some((datum, d)) = &constraint {
                let g = direction((point, axis));
                for (k, &(carrier, carrier_axis)) in datum.carriers.iter().enumerate() {
                    let product: f64 = (0..datum.defect).map(|j| d[(k, j)] * g[j]).sum();
                    value -= product * x.at_point(&self.layout, carrier, carrier_axis);
                }
            }
            if self.network.points[point].fixed[axis] { 0.0 } else { value * factor }
        };
        let matrix = DMatrix::from_fn(axes.len(), axes.len(), |i, j| value(j, axes[i]));
        let symmetric = (&matrix + matrix.transpose()) * 0.5;
        let rows = symmetric.row_iter().map(|row| row.iter().copied().collect()).collect();
        Ok(Covariance { points: ids.to_vec(), matrix: rows })
    }

    fn rank_defect(&mut self) -> Error {
        if let Some(error) = slips::slip(self.project, &self.network, &self.initial) {
            return error;
        }
        let pins = self.pins();
        let context = context!(self, ResidualPlace::Corrected);
        rank_defect::rank_defect(self.project, context, &mut self.normal, &pins)
    }
}
