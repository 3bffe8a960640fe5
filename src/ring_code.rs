//! Ring codes: n equal sectors of a ring around a target, set or not, read clockwise as seen in the photo.
//!
//! A code is the smallest number among the rotations of its bits, the first bit read being the most significant. Every
//! family has an even number of set bits, so that one misread bit is noticed, and a ring set all around is none: it tells
//! no sector from another. The families differ in the size of the ring and in which codes they use in which order:
//!
//! - Schneider / AICON (DE 197 33 466 A1): ring from 2 to 3 radii of the dot. Codes with at least one pair of opposite set
//!   bits, counted from 1 in the order in which the odd numbers 1, 3, 5 ... first lead to them.
//! - Metashape circular: ring from 2.28 to 3.54 radii, a spot of the background's colour of 0.09 radii in the dot's centre. The
//!   least significant bit's sector begins at three o'clock of the upright target and runs counter-clockwise. Codes of
//!   more than two set bits from 2^(n/2) on, counted from 1 by size.

mod distance;

use std::sync::OnceLock;

use serde::{Deserialize, Serialize};

pub use distance::{CodesByDistance, distance, spread};

/// A family of ring codes, by its maker's name and its number of bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Family {
    /// Schneider / AICON, 12 bits.
    #[serde(rename = "ring-12")]
    Ring12,
    /// Schneider / AICON, 14 bits.
    #[serde(rename = "ring-14")]
    Ring14,
    /// Schneider / AICON, 16 bits.
    #[serde(rename = "ring-16")]
    Ring16,
    /// Schneider / AICON, 20 bits.
    #[serde(rename = "ring-20")]
    Ring20,
    /// Metashape circular, 12 bits.
    #[serde(rename = "metashape-12")]
    Metashape12,
    /// Metashape circular, 14 bits.
    #[serde(rename = "metashape-14")]
    Metashape14,
    /// Metashape circular, 16 bits.
    #[serde(rename = "metashape-16")]
    Metashape16,
    /// Metashape circular, 20 bits.
    #[serde(rename = "metashape-20")]
    Metashape20,
}

/// Sizes of a coded target, in radii of its dot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Design {
    /// Schneider / AICON.
    #[default]
    Schneider,
    /// Metashape circular.
    Metashape,
}

impl Design {
    /// Inner and outer radius of the ring.
    pub fn ring(self) -> [f64; 2] {
        match self {
            Self::Schneider => [2.0, 3.0],
            Self::Metashape => [2.28, 3.54],
        }
    }

    /// Radius of the spot in the dot's centre; 0 without one.
    pub fn spot(self) -> f64 {
        match self {
            Self::Schneider => 0.0,
            Self::Metashape => 0.09,
        }
    }
}

impl Family {
    /// All families.
    pub const ALL: [Self; 8] = [
        Self::Ring12,
        Self::Ring14,
        Self::Ring16,
        Self::Ring20,
        Self::Metashape12,
        Self::Metashape14,
        Self::Metashape16,
        Self::Metashape20,
    ];

    /// Number of sectors.
    pub fn bits(self) -> u32 {
        match self {
            Self::Ring12 | Self::Metashape12 => 12,
            Self::Ring14 | Self::Metashape14 => 14,
            Self::Ring16 | Self::Metashape16 => 16,
            Self::Ring20 | Self::Metashape20 => 20,
        }
    }

    /// How its targets look.
    pub fn design(self) -> Design {
        match self {
            Self::Ring12 | Self::Ring14 | Self::Ring16 | Self::Ring20 => Design::Schneider,
            _ => Design::Metashape,
        }
    }

    /// The codes in the order of their numbers: number 1 comes first.
    pub fn codes(self) -> &'static [u32] {
        &self.list().codes
    }

    /// Number of a code given as its smallest rotation; `None` if the family does not have it.
    pub fn number(self, code: u32) -> Option<u32> {
        let by_code = &self.list().by_code;
        let place = by_code.binary_search_by_key(&code, |(code, _)| *code).ok()?;
        Some(by_code[place].1)
    }

    /// The lists of 20 bits take a while: each is made once.
    fn list(self) -> &'static CodeList {
        static LISTS: [OnceLock<CodeList>; 8] = [const { OnceLock::new() }; 8];
        LISTS[self as usize].get_or_init(|| {
            let codes = match self.design() {
                Design::Schneider => valid_codes(self.bits()),
                Design::Metashape => metashape_codes(self.bits()),
            };
            let mut by_code: Vec<_> = codes.iter().zip(1..).map(|(code, number)| (*code, number)).collect();
            by_code.sort_unstable();
            CodeList { codes, by_code }
        })
    }
}

/// A family's codes in the order of their numbers, and by code with their numbers.
struct CodeList {
    codes: Vec<u32>,
    by_code: Vec<(u32, u32)>,
}

/// The bits turned so that their number is smallest.
pub fn smallest_rotation(code: u32, bits: u32) -> u32 {
    let mask = (1 << bits) - 1;
    (0..bits).map(|turn| (code << turn | code >> (bits - turn)) & mask).min().unwrap_or(code)
}

/// Number of sectors of the coarser grid on which every arc of a ring of `bits` sectors ends: the largest m below `bits` that
/// divides it and in whose sectors, from some sector on, the bits are alike. No picture tells such a ring from one of m sectors, which other
/// programs print (8 and 10). `None` if some arc ends between them; 1 where all or none are set.
pub fn coarser_grid(code: u32, bits: u32) -> Option<u32> {
    // where the level changes between a sector and the one before it
    let mask = (1u32 << bits) - 1;
    let changes = (code ^ (code << 1 | code >> (bits - 1))) & mask;
    (1..bits).rev().filter(|m| bits.is_multiple_of(*m)).find(|m| {
        let width = bits / m;
        let ends = (0..bits).step_by(width as usize).fold(0u32, |ends, k| ends | 1 << k);
        (0..width).any(|turn| changes & !(ends << turn) & mask == 0)
    })
}

/// Whether a code has even parity, a pair of opposite set bits and one that is not set.
fn is_valid(code: u32, bits: u32) -> bool {
    code.count_ones().is_multiple_of(2) && code & code >> (bits / 2) != 0 && code.count_ones() < bits
}

/// The Schneider / AICON codes of a ring of `bits` sectors (even, at most 20), in the order of their numbers: number 1
/// comes first.
pub fn valid_codes(bits: u32) -> Vec<u32> {
    let mut seen = vec![false; 1 << bits];
    let mut codes = Vec::new();
    for odd in (1..1u32 << bits).step_by(2) {
        let code = smallest_rotation(odd, bits);
        if is_valid(code, bits) && !std::mem::replace(&mut seen[code as usize], true) {
            codes.push(code);
        }
    }
    codes
}

/// The Metashape circular codes of a ring of `bits` sectors (even, at most 20), in the order of their numbers.
pub fn metashape_codes(bits: u32) -> Vec<u32> {
    let is_code = |code: &u32| {
        let set = code.count_ones();
        set.is_multiple_of(2) && set > 2 && set < bits && smallest_rotation(*code, bits) == *code
    };
    // the smallest rotation of anything set is odd
    (1 + (1u32 << (bits / 2))..1 << bits).step_by(2).filter(is_code).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rotation_has_the_same_smallest() {
        let code = 0b00_1011_0000_0101;
        for turn in 0..14 {
            let turned = (code << turn | code >> (14 - turn)) & 0x3fff;
            assert_eq!(smallest_rotation(turned, 14), 0b1_0100_1011);
        }
    }

    #[test]
    fn lists_have_the_lengths_their_makers_print() {
        let lengths = Family::ALL.map(|family| family.codes().len());
        assert_eq!(lengths, [147, 516, 1861, 24793, 161, 561, 2001, 26013]);
    }

    #[test]
    fn lists_hold_each_code_once_and_as_its_smallest_rotation() {
        for family in Family::ALL {
            let codes = family.codes();
            let distinct: std::collections::BTreeSet<_> = codes.iter().collect();
            assert_eq!(distinct.len(), codes.len());
            for (code, number) in codes.iter().zip(1..) {
                assert_eq!((smallest_rotation(*code, family.bits()), family.number(*code)), (*code, Some(number)));
                assert_eq!(code.count_ones() % 2, 0);
            }
        }
    }

    #[test]
    fn the_first_codes_are_known_by_hand() {
        // One pair of opposite bits is the smallest of all; with 12 bits a distance of 6.
        assert_eq!(valid_codes(12)[0], 0b0000_0100_0001);
        assert_eq!(valid_codes(14)[0], 0b00_0000_1000_0001);
        // Of more than two bits the smallest from 64 on: 67 = 64 + 3 has three.
        assert_eq!(metashape_codes(12)[..3], [0b100_0111, 0b100_1011, 0b100_1101]);
    }

    #[test]
    fn rings_on_a_coarser_grid_are_those_of_repeated_bits() {
        for family in Family::ALL {
            let bits = family.bits();
            let repeated = |m: u32| {
                let width = bits / m;
                let widen = move |code: u32| (0..bits).fold(0u32, |wide, k| wide | (code >> (k / width) & 1) << k);
                (0..1u32 << m).map(move |code| smallest_rotation(widen(code), bits))
            };
            let all: std::collections::BTreeSet<u32> =
                (1..bits).filter(|m| bits.is_multiple_of(*m)).flat_map(repeated).collect();
            for code in family.codes() {
                let turned = (code << 5 | code >> (bits - 5)) & ((1 << bits) - 1);
                assert_eq!(coarser_grid(*code, bits).is_some(), all.contains(code), "{family:?} {code:b}");
                assert_eq!(coarser_grid(*code, bits), coarser_grid(turned, bits));
            }
        }
        assert_eq!(coarser_grid(0b1100_0011_0011_1100, 16), Some(8));
        assert_eq!(coarser_grid(0b11111_00000_11111_00000, 20), Some(4));
        assert_eq!(coarser_grid(0b1100_0011_0011_1000, 16), None);
    }

    #[test]
    fn few_codes_lie_on_a_coarser_grid() {
        let count =
            |family: Family| family.codes().iter().filter(|c| coarser_grid(**c, family.bits()).is_some()).count();
        assert_eq!(Family::ALL.map(count), [8, 14, 24, 82, 9, 14, 26, 91]);
    }

    #[test]
    fn a_ring_set_all_around_is_no_code() {
        for family in Family::ALL {
            assert_eq!(family.number((1 << family.bits()) - 1), None);
        }
    }
}
