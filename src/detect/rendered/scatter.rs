//! Covariance of a fitted centre if the noise of a pixel depends on its grey level.
//!
//! The noise of light grows with the light: its variance is linear in the grey (EMVA Standard 1288), and a bright disc scatters
//! more than its dark background. With I the share of the disc in a pixel, σ²(I) = a + b I is fitted to the squares of the
//! residuals, E r² = (1 - h) σ² with h the pixel's leverage j' N⁻¹ j, and the covariance of the unweighted unknowns follows by
//! the law of propagation,
//!
//! ```text
//! Σ = N⁻¹ (Σ j j' σ²(I)) N⁻¹ = a N⁻¹ + b Σ I z z',   z = N⁻¹ j
//! ```
//!
//! with j the row of the design matrix. The mean of all squares would not do: most pixels of the band lie on the background, what
//! determines the centre lies half way up the rim. For the same reason a third term c 4I(1 - I) takes what rims have more than either side
//! of them, where the residuals are beyond the noise: in-camera denoising and compression leave noise where edges are.

use nalgebra::{Matrix3, Matrix3x2, Vector3};

use super::band::NormalMatrix;
use super::flats::Flats;
use super::lit::Lit;

/// Sums over the pixels of the band.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Lights {
    /// Of (1 - h) I^k, k to 2.
    pub powers: [f64; 3],
    /// Of r² I^k, k to 1.
    pub squares: [f64; 2],
    /// Of I z z' for the centre: uu, uv, vv.
    pub lit: [f64; 3],
    /// The same with R = 4I(1 - I), where that is wanted.
    pub rim: Option<Rim>,
}

/// Sums over the pixels of the band with R = 4I(1 - I), which is 1 half way up the rim.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Rim {
    /// Of (1 - h) R, (1 - h) I R, (1 - h) R².
    pub powers: [f64; 3],
    /// Of r² R.
    pub squares: f64,
    /// Of R z z' for the centre: uu, uv, vv.
    pub moved: [f64; 3],
}

impl Lights {
    /// Of residuals from which a profile has taken the squares of so many.
    pub fn of_profile(self, taken: f64) -> Self {
        let free = (self.powers[0] - taken).max(0.5 * self.powers[0]);
        let scale = self.powers[0] / free;
        let rim = self.rim.map(|rim| Rim { squares: scale * rim.squares, ..rim });
        Self { squares: self.squares.map(|sum| scale * sum), rim, ..self }
    }

    /// Mean square of the residuals.
    pub fn variance(&self) -> f64 {
        self.squares[0] / self.powers[0]
    }
}

/// Covariance (uu, uv, vv) of the centre with the cofactors of all unknowns.
pub(crate) fn covariance(cofactors: &NormalMatrix, band: &Lights, flats: &Flats, lit: &Lit) -> [f64; 3] {
    let [ground, growth, rim] = curve(band);
    // Inside, z is linear: the disc's level is that of the background and the contrast, and its slope follows the light.
    let steep = lit.steepness(1.0);
    let row = |i: usize| [cofactors[(i, 6)] + cofactors[(i, 7)], steep * cofactors[(i, 8)], steep * cofactors[(i, 9)]];
    let disc = flats.inside.products(&[row(0), row(1)]);
    let own = [(0, 0), (0, 1), (1, 1)].map(|place| cofactors[place]);
    let moved = band.rim.map_or([0.0; 3], |rim| rim.moved);
    std::array::from_fn(|k| ground * own[k] + growth * (band.lit[k] + disc[k]) + rim * moved[k])
}

/// a, b and c of the variance a + b I + c R, a line where rims have no more than it, and never negative between background and disc.
fn curve(band: &Lights) -> [f64; 3] {
    let [ground, growth] = line(band.powers, band.squares);
    let Some(rim) = band.rim else { return [ground, growth, 0.0] };
    let ([n, first, second], [all, lit]) = (band.powers, band.squares);
    let [of_rim, lit_rim, rim_rim] = rim.powers;
    let normal = Matrix3::new(n, first, of_rim, first, second, lit_rim, of_rim, lit_rim, rim_rim);
    let right = Vector3::new(all, lit, rim.squares);
    // all three; no noise on the background; none on the disc
    let disc_and_rim = Matrix3x2::new(0.0, 0.0, 1.0, 0.0, 0.0, 1.0);
    let ground_and_rim = Matrix3x2::new(1.0, 0.0, -1.0, 0.0, 0.0, 1.0);
    let within = |basis: Matrix3x2<f64>| {
        let solved = (basis.transpose() * normal * basis).cholesky()?.solve(&(basis.transpose() * right));
        Some(basis * solved)
    };
    let whole = normal.cholesky().map(|factor| factor.solve(&right));
    let ways = [whole, within(disc_and_rim), within(ground_and_rim)];
    let sound = |[a, b, c]: [f64; 3]| a >= 0.0 && a + b >= -1e-12 * a && c >= 0.0;
    let found = ways.into_iter().flatten().map(|way| [way[0], way[1], way[2]]).find(|way| sound(*way));
    found.unwrap_or([ground, growth, 0.0])
}

/// a and b of the variance a + b I, never negative between background and disc.
fn line([n, first, second]: [f64; 3], [all, lit]: [f64; 2]) -> [f64; 2] {
    let determinant = n * second - first * first;
    // Where nearly all pixels are alike there is nothing to tell the two apart.
    if !(determinant > 1e-3 * n * n) {
        return [all / n, 0.0];
    }
    let growth = (n * lit - first * all) / determinant;
    let ground = (all - growth * first) / n;
    if ground < 0.0 {
        [0.0, all / first]
    } else if ground + growth < 0.0 {
        [all / (n - first), -all / (n - first)]
    } else {
        [ground, growth]
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    fn fitted(shares: &[f64], square: impl Fn(f64) -> f64) -> [f64; 2] {
        let sum = |f: &dyn Fn(f64) -> f64| shares.iter().map(|share| f(*share)).sum::<f64>();
        let powers = [sum(&|_| 1.0), sum(&|share| share), sum(&|share| share * share)];
        line(powers, [sum(&square), sum(&|share| share * square(share))])
    }

    #[test]
    fn what_rims_have_more_is_found() {
        let shares: Vec<f64> = (0..100).map(|k| (f64::from(k) / 99.0).powi(2)).collect();
        let sum = |f: &dyn Fn(f64) -> f64| shares.iter().map(|share| f(*share)).sum::<f64>();
        let of_rim = |share: f64| 4.0 * share * (1.0 - share);
        for [a, b, c] in [[1.5, 4.0, 20.0], [1.0, -1.0, 40.0], [0.0, 2.0, 7.0], [2.0, 1.0, 0.0]] {
            let square = |share: f64| a + b * share + c * of_rim(share);
            let band = Lights {
                powers: [sum(&|_| 1.0), sum(&|s| s), sum(&|s| s * s)],
                squares: [sum(&square), sum(&|s| s * square(s))],
                lit: [0.0; 3],
                rim: Some(Rim {
                    powers: [sum(&of_rim), sum(&|s| s * of_rim(s)), sum(&|s| of_rim(s).powi(2))],
                    squares: sum(&|s| of_rim(s) * square(s)),
                    moved: [0.0; 3],
                }),
            };
            let found = curve(&band);
            assert!(found.iter().zip([a, b, c]).all(|(found, given)| (found - given).abs() < 1e-9), "{found:?}");
        }
    }

    #[test]
    fn a_straight_line_is_found_and_kept_above_zero() {
        let shares: Vec<f64> = (0..100).map(|k| (f64::from(k) / 99.0).powi(2)).collect();
        for [ground, growth] in [[1.5, 4.0], [5.0, -4.0], [2.0, 0.0]] {
            let found = fitted(&shares, |share| ground + growth * share);
            assert!((found[0] - ground).abs() < 1e-12 && (found[1] - growth).abs() < 1e-12, "{found:?}");
        }
        // Squares that a line through them would make negative at one end: the sum of all stays.
        let sum = |f: &dyn Fn(f64) -> f64| shares.iter().map(|share| f(*share)).sum::<f64>();
        let steep = fitted(&shares, |share| share.powi(8));
        assert_eq!(steep[0], 0.0);
        assert!((steep[1] * sum(&|s| s) / sum(&|s| s.powi(8)) - 1.0).abs() < 1e-12, "{steep:?}");
        let steep = fitted(&shares, |share| (1.0 - share).powi(8));
        assert_eq!(steep[0] + steep[1], 0.0);
        assert!((steep[0] * sum(&|s| 1.0 - s) / sum(&|s| (1.0 - s).powi(8)) - 1.0).abs() < 1e-12, "{steep:?}");
        assert_eq!(fitted(&[0.5; 9], |_| 2.0), [2.0, 0.0]);
    }
}
