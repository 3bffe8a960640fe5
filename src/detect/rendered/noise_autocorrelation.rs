//! Covariance of a centre with autocorrelated noise of neighbouring pixels.
//!
//! Sharpening, demosaicing, compression and every mean correlate the noise of neighbours: E r_i r_j = σ² ρ(i - j). The centre is
//! Σ z_i r_i, so that its variance is Σ σ² ρ(i - j) z_i z_j = σ² Σ_d ρ(d) A(d), with A(d) = Σ z_i z_{i+d}. ρ is the mean of all
//! targets of the picture, of residuals less their mean profile across the rim: what sharpening leaves there all around moves no
//! centre.
//!
//! A fit takes the slow part of the noise off its residuals, and with it the part that moves the centre ([`residual_covariance`](super::residual_covariance)): of white
//! noise it leaves neighbours that are negatively correlated. With ρ of the residuals as they are, ρ₀ that of noise of a known
//! correlation, white or that of a mean through which the picture has gone, each over its own number of pairs, and f₀ the variance of the centre in
//! the latter over that in white noise of the same residuals,
//!
//! f = f₀ Σ_d ρ(d) A(d) / Σ_d ρ₀(d) A(d),
//!
//! which is f₀ where the noise is the known one, whatever the fit took. To solve for the part that was taken instead, by the sum of all ρ, is
//! unstable: there are as many neighbours within reach as a small target has pixels for each unknown, and white noise came out with six
//! times its variance.

use wide::f32x4;

use super::Field;
use super::band::{Band, NormalMatrix};
use super::residual_covariance::{ResidualCovariance, TOGETHER, correlation};
use crate::detect::ellipse::outline::Outline;

/// Farthest neighbours, in pixels.
const REACH: i32 = 5;
/// Half of the neighbours: the others are the same, seen from there.
const NEIGHBOURS: usize = 41;
/// Minimum sum Σ ρ₀ A / A(0) that is divided by: it is 0.6 and more of targets from 6 px. With less, of hardly more pixels than unknowns, chance
/// would decide the factor.
const LEAST_LEFT: f64 = 0.4;
/// Bins of the profile, two a pixel.
const BINS: usize = 64;

const fn neighbours() -> [(i32, i32); NEIGHBOURS] {
    let mut all = [(0, 0); NEIGHBOURS];
    let (mut count, mut dy) = (1, 0);
    while dy <= REACH {
        let mut dx = if dy == 0 { 1 } else { -REACH };
        while dx <= REACH {
            if dx * dx + dy * dy <= REACH * REACH {
                all[count] = (dx, dy);
                count += 1;
            }
            dx += 1;
        }
        dy += 1;
    }
    assert!(count == NEIGHBOURS);
    all
}

const OFFSETS: [(i32, i32); NEIGHBOURS] = neighbours();

/// Products of the noise of neighbouring pixels at one target; the first is each pixel with itself.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NoiseProducts {
    /// Of what pixels do to the centre.
    moved: [f64; NEIGHBOURS],
    /// Of residuals, and how many pairs there are.
    residuals: [f64; NEIGHBOURS],
    pairs: [f64; NEIGHBOURS],
    /// The same of residuals that the fit leaves of the known noise of variance 1.
    known: [f64; NEIGHBOURS],
    /// Variance of the centre in the known noise over that in white noise of as large residuals.
    natural: f64,
}

/// Noise autocorrelation, mean of a picture's targets: of the residuals, and of the residuals that fits leave of known noise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NoiseAutocorrelation {
    left: [f64; NEIGHBOURS],
    known: [f64; NEIGHBOURS],
}

impl NoiseAutocorrelation {
    /// `None` without targets.
    pub fn of<'a>(targets: impl Iterator<Item = &'a NoiseProducts>) -> Option<Self> {
        let (mut left, mut known, mut weights) = ([0.0; NEIGHBOURS], [0.0; NEIGHBOURS], 0.0);
        for target in targets {
            let weight = target.pairs[0];
            let (own, free) = (target.residuals[0] / weight, target.known[0] / weight);
            if !(own > 0.0 && free > 0.0) {
                continue;
            }
            for (k, pairs) in target.pairs.iter().enumerate() {
                left[k] += weight * target.residuals[k] / pairs.max(1.0) / own;
                known[k] += weight * target.known[k] / pairs.max(1.0) / free;
            }
            weights += weight;
        }
        (weights > 0.0).then(|| Self { left: left.map(|sum| sum / weights), known: known.map(|sum| sum / weights) })
    }

    /// Variance of a target's centre over what it would be without correlation.
    pub fn factor(&self, target: &NoiseProducts) -> f64 {
        let moved = |rho: &[f64; NEIGHBOURS]| -> f64 {
            let sum: f64 = rho[1..].iter().zip(&target.moved[1..]).map(|(rho, moved)| rho * moved).sum();
            1.0 + 2.0 * sum / target.moved[0].max(1e-300)
        };
        (target.natural * moved(&self.left) / moved(&self.known).max(LEAST_LEFT)).clamp(0.05, 100.0)
    }
}

impl Band {
    /// Takes their mean profile across the rim off the residuals; how many values it has.
    pub fn take_profile(&mut self, outline: &Outline, origin: [f64; 2]) -> usize {
        let (profile, values) = self.profile(outline, origin);
        let counted = self.residual.iter_mut().zip(&self.kept).filter(|(_, kept)| **kept > 0.0);
        counted.zip(profile).for_each(|((residual, _), mean)| *residual -= mean);
        values
    }

    /// Mean profile across the rim at the pixels that count, and how many values it has: means of half a pixel, with straight lines between.
    fn profile(&self, outline: &Outline, origin: [f64; 2]) -> (Vec<f32>, usize) {
        let near = Outline { u: outline.u - origin[0], v: outline.v - origin[1], ..*outline };
        let counted = self.x.iter().zip(&self.y).zip(&self.residual).zip(&self.kept).filter(|(_, kept)| **kept > 0.0);
        let place = |((x, y), residual): ((&f32, &f32), &f32)| {
            let distance = near.distance(f64::from(*x), f64::from(*y));
            ((2.0 * distance + BINS as f64 / 2.0).clamp(0.0, BINS as f64 - 1.0), f64::from(*residual))
        };
        let places: Vec<(f64, f64)> = counted.map(|(pixel, _)| place(pixel)).collect();
        let mut bins = [[0.0; 3]; BINS];
        for (place, residual) in &places {
            let [sum, at, count] = &mut bins[*place as usize];
            (*sum, *at, *count) = (*sum + residual, *at + place, *count + 1.0);
        }
        let means: Vec<[f64; 2]> =
            bins.iter().filter(|bin| bin[2] > 0.0).map(|[sum, at, n]| [at / n, sum / n]).collect();
        let between = |place: f64| {
            let after = means.partition_point(|[at, _]| *at < place).clamp(1, means.len().max(2) - 1);
            match means[after - 1..] {
                [[from, low], [to, high], ..] => low + (high - low) * ((place - from) / (to - from)).clamp(0.0, 1.0),
                _ => 0.0,
            }
        };
        (places.iter().map(|(place, _)| between(*place) as f32).collect(), means.len())
    }

    /// Correlation of the residuals of the next neighbours in row and column.
    pub fn shared(&self, field: &Field, outline: &Outline, origin: [f64; 2]) -> f64 {
        let grid = self.grid(field, outline, origin, |_| [0.0; 2]);
        let [own, across, down, _] = self.products(&grid, field.width, [0, 1, field.width, 0]);
        let [.., residuals, pairs] = own;
        let [sum, all] = [across[2] + down[2], across[3] + down[3]];
        sum / all.max(1.0) / (residuals / pairs.max(1.0)).max(1e-12)
    }

    /// At each pixel of the field: what it moves the centre by, its residual less the mean profile across the rim, and 1; zeros where
    /// it does not count.
    fn grid(
        &self,
        field: &Field,
        outline: &Outline,
        origin: [f64; 2],
        moved: impl Fn(usize) -> [f32; 2],
    ) -> Vec<[f32; 4]> {
        let mut profile = self.profile(outline, origin).0.into_iter();
        let mut grid = vec![[0f32; 4]; field.width * field.height];
        let mut k = 0;
        for &(row, column, length) in &self.spans {
            let from = row * field.width + column;
            for (at, pixel) in (from..).zip(&mut grid[from..from + length]) {
                if self.kept[k] > 0.0 {
                    let mean = profile.next().unwrap_or_default();
                    let [u, v] = moved(at);
                    *pixel = [u, v, self.residual[k] - mean, 1.0];
                }
                k += 1;
            }
        }
        grid
    }

    /// Sums over the spans of what each pixel has times what its neighbours at these shifts have.
    fn products(&self, grid: &[[f32; 4]], width: usize, shifts: [usize; TOGETHER]) -> [[f64; 4]; TOGETHER] {
        let mut sums = [f32x4::ZERO; TOGETHER];
        for &(row, column, length) in &self.spans {
            let from = row * width + column;
            // the field's margin is wider than the reach, so that no pair goes around its end
            let [a, b, c, d] = shifts.map(|shift| grid.get(from + shift..).unwrap_or_default());
            for ((((pixel, a), b), c), d) in grid[from..from + length].iter().zip(a).zip(b).zip(c).zip(d) {
                for (sum, neighbour) in sums.iter_mut().zip([a, b, c, d]) {
                    *sum += f32x4::new(*pixel) * f32x4::new(*neighbour);
                }
            }
        }
        sums.map(|sum| sum.to_array().map(f64::from))
    }

    /// Products of neighbours, from the residuals and the cofactors of a fit, for known noise that a mean of this sigma has passed; `None` if
    /// the cofactors are not positive definite.
    pub fn colour(
        &self,
        field: &Field,
        cofactors: &NormalMatrix,
        contrast: f64,
        outline: &Outline,
        origin: [f64; 2],
        mean: f64,
    ) -> Option<NoiseProducts> {
        let residual = ResidualCovariance::of(self, field, cofactors, contrast, mean)?;
        let grid = self.grid(field, outline, origin, |at| residual.moved(at));
        let none = [0.0; NEIGHBOURS];
        let mut colour = NoiseProducts { moved: none, residuals: none, pairs: none, known: none, natural: 1.0 };
        // several neighbours at once do not wait for each other
        for first in (0..NEIGHBOURS).step_by(TOGETHER) {
            let offsets: [(i32, i32); TOGETHER] = std::array::from_fn(|i| OFFSETS[(first + i).min(NEIGHBOURS - 1)]);
            let shifts = offsets.map(|(dx, dy)| (dy * field.width as i32 + dx) as usize);
            let sums = self.products(&grid, field.width, shifts);
            let removed = residual.products(self, field.width, shifts);
            for (at, (sum, removed)) in (first..NEIGHBOURS).zip(sums.into_iter().zip(removed)) {
                let [u, v, r, n] = sum;
                (colour.moved[at], colour.residuals[at], colour.pairs[at]) = (u + v, r, n);
                let (dx, dy) = OFFSETS[at];
                colour.known[at] = correlation(dx, dy, mean) * n - removed;
            }
        }
        // the variance is that of white residuals, and the known noise leaves others
        colour.natural = residual.natural * (colour.pairs[0] - residual.trace).max(1.0) / colour.known[0].max(1.0);
        Some(colour)
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn what_is_left_all_around_is_taken_off_and_what_lies_in_a_place_is_not() {
        let outline = Outline::from_axes(103.2, 81.7, 14.0, 9.0, 0.4);
        let [u, v] = [100.0, 80.0];
        let mut band = Band::default();
        for (y, x) in (0..50).flat_map(|y| (0..50).map(move |x| (f64::from(y) - 23.5, f64::from(x) - 23.5))) {
            if outline.distance(x + u, y + v).abs() < 3.0 {
                band.x.push(x as f32);
                band.y.push(y as f32);
                band.kept.push(1.0);
            }
        }
        let ring = |x: f32, y: f32| (1.5 * outline.distance(f64::from(x) + u, f64::from(y) + v)).sin() as f32;
        let places: Vec<(f32, f32)> = band.x.iter().copied().zip(band.y.iter().copied()).collect();
        let square = |band: &Band| band.residual.iter().map(|r| r * r).sum::<f32>() / band.residual.len() as f32;
        band.residual = places.iter().map(|(x, y)| 10.0 * ring(*x, *y)).collect();
        let before = square(&band);
        let values = band.take_profile(&outline, [u, v]);
        assert!((10..=14).contains(&values), "{values}");
        assert!(square(&band) < 0.02 * before, "{} {before}", square(&band));
        // on one side alone: half of it is common to both
        band.residual = places.iter().map(|(x, y)| if *x > 3.2 { 10.0 * ring(*x, *y) } else { 0.0 }).collect();
        let before = square(&band);
        band.take_profile(&outline, [u, v]);
        assert!(square(&band) > 0.4 * before, "{} {before}", square(&band));
    }
}
