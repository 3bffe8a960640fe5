//! Measurement of one target: from an approximate outline to a centre with its covariance, or a rejection reason.

pub(super) mod confirm;

use super::acceptance::fit as limits;
use super::acceptance::levels::{BELIEVED, ROUNDING};
use super::acceptance::quick_test::OUTSIDE;
use super::acceptance::size::FIT_SMALL;
use super::centroid::{self, Centre};
use super::edges::blur::{self, BLURRED, DEFOCUSED, SHARP};
use super::edges::edge::{self, EdgeProfile, Edges};
use super::edges::ellipse_fit::{self, EllipseFit, Start};
use super::edges::lit::Light;
use super::edges::propagation;
use super::edges::quality;
use super::edges::quick_test;
use super::edges::surround::{self, Surround};
use super::ellipse::outline::Outline;
use super::median;
use super::picture::noise::GreyStatistics;
use super::rendered::band::{PixelRegion, Prior};
use super::rendered::fit::{self, Workspace};
use super::rendered::neighbours::Neighbours;
use crate::detection::{DetectOptions, Method, Polarity, Quality, Reason, Target};
use crate::image::{Sample, SampleView};

/// Expected corrections, in pixels, that end the approach and the fit.
const ROUGH: f64 = 2e-3;
const CONVERGED: f64 = 1e-4;

/// Half the width of the band of pixels that the rim's blur reaches.
fn half_band(blur: f64) -> f64 {
    3.6 * (blur * blur + 1.0 / 12.0).sqrt() + 0.8
}

/// What measuring needs besides the outline; scratch is reused.
pub(crate) struct Measure<'a, T> {
    pub plane: SampleView<'a, T>,
    pub levels: GreyStatistics,
    pub options: &'a DetectOptions,
    pub edges: Edges,
    pub work: Workspace,
    /// Prior values of blur and contrast, if any.
    prior: Option<Prior>,
    /// Rms of what the last fit of a rendered ellipse left, less its mean profile across the rim; 0 without one.
    pub uneven: f64,
}

/// A target as found from its edges, before the final measurement.
pub(crate) struct PreliminaryTarget {
    pub ellipse: EllipseFit,
    pub surround: Surround,
    pub kept: Vec<bool>,
    /// Blur as sigma in pixels.
    pub blur: f64,
    /// Median difference over two pixels across its edges.
    pub strength: f64,
    pub bright: bool,
    /// Whether its edges are fitted profiles rather than steepest places.
    pub refined: bool,
}

impl PreliminaryTarget {
    /// Contrast, positive where it has the sign of its polarity.
    fn signed(&self) -> f64 {
        if self.bright { self.surround.contrast } else { -self.surround.contrast }
    }

    /// Scatter of its edges by noise, for a blur.
    fn spread(&self, blur: f64) -> f64 {
        if self.refined { quality::fitted(blur) } else { quality::steepest(blur) }
    }
}

impl<'a, T: Sample> Measure<'a, T> {
    /// Nothing measured yet.
    pub fn new(plane: SampleView<'a, T>, levels: GreyStatistics, options: &'a DetectOptions) -> Self {
        Self { plane, levels, options, edges: Edges::default(), work: Workspace::default(), prior: None, uneven: 0.0 }
    }

    /// Edges on `count` rays, of a target of about this blur.
    pub(super) fn search(&mut self, outline: &Outline, bright: bool, reach: f64, count: usize, focus: f64) {
        let threshold = self.levels.step();
        let (plane, edges) = (&self.plane, &mut self.edges);
        if focus > DEFOCUSED {
            let (wide, reach) = (focus.round() as usize, reach.max(1.5 * focus));
            edge::search_wide(plane, outline, bright, reach, count, wide, threshold, edges);
        } else {
            edge::search(plane, outline, bright, reach, count, threshold, edges);
        }
    }

    /// Rough blur of a target whose edges were searched; the contrast is looked up where the blur ends.
    fn focus(&mut self, outline: &Outline, bright: bool) -> f64 {
        let strength = self.strength();
        let mut blur = SHARP;
        for _ in 0..4 {
            let contrast = quick_test::contrast(&self.plane, outline, (2.0 * blur).max(OUTSIDE));
            blur = blur::of(strength, if bright { contrast } else { -contrast });
            if blur <= DEFOCUSED {
                break;
            }
        }
        blur
    }

    /// Median difference over two pixels across the kept edges.
    pub(super) fn strength(&mut self) -> f64 {
        let Edges { strength, kept, scratch, .. } = &mut self.edges;
        let kept = strength.iter().zip(kept).filter(|(_, kept)| **kept > 0.0);
        median::of_sizes(kept.map(|(strength, _)| *strength), &mut scratch.sizes)
    }

    /// The whole annulus of an outline of about this blur.
    fn surround(&self, outline: &Outline, blur: f64, kept: &[bool]) -> Result<Surround, Reason> {
        let blur = if blur > BLURRED { blur } else { SHARP };
        surround::measure(&self.plane, outline, blur, kept, u32::MAX).ok_or(Reason::NoFit)
    }

    /// Measurement of a found target by one method.
    pub fn finish(&mut self, found: &PreliminaryTarget, method: Method) -> Result<Target, Reason> {
        let measured = self.measured(found, method);
        // without a fit, what is saturated in most of its pixels has failed for that
        if measured != Err(Reason::NoFit) || self.saturated(&found.ellipse.outline) <= limits::MOSTLY_CLIPPED {
            return measured;
        }
        // only the foot of the profile is left, where contrast and blur cannot be separated: the blur of a lens in focus decides
        let contrast = found.surround.contrast;
        self.prior = Some(Prior {
            blur: limits::IN_FOCUS,
            contrast: [contrast, limits::LOOSE * contrast.abs()],
            noise: self.noise(&found.surround),
            largest_rms: [f64::INFINITY, 0.0],
        });
        let again = self.measured(found, method);
        self.prior = None;
        again.map_err(|_| Reason::Saturated)
    }

    fn measured(&mut self, found: &PreliminaryTarget, method: Method) -> Result<Target, Reason> {
        self.work.forget();
        let mut outline = found.ellipse.outline;
        let mut surround = match method {
            Method::LeastSquares => found.surround,
            _ => self.surround(&outline, found.blur, &found.kept)?,
        };
        let (mut contrast, mut blur) = (surround.contrast.abs(), found.blur);
        let (mut fit_rms, mut occluded) = (found.ellipse.rms, found.ellipse.occluded);
        let margin = 3.0 * (blur * blur + 1.0 / 12.0).sqrt() + 0.5;
        let centre = match method {
            Method::LeastSquares => {
                let (fit, around) = self.least_squares(found)?;
                self.uneven = fit.uneven;
                surround = around;
                outline = fit.outline;
                (contrast, blur, fit_rms) = (fit.contrast.abs(), fit.blur, fit.rms);
                Centre { u: outline.u, v: outline.v, covariance: fit.covariance }
            }
            Method::Ellipse => {
                let (fit, covariance) = self.refined_ellipse(found, &surround)?;
                outline = fit.outline;
                (fit_rms, occluded) = (fit.rms, fit.occluded);
                Centre { u: outline.u, v: outline.v, covariance }
            }
            Method::Intensity => {
                let light = self.light(found, &surround);
                centroid::intensity(&self.plane, &outline, &surround, &light, margin).ok_or(Reason::NoFit)?
            }
            Method::Gradient => {
                let light = self.light(found, &surround);
                centroid::gradient(&self.plane, &outline, &surround, &light, margin).ok_or(Reason::NoFit)?
            }
        };
        let (a, b, angle) = outline.axes();
        let [uu, uv, vv] = centre.covariance;
        if ![centre.u, centre.v, uu, vv].iter().all(|x| x.is_finite()) || uu <= 0.0 || vv <= 0.0 {
            return Err(Reason::NoFit);
        }
        Ok(Target {
            id: 0,
            u: centre.u,
            v: centre.v,
            sigma_u: uu.sqrt(),
            sigma_v: vv.sqrt(),
            covariance_uv: uv,
            major: 2.0 * a,
            minor: 2.0 * b,
            angle,
            contrast,
            polarity: if found.bright { Polarity::Bright } else { Polarity::Dark },
            code: None,
            code_family: None,
            code_candidates: Vec::new(),
            inner: None,
            occluded: false,
            quality: Quality {
                fit_rms,
                noise: surround.noise,
                edge_width: blur,
                saturated: self.saturated(&outline),
                code_margin: None,
                roundness: b / a,
                occluded,
                code_note: None,
            },
        })
    }

    /// How the light changes across a disc.
    fn light(&self, found: &PreliminaryTarget, surround: &Surround) -> Light {
        let whole = found.kept.iter().all(|kept| *kept);
        Light::of(&self.plane, &found.ellipse.outline, surround, found.blur, whole, self.levels.saturation)
    }

    /// The ellipse through edges refined with the target's own levels and blur, and the covariance of its centre: the
    /// propagated noise, and as much more as the edges scatter more than it explains.
    fn refined_ellipse(
        &mut self,
        found: &PreliminaryTarget,
        surround: &Surround,
    ) -> Result<(EllipseFit, [f64; 3]), Reason> {
        let outline = found.ellipse.outline;
        let light = self.light(found, surround);
        let profile =
            EdgeProfile { light: light.slope, ..blur::profile(&outline, surround, found.strength, found.blur) };
        let count = (outline.perimeter() / 4.0).round() as usize * 4;
        edge::refine(&self.plane, &outline, &profile, count.clamp(20, 1500), &mut self.edges);
        let fit = ellipse_fit::fit(&mut self.edges, &outline, Start::Near(CONVERGED)).ok_or(Reason::NoFit)?;
        let cofactors = fit.normal.cholesky().ok_or(Reason::NoFit)?.inverse();
        let influence = propagation::influence(&outline, &profile, &self.edges, &fit.outline, &cofactors);
        let noise = surround.noise.powi(2).max(1.0 / 12.0);
        let variance = noise.max(fit.rms * fit.rms / influence.edge.max(1e-12));
        let slope = light.carried(influence.slope, influence.light);
        Ok((fit, std::array::from_fn(|i| variance * influence.noise[i] + slope[i])))
    }

    /// Noise around a target; where the annulus is not plane, the noise of the whole picture is used.
    pub(super) fn noise(&self, surround: &Surround) -> f64 {
        surround.noise.clamp(self.levels.noise, BELIEVED * self.levels.noise).max(ROUNDING * self.levels.quantum)
    }

    /// The fit of the rendered ellipse, checked against what it started from.
    ///
    /// Which pixels count depends on the outline around which they are chosen. An approach from the edges finds
    /// the outline; the fit takes its pixels around that outline, so that the way to it leaves no trace in the result.
    fn least_squares(&mut self, found: &PreliminaryTarget) -> Result<(fit::Fit, Surround), Reason> {
        let measured = self.fitted(found, f64::INFINITY, true);
        let Some(outer) = self.crowded(found, &measured) else { return measured };
        let ways = [(outer, true), (f64::INFINITY, false), (outer, false)];
        ways.into_iter().find_map(|(outer, multiplies)| self.fitted(found, outer, multiplies).ok()).map_or(measured, Ok)
    }

    /// Distance from the rim, in pixels, up to which a whole outline without a fit has background of its own, where others stand near by.
    fn crowded(&self, found: &PreliminaryTarget, measured: &Result<(fit::Fit, Surround), Reason>) -> Option<f64> {
        let failed = matches!(measured, Err(Reason::NoFit | Reason::NotAnEllipse));
        if !failed || found.ellipse.occluded > limits::WHOLE {
            return None;
        }
        let outline = &found.ellipse.outline;
        let (b, noise) = (outline.semi_axes().1, self.noise(&found.surround));
        let near = Neighbours::of(&self.plane, outline, found.blur, found.surround.contrast, b, noise)?;
        let outer = near.nearest_of_several()? - found.blur;
        (outer > limits::NARROW && outer < half_band(found.blur).min(b)).then_some(outer)
    }

    /// The fit with background up to `outer` pixels from the rim, in light that multiplies or adds.
    fn fitted(
        &mut self,
        found: &PreliminaryTarget,
        outer: f64,
        multiplies: bool,
    ) -> Result<(fit::Fit, Surround), Reason> {
        let surround = Surround { outer: outer.min(found.surround.outer), ..found.surround };
        let whole = found.kept.iter().all(|kept| *kept);
        let region = PixelRegion {
            outline: found.ellipse.outline,
            half_band: half_band(found.blur),
            surround: &surround,
            light: [0.0; 2],
            multiplies,
            kept: &found.kept,
            whole,
            saturation: self.levels.saturation,
            stairs: self.levels.stairs,
            quantum: self.levels.quantum,
            developed: self.levels.developed,
            shape: if whole { found.ellipse.rms } else { 0.0 },
            prior: self.prior,
        };
        let (plane, work) = (&self.plane, &mut self.work);
        let (outline, blur, lit) = fit::approach(plane, &region, found.blur, ROUGH, work).ok_or(Reason::NoFit)?;
        let all = vec![true; edge::ray_count(&outline)];
        let kept = if whole { &all } else { &found.kept };
        let mut surround = self.surround(&outline, blur, kept)?;
        (surround.contrast, surround.outer) = (lit.contrast, outer.min(surround.outer));
        let light = lit.light();
        let last = PixelRegion { outline, half_band: half_band(blur), surround: &surround, light, kept, ..region };
        let mut fit = fit::fit(&self.plane, &last, blur, CONVERGED, &mut self.work).ok_or(Reason::NoFit)?;
        let b = fit.outline.semi_axes().1;
        let gap = b - 2.0 * fit.blur;
        if !self.explains(found, &fit) && gap > limits::NARROW && found.ellipse.occluded < limits::WHOLE {
            // a code ring, perhaps, as near as the rim is to the centre: only the gap is the target's background
            let narrow = Surround { outer: gap.min(surround.outer), ..surround };
            let last = PixelRegion { surround: &narrow, ..last };
            fit = fit::fit(&self.plane, &last, blur, CONVERGED, &mut self.work).ok_or(Reason::NoFit)?;
        }
        let (a, b) = fit.outline.semi_axes();
        let contrast = if found.bright { fit.contrast } else { -fit.contrast };
        if contrast <= 0.0 {
            return Err(Reason::NoFit);
        }
        if b < self.options.min_axis_ratio * a {
            return Err(Reason::TooFlat);
        }
        if 2.0 * b < FIT_SMALL * self.options.min_diameter {
            return Err(Reason::TooSmall);
        }
        if self.explains(found, &fit) { Ok((fit, surround)) } else { Err(Reason::NotAnEllipse) }
    }

    /// Whether two grey levels and a blur describe the rim, whatever the lens adds.
    fn explains(&self, found: &PreliminaryTarget, fit: &fit::Fit) -> bool {
        let (noise, contrast) = (self.noise(&found.surround), fit.contrast.abs());
        let profile = if self.levels.stairs { limits::RMS_STAIRS } else { limits::RMS_PROFILE };
        fit.disturbed <= limits::DISTURBED
            && fit.rms <= limits::RMS_NOISE * noise + profile * contrast
            && quality::is_target(&found.ellipse, &self.levels, fit.uneven, noise, contrast, found.spread(fit.blur))
    }

    /// Share of the pixels inside the outline that are at the end of the scale.
    pub(super) fn saturated(&self, outline: &Outline) -> f64 {
        let half_v = outline.half_box().1;
        let (mut inside, mut clipped) = (0u32, 0u32);
        let rows = (outline.v - half_v).max(0.0) as usize..((outline.v + half_v) as usize + 1).min(self.plane.height);
        for y in rows {
            let Some((from, to)) = outline.chord(y as f64 + 0.5) else { continue };
            let (from, to) = ((from + 0.5).max(0.0) as usize, ((to + 0.5).max(0.0) as usize).min(self.plane.width));
            for sample in self.plane.row(y).get(from..to).unwrap_or_default() {
                inside += 1;
                clipped += u32::from(f64::from(sample.level()) >= self.levels.saturation);
            }
        }
        f64::from(clipped) / f64::from(inside.max(1))
    }
}
