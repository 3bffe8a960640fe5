//! Grey pictures of 8 or 16 bits, owned or borrowed, row by row from the top left.

use wide::{bytemuck, f32x4, i32x4, u8x16, u16x8, u32x4};

use crate::error::{Error, Place, Reason, Result};

/// Samples of a grey picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Samples {
    /// 8 bits.
    U8(Vec<u8>),
    /// 16 bits.
    U16(Vec<u16>),
}

/// An owned grey picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grey {
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// Row by row.
    pub samples: Samples,
}

/// Borrowed samples.
#[derive(Clone, Copy, Debug)]
pub enum SamplesView<'a> {
    /// 8 bits.
    U8(&'a [u8]),
    /// 16 bits.
    U16(&'a [u16]),
}

/// A borrowed grey picture; its length is known to be width times height, and neither is 0.
#[derive(Clone, Copy, Debug)]
pub struct GreyView<'a> {
    width: usize,
    height: usize,
    samples: SamplesView<'a>,
}

impl<'a> GreyView<'a> {
    /// Borrows samples.
    ///
    /// # Errors
    /// [`Error::Invalid`] unless there are exactly width times height samples, at least one.
    pub fn new(width: usize, height: usize, samples: SamplesView<'a>) -> Result<Self> {
        let count = match samples {
            SamplesView::U8(s) => s.len(),
            SamplesView::U16(s) => s.len(),
        };
        if width == 0 || height == 0 || width.checked_mul(height) != Some(count) {
            return Err(Error::Invalid {
                reason: Reason::Samples { samples: count, width, height },
                at: Place::field("samples"),
            });
        }
        Ok(Self { width, height, samples })
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The samples.
    pub fn samples(&self) -> SamplesView<'a> {
        self.samples
    }

    /// Bits of a sample, 8 or 16.
    pub fn bits(&self) -> u32 {
        match self.samples {
            SamplesView::U8(_) => 8,
            SamplesView::U16(_) => 16,
        }
    }
}

/// A kind of sample the algorithms are written for once.
pub(crate) trait Sample: Copy + Ord + Default {
    /// Largest value.
    const MAX: u32;
    /// Grey level as a number.
    fn level(self) -> u32;
    /// Grey level from a number that fits.
    fn of(level: u32) -> Self;
    /// Where two rows of samples differ by more than the threshold: bit k for the k-th of them.
    fn differing(left: &[Self; LANES], right: &[Self; LANES], threshold: Self) -> u32;
    /// The absolute differences, and where the right row is the brighter one.
    fn differences(left: &[Self; LANES], right: &[Self; LANES]) -> ([Self; LANES], u32);
    /// Rounded mean of four samples above and four below.
    fn mean_of_eight(upper: [Self; 4], lower: [Self; 4]) -> Self;
}

/// Samples that are compared at once.
pub(crate) const LANES: usize = 16;

impl Sample for u8 {
    const MAX: u32 = 255;
    #[inline(always)]
    fn level(self) -> u32 {
        u32::from(self)
    }
    #[inline(always)]
    fn of(level: u32) -> Self {
        level as u8
    }
    #[inline(always)]
    fn differing(left: &[Self; LANES], right: &[Self; LANES], threshold: Self) -> u32 {
        let (left, right) = (u8x16::new(*left), u8x16::new(*right));
        let distance = left.saturating_sub(right) | right.saturating_sub(left);
        distance.simd_gt(u8x16::splat(threshold)).to_bitmask()
    }
    #[inline(always)]
    fn differences(left: &[Self; LANES], right: &[Self; LANES]) -> ([Self; LANES], u32) {
        let (left, right) = (u8x16::new(*left), u8x16::new(*right));
        let above = right.saturating_sub(left);
        ((left.saturating_sub(right) | above).to_array(), above.simd_gt(u8x16::ZERO).to_bitmask())
    }
    #[inline(always)]
    fn mean_of_eight(upper: [Self; 4], lower: [Self; 4]) -> Self {
        // two sums of 16 bits at once, every second sample in each
        let pairs = |four: [u8; 4]| {
            let word = u32::from_le_bytes(four);
            (word & 0x00ff_00ff) + ((word >> 8) & 0x00ff_00ff)
        };
        let sums = pairs(upper) + pairs(lower);
        (((sums & 0xffff) + (sums >> 16) + 4) >> 3) as u8
    }
}

impl Sample for u16 {
    const MAX: u32 = 65535;
    #[inline(always)]
    fn level(self) -> u32 {
        u32::from(self)
    }
    #[inline(always)]
    fn of(level: u32) -> Self {
        level as u16
    }
    #[inline(always)]
    fn differing(left: &[Self; LANES], right: &[Self; LANES], threshold: Self) -> u32 {
        let half = |samples: &[u16; LANES], from: usize| u16x8::new(std::array::from_fn(|k| samples[from + k]));
        let bits = |from: usize| {
            let (left, right) = (half(left, from), half(right, from));
            let distance = left.saturating_sub(right) | right.saturating_sub(left);
            distance.simd_gt(u16x8::splat(threshold)).to_bitmask()
        };
        bits(0) | bits(8) << 8
    }
    #[inline(always)]
    fn differences(left: &[Self; LANES], right: &[Self; LANES]) -> ([Self; LANES], u32) {
        let rising = (0..LANES).fold(0, |bits, k| bits | u32::from(right[k] > left[k]) << k);
        (std::array::from_fn(|k| left[k].abs_diff(right[k])), rising)
    }
    #[inline(always)]
    fn mean_of_eight(upper: [Self; 4], lower: [Self; 4]) -> Self {
        let sum: u32 = upper.iter().chain(&lower).map(|sample| u32::from(*sample)).sum();
        ((sum + 4) >> 3) as u16
    }
}

/// A borrowed picture of one kind of sample, for the algorithms.
#[derive(Clone, Copy)]
pub(crate) struct SampleView<'a, T> {
    pub width: usize,
    pub height: usize,
    samples: &'a [T],
}

impl<'a, T: Sample> SampleView<'a, T> {
    /// The number of samples agrees with the size: a [`GreyView`] has checked it.
    pub fn new(width: usize, height: usize, samples: &'a [T]) -> Self {
        debug_assert_eq!(width * height, samples.len());
        Self { width, height, samples }
    }

    /// One row.
    #[inline]
    pub fn row(&self, y: usize) -> &'a [T] {
        &self.samples[y * self.width..(y + 1) * self.width]
    }

    /// Whether the point keeps a distance of `margin` pixels from the border.
    #[inline]
    pub fn holds(&self, u: f64, v: f64, margin: f64) -> bool {
        u >= margin && v >= margin && u <= self.width as f64 - margin && v <= self.height as f64 - margin
    }

    /// Level of the pixel at pixel coordinates, clamped to the picture.
    #[inline]
    pub fn nearest(&self, u: f64, v: f64) -> f32 {
        // the conversion makes 0 of what is negative
        let (x, y) = ((u as usize).min(self.width - 1), (v as usize).min(self.height - 1));
        self.row(y)[x].level() as f32
    }

    /// Levels of the pixels at four places, counted from the pixel `from` and clamped to the picture, and which of the places
    /// lie in it.
    #[inline(always)]
    pub fn nearest_four(&self, from: [i32; 2], x: f32x4, y: f32x4) -> (f32x4, f32x4) {
        let (_, levels, inside) = self.pixels_four(from, x, y);
        (levels, inside)
    }

    /// The same with the pixels' columns and rows, counted from `from`.
    #[inline(always)]
    pub fn pixels_four(&self, from: [i32; 2], x: f32x4, y: f32x4) -> ([f32x4; 2], f32x4, f32x4) {
        let cell = |places: f32x4| {
            let whole = places.fast_trunc_int();
            // what is negative was rounded up
            let below: i32x4 = bytemuck::cast(places.simd_lt(whole.round_float()));
            whole + below
        };
        let in_picture = |place: i32x4, from: i32, size: usize| {
            let place = place + i32x4::splat(from);
            let kept = place.max(i32x4::ZERO).min(i32x4::splat(size as i32 - 1));
            (kept, place.simd_eq(kept))
        };
        let cells = [cell(x), cell(y)];
        let (x, in_x) = in_picture(cells[0], from[0], self.width);
        let (y, in_y) = in_picture(cells[1], from[1], self.height);
        let at = (y * i32x4::splat(self.width as i32) + x).to_array();
        let levels = at.map(|at| self.samples.get(at as u32 as usize).map_or(0, |sample| sample.level() as i32));
        (cells.map(i32x4::round_float), i32x4::new(levels).round_float(), bytemuck::cast(in_x & in_y))
    }

    /// Bilinear samples at four places, given in 2^-16 pixels from the centre of the first pixel; 0 if they lie further than
    /// that from the last pixels.
    #[inline(always)]
    pub fn bilinear_four(&self, x: i32x4, y: i32x4) -> f32x4 {
        let (column, row): (i32x4, i32x4) = (x >> 16, y >> 16);
        let at = (row * i32x4::splat(self.width as i32) + column).to_array();
        let pair = |at: usize| match self.samples.get(at..at + 2) {
            Some([left, right]) => left.level() | right.level() << 16,
            _ => 0,
        };
        let upper = u32x4::new(at.map(|at| pair(at as u32 as usize)));
        let lower = u32x4::new(at.map(|at| pair(at as u32 as usize + self.width)));
        let level = |pair: u32x4| bytemuck::cast::<_, i32x4>(pair).round_float();
        let low = u32x4::splat(0xffff);
        let [a, b, c, d] = [level(upper & low), level(upper >> 16), level(lower & low), level(lower >> 16)];
        let share = |place: i32x4| (place & i32x4::splat(0xffff)).round_float() * f32x4::splat(1.0 / 65536.0);
        let (fx, fy) = (share(x), share(y));
        let (top, bottom) = (a + fx * (b - a), c + fx * (d - c));
        top + fy * (bottom - top)
    }

    /// Bilinear samples at equal steps from a place on.
    ///
    /// Places are counted in 2^-16 pixels, so that walking costs additions of whole numbers.
    pub fn profile(&self, start: [f64; 2], step: [f64; 2], out: &mut [f32]) {
        const ONE: f64 = 65536.0;
        let count = out.len() as f64;
        let ends = [start, [start[0] + count * step[0], start[1] + count * step[1]]];
        // further out than 2^15 pixels, and at the border, the samples are taken one by one
        let inside = ends.iter().all(|end| {
            let [x, y] = [end[0] - 0.5, end[1] - 0.5];
            x >= 0.0
                && y >= 0.0
                && x < (self.width as f64 - 2.0).min(32000.0)
                && y < (self.height as f64 - 2.0).min(32000.0)
        });
        if !inside {
            for (i, value) in out.iter_mut().enumerate() {
                let t = i as f64;
                *value = self.sample((start[0] + t * step[0]) as f32, (start[1] + t * step[1]) as f32);
            }
            return;
        }
        let [mut x, mut y] = [(start[0] - 0.5) * ONE, (start[1] - 0.5) * ONE].map(|place| place as i32);
        let [dx, dy] = step.map(|step| (step * ONE) as i32);
        for value in out {
            let at = (y >> 16) as usize * self.width + (x >> 16) as usize;
            let [fx, fy] = [x, y].map(|place| (place & 0xffff) as f32 * (1.0 / 65536.0));
            if let (Some([a, b]), Some([c, d])) =
                (self.samples.get(at..at + 2), self.samples.get(at + self.width..at + self.width + 2))
            {
                let [a, b, c, d] = [a, b, c, d].map(|sample| sample.level() as f32);
                let (top, bottom) = (a + fx * (b - a), c + fx * (d - c));
                *value = top + fy * (bottom - top);
            }
            (x, y) = (x + dx, y + dy);
        }
    }

    /// Bilinear sample at pixel coordinates (first pixel's centre 0.5, 0.5), clamped to the picture.
    #[inline]
    pub fn sample(&self, u: f32, v: f32) -> f32 {
        let x = (u - 0.5).clamp(0.0, (self.width - 1) as f32);
        let y = (v - 0.5).clamp(0.0, (self.height - 1) as f32);
        let (x0, y0) = (x as usize, y as usize);
        let (x1, y1) = ((x0 + 1).min(self.width - 1), (y0 + 1).min(self.height - 1));
        let (fx, fy) = (x - x0 as f32, y - y0 as f32);
        let (upper, lower) = (self.row(y0), self.row(y1));
        let top = upper[x0].level() as f32 * (1.0 - fx) + upper[x1].level() as f32 * fx;
        let bottom = lower[x0].level() as f32 * (1.0 - fx) + lower[x1].level() as f32 * fx;
        top * (1.0 - fy) + bottom * fy
    }
}

impl Grey {
    /// Borrows the picture.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the number of samples does not fit the size.
    pub fn view(&self) -> Result<GreyView<'_>> {
        let samples = match &self.samples {
            Samples::U8(s) => SamplesView::U8(s),
            Samples::U16(s) => SamplesView::U16(s),
        };
        GreyView::new(self.width, self.height, samples)
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn a_pixel_centre_samples_its_own_level_and_the_border_is_continued() {
        let plane = SampleView::new(3, 2, &[10u8, 20, 40, 50, 60, 80]);
        assert_eq!(plane.sample(1.5, 0.5), 20.0);
        assert_eq!(plane.sample(2.0, 1.0), (20.0 + 40.0 + 60.0 + 80.0) / 4.0);
        assert_eq!(plane.sample(-5.0, -5.0), 10.0);
        assert_eq!(plane.sample(9.0, 9.0), 80.0);
    }

    #[test]
    fn a_view_wants_exactly_its_samples() {
        assert!(GreyView::new(2, 2, SamplesView::U8(&[0; 3])).is_err());
        assert!(GreyView::new(0, 2, SamplesView::U8(&[])).is_err());
        assert!(GreyView::new(usize::MAX, 2, SamplesView::U8(&[0; 4])).is_err());
        assert!(GreyView::new(2, 2, SamplesView::U16(&[0; 4])).is_ok());
    }
}
