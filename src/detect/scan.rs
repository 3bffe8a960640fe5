//! Edges along a row: the fast pass over the picture.
//!
//! Where |g(x + 3) - g(x)| exceeds the threshold there is an edge; a run of such places of one sign is one edge, placed
//! at its centroid. Three pixels bridge the blur of a sharp photograph, so that an edge shows its whole contrast, and are
//! short enough to keep the two sides of a target of five pixels apart. Sixteen places are compared at a time; only the few
//! where there is a difference are looked at one by one.

use crate::image::{LANES, Plane, Sample};

/// Distance of the two samples that are compared, in pixels.
pub(crate) const BASE: usize = 3;

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
            extend(row, LANES * block, bits, &mut open, found);
        }
    }
    let last = (rest..row.len() - BASE).enumerate();
    let bits = last.fold(0, |bits, (k, x)| bits | u32::from(row[x].distance(row[x + BASE]) > threshold) << k);
    extend(row, rest, bits, &mut open, found);
    if let Some(edge) = open {
        found.push(edge.close());
    }
}

/// Adds the places of a block, given as bits, to the open edge, or closes it and opens the next.
#[inline(never)]
fn extend<T: Sample>(row: &[T], from: usize, mut bits: u32, open: &mut Option<Open>, found: &mut Vec<Edge>) {
    while bits != 0 {
        let x = from + bits.trailing_zeros() as usize;
        bits &= bits - 1;
        let (left, right) = (row[x].level(), row[x + BASE].level());
        let (rising, weight) = (right > left, left.abs_diff(right));
        if let Some(edge) = open {
            if edge.next == x && edge.rising == rising {
                edge.add(weight);
                continue;
            }
            found.push(edge.close());
        }
        *open = Some(Open { first: x, next: x + 1, rising, strength: weight, sum: weight.into(), moment: 0 });
    }
}

/// An edge that is still growing.
#[derive(Clone, Copy)]
struct Open {
    first: usize,
    next: usize,
    rising: bool,
    strength: u32,
    sum: u64,
    moment: u64,
}

impl Open {
    #[inline]
    fn add(&mut self, weight: u32) {
        self.sum += u64::from(weight);
        self.strength = self.strength.max(weight);
        self.moment += u64::from(weight) * (self.next - self.first) as u64;
        self.next += 1;
    }

    #[inline]
    fn close(self) -> Edge {
        let inside = self.moment as f32 / self.sum as f32;
        // middle of the two samples, pixel centres at one half
        Edge { x: self.first as f32 + inside + (BASE as f32 + 1.0) / 2.0, rising: self.rising, strength: self.strength }
    }
}

/// The picture at a quarter of its size: the mean of 4 columns and 2 of 4 rows, for what is large or out of focus.
pub(crate) fn quartered<T: Sample>(plane: &Plane<T>) -> (usize, usize, Vec<T>) {
    let (width, height) = (plane.width / 4, plane.height / 4);
    let mut out = Vec::with_capacity(width * height);
    for y in 0..height {
        let (upper, lower) = (plane.row(4 * y + 1).as_chunks::<4>().0, plane.row(4 * y + 2).as_chunks::<4>().0);
        out.extend(upper.iter().zip(lower).map(|(upper, lower)| T::mean_of_eight(*upper, *lower)));
    }
    (width, height, out)
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
    fn short_rows_and_flat_rows_have_none() {
        let mut found = Vec::new();
        edges(&[0u8, 255, 0], 3, &mut found);
        assert!(found.is_empty());
        edges(&[1000u16; 77], 3, &mut found);
        assert!(found.is_empty());
    }
}
