//! Covariance of a centre where neighbouring pixels share their noise.
//!
//! Sharpening, demosaicing, compression and every mean correlate the noise of neighbours: E r_i r_j = σ² ρ(i - j). The centre is
//! Σ z_i r_i, so that its variance is Σ σ² ρ(i - j) z_i z_j = σ² Σ_d ρ(d) A(d), with A(d) = Σ z_i z_{i+d}. ρ is the mean of all
//! targets of the picture, of residuals less their mean profile across the rim: what sharpening leaves there all around moves no
//! centre. A fit of p unknowns takes about p / n of the variance of n residuals off every product of neighbours.

use wide::f32x4;

use super::band::{Band, Normal, UNKNOWNS};
use super::{DERIVATIVES, Field};
use crate::detect::ellipse::outline::Outline;

/// Farthest neighbours, in pixels.
const REACH: i32 = 5;
/// Half of the neighbours: the others are the same, seen from there.
const NEIGHBOURS: usize = 41;
/// Neighbours whose products are summed at a time.
const TOGETHER: usize = 4;
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

/// Products of neighbours of one target, the first those of pixels with themselves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Colour {
    /// Of what pixels do to the centre.
    moved: [f64; NEIGHBOURS],
    /// Of residuals, and how many pairs there are.
    residuals: [f64; NEIGHBOURS],
    pairs: [f64; NEIGHBOURS],
}

impl Colour {
    /// Correlation of the next neighbours in row and column.
    pub fn shared(&self) -> f64 {
        let next =
            OFFSETS.iter().zip(self.residuals.iter().zip(&self.pairs)).filter(|((dx, dy), _)| dx * dx + dy * dy == 1);
        let (sum, pairs) = next.fold((0.0, 0.0), |(sum, all), (_, (residual, pairs))| (sum + residual, all + pairs));
        sum / f64::max(pairs, 1.0) / (self.residuals[0] / self.pairs[0].max(1.0)).max(1e-12)
    }
}

/// Correlation of neighbours, mean of a picture's targets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Correlation([f64; NEIGHBOURS]);

impl Correlation {
    /// None without targets.
    pub fn of<'a>(targets: impl Iterator<Item = &'a Colour>) -> Option<Self> {
        let (mut sums, mut weights, mut count) = ([0.0; NEIGHBOURS], 0.0, 0.0);
        for target in targets {
            let own = target.residuals[0] / target.pairs[0];
            if !(own > 0.0) {
                continue;
            }
            let weight = target.pairs[0];
            for (sum, (residual, pairs)) in sums.iter_mut().zip(target.residuals.iter().zip(&target.pairs)) {
                *sum += weight * residual / pairs.max(1.0) / own;
            }
            weights += weight;
            count += 1.0;
        }
        if weights <= 0.0 {
            return None;
        }
        let lost = UNKNOWNS as f64 * count / weights;
        let raw = sums.map(|sum| sum / weights);
        let mut all = 1.0;
        for _ in 0..3 {
            let taken = lost * all;
            all = 1.0 + 2.0 * raw[1..].iter().map(|rho| rho + taken * (1.0 - rho)).sum::<f64>();
            all = all.clamp(0.3, 0.5 / lost);
        }
        let taken = lost * all;
        let mut rho = raw.map(|rho| rho + taken * (1.0 - rho));
        rho[0] = 1.0;
        Some(Self(rho))
    }

    /// Variance of a target's centre over what it would be without correlation.
    pub fn factor(&self, target: &Colour) -> f64 {
        let sum: f64 = self.0[1..].iter().zip(&target.moved[1..]).map(|(rho, moved)| rho * moved).sum();
        (1.0 + 2.0 * sum / target.moved[0].max(1e-300)).clamp(0.05, 40.0)
    }
}

impl Band {
    /// Products of neighbours, from the residuals, the columns and the cofactors of a fit.
    pub fn colour(
        &self,
        field: &Field,
        cofactors: &Normal,
        contrast: f64,
        outline: &Outline,
        origin: [f64; 2],
    ) -> Colour {
        let columns = self.columns();
        let scale = |i: usize| if i < 2 * DERIVATIVES { contrast } else { 1.0 };
        let factors: [[f64; UNKNOWNS]; 2] =
            std::array::from_fn(|which| std::array::from_fn(|j| cofactors[(which, j)] * scale(j)));
        let moved = |which: usize, k: usize| -> f64 {
            factors[which].iter().zip(columns).map(|(factor, column)| factor * f64::from(column[k])).sum()
        };
        let near = Outline { u: outline.u - origin[0], v: outline.v - origin[1], ..*outline };
        let bin = |k: usize| {
            let distance = near.distance(f64::from(self.x[k]), f64::from(self.y[k]));
            (2.0 * distance + BINS as f64 / 2.0).clamp(0.0, BINS as f64 - 1.0) as usize
        };
        let residuals = self.residuals();
        let mut profile = [[0.0; 2]; BINS];
        let count: usize = self.spans.iter().map(|span| span.2).sum();
        let bins: Vec<usize> = (0..count).map(bin).collect();
        for k in (0..count).filter(|k| self.kept[*k] > 0.0) {
            let sum = &mut profile[bins[k]];
            *sum = [sum[0] + f64::from(residuals[k]), sum[1] + 1.0];
        }
        let mut grid = vec![[0f32; 4]; field.width * field.height];
        let mut k = 0;
        for &(row, column, length) in &self.spans {
            for pixel in &mut grid[row * field.width + column..][..length] {
                if self.kept[k] > 0.0 {
                    let [sum, n] = profile[bins[k]];
                    *pixel = [moved(0, k) as f32, moved(1, k) as f32, residuals[k] - (sum / n) as f32, 1.0];
                }
                k += 1;
            }
        }
        let mut colour = Colour { moved: [0.0; NEIGHBOURS], residuals: [0.0; NEIGHBOURS], pairs: [0.0; NEIGHBOURS] };
        // only what lies in a span counts, which of a large field is little; several neighbours at once do not wait for each other
        for first in (0..NEIGHBOURS).step_by(TOGETHER) {
            let shifts: [usize; TOGETHER] = std::array::from_fn(|i| {
                let (dx, dy) = OFFSETS[(first + i).min(NEIGHBOURS - 1)];
                (dy * field.width as i32 + dx) as usize
            });
            let mut sums = [f32x4::ZERO; TOGETHER];
            for &(row, column, length) in &self.spans {
                let from = row * field.width + column;
                // the field's margin is wider than the reach, so that no pair goes around its end
                let [a, b, c, d] = shifts.map(|shift| grid.get(from + shift..).unwrap_or_default());
                for ((((pixel, a), b), c), d) in grid[from..from + length].iter().zip(a).zip(b).zip(c).zip(d) {
                    for (sum, neighbour) in sums.iter_mut().zip([a, b, c, d]) {
                        *sum += f32x4::new(*pixel) * f32x4::new(*neighbour);
                    }
                }
            }
            for (i, sum) in sums.into_iter().enumerate().take_while(|(i, _)| first + i < NEIGHBOURS) {
                let [u, v, r, n] = sum.to_array().map(f64::from);
                (colour.moved[first + i], colour.residuals[first + i], colour.pairs[first + i]) = (u + v, r, n);
            }
        }
        colour
    }
}
