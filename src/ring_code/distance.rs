//! Selects codes with a large mutual distance.
//!
//! The distance of two codes is the smallest Hamming distance between one and any rotation of the other: so many sectors
//! must be misread before one is read as the other. All codes have even parity, so distances are even and at least 2. Codes are selected
//! greedily, by number, for each distance d from the largest down: a code is selected if it has at least the distance d from all codes
//! selected before. Codes whose arcs all end on a coarser grid come last, since they are not read if they are alone in a photo. Codes
//! closer than d to a code are found by flipping every choice of fewer than d of its bits.

use super::{Family, coarser_grid, smallest_rotation};

/// A family's codes, those with the largest mutual distance first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CodesByDistance {
    /// All numbers of the family; those on a coarser grid ([`coarser_grid`]) last.
    pub numbers: Vec<u32>,
    /// Distance, and the number of the first `numbers` that have at least this distance from each other; descending by distance.
    pub counts: Vec<(u32, usize)>,
}

/// Smallest Hamming distance between `a` and any rotation of `b`.
pub fn distance(a: u32, b: u32, bits: u32) -> u32 {
    let mask = (1 << bits) - 1;
    (0..bits).map(|turn| (a ^ (b << turn | b >> (bits - turn)) & mask).count_ones()).min().unwrap_or(0)
}

/// The order in which a family's codes should be used.
pub fn spread(family: Family) -> CodesByDistance {
    let (codes, bits) = (family.codes(), family.bits());
    let mut taken = vec![false; codes.len()];
    let coarse: Vec<bool> = codes.iter().map(|code| coarser_grid(*code, bits).is_some()).collect();
    let mut found = CodesByDistance { numbers: Vec::with_capacity(codes.len()), counts: Vec::new() };
    // two codes differ by less than half of the bits in some rotation
    for least in (2..=bits / 2).rev().filter(|d| d.is_multiple_of(2)) {
        let mut near = vec![false; codes.len()];
        let exclude = |code: u32, near: &mut [bool]| {
            let mut mark = |other: u32| {
                if let Some(number) = family.number(smallest_rotation(other, bits)) {
                    near[number as usize - 1] = true;
                }
            };
            mark(code);
            (2..least).step_by(2).for_each(|count| turned_over(code, bits, count, &mut mark));
        };
        found.numbers.iter().for_each(|number| exclude(codes[*number as usize - 1], &mut near));
        for k in 0..codes.len() {
            if taken[k] || near[k] || coarse[k] {
                continue;
            }
            taken[k] = true;
            found.numbers.push(k as u32 + 1);
            if least > 2 {
                exclude(codes[k], &mut near);
            }
        }
        if least == 2 {
            found.numbers.extend((0..codes.len()).filter(|k| coarse[*k]).map(|k| k as u32 + 1));
        }
        if found.numbers.len() > 1 && found.counts.last().is_none_or(|(_, count)| *count < found.numbers.len()) {
            found.counts.push((least, found.numbers.len()));
        }
    }
    found
}

/// Every word that differs from `code` in exactly `count` of its bits (Gosper's enumeration of the choices).
fn turned_over(code: u32, bits: u32, count: u32, mark: &mut impl FnMut(u32)) {
    let mut choice = (1u32 << count) - 1;
    while choice < 1 << bits {
        mark(code ^ choice);
        let lowest = choice & choice.wrapping_neg();
        let ripple = choice + lowest;
        choice = (((ripple ^ choice) >> 2) / lowest) | ripple;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_codes_have_the_stated_distance() {
        for family in [Family::Ring12, Family::Ring14, Family::Metashape12, Family::Metashape16] {
            let (codes, bits) = (family.codes(), family.bits());
            let spread = spread(family);
            let mut all = spread.numbers.clone();
            all.sort_unstable();
            assert!(all.into_iter().eq(1..=codes.len() as u32));
            assert_eq!(spread.counts.last(), Some(&(2, codes.len())));
            for (least, count) in &spread.counts[..spread.counts.len() - 1] {
                let first: Vec<u32> = spread.numbers[..*count].iter().map(|n| codes[*n as usize - 1]).collect();
                let pairs = || first.iter().enumerate().flat_map(|(k, a)| first[..k].iter().map(move |b| (*a, *b)));
                assert!(pairs().all(|(a, b)| distance(a, b, bits) >= *least));
                // and no other code could have been added
                let others = spread.numbers[*count..].iter().map(|n| codes[*n as usize - 1]);
                for other in others.filter(|other| coarser_grid(*other, bits).is_none()) {
                    assert!(first.iter().any(|code| distance(*code, other, bits) < *least));
                }
            }
        }
    }

    #[test]
    fn codes_on_a_coarser_grid_come_last() {
        for family in [Family::Ring12, Family::Ring16, Family::Metashape14] {
            let coarse = |n: &u32| coarser_grid(family.codes()[*n as usize - 1], family.bits()).is_some();
            let numbers = spread(family).numbers;
            let first = numbers.iter().position(coarse).unwrap();
            assert!(first > 100 && numbers[first..].iter().all(coarse), "{first}");
        }
    }

    #[test]
    fn distances_do_not_depend_on_how_the_targets_are_turned() {
        assert_eq!(distance(0b0000_0100_0001, 0b1000_0010_0000, 12), 0);
        assert_eq!(distance(0b0000_0100_0001, 0b0000_0110_0011, 12), 2);
        assert_eq!(distance(0b11, 0b111_1100, 12), 3);
    }
}
