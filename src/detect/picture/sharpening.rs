//! Estimates how a picture was sharpened, from the mean edge profile of its targets.
//!
//! An edge of blur σ that an unsharp mask of amount k and radius ρ has passed is
//! B + C (Φ(-d/σ) + k (Φ(-d/σ) - Φ(-d/√(σ² + ρ²)))), d the distance from the rim: linear in B, C and C k. Those are found by
//! least squares for every σ and ρ of a table; the smallest residual decides. Samples at the end of the scale say only that the
//! light was beyond it, and are not used.

use nalgebra::{Matrix3, Vector3};
use statrs::function::erf::erf;

use crate::detect::acceptance::picture as limits;
use crate::detect::ellipse::outline::Outline;
use crate::detect::ellipse::rays::rim_points;
use crate::image::{Sample, SampleView};

/// An unsharp mask.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sharpening {
    /// Share of the difference from the mean that was added.
    pub amount: f64,
    /// Sigma of the mean, in pixels.
    pub radius: f64,
}

/// Pixels to both sides of the rim.
const REACH: f64 = 7.0;
/// Rims that are enough: more change the mean profile by less than what is modelled of it.
const RIMS: usize = 120;
/// Samples of a pixel.
const FINE: f64 = 4.0;

const BINS: usize = (2.0 * REACH * FINE) as usize + 1;

/// Mean profile across rims, normalised to the contrast.
struct RimProfile {
    sums: [[f64; 3]; BINS],
    rims: usize,
}

/// The sharpening that the rims of these outlines show; `None` if they show none, or are too few.
pub(crate) fn of_rims<'a, T: Sample>(
    plane: &SampleView<T>,
    outlines: impl Iterator<Item = &'a Outline>,
    saturation: f64,
) -> Option<Sharpening> {
    let mut profile = RimProfile { sums: [[0.0; 3]; BINS], rims: 0 };
    for outline in outlines.filter(|outline| outline.semi_axes().1 >= limits::RIM) {
        if profile.rims == RIMS {
            break;
        }
        profile.add(plane, outline, saturation);
    }
    (profile.rims >= 3).then(|| profile.fit()).flatten()
}

impl RimProfile {
    fn add<T: Sample>(&mut self, plane: &SampleView<T>, outline: &Outline, saturation: f64) {
        let b = outline.semi_axes().1;
        let inner = (0.8 * b).min(REACH);
        let level = |x: f64, y: f64| f64::from(plane.nearest(x, y));
        let rims: Vec<_> = rim_points(outline, 32).filter(|rim| plane.holds(rim.x, rim.y, REACH + 1.0)).collect();
        let median = |mut values: Vec<f64>| {
            values.sort_by(f64::total_cmp);
            values.get(values.len() / 2).copied()
        };
        let along = |distance: f64| {
            median(
                rims.iter()
                    .map(|rim| level(rim.x + distance * rim.normal[0], rim.y + distance * rim.normal[1]))
                    .collect(),
            )
        };
        let (Some(ground), Some(inside)) = (along(0.9 * REACH), along(-inner)) else { return };
        let contrast = inside - ground;
        if contrast == 0.0 {
            return;
        }
        for rim in &rims {
            let [nx, ny] = rim.normal;
            // two to a pixel: more are the same pixels again
            for k in (0..BINS).step_by(FINE as usize / 2) {
                let d = k as f64 / FINE - REACH;
                if d < -inner {
                    continue;
                }
                // the pixel's own distance, rather than a sample between pixels
                let pixel = |place: f64| f64::from(place as u32) + 0.5;
                let (x, y) = (pixel(rim.x + d * nx), pixel(rim.y + d * ny));
                let own = d + (x - rim.x - d * nx) * nx + (y - rim.y - d * ny) * ny;
                let bin = (own + REACH) * FINE + 0.5;
                if !(0.0..BINS as f64).contains(&bin) {
                    continue;
                }
                let found = level(x, y);
                let sum = &mut self.sums[bin as usize];
                if found >= saturation || found <= 0.0 {
                    sum[2] += 1.0;
                } else {
                    sum[0] += 1.0;
                    sum[1] += (found - ground) / contrast;
                }
            }
        }
        self.rims += 1;
    }

    fn fit(&self) -> Option<Sharpening> {
        let whole = |sum: &&(usize, [f64; 3])| sum.1[0] >= 4.0 && sum.1[2] < limits::CLIPPED_RIM * sum.1[0];
        let sums: Vec<(usize, [f64; 3])> = self.sums.iter().copied().enumerate().collect();
        let points: Vec<[f64; 2]> =
            sums.iter().filter(whole).map(|(k, sum)| [*k as f64 / FINE - REACH, sum[1] / sum[0]]).collect();
        if points.len() < 24 {
            return None;
        }
        let edge = |d: f64, sigma: f64| 0.5 - 0.5 * erf(d / sigma * std::f64::consts::FRAC_1_SQRT_2);
        let (mut best, mut plain) = ((f64::INFINITY, None), f64::INFINITY);
        for sigma in (0..30).map(|i| 0.35 * 1.085f64.powi(i)) {
            let sharp: Vec<f64> = points.iter().map(|[d, _]| edge(*d, sigma)).collect();
            for radius in (0..16).map(|i| 0.5 + 0.1 * f64::from(i)) {
                let wide = sigma.hypot(radius);
                let (mut normal, mut right, mut square) = (Matrix3::zeros(), Vector3::zeros(), 0.0);
                for ([d, level], sharp) in points.iter().zip(&sharp) {
                    let row = Vector3::new(1.0, *sharp, sharp - edge(*d, wide));
                    normal += row * row.transpose();
                    right += row * *level;
                    square += level * level;
                }
                let damped = normal + Matrix3::identity() * 1e-9;
                let Some(found) = damped.cholesky().map(|factor| factor.solve(&right)) else { continue };
                let rest = square - found.dot(&right);
                let amount = found.z / found.y;
                if amount > 0.0 && amount < limits::STRONGEST && rest < best.0 {
                    best = (rest, Some(Sharpening { amount, radius }));
                }
                let two = normal.fixed_view::<2, 2>(0, 0).into_owned().cholesky();
                if let Some(found) = two.map(|factor| factor.solve(&right.fixed_rows::<2>(0).into_owned())) {
                    plain = plain.min(square - found.dot(&right.fixed_rows::<2>(0)));
                }
            }
        }
        best.1.filter(|found| found.amount > limits::LITTLE && plain - best.0 > limits::EXPLAINED * plain)
    }
}
