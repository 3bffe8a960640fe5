//! The grey picture that is searched: the sites of one colour under a Gaussian as wide as their spacing needs.
//!
//! p(x) = Σ G(x - x_i) s_i / Σ G(x - x_i) over the sites i of the colour (normalised convolution, Knutsson and Westin 1993). The mean of the
//! nearest sites would leave steps along a rim that no ellipse explains. Its levels are the root of light ([`curve`](super::curve)). Hot
//! sites are replaced by their neighbours.

use super::Sites;
use super::curve::Curve;
use crate::detect::acceptance::sites::{HOT, HOT_TIMES};

/// Sigma of the Gaussian over the mean spacing of the sites: 0.75 px for the green of a Bayer pattern, 1.2 px for its red. There the tests'
/// scenes lose fewest targets: to the steps of the rims with less, to each other's light and to noise with more.
const SIGMA: [f64; 2] = [0.77, -0.34];
/// Share of a sigma's weight that is left out.
const LAST: f64 = 0.02;
/// Rows above and below that the look for hot sites needs.
const NEAR: usize = 2;

/// A picture of the lit part, and how many sites are hot.
pub(super) fn of(sites: &Sites, curve: &Curve) -> (Vec<u16>, usize) {
    let [left, top, right, bottom] = sites.lit;
    let (width, height) = (right - left, bottom - top);
    let taps = taps(sites);
    let reach = taps.len() - 1;
    let (mut light, mut row_sums) = (Lines::of(sites, 2 * (reach + NEAR) + 1), vec![0f32; width + 2 * reach]);
    let mut weights = RowWeights::of(sites, &taps);
    let mut samples = vec![0u16; width * height];
    for (row, line) in samples.chunks_exact_mut(width).enumerate() {
        light.read_to((row + reach + NEAR).min(height - 1));
        light.cool_to((row + reach).min(height - 1));
        row_sums.fill(0.0);
        let sums = &mut row_sums[reach..reach + width];
        add(sums, light.row(row), taps[0]);
        for (step, tap) in taps.iter().enumerate().skip(1) {
            row.checked_sub(step).into_iter().for_each(|above| add(sums, light.row(above), *tap));
            (row + step < height).then(|| add(sums, light.row(row + step), *tap));
        }
        across(line, &row_sums, &taps, weights.of_row(row), curve);
    }
    (samples, light.hot)
}

#[inline(never)]
fn add(sums: &mut [f32], light: &[f32], tap: f32) {
    for (sum, light) in sums.iter_mut().zip(light) {
        *sum += tap * light;
    }
}

/// The sums of a row under the other half of the Gaussian, over their weights.
#[inline(never)]
fn across(line: &mut [u16], sums: &[f32], taps: &[f32], inverse: &[f32], curve: &Curve) {
    let reach = taps.len() - 1;
    for ((column, sample), inverse) in line.iter_mut().enumerate().zip(inverse) {
        let around = &sums[column..column + 2 * reach + 1];
        let mut sum = taps[0] * around[reach];
        for (step, tap) in taps.iter().enumerate().skip(1) {
            sum += tap * (around[reach - step] + around[reach + step]);
        }
        *sample = curve.at(sum * inverse);
    }
}

/// Half of the Gaussian, from its middle on; where every pixel is a site of the colour it is the pixel itself.
fn taps(sites: &Sites) -> Vec<f32> {
    let pattern = &sites.sensor.mosaic.pattern;
    let (across, down) = (pattern.width(), pattern.height());
    let all = (across * down) as f64;
    let have = (0..down).flat_map(|y| (0..across).map(move |x| (x, y))).filter(|(x, y)| sites.has(*x, *y)).count();
    if have as f64 == all {
        return vec![1.0];
    }
    let sigma = SIGMA[0] * (all / (have as f64).max(1.0)).sqrt() + SIGMA[1];
    let weight = |step: usize| (-((step * step) as f64) / (2.0 * sigma * sigma)).exp();
    (0..).map(weight).take_while(|weight| *weight > LAST).map(|weight| weight as f32).collect()
}

/// One over the sum of weights at every pixel of a row: it repeats with the pattern but for the border and rows that are lost.
struct RowWeights<'a, 's> {
    sites: &'a Sites<'s>,
    taps: &'a [f32],
    /// Of the rows of the pattern, away from the upper and lower border.
    inner: Vec<Vec<f32>>,
    border: Vec<f32>,
}

impl<'a, 's> RowWeights<'a, 's> {
    fn of(sites: &'a Sites<'s>, taps: &'a [f32]) -> Self {
        let [_, top, _, bottom] = sites.lit;
        let mut weights = Self { sites, taps, inner: Vec::new(), border: Vec::new() };
        let reach = taps.len() - 1;
        let period = sites.sensor.mosaic.pattern.height();
        if bottom - top >= period + 2 * reach {
            weights.inner = (0..period).map(|row| weights.computed(row + reach, |_| true)).collect();
        }
        weights
    }

    fn of_row(&mut self, row: usize) -> &[f32] {
        let [_, top, _, bottom] = self.sites.lit;
        let reach = self.taps.len() - 1;
        let whole = |row: usize| (row - reach..=row + reach).all(|other| self.sites.is_whole(top + other));
        if row >= reach && row + reach < bottom - top && !self.inner.is_empty() && whole(row) {
            return &self.inner[(row - reach) % self.inner.len()];
        }
        self.border = self.computed(row, |other| self.sites.is_whole(top + other));
        &self.border
    }

    fn computed(&self, row: usize, is_whole: impl Fn(usize) -> bool) -> Vec<f32> {
        let [left, top, right, bottom] = self.sites.lit;
        let (width, reach) = (right - left, self.taps.len() - 1);
        let mut down = vec![0f32; width];
        let rows = row.saturating_sub(reach)..(row + reach + 1).min(bottom - top);
        for other in rows.filter(|other| is_whole(*other)) {
            let tap = self.taps[other.abs_diff(row)];
            for (column, sum) in down.iter_mut().enumerate() {
                *sum += if self.sites.has(left + column, top + other) { tap } else { 0.0 };
            }
        }
        let weight = |column: usize| {
            let columns = column.saturating_sub(reach)..(column + reach + 1).min(width);
            columns.map(|other| self.taps[other.abs_diff(column)] * down[other]).sum::<f32>()
        };
        let inverse = |weight: f32| if weight > 0.0 { 1.0 / weight } else { 0.0 };
        (0..width).map(|column| inverse(weight(column))).collect()
    }
}

/// Light of the sites of the colour, nothing elsewhere, in the lines around the one that is made: the whole of it would take
/// more memory than the picture.
struct Lines<'a, 's> {
    sites: &'a Sites<'s>,
    lines: Vec<f32>,
    kept: usize,
    width: usize,
    /// Lines read, and lines whose hot sites are replaced.
    read: usize,
    cooled: usize,
    hot: usize,
    /// Nearest sites of the colour, for each site of the pattern that has it.
    near: Vec<Vec<Vec<[isize; 2]>>>,
}

impl<'a, 's> Lines<'a, 's> {
    fn of(sites: &'a Sites<'s>, kept: usize) -> Self {
        let [left, _, right, _] = sites.lit;
        let pattern = &sites.sensor.mosaic.pattern;
        let near = |y| (0..pattern.width()).map(|x| neighbours(sites, (x, y))).collect();
        let near = (0..pattern.height()).map(near).collect();
        let width = right - left;
        Self { sites, lines: vec![0.0; kept * width], kept, width, read: 0, cooled: 0, hot: 0, near }
    }

    fn row(&self, row: usize) -> &[f32] {
        &self.lines[row % self.kept * self.width..][..self.width]
    }

    /// Reads the lines up to one.
    fn read_to(&mut self, last: usize) {
        let [left, top, ..] = self.sites.lit;
        let Sites { sensor, .. } = self.sites;
        while self.read <= last {
            let y = self.read + top;
            let has: Vec<bool> = (0..sensor.mosaic.pattern.width()).map(|k| self.sites.has(left + k, y)).collect();
            let samples = &sensor.samples[y * sensor.width + left..][..self.width];
            let black = sensor.mosaic.black.of_row(y);
            let line = &mut self.lines[self.read % self.kept * self.width..][..self.width];
            line.fill(0.0);
            let whole = self.sites.is_whole(y);
            for first in (0..has.len()).filter(|k| whole && has[*k]) {
                for (column, sample) in samples.iter().enumerate().skip(first).step_by(has.len()) {
                    line[column] = f32::from(*sample) - black.at(column + left) as f32;
                }
            }
            self.read += 1;
        }
    }

    /// Replaces hot sites by their neighbours' mean, in the lines up to one.
    fn cool_to(&mut self, last: usize) {
        let [left, top, _, bottom] = self.sites.lit;
        while self.cooled <= last {
            let row = self.cooled;
            self.cooled += 1;
            if row < NEAR || row + NEAR >= bottom - top {
                continue;
            }
            let period = self.sites.sensor.mosaic.pattern.width();
            for phase in 0..period {
                let near = &self.near[(row + top) % self.near.len()][(phase + left) % period];
                if near.is_empty() {
                    continue;
                }
                let near: Vec<(usize, isize)> =
                    near.iter().map(|[dx, dy]| (row.wrapping_add_signed(*dy) % self.kept * self.width, *dx)).collect();
                let own = row % self.kept * self.width;
                for column in (phase..self.width.saturating_sub(NEAR)).step_by(period).filter(|column| *column >= NEAR)
                {
                    if let Some(mean) = hot(&self.lines, own + column, column, &near, self.sites) {
                        self.lines[own + column] = mean;
                        self.hot += 1;
                    }
                }
            }
        }
    }
}

/// Mean of a hot site's neighbours.
#[inline]
fn hot(lines: &[f32], own: usize, column: usize, near: &[(usize, isize)], sites: &Sites) -> Option<f32> {
    let own = lines[own];
    let at = |(line, dx): &(usize, isize)| lines[line + column.wrapping_add_signed(*dx)];
    // most sites are no brighter than the first of their neighbours
    if near.iter().any(|place| at(place) >= own) {
        return None;
    }
    let brightest = near.iter().map(at).fold(f32::MIN, f32::max);
    let room = HOT * sites.noise.deviation(f64::from(brightest));
    let hot = f64::from(own - brightest) > room && f64::from(own) > HOT_TIMES * f64::from(brightest.max(0.0));
    hot.then(|| near.iter().map(at).sum::<f32>() / near.len() as f32)
}

/// Where the nearest sites of the colour lie from one of the pattern that has it.
fn neighbours(sites: &Sites, (x, y): (usize, usize)) -> Vec<[isize; 2]> {
    let pattern = &sites.sensor.mosaic.pattern;
    let (across, down) = (pattern.width() as isize, pattern.height() as isize);
    let has = |dx: isize, dy: isize| {
        let wrapped = |at: usize, step: isize, size: isize| (at as isize + step).rem_euclid(size) as usize;
        sites.has(wrapped(x, dx, across), wrapped(y, dy, down))
    };
    if !has(0, 0) {
        return Vec::new();
    }
    let steps = -(NEAR as isize)..=NEAR as isize;
    let places = steps.clone().flat_map(|dy| steps.clone().map(move |dx| [dx, dy]));
    let places: Vec<[isize; 2]> = places.filter(|[dx, dy]| (*dx, *dy) != (0, 0) && has(*dx, *dy)).collect();
    let square = |[dx, dy]: &[isize; 2]| dx * dx + dy * dy;
    let nearest = places.iter().map(square).min().unwrap_or(0);
    places.into_iter().filter(|place| square(place) == nearest).collect()
}
