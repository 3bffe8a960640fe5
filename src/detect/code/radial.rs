//! Levels of gap, ring and background of a target, separated in each direction.
//!
//! Along a ray the levels above the background, as shares of the dot's contrast, are a sum of blurred bands,
//!
//! ```text
//! y(r) = Φ((1 - r) m / s) + gap B[1, r1] + ring B[r1, r2] + halves (B[r1, rm] - B[rm, r2]) / 2 + outside B[r2, r2 + w]
//! ```
//!
//! with m pixels a radius across the rim; least squares over the four. The background is a plane through what dot and ring
//! leave of each direction.

use std::rc::Rc;

use nalgebra::{Matrix3, Vector3, Vector4};

use super::bands::{BandSample, Bands};
use super::polar::{Polar, RingFrame, RingRays, between, step};
use super::sectors::{self, Division};
use super::{outline_of, sign};
use crate::detect::acceptance::code as limits;
use crate::detect::outline::Outline;
use crate::detection::Target;
use crate::image::{Sample, SampleView};

/// Radii of the dot where its level is taken: clear of a spot in its centre and of its rim.
const INSIDE: [f64; 3] = [0.3, 0.5, 0.7];
/// Radii between the dot and every family's ring.
const GAP: [f64; 3] = [1.4, 1.5, 1.6];
/// Where the first sample lies, and how far outside of the ring the background must be clear.
pub(super) const START: f64 = 1.2;
pub(super) const GROUND: f64 = 0.42;
/// Radii beyond a ring where another one is looked for, close enough together for a thin one.
const BEYOND: [f64; 11] = [0.55, 0.75, 0.95, 1.15, 1.35, 1.55, 1.75, 1.95, 2.15, 2.35, 2.55];
/// Radii of the first look, where every family's ring is.
const LOOKED_AT: [f64; 2] = [2.5, 2.9];
/// The same radii of dot, gap and ring where the outline is roughly known.
const ROUGHLY_INSIDE: f64 = 0.4;
const ROUGHLY_GAP: f64 = 1.5;
const ROUGHLY_RING: [f64; 4] = [2.1, 2.5, 2.9, 3.3];
/// Directions of a look.
const LOOKS: usize = 60;

/// Levels around a dot by direction.
#[derive(Clone, Debug)]
pub(super) struct Radial {
    pub rays: Rc<RingRays>,
    pub bands: Rc<Bands>,
    /// Sampled levels, as shares of the dot's contrast.
    pub polar: Polar,
    design: [f64; 2],
    middle: f64,
    pub ring: Vec<f64>,
    pub gap: Vec<f64>,
    pub halves: Vec<f64>,
    pub outside: Vec<f64>,
    /// How far the background of each direction, as it is without a gap, halves or outside of their own, lies from the plane through all.
    pub ground: Vec<f64>,
    /// Rms of what the bands leave.
    pub misfit: f64,
    /// The same of a model that has nothing but the ring, at one level in each direction.
    bare: f64,
    /// Share of the ring in what is sampled.
    share: f64,
    /// Share of directions in which something of the dot's colour stands beyond the ring's background, where that was examined.
    pub ringed: f64,
}

/// Level of the dot less that of the gap around it, where both are free of the rim.
pub(in crate::detect) fn contrast<T: Sample>(plane: &SampleView<T>, target: &Target) -> f64 {
    let [dot, gap] = levels(plane, target);
    (dot - gap).abs()
}

/// Level of the dot, and of the gap around it.
pub(super) fn levels<T: Sample>(plane: &SampleView<T>, target: &Target) -> [f64; 2] {
    let frame = RingFrame::new(outline_of(target), 0.0);
    [INSIDE, GAP].map(|radii| median(plane, &frame, radii))
}

/// Median level of the dot between its centre and its rim.
fn inside<T: Sample>(plane: &SampleView<T>, frame: &RingFrame) -> f64 {
    median(plane, frame, INSIDE)
}

/// Median level at these radii.
fn median<T: Sample>(plane: &SampleView<T>, frame: &RingFrame, radii: [f64; 3]) -> f64 {
    const AROUND: usize = 24;
    let mut levels = Vec::with_capacity(radii.len() * AROUND);
    for k in 0..AROUND {
        let (s, c) = (std::f64::consts::TAU * k as f64 / AROUND as f64).sin_cos();
        levels.extend(radii.map(|radius| {
            let [x, y] = frame.place(radius, [c, s]);
            plane.sample(x as f32, y as f32)
        }));
    }
    let half = levels.len() / 2;
    f64::from(*levels.select_nth_unstable_by(half, f32::total_cmp).1)
}

/// Whether anything of the dot's colour stands where a ring would be.
pub(super) fn may_have_ring<T: Sample>(plane: &SampleView<T>, target: &Target) -> bool {
    let seen = like_dot(plane, target, &RingFrame::new(outline_of(target), 0.0), &LOOKED_AT);
    seen * limits::LOOKED >= LOOKS
}

/// Whether something of an outline that is roughly known may be a dot in a ring: a gap around it, from which it stands out by `least`, and
/// something of its colour where a ring would be.
pub(in crate::detect) fn may_be_in_ring<T: Sample>(
    plane: &SampleView<T>,
    outline: &Outline,
    bright: bool,
    least: f64,
) -> bool {
    const AROUND: usize = 24;
    let frame = RingFrame::new(*outline, 0.0);
    let directions: [[f64; 2]; AROUND] = std::array::from_fn(|k| {
        let (s, c) = (std::f64::consts::TAU * k as f64 / AROUND as f64).sin_cos();
        [c, s]
    });
    let level = |radius: f64, k: usize| {
        let [x, y] = frame.place(radius, directions[k]);
        let level = f64::from(plane.nearest(x, y));
        if bright { level } else { -level }
    };
    let dot = (level(0.0, 0) + (0..4).map(|k| level(ROUGHLY_INSIDE, k * AROUND / 4)).sum::<f64>()) / 5.0;
    let mut gap: [f64; AROUND] = std::array::from_fn(|k| level(ROUGHLY_GAP, k));
    gap.sort_unstable_by(f64::total_cmp);
    let contrast = dot - gap[AROUND / 4];
    let is_like = |k: usize| ROUGHLY_RING.iter().any(|radius| dot - level(*radius, k) < (1.0 - limits::SET) * contrast);
    contrast >= least && (0..AROUND).filter(|k| is_like(*k)).count() * limits::LOOKED >= AROUND
}

/// Number of the [`LOOKS`] directions in which something of the dot's colour stands at one of these radii.
fn like_dot<T: Sample>(plane: &SampleView<T>, target: &Target, frame: &RingFrame, radii: &[f64]) -> usize {
    let dot = inside(plane, frame);
    let limit = (1.0 - limits::SET) * target.contrast.min(f64::from(T::MAX));
    let is_like = |direction: [f64; 2], radius: f64| {
        let [x, y] = frame.place(radius, direction);
        plane.holds(x, y, 0.0) && sign(target) * (dot - f64::from(plane.sample(x as f32, y as f32))) < limit
    };
    let directions = (0..LOOKS).map(|k| (std::f64::consts::TAU * k as f64 / LOOKS as f64).sin_cos());
    directions.filter(|(s, c)| radii.iter().any(|radius| is_like([*c, *s], *radius))).count()
}

impl Radial {
    /// Of a target as it was sampled in this frame, with the bands of a design; `None` if the ring leaves the picture or the dot has no
    /// contrast.
    pub fn of<T: Sample>(
        plane: &SampleView<T>,
        target: &Target,
        frame: &RingFrame,
        polar: &Polar,
        bands: &Rc<Bands>,
    ) -> Option<Self> {
        let whole = between([START, bands.design[1] + 0.1]);
        let rays = &bands.rays;
        if (0..rays.directions.len()).any(|j| polar.row(j)[whole.clone()].iter().any(|level| level.is_nan())) {
            return None;
        }
        let dot = inside(plane, frame);
        let mut contrast = sign(target) * target.contrast;
        let (mut background, mut off) = ([0.0; 3], Vec::new());
        let (grounds, seen) = (grounds(polar, bands), seen_inside(rays));
        for _ in 0..2 {
            (background, off) = ground(&grounds, contrast, bands)?;
            contrast = (dot - background[0]) / seen;
        }
        if !(contrast * sign(target) > limits::CONTRAST) {
            return None;
        }
        let mut polar = polar.clone();
        polar.normalise(rays, background, contrast);
        off.iter_mut().for_each(|level| *level /= contrast);
        Some(Self::separate(polar, bands, off))
    }

    /// The same with what stands around the ring in this frame.
    pub fn with_neighbours<T: Sample>(self, plane: &SampleView<T>, target: &Target, frame: &RingFrame) -> Self {
        let radii = BEYOND.map(|beyond| self.design[1] + beyond);
        Self { ringed: like_dot(plane, target, frame, &radii) as f64 / LOOKS as f64, ..self }
    }

    /// Whether the ring is too faint in every direction for sectors of it to be set: where it is narrow against its blur, they show less.
    pub fn is_faint(&self) -> bool {
        self.ring.iter().all(|level| *level < limits::FAINT * limits::HIGH.start)
    }

    /// Whether so much stands beside the ring where it is set, in the gap, in one of its halves or outside, that it is none: what a look at the
    /// sectors would tell too, at a hundred times the work.
    pub fn is_clutter(&self) -> bool {
        let top = self.ring.iter().copied().fold(0.0, f64::max);
        let set = || (0..self.ring.len()).filter(|j| self.ring[*j] > top / 2.0);
        let sum = |levels: &[f64]| set().map(|j| levels[j]).sum::<f64>();
        let most = limits::BESIDE * sum(&self.ring);
        [&self.gap, &self.halves, &self.outside].iter().any(|levels| !(sum(levels).abs() <= most))
    }

    /// Width of one of `n` sectors in the middle of the ring, in pixels.
    pub fn sector(&self, n: usize) -> f64 {
        std::f64::consts::TAU / n as f64 * self.middle * self.rays.area.sqrt()
    }

    fn separate(polar: Polar, bands: &Rc<Bands>, ground: Vec<f64>) -> Self {
        let [inner, outer] = bands.design;
        let count = bands.rays.directions.len();
        let [mut ring, mut gap, mut halves, mut outside] = [(); 4].map(|()| Vec::with_capacity(count));
        let (mut squares, mut number) = (0.0, 0);
        for j in 0..count {
            let (levels, row) = (&polar.row(j)[bands.samples.clone()], bands.row(j));
            let is_whole = levels.iter().all(|level| !level.is_nan());
            let seen = || levels.iter().zip(row).filter(|(level, _)| !level.is_nan());
            let mut right = Vector4::<f64>::zeros();
            for (level, BandSample { dot, basis }) in seen() {
                right += basis * (f64::from(*level) - dot);
            }
            let factor = if is_whole { bands.factor(j) } else { bands.factor_of(seen().map(|(_, band)| band)) };
            let found = factor.map_or_else(Vector4::zeros, |factor| factor.solve(&right));
            gap.push(found[0]);
            ring.push(found[1]);
            halves.push(found[2]);
            outside.push(found[3]);
            for (level, BandSample { dot, basis }) in seen() {
                squares += (f64::from(*level) - dot - basis.dot(&found)).powi(2);
                number += 1;
            }
        }
        let misfit = (squares / f64::from(number.max(1u32))).sqrt();
        // what gap, halves and outside have taken up, each over its width
        let mean_square = |levels: &[f64]| levels.iter().map(|level| level * level).sum::<f64>() / count as f64;
        let taken = mean_square(&gap) * (inner - START)
            + mean_square(&halves) / 4.0 * (outer - inner)
            + mean_square(&outside) * GROUND;
        let bare = (misfit * misfit + taken / (outer + GROUND - START)).sqrt();
        let share = (outer - inner) / (outer + GROUND - START);
        Self {
            rays: bands.rays.clone(),
            bands: bands.clone(),
            polar,
            design: [inner, outer],
            middle: (inner + outer) / 2.0,
            ring,
            gap,
            halves,
            outside,
            ground,
            misfit,
            bare,
            share,
            ringed: 0.0,
        }
    }

    /// Largest distance of an arc's end from the grid of a division, over what it may be.
    pub fn off_grid(&self, division: &Division) -> f64 {
        division.off_grid(&self.rays, &self.ring, self.middle)
    }

    /// Larger distance of the ring's two rims from those of the design, over what it may be, from means of gap, halves and outside as
    /// shares of the ring's level. A rim aside by d leaves d, as an integral over the radius, in the bands on both sides of it.
    pub fn off_rims(&self, [gap, halves, outside]: [f64; 3]) -> f64 {
        let [inner, outer] = self.design;
        let uneven = halves / 2.0 * (outer - inner) / 2.0;
        let [first, second] = [gap * (inner - 1.0) + uneven, outside * GROUND - uneven];
        first.abs().max(second.abs()) / (limits::RIMS[0] + limits::RIMS[1] / self.rays.area.sqrt())
    }

    /// Rms of what a division leaves of the whole picture of gap, ring and outside, over the step between its levels.
    pub fn whole_misfit(&self, division: &Division) -> f64 {
        let bare = self.bare / (division.high - division.low);
        (bare * bare + self.share * division.misfit * division.misfit).sqrt()
    }

    /// What a division leaves of a direction even where each sector has a level of its own, over what it may be: arcs that end between the
    /// sectors leave more than the picture's noise, which is in what the bands leave.
    pub fn left(&self, division: &Division) -> f64 {
        let (count, directions) = (division.sigmas.len() as f64, self.ring.len() as f64);
        let left = division.sigmas.iter().sum::<f64>() / count * (directions / count).sqrt();
        left / (limits::LEFT[0] * (division.high - division.low)).max(limits::LEFT[1] * self.misfit)
    }

    /// The ring's division into sectors.
    pub fn divide(&self, bits: u32) -> Option<Division> {
        sectors::divide(&self.rays, &self.ring, self.middle, bits)
    }
}

/// Share of the dot's contrast that blur leaves where its level is taken.
fn seen_inside(rays: &RingRays) -> f64 {
    let share = |across: f64, r: f64| {
        let scale = across / rays.blur;
        step((1.0 - r) * scale) + step((1.0 + r) * scale) - 1.0
    };
    let sum: f64 = rays.across.iter().flat_map(|across| INSIDE.map(|r| share(*across, r))).sum();
    (sum / (INSIDE.len() * rays.across.len()) as f64).max(0.5)
}

/// The level of each direction beside a ring of any level and a dot without contrast, and what a dot's contrast takes off it: least squares
/// over the level and that of the ring.
fn grounds(polar: &Polar, bands: &Bands) -> Vec<[f64; 2]> {
    let of = |j: usize| {
        let (mut number, mut ring, mut square) = (0.0, 0.0, 0.0);
        let (mut sums, mut with_ring) = ([0.0; 2], [0.0; 2]);
        for (level, BandSample { dot, basis }) in polar.row(j)[bands.samples.clone()].iter().zip(bands.row(j)) {
            let level = f64::from(*level);
            if level.is_nan() {
                continue;
            }
            let share = basis[1];
            (number, ring, square) = (number + 1.0, ring + share, square + share * share);
            for (k, value) in [level, *dot].into_iter().enumerate() {
                sums[k] += value;
                with_ring[k] += share * value;
            }
        }
        let determinant = number * square - ring * ring;
        let first = |k: usize| (square * sums[k] - ring * with_ring[k]) / determinant;
        if determinant > 0.0 { [first(0), first(1)] } else { [f64::NAN; 2] }
    };
    (0..bands.rays.directions.len()).map(of).collect()
}

/// Background at the dot's centre and its slope along x and y of the target's plane, in levels a radius.
///
/// Each direction gives the level that a dot of this contrast and a ring of any level leave; the plane goes through those that
/// agree.
fn ground(grounds: &[[f64; 2]], contrast: f64, bands: &Bands) -> Option<([f64; 3], Vec<f64>)> {
    let middle = (START + bands.design[1] + GROUND) / 2.0;
    let count = grounds.len();
    let levels: Vec<f64> = grounds.iter().map(|[level, dot]| level - contrast * dot).collect();
    let mut kept: Vec<bool> = levels.iter().map(|level| level.is_finite()).collect();
    let mut plane = Vector3::zeros();
    let basis = |j: usize| {
        let [c, s] = bands.rays.directions[j];
        Vector3::new(1.0, middle * c, middle * s)
    };
    for distance in limits::GROUND {
        let mut normal = Matrix3::<f64>::zeros();
        let mut right = Vector3::<f64>::zeros();
        for j in (0..count).filter(|j| kept[*j]) {
            normal += basis(j) * basis(j).transpose();
            right += basis(j) * levels[j];
        }
        plane = normal.cholesky()?.solve(&right);
        let limit = contrast.abs() * distance;
        for j in 0..count {
            kept[j] = (levels[j] - basis(j).dot(&plane)).abs() < limit;
        }
        if kept.iter().filter(|kept| **kept).count() * 2 < count {
            return None;
        }
    }
    let off =
        levels.iter().enumerate().map(|(j, level)| if level.is_finite() { level - basis(j).dot(&plane) } else { 0.0 });
    Some(([plane[0], plane[1], plane[2]], off.collect()))
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn a_dot_may_stand_in_a_ring_where_a_gap_and_something_of_its_colour_are_around_it() {
        // dots of 5 px: in a ring of two sectors, alone, joined with what lies around, and on the other polarity's background
        let seen = |ring: [f64; 2], gap: f64, bright: bool| {
            let level = |i: usize| {
                let [x, y] = [(i % 60) as f64 - 29.5, (i / 60) as f64 - 29.5];
                let radius = x.hypot(y) / 5.0;
                let in_ring = (ring[0]..ring[1]).contains(&radius) && y.abs() < 0.5 * x;
                if radius < 1.0 || in_ring {
                    200
                } else if radius < 2.0 {
                    gap as u8
                } else {
                    40
                }
            };
            let samples: Vec<u8> = (0..60 * 60).map(level).collect();
            // the outline is known to a fifth of its size
            [4.2, 5.0, 5.8].map(|radius| {
                let outline = Outline::from_axes(30.0, 30.0, radius, radius, 0.0);
                may_be_in_ring(&SampleView::new(60, 60, &samples), &outline, bright, 60.0)
            })
        };
        assert_eq!(seen([2.0, 3.0], 40.0, true), [true; 3]);
        assert_eq!(seen([2.28, 3.54], 40.0, true), [true; 3]);
        assert_eq!(seen([0.0, 0.0], 40.0, true), [false; 3]);
        assert_eq!(seen([2.0, 3.0], 170.0, true), [false; 3]);
        assert_eq!(seen([2.0, 3.0], 40.0, false), [false; 3]);
    }
}
