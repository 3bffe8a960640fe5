//! Edges along a row: the fast pass over the picture.
//!
//! Where |g(x + 3) - g(x)| exceeds the threshold there is an edge; a run of such places of one sign is one edge, placed
//! at its centroid. Three pixels bridge the blur of a sharp photograph, so that an edge shows its whole contrast, and are
//! short enough to keep the two sides of a target of five pixels apart. The comparison is written over plain slices, which
//! the compiler turns into 16 comparisons at a time; only the few places where it strikes are looked at one by one.

use crate::image::{Plane, Sample};

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

/// Finds the edges of a row, from left to right. `mask` is scratch.
pub(crate) fn edges<T: Sample>(row: &[T], threshold: T, mask: &mut Vec<u8>, found: &mut Vec<Edge>) {
    found.clear();
    if row.len() <= BASE {
        return;
    }
    let count = row.len() - BASE;
    let padded = count.next_multiple_of(16);
    mask.resize(padded, 0);
    for ((strong, &left), &right) in mask.iter_mut().zip(row).zip(&row[BASE..]) {
        *strong = u8::from(left.distance(right) > threshold);
    }
    mask[count..].fill(0);

    let mut open: Option<Open> = None;
    for (block, bytes) in mask.chunks_exact(16).enumerate() {
        let Ok(bytes) = <[u8; 16]>::try_from(bytes) else { continue };
        let mut bits = u128::from_le_bytes(bytes);
        while bits != 0 {
            let place = (bits.trailing_zeros() / 8) as usize;
            bits &= !(0xff << (8 * place));
            let x = 16 * block + place;
            let (left, right) = (row[x], row[x + BASE]);
            let (rising, weight) = (right > left, left.distance(right).level());
            match &mut open {
                Some(edge) if edge.next == x && edge.rising == rising => edge.add(x, weight),
                _ => {
                    found.extend(open.map(|edge| edge.close()));
                    let mut edge = Open { first: x, next: x, rising, strength: 0, sum: 0, moment: 0 };
                    edge.add(x, weight);
                    open = Some(edge);
                }
            }
        }
    }
    found.extend(open.map(|edge| edge.close()));
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
    fn add(&mut self, x: usize, weight: u32) {
        self.sum += u64::from(weight);
        self.strength = self.strength.max(weight);
        self.moment += u64::from(weight) * (x - self.first) as u64;
        self.next = x + 1;
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
    let mut sums = vec![0u32; 4 * width];
    for y in 0..height {
        // sums of two rows are the compiler's business, 16 at a time; those of four columns are few
        for ((sum, upper), lower) in sums.iter_mut().zip(plane.row(4 * y + 1)).zip(plane.row(4 * y + 2)) {
            *sum = upper.level() + lower.level();
        }
        out.extend(sums.chunks_exact(4).map(|four| T::of((four[0] + four[1] + four[2] + four[3] + 4) / 8)));
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
        let (mut mask, mut found) = (Vec::new(), Vec::new());
        edges(&row, 30, &mut mask, &mut found);
        assert_eq!(found.len(), 2);
        assert!(found[0].rising && !found[1].rising);
        assert!((found[0].x - 9.5).abs() < 1e-5 && (found[1].x - 30.0).abs() < 1e-5, "{found:?}");
    }

    #[test]
    fn short_rows_and_flat_rows_have_none() {
        let (mut mask, mut found) = (Vec::new(), Vec::new());
        edges(&[0u8, 255, 0], 3, &mut mask, &mut found);
        assert!(found.is_empty());
        edges(&[1000u16; 77], 3, &mut mask, &mut found);
        assert!(found.is_empty());
    }
}
