//! Small and faint targets of ordinary photos, detected by comparison with the photo's other targets.
//!
//! Compression and sharpening scatter edges by more than the noise of flat paper says, and a disc that is not much wider than its
//! blur has no outline of its own. But a photo's targets are alike: the large ones tell the blur of the picture, the contrast of
//! the print and what the model leaves unexplained at a rim. With these a rendered ellipse is fitted wherever something
//! stands out, and it is a target when it fits as well as they do. Without enough of them nothing is decided here.
//!
//! Blur and contrast enter the fit as observations with the spread that they have among the known targets. They hold the shape
//! of a disc that its blur has swallowed; its centre is uncorrelated with them.

use super::acceptance::{levels::ROUNDING, size::FIT_SMALL, small_targets as limits};
use super::adaptive_moments::{self, AdaptiveMoments};
use super::code::may_be_in_ring;
use super::edges::surround::{self, Glance};
use super::ellipse::outline::Outline;
use super::measure::Measure;
use super::picture::noise::GreyStatistics;
use super::rendered::band::{PixelRegion, Prior};
use super::rendered::fit::{self, Fit};
use crate::detection::{Method, Polarity, Quality, Reason, Target};
use crate::image::{Sample, SampleView};

/// Half the width, in units of the blur, of the band of pixels that are fitted: beyond it the light of neighbours is more than what
/// is left of the rim's own.
const BAND: f64 = 2.4;
/// Part of the blur beyond which the level around is taken.
const APART: f64 = 0.7;
/// Half the width, at half its height, of a Gaussian of standard deviation 1.
const HALF: f64 = 1.18;
/// Maximum number of known targets that are measured again.
pub(crate) const MEASURED: usize = 40;
/// Corrections in pixels that end the fit.
const CONVERGED: f64 = 1e-3;

/// Which background a disc is measured on: what lies around it, or only the gap before a ring.
#[derive(Clone, Copy, PartialEq)]
enum Ground {
    Wide,
    Gap,
}

/// Shape to be tested at an outline: a disc; a disc in a ring, by the gap alone or by all that lies around it too.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum ExpectedShape {
    Disc,
    InRing,
    InRingOrWide,
}

/// Common properties of a picture's known targets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CommonProperties {
    pub bright: bool,
    /// Median blur as sigma in pixels, and its spread.
    blur: [f64; 2],
    /// Median contrast and its spread.
    contrast: [f64; 2],
    /// Median rms of what the fits leave.
    rms: f64,
}

fn median_and_spread(mut values: Vec<f64>) -> [f64; 2] {
    let middle = |values: &mut Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let median = middle(&mut values);
    let mut apart: Vec<f64> = values.iter().map(|value| (value - median).abs()).collect();
    [median, 1.4826 * middle(&mut apart)]
}

impl CommonProperties {
    /// Of targets of one picture, as measured there; `None` if they are few or differ too much.
    pub fn of<'a>(targets: impl Iterator<Item = &'a Target>, noise: f64) -> Option<Self> {
        let (bright, dark): (Vec<&Target>, Vec<&Target>) =
            targets.partition(|target| target.polarity == Polarity::Bright);
        let (targets, bright) = if bright.len() > dark.len() { (bright, true) } else { (dark, false) };
        // those whose blur does not hide their contrast
        let plain: Vec<&Target> =
            targets.into_iter().filter(|t| t.minor > limits::PLAIN_MINOR * t.quality.edge_width).collect();
        if plain.len() < limits::ENOUGH {
            return None;
        }
        let of = |value: fn(&Target) -> f64| median_and_spread(plain.iter().map(|target| value(target)).collect());
        let [blur, blurs] = of(|target| target.quality.edge_width);
        let [contrast, shades] = of(|target| target.contrast);
        let [rms, _] = of(|target| target.quality.fit_rms);
        Some(Self {
            bright,
            blur: [blur, blurs.max(limits::BLURS * blur)],
            contrast: [contrast, shades.max(limits::SHADES * contrast)],
            rms: rms.max(noise),
        })
    }

    /// Whether a picture that nothing was done to is so blurred that its small discs have no outlines.
    pub fn swallows(&self) -> bool {
        self.blur[0] > limits::SWALLOWING
    }

    /// Share of its contrast that a disc of these semi-axes shows in its middle.
    fn seen(&self, a: f64, b: f64) -> f64 {
        1.0 - (-0.5 * a * b / self.blur[0].powi(2)).exp()
    }

    /// Contrast from which something of this outline may be like the others.
    fn least_contrast(&self, outline: &Outline) -> f64 {
        let (a, b) = outline.semi_axes();
        limits::LIGHT * self.seen(a, b) * self.contrast[0] / limits::CONTRASTS
    }

    /// Whether what has this outline stands out from all that lies around it: most blobs have the other polarity, or are only a part of a
    /// larger shape.
    fn stands_alone<T: Sample>(&self, plane: &SampleView<T>, outline: &Outline) -> Result<(), Reason> {
        let glance = surround::glance(plane, outline, APART * self.blur[0], self.bright);
        let Some(Glance { contrast, joined }) = glance else { return Ok(()) };
        if contrast < self.least_contrast(outline) {
            return Err(Reason::LowContrast);
        }
        match joined.iter().zip(limits::JOINED).any(|(joined, most)| *joined > most) {
            true => Err(Reason::Touching),
            false => Ok(()),
        }
    }

    /// The same of a blob in a picture of half the size, whose blur has this variance more than that of what is known, in pixels of the whole one.
    pub fn stands_alone_halved<T: Sample>(&self, plane: &SampleView<T>, seen: &Outline, more: f64) -> bool {
        let blur = self.blur.map(|blur| blur / 2.0);
        let halved = Self { blur: [(blur[0] * blur[0] + more / 4.0).sqrt(), blur[1]], ..*self };
        let seen = Outline { u: seen.u / 2.0, v: seen.v / 2.0, ..seen.scaled(0.5) };
        seen.is_proper() && halved.stands_alone(plane, &halved.within(&seen)).is_ok()
    }

    /// A first outline of a blob with this outline: blur makes small discs look larger.
    fn within(&self, outline: &Outline) -> Outline {
        let (a, b, angle) = outline.axes();
        let own = |seen: f64| {
            let square = (seen / HALF).powi(2) - self.blur[0].powi(2);
            seen.min(2.0 * square.max((0.3 * self.blur[0]).powi(2)).sqrt())
        };
        let [a, b] = [own(a), own(b)];
        Outline::from_axes(outline.u, outline.v, a, b.max(0.4 * a), angle)
    }
}

/// Maximum distance of a target's centre from its blob, pixels.
fn farthest(seen: &Outline) -> f64 {
    limits::MOVED[0] + limits::MOVED[1] * seen.semi_axes().1
}

impl<T: Sample> Measure<'_, T> {
    /// The target at a place where something of this outline stands out, as far as it is like the others.
    pub fn small_target(
        &mut self,
        seen: &Outline,
        common: &CommonProperties,
        wanted: ExpectedShape,
    ) -> Result<Target, Reason> {
        match wanted {
            ExpectedShape::Disc => self.disc(seen, common),
            ExpectedShape::InRing | ExpectedShape::InRingOrWide => self.in_ring(seen, common, wanted),
        }
    }

    /// A disc on what lies around it. Noise and what lies nearby pull the outline of a few rows out of shape: where the fit does not find
    /// back, it starts again from the adaptive moments of the blob, but not where it promised nothing (of 55 targets that these found in sixty
    /// random cameras of `photos` one).
    fn disc(&mut self, seen: &Outline, common: &CommonProperties) -> Result<Target, Reason> {
        let size = self.plane.width.max(self.plane.height) as f64;
        if !seen.is_proper() || seen.semi_axes().0 > size {
            return Err(Reason::NotAnEllipse);
        }
        match self.fitted_from(seen, common, Ground::Wide) {
            Err(Reason::NoFit | Reason::NotAnEllipse) if !self.work.hopeless => {
                self.moments_outline(seen, common).and_then(|seen| self.fitted_from(&seen, common, Ground::Wide))
            }
            found => found,
        }
    }

    /// The same where a ring may stand around, of what is small and has no other background than the gap before it: that there is a ring is
    /// for its code to show.
    fn in_ring(&mut self, seen: &Outline, common: &CommonProperties, wanted: ExpectedShape) -> Result<Target, Reason> {
        if !seen.is_proper() {
            return Err(Reason::NotAnEllipse);
        }
        let outline = common.within(seen);
        let least = common.least_contrast(&outline);
        if outline.semi_axes().1 > limits::LARGEST * common.blur[0]
            || !may_be_in_ring(&self.plane, &outline, common.bright, least)
        {
            return Err(Reason::LowContrast);
        }
        match wanted {
            ExpectedShape::InRing => self.fitted_from(seen, common, Ground::Gap),
            _ => self
                .disc(seen, common)
                .or_else(|reason| self.fitted_from(seen, common, Ground::Gap).map_err(|_| reason)),
        }
    }

    /// The adaptive moments at what was seen, as the outline of half the height.
    fn moments_outline(&self, seen: &Outline, common: &CommonProperties) -> Result<Outline, Reason> {
        let outline = common.within(seen);
        let kept = vec![true; super::edges::edge::ray_count(&outline)];
        let ground = self.level_around(&outline, common, &kept)?;
        let farthest = seen.semi_axes().0.max(common.blur[0]);
        adaptive_moments::measure(&self.plane, [seen.u, seen.v], &ground, common.bright, common.blur[0], farthest)
            .map(|AdaptiveMoments { u, v, covariance: [uu, uv, vv] }| {
                let [uu, uv, vv] = [uu, uv, vv].map(|moment| HALF * HALF * moment);
                Outline::of_matrix(u, v, uu, uv, vv)
            })
            .ok_or(Reason::NoFit)
    }

    /// The same from one outline, on one background.
    fn fitted_from(&mut self, seen: &Outline, common: &CommonProperties, ground: Ground) -> Result<Target, Reason> {
        let mut outline = common.within(seen);
        self.has_room(&outline)?;
        let sign = if common.bright { 1.0 } else { -1.0 };
        let least = common.least_contrast(&outline);
        if ground == Ground::Wide {
            common.stands_alone(&self.plane, &outline)?;
        }
        let mut kept = vec![true; super::edges::edge::ray_count(&outline)];
        let mut around = self.level_on(ground, &outline, common, &kept)?;
        if sign * around.contrast < least {
            return Err(Reason::LowContrast);
        }
        let prior = Prior {
            blur: common.blur,
            contrast: [sign * common.contrast[0], common.contrast[1]],
            noise: common.rms,
            largest_rms: [limits::AS_GOOD * common.rms, limits::PROFILE].map(|part| limits::HOPELESS * part),
        };
        let mut found: Option<Fit> = None;
        // the second time with the pixels of the outline that the first one has found
        for _ in 0..2 {
            around.contrast = sign * common.contrast[0];
            let region = PixelRegion {
                outline,
                half_band: BAND * common.blur[0] + 1.0,
                surround: &around,
                light: [0.0; 2],
                multiplies: true,
                kept: &kept,
                whole: true,
                saturation: self.levels.saturation,
                stairs: false,
                quantum: self.levels.quantum,
                developed: self.levels.developed,
                shape: 0.0,
                prior: Some(prior),
            };
            let fit = fit::fit(&self.plane, &region, common.blur[0], CONVERGED, &mut self.work).ok_or(Reason::NoFit)?;
            outline = fit.outline;
            found = Some(fit);
            if !outline.is_proper() {
                return Err(Reason::AtBorder);
            }
            self.has_room(&outline)?;
            if (outline.u - seen.u).hypot(outline.v - seen.v) > 2.0 * farthest(seen) {
                return Err(Reason::NotAnEllipse);
            }
            kept = vec![true; super::edges::edge::ray_count(&outline)];
            around = self.level_on(ground, &outline, common, &kept)?;
        }
        let fit = found.ok_or(Reason::NoFit)?;
        self.judge(seen, &fit, common)?;
        let (a, b, angle) = outline.axes();
        let [uu, uv, vv] = fit.covariance;
        Ok(Target {
            id: 0,
            u: outline.u,
            v: outline.v,
            sigma_u: uu.sqrt(),
            sigma_v: vv.sqrt(),
            covariance_uv: uv,
            major: 2.0 * a,
            minor: 2.0 * b,
            angle,
            contrast: fit.contrast.abs(),
            polarity: if common.bright { Polarity::Bright } else { Polarity::Dark },
            code: None,
            code_family: None,
            code_candidates: Vec::new(),
            inner: None,
            occluded: false,
            quality: Quality {
                fit_rms: fit.rms,
                noise: around.noise,
                edge_width: fit.blur,
                saturated: self.saturated(&outline),
                code_margin: None,
                roundness: b / a,
                occluded: 0.0,
                code_note: None,
            },
        })
    }

    /// Whether a fit is a target like the others.
    fn judge(&self, seen: &Outline, fit: &Fit, common: &CommonProperties) -> Result<(), Reason> {
        let (a, b) = fit.outline.semi_axes();
        let contrast = if common.bright { fit.contrast } else { -fit.contrast };
        if 2.0 * b < FIT_SMALL * self.options.min_diameter {
            return Err(Reason::TooSmall);
        }
        if 2.0 * a > self.options.max_diameter {
            return Err(Reason::TooLarge);
        }
        if b < self.options.min_axis_ratio * a {
            return Err(Reason::TooFlat);
        }
        let peak = common.seen(a, b) * contrast;
        if !(common.contrast[0] / limits::CONTRASTS..common.contrast[0] * limits::CONTRASTS).contains(&contrast) {
            return Err(Reason::LowContrast);
        }
        let moved = (fit.outline.u - seen.u).hypot(fit.outline.v - seen.v);
        let good = fit.rms <= limits::AS_GOOD * common.rms + limits::PROFILE * peak
            && fit.disturbed <= limits::DISTURBED
            && moved <= farthest(seen);
        if good { Ok(()) } else { Err(Reason::NotAnEllipse) }
    }

    fn level_on(
        &self,
        ground: Ground,
        outline: &Outline,
        common: &CommonProperties,
        kept: &[bool],
    ) -> Result<surround::Surround, Reason> {
        match ground {
            Ground::Wide => self.level_around(outline, common, kept),
            Ground::Gap => self.level_in_gap(outline, common),
        }
    }

    /// The background between a disc and the ring around it, which begins a radius beyond the rim.
    fn level_in_gap(&self, outline: &Outline, common: &CommonProperties) -> Result<surround::Surround, Reason> {
        let (b, blur) = (outline.semi_axes().1, common.blur[0]);
        if b < limits::GAP * blur {
            return Err(Reason::Touching);
        }
        let outer = b - limits::RING_APART * blur;
        let [level, lacking] = surround::in_gap(&self.plane, outline, outer, common.bright).ok_or(Reason::AtBorder)?;
        if lacking > limits::GAP_LACKS {
            return Err(Reason::Touching);
        }
        let contrast = f64::from(self.plane.nearest(outline.u, outline.v)) - level;
        Ok(surround::Surround {
            level,
            slope: [0.0; 2],
            slope_covariance: [0.0; 3],
            noise: self.levels.noise,
            contrast,
            uneven: 0.0,
            outer,
        })
    }

    fn level_around(
        &self,
        outline: &Outline,
        common: &CommonProperties,
        kept: &[bool],
    ) -> Result<surround::Surround, Reason> {
        surround::measure(&self.plane, outline, APART * common.blur[0], kept, u32::MAX).ok_or(Reason::AtBorder)
    }
}

/// How many times the noise of its flat background the rims of a picture have, as denoising in a camera leaves it; `uneven` is what the fits of
/// its targets leave, each less its mean profile across the rim. 1 where targets are few.
pub(crate) fn rim_noise(uneven: Vec<f64>, levels: &GreyStatistics) -> f64 {
    let ground = levels.noise.max(ROUNDING * levels.quantum);
    if uneven.len() < limits::ENOUGH { 1.0 } else { median_and_spread(uneven)[0] / ground }
}

/// Leaves out of what only a softened picture shows what is much fainter than nearly all targets of its kind that are known without
/// it: what a mean makes round, like the counters of letters.
pub(crate) fn drop_faint(found: &mut Vec<Target>, known: &[Target]) {
    for polarity in [Polarity::Bright, Polarity::Dark] {
        let of_kind = known.iter().filter(|target| target.polarity == polarity);
        let mut contrasts: Vec<f64> = of_kind.map(|target| target.contrast).collect();
        if contrasts.len() < limits::ENOUGH {
            continue;
        }
        contrasts.sort_by(f64::total_cmp);
        let faintest = contrasts[contrasts.len() / limits::FAINTEST] / limits::CONTRASTS;
        found.retain(|target| target.polarity != polarity || target.contrast >= faintest);
    }
}

/// What the targets of a picture have in common. Only the fit of a rendered ellipse has a model to compare with.
pub(crate) fn of<T: Sample>(measure: &Measure<T>, found: &[Target]) -> Option<CommonProperties> {
    let has_model = measure.options.method == Method::LeastSquares;
    has_model.then(|| CommonProperties::of(found.iter(), measure.levels.noise)).flatten()
}
