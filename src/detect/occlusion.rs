//! Partly occluded targets: up to a fifth of the diameter.
//!
//! An occluder draws the edges of its side inwards, and an ellipse through all edges gives way to it by a few tenths of a pixel:
//! neither the outline nor its scatter shows what is wrong, only the fit of the picture does. So the ellipse is laid through
//! the edges outside of every sector in turn, and the one that leaves the least scatter says which sector is occluded. That ellipse is
//! reported as an occluded target: no fit of the picture is better, since nothing tells the light of what lies before the rim.

use super::acceptance::levels::FAINT;
use super::acceptance::occlusion::{CLEAR, EVEN, PULLED, SECTORS};
use super::acceptance::outline as limits;
use super::acceptance::outline::{HIDDEN, SMALL_GAP};
use super::acceptance::partial::SMALLEST;
use super::acceptance::quick_test::OCCLUDED;
use super::edges::blur::{self, BLURRED, DEFOCUSED, SHARP};
use super::edges::edge;
use super::edges::ellipse_fit::{self, EllipseFit, Start};
use super::edges::quality;
use super::edges::quick_test;
use super::edges::sectors;
use super::edges::surround;
use super::ellipse::outline::Outline;
use super::measure::confirm::{NEAR, NEARBY, undisturbed};
use super::measure::{Measure, PreliminaryTarget};
use crate::detection::{Polarity, Quality, Target};
use crate::image::Sample;

impl<T: Sample> Measure<'_, T> {
    /// A target with one occluded sector: the ellipse through its other edges; `None` if there is none.
    pub fn occluded_target(&mut self, start: &Outline, bright: bool) -> Option<Target> {
        let (a, b) = start.semi_axes();
        let large = a < self.plane.width.min(self.plane.height) as f64;
        if !start.is_proper() || !large || 2.0 * b < SMALLEST {
            return None;
        }
        quick_test::stands_out(&self.plane, &self.levels, start, bright, OCCLUDED, OCCLUDED).ok()?;
        let (sector, rough) = self.sector(start, bright)?;
        let outline = rough.outline;
        let b = outline.semi_axes().1;
        self.size_allows(&outline).and_then(|()| self.has_room(&outline)).ok()?;
        self.search(&outline, bright, (0.15 * b).clamp(2.0, 6.0), edge::ray_count(&outline), SHARP);
        self.remove_sector(&sector);
        let ellipse = ellipse_fit::fit(&mut self.edges, &outline, Start::Near(NEAR))?;
        let outline = ellipse.outline;
        if ellipse.occluded > HIDDEN {
            return None;
        }
        let strength = self.strength();
        let kept = undisturbed(&self.edges, &outline, SHARP);
        let around = |blur: f64| surround::measure(&self.plane, &outline, blur, &kept, NEARBY);
        let rough = around(SHARP)?;
        let blur = blur::of(strength, rough.contrast.abs());
        if blur > DEFOCUSED {
            return None;
        }
        let surround = if blur > BLURRED { around(blur)? } else { rough };
        let signed = if bright { surround.contrast } else { -surround.contrast };
        let noise = self.noise(&surround);
        let blur = blur::of(strength, signed);
        let scatter = quality::expected_scatter(b, &self.levels, noise, signed, quality::steepest(blur));
        // texture around is no background to see a part of a rim against
        if !(signed > FAINT * noise.max(surround.noise) && ellipse.rms < CLEAR * scatter) {
            return None;
        }
        self.by_its_edges(&PreliminaryTarget { ellipse, surround, kept, blur, strength, bright, refined: false })
    }

    /// The target as its edges show it.
    fn by_its_edges(&self, found: &PreliminaryTarget) -> Option<Target> {
        let (ellipse, outline) = (&found.ellipse, &found.ellipse.outline);
        let (a, b, angle) = outline.axes();
        let scatter = ellipse.rms.max(limits::TOLERANCE / limits::SIGMAS).powi(2);
        let cofactors = ellipse.normal.cholesky()?.inverse();
        // an occluder's light on the edges beside it moves them all to one side, of which their scatter shows nothing
        let sigma = |i: usize| (scatter * cofactors[(i, i)] + PULLED * PULLED).sqrt();
        Some(Target {
            id: 0,
            u: outline.u,
            v: outline.v,
            sigma_u: sigma(0),
            sigma_v: sigma(1),
            covariance_uv: scatter * cofactors[(0, 1)],
            major: 2.0 * a,
            minor: 2.0 * b,
            angle,
            contrast: found.surround.contrast.abs(),
            polarity: if found.bright { Polarity::Bright } else { Polarity::Dark },
            code: None,
            code_family: None,
            code_candidates: Vec::new(),
            inner: None,
            occluded: true,
            quality: Quality {
                fit_rms: ellipse.rms,
                noise: found.surround.noise,
                edge_width: found.blur,
                saturated: self.saturated(outline),
                roundness: b / a,
                occluded: ellipse.occluded,
                ..Quality::default()
            },
        })
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
