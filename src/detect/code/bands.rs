//! Predicted levels of the parts of a design along each ray: the model of [`radial`](super::radial), which depends only on a
//! dot's outline and blur. Every perspective has the same, opposite rays have the same, and so has each ray's normal matrix.

use std::ops::Range;
use std::rc::Rc;

use nalgebra::{Cholesky, Const, Matrix4, Vector4};

use super::polar::{RingRays, between, radius};
use super::radial::{GROUND, START};
use crate::ring_code::Design;

/// Weight of the condition on bands hidden by blur, relative to that of a visible one.
const RIDGE: f64 = 0.02;

pub(super) type RayFactor = Cholesky<f64, Const<4>>;

/// Contributions to a sample: the dot, gap, ring, difference of the ring's halves, and outside.
#[derive(Clone, Copy, Debug)]
pub(super) struct BandSample {
    pub dot: f64,
    pub basis: Vector4<f64>,
}

/// The bands of every ray and sample.
#[derive(Debug)]
pub(super) struct Bands {
    pub rays: Rc<RingRays>,
    /// Inner and outer radius of the ring.
    pub design: [f64; 2],
    /// Samples of a ray that are explained.
    pub samples: Range<usize>,
    /// Of the first half of the rays.
    bands: Vec<BandSample>,
    factors: Vec<Option<RayFactor>>,
}

impl Bands {
    /// Of a design around a dot.
    pub fn of(rays: Rc<RingRays>, design: Design) -> Self {
        let [inner, outer] = design.ring();
        let rims = [1.0, inner, (inner + outer) / 2.0, outer, outer + GROUND];
        let samples = between([START, outer + GROUND]);
        let band = |j: usize, k: usize| {
            let [dot, gap, first, second, outside] = rays.bands(radius(k), rims, j);
            BandSample { dot, basis: Vector4::new(gap, first + second, (first - second) / 2.0, outside) }
        };
        let half = rays.directions.len() / 2;
        let bands = (0..half).flat_map(|j| samples.clone().map(move |k| (j, k))).map(|(j, k)| band(j, k)).collect();
        let mut all = Self { rays, design: [inner, outer], samples, bands, factors: Vec::new() };
        all.factors = (0..half).map(|j| all.factor_of(all.row(j).iter())).collect();
        all
    }

    /// The bands of a ray's samples.
    pub fn row(&self, direction: usize) -> &[BandSample] {
        let direction = direction % (self.rays.directions.len() / 2);
        &self.bands[direction * self.samples.len()..][..self.samples.len()]
    }

    /// Factor of the normal matrix of a ray.
    pub fn factor(&self, direction: usize) -> Option<RayFactor> {
        self.factors[direction % self.factors.len()]
    }

    /// The same of some of a ray's samples.
    pub fn factor_of<'a>(&self, bands: impl Iterator<Item = &'a BandSample>) -> Option<RayFactor> {
        let mut normal = Matrix4::<f64>::zeros();
        bands.for_each(|BandSample { basis, .. }| normal += basis * basis.transpose());
        let ridge = RIDGE * self.samples.len() as f64;
        for k in 0..4 {
            normal[(k, k)] += ridge * if k == 2 { 0.5 } else { 0.1 };
        }
        normal.cholesky()
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::detect::outline::Outline;

    #[test]
    fn opposite_rays_have_the_same_bands() {
        let rays = Rc::new(RingRays::of(Outline::from_axes(50.0, 40.0, 9.0, 5.0, 0.7), 0.9));
        let bands = Bands::of(rays.clone(), Design::Metashape);
        let [inner, outer] = Design::Metashape.ring();
        let rims = [1.0, inner, (inner + outer) / 2.0, outer, outer + GROUND];
        for j in 0..rays.directions.len() {
            let mut normal = Matrix4::<f64>::zeros();
            for (k, band) in bands.samples.clone().zip(bands.row(j)) {
                let [dot, gap, first, second, outside] = rays.bands(radius(k), rims, j);
                let own = Vector4::new(gap, first + second, (first - second) / 2.0, outside);
                assert!((band.dot - dot).abs() < 1e-9 && (band.basis - own).amax() < 1e-9, "{j} {k}");
                normal += own * own.transpose();
            }
            let factor = bands.factor(j).unwrap();
            let ridge = factor.l() * factor.l().transpose() - normal;
            assert!((ridge[(0, 0)] - 0.002 * bands.samples.len() as f64).abs() < 1e-6, "{ridge}");
            assert!(ridge[(0, 1)].abs() < 1e-6);
        }
    }
}
