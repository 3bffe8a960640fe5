//! Light that changes across targets, as lenses and lamps make it: centres stay where they are, and their sigmas say so.

use crate::support::light::{Light, tone};
use crate::support::painter::{Canvas, Spot, Uniform};
use sightline::detect::detect;
use sightline::detection::{Codes, DetectOptions, Method};
use sightline::image::Grey;

const METHODS: [Method; 4] = [Method::LeastSquares, Method::Ellipse, Method::Intensity, Method::Gradient];
/// Rows and columns of targets in a picture.
const GRID: usize = 8;

/// A picture of targets of one size under light drawn at random, and the direction of the light at each of them.
fn picture(random: &mut Uniform, diameter: f64) -> (Canvas, Vec<Spot>, Vec<[f64; 2]>) {
    let pitch = (2.2 * diameter + 18.0).round();
    let size = GRID * pitch as usize;
    let bright = random.next() < 0.5;
    let (ground, contrast) = if bright {
        (random.within(20.0, 80.0), random.within(60.0, 130.0))
    } else {
        let paper = random.within(120.0, 200.0);
        (paper, random.within(15.0, 45.0) - paper)
    };
    let mut canvas = Canvas::new(size, size, ground);
    let blur = random.within(0.6, 1.2);
    let spots: Vec<Spot> = (0..GRID * GRID)
        .map(|k| {
            let mut place = |i: usize| (i as f64 + 0.5) * pitch + random.within(-0.5, 0.5);
            let (u, v) = (place(k % GRID), place(k / GRID));
            let (a, angle) = (diameter / 2.0, random.within(0.0, 3.1));
            Spot { u, v, a, b: a * random.within(0.7, 1.0), angle, contrast }
        })
        .collect();
    spots.iter().for_each(|spot| canvas.add(spot, blur));
    // up to a tenth of the light across a target
    let light = Light::drawn(random, 0.6, 0.1 / diameter);
    light.fall(&mut canvas);
    tone(&mut canvas, random.within(1.0, 2.4));
    let directions = spots.iter().map(|spot| light.direction(&canvas, spot.u, spot.v)).collect();
    (canvas, spots, directions)
}

/// Sums over targets: of squares of errors over sigmas, of errors along the light over sigmas, and how many targets they are.
#[derive(Clone, Copy, Default)]
struct Sums {
    square: f64,
    along: f64,
    count: usize,
    all: usize,
}

impl Sums {
    fn add(&mut self, picture: &Grey, method: Method, spots: &[Spot], directions: &[[f64; 2]]) {
        let options = DetectOptions { method, codes: Codes::None, ..DetectOptions::default() };
        let found = detect(&picture.view().expect("a picture"), &options).expect("valid options").targets;
        self.all += spots.len();
        for (spot, direction) in spots.iter().zip(directions) {
            let Some(t) = found.iter().find(|t| (t.u - spot.u).hypot(t.v - spot.v) < 2.0) else { continue };
            let error = [(t.u - spot.u) / t.sigma_u, (t.v - spot.v) / t.sigma_v];
            self.square += error[0].powi(2) + error[1].powi(2);
            self.along += error[0] * direction[0] + error[1] * direction[1];
            self.count += 1;
        }
    }

    /// Rms of the errors over their sigmas, and the mean of those along the light.
    fn told(&self) -> [f64; 2] {
        [(self.square / (2 * self.count) as f64).sqrt(), self.along / self.count as f64]
    }
}

#[test]
fn light_that_changes_across_a_target_moves_no_centre() {
    let mut sums = [Sums::default(); 4];
    for (seed, diameter) in [7.0, 10.0, 14.0, 20.0, 28.0, 36.0, 9.0, 12.0, 17.0, 24.0].into_iter().enumerate() {
        let mut random = Uniform(71 * seed as u64 + 5);
        random.next();
        let (canvas, spots, directions) = picture(&mut random, diameter);
        let shot = canvas.expose(random.within(1.0, 2.5), seed as u64);
        for (method, sums) in METHODS.into_iter().zip(&mut sums) {
            sums.add(&shot, method, &spots, &directions);
        }
    }
    for (method, sums) in METHODS.into_iter().zip(sums) {
        let [honest, bias] = sums.told();
        println!(
            "{method:?}: {} of {}, error/sigma {honest:.3}, along the light {bias:.3} sigma",
            sums.count, sums.all
        );
        assert!(100 * sums.count >= 97 * sums.all, "{method:?}: {} of {}", sums.count, sums.all);
        assert!((0.85..1.2).contains(&honest), "{method:?}: error/sigma {honest}");
        assert!(bias.abs() < 0.3, "{method:?}: {bias} sigma along the light");
    }
}
