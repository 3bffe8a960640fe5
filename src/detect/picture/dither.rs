//! Dithered pictures: two levels in patterns of dots.
//!
//! Dithering makes a grey of single samples that differ from all four neighbours, by a pattern of thresholds or by passing on what each
//! sample is off. A drawing, or a scan cut at one threshold, has areas and lines, and single samples only where noise crosses the threshold.

use crate::detect::acceptance::picture::{DOTS, DOTTED};
use crate::image::{Sample, SampleView};

/// Whether a picture is such a one. Ends at the third level that it meets, which in any other picture is soon.
pub(crate) fn is_dithered<T: Sample>(plane: &SampleView<T>) -> bool {
    let mut samples = (0..plane.height).flat_map(|y| plane.row(y)).map(|sample| sample.level());
    let Some(first) = samples.next() else { return false };
    let mut second = None;
    if samples.any(|level| level != first && *second.get_or_insert(level) != level) {
        return false;
    }
    let (mut single, mut changes) = (0usize, 0usize);
    for y in 1..plane.height.saturating_sub(1) {
        let [above, row, below] = [y - 1, y, y + 1].map(|y| plane.row(y));
        for x in 1..plane.width.saturating_sub(1) {
            let own = row[x];
            let across = row[x + 1] != own;
            changes += usize::from(across);
            single += usize::from(across && row[x - 1] != own && above[x] != own && below[x] != own);
        }
    }
    let all = (plane.width * plane.height) as f64;
    // each has two changes in its row
    2.0 * single as f64 > DOTTED * changes as f64 && single as f64 > DOTS * all
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn greys_of_dots_are_told_from_drawings_lines_and_specks() {
        const SIZE: usize = 96;
        let picture = |level: &dyn Fn(usize, usize) -> bool| -> Vec<u8> {
            (0..SIZE * SIZE).map(|i| if level(i % SIZE, i / SIZE) { 255 } else { 0 }).collect()
        };
        let dithered = |samples: &[u8]| is_dithered(&SampleView::new(SIZE, SIZE, samples));
        let disc = |x: usize, y: usize| (x as f64 - 48.2).hypot(y as f64 - 47.7) < 20.0;
        let screen = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];
        let of_grey = |grey: usize| picture(&move |x, y| disc(x, y) && screen[y % 4][x % 4] < grey);
        for grey in [2, 4, 8, 12] {
            assert!(dithered(&of_grey(grey)), "{grey}");
        }
        assert!(!dithered(&picture(&disc)));
        assert!(!dithered(&picture(&|x, y| disc(x, y) || x % 3 == 0 || y % 5 == 0)), "lines");
        let speck = |x: usize, y: usize| (x * 7919 + y * 104_729) % 1009 < 3;
        assert!(!dithered(&picture(&|x, y| disc(x, y) != speck(x, y))), "specks");
        // a third level: a picture of greys
        let mut grey = of_grey(8);
        grey[SIZE * SIZE - 1] = 128;
        assert!(!dithered(&grey));
        assert!(!dithered(&[7; SIZE * SIZE]));
    }
}
