//! Grey levels of the annulus around a target: background plane, noise, contrast, and undisturbed radius.
//!
//! Rings of single pixels are read outside of the rim, from where its blur ends to a radius beyond. The nearest ring fixes a
//! plane robustly; every further ring that agrees with it in mean and spread is added, the first that does not ends the
//! annulus: a card's edge, a code ring, a neighbour. A wide background matters: over a narrow one the slope of the light cannot be
//! separated from a shift of the target.

use nalgebra::{Matrix3, Vector3};
use wide::f32x4;

use super::quick_test::QUARTER;
use crate::detect::acceptance::levels::{QUIET, RING, RING_TENTHS};
use crate::detect::ellipse::outline::Outline;
use crate::detect::ellipse::rays::{Rays, rim_points};
use crate::detect::median;
use crate::image::{Sample, SampleView};

/// Grey levels around a target.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surround {
    /// Background at the centre, and its slope along u and v.
    pub level: f64,
    pub slope: [f64; 2],
    /// Covariance of that slope: uu, uv, vv.
    pub slope_covariance: [f64; 3],
    /// Standard deviation of single pixels from that plane.
    pub noise: f64,
    /// Inside minus outside.
    pub contrast: f64,
    /// Share of the inner pixels that are far from their median, by a third of the contrast.
    pub uneven: f64,
    /// Distance from the rim up to which the background is undisturbed, in pixels.
    pub outer: f64,
}

/// Width of the annulus at most, in mean radii and six pixels: there the unknown slope of the light costs the centre of a bright disc on a
/// background of a sixth of its level 1 to 3 % of its standard error, against 3 to 12 % in a width of 1; in a wider one light is no plane.
const WIDTH: f64 = 2.0;

/// A sample: place relative to the centre, level less that of the centre.
type Spot = [f64; 3];

/// Measures the annulus in at most so many rings; rays that are not `kept` are left out. `None` if too little of it lies in
/// the picture.
pub(crate) fn measure<T: Sample>(
    plane: &SampleView<T>,
    outline: &Outline,
    blur: f64,
    kept: &[bool],
    rings: u32,
) -> Option<Surround> {
    let rims = Rims::of(plane, outline, kept);
    let (a, b) = outline.semi_axes();
    let start = 3.0 * blur + 0.6;
    let width = WIDTH * ((a * b).sqrt() + 6.0);
    let spacing = (width / 24.0).max(1.0);
    let mut spots: Vec<Spot> = Vec::with_capacity(2 * kept.len());
    let mut sums = BackgroundSums::default();
    let mut found: Option<(Vector3<f64>, f64)> = None;
    let mut outer = start;
    let mut step = 0;
    let widest = width.max(start + 2.0);
    while step < rings && start + f64::from(step) * spacing < widest {
        let distance = start + f64::from(step) * spacing;
        match &mut found {
            None => {
                // two rings for the first plane
                rims.spots(distance, &mut spots);
                if step == 1 {
                    found = Some(robust_plane(&mut spots)?);
                    sums = BackgroundSums::of(spots.iter().copied());
                }
            }
            Some((coefficients, noise)) => {
                let next = rims.sums(distance);
                if next.n * 10.0 < kept.len() as f64 * RING_TENTHS {
                    break;
                }
                let (mean, square) = next.residuals(coefficients);
                let floor = noise.max(QUIET);
                if square > (RING[0] * floor).powi(2) || mean.abs() > RING[1] * floor {
                    break;
                }
                sums.add(&next);
                if step % 3 == 0 {
                    (*coefficients, *noise) = sums.plane()?;
                }
            }
        }
        outer = distance;
        step += 1;
    }
    let (coefficients, noise) = if outer > start + 1.5 * spacing { sums.plane()? } else { found? };
    let inside = rims.inside();
    let median = median::of_sizes(inside.iter().copied(), &mut Vec::with_capacity(inside.len()));
    let level = coefficients.x + rims.reference;
    let contrast = median - level;
    let far = inside.iter().filter(|inside| (f64::from(**inside) - median).abs() > contrast.abs() / 3.0).count();
    Some(Surround {
        level,
        slope: [coefficients.y, coefficients.z],
        slope_covariance: sums.slope_cofactors()?.map(|cofactor| cofactor * noise * noise),
        noise,
        contrast,
        uneven: far as f64 / inside.len() as f64,
        outer,
    })
}

/// Test of an outline with one ring of few rays.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Glance {
    /// The most that it may differ from what lies around it: from the eighth of the rays that differs most, if the majority that fixes
    /// the plane of [`measure`] is there.
    pub contrast: f64,
    /// Share of that contrast that a quarter of the rays still show around it, and an eighth of them.
    pub joined: [f64; 2],
}

/// A glance around an outline. `None` if too little of it lies in the picture.
pub(crate) fn glance<T: Sample>(plane: &SampleView<T>, outline: &Outline, blur: f64, bright: bool) -> Option<Glance> {
    const RAYS: usize = 24;
    let rims = Rims::of(plane, outline, &[true; RAYS]);
    let (mut levels, mut count) = ([f32::MAX; RAYS], 0);
    for four in rims.ring(3.0 * blur + 0.6) {
        let [_, _, level, one] = four.map(f32x4::to_array);
        for k in (0..4).filter(|k| one[*k] > 0.0) {
            levels[count] = if bright { level[k] } else { -level[k] };
            count += 1;
        }
    }
    if count < RAYS / 2 {
        return None;
    }
    let levels = &mut levels[..count];
    levels.sort_unstable_by(f32::total_cmp);
    let inside = median::of_sizes(rims.inside().into_iter(), &mut Vec::new()) - rims.reference;
    let inside = if bright { inside } else { -inside };
    let least = f64::from(levels[count / 8]);
    let contrast = inside - least;
    let joined = [4, 8].map(|part| (f64::from(levels[count - 1 - count / part]) - least) / contrast);
    Some(Glance { contrast, joined })
}

/// The background of a disc in the gap of this width between its rim and what stands around it: its level, and how much of it, as a share
/// of the contrast, the worst direction but two lacks. `None` if some of it lies outside of the picture.
///
/// Each direction shows its background where it is most unlike the disc.
pub(crate) fn in_gap<T: Sample>(
    plane: &SampleView<T>,
    outline: &Outline,
    width: f64,
    bright: bool,
) -> Option<[f64; 2]> {
    const RAYS: usize = 24;
    let rims = Rims::of(plane, outline, &[true; RAYS]);
    let mut grounds = [f32::MAX; RAYS];
    let steps = (width.ceil() as usize).max(1);
    for step in 1..=steps {
        for (four, grounds) in rims.ring(width * step as f64 / steps as f64).zip(grounds.as_chunks_mut::<4>().0) {
            let [_, _, level, one] = four.map(f32x4::to_array);
            for k in (0..4).filter(|k| one[*k] > 0.0) {
                grounds[k] = grounds[k].min(if bright { level[k] } else { -level[k] });
            }
        }
    }
    if grounds.contains(&f32::MAX) {
        return None;
    }
    grounds.sort_unstable_by(f32::total_cmp);
    let inside = median::of_sizes(rims.inside().into_iter(), &mut Vec::new()) - rims.reference;
    let inside = if bright { inside } else { -inside };
    let level = f64::from(grounds[RAYS / 4]);
    let lacking = (f64::from(grounds[RAYS - 3]) - level) / (inside - level);
    Some([rims.reference + if bright { level } else { -level }, lacking])
}

/// Rim points and normals of the rays that count, four at a time, and how to read pixels there.
struct Rims<'a, T> {
    plane: &'a SampleView<'a, T>,
    rays: Rays,
    /// Pixel of the outline's centre, and the centre's place in it.
    from: [i32; 2],
    centre: [f32x4; 2],
    /// Level of that pixel: levels are taken less this, so that their squares stay small.
    reference: f64,
    /// Places, normals, and 1 for a ray, 0 for what fills up the last four.
    fours: Vec<[[f32; 4]; 5]>,
}

impl<'a, T: Sample> Rims<'a, T> {
    fn of(plane: &'a SampleView<'a, T>, outline: &Outline, kept: &[bool]) -> Self {
        let whole = [outline.u.floor(), outline.v.floor()];
        let centre = [outline.u - whole[0], outline.v - whole[1]].map(|rest| f32x4::splat(rest as f32));
        let mut fours = Vec::with_capacity(kept.len() / 4 + 1);
        let mut counted = rim_points(outline, kept.len()).zip(kept).filter(|(_, kept)| **kept).map(|(rim, _)| rim);
        while let Some(rim) = counted.next() {
            let mut four = [[0.0; 4]; 5];
            for (k, rim) in std::iter::once(rim).chain(counted.by_ref().take(3)).enumerate() {
                let [x, y] = [rim.x - whole[0], rim.y - whole[1]];
                for (column, value) in four.iter_mut().zip([x, y, rim.normal[0], rim.normal[1], 1.0]) {
                    column[k] = value as f32;
                }
            }
            fours.push(four);
        }
        let reference = f64::from(plane.nearest(outline.u, outline.v));
        Self { plane, rays: Rays::new(outline), from: whole.map(|whole| whole as i32), centre, reference, fours }
    }

    /// Pixels on a ring, `distance` beyond the rim: places relative to the centre, levels, 1 or 0.
    #[inline(always)]
    fn ring(&self, distance: f64) -> impl Iterator<Item = [f32x4; 4]> {
        let (distance, half) = (f32x4::splat(distance as f32), f32x4::splat(0.5));
        let reference = f32x4::splat(self.reference as f32);
        self.fours.iter().map(move |four| {
            let [x, y, nx, ny, one] = *four;
            let [x, y, nx, ny, one] = [f32x4::new(x), f32x4::new(y), f32x4::new(nx), f32x4::new(ny), f32x4::new(one)];
            let ([x, y], level, inside) = self.plane.pixels_four(self.from, x + distance * nx, y + distance * ny);
            [x + half - self.centre[0], y + half - self.centre[1], level - reference, inside & one]
        })
    }

    fn spots(&self, distance: f64, spots: &mut Vec<Spot>) {
        for four in self.ring(distance) {
            let [x, y, level, one] = four.map(f32x4::to_array);
            let counted = (0..4).filter(|k| one[*k] > 0.0);
            spots.extend(counted.map(|k| [x[k], y[k], level[k]].map(f64::from)));
        }
    }

    fn sums(&self, distance: f64) -> BackgroundSums {
        let mut sums = [f32x4::ZERO; 10];
        for [x, y, g, one] in self.ring(distance) {
            let [x, y, g] = [x * one, y * one, g * one];
            for (sum, term) in sums.iter_mut().zip([one, x, y, x * x, x * y, y * y, g, g * x, g * y, g * g]) {
                *sum += term;
            }
        }
        let [n, x, y, xx, xy, yy, g, gx, gy, gg] =
            sums.map(|sum| sum.to_array().into_iter().map(f64::from).sum::<f64>());
        BackgroundSums { n, x, y, xx, xy, yy, g, gx, gy, gg }
    }

    /// Levels of pixels inside: the middle, and 16 directions at three distances from it.
    fn inside(&self) -> Vec<f32> {
        let mut levels = Vec::with_capacity(49);
        levels.push(self.reference as f32);
        for radius in [0.25, 0.5, 0.7].map(f32x4::splat) {
            for [c, s] in QUARTER {
                let rim = self.rays.at(c, s);
                let (x, y) = (self.centre[0] + radius * rim.x, self.centre[1] + radius * rim.y);
                let (level, inside) = self.plane.nearest_four(self.from, x, y);
                let inside = (inside & f32x4::ONE).to_array();
                levels.extend(level.to_array().into_iter().zip(inside).filter(|(_, one)| *one > 0.0).map(|(l, _)| l));
            }
        }
        levels
    }
}

fn residual(coefficients: &Vector3<f64>, [x, y, level]: &Spot) -> f64 {
    level - coefficients.x - coefficients.y * x - coefficients.z * y
}

/// Sums of the normal equations of a plane: of 1, x, y, their products, and their products with the level g.
#[derive(Clone, Copy, Default)]
struct BackgroundSums {
    n: f64,
    x: f64,
    y: f64,
    xx: f64,
    xy: f64,
    yy: f64,
    g: f64,
    gx: f64,
    gy: f64,
    gg: f64,
}

impl BackgroundSums {
    fn of(spots: impl Iterator<Item = Spot>) -> Self {
        let mut sums = Self::default();
        for [x, y, level] in spots {
            sums.n += 1.0;
            sums.x += x;
            sums.y += y;
            sums.xx += x * x;
            sums.xy += x * y;
            sums.yy += y * y;
            sums.g += level;
            sums.gx += level * x;
            sums.gy += level * y;
            sums.gg += level * level;
        }
        sums
    }

    fn add(&mut self, other: &Self) {
        self.n += other.n;
        self.x += other.x;
        self.y += other.y;
        self.xx += other.xx;
        self.xy += other.xy;
        self.yy += other.yy;
        self.g += other.g;
        self.gx += other.gx;
        self.gy += other.gy;
        self.gg += other.gg;
    }

    /// Mean of the residuals from a plane c, and mean of their squares: Σ(g - c'a)² = Σg² - 2 c'Σag + c'(Σaa')c.
    fn residuals(&self, c: &Vector3<f64>) -> (f64, f64) {
        let along = self.normal() * c;
        let right = self.right();
        let mean = (self.g - along.x) / self.n;
        (mean, ((self.gg - 2.0 * c.dot(&right) + c.dot(&along)) / self.n).max(0.0))
    }

    fn normal(&self) -> Matrix3<f64> {
        Matrix3::new(self.n, self.x, self.y, self.x, self.xx, self.xy, self.y, self.xy, self.yy)
    }

    fn right(&self) -> Vector3<f64> {
        Vector3::new(self.g, self.gx, self.gy)
    }

    /// Cofactors of the plane's slope: uu, uv, vv.
    fn slope_cofactors(&self) -> Option<[f64; 3]> {
        let inverse = self.normal().cholesky()?.inverse();
        Some([inverse[(1, 1)], inverse[(1, 2)], inverse[(2, 2)]])
    }

    /// Least-squares plane and the standard deviation from it.
    fn plane(&self) -> Option<(Vector3<f64>, f64)> {
        if self.n < 8.0 {
            return None;
        }
        let right = self.right();
        let coefficients = self.normal().cholesky()?.solve(&right);
        let square = self.gg - coefficients.dot(&right);
        Some((coefficients, if square > 0.0 { (square / (self.n - 3.0)).sqrt() } else { 0.0 }))
    }
}

fn plane_through(spots: &[Spot]) -> Option<(Vector3<f64>, f64)> {
    BackgroundSums::of(spots.iter().copied()).plane()
}

/// The same without outliers, which are removed from the spots: further than three robust sigmas from the plane.
fn robust_plane(spots: &mut Vec<Spot>) -> Option<(Vector3<f64>, f64)> {
    let (mut coefficients, mut noise) = plane_through(spots)?;
    for _ in 0..4 {
        let mut distances: Vec<f64> = spots.iter().map(|spot| residual(&coefficients, spot).abs()).collect();
        let half = distances.len() / 2;
        let (_, &mut median, _) = distances.select_nth_unstable_by(half, f64::total_cmp);
        let limit = (3.0 * 1.4826 * median).max(1.5);
        let before = spots.len();
        spots.retain(|spot| residual(&coefficients, spot).abs() <= limit);
        if spots.len() == before {
            break;
        }
        (coefficients, noise) = plane_through(spots)?;
    }
    Some((coefficients, noise))
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn one_ring_shows_no_less_contrast_than_the_whole_surround() {
        // discs of both polarities and a shape that goes on beyond the outline, on sloping background with noise
        for (bright, disc, shown) in
            [(true, 90.0, true), (false, -70.0, true), (true, -70.0, false), (false, 90.0, false)]
        {
            for joined in [false, true] {
                let samples: Vec<u8> = (0..100 * 100)
                    .map(|i| {
                        let (x, y) = (f64::from(i % 100) - 49.5, f64::from(i / 100) - 49.5);
                        let noise = f64::from((i as u32).wrapping_mul(2_654_435_761) >> 24) / 40.0;
                        let inside = x.hypot(y) < 12.0 || joined && x > 0.0 && y.abs() < 4.0;
                        (100.0 + 0.2 * x - 0.1 * y + noise + if inside { disc } else { 0.0 }) as u8
                    })
                    .collect();
                let plane = SampleView::new(100, 100, &samples);
                let outline = Outline::from_axes(50.0, 50.0, 12.0, 12.0, 0.0);
                let at_most = glance(&plane, &outline, 0.7, bright).unwrap().contrast;
                let whole = measure(&plane, &outline, 0.7, &[true; 40], u32::MAX).unwrap().contrast;
                let whole = if bright { whole } else { -whole };
                assert!(at_most > whole && at_most < whole + 12.0, "{bright} {disc} {joined}: {at_most} {whole}");
                assert_eq!(at_most > 0.0, shown);
            }
        }
    }

    #[test]
    fn one_ring_shows_in_how_many_directions_a_disc_goes_on() {
        // half the width of an arm, and whether an eighth and a quarter of the directions lie in it
        for (half, eighth, quarter) in
            [(0.0, false, false), (3.0, false, false), (8.0, true, false), (14.0, true, true)]
        {
            for (bright, disc) in [(true, 90.0), (false, -70.0)] {
                let samples: Vec<u8> = (0..100 * 100)
                    .map(|i| {
                        let (x, y) = (f64::from(i % 100) - 49.5, f64::from(i / 100) - 49.5);
                        let inside = x.hypot(y) < 12.0 || x > 0.0 && y.abs() < half;
                        (100.0 + if inside { disc } else { 0.0 }) as u8
                    })
                    .collect();
                let outline = Outline::from_axes(50.0, 50.0, 12.0, 12.0, 0.0);
                let joined = glance(&SampleView::new(100, 100, &samples), &outline, 0.7, bright).unwrap().joined;
                assert_eq!(joined.map(|share| share > 0.9), [quarter, eighth], "{half} {joined:?}");
                assert!(joined.iter().all(|share| *share > 0.9 || *share < 0.1), "{half} {joined:?}");
            }
        }
    }
}
