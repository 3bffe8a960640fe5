//! Codes among other figures: what is none is not read as one, and reading codes takes no other target away.

use super::codes::{COUNT, Coded, Look, PITCH, laid_out, painted, read};
use crate::support::extent;
use crate::support::painter::Uniform;
use sightline::detection::{Codes, Target};
use sightline::ring_code::Family;

/// Contents of a cell of a plate other than a coded target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Beside {
    Code,
    /// A code with dots beside its ring.
    Dots,
    /// A dot alone.
    Dot,
    /// A dot with smaller ones around it, where a ring would be.
    Satellites,
    /// A dot in two rings.
    Concentric,
}

impl Beside {
    const ALL: [Self; 5] = [Self::Code, Self::Dots, Self::Dot, Self::Satellites, Self::Concentric];

    fn is_code(self) -> bool {
        matches!(self, Self::Code | Self::Dots)
    }

    /// Whether a place shows the dot's colour; sizes follow from the target's own numbers.
    fn is_marked(self, target: &Coded, x: f64, y: f64, family: Family) -> bool {
        let [radius, turn] = target.polar(x, y);
        let ([inner, outer], bits) = (family.design().ring(), family.bits());
        // discs of a size around the target, at a distance, in these sectors
        let disc = |size: f64, distance: f64, sectors: f64| {
            let share = (turn * sectors).floor() + 0.5;
            let away = (turn - share / sectors) * std::f64::consts::TAU;
            (radius * away.cos() - distance).hypot(radius * away.sin()) < size
        };
        let part = f64::from(target.number % 7) / 7.0;
        let width = outer - inner;
        match self {
            Self::Code => target.is_marked(x, y, family),
            Self::Dots => target.is_marked(x, y, family) || disc(0.5, outer + 0.95, 5.0),
            Self::Dot => radius < 1.0,
            Self::Satellites => {
                let sector = ((turn * f64::from(bits)) as u32).min(bits - 1);
                let is_set = target.code >> (bits - 1 - sector) & 1 == 1;
                let aside = 0.06 * (f64::from(target.number / 8 % 5) - 2.0);
                let size = 0.25 + 0.05 * f64::from(target.number % 8);
                radius < 1.0 || is_set && disc(size * width, inner + (0.5 + aside) * width, f64::from(bits))
            }
            Self::Concentric => {
                radius < 1.0
                    || (inner - 0.3 * part..outer).contains(&radius)
                    || (outer + 0.5..outer + 0.9).contains(&radius)
            }
        }
    }
}

/// Nothing beside a code is read as one, and only what is within the ring of a code that is read goes when codes are read.
#[test]
fn codes_switched_on_remove_no_target() {
    let mut random = Uniform(21);
    let mut kept = 0;
    // of 20 bits the larger discs, cut off where their sectors end, fill them
    let families = [Family::Ring12, Family::Ring16, Family::Metashape14];
    for (seed, &family) in extent::of(&families, 1).iter().enumerate() {
        let look = Look { radii: [6.0, 10.0], blur: random.within(0.6, 1.0), dark: seed % 2 == 0, even: true };
        let mut coded = laid_out(family, family.codes(), &look, &mut random);
        coded.iter_mut().for_each(|target| target.squeeze = target.squeeze.max(0.7));
        let cell = |x: f64, y: f64| (y / PITCH as f64) as usize * COUNT + (x / PITCH as f64) as usize;
        let beside = |k: usize| Beside::ALL[(k + k / COUNT) % Beside::ALL.len()];
        let plate = painted(coded, &look, seed as u64, |target, x, y| {
            beside(cell(target.u, target.v)).is_marked(target, x, y, family)
        });
        let at = |target: &Target| {
            let k = cell(target.u, target.v);
            (beside(k), plate.coded[k].number, plate.coded[k].polar(target.u, target.v)[0])
        };
        let (without, with) = (read(&plate, Codes::None), read(&plate, family.into()));
        for target in with.targets.iter().filter(|target| target.code.is_some()) {
            let (beside, number, radius) = at(target);
            assert!(
                beside.is_code() && radius < 0.5 && target.code == Some(number),
                "{family:?} {beside:?}: {target:?}"
            );
        }
        let [inner, outer] = family.design().ring();
        for target in &without.targets {
            let (beside, _, radius) = at(target);
            let is_part = beside.is_code() && (inner - 0.25..outer + 0.25).contains(&radius);
            let same = |other: &Target| (target.u - other.u).hypot(target.v - other.v) < 0.5;
            assert!(is_part || with.targets.iter().any(same), "{family:?} {beside:?}: {target:?} is lost");
            kept += usize::from(!is_part);
        }
    }
    assert!(kept > extent::cases(33, 100), "{kept}");
}
