//! Simulated gross errors, and the response of the tests and four estimators.

use serde::{Deserialize, Serialize};

use super::dense::{carried, cofactors, redundancy};
use sightline::adjust::{adjust, at_end};
use sightline::adjustment::{AdjustOptions, Adjustment, Robust, StatisticsChoice};
use sightline::error::Result;
use sightline::noise::Noise;
use sightline::project::Project;
use sightline::statistics::distribution::{critical_w, noncentrality};

/// An error to be put into an image coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Planting {
    /// Place in [`Project::observations`].
    pub observation: usize,
    /// 0: x, 1: y.
    pub axis: usize,
    /// Size in standard errors of the observation.
    pub size: f64,
}

/// Result of an estimator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// `least_squares`, `huber`, `tukey` or `snooping`.
    pub name: String,
    /// Sigma0; null without redundancy.
    pub sigma0: Option<f64>,
    /// Distance by which the observation's point moved from where least squares without the error put it.
    pub moved: Option<f64>,
    /// The same in the largest standard error of a coordinate of that point without the error.
    pub moved_in_sigma: Option<f64>,
    /// Root mean square of the movements of all other points.
    pub others: f64,
    /// Factor on the weight of the observation that the first error is in; 0 if it was rejected.
    pub weight: f64,
    /// Image observations with a factor below 1, or rejected.
    pub weakened: usize,
    /// Movement of every point.
    pub shifts: Vec<(String, [f64; 3])>,
}

/// A tested coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tested {
    /// Place in [`Project::observations`].
    pub observation: usize,
    /// 0: x, 1: y.
    pub axis: usize,
    /// w of least squares.
    pub w: f64,
    /// Redundancy number.
    pub r: f64,
    /// Minimal detectable bias over its standard error: noncentrality over √r.
    pub detectable: f64,
}

/// Planted errors and what became of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Planted {
    /// Photo and point of every observation of the document.
    pub names: Vec<[String; 2]>,
    /// w of all image coordinates, with the errors.
    pub tested: Vec<Tested>,
    /// The first error's coordinate without it.
    pub before: Option<Tested>,
    /// Limit of |w|.
    pub critical: f64,
    /// The noncentrality of the minimal detectable bias: the w expected there.
    pub noncentrality: f64,
    /// Estimators side by side.
    pub estimates: Vec<Estimate>,
    /// Probability that |w| of the first error's coordinate exceeds the limit, w ~ N(size √r, 1); null above [`super::LARGEST`] unknowns.
    pub power: Option<f64>,
    /// Share of simulated networks in which it did.
    pub detected: Option<f64>,
    /// Share in which it did and was the largest of all |w|: only then snooping rejects the right observation first.
    pub largest: Option<f64>,
    /// Number of simulated networks.
    pub draws: usize,
}

/// The binomial standard error of a share from 2000 draws is at most 1.1 %.
const DRAWS: usize = 2000;

/// Plants errors in image coordinates. The first one is the one that is examined.
///
/// # Errors
/// As [`adjust`], of least squares without the errors; an estimator that fails is left out.
pub fn plant(project: &Project, options: &AdjustOptions, errors: &[Planting]) -> Result<Planted> {
    let plain = AdjustOptions {
        statistics: StatisticsChoice::Full,
        snooping: false,
        robust: None,
        variance_components: None,
        covariance_of: Vec::new(),
        ..options.clone()
    };
    let without = adjust(project, &plain, &mut |_| true)?;
    let mut with = project.clone();
    for error in errors {
        if let Some(observation) = with.observations.get_mut(error.observation) {
            let sigma = observation.sigma.both()[error.axis.min(1)];
            let by = error.size * sigma;
            if error.axis == 0 { observation.u += by } else { observation.v += by }
        }
    }
    let first = errors.first().copied();
    let mut tested_with = Vec::new();
    let mut estimates = Vec::new();
    let robust =
        |robust| AdjustOptions { robust: Some(robust), statistics: StatisticsChoice::Precision, ..plain.clone() };
    let snooping = AdjustOptions { snooping: true, ..plain.clone() };
    let ways = [
        ("least_squares", plain.clone()),
        ("huber", robust(Robust::Huber)),
        ("tukey", robust(Robust::Tukey)),
        ("snooping", snooping),
    ];
    for (name, options) in ways {
        let Ok(found) = adjust(&with, &options, &mut |_| true) else { continue };
        if name == "least_squares" {
            tested_with = tested(&found);
        }
        estimates.push(estimate(name, project, first, &without, &found));
    }
    let before = first.and_then(|first| tested(&without).into_iter().find(|one| at(one, first)));
    let (power, detected, largest) = match (first, before) {
        (Some(first), Some(before)) => simulated(project, &plain, first, before)?,
        _ => (None, None, None),
    };
    Ok(Planted {
        names: project.observations.iter().map(|o| [o.photo.clone(), o.point.clone()]).collect(),
        tested: tested_with,
        before,
        critical: critical_w(),
        noncentrality: noncentrality(),
        estimates,
        power,
        detected,
        largest,
        draws: DRAWS,
    })
}

fn at(one: &Tested, error: Planting) -> bool {
    one.observation == error.observation && one.axis == error.axis
}

fn tested(adjustment: &Adjustment) -> Vec<Tested> {
    let of = |(observation, o): (usize, &sightline::adjustment::AdjustedObservation)| {
        let one = move |axis: usize, w: Option<f64>, r: Option<f64>| {
            let (w, r) = (w?, r?);
            (r > 0.0).then(|| Tested { observation, axis, w, r, detectable: noncentrality() / r.sqrt() })
        };
        if o.enabled { [one(0, o.wx, o.rx), one(1, o.wy, o.ry)] } else { [None, None] }
    };
    adjustment.observations.iter().enumerate().flat_map(of).flatten().collect()
}

fn estimate(
    name: &str,
    project: &Project,
    first: Option<Planting>,
    without: &Adjustment,
    found: &Adjustment,
) -> Estimate {
    let mut shifts = Vec::new();
    for point in &found.points {
        if let Some(then) = without.points.iter().find(|other| other.id == point.id) {
            shifts.push((point.id.clone(), std::array::from_fn(|k| point.xyz[k] - then.xyz[k])));
        }
    }
    let length = |shift: &[f64; 3]| shift.iter().map(|x| x * x).sum::<f64>().sqrt();
    let own = first.and_then(|first| project.observations.get(first.observation)).map(|o| &o.point);
    let moved = shifts.iter().find(|(id, _)| Some(id) == own).map(|(_, shift)| length(shift));
    let sigma = without.points.iter().find(|point| Some(&point.id) == own).and_then(|point| point.sigma);
    let sigma = sigma.map(|sigma| sigma.into_iter().fold(0.0, f64::max)).filter(|sigma| *sigma > 0.0);
    let others: Vec<f64> = shifts.iter().filter(|(id, _)| Some(id) != own).map(|(_, shift)| length(shift)).collect();
    let factor = |k: usize| {
        let was = project.observations.get(k).is_some_and(|o| o.enabled);
        let o = &found.observations[k];
        if was && !o.enabled { 0.0 } else { o.weight.unwrap_or(1.0) }
    };
    Estimate {
        name: name.to_owned(),
        sigma0: found.sigma0,
        moved,
        moved_in_sigma: moved.and_then(|moved| Some(moved / sigma?)),
        others: (others.iter().map(|x| x * x).sum::<f64>() / others.len().max(1) as f64).sqrt(),
        weight: first
            .filter(|first| first.observation < found.observations.len())
            .map_or(1.0, |f| factor(f.observation)),
        weakened: (0..found.observations.len()).filter(|k| factor(*k) < 1.0).count(),
        shifts,
    }
}

/// Predicted power, and how often simulated networks detect the error. v = -R e with R = I - A Q Aᵀ P, w_i = (R e)_i / (σ_i √r_i).
fn simulated(
    project: &Project,
    options: &AdjustOptions,
    first: Planting,
    before: Tested,
) -> Result<(Option<f64>, Option<f64>, Option<f64>)> {
    let limit = critical_w();
    let system = at_end(project, options)?.linear_system()?;
    let Some(q) = cofactors(&system) else { return Ok((None, None, None)) };
    let shift = first.size * before.r.sqrt();
    let power = tail(limit - shift) + tail(limit + shift);
    let of = &project.observations[first.observation];
    let axis = ["x", "y"][first.axis.min(1)];
    let image = |row: &sightline::adjust::Equation| row.given.is_none();
    let planted = system.observations.iter().position(|row| {
        image(row)
            && row.photo.as_ref() == Some(&of.photo)
            && row.point.as_ref() == Some(&of.point)
            && row.axis.as_deref() == Some(axis)
    });
    let Some(planted) = planted else { return Ok((Some(power), None, None)) };
    // A photo coordinate that points up grows where the pixel coordinate falls: the sign of the error does not matter for |w|.
    let rows = system.observations.len();
    let (carried, r): (Vec<Vec<f64>>, Vec<f64>) = (0..rows)
        .map(|row| {
            let carried = carried(&system, &q, row);
            let r = redundancy(&system, &carried, row);
            (carried, r)
        })
        .unzip();
    let sigma: Vec<f64> = system.observations.iter().map(|row| row.sigma).collect();
    let mut noise = Noise::new(1, 1);
    let (mut detected, mut largest) = (0, 0);
    for _ in 0..DRAWS {
        let mut e: Vec<f64> = sigma.iter().map(|sigma| sigma * noise.normal()).collect();
        e[planted] += first.size * sigma[planted];
        let moved = system.a.transposed_times(&system.p, &e);
        let w = |row: usize| {
            let adjusted: f64 = carried[row].iter().zip(&moved).map(|(a, b)| a * b).sum();
            ((e[row] - adjusted) / (sigma[row] * r[row].sqrt())).abs()
        };
        let own = w(planted);
        if own > limit {
            detected += 1;
            // Rows without redundancy are not tested.
            let others = (0..rows).filter(|row| *row != planted && image(&system.observations[*row]) && r[*row] > 1e-9);
            largest += usize::from(others.map(w).all(|other| other < own));
        }
    }
    let share = |count: usize| Some(count as f64 / DRAWS as f64);
    Ok((Some(power), share(detected), share(largest)))
}

/// 1 - Φ(x) by its continued fraction or series, to 1e-10 (Abramowitz and Stegun 1964, 26.2.14 and 26.2.11).
pub(super) fn tail(x: f64) -> f64 {
    if x < 0.0 {
        return 1.0 - tail(-x);
    }
    let density = (-0.5 * x * x).exp() / std::f64::consts::TAU.sqrt();
    if x < 3.0 {
        let (mut term, mut sum) = (x, x);
        for k in 1..80 {
            term *= x * x / f64::from(2 * k + 1);
            sum += term;
        }
        return 0.5 - density * sum;
    }
    let fraction = (1..=80).rev().fold(0.0, |below, k| f64::from(k) / (x + below));
    density / (x + fraction)
}
