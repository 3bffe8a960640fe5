//! The search: one pass over the rows, at several levels of contrast.
//!
//! A weak edge must not break what strong ones enclose (noise inside a dark dot), and a weak target has no strong edges.
//! So the edges of a row are found once, with the lowest threshold, and linked several times: every level sees only the
//! edges above its own threshold, three times that of the level below. Few edges are left after the first step, so that
//! the levels cost little. The picture at a quarter of its size is searched in the same way for what is large or so far
//! out of focus that three pixels do not cross its edge.

use super::blob::{self, Limits, NoBlob};
use super::component::{self, Chord, Linker};
use super::look;
use super::noise::Levels;
use super::outline::Outline;
use super::scan;
use crate::detection::{DetectOptions, PolarityChoice, Reason};
use crate::image::{Plane, Sample};

/// A rough outline with its polarity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub outline: Outline,
    pub bright: bool,
    /// The first look at it, taken while its rows are still near the processor; none where they were not those of the photo.
    pub look: Option<Result<(), Reason>>,
}

/// Blobs that passed their tests, strong edges first, and the others.
#[derive(Default)]
pub(crate) struct Blobs {
    pub candidates: Vec<Candidate>,
    pub rejected: Vec<NoBlob>,
}

/// Levels of contrast, each three times the one below.
const LEVELS: u32 = 4;
/// From this diameter on the quartered picture is searched too.
const LARGE: f64 = 40.0;

/// Lowest difference over three pixels that is an edge.
pub(crate) fn threshold(levels: &Levels) -> f64 {
    (6.5 * levels.noise).max(0.03 * levels.range).max(5.0)
}

/// Searches a picture at its own and at a quarter of its size.
pub(crate) fn search<T: Sample>(plane: &Plane<T>, levels: &Levels, options: &DetectOptions) -> Blobs {
    let limits = Limits {
        min_diameter: options.min_diameter,
        max_diameter: options.max_diameter,
        width: plane.width,
        height: plane.height,
        step: 2,
    };
    let look = |outline: &Outline, bright| Some(look::first(plane, levels, outline, bright));
    let mut blobs = pass(plane, threshold(levels), levels.range, options.polarity, &limits, look);
    if options.max_diameter > LARGE && plane.width >= 32 && plane.height >= 32 {
        let (width, height, samples) = scan::quartered(plane);
        let limits = Limits {
            min_diameter: LARGE.max(options.min_diameter) / 4.0,
            max_diameter: options.max_diameter / 4.0,
            width,
            height,
            step: 1,
        };
        let threshold = (3.0 * levels.noise).max(0.03 * levels.range).max(4.0);
        let quarter = Plane::new(width, height, &samples);
        let found = pass(&quarter, threshold, levels.range, options.polarity, &limits, |_, _| None);
        blobs.candidates.extend(found.candidates.iter().map(|candidate| {
            let outline = candidate.outline.scaled(4.0);
            Candidate { outline: Outline { u: 4.0 * outline.u, v: 4.0 * outline.v, ..outline }, ..*candidate }
        }));
    }
    blobs
}

/// One picture, every `limits.step`-th row.
fn pass<T: Sample>(
    plane: &Plane<T>,
    threshold: f64,
    range: f64,
    polarity: PolarityChoice,
    limits: &Limits,
    look: impl Fn(&Outline, bool) -> Option<Result<(), Reason>>,
) -> Blobs {
    let wanted: &[bool] = match polarity {
        PolarityChoice::Auto => &[true, false],
        PolarityChoice::Bright => &[true],
        PolarityChoice::Dark => &[false],
    };
    let rows = (1.3 * limits.max_diameter / limits.step as f64).min(1e6) as usize + 8;
    let lowest = threshold.min(f64::from(T::MAX)) as u32;
    // a level above half the range would see hardly an edge
    let thresholds: Vec<u32> = (0..LEVELS)
        .map(|k| lowest.saturating_mul(3u32.pow(k)))
        .take_while(|&t| t == lowest || f64::from(t) < 0.5 * range)
        .collect();
    let mut levels: Vec<Level> = thresholds
        .iter()
        .map(|&threshold| Level {
            threshold,
            linkers: wanted.iter().map(|&bright| (bright, Linker::new(rows))).collect(),
            blobs: Blobs::default(),
        })
        .collect();
    let (mut edges, mut runs) = (Vec::new(), Vec::new());
    for y in (0..plane.height).step_by(limits.step) {
        scan::edges(plane.row(y), T::of(lowest), &mut edges);
        for level in &mut levels {
            edges.retain(|edge| edge.strength > level.threshold);
            for (bright, linker) in &mut level.linkers {
                component::runs(&edges, *bright, plane.width, y as f32 + 0.5, &mut runs);
                linker.row(&runs, &mut |chain| level.blobs.judge(chain, *bright, limits, &look));
            }
        }
    }
    let mut all = Blobs::default();
    for level in levels.iter_mut().rev() {
        for (bright, linker) in &mut level.linkers {
            linker.end(&mut |chain| level.blobs.judge(chain, *bright, limits, &look));
        }
        all.candidates.append(&mut level.blobs.candidates);
        all.rejected.append(&mut level.blobs.rejected);
    }
    all
}

/// What sees the edges above one threshold.
struct Level {
    threshold: u32,
    linkers: Vec<(bool, Linker)>,
    blobs: Blobs,
}

impl Blobs {
    fn judge(
        &mut self,
        chain: &[Chord],
        bright: bool,
        limits: &Limits,
        look: &impl Fn(&Outline, bool) -> Option<Result<(), Reason>>,
    ) {
        let candidate = |outline| Candidate { outline, bright, look: look(&outline, bright) };
        match blob::test(chain, limits) {
            Ok(outline) => self.candidates.push(candidate(outline)),
            Err(no) => {
                // two targets, one above the other, that touch: each may still be one
                if no.reason == Reason::NotAnEllipse
                    && let Some(neck) = blob::neck(chain)
                {
                    let parts = [&chain[..neck], &chain[neck + 1..]];
                    let outlines = parts.into_iter().filter_map(|part| blob::test(part, limits).ok());
                    self.candidates.extend(outlines.map(candidate));
                }
                self.rejected.push(no);
            }
        }
    }
}
