//! Space resection with known interior orientation, from three or more points.
//!
//! Solutions of three-point samples are refined by least squares on all points and ordered by their residuals.

use nalgebra::{Rotation3, Vector3};

use super::homography::of_plane;
use super::p3p::p3p;
use super::robust::{generator, quantile, sample, scale};
use super::{Degeneracy, Pose, PrincipalAxes};

/// Ratio of the smallest to the largest extent of the points below which the pose with mirrored tilt is tried too.
const NEARLY_FLAT: f64 = 0.2;

/// A pose from known points.
#[derive(Clone, Debug, PartialEq)]
pub struct Resection {
    /// The photo's exterior orientation.
    pub pose: Pose,
    /// Projection minus measurement in ideal coordinates.
    pub residuals: Vec<[f64; 2]>,
    /// √(Σv²/(2n - 6)) in ideal coordinates; times c it is in photo units. `None` for three points.
    pub sigma0: Option<f64>,
    /// Whether each point took part; all of them in [`space_resection`].
    pub inliers: Vec<bool>,
}

impl Resection {
    fn new(pose: Pose, object: &[Vector3<f64>], image: &[[f64; 2]], inliers: Vec<bool>) -> Self {
        let residuals: Vec<[f64; 2]> =
            object.iter().zip(image).map(|(p, &m)| pose.residual(p, m).map_or([0.0; 2], |r| [r.x, r.y])).collect();
        let taken = || residuals.iter().zip(&inliers).filter(|(_, taken)| **taken);
        let squares: f64 = taken().map(|(v, _)| v[0] * v[0] + v[1] * v[1]).sum();
        let redundancy = (2 * taken().count()).saturating_sub(6);
        let sigma0 = (redundancy > 0).then(|| (squares / redundancy as f64).sqrt());
        Self { pose, residuals, sigma0, inliers }
    }

    /// Sum of the squared residuals of the points that took part.
    pub fn squares(&self) -> f64 {
        self.residuals.iter().zip(&self.inliers).filter(|(_, t)| **t).map(|(v, _)| v[0] * v[0] + v[1] * v[1]).sum()
    }
}

/// All poses of least squared residuals, best first: up to four for three points, more than one for four or more
/// only where the geometry is ambiguous (plane or weak figures). Image in ideal coordinates.
///
/// # Errors
/// [`Degeneracy::TooFew`] below three points, [`Degeneracy::Collinear`], [`Degeneracy::NoSolution`] if no pose has
/// all points in front.
pub fn space_resection(object: &[Vector3<f64>], image: &[[f64; 2]]) -> Result<Vec<Resection>, Degeneracy> {
    let (object, image) = checked(object, image)?;
    let n = object.len();
    let mut poses: Vec<Pose> = Vec::new();
    for triple in wide_triples(object, if n <= 5 { 10 } else { 6 }) {
        for pose in p3p(&triple.map(|k| object[k]), &triple.map(|k| image[k])) {
            poses.extend(if n == 3 { Some(pose) } else { pose.refined(object, image) });
        }
    }
    if n > 3 {
        let plane = of_plane(object, image).and_then(|h| h.pose());
        poses.extend(plane.ok().and_then(|pose| pose.refined(object, image)));
    }
    let mut distinct = distinct_by_cost(poses, object, image);
    // Nearly coplanar points seen from far away have nearly the same image when they are tilted the other way.
    let spread = PrincipalAxes::of(object)?;
    if n > 3 && spread.extent[2] < NEARLY_FLAT * spread.extent[0] {
        let tilted: Vec<Pose> = distinct.iter().take(2).filter_map(|pose| tilted_back(pose, &spread)).collect();
        distinct.extend(tilted.iter().filter_map(|pose| pose.refined(object, image)));
        distinct = distinct_by_cost(distinct, object, image);
    }
    if distinct.is_empty() {
        return Err(Degeneracy::NoSolution);
    }
    Ok(distinct.into_iter().map(|pose| Resection::new(pose, object, image, vec![true; n])).collect())
}

/// The pose in which the plane of the points has the mirrored tilt relative to the line of sight to their centroid.
fn tilted_back(pose: &Pose, spread: &PrincipalAxes) -> Option<Pose> {
    let centroid = pose.to_camera(&spread.centroid);
    let sight = centroid.normalize();
    let normal = pose.object_to_camera * spread.axes.column(2);
    let mirrored = sight * (2.0 * normal.dot(&sight)) - normal;
    let turn = Rotation3::rotation_between(&normal, &mirrored)?.into_inner();
    let object_to_camera = turn * pose.object_to_camera;
    Some(Pose { object_to_camera, centre: spread.centroid - object_to_camera.tr_mul(&centroid) })
}

/// The pose with which most points agree.
///
/// If all points agree with the least-squares pose within `tolerance` (ideal coordinates), that pose is returned: the exact fit of a
/// sample to three points must not outweigh a fourth point. Otherwise poses of three-point samples are compared: the least median of the
/// residuals gives the scatter, and the pose with the smallest sum of squares, each truncated at
/// 3.5 robust standard deviations (at least `tolerance`, at most three times the larger of `tolerance` and the median), is refined on the
/// points within that limit.
///
/// # Errors
/// As [`space_resection`]; `TooFew` below four points, since three always agree; `NoSolution` where fewer than four
/// agree.
pub fn robust_resection(
    object: &[Vector3<f64>],
    image: &[[f64; 2]],
    tolerance: f64,
    seed: u64,
) -> Result<Resection, Degeneracy> {
    let (object, image) = checked(object, image)?;
    let n = object.len();
    if n < 4 {
        return Err(Degeneracy::TooFew { needed: 4, given: n });
    }
    let misfits = |pose: &Pose| -> Vec<f64> { object.iter().zip(image).map(|(p, &m)| pose.misfit(p, m)).collect() };
    let mut poses: Vec<Pose> = Vec::new();
    if let Ok(all) = space_resection(object, image) {
        let best = &all[0];
        if misfits(&best.pose).iter().all(|length| *length <= tolerance) {
            return Ok(Resection::new(best.pose, object, image, vec![true; n]));
        }
        poses.extend(all.iter().map(|r| r.pose));
    }
    let mut random = generator(seed);
    let mut try_triple = |triple: [usize; 3]| poses.extend(p3p(&triple.map(|k| object[k]), &triple.map(|k| image[k])));
    if n <= 8 {
        for a in 0..n {
            for b in a + 1..n {
                (b + 1..n).for_each(|c| try_triple([a, b, c]));
            }
        }
    } else {
        (0..100).for_each(|_| try_triple(sample(&mut random, n)));
    }
    // A quantile above the median, so that a sample's exact fit to three of five points does not decide.
    let share = if n < 8 { 0.75 } else { 0.6 };
    let lengths: Vec<Vec<f64>> = poses.iter().map(misfits).collect();
    let median = lengths.iter().map(|l| quantile(l, share)).fold(f64::INFINITY, f64::min);
    let scatter = lengths.iter().map(|l| scale(l, 6)).fold(f64::INFINITY, f64::min);
    let widest = 3.0 * if median.is_finite() { tolerance.max(median) } else { tolerance };
    let cut = (3.5 * scatter).clamp(tolerance, widest);
    let cost = |l: &Vec<f64>| -> f64 { l.iter().map(|x| x.min(cut).powi(2)).sum() };
    let best = (0..poses.len()).min_by(|&a, &b| cost(&lengths[a]).total_cmp(&cost(&lengths[b])));
    let mut pose = poses[best.ok_or(Degeneracy::NoSolution)?];
    let mut inliers = vec![true; n];
    for round in 0..5 {
        let lengths = misfits(&pose);
        let agreeing: Vec<f64> = lengths.iter().copied().filter(|length| *length <= 2.0 * cut).collect();
        // The first pose comes from three points, whose residuals are 0, so its limit is not estimated from residuals.
        let limit = if round == 0 { 2.0 * cut } else { (3.5 * scale(&agreeing, 6)).clamp(tolerance, 2.0 * cut) };
        let now: Vec<bool> = lengths.iter().map(|length| *length <= limit).collect();
        let pick: Vec<usize> = (0..n).filter(|&k| now[k]).collect();
        if pick.len() < 4 {
            return Err(Degeneracy::NoSolution);
        }
        let (some_object, some_image): (Vec<_>, Vec<_>) = pick.iter().map(|&k| (object[k], image[k])).unzip();
        pose = pose.refined(&some_object, &some_image).ok_or(Degeneracy::NoSolution)?;
        let settled = now == inliers && round > 0;
        inliers = now;
        if settled {
            break;
        }
    }
    Ok(Resection::new(pose, object, image, inliers))
}

type Checked<'a> = (&'a [Vector3<f64>], &'a [[f64; 2]]);

fn checked<'a>(object: &'a [Vector3<f64>], image: &'a [[f64; 2]]) -> Result<Checked<'a>, Degeneracy> {
    let n = object.len().min(image.len());
    if n < 3 {
        return Err(Degeneracy::TooFew { needed: 3, given: n });
    }
    if PrincipalAxes::of(&object[..n])?.is_line() {
        return Err(Degeneracy::Collinear);
    }
    Ok((&object[..n], &image[..n]))
}

/// Triples of points that span large triangles in the object: for few points all of them, else those through the
/// extreme points.
fn wide_triples(object: &[Vector3<f64>], most: usize) -> Vec<[usize; 3]> {
    let n = object.len();
    let mut candidates: Vec<usize> = (0..n).collect();
    if n > 8 {
        // Farthest-point selection: every next point is the one farthest from those chosen.
        candidates = vec![0];
        while candidates.len() < 8 {
            let distance = |k: usize| {
                candidates.iter().map(|&c| (object[k] - object[c]).norm_squared()).fold(f64::INFINITY, f64::min)
            };
            let Some(next) = (0..n).max_by(|&a, &b| distance(a).total_cmp(&distance(b))) else { break };
            candidates.push(next);
        }
    }
    let mut triples = Vec::new();
    for (i, &a) in candidates.iter().enumerate() {
        for (j, &b) in candidates.iter().enumerate().skip(i + 1) {
            for &c in &candidates[j + 1..] {
                triples.push(((object[b] - object[a]).cross(&(object[c] - object[a])).norm(), [a, b, c]));
            }
        }
    }
    triples.sort_by(|a, b| b.0.total_cmp(&a.0));
    triples.into_iter().take(most).map(|(_, triple)| triple).collect()
}

/// Poses by cost, without repetitions and without those of infinite cost.
fn distinct_by_cost(poses: Vec<Pose>, object: &[Vector3<f64>], image: &[[f64; 2]]) -> Vec<Pose> {
    let mut costed: Vec<(f64, Pose)> = poses.into_iter().map(|pose| (pose.cost(object, image), pose)).collect();
    costed.retain(|(cost, _)| cost.is_finite());
    costed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut kept: Vec<Pose> = Vec::new();
    for (_, pose) in costed {
        let distance = (pose.centre - object[0]).norm();
        let same = |other: &Pose| {
            (other.centre - pose.centre).norm() < 1e-5 * distance
                && (other.object_to_camera - pose.object_to_camera).norm() < 1e-5
        };
        if !kept.iter().any(same) {
            kept.push(pose);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::robust::uniform;
    use crate::rotation;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn scene(n: usize, seed: u64) -> (Vec<Vector3<f64>>, Pose, Vec<[f64; 2]>) {
        let mut g = generator(seed);
        let mut next = || 2.0 * uniform(&mut g) - 1.0;
        let object: Vec<_> = (0..n).map(|_| Vector3::new(next(), next(), next())).collect();
        let m = rotation::object_to_camera([3.0 * next(), next(), 3.0 * next()]);
        let pose = Pose { object_to_camera: m, centre: m.tr_mul(&Vector3::new(0.2, -0.1, 4.0)) };
        let image = object.iter().map(|p| pose.image(p).expect("in front")).collect();
        (object, pose, image)
    }

    #[test]
    fn four_and_more_points_have_the_true_pose_first() {
        for seed in 0..200 {
            let (object, pose, image) = scene(4 + seed as usize % 4, seed);
            let found = space_resection(&object, &image).expect("solvable");
            assert!((found[0].pose.centre - pose.centre).norm() < 1e-6, "seed {seed}");
        }
    }

    #[test]
    fn wrongly_named_points_are_rejected() {
        for seed in 0..50 {
            let (object, pose, mut image) = scene(12, 1000 + seed);
            image.swap(1, 5);
            image[8] = [0.4, 0.4];
            let found = robust_resection(&object, &image, 1e-9, 0).expect("mostly right");
            assert!((found.pose.centre - pose.centre).norm() < 1e-6, "seed {seed}");
            assert!(!found.inliers[1] && !found.inliers[5] && !found.inliers[8]);
        }
    }

    /// Four to six points with noise of 0.1 to 0.5 px at c = 3000 px, in space and in a plane: the pose is in no worse a
    /// minimum than the one next to the truth, be the tolerance wide or about the noise.
    #[test]
    fn few_noisy_points_end_in_the_best_minimum() {
        const PX: f64 = 1.0 / 3000.0;
        let mut failed = Vec::new();
        for seed in 0..1200_u64 {
            let mut g = generator(5000 + seed);
            let mut next = || 2.0 * uniform(&mut g) - 1.0;
            let (n, flat) = (4 + seed as usize % 3, seed / 3 % 2 == 1);
            let object: Vec<_> =
                (0..n).map(|_| Vector3::new(next(), 0.8 * next(), if flat { 0.0 } else { 0.7 * next() })).collect();
            let m = rotation::object_to_camera([0.6 * next(), 0.6 * next(), 3.1 * next()]);
            let truth = Pose { object_to_camera: m, centre: m.tr_mul(&Vector3::new(0.0, 0.0, 5.0 + 0.5 * next())) };
            // A uniform error of this half-width has the standard deviation 0.1, 0.3 or 0.5 px.
            let width = 3_f64.sqrt() * [0.1, 0.3, 0.5][seed as usize / 6 % 3] * PX;
            let image: Vec<[f64; 2]> = object
                .iter()
                .map(|p| truth.image(p).expect("in front"))
                .map(|[x, y]| [x + width * next(), y + width * next()])
                .collect();
            let best = truth.refined(&object, &image).expect("in front").cost(&object, &image);
            let tolerance = [PX, 12.0 * PX][seed as usize / 18 % 2];
            match robust_resection(&object, &image, tolerance, seed) {
                Ok(found) if found.pose.cost(&object, &image) <= 1.001 * best => {}
                Ok(_) => failed.push((seed, "a worse minimum")),
                Err(_) => failed.push((seed, "no pose")),
            }
        }
        assert!(failed.len() * 200 <= 1200, "{failed:?}");
    }

    #[test]
    fn three_points_have_several_poses_and_fewer_none() {
        let (object, pose, image) = scene(3, 7);
        let found = space_resection(&object, &image).expect("solvable");
        assert!(found.iter().any(|r| (r.pose.centre - pose.centre).norm() < 1e-6));
        assert!(found.iter().all(|r| r.sigma0.is_none() && r.squares() < 1e-15));
        let too_few = space_resection(&object[..2], &image[..2]).unwrap_err();
        assert_eq!(too_few, Degeneracy::TooFew { needed: 3, given: 2 });
        let line: Vec<_> = (0..5).map(|k| Vector3::x() * f64::from(k)).collect();
        assert_eq!(space_resection(&line, &[[0.0; 2]; 5]).unwrap_err(), Degeneracy::Collinear);
    }

    /// A textbook case: c 153.24 mm; the reference solution has sigma0 7.26 µm.
    #[test]
    fn the_textbook_case_is_reproduced() {
        let c = 153.24;
        let photo = [[-86.15, -68.99], [-53.40, 82.21], [-14.78, -76.63], [10.46, 64.43]];
        let object = [
            Vector3::new(36589.41, 25273.32, 2195.17),
            Vector3::new(37631.08, 31324.51, 728.69),
            Vector3::new(39100.97, 24934.98, 2386.50),
            Vector3::new(40426.54, 30319.81, 757.31),
        ];
        let image = photo.map(|[x, y]| [x / c, y / c]);
        let found = &space_resection(&object, &image).expect("solvable")[0];
        let centre = [39795.45, 27476.46, 7572.69];
        let angles = [0.002114, 0.003987, -0.067586];
        for k in 0..3 {
            assert!((found.pose.centre[k] - centre[k]).abs() < 0.006, "{}", found.pose.centre);
            let angle = rotation::angles(&found.pose.object_to_camera)[k];
            assert!((angle - angles[k]).abs() < 6e-7, "{angle} for {}", angles[k]);
        }
        let sigma0_um = found.sigma0.expect("redundancy 2") * c * 1000.0;
        assert!((sigma0_um - 7.26).abs() < 0.006, "{sigma0_um}");
    }
}
