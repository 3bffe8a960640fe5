//! The slope of the contrast in a fit: how much of the light's change the disc shows ([`shading`](crate::detect::shading)).
//!
//! Once a fit with a given slope H₀ of the contrast has converged, one with H free follows in closed form. With h = (x, y) I what H
//! changes, N = J'J and r the residuals,
//!
//! ```text
//! K = -N⁻¹ J'h,   S = h'h + h'J K,   H = H₀ + S⁻¹ h'r,   the unknowns move by K (H - H₀),
//! ```
//!
//! with the cofactors S⁻¹ of H and N⁻¹ + K S⁻¹ K' of the unknowns.

use nalgebra::{Matrix2, SMatrix, Vector2};

use super::band::{Normal, UNKNOWNS, Unknowns};
use crate::detect::acceptance::light::FLOOR;
use crate::detect::shading::{Covariance, Estimates, settled};

/// What a slope of the contrast changes, against the unknowns, itself (xx, xy, yy) and the residuals: J'h, h'h, h'r.
pub(crate) type Lit = ([Unknowns; 2], [f64; 3], [f64; 2]);

/// What the light makes of a fit.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Shade {
    /// Slope of the contrast, in grey levels a pixel.
    pub slope: [f64; 2],
    /// Correction of the unknowns with it.
    pub step: Unknowns,
    /// What the background's slope, known better by that of the disc, moves the centre by beyond that.
    pub moved: [f64; 2],
    /// What the slope's own uncertainty adds to the covariance of the centre: uu, uv, vv.
    pub covariance: [f64; 3],
}

/// A fit with the slope of the contrast free.
pub(crate) struct Freed {
    /// Change of the unknowns with the slope, and the slope's cofactors.
    moves: SMatrix<f64, UNKNOWNS, 2>,
    cofactors: Matrix2<f64>,
    /// Correction of the slope.
    pub slope: [f64; 2],
}

impl Freed {
    /// From what a fit of these cofactors has left.
    pub fn of((along, own, left): &Lit, cofactors: &Normal) -> Option<Self> {
        let along = SMatrix::<f64, UNKNOWNS, 2>::from_columns(along);
        let moves = -(cofactors * along);
        let own = Matrix2::new(own[0], own[1], own[1], own[2]) + along.transpose() * moves;
        let inverse = ((own + own.transpose()) / 2.0).cholesky()?.inverse();
        let free = inverse * Vector2::from(*left);
        Some(Self { moves, cofactors: inverse, slope: [free.x, free.y] })
    }

    /// Correction of the unknowns.
    pub fn step(&self) -> Unknowns {
        self.moves * Vector2::from(self.slope)
    }

    /// What the light makes of the fit, for a background and a contrast (level, slope each) and the variance of a pixel, of which slopes see
    /// `together` times as much where neighbours share their noise. None in flat light.
    pub fn shade(
        &self,
        fitted: &Normal,
        [background, gx, gy]: [f64; 3],
        [contrast, hx, hy]: [f64; 3],
        variance: f64,
        together: f64,
    ) -> Option<Shade> {
        // centre and background's slope among the unknowns
        let places = [0, 1, UNKNOWNS - 2, UNKNOWNS - 1];
        let moved = SMatrix::<f64, 6, 2>::from_fn(|i, j| match places.get(i) {
            Some(place) => self.moves[(*place, j)],
            None => f64::from(u8::from(i == j + 4)),
        });
        let known = Covariance::from_fn(|i, j| match (places.get(i), places.get(j)) {
            (Some(row), Some(column)) => fitted[(*row, *column)],
            _ => 0.0,
        });
        let covariance = (known + moved * self.cofactors * moved.transpose()) * (variance * together)
            + Covariance::identity() * FLOOR;
        let free = Estimates::new(0.0, 0.0, gx, gy, hx, hy) + moved * Vector2::from(self.slope);
        let found = settled(&free, &covariance, background, contrast)?;
        if found.lit == 0.0 && [hx, hy] == [0.0; 2] {
            return None;
        }
        let step = self.moves * Vector2::new(found.mean[4] - hx, found.mean[5] - hy);
        let added = (found.covariance - found.spread - found.flat) / together + found.spread;
        Some(Shade {
            slope: [found.mean[4], found.mean[5]],
            step,
            moved: [found.mean[0] - step[0], found.mean[1] - step[1]],
            covariance: [added[(0, 0)], added[(0, 1)], added[(1, 1)]],
        })
    }
}
