//! Pictures of targets from an independent renderer: exact along each of many sub-rows, a sum across them. It shares
//! neither formula nor code with the engine's own rendering.

use nalgebra::{DMatrix, DVector};
use sightline::image::{Grey, Samples};
use sightline::noise::Noise;

/// A blurred ellipse: centre, semi-axes, angle of the first one, grey difference.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    pub u: f64,
    pub v: f64,
    pub a: f64,
    pub b: f64,
    pub angle: f64,
    pub contrast: f64,
}

/// A picture in the making, in grey levels.
pub struct Canvas {
    pub width: usize,
    pub height: usize,
    pub levels: Vec<f64>,
}

/// Sub-rows of a pixel; with a wider blur fewer do.
const SUB_ROWS: f64 = 24.0;

impl Canvas {
    pub fn new(width: usize, height: usize, level: f64) -> Self {
        Self { width, height, levels: vec![level; width * height] }
    }

    /// Adds a spot as a camera with a Gaussian point spread of sigma `s` and square pixels sees it.
    pub fn add(&mut self, spot: &Spot, s: f64) {
        let (sine, cosine) = spot.angle.sin_cos();
        // x' M x = 1
        let (ia, ib) = (spot.a.powi(-2), spot.b.powi(-2));
        let m11 = cosine * cosine * ia + sine * sine * ib;
        let m12 = sine * cosine * (ia - ib);
        let m22 = sine * sine * ia + cosine * cosine * ib;
        let half = (m11 / (m11 * m22 - m12 * m12)).sqrt();
        self.sweep(spot, s, half, |dy| {
            let rest = m12 * m12 * dy * dy - m11 * (m22 * dy * dy - 1.0);
            let (middle, wide) = (-m12 * dy / m11, rest.max(0.0).sqrt() / m11);
            Some([middle - wide, middle + wide])
        });
    }

    /// Adds what lies between two ends in every row up to `half` above and below a spot's centre, blurred.
    pub fn sweep(&mut self, spot: &Spot, s: f64, half: f64, ends: impl Fn(f64) -> Option<[f64; 2]>) {
        let reach = 5.0 * s + 1.0;
        let count = (2.0 * half * SUB_ROWS / (s / 0.7).clamp(1.0, 4.0)).ceil() as i32;
        let step = 2.0 * half / f64::from(count);
        let mut across = Vec::new();
        for k in 0..count {
            let dy = -half + (f64::from(k) + 0.5) * step;
            let Some([left, right]) = ends(dy) else { continue };
            let row = spot.v + dy;
            let columns = range(spot.u + left - reach, spot.u + right + reach, self.width);
            across.clear();
            across.extend(columns.clone().map(|x| {
                let place = x as f64 + 0.5 - spot.u;
                spot.contrast * step * (ramp(place - left, s) - ramp(place - right, s))
            }));
            for y in range(row - reach, row + reach, self.height) {
                let down = box_of(y as f64 + 0.5 - row, s);
                let levels = &mut self.levels[y * self.width..(y + 1) * self.width];
                for (level, across) in levels[columns.clone()].iter_mut().zip(&across) {
                    *level += down * across;
                }
            }
        }
    }

    /// The picture with noise, rounded to 8 bits.
    pub fn expose(&self, noise: f64, seed: u64) -> Grey {
        self.expose_with(|_| noise, seed)
    }

    /// The picture with noise that depends on the level.
    pub fn expose_with(&self, noise: impl Fn(f64) -> f64, seed: u64) -> Grey {
        let mut source = Noise::new(seed, 0);
        let sample = |level: &f64| (level + noise(*level) * source.normal()).round().clamp(0.0, 255.0) as u8;
        let samples = self.levels.iter().map(sample).collect();
        Grey { width: self.width, height: self.height, samples: Samples::U8(samples) }
    }
}

/// Cramér-Rao bound of a spot's centre per axis in pixels, by differences of painted pictures: unknown are centre, axes,
/// angle, contrast, blur and the first `background` terms of a plane (1 for a level, 3 with its slopes). The noise is the
/// picture's and that of rounding.
pub fn bound(spot: &Spot, blur: f64, noise: f64, background: usize) -> f64 {
    let size = (2.0 * (spot.a + 5.0 * blur + 8.0)) as usize;
    let middle = size as f64 / 2.0;
    let image = |k: usize, step: f64| {
        let d = |i: usize| if i == k { step } else { 0.0 };
        let mut canvas = Canvas::new(size, size, 0.0);
        let moved = Spot {
            u: middle + spot.u.fract() + d(0),
            v: middle + spot.v.fract() + d(1),
            a: spot.a + d(2),
            b: spot.b + d(3),
            angle: spot.angle + d(4) / spot.a,
            contrast: spot.contrast + d(5),
        };
        canvas.add(&moved, blur + d(6));
        DVector::from_vec(canvas.levels)
    };
    // a circle has no angle
    let shape = (0..7).filter(|k| *k != 4 || spot.a != spot.b);
    let mut columns: Vec<_> = shape.map(|k| (image(k, 0.02) - image(k, -0.02)) / 0.04).collect();
    let plane = |k: usize, i: usize| [1.0, (i % size) as f64 - middle, (i / size) as f64 - middle][k];
    columns.extend((0..background).map(|k| DVector::from_fn(size * size, |i, _| plane(k, i))));
    let design = DMatrix::from_columns(&columns);
    let cofactors = (design.transpose() * design).try_inverse().expect("regular");
    ((noise * noise + 1.0 / 12.0) * (cofactors[(0, 0)] + cofactors[(1, 1)]) / 2.0).sqrt()
}

fn range(from: f64, to: f64, size: usize) -> std::ops::Range<usize> {
    let last = (to.ceil().max(0.0) as usize).min(size);
    (from.floor().max(0.0) as usize).min(last)..last
}

/// Mean of a blurred point over a pixel at distance t.
fn box_of(t: f64, s: f64) -> f64 {
    below((t + 0.5) / s) - below((t - 0.5) / s)
}

/// Mean of a blurred step over a pixel at distance t.
fn ramp(t: f64, s: f64) -> f64 {
    let integral = |t: f64| t * below(t / s) + s * (-t * t / (2.0 * s * s)).exp() / std::f64::consts::TAU.sqrt();
    integral(t + 0.5) - integral(t - 0.5)
}

/// Normal distribution.
fn below(z: f64) -> f64 {
    0.5 * libm::erfc(-z * std::f64::consts::FRAC_1_SQRT_2)
}

/// Repeatable uniform numbers from 0 to 1.
pub struct Uniform(pub u64);

impl Uniform {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}
