//! Sub-pixel edge points on rays across an outline.
//!
//! Along the outward normal of every rim point the picture is sampled bilinearly, one sample a pixel; the edge is where
//! the fall (bright targets) or rise (dark ones) over two pixels is steepest, to a fraction of a pixel by the parabola
//! through the three steepest values. [`refine`] then fits the whole profile of a blurred edge to each ray.

use wide::f32x4;

use super::outline::{Outline, RimPoint};
use super::rendered::{BLUR, normal_distribution};
use crate::image::{Plane, Sample};

/// An edge looked for on one ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgePoint {
    pub x: f64,
    pub y: f64,
    /// Grey difference over two pixels across the edge; 0 where no edge was found.
    pub strength: f64,
    /// Used by the fit; false for what is hidden or disturbed.
    pub kept: bool,
}

/// Longest ray, in samples.
const LONGEST: usize = 64;

/// Number of rays for an outline: about one a pixel and a half of rim. A multiple of four, so that the rays of a turned
/// or mirrored picture are the same rays.
pub(crate) fn ray_count(outline: &Outline) -> usize {
    ((outline.perimeter() / 6.0).round() as usize * 4).clamp(20, 48)
}

/// Rim points at equal steps of the parameter.
pub(crate) fn rim_points(outline: &Outline, count: usize) -> impl Iterator<Item = RimPoint> + use<> {
    let outline = *outline;
    let (turn_s, turn_c) = (std::f64::consts::TAU / count as f64).sin_cos();
    let (mut c, mut s) = (1.0, 0.0);
    (0..count).map(move |_| {
        let rim = outline.rim(c, s);
        (c, s) = (c * turn_c - s * turn_s, s * turn_c + c * turn_s);
        rim
    })
}

/// Looks for the edge on `count` rays, up to `reach` pixels inside and outside of the outline.
#[inline(never)]
pub(crate) fn search<T: Sample>(
    plane: &Plane<T>,
    outline: &Outline,
    bright: bool,
    reach: f64,
    count: usize,
    threshold: f64,
    found: &mut Vec<EdgePoint>,
) {
    found.clear();
    let side = (reach.ceil() as usize).clamp(2, LONGEST / 2 - 2);
    let sign = if bright { 1.0 } else { -1.0 };
    let samples = 2 * side + 3;
    // of two edges alike the nearer one counts
    let mut weights = [0f32; LONGEST];
    for (i, weight) in weights[1..samples - 1].iter_mut().enumerate() {
        let distance = (i as f32 - side as f32) / (side as f32 + 1.0);
        *weight = sign * (1.0 - 0.4 * distance * distance);
    }
    let mut profile = [0f32; LONGEST];
    for rim in rim_points(outline, count) {
        let back = side as f64 + 1.0;
        let start = [rim.x - back * rim.normal[0], rim.y - back * rim.normal[1]];
        plane.profile(start, rim.normal, &mut profile[..samples]);
        let mut best = (f32::NEG_INFINITY, side + 1);
        for (i, (three, weight)) in profile[..samples].windows(3).zip(&weights[1..]).enumerate() {
            let weighted = (three[0] - three[2]) * weight;
            if weighted > best.0 {
                best = (weighted, i + 1);
            }
        }
        let fall = |i: usize| sign * (profile[i - 1] - profile[i + 1]);
        let (middle, at) = (fall(best.1), best.1);
        let mut point = EdgePoint { x: rim.x, y: rim.y, strength: 0.0, kept: false };
        if f64::from(middle) > threshold {
            let before = if at > 1 { fall(at - 1) } else { middle };
            let after = if at + 2 < samples { fall(at + 1) } else { middle };
            let bend = before - 2.0 * middle + after;
            let fraction = if bend < 0.0 { (0.5 * (before - after) / bend).clamp(-0.5, 0.5) } else { 0.0 };
            let t = f64::from(at as f32 + fraction) - (side as f64 + 1.0);
            point = EdgePoint {
                x: rim.x + t * rim.normal[0],
                y: rim.y + t * rim.normal[1],
                strength: f64::from(middle),
                kept: true,
            };
        }
        found.push(point);
    }
}

/// The same out of focus, where no place is the steepest within the noise: the fall counts between the means of `wide`
/// samples on each side. Its noise moves an edge of blur s = `wide` by about 4 s n / C.
#[allow(clippy::too_many_arguments)]
pub(crate) fn search_wide<T: Sample>(
    plane: &Plane<T>,
    outline: &Outline,
    bright: bool,
    reach: f64,
    count: usize,
    wide: usize,
    threshold: f64,
    found: &mut Vec<EdgePoint>,
) {
    found.clear();
    let wide = wide.clamp(1, LONGEST / 8);
    let side = (reach.ceil() as usize).clamp(2, LONGEST / 2 - 1 - wide);
    let sign = if bright { 1.0 } else { -1.0 };
    let samples = 2 * (side + wide) + 1;
    let back = (side + wide) as f64;
    let mut profile = [0f32; LONGEST];
    for rim in rim_points(outline, count) {
        let start = [rim.x - back * rim.normal[0], rim.y - back * rim.normal[1]];
        plane.profile(start, rim.normal, &mut profile[..samples]);
        let mean = |part: &[f32]| part.iter().sum::<f32>() / wide as f32;
        let fall = |i: usize| sign * (mean(&profile[i - wide..i]) - mean(&profile[i + 1..=i + wide]));
        let mut best = (f32::NEG_INFINITY, side + wide);
        for i in wide..samples - wide {
            // of two edges alike the nearer one counts
            let distance = (i as f32 - back as f32) / (side as f32 + 1.0);
            let weighted = fall(i) * (1.0 - 0.4 * distance * distance);
            if weighted > best.0 {
                best = (weighted, i);
            }
        }
        let (middle, at) = (fall(best.1), best.1);
        let mut point = EdgePoint { x: rim.x, y: rim.y, strength: 0.0, kept: false };
        if f64::from(middle) > threshold {
            let before = if at > wide { fall(at - 1) } else { middle };
            let after = if at + wide + 1 < samples { fall(at + 1) } else { middle };
            let bend = before - 2.0 * middle + after;
            let fraction = if bend < 0.0 { (0.5 * (before - after) / bend).clamp(-0.5, 0.5) } else { 0.0 };
            let t = f64::from(at as f32 + fraction) - back;
            point = EdgePoint {
                x: rim.x + t * rim.normal[0],
                y: rim.y + t * rim.normal[1],
                strength: 2.0 / (wide as f64 + 1.0) * f64::from(middle),
                kept: true,
            };
        }
        found.push(point);
    }
}

/// What is known of a target's grey levels when its edges are refined.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Profile {
    /// Background at the origin of the slope and its slope.
    pub level: f64,
    pub slope: [f64; 2],
    pub origin: [f64; 2],
    /// Inside minus outside.
    pub contrast: f64,
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
type Drawn = (f64, [f64; 4], [f64; 4]);

/// Edge points by fitting each ray's profile for its shift δ: Gauss-Newton steps of one unknown. All samples across the edge
/// count, each with the derivative of the profile as its weight.
///
/// The profile of a sample is drawn from its four pixels as the sample is, Σ w (Φ(-z) - κ s φ(z) / 2) with z = (d - δ)/s: what
/// bilinear sampling does to an edge depends on where it lies between the pixels, and would move the centre by half its
/// standard error. The second term is the light that a rim of curvature κ lacks, in first order.
pub(crate) fn refine<T: Sample>(
    plane: &Plane<T>,
    outline: &Outline,
    profile: &Profile,
    count: usize,
    found: &mut Vec<EdgePoint>,
) {
    found.clear();
    let side = refined_side(profile.blur);
    let mut samples: Vec<Drawn> = Vec::with_capacity(2 * side + 1);
    for rim in rim_points(outline, count) {
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
        found.push(EdgePoint {
            x: rim.x + shift * rim.normal[0],
            y: rim.y + shift * rim.normal[1],
            strength: (weight / profile.blur).sqrt(),
            kept: shift.abs() < side as f64 * 0.9,
        });
    }
}

/// The bilinear sample at a place.
fn draw<T: Sample>(plane: &Plane<T>, outline: &Outline, profile: &Profile, x: f64, y: f64) -> Drawn {
    let (left, top) = ((x - 0.5).floor(), (y - 0.5).floor());
    let (fx, fy) = (x - 0.5 - left, y - 0.5 - top);
    let weights = [(1.0 - fx) * (1.0 - fy), fx * (1.0 - fy), (1.0 - fx) * fy, fx * fy];
    let places = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[dx, dy]| [left + dx + 0.5, top + dy + 0.5]);
    let [slope_x, slope_y] = profile.slope;
    let background = profile.level + slope_x * (x - profile.origin[0]) + slope_y * (y - profile.origin[1]);
    let level = places.iter().zip(weights).map(|([x, y], w)| w * f64::from(plane.nearest(*x, *y))).sum::<f64>();
    ((level - background) / profile.contrast, weights, places.map(|[x, y]| outline.nearest(x, y).1))
}

/// Φ(z) and its density.
fn normal(z: [f32; 4]) -> ([f32; 4], [f32; 4]) {
    let (below, density) = normal_distribution(f32x4::new(z.map(|z| z.clamp(-5.5, 5.5))));
    (below.to_array(), density.to_array())
}
