//! From an approximate outline to a confirmed target by its edges: a sequence of tests, cheap ones first.

use super::{Measure, PreliminaryTarget};
use crate::detect::acceptance::levels::{CONTRAST, DISTURBED, FAINT, STROKE, UNEVEN};
use crate::detect::acceptance::outline as limits;
use crate::detect::acceptance::quick_test::{MISSING_WHOLE, OPEN_MEASURED};
use crate::detect::acceptance::size::{EDGES_SMALL, ROOM};
use crate::detect::edges::blur::{self, BLURRED, DEFOCUSED, SHARP, SOFT};
use crate::detect::edges::edge::{self, Edges};
use crate::detect::edges::ellipse_fit::{self, EllipseFit, Start};
use crate::detect::edges::quality;
use crate::detect::edges::quick_test::{self, DotLevels};
use crate::detect::edges::surround;
use crate::detect::ellipse::outline::Outline;
use crate::detection::Reason;
use crate::image::Sample;

/// Rings of a first pass over the annulus.
pub(in crate::detect) const NEARBY: u32 = 6;

/// Correction, in pixels, that ends the refinement of an ellipse that only starts the final measurement.
pub(in crate::detect) const NEAR: f64 = 0.005;

/// Which rays count: a single edge out of place is chance, more in a row are something on the rim. Its own edge is as blurred as the
/// target's: beside it the rim is left out as far as that blur reaches.
pub(in crate::detect) fn undisturbed(edges: &Edges, outline: &Outline, blur: f64) -> Vec<bool> {
    let count = edges.len();
    let kept = |k: usize| edges.is_kept(k % count);
    let good: Vec<bool> = (0..count).map(|k| kept(k) || kept(k + 1) && kept(k + count - 1)).collect();
    let is_disturbed = |k: &usize| (0..limits::DISTURBED).all(|i| !good[(k + i) % count]);
    let margin = (((2.0 * blur + 1.0) * count as f64 / outline.perimeter()).ceil() as usize).min(count);
    let mut all = good.clone();
    for k in (0..count).filter(is_disturbed) {
        for i in 0..limits::DISTURBED + 2 * margin {
            all[(k + count + i - margin) % count] = false;
        }
    }
    all
}

/// Rms of edge points from an outline of semi-minor axis b beyond which it is none, in pixels.
fn largest_rms(b: f64) -> f64 {
    limits::RMS[0] + limits::RMS[1] * b
}

/// Gate: edges lie on an ellipse, all around; out of focus they are judged once they are refined.
fn is_ellipse(ellipse: &EllipseFit, focus: f64) -> Result<(), Reason> {
    let scattered = ellipse.rms > largest_rms(ellipse.outline.semi_axes().1) && focus <= SOFT;
    if scattered || !quality::is_whole(ellipse) { Err(Reason::NotAnEllipse) } else { Ok(()) }
}

impl<T: Sample> Measure<'_, T> {
    /// Edges, ellipse and annulus of a target that has passed its first look, whose outline is known to a fraction of its size.
    pub(in crate::detect) fn confirm(&mut self, start: &Outline, bright: bool) -> Result<PreliminaryTarget, Reason> {
        let (ellipse, focus) = self.followed(start, bright)?;
        self.size_allows(&ellipse.outline)?;
        self.has_room(&ellipse.outline)?;
        is_ellipse(&ellipse, focus)?;
        let mut found = self.surrounded(ellipse, bright, focus)?;
        self.has_contrast(&found)?;
        // how far edges may scatter at most is that of the outline before they are refined
        let largest = largest_rms(found.ellipse.outline.semi_axes().1);
        if found.blur > SOFT && (focus <= DEFOCUSED || !self.is_good(&found, largest)) {
            // the steepest places of a soft edge scatter, its whole profile does not, unless it is that of a small blot
            self.refine(&mut found)?;
        }
        if found.surround.uneven > UNEVEN || !self.is_good(&found, largest) {
            return Err(Reason::NotAnEllipse);
        }
        self.is_no_letter(&found)?;
        Ok(found)
    }

    /// The ellipse through the edges in two rounds, and about how blurred they are.
    fn followed(&mut self, start: &Outline, bright: bool) -> Result<(EllipseFit, f64), Reason> {
        let mut outline = *start;
        let mut fitted: Option<EllipseFit> = None;
        let mut focus = SHARP;
        for round in 0..2 {
            let (a, b) = outline.semi_axes();
            if !outline.is_proper() || a > self.plane.width.max(self.plane.height) as f64 {
                return Err(Reason::NotAnEllipse);
            }
            let reach = if round == 0 { (0.3 * b).clamp(2.0, 12.0) } else { (0.15 * b).clamp(2.0, 6.0) };
            // most of what is no target shows in a few rays
            let count = edge::ray_count(&outline);
            let count = if round == 0 { count.min(32) } else { count };
            // edges that were all found, and met almost head on, are the same seen from the better outline
            let again = fitted.is_some_and(|found| found.occluded == 0.0 && outline.differs(start) <= limits::HEAD_ON);
            if !again {
                self.search(&outline, bright, reach, count, focus);
            }
            if round == 0 {
                focus = self.focus(&outline, bright);
                if focus > DEFOCUSED {
                    self.search(&outline, bright, reach, count, focus);
                }
            }
            let from = if round == 0 { Start::Rough } else { Start::Near(NEAR) };
            let found = ellipse_fit::fit(&mut self.edges, &outline, from).ok_or(Reason::NotAnEllipse)?;
            outline = found.outline;
            self.follows(&found, b, focus, round == 0)?;
            if round == 0 {
                self.may_be_target(&found, bright)?;
            }
            fitted = Some(found);
        }
        Ok((fitted.ok_or(Reason::NotAnEllipse)?, focus))
    }

    /// Gate: the edges scatter about as they may, of an outline that was searched with semi-minor axis b.
    fn follows(&mut self, found: &EllipseFit, b: f64, focus: f64, first: bool) -> Result<(), Reason> {
        // out of focus, two pixels see but 0.8 / s of the contrast
        let contrast = self.strength() * if focus > DEFOCUSED { 1.25 * focus } else { 1.0 };
        let spread = quality::steepest(blur::rough(focus));
        let scatter = quality::expected_scatter(b, &self.levels, self.levels.noise, contrast, spread);
        let rough = if first && b < limits::SMALL { limits::SCATTER_SMALL } else { 0.0 };
        if found.rms > limits::SCATTER_FLOOR + rough + limits::SCATTER_FIRST * scatter {
            return Err(Reason::NotAnEllipse);
        }
        Ok(())
    }

    /// Gate after the first round: what the second one decides, with room for what it may change.
    fn may_be_target(&self, found: &EllipseFit, bright: bool) -> Result<(), Reason> {
        if !quality::may_be_whole(found) {
            return Err(Reason::NotAnEllipse);
        }
        quick_test::stands_out(&self.plane, &self.levels, &found.outline, bright, MISSING_WHOLE, OPEN_MEASURED)
    }

    /// Gate: it is as round and as large as it is asked to be.
    pub(in crate::detect) fn size_allows(&self, outline: &Outline) -> Result<(), Reason> {
        let (a, b) = outline.semi_axes();
        if b < self.options.min_axis_ratio * a {
            return Err(Reason::TooFlat);
        }
        if 2.0 * b < EDGES_SMALL * self.options.min_diameter {
            return Err(Reason::TooSmall);
        }
        if 2.0 * a > self.options.max_diameter {
            return Err(Reason::TooLarge);
        }
        Ok(())
    }

    /// Gate: all of it lies in the picture.
    pub(in crate::detect) fn has_room(&self, outline: &Outline) -> Result<(), Reason> {
        let (half_u, half_v) = outline.half_box();
        let inside = outline.u - half_u >= ROOM
            && outline.v - half_v >= ROOM
            && outline.u + half_u <= self.plane.width as f64 - ROOM
            && outline.v + half_v <= self.plane.height as f64 - ROOM;
        if inside { Ok(()) } else { Err(Reason::AtBorder) }
    }

    /// The ellipse with what lies around it and its blur.
    fn surrounded(&mut self, ellipse: EllipseFit, bright: bool, focus: f64) -> Result<PreliminaryTarget, Reason> {
        let outline = ellipse.outline;
        let kept = undisturbed(&self.edges, &outline, blur::rough(focus));
        let strength = self.strength();
        let around = |blur: f64| surround::measure(&self.plane, &outline, blur, &kept, NEARBY).ok_or(Reason::AtBorder);
        let rough = around(blur::rough(focus))?;
        let blur = blur::of(strength, rough.contrast.abs());
        let surround = if blur > BLURRED { around(blur)? } else { rough };
        let mut found = PreliminaryTarget { ellipse, surround, kept, blur, strength, bright, refined: false };
        found.blur = blur::of(strength, found.signed());
        Ok(found)
    }

    /// Gate: contrast stands out of the noise, with pixels enough to show a shape.
    fn has_contrast(&self, found: &PreliminaryTarget) -> Result<(), Reason> {
        let noise = found.surround.noise.min(DISTURBED[0] * self.levels.noise + DISTURBED[1]);
        let enough = found.signed() >= (CONTRAST * noise).max(self.levels.step());
        if enough && quality::has_shape(&found.ellipse, self.noise(&found.surround), found.signed()) {
            Ok(())
        } else {
            Err(Reason::LowContrast)
        }
    }

    /// Whether the edges scatter no more than those of a target of this noise and blur, and no more than `largest`.
    fn is_good(&self, found: &PreliminaryTarget, largest: f64) -> bool {
        let (noise, spread) = (self.noise(&found.surround), found.spread(found.blur));
        found.ellipse.rms <= largest
            && quality::outline_allows(&found.ellipse, &self.levels, noise, found.signed(), spread)
    }

    /// Edges as fitted profiles, and the ellipse through them.
    fn refine(&mut self, found: &mut PreliminaryTarget) -> Result<(), Reason> {
        let outline = found.ellipse.outline;
        let (count, profile) = (self.edges.len(), blur::profile(&outline, &found.surround, found.strength, found.blur));
        edge::refine(&self.plane, &outline, &profile, count, &mut self.edges);
        found.ellipse = ellipse_fit::fit(&mut self.edges, &outline, Start::Near(NEAR)).ok_or(Reason::NotAnEllipse)?;
        found.kept = undisturbed(&self.edges, &found.ellipse.outline, found.blur);
        found.refined = true;
        Ok(())
    }

    /// Gate: no stroke of its level around a faint one.
    fn is_no_letter(&self, found: &PreliminaryTarget) -> Result<(), Reason> {
        let PreliminaryTarget { ellipse, surround, .. } = found;
        let levels = DotLevels { dot: surround.level + surround.contrast, background: surround.level };
        let faint = found.signed() < FAINT * self.noise(surround);
        if faint && quick_test::stroke(&self.plane, &ellipse.outline, levels) > STROKE {
            return Err(Reason::NotAnEllipse);
        }
        Ok(())
    }
}
