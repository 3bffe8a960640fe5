//! Largest distance between two of many points, exactly: branch and bound over pairs of boxes.
//!
//! The points are halved again and again along the longest side of their box. A pair of boxes is worth looking into while the
//! largest distance that it could hold exceeds the largest one found; the most promising pair comes first, so that the first
//! pair without promise ends the search.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::ops::Range;

/// Maximum number of points of a box that is not divided further.
const LEAF: usize = 16;

/// Distance of two points.
pub fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}

/// Largest distance between two of the points; 0 for fewer than two.
pub fn largest_distance(mut points: Vec<[f64; 3]>) -> f64 {
    let mut boxes = Vec::new();
    let all = 0..points.len();
    divide(&mut points, all, &mut boxes);
    let mut best = 0.0;
    let mut pairs = BinaryHeap::from([BoxPair::new(&boxes, 0, 0)]);
    while let Some(pair) = pairs.pop().filter(|pair| pair.bound > best) {
        let (a, b) = (&boxes[pair.a], &boxes[pair.b]);
        match (a.halves, b.halves) {
            (Some([low, high]), _) if pair.a == pair.b => {
                pairs.extend([(low, low), (low, high), (high, high)].map(|(a, b)| BoxPair::new(&boxes, a, b)));
            }
            (Some(halves), _) if a.points.len() >= b.points.len() => {
                pairs.extend(halves.map(|half| BoxPair::new(&boxes, half, pair.b)));
            }
            (_, Some(halves)) => pairs.extend(halves.map(|half| BoxPair::new(&boxes, pair.a, half))),
            _ => {
                for p in &points[a.points.clone()] {
                    best = points[b.points.clone()].iter().map(|q| distance(p, q)).fold(best, f64::max);
                }
            }
        }
    }
    best
}

/// Some of the points and the box around them.
struct Boxed {
    points: Range<usize>,
    low: [f64; 3],
    high: [f64; 3],
    halves: Option<[usize; 2]>,
}

/// Divides the points of a range; returns the number of its box.
fn divide(points: &mut [[f64; 3]], range: Range<usize>, boxes: &mut Vec<Boxed>) -> usize {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for p in &points[range.clone()] {
        for k in 0..3 {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
        }
    }
    let number = boxes.len();
    boxes.push(Boxed { points: range.clone(), low, high, halves: None });
    if range.len() > LEAF {
        let side = |k: &usize| high[*k] - low[*k];
        let axis = (0..3).max_by(|a, b| side(a).total_cmp(&side(b))).unwrap_or(0);
        let middle = range.len() / 2;
        points[range.clone()].select_nth_unstable_by(middle, |p, q| p[axis].total_cmp(&q[axis]));
        let cut = range.start + middle;
        boxes[number].halves = Some([divide(points, range.start..cut, boxes), divide(points, cut..range.end, boxes)]);
    }
    number
}

/// Two boxes, ordered by the largest distance that they could hold.
struct BoxPair {
    bound: f64,
    a: usize,
    b: usize,
}

impl BoxPair {
    fn new(boxes: &[Boxed], a: usize, b: usize) -> Self {
        let reach = |k: usize| {
            let (a, b) = (&boxes[a], &boxes[b]);
            (a.high[k] - b.low[k]).max(b.high[k] - a.low[k])
        };
        Self { bound: reach(0).hypot(reach(1)).hypot(reach(2)), a, b }
    }
}

impl Ord for BoxPair {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

impl PartialOrd for BoxPair {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for BoxPair {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for BoxPair {}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn the_search_agrees_with_all_pairs() {
        let mut random = ChaCha8Rng::seed_from_u64(13);
        let mut uniform = || f64::from(random.next_u32()) / f64::from(u32::MAX) - 0.5;
        for n in [0, 1, 2, 3, 17, 100, 1500] {
            for shape in 0..5 {
                let point = |k: usize| {
                    let [x, y, z] = [uniform(), uniform(), uniform()];
                    match shape {
                        // A volume, a sphere, a line, a plane, the same few places again and again.
                        0 => [x, 3.0 * y, 0.1 * z],
                        1 => [x, y, z].map(|c| c / x.hypot(y).hypot(z)),
                        2 => [1e6 + x, 2.0 * x, -x],
                        3 => [x, y, 0.0],
                        _ => [(k % 3) as f64, (k % 2) as f64, 0.0],
                    }
                };
                let points: Vec<[f64; 3]> = (0..n).map(point).collect();
                let all = points.iter().flat_map(|a| points.iter().map(move |b| distance(a, b))).fold(0.0, f64::max);
                assert_eq!(largest_distance(points), all, "{n} {shape}");
            }
        }
    }
}
