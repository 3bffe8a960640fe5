//! Reading ring codes.
//!
//! Around the dot of radius 1 lies a gap to radius 2 and a ring from 2 to 3, divided into n equal sectors of the dot's grey
//! (1) or the background's (0). The dot's ellipse maps the circle of each radius into the photo, so that tilt and rotation
//! do not matter. The ring is sampled at radii around 2.5 in many directions; the division into n sectors whose
//! levels are purest is the code's phase. A bit's margin is its distance from the half-way level, 1 when it is as clear as
//! dot and background; the code's margin is that of its worst bit.

use std::sync::OnceLock;

use super::outline::Outline;
use crate::detection::Codes;
use crate::image::{Plane, Sample};
use crate::ring_code::{smallest_rotation, valid_codes};

/// Directions in which the ring is sampled: a multiple of 12, 14, 16 and 20.
const DIRECTIONS: usize = 1680 / 4;
/// Inner and outer radius of the ring, in radii of the dot.
pub(crate) const RING: (f64, f64) = (2.0, 3.0);
/// Smallest margin that is safe.
const SAFE: f64 = 0.3;

/// A family of ring codes: the number of bits, and the valid codes in the order of their numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Family {
    pub bits: u32,
    codes: &'static [u32],
}

impl Family {
    /// Families that a choice allows.
    pub fn of(codes: Codes) -> Vec<Self> {
        // the list of 20 bits takes a while: it is made once
        static LISTS: [OnceLock<Vec<u32>>; 4] = [const { OnceLock::new() }; 4];
        let all = [12, 14, 16, 20];
        let wanted: &[u32] = match codes {
            Codes::None => &[],
            Codes::Ring12 => &[12],
            Codes::Ring14 => &[14],
            Codes::Ring16 => &[16],
            Codes::Ring20 => &[20],
            Codes::Auto => &all,
        };
        all.into_iter()
            .zip(&LISTS)
            .filter(|(bits, _)| wanted.contains(bits))
            .map(|(bits, list)| Self { bits, codes: list.get_or_init(|| valid_codes(bits)) })
            .collect()
    }

    /// Number of a code given as its smallest rotation; none when it is not valid.
    fn number(&self, code: u32) -> Option<u32> {
        self.codes.iter().position(|&c| c == code).map(|place| place as u32 + 1)
    }
}

/// What was read around a dot.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Reading {
    /// No ring there.
    Plain,
    /// A ring that is safely one code.
    Code { number: u32, margin: f64 },
    /// A ring that is not safely read, and why.
    Unsafe { margin: f64, note: String },
}

/// Grey levels of a dot: inside and outside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DotLevels {
    pub dot: f64,
    pub background: f64,
}

/// Reads the ring around a dot as a code of the family.
pub(crate) fn read<T: Sample>(plane: &Plane<T>, dot: &Outline, levels: DotLevels, family: &Family) -> Reading {
    let share = |level: f64| (level - levels.background) / (levels.dot - levels.background);
    let ring = |radius: f64| -> Option<Vec<f64>> {
        let ellipse = dot.scaled(radius);
        super::edge::rim_points(&ellipse, DIRECTIONS)
            .map(|rim| {
                plane.holds(rim.x, rim.y, 0.0).then(|| share(f64::from(plane.sample(rim.x as f32, rim.y as f32))))
            })
            .collect()
    };
    let radii = [2.3, 2.5, 2.7].map(ring);
    let [Some(inner), Some(middle), Some(outer)] = radii else {
        return Reading::Plain;
    };
    let profile: Vec<f64> =
        inner.iter().zip(&middle).zip(&outer).map(|((a, b), c)| a.max(b.min(*c)).min(b.max(*c))).collect();
    let set = profile.iter().filter(|&&level| level > 0.5).count();
    if set * 2 < DIRECTIONS / family.bits as usize {
        return Reading::Plain;
    }
    let unsafe_ = |margin: f64, note: &str| Reading::Unsafe { margin, note: note.to_owned() };
    let gap =
        ring(1.5).map_or(1.0, |gap| gap.iter().filter(|level| level.abs() > 0.5).count() as f64 / DIRECTIONS as f64);
    if gap > 0.15 {
        return unsafe_(0.0, "the gap between dot and ring is not clear");
    }
    let (bits, margin) = divide(&profile, family.bits as usize);
    let code = smallest_rotation(bits, family.bits);
    if margin < SAFE {
        return unsafe_(margin, "a bit lies between light and dark");
    }
    match family.number(code) {
        Some(number) => Reading::Code { number, margin },
        None => unsafe_(margin, "the bits are no code of the family"),
    }
}

/// The purest division into `bits` sectors: the bits, the first direction's sector first, and the margin.
fn divide(profile: &[f64], bits: usize) -> (u32, f64) {
    let width = profile.len() / bits;
    // sectors are judged without their ends, where blur mixes neighbours
    let trim = width / 5;
    let mut best = (0, -1.0, -1.0);
    for phase in 0..width {
        let (mut code, mut margin, mut purity) = (0u32, 1.0f64, 0.0);
        for sector in 0..bits {
            let from = phase + sector * width;
            let mut sum = 0.0;
            for k in trim..width - trim {
                let level = profile[(from + k) % profile.len()].clamp(0.0, 1.0);
                sum += level;
                purity += (2.0 * level - 1.0).abs();
            }
            let mean = sum / (width - 2 * trim) as f64;
            margin = margin.min((2.0 * mean - 1.0).abs());
            code = code << 1 | u32::from(mean > 0.5);
        }
        let score = purity / profile.len() as f64 + margin;
        if score > best.2 {
            best = (code, margin, score);
        }
    }
    (best.0, best.1)
}
