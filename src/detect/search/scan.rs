//! Edges along a row: the fast pass over the picture.
//!
//! Where |g(x + 3) - g(x)| exceeds the threshold there is an edge; a run of such places of one sign, in which noise may hide
//! a place or two, is one edge, placed at its centroid. Three pixels bridge the blur of a sharp photograph, so that an edge
//! shows its whole contrast, and are short enough to keep the two sides of a target of five pixels apart. Sixteen places are
//! compared at a time; only where there is a difference they are examined one by one.

use crate::image::{LANES, Sample};

/// Distance of the two samples that are compared, in pixels.
pub(crate) const BASE: usize = 3;

/// Maximum number of places that noise may hide in the flank of a soft edge.
const GAP: usize = 2;

/// An edge of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Edge {
    /// Place in pixel coordinates.
    pub x: f32,
    /// From dark to bright, seen in the direction of x.
    pub rising: bool,
    /// Largest difference of two samples across it.
    pub strength: u32,
}

/// Finds the edges of a row, from left to right.
#[inline(never)]
pub(crate) fn edges<T: Sample>(row: &[T], threshold: T, found: &mut Vec<Edge>) {
    found.clear();
    let Some(shifted) = row.get(BASE..) else { return };
    let mut open = None;
    let (blocks, remainder) = shifted.as_chunks();
    let rest = row.len() - BASE - remainder.len();
    for (block, (left, right)) in row.as_chunks().0.iter().zip(blocks).enumerate() {
        let bits = T::differing(left, right, threshold);
        if bits != 0 {
            let (differences, rising) = T::differences(left, right);
            extend(&differences, rising, bits, LANES * block, &mut open, found);
        }
    }
    // the last places, as a block that goes on with what does not differ
    let (mut left, mut right) = ([T::default(); LANES], [T::default(); LANES]);
    left[..remainder.len()].copy_from_slice(&row[rest..row.len() - BASE]);
    right[..remainder.len()].copy_from_slice(remainder);
    let (differences, rising) = T::differences(&left, &right);
    extend(&differences, rising, T::differing(&left, &right, threshold), rest, &mut open, found);
    if let Some(edge) = open {
        found.push(edge.close());
    }
}

/// Adds the places of a block, given as bits, to the open edge, or closes it and opens the next: one run of places of the same
/// direction at a time.
#[inline(never)]
fn extend<T: Sample>(
    differences: &[T; LANES],
    rising: u32,
    mut bits: u32,
    from: usize,
    open: &mut Option<Open>,
    found: &mut Vec<Edge>,
) {
    while bits != 0 {
        let first = bits.trailing_zeros();
        let up = rising >> first & 1 == 1;
        let alike = if up { bits & rising } else { bits & !rising };
        let count = (alike >> first).trailing_ones();
        bits &= !(((1 << count) - 1) << first);
        let start = from + first as usize;
        let edge = match open {
            Some(edge) if start - edge.next <= GAP && edge.rising == up => edge,
            _ => {
                if let Some(edge) = open {
                    found.push(edge.close());
                }
                open.insert(Open { first: start, next: start, rising: up, strength: 0, sum: 0, moment: 0 })
            }
        };
        edge.add(differences, start, first as usize, count as usize);
    }
}

/// An edge that is still growing.
#[derive(Clone, Copy)]
struct Open {
    first: usize,
    next: usize,
    rising: bool,
    strength: u32,
    // signed, as floating point is made of that in one instruction
    sum: i64,
    moment: i64,
}

impl Open {
    /// Adds `count` places of a block, from its `first` on, of which the row has `start` before.
    #[inline(always)]
    fn add<T: Sample>(&mut self, differences: &[T; LANES], start: usize, first: usize, count: usize) {
        let (mut strength, mut sum, mut moment) = (self.strength, 0, 0);
        // backwards: the moment is the sum of the sums from each place to the end
        let mut left = count;
        while left > 0 {
            let difference = differences[(first + left - 1) % LANES].level();
            strength = strength.max(difference);
            left -= 1;
            moment += sum;
            sum += difference;
        }
        let before = (start - self.first) as i64;
        self.moment += i64::from(moment) + before * i64::from(sum);
        self.sum += i64::from(sum);
        self.strength = strength;
        self.next = start + count;
    }

    #[inline]
    fn close(self) -> Edge {
        let inside = self.moment as f32 / self.sum as f32;
        // middle of the two samples, pixel centres at one half
        Edge {
            x: self.first as i32 as f32 + inside + (BASE as f32 + 1.0) / 2.0,
            rising: self.rising,
            strength: self.strength,
        }
    }
}

/// A row of the picture at a quarter of its size, for what is large or out of focus: means of four columns, of the first and
/// the third of four rows.
#[inline(never)]
pub(crate) fn quartered<T: Sample>(first: &[T], third: &[T], out: &mut Vec<T>) {
    out.clear();
    let (first, third) = (first.as_chunks::<4>().0, third.as_chunks::<4>().0);
    out.extend(first.iter().zip(third).map(|(first, third)| T::mean_of_eight(*first, *third)));
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn a_bar_has_two_edges_at_its_sides() {
        let mut row = [20u8; 60];
        row[10..30].fill(200);
        row[9] = 110; // the left side lies half a pixel further out
        let mut found = Vec::new();
        edges(&row, 30, &mut found);
        assert_eq!(found.len(), 2);
        assert!(found[0].rising && !found[1].rising);
        assert!((found[0].x - 9.5).abs() < 1e-5 && (found[1].x - 30.0).abs() < 1e-5, "{found:?}");
    }

    #[test]
    fn noise_does_not_break_a_soft_edge() {
        // differences over three pixels of 7, 14, 21, 24, 27, 20 and 13 and, where the edge goes on, of 6, 13 and 12
        let mut row = [20u8; 48];
        row[16..26].copy_from_slice(&[27, 34, 41, 51, 61, 61, 64, 67, 74, 76]);
        row[26..].fill(76);
        let mut found = Vec::new();
        edges(&row, 12, &mut found);
        assert_eq!(found.len(), 1, "{found:?}");
        // two edges of one direction further apart stay two
        let mut steps = [20u8; 48];
        steps[16..24].fill(60);
        steps[24..].fill(100);
        edges(&steps, 12, &mut found);
        assert_eq!(found.iter().map(|edge| edge.x).collect::<Vec<_>>(), [16.0, 24.0]);
    }

    #[test]
    fn short_rows_and_flat_rows_have_none() {
        let mut found = Vec::new();
        edges(&[0u8, 255, 0], 3, &mut found);
        assert!(found.is_empty());
        edges(&[1000u16; 77], 3, &mut found);
        assert!(found.is_empty());
    }
}
