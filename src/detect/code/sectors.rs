//! The division of a ring into n sectors.
//!
//! Around the ring the levels y(t) are a sum of sectors, each a box between two rays from the centre, blurred:
//!
//! ```text
//! y(t) = Σ x_k (Φ(d(t, t_k) / s) - Φ(d(t, t_k+1) / s)),    t_k = phase + 2π k / n
//! ```
//!
//! with the distance d in pixels of the place from the ray. Least squares over x gives each sector its level freed of its
//! neighbours' blur, together with its standard error; narrow sectors of a tilted ring could not be distinguished otherwise. The phase
//! starts at that of the n-th harmonic of the edges, Σ |dy|² exp(i n t), and is refined where the binary model misfits least.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix3, Vector3};

use super::polar::{RingRays, step};
use crate::detect::acceptance::code::{ENDS, ENDS_RMS, HOPELESS, MISFIT, SAME, STANDS_OUT, UNEVEN};

/// Steps of the phase, as shares of a sector: a coarse and a fine search.
const PHASES: [&[f64]; 2] = [&[-0.16, -0.08, 0.0, 0.08, 0.16], &[-0.04, -0.02, 0.02, 0.04]];

/// Sectors whose blur reaches a direction, on either side and with its own.
const NEAR: usize = 3;

/// How near to its middle a direction lies well inside of a sector.
const INNER: f64 = 0.35;
/// Weight of the condition that set sectors have equal levels, relative to that of one direction.
const STEADY: f64 = 0.05;
/// Weight of the condition that the light is constant, in sectors.
const EVEN: f64 = 0.5;
/// Weight of the condition on sectors hidden by blur, relative to that of a visible one.
const RIDGE: f64 = 0.01;

/// A division of a ring.
#[derive(Clone, Debug)]
pub(super) struct Division {
    /// Level of each sector, clockwise.
    pub levels: Vec<f64>,
    /// Standard error of each.
    pub sigmas: Vec<f64>,
    /// Bits, the first sector's the most significant.
    pub bits: u32,
    /// Levels of unset and of set sectors.
    pub low: f64,
    pub high: f64,
    /// Rms of what two levels leave unexplained, over their difference.
    pub misfit: f64,
    /// Direction of the first sector's beginning.
    phase: f64,
    shares: Vec<Shares>,
    inverse: DMatrix<f64>,
}

/// The best division into `n` sectors of levels around a ring whose middle is at `radius`; `None` if nothing stands out.
pub(super) fn divide(rays: &RingRays, levels: &[f64], radius: f64, n: u32) -> Option<Division> {
    let sector = std::f64::consts::TAU / f64::from(n);
    let mut phase = first_phase(rays, levels, n);
    let mut best: Option<Tried> = None;
    'phases: for steps in PHASES {
        // what is so far from a ring of sectors does not become one by a fine step
        if best.as_ref().is_some_and(|best| best.misfit > HOPELESS * MISFIT) {
            break;
        }
        let around = phase;
        for share in steps {
            let phase_tried = around + share * sector;
            let Some(tried) = at_phase(rays, levels, radius, n, phase_tried) else { continue };
            if best.as_ref().is_none_or(|best| tried.misfit < best.misfit) {
                // where all are set no sector begins or ends
                let is_full = tried.bits == (1 << n) - 1;
                best = Some(tried);
                phase = phase_tried;
                if is_full {
                    break 'phases;
                }
            }
        }
    }
    best.map(|best| best.finish(rays, levels))
}

/// Phase of the n-th harmonic of the edges.
fn first_phase(rays: &RingRays, levels: &[f64], n: u32) -> f64 {
    let count = levels.len();
    let turn = std::f64::consts::TAU / count as f64;
    let mut sums = [0.0; 2];
    for k in 0..count {
        let rise = levels[(k + 1) % count] - levels[k];
        let (s, c) = (f64::from(n) * turn * (k as f64 + 0.5)).sin_cos();
        // blurred over more directions where the arc is short
        let weight = rise * rise / rays.arc[k];
        sums[0] += weight * c;
        sums[1] += weight * s;
    }
    sums[1].atan2(sums[0]) / f64::from(n)
}

/// A division of which only the misfit was wanted so far.
struct Tried {
    found: DVector<f64>,
    bits: u32,
    low: f64,
    high: f64,
    misfit: f64,
    phase: f64,
    shares: Vec<Shares>,
    factor: Cholesky<f64, Dyn>,
}

fn at_phase(rays: &RingRays, levels: &[f64], radius: f64, n: u32, phase: f64) -> Option<Tried> {
    let count = n as usize;
    let shares = shares(rays, radius, n, phase);
    let weights = &rays.arc;
    let (mut normal, mut right) = normal_equations(&shares, levels, weights, count);
    let ridge = RIDGE * weights.iter().sum::<f64>() / f64::from(n);
    for k in 0..count {
        normal[(k, k)] += ridge;
        right[k] += 0.5 * ridge;
    }
    let factor = normal.cholesky()?;
    let found = factor.solve(&right);
    let top = found.max();
    let half = top / 2.0;
    let mean = |set: bool| {
        let of = || found.iter().filter(|x| (**x > half) == set);
        of().sum::<f64>() / of().count().max(1) as f64
    };
    let (low, high) = (mean(false), mean(true));
    if !(high - low > STANDS_OUT) {
        return None;
    }
    let middle = (low + high) / 2.0;
    let bits = found.iter().fold(0u32, |bits, x| bits << 1 | u32::from(*x > middle));
    let binary = DVector::from_iterator(count, found.iter().map(|x| if *x > middle { high } else { low }));
    let misfit = rest(&binary, &shares, levels, weights).sqrt() / (high - low);
    Some(Tried { found, bits, low, high, misfit, phase, shares, factor })
}

/// Weighted products of the shares with each other and with the levels.
fn normal_equations(shares: &[Shares], levels: &[f64], weights: &[f64], count: usize) -> (DMatrix<f64>, DVector<f64>) {
    let mut normal = DMatrix::<f64>::zeros(count, count);
    let mut right = DVector::<f64>::zeros(count);
    // one direction after the other sees the same sectors: their products are summed before they are put where they belong
    let mut from = 0;
    for rows in shares.chunk_by(|a, b| a.first == b.first) {
        let mut products = [[0.0; 2 * NEAR]; 2 * NEAR];
        let mut with_levels = [0.0; 2 * NEAR];
        for ((row, level), weight) in rows.iter().zip(&levels[from..]).zip(&weights[from..]) {
            for k in 0..2 * NEAR {
                let share = weight * row.shares[k];
                with_levels[k] += share * level;
                for l in 0..2 * NEAR {
                    products[k][l] += share * row.shares[l];
                }
            }
        }
        let sector = |k: usize| (rows[0].first + k) % count;
        for k in 0..2 * NEAR {
            right[sector(k)] += with_levels[k];
            for l in 0..2 * NEAR {
                normal[(sector(k), sector(l))] += products[k][l];
            }
        }
        from += rows.len();
    }
    (normal, right)
}

/// Weighted mean square of what these levels of the sectors leave.
fn rest(model: &DVector<f64>, shares: &[Shares], levels: &[f64], weights: &[f64]) -> f64 {
    let explained = |row: &Shares| row.of(model.len()).map(|(k, share)| share * model[k]).sum::<f64>();
    let squares = levels.iter().zip(shares).zip(weights).map(|((y, row), w)| w * (y - explained(row)).powi(2));
    squares.sum::<f64>() / weights.iter().sum::<f64>()
}

impl Tried {
    fn finish(self, rays: &RingRays, levels: &[f64]) -> Division {
        let Self { found, bits, low, high, misfit, phase, shares, factor } = self;
        let (count, weights) = (found.len(), &rays.arc);
        let inverse = factor.inverse();
        // what the free levels leave is noise, of so many independent places
        let mean_weight = weights.iter().sum::<f64>() / weights.len() as f64;
        let places = levels.len() as f64;
        let variance = rest(&found, &shares, levels, weights) * mean_weight * places / (places - count as f64).max(1.0);
        let sigmas = (0..count).map(|k| (variance * inverse[(k, k)]).sqrt()).collect();
        Division { levels: found.iter().copied().collect(), sigmas, bits, low, high, misfit, phase, shares, inverse }
    }
}

/// How much of each sector reaches a direction: of the sectors from `first` on.
#[derive(Clone, Copy, Debug)]
struct Shares {
    first: usize,
    shares: [f64; 2 * NEAR],
}

impl Shares {
    /// Sectors of `count` with their shares.
    #[inline]
    fn of(&self, count: usize) -> impl Iterator<Item = (usize, f64)> {
        let sector = move |k: usize| if k < count { k } else { k - count };
        self.shares.iter().enumerate().map(move |(k, share)| (sector(self.first + k), *share))
    }
}

fn shares(rays: &RingRays, radius: f64, n: u32, phase: f64) -> Vec<Shares> {
    let sector = std::f64::consts::TAU / f64::from(n);
    let count = n as usize;
    // direction of each ray, and what turns a sine into a distance in blurs
    let ends: Vec<([f64; 2], f64)> = (0..n)
        .map(|k| {
            let (s, c) = (phase + sector * f64::from(k)).sin_cos();
            ([c, s], radius * rays.area / (rays.ray(c, s) * rays.blur))
        })
        .collect();
    let turn = std::f64::consts::TAU / rays.directions.len() as f64;
    let of = |(j, [c, s]): (usize, &[f64; 2])| {
        let angle = (j as f64 * turn - phase).rem_euclid(std::f64::consts::TAU);
        let first = ((angle / sector) as usize + 1 + count - NEAR) % count;
        // 1 behind the rays that are passed, 0 before those to come
        let mut before = 1.0;
        let mut shares = [0.0; 2 * NEAR];
        for (k, share) in shares.iter_mut().enumerate() {
            let ([rc, rs], scale) = ends[(first + k + 1) % count];
            let here = if k + 1 < 2 * NEAR { step((s * rc - c * rs) * scale) } else { 0.0 };
            *share = before - here;
            before = here;
        }
        Shares { first, shares }
    };
    rays.directions.iter().enumerate().map(of).collect()
}

impl Division {
    /// Other levels around the same ring, sector by sector.
    pub fn sectors(&self, rays: &RingRays, levels: &[f64]) -> Vec<f64> {
        let count = self.levels.len();
        let mut right = DVector::<f64>::zeros(count);
        for ((row, level), weight) in self.shares.iter().zip(levels).zip(&rays.arc) {
            row.of(count).for_each(|(k, share)| right[k] += weight * share * level);
        }
        let found: DVector<f64> = &self.inverse * right;
        found.iter().copied().collect()
    }

    /// Levels of the set sectors in one direction, each sector with its own level.
    pub fn seen(&self, direction: usize) -> f64 {
        let set = self.shares[direction].of(self.levels.len()).filter(|(k, _)| self.is_set(*k));
        set.map(|(k, share)| share * self.levels[k]).sum()
    }

    /// Direction of the middle of each set sector, and its level.
    pub fn set_middles(&self) -> impl Iterator<Item = ([f64; 2], f64)> {
        let n = self.levels.len();
        (0..n).filter(|k| self.is_set(*k)).map(move |k| {
            let (s, c) = (self.phase + std::f64::consts::TAU * (k as f64 + 0.5) / n as f64).sin_cos();
            ([c, s], self.levels[k])
        })
    }

    /// Whether a sector is set.
    pub fn is_set(&self, sector: usize) -> bool {
        self.bits >> (self.levels.len() - 1 - sector) & 1 == 1
    }

    /// Number of arcs of set sectors.
    pub fn arcs(&self) -> usize {
        let n = self.levels.len();
        (0..n).filter(|k| self.is_set(*k) && !self.is_set((k + n - 1) % n)).count()
    }

    /// Level of each sector if it were set. Light changes it around the ring: a plane goes through the set ones, as far as there are some on
    /// all sides.
    pub fn lit(&self) -> Vec<f64> {
        let n = self.levels.len();
        let basis = |k: usize| {
            let (s, c) = (self.phase + std::f64::consts::TAU * (k as f64 + 0.5) / n as f64).sin_cos();
            Vector3::new(1.0, c, s)
        };
        let mut normal = Matrix3::from_diagonal(&Vector3::new(1e-9, EVEN, EVEN));
        let mut right = Vector3::zeros();
        for k in (0..n).filter(|k| self.is_set(*k)) {
            normal += basis(k) * basis(k).transpose();
            right += basis(k) * (self.levels[k] - self.high);
        }
        let plane = normal.cholesky().map_or_else(Vector3::zeros, |factor| factor.solve(&right));
        let step = self.high - self.low;
        (0..n).map(|k| self.high + basis(k).dot(&plane).clamp(-UNEVEN * step, UNEVEN * step)).collect()
    }

    /// Largest distance of an arc's end from the grid, or the rms of all, over what it may be. All ends of a code are where they belong but
    /// for chance; a ring of other sectors that has none far from the grid has many a little off.
    pub fn off_grid(&self, rays: &RingRays, levels: &[f64], radius: f64) -> f64 {
        let shifts = self.shifts(rays, levels, radius);
        let over =
            |limit: [f64; 2]| move |[shift, sector_px]: &[f64; 2]| shift.abs() / (limit[0] + limit[1] / sector_px);
        let largest = shifts.iter().map(over(ENDS)).fold(0.0, f64::max);
        let squares = shifts.iter().map(over(ENDS_RMS)).map(|share| share * share).sum::<f64>();
        largest.max((squares / shifts.len().max(1) as f64).sqrt())
    }

    /// Distance of each arc's end from the grid in sectors, and a sector's width there in pixels. What stands on the wrong side of an end,
    /// as far as half a sector to both sides, is its shift times the step between the levels, whatever the blur. Light changes the level of
    /// set sectors around the ring: a plane goes through what lies well inside of them.
    fn shifts(&self, rays: &RingRays, levels: &[f64], radius: f64) -> Vec<[f64; 2]> {
        let n = self.levels.len();
        let (count, directions) = (n as f64, levels.len() as f64);
        let sector_of = |j: usize| {
            let turn = j as f64 / directions - self.phase / std::f64::consts::TAU;
            let place = turn.rem_euclid(1.0) * count;
            ((place as usize).min(n - 1), place.fract())
        };
        let basis = |j: usize| Vector3::new(1.0, rays.directions[j][0], rays.directions[j][1]);
        let (mut normal, mut right) = (Matrix3::<f64>::zeros(), Vector3::<f64>::zeros());
        for (j, level) in levels.iter().enumerate() {
            let (sector, share) = sector_of(j);
            if self.is_set(sector) && (share - 0.5).abs() < INNER {
                normal += basis(j) * basis(j).transpose();
                right += basis(j) * (level - self.high);
            }
        }
        let ridge = STEADY * normal[(0, 0)];
        normal += Matrix3::from_diagonal(&Vector3::new(1e-9, ridge, ridge));
        let tilt = normal.cholesky().map_or_else(Vector3::zeros, |factor| factor.solve(&right));
        let step = self.high - self.low;
        let rest: Vec<f64> = (0..levels.len())
            .map(|j| {
                let expected =
                    self.shares[j].of(n).map(|(k, share)| if self.is_set(k) { share } else { 0.0 }).sum::<f64>();
                levels[j] - self.low - expected * (step + basis(j).dot(&tilt))
            })
            .collect();
        let ends = (0..n).filter(|k| self.is_set(*k) != self.is_set((k + n - 1) % n));
        let off = |k: usize| {
            let place = (self.phase / std::f64::consts::TAU + k as f64 / count) * directions;
            let half = 0.5 * directions / count;
            let near = (place - half).ceil() as i64..=(place + half).floor() as i64;
            let at = |j: i64| j.rem_euclid(levels.len() as i64) as usize;
            let shift = near.map(|j| rest[at(j)]).sum::<f64>() * count / (directions * step);
            let sector_px = std::f64::consts::TAU / count * radius * rays.arc[at(place.round() as i64)];
            [shift, sector_px]
        };
        ends.map(off).collect()
    }

    /// Directions in which the level changes, as shares of a turn.
    fn changes(&self) -> Vec<f64> {
        let n = self.levels.len();
        let changes = (0..n).filter(|k| self.is_set(*k) != self.is_set((k + n - 1) % n));
        changes.map(|k| (self.phase / std::f64::consts::TAU + k as f64 / n as f64).rem_euclid(1.0)).collect()
    }

    /// Whether two divisions have the same arcs: then no picture can distinguish them.
    pub fn same_arcs(&self, other: &Self) -> bool {
        let (a, b) = (self.changes(), other.changes());
        let limit = SAME / self.levels.len().max(other.levels.len()) as f64;
        let near = |x: &f64, y: &f64| {
            let d = (x - y).rem_euclid(1.0);
            d.min(1.0 - d) < limit
        };
        a.len() == b.len() && a.iter().all(|x| b.iter().any(|y| near(x, y)))
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::detect::outline::Outline;

    /// Levels around a ring whose arcs end at these places, in sectors of 12, blurred over a tenth of a sector.
    fn ring(ends: &[[f64; 2]], directions: usize) -> Vec<f64> {
        let level = |turn: f64| {
            let of = |[from, to]: &[f64; 2]| step((turn - from) / 0.1) - step((turn - to) / 0.1);
            ends.iter().map(of).sum()
        };
        (0..directions).map(|j| level(12.0 * (j as f64 + 0.5) / directions as f64)).collect()
    }

    #[test]
    fn light_is_a_plane_through_the_set_sectors() {
        let rays = RingRays::of(Outline::from_axes(100.0, 100.0, 15.0, 15.0, 0.0), 1.8);
        let lit = |ends: &[[f64; 2]]| {
            let mut levels = ring(ends, rays.directions.len());
            levels.iter_mut().zip(&rays.directions).for_each(|(level, [c, _])| *level *= 1.0 + 0.2 * c);
            divide(&rays, &levels, 2.5, 12).unwrap().lit()
        };
        let around = lit(&[[0.0, 2.0], [3.0, 4.0], [5.0, 7.0], [8.0, 9.0], [10.0, 11.0]]);
        // sectors of 30 degrees from the direction of the light on
        for (k, level) in around.iter().enumerate() {
            let truth = 1.0 + 0.2 * (30f64.to_radians() * (k as f64 + 0.5)).cos();
            assert!((level - truth).abs() < 0.04, "{k}: {level} {truth}");
        }
        // a single arc hardly determines the other side
        let arc = lit(&[[0.0, 2.0]]);
        assert!(arc.iter().all(|level| (level - arc[0]).abs() < 0.1), "{arc:?}");
    }

    #[test]
    fn products_summed_by_sector_are_those_of_the_definition() {
        let rays = RingRays::of(Outline::from_axes(100.0, 100.0, 15.0, 9.0, 0.4), 1.8);
        let levels = ring(&[[1.0, 3.0], [5.0, 6.3], [8.0, 11.0]], rays.directions.len());
        for (n, phase) in [(12, 0.0), (14, 0.2), (16, -0.1), (20, 3.0)] {
            let count = n as usize;
            let shares = shares(&rays, 2.5, n, phase);
            let (normal, right) = normal_equations(&shares, &levels, &rays.arc, count);
            let all = |row: &Shares| {
                let mut all = DVector::<f64>::zeros(count);
                row.of(count).for_each(|(k, share)| all[k] += share);
                all
            };
            let (mut plain, mut plain_right) = (DMatrix::<f64>::zeros(count, count), DVector::<f64>::zeros(count));
            for ((row, level), weight) in shares.iter().zip(&levels).zip(&rays.arc) {
                plain += *weight * all(row) * all(row).transpose();
                plain_right += *weight * *level * all(row);
            }
            assert!((normal - &plain).amax() < 1e-12 * plain.amax(), "{n}");
            assert!((right - &plain_right).amax() < 1e-12 * plain_right.amax(), "{n}");
        }
    }

    #[test]
    fn ends_off_the_grid_are_told_and_those_on_it_are_not() {
        let rays = RingRays::of(Outline::from_axes(100.0, 100.0, 15.0, 15.0, 0.0), 1.8);
        let off = |ends: &[[f64; 2]]| {
            let levels = ring(ends, rays.directions.len());
            let division = divide(&rays, &levels, 2.5, 12).unwrap();
            division.off_grid(&rays, &levels, 2.5)
        };
        let on = off(&[[1.0, 3.0], [5.0, 6.0], [8.0, 11.0]]);
        assert!(on < 0.3, "{on}");
        // a sector of 20 px: a quarter of it is 5 px
        let one = off(&[[1.0, 3.25], [5.0, 6.0], [8.0, 11.0]]);
        assert!(one > 1.5, "{one}");
    }
}
