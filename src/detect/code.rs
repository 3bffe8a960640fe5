//! Reading ring codes.
//!
//! A ring is read as a picture of a model: dot, gap, n equal sectors of one of two levels, and clear ground outside, all
//! blurred as the dot's own rim is. [`polar`] samples it, [`radial`] separates gap, ring and outside in each direction,
//! [`sectors`] divides the ring into sectors; here it is decided what that is.
//!
//! A ring is a code when every sector is clearly one of two levels and the same at its inner and its outer half, when the
//! gap is clear, and the ground outside beside each set sector, when its rims are where the design has them, when sectors end
//! on the grid of n and not better on that of another family, and when the family has the code. Where a few sectors only leave a doubt, the codes that remain are its
//! candidates. A margin is a level's distance from half-way, 1 when it is as clear as dot and background; the code's
//! margin is that of its worst sector.

mod light;
mod parts;
mod polar;
mod radial;
mod sectors;
mod vote;

use std::cell::OnceCell;

use super::acceptance::code as limits;
use super::outline::Outline;
use crate::detection::{CodeNote, Codes, Polarity, Target};
use crate::image::{Plane, Sample};
use crate::ring_code::{Design, Family, smallest_rotation};
use polar::{Frame, Polar};
use radial::Radial;
use sectors::Division;

pub(super) use parts::{drop_parts, settle_grounds};
pub(super) use vote::{read_all, read_in};

/// What was read around a dot.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Reading {
    /// No ring there.
    Plain,
    /// A ring that is safely one code.
    Code { number: u32, margin: f64 },
    /// A ring that may be one of these codes, and why it is not safely read.
    Doubtful { numbers: Vec<u32>, margin: f64, note: CodeNote },
    /// A ring, and why it is no code.
    NoCode { margin: f64, note: CodeNote },
}

/// Whether the dots of these codes have spots in their centres.
pub(super) fn have_spots(codes: Codes) -> bool {
    codes.families().iter().any(|family| family.design().spot() > 0.0)
}

/// Ellipse of a target.
pub(super) fn outline_of(target: &Target) -> Outline {
    Outline::from_axes(target.u, target.v, target.major / 2.0, target.minor / 2.0, target.angle)
}

/// Reads the ring around a target, whose edges have this blur in the picture, as a code of each of the families.
pub(super) fn read<T: Sample>(plane: &Plane<T>, target: &Target, blur: f64, families: &[Family]) -> Vec<Reading> {
    if !radial::may_have_ring(plane, target) {
        return vec![Reading::Plain; families.len()];
    }
    // whether the levels are light or a camera's tone curve has bent them: each family is judged by what explains it best
    let bent = light::of_screen(plane, target, blur);
    read_tones(families, |design| {
        let size = plane.width.max(plane.height);
        let as_is = straightest(plane, target, blur, design, size);
        let bent = bent.as_ref().and_then(|(part, target)| straightest(&part.plane(), target, blur, design, size));
        as_is.into_iter().chain(bent).collect()
    })
}

/// The same in a picture whose levels are a known curve of light, of which `light` is the inverse.
pub(super) fn read_curve<T: Sample>(
    plane: &Plane<T>,
    target: &Target,
    families: &[Family],
    light: impl Fn(f64) -> f64,
) -> Vec<Reading> {
    let blur = target.quality.edge_width;
    let found =
        light::of(plane, target, blur, light).filter(|(part, target)| radial::may_have_ring(&part.plane(), target));
    let Some((part, target)) = found else { return vec![Reading::Plain; families.len()] };
    let size = plane.width.max(plane.height);
    read_tones(families, |design| straightest(&part.plane(), &target, blur, design, size).into_iter().collect())
}

fn read_tones(families: &[Family], rings: impl Fn(Design) -> Vec<Radial>) -> Vec<Reading> {
    let mut readings = vec![Reading::Plain; families.len()];
    for design in [Design::Schneider, Design::Metashape] {
        if families.iter().all(|family| family.design() != design) {
            continue;
        }
        let tones: Vec<Tone> = rings(design).into_iter().map(|ring| (ring, Divisions::default())).collect();
        for (family, reading) in families.iter().zip(&mut readings) {
            if family.design() == design {
                *reading = judge(*family, &tones);
            }
        }
    }
    readings
}

/// A ring under one tone curve, and its divisions.
type Tone = (Radial, Divisions);

/// Numbers of sectors that families have, and others that may be mistaken for them.
const DIVISIONS: [u32; 8] = [12, 14, 16, 20, 13, 15, 18, 22];

/// Divisions of a ring into each of these numbers, made when they are needed.
#[derive(Default)]
struct Divisions([OnceCell<Option<Division>>; 8]);

impl Divisions {
    fn of(&self, radial: &Radial, bits: u32) -> Option<&Division> {
        let at = DIVISIONS.iter().position(|n| *n == bits)?;
        self.0[at].get_or_init(|| radial.divide(bits)).as_ref()
    }
}

/// Shift of the ring's middle, in radii, above which the perspective of a target matters.
const SHIFT: f64 = 0.1;
/// Least side of a camera's picture in pixels: a smaller one is cut out of one.
const CAMERA: usize = 640;

/// The ring under the perspective that explains it best.
///
/// A plane tilted by t at a distance that a target of semi-axis a px sees under a/f has a boost of a sin t / f along its slope; the
/// slope is that of the minor axis, and f at least 0.6 widths of the whole picture.
fn straightest<T: Sample>(plane: &Plane<T>, target: &Target, blur: f64, design: Design, size: usize) -> Option<Radial> {
    let outline = outline_of(target);
    let (a, b) = outline.semi_axes();
    let sine = (1.0 - (b / a) * (b / a)).max(0.0).sqrt();
    let largest = a * sine / (0.6 * size.max(CAMERA) as f64);
    let [inner, outer] = design.ring();
    let moves = inner * outer - 1.0;
    if largest * moves < SHIFT {
        return Radial::of(plane, target, blur, &Frame::new(outline, 0.0), design);
    }
    let steps = (largest * moves / SHIFT).ceil().min(4.0);
    let of =
        |size: f64| Radial::of(plane, target, blur, &Frame::new(outline, size), design).map(|radial| (size, radial));
    let better = |a: (f64, Radial), b: (f64, Radial)| if b.1.misfit < a.1.misfit { b } else { a };
    let all = (-(steps as i32)..=steps as i32).map(|k| largest * f64::from(k) / steps);
    let mut best = all.filter_map(of).reduce(better)?;
    for half in [0.5, 0.25] {
        let step = half * largest / steps;
        let around = [best.0 - step, best.0 + step].into_iter().filter_map(of);
        best = around.fold(best, better);
    }
    Some(best.1)
}

/// The division into so many sectors under the tone curve that explains the whole picture best. The sectors alone would not tell: what a
/// wrong curve adds to their width is taken off their neighbours, and it shows in gap, halves and outside.
fn best(tones: &[Tone], bits: u32) -> Option<(&Radial, &Division)> {
    let under = tones.iter().filter_map(|(radial, divisions)| Some((radial, divisions.of(radial, bits)?)));
    under.min_by(|a, b| a.0.whole_misfit(a.1).total_cmp(&b.0.whole_misfit(b.1)))
}

/// What a ring is as a code of a family, given its divisions into the sectors of every family of its design.
fn judge(family: Family, tones: &[Tone]) -> Reading {
    let Some((radial, division)) = best(tones, family.bits()) else { return Reading::Plain };
    let (low, high) = (division.low, division.high);
    let scale = high - low;
    if !limits::HIGH.contains(&high) || low.abs() > limits::LOW {
        return Reading::Plain;
    }
    let n = family.bits() as usize;
    let lit = division.lit();
    let above = |k: usize| division.levels[k] - (low + lit[k]) / 2.0;
    let margin_of = |k: usize| (above(k).abs() / ((lit[k] - low) / 2.0)).min(1.0);
    let margin = (0..n).map(margin_of).fold(1.0, f64::min);
    let [gap, halves, outside] =
        [&radial.gap, &radial.halves, &radial.outside].map(|levels| division.sectors(&radial.polar, levels));
    // something grey in front of a sector, beyond the ring too, hides whether it is set
    let veil = limits::VEIL[0] + limits::VEIL[1] * radial.polar.blur / radial.sector(n);
    let veiled = |k: usize| (division.levels[k] - low).min(gap[k].max(outside[k])) > veil * scale;
    let disturbed = |k: usize| {
        gap[k].abs() > limits::CLEAR * scale
            || halves[k].abs() > limits::HALVES * scale
            || if division.is_set(k) { outside[k] > limits::CLEAR * scale } else { veiled(k) }
    };
    let off = |k: usize| (division.levels[k] - if division.is_set(k) { lit[k] } else { low }).abs();
    let unclear = |k: usize| {
        off(k) > (limits::OFF * scale).max(limits::SIGMAS * division.sigmas[k])
            || margin_of(k) < limits::SAFE
            || above(k).abs() < limits::SIGMAS * division.sigmas[k]
            || (above(k) > 0.0) != division.is_set(k)
            || disturbed(k)
    };
    let in_doubt: Vec<usize> = (0..n).filter(|k| unclear(*k)).collect();
    if in_doubt.len() > limits::DOUBTFUL || division.misfit > limits::MISFIT {
        return Reading::Plain;
    }
    let set: Vec<usize> = (0..n).filter(|k| division.is_set(*k)).collect();
    let mean = |levels: &[f64]| set.iter().map(|k| levels[*k]).sum::<f64>() / set.len().max(1) as f64 / scale;
    if mean(&gap).abs() > limits::MEAN_CLEAR
        || mean(&outside).abs() > limits::MEAN_CLEAR
        || mean(&halves).abs() > limits::MEAN_HALVES
    {
        return Reading::Plain;
    }
    // the ground beside set sectors is that beside the others, or a ring of another width stands there
    let grounds = division.sectors(&radial.polar, &radial.ground);
    let beside = |is_set: bool| {
        let of = || (0..n).filter(|k| division.is_set(*k) == is_set).map(|k| grounds[k]);
        of().sum::<f64>() / of().count().max(1) as f64
    };
    if (beside(true) - beside(false)).abs() > limits::GROUNDS {
        return Reading::Plain;
    }
    // a ring shows in sectors that are beyond doubt
    let sure: Vec<usize> = set.iter().copied().filter(|k| !in_doubt.contains(k)).collect();
    if sure.len() < limits::SURE {
        return Reading::Plain;
    }
    // and its rims are where the design has them
    let mean = |levels: &[f64]| sure.iter().map(|k| levels[*k]).sum::<f64>() / sure.len() as f64 / scale;
    let off_rims = radial.off_rims([mean(&gap), mean(&halves), mean(&outside)]);
    if off_rims > 1.0 {
        return Reading::Plain;
    }
    let others = DIVISIONS.into_iter().filter(|bits| *bits != family.bits()).filter_map(|bits| best(tones, bits));
    let others = others.filter(|(_, other)| !other.same_arcs(division)).map(|(_, other)| other.misfit);
    let ratio = (division.misfit / others.fold(f64::INFINITY, f64::min)).powi(2);
    if ratio > limits::BETTER {
        return Reading::Plain;
    }
    let number = |bits: u32| family.number(smallest_rotation(bits, family.bits()));
    let mut numbers: Vec<u32> = (0..1u32 << in_doubt.len())
        .filter_map(|choice| {
            let flips = in_doubt.iter().enumerate().filter(|(i, _)| choice >> i & 1 == 1);
            number(flips.fold(division.bits, |bits, (_, k)| bits ^ 1 << (n - 1 - k)))
        })
        .collect();
    numbers.sort_unstable();
    numbers.dedup();
    if numbers.is_empty() {
        let note = if division.bits.count_ones() as usize == n { CodeNote::AllSet } else { CodeNote::NoCode };
        return Reading::NoCode { margin, note };
    }
    let (off_grid, left) = (radial.off_grid(division), radial.left(division));
    let shares = [ratio / limits::AS_GOOD, off_grid, left, off_rims, radial.whole_misfit(division) / limits::WHOLE];
    let note = if in_doubt.iter().any(|k| disturbed(*k)) {
        CodeNote::Disturbed
    } else if !in_doubt.is_empty() {
        CodeNote::BetweenLevels
    } else if ratio > limits::AS_GOOD || off_grid > 1.0 || left > 1.0 {
        CodeNote::OtherFamily
    } else if is_by_chance(shares, division.arcs(), &radial.polar) {
        CodeNote::Uncertain
    } else {
        return Reading::Code { number: numbers[0], margin };
    };
    Reading::Doubtful { numbers, margin, note }
}

/// Whether a ring may be a code by chance: near its limits in several ways at once, of which these are the shares, or too blurred for its
/// dot's radius. The smaller a ring, the more rings are nearly a code; and of a single arc one end settles the phase, the other one is on the
/// grid of some family by chance: any broken ring is that.
fn is_by_chance(shares: [f64; 5], arcs: usize, polar: &Polar) -> bool {
    let near = shares.iter().map(|share| share * share).sum::<f64>().sqrt();
    let [smallest, a_pixel, most] = limits::JOINT;
    let radius = polar.area.sqrt();
    let most = if arcs == 1 { limits::SINGLE } else { most };
    near > (smallest + a_pixel * radius).min(most) || polar.blur > limits::BLURRED * radius
}

/// Sign of a target's contrast: inside less outside.
fn sign(target: &Target) -> f64 {
    if target.polarity == Polarity::Bright { 1.0 } else { -1.0 }
}
