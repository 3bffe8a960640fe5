//! Where on the board a lattice lies: every quarter turn, every shift, and every basis that its steps may be.
//!
//! A photo is never mirrored, so that steps of the lattice become steps of the board by integer matrices of determinant +1. One placement
//! is taken only if each other one leaves clearly more dots beside the board, or clearly more sites of the board empty if the photo
//! shows its ground.

use std::collections::BTreeMap;

use super::board::{Board, LatticeSite};
use super::growth::{Lattice, Pool};
use crate::initial::robust::quantile;

/// Where a lattice lies: site of the board = turn · site of the lattice + shift.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Placement {
    pub turn: [[i32; 2]; 2],
    pub shift: LatticeSite,
}

/// Largest number in a change of basis: steep views make a sheared basis the shortest.
const SHEAR: i32 = 2;
/// Largest median difference between the shapes of the dots and those of a placement, as the logarithm of a ratio of axes.
/// A basis sheared by one step is at 0.96.
const SHAPE: f64 = 0.45;
/// Dots that may stand beside the board: false ones that happen to continue it. As a number, and as a share.
const BESIDE: usize = 2;
const BESIDE_SHARE: f64 = 0.03;
/// Minimum number of dots that contradict a placement.
const AGAINST: usize = 4;
/// Steps beside a dot within which an empty site counts.
const RING: i32 = 2;
/// Axes of the dots, in pixels and as a ratio, below which an empty site is not evidence: the detector may have missed the dot.
const VISIBLE_PX: f64 = 6.5;
const VISIBLE_RATIO: f64 = 0.35;

impl Placement {
    pub fn of(&self, [p, q]: LatticeSite) -> LatticeSite {
        let [[a, b], [c, d]] = self.turn;
        [a * p + b * q + self.shift[0], c * p + d * q + self.shift[1]]
    }

    /// Place in the lattice of a place on the board, in steps.
    pub fn back(&self, [p, q]: [f64; 2]) -> [f64; 2] {
        let [[a, b], [c, d]] = self.turn.map(|row| row.map(f64::from));
        let (p, q) = (p - f64::from(self.shift[0]), q - f64::from(self.shift[1]));
        [d * p - b * q, a * q - c * p]
    }

    /// This placement followed by another.
    pub fn then(&self, next: &Self) -> Self {
        let [[a, b], [c, d]] = next.turn;
        let [[e, f], [g, h]] = self.turn;
        Self { turn: [[a * e + b * g, a * f + b * h], [c * e + d * g, c * f + d * h]], shift: next.of(self.shift) }
    }
}

const TURNS: [[[i32; 2]; 2]; 4] = [[[1, 0], [0, 1]], [[0, -1], [1, 0]], [[-1, 0], [0, -1]], [[0, 1], [-1, 0]]];

/// The turns that bring the board onto itself, the identity first.
pub(super) fn symmetries(board: &Board) -> Vec<Placement> {
    let corner = |turn: &[[i32; 2]; 2]| {
        let turned = Placement { turn: *turn, shift: [0, 0] };
        let low =
            |k: usize, of: &dyn Fn(LatticeSite) -> LatticeSite| board.sites().map(|s| of(s)[k]).min().unwrap_or(0);
        let shift = [0, 1].map(|k| low(k, &|s| s) - low(k, &|s| turned.of(s)));
        Placement { turn: *turn, shift }
    };
    let onto = |placement: &Placement| board.sites().all(|s| board.dot(placement.of(s)).is_some());
    TURNS.iter().map(corner).filter(onto).collect()
}

/// Whether the photo would show a dot at an empty site around a lattice.
pub(super) fn ground(lattice: &Lattice, pool: &Pool, size: Option<[u32; 2]>) -> BTreeMap<LatticeSite, bool> {
    let Some(size) = size else { return BTreeMap::new() };
    let shown = |site: &LatticeSite| {
        let (p, dot) = (lattice.predicted(*site)?, &pool.targets[lattice.nearest(*site)?]);
        let margin = 1.2 * dot.major + 2.0 * p.sigma_px + 2.0;
        let inside = (0..2).all(|k| p.place[k] > margin && p.place[k] < f64::from(size[k]) - margin);
        let visible = dot.major >= VISIBLE_PX && dot.minor >= VISIBLE_RATIO * dot.major;
        Some(inside && visible && p.sigma_px < 0.3 * p.shortest_px)
    };
    lattice.open(RING).into_iter().map(|site| (site, shown(&site).unwrap_or(false))).collect()
}

/// Result of placing a lattice on the board.
#[derive(Clone, Debug)]
pub(super) enum Placed {
    /// The board has no part like it.
    NotThisBoard,
    /// It may lie in several places.
    Ambiguous(usize),
    /// It lies there, or in a place that the board's symmetry makes the same; whether empty ground was needed to say so.
    There(Placement, bool),
}

/// Places a lattice on the board.
pub(super) fn place(lattice: &Lattice, pool: &Pool, board: &Board, ground: &BTreeMap<LatticeSite, bool>) -> Placed {
    let candidates = candidates(lattice, pool, board);
    let beside = |p: &Placement| lattice.dots.keys().filter(|s| board.dot(p.of(**s)).is_none()).count();
    let on = |p: &Placement, s: &LatticeSite| board.dot(p.of(*s)).is_some();
    let shown: Vec<&LatticeSite> = ground.iter().filter(|(_, shown)| **shown).map(|(site, _)| site).collect();
    let cost = |p: &Placement| beside(p) + shown.iter().filter(|s| on(p, s)).count();
    let Some(best) = candidates.iter().min_by_key(|p| cost(p)) else { return Placed::NotThisBoard };
    let symmetries = symmetries(board);
    let same: Vec<Placement> = symmetries.iter().map(|g| best.then(g)).collect();
    let (mut rivals, mut needed_ground) = (0, false);
    for other in candidates.iter().filter(|p| !same.contains(p)) {
        // dots and empty sites that only one of the two explains
        let (mut against, mut own) = (0, 0);
        for site in lattice.dots.keys() {
            match (on(best, site), on(other, site)) {
                (true, false) => against += 1,
                (false, true) => own += 1,
                _ => {}
            }
        }
        if against >= own + AGAINST {
            continue;
        }
        needed_ground = true;
        for site in &shown {
            match (on(best, site), on(other, site)) {
                (false, true) => against += 1,
                (true, false) => own += 1,
                _ => {}
            }
        }
        rivals += usize::from(against < 2 * own + AGAINST);
    }
    if rivals == 0 { Placed::There(*best, needed_ground) } else { Placed::Ambiguous(1 + rivals) }
}

/// The placements that leave hardly a dot beside the board.
fn candidates(lattice: &Lattice, pool: &Pool, board: &Board) -> Vec<Placement> {
    let allowed = BESIDE.max((BESIDE_SHARE * lattice.dots.len() as f64) as usize);
    let bounds = |sites: &mut dyn Iterator<Item = LatticeSite>| {
        sites.fold([[i32::MAX, i32::MIN]; 2], |b, s| [0, 1].map(|k| [b[k][0].min(s[k]), b[k][1].max(s[k])]))
    };
    let own = bounds(&mut board.sites());
    let mut found = Vec::new();
    for turn in turns(lattice, pool) {
        let turned = Placement { turn, shift: [0, 0] };
        let sites: Vec<LatticeSite> = lattice.dots.keys().map(|s| turned.of(*s)).collect();
        let of = bounds(&mut sites.iter().copied());
        let range = |k: usize| {
            let (a, b) = (own[k][0] - of[k][0], own[k][1] - of[k][1]);
            a.min(b) - BESIDE as i32..=a.max(b) + BESIDE as i32
        };
        for x in range(0) {
            for y in range(1) {
                let mut left = allowed as i32;
                let fits = sites.iter().all(|s| {
                    left -= i32::from(board.dot([s[0] + x, s[1] + y]).is_none());
                    left >= 0
                });
                if fits {
                    found.push(Placement { turn, shift: [x, y] });
                }
            }
        }
    }
    found
}

/// The changes of basis under which the dots are images of circles; all of them if the targets' axes do not decide.
fn turns(lattice: &Lattice, pool: &Pool) -> Vec<[[i32; 2]; 2]> {
    let range = || -SHEAR..=SHEAR;
    let all = range()
        .flat_map(|a| range().flat_map(move |b| range().flat_map(move |c| range().map(move |d| [[a, b], [c, d]]))));
    let all: Vec<[[i32; 2]; 2]> = all.filter(|[[a, b], [c, d]]| a * d - b * c == 1).collect();
    // lists of centres without axes have circles everywhere
    if lattice.dots.values().all(|k| pool.targets[*k].major == pool.targets[*k].minor) {
        return all;
    }
    let views: Vec<([[f64; 2]; 2], [f64; 3])> = lattice
        .dots
        .iter()
        .filter_map(|(site, k)| {
            let t = &pool.targets[*k];
            let (sine, cosine) = t.angle.sin_cos();
            let [major, minor] = [t.major * t.major, t.minor * t.minor];
            let shape = [
                major * cosine * cosine + minor * sine * sine,
                (major - minor) * sine * cosine,
                major * sine * sine + minor * cosine * cosine,
            ];
            Some((lattice.predicted(*site)?.steps, shape))
        })
        .collect();
    let apart = |turn: &[[i32; 2]; 2]| {
        let each: Vec<f64> = views.iter().map(|(steps, shape)| difference(turn, *steps, *shape)).collect();
        quantile(&each, 0.5)
    };
    let fitting: Vec<_> = all.iter().copied().filter(|turn| apart(turn) < SHAPE).collect();
    if fitting.is_empty() { all } else { fitting }
}

/// Difference of two shapes as the logarithm of a ratio of axes: that of the image of a circle, whose steps along the board's p and q are
/// those of the lattice after a change of basis, and that of an ellipse with the matrix (xx, xy, yy).
fn difference(turn: &[[i32; 2]; 2], steps: [[f64; 2]; 2], [xx, xy, yy]: [f64; 3]) -> f64 {
    let [[a, b], [c, d]] = turn.map(|row| row.map(f64::from));
    // columns of steps · turn⁻¹
    let p = [d * steps[0][0] - c * steps[1][0], d * steps[0][1] - c * steps[1][1]];
    let q = [a * steps[1][0] - b * steps[0][0], a * steps[1][1] - b * steps[0][1]];
    let (uu, uv, vv) = (p[0] * p[0] + q[0] * q[0], p[0] * p[1] + q[0] * q[1], p[1] * p[1] + q[1] * q[1]);
    let areas = ((uu * vv - uv * uv) * (xx * yy - xy * xy)).max(f64::MIN_POSITIVE).sqrt();
    let half_trace = 0.5 * (vv * xx - 2.0 * uv * xy + uu * yy) / areas;
    half_trace.max(1.0).acosh()
}

#[cfg(test)]
mod tests {
    use super::super::board::BoardKind;
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn boards_have_the_symmetries_of_their_dots() {
        let board =
            |rows, columns, kind| Board { rows, columns, pitch: 1.0, kind, diameter: None, sigma: None, mark: None };
        let count = |rows, columns, kind| symmetries(&board(rows, columns, kind)).len();
        assert_eq!(count(7, 7, BoardKind::Symmetric), 4);
        assert_eq!(count(7, 9, BoardKind::Symmetric), 2);
        assert_eq!(count(13, 7, BoardKind::Asymmetric), 1);
        // with an even number of rows the last one is shifted: turned by 180 degrees it is the first
        assert_eq!(count(12, 7, BoardKind::Asymmetric), 2);
        for (rows, columns, kind) in [(13, 7, BoardKind::Asymmetric), (4, 9, BoardKind::Symmetric)] {
            let board = board(rows, columns, kind);
            let named: Vec<_> = board.sites().map(|s| board.dot(s)).collect();
            let expected: Vec<_> = (0..rows).flat_map(|i| (0..columns).map(move |j| Some([i, j]))).collect();
            assert_eq!(named, expected);
        }
    }

    #[test]
    fn a_placement_goes_forth_and_back() {
        let placement = Placement { turn: [[2, 1], [1, 1]], shift: [-3, 5] };
        let there = placement.of([4, -7]);
        assert_eq!(placement.back(there.map(f64::from)), [4.0, -7.0]);
        let twice = placement.then(&placement);
        assert_eq!(twice.of([4, -7]), placement.of(there));
    }
}
