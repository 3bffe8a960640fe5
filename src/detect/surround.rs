//! Grey levels around a target: background plane, noise, contrast, and how far out the background is undisturbed.
//!
//! Rings of single pixels are read outside of the rim, from where its blur ends to a radius beyond. The nearest ring fixes a
//! plane robustly; every further ring that agrees with it in mean and spread is added, the first that does not ends the
//! surround: a card's edge, a code ring, a neighbour. A wide background matters: over a narrow one its slope cannot be
//! told from a shift of the target.

use nalgebra::{Matrix3, Vector3};

use super::edge::rim_points;
use super::outline::Outline;
use crate::image::{Plane, Sample};

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

/// A sample: place relative to the centre, level.
type Spot = [f64; 3];

/// Measures the surround in at most so many rings; rays that are not `kept` are left out. None when too little of it lies in
/// the picture.
pub(crate) fn measure<T: Sample>(
    plane: &Plane<T>,
    outline: &Outline,
    blur: f64,
    kept: &[bool],
    rings: u32,
) -> Option<Surround> {
    // the pixel of a place, relative to the centre, with its level
    let [wide, high] = [plane.width, plane.height].map(|size| size as f64);
    let pixel = |x: f64, y: f64| {
        (x >= 0.0 && y >= 0.0 && x < wide && y < high).then(|| {
            let (x, y) = (x as usize, y as usize);
            [x as f64 + 0.5 - outline.u, y as f64 + 0.5 - outline.v, f64::from(plane.row(y)[x].level())]
        })
    };
    let (a, b) = outline.semi_axes();
    let start = 3.0 * blur + 0.6;
    let width = (a * b).sqrt() + 6.0;
    let spacing = (width / 24.0).max(1.0);
    let mut rims = Vec::with_capacity(kept.len());
    let counted = rim_points(outline, kept.len()).zip(kept).filter(|(_, kept)| **kept);
    rims.extend(counted.map(|(rim, _)| [rim.x, rim.y, rim.normal[0], rim.normal[1]]));
    let ring =
        |distance: f64| rims.iter().filter_map(move |[x, y, nx, ny]| pixel(x + distance * nx, y + distance * ny));
    let mut spots: Vec<Spot> = Vec::with_capacity(2 * rims.len());
    let mut sums = Sums::default();
    let mut found: Option<(Vector3<f64>, f64)> = None;
    let mut outer = start;
    let mut step = 0;
    let widest = width.max(start + 2.0);
    while step < rings && start + f64::from(step) * spacing < widest {
        let distance = start + f64::from(step) * spacing;
        match &mut found {
            None => {
                // two rings for the first plane
                spots.extend(ring(distance));
                if step == 1 {
                    found = Some(robust_plane(&mut spots)?);
                    sums = Sums::of(spots.iter().copied());
                }
            }
            Some((coefficients, noise)) => {
                let next = Sums::of(ring(distance));
                if next.n * 10.0 < kept.len() as f64 * 6.0 {
                    break;
                }
                let (mean, square) = next.residuals(coefficients);
                let floor = noise.max(0.5);
                if square > (1.7 * floor).powi(2) || mean.abs() > 0.9 * floor {
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
    let mut inside = Vec::with_capacity(33);
    inside.extend(pixel(outline.u, outline.v).map(|spot| spot[2]));
    for radius in [0.25, 0.5, 0.7] {
        let rims = rim_points(&outline.scaled(radius), 16);
        inside.extend(rims.filter_map(|rim| pixel(rim.x, rim.y)).map(|spot| spot[2]));
    }
    let middle = inside.len() / 2;
    if inside.is_empty() {
        return None;
    }
    let (_, &mut median, _) = inside.select_nth_unstable_by(middle, f64::total_cmp);
    let contrast = median - coefficients.x;
    let far = inside.iter().filter(|level| (**level - median).abs() > contrast.abs() / 3.0).count();
    Some(Surround {
        level: coefficients.x,
        slope: [coefficients.y, coefficients.z],
        slope_covariance: sums.slope_cofactors()?.map(|cofactor| cofactor * noise * noise),
        noise,
        contrast,
        uneven: far as f64 / inside.len() as f64,
        outer,
    })
}

fn residual(coefficients: &Vector3<f64>, [x, y, level]: &Spot) -> f64 {
    level - coefficients.x - coefficients.y * x - coefficients.z * y
}

/// Sums of the normal equations of a plane: of 1, x, y, their products, and their products with the level g.
#[derive(Clone, Copy, Default)]
struct Sums {
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

impl Surround {
    /// Covariance of a centre (uu, uv, vv) that moves by M g when the slope changes by g: M S M'.
    pub fn carried(&self, m: [[f64; 2]; 2]) -> [f64; 3] {
        let [uu, uv, vv] = self.slope_covariance;
        let product = |a: [f64; 2], b: [f64; 2]| a[0] * (uu * b[0] + uv * b[1]) + a[1] * (uv * b[0] + vv * b[1]);
        [product(m[0], m[0]), product(m[0], m[1]), product(m[1], m[1])]
    }
}

impl Sums {
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
    Sums::of(spots.iter().copied()).plane()
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
