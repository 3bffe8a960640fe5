//! The pixels of a fit along the rim; those inside and outside of them are [`flats`](super::flats).
//!
//! Band pixels are gathered into one array a column, so that products of columns run over contiguous memory in four
//! independent sums: the compiler makes vector code of them, and the order of the additions is the same on every machine.

use nalgebra::{SMatrix, SVector};
use wide::{f32x4, f32x8};

use super::flats::Flats;
use super::lit::Lit;
use super::scatter::{Lights, Rim};
use crate::detect::edges::surround::Surround;
use crate::detect::ellipse::outline::Outline;
use crate::detect::median;
use crate::detect::rendered::{DERIVATIVES, Field, Span};
use crate::image::{Sample, SampleView};

/// Unknowns of the fit: u, v, p, q, r, s, C, B, and the slope of the light, gx and gy.
pub(crate) const UNKNOWNS: usize = 10;
pub(crate) type NormalMatrix = SMatrix<f64, UNKNOWNS, UNKNOWNS>;
pub(crate) type Unknowns = SVector<f64, UNKNOWNS>;

/// Columns that are multiplied with as many others at a time: nine sums stay in the processor's registers.
const BLOCK: usize = 3;

/// Region of the pixels that are fitted.
pub(crate) struct PixelRegion<'a> {
    pub outline: Outline,
    /// Half the width of the band, in pixels.
    pub half_band: f64,
    pub surround: &'a Surround,
    /// Slope of the light as a share of it a pixel, where it is known: flat parts are chosen around it. Without it they still hold what a
    /// tenth across the target does.
    pub light: [f64; 2],
    /// Whether it multiplies the levels ([`lit`](super::lit)).
    pub multiplies: bool,
    /// One for each ray of the outline: false where something lies on the rim.
    pub kept: &'a [bool],
    /// Whether all of them are true.
    pub whole: bool,
    /// Grey level from which a sample counts as saturated.
    pub saturation: f64,
    /// Whether the edges are aliased.
    pub stairs: bool,
    /// Distance of two grey levels.
    pub quantum: f64,
    /// Whether what is left all around is what a camera does to edges.
    pub developed: bool,
    /// How far the rim departs from an ellipse, rms in pixels.
    pub shape: f64,
    /// Prior values of blur and contrast, if any.
    pub prior: Option<Prior>,
}

/// Blur and contrast as observations: value and standard deviation each, and the noise of the pixels they are weighted against.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Prior {
    pub blur: [f64; 2],
    pub contrast: [f64; 2],
    pub noise: f64,
    /// Rms of the residuals above which the fit is given up, of those that its corrections promise: a constant, and a part of the contrast that
    /// they promise.
    pub largest_rms: [f64; 2],
}

impl Prior {
    /// Weights of both, in units of a pixel's.
    fn weights(&self) -> [f64; 2] {
        [self.blur[1], self.contrast[1]].map(|sigma| (self.noise / sigma).powi(2))
    }

    /// Whether a fit is given up that promises this rms and this contrast.
    pub fn is_hopeless(&self, rms: f64, contrast: f64) -> bool {
        let [constant, part] = self.largest_rms;
        let shown = (contrast * self.contrast[0].signum()).clamp(0.0, self.contrast[0].abs());
        rms > constant + part * shown
    }

    pub fn add_normal(&self, normal: &mut NormalMatrix) {
        let [blur, contrast] = self.weights();
        normal[(5, 5)] += blur;
        normal[(6, 6)] += contrast;
    }

    /// Adds what blur and contrast are off.
    pub fn add_right(&self, blur: f64, contrast: f64, right: &mut Unknowns) {
        let weights = self.weights();
        right[5] += weights[0] * (self.blur[0] - blur);
        right[6] += weights[1] * (self.contrast[0] - contrast);
    }
}

/// Pixels of the band, one array a column; what does not count is zero in all of them.
#[derive(Default)]
pub(crate) struct Band {
    pub spans: Vec<Span>,
    grey: Vec<f32>,
    pub(super) x: Vec<f32>,
    pub(super) y: Vec<f32>,
    pub(super) kept: Vec<f32>,
    pub(super) share: Vec<f32>,
    /// After u, v and s as rendered, then after p, q and r.
    pub(super) derivatives: [Vec<f32>; 2 * DERIVATIVES],
    pub(super) residual: Vec<f32>,
    /// After the slopes of the light.
    lit: [Vec<f32>; 2],
    sizes: Vec<u32>,
}

impl Band {
    /// Chooses the pixels around the region's outline. `None` if they are too few for ten unknowns.
    pub fn collect<T: Sample>(&mut self, plane: &SampleView<T>, field: &Field, region: &PixelRegion) -> Option<Flats> {
        self.spans.clear();
        let outline = &region.outline;
        let reach = region.half_band.min(region.surround.outer.max(1.0)) + 0.3;
        let rings = [
            outline.grown(-region.half_band - 0.3),
            outline.grown(reach),
            outline.grown(reach.max(region.surround.outer)),
        ];
        let hollow = outline.semi_axes().1 > region.half_band + 0.3;
        let mut flats = Flats::default();
        let (half_u, half_v) = rings[2].half_box();
        let rows = clipped(outline.v - half_v, outline.v + half_v + 1.0, plane.height);
        if outline.u + half_u < 0.0 || rows.is_empty() {
            return None;
        }
        for line in rows {
            let height = line as f64 + 0.5;
            let columns = |ring: &Outline| {
                ring.chord(height).map_or(0..0, |(from, to)| clipped(from + 0.5, to + 0.5, plane.width))
            };
            let (mut inner, outer, far) = (columns(&rings[0]), columns(&rings[1]), columns(&rings[2]));
            if !hollow || inner.start < outer.start || inner.end > outer.end {
                inner = outer.start..outer.start;
            }
            let row = plane.row(line);
            if outer.is_empty() {
                flats.outside.add(row, far, line, region, false);
                continue;
            }
            flats.outside.add(row, far.start..outer.start.max(far.start), line, region, false);
            flats.outside.add(row, outer.end.min(far.end)..far.end, line, region, false);
            flats.inside.add(row, inner.clone(), line, region, true);
            let field_row = line as i64 - field.top;
            for span in [outer.start..inner.start, inner.end.max(outer.start)..outer.end] {
                let column = span.start as i64 - field.left;
                let end = column + span.len() as i64;
                if span.is_empty()
                    || !(0..field.height as i64).contains(&field_row)
                    || column < 0
                    || end > field.width as i64
                {
                    continue;
                }
                self.spans.push((field_row as usize, column as usize, span.len()));
            }
        }
        let count = self.fill(plane, field, region);
        let padded = count.next_multiple_of(8);
        // the pixels themselves are written by the first rendering
        for column in self.derivatives.iter_mut().chain(&mut self.lit).chain([&mut self.share, &mut self.residual]) {
            column.resize(padded, 0.0);
            column[count..].fill(0.0);
        }
        let used = self.kept.iter().sum::<f32>();
        (used >= 3.0 * UNKNOWNS as f32).then_some(flats)
    }

    /// Levels and places of the pixels of all spans, in columns padded to eights; how many pixels there are.
    fn fill<T: Sample>(&mut self, plane: &SampleView<T>, field: &Field, region: &PixelRegion) -> usize {
        let count: usize = self.spans.iter().map(|span| span.2).sum();
        let Self { spans, grey, x, y, kept, .. } = self;
        for column in [&mut *grey, x, y, kept] {
            column.resize(count.next_multiple_of(8), 0.0);
            column[count..].fill(0.0);
        }
        let (outline, saturation) = (&region.outline, region.saturation as f32);
        let mut start = 0;
        for &(row, column, length) in spans.iter() {
            let (line, left) = ((row as i64 + field.top) as usize, (column as i64 + field.left) as usize);
            let first = (left as f64 + 0.5 - outline.u) as f32;
            let dy = (line as f64 + 0.5 - outline.v) as f32;
            let part = start..start + length;
            let levels = grey[part.clone()].iter_mut().zip(&mut kept[part.clone()]);
            let places = x[part.clone()].iter_mut().zip(&mut y[part]);
            let samples = &plane.row(line)[left..left + length];
            for (k, (((grey, kept), (x, y)), sample)) in levels.zip(places).zip(samples).enumerate() {
                let level = sample.level() as f32;
                let counts = level < saturation && (region.whole || region.counts(left + k, line));
                let mask = if counts { 1.0 } else { 0.0 };
                (*grey, *x, *y, *kept) = (mask * level, mask * (first + k as f32), mask * dy, mask);
            }
            start += length;
        }
        count
    }

    /// Takes the rendered values from the field, and the derivatives if there is an outline for which they are wanted;
    /// `origin` is the place that x and y are counted from.
    pub fn gather(&mut self, field: &Field, origin: [f64; 2], derivatives: Option<&Outline>) {
        let Self { spans, kept, share, derivatives: columns, .. } = self;
        // multiplied as it is copied: a span is too short for a call that copies memory
        let copy = |from: &[f32], to: &mut [f32], start: usize| {
            let to = &mut to[start..start + from.len()];
            for ((to, from), kept) in to.iter_mut().zip(from).zip(&kept[start..]) {
                *to = from * kept;
            }
        };
        let mut start = 0;
        for &(row, column, count) in spans.iter() {
            copy(&field.share(row)[column..column + count], share, start);
            if derivatives.is_some() {
                for (which, to) in columns.iter_mut().take(DERIVATIVES).enumerate() {
                    copy(&field.derivative(which, row)[column..column + count], to, start);
                }
            }
            start += count;
        }
        if let Some(outline) = derivatives {
            self.reshape(outline, origin);
        }
    }

    /// The derivatives after p, q and r from those after u and v. A change of p moves the rim at parameter t by cos t along u,
    /// one of q by sin t along v, one of r by both; t is that of the rim next to the pixel. Along the few pixels that the blur
    /// reaches t hardly changes: their columns come out up to (s / radius)² / 2 too large, all alike, which changes no limit.
    #[inline(never)]
    fn reshape(&mut self, outline: &Outline, origin: [f64; 2]) {
        let det = outline.p * outline.q - outline.r * outline.r;
        let [p, q, r] = [outline.p / det, outline.q / det, outline.r / det].map(|x| f32x8::splat(x as f32));
        let [u, v] = [outline.u - origin[0], outline.v - origin[1]].map(|x| f32x8::splat(x as f32));
        let [du, dv, _, dp, dq, dr] = &mut self.derivatives;
        let places = self.x.as_chunks::<8>().0.iter().zip(self.y.as_chunks::<8>().0);
        let moved = du.as_chunks::<8>().0.iter().zip(dv.as_chunks::<8>().0);
        let shaped = dp.as_chunks_mut::<8>().0.iter_mut().zip(dq.as_chunks_mut::<8>().0).zip(dr.as_chunks_mut::<8>().0);
        for (((x, y), (du, dv)), ((dp, dq), dr)) in places.zip(moved).zip(shaped) {
            let (x, y) = (f32x8::new(*x) - u, f32x8::new(*y) - v);
            let (du, dv) = (f32x8::new(*du), f32x8::new(*dv));
            let (c, s) = (q * x - r * y, p * y - r * x);
            // what does not count lies at the origin, perhaps in the very middle
            let scale = f32x8::ONE / (c * c + s * s + f32x8::splat(1e-12)).sqrt();
            let (c, s) = (c * scale, s * scale);
            *dp = (c * du).to_array();
            *dq = (s * dv).to_array();
            *dr = (s * du + c * dv).to_array();
        }
    }

    /// Residuals, grey less model, and the derivatives after the slopes of the light.
    pub fn subtract(&mut self, lit: &Lit) {
        let [level, contrast, gx, gy] = [lit.ground, lit.contrast, lit.slope[0], lit.slope[1]].map(|b| b as f32);
        let [ground, disc] = [lit.steepness(0.0), lit.steepness(1.0) - lit.steepness(0.0)].map(|s| s as f32);
        let [lit_x, lit_y] = &mut self.lit;
        let columns = self.grey.iter().zip(&self.kept).zip(&self.x).zip(&self.y).zip(&self.share);
        let results = self.residual.iter_mut().zip(lit_x).zip(lit_y);
        for (((residual, lit_x), lit_y), ((((grey, kept), x), y), share)) in results.zip(columns) {
            let steep = ground * kept + disc * share;
            (*lit_x, *lit_y) = (steep * x, steep * y);
            *residual = grey - (level * kept + contrast * share + gx * *lit_x + gy * *lit_y);
        }
    }

    /// Takes out pixels whose residual exceeds `limit`; the number taken. What disturbs them is blurred too: pixels within
    /// `reach` of them that depart in the same direction, by a third of that, go with them.
    pub fn drop_outliers(&mut self, limit: f64, reach: f64) -> usize {
        let limit = limit as f32;
        let far: Vec<[f32; 3]> = (0..self.residual.len())
            .filter(|&i| self.residual[i].abs() > limit)
            .map(|i| [self.x[i], self.y[i], self.residual[i].signum()])
            .collect();
        if far.is_empty() {
            return 0;
        }
        let square = (reach * reach) as f32;
        let mut dropped = 0;
        for i in 0..self.residual.len() {
            let [x, y, residual] = [self.x[i], self.y[i], self.residual[i]];
            let close = |&[fx, fy, sign]: &[f32; 3]| {
                residual * sign > limit / 3.0 && (fx - x).powi(2) + (fy - y).powi(2) < square
            };
            if residual.abs() > limit || residual.abs() > limit / 3.0 && far.iter().any(close) {
                dropped += 1;
                for column in
                    [&mut self.grey, &mut self.x, &mut self.y, &mut self.kept, &mut self.share, &mut self.residual]
                {
                    column[i] = 0.0;
                }
                for column in self.derivatives.iter_mut().chain(&mut self.lit) {
                    column[i] = 0.0;
                }
            }
        }
        dropped
    }

    /// Median of the absolute residuals of the pixels that count, as a standard deviation; 0 if it does not exceed `least`,
    /// which a count shows sooner.
    pub fn robust_deviation(&mut self, least: f64) -> f64 {
        const PER_SIZE: f64 = 1.4826;
        let Self { residual, kept, sizes, .. } = self;
        let small = (least / PER_SIZE) as f32;
        let (mut counted, mut within) = (0u32, 0u32);
        for (residual, kept) in residual.iter().zip(&*kept) {
            let counts = u32::from(*kept > 0.0);
            counted += counts;
            within += counts & u32::from(residual.abs() <= small);
        }
        if within > counted / 2 {
            return 0.0;
        }
        let counted = residual.iter().zip(&*kept).filter(|(_, kept)| **kept > 0.0);
        PER_SIZE * median::of_sizes(counted.map(|(residual, _)| residual.abs()), sizes)
    }

    /// Rms of what is left of the residuals when their mean profile across the rim is taken off: what a lens does to an
    /// edge it does all around, a wrong shape shows in places.
    pub fn unevenness(&self) -> f64 {
        let mut sums = [(0f64, 0f64, 0f64); 16];
        for ((r, share), _) in self.residual.iter().zip(&self.share).zip(&self.kept).filter(|(_, kept)| **kept > 0.0) {
            let bin = &mut sums[((share * 16.0) as usize).min(15)];
            *bin = (bin.0 + 1.0, bin.1 + f64::from(*r), bin.2 + f64::from(r * r));
        }
        let used: f64 = sums.iter().map(|s| s.0).sum();
        let left: f64 = sums.iter().filter(|s| s.0 > 0.0).map(|s| s.2 - s.1 * s.1 / s.0).sum();
        (left / (used - 24.0).max(1.0)).max(0.0).sqrt()
    }

    /// J'l of the band for a light l, as a share of the contrast, at places counted from the pixels' origin. The residuals are lost.
    pub fn right_of_light(&mut self, contrast: f64, light: impl Fn(f64, f64) -> f64) -> Unknowns {
        let places = self.x.iter().zip(&self.y).zip(&self.kept);
        for (residual, ((x, y), kept)) in self.residual.iter_mut().zip(places) {
            *residual = kept * (contrast * light(f64::from(*x), f64::from(*y))) as f32;
        }
        self.right(contrast)
    }

    /// Variance of the residuals of the pixels that count, and how many pixels they are.
    pub fn variance(&self) -> (f64, usize) {
        let used = self.kept.iter().filter(|kept| **kept > 0.0).count();
        let [[square]] = products([&self.residual], [&self.residual]);
        (square / used.saturating_sub(UNKNOWNS - 2).max(1) as f64, used)
    }

    /// Rms of the residuals that a correction leaves, were the model linear: e'e - x'r of e'e.
    pub fn promised_rms(&self, correction: &Unknowns, right: &Unknowns) -> f64 {
        let (variance, used) = self.variance();
        let freedom = used.saturating_sub(UNKNOWNS - 2).max(1) as f64;
        (variance - correction.dot(right) / freedom).max(0.0).sqrt()
    }

    /// How the squares of the residuals go with the share of the disc, and the light's part in the centre.
    #[inline(never)]
    pub fn lights<const RIM: bool>(&self, cofactors: &NormalMatrix, contrast: f64) -> Lights {
        let columns = self.columns().map(|column| column.as_chunks::<8>().0);
        let scale = |i: usize| if i < 2 * DERIVATIVES { contrast } else { 1.0 };
        let factor = |i: usize, j: usize| f32x8::splat((cofactors[(i, j)] * scale(i) * scale(j)) as f32);
        let factors: [[f32x8; UNKNOWNS]; UNKNOWNS] = std::array::from_fn(|i| std::array::from_fn(|j| factor(i, j)));
        let [kept, share, residual] = [&self.kept, &self.share, &self.residual].map(|column| column.as_chunks::<8>().0);
        let (mut sums, mut rims) = ([f32x8::ZERO; 8], [f32x8::ZERO; 7]);
        for k in 0..columns[0].len() {
            let row = columns.map(|column| f32x8::new(column[k]));
            let moved = |i: usize| (0..UNKNOWNS).fold(f32x8::ZERO, |sum, j| sum + factors[i][j] * row[j]);
            let (u, v) = (moved(0), moved(1));
            // half the quadratic form: the lower triangle of what is left without u and v, and half its diagonal
            let mut half = (u - f32x8::splat(0.5) * factors[0][0] * row[0]) * row[0]
                + (v - factors[1][0] * row[0] - f32x8::splat(0.5) * factors[1][1] * row[1]) * row[1];
            for i in 2..UNKNOWNS {
                let below = (2..i).fold(f32x8::ZERO, |sum, j| sum + factors[i][j] * row[j]);
                half += (below + f32x8::splat(0.5) * factors[i][i] * row[i]) * row[i];
            }
            let [kept, share, residual] = [kept[k], share[k], residual[k]].map(f32x8::new);
            let free = (kept - (half + half)).fast_max(f32x8::ZERO);
            let (square, lit) = (residual * residual, share * free);
            let terms = [free, lit, lit * share, square, square * share, u * u * share, u * v * share, v * v * share];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum += term;
            }
            if RIM {
                let rim = f32x8::splat(4.0) * share * (f32x8::splat(1.0) - share);
                let of_rim = rim * free;
                let terms = [of_rim, of_rim * share, of_rim * rim, rim * square, rim * u * u, rim * u * v, rim * v * v];
                for (sum, term) in rims.iter_mut().zip(terms) {
                    *sum += term;
                }
            }
        }
        let total = |sum: f32x8| sum.to_array().into_iter().map(f64::from).sum::<f64>();
        let rim = RIM.then(|| {
            let [one, lit, square, squares, uu, uv, vv] = rims.map(total);
            Rim { powers: [one, lit, square], squares, moved: [uu, uv, vv].map(|sum| sum / (contrast * contrast)) }
        });
        let [n, lit, second, all, bright, uu, uv, vv] = sums.map(total);
        let centre = [uu, uv, vv].map(|sum| sum / (contrast * contrast));
        Lights { powers: [n, lit, second], squares: [all, bright], lit: centre, rim }
    }

    pub(super) fn columns(&self) -> [&[f32]; UNKNOWNS] {
        let [u, v, s, p, q, r] = &self.derivatives;
        [u, v, p, q, r, s, &self.share, &self.kept, &self.lit[0], &self.lit[1]]
    }

    /// J'J of the band. Derivatives of the outline are scaled by the contrast.
    pub fn normal(&self, contrast: f64) -> NormalMatrix {
        let columns = self.columns();
        let scale = |i: usize| if i < 2 * DERIVATIVES { contrast } else { 1.0 };
        let mut normal = NormalMatrix::zeros();
        let mut enter = |i: usize, j: usize, sum: f64| {
            let sum = sum * scale(i) * scale(j);
            (normal[(i, j)], normal[(j, i)]) = (sum, sum);
        };
        // blocks of columns share their loads; the last column stands alone
        let block = |i: usize| [columns[BLOCK * i], columns[BLOCK * i + 1], columns[BLOCK * i + 2]];
        for i in 0..UNKNOWNS / BLOCK {
            for j in 0..=i {
                let sums = products(block(i), block(j));
                for (row, sums) in sums.into_iter().enumerate() {
                    for (column, sum) in sums.into_iter().enumerate() {
                        enter(BLOCK * i + row, BLOCK * j + column, sum);
                    }
                }
            }
            let [sums] = products([columns[UNKNOWNS - 1]], block(i));
            for (column, sum) in sums.into_iter().enumerate() {
                enter(UNKNOWNS - 1, BLOCK * i + column, sum);
            }
        }
        let [[sum]] = products([columns[UNKNOWNS - 1]], [columns[UNKNOWNS - 1]]);
        enter(UNKNOWNS - 1, UNKNOWNS - 1, sum);
        normal
    }

    /// J'r of the band.
    pub fn right(&self, contrast: f64) -> Unknowns {
        let [u, v, p, q, r, s, share, kept, x, y] = self.columns();
        let [outline] = products([&self.residual], [u, v, p, q, r, s]);
        let [levels] = products([&self.residual], [share, kept, x, y]);
        Unknowns::from_iterator(outline.map(|sum| sum * contrast).into_iter().chain(levels))
    }
}

impl PixelRegion<'_> {
    /// Whether the pixel lies where nothing lies on the rim.
    pub fn counts(&self, x: usize, y: usize) -> bool {
        let [c, s] = self.outline.normalised(x as f64 + 0.5, y as f64 + 0.5);
        let turn = s.atan2(c) / std::f64::consts::TAU * self.kept.len() as f64;
        // a ray's neighbours share its edge: both must count
        let count = self.kept.len() as i64;
        let at = |k: i64| self.kept[k.rem_euclid(count) as usize];
        at(turn.floor() as i64) && at(turn.floor() as i64 + 1)
    }
}

/// Whole numbers from `from` to `to`, inside 0..size: the pixels whose centres lie between.
fn clipped(from: f64, to: f64, size: usize) -> std::ops::Range<usize> {
    // the conversion makes 0 of what is negative
    let low = from as usize;
    let high = (to as usize).min(size);
    low.min(high)..high
}

/// Inner products of columns with others, each in four sums of single precision, emptied into double precision every
/// 128 steps.
#[inline(never)]
fn products<const A: usize, const B: usize>(a: [&[f32]; A], b: [&[f32]; B]) -> [[f64; B]; A] {
    let steps = a.first().map_or(0, |column| column.len() / 4);
    let a = a.map(|column| &column.as_chunks::<4>().0[..steps]);
    let b = b.map(|column| &column.as_chunks::<4>().0[..steps]);
    let mut totals = [[0.0; B]; A];
    for from in (0..steps).step_by(128) {
        let mut sums = [[f32x4::ZERO; B]; A];
        for i in from..steps.min(from + 128) {
            let right = b.map(|column| f32x4::new(column[i]));
            for (sums, column) in sums.iter_mut().zip(a) {
                let left = f32x4::new(column[i]);
                for (sum, right) in sums.iter_mut().zip(right) {
                    *sum += left * right;
                }
            }
        }
        for (totals, sums) in totals.iter_mut().zip(&sums) {
            for (total, sum) in totals.iter_mut().zip(sums) {
                *total += sum.to_array().into_iter().map(f64::from).sum::<f64>();
            }
        }
    }
    totals
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn what_promises_residuals_too_large_for_its_contrast_is_hopeless() {
        for sign in [1.0, -1.0] {
            let contrast = [sign * 50.0, 5.0];
            let prior = Prior { blur: [1.0, 0.1], contrast, noise: 1.0, largest_rms: [4.0, 0.1] };
            for (rms, contrast, hopeless) in [
                (8.9, 50.0, false),
                (9.1, 50.0, true),
                // more contrast than that of the others excuses no more
                (9.1, 90.0, true),
                (5.9, 20.0, false),
                (6.1, 20.0, true),
                (4.1, -50.0, true),
                (3.9, -50.0, false),
            ] {
                assert_eq!(prior.is_hopeless(rms, sign * contrast), hopeless, "{rms} {contrast} {sign}");
            }
        }
    }
}
