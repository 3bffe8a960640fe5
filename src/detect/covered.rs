//! Targets of which something in front covers a part: up to a fifth of the diameter.
//!
//! A cover draws the edges of its side inwards, and an ellipse through all edges gives way to it by a few tenths of a pixel:
//! neither the outline nor its scatter shows what is wrong, only the fit of the picture does. So the ellipse is laid through
//! the edges outside of every sector in turn, and the one that leaves the least scatter says which sector is covered. What
//! stands up to all tests without it is measured without it; what does not is reported as hidden, with its place.

use super::edges::blur::{self, BLURRED, DEFOCUSED, SHARP};
use super::edges::edge;
use super::edges::look::{self, DotLevels};
use super::edges::quality;
use super::edges::sectors;
use super::edges::surround;
use super::edges::through::{self, EllipseFit, Start};
use super::ellipse::outline::Outline;
use super::measure::{Found, Measure, NEAR, NEARBY, UNEVEN, UNEXPLAINED, undisturbed};
use crate::image::Sample;

/// Sectors tried: shares of the outline. A cover of a fifth of the diameter takes 0.295 of a circle's.
const SECTORS: [f64; 3] = [0.15, 0.25, 0.35];
/// Scatter of edges, in pixels, below which one sector is as good as another.
const EVEN: f64 = 0.02;
/// Share of the other edges that may not fit either.
const OTHERS: f64 = 0.1;
/// Directions of the first look in which the step may be missing, or the inside go on.
const COVERED: u32 = 8;
/// Distance from the outline, in pixels, up to which an edge is the target's own.
const FITTING: f64 = 0.2;
/// Smallest minor axis, in pixels, of what is shown as hidden.
const SMALLEST: f64 = 7.0;
/// Scatter, relative to what is expected of a good outline, of one that is shown as hidden.
const CLEAR: f64 = 0.7;

/// Why a covered outline gives no target.
#[derive(Clone, Copy, Debug)]
pub(super) enum Covered {
    /// It is none.
    No,
    /// A target, perhaps, that cannot be measured.
    Hidden(Outline),
}

impl<T: Sample> Measure<'_, T> {
    /// Edges, ellipse and surround of a target of which one sector is covered.
    pub fn uncovered(&mut self, start: &Outline, bright: bool) -> Result<Found, Covered> {
        let (a, b) = start.semi_axes();
        let large = a < self.plane.width.min(self.plane.height) as f64;
        if !start.is_proper() || !large || 2.0 * b < SMALLEST {
            return Err(Covered::No);
        }
        look::stands_out(&self.plane, &self.levels, start, bright, COVERED, COVERED).map_err(|_| Covered::No)?;
        let (sector, rough) = self.sector(start, bright).ok_or(Covered::No)?;
        let outline = rough.outline;
        let (a, b) = outline.semi_axes();
        let options = self.options;
        let (half_u, half_v) = outline.half_box();
        let inside = outline.u - half_u >= 2.0
            && outline.v - half_v >= 2.0
            && outline.u + half_u <= self.plane.width as f64 - 2.0
            && outline.v + half_v <= self.plane.height as f64 - 2.0;
        if !inside
            || b < options.min_axis_ratio * a
            || 2.0 * a < 0.92 * options.min_diameter
            || 2.0 * a > 1.02 * options.max_diameter
        {
            return Err(Covered::No);
        }
        let count = edge::ray_count(&outline);
        self.search(&outline, bright, (0.15 * b).clamp(2.0, 6.0), count, SHARP);
        let sector = self.narrowed(sector, &outline).ok_or(Covered::No)?;
        self.cover(&sector);
        let ellipse = through::fit(&mut self.edges, &outline, Start::Near(NEAR)).ok_or(Covered::No)?;
        let outline = ellipse.outline;
        if ellipse.occluded > quality::HIDDEN {
            return Err(Covered::No);
        }
        let missing: Vec<bool> = (0..count).map(|k| self.edges.is_kept(k)).collect();
        let strength = self.strength();
        let kept = undisturbed(&self.edges, &outline, SHARP);
        let around = |blur: f64| surround::measure(&self.plane, &outline, blur, &kept, NEARBY).ok_or(Covered::No);
        let rough = around(SHARP)?;
        let blur = blur::of(strength, rough.contrast.abs());
        if blur > DEFOCUSED {
            return Err(Covered::No);
        }
        let surround = if blur > BLURRED { around(blur)? } else { rough };
        let signed = if bright { surround.contrast } else { -surround.contrast };
        let noise = self.noise(&surround);
        let blur = blur::of(strength, signed);
        let scatter = quality::expected_scatter(b, &self.levels, noise, signed, quality::steepest(blur));
        if !(signed > quality::FAINT * noise && ellipse.rms < CLEAR * scatter) {
            return Err(Covered::No);
        }
        let kept = undisturbed(&self.edges, &outline, blur);
        let levels = DotLevels { dot: surround.level + surround.contrast, background: surround.level };
        let foreign = look::unexplained(&self.plane, &outline, &missing, levels) <= UNEXPLAINED;
        if !foreign || surround.uneven > UNEVEN || 2.0 * b < quality::GAP_MINOR {
            return Err(Covered::Hidden(outline));
        }
        Ok(Found { ellipse, surround, kept, blur, strength, bright, refined: false })
    }

    /// The sector without which the edges scatter least, as shares of the parameter, and the ellipse through the others.
    fn sector(&mut self, start: &Outline, bright: bool) -> Option<([f64; 2], EllipseFit)> {
        let b = start.semi_axes().1;
        self.search(start, bright, (0.25 * b).clamp(2.0, 10.0), edge::ray_count(start), SHARP);
        let strengths = self.edges.strength.clone();
        let mut best: Option<(f64, [f64; 2], EllipseFit)> = None;
        for (share, from) in sectors::promising(&self.edges, start, &SECTORS) {
            let sector = [from, from + share];
            self.edges.strength.clone_from(&strengths);
            self.cover(&sector);
            let Some(fit) = through::fit(&mut self.edges, start, Start::Rough) else { continue };
            if fit.occluded > share + OTHERS {
                continue;
            }
            // a smaller sector leaves more to measure, and less room for chance
            let scatter = fit.rms.hypot(EVEN) * (1.0 + share);
            if best.as_ref().is_none_or(|(least, ..)| scatter < *least) {
                best = Some((scatter, sector, fit));
            }
        }
        best.map(|(_, sector, fit)| (sector, fit))
    }

    /// The part of a sector in which edges do not fit an outline that the others have; none where all fit.
    fn narrowed(&self, [from, to]: [f64; 2], outline: &Outline) -> Option<[f64; 2]> {
        let count = self.edges.len();
        let ray = |turn: f64| (turn * count as f64).ceil() as usize;
        let off = |k: &usize| {
            let k = k % count;
            let [x, y] = self.edges.place(k);
            self.edges.strength[k] <= 0.0 || outline.distance(x, y).abs() > FITTING
        };
        let rays = ray(from)..ray(to);
        let (first, last) = (rays.clone().find(off)?, rays.rev().find(off)?);
        let turn = |k: usize| k as f64 / count as f64;
        Some([turn(first), turn(last + 1)])
    }

    /// Takes the edges of a sector away.
    fn cover(&mut self, [from, to]: &[f64; 2]) {
        let count = self.edges.len();
        for k in 0..count {
            let turn = k as f64 / count as f64;
            if [turn, turn + 1.0].iter().any(|turn| (*from..*to).contains(turn)) {
                (self.edges.strength[k], self.edges.kept[k]) = (0.0, 0.0);
            }
        }
    }
}
