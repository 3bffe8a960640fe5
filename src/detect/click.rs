//! Measures one target at a click: found in windows of growing size, then measured in the photo.

use super::measure::{Measure, PreliminaryTarget};
use super::picture::noise::{self, GreyStatistics};
use super::rims::{self, Donut};
use super::search;
use super::window::Window;
use super::{Outline, SampleView, code};
use crate::detect::acceptance::place::BESIDE;
use crate::detection::{Codes, DetectOptions, Method, MethodResult, Target};
use crate::image::Sample;

/// Sizes of the window in pixels; the next one is tried when the click hits no target in the last.
const WINDOWS: [usize; 3] = [64, 192, 1000];
/// The last window where codes are read: small dots in rings are found by what many others have in common.
const LAST: usize = 2000;

/// What a click says is a target is judged by so many times the noise of the flat background, where nothing else is found: at rims a camera's
/// denoising leaves up to that much more, and the fit's own residuals tell the standard error.
const NOISE_AT_RIMS: [f64; 2] = [2.5, 6.0];

/// The target under the click, or the nearest one within a few pixels of it.
pub(super) fn measure<T: Sample>(plane: SampleView<T>, u: f64, v: f64, options: &DetectOptions) -> Option<Target> {
    let method = options.method;
    let mut found = at(plane, u, v, options, 1.0, |measure, found| measure.finish(found, method).ok());
    code::read_in(&plane, found.as_mut_slice(), options.codes);
    let is_settled =
        |target: &Target| options.codes == Codes::None || target.code.is_some() || !target.code_candidates.is_empty();
    let donut = |target| rims::settle_one(&plane, options, target);
    if found.as_ref().is_some_and(is_settled) {
        return found.and_then(donut);
    }
    // a dot may be measured otherwise, and read, where others in the photo indicate it
    let coded = |target: &Target| found.is_none() || target.code.is_some();
    let noisy = |noise| at(plane, u, v, options, noise, |measure, found| measure.finish(found, method).ok());
    let ordinary = in_ordinary(plane, u, v, options).filter(coded);
    ordinary.or_else(|| found.and_then(donut)).or_else(|| NOISE_AT_RIMS.into_iter().find_map(noisy).and_then(donut))
}

/// The target under the click in a processed photo: searched as the whole picture would be, in windows.
fn in_ordinary<T: Sample>(plane: SampleView<T>, u: f64, v: f64, options: &DetectOptions) -> Option<Target> {
    let last = (options.codes != Codes::None).then_some(LAST);
    WINDOWS.into_iter().skip(1).chain(last).find_map(|size| {
        let Window { left, top, width, height, samples } = Window::of(&plane, u, v, size);
        let away = |target: &Target| {
            let outline = code::outline_of(target);
            let [c, s] = outline.grown(BESIDE).normalised(u, v);
            (c.hypot(s) <= 1.0).then(|| (outline.u - u).hypot(outline.v - v))
        };
        let found = super::detect_in(SampleView::new(width, height, &samples), options).targets.into_iter();
        let shifted = found.map(|target| target.moved([left as f64, top as f64]));
        let hit = shifted.filter_map(|target| away(&target).map(|distance| (distance, target)));
        hit.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, target)| target)
    })
}

/// Every method's measurement of the target under the click.
pub(super) fn compare<T: Sample>(plane: SampleView<T>, u: f64, v: f64, options: &DetectOptions) -> Vec<MethodResult> {
    let all = [Method::LeastSquares, Method::Ellipse, Method::Intensity, Method::Gradient];
    let results = |[u, v]: [f64; 2], noise| {
        at(plane, u, v, options, noise, |measure, found| {
            let target = measure.finish(found, Method::LeastSquares).ok()?;
            let donut = Donut::around(&plane, &measure.levels, options, &target, false);
            Some(all.map(|method| {
                let measured = match &donut {
                    Some(donut) => donut.measured(options, method).map(|(target, _)| target),
                    None => measure.finish(found, method),
                };
                match measured {
                    Ok(target) => MethodResult { method, target: Some(target), reason: None },
                    Err(reason) => MethodResult { method, target: None, reason: Some(reason) },
                }
            }))
        })
    };
    let found = results([u, v], 1.0).or_else(|| NOISE_AT_RIMS.into_iter().find_map(|noise| results([u, v], noise)));
    // beside the hole of a donut
    let in_hole = || results(measure(plane, u, v, options)?.inner.map(|inner| [inner.u, inner.v])?, 1.0);
    found.or_else(in_hole).map(Vec::from).unwrap_or_default()
}

/// Finds the blobs of a window around the place and hands the one that the click means to `finish`, judged by so many times the noise of
/// the flat background.
fn at<T: Sample, R>(
    plane: SampleView<T>,
    u: f64,
    v: f64,
    options: &DetectOptions,
    noise: f64,
    mut finish: impl FnMut(&mut Measure<T>, &PreliminaryTarget) -> Option<R>,
) -> Option<R> {
    for size in WINDOWS {
        let Window { left, top, width, height, samples } = Window::of(&plane, u, v, size);
        let part = SampleView::new(width, height, &samples);
        let levels = noise::levels(&part);
        let mut candidates: Vec<(f64, Outline, bool)> = search::search(&part, &levels, options, false)
            .into_iter()
            .flat_map(|blobs| blobs.candidates)
            .map(|candidate| {
                let outline = candidate.outline;
                let outline = Outline { u: outline.u + left as f64, v: outline.v + top as f64, ..outline };
                ((outline.u - u).hypot(outline.v - v), outline, candidate.bright)
            })
            .filter(|(_, outline, _)| {
                let [c, s] = outline.grown(BESIDE).normalised(u, v);
                c.hypot(s) <= 1.0
            })
            .collect();
        candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
        let levels = GreyStatistics { noise: noise * levels.noise, ..levels };
        let mut measure = Measure::new(plane, levels, options);
        for (_, outline, bright) in candidates {
            let found = measure.confirm(&outline, bright).ok();
            if let Some(result) = found.and_then(|found| finish(&mut measure, &found)) {
                return Some(result);
            }
        }
        if width == plane.width && height == plane.height {
            break;
        }
    }
    None
}
