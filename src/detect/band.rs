//! The pixels of a fit along the rim; those inside and outside of them are [`flats`](super::flats).
//!
//! Band pixels are gathered into one array a column, so that products of columns run over contiguous memory in eight
//! independent sums: the compiler makes vector code of them, and the order of the additions is the same on every machine.

use nalgebra::{SMatrix, SVector};
use wide::{f32x4, f32x8};

use super::flats::Flats;
use super::outline::Outline;
use super::rendered::{DERIVATIVES, Field, Span, normal_distribution};
use super::scatter::Lights;
use super::surround::Surround;
use crate::image::{Plane, Sample};

/// Unknowns of the fit: u, v, p, q, r, s, C, B, gx, gy.
pub(crate) const UNKNOWNS: usize = 10;
pub(crate) type Normal = SMatrix<f64, UNKNOWNS, UNKNOWNS>;
pub(crate) type Unknowns = SVector<f64, UNKNOWNS>;

/// Columns that are multiplied with one other at a time.
const BLOCK: usize = 4;

/// Which pixels are used.
pub(crate) struct Region<'a> {
    pub outline: Outline,
    /// Half the width of the band, in pixels.
    pub half_band: f64,
    pub surround: &'a Surround,
    /// One for each ray of the outline: false where the rim is hidden.
    pub kept: &'a [bool],
    /// Whether all of them are true.
    pub whole: bool,
    /// Grey level from which a sample says nothing.
    pub saturation: f64,
}

/// Pixels of the band, one array a column; what does not count is zero in all of them.
#[derive(Default)]
pub(crate) struct Band {
    pub spans: Vec<Span>,
    grey: Vec<f32>,
    x: Vec<f32>,
    y: Vec<f32>,
    kept: Vec<f32>,
    /// Whether all of them count.
    whole: bool,
    share: Vec<f32>,
    /// After u, v and s as rendered, then after p, q and r.
    derivatives: [Vec<f32>; 2 * DERIVATIVES],
    residual: Vec<f32>,
}

impl Band {
    /// Chooses the pixels around the region's outline. None when they are too few for ten unknowns.
    pub fn collect<T: Sample>(&mut self, plane: &Plane<T>, field: &Field, region: &Region) -> Option<Flats> {
        self.spans.clear();
        for column in [&mut self.grey, &mut self.x, &mut self.y, &mut self.kept] {
            column.clear();
        }
        let outline = &region.outline;
        let reach = region.half_band.min(region.surround.outer.max(1.0)) + 0.3;
        let rings = [
            outline.grown(-region.half_band - 0.3),
            outline.grown(reach),
            outline.grown(reach.max(region.surround.outer)),
        ];
        let hollow = outline.semi_axes().1 > region.half_band + 0.3;
        let saturation = region.saturation as f32;
        let mut flats = Flats::default();
        let (half_u, half_v) = rings[2].half_box();
        let rows = clipped(outline.v - half_v, outline.v + half_v + 1.0, plane.height);
        if outline.u + half_u < 0.0 || rows.is_empty() {
            return None;
        }
        for y in rows {
            let height = y as f64 + 0.5;
            let columns = |ring: &Outline| {
                ring.chord(height).map_or(0..0, |(from, to)| clipped(from + 0.5, to + 0.5, plane.width))
            };
            let (mut inner, outer, far) = (columns(&rings[0]), columns(&rings[1]), columns(&rings[2]));
            if !hollow || inner.start < outer.start || inner.end > outer.end {
                inner = outer.start..outer.start;
            }
            let row = plane.row(y);
            if outer.is_empty() {
                flats.outside.add(row, far, y, region, false);
                continue;
            }
            flats.outside.add(row, far.start..outer.start.max(far.start), y, region, false);
            flats.outside.add(row, outer.end.min(far.end)..far.end, y, region, false);
            flats.inside.add(row, inner.clone(), y, region, true);
            let field_row = y as i64 - field.top;
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
                let first = (span.start as f64 + 0.5 - outline.u) as f32;
                let dy = (height - outline.v) as f32;
                for (k, sample) in row[span.clone()].iter().enumerate() {
                    let level = sample.level() as f32;
                    let kept = level < saturation && (region.whole || region.counts(span.start + k, y));
                    let mask = if kept { 1.0 } else { 0.0 };
                    self.grey.push(mask * level);
                    self.x.push(mask * (first + k as f32));
                    self.y.push(mask * dy);
                    self.kept.push(mask);
                }
            }
        }
        let count = self.grey.len();
        let padded = count.next_multiple_of(8);
        for column in [&mut self.grey, &mut self.x, &mut self.y, &mut self.kept] {
            column.resize(padded, 0.0);
        }
        // the pixels themselves are written by the first rendering
        for column in self.derivatives.iter_mut().chain([&mut self.share, &mut self.residual]) {
            column.resize(padded, 0.0);
            column[count..].fill(0.0);
        }
        let used = self.kept.iter().sum::<f32>();
        self.whole = used == count as f32;
        (used >= 3.0 * UNKNOWNS as f32).then_some(flats)
    }

    /// Takes the rendered values from the field, and the derivatives if there is an outline for which they are wanted;
    /// `origin` is the place that x and y are counted from.
    pub fn gather(&mut self, field: &Field, origin: [f64; 2], derivatives: Option<&Outline>) {
        let mut start = 0;
        for &(row, column, count) in &self.spans {
            let copy = |from: &[f32], to: &mut [f32]| {
                to[start..start + count].copy_from_slice(&from[column..column + count]);
            };
            copy(field.share(row), &mut self.share);
            if derivatives.is_some() {
                for (which, to) in self.derivatives.iter_mut().take(DERIVATIVES).enumerate() {
                    copy(field.derivative(which, row), to);
                }
            }
            start += count;
        }
        if !self.whole {
            mask(&mut self.share, &self.kept);
            if derivatives.is_some() {
                for column in self.derivatives.iter_mut().take(DERIVATIVES) {
                    mask(column, &self.kept);
                }
            }
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

    /// Nearly the derivatives, without rendering: across the rim an edge of variance s² + 1/12 (the pixel's own), with the
    /// light of a curved rim, sqrt(radius / r). Good to a few percent, enough to show the way.
    #[inline(never)]
    pub fn sketch(&mut self, outline: &Outline, blur: f64, origin: [f64; 2]) {
        let det = outline.p * outline.q - outline.r * outline.r;
        let [p, q, r] = [outline.p, outline.q, outline.r].map(|x| f32x8::splat((x / det) as f32));
        let [u, v] = [outline.u - origin[0], outline.v - origin[1]].map(|x| f32x8::splat(x as f32));
        let variance = blur * blur + 1.0 / 12.0;
        let inverse = f32x8::splat(1.0 / variance.sqrt() as f32);
        let widening = f32x8::splat((blur / variance.sqrt()) as f32);
        let tiny = f32x8::splat(1e-12);
        let [du, dv, ds, dp, dq, dr] = &mut self.derivatives;
        let pixels = self.x.as_chunks::<8>().0.iter().zip(self.y.as_chunks::<8>().0).zip(self.kept.as_chunks::<8>().0);
        let moves = du.as_chunks_mut::<8>().0.iter_mut().zip(dv.as_chunks_mut::<8>().0).zip(ds.as_chunks_mut::<8>().0);
        let shapes = dp.as_chunks_mut::<8>().0.iter_mut().zip(dq.as_chunks_mut::<8>().0).zip(dr.as_chunks_mut::<8>().0);
        for ((((x, y), kept), ((du, dv), ds)), ((dp, dq), dr)) in pixels.zip(moves).zip(shapes) {
            let (x, y) = (f32x8::new(*x) - u, f32x8::new(*y) - v);
            let (c, s) = (q * x - r * y, p * y - r * x);
            let turn = f32x8::ONE / (c * c + s * s + tiny).sqrt();
            let (c, s) = (c * turn, s * turn);
            // the normal, and the distance of the place from the rim along it
            let (nx, ny) = (q * c - r * s, p * s - r * c);
            let length = f32x8::ONE / (nx * nx + ny * ny + tiny).sqrt();
            let (nx, ny) = (nx * length, ny * length);
            let z = (f32x8::ONE / turn - f32x8::ONE) * length * inverse;
            let light = turn.fast_min(f32x8::splat(4.0)).sqrt() * inverse * f32x8::new(*kept);
            let edge = density(z) * light;
            let (across, down) = (edge * nx, edge * ny);
            *du = across.to_array();
            *dv = down.to_array();
            *ds = (edge * z * widening).to_array();
            *dp = (c * across).to_array();
            *dq = (s * down).to_array();
            *dr = (s * across + c * down).to_array();
        }
    }

    /// Residuals, grey less model, for contrast and background (level, slope).
    pub fn subtract(&mut self, contrast: f64, background: [f64; 3]) {
        let (contrast, [level, gx, gy]) = (contrast as f32, background.map(|b| b as f32));
        let columns = self.grey.iter().zip(&self.kept).zip(&self.x).zip(&self.y).zip(&self.share);
        for (residual, ((((grey, kept), x), y), share)) in self.residual.iter_mut().zip(columns) {
            *residual = grey - (level * kept + gx * x + gy * y + contrast * share);
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
                self.whole = false;
                for column in
                    [&mut self.grey, &mut self.x, &mut self.y, &mut self.kept, &mut self.share, &mut self.residual]
                {
                    column[i] = 0.0;
                }
                for column in &mut self.derivatives {
                    column[i] = 0.0;
                }
            }
        }
        dropped
    }

    /// Median of the absolute residuals of the pixels that count, as a standard deviation.
    pub fn robust_deviation(&self) -> f64 {
        let mut sizes: Vec<f32> =
            self.residual.iter().zip(&self.kept).filter(|(_, kept)| **kept > 0.0).map(|(r, _)| r.abs()).collect();
        if sizes.is_empty() {
            return 0.0;
        }
        let half = sizes.len() / 2;
        1.4826 * f64::from(*sizes.select_nth_unstable_by(half, f32::total_cmp).1)
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

    /// Variance of the residuals of the pixels that count, and how many pixels they are.
    pub fn variance(&self) -> (f64, usize) {
        let used = self.kept.iter().filter(|kept| **kept > 0.0).count();
        let [square] = dots(&self.residual, [&self.residual]);
        (square / used.saturating_sub(UNKNOWNS - 2).max(1) as f64, used)
    }

    /// How the squares of the residuals go with the share of the disc, and the light's part in the centre.
    #[inline(never)]
    pub fn lights(&self, cofactors: &Normal, contrast: f64) -> Lights {
        let columns = self.columns().map(|column| column.as_chunks::<8>().0);
        let scale = |i: usize| if i < 2 * DERIVATIVES { contrast } else { 1.0 };
        let factor = |i: usize, j: usize| f32x8::splat((cofactors[(i, j)] * scale(i) * scale(j)) as f32);
        let factors: [[f32x8; UNKNOWNS]; UNKNOWNS] = std::array::from_fn(|i| std::array::from_fn(|j| factor(i, j)));
        let mut lights = Lights::default();
        for k in 0..columns[0].len() {
            let row = columns.map(|column| f32x8::new(column[k]));
            let moved = factors.map(|factors| factors.iter().zip(&row).fold(f32x8::ZERO, |sum, (f, x)| sum + *f * *x));
            let leverage = moved.iter().zip(&row).fold(f32x8::ZERO, |sum, (z, x)| sum + *z * *x);
            let kept = f32x8::new(self.kept.as_chunks::<8>().0[k]);
            let free = (kept - leverage).fast_max(f32x8::ZERO);
            let share = f32x8::new(self.share.as_chunks::<8>().0[k]);
            let residual = f32x8::new(self.residual.as_chunks::<8>().0[k]);
            let square = residual * residual;
            let sum = |x: f32x8| x.to_array().iter().map(|x| f64::from(*x)).sum::<f64>();
            let powers = [free, free * share, free * share * share].map(sum);
            let squares = [square, square * share].map(sum);
            let lit = [moved[0] * moved[0], moved[0] * moved[1], moved[1] * moved[1]].map(|z| sum(z * share));
            lights.powers.iter_mut().zip(powers).for_each(|(total, x)| *total += x);
            lights.squares.iter_mut().zip(squares).for_each(|(total, x)| *total += x);
            lights.lit.iter_mut().zip(lit).for_each(|(total, x)| *total += x / (contrast * contrast));
        }
        lights
    }

    fn columns(&self) -> [&[f32]; UNKNOWNS] {
        let [u, v, s, p, q, r] = &self.derivatives;
        [u, v, p, q, r, s, &self.share, &self.kept, &self.x, &self.y]
    }

    /// J'J of the band. Derivatives of the outline are scaled by the contrast.
    pub fn normal(&self, contrast: f64) -> Normal {
        let columns = self.columns();
        let scale = |i: usize| if i < 2 * DERIVATIVES { contrast } else { 1.0 };
        let mut normal = Normal::zeros();
        // blocks of columns share their loads
        for i in 0..UNKNOWNS {
            for j in (0..=i).step_by(BLOCK) {
                let sums = dots(columns[i], std::array::from_fn::<_, BLOCK, _>(|k| columns[(j + k).min(i)]));
                for (k, sum) in sums.into_iter().enumerate().take(i + 1 - j) {
                    let sum = sum * scale(i) * scale(j + k);
                    normal[(i, j + k)] = sum;
                    normal[(j + k, i)] = sum;
                }
            }
        }
        normal
    }

    /// J'r of the band.
    pub fn right(&self, contrast: f64) -> Unknowns {
        let [u, v, p, q, r, s, share, kept, x, y] = self.columns();
        let outline = dots(&self.residual, [u, v, p, q, r, s]).map(|sum| sum * contrast);
        let levels = dots(&self.residual, [share, kept, x, y]);
        Unknowns::from_iterator(outline.into_iter().chain(levels))
    }
}

impl Region<'_> {
    /// Whether the pixel lies where the rim is not hidden.
    pub fn counts(&self, x: usize, y: usize) -> bool {
        if self.whole {
            return true;
        }
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

/// Density of the normal distribution.
#[inline(always)]
fn density(z: f32x8) -> f32x8 {
    let z = z.fast_max(f32x8::splat(-5.5)).fast_min(f32x8::splat(5.5)).to_array();
    let [mut left, mut right] = [[0.0; 4]; 2];
    left.copy_from_slice(&z[..4]);
    right.copy_from_slice(&z[4..]);
    let [left, right] = [left, right].map(|z| normal_distribution(f32x4::new(z)).1.to_array());
    f32x8::new(std::array::from_fn(|i| if i < 4 { left[i] } else { right[i - 4] }))
}

fn mask(column: &mut [f32], kept: &[f32]) {
    for (value, kept) in column.iter_mut().zip(kept) {
        *value *= kept;
    }
}

/// Inner products of one column with others, each in eight sums of single precision, emptied into double precision every
/// 64 steps. The columns are padded to eights.
fn dots<const K: usize>(a: &[f32], b: [&[f32]; K]) -> [f64; K] {
    let a = a.as_chunks::<8>().0;
    let b = b.map(|column| &column.as_chunks::<8>().0[..a.len()]);
    let mut totals = [0.0; K];
    for from in (0..a.len()).step_by(64) {
        let mut sums = [f32x8::ZERO; K];
        for i in from..a.len().min(from + 64) {
            let a = f32x8::new(a[i]);
            for k in 0..K {
                sums[k] += a * f32x8::new(b[k][i]);
            }
        }
        for (total, sums) in totals.iter_mut().zip(&sums) {
            *total += sums.to_array().iter().map(|sum| f64::from(*sum)).sum::<f64>();
        }
    }
    totals
}
