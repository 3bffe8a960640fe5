//! Photo by photo: intersect what two oriented photos see, resect the photo that sees most of it, refine, repeat.

use super::block::Block;
use super::refine::{Freedom, refine};
use crate::initial::resection::robust_resection;

/// Rays that meet at 2° or more make points to resect from; smaller angles come last.
const GOOD_ANGLE: f64 = 0.035;
/// Fewest points a photo is oriented from, and the share of them that must agree.
pub(super) const FEWEST: usize = 4;
const AGREEING: f64 = 0.6;

/// Photos up to which the model is refined after each one; from then on after a third more.
const CAREFUL: usize = 6;

/// Orients every photo that can be reached from those oriented so far.
pub(super) fn grow(block: &mut Block) {
    // Number of points each photo was last tried with in vain: it is tried again when it sees more.
    let mut tried = vec![0; block.views.len()];
    let mut refined_at = block.oriented();
    block.intersect_new(GOOD_ANGLE);
    loop {
        let Some(photo) = next_photo(block, &tried) else {
            // The last resort before giving up: points from narrow rays.
            let before = block.marks.iter().filter(|m| m.xyz.is_some()).count();
            block.intersect_new(0.0);
            if block.marks.iter().filter(|m| m.xyz.is_some()).count() == before {
                break;
            }
            continue;
        };
        if !resect(block, photo) {
            tried[photo] = block.determined(photo).0.len();
            continue;
        }
        block.intersect_new(GOOD_ANGLE);
        if block.oriented() < CAREFUL || block.oriented() * 3 >= refined_at * 4 {
            refine(block, Freedom::Distance);
            refined_at = block.oriented();
            tried.fill(0);
        }
    }
    if block.oriented() > refined_at || block.noise_px.is_none() {
        refine(block, Freedom::Distance);
    }
    block.intersect_new(0.0);
}

/// The photo without a pose that sees most determined points, if it sees enough.
fn next_photo(block: &Block, tried: &[usize]) -> Option<usize> {
    let candidates = (0..block.views.len()).filter(|&k| block.views[k].pose.is_none());
    let counted = candidates.map(|k| (block.determined(k).0.len(), k));
    let enough = counted.filter(|&(count, k)| count >= FEWEST && count > tried[k]);
    enough.max_by_key(|&(count, k)| (count, std::cmp::Reverse(k))).map(|(_, k)| k)
}

/// Orients one photo from the points determined so far; whether most of them agree.
pub(super) fn resect(block: &mut Block, photo: usize) -> bool {
    let (sights, object, image) = block.determined(photo);
    let units = block.pixels_per_unit(photo);
    let tolerance = block.tolerance_px(photo) / units;
    let Ok(found) = robust_resection(&object, &image, tolerance, photo as u64) else { return false };
    let agreeing = found.inliers.iter().filter(|taken| **taken).count();
    // A pose that fits by a wide scatter only is no pose: ten times what is tolerated of a single point.
    let spread = (found.squares() / agreeing.max(1) as f64).sqrt();
    if agreeing < FEWEST || (agreeing as f64) < AGREEING * object.len() as f64 || spread > 10.0 * tolerance {
        return false;
    }
    block.views[photo].pose = Some(found.pose);
    for (sight, taken) in sights.into_iter().zip(found.inliers) {
        block.sights[sight].taken = taken;
    }
    true
}
