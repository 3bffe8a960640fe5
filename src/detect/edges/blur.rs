//! How blurred a target's edges are, from how steep they are; and the blur above which another method is used.

use super::edge::{self, EdgeProfile};
use super::surround::Surround;
pub(crate) use crate::detect::acceptance::blur::{BLURRED, DEFOCUSED, SHARP, SOFT};
use crate::detect::ellipse::outline::Outline;

/// Variance that the pixel's width (1/12) and bilinear sampling (about 1/6) add to that of the blur, in square pixels.
const SAMPLED: f64 = 0.25;

/// A first estimate where it matters.
pub(crate) fn rough(focus: f64) -> f64 {
    if focus > DEFOCUSED { focus } else { SHARP }
}

/// Blur from the edges' steepness: over two pixels an edge of contrast C and blur s falls by C (2 Φ(1/s) - 1), where
/// s² includes the pixel's own width and that of bilinear sampling.
pub(crate) fn of(strength: f64, contrast: f64) -> f64 {
    if strength <= 0.0 {
        return 1.0;
    }
    let ratio = (strength / contrast.max(1e-9)).clamp(0.05, 0.985);
    // 2 Φ(z) - 1 = ratio, by a rational approximation of Φ^-1 good to 3e-3 (Abramowitz & Stegun 26.2.22)
    let t = (-2.0 * ((1.0 - ratio) / 2.0).ln()).sqrt();
    let z = t - (2.30753 + 0.27061 * t) / (1.0 + t * (0.99229 + 0.04481 * t));
    ((1.0 / z.max(0.05)).powi(2) - SAMPLED).max(0.09).sqrt().min(6.5)
}

/// Profile of the edges of an outline, from its annulus and the edges' steepness; `blur` is a first estimate.
pub(crate) fn profile(outline: &Outline, surround: &Surround, strength: f64, mut blur: f64) -> EdgeProfile {
    // half-way to the rim a small target is not as bright as it would be without blur
    let mut contrast = surround.contrast;
    for _ in 0..3 {
        contrast = surround.contrast / edge::half_way(outline.semi_axes().1, blur);
        blur = of(strength, contrast.abs());
    }
    EdgeProfile {
        level: surround.level,
        slope: surround.slope,
        origin: [outline.u, outline.v],
        contrast,
        light: [0.0; 2],
        blur: (blur * blur + 1.0 / 12.0).sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use statrs::function::erf::erf;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn an_edge_gives_back_its_blur() {
        for s in [0.6f64, 0.9, 1.3, 2.0, 3.5, 6.0] {
            let fall = erf(1.0 / (s * s + SAMPLED).sqrt() / std::f64::consts::SQRT_2);
            let found = of(80.0 * fall, 80.0);
            assert!((found / s - 1.0).abs() < 0.03, "{s}: {found}");
        }
        assert_eq!(of(0.0, 80.0), 1.0);
        // an edge that seems steeper than a step
        assert!(of(90.0, 80.0) >= 0.3);
    }
}
