//! Partly occluded targets: up to a fifth of the diameter.
//!
//! An occluder draws the edges of its side inwards, and an ellipse through all edges gives way to it by a few tenths of a pixel:
//! neither the outline nor its scatter shows what is wrong, only the fit of the picture does. So the ellipse is laid through
//! the edges outside of every sector in turn, and the one that leaves the least scatter says which sector is occluded. What
//! stands up to all tests without it is measured without it; what does not is reported as occluded, with its place.

use super::acceptance::levels::{FAINT, UNEVEN};
use super::acceptance::occlusion::{CLEAR, EVEN, FITTING, SECTORS};
use super::acceptance::outline::{GAP_MINOR, HIDDEN, SMALL_GAP};
use super::acceptance::partial::SMALLEST;
use super::acceptance::quick_test::OCCLUDED;
use super::edges::blur::{self, BLURRED, DEFOCUSED, SHARP};
use super::edges::edge;
use super::edges::ellipse_fit::{self, EllipseFit, Start};
use super::edges::quality;
use super::edges::quick_test::{self, DotLevels};
use super::edges::sectors;
use super::edges::surround;
use super::ellipse::outline::Outline;
use super::measure::confirm::{NEAR, NEARBY, undisturbed};
use super::measure::{Measure, PreliminaryTarget};
use crate::image::Sample;

/// Reason why an occluded outline gives no target.
#[derive(Clone, Copy, Debug)]
pub(super) enum Occlusion {
    /// It is not the outline of a target.
    NoTarget,
    /// Possibly a target, too much occluded to be measured.
    NotMeasurable(Outline),
}

impl<T: Sample> Measure<'_, T> {
    /// Edges, ellipse and annulus of a target with one occluded sector.
    pub fn occluded_target(&mut self, start: &Outline, bright: bool) -> Result<PreliminaryTarget, Occlusion> {
        let (a, b) = start.semi_axes();
        let large = a < self.plane.width.min(self.plane.height) as f64;
        if !start.is_proper() || !large || 2.0 * b < SMALLEST {
            return Err(Occlusion::NoTarget);
        }
        quick_test::stands_out(&self.plane, &self.levels, start, bright, OCCLUDED, OCCLUDED)
            .map_err(|_| Occlusion::NoTarget)?;
        let (sector, rough) = self.sector(start, bright).ok_or(Occlusion::NoTarget)?;
        let outline = rough.outline;
        let b = outline.semi_axes().1;
        self.size_allows(&outline).and_then(|()| self.has_room(&outline)).map_err(|_| Occlusion::NoTarget)?;
        let count = edge::ray_count(&outline);
        self.search(&outline, bright, (0.15 * b).clamp(2.0, 6.0), count, SHARP);
        let sector = self.narrowed(sector, &outline).ok_or(Occlusion::NoTarget)?;
        self.remove_sector(&sector);
        let ellipse = ellipse_fit::fit(&mut self.edges, &outline, Start::Near(NEAR)).ok_or(Occlusion::NoTarget)?;
        let outline = ellipse.outline;
        if ellipse.occluded > HIDDEN {
            return Err(Occlusion::NoTarget);
        }
        let missing: Vec<bool> = (0..count).map(|k| self.edges.is_kept(k)).collect();
        let strength = self.strength();
        let kept = undisturbed(&self.edges, &ellipse, SHARP);
        let around =
            |blur: f64| surround::measure(&self.plane, &outline, blur, &kept, NEARBY).ok_or(Occlusion::NoTarget);
        let rough = around(SHARP)?;
        let blur = blur::of(strength, rough.contrast.abs());
        if blur > DEFOCUSED {
            return Err(Occlusion::NoTarget);
        }
        let surround = if blur > BLURRED { around(blur)? } else { rough };
        let signed = if bright { surround.contrast } else { -surround.contrast };
        let noise = self.noise(&surround);
        let blur = blur::of(strength, signed);
        let scatter = quality::expected_scatter(b, &self.levels, noise, signed, quality::steepest(blur));
        if !(signed > FAINT * noise && ellipse.rms < CLEAR * scatter) {
            return Err(Occlusion::NoTarget);
        }
        let kept = undisturbed(&self.edges, &ellipse, blur);
        let levels = DotLevels { dot: surround.level + surround.contrast, background: surround.level };
        let foreign = quick_test::unexplained(&self.plane, &outline, &missing, levels) <= UNEVEN;
        if !foreign || surround.uneven > UNEVEN || 2.0 * b < GAP_MINOR {
            return Err(Occlusion::NotMeasurable(outline));
        }
        Ok(PreliminaryTarget { ellipse, surround, kept, blur, strength, bright, refined: false })
    }

    /// The sector without which the edges scatter least, as shares of the parameter, and the ellipse through the others.
    fn sector(&mut self, start: &Outline, bright: bool) -> Option<([f64; 2], EllipseFit)> {
        let b = start.semi_axes().1;
        // which sector it is shows in a few rays
        let count = edge::ray_count(start).min(32);
        self.search(start, bright, (0.25 * b).clamp(2.0, 10.0), count, SHARP);
        let missing = self.edges.strength.iter().filter(|strength| **strength <= 0.0).count();
        if missing as f64 > (SECTORS[SECTORS.len() - 1] + SMALL_GAP) * count as f64 {
            return None;
        }
        let strengths = self.edges.strength.clone();
        let mut best: Option<(f64, [f64; 2], EllipseFit)> = None;
        for (share, from) in sectors::promising(&self.edges, start, &SECTORS) {
            let sector = [from, from + share];
            self.edges.strength.clone_from(&strengths);
            self.remove_sector(&sector);
            let Some(fit) = ellipse_fit::fit(&mut self.edges, start, Start::Rough) else { continue };
            if fit.occluded > share + SMALL_GAP {
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

    /// The part of a sector in which edges do not fit an outline that the others have; `None` if all fit.
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

    /// Removes the edges of a sector.
    fn remove_sector(&mut self, [from, to]: &[f64; 2]) {
        let count = self.edges.len();
        for k in 0..count {
            let turn = k as f64 / count as f64;
            if [turn, turn + 1.0].iter().any(|turn| (*from..*to).contains(turn)) {
                (self.edges.strength[k], self.edges.kept[k]) = (0.0, 0.0);
            }
        }
    }
}
