//! Detection on sensor samples (RAW).
//!
//! They are searched in a grey picture made from the sites of one colour ([`plane`]), with the whole of the detection for ordinary
//! pictures, and measured on these sites alone: no sample is interpolated, every one has its own place and its own standard error
//! ([`noise`]), and saturated samples are used only as lower bounds ([`fit`]). What red or blue, with a quarter of the sites each, is too
//! coarse to be searched for is searched in green too, and measured on the sites asked for.

mod codes;
mod curve;
mod fit;
mod noise;
mod plane;

use super::ellipse::outline::Outline;
use super::rendered::Field;
use super::rendered::neighbours::Neighbours;
use super::rims;
use super::window::Window;
use super::{check_place, code::outline_of, detect_photo, edges::edge, edges::surround, measure_in_photo};
use crate::decode::DecodedPhoto;
use crate::detection::{
    Channel, Colour, DetectOptions, Detection, InnerRim, MeasuredOn, Method, Polarity, Reason, Rejected, SampleSource,
    Target,
};
use crate::error::{Error, Place, Reason as Wrong, Result};
use crate::image::{Grey, SampleView, Samples};
use crate::sensor::{Sensor, measured_colour};
use curve::Curve;
use fit::SiteFit;
use noise::NoiseModel;

/// Pixels beside a target and what is examined around it.
const BESIDE: f64 = 32.0;

/// The sites of one colour, with all that a fit needs to know of them.
pub(crate) struct Sites<'a> {
    sensor: &'a Sensor,
    colour: Colour,
    noise: NoiseModel,
    /// Sample from which one is saturated, black not taken off.
    clip: f64,
    /// Left, top, right and bottom of the part that light reaches.
    lit: [usize; 4],
}

impl<'a> Sites<'a> {
    fn of(sensor: &'a Sensor, options: &DetectOptions) -> Self {
        let colour = measured_colour(&sensor.mosaic, options.channel);
        let [left, top, width, height] = sensor.mosaic.active_area.map(|side| side as usize);
        let mut sites = Self {
            sensor,
            colour,
            noise: NoiseModel::default(),
            clip: sensor.mosaic.white,
            lit: [left, top, left + width, top + height],
        };
        sites.clip = noise::clipping(&sites);
        sites.noise = noise::estimate(&sites);
        sites
    }

    /// Whether a site has the colour.
    #[inline]
    fn has(&self, x: usize, y: usize) -> bool {
        self.sensor.mosaic.pattern.at(x, y) == self.colour
    }

    /// The sample of a site, black not taken off.
    #[inline]
    fn raw(&self, x: usize, y: usize) -> u16 {
        self.sensor.samples[y * self.sensor.width + x]
    }

    /// Light of a site: its sample less its black.
    #[inline]
    fn light(&self, x: usize, y: usize) -> f64 {
        f64::from(self.raw(x, y)) - self.sensor.mosaic.black.at(x, y)
    }

    /// Whether a row could be decoded.
    fn is_whole(&self, y: usize) -> bool {
        !self.sensor.damaged_rows.iter().any(|[first, last]| (*first as usize..*last as usize).contains(&y))
    }
}

/// Finds and measures the targets of a sensor's samples; places are on its whole grid.
///
/// # Errors
/// As for [`detect`](super::detect).
pub(super) fn detect_sensor(sensor: &Sensor, options: &DetectOptions) -> Result<Detection> {
    let sites = Sites::of(sensor, options);
    let searched = Searched::of(&sites);
    let mut detection = detect_photo(&searched.photo, options)?;
    let family = codes::read_in_light(&searched, &mut detection.targets, options.codes);
    super::code::drop_parts(&mut detection, family);
    let shift = [sites.lit[0] as f64, sites.lit[1] as f64];
    for blob in &mut detection.rejected_blobs {
        (blob.u, blob.v) = (blob.u + shift[0], blob.v + shift[1]);
    }
    let mut field = Field::default();
    for target in std::mem::take(&mut detection.targets) {
        let (u, v, diameter) = (target.u + shift[0], target.v + shift[1], target.major);
        match sites.measured(&searched, target, options, &mut field) {
            Ok(target) => detection.targets.push(target),
            Err(reason) => {
                *detection.rejected.entry(reason).or_default() += 1;
                detection.rejected_blobs.push(Rejected { u, v, diameter, reason });
            }
        }
    }
    if let Some(green) = sites.in_green(options) {
        let seen = detect_sensor(sensor, &green)?.targets;
        sites.join(&mut detection, &searched, seen, options, &mut field);
    }
    detection.targets.iter_mut().for_each(|target| target.id = 0);
    detection.number_targets();
    let size = |side: usize| u32::try_from(side).unwrap_or(u32::MAX);
    (detection.width, detection.height) = (size(sensor.width), size(sensor.height));
    detection.damaged_rows = sensor.damaged_rows.clone();
    // what holds for the picture of the search is not what is measured
    detection.picture.noise = sites.noise.deviation(sites.noise.usual);
    detection.picture.noise_correlation = 1.0;
    detection.picture.compression = 0.0;
    detection.measured = Some(sites.sample_source(options.method, searched.hot));
    Ok(detection)
}

/// Measures the one target at a click.
///
/// # Errors
/// As for [`measure_at`](super::measure_at).
pub(super) fn measure_in_sensor(sensor: &Sensor, u: f64, v: f64, options: &DetectOptions) -> Result<Option<Target>> {
    let sites = Sites::of(sensor, options);
    let searched = Searched::of(&sites);
    let shift = [sites.lit[0] as f64, sites.lit[1] as f64];
    let whole = [(u, sensor.width, "u"), (v, sensor.height, "v")];
    if let Some((value, size, name)) =
        whole.into_iter().find(|(value, size, _)| !(*value >= 0.0 && *value <= *size as f64))
    {
        let reason = Wrong::OutsidePicture { name: name.into(), value: value.into(), size };
        return Err(Error::Invalid { reason, at: Place::field(name) });
    }
    if check_place(&searched.photo.grey.view()?, u - shift[0], v - shift[1]).is_err() {
        // in the masked border, where no light falls
        return Ok(None);
    }
    let mut field = Field::default();
    let found = measure_in_photo(&searched.photo, u - shift[0], v - shift[1], options)?.and_then(|mut target| {
        codes::read_in_light(&searched, std::slice::from_mut(&mut target), options.codes);
        sites.measured(&searched, target, options, &mut field).ok()
    });
    let Some(green) = sites.in_green(options).filter(|_| found.is_none()) else { return Ok(found) };
    let seen = measure_in_sensor(sensor, u, v, &green)?;
    Ok(seen.and_then(|target| sites.again(&searched, &target, options, &mut field)))
}

/// Targets that are known, measured on the sites of another colour, without a search; `None` if that has no target.
///
/// # Errors
/// As for [`detect_sensor`].
pub(super) fn measured_again(
    sensor: &Sensor,
    targets: &[Target],
    options: &DetectOptions,
) -> Result<Vec<Option<Target>>> {
    let sites = Sites::of(sensor, options);
    let searched = Searched::of(&sites);
    let mut field = Field::default();
    Ok(targets.iter().map(|target| sites.again(&searched, target, options, &mut field)).collect())
}

/// The grey picture of the search, of the lit part.
struct Searched {
    photo: DecodedPhoto,
    /// What each of its levels is in light, in 16 bits again, and their levels for a unit of light.
    light: Vec<u16>,
    per_light: f64,
    /// How many hot sites were left out of it.
    hot: usize,
}

impl Searched {
    fn of(sites: &Sites) -> Self {
        let curve = Curve::of(sites);
        let (samples, hot) = plane::of(sites, &curve);
        let [left, top, right, bottom] = sites.lit;
        let grey = Grey { width: right - left, height: bottom - top, samples: Samples::U16(samples) };
        let inside = |row: u32| (row as usize).clamp(top, bottom) - top;
        let rows = sites.sensor.damaged_rows.iter().map(|rows| rows.map(|row| inside(row) as u32));
        let photo = DecodedPhoto { grey, damaged_rows: rows.filter(|rows| rows[0] < rows[1]).collect(), page: None };
        Self { photo, light: curve.undone(), per_light: curve.per_light(), hot }
    }

    fn plane(&self) -> Option<SampleView<'_, u16>> {
        let Grey { width, height, samples: Samples::U16(samples) } = &self.photo.grey else { return None };
        Some(SampleView::new(*width, *height, samples))
    }

    /// Light of objects around a fit, up to `reach` beyond its rim, that blur carries onto a site of this picture.
    fn neighbours(&self, fit: &SiteFit, shift: [f64; 2], reach: f64) -> Option<impl Fn(f64, f64) -> f64 + use<>> {
        let outline = Outline { u: fit.outline.u - shift[0], v: fit.outline.v - shift[1], ..fit.outline };
        let size = 2.0 * (outline.semi_axes().0 + reach) + BESIDE;
        let Window { left, top, width, height, samples } =
            Window::of(&self.plane()?, outline.u, outline.v, size.ceil() as usize);
        let in_light = |level: &u16| self.light[usize::from(*level).min(self.light.len() - 1)];
        let samples: Vec<u16> = samples.iter().map(in_light).collect();
        let part = [left as f64, top as f64];
        let outline = Outline { u: outline.u - part[0], v: outline.v - part[1], ..outline };
        let plane = SampleView::new(width, height, &samples);
        let [contrast, rms] = [fit.contrast, fit.rms].map(|light| self.per_light * light);
        let neighbours = Neighbours::of(&plane, &outline, fit.blur, contrast, reach, rms)?;
        Some(move |x: f64, y: f64| neighbours.light(x - shift[0] - part[0], y - shift[1] - part[1]))
    }
}

impl Sites<'_> {
    /// The options of a search in green, of which a sensor has twice the sites; `None` if green is measured or there is none. Other methods
    /// than the fit measure in the picture of the search itself.
    fn in_green(&self, options: &DetectOptions) -> Option<DetectOptions> {
        let fewer = matches!(self.colour, Colour::Red | Colour::Blue) && self.sensor.mosaic.pattern.has(Colour::Green);
        let searched = fewer && options.method == Method::LeastSquares;
        searched.then(|| DetectOptions { channel: Channel::Green, ..options.clone() })
    }

    /// Adds what was seen in another colour and not in this one, measured on this colour's sites.
    fn join(
        &self,
        detection: &mut Detection,
        searched: &Searched,
        seen: Vec<Target>,
        options: &DetectOptions,
        field: &mut Field,
    ) {
        let near = |u: f64, v: f64, target: &Target| (u - target.u).hypot(v - target.v) < 0.5 * target.minor;
        for target in seen {
            if detection.targets.iter().any(|known| near(known.u, known.v, &target)) {
                continue;
            }
            let Some(found) = self.again(searched, &target, options, field) else { continue };
            detection.rejected_blobs.retain(|blob| {
                let same = near(blob.u, blob.v, &target);
                if let Some(count) = detection.rejected.get_mut(&blob.reason).filter(|_| same) {
                    *count = count.saturating_sub(1);
                }
                !same
            });
            detection.targets.push(found);
        }
        detection.rejected.retain(|_, count| *count > 0);
    }

    /// A target that is known on the whole grid, measured on the sites; `None` if this colour does not show it.
    fn again(
        &self,
        searched: &Searched,
        target: &Target,
        options: &DetectOptions,
        field: &mut Field,
    ) -> Option<Target> {
        let shift = [self.lit[0], self.lit[1]].map(|from| -(from as f64));
        self.measured(searched, target.clone().moved(shift), options, field).ok()
    }

    /// A target of the search, measured on the sites. Other methods than the fit keep what they found in the picture.
    fn measured(
        &self,
        searched: &Searched,
        target: Target,
        options: &DetectOptions,
        field: &mut Field,
    ) -> std::result::Result<Target, Reason> {
        let shift = [self.lit[0] as f64, self.lit[1] as f64];
        if options.method != Method::LeastSquares {
            return Ok(target.moved(shift));
        }
        let plane = searched.plane().ok_or(Reason::NoFit)?;
        let outline = outline_of(&target);
        let all = vec![true; edge::ray_count(&outline)];
        let blur = target.quality.edge_width;
        let around = surround::measure(&plane, &outline, blur.max(0.7), &all, u32::MAX).ok_or(Reason::NoFit)?;
        let outline = Outline { u: outline.u + shift[0], v: outline.v + shift[1], ..outline };
        let light = |fit: &SiteFit, reach: f64| searched.neighbours(fit, shift, reach);
        // where a ring stands near by, only the gap before it is background
        let shifted = |outline: Outline| Outline { u: outline.u + shift[0], v: outline.v + shift[1], ..outline };
        let hole = rims::left_out(&target).map(shifted);
        let found = fit::fit(self, &outline, hole.as_ref(), blur, around.outer, field, light)
            .or_else(|| fit::fit(self, &outline, hole.as_ref(), blur, 0.0, field, light))
            .ok_or(Reason::NoFit)?;
        let (a, b, angle) = found.outline.axes();
        let bright = target.polarity == Polarity::Bright;
        let apart = (found.outline.u - outline.u).hypot(found.outline.v - outline.v);
        if apart > 1.0 + 0.1 * b || (found.contrast > 0.0) != bright {
            return Err(Reason::NoFit);
        }
        if b < options.min_axis_ratio * a {
            return Err(Reason::TooFlat);
        }
        let [uu, uv, vv] = found.covariance;
        let mut quality = target.quality.clone();
        quality.fit_rms = found.rms;
        quality.noise = self.noise.deviation(found.ground);
        quality.edge_width = found.blur;
        quality.saturated = found.clipped;
        quality.roundness = b / a;
        let inner = match rims::hole_of(&target) {
            Some(hole) => Some(InnerRim::of(&self.measured(searched, hole, options, field)?)),
            None => None,
        };
        let mut measured = Target {
            inner,
            u: found.outline.u,
            v: found.outline.v,
            sigma_u: uu.sqrt(),
            sigma_v: vv.sqrt(),
            covariance_uv: uv,
            major: 2.0 * a,
            minor: 2.0 * b,
            angle,
            contrast: found.contrast.abs(),
            quality,
            ..target
        };
        rims::compare_centres(&mut measured);
        Ok(measured)
    }

    /// Description of the data on which the detection was measured.
    fn sample_source(&self, method: Method, hot: usize) -> SampleSource {
        let Sensor { format, bits, mosaic, corrections, unread_corrections, .. } = self.sensor;
        SampleSource {
            on: if method == Method::LeastSquares { MeasuredOn::Sites } else { MeasuredOn::InterpolatedSites },
            format: format.clone(),
            colour: Some(self.colour),
            pattern: Some(mosaic.pattern.letters()),
            bits: *bits,
            active_area: Some(mosaic.active_area),
            white: Some(self.clip),
            gain: Some(self.noise.gain),
            read_noise: self.noise.readout(),
            hot_sites: Some(hot),
            corrections: corrections.clone(),
            unread_corrections: *unread_corrections,
        }
    }
}
