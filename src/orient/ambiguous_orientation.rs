//! Photos whose correct pose may be the second of two.
//!
//! Ten points of one plane that only two photos show have two relative orientations that fit alike (the two decompositions of their
//! homography), and a photo of a plane has two resections. While the model grew, little may have spoken for the one or the other.
//! Now that everything else stands, photos that hardly any point of three rays holds, and those that fit worse than the
//! others, are taken out and oriented once more, together with the one photo they hang on; what is found stays if
//! it explains the measurements better than what there was.

use std::collections::BTreeMap;

use super::block::OrientationBlock;
use super::refine::{Freedom, refine};
use super::remaining;

/// Points of three rays or given coordinates that leave no second pose, but for chance.
const HOLDING: usize = 4;
/// Root mean square of a photo's residuals over the noise of all beyond which it fits worse than the others.
const WORSE: f64 = 2.0;
/// Minimum gain, as a sum of squares over the variance: one in a thousand for one degree of freedom.
const GAIN: f64 = 10.83;

/// Orients doubtful photos anew, each once, and marks them in `looked`; whether one of them has found a better pose.
pub(super) fn orient_again(block: &mut OrientationBlock, borne: &mut [bool], looked: &mut [bool]) -> bool {
    let Some(noise) = block.noise_px else { return false };
    let limits: Vec<f64> = (0..block.observations.len()).map(|s| block.limit_px(s)).collect();
    let mut any = false;
    for photo in 0..block.photos.len() {
        if looked[photo] || !is_doubtful(block, photo, noise) {
            continue;
        }
        looked[photo] = true;
        let before = loss(block, &limits);
        let partner = partner(block, photo).filter(|&k| is_doubtful(block, k, noise));
        for out in std::iter::once(vec![photo]).chain(partner.map(|k| vec![photo, k])) {
            let mut next = without(block, &out);
            let mut next_borne = borne.to_vec();
            out.iter().for_each(|&k| next_borne[k] = false);
            if !remaining::orient(&mut next, &mut next_borne) || out.iter().any(|&k| next.photos[k].pose.is_none()) {
                continue;
            }
            refine(&mut next, Freedom::Everything);
            next.intersect_new(0.0);
            next.review();
            if loss(&next, &limits) < before - GAIN * noise * noise {
                *block = next;
                borne.copy_from_slice(&next_borne);
                any = true;
                break;
            }
        }
    }
    any
}

/// Whether a photo may have a second pose: it fits worse than the others, or few points hold it and something disagrees.
fn is_doubtful(block: &OrientationBlock, photo: usize, noise: f64) -> bool {
    let block_photo = &block.photos[photo];
    if block_photo.pose.is_none() || block_photo.given {
        return false;
    }
    let (mut holding, mut agreeing, mut against, mut squares) = (0, 0, 0, 0.0);
    for &s in &block_photo.observations {
        let block_point = &block.points[block.observations[s].point];
        let known = block.anchored && block_point.known.is_some();
        let others = block_point
            .observations
            .iter()
            .filter(|&&t| t != s && block.photos[block.observations[t].photo].pose.is_some())
            .count();
        match block.misfit_px(s) {
            Some(misfit) if block.observations[s].taken => {
                let meet = block_point
                    .observations
                    .iter()
                    .filter(|&&t| block.observations[t].taken && block.misfit_px(t).is_some())
                    .count();
                holding += usize::from(known || meet > 2);
                agreeing += 1;
                squares += misfit * misfit;
            }
            Some(_) => against += 1,
            None => against += usize::from(others > 0),
        }
    }
    agreeing > 0 && (holding < HOLDING && against > 0 || squares > (WORSE * noise).powi(2) * agreeing as f64)
}

/// The photo that shows most of the points which this one shows with one other only.
fn partner(block: &OrientationBlock, photo: usize) -> Option<usize> {
    let mut shared: BTreeMap<usize, usize> = BTreeMap::new();
    for &s in &block.photos[photo].observations {
        let (which, _) = block.rays(block.observations[s].point);
        let mut others = which.iter().map(|&t| block.observations[t].photo).filter(|&k| k != photo);
        if let (Some(other), None) = (others.next(), others.next()) {
            *shared.entry(other).or_default() += 1;
        }
    }
    shared.into_iter().max_by_key(|&(photo, count)| (count, std::cmp::Reverse(photo))).map(|(photo, _)| photo)
}

/// The block without some poses, its points as the others determine them.
fn without(block: &OrientationBlock, photos: &[usize]) -> OrientationBlock {
    let mut next = block.clone();
    photos.iter().for_each(|&k| next.photos[k].pose = None);
    for &k in photos {
        for &s in &block.photos[k].observations {
            let point = block.observations[s].point;
            if !(next.anchored && next.points[point].known.is_some()) {
                next.points[point].xyz = None;
            }
        }
    }
    next.intersect_new(0.0);
    // what they bent comes back
    refine(&mut next, Freedom::Everything);
    next.intersect_new(0.0);
    next.review();
    next
}

/// Squares of all residuals, each up to that of its limit; the limit's where there is none to compare.
fn loss(block: &OrientationBlock, limits: &[f64]) -> f64 {
    limits
        .iter()
        .enumerate()
        .map(|(s, limit)| block.misfit_px(s).map_or(*limit, |misfit| misfit.min(*limit)).powi(2))
        .sum()
}
