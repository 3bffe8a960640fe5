//! Comparison of two adjustments of one object: movements of points, and their size in standard errors.
//!
//! With x₁, σ₁ of the earlier adjustment and x₂, σ₂ of the later one, every coordinate and every parameter has
//!
//! ```text
//! d = x₂ - x₁        ratio = max over the axes of |d| / max(σ₁, σ₂)
//! ```
//!
//! where nothing else is known. Where the equations of both projects can be set up again, the covariance of d is computed from the
//! union of their observations, shared ones included (`src/comparison/shared.rs`, [`CovarianceOf::Union`]), and a point is tested as a vector:
//!
//! ```text
//! T = dᵀ·C⁺·d        ratio = √T · w / √χ²ᵣ(α)        r = rank(C)
//! ```
//!
//! with the limit w of a single test at its level α, so that a ratio is beyond w exactly where T is beyond the limit of χ² with r degrees
//! of freedom at that level. Where the equations cannot be set up (after robust estimation, for very large networks, for photos that
//! were measured again) and both have observations and share none ([`Comparison::independent`]) the variances add up, C = s²·R·C₁·Rᵀ + C₂.
//! Otherwise max(σ₁, σ₂) is a bound: where one result was found from part of the other's observations, the variance of d is the difference
//! of the two variances (J. A. Hausman 1978), so that a ratio is rather too small than too large.
//!
//! Coordinates of two networks can be set beside each other only in one system. Under control that is the system of the control
//! points, as long as three of them kept their coordinates. Otherwise it hangs on the initial values and on which points take part:
//! then the earlier network is first laid upon the later one, by the similarity of those common points that agree with each other
//! ([`similarity::fit_robust`]), without a scale where both networks have one of their own. What such a network did as a whole is not
//! seen, and standard errors differ with the datum; [`Alignment`] says which it was.
//!
//! Movements are relative to the points that did not move. Where, besides the three that any similarity brings together, fewer than half of the common
//! points agree within [`AGREEING`] times the limit, nothing stayed: other names, a mirror image, another length of the same bar. Then no coordinate is compared ([`Alignment::Unlike`]).

mod shared;

use std::collections::{BTreeMap, BTreeSet, HashMap};

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::adjust::inside::influence::AdjustedQuantity;
use crate::adjustment::{AdjustedCamera, AdjustedPoint, Adjustment, PhotoUnit};
use crate::initial::PrincipalAxes;
use crate::initial::similarity::{self, Similarity};
use crate::project::{DatumKind, Parameter, Photo, Point, Project, Role};
use crate::statistics::fisher::Fisher;

use shared::{ComparedQuantities, Covariances, SystemTransformation, covariances, same_photo};

/// A point agrees with its earlier self where its ratio is below so many times the limit of a single test. Standard errors of two
/// sittings are too small by two or three where both leave the same out; a majority beyond that has no part that stayed, and what a
/// similarity says of it (a scale of 0.24 for a mirror image) is not a movement.
const AGREEING: f64 = 3.0;
/// Without standard errors: where it moved by less than this part of the object's extent.
const AGREEING_SHARE: f64 = 0.01;

/// Control points that must have kept their coordinates for the system to be the same.
const SAME_SYSTEM: usize = 3;

/// In which system the two were set beside each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Alignment {
    /// Both are in the system of the same control points.
    Same,
    /// Each is in a system of its own: the earlier one was laid upon the later one.
    Fitted {
        /// Common points from which it was estimated.
        points: usize,
        /// Its scale; `None` if both networks have their own, which is compared then.
        scale: Option<f64>,
    },
    /// Too few points are common, or they lie on a line: no coordinate is compared.
    Apart {
        /// How many are common.
        common: usize,
    },
    /// No similarity lays one upon the other so that half of the common points, beyond the three that any brings together, agree within
    /// their standard errors: no coordinate is compared.
    Unlike {
        /// How many are common.
        common: usize,
        /// How many of them agree under the best that was found.
        agreeing: usize,
        /// Median of their differences over their standard errors; `None` without standard errors.
        ratio: Option<f64>,
        /// Ratio of lengths, later over earlier, of the similarity that fits best with a scale of its own; told where it makes enough
        /// points agree though both networks have a scale.
        scale: Option<f64>,
        /// Whether the mirror image of the earlier network makes enough points agree.
        mirrored: bool,
    },
    /// Their lengths are in different units: no coordinate is compared.
    Units {
        /// Of the earlier.
        before: String,
        /// Of the later.
        after: String,
    },
}

/// Where the standard errors of the differences come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum CovarianceOf {
    /// Computed from the observations of both results, shared ones included.
    Union,
    /// The sum of both: the results share no observation.
    Sum,
    /// The larger of both, which is a bound.
    #[default]
    Larger,
}

/// How far a point or a projection centre moved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moved {
    /// Identifier of the point or of the photo.
    pub id: String,
    /// Later minus earlier, in the later system and in the project's unit.
    pub difference: [f64; 3],
    /// Standard error per axis, see [`Comparison::covariance`]. `None` if unknown.
    pub sigma: Option<[f64; 3]>,
    /// Largest |difference| over its standard error; where the covariance is known that of the vector test, on the same limit. `None`
    /// without standard errors, or where every one is 0.
    pub ratio: Option<f64>,
    /// dᵀC⁺d where the covariance is known, χ² with rank(C) degrees of freedom where the point has not moved; `None` otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub statistic: Option<f64>,
}

impl Moved {
    /// Length of the movement.
    pub fn length(&self) -> f64 {
        Vector3::from(self.difference).norm()
    }
}

/// How far a camera's parameter changed, in photo units or pixels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParameterChange {
    /// Camera identifier.
    pub camera: String,
    /// Photo identifier, for cameras with an interior orientation per photo.
    pub photo: Option<String>,
    /// Which.
    pub parameter: Parameter,
    /// The earlier value.
    pub before: f64,
    /// The later value.
    pub after: f64,
    /// Standard error, see [`Comparison::covariance`]. `None` if held in both.
    pub sigma: Option<f64>,
    /// |after - before| over its standard error.
    pub ratio: Option<f64>,
}

/// Differences between a later and an earlier adjustment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// The system of the differences.
    pub alignment: Alignment,
    /// Points that both have, in the later one's order.
    pub points: Vec<Moved>,
    /// Projection centres that both have.
    pub photos: Vec<Moved>,
    /// Parameters of the interior orientations that both have, where at least one of the two estimated them or they changed.
    pub parameters: Vec<ParameterChange>,
    /// Cameras that cannot be compared: another model, or another unit of their photo coordinates.
    pub unlike_cameras: Vec<String>,
    /// Points that only the earlier has.
    pub gone: Vec<String>,
    /// Points that only the later has.
    pub new: Vec<String>,
    /// Root mean square of the lengths by which the points moved; `None` without common points.
    pub rms: Option<f64>,
    /// Ratios above this are reported: the critical value of the later adjustment's tests.
    pub limit: f64,
    /// Points whose ratio is beyond it.
    pub beyond: usize,
    /// Standard deviations of unit weight, earlier and later.
    pub sigma0: [Option<f64>; 2],
    /// Redundancies, earlier and later.
    pub redundancy: [usize; 2],
    /// Whether both have observations and share none: no photo, weighted control coordinate or distance.
    #[serde(default)]
    pub independent: bool,
    /// Where the standard errors come from.
    #[serde(default)]
    pub covariance: CovarianceOf,
}

/// Compares two adjustments, each with the project it was made from.
///
/// Nothing is refused: items that cannot be compared are left out and listed in the result.
pub fn compare(before: (&Project, &Adjustment), after: (&Project, &Adjustment)) -> Comparison {
    let (earlier, later) = (before.1, after.1);
    let places: HashMap<&str, usize> = earlier.points.iter().enumerate().map(|(k, p)| (p.id.as_str(), k)).collect();
    let pairs: Vec<(usize, usize)> =
        later.points.iter().enumerate().filter_map(|(k, p)| Some((*places.get(p.id.as_str())?, k))).collect();
    let independent = independent(before.0, after.0);
    let joined = JointTest { independent, limit: later.criteria.w, computed: None };
    let (alignment, laid) = aligned(before, after, &pairs, joined);
    let mut points = Vec::new();
    let mut photos = Vec::new();
    let centres: HashMap<&str, _> =
        earlier.photos.iter().map(|p| (p.id.as_str(), UncertainPlace::bare(p.position, p.sigma_position))).collect();
    let common: Vec<_> = later.photos.iter().filter(|q| centres.contains_key(q.id.as_str())).collect();
    let (mut parameters, unlike_cameras) = parameters(&earlier.cameras, &later.cameras, independent);
    let mut covariance = if independent { CovarianceOf::Sum } else { CovarianceOf::Larger };
    if let Some(laid) = &laid {
        let wanted = ComparedQuantities {
            points: pairs.iter().map(|&(_, k)| later.points[k].id.as_str()).collect(),
            photos: common.iter().map(|q| q.id.as_str()).collect(),
            parameters: parameters.iter().map(ParameterChange::quantity).collect(),
        };
        let places = pairs.iter().map(|&(_, k)| later.points[k].xyz).chain(common.iter().map(|q| q.position));
        let places: Vec<Vector3<f64>> = places.map(Vector3::from).collect();
        let found = covariances(before, after, &wanted, &places, laid);
        if let Some(Covariances { parameters: variances, .. }) = &found {
            covariance = CovarianceOf::Union;
            parameters.iter_mut().zip(variances).for_each(|(change, variance)| change.judge(*variance));
        }
        let of_points = |k: usize| found.as_ref().map(|found| found.points[k]);
        let of_photos = |k: usize| found.as_ref().map(|found| found.photos[k]);
        points.extend(pairs.iter().enumerate().map(|(n, &(i, k))| {
            let (p, q) = (&earlier.points[i], &later.points[k]);
            moved(
                &q.id,
                UncertainPlace::of(p),
                UncertainPlace::of(q),
                &laid.transform,
                JointTest { computed: of_points(n), ..joined },
            )
        }));
        photos.extend(common.iter().enumerate().map(|(n, q)| {
            let now = UncertainPlace::bare(q.position, q.sigma_position);
            let joined = JointTest { computed: of_photos(n), ..joined };
            moved(&q.id, centres[q.id.as_str()], now, &laid.transform, joined)
        }));
    }
    let ids = |a: &Adjustment| a.points.iter().map(|p| p.id.clone()).collect::<BTreeSet<_>>();
    let (old, present) = (ids(earlier), ids(later));
    let limit = later.criteria.w;
    let squares: f64 = points.iter().map(|m| m.length().powi(2)).sum();
    Comparison {
        alignment,
        rms: (!points.is_empty()).then(|| (squares / points.len() as f64).sqrt()),
        beyond: points.iter().filter(|m| m.ratio.is_some_and(|ratio| ratio > limit)).count(),
        points,
        photos,
        parameters,
        unlike_cameras,
        gone: old.difference(&present).cloned().collect(),
        new: present.difference(&old).cloned().collect(),
        limit,
        sigma0: [earlier.sigma0, later.sigma0],
        redundancy: [earlier.redundancy, later.redundancy],
        independent,
        covariance,
    }
}

/// How coordinates of the earlier network come into the system of the later one; no transform where they cannot.
fn aligned(
    (old, earlier): (&Project, &Adjustment),
    (new, later): (&Project, &Adjustment),
    pairs: &[(usize, usize)],
    joined: JointTest,
) -> (Alignment, Option<SystemTransformation>) {
    if old.unit != new.unit {
        return (Alignment::Units { before: old.unit.clone(), after: new.unit.clone() }, None);
    }
    if same_system(old, new) {
        return (Alignment::Same, Some(SystemTransformation { transform: Similarity::identity(), carriers: None }));
    }
    let source: Vec<_> = pairs.iter().map(|&(i, _)| Vector3::from(earlier.points[i].xyz)).collect();
    let target: Vec<_> = pairs.iter().map(|&(_, k)| Vector3::from(later.points[k].xyz)).collect();
    let common = pairs.len();
    let Ok((fit, kept)) = similarity::fit_robust(&source, &target, 0) else {
        return (Alignment::Apart { common }, None);
    };
    let extent = PrincipalAxes::of(&target).map_or(0.0, |spread| spread.extent.norm());
    // Three points agree under some similarity whatever they are: what counts are the others.
    let majority = |agreeing: usize| agreeing >= 3 && 2 * (agreeing - 3) >= common - 3;
    let agreement = |transform: &Similarity, mirrored: bool| {
        let moved = pairs.iter().map(|&(i, k)| {
            let (p, q) = (&earlier.points[i], &later.points[k]);
            let before = if mirrored { UncertainPlace::of(p).mirrored() } else { UncertainPlace::of(p) };
            moved(&q.id, before, UncertainPlace::of(q), transform, joined)
        });
        Agreement::of(moved, AGREEING * later.criteria.w, AGREEING_SHARE * extent)
    };
    let both_scaled = has_scale(old, earlier) && has_scale(new, later);
    // About the centroids rotation and shift of least squares are the same with and without a scale.
    let scale = if both_scaled { 1.0 } else { fit.transform.scale };
    let laid = Similarity { scale, ..fit.transform };
    let found = agreement(&laid, false);
    if !majority(found.points) {
        let mirror: Vec<_> = source.iter().map(|p| Vector3::new(-p.x, p.y, p.z)).collect();
        let mirrored = similarity::fit_robust(&mirror, &target, 0)
            .is_ok_and(|(fit, _)| majority(agreement(&fit.transform, true).points));
        let scaled = both_scaled && majority(agreement(&fit.transform, false).points);
        let scale = scaled.then_some(fit.transform.scale);
        return (Alignment::Unlike { common, agreeing: found.points, ratio: found.ratio, scale, mirrored }, None);
    }
    let carriers: Vec<usize> = (0..kept.len()).filter(|k| kept[*k]).collect();
    let alignment = Alignment::Fitted { points: carriers.len(), scale: (!both_scaled).then_some(scale) };
    let parameters = if both_scaled { 6 } else { 7 };
    (alignment, Some(SystemTransformation { transform: laid, carriers: Some((carriers, parameters)) }))
}

/// How well two networks agree under a transform.
struct Agreement {
    /// Points that agree.
    points: usize,
    /// Median of the ratios.
    ratio: Option<f64>,
}

impl Agreement {
    fn of(moved: impl Iterator<Item = Moved>, limit: f64, length: f64) -> Self {
        let (mut points, mut ratios) = (0, Vec::new());
        for moved in moved {
            points += usize::from(match moved.ratio {
                Some(ratio) => ratio <= limit,
                None => moved.length() <= length,
            });
            ratios.extend(moved.ratio);
        }
        ratios.sort_by(f64::total_cmp);
        Self { points, ratio: ratios.get(ratios.len() / 2).copied() }
    }
}

/// Whether both are held by control points of which enough kept their coordinates.
fn same_system(old: &Project, new: &Project) -> bool {
    if old.datum.kind != DatumKind::Control || new.datum.kind != DatumKind::Control {
        return false;
    }
    let control = |p: &Project| -> HashMap<String, Option<[f64; 3]>> {
        p.points.iter().filter(|p| p.role == Role::Control).map(|p| (p.id.clone(), p.xyz)).collect()
    };
    let earlier = control(old);
    let kept = control(new).into_iter().filter(|(id, xyz)| xyz.is_some() && earlier.get(id) == Some(xyz));
    kept.count() >= SAME_SYSTEM
}

/// Whether the network has a length.
fn has_scale(project: &Project, adjustment: &Adjustment) -> bool {
    let there: BTreeSet<&str> = adjustment.points.iter().map(|p| p.id.as_str()).collect();
    let used = |from: &str, to: &str| there.contains(from) && there.contains(to);
    project.datum.kind == DatumKind::Control
        || project.distances.iter().any(|d| !d.check && used(d.from.as_str(), d.to.as_str()))
}

/// Whether both have observations and share none.
fn independent(old: &Project, new: &Project) -> bool {
    fn photos(p: &Project) -> Vec<&Photo> {
        let measured: BTreeSet<&str> = p.observations.iter().filter(|o| o.enabled).map(|o| o.photo.as_str()).collect();
        p.photos.iter().filter(|photo| photo.enabled && measured.contains(photo.id.as_str())).collect()
    }
    let (before, after) = (photos(old), photos(new));
    let shared = before.iter().any(|a| after.iter().any(|b| same_photo(a, b)));
    let weighted = |p: &Point| p.sigma.iter().flatten().flatten().any(|s| *s > 0.0);
    let control = |p: &Project| -> Vec<(String, Option<[f64; 3]>)> {
        let by_control = p.datum.kind == DatumKind::Control;
        let given = p.points.iter().filter(|point| by_control && point.role == Role::Control && weighted(point));
        given.map(|point| (point.id.clone(), point.xyz)).collect()
    };
    let (given, again) = (control(old), control(new));
    let distances = |p: &Project| -> Vec<(String, String, f64)> {
        p.distances.iter().filter(|d| !d.check).map(|d| (d.from.clone(), d.to.clone(), d.length)).collect()
    };
    let (bars, bars_again) = (distances(old), distances(new));
    let other = given.iter().any(|g| again.contains(g)) || bars.iter().any(|bar| bars_again.contains(bar));
    !before.is_empty() && !after.is_empty() && !shared && !other
}

/// How two results are joined: whether they share nothing, the limit of a single test, and the covariance of the difference where it was
/// computed.
#[derive(Clone, Copy)]
struct JointTest {
    independent: bool,
    limit: f64,
    computed: Option<Matrix3<f64>>,
}

/// Variances of a difference below this part of those of the two places are rounding: both results have the same observations there.
const ROUNDING: f64 = 1e-9;

/// dᵀC⁺d and rank(C) in the directions with variances above `least`; `None` if there is no such direction.
fn vector_test(d: &Vector3<f64>, c: &Matrix3<f64>, least: f64) -> Option<(f64, usize)> {
    let eigen = c.symmetric_eigen();
    let free = (0..3).filter(|&k| eigen.eigenvalues[k] > least.max(ROUNDING * eigen.eigenvalues.max()));
    let terms: Vec<f64> = free.map(|k| eigen.eigenvectors.column(k).dot(d).powi(2) / eigen.eigenvalues[k]).collect();
    let statistic: f64 = terms.iter().sum();
    (!terms.is_empty() && statistic.is_finite()).then_some((statistic, terms.len()))
}

impl ParameterChange {
    fn quantity(&self) -> AdjustedQuantity {
        AdjustedQuantity::Parameter(self.camera.clone(), self.photo.clone(), self.parameter)
    }

    /// Takes the computed variance of the difference in place of what was known before.
    fn judge(&mut self, variance: f64) {
        let Some(bound) = self.sigma else { return };
        let sigma = variance.max(0.0).sqrt();
        self.sigma = Some(sigma);
        self.ratio = (variance > ROUNDING * bound * bound).then(|| (self.after - self.before).abs() / sigma);
    }
}

/// Coordinates with their standard errors and covariance.
#[derive(Clone, Copy)]
struct UncertainPlace {
    xyz: [f64; 3],
    sigma: Option<[f64; 3]>,
    covariance: Option<Matrix3<f64>>,
}

impl UncertainPlace {
    fn of(point: &AdjustedPoint) -> Self {
        let matrix = |[xx, xy, xz, yy, yz, zz]: [f64; 6]| Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        Self { xyz: point.xyz, sigma: point.sigma, covariance: point.covariance.map(matrix) }
    }

    fn bare(xyz: [f64; 3], sigma: Option<[f64; 3]>) -> Self {
        Self { xyz, sigma, covariance: None }
    }

    /// Its mirror image in the plane of Y and Z.
    fn mirrored(mut self) -> Self {
        self.xyz[0] = -self.xyz[0];
        if let Some(c) = &mut self.covariance {
            for (i, j) in [(0, 1), (1, 0), (0, 2), (2, 0)] {
                c[(i, j)] = -c[(i, j)];
            }
        }
        self
    }
}

/// A point's movement, its earlier place and errors brought into the later system.
fn moved(id: &str, before: UncertainPlace, after: UncertainPlace, transform: &Similarity, joined: JointTest) -> Moved {
    let place = transform.point(&Vector3::from(before.xyz));
    let difference: [f64; 3] = std::array::from_fn(|axis| after.xyz[axis] - place[axis]);
    // Turned without what the axes have in common, where only standard errors are known: Σ R²σ².
    let turned = before.sigma.map(|sigma| -> [f64; 3] {
        std::array::from_fn(|axis| {
            let squares = (0..3).map(|k| (transform.rotation[(axis, k)] * sigma[k]).powi(2));
            transform.scale * squares.sum::<f64>().sqrt()
        })
    });
    let turn = |a: Matrix3<f64>| transform.rotation * a * transform.rotation.transpose() * transform.scale.powi(2);
    let own = before.covariance.zip(after.covariance);
    let sum = own.filter(|_| joined.independent).map(|(a, b)| turn(a) + b);
    let covariance = joined.computed.or(sum);
    let sigma = match (covariance, turned, after.sigma) {
        (Some(c), ..) => Some(std::array::from_fn(|axis| c[(axis, axis)].max(0.0).sqrt())),
        (None, Some(a), Some(b)) if joined.independent => Some(std::array::from_fn(|axis| a[axis].hypot(b[axis]))),
        (None, Some(a), Some(b)) => Some(std::array::from_fn(|axis| a[axis].max(b[axis]))),
        (None, one, other) => one.or(other),
    };
    let squares = |s: Option<[f64; 3]>| s.map_or(0.0, |s| s.iter().map(|s| s * s).sum::<f64>());
    let least = ROUNDING * (squares(turned) + squares(after.sigma));
    let test = covariance.and_then(|c| vector_test(&Vector3::from(difference), &c, least));
    let statistic = test.map(|(statistic, _)| statistic);
    let ratio = match test {
        Some((statistic, rank)) => {
            let alpha = Fisher::new(1, None).tails(joined.limit * joined.limit)[1];
            let limit = (rank as f64 * Fisher::new(rank, None).limit(alpha)).sqrt();
            Some(statistic.sqrt() * joined.limit / limit)
        }
        None if covariance.is_some() => None,
        None => sigma.and_then(|sigma: [f64; 3]| {
            let ratios = (0..3).filter(|&axis| sigma[axis] > 0.0).map(|axis| difference[axis].abs() / sigma[axis]);
            ratios.reduce(f64::max)
        }),
    };
    Moved { id: id.to_owned(), difference, sigma, ratio: ratio.filter(|ratio| ratio.is_finite()), statistic }
}

/// Parameters that both adjustments have, and the cameras that cannot be compared.
fn parameters(
    earlier: &[AdjustedCamera],
    later: &[AdjustedCamera],
    independent: bool,
) -> (Vec<ParameterChange>, Vec<String>) {
    let key = |c: &AdjustedCamera| (c.camera.id.clone(), c.photo.clone());
    let before: BTreeMap<_, _> = earlier.iter().map(|c| (key(c), c)).collect();
    let mut changes = Vec::new();
    let mut unlike = BTreeSet::new();
    for (now, old) in later.iter().filter_map(|c| Some((c, *before.get(&key(c))?))) {
        let same_model = now.camera.interior.parameters() == old.camera.interior.parameters();
        if !same_model || PhotoUnit::of(&now.camera) != PhotoUnit::of(&old.camera) {
            unlike.insert(now.camera.id.clone());
            continue;
        }
        for &parameter in now.camera.interior.parameters() {
            let values = (old.camera.interior.get(parameter), now.camera.interior.get(parameter));
            let (Some(before), Some(after)) = values else { continue };
            let sigmas = [old, now].map(|c| c.sigma.get(&parameter).copied());
            let estimated = [old, now].iter().any(|c| c.camera.estimated().contains(&parameter));
            if before == after && !estimated {
                continue;
            }
            let sigma = sigmas.into_iter().flatten().reduce(if independent { f64::hypot } else { f64::max });
            let ratio = sigma.filter(|sigma| *sigma > 0.0).map(|sigma| (after - before).abs() / sigma);
            let (camera, photo) = key(now);
            changes.push(ParameterChange { camera, photo, parameter, before, after, sigma, ratio });
        }
    }
    (changes, unlike.into_iter().collect())
}

#[cfg(test)]
mod tests;
