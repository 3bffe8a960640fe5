//! Cofactors of an interior orientation together with the mean motion of its photos.
//!
//! Photo i moves by the turn δᵢ about its camera axes, M' = exp([δᵢ]×) M, and its projection centre by ΔXᵢ. A point p that stays where it
//! is in the object moves in the camera frame by δᵢ × p - Mᵢ ΔXᵢ. The mean over the n photos has the turn Σ δᵢ / n and the shift
//! Σ Mᵢ ΔXᵢ / n: 6 linear functions f of the unknowns beside those that pick the parameters. With the S-transformation of the datum
//! Q' = S Q Sᵀ and Sᵀf = f - D(DᵀG)⁻ᵀGᵀf, their cofactors are (Sᵀfᵢ)ᵀ Q (Sᵀfⱼ): one solution of the factored equations per function.

use std::collections::HashMap;

use nalgebra::DMatrix;

use super::Session;
use crate::adjust::datum::free::{SIMILARITY, at_photo};
use crate::adjust::equations::back_substitution::Full;
use crate::adjust::problem::state::ExteriorOrientation;
use crate::adjustment::Adjustment;
use crate::error::Result;

impl Session<'_> {
    /// Takes over the values of an adjustment of the same document, where it has them.
    pub fn adopt(&mut self, adjustment: &Adjustment) {
        let (project, network) = (self.project, &self.network);
        let photos: HashMap<&str, _> = adjustment.photos.iter().map(|photo| (photo.id.as_str(), photo)).collect();
        for (block, pose) in network.photos.iter().zip(&mut self.state.poses) {
            if let Some(adjusted) = photos.get(project.photos[block.index].id.as_str()) {
                *pose = ExteriorOrientation::new(network.frame.inside(adjusted.position), adjusted.rotation);
            }
        }
        let points: HashMap<&str, _> = adjustment.points.iter().map(|point| (point.id.as_str(), point)).collect();
        for (block, x) in network.points.iter().zip(&mut self.state.points) {
            if let Some(adjusted) = points.get(project.points[block.index].id.as_str()) {
                *x = network.frame.inside(adjusted.xyz);
            }
        }
        for (block, interior) in network.interiors.iter().zip(&mut self.state.interiors) {
            let photo = block.photo.map(|p| project.photos[network.photos[p].index].id.as_str());
            let camera = &project.cameras[block.camera].id;
            let own = adjustment.cameras.iter().find(|c| c.camera.id == *camera && c.photo.as_deref() == photo);
            if let Some(adjusted) = own {
                *interior = adjusted.camera.interior;
            }
        }
    }

    /// Cofactors of the estimated parameters of interior orientation `interior`, in the network's order and the parameters' units, then
    /// of the mean turn (radians) and the mean shift (the document's unit) of its photos about and along their camera axes. The equations
    /// are the errors of [`Session::finish`] factored.
    ///
    /// # Errors
    /// [`crate::Error::Invalid`] if the datum's points have come together.
    pub fn calibration(&self, interior: usize) -> Result<DMatrix<f64>> {
        let estimated = &self.network.interiors[interior].estimated;
        let own = |photo: &usize| self.network.photos[*photo].interior == interior;
        let photos: Vec<usize> = (0..self.network.photos.len()).filter(own).collect();
        let share = 1.0 / photos.len().max(1) as f64;
        let constraint = self.constraint()?;
        let mut functions = Vec::with_capacity(estimated.len() + 6);
        for k in 0..estimated.len() {
            let mut e = Full::zeros(&self.network, &self.layout);
            e.reduced[self.layout.interior[interior] + k] = 1.0;
            functions.push(e);
        }
        for motion in 0..6 {
            let mut e = Full::zeros(&self.network, &self.layout);
            let mut taken = [0.0; SIMILARITY];
            for &photo in &photos {
                let pose = &self.state.poses[photo];
                let by: [f64; 6] = std::array::from_fn(|k| match (motion < 3, k < 3) {
                    (true, true) if k == motion => share,
                    (false, false) => share * pose.m[motion - 3][k - 3],
                    _ => 0.0,
                });
                let place = self.layout.photo[photo];
                for (k, by) in by.iter().enumerate() {
                    e.reduced[place + k] += by;
                }
                for (row, by) in at_photo(&pose.m, &pose.centre).iter().zip(by) {
                    taken.iter_mut().zip(row).for_each(|(sum, g)| *sum += by * g);
                }
            }
            self.subtract_datum(&mut e, constraint.as_ref(), &taken, 1.0);
            functions.push(e);
        }
        let mut solved = functions.clone();
        self.normal.solve_all(&self.network, &self.layout, &mut solved);
        let scale = |k: usize| match k.checked_sub(estimated.len()) {
            None => estimated[k].scale,
            Some(0..3) => 1.0,
            Some(_) => self.network.frame.scale,
        };
        let n = functions.len();
        let q = DMatrix::from_fn(n, n, |i, j| functions[i].product(&solved[j]) * scale(i) * scale(j));
        Ok((&q + q.transpose()) * 0.5)
    }
}
