//! Effect of a rim that is not an ellipse on the centre.
//!
//! A rim that departs from its ellipse by a cos kθ + b sin kθ pixels, θ its eccentric angle, leaves the light
//!
//! l = -C g(d; s) cos kθ, and the same with the sine,
//!
//! in the pixels at distance d, g the density of the normal distribution whose deviation s is that of blur and pixel together. The fit takes
//! the part Jᵀl of it for a shift x = N⁻¹Jᵀl, and leaves a = Σ r l / (Σ l² - xᵀJᵀl) to be read off the residuals r. Of a circle the shift is
//! nothing, of an ellipse of ratio 0.8 some eighth of the departure. k = 2 is an ellipse, even k are the same on opposite
//! sides and move no centre; k = 5 and more move it by less than a tenth of what k = 3 does.

use super::band::{Band, NormalMatrix};
use crate::detect::ellipse::outline::Outline;

/// Waves around the rim that move a centre.
const WAVES: f64 = 3.0;

impl Band {
    /// Squares and product of the shifts of the centre by the departures that the residuals show: uu, uv, vv. The residuals are kept.
    pub fn shifts_by_shape(
        &mut self,
        outline: &Outline,
        origin: [f64; 2],
        blur: f64,
        contrast: f64,
        cofactors: &NormalMatrix,
    ) -> [f64; 3] {
        let near = Outline { u: outline.u - origin[0], v: outline.v - origin[1], ..*outline };
        let width = (blur * blur + 1.0 / 12.0).sqrt();
        let density = 1.0 / (width * std::f64::consts::TAU.sqrt());
        let residuals = self.residual.clone();
        let mut shifts = [0.0; 3];
        let kept: Vec<f32> = residuals.iter().zip(&self.kept).map(|(r, kept)| r * kept).collect();
        for quarter in [0.0, std::f64::consts::FRAC_PI_2] {
            let right = self.right_of_light(contrast, |x, y| {
                let [c, s] = near.normalised(x, y);
                density * (-0.5 * (near.distance(x, y) / width).powi(2)).exp() * (WAVES * s.atan2(c) - quarter).cos()
            });
            // the light itself stands where the residuals were
            let light = &self.residual;
            let product = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| f64::from(a * b)).sum::<f64>();
            let moved = cofactors * right;
            let left = product(light, light) - moved.dot(&right);
            if left > 0.0 {
                let amount = product(&kept, light) / left;
                let [u, v] = [amount * moved[0], amount * moved[1]];
                shifts = [shifts[0] + u * u, shifts[1] + u * v, shifts[2] + v * v];
            }
        }
        self.residual = residuals;
        shifts
    }
}
