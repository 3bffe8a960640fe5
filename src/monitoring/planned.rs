//! What two identical campaigns of a planned network will be able to show, before the first photo.
//!
//! Both have the planned cofactors Q in the datum of the reference points, so that d = x₂ - x₁ has Q_d = 2Q with σ0 = 1 and f = 2r degrees
//! of freedom, r the planned redundancy. The tests are those of [`super::points`] and [`super::congruence`], with the same non-centralities:
//!
//! - an object point is tested by itself at α/m (m object points, Holm's correction for the largest): δ² uᵀQ_d⁻¹u = λ₀(3, f);
//! - a reference point has to be found by the global test first, and then by itself, in the datum of the others:
//!   δ² uᵀQ'⁻¹u = max(λ₀(h, f), λ₀(3, f)). Its weight in the global test is at least Q'⁻¹, so that it is found at least with the stated power.
//!
//! In the datum of the other reference points a point's covariance is Q' = K Q Kᵀ, K = (I - G_i (ΣG_jᵀG_j)⁻¹ G_iᵀ)⁻¹: inner constraints
//! say Σ G_jᵀx_j = 0, so that those of the others are missing just the point's own share -G_iᵀx_i.

use nalgebra::{Matrix3, Vector3};

use super::LEAST;
use super::covariance::ReferenceDatum;
use super::judgement::levels;
use super::points;
use super::request::Options;
use super::result::Detectable;
use crate::statistics::fisher::Fisher;

/// A planned network.
pub struct PlannedNetwork<'a> {
    /// Places of its points.
    pub places: &'a [Vector3<f64>],
    /// Their covariances in the datum of the reference points, for σ0 = 1.
    pub covariances: &'a [Matrix3<f64>],
    /// Places of the reference points in these lists.
    pub reference: &'a [usize],
    /// Whether its scale is its own, so that the datum leaves six directions free instead of seven.
    pub scaled: bool,
    /// Its redundancy.
    pub redundancy: usize,
}

/// Smallest displacement of each point that a comparison of two such campaigns finds with the power of the options. `None` for all points if
/// the reference points lie on a line; `None` for a reference point if there are only [`LEAST`] of them (the elimination stops there, so that
/// the comparison cannot name it) or if the others lie on a line.
pub fn detectable(network: &PlannedNetwork<'_>, options: &Options) -> Vec<Option<Detectable>> {
    let n = network.places.len();
    let defect = if network.scaled { 6 } else { 7 };
    let carriers: Vec<(usize, f64)> = network.reference.iter().map(|k| (*k, 1.0)).collect();
    let Some(datum) = ReferenceDatum::new(network.places, &carriers, defect) else { return vec![None; n] };
    let f = (network.redundancy > 0).then_some(2.0 * network.redundancy as f64);
    let objects = n - network.reference.len();
    let own_level = |tested: usize| {
        levels(&vec![0.0; tested], options.correction, options.significance)
            .into_iter()
            .fold(options.significance, f64::min)
    };
    let noncentrality = |rank: usize, level: f64| {
        let law = Fisher::new(rank, f);
        law.noncentrality(law.limit(level), options.power)
    };
    let of_object = noncentrality(3, own_level(objects));
    let global = noncentrality((3 * network.reference.len()).saturating_sub(defect).max(1), options.significance);
    let of_reference = global.max(noncentrality(3, own_level(objects + 1)));
    let mut is_reference = vec![false; n];
    network.reference.iter().for_each(|k| is_reference[*k] = true);
    let one = |k: usize| {
        let twice = network.covariances[k] * 2.0;
        if !is_reference[k] {
            return Some(points::detectable(&twice, of_object));
        }
        let others = (network.reference.len() > LEAST).then(|| datum.of_others(k)).flatten()?;
        Some(points::detectable(&(others * twice * others.transpose()), of_reference))
    };
    (0..n).map(one).map(|found| found.filter(|d| d.worst > 0.0 && d.worst.is_finite())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::robust::{generator, uniform};
    use crate::monitoring::covariance::{PointsCovariance, Transformed};
    use nalgebra::DMatrix;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    /// The covariance of a reference point in the datum of the others, by its own block alone, is that of the S-transformation of all.
    #[test]
    fn a_point_in_the_datum_of_the_others_needs_its_own_block_only() {
        for (seed, defect) in [(1, 6), (2, 7), (3, 6), (4, 7)] {
            let mut g = generator(seed);
            let n = 9;
            let places: Vec<Vector3<f64>> = (0..n).map(|_| Vector3::from_fn(|_, _| 50.0 * uniform(&mut g))).collect();
            let a = DMatrix::from_fn(3 * n, 3 * n, |_, _| uniform(&mut g) - 0.5);
            let full = PointsCovariance::Full(&a * a.transpose());
            let reference = [0, 2, 3, 5, 8];
            let weighted = |skipped: usize| -> Vec<(usize, f64)> {
                reference.iter().filter(|k| **k != skipped).map(|k| (*k, 1.0)).collect()
            };
            let datum = ReferenceDatum::new(&places, &weighted(n), defect).expect("a datum");
            let in_datum = Transformed::new(&full, &datum);
            for k in reference {
                let others = ReferenceDatum::new(&places, &weighted(k), defect).expect("a datum");
                let expected = Transformed::new(&full, &others).block(k, k);
                let by = datum.of_others(k).expect("not on a line");
                let found = by * in_datum.block(k, k) * by.transpose();
                assert!((found - expected).norm() < 1e-8 * expected.norm(), "{k}: {found} {expected}");
            }
        }
    }
}
