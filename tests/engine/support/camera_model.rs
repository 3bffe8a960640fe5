//! Pictures as cameras make them of targets whose truth is known: exposure, noise, clipping, tone curve, sharpening, JPEG.

use std::fmt;

use sightline::detection::Detection;
use sightline::image::{Grey, Samples};
use sightline::noise::Noise;

use super::painter::{Canvas, Spot, Uniform};

/// What a camera does to the light.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    pub sharpening: f64,
    pub radius: f64,
    pub exposure: f64,
    pub gamma: f64,
    pub quality: u8,
    pub noise: f64,
    pub blur: f64,
}

impl fmt::Display for Camera {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let Self { sharpening, radius, exposure, gamma, quality, noise, blur } = self;
        write!(
            to,
            "a {sharpening:.2} r {radius:.2} e {exposure:.2} g {gamma:.2} q {quality:>3} n {noise:>4.1} s {blur:.2}"
        )
    }
}

/// Levels of the scene at exposure 1 on a scale to 255: paper and ink, or ground and retro target.
const PAPER: f64 = 190.0;
const INK: f64 = 40.0;
const SIZE: usize = 900;

impl Camera {
    /// One of all cameras.
    pub fn drawn(seed: u64) -> Self {
        let mut random = scrambled(seed);
        Self {
            sharpening: random.within(0.0, 2.0),
            radius: random.within(0.6, 1.5),
            exposure: 0.3 * (2.0f64 / 0.3).powf(random.next()),
            gamma: random.within(1.0, 2.4),
            quality: random.within(30.0, 100.5) as u8,
            noise: 20f64.powf(random.next()),
            blur: random.within(0.5, 3.0),
        }
    }

    /// Its picture of 60 to 100 targets of 8 to 60 px, dark on paper or bright on a dark ground, and where they are.
    pub fn picture(&self, seed: u64) -> (Grey, Vec<Spot>) {
        let mut random = scrambled(!seed);
        let bright = random.next() < 0.5;
        let (ground, contrast) = if bright { (INK, PAPER - INK) } else { (PAPER, INK - PAPER) };
        let mut canvas = Canvas::new(SIZE, SIZE, ground);
        let wanted = random.within(60.0, 101.0) as usize;
        let mut spots: Vec<Spot> = Vec::new();
        for _ in 0..20_000 {
            if spots.len() == wanted {
                break;
            }
            let a = 4.0 * 7.5f64.powf(random.next());
            let b = a * random.within(0.45, 1.0);
            let room = a + 8.0;
            let [u, v] = [random.within(room, SIZE as f64 - room), random.within(room, SIZE as f64 - room)];
            let angle = random.within(0.0, std::f64::consts::PI);
            // clear paper around each, as charts have it
            if b >= 3.0 && spots.iter().all(|other| (other.u - u).hypot(other.v - v) > 1.25 * (other.a + a) + 4.0) {
                spots.push(Spot { u, v, a, b, angle, contrast });
            }
        }
        spots.iter().for_each(|spot| canvas.add(spot, self.blur));
        let mut noise = Noise::new(seed, 1);
        for level in &mut canvas.levels {
            // half of the variance at full scale is light's own
            let light = (*level * self.exposure).min(255.0);
            let scatter = self.noise * (0.5 + 0.5 * light / 255.0).sqrt();
            let linear = (*level * self.exposure + scatter * noise.normal()).clamp(0.0, 255.0);
            *level = 255.0 * (linear / 255.0).powf(1.0 / self.gamma);
        }
        let soft = softened(&canvas.levels, SIZE, self.radius);
        let sharpened = canvas.levels.iter().zip(&soft).map(|(level, soft)| level + self.sharpening * (level - soft));
        let samples: Vec<u8> = sharpened.map(|level| level.round().clamp(0.0, 255.0) as u8).collect();
        let mut file = Vec::new();
        image::codecs::jpeg::JpegEncoder::new_with_quality(&mut file, self.quality)
            .encode(&samples, SIZE as u32, SIZE as u32, image::ExtendedColorType::L8)
            .expect("a JPEG");
        let samples = image::load_from_memory(&file).expect("the JPEG").to_luma8().into_raw();
        (Grey { width: SIZE, height: SIZE, samples: Samples::U8(samples) }, spots)
    }
}

/// Numbers of a seed: its neighbours' are others (splitmix64).
fn scrambled(seed: u64) -> Uniform {
    let mut z = seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    Uniform(z ^ (z >> 31))
}

/// A Gaussian mean.
fn softened(levels: &[f64], width: usize, sigma: f64) -> Vec<f64> {
    let side = (4.0 * sigma).ceil() as i64;
    let kernel: Vec<f64> = (-side..=side).map(|t| (-0.5 * (t as f64 / sigma).powi(2)).exp()).collect();
    let sum: f64 = kernel.iter().sum();
    let height = levels.len() / width;
    let pass = |from: &[f64], across: bool| -> Vec<f64> {
        let at = |x: i64, y: i64| {
            from[y.clamp(0, height as i64 - 1) as usize * width + x.clamp(0, width as i64 - 1) as usize]
        };
        (0..from.len())
            .map(|i| {
                let (x, y) = ((i % width) as i64, (i / width) as i64);
                let taps = kernel.iter().zip(-side..);
                taps.map(|(k, t)| k * if across { at(x + t, y) } else { at(x, y + t) }).sum::<f64>() / sum
            })
            .collect()
    };
    pass(&pass(levels, true), false)
}

/// Results of one picture.
#[derive(Clone, Debug, Default)]
pub struct Score {
    pub targets: usize,
    pub hits: usize,
    pub others: usize,
    /// Sum of the squares of the errors over their sigmas, of twice as many coordinates as there are hits.
    pub square: f64,
    /// Sum of the squared errors.
    pub errors: f64,
}

impl fmt::Display for Score {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let Self { targets, hits, others, square, errors } = self;
        let count = 2.0 * (*hits).max(1) as f64;
        write!(
            to,
            "{hits:>3}/{targets} + {others:>2} err {:.3} chi {:.2}",
            (errors / count).sqrt(),
            (square / count).sqrt()
        )
    }
}

/// Compares targets with the truth.
pub fn score(detection: &Detection, spots: &[Spot]) -> Score {
    let mut score = Score { targets: spots.len(), ..Score::default() };
    for spot in spots {
        let near = |u: f64, v: f64| (u - spot.u).hypot(v - spot.v);
        let nearest = detection.targets.iter().min_by(|a, b| near(a.u, a.v).total_cmp(&near(b.u, b.v)));
        let Some(target) = nearest.filter(|target| near(target.u, target.v) < 1.0 + 0.1 * spot.b) else { continue };
        score.hits += 1;
        let [du, dv] = [target.u - spot.u, target.v - spot.v];
        score.errors += du * du + dv * dv;
        score.square += (du / target.sigma_u).powi(2) + (dv / target.sigma_v).powi(2);
    }
    score.others = detection.targets.len() - score.hits;
    score
}

/// Results of all pictures.
#[derive(Debug, Default)]
pub struct Tally {
    pub pictures: Vec<(Camera, Score)>,
}

impl Tally {
    pub fn add(&mut self, camera: &Camera, score: &Score) {
        self.pictures.push((*camera, score.clone()));
    }

    fn of<'a>(scores: impl Iterator<Item = &'a Score>) -> Score {
        scores.fold(Score::default(), |mut sum, score| {
            sum.targets += score.targets;
            sum.hits += score.hits;
            sum.others += score.others;
            sum.square += score.square;
            sum.errors += score.errors;
            sum
        })
    }

    /// All pictures together.
    pub fn all(&self) -> Score {
        Self::of(self.pictures.iter().map(|(_, score)| score))
    }

    /// Share found in the tenth of the pictures in which least is.
    pub fn worst_tenth(&self) -> f64 {
        let mut shares: Vec<f64> =
            self.pictures.iter().map(|(_, score)| score.hits as f64 / score.targets as f64).collect();
        shares.sort_by(f64::total_cmp);
        let worst = &shares[..shares.len().div_ceil(10)];
        worst.iter().sum::<f64>() / worst.len() as f64
    }

    /// Rms of error over sigma, per axis.
    pub fn chi(score: &Score) -> f64 {
        (score.square / (2.0 * score.hits.max(1) as f64)).sqrt()
    }

    /// The same in every tenth of the sharpening's range.
    pub fn tenths(&self) -> Vec<Score> {
        let tenth = |k: usize| {
            let within = move |camera: &Camera| (camera.sharpening * 5.0) as usize == k;
            Self::of(self.pictures.iter().filter(move |(camera, _)| within(camera)).map(|(_, score)| score))
        };
        (0..10).map(tenth).collect()
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let all = self.all();
        let share = all.hits as f64 / all.targets.max(1) as f64;
        let others = all.others as f64 / self.pictures.len().max(1) as f64;
        writeln!(to, "found {share:.4}, worst tenth {:.3}, false {others:.2} a picture", self.worst_tenth())?;
        write!(to, "error over sigma {:.3}; by sharpening", Self::chi(&all))?;
        self.tenths().iter().try_for_each(|score| write!(to, " {:.2}", Self::chi(score)))
    }
}
