//! Targets divided by an occluder: two blobs whose outer borders lie on one ellipse.
//!
//! What runs across the middle of a target in a tone of its own leaves two parts, of which neither has enough of the border. What
//! they turn towards each other lies inside of their convex hull; the rest of the hull is the target's outline.

use std::f64::consts::PI;

use super::Candidate;
use super::blob::BlobLimits;
use super::component::Chord;
use super::partial::is_possible;
use crate::detect::acceptance::halves::{AREA, FILL, FOLLOWING, GAP, SHORTER};
use crate::detect::acceptance::partial::{GOOD, SMALLEST};
use crate::detect::acceptance::size::{BLOB_LARGE, BLOB_SMALL};
use crate::detect::ellipse::conic;
use crate::detect::ellipse::outline::Outline;

/// Candidates for parts of targets.
#[derive(Default)]
pub(crate) struct Parts {
    all: Vec<Part>,
    /// Runs of all of them: both ends and the height.
    runs: Vec<[f32; 3]>,
}

struct Part {
    bright: bool,
    runs: std::ops::Range<usize>,
    low: [f32; 2],
    high: [f32; 2],
    area: f32,
}

fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

impl Parts {
    /// Takes a blob without a shape of its own, unless it is too large or too small for a part.
    pub fn take(&mut self, chain: &[Chord], bright: bool, limits: &BlobLimits) {
        let [first, .., last] = chain else { return };
        let step = limits.step as f32;
        let (mut low, mut high, mut area) = (f32::MAX, f32::MIN, 0.0);
        for chord in chain {
            (low, high) = (smaller(low, chord.x0), larger(high, chord.x1));
            area += step * (chord.x1 - chord.x0);
        }
        let longest = f64::from(larger(high - low, last.y - first.y + step));
        let possible = BLOB_SMALL * SMALLEST..BLOB_LARGE * limits.max_diameter;
        if !possible.contains(&longest) || chain.iter().any(|chord| chord.cut) {
            return;
        }
        let from = self.runs.len();
        self.runs.extend(chain.iter().map(|chord| [chord.x0, chord.x1, chord.y]));
        let runs = from..self.runs.len();
        self.all.push(Part { bright, runs, low: [low, first.y], high: [high, last.y], area });
    }

    /// Ellipses of which two of them are the parts.
    pub fn joined(mut self, limits: &BlobLimits) -> Vec<Candidate> {
        // stable: native and wasm give the same order
        self.all.sort_by(|a, b| a.low[0].total_cmp(&b.low[0]));
        let mut found = Vec::new();
        for (k, part) in self.all.iter().enumerate() {
            let reach = part.high[0] + (GAP / SHORTER) as f32 * part.size();
            for other in self.all[k + 1..].iter().take_while(|other| other.low[0] < reach) {
                if part.may_belong_to(other, limits)
                    && let Some(outline) = self.ellipse(part, other, limits)
                {
                    found.push(Candidate { outline, bright: part.bright });
                }
            }
        }
        found
    }

    /// The ellipse of both; `None` if they are not two halves of one ellipse.
    fn ellipse(&self, one: &Part, other: &Part, limits: &BlobLimits) -> Option<Outline> {
        let mut runs = [&self.runs[one.runs.clone()], &self.runs[other.runs.clone()]].concat();
        runs.sort_by(|a, b| a[2].total_cmp(&b[2]));
        let left = side(runs.iter().map(|[x, _, y]| [*x, *y]), -1.0);
        let right = side(runs.iter().map(|[_, x, y]| [*x, *y]), 1.0);
        let hull = (twice_beside(&right) - twice_beside(&left)) / 2.0;
        if f64::from(one.area + other.area) < AREA * hull {
            return None;
        }
        let corners = left.iter().chain(&right).map(|[x, y]| [f64::from(*x), f64::from(*y), 1.0]).collect::<Vec<_>>();
        let outline = conic::fit(&corners)?;
        let (a, b) = outline.semi_axes();
        // rows leave out the caps above and below, about a quarter of a step each
        let unseen = limits.step as f64 / (2.0 * b);
        let good = GOOD[0] + GOOD[1] * b;
        let follow = corners.iter().filter(|[x, y, _]| outline.distance(*x, *y).abs() < good).count();
        let possible = is_possible(&outline, limits, SMALLEST)
            && (hull / (PI * a * b) - 1.0).abs() < FILL + unseen
            && follow as f64 >= FOLLOWING * corners.len() as f64;
        possible.then_some(outline)
    }
}

impl Part {
    fn size(&self) -> f32 {
        larger(self.high[0] - self.low[0], self.high[1] - self.low[1])
    }

    /// Whether size and place of both allow that they are parts of one target.
    fn may_belong_to(&self, other: &Self, limits: &BlobLimits) -> bool {
        let sizes = [self.size(), other.size()];
        let longer = larger(sizes[0], sizes[1]);
        let gap = GAP as f32 * longer;
        let apart = |k: usize| larger(other.low[k] - self.high[k], self.low[k] - other.high[k]);
        let side = |k: usize| f64::from(larger(self.high[k], other.high[k]) - smaller(self.low[k], other.low[k]));
        // a hull that touches all sides of its box fills half of it at least
        let filled = f64::from(self.area + other.area) / (side(0) * (side(1) + limits.step as f64));
        self.bright == other.bright
            && apart(1) <= gap
            && smaller(sizes[0], sizes[1]) >= SHORTER as f32 * longer
            && apart(0) <= gap
            && filled >= 0.5 * AREA
    }
}

/// One side of the convex hull of positions in the order of their rows: -1 for the left one.
fn side(places: impl Iterator<Item = [f32; 2]>, sign: f32) -> Vec<[f32; 2]> {
    let mut hull: Vec<[f32; 2]> = Vec::new();
    for [x, y] in places {
        while let [.., [x0, y0], [x1, y1]] = hull[..] {
            if sign * ((x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)) > 0.0 {
                break;
            }
            hull.pop();
        }
        hull.push([x, y]);
    }
    hull
}

/// Twice the area between a side and the picture's left border.
fn twice_beside(side: &[[f32; 2]]) -> f64 {
    side.windows(2).map(|pair| f64::from((pair[0][0] + pair[1][0]) * (pair[1][1] - pair[0][1]))).sum()
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    const LIMITS: BlobLimits =
        BlobLimits { min_diameter: 5.0, max_diameter: 400.0, flattest: 0.22, width: 300, height: 200, step: 2 };

    /// Runs in every second row.
    fn chain(chord: impl Fn(f64) -> Option<(f64, f64)>) -> Vec<Chord> {
        let row = |k: i32| {
            let y = f64::from(2 * k) + 0.5;
            chord(y).filter(|(x0, x1)| x0 < x1).map(|(x0, x1)| Chord::new(x0 as f32, x1 as f32, y as f32, false))
        };
        (0..100).filter_map(row).collect()
    }

    fn joined(chains: &[Vec<Chord>]) -> Vec<Candidate> {
        let mut parts = Parts::default();
        chains.iter().for_each(|chain| parts.take(chain, false, &LIMITS));
        parts.joined(&LIMITS)
    }

    #[test]
    fn two_halves_show_their_ellipse() {
        let truth = Outline::from_axes(100.3, 80.2, 24.0, 15.0, 0.5);
        // a cable six pixels wide in any direction, through the middle or beside it
        for (k, off) in (0..12).flat_map(|k| [-3.0, 0.0, 4.0].map(|off| (k, off))) {
            let (sine, cosine) = (f64::from(k) / 12.0 * PI).sin_cos();
            let half = |sign: f64| {
                chain(|y| {
                    let (x0, x1) = truth.chord(y)?;
                    // sign (c (x - u) + s (y - v) - off) > 3
                    let rest = 3.0 + sign * (off - sine * (y - truth.v));
                    let bound = truth.u + rest / (sign * cosine);
                    match sign * cosine {
                        c if c.abs() < 1e-9 => (rest < 0.0).then_some((x0, x1)),
                        c if c > 0.0 => Some((x0.max(bound), x1)),
                        _ => Some((x0, x1.min(bound))),
                    }
                })
            };
            let found = joined(&[half(1.0), half(-1.0)]);
            let [Candidate { outline, .. }] = found[..] else { panic!("{k} {off}: {found:?}") };
            assert!((outline.u - truth.u).hypot(outline.v - truth.v) < 0.7, "{k} {off}: {outline:?}");
            let differs = (outline.semi_axes().0 - 24.0).abs().max((outline.semi_axes().1 - 15.0).abs());
            assert!(differs < 0.8, "{k} {off}: {outline:?}");
        }
    }

    #[test]
    fn boxes_dots_and_strangers_show_none() {
        let block = |x: f64, y: f64| chain(move |row| (y..y + 20.0).contains(&row).then_some((x, x + 12.0)));
        let dot = |u: f64, v: f64| {
            let outline = Outline::from_axes(u, v, 10.0, 8.0, 0.3);
            chain(move |row| outline.chord(row))
        };
        for (name, chains) in [
            ("boxes", [block(40.0, 40.0), block(55.0, 40.0)]),
            ("dots", [dot(60.0, 60.0), dot(82.0, 61.0)]),
            ("a box and a dot", [block(40.0, 40.0), dot(64.0, 50.0)]),
            ("far apart", [dot(60.0, 60.0), dot(160.0, 61.0)]),
        ] {
            assert!(joined(&chains).is_empty(), "{name}");
        }
    }
}
