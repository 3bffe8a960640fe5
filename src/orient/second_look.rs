//! Photos that may stand in the second of two poses.
//!
//! Ten points of one plane that only two photos show have two relative orientations that fit alike (the two decompositions of their
//! homography), and a photo of a plane has two resections. While the model grew, little may have spoken for the one or the other.
//! Now that everything else stands, photos that hardly any point of three rays holds, and those that fit worse than the
//! others, are taken out and oriented once more, together with the one photo they hang on; what is found stays if
//! it explains the measurements better than what there was.

use std::collections::BTreeMap;

use super::block::Block;
use super::refine::{Freedom, refine};
use super::remaining;

/// Points of three rays or given coordinates that leave no second pose, but for chance.
const HOLDING: usize = 4;
/// Root mean square of a photo's residuals over the noise of all beyond which it fits worse than the others.
const WORSE: f64 = 2.0;
/// Least gain, as a sum of squares over the variance: one in a thousand for one degree of freedom.
const GAIN: f64 = 10.83;

/// Orients doubtful photos anew, each once, and marks them in `looked`; whether one of them has found a better pose.
pub(super) fn again(block: &mut Block, borne: &mut [bool], looked: &mut [bool]) -> bool {
    let Some(noise) = block.noise_px else { return false };
    let limits: Vec<f64> = (0..block.sights.len()).map(|s| block.limit_px(s)).collect();
    let mut any = false;
    for photo in 0..block.views.len() {
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
            if !remaining::orient(&mut next, &mut next_borne) || out.iter().any(|&k| next.views[k].pose.is_none()) {
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
fn is_doubtful(block: &Block, photo: usize, noise: f64) -> bool {
    let view = &block.views[photo];
    if view.pose.is_none() || view.given {
        return false;
    }
    let (mut holding, mut agreeing, mut against, mut squares) = (0, 0, 0, 0.0);
    for &s in &view.sights {
        let mark = &block.marks[block.sights[s].point];
        let known = block.anchored && mark.known.is_some();
        let others =
            mark.sights.iter().filter(|&&t| t != s && block.views[block.sights[t].photo].pose.is_some()).count();
        match block.misfit_px(s) {
            Some(misfit) if block.sights[s].taken => {
                let meet =
                    mark.sights.iter().filter(|&&t| block.sights[t].taken && block.misfit_px(t).is_some()).count();
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
fn partner(block: &Block, photo: usize) -> Option<usize> {
    let mut shared: BTreeMap<usize, usize> = BTreeMap::new();
    for &s in &block.views[photo].sights {
        let (which, _) = block.rays(block.sights[s].point);
        let mut others = which.iter().map(|&t| block.sights[t].photo).filter(|&k| k != photo);
        if let (Some(other), None) = (others.next(), others.next()) {
            *shared.entry(other).or_default() += 1;
        }
    }
    shared.into_iter().max_by_key(|&(photo, count)| (count, std::cmp::Reverse(photo))).map(|(photo, _)| photo)
}

/// The block without some poses, its points as the others determine them.
fn without(block: &Block, photos: &[usize]) -> Block {
    let mut next = block.clone();
    photos.iter().for_each(|&k| next.views[k].pose = None);
    for &k in photos {
        for &s in &block.views[k].sights {
            let point = block.sights[s].point;
            if !(next.anchored && next.marks[point].known.is_some()) {
                next.marks[point].xyz = None;
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
fn loss(block: &Block, limits: &[f64]) -> f64 {
    limits
        .iter()
        .enumerate()
        .map(|(s, limit)| block.misfit_px(s).map_or(*limit, |misfit| misfit.min(*limit)).powi(2))
        .sum()
}
