//! Correlated noise in a fit: its part that remains in the residuals, and the covariance of the unknowns.
//!
//! Noise with the covariance P enters a fit with the Jacobian J and the cofactors N⁻¹ = L L'. With K = J L, K̃ = P K, G = L' J' P J L (sums over
//! all pixels of the fit) and M = K̃ - K G / 2, the hat matrix is H = J N⁻¹ J' = K K', the residuals have the covariance
//!
//! (1 - H) P (1 - H) = P - K M' - M K',
//!
//! and the unknowns L G L'. For white noise K̃ = K, G = 1 and M = K / 2. Smoothing white noise with a Gaussian of sigma s gives the correlation
//! P(d) = exp(-d² / (4 s²)) at the distance d. Its sum over all d is 4 π s²: the factor by which the variance of a mean over many pixels grows.

use wide::f32x4;

use super::band::{Band, NormalMatrix, UNKNOWNS};
use super::{DERIVATIVES, Field};

/// Unknowns in fours.
const FOURS: usize = UNKNOWNS.div_ceil(4);
/// Neighbours whose products are summed at a time.
pub(super) const TOGETHER: usize = 4;

type Row = [[f32; 4]; FOURS];

/// K and M of the covariance of the residuals, P - K M' - M K', for the pixels of a field.
pub(super) struct ResidualCovariance {
    own: Vec<Row>,
    /// M; `None` for white noise, of which it is K / 2.
    other: Option<Vec<Row>>,
    /// Displacement of the centre caused by the matrix K.
    to_centre: [[f32; 2]; 2],
    /// Sum of K², the unknowns that the band determines.
    pub trace: f64,
    /// Variance of the centre over that in white noise.
    pub natural: f64,
}

impl ResidualCovariance {
    /// Of noise that a Gaussian mean of this sigma has passed, or white noise where that is 0; `None` if the cofactors are not positive definite.
    pub fn of(band: &Band, field: &Field, cofactors: &NormalMatrix, contrast: f64, mean: f64) -> Option<Self> {
        let columns = band.columns();
        let scale = |i: usize| if i < 2 * DERIVATIVES { contrast } else { 1.0 };
        let lower = cofactors.cholesky()?.l();
        let factors: [[f32; UNKNOWNS]; UNKNOWNS] =
            std::array::from_fn(|which| std::array::from_fn(|j| (lower[(j, which)] * scale(j)) as f32));
        let mut own = vec![Row::default(); field.width * field.height];
        let mut k = 0;
        for &(row, column, length) in &band.spans {
            for to in &mut own[row * field.width + column..][..length] {
                if band.kept[k] > 0.0 {
                    for (to, factors) in to.as_flattened_mut().iter_mut().zip(&factors) {
                        *to = factors.iter().zip(columns).map(|(factor, column)| factor * column[k]).sum();
                    }
                }
                k += 1;
            }
        }
        let centre = [[lower[(0, 0)], 0.0], [lower[(1, 0)], lower[(1, 1)]]];
        let to_centre = centre.map(|row| row.map(|value| value as f32));
        let square = |row: &Row| row.as_flattened().iter().map(|k| f64::from(*k).powi(2)).sum::<f64>();
        let trace = own.iter().map(square).sum();
        if mean <= 0.0 {
            return Some(Self { own, other: None, to_centre, trace, natural: 1.0 });
        }
        let mut other = correlated(&own, band, field.width, mean);
        let (mut through, mut plain) = (NormalMatrix::zeros(), NormalMatrix::zeros());
        for &(row, column, length) in &band.spans {
            let span = row * field.width + column..row * field.width + column + length;
            for (k, meant) in own[span.clone()].iter().zip(&other[span]) {
                let (k, meant) = (k.as_flattened(), meant.as_flattened());
                for i in 0..UNKNOWNS {
                    for j in 0..UNKNOWNS {
                        through[(i, j)] += f64::from(k[i]) * f64::from(meant[j]);
                        plain[(i, j)] += f64::from(k[i]) * f64::from(k[j]);
                    }
                }
            }
        }
        let slow = (4.0 * std::f64::consts::PI * mean * mean).max(1.0);
        let through = through + (NormalMatrix::identity() - plain) * slow;
        for (k, to) in own.iter().zip(&mut other) {
            let k = k.as_flattened();
            for (j, to) in to.as_flattened_mut().iter_mut().take(UNKNOWNS).enumerate() {
                *to -= 0.5 * (0..UNKNOWNS).map(|i| k[i] * through[(i, j)] as f32).sum::<f32>();
            }
        }
        let (mut moved, mut white) = (0.0, 0.0);
        for row in centre {
            for (i, a) in row.into_iter().enumerate() {
                white += a * a;
                moved += row.into_iter().enumerate().map(|(j, b)| a * b * through[(i, j)]).sum::<f64>();
            }
        }
        Some(Self { own, other: Some(other), to_centre, trace, natural: moved / white })
    }

    /// Displacement of the centre per unit of the pixel at a position of the field.
    pub fn moved(&self, at: usize) -> [f32; 2] {
        let [first, second, ..] = self.own[at][0];
        self.to_centre.map(|[a, b]| a * first + b * second)
    }

    /// Sums of K M' + M K' over pairs of pixels of the spans, one for each shift.
    pub fn products<'a>(&'a self, band: &Band, width: usize, shifts: [usize; TOGETHER]) -> [f64; TOGETHER] {
        let mut sums = [f32x4::ZERO; TOGETHER];
        for &(row, column, length) in &band.spans {
            let from = row * width + column;
            for (sum, shift) in sums.iter_mut().zip(shifts) {
                let end = (from + length).min(self.own.len().saturating_sub(shift));
                let pairs = |of: &'a [Row]| of[from..end].iter().zip(&of[from + shift..end + shift]);
                let Some(other) = &self.other else {
                    for (k, far_k) in pairs(&self.own) {
                        for four in 0..FOURS {
                            *sum += f32x4::new(k[four]) * f32x4::new(far_k[four]);
                        }
                    }
                    continue;
                };
                for ((k, far_k), (m, far_m)) in pairs(&self.own).zip(pairs(other)) {
                    for four in 0..FOURS {
                        *sum += f32x4::new(k[four]) * f32x4::new(far_m[four])
                            + f32x4::new(m[four]) * f32x4::new(far_k[four]);
                    }
                }
            }
        }
        sums.map(|sum| sum.to_array().into_iter().map(f64::from).sum())
    }
}

/// Correlation of the noise of two pixels at a distance, after a mean of this sigma.
pub(super) fn correlation(dx: i32, dy: i32, mean: f64) -> f64 {
    let square = f64::from(dx * dx + dy * dy);
    if square == 0.0 {
        1.0
    } else if mean <= 0.0 {
        0.0
    } else {
        (-square / (4.0 * mean * mean)).exp()
    }
}

/// P K at the pixels of the band, and zeros elsewhere: along rows, then along columns.
fn correlated(rows: &[Row], band: &Band, width: usize, mean: f64) -> Vec<Row> {
    let side = (3.5 * std::f64::consts::SQRT_2 * mean).ceil() as usize;
    let kernel: Vec<f32x4> = (0..=side).map(|t| f32x4::splat(correlation(t as i32, 0, mean) as f32)).collect();
    let mut along = vec![Row::default(); rows.len()];
    for &(row, column, length) in &band.spans {
        for from in column..column + length {
            let values = rows[row * width + from].map(f32x4::new);
            let reached = from.saturating_sub(side)..(from + side + 1).min(width);
            for (at, to) in reached.clone().zip(&mut along[row * width..][reached]) {
                let weight = kernel[at.abs_diff(from)];
                *to = std::array::from_fn(|four| (f32x4::new(to[four]) + weight * values[four]).to_array());
            }
        }
    }
    let mut both = vec![Row::default(); rows.len()];
    let last = rows.len() / width.max(1);
    let mut k = 0;
    for &(row, column, length) in &band.spans {
        for at in column..column + length {
            k += 1;
            if band.kept[k - 1] <= 0.0 {
                continue;
            }
            let mut sums = [f32x4::ZERO; FOURS];
            for from in row.saturating_sub(side)..(row + side + 1).min(last) {
                let weight = kernel[from.abs_diff(row)];
                for (sum, values) in sums.iter_mut().zip(along[from * width + at]) {
                    *sum += weight * f32x4::new(values);
                }
            }
            both[row * width + at] = sums.map(f32x4::to_array);
        }
    }
    both
}
