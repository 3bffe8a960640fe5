//! The ellipse of a blob that is partly occluded or joined with something else: most of its border still follows it.
//!
//! What lies in front of a target spoils one piece of the border. So the ends of the runs are taken in their order around the
//! blob, an ellipse is laid through every window of them, and the one that most of the border follows counts.

use wide::f32x4;

use super::blob::BlobLimits;
use super::component::Chord;
use crate::detect::acceptance::partial::{FOLLOWING, GOOD, HOPELESS, RUNS, SMALLEST, SPANNED, STEPS, WINDOW};
use crate::detect::acceptance::size::{BLOB_LARGE, BLOB_SMALL};
use crate::detect::ellipse::conic::Sums;
use crate::detect::ellipse::outline::Outline;

/// Ends that are examined: of a large blob every so manieth.
const ENDS: usize = 48;
/// Windows that are tried, of few ends as many as differ by two.
const WINDOWS: usize = 8;

/// The ellipse that most of a chain's ends follow; `None` if there is no such one, or the blob is too small to tell.
pub(crate) fn most(chain: &[Chord], limits: &BlobLimits) -> Option<Outline> {
    let [first, .., last] = chain else { return None };
    let least = SMALLEST;
    let [_, widest] = range(chain.iter().map(|chord| chord.x1 - chord.x0));
    let shortest = BLOB_SMALL * least;
    if chain.len() < RUNS || f64::from(last.y - first.y) < shortest || f64::from(widest) < shortest {
        return None;
    }
    let ends = Ends::of(chain, limits);
    let window = ((WINDOW * ends.count as f64) as usize).max(6);
    if ends.count < window + 2 {
        return None;
    }
    let running = ends.running();
    let total = running[ends.count];
    // no ellipse that the ends span is larger, so what is further off than this is hopeless whatever its size
    let largest = ends.scale * ends.half[0].min(ends.half[1]) / SPANNED;
    let hopeless = (1.01 * HOPELESS * good(largest)) as f32;
    let mut best: Option<(Outline, f32)> = None;
    let windows = WINDOWS.min(ends.count / 2);
    for k in 0..windows {
        let (from, to) = (k * ends.count / windows, k * ends.count / windows + window);
        let sums = match to.checked_sub(ends.count) {
            None | Some(0) => running[to].since(&running[from]),
            Some(beyond) => total.since(&running[from].since(&running[beyond])),
        };
        let Some(outline) = sums.ellipse().filter(|outline| ends.span(outline)).map(|outline| ends.placed(&outline))
        else {
            continue;
        };
        if !is_possible(&outline, limits, least) {
            continue;
        }
        let nearest = best.map_or(hopeless, |(_, nearest)| nearest);
        if let Some(distance) = ends.most_within(&outline, nearest) {
            best = Some((outline, distance));
        }
    }
    let (outline, distance) = best?;
    if f64::from(distance) > HOPELESS * good(outline.semi_axes().1) {
        return None;
    }
    // what all can follow gives way to the cover: only those as near as the better half count
    let limit = f64::from(2.0 * distance).max(STEPS);
    let outline = ends.placed(&ends.within(&outline, limit).ellipse()?);
    let follows = || ends.most_within(&outline, good(outline.semi_axes().1) as f32).is_some();
    (is_possible(&outline, limits, least) && follows()).then_some(outline)
}

/// Distance, in pixels, within which the ends of an ellipse of this semi-minor axis follow it.
fn good(b: f64) -> f64 {
    GOOD[0] + GOOD[1] * b
}

/// Ends of the runs in their order around the blob, counted from its middle in units of its size.
struct Ends {
    x: [f32; ENDS],
    y: [f32; ENDS],
    count: usize,
    middle: [f64; 2],
    scale: f64,
    /// Half the width and height of the blob, in these units.
    half: [f64; 2],
}

impl Ends {
    fn of(chain: &[Chord], limits: &BlobLimits) -> Self {
        let inside = |x: f32| x > 0.0 && x < limits.width as f32;
        let right = chain.iter().map(|chord| (chord.x1, chord.y));
        let left = chain.iter().rev().map(|chord| (chord.x0, chord.y));
        let all = right.chain(left).filter(|&(x, _)| inside(x)).step_by((2 * chain.len()).div_ceil(ENDS));
        let (mut x, mut y, mut count) = ([0.0; ENDS], [0.0; ENDS], 0);
        for ((x, y), end) in x.iter_mut().zip(&mut y).zip(all) {
            (*x, *y) = end;
            count += 1;
        }
        let ranges = [&x, &y].map(|values| range(values[..count].iter().copied()));
        let middle = ranges.map(|[low, high]| f64::from(low + high) / 2.0);
        let half = ranges.map(|[low, high]| f64::from(high - low) / 2.0);
        let scale = half[0].max(half[1]).max(1.0);
        for (values, middle) in [(&mut x, middle[0]), (&mut y, middle[1])] {
            values[..count].iter_mut().for_each(|value| *value = ((f64::from(*value) - middle) / scale) as f32);
        }
        // the rows next to the first and the last may be the blob's as well
        let half = [half[0], half[1] + limits.step as f64].map(|half| half / scale);
        Self { x, y, count, middle, scale, half }
    }

    fn places(&self) -> impl Iterator<Item = [f64; 2]> {
        self.x.iter().zip(&self.y).take(self.count).map(|(x, y)| [f64::from(*x), f64::from(*y)])
    }

    /// Sums over the first 0, 1, ... of them.
    fn running(&self) -> [Sums; ENDS + 1] {
        let mut running = [Sums::default(); ENDS + 1];
        for (k, [x, y]) in self.places().enumerate() {
            running[k + 1] = running[k];
            running[k + 1].add(x, y, 1.0);
        }
        running
    }

    /// Whether they reach over enough of the width and height of an ellipse of these units.
    fn span(&self, outline: &Outline) -> bool {
        let (half_u, half_v) = outline.half_box();
        self.half[0] >= SPANNED * half_u && self.half[1] >= SPANNED * half_v
    }

    /// An ellipse of these units in the picture.
    fn placed(&self, outline: &Outline) -> Outline {
        let [u, v] = self.middle;
        Outline { u: u + self.scale * outline.u, v: v + self.scale * outline.v, ..outline.scaled(self.scale) }
    }

    /// An ellipse of the picture in these units.
    fn own(&self, outline: &Outline) -> Outline {
        let [u, v] = self.middle;
        Outline { u: (outline.u - u) / self.scale, v: (outline.v - v) / self.scale, ..outline.scaled(1.0 / self.scale) }
    }

    /// Sums over the ends up to a distance from an outline.
    fn within(&self, outline: &Outline, limit: f64) -> Sums {
        let (outline, limit) = (self.own(outline), limit / self.scale);
        let mut sums = Sums::default();
        for [x, y] in self.places().filter(|[x, y]| outline.distance(*x, *y).abs() <= limit) {
            sums.add(x, y, 1.0);
        }
        sums
    }

    /// Distance, in pixels, within which as many ends lie as have to follow an outline, if it is below a limit.
    fn most_within(&self, outline: &Outline, limit: f32) -> Option<f32> {
        let outline = self.own(outline);
        let scale = 1.0 / (outline.p * outline.q - outline.r * outline.r);
        let [u, v, p, q, r] = [outline.u, outline.v, scale * outline.p, scale * outline.q, scale * outline.r]
            .map(|x| f32x4::splat(x as f32));
        let mut distances = [0f32; ENDS];
        let [x, y] = [&self.x, &self.y].map(|values| values.as_chunks::<4>().0);
        // Sampson's distance, as [`Outline::distance`]
        let places = x.iter().zip(y).take(self.count.div_ceil(4));
        for (distance, (x, y)) in distances.as_chunks_mut::<4>().0.iter_mut().zip(places) {
            let (x, y) = (f32x4::new(*x) - u, f32x4::new(*y) - v);
            let (c, s) = (q * x - r * y, p * y - r * x);
            let (gx, gy) = (q * c - r * s, p * s - r * c);
            let square = c * c + s * s;
            let slope = (gx * gx + gy * gy).sqrt().fast_max(f32x4::splat(1e-12));
            *distance = ((square - square.sqrt()).abs() / slope).to_array();
        }
        let distances = &mut distances[..self.count];
        let rank = ((FOLLOWING * self.count as f64) as usize).min(self.count - 1);
        let limit = limit / self.scale as f32;
        if distances.iter().filter(|distance| **distance < limit).count() <= rank {
            return None;
        }
        let (_, distance, _) = distances.select_nth_unstable_by(rank, f32::total_cmp);
        Some(*distance * self.scale as f32)
    }
}

/// Least and largest value. The language's own are calls in a browser, for what is no number.
fn range(values: impl Iterator<Item = f32>) -> [f32; 2] {
    values.fold([f32::MAX, f32::MIN], |[low, high], x| [if x < low { x } else { low }, if x > high { x } else { high }])
}

/// Whether an ellipse has the size and shape of a target, and lies in the picture.
pub(super) fn is_possible(outline: &Outline, limits: &BlobLimits, least: f64) -> bool {
    let (a, b) = outline.semi_axes();
    let (half_u, half_v) = outline.half_box();
    outline.is_proper()
        && 2.0 * b >= least
        && b >= limits.flattest * a
        && 2.0 * a <= BLOB_LARGE * limits.max_diameter
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

    const LIMITS: BlobLimits =
        BlobLimits { min_diameter: 5.0, max_diameter: 400.0, flattest: 0.22, width: 300, height: 200, step: 2 };

    fn chain(chord: impl Fn(f64) -> Option<(f64, f64)>) -> Vec<Chord> {
        let row = |k: i32| {
            let y = f64::from(2 * k) + 0.5;
            chord(y).map(|(x0, x1)| Chord::new(x0 as f32, x1 as f32, y as f32, false))
        };
        (0..100).filter_map(row).collect()
    }

    #[test]
    fn a_target_of_which_a_cap_is_occluded_shows_its_ellipse() {
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
    fn half_a_target_behind_a_cable_shows_its_ellipse() {
        let truth = Outline::from_axes(100.3, 80.2, 20.0, 20.0, 0.0);
        let upper = chain(|y| truth.chord(y).filter(|_| y < 76.2));
        let found = most(&upper, &LIMITS).expect("an ellipse");
        assert!((found.u - truth.u).hypot(found.v - truth.v) < 0.5, "{found:?}");
    }

    #[test]
    fn what_is_a_small_part_of_an_ellipse_shows_none() {
        let truth = Outline::from_axes(100.3, 80.2, 40.0, 40.0, 0.0);
        let cap = |lowest: f64| chain(|y| truth.chord(y).filter(|_| y < lowest));
        assert!(most(&cap(100.0), &LIMITS).is_some());
        assert!(most(&cap(54.0), &LIMITS).is_none());
    }

    #[test]
    fn boxes_and_wedges_show_none() {
        let block = chain(|y| (40.0..80.0).contains(&y).then_some((50.0, 90.0)));
        let wedge = chain(|y| (40.0..80.0).contains(&y).then_some((50.0, 50.0 + (y - 39.0))));
        assert!(most(&block, &LIMITS).is_none());
        assert!(most(&wedge, &LIMITS).is_none());
    }
}
