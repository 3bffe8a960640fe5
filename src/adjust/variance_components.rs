//! Variance components: factors on the assumed standard errors of each group, estimated from the residuals.
//!
//! The observations fall into groups with a common factor f on their variances. With the weighted residuals e and redundancy
//! numbers r of the group, f ← f·Σe²/Σr (W. Förstner 1979), repeated with an adjustment each until all quotients are 1,
//! which is the solution of Helmert's equations (F. R. Helmert 1924; K.-R. Koch 1999, 3.6). Then sigma0 is 1 by construction, and a
//! global test would test nothing: there is none.
//!
//! The result takes the components as exact. A group's own is only as good as its redundancy: what hangs on it follows Student's
//! distribution and not the normal one, so that groups with less than [`LEAST_REDUNDANCY`] keep their a priori standard errors.
//!
//! An image group may have a part that is not modelled, of the same size u for all its coordinates: variances f·σ² + u². Where the
//! group's σ differ, both follow from e² by Fisher's scoring with weights Σr/(2·(fσ² + u²)²); where they are alike the two
//! are one, and u takes what σ leaves.
//!
//! Standard errors: σ(f) = f·√(2/Σr), or the inverse of Fisher's information of both.

use crate::adjust::problem::additional::{self, AdditionalObservation};
use crate::adjust::solve::session::{Log, Session};
use crate::adjustment::{
    AdjustOptions, NotEstimated, ObservationGroup, StatisticsChoice, Termination, VarianceComponent, VarianceComponents,
};
use crate::error::Result;

/// Rounds of adjustment and estimation.
const MOST_ROUNDS: usize = 60;
/// Quotients closer to 1 are settled.
const SETTLED: f64 = 1e-4;
/// Groups with less redundancy are not estimated. Of 400 random networks under control whose components are all estimated, 1.8 % of the
/// coordinates are more than 3.29 standard errors off where control has a redundancy below 5, instead of 0.1 %, and one network's
/// standard errors are 4.4 times too small; with this limit 0.2 % of all are, and 2.0 times.
const LEAST_REDUNDANCY: f64 = 10.0;
/// Standard errors of a group that differ by less than this factor do not separate what is not modelled.
const DIFFERENT: f64 = 1.3;
/// Residuals of exact observations are rounding: their variance has an end.
const LEAST_FACTOR: f64 = 1e-12;
/// Maximum factor by which one round changes a variance.
const LARGEST_CHANGE: f64 = 100.0;

struct VarianceGroup {
    what: ObservationGroup,
    rays: Vec<usize>,
    given: Vec<AdditionalObservation>,
    /// Variance factor so far.
    factor: f64,
    /// Variance of what is not modelled so far, px².
    unmodelled: Option<f64>,
    errors: [f64; 2],
    redundancy: f64,
    /// Once for all: a group whose redundancy crosses the limit from round to round would come to no end.
    not_estimated: Option<NotEstimated>,
}

/// Result of one round for a group.
struct Round {
    factor: f64,
    unmodelled: Option<f64>,
    errors: [f64; 2],
}

fn groups(session: &Session<'_>, choice: &VarianceComponents) -> Vec<VarianceGroup> {
    let network = &session.network;
    let mut groups: Vec<VarianceGroup> = Vec::new();
    let mut place = |what: ObservationGroup| match groups.iter().position(|group| group.what == what) {
        Some(at) => at,
        None => {
            let unmodelled = match what {
                ObservationGroup::Image { .. } => choice.unmodelled.then_some(0.0),
                _ => None,
            };
            let (rays, given) = (Vec::new(), Vec::new());
            groups.push(VarianceGroup {
                what,
                rays,
                given,
                factor: 1.0,
                unmodelled,
                errors: [0.0; 2],
                redundancy: 0.0,
                not_estimated: None,
            });
            groups.len() - 1
        }
    };
    let mut of_rays = Vec::new();
    for ray in &network.rays {
        let camera = network.interiors[network.photos[ray.photo].interior].camera;
        let camera = choice.per_camera.then(|| session.project.cameras[camera].id.clone());
        of_rays.push(place(ObservationGroup::Image { camera }));
    }
    let mut of_given = Vec::new();
    for observed in additional::all(network) {
        of_given.push((
            observed,
            place(match observed {
                AdditionalObservation::Control(..) => ObservationGroup::Control,
                AdditionalObservation::Position(..) => ObservationGroup::Position,
                AdditionalObservation::Distance(..) => ObservationGroup::Distance,
                AdditionalObservation::Parameter(..) => ObservationGroup::Parameter,
            }),
        ));
    }
    of_rays.into_iter().enumerate().for_each(|(ray, at)| groups[at].rays.push(ray));
    of_given.into_iter().for_each(|(observed, at)| groups[at].given.push(observed));
    groups
}

/// Estimates the components from a converged state and leaves the session adjusted with them. The flag is whether they
/// settled; where they did not, the last ones are in force.
///
/// # Errors
/// As [`Session::iterate`].
pub fn estimate(
    session: &mut Session<'_>,
    choice: &VarianceComponents,
    options: &AdjustOptions,
    log: &mut Log<'_>,
) -> Result<(Vec<VarianceComponent>, bool)> {
    let full = AdjustOptions { statistics: StatisticsChoice::Full, covariance_of: Vec::new(), ..options.clone() };
    let mut groups = groups(session, choice);
    let assumed: Vec<[f64; 2]> = session.network.rays.iter().map(|ray| ray.sqrt_weight).collect();
    let sigma_px: Vec<[f64; 2]> =
        session.network.rays.iter().map(|ray| session.project.observations[ray.row].sigma.both()).collect();
    let mut settled = false;
    for _ in 0..MOST_ROUNDS {
        let solution = session.finish(&full, false)?;
        let Some(cofactors) = &solution.cofactors else { break };
        let residuals = session.residuals(options)?;
        let mut change = 0.0_f64;
        for group in &mut groups {
            // Residual squared and redundancy number of every coordinate, and its assumed standard error in pixels.
            let of_ray = |ray: &usize| {
                let ray = *ray;
                [0, 1].map(|s| (residuals[ray][s].powi(2), 1.0 - cofactors.rays[ray][s], sigma_px[ray][s]))
            };
            let mut list: Vec<(f64, f64, f64)> = group.rays.iter().flat_map(of_ray).collect();
            list.extend(group.given.iter().map(|observed| {
                let e = observed.residual(&session.network, &session.state) * observed.sqrt_weight(&session.network);
                (e * e, 1.0 - observed.cofactor(&session.network, cofactors), 1.0)
            }));
            list.iter_mut().for_each(|(_, r, _)| *r = r.clamp(0.0, 1.0));
            group.redundancy = list.iter().map(|(_, r, _)| r).sum();
            let squares: f64 = list.iter().map(|(e, _, _)| e).sum();
            if group.not_estimated.is_some() {
                continue;
            }
            if group.redundancy < LEAST_REDUNDANCY {
                group.not_estimated = Some(NotEstimated::LittleRedundancy { needed: LEAST_REDUNDANCY });
            } else if squares <= 0.0 {
                group.not_estimated = Some(NotEstimated::NoResiduals);
            }
            let found = match (group.not_estimated, group.unmodelled) {
                // Back to what was assumed.
                (Some(_), unmodelled) => Round { factor: 1.0, unmodelled: unmodelled.map(|_| 0.0), errors: [0.0; 2] },
                (None, None) => single(group, squares),
                (None, Some(unmodelled)) => both(group, unmodelled, &list),
            };
            let variance = |factor: f64, unmodelled: Option<f64>, sigma: f64| {
                factor * sigma * sigma + unmodelled.unwrap_or_default()
            };
            for (_, _, sigma) in list.iter().step_by(7) {
                let quotient =
                    variance(found.factor, found.unmodelled, *sigma) / variance(group.factor, group.unmodelled, *sigma);
                change = change.max((quotient.sqrt() - 1.0).abs());
            }
            let quotient = found.factor / group.factor;
            (group.factor, group.unmodelled, group.errors) = (found.factor, found.unmodelled, found.errors);
            for ray in &group.rays {
                for s in 0..2 {
                    let sigma = sigma_px[*ray][s];
                    let share = variance(group.factor, group.unmodelled, sigma) / (sigma * sigma);
                    session.network.rays[*ray].sqrt_weight[s] = assumed[*ray][s] / share.sqrt();
                }
            }
            for observed in &group.given {
                let own = observed.sqrt_weight(&session.network);
                observed.set_sqrt_weight(&mut session.network, own / quotient.sqrt());
            }
        }
        if session.iterate(options, log)? != Termination::Converged {
            break;
        }
        if change < SETTLED {
            settled = true;
            break;
        }
    }
    let component = |group: VarianceGroup| {
        let told = group.not_estimated.is_none();
        let squares: f64 = group.rays.iter().flat_map(|ray| sigma_px[*ray]).map(|sigma| sigma * sigma).sum();
        let root = |variance: f64, error: f64| {
            let sigma = variance.max(0.0).sqrt();
            (sigma, if sigma > 0.0 { error / (2.0 * sigma) } else { error.sqrt() })
        };
        let (factor, factor_error) = root(group.factor, group.errors[0]);
        let unmodelled = group.unmodelled.map(|u| root(u, group.errors[1]));
        VarianceComponent {
            observations: 2 * group.rays.len() + group.given.len(),
            group: group.what,
            redundancy: group.redundancy,
            factor,
            factor_sigma: told.then_some(factor_error),
            unmodelled: unmodelled.map(|(u, _)| u),
            unmodelled_sigma: unmodelled.filter(|_| told).map(|(_, error)| error),
            a_priori_px: (!group.rays.is_empty()).then(|| (squares / (2 * group.rays.len()) as f64).sqrt()),
            not_estimated: group.not_estimated,
        }
    };
    Ok((groups.into_iter().map(component).collect(), settled))
}

fn single(group: &VarianceGroup, squares: f64) -> Round {
    let quotient = (squares / group.redundancy).clamp(1.0 / LARGEST_CHANGE, LARGEST_CHANGE);
    let factor = (group.factor * quotient).max(LEAST_FACTOR);
    Round { factor, unmodelled: None, errors: [factor * (2.0 / group.redundancy).sqrt(), 0.0] }
}

/// One step of Fisher's scoring for f and u², both kept from becoming negative; `list` has e², r and σ.
fn both(group: &VarianceGroup, unmodelled: f64, list: &[(f64, f64, f64)]) -> Round {
    let sizes = || list.iter().map(|(_, _, sigma)| *sigma);
    let (least, most) = (sizes().fold(f64::INFINITY, f64::min), sizes().fold(0.0, f64::max));
    if most < DIFFERENT * least {
        // One size for all: what σ leaves is not modelled; where it leaves nothing the factor takes it.
        let squares: f64 = list.iter().map(|(e, _, _)| e).sum();
        let mean = list.iter().map(|(_, _, sigma)| sigma * sigma).sum::<f64>() / list.len() as f64;
        let quotient = (squares / group.redundancy).clamp(1.0 / LARGEST_CHANGE, LARGEST_CHANGE);
        let total = quotient * (group.factor * mean + unmodelled);
        let error = total * (2.0 / group.redundancy).sqrt();
        return if total >= mean {
            Round { factor: 1.0, unmodelled: Some(total - mean), errors: [0.0, error] }
        } else {
            Round { factor: total / mean, unmodelled: Some(0.0), errors: [error / mean, 0.0] }
        };
    }
    // Information and right-hand side: e² has the expectation r in units of the present variance.
    let (mut n, mut b) = ([0.0; 3], [0.0; 2]);
    for (e, r, sigma) in list {
        let present = group.factor * sigma * sigma + unmodelled;
        let (df, du) = (sigma * sigma / present, 1.0 / present);
        n[0] += 0.5 * r * df * df;
        n[1] += 0.5 * r * df * du;
        n[2] += 0.5 * r * du * du;
        b[0] += 0.5 * (e - r) * df;
        b[1] += 0.5 * (e - r) * du;
    }
    let determinant = n[0] * n[2] - n[1] * n[1];
    let solved = determinant > 1e-12 * n[0] * n[2];
    let step = if solved {
        [(n[2] * b[0] - n[1] * b[1]) / determinant, (n[0] * b[1] - n[1] * b[0]) / determinant]
    } else {
        [b[0] / n[0], 0.0]
    };
    let (mut factor, mut u) = (group.factor + step[0], unmodelled + step[1]);
    let mut errors =
        if solved { [(n[2] / determinant).sqrt(), (n[0] / determinant).sqrt()] } else { [n[0].recip().sqrt(), 0.0] };
    if u < 0.0 {
        (factor, u, errors) = (group.factor + b[0] / n[0], 0.0, [n[0].recip().sqrt(), errors[1]]);
    }
    factor = factor.clamp(group.factor / LARGEST_CHANGE, group.factor * LARGEST_CHANGE);
    Round { factor, unmodelled: Some(u), errors }
}
