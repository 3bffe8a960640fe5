//! Pictures of targets as encoders leave them: tables of the standard, of a camera and flat ones, grey and coloured with chroma at a
//! quarter, on level ground and among clutter.

use std::f64::consts::{PI, TAU};
use std::fmt;

use jpeg_encoder::{ColorType, Encoder, QuantizationTableType, SamplingFactor};
use sightline::decode;
use sightline::detection::{Channel, Detection};
use sightline::image::Grey;
use sightline::noise::Noise;

use super::painter::{Canvas, Spot, Uniform};

/// Tables of the quantisation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tables {
    /// Annex K of the standard, as libjpeg scales them.
    Standard,
    /// Of a camera: less difference between coarse and fine detail.
    Camera,
    /// The same for all frequencies.
    Flat,
}

const TABLES: [Tables; 3] = [Tables::Standard, Tables::Camera, Tables::Flat];
/// Side of a picture.
const SIZE: usize = 640;
/// Maximum number of targets of a picture.
const TARGETS: usize = 48;

/// A picture and what was done to it.
#[derive(Clone, Copy, Debug)]
pub struct Shot {
    /// From 50 to 98.
    pub quality: u8,
    pub tables: Tables,
    pub coloured: bool,
    pub noise: f64,
    /// Largest difference between targets and ground; each has four fifths of it or more.
    pub contrast: f64,
    pub blur: f64,
    pub cluttered: bool,
}

impl fmt::Display for Shot {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let Self { quality, tables, coloured, noise, contrast, blur, cluttered } = self;
        let colours = if *coloured { "colours" } else { "grey" };
        let ground = if *cluttered { "clutter" } else { "flat" };
        write!(
            to,
            "q {quality:>2} {tables:<8?} {colours:<7} {ground:<7} n {noise:.2} c {contrast:>3.0} s {blur:.2}",
            tables = *tables
        )
    }
}

impl Shot {
    /// One of all.
    pub fn drawn(seed: u64) -> Self {
        let mut random = scrambled(seed);
        Self {
            quality: random.within(50.0, 99.0) as u8,
            tables: TABLES[random.within(0.0, TABLES.len() as f64) as usize],
            coloured: random.next() < 0.5,
            noise: 0.5 * 10f64.powf(random.next()),
            contrast: 30.0 * (200.0f64 / 30.0).powf(random.next()),
            blur: random.within(0.6, 1.2),
            cluttered: random.next() < 0.5,
        }
    }

    /// The picture as a file, of targets of 6 to 40 px, and where they are.
    pub fn file(&self, seed: u64) -> (Vec<u8>, Vec<Spot>) {
        let mut random = scrambled(!seed);
        let bright = random.next() < 0.5;
        let sign = if bright { 1.0 } else { -1.0 };
        let ground =
            if bright { random.within(25.0, 45.0) } else { random.within(205.0, 235.0).max(self.contrast + 8.0) };
        let mut canvas = Canvas::new(SIZE, SIZE, ground);
        let mut spots: Vec<Spot> = Vec::new();
        for _ in 0..6_000 {
            if spots.len() == TARGETS {
                break;
            }
            let a = 3.0 * (20.0f64 / 3.0).powf(random.next());
            let room = 1.6 * a + 10.0;
            let [u, v] = [random.within(room, SIZE as f64 - room), random.within(room, SIZE as f64 - room)];
            let apart = |other: &Spot| (other.u - u).hypot(other.v - v) > 1.6 * (other.a + a) + 14.0;
            if spots.iter().all(apart) {
                let b = (a * random.within(0.6, 1.0)).max(2.6);
                let contrast = sign * self.contrast * random.within(0.8, 1.0);
                spots.push(Spot { u, v, a, b, angle: random.within(0.0, PI), contrast });
            }
        }
        if self.cluttered {
            clutter(&mut canvas, &spots, ground, sign, self.blur, &mut random);
        }
        spots.iter().for_each(|spot| canvas.add(spot, self.blur));
        let mut source = Noise::new(seed, 0);
        let samples: Vec<u8> = canvas
            .levels
            .iter()
            .map(|level| (level + self.noise * source.normal()).round().clamp(0.0, 255.0) as u8)
            .collect();
        (self.encoded(&samples), spots)
    }

    /// The same, decoded by the engine.
    pub fn picture(&self, seed: u64) -> (Grey, Vec<Spot>) {
        let (file, spots) = self.file(seed);
        (decode::grey(&file, Channel::Grey).expect("a JPEG"), spots)
    }

    fn encoded(&self, samples: &[u8]) -> Vec<u8> {
        let mut file = Vec::new();
        let mut encoder = Encoder::new(&mut file, self.quality);
        // as libjpeg makes a factor of a quality from 50 on
        let factor = (200.0 - 2.0 * f64::from(self.quality)) / 100.0;
        let table = |level: fn(f64, f64) -> f64| {
            let at = |k: usize| (factor * level((k % 8) as f64, (k / 8) as f64)).round().clamp(1.0, 255.0) as u16;
            QuantizationTableType::Custom(Box::new(std::array::from_fn(at)))
        };
        let camera = |i: f64, j: f64| 9.6 + 5.1 * (i + j) + 0.56 * (i * i + j * j);
        match self.tables {
            Tables::Standard => {}
            Tables::Camera => encoder.set_quantization_tables(table(camera), table(camera)),
            Tables::Flat => encoder.set_quantization_tables(table(|_, _| 16.0), table(|_, _| 16.0)),
        }
        let size = SIZE as u16;
        if self.coloured {
            encoder.set_sampling_factor(SamplingFactor::F_2_2);
            let tinted: Vec<u8> =
                samples.iter().flat_map(|grey| [*grey, *grey, (0.93 * f64::from(*grey)) as u8]).collect();
            encoder.encode(&tinted, size, size, ColorType::Rgb).expect("a JPEG");
        } else {
            encoder.encode(samples, size, size, ColorType::Luma).expect("a JPEG");
        }
        file
    }
}

/// Bars and clouds behind even cards, on which the targets lie.
fn clutter(canvas: &mut Canvas, spots: &[Spot], ground: f64, sign: f64, blur: f64, random: &mut Uniform) {
    let waves: [[f64; 4]; 24] = std::array::from_fn(|k| {
        let turn = random.within(0.0, PI);
        let length = if k % 2 == 0 { random.within(40.0, 200.0) } else { random.within(7.0, 20.0) };
        let pitch = TAU / length;
        [pitch * turn.cos(), pitch * turn.sin(), random.within(0.0, TAU), if k % 2 == 0 { 1.6 } else { 0.8 }]
    });
    for (k, level) in canvas.levels.iter_mut().enumerate() {
        let (x, y) = ((k % canvas.width) as f64, (k / canvas.width) as f64);
        *level += waves.iter().map(|[a, b, phase, size]| size * (a * x + b * y + phase).sin()).sum::<f64>();
    }
    let step = |t: f64| 0.5 * libm::erfc(-t / blur * std::f64::consts::FRAC_1_SQRT_2);
    for _ in 0..70 {
        let [u, v] = [random.within(0.0, SIZE as f64), random.within(0.0, SIZE as f64)];
        let (sine, cosine) = random.within(0.0, PI).sin_cos();
        let half = [random.within(1.0, 12.0), random.within(5.0, 60.0)];
        let grey = (ground + sign * random.within(-20.0, 80.0)).clamp(3.0, 252.0);
        let reach = half[0] + half[1] + 6.0;
        let bounds = |at: f64| (at - reach).max(0.0) as usize..((at + reach).max(0.0) as usize).min(SIZE);
        for y in bounds(v) {
            for x in bounds(u) {
                let [dx, dy] = [x as f64 + 0.5 - u, y as f64 + 0.5 - v];
                let (along, across) = (dx * cosine + dy * sine, dy * cosine - dx * sine);
                let inside =
                    (step(along + half[0]) - step(along - half[0])) * (step(across + half[1]) - step(across - half[1]));
                let level = &mut canvas.levels[y * SIZE + x];
                *level += inside * (grey - *level);
            }
        }
    }
    for spot in spots {
        let radius = 1.55 * spot.a + 6.0;
        let card = ground + random.within(-5.0, 5.0);
        let bounds = |at: f64| (at - radius - 4.0).max(0.0) as usize..((at + radius + 4.0).max(0.0) as usize).min(SIZE);
        for y in bounds(spot.v) {
            for x in bounds(spot.u) {
                let off = (x as f64 + 0.5 - spot.u).hypot(y as f64 + 0.5 - spot.v);
                let level = &mut canvas.levels[y * SIZE + x];
                *level += step(radius - off) * (card - *level);
            }
        }
    }
}

/// Numbers of a seed: its neighbours' are others (splitmix64).
fn scrambled(seed: u64) -> Uniform {
    let mut z = seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    Uniform(z ^ (z >> 31))
}

/// Measurements of the targets of some pictures.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sums {
    pub targets: usize,
    pub hits: usize,
    /// Of errors over sigmas, two a hit: squares, and the largest.
    pub square: f64,
    pub largest: f64,
    /// Of squared errors in pixels.
    pub errors: f64,
    /// False detections.
    pub others: usize,
}

impl Sums {
    pub fn add(&mut self, detection: &Detection, spots: &[Spot]) {
        self.targets += spots.len();
        let before = self.hits;
        for spot in spots {
            let near = |u: f64, v: f64| (u - spot.u).hypot(v - spot.v);
            let nearest = detection.targets.iter().min_by(|a, b| near(a.u, a.v).total_cmp(&near(b.u, b.v)));
            let Some(t) = nearest.filter(|t| near(t.u, t.v) < 1.0 + 0.1 * spot.b) else { continue };
            let error = [t.u - spot.u, t.v - spot.v];
            let over = [error[0] / t.sigma_u, error[1] / t.sigma_v];
            self.hits += 1;
            self.square += over[0].powi(2) + over[1].powi(2);
            self.largest = over.iter().fold(self.largest, |largest, z| largest.max(z.abs()));
            self.errors += error[0].powi(2) + error[1].powi(2);
        }
        self.others += detection.targets.len() - (self.hits - before);
    }

    /// Rms of error over sigma, per axis.
    pub fn honest(&self) -> f64 {
        (self.square / (2 * self.hits.max(1)) as f64).sqrt()
    }
}
