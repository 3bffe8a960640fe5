//! Ring codes of every family, turned, tilted, blurred, in uneven light: read rightly or not at all.

use crate::painter::Uniform;
use sightline::detect::detect;
use sightline::detection::{Codes, DetectOptions, Detection, Reason};
use sightline::image::{GreyView, SamplesView};
use sightline::noise::Noise;
use sightline::ring_code::valid_codes;

const FAMILIES: [(u32, Codes); 4] =
    [(12, Codes::Ring12), (14, Codes::Ring14), (16, Codes::Ring16), (20, Codes::Ring20)];
/// Targets a row and a column of a picture, and their distance in pixels.
const COUNT: usize = 6;
const PITCH: usize = 110;
/// Sub-pixels a pixel.
const FINE: usize = 4;

/// One coded target: where, how large, how it lies.
struct Coded {
    u: f64,
    v: f64,
    /// Radius of the dot, in pixels, where it is not foreshortened.
    radius: f64,
    /// Cosine of the tilt, and the direction of the axis that stays long.
    squeeze: f64,
    axis: f64,
    /// Direction of the first bit.
    start: f64,
    code: u32,
    number: u32,
}

impl Coded {
    /// Narrowest width of a bit in the middle of the ring, in pixels.
    fn bit_px(&self, bits: u32) -> f64 {
        2.5 * self.radius * self.squeeze * std::f64::consts::TAU / f64::from(bits)
    }

    /// Whether a place shows the dot's colour.
    fn is_marked(&self, x: f64, y: f64, bits: u32) -> bool {
        let (sine, cosine) = self.axis.sin_cos();
        let (dx, dy) = (x - self.u, y - self.v);
        let (along, across) = (dx * cosine + dy * sine, (dy * cosine - dx * sine) / self.squeeze);
        let radius = along.hypot(across) / self.radius;
        if radius < 1.0 {
            return true;
        }
        // clockwise as seen: v points down
        let turn = (across.atan2(along) - self.start).rem_euclid(std::f64::consts::TAU) / std::f64::consts::TAU;
        let sector = ((turn * f64::from(bits)) as u32).min(bits - 1);
        (2.0..3.0).contains(&radius) && self.code >> (bits - 1 - sector) & 1 == 1
    }
}

/// A picture of coded targets, its light falling off from the left to the right, steeper across each target.
struct Plate {
    coded: Vec<Coded>,
    samples: Vec<u8>,
}

fn plate(bits: u32, codes: &[u32], blur: f64, dark: bool, random: &mut Uniform, seed: u64) -> Plate {
    let size = COUNT * PITCH;
    let coded: Vec<Coded> = (0..COUNT * COUNT)
        .map(|k| {
            let place = |i: usize, random: &mut Uniform| (i as f64 + 0.5) * PITCH as f64 + random.within(-2.0, 2.0);
            let index = (random.next() * codes.len() as f64) as usize;
            let squeeze = random.within(0.0, 60f64.to_radians()).cos();
            Coded {
                u: place(k % COUNT, random),
                v: place(k / COUNT, random),
                radius: random.within(5.0, 16.0),
                squeeze,
                axis: random.within(0.0, std::f64::consts::PI),
                start: random.within(0.0, std::f64::consts::TAU),
                code: codes[index],
                number: index as u32 + 1,
            }
        })
        .collect();
    let fine = FINE * size;
    let mut marked = vec![0f32; fine * fine];
    for (k, target) in coded.iter().enumerate() {
        let (left, top) = (k % COUNT * PITCH * FINE, k / COUNT * PITCH * FINE);
        for y in top..top + PITCH * FINE {
            for x in left..left + PITCH * FINE {
                let [px, py] = [x, y].map(|i| (i as f64 + 0.5) / FINE as f64);
                marked[y * fine + x] = f32::from(u8::from(target.is_marked(px, py, bits)));
            }
        }
    }
    let marked = blurred(&blurred(&marked, fine, blur), fine, blur);
    let mut noise = Noise::new(seed, 0);
    let samples = (0..size * size)
        .map(|i| {
            let (x, y) = (i % size, i / size);
            let sum: f32 = (0..FINE * FINE).map(|k| marked[(y * FINE + k / FINE) * fine + x * FINE + k % FINE]).sum();
            let share = f64::from(sum) / (FINE * FINE) as f64;
            let paint = if dark { 1.0 - 0.85 * share } else { 0.15 + 0.85 * share };
            let light = (1.0 - 0.4 * x as f64 / size as f64) * (1.0 - 0.25 * (y % PITCH) as f64 / PITCH as f64);
            (220.0 * paint * light + 2.0 * noise.normal()).round().clamp(0.0, 255.0) as u8
        })
        .collect();
    Plate { coded, samples }
}

/// Rows blurred, and the picture turned over its diagonal: twice gives both directions.
fn blurred(picture: &[f32], size: usize, blur: f64) -> Vec<f32> {
    let sigma = blur * FINE as f64;
    let side = (4.0 * sigma).ceil() as usize;
    let kernel: Vec<f32> =
        (0..=2 * side).map(|i| (-((i as f64 - side as f64) / sigma).powi(2) / 2.0).exp() as f32).collect();
    let sum: f32 = kernel.iter().sum();
    let mut out = vec![0f32; picture.len()];
    let mut row = vec![0f32; size + 2 * side];
    for y in 0..size {
        row[side..side + size].copy_from_slice(&picture[y * size..(y + 1) * size]);
        for x in 0..size {
            let value: f32 = row[x..].iter().zip(&kernel).map(|(level, weight)| level * weight).sum();
            out[x * size + y] = value / sum;
        }
    }
    out
}

fn read(plate: &Plate, codes: Codes) -> Detection {
    let size = COUNT * PITCH;
    let view = GreyView::new(size, size, SamplesView::U8(&plate.samples)).expect("a picture");
    detect(&view, &DetectOptions { codes, ..DetectOptions::default() }).expect("valid options")
}

#[test]
fn every_family_is_read_rightly_or_not_at_all() {
    let mut random = Uniform(1);
    let (mut legible, mut read_of_all, mut parts) = (0, 0, 0);
    for (bits, family) in FAMILIES {
        let codes = valid_codes(bits);
        for (seed, blur, dark) in [(1, 0.6, false), (2, 0.9, true), (3, 1.2, false)] {
            let plate = plate(bits, &codes, blur, dark, &mut random, seed);
            let found = read(&plate, family);
            assert_eq!(read(&plate, Codes::Auto), found, "auto reads another family than {bits}");
            parts += found.rejected.get(&Reason::CodeRing).copied().unwrap_or(0);
            let dot =
                |target: &&Coded| found.targets.iter().find(|dot| (dot.u - target.u).hypot(dot.v - target.v) < 2.0);
            for target in &plate.coded {
                let number = dot(&target).and_then(|dot| dot.code);
                assert!(number.is_none_or(|number| number == target.number), "{number:?} for {}", target.number);
                if target.bit_px(bits) >= 2.5 {
                    legible += 1;
                    read_of_all += usize::from(number.is_some());
                }
            }
            // parts of rings remain only where the dot itself was lost
            let lost = plate.coded.iter().filter(|target| dot(target).and_then(|dot| dot.code).is_none());
            let lost: Vec<_> = lost.collect();
            for target in found.targets.iter().filter(|target| target.code.is_none()) {
                let beside = lost.iter().any(|dot| (dot.u - target.u).hypot(dot.v - target.v) < 3.2 * dot.radius);
                assert!(beside, "{bits} bits: a part of a ring at {} {}", target.u, target.v);
            }
        }
    }
    println!("{read_of_all} of {legible} codes read, {parts} parts of rings left out");
    assert!(100 * read_of_all >= 97 * legible, "{read_of_all} of {legible}");
    assert!(legible > 400 && parts > 0, "{legible} {parts}");
}
