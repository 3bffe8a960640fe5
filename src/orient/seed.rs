//! Selects the first pair of networks without known points.
//!
//! Pairs that share many points are oriented relative to each other; the ones with many agreeing points and good
//! intersection angles become starts. A start is grown over a few photos, a core, which distinguishes a true start from the
//! mirror solution of a plane or from a wrong principal distance; only a certain core is grown over all photos.

use super::block::{OrientationBlock, longer_side};
use super::growth::grow_to;
use super::refine::{Freedom, refine};
use crate::initial::Pose;
use crate::initial::relative::{Relative, relative_orientation};

/// Maximum number of pairs that are oriented relative to each other, and of starts that are grown.
const MOST_PAIRS: usize = 16;
const MOST_STARTS: usize = 8;
/// The same if no pair shares enough points for a unique start: five to eight points fit more than one relative orientation, and only
/// growing each of them shows which is correct.
const MANY: usize = 9;
const MOST_PAIRS_OF_FEW: usize = 64;
const MOST_STARTS_OF_FEW: usize = 64;
/// Angle, 20°, above which a wider base does not improve a pair.
const WIDE: f64 = 0.35;

/// A first pair with its relative orientation.
struct SeedPair {
    photos: [usize; 2],
    relative: Relative,
    score: f64,
}

/// Quality of a network grown from a seed: oriented photos, remaining noise in pixels, measurements that agree.
#[derive(Clone, Copy, Debug)]
pub(super) struct NetworkQuality {
    pub photos: usize,
    pub noise_px: f64,
    pub agreeing: usize,
    /// Evidence for the network: the number of agreeing observations times the logarithm of the ratio of the photo's size to the noise. Few
    /// photos with residuals of a tenth of a pixel are stronger evidence than all photos with twenty pixels.
    pub evidence: f64,
}

/// Noise, as a share of the photo, below which smaller noise is no further evidence.
const FINEST: f64 = 3e-5;
/// Minimum share of agreeing observations if only names are wrong.
const MOSTLY: f64 = 0.7;

impl NetworkQuality {
    pub fn of(block: &OrientationBlock) -> Self {
        let (noise_px, agreeing) = (block.noise_px.unwrap_or(f64::INFINITY), block.agreeing());
        let side = block.cameras.iter().map(longer_side).fold(0.0, f64::max);
        let narrower = (side / noise_px.max(FINEST * side)).max(1.0).ln();
        Self { photos: block.oriented(), noise_px, agreeing, evidence: agreeing as f64 * narrower }
    }
}

/// Number of photos of a core, by which the start of a model is assessed.
const CORE: usize = 8;
/// Minimum number of photos of a model that is certain.
const FEWEST_EVIDENT: usize = 5;
/// Minimum number of observations in excess of the unknowns of a model that is certain.
const SPARE: usize = 30;

impl NetworkQuality {
    /// Whether the model is certain, so that no other start is tried: its residuals are at the level of the measurement noise with many
    /// more observations than unknowns.
    pub fn is_evident(&self, block: &OrientationBlock, fine_px: f64) -> bool {
        let all = block.photos.iter().filter(|v| !v.observations.is_empty()).count();
        let (_, unknowns) = block.counts();
        self.photos >= FEWEST_EVIDENT.min(all)
            && self.noise_px <= fine_px
            && self.agreeing as f64 >= MOSTLY * block.offered() as f64
            && 2 * self.agreeing >= unknowns + SPARE
    }
}

/// Small models from the most promising first pairs, among photos that are not in `used`.
pub(super) struct Cores<'a> {
    block: &'a OrientationBlock,
    starts: std::vec::IntoIter<SeedPair>,
    fine_px: f64,
    few: bool,
}

impl<'a> Cores<'a> {
    pub fn new(block: &'a OrientationBlock, used: &[bool], fine_px: f64) -> Self {
        let mut starts = starts(block, used);
        let few = starts.iter().all(|start| start.relative.inliers.len() < MANY);
        starts.truncate(if few { MOST_STARTS_OF_FEW } else { MOST_STARTS });
        Self { block, starts: starts.into_iter(), fine_px, few }
    }

    /// Whether no pair shares enough points for a unique start.
    pub fn are_of_few(&self) -> bool {
        self.few
    }
}

impl Iterator for Cores<'_> {
    type Item = OrientationBlock;

    fn next(&mut self) -> Option<OrientationBlock> {
        let start = self.starts.next()?;
        let mut model = without_poses(self.block);
        let [first, second] = start.photos;
        model.photos[first].pose = Some(Pose::identity());
        model.photos[second].pose = Some(start.relative.pose);
        for ((a, b), taken) in model.common(first, second).into_iter().zip(&start.relative.inliers) {
            model.observations[a].taken = *taken;
            model.observations[b].taken = *taken;
        }
        grow_to(&mut model, CORE, Freedom::Distance);
        if model.noise_px.is_none_or(|noise| noise > self.fine_px) {
            refine(&mut model, Freedom::Everything);
        }
        Some(model)
    }
}

/// The block without poses and points, for a separate model; photos that are oriented already are added again by growth.
pub(super) fn without_poses(block: &OrientationBlock) -> OrientationBlock {
    let mut model = block.clone();
    model.anchored = false;
    model.photos.iter_mut().for_each(|block_photo| block_photo.pose = None);
    model.points.iter_mut().for_each(|block_point| block_point.xyz = None);
    model.noise_px = None;
    model
}

/// A core grown over all photos that can be added.
pub(super) fn grown_out(mut model: OrientationBlock, fine_px: f64) -> OrientationBlock {
    grow_to(&mut model, usize::MAX, Freedom::Everything);
    if model.noise_px.is_none_or(|noise| noise > fine_px) {
        refine(&mut model, Freedom::Everything);
    }
    model
}

/// Number of common points of every pair of unused photos, most first.
fn pairs(block: &OrientationBlock, used: &[bool]) -> Vec<(usize, [usize; 2])> {
    let n = block.photos.len();
    let mut counts = vec![0usize; n * n];
    for block_point in &block.points {
        for (k, &a) in block_point.observations.iter().enumerate() {
            for &b in &block_point.observations[k + 1..] {
                let (a, b) = (block.observations[a].photo, block.observations[b].photo);
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

fn starts(block: &OrientationBlock, used: &[bool]) -> Vec<SeedPair> {
    let mut starts: Vec<SeedPair> = Vec::new();
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
            .filter_map(|(a, b)| Some((block.observations[a].ray?, block.observations[b].ray?)))
            .unzip();
        let units = block.pixels_per_unit(first).min(block.pixels_per_unit(second));
        // Distances due to noise only; distortion increases the robust scale.
        let Ok(found) = relative_orientation(&a, &b, 0.5 / units, k as u64) else { continue };
        for relative in found {
            let agreeing = relative.inliers.iter().filter(|taken| **taken).count();
            let score = agreeing as f64 * (relative.angle / WIDE).min(1.0);
            starts.push(SeedPair { photos, relative, score });
        }
    }
    starts.sort_by(|a, b| b.score.total_cmp(&a.score));
    starts
}
