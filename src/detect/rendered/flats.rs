//! The flat parts of a fit, inside and outside the rim's band.
//!
//! Their model, B or B + C in light that changes ([`lit`](super::lit)), is linear in each: only moments of their pixels are kept, summed row
//! by row in whole numbers.

use super::band::{NormalMatrix, PixelRegion, Unknowns};
use super::lit::Lit;
use crate::detect::acceptance::fit::FLAT;
use crate::image::Sample;

/// Moments of flat parts.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Flats {
    pub inside: LevelMoments,
    pub outside: LevelMoments,
}

/// Sums over pixels at (x, y) from the origin, of level g.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LevelMoments {
    n: f64,
    x: f64,
    y: f64,
    xx: f64,
    xy: f64,
    yy: f64,
    g: f64,
    gx: f64,
    gy: f64,
}

impl Flats {
    /// Adds J'J of the flat parts.
    pub fn add_normal(&self, lit: &Lit, normal: &mut NormalMatrix) {
        for (m, share) in [(&self.inside, 1.0), (&self.outside, 0.0)] {
            let steep = lit.steepness(share);
            let first = [m.n, steep * m.x, steep * m.y];
            let [xx, xy, yy] = [m.xx, m.xy, m.yy].map(|sum| steep * steep * sum);
            let second = [first, [first[1], xx, xy], [first[2], xy, yy]];
            normal[(6, 6)] += share * m.n;
            for i in 0..3 {
                normal[(6, 7 + i)] += share * first[i];
                normal[(7 + i, 6)] += share * first[i];
                for j in 0..3 {
                    normal[(7 + i, 7 + j)] += second[i][j];
                }
            }
        }
    }

    /// Adds J'r of the flat parts.
    pub fn add_right(&self, lit: &Lit, right: &mut Unknowns) {
        for (m, share) in [(&self.inside, 1.0), (&self.outside, 0.0)] {
            let (level, steep) = (lit.tone(share), lit.steepness(share));
            let [gx, gy] = lit.slope.map(|slope| steep * slope);
            let sum = m.g - level * m.n - gx * m.x - gy * m.y;
            right[6] += share * sum;
            right[7] += sum;
            right[8] += steep * (m.gx - level * m.x - gx * m.xx - gy * m.xy);
            right[9] += steep * (m.gy - level * m.y - gx * m.xy - gy * m.yy);
        }
    }
}

impl LevelMoments {
    /// Number, sums of x, x², r and x r of the pixels that count, with x from the middle column and r the level less a whole
    /// number near the one that is expected there: for what is no outlier these sums are small.
    #[inline(always)]
    fn sums<T: Sample>(
        samples: &[T],
        first: usize,
        y: usize,
        region: &PixelRegion,
        inside: bool,
        counts: impl Fn(usize) -> bool,
    ) -> [i32; 5] {
        let surround = region.surround;
        let (middle, level) = origin(y, region, inside);
        let near = nearest(level);
        let (whole, rest) = (near as i32, (level - near) as f32);
        let [sigmas, quiet, print] = FLAT;
        let limit = sigmas * surround.noise.max(quiet) + if inside { print * surround.contrast.abs() } else { 0.0 };
        let (limit, slope) = (limit as f32, expected_slope(region, inside)[0] as f32);
        let saturation = region.saturation as i32;
        let first = (first as i64 - middle) as i32;
        let mut sums = [0i32; 5];
        for (k, sample) in samples.iter().enumerate() {
            let x = first + k as i32;
            let grey = sample.level() as i32;
            let r = grey - whole;
            let near = (r as f32 - rest - slope * x as f32).abs() <= limit && grey < saturation;
            let one = i32::from(near && counts(k));
            for (sum, term) in sums.iter_mut().zip([one, one * x, one * x * x, one * r, one * r * x]) {
                *sum = sum.wrapping_add(term);
            }
        }
        sums
    }

    /// Σ z z' (uu, uv, vv) over the pixels, z = c + cx x + cy y with two rows of coefficients.
    pub fn products(&self, rows: &[[f64; 3]; 2]) -> [f64; 3] {
        let second = [[self.n, self.x, self.y], [self.x, self.xx, self.xy], [self.y, self.xy, self.yy]];
        let product = |a: &[f64; 3], b: &[f64; 3]| -> f64 {
            (0..3).map(|i| (0..3).map(|j| a[i] * second[i][j] * b[j]).sum::<f64>()).sum()
        };
        [product(&rows[0], &rows[0]), product(&rows[0], &rows[1]), product(&rows[1], &rows[1])]
    }

    /// Adds the pixels of a span of a row at which nothing lies on the rim and that are no outliers: not further than four sigmas from the plane.
    pub fn add<T: Sample>(
        &mut self,
        row: &[T],
        span: std::ops::Range<usize>,
        y: usize,
        region: &PixelRegion,
        inside: bool,
    ) {
        if span.is_empty() {
            return;
        }
        let first = span.start;
        // the plain case apart, which the compiler makes vector code of
        let sums = if region.whole {
            Self::sums(&row[span], first, y, region, inside, |_| true)
        } else {
            Self::sums(&row[span], first, y, region, inside, |k| region.counts(first + k, y))
        };
        let [n, sx, sxx, sr, srx] = sums.map(f64::from);
        let (middle, level) = origin(y, region, inside);
        let (sg, sgx) = (sr + nearest(level) * n, srx + nearest(level) * sx);
        let dy = y as f64 + 0.5 - region.outline.v;
        // from whole columns to the distance from the outline's centre
        let shift = middle as f64 + 0.5 - region.outline.u;
        let x = sx + shift * n;
        self.n += n;
        self.x += x;
        self.y += n * dy;
        self.xx += sxx + 2.0 * shift * sx + shift * shift * n;
        self.xy += x * dy;
        self.yy += n * dy * dy;
        self.g += sg;
        self.gx += sgx + shift * sg;
        self.gy += sg * dy;
    }
}

/// A whole number near a level; rounding to even, as the machine does in one instruction.
fn nearest(level: f64) -> f64 {
    level.round_ties_even()
}

/// Middle column of a row, and the level expected there.
fn origin(y: usize, region: &PixelRegion, inside: bool) -> (i64, f64) {
    let surround = region.surround;
    let dy = y as f64 + 0.5 - region.outline.v;
    let level = surround.level + expected_slope(region, inside)[1] * dy + if inside { surround.contrast } else { 0.0 };
    (region.outline.u.floor() as i64, level)
}

/// Slope of the levels expected there: as measured outside, that of the light inside.
fn expected_slope(region: &PixelRegion, inside: bool) -> [f64; 2] {
    let surround = region.surround;
    if inside && region.multiplies {
        region.light.map(|light| light * (surround.level + surround.contrast))
    } else {
        surround.slope
    }
}
