//! Target detection: from a grey picture to centres with their covariances.
//!
//! [`picture`] takes the levels of the whole picture. [`search`] passes once over its rows and links the runs between edges into
//! blobs that may be ellipses; in the same pass the picture at a quarter of its size shows what is large or out of focus. [`edges`]
//! confirms them: sub-pixel edges, a robust ellipse through them ([`ellipse`] is the shape itself), the grey levels around.
//! [`rendered`] measures the centre by the fit of a rendered ellipse, or [`centroid`] by a classical operator; [`measure`] leads
//! from one to the next. Rings around a target are read as codes ([`code`]). A room uses those before it, never the reverse.
//! [`whole`] goes around what a damaged file does not give.

mod centroid;
mod click;
mod code;
mod edges;
mod ellipse;
mod measure;
mod median;
mod normal;
mod picture;
mod rendered;
mod search;
mod whole;

use edges::edge;
pub(crate) use ellipse::{conic, outline};

use crate::detection::{Codes, DetectOptions, Detection, MethodResult, Polarity, Reason, Rejected, Target};
use crate::error::{self, Error, Place, Result};
use crate::image::{GreyView, Plane, Sample, SamplesView};
use code::{DotLevels, Family, Reading};
use measure::Measure;
use outline::Outline;
use picture::noise;
use search::census::Census;
use search::{Blobs, Candidate};
pub use whole::{detect_photo, measure_in_photo};

/// Finds and measures the targets of a picture.
///
/// # Errors
/// [`Error::Invalid`] for diameters that are not positive finite numbers or stand in the wrong order.
pub fn detect(image: &GreyView, options: &DetectOptions) -> Result<Detection> {
    check(options)?;
    let mut detection = match image.samples() {
        SamplesView::U8(samples) => detect_in(Plane::new(image.width(), image.height(), samples), options),
        SamplesView::U16(samples) => detect_in(Plane::new(image.width(), image.height(), samples), options),
    };
    detection.bits = image.bits();
    Ok(detection)
}

/// Measures the one target at a click, in a window around it; none when there is no target.
///
/// # Errors
/// [`Error::Invalid`] for a place outside of the picture, and as for [`detect`].
pub fn measure_at(image: &GreyView, u: f64, v: f64, options: &DetectOptions) -> Result<Option<Target>> {
    check(options)?;
    check_place(image, u, v)?;
    Ok(match image.samples() {
        SamplesView::U8(samples) => click::measure(Plane::new(image.width(), image.height(), samples), u, v, options),
        SamplesView::U16(samples) => click::measure(Plane::new(image.width(), image.height(), samples), u, v, options),
    })
}

/// Measures one target by every method, for comparing them; empty when there is no target at the place.
///
/// # Errors
/// As for [`measure_at`].
pub fn measure_all(image: &GreyView, u: f64, v: f64, options: &DetectOptions) -> Result<Vec<MethodResult>> {
    check(options)?;
    check_place(image, u, v)?;
    Ok(match image.samples() {
        SamplesView::U8(samples) => click::compare(Plane::new(image.width(), image.height(), samples), u, v, options),
        SamplesView::U16(samples) => click::compare(Plane::new(image.width(), image.height(), samples), u, v, options),
    })
}

fn check_place(image: &GreyView, u: f64, v: f64) -> Result<()> {
    for (name, value, size) in [("u", u, image.width()), ("v", v, image.height())] {
        if !(value >= 0.0 && value <= size as f64) {
            return Err(Error::Invalid {
                reason: error::Reason::OutsidePicture { name: name.into(), value: value.into(), size },
                at: Place::field(name),
            });
        }
    }
    Ok(())
}

fn check(options: &DetectOptions) -> Result<()> {
    for (name, value) in [("min_diameter", options.min_diameter), ("max_diameter", options.max_diameter)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(Error::Invalid {
                reason: error::Reason::NotPixels { name: name.into(), value: value.into() },
                at: Place::field(name),
            });
        }
    }
    if options.min_diameter > options.max_diameter {
        return Err(Error::Invalid {
            reason: error::Reason::DiametersSwapped {
                min_diameter: options.min_diameter.into(),
                max_diameter: options.max_diameter.into(),
            },
            at: Place::field("min_diameter"),
        });
    }
    Ok(())
}

fn detect_in<T: Sample>(plane: Plane<T>, options: &DetectOptions) -> Detection {
    let levels = noise::levels(&plane);
    let blobs = search::search(&plane, &levels, options);
    let mut census = Census::new(plane.width, plane.height);
    census.expect(blobs.iter().map(|blobs| blobs.shapeless.len() + blobs.unlike.len()).sum());
    for Blobs { shapeless, unlike, too_small, too_large, .. } in &blobs {
        census.add(Reason::TooSmall, *too_small);
        census.add(Reason::TooLarge, *too_large);
        for no in shapeless.iter().chain(unlike) {
            census.count(no);
        }
    }
    let mut measure = Measure::new(plane, levels, options);
    for candidate in blobs.iter().flat_map(|blobs| &blobs.candidates) {
        if !census.is_new(candidate) {
            continue;
        }
        let Candidate { outline, bright } = candidate;
        match measure.confirm(outline, *bright).and_then(|found| measure.finish(&found, options.method)) {
            Ok(target) => census.accept(target, *bright),
            Err(reason) => census.reject(*outline, *bright, reason),
        }
    }
    let mut detection = census.finish();
    read_codes(&plane, &mut detection, options.codes);
    drop_ring_parts(&mut detection);
    let size = |pixels| u32::try_from(pixels).unwrap_or(u32::MAX);
    Detection { width: size(plane.width), height: size(plane.height), ..detection }
}

/// Reads the codes of all targets; under "auto" the family that reads most rings is everyone's.
fn read_codes<T: Sample>(plane: &Plane<T>, detection: &mut Detection, codes: Codes) {
    let mut best: Option<(usize, Vec<Reading>)> = None;
    for family in Family::of(codes) {
        let readings: Vec<Reading> = detection.targets.iter().map(|target| read_code(plane, target, &family)).collect();
        let count = readings.iter().filter(|reading| matches!(reading, Reading::Code { .. })).count();
        if best.as_ref().is_none_or(|(most, _)| count > *most) {
            best = Some((count, readings));
        }
    }
    let Some((_, readings)) = best else { return };
    for (target, reading) in detection.targets.iter_mut().zip(readings) {
        match reading {
            Reading::Plain => {}
            Reading::Code { number, margin } => {
                target.code = Some(number);
                target.quality.code_margin = Some(margin);
            }
            Reading::Unsafe { margin, note } => {
                target.quality.code_margin = Some(margin);
                target.quality.code_note = Some(note);
            }
        }
    }
}

/// Takes out what lies in the ring of a code that was read.
fn drop_ring_parts(detection: &mut Detection) {
    let coded = detection.targets.iter().filter(|target| target.code.is_some());
    let dots: Vec<Outline> = coded.map(outline_of).collect();
    let in_ring = |target: &Target| {
        let part = |dot: &Outline| {
            let [c, s] = dot.normalised(target.u, target.v);
            (code::RING.0 - 0.2..code::RING.1 + 0.2).contains(&c.hypot(s))
        };
        target.code.is_none() && dots.iter().any(part)
    };
    let (parts, targets) = std::mem::take(&mut detection.targets).into_iter().partition(in_ring);
    detection.targets = targets;
    for Target { u, v, major, .. } in parts {
        *detection.rejected.entry(Reason::CodeRing).or_default() += 1;
        detection.rejected_blobs.push(Rejected { u, v, diameter: major, reason: Reason::CodeRing });
    }
}

fn outline_of(target: &Target) -> Outline {
    Outline::from_axes(target.u, target.v, target.major / 2.0, target.minor / 2.0, target.angle)
}

fn read_code<T: Sample>(plane: &Plane<T>, target: &Target, family: &Family) -> Reading {
    let dot = outline_of(target);
    let middle = f64::from(plane.sample(target.u as f32, target.v as f32));
    let sign = if target.polarity == Polarity::Bright { 1.0 } else { -1.0 };
    code::read(plane, &dot, DotLevels { dot: middle, background: middle - sign * target.contrast }, family)
}
