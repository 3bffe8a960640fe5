//! Lattices among the targets of a photo: from a dot with its neighbours outwards, site by site.

use std::collections::{BTreeMap, BTreeSet};

use super::board::LatticeSite;
use super::local::{Predicted, predict, shortest};
use crate::detection::Target;
use crate::initial::robust::quantile;

/// Minimum number of dots of a lattice that is taken for a board: fewer lie in rows by chance.
pub(super) const FEWEST: usize = 9;
/// Neighbours of a dot among which its lattice's steps are looked for: in steep views several dots of a row are nearer than the next row.
const NEIGHBOURS: usize = 16;
/// Maximum distance of a seed's neighbour from the position opposite to the other neighbour, in lengths of the step.
const OPPOSITE: f64 = 0.25;
/// Largest ratio of the sizes of neighbouring dots. Beyond it clutter of any size joins.
const SIZES: f64 = 1.4;
/// Steps beyond the placed dots within which a site is examined: rows that something hides are crossed up to there.
const REACH: i32 = 3;
/// Largest standard error of a prediction and largest distance of a dot from it, in shortest steps: a dot further away is as well
/// another site's or none of the board.
const UNSURE: f64 = 0.12;
const FURTHEST: f64 = 0.25;
/// Distance of a dot from its prediction in its standard errors; and distance, in shortest steps, beyond which a dot is not of the lattice
/// once all its neighbours are placed.
const SIGMAS: f64 = 4.0;
const ASTRAY: f64 = 0.12;
/// Distance from the prediction in its standard errors, and logarithm of the ratio of a dot's size to that of the others: as multiples of the
/// median of the lattice, at least these numbers. Without them clutter takes the places of hidden dots.
const TYPICAL: f64 = 6.0;
const OFF: f64 = 0.8;
const SIZE_OFF: f64 = 0.08;
/// Largest share of dots of a lattice that are removed, and of cells with a dot of the same kind inside.
const REMOVED: f64 = 0.2;
const FILLED: f64 = 0.1;

/// Dots on offer: targets of one polarity without a code.
pub(super) struct Pool<'a> {
    pub targets: &'a [Target],
    /// Indices of the targets, ascending by u.
    pub order: Vec<usize>,
}

/// A grown lattice: target by site.
#[derive(Clone, Debug, Default)]
pub(super) struct Lattice {
    pub dots: BTreeMap<LatticeSite, usize>,
    pub places: BTreeMap<LatticeSite, [f64; 2]>,
}

struct Seed {
    /// Area of a cell over that of its dot.
    cell: f64,
    target: usize,
    steps: [[f64; 2]; 2],
}

pub(super) fn size(target: &Target) -> f64 {
    (target.major * target.minor).sqrt()
}

fn alike(a: f64, b: f64) -> bool {
    a < SIZES * b && b < SIZES * a
}

impl<'a> Pool<'a> {
    pub fn new(targets: &'a [Target], indices: impl Iterator<Item = usize>) -> Self {
        let finite = |t: &Target| [t.u, t.v, t.major, t.minor].iter().all(|x| x.is_finite()) && t.minor > 0.0;
        let mut order: Vec<usize> = indices.filter(|&k| finite(&targets[k])).collect();
        order.sort_by(|&a, &b| targets[a].u.total_cmp(&targets[b].u));
        Self { targets, order }
    }

    fn place(&self, target: usize) -> [f64; 2] {
        [self.targets[target].u, self.targets[target].v]
    }

    /// Targets within a radius of a place, with their distances, nearest first.
    pub fn near(&self, [u, v]: [f64; 2], radius: f64) -> Vec<(f64, usize)> {
        let from = self.order.partition_point(|&k| self.targets[k].u < u - radius);
        let within = self.order[from..].iter().take_while(|&&k| self.targets[k].u <= u + radius);
        let distance = |&k: &usize| ((self.targets[k].u - u).hypot(self.targets[k].v - v), k);
        let mut near: Vec<_> = within.map(distance).filter(|(d, _)| *d <= radius).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        near
    }

    /// All lattices of at least [`FEWEST`] dots, each target in one of them at most, the first found first.
    pub fn lattices(&self) -> Vec<Lattice> {
        let mut seeds: Vec<Seed> = self.order.iter().filter_map(|&k| self.seed(k)).collect();
        // the smallest cells first, for their size: steps over several dots are those of a part of the lattice
        seeds.sort_by(|a, b| a.cell.total_cmp(&b.cell));
        let mut used: BTreeSet<usize> = BTreeSet::new();
        let mut found = Vec::new();
        for seed in seeds {
            if used.contains(&seed.target) {
                continue;
            }
            let Some(lattice) = self.grown(&seed, &used) else { continue };
            used.extend(lattice.dots.values());
            found.push(lattice);
        }
        found
    }

    /// The two shortest steps of a dot that has neighbours on both sides along each.
    fn seed(&self, target: usize) -> Option<Seed> {
        let own = size(&self.targets[target]);
        let [u, v] = self.place(target);
        let mut near: Vec<(f64, [f64; 2])> = self
            .order
            .iter()
            .filter(|&&k| k != target && alike(size(&self.targets[k]), own))
            .map(|&k| [self.targets[k].u - u, self.targets[k].v - v])
            .map(|step| (step[0].hypot(step[1]), step))
            .filter(|(length, _)| *length > 0.5 * own)
            .collect();
        let count = NEIGHBOURS.min(near.len());
        if count < 4 {
            return None;
        }
        near.select_nth_unstable_by(count - 1, |a, b| a.0.total_cmp(&b.0));
        near.truncate(count);
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        // the step is the mean of both sides
        let mut both: Vec<[f64; 2]> = Vec::new();
        for (length, step) in &near {
            let across =
                |(_, other): &(f64, [f64; 2])| ((other[0] + step[0]).hypot(other[1] + step[1]) / length, *other);
            let opposite = near.iter().map(across).min_by(|a, b| a.0.total_cmp(&b.0))?;
            if opposite.0 < OPPOSITE {
                both.push([0.5 * (step[0] - opposite.1[0]), 0.5 * (step[1] - opposite.1[1])]);
            }
        }
        let a = *both.first()?;
        let sine = |b: [f64; 2]| (a[0] * b[1] - a[1] * b[0]) / (a[0].hypot(a[1]) * b[0].hypot(b[1]));
        let b = *both.iter().find(|b| sine(**b).abs() > 0.4)?;
        let b = if sine(b) > 0.0 { b } else { [-b[0], -b[1]] };
        Some(Seed { cell: (a[0] * b[1] - a[1] * b[0]) / (own * own), target, steps: [a, b] })
    }

    fn grown(&self, seed: &Seed, used: &BTreeSet<usize>) -> Option<Lattice> {
        let mut lattice = Lattice::default();
        let mut taken = used.clone();
        let [u, v] = self.place(seed.target);
        lattice.place(self, [0, 0], seed.target, &mut taken);
        for site in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
            let [p, q] = site.map(f64::from);
            let [a, b] = seed.steps;
            let at = [u + p * a[0] + q * b[0], v + p * a[1] + q * b[1]];
            let radius = FURTHEST * shortest(seed.steps);
            let near = self.near(at, radius);
            let (_, dot) = near.iter().find(|(_, k)| self.fits(*k, seed.target, &taken))?;
            lattice.place(self, site, *dot, &mut taken);
        }
        let mut barred: BTreeSet<(LatticeSite, usize)> = BTreeSet::new();
        let mut removed = 0;
        loop {
            lattice.extend(self, &mut taken, &barred);
            let Some((site, dot)) = lattice.astray() else { break };
            lattice.dots.remove(&site);
            lattice.places.remove(&site);
            taken.remove(&dot);
            barred.insert((site, dot));
            removed += 1;
            if removed as f64 > REMOVED * lattice.dots.len() as f64 {
                return None;
            }
        }
        lattice.remove_unlike(self);
        (lattice.dots.len() >= FEWEST && lattice.spans() && lattice.filled(self, &taken) <= FILLED).then_some(lattice)
    }

    fn fits(&self, target: usize, beside: usize, taken: &BTreeSet<usize>) -> bool {
        !taken.contains(&target) && alike(size(&self.targets[target]), size(&self.targets[beside]))
    }
}

impl Lattice {
    fn place(&mut self, pool: &Pool, site: LatticeSite, target: usize, taken: &mut BTreeSet<usize>) {
        self.dots.insert(site, target);
        self.places.insert(site, pool.place(target));
        taken.insert(target);
    }

    /// The placed dot next to a site.
    pub fn nearest(&self, site: LatticeSite) -> Option<usize> {
        let square = |s: &LatticeSite| (s[0] - site[0]).pow(2) + (s[1] - site[1]).pow(2);
        let window = (site[0] - REACH..=site[0] + REACH)
            .flat_map(|p| self.dots.range([p, site[1] - REACH]..=[p, site[1] + REACH]));
        window.filter(|(s, _)| **s != site).min_by_key(|(s, _)| square(s)).map(|(_, k)| *k)
    }

    /// Sites without a dot within some steps of one.
    pub fn open(&self, reach: i32) -> BTreeSet<LatticeSite> {
        let around = |s: &LatticeSite| {
            let [p, q] = *s;
            (p - reach..=p + reach).flat_map(move |p| (q - reach..=q + reach).map(move |q| [p, q]))
        };
        self.dots.keys().flat_map(around).filter(|s| !self.dots.contains_key(s)).collect()
    }

    /// Prediction of a site from the dots around it, its own left out.
    pub fn predicted(&self, site: LatticeSite) -> Option<Predicted> {
        predict(&self.places, site.map(f64::from), Some(site))
    }

    /// Places dots until none fits; the surest prediction first.
    fn extend(&mut self, pool: &Pool, taken: &mut BTreeSet<usize>, barred: &BTreeSet<(LatticeSite, usize)>) {
        for reach in 1..=REACH {
            loop {
                let mut sure: Vec<(f64, LatticeSite, usize)> = Vec::new();
                for site in self.open(reach) {
                    let Some(p) = self.predicted(site) else { continue };
                    if p.sigma_px > UNSURE * p.shortest_px {
                        continue;
                    }
                    let radius = (SIGMAS * p.sigma_px + 0.5).min(FURTHEST * p.shortest_px);
                    let Some(beside) = self.nearest(site) else { continue };
                    let near = pool.near(p.place, radius);
                    let mut fits =
                        near.iter().filter(|(_, k)| pool.fits(*k, beside, taken) && !barred.contains(&(site, *k)));
                    if let (Some((_, dot)), None) = (fits.next(), fits.next()) {
                        sure.push((p.sigma_px / p.shortest_px, site, *dot));
                    }
                }
                sure.sort_by(|a, b| a.0.total_cmp(&b.0));
                let mut placed = false;
                for (_, site, dot) in sure {
                    if !taken.contains(&dot) {
                        self.place(pool, site, dot, taken);
                        placed = true;
                    }
                }
                if !placed {
                    break;
                }
            }
        }
    }

    /// The dot that disagrees most with its neighbours.
    fn astray(&self) -> Option<(LatticeSite, usize)> {
        let distance = |(site, dot): (&LatticeSite, &usize)| {
            let p = self.predicted(*site)?;
            let [u, v] = self.places[site];
            let off = (u - p.place[0]).hypot(v - p.place[1]);
            let allowed = (SIGMAS * p.sigma_px + 0.5).min((ASTRAY * p.shortest_px).max(3.0 * p.sigma_px));
            (off > allowed).then_some((off / allowed, *site, *dot))
        };
        let worst = self.dots.iter().filter_map(distance).max_by(|a, b| a.0.total_cmp(&b.0));
        worst.map(|(_, site, dot)| (site, dot))
    }

    /// Removes the dots that are further from their places, or of another size, than the others of the lattice are.
    fn remove_unlike(&mut self, pool: &Pool) {
        let each: Vec<(LatticeSite, f64, f64)> = self
            .dots
            .iter()
            .filter_map(|(site, k)| {
                let (p, t) = (self.predicted(*site)?, &pool.targets[*k]);
                let [a, b] = p.steps;
                let off = (t.u - p.place[0]).hypot(t.v - p.place[1]) / p.sigma_px;
                Some((*site, off, (size(t) / (a[0] * b[1] - a[1] * b[0]).abs().sqrt()).ln()))
            })
            .collect();
        let median =
            |of: &dyn Fn(&(LatticeSite, f64, f64)) -> f64| quantile(&each.iter().map(of).collect::<Vec<_>>(), 0.5);
        let usual = median(&|e| e.2);
        let farthest = (TYPICAL * median(&|e| e.1)).max(OFF);
        let widest = (TYPICAL * median(&|e| (e.2 - usual).abs())).max(SIZE_OFF);
        for (site, off, ratio) in each {
            if off > farthest || (ratio - usual).abs() > widest {
                self.dots.remove(&site);
                self.places.remove(&site);
            }
        }
    }

    /// Whether it has at least two steps of extent in both directions.
    fn spans(&self) -> bool {
        (0..2).all(|k| {
            let along = || self.dots.keys().map(|s| s[k]);
            along().max().zip(along().min()).is_some_and(|(high, low)| high - low >= 2)
        })
    }

    /// Share of the cells that have a dot of the same kind inside: much of it, and the steps are twice those of the board.
    fn filled(&self, pool: &Pool, taken: &BTreeSet<usize>) -> f64 {
        let (mut cells, mut filled) = (0_u32, 0_u32);
        for (site, dot) in &self.dots {
            let corners = [[1, 0], [0, 1], [1, 1]].map(|[p, q]| self.places.get(&[site[0] + p, site[1] + q]));
            let ([u, v], [Some(a), Some(b), Some(c)]) = (self.places[site], corners) else { continue };
            cells += 1;
            let (p, q) = ([a[0] - u, a[1] - v], [b[0] - u, b[1] - v]);
            let area = p[0] * q[1] - p[1] * q[0];
            let middle = [0.25 * (u + a[0] + b[0] + c[0]), 0.25 * (v + a[1] + b[1] + c[1])];
            let radius = 0.5 * (p[0] + q[0]).hypot(p[1] + q[1]).max((p[0] - q[0]).hypot(p[1] - q[1]));
            let inside = |k: usize| {
                let x = [pool.targets[k].u - u, pool.targets[k].v - v];
                let [s, t] = [(x[0] * q[1] - x[1] * q[0]) / area, (p[0] * x[1] - p[1] * x[0]) / area];
                let corner = |s: f64| s.min(1.0 - s).abs() < 0.2;
                (-0.1..1.1).contains(&s) && (-0.1..1.1).contains(&t) && !(corner(s) && corner(t))
            };
            let one = pool.near(middle, radius).iter().any(|(_, k)| inside(*k) && pool.fits(*k, *dot, taken));
            filled += u32::from(one);
        }
        f64::from(filled) / f64::from(cells.max(1))
    }
}
