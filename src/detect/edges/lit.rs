//! How light changes across a disc, from its background and its inside: for the operators that have no fit of their own.

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::surround::Surround;
use crate::detect::acceptance::light::{CORE, FLOOR};
use crate::detect::ellipse::outline::Outline;
use crate::detect::shading::{Covariance, Estimates, settled};
use crate::image::{Plane, Sample};

/// Least light that a level is divided by, in units of that at the centre.
const DIMMEST: f64 = 0.1;

/// The slope of a disc's contrast.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Light {
    contrast: f64,
    /// Of the contrast, in grey levels a pixel.
    slope: [f64; 2],
    /// Covariance of the background's slope and that of the contrast, in grey levels a pixel.
    covariance: SMatrix<f64, 4, 4>,
}

impl Light {
    /// Around an outline of this blur; samples from `saturation` on say nothing.
    pub fn of<T: Sample>(plane: &Plane<T>, outline: &Outline, surround: &Surround, blur: f64, saturation: f64) -> Self {
        if f64::from(plane.nearest(outline.u, outline.v)) >= saturation {
            // what is clipped has the same level in any light
            return Self::flat(surround);
        }
        let margin = 3.0 * (blur * blur + 1.0 / 12.0).sqrt() + 0.5;
        Self::settled(surround, inside(plane, outline, surround, margin, saturation))
    }

    /// From the background alone.
    pub fn around(surround: &Surround) -> Self {
        Self::settled(surround, None)
    }

    /// Of a contrast without a slope.
    fn flat(surround: &Surround) -> Self {
        let [uu, uv, vv] = surround.slope_covariance;
        let ground = [[uu + FLOOR, uv], [uv, vv + FLOOR]];
        let covariance = SMatrix::from_fn(|i, j| if i < 2 && j < 2 { ground[i][j] } else { 0.0 });
        Self { contrast: 1.0, slope: [0.0; 2], covariance }
    }

    /// From the slopes of the background and, if it has one of its own, of the disc with its variances.
    fn settled(surround: &Surround, disc: Option<([f64; 2], [f64; 3])>) -> Self {
        let Surround { slope, slope_covariance: [uu, uv, vv], contrast, level, .. } = *surround;
        let ground = [[uu + FLOOR, uv], [uv, vv + FLOOR]];
        // without a disc's own slope that of its contrast may be anything
        let unknown = ([slope[0], slope[1]], [contrast * contrast, 0.0, contrast * contrast]);
        let (own, [own_uu, own_uv, own_vv]) = disc.unwrap_or(unknown);
        let own_covariance = [[own_uu, own_uv], [own_uv, own_vv]];
        let free = Estimates::new(0.0, 0.0, slope[0], slope[1], own[0] - slope[0], own[1] - slope[1]);
        let covariance = Covariance::from_fn(|i, j| match (i / 2, j / 2) {
            (1, 1) => ground[i % 2][j % 2],
            (1, 2) | (2, 1) => -ground[i % 2][j % 2],
            (2, 2) => ground[i % 2][j % 2] + own_covariance[i % 2][j % 2],
            _ => 0.0,
        });
        match settled(&free, &covariance, level, contrast) {
            Some(found) if contrast != 0.0 => Self {
                contrast,
                slope: [found.mean[4], found.mean[5]],
                covariance: found.covariance.fixed_view::<4, 4>(2, 2).into_owned(),
            },
            _ => Self::flat(surround),
        }
    }

    /// Slope of the contrast, in grey levels a pixel.
    pub fn slope(&self) -> [f64; 2] {
        self.slope
    }

    /// The same as a share of the contrast.
    pub fn share(&self) -> [f64; 2] {
        self.slope.map(|slope| slope / self.contrast)
    }

    /// Light at a place from the outline's centre, in units of that at the centre.
    pub fn at(&self, x: f64, y: f64) -> f64 {
        (1.0 + (self.slope[0] * x + self.slope[1] * y) / self.contrast).max(DIMMEST)
    }

    /// Covariance (uu, uv, vv) of a centre that moves by M (dG, dH) with the slopes of background and contrast: M Σ M'.
    pub fn carried(&self, ground: [[f64; 2]; 2], contrast: [[f64; 2]; 2]) -> [f64; 3] {
        let moved = SMatrix::<f64, 2, 4>::from_fn(|i, j| if j < 2 { ground[i][j] } else { contrast[i][j - 2] });
        let carried = moved * self.covariance * moved.transpose();
        [carried[(0, 0)], carried[(0, 1)], carried[(1, 1)]]
    }
}

/// Slope of the levels inside of an outline, further than `margin` from its rim, and its covariance (uu, uv, vv). None where too
/// little is left inside, or it is no plane.
fn inside<T: Sample>(
    plane: &Plane<T>,
    outline: &Outline,
    surround: &Surround,
    margin: f64,
    saturation: f64,
) -> Option<([f64; 2], [f64; 3])> {
    if outline.semi_axes().1 < margin + CORE[0] {
        return None;
    }
    let core = outline.grown(-margin);
    let half = core.half_box().1;
    let (mut normal, mut right, mut square) = (Matrix3::zeros(), Vector3::zeros(), 0.0);
    let reference = surround.level + surround.contrast;
    for y in (core.v - half).max(0.0) as usize..((core.v + half + 1.0).max(0.0) as usize).min(plane.height) {
        let Some((from, to)) = core.chord(y as f64 + 0.5) else { continue };
        for x in (from + 0.5).max(0.0) as usize..((to + 0.5).max(0.0) as usize).min(plane.width) {
            let level = f64::from(plane.row(y)[x].level());
            if level >= saturation || level <= 0.0 {
                return None;
            }
            let row = Vector3::new(1.0, x as f64 + 0.5 - outline.u, y as f64 + 0.5 - outline.v);
            normal += row * row.transpose();
            right += row * (level - reference);
            square += (level - reference).powi(2);
        }
    }
    let free = normal[(0, 0)] - 3.0;
    if free < CORE[1] {
        return None;
    }
    let inverse = normal.try_inverse()?;
    let found = inverse * right;
    // a disc's noise may be the light's own, never less than rounding
    let variance = ((square - found.dot(&right)) / free).max(1.0 / 12.0);
    Some(([found.y, found.z], [(1, 1), (1, 2), (2, 2)].map(|at| variance * inverse[at] + FLOOR)))
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::detect::edges::surround;

    /// A disc of radius 14 in light that rises by this share a pixel, on a background of this level, with an offset that no light changes.
    fn picture(light: f64, ground: f64, offset: f64) -> Vec<u16> {
        let level = |x: f64, y: f64| {
            let own = if x.hypot(y) < 14.0 { 20_000.0 } else { ground };
            offset + (1.0 + light * (x - 0.5 * y)) * own
        };
        let jitter = |i: usize| f64::from((i as u32).wrapping_mul(2_654_435_761) >> 24) - 127.5;
        (0..90 * 90).map(|i| (level((i % 90) as f64 - 44.5, (i / 90) as f64 - 44.5) + jitter(i)) as u16).collect()
    }

    #[test]
    fn the_light_of_a_disc_is_seen_inside_and_around() {
        let outline = Outline::from_axes(45.0, 45.0, 14.0, 14.0, 0.0);
        for (light, ground, offset) in
            [(0.0, 9000.0, 0.0), (0.004, 9000.0, 0.0), (0.004, 300.0, 0.0), (0.004, 9000.0, 3000.0), (-0.002, 4e4, 0.0)]
        {
            let samples = picture(light, ground, offset);
            let plane = Plane::new(90, 90, &samples);
            let surround = surround::measure(&plane, &outline, 0.7, &[true; 48], u32::MAX).unwrap();
            let found = Light::of(&plane, &outline, &surround, 0.7, 65535.0).share();
            assert!((found[0] - light).hypot(found[1] + 0.5 * light) < 2e-4, "{light} {ground} {offset}: {found:?}");
            let around = Light::around(&surround).share();
            if offset == 0.0 && ground > 1000.0 {
                assert!((around[0] - light).hypot(around[1] + 0.5 * light) < 3e-4, "{light} {ground}: {around:?}");
            }
        }
    }
}
