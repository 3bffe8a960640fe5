//! Selects the first pair of networks without known points.
//!
//! Pairs that share many points are oriented relative to each other; the ones with many agreeing points and good
//! intersection angles become starts. A start is grown over a few photos, a core, which tells a true start from the
//! mirror solution of a plane or from a wrong principal distance; only a core that stands is grown over all photos.

use super::block::{Block, longer_side};
use super::growth::grow_to;
use super::refine::{Freedom, refine};
use crate::initial::Pose;
use crate::initial::relative::{Relative, relative_orientation};

/// Pairs that are oriented relative to each other, and starts that are grown at most.
const MOST_PAIRS: usize = 16;
const MOST_STARTS: usize = 8;
/// The same where no pair shares as many points as make a start by themselves: five to eight points fit more than one relative
/// orientation, and only what grows from each tells which is true.
const MANY: usize = 9;
const MOST_PAIRS_OF_FEW: usize = 64;
const MOST_STARTS_OF_FEW: usize = 64;
/// Angle, 20°, beyond which a pair gains nothing by a wider base.
const WIDE: f64 = 0.35;

/// A first pair with its relative orientation.
struct Start {
    photos: [usize; 2],
    relative: Relative,
    score: f64,
}

/// How good a grown network is: photos oriented, the noise that remains in pixels, measurements that agree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outcome {
    pub photos: usize,
    pub noise_px: f64,
    pub agreeing: usize,
    /// What the agreement tells: with every measurement that agrees, the logarithm of how much narrower the noise is than
    /// the photo. Few photos that fit to a tenth of a pixel tell more than all of them at twenty.
    pub told: f64,
}

/// Residuals, as a share of the photo, below which smaller ones tell nothing more.
const FINEST: f64 = 3e-5;
/// Share of the measurements that agree where nothing is wrong but names.
const MOSTLY: f64 = 0.7;

impl Outcome {
    pub fn of(block: &Block) -> Self {
        let (noise_px, agreeing) = (block.noise_px.unwrap_or(f64::INFINITY), block.agreeing());
        let side = block.cameras.iter().map(longer_side).fold(0.0, f64::max);
        let narrower = (side / noise_px.max(FINEST * side)).max(1.0).ln();
        Self { photos: block.oriented(), noise_px, agreeing, told: agreeing as f64 * narrower }
    }
}

/// Photos of a model that tells whether it started well, and what it takes to be sure: photos and spare observations.
const CORE: usize = 8;
const FEWEST_EVIDENT: usize = 5;
const SPARE: usize = 30;

impl Outcome {
    /// Whether the model stands beyond doubt, so that no other start is looked at: its residuals are measuring noise in
    /// more observations than it has unknowns to bend.
    pub fn is_evident(&self, block: &Block, fine_px: f64) -> bool {
        let all = block.views.iter().filter(|v| !v.sights.is_empty()).count();
        let (_, unknowns) = block.counts();
        self.photos >= FEWEST_EVIDENT.min(all)
            && self.noise_px <= fine_px
            && self.agreeing as f64 >= MOSTLY * block.offered() as f64
            && 2 * self.agreeing >= unknowns + SPARE
    }
}

/// Small models from the most promising first pairs, among photos that are not in `used`.
pub(super) struct Cores<'a> {
    block: &'a Block,
    starts: std::vec::IntoIter<Start>,
    fine_px: f64,
    few: bool,
}

impl<'a> Cores<'a> {
    pub fn new(block: &'a Block, used: &[bool], fine_px: f64) -> Self {
        let mut starts = starts(block, used);
        let few = starts.iter().all(|start| start.relative.inliers.len() < MANY);
        starts.truncate(if few { MOST_STARTS_OF_FEW } else { MOST_STARTS });
        Self { block, starts: starts.into_iter(), fine_px, few }
    }

    /// Whether no pair shares as many points as make a start by themselves.
    pub fn are_of_few(&self) -> bool {
        self.few
    }
}

impl Iterator for Cores<'_> {
    type Item = Block;

    fn next(&mut self) -> Option<Block> {
        let start = self.starts.next()?;
        let mut model = without_poses(self.block);
        let [first, second] = start.photos;
        model.views[first].pose = Some(Pose::identity());
        model.views[second].pose = Some(start.relative.pose);
        for ((a, b), taken) in model.common(first, second).into_iter().zip(&start.relative.inliers) {
            model.sights[a].taken = *taken;
            model.sights[b].taken = *taken;
        }
        grow_to(&mut model, CORE, Freedom::Distance);
        if model.noise_px.is_none_or(|noise| noise > self.fine_px) {
            refine(&mut model, Freedom::Everything);
        }
        Some(model)
    }
}

/// The block without poses and points, for a model of its own: what is oriented already comes in again by growth.
pub(super) fn without_poses(block: &Block) -> Block {
    let mut model = block.clone();
    model.anchored = false;
    model.views.iter_mut().for_each(|view| view.pose = None);
    model.marks.iter_mut().for_each(|mark| mark.xyz = None);
    model.noise_px = None;
    model
}

/// A core with all photos it reaches.
pub(super) fn grown_out(mut model: Block, fine_px: f64) -> Block {
    grow_to(&mut model, usize::MAX, Freedom::Everything);
    if model.noise_px.is_none_or(|noise| noise > fine_px) {
        refine(&mut model, Freedom::Everything);
    }
    model
}

/// Number of common points of every pair of unused photos, most first.
fn pairs(block: &Block, used: &[bool]) -> Vec<(usize, [usize; 2])> {
    let n = block.views.len();
    let mut counts = vec![0usize; n * n];
    for mark in &block.marks {
        for (k, &a) in mark.sights.iter().enumerate() {
            for &b in &mark.sights[k + 1..] {
                let (a, b) = (block.sights[a].photo, block.sights[b].photo);
                counts[a.min(b) * n + a.max(b)] += 1;
            }
        }
    }
    let free = |k: usize| !used[k];
    let mut pairs: Vec<(usize, [usize; 2])> = Vec::new();
    for a in 0..n {
        for b in a + 1..n {
            if counts[a * n + b] >= 5 && free(a) && free(b) {
                pairs.push((counts[a * n + b], [a, b]));
            }
        }
    }
    pairs.sort_by_key(|&(count, photos)| (std::cmp::Reverse(count), photos));
    pairs
}

fn starts(block: &Block, used: &[bool]) -> Vec<Start> {
    let mut starts: Vec<Start> = Vec::new();
    let pairs = pairs(block, used);
    // Pairs with nearly as many points as the best, spread over the list so that wide bases are among them.
    let most = pairs.first().map_or(0, |p| p.0);
    let rich = pairs.iter().take_while(|p| 10 * p.0 >= 6 * most).count();
    let limit = if most < MANY { MOST_PAIRS_OF_FEW } else { MOST_PAIRS };
    let chosen = rich.min(limit);
    let spread = (0..chosen).map(|k| k * rich / chosen.max(1)).chain(rich..pairs.len()).take(limit);
    for k in spread {
        let (_, photos) = pairs[k];
        let [first, second] = photos;
        let (a, b): (Vec<_>, Vec<_>) = block
            .common(first, second)
            .into_iter()
            .filter_map(|(a, b)| Some((block.sights[a].ray?, block.sights[b].ray?)))
            .unzip();
        let units = block.pixels_per_unit(first).min(block.pixels_per_unit(second));
        // Distances of noise alone; distortion widens the robust scale by itself.
        let Ok(found) = relative_orientation(&a, &b, 0.5 / units, k as u64) else { continue };
        for relative in found {
            let agreeing = relative.inliers.iter().filter(|taken| **taken).count();
            let score = agreeing as f64 * (relative.angle / WIDE).min(1.0);
            starts.push(Start { photos, relative, score });
        }
    }
    starts.sort_by(|a, b| b.score.total_cmp(&a.score));
    starts
}
