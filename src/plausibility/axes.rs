//! Whether given coordinates are a mirror image of the object.
//!
//! A similarity X' = t + s R X transforms the network of the photos to the given coordinates. All 48 signed permutations of the given
//! axes make two cases only: those of determinant +1 are rotations, which R absorbs, and those of determinant -1 differ from each other
//! by rotations. So two fits are compared, of the coordinates as given and of their mirror image, by their squared distances over the
//! variances, each cut off ([`CUT`]) so that single wrong points do not decide. Points in a plane fit both ways: then the side that the
//! cameras stand on decides, or nothing.
//!
//! The mirror image has many names. Which slip is proposed follows from what the photos show of up and down, and from the size and signs
//! of the coordinates; exchanges that these cannot distinguish are named as well.

use nalgebra::{Matrix3, Vector3};

use crate::adjustment::{Exchange, MirroredControl, UndecidedAxes};
use crate::initial::robust::quantile;
use crate::initial::similarity::{Similarity, fit, fit_robust};
use crate::initial::{Pose, PrincipalAxes};

/// A point in the photos' network and its given coordinates.
#[derive(Clone, Copy, Debug)]
pub struct PointPair {
    /// In the system of the photos' network.
    pub free: Vector3<f64>,
    /// As given.
    pub given: Vector3<f64>,
    /// Standard error of a coordinate of `free`, its unit.
    pub free_sigma: f64,
    /// Standard error of a given coordinate, its unit; 0 if it is held.
    pub given_sigma: f64,
}

/// The questions.
#[derive(Clone, Debug, PartialEq)]
pub enum Question {
    /// The axes are mirrored.
    Mirrored(MirroredControl),
    /// They may be.
    Undecided(UndecidedAxes),
}

/// How the two fits compare.
#[derive(Clone, Debug)]
pub enum Handedness {
    /// The coordinates fit as given, and their mirror image does not.
    AsGiven,
    /// The mirror image fits: linear part of the map from the photos' system to the given one (determinant below 0), rms as given and
    /// mirrored.
    Mirrored {
        /// Rotation and reflection.
        to_given: Matrix3<f64>,
        /// As given.
        rms_given: f64,
        /// Mirrored.
        rms_exchanged: f64,
    },
    /// Both fit, since the points lie in a plane: rotation from the photos' system to the given one, normal of the plane there.
    Both {
        /// Rotation.
        to_given: Matrix3<f64>,
        /// Unit normal, of either sign.
        normal: Vector3<f64>,
    },
    /// Neither fits, or there are too few points: other mistakes are to be looked for.
    Neither,
}

/// Standard errors beyond which a point counts no more: a wrong point must not outweigh all others.
const CUT: f64 = 6.0;
/// Difference of the two sums of squares over the variance that decides: five standard errors. Less would take noise of a nearly flat
/// object for a reflection once in a few thousand projects.
const DECISIVE: f64 = 25.0;
/// Share of the points that fit, and part of the object's extent that the rms of a fit may have: names that are wrong throughout fit
/// badly both ways, by chance a little less badly one way.
const FITTING: f64 = 0.7;
const CLOSE: f64 = 0.05;
/// Times that standard errors of given coordinates may be too small. A single wrong point of four bends both fits, and may bend the mirrored
/// one less.
const OPTIMISTIC: f64 = 10.0;
/// Ratio of the two rms at which a mirror image is accepted; relief of five standard errors gives less than 0.3.
const BETTER: f64 = 0.5;

/// A similarity fit, as given or mirrored.
struct HandednessFit {
    transform: Similarity,
    /// Distances over their standard errors.
    ratios: Vec<f64>,
}

const MIRROR: Vector3<f64> = Vector3::new(-1.0, 1.0, 1.0);

/// Compares the fits as given and mirrored.
pub fn handedness(pairs: &[PointPair]) -> Handedness {
    let source: Vec<Vector3<f64>> = pairs.iter().map(|p| p.free).collect();
    let given: Vec<Vector3<f64>> = pairs.iter().map(|p| p.given).collect();
    let mirrored: Vec<Vector3<f64>> = given.iter().map(|g| g.component_mul(&MIRROR)).collect();
    let Ok(spread) = PrincipalAxes::of(&given) else { return Handedness::Neither };
    let extent = spread.extent.norm();
    // All points together where they agree, else those that do: of few points a robust fit may find a few that agree by chance.
    let of = |target: &[Vector3<f64>]| -> Vec<HandednessFit> {
        let found = [fit(&source, target), fit_robust(&source, target, 0).map(|(fit, _)| fit)];
        let each = found.into_iter().flatten().map(|found| {
            let transform = found.transform;
            let ratios = pairs.iter().zip(target).map(|(pair, target)| {
                let sigma = pair.given_sigma.hypot(transform.scale * pair.free_sigma).max(1e-9 * extent);
                (transform.point(&pair.free) - target).norm() / sigma
            });
            HandednessFit { transform, ratios: ratios.collect() }
        });
        each.collect()
    };
    let (as_given, reflected) = (of(&given), of(&mirrored));
    // Standard errors that are too small are enlarged by what the best of the fits leaves.
    let spare = (3 * pairs.len()).saturating_sub(7).max(1) as f64;
    // The median length of three-dimensional residuals is 1.538 standard deviations of a coordinate.
    let scatter = |fit: &HandednessFit| quantile(&fit.ratios, 0.5) / 1.538 * (1.0 + 5.0 / spare);
    let unit = as_given.iter().chain(&reflected).map(scatter).fold(f64::INFINITY, f64::min).max(1.0);
    let stated = pairs.iter().all(|p| p.given_sigma > 0.0);
    if stated && unit > OPTIMISTIC {
        return Handedness::Neither;
    }
    let squares = |fit: &HandednessFit| -> f64 { fit.ratios.iter().map(|r| (r / unit).min(CUT).powi(2)).sum() };
    let better = |fits: Vec<HandednessFit>| fits.into_iter().min_by(|a, b| squares(a).total_cmp(&squares(b)));
    let (Some(as_given), Some(reflected)) = (better(as_given), better(reflected)) else { return Handedness::Neither };
    let difference = squares(&as_given) - squares(&reflected);
    let best = if difference > 0.0 { &reflected } else { &as_given };
    let fitting: Vec<usize> = (0..pairs.len()).filter(|&k| best.ratios[k] <= CUT * unit).collect();
    let rms = |target: &[Vector3<f64>]| -> Option<f64> {
        let pick = |all: &[Vector3<f64>]| fitting.iter().map(|&k| all[k]).collect::<Vec<_>>();
        let found = fit(&pick(&source), &pick(target)).ok()?;
        found.sigma0
    };
    let (Some(rms_given), Some(rms_exchanged)) = (rms(&given), rms(&mirrored)) else { return Handedness::Neither };
    let enough = fitting.len() >= 3 && fitting.len() as f64 >= FITTING * pairs.len() as f64;
    if !enough || rms_given.min(rms_exchanged) > CLOSE * extent {
        return Handedness::Neither;
    }
    if difference > DECISIVE && rms_exchanged <= BETTER * rms_given {
        let to_given = Matrix3::from_diagonal(&MIRROR) * reflected.transform.rotation;
        return Handedness::Mirrored { to_given, rms_given, rms_exchanged };
    }
    if difference.abs() <= DECISIVE {
        let normal = spread.axes.column(2).into_owned();
        return Handedness::Both { to_given: as_given.transform.rotation, normal };
    }
    Handedness::AsGiven
}

/// Cosine beyond which a direction is along an axis, and length of a mean of unit vectors that agree on a direction.
const ALONG: f64 = 0.8;
const AGREED: f64 = 0.6;
/// Distance of the coordinates from 0, in extents of the object, at which their signs mean something: national grids.
const FAR: f64 = 3.0;
/// Height of the cameras' direction over the horizon, as a sine, at which they look down onto a plane of control points, or up to it. A wall
/// leaves less, and both of its sides are the same to the photos.
const ABOVE: f64 = 0.3;

/// What there is to ask of given coordinates, from the points that both have and the photos' poses in the photos' system; `None` if the
/// axes are as they should be, or where nothing fits.
pub fn question(pairs: &[PointPair], poses: &[Pose]) -> Option<Question> {
    if pairs.len() < 3 {
        return None;
    }
    match handedness(pairs) {
        Handedness::AsGiven | Handedness::Neither => None,
        Handedness::Mirrored { to_given, rms_given, rms_exchanged } => {
            let given: Vec<Vector3<f64>> = pairs.iter().map(|p| p.given).collect();
            let (exchange, alternatives) = proposed(&Shown::of(pairs, poses, &to_given), &given);
            let points = pairs.len();
            Some(Question::Mirrored(MirroredControl { exchange, alternatives, rms_given, rms_exchanged, points }))
        }
        Handedness::Both { to_given, normal } => {
            let towards = Shown::of(pairs, poses, &to_given).cameras;
            // Photos of a floor, a table or a test field are taken from above: its axes are as given.
            if towards.z > ABOVE {
                return None;
            }
            let normal = if normal.dot(&towards) < 0.0 { -normal } else { normal };
            Some(Question::Undecided(UndecidedAxes { points: pairs.len(), normal: normal.into() }))
        }
    }
}

/// Directions of the photos in the given coordinate system.
struct Shown {
    /// Mean of the photos' upward directions: of unit length where they agree.
    up: Vector3<f64>,
    /// Unit vector from the points to the cameras.
    cameras: Vector3<f64>,
}

impl Shown {
    fn of(pairs: &[PointPair], poses: &[Pose], to_given: &Matrix3<f64>) -> Self {
        let count = poses.len().max(1) as f64;
        let middle = pairs.iter().map(|p| p.free).sum::<Vector3<f64>>() / pairs.len().max(1) as f64;
        let up = poses.iter().map(|p| p.object_to_camera.row(1).transpose()).sum::<Vector3<f64>>() / count;
        let away = poses.iter().map(|p| (p.centre - middle).normalize()).filter(|d| d.iter().all(|x| x.is_finite()));
        let cameras: Vector3<f64> = away.sum();
        Self { up: to_given * up, cameras: (to_given * cameras).try_normalize(1e-9).unwrap_or_else(Vector3::zeros) }
    }

    /// The axis that heights are counted along, and whether they are counted upwards; `None` if the photos do not tell.
    fn height(&self) -> Option<(usize, bool)> {
        let along = |direction: &Vector3<f64>| {
            let axis = direction.iamax();
            (direction[axis].abs() >= ALONG * direction.norm()).then_some((axis, direction[axis] > 0.0))
        };
        // Photos from above, held any way: heights are along the line of sight.
        let above = along(&self.cameras).filter(|(axis, _)| *axis == 2);
        above.or_else(|| along(&self.up).filter(|_| self.up.norm() >= AGREED))
    }
}

/// The exchange to propose, and what cannot be told from it.
fn proposed(shown: &Shown, given: &[Vector3<f64>]) -> (Exchange, Vec<Exchange>) {
    use Exchange as E;
    // Along the axis of heights nothing is exchanged: downwards it has the wrong sign, upwards the other two are concerned.
    let (first, second, exchange) = match shown.height() {
        Some((2, false)) => return (E::Z, Vec::new()),
        Some((1, false)) => return (E::Y, Vec::new()),
        Some((0, false)) => return (E::X, Vec::new()),
        Some((1, true)) => (0, 2, E::Xz),
        Some((0, true)) => (1, 2, E::Yz),
        _ => (0, 1, E::Xy),
    };
    let sign = [E::X, E::Y, E::Z];
    let middle = given.iter().sum::<Vector3<f64>>() / given.len() as f64;
    let extent = PrincipalAxes::of(given).map_or(0.0, |spread| spread.extent.norm());
    let side = |axis: usize| {
        let value = middle[axis];
        if value.abs() > FAR * extent { value.signum() } else { 0.0 }
    };
    match (side(first), side(second)) {
        // Grids are laid so that coordinates are positive.
        (a, b) if a < 0.0 && b >= 0.0 => (sign[first], vec![exchange, sign[second]]),
        (a, b) if a >= 0.0 && b < 0.0 => (sign[second], vec![exchange, sign[first]]),
        (a, b) if a > 0.0 && b > 0.0 => (exchange, Vec::new()),
        _ => (exchange, vec![sign[first], sign[second]]),
    }
}

#[cfg(test)]
mod tests;
