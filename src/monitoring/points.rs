//! Displacements of single points with their tests, confidence ellipsoids and detectable sizes.
//!
//! T_i = d_iᵀ C_i⁺ d_i / r against F(r, f), r = rank(C_i) = 3 but for points held on an axis. A displacement δ along the unit vector u has the
//! non-centrality λ = δ² uᵀC⁺u; with the λ₀ at which the test reaches the wanted power, the smallest detectable one is √(λ₀ / uᵀC⁺u), and
//! √(λ₀ μ) with the largest eigenvalue μ of C along the least favourable direction.

use std::collections::HashMap;

use nalgebra::{Matrix3, Vector3};

use super::congruence::pseudo_inverse3;
use super::judgement::{judged, levels};
use super::request::Options;
use super::result::{Detectable, Displacement, Ellipsoid, PointRole, Test};
use crate::statistics::fisher::Fisher;

/// A point with its coordinates in two epochs.
pub struct PointDifference {
    /// Identifier.
    pub id: String,
    /// Another name in the later epoch.
    pub later_id: Option<String>,
    /// Role.
    pub role: PointRole,
    /// Coordinates in the earlier epoch.
    pub xyz: Vector3<f64>,
    /// Displacement.
    pub d: Vector3<f64>,
    /// Its covariance.
    pub covariance: Matrix3<f64>,
}

/// Ω and rank of a displacement.
pub fn omega(d: &Vector3<f64>, covariance: &Matrix3<f64>) -> (f64, usize) {
    let (inverse, rank) = pseudo_inverse3(covariance);
    (d.dot(&(inverse * d)).max(0.0), rank)
}

/// Judges displacements. `certain`: whether there is a stable group, without which single points are not tested.
pub fn displacements(
    points: Vec<PointDifference>,
    f: Option<f64>,
    options: &Options,
    certain: bool,
) -> Vec<Displacement> {
    let alpha = options.significance;
    let forms: Vec<(f64, usize)> = points.iter().map(|p| omega(&p.d, &p.covariance)).collect();
    let tested = |k: usize| points[k].role == PointRole::Object && forms[k].1 > 0;
    let family: Vec<usize> = (0..points.len()).filter(|&k| tested(k)).collect();
    let p: Vec<f64> = family.iter().map(|&k| judged_p(forms[k], f)).collect();
    let mut level: Vec<f64> = vec![alpha; points.len()];
    family.iter().zip(levels(&p, options.correction, alpha)).for_each(|(&k, own)| level[k] = own);
    // The largest of many is held against α/m: that of one moved point among them.
    let first = levels(&vec![0.0; family.len()], options.correction, alpha).into_iter().fold(alpha, f64::min);
    let factor = 3.0 * Fisher::new(3, f).limit(alpha);
    let mut limits: HashMap<(usize, u64), f64> = HashMap::new();
    let mut noncentralities: HashMap<(usize, u64), f64> = HashMap::new();
    let one = |(k, point): (usize, PointDifference)| {
        let (omega, rank) = forms[k];
        let test = (rank > 0 && certain).then(|| {
            let limit = || Fisher::new(rank, f).limit(level[k]);
            let limit = *limits.entry((rank, level[k].to_bits())).or_insert_with(limit);
            let p = judged_p(forms[k], f);
            let statistic = (omega / rank as f64).min(1e300);
            Test { statistic, f1: rank as f64, f2: f, limit, p, passed: p > level[k] }
        });
        let own = if point.role == PointRole::Object { first } else { alpha };
        let detectable = (rank > 0).then(|| {
            let law = Fisher::new(rank, f);
            let lambda = || law.noncentrality(law.limit(own), options.power);
            detectable(&point.covariance, *noncentralities.entry((rank, own.to_bits())).or_insert_with(lambda))
        });
        let sigma: [f64; 3] = std::array::from_fn(|a| point.covariance[(a, a)].max(0.0).sqrt());
        let length = point.d.norm();
        let along = point.d / length;
        let length_sigma = (length > 0.0).then(|| along.dot(&(point.covariance * along)).max(0.0).sqrt());
        let c = &point.covariance;
        let moved = point.role == PointRole::Object && test.is_some_and(|test| !test.passed);
        Displacement {
            id: point.id,
            later_id: point.later_id,
            role: point.role,
            xyz: point.xyz.into(),
            difference: point.d.into(),
            sigma,
            covariance: [c[(0, 0)], c[(0, 1)], c[(0, 2)], c[(1, 1)], c[(1, 2)], c[(2, 2)]],
            length,
            length_sigma,
            test,
            moved,
            ellipsoid: (rank > 0).then(|| ellipsoid(c, factor)),
            detectable,
        }
    };
    points.into_iter().enumerate().map(one).collect()
}

fn judged_p((omega, rank): (f64, usize), f: Option<f64>) -> f64 {
    Fisher::new(rank, f).tails(omega / rank.max(1) as f64)[1]
}

fn ellipsoid(covariance: &Matrix3<f64>, factor: f64) -> Ellipsoid {
    let eigen = covariance.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    Ellipsoid {
        semi_axes: order.map(|k| (factor * eigen.eigenvalues[k].max(0.0)).sqrt()),
        directions: order.map(|k| {
            let v = eigen.eigenvectors.column(k);
            [v[0], v[1], v[2]]
        }),
    }
}

/// Smallest detectable displacements for a non-centrality.
pub fn detectable(covariance: &Matrix3<f64>, lambda: f64) -> Detectable {
    let (inverse, _) = pseudo_inverse3(covariance);
    let axes = std::array::from_fn(|a| {
        // Along an axis without free coordinates no displacement can be found.
        let weight = inverse[(a, a)];
        (weight > 0.0 && covariance[(a, a)] > 0.0).then(|| (lambda / weight).sqrt()).filter(|d| d.is_finite())
    });
    let largest = covariance.symmetric_eigenvalues().max().max(0.0);
    Detectable { axes, worst: (lambda * largest).sqrt() }
}

/// Reference points that pass their tests in a datum, and those that do not.
pub fn sorted(
    points: &[(usize, Vector3<f64>, Matrix3<f64>)],
    f: Option<f64>,
    options: &Options,
) -> (Vec<usize>, Vec<usize>) {
    let tests: Vec<(f64, usize)> = points.iter().map(|(_, d, c)| omega(d, c)).collect();
    let p: Vec<f64> = tests.iter().map(|form| if form.1 == 0 { 1.0 } else { judged_p(*form, f) }).collect();
    let levels = levels(&p, options.correction, options.significance);
    let (mut stable, mut unstable) = (Vec::new(), Vec::new());
    for ((k, _, _), (p, level)) in points.iter().zip(p.iter().zip(levels)) {
        if *p > level { stable.push(*k) } else { unstable.push(*k) }
    }
    (stable, unstable)
}

/// Test of one displacement by itself.
pub fn single(d: &Vector3<f64>, covariance: &Matrix3<f64>, f: Option<f64>, alpha: f64) -> Option<Test> {
    let (omega, rank) = omega(d, covariance);
    (rank > 0).then(|| judged(omega, rank, f, alpha))
}
