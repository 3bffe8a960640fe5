//! Photo by photo: intersect what two oriented photos see, orient the photo that sees most of it, refine, repeat.

use super::block::OrientationBlock;
use super::neighbour;
use super::refine::{Freedom, refine};
use crate::initial::resection::robust_resection;

/// Rays that meet at 2° or more make points to resect from; smaller angles come last.
const GOOD_ANGLE: f64 = 0.035;
/// Minimum number of points a photo is oriented from.
pub(super) const FEWEST: usize = 4;
/// Poses by chance that are accepted, on average, in place of a photo's own.
const CHANCE: f64 = 0.05;
/// Poses a resection compares, at most.
const POSES: f64 = 400.0;
/// Share of a photo's determined points that has to agree with its pose; below it another pose may do as well.
const AGREEING: f64 = 0.4;

/// Photos up to which the model is refined after each one; from then on after a third more.
const CAREFUL: usize = 6;

/// Orients every photo that can be reached from those oriented so far.
pub(super) fn grow(block: &mut OrientationBlock) {
    grow_to(block, usize::MAX, Freedom::Distance);
}

/// The same until `most` photos are oriented, refining with a given freedom.
pub(super) fn grow_to(block: &mut OrientationBlock, most: usize, freedom: Freedom) {
    // Number of points each photo was last tried with in vain: it is tried again when it sees more.
    let mut tried = vec![0; block.photos.len()];
    let mut refined_at = block.oriented();
    let mut pairs = neighbour::Pairs::default();
    block.intersect_new(GOOD_ANGLE);
    while block.oriented() < most {
        let oriented = match next_photo(block, &tried) {
            Some(photo) => {
                let oriented = resect(block, photo);
                if !oriented {
                    tried[photo] = block.determined(photo).0.len();
                }
                oriented
            }
            None => {
                if block.oriented() > refined_at {
                    refine(block, freedom);
                    refined_at = block.oriented();
                    tried.fill(0);
                    continue;
                }
                // The last resorts before giving up: relative orientation to neighbours, points from narrow rays.
                if !neighbour::orient_one(block, &mut pairs) {
                    let before = block.points.iter().filter(|m| m.xyz.is_some()).count();
                    block.intersect_new(0.0);
                    if block.points.iter().filter(|m| m.xyz.is_some()).count() == before {
                        break;
                    }
                    continue;
                }
                true
            }
        };
        if !oriented {
            continue;
        }
        block.intersect_new(GOOD_ANGLE);
        if block.oriented() < CAREFUL || block.oriented() * 3 >= refined_at * 4 {
            refine(block, freedom);
            refined_at = block.oriented();
            tried.fill(0);
        }
    }
    if block.oriented() > refined_at || block.noise_px.is_none() {
        refine(block, freedom);
    }
    block.intersect_new(0.0);
}

/// The photo without a pose that sees most determined points, if it sees enough.
fn next_photo(block: &OrientationBlock, tried: &[usize]) -> Option<usize> {
    let candidates = (0..block.photos.len()).filter(|&k| block.photos[k].pose.is_none());
    let counted = candidates.map(|k| (block.determined(k).0.len(), k));
    let enough = counted.filter(|&(count, k)| count >= FEWEST && count > tried[k]);
    enough.max_by_key(|&(count, k)| (count, std::cmp::Reverse(k))).map(|(_, k)| k)
}

/// Orients one photo from the points determined so far; whether there is evidence for its pose.
pub(super) fn resect(block: &mut OrientationBlock, photo: usize) -> bool {
    let (observations, object, image) = block.determined(photo);
    let units = block.pixels_per_unit(photo);
    let tolerance = block.tolerance_px(photo) / units;
    let Ok(found) = robust_resection(&object, &image, tolerance, photo as u64) else { return false };
    let agreeing = found.inliers.iter().filter(|taken| **taken).count();
    // A pose that fits only with a large scatter is rejected: ten times what is tolerated of a single point.
    let spread = (found.squares() / agreeing.max(1) as f64).sqrt();
    if spread > 10.0 * tolerance || !evident(block, photo, agreeing, object.len(), spread * units) {
        return false;
    }
    block.photos[photo].pose = Some(found.pose);
    for (observation, taken) in observations.into_iter().zip(found.inliers) {
        block.observations[observation].taken = taken;
    }
    true
}

/// Whether so many of a photo's points would hardly agree with a pose by chance: with the share p of the photo within
/// twice the scatter, poses·C(n - 3, k - 3)·p^(k - 3) wrong poses fit k of n points.
pub(super) fn evident(block: &OrientationBlock, photo: usize, agreeing: usize, of: usize, scatter_px: f64) -> bool {
    if agreeing < FEWEST || (agreeing as f64) < AGREEING * of as f64 {
        return false;
    }
    let camera = &block.cameras[block.photos[photo].camera];
    let radius = (2.0 * scatter_px).max(1.0);
    let share =
        (std::f64::consts::PI * radius * radius / (f64::from(camera.width) * f64::from(camera.height))).min(1.0);
    let mut expected = POSES;
    for k in 0..agreeing - 3 {
        expected *= share * (of - 3 - k) as f64 / (k + 1) as f64;
    }
    expected < CHANCE
}

/// Whether enough of a photo's observations agree with its pose; given poses are accepted.
pub(super) fn holds(block: &OrientationBlock, photo: usize) -> bool {
    let block_photo = &block.photos[photo];
    if block_photo.pose.is_none() || block_photo.given {
        return true;
    }
    let compared: Vec<usize> =
        block_photo.observations.iter().copied().filter(|&s| block.misfit_px(s).is_some()).collect();
    let agreeing = compared.iter().filter(|&&s| block.observations[s].taken).count();
    // Points that lost their coordinates because the photo disagreed count against it, too.
    let asked =
        block_photo.observations.iter().filter(|&&s| block.rays(block.observations[s].point).0.len() > 1).count();
    agreeing >= FEWEST && 2 * agreeing >= asked
}
