//! Connected components as chains of runs, built in the one pass over the rows.
//!
//! A run lies between a rising and the next falling edge (bright) or the other way round (dark). An ellipse is convex:
//! every row meets it in one run, so a component that is a target is a chain. Where a run meets two runs of the row
//! above, or two runs meet one, the chains end and new ones begin: touching neighbours come apart by themselves, and what
//! is left of each still shows most of an outline. Two runs with little between them, in the middle of what is above, are
//! one: the spot in the dot of a printed code, a scratch, a hot pixel. Where that gives no outline they are taken as two after
//! all. Only the runs of unfinished chains are held.

use super::scan::Edge;
use crate::detect::acceptance::blob::{APART, LINKED, SPOT};

/// Part of a row between two edges, in pixel coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Chord {
    pub x0: f32,
    pub x1: f32,
    /// Height of the row's centre.
    pub y: f32,
    /// One end is the border of the picture.
    pub cut: bool,
    /// Ends of a spot that lies in it; both the same where there is none.
    pub spot: [f32; 2],
}

impl Chord {
    pub fn new(x0: f32, x1: f32, y: f32, cut: bool) -> Self {
        Self { x0, x1, y, cut, spot: [x0; 2] }
    }

    fn spotted(&self) -> bool {
        self.spot[0] < self.spot[1]
    }
}

/// Runs of one polarity between edges of a row; the border of the picture ends a run too.
#[inline(never)]
pub(crate) fn runs(edges: &[Edge], bright: bool, width: usize, y: f32, out: &mut Vec<Chord>) {
    out.clear();
    let mut push = |x0: f32, x1: f32, cut| {
        if x1 > x0 {
            out.push(Chord::new(x0, x1, y, cut));
        }
    };
    let (Some(first), Some(last)) = (edges.first(), edges.last()) else { return };
    if first.rising != bright {
        push(0.0, first.x, true);
    }
    for pair in edges.windows(2) {
        if pair[0].rising == bright && pair[1].rising != bright {
            push(pair[0].x, pair[1].x, false);
        }
    }
    if last.rising == bright {
        push(last.x, width as f32, true);
    }
}

struct Active {
    x0: f32,
    x1: f32,
    cut: bool,
    chain: usize,
    meets: u32,
}

/// Whether the lengths of two runs allow one outline: the background between two targets does not continue in a third, nor
/// does a run that goes on to the border, because the faint edge of a target's first row was not seen, continue one that
/// ends far from there. An outline loses at most its outermost row to this.
fn alike(run: &Chord, above: &Active) -> bool {
    let (length, other) = (run.x1 - run.x0, above.x1 - above.x0);
    if !(length > LINKED * other && other > LINKED * length) {
        return false;
    }
    let near = APART[0] + APART[1] * if length < other { length } else { other };
    run.cut == above.cut || (run.x0 - above.x0).abs() < near && (run.x1 - above.x1).abs() < near
}

/// The run of which a spot in the middle of a target leaves these two. Their outer ends go on from those above: an arc and the
/// dot that it surrounds are two things.
fn around_a_spot(left: &Chord, right: &Chord, above: &Active) -> Option<Chord> {
    let whole = Chord { x1: right.x1, cut: left.cut || right.cut, spot: [left.x1, right.x0], ..*left };
    let length = whole.x1 - whole.x0;
    let aside = (right.x0 + left.x1) - (above.x0 + above.x1);
    let small = right.x0 - left.x1 < SPOT[0] * length && aside.abs() < 2.0 * SPOT[1] * length;
    let near = APART[1] * length;
    let onward = (whole.x0 - above.x0).abs() < near && (whole.x1 - above.x1).abs() < near;
    (small && onward && whole.cut == above.cut).then_some(whole)
}

/// Runs that a chain has room for at first.
const FIRST: usize = 32;

/// Links the runs of one polarity, row by row, into chains.
pub(crate) struct Linker {
    active: Vec<Active>,
    next: Vec<Active>,
    meets: Vec<(u32, usize)>,
    chains: Vec<Vec<Chord>>,
    free: Vec<usize>,
    max_rows: usize,
    /// Whether two runs may be one with a spot in it.
    spots: bool,
}

impl Linker {
    /// Chains of more than `max_rows` rows are not held on to: they are reported short, as soon as they are too long.
    pub fn new(max_rows: usize) -> Self {
        Self {
            active: Vec::new(),
            next: Vec::new(),
            meets: Vec::new(),
            chains: Vec::new(),
            free: Vec::new(),
            max_rows: max_rows.max(1),
            spots: true,
        }
    }

    /// Takes the runs of the next row; finished chains go to `finish`.
    #[inline(never)]
    pub fn row(&mut self, runs: &[Chord], finish: &mut impl FnMut(&[Chord])) {
        self.meets.clear();
        self.meets.resize(runs.len(), (0, 0));
        let mut start = 0;
        for (run, meets) in runs.iter().zip(&mut self.meets) {
            while start < self.active.len() && self.active[start].x1 <= run.x0 {
                start += 1;
            }
            let mut i = start;
            while i < self.active.len() && self.active[i].x0 < run.x1 {
                self.active[i].meets += 1;
                *meets = (meets.0 + 1, i);
                i += 1;
            }
        }
        self.next.clear();
        let mut spotted = false;
        for (i, (run, &(count, partner))) in runs.iter().zip(&self.meets).enumerate() {
            if std::mem::take(&mut spotted) {
                continue;
            }
            let mut run = *run;
            let mut continues = count == 1 && self.active[partner].meets == 1 && alike(&run, &self.active[partner]);
            if self.spots
                && count == 1
                && self.active[partner].meets == 2
                && self.meets.get(i + 1) == Some(&(1, partner))
            {
                let above = &self.active[partner];
                // Neighbours that touch part as well, below the row in which they met.
                let begun = self.chains[above.chain].len() > 1;
                if let Some(whole) = around_a_spot(&run, &runs[i + 1], above).filter(|_| begun) {
                    (run, continues, spotted) = (whole, true, true);
                }
            }
            let chain = if continues {
                std::mem::replace(&mut self.active[partner].chain, usize::MAX)
            } else {
                self.free.pop().unwrap_or_else(|| {
                    self.chains.push(Vec::with_capacity(FIRST));
                    self.chains.len() - 1
                })
            };
            if self.chains[chain].len() <= self.max_rows {
                self.chains[chain].push(run);
            }
            self.next.push(Active { x0: run.x0, x1: run.x1, cut: run.cut, chain, meets: 0 });
        }
        self.finish_active(finish);
        std::mem::swap(&mut self.active, &mut self.next);
    }

    /// Reports the chains that reach the last row.
    pub fn end(&mut self, finish: &mut impl FnMut(&[Chord])) {
        self.finish_active(finish);
        self.active.clear();
    }

    fn finish_active(&mut self, finish: &mut impl FnMut(&[Chord])) {
        for active in &self.active {
            if active.chain != usize::MAX {
                finish(&self.chains[active.chain]);
                self.chains[active.chain].clear();
                self.free.push(active.chain);
            }
        }
    }
}

/// Gives the chains that a chain with spots is where nothing is taken for a spot; whether it had any.
pub(crate) fn apart(chain: &[Chord], finish: &mut dyn FnMut(&[Chord])) -> bool {
    if !chain.iter().any(Chord::spotted) {
        return false;
    }
    let mut linker = Linker { spots: false, ..Linker::new(chain.len()) };
    let mut finish = |part: &[Chord]| finish(part);
    for row in chain {
        let sides = [Chord::new(row.x0, row.spot[0], row.y, row.cut), Chord::new(row.spot[1], row.x1, row.y, row.cut)];
        linker.row(if row.spotted() { &sides } else { std::slice::from_ref(row) }, &mut finish);
    }
    linker.end(&mut finish);
    true
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    fn chains(rows: &[&[(f32, f32)]]) -> Vec<usize> {
        let mut linker = Linker::new(100);
        let mut lengths = Vec::new();
        for (y, row) in rows.iter().enumerate() {
            let runs: Vec<Chord> = row.iter().map(|&(x0, x1)| Chord::new(x0, x1, y as f32, false)).collect();
            linker.row(&runs, &mut |chain| lengths.push(chain.len()));
        }
        linker.end(&mut |chain| lengths.push(chain.len()));
        lengths
    }

    #[test]
    fn separate_blobs_are_separate_chains() {
        assert_eq!(chains(&[&[(1.0, 4.0), (8.0, 9.0)], &[(2.0, 5.0), (8.0, 9.5)], &[(2.5, 4.0)]]), [2, 3]);
    }

    #[test]
    fn a_fork_ends_the_chain() {
        assert_eq!(chains(&[&[(1.0, 9.0)], &[(1.0, 9.0)], &[(1.0, 3.0), (6.0, 9.0)], &[(1.0, 3.0)]]), [2, 1, 2]);
        assert_eq!(chains(&[&[(1.0, 3.0), (6.0, 9.0)], &[(1.0, 9.0)]]), [1, 1, 1]);
    }

    #[test]
    fn a_spot_in_the_middle_leaves_the_chain_whole() {
        let spotted: &[(f32, f32)] = &[(1.0, 7.2), (8.8, 15.0)];
        assert_eq!(chains(&[&[(2.0, 14.0)], &[(1.0, 15.0)], spotted, spotted, &[(1.0, 15.0)], &[(2.0, 14.0)]]), [6]);
        let aside: &[(f32, f32)] = &[(1.0, 3.0), (4.6, 15.0)];
        assert_eq!(chains(&[&[(2.0, 14.0)], aside, &[(2.0, 14.0)]]), [1, 1, 1, 1]);
        // Two neighbours that touch in one row part below it.
        let parted: &[(f32, f32)] = &[(1.5, 7.5), (10.5, 16.5)];
        assert_eq!(chains(&[parted, &[(1.0, 17.0)], parted]), [1, 1, 1, 1, 1]);
    }

    #[test]
    fn without_spots_a_chain_comes_apart_again() {
        let rows: [&[(f32, f32)]; 5] =
            [&[(2.0, 14.0)], &[(1.0, 15.0)], &[(1.0, 7.2), (8.8, 15.0)], &[(1.0, 7.0)], &[(1.0, 6.0)]];
        let mut linker = Linker::new(100);
        let mut whole = Vec::new();
        for (y, row) in rows.iter().enumerate() {
            let runs: Vec<Chord> = row.iter().map(|&(x0, x1)| Chord::new(x0, x1, y as f32, false)).collect();
            linker.row(&runs, &mut |chain| whole.push(chain.to_vec()));
        }
        linker.end(&mut |chain| whole.push(chain.to_vec()));
        assert_eq!(whole.iter().map(Vec::len).collect::<Vec<_>>(), [5]);
        let mut parts = Vec::new();
        assert!(apart(&whole[0], &mut |part| parts.push(part.to_vec())));
        // above the spot, right of it, and left of it with what is below
        assert_eq!(parts.iter().map(Vec::len).collect::<Vec<_>>(), [2, 1, 3]);
        assert_eq!((parts[2][0].x1, parts[2][2].x1), (7.2, 6.0));
        assert!(!apart(&parts[2], &mut |_| panic!("it has none")));
    }

    #[test]
    fn a_background_run_does_not_become_a_target() {
        assert_eq!(chains(&[&[(0.0, 100.0)], &[(40.0, 50.0)], &[(38.0, 52.0)], &[(0.0, 100.0)]]), [1, 2, 1]);
    }

    #[test]
    fn a_run_to_the_border_does_not_continue_a_target() {
        let mut linker = Linker::new(100);
        let mut lengths = Vec::new();
        for (y, x1, cut) in [(0, 60.0, true), (1, 30.0, false), (2, 32.0, false), (3, 31.0, false)] {
            linker.row(&[Chord::new(10.0, x1, y as f32, cut)], &mut |chain| lengths.push(chain.len()));
        }
        linker.end(&mut |chain| lengths.push(chain.len()));
        assert_eq!(lengths, [1, 3]);
        // a large target that the border cuts stays whole
        let mut cut = Linker::new(100);
        for (y, x1) in [(0, 57.0), (1, 59.5), (2, 60.0), (3, 60.0)] {
            cut.row(&[Chord::new(10.0, x1, y as f32, x1 == 60.0)], &mut |_| panic!("it ended"));
        }
    }

    #[test]
    fn the_border_ends_runs() {
        let edge = |x, rising| Edge { x, rising, strength: 50 };
        let mut out = Vec::new();
        runs(&[edge(3.0, false), edge(9.0, true), edge(12.0, false)], true, 20, 0.5, &mut out);
        assert_eq!(out.iter().map(|c| (c.x0, c.x1, c.cut)).collect::<Vec<_>>(), [(0.0, 3.0, true), (9.0, 12.0, false)]);
        runs(&[edge(3.0, false), edge(9.0, true), edge(12.0, false)], false, 20, 0.5, &mut out);
        assert_eq!(
            out.iter().map(|c| (c.x0, c.x1, c.cut)).collect::<Vec<_>>(),
            [(3.0, 9.0, false), (12.0, 20.0, true)]
        );
    }
}
