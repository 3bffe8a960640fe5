//! Windows of a picture as separate pictures.

use super::SampleView;
use crate::image::Sample;

/// A window of a picture around a place.
pub(super) struct Window<T> {
    pub left: usize,
    pub top: usize,
    pub width: usize,
    pub height: usize,
    pub samples: Vec<T>,
}

impl<T: Sample> Window<T> {
    /// The window of `size` pixels a side, as far as the picture has them.
    pub fn of(plane: &SampleView<T>, u: f64, v: f64, size: usize) -> Self {
        let [left, top, width, height] = around([plane.width, plane.height], [u, v], size);
        Self::at(plane, [left, top], [width, height])
    }

    /// The window from a pixel on, of this width and height.
    pub fn at(plane: &SampleView<T>, [left, top]: [usize; 2], [width, height]: [usize; 2]) -> Self {
        let mut samples = Vec::with_capacity(width * height);
        for y in top..top + height {
            samples.extend_from_slice(&plane.row(y)[left..left + width]);
        }
        Self { left, top, width, height, samples }
    }
}

impl<T: Sample> Window<T> {
    pub fn plane(&self) -> SampleView<'_, T> {
        SampleView::new(self.width, self.height, &self.samples)
    }
}

/// Column, row, width and height of the window of `size` pixels a side around a place, as far as a picture has them.
pub(super) fn around([width, height]: [usize; 2], [u, v]: [f64; 2], size: usize) -> [usize; 4] {
    let (left, width) = window(u, size, width);
    let (top, height) = window(v, size, height);
    [left, top, width, height]
}

/// First pixel and number of pixels of a window around a place.
fn window(place: f64, size: usize, whole: usize) -> (usize, usize) {
    let start = (place - size as f64 / 2.0).max(0.0) as usize;
    let start = start.min(whole.saturating_sub(size));
    (start, size.min(whole - start))
}
