//! The ellipse of a blob of which a part is covered, or joined with something else: most of its border still follows it.
//!
//! What lies in front of a target spoils one piece of the border. So the ends of the runs are taken in their order around the
//! blob, an ellipse is laid through every window of them, and the one that most of the border follows counts.

use super::blob::Limits;
use super::component::Chord;
use crate::detect::ellipse::conic;
use crate::detect::ellipse::outline::Outline;

/// Ends that are looked at: of a large blob every so manieth.
const ENDS: usize = 48;
/// Windows, and the share of the ends in one of them.
const WINDOWS: usize = 12;
const SHARE: f64 = 0.5;
/// Least share of the ends that follows the ellipse: a cover of a fifth of the diameter on one side hides all ends but these.
const FOLLOWING: f64 = 0.55;
/// Distance, in pixels, by which ends differ in any case: rows are whole.
const STEPS: f64 = 0.15;
/// Smallest minor axis, in pixels: what is smaller has too few ends.
const SMALLEST: f64 = 7.0;
/// Fewest runs whose ends show an ellipse through half of them.
const RUNS: usize = 4;

/// The ellipse that most of a chain's ends follow; none where there is no such one, or the blob is too small to tell.
pub(crate) fn most(chain: &[Chord], limits: &Limits) -> Option<Outline> {
    let [first, .., last] = chain else { return None };
    let least = SMALLEST;
    let widest = chain.iter().map(|chord| chord.x1 - chord.x0).fold(0.0, f32::max);
    if chain.len() < RUNS || f64::from(last.y - first.y) < 0.7 * least || f64::from(widest) < 0.7 * least {
        return None;
    }
    let inside = |x: f32| x > 0.0 && x < limits.width as f32;
    let right = chain.iter().map(|chord| (chord.x1, chord.y));
    let left = chain.iter().rev().map(|chord| (chord.x0, chord.y));
    let ends: Vec<[f64; 3]> = right
        .chain(left)
        .filter(|&(x, _)| inside(x))
        .step_by((2 * chain.len()).div_ceil(ENDS))
        .map(|(x, y)| [f64::from(x), f64::from(y), 1.0])
        .collect();
    let window = ((SHARE * ends.len() as f64) as usize).max(6);
    if ends.len() < window + 2 {
        return None;
    }
    let around: Vec<[f64; 3]> = ends.iter().chain(&ends).copied().collect();
    let mut best: Option<(Outline, f64)> = None;
    for k in 0..WINDOWS {
        let from = k * ends.len() / WINDOWS;
        let Some(outline) = conic::fit(&around[from..from + window]) else { continue };
        if !is_possible(&outline, limits, least) {
            continue;
        }
        let distance = most_within(&ends, &outline);
        if best.is_none_or(|(_, nearest)| distance < nearest) {
            best = Some((outline, distance));
        }
    }
    let (outline, distance) = best?;
    // what all can follow gives way to the cover: only those as near as the better half count
    let limit = (2.0 * distance).max(STEPS);
    let kept: Vec<[f64; 3]> =
        ends.iter().filter(|[x, y, _]| outline.distance(*x, *y).abs() <= limit).copied().collect();
    let outline = conic::fit(&kept)?;
    let good = 0.3 + 0.03 * outline.semi_axes().1;
    (is_possible(&outline, limits, least) && most_within(&ends, &outline) <= good).then_some(outline)
}

/// Distance within which as many ends lie as have to follow an outline.
fn most_within(ends: &[[f64; 3]], outline: &Outline) -> f64 {
    let mut distances: Vec<f64> = ends.iter().map(|[x, y, _]| outline.distance(*x, *y).abs()).collect();
    let rank = (FOLLOWING * ends.len() as f64) as usize;
    *distances.select_nth_unstable_by(rank.min(ends.len() - 1), f64::total_cmp).1
}

fn is_possible(outline: &Outline, limits: &Limits, least: f64) -> bool {
    let (a, b) = outline.semi_axes();
    let (half_u, half_v) = outline.half_box();
    outline.is_proper()
        && 2.0 * b >= least
        && b >= limits.flattest * a
        && 2.0 * a <= 1.3 * limits.max_diameter
        && outline.u > half_u
        && outline.v > half_v
        && outline.u + half_u < limits.width as f64
        && outline.v + half_v < limits.height as f64
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    const LIMITS: Limits =
        Limits { min_diameter: 5.0, max_diameter: 400.0, flattest: 0.22, width: 300, height: 200, step: 2 };

    fn chain(chord: impl Fn(f64) -> Option<(f64, f64)>) -> Vec<Chord> {
        let row = |k: i32| {
            let y = f64::from(2 * k) + 0.5;
            chord(y).map(|(x0, x1)| Chord { x0: x0 as f32, x1: x1 as f32, y: y as f32, cut: false })
        };
        (0..100).filter_map(row).collect()
    }

    #[test]
    fn a_target_of_which_a_cap_is_covered_shows_its_ellipse() {
        let truth = Outline::from_axes(100.3, 80.2, 20.0, 14.0, 0.7);
        // an upright cover on the right, then a level one above
        let right = chain(|y| truth.chord(y).map(|(x0, x1)| (x0, x1.min(110.0))).filter(|(x0, x1)| x0 < x1));
        let above = chain(|y| truth.chord(y).filter(|_| y > 71.0));
        for chain in [right, above] {
            let found = most(&chain, &LIMITS).expect("an ellipse");
            assert!((found.u - truth.u).hypot(found.v - truth.v) < 0.5, "{found:?}");
        }
    }

    #[test]
    fn a_target_joined_with_a_bar_shows_its_ellipse() {
        let truth = Outline::from_axes(100.3, 80.2, 18.0, 18.0, 0.0);
        let joined = chain(|y| {
            let (x0, x1) = truth.chord(y)?;
            Some((x0, if (76.0..86.0).contains(&y) { 160.0 } else { x1 }))
        });
        let found = most(&joined, &LIMITS).expect("an ellipse");
        assert!((found.u - truth.u).hypot(found.v - truth.v) < 0.5, "{found:?}");
    }

    #[test]
    fn boxes_and_wedges_show_none() {
        let block = chain(|y| (40.0..80.0).contains(&y).then_some((50.0, 90.0)));
        let wedge = chain(|y| (40.0..80.0).contains(&y).then_some((50.0, 50.0 + (y - 39.0))));
        assert!(most(&block, &LIMITS).is_none());
        assert!(most(&wedge, &LIMITS).is_none());
    }
}
