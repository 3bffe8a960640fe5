//! Exact image of a blurred ellipse, and its derivatives.
//!
//! The camera averages over square pixels what the lens has blurred (Gaussian of sigma s). With
//! k(t) = Φ((t + 1/2)/s) - Φ((t - 1/2)/s), the pixel's box convolved with the Gaussian, and K its antiderivative, Green's
//! theorem turns the integral over the ellipse into one along its rim (u(t), v(t)):
//!
//! I(x, y) = ∮ -K(x - u) k(y - v) dv, the share of the pixel at (x, y) that the ellipse fills,
//! dI/du = ∮ k(x - u) k(y - v) dv and dI/dv = -∮ k(x - u) k(y - v) du, since the centre moves the rim only,
//! dI/ds = s (d²I/dx² + d²I/dy²) = s ∮ (-k'(x - u) k(y - v) dv + k(x - u) k'(y - v) du), since blur obeys the heat equation.
//!
//! The integrands are smooth and periodic in t, so the trapezium rule is exact to rounding once its points lie closer than
//! the blur. Each rim point reaches a few pixels only: K is summed as its difference from column to column, and the rows are
//! added up in the end. Single precision is enough: its rounding is 1e-6 of the contrast.

pub(crate) mod band;
pub(crate) mod fit;
mod flats;
pub(crate) mod lit;
pub(crate) mod neighbours;
pub(crate) mod noise_autocorrelation;
mod residual_covariance;
mod scatter;
mod shape;
mod sketch;

use wide::f32x4;

use super::ellipse::outline::Outline;
use super::normal::normal_distribution;

/// Share of its light below which a rim point leaves a row alone; thirty times as much for the derivatives, which only
/// show the way.
const FAINT: f32 = 3e-6;

/// Pixels of a row: row and first column in the field, how many.
pub(crate) type Span = (usize, usize, usize);

/// Pixels of a field that is cleared as a whole: span by span takes longer.
const SMALL: usize = 1 << 13;

/// Number of derivatives: u and v of the outline and the blur s.
pub(crate) const DERIVATIVES: usize = 3;

/// Columns and rows a rim point reaches for a given blur (four sigmas to both sides), in the steps that are compiled.
fn reach(s: f64) -> usize {
    let needed = (2.0 * (4.0 * s + 0.5)).ceil() as usize + 1;
    [8, 12, 16, 24, 32, 48, 64].into_iter().find(|&n| n >= needed).unwrap_or(64)
}

/// Pixels around an ellipse with the share that it fills, and the derivatives. Reused from target to target.
#[derive(Default)]
pub(crate) struct Field {
    /// First column and row; may lie outside the picture.
    pub left: i64,
    pub top: i64,
    pub width: usize,
    pub height: usize,
    /// Share of each pixel, row by row, then the derivatives, one field after the other.
    planes: Vec<f32>,
}

impl Field {
    /// Lays the field around an ellipse, with room for its blur, and for changes of up to `room` pixels.
    pub fn place(&mut self, outline: &Outline, s: f64, room: f64) {
        let (half_u, half_v) = outline.half_box();
        let margin = reach(s) as f64 / 2.0 + 1.5 + room;
        self.left = (outline.u - half_u - margin).floor() as i64;
        self.top = (outline.v - half_v - margin).floor() as i64;
        self.width = (2.0 * (half_u + margin)).ceil() as usize + 2;
        self.height = (2.0 * (half_v + margin)).ceil() as usize + 2;
    }

    /// Whether the ellipse with its blur lies inside the field.
    pub fn holds(&self, outline: &Outline, s: f64) -> bool {
        let (half_u, half_v) = outline.half_box();
        let margin = reach(s) as f64 / 2.0 + 1.0;
        let inside = |low: i64, size: usize, middle: f64, half: f64| {
            middle - half - margin >= low as f64 && middle + half + margin <= low as f64 + size as f64
        };
        inside(self.left, self.width, outline.u, half_u) && inside(self.top, self.height, outline.v, half_v)
    }

    /// Shares of the pixels of a row of the field.
    pub fn share(&self, row: usize) -> &[f32] {
        &self.planes[row * self.width..(row + 1) * self.width]
    }

    /// One derivative of the pixels of a row of the field.
    pub fn derivative(&self, which: usize, row: usize) -> &[f32] {
        let start = ((which + 1) * self.height + row) * self.width;
        &self.planes[start..start + self.width]
    }

    /// Renders the shares and, if wanted, the derivatives. The ellipse must lie inside ([`Field::holds`]). Only the spans (row, first
    /// column, length) may be read afterwards: in a large field the derivatives elsewhere are not even cleared, as the middle of a
    /// large ellipse would cost more than its rim.
    pub fn render(&mut self, outline: &Outline, s: f64, derivatives: bool, spans: &[Span]) {
        let planes = if derivatives { 1 + DERIVATIVES } else { 1 };
        let size = self.width * self.height;
        self.planes.resize(self.planes.len().max(planes * size), 0.0);
        self.planes[..size].fill(0.0);
        if derivatives {
            for plane in self.planes[size..].chunks_exact_mut(size).take(DERIVATIVES) {
                if size < SMALL {
                    plane.fill(0.0);
                    continue;
                }
                for &(row, column, count) in spans {
                    let from = row * self.width + column;
                    plane[from..from + count].fill(0.0);
                }
            }
        }
        if derivatives {
            self.sum_up::<true>(outline, s);
        } else {
            self.sum_up::<false>(outline, s);
        }
        for row in self.planes[..size].chunks_exact_mut(self.width) {
            let mut sum = 0.0;
            for value in row {
                sum += *value;
                *value = sum;
            }
        }
    }

    /// Sums along the rim, with the derivatives (D) or without.
    fn sum_up<const D: bool>(&mut self, outline: &Outline, s: f64) {
        match reach(s) {
            8 => self.integrate::<8, 3, D>(outline, s),
            12 => self.integrate::<12, 4, D>(outline, s),
            16 => self.integrate::<16, 5, D>(outline, s),
            24 => self.integrate::<24, 7, D>(outline, s),
            32 => self.integrate::<32, 9, D>(outline, s),
            48 => self.integrate::<48, 13, D>(outline, s),
            _ => self.integrate::<64, 17, D>(outline, s),
        }
    }

    // Apart for every size: a function that held them all would be too large for a browser's optimising compiler.
    #[inline(never)]
    fn integrate<const N: usize, const B: usize, const D: bool>(&mut self, outline: &Outline, s: f64) {
        // the trapezium rule errs by 2 exp(-2 (π s / h)²): 2e-6 for steps h of 1.2 sigma
        let count = ((outline.perimeter() / (1.2 * s)).ceil() as usize).max(16);
        let turn = std::f64::consts::TAU / count as f64;
        let (turn_s, turn_c) = turn.sin_cos();
        let (mut c, mut sn) = (1.0, 0.0);
        let size = self.width * self.height;
        let (width, inverse) = (s as f32, (1.0 / s) as f32);
        for _ in 0..count {
            let x = outline.u + outline.p * c + outline.r * sn - self.left as f64;
            let y = outline.v + outline.r * c + outline.q * sn - self.top as f64;
            let du = (-outline.p * sn + outline.r * c) * turn;
            let dv = (-outline.r * sn + outline.q * c) * turn;
            let (across, down) = (Kernel::<N>::at::<B>(x, width, inverse), Kernel::<N>::at::<B>(y, width, inverse));
            let start = down.first * self.width + across.first;
            let [along, aside] = [dv, -du].map(|weight| weight as f32);
            let blur = [(-s * dv) as f32, (s * du) as f32];
            for row in 0..N {
                let level = down.pixel[row];
                if level < FAINT {
                    continue;
                }
                let from = start + row * self.width;
                add::<N, _>(&mut self.planes[from..], [(&across.ramp, -along * level)]);
                if !D || level < 30.0 * FAINT {
                    continue;
                }
                add::<N, _>(&mut self.planes[size + from..], [(&across.pixel, along * level)]);
                add::<N, _>(&mut self.planes[2 * size + from..], [(&across.pixel, aside * level)]);
                let both = [(&across.slope, blur[0] * level), (&across.pixel, blur[1] * down.slope[row])];
                add::<N, _>(&mut self.planes[3 * size + from..], both);
            }
            (c, sn) = (c * turn_c - sn * turn_s, sn * turn_c + c * turn_s);
        }
    }
}

/// Adds weighted rows of N pixels.
#[inline(always)]
fn add<const N: usize, const K: usize>(to: &mut [f32], terms: [(&[f32; N], f32); K]) {
    let Some(to) = to.first_chunk_mut::<N>() else { return };
    let terms = terms.map(|(values, weight)| (values.as_chunks::<4>().0, f32x4::splat(weight)));
    for (i, to) in to.as_chunks_mut::<4>().0.iter_mut().enumerate() {
        let sum = terms.iter().fold(f32x4::new(*to), |sum, (values, weight)| sum + *weight * f32x4::new(values[i]));
        *to = sum.to_array();
    }
}

/// k, its derivative, and the difference of K from pixel to pixel, for the N pixels around a place.
struct Kernel<const N: usize> {
    first: usize,
    pixel: [f32; N],
    slope: [f32; N],
    ramp: [f32; N],
}

impl<const N: usize> Kernel<N> {
    /// B is the number of fours that hold the borders of the pixels, from -1 to N.
    #[inline(always)]
    fn at<const B: usize>(place: f64, s: f32, inverse: f32) -> Self {
        // the conversion makes 0 of what is negative
        let first = (place - (N as f64 - 1.0) / 2.0) as usize;
        let offset = (first as f64 - place) as f32;
        // at the borders: the antiderivative of Φ, Φ itself, the density
        let (mut antiderivative, mut normal, mut density) = ([[0f32; 4]; B], [[0f32; 4]; B], [[0f32; 4]; B]);
        for i in 0..B {
            let t = f32x4::new([-1.0, 0.0, 1.0, 2.0]) + f32x4::splat(offset + 4.0 * i as f32);
            let z = (t * f32x4::splat(inverse)).fast_max(f32x4::splat(-5.5)).fast_min(f32x4::splat(5.5));
            let (n, d) = normal_distribution(z);
            (normal[i], density[i]) = (n.to_array(), d.to_array());
            antiderivative[i] = (t * n + f32x4::splat(s) * d).to_array();
        }
        let (antiderivative, normal, density) =
            (antiderivative.as_flattened(), normal.as_flattened(), density.as_flattened());
        let (mut pixel, mut slope, mut ramp) = ([0f32; N], [0f32; N], [0f32; N]);
        // four at a time
        let four = |values: &[f32], i: usize| f32x4::new([values[i], values[i + 1], values[i + 2], values[i + 3]]);
        let fours = pixel.as_chunks_mut::<4>().0.iter_mut().zip(slope.as_chunks_mut::<4>().0);
        for (k, ((pixel, slope), ramp)) in fours.zip(ramp.as_chunks_mut::<4>().0).enumerate() {
            let i = 4 * k;
            *pixel = (four(normal, i + 2) - four(normal, i + 1)).to_array();
            *slope = ((four(density, i + 2) - four(density, i + 1)) * f32x4::splat(inverse)).to_array();
            let middle = four(antiderivative, i + 1);
            *ramp = ((four(antiderivative, i + 2) - middle) - (middle - four(antiderivative, i))).to_array();
        }
        Self { first, pixel, slope, ramp }
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    fn rendered(outline: &Outline, s: f64) -> Field {
        let mut field = Field::default();
        field.place(&Outline::from_axes(20.0, 20.0, 12.0, 12.0, 0.0), 3.0, 2.0);
        assert!(field.holds(outline, s));
        let spans: Vec<Span> = (0..field.height).map(|row| (row, 0, field.width)).collect();
        field.render(outline, s, true, &spans);
        field
    }

    #[test]
    fn the_whole_ellipse_is_in_the_pixels() {
        for s in [0.3, 0.7, 2.0] {
            let field = rendered(&Outline::from_axes(20.3, 19.6, 9.0, 4.0, 0.5), s);
            let sum: f32 = (0..field.height).flat_map(|row| field.share(row)).sum();
            assert!((f64::from(sum) - std::f64::consts::PI * 36.0).abs() < 2e-3, "{s}: {sum}");
        }
    }

    #[test]
    fn shares_agree_with_plain_sampling_of_the_blurred_disc() {
        // independent: average over sub-pixels of the ellipse convolved with a sampled Gaussian
        let outline = Outline::from_axes(20.3, 19.6, 4.0, 2.5, 0.5);
        let s = 0.7;
        let field = rendered(&outline, s);
        for (x, y) in [(20, 19), (23, 20), (24, 21), (18, 16), (21, 22), (16, 18)] {
            let (mut sum, mut weight) = (0.0, 0.0);
            for i in -70..=70 {
                for j in -70..=70 {
                    let (dx, dy) = (f64::from(i) * 0.05, f64::from(j) * 0.05);
                    // density of box * Gaussian at this offset
                    let k = |t: f64| {
                        let phi = |z: f64| f64::from(normal_distribution(f32x4::splat(z as f32)).0.to_array()[0]);
                        phi((t + 0.5) / s) - phi((t - 0.5) / s)
                    };
                    let w = k(dx) * k(dy);
                    let [c, sn] = outline.normalised(x as f64 + 0.5 + dx, y as f64 + 0.5 + dy);
                    sum += if c * c + sn * sn <= 1.0 { w } else { 0.0 };
                    weight += w;
                }
            }
            let share = field.share((y - field.top) as usize)[(x - field.left) as usize];
            assert!((sum / weight - f64::from(share)).abs() < 3e-3, "{x} {y}: {} {share}", sum / weight);
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let (outline, s, step) = (Outline::from_axes(20.3, 19.6, 6.0, 3.0, 0.5), 0.8, 2e-2);
        let field = rendered(&outline, s);
        for which in 0..DERIVATIVES {
            let shifted = |sign: f64| {
                let mut d = [0.0; 2];
                if which < 2 {
                    d[which] = sign * step;
                }
                let moved = Outline { u: outline.u + d[0], v: outline.v + d[1], ..outline };
                rendered(&moved, if which == 2 { s + sign * step } else { s })
            };
            let (more, less) = (shifted(1.0), shifted(-1.0));
            for row in 0..field.height {
                for column in 0..field.width {
                    let difference = (more.share(row)[column] - less.share(row)[column]) / (2.0 * step as f32);
                    let derivative = field.derivative(which, row)[column];
                    assert!(
                        (difference - derivative).abs() < 1e-3,
                        "{which} {row} {column}: {difference} {derivative}"
                    );
                }
            }
        }
    }
}
