//! Similarity transform (7 parameters) between two systems, with its statistics.
//!
//! Closed form by singular values: Arun, Huang and Blostein (1987); Umeyama (1991), IEEE Transactions on Pattern
//! Analysis and Machine Intelligence 13, 376-380.

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::{Degeneracy, Pose, PrincipalAxes};

/// X' = target_centroid + scale · R · (X - source_centroid).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    /// Ratio of lengths, target over source.
    pub scale: f64,
    /// R, source to target.
    pub rotation: Matrix3<f64>,
    /// Centroid of the points in the source system.
    pub source_centroid: Vector3<f64>,
    /// Centroid of the points in the target system.
    pub target_centroid: Vector3<f64>,
}

/// A fitted similarity transform and how well it fits.
#[derive(Clone, Debug, PartialEq)]
pub struct SimilarityFit {
    /// The transform.
    pub transform: Similarity,
    /// Transformed minus target, per point.
    pub residuals: Vec<Vector3<f64>>,
    /// 3n - 7.
    pub redundancy: usize,
    /// Standard deviation of a coordinate, √(Σv²/redundancy); `None` without redundancy.
    pub sigma0: Option<f64>,
    /// Standard errors of the target centroid, target units; 0 without redundancy, like those below.
    pub sigma_translation: Vector3<f64>,
    /// Standard errors of small turns about the target axes, radians.
    pub sigma_rotation: Vector3<f64>,
    /// Standard error of the scale.
    pub sigma_scale: f64,
}

impl Similarity {
    /// No change.
    pub fn identity() -> Self {
        Self {
            scale: 1.0,
            rotation: Matrix3::identity(),
            source_centroid: Vector3::zeros(),
            target_centroid: Vector3::zeros(),
        }
    }

    /// A point of the source system in the target system.
    pub fn point(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.target_centroid + self.scale * (self.rotation * (point - self.source_centroid))
    }

    /// A photo oriented in the source system, in the target system.
    pub fn pose(&self, pose: &Pose) -> Pose {
        Pose { object_to_camera: pose.object_to_camera * self.rotation.transpose(), centre: self.point(&pose.centre) }
    }
}

/// The similarity transform of least squared differences that transforms `source` to `target` (paired, any units).
///
/// # Errors
/// [`Degeneracy::TooFew`] below three points, [`Degeneracy::Collinear`] when either set lies on a line.
pub fn fit(source: &[Vector3<f64>], target: &[Vector3<f64>]) -> Result<SimilarityFit, Degeneracy> {
    let n = source.len().min(target.len());
    if n < 3 {
        return Err(Degeneracy::TooFew { needed: 3, given: n });
    }
    let (from, to) = (PrincipalAxes::of(&source[..n])?, PrincipalAxes::of(&target[..n])?);
    if from.is_line() || to.is_line() {
        return Err(Degeneracy::Collinear);
    }
    let (from_size, to_size) = (from.extent.norm(), to.extent.norm());
    // Reduced to unit size, so that metres against millimetres or pixels cost no digits.
    let reduced = |p: &Vector3<f64>, spread: &PrincipalAxes, size: f64| (p - spread.centroid) / size;
    let mut cross = Matrix3::zeros();
    let mut norm = 0.0;
    for (p, q) in source.iter().zip(target) {
        let (p, q) = (reduced(p, &from, from_size), reduced(q, &to, to_size));
        cross += q * p.transpose();
        norm += p.norm_squared();
    }
    let svd = cross.svd(true, true);
    let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else { return Err(Degeneracy::NoSolution) };
    let mut sign = Vector3::new(1.0, 1.0, (u * v_t).determinant().signum());
    // nalgebra sorts singular values in descending order: the sign belongs to the last, smallest one.
    let rotation = u * Matrix3::from_diagonal(&sign) * v_t;
    sign.component_mul_assign(&svd.singular_values);
    let scale = sign.sum() / norm * to_size / from_size;
    if !(scale > 0.0) || !scale.is_finite() {
        return Err(Degeneracy::NoSolution);
    }
    let transform = Similarity { scale, rotation, source_centroid: from.centroid, target_centroid: to.centroid };
    Ok(with_statistics(transform, &source[..n], &target[..n]))
}

/// Residuals and standard errors. About the centroids the normal equations split: translation n·I, scale Σ|RX|²,
/// rotation Σ(|Y|²I - YYᵀ) with Y = scale·R·(X - centroid).
fn with_statistics(transform: Similarity, source: &[Vector3<f64>], target: &[Vector3<f64>]) -> SimilarityFit {
    let n = source.len();
    let residuals: Vec<_> = source.iter().zip(target).map(|(p, q)| transform.point(p) - q).collect();
    let redundancy = 3 * n - 7;
    let squares: f64 = residuals.iter().map(Vector3::norm_squared).sum();
    let sigma0 = (redundancy > 0).then(|| (squares / redundancy as f64).sqrt());
    let mut turn = Matrix3::zeros();
    let mut stretch = 0.0;
    for p in source {
        let y = transform.point(p) - transform.target_centroid;
        turn += Matrix3::identity() * y.norm_squared() - y * y.transpose();
        stretch += y.norm_squared() / (transform.scale * transform.scale);
    }
    let s = sigma0.unwrap_or(0.0);
    let turn_cofactors: SMatrix<f64, 3, 3> = turn.try_inverse().unwrap_or_else(Matrix3::zeros);
    SimilarityFit {
        transform,
        residuals,
        redundancy,
        sigma0,
        sigma_translation: Vector3::repeat(s / (n as f64).sqrt()),
        sigma_rotation: turn_cofactors.diagonal().map(|q| s * q.max(0.0).sqrt()),
        sigma_scale: s / stretch.sqrt(),
    }
}

/// The similarity transform of the points that agree with each other: samples of three, then a fit of all points
/// within three robust standard deviations, with the flags of the points that took part.
///
/// # Errors
/// As [`fit`].
pub fn fit_robust(
    source: &[Vector3<f64>],
    target: &[Vector3<f64>],
    seed: u64,
) -> Result<(SimilarityFit, Vec<bool>), Degeneracy> {
    let n = source.len().min(target.len());
    let everything = fit(source, target)?;
    if n < 5 {
        return Ok((everything, vec![true; n]));
    }
    let lengths =
        |t: &Similarity| -> Vec<f64> { source.iter().zip(target).map(|(p, q)| (t.point(p) - q).norm()).collect() };
    let mut generator = super::robust::generator(seed);
    let mut best = (super::robust::quantile(&lengths(&everything.transform), 0.5), everything.transform);
    for _ in 0..200 {
        let chosen: [usize; 3] = super::robust::sample(&mut generator, n);
        let Ok(trial) = fit(&chosen.map(|k| source[k]), &chosen.map(|k| target[k])) else { continue };
        let median = super::robust::quantile(&lengths(&trial.transform), 0.5);
        if median < best.0 {
            best = (median, trial.transform);
        }
    }
    let mut transform = best.1;
    let mut kept = vec![true; n];
    let mut result = everything;
    for _ in 0..3 {
        let all = lengths(&transform);
        // The median length of three-dimensional residuals is 1.538 standard deviations of a coordinate.
        let limit = 4.0 * super::robust::quantile(&all, 0.5) / 1.538 * (1.0 + 5.0 / n as f64)
            + 1e-12 * PrincipalAxes::of(target)?.extent.norm();
        kept = all.iter().map(|length| *length <= limit).collect();
        let pick = |points: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
            points.iter().zip(&kept).filter(|(_, keep)| **keep).map(|(p, _)| *p).collect()
        };
        result = fit(&pick(source), &pick(target))?;
        transform = result.transform;
    }
    Ok((result, kept))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::robust::{generator, uniform};
    use crate::rotation::object_to_camera;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn gauss(g: &mut rand_chacha::ChaCha8Rng) -> f64 {
        (0..12).map(|_| uniform(g)).sum::<f64>() - 6.0
    }

    fn figure(n: usize, seed: u64) -> Vec<Vector3<f64>> {
        let mut g = generator(seed);
        (0..n).map(|_| Vector3::new(gauss(&mut g), gauss(&mut g), 0.2 * gauss(&mut g))).collect()
    }

    fn truth() -> Similarity {
        Similarity {
            scale: 1234.5,
            rotation: object_to_camera([2.0, -0.9, 0.4]),
            source_centroid: Vector3::new(0.1, 0.2, 0.3),
            target_centroid: Vector3::new(1e6, -2e6, 300.0),
        }
    }

    #[test]
    fn an_exact_transform_is_found_in_large_coordinates() {
        let source = figure(6, 1);
        let target: Vec<_> = source.iter().map(|p| truth().point(p)).collect();
        let found = fit(&source, &target).expect("a spatial figure");
        assert!((found.transform.scale / 1234.5 - 1.0).abs() < 1e-11);
        assert!((found.transform.rotation - truth().rotation).norm() < 1e-11);
        assert!(found.residuals.iter().all(|v| v.norm() < 1e-8));
        assert_eq!(found.redundancy, 11);
    }

    #[test]
    fn planes_are_fine_lines_and_pairs_are_named() {
        let plane = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::new(1.0, 2.0, 0.0)];
        let target = plane.map(|p| truth().point(&p));
        assert!((fit(&plane, &target).expect("a plane").transform.rotation - truth().rotation).norm() < 1e-10);
        let line = [0.0, 1.0, 2.0].map(|t| Vector3::new(t, 2.0 * t, -t));
        assert_eq!(fit(&line, &line).unwrap_err(), Degeneracy::Collinear);
        assert_eq!(fit(&plane[..2], &target[..2]).unwrap_err(), Degeneracy::TooFew { needed: 3, given: 2 });
    }

    #[test]
    fn standard_errors_are_those_of_repeated_noise() {
        let source = figure(12, 2);
        let mut g = generator(3);
        let runs = 1500;
        let (mut scale, mut turn, mut stated) = (0.0, Vector3::zeros(), None);
        for _ in 0..runs {
            let noise = 0.5;
            let target: Vec<_> = source
                .iter()
                .map(|p| truth().point(p) + noise * Vector3::new(gauss(&mut g), gauss(&mut g), gauss(&mut g)))
                .collect();
            let found = fit(&source, &target).expect("a spatial figure");
            scale += (found.transform.scale - 1234.5).powi(2);
            let small = found.transform.rotation * truth().rotation.transpose();
            turn += Vector3::new(small[(2, 1)], small[(0, 2)], small[(1, 0)]).map(|t| t * t);
            let s = found.sigma0.expect("redundant");
            stated = Some((found.sigma_scale / s * noise, found.sigma_rotation / s * noise));
        }
        let (sigma_scale, sigma_rotation) = stated.expect("runs");
        assert!(((scale / f64::from(runs)).sqrt() / sigma_scale - 1.0).abs() < 0.07);
        for k in 0..3 {
            assert!(((turn[k] / f64::from(runs)).sqrt() / sigma_rotation[k] - 1.0).abs() < 0.07);
        }
    }

    #[test]
    fn wrong_pairs_do_not_bend_the_robust_fit() {
        let source = figure(20, 4);
        let mut target: Vec<_> = source.iter().map(|p| truth().point(p)).collect();
        target.swap(2, 7);
        target[11] += Vector3::new(900.0, 0.0, 0.0);
        let (found, kept) = fit_robust(&source, &target, 0).expect("mostly right");
        assert_eq!(kept.iter().filter(|k| !**k).count(), 3);
        assert!((found.transform.scale / 1234.5 - 1.0).abs() < 1e-10);
    }
}
