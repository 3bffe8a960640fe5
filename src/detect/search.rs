//! The search: one pass over the rows, at several levels of contrast.
//!
//! A weak edge must not break what strong ones enclose (noise inside a dark dot), and a weak target has no strong edges.
//! So the edges of a row are found once, with the lowest threshold, and linked several times: every level sees only the
//! edges above its own threshold, three times that of the level below; the highest are shares of the picture's range, for
//! what lies before a target in a tone of its own. Few edges are left after the first step, so that the levels cost little.
//! The picture at a quarter of its size is searched in the same way, in every second of its rows
//! too, for what is large or so far out of focus that three pixels do not cross its edge.

pub(crate) mod blob;
mod component;
mod partial;
mod scan;
pub(crate) mod tested_outlines;

use std::collections::HashSet;

use self::blob::{BlobLimits, NoBlob};
use self::component::{Chord, Linker};
use self::scan::Edge;
use super::acceptance::picture::{QUARTERED, SEARCHED, STRONG};
use super::acceptance::size::{BLOB_LARGE, LARGE, SEARCHED_FLAT};
use super::edges::quick_test;
use super::ellipse::outline::Outline;
use super::picture::noise::GreyStatistics;
use crate::detection::{DetectOptions, PolarityChoice, Reason};
use crate::image::{Sample, SampleView};

/// A rough outline with its polarity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub outline: Outline,
    pub bright: bool,
}

/// Blobs that passed their tests and the first look at them, and the others. Those that are too small or too large are many, and
/// only counted.
#[derive(Default)]
pub(crate) struct Blobs {
    pub candidates: Vec<Candidate>,
    /// Ellipses that only a part of a blob's border follows: what is occluded in part, or joined with what covers it.
    pub partial: Vec<Candidate>,
    /// Blobs without a clear shape, and blobs with too little contrast.
    pub shapeless: Vec<NoBlob>,
    pub unlike: Vec<NoBlob>,
    pub too_small: usize,
    pub too_large: usize,
    /// Whether occluded ones are looked for.
    hidden: bool,
}

/// Levels of contrast, each three times the one below, up to the strong ones.
const LEVELS: u32 = 4;

/// Axis ratio from which on outlines of the search go on to be measured.
fn flattest(options: &DetectOptions) -> f64 {
    SEARCHED_FLAT * options.min_axis_ratio
}

/// Largest of a multiple of the noise, a share of the range and a number of levels.
fn above(levels: &GreyStatistics, [noise, range, least]: [f64; 3]) -> f64 {
    (noise * levels.noise).max(range * levels.range).max(least)
}

/// Lowest difference over three pixels that is an edge.
pub(crate) fn threshold(levels: &GreyStatistics) -> f64 {
    above(levels, SEARCHED)
}

/// The levels from the lowest on, and how many of them are strong.
fn thresholds(lowest: f64, range: f64) -> (Vec<u32>, usize) {
    let lowest = lowest.min(65535.0) as u32;
    let thrice = (0..LEVELS).map(|k| lowest.saturating_mul(3u32.pow(k)));
    let mut all: Vec<u32> = thrice.take_while(|&t| t == lowest || f64::from(t) < STRONG[0] * range).collect();
    let (steps, highest) = (all.len(), all.last().copied());
    all.extend(STRONG.map(|share| (share * range) as u32).iter().filter(|t| Some(**t) > highest));
    let strong = all.len() - steps;
    (all, strong)
}

/// Searches a picture at its own and at a quarter of its size, row by row: each is fetched from memory once. Blobs of strong
/// edges come first, then those of the levels that are shares of the range, those of the quartered picture last. `hidden`: whether targets
/// that something hides in part are looked for, whose edges reach above the lowest level: most of what has no shape is on the lowest.
pub(crate) fn search<T: Sample>(
    plane: &SampleView<T>,
    levels: &GreyStatistics,
    options: &DetectOptions,
    hidden: bool,
) -> Vec<Blobs> {
    let limits = BlobLimits {
        min_diameter: options.min_diameter,
        max_diameter: options.max_diameter,
        flattest: flattest(options),
        width: plane.width,
        height: plane.height,
        step: 2,
    };
    let look = |outline: &Outline, bright| quick_test::first(plane, levels, outline, bright);
    let new = |lowest, limits| LevelScan::new(thresholds(lowest, levels.range), options.polarity, limits, hidden);
    let mut whole = new(threshold(levels), limits);
    let limits = BlobLimits {
        min_diameter: LARGE.max(options.min_diameter) / 4.0,
        max_diameter: options.max_diameter / 4.0,
        flattest: flattest(options),
        width: plane.width / 4,
        height: plane.height / 4,
        step: 2,
    };
    let large = options.max_diameter > LARGE && plane.width >= 32 && plane.height >= 32;
    let mut quarter = large.then(|| new(above(levels, QUARTERED), limits));
    let mut reduced = Vec::new();
    let look_enlarged = |outline: &Outline, bright| look(&enlarged(outline), bright);
    for y in (0..plane.height).step_by(whole.limits.step) {
        whole.row(plane.row(y), y, &look);
        if let Some(quarter) = &mut quarter
            && y % (4 * limits.step) == 2
            && y / 4 < limits.height
        {
            scan::quartered(plane.row(y - 2), plane.row(y), &mut reduced);
            quarter.row(&reduced, y / 4, &look_enlarged);
        }
    }
    let mut blobs = whole.end(&look);
    for mut found in quarter.map(|quarter| quarter.end(&look_enlarged)).unwrap_or_default() {
        for candidate in found.candidates.iter_mut().chain(&mut found.partial) {
            candidate.outline = enlarged(&candidate.outline);
        }
        for no in &mut found.unlike {
            let [u, v] = enlarged_place(no.u, no.v);
            *no = NoBlob { u, v, diameter: 4.0 * no.diameter, outline: no.outline.map(|o| enlarged(&o)), ..*no };
        }
        // what has no shape there is seen in the whole picture
        blobs.push(Blobs {
            candidates: found.candidates,
            partial: found.partial,
            unlike: found.unlike,
            ..Blobs::default()
        });
    }
    blobs
}

/// A place in the quartered picture as it is in the whole one: of four rows the first and the third were taken.
fn enlarged_place(u: f64, v: f64) -> [f64; 2] {
    [4.0 * u, 4.0 * v - 0.5]
}

/// The same of an outline.
fn enlarged(outline: &Outline) -> Outline {
    let [u, v] = enlarged_place(outline.u, outline.v);
    Outline { u, v, ..outline.scaled(4.0) }
}

/// State of the scan of one picture, row by row.
struct LevelScan {
    limits: BlobLimits,
    levels: Vec<Level>,
    /// How many of them are shares of the range.
    strong: usize,
    edges: Vec<Edge>,
    runs: Vec<Chord>,
    /// Blobs without a shape that were examined closely: other levels see many of them again.
    tried: HashSet<[u32; 6]>,
}

/// The search for edges above one threshold.
struct Level {
    threshold: u32,
    linkers: Vec<(bool, Linker)>,
    blobs: Blobs,
}

impl LevelScan {
    fn new(
        (thresholds, strong): (Vec<u32>, usize),
        polarity: PolarityChoice,
        limits: BlobLimits,
        hidden: bool,
    ) -> Self {
        let wanted: &[bool] = match polarity {
            PolarityChoice::Auto => &[true, false],
            PolarityChoice::Bright => &[true],
            PolarityChoice::Dark => &[false],
        };
        let rows = (BLOB_LARGE * limits.max_diameter / limits.step as f64).min(1e6) as usize + 8;
        let single = thresholds.len() == 1;
        let levels = thresholds.into_iter().enumerate().map(|(k, threshold)| Level {
            threshold,
            linkers: wanted.iter().map(|&bright| (bright, Linker::new(rows))).collect(),
            blobs: Blobs { hidden: hidden && (k > 0 || single), ..Blobs::default() },
        });
        Self { limits, levels: levels.collect(), strong, edges: Vec::new(), runs: Vec::new(), tried: HashSet::new() }
    }

    /// Takes the next row, the y-th of the picture.
    #[inline(never)]
    fn row<T: Sample>(&mut self, samples: &[T], y: usize, look: &impl Fn(&Outline, bool) -> Result<(), Reason>) {
        let Self { limits, levels, edges, runs, tried, .. } = self;
        let lowest = levels.first().map_or(T::MAX, |level| level.threshold.min(T::MAX));
        scan::edges(samples, T::of(lowest), edges);
        for level in levels {
            edges.retain(|edge| edge.strength > level.threshold);
            for (bright, linker) in &mut level.linkers {
                component::runs(edges, *bright, limits.width, y as f32 + 0.5, runs);
                linker.row(runs, &mut |chain| level.blobs.judge(chain, *bright, limits, look, tried));
            }
        }
    }

    /// The blobs of each level, strong edges first; but of those that are shares of the range last: they cut small outlines short.
    fn end(self, look: &impl Fn(&Outline, bool) -> Result<(), Reason>) -> Vec<Blobs> {
        let Self { limits, levels, strong, mut tried, .. } = self;
        let all = levels.into_iter().rev().map(|mut level| {
            for (bright, linker) in &mut level.linkers {
                linker.end(&mut |chain| level.blobs.judge(chain, *bright, &limits, look, &mut tried));
            }
            level.blobs
        });
        let mut all: Vec<Blobs> = all.collect();
        all.rotate_left(strong);
        all
    }
}

impl Blobs {
    fn judge(
        &mut self,
        chain: &[Chord],
        bright: bool,
        limits: &BlobLimits,
        look: &impl Fn(&Outline, bool) -> Result<(), Reason>,
        tried: &mut HashSet<[u32; 6]>,
    ) {
        let tested = blob::test(chain, limits);
        // what was taken for a spot may be what lies before a target, or between two
        if tested.is_err() && component::apart(chain, &mut |part| self.judge(part, bright, limits, look, tried)) {
            return;
        }
        // looked at while its rows are still near the processor
        let mut enter = |outline| match look(&outline, bright) {
            Ok(()) => self.candidates.push(Candidate { outline, bright }),
            Err(reason) => self.unlike.push(NoBlob::of(&outline, reason)),
        };
        match tested {
            Ok(outline) => enter(outline),
            Err(no) => {
                // two targets, one above the other, that touch: each may still be one
                if no.reason == Reason::NotAnEllipse
                    && let Some(neck) = blob::neck(chain)
                {
                    let parts = [&chain[..neck], &chain[neck + 1..]];
                    let outlines = parts.into_iter().filter_map(|part| blob::test(part, limits).ok());
                    outlines.for_each(&mut enter);
                }
                // one that is occluded in part, divided, or joined with what lies in front of it
                if self.hidden
                    && no.reason == Reason::NotAnEllipse
                    && let [first, .., last] = chain
                    && tried.insert([first.x0, first.x1, first.y, last.x0, last.x1, last.y].map(f32::to_bits))
                {
                    let most = partial::most(chain, limits);
                    self.partial.extend(most.map(|outline| Candidate { outline, bright }));
                }
                match no.reason {
                    Reason::TooSmall => self.too_small += 1,
                    Reason::TooLarge => self.too_large += 1,
                    _ => self.shapeless.push(no),
                }
            }
        }
    }
}
