//! Light that changes across a target: how much of it the disc shows.
//!
//! Light multiplies. Where it rises by the share l a pixel, the background of level B has the slope G = B l, and the contrast C the slope
//! H = C l, so that B H = C G. A gamma curve changes nothing in this: (L R)^(1/γ) = L^(1/γ) R^(1/γ), with l / γ for l. Three hypotheses
//! are compared:
//!
//! - the contrast has no slope, H = 0: flat light, the model with the fewest variances;
//! - light multiplies, B H = C G;
//! - H is a slope of its own: stray light, a tone curve, a shaded card.
//!
//! Given the estimates x = (u, v, G, H) with H free and their covariance Σ, each of the first two is a condition A x = 0. Then
//!
//! ```text
//! K = Σ A' (A Σ A')⁻¹,   x₀ = x - K A x,   Σ₀ = Σ - K A Σ,   χ² = (A x)' (A Σ A')⁻¹ A x    (two degrees of freedom)
//! ```
//!
//! A χ² weighs a hypothesis against the next one: it is kept up to one limit, given up from another, and in between the result is the
//! weighted mean of both, with the covariance of the mixture, Σ w (Σ₀ + d d') with d the distance from the mean. In flat light this costs
//! about nothing, while with H free a centre would have 1.07 to several times the standard error. All of them hold H to what light can do
//! from pixel to pixel, as an observation of 0.

use nalgebra::{SMatrix, SVector};

use super::acceptance::light as limits;

/// Centre, slope of the background, slope of the contrast.
pub(crate) type Estimates = SVector<f64, 6>;
/// Their covariance.
pub(crate) type Covariance = SMatrix<f64, 6, 6>;
type Condition = SMatrix<f64, 2, 6>;

/// Centre and slopes as the light has them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Settled {
    pub mean: Estimates,
    /// Of the mixture.
    pub covariance: Covariance,
    /// What the uncertain choice between the hypotheses has added to it.
    pub spread: Covariance,
    /// With a contrast of no slope.
    pub flat: Covariance,
    /// Weight of a contrast that has a slope.
    pub lit: f64,
}

/// Weighs the hypotheses; `background` and `contrast` are the levels B and C at the place that the slopes are counted from. None for
/// estimates without a covariance.
pub(crate) fn settled(free: &Estimates, covariance: &Covariance, background: f64, contrast: f64) -> Option<Settled> {
    // none of a contrast less than a level
    let contrast = if contrast.abs() < 1.0 { contrast.signum() } else { contrast };
    let slope = Condition::from_fn(|i, j| if j == i + 4 { 1.0 } else { 0.0 });
    // in units of the contrast, so that a black background asks for no slope of its own
    let multiplies = Condition::from_fn(|i, j| match j {
        _ if j == i + 2 => -1.0,
        _ if j == i + 4 => background / contrast,
        _ => 0.0,
    });
    // light changes by no more than a part of it from pixel to pixel: small discs know less of it than that
    let (free, covariance, _) = &conditioned(free, covariance, &slope, (limits::STEEPEST * contrast).powi(2))?;
    let (flat, flat_covariance, _) = conditioned(free, covariance, &slope, 0.0)?;
    let (multiplied, multiplied_covariance, unlike) = conditioned(free, covariance, &multiplies, 0.0)?;
    let (_, _, lit) = conditioned(&multiplied, &multiplied_covariance, &slope, 0.0)?;
    let weight = |square: f64, [kept, given_up]: [f64; 2]| ((square - kept) / (given_up - kept)).clamp(0.0, 1.0);
    let (lit, unlike) = (weight(lit, limits::LIT), weight(unlike, limits::UNLIKE));
    let all = [
        ((1.0 - unlike) * (1.0 - lit), flat, flat_covariance),
        ((1.0 - unlike) * lit, multiplied, multiplied_covariance),
        (unlike, *free, *covariance),
    ];
    let mean = all.iter().fold(Estimates::zeros(), |sum, (weight, mean, _)| sum + mean * *weight);
    let (mut own, mut spread) = (Covariance::zeros(), Covariance::zeros());
    for (weight, hypothesis, covariance) in &all {
        let off = hypothesis - mean;
        own += covariance * *weight;
        spread += off * off.transpose() * *weight;
    }
    let lit = 1.0 - all[0].0;
    let finite = mean.iter().chain(own.iter()).chain(spread.iter()).all(|value| value.is_finite());
    finite.then_some(Settled { mean, covariance: own + spread, spread, flat: flat_covariance, lit })
}

/// Estimates under a condition that holds with this variance, their covariance, and the χ² of the condition.
fn conditioned(
    free: &Estimates,
    covariance: &Covariance,
    condition: &Condition,
    variance: f64,
) -> Option<(Estimates, Covariance, f64)> {
    let off = condition * free;
    let along = condition * covariance * condition.transpose() + SMatrix::<f64, 2, 2>::identity() * variance;
    let inverse = along.try_inverse()?;
    let gain = covariance * condition.transpose() * inverse;
    let square = off.dot(&(inverse * off));
    Some((free - gain * off, covariance - gain * condition * covariance, square))
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::noise::Noise;

    /// Standard deviations of centre, G and H, and the change of the centre with H.
    const SIGMAS: [f64; 3] = [0.003, 0.004, 0.04];
    const MOVED: f64 = 0.12;

    fn covariance() -> Covariance {
        let factor = Covariance::from_fn(|i, j| match (i / 2, j / 2) {
            _ if i % 2 != j % 2 => 0.0,
            (0, 0) => SIGMAS[0],
            (0, 2) => MOVED * SIGMAS[2],
            (k, l) if k == l => SIGMAS[k],
            _ => 0.0,
        });
        factor * factor.transpose()
    }

    /// Rms of the centre's error over many samples, and of its error over its standard error, for slopes G and H along u.
    fn rms(g: f64, h: f64, background: f64, contrast: f64) -> [f64; 2] {
        let (sigma, mut noise) = (covariance(), Noise::new(3, 1));
        let factor = sigma.cholesky().expect("positive").l();
        let truth = Estimates::new(0.0, 0.0, g, 0.0, h, 0.0);
        let (mut sum, mut normal) = (0.0, 0.0);
        const SAMPLES: usize = 4000;
        for _ in 0..SAMPLES {
            let free = truth + factor * Estimates::from_fn(|_, _| noise.normal());
            let found = settled(&free, &sigma, background, contrast).expect("a covariance");
            sum += found.mean[0].powi(2);
            normal += found.mean[0].powi(2) / found.covariance[(0, 0)];
        }
        [sum, normal].map(|sum| (sum / SAMPLES as f64).sqrt())
    }

    #[test]
    fn flat_light_costs_nothing_and_light_that_changes_moves_no_centre() {
        let [flat, _] = rms(0.0, 0.0, 60.0, 120.0);
        assert!(flat < 1.05 * SIGMAS[0], "{flat}");
        // light that multiplies, from a slope within the noise on, and one that adds, or does what else it likes
        for slope in [0.01, 0.05, 0.3] {
            let [multiplied, honest] = rms(slope, 2.0 * slope, 60.0, 120.0);
            assert!(multiplied < 1.2 * SIGMAS[0] && (0.8..1.2).contains(&honest), "{slope}: {multiplied} {honest}");
        }
        let free = SIGMAS[0].hypot(MOVED * SIGMAS[2]);
        for [g, h] in [[0.3, 0.0], [0.0, 0.5], [0.2, -0.5]] {
            let [own, honest] = rms(g, h, 60.0, 120.0);
            assert!(own < 1.05 * free && (0.95..1.05).contains(&honest), "{g} {h}: {own} {honest}");
        }
        // before black only the disc shows what the light does
        let [black, honest] = rms(0.0, 0.4, 0.0, 120.0);
        assert!(black < 1.05 * free && (0.9..1.1).contains(&honest), "{black} {honest}");
    }

    #[test]
    fn no_covariance_settles_nothing() {
        assert!(settled(&Estimates::zeros(), &Covariance::zeros(), 10.0, 50.0).is_none());
    }
}
