//! One pass over a picture: candidates of the search, their measurement, and occlusions.

use super::acceptance::alike::{ENOUGH, NOISY_RIMS};
use super::acceptance::size::{ALIKE_LARGE, ALIKE_SMALL};
use super::alike::{self, Alike, Wanted};
use super::code;
use super::covered::Covered;
use super::measure::Measure;
use super::outline::Outline;
use super::picture::noise::Levels;
use super::rendered::colour::{Colour, Correlation};
use super::search::blob::NoBlob;
use super::search::census::Census;
use super::search::{self, Blobs, Candidate, Hidden};
use crate::detection::{DetectOptions, Detection, Polarity, Reason, Target};
use crate::image::{Plane, Sample};

/// What one pass over a picture found.
#[derive(Default)]
pub(super) struct Pass {
    pub detection: Detection,
    /// Targets that may be the ground of a code's ring, to be settled when codes are read.
    pub grounds: Vec<Target>,
    /// What neighbouring pixels share, of the targets at these places.
    pub colours: Vec<([f64; 2], Colour)>,
    /// Outlines that were no targets by themselves.
    pub doubtful: Vec<Outline>,
    /// Whether its pixels were taken to share their noise.
    pub coloured: bool,
}

/// What a picture that was made of another one shows of that one's targets: times their contrast, and blurred by so many pixels.
#[derive(Clone, Copy)]
pub(super) struct Soft {
    pub scale: f64,
    pub blur: f64,
}

impl Pass {
    /// Puts the correlation of neighbouring pixels into the covariances: sum of the factors by which they grow, and their number. What
    /// few targets show of it may be chance, and promises nothing. A target that shows nothing of it itself has the median of the factors.
    pub fn correlate(&mut self) -> [f64; 2] {
        let Some(correlation) = Correlation::of(self.colours.iter().map(|(_, colour)| colour)) else { return [0.0; 2] };
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

/// One pass: what is found beyond the targets that are known.
pub(super) fn pass<T: Sample>(
    plane: Plane<T>,
    levels: Levels,
    options: &DetectOptions,
    coloured: bool,
    soft: Option<Soft>,
    known: &[Target],
) -> Pass {
    let blobs = search::search(&plane, &levels, options, Hidden::Clear);
    let mut census = Census::new(plane.width, plane.height, code::have_spots(options.codes));
    known.iter().for_each(|target| census.know(target));
    census.expect(blobs.iter().map(|blobs| blobs.shapeless.len() + blobs.unlike.len()).sum());
    for Blobs { shapeless, unlike, too_small, too_large, .. } in &blobs {
        census.add(Reason::TooSmall, *too_small);
        census.add(Reason::TooLarge, *too_large);
        for no in shapeless.iter().chain(unlike) {
            census.count(no);
        }
    }
    let mut measure = Measure::new(plane, levels, options);
    measure.work.coloured = coloured;
    measure.work.mean = soft.map_or(0.0, |soft| soft.blur);
    let (mut colours, mut uneven) = (Vec::new(), Vec::new());
    let mut doubtful: Vec<Outline> = Vec::new();
    let mut covered: Vec<Candidate> = Vec::new();
    for candidate in blobs.iter().flat_map(|blobs| &blobs.candidates) {
        if !census.is_new(candidate) {
            continue;
        }
        let Candidate { outline, bright } = candidate;
        match measure.confirm(outline, *bright).and_then(|found| measure.finish(&found, options.method)) {
            Ok(target) => {
                colours.extend(measure.colour.take().map(|colour| ([target.u, target.v], colour)));
                uneven.push(measure.uneven);
                census.accept(target, *bright);
            }
            Err(reason) => {
                doubtful.push(*outline);
                if matches!(reason, Reason::NotAnEllipse | Reason::Touching | Reason::NoFit | Reason::Occluded) {
                    covered.push(*candidate);
                }
                census.reject(*outline, *bright, reason);
            }
        }
    }
    covered.extend(blobs.iter().flat_map(|blobs| &blobs.partial));
    // what is known is certain, what was found beside it is judged by it later
    let clear = match soft {
        Some(soft) if known.len() >= ENOUGH => are_clear(&levels, known, soft),
        _ => are_clear(&levels, &census.targets, Soft { scale: 1.0, blur: 0.0 }),
    };
    if !clear {
        let faint = search::search(&plane, &levels, options, Hidden::Faint);
        covered.extend(faint.into_iter().flat_map(|blobs| blobs.partial));
    }
    for Candidate { outline, bright } in &covered {
        if !census.is_free(outline) {
            continue;
        }
        match measure.uncovered(outline, *bright) {
            Ok(found) => match measure.finish(&found, options.method) {
                Ok(target) => {
                    colours.extend(measure.colour.take().map(|colour| ([target.u, target.v], colour)));
                    census.reconsider(target, *bright);
                }
                Err(_) => census.hide(&found.ellipse.outline),
            },
            Err(Covered::Hidden(outline)) => census.hide(&outline),
            Err(Covered::No) => {}
        }
    }
    let shapeless = blobs.iter().flat_map(|blobs| blobs.unlike.iter().chain(&blobs.shapeless));
    doubtful.extend(shapeless.filter_map(|no| disc(no, options)));
    // a processed picture is looked at softened, too, where such rims hide nothing
    let rim_noise = if measure.work.coloured { 1.0 } else { alike::rim_noise(uneven, &measure.levels) };
    let [shared, hiding] = NOISY_RIMS;
    if rim_noise > shared {
        measure.work.coloured = true;
        colours = measured_again(&mut measure, &mut census.targets);
        if colours.is_empty() {
            // none tells what its pixels share: the noise of the rims is all that is known
            census.targets.iter_mut().for_each(|target| widen(target, rim_noise));
        }
    }
    if let Some(alike) = alike::of(&mut measure, known, &census.targets) {
        if soft.is_some() || alike.swallows() {
            take_alike(&mut measure, &mut census, &mut colours, &doubtful, &alike, Wanted::Disc);
        } else if rim_noise > hiding {
            // what noise has hidden is a disc to the eye: texture that is like one is smaller or flatter than what is asked for
            let large = |outline: &&Outline| 2.0 * outline.semi_axes().1 >= options.min_diameter;
            let large: Vec<Outline> = doubtful.iter().filter(large).copied().collect();
            take_alike(&mut measure, &mut census, &mut colours, &large, &alike, Wanted::Disc);
        }
    }
    let grounds = std::mem::take(&mut census.grounds);
    let coloured = measure.work.coloured;
    Pass { detection: census.finish(), grounds, colours, doubtful, coloured }
}

/// Multiplies the standard errors of a target.
fn widen(target: &mut Target, factor: f64) {
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
fn measured_again<T: Sample>(measure: &mut Measure<T>, targets: &mut [Target]) -> Vec<([f64; 2], Colour)> {
    let mut colours = Vec::new();
    for target in targets {
        let found = measure.confirm(&code::outline_of(target), target.polarity == Polarity::Bright);
        if let Ok(again) = found.and_then(|found| measure.finish(&found, measure.options.method)) {
            *target = again;
            colours.extend(measure.colour.take().map(|colour| ([target.u, target.v], colour)));
        }
    }
    colours
}

/// Whether targets are enough, and all of them so clear that covered ones of the same photo are seen above the lowest level.
fn are_clear(levels: &Levels, targets: &[Target], Soft { scale, blur }: Soft) -> bool {
    let is_clear = |t: &Target| search::is_clear(levels, scale * t.contrast.abs(), t.quality.edge_width.hypot(blur));
    targets.len() >= ENOUGH && targets.iter().all(is_clear)
}

/// The outline, as far as it is known, of something without a shape that may still be a target by what the others show.
fn disc(no: &NoBlob, options: &DetectOptions) -> Option<Outline> {
    let sizes = ALIKE_SMALL * options.min_diameter..ALIKE_LARGE * options.max_diameter;
    let radius = no.diameter / 2.0;
    let round = || Outline::from_axes(no.u, no.v, radius, radius, 0.0);
    (sizes.start < no.diameter && no.diameter < sizes.end).then(|| no.outline.unwrap_or_else(round))
}

/// Takes those of the doubtful outlines for targets that are like the others.
pub(super) fn take_alike<T: Sample>(
    measure: &mut Measure<T>,
    census: &mut Census,
    colours: &mut Vec<([f64; 2], Colour)>,
    doubtful: &[Outline],
    alike: &Alike,
    wanted: Wanted,
) {
    for outline in doubtful.iter().filter(|outline| outline.is_proper()) {
        if !census.is_free(outline) {
            continue;
        }
        if let Ok(target) = measure.alike(outline, alike, wanted) {
            colours.extend(measure.colour.take().map(|colour| ([target.u, target.v], colour)));
            census.reconsider(target, alike.bright);
        }
    }
}
