//! Target detection: from a grey picture to centres with their covariances.
//!
//! [`picture`] takes the levels of the whole picture. [`search`] passes once over its rows and links the runs between edges into
//! blobs that may be ellipses; in the same pass the picture at a quarter of its size shows what is large or out of focus. [`edges`]
//! confirms them: sub-pixel edges, a robust ellipse through them ([`ellipse`] is the shape itself), the grey levels around.
//! [`rendered`] measures the centre by the fit of a rendered ellipse, or [`centroid`] by a classical operator; [`measure`] leads
//! from one to the next, [`pass`](mod@pass) through a whole picture. Rings around a target are read as codes ([`code`]). In ordinary
//! photos [`small_targets`] finds more by comparison with the targets found, and what a camera has sharpened or compressed is looked at again in
//! softened windows ([`second_look`]). [`rims`] makes donuts of those that are holes. What decides is one table, [`acceptance`]. A room uses those
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
mod second_look;
mod shot;
mod sites;
mod small_targets;
mod window;

pub(crate) use ellipse::{conic, outline};

use crate::detection::{Codes, DetectOptions, Detection, Method, MethodResult, PictureReport, Polarity, Target};
use crate::error::{self, Error, Place, Result};
use crate::image::{GreyView, Sample, SampleView, SamplesView};
use code::outline_of;
pub use colours::colours_apart;
pub use damaged_rows::{detect_photo, measure_in_photo};
use measure::Measure;
use outline::Outline;
use pass::Pass;
use picture::character::Character;
use picture::dither;
use picture::noise::{self, GreyStatistics};
use picture::sharpening::{self, Sharpening};
use search::Candidate;
use search::tested_outlines::TestedOutlines;
use second_look::View;
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

/// Detects in the picture, and in a processed photo at a second look, too. What was found first stands.
fn detect_in<T: Sample>(plane: SampleView<T>, options: &DetectOptions) -> Detection {
    let mut levels = noise::levels(&plane);
    let character = Character::of(&plane, &levels);
    let mut processed = character.is_processed(&levels);
    levels.developed = processed && !character.is_clipped();
    let mut picture = report(&levels, &character, options.method);
    let mut first = pass::pass(plane, levels, options, processed && character.is_compressed());
    let mut sharpening = None;
    if processed || !levels.stairs {
        // rims show what was done to the picture, also where dots are too small for flat sides of a row's steps
        sharpening = sharpening::of_rims(&plane, outlines(&first.detection.targets).iter(), levels.saturation);
        processed |= sharpening.is_some();
        levels.developed = processed && !character.is_clipped();
    }
    let mut factors = first.correlate();
    let second = match processed {
        true => look_again(&plane, &levels, options, &first, sharpening, &mut factors),
        false => SecondLook::default(),
    };
    picture.softened = processed;
    if let Some(Sharpening { amount, radius }) = second.sharpening {
        (picture.sharpening, picture.sharpening_radius) = (amount, radius);
    }
    if factors[1] > 0.0 {
        picture.noise_correlation = (factors[0] / factors[1]).sqrt();
    }
    let coloured = first.coloured || processed;
    let mut detection = gather(&plane, &levels, options, processed, first, second);
    rims::settle(&plane, &levels, options, coloured, &mut detection);
    detection.targets.sort_by(|a, b| a.v.total_cmp(&b.v).then(a.u.total_cmp(&b.u)));
    let size = |pixels| u32::try_from(pixels).unwrap_or(u32::MAX);
    Detection { width: size(plane.width), height: size(plane.height), picture, ..detection }
}

/// What the second look at a processed photo found.
#[derive(Default)]
struct SecondLook {
    sharpening: Option<Sharpening>,
    softened: Pass,
    undone: Option<(View, Pass)>,
}

/// Looks at a processed photo again: with its sharpening undone if the rims show one, or else softened. What is found so may show a sharpening
/// in its turn, and is measured with that undone.
fn look_again<T: Sample>(
    plane: &SampleView<T>,
    levels: &GreyStatistics,
    options: &DetectOptions,
    first: &Pass,
    sharpening: Option<Sharpening>,
    factors: &mut [f64; 2],
) -> SecondLook {
    let known: Vec<Target> = first.detection.targets.iter().chain(&first.grounds).cloned().collect();
    let halved = second_look::search_halved(plane, levels, options);
    let mut view = View::of(plane, levels, sharpening);
    let mut found = view.look(plane, options, &known, &halved.candidates, &halved);
    add(factors, found.correlate());
    if sharpening.is_some() {
        return SecondLook { sharpening, softened: Pass::default(), undone: Some((view, found)) };
    }
    let both: Vec<Target> = known.iter().chain(&found.detection.targets).cloned().collect();
    let Some(sharpening) = sharpening::of_rims(plane, outlines(&both).iter(), levels.saturation) else {
        return SecondLook { sharpening: None, softened: found, undone: None };
    };
    let candidate =
        |target: &Target| Candidate { outline: outline_of(target), bright: target.polarity == Polarity::Bright };
    let candidates: Vec<Candidate> = found.detection.targets.iter().map(candidate).collect();
    let mut view = View::of(plane, levels, Some(sharpening));
    let mut undone = view.look(plane, options, &known, &candidates, &halved);
    add(factors, undone.correlate());
    let taken = outlines(&undone.detection.targets);
    found.detection.targets.retain(|target| taken.iter().all(|other| are_apart(&outline_of(target), other)));
    SecondLook { sharpening: Some(sharpening), softened: found, undone: Some((view, undone)) }
}

/// All targets of a photo with their codes, and what was rejected.
fn gather<T: Sample>(
    plane: &SampleView<T>,
    levels: &GreyStatistics,
    options: &DetectOptions,
    processed: bool,
    first: Pass,
    second: SecondLook,
) -> Detection {
    let (mut view, undone) = second.undone.map_or((None, Pass::default()), |(view, pass)| (Some(view), pass));
    let left = match options.codes {
        Codes::None => Vec::new(),
        _ => {
            let softened = second.softened.detection.targets.iter();
            let found = softened.chain(&undone.detection.targets);
            in_rings(plane, levels, options, processed, &first.doubtful, &first.detection.targets, found)
        }
    };
    let Pass { mut detection, mut grounds, occluded, .. } = first;
    for target in second.softened.detection.targets.into_iter().chain(undone.detection.targets.iter().cloned()) {
        search::tested_outlines::forget_rejected(&mut detection, &target);
        detection.targets.push(target);
    }
    grounds.extend(second.softened.grounds);
    // codes are read where their dots were measured: with the sharpening undone, or in the picture itself
    let of_undone = detection.targets.len() - undone.detection.targets.len()..detection.targets.len();
    let first_left = detection.targets.len();
    detection.targets.extend(left);
    let left = first_left..detection.targets.len();
    for target in occluded {
        if detection.targets.iter().all(|other| are_apart(&outline_of(other), &outline_of(&target))) {
            search::tested_outlines::forget_rejected(&mut detection, &target);
            detection.targets.push(target);
        }
    }
    let found = detection.targets.len();
    let mut add_grounds = |grounds: Vec<Target>| {
        for ground in grounds {
            // one pass's disc may be another's target
            if !detection.targets.iter().any(|other| is_same(other, &ground)) {
                detection.targets.push(ground);
            }
        }
        detection.targets.len()
    };
    let ground_of_undone = add_grounds(grounds)..add_grounds(undone.grounds);
    let size = plane.width.max(plane.height);
    let family = code::read_all(&mut detection.targets, options.codes, |k, target, families| match &mut view {
        Some(view) if of_undone.contains(&k) || ground_of_undone.contains(&k) => {
            view.read_code(plane, target, families)
        }
        _ => code::read(plane, size, target, target.quality.edge_width, families),
    });
    let taken_back = left.len() - code::keep_ringed(&mut detection, left, family);
    code::settle_grounds(&mut detection, found - taken_back, family);
    code::drop_parts(&mut detection, family);
    code::drop_sectors(&mut detection);
    detection
}

fn outlines(targets: &[Target]) -> Vec<Outline> {
    targets.iter().map(outline_of).collect()
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

fn add(sum: &mut [f64; 2], other: [f64; 2]) {
    *sum = [sum[0] + other[0], sum[1] + other[1]];
}

/// Small dots in rings of codes that only the picture itself shows: a mean joins them with their ring, and compression scatters their
/// edges. `own` are the targets found there, `others` those of the second look. Only a ring around them makes targets of them: letters have
/// such shapes too. Where a picture is not `processed` what lies around each was its background already.
fn in_rings<'a, T: Sample>(
    plane: &SampleView<T>,
    levels: &GreyStatistics,
    options: &DetectOptions,
    processed: bool,
    doubtful: &[Outline],
    own: &'a [Target],
    others: impl Iterator<Item = &'a Target>,
) -> Vec<Target> {
    let mut measure = Measure::new(*plane, *levels, options);
    measure.work.coloured = processed;
    let Some(common) = small_targets::of(&measure, own) else { return Vec::new() };
    let mut tested = TestedOutlines::new(plane.width, plane.height, code::have_spots(options.codes));
    own.iter().chain(others).for_each(|target| tested.know(target));
    let mut colours = Vec::new();
    let wanted = if processed { ExpectedShape::InRingOrWide } else { ExpectedShape::InRing };
    pass::take_small_targets(&mut measure, &mut tested, &mut colours, doubtful, &common, wanted);
    let mut left = Pass { detection: tested.finish(), colours, coloured: processed, ..Pass::default() };
    left.correlate();
    left.detection.targets
}
