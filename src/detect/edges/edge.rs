//! Sub-pixel edge points on rays across an outline.
//!
//! Along the outward normal of every rim point the picture is sampled bilinearly, one sample a pixel; the edge is where
//! the fall (bright targets) or rise (dark ones) over two pixels is steepest, to a fraction of a pixel by the parabola
//! through the three steepest values. [`refine`] then fits the whole profile of a blurred edge to each ray.

use wide::{f32x4, i32x4};

use super::ellipse_fit::Scratch;
use crate::detect::ellipse::outline::Outline;
use crate::detect::ellipse::rays::{FourRims, Rays, quarter, rim_points};
use crate::detect::normal::{BLUR, normal_distribution};
use crate::image::{Sample, SampleView};

/// Edges looked for on the rays of an outline, one array a quantity. As many as a multiple of four.
#[derive(Default)]
pub(crate) struct Edges {
    /// Place that x and y are counted from.
    pub origin: [f64; 2],
    pub x: Vec<f32>,
    pub y: Vec<f32>,
    /// Grey difference over two pixels across the edge; 0 if no edge was found.
    pub strength: Vec<f32>,
    /// 1 for what the fit uses, 0 for what is occluded or disturbed.
    pub kept: Vec<f32>,
    /// Memory of the fits through them.
    pub scratch: Scratch,
}

impl Edges {
    /// Makes room for `count` rays of an outline.
    pub fn begin(&mut self, outline: &Outline, count: usize) {
        self.origin = [outline.u, outline.v];
        for column in [&mut self.x, &mut self.y, &mut self.strength, &mut self.kept] {
            column.clear();
            column.resize(count, 0.0);
        }
    }

    /// Number of rays.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Enters what was found on a ray, at a place of the picture.
    pub fn set(&mut self, ray: usize, [x, y]: [f64; 2], strength: f64, kept: bool) {
        self.x[ray] = (x - self.origin[0]) as f32;
        self.y[ray] = (y - self.origin[1]) as f32;
        self.strength[ray] = strength as f32;
        self.kept[ray] = if kept { 1.0 } else { 0.0 };
    }

    /// Place of an edge in the picture.
    pub fn place(&self, ray: usize) -> [f64; 2] {
        [self.origin[0] + f64::from(self.x[ray]), self.origin[1] + f64::from(self.y[ray])]
    }

    /// Whether the fit uses a ray.
    pub fn is_kept(&self, ray: usize) -> bool {
        self.kept[ray] > 0.0
    }
}

/// Longest ray, in samples.
const LONGEST: usize = 64;

/// Number of rays for an outline: about one a pixel and a half of rim. A multiple of four, so that the rays of a turned
/// or mirrored picture are the same rays.
pub(crate) fn ray_count(outline: &Outline) -> usize {
    ((outline.perimeter() / 6.0).round() as usize * 4).clamp(20, 48)
}

/// Looks for the edge on `count` rays, up to `reach` pixels inside and outside of the outline.
#[inline(never)]
pub(crate) fn search<T: Sample>(
    plane: &SampleView<T>,
    outline: &Outline,
    bright: bool,
    reach: f64,
    count: usize,
    threshold: f64,
    found: &mut Edges,
) {
    found.begin(outline, count);
    let side = (reach.ceil() as usize).clamp(2, LONGEST / 2 - 2);
    let sign = if bright { 1.0 } else { -1.0 };
    let (half_u, half_v) = outline.half_box();
    let room = side as f64 + 3.0;
    // walking is in numbers of 32 bits, of which 16 are behind the point
    let walks = |middle: f64, half: f64, size: usize| {
        middle - half >= room && middle + half + room <= (size as f64).min(32000.0)
    };
    let walks = walks(outline.u, half_u, plane.width) && walks(outline.v, half_v, plane.height);
    let rays = Rays::new(outline);
    for (k, [c, s]) in quarter(count).enumerate() {
        let rims = rays.at(c, s);
        let (t, strength) =
            if walks { walk(plane, outline, &rims, side, sign) } else { at_border(plane, outline, &rims, side, sign) };
        let is_edge = strength.simd_gt(f32x4::splat(threshold as f32));
        let t = is_edge & t;
        let places = [rims.x + t * rims.nx, rims.y + t * rims.ny, is_edge & strength, is_edge & f32x4::ONE];
        let Edges { x, y, strength, kept, .. } = &mut *found;
        for (column, values) in [x, y, strength, kept].into_iter().zip(places) {
            for (turn, value) in values.to_array().into_iter().enumerate() {
                column[k + turn * count / 4] = value;
            }
        }
    }
}

/// Of two edges alike the nearer one counts: the weight of a step at a distance from the outline.
fn weight(distance: f32, side: usize) -> f32 {
    let share = distance / (side as f32 + 1.0);
    1.0 - 0.4 * share * share
}

/// Steepest place on each of four rays, from the rim outwards, and the fall over two pixels there.
#[inline(always)]
fn walk<T: Sample>(
    plane: &SampleView<T>,
    outline: &Outline,
    rims: &FourRims,
    side: usize,
    sign: f32,
) -> (f32x4, f32x4) {
    let one = f32x4::splat(65536.0);
    let back = f32x4::splat(side as f32 + 1.0);
    let start = |middle: f64, rim: f32x4, normal: f32x4| {
        i32x4::splat(((middle - 0.5) * 65536.0) as i32) + ((rim - back * normal) * one).fast_trunc_int()
    };
    let (mut x, mut y) = (start(outline.u, rims.x, rims.nx), start(outline.v, rims.y, rims.ny));
    let (dx, dy) = ((rims.nx * one).fast_trunc_int(), (rims.ny * one).fast_trunc_int());
    let sign = f32x4::splat(sign);
    let (mut first, mut second) = (f32x4::ZERO, f32x4::ZERO);
    let mut best = Steepest::default();
    for i in 0..2 * side + 3 {
        let third = plane.bilinear_four(x, y);
        if i >= 2 {
            let distance = i as f32 - side as f32 - 2.0;
            best.see(sign * (first - third), weight(distance, side), distance, i == 2);
        }
        (first, second) = (second, third);
        (x, y) = (x + dx, y + dy);
    }
    best.place()
}

/// The same where rays leave the picture, or so far from its origin that they cannot be walked: sample by sample.
#[inline(never)]
fn at_border<T: Sample>(
    plane: &SampleView<T>,
    outline: &Outline,
    rims: &FourRims,
    side: usize,
    sign: f32,
) -> (f32x4, f32x4) {
    let [x, y, nx, ny] = [rims.x, rims.y, rims.nx, rims.ny].map(f32x4::to_array);
    let (mut profiles, samples) = ([[0f32; LONGEST]; 4], 2 * side + 3);
    for (k, profile) in profiles.iter_mut().enumerate() {
        let normal = [nx[k], ny[k]].map(f64::from);
        let back = side as f64 + 1.0;
        let start = [outline.u + f64::from(x[k]) - back * normal[0], outline.v + f64::from(y[k]) - back * normal[1]];
        plane.profile(start, normal, &mut profile[..samples]);
    }
    let level = |i: usize| f32x4::new([0, 1, 2, 3].map(|k| profiles[k][i]));
    let mut best = Steepest::default();
    for i in 0..=2 * side {
        let distance = i as f32 - side as f32;
        best.see(f32x4::splat(sign) * (level(i) - level(i + 2)), weight(distance, side), distance, i == 0);
    }
    best.place()
}

/// The steepest fall on each of four rays, with its neighbours.
struct Steepest {
    weighted: f32x4,
    at: f32x4,
    before: f32x4,
    middle: f32x4,
    after: f32x4,
    /// The fall seen last, and whether it was the steepest so far.
    last: f32x4,
    fresh: f32x4,
}

impl Default for Steepest {
    fn default() -> Self {
        let zero = f32x4::ZERO;
        let weighted = f32x4::splat(f32::NEG_INFINITY);
        Self { weighted, at: zero, before: zero, middle: zero, after: zero, last: zero, fresh: zero }
    }
}

impl Steepest {
    #[inline(always)]
    fn see(&mut self, fall: f32x4, weight: f32, distance: f32, first: bool) {
        let weighted = fall * f32x4::splat(weight);
        let better = weighted.simd_gt(self.weighted);
        // at either end the missing neighbour is taken to be as steep
        let before = if first { fall } else { self.last };
        self.after = self.fresh.select(fall, self.after);
        self.after = better.select(fall, self.after);
        self.before = better.select(before, self.before);
        self.middle = better.select(fall, self.middle);
        self.at = better.select(f32x4::splat(distance), self.at);
        self.weighted = better.select(weighted, self.weighted);
        (self.last, self.fresh) = (fall, better);
    }

    /// Place by the parabola through the three falls, and the steepest of them.
    #[inline(always)]
    fn place(&self) -> (f32x4, f32x4) {
        let half = f32x4::splat(0.5);
        let bend = self.before - (self.middle + self.middle) + self.after;
        let bent = bend.simd_lt(f32x4::ZERO);
        let fraction = half * (self.before - self.after) / bent.select(bend, f32x4::ONE);
        let fraction = bent & fraction.fast_max(-half).fast_min(half);
        (self.at + fraction, self.middle)
    }
}

/// The same out of focus, where no place is the steepest within the noise: the fall counts between the means of `wide`
/// samples on each side. Its noise moves an edge of blur s = `wide` by about 4 s n / C.
#[allow(clippy::too_many_arguments)]
pub(crate) fn search_wide<T: Sample>(
    plane: &SampleView<T>,
    outline: &Outline,
    bright: bool,
    reach: f64,
    count: usize,
    wide: usize,
    threshold: f64,
    found: &mut Edges,
) {
    found.begin(outline, count);
    let wide = wide.clamp(1, LONGEST / 8);
    let side = (reach.ceil() as usize).clamp(2, LONGEST / 2 - 1 - wide);
    let sign = if bright { 1.0 } else { -1.0 };
    let samples = 2 * (side + wide) + 1;
    let back = (side + wide) as f64;
    let mut profile = [0f32; LONGEST];
    for (ray, rim) in rim_points(outline, count).enumerate() {
        let start = [rim.x - back * rim.normal[0], rim.y - back * rim.normal[1]];
        plane.profile(start, rim.normal, &mut profile[..samples]);
        let mean = |part: &[f32]| part.iter().sum::<f32>() / wide as f32;
        let fall = |i: usize| sign * (mean(&profile[i - wide..i]) - mean(&profile[i + 1..=i + wide]));
        let mut best = (f32::NEG_INFINITY, side + wide);
        for i in wide..samples - wide {
            let weighted = fall(i) * weight(i as f32 - back as f32, side);
            if weighted > best.0 {
                best = (weighted, i);
            }
        }
        let (middle, at) = (fall(best.1), best.1);
        found.set(ray, [rim.x, rim.y], 0.0, false);
        if f64::from(middle) > threshold {
            let before = if at > wide { fall(at - 1) } else { middle };
            let after = if at + wide + 1 < samples { fall(at + 1) } else { middle };
            let bend = before - 2.0 * middle + after;
            let fraction = if bend < 0.0 { (0.5 * (before - after) / bend).clamp(-0.5, 0.5) } else { 0.0 };
            let t = f64::from(at as f32 + fraction) - back;
            let place = [rim.x + t * rim.normal[0], rim.y + t * rim.normal[1]];
            found.set(ray, place, 2.0 / (wide as f64 + 1.0) * f64::from(middle), true);
        }
    }
}

/// Grey levels of a target for the refinement of its edges.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeProfile {
    /// Background at the origin of the slope and its slope.
    pub level: f64,
    pub slope: [f64; 2],
    pub origin: [f64; 2],
    /// Inside minus outside.
    pub contrast: f64,
    /// Slope of the light, as a share of it a pixel.
    pub light: [f64; 2],
    /// Blur of the edge in the pixels, sigma.
    pub blur: f64,
}

/// Largest share of the light that a curved rim is taken to lose: there the first order ends.
const MOST_CURVED: f64 = 0.3;

/// Variance that bilinear sampling adds, in square pixels, on average over all places between pixels.
const BILINEAR: f64 = 1.0 / 6.0;

/// Share of its contrast that a disc of this radius and blur shows half-way between its centre and its rim: that of a strip
/// along the radius times that of a chord across.
pub(crate) fn half_way(radius: f64, blur: f64) -> f64 {
    let z = [0.5, 1.5, 0.75f64.sqrt()].map(|share| (share * radius / blur.max(BLUR.0)) as f32);
    let [near, far, chord, _] = normal([z[0], z[1], z[2], 0.0]).0.map(f64::from);
    (near + far - 1.0) * (2.0 * chord - 1.0)
}

/// Slope of the sampled edge's profile at whole pixels from its middle: the weights of the samples in its place.
pub(crate) fn slopes(blur: f64) -> Vec<f64> {
    let side = refined_side(blur) as i32;
    let sampled = (blur * blur + BILINEAR).sqrt();
    (-side..=side).map(|t| f64::from(normal([(f64::from(t) / sampled) as f32; 4]).1[0]) / sampled).collect()
}

/// Pixels to both sides of the rim that a refined edge is fitted to.
fn refined_side(blur: f64) -> usize {
    ((3.0 * (blur * blur + BILINEAR).sqrt()).ceil() as usize).clamp(2, LONGEST / 2 - 2)
}

/// A sample on a ray: its level between background (0) and target (1), the four pixels it is drawn from by their weights
/// and their distances from the outline.
type RaySample = (f64, [f64; 4], [f64; 4]);

/// Edge points by fitting each ray's profile for its shift δ: Gauss-Newton steps of one unknown. All samples across the edge
/// count, each with the derivative of the profile as its weight.
///
/// The profile of a sample is drawn from its four pixels as the sample is, Σ w (Φ(-z) - κ s φ(z) / 2) with z = (d - δ)/s: what
/// bilinear sampling does to an edge depends on where it lies between the pixels, and would move the centre by half its
/// standard error. The second term is the light that a rim of curvature κ lacks, in first order.
pub(crate) fn refine<T: Sample>(
    plane: &SampleView<T>,
    outline: &Outline,
    profile: &EdgeProfile,
    count: usize,
    found: &mut Edges,
) {
    found.begin(outline, count);
    let side = refined_side(profile.blur);
    let mut samples: Vec<RaySample> = Vec::with_capacity(2 * side + 1);
    for (ray, rim) in rim_points(outline, count).enumerate() {
        samples.clear();
        samples.extend((0..=2 * side).map(|i| {
            let t = i as f64 - side as f64;
            draw(plane, outline, profile, rim.x + t * rim.normal[0], rim.y + t * rim.normal[1])
        }));
        let curved = (0.5 * profile.blur * outline.curvature(rim.x, rim.y)).min(MOST_CURVED);
        let (mut shift, mut weight) = (0.0, 0.0);
        for _ in 0..4 {
            let mut sum = 0.0;
            weight = 0.0;
            for (value, weights, distances) in &samples {
                let (outside, density) = normal(distances.map(|d| ((d - shift) / profile.blur) as f32));
                let drawn =
                    |levels: [f32; 4]| -> f64 { weights.iter().zip(levels).map(|(w, l)| w * f64::from(l)).sum() };
                let light = drawn(density);
                sum += light * (value - 1.0 + drawn(outside) + curved * light);
                weight += light * light / profile.blur;
            }
            shift = (shift + sum / weight.max(1e-9)).clamp(-(side as f64), side as f64);
        }
        let place = [rim.x + shift * rim.normal[0], rim.y + shift * rim.normal[1]];
        found.set(ray, place, (weight / profile.blur).sqrt(), shift.abs() < side as f64 * 0.9);
    }
}

/// The bilinear sample at a place.
fn draw<T: Sample>(plane: &SampleView<T>, outline: &Outline, profile: &EdgeProfile, x: f64, y: f64) -> RaySample {
    let (left, top) = ((x - 0.5).floor(), (y - 0.5).floor());
    let (fx, fy) = (x - 0.5 - left, y - 0.5 - top);
    let weights = [(1.0 - fx) * (1.0 - fy), fx * (1.0 - fy), (1.0 - fx) * fy, fx * fy];
    let places = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[dx, dy]| [left + dx + 0.5, top + dy + 0.5]);
    let [slope_x, slope_y] = profile.slope;
    let (dx, dy) = (x - profile.origin[0], y - profile.origin[1]);
    let background = profile.level + slope_x * dx + slope_y * dy;
    let contrast = profile.contrast * (1.0 + profile.light[0] * dx + profile.light[1] * dy);
    let level = places.iter().zip(weights).map(|([x, y], w)| w * f64::from(plane.nearest(*x, *y))).sum::<f64>();
    ((level - background) / contrast, weights, places.map(|[x, y]| outline.nearest(x, y).1))
}

/// Φ(z) and its density.
fn normal(z: [f32; 4]) -> ([f32; 4], [f32; 4]) {
    let (below, density) = normal_distribution(f32x4::new(z.map(|z| z.clamp(-5.5, 5.5))));
    (below.to_array(), density.to_array())
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn four_rays_walked_are_as_sample_by_sample() {
        let level = |x: usize, y: usize| ((x * 37 + y * 91 + x * y % 53) % 200) as u16;
        let samples: Vec<u16> = (0..90 * 90).map(|i| 300 * level(i % 90, i / 90)).collect();
        let plane = SampleView::new(90, 90, &samples);
        let outline = Outline::from_axes(44.7, 45.2, 17.0, 11.0, 0.7);
        for (side, sign) in [(2, 1.0), (9, -1.0)] {
            for [c, s] in quarter(40) {
                let rims = Rays::new(&outline).at(c, s);
                let walked = walk(&plane, &outline, &rims, side, sign);
                let plain = at_border(&plane, &outline, &rims, side, sign);
                let close = |a: f32x4, b: f32x4, limit: f32| (a - b).abs().simd_lt(f32x4::splat(limit)).all();
                // places are good to 2^-16 pixels a step, and the levels to that times their steps
                assert!(close(walked.0, plain.0, 1e-2) && close(walked.1, plain.1, 60.0), "{walked:?} {plain:?}");
            }
        }
    }
}
