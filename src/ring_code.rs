//! Ring codes: n equal sectors of a ring around a target, set or not, read clockwise as seen in the photo.
//!
//! A code is the smallest number among the rotations of its bits, the first bit read being the most significant. Valid
//! codes have an even number of set bits, so that one misread bit is noticed, and at least one pair of opposite set
//! bits. The number of a target is the place of its code in the list of valid codes, counted from 1, in the order in
//! which the odd numbers 1, 3, 5 … first lead to them (the rule behind DE 197 33 466 A1, as AICON's lists show it).

/// The bits turned so that their number is smallest.
pub fn smallest_rotation(code: u32, bits: u32) -> u32 {
    let mask = (1 << bits) - 1;
    (0..bits).map(|turn| (code << turn | code >> (bits - turn)) & mask).min().unwrap_or(code)
}

/// Whether a code has even parity and a pair of opposite set bits.
fn is_valid(code: u32, bits: u32) -> bool {
    code.count_ones().is_multiple_of(2) && code & code >> (bits / 2) != 0
}

/// The valid codes of a ring of `bits` sectors (even, at most 20), in the order of their numbers: number 1 comes first.
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

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

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
    fn lists_hold_each_valid_code_once() {
        // Burnside's lemma over the rotations, brute force over all numbers.
        for bits in [12, 14, 16] {
            let codes = valid_codes(bits);
            let all = (0..1u32 << bits).filter(|c| smallest_rotation(*c, bits) == *c && is_valid(*c, bits)).count();
            assert_eq!(codes.len(), all);
            let distinct: std::collections::BTreeSet<_> = codes.iter().collect();
            assert_eq!(distinct.len(), codes.len());
        }
    }

    #[test]
    fn the_first_codes_are_known_by_hand() {
        // One pair of opposite bits is the smallest of all; with 12 bits a distance of 6.
        assert_eq!(valid_codes(12)[0], 0b0000_0100_0001);
        assert_eq!(valid_codes(14)[0], 0b00_0000_1000_0001);
    }
}
