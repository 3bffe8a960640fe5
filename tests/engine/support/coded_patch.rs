//! Pictures of one coded target, or of something that could be taken for one, as cameras see them: drawn at random from wide
//! families of tilt, perspective, blur, sharpening, light, noise and things beside the ring. It shares no code with the
//! engine's own rendering.

use std::f64::consts::{PI, TAU};

use sightline::detection::{Polarity, Quality, Target};
use sightline::image::{GreyView, SamplesView};
use sightline::noise::Noise;
use sightline::ring_code::{Design, Family, smallest_rotation};
use sightline::statistics::distribution::normal_quantile;

use super::painter::Uniform;

/// Contents of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A coded target.
    Code,
    /// One with a part of its ring hidden.
    Hidden,
    /// A code of another family than the one that is read.
    Other,
    /// A ring set all around.
    Full,
    /// Concentric rings, whole or in part (CCTag).
    Concentric,
    /// Two rings with a band of 16 sectors between them (ringgrid).
    Ringgrid,
    /// A field of equal dots.
    Dots,
    /// Smaller dots around a dot.
    Satellites,
    /// A ring with sectors of no family's number or size, or at random angles.
    Strange,
}

impl Kind {
    pub const ALL: [Self; 9] = [
        Self::Code,
        Self::Hidden,
        Self::Other,
        Self::Full,
        Self::Concentric,
        Self::Ringgrid,
        Self::Dots,
        Self::Satellites,
        Self::Strange,
    ];
}

/// A flat drawing in units of the dot's radius: 1 where it has the dot's colour.
#[derive(Default)]
struct Drawing {
    /// Rings and discs: inner and outer radius, set or not; later ones lie on top.
    bands: Vec<([f64; 2], Vec<[f64; 2]>, f64)>,
    /// Discs: centre, radius, level.
    discs: Vec<([f64; 2], f64, f64)>,
    /// Bars: a place on the edge, direction away from the target; half width along the edge, level.
    bars: Vec<Bar>,
    /// Bars that lie on top of everything.
    covers: Vec<Bar>,
}

type Bar = ([f64; 2], [f64; 2], f64, f64);

impl Drawing {
    fn level(&self, x: f64, y: f64) -> f64 {
        let radius = x.hypot(y);
        let mut level = 0.0;
        for ([u, v], r, to) in &self.discs {
            if (x - u).powi(2) + (y - v).powi(2) < r * r {
                level = *to;
            }
        }
        let lay = |bars: &[Bar], level: &mut f64| {
            for ([u, v], [du, dv], half, to) in bars {
                let (along, across) = ((x - u) * du + (y - v) * dv, (x - u) * dv - (y - v) * du);
                if along > 0.0 && across.abs() < *half {
                    *level = *to;
                }
            }
        };
        lay(&self.bars, &mut level);
        for ([inner, outer], arcs, to) in &self.bands {
            if radius >= *inner && radius < *outer {
                let whole = arcs.is_empty();
                let turn = y.atan2(x).rem_euclid(TAU);
                if whole || arcs.iter().any(|[from, to]| (turn - from).rem_euclid(TAU) < to - from) {
                    level = *to;
                }
            }
        }
        lay(&self.covers, &mut level);
        level
    }
}

/// A picture with what is true of it.
pub struct CodedPatch {
    pub kind: Kind,
    /// The family that is to be read.
    pub family: Family,
    /// The number, where one is there: that of the code, or of one that another ring looks exactly like.
    pub number: Option<u32>,
    /// Radii and arcs of the rings in the dot's colour that are not whole.
    rings: Vec<([f64; 2], Vec<[f64; 2]>)>,
    pub size: usize,
    pub samples: Vec<u8>,
    /// Centre of the dot's ellipse, and its diameter as seen straight on.
    pub u: f64,
    pub v: f64,
    pub diameter: f64,
    /// Width of the narrowest sector in pixels.
    pub sector: f64,
    pub tilt: f64,
    pub sharpening: f64,
    /// The dot's ellipse as semi-axes and angle, contrast, blur and colour, as a perfect measurement of this picture has them.
    pub axes: [f64; 3],
    pub contrast: f64,
    pub blur: f64,
    pub bright: bool,
}

impl CodedPatch {
    pub fn view(&self) -> GreyView<'_> {
        GreyView::new(self.size, self.size, SamplesView::U8(&self.samples)).expect("a picture")
    }

    /// The number that one of its rings has as a code of a family, whoever drew it.
    pub fn number_in(&self, family: Family) -> Option<u32> {
        self.rings.iter().find_map(|(radii, arcs)| same_drawing(*radii, arcs, family))
    }

    /// The dot as a perfect measurement would report it.
    pub fn dot(&self) -> Target {
        let [a, b, angle] = self.axes;
        Target {
            id: 0,
            u: self.u,
            v: self.v,
            sigma_u: 0.01,
            sigma_v: 0.01,
            covariance_uv: 0.0,
            major: 2.0 * a,
            minor: 2.0 * b,
            angle,
            contrast: self.contrast,
            polarity: if self.bright { Polarity::Bright } else { Polarity::Dark },
            code: None,
            code_family: None,
            code_candidates: Vec::new(),
            inner: None,
            occluded: false,
            quality: Quality { edge_width: self.blur, ..Quality::default() },
        }
    }
}

fn choose<T: Copy>(random: &mut Uniform, from: &[T]) -> T {
    from[((random.next() * from.len() as f64) as usize).min(from.len() - 1)]
}

/// Arcs of the set bits of a code, first bit from angle 0, growing angles (clockwise as seen).
fn arcs(code: u32, bits: u32, start: f64) -> Vec<[f64; 2]> {
    let sector = TAU / f64::from(bits);
    let set = (0..bits).filter(|k| code >> (bits - 1 - k) & 1 == 1);
    set.map(|k| start + sector * f64::from(k)).map(|from| [from, from + sector]).collect()
}

/// How far a print may be from a code's geometry and still be that code: ends of its arcs in sectors, radii of its ring in radii of the dot.
const NEARLY: [f64; 2] = [1.0 / 16.0, 0.15];

/// The number in `family` of the code that a ring of arcs is, whoever drew it: where its radii are the family's, and all its arcs end on
/// the family's grid. Nobody who looks at the drawing could tell.
fn same_drawing(radii: [f64; 2], arcs: &[[f64; 2]], family: Family) -> Option<u32> {
    let design = family.design().ring();
    if arcs.is_empty() || (0..2).any(|k| (radii[k] - design[k]).abs() > NEARLY[1]) {
        return None;
    }
    let n = family.bits();
    let sector = TAU / f64::from(n);
    let apart = |a: f64, b: f64| ((a - b) / sector + 0.5).rem_euclid(f64::from(n)) - 0.5;
    let begins_at = |end: f64| arcs.iter().any(|[from, _]| apart(*from, end).abs() < 1e-9);
    let ends_at = |end: f64| arcs.iter().any(|[_, to]| apart(*to, end).abs() < 1e-9);
    // ends between two arcs that touch are none
    let ends: Vec<f64> = (arcs.iter().map(|[from, _]| *from).filter(|end| !ends_at(*end)))
        .chain(arcs.iter().map(|[_, to]| *to).filter(|end| !begins_at(*end)))
        .collect();
    let (sine, cosine) =
        ends.iter().map(|end| (f64::from(n) * end).sin_cos()).fold((0.0, 0.0), |sum, x| (sum.0 + x.0, sum.1 + x.1));
    let phase = sine.atan2(cosine) / f64::from(n);
    let off = |end: &f64| ((end - phase) / sector + 0.5).rem_euclid(1.0) - 0.5;
    if ends.is_empty() || ends.iter().any(|end| off(end).abs() > NEARLY[0]) {
        return None;
    }
    let set = |k: u32| {
        let at = phase + sector * (f64::from(k) + 0.5);
        arcs.iter().any(|[from, to]| (at - from).rem_euclid(TAU) < to - from)
    };
    let code = (0..n).fold(0, |code, k| code << 1 | u32::from(set(k)));
    family.number(smallest_rotation(code, n))
}

fn draw(kind: Kind, family: Family, random: &mut Uniform) -> (Drawing, Option<u32>) {
    let mut drawing = Drawing { bands: vec![([0.0, 1.0], Vec::new(), 1.0)], ..Drawing::default() };
    let start = random.within(0.0, TAU);
    let mut number = None;
    let design = family.design();
    let ring = design.ring();
    let code_of = |family: Family, random: &mut Uniform, drawing: &mut Drawing| {
        let at = ((random.next() * family.codes().len() as f64) as usize).min(family.codes().len() - 1);
        let design = family.design();
        drawing.bands.push((design.ring(), arcs(family.codes()[at], family.bits(), start), 1.0));
        if design == Design::Metashape {
            drawing.bands.push(([0.0, design.spot()], Vec::new(), 0.0));
        }
        at as u32 + 1
    };
    match kind {
        Kind::Code => number = Some(code_of(family, random, &mut drawing)),
        Kind::Hidden => {
            number = Some(code_of(family, random, &mut drawing));
            // a finger, a cable or a glare that covers a part of the ring
            let angle = random.within(0.0, TAU);
            let direction = [angle.cos(), angle.sin()];
            let from = random.within(1.3, ring[1] - 0.2);
            // nothing tells a cover of the ground's own colour from ground, nor a glare that is clipped to it
            let level = choose(random, &[1.0, 1.0, 0.6, 0.4 + random_level(start)]);
            let half = random.within(0.2, 1.5);
            drawing.covers.push(([from * direction[0], from * direction[1]], direction, half, level));
        }
        Kind::Other => {
            let others: Vec<Family> = Family::ALL.into_iter().filter(|other| *other != family).collect();
            let other = choose(random, &others);
            let drawn = code_of(other, random, &mut drawing);
            let code = other.codes()[drawn as usize - 1];
            number = same_drawing(other.design().ring(), &arcs(code, other.bits(), start), family);
        }
        Kind::Full => drawing.bands.push((choose(random, &[ring, [2.0, 3.0]]), Vec::new(), 1.0)),
        Kind::Concentric => {
            let mut radius = random.within(1.3, 2.4);
            for _ in 0..3 {
                let outer = radius + random.within(0.3, 1.2);
                let some =
                    if random.next() < 0.4 { vec![[start, start + random.within(1.0, 6.0)]] } else { Vec::new() };
                number = number.or(same_drawing([radius, outer], &some, family));
                drawing.bands.push(([radius, outer], some, 1.0));
                radius = outer + random.within(0.3, 1.0);
            }
        }
        Kind::Ringgrid => {
            let widths: Vec<f64> = (0..4).map(|_| random.within(0.3, 1.1)).collect();
            let radii = widths.iter().scan(random.within(1.0, 2.0), |at, width| {
                *at += width;
                Some(*at)
            });
            let r: Vec<f64> = radii.collect();
            let bits = (random.next() * 65536.0) as u32;
            drawing.bands.push(([r[0], r[1]], Vec::new(), random.next().round()));
            drawing.bands.push(([r[1], r[2]], arcs(bits, 16, start), 1.0));
            drawing.bands.push(([r[2], r[3]], Vec::new(), 1.0));
        }
        Kind::Dots => {
            let pitch = random.within(2.3, 4.5);
            let (c, s) = (start.cos(), start.sin());
            let skew = choose(random, &[0.0, 0.0, 0.5]);
            for i in -3..=3 {
                for j in -3..=3 {
                    let (x, y) = (pitch * (f64::from(i) + skew * f64::from(j)), pitch * f64::from(j));
                    drawing.discs.push(([c * x - s * y, s * x + c * y], 1.0, 1.0));
                }
            }
        }
        Kind::Satellites => {
            let count = 2 + (random.next() * 12.0) as usize;
            let bits = f64::from(family.bits());
            for _ in 0..count {
                // on the grid of the family, where they would look most like its sectors
                let angle = start + TAU / bits * (random.next() * bits).floor();
                let radius = random.within(2.2, 3.2);
                let size = random.within(0.3, 0.7);
                drawing.discs.push(([radius * angle.cos(), radius * angle.sin()], size, 1.0));
            }
        }
        Kind::Strange => {
            let (bits, radii) = match (random.next() * 3.0) as u32 {
                0 => (choose(random, &[9, 11, 13, 15, 18, 22]), ring),
                1 => {
                    let inner = random.within(1.4, 2.6);
                    let mut outer = inner + random.within(0.4, 1.8);
                    // not nearly a family's, of which a wider ring may be the other one's
                    let like = |outer: f64| {
                        [Design::Schneider, Design::Metashape]
                            .into_iter()
                            .any(|d| (d.ring()[0] - inner).abs() < 0.35 && (d.ring()[1] - outer).abs() < 0.35)
                    };
                    while like(outer) {
                        outer += 1.0;
                    }
                    (family.bits(), [inner, outer])
                }
                _ => (0, ring),
            };
            let arcs = if bits == 0 {
                let mut at = start;
                let mut arcs = Vec::new();
                while at < start + 5.5 {
                    let to = at + random.within(0.3, 1.2);
                    arcs.push([at, to]);
                    at = to + random.within(0.3, 1.2);
                }
                arcs
            } else {
                arcs((random.next() * f64::from(1u32 << bits)) as u32, bits, start)
            };
            number = same_drawing(radii, &arcs, family);
            drawing.bands.push((radii, arcs, 1.0));
        }
    }
    if matches!(kind, Kind::Code | Kind::Other | Kind::Full | Kind::Strange) {
        // things beside the clear ground
        let outer = if kind == Kind::Other { 3.54 } else { ring[1] };
        for _ in 0..(random.next() * 4.0) as usize {
            let angle = random.within(0.0, TAU);
            let direction = [angle.cos(), angle.sin()];
            let from = outer + random.within(0.6, 1.6);
            let level = random.within(-0.4, 1.2);
            if random.next() < 0.5 {
                let half = random.within(0.1, 3.0);
                drawing.bars.push(([from * direction[0], from * direction[1]], direction, half, level));
            } else {
                let size = random.within(0.3, 2.0);
                let at = from + size;
                drawing.discs.push(([at * direction[0], at * direction[1]], size, level));
            }
        }
    }
    (drawing, number)
}

/// A level between the colours, from an angle that is random anyway.
fn random_level(angle: f64) -> f64 {
    angle / TAU
}

const FINE: usize = 3;

/// How levels follow light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curve {
    /// They are light, or bent a little.
    Flat,
    /// As in the pictures that cameras make for screens.
    Camera,
}

/// Draws a picture of this kind.
pub fn coded_patch(kind: Kind, family: Family, curve: Curve, random: &mut Uniform) -> CodedPatch {
    let (drawing, number) = draw(kind, family, random);
    // 7 to 40 px, small ones more often
    let radius = 3.5 * (random.next() * (40f64 / 7.0).ln()).exp();
    let tilt = random.within(0.0, 60f64.to_radians());
    let axis = random.within(0.0, PI);
    // size of the target over its distance, times its tilt: a lens from wide to long
    let perspective = radius * tilt.sin() / random.within(400.0, 4000.0) * choose(random, &[-1.0, 1.0]);
    let blur = random.within(0.4, 1.3);
    let bright = random.next() < 0.5;
    let sharpening = if random.next() < 0.4 { random.within(0.0, 1.5) } else { 0.0 };
    let sharp_radius = random.within(0.6, 1.5);
    let contrast = random.within(50.0, 190.0);
    let noise_sigma = random.within(0.3, 0.045 * contrast);
    let dark = random.within(8.0, 50.0);
    let light = [random.within(-0.06, 0.06), random.within(-0.06, 0.06)];
    let tone = match curve {
        Curve::Flat if random.next() < 0.3 => random.within(0.7, 1.5),
        Curve::Flat => 1.0,
        Curve::Camera => random.within(0.42, 0.5),
    };

    let (squeeze, ring) = (tilt.cos(), family.design().ring());
    let half = 5.2 * radius + 10.0;
    let size = (2.0 * half).ceil() as usize;
    let centre = size as f64 / 2.0;
    let (u, v) = (centre + random.within(-0.5, 0.5), centre + random.within(-0.5, 0.5));
    let (sine, cosine) = axis.sin_cos();
    let fine = FINE * size;
    let mut picture = vec![0f32; fine * fine];
    for y in 0..fine {
        for x in 0..fine {
            let [dx, dy] = [(x as f64 + 0.5) / FINE as f64 - u, (y as f64 + 0.5) / FINE as f64 - v];
            let (along, across) = (dx * cosine + dy * sine, dy * cosine - dx * sine);
            // image = plane / (1 + g y'), y' the plane's own height: solved for the plane
            let across = across / (radius * squeeze);
            let depth = 1.0 / (1.0 - perspective * across).max(0.05);
            let (px, py) = (along / radius * depth, across * depth);
            let share = drawing.level(px, py);
            let lit = (1.0 + light[0] * px + light[1] * py).max(0.2);
            let albedo = if bright { dark + contrast * share } else { dark + contrast * (1.0 - share) };
            picture[y * fine + x] = (albedo * lit) as f32;
        }
    }
    let sharp = shrunk(&blurred(&picture, fine, blur * FINE as f64), fine);
    let soft = blurred(&sharp, size, sharp_radius);
    let mut noise = Noise::new((random.next() * 1e15) as u64, 0);
    let full = dark + contrast;
    let samples = sharp
        .iter()
        .zip(&soft)
        .map(|(sharp, soft)| {
            let light = (f64::from(*sharp) + noise_sigma * noise.normal() / (1.0 + sharpening)).max(0.0);
            let level = light + sharpening * (light - f64::from(*soft));
            let toned = if level > 0.0 { full * (level / full).powf(tone) } else { level };
            toned.round().clamp(0.0, 255.0) as u8
        })
        .collect();
    // the unit circle's image under the perspective is an ellipse again
    let bend = 1.0 - perspective * perspective;
    let b = radius * squeeze / bend;
    let shift = -perspective * b;
    let a = radius / bend.sqrt();
    // half-way between levels that follow a curve lies another share of the light
    let curved = |light: f64| full * (light / full).powf(tone);
    let levels = full - curved(dark);
    let half_way = full * (1.0 - levels / (2.0 * full)).powf(1.0 / tone);
    let edge = (blur * blur + 1.0 / 12.0).sqrt() * normal_quantile((half_way - dark) / contrast);
    let aside = if bright { -edge } else { edge };
    CodedPatch {
        kind,
        family,
        number,
        rings: drawing
            .bands
            .into_iter()
            .filter(|(_, _, level)| *level == 1.0)
            .map(|(radii, arcs, _)| (radii, arcs))
            .collect(),
        size,
        samples,
        u: u - sine * shift,
        v: v + cosine * shift,
        diameter: 2.0 * radius,
        sector: TAU / f64::from(family.bits()) * radius * squeeze * (ring[0] + ring[1]) / 2.0,
        tilt,
        sharpening,
        axes: [a + aside, b + aside, axis],
        contrast: levels,
        blur,
        bright,
    }
}

/// Means of FINE x FINE blocks.
fn shrunk(fine: &[f32], size: usize) -> Vec<f32> {
    let coarse = size / FINE;
    let block = |i: usize| {
        let (x, y) = (i % coarse * FINE, i / coarse * FINE);
        (0..FINE).flat_map(|j| (0..FINE).map(move |i| (i, j))).map(|(i, j)| fine[(y + j) * size + x + i]).sum::<f32>()
            / (FINE * FINE) as f32
    };
    (0..coarse * coarse).map(block).collect()
}

/// Blurred by a Gaussian in both directions; the border repeats its last pixel.
pub fn blurred(picture: &[f32], width: usize, sigma: f64) -> Vec<f32> {
    let side = (3.5 * sigma).ceil() as usize;
    let kernel: Vec<f32> =
        (0..=2 * side).map(|i| (-((i as f64 - side as f64) / sigma).powi(2) / 2.0).exp() as f32).collect();
    let sum: f32 = kernel.iter().sum();
    let mut from = picture.to_vec();
    // rows, turned over the diagonal: twice gives both directions
    for size in [width, picture.len() / width] {
        let rows = picture.len() / size;
        let mut row = vec![0f32; size + 2 * side];
        let mut out = vec![0f32; picture.len()];
        for y in 0..rows {
            row[side..side + size].copy_from_slice(&from[y * size..(y + 1) * size]);
            let (first, last) = (row[side], row[side + size - 1]);
            row[..side].fill(first);
            row[side + size..].fill(last);
            let mut line = vec![0f32; size];
            for (k, weight) in kernel.iter().enumerate() {
                line.iter_mut().zip(&row[k..]).for_each(|(sum, level)| *sum += weight * level);
            }
            for (x, value) in line.into_iter().enumerate() {
                out[x * rows + y] = value / sum;
            }
        }
        from = out;
    }
    from
}
