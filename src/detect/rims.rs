//! Ring-shaped targets: the outer rim of a disc with a hole is the target, the rim of the hole its property.
//!
//! The search finds the hole, because it is a disc of one level, and not the disc around it. So the outer rim is looked for around every target that has no
//! code: on rays from its centre, the background of a hole ends where its own level comes back. If these places are an ellipse, it is confirmed and
//! measured as any other, in a copy of the picture: to be confirmed with the hole filled up with the level of the disc, for the fit with the
//! hole left out, so that the two rims are independent.
//!
//! A dot in a closed ring has three rims: the dot, the gap, the ring. It is the design of a code's target without its code, and there the
//! dot is the target, as in all codes. The same holds of more rims: the innermost disc counts. A disc on a round card has two rims and is
//! a donut; where only its own polarity is looked for, the card is not.
//!
//! Both centres are unbiased for their own rims. That they differ by more than noise explains, d' (Σ₁ + Σ₂)⁻¹ d above the 99.9 % quantile of χ²
//! of two degrees of freedom, is said, and changes neither.

use super::acceptance::code::SPOT;
use super::acceptance::levels::STROKE;
use super::acceptance::rims::{CLEAR, CONCENTRIC, FARTHEST, OFF, RETURNS, ROUGH, SEEN};
use super::code::outline_of;
use super::edges::quick_test::{self, DotLevels};
use super::ellipse::conic;
use super::ellipse::outline::Outline;
use super::is_same;
use super::measure::{Measure, PreliminaryTarget};
use super::pass::Pass;
use super::picture::noise::{self, GreyStatistics};
use super::rendered::noise_autocorrelation::NoiseProducts;
use super::search::tested_outlines::forget_rejected;
use super::window::Window;
use crate::detection::{
    DetectOptions, Detection, InnerRim, Method, Polarity, PolarityChoice, Reason, Rejected, Target,
};
use crate::image::{Sample, SampleView};

/// Rays on which an outer rim is looked for, and the part of a pixel between two places on them.
const RAYS: usize = 48;
const STEP: f64 = 0.5;
/// Pixels beside the outer rim that are copied: what lies around a target up to its own size is its background.
const BESIDE: f64 = 40.0;

/// A disc around a hole, ready to be measured, in a copy of the picture around it.
pub(super) struct Donut {
    left: f64,
    top: f64,
    width: usize,
    height: usize,
    /// Samples in which the hole has the disc's level, and in which it is left out.
    filled: Vec<u16>,
    hollow: Vec<u16>,
    levels: GreyStatistics,
    coloured: bool,
    found: PreliminaryTarget,
    inner: InnerRim,
}

/// The level of a sample that is left out: no other is as high.
const LEFT_OUT: u16 = u16::MAX;

impl Donut {
    /// The outer rim around a target that is the hole of a donut.
    pub fn around<T: Sample>(
        plane: &SampleView<T>,
        levels: &GreyStatistics,
        options: &DetectOptions,
        target: &Target,
        coloured: bool,
    ) -> Option<Self> {
        if options.polarity != PolarityChoice::Auto || target.code.is_some() || !target.code_candidates.is_empty() {
            return None;
        }
        let hole = outline_of(target);
        let rough = rim_around(plane, levels, target, &hole)?;
        let size = 2.0 * rough.semi_axes().0 * 2.2 + 2.0 * BESIDE;
        let Window { left, top, width, height, samples } = Window::of(plane, rough.u, rough.v, size.ceil() as usize);
        let shift = |outline: Outline| Outline { u: outline.u - left as f64, v: outline.v - top as f64, ..outline };
        let (hole, rough) = (shift(hole), shift(rough));
        let mut filled: Vec<u16> = samples.iter().map(|sample| sample.level() as u16).collect();
        let disc = level_between(&SampleView::new(width, height, &filled), &hole, &rough);
        let gone = without(&hole, &rough, target.quality.edge_width);
        let mut hollow = filled.clone();
        for y in 0..height {
            let Some((from, to)) = gone.chord(y as f64 + 0.5) else { continue };
            let columns = (from.max(0.0) as usize).min(width)..((to.max(0.0).ceil()) as usize).min(width);
            filled[y * width..][columns.clone()].fill(disc.round().clamp(0.0, f64::from(T::MAX)) as u16);
            hollow[y * width..][columns].fill(LEFT_OUT);
        }
        let levels = GreyStatistics { saturation: levels.saturation.min(f64::from(LEFT_OUT)), ..*levels };
        let mut measure = Measure::new(SampleView::new(width, height, &filled), levels, options);
        let bright = target.polarity == Polarity::Dark;
        let found = measure.confirm(&rough, bright).ok()?;
        let outline = &found.ellipse.outline;
        let off = (outline.u - hole.u).hypot(outline.v - hole.v);
        if off > CONCENTRIC * outline.semi_axes().1 || hole.semi_axes().0 >= outline.semi_axes().0 {
            return None;
        }
        // the disc's level comes back all around: what looks like a hole is a dot in a closed ring
        let around = DotLevels { dot: disc, background: found.surround.level };
        if quick_test::stroke(&measure.plane, outline, around) > STROKE {
            return None;
        }
        let inner = InnerRim::of(target);
        let (left, top) = (left as f64, top as f64);
        Some(Self { left, top, width, height, filled, hollow, levels, coloured, found, inner })
    }

    /// The target, by one method, and what its neighbouring pixels share. Only a fit can leave the hole out.
    pub fn measured(&self, options: &DetectOptions, method: Method) -> Result<(Target, Option<NoiseProducts>), Reason> {
        let samples = if method == Method::LeastSquares { &self.hollow } else { &self.filled };
        let mut measure = Measure::new(SampleView::new(self.width, self.height, samples), self.levels, options);
        measure.work.coloured = self.coloured;
        let mut target = measure.finish(&self.found, method)?;
        let filled = Measure::new(SampleView::new(self.width, self.height, &self.filled), self.levels, options);
        target.quality.saturated = filled.saturated(&outline_of(&target));
        (target.u, target.v) = (target.u + self.left, target.v + self.top);
        target.inner = Some(self.inner);
        Ok((target, measure.work.noise_products()))
    }

    /// The blob of a donut that is not measured.
    fn rejected(&self, reason: Reason) -> Rejected {
        let outline = &self.found.ellipse.outline;
        let (u, v) = (outline.u + self.left, outline.v + self.top);
        Rejected { u, v, diameter: 2.0 * outline.semi_axes().0, reason }
    }

    /// The target by the method asked for, or at its ellipse where a fit to its levels fails.
    fn target(&self, options: &DetectOptions) -> Result<(Target, Option<NoiseProducts>), Reason> {
        let by_levels = self.measured(options, options.method);
        by_levels.or_else(|reason| self.measured(options, Method::Ellipse).map_err(|_| reason))
    }
}

/// What is left out of a disc for its hole: as far as the blur of the hole's rim reaches, but no more than half of what lies between the rims.
fn without(hole: &Outline, disc: &Outline, blur: f64) -> Outline {
    let ((a, b), (hole_a, hole_b)) = (disc.semi_axes(), hole.semi_axes());
    let reach = 3.0 * (blur * blur + 1.0 / 12.0).sqrt() + 0.5;
    hole.grown(reach.min((a - hole_a).min(b - hole_b) / 2.0))
}

/// The same of a target; `None` for one without a hole.
pub(super) fn left_out(target: &Target) -> Option<Outline> {
    let hole = outline_of(&hole_of(target)?);
    Some(without(&hole, &outline_of(target), target.quality.edge_width))
}

/// The hole of a target as a target of its own.
pub(super) fn hole_of(target: &Target) -> Option<Target> {
    let inner = target.inner?;
    let polarity = match target.polarity {
        Polarity::Bright => Polarity::Dark,
        Polarity::Dark => Polarity::Bright,
    };
    Some(Target { inner: None, polarity, ..inner.laid_on(target.clone()) })
}

/// Makes donuts of those targets of a picture that are their holes. What was reported as rejected in their place is so no longer.
pub(super) fn settle<T: Sample>(
    plane: &SampleView<T>,
    levels: &GreyStatistics,
    options: &DetectOptions,
    coloured: bool,
    detection: &mut Detection,
) {
    let (mut holes, mut unmeasured) = (Vec::new(), Vec::new());
    let mut pass = Pass { coloured, ..Pass::default() };
    for (k, target) in detection.targets.iter().enumerate() {
        let Some(donut) = Donut::around(plane, levels, options, target, coloured) else { continue };
        match donut.target(options) {
            Ok((outer, colour)) => {
                pass.colours.extend(colour.map(|colour| ([outer.u, outer.v], colour)));
                pass.detection.targets.push(outer);
                holes.push(k);
            }
            // The hole is no substitute: its centre is another one.
            Err(reason) => unmeasured.push((k, donut.rejected(reason))),
        }
    }
    pass.correlate();
    let mut gone = vec![false; detection.targets.len()];
    for (k, mut outer) in holes.into_iter().zip(pass.detection.targets) {
        compare_centres(&mut outer);
        forget_rejected(detection, &outer);
        let again = |(other, target): (usize, &Target)| other != k && is_same(target, &outer);
        for (other, gone) in gone.iter_mut().enumerate() {
            *gone |= again((other, &detection.targets[other]));
        }
        detection.targets[k] = outer;
    }
    for (k, rejected) in unmeasured {
        gone[k] = true;
        detection.rejected_blobs.push(rejected);
    }
    let mut gone = gone.into_iter();
    detection.targets.retain(|_| !gone.next().unwrap_or_default());
}

/// The donut whose hole a target is, or the target as it is; `None` for a donut whose outer rim cannot be measured.
pub(super) fn settle_one<T: Sample>(plane: &SampleView<T>, options: &DetectOptions, target: Target) -> Option<Target> {
    let levels = noise::levels(plane);
    let Some(donut) = Donut::around(plane, &levels, options, &target, false) else { return Some(target) };
    let (mut outer, _) = donut.target(options).ok()?;
    compare_centres(&mut outer);
    Some(outer)
}

/// Says of a donut whether its two centres differ by more than their standard errors explain.
pub(super) fn compare_centres(target: &mut Target) {
    let Some(inner) = &mut target.inner else { return };
    let [du, dv] = [target.u - inner.u, target.v - inner.v];
    let uu = target.sigma_u.powi(2) + inner.sigma_u.powi(2);
    let vv = target.sigma_v.powi(2) + inner.sigma_v.powi(2);
    let uv = target.covariance_uv + inner.covariance_uv;
    let square = (vv * du * du - 2.0 * uv * du * dv + uu * dv * dv) / (uu * vv - uv * uv);
    inner.off_centre = square > OFF;
}

/// The outer rim around a hole: the ellipse beyond which the level of the hole comes back. `None` if it does not come back on enough rays.
fn rim_around<T: Sample>(
    plane: &SampleView<T>,
    levels: &GreyStatistics,
    target: &Target,
    hole: &Outline,
) -> Option<Outline> {
    let sign = if target.polarity == Polarity::Bright { 1.0 } else { -1.0 };
    let rise = (RETURNS * target.contrast).max(CLEAR * levels.noise.max(target.quality.noise));
    let farthest = FARTHEST * hole.semi_axes().0;
    let mut places = Vec::with_capacity(RAYS);
    for k in 0..RAYS {
        if (k - places.len()) as f64 > (1.0 - SEEN) * RAYS as f64 {
            return None;
        }
        let (s, c) = (std::f64::consts::TAU * k as f64 / RAYS as f64).sin_cos();
        let rim = hole.rim(c, s);
        let [dx, dy] = [rim.x - hole.u, rim.y - hole.v];
        let length = dx.hypot(dy);
        let (mut lowest, mut at) = (f64::INFINITY, length);
        while at < farthest {
            let share = at / length;
            let [x, y] = [hole.u + share * dx, hole.v + share * dy];
            if !plane.holds(x, y, 2.0) {
                break;
            }
            let level = sign * f64::from(plane.sample(x as f32, y as f32));
            lowest = lowest.min(level);
            if level - lowest > rise {
                places.push([x, y, 1.0]);
                break;
            }
            at += STEP;
        }
    }
    let away = |[x, y, _]: &[f64; 3]| {
        let [c, s] = hole.normalised(*x, *y);
        c.hypot(s)
    };
    let mut radii: Vec<f64> = places.iter().map(away).collect();
    radii.sort_by(f64::total_cmp);
    let middle = *radii.get(radii.len() / 2)?;
    places.retain(|place| (away(place) / middle - 1.0).abs() < ROUGH);
    if (places.len() as f64) < SEEN * RAYS as f64 || middle < 1.0 + SPOT {
        return None;
    }
    conic::fit(&places)
}

/// Median level half-way between two rims.
fn level_between(plane: &SampleView<u16>, inner: &Outline, outer: &Outline) -> f64 {
    let mut levels: Vec<f32> = (0..RAYS)
        .map(|k| {
            let (s, c) = (std::f64::consts::TAU * k as f64 / RAYS as f64).sin_cos();
            let (first, second) = (inner.rim(c, s), outer.rim(c, s));
            plane.nearest((first.x + second.x) / 2.0, (first.y + second.y) / 2.0)
        })
        .collect();
    f64::from(*levels.select_nth_unstable_by(RAYS / 2, f32::total_cmp).1)
}
