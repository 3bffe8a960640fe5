//! Given coordinates of control points compared with the photos.
//!
//! Where everything but a control point's own coordinates g sees it: from its adjusted coordinates x with cofactors C, in which the
//! coordinates took part with the weights P, N = C⁻¹ - P, and x' = N⁻¹ (C⁻¹ x - P g) with the cofactors N⁻¹. The difference
//! d = g - x' has the covariance N⁻¹ + P⁻¹ and is compared by dᵀ (N⁻¹ + P⁻¹)⁻¹ d, χ² of three degrees of freedom. One wrong point
//! spoils the comparison of all others: the point with the largest difference is freed of its coordinates, and the others are
//! compared again.

use nalgebra::{Matrix3, Vector3};

use crate::adjust::problem::left_out::RejectedObservations;
use crate::adjust::problem::numbering::Numbering;
use crate::adjust::solve::session::{Log, Session};
use crate::adjust::solve::values::applied;
use crate::adjustment::{AdjustOptions, StatisticsChoice, Termination};
use crate::camera::ideal_from_pixel;
use crate::error::{Error, Result};
use crate::initial::Pose;
use crate::initial::intersection::{Ray, intersect};
use crate::initial::robust::quantile;
use crate::project::{DatumKind, Project, Role, SetAsideReason};
use crate::statistics::distribution::chi_squared_quantile;

use super::retest::unit;

/// Probability that a network without an error names a control point.
const ALPHA: f64 = 1e-3;
/// Minimum number of agreeing control points: with four, one wrong point can be identified; three fit any error.
const FEWEST: usize = 4;
/// Points freed of their coordinates at most, each an adjustment.
const MOST_FREED: usize = 12;
/// Standard error, in those of the point as the photos see it, of given coordinates that the document holds: small enough to hold
/// them, large enough for N to keep its digits.
const HELD: f64 = 0.02;
/// Median of the square root of χ² of three degrees of freedom.
const MEDIAN: f64 = 1.538;
/// Pixels, and standard errors of a measurement, within which the rays of a point meet.
const MEETING_PX: f64 = 1.0;
const MEETING: f64 = 10.0;

/// Given coordinates of a control point compared with those determined by all other observations.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlDiscrepancy {
    /// Place of the point in the document.
    pub point: usize,
    /// Given minus seen, in the document's unit.
    pub difference: [f64; 3],
    /// Its size in standard errors.
    pub ratio: f64,
    /// Whether it is one that no right coordinates have.
    pub wrong: bool,
}

/// Result of the comparison of all control points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// Points that were not used with their coordinates, and those found wrong.
    pub compared: Vec<ControlDiscrepancy>,
    /// Pairs that fit when their coordinates are exchanged.
    pub exchanged: Vec<[usize; 2]>,
}

/// A control point as determined by all other observations, in the document's unit.
struct ControlPointEstimate {
    point: usize,
    xyz: Vector3<f64>,
    covariance: Matrix3<f64>,
    given: Vector3<f64>,
    variance: Vector3<f64>,
    /// Whether its own coordinates took part.
    held: bool,
}

impl ControlPointEstimate {
    /// Size of the difference of some given coordinates, of variances `variance`, in standard errors.
    fn ratio(&self, given: &Vector3<f64>, variance: &Vector3<f64>) -> f64 {
        let d = given - self.xyz;
        let both = self.covariance + Matrix3::from_diagonal(variance);
        both.cholesky().map_or(0.0, |c| d.dot(&c.solve(&d)).max(0.0).sqrt())
    }

    fn own(&self) -> f64 {
        self.ratio(&self.given, &self.variance)
    }
}

/// Control points of which nothing but what was set aside as disagreeing is measured, and the others that take part.
fn sides(project: &Project, numbering: &Numbering) -> (Vec<usize>, Vec<usize>) {
    let mut enabled = vec![false; project.points.len()];
    for (o, &(photo, point)) in project.observations.iter().zip(&numbering.observations) {
        enabled[point] |= o.enabled && project.photos[photo].enabled;
    }
    let disagreeing: std::collections::HashSet<&str> =
        project.set_aside.iter().filter(|s| s.reason == SetAsideReason::Disagrees).map(|s| s.point.as_str()).collect();
    let control = (0..project.points.len()).filter(|&k| {
        let point = &project.points[k];
        point.role == Role::Control && point.xyz.is_some()
    });
    let (used, others): (Vec<usize>, Vec<usize>) = control.partition(|&k| enabled[k]);
    let aside = others.into_iter().filter(|&k| disagreeing.contains(project.points[k].id.as_str()));
    (aside.collect(), used)
}

/// Refuses a control datum if too few control points agree to identify the wrong ones.
///
/// # Errors
/// [`Error::ControlDisagrees`] where control points were set aside and fewer than four, or less than half, are left; where none is
/// left, whatever set them aside.
pub fn enough(project: &Project, numbering: &Numbering) -> Result<()> {
    if project.datum.kind != DatumKind::Control {
        return Ok(());
    }
    let (mut aside, used) = sides(project, numbering);
    if used.is_empty() {
        let set_aside: std::collections::HashSet<&str> = project.set_aside.iter().map(|s| s.point.as_str()).collect();
        let given = |k: &usize| {
            let point = &project.points[*k];
            point.role == Role::Control && point.xyz.is_some() && set_aside.contains(point.id.as_str())
        };
        aside = (0..project.points.len()).filter(given).collect();
    }
    if aside.is_empty() || used.len() >= FEWEST && used.len() >= aside.len() {
        return Ok(());
    }
    let names = |points: Vec<usize>| points.into_iter().map(|k| project.points[k].id.clone()).collect();
    Err(Error::ControlDisagrees { agreeing: names(used), disagreeing: names(aside) })
}

/// Compares the control points of a document that has adjusted values, under the control datum. `None` if too few of them take
/// part, or where it cannot be adjusted.
pub fn compare(project: &Project, numbering: &Numbering, options: &AdjustOptions) -> Option<Findings> {
    let (mut aside, used) = sides(project, numbering);
    // A point whose measurements were mostly set aside is judged by all of them.
    let (most_aside, used): (Vec<usize>, Vec<usize>) = used.into_iter().partition(|&k| mostly_aside(project, k));
    aside.extend(&most_aside);
    if used.len() < FEWEST {
        return None;
    }
    let options =
        AdjustOptions { statistics: StatisticsChoice::Precision, covariance_of: Vec::new(), ..options.clone() };
    let mut work = project.clone();
    for &k in &used {
        let held = HELD * footprint(project, numbering, k)?;
        let sigma = project.points[k].sigma.unwrap_or_default();
        work.points[k].sigma = Some(sigma.map(|s| s.filter(|s| *s > 0.0).or(Some(held))));
    }
    let mut free = Vec::new();
    for &k in &aside {
        let Some((rows, xyz)) = meeting(project, numbering, k) else { continue };
        let own = numbering.observations.iter().enumerate().filter(|(_, entry)| entry.1 == k);
        own.for_each(|(row, _)| work.observations[row].enabled = rows.contains(&row));
        work.points[k].role = Role::Check;
        work.points[k].xyz = Some(xyz);
        free.push(k);
    }
    let limit = chi_squared_quantile(1.0 - ALPHA / (used.len() + aside.len()) as f64, 3).sqrt();
    let mut freed = 0;
    let seen = loop {
        let (seen, adjusted) = seen(project, &work, numbering, &options)?;
        let held = seen.iter().filter(|s| s.held);
        let left = held.clone().count();
        let worst = held.max_by(|a, b| a.own().total_cmp(&b.own()));
        let worst = worst.filter(|s| s.own() > limit && left > 3 && freed < MOST_FREED.min(used.len() / 2));
        let Some(k) = worst.map(|s| s.point) else { break seen };
        let place = worst.map(|s| s.xyz.into());
        work = adjusted;
        work.points[k].role = Role::Check;
        work.points[k].xyz = place;
        free.push(k);
        freed += 1;
    };
    // Control that is worse than stated as a whole has no wrong points.
    let ratios: Vec<f64> = seen.iter().filter(|s| s.held).map(ControlPointEstimate::own).collect();
    let limit = limit * (quantile(&ratios, 0.5) / MEDIAN).max(1.0);
    let compared = seen.iter().filter(|s| free.contains(&s.point)).map(|s| ControlDiscrepancy {
        point: s.point,
        difference: (s.given - s.xyz).into(),
        ratio: s.own(),
        wrong: s.own() > limit,
    });
    let compared: Vec<ControlDiscrepancy> =
        compared.filter(|c| c.ratio.is_finite() && (c.wrong || aside.contains(&c.point))).collect();
    let wrong: Vec<&ControlPointEstimate> =
        seen.iter().filter(|s| compared.iter().any(|c| c.wrong && c.point == s.point)).collect();
    let fits = |a: &ControlPointEstimate, b: &ControlPointEstimate| a.ratio(&b.given, &b.variance) <= limit;
    let mut exchanged = Vec::new();
    for (n, a) in wrong.iter().enumerate() {
        exchanged.extend(wrong[..n].iter().filter(|b| fits(a, b) && fits(b, a)).map(|b| [b.point, a.point]));
    }
    Some(Findings { compared, exchanged })
}

/// Every control point of `work` as everything else sees it, and the document with the adjusted values.
fn seen(
    project: &Project,
    work: &Project,
    numbering: &Numbering,
    options: &AdjustOptions,
) -> Option<(Vec<ControlPointEstimate>, Project)> {
    let mut session = Session::new(work, numbering, &RejectedObservations::nothing(work)).ok()?;
    let mut log = Log { iterations: Vec::new(), on_iteration: &mut |_| true };
    if session.iterate(options, &mut log).ok()? != Termination::Converged {
        return None;
    }
    let cofactors = session.finish(options, false).ok()?.cofactors?;
    let variance = unit(&session, options).powi(2);
    let frame = session.network.frame;
    let mut all = Vec::new();
    for (n, block) in session.network.points.iter().enumerate() {
        let point = &project.points[block.index];
        let (Role::Control, Some(given)) = (point.role, point.xyz) else { continue };
        let x = Vector3::from(session.state.points[n]);
        let held = block.prior.iter().all(|(_, weight)| *weight > 0.0);
        let (place, covariance) = if held {
            let Some(all) = cofactors.points[n].try_inverse() else { continue };
            let own = Matrix3::from_diagonal(&Vector3::from_fn(|a, _| block.prior[a].1.powi(2)));
            let g = Vector3::from_fn(|a, _| block.prior[a].0);
            // Relative to the adjusted place, so that nothing large is subtracted.
            let Some(others) = (all - own).cholesky() else { continue };
            (x - others.solve(&(own * (g - x))), others.inverse())
        } else {
            (x, cofactors.points[n])
        };
        let sigma = point.sigma.unwrap_or_default();
        let seen = ControlPointEstimate {
            point: block.index,
            xyz: frame.outside(place.into()).into(),
            covariance: covariance * (variance * frame.scale.powi(2)),
            given: given.into(),
            variance: Vector3::from_fn(|a, _| sigma[a].filter(|s| *s > 0.0).map_or(0.0, |s| s * s)),
            held,
        };
        if seen.xyz.iter().chain(seen.covariance.iter()).all(|x| x.is_finite()) {
            all.push(seen);
        }
    }
    Some((all, applied(&session)))
}

/// Whether no more measurements of a point take part than were set aside as disagreeing.
fn mostly_aside(project: &Project, point: usize) -> bool {
    let id = &project.points[point].id;
    let aside = project.set_aside.iter().filter(|s| s.point == *id && s.reason == SetAsideReason::Disagrees).count();
    aside > 0 && project.observations.iter().filter(|o| o.point == *id && o.enabled).count() <= aside
}

/// What a standard error of a measurement is at a point, in the document's unit; the smallest of its photos.
fn footprint(project: &Project, numbering: &Numbering, point: usize) -> Option<f64> {
    let xyz = Vector3::from(project.points[point].xyz?);
    let rows =
        project.observations.iter().zip(&numbering.observations).filter(|(o, entry)| o.enabled && entry.1 == point);
    let each = rows.filter_map(|(o, &(photo, _))| {
        let pose = Pose::of_photo(&project.photos[photo])?;
        let camera = project.cameras[numbering.cameras[photo]].of_photo(&project.photos[photo]);
        let [u, v] = [o.u, o.v];
        let (a, b) = (ideal_from_pixel(&camera, [u, v])?, ideal_from_pixel(&camera, [u + 1.0, v])?);
        let per_px = (b[0] - a[0]).hypot(b[1] - a[1]);
        Some((xyz - pose.centre).norm() * per_px * o.sigma.both()[0].max(o.sigma.both()[1]))
    });
    let smallest = each.fold(f64::INFINITY, f64::min);
    (smallest.is_finite() && smallest > 0.0).then_some(smallest)
}

/// Rows of a point, enabled or set aside, that meet, the worst dropped one after the other, and where.
fn meeting(project: &Project, numbering: &Numbering, point: usize) -> Option<(Vec<usize>, [f64; 3])> {
    let id = &project.points[point].id;
    let aside: std::collections::HashSet<&str> =
        project.set_aside.iter().filter(|s| s.point == *id).map(|s| s.photo.as_str()).collect();
    let mut rays: Vec<(usize, f64, Ray)> = Vec::new();
    for (row, (o, &(photo, of))) in project.observations.iter().zip(&numbering.observations).enumerate() {
        let offered = o.enabled || aside.contains(o.photo.as_str());
        if of != point || !project.photos[photo].enabled || !offered {
            continue;
        }
        let camera = project.cameras[numbering.cameras[photo]].of_photo(&project.photos[photo]);
        let Some(pose) = Pose::of_photo(&project.photos[photo]) else { continue };
        let place = ideal_from_pixel(&camera, [o.u, o.v]).zip(ideal_from_pixel(&camera, [o.u + 1.0, o.v]));
        let Some((image, beside)) = place else { continue };
        let px = (beside[0] - image[0]).hypot(beside[1] - image[1]);
        let [su, sv] = o.sigma.both();
        rays.push((row, px * MEETING_PX.max(MEETING * su.max(sv)), Ray { pose, image, weight: px.powi(-2) }));
    }
    while rays.len() >= 2 {
        let only: Vec<Ray> = rays.iter().map(|(_, _, ray)| *ray).collect();
        let found = intersect(&only).ok()?.point;
        let excess = |(_, limit, ray): &(usize, f64, Ray)| ray.pose.misfit(&found, ray.image) / limit;
        let worst = (0..rays.len()).max_by(|&a, &b| excess(&rays[a]).total_cmp(&excess(&rays[b])))?;
        if excess(&rays[worst]) <= 1.0 {
            let finite = found.iter().all(|x| x.is_finite());
            return finite.then(|| (rays.iter().map(|ray| ray.0).collect(), found.into()));
        }
        rays.remove(worst);
    }
    None
}
