//! Target detection: from a grey picture to centres with their covariances.
//!
//! [`picture`] takes the levels of the whole picture. [`search`] passes once over its rows and links the runs between edges into
//! blobs that may be ellipses; in the same pass the picture at a quarter of its size shows what is large or out of focus. [`edges`]
//! confirms them: sub-pixel edges, a robust ellipse through them ([`ellipse`] is the shape itself), the grey levels around.
//! [`rendered`] measures the centre by the fit of a rendered ellipse, or [`centroid`] by a classical operator; [`measure`] leads
//! from one to the next. Rings around a target are read as codes ([`code`]). A room uses those before it, never the reverse.

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

pub(crate) use ellipse::{conic, outline};

use crate::detection::{Codes, DetectOptions, Detection, MethodResult, Reason, Target};
use crate::error::{self, Error, Place, Result};
use crate::image::{GreyView, Plane, Sample, SamplesView};
use measure::Measure;
use outline::Outline;
use picture::noise;
use search::census::Census;
use search::{Blobs, Candidate};

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

/// Reads the ring codes of targets that are measured already, with this choice of families.
pub fn read_codes(image: &GreyView, targets: &mut [Target], codes: Codes) {
    let (width, height) = (image.width(), image.height());
    match image.samples() {
        SamplesView::U8(samples) => code::read_all(&Plane::new(width, height, samples), targets, codes),
        SamplesView::U16(samples) => code::read_all(&Plane::new(width, height, samples), targets, codes),
    }
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
    let mut census = Census::new(plane.width, plane.height, code::have_spots(options.codes));
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
    let grounds = std::mem::take(&mut census.grounds);
    let mut detection = census.finish();
    let found = detection.targets.len();
    detection.targets.extend(grounds);
    code::read_all(&plane, &mut detection.targets, options.codes);
    code::settle_grounds(&mut detection, found);
    code::drop_parts(&mut detection);
    let size = |pixels| u32::try_from(pixels).unwrap_or(u32::MAX);
    Detection { width: size(plane.width), height: size(plane.height), ..detection }
}
