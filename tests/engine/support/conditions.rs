//! Pictures under the conditions that a crew meets one at a time: something before the targets, a moved camera, coarse
//! compression, drawings, light that the sensor cannot hold.

use sightline::detection::{DetectOptions, Detection, Reason, Target};
use sightline::image::{Grey, Samples};

use super::painter::{Canvas, Spot, Uniform};

/// One condition.
pub struct Condition {
    pub name: &'static str,
    pub options: DetectOptions,
    pub picture: fn(u64) -> (Grey, Vec<Spot>),
}

/// Spots that are no targets, of which a detection says that something hides them.
pub fn said_to_be_hidden(detection: &Detection, spots: &[Spot]) -> usize {
    let missed = spots.iter().filter(|spot| {
        let off = |u: f64, v: f64| (u - spot.u).hypot(v - spot.v);
        detection.targets.iter().all(|target| off(target.u, target.v) > 1.0 + 0.1 * spot.b)
            && detection.rejected_blobs.iter().any(|no| no.reason == Reason::Occluded && off(no.u, no.v) < 0.5 * spot.b)
    });
    missed.count()
}

/// Spots that are reported as occluded targets: their number, and the sum of the squares of their errors over their standard errors.
pub fn occluded(detection: &Detection, spots: &[Spot]) -> (usize, f64) {
    let off = |target: &Target, spot: &Spot| (target.u - spot.u).hypot(target.v - spot.v);
    let of = |spot: &Spot| {
        let target = detection.targets.iter().min_by(|a, b| off(a, spot).total_cmp(&off(b, spot)))?;
        let [u, v] = [(target.u - spot.u) / target.sigma_u, (target.v - spot.v) / target.sigma_v];
        (target.occluded && off(target, spot) < 1.0 + 0.1 * spot.b).then_some(u * u + v * v)
    };
    let all = spots.iter().filter_map(of).collect::<Vec<_>>();
    (all.len(), all.iter().sum())
}

const SIZE: usize = 800;
const PAPER: f64 = 190.0;
const INK: f64 = 40.0;
/// Of what lies before targets.
const GREYS: [f64; 2] = [60.0, 170.0];

/// All of them.
pub fn all() -> Vec<Condition> {
    // ellipses of 8 px are as flat as 0.5, and light that is over-exposed eats their rims
    let options = || DetectOptions { min_diameter: 3.0, ..DetectOptions::default() };
    vec![
        Condition { name: "hidden by up to a fifth", options: options(), picture: hidden },
        Condition { name: "crossed by a cable", options: options(), picture: crossed },
        Condition { name: "crossed by a dark cable", options: options(), picture: crossed_darkly },
        Condition { name: "moved by up to 6 px", options: options(), picture: moved },
        Condition { name: "JPEG of quality 30", options: options(), picture: compressed },
        Condition { name: "noise 20, contrast 150", options: options(), picture: noisy },
        Condition {
            name: "tilt up to 75 degrees",
            options: DetectOptions { min_axis_ratio: 0.25, ..options() },
            picture: tilted,
        },
        // of major axes from 3 px the minor ones have 2.4 px and more
        Condition { name: "from 3 px", options: DetectOptions { min_diameter: 2.4, ..options() }, picture: small },
        Condition { name: "binary drawing", options: options(), picture: binary },
        Condition { name: "screenshot", options: options(), picture: screenshot },
        Condition { name: "paper 2 x over-exposed", options: options(), picture: white_paper },
        Condition { name: "retro 5 x over-exposed", options: options(), picture: bright_retro },
        Condition { name: "pitch of 2.5 radii", options: options(), picture: dense },
    ]
}

/// Ellipses of a range of diameters and axis ratios, apart from each other by `gap` of their size.
fn scattered(random: &mut Uniform, diameters: [f64; 2], ratios: [f64; 2], gap: f64, contrast: f64) -> Vec<Spot> {
    let mut spots: Vec<Spot> = Vec::new();
    for _ in 0..8_000 {
        if spots.len() == 60 {
            break;
        }
        let a = 0.5 * diameters[0] * (diameters[1] / diameters[0]).powf(random.next());
        let b = a * random.within(ratios[0], ratios[1]);
        let room = 1.5 * a + 10.0;
        let [u, v] = [random.within(room, SIZE as f64 - room), random.within(room, SIZE as f64 - room)];
        let angle = random.within(0.0, std::f64::consts::PI);
        if spots.iter().all(|other| (other.u - u).hypot(other.v - v) > gap * (other.a + a) + 6.0) {
            spots.push(Spot { u, v, a, b, angle, contrast });
        }
    }
    spots
}

fn painted(spots: &[Spot], ground: f64, blur: f64) -> Canvas {
    let mut canvas = Canvas::new(SIZE, SIZE, ground);
    spots.iter().for_each(|spot| canvas.add(spot, blur));
    canvas
}

/// A bar lies before every target and covers up to a fifth of its diameter.
fn hidden(seed: u64) -> (Grey, Vec<Spot>) {
    behind(seed, GREYS, |random, spot, half| {
        let near = half * (1.0 - 2.0 * random.within(0.05, 0.2));
        [near, near + 0.4 * spot.a + 3.0]
    })
}

/// A cable runs across every target, as wide as up to a fifth of its diameter.
fn crossed(seed: u64) -> (Grey, Vec<Spot>) {
    behind(seed, GREYS, cable)
}

/// The cable is about as dark as the targets.
fn crossed_darkly(seed: u64) -> (Grey, Vec<Spot>) {
    behind(seed, [INK - 15.0, INK + 25.0], cable)
}

fn cable(random: &mut Uniform, _: &Spot, half: f64) -> [f64; 2] {
    let width = half * random.within(0.1, 0.4);
    let middle = half * random.within(-0.6, 0.6);
    [middle - width / 2.0, middle + width / 2.0]
}

/// Targets behind bars of these greys, each in a direction of its own from and to these distances from the target's centre; half is the target's
/// own half width there.
fn behind(seed: u64, greys: [f64; 2], bar: impl Fn(&mut Uniform, &Spot, f64) -> [f64; 2]) -> (Grey, Vec<Spot>) {
    let mut random = Uniform(seed);
    let spots = scattered(&mut random, [12.0, 50.0], [0.6, 1.0], 2.2, INK - PAPER);
    let blur = random.within(0.6, 1.2);
    let mut canvas = painted(&spots, PAPER, blur);
    for spot in &spots {
        let (sine, cosine) = random.within(0.0, std::f64::consts::TAU).sin_cos();
        // the ellipse's half width in the bar's direction
        let (s, c) =
            (sine * spot.angle.cos() - cosine * spot.angle.sin(), cosine * spot.angle.cos() + sine * spot.angle.sin());
        let [near, far] = bar(&mut random, spot, (spot.a * c).hypot(spot.b * s));
        let grey = random.within(greys[0], greys[1]);
        let reach = 2.0 * spot.a + 6.0;
        let step = |t: f64| 0.5 * libm::erfc(-t / blur * std::f64::consts::FRAC_1_SQRT_2);
        let bounds = |middle: f64| (middle - reach).max(0.0) as usize..((middle + reach).max(0.0) as usize).min(SIZE);
        for y in bounds(spot.v) {
            for x in bounds(spot.u) {
                let [dx, dy] = [x as f64 + 0.5 - spot.u, y as f64 + 0.5 - spot.v];
                let (along, across) = (dx * cosine + dy * sine, dy * cosine - dx * sine);
                let width = spot.a + 2.0;
                let inside = (step(along - near) - step(along - far)) * step(across + width) * step(width - across);
                let level = &mut canvas.levels[y * SIZE + x];
                *level += inside * (grey - *level);
            }
        }
    }
    (canvas.expose(2.0, seed), spots)
}

/// The camera moved evenly while the shutter was open.
fn moved(seed: u64) -> (Grey, Vec<Spot>) {
    const STEPS: usize = 25;
    let mut random = Uniform(seed);
    let spots = scattered(&mut random, [12.0, 50.0], [0.6, 1.0], 1.4, INK - PAPER);
    let (blur, length) = (random.within(0.6, 1.2), random.within(2.0, 6.0));
    let (sine, cosine) = random.within(0.0, std::f64::consts::PI).sin_cos();
    let mut canvas = Canvas::new(SIZE, SIZE, PAPER);
    for k in 0..STEPS {
        let t = length * ((k as f64 + 0.5) / STEPS as f64 - 0.5);
        for spot in &spots {
            let contrast = spot.contrast / STEPS as f64;
            canvas.add(&Spot { u: spot.u + t * cosine, v: spot.v + t * sine, contrast, ..*spot }, blur);
        }
    }
    (canvas.expose(2.0, seed), spots)
}

fn compressed(seed: u64) -> (Grey, Vec<Spot>) {
    let mut random = Uniform(seed);
    let spots = scattered(&mut random, [8.0, 60.0], [0.5, 1.0], 1.3, INK - PAPER);
    let Samples::U8(samples) = painted(&spots, PAPER, random.within(0.6, 1.2)).expose(2.0, seed).samples else {
        unreachable!("eight bits")
    };
    let mut file = Vec::new();
    image::codecs::jpeg::JpegEncoder::new_with_quality(&mut file, 30)
        .encode(&samples, SIZE as u32, SIZE as u32, image::ExtendedColorType::L8)
        .expect("a JPEG");
    let samples = image::load_from_memory(&file).expect("the JPEG").to_luma8().into_raw();
    (Grey { width: SIZE, height: SIZE, samples: Samples::U8(samples) }, spots)
}

fn noisy(seed: u64) -> (Grey, Vec<Spot>) {
    let mut random = Uniform(seed);
    let spots = scattered(&mut random, [8.0, 60.0], [0.5, 1.0], 1.3, INK - PAPER);
    (painted(&spots, PAPER, random.within(0.6, 1.2)).expose(20.0, seed), spots)
}

fn tilted(seed: u64) -> (Grey, Vec<Spot>) {
    let mut random = Uniform(seed);
    let spots = scattered(&mut random, [24.0, 80.0], [0.2588, 0.35], 1.2, INK - PAPER);
    (painted(&spots, PAPER, random.within(0.6, 1.2)).expose(2.0, seed), spots)
}

fn small(seed: u64) -> (Grey, Vec<Spot>) {
    let mut random = Uniform(seed);
    let spots = scattered(&mut random, [3.0, 5.0], [0.8, 1.0], 2.0, INK - PAPER);
    (painted(&spots, PAPER, random.within(0.5, 0.8)).expose(random.within(0.5, 2.0), seed), spots)
}

fn binary(seed: u64) -> (Grey, Vec<Spot>) {
    let mut random = Uniform(seed);
    let spots = scattered(&mut random, [8.0, 60.0], [0.5, 1.0], 1.3, -255.0);
    let mut canvas = painted(&spots, 255.0, 0.05);
    canvas.levels.iter_mut().for_each(|level| *level = if *level < 127.5 { 0.0 } else { 255.0 });
    (canvas.expose(0.0, seed), spots)
}

fn screenshot(seed: u64) -> (Grey, Vec<Spot>) {
    let mut random = Uniform(seed);
    let spots = scattered(&mut random, [8.0, 60.0], [0.5, 1.0], 1.3, -200.0);
    (painted(&spots, 240.0, 0.05).expose(0.0, seed), spots)
}

/// Light twice and five times as much as the sensor's scale holds.
fn white_paper(seed: u64) -> (Grey, Vec<Spot>) {
    let mut random = Uniform(seed);
    let spots = scattered(&mut random, [8.0, 60.0], [0.5, 1.0], 1.3, 60.0 - 510.0);
    (painted(&spots, 510.0, random.within(0.6, 1.2)).expose(2.0, seed), spots)
}

fn bright_retro(seed: u64) -> (Grey, Vec<Spot>) {
    let mut random = Uniform(seed);
    let spots = scattered(&mut random, [8.0, 40.0], [0.5, 1.0], 1.5, 5.0 * 255.0 - 20.0);
    (painted(&spots, 20.0, random.within(0.6, 1.2)).expose(2.0, seed), spots)
}

fn dense(seed: u64) -> (Grey, Vec<Spot>) {
    let mut random = Uniform(seed);
    let radius = random.within(6.0, 20.0);
    let angle = random.within(0.0, 1.0);
    let (sine, cosine) = f64::sin_cos(angle);
    let mut spots = Vec::new();
    for i in -8..=8 {
        for j in -8..=8 {
            let [x, y] = [2.5 * radius * f64::from(i), 2.5 * radius * f64::from(j)];
            let [u, v] = [400.0 + cosine * x - sine * y, 400.0 + sine * x + cosine * y];
            let room = radius + 8.0;
            if u.min(v) > room && u.max(v) < SIZE as f64 - room {
                spots.push(Spot { u, v, a: radius, b: radius, angle: 0.0, contrast: INK - PAPER });
            }
        }
    }
    (painted(&spots, PAPER, random.within(0.6, 1.2)).expose(2.0, seed), spots)
}
