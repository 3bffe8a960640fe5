//! A ring in polar coordinates of its target: positions in the photo and grey levels.
//!
//! The dot's circle of radius 1 is seen as an ellipse; so are the circles around it. With the target's plane (x, y), the
//! photo is A b(x, y) + centre, where A is the ellipse's matrix and b a projective map that keeps the unit circle. For a target that
//! is small against its distance b is the identity. Otherwise the plane is seen larger where it is nearer, and b is a
//! boost along the direction d of its slope,
//!
//! ```text
//! x along d, y across it:    b(x, y) = (x cosh h + sinh h, y) / (cosh h + x sinh h)
//! ```
//!
//! which shifts the centres of wide circles by about h (1 - r^2).
//!
//! The blur is a Gaussian of the target's own edge width, widened by the pixels and by the sampling between them. Across an
//! edge at a distance t a level is the share Φ(t / s) of the step.

use super::super::outline::Outline;
use crate::image::{Sample, SampleView};

/// Radii that are sampled: the first, their distance, their number.
const FIRST: f64 = 1.2;
const STEP: f64 = 0.09;
const COUNT: usize = 32;

/// Fewest and most directions.
const DIRECTIONS: (usize, usize) = (96, 240);

/// Variance that square pixels and bilinear sampling add to a blur, in square pixels.
const SAMPLING: f64 = 1.0 / 12.0 + 1.0 / 6.0;

/// Polar frame of a target's plane in the photo.
#[derive(Clone, Copy, Debug)]
pub(super) struct RingFrame {
    pub outline: Outline,
    /// Direction of the boost, and cosh and sinh of its size.
    direction: [f64; 2],
    boost: [f64; 2],
}

impl RingFrame {
    /// Of a dot, seen with a boost of `size` along its minor axis.
    pub fn new(outline: Outline, size: f64) -> Self {
        let (sine, cosine) = outline.axes().2.sin_cos();
        Self { outline, direction: [-sine, cosine], boost: [size.cosh(), size.sinh()] }
    }

    /// Place in the photo.
    #[inline]
    pub fn place(&self, radius: f64, [c, s]: [f64; 2]) -> [f64; 2] {
        let ([x, y], [dx, dy], [cosh, sinh]) = ([radius * c, radius * s], self.direction, self.boost);
        let (along, across) = (x * dx + y * dy, y * dx - x * dy);
        let scale = 1.0 / (cosh + along * sinh);
        let (along, across) = ((along * cosh + sinh) * scale, across * scale);
        let (x, y) = (along * dx - across * dy, along * dy + across * dx);
        let Outline { u, v, p, q, r } = self.outline;
        [u + p * x + r * y, v + r * x + q * y]
    }
}

/// The rays from a dot's centre on which the surroundings are read.
#[derive(Clone, Debug)]
pub(super) struct RingRays {
    /// Cosine and sine of each direction; those of the second half are opposite to those of the first.
    pub directions: Vec<[f64; 2]>,
    /// Pixels a radius across the rim and along it, in each direction.
    pub across: Vec<f64>,
    pub arc: Vec<f64>,
    /// Pixels a radius squared: the area that the unit square has in the photo.
    pub area: f64,
    pub outline: Outline,
    /// Blur as sigma in pixels.
    pub blur: f64,
}

/// Levels around a dot: grey levels as they are sampled, and less the background, as shares of the dot's contrast, once normalised.
#[derive(Clone, Debug)]
pub(super) struct Polar {
    /// Direction by direction, one level a radius; not a number outside of the picture.
    levels: Vec<f32>,
}

/// Radius of the k-th sample.
pub(super) fn radius(k: usize) -> f64 {
    FIRST + STEP * k as f64
}

/// The samples that lie between two radii.
pub(super) fn between([from, to]: [f64; 2]) -> std::ops::Range<usize> {
    let index = |radius: f64| (((radius - FIRST) / STEP).ceil().max(0.0) as usize).min(COUNT);
    index(from)..index(to)
}

impl RingRays {
    /// Of a dot of this edge width.
    pub fn of(outline: Outline, edge_width: f64) -> Self {
        let Outline { p, q, r, .. } = outline;
        let area = p * q - r * r;
        let around = 16.0 * area.sqrt();
        let count = (around as usize).next_multiple_of(2).clamp(DIRECTIONS.0, DIRECTIONS.1);
        let turn = std::f64::consts::TAU / count as f64;
        let directions: Vec<[f64; 2]> = (0..count).map(|k| (turn * k as f64).sin_cos()).map(|(s, c)| [c, s]).collect();
        let arc: Vec<f64> = directions.iter().map(|[c, s]| (r * c - p * s).hypot(q * c - r * s)).collect();
        let across = arc.iter().map(|arc| area / arc).collect();
        let blur = (edge_width * edge_width + SAMPLING).sqrt();
        Self { directions, across, arc, area, outline, blur }
    }

    /// Length in the photo of a radius in a direction.
    pub fn ray(&self, c: f64, s: f64) -> f64 {
        let Outline { p, q, r, .. } = self.outline;
        (p * c + r * s).hypot(r * c + q * s)
    }

    /// Pixels a radius of the target's plane between lines across this direction of it.
    pub fn pixels_along(&self, [x, y]: [f64; 2]) -> f64 {
        let Outline { p, q, r, .. } = self.outline;
        self.area * x.hypot(y) / (q * x - r * y).hypot(p * y - r * x).max(f64::MIN_POSITIVE)
    }

    /// The shares of what lies within the first of these radii, and between each and the next, that reach a radius in a direction.
    #[inline]
    pub fn bands<const N: usize>(&self, radius: f64, rims: [f64; N], direction: usize) -> [f64; N] {
        let scale = self.across[direction] / self.blur;
        let mut before = 1.0;
        rims.map(|rim| {
            let beyond = step((radius - rim) * scale);
            std::mem::replace(&mut before, beyond) - beyond
        })
    }
}

impl Polar {
    /// Samples the surroundings of a dot.
    pub fn sample<T: Sample>(plane: &SampleView<T>, frame: &RingFrame, rays: &RingRays) -> Self {
        let level = |radius: f64, direction: [f64; 2]| {
            let [x, y] = frame.place(radius, direction);
            if plane.holds(x, y, 0.0) { plane.sample(x as f32, y as f32) } else { f32::NAN }
        };
        let along = |direction: &[f64; 2]| {
            let direction = *direction;
            (0..COUNT).map(move |k| level(radius(k), direction))
        };
        Self { levels: rays.directions.iter().flat_map(along).collect() }
    }

    /// Levels of a direction.
    pub fn row(&self, direction: usize) -> &[f32] {
        &self.levels[direction * COUNT..(direction + 1) * COUNT]
    }

    /// Turns grey levels into shares of the contrast: takes off a background b0 + b1 x + b2 y and scales.
    pub fn normalise(&mut self, rays: &RingRays, background: [f64; 3], contrast: f64) {
        let scale = 1.0 / contrast;
        for (row, [c, s]) in self.levels.chunks_exact_mut(COUNT).zip(&rays.directions) {
            let slope = background[1] * c + background[2] * s;
            for (k, level) in row.iter_mut().enumerate() {
                *level = ((f64::from(*level) - background[0] - radius(k) * slope) * scale) as f32;
            }
        }
    }
}

/// Φ, from a table: to 2 in 10 000.
#[inline]
pub(super) fn step(t: f64) -> f64 {
    const REACH: f64 = 4.0;
    const CELLS: usize = 512;
    static TABLE: std::sync::OnceLock<[f32; CELLS + 2]> = std::sync::OnceLock::new();
    let table = TABLE.get_or_init(|| {
        std::array::from_fn(|k| {
            let t = REACH * (2.0 * k as f64 / CELLS as f64 - 1.0);
            (0.5 * libm::erfc(-t * std::f64::consts::FRAC_1_SQRT_2)) as f32
        })
    });
    let place = ((t + REACH) * (CELLS as f64 / (2.0 * REACH))).clamp(0.0, CELLS as f64);
    let cell = place as usize;
    let (low, high) = (f64::from(table[cell]), f64::from(table[cell + 1]));
    low + (place - cell as f64) * (high - low)
}
