//! One pass over a picture: candidates of the search, their measurement, and occlusions.

use super::acceptance::outline::GAP_MINOR;
use super::acceptance::size::BLOB_SMALL;
use super::acceptance::small_targets::{ENOUGH, NOISY_RIMS};
use super::code;
use super::measure::Measure;
use super::outline::Outline;
use super::picture::noise::GreyStatistics;
use super::rendered::noise_autocorrelation::{NoiseAutocorrelation, NoiseProducts};
use super::search::blob::NoBlob;
use super::search::tested_outlines::TestedOutlines;
use super::search::{self, Blobs, Candidate};
use super::small_targets::{self, CommonProperties, ExpectedShape};
use crate::detection::{DetectOptions, Detection, Polarity, Reason, Target};
use crate::image::{Sample, SampleView};

/// Result of one pass over a picture.
#[derive(Default)]
pub(super) struct Pass {
    pub detection: Detection,
    /// Targets that may be the background of a code's ring, to be settled when codes are read.
    pub grounds: Vec<Target>,
    /// Noise autocorrelation of the targets at these positions.
    pub colours: Vec<([f64; 2], NoiseProducts)>,
    /// Outlines that were rejected when tested alone.
    pub doubtful: Vec<Outline>,
    /// Targets of which something hides a part: what nothing else is found at is reported.
    pub occluded: Vec<Target>,
    /// Whether its pixels were taken to share their noise.
    pub coloured: bool,
}

impl Pass {
    /// Puts the correlation of neighbouring pixels into the covariances: sum of the factors by which they grow, and their number. What
    /// few targets show of it may be chance, and promises nothing. A target that shows nothing of it itself has the median of the factors.
    pub fn correlate(&mut self) -> [f64; 2] {
        let Some(correlation) = NoiseAutocorrelation::of(self.colours.iter().map(|(_, colour)| colour)) else {
            return [0.0; 2];
        };
        let least = if self.colours.len() < ENOUGH { 1.0 } else { 0.0 };
        let own = |target: &Target| {
            let own = self.colours.iter().find(|(place, _)| *place == [target.u, target.v]);
            own.map(|(_, colour)| correlation.factor(colour).max(least))
        };
        let factors: Vec<Option<f64>> = self.detection.targets.iter().map(own).collect();
        let usual = median(factors.iter().copied().flatten().collect());
        let mut all = [0.0; 2];
        for (target, own) in self.detection.targets.iter_mut().zip(factors) {
            // one whose own pixels do not tell has the noise of the others
            let Some(factor) = own.or(usual) else { continue };
            widen(target, factor.sqrt());
            all = [all[0] + factor, all[1] + 1.0];
        }
        all
    }
}

/// One pass over a picture. `coloured`: whether neighbouring pixels may share their noise.
pub(super) fn pass<T: Sample>(
    plane: SampleView<T>,
    levels: GreyStatistics,
    options: &DetectOptions,
    coloured: bool,
) -> Pass {
    let blobs = search::search(&plane, &levels, options, true);
    let mut tested = TestedOutlines::new(plane.width, plane.height, code::have_spots(options.codes));
    tested.expect(blobs.iter().map(|blobs| blobs.shapeless.len() + blobs.unlike.len()).sum());
    for Blobs { shapeless, unlike, too_small, too_large, .. } in &blobs {
        tested.add(Reason::TooSmall, *too_small);
        tested.add(Reason::TooLarge, *too_large);
        for no in shapeless.iter().chain(unlike) {
            tested.count(no);
        }
    }
    let mut measure = Measure::new(plane, levels, options);
    measure.work.coloured = coloured;
    let (mut colours, mut uneven) = (Vec::new(), Vec::new());
    let mut doubtful: Vec<Outline> = Vec::new();
    let mut occluded: Vec<Candidate> = Vec::new();
    for candidate in blobs.iter().flat_map(|blobs| &blobs.candidates) {
        if !tested.is_new(candidate) {
            continue;
        }
        let Candidate { outline, bright } = candidate;
        match measure.confirm(outline, *bright).and_then(|found| measure.finish(&found, options.method)) {
            Ok(target) => {
                colours.extend(measure.work.noise_products().map(|colour| ([target.u, target.v], colour)));
                uneven.push(measure.uneven);
                tested.accept(target, *bright);
            }
            Err(reason) => {
                doubtful.push(*outline);
                if matches!(reason, Reason::NotAnEllipse | Reason::Touching | Reason::NoFit) {
                    occluded.push(*candidate);
                }
                tested.reject(*outline, *bright, reason);
            }
        }
    }
    occluded.extend(blobs.iter().flat_map(|blobs| &blobs.partial));
    let mut hidden = Vec::new();
    for Candidate { outline, bright } in &occluded {
        if !tested.is_free(outline) {
            continue;
        }
        match measure.occluded_target(outline, *bright) {
            Some(target) if target.minor >= GAP_MINOR => hidden.push(target),
            // of what is small, gravel and letters have such rims too
            Some(target) => tested.hide(&code::outline_of(&target)),
            None => {}
        }
    }
    let shapeless = blobs.iter().flat_map(|blobs| blobs.unlike.iter().chain(&blobs.shapeless));
    doubtful.extend(shapeless.filter_map(|no| disc(no, options)));
    // a processed picture is looked at again softened, where such rims hide nothing
    let rim_noise = if measure.work.coloured { 1.0 } else { small_targets::rim_noise(uneven, &measure.levels) };
    let [shared, hiding] = NOISY_RIMS;
    if rim_noise > shared {
        measure.work.coloured = true;
        colours = measured_again(&mut measure, &mut tested.targets);
        if colours.is_empty() {
            // none tells what its pixels share: the noise of the rims is all that is known
            tested.targets.iter_mut().for_each(|target| widen(target, rim_noise));
        }
    }
    if let Some(common) = small_targets::of(&measure, &tested.targets) {
        if common.swallows() {
            take_small_targets(&mut measure, &mut tested, &mut colours, &doubtful, &common, ExpectedShape::Disc);
        } else if rim_noise > hiding {
            // noise makes small shapes look like discs: texture that is like one is smaller or flatter than what is asked for
            let large = |outline: &&Outline| 2.0 * outline.semi_axes().1 >= options.min_diameter;
            let large: Vec<Outline> = doubtful.iter().filter(large).copied().collect();
            take_small_targets(&mut measure, &mut tested, &mut colours, &large, &common, ExpectedShape::Disc);
        }
    }
    let grounds = std::mem::take(&mut tested.grounds);
    let coloured = measure.work.coloured;
    Pass { detection: tested.finish(), grounds, colours, doubtful, occluded: hidden, coloured }
}

/// Multiplies the standard errors of a target.
pub(super) fn widen(target: &mut Target, factor: f64) {
    target.sigma_u *= factor;
    target.sigma_v *= factor;
    target.covariance_uv *= factor * factor;
}

/// The middle one of some values.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// Measures the targets of a picture again, now with the correlation of neighbouring pixels' noise, and returns that correlation for each. A target
/// that cannot be measured again is left as it is; its standard errors take the median factor of the others ([`Pass::correlate`]).
fn measured_again<T: Sample>(measure: &mut Measure<T>, targets: &mut [Target]) -> Vec<([f64; 2], NoiseProducts)> {
    let mut colours = Vec::new();
    for target in targets {
        let found = measure.confirm(&code::outline_of(target), target.polarity == Polarity::Bright);
        if let Ok(again) = found.and_then(|found| measure.finish(&found, measure.options.method)) {
            *target = again;
            colours.extend(measure.work.noise_products().map(|colour| ([target.u, target.v], colour)));
        }
    }
    colours
}

/// The outline, as far as it is known, of something without a shape that may still be a target by what the others show.
pub(super) fn disc(no: &NoBlob, options: &DetectOptions) -> Option<Outline> {
    let radius = no.diameter / 2.0;
    let round = || Outline::from_axes(no.u, no.v, radius, radius, 0.0);
    // blur makes small discs look larger, noise smaller
    let possible = BLOB_SMALL * options.min_diameter..options.max_diameter;
    possible.contains(&no.diameter).then(|| no.outline.unwrap_or_else(round))
}

/// Takes those of the doubtful outlines for targets that are like the others.
pub(super) fn take_small_targets<T: Sample>(
    measure: &mut Measure<T>,
    tested: &mut TestedOutlines,
    colours: &mut Vec<([f64; 2], NoiseProducts)>,
    doubtful: &[Outline],
    common: &CommonProperties,
    wanted: ExpectedShape,
) {
    for outline in doubtful.iter().filter(|outline| outline.is_proper()) {
        if !tested.is_free(outline) {
            continue;
        }
        if let Ok(target) = measure.small_target(outline, common, wanted) {
            colours.extend(measure.work.noise_products().map(|colour| ([target.u, target.v], colour)));
            tested.reconsider(target, common.bright);
        }
    }
}
