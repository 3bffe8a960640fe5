//! Illumination gradient across a disc, from its background and its inside, for operators without a fit of their own.
//!
//! Light multiplies. Where it rises by the share h a pixel, the background of level B has the slope G = B h and the disc of level D = B + C the
//! slope D h. With the slopes as measured outside of the rim and inside, their covariances, and a standard deviation τ of what light can do,
//!
//! h = P⁻¹ (B Σ_G⁻¹ G + D Σ_D⁻¹ G_D),   P = B² Σ_G⁻¹ + D² Σ_D⁻¹ + τ⁻²,
//!
//! with the covariance P⁻¹, and B P⁻¹ with G.

use nalgebra::{Matrix2, Matrix3, SMatrix, Vector2, Vector3};

use super::surround::Surround;
use crate::detect::acceptance::fit::FLAT;
use crate::detect::acceptance::light::{CORE, FLOOR, STEEPEST};
use crate::detect::ellipse::outline::Outline;
use crate::image::{Sample, SampleView};

/// Minimum light that a level is divided by, in units of that at the centre.
const DIMMEST: f64 = 0.1;

/// The slope of the light across a disc.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Light {
    /// As a share of the light a pixel.
    pub slope: [f64; 2],
    /// Covariance of the background's slope and that of the contrast, in grey levels a pixel.
    covariance: SMatrix<f64, 4, 4>,
}

impl Light {
    /// Around an outline of this blur, of which nothing is occluded if it is `whole`; samples from `saturation` on say nothing.
    pub fn of<T: Sample>(
        plane: &SampleView<T>,
        outline: &Outline,
        surround: &Surround,
        blur: f64,
        whole: bool,
        saturation: f64,
    ) -> Self {
        let margin = 3.0 * (blur * blur + 1.0 / 12.0).sqrt() + 0.5;
        let [uu, uv, vv] = surround.slope_covariance;
        let ground = Matrix2::new(uu + FLOOR, uv, uv, vv + FLOOR);
        if f64::from(plane.nearest(outline.u, outline.v)) >= saturation {
            // what is saturated has the same level in any light
            let covariance = SMatrix::from_fn(|i, j| if i < 2 && j < 2 { ground[(i, j)] } else { 0.0 });
            return Self { slope: [0.0; 2], covariance };
        }
        let (level, contrast) = (surround.level, surround.contrast);
        let weight = |covariance: &Matrix2<f64>| covariance.try_inverse().unwrap_or_default();
        let mut precision = Matrix2::identity() / (STEEPEST * STEEPEST);
        let mut right = Vector2::zeros();
        let mut observe = |level: f64, slope: Vector2<f64>, covariance: &Matrix2<f64>| {
            let weight = weight(covariance) * level;
            precision += weight * level;
            right += weight * slope;
        };
        let pixels = Pixels { plane, outline, saturation };
        let around = if whole { pixels.around(surround, margin) } else { None };
        let (slope, covariance) = around.unwrap_or((Vector2::from(surround.slope), ground));
        observe(level, slope, &covariance);
        if let Some((slope, covariance)) = pixels.inside(level + contrast, margin) {
            observe(level + contrast, slope, &covariance);
        }
        let own = weight(&precision);
        let slope = own * right;
        let covariance = SMatrix::from_fn(|i, j| match (i / 2, j / 2) {
            (0, 0) => ground[(i, j)],
            (1, 1) => contrast * contrast * own[(i - 2, j - 2)],
            _ => level * contrast * own[(i % 2, j % 2)],
        });
        Self { slope: [slope.x, slope.y], covariance }
    }

    /// Light at a place from the outline's centre, in units of that at the centre.
    pub fn at(&self, x: f64, y: f64) -> f64 {
        (1.0 + self.slope[0] * x + self.slope[1] * y).max(DIMMEST)
    }

    /// Covariance (uu, uv, vv) of a centre that moves by M (dG, dH) with the slopes of background and contrast: M Σ M'.
    pub fn carried(&self, ground: [[f64; 2]; 2], contrast: [[f64; 2]; 2]) -> [f64; 3] {
        let moved = SMatrix::<f64, 2, 4>::from_fn(|i, j| if j < 2 { ground[i][j] } else { contrast[i][j - 2] });
        let carried = moved * self.covariance * moved.transpose();
        [carried[(0, 0)], carried[(0, 1)], carried[(1, 1)]]
    }
}

/// The pixels of a disc and around it.
struct Pixels<'a, T> {
    plane: &'a SampleView<'a, T>,
    outline: &'a Outline,
    saturation: f64,
}

impl<T: Sample> Pixels<'_, T> {
    /// Slope of the levels inside, further than `margin` from the rim, and its covariance. `None` if too little is left, or it is saturated.
    fn inside(&self, reference: f64, margin: f64) -> Option<(Vector2<f64>, Matrix2<f64>)> {
        if self.outline.semi_axes().1 < margin + CORE[0] {
            return None;
        }
        let mut sums = LitPlaneSums::default();
        let mut clipped = false;
        self.visit(&self.outline.grown(-margin), &mut |level, x, y| {
            clipped |= level >= self.saturation || level <= 0.0;
            sums.add(level - reference, x, y);
        });
        if clipped { None } else { sums.slope() }
    }

    /// The same around the disc, as far as its annulus goes; rings of single pixels know less. What is far from the annulus's plane does not
    /// count.
    fn around(&self, surround: &Surround, margin: f64) -> Option<(Vector2<f64>, Matrix2<f64>)> {
        let near = self.outline.grown(margin);
        let mut sums = LitPlaneSums::default();
        let limit = FLAT[0] * surround.noise.max(FLAT[1]);
        self.visit(&self.outline.grown(surround.outer), &mut |level, x, y| {
            let [c, s] = near.normalised(x + self.outline.u, y + self.outline.v);
            let off = level - surround.level - surround.slope[0] * x - surround.slope[1] * y;
            if c * c + s * s > 1.0 && off.abs() <= limit && level < self.saturation {
                sums.add(level - surround.level, x, y);
            }
        });
        sums.slope()
    }

    /// Levels and places, from the outline's centre, of the pixels of an area.
    fn visit(&self, area: &Outline, see: &mut dyn FnMut(f64, f64, f64)) {
        let half = area.half_box().1;
        let rows = |from: f64, to: f64, size: usize| from.max(0.0) as usize..(to.max(0.0) as usize).min(size);
        for y in rows(area.v - half, area.v + half + 1.0, self.plane.height) {
            let Some((from, to)) = area.chord(y as f64 + 0.5) else { continue };
            for x in rows(from + 0.5, to + 0.5, self.plane.width) {
                let place = [x as f64 + 0.5 - self.outline.u, y as f64 + 0.5 - self.outline.v];
                see(f64::from(self.plane.row(y)[x].level()), place[0], place[1]);
            }
        }
    }
}

/// Normal equations of a plane.
#[derive(Default)]
struct LitPlaneSums {
    normal: Matrix3<f64>,
    right: Vector3<f64>,
    square: f64,
}

impl LitPlaneSums {
    fn add(&mut self, level: f64, x: f64, y: f64) {
        let row = Vector3::new(1.0, x, y);
        self.normal += row * row.transpose();
        self.right += row * level;
        self.square += level * level;
    }

    /// The plane's slope and its covariance, from noise that is never less than rounding.
    fn slope(&self) -> Option<(Vector2<f64>, Matrix2<f64>)> {
        let free = self.normal[(0, 0)] - 3.0;
        if free < CORE[1] {
            return None;
        }
        let inverse = self.normal.try_inverse()?;
        let found = inverse * self.right;
        let variance = ((self.square - found.dot(&self.right)) / free).max(1.0 / 12.0);
        let covariance = inverse.fixed_view::<2, 2>(1, 1) * variance + Matrix2::identity() * FLOOR;
        Some((Vector2::new(found.y, found.z), covariance))
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::detect::edges::surround;

    /// A disc of radius 14 in light that rises by this share a pixel, on a background of this level.
    fn picture(light: f64, ground: f64) -> Vec<u16> {
        let level = |x: f64, y: f64| {
            let own = if x.hypot(y) < 14.0 { 20_000.0 } else { ground };
            (1.0 + light * (x - 0.5 * y)) * own
        };
        let jitter = |i: usize| f64::from((i as u32).wrapping_mul(2_654_435_761) >> 24) - 127.5;
        (0..90 * 90).map(|i| (level((i % 90) as f64 - 44.5, (i / 90) as f64 - 44.5) + jitter(i)) as u16).collect()
    }

    #[test]
    fn the_light_of_a_disc_is_seen_inside_and_around() {
        let outline = Outline::from_axes(45.0, 45.0, 14.0, 14.0, 0.0);
        for (light, ground) in [(0.0, 9000.0), (0.004, 9000.0), (0.004, 300.0), (-0.002, 4e4)] {
            let samples = picture(light, ground);
            let plane = SampleView::new(90, 90, &samples);
            let surround = surround::measure(&plane, &outline, 0.7, &[true; 48], u32::MAX).unwrap();
            let found = Light::of(&plane, &outline, &surround, 0.7, true, 65535.0).slope;
            assert!((found[0] - light).hypot(found[1] + 0.5 * light) < 2e-4, "{light} {ground}: {found:?}");
        }
    }
}
