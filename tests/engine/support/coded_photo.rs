//! Photos of ring codes as a camera's own development leaves them: lens and pixels blur light, then come a tone curve with a shoulder and a
//! foot, and a sharpening with its halo.

use std::f64::consts::TAU;

use sightline::image::{Grey, Samples};
use sightline::noise::Noise;
use sightline::ring_code::{Family, coarser_grid};

use super::painter::Uniform;

/// A coded target: centre, radius of the dot, cosine of the tilt and the direction that stays long, first bit.
#[derive(Clone, Copy, Debug)]
pub struct Coded {
    pub u: f64,
    pub v: f64,
    pub radius: f64,
    pub squeeze: f64,
    axis: f64,
    start: f64,
    code: u32,
    pub number: u32,
}

/// Targets a row and a column, their distance in pixels, and sub-pixels a pixel.
const COUNT: usize = 6;
const PITCH: usize = 120;
const FINE: usize = 3;

/// How a photo was developed.
#[derive(Clone, Copy, Debug)]
pub struct Development {
    pub blur: f64,
    pub dark: bool,
    /// Exponent of the curve, and how much of an S it is.
    pub gamma: f64,
    pub shoulder: f64,
    /// Amount and sigma of the unsharp mask.
    pub amount: f64,
    pub radius: f64,
    pub noise: f64,
}

impl Development {
    /// At random, from hardly any to more than a photo bears.
    pub fn drawn(random: &mut Uniform) -> Self {
        Self {
            blur: random.within(0.6, 1.2),
            dark: random.next() < 0.5,
            gamma: random.within(1.6, 2.6),
            shoulder: random.within(0.0, 0.8),
            amount: random.within(0.3, 2.0),
            radius: random.within(0.7, 2.2),
            noise: random.within(0.5, 2.0),
        }
    }

    /// Grey level of light, both from 0 to 1.
    fn tone(&self, light: f64) -> f64 {
        let level = light.clamp(0.0, 1.0).powf(1.0 / self.gamma);
        let smooth = level * level * (3.0 - 2.0 * level);
        level + self.shoulder * (smooth - level)
    }
}

impl Coded {
    /// Radii of the dot from its centre, and turns from the first bit.
    pub fn polar(&self, x: f64, y: f64) -> [f64; 2] {
        let (s, c) = self.axis.sin_cos();
        let (dx, dy) = (x - self.u, y - self.v);
        let (along, across) = (dx * c + dy * s, (dy * c - dx * s) / self.squeeze);
        [along.hypot(across) / self.radius, ((across.atan2(along) - self.start) / TAU).rem_euclid(1.0)]
    }

    fn is_marked(&self, x: f64, y: f64, family: Family) -> bool {
        let ([inner, outer], bits) = (family.design().ring(), family.bits());
        let [radius, turn] = self.polar(x, y);
        if radius < 1.0 {
            return radius >= family.design().spot();
        }
        let sector = ((turn * f64::from(bits)) as u32).min(bits - 1);
        (inner..outer).contains(&radius) && self.code >> (bits - 1 - sector) & 1 == 1
    }
}

/// A photo of codes of a family with dots of these radii.
pub fn photo(
    random: &mut Uniform,
    family: Family,
    radii: [f64; 2],
    how: &Development,
    seed: u64,
) -> (Grey, Vec<Coded>) {
    let side = COUNT * PITCH;
    let codes: Vec<(u32, u32)> = (1..)
        .zip(family.codes())
        .filter(|(_, code)| coarser_grid(**code, family.bits()).is_none())
        .map(|(number, code)| (number, *code))
        .collect();
    let coded: Vec<Coded> = (0..COUNT * COUNT)
        .map(|k| {
            let mut place = |i: usize| (i as f64 + 0.5) * PITCH as f64 + random.within(-2.0, 2.0);
            let (u, v) = (place(k % COUNT), place(k / COUNT));
            let (number, code) = codes[(random.next() * codes.len() as f64) as usize];
            let squeeze = random.within(0.6, 1.0);
            let radius = random.within(radii[0], radii[1]);
            Coded { u, v, radius, squeeze, axis: random.within(0.0, 3.1), start: random.within(0.0, TAU), code, number }
        })
        .collect();
    let [ground, ink] = if how.dark { [0.75, 0.04] } else { [0.04, 0.75] };
    let fine = FINE * side;
    let mut light: Vec<f64> = (0..fine * fine)
        .map(|i| {
            let [x, y] = [i % fine, i / fine].map(|k| (k as f64 + 0.5) / FINE as f64);
            let cell = (y as usize / PITCH) * COUNT + x as usize / PITCH;
            if coded[cell].is_marked(x, y, family) { ink } else { ground }
        })
        .collect();
    light = mean(&light, fine, how.blur * FINE as f64);
    let mut levels: Vec<f64> = (0..side * side)
        .map(|i| {
            let (x, y) = (i % side, i / side);
            let sum: f64 = (0..FINE * FINE).map(|k| light[(y * FINE + k / FINE) * fine + x * FINE + k % FINE]).sum();
            let lamp = 1.0 - 0.3 * x as f64 / side as f64;
            255.0 * how.tone(lamp * sum / (FINE * FINE) as f64)
        })
        .collect();
    let mut noise = Noise::new(seed, 0);
    levels.iter_mut().for_each(|level| *level += how.noise * noise.normal() / (1.0 + how.amount));
    let soft = mean(&levels, side, how.radius);
    let samples = levels.iter().zip(soft).map(|(level, soft)| level + how.amount * (level - soft));
    let samples = samples.map(|level| level.round().clamp(0.0, 255.0) as u8).collect();
    (Grey { width: side, height: side, samples: Samples::U8(samples) }, coded)
}

/// A Gaussian mean, rows first, then columns.
fn mean(picture: &[f64], side: usize, sigma: f64) -> Vec<f64> {
    let half = (4.0 * sigma).ceil() as i64;
    let weights: Vec<f64> = (-half..=half).map(|k| (-0.5 * (k as f64 / sigma).powi(2)).exp()).collect();
    let sum: f64 = weights.iter().sum();
    let turned = |from: &[f64]| {
        let mut to = vec![0.0; side * side];
        for (y, row) in from.chunks(side).enumerate() {
            for x in 0..side {
                let at = |k: i64| row[(x as i64 + k).clamp(0, side as i64 - 1) as usize];
                to[x * side + y] = (-half..=half).zip(&weights).map(|(k, w)| w * at(k)).sum::<f64>() / sum;
            }
        }
        to
    };
    turned(&turned(picture))
}
