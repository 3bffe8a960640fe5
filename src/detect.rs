//! Target detection: from a grey picture to centres with their covariances.
//!
//! [`picture`] takes the levels of the whole picture. [`search`] passes once over its rows and links the runs between edges into
//! blobs that may be ellipses; in the same pass the picture at a quarter of its size shows what is large or out of focus. [`edges`]
//! confirms them: sub-pixel edges, a robust ellipse through them ([`ellipse`] is the shape itself), the grey levels around.
//! [`rendered`] measures the centre by the fit of a rendered ellipse, or [`centroid`] by a classical operator; [`measure`] leads
//! from one to the next, [`pass`](mod@pass) through a whole picture. Rings around a target are read as codes ([`code`]). In ordinary
//! photos [`small_targets`] finds more by comparison with the targets found. [`rims`] makes donuts of those that are holes. What decides is one table, [`acceptance`]. A room uses those
//! before it, never the reverse. [`damaged_rows`] measures the intact parts of damaged photos, [`sites`] measures on a sensor's own samples,
//! [`colours`] red and blue beside green.

mod acceptance;
mod adaptive_moments;
mod centroid;
mod click;
mod code;
mod colours;
mod damaged_rows;
mod edges;
mod ellipse;
mod measure;
mod median;
mod normal;
mod occlusion;
mod pass;
mod picture;
mod rendered;
mod rims;
mod search;
mod shot;
mod sites;
mod small_targets;
mod window;

pub(crate) use ellipse::{conic, outline};

use crate::detection::{Codes, DetectOptions, Detection, Method, MethodResult, PictureReport, Target};
use crate::error::{self, Error, Place, Result};
use crate::image::{GreyView, Sample, SampleView, SamplesView};
use acceptance::levels::ROUNDING;
use acceptance::picture::{RESTORED, SOFT};
use code::outline_of;
pub use colours::colours_apart;
pub use damaged_rows::{detect_photo, measure_in_photo};
use measure::Measure;
use normal::BLUR;
use outline::Outline;
use pass::Pass;
use picture::character::{APART, Character};
use picture::dither;
use picture::noise::{self, GreyStatistics};
use picture::sharpening::{self, Sharpening};
use picture::softened::Softened;
use search::tested_outlines::TestedOutlines;
pub use shot::{detect_shot, measure_in_shot};
use small_targets::ExpectedShape;

/// Finds and measures the targets of a picture.
///
/// # Errors
/// [`Error::Invalid`] for diameters that are not positive finite numbers or are in the wrong order, and for a picture of two levels whose greys
/// are patterns of dots.
pub fn detect(image: &GreyView, options: &DetectOptions) -> Result<Detection> {
    check(options)?;
    check_levels(image)?;
    let mut detection = match image.samples() {
        SamplesView::U8(samples) => detect_in(SampleView::new(image.width(), image.height(), samples), options),
        SamplesView::U16(samples) => detect_in(SampleView::new(image.width(), image.height(), samples), options),
    };
    detection.bits = image.bits();
    detection.number_targets();
    Ok(detection)
}

/// Measures the one target at a click, in a window around it; `None` if there is no target.
///
/// # Errors
/// [`Error::Invalid`] for a place outside of the picture, and as for [`detect`].
pub fn measure_at(image: &GreyView, u: f64, v: f64, options: &DetectOptions) -> Result<Option<Target>> {
    check(options)?;
    check_levels(image)?;
    check_place(image, u, v)?;
    Ok(match image.samples() {
        SamplesView::U8(samples) => {
            click::measure(SampleView::new(image.width(), image.height(), samples), u, v, options)
        }
        SamplesView::U16(samples) => {
            click::measure(SampleView::new(image.width(), image.height(), samples), u, v, options)
        }
    })
}

/// Measures one target by every method, for comparing them; empty when there is no target at the place.
///
/// # Errors
/// As for [`measure_at`].
pub fn measure_all(image: &GreyView, u: f64, v: f64, options: &DetectOptions) -> Result<Vec<MethodResult>> {
    check(options)?;
    check_levels(image)?;
    check_place(image, u, v)?;
    Ok(match image.samples() {
        SamplesView::U8(samples) => {
            click::compare(SampleView::new(image.width(), image.height(), samples), u, v, options)
        }
        SamplesView::U16(samples) => {
            click::compare(SampleView::new(image.width(), image.height(), samples), u, v, options)
        }
    })
}

/// Reads the ring codes of targets that are measured already, with this choice of families.
pub fn read_codes(image: &GreyView, targets: &mut [Target], codes: Codes) {
    let (width, height) = (image.width(), image.height());
    match image.samples() {
        SamplesView::U8(samples) => code::read_in(&SampleView::new(width, height, samples), targets, codes),
        SamplesView::U16(samples) => code::read_in(&SampleView::new(width, height, samples), targets, codes),
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

/// Error diffusion lays a grey down beside where it was: its edges are a quarter of a pixel off together, which no residual shows.
fn check_levels(image: &GreyView) -> Result<()> {
    let (width, height) = (image.width(), image.height());
    let is_dithered = match image.samples() {
        SamplesView::U8(samples) => dither::is_dithered(&SampleView::new(width, height, samples)),
        SamplesView::U16(samples) => dither::is_dithered(&SampleView::new(width, height, samples)),
    };
    if is_dithered {
        return Err(Error::Invalid { reason: error::Reason::Dithered, at: Place::field("picture") });
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
    if !(0.15..=1.0).contains(&options.min_axis_ratio) {
        return Err(Error::Invalid {
            reason: error::Reason::AxisRatio { value: options.min_axis_ratio.into() },
            at: Place::field("min_axis_ratio"),
        });
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

/// Detects on the original; for processed photos also on a smoothed copy with its sharpening undone, for what is occluded
/// otherwise. What was found first stands.
fn detect_in<T: Sample>(plane: SampleView<T>, options: &DetectOptions) -> Detection {
    let mut levels = noise::levels(&plane);
    let character = Character::of(&plane, &levels);
    let mut processed = character.is_processed(&levels);
    levels.developed = processed && !character.is_clipped();
    let mut picture = report(&levels, &character, options.method);
    let mut passed = pass::pass(plane, levels, options, processed && character.is_compressed(), None, &[]);
    let coloured = passed.coloured;
    let hidden = std::mem::take(&mut passed.occluded);
    if !processed && !levels.stairs {
        // Dots too small for flat sides of a row's steps show in their own rims what was done to the picture.
        let outlines: Vec<Outline> = passed.detection.targets.iter().map(outline_of).collect();
        let found = sharpening::of_rims(&plane, outlines.iter(), levels.saturation);
        processed = found.is_some();
        levels.developed = processed && !character.is_clipped();
    }
    let mut factors = passed.correlate();
    let (mut restored, mut left) = (None, Vec::new());
    if processed {
        let Pass { detection: Detection { targets: first, .. }, mut grounds, doubtful, .. } = passed;
        let known: Vec<Target> = first.iter().chain(&grounds).cloned().collect();
        (passed, restored) = soften(&plane, &levels, options, &known, &mut picture, &mut factors);
        passed.detection.targets.extend_from_slice(&first);
        if options.codes != Codes::None {
            let undone = restored.iter().flat_map(|(_, pass)| &pass.detection.targets);
            let known = passed.detection.targets.iter().chain(undone);
            left = in_rings(plane, levels, options, true, &doubtful, &first, known);
        }
        grounds.append(&mut passed.grounds);
        passed.grounds = grounds;
    } else if options.codes != Codes::None {
        let Pass { detection: Detection { targets, .. }, doubtful, .. } = &passed;
        left = in_rings(plane, levels, options, false, doubtful, targets, targets.iter());
    }
    if factors[1] > 0.0 {
        picture.noise_correlation = (factors[0] / factors[1]).sqrt();
    }
    let Pass { mut detection, grounds, .. } = passed;
    // codes are read where their dots were measured: with the sharpening undone, or in the picture itself
    let (undone, undone_grounds, softened) = match restored {
        Some((softened, pass)) => (pass.detection.targets, pass.grounds, Some(softened)),
        None => (Vec::new(), Vec::new(), None),
    };
    let first_left = detection.targets.len();
    detection.targets.extend(left);
    let left = first_left..detection.targets.len();
    let mut in_undone = vec![false; detection.targets.len()];
    detection.targets.extend(undone);
    in_undone.resize(detection.targets.len(), true);
    for target in hidden {
        if detection.targets.iter().all(|other| are_apart(&outline_of(other), &outline_of(&target))) {
            search::tested_outlines::forget_rejected(&mut detection, &target);
            detection.targets.push(target);
            in_undone.push(false);
        }
    }
    let found = detection.targets.len();
    for (grounds, of_undone) in [(grounds, false), (undone_grounds, true)] {
        for ground in grounds {
            // one pass's disc may be another's target
            if !detection.targets.iter().any(|other| is_same(other, &ground)) {
                detection.targets.push(ground);
                in_undone.push(of_undone);
            }
        }
    }
    let family = code::read_all(&mut detection.targets, options.codes, |k, target, families| match &softened {
        Some(softened) if in_undone[k] => {
            let target = Target { contrast: target.contrast * softened.scale, ..target.clone() };
            let blur = target.quality.edge_width.hypot(RESTORED);
            code::read(&softened.plane(), &target, blur, families)
        }
        _ => code::read(&plane, target, target.quality.edge_width, families),
    });
    let taken_back = left.len() - code::keep_ringed(&mut detection, left, family);
    code::settle_grounds(&mut detection, found - taken_back, family);
    code::drop_parts(&mut detection, family);
    code::drop_sectors(&mut detection);
    rims::settle(&plane, &levels, options, coloured, &mut detection);
    detection.targets.sort_by(|a, b| a.v.total_cmp(&b.v).then(a.u.total_cmp(&b.u)));
    let size = |pixels| u32::try_from(pixels).unwrap_or(u32::MAX);
    Detection { width: size(plane.width), height: size(plane.height), picture, ..detection }
}

/// Whether two measurements are of the same disc.
fn is_same(one: &Target, other: &Target) -> bool {
    let apart = (one.u - other.u).hypot(one.v - other.v);
    let [near, ratio] = acceptance::place::SAME;
    apart < near * one.minor.min(other.minor) && one.major < ratio * other.major && other.major < ratio * one.major
}

/// Whether neither outline has the centre of the other in it.
fn are_apart(one: &Outline, other: &Outline) -> bool {
    let [c, s] = other.normalised(one.u, one.v);
    let [own_c, own_s] = one.normalised(other.u, other.v);
    c.hypot(s) >= 1.0 && own_c.hypot(own_s) >= 1.0
}

fn report(levels: &GreyStatistics, character: &Character, method: Method) -> PictureReport {
    let [clipped_dark, clipped_bright] = character.clipped;
    PictureReport {
        clipped_dark,
        clipped_bright,
        compression: character.blocks,
        noise: levels.noise,
        noise_correlation: 1.0,
        white_noise_assumed: method != Method::LeastSquares,
        ..PictureReport::default()
    }
}

/// What a softened picture shows beyond the targets that are known; and, when the rims of all these show a sharpening, what it
/// shows once that is undone, with that picture.
fn soften<T: Sample>(
    plane: &SampleView<T>,
    levels: &GreyStatistics,
    options: &DetectOptions,
    known: &[Target],
    picture: &mut PictureReport,
    factors: &mut [f64; 2],
) -> (Pass, Option<(Softened, Pass)>) {
    picture.softened = true;
    let (_, mut softened) = pass_softened(plane, levels, None, SOFT, options, known);
    small_targets::drop_faint(&mut softened.detection.targets, known);
    let outlines: Vec<Outline> = known.iter().chain(&softened.detection.targets).map(outline_of).collect();
    let Some(sharpening) = sharpening::of_rims(plane, outlines.iter(), levels.saturation) else {
        add(factors, softened.correlate());
        return (softened, None);
    };
    (picture.sharpening, picture.sharpening_radius) = (sharpening.amount, sharpening.radius);
    let (undone, mut restored) = pass_softened(plane, levels, Some(sharpening), RESTORED, options, known);
    small_targets::drop_faint(&mut restored.detection.targets, known);
    add(factors, restored.correlate());
    add(factors, softened.correlate());
    let taken: Vec<Outline> = known.iter().chain(&restored.detection.targets).map(outline_of).collect();
    softened.detection.targets.retain(|target| taken.iter().all(|other| are_apart(&outline_of(target), other)));
    (softened, Some((undone, restored)))
}

fn add(sum: &mut [f64; 2], other: [f64; 2]) {
    *sum = [sum[0] + other[0], sum[1] + other[1]];
}

/// One pass over a picture made of another one, in that one's grey levels.
fn pass_softened<T: Sample>(
    plane: &SampleView<T>,
    own: &GreyStatistics,
    sharpening: Option<Sharpening>,
    sigma: f64,
    options: &DetectOptions,
    known: &[Target],
) -> (Softened, Pass) {
    let soft = Softened::of(plane, sharpening, sigma);
    let levels = noise::levels_at(&soft.plane(), APART);
    // a mean has no end of the scale, and no noise less than that of rounding
    let levels = GreyStatistics {
        saturation: f64::from(u16::MAX),
        noise: levels.noise.max(ROUNDING * soft.scale),
        stairs: false,
        developed: own.developed,
        ..levels
    };
    let mut passed = pass::pass(soft.plane(), levels, options, true, Some(sigma), known);
    for target in passed.detection.targets.iter_mut().chain(&mut passed.grounds) {
        target.contrast /= soft.scale;
        target.quality.noise /= soft.scale;
        // what the mean has added is none of the picture's
        let own = target.quality.edge_width.powi(2) - sigma * sigma;
        target.quality.edge_width = own.max(0.0).sqrt().max(BLUR.0);
        if options.method == Method::LeastSquares {
            target.quality.fit_rms /= soft.scale;
        }
    }
    (soft, passed)
}

/// Small dots in rings of codes that only the picture itself shows: a mean joins them with their ring, and compression scatters their
/// edges. `own` are the targets found there, `known` all. Only a ring around them makes targets of them: letters have such shapes too.
/// Where a picture is not `processed` what lies around each was its background already.
fn in_rings<'a, T: Sample>(
    plane: SampleView<T>,
    levels: GreyStatistics,
    options: &DetectOptions,
    processed: bool,
    doubtful: &[Outline],
    own: &[Target],
    known: impl Iterator<Item = &'a Target>,
) -> Vec<Target> {
    let mut measure = Measure::new(plane, levels, options);
    measure.work.coloured = processed;
    let Some(common) = small_targets::of(&mut measure, &[], own) else { return Vec::new() };
    let mut tested = TestedOutlines::new(plane.width, plane.height, code::have_spots(options.codes));
    known.for_each(|target| tested.know(target));
    let mut colours = Vec::new();
    let wanted = if processed { ExpectedShape::InRingOrWide } else { ExpectedShape::InRing };
    pass::take_small_targets(&mut measure, &mut tested, &mut colours, doubtful, &common, wanted);
    let mut left = Pass { detection: tested.finish(), colours, coloured: processed, ..Pass::default() };
    left.correlate();
    left.detection.targets
}
