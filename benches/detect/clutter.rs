//! Targets on cards in a photo with many other shapes: shaded and textured ground, lines, boxes and letters, under a lens that
//! darkens the corners.

use std::f64::consts::{PI, SQRT_2};

use sightline::noise::Noise;

use crate::light::Light;
use crate::painter::{Canvas, Spot, Uniform};

/// Maximum change of the light of lamps from pixel to pixel.
const STEEPEST: f64 = 2e-4;

/// Grains of the texture in pixels, and their standard deviation.
const GRAIN: usize = 24;
const TEXTURE: f64 = 4.0;
/// Targets keep this far from the border.
const BORDER: f64 = 90.0;

/// Strokes of letters on a grid of 4 x 6: with and without holes, straight and round.
const LETTERS: [&[&[[f64; 2]]]; 8] = [
    &[&[[0.0, 6.0], [2.0, 0.0], [4.0, 6.0]], &[[1.0, 4.0], [3.0, 4.0]]],
    &[&[[4.0, 0.0], [0.0, 0.0], [0.0, 6.0], [4.0, 6.0]], &[[0.0, 3.0], [3.0, 3.0]]],
    &[&[[0.0, 0.0], [0.0, 6.0]], &[[4.0, 0.0], [4.0, 6.0]], &[[0.0, 3.0], [4.0, 3.0]]],
    &[&[[0.0, 6.0], [0.0, 0.0], [2.0, 4.0], [4.0, 0.0], [4.0, 6.0]]],
    &[&[[0.0, 6.0], [0.0, 0.0], [3.0, 0.0], [4.0, 1.5], [3.0, 3.0], [0.0, 3.0]]],
    &[&[[4.0, 1.0], [2.0, 0.0], [0.0, 1.5], [4.0, 4.5], [2.0, 6.0], [0.0, 5.0]]],
    &[&[[0.0, 0.0], [4.0, 0.0], [0.0, 6.0], [4.0, 6.0]]],
    &[&[
        [2.0, 0.0],
        [3.2, 0.5],
        [4.0, 2.0],
        [4.0, 4.0],
        [3.2, 5.5],
        [2.0, 6.0],
        [0.8, 5.5],
        [0.0, 4.0],
        [0.0, 2.0],
        [0.8, 0.5],
        [2.0, 0.0],
    ]],
];

/// A picture of so many targets of 8 to 60 pixels, and their truth.
pub fn picture(width: usize, height: usize, targets: usize, blur: f64, seed: u64) -> (Canvas, Vec<Spot>) {
    let mut random = Uniform(seed);
    let mut canvas = ground(width, height, seed);
    let [w, h] = [width as f64, height as f64];
    for _ in 0..3 * targets / 4 {
        let (u, v) = (random.within(0.0, w), random.within(0.0, h));
        let to = [u + random.within(-600.0, 600.0), v + random.within(-600.0, 600.0)];
        let line = Stroke::between([u, v], to, random.within(1.0, 9.0).floor());
        let contrast = random.within(-50.0, 70.0);
        line.paint(&mut canvas, blur, |level, share| *level += contrast * share);
        let half = [random.within(5.0, 80.0), random.within(5.0, 80.0)];
        let middle = [random.within(0.0, w), random.within(0.0, h)];
        let contrast = random.within(-55.0, 80.0);
        let angle = random.within(0.0, PI);
        Stroke { middle, half, angle }.paint(&mut canvas, blur, |level, share| *level += contrast * share);
        word(&mut canvas, &mut random, blur);
    }
    let mut spots: Vec<Spot> = Vec::new();
    while spots.len() < targets {
        let a = 4.0 * 7.5f64.powf(random.next());
        let spot = Spot {
            u: random.within(BORDER, w - BORDER),
            v: random.within(BORDER, h - BORDER),
            a,
            b: (a * random.within(0.4, 1.0)).max(2.5),
            angle: random.within(0.0, PI),
            contrast: random.within(60.0, 150.0) * if random.next() < 0.7 { 1.0 } else { -1.0 },
        };
        let reach = |s: &Spot| 1.9 * s.a + 12.0;
        let apart = |s: &Spot| (s.u - spot.u).abs().max((s.v - spot.v).abs()) > reach(s) + reach(&spot);
        if spots.iter().all(apart) {
            let card = if spot.contrast > 0.0 { 60.0 } else { 205.0 } + random.within(-15.0, 15.0);
            cover(&mut canvas, &Spot { a: 1.7 * a + 4.0, b: 1.7 * spot.b + 4.0, contrast: 1.0, ..spot }, card, blur);
            canvas.add(&spot, blur);
            spots.push(spot);
        }
    }
    // the lens darkens all of it
    let light = Light::drawn(&mut random, 0.6, STEEPEST);
    light.fall(&mut canvas);
    let lit = |spot: Spot| Spot { contrast: spot.contrast * light.at(&canvas, spot.u, spot.v), ..spot };
    let spots = spots.into_iter().map(lit).collect();
    (canvas, spots)
}

/// Light that falls off slowly, and a cloudy texture between normal values at the corners of grains.
fn ground(width: usize, height: usize, seed: u64) -> Canvas {
    let mut canvas = Canvas::new(width, height, 0.0);
    let mut noise = Noise::new(seed, 1);
    let columns = width / GRAIN + 2;
    let corners: Vec<f64> = (0..columns * (height / GRAIN + 2)).map(|_| TEXTURE * noise.normal()).collect();
    let smooth = |i: usize| {
        let t = (i % GRAIN) as f64 / GRAIN as f64;
        t * t * (3.0 - 2.0 * t)
    };
    let wave: Vec<f64> = (0..width).map(|x| (x as f64 / 700.0).sin()).collect();
    for (y, row) in canvas.levels.chunks_exact_mut(width).enumerate() {
        let (share, fall) = (smooth(y), (y as f64 / 500.0).cos());
        let light = 90.0 - 30.0 * y as f64 / height as f64;
        for (x, level) in row.iter_mut().enumerate() {
            let at = y / GRAIN * columns + x / GRAIN;
            let between = |at: usize| corners[at] + smooth(x) * (corners[at + 1] - corners[at]);
            let texture = between(at) + share * (between(at + columns) - between(at));
            *level = light + 40.0 * x as f64 / width as f64 + 15.0 * wave[x] * fall + texture;
        }
    }
    canvas
}

/// Five letters in a row.
fn word(canvas: &mut Canvas, random: &mut Uniform, blur: f64) {
    let unit = random.within(0.6, 2.5) * 3.5;
    let (thickness, contrast) = (random.within(1.0, 5.0).floor(), random.within(-60.0, 90.0));
    let [width, height] = [30.0 * unit + 20.0, 6.0 * unit + 20.0].map(|size| size as usize);
    let room = |whole: usize, part: usize| whole.saturating_sub(part) as f64;
    let left = random.within(0.0, room(canvas.width, width)) as usize;
    let top = random.within(0.0, room(canvas.height, height)) as usize;
    let mut sheet = Canvas::new(width, height, 0.0);
    for k in 0..5 {
        let letter = LETTERS[(random.next() * LETTERS.len() as f64) as usize];
        let place = |[x, y]: [f64; 2]| [10.0 + unit * (6.0 * f64::from(k) + x), 10.0 + unit * y];
        for pair in letter.iter().flat_map(|line| line.windows(2)) {
            // Where strokes cross there is no more ink than elsewhere.
            let stroke = Stroke::between(place(pair[0]), place(pair[1]), thickness);
            stroke.paint(&mut sheet, blur, |level, share| *level = level.max(share));
        }
    }
    for (y, row) in sheet.levels.chunks_exact(width).enumerate() {
        let from = (top + y) * canvas.width + left;
        canvas.levels[from..from + width].iter_mut().zip(row).for_each(|(level, share)| *level += contrast * share);
    }
}

/// Paints over what is there.
fn cover(canvas: &mut Canvas, spot: &Spot, grey: f64, blur: f64) {
    let reach = spot.a + 6.0;
    let [left, top] = [spot.u - reach, spot.v - reach].map(|place| place.max(0.0) as usize);
    let size = (2.0 * reach) as usize + 1;
    let mut sheet = Canvas::new(size.min(canvas.width - left), size.min(canvas.height - top), 0.0);
    sheet.add(&Spot { u: spot.u - left as f64, v: spot.v - top as f64, ..*spot }, blur);
    for (y, row) in sheet.levels.chunks_exact(sheet.width).enumerate() {
        let from = (top + y) * canvas.width + left;
        canvas.levels[from..from + row.len()]
            .iter_mut()
            .zip(row)
            .for_each(|(level, share)| *level += share * (grey - *level));
    }
}

/// A blurred rectangle: middle, half its length and width, angle of its length.
struct Stroke {
    middle: [f64; 2],
    half: [f64; 2],
    angle: f64,
}

impl Stroke {
    fn between([u, v]: [f64; 2], [to_u, to_v]: [f64; 2], thickness: f64) -> Self {
        let (du, dv) = (to_u - u, to_v - v);
        Self {
            middle: [(u + to_u) / 2.0, (v + to_v) / 2.0],
            half: [du.hypot(dv) / 2.0, thickness / 2.0],
            angle: dv.atan2(du),
        }
    }

    /// Hands every pixel and its covered share to `change`. The pixel's own extent is taken for more blur.
    fn paint(&self, canvas: &mut Canvas, blur: f64, mut change: impl FnMut(&mut f64, f64)) {
        let s = (blur * blur + 1.0 / 12.0).sqrt();
        let (sine, cosine) = self.angle.sin_cos();
        let [length, width] = self.half.map(|half| half + 4.0 * s);
        let within =
            |t: f64, half: f64| (libm::erf((half - t) / (s * SQRT_2)) + libm::erf((half + t) / (s * SQRT_2))) / 2.0;
        let tall = length * sine.abs() + width * cosine.abs();
        let row = |v: f64| (v.max(0.0) as usize).min(canvas.height);
        for y in row(self.middle[1] - tall)..row(self.middle[1] + tall + 1.0) {
            let dy = y as f64 + 0.5 - self.middle[1];
            // |x cos + y sin| <= length and |y cos - x sin| <= width
            let (a, b) = (span(cosine, dy * sine, length), span(-sine, dy * cosine, width));
            let column = |x: f64| ((self.middle[0] + x).max(0.0) as usize).min(canvas.width);
            for x in column(a.0.max(b.0))..column(a.1.min(b.1) + 1.0) {
                let dx = x as f64 + 0.5 - self.middle[0];
                let share =
                    within(dx * cosine + dy * sine, self.half[0]) * within(dy * cosine - dx * sine, self.half[1]);
                change(&mut canvas.levels[y * canvas.width + x], share);
            }
        }
    }
}

/// Where |slope · x + offset| is at most `limit`.
fn span(slope: f64, offset: f64, limit: f64) -> (f64, f64) {
    if slope.abs() < 1e-9 {
        return if offset.abs() <= limit { (-1e6, 1e6) } else { (0.0, -1.0) };
    }
    let (p, q) = ((-limit - offset) / slope, (limit - offset) / slope);
    (p.min(q), p.max(q))
}
