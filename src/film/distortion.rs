//! A calibrated table of radial distortion, fitted by an odd polynomial.
//!
//! ```text
//! Δr = k0 r + k1 r³ + k2 r⁵ + k3 r⁷ …
//! ```
//!
//! Least squares over the table. Source: Ziemann and El-Hakim (1982); Kang and Yeu (1985), figure 3-2.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::transformation::Coefficient;
use crate::error::{Error, Place, Reason, Result};

/// A fitted distortion table. Distortion and radius have the same unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OddPolynomial {
    /// Coefficients of r, r³, r⁵ …, the first being 0 when it was left out.
    pub coefficients: Vec<Coefficient>,
    /// Polynomial minus table.
    pub residuals: Vec<f64>,
    /// Standard error of a table value; `None` without redundancy.
    pub sigma0: Option<f64>,
}

impl OddPolynomial {
    /// Δr at a radius.
    pub fn at(&self, r: f64) -> f64 {
        self.coefficients.iter().rev().fold(0.0, |sum, k| sum * r * r + k.value) * r
    }

    /// K1, K2, K3 of the brown model, which adds a correction to the measurement, for a table that gives the
    /// displacement of the image (outwards positive) and was fitted without a linear term.
    pub fn brown(&self) -> [f64; 3] {
        [1, 2, 3].map(|k| self.coefficients.get(k).map_or(0.0, |c| -c.value))
    }
}

/// Fits a table of radii and distortions by `terms` terms above the linear one; `linear` adds the linear one, which
/// changes the principal distance the distortion refers to.
///
/// # Errors
/// [`Error::Invalid`] if the lists differ in length, are shorter than the number of terms, hold numbers that are not
/// finite, or do not determine the terms.
pub fn fit(radii: &[f64], distortions: &[f64], terms: usize, linear: bool) -> Result<OddPolynomial> {
    let invalid = |reason| Err(Error::Invalid { reason, at: Place::field("distortion") });
    let n = radii.len();
    let first = usize::from(!linear);
    let unknowns = terms + 1 - first;
    if n != distortions.len() || n < unknowns || unknowns == 0 {
        return invalid(Reason::TooFewRadii { radii: n, distortions: distortions.len(), terms: unknowns });
    }
    let largest = radii.iter().fold(0.0f64, |m, r| m.max(r.abs()));
    if !radii.iter().chain(distortions).all(|x| x.is_finite()) || largest == 0.0 {
        return invalid(Reason::RadiiNotFinite);
    }
    // Radii are scaled to 1, where the powers are of one size.
    let power = |k: usize| 2 * (k + first) + 1;
    let a = DMatrix::from_fn(n, unknowns, |i, k| (radii[i] / largest).powi(power(k) as i32));
    let l = DVector::from_column_slice(distortions);
    let Some(inverse) = (a.transpose() * &a).try_inverse().filter(|q| q.max().is_finite() && q.max() < 1e12) else {
        return invalid(Reason::RadiiUndetermined { terms: unknowns });
    };
    let x = &inverse * (a.transpose() * &l);
    let residuals: Vec<f64> = (&a * &x - l).iter().copied().collect();
    let redundancy = n - unknowns;
    let squares: f64 = residuals.iter().map(|v| v * v).sum();
    let sigma0 = (redundancy > 0).then(|| (squares / redundancy as f64).sqrt());
    let mut coefficients = Vec::new();
    if !linear {
        coefficients.push(Coefficient { name: "k0".into(), value: 0.0, sigma: None });
    }
    for k in 0..unknowns {
        let unit = largest.powi(-(power(k) as i32));
        coefficients.push(Coefficient {
            name: format!("k{}", k + first),
            value: x[k] * unit,
            sigma: sigma0.map(|s| s * inverse[(k, k)].max(0.0).sqrt() * unit),
        });
    }
    Ok(OddPolynomial { coefficients, residuals, sigma0 })
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::noise::Noise;

    fn table(noise: f64) -> (Vec<f64>, Vec<f64>) {
        let mut random = Noise::new(3, 0);
        let radii: Vec<f64> = (1..=12).map(|k| f64::from(k) * 5.0).collect();
        let value = |r: &f64| 1e-4 * r + 2e-7 * r.powi(3) - 5e-11 * r.powi(5);
        let distortions = radii.iter().map(|r| value(r) + noise * random.normal()).collect();
        (radii, distortions)
    }

    #[test]
    fn a_polynomial_is_recovered_exactly() {
        let (radii, distortions) = table(0.0);
        let fitted = fit(&radii, &distortions, 2, true).unwrap();
        for (k, expected) in [1e-4, 2e-7, -5e-11].into_iter().enumerate() {
            assert!((fitted.coefficients[k].value / expected - 1.0).abs() < 1e-9);
        }
        assert!((fitted.at(33.0) - (1e-4 * 33.0 + 2e-7 * 33f64.powi(3) - 5e-11 * 33f64.powi(5))).abs() < 1e-12);
        assert!(fitted.residuals.iter().all(|v| v.abs() < 1e-12));
        let brown = fit(&radii, &distortions, 3, false).unwrap();
        assert_eq!(brown.coefficients[0].value, 0.0);
        assert_eq!(brown.brown()[0], -brown.coefficients[1].value);
    }

    #[test]
    fn noise_comes_back_as_the_standard_error() {
        let (radii, distortions) = table(1e-3);
        let fitted = fit(&radii, &distortions, 2, true).unwrap();
        assert!((0.4..1.8).contains(&(fitted.sigma0.unwrap() / 1e-3)));
        for (k, expected) in [1e-4, 2e-7, -5e-11].into_iter().enumerate() {
            let c = &fitted.coefficients[k];
            assert!((c.value - expected).abs() < 4.0 * c.sigma.unwrap(), "{c:?}");
        }
    }

    #[test]
    fn tables_that_determine_nothing_are_refused() {
        assert!(fit(&[1.0, 2.0], &[0.1], 1, true).is_err());
        assert!(fit(&[1.0, 1.0, 1.0], &[0.1, 0.1, 0.1], 2, true).is_err());
        assert!(fit(&[0.0, 0.0], &[0.1, 0.1], 1, false).is_err());
        assert!(fit(&[], &[], 0, false).is_err());
    }
}
