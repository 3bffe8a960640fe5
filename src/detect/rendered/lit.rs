//! Grey levels of a fit with an illumination gradient across the target.
//!
//! Light multiplies: lens, lamps and shading make it change by the share h a pixel, and the background of level B has the slope B h, the disc
//! of level B + C the slope (B + C) h. A gamma curve leaves that as it is, (L R)^(1/γ) = L^(1/γ) R^(1/γ), with h / γ for h. The model is
//!
//! m(x, y) = t (1 + h·(x, y)), t = B + C I, with I the share of the disc in a pixel,
//!
//! and its unknown slope g = L h in grey levels a pixel of the level L that stays as it is while the fit goes on: dm/dg = t / L (x, y). The
//! other derivatives are taken in even light: what they lack, a few hundredths at the rim, changes the way and not the limit.
//!
//! One slope for both levels costs a centre 1 to 6 % of its standard error against none at all, where a slope of its own for the disc would cost
//! 10 to 160 %; before black, where nothing but the disc shows the light, it costs what that one does.
//!
//! Where neighbours leave no background but a gap, what they throw into it passes for such a slope. What has no fit there is fitted with a slope
//! that adds to all levels alike, which the flat inside of the disc determines. Its errors stay within what the neighbours' light adds to the
//! covariance (`tests/engine/detect/light.rs`: error / sigma 0.93 at pitches of 1.2 to 1.5 diameters in light that changes by up to a tenth).

use crate::detect::edges::surround::Surround;

/// Levels of background and disc, and the slope of the light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lit {
    /// Level of the background at the place that the slope is counted from.
    pub ground: f64,
    /// Disc less background there.
    pub contrast: f64,
    /// Slope of the light, in grey levels a pixel where the level is `reference`.
    pub slope: [f64; 2],
    reference: f64,
    /// Whether the disc's level has a slope of its own size; else all have that of the reference, which adds to them.
    multiplies: bool,
}

impl Lit {
    /// From the levels of an annulus and the slope of the light as a share of it a pixel, or from the annulus's own that adds.
    pub fn of(surround: &Surround, light: [f64; 2], multiplies: bool) -> Self {
        let lit = Self::new(surround.level, surround.contrast, light);
        if multiplies { lit } else { Self { slope: surround.slope, multiplies, ..lit } }
    }

    /// From levels of background and contrast, and the slope of the light as a share of it a pixel.
    pub fn new(ground: f64, contrast: f64, light: [f64; 2]) -> Self {
        let reference = ground.abs().max((ground + contrast).abs()).max(1.0);
        Self { ground, contrast, slope: light.map(|light| light * reference), reference, multiplies: true }
    }

    /// Slope of the light, as a share of it a pixel.
    pub fn light(&self) -> [f64; 2] {
        self.slope.map(|slope| slope / self.reference)
    }

    /// Level in even light of a pixel of which the disc has this share.
    pub fn tone(&self, share: f64) -> f64 {
        self.ground + share * self.contrast
    }

    /// Slope of such a pixel's level with the slope of the light.
    pub fn steepness(&self, share: f64) -> f64 {
        if self.multiplies { self.tone(share) / self.reference } else { 1.0 }
    }

    /// Light at a place, 1 where the slope is counted from.
    pub fn at(&self, x: f64, y: f64) -> f64 {
        1.0 + (self.slope[0] * x + self.slope[1] * y) / self.reference
    }

    /// Counts the slope from a place that lies so far from the one before.
    pub fn shift(&mut self, x: f64, y: f64) {
        let light = self.at(x, y).max(0.1);
        (self.ground, self.contrast) = (self.ground * light, self.contrast * light);
        self.slope = self.slope.map(|slope| slope / light);
    }

    /// Adds corrections of contrast, background and slope.
    pub fn add(&mut self, corrections: &[f64]) {
        let values = [&mut self.contrast, &mut self.ground].into_iter().chain(&mut self.slope);
        values.zip(corrections).for_each(|(value, correction)| *value += correction);
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn the_place_that_a_slope_is_counted_from_changes_no_level() {
        let lit = Lit::new(30.0, 120.0, [0.004, -0.003]);
        let mut moved = lit;
        moved.shift(1.5, -2.0);
        for (share, x, y) in [(0.0, 3.0, 1.0), (1.0, -7.0, 4.0), (0.4, 0.0, 0.0)] {
            let [before, after] = [lit.tone(share) * lit.at(x, y), moved.tone(share) * moved.at(x - 1.5, y + 2.0)];
            assert!((before - after).abs() < 1e-12, "{share} {x} {y}: {before} {after}");
        }
        assert!((lit.light()[0] - 0.004).abs() < 1e-15);
    }
}
