//! Measurements that miss by little do not have wrong names.
//!
//! A wrong name lies anywhere in the photo: it lies within r of where its point should be with the probability p = πr²/A, where A
//! is the area of the photo. What a rough model has left out, because a point of narrow rays or a photo of few points was not yet
//! where it is now, misses by little. Of the measurements left out the nearest are taken that hold one wrong name in twenty
//! on average (Benjamini and Hochberg 1995, with these p). They take part in one more adjustment, and its residuals tell which of
//! them agree: the redundancy of the network decides, and not the distance from a point that was determined without them.

use super::block::OrientationBlock;
use super::refine::{Freedom, refine};
use super::seed::NetworkQuality;

/// Share of wrong names among the measurements that are examined once more, on average.
const WRONG_NAMES: f64 = 0.05;
/// Adjustments in a row: what has come back in may show that more has to.
const MOST_ROUNDS: usize = 4;

/// Takes back in what was left out and agrees in an adjustment that it takes part in.
pub(super) fn readmit(block: &mut OrientationBlock) {
    for _ in 0..MOST_ROUNDS {
        let near = near_misses(block);
        if near.is_empty() {
            return;
        }
        let mut next = block.clone();
        near.iter().for_each(|&s| next.observations[s].taken = true);
        refine(&mut next, Freedom::Everything);
        next.intersect_new(0.0);
        next.review();
        if NetworkQuality::of(&next).evidence <= NetworkQuality::of(block).evidence {
            return;
        }
        *block = next;
    }
}

/// The measurements that were left out though they miss by less than wrong names would.
fn near_misses(block: &OrientationBlock) -> Vec<usize> {
    let left_out = (0..block.observations.len()).filter(|&s| !block.observations[s].taken);
    let missing = left_out.filter_map(|s| {
        let camera = &block.cameras[block.photos[block.observations[s].photo].camera];
        let area = f64::from(camera.width) * f64::from(camera.height);
        Some(((std::f64::consts::PI * block.misfit_px(s)?.powi(2) / area).min(1.0), s))
    });
    nearest(missing.collect())
}

/// Of probabilities to lie as near by chance those that are too small, most of which by no chance: the k smallest, for the largest
/// k with p ≤ [`WRONG_NAMES`]·k/n.
fn nearest(mut by_chance: Vec<(f64, usize)>) -> Vec<usize> {
    by_chance.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let n = by_chance.len() as f64;
    let count = (1..=by_chance.len()).rev().find(|&k| by_chance[k - 1].0 <= WRONG_NAMES * k as f64 / n).unwrap_or(0);
    by_chance.into_iter().take(count).map(|(_, s)| s).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::robust::{generator, uniform};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn wrong_names_among_near_misses_are_one_in_twenty() {
        // 200 wrong names anywhere in a photo, and 20 measurements within a thousandth of it by area: all of these come back,
        // and in a long run the wrong names among all that come back have the share stated, times the share of wrong names.
        let mut g = generator(1);
        let (mut share, mut lost) = (0.0, 0);
        let trials = 2000;
        for _ in 0..trials {
            let wrong = (0..200).map(|k| (uniform(&mut g), k));
            let mut all: Vec<(f64, usize)> = wrong.collect();
            all.extend((200..220).map(|k| (1e-4 * uniform(&mut g), k)));
            let found = nearest(all);
            let names = found.iter().filter(|k| **k < 200).count();
            lost += 20 - (found.len() - names);
            share += names as f64 / found.len().max(1) as f64;
        }
        let (share, expected) = (share / f64::from(trials), WRONG_NAMES * 200.0 / 220.0);
        assert!((share - expected).abs() < 0.01, "{share} of {expected}");
        assert_eq!(lost, 0);
        assert!(nearest(Vec::new()).is_empty());
    }
}
