//! Decides whether a ring is a code of a family, by a sequence of tests.
//!
//! A ring is a code when every sector is clearly one of two levels and the same at its inner and its outer half, when the
//! gap is clear, and the background outside beside each set sector, when its rims are where the design has them, when sectors explain
//! it better than discs in their places, when they end on the grid of n and not better on that of another family, and when the
//! family has the code. Where a few sectors only leave a doubt, the codes that remain are its candidates. A margin is a level's
//! distance from half-way, 1 when it is as clear as dot and background; the code's margin is that of its worst sector.

use std::cell::OnceCell;

use super::CodeReading;
use super::discs;
use super::radial::Radial;
use super::sectors::Division;
use crate::detect::acceptance::code as limits;
use crate::detection::CodeNote;
use crate::ring_code::{Family, coarser_grid, smallest_rotation};

/// A ring under one tone curve, and its divisions.
pub(super) type Tone = (Radial, Divisions);

/// Numbers of sectors that families have, and others that may be mistaken for them.
const DIVISIONS: [u32; 8] = [12, 14, 16, 20, 13, 15, 18, 22];

/// Divisions of a ring into each of these numbers, made when they are needed.
#[derive(Default)]
pub(super) struct Divisions([OnceCell<Option<Division>>; 8]);

impl Divisions {
    fn of(&self, radial: &Radial, bits: u32) -> Option<&Division> {
        let at = DIVISIONS.iter().position(|n| *n == bits)?;
        self.0[at].get_or_init(|| radial.divide(bits)).as_ref()
    }
}

/// The division into so many sectors under the tone curve that explains the whole picture best. The sectors alone would not tell: what a
/// wrong curve adds to their width is taken off their neighbours, and it shows in gap, halves and outside.
fn best(tones: &[Tone], bits: u32) -> Option<(&Radial, &Division)> {
    let under = tones.iter().filter_map(|(radial, divisions)| Some((radial, divisions.of(radial, bits)?)));
    under.min_by(|a, b| a.0.whole_misfit(a.1).total_cmp(&b.0.whole_misfit(b.1)))
}

/// A ring as one division has it; levels are shares of the dot's contrast, those of gap, halves and outside in sectors.
struct Ring<'a> {
    radial: &'a Radial,
    division: &'a Division,
    /// Number of sectors.
    n: usize,
    /// Difference between the levels of set and unset sectors.
    scale: f64,
    /// Level of set sectors in the light of each.
    lit: Vec<f64>,
    gap: Vec<f64>,
    halves: Vec<f64>,
    outside: Vec<f64>,
    /// Maximum deviation of an unset sector that has the same sign as that of its gap or background.
    veil: f64,
}

impl<'a> Ring<'a> {
    fn new(radial: &'a Radial, division: &'a Division) -> Self {
        let n = division.levels.len();
        let [gap, halves, outside] =
            [&radial.gap, &radial.halves, &radial.outside].map(|levels| division.sectors(&radial.rays, levels));
        let scale = division.high - division.low;
        let veil = (limits::VEIL[0] + limits::VEIL[1] * radial.rays.blur / radial.sector(n)) * scale;
        Self { radial, division, n, scale, lit: division.lit(), gap, halves, outside, veil }
    }

    /// A sector's level above half-way, and that distance as a share of the whole one.
    fn above(&self, k: usize) -> f64 {
        self.division.levels[k] - (self.division.low + self.lit[k]) / 2.0
    }

    fn margin(&self, k: usize) -> f64 {
        (self.above(k).abs() / ((self.lit[k] - self.division.low) / 2.0)).min(1.0)
    }

    /// Whether something stands in the gap, across the ring or on the background of a sector. What is grey and reaches beyond the ring hides
    /// whether a sector is set.
    fn is_disturbed(&self, k: usize) -> bool {
        let on_ground = if self.division.is_set(k) {
            self.outside[k] > limits::CLEAR * self.scale
        } else {
            (self.division.levels[k] - self.division.low).min(self.gap[k].max(self.outside[k])) > self.veil
        };
        self.gap[k].abs() > limits::CLEAR * self.scale
            || self.halves[k].abs() > limits::HALVES * self.scale
            || on_ground
    }

    /// Whether a sector is not clearly one of two levels.
    fn is_unclear(&self, k: usize) -> bool {
        let Division { levels, sigmas, low, .. } = self.division;
        let is_set = self.division.is_set(k);
        let off = (levels[k] - if is_set { self.lit[k] } else { *low }).abs();
        off > (limits::OFF * self.scale).max(limits::SIGMAS * sigmas[k])
            || self.margin(k) < limits::SAFE
            || self.above(k).abs() < limits::SIGMAS * sigmas[k]
            || (self.above(k) > 0.0) != is_set
            || self.is_disturbed(k)
    }

    /// Means of gap, halves and outside over some sectors, as shares of the step.
    fn means(&self, sectors: &[usize]) -> [f64; 3] {
        [&self.gap, &self.halves, &self.outside]
            .map(|levels| sectors.iter().map(|k| levels[*k]).sum::<f64>() / sectors.len().max(1) as f64 / self.scale)
    }

    /// Gate: on the whole gap, halves and outside of set sectors are clear.
    fn is_clear(&self, set: &[usize]) -> bool {
        let [gap, halves, outside] = self.means(set);
        gap.abs() <= limits::MEAN_CLEAR && outside.abs() <= limits::MEAN_CLEAR && halves.abs() <= limits::MEAN_HALVES
    }

    /// Gate: the background beside set sectors is that beside the others, or a ring of another width stands there.
    fn has_one_ground(&self) -> bool {
        let grounds = self.division.sectors(&self.radial.rays, &self.radial.ground);
        let beside = |is_set: bool| {
            let of = || (0..self.n).filter(|k| self.division.is_set(*k) == is_set).map(|k| grounds[k]);
            of().sum::<f64>() / of().count().max(1) as f64
        };
        (beside(true) - beside(false)).abs() <= limits::GROUNDS
    }

    /// Numbers of a family that the ring may have, whatever the sectors in doubt are.
    fn numbers(&self, family: Family, in_doubt: &[usize]) -> Vec<u32> {
        let mut numbers: Vec<u32> = (0..1u32 << in_doubt.len())
            .filter_map(|choice| {
                let flips = in_doubt.iter().enumerate().filter(|(i, _)| choice >> i & 1 == 1);
                let bits = flips.fold(self.division.bits, |bits, (_, k)| bits ^ 1 << (self.n - 1 - k));
                family.number(smallest_rotation(bits, family.bits()))
            })
            .collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }
}

/// Square of the misfit of a family's division over that of the best one into another number of sectors, with other arcs.
fn rivalry(family: Family, division: &Division, tones: &[Tone]) -> f64 {
    let others = DIVISIONS.into_iter().filter(|bits| *bits != family.bits()).filter_map(|bits| best(tones, bits));
    let others = others.filter(|(_, other)| !other.same_arcs(division)).map(|(_, other)| other.misfit);
    (division.misfit / others.fold(f64::INFINITY, f64::min)).powi(2)
}

/// What a ring is as a code of a family, given its divisions into the sectors of every family of its design.
pub(super) fn judge(family: Family, tones: &[Tone]) -> CodeReading {
    if tones.iter().all(|(radial, _)| radial.is_faint() || radial.is_clutter()) {
        return CodeReading::Plain;
    }
    let Some((radial, division)) = best(tones, family.bits()) else { return CodeReading::Plain };
    if !limits::HIGH.contains(&division.high) || division.low.abs() > limits::LOW {
        return CodeReading::Plain;
    }
    let ring = Ring::new(radial, division);
    let margin = (0..ring.n).map(|k| ring.margin(k)).fold(1.0, f64::min);
    let in_doubt: Vec<usize> = (0..ring.n).filter(|k| ring.is_unclear(*k)).collect();
    let set: Vec<usize> = (0..ring.n).filter(|k| division.is_set(*k)).collect();
    // a ring shows in sectors that are beyond doubt
    let sure: Vec<usize> = set.iter().copied().filter(|k| !in_doubt.contains(k)).collect();
    if in_doubt.len() > limits::DOUBTFUL
        || division.misfit > limits::MISFIT
        || !ring.is_clear(&set)
        || !ring.has_one_ground()
        || sure.len() < limits::SURE
    {
        return CodeReading::Plain;
    }
    // and its rims are where the design has them
    let off_rims = radial.off_rims(ring.means(&sure));
    if off_rims > 1.0 {
        return CodeReading::Plain;
    }
    // dots around a dot are no ring
    let of_discs = discs::rivalry(radial, division);
    let is_shaped = radial.sector(family.bits() as usize) >= limits::SHAPED;
    let [most, doubtful] = if is_shaped { limits::DISCS } else { [limits::DISCS_SMALL; 2] };
    if of_discs > most {
        return CodeReading::Plain;
    }
    let ratio = rivalry(family, division, tones);
    if ratio > limits::BETTER {
        return CodeReading::Plain;
    }
    let numbers = ring.numbers(family, &in_doubt);
    // a ring of 8 sectors is one of 16 that come in pairs
    let is_coarse = in_doubt.is_empty() && set.len() < ring.n && coarser_grid(division.bits, family.bits()).is_some();
    if numbers.is_empty() {
        if is_coarse {
            return CodeReading::Coarse { number: None, margin };
        }
        let note = if set.len() == ring.n { CodeNote::AllSet } else { CodeNote::NoCode };
        return CodeReading::NoCode { margin, note };
    }
    let (off_grid, left) = (radial.off_grid(division), radial.left(division));
    let shares = [ratio / limits::AS_GOOD, off_grid, left, off_rims, radial.whole_misfit(division) / limits::WHOLE];
    let note = if in_doubt.iter().any(|k| ring.is_disturbed(*k)) {
        CodeNote::Disturbed
    } else if !in_doubt.is_empty() {
        CodeNote::BetweenLevels
    } else if of_discs > doubtful || ratio > limits::AS_GOOD || off_grid > 1.0 || left > 1.0 {
        CodeNote::OtherFamily
    } else if is_coarse && is_by_chance(shares, division.arcs(), radial) {
        // two doubts are more than the company of other codes settles
        CodeNote::OtherFamily
    } else if is_coarse {
        return CodeReading::Coarse { number: Some(numbers[0]), margin };
    } else if is_by_chance(shares, division.arcs(), radial) {
        CodeNote::Uncertain
    } else {
        return CodeReading::Code { number: numbers[0], margin };
    };
    CodeReading::Doubtful { numbers, margin, note }
}

/// Whether a ring may be a code by chance: near its limits in several ways at once, of which these are the shares, or too blurred for its
/// dot's radius. The smaller a ring, the more rings are nearly a code; and of a single arc one end settles the phase, the other one is on the
/// grid of some family by chance: any broken ring is that, and one of several around each other most of all.
fn is_by_chance(shares: [f64; 5], arcs: usize, Radial { rays, ringed, .. }: &Radial) -> bool {
    let near = shares.iter().map(|share| share * share).sum::<f64>().sqrt();
    let [smallest, a_pixel, most] = limits::JOINT;
    let radius = rays.area.sqrt();
    let most = if arcs == 1 { limits::SINGLE } else { most };
    arcs == 1 && *ringed > limits::RINGED
        || near > (smallest + a_pixel * radius).min(most)
        || rays.blur > limits::BLURRED * radius
}
