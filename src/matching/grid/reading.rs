//! The board in one photo.

use std::collections::BTreeMap;

use super::board::{Board, LatticeSite};
use super::growth::{FEWEST, Lattice, Pool, size};
use super::local::predict;
use super::outcome::UnnamedReason;
use super::placement::{Placed, Placement, ground, place, symmetries};
use crate::detection::{Polarity, Target};
use crate::error::Number;
use crate::initial::robust::quantile;

/// Largest ratio of the diameters of the dots, seen and given.
const DIAMETER: f64 = 1.15;
/// Largest ratio of two lattices' ratios of dot and step that may be of one board.
const DIAMETERS: f64 = 1.3;
/// Share of the board's dots, and of the ground beside one of its sides, that has to be seen where another grid may be the board too.
const MOST: f64 = 0.75;
const SIDE: f64 = 0.25;
/// Distance of a target from the place of the corner mark, in steps.
const MARK: f64 = 0.35;

/// The dots of a photo, with all ways to name them that the board's symmetry leaves.
#[derive(Debug)]
pub(super) struct BoardReading {
    /// Target by row and column for each way; the upright one first, then by turns of the board.
    pub ways: Vec<BTreeMap<[u32; 2], usize>>,
    /// Places of the first dot in each way, where it can be predicted or is seen.
    pub first: Vec<Option<[f64; 2]>>,
    /// The way that the mark shows.
    pub marked: bool,
    /// Whether the position was found from background without dots.
    pub by_border: bool,
}

struct PlacedLattice<'a> {
    lattice: Lattice,
    pool: &'a Pool<'a>,
    /// Diameter of a dot in steps.
    ratio: f64,
    ground: BTreeMap<LatticeSite, bool>,
    placed: Placed,
}

impl PlacedLattice<'_> {
    /// Whether most of the board is seen, and ground without dots beside each of its sides: a larger grid that the photo cuts to the
    /// board's size has none on one of them.
    fn ends(&self, placement: &Placement, board: &Board) -> bool {
        let dots = self.lattice.dots.keys().filter(|site| board.dot(placement.of(**site)).is_some()).count();
        let mut sides = [(0, 0); 4];
        for (site, shown) in &self.ground {
            for (side, (seen, all)) in board.sides(placement.of(*site)).into_iter().zip(&mut sides) {
                *all += usize::from(side);
                *seen += usize::from(side && *shown);
            }
        }
        dots as f64 >= MOST * board.dots() as f64
            && sides.iter().all(|(seen, all)| *seen > 0 && *seen as f64 >= SIDE * *all as f64)
    }

    /// Number of targets like the dots that are not of the lattice.
    fn others(&self) -> usize {
        let sizes: Vec<f64> = self.lattice.dots.values().map(|k| size(&self.pool.targets[*k])).collect();
        let (low, high) = (quantile(&sizes, 0.0) / DIAMETERS, quantile(&sizes, 1.0) * DIAMETERS);
        let like = self.pool.order.iter().filter(|k| (low..high).contains(&size(&self.pool.targets[**k])));
        like.count().saturating_sub(sizes.len())
    }
}

/// Finds the board among the targets of a photo of `size` pixels.
pub(super) fn read(
    targets: &[Target],
    photo_size: Option<[u32; 2]>,
    board: &Board,
) -> Result<BoardReading, UnnamedReason> {
    let of = |polarity: Polarity| {
        let mine = move |k: &usize| {
            let target = &targets[*k];
            target.polarity == polarity && target.code.is_none() && !target.occluded
        };
        Pool::new(targets, (0..targets.len()).filter(mine))
    };
    let pools = [of(Polarity::Dark), of(Polarity::Bright)];
    let mut candidates: Vec<PlacedLattice> = Vec::new();
    for pool in &pools {
        for lattice in pool.lattices() {
            let ground = ground(&lattice, pool, photo_size);
            let placed = place(&lattice, pool, board, &ground);
            candidates.push(PlacedLattice { ratio: ratio(&lattice, pool), lattice, pool, ground, placed });
        }
    }
    candidates.sort_by_key(|c| std::cmp::Reverse(c.lattice.dots.len()));
    let Some(largest) = candidates.first() else { return Err(UnnamedReason::NoGrid { targets: targets.len() }) };
    let dots = largest.lattice.dots.len();
    if let Some(given) = board.diameter {
        let seen = |c: &PlacedLattice| c.ratio * board.pitch * board.step();
        let fits = |c: &PlacedLattice| seen(c) < DIAMETER * given && given < DIAMETER * seen(c);
        let largest = seen(largest);
        candidates.retain(fits);
        if candidates.is_empty() {
            return Err(UnnamedReason::Diameter { seen: Number(largest), given: Number(given) });
        }
    }
    decide(&candidates, dots, board)
}

fn decide(candidates: &[PlacedLattice], dots: usize, board: &Board) -> Result<BoardReading, UnnamedReason> {
    let there: Vec<&PlacedLattice> = candidates.iter().filter(|c| matches!(c.placed, Placed::There(..))).collect();
    let ambiguous = candidates.iter().find_map(|c| match c.placed {
        Placed::Ambiguous(places) => Some(UnnamedReason::Ambiguous { dots: c.lattice.dots.len(), places }),
        _ => None,
    });
    let [candidate] = there[..] else {
        return Err(match (there.len(), ambiguous) {
            (0, Some(ambiguous)) => ambiguous,
            (0, None) => UnnamedReason::NotThisBoard { dots },
            (count, _) => UnnamedReason::SeveralBoards { count },
        });
    };
    let Placed::There(placement, by_border) = candidate.placed else {
        return Err(UnnamedReason::NotThisBoard { dots });
    };
    let others = candidates.iter().filter(|c| !std::ptr::eq(*c, candidate));
    let rivals = others.filter(|c| !matches!(c.placed, Placed::NotThisBoard)).count();
    if rivals > 0 && !candidate.ends(&placement, board) {
        return Err(UnnamedReason::SeveralBoards { count: 1 + rivals });
    }
    let others = candidate.others();
    if others >= FEWEST && !candidate.ends(&placement, board) {
        return Err(UnnamedReason::OtherDots { dots: candidate.lattice.dots.len(), others });
    }
    // where something crosses the board, what lies beyond is a lattice of its own, and the gap is no end of the board
    let similar = |c: &&PlacedLattice| c.ratio < DIAMETERS * candidate.ratio && candidate.ratio < DIAMETERS * c.ratio;
    let pieces = candidates.iter().filter(similar).count();
    if by_border && pieces > 1 {
        return Err(UnnamedReason::SeveralBoards { count: pieces });
    }
    reading(candidate, &placement, by_border, board)
}

fn reading(
    found: &PlacedLattice,
    placement: &Placement,
    by_border: bool,
    board: &Board,
) -> Result<BoardReading, UnnamedReason> {
    let PlacedLattice { lattice, pool, .. } = found;
    let mut placements: Vec<Placement> = symmetries(board).iter().map(|g| placement.then(g)).collect();
    // the upright one first, the others in the order of the board's turns from it
    let rightwards = |p: &Placement| rightwards(lattice, p, board);
    let upright =
        (0..placements.len()).max_by(|&a, &b| rightwards(&placements[a]).total_cmp(&rightwards(&placements[b])));
    placements.rotate_left(upright.unwrap_or(0));
    let mut marked = false;
    if let (Some(mark), true) = (board.mark, placements.len() > 1) {
        let seen: Vec<bool> = placements.iter().map(|p| shows_mark(lattice, pool, p, board, mark)).collect();
        let count = seen.iter().filter(|s| **s).count();
        if count != 1 {
            return Err(UnnamedReason::Mark { seen: count });
        }
        let mut each = seen.iter();
        placements.retain(|_| *each.next().unwrap_or(&false));
        marked = true;
    }
    let way = |p: &Placement| {
        lattice.dots.iter().filter_map(|(site, k)| Some((board.dot(p.of(*site))?, *k))).collect::<BTreeMap<_, _>>()
    };
    let first = |p: &Placement| {
        let at = p.back(board.site([0, 0]).map(f64::from));
        lattice.places.get(&at.map(|x| x as i32)).copied().or_else(|| Some(predict(&lattice.places, at, None)?.place))
    };
    let ways: Vec<_> = placements.iter().map(way).collect();
    if ways[0].len() < FEWEST {
        return Err(UnnamedReason::NotThisBoard { dots: lattice.dots.len() });
    }
    Ok(BoardReading { ways, first: placements.iter().map(first).collect(), marked, by_border })
}

/// Cosine of the angle between the photo's u and the rows of the board, on average.
fn rightwards(lattice: &Lattice, placement: &Placement, board: &Board) -> f64 {
    let origin = placement.back([0.0, 0.0]);
    let along = placement.back(board.lattice_from_board([board.pitch, 0.0]));
    let (p, q) = (along[0] - origin[0], along[1] - origin[1]);
    let each = lattice.dots.keys().filter_map(|site| {
        let steps = lattice.predicted(*site)?.steps;
        let [u, v] = [0, 1].map(|k| p * steps[0][k] + q * steps[1][k]);
        Some(u / u.hypot(v))
    });
    let (count, sum) = each.fold((0, 0.0), |(n, s), x| (n + 1, s + x));
    sum / f64::from(count.max(1))
}

/// Whether a target other than the dots lies where the mark is.
fn shows_mark(lattice: &Lattice, pool: &Pool, placement: &Placement, board: &Board, mark: [f64; 2]) -> bool {
    let at = placement.back(board.lattice_from_board(mark));
    let Some(p) = predict(&lattice.places, at, None) else { return false };
    let dot = |k: usize| lattice.dots.iter().any(|(site, d)| *d == k && board.dot(placement.of(*site)).is_some());
    let near = |(k, t): (usize, &Target)| (t.u - p.place[0]).hypot(t.v - p.place[1]) < MARK * p.shortest_px && !dot(k);
    pool.targets.iter().enumerate().any(near)
}

/// Diameter of the dots in steps of the lattice.
fn ratio(lattice: &Lattice, pool: &Pool) -> f64 {
    let each = lattice.dots.iter().filter_map(|(site, k)| {
        let [a, b] = lattice.predicted(*site)?.steps;
        Some(size(&pool.targets[*k]) / (a[0] * b[1] - a[1] * b[0]).abs().sqrt())
    });
    quantile(&each.collect::<Vec<_>>(), 0.5)
}
